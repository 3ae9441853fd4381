//! Descriptions of gels that fill periodic boxes.

use motile_base::{Region, Vec2};
use motile_interior::{DirectorStart, GelInBox, GelMaterial};
use serde::{Deserialize, Serialize};

use super::{
    GelSetup, MethodKind, Setup,
    body::{BodySetup, Planned},
    checked::Checked,
    gel::check_gel,
};
use crate::SetupError;

/// An active polar gel that fills all of a box ([`GelInBox`]), alone there, by the method
/// [`crate::setup::Method::Grid`]; it has the viscosity of the fluid.
///
/// ```
/// use motile::interior::GelMaterial;
/// use motile::prelude::*;
/// use motile::setup::GelInBoxSetup;
///
/// // An extensile gel of rods bends: its director turns away from where it was.
/// let material = GelMaterial { activity: 200.0, ..GelMaterial::default() };
/// let gels = vec![GelInBoxSetup { material, ..GelInBoxSetup::default() }];
/// let method = Method::Grid(GridMethod::of_spacing(0.2));
/// let Built { mut scene, gels, .. } = Setup { method, droplets: vec![], gels, ..Setup::default() }.build()?;
/// let before = scene.observe(gels[0])?.polarisation[0];
/// scene.run(5.0).go()?;
/// let after = scene.observe(gels[0])?.polarisation[0];
/// println!("{before:.3} {after:.3}");
/// assert!(after < before);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct GelInBoxSetup {
    /// Constants of the material.
    pub material: GelMaterial,
    /// Its director at the start, uniform or random.
    pub start: DirectorStart,
    /// Spacing of its nodes (length), at most; `None` for the spacing of the grid.
    pub spacing: Option<f64>,
}

impl Default for GelInBoxSetup {
    /// Creates the gel of [`GelSetup::default`], its director along x.
    fn default() -> Self {
        let GelSetup { material, start, spacing, .. } = GelSetup::default();
        Self { material, start, spacing }
    }
}

impl BodySetup for GelInBoxSetup {
    fn kind(&self) -> [&'static str; 2] {
        ["gels", "gel"]
    }

    fn name(&self) -> &str {
        "gel"
    }

    fn needs(&self) -> Option<(&'static str, &'static [MethodKind])> {
        Some(("gels that fill a box", &[MethodKind::Grid]))
    }

    fn check(&self, checked: &Checked<'_>, setup: &Setup) -> Result<(), SetupError> {
        let top = Checked { place: "" };
        check_gel(checked, &self.material, &self.start, self.spacing)?;
        let centred = !matches!(self.start, DirectorStart::Uniform { .. } | DirectorStart::Random { .. });
        let remedy = "a periodic box has no centre. Use uniform or random";
        checked.refuse_if(centred, "start", "around a centre", remedy)?;
        let remedy = "a gel of its own must fill a periodic box. Use the region box, or put the gel into a droplet";
        top.refuse_if(!matches!(setup.region, Region::Box { .. }), "region", "channel or plane", remedy)?;
        let remedy = "a gel fills all of the box and does not see other bodies: take them, or the gel, away";
        top.refuse_if(setup.bodies().count() > 1, "gels", setup.gels.len(), remedy)
    }

    fn plan<'a>(&'a self, setup: &'a Setup) -> Result<Planned<'a>, SetupError> {
        let lengths = setup.region.lengths();
        let spacing = self.spacing.or(setup.method.spacing()).unwrap_or(lengths[0]);
        let counts = lengths.map(|length| (length / spacing * (1.0 - 1e-12)).ceil() as usize);
        let gel = GelInBox::new(self.material, lengths, counts, self.start.angles(Vec2::ZERO)?)?;
        // It has no boundary that could reach beyond the region.
        Ok(Planned { corners: Vec::new(), ..Planned::of(gel) })
    }
}
