//! Thresholds, Hopf points and limit cycles.

use std::f64::consts::TAU;

use anyhow::{Context, Result};
use motile::base::Drive;
use motile::base::Region;
use motile::setup::{DropletSetup, Setup};
use motile_steady_states::{
    Continuation, Critical, Eigenmode, LimitCycle, Parameter, SpecialKind, SpecialPoint, Stability, SteadyState,
    Symmetry,
};
use motile_tests::validation::Table;

use super::{channel, nodes};
use crate::tables::{Measure, Once, all_wanted};

/// The threshold of polarisation along x: where the slowest symmetric mode of the droplet at rest neither grows nor
/// decays.
pub(crate) fn polarisation(setup: &Setup) -> Result<Critical> {
    let state = SteadyState::uniform(setup)?;
    let spectrum = state.spectrum()?;
    let mode = spectrum.modes.iter().find(|mode| mode.symmetry == Symmetry::Symmetric).context("no modes")?;
    Ok(state.critical(mode, Parameter::Activity)?)
}

pub(crate) fn activity(critical: &Critical) -> f64 {
    Parameter::Activity.get(critical.state.setup()).unwrap_or(f64::NAN)
}

/// How the activity of the swimmers that branch off depends on their speed: its curvature at the threshold, relative to
/// the threshold, in units of (D/R0)^2: positive for a stronger activity, which is a smooth onset.
fn onset(critical: Critical, diffusion: f64) -> Result<f64> {
    let threshold = activity(&critical);
    let range = Continuation::new(Parameter::Activity, 0.0, 3.0 * threshold);
    let swimmers = Continuation { largest_step: 0.02, most_points: 3, ..range };
    let point = SpecialPoint::new(SpecialKind::BranchPoint, critical, Parameter::Activity);
    let branch = swimmers.switch(&point, true, |_, _| true)?;
    let at = |k: usize| {
        let point = branch.points.get(k).context("no branch")?;
        anyhow::Ok(((point.state.velocity().x / diffusion).powi(2), point.value / threshold - 1.0))
    };
    // The straight line through the slopes of the curve's first two points from the threshold, at the threshold.
    let ((u, p), (v, q)) = (at(0)?, at(1)?);
    Ok((p / u * v - q / v * u) / (v - u))
}

/// Value with that many significant digits, or four decimal places where these are fewer; no sign of zero.
pub(super) fn digits(value: f64, count: i32) -> String {
    let places = (count - 1 - value.abs().log10().floor().clamp(-9.0, 9.0) as i32).max(0) as usize;
    let text = format!("{value:.*}", places.min(if count < 4 { 4 } else { 9 }));
    if text.chars().any(|c| ('1'..='9').contains(&c)) { text } else { "0".to_owned() }
}

/// The threshold in plane, box and channels and over A and D, and its onset.
pub(super) fn threshold(count: usize) -> Result<Vec<Table>> {
    let header = "region | A | D | threshold | over that of the plane | frequency | onset";
    let mut table = Table::new("Threshold of polarisation, at c0", header);
    let scene = |region: Region| {
        let droplets = vec![DropletSetup::contractile(-0.4, 10.0)];
        Setup { region, method: nodes(count), droplets, ..Setup::default() }
    };
    let in_the_plane = Once::new();
    let mut add = |name: String, setup: &Setup, strength: f64, diffusion: f64| {
        table.measure(format_args!("{name} | {strength} | {diffusion}"), || {
            let Ok(critical) = polarisation(setup) else { return Ok("not found |  |  | ".to_owned()) };
            let (found, frequency) = (activity(&critical), critical.mode.value.im);
            let exact = in_the_plane.get(|| Ok(activity(&polarisation(&scene(Region::Plane))?)))?;
            let onset = onset(critical, diffusion).map_or_else(|_| "-".into(), |value| digits(value, 3));
            Ok(format!("{} | {} | {frequency:.4} | {onset}", digits(found, 7), digits(found / exact, 7)))
        })
    };
    add("plane".into(), &scene(Region::Plane), 10.0, 0.1)?;
    for side in [4.0, 6.0, 12.0] {
        add(format!("box {side}"), &scene(Region::Box { lengths: [side; 2] }), 10.0, 0.1)?;
    }
    for width in [2.1, 2.2, 2.3, 2.5, 3.0, 3.5, 4.0, 5.0] {
        // From where swimming is about to set in.
        let start = -0.4 - 0.3 / (width - 1.5_f64).powi(3);
        add(format!("channel {width}"), &channel(12.0, width, start, 10.0, count), 10.0, 0.1)?;
    }
    for (strength, diffusion) in [
        (0.0, 0.1),
        (1.0, 0.1),
        (100.0, 0.1),
        (1000.0, 0.1),
        (3000.0, 0.1),
        (10.0, 0.02),
        (10.0, 0.5),
        (10.0, 2.0),
        (300.0, 0.02),
    ] {
        // Where swimming sets in with A = 10 and D = 0.1.
        let regions = [
            ("plane", Region::Plane, -0.4),
            ("box 4", Region::Box { lengths: [4.0; 2] }, -0.4),
            ("channel 2.5", Region::Channel { length: 12.0, width: 2.5, drive: Drive::ZeroGradient }, -0.58),
        ];
        for (name, region, start) in regions {
            let mut setup = scene(region);
            setup.droplets = vec![DropletSetup::contractile(10.0 * start * diffusion, strength)];
            setup.droplets[0].particles.iter_mut().for_each(|particles| particles.diffusion = diffusion);
            add(name.into(), &setup, strength, diffusion)?;
        }
    }
    Ok(vec![table])
}

/// Hopf points of the straight swimmer over the width, for each A and period.
pub(super) fn regimes(count: usize) -> Result<Vec<Table>> {
    let header = "A | l | width | Hopf points (frequency) | other points | stable at | followed to";
    let mut table = Table::new("Straight swimmers: activities from -0.6 to -6", header);
    for (strength, length) in [10.0, 13.5].into_iter().flat_map(|a| [12.0, 18.0, 24.0].map(|l| (a, l))) {
        for width in [2.5, 3.0, 3.5, 4.0, 4.5, 5.0, 6.0] {
            table.measure(format_args!("{strength} | {length} | {width}"), || {
                let start = SteadyState::find(&channel(length, width, -0.6, strength, count))?;
                let range = Continuation::new(Parameter::Activity, -0.6, -6.0);
                let branch = Continuation { largest_step: 0.06, ..range }.follow(&start, |_, _| true)?;
                let (mut hopf, mut other) = (Vec::new(), Vec::new());
                for point in &branch.special {
                    let (at, mode) = (point.value, &point.critical.mode);
                    match point.kind {
                        SpecialKind::Hopf => hopf.push(format!("{at:.4} ({:.4})", mode.value.im)),
                        kind => other.push(format!("{at:.4} ({}, {})", kind.name(), mode.symmetry.name())),
                    }
                }
                let stable: Vec<_> = branch
                    .points
                    .iter()
                    .map(|point| (point.value, point.spectrum.stability() == Stability::Stable))
                    .collect();
                let last = stable.last().map_or(f64::NAN, |point| point.0);
                let points = [hopf.join("; "), other.join("; ")];
                Ok(format!("{} | {} | {} | {last:.2}", points[0], points[1], intervals(&stable)))
            })?;
        }
    }
    Ok(vec![table])
}

/// Stretches of a branch that are stable.
fn intervals(points: &[(f64, bool)]) -> String {
    let mut found: Vec<[f64; 2]> = Vec::new();
    let mut before = false;
    for &(value, stable) in points {
        match (stable, before, found.last_mut()) {
            (true, true, Some(last)) => last[1] = value,
            (true, ..) => found.push([value; 2]),
            _ => {}
        }
        before = stable;
    }
    let found: Vec<String> = found.iter().map(|[from, to]| format!("{from:.2} to {to:.2}")).collect();
    if found.is_empty() { "nowhere".into() } else { found.join("; ") }
}

/// Instants over half a period, at first.
const INSTANTS: usize = 9;
/// First amplitude of a cycle (R0).
const AMPLITUDE: f64 = 0.2;
/// Largest error of the multipliers of shifts with which the others are told.
const RESOLVED: f64 = 0.2;
/// Activity at which the reference has a cycle.
const GOAL: f64 = -5.0;

/// Limit cycles of width 5 and A = 10, from the Hopf point to an activity of -5.
pub(super) fn cycle(count: usize) -> Result<Vec<Table>> {
    let parameter = Parameter::Activity;
    let found = Once::new();
    let hopf = || {
        found.get(|| {
            let state = SteadyState::find(&channel(12.0, 5.0, -2.5, 10.0, count))?;
            let spectrum = state.spectrum()?;
            let swing = |mode: &&Eigenmode| mode.value.im > 0.0 && mode.symmetry == Symmetry::Antisymmetric;
            let mode = spectrum.modes.iter().find(swing).context("no swings")?;
            Ok(state.critical(mode, parameter)?)
        })
    };
    let header = "cycle | activity | amplitude | period | mean speed | instants | last harmonics | largest \
        multiplier | of the shifts less 1";
    let mut table = Table::new("Limit cycles of width 5, l = 12 and A = 10", header);
    let row = |at: f64, amplitude: f64, period: f64, speed: f64, rest: &str| {
        format!("{at:.5} | {amplitude:.4} | {period:.3} | {speed:.6} | {rest}")
    };
    table.measure("Hopf point", || {
        let hopf = hopf()?;
        Ok(row(activity(hopf), 0.0, TAU / hopf.mode.value.im, hopf.state.velocity().x, " |  |  | "))
    })?;
    if !all_wanted() {
        return Ok(vec![table]);
    }
    let mut number = 0;
    let mut show = |cycle: &LimitCycle| -> Result<()> {
        let (at, amplitude) = (cycle.value(parameter), cycle.amplitude()?);
        let multipliers = cycle.multipliers()?;
        // Those that the nodes do not resolve are left out.
        let resolved = multipliers.values.first().filter(|_| multipliers.neutral < RESOLVED);
        let largest = resolved.map_or_else(String::new, |value| format!("{:.4}", value.norm()));
        let (instants, tail, neutral) = (cycle.instants(), cycle.tail(), multipliers.neutral);
        let told = format!("{instants} | {tail:.0e} | {largest} | {neutral:.0e}");
        let row = row(at, amplitude, cycle.period(), cycle.mean_speed(), &told);
        number += 1;
        motile_cli::run::say(&row);
        table.row(format_args!("{number} | {row}"));
        Ok(())
    };
    LimitCycle::follow(hopf()?, parameter, AMPLITUDE, INSTANTS, |cycle| {
        // The last one at the activity of the reference.
        let last = cycle.value(parameter) < GOAL;
        let shown = match last {
            true => cycle.at(parameter, GOAL).map_err(Into::into).and_then(|end| show(&end)),
            false => show(cycle),
        };
        shown.is_ok() && !last
    })?;
    Ok(vec![table])
}
