//! Fate of a lateral offset of a swimmer in a channel.

use motile::analysis::trajectory::{LinearMode, extrema, fit_linear_mode};
use motile::setup::{Built, Setup};

use crate::validation::{Reference, ReferenceFile, StudyError};

/// Height and lateral velocity of the centroid at the given times.
#[derive(Default)]
struct Track {
    times: Vec<f64>,
    heights: Vec<f64>,
    velocities: Vec<f64>,
}

/// Follows the first swimmer of a scene to `time`.
fn track(setup: &Setup, time: f64, every: f64) -> Result<Track, StudyError> {
    let Built { mut scene, droplets, .. } = setup.build()?;
    let mut track = Track::default();
    for i in 1..=(time / every).round() as usize {
        scene.run(every * i as f64).go()?;
        let seen = scene.observe(droplets[0])?;
        track.times.push(scene.time());
        track.heights.push(seen.centroid.y);
        track.velocities.push(seen.velocity.y);
    }
    Ok(track)
}

/// Growth rate and frequency of an offset, from the part of the record after `start`.
///
/// # Errors
/// Those of a run or the fit.
pub fn mode(setup: &Setup, start: f64, time: f64) -> Result<LinearMode, StudyError> {
    let track = track(setup, time, 1.0)?;
    let first = track.times.partition_point(|&t| t < start);
    Ok(fit_linear_mode(&track.times[first..], &track.heights[first..], Some(&track.velocities[first..]))?)
}

/// Growth rate and angular frequency of `channel_lateral_stability.csv` (width 5, period 12, A = 10, zero mean pressure
/// gradient).
///
/// # Errors
/// An activity that is not in the table.
pub fn reference(activity: f64) -> Result<(f64, f64), StudyError> {
    let row = Reference::read(ReferenceFile::ChannelStability)?
        .select("conv", "p0")
        .select("zeta_dmu", &format!("{activity:.1}"));
    Ok((row.value("growth")?, row.value("freq")?))
}

/// Amplitude (length) and period (time) of the last oscillation of a swimmer that has been followed to `time`.
///
/// # Errors
/// A record without a whole oscillation, and what a run can fail with.
pub fn limit_cycle(setup: &Setup, time: f64) -> Result<(f64, f64), StudyError> {
    let track = track(setup, time, 0.1)?;
    let turns = extrema(&track.times, &track.heights, 0.01)?;
    let [.., a, b, c] = turns.as_slice() else {
        return Err(StudyError::Reference("a record without a whole oscillation".to_owned()));
    };
    Ok((0.25 * (a.height.abs() + 2.0 * b.height.abs() + c.height.abs()), c.time - a.time))
}
