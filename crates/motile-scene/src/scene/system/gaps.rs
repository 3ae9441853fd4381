//! Gaps between the bodies of a system and to walls: measured, checked and recorded.

use std::borrow::Cow;

use super::{Known, System, findings::lower};
use crate::{
    Body, FluidView, Handle, Hydrodynamics, MarkerKind, SceneError, Warning,
    gap::{Boundary, CoarseGap, Gap, NearestSolid, Outline, Overlap, Repulsion, RepulsionLoad, Surfaces, wall_gap},
};
use motile_base::{
    Drive, Vec2,
    internal::{decimals, told_apart},
};

/// The narrowest films in which velocities are within about 1 %, in grid spacings, and in distances of neighbouring
/// nodes of an interface if there is no grid.
const RESOLVED_CELLS: f64 = 1.0;
/// Narrowest films of that accuracy in channels of given flux: the fluid that a droplet displaces has to pass the gap,
/// and the error is larger for slow swimmers.
const RESOLVED_CELLS_CLOSED: f64 = 5.5;
const RESOLVED_NODES: f64 = 0.3;
/// Largest number of nodes that is recommended: what curves can have.
const MOST_NODES: f64 = 4096.0;

impl<H: Hydrodynamics> System<H> {
    /// Returns the smallest distance of an interface to a rigid wall or obstacle at the present state (length; negative
    /// beyond a wall, see [`wall_gap`]). It is `None` without walls or interfaces. Solids
    /// ([`MarkerKind::Points`](crate::MarkerKind)) may stand on a wall and do not count. Needs no evaluation.
    pub fn wall_gap(&mut self) -> Option<f64> {
        self.nearest_wall().map(|(gap, ..)| gap)
    }

    /// Returns the gap of [`System::wall_gap`], the body, and the place of its marker (length), found once in a state.
    fn nearest_wall(&mut self) -> Option<(f64, usize, Vec2)> {
        let bounded = self.hydrodynamics.fluid_view().domain.walls.is_some() || self.hydrodynamics.walls().is_some();
        if bounded {
            self.place_markers();
            let found = self.contacts.nearest_wall.unwrap_or_else(|| self.find_nearest_wall(true));
            self.contacts.nearest_wall = Some(found);
        }
        self.contacts.nearest_wall.flatten()
    }

    /// Returns the like without the films of rigid bodies at straight walls, if the flow resolves interfaces by modes.
    /// Such a flow refuses a film in which the speed of a rigid body would be off by 1 %.
    fn unrefused_wall_gap(&mut self) -> Option<f64> {
        let (gap, body, _) = self.nearest_wall()?;
        let refuses = self.hydrodynamics.fluid_view().shape_modes.is_some();
        if refuses && self.bodies.list[body].kind() == MarkerKind::Rigid {
            return self.find_nearest_wall(false).map(|(gap, ..)| gap);
        }
        Some(gap)
    }

    fn find_nearest_wall(&self, films_of_rigid: bool) -> Option<(f64, usize, Vec2)> {
        let (domain, others) = (self.hydrodynamics.fluid_view().domain, self.hydrodynamics.walls());
        // Keeps what is not a number.
        let nearer = |least: (f64, _, _), gap: (f64, _, _)| if gap.0 < least.0 || gap.0.is_nan() { gap } else { least };
        let groups = self.bodies.markers.groups().iter().enumerate();
        let gaps = groups.filter(|(_, group)| group.kind.is_curve()).flat_map(|(body, group)| {
            let places = &self.bodies.markers.positions[group.range.clone()];
            let of_straight = |walls| places.iter().map(move |place| (wall_gap(&[*place], walls), body, *place));
            let walls = domain.walls.filter(|_| films_of_rigid || self.bodies.list[body].kind() != MarkerKind::Rigid);
            let straight = walls.and_then(|walls| of_straight(walls).reduce(nearer));
            let others = others.and_then(|walls| walls.smallest(places, domain.periods));
            [straight, others.map(|(gap, marker)| (gap, body, places[marker]))].into_iter().flatten()
        });
        gaps.reduce(nearer)
    }

    /// Returns the gap between two bodies at the present state (length). It is the smallest distance of the corners of
    /// the boundary of each, or of its markers if it has none, from the boundary of the other, over all images.
    /// Negative where the bodies overlap; for a body inside an interface the distance from within. `None` where neither
    /// has a boundary. Needs no evaluation, but memory and time.
    ///
    /// # Errors
    /// Returns [`SceneError::Refused`] for a handle of another scene.
    pub fn gap(
        &self,
        first: impl Into<Handle<dyn Body>>,
        second: impl Into<Handle<dyn Body>>,
    ) -> Result<Option<f64>, SceneError> {
        let periods = self.hydrodynamics.fluid_view().domain.periods;
        let outline = |body: Handle<dyn Body>| Ok::<_, SceneError>(Outline::of(self.any_body(body)?, periods));
        Ok(outline(first.into())?.gap(&outline(second.into())?, periods))
    }

    /// Returns the smallest [`System::wall_gap`] since the start (length): over the states after each addition of a
    /// body and at the end of each step.
    #[must_use]
    pub fn minimum_wall_gap(&self) -> Option<f64> {
        self.findings.wall_gap
    }

    /// Returns the smallest gap between an interface and another body, its own image in a periodic domain, or a wall
    /// (length) over the run. It is taken over the states at the start and at the ends of steps, and the present state.
    /// Of a body and its own image the states count in which the gap is below four grid spacings (without a grid four
    /// times the distance of markers), and the present one. For walls the states of [`System::minimum_wall_gap`]. Gaps
    /// between two solids do not count. Negative where bodies overlap; `None` if there is no such gap. Needs no
    /// evaluation, but memory and time.
    #[must_use]
    pub fn minimum_gap(&self) -> Option<f64> {
        let present = self.surfaces().narrowest(&self.hydrodynamics.fluid_view()).map(|gap| gap.width);
        [self.findings.gap, self.findings.wall_gap, present].into_iter().flatten().reduce(f64::min)
    }

    /// Returns the pairs of bodies, at least one of them an interface, whose surfaces are closer than `reach` (length)
    /// at the present state, each once, with the narrowest gap between them (length; negative where they overlap). A
    /// body and its own image are a pair too. Needs no evaluation.
    #[must_use]
    pub fn pairs_within(&self, reach: f64) -> Vec<([Handle<dyn Body>; 2], f64)> {
        let pairs = self.surfaces().pairs_near(&self.hydrodynamics.fluid_view(), reach);
        let handle = |body: usize| Handle::new(self.bodies.scene, body);
        pairs.into_iter().map(|(bodies, gap)| (bodies.map(handle), gap)).collect()
    }

    /// Returns the surfaces of the bodies in the present state, laid out again if they are not known.
    fn surfaces(&self) -> Cow<'_, Surfaces> {
        if self.known >= Known::Surfaces {
            return Cow::Borrowed(&self.contacts.surfaces);
        }
        let periods = self.hydrodynamics.fluid_view().domain.periods;
        Cow::Owned(Surfaces::of(
            self.bodies.list.iter().map(|body| (Boundary::of(body.as_ref(), periods), body.kind())),
        ))
    }

    /// Returns the place where an interface is nearest to a solid at the present state.
    pub(crate) fn nearest_solid(&self) -> Option<NearestSolid> {
        let found = self.surfaces().nearest_solid(self.hydrodynamics.fluid_view().domain.periods);
        found.map(|(gap, body, marker, place)| NearestSolid {
            gap,
            interface: Handle::new(self.bodies.scene, body),
            marker,
            place,
        })
    }

    /// Returns the doubts about the accuracy of the present state. These are the doubts of the flow and of the bodies,
    /// and films that the method does not resolve.
    pub fn warnings(&mut self) -> Vec<Warning> {
        if self.known < Known::Apart {
            // No step has looked at the gaps of this state.
            self.find_gaps();
        }
        let view = self.hydrodynamics.fluid_view();
        // Bodies of one name are told apart by their numbers.
        let of_bodies = self.bodies.list.iter().enumerate().flat_map(|(index, body)| {
            let (name, full) = (body.name().to_owned(), self.bodies.name_of(index));
            let own = move |warning: Warning| {
                if warning.body == name { Warning { body: full.clone(), ..warning } } else { warning }
            };
            body.warnings(&view).into_iter().map(own)
        });
        let mut warnings: Vec<Warning> = self.hydrodynamics.warnings().into_iter().chain(of_bodies).collect();
        let between = self
            .contacts
            .gaps
            .narrowest
            // Those between rigid bodies are judged by the nodes beside them.
            .filter(|gap| on_grid(&view).is_some() || ![gap.body, gap.other].iter().all(|&body| self.is_rigid(body)))
            .map(|gap| (gap.width, self.bodies.name_of(gap.body), self.bodies.name_of(gap.other)));
        let walls = self.unrefused_wall_gap().map(|gap| (gap, "interfaces".to_owned(), "the walls".to_owned()));
        let resolved = self.resolved_film();
        for (gap, body, other) in between.into_iter().chain(walls).filter(|(gap, ..)| *gap < resolved) {
            let [gap_text, resolved_text] = told_apart([gap, resolved]);
            let message = format!(
                "the gap from {other} is {gap_text} (length), below {resolved_text}, the thinnest film that is \
                 resolved: speeds may be off by a per cent and more; use {}",
                finer(&view, resolved / gap)
            );
            warnings.push(Warning {
                body,
                cause: "thin film".into(),
                excess: resolved / gap.max(1e-3 * resolved),
                message,
            });
        }
        let coarse = [self.coarse_pair(), self.coarse_wall(), self.coarse_straight()].into_iter().flatten();
        warnings.extend(coarse.map(|gap| self.coarse_warning(&gap, &view)));
        warnings.extend(self.solids_below_bound());
        warnings
    }

    fn is_rigid(&self, body: usize) -> bool {
        self.bodies.markers.groups()[body].kind == MarkerKind::Rigid
    }

    /// Returns the gap between a rigid body and another body that the nodes resolve worst.
    fn coarse_pair(&self) -> Option<CoarseGap> {
        let view = self.hydrodynamics.fluid_view();
        self.contacts.surfaces.coarse_pair(&view.domain, view.nodes?)
    }

    /// Returns the gap between a body and a rigid wall that the nodes resolve worst.
    fn coarse_wall(&self) -> Option<CoarseGap> {
        let (view, spacings) = (self.hydrodynamics.fluid_view(), self.hydrodynamics.wall_spacings());
        let walls = self.hydrodynamics.walls().filter(|_| !spacings.is_empty())?;
        self.contacts.surfaces.coarse_wall(&view.domain, view.nodes?, walls, spacings)
    }

    /// Returns the gap between a rigid body and a straight wall that the nodes of the body resolve worst.
    fn coarse_straight(&self) -> Option<CoarseGap> {
        let view = self.hydrodynamics.fluid_view();
        self.contacts.surfaces.coarse_straight(view.nodes?, view.domain.walls?)
    }

    /// Refuses a body so close to a rigid wall that the nodes of the wall make nothing of the flow between them.
    fn check_wall_nodes(&self) -> Result<(), SceneError> {
        match self.coarse_wall().filter(CoarseGap::is_of_no_use) {
            None => Ok(()),
            Some(CoarseGap { body, width, spacings: [_, spacing], resolved, .. }) => {
                let body = self.bodies.name_of(body);
                Err(SceneError::coarse_wall(self.clock.time, &body, width, spacing, resolved))
            }
        }
    }

    /// Returns the warning of a gap that nodes do not resolve.
    fn coarse_warning(&self, gap: &CoarseGap, view: &FluidView) -> Warning {
        let &CoarseGap { body, other, width, spacings: [own, others], resolved, .. } = gap;
        let [widest, resolved_text] = told_apart([own.max(others), resolved]);
        let nodes = finer(view, own.max(if other.is_some() { others } else { 0.0 }) / resolved);
        let spacing = format!("a wall spacing of {} there", decimals(4, resolved));
        let remedy = match (other, own > resolved, others > resolved) {
            (Some(_), ..) | (None, true, false) => nodes,
            (None, false, _) => spacing,
            (None, true, true) => format!("{nodes} and {spacing}"),
        };
        let other = other.map_or_else(|| "the rigid walls".to_owned(), |other| self.bodies.name_of(other));
        let message = format!(
            "the gap from {other} is {} (length), and nodes beside it are {widest} apart, more than {resolved_text}: \
             they do not resolve the flow next to a rigid surface in so narrow a gap, and speeds may be off by a per \
             cent and more; use {remedy}",
            decimals(4, width),
        );
        Warning { body: self.bodies.name_of(body), cause: "thin film".into(), excess: gap.excess().min(1e3), message }
    }

    /// Returns the narrowest film in which velocities are within about 1 % (length).
    fn resolved_film(&self) -> f64 {
        let view = self.hydrodynamics.fluid_view();
        let closed = matches!(self.hydrodynamics.drive(), Some(Drive::ZeroFlux | Drive::Flux(_)));
        let cells = if closed { RESOLVED_CELLS_CLOSED } else { RESOLVED_CELLS };
        let nodes = || RESOLVED_NODES * self.node_spacing(&view);
        on_grid(&view).map_or_else(nodes, |spacing| cells * spacing)
    }

    /// Returns the largest distance of neighbouring nodes of an interface (length).
    fn node_spacing(&self, view: &FluidView) -> f64 {
        let groups = self.bodies.markers.groups().iter().filter(|group| group.kind.is_curve());
        let spacings = groups.map(|group| {
            let markers = &self.bodies.markers.positions[group.range.clone()];
            let perimeter: f64 = markers.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
            perimeter / view.nodes.unwrap_or(markers.len()) as f64
        });
        spacings.fold(0.0, f64::max)
    }

    /// Returns the repulsion between interfaces, if it is on.
    #[must_use]
    pub fn repulsion(&self) -> Option<&Repulsion> {
        self.contacts.repulsion.as_ref()
    }

    /// Returns the load of the repulsion in the present state; `None` if it is off. The flow is computed if it is not
    /// known yet.
    ///
    /// # Errors
    /// Returns the errors of [`System::evaluate`].
    pub fn repulsion_load(&mut self) -> Result<Option<RepulsionLoad>, SceneError> {
        self.evaluate()?;
        Ok(self.contacts.load())
    }

    /// Looks at how the bodies lie before anything is computed for them, unless that is known: they may not overlap by
    /// more than [`Surfaces::allowed`].
    pub(super) fn check_bodies(&mut self) -> Result<(), SceneError> {
        if self.known >= Known::Apart {
            return Ok(());
        }
        self.bodies.check_interior_bodies()?;
        self.find_gaps();
        let view = self.hydrodynamics.fluid_view();
        if let Some((body, other, viscosities)) = self.contacts.surfaces.conflict(view.domain.periods, view.viscosity) {
            let bodies = [body, other].map(|index| self.bodies.name_of(index));
            return Err(SceneError::two_viscosities(self.clock.time, bodies, viscosities));
        }
        if let Some(overlap) = self.contacts.gaps.crossed.or_else(|| self.contacts.surfaces.first_overlap(&view)) {
            let Overlap { body, other, place: Vec2 { x, y }, depth, allowed } = overlap;
            let [body, other] = [body, other].map(|index| self.bodies.name_of(index));
            return Err(SceneError::Overlap { time: self.clock.time, body, x, y, other, depth, allowed });
        }
        self.check_wall_nodes()?;
        self.record_gap();
        self.known = Known::Apart;
        Ok(())
    }

    /// Looks at the gaps that a step has led to. Interfaces must not have come to be inside other bodies or their own
    /// images by more than [`Surfaces::allowed`], and no gap be narrower than the bound, if there is one.
    pub(crate) fn check_gaps(&mut self) -> Result<(), SceneError> {
        self.find_gaps();
        let time = self.clock.time;
        self.bodies.check_containment(time)?;
        let names = |bodies: [usize; 2]| bodies.map(|index| self.bodies.name_of(index));
        if let Some(overlap) = self.contacts.gaps.crossed {
            let Overlap { body, other, place: Vec2 { x, y }, depth, allowed } = overlap;
            let [body, other] = names([body, other]);
            return Err(SceneError::Crossing { time, body, x, y, other, depth, allowed });
        }
        self.check_wall_nodes()?;
        if let Some(bound) = self.contacts.least_gap {
            let wall = self.nearest_wall();
            let names = |bodies: [usize; 2]| bodies.map(|index| self.bodies.name_of(index));
            let between = self.contacts.gaps.narrowest.map(|Gap { body, other, width, place }| {
                let [body, other] = names([body, other]);
                (width, body, other, place)
            });
            let wall = wall.map(|(gap, body, place)| (gap, self.bodies.name_of(body), "a wall".to_owned(), place));
            let narrow = between.into_iter().chain(wall).find(|(gap, ..)| *gap < bound);
            if let Some((gap, body, other, Vec2 { x, y })) = narrow {
                return Err(SceneError::Gap { time, body, x, y, other, gap, bound });
            }
        }
        self.known = Known::Apart;
        Ok(())
    }

    /// Finds the interfaces around the bodies, and the narrowest gap.
    pub(super) fn find_gaps(&mut self) {
        self.lay_out();
        self.contacts.find_gaps(&mut self.bodies, &self.hydrodynamics.fluid_view());
    }

    /// Records the gap that was found last, and if steps do not look so far, the narrowest one between two bodies if it
    /// is below all before.
    pub(super) fn record_gap(&mut self) {
        let found = self.contacts.gaps.narrowest.map(|gap| gap.width);
        let (domain, least) = (self.hydrodynamics.fluid_view().domain, self.findings.gap.unwrap_or(f64::INFINITY));
        let found = found.or_else(|| self.contacts.surfaces.narrower(&domain, least));
        lower(&mut self.findings.gap, found);
    }

    /// Returns the warning of solids that are closer than the bound on gaps, which is not theirs.
    fn solids_below_bound(&self) -> Option<Warning> {
        let bound = self.contacts.least_gap?;
        let domain = self.hydrodynamics.fluid_view().domain;
        let (gap, [other, body]) = self.contacts.surfaces.between_solids(&domain, bound)?;
        let [gap_text, bound_text] = told_apart([gap, bound]);
        let message = format!(
            "the gap from {} is {gap_text} (length), below the bound on gaps of {bound_text}: the bound is for gaps \
             beside interfaces, and does not end a run in which two solids come closer, because solids may touch",
            self.bodies.name_of(other)
        );
        let excess = (bound / gap.max(1e-3 * bound)).min(1e3);
        Some(Warning { body: self.bodies.name_of(body), cause: "gap between solids".into(), excess, message })
    }

    /// Records the present gap to walls.
    pub(super) fn record_wall_gap(&mut self) {
        let gap = self.wall_gap();
        lower(&mut self.findings.wall_gap, gap);
    }
}

/// Returns the advice that resolves films so many times thinner.
fn finer(view: &FluidView, times: f64) -> String {
    let nodes = view.nodes.map(|nodes| (times * nodes as f64).ceil());
    match (on_grid(view), nodes) {
        (Some(_), _) => "a finer grid or boundary integrals".to_owned(),
        (None, Some(nodes)) if (1.0..=MOST_NODES).contains(&nodes) => {
            format!("{nodes} nodes for a film as thin as this")
        }
        _ => "more nodes".to_owned(),
    }
}

/// Returns the grid spacing (length) where films are on the grid: if interfaces have separate modes, films are not on
/// it.
fn on_grid(view: &FluidView) -> Option<f64> {
    view.spacing.filter(|_| view.shape_modes.is_none())
}

#[cfg(test)]
mod tests;
