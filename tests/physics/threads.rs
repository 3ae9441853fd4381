//! The bits of a run do not depend on the number of threads (feature `rayon`).

use motile::elastic_solids::Moduli;
use motile::ib_core::{Hydrodynamics, Scene};
use motile::{ElasticChannel, Method, Swimmer};

/// State and velocities, bit for bit, after three steps on that many threads.
fn bits<H: Hydrodynamics>(threads: usize, build: impl Fn() -> Scene<H> + Sync) -> Vec<u64> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
    pool.install(|| {
        let mut scene = build();
        for _ in 0..3 {
            scene.step(2e-3).expect("a step");
        }
        let mut state = Vec::new();
        scene.system().write_state(&mut state);
        let markers = scene.system_mut().evaluate().expect("a flow");
        state.extend(markers.velocities.iter().flat_map(|v| [v.x, v.y]));
        state.into_iter().map(f64::to_bits).collect()
    })
}

#[test]
fn a_large_box() {
    let swimmer = Swimmer {
        activity: -3.0,
        lengths: [4.5, 4.5],
        spacing: 0.005,
        method: Method::ImmersedBoundary,
        ..Swimmer::default()
    };
    let build = || swimmer.build_on_grid().expect("a scene").0;
    let expected = bits(1, build);
    assert_eq!(bits(2, build), expected);
    assert_eq!(bits(3, build), expected);
}

#[test]
fn elastic_walls_of_many_points() {
    let swimmer = Swimmer { activity: -4.0, lengths: [12.0, 2.0], spacing: 0.025, ..Swimmer::default() };
    let moduli = Moduli::from_thesis_spring_constant(1e5).expect("moduli");
    let channel = ElasticChannel::new(swimmer, moduli);
    let build = || channel.build().expect("a scene").0;
    let expected = bits(1, build);
    assert!(expected.len() > 120_000, "enough points for several threads");
    assert_eq!(bits(2, build), expected);
    assert_eq!(bits(3, build), expected);
}
