//! The curvature that stresses hold.

use ib_core::input::{finite, positive};
use ib_core::{FlowSample, Vec2};

use crate::InterfaceError;

/// The curvature (1/length) at which the tension of an interface balances the stresses of both fluids, Cowley (2.61)
/// and (3.8):
///
/// `kappa = n . (sigma_out - sigma_in) . n / gamma,   sigma = eta (grad u + grad u^T) - p`
///
/// with the flow on its inner and on its outer side, the viscosities of the two (stress times time), the outward normal
/// n (any length) and the tension gamma (force). On an exact solution it is the curvature of the interface, so that
/// the difference measures errors of pressure and gradients.
///
/// # Errors
/// A tension that is zero or not finite, viscosities that are not positive, flows or a normal that are not finite.
pub fn stress_curvature(
    sides: [FlowSample; 2],
    viscosities: [f64; 2],
    normal: Vec2,
    tension: f64,
) -> Result<f64, InterfaceError> {
    let n = normal / positive("the length of the normal", normal.length())?;
    positive("the magnitude of the tension", tension.abs())?;
    let mut jump = 0.0;
    for ((side, viscosity), sign) in sides.iter().zip(viscosities).zip([-1.0, 1.0]) {
        let [[ux, uy], [vx, vy]] = side.gradient;
        let rate = ux * n.x * n.x + (uy + vx) * n.x * n.y + vy * n.y * n.y;
        jump += sign * (2.0 * positive("the viscosity", viscosity)? * rate - side.pressure);
    }
    Ok(finite("the curvature", jump / tension)?)
}
