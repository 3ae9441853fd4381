//! Where the bodies of a description lie, looked at before anything is meshed.

use active_interface::ActiveDroplet;
use elastic_solids::{Interior, RigidBody, Shell};
use ib_core::gap::{Boundary, Gaps, Overlap};
use ib_core::{Body, Hydrodynamics, MarkerKind, Vec2};

use super::{AnyFlow, DropletSetup, DropletShape, Region, RigidBodySetup, Setup, ShellSetup, SolidSetup};
use crate::SetupError;

/// Corners of an outline by which is told what lies in what.
const CORNERS: usize = 128;

impl Setup {
    /// Refuses bodies that reach beyond the region, overlap their own images, or lie in one another as they
    /// cannot, and droplets without fluid between them.
    pub(super) fn check_places(
        &self,
        droplets: &[ActiveDroplet],
        solids: &[Interior],
        rigid_bodies: &[RigidBody],
        shells: &[Shell],
        flow: &AnyFlow,
    ) -> Result<(), SetupError> {
        let discretisation = &flow.discretisation();
        let curve = |number: usize, body: &dyn Body| {
            let (key, mut markers) = (self.key(number), vec![Vec2::ZERO; body.marker_count()]);
            body.write_markers(&mut markers);
            self.fits(&key, markers.iter().copied(), markers.len())?;
            self.check_walls(&key, &markers, flow)?;
            Ok::<_, SetupError>((Boundary::of(body), body.kind()))
        };
        let mut bodies = Vec::new();
        for (number, droplet) in droplets.iter().enumerate() {
            bodies.push(curve(number, droplet)?);
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
        let others =
            rigid_bodies.iter().map(|body| -> &dyn Body { body }).chain(shells.iter().map(|s| -> &dyn Body { s }));
        for (number, body) in others.enumerate() {
            bodies.push(curve(droplets.len() + solids.len() + number, body)?);
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

    /// Whether an interface lies in another one in fluid of more than one viscosity, which a grid alone does not have;
    /// shapes that are refused later are left out.
    pub(super) fn is_nested(&self) -> bool {
        if !self.has_contrast() {
            return false;
        }
        let droplets = self.droplets.iter().map(|droplet| (&droplet.shape, droplet.centre, droplet.angle));
        let shells = self.shells.iter().map(|shell| (&shell.shape, shell.centre, shell.angle));
        let outline = |(shape, centre, angle): (&DropletShape, [f64; 2], f64)| {
            let curve = shape.curve().ok()?.0.rotated(angle).translated(centre.into());
            let corner = |k: usize| curve.point(k as f64 / CORNERS as f64);
            let corners: Vec<Vec2> = (0..CORNERS).map(corner).filter(|corner| corner.is_finite()).collect();
            let mut boundary = Boundary::default();
            boundary.push_loop(&corners);
            boundary.sort();
            Some((*corners.first()?, boundary))
        };
        let outlines: Vec<(Vec2, Boundary)> = droplets.chain(shells).filter_map(outline).collect();
        let periods = match self.region {
            Region::Plane => [None, None],
            Region::Box { lengths: [x, y] } => [Some(x), Some(y)],
            Region::Channel { length, .. } => [Some(length), None],
        };
        let pairs = outlines.iter().enumerate().flat_map(|(k, inner)| {
            outlines.iter().enumerate().filter(move |(other, _)| *other != k).map(move |(_, outer)| (inner, outer))
        });
        let mut pairs = pairs.map(|((corner, _), (_, outer))| outer.distance(*corner, periods));
        pairs.any(|distance| distance < 0.0)
    }

    /// Where a body stands in the description, droplets first, with its name if it has one of its own.
    pub(super) fn key(&self, body: usize) -> String {
        let droplets = self.droplets.iter().map(|droplet| (&droplet.name, DropletSetup::NAME)).enumerate();
        let solids = self.solids.iter().map(|solid| (&solid.name, SolidSetup::NAME)).enumerate();
        let rigid = self.rigid_bodies.iter().map(|body| (&body.name, RigidBodySetup::NAME)).enumerate();
        let shells = self.shells.iter().map(|shell| (&shell.name, ShellSetup::NAME)).enumerate();
        let all = droplets.map(|entry| ("droplets", entry)).chain(solids.map(|entry| ("solids", entry)));
        let mut all =
            all.chain(rigid.map(|entry| ("rigid-bodies", entry))).chain(shells.map(|entry| ("shells", entry)));
        match all.nth(body) {
            Some((list, (number, (name, usual)))) if name == usual => format!("{list}[{number}]"),
            Some((list, (number, (name, _)))) => format!("{list}[{number}] ({name})"),
            None => format!("body {body}"),
        }
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
