//! Memory of a droplet, and whether high degrees are right.

use allocation_counter::measure;
use anyhow::{Context, Result};
use motile_tests::validation::Table;
use space_droplets::{ContractileTension, ExcludedVolume, Midpoint, SpaceDroplet, StepSize};

use crate::tables::Measure;

/// Length of the step (time).
const STEP: f64 = 1e-3;

/// A sphere with a linear tension, whose speed is known.
fn sphere(degree: usize, inside: f64) -> Result<SpaceDroplet> {
    let law = ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0)?;
    Ok(SpaceDroplet::sphere(degree, 1.0, [inside, 1.0], law)?.with_particles(0.1, |s| 1.0 + 0.6 * s[0] + 0.8 * s[2])?)
}

/// Largest memory of a droplet with its flow, and errors of the speed before and after a step.
pub(super) fn memory() -> Result<Table> {
    let header = "degree | viscosity ratio | MB | error of the speed | change in a step";
    let mut table = Table::new("Memory of a droplet without symmetry", header);
    for (degree, inside) in [16, 32, 48].into_iter().flat_map(|degree| [(degree, 1.0), (degree, 10.0)]) {
        table.measure(format_args!("{degree} | {inside}"), || {
            let mut made = None;
            let counted = measure(|| {
                made = Some(sphere(degree, inside).and_then(|mut droplet| Ok((droplet.observe()?.speed, droplet))));
            });
            let (speed, mut droplet) = made.context("no droplet")??;
            let exact = 1.0 / (3.0 * (2.0 + 3.0 * inside));
            droplet.advance(STEP, StepSize::Fixed(STEP), &mut Midpoint::default(), |_| {})?;
            let change = droplet.observe()?.speed / speed - 1.0;
            let megabytes = counted.bytes_max as f64 / 1e6;
            Ok(format!("{megabytes:.0} | {:.0e} | {change:.2e}", (speed / exact - 1.0).abs()))
        })?;
    }
    Ok(table)
}
