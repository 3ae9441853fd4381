//! The regime of motions with too few turning points to follow their amplitude.

use super::{Doubt, LinearMode, Regime, RegimeCriteria, Trajectory};

/// A fitted oscillation of which the record has at least this many periods is believed.
const OSCILLATION: f64 = 0.5;
/// One of which it has at most this many is none, as far as the record goes.
const STRAIGHT: f64 = 0.1;
/// Standard errors by which a rate has to differ from zero.
const SIGNIFICANT: f64 = 3.0;
/// Part of its largest distance from the centre line at which a droplet that has stopped is taken to stay there.
const STAYS: f64 = 0.95;

/// The regime from a linear fit, if it is good, or from the way the height goes at the end.
pub(super) fn tendency(
    window: &Trajectory,
    turns: usize,
    mode: Option<&LinearMode>,
    criteria: &RegimeCriteria,
) -> Regime {
    // Turning points are half a period apart; before the first and behind the last one there is less than that each.
    let too_short = |periods: f64| Regime::Undecided(Doubt::TooShort { periods });
    match mode {
        Some(mode) if mode.periods() > STRAIGHT => {
            let (rate, periods) = (mode.growth_rate, mode.periods());
            let per_period = mode.period().map_or(0.0, |period| rate.value * period.value);
            if periods >= OSCILLATION && rate.differs_from_zero(SIGNIFICANT) && per_period.abs() > criteria.steady {
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

/// The regime of a motion that has not turned, or has turned once and relaxes without oscillation.
fn one_way(window: &Trajectory, mode: Option<&LinearMode>, criteria: &RegimeCriteria) -> Regime {
    let heights = window.heights();
    let (first, last) = (heights[0], heights[heights.len() - 1]);
    let largest = heights.iter().fold(0.0_f64, |a, y| a.max(y.abs()));
    let duration = window.duration();

    if let Some(mode) = mode {
        let rate = mode.growth_rate;
        let grown = rate.value * duration;
        let significant = rate.differs_from_zero(SIGNIFICANT);
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

/// How far the droplet has swum (length).
fn path(window: &Trajectory) -> f64 {
    let speeds = window.speeds().windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    window.times().windows(2).zip(speeds).map(|(times, speed)| (times[1] - times[0]) * speed).sum()
}
