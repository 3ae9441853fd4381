//! Mesh inside a droplet that follows its markers, for bodies that fill the droplet.

use std::any::Any;
use std::f64::consts::TAU;

use active_interface::ActiveDroplet;
use motile_base::Vec2;
use motile_scene::{Body, BodyError, Handle, MarkerKind};

use crate::{DiscMesh, InteriorError};

/// Mesh inside a droplet, the host, with positions and velocities of its nodes.
#[derive(Debug, Clone)]
pub(crate) struct Filling {
    pub(crate) host: Handle<ActiveDroplet>,
    pub(crate) mesh: DiscMesh,
    /// For all nodes, the droplet's markers first: positions (length), velocities of the fluid and of the nodes (length
    /// per time).
    pub(crate) nodes: Vec<Vec2>,
    pub(crate) fluid: Vec<Vec2>,
    pub(crate) motion: Vec<Vec2>,
    /// True if the host is a droplet with as many markers as the mesh was made for.
    fits: bool,
}

/// Methods that bodies with a `filling` and a `name` share: access to the mesh, and the parts of the traits
/// `InteriorBody` and `Body` by which the inner nodes are markers that move with the host.
macro_rules! in_droplet {
    (mesh) => {
        /// Returns the positions of the nodes (length), the droplet's markers first.
        #[must_use]
        pub fn nodes(&self) -> &[Vec2] {
            &self.filling.nodes
        }

        /// Returns the triangles by the numbers of their nodes, counter-clockwise.
        #[must_use]
        pub fn triangles(&self) -> &[[usize; 3]] {
            self.filling.mesh.triangles()
        }

        /// Returns the handle of the droplet that is filled.
        #[must_use]
        pub fn droplet(&self) -> Handle<ActiveDroplet> {
            self.filling.host
        }
    };
    (interior_body) => {
        fn host(&self) -> Handle<dyn Body> {
            self.filling.host.into()
        }

        fn host_moved(&mut self, host: &dyn Body, velocities: &[Vec2]) {
            self.filling.host_moved(host, velocities);
        }
    };
    (body) => {
        fn name(&self) -> &str {
            &self.name
        }

        fn kind(&self) -> MarkerKind {
            MarkerKind::Points
        }

        fn marker_count(&self) -> usize {
            self.filling.inner_count()
        }

        fn write_markers(&self, positions: &mut [Vec2]) {
            positions.copy_from_slice(&self.filling.nodes[self.filling.inner()]);
        }

        fn as_interior_body(&mut self) -> Option<&mut dyn InteriorBody> {
            Some(self)
        }
    };
}
pub(crate) use in_droplet;

impl Filling {
    /// Creates a mesh of a spacing (length), which grows by a factor from ring to ring, in `droplet`, which is or will
    /// be the body `host` of the scene.
    pub(crate) fn new(
        droplet: &ActiveDroplet,
        host: Handle<ActiveDroplet>,
        spacing: f64,
        growth: f64,
    ) -> Result<Self, InteriorError> {
        if !matches!(droplet.kind(), MarkerKind::Interface { .. }) {
            return Err(InteriorError::changing_markers());
        }
        let radius = droplet.element_lengths().iter().sum::<f64>() / TAU;
        let mesh = DiscMesh::graded(droplet.markers().len(), spacing / radius, growth)?;
        let [nodes, fluid, motion] = [(); 3].map(|()| vec![Vec2::ZERO; mesh.node_count()]);
        let mut filling = Self { host, mesh, nodes, fluid, motion, fits: true };
        filling.update_host(droplet, |_| true);
        Ok(filling)
    }

    /// Returns the positions of the droplet's markers (length).
    pub(crate) fn markers(&self) -> &[Vec2] {
        &self.nodes[..self.mesh.marker_count()]
    }

    /// Returns the numbers of the inner nodes, which are the markers of the body.
    pub(crate) fn inner(&self) -> std::ops::RangeFrom<usize> {
        self.mesh.marker_count()..
    }

    /// Follows the host's markers and returns the host, if it has as many markers as before and `is_right` says yes.
    pub(crate) fn update_host<'a>(
        &mut self,
        host: &'a dyn Body,
        is_right: impl Fn(&ActiveDroplet) -> bool,
    ) -> Option<&'a ActiveDroplet> {
        let body: &dyn Any = host;
        let count = self.mesh.marker_count();
        let droplet = body.downcast_ref::<ActiveDroplet>();
        let droplet = droplet.filter(|droplet| droplet.markers().len() == count && is_right(droplet));
        self.fits = droplet.is_some();
        self.nodes[..count].copy_from_slice(droplet?.markers());
        self.mesh.place(&mut self.nodes);
        droplet
    }

    /// Follows the motion of the host's markers, and takes the velocities of the fluid there (length per time).
    pub(crate) fn host_moved(&mut self, host: &dyn Body, velocities: &[Vec2]) {
        let body: &dyn Any = host;
        if let Some(droplet) = body.downcast_ref::<ActiveDroplet>().filter(|_| self.fits) {
            let count = self.mesh.marker_count();
            self.fluid[..count].copy_from_slice(velocities);
            self.motion[..count].copy_from_slice(droplet.marker_motion());
            self.mesh.place(&mut self.motion);
        }
    }

    /// Takes the velocities of the fluid at the inner nodes (length per time).
    pub(crate) fn set_flow(&mut self, velocities: &[Vec2]) {
        let inner = self.inner();
        self.fluid[inner].copy_from_slice(velocities);
    }

    /// Refuses a host with another number of markers.
    pub(crate) fn check(&self) -> Result<(), BodyError> {
        if self.fits { Ok(()) } else { Err(InteriorError::changing_markers().into()) }
    }

    /// Returns the number of inner nodes.
    pub(crate) fn inner_count(&self) -> usize {
        self.mesh.node_count() - self.mesh.marker_count()
    }
}
