use super::*;
use crate::Raster;
use motile::prelude::*;

#[test]
fn all_droplets_and_solids_are_drawn() {
    let setup = Setup {
        region: Region::Box { lengths: [8.0, 4.0] },
        method: Method::Grid(GridMethod::of_spacing(0.25)),
        droplets: [-2.0, 2.0].map(|x| DropletSetup { centre: [x, 0.0], ..DropletSetup::default() }).to_vec(),
        ..Setup::default()
    };
    let mut scene = setup.build().unwrap().scene;
    let raster = Raster::of(scene.system(), 0.25).unwrap();
    let seen = Snapshot::take(scene.system_mut(), raster).unwrap();
    assert_eq!([0, 1].map(|k| seen.droplets[k].centroid.x.round()), [-2.0, 2.0]);
    let look = Look::default();
    let picture = look.picture(&seen, &look.scales(std::slice::from_ref(&seen)), &[]).unwrap();
    assert_eq!(picture.interfaces.len(), 2);
}

#[test]
fn paths_end_with_the_state_and_are_shorter_than_the_period() {
    let path: Vec<Vec2> = (0..100).map(|k| Vec2::new(0.1 * f64::from(k), 0.0)).collect();
    let end = last_period(&path, 4.0);
    assert!((end[0].x - 6.9).abs() < 1e-9 && end.last() == path.last());
    assert!(last_period(&[], 1.0).is_empty());
}
