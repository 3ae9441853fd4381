//! Descriptions of elastic membranes around fluid.

use elastic_solids::{BendingMeasure, Shell};
use serde::{Deserialize, Serialize};

use super::{
    DropletShape, Setup,
    body::{BodySetup, Planned},
    checked::Checked,
};
use crate::SetupError;

/// A closed elastic membrane around fluid: the shell of a nucleus in a droplet, or a capsule. It is at rest in the
/// shape that it starts in.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct ShellSetup {
    /// Name for messages.
    pub name: String,
    /// Position of the centre (length).
    pub centre: [f64; 2],
    /// Angle by which the shape is turned (radians).
    pub angle: f64,
    /// Viscosity of the fluid inside (stress times time); `None` for that of the fluid around it.
    pub viscosity: Option<f64>,
    /// Its shape.
    pub shape: DropletShape,
    /// Modulus of stretching (force).
    pub stretching: f64,
    /// Modulus of bending (force times length squared).
    pub bending: f64,
    /// Measure of bending in its energy.
    pub measure: BendingMeasure,
    /// Curvature at which bending is at rest everywhere (1/length); `None` for that of its shape.
    pub reference_curvature: Option<f64>,
}

impl Default for ShellSetup {
    /// A circle of radius 0.5 in the origin.
    fn default() -> Self {
        Self {
            name: "shell".to_owned(),
            centre: [0.0; 2],
            angle: 0.0,
            viscosity: None,
            shape: DropletShape::Round { radius: 0.5 },
            stretching: 10.0,
            bending: 0.1,
            measure: BendingMeasure::default(),
            reference_curvature: None,
        }
    }
}

impl BodySetup for ShellSetup {
    fn kind(&self) -> [&'static str; 2] {
        ["shells", "shell"]
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn plan<'a>(&'a self, setup: &'a Setup) -> Result<Planned<'a>, SetupError> {
        let curve = self.shape.curve()?.0.rotated(self.angle).translated(self.centre.into());
        let markers = setup.outline(&curve, &self.name)?;
        let mut shell = Shell::new(&markers, self.stretching, self.bending)?.named(&self.name);
        if let Some(curvature) = self.reference_curvature {
            shell = shell.with_reference_curvature(curvature)?;
        }
        if let Some(viscosity) = self.viscosity {
            shell = shell.with_viscosity_inside(viscosity)?;
        }
        Ok(Planned::of(shell.with_measure(self.measure)))
    }

    fn check(&self, checked: &Checked<'_>, _: &Setup) -> Result<(), SetupError> {
        checked.all_finite("centre", &self.centre)?;
        checked.finite("angle", self.angle)?;
        if let Some(viscosity) = self.viscosity {
            checked.positive("viscosity", viscosity)?;
        }
        checked.not_negative("stretching", self.stretching)?;
        checked.not_negative("bending", self.bending)?;
        if let Some(curvature) = self.reference_curvature {
            checked.finite("reference-curvature", curvature)?;
        }
        self.shape.check(checked)
    }
}
