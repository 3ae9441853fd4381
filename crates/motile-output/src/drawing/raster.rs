//! Drawings as pixels.

use std::{fs, path::Path};

use tiny_skia::{
    Color, FillRule, FilterQuality, LineCap, LineJoin, Mask, Paint, PathBuilder, Pixmap, PixmapPaint, Stroke, Transform,
};

use super::{canvas::Drawing, shapes::Shape};
use crate::{OutputError, Rgb};

/// Largest width and height (pixels).
const LARGEST: f64 = 16_384.0;

impl Drawing {
    /// Returns the image of the drawing, enlarged `scale` times.
    ///
    /// # Errors
    /// Returns [`OutputError::Size`] for fewer than 1 pixel or more than 16384 in a direction.
    pub(crate) fn pixels(&self, scale: f64) -> Result<Pixmap, OutputError> {
        let size = self.size.map(|side| (side * scale).round());
        for side in size {
            OutputError::check_size("an image with a side (pixels)", side, 1.0, LARGEST)?;
        }
        let [width, height] = size.map(|side| side as u32);
        let refused =
            OutputError::Size { what: "an image with a side (pixels)", given: size[0], least: 1.0, most: LARGEST };
        let mut image = Pixmap::new(width, height).ok_or(refused)?;
        image.fill(Color::WHITE);
        let transform = Transform::from_scale(scale as f32, scale as f32);
        let mut clip: Option<Mask> = None;
        for shape in &self.shapes {
            match shape {
                Shape::Area { path, colour, opacity, .. } => {
                    image.fill_path(path, &paint(*colour, *opacity), FillRule::EvenOdd, transform, clip.as_ref());
                }
                Shape::Line { path, pen } => {
                    let (line_cap, line_join) = (LineCap::Round, LineJoin::Round);
                    let stroke = Stroke { width: pen.width as f32, line_cap, line_join, ..Stroke::default() };
                    image.stroke_path(path, &paint(pen.colour, pen.opacity), &stroke, transform, clip.as_ref());
                }
                Shape::Image { corner, image: part } => {
                    let place = transform.pre_translate(corner[0] as f32, corner[1] as f32);
                    let quality = PixmapPaint { quality: FilterQuality::Nearest, ..PixmapPaint::default() };
                    image.draw_pixmap(0, 0, part.as_ref(), &quality, place, clip.as_ref());
                }
                Shape::Clip(None) => clip = None,
                Shape::ClipInside(path) => {
                    clip = Mask::new(width, height);
                    if let Some(mask) = &mut clip {
                        mask.fill_path(path, FillRule::Winding, true, transform);
                    }
                }
                Shape::Clip(Some(rect)) => {
                    let sides = [rect.left, rect.top, rect.width, rect.height].map(|v| v as f32);
                    let area = tiny_skia::Rect::from_xywh(sides[0], sides[1], sides[2], sides[3]);
                    clip = Mask::new(width, height);
                    if let (Some(mask), Some(area)) = (&mut clip, area) {
                        mask.fill_path(&PathBuilder::from_rect(area), FillRule::Winding, true, transform);
                    }
                }
            }
        }
        Ok(image)
    }

    /// Writes the drawing to `path`: vectors if the name ends in `.svg`, and PNG, enlarged `scale` times, if it ends in
    /// `.png`.
    ///
    /// # Errors
    /// Returns [`OutputError::Write`], [`OutputError::Size`], [`OutputError::Format`].
    pub(crate) fn write(&self, path: &Path, scale: f64) -> Result<(), OutputError> {
        OutputError::check_format(path, &["svg", "png"])?;
        if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("svg")) {
            return fs::write(path, self.svg()).map_err(OutputError::writing(path));
        }
        let per_metre = self.per_cm.map(|per_cm| (100.0 * per_cm * scale).round() as u32);
        let mut file = png(&self.pixels(scale)?);
        if !self.origin.is_empty() {
            // Keyword, no compression, no language, no translated keyword.
            insert(&mut file, b"iTXt", &[b"Comment\0\0\0\0\0", self.origin.as_bytes()].concat());
        }
        if let Some(per_metre) = per_metre.map(u32::to_be_bytes) {
            insert(&mut file, b"pHYs", &[per_metre.as_slice(), &per_metre, &[1]].concat());
        }
        fs::write(path, file).map_err(OutputError::writing(path))
    }
}

/// Bytes of a PNG file of an image.
pub(crate) fn png(image: &Pixmap) -> Vec<u8> {
    // Only an image too large for the format fails, and sizes are bounded.
    image.encode_png().unwrap_or_default()
}

/// Inserts a chunk into a PNG file after its header (ISO/IEC 15948).
fn insert(file: &mut Vec<u8>, kind: &[u8; 4], contents: &[u8]) {
    const HEADER_END: usize = 33;
    if file.len() <= HEADER_END {
        return;
    }
    let chunk = [kind.as_slice(), contents].concat();
    let sum = !chunk.iter().fold(u32::MAX, |sum, &byte| {
        (0..8).fold(sum ^ u32::from(byte), |sum, _| (sum >> 1) ^ (0xedb8_8320 & (sum & 1).wrapping_neg()))
    });
    let length = (contents.len() as u32).to_be_bytes();
    file.splice(HEADER_END..HEADER_END, [length.as_slice(), &chunk, &sum.to_be_bytes()].concat());
}

/// Colours of the pixels of an image without transparency, row after row from the top.
pub(crate) fn colours(image: &Pixmap) -> impl Iterator<Item = Rgb> {
    image.pixels().iter().map(|pixel| Rgb([pixel.red(), pixel.green(), pixel.blue()]))
}

fn paint(Rgb([r, g, b]): Rgb, opacity: f64) -> Paint<'static> {
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(r, g, b, (255.0 * opacity.clamp(0.0, 1.0)).round() as u8);
    paint
}

#[cfg(test)]
mod tests;
