//! Steady swimmers over the length of a channel and over viscosities.

use anyhow::Result;
use motile::stokes_grid::Drive;
use motile::{DropletSetup, Region, Setup};
use motile_examples::say;
use steady_states::{Continuation, Parameter, SteadyState};

use super::{channel, head, nodes, row};

/// Lengths of the table.
const LENGTHS: [f64; 10] = [8.0, 10.0, 12.0, 16.0, 24.0, 36.0, 48.0, 72.0, 96.0, 144.0];

/// Speeds over the length of a channel of width 2, and two laws.
pub(super) fn length(count: usize) -> Result<()> {
    let speed = |length: f64, drive: Drive| -> Result<f64> {
        let mut setup = channel(length, 2.0, -2.0, 10.0, count);
        setup.region = Region::Channel { length, width: 2.0, drive };
        Ok(SteadyState::find(&setup)?.measured()?.speed)
    };
    let mut points = Vec::new();
    head(&["length", "speed, zero gradient", "speed, zero flux"]);
    for length in LENGTHS {
        let found = [Drive::ZeroGradient, Drive::ZeroFlux].map(|drive| speed(length, drive));
        let told = found.iter().map(|speed| match speed {
            Ok(speed) => format!("{speed:.8}"),
            Err(error) => error.to_string(),
        });
        row(&std::iter::once(length.to_string()).chain(told).collect::<Vec<_>>());
        if let [Ok(open), closed] = found {
            points.push((length, open, closed.unwrap_or(f64::NAN)));
        }
    }
    let limit = points.last().map_or(f64::NAN, |point| point.2);
    say("");
    head(&["law", "parameters", "largest residual"]);
    // U = a + b exp(-l/c): linear in a and b for each c.
    let best = (1..4000).map(|k| 0.05 * f64::from(k)).map(|c| (fit(&points, |l| (-l / c).exp()), c));
    if let Some(((a, b, worst), c)) = best.min_by(|x, y| x.0.2.total_cmp(&y.0.2)) {
        row(&["a + b exp(-l/c)".into(), format!("a = {a:.6}, b = {b:.6}, c = {c:.2}"), format!("{worst:.1e}")]);
    }
    // U = a + b/(l + c).
    let best = (-140..8000).map(|k| 0.05 * f64::from(k)).map(|c| (fit(&points, |l| 1.0 / (l + c)), c));
    if let Some(((a, b, worst), c)) = best.min_by(|x, y| x.0.2.total_cmp(&y.0.2)) {
        row(&["a + b/(l + c)".into(), format!("a = {a:.6}, b = {b:.6}, c = {c:.2}"), format!("{worst:.1e}")]);
    }
    say(format_args!("\nzero flux at the largest length: {limit:.6}"));
    Ok(())
}

/// Least squares of U = a + b f(l): a, b, largest residual.
fn fit(points: &[(f64, f64, f64)], f: impl Fn(f64) -> f64) -> (f64, f64, f64) {
    let n = points.len() as f64;
    let (mut x, mut y, mut xx, mut xy) = (0.0, 0.0, 0.0, 0.0);
    for (l, u, _) in points {
        let v = f(*l);
        (x, y, xx, xy) = (x + v, y + u, xx + v * v, xy + v * u);
    }
    let b = (n * xy - x * y) / (n * xx - x * x);
    let a = (y - b * x) / n;
    (a, b, points.iter().map(|(l, u, _)| (u - a - b * f(*l)).abs()).fold(0.0, f64::max))
}

/// Swimmers over the viscosity ratio at fixed sum, and strongly active ones.
pub(super) fn contrast(count: usize) -> Result<()> {
    head(&["inside/outside", "speed", "aspect ratio", "c max", "least curvature", "growth rate", "symmetry"]);
    let droplet = DropletSetup { viscosity: Some(100.0), ..DropletSetup::active(-2.0) };
    let setup = Setup { method: nodes(count), droplets: vec![droplet], ..Setup::default() };
    let start = SteadyState::find(&setup)?;
    for (from, to) in [(1.0, 0.02), (1.0, 50.0)] {
        let settings = Continuation { largest_step: 0.25, ..Continuation::new(Parameter::ViscosityRatio, from, to) };
        settings.follow(&start, |point, special| {
            for special in special {
                let at = Parameter::ViscosityRatio.get(special.critical.state.setup()).unwrap_or(f64::NAN);
                row(&[format!("{at:.4}"), special.kind.name().into()]);
            }
            describe(&format!("{:.4}", point.value), &point.state, point.spectrum.leading());
            true
        })?;
    }
    say("");
    head(&[
        "inside, outside, activity, A",
        "speed",
        "aspect ratio",
        "c max",
        "least curvature",
        "growth rate",
        "symmetry",
    ]);
    for (inside, outside, activity) in [(1000.0, 500.0, -15.0), (1000.0, 100.0, -10.0)] {
        for strength in [13.5, 16.0, 20.0, 25.0, 30.0] {
            let name = format!("{inside}, {outside}, {activity}, {strength}");
            let droplet = DropletSetup { viscosity: Some(inside), ..DropletSetup::contractile(activity, strength) };
            let setup = Setup { method: nodes(count), viscosity: outside, droplets: vec![droplet], ..Setup::default() };
            match SteadyState::find(&setup) {
                Ok(state) => describe(&name, &state, state.spectrum()?.leading()),
                Err(error) => row(&[name, error.to_string()]),
            }
        }
    }
    Ok(())
}

fn describe(name: &str, state: &SteadyState, leading: Option<&steady_states::Eigenmode>) {
    let Ok(seen) = state.measured() else { return };
    let mode = leading.map_or_else(String::new, |mode| format!("{:.5} + {:.4} i", mode.value.re, mode.value.im));
    row(&[
        name.to_owned(),
        format!("{:.6}", seen.speed),
        format!("{:.5}", seen.aspect_ratio),
        format!("{:.4}", seen.concentration[0]),
        format!("{:.3}", seen.least_curvature),
        mode,
        leading.map_or("", |mode| mode.symmetry.name()).to_owned(),
    ]);
}
