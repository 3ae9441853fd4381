use motile::active_interface::Cortex;
use motile::active_interface::theory::{RoundDroplet, Sphere};
use motile::prelude::*;
use motile::setup::ExcludedVolume;

use super::*;
use crate::system::System;

fn setup(activity: f64, viscosities: [f64; 2], nodes: usize) -> Setup {
    let mut setup = Setup {
        region: Region::Space,
        viscosity: viscosities[1],
        method: Method::Integral(IntegralMethod { nodes, elements: 4 * nodes }),
        droplets: vec![DropletSetup::active(activity)],
        ..Setup::default()
    };
    setup.droplets[0].viscosity = Some(viscosities[0]);
    if let Some(particles) = &mut setup.droplets[0].particles {
        particles.excluded_volume = ExcludedVolume::Step(2.0 * activity.abs());
    }
    setup
}

/// Growth of a sphere at rest by spherical harmonics l: degenerate in the order m. Eigenvalues of the 2 x 2 matrices of
/// `axisymmetric.csv`, here of activity -1 in viscosities 100 and 10.
#[test]
fn a_sphere_grows_at_the_same_rates_in_every_order() {
    let state = SteadyState::uniform(&setup(-1.0, [100.0, 10.0], 48)).unwrap();
    let matrices = [
        (1, [0.0, -0.208314417555, 0.0, 0.424943252664]),
        (2, [-1.02151963887, -0.0590912995343, 0.260023180803, 0.505851462713]),
        (3, [-1.57726817238, -0.0465507078334, 0.512100055968, 0.37341392477]),
        (4, [-2.10983437183, -0.0387449076533, 0.767212498846, 0.034107651798]),
    ];
    for order in 0..3 {
        let matrix = System::new(state.setup()).unwrap().around(state.point(), order).unwrap();
        let found = eigenvalues(&matrix).unwrap();
        for (degree, [aa, ab, ba, bb]) in matrices.into_iter().filter(|(degree, _)| *degree >= order.max(1)) {
            let (half, det): (f64, f64) = (0.5 * (aa + bb), aa * bb - ab * ba);
            let exact = half + (half * half - det).sqrt();
            let error = found.iter().map(|z| (z - exact).norm()).fold(f64::INFINITY, f64::min);
            assert!(error < 1e-8, "order {order}, degree {degree}: {exact} missed by {error:e}");
        }
    }
}

/// Order 0 by the formulas for all orders and by differences of the equations of the curve: two derivations, whose
/// leading eigenvalues meet.
#[test]
fn disturbances_of_order_zero_are_those_of_the_spectrum() {
    let errors = [64, 96, 128].map(|nodes| {
        let state = SteadyState::find(&setup(-1.0, [100.0, 100.0], nodes)).unwrap();
        let leading = state.spectrum().unwrap().modes[0].value;
        let matrix = System::new(state.setup()).unwrap().around(state.point(), 0).unwrap();
        let found = eigenvalues(&matrix).unwrap();
        found.iter().map(|z| (z - leading).norm()).fold(f64::INFINITY, f64::min)
    });
    assert!(errors[1] < 0.2 * errors[0] && errors[2] < 0.2 * errors[1] && errors[2] < 1e-5, "{errors:?}");
}

/// A shift across the axis and a turn of a swimmer change no rate: two eigenvalues vanish as the nodes resolve it, as
/// the root of what the matrix errs by.
#[test]
fn shifts_and_turns_of_swimmers_are_neutral() {
    let neutral = [48, 72, 96].map(|nodes| {
        let state = SteadyState::find(&setup(-1.0, [100.0, 100.0], nodes)).unwrap();
        state.spectrum_around(1).unwrap().neutral
    });
    let [coarse, middle, fine] = neutral.map(|value| value * value);
    assert!(middle < 0.3 * coarse && fine < 0.3 * middle && fine < 1e-6, "{neutral:?}");
}

/// A droplet at rest has no turn to be left out: the leading mode of order 1 is the exact one of l = 2.
#[test]
fn at_rest_shifts_alone_are_left_out() {
    let state = SteadyState::uniform(&setup(-1.0, [100.0, 10.0], 48)).unwrap();
    let spectrum = state.spectrum_around(1).unwrap();
    // The 2 x 2 matrix of l = 2, which grows fastest.
    let [[aa, ab], [ba, bb]] = [[-1.02151963887, -0.0590912995343], [0.260023180803, 0.505851462713_f64]];
    let exact = 0.5 * (aa + bb) + (0.25 * (aa - bb) * (aa - bb) + ab * ba).sqrt();
    let error = (spectrum.modes[0].value - exact).norm();
    assert!(error < 1e-8 && spectrum.neutral < 1e-8, "{error:e}, {:e}", spectrum.neutral);
}

/// Leading eigenvalues of a swimmer settle as nodes are added, in the orders 1 and 2.
#[test]
fn eigenvalues_around_the_axis_settle() {
    let found = [48, 72, 96].map(|nodes| {
        let state = SteadyState::find(&setup(-1.0, [100.0, 100.0], nodes)).unwrap();
        [1, 2].map(|order| state.spectrum_around(order).unwrap().modes[0].value.re)
    });
    for order in 0..2 {
        let [coarse, middle, fine] = found.map(|values| values[order]);
        assert!((middle - fine).abs() < 0.3 * (coarse - fine).abs() && (middle / fine - 1.0).abs() < 8e-4, "{found:?}");
    }
}

/// Rate of turning of a strong swimmer, whose coefficients of shifts and turns change by .04 to .4 per time with these
/// nodes: their eigenvalues are small all the same, and no other one is touched.
#[test]
fn the_turning_rate_of_a_strong_swimmer_settles() {
    let [coarse, fine] = [96, 128].map(|nodes| {
        let state = SteadyState::find(&setup(-2.0, [100.0, 100.0], nodes)).unwrap();
        state.spectrum_around(1).unwrap().modes[0].value.re
    });
    assert!((coarse / fine - 1.0).abs() < 5e-3, "{coarse}, {fine}");
}

fn with_cortex(cortex: Cortex, activity: f64, viscosities: [f64; 2], nodes: usize) -> Setup {
    let mut setup = setup(activity, viscosities, nodes);
    setup.droplets[0].cortex = cortex;
    setup
}

/// With a cortex as well, the rates of a sphere do not depend on the order: from Lamb's solution with the surface of
/// Boussinesq and Scriven, which [`Sphere`] has.
#[test]
fn a_sphere_with_a_cortex_grows_at_the_same_rates_in_every_order() {
    for (dilatational, shear, viscosities) in
        [(50.0, 0.0, [100.0, 100.0]), (0.0, 50.0, [20.0, 100.0]), (100.0, 30.0, [100.0, 10.0])]
    {
        let cortex = Cortex { shear_viscosity: shear, ..Cortex::new(dilatational) };
        let state = SteadyState::uniform(&with_cortex(cortex, -1.0, viscosities, 48)).unwrap();
        let model = &System::new(state.setup()).unwrap().model;
        let droplet = RoundDroplet {
            radius: 1.0,
            tension: model.law.value(100.0),
            activity: -model.law.slope(100.0),
            concentration: 100.0,
            diffusivity: model.diffusion,
            viscosity_inside: viscosities[0],
            viscosity_outside: viscosities[1],
        };
        let theory = Sphere::new(droplet).unwrap().with_cortex(dilatational).unwrap();
        let theory = theory.with_shear_viscosity(shear).unwrap();
        for order in 0..3 {
            let matrix = System::new(state.setup()).unwrap().around(state.point(), order).unwrap();
            let found = eigenvalues(&matrix).unwrap();
            for degree in order.max(1)..5 {
                let [[aa, ab], [ba, bb]] = theory.growth_matrix(degree as u32).unwrap();
                let (half, square) = (0.5 * (aa + bb), 0.25 * (aa - bb) * (aa - bb) + ab * ba);
                let exact = half + Complex64::new(square, 0.0).sqrt();
                let error = found.iter().map(|z| (z - exact).norm()).fold(f64::INFINITY, f64::min);
                println!("{cortex:?} order {order}, degree {degree}: {exact} {error:.1e}");
                assert!(error < 1e-8, "order {order}, degree {degree}: {exact} missed by {error:e}");
            }
        }
    }
}

/// A cortex whose viscosity depends on the particles, on a swimmer that is no sphere: order 0 by differences of other
/// equations, and in order 1 shifts and turns, which change no rate.
#[test]
fn swimmers_with_a_cortex_turn_and_shift_freely() {
    let cortex = Cortex { shear_viscosity: 40.0, per_concentration: 0.3, ..Cortex::new(60.0) };
    let errors = [64, 96, 128].map(|nodes| {
        let state = SteadyState::find(&with_cortex(cortex, -1.3, [70.0, 100.0], nodes)).unwrap();
        let leading = state.spectrum().unwrap().modes[0].value;
        let matrix = System::new(state.setup()).unwrap().around(state.point(), 0).unwrap();
        let found = eigenvalues(&matrix).unwrap();
        let missed = found.iter().map(|z| (z - leading).norm()).fold(f64::INFINITY, f64::min);
        let neutral = state.spectrum_around(1).unwrap().neutral;
        println!("{nodes}: missed {missed:e} neutral {neutral:e}");
        [missed, neutral * neutral]
    });
    for kind in 0..2 {
        let [coarse, middle, fine] = errors.map(|error| error[kind]);
        assert!(middle < 0.3 * coarse && fine < 0.3 * middle && fine < 1e-5, "{errors:?}");
    }
}

#[test]
fn orders_that_are_not_computed_are_refused() {
    let state = SteadyState::uniform(&setup(-1.0, [100.0, 100.0], 32)).unwrap();
    for order in [0, 3] {
        assert!(state.spectrum_around(order).unwrap_err().to_string().contains("order"));
    }
    let plane = Setup { region: Region::Plane, ..setup(-1.0, [100.0, 100.0], 32) };
    let error = SteadyState::uniform(&plane).unwrap().spectrum_around(1).unwrap_err().to_string();
    assert!(error.contains("two dimensions"), "{error}");
}
