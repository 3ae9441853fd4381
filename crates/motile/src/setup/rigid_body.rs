//! Descriptions of rigid bodies that move or are held.

use elastic_solids::RigidBody;
use motile_base::{Region, Vec2, internal::told};
use serde::{Deserialize, Serialize};

use super::{
    DropletShape, Method, MethodKind, Setup,
    body::{BodySetup, Planned},
    checked::Checked,
};
use crate::SetupError;

/// Distance of the markers of a held body on a grid, in grid spacings.
const APART: f64 = 1.5;
/// Fewest of them.
const FEWEST: f64 = 12.0;

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
    /// If `true`, the body is held: it has no other motion than the next two prescribe. Use it for a post in a channel.
    pub held: bool,
    /// Velocity of its centroid (length per time), which moves it whatever the flow. With a velocity or an angular
    /// velocity, the body counts as held.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub velocity: Option<[f64; 2]>,
    /// Angular velocity (radians per time, counter-clockwise) with which it is turned whatever the flow.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angular_velocity: Option<f64>,
}

impl Default for RigidBodySetup {
    /// Creates a disc of radius 0.5 in the origin.
    fn default() -> Self {
        let shape = DropletShape::Round { radius: 0.5 };
        Self {
            name: "rigid body".to_owned(),
            centre: [0.0; 2],
            angle: 0.0,
            shape,
            force: [0.0; 2],
            torque: 0.0,
            held: false,
            velocity: None,
            angular_velocity: None,
        }
    }
}

impl RigidBodySetup {
    /// Creates a disc of that radius (length) in the origin.
    #[must_use]
    pub fn disc(radius: f64) -> Self {
        Self { shape: DropletShape::Round { radius }, ..Self::default() }
    }

    /// Returns true if the motion of the body is prescribed: if it is held, or has a velocity or angular velocity.
    #[must_use]
    pub fn is_held(&self) -> bool {
        self.held || self.velocity.is_some() || self.angular_velocity.is_some()
    }
}

impl RigidBodySetup {
    /// Returns true if the body moves as the mirror image of another one in y = 0 does, or neither is held.
    fn moves_as_mirrored(&self, other: &Self) -> bool {
        let motion = |body: &Self| {
            let [x, y] = body.velocity.unwrap_or_default();
            body.is_held().then(|| [x, y, body.angular_velocity.unwrap_or_default()])
        };
        motion(self) == motion(other).map(|[x, y, spin]| [x, 0.0 - y, 0.0 - spin])
    }

    /// Returns the key that prescribes the motion.
    fn key_of_motion(&self) -> &'static str {
        match (self.held, self.velocity) {
            (true, _) => "held",
            (false, Some(_)) => "velocity",
            (false, None) => "angular-velocity",
        }
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
        // On a grid, only those that are held.
        let free = Some(("rigid bodies", [MethodKind::Integral, MethodKind::Layers].as_slice()));
        free.filter(|_| !self.is_held())
    }

    fn plan<'a>(&'a self, setup: &'a Setup) -> Result<Planned<'a>, SetupError> {
        let curve = self.shape.curve()?.0.rotated(self.angle).translated(self.centre.into());
        let count = match &setup.method {
            Method::Grid(grid) => {
                let (wanted, most) = (FEWEST * APART * grid.spacing, curve.perimeter());
                // Two digits, rounded down so that the remedy works.
                let largest = most / (FEWEST * APART);
                let unit = 10_f64.powf(largest.log10().floor() - 1.0);
                let remedy = format!(
                    "{} is too small for this grid, which holds it by {FEWEST} markers or more. Use a spacing of {} \
                     or less, or a larger body",
                    self.name,
                    told((largest / unit).floor() * unit)
                );
                Checked { place: "method.grid" }.refuse_if(wanted > most, "spacing", grid.spacing, remedy)?;
                setup.grid_markers(&curve, &self.name, APART * grid.spacing)?
            }
            _ => setup.marker_count(&curve, &self.name)?,
        };
        let markers = setup.true_outline(&curve, count)?;
        let body = RigidBody::new(&markers)?.named(&self.name).with_load(Vec2::from(self.force), self.torque)?;
        let motion = (self.velocity.unwrap_or_default().into(), self.angular_velocity.unwrap_or_default());
        let body = if self.is_held() { body.moving(motion.0, motion.1)? } else { body };
        Ok(Planned::of(match &setup.method {
            Method::Grid(grid) => {
                let inset = if self.is_held() { ib_core::rest_distance(&grid.kernel) * grid.spacing } else { 0.0 };
                let remedy = format!(
                    "{} has sharper bends than this grid resolves. Use a smaller spacing, a rounder shape, or the \
                     method integral",
                    self.name
                );
                let place = Checked { place: "method.grid" };
                body.by_markers(inset).or_else(|_| place.refuse("spacing", &grid.spacing, remedy))?
            }
            _ => body,
        }))
    }

    fn check(&self, checked: &Checked<'_>, setup: &Setup) -> Result<(), SetupError> {
        checked.all_finite("centre", &self.centre)?;
        checked.finite("angle", self.angle)?;
        checked.all_finite("force", &self.force)?;
        checked.finite("torque", self.torque)?;
        checked.all_finite("velocity", &self.velocity.unwrap_or_default())?;
        checked.finite("angular-velocity", self.angular_velocity)?;
        let remedy = "in the plane nothing takes up the force on a body that is held, so that no steady flow around it \
                      exists (Stokes' paradox). Use a channel or a box, or let the body move freely";
        checked.refuse_if(self.is_held() && setup.region == Region::Plane, self.key_of_motion(), "given", remedy)?;
        let partner = !setup.mirror_symmetric || setup.rigid_bodies.iter().any(|other| other.moves_as_mirrored(self));
        let remedy = "a scene that is kept symmetric in y = 0 needs a second body that moves as its mirror image. Add \
                      it, let the body move along x alone, or leave out mirror-symmetric";
        checked.refuse_if(!partner, self.key_of_motion(), "given", remedy)?;
        self.shape.check(checked, "shape")
    }
}
