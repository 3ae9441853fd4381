//! Plots and pictures as PNG files, and pictures as SVG files.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use motile::prelude::*;
use motile_output::plot::{Figure, Plot, SERIES_COLOURS, Series};
use motile_output::{Animation, Look, ParaView, Raster, Snapshot, SolidColour, SolidShape};

use crate::{Directory, svg};

/// Image of a PNG file: width, height, and the colours of its pixels.
pub(crate) struct Image {
    pub(crate) size: [usize; 2],
    pixels: Vec<[u8; 3]>,
    /// Pixels per metre, if the file tells.
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

/// A picture of a droplet in a box of 6 x 4, with these settings, as both kinds of files.
fn picture(directory: &Directory, look: &Look) -> (Image, String) {
    let region = Region::Box { lengths: [6.0, 4.0] };
    let method = Method::Grid(GridMethod::of_spacing(0.25));
    let mut scene = Setup { region, method, ..Setup::default() }.build().expect("a scene").scene;
    let raster = Raster::of(scene.system(), 0.25).expect("a raster");
    let seen = Snapshot::take(scene.system_mut(), raster).expect("a snapshot");
    let [png, text] = ["picture.png", "picture.svg"].map(|name| directory.0.join(name));
    look.write_picture(&seen, &[], &png).expect("a picture");
    look.write_picture(&seen, &[], &text).expect("a picture");
    (Image::read(&png), directory.text("picture.svg"))
}

#[test]
fn a_picture_has_its_size_on_paper() {
    let directory = Directory::new("size");
    let look = Look { width: 8.5, resolution: 100.0, font_size: 9.0, ..Look::default() };
    let (image, text) = picture(&directory, &look);
    assert_eq!((image.size[0], image.per_metre), (850, Some([10_000; 2])));
    let document = roxmltree::Document::parse(&text).unwrap();
    let height = format!("{}cm", image.size[1] as f64 / 100.0);
    let root = document.root_element();
    assert_eq!([root.attribute("width"), root.attribute("height")], [Some("8.5cm"), Some(height.as_str())]);
    assert_eq!(root.attribute("viewBox"), Some(format!("0 0 850 {}", image.size[1]).as_str()));
    // Capitals of tick labels, which are 0.88 of the type, are 0.714 as high as it; a point is 2.54/72 cm.
    let zero = document.descendants().find(|node| node.attribute("aria-label") == Some("0")).unwrap();
    let heights: Vec<f64> = svg::lines(zero).concat().iter().map(|p| p[1]).collect();
    let [top, bottom] = [f64::min, f64::max].map(|pick| heights.iter().copied().reduce(pick).unwrap());
    let expected = 0.88 * 0.714 * 9.0 * 2.54 / 72.0 * 100.0;
    assert!((bottom - top - expected).abs() < 0.06 * expected, "{top} {bottom} {expected}");
}

#[test]
fn a_picture_has_what_is_switched_on() {
    let directory = Directory::new("switches");
    let words = |look: &Look| {
        let (image, text) = picture(&directory, look);
        let document = roxmltree::Document::parse(&text).unwrap();
        let texts = svg::texts(&document);
        let faint = document.descendants().filter(|node| node.attribute("stroke-opacity") == Some("0.72")).count();
        (image.size[1], faint, texts)
    };
    let has = |texts: &[(String, [f64; 2])], label: &str| texts.iter().any(|(text, _)| text == label);
    let all = Look { panel: "b)".into(), caption: "a droplet".into(), length_unit: "µm".into(), ..Look::default() };
    let (height, lines, texts) = words(&all);
    for label in ["b)", "t = 0.0   a droplet", "1 µm", "x (µm)", "y (µm)", "pressure p", "concentration c"] {
        assert!(has(&texts, label), "{label}: {texts:?}");
    }
    let title = texts.iter().find(|(text, _)| text.starts_with('t')).unwrap();
    let panel = texts.iter().find(|(text, _)| text == "b)").unwrap();
    assert!(panel.1[0] < title.1[0] - 50.0 && (panel.1[1] - title.1[1]).abs() < 8.0, "{panel:?} {title:?}");
    assert!(lines > 10);
    let none = Look { streamlines: false, scale_bar: false, colour_bars: false, length_unit: String::new(), ..all };
    let (lower, lines, texts) = words(&none);
    assert!(lower < height && lines == 0 && has(&texts, "x"));
    assert!(["1", "1 µm", "pressure p"].iter().filter(|label| has(&texts, label)).count() <= 1, "{texts:?}");
}

/// Solid whose stress is known in one of the two triangles of its square: the other one has the grey of solids.
#[test]
fn a_solid_is_filled_where_its_triangles_have_no_colour() {
    let directory = Directory::new("solid");
    let (region, method) = (Region::Box { lengths: [6.0, 6.0] }, Method::Grid(GridMethod::of_spacing(0.25)));
    let mut scene = Setup { region, method, ..Setup::default() }.build().unwrap().scene;
    let raster = Raster::of(scene.system(), 0.25).unwrap();
    let mut seen = Snapshot::take(scene.system_mut(), raster).unwrap();
    let square = [[1.6, 1.6], [2.8, 1.6], [2.8, 2.8], [1.6, 2.8]].map(Vec2::from);
    let mut solid = SolidShape::default();
    solid.area = vec![square.to_vec()];
    solid.triangles = vec![[square[0], square[1], square[2]]];
    solid.stress = vec![1.0];
    seen.solids.push(solid);
    let look = Look { solids: SolidColour::Stress, scale_bar: false, streamlines: false, ..Look::default() };
    let (png, text) = (directory.0.join("solid.png"), directory.0.join("solid.svg"));
    look.write_picture(&seen, &[], &png).unwrap();
    look.write_picture(&seen, &[], &text).unwrap();
    let text = directory.text("solid.svg");
    let document = roxmltree::Document::parse(&text).unwrap();
    let ([left, top, right, bottom], image) = (svg::area(&document), Image::read(&png));
    let at = |[x, y]: [f64; 2]| {
        image.at([left + (x + 3.0) / 6.0 * (right - left), bottom + (y + 3.0) / 6.0 * (top - bottom)])
    };
    let (coloured, plain) = (at([2.5, 1.9]), at([1.9, 2.5]));
    assert_eq!(plain, [196, 190, 180]);
    let [red, green, blue] = coloured.map(i32::from);
    assert!((red - blue).abs().max((green - blue).abs()) > 100, "{coloured:?}");
}

/// Ends of the colour bar that pressures exceed are triangles, in the colours of the ends.
#[test]
fn exceeded_ends_of_colours_are_triangles() {
    let directory = Directory::new("ends");
    let triangles = |range| {
        let (_, text) = picture(&directory, &Look { pressure_range: Some(range), ..Look::default() });
        let document = roxmltree::Document::parse(&text).unwrap();
        let filled = document.descendants().filter(|node| node.attribute("fill").is_some_and(|fill| fill != "none"));
        let paths = filled.filter(|node| node.has_tag_name("path") && node.attribute("aria-label").is_none());
        let corners = paths.filter(|node| svg::lines(*node)[0].len() == 3);
        corners.map(|node| node.attribute("fill").map(str::to_owned)).collect::<Vec<_>>().len()
    };
    assert_eq!([triangles([-1e6, 1e6]), triangles([-1e6, 1e-3]), triangles([-1e-3, 1e-3])], [0, 1, 2]);
}

#[test]
fn files_carry_the_origin_of_their_results() {
    let directory = Directory::new("origin");
    let region = Region::Box { lengths: [6.0, 4.0] };
    let method = Method::Grid(GridMethod::of_spacing(0.5));
    let setup = Setup { region, method, ..Setup::default() };
    let mut scene = setup.build().expect("a scene").scene;
    let origin = format!("{}; command: swim --of 'größe'", setup.origin());
    assert!(origin.starts_with(&format!("motile {}; scene {}", motile::VERSION, setup.fingerprint())));
    scene.system_mut().set_origin(origin.as_str());
    let raster = Raster::of(scene.system(), 0.5).expect("a raster");
    let mut film = Animation::new(Look::default(), raster);
    let mut files = ParaView::create(&directory.0, raster).expect("a directory");
    scene.run(0.01).observe(Every::Time(0.01), &mut film).observe(Every::Time(0.01), &mut files).go().expect("a run");
    film.write(&[], directory.0.join("film.gif")).expect("a film");
    let seen = Snapshot::take(scene.system_mut(), raster).expect("a snapshot");
    for name in ["picture.png", "picture.svg"] {
        Look::default().write_picture(&seen, &[], directory.0.join(name)).expect("a picture");
    }
    scene.checkpoint("").write(&directory.0.join("state")).expect("a checkpoint");
    let written: Vec<_> = std::fs::read_dir(&directory.0).expect("files").flatten().map(|entry| entry.path()).collect();
    let pieces = written.iter().filter(|path| path.extension().is_none_or(|kind| kind != "pvd"));
    let shown = |path: &Path| match path.extension() {
        Some(kind) if kind == "vtp" || kind == "vti" => origin.replace("--", "- -"),
        _ => origin.clone(),
    };
    for path in pieces {
        let (bytes, text) = (std::fs::read(path).expect("a file"), shown(path));
        assert!(bytes.windows(text.len()).any(|part| part == text.as_bytes()), "{}", path.display());
    }
    let file = BufReader::new(File::open(directory.0.join("picture.png")).expect("a file"));
    let png = png::Decoder::new(file).read_info().expect("a picture");
    assert_eq!(png.info().utf8_text[0].get_text().expect("a text"), origin);
}
