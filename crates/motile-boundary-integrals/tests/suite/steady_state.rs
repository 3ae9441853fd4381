//! Cost of an evaluation in steady state: no memory, few iterations.

use crate::scenes;

use allocation_counter::measure;
use motile_base::{Drive, Region};
use motile_boundary_integrals::{BoundaryIntegral, Settings};
use motile_scene::{FlowWork, Hydrodynamics};
use scenes::{Ellipse, markers};

fn pair(viscosity: f64) -> [Ellipse; 2] {
    let first = Ellipse { viscosity: Some(viscosity), ..Ellipse::circle(0.0, 0.0, |t| 1.0 + 0.5 * t.cos()) };
    // Close enough for the quadrature of close nodes.
    [first, Ellipse { centre: [2.1, 0.2], ..first }]
}

fn allocations(region: Region, viscosity: f64) -> u64 {
    let mut solver = BoundaryIntegral::new(region, 1.0, Settings::default()).expect("a valid scene");
    let mut markers = markers(&pair(viscosity), 128);
    solver.velocities(&mut markers).expect("a valid scene");
    solver.velocities(&mut markers).expect("a valid scene");
    let counted = measure(|| {
        for _ in 0..3 {
            markers.positions_mut().iter_mut().for_each(|x| *x *= 1.0001);
            solver.velocities(&mut markers).expect("a valid scene");
        }
    });
    counted.count_total
}

#[test]
fn evaluations_allocate_nothing() {
    for viscosity in [1.0, 20.0] {
        assert_eq!(allocations(Region::Plane, viscosity), 0);
        assert_eq!(allocations(Region::Box { lengths: [6.0, 7.0] }, viscosity), 0);
        assert_eq!(allocations(Region::Box { lengths: [16.0, 17.0] }, viscosity), 0);
        // Walls far from and close to the droplets.
        assert_eq!(allocations(Region::Channel { length: 8.0, width: 5.0, drive: Drive::default() }, viscosity), 0);
        let close = Region::Channel { length: 8.0, width: 2.7, drive: Drive::ZeroFlux };
        assert_eq!(allocations(close, viscosity), 0);
    }
}

#[test]
fn evaluations_of_many_droplets_allocate_nothing() {
    let lattice = |side: usize, viscosity| {
        let droplet = pair(viscosity)[0];
        let place = |k: usize| [2.6 * (k % side) as f64, 2.6 * (k / side) as f64];
        let droplets: Vec<_> = (0..side * side).map(|k| Ellipse { centre: place(k), ..droplet }).collect();
        let region = Region::Box { lengths: [2.6 * side as f64; 2] };
        let mut solver = BoundaryIntegral::new(region, 1.0, Settings::default()).expect("a valid scene");
        let mut markers = markers(&droplets, 64);
        for _ in 0..3 {
            solver.velocities(&mut markers).expect("a valid scene");
        }
        let counted = measure(|| {
            for _ in 0..3 {
                solver.velocities(&mut markers).expect("a valid scene");
            }
        });
        counted.count_total
    };
    // On one thread: to hand work to others allocates.
    let thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    for viscosity in [1.0, 20.0] {
        assert_eq!(thread.install(|| lattice(5, viscosity)), 0);
    }
}

#[test]
fn work_is_counted_and_equal_viscosities_iterate_never() {
    let mut solver =
        BoundaryIntegral::new(Region::Box { lengths: [6.0, 6.0] }, 1.0, Settings::default()).expect("a valid scene");
    let mut equal = markers(&pair(1.0), 128);
    for _ in 0..3 {
        solver.velocities(&mut equal).expect("a valid scene");
    }
    assert_eq!(solver.work(), FlowWork { evaluations: 3, ..FlowWork::default() });
}

#[test]
fn iterations_do_not_grow_with_the_nodes_and_little_with_the_ratio() {
    let droplet = Ellipse { axes: [1.3, 1.0 / 1.3], ..Ellipse::circle(0.0, 0.0, |t| 1.0 + 0.5 * t.cos()) };
    let region = Region::Box { lengths: [6.0, 6.0] };
    for (ratio, most) in [(10.0, 11), (100.0, 12), (1000.0, 14), (0.001, 12)] {
        let shape = Ellipse { viscosity: Some(ratio), ..droplet };
        for nodes in [48, 96, 192] {
            let settings = Settings { nodes, ..Settings::default() };
            let mut solver = BoundaryIntegral::new(region, 1.0, settings).expect("a valid scene");
            let mut markers = markers(&[shape], 256);
            let cold = solver.velocities(&mut markers).expect("a valid scene").iterations;
            let warm = solver.velocities(&mut markers).expect("a valid scene").iterations;
            println!("ratio {ratio} nodes {nodes}: {cold} {warm}");
            assert!(cold <= most && warm == 0, "ratio {ratio} nodes {nodes}: {cold} {warm}");
        }
    }
}

#[test]
fn stiffness_is_the_rate_of_the_finest_wave() {
    // Wave number 32 of 64 nodes on a unit circle relaxes at the rate 32/(2 (eta_in + eta_ext)) tension, the stiffness
    // over the mean of both viscosities.
    let mut solver = BoundaryIntegral::new(Region::Plane, 2.0, Settings::default()).expect("a valid scene");
    assert!((solver.fluid_view().interface_stiffness - 8.0).abs() < 1e-12);
    for inside in [2.0, 14.0, 0.002] {
        let droplet = Ellipse { viscosity: Some(inside), ..pair(1.0)[0] };
        solver.velocities(&mut markers(&[droplet], 128)).expect("a valid scene");
        let view = solver.fluid_view();
        assert!((view.interface_stiffness - 8.0).abs() < 1e-10, "{inside}: {}", view.interface_stiffness);
        assert!(view.spacing.is_none() && view.domain.walls.is_none());
    }
}
