use super::*;
use crate::Rgb;
use crate::drawing::{Anchor, Pen, Rect, TextStyle};

#[test]
fn elements_have_their_coordinates_and_groups_close() {
    let mut drawing = Drawing::new([100.0, 50.0]);
    drawing.clip(Some(Rect { left: 1.0, top: 2.0, width: 30.0, height: 40.0 }));
    drawing.stroke(&[[1.0, 2.5], [3.256, 4.0]], &Pen::new(Rgb::INK, 1.5));
    drawing.stroke(&[[1.0, f64::NAN], [3.0, 4.0]], &Pen::new(Rgb::INK, 1.5));
    drawing.clip(Some(Rect { left: 0.0, top: 0.0, width: 10.0, height: 10.0 }));
    let document = drawing.svg();
    assert!(document.contains("d=\"M1 2.5l2.3 1.5\""), "{document}");
    assert_eq!(document.matches("<path").count(), 1);
    assert_eq!(document.matches("<g").count(), 2);
    assert_eq!(document.matches("<g").count(), document.matches("</g>").count());
}

#[test]
fn rounded_steps_do_not_add_up() {
    let mut drawing = Drawing::new([100.0, 50.0]);
    let line: Vec<[f64; 2]> = (0..=300).map(|k| [f64::from(k) * 0.04, 20.0 - f64::from(k) * 0.016]).collect();
    drawing.strokes(&[line, vec![[7.0, 3.0], [7.0, 3.0]]], &Pen::new(Rgb::INK, 1.5));
    let document = drawing.svg();
    let path = document.split("d=\"M").nth(1).and_then(|rest| rest.split('"').next()).expect("a path");
    let (line, dot) = path.split_once('M').expect("two lines");
    assert_eq!(dot, "7 3l0 0");
    let numbers = line.replace('l', " ").replace('-', " -");
    let numbers: Vec<f64> = numbers.split_whitespace().map(|number| number.parse().expect(number)).collect();
    let end = |k: usize| numbers.iter().skip(k).step_by(2).sum::<f64>();
    assert!(numbers.len() == 602 && (end(0) - 12.0).abs() < 0.051 && (end(1) - 15.2).abs() < 0.051, "{line}");
}

#[test]
fn text_is_drawn_and_said() {
    let mut drawing = Drawing::new([100.0, 50.0]);
    drawing.text([10.0, 10.0], "a < b_{0}", &TextStyle::new(10.0, Anchor::Middle));
    drawing.text([10.0, 10.0], "", &TextStyle::new(10.0, Anchor::Middle));
    let document = drawing.svg();
    assert!(document.contains("aria-label=\"a &lt; b_{0}\" d=\"M"), "{document}");
    assert_eq!(document.matches("<path").count(), 1);
}

#[test]
fn images_are_embedded() {
    let mut drawing = Drawing::new([100.0, 50.0]);
    drawing.shade(Rect { left: 2.0, top: 3.0, width: 8.0, height: 4.0 }, |_, _| Some(Rgb::INK));
    let document = drawing.svg();
    let start = "<image x=\"2\" y=\"3\" width=\"8\" height=\"4\" style=\"image-rendering:pixelated\" \
                 href=\"data:image/png;base64,iVBORw0KGgo";
    assert!(document.contains(start), "{document}");
}

#[test]
fn the_examples_of_rfc_4648() {
    let cases =
        [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foob", "Zm9vYg=="), ("foobar", "Zm9vYmFy")];
    for (plain, coded) in cases {
        assert_eq!(base64(plain.as_bytes()), coded);
    }
}

/// The size on paper, in centimetres, where there is one.
#[test]
fn drawings_have_their_size_on_paper() {
    let mut drawing = Drawing::new([100.0, 60.0]);
    assert!(drawing.svg().contains("width=\"100\" height=\"60\" viewBox=\"0 0 100 60\""), "{}", drawing.svg());
    drawing.per_cm = Some(40.0);
    assert!(drawing.svg().contains("width=\"2.5cm\" height=\"1.5cm\" viewBox=\"0 0 100 60\""), "{}", drawing.svg());
}
