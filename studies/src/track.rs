//! Rates at which a swimmer turns and gets on, from its track.

use crate::book::statistics::line;

/// Part of a run from which on turns are measured.
const LATE: f64 = 0.5;

/// Mean rate at which the direction of motion turns in the second half of a run (radians per time): the slope of the
/// line nearest to it. Nothing of fewer than three points (time, heading in degrees); those without a heading, which
/// are not numbers, do not count.
pub(crate) fn turning_rate(headings: &[(f64, f64)]) -> Option<f64> {
    let (end, _) = *headings.last()?;
    let mut heading = 0.0;
    let late: Vec<(f64, f64)> = headings
        .iter()
        .filter(|(time, degrees)| *time >= LATE * end && degrees.is_finite())
        .map(|(time, degrees)| {
            let change = degrees - heading;
            heading += change - 360.0 * ((change + 180.0) / 360.0).floor();
            (*time, heading.to_radians())
        })
        .collect();
    let (_, rate, _) = line(&late, |time| time);
    (late.len() > 2 && rate.is_finite()).then_some(rate)
}

/// Mean speed in x over the last `distance` of a track of points (time, x): from when the swimmer was last that far
/// behind its end, on the line between two points. Nothing of a track that is shorter.
pub(crate) fn mean_speed(track: &[(f64, f64)], distance: f64) -> Option<f64> {
    let (end, x) = *track.last()?;
    let behind = |&(_, place): &(f64, f64)| x - place - distance;
    let last = track.windows(2).rfind(|pair| behind(&pair[0]) >= 0.0)?;
    let [before, after] = [behind(&last[0]), behind(&last[1])];
    let start = last[0].0 + before / (before - after) * (last[1].0 - last[0].0);
    Some(distance / (end - start))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steady_turns_beyond_half_a_circle() {
        let headings: Vec<(f64, f64)> =
            (0..50).map(|k| (0.2 * f64::from(k), (17.0 * f64::from(k) + 180.0) % 360.0 - 180.0)).collect();
        let rate = turning_rate(&headings).expect("a rate");
        assert!((rate - 85_f64.to_radians()).abs() < 1e-12, "{rate}");
        assert!(turning_rate(&headings[..2]).is_none());
        let mut resting = headings.clone();
        (30..35).for_each(|k| resting[k].1 = f64::NAN);
        let rate = turning_rate(&resting).expect("a rate");
        assert!((rate - 85_f64.to_radians()).abs() < 1e-12, "{rate}");
    }

    #[test]
    fn mean_speeds_start_between_points_and_do_not_depend_on_them() {
        // x = t + 1/2 sin t goes by 2 pi in a period of 2 pi, wherever it ends.
        let track = |count: u32| -> Vec<(f64, f64)> {
            (0..=count).map(|k| f64::from(k) * 10.0 / f64::from(count)).map(|t| (t, t + 0.5 * t.sin())).collect()
        };
        let error = |count| (mean_speed(&track(count), std::f64::consts::TAU).expect("a speed") - 1.0).abs();
        let [coarse, fine] = [100, 1000].map(error);
        // Straight lines are off by at most h^2/16 in x, where the speed is above 1/2: by h^2/8 of 2 pi in time.
        assert!(coarse < 2e-4 && fine < 2e-6, "{coarse:e}, {fine:e}");
        assert!(mean_speed(&track(100), 10.0).is_none() && mean_speed(&[], 1.0).is_none());
    }

    #[test]
    fn a_swimmer_that_came_back_has_the_speed_of_its_last_passage() {
        let track = [(0.0, 0.0), (1.0, 2.0), (2.0, 1.0), (4.0, 3.0)];
        // Last 1.5 behind its end at t = 2.5.
        assert_eq!(mean_speed(&track, 1.5), Some(1.0));
    }
}
