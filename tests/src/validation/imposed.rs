//! Drops, capsules and rigid bodies in flows that are imposed from outside, against `reference/imposed_flows.csv`.

use motile::base::Region;
use motile::elastic_solids::{BendingMeasure, ShellStrains};
use motile::scene::{Deformation, StepSize, integrator::IntegratorKind};
use motile::setup::{
    Built, DropletSetup, DropletShape, FlowSetup, IntegralMethod, Method, PoiseuilleSetup, RigidBodySetup, Setup,
    ShellSetup,
};

use crate::validation::{Reference, StudyError};

/// Shear at a unit rate.
pub const SHEAR: FlowSetup =
    FlowSetup { shear: 1.0, extension: 0.0, rotation: 0.0, poiseuille: None, wall_velocity: None };
/// Extension at a unit rate.
pub const EXTENSION: FlowSetup = FlowSetup { shear: 0.0, extension: 1.0, ..SHEAR };

/// A reference value.
///
/// # Errors
/// No such case or quantity.
pub fn reference(case: &str, quantity: &str) -> Result<f64, StudyError> {
    Reference::read("imposed_flows")?.select("case", case).select("quantity", quantity).value("value")
}

/// The plane, of unit viscosity, with a flow and without bodies, in fixed steps.
#[must_use]
pub fn plane(flow: FlowSetup, nodes: usize, dt: f64) -> Setup {
    let method = Method::Integral(IntegralMethod { nodes, elements: nodes });
    let step = StepSize::Fixed(dt);
    Setup { region: Region::Plane, viscosity: 1.0, flow, method, step, droplets: Vec::new(), ..Setup::default() }
}

/// The plane in steps of fourth order.
#[must_use]
pub fn fourth_order(flow: FlowSetup, nodes: usize, dt: f64) -> Setup {
    Setup { integrator: IntegratorKind::RungeKutta, ..plane(flow, nodes, dt) }
}

/// A drop of radius 1 without particles at a ratio of viscosities and a capillary number of unit rates.
#[must_use]
pub fn drop_of(ratio: f64, capillary: f64) -> DropletSetup {
    DropletSetup { viscosity: Some(ratio), ..DropletSetup::passive(1.0 / capillary) }
}

/// A capsule of radius 1 at a capillary number `eta G R/E_s` of unit rates and a ratio `B/(E_s R^2)`.
#[must_use]
pub fn capsule(measure: BendingMeasure, ratio: f64, capillary: f64) -> ShellSetup {
    let stretching = 1.0 / capillary;
    let shape = DropletShape::Round { radius: 1.0 };
    ShellSetup { shape, stretching, bending: ratio * stretching, measure, ..ShellSetup::default() }
}

/// A rigid ellipse of an aspect ratio and the area of a unit disc, its long axis at an angle.
#[must_use]
pub fn ellipse(aspect_ratio: f64, angle: f64) -> RigidBodySetup {
    let half_axes = [aspect_ratio.sqrt(), 1.0 / aspect_ratio.sqrt()];
    RigidBodySetup { angle, shape: DropletShape::Ellipse { half_axes }, ..RigidBodySetup::default() }
}

/// A Poiseuille flow with a unit shear rate at a distance `half_width` from its middle.
#[must_use]
pub fn poiseuille(half_width: f64) -> FlowSetup {
    let poiseuille = Some(PoiseuilleSetup { speed: 0.5 * half_width, half_width });
    FlowSetup { poiseuille, ..FlowSetup::default() }
}

/// A body as it is seen at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seen {
    /// Deformation and motion along itself.
    pub deformation: Deformation,
    /// Particle stress times area.
    pub stresslet: [[f64; 2]; 2],
    /// Strains of a capsule.
    pub strains: Option<ShellStrains>,
}

/// The only drop or capsule of a scene at some times.
///
/// # Errors
/// A scene that cannot be made or run, or that has neither.
pub fn seen_at(setup: &Setup, times: &[f64]) -> Result<Vec<Seen>, StudyError> {
    let Built { mut scene, droplets, shells, .. } = setup.build()?;
    let look = |&until: &f64| {
        scene.run(until).go()?;
        let strains = shells.first().map(|&shell| scene.observe(shell)).transpose()?;
        let system = scene.system_mut();
        let deformation = match (droplets.first(), shells.first()) {
            (Some(&droplet), _) => system.deformation(droplet)?,
            (None, Some(&shell)) => system.deformation(shell)?,
            (None, None) => anyhow::bail!("a scene without a drop or capsule"),
        };
        let stresslet = system.stresslets()?.first().copied().unwrap_or_default();
        Ok(Seen { deformation, stresslet, strains })
    };
    times.iter().map(look).collect()
}

impl Seen {
    /// Observables by the names of the reference; angles are in radians.
    #[must_use]
    pub fn by_name(&self) -> Vec<(&'static str, f64)> {
        let Self { deformation: seen, stresslet, strains } = self;
        let mut values = vec![
            ("D_mom", seen.by_moments),
            ("D_ext", seen.by_extents),
            ("L_max", seen.extents[0]),
            ("B_min", seen.extents[1]),
            ("length", seen.perimeter),
            ("tip_speed", seen.tip_speed),
            ("waist_speed", seen.waist_speed),
            ("max_speed", seen.largest_speed),
            ("kappa_tip", seen.tip_curvature),
            ("period", seen.period.unwrap_or(f64::NAN)),
            ("SB_xx", stresslet[0][0]),
            ("SB_xy", stresslet[0][1]),
            ("angle_mom_deg", seen.angle_of_moments.unwrap_or(f64::NAN)),
            ("angle_ext_deg", seen.angle_of_extents.unwrap_or(f64::NAN)),
        ];
        if let Some(strains) = strains {
            let [[most, least], [tight, slack]] = [strains.stretches, strains.tensions];
            values.extend([("stretch_max", most), ("stretch_min", least), ("T_max", tight), ("T_min", slack)]);
            values.push(("energy", strains.energy));
        }
        values
    }

    /// Errors of all that the reference has of a case, by name, of angles in radians.
    #[must_use]
    pub fn errors(&self, case: &str) -> Vec<(&'static str, f64)> {
        let error = |(name, found): (&'static str, f64)| {
            let known = reference(case, name).ok()?;
            Some((name, found - if name.ends_with("deg") { known.to_radians() } else { known }))
        };
        self.by_name().into_iter().filter_map(error).collect()
    }

    /// The largest of [`Seen::errors`] in size, relative where a value is above 1.
    #[must_use]
    pub fn largest_error(&self, case: &str) -> (f64, &'static str) {
        let relative = |(name, error): (&'static str, f64)| {
            (error.abs() / reference(case, name).map_or(1.0, |known| known.abs().max(1.0)), name)
        };
        self.errors(case).into_iter().map(relative).fold((0.0, ""), |a, b| if b.0 > a.0 { b } else { a })
    }
}
