//! Branch of steady states over the activity, for the map of speeds.

use motile::motile_base::Region;
use motile::setup::{Exclusion, IntegralMethod, Method, Setup};
use steady_states::{BranchPoint, Continuation, Parameter, SteadyState};

use crate::Refusal;

/// Nodes and cells for the map, which is drawn a few hundred pixels wide.
const RESOLUTION: IntegralMethod = IntegralMethod { nodes: 40, cells: 160 };
/// Weakest and strongest activity of the map, in units of a tenth of the tension times the radius.
const RANGE: [f64; 2] = [-8.0, -0.2];
/// Activity from which a branch is followed both ways: the droplet swims there.
const START: f64 = -2.0;
/// Longest step along it.
const STEP: f64 = 0.12;

/// Point of the map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MapPoint {
    /// Activity (force times length).
    pub activity: f64,
    /// Speed (length per time).
    pub speed: f64,
    /// True if no small disturbance grows.
    pub stable: bool,
}

/// Description whose steady states are drawn behind a scene; `None` where there is no such branch: more than one
/// droplet, anything else in the fluid, an imposed flow, another method than boundary integrals.
#[must_use]
pub fn mapped(setup: &Setup) -> Option<Setup> {
    let alone = setup.suspension.is_empty() && setup.droplets.len() == 1 && setup.flow.is_none();
    let others = [
        setup.solids.len(),
        setup.rigid_bodies.len(),
        setup.shells.len(),
        setup.gels.len(),
        setup.interfaces.len(),
        setup.walls.len(),
    ];
    let particles = setup.droplets.first()?.particles.as_ref()?;
    let plain = particles.exchange.is_none() && setup.droplets[0].gel.is_none();
    let integral = matches!(setup.method, Method::Integral(_));
    let simple = !matches!(setup.region, Region::Space | Region::Tube { .. });
    if !(alone && plain && integral && simple && others.iter().all(|count| *count == 0)) {
        return None;
    }
    let mut map = Setup { method: Method::Integral(RESOLUTION), repulsion: None, least_gap: None, ..setup.clone() };
    map.droplets[0].centre = [0.0; 2];
    map.droplets[0].angle = 0.0;
    Some(map)
}

/// Follows the branch of swimmers both ways and tells `seen` each of its points and whether it is of the first half,
/// until that returns false.
///
/// # Errors
/// A description without a branch; no swimmer at an activity of -2.
pub fn follow(setup: &Setup, mut seen: impl FnMut(MapPoint, bool) -> bool) -> Result<(), Refusal> {
    let none = || Refusal::plain("there is no branch of steady states for this scene");
    let map = mapped(setup).ok_or_else(none)?;
    // The stronger end lies where excluded volume still holds the particles apart.
    let strength = match map.droplets[0].particles.as_ref().map(|particles| particles.excluded_volume) {
        Some(Exclusion::Step(strength)) => -0.75 * strength,
        _ => RANGE[0],
    };
    let strongest = RANGE[0].max(strength);
    let begin = START.max(0.5 * strongest);
    let start = SteadyState::find(&Parameter::Activity.with(&map, begin)?)?;
    let mut going = true;
    for (half, end) in [strongest, RANGE[1]].into_iter().enumerate() {
        if !going {
            break;
        }
        let settings = Continuation { largest_step: STEP, ..Continuation::new(Parameter::Activity, begin, end) };
        settings.follow(&start, |point: &BranchPoint, _| {
            if let Ok(measured) = point.state.measured() {
                let stable = point.spectrum.unstable() == 0;
                going = seen(MapPoint { activity: point.value, speed: measured.speed, stable }, half == 0);
            }
            going
        })?;
    }
    Ok(())
}
