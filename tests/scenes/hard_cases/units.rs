//! Scenes in other units.

use motile::active_interface::ActiveDroplet;
use motile::base::Region;
use motile::base::Vec2;
use motile::setup::Setup;

use crate::hard_cases::drive::{by, run_way};
use crate::hard_cases::{CaseError, Ending, Look, Outcome, Recipe, Trial, Way, expand};
use motile_tests::units::Units;

/// A micrometre, ten seconds and a nanonewton in metres, seconds and newtons.
const SI: Units = Units { length: 1e-6, time: 10.0, force: 1e-9 };
/// Largest distance between markers of the two runs (radii).
const SAME: f64 = 1e-9;

/// A run of two unlike swimmers, and where their markers end, in radii.
fn pair(way: Way, units: Units, until: f64, look: Look<'_>) -> Result<(Outcome, Vec<Vec2>), CaseError> {
    let side = 6.0 * units.length;
    let droplets = vec![units.droplet(-3.0, [-1.2, 0.05], None), units.droplet(-5.0, [1.2, -0.1], None)];
    let region = Region::Box { lengths: [side; 2] };
    let base =
        Setup { region, method: units.grid(0.1), viscosity: units.viscosity(100.0), droplets, ..Setup::default() };
    let mut markers = Vec::new();
    let outcome = run_way(way, by(way, &base).build()?.scene, until * units.time, &mut |system| {
        let found = system.bodies::<ActiveDroplet>().flat_map(|(_, droplet)| droplet.markers());
        markers.extend(found.map(|marker| marker / units.length));
        look(system);
    })?;
    Ok((Outcome { time: outcome.time / units.time, ..outcome }, markers))
}

pub(crate) fn trials() -> Vec<Trial> {
    let ways = &[Way::Grid, Way::Integral, Way::Chebyshev];
    expand(&[Recipe::new(21, "metres, seconds and newtons", ways, |way, extent, look| {
        let until = extent.pick(1.0, 20.0);
        let (plain, expected) = pair(way, Units::PLAIN, until, look)?;
        let (outcome, found) = pair(way, SI, until, &mut |_| ())?;
        let apart = found.iter().zip(&expected).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        let same = apart < SAME && found.len() == expected.len() && outcome.steps == plain.steps;
        let ending = if same || outcome.ending != Ending::Finished { outcome.ending } else { Ending::Differs };
        Ok(Outcome { ending, ..outcome })
    })])
}
