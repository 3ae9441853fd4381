//! Reading of a description from the entries of a TOML text.
//!
//! For the reader of the package `toml`, every part of a description is compiled four times: as a table, as a list, as
//! a date, and with its place. Here tables are tables and lists are lists, so each part is compiled once. This leaves
//! out a tenth of the page for browsers.

use std::borrow::Cow;
use std::convert::Infallible;
use std::fmt;
use std::marker::PhantomData;
use std::ops::Range;

use serde::de::value::StrDeserializer;
use serde::de::{
    DeserializeOwned, DeserializeSeed, Deserializer, EnumAccess, Error as _, Expected, MapAccess, SeqAccess,
    Unexpected, VariantAccess, Visitor,
};
use serde::forward_to_deserialize_any;
use toml::Spanned;
use toml::de::{DeTable, DeValue, ValueDeserializer};

/// Reads a value from a text. Errors name the line.
pub(super) fn read<T: DeserializeOwned>(text: &str) -> Result<T, toml::de::Error> {
    let root = DeTable::parse(text)?;
    let root = Spanned::new(root.span(), DeValue::Table(root.into_inner()));
    Entry(&root).seeded(PhantomData).map_err(|problem| problem.in_text(text))
}

/// A problem with an entry, and its place in the text once it is known.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub(in crate::setup) struct Problem(Box<Explained>);

#[derive(Debug, thiserror::Error)]
#[error("{message}")]
struct Explained {
    message: String,
    span: Option<Range<usize>>,
}

impl serde::de::Error for Problem {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self::of(message.to_string())
    }
}

impl serde::ser::Error for Problem {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self::of(message.to_string())
    }
}

impl Problem {
    #[inline(never)]
    fn of(message: String) -> Self {
        Self(Box::new(Explained { message, span: None }))
    }

    /// Adds the place, unless the place of a smaller part is known.
    #[inline(never)]
    fn at(mut self, span: Range<usize>) -> Self {
        self.0.span.get_or_insert(span);
        self
    }

    /// Returns the error that shows the line of the text.
    fn in_text(self, text: &str) -> toml::de::Error {
        // Errors get their place from an entry that is read: here, one at this place that nobody wants.
        struct Unwanted(String);
        impl Visitor<'_> for Unwanted {
            type Value = Infallible;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(&self.0)
            }

            fn visit_bool<E: serde::de::Error>(self, _: bool) -> Result<Infallible, E> {
                Err(E::custom(self.0))
            }
        }
        let Explained { message, span } = *self.0;
        let mark = Spanned::new(span.unwrap_or_default(), DeValue::Boolean(false));
        let Err(mut error) = ValueDeserializer::from(mark).deserialize_bool(Unwanted(message));
        error.set_input(Some(text));
        error
    }
}

/// A value and its place in the text.
#[derive(Clone, Copy)]
struct Entry<'i>(&'i Spanned<DeValue<'i>>);

impl<'i> Entry<'i> {
    /// Reads the value; its errors have its place.
    fn seeded<S: DeserializeSeed<'i>>(self, seed: S) -> Result<S::Value, Problem> {
        seed.deserialize(self).map_err(|problem| problem.at(self.0.span()))
    }

    /// Returns the problem that a value of another kind is expected.
    #[inline(never)]
    fn refused(self, expected: &dyn Expected) -> Problem {
        let found = match self.0.get_ref() {
            DeValue::String(text) => Unexpected::Str(text),
            DeValue::Integer(number) => match number.as_str().parse() {
                Ok(number) => Unexpected::Signed(number),
                Err(_) => Unexpected::Other("integer"),
            },
            DeValue::Float(number) => Unexpected::Float(number.as_str().parse().unwrap_or(f64::NAN)),
            DeValue::Boolean(truth) => Unexpected::Bool(*truth),
            DeValue::Datetime(_) => Unexpected::Other("date"),
            DeValue::Array(_) => Unexpected::Seq,
            DeValue::Table(_) => Unexpected::Map,
        };
        Problem::invalid_type(found, expected)
    }
}

impl<'i> Deserializer<'i> for Entry<'i> {
    type Error = Problem;

    fn deserialize_any<V: Visitor<'i>>(self, visitor: V) -> Result<V::Value, Problem> {
        match self.0.get_ref() {
            DeValue::String(text) => visitor.visit_str(text),
            DeValue::Integer(number) => match i64::from_str_radix(number.as_str(), number.radix()) {
                Ok(number) => visitor.visit_i64(number),
                Err(_) => match u64::from_str_radix(number.as_str(), number.radix()) {
                    Ok(number) => visitor.visit_u64(number),
                    Err(_) => Err(Problem::custom("this number has too many digits")),
                },
            },
            DeValue::Float(number) => match number.as_str().parse::<f64>() {
                Ok(value) if value.is_finite() || number.as_str().contains(['n', 'N']) => visitor.visit_f64(value),
                _ => Err(Problem::custom("this number is too large")),
            },
            DeValue::Boolean(truth) => visitor.visit_bool(*truth),
            DeValue::Datetime(_) => Err(self.refused(&visitor)),
            DeValue::Array(_) => self.deserialize_seq(visitor),
            DeValue::Table(_) => self.deserialize_map(visitor),
        }
    }

    fn deserialize_option<V: Visitor<'i>>(self, visitor: V) -> Result<V::Value, Problem> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'i>>(self, _: &'static str, visitor: V) -> Result<V::Value, Problem> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_seq<V: Visitor<'i>>(self, visitor: V) -> Result<V::Value, Problem> {
        match self.0.get_ref() {
            DeValue::Array(list) => {
                let mut values = List(list.iter());
                let read = visitor.visit_seq(&mut values)?;
                // Readers of lists of a fixed length stop there.
                let left = values.0.len();
                if left == 0 { Ok(read) } else { Err(too_long(list.len(), left)) }
            }
            _ => Err(self.refused(&visitor)),
        }
    }

    fn deserialize_tuple<V: Visitor<'i>>(self, _: usize, visitor: V) -> Result<V::Value, Problem> {
        self.deserialize_seq(visitor)
    }

    fn deserialize_tuple_struct<V: Visitor<'i>>(
        self,
        _: &'static str,
        _: usize,
        visitor: V,
    ) -> Result<V::Value, Problem> {
        self.deserialize_seq(visitor)
    }

    fn deserialize_map<V: Visitor<'i>>(self, visitor: V) -> Result<V::Value, Problem> {
        match self.0.get_ref() {
            DeValue::Table(table) => visitor.visit_map(Table { entries: table.iter(), value: None }),
            _ => Err(self.refused(&visitor)),
        }
    }

    fn deserialize_struct<V: Visitor<'i>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Problem> {
        self.deserialize_map(visitor)
    }

    fn deserialize_enum<V: Visitor<'i>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Problem> {
        visitor.visit_enum(Choice::of(self)?)
    }

    forward_to_deserialize_any! {
        <V: Visitor<'i>>
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit unit_struct identifier
        ignored_any
    }
}

/// Returns the problem of a list with so many entries of which some are left over.
#[inline(never)]
fn too_long(entries: usize, left: usize) -> Problem {
    Problem::of(format!("this list has {entries} entries. Give {}", entries - left))
}

/// The values of a list.
struct List<'i>(std::slice::Iter<'i, Spanned<DeValue<'i>>>);

impl<'i> SeqAccess<'i> for &mut List<'i> {
    type Error = Problem;

    fn next_element_seed<S: DeserializeSeed<'i>>(&mut self, seed: S) -> Result<Option<S::Value>, Problem> {
        self.0.next().map(|value| Entry(value).seeded(seed)).transpose()
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.0.len())
    }
}

/// The entries of a table, and the value of the key that was read last.
struct Table<'i> {
    entries: toml::map::Iter<'i, Name<'i>, Spanned<DeValue<'i>>>,
    value: Option<Entry<'i>>,
}

/// A key or the name of a choice.
type Name<'i> = Spanned<Cow<'i, str>>;

impl<'i> MapAccess<'i> for Table<'i> {
    type Error = Problem;

    fn next_key_seed<S: DeserializeSeed<'i>>(&mut self, seed: S) -> Result<Option<S::Value>, Problem> {
        let Some((key, value)) = self.entries.next() else { return Ok(None) };
        self.value = Some(Entry(value));
        named(seed, key).map(Some)
    }

    fn next_value_seed<S: DeserializeSeed<'i>>(&mut self, seed: S) -> Result<S::Value, Problem> {
        self.value.take().ok_or_else(|| Problem::custom("a key has no value"))?.seeded(seed)
    }
}

/// Reads a key or the name of a choice.
fn named<'i, S: DeserializeSeed<'i>>(seed: S, name: &'i Name<'i>) -> Result<S::Value, Problem> {
    seed.deserialize(StrDeserializer::new(name.get_ref())).map_err(|problem: Problem| problem.at(name.span()))
}

/// One of several choices: a name alone, or a table of one entry, `name = settings`.
struct Choice<'i> {
    name: &'i str,
    place: Range<usize>,
    settings: Settings<'i>,
}

impl<'i> Choice<'i> {
    fn of(entry: Entry<'i>) -> Result<Self, Problem> {
        match entry.0.get_ref() {
            DeValue::String(name) => Ok(Self { name, place: entry.0.span(), settings: Settings(None) }),
            DeValue::Table(table) => match (table.iter().next(), table.len()) {
                (Some((name, value)), 1) => {
                    Ok(Self { name: name.get_ref(), place: name.span(), settings: Settings(Some(Entry(value))) })
                }
                (_, count) => {
                    let problem = format!("this table has {count} entries. Give one, which names the choice");
                    Err(Problem::custom(problem))
                }
            },
            _ => Err(entry.refused(&"the name of a choice, or a table of one entry")),
        }
    }
}

impl<'i> EnumAccess<'i> for Choice<'i> {
    type Error = Problem;
    type Variant = Settings<'i>;

    fn variant_seed<S: DeserializeSeed<'i>>(self, seed: S) -> Result<(S::Value, Settings<'i>), Problem> {
        let read = seed.deserialize(StrDeserializer::new(self.name));
        Ok((read.map_err(|problem: Problem| problem.at(self.place))?, self.settings))
    }
}

/// Settings of a choice; none if there is only its name.
struct Settings<'i>(Option<Entry<'i>>);

impl<'i> Settings<'i> {
    #[inline(never)]
    fn given(self) -> Result<Entry<'i>, Problem> {
        self.0
            .ok_or_else(|| Problem::custom("this choice has settings. Give a table of one entry, `choice = settings`"))
    }

    /// Returns the settings, refused if they are a table with a key that is not one of `keys`.
    #[inline(never)]
    fn with_keys(self, keys: &'static [&'static str]) -> Result<Entry<'i>, Problem> {
        let entry = self.given()?;
        if let DeValue::Table(table) = entry.0.get_ref() {
            // The derived reader of a choice would pass over them.
            if let Some(key) = table.keys().find(|key| !keys.contains(&key.get_ref().as_ref())) {
                return Err(Problem::unknown_field(key.get_ref(), keys).at(key.span()));
            }
        }
        Ok(entry)
    }
}

impl<'i> VariantAccess<'i> for Settings<'i> {
    type Error = Problem;

    #[inline(never)]
    fn unit_variant(self) -> Result<(), Problem> {
        let Some(Entry(entry)) = self.0 else { return Ok(()) };
        match entry.get_ref() {
            DeValue::Table(table) if table.is_empty() => Ok(()),
            _ => Err(Problem::custom("this choice has no settings. Give its name only").at(entry.span())),
        }
    }

    fn newtype_variant_seed<S: DeserializeSeed<'i>>(self, seed: S) -> Result<S::Value, Problem> {
        self.given()?.seeded(seed)
    }

    fn tuple_variant<V: Visitor<'i>>(self, _: usize, visitor: V) -> Result<V::Value, Problem> {
        let entry = self.given()?;
        entry.deserialize_seq(visitor).map_err(|problem| problem.at(entry.0.span()))
    }

    fn struct_variant<V: Visitor<'i>>(self, keys: &'static [&'static str], visitor: V) -> Result<V::Value, Problem> {
        let entry = self.with_keys(keys)?;
        entry.deserialize_map(visitor).map_err(|problem| problem.at(entry.0.span()))
    }
}

#[cfg(test)]
mod tests;
