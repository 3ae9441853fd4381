use super::*;
use motile::prelude::*;

#[test]
fn a_snapshot_of_a_box_and_of_a_channel() {
    let setup = Setup {
        region: Region::Box { lengths: [6.0, 4.0] },
        method: Method::Grid(GridMethod::of_spacing(0.25)),
        droplets: vec![DropletSetup { centre: [1.0, 0.5], ..DropletSetup::default() }],
        ..Setup::default()
    };
    let mut scene = setup.build().unwrap().scene;
    let raster = Raster::of(scene.system(), 0.25).unwrap();
    assert_eq!((raster.cells(), raster.periodic), ([24, 16], [true, true]));
    assert_eq!(raster.coarsened(12).cells(), [12, 8]);
    let seen = Snapshot::take(scene.system_mut(), raster).unwrap();
    assert!((seen.droplets[0].centroid - Vec2::new(1.0, 0.5)).norm() < 1e-9);
    // The pressure inside is above that outside, the droplet moves to the right.
    let at = |x: f64, y: f64| {
        let near = |p: &&(Vec2, FlowSample)| (p.0 - Vec2::new(x, y)).norm() < 0.2;
        let all: Vec<_> = raster.points().into_iter().zip(seen.flow.iter().copied()).collect();
        all.iter().find(near).unwrap().1
    };
    assert!(at(1.0, 0.5).pressure > at(-2.0, -1.0).pressure);
    assert!(at(1.0, 0.5).velocity.x > 0.0);

    let region = Region::Channel { length: 6.0, width: 4.0, drive: Drive::ZeroGradient };
    let scene = Setup { region, ..setup }.build().unwrap().scene;
    let raster = Raster::of(scene.system(), 0.25).unwrap();
    assert_eq!((raster.origin, raster.size), ([-3.0, -2.0], [6.0, 4.0]));
    assert_eq!(raster.periodic, [true, false]);
}

#[test]
fn markers_lie_between_their_segments() {
    assert_eq!(at_markers(&[1.0, 3.0, 5.0]), [3.0, 2.0, 4.0]);
    assert!(at_markers(&[]).is_empty());
}
