use super::*;
use crate::Rgb;

#[test]
fn frames_come_back_from_the_file() {
    let path = std::env::temp_dir().join(format!("motile-animation-{}.gif", std::process::id()));
    let (white, red, blue) = (Rgb::WHITE, Rgb([250, 10, 10]), Rgb([10, 10, 250]));
    let mut histogram = Histogram::new();
    let mut frame = |colour: Rgb, from: usize| -> Vec<u16> {
        let pixel = |k: usize| {
            let inside = (from..from + 10).contains(&(k % 40)) && (7..17).contains(&(k / 40));
            if inside { colour } else { white }
        };
        (0..40 * 30).map(pixel).inspect(|&pixel| histogram.add(pixel)).map(code).collect()
    };
    let frames = [frame(red, 5), frame(blue, 15), frame(blue, 15)];
    encode(&path, [40, 30], &frames, &histogram, "").unwrap();

    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(File::open(&path).unwrap()).unwrap();
    assert_eq!((decoder.width(), decoder.height()), (40, 30));
    let mut frames = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        frames.push(frame.clone());
    }
    std::fs::remove_file(&path).unwrap();
    assert_eq!(frames.len(), 3);
    assert_eq!(&frames[0].buffer[(10 * 40 + 8) * 4..][..4], &[250, 10, 10, 255]);
    // The second frame covers both squares, the third changes nothing.
    assert_eq!([frames[1].left, frames[1].top, frames[1].width, frames[1].height], [5, 7, 20, 10]);
    assert_eq!(&frames[1].buffer[12 * 4..][..4], &[10, 10, 250, 255]);
    assert_eq!([frames[2].width, frames[2].height], [1, 1]);
    assert_eq!(frames[2].buffer[3], 0, "transparent");
}

#[test]
fn an_animation_without_frames_is_refused() {
    let raster = Raster::new([0.0; 2], [1.0; 2], [8; 2], [true; 2]).unwrap();
    let film = Animation::new(Look::default(), raster);
    assert!(matches!(film.write(&[], "/nowhere/none.gif"), Err(OutputError::Empty(_))));
}

#[test]
fn frames_have_the_width_that_is_asked_for() {
    use motile::prelude::{Built, Setup};
    let Built { mut scene, .. } = Setup::default().build().unwrap();
    let path = std::env::temp_dir().join(format!("motile-width-{}.gif", std::process::id()));
    let mut film = Animation::new(Look::default(), Raster::of(scene.system(), 0.5).unwrap()).of_width(150.0);
    film.observe(scene.system_mut()).unwrap();
    film.write(&[], &path).unwrap();
    let width = || gif::DecodeOptions::new().read_info(File::open(&path).unwrap()).unwrap().width();
    assert_eq!(width(), 150);
    let mut usual = Animation::new(Look::default(), Raster::of(scene.system(), 0.5).unwrap());
    usual.observe(scene.system_mut()).unwrap();
    usual.write(&[], &path).unwrap();
    assert_eq!(f64::from(width()), Format::FRAME.width);
    std::fs::remove_file(&path).unwrap();
    for pixels in [99.0, 2001.0, f64::NAN] {
        let refused = film.clone().of_width(pixels).write(&[], &path).unwrap_err();
        assert!(matches!(refused, OutputError::Size { .. }), "{refused}");
    }
}
