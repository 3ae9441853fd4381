//! Drops with insoluble surfactant in weak extension and shear, against small-deformation theory.
//!
//! Particles that lower the tension (a positive activity) are an insoluble surfactant with a linear law. The theory is
//! of first order in the capillary number. H. A. Stone and L. G. Leal (J. Fluid Mech. 220, 161 (1990)) give such a
//! solution for axisymmetric drops. It is derived here anew, so that no number is taken from a figure.
//!
//! Unit radius, viscosity eta outside and lambda eta inside, tension at rest gamma, mean concentration c0, slope -zeta
//! of the tension, diffusivity D, rate of extension E, capillary number Ca = eta E/gamma.
//!
//! **Plane**, `u = E (x, -y)`. A shape 1 + r cos 2 theta, a concentration c0 + c cos 2 theta, and the flow drive, with
//! S = (1 + lambda) eta, the velocities at the circle
//!
//! ```text
//! v_r     = (2 eta E/S - gamma r/S) cos 2 theta
//! v_theta = (-2 eta E/S + gamma r/(2 S) + zeta c/(2 S)) sin 2 theta
//! ```
//!
//! The first terms are those of a drop without tension (continuity of velocity and stress), the others are Cowley (2.9)
//! to (2.15). In a steady state v_r = 0, so r = 2 Ca and the deformation is 2 Ca whatever the surfactant is: in the
//! plane, gradients of tension do not move a circle along its normal. The balance `2 c0 v_theta = -4 D c` gives
//!
//! ```text
//! c/c0     = 2 eta E/(zeta c0 + 4 D S)
//! |v_theta| = (eta E/S) 4 D/(zeta c0/S + 4 D)
//! ```
//!
//! Shear of rate G is extension of rate G/2 at 45 degrees and a rotation, which changes both in second order only.
//!
//! **Axisymmetric**, `u = E (x, -y/2, -z/2)`. With the shape 1 + f P_2, the concentration c0 + c P_2 and `v_theta = w
//! dP_2/dtheta`, a steady state has v_r = 0. Lamb's solution then has w as its only unknown, and the stresses at the
//! sphere give
//!
//! ```text
//! tangential:  eta (5 E/2 - 5 w) - 5 lambda eta w       = zeta c
//! normal:      eta (5 E + 6 w) + 9 lambda eta w         = 4 gamma f - 2 zeta c
//! surfactant:  c0 w                                     = D c
//! ```
//!
//! so that with B = zeta c0/(D eta)
//!
//! ```text
//! w/E   = (5/2)/(5 (1 + lambda) + B)
//! D_T   = 3 f/4 = (3/16) Ca (5 + (6 + 9 lambda + 2 B) w/E)
//! ```
//!
//! Without surfactant this is Taylor's `(3/2) Ca (16 + 19 lambda)/(16 + 16 lambda)`, and for B to infinity 15/8 Ca.

use std::f64::consts::TAU;

use motile::base::{FlowSample, Region, SolveReport, Vec2};
use motile::boundary_integrals::{AxisymmetricIntegral, Settings};
use motile::scene::{FlowError, FlowWork, FluidView, Hydrodynamics, Markers, Scene, StepSize};
use motile::setup::{Built, DropletSetup, ExcludedVolume, FlowSetup, IntegralMethod, Method, Particles, Setup, Start};
use motile_steady_states::{Profile, SteadyState};

use super::StudyError;

/// A drop of radius 1 with surfactant in fluid of viscosity 1, with the tension 1 at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drop {
    /// Viscosity inside.
    pub ratio: f64,
    /// Elasticity zeta c0 of the surfactant: how much it lowers the tension at rest.
    pub elasticity: f64,
    /// Diffusivity D.
    pub diffusion: f64,
}

/// What surfactant changes, over the capillary number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Response {
    /// Taylor's deformation.
    pub deformation: f64,
    /// Largest less smallest concentration, over the mean.
    pub contrast: f64,
    /// Largest speed of the surface.
    pub speed: f64,
}

impl Response {
    /// Its values, in the order of their names.
    #[must_use]
    pub fn list(&self) -> [f64; 3] {
        [self.deformation, self.contrast, self.speed]
    }

    /// The names of its values.
    pub const NAMES: [&str; 3] = ["deformation", "contrast of c", "speed"];

    /// Half of it: the response to shear, which extends at half its rate.
    #[must_use]
    pub fn half(&self) -> Self {
        self.combine(0.5, self, 0.0)
    }

    fn mean(&self, other: &Self) -> Self {
        self.combine(0.5, other, 0.5)
    }

    fn combine(&self, by: f64, other: &Self, times: f64) -> Self {
        Self {
            deformation: by * self.deformation + times * other.deformation,
            contrast: by * self.contrast + times * other.contrast,
            speed: by * self.speed + times * other.speed,
        }
    }
}

impl Drop {
    /// First-order theory of extension in the plane.
    #[must_use]
    pub fn plane_theory(&self) -> Response {
        let sum = 1.0 + self.ratio;
        let rate = self.elasticity / sum + 4.0 * self.diffusion;
        Response { deformation: 2.0, contrast: 2.0 * 2.0 / (sum * rate), speed: 4.0 * self.diffusion / (sum * rate) }
    }

    /// First-order theory of axisymmetric extension.
    #[must_use]
    pub fn space_theory(&self) -> Response {
        let b = self.elasticity / self.diffusion;
        let w = 2.5 / (5.0 * (1.0 + self.ratio) + b);
        Response {
            deformation: 3.0 / 16.0 * (5.0 + (6.0 + 9.0 * self.ratio + 2.0 * b) * w),
            // P_2 falls from 1 to -1/2, and its derivative is at most 3/2.
            contrast: 1.5 * w / self.diffusion,
            speed: 1.5 * w,
        }
    }

    fn setup(&self, region: Region, nodes: usize, elements: usize) -> Setup {
        let particles = Particles {
            activity: self.elasticity,
            concentration: 1.0,
            diffusion: self.diffusion,
            excluded_volume: ExcludedVolume::None,
            start: Start::Uniform,
            ..Particles::default()
        };
        let viscosity = (self.ratio != 1.0).then_some(self.ratio);
        let tension = 1.0 + self.elasticity;
        let droplet = DropletSetup { viscosity, tension, particles: Some(particles), ..DropletSetup::default() };
        let method = Method::Integral(IntegralMethod { nodes, elements });
        Setup { region, viscosity: 1.0, droplets: vec![droplet], method, ..Setup::default() }
    }

    /// The steady drop in a flow in the plane by Newton's method, its response over the capillary number.
    ///
    /// # Errors
    /// A drop that has no steady state.
    pub fn plane(&self, flow: FlowSetup, capillary: f64, nodes: usize) -> Result<Response, StudyError> {
        let setup = Setup { flow, ..self.setup(Region::Plane, nodes, nodes) };
        let positions = (0..nodes).map(|k| Vec2::from_angle(TAU * k as f64 / nodes as f64)).collect();
        let start = Profile { positions, density: vec![1.0; nodes], nuclei: Vec::new() };
        let state = SteadyState::near(&setup, &start, Vec2::ZERO, flow.shear == 0.0)?;
        let deformation = state.deformation()?;
        let [most, least] = state.measured()?.concentration;
        Ok(Response {
            deformation: deformation.by_moments / capillary,
            contrast: (most - least) / capillary,
            speed: deformation.largest_speed / capillary,
        })
    }

    /// The steady drop of equal viscosity in axisymmetric extension, by a run: the mean response to a rate and its
    /// opposite, over the capillary number.
    ///
    /// # Errors
    /// Those of a run.
    pub fn space(&self, capillary: f64, nodes: usize, elements: usize) -> Result<Response, StudyError> {
        let at = |elements: usize| -> Result<Response, StudyError> {
            let [along, against] = [capillary, -capillary].map(|rate| self.in_extension(rate, nodes, elements));
            Ok(along?.mean(&against?))
        };
        // The error of the elements is of second order.
        let [coarse, fine] = [at(elements)?, at(2 * elements)?];
        Ok(fine.combine(4.0 / 3.0, &coarse, -1.0 / 3.0))
    }

    fn in_extension(&self, rate: f64, nodes: usize, elements: usize) -> Result<Response, StudyError> {
        anyhow::ensure!(self.ratio == 1.0, "the flow is added to that of forces, which needs equal viscosities");
        let Built { scene, droplets, .. } = self.setup(Region::Space, nodes, elements).build()?;
        let settings = Settings { nodes, ..Settings::default() };
        let flow = AxisymmetricIntegral::new(Region::Space, 1.0, settings, TAU)?;
        let drop = scene.body(droplets[0])?.clone();
        let mut scene = Scene::new(Extended { flow, rate });
        let drop = scene.add(drop);
        scene.run(40.0).step_size(StepSize::OfLimit(0.5)).go()?;
        let deformation = scene.system_mut().deformation(drop)?;
        let body = scene.body(drop)?;
        let (markers, count) = (body.markers(), body.markers().len());
        let [mut sum, mut square] = [0.0; 2];
        for (j, c) in body.concentrations().iter().enumerate() {
            let middle = 0.5 * (markers[j] + markers[(j + 1) % count]);
            let (sin, cos) = (middle.y.abs() / middle.length(), middle.x / middle.length());
            let p2 = 1.5 * cos * cos - 0.5;
            sum += (c - 1.0) * p2 * sin;
            square += p2 * p2 * sin;
        }
        let mode = sum / square;
        Ok(Response {
            deformation: deformation.by_extents / rate.abs(),
            contrast: 1.5 * mode / rate,
            speed: deformation.largest_speed / rate.abs(),
        })
    }
}

/// An axisymmetric flow with extension at a rate, among fluids of equal viscosity.
#[derive(Debug)]
struct Extended {
    flow: AxisymmetricIntegral,
    rate: f64,
}

impl Extended {
    fn at(&self, place: Vec2) -> Vec2 {
        self.rate * Vec2::new(place.x, -0.5 * place.y)
    }
}

impl Hydrodynamics for Extended {
    fn fluid_view(&self) -> FluidView {
        self.flow.fluid_view()
    }

    fn axisymmetric(&self) -> bool {
        true
    }

    fn velocities(&mut self, markers: &mut Markers) -> Result<SolveReport, FlowError> {
        let report = self.flow.velocities(markers)?;
        let moved: Vec<Vec2> =
            markers.positions().iter().zip(markers.velocities()).map(|(x, v)| *v + self.at(*x)).collect();
        markers.lists_mut()[2].copy_from_slice(&moved);
        Ok(report)
    }

    fn sample(&mut self, markers: &Markers, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), FlowError> {
        self.flow.sample(markers, points, out)?;
        out.iter_mut().zip(points).for_each(|(sample, x)| sample.velocity += self.at(*x));
        Ok(())
    }

    fn work(&self) -> FlowWork {
        self.flow.work()
    }
}
