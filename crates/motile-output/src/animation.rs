//! Animated GIF files.

pub(crate) mod film;
mod palette;

use std::{
    fs::File,
    io::BufWriter,
    path::{Path, PathBuf},
};

use anyhow::{Context, Result, ensure};

use crate::{
    Canvas,
    animation::palette::{Histogram, code},
};

/// The index of the palette that means "as in the frame before".
const UNCHANGED: u8 = 255;

/// Collects frames and writes them as an animated GIF with one palette for all of them.
///
/// One palette for all keeps colours from flickering, but has to know them all: frames stay in memory (two bytes a
/// pixel) until [`Animation::finish`].
#[derive(Debug, Clone)]
pub struct Animation {
    path: PathBuf,
    size: Option<[usize; 2]>,
    frames: Vec<Vec<u16>>,
    histogram: Histogram,
    hundredths: u16,
}

impl Animation {
    /// An animation to be written to `path`, at `rate` frames a second (1 to 50).
    #[must_use]
    pub fn new(path: &Path, rate: f64) -> Self {
        let hundredths = (100.0 / rate.clamp(1.0, 50.0)).round() as u16;
        Self { path: path.to_path_buf(), size: None, frames: Vec::new(), histogram: Histogram::new(), hundredths }
    }

    /// Adds a frame.
    ///
    /// # Errors
    /// A frame of another size than the first.
    pub fn push(&mut self, frame: &Canvas) -> Result<()> {
        let size = *self.size.get_or_insert(frame.size());
        ensure!(size == frame.size(), "a frame of {:?} pixels in an animation of {size:?}", frame.size());
        for &pixel in frame.pixels() {
            self.histogram.add(pixel);
        }
        self.frames.push(frame.pixels().iter().map(|&p| code(p)).collect());
        Ok(())
    }

    /// Number of frames so far.
    #[must_use]
    pub fn len(&self) -> usize {
        self.frames.len()
    }

    /// Whether there are no frames yet.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.frames.is_empty()
    }

    /// Writes the file: the animation repeats for ever, its last frame stays for a second and a half. Of each frame
    /// only what differs from the one before is stored.
    ///
    /// # Errors
    /// No frames, frames of more than 65535 pixels a side, or a file that cannot be written.
    pub fn finish(self) -> Result<()> {
        let path = self.path.clone();
        self.write().with_context(|| format!("writing {}", path.display()))
    }

    fn write(self) -> Result<()> {
        let Some([width, height]) = self.size else { anyhow::bail!("an animation without frames") };
        let (palette, index) = self.histogram.palette(usize::from(UNCHANGED));
        let palette: Vec<u8> = palette.into_iter().flat_map(|c| c.0).collect();
        let file = BufWriter::new(File::create(&self.path)?);
        let mut encoder = gif::Encoder::new(file, u16::try_from(width)?, u16::try_from(height)?, &palette)?;
        encoder.set_repeat(gif::Repeat::Infinite)?;
        let mut before: Vec<u8> = Vec::new();
        let count = self.frames.len();
        for (k, codes) in self.frames.into_iter().enumerate() {
            let now: Vec<u8> = codes.into_iter().map(|c| index[usize::from(c)]).collect();
            let delay = if k + 1 == count { 150 } else { self.hundredths };
            let mut frame = changes(&before, &now, width)?;
            frame.delay = delay;
            encoder.write_frame(&frame)?;
            before = now;
        }
        Ok(())
    }
}

/// The smallest rectangle in which the frame differs from the one before, with equal pixels transparent.
fn changes(before: &[u8], now: &[u8], width: usize) -> Result<gif::Frame<'static>> {
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
    Ok(gif::Frame {
        left: u16::try_from(x[0])?,
        top: u16::try_from(y[0])?,
        width: u16::try_from(x[1] - x[0])?,
        height: u16::try_from(y[1] - y[0])?,
        transparent: Some(UNCHANGED),
        dispose: gif::DisposalMethod::Keep,
        buffer: buffer.into(),
        ..gif::Frame::default()
    })
}

#[cfg(test)]
mod tests;
