//! The page of all keys of a scene file, docs/reference/scene-keys.md, written from the annotated scene.
//!
//! `studies -- pages` writes it, `studies -- pages --check` and a test compare.

use std::fmt::Write as _;
use std::fs;

use anyhow::{Context, Result, ensure};
use motile::setup::Setup;

use crate::tables::root;

const PAGE: &str = "docs/reference/scene-keys.md";
/// Widest line.
const WIDEST: usize = 120;
const HEAD: &str = "# Keys of a scene

A scene file is TOML. This page lists every key with its dimension and its default. It is written from
[the annotated scene](../../crates/motile/scene.toml), which `motile new all.toml --all` gives you as a file.

* If you leave a key out, it has its default. A key that does not exist is an error.
* You may use any consistent units. The defaults are in Cowley's units: lengths in R0 = 10 µm, times in 10 s, line
  tensions in 10 Pa µm, stresses in 1 Pa, viscosities in 10 Pa s.
* Give all quantities in the same units. For example, if you give lengths in µm (a radius of 10), convert every other
  quantity too.
* A force is a line tension, also in three dimensions, where it is a force per length of a line on the surface.
* A dimension stands in parentheses behind its quantity. Below each key you see a value, and other values that may take
  its place.
* In Python the keys are the same, with `_` in place of `-`. With `--set` of [the program](program.md), an entry of a
  list has a number: `droplets.0.centre`.
";

/// Titles of sections by the path that their keys begin with.
const SECTIONS: [(&str, &str); 10] = [
    ("", "The scene"),
    ("droplets", "Droplets"),
    ("droplets.particles", "Particles"),
    ("droplets.gel", "A gel in a droplet"),
    ("suspension", "Suspensions"),
    ("solids", "Elastic solids"),
    ("rigid-bodies", "Rigid bodies"),
    ("shells", "Shells"),
    ("interfaces", "Interfaces along x"),
    ("gels", "A gel in a box"),
];

/// What the annotated scene says of some keys: a comment and the lines after it.
#[derive(Debug, Default, PartialEq)]
struct Group {
    section: String,
    text: String,
    /// Lines of values, with the whole path of their keys.
    values: Vec<String>,
}

/// Writes the page, or compares it.
pub(crate) fn page(check: bool) -> Result<()> {
    let (path, text) = (root().join(PAGE), text(Setup::ANNOTATED)?);
    if check {
        let kept = fs::read_to_string(&path).with_context(|| path.display().to_string())?;
        ensure!(kept == text, "{PAGE} has other keys than crates/motile/scene.toml: run `studies -- pages`");
        return Ok(());
    }
    Ok(fs::write(path, text)?)
}

/// The page of an annotated scene.
fn text(scene: &str) -> Result<String> {
    let mut page = HEAD.to_owned();
    let mut section = None;
    for group in groups(scene)? {
        if section.as_ref() != Some(&group.section) {
            let known = SECTIONS.iter().find(|(path, _)| *path == group.section);
            let (path, title) = known.with_context(|| format!("no title of the section {}", group.section))?;
            let lists = path.contains('.') || path.is_empty() || *path == "suspension";
            let _ = write!(page, "\n## {title}\n");
            if !lists {
                let _ = write!(page, "\nAny number of entries `[[{path}]]`.\n");
            }
            section = Some(group.section.clone());
        }
        page += &shown(&group);
    }
    Ok(page)
}

fn groups(scene: &str) -> Result<Vec<Group>> {
    let mut found: Vec<Group> = Vec::new();
    let (mut path, mut text, mut fresh) = (String::new(), String::new(), false);
    // The first paragraph is about the file.
    for line in scene.lines().skip_while(|line| !line.is_empty()) {
        if let Some(value) = line.strip_prefix("#| ") {
            add(&mut found, &mut text, &mut fresh, &path, value);
        } else if let Some(more) = line.strip_prefix("# ") {
            text += if text.is_empty() { "" } else { " " };
            text += more;
            fresh = true;
        } else if let Some(header) = line.strip_prefix('[') {
            header.trim_matches(['[', ']']).clone_into(&mut path);
            // What stands before a header is about all of the section.
            (text, fresh) = (String::new(), false);
        } else if !line.is_empty() {
            let whole = if path.is_empty() { line.to_owned() } else { format!("{path}.{line}") };
            // A second entry of a list repeats keys.
            if fresh || !known(&found, &whole) {
                add(&mut found, &mut text, &mut fresh, &path, &whole);
            }
        }
    }
    ensure!(text.is_empty(), "no value after: {text}");
    Ok(found)
}

fn known(found: &[Group], line: &str) -> bool {
    let key = |line: &str| line.split(" = ").next().map(str::to_owned);
    found.iter().flat_map(|group| &group.values).any(|value| key(value) == key(line))
}

/// Adds a line of a value to the last group, or to a new one if a comment stands before it.
fn add(found: &mut Vec<Group>, text: &mut String, fresh: &mut bool, path: &str, line: &str) {
    if *fresh || found.is_empty() {
        let first = line.split([' ', '.']).next().unwrap_or_default();
        let alone = SECTIONS.iter().any(|(section, _)| *section == first) && !path.starts_with(first);
        let outside = !path.is_empty() && !line.starts_with(path);
        let section = match (alone, outside) {
            (true, _) => first.to_owned(),
            (false, true) => String::new(),
            (false, false) => path.to_owned(),
        };
        found.push(Group { section, text: std::mem::take(text), values: Vec::new() });
        *fresh = false;
    }
    if let Some(group) = found.last_mut() {
        group.values.push(line.to_owned());
    }
}

/// The keys of a group as a heading, what they mean, and their values.
fn shown(group: &Group) -> String {
    let mut keys: Vec<&str> = Vec::new();
    for key in group.values.iter().filter_map(|value| value.split(" = ").next()) {
        // A longer path is one of the values of a shorter one.
        let is_part = |one: &str, other: &str| one.strip_prefix(other).is_some_and(|rest| rest.starts_with('.'));
        if !keys.iter().any(|known| key == *known || is_part(key, known)) {
            keys.retain(|known| !is_part(known, key));
            keys.push(key);
        }
    }
    let title: Vec<String> = keys.iter().map(|key| format!("`{key}`")).collect();
    let mut out = format!("\n### {}\n\n", title.join(", "));
    let (mut prose, mut items) = (String::new(), Vec::new());
    for sentence in sentences(&group.text) {
        match sentence.split_once(": ") {
            Some((name, rest)) if is_key(name) => items.push(format!("* `{name}`: {rest}")),
            // What follows an item is about it.
            _ => {
                let place = items.last_mut().unwrap_or(&mut prose);
                *place += if place.is_empty() { "" } else { " " };
                *place += &sentence;
            }
        }
    }
    for (k, paragraph) in std::iter::once(&prose).chain(&items).enumerate().filter(|(_, text)| !text.is_empty()) {
        out += &wrapped(paragraph, if k == 0 { "" } else { "  " });
        if k == 0 && !items.is_empty() {
            out.push('\n');
        }
    }
    let _ = write!(out, "\n```text\n{}\n```\n", group.values.join("\n"));
    out
}

fn is_key(name: &str) -> bool {
    name.split(" and ").all(|name| !name.is_empty() && name.chars().all(|c| c.is_ascii_lowercase() || c == '-'))
}

fn sentences(text: &str) -> Vec<String> {
    let mut out: Vec<String> = text.split(". ").map(|sentence| format!("{sentence}.")).collect();
    if let Some(last) = out.last_mut() {
        last.pop();
    }
    out
}

/// A paragraph in lines that are not too long, the later ones indented.
fn wrapped(text: &str, indent: &str) -> String {
    let (mut out, mut width) = (String::new(), 0);
    for word in text.split_whitespace() {
        let length = word.chars().count();
        if width > 0 && width + 1 + length > WIDEST {
            out = out + "\n" + indent;
            width = indent.len();
        } else if width > 0 {
            out.push(' ');
            width += 1;
        }
        out += word;
        width += length;
    }
    out + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_have_their_keys_with_all_values() {
        let scene = "# About the file.\n\n# A (length). Default 1.\na = 1.0\n#| a = 2.0\n\n# Many.\n[[droplets]]\n\
                     # Name.\nname = \"x\"\n\n# Things. b: is (time), default 2. c: too.\n[droplets.particles]\n# Two. \
                     b: is (time). It is long.\nb = 2\n[[droplets]]\nname = \"y\"\n\n# Walls.\n#| walls = []\n";
        let found = groups(scene).unwrap();
        let sections: Vec<&str> = found.iter().map(|group| group.section.as_str()).collect();
        assert_eq!(sections, ["", "droplets", "droplets.particles", ""]);
        assert_eq!(found[0].values, ["a = 1.0", "a = 2.0"]);
        assert_eq!(found[1].values, ["droplets.name = \"x\""]);
        let expected = "\n### `droplets.particles.b`\n\nTwo.\n\n* `b`: is (time). It is long.\n\n```text\n\
                        droplets.particles.b = 2\n```\n";
        assert_eq!(shown(&found[2]), expected);
        assert!(groups("\n# A comment without a value.\n").is_err());
    }

    #[test]
    fn the_page_has_every_key() {
        let page = text(Setup::ANNOTATED).unwrap();
        let is_part = |c: char| c.is_ascii_alphanumeric() || c == '-';
        let words: std::collections::BTreeSet<&str> = page.split(|c: char| !is_part(c)).collect();
        let keys = motile_cli::keys::all();
        assert!(keys.len() > 300, "{}", keys.len());
        for key in keys {
            let last = key.rsplit('.').next().unwrap_or_default();
            assert!(words.contains(last), "{key}");
        }
    }
}
