//! Swimmers in three dimensions: in unbounded fluid and in tubes, their onset and headings.

use std::f64::consts::{PI, TAU};

use anyhow::{Context, Result, bail};
use motile::active_interface::ActiveDroplet;
use motile::base::{Drive, Region, TubeShape, Vec2};
use motile::scene::Scene;
use motile::setup::{DropletSetup, Particles, Setup};
use motile_steady_states::{Continuation, Parameter, SpecialKind, SpecialPoint, SteadyState};
use motile_tests::validation::Table;

use super::bifurcations::{activity, digits, polarisation};
use super::nodes;
use crate::tables::{Measure, Once};

/// Pairs of nodes of a table whose digits should agree.
const PAIR: [usize; 2] = [96, 128];
/// Radii of tubes.
const RADII: [f64; 4] = [2.0, 1.5, 1.25, 1.1];
/// Lengths over which there is no pressure drop in a tube, and its radius.
const LENGTHS: [f64; 4] = [8.0, 16.0, 32.0, 64.0];
const RADIUS: f64 = 1.5;
/// Points of the branch of swimmers, from the threshold past the fold to the threshold again.
const POINTS: usize = 60;

/// A droplet of these viscosities inside and outside.
fn droplet(region: Region, [inside, outside]: [f64; 2], activity: f64, strength: f64, count: usize) -> Setup {
    let droplet = DropletSetup { viscosity: Some(inside), ..DropletSetup::contractile(activity, strength) };
    Setup { region, viscosity: outside, droplets: vec![droplet], method: nodes(count), ..Setup::default() }
}

/// Leading eigenvalue of the axisymmetric disturbances.
fn leading(state: &SteadyState) -> Result<f64> {
    Ok(state.spectrum()?.leading().map_or(f64::NAN, |mode| mode.value.re))
}

/// Leading eigenvalue of disturbances of an order around the axis.
fn turning(state: &SteadyState, order: usize) -> Result<[f64; 2]> {
    let value = state.spectrum_around(order)?.leading().context("no modes")?.value;
    Ok([value.re, value.im.abs()])
}

/// Growth rate and frequency in so many places.
fn rate([growth, frequency]: [f64; 2], places: usize) -> String {
    let swing = if frequency == 0.0 { String::new() } else { format!(" + {frequency:.4} i") };
    format!("{growth:.places$}{swing}")
}

/// Digits in which two values agree.
fn settled([a, b]: [[f64; 2]; 2]) -> String {
    let [apart, size] = [(a[0] - b[0]).hypot(a[1] - b[1]), b[0].hypot(b[1])];
    ((size / apart).log10().floor().clamp(0.0, 9.0) as usize).to_string()
}

/// Regime by the leading eigenvalues of m = 1 and 2, with two numbers of nodes each.
fn regime(turn: [[f64; 2]; 2], flatten: [[f64; 2]; 2]) -> String {
    let of = |found: [[f64; 2]; 2], grows: &'static str, decays: &'static str| match found.map(|value| value[0] > 0.0) {
        [true, true] => grows,
        [false, false] => decays,
        _ => "not settled",
    };
    let grows = if turn[1][1] == 0.0 { "turns" } else { "swings off the axis" };
    [of(turn, grows, "keeps its heading"), of(flatten, "flattens", "stays round")].join(", ")
}

/// Swimmers in unbounded fluid over activity, excluded volume and viscosities, and their regimes.
pub(super) fn space() -> Result<Vec<Table>> {
    let header = "viscosities | activity | A | nodes | speed | aspect ratio | largest c | stresslet | tail | m = 0";
    let mut table = Table::new("Swimmers of revolution in unbounded fluid", header);
    let [coarse, fine] = PAIR;
    let columns = format!(
        "viscosities | activity | A | m = 1, {coarse} nodes | m = 1, {fine} nodes | digits of m = 1 | \
         m = 2, {coarse} nodes | m = 2, {fine} nodes | digits of m = 2 | regime"
    );
    let mut regimes = Table::new("Regimes of swimmers in unbounded fluid", &columns);
    let equal = [100.0; 2];
    for (viscosities, activity, strength) in [
        (equal, -0.6, 1.2),
        (equal, -1.0, 2.0),
        (equal, -2.0, 4.0),
        (equal, -2.0, 10.0),
        (equal, -3.0, 6.0),
        (equal, -4.0, 8.0),
        ([100.0, 10.0], -1.0, 2.0),
        ([10.0, 100.0], -0.4, 0.8),
    ] {
        let [inside, outside] = viscosities;
        let names = format!("{inside}/{outside} | {activity} | {strength}");
        let states = [Once::new(), Once::new()];
        let state = |k: usize| {
            let setup = || droplet(Region::Space, viscosities, activity, strength, PAIR[k]);
            states[k].get(|| Ok(SteadyState::find(&setup())?))
        };
        for (k, count) in PAIR.into_iter().enumerate() {
            table.measure(format_args!("{names} | {count}"), || {
                let (state, seen) = (state(k)?, state(k)?.measured()?);
                let values = [seen.speed, seen.aspect_ratio, seen.concentration[0], seen.stresslet];
                let values = values.map(|value| digits(value, 6)).join(" | ");
                Ok(format!("{values} | {:.0e} | {:.4}", state.tail(), leading(state)?))
            })?;
        }
        regimes.measure(&names, || {
            let (mut turns, mut flattens) = ([[f64::NAN; 2]; 2], [[f64::NAN; 2]; 2]);
            for k in 0..PAIR.len() {
                (turns[k], flattens[k]) = (turning(state(k)?, 1)?, turning(state(k)?, 2)?);
            }
            let of = |found: [[f64; 2]; 2]| [rate(found[0], 4), rate(found[1], 4), settled(found)].join(" | ");
            Ok(format!("{} | {} | {}", of(turns), of(flattens), regime(turns, flattens)))
        })?;
    }
    Ok(vec![table, regimes])
}

/// Swimmers of activity -2 in tubes, at two numbers of nodes each.
pub(super) fn tubes() -> Result<Vec<Table>> {
    let header = "radius | nodes | speed | film | aspect ratio | stresslet | tail | m = 0 | m = 1";
    let mut table = Table::new("Swimmers in tubes without flux, viscosities 100, activity -2, A = 4", header);
    for (radius, count) in RADII.into_iter().flat_map(|radius| PAIR.map(|count| (radius, count))) {
        table.measure(format_args!("{radius} | {count}"), || {
            let state = SteadyState::find(&droplet(Region::tube(radius), [100.0; 2], -2.0, 4.0, count))?;
            let seen = state.measured()?;
            let widest = state.profile().positions.iter().map(|x| x.y).fold(0.0, f64::max);
            Ok(format!(
                "{} | {} | {} | {} | {:.0e} | {:.4} | {}",
                digits(seen.speed, 6),
                digits(radius - widest, 5),
                digits(seen.aspect_ratio, 6),
                digits(seen.stresslet, 6),
                state.tail(),
                leading(&state)?,
                rate(turning(&state, 1)?, 5)
            ))
        })?;
    }
    Ok(vec![table, drives()?])
}

/// Swimmers in a tube without a mean pressure gradient over some length, which approach the one without flux.
fn drives() -> Result<Table> {
    let title = format!(
        "Swimmers of activity -2, A = 4 in a tube of radius {RADIUS} without a pressure drop over a length, 96 nodes"
    );
    let mut table = Table::new(&title, "length | speed | over that without flux | excess times length");
    let setup = droplet(Region::tube(RADIUS), [100.0; 2], -2.0, 4.0, 96);
    let closed = Once::new();
    let closed = || closed.get(|| Ok(SteadyState::find(&setup)?));
    for length in LENGTHS {
        table.measure(length, || {
            let (closed, still) = (closed()?, closed()?.measured()?.speed);
            let (shape, drive) = (TubeShape::Straight, Drive::ZeroGradient);
            let region = Region::Tube { radius: RADIUS, shape, drive, length: Some(length) };
            let setup = Setup { region, ..setup.clone() };
            let speed = SteadyState::near(&setup, closed.profile(), closed.velocity(), true)?.measured()?.speed;
            let (ratio, excess) = (speed / still, speed / still - 1.0);
            Ok(format!("{} | {} | {}", digits(speed, 6), digits(ratio, 6), digits(excess * length, 4)))
        })?;
    }
    table.measure("no flux", || Ok(format!("{} | 1 | ", digits(closed()?.measured()?.speed, 6))))?;
    Ok(table)
}

/// Threshold, fold with its speed, and speed at the threshold, to which a droplet at rest jumps.
fn fold(viscosities: [f64; 2], strength: f64, tension: f64, count: usize) -> Result<[f64; 4]> {
    let [inside, outside] = viscosities;
    let guess = -1e-3 * (3.0 * inside + 2.0 * outside);
    let mut setup = droplet(Region::Space, viscosities, guess, strength, count);
    setup.droplets[0].tension = tension;
    let critical = polarisation(&setup)?;
    let threshold = activity(&critical);
    let range = Continuation::new(Parameter::Activity, 0.5 * threshold, 1.2 * threshold);
    let swimmers = Continuation { largest_step: 0.02, most_points: POINTS, ..range };
    let point = SpecialPoint::new(SpecialKind::BranchPoint, critical, Parameter::Activity);
    let mut turned = false;
    let branch = swimmers.switch(&point, true, |point, special| {
        turned |= special.iter().any(|point| point.kind == SpecialKind::Fold);
        point.value > threshold && !(turned && point.value < threshold + 2e-3 * threshold.abs())
    })?;
    let Some(fold) = branch.special.iter().find(|point| point.kind == SpecialKind::Fold) else {
        return Ok([threshold, f64::NAN, f64::NAN, f64::NAN]);
    };
    let last = &branch.points.last().context("no point")?.state;
    let setup = Parameter::Activity.with(last.setup(), threshold)?;
    let jump = SteadyState::near(&setup, last.profile(), last.velocity(), true)?.measured()?.speed;
    Ok([threshold, fold.value, fold.critical.state.measured()?.speed, jump])
}

/// Folds over the ratio of viscosities and the strength of the excluded volume.
pub(super) fn folds(count: usize) -> Result<Vec<Table>> {
    let header = "viscosities | A | threshold | fold | fold over threshold | speed there | jump";
    let mut table = Table::new("Onset of swimming in unbounded fluid", header);
    for (viscosities, strength) in
        [([100.0; 2], 0.5), ([100.0; 2], 1.0), ([100.0; 2], 4.0), ([10.0, 100.0], 1.0), ([100.0, 10.0], 1.0)]
    {
        let [inside, outside] = viscosities;
        table.measure(format_args!("{inside}/{outside} | {strength}"), || {
            let [threshold, fold, speed, jump] = fold(viscosities, strength, 10.0, count)?;
            let values = [(threshold, 6), (fold, 6), (fold / threshold, 5), (speed, 4), (jump, 4)];
            Ok(values.map(cell).join(" | "))
        })?;
    }
    Ok(vec![table, tensions(count)?])
}

/// A value in so many digits, or that there is none.
fn cell((value, count): (f64, i32)) -> String {
    if value.is_finite() { digits(value, count) } else { "-".to_owned() }
}

/// Activities and times of a run in which the activity is raised and lowered, the fold and the threshold between the
/// first two and the third.
const STAGES: [(f64, f64); 5] = [(-0.48, 400.0), (-0.496, 800.0), (-0.52, 2500.0), (-0.496, 1500.0), (-0.48, 2500.0)];
/// Part of the concentration that varies as the cosine of the polar angle at the start of that run.
const DISTURBANCE: f64 = 0.05;

/// Run whose activity is raised past the threshold and lowered past the fold: speeds at the ends of its stages.
pub(super) fn hysteresis() -> Result<Vec<Table>> {
    let count = 128;
    let setup = droplet(Region::Space, [100.0; 2], STAGES[0].0, 1.0, count / 4);
    let markers: Vec<Vec2> = (0..count).map(|k| Vec2::from_angle(TAU * k as f64 / count as f64)).collect();
    let length = 2.0 * (PI / count as f64).sin();
    let wave = |k: usize| (TAU * (k as f64 + 0.5) / count as f64).cos();
    let numbers = (0..count).map(|k| 100.0 * (1.0 - DISTURBANCE * wave(k)) * length).collect();
    let Some(particles) = setup.droplets[0].particles else { bail!("no particles") };
    let (tension, diffusion) = (setup.droplets[0].tension, particles.diffusion);
    let body = ActiveDroplet::new(&markers, numbers, particles.law(tension)?, diffusion)?.axisymmetric()?;
    let mut scene = Scene::new(setup.flow()?);
    let body = scene.add(body);
    let title = "A run in unbounded fluid, viscosities 100, A = 1, 32 nodes, whose activity is raised and lowered";
    let mut table = Table::new(title, "activity | until t | speed");
    for (activity, time) in STAGES {
        let law = Particles { activity, ..particles }.law(tension)?;
        scene.body_mut(body)?.set_tension(law);
        let end = scene.system().time() + time;
        scene.run(end).go()?;
        table.row(format_args!("{activity} | {end} | {}", digits(scene.observe(body)?.speed(), 4)));
    }
    Ok(vec![table])
}

/// Folds of a droplet less viscous than the fluid over its tension without particles.
fn tensions(count: usize) -> Result<Table> {
    let header = "tension | threshold | fold | fold over threshold";
    let mut table = Table::new("Onset of swimming, viscosities 10/100, A = 1, over the tension", header);
    for tension in [10.0, 100.0, 1000.0] {
        table.measure(tension, || {
            let [threshold, fold, ..] = fold([10.0, 100.0], 1.0, tension, count)?;
            Ok([(threshold, 6), (fold, 6), (fold / threshold, 5)].map(cell).join(" | "))
        })?;
    }
    Ok(table)
}

/// Concentration that varies as the cosine of the polar angle, over the mean, of a droplet that is nearly a sphere.
fn amplitude(state: &SteadyState) -> Result<f64> {
    let (profile, centre) = (state.profile(), state.measured()?.centroid);
    let count = profile.positions.len();
    // The integral from pole to pole of what is odd in the parameter, by its sines.
    let over_rings = |value: &dyn Fn(f64) -> f64| {
        let wave = |m: usize| {
            let nodes = profile.positions.iter().zip(&profile.density).enumerate();
            let at = |k: usize| (TAU * (k * m) as f64 / count as f64).sin();
            nodes.map(|(k, (x, number))| value(x.x - centre.x) * number * x.y * at(k)).sum::<f64>() / m as f64
        };
        (1..count / 2).step_by(2).map(wave).sum::<f64>()
    };
    Ok(3.0 * over_rings(&|x| x) / over_rings(&|_| 1.0))
}

/// The coefficient b of swimmers that branch off a droplet at rest, activity = threshold (1 - b (c1/c0)^2), from the
/// first two points of the branch, and the tension at rest (force).
fn coefficient(viscosities: [f64; 2], tension: f64, count: usize) -> Result<[f64; 2]> {
    let [inside, outside] = viscosities;
    let guess = -1e-3 * (3.0 * inside + 2.0 * outside);
    let mut setup = droplet(Region::Space, viscosities, guess, 0.0, count);
    setup.droplets[0].tension = tension;
    let critical = polarisation(&setup)?;
    let threshold = activity(&critical);
    let range = Continuation::new(Parameter::Activity, 0.5 * threshold, 1.5 * threshold);
    let swimmers = Continuation { largest_step: 0.02, most_points: 3, ..range };
    let point = SpecialPoint::new(SpecialKind::BranchPoint, critical, Parameter::Activity);
    let branch = swimmers.switch(&point, true, |_, _| true)?;
    let at = |k: usize| -> Result<(f64, f64)> {
        let point = branch.points.get(k).context("no branch")?;
        Ok((amplitude(&point.state)?.powi(2), 1.0 - point.value / threshold))
    };
    let ((u, p), (v, q)) = (at(0)?, at(1)?);
    Ok([(p / u * v - q / v * u) / (v - u), tension - MEAN * threshold])
}

/// Particles per area at rest.
const MEAN: f64 = 100.0;

/// How swimming sets in over the tension without an excluded volume, and on a sphere in closed form.
pub(super) fn onset(count: usize) -> Result<Vec<Table>> {
    let title = "Onset of swimming in unbounded fluid without an excluded volume: b in activity = threshold \
                 (1 - b (c1/c0)^2), and (3 rho - 1)/(15 (1 - rho)) of a sphere";
    let header = "viscosities | tension without particles | tension at rest | b | on a sphere | b over that less 1";
    let mut table = Table::new(title, header);
    for viscosities in [[10.0, 100.0], [100.0; 2], [100.0, 10.0]] {
        let [inside, outside] = viscosities;
        let rho = (2.0 * outside + 3.0 * inside) / (5.0 * (inside + outside));
        let exact = (3.0 * rho - 1.0) / (15.0 * (1.0 - rho));
        for tension in [10.0, 100.0, 1e3, 1e4] {
            table.measure(format_args!("{inside}/{outside} | {tension}"), || {
                let [found, whole] = coefficient(viscosities, tension, count)?;
                let excess = digits(found / exact - 1.0, 2);
                Ok(format!("{whole:.0} | {} | {} | {excess}", digits(found, 4), digits(exact, 4)))
            })?;
        }
    }
    Ok(vec![table])
}
