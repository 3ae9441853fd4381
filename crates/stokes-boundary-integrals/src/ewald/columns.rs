//! Shares of the columns of the grid's spectrum, and the product with the spectrum of the Green's function.

use std::{f64::consts::PI, ops::Range};

use motile_base::{ComplexTransform, InputError};
use num_complex::Complex64;

use super::{lattice::Lattice, rows::Rows, split::Split, window::Window};
use crate::shares::MOST;

const I: Complex64 = Complex64::new(0.0, 1.0);
/// Rows that are taken at a time, as in [`Rows`].
const BATCH: usize = 8;

/// Part of a flow as complex numbers; see [`crate::greens::Flow`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// Velocity u + i v.
    Velocity,
    /// Its derivative by conj(z).
    Strain,
    /// Minus half of the pressure, and the spin as imaginary part.
    Pull,
}

/// Columns of the wave numbers m and -m along x, for some m.
#[derive(Debug, Clone)]
pub(super) struct Columns {
    waves: Range<usize>,
    size: [usize; 2],
    /// Factor of the Green's function over the square of the wave vector, for each m and n.
    symbol: Vec<f64>,
    /// The spectrum, the column of m before the column of -m, and the column of the traces of dipoles.
    values: Vec<Complex64>,
    traces: Vec<Complex64>,
    transform: ComplexTransform,
}

impl Columns {
    /// Returns the shares of the columns up to the wave number `last`, with grid points along x and y.
    pub(super) fn divide(last: usize, size: [usize; 2]) -> Result<Vec<Self>, InputError> {
        let (waves, transform) = (last + 1, ComplexTransform::new(size[1])?);
        let count = MOST.min(waves);
        let share = |index: usize| {
            let waves = index * waves / count..(index + 1) * waves / count;
            let columns = 2 * waves.len() - usize::from(waves.start == 0);
            let values = vec![Complex64::ZERO; columns * size[1]];
            let symbol = vec![0.0; waves.len() * size[1]];
            Self { waves, size, symbol, values, traces: Vec::new(), transform: transform.clone() }
        };
        Ok((0..count).map(share).collect())
    }

    /// Computes the factors for a lattice.
    pub(super) fn set_symbol(&mut self, lattice: &Lattice, cutoff: f64, split: &Split, window: &Window) {
        let [mx, my] = self.size;
        let transform = |m: f64, size: usize| window.transform(2.0 * PI * m / size as f64).powi(-2);
        let across: Vec<f64> = (0..my).map(|n| transform(signed(n, my), my)).collect();
        for (m, symbol) in self.waves.clone().zip(self.symbol.chunks_exact_mut(my)) {
            let along = transform(m as f64, mx) / lattice.area();
            for (n, (symbol, across)) in symbol.iter_mut().zip(&across).enumerate() {
                let [kx, ky] = lattice.wave([m as f64, signed(n, my)]);
                let square = kx * kx + ky * ky;
                let x = square.sqrt() * cutoff;
                let inside = x <= split.c && square > 0.0;
                *symbol = if inside { 2.0 * PI * split.phi(x) * along * across / (square * square) } else { 0.0 };
            }
        }
    }

    /// Takes its columns out of the rows and transforms them; the columns of `traces` go into separate memory.
    pub(super) fn gather(&mut self, rows: &[Rows], traces: bool) {
        let [mx, my] = self.size;
        if traces {
            self.traces.resize(self.values.len(), Complex64::ZERO);
        }
        let values = if traces { &mut self.traces } else { &mut self.values };
        for share in rows {
            for start in (0..share.own).step_by(BATCH) {
                let batch = start..share.own.min(start + BATCH);
                for (index, column) in values.chunks_exact_mut(my).enumerate() {
                    let place = column_of(&self.waves, index, mx);
                    for row in batch.clone() {
                        column[share.first + row] = share.value(row, place);
                    }
                }
            }
        }
        // Columns have the length of the plan, so that the call cannot fail.
        let _ = self.transform.forward(values);
    }

    /// Multiplies by the spectrum of the Stokeslet and transforms back: `W(k) = A [Z(k) - kappa^2/k^2 conj Z(-k)]` with
    /// the spectrum Z of the forces as complex numbers and kappa = kx + i ky; the pull is `i A conj(kappa) Z(k)`.
    pub(super) fn apply_stokeslet(&mut self, lattice: &Lattice, part: Part) {
        let velocity = |kappa: Complex64, symbol: f64, [here, there]: [Complex64; 2]| {
            let (square, turn) = (kappa.norm_sqr() * symbol, kappa * kappa * symbol);
            [here * square - turn * there.conj(), there * square - turn * here.conj()]
        };
        match part {
            Part::Velocity => self.each_pair(lattice, |kappa, symbol, pair, _| velocity(kappa, symbol, pair)),
            Part::Strain => {
                self.each_pair(lattice, |kappa, symbol, pair, _| strain(kappa, velocity(kappa, symbol, pair)));
            }
            Part::Pull => self.each_pair(lattice, |kappa, symbol, [here, there], _| {
                let factor = I * kappa.conj() * (kappa.norm_sqr() * symbol);
                [factor * here, -factor * there]
            }),
        }
    }

    /// Multiplies by the spectrum of the stress and transforms back: `W(k) = -2 i A [conj(kappa) Z(k) - kappa^3/k^2
    /// conj Z(-k) + kappa T(k)]` with the spectrum Z of half of (xx - yy) + i s of the dipoles, and T of their trace.
    /// The pull is `2 A conj(kappa)^2 Z(k)`.
    pub(super) fn apply_stress(&mut self, lattice: &Lattice, part: Part) {
        let velocity = |kappa: Complex64, symbol: f64, [here, there]: [Complex64; 2], trace: Complex64| {
            let (square, cube) = (kappa.norm_sqr(), kappa * kappa * kappa);
            let one = (kappa.conj() * here + kappa * trace) * square - cube * there.conj();
            let other = cube * here.conj() - (kappa.conj() * there + kappa * trace.conj()) * square;
            [one, other].map(|value| -2.0 * symbol * I * value)
        };
        match part {
            Part::Velocity => self.each_pair(lattice, velocity),
            Part::Strain => self
                .each_pair(lattice, |kappa, symbol, pair, trace| strain(kappa, velocity(kappa, symbol, pair, trace))),
            Part::Pull => self.each_pair(lattice, |kappa, symbol, pair, _| {
                let factor = 2.0 * kappa.norm_sqr() * symbol * kappa.conj() * kappa.conj();
                pair.map(|value| factor * value)
            }),
        }
    }

    /// Replaces the values of each pair of opposite waves and transforms back; `take` gets kappa and the factor of the
    /// first one, both values, and the trace of the first one.
    fn each_pair(
        &mut self,
        lattice: &Lattice,
        take: impl Fn(Complex64, f64, [Complex64; 2], Complex64) -> [Complex64; 2],
    ) {
        let my = self.size[1];
        let mut columns = self.values.as_mut_slice();
        let mut traces = self.traces.as_slice();
        for (m, symbol) in self.waves.clone().zip(self.symbol.chunks_exact(my)) {
            let (here, rest) = columns.split_at_mut(my);
            let (there, rest) = rest.split_at_mut(if m == 0 { 0 } else { my });
            columns = rest;
            let trace = |n: usize| traces.get(n).copied().unwrap_or_default();
            for (n, symbol) in symbol.iter().enumerate() {
                let opposite = (my - n) % my;
                if m == 0 && opposite < n {
                    continue;
                }
                let mut values = [here[n], if m == 0 { here[opposite] } else { there[opposite] }];
                values = if *symbol == 0.0 {
                    [Complex64::ZERO; 2]
                } else {
                    let [kx, ky] = lattice.wave([m as f64, signed(n, my)]);
                    take(Complex64::new(kx, ky), *symbol, values, trace(n))
                };
                here[n] = values[0];
                if m == 0 {
                    here[opposite] = values[1];
                } else {
                    there[opposite] = values[1];
                }
            }
            traces = traces.get(if m == 0 { my } else { 2 * my }..).unwrap_or_default();
        }
        let _ = self.transform.inverse(&mut self.values);
    }
}

/// Copies entries of all columns into rows: starting at the entry `first`, into rows at this distance from each other.
#[inline(always)]
pub(super) fn write_rows(columns: &[Columns], first: usize, stride: usize, rows: &mut [Complex64]) {
    for share in columns {
        for (index, values) in share.values.chunks_exact(share.size[1]).enumerate() {
            let column = column_of(&share.waves, index, share.size[0]);
            for (row, value) in rows.chunks_exact_mut(stride).zip(&values[first..]) {
                row[column] = *value;
            }
        }
    }
}

/// Returns the derivative by conj(z) of the waves of kappa and -kappa.
fn strain(kappa: Complex64, [here, there]: [Complex64; 2]) -> [Complex64; 2] {
    let factor = 0.5 * I * kappa;
    [factor * here, -factor * there]
}

/// Returns the place in a row of the column of that number in a share.
#[inline(always)]
fn column_of(waves: &Range<usize>, index: usize, length: usize) -> usize {
    let index = index + usize::from(waves.start == 0);
    let m = waves.start + index / 2;
    if index.is_multiple_of(2) || m == 0 { m } else { length - m }
}

/// Returns the wave number of entry n of a spectrum.
#[inline(always)]
fn signed(n: usize, count: usize) -> f64 {
    if n <= count / 2 { n as f64 } else { n as f64 - count as f64 }
}
