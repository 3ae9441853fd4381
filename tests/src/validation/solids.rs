//! Elastic solids: energies, forces and moduli, and a layer in a flow.

use motile::base::Vec2;
use motile::boundary_integrals::ImmersedLayers;
use motile::elastic_solids::{
    DeformationGradient, ElasticForces, EnergyDensity, Hyperelastic, Interior, Mat2, Mesher, MooneyRivlin, NeoHookean,
    Outline, SaintVenantKirchhoff, Solid, SolidError, Springs,
    check::{ForceBalance, InnerPoints, MeasuredModuli, force_balance, measured_moduli, patch_residual, stress_error},
    mesh::{TriangleMesh, equilateral_block, equilateral_strip, fitted_strip},
};
use motile::ib_core::{BSpline, ImmersedBoundary};
use motile::scene::{Hydrodynamics, Scene};
use motile::stokes_grid::{ChannelStokes, Grid};

use crate::validation::StudyError;

/// Shear modulus of all materials but in the layer (force per length).
pub const SHEAR: f64 = 1.3;
/// Bulk modulus of all materials that are no springs (force per length).
pub const BULK: f64 = 2.9;

/// Things of one kind, each with its name.
pub type Named<T> = Vec<(&'static str, Box<T>)>;

/// All energies.
///
/// # Errors
/// Moduli that are refused.
pub fn energies() -> Result<Named<dyn EnergyDensity>, SolidError> {
    Ok(vec![
        ("neo-Hookean", Box::new(NeoHookean::new(SHEAR, BULK)?)),
        ("Saint Venant-Kirchhoff", Box::new(SaintVenantKirchhoff::new(SHEAR, BULK)?)),
        ("Mooney-Rivlin, 0", Box::new(MooneyRivlin::new(SHEAR, BULK, 0.0)?)),
        ("Mooney-Rivlin, 0.35", Box::new(MooneyRivlin::new(SHEAR, BULK, 0.35)?)),
        ("Mooney-Rivlin, 1", Box::new(MooneyRivlin::new(SHEAR, BULK, 1.0)?)),
    ])
}

/// The largest difference of the stress from the central difference of the energy, over the stress or, where that is
/// smaller, the shear modulus. Over deformations with principal stretches from 0.5 to 2 between rotations.
///
/// # Errors
/// Those of [`stress_error`].
pub fn largest_stress_error(energy: &dyn EnergyDensity) -> Result<f64, SolidError> {
    let norm = |matrix: Mat2| matrix.x_axis.length().hypot(matrix.y_axis.length());
    let mut largest = 0.0_f64;
    for first in [0.5, 0.8, 1.0, 1.3, 2.0] {
        for second in [0.5, 0.9, 1.1, 1.6, 2.0] {
            for (before, after) in [(0.0, 0.0), (0.7, -0.4), (2.1, 1.3), (-1.2, 2.9)] {
                let deformation =
                    Mat2::from_angle(after) * Mat2::from_diagonal(Vec2::new(first, second)) * Mat2::from_angle(before);
                let gradient = DeformationGradient::new(deformation)?;
                let scale = norm(energy.stress(&gradient)).max(SHEAR);
                largest = largest.max(stress_error(energy, deformation, 5e-6)? / scale);
            }
        }
    }
    Ok(largest)
}

/// All laws of forces on a mesh.
///
/// # Errors
/// Moduli that are refused.
pub fn laws(mesh: &TriangleMesh) -> Result<Named<dyn ElasticForces>, SolidError> {
    Ok(vec![
        ("springs", Box::new(Springs::new(mesh, SHEAR)?)),
        ("neo-Hookean", Box::new(Hyperelastic::new(mesh, NeoHookean::new(SHEAR, BULK)?))),
        ("Saint Venant-Kirchhoff", Box::new(Hyperelastic::new(mesh, SaintVenantKirchhoff::new(SHEAR, BULK)?))),
        ("Mooney-Rivlin, 0.35", Box::new(Hyperelastic::new(mesh, MooneyRivlin::new(SHEAR, BULK, 0.35)?))),
    ])
}

/// A ring, unstructured, and a block of equilateral triangles.
///
/// # Errors
/// A mesh that could not be made.
pub fn meshes() -> Result<[TriangleMesh; 2], SolidError> {
    let circle = |radius: f64| Outline::circle(Vec2::new(0.2, -0.1), radius);
    Ok([Interior::new([circle(1.0)?, circle(0.4)?])?.mesh(0.1)?, equilateral_block(Vec2::ZERO, 12, 11, 0.1)?])
}

/// The balance of the forces under a large deformation that is not smooth on the scale of the mesh.
///
/// # Errors
/// An inverted triangle.
pub fn balance(mesh: &TriangleMesh, law: &dyn ElasticForces) -> Result<ForceBalance, SolidError> {
    let rough = |s: Vec2| 0.01 * Vec2::new((91.0 * s.x + 37.0 * s.y).sin(), (53.0 * s.x - 71.0 * s.y).sin());
    let smooth = |s: Vec2| 0.1 * Vec2::new((2.1 * s.x + s.y).sin(), (4.2 * s.x).cos() * s.y);
    let positions: Vec<Vec2> = mesh.points().iter().map(|&s| s + smooth(s) + rough(s)).collect();
    force_balance(law, &positions)
}

/// The patch test under a stretch, shear and rotation of 10 to 20 per cent.
///
/// # Errors
/// Those of [`patch_residual`].
pub fn patch(mesh: &TriangleMesh, law: &dyn ElasticForces) -> Result<f64, SolidError> {
    patch_residual(mesh, law, Mat2::from_rows_array(&[1.1, 0.2, -0.1, 0.9]))
}

/// Where moduli are measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sample {
    /// A periodic wall of equilateral triangles.
    Lattice,
    /// A periodic wall, unstructured.
    Wall,
    /// A disc, unstructured.
    Disc,
}

/// The moduli that a mesh of spacing 0.05 shows, with its inner points in equilibrium, over those of the material.
///
/// # Errors
/// A mesh that could not be made, a relaxation that does not converge.
pub fn moduli(sample: Sample, material: Material) -> Result<MeasuredModuli, SolidError> {
    let mesh = match sample {
        Sample::Lattice => equilateral_strip(Vec2::ZERO, 40, 30, 0.05)?,
        Sample::Wall => {
            let region = Interior::new([Outline::flat(0.0, 4.0, 0.0)?, Outline::flat(0.0, 4.0, 1.5)?])?;
            Mesher::new(0.05)?.turned(TURN)?.mesh(&region)?
        }
        Sample::Disc => Outline::circle(Vec2::ZERO, 1.0)?.mesh(0.05)?,
    };
    let found = |law: &dyn ElasticForces| -> Result<MeasuredModuli, SolidError> {
        measured_moduli(&mesh, law, 1e-3, InnerPoints::Relaxed)
    };
    let (mut found, bulk) = match material {
        Material::Springs => (found(&Springs::new(&mesh, SHEAR)?)?, 2.0 * SHEAR),
        Material::NeoHookean => (found(&Hyperelastic::new(&mesh, NeoHookean::new(SHEAR, BULK)?))?, BULK),
    };
    found.shear /= SHEAR;
    found.bulk /= bulk;
    Ok(found)
}

/// Turn of the seeds of unstructured walls (radians).
const TURN: f64 = 0.2;

/// Material of a solid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Material {
    /// Springs.
    Springs,
    /// Neo-Hookean material.
    NeoHookean,
}

/// An elastic layer on the lower wall of a channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Layer {
    /// Material.
    pub material: Material,
    /// True if its mesh is no lattice.
    pub unstructured: bool,
    /// How its surface meets the fluid.
    pub surface: Surface,
}

/// How the surface of a solid meets the fluid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Surface {
    /// As a layer.
    Layer,
    /// Smeared over the grid like all points.
    Plain,
}

const LENGTH: f64 = 1.6;
/// Where the surface is a layer, which needs 16 points.
const LAYER_LENGTH: f64 = 3.2;
/// Of interfaces, of which there are none.
const NODES: usize = 16;
const HEIGHT: f64 = 2.0;
/// With this thickness a lattice is exactly equilateral at spacings 0.2, 0.1, 0.05 and 0.025.
const THICKNESS: f64 = 0.866_025_403_784_438_6;
const VISCOSITY: f64 = 10.0;
const LAYER_SHEAR: f64 = 5.0;

impl Layer {
    /// The relative error of the rate at which the layer, once sheared, relaxes below a fluid of the same viscosity, on
    /// a grid of spacing `h`.
    ///
    /// Under the shear gamma the stress is `eta dgamma/dt + mu gamma` in the layer (Kelvin-Voigt; exact at any shear
    /// for the neo-Hookean material), `eta du/dy` above, and the same everywhere; with both walls at rest, `a dgamma/dt
    /// + (H - a) du/dy = 0`. So gamma decays at the rate `mu/eta (1 - a/H)`.
    ///
    /// # Errors
    /// A grid that does not fit, a step that fails.
    pub fn error(&self, h: f64) -> Result<f64, StudyError> {
        let mesh = self.mesh(h)?;
        match self.material {
            Material::NeoHookean => {
                let material = NeoHookean::new(LAYER_SHEAR, 3.0 * LAYER_SHEAR)?;
                self.relaxation(Solid::hyperelastic(mesh, material), h, 0.3)
            }
            // Springs obey the solution for small shear only.
            Material::Springs => self.relaxation(Solid::springs(mesh, LAYER_SHEAR)?, h, 0.01),
        }
    }

    fn mesh(&self, h: f64) -> Result<TriangleMesh, SolidError> {
        let (bottom, length) = (-0.5 * HEIGHT, self.length());
        let spacing = if self.surface == Surface::Layer { 2.0 * h } else { h };
        let mesh = if self.unstructured {
            let sides = [Outline::flat(0.0, length, bottom)?, Outline::flat(0.0, length, bottom + THICKNESS)?];
            Mesher::new(spacing)?.turned(TURN)?.mesh(&Interior::new(sides)?)?
        } else {
            fitted_strip(Vec2::new(0.0, bottom), [length, THICKNESS], spacing)?
        };
        if self.surface == Surface::Layer { mesh.with_finer_boundary(|s| s.y > bottom + 1e-9) } else { Ok(mesh) }
    }

    fn length(&self) -> f64 {
        if self.surface == Surface::Layer { LAYER_LENGTH } else { LENGTH }
    }

    fn relaxation(&self, solid: Solid, h: f64, shear: f64) -> Result<f64, StudyError> {
        let grid = Grid::channel((self.length() / h).round() as usize, (HEIGHT / h).round() as usize, h)?;
        let solver = ChannelStokes::new(grid, VISCOSITY)?;
        let flow: Box<dyn Hydrodynamics> = if self.surface == Surface::Layer {
            Box::new(ImmersedLayers::new(solver, BSpline::<4>, NODES, 1e-8)?)
        } else {
            Box::new(ImmersedBoundary::new(solver, BSpline::<4>))
        };
        let mut scene = Scene::new(flow);
        let above = |s: Vec2| s.y + 0.5 * HEIGHT;
        let solid = solid.pinned(|s| above(s) < 1e-9)?.deformed(|s| s + Vec2::new(shear * above(s), 0.0))?;
        let handle = scene.add(solid);
        let start = slide(scene.body(handle)?);
        let time = VISCOSITY / LAYER_SHEAR;
        for _ in 0..50 {
            scene.step(time / 50.0)?;
        }
        let rate = -(slide(scene.body(handle)?) / start).ln();
        Ok(rate / (1.0 - THICKNESS / HEIGHT) - 1.0)
    }
}

/// Mean displacement of the upper surface along x (length).
#[must_use]
pub fn slide(solid: &Solid) -> f64 {
    let surface = solid.mesh().boundary_loops().iter().filter(|boundary| boundary.periods == -1);
    let points: Vec<usize> = surface.flat_map(|boundary| boundary.points.iter().copied()).collect();
    let displacements: Vec<Vec2> = solid.displacements().collect();
    points.iter().map(|&point| displacements[point].x).sum::<f64>() / points.len() as f64
}
