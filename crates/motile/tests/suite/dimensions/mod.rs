//! Dimensions of the keys of scene files, from their reference.

use std::collections::{BTreeMap, HashSet};

use toml::Value;

/// Powers of length, time and force.
pub(crate) type Dimension = [i32; 3];

/// The dimension of each key with numbers, in two dimensions and in three.
#[derive(Debug)]
pub(crate) struct Dimensions(BTreeMap<String, [Dimension; 2]>);

impl Dimensions {
    /// Dimensions that a reference states: those in parentheses behind the name of a key, in the same sentence of the
    /// comment above it.
    pub(crate) fn of(reference: &str) -> Self {
        let (mut found, mut pending) = (BTreeMap::new(), Vec::new());
        let entries = entries(reference);
        for Entry { keys, comment, block } in &entries {
            // A comment on one key need not name it.
            let about = entries.iter().filter(|entry| entry.block == *block).flat_map(|entry| &entry.keys);
            let about: HashSet<&Vec<String>> = about.collect();
            for path in keys {
                let key = canonical(path);
                let stated = if about.len() == 1 { first_stated(comment) } else { None };
                let of_parents = || path.iter().rev().skip(1).find_map(|name| stated_behind(name, comment));
                match stated_behind(path.last().expect("a key"), comment).or(stated) {
                    Some(dimension) => drop(found.entry(key).or_insert(dimension)),
                    None => pending.push((path.clone(), of_parents())),
                }
            }
        }
        // What is "as of" another key has the dimension of the key with the most names in common at its end.
        for (path, of_parents) in pending {
            let key = canonical(&path);
            if found.contains_key(&key) {
                continue;
            }
            let known = Self(found);
            let last = format!(".{}", path[path.len() - 1]);
            let alike = known.0.iter().find(|(known, _)| known.ends_with(&last)).map(|(_, dimension)| *dimension);
            let dimension = known.get(&path).copied().or(of_parents).or(alike);
            found = known.0;
            found
                .insert(key.clone(), dimension.unwrap_or_else(|| panic!("the reference states no dimension of {key}")));
        }
        Self(found)
    }

    /// Keys that have a dimension.
    pub(crate) fn keys(&self) -> impl Iterator<Item = &String> {
        self.0.iter().filter(|(_, dimension)| **dimension != [[0; 3]; 2]).map(|(key, _)| key)
    }

    /// Dimension of a key, or of the one with the most names in common at its end: walls have the outlines of solids.
    fn get(&self, path: &[String]) -> Option<&[Dimension; 2]> {
        let key = canonical(path);
        let ends = |count: usize| {
            let end = format!(".{}", path[path.len() - count..].join("."));
            self.0.iter().find(|(known, _)| known.ends_with(&end)).map(|(_, dimension)| dimension)
        };
        self.0.get(&key).or_else(|| (2..path.len()).rev().find_map(ends))
    }

    /// Changes all numbers of a description to units that are these powers of two.
    pub(crate) fn scale(&self, description: &mut Value, units: Dimension) {
        let region = &description["region"];
        let space = usize::from(region.as_str() == Some("space") || region.get("tube").is_some());
        visit(description, &mut Vec::new(), &mut |path, numbers| {
            let key = canonical(path);
            let dimension = self.get(path).unwrap_or_else(|| panic!("the reference states no dimension of {key}"));
            let power: i32 = dimension[space].iter().zip(units).map(|(power, unit)| power * unit).sum();
            // Pairs of a place and a factor.
            let pairs = key.ends_with("along.factors");
            let numbers = numbers.iter_mut().step_by(if pairs { 2 } else { 1 });
            numbers.for_each(|number| **number *= 2.0_f64.powi(power));
        });
    }
}

/// The name of a key, without the numbers of lists; the droplets of a suspension are droplets.
pub(crate) fn canonical(path: &[String]) -> String {
    path.join(".").replace("suspension.droplet.", "droplets.")
}

/// Calls `see` with the keys down to each number or list of numbers of a description, whole numbers excepted.
pub(crate) fn visit(value: &mut Value, path: &mut Vec<String>, see: &mut dyn FnMut(&[String], &mut [&mut f64])) {
    match value {
        Value::Table(table) => {
            for (key, value) in table.iter_mut() {
                path.push(key.to_owned());
                visit(value, path, see);
                path.pop();
            }
        }
        Value::Array(list) if list.iter().any(Value::is_table) => {
            list.iter_mut().for_each(|value| visit(value, path, see));
        }
        other => {
            let mut numbers = Vec::new();
            collect(other, &mut numbers);
            if !numbers.is_empty() {
                see(path, &mut numbers);
            }
        }
    }
}

fn collect<'a>(value: &'a mut Value, numbers: &mut Vec<&'a mut f64>) {
    match value {
        Value::Float(number) => numbers.push(number),
        Value::Array(list) => list.iter_mut().for_each(|value| collect(value, numbers)),
        _ => {}
    }
}

/// Keys of a line of the reference, with the comment above it and the number of the comment.
struct Entry {
    keys: Vec<Vec<String>>,
    comment: String,
    block: usize,
}

fn entries(reference: &str) -> Vec<Entry> {
    let (mut entries, mut comment, mut section) = (Vec::new(), String::new(), Vec::new());
    let (mut ended, mut block) = (true, 0);
    for line in reference.lines() {
        if let Some(text) = line.strip_prefix("# ") {
            if std::mem::take(&mut ended) {
                block += 1;
                comment.clear();
            }
            comment += &format!("{text} ");
            continue;
        }
        ended = true;
        if line.starts_with('[') {
            block += 1;
            comment.clear();
            section = line.trim_matches(['[', ']']).split('.').map(str::to_owned).collect();
            continue;
        }
        let (line, mut path) = match line.strip_prefix("#| ") {
            Some(line) => (line, Vec::new()),
            None => (line, section.clone()),
        };
        // Whole numbers are numbers too.
        let mut table: Value = line.parse::<toml::Table>().expect(line).into();
        to_floats(&mut table);
        let mut keys = Vec::new();
        visit(&mut table, &mut path, &mut |path, _| keys.push(path.to_vec()));
        entries.push(Entry { keys, comment: comment.clone(), block });
    }
    entries
}

fn to_floats(value: &mut Value) {
    match value {
        Value::Integer(number) => *value = Value::Float(*number as f64),
        Value::Array(list) => list.iter_mut().for_each(to_floats),
        Value::Table(table) => table.iter_mut().for_each(|(_, value)| to_floats(value)),
        _ => {}
    }
}

/// Dimension in the first parentheses behind a name that are in the same sentence and state one.
fn stated_behind(name: &str, comment: &str) -> Option<[Dimension; 2]> {
    if name.len() < 3 && name != "at" && name != "on" {
        return None;
    }
    let (name, comment) = (name.replace('-', " ").to_lowercase(), comment.to_lowercase());
    let spaced = comment.replace('-', " ");
    let letter = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || "-_".contains(c));
    spaced.match_indices(&name).find_map(|(start, _)| {
        let end = start + name.len();
        let end = if spaced[end..].starts_with('s') { end + 1 } else { end };
        if letter(comment[..start].chars().next_back()) || letter(comment[end..].chars().next()) {
            return None;
        }
        let mut rest = &comment[end..];
        while let Some(open) = rest.find('(') {
            let before = &rest[..open];
            if before.contains(". ") {
                return None;
            }
            let close = closing(&rest[open..]).map(|close| open + close)?;
            if let Some(dimension) = both(&rest[open + 1..close]) {
                return Some(dimension);
            }
            rest = &rest[close..];
        }
        None
    })
}

/// Dimension in the first parentheses that state one.
fn first_stated(comment: &str) -> Option<[Dimension; 2]> {
    comment.match_indices('(').find_map(|(open, _)| {
        let close = closing(&comment[open..])?;
        both(&comment[open + 1..open + close])
    })
}

/// Place of the parenthesis that closes the first one of a text.
fn closing(text: &str) -> Option<usize> {
    let mut depth = 0;
    text.char_indices().find_map(|(place, c)| {
        depth += i32::from(c == '(') - i32::from(c == ')');
        (depth == 0).then_some(place)
    })
}

/// Dimensions in two dimensions and in three of a text such as `force times length; in three dimensions force`.
fn both(text: &str) -> Option<[Dimension; 2]> {
    let (plane, space) = text.split_once("; in three dimensions ").unwrap_or((text, text));
    Some([dimension(plane)?, dimension(space)?])
}

/// Dimension of a text such as `length squared per time`, up to a comma or semicolon.
fn dimension(text: &str) -> Option<Dimension> {
    let text = text.split([',', ';']).next()?.trim();
    if text == "no dimension" || text.starts_with("radians") {
        return Some([0; 3]);
    }
    let (mut sum, mut sign, mut last) = ([0; 3], 1, None);
    for word in text.replace("1/", "1 per ").split_whitespace() {
        let (unit, factor): (Dimension, i32) = match word {
            "times" => continue,
            "per" => {
                sign = -1;
                continue;
            }
            "squared" => (last?, 1),
            "cubed" => (last?, 2),
            "1" => ([0; 3], 1),
            "length" => ([1, 0, 0], 1),
            "area" => ([2, 0, 0], 1),
            "volume" => ([3, 0, 0], 1),
            "time" => ([0, 1, 0], 1),
            "force" => ([0, 0, 1], 1),
            "stress" => ([-1, 0, 1], 1),
            _ => return None,
        };
        last = Some(unit);
        sum.iter_mut().zip(unit).for_each(|(sum, power)| *sum += sign * factor * power);
    }
    last.map(|_| sum)
}
