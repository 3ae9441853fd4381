use super::*;

#[test]
fn interpolation_is_exact_for_linear_fields_and_periodic_where_it_should_be() {
    let raster = Raster::new([-1.0, 2.0], [4.0, 3.0], [8, 5], [true, false]).unwrap();
    let linear = Samples::new(raster, raster.points().iter().map(|p| 2.0 * p.x - p.y + 1.0).collect()).unwrap();
    let point = Vec2::new(0.3, 3.7);
    assert!(Samples::new(raster, vec![Vec2::ZERO; 39]).is_err());
    assert!((linear.at(point) - (0.6 - 3.7 + 1.0)).abs() < 1e-12);
    assert!((linear.at(point) - linear.at(point + Vec2::new(8.0, 0.0))).abs() < 1e-12);
    assert!(raster.covers(Vec2::new(100.0, 2.1)) && !raster.covers(Vec2::new(0.0, 1.9)));
}

#[test]
fn rasters_that_cannot_be_are_refused() {
    assert!(Raster::new([0.0; 2], [1.0, 0.0], [3, 3], [true; 2]).is_err());
    assert!(Raster::new([f64::NAN, 0.0], [1.0, 1.0], [3, 3], [true; 2]).is_err());
    assert!(Raster::new([0.0; 2], [1.0, 1.0], [0, 3], [true; 2]).is_err());
}
