//! The single layer of several curves as an operator on forces that are given after the positions.

use motile_base::{Vec2, positive, same_length, within};

use crate::{
    LayerError, Symmetry, curve::LayerCurve, density::Density, error::finite_vectors, layer::Layers, sample::Sampler,
};
use motile_base::{FlowSample, Region};

const FOUR_PI: f64 = 4.0 * std::f64::consts::PI;
/// Largest number of pairs of nodes: the three components of their Stokeslets, half of which follow by symmetry, then
/// take 800 MB.
const MOST_PAIRS: f64 = 6.7e7;

/// Single layer of several curves with each other, `u = 1/(4 pi) sum G F`: a symmetric operator that takes forces F
/// (force) at the nodes to viscosity times velocity there (force per length in 2D).
///
/// Curves may have different numbers of nodes, be closed or open, and come as close to each other as their nodes
/// resolve the film between them. The [crate's page](crate) has the method. [`SingleLayer::load`] computes the matrix,
/// [`SingleLayer::apply`] a product with it, and [`SingleLayer::sample`] the flow of the forces of the last product
/// anywhere. Vectors have x then y of all nodes of the first curve, then of the second, and so on. While the numbers of
/// curves and nodes stay the same, nothing is allocated.
///
/// In a box, whose mean velocity is zero, forces that do not add up to zero are balanced by a uniform pressure
/// gradient.
///
/// A wave of forces on a straight line, `f = e_x cos(k x)` per length, moves it with `u = f/(4 k eta)` far from
/// everything else:
///
/// ```
/// use motile_base::{Drive, Region, Vec2};
/// use stokes_boundary_integrals::{LayerCurve, SingleLayer, Symmetry};
///
/// # fn main() -> Result<(), stokes_boundary_integrals::LayerError> {
/// let (length, nodes) = (std::f64::consts::TAU, 32);
/// let region = Region::Channel { length, width: 40.0, drive: Drive::default() };
/// let x = |i: usize| length * i as f64 / nodes as f64;
/// let positions: Vec<Vec2> = (0..nodes).map(|i| Vec2::new(x(i), 0.0)).collect();
/// let forces: Vec<f64> =
///     (0..2 * nodes).map(|i| if i < nodes { x(i).cos() * length / nodes as f64 } else { 0.0 }).collect();
///
/// let mut layer = SingleLayer::new(region, 1e-10, Symmetry::ToResolution)?;
/// layer.load([LayerCurve { positions: &positions, period: Vec2::new(length, 0.0), nodes }].into_iter())?;
/// let mut out = vec![0.0; 2 * nodes];
/// layer.apply(&forces, &mut out)?;
/// assert!((0..nodes).all(|i| (out[i] - 0.25 * x(i).cos()).abs() < 1e-10));
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone)]
#[doc(alias("Stokeslet", "Oseen tensor", "Green function", "boundary integral"))]
pub struct SingleLayer {
    layers: Layers,
    sampler: Sampler,
}

impl SingleLayer {
    /// Creates the single layer of a region, with images, modes of walls and quadrature for close nodes to a relative
    /// `tolerance`.
    ///
    /// # Errors
    /// Returns an error for lengths of the region that are not positive and finite, periods of which one is more than
    /// 20 times the other, a tolerance outside of 1e-15 to 1e-3.
    pub fn new(region: Region, tolerance: f64, symmetry: Symmetry) -> Result<Self, LayerError> {
        if region.is_axisymmetric() {
            return Err(LayerError::in_three_dimensions());
        }
        Ok(Self { layers: Layers::new(region, tolerance, symmetry)?, sampler: Sampler::new(tolerance) })
    }

    /// Takes over curves, truncated to the modes that their nodes carry, and computes the layer between all nodes.
    ///
    /// # Errors
    /// Returns an error for:
    /// * fewer than 16 or more than 4096 nodes of a curve, more than about 8000 in all,
    /// * positions that are not finite, too few or too many points, a clockwise closed curve, an open one whose advance
    ///   is not the period along x, a node beyond a wall.
    pub fn load<'a>(&mut self, curves: impl Iterator<Item = LayerCurve<'a>> + Clone + Send) -> Result<(), LayerError> {
        let mut total = 0.0;
        for (number, curve) in curves.clone().enumerate() {
            curve.check_nodes("curve", number)?;
            total += curve.nodes as f64;
        }
        within("the number of pairs of nodes", total * total, 0.0, MOST_PAIRS)?;
        self.layers.load(&curves.map(|curve| (curve, [].as_slice())), true)?;
        self.layers.single_layer(false);
        Ok(())
    }

    /// Returns the entries of a curve in vectors over all nodes, x of its nodes then y; none if there is no such curve.
    #[must_use]
    pub fn entries(&self, curve: usize) -> std::ops::Range<usize> {
        if curve < self.layers.curves.len() { self.layers.entries(curve) } else { 0..0 }
    }

    /// Returns the number of entries of vectors over all nodes, twice the number of nodes.
    #[must_use]
    pub fn entry_count(&self) -> usize {
        2 * self.layers.starts[self.layers.curves.len()]
    }

    /// Writes the viscosity times velocity (force per length in 2D) at all nodes for forces (force) there: the force
    /// per length times the arc length that belongs to the node. All fluid has the same viscosity.
    ///
    /// # Errors
    /// Returns an error for slices of another length than there are entries, or forces that are not finite.
    pub fn apply(&mut self, forces: &[f64], out: &mut [f64]) -> Result<(), LayerError> {
        same_length("the forces", self.entry_count(), forces.len())?;
        same_length("out", self.entry_count(), out.len())?;
        motile_base::internal::all_finite("the forces", forces)?;
        self.layers.stored_layer(forces);
        out.fill(0.0);
        for curve in 0..self.layers.curves.len() {
            self.layers.add_flow(curve, 1.0 / FOUR_PI, &mut out[self.layers.entries(curve)]);
        }
        Ok(())
    }

    /// Writes the flow at points anywhere in fluid of the given viscosity (stress times time), for the forces of the
    /// last product.
    ///
    /// # Errors
    /// Returns an error for points that are not finite, slices of different length, a viscosity that is not positive
    /// and finite.
    pub fn sample(&mut self, viscosity: f64, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), LayerError> {
        same_length("out", points.len(), out.len())?;
        finite_vectors("the position", 0, points)?;
        positive("the viscosity", viscosity)?;
        self.layers.refine_stored();
        self.sampler.sample(&mut self.layers, Density::NONE, points, out, |_| viscosity, |_| None)?;
        Ok(())
    }

    /// Writes the normals to the right of a curve, outward for a closed one, times the arc length that belongs to the
    /// node (length), laid out like forces: the forces of a unit pressure on the left of the curve, which move nothing.
    ///
    /// # Errors
    /// Returns an error if there is no such curve, or for a slice of another length than twice its number of nodes.
    pub fn normals(&self, curve: usize, out: &mut [f64]) -> Result<(), LayerError> {
        same_length("out", self.entries(curve).len(), out.len())?;
        let Some(curve) = self.layers.curves.get(curve) else { return Ok(()) };
        let (x, y) = out.split_at_mut(curve.len());
        for ((x, y), tangent) in x.iter_mut().zip(y).zip(&curve.nodes.tangent) {
            (*x, *y) = (tangent.im * curve.weight(), -tangent.re * curve.weight());
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
