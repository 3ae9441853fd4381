//! Rows of factors by which a correction acts on the values at fine nodes and at nodes of its source.

use num_complex::Complex64;

use motile_base::internal::widely;

use crate::{close_weights::KernelArrays, greens::Vectors};

/// Factors c of v and d of conj v, v a force or a velocity, at fine nodes and at nodes of a source: arrays of c, Re d
/// and Im d.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Row {
    /// First entry.
    pub(super) start: usize,
    /// Numbers of fine nodes and of nodes.
    counts: [usize; 2],
}

impl Row {
    fn push([fine, nodes]: [&KernelArrays; 2], rows: &mut Vec<f64>) -> Self {
        let (start, counts) = (rows.len(), [fine.len(), nodes.len()]);
        rows.resize(start + 3 * (counts[0] + counts[1]), 0.0);
        Self { start, counts }
    }

    /// Returns the entries of the fine nodes and of the nodes.
    fn parts<'a>(&self, rows: &'a [f64]) -> [&'a [f64]; 2] {
        let (fine, nodes) = rows[self.start..].split_at(3 * self.counts[0]);
        [fine, &nodes[..3 * self.counts[1]]]
    }

    /// Adds the row of the single layer, from the kernels at fine nodes and at nodes, to others.
    pub(super) fn forces(kernels: [&KernelArrays; 2], rows: &mut Vec<f64>) -> Self {
        let row = Self::push(kernels, rows);
        let (fine, nodes) = rows[row.start..].split_at_mut(3 * row.counts[0]);
        widely(
            #[inline(always)]
            || {
                force_factors(kernels[0], 1.0, fine);
                force_factors(kernels[1], -1.0, nodes);
            },
        );
        row
    }

    /// Adds the row of the double layer, for derivatives of the position at the fine nodes and the nodes times their
    /// weights.
    pub(super) fn stresses(kernels: [&KernelArrays; 2], tangents: &[Vectors; 2], rows: &mut Vec<f64>) -> Self {
        let row = Self::push(kernels, rows);
        let (fine, nodes) = rows[row.start..].split_at_mut(3 * row.counts[0]);
        widely(
            #[inline(always)]
            || {
                stress_factors(kernels[0], &tangents[0], 1.0, fine);
                stress_factors(kernels[1], &tangents[1], -1.0, nodes);
            },
        );
        row
    }

    /// Returns the product with the values at the fine nodes and the nodes of the source.
    pub(super) fn product(&self, rows: &[f64], values: &[Vectors; 2]) -> Complex64 {
        let [fine, nodes] = self.parts(rows);
        let [x, y] = widely(
            #[inline(always)]
            || {
                let [fine, nodes] = [product(fine, &values[0]), product(nodes, &values[1])];
                [fine[0] + nodes[0], fine[1] + nodes[1]]
            },
        );
        Complex64::new(x, y)
    }

    /// Adds the transpose of the row times a force to the flow at fine nodes and nodes.
    pub(super) fn add_transpose(&self, rows: &[f64], force: Complex64, flow: &mut [Vectors; 2]) {
        widely(
            #[inline(always)]
            || self.parts(rows).into_iter().zip(flow).for_each(|(part, flow)| add_transpose(part, force, flow)),
        );
    }
}

/// Returns the three arrays of a range of a row.
#[inline(always)]
fn thirds(part: &[f64]) -> [&[f64]; 3] {
    let n = part.len() / 3;
    [&part[..n], &part[n..2 * n], &part[2 * n..3 * n]]
}

#[inline(always)]
fn thirds_mut(part: &mut [f64]) -> [&mut [f64]; 3] {
    let n = part.len() / 3;
    let (c, rest) = part.split_at_mut(n);
    let (re, im) = rest.split_at_mut(n);
    [c, re, im]
}

/// Writes `sign` times the factors of a force and its conjugate in the single layer, `1/2 - ln|d|` and
/// `1/2 conj(e_1)` with `e_1 = 1 - 2 i dy/d`.
#[inline(always)]
fn force_factors(kernels: &KernelArrays, sign: f64, part: &mut [f64]) {
    let [c, re, im] = thirds_mut(part);
    let n = c.len();
    let KernelArrays { log, dy, c: [first, ..], .. } = kernels;
    let (log, dy, x, y) = (&log[..n], &dy[..n], &first.x[..n], &first.y[..n]);
    let (re, im) = (&mut re[..n], &mut im[..n]);
    for j in 0..n {
        c[j] = sign * (0.5 - log[j]);
        re[j] = sign * (0.5 + dy[j] * y[j]);
        im[j] = sign * (dy[j] * x[j]);
    }
}

/// Writes `sign` times the factors of a velocity and its conjugate in the double layer of elements t,
/// `-2 Im(t c_1)` and `i (t conj(c_1) - conj(t e_2))` with `e_2 = c_1 - 2 i dy c_2`.
#[inline(always)]
fn stress_factors(kernels: &KernelArrays, tangents: &Vectors, sign: f64, part: &mut [f64]) {
    let [c, re, im] = thirds_mut(part);
    let n = c.len();
    let KernelArrays { dy, c: [first, second, _], .. } = kernels;
    let (dy, x, y, x2, y2) = (&dy[..n], &first.x[..n], &first.y[..n], &second.x[..n], &second.y[..n]);
    let (re, im, tx, ty) = (&mut re[..n], &mut im[..n], &tangents.x[..n], &tangents.y[..n]);
    for j in 0..n {
        let (tx, ty) = (sign * tx[j], sign * ty[j]);
        let (ex, ey) = (x[j] + 2.0 * dy[j] * y2[j], y[j] - 2.0 * dy[j] * x2[j]);
        c[j] = -2.0 * (tx * y[j] + ty * x[j]);
        re[j] = -(ty * x[j] - tx * y[j] + tx * ey + ty * ex);
        im[j] = tx * x[j] + ty * y[j] - (tx * ex - ty * ey);
    }
}

#[inline(always)]
fn product(part: &[f64], values: &Vectors) -> [f64; 2] {
    const LANES: usize = 8;
    let chunks = |values| <[f64]>::as_chunks::<LANES>(values);
    let [c, re, im] = thirds(part).map(chunks);
    let [x, y] = [&values.x, &values.y].map(|values| chunks(&values[..part.len() / 3]));
    let term = |c: f64, re: f64, im: f64, x: f64, y: f64| [(c + re) * x + im * y, im * x + (c - re) * y];
    let (mut along, mut across) = ([0.0; LANES], [0.0; LANES]);
    for ((((c, re), im), x), y) in c.0.iter().zip(re.0).zip(im.0).zip(x.0).zip(y.0) {
        for lane in 0..LANES {
            let [u, v] = term(c[lane], re[lane], im[lane], x[lane], y[lane]);
            along[lane] += u;
            across[lane] += v;
        }
    }
    let mut sum = [along.iter().sum::<f64>(), across.iter().sum()];
    for j in 0..c.1.len() {
        let [u, v] = term(c.1[j], re.1[j], im.1[j], x.1[j], y.1[j]);
        sum = [sum[0] + u, sum[1] + v];
    }
    sum
}

#[inline(always)]
fn add_transpose(part: &[f64], force: Complex64, flow: &mut Vectors) {
    let [c, re, im] = thirds(part);
    let n = c.len();
    let (x, y) = (&mut flow.x[..n], &mut flow.y[..n]);
    for j in 0..n {
        x[j] += (c[j] + re[j]) * force.re + im[j] * force.im;
        y[j] += im[j] * force.re + (c[j] - re[j]) * force.im;
    }
}
