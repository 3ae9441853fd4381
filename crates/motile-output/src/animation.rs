//! Animations of runs as GIF files.

mod palette;

use std::{fs::File, io, io::BufWriter, path::Path};

use motile::scene::{Hydrodynamics, Observer, System};
use palette::{Histogram, code};
use tiny_skia::Pixmap;

use crate::drawing::raster::colours;
use crate::picture::contents::Format;
use crate::{Look, OutputError, Raster, Snapshot, SolidColour, Track};

/// Time between two frames, and duration of the last one (hundredths of a second).
const DELAY: u16 = 8;
const END: u16 = 150;
/// Largest number of cells of a frame's fields in a direction: a cell is then four pixels wide.
const FRAME_CELLS: usize = 120;
/// Smallest type (pixels), and fewest colours of the pressure.
const LEAST_TYPE: f64 = 9.0;
const LEAST_LEVELS: usize = 8;
/// Index of the palette for pixels that stay as in the frame before.
const UNCHANGED: u8 = 255;

/// Observer that takes [`Snapshot`]s of a run and writes them as an animation when the run ends.
///
/// ```
/// use motile::prelude::*;
/// use motile_output::{Animation, Look, Raster};
///
/// let Built { mut scene, .. } = Setup::default().build()?;
/// let mut film = Animation::new(Look::default(), Raster::of(scene.system(), 0.2)?);
/// scene.run(0.2).observe(Every::Time(0.1), &mut film).go()?;
/// assert_eq!(film.begins(), Some(0.0));
/// let path = std::env::temp_dir().join("a-droplet.gif");
/// film.write(&[], &path)?;
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Animation {
    look: Look,
    raster: Raster,
    format: Format,
    frames: Vec<Snapshot>,
}

impl Animation {
    /// Creates a film of the rectangle of `raster`, with fields on its cells or, if there are more than 120 in a
    /// direction, on larger ones.
    #[must_use]
    pub fn new(look: Look, raster: Raster) -> Self {
        Self { look, raster: raster.coarsened(FRAME_CELLS), format: Format::FRAME, frames: Vec::new() }
    }

    /// Uses frames `pixels` wide (100 to 2000) in place of 440; narrower ones have fewer colours of the pressure, and a
    /// file grows with their area.
    #[must_use]
    pub fn of_width(self, pixels: f64) -> Self {
        let (usual, factor) = (Format::FRAME, pixels / Format::FRAME.width);
        let levels = (usual.levels as f64 * factor.min(1.0)).round() as usize;
        let em = (usual.em * factor).max(LEAST_TYPE);
        Self { format: Format { width: pixels, em, levels: levels.max(LEAST_LEVELS), ..usual }, ..self }
    }

    /// Returns the time of the first frame, later than the scene's start in a run that was resumed: frames are kept
    /// with the film alone.
    #[must_use]
    pub fn begins(&self) -> Option<f64> {
        self.frames.first().map(|seen| seen.time)
    }

    /// Writes the animation as a GIF that repeats forever; between walls each frame shows the tracks up to its time.
    ///
    /// # Errors
    /// Returns [`OutputError::Empty`] if there are no frames; [`OutputError::Size`] for a width outside of 100 to 2000
    /// pixels; [`OutputError::Write`]; the errors of drawing the frames.
    pub fn write(&self, tracks: &[Track], path: impl AsRef<Path>) -> Result<(), OutputError> {
        OutputError::check_size("an animation with a width (pixels)", self.format.width, 100.0, 2000.0)?;
        let legends = self.look.legends(&self.frames);
        let mut frames = Frames::new();
        for seen in &self.frames {
            frames.push(&self.look.draw(seen, &legends, tracks, &self.format)?.pixels(1.0)?);
        }
        let origin = self.frames.first().map_or("", |seen| &seen.origin);
        frames.write(path.as_ref(), origin)
    }
}

/// Frames of an animation, of one size. One palette for all of them keeps colours from flickering, but has to know them
/// all.
pub(crate) struct Frames {
    histogram: Histogram,
    frames: Vec<Vec<u16>>,
    size: [usize; 2],
}

impl Frames {
    pub(crate) fn new() -> Self {
        Self { histogram: Histogram::new(), frames: Vec::new(), size: [0; 2] }
    }

    /// Adds a frame.
    pub(crate) fn push(&mut self, image: &Pixmap) {
        colours(image).for_each(|colour| self.histogram.add(colour));
        self.frames.push(colours(image).map(code).collect());
        self.size = [image.width(), image.height()].map(|side| side as usize);
    }

    /// Writes a GIF that repeats forever, with the origin of the results as its comment.
    pub(crate) fn write(&self, path: &Path, origin: &str) -> Result<(), OutputError> {
        OutputError::check_format(path, &["gif"])?;
        if self.frames.is_empty() {
            return Err(OutputError::Empty("an animation without frames"));
        }
        let written = encode(path, self.size, &self.frames, &self.histogram, origin).map_err(io::Error::other);
        written.map_err(OutputError::writing(path))
    }
}

/// Writes frames of colour codes; each frame holds only the rectangle that differs from the one before.
fn encode(
    path: &Path,
    size: [usize; 2],
    frames: &[Vec<u16>],
    histogram: &Histogram,
    origin: &str,
) -> Result<(), gif::EncodingError> {
    let (palette, index) = histogram.palette(usize::from(UNCHANGED));
    let palette: Vec<u8> = palette.into_iter().flat_map(|c| c.0).collect();
    let [width, height] = size.map(|side| side as u16);
    let mut encoder = gif::Encoder::new(BufWriter::new(File::create(path)?), width, height, &palette)?;
    encoder.set_repeat(gif::Repeat::Infinite)?;
    if !origin.is_empty() {
        let blocks: Vec<&[u8]> = origin.as_bytes().chunks(255).collect();
        encoder.write_raw_extension(gif::Extension::Comment.into(), &blocks)?;
    }
    let mut before: Vec<u8> = Vec::new();
    for (k, codes) in frames.iter().enumerate() {
        let now: Vec<u8> = codes.iter().map(|&c| index[usize::from(c)]).collect();
        let delay = if k + 1 == frames.len() { END } else { DELAY };
        encoder.write_frame(&gif::Frame { delay, ..changes(&before, &now, size[0]) })?;
        before = now;
    }
    Ok(())
}

/// Returns the smallest rectangle in which the frame differs from the one before, with equal pixels transparent.
fn changes(before: &[u8], now: &[u8], width: usize) -> gif::Frame<'static> {
    let first = before.is_empty();
    let changed = |k: usize| first || before[k] != now[k];
    let (mut x, mut y) = ([width, 0], [now.len() / width, 0]);
    for k in (0..now.len()).filter(|&k| changed(k)) {
        let (column, row) = (k % width, k / width);
        x = [x[0].min(column), x[1].max(column + 1)];
        y = [y[0].min(row), y[1].max(row + 1)];
    }
    if x[0] >= x[1] {
        // Nothing changed: one transparent pixel keeps the time.
        (x, y) = ([0, 1], [0, 1]);
    }
    let pixel = |k: usize| if changed(k) { now[k] } else { UNCHANGED };
    let buffer: Vec<u8> =
        (y[0]..y[1]).flat_map(|row| (x[0]..x[1]).map(move |column| row * width + column)).map(pixel).collect();
    gif::Frame {
        left: x[0] as u16,
        top: y[0] as u16,
        width: (x[1] - x[0]) as u16,
        height: (y[1] - y[0]) as u16,
        transparent: Some(UNCHANGED),
        dispose: gif::DisposalMethod::Keep,
        buffer: buffer.into(),
        ..gif::Frame::default()
    }
}

impl<H: Hydrodynamics> Observer<H> for Animation {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        let mut seen = Snapshot::take(system, self.raster)?;
        if self.look.solids == SolidColour::Plain {
            // Triangles that are not shown need not be kept.
            seen.solids.iter_mut().for_each(|solid| solid.triangles = Vec::new());
        }
        self.frames.push(seen);
        Ok(())
    }
}

#[cfg(test)]
mod tests;
