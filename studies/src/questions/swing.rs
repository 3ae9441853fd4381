//! How a swimmer in a tube swings where swimming straight is unstable: in a plane or on a helix.

use std::f64::consts::TAU;

use anyhow::Result;
use motile_tests::validation::Table;
use space_droplets::{ContractileTension, EdgeFollowing, RungeKuttaChebyshev, SpaceDroplet, StepSize, Tube};

use crate::tables::Measure;

/// Time between samples.
const SAMPLE: f64 = 2.0;
/// Angular frequency of the instability (docs/tables/steady-tubes.csv), which separates the two circular motions.
const FREQUENCY: f64 = 0.1814;
const RADIUS: f64 = 1.5;

/// A start: name, place across the axis, and gradient of the particles across the axis, over their mean.
type Start = (&'static str, [f64; 2], [f64; 2]);

const STARTS: [Start; 3] = [
    ("nearly in a plane", [0.25, 0.02], [0.03, 0.04]),
    ("on an ellipse", [0.1, 0.02], [0.03, 0.04]),
    ("on a helix", [0.2, 0.0], [0.0, 0.2]),
];

/// Squares of the amplitudes of the two circular motions, at each sample.
fn amplitudes(degree: usize, &(_, place, slope): &Start, until: f64) -> Result<Vec<[f64; 2]>> {
    let law = ContractileTension::thesis(10.0, -2.0, 4.0, 100.0)?;
    // The shape of the straight swimmer, nearly.
    let shape = |s: [f64; 3]| [1.02 * s[0], 1.02 * s[1], s[2] / (1.02 * 1.02)];
    let particles = |s: [f64; 3]| 100.0 * (1.0 + 0.9 * s[2] + slope[0] * s[0] + slope[1] * s[1]);
    let droplet = SpaceDroplet::shaped(degree, shape, [100.0; 2], law)?.with_particles(0.1, particles)?;
    let droplet = droplet.with_edge_following(EdgeFollowing { strength: 1.5, time: 4.0 })?;
    let droplet = droplet.with_position([place[0], place[1], 0.0])?;
    let mut droplet = droplet.with_surroundings(Tube::new(RADIUS)?.with_tolerance(1e-5)?)?;
    let (mut found, mut integrator) = (Vec::new(), RungeKuttaChebyshev::new());
    for sample in 1..=(until / SAMPLE).round() as usize {
        let steps = StepSize::Adaptive { tolerance: 1e-2 };
        droplet.advance(sample as f64 * SAMPLE, steps, &mut integrator, |_| {})?;
        let seen = droplet.observe()?;
        let ([x, y, _], [u, v, _]) = (seen.position, seen.velocity);
        // Of z = a exp(i w t) + b exp(-i w t), the parts are z -+ i z'/w over 2.
        let part = |sign: f64| {
            let (re, im) = (x + sign * v / FREQUENCY, y - sign * u / FREQUENCY);
            0.25 * (re * re + im * im)
        };
        found.push([part(1.0), part(-1.0)]);
    }
    Ok(found)
}

/// Means over the half period before a sample.
fn mean(found: &[[f64; 2]], end: usize) -> [f64; 2] {
    let count = ((0.5 * TAU / FREQUENCY / SAMPLE).round() as usize).min(end);
    let sum = |i: usize| found[end - count..end].iter().map(|pair| pair[i]).sum::<f64>();
    [0, 1].map(|i| sum(i) / count as f64)
}

/// Amplitude and sense of the swing.
pub(super) fn swing() -> Result<Vec<Table>> {
    let header = "degree | start | time | amplitude | sense";
    let mut table = Table::new("Swimmers of activity -2 and A = 4 in a tube of radius 1.5", header);
    for (degree, until) in [(8, 64.0), (10, 48.0)] {
        for start in &STARTS {
            let name = start.0;
            let mut found = Vec::new();
            for part in 2..=4 {
                let time = 0.25 * until * f64::from(part);
                table.measure(format_args!("{degree} | {name} | {time}"), || {
                    if found.is_empty() {
                        found = amplitudes(degree, start, until)?;
                    }
                    let [left, right] = mean(&found, (time / SAMPLE).round() as usize);
                    Ok(format!("{:.3} | {:.2}", (left + right).sqrt(), (left - right).abs() / (left + right)))
                })?;
            }
        }
    }
    Ok(vec![table])
}
