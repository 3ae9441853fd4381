//! Regularised delta functions.

mod any;
mod bspline;
mod classical;
mod gaussian;
mod pieces;

pub use any::AnyKernel;
pub use bspline::BSpline;
pub use classical::{Peskin4, Roma3};
pub use gaussian::Gaussian6;
pub(crate) use pieces::BSPLINE_4;
pub use pieces::Pieces;

/// Most grid points in one direction that a kernel of this crate reaches.
pub const MAX_SUPPORT: usize = 6;

/// The role of a direction for a staggered velocity component: the x velocity has x as its normal direction (it lives
/// on faces normal to x) and y as its tangential one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Along the component.
    Normal,
    /// Across the component.
    Tangential,
}

/// A regularised delta function as a product of one-dimensional functions,
/// `delta_h(x) = phi_n(x/h) phi_t(y/h) / h^2` for the x component, normal and tangential exchanged for the y component
/// (Cowley (2.35)).
#[doc(alias("delta function", "regularised delta function", "Dirac delta"))]
pub trait Kernel: std::fmt::Debug + Clone + Send + Sync {
    /// Returns the name on command lines and in files.
    fn name(&self) -> &'static str;

    /// Returns the grid points reached in one direction, at most [`MAX_SUPPORT`].
    fn support(&self, role: Role) -> usize;

    /// Returns the weights of the points `first, first + 1, ...` of a lattice of integers for a marker at `r` (in units
    /// of h); returns `first`. Only the first [`Kernel::support`] entries of `weights` are written.
    fn weights(&self, role: Role, r: f64, weights: &mut [f64; MAX_SUPPORT]) -> i64;

    /// Returns the weights as polynomials, for the kernels that have them; without them spreading and interpolation
    /// call [`Kernel::weights`].
    fn pieces(&self) -> Option<&'static Pieces> {
        None
    }

    /// Returns the one-dimensional function itself at distance `r` (in units of h); even.
    fn value(&self, role: Role, r: f64) -> f64;

    /// Returns the Fourier transform `integral of phi(r) cos(theta r) dr` at wave number `theta` (in units of 1/h).
    fn transform(&self, role: Role, theta: f64) -> f64 {
        cosine_transform(|r| self.value(role, r), 0.5 * self.support(role) as f64, theta)
    }
}

/// Nodes on [-1, 1] and weights of Gauss-Legendre quadrature with ten points (exact for polynomials of degree 19).
pub(crate) const GAUSS_10: [(f64, f64); 10] = [
    (-0.9739065285171717, 0.06667134430868814),
    (-0.8650633666889845, 0.1494513491505804),
    (-0.6794095682990244, 0.219086362515982),
    (-0.4333953941292472, 0.2692667193099965),
    (-0.14887433898163122, 0.2955242247147528),
    (0.14887433898163122, 0.2955242247147528),
    (0.4333953941292472, 0.2692667193099965),
    (0.6794095682990244, 0.219086362515982),
    (0.8650633666889845, 0.1494513491505804),
    (0.9739065285171717, 0.06667134430868814),
];

/// Returns `2 integral_0^reach f(r) cos(theta r) dr` for f smooth between half integers, by composite Gauss quadrature.
fn cosine_transform(f: impl Fn(f64) -> f64, reach: f64, theta: f64) -> f64 {
    // Panels short enough that ten Gauss points resolve the cosine to round-off.
    let panels_per_half = (theta.abs() / 8.0).ceil().max(1.0) as usize;
    let panels = (2.0 * reach).round() as usize * panels_per_half;
    let width = reach / panels as f64;
    let mut sum = 0.0;
    for p in 0..panels {
        for (x, w) in GAUSS_10 {
            let r = width * (p as f64 + 0.5 * (1.0 + x));
            sum += 0.5 * width * w * f(r) * (theta * r).cos();
        }
    }
    2.0 * sum
}

/// Writes `value(r - first - i)` for every point of an even support, and returns the first point.
fn tabulate(support: usize, r: f64, weights: &mut [f64; MAX_SUPPORT], value: impl Fn(f64) -> f64) -> i64 {
    // Even supports start 'support/2 - 1' below the floor, odd ones are centred on the nearest point.
    let first =
        if support.is_multiple_of(2) { r.floor() - (support / 2 - 1) as f64 } else { r.round() - (support / 2) as f64 };
    for (i, weight) in weights.iter_mut().enumerate().take(support) {
        *weight = value(r - first - i as f64);
    }
    first as i64
}

#[cfg(test)]
mod tests;
