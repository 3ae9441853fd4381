//! Viscoelastic layers on the walls of a channel: rates, start-up, creep and oscillation against exact solutions.

use std::f64::consts::TAU;

use motile::base::Vec2;
use motile::boundary_integrals::ImmersedLayers;
use motile::elastic_solids::{Maxwell, NeoHookean, Solid, mesh::fitted_strip};
use motile::ib_core::{BSpline, ImmersedBoundary};
use motile::scene::{Body, BodyError, FluidView, Hydrodynamics, MarkerKind, Scene};
use motile::stokes_grid::{ChannelStokes, Grid, WallMotion};

use crate::validation::{StudyError, solids::slide};

/// Distance of the walls (length).
const HEIGHT: f64 = 2.0;
/// Viscosity of the fluid (stress times time).
const VISCOSITY: f64 = 10.0;
/// Points along a layer whose surface carries layers of forces, which needs 16 of them.
const ALONG: [usize; 2] = [8, 40];
const NODES: usize = 16;
/// Size of all strains, small enough for springs to be linear.
const STRAIN: f64 = 1e-3;

/// Layers of a standard linear solid `G(t) = Ginf + G1 exp(-t/tau)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layers {
    /// True for springs, false for neo-Hookean triangles.
    pub springs: bool,
    /// True where surfaces carry layers of forces beside a grid, false where they are smeared over it.
    pub layered: bool,
    /// Ginf and G1 (force per length); with Ginf = 0 the layers flow.
    pub moduli: [f64; 2],
    /// Relaxation time tau (time).
    pub time: f64,
    /// Thickness of a layer (length).
    pub thickness: f64,
}

/// Motion of layers that an exact solution is known of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Motion {
    /// A layer on the lower wall that starts sheared.
    Relaxation,
    /// Two that start sheared by the same.
    Sum,
    /// Two that start sheared by opposite amounts.
    Difference,
    /// The upper wall starts to slide above a layer at rest.
    StartUp,
    /// Two layers under a stress that is switched on.
    Creep,
    /// Two layers under a stress that oscillates at that rate (radians per time).
    Oscillation(f64),
}

/// A row of markers in the middle of the channel with the forces of a stress `T cos(w t)` in both halves of it.
#[derive(Debug)]
struct Shaker {
    markers: Vec<Vec2>,
    force: f64,
    rate: f64,
    phase: f64,
}

impl Body for Shaker {
    fn name(&self) -> &str {
        "shaker"
    }

    fn kind(&self) -> MarkerKind {
        MarkerKind::Points
    }

    fn marker_count(&self) -> usize {
        self.markers.len()
    }

    fn write_markers(&self, positions: &mut [Vec2]) {
        positions.copy_from_slice(&self.markers);
    }

    fn write_forces(&mut self, _view: &FluidView, forces: &mut [Vec2]) -> Result<(), BodyError> {
        forces.fill(Vec2::new(self.force * self.phase.cos(), 0.0));
        Ok(())
    }

    fn state_len(&self) -> usize {
        1
    }

    fn write_state(&self, state: &mut [f64]) {
        state[0] = self.phase;
    }

    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError> {
        self.phase = state[0];
        Ok(())
    }

    fn rate(&mut self, _velocities: &[Vec2], rate: &mut [f64]) {
        rate[0] = self.rate;
    }

    /// Radians.
    fn write_scales(&self, scales: &mut [f64]) {
        scales.fill(1.0);
    }
}

impl Layers {
    /// Roots -l1 and -l2 of `l^2 + l [m (Ginf+G1) + 1/tau] + m Ginf/tau = 0`, the slower one first (1/time).
    fn rates(&self, mobility: f64) -> [f64; 2] {
        let [rest, relaxing] = self.moduli;
        let (sum, product) = (mobility * (rest + relaxing) + 1.0 / self.time, mobility * rest / self.time);
        let root = (0.25 * sum * sum - product).max(0.0).sqrt();
        [product / (0.5 * sum + root), 0.5 * sum + root]
    }

    /// Mobility m (1/(stress times time)) in a motion.
    fn mobility(&self, motion: Motion) -> f64 {
        let part = self.thickness / HEIGHT;
        let free = match motion {
            Motion::Relaxation | Motion::StartUp => 1.0 - part,
            Motion::Sum => 1.0 - 2.0 * part,
            _ => 1.0,
        };
        free / VISCOSITY
    }

    /// The exact shear at the time t, in units of [`STRAIN`].
    fn exact(&self, motion: Motion, t: f64) -> f64 {
        let mobility = self.mobility(motion);
        let [slow, fast] = self.rates(mobility);
        let [rest, relaxing] = self.moduli;
        // f'' + (l1 + l2) f' + l1 l2 (f - end) = 0 from `start` with the slope `slope`.
        let from = |start: f64, slope: f64, end: f64| {
            let part = (fast * (start - end) + slope) / (fast - slow);
            end + part * (-slow * t).exp() + (start - end - part) * (-fast * t).exp()
        };
        match motion {
            Motion::Relaxation | Motion::Sum | Motion::Difference => from(1.0, -mobility * (rest + relaxing), 0.0),
            // The shear of the whole channel is the unit.
            Motion::StartUp => from(0.0, 1.0, 1.0 / (mobility * rest)),
            Motion::Creep => from(0.0, 1.0, VISCOSITY / rest),
            Motion::Oscillation(_) => f64::NAN,
        }
    }

    fn layer(&self, h: f64, length: f64, lower: bool, shear: f64) -> Result<Solid, StudyError> {
        let spacing = if self.layered { 2.0 * h } else { h };
        let mesh = fitted_strip(Vec2::new(0.0, -0.5 * HEIGHT), [length, self.thickness], spacing)?;
        let held = |s: Vec2| s.y.abs() > 0.5 * HEIGHT - 1e-9;
        let mesh = if self.layered && !self.springs { mesh.with_finer_boundary(|s| !held(s))? } else { mesh };
        let mesh = if lower { mesh } else { mesh.mirrored() };
        let [rest, relaxing] = self.moduli;
        let solid = match (rest > 0.0, self.springs) {
            (false, _) => Solid::fluid_like(mesh),
            (true, true) => Solid::springs(mesh, rest)?,
            (true, false) => Solid::hyperelastic(mesh, NeoHookean::new(rest, 2.0 * rest)?),
        };
        let solid = if relaxing > 0.0 { solid.with_maxwell(Maxwell::new(relaxing, self.time)?)? } else { solid };
        let wall = if lower { -0.5 * HEIGHT } else { 0.5 * HEIGHT };
        Ok(solid.pinned(held)?.deformed(|s| s + Vec2::new(shear * (s.y - wall), 0.0))?)
    }

    /// Compares with the exact solution on a grid of spacing `h`, over the time 1, or a period of an oscillation after
    /// three, in that many steps of the time or of each period: the largest error of the shear, over the shear at the
    /// start or, where that is zero, its largest, or that of the complex amplitude over its size.
    ///
    /// # Errors
    /// A grid that does not fit, a step that fails.
    pub fn compare(&self, motion: Motion, h: f64, steps: usize) -> Result<f64, StudyError> {
        let along = ALONG[usize::from(self.layered)];
        let length = along as f64 * h;
        let grid = Grid::channel(along, (HEIGHT / h).round() as usize, h)?;
        let mut solver = ChannelStokes::new(grid, VISCOSITY)?;
        if motion == Motion::StartUp {
            solver.set_walls(WallMotion::uniform(&grid, 0.0, STRAIN * HEIGHT)?)?;
        }
        let flow: Box<dyn Hydrodynamics> = if self.layered {
            Box::new(ImmersedLayers::new(solver, BSpline::<4>, NODES, 1e-8)?)
        } else {
            Box::new(ImmersedBoundary::new(solver, BSpline::<4>))
        };
        let mut scene = Scene::new(flow);
        let [lower, upper] = match motion {
            Motion::Relaxation => [STRAIN, 0.0],
            Motion::Sum => [STRAIN, STRAIN],
            Motion::Difference => [STRAIN, -STRAIN],
            _ => [0.0, 0.0],
        };
        let handle = scene.add(self.layer(h, length, true, lower)?);
        if !matches!(motion, Motion::Relaxation | Motion::StartUp) {
            scene.add(self.layer(h, length, false, upper)?);
        }
        if let Motion::Creep | Motion::Oscillation(_) = motion {
            let rate = if let Motion::Oscillation(rate) = motion { rate } else { 0.0 };
            let markers = (0..2 * along).map(|k| Vec2::new(0.5 * h * (k as f64 + 0.5), 0.0)).collect();
            let force = 2.0 * STRAIN * VISCOSITY * 0.5 * h;
            scene.add(Shaker { markers, force, rate, phase: 0.0 });
        }
        let shear = |scene: &Scene<Box<dyn Hydrodynamics>>| -> Result<f64, StudyError> {
            Ok(slide(scene.body(handle)?) / (self.thickness * STRAIN))
        };
        if let Motion::Oscillation(rate) = motion {
            return self.oscillate(rate, steps, |dt| {
                scene.step(dt)?;
                shear(&scene)
            });
        }
        let (mut error, mut largest) = (0.0_f64, 0.0_f64);
        for step in 1..=steps {
            scene.step(1.0 / steps as f64)?;
            let exact = self.exact(motion, step as f64 / steps as f64);
            error = error.max((shear(&scene)? - exact).abs());
            largest = largest.max(exact.abs());
        }
        let scale = if matches!(motion, Motion::StartUp | Motion::Creep) { largest } else { 1.0 };
        Ok(error / scale)
    }

    /// Compares the complex shear of a period with `eta/(i w eta + G_e)`, the stress being eta [`STRAIN`].
    fn oscillate(
        &self,
        rate: f64,
        steps: usize,
        mut step: impl FnMut(f64) -> Result<f64, StudyError>,
    ) -> Result<f64, StudyError> {
        let dt = TAU / (rate * steps as f64);
        // Until what the start has left is gone, in whole periods.
        let slow = self.rates(1.0 / VISCOSITY)[0];
        let before = (7.0 / slow * rate / TAU).ceil() as usize;
        for _ in 0..before * steps {
            step(dt)?;
        }
        let mut found = [0.0; 2];
        for number in 1..=steps {
            let (shear, phase) = (step(dt)?, TAU * number as f64 / steps as f64);
            found[0] += 2.0 * shear * phase.cos() / steps as f64;
            found[1] -= 2.0 * shear * phase.sin() / steps as f64;
        }
        let [rest, relaxing] = self.moduli;
        let turn = rate * self.time;
        let modulus = [rest + relaxing * turn * turn / (1.0 + turn * turn), relaxing * turn / (1.0 + turn * turn)];
        let below = [modulus[0], rate * VISCOSITY + modulus[1]];
        let size = below[0].hypot(below[1]).powi(2) / VISCOSITY;
        let exact = [below[0] / size, -below[1] / size];
        Ok((found[0] - exact[0]).hypot(found[1] - exact[1]) / exact[0].hypot(exact[1]))
    }
}
