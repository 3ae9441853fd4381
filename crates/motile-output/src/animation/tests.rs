use super::*;
use crate::{
    Rgb,
    drawing::{Surface, canvas::Canvas},
};

#[test]
fn frames_come_back_from_the_file() {
    let path = std::env::temp_dir().join(format!("motile-animation-{}.gif", std::process::id()));
    let mut animation = Animation::new(20.0);
    let colours = [Rgb([250, 10, 10]), Rgb([10, 10, 250]), Rgb([10, 10, 250])];
    for (k, colour) in colours.into_iter().enumerate() {
        let mut canvas = Canvas::new(40, 30).unwrap();
        let x = 5.0 + 10.0 * k.min(1) as f64;
        canvas.fill(&[vec![[x, 5.0], [x + 10.0, 5.0], [x + 10.0, 15.0], [x, 15.0]]], colour, 1.0);
        animation.push(&canvas.into_image()).unwrap();
    }
    assert!(animation.push(&Image::new(10, 10).unwrap()).is_err());
    animation.write(&path).unwrap();

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
    assert_eq!([frames[1].left, frames[1].top, frames[1].width, frames[1].height], [5, 5, 20, 10]);
    assert_eq!(&frames[1].buffer[12 * 4..][..4], &[10, 10, 250, 255]);
    assert_eq!([frames[2].width, frames[2].height], [1, 1]);
    assert_eq!(frames[2].buffer[3], 0, "transparent");
}

#[test]
fn an_animation_without_frames_is_refused() {
    assert!(matches!(Animation::new(10.0).write("/nowhere/none.gif"), Err(Error::Empty(_))));
}
