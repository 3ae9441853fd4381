//! The rate of change of a droplet as a function of its state.

use std::f64::consts::{PI, TAU};

use fourier::PeriodicSeries;
use motile::active_interface::{ContractileTension, Tension};
use motile::ib_core::{FlowSample, Vec2};
use motile::{DropletSetup, DropletShape, Method, Particles, Region, RigidBodySetup, Setup};
use num_complex::Complex64;
use stokes_layers::{Interface, InterfaceFlow, PeriodicCalculus, Settings, TensionPlacement};

use crate::{Profile, SteadyError};

/// Accuracy of everything that the flow truncates, so that differences of rates keep their digits.
const TOLERANCE: f64 = 1e-13;

/// The curve that shapes are offsets of, along its normals.
#[derive(Debug, Clone)]
pub(crate) struct Base {
    pub(crate) positions: Vec<Vec2>,
    pub(crate) normals: Vec<Vec2>,
}

impl Base {
    pub(crate) fn new(profile: &Profile) -> Result<Self, SteadyError> {
        let normals = profile.tangents()?.iter().map(|t| outward(*t)).collect();
        Ok(Self { positions: profile.positions.clone(), normals })
    }
}

impl Base {
    /// The same curve after a turn about the origin and a shift across.
    pub(crate) fn moved(&self, height: f64, angle: f64) -> Self {
        let turn = Vec2::from_angle(angle);
        let shift = Vec2::new(0.0, height);
        Self {
            positions: self.positions.iter().map(|x| turn.rotate(*x) + shift).collect(),
            normals: self.normals.iter().map(|n| turn.rotate(*n)).collect(),
        }
    }
}

/// Unit normal to the right of a tangent.
fn outward(tangent: Vec2) -> Vec2 {
    -tangent.perp().normalize()
}

/// How the frame of a droplet moves: velocity and rate of turning about the origin.
pub(crate) type FrameMotion = [f64; 3];

/// A rigid disc inside, free of force and torque.
#[derive(Debug)]
struct Nucleus {
    radius: f64,
    centre: Vec2,
    velocity: Vec2,
    surface: Vec<Vec2>,
}

/// A droplet of a description at N nodes. Its state is the offset h of its shape along the normals n0 of a curve x0 and
/// the number of particles per parameter, m; in a frame that moves with the velocity V
///
/// ```text
/// x = x0 + h n0,   c = m/|x_a|,   F = d(gamma(c) tau)/ds
/// dh/dt = (v - V).n/(n0.n),   q = (v - V - dh/dt n0).tau,   dm/dt = -d(q c - D dc/ds)/da
/// ```
/// a the parameter: the equations (2.3), (2.5) and (2.39) of Cowley and the motion of the interface with the fluid,
/// with points that slide along fixed lines. Rigid discs inside move with the fluid; their places x and y, and the
/// rates of these, stand after the offsets and the densities.
#[derive(Debug)]
pub(crate) struct Model {
    pub(crate) setup: Setup,
    pub(crate) radius: f64,
    pub(crate) concentration: f64,
    pub(crate) viscosities: [f64; 2],
    diffusion: f64,
    law: ContractileTension,
    flow: InterfaceFlow,
    calculus: PeriodicCalculus,
    series: PeriodicSeries,
    pub(crate) positions: Vec<Vec2>,
    tangents: Vec<Vec2>,
    pub(crate) concentrations: Vec<f64>,
    tensions: Vec<f64>,
    pub(crate) forces: Vec<Vec2>,
    pub(crate) velocities: Vec<Vec2>,
    nuclei: Vec<Nucleus>,
    /// No forces.
    none: Vec<Vec2>,
    /// dh/dt and q, and dm/dt, of the last rates.
    offset_rates: Vec<f64>,
    density_rates: Vec<f64>,
    slip: Vec<f64>,
    /// Evaluations of the flow.
    pub(crate) evaluations: usize,
}

impl Model {
    /// The model of a description, at the nodes that it has.
    pub(crate) fn new(setup: &Setup) -> Result<Self, SteadyError> {
        let refuse = |what: &str, remedy| Err(SteadyError::Unsupported { what: what.to_owned(), remedy });
        setup.check()?;
        let Method::Integral(method) = setup.method else {
            return refuse("the scene has a grid", "give the method of boundary integrals");
        };
        let [DropletSetup { particles: Some(particles), tension, viscosity, shape, .. }] = setup.droplets.as_slice()
        else {
            return refuse("the scene is not of one active droplet", "give one droplet with particles");
        };
        if !(setup.solids.is_empty() && setup.shells.is_empty() && setup.rigid.is_empty()) || setup.repulsion.is_some()
        {
            return refuse("the scene has solids, shells, walls of their own or a repulsion", "leave them out");
        }
        let disc = |body: &RigidBodySetup| match body.shape {
            DropletShape::Round { radius } if body.force == [0.0; 2] && body.torque == 0.0 => Some(radius),
            _ => None,
        };
        let Some(discs) = setup.rigid_bodies.iter().map(disc).collect::<Option<Vec<f64>>>() else {
            return refuse("a rigid body is no disc, or is acted on", "give a round one without force and torque");
        };
        let (DropletShape::Round { radius } | DropletShape::Squeezed { radius, .. }) = *shape else {
            return refuse("the droplet has a shape of its own", "give a round one");
        };
        let nodes = method.nodes - method.nodes % 2;
        let settings = Settings { nodes, tolerance: TOLERANCE, ..Settings::default() };
        if particles.exchange.is_some() {
            return refuse("the particles are exchanged with the inside", "leave the exchange out");
        }
        let &Particles { diffusion, concentration, .. } = particles;
        motile::ib_core::input::positive("the diffusion constant", diffusion)?;
        let nucleus =
            |radius| Nucleus { radius, centre: Vec2::ZERO, velocity: Vec2::ZERO, surface: vec![Vec2::ZERO; nodes] };
        Ok(Self {
            setup: setup.clone(),
            radius,
            concentration,
            viscosities: [viscosity.unwrap_or(setup.viscosity), setup.viscosity],
            diffusion,
            law: particles.law(*tension)?,
            flow: InterfaceFlow::new(setup.region.geometry(), setup.viscosity, settings)?,
            calculus: PeriodicCalculus::new(nodes)?,
            series: PeriodicSeries::new(nodes)?,
            positions: vec![Vec2::ZERO; nodes],
            tangents: vec![Vec2::ZERO; nodes],
            concentrations: vec![0.0; nodes],
            tensions: vec![0.0; nodes],
            forces: vec![Vec2::ZERO; nodes],
            velocities: vec![Vec2::ZERO; nodes],
            offset_rates: vec![0.0; nodes + discs.len()],
            density_rates: vec![0.0; nodes + discs.len()],
            nuclei: discs.into_iter().map(nucleus).collect(),
            none: vec![Vec2::ZERO; nodes],
            slip: vec![0.0; nodes],
            evaluations: 0,
        })
    }

    pub(crate) fn nodes(&self) -> usize {
        self.positions.len()
    }

    pub(crate) fn nuclei(&self) -> usize {
        self.nuclei.len()
    }

    /// Area of the droplet (length squared) and number of its particles.
    pub(crate) fn conserved(&self) -> [f64; 2] {
        [PI * self.radius * self.radius, TAU * self.radius * self.concentration]
    }

    /// The rate D/R^2 (1/time).
    pub(crate) fn diffusion_rate(&self) -> f64 {
        self.diffusion / (self.radius * self.radius)
    }

    pub(crate) fn in_plane(&self) -> bool {
        self.setup.region == Region::Plane
    }

    pub(crate) fn in_channel(&self) -> bool {
        matches!(self.setup.region, Region::Channel { .. })
    }

    /// Takes over a state and finds its flow.
    pub(crate) fn load(&mut self, base: &Base, offsets: &[f64], density: &[f64]) -> Result<(), SteadyError> {
        for (k, position) in self.positions.iter_mut().enumerate() {
            *position = base.positions[k] + offsets[k] * base.normals[k];
        }
        self.series.analyse_vectors(&self.positions)?;
        self.series.differentiate();
        self.series.write_vectors(&mut self.tangents)?;
        for ((c, m), tangent) in self.concentrations.iter_mut().zip(density).zip(&self.tangents) {
            *c = m / tangent.length();
        }
        self.law.values(&self.concentrations, &mut self.tensions);
        let Self { calculus, positions, tensions, forces, .. } = self;
        calculus.tension_forces(positions, tensions, TensionPlacement::Points, forces)?;
        let viscosity = self.viscosities[0];
        let viscosities = [viscosity, self.flow.viscosity()];
        for (k, Nucleus { radius, centre, surface, .. }) in self.nuclei.iter_mut().enumerate() {
            *centre = Vec2::new(offsets[positions.len() + k], density[positions.len() + k]);
            let step = TAU / surface.len() as f64;
            for (j, point) in surface.iter_mut().enumerate() {
                *point = *centre + *radius * Vec2::from_angle(step * j as f64);
            }
        }
        let discs = self.nuclei.iter().map(|disc| Interface::rigid(&disc.surface, &self.none, viscosity));
        self.flow.load(std::iter::once(Interface::closed(positions, forces, viscosities)).chain(discs))?;
        self.flow.solve()?;
        self.evaluations += 1;
        for (k, nucleus) in self.nuclei.iter_mut().enumerate() {
            nucleus.velocity = self.flow.rigid_motion(1 + k).map_or(Vec2::ZERO, |motion| motion.velocity);
        }
        Ok(self.flow.velocities(0, &mut self.velocities)?)
    }

    /// The flow at points, of the state that was taken over.
    pub(crate) fn sample(&mut self, points: &[Vec2]) -> Result<Vec<FlowSample>, SteadyError> {
        let mut samples = vec![FlowSample::default(); points.len()];
        self.flow.sample(points, &mut samples)?;
        Ok(samples)
    }

    /// Derivative of the area by each offset, and of the number of particles by each density, times N/(2 pi).
    pub(crate) fn area_gradient(&self, base: &Base) -> Vec<f64> {
        let normals = self.tangents.iter().map(|t| -t.perp());
        normals.zip(&base.normals).map(|(weighted, n0)| weighted.dot(*n0)).collect()
    }

    /// Area (length squared) and number of particles of the present state.
    pub(crate) fn present(&self) -> [f64; 2] {
        let step = TAU / self.nodes() as f64;
        let (mut area, mut number) = (0.0, 0.0);
        for ((x, t), c) in self.positions.iter().zip(&self.tangents).zip(&self.concentrations) {
            area += 0.5 * x.perp_dot(*t) * step;
            number += c * t.length() * step;
        }
        [area, number]
    }

    /// dh/dt and dm/dt of the present state in a moving frame.
    pub(crate) fn rates(&mut self, base: &Base, [ux, uy, turn]: FrameMotion) -> Result<(&[f64], &[f64]), SteadyError> {
        let frame = |x: Vec2| Vec2::new(ux - turn * x.y, uy + turn * x.x);
        let velocities = std::mem::take(&mut self.velocities);
        self.transport(base, |k, x| velocities[k] - frame(x));
        self.velocities = velocities;
        self.carry(|nucleus| nucleus.velocity - frame(nucleus.centre));
        // The diffusive flux, which needs the gradient of the concentration.
        self.series.analyse(self.concentrations.iter().map(|&c| Complex64::new(c, 0.0)))?;
        self.series.differentiate();
        for ((flux, slope), tangent) in self.slip.iter_mut().zip(self.series.values()).zip(&self.tangents) {
            *flux -= self.diffusion * slope.re / tangent.length();
        }
        self.divergence()
    }

    /// The rates that a rigid motion has, in which h and m change as if the fluid moved like this.
    pub(crate) fn rigid_rates(&mut self, base: &Base, motion: FrameMotion) -> Result<(&[f64], &[f64]), SteadyError> {
        let [ux, uy, turn] = motion;
        let velocity = |x: Vec2| Vec2::new(ux - turn * x.y, uy + turn * x.x);
        self.transport(base, |_, x| velocity(x));
        self.carry(|nucleus| velocity(nucleus.centre));
        self.divergence()
    }

    fn transport(&mut self, base: &Base, velocity: impl Fn(usize, Vec2) -> Vec2) {
        for (k, tangent) in self.tangents.iter().enumerate() {
            let (n0, n) = (base.normals[k], -tangent.perp());
            let w = velocity(k, self.positions[k]);
            let rate = w.dot(n) / n0.dot(n);
            self.offset_rates[k] = rate;
            self.slip[k] = (w - rate * n0).dot(tangent.normalize()) * self.concentrations[k];
        }
    }

    /// Velocities of the nuclei as rates.
    fn carry(&mut self, velocity: impl Fn(&Nucleus) -> Vec2) {
        let nodes = self.nodes();
        for (k, nucleus) in self.nuclei.iter().enumerate() {
            let Vec2 { x, y } = velocity(nucleus);
            (self.offset_rates[nodes + k], self.density_rates[nodes + k]) = (x, y);
        }
    }

    fn divergence(&mut self) -> Result<(&[f64], &[f64]), SteadyError> {
        self.series.analyse(self.slip.iter().map(|&flux| Complex64::new(flux, 0.0)))?;
        self.series.differentiate();
        for (rate, value) in self.density_rates.iter_mut().zip(self.series.values()) {
            *rate = -value.re;
        }
        Ok((&self.offset_rates, &self.density_rates))
    }
}
