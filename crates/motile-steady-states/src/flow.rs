//! Flow of a droplet: of curves in the plane, or of surfaces of revolution.

use motile::base::Region;
use motile_base::{FlowSample, ImposedFlow, Vec2};
use stokes_axisymmetric::{AxisymmetricFlow, Disturbances, MeridianCalculus};
use stokes_boundary_integrals::{Interface, InterfaceFlow, LayerError, PeriodicCalculus, Settings, TensionPlacement};

/// Flow and calculus in two or three dimensions.
#[derive(Debug)]
pub(crate) enum Flow {
    Plane { flow: Box<InterfaceFlow>, calculus: Box<PeriodicCalculus> },
    Revolution { flow: Box<AxisymmetricFlow>, calculus: Box<MeridianCalculus>, tangent: Option<Box<Tangent>> },
}

/// Linear flow about a state of a body of revolution: its points, forces and velocities, and what disturbances change.
#[derive(Debug)]
pub(crate) struct Tangent {
    positions: Vec<Vec2>,
    forces: Vec<Vec2>,
    velocities: Vec<Vec2>,
    disturbances: Disturbances,
}

impl Flow {
    pub(crate) fn new(region: Region, viscosity: f64, settings: Settings) -> Result<Self, LayerError> {
        if !region.is_axisymmetric() {
            let flow = Box::new(InterfaceFlow::new(region, viscosity, settings)?);
            let calculus = Box::new(PeriodicCalculus::new(settings.nodes)?);
            return Ok(Self::Plane { flow, calculus });
        }
        let flow = Box::new(AxisymmetricFlow::in_region(region, viscosity, settings)?);
        let calculus = Box::new(MeridianCalculus::new(settings.nodes)?);
        Ok(Self::Revolution { flow, calculus, tangent: None })
    }

    /// Keeps to the linear flow about the last state from here on, until [`Flow::release`]: in three dimensions, where
    /// the derivative of the flow costs a few solutions of it. In the plane nothing changes.
    pub(crate) fn linearise(
        &mut self,
        positions: &[Vec2],
        forces: &[Vec2],
        velocities: &[Vec2],
    ) -> Result<(), LayerError> {
        if let Self::Revolution { flow, tangent, .. } = self {
            let [positions, forces, velocities] = [positions, forces, velocities].map(<[Vec2]>::to_vec);
            let disturbances = flow.disturbances(0)?;
            *tangent = Some(Box::new(Tangent { positions, forces, velocities, disturbances }));
        }
        Ok(())
    }

    /// Solves for the flow of every state again.
    pub(crate) fn release(&mut self) {
        if let Self::Revolution { tangent, .. } = self {
            *tangent = None;
        }
    }

    /// Writes the velocities (length per time) of the linear flow; false if the flow is not to be linear.
    pub(crate) fn approximate(
        &self,
        positions: &[Vec2],
        forces: &[Vec2],
        out: &mut [Vec2],
    ) -> Result<bool, LayerError> {
        let Self::Revolution { tangent: Some(tangent), .. } = self else { return Ok(false) };
        let less = |a: &[Vec2], b: &[Vec2]| a.iter().zip(b).map(|(a, b)| *a - *b).collect::<Vec<_>>();
        let (shape, pull) = (less(positions, &tangent.positions), less(forces, &tangent.forces));
        tangent.disturbances.velocities_at_points(&shape, &pull, out)?;
        out.iter_mut().zip(&tangent.velocities).for_each(|(out, velocity)| *out += *velocity);
        Ok(true)
    }

    /// Disturbances of an order around the axis of the last solution; `None` in the plane.
    pub(crate) fn disturbances(&mut self, order: usize) -> Result<Option<Disturbances>, LayerError> {
        if let Self::Revolution { flow, .. } = self { flow.disturbances(order).map(Some) } else { Ok(None) }
    }

    /// Imposes a flow, which there is none of in three dimensions.
    pub(crate) fn impose(&mut self, imposed: ImposedFlow) -> Result<(), LayerError> {
        if let Self::Plane { flow, .. } = self { flow.impose(imposed, 0.0) } else { Ok(()) }
    }

    /// Returns half the length of a straight tube and the distance of its nodes (length), if there is a tube yet.
    pub(crate) fn tube(&self) -> Option<[f64; 2]> {
        if let Self::Revolution { flow, .. } = self { flow.tube_resolution() } else { None }
    }

    /// Gives a straight tube this length and distance of nodes.
    pub(crate) fn restore_tube(&mut self, tube: [f64; 2]) -> Result<(), LayerError> {
        if let Self::Revolution { flow, .. } = self { flow.restore_tube(tube) } else { Ok(()) }
    }

    pub(crate) fn imposed(&self) -> ImposedFlow {
        if let Self::Plane { flow, .. } = self { flow.imposed() } else { ImposedFlow::NONE }
    }

    /// Returns the forces of a tension (force) at the nodes.
    pub(crate) fn tension_forces(
        &mut self,
        positions: &[Vec2],
        tension: &[f64],
        placement: TensionPlacement,
        forces: &mut [Vec2],
    ) -> Result<(), LayerError> {
        match self {
            Self::Plane { calculus, .. } => calculus.tension_forces(positions, tension, placement, forces),
            Self::Revolution { calculus, .. } => calculus.tension_forces(positions, tension, placement, forces),
        }
    }

    /// Returns the forces of stresses along and around the axis (force per length) at the nodes; in the plane, of that
    /// along the interface (force).
    pub(crate) fn stress_forces(
        &mut self,
        positions: &[Vec2],
        [along, around]: [&[f64]; 2],
        forces: &mut [Vec2],
    ) -> Result<(), LayerError> {
        let placement = TensionPlacement::Points;
        match self {
            Self::Plane { calculus, .. } => calculus.tension_forces(positions, along, placement, forces),
            Self::Revolution { calculus, .. } => calculus.stress_forces(positions, [along, around], placement, forces),
        }
    }

    /// Takes over interfaces and solves for their velocities.
    pub(crate) fn solve<'a>(
        &mut self,
        all: impl Iterator<Item = Interface<'a>> + Clone + Send,
    ) -> Result<(), LayerError> {
        match self {
            Self::Plane { flow, .. } => flow.load(all).and_then(|()| flow.solve()),
            Self::Revolution { flow, .. } => flow.load(all).and_then(|()| flow.solve()),
        }
        .map(drop)
    }

    pub(crate) fn velocities(&mut self, interface: usize, out: &mut [Vec2]) -> Result<(), LayerError> {
        match self {
            Self::Plane { flow, .. } => flow.velocities(interface, out),
            Self::Revolution { flow, .. } => flow.velocities(interface, out),
        }
    }

    /// Returns the velocity (length per time) of a rigid body; zero if there is none of that number.
    pub(crate) fn rigid_velocity(&self, interface: usize) -> Vec2 {
        match self {
            Self::Plane { flow, .. } => flow.rigid_motion(interface).map_or(Vec2::ZERO, |motion| motion.velocity),
            Self::Revolution { flow, .. } => Vec2::new(flow.rigid_velocity(interface).unwrap_or(0.0), 0.0),
        }
    }

    /// Returns the force dipole of what keeps a disc rigid; none in three dimensions, if there are no discs.
    pub(crate) fn rigid_dipole(&self, interface: usize) -> Option<[[f64; 2]; 2]> {
        if let Self::Plane { flow, .. } = self { flow.rigid_dipole(interface) } else { None }
    }

    /// Returns the velocities inside the first interface, which there are in the plane alone.
    pub(crate) fn velocities_inside(&mut self, points: &[Vec2], out: &mut [Vec2]) -> Result<(), LayerError> {
        if let Self::Plane { flow, .. } = self { flow.velocities_inside(0, points, out) } else { Ok(()) }
    }

    pub(crate) fn sample(&mut self, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), LayerError> {
        match self {
            Self::Plane { flow, .. } => flow.sample(points, out),
            Self::Revolution { flow, .. } => flow.sample(points, out),
        }
    }
}
