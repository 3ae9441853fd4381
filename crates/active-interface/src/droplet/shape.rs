//! Marker positions with their geometry, computed once for each state.

use ib_core::Vec2;

use super::geometry::Geometry;
use super::spectral::SpectralCurve;

/// A closed curve of markers and its geometry.
#[derive(Debug, Clone, Default)]
pub(crate) struct Shape {
    /// Positions (length), counter-clockwise.
    pub(crate) markers: Vec<Vec2>,
    pub(crate) geometry: Geometry,
    /// How often the geometry was computed.
    pub(crate) evaluations: usize,
}

impl Shape {
    /// Whether the markers are at these positions (x and y of each), bit by bit.
    pub(crate) fn is_at(&self, positions: &[f64]) -> bool {
        let same = |marker: &Vec2, pair: &[f64]| {
            [marker.x.to_bits(), marker.y.to_bits()] == [pair[0], pair[1]].map(f64::to_bits)
        };
        2 * self.markers.len() == positions.len()
            && self.markers.iter().zip(positions.chunks_exact(2)).all(|(marker, pair)| same(marker, pair))
    }

    /// Moves the markers to these positions, unless they are there.
    pub(crate) fn move_to(&mut self, positions: &[f64], spectral: Option<&mut SpectralCurve>) {
        if !self.is_at(positions) {
            self.markers.clear();
            self.markers.extend(positions.chunks_exact(2).map(|pair| Vec2::new(pair[0], pair[1])));
            self.update(spectral);
        }
    }

    /// Computes the geometry: that of the smooth curve, or that of the polygon.
    pub(crate) fn update(&mut self, spectral: Option<&mut SpectralCurve>) {
        self.evaluations += 1;
        match spectral.filter(|spectral| spectral.len() == self.markers.len()) {
            Some(spectral) => spectral.update(&self.markers, &mut self.geometry),
            None => self.geometry.update(&self.markers),
        }
    }
}
