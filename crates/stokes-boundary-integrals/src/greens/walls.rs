//! Correction that two no-slip walls add to the flow of forces and dipoles that are periodic along them.
//!
//! The correction is a Fourier series in x with modes `exp(-k s)`, s the distance from a wall, so that sources and
//! targets enter by products and the cost is (nodes) x (modes). The number of modes grows like the inverse of the gaps
//! to the walls.

use std::f64::consts::TAU;

use motile_base::internal::widely;
use num_complex::Complex64;

use crate::shares;

mod flow;
mod points;
mod slip;

pub(crate) use points::WallPoints;
use points::{LANES, Lanes};
pub(crate) use slip::Slipping;

/// Largest number of modes, whose memory is about 100 MB: at a tolerance of 1e-8 they resolve gaps down to 1/160,000 of
/// the period.
const MOST_MODES: usize = 1 << 18;

/// Sums over sources for some modes, real and imaginary parts: of e q (`plain`) and of e (p - k s q) (`mixed`), with
/// e = exp(-k s - i k x), q complex and p real.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    plain: [Lanes; 2],
    mixed: [Lanes; 2],
}

impl Sums {
    /// Both sums of one mode.
    fn of(sums: &[Self], n: usize) -> [Complex64; 2] {
        let (sum, lane) = (&sums[n / LANES], n % LANES);
        [sum.plain, sum.mixed].map(|[re, im]| Complex64::new(re[lane], im[lane]))
    }
}

/// Velocity of the sources at a wall without the correction, one mode.
#[derive(Debug, Clone, Copy, Default)]
struct Slip {
    u: Complex64,
    v: Complex64,
}

impl Slip {
    /// Returns the velocity at a distance from a wall, times the wave number, of the flow that cancels this one at the
    /// wall; `side` is 1 above the lower wall and -1 below the upper one.
    fn image(&self, distance: f64, side: f64) -> Self {
        let turn = I * side;
        let bend = (self.u + turn * self.v) * distance;
        let decay = (-distance).exp();
        Self { u: (bend - self.u) * decay, v: (turn * bend - self.v) * decay }
    }
}

/// Coefficients of some modes near one wall: the streamfunction is `exp(-k s + i k x) (R - s B)`.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Coefficients {
    /// k R + B.
    sum: [Lanes; 2],
    /// k R.
    pub(crate) plain: [Lanes; 2],
    /// k B.
    pub(crate) linear: [Lanes; 2],
}

/// Factors of one mode in the even and the odd part of the streamfunction, which depend on the width alone.
#[derive(Debug, Clone, Copy)]
struct Factors {
    even: [f64; 4],
    odd: [f64; 4],
}

/// The flow that the walls correct: the flow of rows of images along the walls. It stands alone, or with the images in
/// each wall that correct it there. In a box, it is repeated `reach` (length) above the upper wall and below the lower
/// one, at a period of that much more than the width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Uncorrected {
    Row,
    Images,
    Box { reach: f64 },
}

/// The correction by the walls as a Fourier series, with the flow that does not depend on x.
#[derive(Debug, Clone)]
pub(crate) struct WallModes {
    /// 2 pi / period (1/length).
    pub(crate) k: f64,
    /// Half the distance between the walls (length).
    pub(crate) half: f64,
    /// True if the correction makes the flux zero instead of the mean pressure gradient.
    zero_flux: bool,
    /// Exponent of the decay beyond which modes are left out.
    exponent: f64,
    /// Minimum distance of a source from a wall (length).
    source_gap: f64,
    factors: Vec<Factors>,
    sums: [Vec<Sums>; 2],
    slips: [Vec<Slip>; 2],
    pub(crate) coefficients: [Vec<Coefficients>; 2],
    /// Coefficients of 1, y and half^2 - y^2 in the x velocity that does not depend on x.
    pub(crate) mean: [f64; 3],
    /// y velocity that does not depend on the place.
    pub(crate) rise: f64,
    uncorrected: Uncorrected,
    modes: usize,
    /// Walls along which fluid slips; `None` for no slip at both.
    slipping: Option<Slipping>,
}

impl WallModes {
    /// Creates the walls of a channel with this period and this half of its width (length).
    pub(crate) fn new(period: f64, half: f64, zero_flux: bool) -> Self {
        let (factors, sums, slips, coefficients, mean) = Default::default();
        let (exponent, source_gap, rise, modes, uncorrected) = (0.0, 0.0, 0.0, 0, Uncorrected::Row);
        let k = TAU / period;
        Self {
            k,
            half,
            zero_flux,
            exponent,
            source_gap,
            factors,
            sums,
            slips,
            coefficients,
            mean,
            rise,
            uncorrected,
            modes,
            slipping: None,
        }
    }

    /// Lets fluid slip along the walls.
    pub(crate) fn with_slip(self, slipping: Option<Slipping>) -> Self {
        Self { slipping, ..self }
    }

    /// Removes all sources and counts the modes for targets no closer to a wall than `target_gap` and sources no closer
    /// than `source_gap` (length).
    pub(crate) fn begin(&mut self, uncorrected: Uncorrected, source_gap: f64, target_gap: f64, accuracy: f64) {
        self.uncorrected = uncorrected;
        self.exponent = 2.5 - accuracy.ln();
        self.source_gap = source_gap;
        self.modes = self.count(source_gap + target_gap);
        let chunks = self.modes.div_ceil(LANES);
        while self.slipping.is_none() && self.factors.len() < chunks * LANES {
            let n = self.factors.len() + 1;
            self.factors.push(factors(self.k * n as f64, self.half));
        }
        for slips in &mut self.slips {
            slips.clear();
            slips.resize(chunks * LANES, Slip::default());
        }
        self.mean = [0.0; 3];
        self.rise = 0.0;
    }

    /// Both sums of a mode and wall, of e q and e (p - k s q), for the uncorrected flow, then those that the other wall
    /// adds to it. Its images are farther away by the reach, and all are repeated at distances of the box.
    fn sums_of(&self, side: usize, n: usize) -> [[Complex64; 2]; 2] {
        let own = Sums::of(&self.sums[side], n);
        let Uncorrected::Box { reach } = self.uncorrected else { return [own, [Complex64::default(); 2]] };
        let k = self.k * (n + 1) as f64;
        let height = k * (2.0 * self.half + reach);
        let moved = |[plain, mixed]: [Complex64; 2], by: f64| {
            let decay = (-by).exp();
            [plain * decay, (mixed - plain * by) * decay]
        };
        let repeated = |[plain, mixed]: [Complex64; 2]| {
            let decay = (-height).exp();
            let all = 1.0 / (1.0 - decay);
            [plain * all, (mixed - plain * (height * decay * all)) * all]
        };
        [repeated(own), repeated(moved(Sums::of(&self.sums[1 - side], n), k * reach))]
    }

    /// Returns the number of modes at this distance of source and target by way of a wall (length).
    fn count(&self, distance: f64) -> usize {
        let needed = self.exponent / (self.k * distance.max(1e-300));
        (needed.min(MOST_MODES as f64).ceil() as usize).max(1)
    }

    /// Returns the number of modes of the present sums.
    #[cfg(test)]
    pub(crate) fn count_now(&self) -> usize {
        self.modes
    }

    /// Computes the sums over points with `source(j)` = (q, p); the lower wall takes the conjugate of q.
    fn moments(&mut self, points: &WallPoints, target_gap: f64, source: impl Fn(usize) -> (Complex64, f64) + Sync) {
        let (k, exponent, modes) = (self.k, self.exponent, self.modes);
        let sides = points.sides.iter().zip(&mut self.sums).zip([1.0, -1.0]);
        shares::each_of(points.y.len(), sides, |((side, sums), sign)| {
            sums.clear();
            sums.resize(modes.div_ceil(LANES), Sums::default());
            for (j, powers) in side.iter().enumerate() {
                let needed = exponent / (k * (powers.distance + target_gap).max(1e-300));
                let chunks = (needed.min(modes as f64) as usize / LANES + 1).min(sums.len());
                let (q, p) = source(j);
                if p == 0.0 && q == Complex64::default() {
                    continue;
                }
                let (q_re, q_im) = (q.re, *sign * q.im);
                let mut powers = *powers;
                let first = k * powers.distance;
                let mut depth: Lanes = std::array::from_fn(|lane| first * (lane + 1) as f64);
                widely(
                    #[inline(always)]
                    || {
                        for sum in &mut sums[..chunks] {
                            let Sums { plain: [a_re, a_im], mixed: [b_re, b_im] } = sum;
                            for lane in 0..LANES {
                                // The phase of a source is the conjugate of that of a target.
                                let (re, im) = (powers.re[lane], -powers.im[lane]);
                                let (c_re, c_im) = (p - depth[lane] * q_re, -depth[lane] * q_im);
                                a_re[lane] += re * q_re - im * q_im;
                                a_im[lane] += re * q_im + im * q_re;
                                b_re[lane] += re * c_re - im * c_im;
                                b_im[lane] += re * c_im + im * c_re;
                                depth[lane] += first * LANES as f64;
                            }
                            powers.advance();
                        }
                    },
                );
            }
        });
    }

    /// Adds forces (times weight) at points as sources; `target_gap` as in [`WallModes::begin`].
    pub(crate) fn add_forces(
        &mut self,
        points: &WallPoints,
        target_gap: f64,
        forces: impl Fn(usize) -> Complex64 + Sync,
    ) {
        self.moments(points, target_gap, |j| (forces(j), forces(j).re));
        self.add_slips(|[plain, mixed], side, mode| {
            let inverse = 1.0 / mode;
            [mixed * inverse, I * (mixed - plain) * (side * inverse)]
        });
        let (c, h) = (self.k, self.half);
        let [mut s0, mut s1, mut s2] = [0.0; 3];
        for (j, y) in points.y.iter().enumerate() {
            let fx = forces(j).re;
            s0 += fx;
            s1 += y * fx;
            s2 += (h * h - y * y) * fx;
        }
        match &self.slipping {
            None => {
                self.mean[0] += (c * h - 1.0) * s0;
                self.mean[1] -= c / h * s1;
            }
            Some(slipping) => {
                let [along, slope] = slipping.between([s0, s1]);
                self.mean[0] += c * along - s0;
                self.mean[1] += c * slope;
            }
        }
        if self.uncorrected == Uncorrected::Images {
            // The means over x of the images, -1 + c times the distance.
            self.mean[0] += (2.0 - 4.0 * c * h) * s0;
        }
        if let Uncorrected::Box { reach } = self.uncorrected {
            // The mean over x of a row, 1 - c |y|, less that of the box, c (H/6 - |y| + y^2/H).
            let height = 2.0 * h + reach;
            let bend = c / height;
            self.mean[0] += (1.0 - c * height / 6.0) * s0 - bend * (2.0 * h * h * s0 - s2);
            self.mean[1] += 2.0 * bend * s1;
            self.mean[2] += bend * s0;
        }
        if self.zero_flux {
            match &self.slipping {
                None => self.mean[2] -= 0.75 * c / (h * h * h) * s2,
                Some(slipping) => slipping.take_flux(c * (s2 + slipping.moment([s0, s1])), &mut self.mean),
            }
        }
    }

    /// Adds dipoles (v_x n_x, v_x n_y + v_y n_x, v_y n_y) times weight at points as sources; `x` has any origin, since
    /// the flux through a curve is zero.
    pub(crate) fn add_dipoles(
        &mut self,
        points: &WallPoints,
        target_gap: f64,
        dipoles: impl Fn(usize) -> [f64; 3] + Sync,
        x: impl Fn(usize) -> f64,
    ) {
        self.moments(points, target_gap, |j| {
            let [xx, mixed, yy] = dipoles(j);
            (Complex64::new(xx - yy, mixed), xx + yy)
        });
        let twice = 2.0 * self.k;
        self.add_slips(|[plain, mixed], side, _| [-I * (plain + mixed) * twice, mixed * (side * twice)]);
        let (c, h) = (self.k, self.half);
        let [mut shear, mut moment, mut lever, mut growth] = [0.0; 4];
        for (j, y) in points.y.iter().enumerate() {
            let [xx, mixed, yy] = dipoles(j);
            shear += mixed;
            lever += y * mixed;
            growth += y * (xx + yy);
            moment += y * mixed - x(j) * (xx + yy);
        }
        match &self.slipping {
            None => self.mean[1] -= c / h * shear,
            Some(slipping) => {
                let [along, slope] = slipping.between([0.0, shear]);
                self.mean[0] += c * along;
                self.mean[1] += c * slope;
            }
        }
        if let Uncorrected::Box { reach } = self.uncorrected {
            // The mean over x of a row, c sign(y), less that of the box, c (sign(y) - 2 y/H).
            let slope = 2.0 * c / (2.0 * h + reach);
            self.mean[0] -= slope * lever;
            self.mean[1] += slope * shear;
            self.rise -= slope * growth;
        }
        if self.zero_flux {
            match &self.slipping {
                None => self.mean[2] += 1.5 * c / (h * h * h) * moment,
                Some(slipping) => {
                    slipping.take_flux(c * (slipping.moment([0.0, shear]) - 2.0 * moment), &mut self.mean);
                }
            }
        }
    }

    /// Adds the velocities at the walls, `slip(sums, side, mode)` being those by sums over sources on one side of it, 1
    /// for those below.
    fn add_slips(&mut self, slip: impl Fn([Complex64; 2], f64, f64) -> [Complex64; 2]) {
        let boxed = matches!(self.uncorrected, Uncorrected::Box { .. });
        for (wall, side) in [(0, 1.0), (1, -1.0)] {
            let length = self.slipping.as_ref().map_or(0.0, |slipping| slipping.lengths[wall]);
            for n in 0..self.modes {
                let [own, other] = self.sums_of(wall, n);
                let mode = (n + 1) as f64;
                let slips = &mut self.slips[wall][n];
                let [u, v] = slip(own, side, mode);
                slips.u += u;
                slips.v += v;
                if boxed {
                    let [u, v] = slip(other, -side, mode);
                    slips.u += u;
                    slips.v += v;
                }
                if length > 0.0 {
                    // The derivative outwards, along the distance from the sources on the own side of the wall.
                    let k = self.k * mode;
                    let slope = |[plain, mixed]: [Complex64; 2], side: f64| {
                        slip([plain * -k, (mixed + plain) * -k], side, mode)[0]
                    };
                    let mut outwards = slope(own, side);
                    if boxed {
                        outwards -= slope(other, -side);
                    }
                    self.slips[wall][n].u += outwards * length;
                }
            }
        }
    }

    /// Solves for the series that cancels the velocity of the sources at the walls, mode by mode.
    pub(crate) fn solve(&mut self) {
        let chunks = self.modes.div_ceil(LANES);
        for coefficients in &mut self.coefficients {
            coefficients.clear();
            coefficients.resize(chunks, Coefficients::default());
        }
        for n in 0..self.modes {
            let k = self.k * (n + 1) as f64;
            let mut slips = [self.slips[0][n], self.slips[1][n]];
            if self.uncorrected == Uncorrected::Images {
                // What the image in one wall leaves at the other one.
                slips = [slips[1].image(2.0 * k * self.half, 1.0), slips[0].image(2.0 * k * self.half, -1.0)];
            }
            let [upper, lower] = slips;
            let (psi_upper, psi_lower) = (-I * upper.v / k, -I * lower.v / k);
            let (slope_upper, slope_lower) = (-upper.u, -lower.u);
            let (pe, po) = (0.5 * (psi_upper + psi_lower), 0.5 * (psi_upper - psi_lower));
            let (qe, qo) = (0.5 * (slope_upper - slope_lower), 0.5 * (slope_upper + slope_lower));
            let [a, b, c, d] = match &self.slipping {
                Some(slipping) => slipping.solve(k, [pe, po], [qe, qo]),
                None => {
                    let Factors { even, odd } = self.factors[n];
                    let (a, b) = (pe * even[0] + qe * even[1], qe * even[2] - pe * even[3]);
                    let (c, d) = (po * odd[0] - qo * odd[1], qo * odd[2] - po * odd[3]);
                    [a, b, c, d]
                }
            };
            for (side, sign) in [(0, 0.5), (1, -0.5)] {
                let (r, b) = ((0.5 * a + sign * c) * k, 0.5 * b + sign * d);
                let slot = &mut self.coefficients[side][n / LANES];
                for (array, value) in [(&mut slot.sum, r + b), (&mut slot.plain, r), (&mut slot.linear, b * k)] {
                    (array[0][n % LANES], array[1][n % LANES]) = (value.re, value.im);
                }
            }
        }
    }

    /// Returns the coefficients near a wall that matter at this distance from it (length).
    fn coefficients(&self, side: usize, distance: f64) -> &[Coefficients] {
        let (all, needed) = (&self.coefficients[side], self.exponent / (self.k * (distance + self.source_gap)));
        &all[..(needed.min(self.modes as f64) as usize / LANES + 1).min(all.len())]
    }

    /// Computes the velocities of the correction at points.
    pub(crate) fn velocities(&self, points: &WallPoints, out: &mut Vec<[f64; 2]>) {
        out.resize(points.y.len(), [0.0; 2]);
        let len = shares::length(out.len());
        shares::each_of(out.len(), out.chunks_mut(len).enumerate(), |(piece, out)| {
            self.write_velocities(points, *piece * len, out);
        });
    }

    /// Writes the velocities at the points from one on.
    fn write_velocities(&self, points: &WallPoints, first: usize, out: &mut [[f64; 2]]) {
        for (i, out) in (first..).zip(out) {
            let (mut u, mut v) = (self.mean_velocity(points.y[i]), self.rise);
            for (side, sign) in [(0, 1.0), (1, -1.0)] {
                let mut powers = points.sides[side][i];
                let s = powers.distance;
                let coefficients = self.coefficients(side, s);
                let [sum, plain, linear_re, linear_im] = widely(
                    #[inline(always)]
                    || {
                        let [mut sum, mut plain, mut linear_re, mut linear_im] = [[0.0; LANES]; 4];
                        for c in coefficients {
                            for lane in 0..LANES {
                                let (re, im) = (powers.re[lane], powers.im[lane]);
                                sum[lane] += re * c.sum[0][lane] - im * c.sum[1][lane];
                                plain[lane] += re * c.plain[1][lane] + im * c.plain[0][lane];
                                linear_re[lane] += re * c.linear[0][lane] - im * c.linear[1][lane];
                                linear_im[lane] += re * c.linear[1][lane] + im * c.linear[0][lane];
                            }
                            powers.advance();
                        }
                        [sum, plain, linear_re, linear_im].map(|lanes| lanes.iter().sum::<f64>())
                    },
                );
                u += sign * (sum - s * linear_re);
                v += plain - s * linear_im;
            }
            *out = [u, v];
        }
    }

    /// x velocity of the correction that does not depend on x, at the height y (length).
    pub(crate) fn mean_velocity(&self, y: f64) -> f64 {
        self.mean[0] + self.mean[1] * y + self.mean[2] * (self.half * self.half - y * y)
    }
}

const I: Complex64 = Complex64::new(0.0, 1.0);

/// Returns the factors of one mode of the biharmonic equation between walls with given values and slopes of the
/// streamfunction, in even and odd parts, scaled by exp(-k half) to stay finite.
fn factors(k: f64, half: f64) -> Factors {
    let kh = k * half;
    let decay = (-2.0 * kh).exp();
    let (sinh, cosh) = (0.5 * (1.0 - decay), 0.5 * (1.0 + decay));
    let [even, odd] = determinants(kh);
    Factors {
        even: [sinh + kh * decay, half * decay, cosh, k * sinh].map(|value| value / even),
        odd: [cosh - kh * decay, half * decay, sinh, k * cosh].map(|value| value / odd),
    }
}

/// Returns `sinh(kh) cosh(kh) + kh` and the same minus kh, scaled by `exp(-2 kh)` (no dimension).
fn determinants(kh: f64) -> [f64; 2] {
    let decay = (-2.0 * kh).exp();
    let even = 0.25 * (1.0 - decay * decay) + kh * decay;
    let z = 2.0 * kh;
    let odd = if z < 0.5 {
        // (sinh z - z)/2 by its series, since the difference of the two cancels.
        let mut term = z * z * z / 6.0;
        let mut sum = term;
        for j in 2..12 {
            term *= z * z / f64::from(2 * j * (2 * j + 1));
            sum += term;
        }
        0.5 * sum * (-z).exp()
    } else {
        0.25 * (1.0 - decay * decay) - kh * decay
    };
    [even, odd]
}

#[cfg(test)]
mod tests;
