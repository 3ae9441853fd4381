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

/// Each label has its tick on the border and its line across.
#[test]
fn ticks_and_grid_lines_are_drawn() {
    let area = Rect { left: 40.0, top: 20.0, width: 200.0, height: 100.0 };
    let axis = |label: &str| Axis::new(label, [0.0, 1.0], AxisScale::Linear, 5);
    let frame = Frame { area, x: axis("x"), y: axis("y"), em: 12.0 };
    let strokes = |draw: &dyn Fn(&mut Drawing)| {
        let mut drawing = Drawing::new([300.0, 200.0]);
        draw(&mut drawing);
        drawing.svg().matches("stroke-width").count()
    };
    let of =
        |axis: &Axis| (axis.ticks.ticks.len(), axis.ticks.ticks.iter().filter(|tick| tick.label.is_some()).count());
    let [(all_x, labelled_x), (all_y, labelled_y)] = [of(&frame.x), of(&frame.y)];
    assert!(labelled_x >= 3 && all_x == all_y);
    assert_eq!(strokes(&|drawing| frame.draw_grid(drawing)), labelled_x + labelled_y);
    // The border is one more.
    assert_eq!(strokes(&|drawing| frame.draw_axes(drawing)), all_x + all_y + 1);
}
