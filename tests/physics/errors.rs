//! Wrong input ends in an error that names it, before any work; a run that goes wrong leaves the last good state.

use motile::base::Region;
use motile::base::{FlowSample, Vec2};
use motile::scene::{Body, FlowError, SceneError, StepSize};
use motile::setup::{Built, DropletSetup, GridMethod, IntegralMethod, Method, Setup};
use motile_tests::validation::scene::{by_layers, on_grid, open_channel};

#[test]
fn wrong_numbers_are_refused() {
    for base in [on_grid(0.2), Setup::default()] {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let droplets = [
                ("particles.activity", DropletSetup::active(bad)),
                ("angle", DropletSetup { angle: bad, ..DropletSetup::default() }),
                ("viscosity", DropletSetup { viscosity: Some(bad), ..DropletSetup::default() }),
            ];
            for (key, droplet) in droplets {
                let setup = Setup { droplets: vec![droplet], region: open_channel(6.0, 3.0), ..base.clone() };
                let message = setup.build().expect_err(key).to_string();
                assert!(message.starts_with(&format!("droplets[0].{key} = {bad}")), "{message}");
            }
        }
    }
    let narrow =
        Setup { region: open_channel(6.0, 1.6), ..on_grid(0.2) }.build().expect_err("narrower than the droplet");
    assert!(narrow.to_string().contains("6 x 1.6"), "{narrow}");
}

/// Lengths, spacings and numbers that would ask for more memory than there is end in an error before they do.
#[test]
fn sizes_are_refused_before_they_are_allocated() {
    let square = |side: f64| Region::Box { lengths: [side; 2] };
    let marker_spacing = |spacing| GridMethod { marker_spacing: Some(spacing), ..GridMethod::of_spacing(0.1) };
    let setups = [
        ("spacing", Setup { region: square(6.0), ..on_grid(1e-7) }),
        ("spacing", Setup { region: square(1e5), ..on_grid(0.1) }),
        ("spacing", Setup { region: open_channel(1e5, 1e5), ..on_grid(0.1) }),
        ("marker-spacing", Setup { method: Method::Grid(marker_spacing(1e-9)), ..on_grid(0.1) }),
        ("marker-spacing", Setup { method: Method::Grid(marker_spacing(1e-300)), ..on_grid(0.1) }),
        (
            "nodes",
            Setup { method: Method::Integral(IntegralMethod { nodes: usize::MAX, elements: 0 }), ..on_grid(0.1) },
        ),
        (
            "elements",
            Setup { method: Method::Integral(IntegralMethod { nodes: 64, elements: usize::MAX }), ..on_grid(0.1) },
        ),
    ];
    for (key, setup) in setups {
        let mut error = None;
        let memory = allocation_counter::measure(|| error = setup.build().err());
        let error = error.unwrap_or_else(|| panic!("{key} is taken")).to_string();
        assert!(error.contains(key), "{error}");
        assert!(memory.bytes_max < 100 << 20, "{key}: {} MB", memory.bytes_max >> 20);
    }
}

#[test]
fn activities_beyond_measure_are_named() {
    let with = |activity| Setup { droplets: vec![DropletSetup::active(activity)], ..on_grid(0.2) };
    let message = with(-1e308).build().expect_err("an activity out of range").to_string();
    assert!(message.contains("particles.activity = -1e308: use a number from -1e50 to 1e50"), "{message}");
    // An excluded volume that is stronger still keeps the particles apart.
    let crowded = Setup { droplets: vec![DropletSetup::contractile(-1e40, 1e41)], ..on_grid(0.2) };
    let error = crowded.build().unwrap().scene.run(1.0).go().unwrap_err();
    assert!(matches!(error, SceneError::Refused { .. }), "{error}");
    let text = error.to_string();
    assert!(text.starts_with("the time step at the start of the run would be "), "{text}");
    assert!(text.contains("Use less activity, tension or stiffness for droplet"), "{text}");
}

#[test]
fn places_that_are_not_finite_are_not_sampled() {
    for (base, viscosities) in
        [(on_grid(0.2), [None, None]), (by_layers(0.2), [None, Some(1000.0)]), (Setup::default(), [None, Some(1000.0)])]
    {
        for viscosity in viscosities {
            let droplets = vec![DropletSetup { viscosity, ..DropletSetup::default() }];
            let mut scene = Setup { droplets, ..base.clone() }.build().unwrap().scene;
            for bad in [f64::NAN, f64::INFINITY] {
                let mut samples = [FlowSample::default(); 2];
                let places = [Vec2::ZERO, Vec2::new(0.0, bad)];
                let error = scene.system_mut().sample(&places, &mut samples).unwrap_err();
                assert!(error.explanation().contains(&bad.to_string()), "{}", error.explanation());
            }
        }
    }
}

#[test]
fn a_step_above_the_limit_is_refused_before_any_work() {
    let mut scene = on_grid(0.1).build().unwrap().scene;
    let error = scene.run(1.0).step_size(StepSize::Fixed(5.0)).go().unwrap_err();
    assert!(matches!(error, SceneError::TimeStepTooLarge { .. }), "{error}");
    assert!(error.to_string().contains("time step 5 is above the stable"), "{error}");
    assert_eq!(scene.steps(), 0);
    for dt in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        assert!(scene.step(dt).is_err());
        assert!(scene.run(1.0).step_size(StepSize::Fixed(dt)).go().is_err());
    }
    assert!(scene.run(f64::NAN).go().is_err() && scene.run(-1.0).go().is_err());
}

/// Times and residuals of errors are rounded to what tells something, but two numbers are told apart.
#[test]
fn errors_of_runs_print_no_more_digits_than_needed() {
    let time = (0..86).map(|_| 0.3).sum();
    let what = "the iteration for the velocities of interfaces and rigid bodies";
    let residual = FlowError::NoConvergence { what, iterations: 40, residual: 2e-7 / 3.0, tolerance: 1e-9 };
    let (x, y, depth) = (1.0 / 3.0, 1.5, 2e-9 / 3.0);
    let depth = FlowError::BeyondWall { body: 0, marker: 3, x, y, depth, allowed: 1e-11 };
    let [residual, depth] = [residual, depth].map(|source| SceneError::Flow { time, source });
    let far = SceneError::TimeStepTooLarge { dt: 0.1 + 0.2, limit: 0.01, reason: "tension", body: "it".into() };
    let near = SceneError::TimeStepTooLarge { dt: 1.000_04, limit: 1.0, reason: "tension", body: "it".into() };
    let told = [SceneError::Stopped { time }, residual, depth, far, near].map(|error| error.to_string());
    let expected = [
        &["stopped at time 25.8:"][..],
        &["at time 25.8 the flow", "residual of 6.67e-8 after 40 iterations, above 1e-9. "],
        &["at time 25.8 the flow", "at (0.3333, 1.5000) is 6.67e-10 beyond the wall, more than 1e-11. "],
        &["time step 0.3 is above the stable 0.01 set by tension"],
        &["time step 1.00004 is above the stable 1 set by tension"],
    ];
    for (text, parts) in told.iter().zip(expected) {
        assert!(parts.iter().all(|part| text.contains(part)), "{text}");
    }
}

#[test]
fn a_step_that_fails_leaves_the_last_state() {
    let Built { mut scene, droplets, .. } = on_grid(0.1).build().unwrap();
    let droplet = droplets[0];
    scene.step(0.01).unwrap();
    let before = scene.body(droplet).unwrap().markers().to_vec();
    let error = (0..50).find_map(|_| scene.step(50.0).err()).expect("steps 500 times too large end in an error");
    assert!(matches!(error, SceneError::Body { .. } | SceneError::Flow { .. }), "{error}");
    // The state is one from which the scene can go on.
    assert!(scene.body(droplet).unwrap().markers().iter().all(|marker| marker.x.is_finite()));
    assert_eq!(scene.body(droplet).unwrap().markers().len(), before.len());
    scene.step(0.001).unwrap();
}

#[test]
fn markers_beyond_a_wall_are_named() {
    let setup = Setup { region: open_channel(6.0, 2.0), ..on_grid(0.1) };
    let Built { mut scene, droplets, .. } = setup.build().unwrap();
    let body = scene.body_mut(droplets[0]).unwrap();
    let mut state = vec![0.0; body.state_len()];
    body.write_state(&mut state);
    let markers = body.marker_count();
    for y in state[..2 * markers].iter_mut().skip(1).step_by(2) {
        *y += 0.05;
    }
    body.read_state(&state).unwrap();
    match scene.step(0.01).unwrap_err() {
        SceneError::Flow { source: FlowError::BeyondWall { depth, allowed, .. }, .. } => {
            assert!((allowed - 0.025).abs() < 1e-12 && depth > allowed && depth < 0.06);
        }
        other => panic!("{other}"),
    }
}
