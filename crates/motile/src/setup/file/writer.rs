//! Writing of a description as a table of TOML values.
//!
//! As for the [reader](super::reader), each part of a description is compiled once and small.

use serde::Serialize;
use serde::ser::{
    Error as _, SerializeMap, SerializeSeq, SerializeStruct, SerializeStructVariant, SerializeTuple,
    SerializeTupleStruct, SerializeTupleVariant, Serializer,
};
use toml::{Table, Value};

use super::reader::Problem;

/// Returns the table of a value; what is `None` is left out.
pub(in crate::setup) fn table(value: &impl Serialize) -> Result<Table, Problem> {
    match value.serialize(Writer)? {
        Some(Value::Table(table)) => Ok(table),
        _ => Err(Problem::custom("a file is a table of entries")),
    }
}

/// A writer of a value, which is `None` if there is nothing to write.
struct Writer;

type Written = Result<Option<Value>, Problem>;

/// Returns a value, or a table of one entry if it belongs to a choice of that name.
fn named(choice: Option<&'static str>, value: Value) -> Value {
    match choice {
        None => value,
        Some(name) => Value::Table(Table::from_iter([(name.to_owned(), value)])),
    }
}

impl Serializer for Writer {
    type Ok = Option<Value>;
    type Error = Problem;
    type SerializeSeq = List;
    type SerializeTuple = List;
    type SerializeTupleStruct = List;
    type SerializeTupleVariant = List;
    type SerializeMap = Entries;
    type SerializeStruct = Entries;
    type SerializeStructVariant = Entries;

    fn serialize_bool(self, value: bool) -> Written {
        Ok(Some(Value::Boolean(value)))
    }

    fn serialize_i8(self, value: i8) -> Written {
        self.serialize_i64(value.into())
    }

    fn serialize_i16(self, value: i16) -> Written {
        self.serialize_i64(value.into())
    }

    fn serialize_i32(self, value: i32) -> Written {
        self.serialize_i64(value.into())
    }

    fn serialize_i64(self, value: i64) -> Written {
        Ok(Some(Value::Integer(value)))
    }

    fn serialize_u8(self, value: u8) -> Written {
        self.serialize_i64(value.into())
    }

    fn serialize_u16(self, value: u16) -> Written {
        self.serialize_i64(value.into())
    }

    fn serialize_u32(self, value: u32) -> Written {
        self.serialize_i64(value.into())
    }

    fn serialize_u64(self, value: u64) -> Written {
        let too_large = |_| Problem::custom(format_args!("the number {value} is above {}", i64::MAX));
        self.serialize_i64(i64::try_from(value).map_err(too_large)?)
    }

    fn serialize_f32(self, value: f32) -> Written {
        self.serialize_f64(value.into())
    }

    fn serialize_f64(self, value: f64) -> Written {
        Ok(Some(Value::Float(value)))
    }

    fn serialize_char(self, value: char) -> Written {
        Ok(Some(Value::String(value.to_string())))
    }

    fn serialize_str(self, value: &str) -> Written {
        Ok(Some(Value::String(value.to_owned())))
    }

    fn serialize_bytes(self, _: &[u8]) -> Written {
        Err(Problem::custom("there are no bytes in TOML"))
    }

    fn serialize_none(self) -> Written {
        Ok(None)
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Written {
        value.serialize(self)
    }

    fn serialize_unit(self) -> Written {
        Ok(None)
    }

    fn serialize_unit_struct(self, _: &'static str) -> Written {
        Ok(None)
    }

    fn serialize_unit_variant(self, _: &'static str, _: u32, choice: &'static str) -> Written {
        self.serialize_str(choice)
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(self, _: &'static str, value: &T) -> Written {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        _: u32,
        choice: &'static str,
        value: &T,
    ) -> Written {
        Ok(value.serialize(self)?.map(|value| named(Some(choice), value)))
    }

    fn serialize_seq(self, _: Option<usize>) -> Result<List, Problem> {
        Ok(List::default())
    }

    fn serialize_tuple(self, _: usize) -> Result<List, Problem> {
        Ok(List::default())
    }

    fn serialize_tuple_struct(self, _: &'static str, _: usize) -> Result<List, Problem> {
        Ok(List::default())
    }

    fn serialize_tuple_variant(self, _: &'static str, _: u32, choice: &'static str, _: usize) -> Result<List, Problem> {
        Ok(List { choice: Some(choice), values: Vec::new() })
    }

    fn serialize_map(self, _: Option<usize>) -> Result<Entries, Problem> {
        Ok(Entries::default())
    }

    fn serialize_struct(self, _: &'static str, _: usize) -> Result<Entries, Problem> {
        Ok(Entries::default())
    }

    fn serialize_struct_variant(
        self,
        _: &'static str,
        _: u32,
        choice: &'static str,
        _: usize,
    ) -> Result<Entries, Problem> {
        Ok(Entries { choice: Some(choice), ..Entries::default() })
    }
}

/// A list, and the choice whose settings it is.
#[derive(Default)]
struct List {
    choice: Option<&'static str>,
    values: Vec<Value>,
}

impl List {
    #[inline(never)]
    fn push(&mut self, value: Option<Value>) -> Result<(), Problem> {
        self.values.push(value.ok_or_else(|| Problem::custom("a list has no empty places in TOML"))?);
        Ok(())
    }

    fn whole(self) -> Written {
        Ok(Some(named(self.choice, Value::Array(self.values))))
    }
}

/// A table, the choice whose settings it is, and the key of the next value.
#[derive(Default)]
struct Entries {
    choice: Option<&'static str>,
    table: Table,
    key: String,
}

impl Entries {
    #[inline(never)]
    fn insert(&mut self, key: &str, value: Option<Value>) {
        if let Some(value) = value {
            self.table.insert(key.to_owned(), value);
        }
    }

    fn whole(self) -> Written {
        Ok(Some(named(self.choice, Value::Table(self.table))))
    }
}

/// Lists, whatever they are called.
macro_rules! list {
    ($($name:ident::$add:ident),*) => {
        $(impl $name for List {
            type Ok = Option<Value>;
            type Error = Problem;

            fn $add<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Problem> {
                self.push(value.serialize(Writer)?)
            }

            fn end(self) -> Written {
                self.whole()
            }
        })*
    };
}

list!(
    SerializeSeq::serialize_element,
    SerializeTuple::serialize_element,
    SerializeTupleStruct::serialize_field,
    SerializeTupleVariant::serialize_field
);

/// Tables with known keys, whatever they are called.
macro_rules! table {
    ($($name:ident),*) => {
        $(impl $name for Entries {
            type Ok = Option<Value>;
            type Error = Problem;

            fn serialize_field<T: Serialize + ?Sized>(&mut self, key: &'static str, value: &T) -> Result<(), Problem> {
                self.insert(key, value.serialize(Writer)?);
                Ok(())
            }

            fn end(self) -> Written {
                self.whole()
            }
        })*
    };
}

table!(SerializeStruct, SerializeStructVariant);

impl SerializeMap for Entries {
    type Ok = Option<Value>;
    type Error = Problem;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Result<(), Problem> {
        match key.serialize(Writer)? {
            Some(Value::String(key)) => self.key = key,
            _ => return Err(Problem::custom("keys are words in TOML")),
        }
        Ok(())
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Problem> {
        let key = std::mem::take(&mut self.key);
        self.insert(&key, value.serialize(Writer)?);
        Ok(())
    }

    fn end(self) -> Written {
        self.whole()
    }
}
