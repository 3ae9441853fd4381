//! Warnings of runs about their errors: scenes at default settings against resolved ones.
//!
//! `cargo run --release -p studies -- warnings` prints two tables, of scenes of one droplet and of the scene files of
//! the examples and of the page. `--write` keeps them as `docs/tables/warnings.csv` and `docs/tables/warnings-2.csv`.

use std::fs;

use anyhow::{Context, Result};
use clap::Args;
use motile::active_interface::observables::Observables;
use motile::base::{Drive, Region, Vec2};
use motile::interior::DirectorStart;
use motile::scene::{Every, Warnings};
use motile::setup::{Built, DropletSetup, GridMethod, IntegralMethod, LayersMethod, Method, Setup, Start};
use motile_cli::command_line::positive;
use motile_tests::validation::Table;

use crate::tables;

/// Warnings of runs about their errors.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Time to which the scenes are run
    #[arg(long, default_value_t = 8.0, value_parser = positive)]
    time: f64,
    /// Number of scenes, from the first on
    #[arg(long, default_value_t = SCENES.len())]
    scenes: usize,
    /// Time to which the scene files are run
    #[arg(long, default_value_t = 20.0, value_parser = positive)]
    files_time: f64,
    /// Only scene files whose path has this text in it
    #[arg(long, default_value = "")]
    only: String,
    #[command(flatten)]
    keep: tables::Keep,
}

/// Length and width of a channel or none for a box of 6 x 6, activity, viscosities inside and outside, grid spacing or
/// none for boundary integrals.
type Scene = (Option<[f64; 2]>, f64, [f64; 2], Option<f64>);

const EQUAL: [f64; 2] = [100.0; 2];

const SCENES: [Scene; 20] = [
    (None, -1.0, EQUAL, None),
    (None, -4.0, EQUAL, Some(0.05)),
    (None, -6.0, [300.0, 1.0], None),
    (None, -9.0, EQUAL, None),
    (None, -9.0, EQUAL, Some(0.05)),
    (None, -4.0, [5.0, 100.0], Some(0.05)),
    (None, -4.0, [300.0, 30.0], Some(0.05)),
    (None, -4.0, EQUAL, Some(0.1)),
    (Some([6.0, 2.0]), -4.0, EQUAL, None),
    (Some([6.0, 2.0]), -4.0, EQUAL, Some(0.05)),
    (Some([6.0, 2.2]), -2.0, EQUAL, Some(0.05)),
    (Some([6.0, 2.2]), -6.0, EQUAL, None),
    (Some([6.0, 2.2]), -6.0, EQUAL, Some(0.05)),
    (Some([6.0, 2.2]), -8.0, [1000.0, 100.0], Some(0.1)),
    (Some([5.0, 3.0]), -6.0, EQUAL, None),
    (Some([6.0, 3.0]), -2.0, EQUAL, Some(0.1)),
    (Some([6.0, 3.0]), -6.0, EQUAL, Some(0.05)),
    (Some([36.0, 3.0]), -4.0, EQUAL, None),
    (Some([6.0, 5.0]), -8.0, EQUAL, None),
    (Some([6.0, 5.0]), -8.0, [5.0, 100.0], Some(0.1)),
];

/// The nodes and markers of resolved runs.
const RESOLVED: Method = Method::Integral(IntegralMethod { nodes: 112, elements: 448 });

/// A twentieth of the usual mean tension of a swimmer times its radius (force times length).
const SMALLEST_STRESSLET: f64 = 5.0;

fn setup(&(channel, activity, [inside, outside], spacing): &Scene) -> Setup {
    let region = channel.map_or(Region::Box { lengths: [6.0; 2] }, |[length, width]| Region::Channel {
        length,
        width,
        drive: Drive::ZeroGradient,
    });
    let viscosity = (inside != outside).then_some(inside);
    // There is no mobility correction beside another viscosity.
    let grid = if inside == outside { GridMethod::of_spacing } else { GridMethod::uncorrected };
    Setup {
        region,
        method: spacing.map_or(Method::default(), |spacing| Method::Grid(grid(spacing))),
        viscosity: outside,
        droplets: vec![DropletSetup { viscosity, ..DropletSetup::active(activity) }],
        ..Setup::default()
    }
}

/// The observables of all droplets in the end, and the causes of the warnings on the way.
fn ends(setup: &Setup, time: f64) -> Result<(Vec<Observables>, Vec<String>)> {
    let Built { mut scene, droplets, .. } = setup.build()?;
    let mut warnings = Warnings::default();
    scene.run(time).observe(Every::Steps(1), &mut warnings).go()?;
    let mut causes: Vec<String> = Vec::new();
    for (_, warning) in warnings.worst() {
        let cause = warning.cause.to_string();
        if !causes.contains(&cause) {
            causes.push(cause);
        }
    }
    let seen = droplets.iter().map(|&droplet| Ok(scene.observe(droplet)?)).collect::<Result<_>>()?;
    Ok((seen, causes))
}

/// As [`ends`], of the first droplet.
fn end(setup: &Setup, time: f64) -> Result<(Observables, Vec<String>)> {
    let (seen, causes) = ends(setup, time)?;
    Ok((seen.into_iter().next().context("no droplet")?, causes))
}

/// Errors of the observables relative to them; of the stresslet, which has two components, to its magnitude, or to a
/// twentieth of the tension times the radius if that is more; of the squirmer parameter to one if it is less.
fn errors(found: &Observables, exact: &Observables) -> Result<Vec<(&'static str, f64)>> {
    let names = ["speed", "aspect_ratio_moments", "perimeter", "concentration_max", "active_fraction", "beta"];
    let mut errors = Vec::new();
    for name in names {
        let value = |seen: &Observables| seen.get(name).with_context(|| format!("no {name}"));
        let (found, exact) = (value(found)?, value(exact)?);
        let unit = if name == "beta" { exact.abs().max(1.0) } else { exact.abs() };
        errors.push((name, (found - exact) / unit));
    }
    // In the axes of the region.
    let [a, b] = [found, exact].map(|seen| Vec2::from(seen.stresslet_in_laboratory[0]));
    errors.push(("stresslet", (a - b).length() / b.length().max(SMALLEST_STRESSLET)));
    Ok(errors)
}

fn per_cent(error: f64) -> String {
    format!("{:+.2} %", 100.0 * error)
}

/// True if the scene starts from noise at the nodes or elements of its bodies.
fn from_noise(setup: &Setup) -> bool {
    setup.droplets.iter().any(|droplet| {
        let particles = droplet.particles.as_ref().is_some_and(|own| matches!(own.start, Start::Perturbed { .. }));
        let noise = |start: &DirectorStart| matches!(start, DirectorStart::Uniform { noise, .. } if *noise > 0.0);
        particles || droplet.gel.as_ref().is_some_and(|gel| noise(&gel.start))
    })
}

pub(crate) fn run(flags: &Flags) -> Result<()> {
    let columns = ["region", "activity", "viscosities", "method", "speed", "error", "largest", "of", "warned of"];
    let title = "Warnings of scenes at default settings, the error of the speed, and the largest of all observables";
    let mut table = Table::new(title, &columns);
    for scene in SCENES.iter().take(flags.scenes) {
        let (channel, activity, [inside, outside], spacing) = scene;
        let setup = setup(scene);
        let (exact, _) = end(&Setup { method: RESOLVED, ..setup.clone() }, flags.time)?;
        let results = match end(&setup, flags.time) {
            Ok((found, causes)) => {
                let errors = errors(&found, &exact)?;
                let mut largest = errors[0];
                for error in &errors {
                    if error.1.abs() > largest.1.abs() {
                        largest = *error;
                    }
                }
                let (speed, error) = (format!("{:.5}", found.speed()), per_cent(errors[0].1));
                [speed, error, per_cent(largest.1), largest.0.to_owned(), causes.join(", ")]
            }
            Err(error) => [String::new(), String::new(), String::new(), String::new(), error.to_string()],
        };
        let region = channel.map_or("box".to_owned(), |[length, width]| format!("channel {length} x {width}"));
        let method = spacing.map_or("integrals".to_owned(), |spacing| format!("grid {spacing}"));
        let scene = [region, activity.to_string(), format!("{inside}/{outside}"), method];
        table.push(scene.into_iter().chain(results));
    }
    let inputs = ["studies/src/warnings.rs", "examples/scenes", "bindings/web/presets"];
    flags.keep.tables("warnings", "warnings", &inputs, &[table, files(flags)?])
}

/// The description with twice the resolution of the flow and of the interfaces.
fn refined(setup: &Setup) -> Setup {
    let method = match setup.method {
        Method::Integral(IntegralMethod { nodes, elements }) => {
            Method::Integral(IntegralMethod { nodes: 2 * nodes, elements: 2 * elements })
        }
        Method::Layers(LayersMethod { nodes, elements, spacing, kernel }) => {
            Method::Layers(LayersMethod { nodes: 2 * nodes, elements: 2 * elements, spacing: spacing / 2.0, kernel })
        }
        Method::Grid(grid) => Method::Grid(GridMethod { spacing: grid.spacing / 2.0, ..grid }),
        other => other,
    };
    Setup { method, ..setup.clone() }
}

/// Warnings of the scene files of the examples and of the page, beside their errors against runs of twice the
/// resolution.
fn files(flags: &Flags) -> Result<Table> {
    let columns = ["scene", "until", "speed", "largest", "of", "warned of"];
    let title = "Warnings of the scene files, and the differences of the speed and of all observables, of all \
                 droplets, from a run with twice the resolution (none where the start is noise, which has other values there)";
    let mut table = Table::new(title, &columns);
    for folder in ["examples/scenes", "bindings/web/presets"] {
        let entries = fs::read_dir(tables::root().join(folder))?.map(|entry| Ok(entry?.path()));
        let mut paths = entries.collect::<Result<Vec<_>>>()?;
        paths.retain(|path| path.to_string_lossy().contains(&flags.only));
        paths.sort();
        for path in paths {
            let setup = Setup::from_toml(&fs::read_to_string(&path)?).with_context(|| path.display().to_string())?;
            let name = format!("{folder}/{}", tables::name(&path));
            let [found, exact] = [&setup, &refined(&setup)].map(|setup| ends(setup, flags.files_time));
            let results = match (found, exact) {
                (Ok((_, causes)), Ok(_)) if from_noise(&setup) => {
                    [String::new(), String::new(), String::new(), causes.join(", ")]
                }
                (Ok((found, causes)), Ok((exact, _))) => {
                    let (mut speed, mut largest) = (0.0_f64, ("", 0.0_f64));
                    for (found, exact) in found.iter().zip(&exact) {
                        for error in errors(found, exact)? {
                            if error.1.abs() > largest.1.abs() {
                                largest = error;
                            }
                            if error.0 == "speed" && error.1.abs() > speed.abs() {
                                speed = error.1;
                            }
                        }
                    }
                    [per_cent(speed), per_cent(largest.1), largest.0.to_owned(), causes.join(", ")]
                }
                (Err(error), _) => [String::new(), String::new(), String::new(), error.to_string()],
                (_, Err(error)) => [String::new(), String::new(), String::new(), format!("refined: {error}")],
            };
            table.push([name, flags.files_time.to_string()].into_iter().chain(results));
        }
    }
    Ok(table)
}
