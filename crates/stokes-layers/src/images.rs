//! Regions with a known Green's function: the plane, periodic boxes and channels, and their periodic images.

use motile_base::{InputError, Region, within};
use num_complex::Complex64;

/// Largest ratio of the periods of a box: the rows of images of a pair of nodes grow in proportion to it, to 60 at a
/// tolerance of 1e-8.
const LARGEST_RATIO: f64 = 20.0;

/// Refuses regions of bad numbers, and boxes that are too slender.
pub(crate) fn check(region: &Region) -> Result<(), InputError> {
    region.check()?;
    if let Region::Box { lengths: [lx, ly] } = *region {
        within("the ratio of the periods", lx.max(ly) / lx.min(ly), 1.0, LARGEST_RATIO)?;
    }
    Ok(())
}

/// Periodic images: the periods in x and y (length), where there are any.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Images {
    pub(crate) periods: [Option<f64>; 2],
}

impl Images {
    /// The periodic images of a region.
    pub(crate) fn of(region: &Region) -> Self {
        Self { periods: region.periods() }
    }

    /// Area of a box (length squared), infinite otherwise.
    pub(crate) fn area(&self) -> f64 {
        let [x, y] = self.periods;
        x.zip(y).map_or(f64::INFINITY, |(x, y)| x * y)
    }

    /// Shortest vector that differs from d by periods.
    pub(crate) fn wrap(&self, d: Complex64) -> Complex64 {
        let wrap = |value: f64, period: Option<f64>| period.map_or(value, |p| value - p * (value / p).round());
        Complex64::new(wrap(d.re, self.periods[0]), wrap(d.im, self.periods[1]))
    }

    /// Zero, and the vectors to the neighbouring images (length).
    pub(crate) fn shifts(&self) -> impl Iterator<Item = Complex64> + use<> {
        let steps = |period: Option<f64>| {
            let p = period.unwrap_or(0.0);
            let count = if period.is_some() { 3 } else { 1 };
            [0.0, p, -p].into_iter().take(count)
        };
        let [x, y] = self.periods;
        steps(x).flat_map(move |dx| steps(y).map(move |dy| Complex64::new(dx, dy)))
    }
}
