//! Shapes of channels, including the channels of Cowley (chapters 4 and 5).

use std::f64::consts::{PI, TAU};

use motile_base::{InputError, Vec2, finite, positive, within};
use serde::{Deserialize, Serialize};

use crate::{Channel, Outline, SolidError};

/// Shapes of channels between two walls, centred on the origin, periodic in x.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", rename_all_fields = "kebab-case")]
#[non_exhaustive]
pub enum ChannelShape {
    /// A channel between two straight walls.
    Straight {
        /// Distance between the sides (length).
        width: f64,
    },
    /// A channel with a narrow passage, joined by cosine ramps (Cowley figure 4.18): half the width is w/2 outside, t/2
    /// in the passage, and between them `t/2 + (w - t)/4 (1 - cos(pi s/r))` at the distance s from the passage's end.
    /// Set `exit_ramp` if the ramp at larger x has another length (Cowley 5.2.2.5.2, the angles of approach and exit).
    Constriction {
        /// Width w of the main channel (length).
        width: f64,
        /// Width t of the passage (length).
        throat: f64,
        /// Length of the passage (length).
        throat_length: f64,
        /// Length r of each ramp (length), or of the ramp at smaller x if `exit_ramp` is given.
        ramp: f64,
        /// Length of the ramp at larger x (length); as the other in a file that gives none.
        #[serde(default)]
        exit_ramp: Option<f64>,
        /// Middle of the passage in x (length); 0 in a file that gives none.
        #[serde(default)]
        centre: f64,
    },
    /// A channel with two triangular teeth that almost meet (Cowley figure 5.1).
    Valve {
        /// Width of the channel (length).
        width: f64,
        /// Gap between the tips of the teeth (length), as of sharp tips.
        gap: f64,
        /// Width of the base of a tooth (length).
        base: f64,
        /// Radius by which the tips and feet are rounded (length); 0 for sharp ones, as in a file that gives none.
        #[serde(default)]
        rounding: f64,
        /// Tips in x (length); 0 in a file that gives none.
        #[serde(default)]
        centre: f64,
    },
    /// A channel of asymmetric teeth (Cowley figure 5.2).
    Ratchet {
        /// Width between the teeth (length).
        width: f64,
        /// Width at the tips (length).
        throat: f64,
        /// Number of teeth in a period, at most 200.
        teeth: usize,
        /// Fraction of a tooth over which the channel narrows, going to larger x (0 to 1, both excluded); 1/2 is
        /// symmetric.
        rise: f64,
        /// Straight flanks with sharp edges instead of cosine ramps, as in a file only where it says so.
        #[serde(default)]
        sharp: bool,
    },
    /// A channel with sinusoidal sides `-w/2 - a cos(k x)` and `w/2 + a cos(k x + phase)`.
    Sinusoidal {
        /// Mean width w (length).
        width: f64,
        /// Amplitude a of each side (length).
        amplitude: f64,
        /// Number of waves in a period, at most 200.
        waves: usize,
        /// Phase of the upper side against the lower one (radians): 0 for a channel that narrows and widens, pi for one
        /// of constant width that winds. 0 in a file that gives none.
        #[serde(default)]
        phase: f64,
    },
    /// A channel that splits in two around an island and joins again. The island's outline is `x = l/2 sin(t)`, `y =
    /// d/2 cos(t) sqrt(1 + sin(t)^2)`: blunt tips, and flat around the middle.
    Branching {
        /// Width of the undivided channel (length).
        width: f64,
        /// Widths of the lower and the upper branch at the middle of the island (length).
        branches: [f64; 2],
        /// Length l of the island (length).
        island_length: f64,
        /// Thickness d of the island (length).
        island_thickness: f64,
        /// Length over which each side moves out (length), ending at the tip of the island.
        ramp: f64,
    },
}

/// Most waves or teeth in a period: ten samples of a side, of [`Channel::with_islands`], for each.
const MOST_WAVES: f64 = 200.0;

impl ChannelShape {
    /// Constriction of Cowley figure 4.18, in units of the droplet's radius and for a period of 12: width 2, throat 1
    /// over a length of 4, ramps of 1.
    pub const THESIS: Self =
        Self::Constriction { width: 2.0, throat: 1.0, throat_length: 4.0, ramp: 1.0, exit_ramp: None, centre: 0.0 };

    /// Returns the name of the shape, as it stands in a file.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Straight { .. } => "straight",
            Self::Constriction { .. } => "constriction",
            Self::Valve { .. } => "valve",
            Self::Ratchet { .. } => "ratchet",
            Self::Sinusoidal { .. } => "sinusoidal",
            Self::Branching { .. } => "branching",
        }
    }

    /// Returns the width of the undivided channel between its narrow parts (length).
    #[must_use]
    pub fn width(&self) -> f64 {
        match *self {
            Self::Straight { width }
            | Self::Constriction { width, .. }
            | Self::Valve { width, .. }
            | Self::Ratchet { width, .. }
            | Self::Sinusoidal { width, .. }
            | Self::Branching { width, .. } => width,
        }
    }

    /// Returns the number of islands.
    #[must_use]
    pub fn islands(&self) -> usize {
        usize::from(matches!(self, Self::Branching { .. }))
    }

    /// Returns the channel of this shape and period in x (length).
    ///
    /// # Errors
    /// Returns an error for:
    /// * lengths that are not positive, or more than the period together,
    /// * a gap or throat not below the width,
    /// * no waves or teeth or more than 200, a rise not between 0 and 1, a radius too large for the teeth,
    /// * sides that touch.
    pub fn channel(&self, period: f64) -> Result<Channel, SolidError> {
        positive("the period", period)?;
        positive("the width of the channel", self.width())?;
        let start = -0.5 * period;
        match *self {
            Self::Straight { width } => Channel::symmetric(Outline::flat(start, period, -0.5 * width)?),
            Self::Constriction { width, throat, throat_length, ramp, exit_ramp, centre } => {
                positive("the width of the throat", throat)?;
                positive("the length of the throat", throat_length)?;
                positive("the length of a ramp", ramp)?;
                let exit_ramp = positive("the length of the exit ramp", exit_ramp.unwrap_or(ramp))?;
                finite("the centre of the throat", centre)?;
                fits("the length of the throat and its ramps", throat_length + ramp + exit_ramp, period)?;
                // The middle of passage and ramps is in the middle of the period, so each ramp lies in one piece in it.
                let middle = centre + 0.5 * (exit_ramp - ramp);
                let half_width = move |x: f64| {
                    let place = from_nearest(x - middle, period) + middle - centre;
                    let here = if place < 0.0 { ramp } else { exit_ramp };
                    0.5 * throat + 0.5 * (width - throat) * cosine_step((place.abs() - 0.5 * throat_length) / here)
                };
                Channel::symmetric(Outline::profile(start, period, move |x| -half_width(x))?)
            }
            Self::Valve { width, gap, base, rounding, centre } => {
                positive("the gap of the valve", gap)?;
                positive("the base of a tooth", base)?;
                positive("the width beside the gap", width - gap)?;
                finite("the rounding of the tips", rounding)?;
                finite("the centre of the valve", centre)?;
                fits("the base of a tooth", base, period)?;
                let point = |x: f64, width: f64| Vec2::new(centre + x, -0.5 * width);
                let mut corners = vec![point(-0.5 * base, width), point(0.0, gap), point(0.5 * base, width)];
                if base == period {
                    corners.pop();
                }
                let line = Outline::polyline(&corners, period)?;
                Channel::symmetric(if rounding == 0.0 { line } else { line.rounded(rounding)? })
            }
            Self::Ratchet { width, throat, teeth, rise, sharp } => {
                positive("the width of the throat", throat)?;
                positive("the width beside the throat", width - throat)?;
                within("the number of teeth", teeth as f64, 1.0, MOST_WAVES)?;
                within("the rising part of a tooth", rise, f64::EPSILON, 1.0 - f64::EPSILON)?;
                let tooth = period / teeth as f64;
                if sharp {
                    let feet = (0..teeth).map(|k| start + tooth * k as f64);
                    let corners = feet
                        .flat_map(|x| [Vec2::new(x, -0.5 * width), Vec2::new(x + rise * tooth, -0.5 * throat)])
                        .collect::<Vec<_>>();
                    return Channel::symmetric(Outline::polyline(&corners, period)?);
                }
                let lower = move |x: f64| {
                    let part = ((x - start) / tooth).rem_euclid(1.0);
                    let height = if part < rise { part / rise } else { (1.0 - part) / (1.0 - rise) };
                    -0.5 * width + 0.5 * (width - throat) * cosine_step(height)
                };
                Channel::symmetric(Outline::profile(start, period, lower)?)
            }
            Self::Sinusoidal { width, amplitude, waves, phase } => {
                finite("the amplitude of the sides", amplitude)?;
                finite("the phase of the upper side", phase)?;
                within("the number of waves", waves as f64, 1.0, MOST_WAVES)?;
                let number = TAU * waves as f64 / period;
                let lower = move |x: f64| -0.5 * width - amplitude * (number * x).cos();
                let upper = move |x: f64| 0.5 * width + amplitude * (number * x + phase).cos();
                Channel::between(start, period, lower, upper)
            }
            Self::Branching { width, branches: [below, above], island_length, island_thickness, ramp } => {
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
                let lower = Outline::profile(start, period, move |x| -side(x, below))?;
                Channel::with_islands(lower, Outline::profile(start, period, move |x| side(x, above))?, vec![island])
            }
        }
    }
}

/// Returns the step from 0 for s <= 0 to 1 for s >= 1 along a cosine.
fn cosine_step(s: f64) -> f64 {
    0.5 - 0.5 * (PI * s.clamp(0.0, 1.0)).cos()
}

/// Returns the distance of x from the nearest multiple of the period, with its sign.
fn from_nearest(x: f64, period: f64) -> f64 {
    x - period * (x / period).round()
}

/// Checks that a length fits into the period.
fn fits(name: &'static str, length: f64, period: f64) -> Result<f64, InputError> {
    within(name, length, 0.0, period)
}

#[cfg(test)]
mod tests;
