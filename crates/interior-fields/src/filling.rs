//! What fills a droplet: nodes that follow its markers.

use std::any::Any;
use std::f64::consts::TAU;

use active_interface::ActiveDroplet;
use ib_core::{Body, BodyError, Handle, MarkerKind, Vec2};

use crate::{DiscMesh, InteriorError};

/// The mesh of something inside a droplet, and how it sees that droplet, its host.
#[derive(Debug, Clone)]
pub(crate) struct Filling {
    pub(crate) host: Handle<ActiveDroplet>,
    pub(crate) mesh: DiscMesh,
    /// Of all nodes, the droplet's markers first: places, velocities of the fluid and of the nodes.
    pub(crate) nodes: Vec<Vec2>,
    pub(crate) fluid: Vec<Vec2>,
    pub(crate) motion: Vec<Vec2>,
    /// Whether the host is a droplet that still has as many markers as the mesh was made for.
    fits: bool,
}

impl Filling {
    /// A mesh of that spacing (length) in `droplet`, which is or will be the body `host` of the scene.
    pub(crate) fn new(
        droplet: &ActiveDroplet,
        host: Handle<ActiveDroplet>,
        spacing: f64,
    ) -> Result<Self, InteriorError> {
        if !matches!(droplet.kind(), MarkerKind::Interface { .. }) {
            return Err(InteriorError::ChangingMarkers);
        }
        let radius = droplet.segment_lengths().iter().sum::<f64>() / TAU;
        let mesh = DiscMesh::new(droplet.markers().len(), spacing / radius)?;
        let [nodes, fluid, motion] = [(); 3].map(|()| vec![Vec2::ZERO; mesh.node_count()]);
        let mut filling = Self { host, mesh, nodes, fluid, motion, fits: true };
        filling.see(droplet, |_| true);
        Ok(filling)
    }

    /// The droplet's markers.
    pub(crate) fn markers(&self) -> &[Vec2] {
        &self.nodes[..self.mesh.marker_count()]
    }

    /// The numbers of the nodes inside, which are markers of the body.
    pub(crate) fn inner(&self) -> std::ops::RangeFrom<usize> {
        self.mesh.marker_count()..
    }

    /// Follows the host's markers, if there are as many as before and it is as it should be.
    pub(crate) fn see<'a>(
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

    /// Follows how the host's markers move, given the velocities of the fluid there.
    pub(crate) fn see_motion(&mut self, host: &dyn Body, velocities: &[Vec2]) {
        let body: &dyn Any = host;
        if let Some(droplet) = body.downcast_ref::<ActiveDroplet>().filter(|_| self.fits) {
            let count = self.mesh.marker_count();
            self.fluid[..count].copy_from_slice(velocities);
            self.motion[..count].copy_from_slice(droplet.marker_motion());
            self.mesh.place(&mut self.motion);
        }
    }

    /// Takes the velocities of the fluid at the nodes inside.
    pub(crate) fn set_flow(&mut self, velocities: &[Vec2]) {
        let inner = self.inner();
        self.fluid[inner].copy_from_slice(velocities);
    }

    /// Refuses a host with another number of markers.
    pub(crate) fn check(&self) -> Result<(), BodyError> {
        if self.fits { Ok(()) } else { Err(InteriorError::ChangingMarkers.into()) }
    }

    /// How many nodes are inside.
    pub(crate) fn inner_count(&self) -> usize {
        self.mesh.node_count() - self.mesh.marker_count()
    }
}
