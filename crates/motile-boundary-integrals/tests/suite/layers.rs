//! Boundary integrals against layers beside a grid.

use crate::scenes;

use ib_core::BSpline;
use motile_base::{Drive, FlowSample, Region, SolveReport, Vec2};
use motile_boundary_integrals::ImmersedLayers;
use motile_boundary_integrals::{BoundaryIntegral, Settings};
use motile_scene::{Hydrodynamics, MarkerKind, Markers};
use scenes::{Ellipse, markers};
use stokes_grid::{ChannelStokes, Grid, PeriodicStokes};

const COUNT: usize = 96;
const SPACING: f64 = 0.2;
const SETTINGS: Settings = Settings { nodes: 64, tolerance: 1e-10, most_iterations: 200, warm_start: true };

type Both = [Box<dyn Hydrodynamics>; 2];

fn in_box(lengths: [f64; 2]) -> Both {
    let [nx, ny] = lengths.map(|length| (length / SPACING).round() as usize);
    let grid = Grid::periodic(nx, ny, SPACING).expect("a grid");
    let solver = PeriodicStokes::new(grid, 1.0).expect("a solver");
    let layers = ImmersedLayers::new(solver, BSpline::<4>, SETTINGS.nodes, SETTINGS.tolerance);
    let integrals = BoundaryIntegral::new(Region::Box { lengths }, 1.0, SETTINGS);
    [Box::new(layers.expect("layers")), Box::new(integrals.expect("integrals"))]
}

fn in_channel(length: f64, width: f64, drive: Drive) -> Both {
    let [nx, ny] = [length, width].map(|length| (length / SPACING).round() as usize);
    let mut solver = ChannelStokes::new(Grid::channel(nx, ny, SPACING).expect("a grid"), 1.0).expect("a solver");
    solver.set_drive(drive).expect("a drive");
    let layers = ImmersedLayers::new(solver, BSpline::<4>, SETTINGS.nodes, SETTINGS.tolerance);
    let integrals = BoundaryIntegral::new(Region::Channel { length, width, drive }, 1.0, SETTINGS);
    [Box::new(layers.expect("layers")), Box::new(integrals.expect("integrals"))]
}

/// Droplets of viscosities 10 and 0.3 inside one another, and one of equal viscosity beside them.
fn nested() -> Markers {
    let outer = Ellipse { viscosity: Some(10.0), ..Ellipse::circle(-1.2, 0.1, |t| 1.0 + 0.4 * t.cos()) };
    let inner = Ellipse { axes: [0.4, 0.3], viscosity: Some(0.3), ..Ellipse::circle(-1.3, 0.2, |_| 1.0) };
    let other = Ellipse { axes: [0.9, 1.1], ..Ellipse::circle(1.3, -0.1, |t| 1.0 + 0.4 * t.sin()) };
    let mut markers = markers(&[outer, inner, other], COUNT);
    markers.set_viscosity_outside(1, Some(10.0)).expect("a viscosity");
    markers
}

/// The scene with points that no force acts on.
fn with_points(mut markers: Markers) -> Markers {
    let count = markers.len();
    let places = [Vec2::new(-1.2, 0.9), Vec2::new(-1.3, 0.25), Vec2::new(0.1, -1.4)];
    markers.push_group(places.len(), MarkerKind::Points);
    markers.positions_mut()[count..].copy_from_slice(&places);
    markers
}

/// A rigid body that is pulled, beside a droplet.
fn rigid() -> Markers {
    let droplet = Ellipse { viscosity: Some(5.0), ..Ellipse::circle(1.2, 0.0, |t| 1.0 + 0.3 * t.sin()) };
    let mut markers = markers(&[droplet], COUNT);
    markers.push_group(COUNT, MarkerKind::Rigid);
    let body = Ellipse { axes: [0.7, 0.5], angle: 0.3, ..Ellipse::circle(-1.1, 0.2, |_| 0.0) };
    for k in 0..COUNT {
        markers.positions_mut()[COUNT + k] = body.point(std::f64::consts::TAU * k as f64 / COUNT as f64);
        markers.forces_mut()[COUNT + k] = Vec2::new(0.3, -0.1) / COUNT as f64;
    }
    markers
}

/// Without solids and forces on points the grid has no part in it: not one solution, and the same numbers.
#[test]
fn of_interfaces_alone_are_boundary_integrals() {
    let channel = || in_channel(6.0, 4.0, Drive::Flux(0.4));
    let driven = || in_channel(6.0, 4.0, Drive::Gradient(-0.2));
    let scenes: [(&str, Both, Markers); 6] = [
        ("nested in a box", in_box([6.0, 6.0]), nested()),
        ("nested in a channel", driven(), nested()),
        ("points", channel(), with_points(nested())),
        ("a rigid body in a box", in_box([6.0, 4.0]), rigid()),
        ("a rigid body in a channel", channel(), with_points(rigid())),
        ("one viscosity", channel(), markers(&[Ellipse::circle(0.1, 0.3, |t| 1.0 + 0.3 * t.cos())], COUNT)),
    ];
    let places = [Vec2::new(-1.1, 0.3), Vec2::new(2.4, 0.3), Vec2::new(0.1, -0.9)];
    for (scene, flows, mut markers) in scenes {
        let seen = flows.map(|mut flow| {
            // The second solution starts from the first.
            let reports: [SolveReport; 2] = [(); 2].map(|()| flow.velocities(&mut markers).expect(scene));
            let mut samples = [FlowSample::default(); 3];
            flow.sample(&markers, &places, &mut samples).expect(scene);
            let work = flow.work();
            assert_eq!((work.stokes_solves, work.transforms, work.markers_spread), (0, 0, 0), "{scene}");
            assert_eq!(work.evaluations, 2, "{scene}");
            (reports, markers.velocities().to_vec(), samples, flow.fluid_view().interface_stiffness)
        });
        assert_eq!(seen[0], seen[1], "{scene}");
        assert!(seen[0].1.iter().any(|velocity| velocity.length() > 1e-3), "{scene}");
    }
}

/// A force on a point needs the grid, however late it comes.
#[test]
fn a_force_on_a_point_is_taken() {
    let [mut layers, mut integrals] = in_box([6.0, 6.0]);
    let mut markers = with_points(nested());
    layers.velocities(&mut markers).expect("interfaces alone");
    let before = markers.velocities().to_vec();
    let pulled = 3 * COUNT + 2;
    markers.forces_mut()[pulled] = Vec2::new(0.5, 0.0);
    assert!(integrals.velocities(&mut markers).is_err());
    layers.velocities(&mut markers).expect("a force on a point");
    assert_eq!(layers.work().stokes_solves, 2);
    assert!(markers.velocities()[pulled].x > before[pulled].x + 0.05);
}

/// The flow around a rigid body is known without a solution before: on the body it is that of the body.
#[test]
fn a_rigid_body_is_sampled_at_first_sight() {
    let (mut solved, flow) =
        (rigid(), || BoundaryIntegral::new(Region::Box { lengths: [6.0, 4.0] }, 1.0, SETTINGS).expect("a flow"));
    let mut known = flow();
    known.velocities(&mut solved).expect("velocities");
    let places = [Vec2::new(-1.1, 0.2), Vec2::new(-0.1, 0.2), Vec2::new(1.3, 0.1)];
    let sampled = |mut flow: BoundaryIntegral, markers: &Markers| {
        let mut samples = [FlowSample::default(); 3];
        flow.sample(markers, &places, &mut samples).expect("samples");
        samples.map(|sample| sample.velocity)
    };
    let [first, then] = [sampled(flow(), &rigid()), sampled(known, &solved)];
    for (first, then) in first.iter().zip(then) {
        assert!(first.distance(then) < 1e-8, "{first} {then}");
    }
    // In its middle the mean of the velocities of its opposite points.
    let at = |k: usize| solved.velocities()[COUNT + k];
    let middle = 0.5 * (at(0) + at(COUNT / 2));
    assert!(first[0].distance(middle) < 1e-6 && middle.length() > 1e-2, "{} {middle}", first[0]);
}
