//! The crates and what each uses, from their manifests.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

use anyhow::{Context, Result};
use motile::base::Vec2;
use toml::Table;

use super::svg::{BLUE, Drawing, INK};
use crate::tables::root;

/// Width and height of a box, distances of boxes and of rows.
const BOX: Vec2 = Vec2::new(2.5, 0.5);
const APART: f64 = 0.35;
const ROWS: f64 = 1.05;

type Uses = BTreeMap<String, BTreeSet<String>>;

/// For each crate of the library the crates of the library that its manifest names.
fn uses() -> Result<Uses> {
    let mut manifests: BTreeMap<String, Table> = BTreeMap::new();
    for entry in fs::read_dir(root().join("crates"))? {
        let folder = entry?.path();
        let text = fs::read_to_string(folder.join("Cargo.toml")).with_context(|| folder.display().to_string())?;
        manifests.insert(folder.file_name().unwrap_or_default().to_string_lossy().into_owned(), text.parse()?);
    }
    let used = |manifest: &Table| -> BTreeSet<String> {
        let names = manifest.get("dependencies").and_then(|list| list.as_table()).into_iter().flat_map(Table::keys);
        names.filter(|name| manifests.contains_key(*name)).cloned().collect()
    };
    Ok(manifests.iter().map(|(name, manifest)| (name.clone(), used(manifest))).collect())
}

/// All that a crate uses, directly or not.
fn all(uses: &Uses, name: &str) -> BTreeSet<String> {
    let direct = uses.get(name).into_iter().flatten();
    direct.flat_map(|used| all(uses, used).into_iter().chain([used.clone()])).collect()
}

/// Longest way down.
fn level(uses: &Uses, name: &str) -> usize {
    uses.get(name).into_iter().flatten().map(|used| level(uses, used) + 1).max().unwrap_or(0)
}

pub(super) fn picture() -> Result<String> {
    let uses = uses()?;
    let mut rows: Vec<Vec<&String>> = Vec::new();
    for name in uses.keys() {
        let level = level(&uses, name);
        rows.resize(rows.len().max(level + 1), Vec::new());
        rows[level].push(name);
    }
    let widest = rows.iter().map(Vec::len).max().unwrap_or(0) as f64;
    let size = Vec2::new(widest * (BOX.x + APART), rows.len() as f64 * ROWS);
    let mut drawing = Drawing::new(Vec2::ZERO, size, 64.0);
    // What another used crate brings along is not drawn.
    let drawn = |name: &String| {
        let used = &uses[name];
        used.iter().filter(|below| !used.iter().any(|other| all(&uses, other).contains(*below))).collect::<Vec<_>>()
    };
    let mut places: BTreeMap<&String, Vec2> = BTreeMap::new();
    for (level, row) in rows.iter().enumerate() {
        for (k, name) in row.iter().enumerate() {
            let aside = k as f64 - 0.5 * (row.len() as f64 - 1.0);
            let used = drawn(name);
            // A crate alone on its level stands above what it uses.
            let x = if row.len() == 1 && !used.is_empty() {
                used.iter().map(|used| places[*used].x).sum::<f64>() / used.len() as f64
            } else {
                0.5 * size.x + aside * (BOX.x + APART)
            };
            places.insert(*name, Vec2::new(x, (level as f64 + 0.5) * ROWS));
        }
    }
    for name in uses.keys() {
        for below in drawn(name) {
            let (from, to) = (places[name] - Vec2::new(0.0, 0.5 * BOX.y), places[below] + Vec2::new(0.0, 0.5 * BOX.y));
            drawing.arrow(from, to - from, INK, 1.2);
        }
    }
    for (name, at) in places {
        let corner = |x: f64, y: f64| at + 0.5 * BOX * Vec2::new(x, y);
        let outline = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0), corner(-1.0, -1.0)];
        drawing.area(&outline, "#f7f7f7");
        drawing.line(&outline, BLUE, 1.6, false);
        drawing.text(at - Vec2::new(0.0, 0.06), name, INK, 14.0);
    }
    Ok(drawing.finish())
}
