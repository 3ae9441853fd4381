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

/// A shear displaces the images of a box during a run: in every later state, a raster that was made before it is the
/// one that is made then, with pixels of the same pictures.
#[test]
fn a_raster_from_before_a_run_is_that_of_the_state() {
    use crate::{Look, Snapshot};
    use motile::prelude::*;
    use motile::setup::DropletSetup;
    let method = Method::Integral(IntegralMethod { nodes: 24, elements: 48 });
    // In the upper corner, so that its images above are in the picture.
    let droplets = vec![DropletSetup { centre: [1.8, 1.8], ..DropletSetup::active(-2.0) }];
    let flow = FlowSetup { shear: 0.3, ..FlowSetup::default() };
    let mut scene = Setup { method, droplets, flow, ..Setup::default() }.build().unwrap().scene;
    let before = Raster::of(scene.system(), 0.5).unwrap();
    assert_eq!(before.tilt, Some(0.0));
    for time in [2.0, 4.0] {
        scene.run(time).go().unwrap();
        let after = Raster::of(scene.system(), 0.5).unwrap();
        // A strain of 0.3 in a time of 1, and a height of 6.
        let displaced = 6.0 * 0.3 * scene.system().time();
        let periods = (after.tilt.unwrap() - displaced) / 6.0;
        assert!((periods - periods.round()).abs() < 1e-9, "{after:?} {displaced}");
        assert_ne!(before.tilt, after.tilt);
        let [old, new] = [before, after].map(|raster| Snapshot::take(scene.system_mut(), raster).unwrap());
        assert_eq!(old.raster, new.raster);
        let look = Look::default();
        assert_eq!(look.svg(&old, &[]).unwrap(), look.svg(&new, &[]).unwrap());
    }
}
