use super::*;

/// Ink on the image: sum of darkness over pixels, 1 for a black one.
fn ink(canvas: &Canvas) -> f64 {
    canvas.pixels.iter().map(|p| 1.0 - f64::from(p.0[0]) / 255.0).sum()
}

const BLACK: Rgb = Rgb([0, 0, 0]);

#[test]
fn areas_of_polygons_come_out_as_ink() {
    let mut canvas = Canvas::new([60, 60]).unwrap();
    let square = vec![[10.3, 10.0], [40.8, 10.0], [40.8, 30.0], [10.3, 30.0]];
    let hole = vec![[20.0, 15.0], [30.0, 15.0], [30.0, 25.0], [20.0, 25.0]];
    canvas.fill(&[square, hole], BLACK, 1.0);
    assert!((ink(&canvas) - (30.5 * 20.0 - 100.0)).abs() < 1.0, "{}", ink(&canvas));
    // A shape beyond the border is cut, and beyond any size does no harm.
    canvas.fill(&[vec![[-1e9, -1e9], [1e9, -1e9], [1e9, 1e9], [-1e9, 1e9]]], BLACK, 1.0);
    assert!((ink(&canvas) - 3600.0).abs() < 1e-6);
}

#[test]
fn a_line_of_many_pieces_is_as_dark_as_one() {
    let mut one = Canvas::new([200, 50]).unwrap();
    let mut many = one.clone();
    let pen = Pen::new(BLACK, 3.0).opacity(0.5);
    one.stroke(&[[10.0, 10.0], [190.0, 40.0]], &pen);
    let path: Vec<Pixel> =
        (0..=600).map(|k| f64::from(k) / 600.0).map(|t| [10.0 + 180.0 * t, 10.0 + 30.0 * t]).collect();
    many.stroke(&path, &pen);
    let expected = 0.5 * (180f64.hypot(30.0) * 3.0 + 7.0);
    assert!((ink(&one) - expected).abs() < 0.02 * expected, "{} {expected}", ink(&one));
    assert!((ink(&one) - ink(&many)).abs() < 1.0, "{} {}", ink(&one), ink(&many));
}

#[test]
fn clipping_keeps_ink_inside_and_nan_draws_nothing() {
    let mut canvas = Canvas::new([40, 40]).unwrap();
    canvas.clip(Some(Rect { left: 10.0, top: 10.0, width: 5.0, height: 5.0 }));
    canvas.stroke(&[[0.0, 12.0], [40.0, 12.0]], &Pen::new(BLACK, 20.0));
    assert!((ink(&canvas) - 25.0).abs() < 1e-6, "{}", ink(&canvas));
    canvas.clip(None);
    canvas.stroke(&[[0.0, 12.0], [f64::NAN, 12.0]], &Pen::new(BLACK, 20.0));
    canvas.fill(&[vec![[0.0, 0.0], [f64::INFINITY, 5.0], [3.0, 3.0]]], BLACK, 1.0);
    assert!((ink(&canvas) - 25.0).abs() < 1e-6);
}

#[test]
fn images_without_pixels_are_refused() {
    assert!(Canvas::new([0, 10]).is_err());
    assert!(Canvas::new([10, 1_000_000]).is_err());
}
