//! The flow that is imposed on a scene, in time.

use std::{fmt, sync::Arc};

use motile_base::ImposedFlow;

use super::System;
use crate::{FlowError, Hydrodynamics, SceneError};

/// A flow that is imposed on a scene: a steady one, or a function of time.
///
/// ```
/// use motile_base::ImposedFlow;
/// use motile_scene::Imposed;
///
/// let steady = Imposed::from(ImposedFlow::shear(1.0));
/// let oscillating = Imposed::of_time(|time| ImposedFlow::extension(0.1 * time.cos()));
/// assert_eq!(steady.at(3.0), ImposedFlow::shear(1.0));
/// assert_eq!(oscillating.at(0.0), ImposedFlow::extension(0.1));
/// ```
#[derive(Clone)]
pub struct Imposed(Law);

#[derive(Clone)]
enum Law {
    Steady(ImposedFlow),
    OfTime(Arc<dyn Fn(f64) -> ImposedFlow + Send + Sync>),
}

impl Imposed {
    /// Returns a flow as a function of the time of the scene (time).
    pub fn of_time(flow: impl Fn(f64) -> ImposedFlow + Send + Sync + 'static) -> Self {
        Self(Law::OfTime(Arc::new(flow)))
    }

    /// Returns the flow at a time (time).
    #[must_use]
    pub fn at(&self, time: f64) -> ImposedFlow {
        match &self.0 {
            Law::Steady(flow) => *flow,
            Law::OfTime(flow) => flow(time),
        }
    }

    fn is_steady(&self) -> bool {
        matches!(self.0, Law::Steady(_))
    }
}

impl From<ImposedFlow> for Imposed {
    fn from(flow: ImposedFlow) -> Self {
        Self(Law::Steady(flow))
    }
}

impl fmt::Debug for Imposed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Law::Steady(flow) => flow.fmt(f),
            Law::OfTime(_) => f.write_str("a function of time"),
        }
    }
}

/// Entries of the state of a scene whose flow changes: the time and the strain, which integrators advance with the
/// bodies. Each of their stages therefore has the flow and the images of its time.
const CLOCK: usize = 2;

/// The imposed flow with the time and the strain that it is at.
#[derive(Debug, Clone)]
pub(super) struct Background {
    imposed: Imposed,
    time: f64,
    /// True where the flow or the images that it displaces change in time.
    moves: bool,
}

impl Background {
    pub(super) fn none() -> Self {
        Self { imposed: ImposedFlow::NONE.into(), time: 0.0, moves: false }
    }
}

impl<H: Hydrodynamics> System<H> {
    /// Imposes a flow from now on, in place of the one that there was.
    pub(crate) fn impose(&mut self, imposed: Imposed) -> Result<(), SceneError> {
        let time = self.clock.time;
        let flow = imposed.at(time);
        let sheared = !flow.is_none() && self.hydrodynamics.fluid_view().domain.periods[1].is_some();
        let moves = sheared || !imposed.is_steady();
        self.set_flow(flow, self.hydrodynamics.strain())?;
        self.background = Background { imposed, time, moves };
        Ok(())
    }

    fn set_flow(&mut self, flow: ImposedFlow, strain: f64) -> Result<(), SceneError> {
        let failed = |source: FlowError| SceneError::Flow { time: self.clock.time, source };
        self.hydrodynamics.impose(flow, strain).map_err(failed)?;
        self.forget_flow();
        Ok(())
    }

    /// Returns the flow that is imposed in the present state: part of all velocities.
    #[must_use]
    pub fn imposed(&self) -> ImposedFlow {
        self.hydrodynamics.imposed()
    }

    /// Returns the length of the part of the state that is the clock of the imposed flow.
    pub(super) fn clock_len(&self) -> usize {
        if self.background.moves || self.bodies.timed { CLOCK } else { 0 }
    }

    pub(super) fn write_clock(&self, state: &mut [f64]) {
        if let [time, strain] = state {
            (*time, *strain) = (self.background.time, self.hydrodynamics.strain());
        }
    }

    pub(super) fn read_clock(&mut self, state: &[f64]) -> Result<(), SceneError> {
        let &[time, strain] = state else { return Ok(()) };
        if time != self.background.time || strain != self.hydrodynamics.strain() {
            self.background.time = time;
            self.bodies.set_time(time);
            self.set_flow(self.background.imposed.at(time), strain)?;
        }
        Ok(())
    }

    pub(super) fn write_clock_rate(&self, rate: &mut [f64]) {
        if let [time, strain] = rate {
            (*time, *strain) = (1.0, self.hydrodynamics.imposed().shear_rate());
        }
    }

    /// Takes over the strain of the images of a sheared box (no dimension); elsewhere there is none.
    pub(crate) fn take_strain(&mut self, strain: f64) -> Result<(), SceneError> {
        let sheared = self.background.moves && self.hydrodynamics.fluid_view().domain.periods[1].is_some();
        if sheared { self.set_flow(self.imposed(), strain) } else { Ok(()) }
    }

    /// Takes the time of the clock over for the imposed flow.
    pub(super) fn set_flow_time(&mut self) -> Result<(), SceneError> {
        self.follow_clock();
        let flow = self.background.imposed.at(self.clock.time);
        if flow == self.imposed() { Ok(()) } else { self.set_flow(flow, self.hydrodynamics.strain()) }
    }

    /// Takes the time of the clock over for the state and the bodies.
    pub(super) fn follow_clock(&mut self) {
        self.background.time = self.clock.time;
        self.bodies.set_time(self.clock.time);
    }

    /// Returns the imposed flow at another time (time) than the present one; a steady one is what the flow has.
    pub(crate) fn imposed_at(&self, time: f64) -> ImposedFlow {
        let imposed = &self.background.imposed;
        if imposed.is_steady() { self.imposed() } else { imposed.at(time) }
    }

    /// Returns true for an imposed flow that is a function of time.
    pub(crate) fn is_flow_of_time(&self) -> bool {
        !self.background.imposed.is_steady()
    }
}

/// Returns the numbers of an imposed flow by their names, without those that are zero.
pub(crate) fn flow_properties(flow: ImposedFlow) -> impl Iterator<Item = (&'static str, f64)> {
    let ImposedFlow { velocity: [u, v], gradient: [[ux, uy], [vx, _]], bend } = flow;
    let numbers = [
        ("the velocity along x of the imposed flow", u),
        ("the velocity along y of the imposed flow", v),
        ("the gradient du/dx of the imposed flow", ux),
        ("the gradient du/dy of the imposed flow", uy),
        ("the gradient dv/dx of the imposed flow", vx),
        ("the curvature d2u/dy2 of the imposed flow", bend),
    ];
    numbers.into_iter().filter(|(_, value)| *value != 0.0)
}
