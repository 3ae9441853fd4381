//! Stokes flow of rings: the kernels of the single and the double layer, integrated over the azimuth.

use std::f64::consts::{PI, TAU};

use motile_base::Vec2;

/// Polynomial of the first degree in w = 1 - cos(phi), lowest power first, as all polynomials are.
type Linear = [f64; 2];

/// Product r r0 over the mean square of the distance below which the azimuthal integrals are sums over points.
const NEAR_AXIS: f64 = 0.18;
/// Points of these sums in a turn, exact to round-off below that bound.
const POINTS: usize = 16;

/// Layers that a ring is wanted for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Wanted {
    /// The single layer.
    Single,
    /// Both, or the single layer with its gradient.
    Both,
    /// Both with their gradients.
    Gradients,
}

/// Azimuthal integrals of a ring of source points and a target in the meridian plane, whose coordinates are the
/// distance x along the axis and r from it.
///
/// With the vector from the target to the source, `|x|^2 = dx^2 + dr^2 + 2 r r0 w`, `w = 1 - cos(phi)`, the moment n of
/// order p is the integral of `w^n/|x|^p` over phi from 0 to 2 pi. Moments are combinations of the complete elliptic
/// integrals with the complementary parameter `1 - m = |d|^2/(dx^2 + (r + r0)^2)`, which loses no digits where the ring
/// passes the target closely. Near the axis these combinations cancel, and the trapezoidal rule converges at once.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ring {
    /// Source less target along and from the axis (length).
    d: Vec2,
    /// Distances of target and source from the axis (length).
    target: f64,
    source: f64,
    /// Moments 0 to 4 of the orders 1, 3, 5, 7, as far as they were asked for.
    moments: [[f64; 5]; 4],
}

/// Returns the complete elliptic integrals (K, K - E) of the complementary parameter `1 - m`, by the
/// arithmetic-geometric mean (Abramowitz and Stegun, Handbook of Mathematical Functions, section 17.6).
pub(super) fn elliptic(complement: f64) -> (f64, f64) {
    let (mut a, mut b) = (1.0, complement.sqrt());
    let (mut sum, mut power) = (0.5 * (1.0 - complement), 1.0);
    loop {
        let c: f64 = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        sum += power * c * c;
        power *= 2.0;
        // The mean converges quadratically, so that the next difference is below round-off.
        if c.abs() < 1e-8 * a {
            break;
        }
    }
    let c = 0.5 * (a - b);
    a = 0.5 * (a + b);
    sum += power * c * c;
    let k = 0.5 * PI / a;
    (k, k * sum)
}

impl Ring {
    /// Creates the ring of a source at the difference `d` from a target (length), with the moments of the orders 1 and
    /// 3, to 5 for double layers, to 7 for gradients.
    pub(super) fn new(d: Vec2, target: f64, source: f64, wanted: Wanted) -> Self {
        let distance = d.length_squared();
        let product = 2.0 * target * source;
        let mean = distance + product;
        let moments = if product < NEAR_AXIS * mean {
            match wanted {
                Wanted::Single => summed::<2, 3>(distance, product),
                Wanted::Both => summed::<3, 4>(distance, product),
                Wanted::Gradients => summed::<4, 5>(distance, product),
            }
        } else {
            elliptic_moments(distance, product, wanted)
        };
        Self { d, target, source, moments }
    }

    /// Returns the source less target along and from the axis (length).
    pub(super) fn offset(&self) -> Vec2 {
        self.d
    }

    /// Returns the integral of a polynomial in w over `|x|^p`.
    fn integral<const N: usize>(&self, order: usize, polynomial: [f64; N]) -> f64 {
        polynomial.iter().zip(&self.moments[order / 2]).map(|(c, moment)| c * moment).sum()
    }

    /// Returns the single layer. It is the velocity times 8 pi eta of unit forces on the ring, `[[xx, xr], [rx, rr]]`,
    /// the velocity's component first.
    pub(super) fn single(&self) -> [[f64; 2]; 2] {
        let Self { d: Vec2 { x, y: r }, target, source, moments: [v, t, ..] } = *self;
        [
            [v[0] + x * x * t[0], x * (r * t[0] + target * t[1])],
            [
                x * (r * t[0] - source * t[1]),
                v[0] - v[1] + r * r * t[0] + (target - source) * r * t[1] - source * target * t[2],
            ],
        ]
    }

    /// Returns the double layer `-6 (x.q)(x.n) x_j/|x|^5` of unit velocities q on a ring with the outward normal n (of
    /// any length): `[[xx, xr], [rx, rr]]`, the component j first.
    pub(super) fn double(&self, normal: Vec2) -> [[f64; 2]; 2] {
        let Self { d: Vec2 { x, y: r }, target, source, moments: [_, _, s, _] } = *self;
        // x.n = a + b w, x.e_r = r + target w, and the component of x from the axis is r - source w.
        let (a, b) = (r * normal.y + x * normal.x, target * normal.y);
        let xx = a * s[0] + b * s[1];
        let [n0, n1, n2] = [a * r, a * target + b * r, b * target];
        let xr = n0 * s[0] + n1 * s[1] + n2 * s[2];
        let rx = a * r * s[0] + (b * r - a * source) * s[1] - b * source * s[2];
        let rr = n0 * r * s[0] + (n1 * r - n0 * source) * s[1] + (n2 * r - n1 * source) * s[2] - n2 * source * s[3];
        [[-6.0 * x * x * xx, -6.0 * x * xr], [-6.0 * x * rx, -6.0 * rr]]
    }

    /// Returns the velocity, pressure and gradient of the single layer of forces on the ring: velocity and gradient
    /// times 8 pi eta, pressure times 8 pi. The gradient is `[[dux/dx, dux/dr], [dur/dx, dur/dr]]`.
    pub(super) fn single_flow(&self, force: Vec2) -> ([f64; 2], f64, [[f64; 2]; 2]) {
        let [[xx, xr], [rx, rr]] = self.single();
        let velocity = [xx * force.x + xr * force.y, rx * force.x + rr * force.y];
        let (pull, slopes, place) = self.factors(force);
        let pressure = -2.0 * self.integral(3, pull);
        // Unit of force along the component of velocity: force.x along x, force.y cos(phi) from the axis.
        let own: [Linear; 2] = [[force.x, 0.0], [force.y, -force.y]];
        let gradient = [0, 1].map(|j| {
            [0, 1].map(|k| {
                let first: [f64; 3] = plus(times(own[j], place[k]), times(place[j], slopes[k]));
                let third: [f64; 4] = times(times::<2, 2, 3>(place[j], place[k]), pull);
                let own_slope = if j == k { 0.5 * pressure } else { 0.0 };
                self.integral(3, first) + own_slope + 3.0 * self.integral(5, third)
            })
        });
        (velocity, pressure, gradient)
    }

    /// Returns the velocity, pressure and gradient of the double layer of velocities on the ring with the outward
    /// normal n (of any length).
    pub(super) fn double_flow(&self, normal: Vec2, density: Vec2) -> ([f64; 2], f64, [[f64; 2]; 2]) {
        let [[xx, xr], [rx, rr]] = self.double(normal);
        let velocity = [xx * density.x + xr * density.y, rx * density.x + rr * density.y];
        let (q, q_slopes, place) = self.factors(density);
        let (n, n_slopes, _) = self.factors(normal);
        let both: [f64; 3] = times(q, n);
        let product = self.integral(5, both);
        let pressure = 12.0 * product - 4.0 * density.dot(normal) * self.moments[1][0];
        let gradient = [0, 1].map(|j| {
            [0, 1].map(|k| {
                let slope: [f64; 3] = plus(times(q_slopes[k], n), times(q, n_slopes[k]));
                let first: [f64; 4] = times(slope, place[j]);
                let second: [f64; 5] = times(times::<3, 2, 4>(both, place[j]), place[k]);
                let own_slope = if j == k { product } else { 0.0 };
                -6.0 * (self.integral(5, first) - own_slope) - 30.0 * self.integral(7, second)
            })
        });
        (velocity, pressure, gradient)
    }

    /// Polynomials of `x.a` for a vector a of the ring and its slopes by the place of the target along and from the
    /// axis, and of the components of x, whose own slopes are -1.
    fn factors(&self, a: Vec2) -> (Linear, [Linear; 2], [Linear; 2]) {
        let Self { d: Vec2 { x, y: r }, target, source, .. } = *self;
        let slopes = [[-a.x, 0.0], [-a.y, a.y]];
        ([a.x * x + a.y * r, a.y * target], slopes, [[x, 0.0], [r, -source]])
    }
}

fn plus<const N: usize>(a: [f64; N], b: [f64; N]) -> [f64; N] {
    std::array::from_fn(|n| a[n] + b[n])
}

/// Returns the product of two polynomials, of N = A + B - 1 coefficients.
#[inline(always)]
fn times<const A: usize, const B: usize, const N: usize>(a: [f64; A], b: [f64; B]) -> [f64; N] {
    let mut product = [0.0; N];
    for i in 0..A {
        for j in 0..B {
            product[i + j] += a[i] * b[j];
        }
    }
    product
}

/// Returns the moments by elliptic integrals, `distance` the square of the vector d and `product` 2 r r0.
fn elliptic_moments(distance: f64, product: f64, wanted: Wanted) -> [[f64; 5]; 4] {
    let (mean, largest) = (distance + product, distance + 2.0 * product);
    let root = largest.sqrt();
    let complement = distance / largest;
    let (k, difference) = elliptic(complement);
    let e = k - difference;
    let (first, inverse) = (4.0 * k / root, 1.0 / product);
    let mut moments = [[0.0; 5]; 4];
    let [v, t, s, u] = &mut moments;
    v[0] = first;
    v[1] = 4.0 * root * (e - complement * k) * inverse;
    t[0] = 4.0 * e / (root * distance);
    t[1] = 4.0 * difference / root * inverse;
    t[2] = (v[1] - distance * t[1]) * inverse;
    if wanted == Wanted::Single {
        return moments;
    }
    // distance times the moment 0 of order 5, from the recurrence in the order.
    let scaled = (2.0 * mean * t[0] - 0.5 * first) / (1.5 * largest);
    s[0] = scaled / distance;
    s[1] = (t[0] - scaled) * inverse;
    for n in 2..4 {
        s[n] = (t[n - 1] - distance * s[n - 1]) * inverse;
    }
    if wanted == Wanted::Gradients {
        let scaled = (4.0 * mean * s[0] - 1.5 * t[0]) / (2.5 * largest);
        u[0] = scaled / distance;
        u[1] = (s[0] - scaled) * inverse;
        for n in 2..5 {
            u[n] = (s[n - 1] - distance * u[n - 1]) * inverse;
        }
    }
    moments
}

/// So many moments of so many orders by the trapezoidal rule.
fn summed<const ORDERS: usize, const POWERS: usize>(distance: f64, product: f64) -> [[f64; 5]; 4] {
    /// w at the points of half a turn.
    const W: [f64; POINTS / 2 + 1] = [
        0.0,
        0.076_120_467_488_713_25,
        0.292_893_218_813_452_5,
        0.617_316_567_634_910_2,
        1.0,
        1.382_683_432_365_09,
        1.707_106_781_186_547_5,
        1.923_879_532_511_286_8,
        2.0,
    ];
    let mut moments = [[0.0; 5]; 4];
    for (j, w) in W.into_iter().enumerate() {
        let square = 1.0 / (distance + product * w);
        let weight = if j == 0 || j == POINTS / 2 { 1.0 } else { 2.0 };
        let mut value = weight * TAU / POINTS as f64 * square.sqrt();
        for moments in &mut moments[..ORDERS] {
            let mut power = value;
            for moment in &mut moments[..POWERS] {
                *moment += power;
                power *= w;
            }
            value *= square;
        }
    }
    moments
}

#[cfg(test)]
mod tests;
