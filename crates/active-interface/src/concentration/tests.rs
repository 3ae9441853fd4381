use super::*;
use proptest::prelude::*;
use std::f64::consts::TAU;

/// One third-order Runge-Kutta step (Shu and Osher) of advection at unit speed.
fn advect(transport: &mut Transport, lengths: &[f64], velocities: &[f64], dt: f64, numbers: &mut [f64]) {
    let start = numbers.to_vec();
    let mut rate = vec![0.0; numbers.len()];
    for (keep, weight) in [(0.0, 1.0), (0.75, 0.25), (1.0 / 3.0, 2.0 / 3.0)] {
        rate.fill(0.0);
        transport.add_advection(numbers, lengths, velocities, &mut rate);
        for k in 0..numbers.len() {
            numbers[k] = keep * start[k] + weight * (numbers[k] + dt * rate[k]);
        }
    }
}

/// Error of the numbers after a quarter turn of 1 + sin(x)/2 on a circle of length 2 pi.
fn quarter_turn(m: usize, flux: Flux, forward: bool) -> f64 {
    let h = TAU / m as f64;
    let average = |k: usize, shift: f64| {
        let (a, b) = (k as f64 * h - shift, (k + 1) as f64 * h - shift);
        h - 0.5 * (b.cos() - a.cos())
    };
    let sign = if forward { 1.0 } else { -1.0 };
    let mut numbers: Vec<f64> = (0..m).map(|k| average(k, 0.0)).collect();
    let mut transport = Transport::new(m, flux);
    // The time error must stay below that of the fluxes: dt ~ h^(5/3).
    let steps = (0.25 * TAU / (0.4 * h.powf(5.0 / 3.0))).ceil() as usize;
    let dt = 0.25 * TAU / steps as f64;
    for _ in 0..steps {
        advect(&mut transport, &vec![h; m], &vec![sign; m], dt, &mut numbers);
    }
    (0..m).map(|k| (numbers[k] - average(k, sign * 0.25 * TAU)).abs() / h).fold(0.0, f64::max)
}

#[test]
fn orders_of_the_fluxes() {
    for forward in [true, false] {
        let weno = [20, 40, 80].map(|m| quarter_turn(m, Flux::Weno5, forward));
        assert!((weno[1] / weno[2]).log2() > 4.8, "{weno:?}");
        assert!(weno[2] < 1e-6, "{weno:?}");
        let upwind = [80, 160].map(|m| quarter_turn(m, Flux::Upwind, forward));
        let order = (upwind[0] / upwind[1]).log2();
        assert!((0.9..1.1).contains(&order), "{upwind:?}");
    }
}

#[test]
fn a_plateau_turns_once_without_overshoot() {
    let m = 200;
    let h = TAU / m as f64;
    let start: Vec<f64> = (0..m).map(|k| if (50..110).contains(&k) { h } else { 0.0 }).collect();
    let mut numbers = start.clone();
    let mut transport = Transport::new(m, Flux::Weno5);
    let steps = 2 * m;
    let mut repaired = 0.0;
    for _ in 0..steps {
        advect(&mut transport, &vec![h; m], &vec![1.0; m], TAU / steps as f64, &mut numbers);
        repaired += transport.repair(&mut numbers).unwrap().moved;
    }
    let highest = numbers.iter().fold(0.0f64, |a, &b| a.max(b)) / h;
    assert!(highest < 1.0 + 1e-6, "overshoot {}", highest - 1.0);
    assert!(repaired < 1e-12, "{repaired}");
    // the edges stay within a few segments
    let distance: f64 = numbers.iter().zip(&start).map(|(a, b)| (a - b).abs()).sum::<f64>() / h;
    assert!(distance < 8.0, "{distance} segments");
    assert!((numbers.iter().sum::<f64>() - start.iter().sum::<f64>()).abs() < 1e-13);
}

#[test]
fn a_mode_decays_as_the_discrete_laplacian_says() {
    let m = 64;
    let h = 0.1;
    let mode = 3.0 * TAU / m as f64;
    let (diffusivity, factor) = (0.2, 1.7);
    let start: Vec<f64> = (0..m).map(|k| h * (1.0 + 0.3 * (mode * k as f64).cos())).collect();
    let mut transport = Transport::new(m, Flux::Weno5);
    let mut numbers = start.clone();
    transport.solve_diffusion(&vec![h; m], &vec![diffusivity; m], factor, &mut numbers);
    let eigenvalue = -diffusivity * (2.0 * (0.5 * mode).sin() / h).powi(2);
    let mut explicit = start.clone();
    transport.add_diffusion(&vec![h; m], &vec![diffusivity; m], &start, factor, &mut explicit);
    for k in 0..m {
        let wave = 0.3 * h * (mode * k as f64).cos();
        assert!((numbers[k] - h - wave / (1.0 - factor * eigenvalue)).abs() < 1e-14);
        assert!((explicit[k] - h - wave * (1.0 + factor * eigenvalue)).abs() < 1e-14);
    }
}

#[test]
fn peclet_number_and_what_is_not_finite() {
    assert_eq!([0.1, 8.0].map(|d| element_peclet(&[0.5, -2.0, 1.0], &[0.1; 3], d)), [2.0, 0.025]);
    assert_eq!(element_peclet(&[0.0; 3], &[0.1; 3], 0.0), 0.0);
    let mut transport = Transport::new(8, Flux::Upwind);
    let mut rate = [0.5; 8];
    transport.add_advection(&[1.0; 8], &[1.0; 8], &[f64::INFINITY; 8], &mut rate);
    assert!(rate.iter().all(|rate| !rate.is_finite()));
    let mut numbers = [1.0; 8];
    transport.solve_diffusion(&[1.0, 1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0], &[1.0; 8], 1.0, &mut numbers);
    assert!(numbers.iter().all(|number| number.is_nan()));
}

#[test]
fn particles_are_kept_over_many_steps() {
    let m = 60;
    let lengths: Vec<f64> = (0..m).map(|k| 0.1 + 0.02 * (k as f64).sin()).collect();
    let velocities: Vec<f64> = (0..m).map(|k| (TAU * k as f64 / m as f64).sin()).collect();
    let diffusivities: Vec<f64> = (0..m).map(|k| 0.1 + 0.05 * (k as f64).cos()).collect();
    let mut numbers: Vec<f64> = (0..m).map(|k| 10.0 * (1.0 - (TAU * k as f64 / m as f64).cos())).collect();
    let total: f64 = numbers.iter().sum();
    let mut transport = Transport::new(m, Flux::Weno5);
    let mut rate = vec![0.0; m];
    for _ in 0..20_000 {
        rate.fill(0.0);
        transport.add_advection(&numbers, &lengths, &velocities, &mut rate);
        numbers.iter_mut().zip(&rate).for_each(|(n, r)| *n += 0.01 * r);
        transport.solve_diffusion(&lengths, &diffusivities, 0.01, &mut numbers);
        transport.repair(&mut numbers).unwrap();
    }
    let change = numbers.iter().sum::<f64>() / total - 1.0;
    assert!(change.abs() < 1e-12, "{change:e}");
}

proptest! {
    #[test]
    fn implicit_solution_solves_conserves_and_stays_positive(
        m in 6usize..50,
        seed in proptest::collection::vec((0.0..5.0f64, 0.05..0.3f64, 0.0..1.0f64), 50),
        factor in 0.0..0.3f64,
    ) {
        let mut numbers: Vec<f64> = seed[..m].iter().map(|s| s.0).collect();
        let lengths: Vec<f64> = seed[..m].iter().map(|s| s.1).collect();
        let diffusivities: Vec<f64> = seed[..m].iter().map(|s| s.2).collect();
        let before = numbers.clone();
        let mut transport = Transport::new(m, Flux::Weno5);
        transport.solve_diffusion(&lengths, &diffusivities, factor, &mut numbers);
        let mut residual = numbers.clone();
        transport.add_diffusion(&lengths, &diffusivities, &numbers, -factor, &mut residual);
        // Round-off of the fluxes: conductance times concentration.
        let largest = |values: &[f64]| values.iter().fold(0.0f64, |a, &b| a.max(b));
        let shortest = lengths.iter().fold(1.0f64, |a, &b| a.min(b));
        let stiffness = 1.0 + factor * largest(&diffusivities) / (shortest * shortest);
        let tolerance = 50.0 * f64::EPSILON * stiffness * largest(&before);
        for k in 0..m {
            prop_assert!((residual[k] - before[k]).abs() <= tolerance * stiffness, "{} {}", residual[k], before[k]);
            prop_assert!(numbers[k] >= -tolerance);
        }
        prop_assert!((numbers.iter().sum::<f64>() - before.iter().sum::<f64>()).abs() <= tolerance);
    }
}

/// Largest error of the face values of exp(sin x), n cells, averages by 8-point Gauss quadrature.
fn error(n: usize) -> f64 {
    let nodes = [0.183_434_642_495_649_8, 0.525_532_409_916_329, 0.796_666_477_413_626_7, 0.960_289_856_497_536_3];
    let weights = [0.362_683_783_378_362, 0.313_706_645_877_887_3, 0.222_381_034_453_374_48, 0.101_228_536_290_376_26];
    let h = TAU / n as f64;
    let f = |x: f64| x.sin().exp();
    let average: Vec<f64> = (0..n)
        .map(|k| {
            let middle = (k as f64 + 0.5) * h;
            (0..4).map(|i| weights[i] * (f(middle - 0.5 * h * nodes[i]) + f(middle + 0.5 * h * nodes[i]))).sum::<f64>()
                / 2.0
        })
        .collect();
    (0..n)
        .map(|k| {
            let v = std::array::from_fn(|i| average[(k + n + i - 3) % n]);
            (weno5(v) - f(k as f64 * h)).abs()
        })
        .fold(0.0, f64::max)
}

#[test]
fn fifth_order_on_smooth_data() {
    let errors = [error(40), error(80), error(160)];
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!(order > 4.7, "order {order}, errors {errors:?}");
    }
    assert!(errors[2] < 1e-7, "{errors:?}");
}

#[test]
fn a_step_is_not_overshot() {
    for position in 0..6 {
        let v = std::array::from_fn(|i| if i < position { 1.0 } else { 0.0 });
        let value = weno5(v);
        assert!((-1e-6..=1.0 + 1e-6).contains(&value), "{v:?}: {value}");
    }
}

proptest! {
    #[test]
    fn scales_with_the_data(v in proptest::array::uniform5(0.1..10.0f64), factor in 1e-6..1e6f64) {
        let scaled = weno5(v.map(|x| x * factor));
        prop_assert!((scaled / factor - weno5(v)).abs() < 1e-9 * 10.0);
    }

    #[test]
    fn straight_lines_are_exact(slope in -5.0..5.0f64, offset in -5.0..5.0f64) {
        let v = std::array::from_fn(|i| offset + slope * (i as f64 - 2.5));
        prop_assert!((weno5(v) - offset).abs() < 1e-12);
    }
}

#[test]
fn parabolas_are_exact() {
    // Averages of x^2 over unit cells around 0; the face is at x = 1/2.
    let v = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|i: f64| i * i + 1.0 / 12.0);
    assert!((weno5(v) - 0.25).abs() < 1e-14);
}
