//! Command line flags of channels with elastic walls.

use anyhow::{Result, ensure};
use clap::{Args, ValueEnum};
use motile::elastic_solids::Moduli;
use motile::{ElasticChannel, Swimmer, WallMaterial, WallMesh, WallSurface};

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
    /// The channel with the droplet at `x` along it (R0).
    ///
    /// # Errors
    /// Flags that do not fit together: a method without a grid, a bulk modulus of springs, lengths that are no whole
    /// number of cells, a time step that does not fit the run.
    pub fn channel(&self, droplet: &DropletFlags, method: &MethodFlags, x: f64) -> Result<ElasticChannel> {
        ensure!(
            method.method != Some(FlowMethod::BoundaryIntegral) && method.nodes.is_none(),
            "elastic walls need a grid: leave --method boundary-integral and --nodes out"
        );
        let method = MethodFlags { method: Some(FlowMethod::ImmersedBoundary), ..method.clone() };
        let (width, length, thickness) = (self.width, self.length, self.wall_thickness);
        let height = width + 2.0 * thickness;
        ensure!(height.max(length) <= LONGEST, "a channel of {length} x {height} is too large: give at most {LONGEST}");
        ensure!(length > 2.0 * RADIUS, "--length {length} is too small for a droplet of diameter 2: give more than 2");
        method.check(&[(length, "length"), (height, "width plus twice --wall-thickness")])?;
        let swimmer =
            Swimmer { lengths: [length, width], offset: [x, self.lateral_offset], ..droplet.swimmer(&method) };
        let moduli = self.moduli()?;
        let channel = match method.preset {
            Preset::Thesis => ElasticChannel::thesis(swimmer, moduli),
            Preset::Accurate => ElasticChannel::new(swimmer, moduli),
        };
        let offset = self.lateral_offset;
        ensure!(
            channel.start_shape().is_some(),
            "a channel of --width {width} and --length {length} does not hold the droplet at --lateral-offset {offset}: give a \
             larger --width or --length or a smaller --lateral-offset"
        );
        let channel = ElasticChannel {
            material: match self.material {
                Material::Springs => WallMaterial::Springs,
                Material::NeoHookean => WallMaterial::NeoHookean,
            },
            mesh: match self.mesh {
                Some(Mesh::Equilateral) => WallMesh::Equilateral,
                Some(Mesh::Unstructured) => WallMesh::Unstructured,
                None => channel.mesh,
            },
            mesh_spacing: self.mesh_spacing,
            thickness,
            surface: match self.surface {
                Some(SurfaceRule::SetBack) => WallSurface::SetBack,
                Some(SurfaceRule::Corrected) => WallSurface::Corrected,
                Some(SurfaceRule::Plain) => WallSurface::Plain,
                None => channel.surface,
            },
            drive: self.drive.into(),
            ..channel
        };
        self.check_mesh(&channel, &method)?;
        Ok(channel)
    }

    /// Walls that hold their mesh.
    fn check_mesh(&self, channel: &ElasticChannel, method: &MethodFlags) -> Result<()> {
        let (length, thickness) = (self.length, self.wall_thickness);
        let spacing = self.mesh_spacing.unwrap_or(method.spacing());
        let flag = if self.mesh_spacing.is_some() { "--mesh-spacing" } else { "--spacing" };
        ensure!(
            LEAST_ALONG * spacing <= length,
            "points {spacing} apart are too few along --length {length}: give {flag} {} or less",
            length / LEAST_ALONG
        );
        let thinnest = spacing + channel.set_back();
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

    fn moduli(&self) -> Result<Moduli> {
        let shear = match self.shear_modulus {
            Some(shear) => shear,
            None => Moduli::from_thesis_spring_constant(self.stiffness.unwrap_or(SOFT))?.shear(),
        };
        ensure!(
            self.bulk_modulus.is_none() || self.material != Material::Springs,
            "springs have twice their shear modulus as bulk modulus: leave --bulk-modulus out or give --material neo-hookean"
        );
        Ok(Moduli::new(shear, self.bulk_modulus.unwrap_or(2.0 * shear))?)
    }
}

/// To four decimals.
fn rounded_up(length: f64) -> f64 {
    (length * 1e4).ceil() / 1e4
}

/// The walls as they stand above a picture.
#[must_use]
pub fn wall_caption(channel: &ElasticChannel) -> String {
    let [length, width] = channel.swimmer.lengths;
    let material = match channel.material {
        WallMaterial::Springs => "springs",
        WallMaterial::NeoHookean => "neo-Hookean",
    };
    // A product such as 3/16 h k need not be written to the last digit.
    let shear = (channel.moduli.shear() * 1e4).round() / 1e4;
    format!("{material},  μ = {shear},  w = {width},  l = {length}")
}

#[cfg(test)]
mod tests;
