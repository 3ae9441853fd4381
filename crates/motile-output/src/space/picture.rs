//! Pictures and animations of droplets in three dimensions.

use std::path::Path;

use motile::scene::{Handle, Hydrodynamics, Observer, System};
use motile::space_droplets::SpaceBody;

use super::render::{Camera, Canvas};
use super::snapshot::SpaceSnapshot;
use crate::animation::Frames;
use crate::drawing::axes::{Axis, AxisScale, Frame};
use crate::drawing::ticks::{nice_step_below, number};
use crate::drawing::{Anchor, Drawing, Pen, Pixel, Rect, TextStyle, font::text_width};
use crate::picture::contents::Format;
use crate::time_label::time_label;
use crate::{ColourScale, Look, OutputError, Rgb, streamlines};

/// Height of the view over its width.
const HEIGHT: f64 = 0.72;
/// Streamlines over the width of the view.
const LINES: f64 = 26.0;
/// Points of the flow in frames of an animation.
const FRAME_CELLS: usize = 36;
/// Colour of the paths of centroids.
const TRACK: Rgb = Rgb([20, 60, 150]);
/// Points of type in a centimetre.
const POINTS_PER_CM: f64 = 72.0 / 2.54;

impl Look {
    /// Writes a picture of droplets in three dimensions, as SVG or PNG by the end of the name. It shows their surfaces,
    /// coloured by the concentration and shaded. Streamlines are of the flow in the horizontal plane through their
    /// middle. Grey lines show walls or a box. The eye looks down at a slant, with x to the right. The paths of the
    /// centroids so far are drawn (`tracks`; length).
    ///
    /// # Errors
    /// Returns the errors of [`Look::write_picture`].
    pub fn write_space_picture(
        &self,
        seen: &SpaceSnapshot,
        tracks: &[Vec<[f64; 3]>],
        path: impl AsRef<Path>,
    ) -> Result<(), OutputError> {
        OutputError::check_format(path.as_ref(), &["svg", "png"])?;
        self.space_picture(seen, tracks)?.write(path.as_ref(), 1.0)
    }

    /// Returns the text of the SVG file that [`Look::write_space_picture`] writes.
    ///
    /// # Errors
    /// Returns the same errors, except for the errors of the file.
    pub fn space_svg(&self, seen: &SpaceSnapshot, tracks: &[Vec<[f64; 3]>]) -> Result<String, OutputError> {
        Ok(self.space_picture(seen, tracks)?.svg())
    }

    fn space_picture(&self, seen: &SpaceSnapshot, tracks: &[Vec<[f64; 3]>]) -> Result<Drawing, OutputError> {
        self.check()?;
        let still = Format {
            width: (self.width * self.resolution).round(),
            em: self.font_size / POINTS_PER_CM * self.resolution,
            per_cm: Some(self.resolution),
            levels: 256,
            streamline_spacing: 1.0,
            follows: true,
        };
        let scale = self.space_scale(std::slice::from_ref(seen));
        self.draw_space(seen, seen.half, scale.as_ref(), tracks, &still)
    }

    /// Returns the colours of the concentrations of some states.
    fn space_scale(&self, all: &[SpaceSnapshot]) -> Option<ColourScale> {
        let unit = self.concentration.unwrap_or(1.0);
        let label = if self.concentration.is_some() { "concentration c/c_{0}" } else { "concentration c" };
        let values = all.iter().flat_map(|seen| &seen.meshes).flat_map(|mesh| &mesh.concentrations);
        // On the dark end of the other map, no shade would show.
        ColourScale::from_zero(values.map(|value| value / unit), label).map(ColourScale::green)
    }

    fn draw_space(
        &self,
        seen: &SpaceSnapshot,
        half: f64,
        scale: Option<&ColourScale>,
        tracks: &[Vec<[f64; 3]>],
        format: &Format,
    ) -> Result<Drawing, OutputError> {
        let (width, em) = (format.width, format.em);
        let margin = (0.8 * em).round();
        let inner = (width - 2.0 * margin).max(1.0);
        let area = Rect { left: margin, top: (2.4 * em).round(), width: inner, height: HEIGHT * inner }.rounded();
        let bars = if self.colour_bars && scale.is_some() { 5.0 * em } else { 0.8 * em };
        let mut drawing = Drawing::new([width, (area.bottom() + bars).round()]);
        drawing.per_cm = format.per_cm;
        drawing.origin.clone_from(&seen.origin);

        let pixels = inner / (2.0 * half);
        let camera = Camera::new(seen.centre, pixels, [0.5 * area.width, 0.5 * area.height]);
        let mut canvas = Canvas::new([area.width as usize, area.height as usize]);
        let unit = self.concentration.unwrap_or(1.0);
        for mesh in &seen.meshes {
            canvas.draw(mesh, &camera, scale.map(|scale| (scale, unit)));
        }
        drawing.clip(Some(area));
        drawing.shade(area, |x, y| canvas.pixel((x - area.left) as usize, (y - area.top) as usize));
        for line in &seen.outline {
            for part in visible(line, &camera, &canvas, area) {
                drawing.stroke(&part, &Pen::new(Rgb::GREY, 0.12 * em));
            }
        }
        let pen = Pen::new(Rgb::INK, (0.07 * em).max(0.8)).opacity(0.55);
        if self.streamlines
            && let Some(flow) = &seen.flow
        {
            let anchor = seen.centroids.first().map_or([0.0; 2], |place| [place[0], place[1]]);
            let spacing = self.streamline_spacing.unwrap_or(2.0 * half / LINES) * format.streamline_spacing;
            for line in streamlines(flow, spacing, anchor.into())? {
                let line: Vec<[f64; 3]> = line.iter().map(|at| [at.x, at.y, seen.centre[2]]).collect();
                for part in visible(&line, &camera, &canvas, area) {
                    drawing.stroke(&part, &pen);
                    head(&mut drawing, &part, 0.62 * em);
                }
            }
        }
        for track in tracks {
            for part in visible(track, &camera, &canvas, area) {
                drawing.stroke(&part, &Pen::new(Rgb::WHITE, 0.3 * em).opacity(0.75));
                drawing.stroke(&part, &Pen::new(TRACK, 0.14 * em));
            }
        }
        compass(&mut drawing, &camera, area, em);
        if self.scale_bar {
            self.space_scale_bar(&mut drawing, area, pixels, em);
        }
        drawing.clip(None);
        drawing.stroke(&area.outline(), &Pen::new(Rgb::GREY, (0.06 * em).max(0.8)));
        let title = format!("t = {}   {}", time_label(seen.time), self.caption);
        let size = 1.05 * em * (area.width / text_width(&title, 1.05 * em)).min(1.0);
        drawing.text([area.left, area.top - 1.15 * em], &title, &TextStyle::new(size, Anchor::Start));
        if let Some(scale) = scale.filter(|_| self.colour_bars) {
            let width = 0.6 * area.width;
            let left = area.left + 0.2 * area.width;
            let bar = Rect { left, top: area.bottom() + 0.8 * em, width, height: 0.9 * em }.rounded();
            let table = scale.table(256);
            drawing.shade(bar, |x, _| Some(table[(((x - bar.left) / bar.width * 256.0) as usize).min(255)]));
            let x = Axis::new(scale.label, [scale.low, scale.high], AxisScale::Linear, 6);
            Frame { area: bar, x, y: Axis::bare(), em }.draw_axes(&mut drawing);
        }
        Ok(drawing)
    }

    /// Draws a scale bar of length 1, 2 or 5 times a power of ten, at most a fifth of the picture's width.
    fn space_scale_bar(&self, drawing: &mut Drawing, area: Rect, pixels: f64, em: f64) {
        let length = nice_step_below(0.2 * area.width / pixels);
        let (right, y) = (area.right() - 1.2 * em, area.bottom() - 1.0 * em);
        let bar = [[right - length * pixels, y], [right, y]];
        drawing.stroke(&bar, &Pen::new(Rgb::WHITE, 0.5 * em).opacity(0.8));
        drawing.stroke(&bar, &Pen::new(Rgb::INK, 0.2 * em));
        let unit = if self.length_unit.is_empty() { String::new() } else { format!(" {}", self.length_unit) };
        let at = [right - 0.5 * length * pixels, y - 0.95 * em];
        drawing.text(at, &(number(length) + &unit), &TextStyle::new(0.88 * em, Anchor::Middle));
    }
}

/// Returns the parts of a line through places that no surface hides, as pixels of the drawing.
fn visible(line: &[[f64; 3]], camera: &Camera, canvas: &Canvas, area: Rect) -> Vec<Vec<Pixel>> {
    let (mut parts, mut part): (Vec<Vec<Pixel>>, Vec<Pixel>) = Default::default();
    for point in line {
        let (at, depth) = camera.place(*point);
        if canvas.shows(at, depth) {
            part.push([area.left + at[0], area.top + at[1]]);
        } else if !part.is_empty() {
            parts.push(std::mem::take(&mut part));
        }
    }
    parts.push(part);
    parts.retain(|part| part.len() > 1);
    parts
}

/// Draws an arrow head in the middle of a line.
fn head(drawing: &mut Drawing, line: &[Pixel], size: f64) {
    let k = line.len() / 2;
    let [Some(&at), Some(&before)] = [line.get(k), line.get(k.saturating_sub(1))] else { return };
    let (dx, dy) = (at[0] - before[0], at[1] - before[1]);
    let length = dx.hypot(dy);
    if length <= 0.0 || line.len() < 8 {
        return;
    }
    let (c, s) = (dx * size / length, dy * size / length);
    let corner = |along: f64, across: f64| [at[0] + along * c - across * s, at[1] + along * s + across * c];
    let ring = vec![corner(0.6, 0.0), corner(-0.4, 0.32), corner(-0.22, 0.0), corner(-0.4, -0.32)];
    drawing.fill(&[ring], Rgb::INK, 0.75);
}

/// Draws the directions of the axes in the lower left corner.
fn compass(drawing: &mut Drawing, camera: &Camera, area: Rect, em: f64) {
    let origin = [area.left + 2.6 * em, area.bottom() - 2.4 * em];
    let (zero, _) = camera.place([0.0; 3]);
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        let mut place = [0.0; 3];
        place[axis] = 1.0;
        let (tip, _) = camera.place(place);
        let [dx, dy] = [0, 1].map(|k| (tip[k] - zero[k]) / camera.scale() * 1.7 * em);
        let end = [origin[0] + dx, origin[1] + dy];
        drawing.stroke(&[origin, end], &Pen::new(Rgb::INK, (0.1 * em).max(1.0)));
        let length = dx.hypot(dy).max(1e-9);
        let at = [end[0] + 0.6 * em * dx / length, end[1] + 0.6 * em * dy / length];
        drawing.text(at, name, &TextStyle::new(0.8 * em, Anchor::Middle));
    }
}

/// Observer that takes [`SpaceSnapshot`]s of a run and writes them as an animation when the run ends.
#[derive(Debug, Clone)]
pub struct SpaceAnimation {
    look: Look,
    body: Handle<SpaceBody>,
    frames: Vec<SpaceSnapshot>,
}

impl SpaceAnimation {
    /// Creates a film of droplets, without frames yet.
    #[must_use]
    pub fn new(look: Look, body: Handle<SpaceBody>) -> Self {
        Self { look, body, frames: Vec::new() }
    }

    /// Returns the time of the first frame, later than the scene's start in a run that was resumed.
    #[must_use]
    pub fn begins(&self) -> Option<f64> {
        self.frames.first().map(|seen| seen.time)
    }

    /// Returns the paths of all centroids through the frames up to a time.
    fn tracks(&self, until: f64) -> Vec<Vec<[f64; 3]>> {
        let count = self.frames.first().map_or(0, |seen| seen.centroids.len());
        let frames = || self.frames.iter().filter(move |seen| seen.time <= until);
        (0..count).map(|k| frames().filter_map(|seen| seen.centroids.get(k).copied()).collect()).collect()
    }

    /// Writes the animation as a GIF that repeats forever. The view follows the droplets and keeps its size.
    ///
    /// # Errors
    /// Returns [`OutputError::Empty`] if there are no frames; [`OutputError::Write`].
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), OutputError> {
        let scale = self.look.space_scale(&self.frames);
        let half = self.frames.iter().map(|seen| seen.half).fold(0.0, f64::max);
        let mut frames = Frames::new();
        for seen in &self.frames {
            let drawing = self.look.draw_space(seen, half, scale.as_ref(), &self.tracks(seen.time), &Format::FRAME)?;
            frames.push(&drawing.pixels(1.0)?);
        }
        frames.write(path.as_ref(), self.frames.first().map_or("", |seen| &seen.origin))
    }
}

impl<H: Hydrodynamics> Observer<H> for SpaceAnimation {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        self.frames.push(SpaceSnapshot::take(system, self.body, FRAME_CELLS)?);
        Ok(())
    }
}

#[cfg(test)]
mod tests;
