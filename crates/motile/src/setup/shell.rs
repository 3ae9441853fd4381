//! Descriptions of elastic membranes around fluid.

use active_interface::Curve;
use elastic_solids::{BendingMeasure, Shell};
use serde::{Deserialize, Serialize};

use super::{
    DropletShape, Method, Setup,
    body::{BodySetup, Planned},
    checked::Checked,
};
use crate::SetupError;

/// A closed elastic membrane around fluid: the shell of a nucleus in a droplet, or a capsule.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
#[doc(alias("vesicle", "capsule", "membrane"))]
pub struct ShellSetup {
    /// Name for messages.
    pub name: String,
    /// Position of the centre (length).
    pub centre: [f64; 2],
    /// Angle by which the shape is turned (radians).
    pub angle: f64,
    /// Viscosity of the fluid inside (stress times time); `None` for the viscosity of the fluid around it.
    pub viscosity: Option<f64>,
    /// Shape at the start.
    pub shape: DropletShape,
    /// Its shape at rest; `None` for the shape at the start. On both outlines, each point lies at the same fraction of
    /// the length from the first point.
    pub rest: Option<DropletShape>,
    /// Modulus of stretching (force).
    pub stretching: f64,
    /// Modulus of bending (force times length squared).
    pub bending: f64,
    /// Viscosity with which it resists stretching (force times time).
    pub cortex_viscosity: f64,
    /// Measure of bending in its energy.
    pub measure: BendingMeasure,
    /// Curvature at which bending is at rest everywhere (1/length); `None` for the curvature of its shape at rest.
    pub reference_curvature: Option<f64>,
}

impl Default for ShellSetup {
    /// Creates a circle of radius 0.5 in the origin.
    fn default() -> Self {
        Self {
            name: "shell".to_owned(),
            centre: [0.0; 2],
            angle: 0.0,
            viscosity: None,
            shape: DropletShape::Round { radius: 0.5 },
            rest: None,
            stretching: 10.0,
            bending: 0.1,
            cortex_viscosity: 0.0,
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
        let placed = |shape: &DropletShape| -> Result<Curve, SetupError> {
            Ok(shape.curve()?.0.rotated(self.angle).translated(self.centre.into()))
        };
        let curve = placed(&self.shape)?;
        let markers = setup.true_outline(&curve, setup.membrane_count(&curve, &self.name)?)?;
        let mut shell = match &self.rest {
            None => Shell::new(&markers, self.stretching, self.bending)?,
            Some(rest) => {
                let at_rest = setup.true_outline(&placed(rest)?, markers.len())?;
                Shell::new(&at_rest, self.stretching, self.bending)?.deformed(&markers)?
            }
        };
        shell = shell.named(&self.name).with_viscosity(self.cortex_viscosity)?;
        if let Some(curvature) = self.reference_curvature {
            shell = shell.with_reference_curvature(curvature)?;
        }
        if let Some(viscosity) = self.viscosity {
            shell = shell.with_viscosity_inside(viscosity)?;
        }
        Ok(Planned::of(shell.with_measure(self.measure)))
    }

    fn check(&self, checked: &Checked<'_>, setup: &Setup) -> Result<(), SetupError> {
        checked.all_finite("centre", &self.centre)?;
        checked.finite("angle", self.angle)?;
        checked.positive("viscosity", self.viscosity)?;
        checked.not_negative("stretching", self.stretching)?;
        checked.not_negative("bending", self.bending)?;
        checked.not_negative("cortex-viscosity", self.cortex_viscosity)?;
        let remedy = "a viscous shell on a grid is not resolved, whose points are not equally spaced. Use the method \
                      integral or layers";
        let grid = matches!(setup.method, Method::Grid(_)) && self.cortex_viscosity > 0.0;
        checked.refuse_if(grid, "cortex-viscosity", self.cortex_viscosity, remedy)?;
        checked.finite("reference-curvature", self.reference_curvature)?;
        self.shape.check(checked, "shape")?;
        self.rest.as_ref().map_or(Ok(()), |rest| rest.check(checked, "rest"))
    }
}
