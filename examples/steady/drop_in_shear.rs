//! A drop without particles in a flow that is imposed from outside: shear, extension or Poiseuille flow.
//!
//! `cargo run --release --example drop_in_shear` deforms a drop at a capillary number of 0.2 in unbounded fluid, or
//! with `--box` in a sheared periodic one, prints its deformation, angle, speeds and stresslet, and writes to
//! `out/drop_in_shear/`:
//!
//! * `final.png`, a picture of the final state;
//! * `trajectory.csv`, all of these over time, and `summary.json`, the results.
//!
//! With `--steady` the steady shape is found by Newton's method, without a run, and whether it is stable. Lengths are
//! in radii of the drop, viscosities in that of the fluid around it, times in units of the inverse rate of the flow.
//! `--help` lists the flags.

use std::f64::consts::PI;
use std::process::ExitCode;

use anyhow::{Result, bail, ensure};
use clap::{Parser, ValueEnum};
use motile::active_interface::ActiveDroplet;
use motile::base::Region;
use motile::scene::{Deformation, Handle, System, integrator::IntegratorKind};
use motile::setup::{AnyFlow, Built, DropletSetup, FlowSetup, IntegralMethod, Method, PoiseuilleSetup, Setup};
use motile_cli::run::{CheckpointFlags, Job, OutputFlags, Summary, say};
use motile_examples::{pair, positive};
use motile_output::{CsvTable, Look, Raster, Snapshot};
use motile_steady_states::SteadyState;

/// Imposed flows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum FlowKind {
    /// Shear `u = (y, 0)`.
    Shear,
    /// Extension `u = (x, -y)`.
    Extension,
    /// Poiseuille flow `u = h/2 (1 - y^2/h^2)` of a half width h, with a shear rate of 1 at y = -h.
    Poiseuille,
}

/// A drop in a flow that is imposed from outside.
#[derive(Debug, Parser)]
#[command(after_help = "The default run takes 224 steps, 902 evaluations of the flow.")]
struct Flags {
    /// Imposed flow
    #[arg(long, value_enum, default_value_t = FlowKind::Shear)]
    flow: FlowKind,
    /// Viscosity of the drop over that of the fluid around it
    #[arg(long, default_value_t = 1.0, value_parser = positive, allow_hyphen_values = true)]
    viscosity_ratio: f64,
    /// Capillary number, viscosity outside times rate times radius over tension [default: 0.2; in an extension 0.1,
    /// where there is no steady drop of the fluid around it beyond 0.183]
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    capillary_number: Option<f64>,
    /// Sides of a periodic box, sheared; without it unbounded fluid
    #[arg(long = "box", value_name = "X,Y", value_parser = pair, allow_hyphen_values = true)]
    sides: Option<[f64; 2]>,
    /// Half width of the Poiseuille flow [default: 5]
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    half_width: Option<f64>,
    /// Place of the drop at the start [default: 0,0; in a Poiseuille flow 0,2]
    #[arg(long, value_name = "X,Y", value_parser = pair, allow_hyphen_values = true)]
    offset: Option<[f64; 2]>,
    /// Time of the run [default: 10]
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    time: Option<f64>,
    /// Nodes of the interface
    #[arg(long, default_value_t = 72)]
    nodes: usize,
    /// Steady shape by Newton's method, without a run
    #[arg(long)]
    steady: bool,
    #[command(flatten)]
    output: OutputFlags,
}

/// Half width of the Poiseuille flow and time of the run where none are given.
const HALF_WIDTH: f64 = 5.0;
const TIME: f64 = 10.0;
/// Cells of the picture along a side.
const CELLS: usize = 160;
/// Side of the square that a picture of unbounded fluid shows.
const VIEW: f64 = 8.0;
/// Columns of the trajectory.
const COLUMNS: [&str; 13] = [
    "time",
    "x",
    "y",
    "deformation",
    "angle",
    "deformation_by_extents",
    "angle_by_extents",
    "tip_speed",
    "largest_speed",
    "period",
    "stresslet_xx",
    "stresslet_xy",
    "area",
];

fn main() -> ExitCode {
    motile_examples::run(deform)
}

impl Flags {
    fn capillary_number(&self) -> f64 {
        self.capillary_number.unwrap_or(if self.flow == FlowKind::Extension { 0.1 } else { 0.2 })
    }

    /// Refuses flags without a meaning.
    fn check(&self) -> Result<()> {
        ensure!(
            self.half_width.is_none() || self.flow == FlowKind::Poiseuille,
            "--half-width is that of a Poiseuille flow: leave it out, or give --flow poiseuille"
        );
        let CheckpointFlags { checkpoint, resume, .. } = &self.output.checkpoints;
        let of_runs = [
            ("--offset", self.offset.is_some()),
            ("--time", self.time.is_some()),
            ("--rows", self.output.rows.is_some()),
            ("--checkpoint", checkpoint.is_some()),
            ("--resume", resume.is_some()),
        ];
        match of_runs.into_iter().find(|(_, given)| self.steady && *given) {
            Some((flag, _)) => bail!(
                "{flag} means nothing with --steady, which looks for a drop in the middle of the flow without a run: \
                 leave one of them out"
            ),
            None => Ok(()),
        }
    }

    fn setup(&self) -> Result<Setup> {
        let mut flow = FlowSetup::default();
        match self.flow {
            FlowKind::Shear => flow.shear = 1.0,
            FlowKind::Extension => flow.extension = 1.0,
            FlowKind::Poiseuille => {
                let half_width = self.half_width.unwrap_or(HALF_WIDTH);
                flow.poiseuille = Some(PoiseuilleSetup { speed: 0.5 * half_width, half_width });
            }
        }
        let usual = if self.flow == FlowKind::Poiseuille && !self.steady { [0.0, 2.0] } else { [0.0; 2] };
        let drop = DropletSetup {
            name: "drop".to_owned(),
            centre: self.offset.unwrap_or(usual),
            viscosity: Some(self.viscosity_ratio),
            area_constraint: true,
            ..DropletSetup::passive(1.0 / self.capillary_number())
        };
        self.check()?;
        let setup = Setup {
            region: self.sides.map_or(Region::Plane, |lengths| Region::Box { lengths }),
            viscosity: 1.0,
            flow,
            method: Method::Integral(IntegralMethod { nodes: self.nodes, elements: (3 * self.nodes).div_ceil(2) }),
            integrator: IntegratorKind::RungeKutta,
            droplets: vec![drop],
            ..Setup::default()
        };
        setup.check()?;
        Ok(setup)
    }
}

fn deform(flags: &Flags) -> Result<()> {
    let setup = flags.setup()?;
    if flags.steady { steady(flags, &setup) } else { run(flags, &setup) }
}

/// Angle in degrees; not a number for a round drop.
fn angle(radians: Option<f64>) -> f64 {
    radians.map_or(f64::NAN, f64::to_degrees)
}

/// Puts the deformation and the stresslet into a summary.
fn report(summary: &mut Summary, seen: &Deformation, [[xx, xy], _]: [[f64; 2]; 2]) {
    summary.put("deformation", seen.by_moments, "D = (L - B)/(L + B) by area moments");
    summary.put("angle", angle(seen.angle_of_moments), "of the long axis by area moments (degrees)");
    summary.put("deformation_by_extents", seen.by_extents, "D by the largest and smallest radius");
    summary.put("angle_by_extents", angle(seen.angle_of_extents), "of the largest radius (degrees)");
    summary.put("tip_speed", seen.tip_speed, "at the largest radius");
    summary.put("largest_speed", seen.largest_speed, "on the interface");
    summary.put("tip_curvature", seen.tip_curvature, "at the largest radius");
    summary.put("period", seen.period, "of a turn along the interface");
    summary.put("stresslet_xx", xx, "particle stress times area; positive raises the viscosity");
    summary.put("stresslet_xy", xy, "");
}

/// Finds the steady shape.
fn steady(flags: &Flags, setup: &Setup) -> Result<()> {
    flags.output.check("drop_in_shear", None)?;
    flags.output.write_scene(setup)?;
    let state = SteadyState::find(setup)?;
    let spectrum = state.spectrum()?;
    let mut summary = Summary::default();
    report(&mut summary, &state.deformation()?, state.particle_stress()?);
    summary.put("velocity", state.velocity().to_array().to_vec(), "of the centroid");
    summary.put("stability", spectrum.stability().name(), "by the error of growth rates");
    summary.put("stable", spectrum.stability().decided(), "no disturbance grows; not defined if that is undecided");
    summary.put("leading_growth_rate", spectrum.leading().map(|mode| mode.value.re), "of the slowest disturbance");
    summary.put("growth_rate_error", spectrum.error, "of growth rates; undecided: give more nodes");
    summary.put("residual", state.residual(), "largest rate of change left");
    summary.put("tail", state.tail(), "of Fourier modes: above 1e-3 give more nodes");
    let directory = flags.output.directory("drop_in_shear")?;
    summary.write(&directory.join("summary.json"))?;
    say(summary.table().trim_end());
    say(format_args!("results in {}", directory.display()));
    Ok(())
}

/// Runs the scene.
fn run(flags: &Flags, setup: &Setup) -> Result<()> {
    let Built { mut scene, droplets, .. } = setup.build()?;
    let drop = droplets[0];
    let mut job = Job::new(&mut scene, setup, flags.time.unwrap_or(TIME), &flags.output, "drop_in_shear")?;
    let path = job.directory.join("trajectory.csv");
    let mut table = CsvTable::of_run(path, &COLUMNS, scene.system_mut(), "drop")?;
    let mut record = |system: &mut System<AnyFlow>| -> Result<()> {
        let row = look(system, drop)?;
        Ok(table.push_state(system, &row)?)
    };
    job.go(&mut scene, vec![(job.each_row(), &mut record)])?;

    // The results, also of a run that broke off.
    let seen = scene.system_mut().deformation(drop)?;
    let stress = scene.system_mut().stresslets()?[0];
    let mut summary = Summary::default();
    report(&mut summary, &seen, stress);
    summary.put("centroid", seen.centroid.to_array().to_vec(), "of the drop");
    if flags.sides.is_some() {
        let stress = scene.system_mut().stress()?;
        summary.put("effective_viscosity", stress.effective_viscosity(), "of the box");
        summary.put("normal_difference", stress.normal_difference(), "of the mean stress of the box");
        summary.put("strain", scene.system().hydrodynamics().strain(), "of the images of the box");
    }
    summary.put("area_change", seen.area / PI - 1.0, "relative, since the start");
    job.put_cost(&mut summary, &scene);
    let (draws, picture) = (job.draws(), job.directory.join("final.png"));
    job.finish(&summary, || {
        if draws {
            let [x, y] = seen.centroid.to_array();
            let raster = match flags.sides {
                None => Raster::new([x - 0.5 * VIEW, y - 0.5 * VIEW], [VIEW; 2], [CELLS; 2], [false; 2])?,
                Some([along, _]) => Raster::of(scene.system(), along / CELLS as f64)?,
            };
            let seen = Snapshot::take(scene.system_mut(), raster)?;
            let caption = format!("Ca = {},  viscosity ratio {}", flags.capillary_number(), flags.viscosity_ratio);
            flags.output.look.apply(Look { caption, ..Look::of(setup) }).write_picture(&seen, &[], picture)?;
        }
        Ok(())
    })
}

/// A row of the trajectory; not a number where there is no period.
fn look(system: &mut System<AnyFlow>, drop: Handle<ActiveDroplet>) -> Result<[f64; 13]> {
    let seen = system.deformation(drop)?;
    let [[xx, xy], _] = system.stresslets()?[0];
    Ok([
        system.time(),
        seen.centroid.x,
        seen.centroid.y,
        seen.by_moments,
        angle(seen.angle_of_moments),
        seen.by_extents,
        angle(seen.angle_of_extents),
        seen.tip_speed,
        seen.largest_speed,
        seen.period.unwrap_or(f64::NAN),
        xx,
        xy,
        seen.area,
    ])
}
