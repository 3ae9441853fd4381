//! The bits of a run do not depend on the number of threads (feature `rayon`).

use motile::base::Region;
use motile::elastic_solids::ChannelShape;
use motile::elastic_solids::Moduli;
use motile::scene::{Scene, gap::Repulsion, integrator::Dynamics as _};
use motile::setup::{
    ActiveSpringsSetup, AnyFlow, Distribution, DropletSetup, GridMethod, IntegralMethod, Material, MaxwellSetup,
    Method, Setup, SolidSetup, SuspensionSetup,
};
use motile_tests::validation::scene::{on_grid, open_channel};

/// State and velocities, bitwise, after three steps on that many threads.
fn bits(threads: usize, setup: &Setup) -> Vec<u64> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
    pool.install(|| {
        let mut scene: Scene<AnyFlow> = setup.build().expect("a scene").scene;
        for _ in 0..3 {
            scene.step(2e-3).expect("a step");
        }
        let mut state = Vec::new();
        scene.system().write_state(&mut state);
        let markers = scene.system_mut().evaluate().expect("a flow");
        state.extend(markers.velocities().iter().flat_map(|v| [v.x, v.y]));
        state.into_iter().map(f64::to_bits).collect()
    })
}

#[test]
fn a_large_box() {
    let (region, droplets) = (Region::Box { lengths: [4.5; 2] }, vec![DropletSetup::active(-3.0)]);
    let setup = Setup { region, droplets, ..on_grid(0.005) };
    let expected = bits(1, &setup);
    assert_eq!(bits(2, &setup), expected);
    assert_eq!(bits(3, &setup), expected);
}

#[test]
fn many_droplets_in_contact() {
    let suspension = SuspensionSetup {
        count: Some(160),
        activity: Some(Distribution::Between([-3.0, -2.0])),
        gap: 0.01,
        ..SuspensionSetup::default()
    };
    let side = (160.0 * suspension.mean_area() / 0.5).sqrt();
    let setup = Setup {
        region: Region::Box { lengths: [side; 2] },
        method: Method::Integral(IntegralMethod { nodes: 32, elements: 256 }),
        tolerance: Some(1e-5),
        repulsion: Some(Repulsion::new(1000.0, 0.2).expect("a repulsion")),
        droplets: Vec::new(),
        suspension: vec![suspension],
        ..Setup::default()
    };
    let expected = bits(1, &setup);
    assert!(expected.len() > 160_000, "enough markers for several threads");
    assert_eq!(bits(2, &setup), expected);
    assert_eq!(bits(3, &setup), expected);
}

#[test]
fn elastic_walls_of_many_points() {
    walls_of_many_points(|_| {});
}

#[test]
fn living_walls_of_many_points() {
    walls_of_many_points(|wall| {
        wall.relaxation = vec![MaxwellSetup { modulus: 500.0, time: 0.01 }];
        let (on_sensitivity, off_sensitivity) = (0.0, 1.0);
        wall.active_springs =
            Some(ActiveSpringsSetup { tension: 1.0, on: 50.0, off: 50.0, seed: 3, on_sensitivity, off_sensitivity });
    });
}

fn walls_of_many_points(change: impl Fn(&mut SolidSetup)) {
    let shear = Moduli::from_thesis_spring_constant(1e5).expect("moduli").shear();
    let mut solids = SolidSetup::walls(&ChannelShape::Straight { width: 2.0 }, &Material::Springs { shear });
    solids.iter_mut().for_each(change);
    let setup = Setup {
        region: open_channel(12.0, 5.0),
        droplets: vec![DropletSetup::active(-4.0)],
        solids,
        method: Method::Grid(GridMethod::uncorrected(1.0 / 60.0)),
        ..Setup::default()
    };
    let expected = bits(1, &setup);
    assert!(expected.len() > 120_000, "enough points for several threads");
    assert_eq!(bits(2, &setup), expected);
    assert_eq!(bits(3, &setup), expected);
}
