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
    assert!(entered.to_string().ends_with("Move them apart"), "{entered}");
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

/// The smallest gap is that to a wall where nothing else is near: straight walls of the region, and curved ones.
#[test]
fn walls_count_in_the_smallest_gap() {
    let method = Method::Integral(motile::setup::IntegralMethod { nodes: 32, elements: 64 });
    let droplets = vec![DropletSetup { centre: [0.0, 0.4], ..DropletSetup::active(-2.0) }];
    let region = |width: f64| Region::Channel { length: 8.0, width, drive: Drive::ZeroGradient };
    let walls = motile::setup::WallSetup::channel(&ChannelShape::Straight { width: 3.2 }, 0.2);
    let straight = Setup { region: region(3.2), method, droplets: droplets.clone(), ..Setup::default() };
    let curved = Setup { region: region(6.0), method, droplets, walls, ..Setup::default() };
    for setup in [straight, curved] {
        let Built { mut scene, .. } = setup.build().unwrap();
        assert!((scene.system_mut().wall_gap().unwrap() - 0.2).abs() < 0.003);
        scene.run(0.2).go().unwrap();
        let least = scene.system().minimum_gap().unwrap();
        assert_eq!(Some(least), scene.system().minimum_wall_gap());
        assert!((least - 0.2).abs() < 0.003, "{least}");
    }
}

/// A droplet next to a wall leaves a film of 0.05. The warning says how many nodes resolve it, and
/// with these it does not come.
#[test]
fn the_number_of_nodes_that_a_film_needs_is_told() {
    let of = |nodes: usize| {
        let setup = Setup {
            region: Region::Channel { length: 8.0, width: 3.2, drive: Drive::ZeroGradient },
            method: Method::Integral(motile::setup::IntegralMethod { nodes, elements: 4 * nodes }),
            droplets: vec![DropletSetup { centre: [0.0, 0.55], ..DropletSetup::active(-2.0) }],
            ..Setup::default()
        };
        let Built { mut scene, .. } = setup.build().unwrap();
        scene.system_mut().warnings().into_iter().find(|warning| warning.cause == "thin film")
    };
    let told = of(24).unwrap().message;
    println!("{told}");
    let number = told.split("use ").nth(1).unwrap().split(' ').next().unwrap();
    let needed: usize = number.parse().unwrap();
    assert!((36..42).contains(&needed) && of(needed + 1).is_none() && of(needed - 2).is_some(), "{told}");
}

/// In three dimensions a shape has fewer waves than nodes, and what is told is a number of nodes: more than there are,
/// and enough.
#[test]
fn the_number_of_nodes_is_told_in_three_dimensions_too() {
    let of = |region: Region, nodes: usize, cause: &str| {
        let setup = Setup {
            region,
            method: Method::Integral(motile::setup::IntegralMethod { nodes, elements: 8 * nodes }),
            droplets: vec![DropletSetup::active(-1.0)],
            ..Setup::default()
        };
        let Built { mut scene, .. } = setup.build().unwrap();
        let warnings = scene.system_mut().warnings().into_iter();
        let told = warnings.filter(|warning| warning.cause == cause).map(|warning| warning.message).next()?;
        let number = told.split("use ").nth(1)?.split(' ').next()?.parse::<usize>().ok()?;
        Some((told, number))
    };
    for (region, nodes, cause) in [
        (Region::tube(1.03), 40, "thin film"),
        (Region::tube(1.03), 48, "thin film"),
        (Region::tube(1.4), 28, "shape not resolved"),
        (Region::Space, 34, "shape not resolved"),
    ] {
        let (told, needed) = of(region, nodes, cause).expect("a warning");
        assert!(needed > nodes && of(region, needed + 1, cause).is_none(), "{nodes} nodes: {told}");
        assert!(of(region, needed - 3, cause).is_some(), "{nodes} nodes: {told}");
        assert!(cause == "thin film" || told.contains(&format!("{nodes} nodes")), "{told}");
    }
}

/// A droplet that a constriction squeezes leaves thin films there: the number of nodes is told before the run, not
/// where it fits through or the nodes are enough.
#[test]
fn the_number_of_nodes_that_a_narrow_place_needs_is_told_at_the_start() {
    let warned = |throat: f64, nodes: usize| {
        let shape = ChannelShape::Constriction {
            width: 3.0,
            throat,
            throat_length: 2.0,
            ramp: 1.0,
            exit_ramp: None,
            centre: 0.0,
        };
        let mut walls = motile::setup::WallSetup::channel(&shape, 0.1);
        walls.iter_mut().for_each(|wall| wall.rounding = 0.15);
        let setup = Setup {
            region: Region::Channel { length: 12.0, width: 6.0, drive: Drive::ZeroGradient },
            method: Method::Integral(motile::setup::IntegralMethod { nodes, elements: 4 * nodes }),
            droplets: vec![DropletSetup { centre: [-6.0, 0.0], ..DropletSetup::active(-3.5) }],
            walls,
            ..Setup::default()
        };
        let Built { mut scene, .. } = setup.build().unwrap();
        scene.system_mut().warnings().into_iter().find(|warning| warning.cause == "narrow place not resolved")
    };
    let told = warned(1.0, 72).unwrap().to_string();
    println!("{told}");
    assert!(told.contains("leave 1.0") && told.contains("use 118 nodes"), "{told}");
    assert!(warned(1.0, 118).is_none() && warned(2.1, 72).is_none() && warned(1.9, 72).is_some());
}
