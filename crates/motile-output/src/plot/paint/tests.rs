use super::*;
use crate::plot::Figure;

#[test]
fn ranges_hold_the_data_and_survive_data_that_cannot_be_shown() {
    let plot = Plot::new("").series(Series::line("", [(0.0, 2.0), (1.0, f64::NAN), (4.0, 3.0)])).horizontal(5.0, "");
    let [low, high] = data_range(&plot, 1);
    assert!(low < 2.0 && high > 5.0 && high < 5.5, "{low} {high}");
    let log = Plot::new("").y_axis("", AxisScale::Logarithmic).series(Series::line("", [(0.0, 0.0), (1.0, -2.0)]));
    let [low, high] = data_range(&log, 1);
    assert!(low > 0.0 && high > low && high.is_finite(), "{low} {high}");
    let flat = Plot::new("").series(Series::line("", [(0.0, 0.138_600_001), (1.0, 0.138_6)]));
    let [low, high] = data_range(&flat, 1);
    assert!(high - low > 1e-4);
}

#[test]
fn figures_without_panels_and_tiny_panels_are_refused() {
    assert!(Figure::new(2).svg().is_err());
    assert!(Figure::new(1).panel(Plot::new("")).panel_size(10.0, 10.0).svg().is_err());
    assert!(Figure::new(1).panel(Plot::new("empty")).svg().is_ok());
}

#[test]
fn equal_units_are_equally_long_and_show_all_data() {
    for (wide, high) in [(8.0, 1.0), (1.0, 8.0)] {
        let plot = Plot::new("").series(Series::line("", [(0.0, 0.0), (wide, high)])).equal_units();
        let frame = frame(&plot, Rect { left: 0.0, top: 0.0, width: 540.0, height: 340.0 }, EM);
        let [from, to] = [frame.place(0.0, 0.0), frame.place(wide, high)];
        let lengths = [(to[0] - from[0]) / wide, (from[1] - to[1]) / high];
        assert!((lengths[0] / lengths[1] - 1.0).abs() < 1e-9, "{lengths:?}");
        for [x, y] in [from, to] {
            assert!(frame.area.left < x && x < frame.area.right() && frame.area.top < y && y < frame.area.bottom());
        }
    }
}

/// Two points are a line, one is none.
#[test]
fn two_points_make_a_line() {
    for (end, more) in [(2.0, 1), (f64::NAN, 0)] {
        let strokes = |line: bool| {
            let series = Series { line, ..Series::line("", [(0.0, 0.0), (1.0, end), (2.0, f64::NAN)]) };
            let svg = Figure::new(1).panel(Plot::new("").series(series)).svg().unwrap();
            svg.matches("<path").count()
        };
        assert_eq!(strokes(true), strokes(false) + more, "{end}");
    }
}
