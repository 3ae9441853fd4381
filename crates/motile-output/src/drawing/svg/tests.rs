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
    assert!(document.contains("d=\"M1 2.5L3.26 4\""), "{document}");
    assert_eq!(document.matches("<path").count(), 1);
    assert_eq!(document.matches("<g").count(), 2);
    assert_eq!(document.matches("<g").count(), document.matches("</g>").count());
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
