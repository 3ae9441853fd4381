//! Drawing with anti-aliased lines, areas and text on an image.

use crate::{
    Error, Rgb,
    drawing::{Pen, Pixel, Rect, Surface, TextStyle, dashes, font, image::Image},
};

/// An image to draw on, white at first.
///
/// A shape is first collected in a coverage mask (the largest coverage of its parts), then blended once, so that the
/// overlapping parts of a line do not add up to spots.
#[derive(Debug, Clone)]
pub(crate) struct Canvas {
    width: usize,
    image: Image,
    coverage: Vec<f32>,
    tint: Vec<Rgb>,
    clip: Span,
}

/// Columns and rows, the ends not included.
#[derive(Debug, Clone, Copy)]
struct Span {
    x: [usize; 2],
    y: [usize; 2],
}

impl Span {
    /// The pixels touched by a rectangle of real numbers, within `bounds`.
    fn around(low: Pixel, high: Pixel, bounds: &Self) -> Self {
        let axis = |low: f64, high: f64, bounds: [usize; 2]| {
            let start = (low.floor().max(0.0) as usize).clamp(bounds[0], bounds[1]);
            let end = (high.ceil().max(0.0) as usize).clamp(start, bounds[1]);
            [start, end]
        };
        Self { x: axis(low[0], high[0], bounds.x), y: axis(low[1], high[1], bounds.y) }
    }

    fn join(self, other: Self) -> Self {
        let axis = |a: [usize; 2], b: [usize; 2]| if a[0] == a[1] { b } else { [a[0].min(b[0]), a[1].max(b[1])] };
        if other.x[0] == other.x[1] || other.y[0] == other.y[1] {
            return self;
        }
        Self { x: axis(self.x, other.x), y: axis(self.y, other.y) }
    }

    const EMPTY: Self = Self { x: [0, 0], y: [0, 0] };
}

impl Canvas {
    /// A white image.
    pub(crate) fn new(width: usize, height: usize) -> Result<Self, Error> {
        let (image, count) = (Image::new(width, height)?, width * height);
        let clip = Span { x: [0, width], y: [0, height] };
        Ok(Self { width, image, coverage: vec![0.0; count], tint: vec![Rgb::WHITE; count], clip })
    }

    /// What was drawn.
    pub(crate) fn into_image(self) -> Image {
        self.image
    }

    /// Colours each pixel whose centre lies in `area` by `colour(x, y)` of that centre (pixels); `None` leaves it.
    pub(crate) fn shade(&mut self, area: Rect, mut colour: impl FnMut(f64, f64) -> Option<Rgb>) {
        let span = Span::around([area.left, area.top], [area.right(), area.bottom()], &self.clip);
        for row in span.y[0]..span.y[1] {
            let y = row as f64 + 0.5;
            for column in span.x[0]..span.x[1] {
                let x = column as f64 + 0.5;
                let inside = x >= area.left && x < area.right() && y >= area.top && y < area.bottom();
                if inside && let Some(c) = colour(x, y) {
                    self.image.pixels[row * self.width + column] = c;
                }
            }
        }
    }

    /// A solid line whose colour runs linearly from vertex to vertex; `colours` has as many entries as `path`.
    pub(crate) fn stroke_coloured(&mut self, path: &[Pixel], colours: &[Rgb], width: f64) {
        let mut touched = Span::EMPTY;
        for (ends, tints) in path.windows(2).zip(colours.windows(2)) {
            touched = touched.join(self.cover(ends[0], ends[1], width, [tints[0], tints[1]]));
        }
        self.blend(touched, 1.0);
    }

    /// Adds the line from `a` to `b` to the mask: the coverage of a pixel falls from 1 to 0 over one pixel about the
    /// line's edge.
    fn cover(&mut self, a: Pixel, b: Pixel, width: f64, tints: [Rgb; 2]) -> Span {
        if ![a[0], a[1], b[0], b[1]].iter().all(|v| v.is_finite()) {
            return Span::EMPTY;
        }
        // Long slanted lines in pieces: what is visited is the bounding box.
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let slant = (b[0] - a[0]).abs().min((b[1] - a[1]).abs());
        if slant > 24.0 && length < 1e5 {
            let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
            let tint = tints[0].mix(tints[1], 0.5);
            let first = self.cover(a, middle, width, [tints[0], tint]);
            return first.join(self.cover(middle, b, width, [tint, tints[1]]));
        }
        let (half, full) = ((0.5 * width) as f32, (width as f32).min(1.0));
        let reach = 0.5 * width + 0.5;
        let low = [a[0].min(b[0]) - reach, a[1].min(b[1]) - reach];
        let high = [a[0].max(b[0]) + reach, a[1].max(b[1]) + reach];
        let span = Span::around(low, high, &self.clip);
        let (dx, dy) = ((b[0] - a[0]) as f32, (b[1] - a[1]) as f32);
        let inverse = if length > 0.0 { 1.0 / (dx * dx + dy * dy) } else { 0.0 };
        let plain = tints[0] == tints[1];
        for row in span.y[0]..span.y[1] {
            let y = (row as f64 + 0.5 - a[1]) as f32;
            for column in span.x[0]..span.x[1] {
                let x = (column as f64 + 0.5 - a[0]) as f32;
                let t = ((x * dx + y * dy) * inverse).clamp(0.0, 1.0);
                let distance = (x - t * dx).hypot(y - t * dy);
                let coverage = (half + 0.5 - distance).min(full);
                let index = row * self.width + column;
                if coverage > self.coverage[index] {
                    self.coverage[index] = coverage;
                    self.tint[index] = if plain { tints[0] } else { tints[0].mix(tints[1], f64::from(t)) };
                }
            }
        }
        span
    }

    /// Blends the mask into the image and clears it.
    fn blend(&mut self, span: Span, opacity: f64) {
        for row in span.y[0]..span.y[1] {
            for index in row * self.width + span.x[0]..row * self.width + span.x[1] {
                let coverage = std::mem::take(&mut self.coverage[index]);
                if coverage > 0.0 {
                    let t = f64::from(coverage.min(1.0)) * opacity;
                    self.image.pixels[index] = self.image.pixels[index].mix(self.tint[index], t);
                }
            }
        }
    }
}

impl Surface for Canvas {
    fn stroke(&mut self, path: &[Pixel], pen: &Pen) {
        let tints = [pen.colour, pen.colour];
        let mut touched = Span::EMPTY;
        let pieces = match pen.dash {
            Some(pattern) => dashes(path, pattern),
            None => vec![path.to_vec()],
        };
        for ends in pieces.iter().flat_map(|piece| piece.windows(2)) {
            touched = touched.join(self.cover(ends[0], ends[1], pen.width, tints));
        }
        self.blend(touched, pen.opacity);
    }

    fn fill(&mut self, rings: &[Vec<Pixel>], colour: Rgb, opacity: f64) {
        // Four scan lines a row of pixels, with exact coverage along each.
        const LINES: usize = 4;
        let vertices = || rings.iter().flatten();
        if vertices().any(|p| !(p[0].is_finite() && p[1].is_finite())) {
            return;
        }
        let extreme =
            |axis: usize, start: f64, pick: fn(f64, f64) -> f64| vertices().map(|p| p[axis]).fold(start, pick);
        let low = [extreme(0, f64::INFINITY, f64::min), extreme(1, f64::INFINITY, f64::min)];
        let high = [extreme(0, f64::NEG_INFINITY, f64::max), extreme(1, f64::NEG_INFINITY, f64::max)];
        let span = Span::around(low, high, &self.clip);
        let mut crossings = Vec::new();
        for row in span.y[0]..span.y[1] {
            let line = &mut self.coverage[row * self.width..(row + 1) * self.width];
            for k in 0..LINES {
                let y = row as f64 + (k as f64 + 0.5) / LINES as f64;
                crossings.clear();
                for ring in rings {
                    for (a, b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
                        if (a[1] <= y) != (b[1] <= y) {
                            crossings.push(a[0] + (y - a[1]) * (b[0] - a[0]) / (b[1] - a[1]));
                        }
                    }
                }
                crossings.sort_by(f64::total_cmp);
                for pair in crossings.chunks_exact(2) {
                    let from = pair[0].max(span.x[0] as f64);
                    let to = pair[1].min(span.x[1] as f64);
                    let first = from as usize;
                    for (column, cell) in line.iter_mut().enumerate().take(span.x[1]).skip(first) {
                        let overlap = to.min(column as f64 + 1.0) - from.max(column as f64);
                        if overlap <= 0.0 {
                            break;
                        }
                        *cell += overlap as f32 / LINES as f32;
                    }
                }
            }
            self.tint[row * self.width + span.x[0]..row * self.width + span.x[1]].fill(colour);
        }
        self.blend(span, opacity);
    }

    fn text(&mut self, at: Pixel, text: &str, style: &TextStyle) {
        let (strokes, weight) = font::place(text, at, style);
        let tints = [style.colour, style.colour];
        let mut touched = Span::EMPTY;
        for ends in strokes.iter().flat_map(|stroke| stroke.windows(2)) {
            touched = touched.join(self.cover(ends[0], ends[1], weight.max(1.0), tints));
        }
        self.blend(touched, 1.0);
    }

    fn clip(&mut self, to: Option<Rect>) {
        let all = Span { x: [0, self.width], y: [0, self.image.size[1]] };
        self.clip = to.map_or(all, |r| {
            let round = |v: f64, end: usize| (v.round().max(0.0) as usize).min(end);
            let x0 = round(r.left, self.width);
            let y0 = round(r.top, self.image.size[1]);
            Span {
                x: [x0, round(r.right(), self.width).max(x0)],
                y: [y0, round(r.bottom(), self.image.size[1]).max(y0)],
            }
        });
    }
}

#[cfg(test)]
mod tests;
