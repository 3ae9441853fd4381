//! Gaps between droplets and elastic walls.

use motile::base::Region;
use motile::base::{Drive, Vec2};
use motile::elastic_solids::ChannelShape;
use motile::elastic_solids::mesh::equilateral_strip;
use motile::elastic_solids::{NeoHookean, Solid, Springs};
use motile::scene::{
    Observer,
    gap::{SolidEntered, SolidGap},
};
use motile::setup::{Built, DropletSetup, GridMethod, Material, Method, Setup, SolidSetup};

#[test]
fn a_droplet_inside_a_wall_is_an_error() {
    let setup = Setup {
        region: Region::Channel { length: 4.0, width: 5.2, drive: Drive::ZeroGradient },
        method: Method::Grid(GridMethod::uncorrected(0.2)),
        solids: SolidSetup::walls(&ChannelShape::Straight { width: 2.2 }, &Material::Springs { shear: 1.0 }),
        ..Setup::default()
    };
    let Built { mut scene, solids: walls, .. } = setup.build().unwrap();
    let mut gap = SolidGap::new(0.05);
    gap.observe(scene.system_mut()).unwrap();
    assert!((gap.present().unwrap() - 0.1).abs() < 2e-3, "{gap:?}");
    let lower = scene.body_mut(walls[0]).unwrap();
    let raised: Vec<_> = lower.positions().iter().map(|p| p + Vec2::new(0.0, 0.3)).collect();
    Solid::set_positions(lower, &raised).unwrap();
    let error = gap.observe(scene.system_mut()).unwrap_err();
    let entered: &SolidEntered = error.downcast_ref().unwrap();
    assert!((entered.depth - 0.2).abs() < 2e-3, "{entered}");
    assert!(entered.to_string().ends_with("move them apart"), "{entered}");
    assert_eq!(gap.smallest(), Some((-entered.depth, 0.0)));
}

/// Walls of springs, of a hyperelastic material and with forces of one's own are all seen.
#[test]
fn solids_of_every_material_are_seen() {
    let setup = Setup {
        region: Region::Box { lengths: [4.0, 4.0] },
        method: Method::Grid(GridMethod::uncorrected(0.2)),
        ..Setup::default()
    };
    let mesh = || equilateral_strip(Vec2::new(-2.0, -2.0), 20, 4, 0.2).unwrap();
    let top = -2.0 + 4.0 * 0.2 * 0.75_f64.sqrt();
    let solids = [
        Solid::springs(mesh(), 1.0).unwrap(),
        Solid::hyperelastic(mesh(), NeoHookean::new(1.0, 2.0).unwrap()),
        Solid::with_forces(mesh(), Springs::new(&mesh(), 1.0).unwrap()).unwrap(),
    ];
    for solid in solids {
        let mut scene = setup.build().unwrap().scene;
        scene.add(solid);
        let gap = SolidGap::new(0.0).measure(scene.system()).unwrap().gap;
        assert!((gap - (-1.0 - top)).abs() < 2e-3, "{gap}");
    }
}

/// The second of two droplets counts too.
#[test]
fn the_nearest_of_all_droplets_counts() {
    let droplet = |y: f64| DropletSetup { centre: [0.0, y], ..DropletSetup::default() };
    let setup = Setup {
        region: Region::Channel { length: 4.0, width: 8.0, drive: Drive::ZeroGradient },
        method: Method::Grid(GridMethod::uncorrected(0.2)),
        droplets: vec![droplet(1.4), droplet(-1.2)],
        solids: SolidSetup::walls(&ChannelShape::Straight { width: 5.0 }, &Material::Springs { shear: 1.0 }),
        ..Setup::default()
    };
    let Built { scene, droplets, .. } = setup.build().unwrap();
    let place = SolidGap::new(0.0).measure(scene.system()).unwrap();
    assert!(place.interface == droplets[0].into() && (place.gap - 0.1).abs() < 2e-3, "{place:?}");
    let lower = Setup { droplets: vec![droplet(1.2), droplet(-1.4)], ..setup };
    let Built { scene, droplets, .. } = lower.build().unwrap();
    let place = SolidGap::new(0.0).measure(scene.system()).unwrap();
    assert!(place.interface == droplets[1].into() && (place.gap - 0.1).abs() < 2e-3, "{place:?}");
}
