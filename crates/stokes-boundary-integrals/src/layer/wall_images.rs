//! Images of layers in the two walls of a channel, in closed form, for curves that are close to a wall.
//!
//! The flow that one no-slip wall adds to a flow is known from that flow at the mirror image of the target (Lorentz's
//! reflection). Let d be the source minus the image of the target, and s the distances of both from the wall. With the
//! kernels l = `ln|2 sin(k d/2)|` and c_1, c_2, c_3 of a row of images along the wall, a force F adds
//!
//! ```text
//! (l - 1/2 + 2 s_t s_s c_2) F  +  (-1/2 - i dy conj(c_1) + 2 i s_t Re c_1) conj(F)
//! ```
//!
//! and a double layer of the velocity q on the element T
//!
//! ```text
//! (2 Im(T c_1) - 4 i s_t Im(T) c_2 + 8 i s_t s_s T c_3) q
//!     +  (2 Im(T) conj(c_1) - 2 s_s conj(T c_2) - 2 s_t T c_2) conj(q)
//! ```
//!
//! where y points from the wall into the fluid. The flow that the image in one wall has at the other wall decays over
//! the width of the channel. So a few modes correct it, however narrow gaps are
//! ([`Uncorrected::Images`](crate::greens::walls::Uncorrected)). An image that is close to a curve gets the quadrature
//! of [`CloseWeights`](crate::close_weights::CloseWeights).

use std::f64::consts::TAU;

use motile_base::internal::{spectrum::copy_band, spectrum::largest_wave, widely};
use num_complex::Complex64;

use crate::{
    close_weights::{CloseWeights, KernelArrays},
    curve::{Curve, Samples},
    density::Density,
    greens::{Vectors, ln},
    plan::Plan,
    transforms::REFINEMENT,
};

const I: Complex64 = Complex64::new(0.0, 1.0);

/// Sources in one pass of a loop.
const LANES: usize = 4;

/// Nodes of all curves for one wall.
#[derive(Debug, Clone, Default)]
struct Side {
    /// exp(i k x - k s), real and imaginary parts.
    re: Vec<f64>,
    im: Vec<f64>,
    /// Distance from the wall (length).
    depth: Vec<f64>,
}

/// Mirror image of a node that is close to a curve.
#[derive(Debug, Clone, Copy)]
struct CloseImage {
    /// Number of the node among all.
    target: usize,
    /// 0 for the upper wall.
    wall: usize,
    curve: usize,
    /// Position of the image relative to the centre of the curve (length).
    point: Complex64,
    /// Distance of the node from the wall (length).
    depth: f64,
}

/// Factors of a force or velocity and of its conjugate.
#[derive(Debug, Clone, Copy, Default)]
struct Factors {
    plain: Complex64,
    conjugate: Complex64,
}

impl Factors {
    /// Returns the factors in the coordinates of the channel, from the coordinates that have y point away from a wall.
    fn of_wall(self, wall: usize) -> Self {
        if wall == 0 { Self { plain: self.plain.conj(), conjugate: self.conjugate.conj() } } else { self }
    }

    fn times(self, value: Complex64) -> Complex64 {
        self.plain * value + self.conjugate * value.conj()
    }
}

/// Images in both walls of the nodes of all curves, for the present positions.
#[derive(Debug, Clone)]
pub(crate) struct WallImages {
    /// 2 pi/period (1/length).
    k: f64,
    half: f64,
    /// Upper wall, lower wall.
    sides: [Side; 2],
    /// The first node of each curve, and their number, which the arrays are filled up to a multiple of the lanes.
    starts: Vec<usize>,
    /// Forces, or velocities times contrast, x and y.
    values: Vectors,
    close: Vec<CloseImage>,
    squares: Vec<f64>,
    /// Factors by which velocities at nodes act on the flow at nodes, a row for each target: xx, xy, yx, yy.
    matrix: Vec<f64>,
    /// True once the matrix belongs to the present positions.
    has_matrix: bool,
    /// Elements of the curves at the nodes (length).
    elements: Vec<Complex64>,
    fine: [Vec<Complex64>; 2],
    coarse: [Vec<Complex64>; 2],
}

impl WallImages {
    pub(crate) fn new(period: f64, half: f64) -> Self {
        let (sides, starts, values, close, squares) = Default::default();
        let (matrix, elements, fine, coarse) = Default::default();
        Self {
            k: TAU / period,
            half,
            sides,
            starts,
            values,
            close,
            squares,
            matrix,
            has_matrix: false,
            elements,
            fine,
            coarse,
        }
    }

    /// Takes over the present shapes, and finds the images that are closer to a curve than `reach` spacings.
    pub(crate) fn load(&mut self, curves: &[Curve], reach: f64) {
        let Self { k, half, sides, starts, close, squares, .. } = self;
        starts.clear();
        starts.push(0);
        for side in &mut *sides {
            side.re.clear();
            side.im.clear();
            side.depth.clear();
        }
        close.clear();
        self.has_matrix = false;
        let period = TAU / *k;
        for curve in curves {
            for z in &curve.nodes.position {
                let z = z + curve.centre;
                for (side, sign) in sides.iter_mut().zip([1.0, -1.0]) {
                    let depth = *half - sign * z.im;
                    let turn = Complex64::cis(*k * z.re) * (-*k * depth).exp();
                    side.re.push(turn.re);
                    side.im.push(turn.im);
                    side.depth.push(depth);
                }
            }
            starts.push(sides[0].re.len());
        }
        for (number, curve) in curves.iter().enumerate() {
            let within = reach * curve.spacing();
            squares.resize(curve.len(), 0.0);
            let targets = curves.iter().flat_map(|curve| curve.nodes.position.iter().map(|z| z + curve.centre));
            for (target, z) in targets.enumerate() {
                for (wall, sign) in [(0, 1.0), (1, -1.0)] {
                    let depth = sides[wall].depth[target];
                    if depth > within {
                        continue;
                    }
                    let image = Complex64::new(z.re, sign * (*half + depth)) - curve.centre;
                    let image = image - period * (image.re / period).round();
                    let shifts: &[f64] = if curve.is_open() { &[0.0] } else { &[0.0, 1.0, -1.0] };
                    for shift in shifts {
                        let point = image + period * shift;
                        let far = !curve.is_open() && point.norm_sqr() >= (curve.radius + within).powi(2);
                        if !far && curve.squares_from(point, squares) < within * within {
                            close.push(CloseImage { target, wall, curve: number, point, depth });
                        }
                    }
                }
            }
        }
        for side in sides {
            let len = side.re.len().next_multiple_of(LANES);
            side.re.resize(len, 0.0);
            side.im.resize(len, 0.0);
            side.depth.resize(len, 0.0);
        }
    }

    /// Returns the curves that images are close to, once for each image.
    pub(crate) fn sources(&self) -> impl Iterator<Item = usize> {
        self.close.iter().map(|image| image.curve)
    }

    /// Adds the images of the single layers of all curves, whose forces at fine nodes are ready.
    pub(crate) fn add_forces(&mut self, curves: &[Curve], plans: &mut [Plan], reach: f64, out: &mut [Vectors]) {
        let Self { k, sides, starts, values, close, .. } = self;
        let len = sides[0].re.len();
        values.clear(len);
        let forces = curves.iter().flat_map(|curve| &curve.nodes.force);
        for ((x, y), force) in values.x.iter_mut().zip(&mut values.y).zip(forces) {
            (*x, *y) = (force.re, force.im);
        }
        for (number, out) in out.iter_mut().enumerate().take(curves.len()) {
            for node in 0..starts[number + 1] - starts[number] {
                let target = starts[number] + node;
                let [upper, lower] = [0, 1].map(|wall: usize| {
                    widely(
                        #[inline(always)]
                        || force_sums(&sides[wall], *k, target, values),
                    )
                });
                out.x[node] += upper[0] + lower[0] + (lower[1] - upper[1]);
                out.y[node] += upper[3] + lower[3] + (lower[2] - upper[2]);
            }
        }
        for image in close {
            let curve = &curves[image.curve];
            let weights = &mut plans[curve.plan].weights;
            let place = weights.place(curve, image.point, reach);
            weights.fill::<2>(curve, &place);
            let mut flow = -CloseWeights::modal(weights.polar, &curve.force);
            for ((kernels, fine), sign) in weights.arrays().into_iter().zip([true, false]).zip([1.0, -1.0]) {
                let samples = curve.samples(fine);
                let mut sum = Complex64::default();
                for (j, force) in samples.force.iter().enumerate() {
                    let source = depth_of(samples, j, curve, self.half, image.wall);
                    sum += force_factors(kernels, j, image, source).times(*force);
                }
                flow += sign * sum;
            }
            let number = starts.partition_point(|start| *start <= image.target) - 1;
            out[number].x[image.target - starts[number]] += flow.re;
            out[number].y[image.target - starts[number]] += flow.im;
        }
    }

    /// Adds the images of the double layer.
    pub(crate) fn add_dipoles(
        &mut self,
        curves: &[Curve],
        plans: &mut [Plan],
        reach: f64,
        density: Density<'_>,
        out: &mut [Vectors],
    ) {
        if !self.has_matrix {
            self.fill_matrix(curves, plans, reach);
            self.has_matrix = true;
        }
        let Self { sides, starts, values, matrix, .. } = self;
        let len = sides[0].re.len();
        values.clear(len);
        for number in 0..density.contrasts.len() {
            let (contrast, (x, y)) = (density.contrast(number), density.of(number));
            let range = starts[number]..starts[number + 1];
            for (to, from) in [(&mut values.x, x), (&mut values.y, y)] {
                to[range.clone()].iter_mut().zip(from).for_each(|(to, from)| *to = contrast * from);
            }
        }
        let mut rows = matrix.chunks_exact(4 * len);
        for (number, out) in out.iter_mut().enumerate().take(curves.len()) {
            for (node, row) in (0..starts[number + 1] - starts[number]).zip(&mut rows) {
                let [u, v] = widely(
                    #[inline(always)]
                    || product(row, values),
                );
                out.x[node] += u;
                out.y[node] += v;
            }
        }
    }

    /// Computes the factors of velocities.
    fn fill_matrix(&mut self, curves: &[Curve], plans: &mut [Plan], reach: f64) {
        let Self { k, half, sides, starts, matrix, elements, close, fine: [plain, conjugate], coarse, .. } = self;
        let len = sides[0].re.len();
        matrix.clear();
        matrix.resize(4 * len * starts[curves.len()], 0.0);
        elements.clear();
        for curve in curves {
            elements.extend(curve.nodes.tangent.iter().map(|tangent| tangent * curve.weight()));
        }
        for (target, row) in matrix.chunks_exact_mut(4 * len).enumerate() {
            for (wall, side) in sides.iter().enumerate() {
                let base = Complex64::new(side.re[target], -side.im[target]);
                for (source, element) in elements.iter().enumerate() {
                    let rest = 1.0 / (1.0 - base * Complex64::new(side.re[source], side.im[source]));
                    let first = -I * *k * (rest - 0.5);
                    let second = -*k * *k * rest * (rest - 1.0);
                    let kernels = [first, second, first * second];
                    let factors = dipole_factors(kernels, *element, wall, side.depth[target], side.depth[source]);
                    add_factors(row, source, factors.of_wall(wall), 1.0);
                }
            }
        }
        for image in &*close {
            let curve = &curves[image.curve];
            let Plan { weights, transforms, .. } = &mut plans[curve.plan];
            let place = weights.place(curve, image.point, reach);
            weights.fill::<3>(curve, &place);
            let [fine, nodes] = weights.arrays();
            let row = &mut matrix[4 * len * image.target..4 * len * (image.target + 1)];
            let factors = |kernels: &KernelArrays, samples: &Samples, j: usize| {
                let element = samples.tangent[j] * (TAU / samples.tangent.len() as f64);
                let source = depth_of(samples, j, curve, *half, image.wall);
                let c = kernels_of(kernels, j, image.wall).1;
                dipole_factors(c, element, image.wall, image.depth, source).of_wall(image.wall)
            };
            plain.clear();
            conjugate.clear();
            for j in 0..REFINEMENT * curve.len() {
                let factors = factors(fine, &curve.fine, j);
                plain.push(factors.plain);
                conjugate.push(factors.conjugate);
            }
            // Factors of the nodes: the factors of the fine nodes times the interpolation from the nodes.
            for (values, coarse) in [&mut *plain, &mut *conjugate].into_iter().zip(&mut *coarse) {
                transforms.fine.inverse(values);
                coarse.resize(curve.len(), Complex64::default());
                copy_band(values, coarse, largest_wave(curve.len()));
                transforms.nodes.forward(coarse);
            }
            let [plain, conjugate] = &*coarse;
            for (j, (&plain, &conjugate)) in plain.iter().zip(conjugate).enumerate() {
                let source = starts[image.curve] + j;
                add_factors(row, source, Factors { plain, conjugate }, 1.0);
                add_factors(row, source, factors(nodes, &curve.nodes, j), -1.0);
            }
        }
    }
}

/// Returns the distance of a source from a wall (length).
fn depth_of(samples: &Samples, j: usize, curve: &Curve, half: f64, wall: usize) -> f64 {
    let height = samples.position[j].im + curve.centre.im;
    if wall == 0 { half - height } else { half + height }
}

/// Returns l, c_1 to c_3 and dy in coordinates that have y point away from a wall.
fn kernels_of(kernels: &KernelArrays, j: usize, wall: usize) -> (f64, [Complex64; 3], f64) {
    let c = [0, 1, 2].map(|order| Complex64::new(kernels.c[order].x[j], kernels.c[order].y[j]));
    if wall == 0 { (kernels.log[j], c.map(|c| c.conj()), -kernels.dy[j]) } else { (kernels.log[j], c, kernels.dy[j]) }
}

/// Returns the factors of a force at a distance `source` (length) from the wall.
fn force_factors(kernels: &KernelArrays, j: usize, image: &CloseImage, source: f64) -> Factors {
    let (log, [first, second, _], dy) = kernels_of(kernels, j, image.wall);
    let plain = log - 0.5 + 2.0 * image.depth * source * second;
    let conjugate = -0.5 - I * dy * first.conj() + 2.0 * I * image.depth * first.re;
    Factors { plain, conjugate }.of_wall(image.wall)
}

/// Returns the factors of a velocity on an element of the curve, for the distances of target and source from the wall
/// (length), in coordinates that have y point away from the wall.
fn dipole_factors([c1, c2, c3]: [Complex64; 3], element: Complex64, wall: usize, target: f64, source: f64) -> Factors {
    let element = if wall == 0 { -element.conj() } else { element };
    let turn = element * c2;
    let plain = 2.0 * (element * c1).im + 4.0 * I * target * (2.0 * source * element * c3 - element.im * c2);
    let conjugate = 2.0 * (element.im * c1.conj() - source * turn.conj() - target * turn);
    Factors { plain, conjugate }
}

/// Adds factors to a row of the matrix.
fn add_factors(row: &mut [f64], source: usize, Factors { plain, conjugate }: Factors, sign: f64) {
    let len = row.len() / 4;
    let (sum, difference) = (plain + conjugate, plain - conjugate);
    for (part, value) in [sum.re, -difference.im, sum.im, difference.re].into_iter().enumerate() {
        row[part * len + source] += sign * value;
    }
}

/// Returns the sums over all sources of the factors xx, xy, yx and yy times the components of the forces.
#[inline(always)]
fn force_sums(side: &Side, k: f64, target: usize, values: &Vectors) -> [f64; 4] {
    let n = side.re.len();
    let Side { re, im, depth } = side;
    let (re, im, depth) = (&re[..n], &im[..n], &depth[..n]);
    let (x, y) = (&values.x[..n], &values.y[..n]);
    let (base_re, base_im, own) = (re[target], im[target], depth[target]);
    let [mut xx, mut xy, mut yx, mut yy] = [[0.0; LANES]; 4];
    for first in (0..n).step_by(LANES) {
        for lane in 0..LANES {
            let j = first + lane;
            // q = exp(i k d), and r = 1/(1 - q).
            let gap_re = 1.0 - (re[j] * base_re + im[j] * base_im);
            let gap_im = re[j] * base_im - im[j] * base_re;
            let square = gap_re * gap_re + gap_im * gap_im;
            let inverse = 1.0 / square;
            let (r_re, r_im) = (gap_re * inverse, -gap_im * inverse);
            let along = own + depth[j];
            let bend = -2.0 * own * depth[j] * (k * k);
            let plain_re = 0.5 * ln(square) + 0.5 * k * along - 0.5 + bend * (r_re * r_re - r_im * r_im - r_re);
            let plain_im = bend * (r_im * (2.0 * r_re - 1.0));
            let conjugate_re = k * along * (r_re - 0.5) - 0.5;
            let conjugate_im = k * r_im * (own - depth[j]);
            xx[lane] += (plain_re + conjugate_re) * x[j];
            xy[lane] += (conjugate_im - plain_im) * y[j];
            yx[lane] += (plain_im + conjugate_im) * x[j];
            yy[lane] += (plain_re - conjugate_re) * y[j];
        }
    }
    [xx, xy, yx, yy].map(|lanes| lanes.iter().sum())
}

#[inline(always)]
fn product(row: &[f64], values: &Vectors) -> [f64; 2] {
    let n = row.len() / 4;
    let [xx, xy, yx, yy] = [0, 1, 2, 3].map(|part| &row[part * n..(part + 1) * n]);
    let (x, y) = (&values.x[..n], &values.y[..n]);
    let [mut along, mut across] = [[0.0; LANES]; 2];
    for first in (0..n).step_by(LANES) {
        for lane in 0..LANES {
            let j = first + lane;
            along[lane] += xx[j] * x[j] + xy[j] * y[j];
            across[lane] += yx[j] * x[j] + yy[j] * y[j];
        }
    }
    [along, across].map(|lanes| lanes.iter().sum())
}

#[cfg(test)]
mod tests;
