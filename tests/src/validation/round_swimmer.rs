//! An exact solution of the coupled, nonlinear problem: a round droplet in unbounded fluid with a linear tension law.
//!
//! Derivation, in four steps, for a radius R, the tension `gamma0 - zeta c`, the sum S of both viscosities, and the
//! concentration `c = Re f(z)` with `f(z)` analytic for |z| < 1 and z = e^(i theta):
//!
//! 1. **The circle stays a circle.** The flow is linear in the forces `d(gamma tau)/ds`, and no mode k >= 2 of the
//!    concentration moves a circle along its normal (Cowley (2.12) to (2.15)). Mode 1 translates it.
//! 2. **The surface velocity is the conjugate of c.** In the frame of the droplet, mode `c_k cos k theta` drives
//!    `v_theta = zeta c_k sin(k theta)/(2 S)`, at any viscosity ratio. So `v_theta = kappa Im f`, kappa = zeta/(2 S).
//! 3. **Transport becomes Burgers' equation.** `Re f Im f = Im(f^2)/2` and `d/dtheta = i z d/dz` turn
//!    `c_t + (v_theta c)_theta/R = D c_theta theta/R^2` into `f_t + (kappa/R) f z f_z + (D/R^2) (z d/dz)^2 f = 0`.
//! 4. **Cole and Hopf.** `f = c0 + (2 D/(R kappa)) z g_z/g` linearises it: each power of g has a rate of its own, the
//!    growth rate of that mode of the concentration, `-k (kappa c0/R + D k/R^2)`.
//!
//! With g = 1 - q z, the solution has one cluster at theta = 0 and one parameter, the sharpness q:
//!
//! ```text
//! q(t)  = q(0) exp(rate t),   rate = -(kappa c0/R + D/R^2)
//! c     = c0 - (2 D/(R kappa)) (q cos theta - q^2)/(1 - 2 q cos theta + q^2)
//! c_k   = -(2 D/(R kappa)) q^k             (coefficient of cos k theta)
//! speed = D q/R                            (along theta = pi)
//! ```
//!
//! At the threshold of swimming, every q is steady. Beyond it q grows, and the particles collapse to a point at q = 1.
//! For particles that lower the tension (kappa > 0), q is negative for a cluster at theta = 0, and it decays.

use std::f64::consts::TAU;

use anyhow::{Context, ensure};
use motile::active_interface::{ActiveDroplet, ContractileTension, Curve, ExcludedVolume, polygon_moments};
use motile::base::Region;
use motile::scene::{Scene, StepSize};
use motile::setup::{GridMethod, IntegralMethod, LayersMethod, Method, Setup};

use super::StudyError;
use super::scene::flow;

/// Modes of the concentration that are compared.
pub const MODES: usize = 4;

/// A round droplet of radius 1 with one cluster of particles at theta = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoundSwimmer {
    /// Activity zeta (force times length), not zero; negative for particles that contract.
    pub activity: f64,
    /// Mean concentration c0 (particles per length).
    pub concentration: f64,
    /// Diffusivity D along the interface (length squared per time).
    pub diffusion: f64,
    /// Viscosities inside and outside (stress times time).
    pub viscosities: [f64; 2],
    /// Sharpness q at t = 0 (no dimension).
    pub sharpness: f64,
}

/// The droplet with the default parameters at activity -2, from a tenth of its sharpest state on.
pub const DEFAULT: RoundSwimmer =
    RoundSwimmer { activity: -2.0, concentration: 100.0, diffusion: 0.1, viscosities: [100.0, 100.0], sharpness: 0.1 };

impl RoundSwimmer {
    fn kappa(&self) -> f64 {
        self.activity / (2.0 * (self.viscosities[0] + self.viscosities[1]))
    }

    /// The growth rate of the sharpness (1/time).
    #[must_use]
    pub fn rate(&self) -> f64 {
        -(self.kappa() * self.concentration + self.diffusion)
    }

    /// The sharpness at a time.
    #[must_use]
    pub fn sharpness_at(&self, time: f64) -> f64 {
        self.sharpness * (self.rate() * time).exp()
    }

    /// The concentration at a polar angle (radians) for a sharpness.
    #[must_use]
    pub fn concentration_at(&self, angle: f64, sharpness: f64) -> f64 {
        let (q, cos) = (sharpness, angle.cos());
        self.concentration - 2.0 * self.diffusion / self.kappa() * (q * cos - q * q) / (1.0 - 2.0 * q * cos + q * q)
    }

    /// The number of particles between the angles `from` and `to` (radians), the integral of the concentration.
    fn number(&self, from: f64, to: f64, sharpness: f64) -> f64 {
        // INT (q cos - q^2)/(1 - 2 q cos + q^2) = arg(1 - q e^(-i angle)), the imaginary part of -log(1 - q z).
        let argument = |angle: f64| (sharpness * angle.sin()).atan2(1.0 - sharpness * angle.cos());
        self.concentration * (to - from) - 2.0 * self.diffusion / self.kappa() * (argument(to) - argument(from))
    }

    /// The exact values of what [`RoundSwimmer::run`] measures.
    #[must_use]
    pub fn exact(&self, time: f64) -> Measured {
        let q = self.sharpness_at(time);
        let scale = -2.0 * self.diffusion / self.kappa();
        let modes = std::array::from_fn(|k| scale * q.powi(k as i32 + 1));
        // The integral of the speed; at the threshold the speed does not change.
        let growth = self.rate() * time;
        let mean = if growth.abs() < f64::EPSILON { 1.0 } else { growth.exp_m1() / growth };
        Measured { modes, displacement: -self.diffusion * self.sharpness * mean * time, deformation: 0.0 }
    }

    /// A run of the droplet to `time` in steps of `dt` in a region by a method.
    ///
    /// # Errors
    /// Those of a run.
    pub fn run(&self, region: Region, method: Method, time: f64, dt: f64) -> Result<Measured, StudyError> {
        let flow = flow(region, method, self.viscosities[1], 1e-11)?;
        let mut scene = Scene::new(flow);
        let droplet = scene.add(self.droplet(method)?);
        scene.run(time).step_size(StepSize::Fixed(dt)).go()?;
        measure(scene.body(droplet)?)
    }

    /// Without the effect of a box on a method that needs one: from boxes of 6, 12 and 24 radii, whose effect is a
    /// series in 1/L^2. Boundary integrals need none.
    ///
    /// # Errors
    /// Those of a run.
    pub fn unbounded(&self, method: Method, time: f64, dt: f64) -> Result<Measured, StudyError> {
        if matches!(method, Method::Integral(_)) {
            return self.run(Region::Plane, method, time, dt);
        }
        let run = |length: f64| self.run(Region::Box { lengths: [length; 2] }, method, time, dt);
        let [a, b, c] = [run(6.0)?, run(12.0)?, run(24.0)?];
        let first = b.combine(4.0 / 3.0, &a, -1.0 / 3.0);
        let second = c.combine(4.0 / 3.0, &b, -1.0 / 3.0);
        Ok(second.combine(16.0 / 15.0, &first, -1.0 / 15.0))
    }

    /// The droplet as a method has it: on an uncorrected grid, by all of Cowley's scheme.
    fn droplet(&self, method: Method) -> Result<ActiveDroplet, StudyError> {
        let count = elements(method)?;
        let curve = Curve::circle(1.0)?;
        let step = TAU / count as f64;
        let numbers: Vec<f64> =
            (0..count).map(|j| self.number(step * j as f64, step * (j + 1) as f64, self.sharpness)).collect();
        ensure!(numbers.iter().all(|&number| number >= 0.0), "a negative concentration");
        // Particles that lower the tension must leave some.
        let most = [0.0, 0.5 * TAU].map(|angle| self.concentration_at(angle, self.sharpness)).into_iter();
        let tension = 10.0 + 2.0 * (self.activity * most.fold(0.0, f64::max)).max(0.0);
        let law = ContractileTension::new(tension, self.activity, ExcludedVolume::None, 1.0)?;
        let droplet = ActiveDroplet::new(&curve.markers(count)?, numbers, law, self.diffusion)?;
        let droplet = if let Method::Grid(GridMethod { corrected: false, .. }) = method {
            let thesis = Setup::thesis().droplets.swap_remove(0);
            let particles = thesis.particles.context("a droplet without particles")?;
            droplet.with_motion(thesis.motion).with_flux(particles.flux).with_area_constraint(thesis.area_constraint)
        } else {
            droplet
        };
        let [inside, outside] = self.viscosities;
        Ok(if inside == outside { droplet } else { droplet.with_viscosity_inside(inside)? })
    }
}

fn elements(method: Method) -> Result<usize, StudyError> {
    Ok(match method {
        Method::Grid(grid) => 4 * (TAU / (2.0 * grid.spacing)).round() as usize,
        Method::Layers(LayersMethod { elements, .. }) | Method::Integral(IntegralMethod { elements, .. }) => elements,
        other => anyhow::bail!("no number of elements by the method {}", other.kind().name()),
    })
}

/// What is measured of a round swimmer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// Coefficients of cos k theta of the concentration, k = 1 to [`MODES`] (particles per length).
    pub modes: [f64; MODES],
    /// Displacement of the centroid along x (length).
    pub displacement: f64,
    /// Largest over smallest distance of markers from the centroid, less one.
    pub deformation: f64,
}

impl Measured {
    fn combine(&self, by: f64, other: &Self, times: f64) -> Self {
        let sum = |a: f64, b: f64| by * a + times * b;
        Self {
            modes: std::array::from_fn(|k| sum(self.modes[k], other.modes[k])),
            displacement: sum(self.displacement, other.displacement),
            deformation: sum(self.deformation, other.deformation),
        }
    }

    /// The distance of two results, relative to `exact`: the largest difference of a mode over the first mode, and the
    /// difference of the displacements.
    #[must_use]
    pub fn distance(&self, other: &Self, exact: &Self) -> [f64; 2] {
        let modes = self.modes.iter().zip(other.modes).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
        [modes / exact.modes[0].abs(), ((self.displacement - other.displacement) / exact.displacement).abs()]
    }
}

fn measure(droplet: &ActiveDroplet) -> Result<Measured, StudyError> {
    let (markers, numbers) = (droplet.markers(), droplet.particle_numbers());
    let count = markers.len();
    let centre = polygon_moments(markers)?.centroid;
    let mut modes = [0.0; MODES];
    for (j, number) in numbers.iter().enumerate() {
        let middle = 0.5 * (markers[j] + markers[(j + 1) % count]) - centre;
        let angle = middle.y.atan2(middle.x);
        for (k, mode) in modes.iter_mut().enumerate() {
            // A mean over an element has less of a wave than its middle.
            let half = 0.5 * (k + 1) as f64 * TAU / count as f64;
            *mode += 2.0 / TAU * number * ((k + 1) as f64 * angle).cos() * half / half.sin();
        }
    }
    let [least, most] = markers.iter().fold([f64::INFINITY, 0.0_f64], |[least, most], marker| {
        let distance = (marker - centre).length();
        [least.min(distance), most.max(distance)]
    });
    Ok(Measured { modes, displacement: centre.x, deformation: most / least - 1.0 })
}
