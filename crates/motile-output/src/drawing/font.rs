//! Text as outlines of the bundled font: pictures need no fonts of the system.
//!
//! The font is a subset of Noto Sans (SIL Open Font License 1.1, `fonts/OFL.txt`): Latin, Greek, signs of mathematics.

use tiny_skia::{Path, PathBuilder, Transform};
use ttf_parser::{Face, GlyphId, OutlineBuilder};

use crate::drawing::shapes::{Anchor, Pixel, TextStyle};

const FONT: &[u8] = include_bytes!("../../fonts/NotoSans-subset.ttf");

/// Size of raised and lowered text relative to the line's.
const SMALL: f64 = 0.72;
/// Heights by which text is raised and lowered, relative to the line's size.
const RAISE: f64 = 0.32;
const LOWER: f64 = 0.17;
/// Height of the capitals relative to the size of the type.
const CAPITAL: f64 = 0.714;

/// Outlines of glyphs side by side: the path so far, the position of the next glyph (pixels; y upwards), and its scale.
struct Pen {
    path: PathBuilder,
    at: Pixel,
    scale: f64,
}

impl Pen {
    fn place(&self, x: f32, y: f32) -> [f32; 2] {
        [(self.at[0] + self.scale * f64::from(x)) as f32, (self.at[1] + self.scale * f64::from(y)) as f32]
    }
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        let [x, y] = self.place(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let [x, y] = self.place(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ([x1, y1], [x, y]) = (self.place(x1, y1), self.place(x, y));
        self.path.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ([x1, y1], [x2, y2], [x, y]) = (self.place(x1, y1), self.place(x2, y2), self.place(x, y));
        self.path.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}

/// Returns the outline of a line of text of a size (pixels) from the origin, y upwards, and its width (pixels).
/// Characters that the font lacks are empty boxes.
fn outline(text: &str, size: f64) -> (PathBuilder, f64) {
    let mut pen = Pen { path: PathBuilder::new(), at: [0.0; 2], scale: 0.0 };
    // The bundled font is read in a test.
    let Ok(face) = Face::parse(FONT, 0) else { return (pen.path, 0.0) };
    for (character, level) in levels(text) {
        let (part, height) = [(SMALL, -LOWER), (1.0, 0.0), (SMALL, RAISE)][(level + 1) as usize];
        (pen.scale, pen.at[1]) = (part * size / f64::from(face.units_per_em()), height * size);
        let glyph = face.glyph_index(character).unwrap_or(GlyphId(0));
        // The table of the bundled font: `Face::outline_glyph` would bring readers of all others.
        face.tables().glyf.and_then(|glyphs| glyphs.outline(glyph, &mut pen));
        pen.at[0] += pen.scale * f64::from(face.glyph_hor_advance(glyph).unwrap_or(0));
    }
    (pen.path, pen.at[0])
}

/// Characters of a text with their levels, 0 on the line, 1 raised, -1 lowered, by `^{...}` and `_{...}`. An unclosed
/// brace runs to the end.
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

/// Outlines of a line of text at its position on a drawing; `None` if it shows nothing.
pub(crate) fn place(text: &str, at: Pixel, style: &TextStyle) -> Option<Path> {
    let (path, width) = outline(text, style.size);
    let shift = match style.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => -0.5 * width,
        Anchor::End => -width,
    };
    let place = Transform::from_translate(at[0] as f32, at[1] as f32)
        .pre_rotate(if style.upwards { -90.0 } else { 0.0 })
        .pre_scale(1.0, -1.0)
        .pre_translate(shift as f32, (-0.5 * CAPITAL * style.size) as f32);
    path.finish()?.transform(place)
}

/// Returns the width of a line of text (pixels).
pub(crate) fn text_width(text: &str, size: f64) -> f64 {
    outline(text, size).1
}

#[cfg(test)]
mod tests;
