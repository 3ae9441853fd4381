//! Command line flags of channels with elastic walls.

use anyhow::{Result, bail, ensure};
use clap::{Args, ValueEnum};
use motile::SetupError;
use motile::elastic_solids::Moduli;
use motile::{ChannelShape, MeshKind, Region, Setup, SolidSetup, Surface};

use crate::flags::RADIUS;
use crate::method_flags::FlowMethod;
use crate::parse::{finite, positive};
use crate::{Drive, DropletFlags, MethodFlags, Preset};

/// Spring constant of the thesis' softest walls.
const SOFT: f64 = 1e4;
/// Longest channel (R0).
const LONGEST: f64 = 1000.0;

/// Fewest points along a channel.
const LEAST_ALONG: f64 = 6.0;
/// Most points of the walls: a run with as many would take weeks.
const MOST_POINTS: f64 = 4e6;

/// What the walls are made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Material {
    /// Springs, thesis section 4.1.
    Springs,
    /// Neo-Hookean material, thesis section 4.2.
    NeoHookean,
}

/// How the points of the walls are arranged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Mesh {
    /// Equilateral triangles where the shape allows it.
    Equilateral,
    /// An even mesh that is no lattice.
    Unstructured,
}

/// What is done about the smearing of the walls' surfaces over the grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum SurfaceRule {
    /// The walls are meshed as much further back.
    SetBack,
    /// A mobility correction.
    Corrected,
    /// Nothing.
    Plain,
}

/// A channel with elastic walls, periodic in x.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct ElasticFlags {
    /// What the walls are made of
    #[arg(long, value_enum, default_value_t = Material::Springs)]
    pub material: Material,
    /// Stiffness of the walls as the thesis' spring constant k [default: 1e4]
    #[arg(long, value_parser = positive, allow_hyphen_values = true, conflicts_with = "shear_modulus")]
    pub stiffness: Option<f64>,
    /// Stiffness of the walls as their shear modulus
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    pub shear_modulus: Option<f64>,
    /// Bulk modulus of neo-Hookean walls; without it twice the shear modulus, as of springs
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    pub bulk_modulus: Option<f64>,
    /// How the points of the walls are arranged; without it the preset's
    #[arg(long, value_enum)]
    pub mesh: Option<Mesh>,
    /// Spacing of the points of the walls (R0); without it that of the grid
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    pub mesh_spacing: Option<f64>,
    /// Thickness of each wall (R0)
    #[arg(long, default_value_t = 1.5, value_parser = positive, allow_hyphen_values = true)]
    pub wall_thickness: f64,
    /// What is done about the smearing of the walls' surfaces over the grid; without it the preset's
    #[arg(long, value_enum)]
    pub surface: Option<SurfaceRule>,
    /// Width of the channel (R0); in one narrower than the droplet this starts squeezed
    #[arg(long, default_value_t = 2.0, value_parser = positive, allow_hyphen_values = true)]
    pub width: f64,
    /// Period along the channel (R0)
    #[arg(long, default_value_t = 12.0, value_parser = positive, allow_hyphen_values = true)]
    pub length: f64,
    /// Initial distance of the droplet from the centre line (R0)
    #[arg(long, default_value_t = 0.0, value_parser = finite, allow_hyphen_values = true)]
    pub lateral_offset: f64,
    /// What drives the flow
    #[arg(long, value_enum, default_value_t = Drive::ZeroGradient)]
    pub drive: Drive,
}

impl ElasticFlags {
    /// The scene of a channel of that shape, with the droplet at `x` along it (R0).
    ///
    /// # Errors
    /// Flags that do not fit together: a method without a grid, a bulk modulus of springs, lengths that are no whole
    /// number of cells, a time step that does not fit the run.
    pub fn setup(
        &self,
        shape: &ChannelShape,
        droplet: &DropletFlags,
        method: &MethodFlags,
        x: f64,
        preset: Option<SurfaceRule>,
    ) -> Result<Setup> {
        ensure!(
            method.method != Some(FlowMethod::BoundaryIntegral) && method.nodes.is_none(),
            "elastic walls need a grid: leave --method boundary-integral and --nodes out"
        );
        let method = MethodFlags { method: Some(FlowMethod::ImmersedBoundary), ..method.clone() };
        let (width, length, thickness, offset) = (self.width, self.length, self.wall_thickness, self.lateral_offset);
        let height = width + 2.0 * thickness;
        ensure!(height.max(length) <= LONGEST, "a channel of {length} x {height} is too large: give at most {LONGEST}");
        ensure!(length > 2.0 * RADIUS, "--length {length} is too small for a droplet of diameter 2: give more than 2");
        let mut setup = method.setup(droplet, None)?;
        setup.region = Region::Channel { length, width: height, drive: self.drive.into() };
        setup.droplets[0].centre = [x, offset];
        method.check(&setup, &[(length, "length"), (height, "width plus twice --wall-thickness")])?;
        setup.solids = SolidSetup::walls(shape, &self.material()?);
        for solid in &mut setup.solids {
            if method.preset == Preset::Thesis {
                *solid = solid.clone().thesis();
            }
            solid.mesh = match self.mesh {
                Some(Mesh::Equilateral) => MeshKind::Equilateral,
                Some(Mesh::Unstructured) => MeshKind::Unstructured,
                None => solid.mesh,
            };
            solid.mesh_spacing = self.mesh_spacing;
            solid.surface = match self.surface.or(preset.filter(|_| method.preset == Preset::Accurate)) {
                Some(SurfaceRule::SetBack) => Surface::SetBack,
                Some(SurfaceRule::Corrected) => Surface::Corrected,
                Some(SurfaceRule::Plain) => Surface::Plain,
                None => solid.surface,
            };
        }
        if let Err(SetupError::NoRoom { .. }) = setup.droplet(&setup.droplets[0]) {
            bail!(
                "a channel of --width {width} and --length {length} does not hold the droplet at --lateral-offset {offset}: \
                 give a larger --width or --length or a smaller --lateral-offset"
            );
        }
        self.check_mesh(&setup, method.spacing(&setup))?;
        Ok(setup)
    }

    /// Walls that hold their mesh.
    fn check_mesh(&self, setup: &Setup, grid: f64) -> Result<()> {
        let (length, thickness) = (self.length, self.wall_thickness);
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
            "walls of --wall-thickness {thickness} do not hold points {spacing} apart: give {} or more, or a smaller {flag}",
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

    /// The walls as they stand above a picture.
    ///
    /// # Errors
    /// As [`ElasticFlags::setup`].
    pub fn caption(&self) -> Result<String> {
        let (length, width, material) = (self.length, self.width, self.material()?);
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
