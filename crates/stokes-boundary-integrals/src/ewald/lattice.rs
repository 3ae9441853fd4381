//! The lattice of a box, its images above displaced along x where it is sheared, and the coordinates along its sides.

use std::f64::consts::TAU;

use crate::images::Images;

/// Periods of a box and the displacement of its images above.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Lattice {
    pub(super) lengths: [f64; 2],
    /// Displacement along x over that along y.
    pub(super) slope: f64,
    /// Largest such slope of a box that is sheared, which grids and cells are made for.
    pub(super) steepest: f64,
}

impl Lattice {
    /// Creates the lattice of a box; of a channel in a box that is `height` high; none without a period along x.
    pub(super) fn of(images: &Images, height: f64) -> Option<Self> {
        let [Some(lx), ly] = images.periods.lengths else { return None };
        let ly = ly.unwrap_or(height);
        let steepest = if images.tilt() == 0.0 { 0.0 } else { 0.5 * lx / ly };
        Some(Self { lengths: [lx, ly], slope: images.tilt() / ly, steepest })
    }

    /// Returns the factor by which the extent of a disc along a side exceeds its diameter.
    pub(super) fn stretch(&self) -> f64 {
        self.steepest.hypot(1.0)
    }

    /// Returns the parts of the periods from the lower left corner to a place, each between 0 and 1.
    #[inline(always)]
    pub(super) fn parts(&self, x: f64, y: f64) -> [f64; 2] {
        let [lx, ly] = self.lengths;
        let part = |value: f64| {
            let part = value - value.floor();
            // Less than round-off below zero.
            if part < 1.0 { part } else { 0.0 }
        };
        [part((x - self.slope * y) / lx), part(y / ly)]
    }

    /// Returns the wave vector of a mode.
    #[inline(always)]
    pub(super) fn wave(&self, [m, n]: [f64; 2]) -> [f64; 2] {
        let kx = TAU * m / self.lengths[0];
        [kx, TAU * n / self.lengths[1] - self.slope * kx]
    }

    pub(super) fn area(&self) -> f64 {
        self.lengths[0] * self.lengths[1]
    }
}
