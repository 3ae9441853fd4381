//! Contacts of bodies with one another and with walls: surfaces, gaps and films.

use super::bodies::Bodies;
use crate::{
    FluidView, Hydrodynamics, MarkerGroup,
    body::{StepCause, StepLimit},
    gap::{Films, Gaps, REACH, Repulsion, RepulsionLoad, Surfaces, Surroundings},
};
use motile_base::Vec2;

/// Thinnest gap, in units of the length that contacts are measured in, that sets a step: bodies that touch at the start
/// close as if they were so far apart.
const THINNEST: f64 = 0.02;

/// The surfaces of all bodies, the narrowest gap and the films between them, and what keeps them apart.
#[derive(Debug, Default)]
pub(in crate::scene) struct Contacts {
    pub(super) surfaces: Surfaces,
    films: Films,
    /// How far films were looked for since surfaces and surroundings have been as they are (length).
    looked: Option<f64>,
    /// The gaps of the present state.
    pub(super) gaps: Gaps,
    /// The gap to walls in the present state (length), the number of the body and the place of its marker, once looked
    /// for.
    pub(super) nearest_wall: Option<Option<(f64, usize, Vec2)>>,
    /// Time until the first film closes at its present velocity (time), and the number of its body.
    closing: Option<(f64, usize)>,
    /// Narrowest film between fluid interfaces that is near enough to be looked for (length).
    thinnest: Option<f64>,
    /// Fastest rate at which a repulsion opens the present films (1/time).
    opening: f64,
    /// Narrowest gap that a run continues with (length).
    pub(in crate::scene) least_gap: Option<f64>,
    pub(in crate::scene) repulsion: Option<Repulsion>,
}

impl Contacts {
    /// Lays out the surfaces through the markers.
    pub(super) fn lay_out(&mut self, bodies: &Bodies, [period, _]: [Option<f64>; 2]) {
        self.surfaces.update(&bodies.markers, period.unwrap_or(0.0));
        self.looked = None;
    }

    /// Finds the interfaces that the bodies lie in, and the gaps.
    pub(super) fn find_gaps(&mut self, bodies: &mut Bodies, view: &FluidView) {
        bodies.find_surroundings(&self.surfaces, view.domain.periods);
        self.looked = None;
        self.gaps = self.surfaces.gaps_near(view, self.least_gap.unwrap_or_default());
    }

    /// Adds the forces of the repulsion, if there is one, to the forces of the markers.
    pub(super) fn push_apart(&mut self, bodies: &mut Bodies, flow: &impl Hydrodynamics) {
        if let Some(repulsion) = self.repulsion {
            self.find_films(bodies, flow, repulsion.range());
            self.films.push_apart(&repulsion, &self.surfaces, &mut bodies.markers.forces);
        }
    }

    /// Finds how fast films close, and how fast a repulsion opens them.
    pub(super) fn measure_films(&mut self, bodies: &Bodies, flow: &impl Hydrodynamics) {
        (self.closing, self.opening, self.thinnest) = (None, 0.0, None);
        if !bodies.have_curves() {
            return;
        }
        let view = flow.fluid_view();
        let scale = self.surfaces.contact_scale(&view);
        self.find_films(bodies, flow, self.repulsion.map_or(0.0, |repulsion| repulsion.range()).max(REACH * scale));
        self.thinnest = self.films.thinnest_between_fluids(&self.surfaces);
        self.closing = self.films.closing(&self.surfaces, bodies.markers.velocities(), THINNEST * scale);
        if let Some(repulsion) = &self.repulsion {
            let mean = |group: &MarkerGroup| 0.5 * group.viscosities(view.viscosity).iter().sum::<f64>();
            let least = bodies.markers.groups().iter().map(mean).fold(f64::INFINITY, f64::min);
            self.opening = self.films.relaxation(repulsion, view.viscosity, view.interface_stiffness / least);
        }
    }

    /// Returns the part of the bound on the step by a stabilised tension that a second interface leaves, in a flow that
    /// resolves interfaces by modes.
    ///
    /// Tensions that vary in the same way along two interfaces at the distance d move each of them `N = 1 + (1 - q d)
    /// exp(-q d)` times as fast at the wave number q. A step of the midpoint rule amplifies such a wave where `dt c
    /// |gamma'| q (N/2 - q h) > 4 eta`. Below the length h, the flow no longer responds to forces
    /// (docs/explanation/time-stepping.md). On one interface, waves of q h = 1/4 grow first.
    pub(super) fn stabilised_part(&self, view: &FluidView) -> f64 {
        let Some(gap) = self.thinnest.filter(|_| view.shape_modes.is_some()) else { return 1.0 };
        let distance = 2.0 * view.interface_stiffness * gap.max(0.0);
        let fastest = (1..64).map(|k| f64::from(k) / 64.0).map(|wave| {
            let mobility = 1.0 + (1.0 - wave * distance) * (-wave * distance).exp();
            wave * (0.5 * mobility - wave)
        });
        (0.0625 / fastest.fold(0.0625, f64::max)).min(1.0)
    }

    /// Returns the load of the repulsion in the present films.
    pub(super) fn load(&self) -> Option<RepulsionLoad> {
        self.repulsion.map(|repulsion| self.films.load(&repulsion, &self.surfaces))
    }

    fn find_films(&mut self, bodies: &Bodies, flow: &impl Hydrodynamics, reach: f64) {
        if self.looked == Some(reach) {
            return;
        }
        let (domain, walls) = (flow.fluid_view().domain, flow.walls());
        let axisymmetric = flow.axisymmetric();
        self.films.find(&self.surfaces, Surroundings { domain, walls, around: &bodies.enclosing, axisymmetric }, reach);
        self.looked = Some(reach);
    }

    /// Reports to `each` the bounds on the time step that films set, with the names of the bodies.
    pub(super) fn each_limit<'a>(&self, bodies: &'a Bodies, viscosity: f64, each: &mut dyn FnMut(StepLimit, &'a str)) {
        if let Some((dt, body)) = self.closing {
            let cause = StepCause::Accuracy;
            each(StepLimit { dt, reason: "the closing of a film", cause }, bodies.list[body].name());
        }
        if let Some(repulsion) = &self.repulsion {
            let rate = self.opening.max(repulsion.usual_rate(viscosity));
            each(StepLimit::decay(2.0 / rate, "the repulsion"), "the interfaces");
        }
    }
}
