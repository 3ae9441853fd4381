//! Runs of a droplet between elastic walls, and flags of what else the walls are.

use anyhow::Result;
use clap::Args;
use motile::elastic_solids::ChannelShape;
use motile::scene::Body;
use motile::setup::{ActiveSpringsSetup, MaxwellSetup, Setup};
use motile_cli::run::say;

use crate::parse::{not_negative, positive, seed};
use crate::{ElasticFlags, SceneFlags};

/// A run of a droplet between straight elastic walls, into `out/<name>/`, of a scene that `change` has changed.
///
/// # Errors
/// Flags that do not fit together; those of the run.
pub fn swim_between_walls(
    flags: &SceneFlags<ElasticFlags>,
    name: &str,
    change: impl FnOnce(&mut Setup) -> Result<()>,
) -> Result<()> {
    // The droplet and the walls.
    let shape = ChannelShape::Straight { width: flags.region.width };
    let mut setup = flags.setup(&shape, 0.0)?;
    change(&mut setup)?;
    let built = setup.build()?;
    for wall in &built.solids {
        let wall = built.scene.body(*wall)?;
        say(format_args!("{}: {}", wall.name(), wall.mesh().quality()));
    }
    let walls = built.solids.clone();

    // The run, with all that watches it.
    let mut run = flags.watch(built, &setup, name)?;
    run.go(None)?;

    // The results, also of a run that broke off.
    let mut summary = run.summary()?;
    run.put_regime(&mut summary)?;
    summary.put("pressure_gradient", run.last()?.pressure_gradient, "mean along the channel");
    if setup.solids.iter().any(|wall| !wall.relaxation.is_empty()) {
        let mut energies = [0.0; 2];
        for wall in &walls {
            let seen = run.scene.observe(*wall)?;
            energies[0] += seen.relaxing_energy;
            energies[1] += seen.dissipation;
        }
        summary.put("relaxing_energy", energies[0], "of the Maxwell elements, at the end");
        summary.put("wall_dissipation", energies[1], "per time, of the Maxwell elements, at the end");
    }
    if setup.solids.iter().any(|wall| wall.active_springs.is_some()) {
        let mut parts = Vec::new();
        for wall in &walls {
            parts.push(run.scene.observe(*wall)?.active_part);
        }
        summary.put("active_part", parts.iter().sum::<f64>() / parts.len() as f64, "of the active springs, at the end");
    }
    run.finish(&summary)
}

/// Relaxation of the stress of the walls.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct RelaxationFlags {
    /// Relaxation time of the walls
    #[arg(long, default_value_t = 1.0, value_parser = positive, allow_hyphen_values = true)]
    pub relaxation_time: f64,
    /// Shear modulus that relaxes; without it that of the walls, which are then half as stiff in the long run
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    pub maxwell_modulus: Option<f64>,
}

impl RelaxationFlags {
    /// Puts Maxwell elements into all walls of a scene.
    pub fn apply(&self, setup: &mut Setup) {
        for wall in &mut setup.solids {
            let modulus = self.maxwell_modulus.unwrap_or_else(|| wall.material.shear());
            wall.relaxation = vec![MaxwellSetup { modulus, time: self.relaxation_time }];
        }
    }
}

/// Active springs of the walls.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct TwitchingFlags {
    /// Tension of an active spring while it is on
    #[arg(long, default_value_t = 5.0, value_parser = positive, allow_hyphen_values = true)]
    pub tension: f64,
    /// Rate at which active springs turn on
    #[arg(long, default_value_t = 0.5, value_parser = positive, allow_hyphen_values = true)]
    pub on_rate: f64,
    /// Rate at which active springs turn off
    #[arg(long, default_value_t = 1.0, value_parser = not_negative, allow_hyphen_values = true)]
    pub off_rate: f64,
    /// Seed of the active springs; the upper wall has the next one
    #[arg(long, default_value_t = 1, value_parser = seed, allow_hyphen_values = true)]
    pub wall_seed: u64,
}

impl TwitchingFlags {
    /// Puts active springs into all walls of a scene.
    pub fn apply(&self, setup: &mut Setup) {
        for (number, wall) in setup.solids.iter_mut().enumerate() {
            wall.active_springs = Some(ActiveSpringsSetup {
                tension: self.tension,
                on: self.on_rate,
                off: self.off_rate,
                seed: self.wall_seed.wrapping_add(number as u64),
                on_sensitivity: 0.0,
                off_sensitivity: 0.0,
            });
        }
    }
}
