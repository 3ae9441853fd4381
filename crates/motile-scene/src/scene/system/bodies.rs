//! The bodies of a system, their markers, and the fluids that they lie in.

use motile_base::boxes::Periods;

use super::parts::{Parts, markers, states};
use crate::{Body, BodyError, FluidView, Handle, Markers, SceneError, body::StepInfo, gap::Surfaces, scene::SceneId};

/// The bodies of a scene with what they have on the fluid and around them: markers, interior_bodies, enclosing
/// interfaces.
#[derive(Debug)]
pub(in crate::scene) struct Bodies {
    pub(super) scene: SceneId,
    pub(super) list: Vec<Box<dyn Body>>,
    /// Numbers of a host and of the body that fills it, the later one of the two.
    pub(super) interior_bodies: Vec<[usize; 2]>,
    /// A body fills one that is not in this scene.
    pub(super) stray_interior_body: bool,
    pub(super) markers: Markers,
    /// Innermost interface around each body.
    pub(super) enclosing: Vec<Option<usize>>,
    /// Innermost interface around each body when it was last looked for before.
    enclosing_before: Vec<Option<usize>>,
    /// Viscosity around each body (stress times time) where that is not the exterior fluid's.
    pub(super) viscosity_around: Vec<Option<f64>>,
    /// Some body depends on time.
    pub(super) timed: bool,
}

impl Bodies {
    pub(super) fn new() -> Self {
        Self {
            scene: SceneId::unique(),
            list: Vec::new(),
            interior_bodies: Vec::new(),
            stray_interior_body: false,
            markers: Markers::new(),
            enclosing: Vec::new(),
            enclosing_before: Vec::new(),
            viscosity_around: Vec::new(),
            timed: false,
        }
    }

    /// Tells the bodies that depend on time the time of the present state (time).
    pub(super) fn set_time(&mut self, time: f64) {
        if self.timed {
            self.list.iter_mut().filter(|body| body.depends_on_time()).for_each(|body| body.set_time(time));
        }
    }

    /// Looks again which bodies depend on time, and gives them the time (time).
    pub(super) fn find_timed(&mut self, time: f64) {
        self.timed = self.list.iter().any(|body| body.depends_on_time());
        self.set_time(time);
    }

    pub(super) fn push<B: Body>(&mut self, mut body: B) -> Handle<B> {
        self.push_interior_body(&mut body);
        self.markers.push_body(body.marker_count(), body.kind(), body.surfaces());
        self.list.push(Box::new(body));
        self.enclosing.push(None);
        self.viscosity_around.push(None);
        Handle::new(self.scene, self.list.len() - 1)
    }

    /// Returns the number of a body, if it is one of this scene.
    pub(super) fn index_of(&self, handle: Handle<dyn Body>) -> Result<usize, SceneError> {
        if handle.scene() == self.scene { Ok(handle.index()) } else { Err(SceneError::foreign_handle()) }
    }

    /// Returns the name of a body, with its number where another one has the same.
    pub(in crate::scene) fn name_of(&self, index: usize) -> String {
        let name = self.list[index].name();
        let shared = self.list.iter().filter(|body| body.name() == name).count() > 1;
        if shared { format!("{name} (body {index})") } else { name.to_owned() }
    }

    /// Returns some body is a closed curve.
    pub(super) fn have_curves(&self) -> bool {
        self.list.iter().any(|body| body.kind().is_curve())
    }

    /// Returns the error of the body that failed, if one did.
    pub(super) fn done(&self, time: f64, failed: Option<(usize, BodyError)>) -> Result<(), SceneError> {
        let failed = failed.map(|(index, source)| failure(time, self.list[index].as_ref(), source));
        failed.map_or(Ok(()), Err)
    }

    /// Gives the bodies a state, in which each has so many entries.
    pub(super) fn read_state(
        &mut self,
        time: f64,
        state: &[f64],
        len: &(impl Fn(usize, &dyn Body) -> usize + Sync),
    ) -> Result<(), SceneError> {
        let none: &mut [f64] = &mut [];
        let parts = Parts::of(&mut self.list, state.len(), none);
        let failed = parts.each(len, &|_, body, range, _| body.read_state(state.get(range).unwrap_or_default()));
        self.done(time, failed)
    }

    /// Calls `act` with the number of each body, the body, and the viscosity around it, until it fails.
    pub(super) fn try_each(
        &mut self,
        time: f64,
        mut act: impl FnMut(usize, &mut dyn Body, Option<f64>) -> Result<(), BodyError>,
    ) -> Result<(), SceneError> {
        self.list.iter_mut().zip(&self.viscosity_around).enumerate().try_for_each(|(index, (body, &outside))| {
            act(index, body.as_mut(), outside).map_err(|source| failure(time, body.as_ref(), source))
        })
    }

    /// Makes the groups of markers fit the bodies, whose numbers of markers may have changed at the end of a step;
    /// `same` if the bodies themselves belong to the groups.
    fn fit_markers(&mut self, same: bool) {
        let groups = self.markers.groups();
        let fits = same
            && groups.len() == self.list.len()
            && groups.iter().zip(&self.list).all(|(g, b)| g.range.len() == b.marker_count() && g.kind == b.kind());
        if !fits {
            self.markers.clear();
            for body in &self.list {
                self.markers.push_body(body.marker_count(), body.kind(), body.surfaces());
            }
            self.tell_surroundings();
        }
    }

    /// Puts the markers where the bodies have them; `same` as in [`Bodies::fit_markers`].
    pub(super) fn place_markers(&mut self, same: bool) {
        self.fit_markers(same);
        self.update_hosts();
        let positions = &mut self.markers.positions;
        Parts::of(&mut self.list, positions.len(), positions).each(&markers, &|_, body, _, positions| {
            body.write_markers(positions);
            Ok(())
        });
    }

    /// Writes the forces of all bodies, including the forces of interior bodies on their hosts.
    pub(super) fn write_forces(&mut self, view: &FluidView, time: f64) -> Result<(), SceneError> {
        let Self { list, markers: Markers { forces, .. }, viscosity_around, .. } = self;
        let failed = Parts::of(list, forces.len(), forces).each(&markers, &|index, body, _, forces| {
            body.write_forces(&view.in_fluid(viscosity_around[index]), forces)
        });
        self.done(time, failed)?;
        self.add_interior_forces();
        Ok(())
    }

    /// Writes the explicit rates of all bodies from the velocities at their markers.
    pub(super) fn write_rates(&mut self, rate: &mut [f64]) {
        let Self { list, markers: Markers { groups, velocities, .. }, interior_bodies, .. } = self;
        if interior_bodies.is_empty() {
            Parts::of(list, rate.len(), rate).each(&states, &|index, body, _, rate| {
                body.rate(&velocities[groups[index].range.clone()], rate);
                Ok(())
            });
            return;
        }
        let mut rest = &mut *rate;
        for index in 0..self.list.len() {
            self.host_moved(index);
            let (body, range) = (&mut self.list[index], self.markers.groups()[index].range.clone());
            let rate = part(&mut rest, body.as_ref());
            body.rate(&self.markers.velocities[range], rate);
        }
        self.add_interior_rates(rate);
    }

    /// Finds the interfaces that the bodies lie in, and the viscosities there.
    pub(super) fn find_surroundings(&mut self, surfaces: &Surfaces, periods: Periods) {
        std::mem::swap(&mut self.enclosing, &mut self.enclosing_before);
        surfaces.surroundings(periods, &mut self.enclosing);
        for &[host, interior_body] in &self.interior_bodies {
            self.enclosing[interior_body] = Some(host);
        }
        for index in 0..self.list.len() {
            let enclosing = std::iter::successors(self.enclosing[index], |&outer| self.enclosing[outer]);
            self.viscosity_around[index] =
                enclosing.take(self.list.len()).find_map(|outer| self.list[outer].kind().viscosity_inside());
        }
        self.tell_surroundings();
    }

    /// Reports to the markers what they lie in.
    fn tell_surroundings(&mut self) {
        let Self { interior_bodies, enclosing, viscosity_around, markers, .. } = self;
        let is_guest = |body: usize| interior_bodies.iter().any(|&[_, interior_body]| interior_body == body);
        // A interior_body has its host for itself if no other body lies inside.
        let alone =
            |host: usize| enclosing.iter().enumerate().all(|(body, outer)| *outer != Some(host) || is_guest(body));
        let host_of = |body: usize| {
            interior_bodies
                .iter()
                .find(|&&[host, interior_body]| interior_body == body && alone(host))
                .map(|&[host, _]| host)
        };
        markers.set_surroundings(viscosity_around.iter().enumerate().map(|(body, outside)| (*outside, host_of(body))));
    }

    /// Refuses that a body has come into an interface or out of it since it was last looked for.
    pub(super) fn check_containment(&self, time: f64) -> Result<(), SceneError> {
        let mut pairs = self.enclosing_before.iter().zip(&self.enclosing);
        let Some(body) = pairs.position(|(before, now)| before != now) else { return Ok(()) };
        let place = |around: Option<usize>| match around {
            Some(outer) => format!("inside {}", self.name_of(outer)),
            None => "in the exterior fluid".to_owned(),
        };
        let [before, now] = [&self.enclosing_before, &self.enclosing].map(|list| place(list[body]));
        Err(SceneError::Containment { time, body: self.name_of(body), before, now })
    }

    /// Begins a step.
    pub(super) fn begin_step(&mut self, view: &FluidView, time: f64, step: StepInfo) -> Result<(), SceneError> {
        let Self { list, markers, viscosity_around, .. } = self;
        let none: &mut [f64] = &mut [];
        let failed = Parts::of(list, markers.len(), none)
            .each(&|_, _| 0, &|index, body, _, _| body.begin_step(&view.in_fluid(viscosity_around[index]), step));
        self.done(time, failed)
    }

    /// Ends a step of `dt` (time).
    pub(super) fn end_step(&mut self, view: &FluidView, time: f64, dt: f64) -> Result<(), SceneError> {
        self.update_hosts();
        let Self { list, markers, viscosity_around, interior_bodies, .. } = self;
        if interior_bodies.is_empty() {
            let none: &mut [f64] = &mut [];
            let failed = Parts::of(list, markers.len(), none)
                .each(&|_, _| 0, &|index, body, _, _| body.end_step(&view.in_fluid(viscosity_around[index]), dt));
            return self.done(time, failed);
        }
        for index in 0..self.list.len() {
            self.update_host(index);
            let (body, outside) = (&mut self.list[index], self.viscosity_around[index]);
            body.end_step(&view.in_fluid(outside), dt).map_err(|source| failure(time, body.as_ref(), source))?;
        }
        Ok(())
    }
}

pub(super) fn failure(time: f64, body: &dyn Body, source: BodyError) -> SceneError {
    SceneError::Body { time, body: body.name().to_owned(), source }
}

/// Returns the part of a flat list that is the next body's, taken off the rest.
pub(super) fn part<'a>(rest: &mut &'a mut [f64], body: &dyn Body) -> &'a mut [f64] {
    rest.split_off_mut(..body.state_len()).unwrap_or_default()
}
