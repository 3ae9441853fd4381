//! Descriptions of gels inside droplets.

use std::f64::consts::TAU;

use active_interface::{ActiveDroplet, ActiveInterface, Motion};
use motile_base::{internal::decimals, polygon::contains};
use motile_interior::{Anchoring, DirectorStart, DiscMesh, GelInDroplet, GelInLayer, GelMaterial};
use motile_scene::Handle;
use serde::{Deserialize, Serialize};

use super::checked::Checked;
use super::{DropletSetup, ExchangeSetup, InterfaceSetup, Particles, Setup, Side, body::Planned};
use crate::SetupError;

/// An active polar gel that fills a droplet ([`GelInDroplet`]), or the layer between an interface along a channel and
/// the wall behind it ([`GelInLayer`]). It has the viscosity of the fluid there, and needs a grid: the methods
/// [`crate::setup::Method::Layers`] and, in a droplet, [`crate::setup::Method::Grid`].
///
/// ```
/// use motile::interior::GelMaterial;
/// use motile::prelude::*;
/// use motile::setup::GelSetup;
///
/// let material = GelMaterial { activity: -200.0, ..GelMaterial::default() };
/// let gel = GelSetup { material, ..GelSetup::default() };
/// let setup = Setup {
///     method: Method::Grid(GridMethod::of_spacing(0.2)),
///     droplets: vec![DropletSetup { gel: Some(gel), ..DropletSetup::passive(200.0) }],
///     ..Setup::default()
/// };
/// let mut scene = setup.build()?.scene;
/// let (gel, _) = scene.system().bodies::<motile::interior::GelInDroplet>().next().ok_or("no gel")?;
/// println!("{:.3}", scene.observe(gel)?.polarisation[0]); // 1.000
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct GelSetup {
    /// Constants of the material.
    pub material: GelMaterial,
    /// Angle at which its director meets the interface.
    pub anchoring: Anchoring,
    /// Its director at the start; a uniform one has its angle to the direction of the droplet.
    pub start: DirectorStart,
    /// Spacing of its mesh inside (length); `None` for the spacing of the grid. The mesh has whole rings, so coarse
    /// spacings such as 0.3 and 0.4 of the radius give the same mesh.
    pub spacing: Option<f64>,
}

impl Default for GelSetup {
    /// Creates a contractile gel, free at the interface, its director along the droplet's direction up to a random
    /// angle of up to 0.1 at each node.
    fn default() -> Self {
        Self {
            material: GelMaterial::default(),
            anchoring: Anchoring::Free,
            start: DirectorStart::Uniform { angle: 0.0, noise: 0.1, seed: 1 },
            spacing: None,
        }
    }
}

/// Refuses constants, starts and spacings of a gel that are out of their range.
pub(super) fn check_gel(
    checked: &Checked<'_>,
    material: &GelMaterial,
    start: &DirectorStart,
    spacing: Option<f64>,
) -> Result<(), SetupError> {
    let GelMaterial { frank, bend, spontaneous_splay, rotational_viscosity, alignment, activity } = *material;
    checked.not_negative("material.frank", frank)?;
    checked.not_negative("material.bend", bend)?;
    checked.finite("material.spontaneous-splay", spontaneous_splay)?;
    checked.positive("material.rotational-viscosity", rotational_viscosity)?;
    checked.finite("material.alignment", alignment)?;
    checked.finite("material.activity", activity)?;
    checked.positive("spacing", spacing)?;
    if let DirectorStart::Uniform { angle, noise, .. } = *start {
        checked.finite("start.uniform.angle", angle)?;
        checked.not_negative("start.uniform.noise", noise)?;
    }
    Ok(())
}

impl GelSetup {
    pub(super) fn check(&self, checked: &Checked<'_>, droplet: &DropletSetup) -> Result<(), SetupError> {
        let gel = Checked { place: &format!("{}.gel", checked.place) };
        check_gel(&gel, &self.material, &self.start, self.spacing)?;
        let remedy = "a droplet with a gel needs a fixed number of markers. Use equidistributed";
        checked.refuse_if(droplet.motion == Motion::WithFluid, "motion", "with-fluid", remedy)
    }

    pub(super) fn check_in_layer(
        &self,
        checked: &Checked<'_>,
        interface: &InterfaceSetup,
        setup: &Setup,
    ) -> Result<(), SetupError> {
        let gel = Checked { place: &format!("{}.gel", checked.place) };
        check_gel(&gel, &self.material, &self.start, self.spacing)?;
        let centred = !matches!(self.start, DirectorStart::Uniform { .. } | DirectorStart::Random { .. });
        gel.refuse_if(centred, "start", "around a centre", "a layer has no centre. Use uniform or random")?;
        let remedy = "a gel in a layer has the viscosity of the fluid on both sides. Remove the key";
        checked.require(interface.viscosity.is_none(), "viscosity", interface.viscosity.unwrap_or(0.0), remedy)?;
        let remedy = "a gel lies between the interface and a rigid wall. Use a channel";
        let channel = setup.region.drive().is_some();
        Checked { place: "" }.refuse_if(!channel, "region", "box", remedy)
    }
}

/// Returns the spacing of a mesh inside a droplet (length). It is the one given, or the usual one as far as the droplet
/// has room for it.
pub(super) fn spacing_inside(
    (name, key): (&str, &str),
    given: Option<f64>,
    usual: f64,
    droplet: &ActiveDroplet,
) -> Result<f64, SetupError> {
    let radius = droplet.element_lengths().iter().sum::<f64>() / TAU;
    let most = DiscMesh::COARSEST * radius;
    match given {
        None => Ok(usual.min(most)),
        Some(spacing) if spacing <= most => Ok(spacing),
        Some(spacing) => {
            let remedy = format!(
                "this spacing is too wide for a droplet of radius {}. Use {} or less",
                decimals(3, radius),
                decimals(3, most)
            );
            Checked { place: name }.refuse(key, &spacing, remedy)
        }
    }
}

impl Setup {
    /// Returns the gel of a droplet, made to be the body `host`.
    pub(super) fn gel(
        &self,
        setup: &DropletSetup,
        droplet: &ActiveDroplet,
        host: Handle<ActiveDroplet>,
    ) -> Result<Option<GelInDroplet>, SetupError> {
        let (Some(gel), Some(grid)) = (&setup.gel, self.method.spacing()) else { return Ok(None) };
        let start = match gel.start {
            DirectorStart::Uniform { angle, noise, seed } => {
                DirectorStart::Uniform { angle: angle + setup.angle, noise, seed }
            }
            start => start,
        };
        let spacing = spacing_inside((&setup.name, "gel.spacing"), gel.spacing, grid, droplet)?;
        Ok(Some(GelInDroplet::new(droplet, host, gel.material, gel.anchoring, &start, spacing)?))
    }

    /// Returns the gel between an interface and the wall on its inside, made for the body `host`.
    pub(super) fn gel_in_layer(
        &self,
        setup: &InterfaceSetup,
        interface: &ActiveInterface,
        host: Handle<ActiveInterface>,
    ) -> Result<Option<GelInLayer>, SetupError> {
        let (Some(gel), Some(grid)) = (&setup.gel, self.method.spacing()) else { return Ok(None) };
        let half = 0.5 * self.region.lengths()[1];
        let wall = if setup.inside == Side::Above { half } else { -half };
        let places = [wall, gel.spacing.unwrap_or(grid)];
        Ok(Some(GelInLayer::new(interface, host, gel.material, gel.anchoring, &gel.start, places)?))
    }

    /// Refuses bodies inside droplets that gels or diffusing particles fill, given all bodies in their order.
    pub(super) fn check_filled(&self, bodies: &[Planned<'_>]) -> Result<(), SetupError> {
        let filled = |droplet: &DropletSetup| match (&droplet.gel, &droplet.particles) {
            (Some(_), _) => Some(("gel", "a gel")),
            (None, Some(Particles { exchange: Some(ExchangeSetup { diffusion_inside: Some(_), .. }), .. })) => {
                Some(("particles.exchange.diffusion-inside", "a field"))
            }
            _ => None,
        };
        for (number, droplet) in self.droplets.iter().enumerate() {
            let Some((entry, value)) = filled(droplet) else { continue };
            let other = (0..bodies.len()).find(|&other| {
                other != number
                    && bodies[other].corners.first().is_some_and(|point| contains(&bodies[number].corners, *point))
            });
            if let Some(other) = other {
                let remedy = format!(
                    "{} lies inside {}, which {value} fills: take one of both away",
                    self.key(other),
                    droplet.name
                );
                return Checked { place: &self.key(number) }.refuse(entry, &value, remedy);
            }
        }
        Ok(())
    }
}
