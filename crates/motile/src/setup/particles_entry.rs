//! The particles of a droplet in a file: a table, or "none".

use std::fmt;

use serde::de::{Error, MapAccess, Unexpected, Visitor, value::MapAccessDeserializer};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::setup::Particles;

const NONE: &str = "none";

pub(crate) fn serialize<S: Serializer>(particles: &Option<Particles>, to: S) -> Result<S::Ok, S::Error> {
    match particles {
        None => to.serialize_str(NONE),
        Some(particles) => particles.serialize(to),
    }
}

pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Particles>, D::Error> {
    struct Entry;
    impl<'de> Visitor<'de> for Entry {
        type Value = Option<Particles>;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("a table of particles, or \"none\" for a passive droplet")
        }

        fn visit_str<E: Error>(self, text: &str) -> Result<Self::Value, E> {
            if text == NONE { Ok(None) } else { Err(E::invalid_value(Unexpected::Str(text), &self)) }
        }

        fn visit_map<A: MapAccess<'de>>(self, table: A) -> Result<Self::Value, A::Error> {
            Particles::deserialize(MapAccessDeserializer::new(table)).map(Some)
        }
    }
    from.deserialize_any(Entry)
}
