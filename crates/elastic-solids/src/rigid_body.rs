//! Rigid bodies that move freely in the flow, or that are held in it.

mod held;

use motile_base::{
    PeriodicSeries, Vec2, finite,
    internal::{all_points_finite, at_least, told_apart},
    polygon::area_and_arm,
    positive, within,
};
use motile_scene::{
    Body, BodyError, BodyFlow, FluidView, MarkerKind, Observe, Viscous, Warning, checkpoint::SavedState, points,
};

use crate::SolidError;
use held::Held;

/// Fewest markers of an outline: its curvature and its normals come from Fourier series, of three modes at least.
pub(crate) const LEAST_MARKERS: usize = 8;

/// Minimum distance of two sides of a body, in distances of its nodes, at which speeds next to it are right to about 1
/// %. The flow in the body, between the sides, is then resolved (measured for rods and ellipses: 0.9 % at 2.3, 9 % at
/// 1.9, 380 % at 1.6).
const RESOLVED_SIDES: f64 = 2.4;
/// Distance of two points over the way between them along the outline, below which they lie on two sides: somewhat more
/// than for opposite points of a circle.
const OPPOSITE: f64 = 0.65;
/// Largest number of points of an outline whose distances are compared.
const MOST_LOOKED_AT: usize = 1000;

/// A rigid body of any smooth outline that the fluid carries along, under your load and the repulsion of other bodies,
/// or that is held or moved as you prescribe ([`RigidBody::held`]).
///
/// The state is the centroid of its area and an angle. Boundary integrals and layers give its markers the velocities of
/// one rigid motion ([`MarkerKind::Rigid`]); methods with a grid alone support it only if it is held by its markers
/// ([`RigidBody::by_markers`]).
#[derive(Debug, Clone, PartialEq)]
#[doc(alias("no-slip", "particle", "nucleus", "obstacle"))]
pub struct RigidBody {
    name: String,
    /// Markers about the centroid at an angle of zero (length).
    outline: Vec<Vec2>,
    /// Mean of the markers (length), and sum of their squared distances from it (length squared).
    mean: Vec2,
    inertia: f64,
    area: f64,
    /// Minimum distance of two sides over the distance of neighbouring markers there.
    thinnest: f64,
    centre: Vec2,
    angle: f64,
    force: Vec2,
    torque: f64,
    held: Option<Box<Held>>,
}

/// Position, velocity and load of a rigid body.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct RigidBodyMotion {
    /// Centroid of the area (length).
    pub centre: Vec2,
    /// Angle turned since the start (radians, counter-clockwise).
    pub angle: f64,
    /// Velocity of the centroid (length per time).
    pub velocity: Vec2,
    /// Angular velocity (radians per time, counter-clockwise).
    pub spin: f64,
    /// Force of the fluid on the body (force), the drag and the lift of a held one. Without inertia, it is minus the
    /// force that acts on the body otherwise.
    pub force: Vec2,
    /// Torque of the fluid on the body about the centroid (force times length, counter-clockwise).
    pub torque: f64,
}

impl RigidBody {
    /// Creates a rigid body from points of its outline (length), in either direction, at equally spaced values of some
    /// parameter.
    ///
    /// # Errors
    /// Returns an error for fewer than 8 points, points that are not finite, an outline without area.
    pub fn new(points: &[Vec2]) -> Result<Self, SolidError> {
        let (points, area, centre) = closed_outline(points)?;
        let outline: Vec<Vec2> = points.iter().map(|point| *point - centre).collect();
        let (mean, inertia) = moments(&outline);
        let (name, thinnest) = ("rigid body".to_owned(), thinnest(&outline));
        let (angle, force, torque, held) = (0.0, Vec2::ZERO, 0.0, None);
        Ok(Self { name, outline, mean, inertia, area, thinnest, centre, angle, force, torque, held })
    }

    /// Gives the body a name for messages ("rigid body" otherwise).
    #[must_use]
    pub fn named(self, name: impl Into<String>) -> Self {
        Self { name: name.into(), ..self }
    }

    /// Loads the body with a force at its centroid (force) and a torque (force times length). In the plane, the forces
    /// of a scene should have no resultant: otherwise it would set all of the fluid in motion.
    ///
    /// # Errors
    /// Returns an error for values that are not finite.
    pub fn with_load(self, force: Vec2, torque: f64) -> Result<Self, SolidError> {
        all_points_finite("the load of a rigid body", &[force, Vec2::splat(torque)])?;
        Ok(Self { force, torque, ..self })
    }

    /// Holds the body in its place, like a post. The scene finds the force and the torque that this takes:
    /// [`RigidBodyMotion`] has the force and torque of the fluid on the body.
    ///
    /// Use a channel or a box: in the plane nothing takes up the force (Stokes' paradox), and scenes refuse the body.
    #[must_use]
    pub fn held(self) -> Self {
        self.holding(Held::default())
    }

    /// Moves the body with a velocity of its centroid (length per time) and an angular velocity (radians per time,
    /// counter-clockwise), whatever the flow; otherwise as [`RigidBody::held`].
    ///
    /// # Errors
    /// Returns an error for values that are not finite.
    pub fn moving(self, velocity: Vec2, spin: f64) -> Result<Self, SolidError> {
        all_points_finite("the velocity of a rigid body", &[velocity])?;
        finite("the angular velocity of a rigid body", spin)?;
        Ok(self.holding(Held { velocity, spin, ..Held::default() }))
    }

    fn holding(self, mut held: Held) -> Self {
        held.fit(self.outline.len());
        Self { held: Some(Box::new(held)), ..self }
    }

    /// Holds each marker of a body that is held or moved by a separate force, at a distance behind its outline
    /// (length). Use this with methods that have a grid alone, which do not keep the body rigid otherwise; a body that
    /// is not held stays as it is.
    ///
    /// Markers should be one and a half grid spacings apart: what holds closer ones is not determined, and fluid passes
    /// between others. Because the delta function spreads the forces, the fluid comes to rest somewhat outside of the
    /// markers, by `ib_core::rest_distance` in grid spacings. With this inset, the error is of second order.
    ///
    /// # Errors
    /// Returns an error for an inset that is negative, or not below the smallest radius of curvature of the outline.
    pub fn by_markers(mut self, inset: f64) -> Result<Self, SolidError> {
        let markers = self.outline.len();
        let Some(held) = &mut self.held else { return Ok(self) };
        held.by_markers = true;
        held.fit(markers);
        let mut series = PeriodicSeries::new(markers)?;
        series.analyse_vectors(&self.outline)?;
        series.differentiate();
        let tangents: Vec<Vec2> = series.values().iter().map(|t| Vec2::new(t.re, t.im)).collect();
        series.differentiate();
        let curvatures = tangents
            .iter()
            .zip(series.values())
            .map(|(tangent, second)| tangent.perp_dot(Vec2::new(second.re, second.im)) / tangent.length().powi(3));
        let most = curvatures.fold(0.0, f64::max).recip();
        within("the inset of the markers of a rigid body", inset, 0.0, most)?;
        for (place, tangent) in self.outline.iter_mut().zip(&tangents) {
            *place += tangent.perp() * (inset / tangent.length());
        }
        (self.mean, self.inertia) = moments(&self.outline);
        Ok(self)
    }

    fn is_held_by_markers(&self) -> bool {
        self.held.as_ref().is_some_and(|held| held.by_markers)
    }

    /// Returns true if the motion of the body is prescribed: if it is held, or moved ([`RigidBody::moving`]).
    #[must_use]
    pub fn is_held(&self) -> bool {
        self.held.is_some()
    }

    /// Returns the centroid of the area (length).
    #[must_use]
    pub fn centre(&self) -> Vec2 {
        self.centre
    }

    /// Returns the angle turned since the start (radians, counter-clockwise).
    #[must_use]
    pub fn angle(&self) -> f64 {
        self.angle
    }

    /// Returns the area (length squared).
    #[must_use]
    pub fn area(&self) -> f64 {
        self.area
    }

    /// Returns the present positions of the markers (length), counter-clockwise, not wrapped into the periods of the
    /// region.
    pub fn markers(&self) -> impl Iterator<Item = Vec2> {
        let turn = Vec2::from_angle(self.angle);
        self.outline.iter().map(move |arm| self.centre + turn.rotate(*arm))
    }

    /// Returns the velocity of the centroid (length per time) and angular velocity (radians per time) of the rigid
    /// motion nearest, by least squares, to velocities at the markers (length per time).
    fn motion(&self, velocities: &[Vec2]) -> (Vec2, f64) {
        let turn = Vec2::from_angle(self.angle);
        let mean = velocities.iter().sum::<Vec2>() / velocities.len() as f64;
        let arms = self.outline.iter().map(|arm| turn.rotate(*arm - self.mean));
        let spin = arms.zip(velocities).map(|(arm, v)| arm.perp_dot(*v)).sum::<f64>() / self.inertia;
        (mean - spin * turn.rotate(self.mean).perp(), spin)
    }

    /// Adds forces at the markers with this resultant (force) and torque about the centroid (force times length): the
    /// transpose of [`RigidBody::motion`].
    fn add_load(&self, force: Vec2, torque: f64, forces: &mut [Vec2]) {
        let turn = Vec2::from_angle(self.angle);
        let twist = (torque - turn.rotate(self.mean).perp_dot(force)) / self.inertia;
        let share = force / self.outline.len() as f64;
        for (to, arm) in forces.iter_mut().zip(&self.outline) {
            *to += share + twist * turn.rotate(*arm - self.mean).perp();
        }
    }

    /// Returns the square of the radius of a disc of the same area (length squared).
    fn squared_radius(&self) -> f64 {
        self.area / std::f64::consts::PI
    }
}

/// Returns the checked points of an outline, counter-clockwise, with the area (length squared) and the centroid of the
/// polygon.
pub(crate) fn closed_outline(points: &[Vec2]) -> Result<(Vec<Vec2>, f64, Vec2), SolidError> {
    at_least("the points of an outline", points.len(), LEAST_MARKERS)?;
    all_points_finite("the points of an outline", points)?;
    let mut points = points.to_vec();
    let (area, arm) = area_and_arm(&points);
    let centre = points[0] + arm;
    positive("the area of an outline", area.abs())?;
    if area < 0.0 {
        points.reverse();
    }
    Ok((points, area.abs(), centre))
}

/// Returns the mean of points (length), and the sum of their squared distances from it (length squared).
fn moments(points: &[Vec2]) -> (Vec2, f64) {
    let mean = points.iter().sum::<Vec2>() / points.len() as f64;
    (mean, points.iter().map(|arm| (*arm - mean).length_squared()).sum())
}

/// Returns the minimum distance of two sides of an outline over the distance of neighbouring points there.
fn thinnest(outline: &[Vec2]) -> f64 {
    let stride = outline.len().div_ceil(MOST_LOOKED_AT);
    let points: Vec<Vec2> = outline.iter().copied().step_by(stride).collect();
    let next = points.iter().cycle().skip(1);
    let chords: Vec<f64> = points.iter().zip(next).map(|(a, b)| a.distance(*b)).collect();
    let perimeter: f64 = chords.iter().sum();
    let mut least = f64::INFINITY;
    for (i, place) in points.iter().enumerate() {
        let mut way = 0.0;
        for j in i + 1..points.len() {
            way += chords[j - 1];
            let distance = place.distance(points[j]);
            if distance < OPPOSITE * way.min(perimeter - way) {
                least = least.min(distance / chords[i].max(chords[j]));
            }
        }
    }
    least * stride as f64
}

impl Body for RigidBody {
    fn name(&self) -> &str {
        &self.name
    }

    /// Returns the kind of a rigid body, or, if each marker is held by its own force, of a curve in the fluid.
    fn kind(&self) -> MarkerKind {
        if self.is_held_by_markers() {
            MarkerKind::UnevenInterface { viscosity_inside: None }
        } else {
            MarkerKind::Rigid
        }
    }

    fn marker_count(&self) -> usize {
        self.outline.len()
    }

    fn write_markers(&self, positions: &mut [Vec2]) {
        positions.iter_mut().zip(self.markers()).for_each(|(position, marker)| *position = marker);
    }

    /// Forces with the resultant and the torque of the load, which alone act on a rigid body.
    fn write_forces(&mut self, view: &FluidView, forces: &mut [Vec2]) -> Result<(), BodyError> {
        if let Some(held) = &mut self.held {
            held.viscosity = view.viscosity;
        }
        forces.fill(Vec2::ZERO);
        self.add_load(self.force, self.torque, forces);
        Ok(())
    }

    fn state_len(&self) -> usize {
        3
    }

    fn write_state(&self, state: &mut [f64]) {
        state.copy_from_slice(&[self.centre.x, self.centre.y, self.angle]);
    }

    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError> {
        if let Some(index) = state.iter().position(|value| !value.is_finite()) {
            return Err(BodyError::NonFinite { what: "place or angle", index, value: state[index] });
        }
        (self.centre, self.angle) = (Vec2::new(state[0], state[1]), state[2]);
        Ok(())
    }

    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]) {
        // Those that are prescribed are met to the tolerance of an iteration.
        let held = self.held.as_ref().map(|held| (held.velocity, held.spin));
        let (velocity, spin) = held.unwrap_or_else(|| self.motion(velocities));
        rate.copy_from_slice(&[velocity.x, velocity.y, spin]);
    }

    fn mirror(&self, _markers: &[usize], state: &[f64], image: &mut [f64]) -> bool {
        image.copy_from_slice(&[state[0], -state[1], -state[2]]);
        true
    }

    fn translate(&self, by: Vec2, state: &mut [f64]) -> bool {
        points::translate(by, &mut state[..2]);
        true
    }

    fn write_scales(&self, scales: &mut [f64]) {
        let size = self.squared_radius().sqrt();
        scales.copy_from_slice(&[size, size, 1.0]);
    }

    /// Returns the error for a body so thin that its nodes do not resolve the distance of its sides.
    fn warnings(&self, view: &FluidView) -> Vec<Warning> {
        let markers = self.outline.len();
        let nodes = view.nodes.unwrap_or(markers);
        let apart = self.thinnest * nodes as f64 / markers as f64;
        if apart >= RESOLVED_SIDES {
            return Vec::new();
        }
        let [found, least] = told_apart([apart, RESOLVED_SIDES]);
        let needed = (RESOLVED_SIDES * markers as f64 / self.thinnest).ceil();
        let message = format!(
            "two sides of the body are only {found} distances of its nodes apart, below {least}: speeds next to it are \
             off by a few per cent, and by tens of per cent below 1.8; use {needed} nodes instead of {nodes}, or a \
             rounder shape"
        );
        let (body, cause) = (self.name.clone(), "thin body not resolved".into());
        vec![Warning { body, cause, excess: RESOLVED_SIDES / apart, message }]
    }

    fn as_viscous(&mut self) -> Option<&mut dyn Viscous> {
        if self.held.is_some() { Some(self) } else { None }
    }

    fn save(&self) -> SavedState {
        let mut reals = vec![0.0; self.state_len()];
        self.write_state(&mut reals);
        reals.extend_from_slice(self.stresses());
        SavedState { reals, counts: Vec::new() }
    }

    fn load(&mut self, _view: &FluidView, saved: &SavedState) -> Result<(), BodyError> {
        let own = self.state_len();
        // On another grid, the body has other markers, whose forces are to be found again.
        let others = self.is_held_by_markers() && saved.reals.len() >= own;
        let saved = saved.reals_of(if others { saved.reals.len() } else { own + self.stresses().len() })?;
        let (state, stresses) = saved.split_at(own);
        if stresses.len() == self.stresses().len() {
            self.set_stresses(stresses);
        }
        self.read_state(state)
    }

    /// Returns the shape and load, and the motion that is prescribed.
    fn properties(&self) -> Vec<(String, f64)> {
        let held = self.held.iter().flat_map(|held| held.properties());
        // A run may be resumed on another grid, with other markers.
        let of_markers = [
            ("the number of markers", self.outline.len() as f64),
            ("the area", self.area),
            ("the mean square of the distance of markers", self.inertia / self.outline.len() as f64),
        ];
        let of_markers = of_markers.into_iter().filter(|_| !self.is_held_by_markers());
        let properties =
            [("the force along x", self.force.x), ("the force along y", self.force.y), ("the torque", self.torque)];
        of_markers.chain(properties).chain(held).map(|(name, value)| (name.to_owned(), value)).collect()
    }
}

impl Observe for RigidBody {
    type Observables = RigidBodyMotion;

    fn observables(&self, _view: &FluidView, flow: &BodyFlow<'_>) -> Result<RigidBodyMotion, BodyError> {
        let (velocity, spin) = self.motion(flow.velocities);
        let force = -flow.forces.iter().sum::<Vec2>();
        let arms = flow.positions.iter().map(|place| *place - self.centre);
        let torque = -arms.zip(flow.forces).map(|(arm, force)| arm.perp_dot(*force)).sum::<f64>();
        Ok(RigidBodyMotion { centre: self.centre, angle: self.angle, velocity, spin, force, torque })
    }
}

#[cfg(test)]
mod tests;
