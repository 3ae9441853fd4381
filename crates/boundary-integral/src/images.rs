//! Periodic images.

use num_complex::Complex64;

/// The periods in x and y, where there are any.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Images {
    pub(crate) periods: [Option<f64>; 2],
}

impl Images {
    /// The shortest vector that differs from d by periods.
    pub(crate) fn wrap(&self, d: Complex64) -> Complex64 {
        let wrap = |value: f64, period: Option<f64>| period.map_or(value, |p| value - p * (value / p).round());
        Complex64::new(wrap(d.re, self.periods[0]), wrap(d.im, self.periods[1]))
    }

    /// Zero and the vectors to the neighbouring images.
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
