//! Descriptions of elastic solids.

use elastic_solids::channel::ChannelShape;
use elastic_solids::material::{MooneyRivlin, SaintVenantKirchhoff};
use elastic_solids::{Interior, Mesher, NeoHookean, Outline, Solid, SolidError, TriangleMesh};
use ib_core::Vec2;
use serde::{Deserialize, Serialize};

use super::{GridMethod, Method, Region, Setup};
use crate::SetupError;

/// An elastic solid in the fluid: a wall, an island, a nucleus.
///
/// ```
/// use motile::prelude::*;
///
/// // A soft channel of width 2, stiffening along x, in a region of 12 x 5 whose rigid walls hold the outermost rows.
/// let material = Material::NeoHookean { shear: 200.0, bulk: 400.0 };
/// let grading = Grading::Along { axis: Axis::X, factors: vec![[-6.0, 1.0], [0.0, 4.0], [6.0, 1.0]] };
/// let walls = SolidSetup::walls(&ChannelShape::Straight { width: 2.0 }, &material);
/// let solids = walls.into_iter().map(|wall| SolidSetup { grading: grading.clone(), ..wall }).collect();
/// let setup = Setup {
///     region: Region::Channel { length: 12.0, width: 5.0, drive: Drive::ZeroGradient },
///     method: Method::Grid(GridMethod::of_spacing(0.1)),
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
pub struct SolidSetup {
    /// Name for messages.
    #[serde(default = "solid_name")]
    pub name: String,
    /// How its points are arranged.
    #[serde(default)]
    pub mesh: MeshKind,
    /// Spacing of its points (length), on a finer surface half of that; `None` for that of the grid, twice that with a
    /// layer.
    #[serde(default)]
    pub mesh_spacing: Option<f64>,
    /// How its surface meets the fluid.
    #[serde(default)]
    pub surface: Surface,
    /// Whether a surface that is a layer has a point more in the middle of each side: more accurate beside thin films,
    /// but it folds where it is compressed by a third along itself, springs first; `None` for all but springs.
    #[serde(default)]
    pub finer_surface: Option<bool>,
    /// Whether triangles of springs may be inverted ([`Solid::allow_inversion`]).
    #[serde(default)]
    pub may_invert: bool,
    /// How it is held in place.
    #[serde(default)]
    pub hold: Hold,
    /// What it bounds.
    pub outline: SolidOutline,
    /// What it is made of.
    pub material: Material,
    /// Its moduli as a function of place.
    #[serde(default)]
    pub grading: Grading,
    /// A skin on its surface, which keeps a soft one from creasing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub skin: Option<SkinSetup>,
}

/// An elastic skin on the surface of a solid ([`Solid::with_skin`]).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct SkinSetup {
    /// Modulus of stretching (force).
    #[serde(default)]
    pub stretching: f64,
    /// Modulus of bending (force times length squared).
    pub bending: f64,
}

fn solid_name() -> String {
    SolidSetup::NAME.to_owned()
}

/// Outlines of solids, in their reference state.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", rename_all_fields = "kebab-case")]
pub enum SolidOutline {
    /// The wall from the lower rigid wall of the region up to the lower side of a channel.
    WallBelow(ChannelShape),
    /// The wall from the upper side of a channel up to the upper rigid wall of the region.
    WallAbove(ChannelShape),
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
    /// A polygon.
    Polygon {
        /// Its corners in order (length).
        corners: Vec<[f64; 2]>,
        /// Radius to which corners are rounded (length); 0 for sharp ones.
        #[serde(default)]
        fillet: f64,
    },
}

/// What a solid is made of. Moduli are those of the plane (force per length).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
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
        /// Part of the shear modulus that the second invariant carries (0 to 1).
        fraction: f64,
    },
}

/// Moduli as a function of the reference position: a factor on all moduli of the material.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub enum Grading {
    /// The same everywhere.
    #[default]
    Uniform,
    /// A factor that is piecewise linear along an axis and constant beyond its first and last place.
    Along {
        /// The axis.
        axis: Axis,
        /// Places (length, increasing), each with the factor there (no dimension, positive).
        factors: Vec<[f64; 2]>,
    },
}

/// An axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Axis {
    /// Along the channel.
    X,
    /// Across it.
    Y,
}

/// How the points of a solid are arranged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MeshKind {
    /// Equilateral triangles where the shape allows it, as in a straight wall.
    #[default]
    Equilateral,
    /// An even mesh that is no lattice.
    Unstructured,
}

/// How the surface of a solid meets the fluid; the same for all solids of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Surface {
    /// As a layer, where it is and exact in films ([`ib_core::ImmersedLayers`]), beside interfaces that are layers of
    /// the resolution [`GridMethod::layers`]. Needs a composite B-spline, inner points two or more grid spacings apart,
    /// 16 or more points on the surface and a sharp contrast where viscosities differ. A round droplet that would start
    /// in contact with walls starts squeezed a little, beside a film.
    #[default]
    Layer,
    /// Smeared over the grid like all points, as in Cowley: a stiff surface stops the fluid 0.31 to 0.44 grid spacings
    /// in front of it (with the default kernel).
    Plain,
}

/// How a solid is held in place.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub enum Hold {
    /// By the rigid walls of the region, to which its outermost row of points is pinned.
    #[default]
    Pinned,
    /// By springs from all its points to their reference places.
    Tethered {
        /// Force per displacement and area (force per length cubed).
        stiffness: f64,
    },
    /// Not at all: it moves with the fluid.
    Free,
}

/// Angle by which the seeds of unstructured meshes are turned (radians).
const TURN: f64 = 0.2;

impl SolidSetup {
    /// A solid that is pinned to the rigid walls of the region, its surface a layer.
    #[must_use]
    pub fn new(outline: SolidOutline, material: Material) -> Self {
        Self {
            name: Self::NAME.to_owned(),
            mesh: MeshKind::default(),
            mesh_spacing: None,
            surface: Surface::default(),
            finer_surface: None,
            may_invert: false,
            hold: Hold::default(),
            outline,
            material,
            grading: Grading::default(),
            skin: None,
        }
    }

    /// The solids of an elastic channel: lower wall, upper wall, and islands, which are tethered by their shear modulus
    /// over the unit of length squared.
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

    /// The same by the method of Cowley (section 4.1): springs on an unstructured mesh (where the material is
    /// springs), a surface that is smeared over the grid, and triangles may be inverted.
    #[must_use]
    pub fn thesis(self) -> Self {
        Self { mesh: MeshKind::Unstructured, surface: Surface::Plain, may_invert: true, ..self }
    }

    /// What makes the mesh of this solid on a grid.
    ///
    /// # Errors
    /// A spacing that is no length.
    pub fn mesher(&self, grid: &GridMethod) -> Result<Mesher, SetupError> {
        let usual = if self.surface == Surface::Layer { 2.0 * grid.spacing } else { grid.spacing };
        let mesher = Mesher::new(self.mesh_spacing.unwrap_or(usual))?;
        Ok(if self.mesh == MeshKind::Unstructured { mesher.turned(TURN)? } else { mesher })
    }

    /// The solid of this description on a mesh of one's own, in place of its outline: for shapes that data cannot say.
    ///
    /// # Errors
    /// Moduli out of their range; a solid that is to be pinned and has no point on a rigid wall of the region.
    pub fn on_mesh(&self, mesh: TriangleMesh, region: &Region) -> Result<Solid, SetupError> {
        let half = 0.5 * region.lengths()[1];
        let fixed = |s: Vec2| self.hold == Hold::Pinned && s.y.abs() > half * (1.0 - 1e-9);
        let springs = matches!(self.material, Material::Springs { .. });
        let finer = self.surface == Surface::Layer && self.finer_surface.unwrap_or(!springs);
        let mesh = if finer { mesh.with_finer_boundary(|s| !fixed(s))? } else { mesh };
        let share = mesh.area() / mesh.points().len() as f64;
        let mut solid = self.at_rest(mesh)?.named(&self.name);
        if let Some(SkinSetup { stretching, bending }) = self.skin {
            solid = solid.with_skin(stretching, bending)?;
        }
        let held = match self.hold {
            Hold::Pinned => solid.pinned(fixed)?,
            Hold::Tethered { stiffness } => solid.tethered(stiffness * share, |_| true)?,
            Hold::Free => solid,
        };
        Ok(if self.may_invert { held.allow_inversion() } else { held })
    }
}

impl SolidSetup {
    /// Its name unless it has one of its own.
    pub(super) const NAME: &str = "solid";

    /// The solid of this description in a scene.
    pub(super) fn build(&self, setup: &Setup) -> Result<Solid, SetupError> {
        let Method::Grid(grid) = &setup.method else { return Err(SetupError::needs_a_grid("solids")) };
        let enclosed = self.enclosed(&setup.region)?;
        let mesh = self.mesher(grid)?.mesh(&enclosed)?;
        self.on_mesh(mesh, &setup.region)
    }

    /// What it fills.
    pub(super) fn enclosed(&self, region: &Region) -> Result<Interior, SetupError> {
        let [period, height] = region.lengths();
        let closed = match &self.outline {
            SolidOutline::WallBelow(shape) => return Ok(shape.channel(period)?.below(-0.5 * height)?),
            SolidOutline::WallAbove(shape) => return Ok(shape.channel(period)?.above(0.5 * height)?),
            outline => outline.line(period)?,
        };
        Ok(Interior::new([closed])?)
    }

    /// The solid on a mesh, at rest and not held.
    fn at_rest(&self, mesh: TriangleMesh) -> Result<Solid, SolidError> {
        let factor = |place: Vec2| self.grading.factor(place);
        match self.material {
            Material::Springs { shear } => Solid::springs_graded(mesh, |s| shear * factor(s)),
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

    /// How far from y = 0 the channel beside it reaches, below or above (length), where this is a wall.
    pub(super) fn side(&self) -> Option<f64> {
        match &self.outline {
            SolidOutline::WallBelow(shape) => Some(-0.5 * shape.width()),
            SolidOutline::WallAbove(shape) => Some(0.5 * shape.width()),
            _ => None,
        }
    }
}

impl SolidOutline {
    /// The side of the channel, or the closed outline, for a period along x (length).
    pub(super) fn line(&self, period: f64) -> Result<Outline, SetupError> {
        let vector = |[x, y]: [f64; 2]| Vec2::new(x, y);
        Ok(match self {
            Self::WallBelow(shape) => shape.channel(period)?.lower().clone(),
            Self::WallAbove(shape) => shape.channel(period)?.upper().clone(),
            Self::Island { of, number } => of.channel(period)?.island(*number)?.clone(),
            &Self::Disc { centre, radius } => Outline::circle(vector(centre), radius)?,
            &Self::Ellipse { centre, half_axes } => Outline::ellipse(vector(centre), half_axes)?,
            Self::Polygon { corners, fillet } => {
                let corners: Vec<Vec2> = corners.iter().copied().map(vector).collect();
                let outline = Outline::polygon(&corners)?;
                if *fillet > 0.0 { outline.filleted(*fillet)? } else { outline }
            }
        })
    }
}

impl Material {
    /// Shear modulus (force per length).
    #[must_use]
    pub fn shear(&self) -> f64 {
        match *self {
            Self::Springs { shear }
            | Self::NeoHookean { shear, .. }
            | Self::SaintVenantKirchhoff { shear, .. }
            | Self::MooneyRivlin { shear, .. } => shear,
        }
    }
}

impl Grading {
    /// The factor on the moduli at a reference position (length); no dimension.
    #[must_use]
    pub fn factor(&self, place: Vec2) -> f64 {
        let Self::Along { axis, factors } = self else { return 1.0 };
        let at = if *axis == Axis::X { place.x } else { place.y };
        let above = factors.partition_point(|[x, _]| *x <= at);
        match (above.checked_sub(1).map(|below| factors[below]), factors.get(above)) {
            (Some([x0, f0]), Some(&[x1, f1])) => f0 + (f1 - f0) * (at - x0) / (x1 - x0),
            (Some([_, factor]), None) | (None, Some(&[_, factor])) => factor,
            (None, None) => 1.0,
        }
    }
}
