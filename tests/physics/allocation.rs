//! A step in steady state allocates nothing, in every kind of scene.

use allocation_counter::measure;
use motile::elastic_solids::Moduli;
use motile::ib_core::{Integrator, RungeKuttaChebyshev, Scene};
use motile::stokes_grid::Drive;
use motile::{AnyFlow, ContrastMethod, ElasticChannel, Method, Swimmer};

const DT: f64 = 0.002;

fn allocations<I: Integrator>(scene: Scene<AnyFlow, I>) -> u64 {
    allocations_after(5, scene)
}

/// Those of as many steps as were taken before.
fn allocations_after<I: Integrator>(steps: usize, mut scene: Scene<AnyFlow, I>) -> u64 {
    // The first steps make plans.
    (0..steps).for_each(|_| scene.step(DT).expect("a good scene"));
    measure(|| (0..steps).for_each(|_| scene.step(DT).expect("a good scene"))).count_total
}

#[test]
fn steps_allocate_nothing() {
    assert_eq!(measure(|| drop(std::hint::black_box(vec![1.0; 10]))).count_total, 1);
    let grid = Swimmer { method: Method::ImmersedBoundary, spacing: 0.2, ..Swimmer::default() };
    let integrals = Swimmer { nodes: 32, concentration_cells: 128, ..Swimmer::default() };
    let thesis = Swimmer { spacing: 0.2, ..Swimmer::thesis() };
    for (name, base) in [("grid", grid.clone()), ("integrals", integrals.clone()), ("thesis", thesis)] {
        let contrasts = [
            (None, ContrastMethod::Sharp),
            (Some(1000.0), ContrastMethod::Sharp),
            (Some(1000.0), ContrastMethod::Arithmetic),
        ];
        for (viscosity_inside, contrast) in contrasts {
            let swimmer = Swimmer { viscosity_inside, contrast, ..base.clone() };
            let name = format!("{name}, {viscosity_inside:?}, {contrast:?}");
            assert_eq!(allocations(swimmer.build().unwrap().0), 0, "{name}");
            for width in [2.0, 3.0] {
                let swimmer = Swimmer { lengths: [6.0, width], ..swimmer.clone() };
                let scene = swimmer.build_in_channel(Drive::ZeroGradient).unwrap().0;
                assert_eq!(allocations(scene), 0, "{name}, channel of width {width}");
            }
        }
    }
}

#[test]
fn steps_between_elastic_walls_allocate_nothing() {
    let swimmer = Swimmer { lengths: [6.0, 2.4], spacing: 0.1, ..Swimmer::default() };
    for viscosity_inside in [None, Some(1000.0)] {
        let swimmer = Swimmer { viscosity_inside, ..swimmer.clone() };
        let channel = ElasticChannel::new(swimmer, Moduli::from_thesis_spring_constant(1e4).unwrap());
        assert_eq!(allocations(channel.build().unwrap().0), 0, "{viscosity_inside:?}");
    }
}

/// With the measurement of the spectral radius that comes every 25 steps.
#[test]
fn steps_of_the_chebyshev_method_allocate_nothing() {
    let grid = Swimmer { method: Method::ImmersedBoundary, spacing: 0.2, ..Swimmer::default() };
    let integrals = Swimmer { nodes: 32, concentration_cells: 128, ..Swimmer::default() };
    let walls = Swimmer { lengths: [6.0, 2.4], spacing: 0.1, ..Swimmer::default() };
    let channel = ElasticChannel::new(walls, Moduli::from_thesis_spring_constant(1e4).unwrap());
    let scenes = [grid.build().unwrap().0, integrals.build().unwrap().0, channel.build().unwrap().0];
    for (name, scene) in ["grid", "integrals", "elastic walls"].into_iter().zip(scenes) {
        assert_eq!(allocations_after(30, scene.advanced_by(RungeKuttaChebyshev::new())), 0, "{name}");
    }
}
