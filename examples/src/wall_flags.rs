//! Command line flags of channels with elastic walls.

use anyhow::{Result, bail, ensure};
use clap::{Args, ValueEnum};
use motile::SetupError;
use motile::elastic_solids::ChannelShape;
use motile::elastic_solids::Moduli;
use motile::setup::{
    Axis, Grading, LayersMethod, MeshKind, Method, MethodKind, Setup, SolidSetup, SurfaceElasticitySetup,
};

use crate::parse::{one_of, pair, positive};
use crate::{AlongFlags, Preset, RegionFlags, SceneFlags};

/// Spring constant of Cowley's softest walls.
const SOFT: f64 = 1e4;
/// Fewest points along a channel.
const LEAST_ALONG: f64 = 6.0;
/// Most points of the walls: a run with as many would take weeks.
const MOST_POINTS: f64 = 4e6;

/// Materials of the walls.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Material {
    /// Springs, Cowley section 4.1.
    Springs,
    /// Neo-Hookean material, Cowley section 4.2.
    NeoHookean,
}

/// How the points of the walls are arranged.
const MESHES: [(&str, &str, MeshKind); 2] = [
    ("equilateral", "Equilateral triangles where the shape allows it", MeshKind::Equilateral),
    ("unstructured", "An even mesh that is no lattice", MeshKind::Unstructured),
];

/// A channel with elastic walls, periodic in x.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct ElasticFlags {
    /// Material of the walls
    #[arg(long, value_enum, default_value_t = Material::Springs)]
    pub material: Material,
    /// Stiffness of the walls as Cowley's spring constant k [default: 1e4]
    #[arg(long, value_parser = positive, allow_hyphen_values = true, conflicts_with = "shear_modulus")]
    pub stiffness: Option<f64>,
    /// Stiffness of the walls as their shear modulus
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    pub shear_modulus: Option<f64>,
    /// Bulk modulus of neo-Hookean walls; without it twice the shear modulus, as of springs
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    pub bulk_modulus: Option<f64>,
    /// Stiffness of the upper wall, as the flag of the lower one says it; without it that of the lower wall
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    pub upper_stiffness: Option<f64>,
    /// Factor by which the walls are stiffer at the end of the period than at its start, linear between
    #[arg(long, value_name = "FACTOR", value_parser = positive, allow_hyphen_values = true)]
    pub stiffness_gradient: Option<f64>,
    /// How the points of the walls are arranged; without it the preset's
    #[arg(long, value_parser = one_of(&MESHES))]
    pub mesh: Option<MeshKind>,
    /// Spacing of the points of the walls (R0); without it twice that of the grid, and that of the grid with --method
    /// grid
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    pub mesh_spacing: Option<f64>,
    /// Thickness of each wall (R0)
    #[arg(long, default_value_t = 1.5, value_parser = positive, allow_hyphen_values = true)]
    pub wall_thickness: f64,
    /// Moduli of stretching (force) and bending (force times R0^2) that resist deformation of the surfaces of the
    /// walls; without them, only the walls' material does
    #[arg(long, value_name = "STRETCHING,BENDING", value_parser = pair, allow_hyphen_values = true)]
    pub surface_elasticity: Option<[f64; 2]>,
    /// Width of the channel (R0); one narrower than the droplet needs --squeezed
    #[arg(long, default_value_t = 2.0, value_parser = positive, allow_hyphen_values = true)]
    pub width: f64,
    /// The period
    #[command(flatten)]
    pub along: AlongFlags,
}

impl SceneFlags<ElasticFlags> {
    /// The scene of a channel of that shape, with the droplet at `x` along it (R0).
    ///
    /// # Errors
    /// Flags that do not fit together: a method without a grid, a bulk modulus of springs, a time step longer
    /// than the run.
    pub fn setup(&self, shape: &ChannelShape, x: f64) -> Result<Setup> {
        let Self { droplet, region: walls, method, .. } = self;
        ensure!(method.method != Some(MethodKind::Integral), "elastic walls need a grid: leave --method integral out");
        let layers = Setup { method: Method::Layers(LayersMethod::default()), ..Setup::default() };
        let mut setup = method.setup(droplet, (method.preset == Preset::Accurate).then_some(layers))?;
        if let Method::Grid(grid) = &mut setup.method {
            grid.corrected = false;
        }
        setup.solids = SolidSetup::walls(shape, &walls.material()?);
        if let Some(upper) = walls.upper_stiffness {
            let given = walls.shear_modulus.or(walls.stiffness).unwrap_or(SOFT);
            setup.solids[1].grading = Grading::uniform(upper / given);
        }
        for solid in &mut setup.solids {
            if let Some(factor) = walls.stiffness_gradient {
                let end = 0.5 * walls.along.length;
                let along = Grading::Along { axis: Axis::X, factors: vec![[-end, 1.0], [end, factor]] };
                solid.grading = std::mem::take(&mut solid.grading).times(along);
            }
            if method.preset == Preset::Thesis {
                *solid = solid.clone().thesis();
            }
            solid.mesh = walls.mesh.unwrap_or(solid.mesh);
            solid.mesh_spacing = walls.mesh_spacing;
            solid.surface_elasticity =
                walls.surface_elasticity.map(|[stretching, bending]| SurfaceElasticitySetup { stretching, bending });
        }
        let times = if setup.method.kind() == MethodKind::Grid { 1.0 } else { 2.0 };
        walls.check_mesh(times * method.spacing(&setup))?;
        walls.along.apply(&mut setup, x, walls.width + 2.0 * walls.wall_thickness)?;
        if let Err(SetupError::NoRoom { .. }) = setup.droplet(&setup.droplets[0]) {
            let AlongFlags { length, lateral_offset, .. } = walls.along;
            bail!(
                "a channel of --width {} and --length {length} does not hold the droplet at --lateral-offset \
                 {lateral_offset}: give a larger --width or --length or a smaller --lateral-offset",
                walls.width
            );
        }
        Ok(setup)
    }
}

impl ElasticFlags {
    /// Walls that hold their mesh.
    fn check_mesh(&self, usual: f64) -> Result<()> {
        let (length, thickness) = (self.along.length, self.wall_thickness);
        let spacing = self.mesh_spacing.unwrap_or(usual);
        let flag = if self.mesh_spacing.is_some() { "--mesh-spacing" } else { "--spacing" };
        ensure!(
            LEAST_ALONG * spacing <= length,
            "points {spacing} apart are too few along --length {length}: give {flag} {} or less",
            length / LEAST_ALONG
        );
        ensure!(
            thickness >= spacing,
            "walls of --wall-thickness {thickness} do not hold points {spacing} apart: give {} or more, or a smaller \
             {flag}",
            rounded_up(spacing)
        );
        // Two walls, which between them may fill the channel.
        let finest = (length * (self.width + 2.0 * thickness) / MOST_POINTS).sqrt();
        ensure!(
            spacing >= finest,
            "points {spacing} apart are too many for walls of --length {length}: give {flag} {} or more",
            rounded_up(finest)
        );
        Ok(())
    }

    fn material(&self) -> Result<motile::setup::Material> {
        let shear = match self.shear_modulus {
            Some(shear) => shear,
            None => Moduli::from_thesis_spring_constant(self.stiffness.unwrap_or(SOFT))?.shear(),
        };
        ensure!(
            self.bulk_modulus.is_none() || self.material != Material::Springs,
            "springs have twice their shear modulus as bulk modulus: leave --bulk-modulus out or give --material \
             neo-hookean"
        );
        Ok(match self.material {
            Material::Springs => motile::setup::Material::Springs { shear },
            Material::NeoHookean => {
                motile::setup::Material::NeoHookean { shear, bulk: self.bulk_modulus.unwrap_or(2.0 * shear) }
            }
        })
    }
}

impl RegionFlags for ElasticFlags {
    fn caption(&self) -> Result<String> {
        let (length, width, material) = (self.along.length, self.width, self.material()?);
        let name = match material {
            motile::setup::Material::Springs { .. } => "springs",
            _ => "neo-Hookean",
        };
        // A product such as 3/16 h k need not be written to the last digit.
        let shear = (material.shear() * 1e4).round() / 1e4;
        Ok(format!("{name},  μ = {shear},  w = {width},  l = {length}"))
    }
}

/// To four decimals.
fn rounded_up(length: f64) -> f64 {
    (length * 1e4).ceil() / 1e4
}

#[cfg(test)]
mod tests;
