//! What becomes of a lateral offset of a swimmer in a channel.

use motile::Swimmer;
use motile::active_interface::{
    ActiveDroplet,
    trajectory::{LinearMode, extrema, fit_linear_mode},
};
use motile::ib_core::{Handle, Hydrodynamics, Scene};
use motile::stokes_grid::Drive;

use crate::validation::swimmers::look;
use crate::validation::{Reference, ReferenceFile, StudyError};

/// How the flow is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// On a grid, with the swimmer's spacing.
    ImmersedBoundary,
    /// Without a grid.
    BoundaryIntegral,
}

impl Method {
    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::ImmersedBoundary => "immersed boundary",
            Self::BoundaryIntegral => "boundary integral",
        }
    }
}

/// Height and lateral velocity of the centroid at the given times.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Track {
    /// Times.
    pub times: Vec<f64>,
    /// Heights above the centre line (length).
    pub heights: Vec<f64>,
    /// Lateral velocities (length per time).
    pub velocities: Vec<f64>,
}

/// Follows a swimmer, started at the height `swimmer.offset[1]`, to `time`.
///
/// # Errors
/// What a run can fail with.
pub fn track(swimmer: &Swimmer, method: Method, time: f64, every: f64) -> Result<Track, StudyError> {
    match method {
        Method::ImmersedBoundary => {
            let (scene, droplet) = swimmer.build_on_grid_in_channel(Drive::ZeroGradient)?;
            follow(scene, droplet, time, every)
        }
        Method::BoundaryIntegral => {
            let (scene, droplet) = swimmer.build_without_grid_in_channel(Drive::ZeroGradient)?;
            follow(scene, droplet, time, every)
        }
    }
}

fn follow<H: Hydrodynamics>(
    mut scene: Scene<H>,
    droplet: Handle<ActiveDroplet>,
    time: f64,
    every: f64,
) -> Result<Track, StudyError> {
    let mut track = Track::default();
    for i in 1..=(time / every).round() as usize {
        scene.run(every * i as f64).go()?;
        let seen = look(&mut scene, droplet)?;
        track.times.push(scene.time());
        track.heights.push(seen.centroid.y);
        track.velocities.push(seen.velocity.y);
    }
    Ok(track)
}

/// Growth rate and frequency of an offset, from the part of the record after `start`.
///
/// # Errors
/// What a run or the fit can fail with.
pub fn mode(swimmer: &Swimmer, method: Method, start: f64, time: f64) -> Result<LinearMode, StudyError> {
    let track = track(swimmer, method, time, 1.0)?;
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
pub fn limit_cycle(swimmer: &Swimmer, method: Method, time: f64) -> Result<(f64, f64), StudyError> {
    let track = track(swimmer, method, time, 0.1)?;
    let turns = extrema(&track.times, &track.heights, 0.01)?;
    let [.., a, b, c] = turns.as_slice() else {
        return Err(StudyError::Reference("a record without a whole oscillation".to_owned()));
    };
    Ok((0.25 * (a.height.abs() + 2.0 * b.height.abs() + c.height.abs()), c.time - a.time))
}
