//! What figures are drawn on, and what all of them have: lines, areas, text, axes. Positions are in pixels from the
//! upper left corner.

pub(crate) mod axes;
pub(crate) mod font;
pub(crate) mod raster;
mod svg;
pub(crate) mod ticks;

use tiny_skia::{ColorU8, FillRule, Paint, Path, PathBuilder, Pixmap, StrokeDash, Transform};

use crate::Rgb;

/// A position on a drawing: pixels to the right and pixels down from the upper left corner.
pub(crate) type Pixel = [f64; 2];

/// An upright rectangle on a drawing (pixels).
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

/// One thing that is drawn.
#[derive(Debug, Clone)]
enum Shape {
    /// The area inside a path (even-odd rule: a ring within a ring is a hole).
    Area { path: Path, colour: Rgb, opacity: f64, label: String },
    /// A line along a path, with round ends and joints.
    Line { path: Path, pen: Pen },
    /// An image in a rectangle.
    Image { corner: Pixel, image: Pixmap },
    /// What follows shows inside of a rectangle alone, or everywhere again.
    Clip(Option<Rect>),
}

/// What is drawn, described once: [`Drawing::svg`] writes it as vectors, [`Drawing::pixels`] paints it.
#[derive(Debug, Clone)]
pub(crate) struct Drawing {
    size: [f64; 2],
    shapes: Vec<Shape>,
}

impl Drawing {
    /// A white drawing of the given width and height (pixels).
    pub(crate) fn new(size: [f64; 2]) -> Self {
        Self { size, shapes: Vec::new() }
    }

    /// Restricts what follows to a rectangle, or (`None`) lifts the restriction.
    pub(crate) fn clip(&mut self, to: Option<Rect>) {
        self.shapes.push(Shape::Clip(to));
    }

    /// The area inside the closed curves `rings` (even-odd rule: a ring within a ring is a hole).
    pub(crate) fn fill(&mut self, rings: &[Vec<Pixel>], colour: Rgb, opacity: f64) {
        let area = |path| Shape::Area { path, colour, opacity, label: String::new() };
        self.shapes.extend(path(rings, true).map(area));
    }

    /// Lines through `paths`, with round ends and joints.
    pub(crate) fn strokes(&mut self, paths: &[Vec<Pixel>], pen: &Pen) {
        self.shapes.extend(path(paths, false).map(|path| Shape::Line { path, pen: *pen }));
    }

    /// A line through `path`.
    pub(crate) fn stroke(&mut self, path: &[Pixel], pen: &Pen) {
        self.strokes(&[path.to_vec()], pen);
    }

    /// A line with lengths of dash and gap (pixels).
    pub(crate) fn dashed(&mut self, path: &[Pixel], pen: &Pen, pattern: [f64; 2]) {
        let dash = StrokeDash::new(pattern.map(|length| length.max(0.1) as f32).to_vec(), 0.0);
        let cut = dash.and_then(|dash| self::path(&[path.to_vec()], false)?.dash(&dash, 1.0));
        self.shapes.extend(cut.map(|path| Shape::Line { path, pen: *pen }));
    }

    /// An opaque line whose pieces from vertex to vertex have the mean of the colours at their ends; `colours` has as
    /// many entries as `path`.
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

    /// Triangles in the colours given, within `area`, whose edges are on whole pixels.
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

    /// A line of text; `_{...}` and `^{...}` lower and raise what is in the braces.
    pub(crate) fn text(&mut self, at: Pixel, text: &str, style: &TextStyle) {
        let area = |path| Shape::Area { path, colour: style.colour, opacity: 1.0, label: text.to_string() };
        self.shapes.extend(font::place(text, at, style).map(area));
    }
}

/// Coordinates beyond are drawn as these (pixels): far outside of any drawing, and not too large to be painted.
const FARTHEST: f64 = 1e5;

/// Lines through points as one path; `None` with a point that is not finite, and without any.
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
