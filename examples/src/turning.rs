//! How fast a swimmer turns.

/// Part of a run from which on turns are measured.
const LATE: f64 = 0.5;

/// Mean rate at which the direction of motion turns in the second half of a run (radians per time): the slope of the
/// line nearest to it. Nothing of fewer than three of the points (time, heading in degrees).
#[must_use]
pub fn turning_rate(headings: &[(f64, f64)]) -> Option<f64> {
    let (end, _) = *headings.last()?;
    let mut heading = 0.0;
    let late: Vec<[f64; 2]> = headings
        .iter()
        .filter(|(time, _)| *time >= LATE * end)
        .map(|(time, degrees)| {
            let change = degrees - heading;
            heading += change - 360.0 * ((change + 180.0) / 360.0).floor();
            [*time, heading.to_radians()]
        })
        .collect();
    let count = late.len() as f64;
    let [time, angle] = [0, 1].map(|k| late.iter().map(|pair| pair[k]).sum::<f64>() / count);
    let [both, square] = late
        .iter()
        .fold([0.0; 2], |[both, square], [t, a]| [both + (t - time) * (a - angle), square + (t - time).powi(2)]);
    (late.len() > 2 && square > 0.0).then(|| both / square)
}
