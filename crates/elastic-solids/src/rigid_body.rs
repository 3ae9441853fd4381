//! Rigid bodies that move freely.

use ib_core::{
    Body, BodyError, Discretisation, MarkerKind, Observe, Vec2,
    input::{all_points_finite, at_least, positive},
    scene::BodyFlow,
};

use crate::SolidError;

/// Least number of markers of an outline.
pub(crate) const LEAST_MARKERS: usize = 8;

/// A rigid body of any smooth outline that the fluid carries along, with forces that others put on it: that of a user
/// and that of a repulsion.
///
/// Its state is the centroid of its area and an angle. No scheme for a grid alone knows it; boundary integrals and
/// layers do ([`MarkerKind::Rigid`]), which give its markers the velocities of one rigid motion.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidBody {
    name: String,
    /// Markers about the centroid at an angle of zero (length).
    outline: Vec<Vec2>,
    /// Their mean, and the sum of their squared distances from it.
    mean: Vec2,
    inertia: f64,
    area: f64,
    centre: Vec2,
    angle: f64,
    force: Vec2,
    torque: f64,
}

/// How a rigid body moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidBodyMotion {
    /// The centroid of its area (length).
    pub centre: Vec2,
    /// How far it has turned since the start (radians, counter-clockwise).
    pub angle: f64,
    /// Velocity of the centroid (length per time).
    pub velocity: Vec2,
    /// Angular velocity (radians per time, counter-clockwise).
    pub spin: f64,
}

impl RigidBody {
    /// A body from points of its outline (length), in either direction, at equally spaced values of some parameter.
    ///
    /// # Errors
    /// Fewer than 8 points, points that are not finite, an outline without area.
    pub fn new(points: &[Vec2]) -> Result<Self, SolidError> {
        let (points, area, centre) = closed_outline(points)?;
        let count = points.len() as f64;
        let outline: Vec<Vec2> = points.iter().map(|point| *point - centre).collect();
        let mean = outline.iter().sum::<Vec2>() / count;
        let inertia = outline.iter().map(|arm| (*arm - mean).length_squared()).sum();
        let name = "rigid body".to_owned();
        Ok(Self { name, outline, mean, inertia, area, centre, angle: 0.0, force: Vec2::ZERO, torque: 0.0 })
    }

    /// The same body with a name for messages.
    #[must_use]
    pub fn named(self, name: impl Into<String>) -> Self {
        Self { name: name.into(), ..self }
    }

    /// The same body on which something acts with a force (force) in its centroid and a torque (force times length).
    /// In the plane the forces of a scene should have no resultant, which would move all of the fluid.
    ///
    /// # Errors
    /// Values that are not finite.
    pub fn with_load(self, force: Vec2, torque: f64) -> Result<Self, SolidError> {
        all_points_finite("the load of a rigid body", &[force, Vec2::splat(torque)])?;
        Ok(Self { force, torque, ..self })
    }

    /// The centroid of its area (length).
    #[must_use]
    pub fn centre(&self) -> Vec2 {
        self.centre
    }

    /// How far it has turned since the start (radians, counter-clockwise).
    #[must_use]
    pub fn angle(&self) -> f64 {
        self.angle
    }

    /// Its area (length squared).
    #[must_use]
    pub fn area(&self) -> f64 {
        self.area
    }

    /// Its markers where they are now (length).
    pub fn markers(&self) -> impl Iterator<Item = Vec2> {
        let turn = Vec2::from_angle(self.angle);
        self.outline.iter().map(move |arm| self.centre + turn.rotate(*arm))
    }

    /// Velocity of the centroid and angular velocity of the rigid motion nearest to velocities at the markers.
    fn motion(&self, velocities: &[Vec2]) -> (Vec2, f64) {
        let turn = Vec2::from_angle(self.angle);
        let mean = velocities.iter().sum::<Vec2>() / velocities.len() as f64;
        let arms = self.outline.iter().map(|arm| turn.rotate(*arm - self.mean));
        let spin = arms.zip(velocities).map(|(arm, v)| arm.perp_dot(*v)).sum::<f64>() / self.inertia;
        (mean - spin * turn.rotate(self.mean).perp(), spin)
    }
}

/// Points counter-clockwise, the area that they enclose, and its centroid.
pub(crate) fn closed_outline(points: &[Vec2]) -> Result<(Vec<Vec2>, f64, Vec2), SolidError> {
    at_least("the points of an outline", points.len(), LEAST_MARKERS)?;
    all_points_finite("the points of an outline", points)?;
    let mut points = points.to_vec();
    let first = points[0];
    let pairs = points.iter().zip(points.iter().cycle().skip(1));
    let (area, moment) = pairs.fold((0.0, Vec2::ZERO), |(area, moment), (a, b)| {
        let part = 0.5 * (*a - first).perp_dot(*b - first);
        (area + part, moment + part / 3.0 * (*a + *b - 2.0 * first))
    });
    positive("the area of an outline", area.abs())?;
    if area < 0.0 {
        points.reverse();
    }
    let centre = first + moment / area;
    let area = area.abs();
    Ok((points, area, centre))
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

    /// Forces with the resultant and the torque of the load; how they are spread over the body means nothing.
    fn write_forces(&mut self, _medium: &Discretisation, forces: &mut [Vec2]) -> Result<(), BodyError> {
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

    fn write_scales(&self, scales: &mut [f64]) {
        let size = (self.area / std::f64::consts::PI).sqrt();
        scales.copy_from_slice(&[size, size, 1.0]);
    }

    /// Its shape and what acts on it.
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

    fn observables(&self, _medium: &Discretisation, flow: &BodyFlow<'_>) -> Result<RigidBodyMotion, BodyError> {
        let (velocity, spin) = self.motion(flow.velocities);
        Ok(RigidBodyMotion { centre: self.centre, angle: self.angle, velocity, spin })
    }
}

#[cfg(test)]
mod tests;
