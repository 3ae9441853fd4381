//! What time steps cost: Runge-Kutta-Chebyshev against the midpoint rule between stiff walls, the largest stable steps
//! against the predicted ones, and adaptive against fixed steps for a swimmer that starts.
//!
//! `cargo run --release --example time_steps` prints three tables and writes them to `out/time_steps/tables.md`.
//! `--study` chooses one of them; `--help` lists the flags.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use anyhow::{Context, Result};
use clap::{Parser, ValueEnum};
use motile::active_interface::{ActiveDroplet, polygon_moments};
use motile::elastic_solids::Moduli;
use motile::ib_core::{Handle, Hydrodynamics, Integrator, Midpoint, RungeKuttaChebyshev, Scene, StepSize, Vec2};
use motile::{AnyFlow, ElasticChannel, Method, Swimmer};
use support::{make_directory, positive, say};

/// Which table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Study {
    /// Cost at equal error between stiff walls.
    StiffWalls,
    /// Largest stable steps.
    Limits,
    /// Adaptive and fixed steps of a swimmer that starts.
    Transient,
}

/// What time steps cost.
#[derive(Debug, Parser)]
struct Flags {
    /// Which table; without it all
    #[arg(long, value_enum)]
    study: Option<Study>,
    /// Time to which the stiff walls are simulated
    #[arg(long, default_value_t = 10.0, value_parser = positive)]
    time: f64,
    /// Directory of the results
    #[arg(long, value_name = "DIRECTORY", default_value = "out/time_steps")]
    out: PathBuf,
}

fn main() -> ExitCode {
    support::run(study)
}

fn study(flags: &Flags) -> Result<()> {
    make_directory(&flags.out)?;
    let mut report = String::new();
    let wanted = |study| flags.study.is_none_or(|chosen| chosen == study);
    if wanted(Study::Limits) {
        limits(&mut report)?;
    }
    if wanted(Study::Transient) {
        transient(&mut report)?;
    }
    if wanted(Study::StiffWalls) {
        stiff_walls(flags.time, &mut report)?;
    }
    std::fs::write(flags.out.join("tables.md"), report)?;
    say(format_args!("results in {}", flags.out.display()));
    Ok(())
}

fn tell(report: &mut String, line: impl std::fmt::Display) -> Result<()> {
    say(&line);
    Ok(writeln!(report, "{line}")?)
}

/// The activity of the droplet between stiff walls.
const ACTIVITY: f64 = -2.0;

type Channel<I> = Scene<AnyFlow, I>;

/// The thesis' stiffest walls: k = 1e6, viscosity 10, width 2, with a droplet of this activity between them.
fn channel<I: Integrator>(integrator: I, activity: f64) -> Result<(Channel<I>, Handle<ActiveDroplet>)> {
    let swimmer = Swimmer { activity, viscosity: 10.0, spacing: 0.1, lengths: [6.0, 2.0], ..Swimmer::default() };
    let moduli = Moduli::from_thesis_spring_constant(1e6)?;
    let (scene, droplet, _) = ElasticChannel::new(swimmer, moduli).build()?;
    Ok((scene.advanced_by(integrator), droplet))
}

/// What a run came to and what it cost.
struct Cost {
    markers: Vec<Vec2>,
    steps: usize,
    taken_back: usize,
    evaluations: usize,
    seconds: f64,
}

fn run<H: Hydrodynamics, I: Integrator>(
    (mut scene, droplet): (Scene<H, I>, Handle<ActiveDroplet>),
    until: f64,
    step: StepSize,
) -> Result<Cost> {
    let start = Instant::now();
    scene.run(until).step_size(step).go()?;
    let report = scene.step_report();
    Ok(Cost {
        markers: scene.body(droplet).markers().to_vec(),
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
    let squares = cost.markers.iter().zip(&exact.markers).map(|(a, b)| ((a - own) - (b - other)).norm_squared());
    Ok([(own - other).norm(), (squares.sum::<f64>() / exact.markers.len() as f64).sqrt()])
}

fn line(name: &str, step: &str, cost: &Cost, exact: &Cost) -> Result<String> {
    let [place, shape] = errors(cost, exact)?;
    let Cost { steps, taken_back, evaluations, seconds, .. } = cost;
    Ok(format!(
        "| {name} | {step} | {steps} | {taken_back} | {evaluations} | {seconds:.1} | {place:.1e} | {shape:.1e} |"
    ))
}

const HEADING: &str = "| method | step | steps | taken back | evaluations | seconds | error of position | error of shape |\n\
                       |---|---|---|---|---|---|---|---|";

fn stiff_walls(until: f64, report: &mut String) -> Result<()> {
    tell(
        report,
        format_args!("\nWalls k = 1e6, viscosity 10, width 2, h = 0.1, activity -2, to t = {until}:\n\n{HEADING}"),
    )?;
    let rkc = RungeKuttaChebyshev::new;
    let exact = run(channel(rkc(), ACTIVITY)?, until, StepSize::Fixed(5e-4))?;
    tell(report, line("RKC (reference)", "0.0005", &exact, &exact)?)?;
    for dt in [2e-3, 4e-3, 8e-3, 1.2e-2] {
        match run(channel(rkc(), ACTIVITY)?, until, StepSize::Fixed(dt)) {
            Ok(cost) => tell(report, line("RKC", &format!("{dt}"), &cost, &exact)?)?,
            Err(error) => tell(report, format_args!("| RKC | {dt} | {error} |"))?,
        }
    }
    for tolerance in [1e-4, 1e-5, 1e-6] {
        let cost = run(channel(rkc(), ACTIVITY)?, until, StepSize::Adaptive { tolerance })?;
        tell(report, line("RKC", &format!("adaptive {tolerance:.0e}"), &cost, &exact)?)?;
    }
    for fraction in [0.9, 0.5] {
        let cost = run(channel(Midpoint::default(), ACTIVITY)?, until, StepSize::OfLimit(fraction))?;
        tell(report, line("midpoint", &format!("{fraction} of the limit"), &cost, &exact)?)?;
    }
    Ok(())
}

/// Whether `steps` steps of `dt` from a slightly rough start stay bounded.
fn is_stable<I: Integrator>(integrator: I, dt: f64, steps: usize) -> Result<bool> {
    let (mut scene, droplet) = channel(integrator, 0.0)?;
    let start = scene.body(droplet).markers().to_vec();
    for _ in 0..steps {
        if scene.step(dt).is_err() {
            return Ok(false);
        }
    }
    let moved = scene.body(droplet).markers().iter().zip(&start).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    Ok(moved < 0.5)
}

fn limits(report: &mut String) -> Result<()> {
    tell(
        report,
        "Largest stable step between walls k = 1e6, viscosity 10, droplet without activity (60 steps stay bounded), over the predicted one:\n\n\
         | method | predicted | largest stable (tried 0.7 to 3 times) |\n|---|---|---|",
    )?;
    let factors = [0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.3, 1.5, 1.7, 2.0, 2.5, 3.0];
    let predicted = |stages: Option<usize>| -> Result<f64> {
        let (scene, _) = channel(Midpoint::default(), 0.0)?;
        let rate = scene.system().limits().map(|(limit, _)| limit.decay_rate()).fold(0.0, f64::max);
        Ok(stages.map_or(2.0, |s| 0.6535 * (s * s - 1) as f64) / rate)
    };
    for stages in [None, Some(3), Some(5), Some(8)] {
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
        tell(report, format_args!("| {name} | {dt:.2e} | {found} |"))?;
    }
    Ok(())
}

fn transient(report: &mut String) -> Result<()> {
    let until = 10.0;
    let swimmer = Swimmer { activity: -4.0, spacing: 0.1, method: Method::ImmersedBoundary, ..Swimmer::default() };
    let midpoint = || swimmer.build();
    tell(
        report,
        format_args!("\nA swimmer of activity -4 starts, viscosity 100, h = 0.1, to t = {until}:\n\n{HEADING}"),
    )?;
    let exact = run(midpoint()?, until, StepSize::Adaptive { tolerance: 1e-8 })?;
    tell(report, line("midpoint (reference)", "adaptive 1e-8", &exact, &exact)?)?;
    for dt in [0.04, 0.02, 0.01, 0.005, 0.0025] {
        match run(midpoint()?, until, StepSize::Fixed(dt)) {
            Ok(cost) => tell(report, line("midpoint", &format!("{dt}"), &cost, &exact)?)?,
            Err(error) => tell(report, format_args!("| midpoint | {dt} | {error} |"))?,
        }
    }
    for tolerance in [1e-4, 1e-5, 1e-6, 1e-7] {
        let cost = run(midpoint()?, until, StepSize::Adaptive { tolerance })?;
        tell(report, line("midpoint", &format!("adaptive {tolerance:.0e}"), &cost, &exact)?)?;
    }
    for tolerance in [1e-4, 1e-5, 1e-6] {
        let (scene, droplet) = midpoint().context("a swimmer")?;
        let cost =
            run((scene.advanced_by(RungeKuttaChebyshev::new()), droplet), until, StepSize::Adaptive { tolerance })?;
        tell(report, line("RKC", &format!("adaptive {tolerance:.0e}"), &cost, &exact)?)?;
    }
    Ok(())
}
