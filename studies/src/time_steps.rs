//! Cost of time steps: Runge-Kutta-Chebyshev against the midpoint rule between stiff walls, the largest stable steps
//! against the predicted ones between walls and of swimmers, the order between halvings of the step, and adaptive
//! against fixed steps for a swimmer that starts, errors of the default steps in scenes of all kinds.
//!
//! `cargo run --release -p studies -- time_steps` prints six tables, which `--write` keeps as
//! `docs/tables/time-steps-STUDY.csv`. `--study` chooses one of them; `--help` lists the flags.

mod default_steps;

use std::time::Instant;

use anyhow::{Context, Result};
use clap::{Args, ValueEnum};
use motile::active_interface::{ActiveDroplet, Motion, observables::centroid_velocity, polygon_moments};
use motile::base::Region;
use motile::base::{Drive, Vec2};
use motile::elastic_solids::ChannelShape;
use motile::elastic_solids::Moduli;
use motile::scene::{
    Handle, Hydrodynamics, Scene, StepSize,
    checkpoint::Checkpoint,
    integrator::{Dynamics as _, Integrator, Midpoint, RungeKuttaChebyshev},
};
use motile::setup::{
    AnyFlow, Built, DropletSetup, GridMethod, IntegralMethod, LayersMethod, Material, Method, Setup, SolidSetup,
};
use motile_cli::command_line::positive;
use motile_tests::validation::Table;

use crate::tables;

/// Which table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Study {
    /// Cost at equal error between stiff walls.
    StiffWalls,
    /// Largest stable steps between stiff walls.
    Limits,
    /// Largest stable steps of swimmers, with and without the stabiliser of the coupling of concentration and tension.
    Coupling,
    /// Differences between halvings of the step and their orders, with and without stabiliser and filter.
    Order,
    /// Adaptive and fixed steps of a swimmer that starts.
    Transient,
    /// Errors of the default steps in scenes of all kinds.
    Default,
}

/// Cost of time steps.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Which table; without it all
    #[arg(long, value_enum)]
    study: Option<Study>,
    /// Time to which the stiff walls are simulated
    #[arg(long, default_value_t = 10.0, value_parser = positive)]
    time: f64,
    #[command(flatten)]
    keep: tables::Keep,
}

pub(crate) fn run(flags: &Flags) -> Result<()> {
    for study in Study::value_variants().iter().filter(|study| flags.study.is_none_or(|chosen| chosen == **study)) {
        let table = match study {
            Study::StiffWalls => stiff_walls(flags.time),
            Study::Limits => limits(),
            Study::Coupling => coupling(),
            Study::Order => orders(),
            Study::Transient => transient(),
            Study::Default => default_steps::default_steps(),
        }?;
        let name = study.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default();
        let (file, command) = (format!("time-steps-{name}"), format!("time_steps --study {name}"));
        flags.keep.tables(
            &file,
            &command,
            &["crates/elastic-solids", "studies/src/time_steps.rs", "studies/src/time_steps"],
            &[table],
        )?;
    }
    Ok(())
}

/// The activity of the droplet between stiff walls.
const ACTIVITY: f64 = -2.0;

type Channel = Scene<AnyFlow>;

/// Cowley's stiffest walls: k = 1e6, viscosity 10, width 2, with a droplet of this activity between them.
fn channel(integrator: impl Integrator, activity: f64) -> Result<(Channel, Handle<ActiveDroplet>)> {
    let shear = Moduli::from_thesis_spring_constant(1e6)?.shear();
    let walls = SolidSetup::walls(&ChannelShape::Straight { width: 2.0 }, &Material::Springs { shear });
    let setup = Setup {
        region: Region::Channel { length: 6.0, width: 5.0, drive: Drive::ZeroGradient },
        method: Method::Layers(LayersMethod::of_spacing(0.1)),
        viscosity: 10.0,
        droplets: vec![DropletSetup::active(activity)],
        solids: walls,
        ..Setup::default()
    };
    let Built { scene, droplets, .. } = setup.build()?;
    Ok((scene.advanced_by(integrator), droplets[0]))
}

/// Result of a run and its cost.
struct Cost {
    markers: Vec<Vec2>,
    steps: usize,
    taken_back: usize,
    evaluations: usize,
    seconds: f64,
}

fn timed<H: Hydrodynamics>(
    (mut scene, droplet): (Scene<H>, Handle<ActiveDroplet>),
    until: f64,
    step: StepSize,
) -> Result<Cost> {
    let start = Instant::now();
    scene.run(until).step_size(step).go()?;
    let report = scene.step_report();
    Ok(Cost {
        markers: scene.body(droplet)?.markers().to_vec(),
        steps: scene.steps(),
        taken_back: report.rejections + report.failures,
        evaluations: scene.system().hydrodynamics().work().evaluations,
        seconds: start.elapsed().as_secs_f64(),
    })
}

/// Errors of the centroid and of the shape (root mean square over the markers), lengths.
fn errors(cost: &Cost, exact: &Cost) -> Result<[f64; 2]> {
    let [own, other] = [&cost.markers, &exact.markers].map(|markers| polygon_moments(markers).map(|m| m.centroid));
    let (own, other) = (own?, other?);
    let squares = cost.markers.iter().zip(&exact.markers).map(|(a, b)| ((a - own) - (b - other)).length_squared());
    Ok([(own - other).length(), (squares.sum::<f64>() / exact.markers.len() as f64).sqrt()])
}

fn line(name: &str, step: &str, cost: &Cost, exact: &Cost) -> Result<[String; 8]> {
    let [place, shape] = errors(cost, exact)?.map(|error| format!("{error:.1e}"));
    let [steps, rejected, evaluations] = [cost.steps, cost.taken_back, cost.evaluations].map(|count| count.to_string());
    let seconds = format!("{:.1}", cost.seconds);
    Ok([name.to_owned(), step.to_owned(), steps, rejected, evaluations, seconds, place, shape])
}

const COLUMNS: [&str; 8] =
    ["method", "step", "steps", "rejected", "evaluations", "seconds", "error of position", "error of shape"];

fn stiff_walls(until: f64) -> Result<Table> {
    let title = format!("Walls k = 1e6, viscosity 10, width 2, h = 0.1, activity -2, to t = {until}");
    let mut table = Table::new(&title, &COLUMNS);
    let midpoint = |step| timed(channel(Midpoint::default(), ACTIVITY)?, until, step);
    let chebyshev = |step| timed(channel(RungeKuttaChebyshev::new(), ACTIVITY)?, until, step);
    let exact = midpoint(StepSize::OfLimit(REFERENCE))?;
    table.push(line("midpoint (reference)", &format!("{REFERENCE} of the limit"), &exact, &exact)?);
    for fraction in [0.9, 0.5, 0.25] {
        let cost = midpoint(StepSize::OfLimit(fraction))?;
        table.push(line("midpoint", &format!("{fraction} of the limit"), &cost, &exact)?);
    }
    for fraction in [0.9, 0.5] {
        let cost = chebyshev(StepSize::OfLimit(fraction))?;
        table.push(line("RKC", &format!("{fraction} of the limit"), &cost, &exact)?);
    }
    for tolerance in [1e-3, 1e-4, 1e-5] {
        let cost = chebyshev(StepSize::Adaptive { tolerance })?;
        table.push(line("RKC", &format!("adaptive {tolerance:.0e}"), &cost, &exact)?);
    }
    Ok(table)
}

/// Steps of the reference between stiff walls, as part of the midpoint rule's limit.
const REFERENCE: f64 = 0.125;

/// True if `steps` steps of `dt` from a slightly rough start stay bounded.
fn is_stable(integrator: impl Integrator, dt: f64, steps: usize) -> Result<bool> {
    let (mut scene, droplet) = channel(integrator, 0.0)?;
    let start = scene.body(droplet)?.markers().to_vec();
    for _ in 0..steps {
        if scene.step(dt).is_err() {
            return Ok(false);
        }
    }
    let moved = scene.body(droplet)?.markers().iter().zip(&start).map(|(a, b)| (a - b).length()).fold(0.0, f64::max);
    Ok(moved < 0.5)
}

fn limits() -> Result<Table> {
    let title = "Largest stable step between walls k = 1e6, viscosity 10, droplet without activity (60 steps stay \
                 bounded), over the predicted one";
    let mut table = Table::new(title, &["method", "predicted", "largest stable (tried 0.7 to 3 times)"]);
    let factors = [0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.3, 1.5, 1.7, 2.0, 2.5, 3.0];
    let predicted = |stages: Option<usize>| -> Result<f64> {
        let (scene, _) = channel(Midpoint::default(), 0.0)?;
        let rate = scene.system().fastest_decay();
        Ok(stages.map_or(2.0, |s| 0.6535 * (s * s - 1) as f64) / rate)
    };
    for stages in [None, Some(3), Some(5), Some(8), Some(12)] {
        let dt = predicted(stages)?;
        let mut largest = None;
        for factor in factors {
            let stable = match stages {
                None => is_stable(Midpoint::default(), factor * dt, 60)?,
                Some(s) => is_stable(RungeKuttaChebyshev::new().with_most_stages(s), factor * dt, 60)?,
            };
            if !stable {
                break;
            }
            largest = Some(factor);
        }
        let name = stages.map_or_else(|| "midpoint".to_owned(), |s| format!("RKC, {s} stages"));
        let found = largest.map_or_else(|| "below 0.7".to_owned(), |factor| format!("{factor}"));
        table.push([name, format!("{dt:.2e}"), found]);
    }
    Ok(table)
}

/// A swimmer's scene, its particles coupled with the stabiliser or without.
fn free(setup: &Setup, stabilised: bool) -> Result<Scene<AnyFlow>> {
    let mut scene = Scene::new(setup.flow()?).with_step_size(setup.step);
    scene.add(setup.droplet(&setup.droplets[0])?.with_stabiliser(stabilised));
    Ok(scene)
}

fn speed(scene: &mut Scene<AnyFlow>) -> Result<f64> {
    let markers = scene.system_mut().evaluate()?;
    Ok(centroid_velocity(markers.positions(), markers.velocities())?.length())
}

/// Steps that must keep a steady swimmer's speed to a part in a hundred.
const KEPT: usize = 150;

/// The limit of a steady swimmer, what sets it, and the largest step by which its speed is kept.
fn steady_limit(make: impl Fn() -> Result<Scene<AnyFlow>>, steady: &Checkpoint) -> Result<(f64, String, f64)> {
    let resumed = || -> Result<_> {
        let mut scene = make()?;
        scene.resume(steady)?;
        Ok(scene)
    };
    let mut scene = resumed()?;
    let expected = speed(&mut scene)?;
    let (limit, reason, _) = scene.step_limit().context("a droplet has a limit")?;
    let (limit, reason) = (limit, reason.to_owned());
    let mut largest = 0.0;
    let mut dt = 0.5 * limit;
    loop {
        let mut scene = resumed()?;
        let kept = (0..KEPT).all(|_| scene.step(dt).is_ok());
        if !kept || (speed(&mut scene)? / expected - 1.0).abs() > 0.01 {
            return Ok((limit, reason, largest));
        }
        largest = dt;
        dt *= 1.1;
    }
}

fn coupling() -> Result<Table> {
    let title = "Largest step that keeps the speed of a steady swimmer (viscosity 100, h = 0.1 or 48 nodes; 150 steps, \
                 to 1 %), over the predicted one";
    let columns = ["activity", "flow", "steps", "predicted", "set by", "largest/predicted"];
    let mut table = Table::new(title, &columns);
    for (flow, method) in [
        ("grid", Method::Grid(GridMethod::of_spacing(0.1))),
        ("integrals", Method::Integral(IntegralMethod { nodes: 48, elements: 192 })),
    ] {
        for activity in [-2.0, -4.0] {
            let base = Setup { method, droplets: vec![DropletSetup::active(activity)], ..Setup::default() };
            let mut scene = free(&base, true)?;
            scene.run(30.0).go()?;
            let steady = scene.checkpoint("");
            let results = [
                ("midpoint, no stabiliser", steady_limit(|| free(&base, false), &steady)?),
                ("midpoint", steady_limit(|| free(&base, true), &steady)?),
                ("RKC", steady_limit(|| Ok(free(&base, true)?.advanced_by(RungeKuttaChebyshev::new())), &steady)?),
            ];
            for (name, (limit, reason, largest)) in results {
                let times = format!("{:.1}", largest / limit);
                let key = [activity.to_string(), flow.to_owned(), name.to_owned()];
                table.push(key.into_iter().chain([format!("{limit:.4}"), reason, times]));
            }
        }
    }
    Ok(table)
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
    let mut table = Table::new(title, &["flow", "stabiliser", "filter", "positions", "numbers", "orders"]);
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
            let motion = Motion::Equidistributed { relaxation: 50.0, filter: filter != "off" };
            let droplets = vec![DropletSetup { motion, ..DropletSetup::default() }];
            let setup = Setup { method, droplets, ..Setup::default() };
            let [long, middle, short] = [0.004, 0.002, 0.001].map(|dt| after(&setup, stabilised, dt));
            let (long, middle, short) = (long?, middle?, short?);
            let change = |a: &[Vec<f64>; 2], b: &[Vec<f64>; 2]| [0, 1].map(|i| rms([&a[i], &b[i]]));
            let ([a, b], [c, d]) = (change(&long, &middle), change(&middle, &short));
            let orders = [(a / c).log2(), (b / d).log2()];
            let orders = format!("{:.2}, {:.2}", orders[0], orders[1]);
            table.push([flow, name, filter, &format!("{c:.1e}"), &format!("{d:.1e}"), &orders]);
        }
    }
    Ok(table)
}

fn transient() -> Result<Table> {
    let until = 10.0;
    let method = Method::Grid(GridMethod::of_spacing(0.1));
    let setup = Setup { method, droplets: vec![DropletSetup::active(-4.0)], ..Setup::default() };
    let midpoint = || setup.build().map(|Built { scene, droplets, .. }| (scene, droplets[0]));
    let title = format!("A swimmer of activity -4 starts, viscosity 100, h = 0.1, to t = {until}");
    let mut table = Table::new(&title, &COLUMNS);
    let exact = timed(midpoint()?, until, StepSize::Adaptive { tolerance: 1e-8 })?;
    table.push(line("midpoint (reference)", "adaptive 1e-8", &exact, &exact)?);
    for dt in [0.04, 0.02, 0.01, 0.005, 0.0025] {
        match timed(midpoint()?, until, StepSize::Fixed(dt)) {
            Ok(cost) => table.push(line("midpoint", &format!("{dt}"), &cost, &exact)?),
            Err(error) => table.push(["midpoint".to_owned(), dt.to_string(), error.to_string()]),
        }
    }
    for tolerance in [1e-4, 1e-5, 1e-6, 1e-7] {
        let cost = timed(midpoint()?, until, StepSize::Adaptive { tolerance })?;
        table.push(line("midpoint", &format!("adaptive {tolerance:.0e}"), &cost, &exact)?);
    }
    for tolerance in [1e-4, 1e-5, 1e-6] {
        let (scene, droplet) = midpoint().context("a swimmer")?;
        let cost =
            timed((scene.advanced_by(RungeKuttaChebyshev::new()), droplet), until, StepSize::Adaptive { tolerance })?;
        table.push(line("RKC", &format!("adaptive {tolerance:.0e}"), &cost, &exact)?);
    }
    Ok(table)
}
