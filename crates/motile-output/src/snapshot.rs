//! All droplets, solids and the flow around them at one time.

use motile::active_interface::{ActiveDroplet, curve::polygon_moments};
use motile::ib_core::{FlowSample, Hydrodynamics, System};
use motile::interior_fields::{Defect, GelInDroplet, ParticlesInDroplet};

use crate::{
    Error, Raster, SolidShape, Vec2,
    solids::{curve_shapes, rigid_shape, solid_shape},
};

/// A droplet at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct DropletOutline {
    /// The interface (length).
    pub markers: Vec<Vec2>,
    /// Concentration at the markers (particles per length), the mean of that in the segments on both sides.
    pub concentration: Vec<f64>,
    /// Centroid (length).
    pub centroid: Vec2,
}

/// A gel at one time.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct GelField {
    /// Its nodes (length).
    pub nodes: Vec<Vec2>,
    /// The director at them (no dimension).
    pub directors: Vec<Vec2>,
    /// The points about which it turns.
    pub defects: Vec<Defect>,
}

/// Particles that diffuse inside a droplet, at one time.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct InteriorField {
    /// The triangles of its mesh (length).
    pub triangles: Vec<[Vec2; 3]>,
    /// The densities at their corners (particles per area).
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

/// All droplets and solids of a scene and the flow on a raster, at one time.
#[derive(Debug, Clone)]
pub struct Snapshot {
    /// When.
    pub time: f64,
    /// The sample points of the flow.
    pub raster: Raster,
    /// The flow at them.
    pub flow: Vec<FlowSample>,
    /// The droplets, in the order of addition.
    pub droplets: Vec<DropletOutline>,
    /// The gels inside droplets, in the order of addition.
    pub gels: Vec<GelField>,
    /// The particles that diffuse inside droplets, in the order of addition.
    pub inside: Vec<InteriorField>,
    /// The elastic solids, rigid bodies and membranes, each in the order of addition, and rigid walls and obstacles as
    /// one more.
    pub solids: Vec<SolidShape>,
    /// Heights of straight rigid walls (length).
    pub walls: Option<[f64; 2]>,
}

impl Snapshot {
    /// The present state of a system, with the flow on a raster.
    ///
    /// # Errors
    /// [`Error::Scene`]: a flow that cannot be computed.
    pub fn take<H: Hydrodynamics>(system: &mut System<H>, raster: Raster) -> Result<Self, Error> {
        let points = raster.points();
        let mut flow = vec![FlowSample::default(); points.len()];
        system.sample(&points, &mut flow)?;
        let shape = |(_, droplet): (_, &ActiveDroplet)| {
            let markers = droplet.markers().to_vec();
            let concentration = at_markers(droplet.concentrations());
            Ok(DropletOutline { concentration, centroid: polygon_moments(&markers)?.centroid, markers })
        };
        let walls = system.hydrodynamics().discretisation().domain.walls;
        let rigid = system.hydrodynamics().walls().map(|boundary| rigid_shape(boundary, walls));
        let gel = |(_, gel): (_, &GelInDroplet)| {
            let (nodes, directors) = (gel.nodes().to_vec(), gel.directors().to_vec());
            GelField { nodes, directors, defects: gel.defects() }
        };
        Ok(Self {
            gels: system.bodies().map(gel).collect(),
            inside: system.bodies().map(|(_, body)| InteriorField::of(body)).collect(),
            time: system.time(),
            raster,
            flow,
            droplets: system.bodies().map(shape).collect::<Result<_, Error>>()?,
            solids: system
                .bodies()
                .map(|(_, solid)| solid_shape(solid))
                .chain(curve_shapes(system))
                .chain(rigid)
                .collect(),
            walls,
        })
    }

    /// Pressures at the sample points (force per length).
    #[must_use]
    pub fn pressure(&self) -> Vec<f64> {
        self.flow.iter().map(|sample| sample.pressure).collect()
    }

    /// Velocities at the sample points (length per time).
    #[must_use]
    pub fn velocity(&self) -> Vec<Vec2> {
        self.flow.iter().map(|sample| sample.velocity).collect()
    }
}

/// The mean of the values of the two segments that meet at each marker.
pub(crate) fn at_markers(segments: &[f64]) -> Vec<f64> {
    let before = segments.iter().cycle().skip(segments.len().saturating_sub(1));
    segments.iter().zip(before).map(|(here, before)| 0.5 * (here + before)).collect()
}

#[cfg(test)]
mod tests;
