//! Growth rates of small perturbations of a round droplet, against linear theory.

use std::f64::consts::TAU;

use motile::active_interface::{
    ActiveDroplet, ContractileTension, Curve, ExcludedVolume, polygon_moments,
    theory::{LinearTheory, RoundDroplet},
};
use motile::base::Region;
use motile::base::Vec2;
use motile::scene::{Scene, StepSize};
use motile::setup::{AnyFlow, IntegralMethod, Method, Particles, Setup};

use anyhow::Context;

use crate::validation::StudyError;
use crate::validation::scene::flow;

/// Perturbation of a droplet of radius one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// The concentration, `c0 (1 + epsilon cos k theta)`.
    Concentration(u32),
    /// The shape, `1 + epsilon cos k theta`.
    Shape(u32),
}

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

    /// Its growth rate (1/time) on the first droplet of a scene in free space: Cowley (2.18), (2.19).
    ///
    /// # Errors
    /// Parameters that make no droplet.
    pub fn theory(self, setup: &Setup) -> Result<f64, StudyError> {
        let (droplet, particles) = (&setup.droplets[0], particles(setup)?);
        let theory = LinearTheory::new(RoundDroplet {
            radius: 1.0,
            viscosity_inside: droplet.viscosity.unwrap_or(setup.viscosity),
            viscosity_outside: setup.viscosity,
            tension: droplet.tension - particles.activity * particles.concentration,
            activity: particles.activity,
            concentration: particles.concentration,
            diffusivity: particles.diffusion,
        })?;
        Ok(match self {
            Self::Concentration(k) => theory.concentration_growth_rate(k),
            Self::Shape(k) => theory.shape_growth_rate(k),
        })
    }
}

/// How a perturbation is watched.
struct Watch {
    /// Amplitude: what is of second order cancels between both signs, and third orders are the square of this.
    epsilon: f64,
    /// How long (time).
    duration: f64,
    /// In how many steps.
    steps: f64,
}

/// The growth rate of a mode on the first droplet of a scene in its region and by its method: of the difference of two
/// runs with opposite perturbations, so that what a grid and a box do to a round droplet does not count.
///
/// # Errors
/// Those of a run.
pub fn rate_in_region(setup: &Setup, mode: Mode) -> Result<f64, StudyError> {
    measure(setup, mode, &Watch { epsilon: 1e-5, duration: 0.2, steps: 20.0 }, || Ok(setup.flow()?))
}

/// The growth rate without a box: from boxes of 6, 12 and 24 radii, whose effect is a series in 1/L^2.
///
/// # Errors
/// Those of a run.
pub fn rate(setup: &Setup, mode: Mode) -> Result<f64, StudyError> {
    let mut rates = [0.0; 3];
    for (rate, l) in rates.iter_mut().zip([6.0, 12.0, 24.0]) {
        *rate = rate_in_region(&Setup { region: Region::Box { lengths: [l; 2] }, ..setup.clone() }, mode)?;
    }
    let [a, b, c] = rates;
    // Richardson for the terms in 1/L^2 and 1/L^4.
    let (first, second) = ((4.0 * b - a) / 3.0, (4.0 * c - b) / 3.0);
    Ok((16.0 * second - first) / 15.0)
}

/// The growth rate in unbounded fluid, by boundary integrals with `nodes` nodes and infinitely many elements: from
/// `elements` and twice as many, because the error of the elements is of second order.
///
/// # Errors
/// Those of a run.
pub fn rate_in_plane_limit(setup: &Setup, mode: Mode, nodes: usize, elements: usize) -> Result<f64, StudyError> {
    let watch = Watch { epsilon: 1e-5, duration: 0.1, steps: 100.0 };
    let [coarse, fine] = [elements, 2 * elements].map(|elements| {
        let method = Method::Integral(IntegralMethod { nodes, elements });
        let setup = Setup { method, ..setup.clone() };
        measure(&setup, mode, &watch, || flow(Region::Plane, method, setup.viscosity, 1e-11))
    });
    Ok((4.0 * fine? - coarse?) / 3.0)
}

fn measure(
    setup: &Setup,
    mode: Mode,
    watch: &Watch,
    flow: impl Fn() -> Result<AnyFlow, StudyError>,
) -> Result<f64, StudyError> {
    let (mut start, mut end) = (0.0, 0.0);
    for sign in [1.0, -1.0] {
        let mut scene = Scene::new(flow()?);
        let droplet = scene.add(perturbed(setup, mode, sign * watch.epsilon)?);
        start += sign * amplitude(scene.body(droplet)?, mode)?;
        scene.run(watch.duration).step_size(StepSize::Fixed(watch.duration / watch.steps)).go()?;
        end += sign * amplitude(scene.body(droplet)?, mode)?;
    }
    Ok((end / start).ln() / watch.duration)
}

fn particles(setup: &Setup) -> Result<Particles, StudyError> {
    setup.droplets[0].particles.context("a droplet without particles")
}

/// The first droplet of a scene, round and uniform but for a small perturbation, without excluded volume.
fn perturbed(setup: &Setup, mode: Mode, epsilon: f64) -> Result<ActiveDroplet, StudyError> {
    let (droplet, particles) = (&setup.droplets[0], particles(setup)?);
    let curve = match mode {
        Mode::Concentration(_) => Curve::circle(1.0)?,
        Mode::Shape(k) => {
            let mut cosines = vec![0.0; k as usize];
            cosines[k as usize - 1] = epsilon;
            Curve::fourier(1.0, &cosines, &[])?
        }
    };
    let count = match setup.method {
        Method::Grid(grid) => 4 * (curve.perimeter() / (2.0 * grid.spacing)).round() as usize,
        Method::Layers(layers) => layers.elements,
        Method::Integral(integral) => integral.elements,
        other => anyhow::bail!("no number of markers by the method {}", other.kind().name()),
    };
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
            particles.concentration * curve.perimeter() / TAU * (b - a + wave)
        })
        .collect();
    let law = ContractileTension::new(droplet.tension, particles.activity, ExcludedVolume::None, 1.0)?;
    let made = ActiveDroplet::new(&curve.markers(count)?, numbers, law, particles.diffusion)?
        .with_motion(droplet.motion)
        .with_flux(particles.flux)
        .with_area_constraint(droplet.area_constraint);
    Ok(match droplet.viscosity {
        Some(inside) => made.with_viscosity_inside(inside)?,
        None => made,
    })
}

/// The cosine coefficient of the perturbed quantity, over the polar angle about the centroid.
fn amplitude(droplet: &ActiveDroplet, mode: Mode) -> Result<f64, StudyError> {
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
                (marker - centre).length() * width * (f64::from(k) * angle(*marker)).cos()
            }
        };
    }
    Ok(sum)
}
