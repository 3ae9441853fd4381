//! States of droplets in three dimensions, for pictures.

use motile::base::Vec2;
use motile::scene::{Handle, Hydrodynamics, System};
use motile::space_droplets::{SpaceBody, SpaceDroplet, SurfaceMesh};

use crate::{OutputError, Raster, Samples};

/// Half the width of the view that surrounds droplets (radii).
const MARGIN: f64 = 2.2;
/// Relative error of the flow in pictures.
const FLOW_ERROR: f64 = 1e-3;
/// Side of the plane in which the flow is known over the width of the view, which shows the plane at a slant.
const PLANE: f64 = 1.5;
/// Fewest rows of a surface, so that its outline looks smooth.
const ROWS: usize = 60;

/// Surfaces of droplets in three dimensions and the flow in the plane z = const through their middle, at one time, for
/// pictures ([`crate::Look::write_space_picture`]).
#[derive(Debug, Clone)]
pub struct SpaceSnapshot {
    pub(crate) time: f64,
    pub(crate) origin: String,
    pub(crate) meshes: Vec<SurfaceMesh>,
    pub(crate) centroids: Vec<[f64; 3]>,
    /// Middle of the view, and half of its width (length).
    pub(crate) centre: [f64; 3],
    pub(crate) half: f64,
    /// Lines that show walls or a box.
    pub(crate) outline: Vec<Vec<[f64; 3]>>,
    /// Components along x and y of the flow in the plane.
    pub(crate) flow: Option<Samples<Vec2>>,
}

impl SpaceSnapshot {
    /// Takes the present state, with the flow at so many points of the plane in each direction; 0 for none.
    ///
    /// # Errors
    /// Returns [`OutputError::Observer`] for a state whose flow cannot be computed.
    pub fn take<H: Hydrodynamics>(
        system: &mut System<H>,
        body: Handle<SpaceBody>,
        cells: usize,
    ) -> Result<Self, OutputError> {
        let other = |error: Box<dyn std::error::Error + Send + Sync>| OutputError::Observer(error);
        let seen = system.observe(body).map_err(|error| other(error.into()))?;
        let (time, origin) = (system.time(), system.origin().to_owned());
        let droplets = system.body(body).map_err(|error| other(error.into()))?.droplets();
        let mesh = |droplet: &SpaceDroplet| match 2 * droplet.degree() + 1 {
            rows if rows < ROWS => droplet.smooth_mesh(ROWS),
            _ => droplet.mesh(),
        };
        let meshes = droplets.droplets().iter().map(mesh);
        let meshes = meshes.collect::<Result<Vec<_>, _>>().map_err(|error| other(error.into()))?;
        let centroids: Vec<[f64; 3]> = seen.iter().map(|seen| seen.position).collect();
        let extent = |axis: usize, pick: fn(f64, f64) -> f64, start: f64| {
            meshes.iter().flat_map(|mesh| &mesh.points).map(|point| point[axis]).fold(start, pick)
        };
        let bounds = [0, 1, 2].map(|i| [extent(i, f64::min, f64::INFINITY), extent(i, f64::max, f64::NEG_INFINITY)]);
        let centre = bounds.map(|[low, high]| 0.5 * (low + high));
        let radius = seen.iter().map(|seen| seen.semi_axes[0]).fold(0.0, f64::max);
        let half = 0.5 * bounds.iter().map(|[low, high]| high - low).fold(0.0, f64::max) + MARGIN * radius;
        let outline = droplets.outline(centre, half);
        let flow = if cells == 0 {
            None
        } else {
            let reach = PLANE * half;
            let corner = [centre[0] - reach, centre[1] - reach];
            let raster = Raster::new(corner, [2.0 * reach; 2], [cells; 2], [false; 2])?;
            let points: Vec<[f64; 3]> = raster.points().iter().map(|point| [point.x, point.y, centre[2]]).collect();
            let velocities = droplets.velocities_at(&points, FLOW_ERROR).map_err(|error| other(error.into()))?;
            Some(Samples::new(raster, velocities.into_iter().map(|[x, y, _]| Vec2::new(x, y)).collect())?)
        };
        Ok(Self { time, origin, meshes, centroids, centre, half, outline, flow })
    }
}
