//! Descriptions of rigid bodies that move.

use elastic_solids::RigidBody;
use motile_base::Vec2;
use serde::{Deserialize, Serialize};

use super::{
    DropletShape, MethodKind, Setup,
    body::{BodySetup, Planned},
    checked::Checked,
};
use crate::SetupError;

/// A rigid body that the fluid carries along, alone or inside a droplet, for example a nucleus.
///
/// ```
/// use motile::prelude::*;
/// use motile::setup::RigidBodySetup;
///
/// // A droplet with a rigid nucleus off its centre.
/// let nucleus = RigidBodySetup { centre: [0.1, 0.2], ..RigidBodySetup::disc(0.4) };
/// let setup = Setup { rigid_bodies: vec![nucleus], ..Setup::default() };
/// let Built { mut scene, rigid_bodies, .. } = setup.build()?;
/// let seen = scene.observe(rigid_bodies[0])?;
/// println!("the nucleus moves with {:.3} and turns with {:.3}", seen.velocity.length(), seen.spin);
/// assert!(seen.velocity.x > 0.0 && seen.spin > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
#[doc(alias("particle", "nucleus", "no-slip"))]
pub struct RigidBodySetup {
    /// Name for messages.
    pub name: String,
    /// Position of the centre (length).
    pub centre: [f64; 2],
    /// Angle by which the shape is turned (radians).
    pub angle: f64,
    /// Its shape. Corners are rounded to what the nodes of an interface resolve.
    pub shape: DropletShape,
    /// Force that acts on it in its centroid (force). In the plane, the forces on all bodies have to add up to zero.
    pub force: [f64; 2],
    /// Torque that acts on it (force times length).
    pub torque: f64,
}

impl Default for RigidBodySetup {
    /// Creates a disc of radius 0.5 in the origin.
    fn default() -> Self {
        let shape = DropletShape::Round { radius: 0.5 };
        Self { name: "rigid body".to_owned(), centre: [0.0; 2], angle: 0.0, shape, force: [0.0; 2], torque: 0.0 }
    }
}

impl RigidBodySetup {
    /// Creates a disc of that radius (length) in the origin.
    #[must_use]
    pub fn disc(radius: f64) -> Self {
        Self { shape: DropletShape::Round { radius }, ..Self::default() }
    }
}

impl BodySetup for RigidBodySetup {
    fn kind(&self) -> [&'static str; 2] {
        ["rigid-bodies", "rigid body"]
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn needs(&self) -> Option<(&'static str, &'static [MethodKind])> {
        Some(("rigid bodies", &[MethodKind::Integral, MethodKind::Layers]))
    }

    fn plan<'a>(&'a self, setup: &'a Setup) -> Result<Planned<'a>, SetupError> {
        let curve = self.shape.curve()?.0.rotated(self.angle).translated(self.centre.into());
        let markers = setup.true_outline(&curve, setup.marker_count(&curve, &self.name)?)?;
        Ok(Planned::of(RigidBody::new(&markers)?.named(&self.name).with_load(Vec2::from(self.force), self.torque)?))
    }

    fn check(&self, checked: &Checked<'_>, _setup: &Setup) -> Result<(), SetupError> {
        checked.all_finite("centre", &self.centre)?;
        checked.finite("angle", self.angle)?;
        checked.all_finite("force", &self.force)?;
        checked.finite("torque", self.torque)?;
        self.shape.check(checked, "shape")
    }
}
