//! Drawings of lines, areas, images and text, painted as pixels or written as vectors. Positions are in pixels from the
//! upper left corner.

pub(crate) mod axes;
pub(crate) mod font;
pub(crate) mod raster;
pub(crate) mod svg;
pub(crate) mod ticks;

use tiny_skia::{ColorU8, FillRule, Paint, Path, PathBuilder, Pixmap, StrokeDash, Transform};

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

    /// Rectangle with its edges on whole pixels.
    pub(crate) fn rounded(self) -> Self {
        let [left, top, width, height] = [self.left, self.top, self.width, self.height].map(f64::round);
        Self { left, top, width, height }
    }

    /// Closed outline, counter-clockwise as seen from the upper left corner.
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
    /// Pen of a solid, opaque line.
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
    /// Text of a size in [`Rgb::INK`].
    pub(crate) fn new(size: f64, anchor: Anchor) -> Self {
        Self { size, colour: Rgb::INK, anchor, upwards: false }
    }

    pub(crate) fn upwards(self) -> Self {
        Self { upwards: true, ..self }
    }
}

/// Element of a drawing.
#[derive(Debug, Clone)]
enum Shape {
    /// Area inside a path (even-odd rule: a ring within a ring is a hole).
    Area { path: Path, colour: Rgb, opacity: f64, label: String },
    /// Line along a path, with round ends and joints.
    Line { path: Path, pen: Pen },
    /// Image at a position.
    Image { corner: Pixel, image: Pixmap },
    /// Restriction of the following elements to a rectangle, or its end.
    Clip(Option<Rect>),
}

/// Drawing as a list of elements: [`Drawing::svg`] writes it as vectors, [`Drawing::pixels`] paints it.
#[derive(Debug, Clone)]
pub(crate) struct Drawing {
    size: [f64; 2],
    shapes: Vec<Shape>,
}

impl Drawing {
    /// White drawing of a width and height (pixels).
    pub(crate) fn new(size: [f64; 2]) -> Self {
        Self { size, shapes: Vec::new() }
    }

    /// Restricts the elements that follow to a rectangle, or (`None`) lifts the restriction.
    pub(crate) fn clip(&mut self, to: Option<Rect>) {
        self.shapes.push(Shape::Clip(to));
    }

    /// Fills the area inside the closed curves `rings` (even-odd rule: a ring within a ring is a hole).
    pub(crate) fn fill(&mut self, rings: &[Vec<Pixel>], colour: Rgb, opacity: f64) {
        let area = |path| Shape::Area { path, colour, opacity, label: String::new() };
        self.shapes.extend(path(rings, true).map(area));
    }

    /// Draws lines along `paths`, with round ends and joints.
    pub(crate) fn strokes(&mut self, paths: &[Vec<Pixel>], pen: &Pen) {
        self.shapes.extend(path(paths, false).map(|path| Shape::Line { path, pen: *pen }));
    }

    /// Draws a line along `path`.
    pub(crate) fn stroke(&mut self, path: &[Pixel], pen: &Pen) {
        self.strokes(&[path.to_vec()], pen);
    }

    /// Draws a dashed line, with lengths of dash and gap (pixels).
    pub(crate) fn dashed(&mut self, path: &[Pixel], pen: &Pen, pattern: [f64; 2]) {
        let dash = StrokeDash::new(pattern.map(|length| length.max(0.1) as f32).to_vec(), 0.0);
        let cut = dash.and_then(|dash| self::path(&[path.to_vec()], false)?.dash(&dash, 1.0));
        self.shapes.extend(cut.map(|path| Shape::Line { path, pen: *pen }));
    }

    /// Draws an opaque line whose pieces have the mean of the colours at their ends; `colours` has as many entries as
    /// `path`.
    pub(crate) fn stroke_coloured(&mut self, path: &[Pixel], colours: &[Rgb], width: f64) {
        for (ends, tints) in path.windows(2).zip(colours.windows(2)) {
            self.stroke(ends, &Pen::new(tints[0].mix(tints[1], 0.5), width));
        }
    }

    /// Colours the pixels in `area`, whose edges are on whole ones, by `colour(x, y)` of their centres (pixels); `None`
    /// leaves one.
    pub(crate) fn shade(&mut self, area: Rect, mut colour: impl FnMut(f64, f64) -> Option<Rgb>) {
        let Some(mut image) = Pixmap::new(area.width as u32, area.height as u32) else { return };
        let width = image.width() as usize;
        for (k, pixel) in image.pixels_mut().iter_mut().enumerate() {
            let at = [area.left + (k % width) as f64 + 0.5, area.top + (k / width) as f64 + 0.5];
            if let Some(Rgb([r, g, b])) = colour(at[0], at[1]) {
                *pixel = ColorU8::from_rgba(r, g, b, 255).premultiply();
            }
        }
        self.shapes.push(Shape::Image { corner: [area.left, area.top], image });
    }

    /// Fills triangles, each in its colour, within `area`, whose edges are on whole pixels.
    pub(crate) fn triangles(&mut self, area: Rect, triangles: impl Iterator<Item = ([Pixel; 3], Rgb)>) {
        let Some(mut image) = Pixmap::new(area.width as u32, area.height as u32) else { return };
        let place = Transform::from_translate(-area.left as f32, -area.top as f32);
        for (corners, Rgb([r, g, b])) in triangles {
            // Smooth edges would let the background through between neighbours.
            let mut paint = Paint { anti_alias: false, ..Paint::default() };
            paint.set_color_rgba8(r, g, b, 255);
            if let Some(path) = path(&[corners.to_vec()], true) {
                image.fill_path(&path, &paint, FillRule::Winding, place, None);
            }
        }
        self.shapes.push(Shape::Image { corner: [area.left, area.top], image });
    }

    /// Writes a line of text; `_{...}` and `^{...}` lower and raise the text in the braces.
    pub(crate) fn text(&mut self, at: Pixel, text: &str, style: &TextStyle) {
        let area = |path| Shape::Area { path, colour: style.colour, opacity: 1.0, label: text.to_string() };
        self.shapes.extend(font::place(text, at, style).map(area));
    }
}

/// Largest coordinate (pixels), to which others are clamped: far outside of any drawing, and small enough to be
/// painted.
const FARTHEST: f64 = 1e5;

/// Lines through points as one path; `None` if a point is not finite or there are none.
fn path(lines: &[Vec<Pixel>], closed: bool) -> Option<Path> {
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
