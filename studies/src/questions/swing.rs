//! How a swimmer in a tube swings where swimming straight is unstable: in a plane or on a helix.

use std::f64::consts::TAU;

use anyhow::{Context, Result};
use motile_cli::run::say;
use motile_tests::validation::Table;
use space_droplets::{
    ContractileTension, EdgeFollowing, RungeKuttaChebyshev, SpaceDroplet, SpaceDroplets, StepSize, Tube,
};

use crate::tables::{Measure, Once};

/// A tube: its radius, and the angular frequency of the instability (docs/tables/steady-tubes.csv), which separates the
/// two circular motions; and the time between samples.
#[derive(Debug, Clone, Copy)]
struct Swing {
    radius: f64,
    frequency: f64,
    sample: f64,
}

const MIDDLE: Swing = Swing { radius: 1.5, frequency: 0.1814, sample: 2.0 };
const NARROW: Swing = Swing { radius: 1.25, frequency: 0.352, sample: 1.0 };
const WIDE: Swing = Swing { radius: 2.0, frequency: 0.0741, sample: 4.0 };

/// A start: name, place across the axis, and gradient of the particles across the axis, over their mean.
type Start = (&'static str, [f64; 2], [f64; 2]);

const STARTS: [Start; 3] = [
    ("nearly in a plane", [0.25, 0.02], [0.03, 0.04]),
    ("on an ellipse", [0.1, 0.02], [0.03, 0.04]),
    ("on a helix", [0.2, 0.0], [0.0, 0.2]),
];

/// Runs in other tubes, or further: degree, start, and how long.
const OTHERS: [(Swing, usize, Start, f64); 7] = [
    (WIDE, 8, ("on an ellipse", [0.4, 0.08], [0.03, 0.04]), 192.0),
    (WIDE, 10, ("on an ellipse", [0.4, 0.08], [0.03, 0.04]), 192.0),
    (WIDE, 10, ("on a helix", [0.6, 0.0], [0.0, 0.2]), 384.0),
    (MIDDLE, 12, ("on a wide helix", [0.3, 0.0], [0.0, 0.2]), 192.0),
    (NARROW, 16, ("on an ellipse", [0.04, 0.008], [0.01, 0.02]), 192.0),
    (NARROW, 16, ("on a helix", [0.06, 0.0], [0.0, 0.05]), 192.0),
    (NARROW, 20, ("on an ellipse", [0.04, 0.008], [0.01, 0.02]), 24.0),
];

/// The two circular motions at a sample.
#[derive(Debug, Clone, Copy)]
struct Sample {
    /// Squares of the amplitudes.
    amplitudes: [f64; 2],
    /// Gap to the wall (R0).
    gap: f64,
}

impl Swing {
    fn samples(self, degree: usize, &(_, place, slope): &Start, until: f64) -> Result<Vec<Sample>> {
        let law = ContractileTension::thesis(10.0, -2.0, 4.0, 100.0)?;
        // The shape of the straight swimmer, nearly.
        let shape = |s: [f64; 3]| [1.02 * s[0], 1.02 * s[1], s[2] / (1.02 * 1.02)];
        let particles = |s: [f64; 3]| 100.0 * (1.0 + 0.9 * s[2] + slope[0] * s[0] + slope[1] * s[1]);
        let droplet = SpaceDroplet::shaped(degree, shape, [100.0; 2], law)?.with_particles(0.1, particles)?;
        let droplet = droplet.with_edge_following(EdgeFollowing { strength: 1.5, time: 4.0 })?;
        let droplet = droplet.with_position([place[0], place[1], 0.0])?;
        let tube = Tube::new(self.radius)?.with_tolerance(1e-5)?;
        let mut droplet = SpaceDroplets::new(vec![droplet])?.with_surroundings(tube)?;
        let (mut found, mut integrator) = (Vec::new(), RungeKuttaChebyshev::new());
        for sample in 1..=(until / self.sample).round() as usize {
            let steps = StepSize::Adaptive { tolerance: 1e-2 };
            let moved = droplet.advance(sample as f64 * self.sample, steps, &mut integrator, |_| {});
            if let Err(error) = moved {
                // A gap that is not resolved ends the run, but what came before counts.
                say(error);
                break;
            }
            let seen = droplet.observe(0)?;
            let ([x, y, _], [u, v, _]) = (seen.position, seen.velocity);
            // Of z = a exp(i w t) + b exp(-i w t), the parts are z -+ i z'/w over 2.
            let part = |sign: f64| {
                let (re, im) = (x + sign * v / self.frequency, y - sign * u / self.frequency);
                0.25 * (re * re + im * im)
            };
            let gap = droplet.smallest_gap(0)?.unwrap_or(f64::NAN);
            found.push(Sample { amplitudes: [part(1.0), part(-1.0)], gap });
        }
        Ok(found)
    }

    /// Amplitude and sense, from means over the half period before a time, and the smallest gap so far.
    fn measured(self, found: &[Sample], time: f64) -> Option<(f64, f64, f64)> {
        let end = (time / self.sample).round() as usize;
        let count = ((0.5 * TAU / self.frequency / self.sample).round() as usize).min(end);
        let part = found.get(end - count..end)?;
        let mean = |i: usize| part.iter().map(|sample| sample.amplitudes[i]).sum::<f64>() / count as f64;
        let [left, right] = [mean(0), mean(1)];
        let gap = found[..end].iter().map(|sample| sample.gap).fold(f64::INFINITY, f64::min);
        Some(((left + right).sqrt(), (left - right).abs() / (left + right), gap))
    }
}

/// Amplitude and sense of the swing.
pub(super) fn swing() -> Result<Vec<Table>> {
    let header = "degree | start | time | amplitude | sense";
    let mut table = Table::new("Swimmers of activity -2 and A = 4 in a tube of radius 1.5", header);
    for (degree, until) in [(8, 64.0), (10, 48.0)] {
        for start in &STARTS {
            let found = Once::new();
            for part in 2..=4 {
                let time = 0.25 * until * f64::from(part);
                table.measure(format_args!("{degree} | {} | {time}", start.0), || {
                    let found = found.get(|| MIDDLE.samples(degree, start, until))?;
                    let (amplitude, sense, _) = MIDDLE.measured(found, time).context("the run ended early")?;
                    Ok(format!("{amplitude:.3} | {sense:.2}"))
                })?;
            }
        }
    }
    Ok(vec![table])
}

/// Swings in tubes of other radii, and for longer.
pub(super) fn tubes() -> Result<Vec<Table>> {
    let header = "radius | degree | start | time | amplitude | sense | smallest gap";
    let mut table = Table::new("Swimmers of activity -2 and A = 4 that swing in tubes", header);
    for (tube, degree, start, until) in OTHERS {
        let found = Once::new();
        for part in 1..=4 {
            let time = 0.25 * until * f64::from(part);
            table.measure(format_args!("{} | {degree} | {} | {time}", tube.radius, start.0), || {
                let cells = tube.measured(found.get(|| tube.samples(degree, &start, until))?, time);
                let ended = "not resolved |  | ".to_owned();
                Ok(cells.map_or(ended, |(amplitude, sense, gap)| format!("{amplitude:.3} | {sense:.2} | {gap:.3}")))
            })?;
        }
    }
    Ok(vec![table])
}
