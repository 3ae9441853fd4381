use super::*;
use crate::drawing::{Anchor, TextStyle};

#[test]
fn elements_have_their_coordinates_and_groups_close() {
    let mut svg = Svg::new([100.0, 50.0]);
    svg.clip(Some(Rect { left: 1.0, top: 2.0, width: 30.0, height: 40.0 }));
    svg.stroke(&[[1.0, 2.5], [3.256, 4.0]], &Pen::new(Rgb::INK, 1.5));
    svg.stroke(&[[1.0, f64::NAN], [3.0, 4.0]], &Pen::new(Rgb::INK, 1.5));
    let document = svg.document();
    assert!(document.contains("d=\"M1 2.5L3.26 4\""), "{document}");
    assert_eq!(document.matches("<path").count(), 1);
    assert_eq!(document.matches("<g").count(), document.matches("</g>").count());
}

#[test]
fn text_is_drawn_and_said() {
    let mut svg = Svg::new([100.0, 50.0]);
    svg.text([10.0, 10.0], "a < b_{0}", &TextStyle::new(10.0, Anchor::Middle));
    svg.text([10.0, 10.0], "", &TextStyle::new(10.0, Anchor::Middle));
    let document = svg.document();
    assert!(document.contains("aria-label=\"a &lt; b_{0}\" d=\"M"), "{document}");
    assert_eq!(document.matches("<path").count(), 1);
}
