//! Truncation along a closed curve to its lowest modes.

use crate::{FourierError, PeriodicSeries, spectrum};

/// Truncates periodic samples of a vector to the wave numbers |m| <= (modes - 1)/2, in place and without allocation.
///
/// Where the flow is resolved by fewer modes than a body has markers, the body passes the velocities of its markers
/// through this, so that nothing moves in a way that the flow does not see.
#[derive(Debug, Clone)]
pub struct BandLimit {
    series: PeriodicSeries,
    modes: usize,
}

impl BandLimit {
    /// A plan for `len` samples of which `modes` modes are kept: all of them where there are as many or more, at least
    /// the mean.
    #[must_use]
    pub fn new(len: usize, modes: usize) -> Self {
        Self { series: PeriodicSeries::new(len), modes }
    }

    /// Number of samples.
    #[must_use]
    pub fn len(&self) -> usize {
        self.series.len()
    }

    /// Whether there are no samples.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.series.is_empty()
    }

    /// Number of modes kept.
    #[must_use]
    pub fn modes(&self) -> usize {
        self.modes
    }

    /// Truncates `values`.
    ///
    /// # Errors
    /// Another number of values than planned for; they are then left as they were.
    pub fn apply<V: Copy + Into<[f64; 2]> + From<[f64; 2]>>(&mut self, values: &mut [V]) -> Result<(), FourierError> {
        self.series.analyse_vectors(values)?;
        if self.modes >= self.len() {
            return Ok(());
        }
        let largest = spectrum::largest_wave(self.modes);
        self.series.scale(|m| if m <= largest { 1.0 } else { 0.0 });
        self.series.write_vectors(values)
    }
}

#[cfg(test)]
mod tests;
