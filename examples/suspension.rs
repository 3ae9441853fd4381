//! Many active droplets in a periodic box or a channel.
//!
//! `cargo run --release --example suspension` puts sixteen droplets at random places, lets them swim through their
//! collisions, prints what they do together, and writes to `out/suspension/`:
//!
//! * `summary.json`, the results, and `suspension.csv`, the observables of all droplets over time;
//! * `members.csv`, place, heading and velocity of each droplet over time;
//! * `pairs.csv`, pair correlation and correlation of velocities over the distance, `diffusion.csv`, mean square
//!   displacement and correlation of headings over the time between two states, both of the second half of the run;
//! * `final.png`, a picture of the final state, `swim.gif`, an animation of the run, and `observables.png` and `.svg`,
//!   plots of the tables;
//! * with `--vtk-every`, `vtk/fields.pvd` and `vtk/interface.pvd`, the flow and the interfaces for ParaView.
//!
//! `--help` lists the flags; `--count 1000` takes no other ones. Several threads: `--features rayon`.

use std::f64::consts::TAU;
use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::{Context, Result, bail, ensure};
use clap::{Parser, ValueEnum};
use motile::analysis::suspension::rotational_diffusion;
use motile::base::{Drive, Region};
use motile::scene::Every;
use motile::scene::gap::Repulsion;
use motile::setup::{
    Arrangement, Built, Distribution, Headings, IntegralMethod, LayersMethod, Method, Setup, SuspensionSetup,
};
use motile_cli::run::{Job, OutputFlags, Summary};
use motile_examples::{DropletFlags, MethodFlags, distribution, not_negative, positive, scene_file};
use motile_output::suspension::{
    SuspensionAnimation, SuspensionColour, SuspensionCsv, SuspensionPicture, suspension_plots,
};
use motile_output::{CsvTable, ParaView, Raster};

/// Region of the suspension.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Kind {
    /// Square and periodic.
    Box,
    /// Between rigid walls, periodic along them.
    Channel,
}

/// Colours of the pictures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Colour {
    /// Headings of the droplets.
    Heading,
    /// Concentrations along the interfaces.
    Concentration,
}

impl From<Colour> for SuspensionColour {
    fn from(colour: Colour) -> Self {
        match colour {
            Colour::Heading => Self::Heading,
            Colour::Concentration => Self::Concentration,
        }
    }
}

/// Many active droplets in a periodic box or a channel.
#[derive(Debug, Parser)]
#[command(after_help = "The default run takes 2,666 steps, 5,333 evaluations of the flow.")]
struct Flags {
    /// Scene file (TOML) to start from, with suspensions or droplets; flags of the suspension and of the region are
    /// then left out
    #[arg(long = "scene", value_name = "FILE")]
    file: Option<PathBuf>,
    /// Number of droplets [default: 16]
    #[arg(long)]
    count: Option<usize>,
    /// Part of the region's area that they fill, which sets its size [default: 0.3]
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    area_fraction: Option<f64>,
    /// Region [default: box]
    #[arg(long, value_enum)]
    region: Option<Kind>,
    /// Distance of the walls of a channel (R0) [default: 10]
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    width: Option<f64>,
    /// Radius, or the least and the largest one (R0) [default: 1]
    #[arg(long, value_name = "RADIUS[,MOST]", value_parser = distribution, allow_hyphen_values = true)]
    radius: Option<Distribution>,
    /// Activity, or the least and the largest one [default: -2]
    #[arg(long, value_name = "ACTIVITY[,MOST]", value_parser = distribution, allow_hyphen_values = true)]
    activity: Option<Distribution>,
    /// Viscosity of the droplets, or the least and the largest one [default: that of the fluid]
    #[arg(long, value_name = "VISCOSITY[,MOST]", value_parser = distribution, allow_hyphen_values = true)]
    viscosity_in: Option<Distribution>,
    /// Viscosity of the exterior fluid [default: 100]
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    viscosity: Option<f64>,
    /// All of them start in this direction (degrees from the x axis); without it in random ones
    #[arg(long, allow_hyphen_values = true)]
    aligned: Option<f64>,
    /// Start on a lattice
    #[arg(long)]
    lattice: bool,
    /// Least gap at the start (R0) [default: 0.05]
    #[arg(long, value_parser = not_negative, allow_hyphen_values = true)]
    gap: Option<f64>,
    /// Seed of places, headings and values [default: 1]
    #[arg(long)]
    seed: Option<u64>,
    /// Relative accuracy of the flow [default: 1e-6]
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    tolerance: Option<f64>,
    /// Film that a repulsion holds against the capillary pressure of a droplet (R0), 0 for none [default: the distance
    /// of nodes of the smallest droplet, which they resolve]
    #[arg(long, value_parser = not_negative, allow_hyphen_values = true, conflicts_with = "repulsion")]
    film: Option<f64>,
    /// Gap below which droplets are in contact (R0)
    #[arg(long, default_value_t = 0.2, value_parser = positive, allow_hyphen_values = true)]
    contact: f64,
    /// Meaning of the colours of pictures
    #[arg(long, value_enum, default_value_t = Colour::Heading)]
    colour: Colour,
    /// Files for ParaView, so far apart (time) [default: none]
    #[arg(long, value_name = "TIME", value_parser = positive, allow_hyphen_values = true)]
    vtk_every: Option<f64>,
    #[command(flatten)]
    method: MethodFlags,
    #[command(flatten)]
    output: OutputFlags,
}

/// Rows of the tables of a run.
const ROWS: f64 = 200.0;
/// Frames of the animation, their width and that of the picture (pixels).
const FRAMES: f64 = 60.0;
const FILM: f64 = 480.0;
const PICTURE: f64 = 1200.0;
/// Cells of the flow in files for ParaView along the longer side of the region.
const CELLS: f64 = 256.0;
/// Bins of pair correlations, and their reach (R0).
const BIN: f64 = 0.1;
const REACH: f64 = 20.0;
/// Accuracy of the flow.
const TOLERANCE: f64 = 1e-6;

fn main() -> ExitCode {
    motile_examples::run(simulate)
}

fn simulate(flags: &Flags) -> Result<()> {
    flags.output.check("suspension", flags.file.as_deref())?;
    let setup = scene(flags)?;
    let Built { mut scene, .. } = setup.build()?;

    // The run, observed.
    let mut job = Job::new(&mut scene, &setup, flags.method.time, &flags.output, "suspension")?;
    let mut tables = SuspensionCsv::create(&job.directory, scene.system_mut(), flags.contact)?;
    let mut film = SuspensionAnimation::new(flags.colour.into(), FILM);
    let mut observers: Vec<motile_cli::run::Watch<'_>> = vec![(Every::StepAfter(job.end / ROWS), &mut tables)];
    if job.draws() {
        observers.push((Every::StepAfter(job.end / FRAMES), &mut film));
    }
    let mut files = None;
    if let Some(interval) = flags.vtk_every {
        let raster = Raster::of(scene.system(), longer_side(&setup.region) / CELLS)?;
        let files = files.insert(ParaView::create(job.directory.join("vtk"), raster)?);
        observers.push((Every::Time(interval), files));
    }
    job.go(&mut scene, observers)?;

    // The results, also of a run that broke off.
    let half = 0.5 * scene.time();
    let diffusion = tables.diffusion(half);
    let mut table = CsvTable::create(
        job.directory.join("diffusion.csv"),
        &["lag", "mean_square_displacement", "heading_correlation"],
    )?;
    diffusion.iter().try_for_each(|row| table.push(row))?;
    let pairs = tables.pairs(&setup.region, half, BIN, REACH);
    let mut table =
        CsvTable::create(job.directory.join("pairs.csv"), &["distance", "pair_correlation", "velocity_correlation"])?;
    for (k, distance) in pairs.distances.iter().enumerate() {
        table.push(&[*distance, pairs.pairs[k], pairs.velocities[k]])?;
    }
    let correlation: Vec<f64> = diffusion.iter().map(|row| row[2]).collect();
    let most = |column: &str| {
        Ok::<_, anyhow::Error>(tables.table().curve("time", column)?.iter().map(|row| row.1).fold(0.0, f64::max))
    };
    let interval = diffusion.get(1).map_or(0.0, |row| row[0]);
    let evaluations = scene.system().work().evaluations;
    let mut summary = Summary::default();
    summary.put("droplets", setup.placed()?.droplets.len(), "");
    summary.put("area_fraction", setup.filled()?, "of the droplets at the start");
    for (name, column, about) in [
        ("polar_order", "polar_order", "of their headings, in the end"),
        ("nematic_order", "nematic_order", "of their headings, in the end"),
        ("speed", "speed", "mean, in the end (R0 per time)"),
        ("mean_square_displacement", "square_displacement", "since the start (R0^2)"),
        ("contacts", "contacts", "pairs closer than --contact, in the end"),
        ("largest_cluster", "largest_cluster", "droplets in contact, in the end"),
        ("film", "film", "mean of those that the repulsion holds, in the end (R0)"),
        ("film_pressure", "film_pressure", "largest on one, in the end"),
        ("contact_stress", "contact_stress", "pressure that the repulsion transmits in a box, in the end"),
    ] {
        summary.put(name, tables.last(column), about);
    }
    for (name, column) in [("largest_area_change", "area_change"), ("largest_particle_change", "particle_change")] {
        summary.put(name, most(column)?, "of a droplet, relative, over the run");
    }
    summary.put("rotational_diffusion", rotational_diffusion(&correlation, interval), "second half (1/time)");
    summary.put("smallest_gap", scene.system().minimum_gap(), "between interfaces and to walls, over the run (R0)");
    let repulsion = setup.repulsion.map(|repulsion| vec![repulsion.strength(), repulsion.range()]);
    summary.put("repulsion", repulsion, "strength and range, if there was one");
    summary.put("time", scene.time(), "simulated");
    summary.put("steps", scene.steps(), "");
    summary.put("rejected_steps", scene.step_report().rejections + scene.step_report().failures, "");
    let limiting = scene.step_report().most_limiting().map(|limiting| limiting.reason.clone());
    summary.put("steps_set_by", limiting, "mostly");
    summary.put("evaluations", evaluations, "of the flow");
    summary.put("seconds", job.seconds, "of computation");
    summary.put("seconds_per_evaluation", job.seconds / evaluations as f64, "all that a run does included");
    summary.put("warnings", job.warnings.clone(), "");
    summary.put("finished", job.failure().is_none(), "");
    summary.put("failure", job.failure(), "if the run broke off");
    let draws = job.draws();
    let directory = job.directory.clone();
    let [picture, animation] = ["final.png", "swim.gif"].map(|name| job.directory.join(name));
    job.finish(&summary, || {
        if draws {
            SuspensionPicture::take(scene.system_mut())?.write_picture(flags.colour.into(), PICTURE, picture)?;
            film.write(animation)?;
            suspension_plots(&tables, half, &pairs)?.write(&directory, "observables")?;
        }
        Ok(())
    })
}

/// The longer side of a box or channel (length); other regions have none, which the raster refuses.
fn longer_side(region: &Region) -> f64 {
    match *region {
        Region::Box { lengths: [lx, ly] } => lx.max(ly),
        Region::Channel { length, width, .. } => length.max(width),
        _ => 1.0,
    }
}

/// The scene of the file, or that which the flags describe.
fn scene(flags: &Flags) -> Result<Setup> {
    let own = [
        ("count", flags.count.is_some()),
        ("area-fraction", flags.area_fraction.is_some()),
        ("region", flags.region.is_some()),
        ("width", flags.width.is_some()),
        ("radius", flags.radius.is_some()),
        ("activity", flags.activity.is_some()),
        ("viscosity-in", flags.viscosity_in.is_some()),
        ("aligned", flags.aligned.is_some()),
        ("lattice", flags.lattice),
        ("gap", flags.gap.is_some()),
        ("seed", flags.seed.is_some()),
    ];
    let file = flags.file.as_deref().map(scene_file).transpose()?;
    let given = file.is_some();
    if let (true, Some((name, _))) = (given, own.iter().find(|(_, given)| *given)) {
        bail!("--{name} and --scene say how the suspension starts: give one of them");
    }
    let base = file.unwrap_or_else(|| Setup { droplets: Vec::new(), ..Setup::default() });
    let viscosity = DropletFlags { viscosity: flags.viscosity, ..DropletFlags::default() };
    let mut setup = flags.method.setup(&viscosity, Some(base))?;
    setup.tolerance = flags.tolerance.or(setup.tolerance).or((!given).then_some(TOLERANCE));
    if given {
        return Ok(setup);
    }
    let usual = SuspensionSetup::default();
    let suspension = SuspensionSetup {
        count: flags.count.or(Some(16)),
        radius: flags.radius,
        activity: flags.activity,
        viscosity: flags.viscosity_in,
        headings: flags.aligned.map_or(usual.headings, |angle| Headings::Aligned(angle.to_radians())),
        arrangement: if flags.lattice { Arrangement::Lattice } else { usual.arrangement },
        gap: flags.gap.unwrap_or(usual.gap),
        seed: flags.seed.unwrap_or(usual.seed),
        ..usual
    };
    ensure!(suspension.count != Some(0), "--count 0: give a number above 0");
    let least = suspension.radius.map_or(1.0, |radius| radius.bounds()[0]);
    ensure!(least > 0.0, "--radius {least}: give radii above 0");
    // The region has the size at which the droplets fill that part of its area.
    let fraction = flags.area_fraction.unwrap_or(0.3);
    ensure!(fraction < 0.9, "--area-fraction {fraction}: no places are found for so many, give at most 0.6 or so");
    let area = suspension.area() / fraction;
    setup.region = match flags.region.unwrap_or(Kind::Box) {
        Kind::Box => {
            ensure!(flags.width.is_none(), "--width is that of a channel: leave it out, or give --region channel");
            Region::Box { lengths: [area.sqrt(); 2] }
        }
        Kind::Channel => {
            let width = flags.width.unwrap_or(10.0);
            Region::Channel { length: area / width, width, drive: Drive::ZeroGradient }
        }
    };
    if setup.repulsion.is_none() && flags.film != Some(0.0) {
        setup.repulsion = Some(repulsion(flags.film, &suspension, &setup)?);
    }
    setup.suspension = vec![suspension];
    setup.check().context("the suspension")?;
    Ok(setup)
}

/// The repulsion that holds a film against the capillary pressure of a droplet.
fn repulsion(film: Option<f64>, suspension: &SuspensionSetup, setup: &Setup) -> Result<Repulsion> {
    let bounds = |values: Option<Distribution>, usual: f64| values.map_or([usual; 2], Distribution::bounds);
    let [radius, _] = bounds(suspension.radius, 1.0);
    let particles = suspension.droplet.particles.unwrap_or_default();
    let activity = bounds(suspension.activity, particles.activity).into_iter().map(f64::abs).fold(0.0, f64::max);
    let nodes = match setup.method {
        Method::Integral(IntegralMethod { nodes, .. }) | Method::Layers(LayersMethod { nodes, .. }) => nodes,
        _ => IntegralMethod::default().nodes,
    };
    let pressure = (suspension.droplet.tension + activity * particles.concentration) / radius;
    Ok(Repulsion::holding(film.unwrap_or(TAU * radius / nodes as f64), pressure)?)
}
