//! Regularised delta functions.

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
/// (thesis (2.35)).
pub trait Kernel: std::fmt::Debug + Clone + Send + Sync {
    /// Its name on command lines and in files.
    fn name(&self) -> &'static str;

    /// Grid points reached in one direction, at most [`MAX_SUPPORT`].
    fn support(&self, role: Role) -> usize;

    /// Weights of the points `first, first + 1, ...` of a lattice of integers for a marker at `r` (in units of h);
    /// returns `first`. Only the first [`Kernel::support`] entries of `weights` are written.
    fn weights(&self, role: Role, r: f64, weights: &mut [f64; MAX_SUPPORT]) -> i64;

    /// The one-dimensional function itself at distance `r` (in units of h); even.
    fn value(&self, role: Role, r: f64) -> f64;

    /// Fourier transform `integral of phi(r) cos(theta r) dr` at wave number `theta` (in units of 1/h).
    fn transform(&self, role: Role, theta: f64) -> f64 {
        cosine_transform(|r| self.value(role, r), 0.5 * self.support(role) as f64, theta)
    }
}

/// `2 integral_0^reach f(r) cos(theta r) dr` for f smooth between half integers, by composite Gauss quadrature.
fn cosine_transform(f: impl Fn(f64) -> f64, reach: f64, theta: f64) -> f64 {
    // Panels short enough that ten Gauss points resolve the cosine to round-off.
    let panels_per_half = (theta.abs() / 8.0).ceil().max(1.0) as usize;
    let panels = (2.0 * reach).round() as usize * panels_per_half;
    let width = reach / panels as f64;
    let mut sum = 0.0;
    for p in 0..panels {
        for (x, w) in crate::quadrature::GAUSS_10 {
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

/// Peskin's 4-point function, thesis (2.36); the same in both roles.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Peskin4;

impl Kernel for Peskin4 {
    fn name(&self) -> &'static str {
        "peskin4"
    }

    fn support(&self, _role: Role) -> usize {
        4
    }

    fn weights(&self, role: Role, r: f64, weights: &mut [f64; MAX_SUPPORT]) -> i64 {
        tabulate(4, r, weights, |x| self.value(role, x))
    }

    fn value(&self, _role: Role, r: f64) -> f64 {
        let r = r.abs();
        if r < 1.0 {
            (3.0 - 2.0 * r + (1.0 + 4.0 * r * (1.0 - r)).sqrt()) / 8.0
        } else if r < 2.0 {
            (5.0 - 2.0 * r - (4.0 * r * (3.0 - r) - 7.0).max(0.0).sqrt()) / 8.0
        } else {
            0.0
        }
    }
}

/// The 3-point function of Roma, Peskin and Berger (J. Comput. Phys. 153, 1999); the same in both roles.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Roma3;

impl Kernel for Roma3 {
    fn name(&self) -> &'static str {
        "roma3"
    }

    fn support(&self, _role: Role) -> usize {
        3
    }

    fn weights(&self, role: Role, r: f64, weights: &mut [f64; MAX_SUPPORT]) -> i64 {
        tabulate(3, r, weights, |x| self.value(role, x))
    }

    fn value(&self, _role: Role, r: f64) -> f64 {
        let r = r.abs();
        if r < 0.5 {
            (1.0 + (1.0 - 3.0 * r * r).sqrt()) / 3.0
        } else if r < 1.5 {
            let s = 1.0 - r;
            (5.0 - 3.0 * r - (1.0 - 3.0 * s * s).max(0.0).sqrt()) / 6.0
        } else {
            0.0
        }
    }
}

/// The Gaussian-like 6-point function of Bao, Kaye and Peskin (J. Comput. Phys. 316, 2016), three times continuously
/// differentiable; the same in both roles.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Gaussian6;

impl Gaussian6 {
    /// Second moment K = 59/60 - sqrt(29)/20, the value that makes the third derivative continuous.
    #[must_use]
    pub fn second_moment() -> f64 {
        59.0 / 60.0 - 29.0_f64.sqrt() / 20.0
    }

    /// phi at -3 + r, -2 + r, ..., 2 + r for r in [0, 1): the even-odd condition, three moment conditions and the
    /// sum of squares leave a quadratic equation for the outermost value.
    fn branches(r: f64) -> [f64; 6] {
        let k = Self::second_moment();
        let (r2, r3) = (r * r, r * r * r);
        let alpha = 28.0;
        let beta = 9.0 / 4.0 - 1.5 * (k + r2) + (22.0 / 3.0 - 7.0 * k) * r - 7.0 / 3.0 * r3;
        let gamma = 0.25
            * (0.5 * (161.0 / 36.0 - 59.0 / 6.0 * k + 5.0 * k * k) * r2
                + (5.0 * k - 109.0 / 24.0) / 3.0 * r2 * r2
                + 5.0 / 18.0 * r3 * r3);
        let outer = (-beta + (1.5 - k).signum() * (beta * beta - 4.0 * alpha * gamma).sqrt()) / (2.0 * alpha);
        [
            outer,
            -3.0 * outer - 1.0 / 16.0 + (k + r2) / 8.0 + (3.0 * k - 1.0) * r / 12.0 + r3 / 12.0,
            2.0 * outer + 0.25 + (4.0 - 3.0 * k) * r / 6.0 - r3 / 6.0,
            2.0 * outer + 5.0 / 8.0 - (k + r2) / 4.0,
            -3.0 * outer + 0.25 - (4.0 - 3.0 * k) * r / 6.0 + r3 / 6.0,
            outer - 1.0 / 16.0 + (k + r2) / 8.0 - (3.0 * k - 1.0) * r / 12.0 - r3 / 12.0,
        ]
    }
}

impl Kernel for Gaussian6 {
    fn name(&self) -> &'static str {
        "gaussian6"
    }

    fn support(&self, _role: Role) -> usize {
        6
    }

    fn weights(&self, _role: Role, r: f64, weights: &mut [f64; MAX_SUPPORT]) -> i64 {
        let floor = r.floor();
        // The point 'floor - 2 + i' lies at distance 'floor - 2 + i - r' = -3 + i + (1 - fraction); phi is even, so the
        // branches run backwards with the fraction itself.
        let branches = Self::branches(r - floor);
        for (weight, value) in weights.iter_mut().zip(branches.iter().rev()) {
            *weight = *value;
        }
        floor as i64 - 2
    }

    fn value(&self, _role: Role, r: f64) -> f64 {
        let r = r.abs();
        if r >= 3.0 {
            return 0.0;
        }
        let cell = r.floor();
        Self::branches(r - cell)[cell as usize + 3]
    }
}

/// Cardinal B-spline of order N in the normal role and N - 1 in the tangential one (degree one less): interpolation of
/// a discretely divergence-free field with it is divergence free in the continuum (numerics.md section 4, after Bao et
/// al., J. Comput. Phys. 347, 2017). `CompositeBSpline<4>`, cubic and quadratic, is the default of this crate.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct CompositeBSpline<const N: usize>;

/// The default kernel: cubic B-spline along a velocity component, quadratic across it.
pub type CubicQuadratic = CompositeBSpline<4>;

impl<const N: usize> CompositeBSpline<N> {
    // Orders this crate provides; checked when the type is used.
    const CHECK: () = assert!(N >= 3 && N <= MAX_SUPPORT, "orders 3 to 6");

    fn order(role: Role) -> usize {
        let () = Self::CHECK;
        match role {
            Role::Normal => N,
            Role::Tangential => N - 1,
        }
    }
}

/// Values of the B-splines of order `order` that are not zero at a point `t` in [0, 1) past a knot, by the recursion
/// of de Boor and Cox.
fn bspline_values(order: usize, t: f64, weights: &mut [f64; MAX_SUPPORT]) {
    weights[0] = 1.0;
    for degree in 1..order {
        let scale = 1.0 / degree as f64;
        let mut left = 0.0;
        for (i, weight) in weights.iter_mut().enumerate().take(degree) {
            let term = *weight * scale;
            *weight = left + (1.0 + i as f64 - t) * term;
            left = (degree as f64 - 1.0 - i as f64 + t) * term;
        }
        weights[degree] = left;
    }
}

impl<const N: usize> Kernel for CompositeBSpline<N> {
    fn name(&self) -> &'static str {
        ["bspline3", "bspline4", "bspline5", "bspline6"][N - 3]
    }

    fn support(&self, role: Role) -> usize {
        Self::order(role)
    }

    #[inline]
    fn weights(&self, role: Role, r: f64, weights: &mut [f64; MAX_SUPPORT]) -> i64 {
        let order = Self::order(role);
        // A spline of even order has its knots on the lattice, one of odd order half way between.
        let shifted = r + 0.5 * (order % 2) as f64;
        let floor = shifted.floor();
        bspline_values(order, shifted - floor, weights);
        floor as i64 - (order as i64 - 1) / 2
    }

    fn value(&self, role: Role, r: f64) -> f64 {
        let order = Self::order(role);
        let half = 0.5 * order as f64;
        if r.abs() >= half {
            return 0.0;
        }
        let s = half - r.abs();
        let mut weights = [0.0; MAX_SUPPORT];
        let piece = s.floor();
        bspline_values(order, s - piece, &mut weights);
        weights[order - 1 - piece as usize]
    }

    /// `(sin(theta/2) / (theta/2))^order`.
    fn transform(&self, role: Role, theta: f64) -> f64 {
        let half = 0.5 * theta;
        let sinc = if half.abs() < 1e-4 { 1.0 - half * half / 6.0 } else { half.sin() / half };
        sinc.powi(Self::order(role) as i32)
    }
}

/// A kernel chosen at run time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AnyKernel {
    /// [`Peskin4`].
    Peskin4,
    /// [`Roma3`].
    Roma3,
    /// [`Gaussian6`].
    Gaussian6,
    /// [`CompositeBSpline<3>`]: quadratic/linear.
    BSpline3,
    /// [`CompositeBSpline<4>`]: cubic/quadratic, the default.
    BSpline4,
    /// [`CompositeBSpline<5>`]: quartic/cubic.
    BSpline5,
    /// [`CompositeBSpline<6>`]: quintic/quartic.
    BSpline6,
}

impl AnyKernel {
    /// All of them.
    pub const ALL: [Self; 7] =
        [Self::Peskin4, Self::Roma3, Self::Gaussian6, Self::BSpline3, Self::BSpline4, Self::BSpline5, Self::BSpline6];
}

macro_rules! dispatch {
    ($self:ident, $method:ident ( $($argument:expr),* )) => {
        match $self {
            AnyKernel::Peskin4 => Peskin4.$method($($argument),*),
            AnyKernel::Roma3 => Roma3.$method($($argument),*),
            AnyKernel::Gaussian6 => Gaussian6.$method($($argument),*),
            AnyKernel::BSpline3 => CompositeBSpline::<3>.$method($($argument),*),
            AnyKernel::BSpline4 => CompositeBSpline::<4>.$method($($argument),*),
            AnyKernel::BSpline5 => CompositeBSpline::<5>.$method($($argument),*),
            AnyKernel::BSpline6 => CompositeBSpline::<6>.$method($($argument),*),
        }
    };
}

impl Kernel for AnyKernel {
    fn name(&self) -> &'static str {
        dispatch!(self, name())
    }

    fn support(&self, role: Role) -> usize {
        dispatch!(self, support(role))
    }

    fn weights(&self, role: Role, r: f64, weights: &mut [f64; MAX_SUPPORT]) -> i64 {
        dispatch!(self, weights(role, r, weights))
    }

    fn value(&self, role: Role, r: f64) -> f64 {
        dispatch!(self, value(role, r))
    }

    fn transform(&self, role: Role, theta: f64) -> f64 {
        dispatch!(self, transform(role, theta))
    }
}

impl std::str::FromStr for AnyKernel {
    type Err = crate::FlowError;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        Self::ALL.into_iter().find(|kernel| kernel.name() == name).ok_or(crate::FlowError::Unsupported {
            what: "a kernel of that name",
            remedy: "use peskin4, roma3, gaussian6, bspline3, bspline4, bspline5 or bspline6",
        })
    }
}
