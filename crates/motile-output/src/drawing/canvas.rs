//! Drawings, element by element.

use std::ops::Range;

use tiny_skia::{ColorU8, Pixmap, StrokeDash};

use crate::Rgb;
use crate::drawing::font;
use crate::drawing::shapes::{Pen, Pixel, Rect, Shape, TextStyle, joined};

/// Drawing as a list of elements: [`Drawing::svg`] writes it as vectors, [`Drawing::pixels`] paints it.
#[derive(Debug, Clone)]
pub(crate) struct Drawing {
    pub(crate) size: [f64; 2],
    /// Pixels per centimetre on paper; `None` for a drawing without a size there.
    pub(crate) per_cm: Option<f64>,
    pub(crate) shapes: Vec<Shape>,
    /// Origin of the results that it shows, which its files carry; empty for none.
    pub(crate) origin: String,
}

impl Drawing {
    /// Returns the white drawing of a width and height (pixels).
    pub(crate) fn new(size: [f64; 2]) -> Self {
        Self { size, per_cm: None, shapes: Vec::new(), origin: String::new() }
    }

    /// Restricts the elements that follow to a rectangle, or (`None`) lifts the restriction.
    pub(crate) fn clip(&mut self, to: Option<Rect>) {
        self.shapes.push(Shape::Clip(to));
    }

    /// Restricts the elements that follow to the area inside closed curves.
    pub(crate) fn clip_inside(&mut self, rings: &[Vec<Pixel>]) {
        self.shapes.extend(joined(rings, true).map(Shape::ClipInside));
    }

    /// Fills the area inside the closed curves `rings` (even-odd rule: a ring within a ring is a hole).
    pub(crate) fn fill(&mut self, rings: &[Vec<Pixel>], colour: Rgb, opacity: f64) {
        let area = |path| Shape::Area { path, colour, opacity, label: String::new() };
        self.shapes.extend(joined(rings, true).map(area));
    }

    /// Draws lines along `paths`, with round ends and joints.
    pub(crate) fn strokes(&mut self, paths: &[Vec<Pixel>], pen: &Pen) {
        self.shapes.extend(joined(paths, false).map(|path| Shape::Line { path, pen: *pen }));
    }

    /// Draws a line along `path`.
    pub(crate) fn stroke(&mut self, path: &[Pixel], pen: &Pen) {
        self.strokes(&[path.to_vec()], pen);
    }

    /// Draws a dashed line, with lengths of dash and gap (pixels).
    pub(crate) fn dashed(&mut self, path: &[Pixel], pen: &Pen, pattern: [f64; 2]) {
        let dash = StrokeDash::new(pattern.map(|length| length.max(0.1) as f32).to_vec(), 0.0);
        let cut = dash.and_then(|dash| joined(&[path.to_vec()], false)?.dash(&dash, 1.0));
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
        let (width, height) = (image.width() as usize, f64::from(image.height()));
        for (corners, Rgb([r, g, b])) in triangles {
            // Centres of pixels are whole numbers. Smooth edges would let the background through between neighbours.
            let corners = corners.map(|[x, y]| [x - area.left - 0.5, y - area.top - 0.5]);
            let [low, high] = extent(corners.iter().map(|corner| corner[1]));
            for row in whole([low, high], height) {
                let ends = extent((0..3).filter_map(|side| {
                    let ([x, y], [to_x, to_y]) = (corners[side], corners[(side + 1) % 3]);
                    let along = (row as f64 - y) / (to_y - y);
                    (0.0..=1.0).contains(&along).then_some(x + along * (to_x - x))
                }));
                for column in whole(ends, width as f64) {
                    image.pixels_mut()[row * width + column] = ColorU8::from_rgba(r, g, b, 255).premultiply();
                }
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

/// Rounding of places (pixels), so that a pixel on the side of two triangles belongs to one of them or both.
const ROUNDING: f64 = 1e-6;

/// Returns the least and greatest of some numbers.
fn extent(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
}

/// Returns the whole numbers from `low` to `high` that are not negative and below `end`.
fn whole([low, high]: [f64; 2], end: f64) -> Range<usize> {
    let first = (low - ROUNDING).max(0.0).ceil();
    first as usize..((high + ROUNDING).floor() + 1.0).clamp(first.min(end), end) as usize
}
