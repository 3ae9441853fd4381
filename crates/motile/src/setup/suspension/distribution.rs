//! Values that differ from droplet to droplet.

use std::f64::consts::TAU;
use std::fmt;

use active_interface::internal::SplitMix64;
use serde::de::{Error as _, MapAccess, SeqAccess, Visitor, value::MapAccessDeserializer};
use serde::ser::SerializeMap as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::super::checked::Checked;
use crate::SetupError;

/// Deviations from the mean at which a normal distribution is cut off.
const CUT: f64 = 3.0;

/// A value of each droplet of a suspension: in a file a number, `[least, most]`, or `{ normal = { mean, deviation } }`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Distribution {
    /// All alike.
    Value(f64),
    /// Any from the first to the second, equally likely.
    Between([f64; 2]),
    /// Normally distributed, cut off at three deviations.
    Normal {
        /// Mean of the values.
        mean: f64,
        /// Standard deviation of the values before the cut.
        deviation: f64,
    },
}

/// The normal distribution of a file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Normal {
    mean: f64,
    deviation: f64,
}

/// The table of a file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    normal: Normal,
}

impl Distribution {
    /// Returns the least and the largest value.
    #[must_use]
    pub fn bounds(self) -> [f64; 2] {
        match self {
            Self::Value(value) => [value; 2],
            Self::Between(bounds) => bounds,
            Self::Normal { mean, deviation } => [mean - CUT * deviation, mean + CUT * deviation],
        }
    }

    /// Returns the mean of the squares; of a normal distribution without the cut, which takes off 2.7 % of its
    /// variance.
    pub(super) fn mean_square(self) -> f64 {
        match self {
            Self::Value(value) => value * value,
            Self::Between([a, b]) => (a * a + a * b + b * b) / 3.0,
            Self::Normal { mean, deviation } => mean * mean + deviation * deviation,
        }
    }

    /// Returns the next value.
    pub(super) fn draw(self, random: &mut SplitMix64) -> f64 {
        match self {
            Self::Value(value) => value,
            Self::Between([a, b]) => a + (b - a) * random.uniform(),
            Self::Normal { mean, deviation } => loop {
                // Box and Muller 1958.
                let size = (-2.0 * random.uniform().ln()).sqrt();
                let number = size * (TAU * random.uniform()).cos();
                if number.abs() <= CUT {
                    return mean + deviation * number;
                }
            },
        }
    }

    /// Refuses values that are not finite, or not positive where they have to be, and bounds in the wrong order.
    pub(super) fn check(self, checked: &Checked<'_>, key: &str, positive: bool) -> Result<(), SetupError> {
        let [least, most] = self.bounds();
        let unordered = !least.is_finite() || !most.is_finite() || least > most;
        checked.refuse_if(unordered, key, self, "use a finite number, or [smallest, largest] in this order")?;
        let remedy = format!("the range contains {least}. Use positive numbers only");
        checked.refuse_if(positive && least <= 0.0, key, self, remedy)
    }
}

impl fmt::Display for Distribution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Value(value) => write!(f, "{value}"),
            Self::Between([least, most]) => write!(f, "[{least}, {most}]"),
            Self::Normal { mean, deviation } => write!(f, "normal around {mean} with {deviation}"),
        }
    }
}

impl Serialize for Distribution {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match *self {
            Self::Value(value) => to.serialize_f64(value),
            Self::Between(bounds) => bounds.serialize(to),
            Self::Normal { mean, deviation } => {
                let mut table = to.serialize_map(Some(1))?;
                table.serialize_entry("normal", &Normal { mean, deviation })?;
                table.end()
            }
        }
    }
}

impl<'de> Deserialize<'de> for Distribution {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Entry;
        impl<'de> Visitor<'de> for Entry {
            type Value = Distribution;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number, [least, most] or { normal = { mean = ..., deviation = ... } }")
            }

            fn visit_f64<E>(self, value: f64) -> Result<Distribution, E> {
                Ok(Distribution::Value(value))
            }

            fn visit_i64<E>(self, value: i64) -> Result<Distribution, E> {
                Ok(Distribution::Value(value as f64))
            }

            fn visit_u64<E>(self, value: u64) -> Result<Distribution, E> {
                Ok(Distribution::Value(value as f64))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Distribution, A::Error> {
                match [list.next_element()?, list.next_element()?, list.next_element()?] {
                    [Some(least), Some(most), None] => Ok(Distribution::Between([least, most])),
                    _ => Err(A::Error::custom("a range has two numbers, [least, most]")),
                }
            }

            fn visit_map<A: MapAccess<'de>>(self, table: A) -> Result<Distribution, A::Error> {
                let Table { normal: Normal { mean, deviation } } =
                    Table::deserialize(MapAccessDeserializer::new(table))?;
                Ok(Distribution::Normal { mean, deviation })
            }
        }
        from.deserialize_any(Entry)
    }
}
