//! State of all bodies of a scene and of the flow at one time, for pictures.

use motile::active_interface::{ActiveDroplet, ActiveInterface, polygon_moments};
use motile::base::FlowSample;
use motile::interior::{Defect, GelInDroplet, GelInLayer, ParticlesInDroplet};
use motile::scene::{Hydrodynamics, System};

use crate::{
    InterfaceLine, OutputError, Raster, SolidShape,
    solids::{curve_shapes, fibre_shapes, other_shapes, rigid_shape, solid_shape},
};
use motile::base::Vec2;

/// Distance over which forces are spread on a grid, in grid spacings.
const SMEAR: f64 = 2.0;

/// Droplet at one time.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct DropletOutline {
    /// Markers of the interface (length).
    pub markers: Vec<Vec2>,
    /// Concentration at the markers (particles per length), the mean of the segments on both sides; empty without
    /// particles.
    pub concentration: Vec<f64>,
    /// Centroid (length).
    pub centroid: Vec2,
}

/// Gel at one time.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct GelField {
    /// Positions of the nodes (length).
    pub nodes: Vec<Vec2>,
    /// Director at the nodes (no dimension).
    pub directors: Vec<Vec2>,
    /// Topological defects of the director.
    pub defects: Vec<Defect>,
}

/// Particles that diffuse inside a droplet, at one time.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct InteriorField {
    /// Corners of the triangles of the mesh (length).
    pub triangles: Vec<[Vec2; 3]>,
    /// Densities at these corners (particles per area).
    pub densities: Vec<[f64; 3]>,
}

impl InteriorField {
    fn of(body: &ParticlesInDroplet) -> Self {
        let densities: Vec<f64> = body.densities().collect();
        Self {
            triangles: body.triangles().iter().map(|corners| corners.map(|node| body.nodes()[node])).collect(),
            densities: body.triangles().iter().map(|corners| corners.map(|node| densities[node])).collect(),
        }
    }
}

/// Snapshot of a scene: all droplets and solids, and the flow on a raster.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Snapshot {
    /// Time of the snapshot.
    pub time: f64,
    /// Raster of the sample points of the flow, with the images where they are at this time.
    pub raster: Raster,
    /// Velocity, its gradient and the pressure at the sample points; empty without the flow.
    pub flow: Vec<FlowSample>,
    /// Droplets, in the order of addition.
    pub droplets: Vec<DropletOutline>,
    /// Interfaces that are periodic along x, in the order of addition.
    pub interfaces: Vec<InterfaceLine>,
    /// Gels inside droplets, in the order of addition.
    pub gels: Vec<GelField>,
    /// Particles that diffuse inside droplets, in the order of addition.
    pub inside: Vec<InteriorField>,
    /// Elastic solids, then rigid bodies and membranes, then fibres, then bodies of other types, each in the order of
    /// addition, then rigid walls and obstacles as one more.
    pub solids: Vec<SolidShape>,
    /// Heights of straight rigid walls (length).
    pub walls: Option<[f64; 2]>,
    /// Distance over which the flow smears the forces of interfaces (length): two grid spacings, 0 without a grid.
    pub smear: f64,
    /// Origin of the results ([`System::origin`]), which pictures carry.
    pub origin: String,
}

impl Snapshot {
    /// Creates a snapshot of the present state of a system, with the flow on a raster.
    ///
    /// # Errors
    /// Returns [`OutputError::Scene`] for a flow that cannot be computed; [`OutputError::Interface`] for a droplet
    /// without area.
    pub fn take<H: Hydrodynamics>(system: &mut System<H>, raster: Raster) -> Result<Self, OutputError> {
        let points = raster.points();
        let mut flow = vec![FlowSample::default(); points.len()];
        system.sample(&points, &mut flow)?;
        Ok(Self { flow, ..Self::of_bodies(system, raster)? })
    }

    /// Creates a snapshot of the bodies alone, without the flow and what it costs: no picture can be drawn of it that
    /// shows the flow.
    ///
    /// # Errors
    /// Returns [`OutputError::Interface`] for a droplet without area.
    pub fn of_bodies<H: Hydrodynamics>(system: &System<H>, raster: Raster) -> Result<Self, OutputError> {
        let shape = |(_, droplet): (_, &ActiveDroplet)| {
            let markers = droplet.markers().to_vec();
            let concentration = at_markers(droplet.concentrations());
            Ok(DropletOutline { concentration, centroid: polygon_moments(&markers)?.centroid, markers })
        };
        let fluid = system.hydrodynamics().fluid_view();
        let (walls, smear) = (fluid.domain.walls, fluid.spacing.map_or(0.0, |spacing| SMEAR * spacing));
        let rigid = system.hydrodynamics().walls().map(|boundary| rigid_shape(boundary, walls));
        let gel = |(_, gel): (_, &GelInDroplet)| {
            let (nodes, directors) = (gel.nodes().to_vec(), gel.directors().to_vec());
            GelField { nodes, directors, defects: gel.defects() }
        };
        let layer = |(_, gel): (_, &GelInLayer)| {
            let (nodes, directors) = (gel.nodes().to_vec(), gel.directors().to_vec());
            GelField { nodes, directors, defects: gel.defects() }
        };
        Ok(Self {
            gels: system.bodies().map(gel).chain(system.bodies().map(layer)).collect(),
            inside: system.bodies().map(|(_, body)| InteriorField::of(body)).collect(),
            time: system.time(),
            raster: raster.in_state_of(system),
            flow: Vec::new(),
            droplets: system.bodies().map(shape).collect::<Result<_, OutputError>>()?,
            interfaces: system.bodies().map(|(_, body): (_, &ActiveInterface)| InterfaceLine::of(body)).collect(),
            solids: system
                .bodies()
                .map(|(_, solid)| solid_shape(solid))
                .chain(curve_shapes(system))
                .chain(fibre_shapes(system))
                .chain(other_shapes(system))
                .chain(rigid)
                .collect(),
            walls,
            smear,
            origin: system.origin().to_owned(),
        })
    }

    /// Returns the pressures at the sample points (force per length).
    #[must_use]
    pub fn pressure(&self) -> Vec<f64> {
        self.flow.iter().map(|sample| sample.pressure).collect()
    }

    /// Returns the velocities at the sample points (length per time).
    #[must_use]
    pub fn velocity(&self) -> Vec<Vec2> {
        self.flow.iter().map(|sample| sample.velocity).collect()
    }
}

/// Means of the values of the two segments that meet at each marker.
pub(crate) fn at_markers(segments: &[f64]) -> Vec<f64> {
    let before = segments.iter().cycle().skip(segments.len().saturating_sub(1));
    segments.iter().zip(before).map(|(here, before)| 0.5 * (here + before)).collect()
}

#[cfg(test)]
mod tests;
