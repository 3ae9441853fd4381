//! The solid as a body of a scene.

use std::f64::consts::PI;

use motile_base::{Vec2, same_length};
use motile_scene::{
    Body, BodyError, FluidView, MarkerKind, StepCause, StepInfo, StepLimit, Viscous,
    checkpoint::SavedState,
    gap::{SurfaceCurve, SurfacePoint},
    points,
};

use crate::{Solid, SolidError, active_springs::Bonds, relaxation::Relaxation, surface_elasticity::SurfaceElasticity};

impl From<SolidError> for BodyError {
    fn from(error: SolidError) -> Self {
        Self::Other(Box::new(error))
    }
}

/// Fraction of the bulk modulus that adds to the stiffness of a mesh as coarse as the grid; it grows with the square of
/// the mesh spacing. The velocity of the fluid has no divergence, so that the bulk modulus only acts through the error
/// of the linear interpolation in each triangle. Measured with the cubic and quadratic kernel, kappa = 20 mu: 0.003,
/// 0.012, 0.02 and 0.05 at mesh spacings of 0.5, 1, 1.5 and 2 grid spacings, of which this is a fit from above.
const BULK_SHARE: f64 = 0.015;

impl Body for Solid {
    fn name(&self) -> &str {
        &self.name
    }

    fn kind(&self) -> MarkerKind {
        MarkerKind::Points
    }

    fn marker_count(&self) -> usize {
        self.spreading.as_ref().map_or(self.free.len(), |spreading| spreading.marker_count())
    }

    fn write_markers(&self, positions: &mut [Vec2]) {
        if let Some(spreading) = &self.spreading {
            return spreading.write_markers(&self.mesh, &self.positions, positions);
        }
        for (marker, &point) in positions.iter_mut().zip(&self.free) {
            *marker = self.positions[point];
        }
    }

    fn write_forces(&mut self, _view: &FluidView, forces: &mut [Vec2]) -> Result<(), BodyError> {
        self.compute_forces()?;
        if let Some(damping) = &mut self.damping {
            damping.update(&self.positions);
        }
        if let Some(spreading) = &mut self.spreading {
            forces.fill(Vec2::ZERO);
            spreading.add_forces(&self.forces, forces);
            return Ok(());
        }
        for (force, &point) in forces.iter_mut().zip(&self.free) {
            *force = self.forces[point];
        }
        Ok(())
    }

    /// Returns the free points, internal variables of Maxwell elements, and active springs, 1 if one is on and 0
    /// otherwise.
    fn state_len(&self) -> usize {
        2 * self.free.len() + self.internal_len() + self.bonds.as_ref().map_or(0, |bonds| bonds.on().len())
    }

    fn write_state(&self, state: &mut [f64]) {
        let (state, inner) = state.split_at_mut(2 * self.free.len());
        self.write_internal(inner);
        for (pair, &point) in state.chunks_exact_mut(2).zip(&self.free) {
            pair.copy_from_slice(&self.positions[point].to_array());
        }
    }

    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError> {
        if let Some(index) = state.iter().position(|value| !value.is_finite()) {
            let what = if index < 2 * self.free.len() { "point coordinate" } else { "internal variable" };
            return Err(BodyError::NonFinite { what, index, value: state[index] });
        }
        let (state, inner) = state.split_at(2 * self.free.len());
        self.read_internal(inner);
        for (pair, &point) in state.chunks_exact(2).zip(&self.free) {
            self.positions[point] = Vec2::new(pair[0], pair[1]);
        }
        Ok(())
    }

    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]) {
        let (rate, inner) = rate.split_at_mut(2 * self.free.len());
        inner.fill(0.0);
        if let Some(spreading) = &mut self.spreading {
            let velocities = spreading.velocities(velocities);
            for (pair, &point) in rate.chunks_exact_mut(2).zip(&self.free) {
                pair.copy_from_slice(&velocities[point].to_array());
            }
            return;
        }
        for (pair, velocity) in rate.chunks_exact_mut(2).zip(velocities) {
            pair.copy_from_slice(&velocity.to_array());
        }
    }

    fn begin_step(&mut self, _view: &FluidView, step: StepInfo) -> Result<(), BodyError> {
        if let Some(relaxation) = &mut self.relaxation {
            relaxation.begin_step(&self.positions, step.dt);
        }
        Ok(())
    }

    fn add_implicit(&mut self, state: &[f64], factor: f64, out: &mut [f64]) {
        if let Some(relaxation) = &mut self.relaxation {
            relaxation.add_rate((&self.positions, &self.free), state, factor, out);
        }
    }

    fn solve_implicit(&mut self, factor: f64, state: &mut [f64]) {
        if let Some(relaxation) = &mut self.relaxation {
            relaxation.solve_rate((&self.positions, &self.free), factor, state);
        }
    }

    /// Puts the exact solution in place of what an integrator makes of the internal variables.
    fn end_step(&mut self, _view: &FluidView, dt: f64) -> Result<(), BodyError> {
        if !self.may_invert {
            self.check_inversion()?;
            self.surface.check(&self.positions)?;
        }
        if let Some(relaxation) = &mut self.relaxation {
            relaxation.end_step(&self.positions, dt);
        }
        if let Some(bonds) = &mut self.bonds {
            bonds.end_step(&self.positions, dt);
        }
        Ok(())
    }

    fn keep_step(&mut self) {
        if let Some(bonds) = &mut self.bonds {
            bonds.keep_step();
        }
    }

    fn as_viscous(&mut self) -> Option<&mut dyn Viscous> {
        if self.damping.is_some() { Some(self) } else { None }
    }

    /// Not of solids with internal variables.
    fn mirror(&self, markers: &[usize], state: &[f64], image: &mut [f64]) -> bool {
        // Images of markers are not those of points then.
        if self.spreading.is_some() {
            return false;
        }
        points::mirror(markers, state, image);
        self.relaxation.is_none() && self.bonds.is_none()
    }

    /// Only of a solid that nothing holds.
    fn translate(&self, by: Vec2, state: &mut [f64]) -> bool {
        points::translate(by, &mut state[..2 * self.free.len()]);
        self.free.len() == self.positions.len() && self.tethers.is_empty()
    }

    /// Its whole surface; pinned points are fixed.
    fn surfaces(&self) -> Vec<SurfaceCurve> {
        let places = self.mesh.points();
        let markers = self.spreading.as_ref().map_or(&self.free, |spreading| &spreading.surface);
        let curves = self.mesh.boundary_loops().iter().map(|outline| {
            // Reference places decide, so that the deformation cannot change the image.
            let (mut shift, mut last) = (0, places[outline.points[0]].x);
            let points = outline.points.iter().map(|point| {
                let x = places[*point].x;
                shift -= self.mesh.period().map_or(0, |period| ((x - last) / period).round() as i32);
                last = x;
                let fixed = |_| SurfacePoint::Fixed(self.positions[*point]);
                (markers.binary_search(point).map_or_else(fixed, SurfacePoint::Marker), shift)
            });
            SurfaceCurve { points: points.collect(), periods: outline.periods }
        });
        curves.collect()
    }

    /// For positions the radius of a disc of the same area, or the mean thickness of a periodic solid; for springs of
    /// Maxwell elements their lengths.
    fn write_scales(&self, scales: &mut [f64]) {
        let (places, inner) = scales.split_at_mut(2 * self.free.len());
        let area = self.mesh.area();
        places.fill(self.mesh.period().map_or_else(|| (area / PI).sqrt(), |period| area / period));
        inner.fill(1.0);
        if let Some(relaxation) = &self.relaxation {
            relaxation.write_scales(inner);
        }
    }

    /// Returns the size of the mesh at rest, and its energy under a given shear and stretch.
    fn properties(&self) -> Vec<(String, f64)> {
        let mesh = &self.mesh;
        // Both ways, so that a mirror image has the same.
        let strained = [-0.1, 0.1]
            .map(|shear| mesh.points().iter().map(|s| Vec2::new(s.x + shear * s.y, 1.05 * s.y)).collect::<Vec<Vec2>>());
        let mean = |energy: &dyn Fn(&[Vec2]) -> f64| 0.5 * strained.iter().map(|state| energy(state)).sum::<f64>();
        let triangles = mesh.areas().iter().enumerate();
        let properties = [
            ("the number of points", self.positions.len() as f64),
            ("the number of triangles", mesh.triangles().len() as f64),
            ("the area at rest", mesh.area()),
            ("the polar moment of area at rest", triangles.map(|(k, a)| a * mesh.centroid(k).length_squared()).sum()),
            ("the number of free points", self.free.len() as f64),
            ("the number of tethers", self.tethers.len() as f64),
            (
                "the mean energy of shears of 0.1 and -0.1 with a stretch of 1.05",
                mean(&|state| self.law.energy(state).unwrap_or(f64::NAN)),
            ),
        ];
        let surface = self.surface_elasticity.iter().flat_map(|surface| {
            let [stretching, bending] = surface.moduli();
            [("the stretching modulus of its surface", stretching), ("the bending modulus of its surface", bending)]
        });
        let relaxing = self.relaxation.iter().flat_map(|relaxation| {
            let [modulus, viscosity] = relaxation.sums();
            [("the integral of the moduli of its Maxwell elements", modulus), ("that of their viscosities", viscosity)]
        });
        let active = self.bonds.iter().flat_map(Bonds::properties);
        let damping = self.damping.iter().map(|damping| ("its viscosity above that of the fluid", damping.viscosity()));
        let weight = self.body_force.iter().flat_map(|force| {
            let [x, y] = force.density().to_array();
            [("the body force along x", x), ("the body force along y", y)]
        });
        let properties =
            properties.into_iter().chain(surface).chain(relaxing).chain(active).chain(damping).chain(weight);
        let spread =
            self.spreading.as_ref().map(|spreading| ("the number of markers", spreading.marker_count() as f64));
        properties.chain(spread).map(|(name, value)| (name.to_owned(), value)).collect()
    }

    /// Returns the positions of all points, pinned ones too, the tethers, internal variables, and steps of the active
    /// springs.
    fn save(&self) -> SavedState {
        let mut reals: Vec<f64> = self.positions.iter().flat_map(|place| [place.x, place.y]).collect();
        reals.extend(self.tethers.iter().flat_map(|tether| [tether.anchor.x, tether.anchor.y, tether.stiffness]));
        let first = reals.len();
        reals.resize(first + self.state_len() - 2 * self.free.len(), 0.0);
        self.write_internal(&mut reals[first..]);
        reals.extend_from_slice(Viscous::stresses(self));
        let mut counts = vec![self.positions.len() as u64, self.tethers.len() as u64];
        counts.extend(self.bonds.iter().map(Bonds::steps));
        SavedState { reals, counts }
    }

    fn load(&mut self, _view: &FluidView, saved: &SavedState) -> Result<(), BodyError> {
        let points = if let Some(bonds) = &mut self.bonds {
            let [points, _, steps] = saved.counts_of()?;
            bonds.set_steps(steps);
            points
        } else {
            let [points, _] = saved.counts_of()?;
            points
        };
        same_length("a saved solid", self.positions.len(), points as usize)?;
        let split = 2 * self.positions.len();
        let inner = self.state_len() - 2 * self.free.len();
        let all = split + 3 * self.tethers.len() + inner + self.stress_count();
        let (positions, numbers) = saved.reals_of(all)?.split_at(split);
        let (numbers, rest) = numbers.split_at(3 * self.tethers.len());
        let (inner, stresses) = rest.split_at(inner);
        self.read_internal(inner);
        self.set_stresses(stresses);
        for (place, pair) in self.positions.iter_mut().zip(positions.chunks_exact(2)) {
            *place = Vec2::new(pair[0], pair[1]);
        }
        for (tether, numbers) in self.tethers.iter_mut().zip(numbers.chunks_exact(3)) {
            tether.anchor = Vec2::new(numbers[0], numbers[1]);
            tether.stiffness = numbers[2];
        }
        Ok(())
    }

    /// Stable step `2 eta/(mu + 0.015 kappa (a/h)^2)` of the midpoint rule, a the spacing of the mesh and h the spacing
    /// of the grid, mu and kappa the largest moduli in the solid. Surface elasticity adds the stiffness of its shortest
    /// waves to the sum, Maxwell elements their moduli, active springs the stiffness of their tension, tethers their
    /// stiffness when all of them move together.
    fn step_limits(&self, view: &FluidView, limits: &mut dyn FnMut(StepLimit)) {
        let moduli = self.law.stiffest();
        // The fluid of a grid resists changes of area that it resolves. Without a grid, nothing says that it does.
        let bulk = view.spacing.map_or(moduli.bulk(), |spacing| {
            let coarseness = self.spacing / spacing;
            BULK_SHARE * moduli.bulk() * coarseness * coarseness
        });
        let surface = self.surface_elasticity.as_ref().map_or(0.0, SurfaceElasticity::stiffness);
        let relaxing = self.relaxation.as_ref().map_or(0.0, Relaxation::stiffest);
        let active = self.bonds.as_ref().map_or(0.0, |bonds| bonds.stiffness(self.spacing));
        let elastic = moduli.shear() + bulk + surface + relaxing + active;
        if let Some(bonds) = &self.bonds {
            let dt = bonds.resolved_step();
            limits(StepLimit { dt, reason: "the rates of the active springs", cause: StepCause::Accuracy });
        }
        let elastic = elastic + self.pinned_stiffness(view);
        let (stiffness, reason) = if self.tethers.is_empty() {
            (elastic, "the elastic moduli")
        } else {
            (elastic + self.tether_stiffness(view), "the elastic moduli and tethers")
        };
        limits(StepLimit::decay(2.0 * view.viscosity / stiffness, reason));
    }
}

/// With the stresses xx, yy and xy of each triangle (force per length).
impl Viscous for Solid {
    fn stress_count(&self) -> usize {
        Viscous::stresses(self).len()
    }

    fn write_rates(&mut self, velocities: &[Vec2], rates: &mut [f64]) {
        let Some(damping) = &mut self.damping else { return };
        if let Some(spreading) = &mut self.spreading {
            let moving = spreading.velocities(velocities).iter().copied().enumerate();
            return damping.write_rates(&self.positions, moving, rates);
        }
        let moving = self.free.iter().copied().zip(velocities.iter().copied());
        damping.write_rates(&self.positions, moving, rates);
    }

    fn add_stress_forces(&mut self, stresses: &[f64], forces: &mut [Vec2]) {
        let Some(damping) = &mut self.damping else { return };
        let on_points = damping.forces(&self.positions, stresses);
        if let Some(spreading) = &mut self.spreading {
            return spreading.add_forces(on_points, forces);
        }
        forces.iter_mut().zip(&self.free).for_each(|(force, &point)| *force += on_points[point]);
    }

    fn write_compliances(&self, compliances: &mut [f64]) {
        if let Some(damping) = &self.damping {
            damping.write_compliances(compliances);
        }
    }

    /// By the compliances alone: the number of iterations then grows with the ratio of viscosities, and not with the
    /// number of triangles.
    fn precondition(&mut self, rates: &mut [f64]) {
        if let Some(damping) = &self.damping {
            damping.divide_by_compliances(rates);
        }
    }

    fn stresses(&self) -> &[f64] {
        self.damping.as_ref().map_or(&[], |damping| &damping.stresses)
    }

    fn set_stresses(&mut self, stresses: &[f64]) {
        if let Some(damping) = &mut self.damping {
            damping.stresses.copy_from_slice(stresses);
        }
    }
}

impl Solid {
    /// Returns the number of internal variables of Maxwell elements.
    fn internal_len(&self) -> usize {
        self.relaxation.as_ref().map_or(0, |relaxation| relaxation.values().len())
    }

    /// Writes the part of the state after the points.
    fn write_internal(&self, inner: &mut [f64]) {
        let (values, bonds) = inner.split_at_mut(self.internal_len());
        if let Some(relaxation) = &self.relaxation {
            values.copy_from_slice(relaxation.values());
        }
        if let Some(own) = &self.bonds {
            bonds.iter_mut().zip(own.on()).for_each(|(state, on)| *state = f64::from(u8::from(*on)));
        }
    }

    /// Takes over the part of the state after the points.
    fn read_internal(&mut self, inner: &[f64]) {
        let (values, bonds) = inner.split_at(self.internal_len());
        if let Some(relaxation) = &mut self.relaxation {
            relaxation.values_mut().copy_from_slice(values);
        }
        if let Some(own) = &mut self.bonds {
            own.set(bonds);
        }
    }

    /// Returns the upper bound of viscosity times the fastest rate at which tethers relax (force per length). It is the
    /// rate if all of them move together.
    ///
    /// A row of total stiffness k per length along a channel of height H relaxes at `k H/(4 eta)`, a layer that fills
    /// it at `k H/(pi^2 eta)`, one of thickness t in the middle at `k (H/4 - 0.148 t)/eta` (to 4 %); without walls a
    /// row in a box of length L at `k L/(12 eta)`. A group shorter than half of H or L moves no more easily than one of
    /// that length.
    fn tether_stiffness(&self, view: &FluidView) -> f64 {
        let group = Group::of(self.tethers.iter().map(|tether| tether.anchor), self.spacing, view);
        let total: f64 = self.tethers.iter().map(|tether| tether.stiffness).sum();
        total / group.length * group.mobility
    }

    /// Returns the upper bound of viscosity times the fastest rate at which the free points move back together to the
    /// pinned points (force per length), beyond the elastic moduli.
    ///
    /// A pinned point exerts no force on the fluid. In mid-stream, the fluid therefore carries all free points past the
    /// pinned points, and the elements between the two act as tethers. Their stiffness is the second derivative of
    /// their energy, `sum of A |grad phi|^2 (mu + kappa)` over the elements that have both, with phi = 1 at free points
    /// and 0 at pinned points. At a height y above a wall, the fluid moves no more easily than `y (H - y)/H`. The part
    /// of a mesh spacing is in the elastic moduli already, so that points pinned to a wall add nothing.
    fn pinned_stiffness(&self, view: &FluidView) -> f64 {
        if self.free.len() == self.positions.len() {
            return 0.0;
        }
        let (mesh, moduli) = (&self.mesh, self.law.stiffest());
        let is_free = |point: usize| self.free.binary_search(&point).is_ok();
        let joints = || {
            mesh.triangles().iter().zip(mesh.areas()).enumerate().filter_map(move |(index, (corners, area))| {
                let free = corners.map(is_free);
                let odd = (0..3).find(|&k| free[k] != free[(k + 1) % 3] && free[k] != free[(k + 2) % 3])?;
                let places = mesh.corners(index, mesh.points())?;
                // The gradient of phi points from the opposite side to the corner that differs from the other two.
                let side = (places[(odd + 2) % 3] - places[(odd + 1) % 3]).length();
                Some((mesh.centroid(index), side * side / (4.0 * area)))
            })
        };
        let group = Group::of(joints().map(|(place, _)| place), self.spacing, view);
        let mobility = |place: Vec2| match view.domain.walls {
            Some([bottom, top]) => {
                let [low, high] = [place.y - bottom, top - place.y].map(|gap| gap.max(0.0));
                (low * high / (low + high)).min(group.mobility)
            }
            None => group.mobility,
        };
        let total: f64 = joints().map(|(place, share)| share * (mobility(place) - self.spacing).max(0.0)).sum();
        (moduli.shear() + moduli.bulk()) * total / group.length
    }
}

/// A group of points that moves together.
struct Group {
    /// Length over which its force spreads (length), no shorter than half of the fluid's reach.
    length: f64,
    /// Velocity times viscosity that a force per length of 1 causes (length).
    mobility: f64,
}

impl Group {
    /// Creates a group of the given points, each of which stands for one mesh spacing. See [`Solid::tether_stiffness`].
    fn of(points: impl Iterator<Item = Vec2>, spacing: f64, view: &FluidView) -> Self {
        let (low, high) =
            points.fold((Vec2::splat(f64::INFINITY), Vec2::splat(f64::NEG_INFINITY)), |(a, b), p| (a.min(p), b.max(p)));
        let size = (high - low).max(Vec2::ZERO) + Vec2::splat(spacing);
        let (length, thickness) = (size.x.max(size.y), size.x.min(size.y));
        let domain = &view.domain;
        let (reach, mobility) = match domain.walls {
            Some([bottom, top]) => (top - bottom, 0.25 * (top - bottom) - 0.148 * thickness.min(top - bottom)),
            None => {
                let extent = domain.periods.iter().flatten().copied().fold(0.0, f64::max);
                // Without an end the flow about a group reaches some ten times as far as the group.
                let reach = if extent > 0.0 { extent } else { 10.0 * length };
                (reach, reach / 12.0)
            }
        };
        Self { length: length.max(0.5 * reach), mobility }
    }
}
