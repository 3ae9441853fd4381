//! Sums over sources of a Green's function with a [`Series`], by the moments of the sources.
//!
//! With distances as `D + z - z'`, target and source each taken from the centre of its curve, the powers of z - z'
//! separate by the binomial theorem: the sources enter by a few moments, and the flow is a polynomial. The cost grows
//! with the number of nodes, not with its square.

use std::f64::consts::PI;

use num_complex::Complex64;

use crate::greens::{Flow, Vectors};

use super::series::Series;

/// Moments of sources about a point, k = 0 .. degree, with lengths in the unit of the series.
#[derive(Debug, Default, Clone)]
pub(crate) struct Moments {
    /// Sum of F z^k.
    plain: Vec<Complex64>,
    /// Sum of conj(F) z^k.
    conjugate: Vec<Complex64>,
    /// Sum of F conj(z) z^k.
    mixed: Vec<Complex64>,
    /// Sum of (v.n) z^k over dipoles; zero for forces.
    flux: Vec<Complex64>,
}

impl Moments {
    /// Sets all moments up to a degree to zero.
    pub(crate) fn clear(&mut self, degree: usize) {
        for family in [&mut self.plain, &mut self.conjugate, &mut self.mixed, &mut self.flux] {
            family.clear();
            family.resize(degree + 1, Complex64::default());
        }
    }

    /// Adds the moments of other sources.
    pub(crate) fn add(&mut self, other: &Self) {
        let Self { plain, conjugate, mixed, flux } = self;
        let others = [&other.plain, &other.conjugate, &other.mixed, &other.flux];
        for (own, other) in [plain, conjugate, mixed, flux].into_iter().zip(others) {
            own.iter_mut().zip(other).for_each(|(own, other)| *own += other);
        }
    }
}

/// The flow near a point, `P(z) + conj Q(z) + z conj R(z)` with R = -P' and quadratic terms of a uniform background
/// force.
#[derive(Debug, Clone, Default)]
pub(crate) struct Expansion {
    p: Vectors,
    q: Vectors,
    r: Vectors,
    /// Moments 0, 1 and 2 of all sources, for the quadratic terms.
    low: [[Complex64; 3]; 4],
    power: Vectors,
    columns: [Vec<f64>; 5],
    accumulators: [Vectors; 3],
}

impl Expansion {
    /// Writes the moments of forces at `positions` about their origin.
    pub(crate) fn forces(&mut self, unit: f64, positions: &[Complex64], forces: &[Complex64], out: &mut Moments) {
        let [fx, fy, gx, gy, _] = &mut self.columns;
        resize([&mut *fx, fy, gx, gy], positions.len());
        for (i, (z, f)) in positions.iter().zip(forces).enumerate() {
            let g = f * z.conj() / unit;
            (fx[i], fy[i], gx[i], gy[i]) = (f.re, f.im, g.re, g.im);
        }
        start(&mut self.power, positions.len());
        let degree = out.plain.len();
        for k in 0..degree {
            let [fx, fy, gx, gy, _] = &self.columns;
            [out.plain[k], out.conjugate[k]] = sums(fx, fy, &self.power);
            [out.mixed[k], _] = sums(gx, gy, &self.power);
            out.flux[k] = Complex64::default();
            advance(&mut self.power, positions, unit);
        }
    }

    /// Writes the moments of a double layer, `products` having v n (as complex numbers) and `fluxes` v.n, both times
    /// their weight: pairs of opposite forces along v displaced along n, and the reverse.
    pub(crate) fn dipoles(
        &mut self,
        unit: f64,
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
            let c = a * z.conj() / unit;
            (ax[i], ay[i], cx[i], cy[i]) = (a.re, a.im, c.re, c.im);
        }
        start(&mut self.power, positions.len());
        let degree = out.plain.len();
        let inverse = 1.0 / unit;
        let mut last = [Complex64::default(); 3];
        for k in 0..degree {
            let [ax, ay, cx, cy, b] = &self.columns;
            let ([a, _], [c, _]) = (sums(ax, ay, &self.power), sums(cx, cy, &self.power));
            let b = dot(b, &self.power);
            let factor = 2.0 * inverse * k as f64;
            out.plain[k] = last[0] * factor;
            out.conjugate[k] = last[1] * factor;
            out.mixed[k] = last[2] * factor + b * (2.0 * inverse);
            out.flux[k] = b;
            last = [a, b, c];
            advance(&mut self.power, positions, unit);
        }
    }

    /// Sets the flow to zero, for targets about a new origin.
    pub(crate) fn begin(&mut self, degree: usize) {
        for part in [&mut self.p, &mut self.q] {
            part.clear(degree + 2);
        }
        self.low = Default::default();
    }

    /// Adds the flow of the moments of a source; delta = 0 in `series` belongs to their origin.
    pub(crate) fn add(&mut self, series: &Series, moments: &Moments, unit: f64) {
        let degree = series.degree().min(moments.plain.len() - 1);
        let [sr, si] = &series.s;
        let [tr, ti] = &series.t;
        let mut inverse = 1.0;
        for q in 0..=degree {
            if q > 0 {
                inverse /= -(q as f64);
            }
            let a = moments.plain[q] * inverse;
            let b = moments.conjugate[q] * (0.5 * inverse);
            let flux = moments.flux[q] * (-2.0 / unit * inverse);
            let c = moments.mixed[q] * (0.5 * inverse) + flux;
            let half = a * 0.5;
            let count = degree + 1 - q;
            let (sr, si, dr, di) =
                (&sr[q..q + count], &si[q..q + count], &sr[q + 1..=q + count], &si[q + 1..=q + count]);
            let (tr, ti) = (&tr[q..q + count], &ti[q..q + count]);
            let (pr, pi) = (&mut self.p.x[..count], &mut self.p.y[..count]);
            let (qr, qi) = (&mut self.q.x[..count], &mut self.q.y[..count]);
            for k in 0..count {
                pr[k] += sr[k] * half.re - si[k] * half.im;
                pi[k] += sr[k] * half.im + si[k] * half.re;
                // The derivative of the target's part ends a degree earlier, and so does that of the source's, so that
                // the flow is that of a symmetric Green's function.
                let c = if k + 1 < count { c } else { flux };
                qr[k] += sr[k] * b.re - si[k] * b.im + tr[k] * a.re - ti[k] * a.im + dr[k] * c.re - di[k] * c.im;
                qi[k] += sr[k] * b.im + si[k] * b.re + tr[k] * a.im + ti[k] * a.re + dr[k] * c.im + di[k] * c.re;
            }
        }
        let Moments { plain, conjugate, mixed, flux } = moments;
        for (low, family) in self.low.iter_mut().zip([plain, conjugate, mixed, flux]) {
            low.iter_mut().zip(family).for_each(|(low, moment)| *low += moment);
        }
    }

    /// Takes over the flow of another expansion.
    pub(crate) fn copy(&mut self, other: &Self) {
        for (own, other) in [&mut self.p, &mut self.q, &mut self.r].into_iter().zip([&other.p, &other.q, &other.r]) {
            own.x.clone_from(&other.x);
            own.y.clone_from(&other.y);
        }
        self.low = other.low;
    }

    /// Adds the flow at `positions` (length) to `out` after [`Expansion::divide`]; `area` is the area of a box,
    /// infinite without a background force.
    pub(crate) fn add_flow(&mut self, positions: &[Complex64], unit: f64, area: f64, out: &mut Vectors) {
        self.place(positions, unit);
        for (sums, coefficients) in self.accumulators.iter_mut().zip([&self.p, &self.q, &self.r]) {
            horner(coefficients, &self.power, sums);
        }
        let [[a0, a1, _], [b0, b1, b2], [c0, c1, _], [e0, e1, _]] = self.low;
        let second = PI * unit * unit / (2.0 * area);
        let flux = 2.0 * PI * unit / area;
        let constant = second * c1 - 0.5 * second * b2 + flux * e1;
        let [p, q, r] = &self.accumulators;
        for i in 0..positions.len() {
            let z = Complex64::new(self.power.x[i], self.power.y[i]);
            let r = Complex64::new(r.x[i], -r.y[i]);
            let quadratic = second * (a0 * z.norm_sqr() - z * c0 - z.conj() * a1)
                - second * z * (0.5 * z * b0 - b1)
                - flux * z * e0;
            let w = constant + quadratic + z * r;
            out.x[i] += w.re + p.x[i] + q.x[i];
            out.y[i] += w.im + p.y[i] - q.y[i];
        }
    }

    /// Adds `sign` times the flow at `positions`, with its gradient and pressure, to `out`; otherwise as
    /// [`Expansion::add_flow`]. The derivative by z is `P' + conj R`, that by conj(z) `conj Q' + z conj R'`, and the
    /// pressure `-4 Re P'`.
    pub(crate) fn add_samples(&mut self, positions: &[Complex64], unit: f64, area: f64, sign: f64, out: &mut [Flow]) {
        let mut velocity = Vectors::default();
        velocity.clear(positions.len());
        self.add_flow(positions, unit, area, &mut velocity);
        let [_, _, r] = &mut self.accumulators;
        let spin = std::mem::take(r);
        for part in [&mut self.q, &mut self.r] {
            differentiate(part);
        }
        for (sums, coefficients) in self.accumulators.iter_mut().zip([&self.q, &self.r]) {
            horner(coefficients, &self.power, sums);
        }
        let [[a0, a1, _], [b0, b1, _], [c0, _, _], [e0, _, _]] = self.low;
        let second = PI * unit * unit / (2.0 * area);
        let flux = 2.0 * PI * unit / area;
        let [q, r, _] = &self.accumulators;
        let slope = sign / unit;
        for (i, flow) in out.iter_mut().enumerate() {
            let z = Complex64::new(self.power.x[i], self.power.y[i]);
            let [q, r] = [q, r].map(|part| Complex64::new(part.x[i], -part.y[i]));
            let turn = second * (a0 * z.conj() - c0 - z * b0 + b1) - flux * e0;
            flow.velocity += sign * Complex64::new(velocity.x[i], velocity.y[i]);
            flow.spin += slope * (turn + Complex64::new(0.0, -2.0 * spin.y[i]));
            flow.strain += slope * (second * (a0 * z - a1) + q + z * r);
            flow.pressure += slope * 4.0 * (spin.x[i] + second * (c0 - a0 * z.conj()).re);
        }
    }

    /// Ends the sum over sources: divides by k!, for the coefficients of P, Q and R = -P'.
    pub(crate) fn divide(&mut self) {
        let mut inverse = 1.0;
        let len = self.p.x.len();
        self.r.clear(len);
        for k in 0..len {
            if k > 0 {
                self.r.x[k - 1] = -self.p.x[k] * inverse;
                self.r.y[k - 1] = -self.p.y[k] * inverse;
                inverse /= k as f64;
            }
            for part in [&mut self.p, &mut self.q] {
                part.x[k] *= inverse;
                part.y[k] *= inverse;
            }
        }
    }

    /// Takes over positions in units of `unit`.
    fn place(&mut self, positions: &[Complex64], unit: f64) {
        self.power.clear(positions.len());
        for (i, z) in positions.iter().enumerate() {
            (self.power.x[i], self.power.y[i]) = (z.re / unit, z.im / unit);
        }
    }
}

/// Replaces the coefficients of a polynomial by the coefficients of its derivative.
fn differentiate(coefficients: &mut Vectors) {
    for part in [&mut coefficients.x, &mut coefficients.y] {
        for k in 1..part.len() {
            part[k - 1] = k as f64 * part[k];
        }
        part.pop();
    }
}

fn resize<const N: usize>(arrays: [&mut Vec<f64>; N], len: usize) {
    for array in arrays {
        array.resize(len, 0.0);
    }
}

/// Sets the powers to z^0.
fn start(power: &mut Vectors, len: usize) {
    power.clear(len);
    power.x.fill(1.0);
}

/// Multiplies the powers by z in units of `unit`.
fn advance(power: &mut Vectors, positions: &[Complex64], unit: f64) {
    let inverse = 1.0 / unit;
    for ((x, y), z) in power.x.iter_mut().zip(&mut power.y).zip(positions) {
        let (zx, zy) = (z.re * inverse, z.im * inverse);
        (*x, *y) = (*x * zx - *y * zy, *x * zy + *y * zx);
    }
}

/// Returns the sums over F z^k and over conj(F) z^k, from the components of F and the powers.
fn sums(fx: &[f64], fy: &[f64], power: &Vectors) -> [Complex64; 2] {
    let (x, y) = (dot(fx, power), dot(fy, power));
    [Complex64::new(x.re - y.im, x.im + y.re), Complex64::new(x.re + y.im, x.im - y.re)]
}

/// Returns the sum of a real column times the powers.
fn dot(column: &[f64], power: &Vectors) -> Complex64 {
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
    let sum = Complex64::new(real.iter().sum(), imaginary.iter().sum());
    rest.iter().zip(re_rest).zip(im_rest).fold(sum, |sum, ((c, re), im)| sum + Complex64::new(c * re, c * im))
}

/// Values of a polynomial at all points, by Horner's scheme.
fn horner(coefficients: &Vectors, points: &Vectors, out: &mut Vectors) {
    let n = points.x.len();
    out.clear(n);
    let (x, y) = (&points.x[..n], &points.y[..n]);
    let (re, im) = (&mut out.x[..n], &mut out.y[..n]);
    for (cr, ci) in coefficients.x.iter().zip(&coefficients.y).rev() {
        for i in 0..n {
            let (a, b) = (re[i], im[i]);
            re[i] = a * x[i] - b * y[i] + cr;
            im[i] = a * y[i] + b * x[i] + ci;
        }
    }
}
