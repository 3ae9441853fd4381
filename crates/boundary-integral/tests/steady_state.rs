//! What an evaluation costs once it has run: no memory, few iterations.

mod scenes;

use allocation_counter::measure;
use boundary_integral::{BoundaryIntegral, Forcing, Geometry, Settings, forcing};
use ib_core::{Hydrodynamics, hydrodynamics::FlowWork};
use scenes::{Ellipse, markers};
use stokes_grid::Drive;

fn pair(viscosity: f64) -> [Ellipse; 2] {
    let first = Ellipse { viscosity: Some(viscosity), ..Ellipse::circle(0.0, 0.0, |t| 1.0 + 0.5 * t.cos()) };
    // Close enough for the quadrature of close nodes.
    [first, Ellipse { centre: [2.1, 0.2], ..first }]
}

fn allocations(geometry: Geometry, viscosity: f64) -> u64 {
    let mut solver = BoundaryIntegral::new(geometry, 1.0, Settings::default()).expect("a valid scene");
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
        assert_eq!(allocations(Geometry::Plane, viscosity), 0);
        assert_eq!(allocations(Geometry::Box { lengths: [6.0, 7.0] }, viscosity), 0);
        assert_eq!(allocations(Geometry::Box { lengths: [16.0, 17.0] }, viscosity), 0);
        // Walls far from and close to the droplets.
        assert_eq!(
            allocations(Geometry::Channel { length: 8.0, width: 5.0, forcing: Forcing::default() }, viscosity),
            0
        );
        let close = Geometry::Channel { length: 8.0, width: 2.7, forcing: forcing(Drive::ZeroFlux) };
        assert_eq!(allocations(close, viscosity), 0);
    }
}

#[test]
fn work_is_counted_and_equal_viscosities_iterate_never() {
    let mut solver =
        BoundaryIntegral::new(Geometry::Box { lengths: [6.0, 6.0] }, 1.0, Settings::default()).expect("a valid scene");
    let mut equal = markers(&pair(1.0), 128);
    for _ in 0..3 {
        solver.velocities(&mut equal).expect("a valid scene");
    }
    assert_eq!(solver.work(), FlowWork { evaluations: 3, ..FlowWork::default() });
}

#[test]
fn iterations_do_not_grow_with_the_nodes_and_little_with_the_ratio() {
    let droplet = Ellipse { axes: [1.3, 1.0 / 1.3], ..Ellipse::circle(0.0, 0.0, |t| 1.0 + 0.5 * t.cos()) };
    let geometry = Geometry::Box { lengths: [6.0, 6.0] };
    for (ratio, most) in [(10.0, 11), (100.0, 12), (1000.0, 14), (0.001, 12)] {
        let shape = Ellipse { viscosity: Some(ratio), ..droplet };
        for nodes in [48, 96, 192] {
            let settings = Settings { nodes, ..Settings::default() };
            let mut solver = BoundaryIntegral::new(geometry, 1.0, settings).expect("a valid scene");
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
    // Wave number 32 of 64 nodes on a unit circle relaxes at the rate 32/(2 (eta_in + eta_out)) tension.
    let mut solver = BoundaryIntegral::new(Geometry::Plane, 2.0, Settings::default()).expect("a valid scene");
    assert!((solver.discretisation().interface_stiffness - 8.0).abs() < 1e-12);
    for (inside, expected) in [(2.0, 8.0), (14.0, 2.0), (0.002, 2.0 / 2.002 * 16.0)] {
        let droplet = Ellipse { viscosity: Some(inside), ..pair(1.0)[0] };
        solver.velocities(&mut markers(&[droplet], 128)).expect("a valid scene");
        let discretisation = solver.discretisation();
        assert!(
            (discretisation.interface_stiffness - expected).abs() < 1e-10,
            "{inside}: {}",
            discretisation.interface_stiffness
        );
        assert!(discretisation.spacing.is_none() && discretisation.domain.walls.is_none());
    }
}
