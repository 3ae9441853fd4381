//! Descriptions of elastic solids.

use elastic_solids::mesh::TriangleMesh;
use elastic_solids::{ActiveSprings, Channel, ChannelShape, Maxwell, MooneyRivlin, SaintVenantKirchhoff};
use elastic_solids::{Interior, Mesher, NeoHookean, Outline, Solid, SolidError};
use motile_base::{Region, Vec2, internal::Refuse as _};
use motile_boundary_integrals::Settings;
use motile_scene::{MarkerKind, Scene, integrator::IntegratorKind};
use serde::{Deserialize, Serialize};

use super::{
    AnyFlow, MeshSetup, Method, MethodKind, OutlineOrigin, OutlineSetup, Setup,
    body::{BodySetup, Planned},
    checked::Checked,
    grading::Grading,
};
use crate::SetupError;

/// An elastic solid in the fluid: a wall, an island, a nucleus.
///
/// ```
/// use motile::prelude::*;
/// use motile::elastic_solids::ChannelShape;
/// use motile::setup::{Axis, Grading, Material, SolidSetup};
///
/// // A soft channel of width 2, stiffening along x, in a region of 12 x 5 whose rigid walls hold the outermost rows.
/// let material = Material::NeoHookean { shear: 200.0, bulk: 400.0 };
/// let grading = Grading::Along { axis: Axis::X, factors: vec![[-6.0, 1.0], [0.0, 4.0], [6.0, 1.0]] };
/// let walls = SolidSetup::walls(&ChannelShape::Straight { width: 2.0 }, &material);
/// let solids = walls.into_iter().map(|wall| SolidSetup { grading: grading.clone(), ..wall }).collect();
/// let setup = Setup {
///     region: Region::Channel { length: 12.0, width: 5.0, drive: Drive::ZeroGradient },
///     method: Method::Layers(LayersMethod::of_spacing(0.1)),
///     droplets: vec![DropletSetup::active(-4.0)],
///     solids,
///     ..Setup::default()
/// };
/// let Built { mut scene, solids, .. } = setup.build()?;
/// scene.run(0.2).go()?;
/// let lower = scene.body(solids[0])?;
/// println!("{} points of the lower wall move", lower.free_points().len());
/// assert_eq!(lower.free_points().len(), 620);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[doc(alias("elastic wall", "elasticity", "tissue"))]
pub struct SolidSetup {
    /// Name for messages.
    #[serde(default = "solid_name")]
    pub name: String,
    /// Arrangement of its points.
    #[serde(default)]
    pub mesh: MeshKind,
    /// Spacing of its points (length), on a finer surface half of it; `None` for the spacing of the grid, with layers
    /// twice as much.
    #[serde(default)]
    pub mesh_spacing: Option<f64>,
    /// Extra points on its surface: one in the middle of each side, or three if its forces are spread over triangles.
    /// They are more accurate at narrow gaps, but the surface folds where it is compressed by a third along itself,
    /// springs first. With `None`, solids in layers have them unless they are made of springs, and solids on a grid do
    /// not.
    #[serde(default)]
    pub finer_surface: Option<bool>,
    /// Forces of inner points spread over the triangles about them ([`Solid::spread_over_triangles`]): soft walls are
    /// then as incompressible as the fluid, whatever their bulk modulus, but a run takes two to four times as long.
    /// With layers, the grid then has half the spacing. You cannot use it in scenes that are kept mirror symmetric.
    #[serde(default)]
    pub spread_over_triangles: bool,
    /// Permission for triangles of springs to be inverted ([`Solid::allow_inversion`]).
    #[serde(default)]
    pub may_invert: bool,
    /// How it is held in place.
    #[serde(default)]
    pub hold: Hold,
    /// Outline that it fills, in its reference state.
    pub outline: SolidOutline,
    /// Elastic material.
    pub material: Material,
    /// Its moduli as a function of place.
    #[serde(default)]
    pub grading: Grading,
    /// Surface elasticity, which keeps a soft surface from creasing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub surface_elasticity: Option<SurfaceElasticitySetup>,
    /// Maxwell elements in parallel with its elasticity, which make it viscoelastic; their moduli are graded like its
    /// own.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub relaxation: Vec<MaxwellSetup>,
    /// Relaxation times of the Maxwell elements as a function of place: a factor on all of them.
    #[serde(default, skip_serializing_if = "Grading::is_uniform")]
    pub relaxation_time_grading: Grading,
    /// Viscosity (stress times time) if it is above the viscosity of the exterior fluid: a Kelvin-Voigt solid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub viscosity: Option<f64>,
    /// Force on it per area at rest (force per length squared), such as its weight in the fluid.
    #[serde(default)]
    pub body_force: [f64; 2],
    /// Force on it in all (force), uniform over its area at rest. It adds to `body_force`.
    #[serde(default)]
    pub force: [f64; 2],
    /// Active springs along the edges of its mesh.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub active_springs: Option<ActiveSpringsSetup>,
    /// Tension of the active springs as a function of place: a factor on it.
    #[serde(default, skip_serializing_if = "Grading::is_uniform")]
    pub tension_grading: Grading,
}

/// Surface elasticity of a solid ([`Solid::with_surface_elasticity`]).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct SurfaceElasticitySetup {
    /// Modulus of stretching (force).
    #[serde(default)]
    pub stretching: f64,
    /// Modulus of bending (force times length squared).
    pub bending: f64,
}

/// A Maxwell element of a solid ([`Solid::with_maxwell`]).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct MaxwellSetup {
    /// Shear modulus (force per length).
    pub modulus: f64,
    /// Relaxation time (time).
    pub time: f64,
}

/// Springs along the edges of a mesh that contract while they are on, and turn on and off at random
/// ([`Solid::with_active_springs`]).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct ActiveSpringsSetup {
    /// Tension while one is on (force).
    pub tension: f64,
    /// Rate of turning on (1/time).
    pub on: f64,
    /// Rate of turning off (1/time).
    pub off: f64,
    /// Seed.
    #[serde(default = "first_seed")]
    pub seed: u64,
    /// Logarithm of the rate of turning on per strain of the edge (no dimension).
    #[serde(default)]
    pub on_sensitivity: f64,
    /// Logarithm of the rate of turning off per strain of the edge (no dimension): positive of slip bonds, negative of
    /// catch bonds.
    #[serde(default)]
    pub off_sensitivity: f64,
}

fn first_seed() -> u64 {
    1
}

fn solid_name() -> String {
    "solid".to_owned()
}

/// Outlines of solids, in their reference state.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", rename_all_fields = "kebab-case")]
#[non_exhaustive]
pub enum SolidOutline {
    /// The wall from the lower rigid wall of the region up to the lower side of a channel.
    WallBelow(ChannelShape),
    /// The wall from the upper side of a channel up to the upper rigid wall of the region.
    WallAbove(ChannelShape),
    /// The wall from the lower rigid wall of the region up to the line through points (length) of one period, along x
    /// or against it; it may overhang. The image of the first one ends the line, given or left out. Joints turned by
    /// more than 15 degrees are corners.
    WallBelowPoints(Vec<[f64; 2]>),
    /// The wall from such a line up to the upper rigid wall of the region.
    WallAbovePoints(Vec<[f64; 2]>),
    /// The wall from the lower rigid wall of the region up to a line from a file or from points, as with
    /// [`SolidOutline::WallBelowPoints`].
    WallBelowLine(OutlineSetup),
    /// The wall from such a line up to the upper rigid wall of the region.
    WallAboveLine(OutlineSetup),
    /// A closed outline from a file or from points: the smooth curve through them, a smoother one, or a polygon.
    Closed(OutlineSetup),
    /// The mesh of a file or of arrays, in the place of a mesh by motile.
    Mesh(MeshSetup),
    /// An island of a channel.
    Island {
        /// The channel.
        of: ChannelShape,
        /// Number of the island, from 0.
        number: usize,
    },
    /// A disc.
    Disc {
        /// Its centre (length).
        centre: [f64; 2],
        /// Its radius (length).
        radius: f64,
    },
    /// An ellipse with its axes along x and y.
    Ellipse {
        /// Its centre (length).
        centre: [f64; 2],
        /// Half axes in x and y (length).
        half_axes: [f64; 2],
    },
    /// A polygon; the smooth curve that it stands for where no corner turns by more than 15 degrees.
    Polygon {
        /// Its corners in order (length).
        corners: Vec<[f64; 2]>,
        /// Radius of the arcs that replace corners (length); 0 for sharp ones. For a rigid wall, use at least 1.5 times
        /// its spacing, however sharp the corner is. [`WallSetup::rounding`](super::WallSetup::rounding) rounds in
        /// another way, by a Gaussian.
        #[serde(default)]
        rounding: f64,
    },
}

/// Elastic material of a solid; moduli are two-dimensional (force per length).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Material {
    /// Springs along the edges of the mesh (Cowley section 4.1); their bulk modulus is twice the shear modulus.
    Springs {
        /// Shear modulus (force per length).
        shear: f64,
    },
    /// The generalised neo-Hookean material of Cowley section 4.2.
    NeoHookean {
        /// Shear modulus (force per length).
        shear: f64,
        /// Bulk modulus (force per length).
        bulk: f64,
    },
    /// Saint Venant and Kirchhoff's material.
    SaintVenantKirchhoff {
        /// Shear modulus (force per length).
        shear: f64,
        /// Bulk modulus (force per length).
        bulk: f64,
    },
    /// Mooney and Rivlin's material.
    MooneyRivlin {
        /// Shear modulus (force per length).
        shear: f64,
        /// Bulk modulus (force per length).
        bulk: f64,
        /// Fraction of the shear modulus that the second invariant carries (0 to 1).
        fraction: f64,
    },
    /// No elastic stress: all its stress comes from its Maxwell elements, and it flows.
    FluidLike,
}

/// Arrangement of the points of a solid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum MeshKind {
    /// Equilateral triangles where the shape allows it, as in a straight wall.
    #[default]
    Equilateral,
    /// An even mesh that is not a lattice.
    Unstructured,
}

/// Hold that keeps a solid in place.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Hold {
    /// Outermost row of its points pinned to the rigid walls of the region.
    #[default]
    Pinned,
    /// Springs from all its points to their reference places.
    Tethered {
        /// Force per displacement and area (force per length cubed).
        stiffness: f64,
    },
    /// No hold: it moves with the fluid.
    Free,
}

/// Largest length over the spacing of its points that a solid may have.
const MOST_ACROSS: f64 = 1e5;
/// Angle by which the seeds of unstructured meshes are turned (radians).
const TURN: f64 = 0.2;

impl SolidSetup {
    /// Creates a solid that is pinned to the rigid walls of the region.
    #[must_use]
    pub fn new(outline: SolidOutline, material: Material) -> Self {
        Self {
            name: "solid".to_owned(),
            mesh: MeshKind::default(),
            mesh_spacing: None,
            finer_surface: None,
            spread_over_triangles: false,
            may_invert: false,
            hold: Hold::default(),
            outline,
            material,
            grading: Grading::default(),
            surface_elasticity: None,
            relaxation: Vec::new(),
            relaxation_time_grading: Grading::default(),
            body_force: [0.0; 2],
            force: [0.0; 2],
            viscosity: None,
            active_springs: None,
            tension_grading: Grading::default(),
        }
    }

    /// Returns the solids of an elastic channel: lower wall, upper wall, and islands, which are tethered by their shear
    /// modulus over the unit of length squared.
    #[must_use]
    pub fn walls(channel: &ChannelShape, material: &Material) -> Vec<Self> {
        let islands = channel.islands();
        let wall = |name: &str, outline| Self { name: name.to_owned(), ..Self::new(outline, *material) };
        let mut solids = vec![
            wall("lower wall", SolidOutline::WallBelow(*channel)),
            wall("upper wall", SolidOutline::WallAbove(*channel)),
        ];
        solids.extend((0..islands).map(|number| Self {
            hold: Hold::Tethered { stiffness: material.shear() },
            ..wall(&format!("island {}", number + 1), SolidOutline::Island { of: *channel, number })
        }));
        solids
    }

    /// Returns the solid by the method of Cowley (section 4.1): springs on an unstructured mesh (where the material is
    /// springs), and triangles may be inverted. For [`Method::Grid`], which smears the surface over the grid.
    #[must_use]
    pub fn thesis(self) -> Self {
        Self { mesh: MeshKind::Unstructured, may_invert: true, ..self }
    }

    /// Returns the mesher of this solid in a scene.
    ///
    /// # Errors
    /// Returns an error for a spacing that is not a length; a scene without a grid.
    pub fn mesher(&self, setup: &Setup) -> Result<Mesher, SetupError> {
        setup.able(self)?;
        let mesher = Mesher::new(self.spacing(setup))?;
        Ok(if self.mesh == MeshKind::Unstructured { mesher.turned(TURN)? } else { mesher })
    }

    /// Returns the solid of this description on your own mesh instead of its outline. Use it for shapes that data
    /// cannot describe.
    ///
    /// # Errors
    /// Returns an error for:
    /// * moduli out of their range,
    /// * a solid that is to be pinned and has no point on a rigid wall of the region,
    /// * a surface of fewer than 16 points, with layers.
    pub fn on_mesh(&self, mesh: TriangleMesh, setup: &Setup) -> Result<Solid, SetupError> {
        let half = 0.5 * setup.region.lengths()[1];
        let parts = match &self.outline {
            SolidOutline::Mesh(mesh) => Some(mesh.parts()?),
            _ => None,
        };
        let in_file = |s: Vec2| parts.as_ref().is_some_and(|parts| parts.is_pinned(s));
        let fixed = |s: Vec2| self.hold == Hold::Pinned && (s.y.abs() > half * (1.0 - 1e-9) || in_file(s));
        let factor = |s: Vec2| self.grading.factor(s) * parts.as_ref().map_or(1.0, |parts| parts.factor(s));
        let springs = matches!(self.material, Material::Springs { .. });
        let layers = setup.method.kind() == MethodKind::Layers;
        let finer = self.finer_surface.unwrap_or(layers && !springs);
        let times = if self.spread_over_triangles { 2 } else { 1 };
        let mesh =
            (0..if finer { times } else { 0 }).try_fold(mesh, |mesh, _| mesh.with_finer_boundary(|s| !fixed(s)))?;
        if layers {
            self.check_surface(&mesh, fixed, setup)?;
        }
        let share = mesh.area() / mesh.points().len() as f64;
        let mut solid = self.at_rest(mesh, factor)?.named(&self.name);
        if let Some(SurfaceElasticitySetup { stretching, bending }) = self.surface_elasticity {
            solid = solid.with_surface_elasticity(stretching, bending)?;
        }
        for &MaxwellSetup { modulus, time } in &self.relaxation {
            let times = |s: Vec2| time * self.relaxation_time_grading.factor(s);
            solid = solid.with_maxwell_graded(|s| Maxwell::new(modulus * factor(s), times(s)))?;
        }
        if let Some(excess) = self.viscosity.map(|own| own - setup.viscosity).filter(|excess| *excess > 0.0) {
            solid = solid.with_excess_viscosity(excess)?;
        }
        let density = Vec2::from(self.body_force) + Vec2::from(self.force) / solid.mesh().area();
        solid = solid.with_body_force(density)?;
        if let Some(active) = &self.active_springs {
            solid = solid.with_active_springs_graded(active.law()?, |s| self.tension_grading.factor(s))?;
        }
        let held = match self.hold {
            Hold::Pinned => solid.pinned(fixed)?,
            Hold::Tethered { stiffness } => solid.tethered(stiffness * share, |_| true)?,
            Hold::Free => solid,
        };
        let held = if self.spread_over_triangles { held.spread_over_triangles() } else { held };
        Ok(if self.may_invert { held.allow_inversion() } else { held })
    }
}

impl SolidSetup {
    /// Refuses a surface, which is not fixed, with fewer points than a layer needs.
    fn check_surface(
        &self,
        mesh: &TriangleMesh,
        fixed: impl Fn(Vec2) -> bool,
        setup: &Setup,
    ) -> Result<(), SetupError> {
        let [least, _] = Settings::NODES;
        let surfaces = mesh.boundary_loops().iter().map(|surface| &surface.points);
        let moving = surfaces.filter(|points| points.iter().any(|point| !fixed(mesh.points()[*point])));
        let found = moving.map(Vec::len).min().unwrap_or(least);
        if found >= least {
            return Ok(());
        }
        let spacing = self.spacing(setup);
        let remedy = format!(
            "its surface would have {found} points, but the method layers needs {least}. Use {:.2e} or less, with half \
             of it as the spacing of the grid, or finer-surface = true, or the method grid",
            spacing * found as f64 / least as f64
        );
        Checked { place: &self.name }.refuse("mesh-spacing", &spacing, remedy)
    }

    /// Returns the spacing of its points (length); infinite if there is no grid to give it.
    pub(super) fn spacing(&self, setup: &Setup) -> f64 {
        let usual = match setup.method {
            Method::Integral(_) | Method::Harmonics(_) => f64::INFINITY,
            Method::Layers(layers) => 2.0 * layers.spacing,
            Method::Grid(grid) => grid.spacing,
        };
        self.mesh_spacing.unwrap_or(usual)
    }

    /// Returns the interior of its outline in a region.
    pub(super) fn enclosed(&self, region: &Region) -> Result<Interior, SetupError> {
        let [period, height] = region.lengths();
        if let SolidOutline::Mesh(mesh) = &self.outline {
            return mesh.enclosed();
        }
        Ok(match self.outline.channel(region)? {
            Some(channel) if self.outline.is_above() => channel.above(0.5 * height)?,
            Some(channel) => channel.below(-0.5 * height)?,
            None => Interior::new([self.outline.line(period)?])?,
        })
    }

    /// Returns the solid on a mesh, at rest and not held, with that factor on its moduli.
    fn at_rest(&self, mesh: TriangleMesh, factor: impl Fn(Vec2) -> f64) -> Result<Solid, SolidError> {
        match self.material {
            Material::Springs { shear } => Solid::springs_graded(mesh, |s| shear * factor(s)),
            Material::FluidLike => Ok(Solid::fluid_like(mesh)),
            Material::NeoHookean { shear, bulk } => {
                Solid::hyperelastic_graded(mesh, |s| NeoHookean::new(shear * factor(s), bulk * factor(s)))
            }
            Material::SaintVenantKirchhoff { shear, bulk } => {
                Solid::hyperelastic_graded(mesh, |s| SaintVenantKirchhoff::new(shear * factor(s), bulk * factor(s)))
            }
            Material::MooneyRivlin { shear, bulk, fraction } => {
                Solid::hyperelastic_graded(mesh, |s| MooneyRivlin::new(shear * factor(s), bulk * factor(s), fraction))
            }
        }
    }

    /// Returns the height y of the side of the channel next to it (length), if this is a wall of a channel of known
    /// width.
    pub(super) fn side(&self) -> Option<f64> {
        match &self.outline {
            SolidOutline::WallBelow(shape) => Some(-0.5 * shape.width()),
            SolidOutline::WallAbove(shape) => Some(0.5 * shape.width()),
            _ => None,
        }
    }
}

/// Returns an outline with arcs of that radius (length) in the place of its corners, or with its corners.
fn rounded(outline: Outline, radius: Option<f64>) -> Result<Outline, SolidError> {
    match radius.filter(|radius| *radius > 0.0) {
        Some(radius) => outline.rounded(radius),
        None => Ok(outline),
    }
}

impl SolidOutline {
    /// Returns the side of the channel, or the closed outline, for a period along x (length).
    pub(super) fn line(&self, period: f64) -> Result<Outline, SetupError> {
        let vector = |[x, y]: [f64; 2]| Vec2::new(x, y);
        Ok(match self {
            Self::WallBelow(shape) => shape.channel(period)?.lower().clone(),
            Self::WallAbove(shape) => shape.channel(period)?.upper().clone(),
            Self::WallBelowPoints(points) | Self::WallAbovePoints(points) => {
                let mut points: Vec<Vec2> = points.iter().copied().map(vector).collect();
                if points.first().zip(points.last()).is_some_and(|(first, last)| last.x < first.x) {
                    points.reverse();
                }
                let shift = Vec2::new(period, 0.0);
                if points.len() > 1 && (points[points.len() - 1] - points[0]).distance(shift) < 1e-9 * period {
                    points.pop();
                }
                Outline::polyline(&points, period)?
            }
            Self::WallBelowLine(outline) | Self::WallAboveLine(outline) => {
                let points = outline.prepared(Some(period), OutlineOrigin::File)?.points;
                rounded(Outline::polyline(&points, period)?, outline.rounding)?
            }
            Self::Closed(outline) if outline.rounding.is_some() => {
                let points = outline.prepared(None, OutlineOrigin::File)?.points;
                rounded(Outline::polygon(&points)?, outline.rounding)?
            }
            Self::Closed(outline) => {
                let curve = outline.curve(OutlineOrigin::File)?;
                Outline::closed(move |t| curve.point(t))?
            }
            Self::Mesh(_) => {
                let what = "a rigid wall is a line, but this outline is a mesh";
                return Err(SetupError::refused(what, "", "Use the outline \"closed\", or an elastic solid"));
            }
            Self::Island { of, number } => of.channel(period)?.island(*number)?.clone(),
            &Self::Disc { centre, radius } => Outline::circle(vector(centre), radius)?,
            &Self::Ellipse { centre, half_axes } => Outline::ellipse(vector(centre), half_axes)?,
            Self::Polygon { corners, rounding } => {
                let corners: Vec<Vec2> = corners.iter().copied().map(vector).collect();
                let outline = Outline::polygon(&corners)?;
                rounded(outline, Some(*rounding))?
            }
        })
    }

    /// Returns the channel that this is a wall of, out to the other rigid wall where its line alone is known; none if
    /// this is not a wall.
    fn channel(&self, region: &Region) -> Result<Option<Channel>, SetupError> {
        let [period, height] = region.lengths();
        let level = |y| Outline::flat(-0.5 * period, period, y);
        Ok(Some(match self {
            Self::WallBelow(shape) | Self::WallAbove(shape) => shape.channel(period)?,
            Self::WallBelowPoints(_) | Self::WallBelowLine(_) => {
                Channel::new(self.line(period)?, level(0.5 * height)?)?
            }
            Self::WallAbovePoints(_) | Self::WallAboveLine(_) => {
                Channel::new(level(-0.5 * height)?, self.line(period)?)?
            }
            _ => return Ok(None),
        }))
    }

    /// Returns the key of this outline in the entry of its body.
    fn key(&self) -> String {
        match self {
            Self::WallBelow(shape) => format!("outline.wall-below.{}", shape.name()),
            Self::WallAbove(shape) => format!("outline.wall-above.{}", shape.name()),
            Self::Island { of, .. } => format!("outline.island.of.{}", of.name()),
            Self::WallBelowPoints(_) => "outline.wall-below-points".to_owned(),
            Self::WallAbovePoints(_) => "outline.wall-above-points".to_owned(),
            Self::WallBelowLine(_) => "outline.wall-below-line".to_owned(),
            Self::WallAboveLine(_) => "outline.wall-above-line".to_owned(),
            Self::Closed(_) => "outline.closed".to_owned(),
            Self::Mesh(_) => "outline.mesh".to_owned(),
            Self::Disc { .. } => "outline.disc".to_owned(),
            Self::Ellipse { .. } => "outline.ellipse".to_owned(),
            Self::Polygon { .. } => "outline.polygon".to_owned(),
        }
    }

    /// Refuses values out of their range, of solids and of rigid walls alike.
    pub(super) fn check(&self, checked: &Checked<'_>, region: &Region) -> Result<(), SetupError> {
        let (key, [_, height]) = (self.key(), region.lengths());
        match self {
            Self::WallBelowPoints(points) | Self::WallAbovePoints(points) => {
                checked.all_points_finite(&key, points)?;
                let remedy =
                    format!("use heights between the rigid walls of the region, at -{0} and {0}", 0.5 * height);
                let mut heights = points.iter().map(|[_, y]| *y).enumerate();
                heights.try_for_each(|(k, y)| {
                    checked.require(y.abs() < 0.5 * height, &format!("{key}[{k}][1]"), y, &remedy)
                })
            }
            Self::WallBelowLine(outline) | Self::WallAboveLine(outline) | Self::Closed(outline) => {
                outline.check(checked, &key, true)
            }
            Self::WallBelow(shape) | Self::WallAbove(shape) | Self::Island { of: shape, .. } => {
                let (key, width) = (format!("{key}.width"), shape.width());
                checked.positive(&key, width)?;
                let remedy =
                    format!("the walls need room in the region. Use a number below {height}, the width of the region");
                checked.require(!self.is_wall() || width < height, &key, width, &remedy)?;
                let Self::Island { number, .. } = *self else { return Ok(()) };
                let islands = shape.islands();
                let remedy = format!("a {} channel has {islands}, counted from 0", shape.name());
                checked.require(number < islands, "outline.island.number", number as f64, &remedy)
            }
            Self::Mesh(_) => Ok(()),
            Self::Disc { centre, radius } => {
                checked.all_finite("outline.disc.centre", centre)?;
                checked.positive("outline.disc.radius", *radius)
            }
            Self::Ellipse { centre, half_axes } => {
                checked.all_finite("outline.ellipse.centre", centre)?;
                half_axes.iter().try_for_each(|&axis| checked.positive("outline.ellipse.half-axes", axis))
            }
            Self::Polygon { corners, rounding } => {
                let remedy = "a polygon has at least 3 corners";
                checked.refuse_if(corners.len() < 3, "outline.polygon.corners", corners.len(), remedy)?;
                checked.all_points_finite("outline.polygon.corners", corners)?;
                checked.not_negative("outline.polygon.rounding", *rounding)
            }
        }
    }

    /// Returns true of a wall above the fluid.
    pub(super) fn is_above(&self) -> bool {
        matches!(self, Self::WallAbove(_) | Self::WallAbovePoints(_) | Self::WallAboveLine(_))
    }

    /// Returns true of a wall that reaches a rigid wall of the region.
    pub(super) fn is_wall(&self) -> bool {
        self.is_above() || matches!(self, Self::WallBelow(_) | Self::WallBelowPoints(_) | Self::WallBelowLine(_))
    }
}

impl Material {
    /// Returns the shear modulus (force per length); 0 of what is fluid-like.
    #[must_use]
    pub fn shear(&self) -> f64 {
        match *self {
            Self::FluidLike => 0.0,
            Self::Springs { shear }
            | Self::NeoHookean { shear, .. }
            | Self::SaintVenantKirchhoff { shear, .. }
            | Self::MooneyRivlin { shear, .. } => shear,
        }
    }
}

impl ActiveSpringsSetup {
    /// Returns the law of the springs.
    ///
    /// # Errors
    /// Returns an error for numbers out of their range.
    pub fn law(&self) -> Result<ActiveSprings, SolidError> {
        let &Self { tension, on, off, seed, on_sensitivity, off_sensitivity } = self;
        ActiveSprings::new(tension, on, off, seed)?.with_sensitivities(on_sensitivity, off_sensitivity)
    }

    fn check(&self, checked: &Checked<'_>) -> Result<(), SetupError> {
        checked.positive("active-springs.tension", self.tension)?;
        checked.positive("active-springs.on", self.on)?;
        checked.not_negative("active-springs.off", self.off)?;
        checked.finite("active-springs.on-sensitivity", self.on_sensitivity)?;
        checked.finite("active-springs.off-sensitivity", self.off_sensitivity)
    }
}

impl BodySetup for SolidSetup {
    fn kind(&self) -> [&'static str; 2] {
        ["solids", "solid"]
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn needs(&self) -> Option<(&'static str, &'static [MethodKind])> {
        Some(("solids", &[MethodKind::Layers, MethodKind::Grid]))
    }

    fn plan<'a>(&'a self, setup: &'a Setup) -> Result<Planned<'a>, SetupError> {
        let enclosed = self.enclosed(&setup.region)?;
        let grid = setup.method.spacing().unwrap_or(f64::INFINITY);
        let boundary = enclosed.boundary(self.mesh_spacing.map_or(grid, |spacing| spacing.min(grid)))?;
        let corners = if enclosed.period().is_none() { boundary.corners().collect() } else { Vec::new() };
        let add = move |scene: &mut Scene<AnyFlow>| {
            if let SolidOutline::Mesh(mesh) = &self.outline {
                setup.able(self)?;
                scene.add(self.on_mesh(mesh.mesh()?, setup)?);
                return Ok(());
            }
            let (mesher, [_, height]) = (self.mesher(setup)?, setup.region.lengths());
            let mesh = match self.outline.channel(&setup.region)? {
                Some(channel) if self.outline.is_above() => channel.upper_wall(0.5 * height, &mesher)?,
                _ => mesher.mesh(&enclosed)?,
            };
            scene.add(self.on_mesh(mesh, setup)?);
            Ok(())
        };
        Ok(Planned { boundary, kind: MarkerKind::Points, corners, add: Box::new(add) })
    }

    fn check(&self, checked: &Checked<'_>, setup: &Setup) -> Result<(), SetupError> {
        if let Some(spacing) = self.mesh_spacing {
            checked.positive("mesh-spacing", spacing)?;
            let least = 2.0 * setup.method.spacing().unwrap_or(0.0);
            let close = setup.method.kind() == MethodKind::Layers && spacing < least * (1.0 - 1e-9);
            let remedy = format!(
                "the grid hardly resolves inner points so close to a layer. Use {least} or more, or the method grid"
            );
            checked.refuse_if(close, "mesh-spacing", spacing, remedy)?;
        }
        if let Some(SurfaceElasticitySetup { stretching, bending }) = self.surface_elasticity {
            checked.not_negative("surface_elasticity.stretching", stretching)?;
            checked.not_negative("surface_elasticity.bending", bending)?;
        }
        checked.all_finite("body-force", &self.body_force)?;
        checked.all_finite("force", &self.force)?;
        setup.check_body_force(checked, self.body_force)?;
        let spacing = self.spacing(setup);
        let across = |key: &str, length: f64| {
            let remedy = format!(
                "with points {spacing} apart it would have too many of them. Use less width or a larger spacing"
            );
            checked.require(length / spacing <= MOST_ACROSS, key, length, &remedy)
        };
        let no_channel = setup.region.drive().is_none();
        let part = self.outline.is_wall() || matches!(self.outline, SolidOutline::Island { .. });
        let remedy = "use a region that is a channel";
        checked.refuse_if(no_channel && part, "outline", "a wall or an island", remedy)?;
        self.outline.check(checked, &setup.region)?;
        let [length, height] = setup.region.lengths();
        match &self.outline {
            SolidOutline::WallBelow(_) | SolidOutline::WallAbove(_) | SolidOutline::Island { .. } => {
                across(&format!("{}.width", self.outline.key()), height.max(length))?;
            }
            SolidOutline::WallBelowPoints(_)
            | SolidOutline::WallAbovePoints(_)
            | SolidOutline::WallBelowLine(_)
            | SolidOutline::WallAboveLine(_) => across(&self.outline.key(), height.max(length))?,
            SolidOutline::Closed(_) => {}
            SolidOutline::Mesh(mesh) => {
                mesh.check(checked)?;
                let remedy = "the mesh is given by its outline.mesh. Remove the key";
                checked.refuse_if(self.mesh != MeshKind::default(), "mesh", "given", remedy)?;
                checked.refuse_if(self.mesh_spacing.is_some(), "mesh-spacing", "given", remedy)?;
            }
            SolidOutline::Disc { radius, .. } => across("outline.disc.radius", *radius)?,
            SolidOutline::Ellipse { half_axes, .. } => {
                half_axes.iter().try_for_each(|&axis| across("outline.ellipse.half-axes", axis))?;
            }
            SolidOutline::Polygon { corners, .. } => {
                let mut lengths = corners.as_flattened().iter();
                lengths.try_for_each(|length| across("outline.polygon.corners", length.abs()))?;
            }
        }
        let remedy = "only walls touch the rigid walls of the region, where they can be pinned. Use tethered or \
                      free, or name groups of lines of its mesh by outline.mesh.pinned";
        let has_base = matches!(&self.outline, SolidOutline::Mesh(mesh) if !mesh.pinned.is_empty());
        let loose = self.hold == Hold::Pinned && !self.outline.is_wall() && !has_base;
        checked.refuse_if(loose, "hold", "pinned", remedy)?;
        let remedy = "groups of the mesh are pinned, which the hold must say. Use hold = \"pinned\"";
        checked.refuse_if(self.hold != Hold::Pinned && has_base, "outline.mesh.pinned", "given", remedy)?;
        if let Hold::Tethered { stiffness } = self.hold {
            checked.positive("hold.tethered.stiffness", stiffness)?;
        }
        let period = self.outline.is_wall().then(|| setup.region.lengths()[0]);
        self.grading.check("grading", checked, period)?;
        self.relaxation_time_grading.check("relaxation-time-grading", checked, period)?;
        self.tension_grading.check("tension-grading", checked, period)?;
        for (key, grading, missing, of) in [
            ("relaxation-time-grading", &self.relaxation_time_grading, self.relaxation.is_empty(), "relaxation"),
            ("tension-grading", &self.tension_grading, self.active_springs.is_none(), "active-springs"),
        ] {
            let remedy =
                format!("a grading multiplies a quantity that this solid lacks. Add {of}, or remove the grading");
            checked.refuse_if(missing && !grading.is_uniform(), key, "given", remedy)?;
        }
        for (number, MaxwellSetup { modulus, time }) in self.relaxation.iter().enumerate() {
            checked.positive(&format!("relaxation[{number}].modulus"), *modulus)?;
            checked.positive(&format!("relaxation[{number}].time"), *time)?;
        }
        if let Some(viscosity) = self.viscosity {
            let least = setup.viscosity;
            let remedy =
                format!("the fluid inside the solid already has {least}. Use a finite number that is not below it");
            checked.require(viscosity.is_finite() && viscosity >= least, "viscosity", viscosity, &remedy)?;
        }
        if let Some(active) = &self.active_springs {
            active.check(checked)?;
        }
        let relaxes = !self.relaxation.is_empty();
        let remedy = "nothing would hold the solid together. Add relaxation = [{ modulus = ..., time = ... }]";
        checked.refuse_if(self.material == Material::FluidLike && !relaxes, "material", "fluid-like", remedy)?;
        let remedy =
            "runge-kutta cannot treat relaxation, which is implicit. Use another integrator, or remove the key";
        let explicit = setup.integrator == IntegratorKind::RungeKutta;
        checked.refuse_if(relaxes && explicit, "relaxation", "given", remedy)?;
        for (key, given) in [
            ("relaxation", relaxes),
            ("active-springs", self.active_springs.is_some()),
            ("spread-over-triangles", self.spread_over_triangles),
        ] {
            let remedy = "the state of such a solid has no mirror image. Remove this key, or mirror-symmetric";
            checked.refuse_if(given && setup.mirror_symmetric, key, "given", remedy)?;
        }
        self.material.check(checked)
    }
}

impl Material {
    fn check(&self, checked: &Checked<'_>) -> Result<(), SetupError> {
        let (name, bulk) = match *self {
            Self::FluidLike => return Ok(()),
            Self::Springs { .. } => ("springs", None),
            Self::NeoHookean { bulk, .. } => ("neo-hookean", Some(bulk)),
            Self::SaintVenantKirchhoff { bulk, .. } => ("saint-venant-kirchhoff", Some(bulk)),
            Self::MooneyRivlin { bulk, .. } => ("mooney-rivlin", Some(bulk)),
        };
        let key = |entry: &str| format!("material.{name}.{entry}");
        checked.positive(&key("shear"), self.shear())?;
        bulk.map_or(Ok(()), |bulk| checked.positive(&key("bulk"), bulk))?;
        match *self {
            Self::MooneyRivlin { fraction, .. } => {
                let holds = (0.0..=1.0).contains(&fraction);
                checked.require(holds, &key("fraction"), fraction, "use a number from 0 to 1")
            }
            _ => Ok(()),
        }
    }
}
