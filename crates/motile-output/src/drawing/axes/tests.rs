use super::*;

#[test]
fn points_of_the_data_land_at_their_pixels() {
    let area = Rect { left: 10.0, top: 20.0, width: 200.0, height: 100.0 };
    let x = Axis::new("x", [0.01, 1.0], AxisScale::Logarithmic, 5);
    let y = Axis::new("y", [-1.0, 1.0], AxisScale::Linear, 5);
    let frame = Frame { area, x, y, em: 12.0 };
    let [px, py] = frame.place(0.1, 0.5);
    assert!((px - 110.0).abs() < 1e-9 && (py - 45.0).abs() < 1e-9, "{px} {py}");
    assert!(frame.place(-1.0, 0.0)[0].is_nan());
}
