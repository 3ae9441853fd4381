//! Animated GIF files.

pub(crate) mod film;
mod palette;

use std::{fs::File, io, io::BufWriter, path::Path};

use palette::{Histogram, code};

use crate::{Error, drawing::image::Image};

/// The index of the palette that means "as in the frame before".
const UNCHANGED: u8 = 255;
/// How long the last frame stays (hundredths of a second).
const END: u16 = 150;

/// Collects frames and writes them as an animated GIF with one palette for all of them.
///
/// One palette for all keeps colours from flickering, but has to know them all: frames stay in memory (two bytes a
/// pixel) until [`Animation::write`].
#[derive(Debug, Clone)]
pub struct Animation {
    size: [usize; 2],
    frames: Vec<Vec<u16>>,
    histogram: Histogram,
    hundredths: u16,
}

impl Animation {
    /// An animation of `rate` frames a second (1 to 50).
    #[must_use]
    pub fn new(rate: f64) -> Self {
        let hundredths = (100.0 / rate.clamp(1.0, 50.0)).round() as u16;
        Self { size: [0, 0], frames: Vec::new(), histogram: Histogram::new(), hundredths }
    }

    /// Adds a frame.
    ///
    /// # Errors
    /// [`Error::Count`]: a frame of another size than the first.
    pub fn push(&mut self, frame: &Image) -> Result<(), Error> {
        if self.frames.is_empty() {
            self.size = frame.size();
        }
        for (given, expected) in frame.size().into_iter().zip(self.size) {
            Error::check_count("pixels of a side of a frame", given, expected)?;
        }
        for &pixel in frame.pixels() {
            self.histogram.add(pixel);
        }
        self.frames.push(frame.pixels().iter().map(|&p| code(p)).collect());
        Ok(())
    }

    /// Writes the file: the animation repeats for ever, its last frame stays for a second and a half. Of each frame
    /// only what differs from the one before is stored.
    ///
    /// # Errors
    /// [`Error::Empty`] without frames, [`Error::Write`].
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        if self.frames.is_empty() {
            return Err(Error::Empty("an animation without frames"));
        }
        self.encode(path.as_ref()).map_err(io::Error::other).map_err(Error::writing(path.as_ref()))
    }

    fn encode(&self, path: &Path) -> Result<(), gif::EncodingError> {
        let (palette, index) = self.histogram.palette(usize::from(UNCHANGED));
        let palette: Vec<u8> = palette.into_iter().flat_map(|c| c.0).collect();
        let [width, height] = self.size.map(|side| side as u16);
        let mut encoder = gif::Encoder::new(BufWriter::new(File::create(path)?), width, height, &palette)?;
        encoder.set_repeat(gif::Repeat::Infinite)?;
        let mut before: Vec<u8> = Vec::new();
        for (k, codes) in self.frames.iter().enumerate() {
            let now: Vec<u8> = codes.iter().map(|&c| index[usize::from(c)]).collect();
            let delay = if k + 1 == self.frames.len() { END } else { self.hundredths };
            encoder.write_frame(&gif::Frame { delay, ..changes(&before, &now, self.size[0]) })?;
            before = now;
        }
        Ok(())
    }
}

/// The smallest rectangle in which the frame differs from the one before, with equal pixels transparent.
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

#[cfg(test)]
mod tests;
