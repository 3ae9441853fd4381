//! The flow of a two-dimensional squirmer.

use motile_base::{Vec2, finite, positive};

use crate::InterfaceError;
use crate::observables::{SquirmerFit, VelocityFrame};

/// The two-dimensional squirmer: a circle on which the fluid moves with v_r = 0 and v_theta = B1 sin(theta) + (B2/2)
/// sin(2 theta) in its own frame (Cowley, eq. 2.63), without a force on it, filled with fluid that moves along.
///
/// With rho = r/R, it swims with the speed B1/2 along theta = 0; in its own frame
/// ```text
/// outside  v_r = -(B1/2)(1 - rho^-2) cos theta + (B2/2)(rho^-3 - rho^-1) cos 2 theta
///          v_theta = (B1/2)(1 + rho^-2) sin theta + (B2/2) rho^-3 sin 2 theta
/// inside   v_r = (B1/2)(1 - rho^2) cos theta + (B2/2)(rho - rho^3) cos 2 theta
///          v_theta = (B1/2)(3 rho^2 - 1) sin theta + (B2/2)(2 rho^3 - rho) sin 2 theta
/// ```
///
/// ```
/// use active_interface::{observables::VelocityFrame, theory::SquirmerFlow};
/// let pusher = SquirmerFlow::new(1.0, 1.0, -1.0)?;
/// assert_eq!(pusher.speed(), 0.5);
/// let ahead = pusher.velocity(motile_base::Vec2::new(3.0, 0.0), VelocityFrame::Laboratory);
/// assert!(ahead.x > 0.0); // pushed along
/// # Ok::<(), active_interface::InterfaceError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("squirmer", "pusher", "puller", "slip velocity"))]
pub struct SquirmerFlow {
    radius: f64,
    b1: f64,
    b2: f64,
}

impl SquirmerFlow {
    /// Creates the squirmer with this radius (length) and the coefficients B1 and B2 (length per time), centred at the
    /// origin and swimming along x for B1 > 0.
    ///
    /// # Errors
    /// Returns an error for a radius that is not positive, coefficients that are not finite.
    pub fn new(radius: f64, b1: f64, b2: f64) -> Result<Self, InterfaceError> {
        let radius = positive("the radius", radius)?;
        Ok(Self { radius, b1: finite("B1", b1)?, b2: finite("B2", b2)? })
    }

    /// Returns the swimming speed along x (length per time), B1/2.
    #[must_use]
    pub fn speed(&self) -> f64 {
        0.5 * self.b1
    }

    /// Returns the velocity (v_r, v_theta) in the squirmer's frame (length per time) at the polar coordinates r
    /// (length) and theta (radians).
    #[must_use]
    pub fn polar_velocity(&self, r: f64, theta: f64) -> [f64; 2] {
        let rho = r / self.radius;
        let (b1, b2) = (0.5 * self.b1, 0.5 * self.b2);
        let (s1, c1) = theta.sin_cos();
        let (s2, c2) = (2.0 * theta).sin_cos();
        if rho <= 1.0 {
            let (square, cube) = (rho * rho, rho * rho * rho);
            [
                b1 * (1.0 - square) * c1 + b2 * (rho - cube) * c2,
                b1 * (3.0 * square - 1.0) * s1 + b2 * (2.0 * cube - rho) * s2,
            ]
        } else {
            let (square, cube) = (rho.powi(-2), rho.powi(-3));
            [-b1 * (1.0 - square) * c1 + b2 * (cube - 1.0 / rho) * c2, b1 * (1.0 + square) * s1 + b2 * cube * s2]
        }
    }

    /// Returns the velocity (length per time) at a point (length), in the squirmer's or in the laboratory frame.
    #[must_use]
    pub fn velocity(&self, point: Vec2, frame: VelocityFrame) -> Vec2 {
        let theta = point.y.atan2(point.x);
        let [radial, azimuthal] = self.polar_velocity(point.length(), theta);
        let (sin, cos) = theta.sin_cos();
        let velocity = Vec2::new(radial * cos - azimuthal * sin, radial * sin + azimuthal * cos);
        match frame {
            VelocityFrame::CoMoving => velocity,
            VelocityFrame::Laboratory => velocity + Vec2::new(self.speed(), 0.0),
        }
    }

    /// Returns beta = B2/|B1| (no dimension); `None` if B1 is zero.
    #[must_use]
    pub fn beta(&self) -> Option<f64> {
        SquirmerFit { b1: self.b1, b2: self.b2 }.beta()
    }
}
