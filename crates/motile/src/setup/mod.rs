//! Descriptions: scenes as data, checked before any work.

mod body;
mod build;
mod check;
mod checked;
mod droplet;
mod entries;
mod fibre;
mod fields;
#[cfg(feature = "toml")]
mod file;
mod flow;
mod gel;
mod gel_in_box;
mod grading;
mod interface;
mod mesh_entry;
mod method;
mod numbers;
mod outline;
mod particles_entry;
mod places;
mod rigid_body;
mod scales;
mod shapes;
mod shell;
mod solid;
mod space;
mod strays;
mod suspension;
mod wall;

pub use build::{AnyFlow, Built};
pub use droplet::{DropletSetup, DropletShape, ExchangeSetup, Particles, Squeezed, Start};
pub use fibre::{CurvatureWaveSetup, FibreHold, FibreSetup, FibreShape, LoadSetup, TargetSetup, TargetWaveSetup};
pub use fields::{
    FieldEntry, FieldsSetup, GradientSetup, ModulationSetup, NoiseSetup, SpotSetup, TableSetup, WaveSetup,
};
pub use flow::{FlowSetup, PoiseuilleSetup};
pub use gel::GelSetup;
pub use gel_in_box::GelInBoxSetup;
pub use grading::{Axis, Grading};
pub use interface::{ElasticitySetup, InterfaceSetup, InterfaceShape, Side};
pub use mesh_entry::{GroupFactor, MeshGroup, MeshSetup};
pub use method::{GridMethod, GridSolver, IntegralMethod, LayersMethod, Method, MethodKind};
pub use numbers::Numbers;
pub use outline::{OutlineOrigin, OutlineReport, OutlineSetup};
pub use rigid_body::RigidBodySetup;
pub use shell::ShellSetup;
pub use solid::{
    ActiveSpringsSetup, Hold, Material, MaxwellSetup, MeshKind, SolidOutline, SolidSetup, SurfaceElasticitySetup,
};
pub use space::HarmonicsMethod;
pub use suspension::{Arrangement, Distribution, Headings, SuspensionSetup};
pub use wall::WallSetup;

pub use active_interface::ExcludedVolume;
use body::{BodySetup, numbered};
use motile_base::Region;
use motile_scene::{StepSize, gap::Repulsion, integrator::IntegratorKind};
use serde::{Deserialize, Serialize};

/// Describes a scene: what there is, where, and how it is computed. [`Setup::build`] makes the scene.
///
/// You write descriptions as literals, because they are plain structs and enums. You can compare, print and clone them,
/// and with the feature `toml` read them from TOML and write them (`Setup::from_toml`, `Setup::to_toml`). No field is
/// ignored: what only one method needs stands inside that method's variant. Quantities may have any consistent units;
/// the units of the defaults are R0 = 10 um for length, gamma0/10 for force, 10 s for time (`active_interface::Units`
/// converts).
///
/// If data cannot describe a part (a tension law in code, your own body, walls from a closure), add it to the scene
/// that you have built.
///
/// ```
/// use motile::prelude::*;
///
/// // Two droplets of different activity and viscosity, abreast.
/// let setup = Setup {
///     region: Region::Box { lengths: [6.0, 6.0] },
///     method: Method::Integral(IntegralMethod { nodes: 32, elements: 128 }),
///     droplets: vec![
///         DropletSetup { centre: [0.0, -1.4], ..DropletSetup::active(-3.0) },
///         DropletSetup { centre: [0.0, 1.4], viscosity: Some(1000.0), ..DropletSetup::active(-2.0) },
///     ],
///     ..Setup::default()
/// };
/// let Built { mut scene, droplets, .. } = setup.build()?;
/// scene.run(1.0).go()?;
/// let [first, second] = [scene.observe(droplets[0])?.speed(), scene.observe(droplets[1])?.speed()];
/// println!("{first:.3} {second:.3}");
/// assert!(first > 4.0 * second);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
#[doc(alias("simulation", "configuration", "parameters"))]
pub struct Setup {
    /// The region that the fluid fills.
    pub region: Region,
    /// Method of the flow.
    pub method: Method,
    /// Relative accuracy of the flow by boundary integrals and layers, from 1e-15 to 1e-3 (no dimension); `None` for
    /// 1e-8, and 1e-6 with layers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// Viscosity of the exterior fluid (stress times time).
    #[doc(alias("viscosity ratio"))]
    pub viscosity: f64,
    /// Friction alpha of the fluid with plates below and above it (stress times time per length squared), the same
    /// inside and outside of droplets. The flow obeys `eta lap(v) - alpha v = grad p`, with `alpha = 12 eta/H^2` for a
    /// gap of height H (a Hele-Shaw cell). Zero without plates; on a grid only.
    #[serde(skip_serializing_if = "is_zero")]
    #[doc(alias("Brinkman", "Hele-Shaw", "screening", "confinement"))]
    pub friction: f64,
    /// A flow that is imposed from outside.
    #[serde(skip_serializing_if = "FlowSetup::is_none")]
    pub flow: FlowSetup,
    /// Length of the steps of runs.
    pub step: StepSize,
    /// Integrator of the steps: `integrator = "runge-kutta-chebyshev"` for stiff solids, `"runge-kutta"`, of fourth
    /// order, for scenes without particles.
    pub integrator: IntegratorKind,
    /// A short-range repulsion between interfaces, solids and walls, by which a run continues where gaps would become
    /// narrower than is resolved. It is not part of the physics of the model.
    pub repulsion: Option<Repulsion>,
    /// A bound on gaps (length), below which a run ends ([`motile_scene::Scene::with_least_gap`]).
    pub least_gap: Option<f64>,
    /// If true, a scene that is symmetric in y = 0 stays so ([`motile_scene::Scene::held_symmetric`]). The symmetric
    /// path is then computed even if it is unstable.
    pub mirror_symmetric: bool,
    /// The droplets. A file that lists none has none.
    #[serde(default)]
    pub droplets: Vec<DropletSetup>,
    /// Suspensions: many droplets at places that are found for them ([`Setup::placed`]).
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub suspension: Vec<SuspensionSetup>,
    /// The elastic solids: walls, islands, nuclei.
    #[serde(default)]
    pub solids: Vec<SolidSetup>,
    /// Rigid bodies that the fluid carries along: nuclei, particles.
    #[serde(default)]
    pub rigid_bodies: Vec<RigidBodySetup>,
    /// Elastic membranes around fluid: shells of nuclei, capsules.
    #[serde(default)]
    pub shells: Vec<ShellSetup>,
    /// Elastic fibres: beams, hairs, flagella; with a grid or layers, free ones also in the plane.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fibres: Vec<FibreSetup>,
    /// Active polar gels that fill the box, one at most.
    #[serde(default)]
    pub gels: Vec<GelInBoxSetup>,
    /// Interfaces that are periodic along x: active boundaries.
    #[serde(default)]
    pub interfaces: Vec<InterfaceSetup>,
    /// Rigid walls and obstacles in a channel, besides its straight walls; by boundary integrals only.
    #[serde(default)]
    pub walls: Vec<WallSetup>,
}

/// Returns true for zero, so that no key is written for it.
#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

impl Default for Setup {
    /// Describes one droplet of activity -2 in a box of 6 x 6 with viscosity 100, computed by boundary integrals.
    fn default() -> Self {
        Self {
            region: Region::Box { lengths: [6.0, 6.0] },
            method: Method::default(),
            tolerance: None,
            viscosity: 100.0,
            friction: 0.0,
            flow: FlowSetup::default(),
            step: StepSize::default(),
            integrator: IntegratorKind::default(),
            repulsion: None,
            least_gap: None,
            mirror_symmetric: false,
            droplets: vec![DropletSetup::default()],
            suspension: Vec::new(),
            solids: Vec::new(),
            rigid_bodies: Vec::new(),
            shells: Vec::new(),
            fibres: Vec::new(),
            gels: Vec::new(),
            interfaces: Vec::new(),
            walls: Vec::new(),
        }
    }
}

impl Setup {
    /// Creates the default scene by the method of Cowley (Natasha Cowley, "Effects of mechanical properties of the
    /// environment on cell migration", PhD thesis, University of Sheffield): [`GridMethod::thesis`],
    /// [`DropletSetup::thesis`], steps of 1e-3. Walls by its method are [`SolidSetup::thesis`].
    #[must_use]
    pub fn thesis() -> Self {
        Self {
            method: Method::Grid(GridMethod::thesis()),
            step: StepSize::Fixed(1e-3),
            droplets: vec![DropletSetup::thesis()],
            ..Self::default()
        }
    }

    /// Returns all bodies with their numbers in their lists, in the order in which they are added to the scene.
    fn bodies(&self) -> impl Iterator<Item = (usize, &dyn BodySetup)> {
        let bodies = numbered(&self.droplets).chain(numbered(&self.solids));
        bodies
            .chain(numbered(&self.rigid_bodies))
            .chain(numbered(&self.shells))
            .chain(numbered(&self.fibres))
            .chain(numbered(&self.gels))
            .chain(numbered(&self.interfaces))
    }

    /// Returns a number (hexadecimal) that distinguishes descriptions of different physics, places or resolution, but
    /// not of different time steps. FNV-1a of the printed description, in which the contents of files take their place
    /// if they can be read. A resumed run compares [`Setup::entries`].
    #[must_use]
    pub fn fingerprint(&self) -> String {
        let read = self.clone().with_files(std::path::Path::new("")).unwrap_or_else(|_| self.clone());
        Self { step: StepSize::default(), integrator: IntegratorKind::default(), ..read }.hash()
    }

    /// Returns the origin of the results of this description: the version of motile and [`Setup::fingerprint`]. Files
    /// of results carry it ([`motile_scene::System::origin`]).
    #[must_use]
    pub fn origin(&self) -> String {
        format!("motile {}; scene {}", motile_scene::VERSION, self.fingerprint())
    }
}

#[cfg(test)]
mod tests;
