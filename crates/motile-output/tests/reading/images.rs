//! Plots as PNG files.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use motile_output::plot::{Figure, Plot, SERIES_COLOURS, Series};

use crate::{Directory, svg};

/// Image of a PNG file: width, height, and the colours of its pixels.
pub(crate) struct Image {
    pub(crate) size: [usize; 2],
    pixels: Vec<[u8; 3]>,
    /// Pixels per metre, if the file tells.
    #[expect(dead_code, reason = "plots have no size on paper")]
    pub(crate) per_metre: Option<[u32; 2]>,
}

impl Image {
    pub(crate) fn read(path: &Path) -> Self {
        let decoder = png::Decoder::new(BufReader::new(File::open(path).expect("a file")));
        let mut reader = decoder.read_info().expect("a header");
        let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
        let frame = reader.next_frame(&mut bytes).expect("pixels");
        assert_eq!(frame.color_type, png::ColorType::Rgba);
        let pixels = bytes.chunks(4).map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        let per_metre = reader.info().pixel_dims.map(|dims| [dims.xppu, dims.yppu]);
        Self { size: [frame.width as usize, frame.height as usize], pixels, per_metre }
    }

    /// Colour of the pixel at a position (pixels).
    pub(crate) fn at(&self, [x, y]: [f64; 2]) -> [u8; 3] {
        self.pixels[y as usize * self.size[0] + x as usize]
    }
}

#[test]
fn a_plot_shows_its_lines_where_its_vectors_have_them() {
    let directory = Directory::new("plot");
    let waves = [0.0, 2.0].map(|phase| (0..60).map(f64::from).map(move |k| (k, (0.1 * k + phase).sin())));
    let [first, second] = waves.map(|points| Series::line("", points));
    Figure::new(1).panel(Plot::new("waves").series(first).series(second)).write(&directory.0, "waves").unwrap();
    let text = directory.text("waves.svg");
    let document = roxmltree::Document::parse(&text).unwrap();
    let image = Image::read(&directory.0.join("waves.png"));
    assert_eq!(image.size, [1080, 680]);
    assert_eq!(image.at([2.0, 2.0]), [255; 3]);
    for (k, colour) in SERIES_COLOURS[..2].iter().enumerate() {
        let line = &svg::strokes(&document, colour.0)[0][0];
        assert_eq!(line.len(), 60);
        // Where the lines cross one is below the other.
        let seen = line.iter().filter(|at| image.at(at.map(|v| 2.0 * v)) == colour.0).count();
        assert!(seen >= 56, "{k}: {seen}");
    }
}
