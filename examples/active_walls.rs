//! A layer of fluid between two active walls: interfaces that are periodic along x and carry active particles.
//!
//! `cargo run --release --example active_walls` simulates two active interfaces in a periodic box, across the whole
//! length of which they reach, from a small perturbation to the pattern in which their particles gather. `--elastic
//! STRETCHING,BENDING` makes membranes of them, `--droplet active` or `passive` puts a droplet between them, `--width`
//! rigid walls beyond them. Prints what was measured and writes to `out/active_walls/`:
//!
//! * `final.png`, a picture of the final state;
//! * `trajectory.csv`, height, flux, modes of shape and concentration of both walls over time, `droplets.csv` the same
//!   of the droplet, and `summary.json`, the results;
//! * `vtk/`, files for ParaView.
//!
//! `--help` lists the flags.

use std::process::ExitCode;

use anyhow::{Result, ensure};
use clap::{Parser, ValueEnum};
use motile::active_interface::{Motion, observables::PeriodicObservables};
use motile::motile_base::{Drive, Region};
use motile::motile_scene::Every;
use motile::setup::{Built, DropletSetup, ElasticitySetup, InterfaceSetup, Particles, Setup, Side, Start};
use motile_examples::{DropletFlags, MethodFlags, activity, pair, positive};
use motile_output::run::{Job, OutputFlags, Summary};
use motile_output::{DropletsCsv, InterfacesCsv, Look, ParaView, Raster, Snapshot};

/// What is between the walls.
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
struct Flags {
    /// Activity of the particles on the walls, negative: contractile
    #[arg(long, default_value_t = -1.0, value_parser = activity, allow_hyphen_values = true)]
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
    /// What is between the walls
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

/// Rows of the tables and files for ParaView in a run.
const ROWS: f64 = 1000.0;
const FILES: f64 = 20.0;
/// Relative amplitude of the perturbation of the particles.
const PERTURBATION: f64 = 0.01;

fn main() -> ExitCode {
    motile_examples::run(simulate)
}

fn simulate(flags: &Flags) -> Result<()> {
    let setup = scene(flags)?;
    let Built { mut scene, droplets, interfaces, .. } = setup.build()?;
    let before = [0, 1].map(|k| scene.observe(interfaces[k]));
    let [lower, upper] = before;
    let before = [lower?, upper?];

    // The run, observed.
    let mut job = Job::new(&mut scene, &setup, flags.method.time, &flags.output, "active_walls")?;
    let mut table = InterfacesCsv::create(job.directory.join("trajectory.csv"), scene.system_mut())?;
    let path = job.directory.join("droplets.csv");
    let mut of_droplet = (!droplets.is_empty()).then(|| DropletsCsv::create(path, scene.system_mut())).transpose()?;
    let raster = Raster::of(scene.system(), 2.0 * flags.method.spacing(&setup))?;
    let mut files = job.draws().then(|| ParaView::create(job.directory.join("vtk"), raster)).transpose()?;
    let mut observers: Vec<motile_output::run::Watch<'_>> = vec![(Every::StepAfter(job.end / ROWS), &mut table)];
    if let Some(table) = &mut of_droplet {
        observers.push((Every::StepAfter(job.end / ROWS), table));
    }
    if let Some(files) = &mut files {
        observers.push((Every::StepAfter(job.end / FILES), files));
    }
    job.go(&mut scene, observers)?;

    // The results, also of a run that broke off.
    let mut summary = Summary::default();
    for ((name, handle), start) in ["lower", "upper"].into_iter().zip(&interfaces).zip(&before) {
        let seen = scene.observe(*handle)?;
        put(&mut summary, name, &seen, start, &setup);
    }
    if let Some(table) = &of_droplet {
        let rows = table.table();
        let last = |name: &str| Ok::<_, anyhow::Error>(rows.curve("time", name)?.last().map(|row| row.1));
        summary.put("droplet_speed", last("speed")?, "of its centroid, in the end (R0 per time)");
        let track = rows.curve("time", "x")?;
        let late = track.iter().find(|(time, _)| *time >= 0.5 * scene.time()).zip(track.last());
        let mean = late.map(|(first, last)| (last.1 - first.1) / (last.0 - first.0));
        summary.put("droplet_speed_along", mean, "along the walls, mean over the second half (R0 per time)");
        summary.put("droplet_height", last("y")?, "of its centroid, in the end (R0)");
    }
    summary.put("minimum_gap", scene.system().minimum_gap(), "between interfaces, over the run (R0)");
    summary.put("time", scene.time(), "simulated");
    summary.put("steps", scene.steps(), "");
    summary.put("evaluations", scene.system().work().evaluations, "of the flow");
    summary.put("seconds", job.seconds, "of computation");
    summary.put("warnings", job.warnings.clone(), "");
    summary.put("failure", job.failure(), "if the run broke off");
    let (draws, picture) = (job.draws(), job.directory.join("final.png"));
    job.finish(&summary, || {
        if draws {
            let raster = Raster::of(scene.system(), flags.method.spacing(&setup))?;
            let seen = Snapshot::take(scene.system_mut(), raster)?;
            let concentration = Some(Particles::default().concentration);
            let caption = format!("wall activity {}, gap {}", flags.wall_activity, flags.gap).replace('-', "−");
            Look { caption, concentration, ..Look::default() }.write_picture(&seen, &[], picture)?;
        }
        Ok(())
    })
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

/// Results of a wall.
fn put(summary: &mut Summary, name: &str, seen: &PeriodicObservables, start: &PeriodicObservables, setup: &Setup) {
    let mut put = |key: &str, value: f64, about: &str| summary.put(&format!("{name}_{key}"), value, about);
    put("height_change", seen.height - start.height, "of its mean height, since the start (R0)");
    put("length", seen.length, "over a period (R0)");
    put("particle_relative_change", seen.particle_number / start.particle_number - 1.0, "since the start");
    let c0 = setup.interfaces[0].particles.map_or(1.0, |particles| particles.concentration);
    let [most, least] = seen.concentration_range.unwrap_or([f64::NAN; 2]);
    put("concentration_max", most / c0, "in c0");
    put("concentration_min", least / c0, "in c0");
    put("height_mode", seen.height_modes.amplitude(1), "amplitude of the longest wave (R0)");
    put("concentration_mode", seen.concentration_modes.amplitude(1) / c0, "of the longest wave, in c0");
    put("flux", seen.flux, "of particles along x (1/time)");
}
