//! Images.

use std::{fs::File, io, io::BufWriter, path::Path};

use crate::{Error, Rgb};

/// Largest width and height (pixels).
const LARGEST: usize = 16_384;

/// An image of 8-bit RGB pixels.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Image {
    pub(crate) size: [usize; 2],
    pub(crate) pixels: Vec<Rgb>,
}

impl Image {
    /// A white image.
    ///
    /// # Errors
    /// [`Error::Size`]: no pixels, or more than 16384 in a direction.
    pub(crate) fn new(width: usize, height: usize) -> Result<Self, Error> {
        for side in [width, height] {
            Error::check_size("an image with a side (pixels)", side as f64, 1.0, LARGEST as f64)?;
        }
        Ok(Self { size: [width, height], pixels: vec![Rgb::WHITE; width * height] })
    }

    /// Width and height (pixels).
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// The pixels, row after row from the top.
    #[must_use]
    pub fn pixels(&self) -> &[Rgb] {
        &self.pixels
    }

    /// Writes the image as PNG.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn write_png(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        let path = path.as_ref();
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
}
