//! A step in steady state allocates nothing, in every kind of scene.

use allocation_counter::measure;
use motile::active_interface::Cortex;
use motile::elastic_solids::ChannelShape;
use motile::elastic_solids::Moduli;
use motile::scene::{Scene, integrator::RungeKuttaChebyshev};
use motile::setup::{AnyFlow, GelSetup, GridMethod, Material, Method, Setup, SolidSetup};
use motile_tests::validation::scene::{by_layers, on_grid, open_channel, without_grid};

const DT: f64 = 0.002;

fn allocations(scene: Scene<AnyFlow>) -> u64 {
    allocations_after(5, scene)
}

/// Those of as many steps as were taken before.
fn allocations_after(steps: usize, mut scene: Scene<AnyFlow>) -> u64 {
    // The first steps make plans.
    (0..steps).for_each(|_| scene.step(DT).expect("a good scene"));
    measure(|| (0..steps).for_each(|_| scene.step(DT).expect("a good scene"))).count_total
}

/// Between soft elastic walls.
fn elastic() -> Setup {
    let shear = Moduli::from_thesis_spring_constant(1e4).expect("moduli").shear();
    let solids = SolidSetup::walls(&ChannelShape::Straight { width: 2.4 }, &Material::Springs { shear });
    Setup { region: open_channel(6.0, 5.4), solids, ..by_layers(0.1) }
}

/// Scene with gels inside the droplets.
fn filled(mut setup: Setup) -> Setup {
    setup.droplets.iter_mut().for_each(|droplet| droplet.gel = Some(GelSetup::default()));
    setup
}

/// Scene with droplets of another viscosity.
fn viscous(mut setup: Setup) -> Setup {
    setup.droplets.iter_mut().for_each(|droplet| droplet.viscosity = Some(1000.0));
    setup
}

/// Scene with droplets that have a cortex and friction with a substrate.
fn resisting(mut setup: Setup) -> Setup {
    for droplet in &mut setup.droplets {
        (droplet.cortex, droplet.friction) =
            (Cortex { viscosity: 50.0, per_concentration: 0.5, ..Cortex::default() }, 10.0);
    }
    setup
}

#[test]
fn steps_allocate_nothing() {
    assert_eq!(measure(|| drop(std::hint::black_box(vec![1.0; 10]))).count_total, 1);
    let smooth = Setup { method: Method::Grid(GridMethod::uncorrected(0.2)), ..Setup::default() };
    let coarse = GridMethod { spacing: 0.2, ..GridMethod::thesis() };
    let thesis = Setup { method: Method::Grid(coarse), ..Setup::thesis() };
    let scenes = [
        ("grid", on_grid(0.2)),
        ("layers, contrast", viscous(by_layers(0.2))),
        ("grid, contrast", viscous(smooth.clone())),
        ("grid, gel", filled(on_grid(0.2))),
        ("grid, gel, contrast", viscous(filled(smooth))),
        ("layers, gel, contrast", viscous(filled(by_layers(0.2)))),
        ("integrals", without_grid(32, 128)),
        ("integrals, contrast", viscous(without_grid(32, 128))),
        ("grid, cortex", resisting(on_grid(0.2))),
        ("integrals, cortex, contrast", resisting(viscous(without_grid(32, 128)))),
        ("thesis", thesis.clone()),
        ("thesis, contrast", viscous(thesis)),
    ];
    for (name, base) in scenes {
        for region in [base.region, open_channel(6.0, 2.4), open_channel(6.0, 3.0)] {
            let setup = Setup { region, ..base.clone() };
            assert_eq!(allocations(setup.build().unwrap().scene), 0, "{name}, {region:?}");
        }
    }
}

#[test]
fn steps_between_elastic_walls_allocate_nothing() {
    let plain = Setup { method: Method::Grid(GridMethod::uncorrected(0.2)), ..elastic() };
    for setup in [elastic(), viscous(elastic()), plain.clone(), viscous(plain)] {
        assert_eq!(allocations(setup.build().unwrap().scene), 0, "{:?}", setup.droplets[0].viscosity);
    }
}

/// With the measurement of the spectral radius that comes every 25 steps.
#[test]
fn steps_of_the_chebyshev_method_allocate_nothing() {
    for (name, setup) in [("grid", on_grid(0.2)), ("integrals", without_grid(32, 128)), ("elastic walls", elastic())] {
        let scene = setup.build().unwrap().scene.advanced_by(RungeKuttaChebyshev::new());
        assert_eq!(allocations_after(30, scene), 0, "{name}");
    }
}
