//! Where the bodies of a description lie, looked at before anything is meshed.

use active_interface::ActiveDroplet;
use elastic_solids::Interior;
use ib_core::gap::{Boundary, Gaps, Overlap};
use ib_core::{Body, Discretisation, MarkerKind, Vec2};

use super::{DropletSetup, Region, Setup, SolidSetup};
use crate::SetupError;

impl Setup {
    /// Refuses bodies that reach beyond the region, overlap their own images, or lie in one another as they
    /// cannot, and droplets without fluid between them.
    pub(super) fn check_places(
        &self,
        droplets: &[ActiveDroplet],
        solids: &[Interior],
        discretisation: &Discretisation,
    ) -> Result<(), SetupError> {
        let mut bodies = Vec::new();
        for (number, droplet) in droplets.iter().enumerate() {
            self.fits(&self.key(number), droplet.markers().iter().copied(), droplet.markers().len())?;
            bodies.push((Boundary::of(droplet), droplet.kind()));
        }
        for (number, (region, solid)) in solids.iter().zip(&self.solids).enumerate() {
            let key = self.key(droplets.len() + number);
            let grid = discretisation.spacing.unwrap_or(f64::INFINITY);
            let spacing = solid.mesh_spacing.map_or(grid, |spacing| spacing.min(grid));
            let boundary = region.boundary(spacing).map_err(|error| SetupError::from(error).of(&key))?;
            if region.period().is_none() {
                self.fits(&key, boundary.corners(), boundary.corners().count())?;
            }
            bodies.push((boundary, MarkerKind::Points));
        }
        let gaps = Gaps::of(bodies);
        match gaps.first_overlap(discretisation) {
            None => gaps.contact(discretisation).map_or(Ok(()), |(body, other, place)| {
                let ([key, other], [x, y]) = ([body, other].map(|body| self.key(body)), place.into());
                Err(SetupError::Touch { key, other, x, y })
            }),
            Some(Overlap { body, other, place, depth, allowed }) => {
                let ([key, other], [x, y]) = ([body, other].map(|body| self.key(body)), place.into());
                Err(SetupError::Overlap { key, other, x, y, depth, allowed })
            }
        }
    }

    /// Where a body stands in the description, droplets first, with its name if it has one of its own.
    pub(super) fn key(&self, body: usize) -> String {
        let solid = body.wrapping_sub(self.droplets.len());
        let (key, name, usual) = match self.droplets.get(body) {
            Some(droplet) => (format!("droplets[{body}]"), &droplet.name, DropletSetup::NAME),
            None => (format!("solids[{solid}]"), &self.solids[solid].name, SolidSetup::NAME),
        };
        if name == usual { key } else { format!("{key} ({name})") }
    }

    /// Refuses a body that reaches beyond the region or overlaps its own images, by the corners of its boundary.
    fn fits(&self, key: &str, corners: impl Iterator<Item = Vec2>, count: usize) -> Result<(), SetupError> {
        let far = Vec2::splat(f64::INFINITY);
        let (low, high) = corners.fold((far, -far), |(low, high), corner| (low.min(corner), high.max(corner)));
        let [length, width] = self.region.lengths();
        let extent = high - low;
        // The polygon of the markers has the area of its curve and so stands out of it a little.
        let slack = 4.0 * extent.length() / (count * count) as f64;
        let fits = match self.region {
            Region::Plane => true,
            Region::Box { .. } => extent.x < length && extent.y < width,
            Region::Channel { .. } => extent.x < length && high.y.max(-low.y) <= 0.5 * width + slack,
        };
        if fits { Ok(()) } else { Err(SetupError::NoRoom { length, width }.of(key)) }
    }
}
