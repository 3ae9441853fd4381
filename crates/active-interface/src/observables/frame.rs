//! Centroid and velocity of a droplet, and the axes along its motion.

use motile_base::{Vec2, finite, internal::all_points_finite, same_length};

use crate::curve::polygon::AreaMoments;
use crate::{InterfaceError, curve::polygon_moments};

/// Axes with their origin at a droplet's centroid and their first axis along its motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    centre: Vec2,
    direction: Vec2,
}

impl Frame {
    /// Creates a frame with this origin (length) and the first axis at the angle `heading` to x (radians).
    ///
    /// # Errors
    /// Returns an error for values that are not finite.
    pub fn new(centre: Vec2, heading: f64) -> Result<Self, InterfaceError> {
        all_points_finite("the origin of the frame", &[centre])?;
        let (sin, cos) = finite("the heading", heading)?.sin_cos();
        Ok(Self { centre, direction: Vec2::new(cos, sin) })
    }

    /// Creates a frame of a droplet with the centroid `centre` (length) that moves with `velocity` (length per time). A
    /// droplet that moves no faster than `rest` (length per time; see [`InterfaceState::rest_speed`]) has no direction,
    /// so its axes are x and y.
    ///
    /// # Errors
    /// Returns an error if a value is not finite.
    ///
    /// [`InterfaceState::rest_speed`]: super::InterfaceState::rest_speed
    pub fn of_motion(centre: Vec2, velocity: Vec2, rest: f64) -> Result<Self, InterfaceError> {
        all_points_finite("the origin of the frame", &[centre])?;
        all_points_finite("the velocity of the frame", &[velocity])?;
        let moves = velocity.length() > finite("the speed of a droplet at rest", rest)?;
        Ok(Self::along(centre, moves.then_some(velocity)))
    }

    /// Creates a frame about `centre` (length) along a motion, or along x and y without one.
    pub(super) fn along(centre: Vec2, motion: Option<Vec2>) -> Self {
        Self { centre, direction: motion.and_then(Vec2::try_normalize).unwrap_or(Vec2::X) }
    }

    /// Returns the origin (length).
    #[must_use]
    pub fn centre(&self) -> Vec2 {
        self.centre
    }

    /// Returns the first axis (no dimension, of length 1).
    #[must_use]
    pub fn direction(&self) -> Vec2 {
        self.direction
    }

    /// Returns the angle of the first axis to x (radians, from -pi to pi).
    #[must_use]
    pub fn heading(&self) -> f64 {
        self.direction.y.atan2(self.direction.x)
    }

    /// Returns the components of the vector `v` along the axes.
    #[must_use]
    pub fn components(&self, v: Vec2) -> Vec2 {
        Vec2::new(self.direction.dot(v), self.direction.perp_dot(v))
    }

    /// Returns the coordinates of the point `p` in the frame (length).
    #[must_use]
    pub fn coordinates(&self, p: Vec2) -> Vec2 {
        self.components(p - self.centre)
    }
}

/// Half the chord between the neighbours of each marker, (X_{k+1} - X_{k-1}) / 2. Its length is the weight of the
/// marker in sums along the curve; turned by -90 degrees it is the outward normal times that weight, with which the
/// rate of change of the polygon's area is exactly the sum of V . n ds.
pub(crate) fn half_chords(markers: &[Vec2]) -> impl Iterator<Item = Vec2> + '_ {
    let m = markers.len();
    (0..m)
        .map(move |k| (markers[if k + 1 == m { 0 } else { k + 1 }] - markers[if k == 0 { m - 1 } else { k - 1 }]) * 0.5)
}

/// Returns the outward normal of each marker times its weight (length).
pub(crate) fn weighted_normals(markers: &[Vec2]) -> impl Iterator<Item = Vec2> + '_ {
    half_chords(markers).map(|d| Vec2::new(d.y, -d.x))
}

/// Returns the velocity of the centroid of the area inside the markers, from the flux of area through the interface,
/// ```text
/// V = (1/A) sum over k of (X_k - X_c) (v_k . n_k ds_k)
/// ```
/// with `velocities` v_k the velocities of the fluid, or of the markers, at the markers (length per time): velocities
/// along the interface do not count. Exact for a uniform velocity, second order in the marker spacing otherwise.
///
/// # Errors
/// Returns an error for slices of different length, fewer than three markers, values that are not finite, no area.
pub fn centroid_velocity(markers: &[Vec2], velocities: &[Vec2]) -> Result<Vec2, InterfaceError> {
    same_length("velocities", markers.len(), velocities.len())?;
    let moments = polygon_moments(markers)?;
    all_points_finite("the velocities", velocities)?;
    Ok(raw_centroid_velocity(markers, velocities, &moments))
}

pub(crate) fn raw_centroid_velocity(markers: &[Vec2], velocities: &[Vec2], moments: &AreaMoments) -> Vec2 {
    let flux: Vec2 = weighted_normals(markers)
        .zip(markers.iter().zip(velocities))
        .map(|(normal, (marker, velocity))| (marker - moments.centroid) * velocity.dot(normal))
        .sum();
    flux / moments.area
}

/// Returns the aspect ratio a/b from the second moments of area, sqrt(I_xx / I_yy), a along the first axis of the frame
/// and b across it (no dimension). It is the ratio of the ellipse with the same moments. Exact for the polygon through
/// the markers.
///
/// # Errors
/// Returns an error for moments that no simple polygon has.
pub(crate) fn aspect_ratio_of(moments: &AreaMoments, frame: &Frame) -> Result<f64, InterfaceError> {
    let (c, s) = (frame.direction.x, frame.direction.y);
    let along = c * c * moments.xx + 2.0 * s * c * moments.xy + s * s * moments.yy;
    let across = s * s * moments.xx - 2.0 * s * c * moments.xy + c * c * moments.yy;
    let square = along / across;
    if square > 0.0 && square.is_finite() { Ok(square.sqrt()) } else { Err(InterfaceError::crossed()) }
}

#[cfg(test)]
mod tests;
