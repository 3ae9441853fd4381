//! The single layer of several curves as an operator on forces that come later.

use input_checks::{positive, same_length, within};

use crate::{
    FlowSample, Geometry, LayerError, Vec2,
    curve::GivenCurve,
    interface_flow::{LARGEST_RATIO, finite_vectors, flow_samples},
    layer::{Density, Layers},
};

const FOUR_PI: f64 = 4.0 * std::f64::consts::PI;
/// Most pairs of nodes whose Stokeslets are stored: they then take 1.6 GB.
const MOST_PAIRS: f64 = 6.7e7;

/// A curve for a [`SingleLayer`] as points of equally spaced parameters: point k of n belongs to the parameter
/// 2 pi k/n.
#[derive(Debug, Clone, Copy)]
pub struct LayerCurve<'a> {
    /// Points, at least as many as there are nodes (length); a closed curve runs counter-clockwise.
    pub positions: &'a [Vec2],
    /// How far the curve goes on in a turn of the parameter (length): zero for a closed one, plus or minus the period
    /// of the region along x for an open one.
    pub period: Vec2,
    /// Nodes, 16 to 4096, equally spaced in the parameter.
    pub nodes: usize,
}

/// How corrections for nodes close to another curve are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reciprocity {
    /// In each direction by itself: velocities are spectrally accurate at every node. The operator is symmetric to the
    /// accuracy to which the nodes resolve the forces.
    Accurate,
    /// At the nodes of the curve whose nodes are closer together, of two with the same spacing those of the first one;
    /// the other curve gets the transpose. The operator is symmetric to round-off and accurate for what moves with the
    /// nodes' smooth fields, such as power.
    Exact,
}

/// The single layer of several curves with each other, `u = 1/(4 pi) sum G F`, as a symmetric operator that takes
/// forces F (force) at the nodes to viscosity times velocity there.
///
/// Curves may have different numbers of nodes, be closed or open, and come as close to each other as their nodes
/// resolve what is between them; see the [crate's page](crate) for the method. [`SingleLayer::load`] computes what the
/// positions decide, [`SingleLayer::apply`] is then a product, and [`SingleLayer::sample`] the flow of the forces of
/// the last product anywhere. Vectors have x then y of all nodes of the first curve, then of the second, and so on.
/// While the numbers of curves and nodes stay the same nothing is allocated.
///
/// In a box, whose mean velocity is zero, forces that do not add up to zero are balanced by a uniform pressure
/// gradient.
///
/// A wave of forces on a straight line, `f = e_x cos(k x)` per length, moves it with `u = f/(4 k eta)` far from
/// everything else:
///
/// ```
/// use stokes_layers::{Forcing, Geometry, LayerCurve, Reciprocity, SingleLayer, Vec2};
///
/// # fn main() -> Result<(), stokes_layers::LayerError> {
/// let (length, nodes) = (std::f64::consts::TAU, 32);
/// let geometry = Geometry::Channel { length, width: 40.0, forcing: Forcing::default() };
/// let x = |i: usize| length * i as f64 / nodes as f64;
/// let positions: Vec<Vec2> = (0..nodes).map(|i| Vec2::new(x(i), 0.0)).collect();
/// let forces: Vec<f64> =
///     (0..2 * nodes).map(|i| if i < nodes { x(i).cos() * length / nodes as f64 } else { 0.0 }).collect();
///
/// let mut layer = SingleLayer::new(geometry, 1e-10, Reciprocity::Accurate)?;
/// layer.load([LayerCurve { positions: &positions, period: Vec2::new(length, 0.0), nodes }].into_iter())?;
/// let mut out = vec![0.0; 2 * nodes];
/// layer.apply(&forces, &mut out)?;
/// assert!((0..nodes).all(|i| (out[i] - 0.25 * x(i).cos()).abs() < 1e-10));
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone)]
pub struct SingleLayer {
    layers: Layers,
}

impl SingleLayer {
    /// For a region; images, modes of walls and quadrature for close nodes are right to the tolerance.
    ///
    /// # Errors
    /// Lengths of the region that are not positive and finite, periods of which one is more than 20 times the other, a
    /// tolerance outside of 1e-15 to 1e-3.
    pub fn new(geometry: Geometry, tolerance: f64, reciprocity: Reciprocity) -> Result<Self, LayerError> {
        geometry.check()?;
        if let Geometry::Box { lengths: [lx, ly] } = geometry {
            within("the ratio of the periods", lx.max(ly) / lx.min(ly), 1.0, LARGEST_RATIO)?;
        }
        within("the tolerance", tolerance, 1e-15, 1e-3)?;
        Ok(Self { layers: Layers::new(geometry, tolerance, reciprocity == Reciprocity::Exact)? })
    }

    /// Takes over curves, truncated to the modes that their nodes carry, and computes the layer between all nodes.
    ///
    /// # Errors
    /// Fewer than 16 or more than 4096 nodes, more than some 8000 in all; positions that are not finite, too few or too
    /// many points, a clockwise closed curve, an open one that goes on by something else than the period along x, a
    /// node beyond a wall.
    pub fn load<'a>(&mut self, curves: impl Iterator<Item = LayerCurve<'a>> + Clone) -> Result<(), LayerError> {
        let mut total = 0.0;
        for LayerCurve { nodes, .. } in curves.clone() {
            within("the number of nodes", nodes as f64, 16.0, 4096.0)?;
            total += nodes as f64;
        }
        within("the number of pairs of nodes", total * total, 0.0, MOST_PAIRS)?;
        let given = |LayerCurve { positions, period, nodes }| GivenCurve { positions, forces: None, period, nodes };
        self.layers.load(curves.map(given), true)?;
        self.layers.single_layer(false);
        Ok(())
    }

    /// Number of curves.
    #[must_use]
    pub fn len(&self) -> usize {
        self.layers.curves.len()
    }

    /// Whether there are no curves.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.layers.curves.is_empty()
    }

    /// The entries of a curve in vectors over all nodes: x of its nodes, then y; none if there is no such curve.
    #[must_use]
    pub fn entries(&self, curve: usize) -> std::ops::Range<usize> {
        if curve < self.len() { self.layers.entries(curve) } else { 0..0 }
    }

    /// Number of entries of vectors over all nodes, twice the number of nodes.
    #[must_use]
    pub fn entry_count(&self) -> usize {
        2 * self.layers.starts[self.len()]
    }

    /// Viscosity times velocity (force per length in 2D) at all nodes for forces (force: those per length times the
    /// length that belongs to the node) there. The viscosity is that of the fluid everywhere.
    ///
    /// # Errors
    /// Slices of another length than there are entries, forces that are not finite.
    pub fn apply(&mut self, forces: &[f64], out: &mut [f64]) -> Result<(), LayerError> {
        same_length("the forces", self.entry_count(), forces.len())?;
        same_length("out", self.entry_count(), out.len())?;
        input_checks::all_finite("the forces", forces)?;
        self.layers.kept_layer(forces);
        let mut first = 0;
        for flow in self.layers.flow() {
            for values in [&flow.x, &flow.y] {
                for (out, value) in out[first..].iter_mut().zip(values) {
                    *out = value / FOUR_PI;
                }
                first += values.len();
            }
        }
        Ok(())
    }

    /// The flow in fluid of the given viscosity (stress times time) at points anywhere, for the forces of the last
    /// product.
    ///
    /// # Errors
    /// Points that are not finite, slices of different length, a viscosity that is not positive and finite.
    pub fn sample(&mut self, viscosity: f64, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), LayerError> {
        same_length("out", points.len(), out.len())?;
        finite_vectors("the position", 0, points)?;
        positive("the viscosity", viscosity)?;
        self.layers.refine_kept();
        flow_samples(&mut self.layers, Density { values: &[], contrasts: &[] }, points, out, |_| viscosity, &[]);
        Ok(())
    }

    /// Outward normals (the right of the curve) times the length that belongs to the node (length), laid out like
    /// forces: the forces of a unit pressure behind an open curve, or inside a closed one, which move nothing.
    ///
    /// # Errors
    /// No such curve, a slice of another length than twice its number of nodes.
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
