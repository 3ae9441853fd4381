//! Rigid walls of any shape against exact values and limits.

use std::f64::consts::TAU;

use motile::base::{Drive, FlowSample, Region, Vec2};
use motile::boundary_integrals::{BoundaryIntegral, RigidWall, Settings};
use motile::scene::{Hydrodynamics, MarkerKind, Markers};
use motile_tests::validation::{StudyError, curved_walls, order};

/// `curved_walls_*.csv`: droplets of fixed shape in a wavy channel; errors fall faster than any power of the nodes.
#[test]
fn droplets_between_curved_walls() {
    let coarse = curved_walls::fixed(32, 48).unwrap();
    let fine = curved_walls::fixed(96, 96).unwrap();
    println!("{coarse:?} {fine:?}");
    assert!(coarse.markers < 2e-5 && fine.markers < 1e-11 && fine.field < 1e-11, "{coarse:?} {fine:?}");
    assert!(fine.flux < 1e-11 && fine.force < 1e-11, "{fine:?}");
}

/// The pressure gradient that drives a unit flux of unit viscosity through a channel between
/// y = -(1 + amplitude cos(2 pi x/length)) and its mirror image, by layers of so many nodes a wall.
fn gradient(length: f64, amplitude: f64, nodes: usize) -> Result<f64, StudyError> {
    let half = |x: f64| 1.0 + amplitude * (TAU * x / length).cos();
    let region = Region::Channel { length, width: 2.0 * (1.5 + amplitude), drive: Drive::Flux(1.0) };
    let settings = Settings { nodes: 32, tolerance: 1e-13, ..Settings::default() };
    let walls = [RigidWall::below(length, nodes, |x| -half(x))?, RigidWall::above(length, nodes, half)?];
    let mut flow = BoundaryIntegral::new(region, 1.0, settings)?.with_walls(&walls)?;
    // Fluid in fluid, which changes nothing.
    let mut markers = Markers::new();
    markers.push_group(32, MarkerKind::UnevenInterface { viscosity_inside: None });
    for (k, position) in markers.positions_mut().iter_mut().enumerate() {
        *position = 0.2 * Vec2::from_angle(TAU * k as f64 / 32.0);
    }
    Ok(-flow.velocities(&mut markers)?.mean_pressure_gradient[0])
}

/// Mean pressure gradient to the second power of the amplitude, from the boundary conditions expanded about the
/// straight sides: with k = 2 pi/length, `3/2 (1 + amplitude^2 (3 k sinh(k)^2/(sinh(k) cosh(k) - k) - 3/2))`.
fn small_amplitude(length: f64, amplitude: f64) -> f64 {
    let k = TAU / length;
    let (sinh, cosh) = (k.sinh(), k.cosh());
    1.5 * (1.0 + amplitude * amplitude * (3.0 * k * sinh * sinh / (sinh * cosh - k) - 1.5))
}

/// Mean pressure gradient in the limit of a long channel: 3/2 times the mean of 1/h^3, h the half width.
fn lubrication(amplitude: f64) -> f64 {
    let square = amplitude * amplitude;
    1.5 * (1.0 + 0.5 * square) / (1.0 - square).powf(2.5)
}

/// The flux along a wavy channel: the error of the small-amplitude series is of the fourth power of the amplitude, that
/// of lubrication of the second power of the slope.
#[test]
fn flow_along_wavy_walls() {
    let amplitudes = [0.2, 0.1, 0.05];
    let errors = amplitudes.map(|a| {
        let exact = gradient(6.0, a, 96).unwrap();
        (small_amplitude(6.0, a) / exact - 1.0).abs()
    });
    assert!((order(&amplitudes, &errors) - 4.0).abs() < 0.2, "{errors:?}");
    let lengths = [12.0, 24.0, 48.0];
    let errors = lengths.map(|length| {
        let exact = gradient(length, 0.3, (8.0 * length) as usize).unwrap();
        (lubrication(0.3) / exact - 1.0).abs()
    });
    let slopes = lengths.map(|length| 1.0 / length);
    assert!((order(&slopes, &errors) - 2.0).abs() < 0.1, "{errors:?}");
    // The two limits meet.
    let [small, long] = [small_amplitude(1e3, 0.01), lubrication(0.01)];
    assert!((small / long - 1.0).abs() < 1e-6, "{small} {long}");
}

/// Nodes at unequal distances solve the same problem: the flow through a narrow place converges spectrally to that of
/// equal ones, with fewer nodes.
#[test]
fn nodes_may_be_where_walls_are_near() {
    let side = |x: f64| 1.25 - 0.85 * (-x * x).exp();
    let flow = |wall: &dyn Fn(RigidWall) -> RigidWall, nodes: usize| {
        let [below, above] = [RigidWall::below(12.0, nodes, |x| -side(x)), RigidWall::above(12.0, nodes, side)];
        let walls = [below, above].map(|side| wall(side.unwrap()));
        let region = Region::Channel { length: 12.0, width: 3.5, drive: Drive::Gradient(-1.0) };
        let flow = BoundaryIntegral::new(region, 1.0, Settings::default()).unwrap().with_walls(&walls);
        let places = [[0.0, 0.0], [0.6, -0.3], [3.0, 0.9], [-1.2, 0.75], [6.0, -0.2]].map(Vec2::from);
        let mut samples = [FlowSample::default(); 5];
        flow.unwrap().sample(&Markers::new(), &places, &mut samples).unwrap();
        samples.map(|sample| sample.velocity)
    };
    let exact = flow(&|wall| wall, 320);
    let error = |velocities: [Vec2; 5]| {
        let largest = exact.iter().map(|u| u.length()).fold(0.0, f64::max);
        velocities.iter().zip(&exact).map(|(u, v)| u.distance(*v)).fold(0.0, f64::max) / largest
    };
    let wanted = |factor: f64| move |place: Vec2| factor * (place.y.abs() / 0.4).min(3.0);
    let graded = |spacing: f64| {
        error(flow(&move |wall: RigidWall| wall.graded(wanted(spacing)).unwrap(), (TAU / spacing) as usize))
    };
    let [coarse, middle, fine] = [0.2, 0.14, 0.1].map(graded);
    println!("{coarse:e} {middle:e} {fine:e}");
    assert!(fine < 1e-8 && fine < 1e-2 * middle && middle < 0.1 * coarse, "{coarse:e} {middle:e} {fine:e}");
}
