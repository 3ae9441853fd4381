//! The fold of a bubble in plane extension, of which the shape is an exact ellipse.

use std::f64::consts::PI;

use anyhow::{Context, Result};
use motile::base::{Region, Vec2};
use motile::setup::{DropletSetup, FlowSetup, Setup};
use motile_steady_states::{Continuation, Parameter, SpecialKind, SteadyState};
use motile_tests::validation::Table;

use crate::tables::Measure;

use super::nodes;

/// Viscosity of the bubble over the fluid's.
const RATIO: f64 = 1e-6;
/// Capillary numbers from which and up to which the branch is followed.
const RANGE: [f64; 2] = [0.28, 0.4];
const NODES: [usize; 2] = [128, 160];

/// Complete elliptic integral of the first kind of the modulus k, by the arithmetic-geometric mean.
fn elliptic(k: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - k * k).sqrt());
    for _ in 0..10 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    0.5 * PI / a
}

/// Capillary number of the ellipse of deformation D, D sqrt(1 - D^2) K(D)/pi.
fn capillary(deformation: f64) -> f64 {
    deformation * (1.0 - deformation * deformation).sqrt() * elliptic(deformation) / PI
}

/// Curvature of the tip of an ellipse of deformation D and of the area of a circle of radius 1.
fn tip(deformation: f64) -> f64 {
    ((1.0 + deformation) / (1.0 - deformation)).powf(1.5)
}

/// The largest capillary number, and its deformation, by golden sections.
fn exact() -> [f64; 2] {
    let (mut low, mut high) = (0.5, 0.95);
    let part = 0.5 * (5.0_f64.sqrt() - 1.0);
    while high - low > 1e-10 {
        let (left, right) = (high - part * (high - low), low + part * (high - low));
        if capillary(left) < capillary(right) { low = left } else { high = right }
    }
    let deformation = 0.5 * (low + high);
    [capillary(deformation), deformation]
}

/// Mean distance of neighbouring nodes (length).
fn mean_side(nodes: &[Vec2]) -> f64 {
    let next = nodes.iter().cycle().skip(1);
    nodes.iter().zip(next).map(|(a, b)| (*b - *a).length()).sum::<f64>() / nodes.len() as f64
}

/// Folds at some numbers of nodes, and the exact one.
pub(super) fn bubble() -> Result<Vec<Table>> {
    let header = "nodes | capillary number | D | curvature of the tip | of an ellipse of that D | side over radius of \
        the tip | tail of modes";
    let mut table = Table::new("Fold of a bubble (viscosity ratio 1e-6) in plane extension", header);
    let row = |count: usize| -> Result<String> {
        let droplet = DropletSetup { viscosity: Some(RATIO), ..DropletSetup::passive(1.0) };
        let flow = FlowSetup { extension: RANGE[0], ..FlowSetup::default() };
        let setup = Setup {
            region: Region::Plane,
            viscosity: 1.0,
            flow,
            droplets: vec![droplet],
            method: nodes(count),
            ..Setup::default()
        };
        let start = SteadyState::find(&setup)?;
        let along = Continuation::new(Parameter::ExtensionRate, RANGE[0], RANGE[1]);
        let is_fold = |kind: SpecialKind| kind == SpecialKind::Fold;
        let branch = Continuation { largest_step: 0.1, ..along }
            .follow(&start, |_, special| !special.iter().any(|special| is_fold(special.kind)))?;
        let fold = branch.special.iter().find(|special| is_fold(special.kind)).context("no fold")?;
        let (state, seen) = (&fold.critical.state, fold.critical.state.deformation()?);
        Ok(format!(
            "{:.6} | {:.5} | {:.2} | {:.2} | {:.1} | {:.0e}",
            fold.value,
            seen.by_moments,
            seen.tip_curvature,
            tip(seen.by_moments),
            mean_side(&state.profile().positions) * tip(seen.by_moments),
            state.tail()
        ))
    };
    for count in NODES {
        table.measure(count, || row(count))?;
    }
    table.measure("exact", || {
        let [value, deformation] = exact();
        let curvature = tip(deformation);
        Ok(format!("{value:.6} | {deformation:.5} | {curvature:.2} | {curvature:.2} |  | "))
    })?;
    Ok(vec![table])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// K(0.5) as tabulated, and the fold where the slope of the capillary number is zero.
    #[test]
    fn the_exact_fold_is_a_maximum() {
        assert!((elliptic(0.5) - 1.685_750_354_812_596).abs() < 1e-14);
        let [value, deformation] = exact();
        assert!((value - 0.304_860).abs() < 5e-7 && (deformation - 0.79988).abs() < 5e-6, "{value} {deformation}");
        assert!((tip(deformation) - 26.97).abs() < 5e-3);
        // A round bubble is deformed by twice the capillary number.
        assert!((capillary(1e-4) / 1e-4 - 0.5).abs() < 1e-7);
    }
}
