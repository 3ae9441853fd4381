//! Rigid bodies that move freely in the flow.

use motile_base::{
    Vec2,
    internal::{all_points_finite, at_least, told_apart},
    polygon::area_and_arm,
    positive,
};
use motile_scene::{Body, BodyError, BodyFlow, FluidView, MarkerKind, Observe, Warning, points};

use crate::SolidError;

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

/// A rigid body of any smooth outline that the fluid carries along, under your load and the repulsion of other bodies.
///
/// The state is the centroid of its area and an angle. Boundary integrals and layers give its markers the velocities of
/// one rigid motion ([`MarkerKind::Rigid`]); methods with a grid alone do not support it.
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
}

/// Position and velocity of a rigid body.
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
}

impl RigidBody {
    /// Creates a rigid body from points of its outline (length), in either direction, at equally spaced values of some
    /// parameter.
    ///
    /// # Errors
    /// Returns an error for fewer than 8 points, points that are not finite, an outline without area.
    pub fn new(points: &[Vec2]) -> Result<Self, SolidError> {
        let (points, area, centre) = closed_outline(points)?;
        let count = points.len() as f64;
        let outline: Vec<Vec2> = points.iter().map(|point| *point - centre).collect();
        let mean = outline.iter().sum::<Vec2>() / count;
        let inertia = outline.iter().map(|arm| (*arm - mean).length_squared()).sum();
        let (name, thinnest) = ("rigid body".to_owned(), thinnest(&outline));
        Ok(Self { name, outline, mean, inertia, area, thinnest, centre, angle: 0.0, force: Vec2::ZERO, torque: 0.0 })
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

    fn kind(&self) -> MarkerKind {
        MarkerKind::Rigid
    }

    fn marker_count(&self) -> usize {
        self.outline.len()
    }

    fn write_markers(&self, positions: &mut [Vec2]) {
        positions.iter_mut().zip(self.markers()).for_each(|(position, marker)| *position = marker);
    }

    /// Forces with the resultant and the torque of the load, which alone act on a rigid body.
    fn write_forces(&mut self, _view: &FluidView, forces: &mut [Vec2]) -> Result<(), BodyError> {
        let turn = Vec2::from_angle(self.angle);
        let twist = (self.torque - turn.rotate(self.mean).perp_dot(self.force)) / self.inertia;
        let share = self.force / self.outline.len() as f64;
        for (force, arm) in forces.iter_mut().zip(&self.outline) {
            *force = share + twist * turn.rotate(*arm - self.mean).perp();
        }
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
        let (velocity, spin) = self.motion(velocities);
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
        let size = (self.area / std::f64::consts::PI).sqrt();
        scales.copy_from_slice(&[size, size, 1.0]);
    }

    /// Returns the error for a body so thin that its nodes do not resolve the distance of its sides.
    fn warnings(&self, view: &FluidView) -> Vec<Warning> {
        let markers = self.outline.len();
        let nodes = view.shape_modes.unwrap_or(markers);
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

    /// Returns the shape and load.
    fn properties(&self) -> Vec<(String, f64)> {
        let properties = [
            ("the number of markers", self.outline.len() as f64),
            ("the area", self.area),
            ("the mean square of the distance of markers", self.inertia / self.outline.len() as f64),
            ("the force along x", self.force.x),
            ("the force along y", self.force.y),
            ("the torque", self.torque),
        ];
        properties.map(|(name, value)| (name.to_owned(), value)).to_vec()
    }
}

impl Observe for RigidBody {
    type Observables = RigidBodyMotion;

    fn observables(&self, _view: &FluidView, flow: &BodyFlow<'_>) -> Result<RigidBodyMotion, BodyError> {
        let (velocity, spin) = self.motion(flow.velocities);
        Ok(RigidBodyMotion { centre: self.centre, angle: self.angle, velocity, spin })
    }
}

#[cfg(test)]
mod tests;
