//! Classification of a trajectory.

use motile_base::internal::at_least;

use super::linear_mode::FEWEST_SAMPLES;
use super::regression::line;
use super::swings::{FEWEST_SWINGS, Swings, Tail};
use super::{Doubt, Estimate, Evidence, LinearMode, Regime, RegimeCriteria, RegimeReport, Trajectory, extrema};
use crate::AnalysisError;

/// Standard errors by which a change of amplitude must differ from zero: 95 % confidence.
const SIGNIFICANT: f64 = 2.0;
/// Growth of a small speed over the last quarter of the record above which a droplet is not at rest.
const SPEEDING_UP: f64 = 1.5;
/// Periods in the record from which on a fitted oscillation is believed.
const OSCILLATION: f64 = 0.5;
/// Periods in the record up to which a fitted oscillation counts as none.
const STRAIGHT: f64 = 0.1;
/// Standard errors by which the rate of a fit to less than two periods must differ from zero.
const SIGNIFICANT_RATE: f64 = 3.0;
/// Fraction of its largest distance from the centre line at which a droplet that has stopped is taken to stay there.
const STAYS: f64 = 0.95;

impl Trajectory {
    /// Returns the long-time regime of the droplet, with the evidence for it; the first part of the record
    /// ([`RegimeCriteria::transient`]) is left out. The first of these that applies:
    ///
    /// 1. Speeds below [`RegimeCriteria::rest`] over the last quarter: at rest (unless they are increasing).
    /// 2. All heights within [`RegimeCriteria::centre`]: on the centre line.
    /// 3. Four or more turning points: the amplitudes of the swings between them give the growth rate, over the longest
    ///    tail in which they are exponential in time. An oscillation that has grown and saturated is therefore steady.
    ///    Drifting, if the height about which it oscillates moves to one side by more than the swings, or if the
    ///    oscillation decays towards a height off the centre line. Undecided, if the amplitude goes up and down by more
    ///    than a fifth and less than half of the swings belong to the tail, or if the change of the amplitude per
    ///    period or its standard error is above [`RegimeCriteria::steady`] without being significant.
    /// 4. Fewer turning points: growing or decaying, if a [`LinearMode`] fits ([`RegimeCriteria::linear`]), its rate
    ///    differs from zero by three standard errors, and the record contains at least half of its period, or without
    ///    oscillation a change by a factor of e. Drifting, if the droplet leaves the centre line or stays away from it
    ///    and there is no sign that it oscillates. Undecided otherwise; fewer than four turning points do not show a
    ///    steady oscillation.
    ///
    /// # Errors
    /// Returns an error if there are no samples, or for criteria out of their ranges.
    pub fn regime(&self, criteria: &RegimeCriteria) -> Result<RegimeReport, AnalysisError> {
        criteria.check()?;
        at_least("samples", self.times().len(), 1)?;
        let start = self.times()[0] + criteria.transient * self.duration();
        let window = self.between(start, f64::INFINITY);
        let mut evidence = collect(&window, criteria)?;
        let regime = if evidence.samples < FEWEST_SAMPLES {
            Regime::Undecided(Doubt::TooFewSamples { found: evidence.samples })
        } else if let Some(regime) = rest(&window, criteria) {
            regime
        } else if evidence.largest <= criteria.centre {
            Regime::CentreLine
        } else {
            across(&window, &mut evidence, criteria)
        };
        Ok(RegimeReport { regime, evidence })
    }
}

/// Returns the last quarter of a window, in time.
fn last_quarter(window: &Trajectory) -> Trajectory {
    window.between(window.times()[0] + 0.75 * window.duration(), f64::INFINITY)
}

fn largest(heights: &[f64]) -> f64 {
    heights.iter().fold(0.0, |a: f64, y| a.max(y.abs()))
}

/// Measurements that every window of at least one sample allows.
fn collect(window: &Trajectory, criteria: &RegimeCriteria) -> Result<Evidence, AnalysisError> {
    let (times, heights) = (window.times(), window.heights());
    let late = last_quarter(window);
    let range = heights.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], &y| [a.min(y), b.max(y)]);
    let extrema = extrema(times, heights, criteria.centre.max(criteria.hysteresis * (range[1] - range[0])))?;
    let shifted: Vec<f64> = times.iter().map(|t| t - times[0]).collect();
    let unknown = Estimate { value: 0.0, error: f64::INFINITY };
    Ok(Evidence {
        window: [times[0], times[times.len() - 1]],
        samples: times.len(),
        speed: late.speeds().iter().sum::<f64>() / late.speeds().len() as f64,
        largest: largest(heights),
        amplitude: largest(late.heights()),
        half_height: None,
        midline: None,
        last_height: heights[heights.len() - 1],
        drift: line(&shifted, heights).map_or(unknown, |(_, slope, _)| slope),
        periods: 0.5 * extrema.len().saturating_sub(1) as f64,
        extrema,
        period: None,
        growth_rate: None,
        mode: None,
    })
}

/// Returns the regime of a droplet at rest, or so slow that the record does not show it; `None` for a droplet that
/// moves.
fn rest(window: &Trajectory, criteria: &RegimeCriteria) -> Option<Regime> {
    let late = last_quarter(window);
    if late.speeds().iter().any(|&speed| speed > criteria.rest) {
        return None;
    }
    let logarithms: Vec<f64> = late.speeds().iter().map(|speed| speed.ln()).collect();
    // A speed of exactly zero has no logarithm, and no trend.
    if let Some((_, rate, _)) = line(late.times(), &logarithms)
        && rate.differs_from_zero(SIGNIFICANT)
        && rate.value * late.duration() > SPEEDING_UP.ln()
    {
        return Some(Regime::Undecided(Doubt::SpeedingUp { rate: rate.value }));
    }
    Some(Regime::AtRest)
}

/// Returns the regime of a droplet that moves and is not on the centre line.
fn across(window: &Trajectory, evidence: &mut Evidence, criteria: &RegimeCriteria) -> Regime {
    let swings = Swings::new(evidence.extrema.clone());
    if let (Some(&half_height), Some(&midline)) = (swings.amplitudes.last(), swings.midlines.last()) {
        evidence.half_height = Some(half_height);
        evidence.midline = Some(midline);
        evidence.amplitude = evidence.extrema.iter().rev().take(2).fold(0.0, |a, turn| a.max(turn.height.abs()));
    }
    if let Some(tail) = swings.tail() {
        evidence.period = Some(tail.period);
        evidence.growth_rate = Some(tail.growth_rate);
        return oscillating(&swings, &tail, criteria);
    }
    debug_assert!(swings.len() < FEWEST_SWINGS || evidence.extrema.len() > FEWEST_SWINGS);
    let mode = window.linear_mode().ok().filter(|mode| mode.residual <= criteria.linear);
    if let Some(mode) = mode {
        evidence.mode = Some(mode);
        evidence.growth_rate = Some(mode.growth_rate);
        evidence.period = mode.period();
        evidence.periods = evidence.periods.max(mode.periods());
    }
    tendency(window, evidence.extrema.len(), mode.as_ref(), criteria)
}

/// Returns the regime of a motion whose swings show how its amplitude changes.
fn oscillating(swings: &Swings, tail: &Tail, criteria: &RegimeCriteria) -> Regime {
    let amplitudes = &swings.amplitudes[tail.start..];
    let midlines = &swings.midlines[tail.start..];
    let (first, last) = (midlines[0], midlines[midlines.len() - 1]);
    let one_way = |sign: f64| midlines.windows(2).all(|pair| sign * (pair[1] - pair[0]) > 0.0);
    let moves = (one_way(1.0) || one_way(-1.0)) && (last - first).abs() > 2.0 * largest(amplitudes);

    let (least, most) = swings.amplitudes.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), &c| (a.min(c), b.max(c)));
    let irregular = Regime::Undecided(Doubt::Irregular { ratio: most / least });

    let per_period = tail.growth_rate.scaled(tail.period.value);
    let changes = per_period.differs_from_zero(SIGNIFICANT) && per_period.value.abs() > criteria.steady;
    match per_period.value {
        _ if moves => Regime::Drifting,
        _ if swings.wavering() > 1 && 2 * amplitudes.len() < swings.len() => irregular,
        value if changes && value > 0.0 => Regime::Growing,
        _ if changes && last.abs() > 0.5 * amplitudes[0] => Regime::Drifting,
        _ if changes => Regime::Decaying,
        // Neither is a change that the error hides, nor one beyond the bound that is not significant.
        value if value.abs().max(per_period.error) <= criteria.steady => Regime::SteadyOscillation,
        _ if swings.wavering() > 1 => irregular,
        value => Regime::Undecided(Doubt::Uncertain { change: value, error: per_period.error }),
    }
}

/// Returns the regime of a motion with too few turning points to follow its amplitude: from a linear fit, if it is
/// good, or from the way the height goes at the end.
fn tendency(window: &Trajectory, turns: usize, mode: Option<&LinearMode>, criteria: &RegimeCriteria) -> Regime {
    // Turning points are half a period apart; before the first and behind the last one there is less than that each.
    let too_short = |periods: f64| Regime::Undecided(Doubt::TooShort { periods });
    match mode {
        Some(mode) if mode.periods() > STRAIGHT => {
            let (rate, periods) = (mode.growth_rate, mode.periods());
            let per_period = mode.period().map_or(0.0, |period| rate.value * period.value);
            if periods >= OSCILLATION && rate.differs_from_zero(SIGNIFICANT_RATE) && per_period.abs() > criteria.steady
            {
                growing_or_decaying(rate.value)
            } else {
                too_short(periods)
            }
        }
        None if turns > 0 => too_short(0.5 * turns as f64),
        _ => one_way(window, mode, criteria),
    }
}

fn growing_or_decaying(rate: f64) -> Regime {
    if rate > 0.0 { Regime::Growing } else { Regime::Decaying }
}

/// Returns the regime of a motion that has not turned, or has turned once and relaxes without oscillation.
fn one_way(window: &Trajectory, mode: Option<&LinearMode>, criteria: &RegimeCriteria) -> Regime {
    let heights = window.heights();
    let (first, last) = (heights[0], heights[heights.len() - 1]);
    let largest = heights.iter().fold(0.0_f64, |a, y| a.max(y.abs()));
    let duration = window.duration();

    if let Some(mode) = mode {
        let rate = mode.growth_rate;
        let grown = rate.value * duration;
        let significant = rate.differs_from_zero(SIGNIFICANT_RATE);
        if significant && grown >= 1.0 && last.abs() >= std::f64::consts::E * first.abs() {
            return Regime::Growing;
        }
        if significant && grown <= -1.0 && std::f64::consts::E * last.abs() <= largest {
            return Regime::Decaying;
        }
    }
    // A motion that is not linear and still going on may do anything.
    let tail = window.between(window.times()[0] + 0.5 * duration, f64::INFINITY);
    let stays = tail.heights().iter().all(|y| (y - last).abs() <= (1.0 - STAYS) * largest);
    let leaves = mode.is_some() && last * (last - tail.heights()[0]) > 0.0;
    let away = last.abs() >= STAYS * largest;
    if away && (leaves || stays) && path(window) >= criteria.travel {
        Regime::Drifting
    } else {
        Regime::Undecided(Doubt::TooShort { periods: 0.0 })
    }
}

/// Returns the length of the path that the droplet has swum (length).
fn path(window: &Trajectory) -> f64 {
    let speeds = window.speeds().windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    window.times().windows(2).zip(speeds).map(|(times, speed)| (times[1] - times[0]) * speed).sum()
}

#[cfg(test)]
mod tests;
