//! Parameters that are turned while a scene runs.

use motile::base::Region;
use motile::setup::{Distribution, DropletSetup, ExcludedVolume, Setup};

use crate::Refusal;

/// Strongest activity of a slider (force times length).
const MOST_ACTIVITY: f64 = 8.0;
/// Step of a slider whose scale is not logarithmic: values that the answers name are reached.
pub const STEP: f64 = 0.05;

/// Parameter with a slider.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Knob {
    /// Activity of the first droplet (force times length); those of the others keep their ratios to it.
    Activity,
    /// Viscosity of the first droplet over that of the exterior fluid (no dimension); those of the others keep their
    /// ratios to it.
    ViscosityRatio,
    /// Diffusion constant of the first droplet's particles (length squared per time), others in proportion.
    Diffusion,
    /// Side of a box along x, width of a channel, radius of a tube (length).
    Size,
}

impl Knob {
    /// All of them with their names.
    pub const NAMES: [(&str, Self); 4] = [
        ("activity", Self::Activity),
        ("viscosity-ratio", Self::ViscosityRatio),
        ("diffusion", Self::Diffusion),
        ("size", Self::Size),
    ];

    /// Knob of a name.
    ///
    /// # Errors
    /// A name that none has.
    pub fn named(name: &str) -> Result<Self, Refusal> {
        let found = Self::NAMES.iter().find(|(known, _)| *known == name);
        Ok(found.ok_or_else(|| Refusal::plain(format!("there is no parameter {name}")))?.1)
    }

    /// Words for it in a scene.
    #[must_use]
    pub fn label(self, setup: &Setup) -> &'static str {
        match self {
            Self::Activity => "Activity",
            Self::ViscosityRatio => "Viscosity ratio",
            Self::Diffusion => "Diffusion",
            Self::Size if matches!(setup.region, Region::Channel { .. }) => "Channel width",
            Self::Size if matches!(setup.region, Region::Tube { .. }) => "Tube radius",
            Self::Size => "Box",
        }
    }

    /// Least and largest value, and whether the scale is logarithmic.
    #[must_use]
    pub fn range(self, setup: &Setup) -> ([f64; 2], bool) {
        match self {
            Self::Activity => ([-strongest(setup), 0.0], false),
            Self::ViscosityRatio => ([0.1, 10.0], true),
            Self::Diffusion => ([0.02, 1.0], true),
            Self::Size if matches!(setup.region, Region::Channel { .. }) => ([2.2, 10.0], false),
            Self::Size if matches!(setup.region, Region::Tube { .. }) => ([1.2, 4.0], false),
            Self::Size => ([3.0, 20.0], false),
        }
    }

    /// Value in a scene; `None` where it has no such parameter.
    #[must_use]
    pub fn value(self, setup: &Setup) -> Option<f64> {
        let droplet = setup.droplets.first().or(setup.suspension.first().map(|entry| &entry.droplet));
        match self {
            Self::Activity => {
                let of_suspension = setup.suspension.first().and_then(|entry| entry.activity).map(middle);
                droplet?.particles.as_ref()?;
                Some(of_suspension.filter(|_| setup.droplets.is_empty()).unwrap_or(droplet?.activity()))
            }
            Self::ViscosityRatio => {
                let of_suspension = setup.suspension.first().and_then(|entry| entry.viscosity).map(middle);
                let inside = of_suspension.filter(|_| setup.droplets.is_empty()).or(droplet?.viscosity);
                Some(inside.unwrap_or(setup.viscosity) / setup.viscosity)
            }
            Self::Diffusion => Some(droplet?.particles.as_ref()?.diffusion),
            // Walls of their own and droplets at places found for a box would not follow.
            Self::Size => match setup.region {
                _ if !(setup.walls.is_empty() && setup.solids.is_empty() && setup.suspension.is_empty()) => None,
                Region::Box { lengths } => Some(lengths[0]),
                Region::Channel { width, .. } => Some(width),
                Region::Tube { radius, .. } => Some(radius),
                // The plane, space, and regions that the page does not know have no size to turn.
                _ => None,
            },
        }
    }

    /// Description with another value.
    ///
    /// # Errors
    /// A scene without that parameter, and what [`Setup::check`] refuses.
    pub fn turned(self, setup: &Setup, value: f64) -> Result<Setup, Refusal> {
        let missing = || Refusal::plain(format!("the scene has no {}", self.label(setup).to_lowercase()));
        let before = self.value(setup).ok_or_else(missing)?;
        // From zero there are no ratios to keep.
        let factor = if before == 0.0 { None } else { Some(value / before) };
        let scaled = |old| factor.map_or(value, |factor| if old == before { value } else { rounded(old * factor) });
        let mut turned = setup.clone();
        let exterior = setup.viscosity;
        for droplet in &mut turned.droplets {
            self.turn_droplet(droplet, &scaled, exterior);
        }
        for entry in &mut turned.suspension {
            let range = match self {
                Self::Activity => entry.activity.as_mut(),
                Self::ViscosityRatio => entry.viscosity.as_mut(),
                Self::Diffusion | Self::Size => None,
            };
            match (range, factor) {
                (Some(range), Some(factor)) => scale(range, factor),
                (Some(range), None) => *range = Distribution::Value(value),
                (None, _) => self.turn_droplet(&mut entry.droplet, &scaled, exterior),
            }
        }
        if self == Self::Size {
            match &mut turned.region {
                Region::Box { lengths } => {
                    // A box keeps its form to a tenth, so that sides are round numbers.
                    let other = lengths[1] * value / lengths[0];
                    *lengths = [value, (10.0 * other).round() / 10.0];
                }
                Region::Channel { width, .. } => *width = value,
                Region::Tube { radius, .. } => *radius = value,
                _ => {}
            }
        }
        turned.check()?;
        Ok(turned)
    }

    fn turn_droplet(self, droplet: &mut DropletSetup, scaled: &dyn Fn(f64) -> f64, exterior: f64) {
        match (self, &mut droplet.particles) {
            (Self::Activity, Some(particles)) => particles.activity = scaled(particles.activity),
            (Self::Diffusion, Some(particles)) => particles.diffusion = scaled(particles.diffusion),
            (Self::ViscosityRatio, _) => {
                let ratio = scaled(droplet.viscosity.unwrap_or(exterior) / exterior);
                droplet.viscosity = Some(rounded(ratio * exterior)).filter(|inside| *inside != exterior);
            }
            _ => {}
        }
    }
}

/// Strength of the activity up to which the slider goes (force times length): the particles of the first droplet do not
/// collapse there.
fn strongest(setup: &Setup) -> f64 {
    let droplet = setup.droplets.first().or(setup.suspension.first().map(|entry| &entry.droplet));
    match droplet.and_then(|droplet| droplet.particles.as_ref()).map(|particles| particles.excluded_volume) {
        Some(ExcludedVolume::Step(strength)) => MOST_ACTIVITY.min(0.8 * strength),
        _ => MOST_ACTIVITY,
    }
}

/// Value to five digits: people read it in the text of the scene.
fn rounded(value: f64) -> f64 {
    format!("{value:.4e}").parse().unwrap_or(value)
}

/// Middle of a distribution.
fn middle(distribution: Distribution) -> f64 {
    match distribution {
        Distribution::Value(value) => value,
        Distribution::Between([low, high]) => 0.5 * (low + high),
        Distribution::Normal { mean, .. } => mean,
    }
}

fn scale(distribution: &mut Distribution, factor: f64) {
    match distribution {
        Distribution::Value(value) => *value = rounded(*value * factor),
        // The middle is the slider's value.
        Distribution::Between([low, high]) => {
            let whole = (*low + *high) * factor;
            *low = rounded(*low * factor);
            *high = rounded(whole - *low);
        }
        Distribution::Normal { mean, deviation } => {
            *mean = rounded(*mean * factor);
            *deviation = rounded(*deviation * factor.abs());
        }
    }
}
