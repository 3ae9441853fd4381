//! A layer of fluid between two active walls: interfaces that are periodic along x and carry active particles.
//!
//! `cargo run --release --example active_walls` simulates two active interfaces in a periodic box, across the whole
//! length of which they reach, from a small perturbation to the pattern in which their particles gather. `--elastic
//! STRETCHING,BENDING` makes membranes of them, `--droplet active` or `passive` puts a droplet between them, `--width`
//! rigid walls beyond them. Prints what was measured and writes to `out/active_walls/`:
//!
//! * `final.png`, a picture of the final state;
//! * `interfaces.csv`, height, flux, modes of shape and concentration of both walls over time, `droplets.csv` the same
//!   of the droplet, and `summary.json`, the results;
//! * `vtk/`, files for ParaView.
//!
//! `--help` lists the flags.

use std::process::ExitCode;

use anyhow::{Result, ensure};
use clap::{Parser, ValueEnum};
use motile::active_interface::Motion;
use motile::base::{Drive, Region};
use motile::setup::{DropletSetup, ElasticitySetup, InterfaceSetup, Particles, Setup, Side, Start};
use motile_cli::run::{OutputFlags, SceneRun, View};
use motile_examples::{DropletFlags, MethodFlags, finite, pair, positive};

/// Body between the walls.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Between {
    /// Fluid alone.
    None,
    /// A droplet without particles.
    Passive,
    /// An active droplet.
    Active,
}

/// A layer of fluid between two active walls.
#[derive(Debug, Parser)]
#[command(after_help = "The default run takes 471 steps, 943 evaluations of the flow.")]
struct Flags {
    /// Activity of the particles on the walls, negative: contractile
    #[arg(long, default_value_t = -1.0, value_parser = finite, allow_hyphen_values = true)]
    wall_activity: f64,
    /// Tension of the walls without particles
    #[arg(long, default_value_t = 10.0, value_parser = positive, allow_hyphen_values = true)]
    wall_tension: f64,
    /// Distance of the walls (R0)
    #[arg(long, default_value_t = 3.0, value_parser = positive, allow_hyphen_values = true)]
    gap: f64,
    /// Period along the walls (R0)
    #[arg(long, default_value_t = 6.0, value_parser = positive, allow_hyphen_values = true)]
    length: f64,
    /// Distance of rigid walls beyond them (R0); without it a box of twice the gap in height
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    width: Option<f64>,
    /// Viscosity beyond the walls; without it that between them
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    viscosity_beyond: Option<f64>,
    /// Moduli of stretching and bending of the walls; without them they are fluid
    #[arg(long, value_name = "STRETCHING,BENDING", value_parser = pair, allow_hyphen_values = true)]
    elastic: Option<[f64; 2]>,
    /// Seed of the perturbation of the particles on the walls
    #[arg(long, default_value_t = 1)]
    wall_seed: u64,
    /// Body between the walls
    #[arg(long, value_enum, default_value_t = Between::None)]
    droplet: Between,
    /// The droplet, and the viscosities
    #[command(flatten)]
    flags: DropletFlags,
    #[command(flatten)]
    method: MethodFlags,
    #[command(flatten)]
    output: OutputFlags,
}

/// Relative amplitude of the perturbation of the particles.
const PERTURBATION: f64 = 0.01;

fn main() -> ExitCode {
    motile_examples::run(simulate)
}

fn simulate(flags: &Flags) -> Result<()> {
    let setup = scene(flags)?;
    let view = View { spacing: flags.method.spacing(&setup), region: format!("gap = {}", flags.gap) };
    let mut run = SceneRun::new(setup.build()?, &setup, flags.method.time, &flags.output, "active_walls", &view)?;
    run.go(None)?;

    // The results, also of a run that broke off.
    let mut summary = run.summary()?;
    let tables = [run.table().ok(), run.droplets().map(motile_output::DropletsCsv::table)];
    if let Some(table) = tables.into_iter().flatten().next() {
        let track = table.curve("time", "x")?;
        let late = track.iter().find(|(time, _)| *time >= 0.5 * run.scene.time()).zip(track.last());
        let mean = late.map(|(first, last)| (last.1 - first.1) / (last.0 - first.0));
        summary.put("droplet_speed_along", mean, "along the walls, mean over the second half (R0 per time)");
    }
    run.finish(&summary)
}

/// The scene that the flags describe.
fn scene(flags: &Flags) -> Result<Setup> {
    let (gap, length) = (flags.gap, flags.length);
    let DropletFlags { activity, excluded_volume, viscosity_in, angle, initial, seed, .. } = &flags.flags;
    let of_particles = activity.is_some() || excluded_volume.is_some() || initial.is_some() || seed.is_some();
    ensure!(
        flags.droplet == Between::Active || !(of_particles || angle.is_some()),
        "a flag of the droplet's particles is given: give --droplet active, or leave it out"
    );
    ensure!(
        flags.droplet != Between::None || viscosity_in.is_none(),
        "--viscosity-in is that of a droplet: give --droplet passive or active, or --viscosity-beyond"
    );
    let mut setup = flags.method.setup(&flags.flags, None)?;
    setup.region = match flags.width {
        None => Region::Box { lengths: [length, 2.0 * gap] },
        Some(width) => {
            ensure!(width > gap, "--width {width} leaves no fluid beyond the walls: give more than --gap {gap}");
            Region::Channel { length, width, drive: Drive::ZeroGradient }
        }
    };
    let wall = |height: f64, inside: Side, seed: u64| InterfaceSetup {
        name: if height < 0.0 { "lower wall" } else { "upper wall" }.to_owned(),
        height,
        inside,
        viscosity: flags.viscosity_beyond,
        tension: flags.wall_tension,
        motion: if flags.elastic.is_some() { Motion::WithFluid } else { Motion::default() },
        elasticity: flags.elastic.map(|[stretching, bending]| ElasticitySetup { stretching, bending }),
        particles: Some(Particles {
            activity: flags.wall_activity,
            start: Start::Perturbed { amplitude: PERTURBATION, seed },
            ..Particles::default()
        }),
        ..InterfaceSetup::default()
    };
    let seed = flags.wall_seed;
    setup.interfaces = vec![wall(-0.5 * gap, Side::Below, seed), wall(0.5 * gap, Side::Above, seed.wrapping_add(1))];
    match flags.droplet {
        Between::None => setup.droplets.clear(),
        Between::Active => {}
        Between::Passive => {
            let DropletSetup { tension, .. } = setup.droplets[0];
            setup.droplets[0] =
                DropletSetup { viscosity: setup.droplets[0].viscosity, ..DropletSetup::passive(tension) };
        }
    }
    ensure!(
        flags.droplet == Between::None || gap > 2.0,
        "--gap {gap} is too small for a droplet of diameter 2: give more"
    );
    Ok(setup)
}
