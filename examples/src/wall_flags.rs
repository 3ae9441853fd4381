//! Command line flags of channels with elastic walls.

use anyhow::{Result, bail, ensure};
use clap::{Args, ValueEnum};
use motile::SetupError;
use motile::elastic_solids::Moduli;
use motile::{
    ChannelShape, GridMethod, IntegralMethod, MeshKind, Method, MethodKind, Setup, SolidOutline, SolidSetup, Surface,
};

use crate::parse::{nodes, one_of, positive};
use crate::{AlongFlags, MethodFlags, Preset, RegionFlags, SceneFlags};

/// Spring constant of Cowley's softest walls.
const SOFT: f64 = 1e4;
/// Fewest points along a channel.
const LEAST_ALONG: f64 = 6.0;
/// Most points of the walls: a run with as many would take weeks.
const MOST_POINTS: f64 = 4e6;

/// What the walls are made of.
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
/// What is done about the smearing of the walls' surfaces over the grid.
const SURFACES: [(&str, &str, Surface); 3] = [
    ("set-back", "The walls are meshed as much further back", Surface::SetBack),
    ("corrected", "A mobility correction", Surface::Corrected),
    ("plain", "Nothing", Surface::Plain),
];

/// A channel with elastic walls, periodic in x.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct ElasticFlags {
    /// What the walls are made of
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
    /// How the points of the walls are arranged; without it the preset's
    #[arg(long, value_parser = one_of(&MESHES))]
    pub mesh: Option<MeshKind>,
    /// Spacing of the points of the walls (R0); without it that of the grid
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    pub mesh_spacing: Option<f64>,
    /// Droplet and surfaces of the walls as layers, exact in films between them, with so many nodes of the droplet
    /// [72 if no number is given]; only the inside of the walls is on the grid
    #[arg(long, value_parser = nodes, num_args = 0..=1, default_missing_value = "72", value_name = "NODES")]
    pub layers: Option<usize>,
    /// Thickness of each wall (R0)
    #[arg(long, default_value_t = 1.5, value_parser = positive, allow_hyphen_values = true)]
    pub wall_thickness: f64,
    /// What is done about the smearing of the walls' surfaces over the grid; without it the preset's
    #[arg(long, value_parser = one_of(&SURFACES))]
    pub surface: Option<Surface>,
    /// Width of the channel (R0); in one narrower than the droplet this starts squeezed
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
    pub fn setup(&self, shape: &ChannelShape, x: f64, preset: Option<Surface>) -> Result<Setup> {
        let Self { droplet, region: walls, method, .. } = self;
        ensure!(
            method.method != Some(MethodKind::Integral) && method.nodes.is_none(),
            "elastic walls need a grid: leave --method boundary-integral and --nodes out"
        );
        let method = MethodFlags { method: Some(MethodKind::Grid), ..method.clone() };
        let mut setup = method.setup(droplet, None)?;
        if let (Some(nodes), Method::Grid(grid)) = (walls.layers, &mut setup.method) {
            let layers = Some(IntegralMethod { nodes, cells: 4 * nodes });
            *grid = GridMethod { corrected: false, filter: false, layers, ..*grid };
        }
        setup.solids = SolidSetup::walls(shape, &walls.material()?);
        for solid in &mut setup.solids {
            if method.preset == Preset::Thesis {
                *solid = solid.clone().thesis();
            }
            solid.mesh = walls.mesh.unwrap_or(solid.mesh);
            solid.mesh_spacing = walls.mesh_spacing;
            let surface = walls.surface.or(preset.filter(|_| method.preset == Preset::Accurate));
            solid.surface = match surface.unwrap_or(solid.surface) {
                // Islands are meshed as they are.
                Surface::SetBack if matches!(solid.outline, SolidOutline::Island { .. }) => Surface::Plain,
                surface => surface,
            };
        }
        walls.check_mesh(&setup, method.spacing(&setup))?;
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
    fn check_mesh(&self, setup: &Setup, grid: f64) -> Result<()> {
        let (length, thickness) = (self.along.length, self.wall_thickness);
        let spacing = self.mesh_spacing.unwrap_or(grid);
        let flag = if self.mesh_spacing.is_some() { "--mesh-spacing" } else { "--spacing" };
        ensure!(
            LEAST_ALONG * spacing <= length,
            "points {spacing} apart are too few along --length {length}: give {flag} {} or less",
            length / LEAST_ALONG
        );
        let thinnest = spacing + setup.set_back();
        ensure!(
            thickness >= thinnest,
            "walls of --wall-thickness {thickness} do not hold points {spacing} apart: give {} or more, or a smaller \
             {flag}",
            rounded_up(thinnest)
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

    fn material(&self) -> Result<motile::Material> {
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
            Material::Springs => motile::Material::Springs { shear },
            Material::NeoHookean => {
                motile::Material::NeoHookean { shear, bulk: self.bulk_modulus.unwrap_or(2.0 * shear) }
            }
        })
    }
}

impl RegionFlags for ElasticFlags {
    fn caption(&self) -> Result<String> {
        let (length, width, material) = (self.along.length, self.width, self.material()?);
        let name = match material {
            motile::Material::Springs { .. } => "springs",
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
