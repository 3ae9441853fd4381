//! Curvatures of an interface: from a circle fitted to an arc, and from the balance of stresses.

use motile_base::{
    FlowSample, Vec2, finite,
    internal::{all_points_finite, at_least},
    positive,
};

use super::least_squares::NormalEquations;
use crate::InterfaceError;

/// Returns the signed curvature (1/length) of the circle with the minimum sum of squared distances, times `weights`,
/// from the points of an open arc: positive where the arc turns to the left, as a convex interface in counter-clockwise
/// order does, negative where it turns to the right, zero for points on a line.
///
/// The circle A r^2 + B x + C y + D = 0 with B^2 + C^2 - 4 A D = 1 includes straight lines (A = 0), and its curvature
/// is 2 A; Gauss-Newton iterations start from the turning of the arc about its middle.
///
/// # Errors
/// Returns an error for fewer than three points, points that are not finite, points that determine no circle, no
/// convergence.
pub(crate) fn fitted_curvature(points: &[Vec2], weights: &[f64]) -> Result<f64, InterfaceError> {
    at_least("points of an arc", points.len(), 3)?;
    all_points_finite("the points of the arc", points)?;
    let n = points.len();
    let no_fit = || InterfaceError::no_fit("a circle", n);
    let extent = points.iter().map(|p| (p - points[0]).length()).fold(0.0, f64::max);
    if extent == 0.0 {
        return Err(no_fit());
    }
    // Units of the extent, origin in the middle of the arc.
    let origin = points[n / 2];
    let local: Vec<Vec2> = points.iter().map(|p| (p - origin) / extent).collect();
    let (first, last) = (local[1] - local[0], local[n - 1] - local[n - 2]);
    let turning: f64 = local.windows(3).map(|p| (p[1] - p[0]).angle_to(p[2] - p[1])).sum();
    let arc: f64 =
        local.windows(2).map(|p| (p[1] - p[0]).length()).sum::<f64>() - 0.5 * (first.length() + last.length());
    let tangent = local[(n / 2 + 1).min(n - 1)] - local[n / 2 - 1];
    if arc <= 0.0 || tangent == Vec2::ZERO {
        return Err(no_fit());
    }

    let mut a = 0.5 * turning / arc;
    let mut angle = (-tangent.x).atan2(tangent.y);
    let mut d = 0.0;
    let mut damping = 0.0;
    let mut cost = f64::INFINITY;
    let mut previous = (a, angle, d);
    for _ in 0..100 {
        let root = (1.0 + 4.0 * a * d).max(1e-12).sqrt();
        let (sin, cos) = angle.sin_cos();
        let (mut equations, mut sum) = (NormalEquations::new(), 0.0);
        for (p, &weight) in local.iter().zip(weights) {
            let square = p.length_squared();
            let along = p.x * cos + p.y * sin;
            let value = a * square + root * along + d;
            let stretch = (1.0 + 4.0 * a * value).max(1e-12).sqrt();
            let distance = 2.0 * value / (1.0 + stretch);
            // Derivatives of the distance by the value and, at a fixed value, by A.
            let by_value = 1.0 / stretch;
            let by_a = -distance * distance / stretch;
            let row = [
                by_value * (square + 2.0 * d / root * along) + by_a,
                by_value * root * (p.y * cos - p.x * sin),
                by_value * (1.0 + 2.0 * a / root * along),
            ];
            equations.add(row, weight, distance);
            sum += weight * distance * distance;
        }
        if sum > cost * (1.0 + 1e-12) {
            (a, angle, d) = previous;
            damping = (damping * 10.0f64).max(1e-6);
            if damping > 1e12 {
                break;
            }
            cost = f64::INFINITY;
            continue;
        }
        cost = sum;
        previous = (a, angle, d);
        let Some(step) = equations.step(damping) else { return Err(no_fit()) };
        (a, angle, d) = (a - step[0], angle - step[1], d - step[2]);
        damping *= 0.1;
        if step.iter().all(|change| change.abs() < 1e-13) {
            return Ok(2.0 * a / extent);
        }
    }
    Err(InterfaceError::NoConvergence {
        what: "the fit of a circle",
        residual: cost,
        tolerance: 1e-13,
        remedy: "Use points that lie closer to an arc",
    })
}

/// Returns the curvature (1/length) at which the tension of an interface balances the stresses of both fluids, Cowley
/// (2.61) and (3.8):
///
/// `kappa = n . (sigma_out - sigma_in) . n / gamma,   sigma = eta (grad u + grad u^T) - p`
///
/// with the flow on its inner and on its outer side, the viscosities of the two (stress times time), the outward normal
/// n (any length) and the tension gamma (force). On an exact solution it is the curvature of the interface, so that
/// the difference measures errors of pressure and gradients.
///
/// # Errors
/// Returns an error for a tension that is zero or not finite, viscosities that are not positive, flows or a normal that
/// are not finite.
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

#[cfg(test)]
mod tests;
