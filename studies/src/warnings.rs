//! Warnings of runs about their errors: scenes at default settings against resolved ones.
//!
//! `cargo run --release -p studies -- warnings` prints a table, which `--write` keeps as `docs/tables/warnings.csv`.

use anyhow::{Context, Result};
use motile::active_interface::observables::Observables;
use motile::base::{Drive, Region, Vec2};
use motile::scene::{Every, Warnings};
use motile::setup::{Built, DropletSetup, GridMethod, IntegralMethod, Method, Setup};
use motile_tests::validation::Table;

use crate::tables::{self, Measure};

/// Time to which the scenes are run.
const TIME: f64 = 8.0;

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

/// The observables of the droplet in the end, and the causes of the warnings on the way.
fn end(setup: &Setup, time: f64) -> Result<(Observables, String)> {
    let Built { mut scene, droplets, .. } = setup.build()?;
    let mut warnings = Warnings::default();
    scene.run(time).observe(Every::Steps(1), &mut warnings).go()?;
    let mut causes: Vec<String> = warnings.worst().iter().map(|(_, warning)| warning.cause.to_string()).collect();
    causes.sort_unstable();
    causes.dedup();
    Ok((scene.observe(droplets[0])?, causes.join(", ")))
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

pub(crate) fn run(keep: tables::Keep) -> Result<()> {
    let columns = "region | activity | viscosities | method | speed | error | largest | of | warned of";
    let title = "Warnings of scenes at default settings, the error of the speed, and the largest of all observables";
    let mut table = Table::new(title, columns);
    for scene in &SCENES {
        let (channel, activity, [inside, outside], spacing) = scene;
        let region = channel.map_or("box".to_owned(), |[length, width]| format!("channel {length} x {width}"));
        let method = spacing.map_or("integrals".to_owned(), |spacing| format!("grid {spacing}"));
        table.measure(format_args!("{region} | {activity} | {inside}/{outside} | {method}"), || {
            let setup = setup(scene);
            let (exact, _) = end(&Setup { method: RESOLVED, ..setup.clone() }, TIME)?;
            Ok(match end(&setup, TIME) {
                Ok((found, causes)) => {
                    let errors = errors(&found, &exact)?;
                    let larger =
                        |a: (&'static str, f64), b: &(&'static str, f64)| if b.1.abs() > a.1.abs() { *b } else { a };
                    let (name, largest) = errors.iter().fold(errors[0], larger);
                    let [error, largest] = [errors[0].1, largest].map(per_cent);
                    format!("{:.5} | {error} | {largest} | {name} | {causes}", found.speed())
                }
                Err(error) => format!(" |  |  |  | {error}"),
            })
        })?;
    }
    keep.tables("warnings", "warnings", &[table])
}
