//! Swimmers that head off the grid's axes, against boundary integrals.
//!
//! A droplet in a square box turns: its images form a lattice, which has directions, and with the direction its speed
//! changes by some per cent. A grid has directions too, and must add as little as possible to the turning.

use motile::setup::{Built, Method, Setup};

use crate::validation::StudyError;
use crate::validation::scene::reference;

/// Where a swimmer goes and how fast, at the times of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct Course {
    /// Directions of motion (radians).
    pub headings: Vec<f64>,
    /// Speeds (length per time).
    pub speeds: Vec<f64>,
}

/// The swimmer of the reference tables (box 6, viscosity 100, A = 2 |activity|) by a method, starting at `angle`
/// (radians) from the x axis at a place between the points of a grid.
#[must_use]
pub fn off_axis(method: Method, activity: f64, angle: f64) -> Setup {
    let mut setup = reference(Setup { method, ..Setup::default() }, activity);
    (setup.droplets[0].angle, setup.droplets[0].centre) = (angle, [0.013, 0.027]);
    setup
}

/// The course of the first swimmer of a scene, looked at `every` so much time until `end`, the polarised start
/// excluded.
///
/// # Errors
/// Those of a run.
pub fn course(setup: &Setup, every: f64, end: f64) -> Result<Course, StudyError> {
    let Built { mut scene, droplets, .. } = setup.build()?;
    let mut course = Course { headings: Vec::new(), speeds: Vec::new() };
    for time in (1..).map(|i| every * f64::from(i)).take_while(|&time| time < end + 0.5 * every) {
        scene.run(time).go()?;
        let seen = scene.observe(droplets[0])?;
        course.headings.extend(seen.heading());
        course.speeds.push(seen.speed());
    }
    Ok(course)
}
