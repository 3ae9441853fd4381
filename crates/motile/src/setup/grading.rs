//! Moduli as a function of place.

use motile_base::Vec2;
use serde::{Deserialize, Serialize};

use super::checked::Checked;
use crate::SetupError;

/// A quantity as a function of the reference position: a factor on all moduli of a material, on relaxation times, or on
/// the tension of active springs.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Grading {
    /// No grading: the moduli of the material everywhere.
    #[default]
    Uniform,
    /// A factor that is piecewise linear along an axis and constant beyond its first and last place.
    Along {
        /// The axis.
        axis: Axis,
        /// Places (length, increasing), each with the factor there (no dimension, positive).
        factors: Vec<[f64; 2]>,
    },
    /// A step across an axis.
    Step {
        /// The axis.
        axis: Axis,
        /// Place of the step (length).
        at: f64,
        /// Factors below and above it (no dimension, positive).
        factors: [f64; 2],
    },
    /// Stripes across an axis, each as wide as the others; their factors repeat themselves in order.
    Stripes {
        /// The axis.
        axis: Axis,
        /// Width of a stripe (length).
        width: f64,
        /// Place where the first stripe begins (length).
        #[serde(default)]
        from: f64,
        /// Factors of the stripes (no dimension, positive).
        factors: Vec<f64>,
    },
    /// A product of several, such as one along and one across a wall.
    Product(Vec<Self>),
}

/// An axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Axis {
    /// Along the channel.
    X,
    /// Across it.
    Y,
}

/// Fraction of a stripe by which a period may miss a whole number of them.
const WHOLE: f64 = 1e-6;

impl Grading {
    /// Creates a grading with one factor everywhere (no dimension, positive).
    #[must_use]
    pub fn uniform(factor: f64) -> Self {
        Self::Along { axis: Axis::X, factors: vec![[0.0, factor]] }
    }

    /// Returns true for no grading.
    #[must_use]
    pub fn is_uniform(&self) -> bool {
        *self == Self::Uniform
    }

    /// Returns the product of this grading and another one.
    #[must_use]
    pub fn times(self, other: Self) -> Self {
        match (self, other) {
            (Self::Uniform, one) | (one, Self::Uniform) => one,
            (Self::Product(mut parts), one) => {
                parts.push(one);
                Self::Product(parts)
            }
            (one, other) => Self::Product(vec![one, other]),
        }
    }

    /// Returns the factor on the moduli at a reference position (length); no dimension.
    #[must_use]
    pub fn factor(&self, place: Vec2) -> f64 {
        let on = |axis: &Axis| if *axis == Axis::X { place.x } else { place.y };
        match self {
            Self::Uniform => 1.0,
            Self::Along { axis, factors } => {
                let at = on(axis);
                let above = factors.partition_point(|[x, _]| *x <= at);
                match (above.checked_sub(1).map(|below| factors[below]), factors.get(above)) {
                    (Some([x0, f0]), Some(&[x1, f1])) => f0 + (f1 - f0) * (at - x0) / (x1 - x0),
                    (Some([_, factor]), None) | (None, Some(&[_, factor])) => factor,
                    (None, None) => 1.0,
                }
            }
            Self::Step { axis, at, factors } => factors[usize::from(on(axis) >= *at)],
            Self::Stripes { axis, width, from, factors } => {
                let number = ((on(axis) - from) / width).floor().rem_euclid(factors.len() as f64);
                factors.get(number as usize).copied().unwrap_or(1.0)
            }
            Self::Product(parts) => parts.iter().map(|part| part.factor(place)).product(),
        }
    }

    /// Refuses factors and places that make no sense, of a solid that repeats itself after `period` along x (length).
    pub(super) fn check(&self, key: &str, checked: &Checked<'_>, period: Option<f64>) -> Result<(), SetupError> {
        match self {
            Self::Uniform => Ok(()),
            Self::Along { factors, .. } => {
                let key = format!("{key}.along.factors");
                factors.iter().try_for_each(|[place, factor]| {
                    checked.finite(&key, *place)?;
                    checked.positive(&key, *factor)
                })?;
                let mixed = factors.is_empty() || !factors.windows(2).all(|pair| pair[0][0] < pair[1][0]);
                let remedy = "a grading needs at least one place with its factor. List the places in increasing order";
                checked.refuse_if(mixed, &key, format!("{factors:?}"), remedy)
            }
            Self::Step { at, factors, .. } => {
                checked.finite(&format!("{key}.step.at"), *at)?;
                factors.iter().try_for_each(|factor| checked.positive(&format!("{key}.step.factors"), *factor))
            }
            Self::Stripes { axis, width, from, factors } => {
                checked.positive(&format!("{key}.stripes.width"), *width)?;
                checked.finite(&format!("{key}.stripes.from"), *from)?;
                let list = format!("{key}.stripes.factors");
                factors.iter().try_for_each(|factor| checked.positive(&list, *factor))?;
                checked.refuse_if(factors.is_empty(), &list, "[]", "stripes need their factors. List at least one")?;
                let Some(period) = period.filter(|_| *axis == Axis::X) else { return Ok(()) };
                let turns = period / (*width * factors.len() as f64);
                let broken = (turns - turns.round()).abs() > WHOLE || turns.round() < 1.0;
                let fitting = period / (turns.round().max(1.0) * factors.len() as f64);
                let remedy = format!("the period {period} is not a whole number of such stripes. Use {fitting}");
                checked.refuse_if(broken, &format!("{key}.stripes.width"), width, remedy)
            }
            Self::Product(parts) => parts
                .iter()
                .enumerate()
                .try_for_each(|(number, part)| part.check(&format!("{key}.product[{number}]"), checked, period)),
        }
    }
}
