//! Swings between turning points: amplitude, growth and period of a lateral motion.

use super::extrema::turns;
use super::regression::{Solution, line};
use super::{Estimate, Extremum};

/// Fewest swings that show a trend: through two there is always an exponential.
pub(super) const FEWEST_SWINGS: usize = 3;
/// Number of swings that the tail of a motion starts from, if there are that many: two periods.
const USUAL_SWINGS: usize = 4;
/// Root mean square scatter of the logarithm of the amplitude, 0.5 %, up to which a tail counts as exponential: turning
/// points from about ten samples per period are known to about that.
const SCATTER: f64 = 5e-3;

/// Swings from each turning point to the next one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Swings {
    /// Turning points, one more than swings.
    turns: Vec<Extremum>,
    /// Times halfway between turning points.
    times: Vec<f64>,
    /// Half the heights of the swings (length).
    pub(super) amplitudes: Vec<f64>,
    /// Heights halfway between turning points (length).
    pub(super) midlines: Vec<f64>,
}

/// Last swings of a motion, in which the amplitude is exponential in time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Tail {
    /// Index of the first swing of the tail.
    pub(super) start: usize,
    /// Growth rate of the amplitude (1/time).
    pub(super) growth_rate: Estimate,
    /// Period (time).
    pub(super) period: Estimate,
}

impl Swings {
    pub(super) fn new(turns: Vec<Extremum>) -> Self {
        let pairs = || turns.windows(2).map(|pair| (pair[0], pair[1]));
        let times = pairs().map(|(a, b)| 0.5 * (a.time + b.time)).collect();
        let amplitudes = pairs().map(|(a, b)| 0.5 * (b.height - a.height).abs()).collect();
        let midlines = pairs().map(|(a, b)| 0.5 * (a.height + b.height)).collect();
        Self { turns, times, amplitudes, midlines }
    }

    pub(super) fn len(&self) -> usize {
        self.amplitudes.len()
    }

    /// Returns the number of times that the amplitude turns from growth to decay or back, by more than a fifth.
    pub(super) fn wavering(&self) -> usize {
        let logarithms: Vec<f64> = self.amplitudes.iter().map(|a| a.ln()).collect();
        turns(&logarithms, 1.2_f64.ln()).len()
    }

    /// Returns the longest tail of at least three swings whose amplitude is exponential in time; `None` for fewer
    /// swings.
    pub(super) fn tail(&self) -> Option<Tail> {
        let count = self.len();
        if count < FEWEST_SWINGS {
            return None;
        }
        let logarithms: Vec<f64> = self.amplitudes.iter().map(|a| a.ln()).collect();
        let trend = |start: usize| line(&self.times[start..], &logarithms[start..]);
        let mut start = count - USUAL_SWINGS.min(count);
        let (_, mut growth_rate, scatter) = trend(start)?;
        let limit = SCATTER.max(1.5 * scatter);
        while start > 0
            && let Some((_, longer, rms)) = trend(start - 1)
            && rms <= limit
        {
            (start, growth_rate) = (start - 1, longer);
        }
        Some(Tail { start, growth_rate, period: self.period(start)? })
    }

    /// Returns the period P from the times of the turning points from index `start` on, `t_k = a +- b + k P/2`: rise
    /// and fall may take different times.
    fn period(&self, start: usize) -> Option<Estimate> {
        let turns = &self.turns[start..];
        let first = turns.first()?.time;
        let column = |entry: fn(usize) -> f64| (0..turns.len()).map(entry).collect();
        let columns = vec![column(|_| 1.0), column(|k| 0.5 * k as f64), column(|k| 1.0 - 2.0 * (k % 2) as f64)];
        let data: Vec<f64> = turns.iter().map(|turn| turn.time - first).collect();
        Some(Solution::new(columns, &data)?.estimate(1))
    }
}

#[cfg(test)]
mod tests;
