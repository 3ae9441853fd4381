//! Triangular mesh inside a droplet that follows the interface.

mod ring;

use std::f64::consts::{PI, TAU};

use motile_base::{PeriodicSeries, Vec2, internal::at_least, positive, within};

use crate::InteriorError;
use ring::{Ring, RingValues};

/// Growth of the spacing from one ring to the next inner one, up to the spacing asked for, if none is given.
pub(crate) const GROWTH: f64 = 1.25;
/// Distance of rings over the spacing of their nodes: the height sqrt(3)/2 of equilateral triangles.
const HEIGHT: f64 = 0.866_025_403_784_438_6;
/// Largest number of nodes.
const MOST_NODES: usize = 1 << 17;

/// Triangulation of the inside of a closed curve of M markers: the first M nodes are the markers, the others lie on
/// rings within.
///
/// Inner nodes lie where the harmonic map takes them that has the markers' positions on the boundary of the unit disc.
/// A node at radius r and angle a of the disc lies at `SUM_k r^|k| x_k exp(i k a)`, x_k the Fourier coefficients of the
/// markers, |k| < M/2. The mesh therefore has no separate state, moves as smoothly as the interface, follows any
/// translation and stretching exactly, and cannot fold inside a convex curve (Rado, Kneser, Choquet), nor inside
/// another one as long as its modes are small.
///
/// ```
/// use motile_interior::DiscMesh;
/// use motile_base::Vec2;
///
/// let mut mesh = DiscMesh::new(64, 0.1)?;
/// let circle = |k: usize| Vec2::from_angle(std::f64::consts::TAU * k as f64 / 64.0);
/// let mut nodes: Vec<Vec2> = (0..mesh.node_count()).map(circle).collect();
/// mesh.place(&mut nodes);
/// println!("{} nodes, {} triangles", mesh.node_count(), mesh.triangles().len()); // 400 and 734
/// assert!(nodes[64..].iter().all(|node| node.length() < 0.95));
/// # Ok::<(), motile_interior::InteriorError>(())
/// ```
#[derive(Debug, Clone)]
pub struct DiscMesh {
    markers: usize,
    nodes: usize,
    triangles: Vec<[usize; 3]>,
    rings: Vec<RingValues>,
    series: PeriodicSeries,
}

impl DiscMesh {
    /// Largest spacing over the radius: the spacing of a mesh of two or three rings.
    pub const COARSEST: f64 = 0.5;

    /// Creates a mesh for a curve of a number of markers, with a spacing that changes inwards from the spacing of the
    /// markers to `spacing`, larger or smaller, in units of the radius of a circle of the curve's length, by a quarter
    /// from ring to ring.
    ///
    /// # Errors
    /// Returns an error for fewer than 8 markers, a spacing that is not positive or above 0.5, more than 131072 nodes.
    pub fn new(markers: usize, spacing: f64) -> Result<Self, InteriorError> {
        Self::graded(markers, spacing, GROWTH)
    }

    /// Creates a mesh as of [`new`](Self::new) whose spacing changes by a factor from ring to ring. With 2 there are
    /// half as many nodes where the markers are much closer than `spacing`, and triangles of sharper angles.
    ///
    /// # Errors
    /// Returns the errors of [`new`](Self::new); a growth below 1 or above 2.
    pub fn graded(markers: usize, spacing: f64, growth: f64) -> Result<Self, InteriorError> {
        at_least("markers", markers, 8)?;
        positive("the spacing of the mesh inside", spacing)?;
        within("the growth of the spacing inside", growth, 1.0, 2.0)?;
        let first = TAU / markers as f64;
        within("the spacing of the mesh inside over the radius", spacing, 0.0, Self::COARSEST)?;
        let estimate = markers as f64 + PI / (HEIGHT * spacing * spacing) + 4.0 * markers as f64;
        if estimate > MOST_NODES as f64 {
            return Err(InteriorError::too_fine(estimate, MOST_NODES));
        }
        let sizes = sizes(first, spacing, growth);
        let (mut triangles, mut rings) = (Vec::new(), Vec::new());
        let mut outer = Ring { start: 0, count: markers, turn: 0.0 };
        for (number, &(radius, spacing)) in sizes.iter().enumerate() {
            let count = ((TAU * radius / spacing).round() as usize).max(3);
            // Half a spacing from ring to ring, so that triangles are closer to equilateral.
            let turn = outer.turn + PI / count as f64;
            let inner = Ring { start: outer.start + outer.count, count, turn };
            stitch(&outer, &inner, &mut triangles);
            rings.push(RingValues::new(&inner, radius, markers)?);
            if number + 1 == sizes.len() {
                let first = inner.start;
                triangles.extend((2..count).map(|k| [first, first + k - 1, first + k]));
            }
            outer = inner;
        }
        Ok(Self { markers, nodes: outer.start + outer.count, triangles, rings, series: PeriodicSeries::new(markers)? })
    }

    /// Returns the number M of markers, which are the first nodes.
    #[must_use]
    pub fn marker_count(&self) -> usize {
        self.markers
    }

    /// Returns the number of nodes, markers among them.
    #[must_use]
    pub fn node_count(&self) -> usize {
        self.nodes
    }

    /// Returns the triangles by the numbers of their nodes, counter-clockwise.
    #[must_use]
    pub fn triangles(&self) -> &[[usize; 3]] {
        &self.triangles
    }

    /// Computes positions (length) or velocities (length per time) of inner nodes from the markers. It fills the
    /// entries after the first M of a list for all nodes. Lists of another length are left as they are.
    pub fn place(&mut self, nodes: &mut [Vec2]) {
        let Some((markers, mut inner)) = nodes.split_at_mut_checked(self.markers) else { return };
        if self.markers + inner.len() != self.nodes || self.series.analyse_vectors(markers).is_err() {
            return;
        }
        for ring in &mut self.rings {
            let (nodes, rest) = inner.split_at_mut(ring.len());
            ring.write(&self.series, nodes);
            inner = rest;
        }
    }
}

/// Returns the radii and spacings of the rings within the unit circle, whose spacing is `first`, towards another
/// spacing; the innermost ring is a triangle.
fn sizes(first: f64, last: f64, growth: f64) -> Vec<(f64, f64)> {
    let (mut spacing, mut depth) = (first, 0.0);
    let mut sizes = Vec::new();
    while 1.0 - depth > spacing {
        spacing = if last < spacing { (spacing / growth).max(last) } else { (growth * spacing).min(last) };
        depth += HEIGHT * spacing;
        sizes.push((depth, spacing));
    }
    // A triangle of side s has the radius s/sqrt(3).
    let fit = (1.0 - spacing / 3.0_f64.sqrt()) / depth;
    sizes.into_iter().map(|(depth, spacing)| (1.0 - fit * depth, spacing)).collect()
}

/// Adds the triangles between two rings, advancing on the ring whose next node comes first.
fn stitch(outer: &Ring, inner: &Ring, triangles: &mut Vec<[usize; 3]>) {
    let (mut i, mut k) = (0, 0);
    // The inner ring's node nearest to the outer one's first.
    let lead = ((outer.turn - inner.turn) * inner.count as f64 / TAU).round();
    let shift = lead.rem_euclid(inner.count as f64) as usize;
    let begin = inner.turn + TAU * lead / inner.count as f64;
    while i < outer.count || k < inner.count {
        let ends = [outer.angle(i + 1), begin + TAU * (k + 1) as f64 / inner.count as f64];
        if k == inner.count || (i < outer.count && ends[0] <= ends[1]) {
            triangles.push([outer.node(i), outer.node(i + 1), inner.node(shift + k)]);
            i += 1;
        } else {
            triangles.push([outer.node(i), inner.node(shift + k + 1), inner.node(shift + k)]);
            k += 1;
        }
    }
}

#[cfg(test)]
mod tests;
