//! Convergence of the coupled problem, flow with transport and tension, against an exact solution.

use motile::setup::{IntegralMethod, Method};
use motile_tests::validation::coupled::{Row, TIME, refinements};
use motile_tests::validation::order;
use motile_tests::validation::round_swimmer::{DEFAULT, RoundSwimmer};

fn rows(method: &str, in_space: bool) -> Vec<Row> {
    let all = refinements();
    let of = all.iter().find(|refinement| refinement.method == method && refinement.in_space == in_space);
    of.expect("a refinement").rows().expect("runs")
}

/// Both orders of the last rows lie in a range.
fn assert_orders(rows: &[Row], least: f64, most: f64) {
    let orders = rows.iter().filter_map(|row| row.orders).flatten();
    assert!(orders.clone().count() > 0 && orders.clone().all(|order| order > least && order < most), "{rows:?}");
}

#[test]
fn integrals_are_of_second_order_in_space_and_time() {
    let space = rows("boundary integrals", true);
    assert_orders(&space, 1.85, 2.1);
    assert!(space[2].errors.iter().all(|error| *error < 5e-4), "{space:?}");
    assert_orders(&rows("boundary integrals", false), 1.85, 2.1);
}

#[test]
fn layers_are_of_second_order_in_space_and_time() {
    let space = rows("layers", true);
    assert_orders(&space, 1.85, 2.1);
    assert!(space[2].errors.iter().all(|error| *error < 5e-4), "{space:?}");
    assert_orders(&rows("layers", false), 1.85, 2.1);
}

/// The corrected grid is between first and second order. Cowley's scheme is of first order at best, and far less
/// accurate at the same spacing.
#[test]
fn the_corrected_grid_converges_faster_than_the_scheme_of_the_thesis() {
    let (grid, thesis) = (rows("grid, corrected", true), rows("Cowley's scheme", true));
    let modes = |rows: &[Row]| -> Vec<f64> { rows.iter().map(|row| row.errors[0]).collect() };
    let spacings = [0.2, 0.1, 0.05];
    let [ours, hers] = [&grid, &thesis].map(|rows| order(&spacings, &modes(rows)));
    assert!(ours > 1.2 && hers > 0.4 && hers < 1.1, "{ours} {hers}");
    assert!(grid.iter().zip(&thesis).all(|(grid, thesis)| (0..2).all(|k| 30.0 * grid.errors[k] < thesis.errors[k])));
    assert_orders(&rows("grid, corrected", false), 1.85, 2.1);
}

/// At any viscosities, for particles that contract and for particles that spread, with a cluster or a hole at the rear.
#[test]
fn round_droplets_stay_round_and_follow_the_exact_solution() {
    let method = Method::Integral(IntegralMethod { nodes: 48, elements: 384 });
    for (activity, viscosities, sharpness) in [
        (-2.0, [1000.0, 100.0], 0.3),
        (-2.0, [10.0, 100.0], 0.1),
        (-0.4, [100.0, 100.0], 0.4),
        (2.0, [100.0, 100.0], -0.6),
        (2.0, [100.0, 20.0], 0.6),
    ] {
        let droplet = RoundSwimmer { activity, viscosities, sharpness, ..DEFAULT };
        let time = if droplet.rate() > 0.3 { 1.5 } else { TIME };
        let (found, exact) = (droplet.unbounded(method, time, 0.01).expect("a run"), droplet.exact(time));
        assert!(found.distance(&exact, &exact).iter().all(|error| *error < 5e-4), "{droplet:?}: {found:?} {exact:?}");
        assert!(found.deformation.abs() < 1e-6, "{droplet:?}: {found:?}");
    }
}

/// The solution satisfies its equation: transport by the conjugate of the concentration, and diffusion.
#[test]
fn the_exact_solution_satisfies_the_equation() {
    for droplet in [DEFAULT, RoundSwimmer { activity: 3.0, viscosities: [20.0, 70.0], sharpness: -0.5, ..DEFAULT }] {
        let kappa = droplet.activity / (2.0 * (droplet.viscosities[0] + droplet.viscosities[1]));
        let (time, d) = (0.7, 1e-4);
        let at = |angle: f64, time: f64| droplet.concentration_at(angle, droplet.sharpness_at(time));
        // The velocity along the surface, mode by mode: zeta c_k/(2 S) sin k theta.
        let q = droplet.sharpness_at(time);
        let velocity = |angle: f64| {
            let mode = |k: i32| -2.0 * droplet.diffusion / kappa * q.powi(k) * (f64::from(k) * angle).sin();
            kappa * (1..80).map(mode).sum::<f64>()
        };
        for angle in [0.1, 0.9, 2.0, 3.0] {
            let change = (at(angle, time + d) - at(angle, time - d)) / (2.0 * d);
            let flux = |angle: f64| {
                velocity(angle) * at(angle, time)
                    - droplet.diffusion * (at(angle + d, time) - at(angle - d, time)) / (2.0 * d)
            };
            let fall = (flux(angle + d) - flux(angle - d)) / (2.0 * d);
            let scale = change.abs() + fall.abs();
            assert!((change + fall).abs() < 1e-5 * scale, "{droplet:?} {angle}: {change} {fall}");
        }
    }
}
