//! Steady states: the time from which the speed of a droplet is constant.

use serde_json::{Value, json};

/// Largest deviation from the final speed in a steady state, relative to it.
const DEVIATION: f64 = 1e-3;
/// Fraction of the run over which the final speed is averaged.
const LATE: f64 = 0.2;
/// Speeds below this are rest, in units of D/R0: what decays to nothing never has a constant speed.
const REST: f64 = 1e-5;
/// Factor by which the speed grows between the halves of the late part of a run whose droplet is not at rest but starts
/// to move, and the speed, in units of D/R0, above which that is not round-off.
const SPEEDING_UP: f64 = 1.5;
const ROUND_OFF: f64 = 1e-9;
/// Least time for which the speed must have been constant, in units of R0^2/D: a short run has not had the time to show
/// that it is steady.
const PATIENCE: f64 = 0.5;

/// Steadiness of a run, judged by the speed of its droplet.
///
/// The final speed is the mean over the last fifth of the run. The state is steady from the time after which the speed
/// stays within 0.1 % of the final speed, or below 1e-5 D/R0 (at rest, unless it grows by half and more between the two
/// halves of that fifth: a droplet that starts to move). This must last for at least the last fifth of
/// the run and half a diffusion time R0^2/D.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steadiness {
    /// Time from which the state is steady; `None` if it is not.
    pub since: Option<f64>,
    /// True for a steady state at rest: a speed below 1e-5 D/R0, constant or not.
    pub at_rest: bool,
    /// Mean speed over the last fifth of the run (length per time).
    pub final_speed: f64,
    /// Largest deviation of the speed over the last fifth of the run, relative to the final speed (no dimension).
    pub deviation: f64,
}

impl Steadiness {
    /// Judges steadiness from points (time, speed) in the order of time. It takes the diffusion constant D of the
    /// particles (length squared per time) and the radius R0 of the droplet (length).
    #[must_use]
    pub fn of(points: &[(f64, f64)], diffusion: f64, radius: f64) -> Self {
        let nothing = Self { since: None, at_rest: false, final_speed: f64::NAN, deviation: f64::NAN };
        let (Some(&(start, _)), Some(&(end, _))) = (points.first(), points.last()) else { return nothing };
        let late = points.iter().filter(|(t, _)| *t >= end - LATE * (end - start));
        let (count, sum) = late.clone().fold((0.0, 0.0), |(n, sum), (_, v)| (n + 1.0, sum + v));
        let mean: f64 = sum / count;
        let rest = REST * diffusion / radius;
        let long_enough =
            |t: &f64| end - t >= LATE * (end - start) && (end - t) * diffusion >= PATIENCE * radius * radius;
        let since = |within: &dyn Fn(f64) -> bool| {
            let first = points.iter().rposition(|&(_, v)| !within(v)).map_or(0, |k| k + 1);
            points.get(first).map(|&(t, _)| t).filter(long_enough)
        };
        let constant = since(&|v| (v - mean).abs() <= DEVIATION * mean.abs());
        let half_mean = |later: bool| {
            let half = late.clone().filter(|(t, _)| (*t >= end - 0.5 * LATE * (end - start)) == later);
            let (count, sum) = half.fold((0.0, 0.0), |(n, sum), (_, v)| (n + 1.0, sum + v.abs()));
            sum / count
        };
        let [first, second] = [false, true].map(half_mean);
        let starts = second > SPEEDING_UP * first && second > ROUND_OFF * diffusion;
        let resting = since(&|v| v.abs() <= rest).filter(|_| !starts);
        let deviation = late.map(|(_, v)| (v / mean - 1.0).abs()).fold(0.0, f64::max);
        Self { since: resting.or(constant), at_rest: resting.is_some(), final_speed: mean, deviation }
    }

    /// Returns the entry of `summary.json`: an object with `reached`, `time` and `at_rest`.
    #[must_use]
    pub fn json(&self) -> Value {
        json!({ "reached": self.since.is_some(), "time": self.since, "at_rest": self.at_rest })
    }

    /// Returns the criterion that was applied, in words.
    #[must_use]
    pub fn criterion(&self) -> &'static str {
        if self.at_rest {
            "at rest: speed below 1e-5 D/R0, constant or not"
        } else {
            "speed within 0.1 % of its final mean"
        }
    }
}

#[cfg(test)]
mod tests;
