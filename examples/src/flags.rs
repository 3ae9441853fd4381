//! Command line flags that scenes share, in groups to be put together with `#[command(flatten)]`.
//!
//! Units are those of the thesis' simulations: lengths in R0, tensions such that gamma0 = 10, times such that D = 0.1;
//! its Appendix A converts them.

use std::path::{Path, PathBuf};

use anyhow::{Result, ensure};
use clap::{Args, ValueEnum};
use motile::{InitialState, Swimmer};

use crate::parse::{activity, finite, not_negative, pair, positive, seed};
use crate::{CheckpointFlags, MethodFlags};

/// Radius of a droplet, the unit of length.
pub(crate) const RADIUS: f64 = 1.0;
/// Longest box or channel (R0).
const LONGEST: f64 = 1000.0;
/// Relative amplitude of the random perturbation.
const PERTURBATION: f64 = 0.05;

/// How the concentration starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Initial {
    /// c = (1 - cos(theta)) c0, thesis (2.46).
    Polarised,
    /// c0 with a small random perturbation.
    Perturbed,
}

/// What drives the flow along a channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Drive {
    /// No net flux.
    ZeroFlux,
    /// No mean pressure gradient, as in the thesis.
    ZeroGradient,
}

impl From<Drive> for motile::stokes_grid::Drive {
    fn from(drive: Drive) -> Self {
        match drive {
            Drive::ZeroFlux => Self::ZeroFlux,
            Drive::ZeroGradient => Self::ZeroGradient,
        }
    }
}

/// The droplet.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct DropletFlags {
    /// Activity zeta delta-mu, negative: contractile
    #[arg(long, default_value_t = -2.0, value_parser = activity, allow_hyphen_values = true)]
    pub activity: f64,
    /// Strength A of the excluded volume tension
    #[arg(long, default_value_t = 10.0, value_parser = not_negative, allow_hyphen_values = true)]
    pub excluded_volume: f64,
    /// Viscosity of the fluids, where they have none of their own
    #[arg(long, default_value_t = 100.0, value_parser = positive, allow_hyphen_values = true)]
    pub viscosity: f64,
    /// Viscosity of the droplet
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    pub viscosity_in: Option<f64>,
    /// Viscosity of its surroundings
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    pub viscosity_out: Option<f64>,
    /// Initial direction of motion (degrees from the x axis)
    #[arg(long, default_value_t = 0.0, value_parser = finite, allow_hyphen_values = true)]
    pub angle: f64,
    /// Initial concentration
    #[arg(long, value_enum, default_value_t = Initial::Polarised)]
    pub initial: Initial,
    /// Seed of the random perturbation
    #[arg(long, default_value_t = 1, value_parser = seed, allow_hyphen_values = true)]
    pub seed: u64,
}

impl DropletFlags {
    /// The droplet of these flags by that method, in a box and at a position that are still to be set.
    #[must_use]
    pub fn swimmer(&self, method: &MethodFlags) -> Swimmer {
        Swimmer {
            activity: self.activity,
            excluded_volume: self.excluded_volume,
            viscosity: self.viscosity_out.unwrap_or(self.viscosity),
            viscosity_inside: self.viscosity_in.or(self.viscosity_out.map(|_| self.viscosity)),
            angle: self.angle.to_radians(),
            initial: match self.initial {
                Initial::Polarised => InitialState::Polarised,
                Initial::Perturbed => InitialState::Perturbed { amplitude: PERTURBATION, seed: self.seed },
            },
            ..method.swimmer()
        }
    }
}

/// A periodic box.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct BoxFlags {
    /// Side of the periodic box (R0)
    #[arg(long = "box", value_name = "SIDE", default_value_t = 6.0, value_parser = positive, allow_hyphen_values = true)]
    pub side: f64,
    /// Initial position of the droplet, from the middle of the box (R0)
    #[arg(long, value_name = "X,Y", default_value = "0,0", value_parser = pair, allow_hyphen_values = true)]
    pub offset: [f64; 2],
}

impl BoxFlags {
    /// Refuses what does not fit together.
    ///
    /// # Errors
    /// A box that the droplet does not fit into, or is unreasonably large; a time step or spacing that does not fit
    /// ([`MethodFlags::check`]).
    pub fn check(&self, method: &MethodFlags) -> Result<()> {
        let side = self.side;
        ensure!(side > 2.0 * RADIUS, "--box {side} is too small for a droplet of diameter 2: give more than 2");
        ensure!(side <= LONGEST, "--box {side} is too large: give at most {LONGEST}");
        method.check(&[(side, "box")])
    }
}

/// A channel with walls in y, periodic in x.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct ChannelFlags {
    /// Distance of the walls (R0)
    #[arg(long, default_value_t = 3.0, value_parser = positive, allow_hyphen_values = true)]
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

impl ChannelFlags {
    /// Refuses what does not fit together.
    ///
    /// # Errors
    /// A droplet that does not fit between the walls or into the period; a time step or spacing that does not fit
    /// ([`MethodFlags::check`]).
    pub fn check(&self, method: &MethodFlags) -> Result<()> {
        let (width, length, offset) = (self.width, self.length, self.lateral_offset);
        ensure!(width >= 2.0 * RADIUS, "--width {width} is too small for a droplet of diameter 2: give at least 2");
        ensure!(length > 2.0 * RADIUS, "--length {length} is too small for a droplet of diameter 2: give more than 2");
        ensure!(width.max(length) <= LONGEST, "a channel of {length} x {width} is too large: give at most {LONGEST}");
        let room = 0.5 * width - RADIUS;
        ensure!(
            offset.abs() <= room,
            "--lateral-offset {offset} puts the droplet into a wall: give at most {room} for --width {width}"
        );
        method.check(&[(length, "length"), (width, "width")])
    }
}

/// What is written where.
#[derive(Debug, Clone, Default, PartialEq, Eq, Args)]
pub struct OutputFlags {
    /// Draw no pictures, plots and animations
    #[arg(long)]
    pub no_pictures: bool,
    /// Show no progress
    #[arg(long)]
    pub quiet: bool,
    /// Directory of the results; without it that of the example in out/
    #[arg(long, value_name = "DIRECTORY")]
    pub out: Option<PathBuf>,
    /// Checkpoints
    #[command(flatten)]
    pub checkpoints: CheckpointFlags,
}

impl OutputFlags {
    /// The directory of the results of example `name`, made if it is not there.
    ///
    /// # Errors
    /// It cannot be made.
    pub fn directory(&self, name: &str) -> Result<PathBuf> {
        let directory = self.out.clone().unwrap_or_else(|| Path::new("out").join(name));
        crate::make_directory(&directory)?;
        Ok(directory)
    }
}
