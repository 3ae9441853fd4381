//! A stroke font, so that pictures need no fonts of the system: letters as polylines.
//!
//! A glyph is drawn on a grid where capitals are 14 units high, small letters 10, and descenders reach -4.5. A line of
//! `glyphs.txt` is a character, the width of its glyph, a colon, and strokes separated by `|`; a stroke is a list of
//! points `x,y`, of which those marked `~` are control points of quadratic curves (two in a row have an implied point
//! halfway, as in TrueType).

use std::{collections::HashMap, sync::OnceLock};

use crate::drawing::{Anchor, Pixel, TextStyle};

const GLYPHS: &str = include_str!("glyphs.txt");

/// Height of the capitals relative to the size of the type.
const CAPITAL: f64 = 0.7;
/// Units of the grid per size of type.
const UNITS: f64 = 14.0 / CAPITAL;
/// Width of the strokes relative to the size of the type.
const WEIGHT: f64 = 0.082;
/// Space between two letters (units).
const GAP: f64 = 3.6;
/// Width of a space without the gaps (units).
const SPACE: f64 = 2.4;
/// Size of raised and lowered text relative to the line's.
const SMALL: f64 = 0.72;
/// How far raised and lowered text moves, relative to the line's size.
const RAISE: f64 = 0.32;
const LOWER: f64 = 0.17;

/// Polylines, x to the right from the start and y upwards from the base line, and the width of what they draw.
#[derive(Debug, Clone, Default)]
struct Glyph {
    width: f64,
    strokes: Vec<Vec<Pixel>>,
}

/// A line of text of the given size (pixels).
fn outline(text: &str, size: f64) -> Glyph {
    let mut out = Glyph::default();
    let mut pen = 0.0;
    for (c, level) in levels(text) {
        let (scale, base) = match level {
            0 => (size / UNITS, 0.0),
            1 => (SMALL * size / UNITS, RAISE * size),
            _ => (SMALL * size / UNITS, -LOWER * size),
        };
        if c == ' ' {
            pen += (SPACE + GAP) * scale;
            continue;
        }
        let glyph = glyph(c);
        out.strokes.extend(
            glyph.strokes.iter().map(|s| s.iter().map(|p| [pen + p[0] * scale, base + p[1] * scale]).collect()),
        );
        pen += (glyph.width + GAP) * scale;
        out.width = pen - GAP * scale;
    }
    out
}

/// The characters of a text with their levels, 0 on the line, 1 raised, -1 lowered: split at `_{...}` and `^{...}`. An
/// unclosed brace runs to the end.
fn levels(text: &str) -> Vec<(char, i8)> {
    let (mut out, mut level) = (Vec::new(), 0);
    let mut chars = text.chars().peekable();
    while let Some(c) = chars.next() {
        match c {
            '_' | '^' if level == 0 && chars.peek() == Some(&'{') => {
                chars.next();
                level = if c == '^' { 1 } else { -1 };
            }
            '}' if level != 0 => level = 0,
            _ => out.push((c, level)),
        }
    }
    out
}

/// The strokes of a line of text at its place on a surface, and their width (pixels).
pub(crate) fn place(text: &str, at: Pixel, style: &TextStyle) -> (Vec<Vec<Pixel>>, f64) {
    let Glyph { mut strokes, width } = outline(text, style.size);
    let shift = match style.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => -0.5 * width,
        Anchor::End => -width,
    };
    for p in strokes.iter_mut().flatten() {
        let (x, y) = (p[0] + shift, p[1] - 0.5 * CAPITAL * style.size);
        *p = if style.upwards { [at[0] - y, at[1] - x] } else { [at[0] + x, at[1] - y] };
    }
    (strokes, WEIGHT * style.size)
}

/// The width of a line of text (pixels).
pub(crate) fn text_width(text: &str, size: f64) -> f64 {
    outline(text, size).width
}

/// The glyph of a character; an empty box for those the font does not have.
fn glyph(c: char) -> &'static Glyph {
    static FONT: OnceLock<HashMap<char, Glyph>> = OnceLock::new();
    let font =
        FONT.get_or_init(|| GLYPHS.lines().filter_map(|line| Some((line.chars().next()?, parse(line)))).collect());
    font.get(&c).unwrap_or_else(|| &font[&'\u{25a1}'])
}

/// Reads a line of the table; what cannot be read is left out (a unit test reads them all).
fn parse(line: &str) -> Glyph {
    // The character may be the colon.
    let (width, strokes) = line[line.chars().next().map_or(0, char::len_utf8)..].split_once(':').unwrap_or_default();
    Glyph {
        width: width.trim().parse().unwrap_or(0.0),
        strokes: strokes.split('|').map(|stroke| flatten(&points(stroke))).collect(),
    }
}

/// The points of a stroke and whether each is a control point.
fn points(stroke: &str) -> Vec<([f64; 2], bool)> {
    let point = |word: &str| {
        let (x, y) = word.trim_start_matches('~').split_once(',')?;
        Some(([x.parse().ok()?, y.parse().ok()?], word.starts_with('~')))
    };
    stroke.split_whitespace().filter_map(point).collect()
}

/// Replaces the quadratic curves of a stroke by short lines.
fn flatten(points: &[([f64; 2], bool)]) -> Vec<[f64; 2]> {
    const PIECES: usize = 8;
    let mut line: Vec<[f64; 2]> = Vec::new();
    for (k, &(p, control)) in points.iter().enumerate() {
        if !control {
            line.push(p);
            continue;
        }
        let (Some(&from), Some(&(next, next_control))) = (line.last(), points.get(k + 1)) else { continue };
        let to = if next_control { [0.5 * (p[0] + next[0]), 0.5 * (p[1] + next[1])] } else { next };
        for piece in 1..=PIECES {
            let t = piece as f64 / PIECES as f64;
            let (a, b, c) = ((1.0 - t) * (1.0 - t), 2.0 * t * (1.0 - t), t * t);
            line.push([a * from[0] + b * p[0] + c * to[0], a * from[1] + b * p[1] + c * to[1]]);
        }
    }
    line
}

#[cfg(test)]
mod tests;
