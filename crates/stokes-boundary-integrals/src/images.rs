//! Regions with a known Green's function: the plane, periodic boxes and channels, and their periodic images.

use motile_base::{InputError, Region, boxes::Periods, within};
use num_complex::Complex64;

use crate::Settings;

/// Refuses regions of bad numbers, and boxes that are too slender.
pub(crate) fn check(region: &Region) -> Result<(), InputError> {
    region.check()?;
    if let Region::Box { lengths: [lx, ly] } = *region {
        within("the ratio of the periods", lx.max(ly) / lx.min(ly), 1.0, Settings::LARGEST_PERIOD_RATIO)?;
    }
    Ok(())
}

/// Periodic images, those above being displaced along x in a box that is sheared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Images {
    pub(crate) periods: Periods,
}

impl Images {
    /// Creates the periodic images of a region, of a box after a shear strain (no dimension), put back by whole
    /// periods.
    pub(crate) fn of(region: &Region, strain: f64) -> Self {
        let lengths = region.periods();
        let tilt = if let [Some(lx), Some(ly)] = lengths {
            let shift = strain * ly;
            shift - lx * (shift / lx).round()
        } else {
            0.0
        };
        Self { periods: Periods { lengths, tilt } }
    }

    /// Returns the displacement along x of the images above (length).
    pub(crate) fn tilt(&self) -> f64 {
        self.periods.tilt
    }

    /// Returns the area of a box (length squared), infinite otherwise.
    pub(crate) fn area(&self) -> f64 {
        let [x, y] = self.periods.lengths;
        x.zip(y).map_or(f64::INFINITY, |(x, y)| x * y)
    }

    /// Returns a vector that differs from d by periods, of at most half a period along y and half a period along x.
    pub(crate) fn wrap(&self, d: Complex64) -> Complex64 {
        let [x, y] = self.periods.lengths;
        let count = |value: f64, period: Option<f64>| period.map_or(0.0, |p| (value / p).round());
        let rows = count(d.im, y);
        let along = d.re - self.tilt() * rows;
        Complex64::new(along - x.map_or(0.0, |p| p * count(along, x)), d.im - y.map_or(0.0, |p| p * rows))
    }

    /// Returns the zero, and the vectors to the neighbouring images (length); without those along x for an open curve,
    /// which has its own.
    pub(crate) fn shifts(&self, open: bool) -> impl Iterator<Item = Complex64> + use<> {
        let steps = |period: Option<f64>| {
            let p = period.unwrap_or(0.0);
            let count = if period.is_some() { 3 } else { 1 };
            [(0.0, 0.0), (p, 1.0), (-p, -1.0)].into_iter().take(count)
        };
        let ([x, y], tilt) = (self.periods.lengths, self.periods.tilt);
        let x = if open { None } else { x };
        steps(x).flat_map(move |(dx, _)| steps(y).map(move |(dy, row)| Complex64::new(dx + row * tilt, dy)))
    }
}
