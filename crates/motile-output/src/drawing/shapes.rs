//! Elements of drawings: lines, areas, images, with their styles.

use tiny_skia::{Path, PathBuilder, Pixmap};

use crate::Rgb;

/// Position on a drawing: pixels to the right and pixels down from the upper left corner.
pub(crate) type Pixel = [f64; 2];

/// Upright rectangle on a drawing (pixels).
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

    /// Returns the rectangle with its edges on whole pixels.
    pub(crate) fn rounded(self) -> Self {
        let [left, top, width, height] = [self.left, self.top, self.width, self.height].map(f64::round);
        Self { left, top, width, height }
    }

    /// Returns the closed outline, counter-clockwise as seen from the upper left corner.
    pub(crate) fn outline(&self) -> Vec<Pixel> {
        let (l, t, r, b) = (self.left, self.top, self.right(), self.bottom());
        vec![[l, t], [l, b], [r, b], [r, t], [l, t]]
    }
}

/// Pen of a line: colour, width (pixels), opacity from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pen {
    pub(crate) colour: Rgb,
    pub(crate) width: f64,
    pub(crate) opacity: f64,
}

impl Pen {
    /// Creates a pen of a solid, opaque line.
    pub(crate) fn new(colour: Rgb, width: f64) -> Self {
        Self { colour, width, opacity: 1.0 }
    }

    pub(crate) fn opacity(self, opacity: f64) -> Self {
        Self { opacity, ..self }
    }
}

/// Point of a text that its position is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// Style of a text. Its position is a point of the line halfway up the capitals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TextStyle {
    /// Size of the type (pixels): capitals are 0.7 times as high.
    pub(crate) size: f64,
    pub(crate) colour: Rgb,
    pub(crate) anchor: Anchor,
    /// True for text that reads upwards, as the label of a vertical axis does.
    pub(crate) upwards: bool,
}

impl TextStyle {
    /// Creates text of a size in [`Rgb::INK`].
    pub(crate) fn new(size: f64, anchor: Anchor) -> Self {
        Self { size, colour: Rgb::INK, anchor, upwards: false }
    }

    pub(crate) fn upwards(self) -> Self {
        Self { upwards: true, ..self }
    }
}

/// Element of a drawing.
#[derive(Debug, Clone)]
pub(crate) enum Shape {
    /// Area inside a path (even-odd rule: a ring within a ring is a hole).
    Area { path: Path, colour: Rgb, opacity: f64, label: String },
    /// Line along a path, with round ends and joints.
    Line { path: Path, pen: Pen },
    /// Image at a position.
    Image { corner: Pixel, image: Pixmap },
    /// Restriction of the following elements to a rectangle, or its end.
    Clip(Option<Rect>),
    /// Restriction of the following elements to the area inside a path, in place of the one before.
    ClipInside(Path),
}

/// Largest coordinate (pixels), to which others are clamped: far outside of any drawing, and small enough to be
/// painted.
const FARTHEST: f64 = 1e5;

/// Returns the lines through points as one path; `None` if a point is not finite or there are none.
pub(crate) fn joined(lines: &[Vec<Pixel>], closed: bool) -> Option<Path> {
    let mut builder = PathBuilder::new();
    for line in lines {
        let mut points = line.iter().map(|p| p.map(|v| v.clamp(-FARTHEST, FARTHEST) as f32));
        if let Some([x, y]) = points.next() {
            builder.move_to(x, y);
        }
        points.for_each(|[x, y]| builder.line_to(x, y));
        if closed {
            builder.close();
        }
    }
    builder.finish()
}
