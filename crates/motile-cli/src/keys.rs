//! Entries of scenes by their keys, such as `droplets.0.particles.activity`.
//!
//! Which keys there are, and which of them exclude one another, is what the types of a [`Setup`] say when they are
//! read: there is no second list of them.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow, bail, ensure};
use clap::Args;
use motile::setup::Setup;
use toml::{Table, Value};

/// Key that no part of a scene has.
const NO_KEY: &str = "no-such-key";
/// End of what is expected where one number stands for the two of both walls.
const PAIR: &str = "or two: [lower, upper]";
/// Most keys that a message suggests.
const SUGGESTED: usize = 3;

/// Scene file and other values of its entries.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct SceneFlags {
    /// Scene file (TOML)
    #[arg(value_name = "SCENE")]
    pub file: PathBuf,
    /// Another value of an entry, such as droplets.0.particles.activity=-4 or region=plane; may be repeated
    #[arg(long, value_name = "KEY=VALUE", value_parser = assignment)]
    pub set: Vec<(String, Value)>,
}

impl SceneFlags {
    /// Returns the scene of the file with these values.
    ///
    /// # Errors
    /// Returns the errors of [`scene_of`].
    pub fn setup(&self) -> Result<Setup> {
        scene_of(&self.file, &self.set)
    }

    /// Returns the name of the scene: the name of the file without its ending.
    #[must_use]
    pub fn name(&self) -> String {
        self.file.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    }
}

/// Kind of a value of a scene.
#[derive(Debug, PartialEq)]
enum Kind {
    /// Table with some of these keys.
    Table(Vec<String>),
    /// One of these names, which exclude one another: as a word, or as the only key of a table.
    OneOf(Vec<String>),
    /// List, of that length if only one is possible.
    List(Option<usize>),
    /// Value without entries: what is expected of it.
    Leaf(String),
}

/// Reads `KEY=VALUE`. The value is TOML; a word that is none is a text.
///
/// # Errors
/// Returns an error for a text without `=`, or a value that is neither TOML nor a word.
pub fn assignment(text: &str) -> Result<(String, Value), String> {
    let Some((key, value)) = text.split_once('=') else {
        return Err("must be KEY=VALUE, such as droplets.0.particles.activity=-4".to_owned());
    };
    let (key, value) = (key.trim().to_owned(), value.trim());
    let read = format!("value = {value}").parse::<Table>().ok().and_then(|mut table| table.remove("value"));
    let is_word = !value.is_empty() && !value.contains(['[', ']', '{', '}', '"', '\'', '=', ',', '\n']);
    match read.or_else(|| is_word.then(|| Value::String(value.to_owned()))) {
        Some(value) => Ok((key, value)),
        None => Err(format!("{value:?} must be a value as in a scene file: a number, a word, [1, 2] or {{ key = 1 }}")),
    }
}

/// Returns the text of a file of a scene or of a plan.
///
/// # Errors
/// Returns an error for a file that cannot be read.
pub fn text_of(path: &Path) -> Result<String> {
    // A device could go on for ever.
    ensure!(!path.exists() || path.is_file(), "this is not a file. Use the path of a file");
    fs::read_to_string(path).map_err(|error| match error.kind() {
        ErrorKind::NotFound => anyhow!("there is no such file. Check the path"),
        ErrorKind::InvalidData => anyhow!("the file is not text. Use a file in TOML"),
        _ => error.into(),
    })
}

/// Returns the scene of a file with other values of some entries, checked. A scene in which nothing moves is refused.
///
/// # Errors
/// Returns an error for a file that cannot be read or is not a scene; keys and values that are refused by [`set`].
pub fn scene_of(path: &Path, assignments: &[(String, Value)]) -> Result<Setup> {
    let read = || -> Result<Setup> {
        let mut table = table_in(&text_of(path)?, path.parent().unwrap_or(Path::new("")))?;
        assignments.iter().try_for_each(|(key, value)| set(&mut table, key, value.clone()))?;
        let setup = setup_of(&table)?;
        let Setup { droplets, suspension, solids, rigid_bodies, shells, fibres, gels, interfaces, .. } = &setup;
        let bodies = [suspension.len(), solids.len(), rigid_bodies.len(), shells.len(), gels.len(), interfaces.len()];
        let moves = droplets.len() + fibres.len() + bodies.iter().sum::<usize>() > 0;
        ensure!(
            moves,
            "nothing moves in this scene. Add [[droplets]], a [[suspension]], [[interfaces]] or other bodies"
        );
        Ok(setup)
    };
    read().with_context(|| path.display().to_string())
}

/// Returns the table of a scene in which every entry is written out that has a value.
///
/// # Errors
/// Returns an error for a text that is not a scene; a scene may break rules that other entries can mend.
pub fn table_of(text: &str) -> Result<Value> {
    match Setup::read(text) {
        Ok(setup) => written_out(&setup),
        // With the line, and what has taken the place of keys of earlier versions.
        Err(error) => Err(Setup::from_toml(text).map(drop).err().map_or(error.into(), Into::into)),
    }
}

/// Returns the table of a scene as [`table_of`], with the paths of files as seen from the directory of the program,
/// where they were relative to `directory`.
///
/// # Errors
/// Returns the errors of [`table_of`].
pub fn table_in(text: &str, directory: &Path) -> Result<Value> {
    match Setup::read(text) {
        Ok(setup) => written_out(&setup.with_paths_from(directory)),
        Err(_) => table_of(text),
    }
}

/// Returns the scene of a table, checked. Files that entries name are relative to the directory of the program.
///
/// # Errors
/// Returns an error for an entry that lacks others, or a rule of [`Setup::check`] that is broken.
pub fn setup_of(table: &Value) -> Result<Setup> {
    // The text of the error would show lines that nobody wrote.
    let setup = read(table).map_err(|error| anyhow!(in_words(error.message())))?;
    setup.check()?;
    Ok(setup.with_files(Path::new(""))?)
}

/// Returns the scene of a table, which may break rules. It reads the text of the table, because the reader of texts is
/// compiled already.
///
/// # Errors
/// Returns an error for an entry that lacks others, or has another kind than the scene's.
pub(crate) fn read(table: &Value) -> Result<Setup, toml::de::Error> {
    // A value that is a table would be written as one within braces.
    Setup::read(&table.as_table().map_or_else(|| table.to_string(), Table::to_string))
}

/// Returns the table of a scene in which every entry is written out that has a value.
///
/// # Errors
/// Returns an error for a seed that TOML has no number for.
pub fn written_out(setup: &Setup) -> Result<Value> {
    Ok(Value::Table(setup.to_toml()?.parse()?))
}

/// Sets an entry of the table of a scene. Tables on the way to it are made if they do not exist; of values that exclude
/// one another, such as regions, the new one replaces the one that was there. A number in a list is the
/// number of an entry that exists, or the next one.
///
/// # Errors
/// Returns an error for a key that does not exist, with the nearest ones that do; a value of another kind than the key
/// has.
pub fn set(scene: &mut Value, key: &str, value: Value) -> Result<()> {
    let dotted = key.replace('[', ".").replace(']', "");
    let parts: Vec<&str> = dotted.split('.').collect();
    let (mut place, mut in_pair) = (scene, false);
    for (depth, part) in parts.iter().enumerate() {
        let above = parts[..depth].join(".");
        place = match kind(&parts[..depth]) {
            Kind::Table(names) | Kind::OneOf(names) if !names.iter().any(|name| name == part) => {
                bail!(unknown(&parts, depth))
            }
            Kind::Table(_) => entries(place).entry(*part).or_insert_with(empty),
            Kind::OneOf(_) => {
                let table = entries(place);
                table.retain(|name, _| name == *part);
                table.entry(*part).or_insert_with(empty)
            }
            Kind::List(length) => {
                let Ok(number) = part.parse::<usize>() else { bail!(unknown(&parts, depth)) };
                if !place.is_array() {
                    *place = Value::Array(Vec::new());
                }
                let Value::Array(list) = place else {
                    bail!("{above} is not a list. Set the whole value of {above} instead")
                };
                let count = list.len();
                let most = length.unwrap_or(count + 1).min(count + 1);
                ensure!(
                    number < most,
                    "{key}: the list {above} has {count} entries. Use a number from 0 to {}",
                    most - 1
                );
                if number == count {
                    list.push(empty());
                }
                &mut list[number]
            }
            // One number for several, such as the slip length of both walls, becomes their list.
            Kind::Leaf(expected)
                if part.parse::<usize>().is_ok_and(|number| number < 2) && expected.ends_with(PAIR) =>
            {
                if place.as_array().is_none_or(|list| list.len() != 2) {
                    let both = if place.is_table() { Value::Float(0.0) } else { place.clone() };
                    *place = Value::Array(vec![both; 2]);
                }
                in_pair = true;
                &mut place[usize::from(*part == "1")]
            }
            Kind::Leaf(expected) => {
                bail!("{key}: {above} is {expected}, so it has no keys below it. Set {above} itself")
            }
        };
    }
    // Numbers that a range made are whole where the scene has whole ones.
    let value = match (&*place, value) {
        (Value::Integer(_), Value::Float(number)) if number.fract() == 0.0 => Value::Integer(number as i64),
        (Value::Float(_), Value::Integer(number)) => Value::Float(number as f64),
        (_, value) => value,
    };
    let checked = if in_pair { &parts[..parts.len() - 1] } else { &parts[..] };
    if let Some(problem) = problem(checked, value.clone()) {
        // Entries that belong together come one after the other, unless a whole list is given.
        let is_part =
            problem.starts_with("missing field") || problem.starts_with("invalid length") && !value.is_array();
        ensure!(is_part, "{key} = {value}: {}", in_words(&problem));
    }
    *place = value;
    Ok(())
}

/// Returns all keys of scenes, entries of lists with the number 0.
#[must_use]
pub fn all() -> Vec<String> {
    let mut found = Vec::new();
    collect(&mut Vec::new(), &mut Vec::new(), &mut found);
    found
}

/// Adds the keys below a path. The names at each table on the way are in `above`: gradings hold gradings, of which two
/// are enough.
fn collect(path: &mut Vec<String>, above: &mut Vec<Vec<String>>, found: &mut Vec<String>) {
    match kind(path) {
        Kind::Table(names) | Kind::OneOf(names) if above.iter().filter(|known| **known == names).count() < 2 => {
            above.push(names.clone());
            for name in names {
                path.push(name);
                found.push(path.join("."));
                collect(path, above, found);
                path.pop();
            }
            above.pop();
        }
        Kind::List(_) => {
            path.push("0".to_owned());
            collect(path, above, found);
            path.pop();
        }
        _ => {}
    }
}

fn empty() -> Value {
    Value::Table(Table::new())
}

/// Returns the entries of a value, which becomes a table if it is none.
fn entries(place: &mut Value) -> &mut Table {
    if !place.is_table() {
        *place = empty();
    }
    place.as_table_mut().expect("a table, since it was made one")
}

/// Returns the problem of a scene that has nothing but a value at a path.
fn problem(path: &[impl AsRef<str>], value: Value) -> Option<String> {
    let scene = path.iter().rev().fold(value, |value, part| match part.as_ref() {
        part if part.parse::<usize>().is_ok() => Value::Array(vec![value]),
        part => Value::Table(Table::from_iter([(part.to_owned(), value)])),
    });
    read(&scene).err().map(|error| error.message().to_owned())
}

/// Returns the kind of the value at a path, which the error about a key that it cannot have shows.
fn kind(path: &[impl AsRef<str>]) -> Kind {
    let said = problem(path, Value::Table(Table::from_iter([(NO_KEY.to_owned(), Value::Integer(0))])));
    let said = said.unwrap_or_default();
    let (found, expected) = said.split_once("expected ").unwrap_or((&said, ""));
    let names = || expected.split('`').skip(1).step_by(2).map(str::to_owned).collect();
    if found.starts_with("unknown field") {
        Kind::Table(names())
    } else if found.starts_with("unknown variant") {
        Kind::OneOf(names())
    } else if let Some(length) = expected.strip_prefix("an array of length ") {
        Kind::List(length.parse().ok())
    } else if expected.contains("sequence") {
        Kind::List(None)
    } else {
        Kind::Leaf(in_words(expected))
    }
}

/// Returns the message about a key whose part at that depth does not exist, with the nearest keys.
fn unknown(parts: &[&str], depth: usize) -> String {
    let is_number = |part: &str| part.parse::<usize>().is_ok();
    let mut near = Vec::new();
    for other in all() {
        // The numbers are those of the wrong key.
        let numbered = other.split('.').enumerate().map(|(k, part)| match parts.get(k) {
            Some(number) if is_number(part) && is_number(number) => *number,
            _ => part,
        });
        let numbered: Vec<&str> = numbered.collect();
        near.push((distance(parts, &numbered), numbered.join(".")));
    }
    near.sort_by(|one, other| one.0.total_cmp(&other.0));
    let near: Vec<&str> = near.iter().take(SUGGESTED).map(|(_, key)| key.as_str()).collect();
    let above = if depth == 0 { "a scene".to_owned() } else { parts[..depth].join(".") };
    let (key, part) = (parts.join("."), parts[depth]);
    format!("there is no key {key}, because {above} has no {part}. The nearest keys are {}", near.join(", "))
}

/// Returns the edit distance of two keys (no dimension), part by part: a part that was left out counts less than one
/// too many or another one.
fn distance(wrong: &[&str], right: &[&str]) -> f64 {
    const LEFT_OUT: f64 = 0.4;
    let mut row: Vec<f64> = (0..=right.len()).map(|k| LEFT_OUT * k as f64).collect();
    for (i, part) in wrong.iter().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], (i + 1) as f64);
        for (j, other) in right.iter().enumerate() {
            let replaced = diagonal + 2.0 * (1.0 - strsim::normalized_levenshtein(part, other));
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + LEFT_OUT).min(row[j + 1] + 1.0);
        }
    }
    row[right.len()]
}

/// Returns the message about a value in the words of the user, without names of types.
pub(crate) fn in_words(problem: &str) -> String {
    let unknown = problem.contains("unknown field ") || problem.contains("unknown variant ");
    let words = [
        ("f64", "a number"),
        ("usize", "a whole number that is not negative"),
        ("u64", "a whole number that is not negative"),
        ("u32", "a whole number that is not negative"),
        ("i64", "a whole number"),
        ("a sequence", "a list"),
        ("an array of length", "a list of length"),
        ("floating point `", "the number `"),
        ("integer `", "the number `"),
        ("boolean `", "the truth value `"),
        ("string \"", "the text \""),
        ("missing field ", "missing required key "),
        ("unknown field ", "there is no key "),
        ("unknown variant ", "there is no choice "),
        (", expected one of ", ". Use one of "),
        (", expected ", if unknown { ". Use " } else { " cannot be used. Use " }),
        ("invalid length ", "the length "),
        ("invalid type: ", ""),
        ("invalid value: ", ""),
    ];
    words.iter().fold(problem.to_owned(), |text, (name, words)| text.replace(name, words))
}

#[cfg(test)]
mod tests;
