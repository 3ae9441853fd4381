//! Long runs in a box: what turns a swimmer is the lattice of its images.

use motile::Swimmer;
use motile::active_interface::Observables;
use motile::ib_core::{Every, Hydrodynamics, System};

use crate::validation::StudyError;

/// What became of the heading and of what must not change.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turning {
    /// Rate (1/time) at which the angle to the x axis grows over the second half of the run.
    pub rate: f64,
    /// Angle to the x axis at the end (radians).
    pub angle: f64,
    /// Speed at the end (length per time).
    pub speed: f64,
    /// Largest over smallest speed in the second half, less one.
    pub speed_spread: f64,
    /// Largest relative change of the area.
    pub area_change: f64,
    /// Largest relative change of the particle number.
    pub particle_change: f64,
    /// Relative change of the perimeter over the second half.
    pub perimeter_creep: f64,
    /// How often the centroid crossed the edge of the box.
    pub crossings: u32,
}

/// Runs a swimmer without a grid to `time`.
///
/// # Errors
/// What a run can fail with.
pub fn turning(swimmer: &Swimmer, time: f64) -> Result<Turning, StudyError> {
    let (mut scene, droplet) = swimmer.build_without_grid()?;
    let mut records: Vec<(f64, Observables)> = Vec::new();
    let mut watch = |system: &mut System<motile::IntegralBox>| -> Result<(), StudyError> {
        records.push((system.time(), system.observe(droplet)?));
        Ok(())
    };
    scene.run(time).observe(Every::StepAfter(0.5), &mut watch).go()?;
    debug_assert_eq!(scene.system().hydrodynamics().work().stokes_solves, 0);
    let late: Vec<_> = records.iter().filter(|(t, _)| *t >= 0.5 * time).collect();
    let (Some((t0, first)), Some((t1, last)), Some((_, start))) = (late.first(), late.last(), records.first()) else {
        return Err(StudyError::Reference("a run without records".to_owned()));
    };
    let speeds = late.iter().map(|(_, seen)| seen.speed());
    let (max, min) = speeds.fold((0.0_f64, f64::INFINITY), |(max, min), v| (max.max(v), min.min(v)));
    let largest = |value: fn(&Observables) -> f64| {
        records.iter().map(|(_, seen)| (value(seen) / value(start) - 1.0).abs()).fold(0.0, f64::max)
    };
    let cell = |seen: &Observables| [0, 1].map(|i| (seen.centroid[i] / swimmer.lengths[i] + 0.5).floor());
    let moves = records.windows(2).map(|pair| {
        let (a, b) = (cell(&pair[0].1), cell(&pair[1].1));
        u32::from(a[0] != b[0]) + u32::from(a[1] != b[1])
    });
    Ok(Turning {
        rate: (last.heading() / first.heading()).ln() / (t1 - t0),
        angle: last.heading(),
        speed: last.speed(),
        speed_spread: max / min - 1.0,
        area_change: largest(|seen| seen.area),
        particle_change: largest(|seen| seen.particle_number),
        perimeter_creep: last.perimeter / first.perimeter - 1.0,
        crossings: moves.sum(),
    })
}
