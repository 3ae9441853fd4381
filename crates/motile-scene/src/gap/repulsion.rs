//! A short-range repulsion between surfaces.

use motile_base::{InputError, positive};
use serde::{Deserialize, Serialize};

/// A repulsion between surfaces that come closer than its range. Use it for gaps that are not resolved or that would
/// drain without end. It is off unless you ask for it ([`crate::Scene::with_repulsion`]). It is not part of Cowley's
/// model.
///
/// It acts between different interfaces, between an interface and its own images, solids, and rigid walls of any shape,
/// and has an energy: per length (in three dimensions per area) of an interface at the gap d from another surface
/// ```text
/// phi(d) = strength range^2 (1/x + 2 ln x - x),    x = d/range < 1,      and nothing beyond,
/// ```
/// so that surfaces are pushed apart by the pressure `-phi' = strength range (1/x - 1)^2`, which is `strength range` at
/// half the range, without bound as the gap closes, and continuous with its derivative where it begins. All forces are
/// minus the gradient of this energy by the places of the markers, so that the forces between different bodies have no
/// resultant and no torque together. Rigid walls take up what they are pushed by.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[doc(alias("steric", "contact force", "lubrication"))]
pub struct Repulsion {
    strength: f64,
    range: f64,
}

/// Fraction of the range below which the pressure grows in proportion to the gap: steps that are tried may overlap.
const LEAST: f64 = 0.02;

impl Repulsion {
    /// Creates a repulsion of that strength (force per length squared) and range (length).
    ///
    /// # Errors
    /// Returns an error for values that are not positive and finite.
    pub fn new(strength: f64, range: f64) -> Result<Self, InputError> {
        Ok(Self {
            strength: positive("the strength of the repulsion", strength)?,
            range: positive("the range of the repulsion", range)?,
        })
    }

    /// Creates the repulsion that holds a film of this thickness (length) against this pressure (force per length). Its
    /// range is twice the film. If the range is two distances of neighbouring nodes or more, nodes carry the force and
    /// no film closes. If it is less, the force has waves that they do not carry. It opens films at rates of the order
    /// of the pressure over the viscosity, so that it does not shorten the steps of bodies whose shapes relax as fast.
    ///
    /// ```
    /// use motile_scene::gap::Repulsion;
    ///
    /// assert_eq!(Repulsion::holding(0.1, 200.0)?.pressure(0.1), 200.0);
    /// # Ok::<(), motile_base::InputError>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error for values that are not positive and finite.
    pub fn holding(film: f64, pressure: f64) -> Result<Self, InputError> {
        let (film, pressure) = (positive("the film", film)?, positive("the pressure on the film", pressure)?);
        Self::new(pressure / (2.0 * film), 2.0 * film)
    }

    /// Returns the strength (force per length squared).
    #[must_use]
    pub fn strength(&self) -> f64 {
        self.strength
    }

    /// Returns the range (length).
    #[must_use]
    pub fn range(&self) -> f64 {
        self.range
    }

    /// Returns the energy per length of an interface (force) at a gap (length).
    #[must_use]
    pub fn energy(&self, gap: f64) -> f64 {
        let (x, unit) = (gap / self.range, self.strength * self.range * self.range);
        let inner = |x: f64| unit * (1.0 / x + 2.0 * x.ln() - x);
        if x >= 1.0 {
            return 0.0;
        }
        if x >= LEAST {
            return inner(x);
        }
        let below = LEAST - x;
        let pressure = (1.0 / LEAST - 1.0).powi(2);
        inner(LEAST) + unit * below * (pressure + 0.5 * below * slope(LEAST))
    }

    /// Returns the pressure (force per length) at a gap (length).
    #[must_use]
    pub fn pressure(&self, gap: f64) -> f64 {
        let (x, unit) = (gap / self.range, self.strength * self.range);
        if x >= 1.0 {
            return 0.0;
        }
        let nearest = x.max(LEAST);
        unit * ((1.0 / nearest - 1.0).powi(2) + (nearest - x) * slope(nearest))
    }

    /// Returns the fastest rate (1/time) at which a film of this thickness (length) opens in fluid of viscosity eta. A
    /// pressure between two surfaces at the distance d moves them apart by at most d/(4 eta) of it, which is a film's
    /// with surfaces that slip.
    pub(crate) fn rate(&self, gap: f64, viscosity: f64) -> f64 {
        let x = (gap / self.range).clamp(LEAST, 1.0);
        0.25 * self.strength * self.range * x * slope(x) / viscosity
    }

    /// That rate (1/time) at the gap of 0.7 ranges, where films hold a moderate pressure.
    pub(crate) fn usual_rate(&self, viscosity: f64) -> f64 {
        self.rate(0.7 * self.range, viscosity)
    }
}

/// Minus the derivative of (1/x - 1)^2.
fn slope(x: f64) -> f64 {
    2.0 * (1.0 / x - 1.0) / (x * x)
}

#[cfg(test)]
mod tests;
