//! Swimmers without excluded volume in the plane, which are known exactly.

use motile::active_interface::ExcludedVolume;
use motile::prelude::*;
use motile_steady_states::{Profile, SteadyState};

fn setup(activity: f64, nodes: usize) -> Setup {
    let method = Method::Integral(IntegralMethod { nodes, elements: 4 * nodes });
    let mut setup = Setup { region: Region::Plane, method, ..Setup::default() };
    setup.droplets[0] = DropletSetup::active(activity);
    setup.droplets[0].particles.as_mut().expect("particles").excluded_volume = ExcludedVolume::None;
    setup
}

/// At the threshold `c0 (1 - r^2)/(1 + r^2 - 2 r cos theta)` is a steady swimmer for any r, of the speed
/// `zeta c0 r/(2 (eta_in + eta_ext))` away from its peak.
#[test]
fn at_the_threshold_swimmers_of_any_speed_are_steady() {
    for r in [0.1, 0.2, 0.3] {
        let nodes = 96;
        let angle = |k: usize| std::f64::consts::TAU * k as f64 / nodes as f64;
        let density = |k: usize| 100.0 * (1.0 - r * r) / (1.0 + r * r - 2.0 * r * angle(k).cos());
        let profile = Profile {
            positions: (0..nodes).map(|k| Vec2::from_angle(angle(k))).collect(),
            density: (0..nodes).map(density).collect(),
            nuclei: Vec::new(),
        };
        let speed = 0.4 * 100.0 * r / 400.0;
        let state = SteadyState::near(&setup(-0.4, nodes), &profile, Vec2::new(-speed, 0.0), true).unwrap();
        println!("{r}: {} {speed}, residual {:.0e}", state.velocity().x, state.residual());
        assert!((state.velocity().x + speed).abs() < 1e-8, "{}", state.velocity());
        assert!(state.residual() < 1e-8);
    }
}

#[test]
fn above_the_threshold_the_error_says_that_particles_gather_to_a_point() {
    for activity in [-0.41, -0.5, -0.7] {
        let error = SteadyState::find(&setup(activity, 64)).unwrap_err().to_string();
        assert!(error.contains("gather to a point") && error.contains("excluded volume"), "{error}");
    }
    // Below it, the droplet comes to rest.
    let rest = SteadyState::find(&setup(-0.3, 64)).unwrap();
    assert!(rest.velocity().length() < 1e-6, "{}", rest.velocity());
}

/// Particles that lower the tension to below zero leave no state to search for.
#[test]
fn an_interface_under_compression_is_named() {
    for activity in [0.5, 1.5] {
        let mut setup = setup(activity, 64);
        setup.droplets[0] = DropletSetup::contractile(activity, 4.0);
        let error = SteadyState::find(&setup).unwrap_err().to_string();
        let (what, remedy) = ("the tension at the mean concentration is ", "Use a negative activity");
        assert!(error.contains(what) && error.contains(remedy), "{error}");
    }
}
