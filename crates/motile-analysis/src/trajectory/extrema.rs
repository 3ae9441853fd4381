//! Turning points of a sampled function.

use std::ops::RangeInclusive;

use motile_base::{internal::all_finite, not_negative, same_length};

use super::regression::Solution;
use crate::AnalysisError;
use crate::error::increasing;

/// A turning point of a lateral motion.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Extremum {
    /// Time of the turning point.
    pub time: f64,
    /// Height above the centre line (length).
    pub height: f64,
    /// `true` for a maximum, `false` for a minimum; they alternate.
    pub is_maximum: bool,
}

/// Returns the turning points of heights y (length) sampled at increasing times. They are maxima and minima in turn,
/// from each of which the motion comes back by more than `hysteresis` (length), so that smaller oscillations do not
/// count. The first and the last sample do not count as turning points.
///
/// Time and height are taken from a quartic fitted to the samples of the upper 5 % of the swing around each, at least
/// five (a parabola near the ends, where there are not as many). For a sine of 7 samples per period they are good to 1
/// % of period and amplitude, of 20 samples to 1e-4. A turn within two or three samples of an end, seen from one side
/// only, is known less well.
///
/// # Errors
/// Returns an error for lists of different length, values that are not finite, times that do not increase, a negative
/// hysteresis.
pub fn extrema(times: &[f64], heights: &[f64], hysteresis: f64) -> Result<Vec<Extremum>, AnalysisError> {
    same_length("the heights", times.len(), heights.len())?;
    increasing("the times", times)?;
    all_finite("the heights", heights)?;
    not_negative("the hysteresis", hysteresis)?;
    let turns = turns(heights, hysteresis);
    Ok((0..turns.len())
        .map(|k| {
            let (index, is_maximum) = turns[k];
            // Rise and fall of the motion on both sides of the turn.
            let before = if k == 0 { 0 } else { turns[k - 1].0 };
            let after = turns.get(k + 1).map_or(heights.len() - 1, |turn| turn.0);
            let swing = |from: usize, to: usize| {
                heights[from..=to].iter().map(|y| (y - heights[index]).abs()).fold(0.0_f64, f64::max)
            };
            let swing = swing(before, index).min(swing(index, after));
            let (time, height) = refine(times, heights, index, before..=after, 0.05 * swing);
            Extremum { time, height, is_maximum }
        })
        .collect())
}

/// Returns the samples at which the motion turns, each with `true` for a maximum.
pub(super) fn turns(heights: &[f64], hysteresis: f64) -> Vec<(usize, bool)> {
    let mut turns = Vec::new();
    // The highest and the lowest sample since the last turn, and which of them the motion is heading for.
    let (mut high, mut low) = (0, 0);
    let mut rising = None;
    for (i, &y) in heights.iter().enumerate() {
        if y > heights[high] {
            high = i;
        }
        if y < heights[low] {
            low = i;
        }
        if rising != Some(false) && heights[high] - y > hysteresis {
            turns.push((high, true));
            (rising, low) = (Some(false), i);
        } else if rising != Some(true) && y - heights[low] > hysteresis {
            turns.push((low, false));
            (rising, high) = (Some(true), i);
        }
    }
    turns.retain(|&(index, _)| index > 0);
    turns
}

/// Returns the time and height of the extremum near sample `index`, from the samples of `range` that are within `depth`
/// of its height, or next to it.
fn refine(times: &[f64], heights: &[f64], index: usize, range: RangeInclusive<usize>, depth: f64) -> (f64, f64) {
    // Between the middles to the turns before and behind it.
    let [earliest, latest] = [range.start(), range.end()].map(|&other| 0.5 * (times[index] + times[other]));
    let near = |i: usize| (heights[i] - heights[index]).abs() <= depth;
    let mut start = index;
    while start > *range.start() && (near(start - 1) || index - start < 2) {
        start -= 1;
    }
    let mut end = index;
    while end < *range.end() && (near(end + 1) || end - index < 2) {
        end += 1;
    }
    let found = || {
        let degree = match end - start + 1 {
            ..3 => return None,
            3..5 => 2,
            _ => 4,
        };
        let width = 0.5 * (times[end] - times[start]);
        let power = |j: i32| times[start..=end].iter().map(|t| ((t - times[index]) / width).powi(j)).collect();
        let columns = (0..=degree as i32).map(power).collect();
        let data: Vec<f64> = heights[start..=end].iter().map(|y| y - heights[index]).collect();
        let c = Solution::new(columns, &data)?.coefficients;
        let horner = |t: f64, weight: fn(f64) -> f64, lowest: usize| {
            (lowest..=degree).rev().fold(0.0, |sum, j| sum * t + weight(j as f64) * c[j])
        };
        // Newton's iteration for the root of the slope, from the vertex of the parabola.
        let mut t = -0.5 * c[1] / c[2];
        for _ in 0..20 {
            t -= horner(t, |j| j, 1) / horner(t, |j| j * (j - 1.0), 2);
        }
        let time = times[index] + t * width;
        (earliest < time && time < latest).then(|| (time, heights[index] + horner(t, |_| 1.0, 0)))
    };
    found().unwrap_or((times[index], heights[index]))
}

#[cfg(test)]
mod tests;
