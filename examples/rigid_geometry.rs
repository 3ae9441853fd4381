//! An active droplet swims between rigid walls of some shape, or past fixed posts.
//!
//! `cargo run --release --example rigid_geometry -- --case sinusoidal` simulates it, prints what was measured, and
//! writes to `out/rigid_geometry/` what the example `rigid_channel` writes. Cases are `sinusoidal`, with the half width
//! `--width`/2 + `--amplitude` cos(2 pi x/`--length`), `constriction`, that of the example `constriction` with its
//! corners rounded over `--rounding`, `ratchet`, `branch`, around an island, and `posts`. `--help` lists the flags.

use std::process::ExitCode;

use anyhow::{Result, ensure};
use clap::{Parser, ValueEnum};
use motile::base::Region;
use motile::elastic_solids::ChannelShape;
use motile::setup::{MethodKind, Setup, SolidOutline, WallSetup};
use motile_examples::{ChannelFlags, MethodFlags, SceneFlags, mean_speed, not_negative, positive};

/// Distance of the straight walls of the region behind those of a case (R0): far enough that few of their modes matter.
const BEHIND: f64 = 1.5;

/// Shapes of rigid geometry.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Case {
    /// Sinusoidal sides; the droplet starts where the channel is widest
    Sinusoidal,
    /// A narrow passage, as in the example of that name
    Constriction,
    /// Asymmetric teeth
    Ratchet,
    /// Two branches around an island
    Branch,
    /// Two posts in a straight channel
    Posts,
}

/// An active droplet swims between rigid walls of some shape.
#[derive(Debug, Parser)]
#[command(after_help = "The default run takes 1,135 steps, 2,271 evaluations of the flow.")]
struct Flags {
    /// The shape
    #[arg(long, value_enum, default_value_t = Case::Sinusoidal)]
    case: Case,
    /// Amplitude of sinusoidal sides (R0); without it 0.3
    #[arg(long, value_parser = not_negative, allow_hyphen_values = true)]
    amplitude: Option<f64>,
    /// Width of the constriction, or at the tips of the ratchet (R0); without it 1 and three quarters of the width
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    throat: Option<f64>,
    /// Length of the constriction (R0); without it 4
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    throat_length: Option<f64>,
    /// Length of the ramps of the constriction (R0); without it 1
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    ramp: Option<f64>,
    /// Length over which the corners of the constriction and of the ratchet are rounded (R0); without it 0.06
    #[arg(long, value_parser = not_negative, allow_hyphen_values = true)]
    rounding: Option<f64>,
    /// Distance of the nodes of walls where these are nearest to one another (R0)
    #[arg(long, default_value_t = 0.05, value_parser = positive, allow_hyphen_values = true)]
    wall_spacing: f64,
    /// Largest factor by which this distance grows where walls are farther from one another; 1 for equal distances
    #[arg(long, default_value_t = 3.0, value_parser = positive, allow_hyphen_values = true)]
    wall_grading: f64,
    #[command(flatten)]
    scene: SceneFlags<ChannelFlags>,
}

impl Flags {
    /// Amplitude of sinusoidal sides (R0).
    fn amplitude(&self) -> f64 {
        self.amplitude.unwrap_or(0.3)
    }

    /// Refuses flags of other cases.
    fn check_case(&self) -> Result<()> {
        let corners = [Case::Constriction, Case::Ratchet];
        for (flag, given, cases) in [
            ("amplitude", self.amplitude, &[Case::Sinusoidal][..]),
            ("throat", self.throat, &corners),
            ("throat-length", self.throat_length, &corners[..1]),
            ("ramp", self.ramp, &corners[..1]),
            ("rounding", self.rounding, &corners),
        ] {
            let name = |case: &Case| case.to_possible_value().map(|value| format!("--case {}", value.get_name()));
            let names: Vec<String> = cases.iter().filter_map(name).collect();
            ensure!(
                given.is_none() || cases.contains(&self.case),
                "--{flag} belongs to {}: leave it out, or give that case",
                names.join(" and ")
            );
        }
        Ok(())
    }

    /// The shape of the sides, none where they are straight; and where the droplet starts (R0).
    fn shape(&self) -> (Option<ChannelShape>, f64) {
        let (width, length) = (self.scene.region.width, self.scene.region.along.length);
        match self.case {
            Case::Sinusoidal => {
                (Some(ChannelShape::Sinusoidal { width, amplitude: self.amplitude(), waves: 1, phase: 0.0 }), 0.0)
            }
            Case::Constriction => {
                let throat = self.throat.unwrap_or(1.0);
                let (throat_length, ramp) = (self.throat_length.unwrap_or(4.0), self.ramp.unwrap_or(1.0));
                let centre = 0.0;
                (Some(ChannelShape::Constriction { width, throat, throat_length, ramp, centre }), -0.5 * length)
            }
            Case::Ratchet => {
                let throat = self.throat.unwrap_or(0.75 * width);
                (Some(ChannelShape::Ratchet { width, throat, teeth: 3, rise: 0.8, sharp: true }), -0.5 * length)
            }
            Case::Branch => {
                let shape = ChannelShape::Branching {
                    width,
                    branches: [0.8 * width; 2],
                    island_length: 0.3 * length,
                    island_thickness: 0.4 * width,
                    ramp: 0.25 * length,
                };
                (Some(shape), -0.5 * length)
            }
            Case::Posts => (None, 0.0),
        }
    }

    /// The scene.
    fn setup(&self) -> Result<Setup> {
        self.check_case()?;
        let flags = &self.scene;
        ensure!(
            flags.method.method.is_none_or(|kind| kind == MethodKind::Integral),
            "rigid walls of any shape have no grid: leave --method out or give integral"
        );
        let (amplitude, width) = (self.amplitude(), flags.region.width);
        ensure!(
            self.case != Case::Sinusoidal || amplitude < 0.5 * width,
            "--amplitude {amplitude} leaves no room between walls of --width {width}: give less than {}",
            0.5 * width
        );
        let method = MethodFlags { method: Some(MethodKind::Integral), ..flags.method.clone() };
        let mut setup = method.setup(&flags.droplet, None)?;
        let (shape, x) = self.shape();
        flags.region.apply(&mut setup)?;
        setup.droplets[0].centre[0] = x;
        let (spacing, [period, width]) = (self.wall_spacing, setup.region.lengths());
        let Some(shape) = shape else {
            // One close to each wall, so that there is room on the other side.
            let post = |[x, y]: [f64; 2]| {
                let outline = SolidOutline::Disc { centre: [x * period, y * width], radius: 0.12 * width };
                WallSetup::new(outline, spacing)
            };
            setup.walls = [[0.25, 0.3], [-0.25, -0.3]].map(post).into();
            return Ok(setup);
        };
        let channel = shape.channel(period)?;
        let extent = |outline: &motile::elastic_solids::Outline| -> Result<f64> {
            Ok(outline.resampled(spacing)?.iter().map(|point| point.y.abs()).fold(0.0, f64::max))
        };
        let half = extent(channel.lower())?.max(extent(channel.upper())?) + BEHIND;
        if let Region::Channel { width, .. } = &mut setup.region {
            *width = 2.0 * half;
        }
        setup.walls = WallSetup::channel(&shape, spacing);
        setup.walls.iter_mut().for_each(|wall| wall.grading = self.wall_grading);
        if matches!(self.case, Case::Constriction | Case::Ratchet) {
            setup.walls.iter_mut().for_each(|wall| wall.rounding = self.rounding.unwrap_or(0.06));
        }
        Ok(setup)
    }
}

fn main() -> ExitCode {
    motile_examples::run(swim)
}

fn swim(flags: &Flags) -> Result<()> {
    // The droplet and the walls.
    let setup = flags.setup()?;
    let length = flags.scene.region.along.length;

    // The run, with all that watches it.
    let mut run = flags.scene.watch(setup.build()?, &setup, "rigid_geometry")?;
    run.go(None)?;

    // The results, also of a run that broke off.
    let mut summary = run.summary()?;
    let track: Vec<(f64, f64)> = run.track()?.iter().map(|(time, place)| (*time, place.x)).collect();
    let mean = mean_speed(&track, length);
    summary.put("passed", mean.is_some(), "whether it has come by all of the geometry, a period");
    summary.put("mean_speed", mean, "over the last period (R0 per time), if it has passed");
    let last = run.last()?.clone();
    summary.put("pressure_gradient", last.pressure_gradient, "mean along the channel");
    summary.put("gap", last.gap, "to walls and obstacles, in the end (R0)");
    summary.put("minimum_gap", run.scene.system().minimum_wall_gap(), "to walls and obstacles, over the run (R0)");
    run.finish(&summary)
}
