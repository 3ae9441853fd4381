//! Thresholds, Hopf points and limit cycles.

use anyhow::{Context, Result};
use motile::{DropletSetup, Region, Setup};
use motile_examples::say;
use steady_states::{Continuation, Critical, LimitCycle, Parameter, SpecialKind, SpecialPoint, SteadyState, Symmetry};

use super::{channel, head, nodes, row};

/// The threshold of polarisation along x.
fn polarisation(setup: &Setup) -> Result<SpecialPoint> {
    let state = SteadyState::uniform(setup)?;
    let diffusion = setup.droplets[0].particles.map_or(0.1, |particles| particles.diffusion);
    // Where it crosses zero in the order of the activity: other modes have no say.
    let range = Continuation {
        largest_step: 0.01,
        ..Continuation::new(Parameter::Activity, -2.0 * diffusion, -40.0 * diffusion)
    };
    let along = |point: &&SpecialPoint| {
        point.kind == SpecialKind::BranchPoint && point.critical.mode.symmetry == Symmetry::Symmetric
    };
    let state = state.at(Parameter::Activity, -2.0 * diffusion)?;
    let branch = range.follow(&state, |_, special| !special.iter().any(|point| along(&point)))?;
    branch.special.into_iter().find(|point| along(&point)).context("no threshold")
}

fn activity(critical: &Critical) -> f64 {
    Parameter::Activity.get(critical.state.setup()).unwrap_or(f64::NAN)
}

/// How the activity of the swimmers that branch off depends on their speed: its curvature at the threshold, relative to
/// the threshold, in units of (D/R0)^2: positive for a stronger activity, which is a smooth onset.
fn onset(point: &SpecialPoint, diffusion: f64) -> Result<f64> {
    let threshold = activity(&point.critical);
    let swimmers = Continuation { largest_step: 0.02, ..Continuation::new(Parameter::Activity, 0.0, 2.0 * threshold) };
    let mut points = Vec::new();
    swimmers.switch(point, true, |point, _| {
        points.push(((point.state.velocity().x / diffusion).powi(2), point.value / threshold - 1.0));
        points.len() < 3
    })?;
    // The straight line through the threshold and the curve's first two points, extrapolated to the threshold.
    let [(u, p), (v, q), ..] = points.as_slice() else { anyhow::bail!("no branch") };
    Ok((p / u * v - q / v * u) / (v - u))
}

/// The threshold in plane, box and channels, and its onset.
pub(super) fn threshold(count: usize) -> Result<()> {
    head(&["region", "threshold", "over that of linear theory", "onset"]);
    let scene = |region: Region| {
        let droplets = vec![DropletSetup::contractile(-0.4, 10.0)];
        Setup { region, method: nodes(count), droplets, ..Setup::default() }
    };
    let mut exact = f64::NAN;
    let boxes = [4.0, 6.0, 12.0].map(|side| (format!("box {side}"), scene(Region::Box { lengths: [side; 2] })));
    let widths = [2.1, 2.2, 2.5, 3.0, 3.5, 4.0, 5.0];
    let channels = widths.map(|width| (format!("channel {width}"), channel(12.0, width, -0.4, 10.0, count)));
    for (name, setup) in [("plane".to_owned(), scene(Region::Plane))].into_iter().chain(boxes).chain(channels) {
        let point = match polarisation(&setup) {
            Ok(point) => point,
            Err(error) => {
                row(&[name, error.to_string()]);
                continue;
            }
        };
        let found = activity(&point.critical);
        if setup.region == Region::Plane {
            exact = found;
        }
        let onset = onset(&point, 0.1).map_or_else(|_| "-".into(), |value| format!("{value:.4}"));
        row(&[name, format!("{found:.7}"), format!("{:.6}", found / exact), onset]);
    }
    say("");
    head(&["A (plane)", "D", "threshold", "onset"]);
    for (strength, diffusion) in [
        (0.0, 0.1),
        (1.0, 0.1),
        (10.0, 0.1),
        (100.0, 0.1),
        (300.0, 0.1),
        (1000.0, 0.1),
        (10.0, 0.02),
        (10.0, 0.5),
        (10.0, 2.0),
    ] {
        let mut setup = scene(Region::Plane);
        setup.droplets = vec![DropletSetup::contractile(-4.0 * diffusion, strength)];
        setup.droplets[0].particles.iter_mut().for_each(|particles| particles.diffusion = diffusion);
        let point = match polarisation(&setup) {
            Ok(point) => point,
            Err(error) => {
                row(&[strength.to_string(), diffusion.to_string(), error.to_string()]);
                continue;
            }
        };
        let onset = onset(&point, diffusion).map_or_else(|_| "-".into(), |value| format!("{value:.4}"));
        row(&[strength.to_string(), diffusion.to_string(), format!("{:.6}", activity(&point.critical)), onset]);
    }
    Ok(())
}

/// Hopf points of the straight swimmer over the width, for each A and period.
pub(super) fn regimes(count: usize) -> Result<()> {
    head(&["A", "l", "width", "activities of Hopf points (frequency)", "stable between -0.5 and -6 at"]);
    for (strength, length) in [(10.0, 12.0), (13.5, 12.0), (10.0, 18.0), (10.0, 24.0)] {
        for width in [2.5, 3.0, 3.5, 4.0, 4.5, 5.0, 6.0] {
            let start = SteadyState::find(&channel(length, width, -0.6, strength, count))?;
            let settings = Continuation { largest_step: 0.06, ..Continuation::new(Parameter::Activity, -0.6, -6.0) };
            let mut stable = Vec::new();
            let branch = settings.follow(&start, |point, _| {
                stable.push((point.value, point.spectrum.unstable() == 0));
                true
            })?;
            let points = branch.special.iter().map(|point| {
                let Critical { mode, .. } = &point.critical;
                let at = activity(&point.critical);
                match point.kind {
                    SpecialKind::Hopf => format!("{at:.4} ({:.4}, {})", mode.value.im, mode.symmetry.name()),
                    kind => format!("{at:.4} ({})", kind.name()),
                }
            });
            let points: Vec<String> = points.collect();
            row(&[strength.to_string(), length.to_string(), width.to_string(), points.join("; "), intervals(&stable)]);
        }
    }
    Ok(())
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

/// Instants over half a period.
const INSTANTS: usize = 7;
/// First amplitude of a cycle (R0).
const AMPLITUDE: f64 = 0.2;

/// Limit cycles of width 5 and A = 10, from the Hopf point to an activity of -5.
pub(super) fn cycle(count: usize) -> Result<()> {
    let parameter = Parameter::Activity;
    let state = SteadyState::find(&channel(12.0, 5.0, -2.5, 10.0, count))?;
    let spectrum = state.spectrum()?;
    let swing = |mode: &&steady_states::Eigenmode| mode.value.im > 0.0 && mode.symmetry == Symmetry::Antisymmetric;
    let mode = spectrum.modes.iter().find(swing).context("no swings")?;
    let hopf = state.critical(mode, parameter)?;
    head(&["activity", "amplitude", "period", "mean speed"]);
    row(&[
        format!("{:.6}", activity(&hopf)),
        "0".into(),
        format!("{:.4}", std::f64::consts::TAU / hopf.mode.value.im),
        format!("{:.6}", hopf.state.velocity().x),
    ]);
    let show = |cycle: &LimitCycle| -> Result<()> {
        let amplitude = format!("{:.4}", cycle.amplitude()?);
        let value = format!("{:.6}", cycle.value(parameter));
        row(&[value, amplitude, format!("{:.4}", cycle.period()), format!("{:.6}", cycle.mean_speed())]);
        Ok(())
    };
    let mut before = LimitCycle::from_hopf(&hopf, parameter, AMPLITUDE, INSTANTS)?;
    show(&before)?;
    let mut last = LimitCycle::from_hopf(&hopf, parameter, 1.5 * AMPLITUDE, INSTANTS)?;
    show(&last)?;
    let mut factor = 1.0;
    while last.value(parameter) > -5.1 && factor > 0.02 {
        match last.beyond(&before, parameter, factor) {
            Ok(next) => {
                show(&next)?;
                (before, last, factor) = (last, next, 1.15);
            }
            Err(_) => factor *= 0.5,
        }
    }
    show(&last.at(parameter, -5.0)?)
}
