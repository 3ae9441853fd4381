//! Steady swimmers in channels.

use motile::Swimmer;
use motile::stokes_grid::Drive;

use crate::validation::swimmers::look;
use crate::validation::{Reference, ReferenceFile, StudyError};

/// Relative errors of a steady swimmer on the centre line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChannelErrors {
    /// Speed.
    pub speed: f64,
    /// Aspect ratio from the area moments.
    pub aspect_ratio: f64,
    /// Stresslet along the motion.
    pub stresslet: f64,
    /// Squirmer parameter in the frame of the droplet.
    pub beta: f64,
    /// Gap to the walls.
    pub gap: f64,
    /// Relative change of the area.
    pub area_change: f64,
}

/// Runs a swimmer (period 12, A = 10, viscosity 100, zero mean pressure gradient) from the polarised start to `time`
/// and compares it with the steady state of `channel_steady_swimmer.csv`.
///
/// # Errors
/// An activity or width that is not in the table, and what a run can fail with.
pub fn steady_in_channel(swimmer: &Swimmer, time: f64) -> Result<ChannelErrors, StudyError> {
    let [_, width] = swimmer.lengths;
    let reference = Reference::read(ReferenceFile::ChannelSwimmers)?
        .select("conv", "p0")
        .select("w", &format!("{width}"))
        .select("zeta_dmu", &format!("{:.1}", swimmer.activity));
    let (mut scene, droplet) = swimmer.build_without_grid_in_channel(Drive::ZeroGradient)?;
    scene.run(time).go()?;
    let seen = look(&mut scene, droplet)?;
    let relative = |value: f64, name: &str| -> Result<f64, StudyError> {
        let exact = reference.value(name)?;
        Ok((value - exact) / exact.abs())
    };
    let body = scene.body(droplet)?;
    let extent = body.markers().iter().fold(0.0_f64, |a, marker| a.max(marker.y.abs()));
    Ok(ChannelErrors {
        speed: relative(seen.speed(), "speed")?,
        aspect_ratio: relative(seen.aspect_ratio_moments, "AR_mom")?,
        stresslet: relative(seen.moments.stresslet()[0][0], "Sxx")?,
        beta: relative(seen.squirmer.beta().unwrap_or(f64::NAN), "beta_co")?,
        gap: relative(0.5 * width - extent, "min_gap")?,
        area_change: seen.area / body.initial_area() - 1.0,
    })
}
