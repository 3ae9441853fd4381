//! Mobility of an interface that is lost to spreading, the grid and interpolation.

mod correction;

pub(crate) use correction::{MobilityCorrection, Setting};

use crate::{
    Kernel,
    kernel::{GAUSS_10, Role},
};

/// Largest tabulated wave number (in units of 1/h); above it the grid does not respond at all.
const LAST: f64 = 6.3;
/// Intervals of the table, uniform in the square root of the wave number: the functions bend fastest near zero.
const INTERVALS: usize = 40;
/// Wave numbers across the interface beyond which the kernels' transforms no longer matter.
const CUT: f64 = 50.0;

/// Deficits of the discrete mobility of a flat interface, per kernel (docs/explanation/grid.md).
///
/// A force of wave number q along a flat interface moves it, in Stokes flow without boundaries, at `F / (4 eta q)`,
/// tangentially and normally alike. Spreading, the discrete Laplacian and interpolation reduce that to
/// `R F / (4 eta q)`, averaged over positions between the grid lines, with (all wave numbers in units of 1/h; tangent
/// t, normal n, k the wave number across the interface, `(k_x, k_y) = q t + k n`, `d_j = 2 sin(k_j / 2)`, w_u and w_v
/// the Fourier transforms of the kernels of the two velocity components)
///
/// `R_t = 4 q / (2 pi) integral dk (t_x w_u d_y - t_y w_v d_x)^2 / (d_x^2 + d_y^2)^2`, and `R_n` with n for t.
///
/// An interface inclined to the grid has one more: a tangential force moves it normally too, and the other way round,
/// by `-G_x F`,
///
/// `G_x = -1 / (2 pi) integral dk (t_x w_u d_y - t_y w_v d_x) (n_x w_u d_y - n_y w_v d_x) / (d_x^2 + d_y^2)^2`,
///
/// which is as large as a sixth of G_n, odd under reflection, and therefore turns a droplet that is not along the grid.
///
/// Stored are the first coefficients of `G = (1 - R) / (4 q)` in cos(4 angle) and, for G_t, cos(8 angle), and the
/// coefficient of G_x in sin(4 angle).
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MobilityDeficit {
    /// Rows at equal steps of sqrt(q): mean, slope and curvature of G_t, mean and slope of G_n, G_x.
    table: Vec<[f64; 6]>,
    /// First grid harmonic of an interface along the grid, at equal steps of the wave number.
    harmonic: Vec<f64>,
    /// The second grid harmonic over the first at small wave numbers.
    second_harmonic: f64,
}

/// Wave number (in units of 1/h) above which the grid harmonic is negligible.
const HARMONIC_LAST: f64 = 6.0;
/// Intervals of the table of the grid harmonic.
const HARMONIC_INTERVALS: usize = 48;

/// The deficits `G = (1 - R) / (4 q)` of one wave number, q in units of 1/h, so that `(h/eta) G F` is the velocity that
/// is missing: with `z = n_x^4 + n_y^4 - 3/4 = cos(4 angle) / 4`, n the normal of the interface,
/// `G = mean + slope z + curvature (32 z^2 - 1)`, and `G_x = cross sin(4 angle)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Deficit {
    /// Mean of the tangential deficit.
    pub(crate) tangential: f64,
    /// Slope of the tangential deficit.
    pub(crate) tangential_slope: f64,
    /// Curvature of the tangential deficit.
    pub(crate) tangential_curvature: f64,
    /// Mean of the normal deficit.
    pub(crate) normal: f64,
    /// Slope of the normal deficit.
    pub(crate) normal_slope: f64,
    /// Amplitude of the deficit that couples tangent and normal, for an angle of the normal of pi/8.
    pub(crate) cross: f64,
}

/// Returns how far from a line of points at rest the fluid that shears past them comes to rest (grid spacings). The
/// points are one next to the other, and the delta function of the kernel spreads their forces. It takes some
/// milliseconds.
///
/// ```
/// let distance = ib_core::rest_distance(&ib_core::AnyKernel::BSpline4);
/// assert!(distance > 0.2 && distance < 0.4);
/// ```
#[must_use]
#[doc(alias("hydrodynamic radius"))]
pub fn rest_distance<K: Kernel>(kernel: &K) -> f64 {
    MobilityDeficit::new(kernel).at(0.0).tangential
}

impl MobilityDeficit {
    /// Tabulates the deficits of a kernel (some milliseconds).
    #[must_use]
    pub(crate) fn new<K: Kernel>(kernel: &K) -> Self {
        let transforms = Transforms::new(kernel);
        let table = (0..=INTERVALS)
            .map(|i| {
                let root = LAST.sqrt() * i as f64 / INTERVALS as f64;
                let q = (root * root).max(1e-6);
                // n_x^4 + n_y^4 - 3/4 = cos(4 angle) / 4: the first Fourier coefficients, by the trapezoidal rule.
                let mut row = [0.0; 6];
                for (step, weight) in [0.125, 0.25, 0.25, 0.25, 0.125].into_iter().enumerate() {
                    let phase = 0.25 * std::f64::consts::PI * step as f64;
                    let [tangential, normal, cross] = deficits(&transforms, q, 0.25 * phase);
                    row[0] += weight * tangential;
                    row[1] += weight * 8.0 * phase.cos() * tangential;
                    row[2] += weight * 2.0 * (2.0 * phase).cos() * tangential;
                    row[3] += weight * normal;
                    row[4] += weight * 8.0 * phase.cos() * normal;
                    row[5] += weight * 2.0 * phase.sin() * cross;
                }
                row
            })
            .collect();
        let harmonic = (0..=HARMONIC_INTERVALS)
            .map(|i| harmonic(&transforms, 1.0, (HARMONIC_LAST * i as f64 / HARMONIC_INTERVALS as f64).max(1e-6)))
            .collect();
        let second_harmonic = harmonic_ratio(&transforms);
        Self { table, harmonic, second_harmonic }
    }

    /// Returns the grid harmonic at wave number `q` (in units of 1/h). It is the part of the tangential mobility of an
    /// interface along the grid lines that follows its position between them,
    ///
    /// `H(q) = 1 / (2 pi) integral dk w_u(q, k) d_y(k) w_u(q, k + 2 pi) d_y(k + 2 pi) / (d_x^2 + d_y^2)^2`,
    ///
    /// so that a tangential force F e^{iqx} per length at the height y above a row of nodes moves it by
    /// `(h/eta) F (R/(4q) + 2 H cos(2 pi y/h))`. Without dimension; zero above q = 6.
    #[must_use]
    pub(crate) fn harmonic(&self, q: f64) -> f64 {
        let position = q.abs() / HARMONIC_LAST * HARMONIC_INTERVALS as f64;
        let i = position as usize;
        if i >= HARMONIC_INTERVALS {
            return 0.0;
        }
        let s = position - i as f64;
        let before = self.harmonic[if i == 0 { 1 } else { i - 1 }];
        let after = self.harmonic[(i + 2).min(HARMONIC_INTERVALS)];
        let (a, b) = (self.harmonic[i], self.harmonic[i + 1]);
        a + s
            * (0.5 * (b - before)
                + s * (before - 2.5 * a + 2.0 * b - 0.5 * after + s * (1.5 * (a - b) + 0.5 * (after - before))))
    }

    /// Returns the deficits at wave number `q` (in units of 1/h; negative ones count as zero), by interpolation in the
    /// table.
    #[must_use]
    pub(crate) fn at(&self, q: f64) -> Deficit {
        if q >= LAST {
            let all = 0.25 / q;
            return Deficit {
                tangential: all,
                tangential_slope: 0.0,
                tangential_curvature: 0.0,
                normal: all,
                normal_slope: 0.0,
                cross: 0.0,
            };
        }
        let position = (q.max(0.0) / LAST).sqrt() * INTERVALS as f64;
        let i = (position as usize).min(INTERVALS - 1);
        let s = position - i as f64;
        // Cubic through the four nearest rows, one-sided at the ends.
        let base = i.saturating_sub(1).min(INTERVALS - 3);
        let x = s + (i - base) as f64;
        let weights = [
            -(x - 1.0) * (x - 2.0) * (x - 3.0) / 6.0,
            x * (x - 2.0) * (x - 3.0) / 2.0,
            -x * (x - 1.0) * (x - 3.0) / 2.0,
            x * (x - 1.0) * (x - 2.0) / 6.0,
        ];
        let mut row = [0.0; 6];
        for (weight, entry) in weights.iter().zip(&self.table[base..base + 4]) {
            for (sum, value) in row.iter_mut().zip(entry) {
                *sum += weight * value;
            }
        }
        let [tangential, tangential_slope, tangential_curvature, normal, normal_slope, cross] = row;
        Deficit { tangential, tangential_slope, tangential_curvature, normal, normal_slope, cross }
    }

    /// Returns the second grid harmonic over the first, `H_2 / H`, for forces that vary slowly; H_2 is H with 4 pi for
    /// 2 pi and multiplies `cos(4 pi y/h)`.
    #[must_use]
    pub(crate) fn second_harmonic(&self) -> f64 {
        self.second_harmonic
    }

    /// Returns the fastest relaxation of a nearly flat interface on the grid, in units of tension/(viscosity h). It is
    /// the maximum over wave numbers and directions of `q^2` times the discrete normal mobility, with or without the
    /// correction. About 0.33 for the default kernel with the correction and 0.19 without, 0.13 for Peskin's without.
    #[must_use]
    pub(crate) fn interface_stiffness(&self, corrected: bool) -> f64 {
        let mut fastest: f64 = 0.0;
        for i in 1..=400 {
            let q = 0.03 * i as f64;
            let deficit = self.at(q);
            for direction in [-0.25, 0.0, 0.25] {
                let missing = deficit.normal + direction * deficit.normal_slope;
                let restored = if corrected { missing * normal_taper(q) } else { 0.0 };
                fastest = fastest.max(q * q * (0.25 / q - missing + restored));
            }
        }
        fastest
    }
}

/// Keeps the normal correction from making the shortest wavelengths stiff: `exp(-(q/2)^4)`.
#[must_use]
pub(crate) fn normal_taper(q: f64) -> f64 {
    (-(0.5 * q).powi(4)).exp()
}

/// [G_t, G_n, G_x] at wave number q for an interface whose normal makes `angle` with the x axis.
fn deficits(transforms: &Transforms, q: f64, angle: f64) -> [f64; 3] {
    let (sin, cos) = angle.sin_cos();
    let (normal, tangent) = ([cos, sin], [-sin, cos]);
    // (1 - R)/(4q) = (1/2 pi) integral of [exact integrand - discrete integrand]: no cancellation at small q.
    let difference = |k: f64| {
        let (kx, ky) = (q * tangent[0] + k * normal[0], q * tangent[1] + k * normal[1]);
        let (dx, dy) = (2.0 * (0.5 * kx).sin(), 2.0 * (0.5 * ky).sin());
        let d2 = dx * dx + dy * dy;
        let wu = transforms.at(Role::Normal, kx) * transforms.at(Role::Tangential, ky);
        let wv = transforms.at(Role::Tangential, kx) * transforms.at(Role::Normal, ky);
        let k2 = q * q + k * k;
        let discrete = |along: [f64; 2]| {
            // At an alias of the zero wave number the kernels vanish faster than the Laplacian.
            if d2 < 1e-18 { 0.0 } else { (along[0] * wu * dy - along[1] * wv * dx) / d2 }
        };
        let (t, n) = (discrete(tangent), discrete(normal));
        [(k / k2).powi(2) - t * t, (q / k2).powi(2) - n * n, -t * n]
    };
    let mut sum = [0.0; 3];
    let mut panel = |a: f64, b: f64| {
        for (x, w) in GAUSS_10 {
            let k = 0.5 * (a + b) + 0.5 * (b - a) * x;
            let weight = 0.5 * (b - a) * w;
            for k in [k, -k] {
                for (sum, value) in sum.iter_mut().zip(difference(k)) {
                    *sum += weight * value;
                }
            }
        }
    };
    // Panels that grow from the scale q, on which the integrand varies near zero; short ones over the first aliases.
    let (mut a, mut width) = (0.0, q.clamp(1e-6, 0.5));
    while a < CUT {
        panel(a, a + width);
        a += width;
        width = (2.0 * width).min(if a < 13.0 { 0.25 } else { 0.5 });
    }
    // Beyond the cut only the exact integrands remain; with both signs of k.
    let tail_t = 2.0 * (0.5 / q * (q / a).atan() + 0.5 * a / (q * q + a * a));
    let tail_n = 2.0 * (0.5 / q * (q / a).atan() - 0.5 * a / (q * q + a * a));
    let scale = 0.5 / std::f64::consts::PI;
    [scale * (sum[0] + tail_t), scale * (sum[1] + tail_n), scale * sum[2]]
}

fn harmonic_ratio(transforms: &Transforms) -> f64 {
    let (first, second) = (harmonic(transforms, 1.0, 1e-3), harmonic(transforms, 2.0, 1e-3));
    if first == 0.0 { 0.0 } else { second / first }
}

/// Returns the grid harmonic number `order` of an interface along x; see [`MobilityDeficit::harmonic`].
fn harmonic(transforms: &Transforms, order: f64, q: f64) -> f64 {
    let dx2 = (2.0 * (0.5 * q).sin()).powi(2);
    let along = transforms.at(Role::Normal, q);
    let bracket = |k: f64| along * transforms.at(Role::Tangential, k) * 2.0 * (0.5 * k).sin();
    let mut sum = 0.0;
    // Symmetric about k = -pi order, where both factors are largest.
    let mut a = 0.0;
    while a < CUT - 7.0 {
        let width = if a < 10.0 { 0.2 } else { 0.5 };
        for (x, w) in GAUSS_10 {
            let k = -std::f64::consts::PI * order + a + 0.5 * width * (1.0 + x);
            let d2 = dx2 + (2.0 * (0.5 * k).sin()).powi(2);
            if d2 > 1e-18 {
                let other = k + std::f64::consts::TAU * order;
                sum += 0.5 * width * w * 2.0 * bracket(k) * bracket(other) / (d2 * d2);
            }
        }
        a += width;
    }
    0.5 * sum / std::f64::consts::PI
}

/// Fourier transforms of the two roles of a kernel, tabulated once because the quadrature asks for them a million
/// times.
struct Transforms {
    normal: Vec<f64>,
    tangential: Vec<f64>,
}

impl Transforms {
    const STEP: f64 = 0.01;

    fn new<K: Kernel>(kernel: &K) -> Self {
        // |k_x| reaches CUT + LAST + one panel in any direction.
        let count = ((CUT + LAST + 2.0) / Self::STEP) as usize + 4;
        let tabulate = |role| (0..count).map(|i| kernel.transform(role, Self::STEP * i as f64)).collect();
        Self { normal: tabulate(Role::Normal), tangential: tabulate(Role::Tangential) }
    }

    /// Returns the cubic interpolation (error below 1e-8 at this step); the transforms are even.
    fn at(&self, role: Role, theta: f64) -> f64 {
        let table = match role {
            Role::Normal => &self.normal,
            Role::Tangential => &self.tangential,
        };
        let position = theta.abs() / Self::STEP;
        let i = position as usize;
        let Some(&[b, c, d]) = table.get(i..i + 3).and_then(|w| <&[f64; 3]>::try_from(w).ok()) else { return 0.0 };
        let a = table[if i == 0 { 1 } else { i - 1 }];
        let x = position - i as f64;
        let (m, n, o) = (x - 1.0, x - 2.0, x + 1.0);
        -a * x * m * n / 6.0 + 0.5 * b * o * m * n - 0.5 * c * o * x * n + d * o * x * m / 6.0
    }
}

#[cfg(test)]
mod tests;
