use super::*;
use crate::drawing::{Pen, Pixel, Rect};

/// Ink on a drawing of 60 x 60 pixels: sum of darkness over pixels, 1 for a black one.
fn ink(draw: impl FnOnce(&mut Drawing)) -> f64 {
    let mut drawing = Drawing::new([60.0, 60.0]);
    draw(&mut drawing);
    colours(&drawing.pixels(1.0).unwrap()).map(|p| 1.0 - f64::from(p.0[0]) / 255.0).sum()
}

const BLACK: Rgb = Rgb([0, 0, 0]);

#[test]
fn areas_of_polygons_come_out_as_ink() {
    let square = vec![[10.3, 10.0], [40.8, 10.0], [40.8, 30.0], [10.3, 30.0]];
    let hole = vec![[20.0, 15.0], [30.0, 15.0], [30.0, 25.0], [20.0, 25.0]];
    let seen = ink(|drawing| drawing.fill(&[square, hole], BLACK, 1.0));
    assert!((seen - (30.5 * 20.0 - 100.0)).abs() < 1.0, "{seen}");
    // A shape beyond the border is cut, and beyond any size does no harm.
    for size in [1e3, 1e9, 1e30, 1e300] {
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let seen = ink(|drawing| drawing.fill(&[corners.map(|p| p.map(|v| v * size)).to_vec()], BLACK, 1.0));
        assert!((seen - 3600.0).abs() < 1e-6, "{size} {seen}");
    }
}

#[test]
fn a_line_of_many_pieces_is_as_dark_as_one() {
    let pen = Pen::new(BLACK, 3.0).opacity(0.5);
    let one = ink(|drawing| drawing.stroke(&[[10.0, 10.0], [50.0, 40.0]], &pen));
    let path: Vec<Pixel> =
        (0..=600).map(|k| f64::from(k) / 600.0).map(|t| [10.0 + 40.0 * t, 10.0 + 30.0 * t]).collect();
    let many = ink(|drawing| drawing.stroke(&path, &pen));
    let expected = 0.5 * (50.0 * 3.0 + std::f64::consts::PI * 1.5 * 1.5);
    assert!((one - expected).abs() < 0.02 * expected, "{one} {expected}");
    assert!((one - many).abs() < 1.0, "{one} {many}");
}

#[test]
fn clipping_keeps_ink_inside_and_nan_draws_nothing() {
    let seen = ink(|drawing| {
        drawing.clip(Some(Rect { left: 10.0, top: 10.0, width: 5.0, height: 5.0 }));
        drawing.stroke(&[[0.0, 12.0], [40.0, 12.0]], &Pen::new(BLACK, 20.0));
        drawing.clip(None);
        drawing.stroke(&[[0.0, 12.0], [f64::NAN, 12.0]], &Pen::new(BLACK, 20.0));
        drawing.fill(&[vec![[0.0, 0.0], [f64::NAN, 5.0], [3.0, 3.0]]], BLACK, 1.0);
    });
    assert!((seen - 25.0).abs() < 1e-6, "{seen}");
}

/// Neighbours that share an edge leave no gap between them.
#[test]
fn triangles_tile_their_area() {
    let area = Rect { left: 10.0, top: 10.0, width: 40.0, height: 30.0 };
    let corner = |i: usize, j: usize| [10.0 + 40.0 * i as f64 / 7.0, 10.0 + 30.0 * j as f64 / 7.0];
    let square = |k: usize| {
        let (i, j) = (k % 7, k / 7);
        let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        [([a, b, c], BLACK), ([a, c, d], BLACK)]
    };
    assert_eq!(ink(|drawing| drawing.triangles(area, (0..49).flat_map(square))), 1200.0);
}

#[test]
fn images_keep_their_pixels_at_any_scale() {
    let mut drawing = Drawing::new([60.0, 60.0]);
    let area = Rect { left: 20.0, top: 10.0, width: 30.0, height: 20.0 };
    drawing.shade(area, |x, _| (x < 40.0).then_some(BLACK));
    for scale in [1.0, 2.0, 3.0] {
        let black = colours(&drawing.pixels(scale).unwrap()).filter(|&colour| colour == BLACK).count();
        assert_eq!(black as f64, 400.0 * scale * scale);
    }
}

#[test]
fn images_without_pixels_are_refused() {
    assert!(Drawing::new([0.0, 10.0]).pixels(1.0).is_err());
    assert!(Drawing::new([10.0, 10_000.0]).pixels(2.0).is_err());
}
