//! What figures are drawn on, and what all of them have: lines, areas, text, axes. Positions are in pixels from the
//! upper left corner.

pub(crate) mod axes;
pub(crate) mod canvas;
pub(crate) mod font;
pub(crate) mod svg;
pub(crate) mod ticks;

use crate::Rgb;

/// A position on a surface: pixels to the right and pixels down from the upper left corner.
pub(crate) type Pixel = [f64; 2];

/// An upright rectangle on a surface (pixels).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rect {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) width: f64,
    pub(crate) height: f64,
}

impl Rect {
    pub(crate) fn right(&self) -> f64 {
        self.left + self.width
    }

    pub(crate) fn bottom(&self) -> f64 {
        self.top + self.height
    }

    /// The same with its edges on whole pixels.
    pub(crate) fn rounded(self) -> Self {
        let [left, top, width, height] = [self.left, self.top, self.width, self.height].map(f64::round);
        Self { left, top, width, height }
    }

    /// The corners, counter-clockwise as seen, from the upper left one and back to it.
    pub(crate) fn outline(&self) -> Vec<Pixel> {
        let (l, t, r, b) = (self.left, self.top, self.right(), self.bottom());
        vec![[l, t], [l, b], [r, b], [r, t], [l, t]]
    }
}

/// How a line is drawn: colour, width (pixels), opacity from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pen {
    pub(crate) colour: Rgb,
    pub(crate) width: f64,
    pub(crate) opacity: f64,
}

impl Pen {
    /// A solid, opaque line.
    pub(crate) fn new(colour: Rgb, width: f64) -> Self {
        Self { colour, width, opacity: 1.0 }
    }

    pub(crate) fn opacity(self, opacity: f64) -> Self {
        Self { opacity, ..self }
    }
}

/// Which end of a text its position is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// How a text is set. Its position is a point of the line halfway up the capitals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TextStyle {
    /// Size of the type (pixels): capitals are 0.7 times as high.
    pub(crate) size: f64,
    pub(crate) colour: Rgb,
    pub(crate) anchor: Anchor,
    /// Whether it reads upwards, as the label of a vertical axis does.
    pub(crate) upwards: bool,
}

impl TextStyle {
    /// Text of a size in [`Rgb::INK`].
    pub(crate) fn new(size: f64, anchor: Anchor) -> Self {
        Self { size, colour: Rgb::INK, anchor, upwards: false }
    }

    pub(crate) fn upwards(self) -> Self {
        Self { upwards: true, ..self }
    }
}

/// Something to draw on: [`canvas::Canvas`] (pixels, for PNG and GIF) and [`svg::Svg`] (vectors). A plot is described
/// once and drawn on either.
pub(crate) trait Surface {
    /// Lines through `paths`, with round ends and joints; `label` says what they are, for search and screen readers.
    fn strokes(&mut self, paths: &[Vec<Pixel>], label: &str, pen: &Pen);

    /// The area inside the closed curves `rings` (even-odd rule: a ring within a ring is a hole).
    fn fill(&mut self, rings: &[Vec<Pixel>], colour: Rgb, opacity: f64);

    /// Restricts what follows to a rectangle, or (`None`) lifts the restriction.
    fn clip(&mut self, to: Option<Rect>);

    /// A line through `path`.
    fn stroke(&mut self, path: &[Pixel], pen: &Pen) {
        self.strokes(&[path.to_vec()], "", pen);
    }

    /// A line with lengths of dash and gap (pixels).
    fn dashed(&mut self, path: &[Pixel], pen: &Pen, pattern: [f64; 2]) {
        self.strokes(&dashes(path, pattern), "", pen);
    }

    /// A line of text; `_{...}` and `^{...}` lower and raise what is in the braces.
    fn text(&mut self, at: Pixel, text: &str, style: &TextStyle) {
        let (strokes, weight) = font::place(text, at, style);
        self.strokes(&strokes, text, &Pen::new(style.colour, weight));
    }
}

/// Cuts a path into the dashes of a pattern of dash and gap lengths.
fn dashes(path: &[Pixel], [dash, gap]: [f64; 2]) -> Vec<Vec<Pixel>> {
    let mut pieces = Vec::new();
    let mut piece: Vec<Pixel> = path.first().map(|&p| vec![p]).unwrap_or_default();
    let (mut drawing, mut left) = (true, dash.max(0.1));
    for pair in path.windows(2) {
        let (mut from, to) = (pair[0], pair[1]);
        loop {
            let length = (to[0] - from[0]).hypot(to[1] - from[1]);
            if length < left {
                left -= length;
                if drawing {
                    piece.push(to);
                }
                break;
            }
            let t = left / length;
            from = [from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])];
            if drawing {
                piece.push(from);
                pieces.push(std::mem::take(&mut piece));
            } else {
                piece = vec![from];
            }
            drawing = !drawing;
            left = if drawing { dash } else { gap }.max(0.1);
        }
    }
    if drawing && piece.len() > 1 {
        pieces.push(piece);
    }
    pieces
}

#[cfg(test)]
mod tests;
