//! Drawing with anti-aliased lines, areas and text on an image.

use std::{fs::File, io, io::BufWriter, path::Path};

use crate::{
    Error, Rgb,
    drawing::{Pen, Pixel, Rect, Surface},
};

/// Largest width and height (pixels).
const LARGEST: f64 = 16_384.0;

/// An image to draw on, white at first.
///
/// A shape is first collected in a coverage mask (the largest coverage of its parts), then blended once, so that the
/// overlapping parts of a line do not add up to spots.
#[derive(Debug, Clone)]
pub(crate) struct Canvas {
    pub(crate) size: [usize; 2],
    /// The pixels, row after row from the top.
    pub(crate) pixels: Vec<Rgb>,
    coverage: Vec<f32>,
    tint: Vec<Rgb>,
    /// Where the mask is not zero, at most.
    touched: Span,
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

    fn of(rect: Rect, bounds: &Self) -> Self {
        Self::around([rect.left, rect.top], [rect.right(), rect.bottom()], bounds)
    }

    fn join(&mut self, other: &Self) {
        for (own, other) in [(&mut self.x, other.x), (&mut self.y, other.y)] {
            *own = [own[0].min(other[0]), own[1].max(other[1])];
        }
    }

    const EMPTY: Self = Self { x: [usize::MAX, 0], y: [usize::MAX, 0] };
}

impl Canvas {
    /// A white image.
    ///
    /// # Errors
    /// [`Error::Size`]: no pixels, or more than 16384 in a direction.
    pub(crate) fn new(size: [usize; 2]) -> Result<Self, Error> {
        for side in size {
            Error::check_size("an image with a side (pixels)", side as f64, 1.0, LARGEST)?;
        }
        let [pixels, tint] = [0, 1].map(|_| vec![Rgb::WHITE; size[0] * size[1]]);
        let clip = Span { x: [0, size[0]], y: [0, size[1]] };
        Ok(Self { size, coverage: vec![0.0; pixels.len()], pixels, tint, touched: Span::EMPTY, clip })
    }

    /// Writes the image as PNG.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub(crate) fn write_png(&self, path: &Path) -> Result<(), Error> {
        let write = || -> io::Result<()> {
            let file = BufWriter::new(File::create(path)?);
            let [width, height] = self.size.map(|side| side as u32);
            let mut encoder = png::Encoder::new(file, width, height);
            encoder.set_color(png::ColorType::Rgb);
            encoder.set_depth(png::BitDepth::Eight);
            let bytes: Vec<u8> = self.pixels.iter().flat_map(|p| p.0).collect();
            Ok(encoder.write_header()?.write_image_data(&bytes)?)
        };
        write().map_err(Error::writing(path))
    }

    /// Colours the pixels in `area`, whose edges are on whole ones, by `colour(x, y)` of their centres (pixels); `None`
    /// leaves one.
    pub(crate) fn shade(&mut self, area: Rect, mut colour: impl FnMut(f64, f64) -> Option<Rgb>) {
        let span = Span::of(area, &self.clip);
        for row in span.y[0]..span.y[1] {
            for column in span.x[0]..span.x[1] {
                if let Some(colour) = colour(column as f64 + 0.5, row as f64 + 0.5) {
                    self.pixels[row * self.size[0] + column] = colour;
                }
            }
        }
    }

    /// A solid line whose colour runs linearly from vertex to vertex; `colours` has as many entries as `path`.
    pub(crate) fn stroke_coloured(&mut self, path: &[Pixel], colours: &[Rgb], width: f64) {
        for (ends, tints) in path.windows(2).zip(colours.windows(2)) {
            self.cover(ends[0], ends[1], width, [tints[0], tints[1]]);
        }
        self.blend(1.0);
    }

    /// Adds the line from `a` to `b` to the mask: the coverage of a pixel falls from 1 to 0 over one pixel about the
    /// line's edge.
    fn cover(&mut self, a: Pixel, b: Pixel, width: f64, tints: [Rgb; 2]) {
        if ![a[0], a[1], b[0], b[1]].iter().all(|v| v.is_finite()) {
            return;
        }
        // Long slanted lines in pieces: what is visited is the bounding box.
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let slant = (b[0] - a[0]).abs().min((b[1] - a[1]).abs());
        if slant > 24.0 && length < 1e5 {
            let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
            let tint = tints[0].mix(tints[1], 0.5);
            self.cover(a, middle, width, [tints[0], tint]);
            return self.cover(middle, b, width, [tint, tints[1]]);
        }
        let (half, full) = ((0.5 * width) as f32, (width as f32).min(1.0));
        let reach = 0.5 * width + 0.5;
        let low = [a[0].min(b[0]) - reach, a[1].min(b[1]) - reach];
        let high = [a[0].max(b[0]) + reach, a[1].max(b[1]) + reach];
        let span = Span::around(low, high, &self.clip);
        self.touched.join(&span);
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
                let index = row * self.size[0] + column;
                if coverage > self.coverage[index] {
                    self.coverage[index] = coverage;
                    self.tint[index] = if plain { tints[0] } else { tints[0].mix(tints[1], f64::from(t)) };
                }
            }
        }
    }

    /// Blends the mask into the image and clears it.
    fn blend(&mut self, opacity: f64) {
        let span = std::mem::replace(&mut self.touched, Span::EMPTY);
        for row in span.y[0]..span.y[1] {
            for index in row * self.size[0] + span.x[0]..row * self.size[0] + span.x[1] {
                let coverage = std::mem::take(&mut self.coverage[index]);
                if coverage > 0.0 {
                    let t = f64::from(coverage.min(1.0)) * opacity;
                    self.pixels[index] = self.pixels[index].mix(self.tint[index], t);
                }
            }
        }
    }
}

impl Surface for Canvas {
    fn strokes(&mut self, paths: &[Vec<Pixel>], _label: &str, pen: &Pen) {
        for ends in paths.iter().flat_map(|path| path.windows(2)) {
            self.cover(ends[0], ends[1], pen.width.max(1.0), [pen.colour; 2]);
        }
        self.blend(pen.opacity);
    }

    fn fill(&mut self, rings: &[Vec<Pixel>], colour: Rgb, opacity: f64) {
        // Four scan lines a row of pixels, with exact coverage along each.
        const LINES: usize = 4;
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for p in rings.iter().flatten() {
            low = [low[0].min(p[0]), low[1].min(p[1])];
            high = [high[0].max(p[0]), high[1].max(p[1])];
            if !(p[0].is_finite() && p[1].is_finite()) {
                return;
            }
        }
        let span = Span::around(low, high, &self.clip);
        let mut crossings = Vec::new();
        for row in span.y[0]..span.y[1] {
            let line = &mut self.coverage[row * self.size[0]..(row + 1) * self.size[0]];
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
            self.tint[row * self.size[0] + span.x[0]..row * self.size[0] + span.x[1]].fill(colour);
        }
        self.touched.join(&span);
        self.blend(opacity);
    }

    fn clip(&mut self, to: Option<Rect>) {
        let all = Span { x: [0, self.size[0]], y: [0, self.size[1]] };
        self.clip = to.map_or(all, |rect| Span::of(rect, &all));
    }
}

#[cfg(test)]
mod tests;
