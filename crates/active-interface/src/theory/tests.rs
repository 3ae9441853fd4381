use super::*;
use crate::observables::VelocityFrame;
use approx::assert_relative_eq;
use motile_base::Vec2;
use proptest::prelude::*;
use std::f64::consts::PI;

fn theory(inside: f64, outside: f64) -> LinearTheory {
    LinearTheory::new(RoundDroplet {
        radius: 1.3,
        viscosity_inside: inside,
        viscosity_outside: outside,
        tension: 4.0,
        activity: -0.7,
        concentration: 2.0,
        diffusivity: 0.1,
    })
    .unwrap()
}

/// Velocity in Cartesian components.
fn cartesian(flow: impl Fn(f64, f64) -> [f64; 2], x: f64, y: f64) -> [f64; 2] {
    let theta = y.atan2(x);
    let [r, t] = flow(x.hypot(y), theta);
    [r * theta.cos() - t * theta.sin(), r * theta.sin() + t * theta.cos()]
}

/// Divergence, and the residual eta lap v - grad p, by central differences.
fn stokes_residual(flow: &ModeFlow, eta: f64, x: f64, y: f64) -> f64 {
    let h = 1e-3;
    let v = |x, y| cartesian(|r, t| flow.velocity(r, t), x, y);
    let p = |x: f64, y: f64| flow.pressure(x.hypot(y), y.atan2(x));
    let centre = v(x, y);
    let (e, w, n, s) = (v(x + h, y), v(x - h, y), v(x, y + h), v(x, y - h));
    let divergence = (e[0] - w[0] + n[1] - s[1]) / (2.0 * h);
    let laplacian = |i: usize| (e[i] + w[i] + n[i] + s[i] - 4.0 * centre[i]) / (h * h);
    let fx = eta * laplacian(0) - (p(x + h, y) - p(x - h, y)) / (2.0 * h);
    let fy = eta * laplacian(1) - (p(x, y + h) - p(x, y - h)) / (2.0 * h);
    divergence.abs() + fx.abs() + fy.abs()
}

#[test]
fn the_modes_solve_the_stokes_equations() {
    for k in 1..=6 {
        let flow = theory(3.0, 0.5).mode_flow(k, 0.8, 0.05).unwrap();
        for (x, y) in [(0.4, 0.3), (-0.2, 0.9), (0.1, -0.6)] {
            assert!(stokes_residual(&flow, 3.0, x, y) < 1e-4, "inside, k = {k}");
        }
        for (x, y) in [(1.4, 0.9), (-2.0, 0.3), (0.1, -1.7)] {
            assert!(stokes_residual(&flow, 0.5, x, y) < 1e-4, "outside, k = {k}");
        }
    }
}

#[test]
fn the_modes_satisfy_the_interface_conditions() {
    // Continuity (2.6) and the stress balance (2.7), linearised about the circle, for either kind of perturbation.
    let (inside, outside) = (3.0, 0.5);
    let theory = theory(inside, outside);
    let (radius, tension, activity) = (1.3, 4.0, -0.7);
    for k in 1..=5u32 {
        for (c, dr) in [(0.8, 0.0), (0.0, 0.05)] {
            let flow = theory.mode_flow(k, c, dr).unwrap();
            let h = 1e-5;
            for theta in [0.3, 1.1, 2.5] {
                let (a, b) = (flow.velocity(radius, theta), flow.velocity(radius * (1.0 + 1e-14), theta));
                assert!((a[0] - b[0]).abs() < 1e-12 && (a[1] - b[1]).abs() < 1e-12, "continuity, k = {k}");
                // Stresses by one-sided differences of second order, from either side.
                let stress = |eta: f64, sign: f64| {
                    let v = |i: f64| flow.velocity(radius + sign * (1e-9 + i * h), theta);
                    let by_r = |j: usize| sign * (-3.0 * v(0.0)[j] + 4.0 * v(1.0)[j] - v(2.0)[j]) / (2.0 * h);
                    let radial = flow.velocity(radius + sign * 1e-9, theta + h)[0]
                        - flow.velocity(radius + sign * 1e-9, theta - h)[0];
                    let p = flow.pressure(radius + sign * 1e-9, theta);
                    let shear = eta * (by_r(1) - v(0.0)[1] / radius + radial / (2.0 * h * radius));
                    [2.0 * eta * by_r(0) - p, shear]
                };
                let (inner, outer) = (stress(inside, -1.0), stress(outside, 1.0));
                let n = f64::from(k);
                // F = d gamma/ds tangentially, -gamma kappa normally; to first order gamma varies by -activity c cos(k
                // theta) and kappa by (k^2 - 1) dr cos(k theta) / R^2. The uniform pressure jump has no shear, but
                // for dr the normal turns: the jump -gamma/R along the turned normal balances itself.
                let tangential = activity * c * n * (n * theta).sin() / radius;
                let normal =
                    -(tension * (n * n - 1.0) * dr / (radius * radius) - activity * c / radius) * (n * theta).cos();
                assert_relative_eq!(inner[1] - outer[1], tangential, epsilon = 1e-6);
                assert_relative_eq!(inner[0] - outer[0], normal, epsilon = 1e-6);
            }
        }
    }
}

#[test]
fn growth_rates_follow_from_the_flow() {
    let theory = theory(3.0, 0.5);
    let droplet = *theory.droplet();
    for k in 1..=5 {
        let shape = theory.mode_flow(k, 0.0, 1e-3).unwrap();
        // A shift of the circle (k = 1) moves with the frame of the droplet: it is no change of shape.
        if k > 1 {
            assert_relative_eq!(shape.velocity(1.3, 0.0)[0] / 1e-3, theory.shape_growth_rate(k), max_relative = 1e-12);
        }
        // dc/dt = -(c0/R) dv_theta/dtheta + (D/R^2) d^2c/dtheta^2 at theta = 0
        let amplitude = 0.01;
        let flow = theory.mode_flow(k, amplitude, 0.0).unwrap();
        let h = 1e-6;
        let slope = (flow.velocity(1.3, h)[1] - flow.velocity(1.3, -h)[1]) / (2.0 * h);
        let diffusion = -droplet.diffusivity * f64::from(k * k) * amplitude / (1.3 * 1.3);
        let rate = (-droplet.concentration / 1.3 * slope + diffusion) / amplitude;
        assert_relative_eq!(rate, theory.concentration_growth_rate(k), max_relative = 1e-8);
    }
    // The threshold is where mode 1 neither grows nor decays.
    let at = LinearTheory::new(RoundDroplet { activity: theory.activity_threshold(), ..droplet }).unwrap();
    assert!(at.concentration_growth_rate(1).abs() < 1e-15);
    assert!(at.concentration_growth_rate(2) < 0.0);
    // Speed: the flow far away in the droplet's frame.
    let far = theory.mode_flow(1, 0.8, 0.0).unwrap().velocity(1e9, 0.0)[0];
    assert_relative_eq!(far, theory.swimming_speed(0.8).unwrap(), max_relative = 1e-12);
}

#[test]
fn the_flow_of_the_reference_circle() {
    // reference/fixed_shape_velocities_ratio_10.csv, circle, 1+0.5cos, L = inf: field points inside and outside
    let theory = LinearTheory::new(RoundDroplet {
        radius: 1.0,
        viscosity_inside: 10.0,
        viscosity_outside: 1.0,
        tension: 1.0,
        activity: -1.0,
        concentration: 1.0,
        diffusivity: 0.0,
    })
    .unwrap();
    let flow = theory.mode_flow(1, 0.5, 0.0).unwrap();
    let speed = theory.swimming_speed(0.5).unwrap();
    let rows = [
        [0.1, 0.2, -2.125e-2, -4.545_454_545_454_4e-4],
        [-0.35, 0.4, -1.588_068_181_818_2e-2, 3.181_818_181_818_2e-3],
        [1.7, 0.9, -1.726_542_267_082_8e-3, -2.540_009_296_766e-3],
        [0.3, -1.8, 3.228_043_768_584_4e-3, 1.106_757_863_514_8e-3],
    ];
    for [x, y, vx, vy] in rows {
        // The table has the laboratory frame; the droplet swims along -x.
        let v = cartesian(|r, t| flow.velocity(r, t), x, y);
        assert_relative_eq!(v[0] - speed, vx, epsilon = 1e-14);
        assert_relative_eq!(v[1], vy, epsilon = 1e-14);
    }
}

#[test]
fn bad_values_are_refused() {
    let good = *theory(1.0, 1.0).droplet();
    assert!(LinearTheory::new(RoundDroplet { viscosity_outside: -1.0, ..good }).is_err());
    assert!(LinearTheory::new(RoundDroplet { radius: f64::NAN, ..good }).is_err());
    assert!(LinearTheory::new(RoundDroplet { diffusivity: -0.1, ..good }).is_err());
    assert!(theory(1.0, 1.0).mode_flow(0, 1.0, 0.0).is_err());
    assert!(theory(1.0, 1.0).swimming_speed(f64::NAN).is_err());
    assert!(SquirmerFlow::new(0.0, 1.0, 1.0).is_err());
    assert!(SquirmerFlow::new(1.0, f64::NAN, 1.0).is_err());
}

#[test]
fn the_droplet_of_mode_one_is_a_neutral_squirmer() {
    let theory = theory(2.0, 2.0);
    let flow = theory.mode_flow(1, 0.8, 0.0).unwrap();
    // theta = 0 is the rear: turn by pi.
    let squirmer = SquirmerFlow::new(1.3, 2.0 * theory.swimming_speed(0.8).unwrap(), 0.0).unwrap();
    for (r, theta) in [(0.4, 0.3), (1.2, 2.0), (1.31, 1.0), (4.0, -2.5)] {
        let (a, b) = (flow.velocity(r, theta), squirmer.polar_velocity(r, theta - PI));
        assert_relative_eq!(a[0], b[0], epsilon = 1e-13);
        assert_relative_eq!(a[1], b[1], epsilon = 1e-13);
    }
}

proptest! {
    #[test]
    fn the_squirmer_flow_has_no_sources_and_its_velocity_on_the_circle(
        b1 in -2.0..2.0f64, b2 in -2.0..2.0f64, x in -3.0..3.0f64, y in -3.0..3.0f64,
    ) {
        let squirmer = SquirmerFlow::new(1.5, b1, b2).unwrap();
        let theta = y.atan2(x);
        for r in [1.5, 1.5 * (1.0 + 1e-14)] {
            let [radial, azimuthal] = squirmer.polar_velocity(r, theta);
            prop_assert!(radial.abs() < 1e-12);
            prop_assert!((azimuthal - b1 * theta.sin() - 0.5 * b2 * (2.0 * theta).sin()).abs() < 1e-12);
        }
        let r = x.hypot(y);
        prop_assume!((r - 1.5).abs() > 0.01 && r > 0.05);
        let h = 1e-4;
        let v = |x: f64, y: f64| squirmer.velocity(Vec2::new(x, y), VelocityFrame::Laboratory);
        let divergence = (v(x + h, y).x - v(x - h, y).x + v(x, y + h).y - v(x, y - h).y) / (2.0 * h);
        prop_assert!(divergence.abs() < 1e-5, "{}", divergence);
        let far = v(1e6 * x / r, 1e6 * y / r);
        prop_assert!(far.length() < 1e-5);
    }
}

/// Their limits, and Cowley's own numbers: (3.9) with alpha = 0.6 in a channel of width 5 and length 48.
#[test]
fn fits_of_simulations() {
    let speed = |k| fits::speed_over_stiffness(0.2, 0.1, k, 1e4).unwrap();
    assert_eq!(speed(0.0), 0.2);
    assert!((speed(1e4) - (0.1 + 0.1 * (-1.0_f64).exp())).abs() < 1e-15 && (speed(1e6) - 0.1).abs() < 1e-15);
    let amplitude = |length| fits::amplitude_over_length([length, 5.0], 1.0, 0.6, 18.0).unwrap();
    assert_eq!(amplitude(12.0), 0.0);
    assert!((amplitude(48.0) - 0.9 * (1.0 - (-3.0_f64).exp())).abs() < 1e-15);
    assert!(fits::speed_over_length(-4.0, 0.0, 12.0).is_err());
    assert!(fits::speed_over_stiffness(0.2, f64::NAN, 1.0, 1.0).is_err());
    assert!(fits::amplitude_over_length([-1.0, 5.0], 1.0, 0.6, 18.0).is_err());
}

/// Growth matrices of degrees 1 to 4 (`axisymmetric.csv`), thresholds, the speeds of Marangoni and of Hadamard and
/// Rybczynski, the drag in a tube (the digits beyond Haberman and Sayre from a series of multipoles and of waves along
/// the tube).
#[test]
fn spheres_have_the_rates_of_the_reference() {
    let sphere = |inside: f64, outside: f64, activity: f64| {
        Sphere::new(RoundDroplet {
            radius: 1.0,
            viscosity_inside: inside,
            viscosity_outside: outside,
            tension: 10.0 - activity * 100.0,
            activity,
            concentration: 100.0,
            diffusivity: 0.1,
        })
        .unwrap()
    };
    // Without the excluded volume of the table, 4.5e-5 of the rates.
    let table = [
        (100.0, 100.0, -1.0, 2, [-0.502852992101, -0.057137668815, 0.25142649605, 0.0285143569649]),
        (100.0, 10.0, -1.0, 3, [-1.57726817238, -0.0465507078334, 0.512100055968, 0.37341392477]),
        (1.0, 10.0, -2.0, 4, [-39.1522038048, -1.3181477269, 24.9150387849, 39.2391931701]),
    ];
    for (inside, outside, activity, degree, expected) in table {
        let [[aa, ab], [ba, bb]] = sphere(inside, outside, activity).growth_matrix(degree).unwrap();
        // There concentrations are in units of c0.
        let largest = expected.iter().fold(0.0, |a: f64, b: &f64| a.max(b.abs()));
        for (value, exact) in [aa, 100.0 * ab, ba / 100.0, bb].into_iter().zip(expected) {
            assert!((value - exact).abs() < 2e-4 * largest, "{inside} {outside} {degree}: {value} for {exact}");
        }
    }
    // A passive drop relaxes at the exact rates of the table, to its digits.
    let passive = |inside: f64, degree: u32| {
        let drop = RoundDroplet {
            radius: 1.0,
            viscosity_inside: inside,
            viscosity_outside: 1.0,
            tension: 1.0,
            activity: 0.0,
            concentration: 1.0,
            diffusivity: 0.0,
        };
        Sphere::new(drop).unwrap().growth_matrix(degree).unwrap()[0][0]
    };
    for (inside, degree, exact) in [
        (0.01, 2, -0.826280632718),
        (0.1, 3, -1.34697804601),
        (1.0, 4, -1.03896103896),
        (10.0, 2, -0.0928661882651),
        (100.0, 4, -0.0209582702164),
    ] {
        assert!((passive(inside, degree) / exact - 1.0).abs() < 1e-10, "{inside} {degree}");
    }
    for (inside, outside, exact) in [(100.0, 100.0, -0.5), (100.0, 10.0, -0.32), (1000.0, 500.0, -4.0)] {
        let threshold = sphere(inside, outside, -1.0).activity_threshold();
        assert!((threshold / exact - 1.0_f64).abs() < 1e-14);
        assert!(
            sphere(inside, outside, exact).growth_matrix(1).unwrap()[1][1].abs() < 1e-14,
            "neutral at the threshold"
        );
    }
    assert!((marangoni_speed(0.5, [10.0, 1.0]).unwrap() - 0.0104166666667).abs() < 1e-12);
    assert!((settling_speed(1.0, 1.0, [1.0, 10.0]).unwrap() - 0.00761175814787).abs() < 1e-13);
    for (ratio, exact, error) in [(0.1, 1.2632139053, 1e-4), (0.3, 2.3700948902, 2e-4), (0.5, 5.9473742458, 1.4e-2)] {
        assert!((tube_drag(ratio).unwrap() / exact - 1.0).abs() < error, "{ratio}");
    }
    assert!(tube_drag(0.7).is_err() && sphere(1.0, 1.0, -1.0).growth_matrix(0).is_err());
}

/// Growth matrices beside walls with slip, from the film's matrix by computer algebra (closed form).
#[test]
fn flat_interfaces_beside_walls_with_slip() {
    let cases = [
        (
            1.0,
            0.6,
            1.4,
            [100.0, 100.0],
            0.1,
            [0.042_890_821_951_4, -3.405_553_905_33, 3.095_958_095_76e-4, -0.029_958_780_652],
        ),
        (
            2.0,
            0.4,
            1.1,
            [50.0, 100.0],
            0.3,
            [0.108_231_341_051, -26.388_948_112_8, 5.997_488_207_45e-4, -0.267_238_268_891],
        ),
    ];
    for (wave_number, below, above, [low, high], slip, expected) in cases {
        let interface =
            FlatInterface { wave_number, tension: 110.0, activity: -1.0, concentration: 100.0, diffusivity: 0.1 };
        let wall = |viscosity, thickness| Stratum { viscosity, end: StratumEnd::SlipWall { thickness, slip } };
        let [[cc, ch], [hc, hh]] = interface.growth_matrix(wall(low, below), wall(high, above)).unwrap();
        for (found, expected) in [cc, ch, hc, hh].into_iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 1e-11, "{found} {expected}");
        }
        let stuck = |thickness, end: fn(f64) -> StratumEnd| Stratum { viscosity: high, end: end(thickness) };
        let no_slip = interface.mobility(stuck(below, |thickness| StratumEnd::Wall { thickness }), wall(high, above));
        let zero = interface
            .mobility(stuck(below, |thickness| StratumEnd::SlipWall { thickness, slip: 0.0 }), wall(high, above));
        assert_eq!(no_slip.unwrap(), zero.unwrap());
    }
}
