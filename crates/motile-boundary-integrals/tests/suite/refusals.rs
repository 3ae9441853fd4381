//! Bad input ends in an error that says what to do.

use crate::scenes;

use motile_base::{Drive, FlowSample, InputError, Region, Vec2};
use motile_boundary_integrals::{
    BoundaryIntegral, LayerError, PeriodicCalculus, RigidWall, Settings, TensionPlacement,
};
use motile_scene::{FlowError, Hydrodynamics, MarkerKind, Markers};
use scenes::{Ellipse, markers};

fn circle() -> Ellipse {
    Ellipse::circle(0.0, 0.0, |t| 1.0 + 0.5 * t.cos())
}

fn solver() -> BoundaryIntegral {
    BoundaryIntegral::new(Region::Plane, 1.0, Settings::default()).expect("a valid scene")
}

#[test]
fn domains_and_settings() {
    let channel = |length, width, drive| Region::Channel { length, width, drive };
    let regions = [
        Region::Box { lengths: [0.0, 1.0] },
        Region::Box { lengths: [1.0, f64::NAN] },
        Region::Box { lengths: [1.0, 100.0] },
        channel(1.0, -1.0, Drive::default()),
        channel(4.0, 1.0, Drive::Flux(f64::INFINITY)),
    ];
    for region in regions {
        assert!(BoundaryIntegral::new(region, 1.0, Settings::default()).is_err(), "{region:?}");
    }
    for viscosity in [0.0, -1.0, f64::NAN] {
        let error = BoundaryIntegral::new(Region::Plane, viscosity, Settings::default()).unwrap_err();
        assert!(matches!(error, LayerError::Input(InputError::NotPositive { name: "the viscosity", .. })));
    }
    let bad = [
        Settings { nodes: 8, ..Settings::default() },
        Settings { tolerance: 0.0, ..Settings::default() },
        Settings { tolerance: f64::NAN, ..Settings::default() },
        Settings { most_iterations: 0, ..Settings::default() },
    ];
    for settings in bad {
        assert!(BoundaryIntegral::new(Region::Plane, 1.0, settings).is_err(), "{settings:?}");
    }
    assert!(solver().with_reference_perimeter(-1.0).is_err());
}

/// Beyond a ratio of 1e8 round-off would be seen in the velocities.
#[test]
fn ratios_of_viscosities() {
    for (ratio, good) in [(1e8, true), (1e-8, true), (1.1e8, false), (1e-12, false)] {
        let mut markers = markers(&[Ellipse { viscosity: Some(ratio), ..circle() }], 64);
        assert_eq!(solver().velocities(&mut markers).is_ok(), good, "{ratio}");
    }
}

#[test]
fn plans() {
    assert!(PeriodicCalculus::new(3).is_err());
    assert!(PeriodicCalculus::new(1 << 40).is_err());
    let mut values = vec![Vec2::ZERO; 10];
    let mut calculus = PeriodicCalculus::new(10).expect("a valid scene");
    let positions = values.clone();
    assert!(calculus.tension_forces(&positions, &[1.0; 9], TensionPlacement::Points, &mut values).is_err());
}

#[test]
fn markers_that_are_not_an_interface() {
    let mut points = Markers::new();
    points.push_group(100, MarkerKind::Points);
    points.forces_mut()[7] = Vec2::X;
    let error = solver().velocities(&mut points).unwrap_err();
    assert!(matches!(error, FlowError::Refused { .. }), "{error}");
    assert!(
        error.to_string().starts_with("force on points that do not belong to an interface is not possible"),
        "{error}"
    );

    // The body is named, which is not the curve of that number.
    let mut few = Markers::new();
    few.push_group(1, MarkerKind::Points);
    few.push_group(32, MarkerKind::Interface { viscosity_inside: None });
    for (k, position) in few.positions_mut()[1..].iter_mut().enumerate() {
        *position = Vec2::from_angle(std::f64::consts::TAU * k as f64 / 32.0);
    }
    let refused = solver().velocities(&mut few).unwrap_err().to_string();
    assert!(refused.starts_with("a curve of body 1 has 32 points. Use a number from 64 to "), "{refused}");

    let mut clockwise = markers(&[circle()], 64);
    clockwise.positions_mut().reverse();
    let error = solver().velocities(&mut clockwise).unwrap_err();
    assert!(matches!(error, FlowError::Refused { .. }) && error.to_string().contains("run clockwise"), "{error}");

    for viscosity in [0.0, -3.0, f64::NAN] {
        let mut markers = markers(&[Ellipse { viscosity: Some(viscosity), ..circle() }], 64);
        assert!(matches!(
            solver().velocities(&mut markers),
            Err(FlowError::Input(InputError::NotPositive { .. } | InputError::NotFinite { .. }))
        ));
    }
}

#[test]
fn numbers_that_are_not_finite() {
    let mut bad = markers(&[circle(), Ellipse { centre: [3.0, 0.0], ..circle() }], 64);
    bad.positions_mut()[64 + 7].y = f64::NAN;
    let error = solver().velocities(&mut bad).unwrap_err();
    assert!(matches!(error, FlowError::NonFinite { what: "the position", body: 1, marker: 7, .. }), "{error}");
    let mut bad = markers(&[circle()], 64);
    bad.forces_mut()[3].x = f64::INFINITY;
    let error = solver().velocities(&mut bad).unwrap_err();
    assert!(matches!(error, FlowError::NonFinite { what: "the force", body: 0, marker: 3, .. }), "{error}");

    let mut good = markers(&[circle()], 64);
    let mut solver = solver();
    solver.velocities(&mut good).expect("a valid scene");
    let mut out = [FlowSample::default()];
    assert!(solver.sample(&good, &[Vec2::new(f64::NAN, 0.0)], &mut out).is_err());
    assert!(matches!(
        solver.sample(&good, &[], &mut out),
        Err(FlowError::Input(InputError::WrongLength { expected: 0, found: 1, .. }))
    ));
}

#[test]
fn beyond_a_wall() {
    let mut solver = BoundaryIntegral::new(
        Region::Channel { length: 6.0, width: 2.5, drive: Drive::default() },
        1.0,
        Settings::default(),
    )
    .expect("a valid scene");
    let mut markers = markers(&[Ellipse { centre: [0.0, 0.4], ..circle() }], 64);
    let error = solver.velocities(&mut markers).unwrap_err();
    assert!(matches!(error, FlowError::BeyondWall { body: 0, .. }), "{error}");
}

#[test]
fn interfaces_that_cross_do_not_panic() {
    let mut crossing = markers(
        &[
            Ellipse { viscosity: Some(50.0), ..circle() },
            Ellipse { centre: [0.5, 0.1], viscosity: Some(0.1), ..circle() },
        ],
        64,
    );
    // Any result is allowed that is an error or finite.
    if solver().velocities(&mut crossing).is_ok() {
        assert!(crossing.velocities().iter().all(|v| v.x.is_finite() && v.y.is_finite()));
    }
    let mut coinciding = markers(&[circle(), circle()], 64);
    if solver().velocities(&mut coinciding).is_ok() {
        assert!(coinciding.velocities().iter().all(|v| v.x.is_finite() && v.y.is_finite()));
    }
}

#[test]
fn no_markers_and_no_iterations_left() {
    let report = solver().velocities(&mut Markers::new()).expect("a valid scene");
    assert_eq!(report.iterations, 0);
    let settings = Settings { most_iterations: 2, ..Settings::default() };
    let mut solver = BoundaryIntegral::new(Region::Plane, 1.0, settings).expect("a valid scene");
    let mut markers = markers(&[Ellipse { axes: [1.4, 0.7], viscosity: Some(100.0), ..circle() }], 64);
    let error = solver.velocities(&mut markers).unwrap_err();
    assert!(matches!(error, FlowError::NoConvergence { iterations: 2, .. }), "{error}");
}

#[test]
fn walls() {
    let points = |count: usize| (0..count).map(|k| Vec2::new(0.1 * k as f64, -1.0)).collect::<Vec<_>>();
    let of = |points: Vec<Vec2>, nodes| RigidWall::line_below(points, 10.0, nodes).expect_err("refused").to_string();
    assert!(of(points(100), 4).contains("the number of nodes of a wall"), "{}", of(points(100), 4));
    assert!(of(points(20), 40).contains("the number of points of a wall"));
    let mut lost = points(100);
    lost[3].y = f64::NAN;
    assert!(of(lost.clone(), 40).contains("the points of a wall"), "{}", of(lost, 40));
}

/// A wall of straight pieces turns at each corner by twice the angle of its slope, about which a warning is given above
/// 0.7 and not below.
#[test]
fn corners_of_walls_are_told_from_their_angle_on() {
    let region = Region::Channel { length: 6.0, width: 8.0, drive: Drive::ZeroFlux };
    let excess = |turn: f64| {
        let slope = (0.5 * turn).tan();
        let zigzag = |x: f64| -2.0 + slope * ((x.rem_euclid(6.0) - 3.0).abs() - 1.5);
        let walls = [RigidWall::below(6.0, 48, zigzag).unwrap(), RigidWall::above(6.0, 48, |_| 2.0).unwrap()];
        let flow = BoundaryIntegral::new(region, 1.0, Settings::default()).unwrap().with_walls(&walls).unwrap();
        let warnings = flow.warnings();
        warnings.iter().find(|warning| warning.cause == "corners not resolved").map(|warning| warning.excess)
    };
    assert_eq!(excess(0.68), None);
    for turn in [0.72, 1.0, 1.3] {
        let found = excess(turn).unwrap();
        assert!((found - turn / 0.7).abs() < 1e-9, "{turn}: {found}");
    }
}
