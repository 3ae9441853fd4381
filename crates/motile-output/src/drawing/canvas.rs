//! An RGB image with anti-aliased lines, areas and text, written as PNG.

use std::{fs::File, io::BufWriter, path::Path};

use anyhow::{Context, Result, ensure};

use crate::{
    Rgb,
    drawing::font,
    drawing::surface::{Pen, Pixel, Rect, Surface, TextStyle, dashes},
};

/// An image of 8-bit RGB pixels, white at first.
///
/// A shape is first collected in a coverage mask (the largest coverage of its parts), then blended once, so that the
/// overlapping parts of a line do not add up to spots.
#[derive(Debug, Clone)]
pub struct Canvas {
    width: usize,
    height: usize,
    pixels: Vec<Rgb>,
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
    /// Largest width and height (pixels).
    pub const LARGEST: usize = 16_384;

    /// A white image.
    ///
    /// # Errors
    /// No pixels, or more than [`Canvas::LARGEST`] in a direction.
    pub fn new(width: usize, height: usize) -> Result<Self> {
        let sizes = 1..=Self::LARGEST;
        ensure!(
            sizes.contains(&width) && sizes.contains(&height),
            "an image of {width} x {height} pixels cannot be drawn: each side must be 1 to {} pixels",
            Self::LARGEST
        );
        let count = width * height;
        Ok(Self {
            width,
            height,
            pixels: vec![Rgb::WHITE; count],
            coverage: vec![0.0; count],
            tint: vec![Rgb::WHITE; count],
            clip: Span { x: [0, width], y: [0, height] },
        })
    }

    /// Width and height (pixels).
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// The pixels, row after row from the top.
    #[must_use]
    pub fn pixels(&self) -> &[Rgb] {
        &self.pixels
    }

    /// Colours each pixel whose centre lies in `area` by `colour(x, y)` of that centre (pixels); `None` leaves it.
    pub fn shade(&mut self, area: Rect, mut colour: impl FnMut(f64, f64) -> Option<Rgb>) {
        let span = Span::around([area.left, area.top], [area.right(), area.bottom()], &self.clip);
        for row in span.y[0]..span.y[1] {
            let y = row as f64 + 0.5;
            for column in span.x[0]..span.x[1] {
                let x = column as f64 + 0.5;
                let inside = x >= area.left && x < area.right() && y >= area.top && y < area.bottom();
                if inside && let Some(c) = colour(x, y) {
                    self.pixels[row * self.width + column] = c;
                }
            }
        }
    }

    /// A solid line whose colour runs linearly from vertex to vertex; `colours` has as many entries as `path`.
    ///
    /// # Panics
    /// If the lengths differ.
    pub fn stroke_coloured(&mut self, path: &[Pixel], colours: &[Rgb], width: f64) {
        assert_eq!(path.len(), colours.len(), "one colour a vertex");
        let mut touched = Span::EMPTY;
        for (ends, tints) in path.windows(2).zip(colours.windows(2)) {
            touched = touched.join(self.cover(ends[0], ends[1], width, [tints[0], tints[1]]));
        }
        self.blend(touched, 1.0);
    }

    /// A filled disc.
    pub fn disc(&mut self, centre: Pixel, radius: f64, colour: Rgb) {
        let touched = self.cover(centre, centre, 2.0 * radius, [colour, colour]);
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
                    self.pixels[index] = self.pixels[index].mix(self.tint[index], t);
                }
            }
        }
    }

    /// Writes the image as PNG.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write_png(&self, path: &Path) -> Result<()> {
        let write = || -> Result<()> {
            let file = BufWriter::new(File::create(path)?);
            let mut encoder = png::Encoder::new(file, u32::try_from(self.width)?, u32::try_from(self.height)?);
            encoder.set_color(png::ColorType::Rgb);
            encoder.set_depth(png::BitDepth::Eight);
            let bytes: Vec<u8> = self.pixels.iter().flat_map(|p| p.0).collect();
            encoder.write_header()?.write_image_data(&bytes)?;
            Ok(())
        };
        write().with_context(|| format!("writing {}", path.display()))
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
        let all = Span { x: [0, self.width], y: [0, self.height] };
        self.clip = to.map_or(all, |r| {
            let round = |v: f64, end: usize| (v.round().max(0.0) as usize).min(end);
            let x0 = round(r.left, self.width);
            let y0 = round(r.top, self.height);
            Span { x: [x0, round(r.right(), self.width).max(x0)], y: [y0, round(r.bottom(), self.height).max(y0)] }
        });
    }
}

#[cfg(test)]
mod tests;
