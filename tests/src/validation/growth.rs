//! Growth rates of small perturbations of a round droplet, against linear theory.

use std::f64::consts::TAU;

use motile::Swimmer;
use motile::active_interface::{ActiveDroplet, ContractileTension, Curve, ExcludedVolume, curve::polygon_moments};
use motile::ib_core::{Handle, StepSize, Vec2};

use crate::validation::StudyError;

/// What is perturbed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// The concentration, `c0 (1 + epsilon cos k theta)`.
    Concentration(u32),
    /// The shape, `R0 (1 + epsilon cos k theta)`.
    Shape(u32),
}

/// Amplitude: the second-order effects are relative errors of this size.
const EPSILON: f64 = 1e-5;
/// How long the perturbation is watched (time).
const DURATION: f64 = 0.2;

impl Mode {
    /// The modes of the study.
    pub const ALL: [Self; 7] = [
        Self::Concentration(1),
        Self::Concentration(2),
        Self::Concentration(3),
        Self::Concentration(6),
        Self::Concentration(12),
        Self::Shape(2),
        Self::Shape(3),
    ];

    /// Its growth rate (1/time) in free space: thesis (2.18), (2.19).
    #[must_use]
    pub fn theory(self, swimmer: &Swimmer) -> f64 {
        let sum = swimmer.viscosity + swimmer.viscosity_inside.unwrap_or(swimmer.viscosity);
        let (r, c0) = (swimmer.radius, swimmer.mean_concentration);
        match self {
            Self::Concentration(k) => {
                let k = f64::from(k);
                -k * (swimmer.activity * c0 / (2.0 * r * sum) + swimmer.diffusion * k / (r * r))
            }
            Self::Shape(k) => -f64::from(k) * (swimmer.bare_tension - swimmer.activity * c0) / (2.0 * r * sum),
        }
    }
}

/// The growth rate in a box of the length of `swimmer` (square): of the difference of two runs with opposite
/// perturbations, so that what the grid and the box do to a round droplet does not count.
///
/// # Errors
/// What a run can fail with.
pub fn rate_in_box(swimmer: &Swimmer, mode: Mode) -> Result<f64, StudyError> {
    let (plus, minus) = (amplitudes(swimmer, mode, EPSILON)?, amplitudes(swimmer, mode, -EPSILON)?);
    Ok(((plus.1 - minus.1) / (plus.0 - minus.0)).ln() / DURATION)
}

/// Amplitudes of a mode at the start and at the end of a run.
fn amplitudes(swimmer: &Swimmer, mode: Mode, epsilon: f64) -> Result<(f64, f64), StudyError> {
    let mut scene = swimmer.scene()?;
    let droplet: Handle<ActiveDroplet> = scene.add(perturbed(swimmer, mode, epsilon)?);
    let start = amplitude(scene.body(droplet)?, mode)?;
    scene.run(DURATION).step_size(StepSize::Fixed(DURATION / 20.0)).go()?;
    Ok((start, amplitude(scene.body(droplet)?, mode)?))
}

/// A round droplet with a small perturbation.
pub(crate) fn perturbed(swimmer: &Swimmer, mode: Mode, epsilon: f64) -> Result<ActiveDroplet, StudyError> {
    let r = swimmer.radius;
    let curve = match mode {
        Mode::Concentration(_) => Curve::circle(r)?,
        Mode::Shape(k) => {
            let mut cosines = vec![0.0; k as usize];
            cosines[k as usize - 1] = epsilon;
            Curve::fourier(r, &cosines, &[])?
        }
    };
    let count = 4 * (curve.perimeter() / (2.0 * swimmer.spacing)).round() as usize;
    let markers = curve.markers(count)?;
    let step = TAU / count as f64;
    let numbers = (0..count)
        .map(|j| {
            let (a, b) = (step * j as f64, step * (j + 1) as f64);
            let wave = match mode {
                Mode::Concentration(k) => {
                    epsilon * ((f64::from(k) * b).sin() - (f64::from(k) * a).sin()) / f64::from(k)
                }
                Mode::Shape(_) => 0.0,
            };
            swimmer.mean_concentration * curve.perimeter() / TAU * (b - a + wave)
        })
        .collect();
    let law = ContractileTension::new(swimmer.bare_tension, swimmer.activity, ExcludedVolume::None)?;
    let droplet = ActiveDroplet::new(&markers, numbers, law, swimmer.diffusion)?
        .with_motion(swimmer.motion)
        .with_flux(swimmer.flux)
        .with_area_constraint(swimmer.area_constraint);
    Ok(match swimmer.viscosity_inside {
        Some(inside) => droplet.with_viscosity_inside(inside)?,
        None => droplet,
    })
}

/// The growth rate without a box: from boxes of 6, 12 and 24 radii, whose effect is a series in 1/L^2.
///
/// # Errors
/// What a run can fail with.
pub fn rate(swimmer: &Swimmer, mode: Mode) -> Result<f64, StudyError> {
    let mut rates = [0.0; 3];
    for (rate, l) in rates.iter_mut().zip([6.0, 12.0, 24.0]) {
        let lengths = [l * swimmer.radius; 2];
        *rate = rate_in_box(&Swimmer { lengths, ..swimmer.clone() }, mode)?;
    }
    let [a, b, c] = rates;
    // Richardson for the terms in 1/L^2 and 1/L^4.
    let (first, second) = ((4.0 * b - a) / 3.0, (4.0 * c - b) / 3.0);
    Ok((16.0 * second - first) / 15.0)
}

/// The cosine coefficient of the perturbed quantity, over the polar angle about the centroid.
pub(crate) fn amplitude(droplet: &ActiveDroplet, mode: Mode) -> Result<f64, StudyError> {
    let markers = droplet.markers();
    let centre = polygon_moments(markers)?.centroid;
    let count = markers.len();
    let angle = |point: Vec2| (point.y - centre.y).atan2(point.x - centre.x);
    let mut sum = 0.0;
    // Integrals over the angle, so that markers which crowd or thin out do not count as a mode: particle numbers are
    // concentrations times lengths already.
    for (j, (marker, number)) in markers.iter().zip(droplet.particle_numbers()).enumerate() {
        let (next, before) = (markers[(j + 1) % count], markers[(j + count - 1) % count]);
        sum += match mode {
            Mode::Concentration(k) => number * (f64::from(k) * angle(0.5 * (marker + next))).cos(),
            Mode::Shape(k) => {
                let width = 0.5 * (angle(next) - angle(before)).rem_euclid(TAU);
                (marker - centre).norm() * width * (f64::from(k) * angle(*marker)).cos()
            }
        };
    }
    Ok(sum)
}
