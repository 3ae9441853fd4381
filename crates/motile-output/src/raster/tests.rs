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
    let scene = motile::setup::Setup::default().build().unwrap().scene;
    for spacing in [0.0, -0.1, f64::NAN] {
        assert!(matches!(Raster::of(scene.system(), spacing), Err(OutputError::Size { .. })));
    }
    assert!(Raster::of(scene.system(), 0.1).is_ok());
}

#[test]
fn a_raster_around_bodies_holds_them_and_the_margin() {
    use motile::setup::{DropletSetup, Setup};
    let droplets = [[-3.0, 0.0], [2.0, 1.0]].map(|centre| DropletSetup { centre, ..DropletSetup::active(-2.0) });
    let region = motile::base::Region::Plane;
    let mut scene = Setup { region, droplets: droplets.to_vec(), ..Setup::default() }.build().unwrap().scene;
    scene.system_mut().evaluate().unwrap();
    let raster = Raster::around(scene.system(), 0.5, 0.1).unwrap();
    let close = |a: [f64; 2], b: [f64; 2]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-3);
    assert!(close(raster.origin, [-4.5, -1.5]) && close(raster.size, [8.0, 4.0]), "{raster:?}");
    assert_eq!(raster.cells(), [80, 40]);
    for (margin, spacing) in [(f64::NAN, 0.1), (0.5, -1.0), (-9.0, 0.1)] {
        assert!(Raster::around(scene.system(), margin, spacing).is_err());
    }
}
