//! Pictures as drawing programs write them.

use std::f64::consts::PI;

use super::*;
use crate::closed;

fn area(text: &str) -> f64 {
    let found = read(text).unwrap();
    assert_eq!(found.len(), 1);
    closed(&found[0].points).unwrap().area
}

fn svg(inner: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?><svg xmlns=\"http://www.w3.org/2000/svg\" \
         xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" viewBox=\"0 0 100 100\">{inner}</svg>"
    )
}

/// Curves are flattened to 2e-5 of their extent, in any unit: areas of circles to 1e-4.
#[test]
fn curves_are_flattened_finely() {
    for scale in [1e-6, 1.0, 1e4] {
        let circle = PI * 25.0 * scale * scale;
        let [r, d] = [5.0 * scale, 10.0 * scale];
        // Cubic curves with the usual constant: the area of such a circle is 1.0002 of the circle's.
        let k = 0.552_284_749_8 * r;
        for inner in [
            format!("<circle cx=\"3\" cy=\"4\" r=\"{r}\"/>"),
            format!("<ellipse rx=\"{d}\" ry=\"{}\"/>", 0.5 * r),
            format!("<path d=\"M0 0a{r} {r} 0 0 1 {d} 0a{r},{r} 0 0 1 -{d} 0z\"/>"),
            format!(
                "<path d=\"M{r},0 C{r},{k} {k},{r} 0,{r} S-{r},{k} -{r},0 \
                 c0,-{k} {0},-{r} {r},-{r} s{r},{0} {r},{r} Z\"/>",
                r - k
            ),
            format!(
                "<g transform=\"scale(2)\"><g transform=\"translate(7,1) rotate(30)\"><circle r=\"{}\"/></g></g>",
                0.5 * r
            ),
        ] {
            assert!((area(&svg(&inner)) / circle - 1.0).abs() < 4e-4, "{inner}: {}", area(&svg(&inner)) / circle);
        }
        // A parabola over a chord has two thirds of its box; the smooth one that follows is its mirror image.
        let both = area(&svg(&format!("<path d=\"M0 0Q{r} {r} {d} 0T{} 0V-{d}H0z\"/>", 2.0 * d)));
        assert!((both / (2.0 * d * d) - 1.0).abs() < 1e-4, "{both}");
    }
}

#[test]
fn parts_and_names() {
    let found = read(&svg("<defs><path id=\"clip\" d=\"M0 0h1v1z\"/></defs><g>\
         <path id=\"cell\" d=\"M0 0h4v4h-4zm10,0h1v1z l 0 3 2 0 z\"/>\
         <polygon inkscape:label=\"nucleus\" points=\"1,1 2,1 2,2\"/><polyline points=\"1 1 2 1 2 2\"/>\
         <rect id=\"box\" x=\"1\" y=\"2\" width=\"3\" height=\"4\"/></g>"))
    .unwrap();
    let seen: Vec<_> = found.iter().map(|one| (one.name.as_deref(), one.points.len(), one.closed)).collect();
    let expected = [
        (Some("cell"), 4, true),
        (Some("cell (2)"), 3, true),
        (Some("cell (3)"), 3, true),
        (Some("nucleus"), 3, true),
        (None, 3, false),
        (Some("box"), 4, true),
    ];
    assert_eq!(seen, expected);
    // The third part goes on from the start of the second.
    assert_eq!(found[2].points, [[10.0, 0.0], [10.0, 3.0], [12.0, 3.0]].map(Vec2::from));
}

#[test]
fn what_is_not_followed_is_refused_with_its_line() {
    for (inner, said) in [
        ("\n<use href=\"#a\"/>", "line 2 cannot be read: a \"use\" element"),
        ("<svg/>", "a \"svg\" element"),
        ("<g style=\"transform: scale(2)\"/>", "a transform in a style"),
        ("<g transform=\"scale(\"/>", "Correct the attribute transform"),
        ("<text>cell</text>", "it has no path"),
        ("<path d=\"M0 0 L1\"/>", "its path data cannot be read"),
        ("<path d=\"M1 1 L1 1\"/>", "its points coincide"),
        ("<circle r=\"5mm\"/>", "is not a number of pixels"),
    ] {
        let error = read(&svg(inner)).unwrap_err().to_string();
        assert!(error.contains(said), "{inner}: {error}");
    }
    let html = read("<html><body/></html>").unwrap_err().to_string();
    assert!(html.contains("its first element is \"html\""), "{html}");
    assert!(read("<svg").unwrap_err().to_string().contains("line 1 cannot be read"));
}
