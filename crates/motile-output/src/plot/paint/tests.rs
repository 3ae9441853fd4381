use super::*;

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
