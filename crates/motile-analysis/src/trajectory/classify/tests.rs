use super::*;
use approx::assert_relative_eq;
use proptest::prelude::*;
use std::f64::consts::TAU;

/// Speed of all droplets here.
const SPEED: f64 = 0.2;

/// Pseudo-random numbers in (-1, 1).
fn noise(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

fn even(end: f64, count: usize) -> Vec<f64> {
    (0..count).map(|i| end * i as f64 / (count - 1) as f64).collect()
}

fn trajectory(times: &[f64], height: impl FnMut(f64) -> f64) -> Trajectory {
    let heights = times.iter().copied().map(height).collect();
    Trajectory::new(times.to_vec(), heights, vec![SPEED; times.len()]).unwrap()
}

fn report(trajectory: &Trajectory) -> RegimeReport {
    trajectory.regime(&RegimeCriteria::default()).unwrap()
}

/// The van der Pol oscillator `y'' = mu (1 - y^2) y' - y`, by classical Runge-Kutta steps.
fn van_der_pol(mu: f64, start: f64, times: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let rate = |[y, v]: [f64; 2]| [v, mu * (1.0 - y * y) * v - y];
    let add = |a: [f64; 2], b: [f64; 2], f: f64| [a[0] + f * b[0], a[1] + f * b[1]];
    let mut state = [start, 0.0];
    let mut now = 0.0;
    times
        .iter()
        .map(|&t| {
            let steps = ((t - now) / 0.02).ceil().max(1.0);
            let dt = (t - now) / steps;
            for _ in 0..steps as usize {
                let k1 = rate(state);
                let k2 = rate(add(state, k1, 0.5 * dt));
                let k3 = rate(add(state, k2, 0.5 * dt));
                let k4 = rate(add(state, k3, dt));
                for (k, f) in [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)] {
                    state = add(state, k, f * dt / 6.0);
                }
            }
            now = t;
            (state[0], state[1])
        })
        .unzip()
}

#[test]
fn centre_line_at_round_off() {
    let mut random = noise(1);
    let times = even(300.0, 600);
    let report = report(&trajectory(&times, |_| 1e-12 * random()));
    assert_eq!(report.regime, Regime::CentreLine);
    assert!(report.evidence.extrema.is_empty() && report.evidence.growth_rate.is_none());
    assert!(report.evidence.largest < 1e-12 && report.evidence.amplitude < 1e-12);
    assert_eq!(trajectory(&times, |_| 0.0).regime(&RegimeCriteria::default()).unwrap().regime, Regime::CentreLine);
}

/// Growth rates and frequencies of `channel_lateral_stability.csv` over a few periods.
#[test]
fn growing_and_decaying_oscillations() {
    for (s, w) in [(-0.000_942_6, 0.033_642_4), (0.006_669_6, 0.057_778_5), (0.001_177_4, 0.045_963_5), (0.019, 0.126)]
    {
        // Three periods remain after the transient.
        let times = even(3.75 * TAU / w, 600);
        let report = report(&trajectory(&times, |t| 0.01 * (s * t).exp() * (w * t + 0.4).sin()));
        let evidence = &report.evidence;
        assert_eq!(report.regime, if s > 0.0 { Regime::Growing } else { Regime::Decaying });
        assert_relative_eq!(evidence.growth_rate.unwrap().value, s, max_relative = 1e-3);
        assert_relative_eq!(evidence.period.unwrap().value, TAU / w, max_relative = 1e-4);
        assert!((2.0..=3.0).contains(&evidence.periods) && evidence.extrema.len() >= 5);
        assert!(evidence.mode.is_none());
    }
}

#[test]
fn a_record_of_one_period_uses_the_linear_fit() {
    for (s, w) in [(-0.000_942_6, 0.033_642_4), (0.006_669_6, 0.057_778_5), (0.001_177_4, 0.045_963_5)] {
        let times = even(1.25 * TAU / w, 300);
        let report = report(&trajectory(&times, |t| 0.01 * (s * t).exp() * (w * t + 0.4).sin()));
        assert_eq!(report.regime, if s > 0.0 { Regime::Growing } else { Regime::Decaying });
        let evidence = &report.evidence;
        assert_relative_eq!(evidence.growth_rate.unwrap().value, s, max_relative = 1e-3);
        assert_relative_eq!(evidence.period.unwrap().value, TAU / w, max_relative = 1e-4);
        assert_relative_eq!(evidence.periods, 1.0, max_relative = 0.02);
        assert!(evidence.mode.is_some());
    }
}

/// Amplitude and period of the limit cycle: 2.008619861 and 6.663286859 for mu = 1; 2.0001 and 2 pi (1 + mu^2/16) for
/// mu = 0.1.
#[test]
fn limit_cycles() {
    for (mu, amplitude, period) in [(1.0, 2.008_619_861, 6.663_286_859), (0.1, 2.000_104, 6.287_111)] {
        let times = even(40.0 / mu + 60.0, 2000);
        let (heights, _) = van_der_pol(mu, 0.01, &times);
        let speeds = vec![SPEED; times.len()];
        let report = report(&Trajectory::new(times, heights, speeds).unwrap());
        assert_eq!(report.regime, Regime::SteadyOscillation, "{report:?}");
        let evidence = &report.evidence;
        assert_relative_eq!(evidence.period.unwrap().value, period, max_relative = 1e-3);
        assert_relative_eq!(evidence.amplitude, amplitude, max_relative = 1e-3);
        assert_relative_eq!(evidence.half_height.unwrap(), amplitude, max_relative = 1e-3);
        assert!(evidence.midline.unwrap().abs() < 2e-4);
        assert!((evidence.growth_rate.unwrap().value * period).abs() < 4e-4);
    }
}

#[test]
fn on_the_way_to_a_limit_cycle() {
    let times = even(60.0, 600);
    let (heights, _) = van_der_pol(0.1, 0.01, &times);
    let speeds = vec![SPEED; times.len()];
    let report = report(&Trajectory::new(times, heights, speeds).unwrap());
    assert_eq!(report.regime, Regime::Growing);
    // The linear growth rate is mu / 2.
    assert_relative_eq!(report.evidence.growth_rate.unwrap().value, 0.05, max_relative = 1e-2);
}

#[test]
fn oscillation_off_the_centre_line() {
    let times = even(200.0, 500);
    let steady = report(&trajectory(&times, |t| 0.8 + 0.1 * (0.3 * t).sin()));
    assert_eq!(steady.regime, Regime::SteadyOscillation);
    assert_relative_eq!(steady.evidence.midline.unwrap(), 0.8, max_relative = 1e-3);
    assert_relative_eq!(steady.evidence.half_height.unwrap(), 0.1, max_relative = 1e-3);
    assert_relative_eq!(steady.evidence.amplitude, 0.9, max_relative = 1e-3);
    let settling = report(&trajectory(&times, |t| 0.8 + 0.1 * (-0.02 * t).exp() * (0.3 * t).sin()));
    assert_eq!(settling.regime, Regime::Drifting);
    let going = report(&trajectory(&times, |t| 0.01 * t + 0.1 * (0.3 * t).sin()));
    assert_eq!(going.regime, Regime::Drifting);
    assert_relative_eq!(going.evidence.drift.value, 0.01, max_relative = 0.1);
}

#[test]
fn overdamped_decay_and_growth() {
    let times = even(100.0, 300);
    for (decay, rate) in [
        (trajectory(&times, |t| 0.3 * (-0.05 * t).exp()), -0.05),
        (trajectory(&times, |t| 0.3 * (-0.05 * t).exp() - 0.2 * (-0.2 * t).exp()), -0.05),
        (trajectory(&times, |t| -0.3 * (-0.05 * t).exp() + 0.6 * (-0.2 * t).exp()), -0.05),
        (trajectory(&times, |t| 1e-3 * (0.03 * t).exp()), 0.03),
    ] {
        let report = report(&decay);
        assert_eq!(report.regime, if rate > 0.0 { Regime::Growing } else { Regime::Decaying }, "{report:?}");
        assert_relative_eq!(report.evidence.growth_rate.unwrap().value, rate, max_relative = 1e-3);
        assert!(report.evidence.period.is_none());
    }
    // Too slow for the record.
    let slow = report(&trajectory(&times, |t| 0.3 * (-0.003 * t).exp()));
    assert_eq!(slow.regime, Regime::Undecided(Doubt::TooShort { periods: 0.0 }));
}

#[test]
fn at_rest_and_starting() {
    let times = even(100.0, 200);
    let with_speeds = |speed: fn(f64) -> f64| {
        let speeds = times.iter().map(|&t| speed(t)).collect();
        report(&Trajectory::new(times.clone(), vec![0.1; 200], speeds).unwrap())
    };
    let stopped = with_speeds(|t| 0.1 * (-0.1 * t).exp());
    assert_eq!(stopped.regime, Regime::AtRest);
    assert!(stopped.evidence.speed < 5e-5 && stopped.evidence.last_height == 0.1);
    assert_eq!(with_speeds(|_| 0.0).regime, Regime::AtRest);
    let starting = with_speeds(|t| 1e-6 * (0.06 * t).exp());
    let Regime::Undecided(Doubt::SpeedingUp { rate }) = starting.regime else { panic!("{starting:?}") };
    assert_relative_eq!(rate, 0.06, max_relative = 1e-9);
    assert_ne!(with_speeds(|_| 0.01).regime, Regime::AtRest);
}

#[test]
fn drifting() {
    let times = even(150.0, 400);
    for (name, drift) in [
        ("to a wall", trajectory(&times, |t| 1.5 * (0.05 * t).tanh())),
        ("to a wall that stops it", trajectory(&times, |t| (-0.03 * t).max(-1.5))),
        ("steadily", trajectory(&times, |t| 0.01 + 0.005 * t)),
        ("towards a height", trajectory(&times, |t| 0.7 - 0.5 * (-0.03 * t).exp())),
        ("along a wall", trajectory(&times, |_| 0.7)),
    ] {
        let report = report(&drift);
        assert_eq!(report.regime, Regime::Drifting, "{name}: {report:?}");
    }
    let steady = report(&trajectory(&times, |t| 0.01 + 0.005 * t));
    assert_relative_eq!(steady.evidence.drift.value, 0.005, max_relative = 1e-9);
    assert_relative_eq!(steady.evidence.last_height, 0.76, max_relative = 1e-9);
    // The same in a hundredth of the time may be anything.
    let short = report(&trajectory(&even(1.5, 400), |t| 0.01 + 0.005 * t));
    assert!(matches!(short.regime, Regime::Undecided(Doubt::TooShort { .. })), "{short:?}");
}

/// Pieces of steady oscillations shorter than a period and a half must not pass for anything else, wherever they start.
#[test]
fn pieces_of_a_limit_cycle() {
    let criteria = RegimeCriteria { transient: 0.0, ..RegimeCriteria::default() };
    let period = 100.0;
    let times: Vec<f64> = (0..1200).map(|i| 0.5 * f64::from(i)).collect();
    let angles: Vec<f64> = times.iter().map(|t| 60.0 + t * TAU / period).collect();
    for mu in [0.0, 0.1, 0.3, 1.0, 2.0] {
        let (heights, rates) = van_der_pol(mu, 2.0, &angles);
        let unknown = Trajectory::new(times.clone(), heights, vec![SPEED; 1200]).unwrap();
        let velocities = rates.iter().map(|v| v * TAU / period).collect();
        let known = unknown.clone().with_lateral_velocities(velocities).unwrap();
        for whole in [&unknown, &known] {
            assert_eq!(whole.regime(&criteria).unwrap().regime, Regime::SteadyOscillation);
            for start in (0..100).step_by(10).map(f64::from) {
                for length in (1..15).map(|i| 10.0 * f64::from(i)) {
                    let found = whole.between(start, start + length).regime(&criteria).unwrap();
                    let right = matches!(found.regime, Regime::Undecided(Doubt::TooShort { .. }));
                    assert!(right, "{mu} {start} {length}: {found:?}");
                }
                let enough = whole.between(start, start + 2.5 * period).regime(&criteria).unwrap();
                assert_eq!(enough.regime, Regime::SteadyOscillation, "{mu} {start}: {enough:?}");
            }
        }
    }
}

#[test]
fn irregular_amplitudes() {
    let times = even(400.0, 1000);
    let beating = report(&trajectory(&times, |t| (0.3 * t).sin() * (1.2 + (0.11 * t).sin())));
    assert!(matches!(beating.regime, Regime::Undecided(Doubt::Irregular { .. })), "{beating:?}");
}

#[test]
fn few_samples() {
    let few = report(&trajectory(&even(10.0, 6), |t| t));
    assert_eq!(few.regime, Regime::Undecided(Doubt::TooFewSamples { found: 5 }));
    let one = report(&trajectory(&[1.0], |t| t));
    assert_eq!(one.regime, Regime::Undecided(Doubt::TooFewSamples { found: 1 }));
    let none = Trajectory::new(Vec::new(), Vec::new(), Vec::new()).unwrap();
    assert!(none.regime(&RegimeCriteria::default()).is_err());
    let criteria = RegimeCriteria { transient: 1.0, ..RegimeCriteria::default() };
    assert!(trajectory(&even(10.0, 20), |t| t).regime(&criteria).is_err());
}

/// Noise of the grid: oscillations of a few thousandths of the amplitude at a much higher frequency, and
/// round-off.
#[test]
fn oscillations_of_the_grid() {
    let mut random = noise(7);
    let times = even(500.0, 1000);
    let growing = report(&trajectory(&times, |t| {
        0.01 * (0.006 * t).exp() * (0.06 * t).sin() + 3e-5 * (11.0 * t).sin() + 1e-12 * random()
    }));
    assert_eq!(growing.regime, Regime::Growing);
    assert_relative_eq!(growing.evidence.growth_rate.unwrap().value, 0.006, max_relative = 0.01);
    assert_relative_eq!(growing.evidence.period.unwrap().value, TAU / 0.06, max_relative = 1e-3);
}

proptest! {
    #[test]
    fn clean_oscillations(per_period in -0.9..0.9f64, phase in 0.0..6.3f64, size in 1e-3..1.0f64,
                          jitter in prop::collection::vec(-0.4..0.4f64, 400)) {
        prop_assume!(per_period.abs() > 0.02);
        // Four periods of 80 after the transient, uneven samples.
        let times: Vec<f64> = jitter.iter().enumerate().map(|(i, j)| i as f64 + j).collect();
        let rate = per_period / 80.0;
        // A turn next to an end of the record is known less well (see `extrema`): there is one every 40, the record
        // begins at 80.
        let turn = ((per_period / TAU).atan() - phase) * 80.0 / TAU;
        prop_assume!((3.0..37.0).contains(&turn.rem_euclid(40.0)));
        let record = trajectory(&times, |t| size * (rate * t).exp() * (TAU * t / 80.0 + phase).cos());
        let report = report(&record);
        prop_assert_eq!(report.regime, if rate > 0.0 { Regime::Growing } else { Regime::Decaying });
        prop_assert!((report.evidence.growth_rate.unwrap().value / rate - 1.0).abs() < 1e-3);
        prop_assert!((report.evidence.period.unwrap().value / 80.0 - 1.0).abs() < 1e-4);
    }
}

/// Few swings whose amplitudes scatter by some per cent are not steady within 1 %, and not known to grow.
#[test]
fn scattering_amplitudes_decide_nothing() {
    let times = even(100.0, 2000);
    let scattering = report(&trajectory(&times, |t| (0.3 * t).sin() * (1.0 + 0.085 * (0.37 * t).cos())));
    let Regime::Undecided(Doubt::Uncertain { change, error }) = scattering.regime else { panic!("{scattering:?}") };
    assert!(error > 0.01 && error < 0.1 && change.abs() < 3.0 * error, "{change} {error}");
    assert!(scattering.regime.to_string().contains("with a standard error of"), "{}", scattering.regime);
    // Over many periods the error falls below the bound.
    let long = report(&trajectory(&even(4000.0, 40_000), |t| (0.3 * t).sin() * (1.0 + 0.085 * (0.37 * t).cos())));
    assert_eq!(long.regime, Regime::SteadyOscillation, "{long:?}");
}
