//! Branch of steady states over the activity, for the map of speeds.

use motile::base::Region;
use motile::setup::{ExcludedVolume, IntegralMethod, Method, Setup};
use motile_steady_states::{BranchPoint, Continuation, Parameter, SteadyState};

use crate::Refusal;

/// Nodes and cells for the map, which is drawn a few hundred pixels wide: speeds need fewer, growth rates of droplets
/// that turn do not.
const RESOLUTION: IntegralMethod = IntegralMethod { nodes: 72, elements: 216 };
/// Weakest and strongest activity of the map, in units of a tenth of the tension times the radius.
const RANGE: [f64; 2] = [-8.0, -0.2];
/// Activity from which a branch is followed both ways: the droplet swims there.
const START: f64 = -2.0;
/// Longest step along it.
const STEP: f64 = 0.12;
/// Growth rate of a disturbance of a swimmer that counts as none, over [`motile_steady_states::Spectrum::zero`], 1e-8
/// D/R^2: the error with these nodes.
const NO_GROWTH: f64 = 6e6;
/// Halvings of the range to the threshold at which rest is no longer stable.
const HALVINGS: usize = 12;

/// Line of the map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Line {
    /// Swimmers, from the start to stronger activities.
    Stronger,
    /// Swimmers, from the start to weaker activities.
    Weaker,
    /// Droplets at rest.
    Rest,
}

/// Point of the map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MapPoint {
    /// Line that it is on.
    pub line: Line,
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
        setup.fibres.len(),
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

/// Follows the branch of swimmers both ways, then the droplets at rest, and tells `seen` each point, until that returns
/// false.
///
/// # Errors
/// A description without a branch; no swimmer at an activity of -2.
pub fn follow(setup: &Setup, mut seen: impl FnMut(MapPoint) -> bool) -> Result<(), Refusal> {
    let none = || Refusal::plain("there is no branch of steady states for this scene");
    let map = mapped(setup).ok_or_else(none)?;
    let particles = map.droplets[0].particles.as_ref().ok_or_else(none)?;
    // The stronger end lies where excluded volume still holds the particles apart.
    let strength = match particles.excluded_volume {
        ExcludedVolume::Step(strength) => -0.75 * strength,
        _ => RANGE[0],
    };
    let strongest = RANGE[0].max(strength);
    let begin = START.max(0.5 * strongest);
    let start = SteadyState::find(&Parameter::Activity.with(&map, begin)?)?;
    let mut going = true;
    for (line, end) in [(Line::Stronger, strongest), (Line::Weaker, RANGE[1])] {
        if !going {
            return Ok(());
        }
        let settings = Continuation { largest_step: STEP, ..Continuation::new(Parameter::Activity, begin, end) };
        settings.follow(&start, |point: &BranchPoint, _| {
            if let Ok(measured) = point.state.measured() {
                let spectrum = &point.spectrum;
                let stable = spectrum.leading().is_none_or(|mode| mode.value.re <= NO_GROWTH * spectrum.zero);
                going = seen(MapPoint { line, activity: point.value, speed: measured.speed, stable });
            }
            going
        })?;
    }
    if going {
        for point in rest(&map, begin, strongest)? {
            seen(point);
        }
    }
    Ok(())
}

/// Points of droplets at rest, of a description of the map: no activity, both sides of the threshold at which rest is
/// no longer stable, between no activity and one at which droplets swim, and the strongest activity.
///
/// # Errors
/// Those of a spectrum.
pub fn rest(map: &Setup, swims: f64, strongest: f64) -> Result<Vec<MapPoint>, Refusal> {
    // A circle is what it is with any nodes: every growth counts.
    let rests = |activity: f64| -> Result<bool, Refusal> {
        Ok(SteadyState::uniform(&Parameter::Activity.with(map, activity)?)?.spectrum()?.unstable() == 0)
    };
    let (mut weak, mut strong) = (0.1 * RANGE[1], swims);
    if !rests(weak)? || rests(strong)? {
        return Ok(Vec::new());
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (weak + strong);
        *(if rests(middle)? { &mut weak } else { &mut strong }) = middle;
    }
    let points = [(0.0, true), (weak, true), (strong, false), (strongest, false)];
    let point = |(activity, stable)| MapPoint { line: Line::Rest, activity, speed: 0.0, stable };
    Ok(points.map(point).to_vec())
}
