//! Curves by nodes of equally spaced parameters: closed ones, and open ones that continue periodically along x.

use std::f64::consts::TAU;

use motile_base::{
    InputError, Vec2,
    internal::spectrum::{copy_band, differentiate, largest_wave},
    same_length,
};
use num_complex::Complex64;

use crate::{
    LayerError, Settings,
    calculus::MOST_POINTS,
    error::finite_vectors,
    greens::{GreensFunction, Vectors, half_turns},
    transforms::{REFINEMENT, Transform, Transforms},
};
use motile_base::{Region, internal::widely};

/// Shape and force of a curve at equally spaced parameters, as complex numbers x + i y.
#[derive(Debug, Clone, Default)]
pub(crate) struct Samples {
    /// Positions relative to the curve's centre (length).
    pub(crate) position: Vec<Complex64>,
    /// Positions as arrays of components.
    pub(crate) arrays: Vectors,
    /// Derivative of the position by the parameter (length).
    pub(crate) tangent: Vec<Complex64>,
    /// Force per parameter times the weight 2 pi/number (force).
    pub(crate) force: Vec<Complex64>,
    /// exp(i k z/2) and its inverse at the fine nodes of an open curve with the wave number k.
    pub(crate) half_turns: Vec<[Complex64; 2]>,
}

impl Samples {
    /// Computes all samples from Fourier coefficients of shape and force, the shape advancing by `period` (length) in a
    /// turn; `second`, where it is given, becomes the second derivative of the position.
    fn fill(
        &mut self,
        transform: &mut Transform,
        [shape, force]: [&[Complex64]; 2],
        period: Complex64,
        second: Option<&mut Vec<Complex64>>,
    ) {
        let len = transform.len();
        for values in [&mut self.position, &mut self.tangent] {
            values.resize(len, Complex64::default());
        }
        copy_band(shape, &mut self.position, largest_wave(shape.len()));
        self.tangent.copy_from_slice(&self.position);
        differentiate(&mut self.tangent);
        if let Some(second) = second {
            second.clone_from(&self.tangent);
            differentiate(second);
            transform.inverse(second);
        }
        transform.inverse(&mut self.position);
        transform.inverse(&mut self.tangent);
        for (j, (position, tangent)) in self.position.iter_mut().zip(&mut self.tangent).enumerate() {
            *position += period * (j as f64 / len as f64 - 0.5);
            *tangent += period / TAU;
        }
        self.arrays.fill(&self.position);
        self.fill_force(transform, force);
    }

    /// Computes the forces from the Fourier coefficients of the force per parameter.
    fn fill_force(&mut self, transform: &mut Transform, force: &[Complex64]) {
        let len = transform.len();
        self.force.resize(len, Complex64::default());
        copy_band(force, &mut self.force, largest_wave(force.len()));
        transform.inverse(&mut self.force);
        let weight = TAU / len as f64;
        self.force.iter_mut().for_each(|force| *force *= weight);
    }
}

/// A curve given by points of equally spaced parameters: point k of n belongs to the parameter 2 pi k/n.
#[derive(Debug, Clone, Copy)]
pub struct LayerCurve<'a> {
    /// Points, at least as many as there are nodes (length); a closed curve runs counter-clockwise.
    pub positions: &'a [Vec2],
    /// Advance of the curve in a turn of the parameter (length): zero for a closed one, plus or minus the period of the
    /// region along x for an open one.
    pub period: Vec2,
    /// Nodes ([`Settings::NODES`]), equally spaced in the parameter.
    pub nodes: usize,
}

impl LayerCurve<'_> {
    /// Refuses too few or too many nodes of the curve or wall of that number.
    pub(crate) fn check_nodes(&self, kind: &'static str, curve: usize) -> Result<(), LayerError> {
        let ([least, most], what, found) = (Settings::NODES, "nodes", self.nodes);
        let inside = (least..=most).contains(&found);
        if inside { Ok(()) } else { Err(LayerError::Count { kind, curve, what, found, least, most }) }
    }
}

/// A curve with shape and force at its nodes and, where they are needed, at fine nodes. In each turn of the parameter
/// it advances by its period, which is zero if it is closed.
#[derive(Debug, Clone, Default)]
pub(crate) struct Curve {
    /// Mean of the nodes (length), as given, not wrapped.
    pub(crate) centre: Complex64,
    /// Advance in a turn (length), zero for a closed curve.
    pub(crate) period: Complex64,
    /// Largest distance of a node from the centre (length).
    pub(crate) radius: f64,
    pub(crate) nodes: Samples,
    /// Curvature at the nodes (1/length), positive for a circle.
    pub(crate) curvature: Vec<f64>,
    /// Fourier coefficients of the position relative to the centre (length), the linear advance subtracted.
    pub(crate) shape: Vec<Complex64>,
    /// Fourier coefficients of the force per parameter (force).
    pub(crate) force: Vec<Complex64>,
    pub(crate) fine: Samples,
    /// True once the fine nodes belong to the present shape.
    refined: bool,
    /// Samples of the present shape finer than the fine nodes, for the images in a wall that is close, and a density of
    /// the double layer there; used where `factor` is above [`REFINEMENT`].
    finer: Samples,
    finer_density: Vec<Complex64>,
    /// Nodes in place of each node that the images in walls are summed over.
    factor: usize,
    /// Second derivative of the position by the parameter at the nodes (length).
    second: Vec<Complex64>,
    /// Largest distance between neighbouring nodes along the curve (length).
    spacing: f64,
    /// Number of points that the curve was given by.
    pub(crate) points: usize,
    /// Number of the plan for so many nodes.
    pub(crate) plan: usize,
}

impl Curve {
    pub(crate) fn new(nodes: usize) -> Self {
        let zeros = vec![Complex64::default(); nodes];
        Self { curvature: vec![0.0; nodes], shape: zeros.clone(), force: zeros, ..Self::default() }
    }

    pub(crate) fn len(&self) -> usize {
        self.shape.len()
    }

    /// Returns the weight of a node in an integral over the parameter.
    pub(crate) fn weight(&self) -> f64 {
        TAU / self.len() as f64
    }

    /// Returns the nodes or the fine nodes.
    pub(crate) fn samples(&self, fine: bool) -> &Samples {
        if fine { &self.fine } else { &self.nodes }
    }

    /// Returns the samples that images in walls are summed over: the nodes, or the fine nodes and where these are too
    /// far apart for the gap finer ones.
    pub(crate) fn wall_samples(&self, fine: bool) -> &Samples {
        if fine && self.factor > REFINEMENT { &self.finer } else { self.samples(fine) }
    }

    /// Returns the density of the double layer at the samples of [`Curve::wall_samples`] other than nodes, `fine` being
    /// that at the fine nodes.
    pub(crate) fn wall_density<'a>(&'a self, fine: &'a [Complex64]) -> &'a [Complex64] {
        if self.factor > REFINEMENT { &self.finer_density } else { fine }
    }

    /// Returns true for an open curve, which continues periodically.
    pub(crate) fn is_open(&self) -> bool {
        self.period.re != 0.0
    }

    /// Returns the Green's function of the curve with its continuation: for an open curve, of a row of images.
    pub(crate) fn greens(&self) -> GreensFunction {
        if self.is_open() { GreensFunction::Row { k: TAU / self.period.re.abs() } } else { GreensFunction::Free }
    }

    /// Returns the shortest vector that differs from d by periods of an open curve.
    #[inline(always)]
    pub(crate) fn wrap(&self, d: Complex64) -> Complex64 {
        if self.is_open() { d - self.period * nearest_integer(d.re / self.period.re) } else { d }
    }

    /// Writes the squared distances of the nodes from a point (length squared), an open curve with its images, and
    /// returns the least.
    pub(crate) fn squares_from(&self, point: Complex64, out: &mut [f64]) -> f64 {
        let (x, y) = (&self.nodes.arrays.x[..out.len()], &self.nodes.arrays.y[..out.len()]);
        // A closed curve has no images.
        let (period, turns) = if self.is_open() { (self.period.re, 1.0 / self.period.re) } else { (0.0, 0.0) };
        widely(
            #[inline(always)]
            || {
                for ((x, y), out) in x.iter().zip(y).zip(&mut *out) {
                    let (dx, dy) = (x - point.re, y - point.im);
                    let dx = dx - period * nearest_integer(dx * turns);
                    *out = dx * dx + dy * dy;
                }
                let (chunks, rest) = out.as_chunks::<8>();
                let mut least = [f64::INFINITY; 8];
                for chunk in chunks {
                    for (least, square) in least.iter_mut().zip(chunk) {
                        *least = if square < least { *square } else { *least };
                    }
                }
                least.iter().chain(rest).copied().fold(f64::INFINITY, f64::min)
            },
        )
    }

    /// Takes over positions and forces (none if they are given later), truncated to the modes that the nodes carry.
    ///
    /// # Errors
    /// Returns an error for:
    /// * lists of different length, fewer points than nodes, numbers that are not finite, an advance that is not the
    ///   period of the region, a clockwise curve,
    /// * they name the curve by the number `curve`.
    pub(crate) fn load(
        &mut self,
        transforms: &mut Transforms,
        (LayerCurve { positions, period, .. }, forces): (LayerCurve<'_>, &[Vec2]),
        region: &Region,
        curve: usize,
    ) -> Result<(), LayerError> {
        if !forces.is_empty() {
            same_length("the forces on a curve", positions.len(), forces.len())?;
        }
        let (found, least, most) = (positions.len(), self.len(), MOST_POINTS as usize);
        if !(least..=most).contains(&found) {
            return Err(LayerError::Count { kind: "curve", curve, what: "points", found, least, most });
        }
        let expected = region.periods()[0].unwrap_or(0.0);
        if period != Vec2::ZERO && (period.y != 0.0 || expected == 0.0 || period.x.abs() != expected) {
            return Err(LayerError::period(curve, period, expected));
        }
        finite_vectors("the position", curve, positions)?;
        finite_vectors("the force", curve, forces)?;
        self.points = positions.len();
        self.period = Complex64::new(period.x, period.y);
        transforms.analyse(positions, self.period, &mut self.shape)?;
        self.centre = std::mem::take(&mut self.shape[0]) + 0.5 * self.period;
        if forces.is_empty() {
            self.force.fill(Complex64::default());
        } else {
            transforms.analyse(forces, Complex64::default(), &mut self.force)?;
        }
        let per_parameter = positions.len() as f64 / TAU;
        self.force.iter_mut().for_each(|force| *force *= per_parameter);
        let Self { nodes, shape, force, second, .. } = self;
        nodes.fill(&mut transforms.nodes, [shape, force], self.period, Some(second));
        for ((curvature, first), second) in self.curvature.iter_mut().zip(&nodes.tangent).zip(second) {
            let square = first.norm_sqr();
            *curvature = (first.conj() * *second).im / (square * square.sqrt());
        }
        self.radius = self.nodes.position.iter().map(Complex64::norm_sqr).fold(0.0, f64::max).sqrt();
        self.spacing = self.weight() * self.nodes.tangent.iter().map(Complex64::norm_sqr).fold(0.0, f64::max).sqrt();
        self.refined = false;
        self.factor = 1;
        if self.is_open() || self.signed_area() > 0.0 { Ok(()) } else { Err(LayerError::Clockwise { curve }) }
    }

    /// Computes shape and force at the fine nodes, once for each shape.
    pub(crate) fn refine(&mut self, transforms: &mut Transforms) {
        if !self.refined {
            self.fine.fill(&mut transforms.fine, [&self.shape, &self.force], self.period, None);
            if let GreensFunction::Row { k } = self.greens() {
                self.fine.half_turns.clear();
                self.fine.half_turns.extend(self.fine.position.iter().map(|z| half_turns(*z, k)));
            }
            self.refined = true;
        }
    }

    /// Sums images in walls over so many nodes in place of each node from now on: a number above the number of fine
    /// nodes takes samples between them.
    pub(crate) fn refine_for_walls(&mut self, transforms: &mut Transforms, factor: usize) -> Result<(), InputError> {
        self.factor = factor;
        if factor > REFINEMENT {
            self.finer.fill(transforms.finer(factor)?, [&self.shape, &self.force], self.period, None);
        }
        Ok(())
    }

    /// Takes over a density of the double layer at the nodes, x then y, for the images in walls.
    pub(crate) fn set_wall_density(&mut self, transforms: &mut Transforms, values: &[f64]) {
        if self.factor > REFINEMENT {
            self.finer_density.resize(self.factor * self.len(), Complex64::default());
            // The transform is there since the samples were taken, so that this cannot fail.
            let _ = transforms.at_finer(self.factor, values, &mut self.finer_density);
        }
    }

    /// Takes over forces at the nodes, x then y; with `fine`, at the fine nodes too.
    pub(crate) fn set_forces(&mut self, transforms: &mut Transforms, values: &[f64], fine: bool) {
        let (x, y) = values.split_at(self.len());
        for ((force, x), y) in self.nodes.force.iter_mut().zip(x).zip(y) {
            *force = Complex64::new(*x, *y);
        }
        self.force.copy_from_slice(transforms.coefficients(values));
        let per_node = 1.0 / self.weight();
        self.force.iter_mut().for_each(|force| *force *= per_node);
        if fine {
            self.refine_forces(transforms);
        }
    }

    /// Computes the forces at the fine nodes, and the shape there unless it is known.
    pub(crate) fn refine_forces(&mut self, transforms: &mut Transforms) {
        if self.refined {
            self.fine.fill_force(&mut transforms.fine, &self.force);
        }
        if self.factor > REFINEMENT
            && let Ok(transform) = transforms.finer(self.factor)
        {
            self.finer.fill_force(transform, &self.force);
        }
        self.refine(transforms);
    }

    /// Returns the signed area (length squared), positive for a counter-clockwise curve.
    fn signed_area(&self) -> f64 {
        let terms = self.nodes.position.iter().zip(&self.nodes.tangent);
        0.5 * self.weight() * terms.map(|(z, t)| (z.conj() * t).im).sum::<f64>()
    }

    /// Returns the arc length (length), over one period for an open curve.
    pub(crate) fn perimeter(&self) -> f64 {
        self.weight() * self.nodes.tangent.iter().map(|t| t.norm_sqr().sqrt()).sum::<f64>()
    }

    /// Returns the largest distance between neighbouring nodes along the curve (length).
    pub(crate) fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Returns true for a point, relative to the centre, inside the polygon through the fine nodes of a closed curve.
    pub(crate) fn polygon_contains(&self, point: Complex64) -> bool {
        let corners = &self.fine.position;
        let sides = corners.iter().zip(corners.iter().cycle().skip(1));
        let right = |(a, b): &(&Complex64, &Complex64)| {
            (a.im > point.im) != (b.im > point.im)
                && point.re < a.re + (b.re - a.re) * (point.im - a.im) / (b.im - a.im)
        };
        sides.filter(right).count() % 2 == 1
    }

    /// Returns true for a point, relative to the centre and some spacings away from the curve, that lies on its left:
    /// its winding number by Cauchy's formula.
    pub(crate) fn winds_around(&self, point: Complex64) -> bool {
        let greens = self.greens();
        let terms = self.nodes.position.iter().zip(&self.nodes.tangent);
        let sum: f64 = terms.map(|(z, tangent)| (tangent * greens.at(z - point).c[0]).im).sum();
        // An open curve turns half way around what is on its left, and half way the other way around the rest.
        sum * self.weight() > if self.is_open() { 0.0 } else { 0.5 * TAU }
    }
}

/// Returns the integer nearest to a number far below 2^51, without a branch or a call: in the sum with 1.5 2^52 nothing
/// is left of the digits behind the point.
#[inline(always)]
fn nearest_integer(x: f64) -> f64 {
    const SHIFT: f64 = 6_755_399_441_055_744.0;
    (x + SHIFT) - SHIFT
}
