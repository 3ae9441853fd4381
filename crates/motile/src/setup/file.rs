//! Scene files: descriptions in TOML.

mod reader;
pub(super) mod writer;

use std::path::Path;

use motile_base::internal::Refuse as _;
use outline_files::bytes_of;

use super::Setup;
use crate::SetupError;

impl Setup {
    /// Text of a scene file that has every key, with its dimension and its default.
    pub const ANNOTATED: &str = include_str!("../../scene.toml");

    /// Reads the description from a TOML text. What you leave out is as in [`Setup::default`] and
    /// [`crate::setup::DropletSetup::default`], but there are no droplets unless you list them. A droplet is active
    /// unless it says `particles = "none"`. Files of outlines and meshes are relative to the directory of the program;
    /// to have them relative to a scene file, use [`Setup::from_file`]. [`Setup::ANNOTATED`] shows every key with its
    /// dimension and its default.
    ///
    /// ```
    /// use motile::setup::Setup;
    ///
    /// let text = "viscosity = 50.0\n[[droplets]]\ncentre = [0.5, 0.0]\nparticles.activity = -3.0\n";
    /// let setup = Setup::from_toml(text)?;
    /// assert_eq!((setup.viscosity, setup.droplets[0].activity()), (50.0, -3.0));
    /// let refused = Setup::from_toml("viscosty = 50.0").unwrap_err().to_string();
    /// assert!(refused.contains("unknown key `viscosty`"), "{refused}");
    /// # Ok::<(), motile::SetupError>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error for a text that is not TOML, keys that do not exist, values of the wrong type
    /// ([`SetupError::Refused`], with the line), keys of earlier versions, with what to give instead, and what
    /// [`Setup::check`] refuses.
    pub fn from_toml(text: &str) -> Result<Self, SetupError> {
        Self::of_text(text, Path::new(""))
    }

    /// Reads the description of a scene file (TOML) as [`Setup::from_toml`]. Files of outlines and meshes that it names
    /// are relative to it.
    ///
    /// # Errors
    /// Returns an error for a file that cannot be read, and the errors of [`Setup::from_toml`].
    pub fn from_file(path: &Path) -> Result<Self, SetupError> {
        let bytes = bytes_of(path)?;
        let text = String::from_utf8(bytes).map_err(|_| {
            let what = format!("the file {} is not text", path.display());
            SetupError::refused(what, "", "Use a scene file in TOML")
        })?;
        Self::of_text(&text, path.parent().unwrap_or(Path::new("")))
    }

    /// Reads a description whose files are relative to a directory.
    fn of_text(text: &str, directory: &Path) -> Result<Self, SetupError> {
        let problem = |error: toml::de::Error| match replaced(text) {
            Some(error) => error,
            None => SetupError::file(error),
        };
        let setup = Self::read(text).map_err(problem)?;
        setup.check()?;
        setup.with_files(directory)
    }

    /// Reads a description that may break the rules of [`Setup::check`], for programs that change its entries first.
    /// Reading is compiled here once, and not again in each program.
    #[doc(hidden)]
    pub fn read(text: &str) -> Result<Self, toml::de::Error> {
        reader::read(text)
    }

    /// Returns the description as a TOML text, with all entries written out. [`Setup::from_toml`] reads it back.
    ///
    /// # Errors
    /// Returns [`SetupError::Refused`] for a seed above 9223372036854775807, which TOML has no number for.
    pub fn to_toml(&self) -> Result<String, SetupError> {
        Ok(writer::table(self).map_err(SetupError::file)?.to_string())
    }
}

/// Keys of earlier versions, and what has taken their place.
const REPLACED: [(&[&str], &str); 8] = [
    (&["method", "integral", "cells"], "this key is now called method.integral.elements"),
    (&["method", "layers", "cells"], "this key is now called method.layers.elements"),
    (&["solids", "skin"], "this key is now called solids.surface-elasticity"),
    (
        &["method", "grid", "contrast"],
        "a sharp contrast is computed by [method.integral] or [method.layers], an arithmetic one by [method.grid] with \
         corrected = false: take the entry away",
    ),
    (&["method", "grid", "layers"], "set nodes and elements in [method.layers] instead"),
    (
        &["method", "grid", "filter"],
        "each droplet has its own filter. Use \
         droplets.motion.equidistributed = { relaxation = 50.0, filter = false }, or \
         take the entry away",
    ),
    (
        &["solids", "surface"],
        "where surfaces of solids are layers the method is [method.layers], where they are plain [method.grid] with \
         corrected = false: take the entry away",
    ),
    (&["rigid"], "rigid walls are entries of the list [[walls]]"),
];

/// Returns the first key of an earlier version in a text, and what has taken its place.
fn replaced(text: &str) -> Option<SetupError> {
    let table = toml::Value::Table(text.parse().ok()?);
    REPLACED.iter().find_map(|(keys, remedy)| {
        let (key, value) = entry(&table, keys)?;
        Some(SetupError::Value { key, value, remedy: (*remedy).to_owned() })
    })
}

/// Returns the place and value of the first entry at a path of keys, whose lists are searched.
fn entry(value: &toml::Value, keys: &[&str]) -> Option<(String, String)> {
    let Some((first, rest)) = keys.split_first() else { return Some((String::new(), value.to_string())) };
    if let toml::Value::Array(list) = value {
        let found = |(number, value)| entry(value, keys).map(|(key, found)| (format!("[{number}].{key}"), found));
        return list.iter().enumerate().find_map(found);
    }
    let (key, found) = entry(value.get(first)?, rest)?;
    let dot = if key.is_empty() || key.starts_with('[') { "" } else { "." };
    Some((format!("{first}{dot}{key}"), found))
}
