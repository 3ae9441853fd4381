//! Kernels of the velocity, the velocity gradient and the pressure of forces and dipoles, in complex form.
//!
//! With d = source minus target, the single layer of a force F is `w = -l F + 1/2 conj(F e_1)`, and the double layer
//! with velocity v on an element z' is `i v z' c_1 + i conj((v conj z' - conj v z') c_1 - v z' e_2)`; in free space
//! `l = ln|d| - 1/2`, `c_k = 1/d^k`, `e_k = conj(d)/d^k`.

use std::f64::consts::PI;

use num_complex::Complex64;

use motile_base::Region;

const I: Complex64 = Complex64::new(0.0, 1.0);
const ZERO: Complex64 = Complex64::new(0.0, 0.0);

/// Functions of d = source minus target that make up the flow at the target.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Kernels {
    /// l.
    pub(crate) log: f64,
    /// c_1, c_2, c_3.
    pub(crate) c: [Complex64; 3],
    /// e_1, e_2, e_3.
    pub(crate) e: [Complex64; 3],
    /// Minus the derivative of c_1 by conj(d): pi/area in a periodic box.
    pub(crate) background: f64,
}

/// Flow at a point times 4 pi and viscosity, as complex numbers.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Flow {
    /// u + i v.
    pub(crate) velocity: Complex64,
    /// Derivative of u + i v by z.
    pub(crate) spin: Complex64,
    /// Derivative of u + i v by conj(z).
    pub(crate) strain: Complex64,
    /// Pressure times 4 pi (force per length in 2D).
    pub(crate) pressure: f64,
}

impl std::ops::AddAssign for Flow {
    fn add_assign(&mut self, other: Self) {
        self.velocity += other.velocity;
        self.spin += other.spin;
        self.strain += other.strain;
        self.pressure += other.pressure;
    }
}

impl Flow {
    /// Returns the velocity gradient `[[du/dx, du/dy], [dv/dx, dv/dy]]`.
    pub(crate) fn gradient(&self) -> [[f64; 2]; 2] {
        let (along, across) = (self.spin + self.strain, I * (self.spin - self.strain));
        [[along.re, across.re], [along.im, across.im]]
    }

    /// Adds `sign` times the flow of a force.
    pub(crate) fn add_force(&mut self, k: &Kernels, force: Complex64, sign: f64) {
        let force = force * sign;
        self.velocity += 0.5 * (force * k.e[0]).conj() - force * k.log;
        let pull = force * k.c[0];
        self.spin += I * pull.im;
        self.strain += 0.5 * (force.conj() * k.c[0] + force * k.e[1]).conj();
        self.pressure -= 2.0 * pull.re;
    }

    /// Adds `sign` times the flow of a double layer with this velocity on the element `tangent`, which carries contrast
    /// and weight.
    pub(crate) fn add_dipole(&mut self, k: &Kernels, velocity: Complex64, tangent: Complex64, sign: f64) {
        let velocity = velocity * sign;
        let flux = velocity * tangent.conj();
        self.add_products(k, velocity * tangent, flux - flux.conj());
    }

    /// Adds the flow of the product of velocity and element of a double layer, and of `flux`, the product of the
    /// velocity with the conjugate of the element, less its own conjugate.
    pub(crate) fn add_products(&mut self, k: &Kernels, product: Complex64, flux: Complex64) {
        self.velocity -= I * product * k.c[0] + I * (flux * k.c[0] - product * k.e[1]).conj();
        let turn = product * k.c[1];
        self.spin -= 2.0 * I * turn.re;
        self.strain -= I * product * k.background + I * (flux * k.c[1] - 2.0 * product * k.e[2]).conj();
        self.pressure -= 4.0 * turn.im;
    }
}

/// Green's function of the plane or of periodic images; for a channel it is a row of images and the correction by the
/// walls ([`crate::greens::walls`]).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum GreensFunction {
    /// The plane.
    Free,
    /// A row of images along x with wave number k = 2 pi/period.
    Row { k: f64 },
    /// All images of a periodic box, in rows along the shorter period, or along x where they are displaced: the next
    /// row by a phase whose exponential is `turn`.
    Lattice { k: f64, across: f64, rows: usize, transposed: bool, turn: Complex64 },
}

impl GreensFunction {
    /// Creates the Green's function of a region without its walls, images above being displaced by `tilt` along x
    /// (length), with as many rows of images as bring the rest below `tolerance`.
    pub(crate) fn new(region: &Region, tilt: f64, tolerance: f64) -> Self {
        match *region {
            Region::Channel { length, .. } => Self::Row { k: 2.0 * PI / length },
            Region::Box { lengths } => {
                let transposed = lengths[1] < lengths[0] && tilt == 0.0;
                let [along, across] = if transposed { [lengths[1], lengths[0]] } else { lengths };
                let k = 2.0 * PI / along;
                let rows = ((-tolerance.ln() / k + 0.5 * along) / across + 0.5).ceil() as usize;
                Self::Lattice { k, across, rows, transposed, turn: Complex64::cis(k * tilt) }
            }
            _ => Self::Free,
        }
    }

    /// Kernels of all images, d (length) being the shortest of the equivalent distances.
    pub(crate) fn at(&self, d: Complex64) -> Kernels {
        self.evaluate(d, false)
    }

    /// Kernels of all images but the one at d itself: `at(d)` minus [`free`] of d, without the loss of digits close to
    /// d = 0.
    pub(crate) fn without_nearest(&self, d: Complex64) -> Kernels {
        self.evaluate(d, true)
    }

    fn evaluate(&self, d: Complex64, regular: bool) -> Kernels {
        match *self {
            Self::Free if regular => Kernels { log: 0.0, c: [ZERO; 3], e: [ZERO; 3], background: 0.0 },
            Self::Free => free(d),
            Self::Row { k } => {
                let (log, c) = singular_row(d, k, &HalfAngle::new(d * (0.5 * k)), regular);
                row_weighted(log, c, d.im, if regular { 0.0 } else { 1.0 })
            }
            Self::Lattice { transposed: false, .. } => self.lattice::<3>(d, regular),
            Self::Lattice { transposed: true, .. } => {
                // Reflection at the diagonal, d' = i conj(d).
                let Kernels { log, c, e, background } = self.lattice::<3>(I * d.conj(), regular);
                Kernels {
                    log,
                    c: [-I * c[0].conj(), -c[1].conj(), I * c[2].conj()],
                    e: [-e[0].conj(), I * e[1].conj(), e[2].conj()],
                    background,
                }
            }
        }
    }

    /// Returns `l` and `e_1`, which make up the velocity of a force.
    pub(crate) fn stokeslet(&self, d: Complex64) -> (f64, Complex64) {
        let kernels = match *self {
            Self::Lattice { transposed: false, .. } => self.lattice::<1>(d, false),
            Self::Lattice { transposed: true, .. } => {
                let Kernels { log, e, .. } = self.lattice::<1>(I * d.conj(), false);
                return (log, -e[0].conj());
            }
            _ => self.at(d),
        };
        (kernels.log, kernels.e[0])
    }

    /// Kernels of rows along x, the first N functions of each family.
    #[inline(always)]
    fn lattice<const N: usize>(&self, d: Complex64, regular: bool) -> Kernels {
        let Self::Lattice { k, across, rows, turn: along, .. } = *self else { return free(d) };
        let half = HalfAngle::new(d * (0.5 * k));
        let (mut log, mut c) = singular_row(d, k, &half, regular);
        let mut moments = c.map(|c| c * d.im);
        let [turn, back] = half.turns();
        let decay = (-k * across).exp();
        let (mut product, mut shrink, mut height) = (1.0, Complex64::ONE, 0.0);
        let decay = along * decay;
        for _ in 0..rows {
            shrink *= decay;
            height += across;
            for (q, y, side) in [(turn * shrink, d.im + height, 1.0), (back * shrink, d.im - height, -1.0)] {
                let gap = 1.0 - q;
                let inverse = 1.0 / gap.norm_sqr();
                product *= inverse;
                let rest = gap.conj() * inverse;
                // q/(1 - q).
                let factor = (q - q.norm_sqr()) * inverse;
                let first = Complex64::new(side * k * factor.im, -side * k * factor.re);
                let second = -k * k * factor * rest;
                let third = I * (0.5 * side * k * k * k) * factor * rest * rest * (1.0 + q);
                for (index, term) in [first, second, third].into_iter().enumerate().take(N) {
                    c[index] += term;
                    moments[index] += term * y;
                }
            }
        }
        log -= 0.5 * ln(product);
        let mean = k * (d.im * d.im / across + across / 6.0);
        let background = 0.5 * k / across;
        c[0] += I * (k * d.im / across);
        c[1] -= background;
        let two = 2.0 * I;
        let one = if regular { 1.0 } else { 0.0 };
        let e = [mean - one - two * moments[0], c[0] - two * moments[1], c[1] + 0.5 * background - two * moments[2]];
        Kernels { log: log - 0.5 * (mean - one), c, e, background }
    }
}

/// Kernels of free space.
pub(crate) fn free(d: Complex64) -> Kernels {
    let inverse = d.inv();
    let c = [inverse, inverse * inverse, inverse * inverse * inverse];
    weighted(0.5 * ln(d.norm_sqr()) - 0.5, c, d.conj())
}

/// Kernels of free space from values that replace ln|d| - 1/2 and 1/d^k.
fn weighted(log: f64, c: [Complex64; 3], conjugate: Complex64) -> Kernels {
    Kernels { log, c, e: c.map(|c| c * conjugate), background: 0.0 }
}

/// exp(i k z/2) and its inverse, whose products make up the circular functions of differences.
pub(crate) fn half_turns(z: Complex64, k: f64) -> [Complex64; 2] {
    let turn = (0.5 * k * I * z).exp();
    [turn, turn.inv()]
}

/// Kernels of a row of images from values that replace its singular functions: conj(d) is d - 2 i dy, and the sum over
/// images of 1/d^k a derivative of the cotangent. `own` is 1 with the image at d and 0 without.
fn row_weighted(log: f64, c: [Complex64; 3], dy: f64, own: f64) -> Kernels {
    let y = Complex64::new(0.0, -2.0 * dy);
    Kernels { log: log - 0.5 * own, c, e: [own + y * c[0], c[0] + y * c[1], c[1] + y * c[2]], background: 0.0 }
}

/// Circular functions of a complex number x.
struct HalfAngle {
    x: Complex64,
    sin: Complex64,
    cos: Complex64,
    /// exp(i x.re), exp(x.im) and exp(-x.im).
    circle: Complex64,
    up: f64,
    down: f64,
}

impl HalfAngle {
    fn new(x: Complex64) -> Self {
        let ((s, c), up) = (x.re.sin_cos(), x.im.exp());
        let down = 1.0 / up;
        // Cancellation close to zero.
        let sh = if x.im.abs() < 0.5 { x.im.sinh() } else { 0.5 * (up - down) };
        let ch = 0.5 * (up + down);
        let (sin, cos) = (Complex64::new(s * ch, c * sh), Complex64::new(c * ch, -s * sh));
        Self { x, sin, cos, circle: Complex64::new(c, s), up, down }
    }

    /// exp(2 i x) and exp(-2 i x).
    fn turns(&self) -> [Complex64; 2] {
        let turn = self.circle * self.circle;
        [turn * (self.down * self.down), turn.conj() * (self.up * self.up)]
    }
}

/// Returns `ln|2 sin(k d/2)|` and the sums over a row of 1/d^k; where `regular`, less the functions of the image at d.
fn singular_row(d: Complex64, k: f64, half: &HalfAngle, regular: bool) -> (f64, [Complex64; 3]) {
    if regular && half.x.norm_sqr() < 0.25 {
        return near_row(half.x, k);
    }
    let (log, c) = singular_of(k, half.sin, half.cos);
    if regular {
        let own = free(d);
        (log - own.log - 0.5, [c[0] - own.c[0], c[1] - own.c[1], c[2] - own.c[2]])
    } else {
        (log, c)
    }
}

/// Returns the singular functions of a row from the sine and cosine of k d/2.
fn singular_of(k: f64, sin: Complex64, cos: Complex64) -> (f64, [Complex64; 3]) {
    let cosecant = 0.5 * k * sin.inv();
    let first = cosecant * cos;
    (0.5 * ln(4.0 * sin.norm_sqr()), [first, cosecant * cosecant, cosecant * cosecant * first])
}

/// Returns the regular functions of a row for small x = k d/2, by the Laurent series `cot x = 1/x - sum a_n x^(2n -
/// 1)`, a_n = 2 zeta(2n)/pi^(2n).
fn near_row(x: Complex64, k: f64) -> (f64, [Complex64; 3]) {
    const SERIES: [f64; 11] = [
        1.0 / 3.0,
        1.0 / 45.0,
        2.0 / 945.0,
        1.0 / 4725.0,
        2.0 / 93_555.0,
        1_382.0 / 638_512_875.0,
        4.0 / 18_243_225.0,
        3_617.0 / 162_820_783_125.0,
        87_734.0 / 38_979_295_480_125.0,
        349_222.0 / 1_531_329_465_290_625.0,
        310_732.0 / 13_447_856_940_643_125.0,
    ];
    let (half, square) = (0.5 * k, x * x);
    let (mut log, mut first, mut second, mut third) = (ZERO, ZERO, ZERO, ZERO);
    let mut power = Complex64::new(1.0, 0.0);
    for (index, a) in SERIES.iter().enumerate() {
        let order = 2.0 * index as f64 + 1.0;
        // power is x^(order - 1).
        log -= power * (a / (order + 1.0));
        first -= power * *a;
        second += power * (a * order);
        if index + 1 < SERIES.len() {
            third -= power * (0.5 * SERIES[index + 1] * (order + 2.0) * (order + 1.0));
        }
        power *= square;
    }
    let c = [first * x * half, second * (half * half), third * x * (half * half * half)];
    (k.ln() + (log * square).re, c)
}

// Bit patterns of sqrt(1/2), 1 and 2^52, and the mask of a mantissa.
const HALF_ROOT: u64 = 0x3FE6_A09E_667F_3BCD;
const ONE: u64 = 0x3FF0_0000_0000_0000;
const TWO_52: u64 = 0x4330_0000_0000_0000;
const MANTISSA: u64 = 0x000F_FFFF_FFFF_FFFF;
// ln 2 to 33 bits, so that its product with an exponent is exact, and the rest.
const LN2_HIGH: f64 = 6.931_471_803_691_238e-1;
const LN2_LOW: f64 = 1.908_214_929_270_587_7e-10;

/// Returns the natural logarithm of a positive normal number to about 1e-16 of max(1, |ln x|); anything else gives a
/// meaningless number.
///
/// x = 2^e m with m between sqrt(1/2) and sqrt(2), and ln m = 2 artanh s with s = (m - 1)/(m + 1), |s| < 0.1716, by its
/// Taylor series. No branch and no table, so a loop over it runs in vector registers, which the library function's does
/// not.
#[inline(always)]
pub(crate) fn ln(x: f64) -> f64 {
    let shifted = x.to_bits().wrapping_add(ONE - HALF_ROOT);
    // Put into the low bits of 2^52, the exponent becomes a float.
    let exponent = f64::from_bits(TWO_52 | (shifted >> 52)) - (4_503_599_627_370_496.0 + 1023.0);
    let mantissa = f64::from_bits((shifted & MANTISSA) + HALF_ROOT);
    let s = (mantissa - 1.0) / (mantissa + 1.0);
    let z = s * s;
    let z2 = z * z;
    let z4 = z2 * z2;
    let low = (2.0 / 3.0 + z * (2.0 / 5.0)) + z2 * (2.0 / 7.0 + z * (2.0 / 9.0));
    let high = (2.0 / 11.0 + z * (2.0 / 13.0)) + z2 * (2.0 / 15.0 + z * (2.0 / 17.0));
    let series = z * (low + z4 * high + z4 * z4 * (2.0 / 19.0 + z * (2.0 / 21.0)));
    exponent * LN2_HIGH + (s * (2.0 + series) + exponent * LN2_LOW)
}

#[cfg(test)]
mod tests;
