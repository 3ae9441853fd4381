//! Growth rates of the round droplet in unbounded fluid against their exact values, Cowley (2.18) and (2.19).

use motile::active_interface::Tension;
use motile::active_interface::theory::{LinearTheory, RoundDroplet};
use motile::prelude::*;
use motile_steady_states::{SteadyState, Symmetry};

/// Largest error of the growth rates of modes 1 to 6 of both symmetries, with the activity times `sign` in the theory.
fn worst_error(inside: f64, activity: f64, sign: f64) -> f64 {
    let method = Method::Integral(IntegralMethod { nodes: 32, elements: 128 });
    let droplet = DropletSetup { viscosity: Some(inside), ..DropletSetup::contractile(activity, 1.0) };
    let setup = Setup { method, region: Region::Plane, droplets: vec![droplet], ..Setup::default() };
    let law = setup.droplets[0].particles.expect("particles").law(setup.droplets[0].tension).expect("as described");
    let theory = LinearTheory::new(RoundDroplet {
        radius: 1.0,
        viscosity_inside: inside,
        viscosity_outside: setup.viscosity,
        tension: law.value(100.0),
        activity: -sign * law.slope(100.0),
        concentration: 100.0,
        diffusivity: 0.1,
    })
    .expect("as described");
    let state = SteadyState::uniform(&setup).expect("as described");
    let spectrum = state.spectrum().expect("as described");
    assert!(spectrum.neutral < 1e-8 && state.residual() < 1e-12);
    let mut worst = 0.0_f64;
    for symmetry in [Symmetry::Symmetric, Symmetry::Antisymmetric] {
        for k in 1..=6 {
            // Mode 1 of the shape is a translation, which is left out.
            let shape = (k > 1).then(|| theory.shape_growth_rate(k));
            for exact in shape.into_iter().chain([theory.concentration_growth_rate(k)]) {
                let nearest = spectrum.of(symmetry).map(|z| (z - exact).norm()).fold(f64::INFINITY, f64::min);
                worst = worst.max(nearest);
            }
        }
    }
    worst
}

#[test]
fn modes_one_to_six_of_the_circle_grow_as_linear_theory_has_it() {
    for (inside, activity) in [(100.0, -0.5), (30.0, -0.7), (1000.0, -0.3)] {
        let error = worst_error(inside, activity, 1.0);
        assert!(error < 1e-8, "viscosity {inside}, activity {activity}: error {error:.1e}");
    }
}

#[test]
fn a_wrong_sign_of_the_activity_shows() {
    assert!(worst_error(100.0, -0.5, -1.0) > 1e-2);
}
