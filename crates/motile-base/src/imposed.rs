//! Flows that are imposed from outside.

use serde::{Deserialize, Serialize};

use crate::{FlowSample, InputError, Vec2, finite, internal::all_finite, positive};

/// A flow that is imposed from outside: the one that there would be without bodies.
///
/// ```text
/// u = U + A x + B y^2/2 e_x,   p = eta B x
/// ```
///
/// with a velocity U, a velocity gradient A without trace and the curvature B of a parabolic profile along x. Bodies
/// add a disturbance to it, and all velocities belong to the whole flow.
///
/// ```
/// use motile_base::{ImposedFlow, Vec2};
///
/// // A drop off the middle of a Poiseuille flow in a frame that moves at a quarter of its speed.
/// let flow = ImposedFlow::poiseuille(1.0, 5.0)? + ImposedFlow { velocity: [-0.25, 0.0], ..ImposedFlow::NONE };
/// assert_eq!(flow.velocity_at(Vec2::new(3.0, 2.5)), Vec2::new(0.5, 0.0));
/// # Ok::<(), motile_base::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
#[doc(alias("background flow", "shear flow", "Couette", "Poiseuille", "extensional flow"))]
pub struct ImposedFlow {
    /// Velocity U at the origin (length per time).
    pub velocity: [f64; 2],
    /// Velocity gradient A at the origin, `[[du/dx, du/dy], [dv/dx, dv/dy]]` (1/time).
    pub gradient: [[f64; 2]; 2],
    /// Curvature B of the profile, d^2 u/dy^2 (1/(length time)).
    pub bend: f64,
}

impl ImposedFlow {
    /// No flow.
    pub const NONE: Self = Self { velocity: [0.0; 2], gradient: [[0.0; 2]; 2], bend: 0.0 };

    /// Creates the shear flow `u = (G y, 0)` of a shear rate G (1/time), which turns bodies clockwise where it is
    /// positive.
    #[must_use]
    pub fn shear(rate: f64) -> Self {
        Self { gradient: [[0.0, rate], [0.0, 0.0]], ..Self::NONE }
    }

    /// Creates the extensional flow `u = (E x, -E y)` of an extension rate E (1/time).
    #[must_use]
    pub fn extension(rate: f64) -> Self {
        Self { gradient: [[rate, 0.0], [0.0, -rate]], ..Self::NONE }
    }

    /// Creates the rotation `u = W (-y, x)` of an angular velocity W (1/time), counter-clockwise.
    #[must_use]
    pub fn rotation(rate: f64) -> Self {
        Self { gradient: [[0.0, -rate], [rate, 0.0]], ..Self::NONE }
    }

    /// Creates the Poiseuille flow `u = U (1 - y^2/h^2)` along x of a largest speed U (length per time), which is zero
    /// at a distance h (length) from its middle.
    ///
    /// # Errors
    /// Returns an error for a distance that is not positive and finite.
    pub fn poiseuille(speed: f64, half_width: f64) -> Result<Self, InputError> {
        let half = positive("the half width of a Poiseuille flow", half_width)?;
        Ok(Self { velocity: [speed, 0.0], bend: -2.0 * speed / (half * half), ..Self::NONE })
    }

    /// Creates the Couette flow between walls at `y = -width/2` and `width/2` (length) that slide along x with these
    /// velocities (length per time).
    #[must_use]
    pub fn couette([below, above]: [f64; 2], width: f64) -> Self {
        Self { velocity: [0.5 * (below + above), 0.0], ..Self::shear((above - below) / width) }
    }

    /// Creates the Couette flow as [`ImposedFlow::couette`] between walls along which fluid slips, with these slip
    /// lengths (length), the lower one first. The shear rate is the difference of the velocities over the sum of the
    /// width and both slip lengths.
    #[must_use]
    pub fn couette_with_slip([below, above]: [f64; 2], width: f64, slip: [f64; 2]) -> Self {
        let rate = (above - below) / (width + slip[0] + slip[1]);
        Self { velocity: [below + rate * (0.5 * width + slip[0]), 0.0], ..Self::shear(rate) }
    }

    /// Returns true if there is no flow.
    #[must_use]
    pub fn is_none(&self) -> bool {
        *self == Self::NONE
    }

    /// Returns the shear rate du/dy at the origin (1/time).
    #[must_use]
    pub fn shear_rate(&self) -> f64 {
        self.gradient[0][1]
    }

    /// Returns the fastest rate of the linear part. It is the root of half the sum of the squares of all gradients
    /// (1/time), which is E for an extension and `G/sqrt(2)` for a shear.
    #[must_use]
    pub fn rate(&self) -> f64 {
        (0.5 * self.gradient.as_flattened().iter().map(|slope| slope * slope).sum::<f64>()).sqrt()
    }

    /// Returns the velocity at a place (length per time).
    #[must_use]
    #[inline]
    pub fn velocity_at(&self, place: Vec2) -> Vec2 {
        let Self { velocity: [u, v], gradient: [[ux, uy], [vx, vy]], bend } = *self;
        let Vec2 { x, y } = place;
        Vec2::new(u + ux * x + (uy + 0.5 * bend * y) * y, v + vx * x + vy * y)
    }

    /// Returns the velocity gradient at a place (1/time), as [`FlowSample::gradient`].
    #[must_use]
    pub fn gradient_at(&self, place: Vec2) -> [[f64; 2]; 2] {
        let [[ux, uy], rest] = self.gradient;
        [[ux, uy + self.bend * place.y], rest]
    }

    /// Returns the flow at a place in fluid of that viscosity (stress times time).
    #[must_use]
    pub fn sample(&self, place: Vec2, viscosity: f64) -> FlowSample {
        FlowSample {
            velocity: self.velocity_at(place),
            pressure: viscosity * self.bend * place.x,
            gradient: self.gradient_at(place),
        }
    }

    /// Refuses numbers that are not finite, and a linear flow that does not keep areas.
    ///
    /// # Errors
    /// Returns [`InputError::NotFinite`], [`InputError::OutOfRange`].
    pub fn check(&self) -> Result<(), InputError> {
        all_finite("the velocity of an imposed flow", &self.velocity)?;
        all_finite("the gradient of an imposed flow", self.gradient.as_flattened())?;
        finite("the curvature of an imposed flow", self.bend)?;
        let [[ux, _], [_, vy]] = self.gradient;
        let round_off = 1e-12 * ux.abs().max(vy.abs());
        crate::within("the divergence of an imposed flow", ux + vy, -round_off, round_off).map(drop)
    }
}

impl std::ops::Add for ImposedFlow {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let plus = |a: [f64; 2], b: [f64; 2]| [a[0] + b[0], a[1] + b[1]];
        Self {
            velocity: plus(self.velocity, other.velocity),
            gradient: [0, 1].map(|row| plus(self.gradient[row], other.gradient[row])),
            bend: self.bend + other.bend,
        }
    }
}

#[cfg(test)]
mod tests;
