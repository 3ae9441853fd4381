//! Descriptions of imposed flows.

use motile_base::{ImposedFlow, Region};
use motile_scene::FlowError;
use serde::{Deserialize, Serialize};

use super::{
    Setup,
    checked::{Checked, short},
};
use crate::SetupError;

/// An imposed flow, the sum of its parts: linear flows and a Poiseuille flow in the plane, a shear in a box, the flow
/// of sliding walls in a channel (whose pressure gradient or flux is the `drive` of the region). Velocities of bodies
/// and samples belong to the whole flow.
///
/// ```
/// use motile::prelude::*;
///
/// // A drop of the fluid around it in a shear flow, at a capillary number of 0.1.
/// let setup = Setup {
///     region: Region::Plane,
///     viscosity: 1.0,
///     flow: FlowSetup { shear: 1.0, ..FlowSetup::default() },
///     droplets: vec![DropletSetup::passive(10.0)],
///     ..Setup::default()
/// };
/// let Built { mut scene, droplets, .. } = setup.build()?;
/// scene.run(12.0).go()?;
/// let seen = scene.system_mut().deformation(droplets[0])?;
/// let angle = seen.angle_of_moments.ok_or("the drop is round")?;
/// println!("deformation {:.4}, angle {:.1} degrees", seen.by_moments, angle.to_degrees());
/// assert!((seen.by_moments - 0.09927).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
#[doc(alias("shear flow", "Poiseuille", "Couette", "background flow"))]
pub struct FlowSetup {
    /// Shear rate G of `u = (G y, 0)` (1/time).
    pub shear: f64,
    /// Extension rate E of `u = (E x, -E y)` (1/time).
    pub extension: f64,
    /// Angular velocity W of `u = W (-y, x)` (1/time), counter-clockwise.
    pub rotation: f64,
    /// A Poiseuille flow along x in the plane.
    pub poiseuille: Option<PoiseuilleSetup>,
    /// Velocities along x of the walls of a channel, the lower one first (length per time).
    pub wall_velocity: Option<[f64; 2]>,
}

/// The Poiseuille flow `u = U (1 - y^2/h^2)` along x.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct PoiseuilleSetup {
    /// Velocity U in its middle, y = 0 (length per time).
    pub speed: f64,
    /// Distance h from its middle at which it is zero (length).
    pub half_width: f64,
}

/// Remedy for a Poiseuille flow in a box.
const ACROSS_A_BOX: &str =
    "it does not continue periodically across a box. Use the region \"plane\", or a channel with a flux";
/// Remedy for flows imposed on three dimensions.
const IN_THE_PLANE: &str = "flows can be imposed in two dimensions only. Use the region \"plane\"";

impl FlowSetup {
    /// Returns true if there is no flow.
    #[must_use]
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Returns the flow in a region.
    ///
    /// # Errors
    /// Returns an error for a half width that is not positive and finite.
    pub fn imposed(&self, region: &Region) -> Result<ImposedFlow, SetupError> {
        let mut flow = ImposedFlow::shear(self.shear)
            + ImposedFlow::extension(self.extension)
            + ImposedFlow::rotation(self.rotation);
        if let Some(PoiseuilleSetup { speed, half_width }) = self.poiseuille {
            flow = flow + ImposedFlow::poiseuille(speed, half_width).map_err(FlowError::from)?;
        }
        match (self.wall_velocity, *region) {
            (Some(walls), Region::Channel { width, .. }) => flow = flow + ImposedFlow::couette(walls, width),
            (Some(walls), Region::SlipChannel { width, slip, .. }) => {
                flow = flow + ImposedFlow::couette_with_slip(walls, width, slip);
            }
            _ => {}
        }
        Ok(flow)
    }

    /// Refuses numbers that are not finite, and parts that the region does not have.
    pub(super) fn check(&self, setup: &Setup) -> Result<(), SetupError> {
        let checked = Checked { place: "flow" };
        let linear = [("shear", self.shear), ("extension", self.extension), ("rotation", self.rotation)];
        for (key, value) in linear {
            checked.finite(key, value)?;
        }
        if let Some(PoiseuilleSetup { speed, half_width }) = self.poiseuille {
            checked.finite("poiseuille.speed", speed)?;
            checked.positive("poiseuille.half-width", half_width)?;
            let finite = (2.0 * speed / (half_width * half_width)).is_finite();
            checked.require(
                finite,
                "poiseuille.half-width",
                half_width,
                "the curvature of the flow would not be finite. Use a larger number",
            )?;
        }
        for (number, velocity) in self.wall_velocity.into_iter().flatten().enumerate() {
            checked.finite(&format!("wall-velocity[{number}]"), velocity)?;
        }
        let remedy = |key: &str, value: f64| match (setup.region, key) {
            (Region::Plane, _) | (Region::Box { .. }, "shear") => None,
            (Region::Box { .. }, "poiseuille.speed") => Some(ACROSS_A_BOX.to_owned()),
            (Region::Box { .. }, _) => {
                Some("the images of a box can be sheared along x only. Use shear, or the region \"plane\"".to_owned())
            }
            (Region::Channel { width, .. } | Region::SlipChannel { width, .. }, "shear") => {
                let [below, above] = setup.region.slip().map(|slip| value * (0.5 * width + slip));
                let [below, above] = [-below, above].map(short);
                Some(format!("the walls of a channel hold the fluid. Use wall-velocity = [{below}, {above}] instead"))
            }
            (Region::SlipChannel { .. }, "poiseuille.speed") => {
                Some("use a flux or a gradient as region.channel.drive in its place".to_owned())
            }
            (Region::Channel { width, .. }, "poiseuille.speed") => {
                let flux = short(2.0 / 3.0 * value * width);
                Some(format!("use region.channel.drive = {{ flux = {flux} }} in its place"))
            }
            (Region::Channel { .. } | Region::SlipChannel { .. }, _) => Some(
                "this flow does not fit between the straight walls of a channel. Use the region \"plane\"".to_owned(),
            ),
            _ => Some(IN_THE_PLANE.to_owned()),
        };
        let poiseuille = self.poiseuille.map(|flow| ("poiseuille.speed", flow.speed));
        for (key, value) in linear.into_iter().filter(|(_, value)| *value != 0.0).chain(poiseuille) {
            remedy(key, value).map_or(Ok(()), |remedy| checked.refuse(key, &value, remedy))?;
        }
        if let (Some([below, above]), None) = (self.wall_velocity, setup.region.drive()) {
            let remedy = "only a channel has walls that can slide. Use shear instead, or the region channel";
            return checked.refuse("wall-velocity", &format!("[{below}, {above}]"), remedy);
        }
        let remedy = "the walls of the channel lie behind the walls in it, or beside obstacles at rest. Leave one \
                      of them out";
        checked.refuse_if(self.wall_velocity.is_some() && !setup.walls.is_empty(), "wall-velocity", "given", remedy)
    }
}
