//! Places of the bodies of a description, checked before anything is meshed.

use motile_base::{
    Region, TubeShape, Vec2,
    internal::{decimals, told_apart},
};
use motile_scene::{
    Hydrodynamics,
    gap::{Overlap, Surfaces},
};

use super::{AnyFlow, DropletSetup, DropletShape, Particles, Setup, body::Planned, checked::Checked};
use crate::SetupError;

/// Fraction of a period that a body may fill: beyond it, except for round-off, it touches its own image.
const APART: f64 = 1.0 - 1e-6;
/// Ratio of a radius to the default radius above which the units are likely to differ.
const MIXED: f64 = 3.0;

impl Setup {
    /// Refuses bodies that reach beyond the region, overlap their own images, or lie in one another as they
    /// cannot, and droplets without fluid between them.
    pub(super) fn check_places(&self, bodies: &[Planned<'_>], flow: &AnyFlow) -> Result<(), SetupError> {
        let (view, walls) = (&flow.fluid_view(), self.even_walls()?);
        for (number, Planned { corners, .. }) in bodies.iter().enumerate() {
            let key = self.key(number);
            self.fits(number, corners)?;
            self.check_walls(&key, corners, &walls)?;
        }
        self.check_length(bodies.iter().flat_map(|body| &body.corners))?;
        let surfaces = Surfaces::of(bodies.iter().map(|Planned { boundary, kind, .. }| (boundary.clone(), *kind)));
        if let Some((body, other, viscosities)) = surfaces.conflict(view.domain.periods, view.viscosity) {
            let [key, other] = [body, other].map(|body| self.key(body));
            return Err(SetupError::two_viscosities([&key, &other], viscosities));
        }
        match surfaces.first_overlap(view) {
            None => surfaces.contact(view).map_or(Ok(()), |(body, other, place)| {
                let ([key, other], [x, y]) = ([body, other].map(|body| self.key(body)), place.into());
                Err(SetupError::Touch { key, other, x, y })
            }),
            Some(Overlap { body, other, place, depth, allowed }) => {
                let ([key, other], [x, y]) = ([body, other].map(|body| self.key(body)), place.into());
                Err(SetupError::Overlap { key, other, x, y, depth, allowed })
            }
        }
    }

    /// Refuses a straight tube whose pressure is given over a length in which bodies leave no room to the next ones.
    fn check_length<'a>(&self, corners: impl Iterator<Item = &'a Vec2>) -> Result<(), SetupError> {
        let Region::Tube { radius, shape: TubeShape::Straight, drive, length: Some(length) } = self.region else {
            return Ok(());
        };
        let (low, high) =
            corners.fold((f64::INFINITY, -f64::INFINITY), |(low, high), at| (at.x.min(low), at.x.max(high)));
        let least = high - low + Region::LENGTHS_APART * radius;
        let holds = drive.flux().is_some() || least <= length;
        let remedy = format!(
            "bodies in neighbouring lengths, whose flows on one another are not counted, are a radius of the tube \
             apart or more. Use at least {}, or prescribe a flux instead of a pressure",
            decimals(4, least)
        );
        Checked { place: "" }.require(holds, "region.tube.length", length, &remedy)
    }

    /// Returns the place of a body in the description, in the order of its lists, with its name if it has one.
    pub(super) fn key(&self, body: usize) -> String {
        let Some((number, body)) = self.bodies().nth(body) else { return format!("body {body}") };
        let ([list, usual], name) = (body.kind(), body.name());
        if name == usual { format!("{list}[{number}]") } else { format!("{list}[{number}] ({name})") }
    }

    /// Refuses a body that reaches beyond the region or overlaps its own images, by the corners of its boundary.
    fn fits(&self, body: usize, corners: &[Vec2]) -> Result<(), SetupError> {
        if corners.is_empty() {
            return Ok(());
        }
        let far = Vec2::splat(f64::INFINITY);
        let (low, high) = corners.iter().fold((far, -far), |(low, high), corner| (low.min(*corner), high.max(*corner)));
        let [length, width] = self.region.lengths();
        let extent = high - low;
        // The polygon of the markers has the area of its curve and so stands out of it a little.
        let slack = 4.0 * extent.length() / (corners.len() * corners.len()) as f64;
        let fits = match self.region {
            Region::Tube { radius, shape, .. } => {
                let half = self.region.half_length().unwrap_or(f64::INFINITY);
                let fits = |corner: &Vec2| corner.y.abs() <= shape.radius(radius, half, corner.x) + slack;
                low.x > -half && high.x < half && corners.iter().all(fits)
            }
            Region::Box { .. } => extent.x < APART * length && extent.y < APART * width,
            Region::Channel { .. } | Region::SlipChannel { .. } => {
                extent.x < APART * length && high.y.max(-low.y) <= 0.5 * width + slack
            }
            _ => true,
        };
        if fits {
            return Ok(());
        }
        let droplet = self.droplets.get(body);
        let mut hint = droplet.map(|droplet| self.mixed_units(droplet)).unwrap_or_default();
        if droplet.is_some_and(|droplet| matches!(droplet.shape, DropletShape::Outline(_))) {
            hint.insert_str(0, ". If the outline is in other units than the region, set its scale");
        }
        Err(SetupError::NoRoom { length, width, hint }.of(&self.key(body)))
    }

    /// Names the defaults, which are in units of a radius of 1, of a droplet of quite another radius.
    pub(super) fn mixed_units(&self, droplet: &DropletSetup) -> String {
        let (Ok(radius), Some(particles)) = (droplet.shape.radius(), &droplet.particles) else {
            return String::new();
        };
        let usual = Particles::default();
        let quantities = [
            ("viscosity", self.viscosity, Self::default().viscosity, -1),
            ("concentration", particles.concentration, usual.concentration, -1),
            ("diffusion", particles.diffusion, usual.diffusion, 2),
            ("activity", particles.activity, usual.activity, 1),
        ];
        let unchanged = quantities.into_iter().filter(|(_, value, default, _)| value == default);
        let named: Vec<_> = unchanged
            .map(|(name, value, _, power)| {
                let [value, other] = told_apart([value, value * radius.powi(power)]);
                format!("{name} {value} ({other})")
            })
            .collect();
        if named.is_empty() || (1.0 / MIXED..MIXED).contains(&radius) {
            return String::new();
        }
        format!(
            "; a radius of {radius} and the defaults {} are of different units: those are for lengths in radii (in \
             brackets for lengths of which the radius is {radius}, times and tensions as they are)",
            named.join(", ")
        )
    }
}
