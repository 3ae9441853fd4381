//! Correlations of pairs over their distance.

use std::f64::consts::PI;

use motile_base::{Region, Vec2, boxes::Periods};

/// Pair correlation and correlation of velocities over the distance, averaged over any number of states in a box or a
/// channel.
///
/// ```
/// use motile_analysis::suspension::PairAverages;
/// use motile_base::{Region, Vec2};
///
/// let mut pairs = PairAverages::new(&Region::Box { lengths: [4.0, 4.0] }, 0.5, 4.0);
/// pairs.add(&[Vec2::ZERO, Vec2::new(1.2, 0.0)], &[Vec2::X, Vec2::X]);
/// let found = pairs.correlations();
/// // The only pair is in the third bin, whose part of the area is pi (1.5^2 - 1) / 16.
/// assert_eq!((found.distances.len(), found.distances[2], found.velocities[2]), (4, 1.25, 1.0));
/// assert!((found.pairs[2] - 16.0 / (1.25 * std::f64::consts::PI)).abs() < 1e-12);
/// ```
#[derive(Debug, Clone)]
pub struct PairAverages {
    lengths: [f64; 2],
    periods: Periods,
    bin: f64,
    /// Pairs in the bins, and sums of the products of their velocities.
    counts: Vec<f64>,
    products: Vec<f64>,
    /// Pairs in all, and the mean square velocities of the states, summed with the number of pairs as weights.
    pairs: f64,
    squares: f64,
}

/// Correlations over the distance of the centres of pairs.
#[derive(Debug, Clone, PartialEq)]
pub struct PairCorrelations {
    /// Middles of the bins (length).
    pub distances: Vec<f64>,
    /// Pair correlation g: pairs in the bin over the pairs of independent places in the region (no dimension).
    pub pairs: Vec<f64>,
    /// Mean of `v_i v_j` over the mean of `v_i v_i` (no dimension); not a number in bins without pairs.
    pub velocities: Vec<f64>,
}

impl PairAverages {
    /// Averages over bins of a width up to a reach (length), or half of the shortest period where that is less.
    #[must_use]
    pub fn new(region: &Region, bin: f64, reach: f64) -> Self {
        let periods: Periods = region.periods().into();
        let reach = periods.iter().flatten().fold(reach, |reach, period| reach.min(0.5 * period));
        let count = if bin > 0.0 { (reach / bin * (1.0 + 1e-12)).floor() as usize } else { 0 };
        let (counts, products) = (vec![0.0; count], vec![0.0; count]);
        Self { lengths: region.lengths(), periods, bin, counts, products, pairs: 0.0, squares: 0.0 }
    }

    /// Adds a state: the places (length) and velocities (length per time) of all droplets.
    pub fn add(&mut self, places: &[Vec2], velocities: &[Vec2]) {
        let count = places.len().min(velocities.len());
        for (k, (place, velocity)) in places[..count].iter().zip(velocities).enumerate() {
            for (other, of_other) in places[..k].iter().zip(velocities) {
                let distance = self.periods.wrap(*place - *other).length();
                if let Some(number) = self.counts.get_mut((distance / self.bin) as usize) {
                    *number += 1.0;
                    self.products[(distance / self.bin) as usize] += velocity.dot(*of_other);
                }
            }
        }
        let pairs = 0.5 * (count * count.saturating_sub(1)) as f64;
        let squares: f64 = velocities[..count].iter().map(|velocity| velocity.length_squared()).sum();
        self.pairs += pairs;
        self.squares += pairs * squares / count.max(1) as f64;
    }

    /// Returns the averages so far.
    #[must_use]
    pub fn correlations(&self) -> PairCorrelations {
        let ends = |bin: usize| [bin as f64, (bin + 1) as f64].map(|k| k * self.bin);
        let bins = 0..self.counts.len();
        let expected = |bin: usize| self.pairs * self.share(ends(bin));
        let mean = self.squares / self.pairs;
        PairCorrelations {
            distances: bins.clone().map(|bin| (bin as f64 + 0.5) * self.bin).collect(),
            pairs: bins.clone().map(|bin| self.counts[bin] / expected(bin)).collect(),
            velocities: bins.map(|bin| self.products[bin] / self.counts[bin] / mean).collect(),
        }
    }

    /// Returns the part of the pairs of independent places whose distance is between two (length). In a channel of the
    /// length L and the width W its density is `r / (L W^2)` times the integral of `W - r |sin a|`, where positive,
    /// over all angles.
    fn share(&self, [from, to]: [f64; 2]) -> f64 {
        let [length, width] = self.lengths;
        let ring = PI * (to * to - from * from);
        if self.periods[1].is_some() {
            return ring / (length * width);
        }
        if to <= width {
            return (width * ring - 4.0 / 3.0 * (to.powi(3) - from.powi(3))) / (length * width * width);
        }
        let r = 0.5 * (from + to);
        let sine = (width / r).min(1.0);
        let angles = 4.0 * (width * sine.asin() - r * (1.0 - (1.0 - sine * sine).sqrt()));
        r * angles * (to - from) / (length * width * width)
    }
}
