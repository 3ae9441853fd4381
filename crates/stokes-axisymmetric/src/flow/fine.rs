//! Surfaces at multiples of their resolution, for many targets close to them.

use std::f64::consts::PI;

use motile_base::Vec2;

use super::{
    meridian::{Grid, Meridian},
    panels::{FAR, Spot},
    ring::{Ring, Wanted},
    waves::{Pair, Point, Waves, dot},
};

/// Powers of two by which nodes are multiplied: targets are then as close as .7 spacings of the nodes.
const LEVELS: usize = 3;

/// A node of a finer quadrature.
#[derive(Debug, Clone, Copy)]
pub(super) struct FineNode {
    /// Weight in an integral over the parameter.
    pub(super) weight: f64,
    pub(super) point: Point,
    /// Force per parameter and azimuth (force).
    pub(super) force: Vec2,
    /// Unknown of the surface.
    pub(super) density: Vec2,
}

impl FineNode {
    /// Returns the ring of the node, as the target sees it.
    pub(super) fn ring(&self, spot: &Spot, wanted: Wanted) -> Ring {
        Ring::new(self.point.place - spot.place, spot.place.y, self.point.place.y, wanted)
    }
}

/// Finer nodes of a surface, made where they are first wanted. They take a few milliseconds, and each target then as
/// long as so many rings, a tenth of the time of panels, whose points need the series of the surface.
#[derive(Debug, Default)]
pub(super) struct Levels([Option<Vec<FineNode>>; LEVELS]);

impl Levels {
    /// Returns the nodes that integrate to round-off at a spot. It is `None` if the nodes of the surface do, or if none
    /// of these does.
    pub(super) fn at(
        &mut self,
        spot: &Spot,
        (grid, meridian): (&Grid, &Meridian),
        density: Option<&Pair>,
    ) -> Option<&[FineNode]> {
        let distance = spot.gap / (FAR * meridian.spacing);
        let level = (0..LEVELS).find(|level| distance * f64::from(2 << level) > 1.0).filter(|_| distance <= 1.0)?;
        Some(self.0[level].get_or_insert_with(|| nodes(grid, meridian, density, 2 << level)))
    }
}

/// So many times the nodes of a surface.
fn nodes(grid: &Grid, meridian: &Meridian, density: Option<&Pair>, times: usize) -> Vec<FineNode> {
    let count = times * grid.nodes;
    let mut waves = Waves::new(count + 1);
    let node = |j: usize| {
        waves.fill(PI * (j as f64 + 0.5) / count as f64);
        FineNode {
            weight: Grid::weight(count, &waves),
            point: meridian.at(&waves),
            force: meridian.force_of(&waves),
            density: density
                .map_or(Vec2::ZERO, |Pair { cos, sin }| Vec2::new(dot(cos, &waves.cos), dot(sin, &waves.sin))),
        }
    };
    (0..count).map(node).collect()
}
