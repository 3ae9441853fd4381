//! Reader of descriptions in TOML texts.
//!
//! That of the crate `toml` carries dates, spans and five kinds of integers into every type that it reads; for the
//! hundred types of a description that is half a megabyte of a page in a browser.

use std::fmt;
use std::ops::Range;

use serde::de::value::StrDeserializer;
use serde::de::{
    Deserialize, DeserializeSeed, Deserializer, EnumAccess, Error, Expected, MapAccess, SeqAccess, Unexpected,
    VariantAccess, Visitor,
};
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};
use toml::map::Iter;

#[cfg(test)]
mod tests;

/// Mistake in a text, and where it is.
#[derive(Debug)]
pub(super) struct Mistake {
    message: String,
    place: Option<Range<usize>>,
}

impl Mistake {
    fn at(mut self, place: Range<usize>) -> Self {
        self.place.get_or_insert(place);
        self
    }

    /// Words with the line and the place in it, as `toml` shows its own.
    fn in_text(&self, text: &str) -> String {
        let Some(Range { start, end }) = self.place.clone() else { return self.message.clone() + "\n" };
        let line_start = text[..start].rfind('\n').map_or(0, |end| end + 1);
        let number = (text[..start].matches('\n').count() + 1).to_string();
        let line = text[line_start..].lines().next().unwrap_or_default();
        let before = text[line_start..start].chars().count();
        let marked = text[start..end].lines().next().unwrap_or_default().chars().count().max(1);
        let gutter = " ".repeat(number.len() + 1);
        format!(
            "TOML parse error at line {number}, column {}\n{gutter}|\n{number} | {line}\n{gutter}| {}{}\n{}\n",
            before + 1,
            " ".repeat(before),
            "^".repeat(marked),
            self.message
        )
    }
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Mistake {}

impl Error for Mistake {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self { message: message.to_string(), place: None }
    }
}

/// What a text says.
///
/// # Errors
/// Words with the line, for texts that are no TOML and for what does not fit the type.
pub(super) fn read<T: for<'de> Deserialize<'de>>(text: &str) -> Result<T, String> {
    let table = DeTable::parse(text).map_err(|error| error.to_string())?;
    let (place, value) = (table.span(), DeValue::Table(table.into_inner()));
    T::deserialize(Entry { value: &value, place }).map_err(|mistake| mistake.in_text(text))
}

/// Value of a text, and where it is.
struct Entry<'v> {
    value: &'v DeValue<'v>,
    place: Range<usize>,
}

impl<'v> Entry<'v> {
    fn of(value: &'v Spanned<DeValue<'v>>) -> Self {
        Self { value: value.get_ref(), place: value.span() }
    }

    /// Refusal of a value of another type.
    #[cold]
    fn refused(&self, expected: &dyn Expected) -> Mistake {
        let kind = match self.value {
            DeValue::String(text) => Unexpected::Str(text),
            DeValue::Integer(_) | DeValue::Float(_) => match self.number() {
                Ok(Number::Whole(value)) => Unexpected::Signed(value),
                Ok(Number::Large(value)) => Unexpected::Unsigned(value),
                Ok(Number::Real(value)) => Unexpected::Float(value),
                Err(mistake) => return mistake,
            },
            DeValue::Boolean(value) => Unexpected::Bool(*value),
            DeValue::Datetime(_) => Unexpected::Other("date"),
            DeValue::Array(_) => Unexpected::Seq,
            DeValue::Table(_) => Unexpected::Map,
        };
        Mistake::invalid_type(kind, expected).at(self.place.clone())
    }

    fn number(&self) -> Result<Number, Mistake> {
        let number = match self.value {
            DeValue::Integer(value) => {
                let (text, radix) = (value.as_str(), value.radix());
                let whole = i64::from_str_radix(text, radix).map(Number::Whole);
                whole.or_else(|_| u64::from_str_radix(text, radix).map(Number::Large)).ok()
            }
            DeValue::Float(value) => {
                let read: Option<f64> = value.as_str().parse().ok();
                read.filter(|read| read.is_finite() || !value.as_str().contains(|c: char| c.is_ascii_digit()))
                    .map(Number::Real)
            }
            _ => None,
        };
        number.ok_or_else(|| Mistake::custom("a number that is too large").at(self.place.clone()))
    }

    /// Text, number or truth.
    fn scalar<'de, V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Mistake> {
        let visited = match self.value {
            DeValue::String(text) => visitor.visit_str(text),
            DeValue::Boolean(value) => visitor.visit_bool(*value),
            DeValue::Integer(_) | DeValue::Float(_) => match self.number()? {
                Number::Whole(value) => visitor.visit_i64(value),
                Number::Large(value) => visitor.visit_u64(value),
                Number::Real(value) => visitor.visit_f64(value),
            },
            _ => return Err(self.refused(&visitor)),
        };
        visited.map_err(|mistake: Mistake| mistake.at(self.place))
    }

    fn list<'de, V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Mistake> {
        let DeValue::Array(list) = self.value else { return Err(self.refused(&visitor)) };
        visitor.visit_seq(List(list.iter())).map_err(|mistake| mistake.at(self.place))
    }

    fn table<'de, V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Mistake> {
        let DeValue::Table(table) = self.value else { return Err(self.refused(&visitor)) };
        let entries = Table { rest: table.iter(), value: None };
        visitor.visit_map(entries).map_err(|mistake| mistake.at(self.place))
    }
}

enum Number {
    Whole(i64),
    Large(u64),
    Real(f64),
}

/// Methods that read alike.
macro_rules! alike {
    ($method:ident: $($name:ident)*) => {
        $(fn $name<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Mistake> {
            self.$method(visitor)
        })*
    };
}

impl<'de> Deserializer<'de> for Entry<'_> {
    type Error = Mistake;

    alike! { scalar: deserialize_bool deserialize_i8 deserialize_i16 deserialize_i32 deserialize_i64 deserialize_u8
    deserialize_u16 deserialize_u32 deserialize_u64 deserialize_f32 deserialize_f64 deserialize_char deserialize_str
    deserialize_string deserialize_bytes deserialize_byte_buf deserialize_identifier }
    alike! { list: deserialize_seq }
    alike! { table: deserialize_map }

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Mistake> {
        match self.value {
            DeValue::Array(_) => self.list(visitor),
            DeValue::Table(_) => self.table(visitor),
            _ => self.scalar(visitor),
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Mistake> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value, Mistake> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_unit<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Mistake> {
        Err(self.refused(&visitor))
    }

    fn deserialize_unit_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value, Mistake> {
        Err(self.refused(&visitor))
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Mistake> {
        self.list(visitor)
    }

    fn deserialize_tuple_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: usize,
        visitor: V,
    ) -> Result<V::Value, Mistake> {
        self.list(visitor)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Mistake> {
        self.table(visitor)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Mistake> {
        let variant = match self.value {
            DeValue::String(name) => Variant { name, place: self.place.clone(), contents: None },
            DeValue::Table(table) => match (table.len(), table.iter().next()) {
                (1, Some((key, value))) => {
                    Variant { name: key.get_ref(), place: key.span(), contents: Some(Entry::of(value)) }
                }
                (count, _) => {
                    let message = format!("one entry is to be chosen here, there are {count}");
                    return Err(Mistake::custom(message).at(self.place));
                }
            },
            _ => return Err(self.refused(&visitor)),
        };
        visitor.visit_enum(variant).map_err(|mistake| mistake.at(self.place))
    }

    fn deserialize_ignored_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Mistake> {
        visitor.visit_unit()
    }
}

/// Entries of a list.
struct List<'v>(std::slice::Iter<'v, Spanned<DeValue<'v>>>);

impl<'de> SeqAccess<'de> for List<'_> {
    type Error = Mistake;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, Mistake> {
        self.0.next().map(|value| seed.deserialize(Entry::of(value))).transpose()
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.0.len())
    }
}

/// Entries of a table.
struct Table<'v> {
    rest: Iter<'v, Spanned<DeString<'v>>, Spanned<DeValue<'v>>>,
    value: Option<&'v Spanned<DeValue<'v>>>,
}

impl<'de> MapAccess<'de> for Table<'_> {
    type Error = Mistake;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, Mistake> {
        let Some((key, value)) = self.rest.next() else { return Ok(None) };
        self.value = Some(value);
        seed.deserialize(StrDeserializer::new(key.get_ref()))
            .map(Some)
            .map_err(|mistake: Mistake| mistake.at(key.span()))
    }

    fn next_value_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<T::Value, Mistake> {
        let value = self.value.take().ok_or_else(|| Mistake::custom("a value before its key"))?;
        seed.deserialize(Entry::of(value)).map_err(|mistake| mistake.at(value.span()))
    }
}

/// Variant by its name, with what stands in it.
struct Variant<'v> {
    name: &'v str,
    place: Range<usize>,
    contents: Option<Entry<'v>>,
}

impl<'de, 'v> EnumAccess<'de> for Variant<'v> {
    type Error = Mistake;
    type Variant = Self;

    fn variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<(T::Value, Self), Mistake> {
        let chosen = seed.deserialize(StrDeserializer::new(self.name));
        Ok((chosen.map_err(|mistake: Mistake| mistake.at(self.place.clone()))?, self))
    }
}

impl<'v> Variant<'v> {
    /// What stands in a variant that has contents.
    fn filled(self, expected: &dyn Expected) -> Result<Entry<'v>, Mistake> {
        let Self { place, contents, .. } = self;
        contents.ok_or_else(|| Mistake::invalid_type(Unexpected::UnitVariant, expected).at(place))
    }
}

impl<'de> VariantAccess<'de> for Variant<'_> {
    type Error = Mistake;

    fn unit_variant(self) -> Result<(), Mistake> {
        match self.contents {
            None => Ok(()),
            Some(Entry { value: DeValue::Table(table), .. }) if table.is_empty() => Ok(()),
            Some(entry) => Err(entry.refused(&"nothing, or an empty table")),
        }
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, Mistake> {
        seed.deserialize(self.filled(&"a value")?)
    }

    fn tuple_variant<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Mistake> {
        self.filled(&visitor)?.list(visitor)
    }

    fn struct_variant<V: Visitor<'de>>(self, known: &'static [&'static str], visitor: V) -> Result<V::Value, Mistake> {
        let entry = self.filled(&visitor)?;
        if let DeValue::Table(table) = entry.value
            && let Some(key) = table.keys().find(|key| !known.contains(&key.get_ref().as_ref()))
        {
            return Err(Mistake::unknown_field(key.get_ref(), known).at(key.span()));
        }
        entry.table(visitor)
    }
}
