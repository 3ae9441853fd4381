//! Errors of time steps: the order between halvings of the step, adaptive against fixed steps for a swimmer that
//! starts, and errors of the default steps in scenes of all kinds.
//!
//! `cargo run --release -p studies -- time_steps` prints three tables, which `--write` keeps as
//! `docs/tables/time-steps-STUDY.csv`. `--study` chooses one of them; `--help` lists the flags.

mod default_steps;

use anyhow::{Context, Result};
use clap::{Args, builder::PossibleValuesParser};
use motile::active_interface::{ActiveDroplet, Motion, polygon_moments};
use motile::base::Vec2;
use motile::scene::{Handle, Hydrodynamics, Scene, StepSize, integrator::RungeKuttaChebyshev};
use motile::setup::{AnyFlow, Built, DropletSetup, GridMethod, IntegralMethod, Method, Setup};
use motile_tests::validation::Table;

use crate::tables::{self, Measure, Once};

/// Makes a table.
type Run = fn() -> Result<Table>;

/// The tables by their names.
const STUDIES: [(&str, Run); 3] =
    [("order", orders), ("transient", transient), ("default", default_steps::default_steps)];

/// Errors of time steps.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Which table; without it all
    #[arg(long, value_parser = PossibleValuesParser::new(STUDIES.map(|(name, _)| name)))]
    study: Option<String>,
    #[command(flatten)]
    keep: tables::Keep,
}

pub(crate) fn run(flags: &Flags) -> Result<()> {
    for (name, table) in STUDIES.into_iter().filter(|(name, _)| flags.study.as_deref().is_none_or(|one| one == *name)) {
        let (file, command) = (format!("time-steps-{name}"), format!("time_steps --study {name}"));
        flags.keep.tables(&file, &command, &[table()?])?;
    }
    Ok(())
}

/// Result of a run and its cost.
struct Cost {
    markers: Vec<Vec2>,
    steps: usize,
    taken_back: usize,
    evaluations: usize,
}

fn timed<H: Hydrodynamics>(
    (mut scene, droplet): (Scene<H>, Handle<ActiveDroplet>),
    until: f64,
    step: StepSize,
) -> Result<Cost> {
    scene.run(until).step_size(step).go()?;
    let report = scene.step_report();
    Ok(Cost {
        markers: scene.body(droplet)?.markers().to_vec(),
        steps: scene.steps(),
        taken_back: report.rejections + report.failures,
        evaluations: scene.system().hydrodynamics().work().evaluations,
    })
}

/// Errors of the centroid and of the shape (root mean square over the markers), lengths.
fn errors(cost: &Cost, exact: &Cost) -> Result<[f64; 2]> {
    let [own, other] = [&cost.markers, &exact.markers].map(|markers| polygon_moments(markers).map(|m| m.centroid));
    let (own, other) = (own?, other?);
    let squares = cost.markers.iter().zip(&exact.markers).map(|(a, b)| ((a - own) - (b - other)).length_squared());
    Ok([(own - other).length(), (squares.sum::<f64>() / exact.markers.len() as f64).sqrt()])
}

fn cells(cost: &Cost, exact: &Cost) -> Result<String> {
    let [place, shape] = errors(cost, exact)?;
    let Cost { steps, taken_back, evaluations, .. } = cost;
    Ok(format!("{steps} | {taken_back} | {evaluations} | {place:.1e} | {shape:.1e}"))
}

const COLUMNS: &str = "method | step | steps | rejected | evaluations | error of position | error of shape";

/// A swimmer's scene, its particles coupled with the stabiliser or without.
fn free(setup: &Setup, stabilised: bool) -> Result<Scene<AnyFlow>> {
    let mut scene = Scene::new(setup.flow()?).with_step_size(setup.step);
    scene.add(setup.droplet(&setup.droplets[0])?.with_stabiliser(stabilised));
    Ok(scene)
}

/// Positions of the markers and particle numbers, these over their mean, of a swimmer after a time of 1.6.
fn after(setup: &Setup, stabilised: bool, dt: f64) -> Result<[Vec<f64>; 2]> {
    let mut scene = free(setup, stabilised)?;
    scene.run(1.6).step_size(StepSize::Fixed(dt)).go()?;
    let (_, droplet) = scene.system().bodies::<ActiveDroplet>().next().context("a swimmer")?;
    let numbers = droplet.particle_numbers();
    let mean = numbers.iter().sum::<f64>() / numbers.len() as f64;
    let positions = droplet.markers().iter().copied().flat_map(Vec2::to_array).collect();
    Ok([positions, numbers.iter().map(|number| number / mean).collect()])
}

fn orders() -> Result<Table> {
    let title = "A swimmer of activity -2 starts, viscosity 100, to t = 1.6: root mean square changes of marker \
                 positions and of particle numbers (over their mean) when the step is halved to 0.001, and the orders \
                 of the last two halvings";
    let mut table = Table::new(title, "flow | stabiliser | filter | positions | numbers | orders");
    let rms =
        |[a, b]: [&[f64]; 2]| (a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / a.len() as f64).sqrt();
    let grid = Method::Grid(GridMethod::of_spacing(0.2));
    let integrals = |elements| Method::Integral(IntegralMethod { nodes: 72, elements });
    let flows = [("grid 0.2", grid, "on"), ("grid 0.2", grid, "off")];
    let flows = flows.into_iter().chain([
        ("integrals, 72 elements", integrals(72), "none"),
        ("integrals, 288 elements", integrals(288), "none"),
    ]);
    for (flow, method, filter) in flows {
        for (stabilised, name) in [(true, "on"), (false, "off")] {
            table.measure(format_args!("{flow} | {name} | {filter}"), || {
                let motion = Motion::Equidistributed { relaxation: 50.0, filter: filter != "off" };
                let droplets = vec![DropletSetup { motion, ..DropletSetup::default() }];
                let setup = Setup { method, droplets, ..Setup::default() };
                let [long, middle, short] = [0.004, 0.002, 0.001].map(|dt| after(&setup, stabilised, dt));
                let (long, middle, short) = (long?, middle?, short?);
                let change = |a: &[Vec<f64>; 2], b: &[Vec<f64>; 2]| [0, 1].map(|i| rms([&a[i], &b[i]]));
                let ([a, b], [c, d]) = (change(&long, &middle), change(&middle, &short));
                Ok(format!("{c:.1e} | {d:.1e} | {:.2}, {:.2}", (a / c).log2(), (b / d).log2()))
            })?;
        }
    }
    Ok(table)
}

fn transient() -> Result<Table> {
    let until = 10.0;
    let method = Method::Grid(GridMethod::of_spacing(0.1));
    let setup = Setup { method, droplets: vec![DropletSetup::active(-4.0)], ..Setup::default() };
    let run = |chebyshev: bool, step| -> Result<Cost> {
        let Built { scene, droplets, .. } = setup.build()?;
        let scene = if chebyshev { scene.advanced_by(RungeKuttaChebyshev::new()) } else { scene };
        timed((scene, droplets[0]), until, step)
    };
    let title = format!("A swimmer of activity -4 starts, viscosity 100, h = 0.1, to t = {until}");
    let mut table = Table::new(&title, COLUMNS);
    let found = Once::new();
    let exact = || found.get(|| run(false, StepSize::Adaptive { tolerance: 1e-8 }));
    table.measure("midpoint (reference) | adaptive 1e-8", || cells(exact()?, exact()?))?;
    for dt in [0.04, 0.02, 0.01, 0.005, 0.0025] {
        table.measure(format_args!("midpoint | {dt}"), || match run(false, StepSize::Fixed(dt)) {
            Ok(cost) => cells(&cost, exact()?),
            Err(error) => Ok(format!("{error} |  |  |  | ")),
        })?;
    }
    for (name, chebyshev, tolerances) in
        [("midpoint", false, &[1e-4, 1e-5, 1e-6, 1e-7][..]), ("RKC", true, &[1e-4, 1e-5, 1e-6])]
    {
        for &tolerance in tolerances {
            table.measure(format_args!("{name} | adaptive {tolerance:.0e}"), || {
                cells(&run(chebyshev, StepSize::Adaptive { tolerance })?, exact()?)
            })?;
        }
    }
    Ok(table)
}
