//! Sums of the smooth part of the periodic Green's function by moments.
//!
//! With distances as `d = z - z'`, target and source taken from the centre of the target's interface, the powers of d in
//! [`Lattice`] separate by the binomial theorem: the sources enter by a few moments, and the flow is a polynomial.
//! The cost grows with the number of nodes, not with its square.

use std::f64::consts::PI;

use num_complex::Complex64;

use crate::{
    lattice::{Lattice, MOST_TERMS},
    planes::Vectors,
};

/// Moments of sources about a point, k = 0 .. degree, in units of the shorter period.
#[derive(Debug, Default, Clone)]
pub(crate) struct Moments {
    /// Sum of F z^k.
    plain: Vec<Complex64>,
    /// Sum of conj(F) z^k.
    conjugate: Vec<Complex64>,
    /// Sum of F conj(z) z^k.
    mixed: Vec<Complex64>,
    /// Sum of (v.n) z^k, of dipoles alone.
    flux: Vec<Complex64>,
}

impl Moments {
    pub(crate) fn clear(&mut self, degree: usize) {
        for family in [&mut self.plain, &mut self.conjugate, &mut self.mixed, &mut self.flux] {
            family.clear();
            family.resize(degree + 1, Complex64::default());
        }
    }

    /// Adds the moments of `other` about the same point.
    pub(crate) fn add(&mut self, other: &Self) {
        let own = [&mut self.plain, &mut self.conjugate, &mut self.mixed, &mut self.flux];
        let others = [&other.plain, &other.conjugate, &other.mixed, &other.flux];
        for (own, other) in own.into_iter().zip(others) {
            own.iter_mut().zip(other).for_each(|(own, other)| *own += other);
        }
    }

    /// Adds the moments of `other`, whose origin lies at `shift` (in units of the shorter period) from this one's:
    /// `sum over q of binomial(k, q) shift^(k - q) M_q`. With M_q scaled by shift^-q this is Pascal's triangle.
    pub(crate) fn add_shifted(&mut self, other: &Self, shift: Complex64) {
        const LEAST_SHIFT: f64 = 1e-2;
        if shift.norm() < LEAST_SHIFT {
            // The powers of a small shift would overflow: go there by way of a point farther away.
            let detour = Complex64::new(0.1, 0.0);
            let mut between = Self::default();
            between.clear(self.plain.len() - 1);
            between.add_shifted(other, shift - detour);
            self.add_shifted(&between, detour);
            return;
        }
        // The families side by side, so that the triangle runs in vector registers.
        let len = self.plain.len();
        let mut lanes = [[0.0; 8]; MOST_TERMS + 1];
        let inverse = shift.inv();
        let mut power = Complex64::new(1.0, 0.0);
        for (q, lane) in lanes[..len].iter_mut().enumerate() {
            let values = [other.plain[q], other.conjugate[q], other.mixed[q], other.flux[q]].map(|value| value * power);
            *lane = [
                values[0].re,
                values[0].im,
                values[1].re,
                values[1].im,
                values[2].re,
                values[2].im,
                values[3].re,
                values[3].im,
            ];
            power *= inverse;
        }
        for first in 1..len {
            let mut last = lanes[first - 1];
            for lane in &mut lanes[first..len] {
                let old = *lane;
                for (value, last) in lane.iter_mut().zip(last) {
                    *value += last;
                }
                last = old;
            }
        }
        let mut power = Complex64::new(1.0, 0.0);
        for (k, lane) in lanes[..len].iter().enumerate() {
            let value = |family: usize| Complex64::new(lane[2 * family], lane[2 * family + 1]) * power;
            let plain = value(0);
            self.plain[k] += plain;
            self.conjugate[k] += value(1);
            self.mixed[k] += value(2) + shift.conj() * plain;
            self.flux[k] += value(3);
            power *= shift;
        }
    }
}

/// Binomial coefficients up to a degree.
#[derive(Debug, Default)]
pub(crate) struct Binomials {
    rows: Vec<Vec<f64>>,
}

impl Binomials {
    pub(crate) fn new(degree: usize) -> Self {
        let mut rows = vec![vec![1.0]];
        for n in 1..=degree {
            let last: &Vec<f64> = &rows[n - 1];
            let inner = (1..n).map(|k| last[k - 1] + last[k]);
            rows.push(std::iter::once(1.0).chain(inner).chain(std::iter::once(1.0)).collect());
        }
        Self { rows }
    }

    fn get(&self, n: usize, k: usize) -> f64 {
        self.rows[n][k]
    }
}

/// The flow near a point as `P(z) + conj Q(z) + z conj R(z)` and terms of second order.
#[derive(Debug, Default)]
pub(crate) struct Expansion {
    moments: Moments,
    p: Vec<Complex64>,
    q: Vec<Complex64>,
    r: Vec<Complex64>,
    power: Vectors,
    columns: [Vec<f64>; 5],
    accumulators: [Vectors; 3],
}

impl Expansion {
    /// Moments of forces at `positions` about their origin.
    pub(crate) fn forces(
        &mut self,
        lattice: &Lattice,
        positions: &[Complex64],
        forces: &[Complex64],
        out: &mut Moments,
    ) {
        let [fx, fy, gx, gy, _] = &mut self.columns;
        resize([&mut *fx, fy, gx, gy], positions.len());
        for (i, (z, f)) in positions.iter().zip(forces).enumerate() {
            let g = f * z.conj() / lattice.unit;
            (fx[i], fy[i], gx[i], gy[i]) = (f.re, f.im, g.re, g.im);
        }
        start(&mut self.power, positions.len());
        let degree = out.plain.len();
        for k in 0..degree {
            let [fx, fy, gx, gy, _] = &self.columns;
            let (xr, xi) = dot(fx, &self.power);
            let (yr, yi) = dot(fy, &self.power);
            out.plain[k] = Complex64::new(xr - yi, xi + yr);
            out.conjugate[k] = Complex64::new(xr + yi, xi - yr);
            let (xr, xi) = dot(gx, &self.power);
            let (yr, yi) = dot(gy, &self.power);
            out.mixed[k] = Complex64::new(xr - yi, xi + yr);
            out.flux[k] = Complex64::default();
            advance(&mut self.power, positions, lattice.unit);
        }
    }

    /// Moments of the double layer: `products` holds v n and `fluxes` v.n, both times their weight. Force F along v with
    /// a derivative along n, and the reverse.
    pub(crate) fn dipoles(
        &mut self,
        lattice: &Lattice,
        positions: &[Complex64],
        products: &[Complex64],
        fluxes: &[f64],
        out: &mut Moments,
    ) {
        let [ax, ay, cx, cy, b] = &mut self.columns;
        resize([&mut *ax, ay, cx, cy], positions.len());
        b.clear();
        b.extend_from_slice(fluxes);
        for (i, (z, a)) in positions.iter().zip(products).enumerate() {
            let c = a * z.conj() / lattice.unit;
            (ax[i], ay[i], cx[i], cy[i]) = (a.re, a.im, c.re, c.im);
        }
        start(&mut self.power, positions.len());
        let degree = out.plain.len();
        let inverse = 1.0 / lattice.unit;
        let mut last = [Complex64::default(); 3];
        for k in 0..degree {
            let [ax, ay, cx, cy, b] = &self.columns;
            let (xr, xi) = dot(ax, &self.power);
            let (yr, yi) = dot(ay, &self.power);
            let a = Complex64::new(xr - yi, xi + yr);
            let (xr, xi) = dot(cx, &self.power);
            let (yr, yi) = dot(cy, &self.power);
            let c = Complex64::new(xr - yi, xi + yr);
            let (re, im) = dot(b, &self.power);
            let b = Complex64::new(re, im);
            let factor = 2.0 * inverse * k as f64;
            out.plain[k] = last[0] * factor;
            out.conjugate[k] = last[1] * factor;
            out.mixed[k] = last[2] * factor + b * (2.0 * inverse);
            out.flux[k] = b;
            last = [a, b, c];
            advance(&mut self.power, positions, lattice.unit);
        }
    }

    /// The moments that [`Expansion::add_flow`] takes, about the origin of its targets.
    pub(crate) fn moments(&mut self) -> &mut Moments {
        &mut self.moments
    }

    /// Adds the flow of the moments at `positions`.
    pub(crate) fn add_flow(
        &mut self,
        lattice: &Lattice,
        binomials: &Binomials,
        positions: &[Complex64],
        out: &mut Vectors,
    ) {
        self.expand(lattice, binomials);
        let m = &self.moments;
        let [a0, a1] = [m.plain[0], m.plain[1]];
        let [b0, b1, b2] = [m.conjugate[0], m.conjugate[1], m.conjugate[2]];
        let [c0, c1] = [m.mixed[0], m.mixed[1]];
        let second = PI * lattice.unit * lattice.unit / (2.0 * lattice.area);
        let flux = 2.0 * PI * lattice.unit / lattice.area;
        let constant = a0 * lattice.constant + second * c1 - 0.5 * second * b2 + flux * m.flux[1];
        let n = positions.len();
        start(&mut self.power, n);
        for (i, z) in positions.iter().enumerate() {
            (self.power.x[i], self.power.y[i]) = (z.re / lattice.unit, z.im / lattice.unit);
        }
        for (sums, coefficients) in self.accumulators.iter_mut().zip([&self.p, &self.q, &self.r]) {
            horner(coefficients, &self.power, sums);
        }
        let [p, q, r] = &self.accumulators;
        for i in 0..n {
            let z = Complex64::new(self.power.x[i], self.power.y[i]);
            let r = Complex64::new(r.x[i], -r.y[i]);
            let quadratic = second * (a0 * z.norm_sqr() - z * c0 - z.conj() * a1)
                - second * z * (0.5 * z * b0 - b1)
                - flux * z * m.flux[0];
            let w = constant + quadratic + z * r;
            out.x[i] += w.re + p.x[i] + q.x[i];
            out.y[i] += w.im + p.y[i] - q.y[i];
        }
    }

    /// Coefficients of P, Q and R from the moments.
    fn expand(&mut self, lattice: &Lattice, binomials: &Binomials) {
        let m = &self.moments;
        let degree = m.plain.len() - 1;
        for family in [&mut self.p, &mut self.q, &mut self.r] {
            family.clear();
            family.resize(degree + 1, Complex64::default());
        }
        self.q[0] += lattice.t[0] * m.plain[0];
        for n in (2..=degree).step_by(2) {
            let (s, t) = (lattice.s[n / 2], lattice.t[n / 2]);
            for k in 0..=n {
                let factor = binomials.get(n, k) * if (n - k).is_multiple_of(2) { 1.0 } else { -1.0 };
                self.p[k] += m.plain[n - k] * (0.5 * s * factor);
                self.q[k] += m.conjugate[n - k] * (0.5 * s * factor) + m.plain[n - k] * (t * factor);
            }
            let slope = 0.5 * n as f64 * s;
            let pressure = 4.0 * slope / lattice.unit;
            for k in 0..n {
                let j = n - 1 - k;
                let factor = binomials.get(n - 1, k) * if j.is_multiple_of(2) { 1.0 } else { -1.0 };
                self.q[k] += (m.mixed[j] * slope - m.flux[j] * pressure) * factor;
                self.r[k] -= m.plain[j] * (slope * factor);
            }
        }
    }
}

fn resize<const N: usize>(arrays: [&mut Vec<f64>; N], len: usize) {
    for array in arrays {
        array.resize(len, 0.0);
    }
}

fn start(power: &mut Vectors, len: usize) {
    power.clear(len);
    power.x.fill(1.0);
}

/// Multiplies the powers by z in units of the shorter period.
fn advance(power: &mut Vectors, positions: &[Complex64], unit: f64) {
    let inverse = 1.0 / unit;
    for ((x, y), z) in power.x.iter_mut().zip(&mut power.y).zip(positions) {
        let (zx, zy) = (z.re * inverse, z.im * inverse);
        (*x, *y) = (*x * zx - *y * zy, *x * zy + *y * zx);
    }
}

/// Sums of a real column times real and imaginary part of the powers.
fn dot(column: &[f64], power: &Vectors) -> (f64, f64) {
    const LANES: usize = 8;
    let n = column.len();
    let (columns, rest) = column.as_chunks::<LANES>();
    let (re, re_rest) = power.x[..n].as_chunks::<LANES>();
    let (im, im_rest) = power.y[..n].as_chunks::<LANES>();
    let (mut real, mut imaginary) = ([0.0; LANES], [0.0; LANES]);
    for ((c, re), im) in columns.iter().zip(re).zip(im) {
        for lane in 0..LANES {
            real[lane] += c[lane] * re[lane];
            imaginary[lane] += c[lane] * im[lane];
        }
    }
    let mut sums = (real.iter().sum::<f64>(), imaginary.iter().sum::<f64>());
    for ((c, re), im) in rest.iter().zip(re_rest).zip(im_rest) {
        sums.0 += c * re;
        sums.1 += c * im;
    }
    sums
}

/// Values of a polynomial at all points by Horner's scheme.
fn horner(coefficients: &[Complex64], points: &Vectors, out: &mut Vectors) {
    let n = points.x.len();
    out.clear(n);
    let (x, y) = (&points.x[..n], &points.y[..n]);
    let (re, im) = (&mut out.x[..n], &mut out.y[..n]);
    for c in coefficients.iter().rev() {
        for i in 0..n {
            let (a, b) = (re[i], im[i]);
            re[i] = a * x[i] - b * y[i] + c.re;
            im[i] = a * y[i] + b * x[i] + c.im;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shifted_moments_are_those_about_the_other_point() {
        let lattice = Lattice::new([6.0, 7.0]);
        let degree = 24;
        let mut expansion = Expansion::default();
        let positions: Vec<Complex64> = (0..20).map(|k| Complex64::from_polar(0.8, 0.3 * f64::from(k))).collect();
        let forces: Vec<Complex64> = (0..20).map(|k| Complex64::from_polar(1.0, 0.7 * f64::from(k * k))).collect();
        // Far, close, nearly and exactly on the old point.
        for shift in [[0.3, -0.2], [0.02, 0.0], [1e-3, 2e-3], [0.0, 0.0]] {
            let shift = Complex64::new(shift[0], shift[1]);
            let moved: Vec<Complex64> = positions.iter().map(|z| z + shift * lattice.unit).collect();
            let (mut own, mut expected, mut found) = (Moments::default(), Moments::default(), Moments::default());
            for moments in [&mut own, &mut expected, &mut found] {
                moments.clear(degree);
            }
            expansion.forces(&lattice, &positions, &forces, &mut own);
            expansion.forces(&lattice, &moved, &forces, &mut expected);
            found.add_shifted(&own, shift);
            let scale = 0.14 + shift.norm();
            for k in 0..=degree {
                let bound = 1e-12 * 20.0 * scale.max(0.25).powi(k as i32);
                assert!((found.plain[k] - expected.plain[k]).norm() < bound, "{shift} {k}");
                assert!((found.conjugate[k] - expected.conjugate[k]).norm() < bound, "{shift} {k}");
                assert!((found.mixed[k] - expected.mixed[k]).norm() < bound, "{shift} {k}");
            }
        }
    }
}
