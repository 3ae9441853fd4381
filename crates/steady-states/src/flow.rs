//! Flow of a droplet: of curves in the plane, or of surfaces of revolution.

use motile::motile_base::Region;
use motile_base::{FlowSample, ImposedFlow, Vec2};
use stokes_layers::axisymmetric::{AxisymmetricFlow, MeridianCalculus};
use stokes_layers::{Interface, InterfaceFlow, LayerError, PeriodicCalculus, Settings, TensionPlacement};

/// Flow and calculus in two or three dimensions.
#[derive(Debug)]
pub(crate) enum Flow {
    Plane { flow: Box<InterfaceFlow>, calculus: PeriodicCalculus },
    Revolution { flow: Box<AxisymmetricFlow>, calculus: MeridianCalculus },
}

impl Flow {
    pub(crate) fn new(region: Region, viscosity: f64, settings: Settings) -> Result<Self, LayerError> {
        let space = || AxisymmetricFlow::new(viscosity, settings);
        let flow = match region {
            Region::Space => space()?,
            Region::Tube { radius } => space()?.with_tube(radius)?,
            _ => {
                let flow = Box::new(InterfaceFlow::new(region, viscosity, settings)?);
                return Ok(Self::Plane { flow, calculus: PeriodicCalculus::new(settings.nodes)? });
            }
        };
        Ok(Self::Revolution { flow: Box::new(flow), calculus: MeridianCalculus::new(settings.nodes)? })
    }

    /// Imposes a flow, which there is none of in three dimensions.
    pub(crate) fn impose(&mut self, imposed: ImposedFlow) -> Result<(), LayerError> {
        if let Self::Plane { flow, .. } = self { flow.impose(imposed, 0.0) } else { Ok(()) }
    }

    pub(crate) fn imposed(&self) -> ImposedFlow {
        if let Self::Plane { flow, .. } = self { flow.imposed() } else { ImposedFlow::NONE }
    }

    /// Forces of a tension (force) at the nodes.
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

    /// Takes over interfaces and solves for their velocities.
    pub(crate) fn solve<'a>(&mut self, all: impl Iterator<Item = Interface<'a>> + Clone) -> Result<(), LayerError> {
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

    /// Velocity (length per time) of a rigid body; zero if there is none of that number.
    pub(crate) fn rigid_velocity(&self, interface: usize) -> Vec2 {
        match self {
            Self::Plane { flow, .. } => flow.rigid_motion(interface).map_or(Vec2::ZERO, |motion| motion.velocity),
            Self::Revolution { flow, .. } => Vec2::new(flow.rigid_velocity(interface).unwrap_or(0.0), 0.0),
        }
    }

    /// Force dipole of what keeps a disc rigid; none in three dimensions, where there are no discs.
    pub(crate) fn rigid_dipole(&self, interface: usize) -> Option<[[f64; 2]; 2]> {
        if let Self::Plane { flow, .. } = self { flow.rigid_dipole(interface) } else { None }
    }

    /// Velocities inside the first interface, which there are in the plane alone.
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
