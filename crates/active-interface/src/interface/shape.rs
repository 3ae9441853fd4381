//! Markers and the geometry of the curve through them, polygon or smooth.

use motile_base::Vec2;

use super::{geometry::Geometry, spectral::SpectralCurve};

/// Markers of a closed curve, or of one period of a curve that is periodic along x, with the geometry of the curve
/// through them.
#[derive(Debug, Clone, Default)]
pub(crate) struct Shape {
    /// Positions (length), counter-clockwise, or with the inside to the left.
    pub(crate) markers: Vec<Vec2>,
    /// Advance along x from the first marker to its next image (length), zero for a closed curve.
    pub(crate) advance: f64,
    pub(crate) geometry: Geometry,
    /// True for the meridian of a surface of revolution with its mirror image.
    pub(crate) axisymmetric: bool,
    /// Count of computations of the geometry, for tests.
    pub(crate) evaluations: usize,
}

impl Shape {
    /// Returns true if the markers are at exactly these positions (x and y of each).
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

    /// Computes the geometry of the smooth curve if there is one for as many markers, else the geometry of the polygon.
    pub(crate) fn update(&mut self, spectral: Option<&mut SpectralCurve>) {
        self.evaluations += 1;
        match spectral.filter(|spectral| spectral.len() == self.markers.len()) {
            Some(spectral) => {
                spectral.update(&self.markers, self.advance, &mut self.geometry);
                if self.axisymmetric {
                    spectral.update_rings(&self.markers, &mut self.geometry);
                }
            }
            None => self.geometry.update(&self.markers, self.advance),
        }
    }
}
