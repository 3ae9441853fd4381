//! Channels of the thesis and of its outlook.

use std::f64::consts::{PI, TAU};

use ib_core::Vec2;
use ib_core::input::{InputError, finite, positive, within};

use crate::{Channel, Outline, SolidError};

/// A straight channel. All channels here are centred on the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StraightChannel {
    /// Period in x (length).
    pub period: f64,
    /// Distance between the sides (length).
    pub width: f64,
}

/// A channel with a narrow passage, joined by cosine ramps (thesis figure 4.18).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constriction {
    /// Period in x (length).
    pub period: f64,
    /// Width of the main channel (length).
    pub width: f64,
    /// Width of the passage (length).
    pub throat: f64,
    /// Length of the passage (length).
    pub throat_length: f64,
    /// Length of each ramp (length).
    pub ramp: f64,
    /// Middle of the passage in x (length).
    pub centre: f64,
}

/// A channel with two triangular teeth that almost meet (thesis figure 5.1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Valve {
    /// Period in x (length).
    pub period: f64,
    /// Width of the channel (length).
    pub width: f64,
    /// Gap between the tips of the teeth (length), as of sharp tips.
    pub gap: f64,
    /// Width of the base of a tooth (length).
    pub base: f64,
    /// Radius by which the tips and feet are rounded (length); 0 for sharp ones.
    pub radius: f64,
    /// Tips in x (length).
    pub centre: f64,
}

/// A channel of asymmetric teeth (thesis figure 5.2).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ratchet {
    /// Period of the whole in x (length).
    pub period: f64,
    /// Width between the teeth (length).
    pub width: f64,
    /// Width at the tips (length).
    pub throat: f64,
    /// Number of teeth in a period.
    pub teeth: usize,
    /// Part of a tooth over which the channel narrows, going to larger x (0 to 1, both excluded); 1/2 is symmetric.
    pub rise: f64,
    /// Straight flanks with sharp edges instead of cosine ramps.
    pub sharp: bool,
}

/// A channel with sinusoidal sides `-w/2 - a cos(k x)` and `w/2 + a cos(k x + phase)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SinusoidalChannel {
    /// Period in x (length).
    pub period: f64,
    /// Mean width w (length).
    pub width: f64,
    /// Amplitude a of each side (length).
    pub amplitude: f64,
    /// Number of waves in a period.
    pub waves: usize,
    /// Phase of the upper side against the lower one (radians): 0 for a channel that narrows and widens, pi for one of
    /// constant width that winds.
    pub phase: f64,
}

/// A channel that parts in two around an island and joins again.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BranchingChannel {
    /// Period in x (length).
    pub period: f64,
    /// Width of the undivided channel (length).
    pub width: f64,
    /// Widths of the lower and the upper branch beside the middle of the island (length).
    pub branches: [f64; 2],
    /// Length of the island (length).
    pub island_length: f64,
    /// Thickness of the island (length).
    pub island_thickness: f64,
    /// Length over which each side moves out (length), ending beside the tip of the island.
    pub ramp: f64,
}

impl StraightChannel {
    /// The channel.
    ///
    /// # Errors
    /// Lengths that are not positive.
    pub fn channel(&self) -> Result<Channel, SolidError> {
        positive("the width of the channel", self.width)?;
        Channel::symmetric(Outline::flat(-0.5 * self.period, self.period, -0.5 * self.width)?)
    }
}

impl Constriction {
    /// That of thesis figure 4.18 in units of the droplet's radius: period 12, width 2, throat 1 over a length of 4,
    /// ramps of 1.
    #[must_use]
    pub fn thesis() -> Self {
        Self { period: 12.0, width: 2.0, throat: 1.0, throat_length: 4.0, ramp: 1.0, centre: 0.0 }
    }

    /// The channel: half its width is w/2 outside, t/2 in the passage, and between them
    /// `t/2 + (w - t)/4 (1 - cos(pi s/r))` at the distance s from the passage's end.
    ///
    /// # Errors
    /// Lengths that are not positive, or more than the period together.
    pub fn channel(&self) -> Result<Channel, SolidError> {
        let Self { period, width, throat, throat_length, ramp, centre } = *self;
        positive("the width of the channel", width)?;
        positive("the width of the throat", throat)?;
        positive("the length of the throat", throat_length)?;
        positive("the length of a ramp", ramp)?;
        finite("the centre of the throat", centre)?;
        fits("the length of the throat and its ramps", throat_length + 2.0 * ramp, period)?;
        let half_width = move |x: f64| {
            let distance = from_nearest(x - centre, period).abs() - 0.5 * throat_length;
            0.5 * throat + 0.5 * (width - throat) * cosine_step(distance / ramp)
        };
        Channel::symmetric(Outline::profile(-0.5 * period, period, move |x| -half_width(x))?)
    }
}

impl Valve {
    /// The channel.
    ///
    /// # Errors
    /// Lengths that are not positive, a gap not below the width, a base longer than the period, a radius too large for
    /// the teeth.
    pub fn channel(&self) -> Result<Channel, SolidError> {
        let Self { period, width, gap, base, radius, centre } = *self;
        positive("the width of the channel", width)?;
        positive("the gap of the valve", gap)?;
        positive("the base of a tooth", base)?;
        positive("the width beside the gap", width - gap)?;
        finite("the radius of the tips", radius)?;
        finite("the centre of the valve", centre)?;
        fits("the base of a tooth", base, period)?;
        let point = |x: f64, width: f64| Vec2::new(centre + x, -0.5 * width);
        let mut corners = vec![point(-0.5 * base, width), point(0.0, gap), point(0.5 * base, width)];
        if base == period {
            corners.pop();
        }
        let line = Outline::polyline(&corners, period)?;
        Channel::symmetric(if radius == 0.0 { line } else { line.filleted(radius)? })
    }
}

impl Ratchet {
    /// The channel.
    ///
    /// # Errors
    /// Lengths that are not positive, a throat not below the width, no teeth or more than 200, a rise not between 0 and 1.
    pub fn channel(&self) -> Result<Channel, SolidError> {
        let Self { period, width, throat, teeth, rise, sharp } = *self;
        positive("the width of the channel", width)?;
        positive("the width of the throat", throat)?;
        positive("the width beside the throat", width - throat)?;
        positive("the period", period)?;
        within("the number of teeth", teeth as f64, 1.0, MOST_WAVES)?;
        within("the rising part of a tooth", rise, f64::EPSILON, 1.0 - f64::EPSILON)?;
        let (start, tooth) = (-0.5 * period, period / teeth as f64);
        let feet = (0..teeth).map(|k| start + tooth * k as f64);
        if sharp {
            let corners: Vec<Vec2> =
                feet.flat_map(|x| [Vec2::new(x, -0.5 * width), Vec2::new(x + rise * tooth, -0.5 * throat)]).collect();
            return Channel::symmetric(Outline::polyline(&corners, period)?);
        }
        let lower = move |x: f64| {
            let part = ((x - start) / tooth).rem_euclid(1.0);
            let height = if part < rise { part / rise } else { (1.0 - part) / (1.0 - rise) };
            -0.5 * width + 0.5 * (width - throat) * cosine_step(height)
        };
        Channel::symmetric(Outline::profile(start, period, lower)?)
    }
}

impl SinusoidalChannel {
    /// The channel.
    ///
    /// # Errors
    /// Lengths that are not positive, no wave or more than 200, an amplitude or phase that is not finite, sides that touch.
    pub fn channel(&self) -> Result<Channel, SolidError> {
        let Self { period, width, amplitude, waves, phase } = *self;
        positive("the period", period)?;
        positive("the mean width of the channel", width)?;
        finite("the amplitude of the sides", amplitude)?;
        finite("the phase of the upper side", phase)?;
        within("the number of waves", waves as f64, 1.0, MOST_WAVES)?;
        let number = TAU * waves as f64 / period;
        Channel::between(
            -0.5 * period,
            period,
            move |x| -0.5 * width - amplitude * (number * x).cos(),
            move |x| 0.5 * width + amplitude * (number * x + phase).cos(),
        )
    }
}

impl BranchingChannel {
    /// The channel. The island's outline is `x = l/2 sin(t)`, `y = d/2 cos(t) sqrt(1 + sin(t)^2)`: blunt tips, and flat
    /// beside the middle.
    ///
    /// # Errors
    /// Lengths that are not positive, or more than the period together, sides that touch.
    pub fn channel(&self) -> Result<Channel, SolidError> {
        let Self { period, width, branches: [below, above], island_length, island_thickness, ramp } = *self;
        positive("the width of the channel", width)?;
        positive("the width of the lower branch", below)?;
        positive("the width of the upper branch", above)?;
        positive("the length of the island", island_length)?;
        positive("the thickness of the island", island_thickness)?;
        positive("the length of a ramp", ramp)?;
        fits("the length of the island and the ramps", island_length + 2.0 * ramp, period)?;
        let side = move |x: f64, branch: f64| {
            let distance = from_nearest(x, period).abs() - 0.5 * island_length;
            let beside = 0.5 * island_thickness + branch;
            beside + (0.5 * width - beside) * cosine_step(distance / ramp)
        };
        let island = Outline::closed(move |t| {
            let (sine, cosine) = (TAU * t).sin_cos();
            0.5 * Vec2::new(island_length * sine, island_thickness * cosine * (1.0 + sine * sine).sqrt())
        })?;
        let start = -0.5 * period;
        Channel::with_islands(
            Outline::profile(start, period, move |x| -side(x, below))?,
            Outline::profile(start, period, move |x| side(x, above))?,
            vec![island],
        )
    }
}

/// Most waves or teeth in a period.
const MOST_WAVES: f64 = 200.0;

/// From 0 for s <= 0 to 1 for s >= 1 along a cosine.
fn cosine_step(s: f64) -> f64 {
    0.5 - 0.5 * (PI * s.clamp(0.0, 1.0)).cos()
}

/// x from the nearest multiple of the period.
fn from_nearest(x: f64, period: f64) -> f64 {
    x - period * (x / period).round()
}

/// Lengths that must fit into the period.
fn fits(name: &'static str, length: f64, period: f64) -> Result<(), InputError> {
    within(name, length, 0.0, positive("the period", period)?).map(drop)
}

#[cfg(test)]
mod tests;
