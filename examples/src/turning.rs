//! How fast a swimmer turns.

use std::f64::consts::{PI, TAU};

use motile::active_interface::trajectory::TrajectoryRecord;

/// Part of a run from which on turns are measured.
const LATE: f64 = 0.5;

/// The mean rate at which the direction of motion turns in the second half of a run (radians per time): the slope of
/// the line nearest to it. Nothing of fewer than three records.
#[must_use]
pub fn turning_rate(records: &[TrajectoryRecord]) -> Option<f64> {
    let end = records.last()?.time;
    let late: Vec<&TrajectoryRecord> = records.iter().filter(|record| record.time >= LATE * end).collect();
    let mut heading = 0.0;
    let headings: Vec<[f64; 2]> = late
        .iter()
        .map(|record| {
            let change = record.observables.velocity.to_angle() - heading;
            heading += change - TAU * ((change + PI) / TAU).floor();
            [record.time, heading]
        })
        .collect();
    let count = headings.len() as f64;
    let [time, angle] = [0, 1].map(|k| headings.iter().map(|pair| pair[k]).sum::<f64>() / count);
    let [both, square] = headings
        .iter()
        .fold([0.0; 2], |[both, square], [t, a]| [both + (t - time) * (a - angle), square + (t - time).powi(2)]);
    (late.len() > 2 && square > 0.0).then(|| both / square)
}
