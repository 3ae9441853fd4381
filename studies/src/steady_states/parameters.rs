//! Steady swimmers over the length of a channel and over viscosities.

use anyhow::{Context, Result, bail};
use motile::base::Drive;
use motile::base::Region;
use motile::setup::{DropletSetup, Setup};
use motile_steady_states::{Continuation, Eigenmode, Parameter, SteadyState};
use motile_tests::validation::Table;

use super::{channel, nodes};
use crate::book::statistics::line;
use crate::tables::{Measure, Once, all_wanted};

/// Lengths of the table, and the largest factor from one to the next on the way.
const LENGTHS: [f64; 13] = [8.0, 10.0, 12.0, 16.0, 24.0, 36.0, 48.0, 72.0, 96.0, 120.0, 144.0, 180.0, 240.0];
const FACTOR: f64 = 1.15;
const LONGEST: f64 = 400.0;
/// The branch point is at a greater length.
const TILTS_AT: f64 = 73.0;
/// Last modes of a state that is worth a place among the data of a law.
const SOUND: f64 = 1e-3;

/// The state at another length, by way of those between.
fn stretched(from: &SteadyState, goal: f64) -> Result<SteadyState> {
    let mut state = from.clone();
    loop {
        let now = Parameter::Length.get(state.setup()).unwrap_or(f64::NAN);
        let next = goal.clamp(now / FACTOR, now * FACTOR);
        // Over nodes of its own, which crowd where it has become steep.
        let setup = Parameter::Length.with(state.setup(), next)?;
        state = SteadyState::near(&setup, state.profile(), state.velocity(), state.is_mirror_symmetric())?;
        if next == goal {
            return Ok(state);
        }
    }
}

/// Distance of the nearest node from a wall.
fn film(state: &SteadyState, width: f64) -> f64 {
    0.5 * width - state.profile().positions.iter().map(|x| x.y.abs()).fold(0.0, f64::max)
}

/// Speeds over the length of a channel of width 2, and two laws; then the stresslet in one of width 3.
pub(super) fn length(count: usize) -> Result<Vec<Table>> {
    let width = 2.0;
    let header = "length | speed | film | last modes | growth rate";
    let mut speeds = Table::new("Straight swimmers, width 2, activity -2, A = 10", header);
    let shortest = Once::new();
    let shortest = || shortest.get(|| Ok(SteadyState::find(&channel(LENGTHS[0], width, -2.0, 10.0, count))?));
    speeds.measure(format_args!("{:.2}", LENGTHS[0]), || cells(shortest()?, width))?;
    if !all_wanted() {
        return Ok(vec![speeds, stresslets(count)?]);
    }
    let mut open: Vec<(f64, SteadyState)> = vec![(LENGTHS[0], shortest()?.clone())];
    for length in &LENGTHS[1..] {
        let Some(Ok(next)) = open.last().map(|(_, last)| stretched(last, *length)) else { break };
        open.push((*length, next));
    }
    let points = tabulated(&mut speeds, &open, width)?;
    // Where the straight swimmers lose their stability those branch off that are not their own mirror images.
    let Some((length, start)) = open.iter().rev().find(|(length, _)| *length < TILTS_AT) else { bail!("no swimmer") };
    let along = Continuation { largest_step: 0.1, ..Continuation::new(Parameter::Length, *length, LONGEST) };
    let straight = along.follow(start, |_, special| special.is_empty())?;
    let point = straight.special.first().context("no branch point of the straight swimmers")?;
    let branch = along.switch(point, true, |_, _| true)?;
    let tilts: Vec<_> = branch.points.into_iter().map(|point| (point.value, point.state)).collect();
    let (_, last) = tilts.last().context("no tilted swimmers")?;
    let region = Region::Channel { length: LONGEST, width, drive: Drive::ZeroFlux };
    let setup = Setup { region, ..last.setup().clone() };
    let without_flux = SteadyState::near(&setup, last.profile(), last.velocity(), false)?;
    let mut tilted = Table::new("Swimmers that are not their own mirror images, and without a net flux", header);
    let tilted_points = tabulated(&mut tilted, &tilts, width)?;
    tabulated(&mut tilted, &[(f64::INFINITY, without_flux)], width)?;
    let header = "law | a | b | c | largest residual";
    let mut laws = Table::new("Least squares of the speeds without a pressure gradient", header);
    let mut fitted = |name: &str, points: &[(f64, f64)], range: std::ops::Range<i32>, law: fn(f64, f64) -> f64| {
        // Linear in a and b for each c.
        let all = range.map(|k| 0.05 * f64::from(k)).map(|c| (line(points, |l| law(l, c)), c));
        // An exponential that has died off at all lengths fits nothing.
        let all = all.filter(|((a, b, worst), _)| (a + b + worst).is_finite());
        if let Some(((a, b, worst), c)) = all.min_by(|x, y| x.0.2.total_cmp(&y.0.2)) {
            let numbers = [format!("{a:.6}"), format!("{b:.5}"), format!("{c:.2}"), format!("{worst:.1e}")];
            laws.push(std::iter::once(name.to_owned()).chain(numbers));
        }
    };
    for (swimmers, points) in [("straight", &points), ("tilted", &tilted_points)] {
        fitted(&format!("{swimmers}: a + b exp(-l/c)"), points, 1..8000, |l, c| (-l / c).exp());
        fitted(&format!("{swimmers}: a + b/(l + c)"), points, -140..8000, |l, c| 1.0 / (l + c));
    }
    Ok(vec![speeds, laws, stresslets(count)?, tilted])
}

/// The rows of states at their lengths; lengths and speeds of those that are sound.
fn tabulated(table: &mut Table, states: &[(f64, SteadyState)], width: f64) -> Result<Vec<(f64, f64)>> {
    let mut points = Vec::new();
    for (length, state) in states {
        let speed = state.velocity().x;
        if state.tail() < SOUND {
            points.push((*length, speed));
        }
        let name = if length.is_finite() { format!("{length:.2}") } else { "any, no net flux".into() };
        if !table.has_row(&name) {
            table.row(format_args!("{name} | {}", cells(state, width)?));
        }
    }
    Ok(points)
}

fn cells(state: &SteadyState, width: f64) -> Result<String> {
    let (speed, film, tail) = (state.velocity().x, film(state, width), state.tail());
    let growth = state.spectrum()?.leading().map_or(f64::NAN, |mode| mode.value.re);
    Ok(format!("{speed:.8} | {film:.4} | {tail:.0e} | {growth:.5}"))
}

/// Straight swimmers in a channel of width 3 at an activity of -4 over its length.
fn stresslets(count: usize) -> Result<Table> {
    let header = "A | length | stresslet | speed | growth rate | frequency";
    let mut table = Table::new("Width 3, activity -4", header);
    for (strength, length) in [10.0, 13.5].into_iter().flat_map(|a| [8.0, 12.0, 18.0, 24.0, 36.0].map(|l| (a, l))) {
        table.measure(format_args!("{strength} | {length}"), || {
            let state = SteadyState::find(&channel(length, 3.0, -4.0, strength, count))?;
            let (seen, spectrum) = (state.measured()?, state.spectrum()?);
            let leading = spectrum.leading().map(|mode| mode.value).unwrap_or_default();
            Ok(format!("{:.3} | {:.6} | {:.5} | {:.4}", seen.stresslet, seen.speed, leading.re, leading.im))
        })?;
    }
    Ok(table)
}

/// Columns of what is told of a swimmer.
const HEADER: &str = "speed | aspect ratio | c max | least curvature | growth rate | symmetry";

/// Swimmers over the viscosity ratio at fixed sum, and strongly active ones.
pub(super) fn contrast(count: usize) -> Result<Vec<Table>> {
    let parameter = Parameter::ViscosityRatio;
    let mut ratios =
        Table::new("Box 6, activity -2, A = 10, sum of the viscosities 200", &format!("inside/outside | {HEADER}"));
    let droplet = DropletSetup { viscosity: Some(100.0), ..DropletSetup::active(-2.0) };
    let setup = Setup { method: nodes(count), droplets: vec![droplet], ..Setup::default() };
    let start = Once::new();
    let start = || start.get(|| Ok(SteadyState::find(&setup)?));
    ratios.measure("1.0000", || described(start()?, start()?.spectrum()?.leading()))?;
    for (from, to) in [(1.0, 0.02), (1.0, 50.0)].into_iter().filter(|_| all_wanted()) {
        let settings = Continuation { largest_step: 0.25, ..Continuation::new(parameter, from, to) };
        let branch = settings.follow(start()?, |_, _| true)?;
        for point in branch.points.iter().filter(|point| point.value != from) {
            let cells = described(&point.state, point.spectrum.leading())?;
            ratios.row(format_args!("{:.4} | {cells}", point.value));
        }
        for special in &branch.special {
            let cells = described(&special.critical.state, Some(&special.critical.mode))?;
            ratios.row(format_args!("{:.4} ({}) | {cells}", special.value, special.kind.name()));
        }
    }
    let mut strong =
        Table::new("Strong activity in a box of 6", &format!("inside | outside | activity | A | {HEADER}"));
    for (inside, outside, activity) in [(1000.0, 500.0, -15.0), (1000.0, 100.0, -10.0)] {
        for strength in [13.5, 16.0, 20.0, 25.0, 30.0] {
            strong.measure(format_args!("{inside} | {outside} | {activity} | {strength}"), || {
                let droplet = DropletSetup { viscosity: Some(inside), ..DropletSetup::contractile(activity, strength) };
                let droplets = vec![droplet];
                let setup = Setup { method: nodes(count), viscosity: outside, droplets, ..Setup::default() };
                let state = SteadyState::find(&setup)?;
                described(&state, state.spectrum()?.leading())
            })?;
        }
    }
    Ok(vec![ratios, strong])
}

fn described(state: &SteadyState, leading: Option<&Eigenmode>) -> Result<String> {
    let seen = state.measured()?;
    let rate = leading.map_or_else(String::new, |mode| format!("{:.5} + {:.4} i", mode.value.re, mode.value.im));
    let symmetry = leading.map_or("", |mode| mode.symmetry.name());
    let (speed, aspect_ratio, curvature) = (seen.speed, seen.aspect_ratio, seen.least_curvature);
    let largest = seen.concentration[0];
    Ok(format!("{speed:.6} | {aspect_ratio:.5} | {largest:.4} | {curvature:.3} | {rate} | {symmetry}"))
}
