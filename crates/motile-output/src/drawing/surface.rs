//! What figures are drawn on: lines, areas and text, in pixels from the upper left corner.

use crate::Rgb;

/// A position on a surface: pixels to the right and pixels down from the upper left corner.
pub type Pixel = [f64; 2];

/// An upright rectangle on a surface (pixels).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rect {
    /// Left edge.
    pub left: f64,
    /// Upper edge.
    pub top: f64,
    /// Width.
    pub width: f64,
    /// Height.
    pub height: f64,
}

impl Rect {
    /// Right edge.
    #[must_use]
    pub fn right(&self) -> f64 {
        self.left + self.width
    }

    /// Lower edge.
    #[must_use]
    pub fn bottom(&self) -> f64 {
        self.top + self.height
    }

    /// The corners, counter-clockwise as seen, from the upper left one and back to it.
    #[must_use]
    pub fn outline(&self) -> [Pixel; 5] {
        let (l, t, r, b) = (self.left, self.top, self.right(), self.bottom());
        [[l, t], [l, b], [r, b], [r, t], [l, t]]
    }
}

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pen {
    /// Colour.
    pub colour: Rgb,
    /// Width (pixels).
    pub width: f64,
    /// Opacity, 0 to 1.
    pub opacity: f64,
    /// Lengths of dash and gap (pixels); `None` for a solid line.
    pub dash: Option<[f64; 2]>,
}

impl Pen {
    /// A solid, opaque line.
    #[must_use]
    pub fn new(colour: Rgb, width: f64) -> Self {
        Self { colour, width, opacity: 1.0, dash: None }
    }

    /// The same with an opacity from 0 to 1.
    #[must_use]
    pub fn opacity(self, opacity: f64) -> Self {
        Self { opacity, ..self }
    }

    /// The same, dashed.
    #[must_use]
    pub fn dashed(self, dash: f64, gap: f64) -> Self {
        Self { dash: Some([dash, gap]), ..self }
    }
}

/// Which end of a text its position is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// Left.
    Start,
    /// Centre.
    Middle,
    /// Right.
    End,
}

/// How a text is set. Its position is a point of the line halfway up the capitals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TextStyle {
    /// Size of the type (pixels): capitals are 0.7 times as high.
    pub size: f64,
    /// Colour.
    pub colour: Rgb,
    /// Horizontal alignment.
    pub anchor: Anchor,
    /// Whether it reads upwards, as the label of a vertical axis does.
    pub upwards: bool,
    /// Whether it is drawn with heavier strokes.
    pub bold: bool,
}

impl TextStyle {
    /// Text of a size in [`Rgb::INK`].
    #[must_use]
    pub fn new(size: f64, anchor: Anchor) -> Self {
        Self { size, colour: Rgb::INK, anchor, upwards: false, bold: false }
    }

    /// The same in another colour.
    #[must_use]
    pub fn colour(self, colour: Rgb) -> Self {
        Self { colour, ..self }
    }

    /// The same, reading upwards.
    #[must_use]
    pub fn upwards(self) -> Self {
        Self { upwards: true, ..self }
    }

    /// The same with heavier strokes.
    #[must_use]
    pub fn bold(self) -> Self {
        Self { bold: true, ..self }
    }
}

/// Something to draw on: [`crate::Canvas`] (pixels, for PNG and GIF) and [`crate::Svg`] (vectors). A plot is described
/// once and drawn on either.
pub trait Surface {
    /// A line through `path`, with round ends and joints.
    fn stroke(&mut self, path: &[Pixel], pen: &Pen);

    /// The area inside the closed curves `rings` (even-odd rule: a ring within a ring is a hole).
    fn fill(&mut self, rings: &[Vec<Pixel>], colour: Rgb, opacity: f64);

    /// A line of text; `_{...}` and `^{...}` lower and raise what is in the braces.
    fn text(&mut self, at: Pixel, text: &str, style: &TextStyle);

    /// Restricts what follows to a rectangle, or (`None`) lifts the restriction.
    fn clip(&mut self, to: Option<Rect>);
}

/// A run of characters of one level within a line of text.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Run {
    pub(crate) text: String,
    /// 0 on the line, 1 raised, -1 lowered.
    pub(crate) level: i8,
}

/// Splits text at `_{...}`, `^{...}` and raised or lowered digit characters. An unclosed brace runs to the end.
pub(crate) fn runs(text: &str) -> Vec<Run> {
    fn push(runs: &mut Vec<Run>, c: char, level: i8) {
        match runs.last_mut() {
            Some(last) if last.level == level => last.text.push(c),
            _ => runs.push(Run { text: c.to_string(), level }),
        }
    }
    let mut runs = Vec::new();
    let mut level = 0;
    let mut chars = text.chars().peekable();
    while let Some(c) = chars.next() {
        match c {
            '_' | '^' if level == 0 && chars.peek() == Some(&'{') => {
                chars.next();
                level = if c == '^' { 1 } else { -1 };
            }
            '}' if level != 0 => level = 0,
            _ => match plain_digit(c) {
                Some((digit, digit_level)) => push(&mut runs, digit, digit_level),
                None => push(&mut runs, c, level),
            },
        }
    }
    runs
}

/// The digit and level of a raised or lowered digit character.
fn plain_digit(c: char) -> Option<(char, i8)> {
    let find = |set: &str| set.chars().position(|s| s == c).and_then(|k| char::from_digit(k as u32, 10));
    find("⁰¹²³⁴⁵⁶⁷⁸⁹").map(|d| (d, 1)).or_else(|| find("₀₁₂₃₄₅₆₇₈₉").map(|d| (d, -1)))
}

/// Cuts a path into the dashes of a pattern of dash and gap lengths.
pub(crate) fn dashes(path: &[Pixel], [dash, gap]: [f64; 2]) -> Vec<Vec<Pixel>> {
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
