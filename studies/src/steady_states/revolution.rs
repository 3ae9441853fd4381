//! Swimmers in three dimensions: tubes, folds, headings.

use anyhow::{Context, Result};
use motile::motile_base::Region;
use motile::setup::{DropletSetup, Setup};
use motile_tests::validation::Table;
use steady_states::{Continuation, Parameter, SpecialKind, SpecialPoint, SteadyState};

use super::bifurcations::{activity, digits, polarisation};
use super::nodes;

/// Pairs of nodes of a table whose digits should agree.
const PAIR: [usize; 2] = [128, 160];
/// Radii of tubes.
const RADII: [f64; 4] = [2.0, 1.5, 1.25, 1.1];
/// Points of the branch of swimmers, from the threshold past the fold to the threshold again.
const POINTS: usize = 60;

/// A droplet of these viscosities inside and outside.
fn droplet(region: Region, [inside, outside]: [f64; 2], activity: f64, strength: f64, count: usize) -> Setup {
    let droplet = DropletSetup { viscosity: Some(inside), ..DropletSetup::contractile(activity, strength) };
    Setup { region, viscosity: outside, droplets: vec![droplet], method: nodes(count), ..Setup::default() }
}

/// Swimmers of activity -2 in tubes, at two numbers of nodes each.
pub(super) fn tubes() -> Result<Vec<Table>> {
    let header = ["radius", "nodes", "speed", "film", "aspect ratio", "stresslet", "tail", "m = 0", "m = 1"];
    let mut table = Table::new("Swimmers in tubes without flux, viscosities 100, activity -2, A = 4", &header);
    for (radius, count) in RADII.into_iter().flat_map(|radius| PAIR.map(|count| (radius, count))) {
        let mut cells = vec![radius.to_string(), count.to_string()];
        let state = SteadyState::find(&droplet(Region::tube(radius), [100.0; 2], -2.0, 4.0, count))?;
        let seen = state.measured()?;
        let widest = state.profile().positions.iter().map(|x| x.y).fold(0.0, f64::max);
        let leading = state.spectrum()?.leading().map_or(f64::NAN, |mode| mode.value.re);
        cells.extend([digits(seen.speed, 6), digits(radius - widest, 5), digits(seen.aspect_ratio, 6)]);
        cells.extend([digits(seen.stresslet, 6), format!("{:.0e}", state.tail()), format!("{leading:.4}")]);
        cells.push(turning(&state)?);
        table.push(cells);
    }
    Ok(vec![table])
}

/// Leading eigenvalue of disturbances that turn a swimmer.
fn turning(state: &SteadyState) -> Result<String> {
    let spectrum = state.spectrum_around(1)?;
    let value = spectrum.leading().context("no modes")?.value;
    let swing = if value.im == 0.0 { String::new() } else { format!(" + {:.4} i", value.im.abs()) };
    Ok(format!("{:.5}{swing}", value.re))
}

/// Leading eigenvalues of m = 0 and 1 over the nodes.
pub(super) fn headings() -> Result<Vec<Table>> {
    let header = ["viscosities", "activity", "A", "nodes", "m = 0", "m = 1"];
    let mut table = Table::new("Leading growth rates of swimmers in unbounded fluid", &header);
    for (viscosities, activity, strength) in
        [([100.0; 2], -1.0, 2.0), ([100.0; 2], -1.5, 3.0), ([100.0; 2], -2.0, 4.0), ([100.0, 10.0], -1.0, 2.0)]
    {
        for count in PAIR {
            let state = SteadyState::find(&droplet(Region::Space, viscosities, activity, strength, count))?;
            let leading = state.spectrum()?.leading().map_or(f64::NAN, |mode| mode.value.re);
            let [inside, outside] = viscosities;
            let names = [format!("{inside}/{outside}"), activity.to_string(), strength.to_string(), count.to_string()];
            table.push(names.into_iter().chain([format!("{leading:.5}"), turning(&state)?]));
        }
    }
    Ok(vec![table])
}

/// Threshold, fold with its speed, and speed at the threshold, to which a droplet at rest jumps.
fn fold(viscosities: [f64; 2], strength: f64, region: Region, count: usize) -> Result<[f64; 4]> {
    let [inside, outside] = viscosities;
    let guess = -1e-3 * (3.0 * inside + 2.0 * outside);
    let critical = polarisation(&droplet(region, viscosities, guess, strength, count))?;
    let threshold = activity(&critical);
    let range = Continuation::new(Parameter::Activity, 0.5 * threshold, 1.2 * threshold);
    let swimmers = Continuation { largest_step: 0.008, most_points: POINTS, ..range };
    let point = SpecialPoint::new(SpecialKind::BranchPoint, critical, Parameter::Activity);
    let mut turned = false;
    let branch = swimmers.switch(&point, true, |point, special| {
        turned |= special.iter().any(|point| point.kind == SpecialKind::Fold);
        !turned || point.value > threshold
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
pub(super) fn folds() -> Result<Vec<Table>> {
    let header = ["viscosities", "A", "threshold", "fold", "fold over threshold", "speed there", "jump"];
    let mut table = Table::new("Onset of swimming in unbounded fluid", &header);
    for (viscosities, strength) in
        [([100.0; 2], 0.5), ([100.0; 2], 1.0), ([100.0; 2], 4.0), ([10.0, 100.0], 0.5), ([100.0, 10.0], 0.5)]
    {
        let [inside, outside] = viscosities;
        let mut cells = vec![format!("{inside}/{outside}"), strength.to_string()];
        match fold(viscosities, strength, Region::Space, 64) {
            Ok(values) => {
                let [threshold, fold, speed, jump] = values;
                let values = [(threshold, 6), (fold, 6), (fold / threshold, 5), (speed, 4), (jump, 4)];
                cells.extend(values.map(
                    |(value, count)| {
                        if value.is_finite() { digits(value, count) } else { "none".to_owned() }
                    },
                ));
            }
            Err(error) => cells.extend([
                error.to_string().replace(',', ";"),
                String::new(),
                String::new(),
                String::new(),
                String::new(),
            ]),
        }
        table.push(cells);
    }
    Ok(vec![table])
}
