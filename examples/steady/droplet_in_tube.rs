//! An active droplet in three dimensions, in a tube or in unbounded fluid.
//!
//! `cargo run --release -p motile-steady-examples --example droplet_in_tube` lets a droplet of revolution swim along
//! the axis of a straight tube of twice its radius, prints what was measured, and writes to `out/droplet_in_tube/`
//! what the example `swimming_droplet` writes; pictures show the meridian plane with its mirror image,
//! `vtk/surface.pvd` is the surface turned round. Without `--tube-radius` and with `--space` the fluid is unbounded.
//! Shapes of the tube are `straight`, `constriction`, where the run ends when it is clear what becomes of the droplet,
//! and `sinusoidal`; both are closed at their ends, or open for a `--flux`.
//!
//! With `--steady` the steady swimmer is found by Newton's method, without a run, and whether it is stable against
//! disturbances that leave it a body of revolution (order 0), that turn it (1), and that flatten it (2). `--help` lists
//! the flags.

use std::process::ExitCode;

use anyhow::{Result, ensure};
use clap::{Args, Parser, ValueEnum};
use motile::base::{Drive, Region, TubeShape};
use motile::setup::{DropletShape, MethodKind, Setup};
use motile_cli::run::{Summary, say};
use motile_examples::{MethodFlags, Passage, RegionFlags, SceneFlags, positive};
use motile_steady_states::{Measured, Stability, SteadyState};

/// Shapes of tubes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Shape {
    /// Straight and infinitely long.
    Straight,
    /// A narrow passage in the middle; the droplet starts on its left.
    Constriction,
    /// Sinusoidal sides.
    Sinusoidal,
}

/// A tube, or unbounded fluid.
#[derive(Debug, Clone, PartialEq, Args)]
struct TubeFlags {
    /// Radius of the tube (R0) [default: 2]
    #[arg(long, value_parser = positive, allow_hyphen_values = true, conflicts_with = "space")]
    tube_radius: Option<f64>,
    /// Unbounded fluid in place of a tube
    #[arg(long)]
    space: bool,
    /// Shape of the tube
    #[arg(long, value_enum, default_value_t = Shape::Straight, conflicts_with = "space")]
    shape: Shape,
    /// Radius of the throat of a constriction (R0) [default: 0.9]
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    throat: Option<f64>,
    /// Length of the throat (R0) [default: 2]
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    throat_length: Option<f64>,
    /// Length of the ramps on both sides of it (R0) [default: 2]
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    ramp: Option<f64>,
    /// Amplitude of sinusoidal sides (R0) [default: 0.3]
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    amplitude: Option<f64>,
    /// Period of sinusoidal sides (R0) [default: 6]
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    period: Option<f64>,
    /// Length of the tube (R0): between the ends of a shape, or that over which a straight one has the gradient
    /// [default: 16 radii of the tube; infinite]
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    length: Option<f64>,
    /// Flux through the tube (R0^3 per time) [default: 0]
    #[arg(long, allow_hyphen_values = true, conflicts_with_all = ["gradient", "space"])]
    flux: Option<f64>,
    /// Mean pressure gradient over the length of a straight tube in place of a flux (stress per R0)
    #[arg(long, allow_hyphen_values = true, conflicts_with = "space")]
    gradient: Option<f64>,
    /// Radius of the droplets (R0)
    #[arg(long, default_value_t = 1.0, value_parser = positive, allow_hyphen_values = true)]
    radius: f64,
    /// Place of the first droplet on the axis (R0) [default: 0; before a constriction two radii]
    #[arg(long, allow_hyphen_values = true)]
    start: Option<f64>,
    /// Number of droplets, a train along the axis
    #[arg(long, default_value_t = 1)]
    droplets: usize,
    /// Distance of their centres (R0)
    #[arg(long, default_value_t = 3.0, value_parser = positive, allow_hyphen_values = true)]
    distance: f64,
}

impl RegionFlags for TubeFlags {
    fn caption(&self) -> Result<String> {
        Ok(if self.space { "three dimensions".to_owned() } else { format!("W = {}", self.width()) })
    }
}

impl TubeFlags {
    fn width(&self) -> f64 {
        self.tube_radius.unwrap_or(2.0)
    }

    /// Refuses flags of other shapes.
    fn check_shape(&self) -> Result<()> {
        for (flag, given, shape) in [
            ("throat", self.throat, Shape::Constriction),
            ("throat-length", self.throat_length, Shape::Constriction),
            ("ramp", self.ramp, Shape::Constriction),
            ("amplitude", self.amplitude, Shape::Sinusoidal),
            ("period", self.period, Shape::Sinusoidal),
        ] {
            let name = shape.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default();
            ensure!(
                given.is_none() || (self.shape == shape && !self.space),
                "--{flag} belongs to --shape {name}: leave it out, or give that shape"
            );
        }
        ensure!(self.droplets > 0, "--droplets 0 leaves nothing to watch: give at least 1");
        Ok(())
    }

    fn shape(&self) -> TubeShape {
        match self.shape {
            Shape::Straight => TubeShape::Straight,
            Shape::Constriction => TubeShape::Constriction {
                throat: self.throat.unwrap_or(0.9),
                throat_length: self.throat_length.unwrap_or(2.0),
                ramp: self.ramp.unwrap_or(2.0),
            },
            Shape::Sinusoidal => {
                let (amplitude, period) = (self.amplitude.unwrap_or(0.3), self.period.unwrap_or(6.0));
                TubeShape::Sinusoidal { amplitude, period }
            }
        }
    }

    /// End of the constriction (R0), if there is one.
    fn passage(&self) -> Option<f64> {
        if let TubeShape::Constriction { throat_length, ramp, .. } = self.shape() {
            Some(0.5 * throat_length + ramp)
        } else {
            None
        }
    }

    fn apply(&self, setup: &mut Setup) -> Result<()> {
        self.check_shape()?;
        let drive = self.flux.map(Drive::Flux).or(self.gradient.map(Drive::Gradient)).unwrap_or(Drive::ZeroFlux);
        let (radius, shape, length) = (self.width(), self.shape(), self.length);
        setup.region = if self.space { Region::Space } else { Region::Tube { radius, shape, drive, length } };
        let first = self.start.unwrap_or_else(|| self.passage().map_or(0.0, |end| -end - 2.0 * self.radius));
        let mut droplet = setup.droplets[0].clone();
        droplet.shape = DropletShape::Round { radius: self.radius };
        setup.droplets = (0..self.droplets)
            .map(|number| {
                let mut droplet = droplet.clone();
                droplet.centre = [first - self.distance * number as f64, 0.0];
                if number > 0 {
                    droplet.name = format!("{} {}", droplet.name, number + 1);
                }
                droplet
            })
            .collect();
        Ok(())
    }
}

/// Nodes of a steady swimmer.
const STEADY_NODES: usize = 160;

/// An active droplet in three dimensions.
#[derive(Debug, Parser)]
#[command(after_help = "The default run takes 1,022 steps, 2,045 evaluations of the flow.")]
struct Flags {
    /// Steady swimmer by Newton's method, without a run; with 160 nodes if --nodes does not say otherwise
    #[arg(long, conflicts_with_all = ["time", "dt", "integrator", "rows", "checkpoint", "resume", "droplets"])]
    steady: bool,
    #[command(flatten)]
    scene: SceneFlags<TubeFlags>,
}

fn main() -> ExitCode {
    motile_examples::run(swim)
}

fn swim(Flags { steady, scene }: &Flags) -> Result<()> {
    ensure!(
        scene.method.method.is_none_or(|kind| kind == MethodKind::Integral),
        "three dimensions have no grid: leave --method out or give integral"
    );
    let nodes = scene.method.nodes.or(steady.then_some(STEADY_NODES));
    let method = MethodFlags { method: Some(MethodKind::Integral), nodes, ..scene.method.clone() };
    let mut setup = method.setup(&scene.droplet, None)?;
    scene.region.apply(&mut setup)?;
    setup.check()?;
    if *steady { find(scene, &setup) } else { run(scene, &setup) }
}

/// Finds the steady swimmer.
fn find(scene: &SceneFlags<TubeFlags>, setup: &Setup) -> Result<()> {
    scene.output.check("droplet_in_tube", None)?;
    scene.output.write_scene(setup)?;
    let state = SteadyState::find(setup)?;
    let Measured { speed, stresslet, aspect_ratio, concentration, perimeter, .. } = state.measured()?;
    let mut summary = Summary::default();
    summary.put("speed", speed, "of the centroid (R0 per time)");
    summary.put("aspect_ratio", aspect_ratio, "by moments of the volume, along the axis over across");
    summary.put("stresslet", stresslet, "along the axis; positive pushes");
    summary.put("c_max", concentration[0], "largest concentration (c0)");
    summary.put("c_min", concentration[1], "smallest concentration (c0)");
    summary.put("surface", perimeter, "area (R0^2)");
    let spectra = [state.spectrum()?, state.spectrum_around(1)?, state.spectrum_around(2)?];
    // Only some have rigid motions, by which errors are estimated.
    let error = spectra.iter().map(|spectrum| spectrum.error).fold(0.0, f64::max);
    for (order, spectrum) in spectra.iter().enumerate() {
        let leading = spectrum.leading().map(|mode| mode.value);
        let key = format!("leading_growth_rate_{order}");
        summary.put(&key, leading.map(|value| value.re), "of disturbances that vary so often around the axis (1/time)");
        summary.put(&format!("leading_frequency_{order}"), leading.map(|value| value.im), "of that disturbance");
    }
    let verdict = Stability::of_parts(spectra.iter().map(|spectrum| spectrum.stability_within(error)));
    summary.put("stability", verdict.name(), "by the error of growth rates");
    summary.put("stable", verdict.decided(), "no disturbance grows; not defined if that is undecided");
    summary.put("growth_rate_error", error, "of growth rates (1/time); undecided: give more nodes");
    summary.put("residual", state.residual(), "largest rate of change left (1/time)");
    summary.put("tail", state.tail(), "of Fourier modes: above 1e-3 give more nodes");
    let directory = scene.output.directory("droplet_in_tube")?;
    summary.write(&directory.join("summary.json"))?;
    say(summary.table().trim_end());
    say(format_args!("results in {}", directory.display()));
    Ok(())
}

/// Runs the scene, through a constriction until it is clear what becomes of the droplet.
fn run(scene: &SceneFlags<TubeFlags>, setup: &Setup) -> Result<()> {
    let mut run = scene.watch(setup.build()?, setup, "droplet_in_tube")?;
    let mut passage = scene.region.passage().map(Passage::new);
    match &mut passage {
        Some(passage) => run.go(Some(passage))?,
        None => run.go(None)?,
    }
    let mut summary = run.summary()?;
    if let Some(passage) = &passage {
        passage.put(&mut summary);
    }
    summary.put("minimum_gap", run.scene.system().minimum_wall_gap(), "to the tube, over the run (R0)");
    run.finish(&summary)
}
