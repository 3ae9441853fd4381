//! Command line flags that scenes share, in groups to be put together with `#[command(flatten)]`.
//!
//! Units are those of the thesis' simulations: lengths in R0, tensions such that gamma0 = 10, times such that D = 0.1; its
//! Appendix A converts them.

use std::path::{Path, PathBuf};

use anyhow::{Result, ensure};
use clap::{Args, ValueEnum};
use motile::{InitialState, Swimmer, ib_core::AnyKernel, ib_core::StepSize};

use crate::parse::{TimeStep, activity, finite, kernel, not_negative, pair, positive, seed};

/// Radius of a droplet, the unit of length.
const RADIUS: f64 = 1.0;
/// Most cells of a grid in a direction.
const MOST_CELLS: f64 = 4096.0;
/// Longest box or channel (R0).
const LONGEST: f64 = 1000.0;
/// Automatic time steps, as a fraction of the stability limit.
const STEP_OF_LIMIT: f64 = 0.5;
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

/// Which numerical method.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Preset {
    /// That of the thesis, to reproduce its results.
    Thesis,
    /// The accurate one.
    Accurate,
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
    /// Viscosity of the fluid
    #[arg(long, default_value_t = 100.0, value_parser = positive, allow_hyphen_values = true)]
    pub viscosity: f64,
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
        let base = match method.preset {
            Preset::Thesis => Swimmer::thesis(),
            Preset::Accurate => Swimmer::default(),
        };
        Swimmer {
            activity: self.activity,
            excluded_volume: self.excluded_volume,
            viscosity: self.viscosity,
            spacing: method.spacing,
            kernel: method.kernel.unwrap_or(base.kernel),
            angle: self.angle.to_radians(),
            initial: match self.initial {
                Initial::Polarised => InitialState::Polarised,
                Initial::Perturbed => InitialState::Perturbed { amplitude: PERTURBATION, seed: self.seed },
            },
            step: method.step(),
            ..base
        }
    }
}

/// The numerical method.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct MethodFlags {
    /// Grid spacing h (R0)
    #[arg(long, default_value_t = 0.05, value_parser = positive, allow_hyphen_values = true)]
    pub spacing: f64,
    /// Time step, or 'auto'; without it the preset's
    #[arg(long, allow_hyphen_values = true)]
    pub dt: Option<TimeStep>,
    /// Time to be simulated
    #[arg(long, default_value_t = 60.0, value_parser = positive, allow_hyphen_values = true)]
    pub time: f64,
    /// Regularised delta function (peskin4, roma3, gaussian6, bspline3 to bspline6); without it the preset's
    #[arg(long, value_parser = kernel)]
    pub kernel: Option<AnyKernel>,
    /// Numerical method
    #[arg(long, value_enum, default_value_t = Preset::Accurate)]
    pub preset: Preset,
}

impl MethodFlags {
    /// The time step asked for: by `--dt`, or else the preset's (1e-3 for the thesis').
    #[must_use]
    pub fn step(&self) -> StepSize {
        match (self.dt, self.preset) {
            (Some(TimeStep::Fixed(dt)), _) => StepSize::Fixed(dt),
            (None, Preset::Thesis) => Swimmer::thesis().step,
            (Some(TimeStep::Auto), _) | (None, Preset::Accurate) => StepSize::OfLimit(STEP_OF_LIMIT),
        }
    }

    /// The number of cells over `length` (R0), the value of flag `flag`.
    ///
    /// # Errors
    /// A spacing that does not divide the length, that is too coarse for a droplet (less than four cells a radius), or
    /// that makes for more than 4096 cells.
    pub fn cells(&self, length: f64, flag: &str) -> Result<usize> {
        let h = self.spacing;
        ensure!(h <= 0.25 * RADIUS, "--spacing {h} is too coarse for a droplet of radius 1: give at most 0.25");
        let cells = length / h;
        ensure!(
            cells <= MOST_CELLS,
            "--{flag} {length} at --spacing {h} makes {cells:.0} cells, more than {MOST_CELLS}: give a larger spacing"
        );
        let whole = cells.round();
        let fitting = (whole * h * 1e9).round() / 1e9;
        ensure!(
            (cells - whole).abs() <= 1e-9 * whole,
            "--{flag} {length} is {cells:.3} cells of --spacing {h}: give --{flag} {fitting} or a spacing that divides it"
        );
        Ok(whole as usize)
    }

    fn steps_are_bearable(&self) -> Result<()> {
        if let StepSize::Fixed(dt) = self.step() {
            let (time, steps) = (self.time, self.time / dt);
            ensure!(dt <= time, "--dt {dt} is longer than --time {time}: give a smaller time step");
            ensure!(steps <= 1e9, "--time {time} takes {steps:.1e} steps of --dt {dt}: give a larger time step");
        }
        Ok(())
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
    /// The cells of a side of the box.
    ///
    /// # Errors
    /// A box that the droplet does not fit into, or is unreasonably large; a time step or spacing that does not fit
    /// ([`MethodFlags::cells`]).
    pub fn cells(&self, method: &MethodFlags) -> Result<usize> {
        let side = self.side;
        ensure!(side > 2.0 * RADIUS, "--box {side} is too small for a droplet of diameter 2: give more than 2");
        ensure!(side <= LONGEST, "--box {side} is too large: give at most {LONGEST}");
        method.steps_are_bearable()?;
        method.cells(side, "box")
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
    /// The cells along and across the channel.
    ///
    /// # Errors
    /// A droplet that does not fit between the walls or into the period; a time step or spacing that does not fit
    /// ([`MethodFlags::cells`]).
    pub fn cells(&self, method: &MethodFlags) -> Result<[usize; 2]> {
        let (width, length, offset) = (self.width, self.length, self.lateral_offset);
        ensure!(width >= 2.0 * RADIUS, "--width {width} is too small for a droplet of diameter 2: give at least 2");
        ensure!(length > 2.0 * RADIUS, "--length {length} is too small for a droplet of diameter 2: give more than 2");
        ensure!(width.max(length) <= LONGEST, "a channel of {length} x {width} is too large: give at most {LONGEST}");
        let room = 0.5 * width - RADIUS;
        ensure!(
            offset.abs() <= room,
            "--lateral-offset {offset} puts the droplet into a wall: give at most {room} for --width {width}"
        );
        method.steps_are_bearable()?;
        Ok([method.cells(length, "length")?, method.cells(width, "width")?])
    }
}

/// What is written where.
#[derive(Debug, Clone, PartialEq, Eq, Args)]
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
