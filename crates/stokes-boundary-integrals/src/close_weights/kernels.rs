//! Kernels at the nodes of a curve for one point, as arrays of components, for loops in vector registers.

use num_complex::Complex64;

use crate::{
    curve::Curve,
    greens::{GreensFunction, Kernels, Vectors, half_turns, ln},
};

/// Square of |k d| below which the sine of k d/2 is taken from its series: the difference of two exponentials loses
/// more than a digit.
const SMALL: f64 = 4e-3;

/// Factors of the singularity swap at node j, from `units` u_j and their powers `turns` u_j^(N + 1), N terms: with
/// p = ratio/u_j or ratio u_j, `ln|d|` becomes `ln|d/(1 - p)|`, and 1/d^k gets `(1 - p)^k` times the first N + 1 terms
/// of the series of `(1 - p)^-k`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pole {
    /// exp(i alpha_0) of the preimage or its inverse, whichever is smaller.
    pub(super) ratio: Complex64,
    /// Its power N + 1.
    pub(super) turned: Complex64,
    /// 1 for a preimage on the left, -1 on the right.
    pub(super) side: f64,
    /// N.
    pub(super) terms: f64,
}

/// Functions of d = source minus target at some nodes: `ln|d|` and 1/d^k, or their counterparts for a row of images,
/// `ln|2 sin(k d/2)|` and the sums of 1/d^k.
#[derive(Debug, Clone, Default)]
pub(crate) struct KernelArrays {
    /// d, or 2 sin(k d/2)/k (length).
    pub(super) sine: Vectors,
    /// cos(k d/2); 1 in free space, where it is not stored.
    pub(super) cosine: Vectors,
    pub(crate) dy: Vec<f64>,
    pub(crate) log: Vec<f64>,
    pub(crate) c: [Vectors; 3],
    /// k of a row, 0 in free space.
    k: f64,
}

impl KernelArrays {
    fn resize(&mut self, len: usize) {
        let Self { sine, cosine, dy, log, c, .. } = self;
        for vectors in [sine, cosine].into_iter().chain(c) {
            vectors.x.resize(len, 0.0);
            vectors.y.resize(len, 0.0);
        }
        dy.resize(len, 0.0);
        log.resize(len, 0.0);
    }

    /// Returns the number of nodes.
    pub(crate) fn len(&self) -> usize {
        self.log.len()
    }

    /// Takes the distances of all fine nodes of a curve from a point, with the images of an open one.
    pub(super) fn place(&mut self, curve: &Curve, point: Complex64) {
        let len = curve.fine.position.len();
        self.resize(len);
        self.k = 0.0;
        let (arrays, Self { sine, dy, .. }) = (&curve.fine.arrays, &mut *self);
        subtract(&arrays.x, point.re, &mut sine.x);
        subtract(&arrays.y, point.im, &mut sine.y);
        dy.copy_from_slice(&sine.y);
        let GreensFunction::Row { k } = curve.greens() else { return };
        self.k = k;
        let target = half_turns(point, k);
        for (j, source) in curve.fine.half_turns.iter().enumerate() {
            let [turn, back] = [source[0] * target[1], source[1] * target[0]];
            let difference = turn - back;
            let (sine, cosine) = if difference.norm_sqr() < SMALL {
                // Functions of an image of d differ by a sign that both have.
                let x = 0.5 * k * curve.wrap(Complex64::new(self.sine.x[j], self.sine.y[j]));
                let square = x * x;
                let series = |a: f64, b: f64, c: f64| 1.0 - square / a * (1.0 - square / b * (1.0 - square / c));
                (x * series(6.0, 20.0, 42.0), series(2.0, 12.0, 30.0))
            } else {
                (Complex64::new(0.5 * difference.im, -0.5 * difference.re), 0.5 * (turn + back))
            };
            let sine = sine * (2.0 / k);
            (self.sine.x[j], self.sine.y[j]) = (sine.re, sine.im);
            (self.cosine.x[j], self.cosine.y[j]) = (cosine.re, cosine.im);
        }
    }

    /// Takes every `step`-th node of others, with their distances alone or with their kernels.
    #[inline(always)]
    pub(super) fn pick(&mut self, others: &Self, step: usize, order: Option<usize>) {
        self.resize(others.len().div_ceil(step));
        self.k = others.k;
        let copy = |from: &Vectors, to: &mut Vectors| {
            pick(&from.x, step, &mut to.x);
            pick(&from.y, step, &mut to.y);
        };
        pick(&others.dy, step, &mut self.dy);
        let Some(order) = order else {
            copy(&others.sine, &mut self.sine);
            if others.k > 0.0 {
                copy(&others.cosine, &mut self.cosine);
            }
            return;
        };
        pick(&others.log, step, &mut self.log);
        others.c.iter().zip(&mut self.c).take(order).for_each(|(from, to)| copy(from, to));
    }

    /// Computes the logarithms and the first ORDER powers from the distances.
    #[inline(always)]
    pub(super) fn invert<const ORDER: usize>(&mut self) {
        let Self { sine, log, c: [first, second, third], .. } = self;
        plain([&sine.x, &sine.y], log, [&mut first.x, &mut first.y]);
        if ORDER >= 2 {
            product(first, first, second);
        }
        if ORDER >= 3 {
            product(first, second, third);
        }
        self.turn::<ORDER>();
    }

    /// Computes them with the factors of a swap; the node nearest to the preimage is left to the caller.
    #[inline(always)]
    pub(super) fn swap<const ORDER: usize>(&mut self, units: &Vectors, turns: &Vectors, pole: &Pole) {
        let Self { sine, log, c: [first, second, third], .. } = self;
        swapped_log([&sine.x, &sine.y], [&units.x, &units.y], pole, log, [&mut first.x, &mut first.y]);
        let swapped = [[&units.x[..], &units.y], [&turns.x, &turns.y]];
        if ORDER >= 2 {
            product(first, first, second);
        }
        if ORDER >= 3 {
            product(first, second, third);
            swap_powers::<3>(swapped, pole, [&mut third.x, &mut third.y]);
        }
        if ORDER >= 2 {
            swap_powers::<2>(swapped, pole, [&mut second.x, &mut second.y]);
        }
        swap_powers::<1>(swapped, pole, [&mut first.x, &mut first.y]);
        self.turn::<ORDER>();
    }

    /// Completes the functions of a row: its odd powers have the factor of a cotangent, its logarithm k.
    #[inline(always)]
    fn turn<const ORDER: usize>(&mut self) {
        if self.k == 0.0 {
            return;
        }
        let log = self.k.ln();
        self.log.iter_mut().for_each(|value| *value += log);
        let Self { cosine, c: [first, _, third], .. } = self;
        multiply(cosine, first);
        if ORDER >= 3 {
            multiply(cosine, third);
        }
    }

    /// Returns all kernels of node j, as [`greens::Kernels`](Kernels).
    pub(crate) fn at(&self, j: usize) -> Kernels {
        let c = [0, 1, 2].map(|k| Complex64::new(self.c[k].x[j], self.c[k].y[j]));
        let y = Complex64::new(0.0, -2.0 * self.dy[j]);
        Kernels { log: self.log[j] - 0.5, c, e: [1.0 + y * c[0], c[0] + y * c[1], c[1] + y * c[2]], background: 0.0 }
    }
}

#[inline(always)]
fn subtract(from: &[f64], value: f64, out: &mut [f64]) {
    from.iter().zip(out).for_each(|(from, out)| *out = from - value);
}

#[inline(always)]
fn pick(from: &[f64], step: usize, to: &mut [f64]) {
    from.iter().step_by(step).zip(to).for_each(|(from, to)| *to = *from);
}

#[inline(always)]
fn product(a: &Vectors, b: &Vectors, out: &mut Vectors) {
    let n = out.x.len();
    let (ax, ay, bx, by) = (&a.x[..n], &a.y[..n], &b.x[..n], &b.y[..n]);
    let (x, y) = (&mut out.x[..n], &mut out.y[..n]);
    for j in 0..n {
        (x[j], y[j]) = (ax[j] * bx[j] - ay[j] * by[j], ax[j] * by[j] + ay[j] * bx[j]);
    }
}

#[inline(always)]
fn multiply(factor: &Vectors, out: &mut Vectors) {
    let n = out.x.len();
    let (ax, ay) = (&factor.x[..n], &factor.y[..n]);
    let (x, y) = (&mut out.x[..n], &mut out.y[..n]);
    for j in 0..n {
        (x[j], y[j]) = (ax[j] * x[j] - ay[j] * y[j], ax[j] * y[j] + ay[j] * x[j]);
    }
}

/// ln|d| and 1/d.
#[inline(always)]
fn plain([dx, dy]: [&[f64]; 2], log: &mut [f64], [x, y]: [&mut [f64]; 2]) {
    let n = log.len();
    let (dx, dy, x, y) = (&dx[..n], &dy[..n], &mut x[..n], &mut y[..n]);
    for j in 0..n {
        let square = dx[j] * dx[j] + dy[j] * dy[j];
        let inverse = 1.0 / square;
        log[j] = 0.5 * ln(square);
        (x[j], y[j]) = (dx[j] * inverse, -dy[j] * inverse);
    }
}

/// ln|d/(1 - p)| and 1/d.
#[inline(always)]
fn swapped_log([dx, dy]: [&[f64]; 2], [ux, uy]: [&[f64]; 2], pole: &Pole, log: &mut [f64], [x, y]: [&mut [f64]; 2]) {
    let n = log.len();
    let (dx, dy, ux, uy, x, y) = (&dx[..n], &dy[..n], &ux[..n], &uy[..n], &mut x[..n], &mut y[..n]);
    let (re, im) = (pole.ratio.re, pole.side * pole.ratio.im);
    // |1 - p|^2 = 1 + |ratio|^2 - 2 Re p.
    let (one, other) = (re, im);
    for j in 0..n {
        let square = dx[j] * dx[j] + dy[j] * dy[j];
        // The imaginary part of p has the other sign on the right; here only its square counts.
        let (gap_re, gap_im) = (1.0 - (one * ux[j] + other * uy[j]), other * ux[j] - one * uy[j]);
        let gap = gap_re * gap_re + gap_im * gap_im;
        let both = 1.0 / (square * gap);
        let inverse = both * gap;
        log[j] = 0.5 * ln(square * square * both);
        (x[j], y[j]) = (dx[j] * inverse, -dy[j] * inverse);
    }
}

/// Multiplies by the factors of 1/d^k.
#[inline(always)]
fn swap_powers<const K: usize>([units, turns]: [[&[f64]; 2]; 2], pole: &Pole, [x, y]: [&mut [f64]; 2]) {
    let n = x.len();
    let [[ux, uy], [tx, ty]] = [units, turns].map(|[x, y]| [&x[..n], &y[..n]]);
    let y = &mut y[..n];
    let Pole { ratio, turned, side, terms } = *pole;
    for j in 0..n {
        let (uy, ty) = (-side * uy[j], -side * ty[j]);
        let tail_re = turned.re * tx[j] - turned.im * ty;
        let tail_im = turned.re * ty + turned.im * tx[j];
        let (re, im) = if K == 1 {
            (1.0 - tail_re, -tail_im)
        } else {
            let (p_re, p_im) = (ratio.re * ux[j] - ratio.im * uy, ratio.re * uy + ratio.im * ux[j]);
            let (b_re, b_im) = if K == 2 {
                (terms + 2.0 - p_re * (terms + 1.0), -p_im * (terms + 1.0))
            } else {
                let (a, b) = (0.5 * (terms + 2.0) * (terms + 3.0), (terms + 1.0) * (terms + 3.0));
                let c = 0.5 * (terms + 1.0) * (terms + 2.0);
                (a - p_re * b + (p_re * p_re - p_im * p_im) * c, -p_im * b + 2.0 * p_re * p_im * c)
            };
            (1.0 - (tail_re * b_re - tail_im * b_im), -(tail_re * b_im + tail_im * b_re))
        };
        (x[j], y[j]) = (x[j] * re - y[j] * im, x[j] * im + y[j] * re);
    }
}
