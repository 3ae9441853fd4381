//! Steady swimmers against the reference.

use anyhow::Result;
use motile::base::Drive;
use motile::base::Region;
use motile::setup::{Built, DropletSetup, Setup};
use motile_steady_states::{Complex64, SteadyState, Symmetry};
use motile_tests::validation::{Reference, Table};

use super::{channel, nodes};
use crate::tables::Measure;

/// Nodes of the tables.
const NODES: [usize; 4] = [72, 96, 128, 160];

/// The scenes of the reference with their names and rows.
fn scenes() -> Result<Vec<(String, Setup, Reference)>> {
    let mut scenes = Vec::new();
    for file in ["steady_swimmer_box6", "steady_swimmer_contrast_box6"] {
        for row in Reference::read(file)?.rows() {
            let (activity, inside, outside) = (row.value("zeta_dmu")?, row.value("eta_in")?, row.value("eta_ext")?);
            let droplet = DropletSetup::contractile(activity, row.value("A_over_zeta")? * activity.abs());
            let droplets = vec![DropletSetup { viscosity: Some(inside), ..droplet }];
            let name = format!("box 6, {activity}, viscosities {inside}/{outside}");
            scenes.push((name, Setup { viscosity: outside, droplets, ..Setup::default() }, row));
        }
    }
    for row in Reference::read("channel_steady_swimmer")?.rows() {
        let (width, activity) = (row.value("w")?, row.value("zeta_dmu")?);
        let setup = channel(row.value("l")?, width, activity, row.value("A")?, 72);
        scenes.push((format!("channel {width}, {activity}"), setup, row));
    }
    Ok(scenes)
}

/// Errors at each number of nodes.
pub(super) fn swimmers() -> Result<Vec<Table>> {
    let header = "swimmer | nodes | speed | stresslet | aspect ratio | c max";
    let mut table = Table::new("Steady swimmers: relative errors", header);
    for (name, setup, reference) in scenes()? {
        let stresslet = if reference.value("Sxx_f").is_ok() { "Sxx_f" } else { "Sxx" };
        for count in NODES {
            table.measure(format_args!("{name} | {count}"), || {
                let seen = SteadyState::find(&Setup { method: nodes(count), ..setup.clone() })?.measured()?;
                let values = [seen.speed, seen.stresslet, seen.aspect_ratio, seen.concentration[0]];
                let errors = values
                    .into_iter()
                    .zip(["speed", stresslet, "AR_mom", "cmax"])
                    .map(|(value, column)| Ok(format!("{:.0e}", (value / reference.value(column)? - 1.0).abs())));
                Ok(errors.collect::<Result<Vec<_>>>()?.join(" | "))
            })?;
        }
    }
    Ok(vec![table])
}

/// Growth rates of swings in a channel of width 5.
pub(super) fn lateral() -> Result<Vec<Table>> {
    let header = "activity | drive | nodes | growth rate | error | frequency | error of the frequency";
    let mut table = Table::new("Swings across a channel of width 5: l = 12, A = 10", header);
    for reference in Reference::read("channel_lateral_stability")?.rows() {
        let activity = reference.value("zeta_dmu")?;
        let mut setup = channel(12.0, 5.0, activity, reference.value("A")?, 72);
        let closed = reference.clone().select("conv", "q0").value("growth").is_ok();
        if closed {
            setup.region = Region::Channel { length: 12.0, width: 5.0, drive: Drive::ZeroFlux };
        }
        let cells = |swing: Complex64| -> Result<String> {
            let error = |value: f64, name: &str| -> Result<String> {
                Ok(format!("{:.0e}", (value / reference.value(name)? - 1.0).abs()))
            };
            let errors = [error(swing.re, "growth")?, error(swing.im, "freq")?];
            Ok(format!("{:.7} | {} | {:.6} | {}", swing.re, errors[0], swing.im, errors[1]))
        };
        let drive = if closed { "zero flux" } else { "zero gradient" };
        for count in NODES {
            table.measure(format_args!("{activity} | {drive} | {count}"), || {
                let spectrum = SteadyState::find(&Setup { method: nodes(count), ..setup.clone() })?.spectrum()?;
                cells(spectrum.of(Symmetry::Antisymmetric).find(|z| z.im > 0.0).unwrap_or(Complex64::ZERO))
            })?;
        }
        if activity < -3.0 {
            for count in [48, 72, 108] {
                table.measure(format_args!("{activity} | {drive} | a run of {count}/{}", 4 * count), || {
                    cells(fitted(&Setup { method: nodes(count), ..setup.clone() })?)
                })?;
            }
        }
    }
    Ok(vec![table])
}

/// Growth rate and frequency of the small swings of a run, from least squares of y(t + 2h) + p y(t + h) + q y(t) = 0.
fn fitted(setup: &Setup) -> Result<Complex64> {
    let mut setup = setup.clone();
    setup.droplets[0].centre[1] = 5e-3;
    let Built { mut scene, droplets, .. } = setup.build()?;
    let mut heights = Vec::new();
    for k in 0..=STEPS {
        scene.run(FIRST + SPACING * k as f64).go()?;
        heights.push(scene.observe(droplets[0])?.centroid.y);
    }
    let (mut aa, mut ab, mut bb, mut ay, mut by) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for three in heights.windows(2 * LAG + 1) {
        let (a, b, y) = (three[LAG], three[0], -three[2 * LAG]);
        (aa, ab, bb, ay, by) = (aa + a * a, ab + a * b, bb + b * b, ay + a * y, by + b * y);
    }
    let determinant = aa * bb - ab * ab;
    let (p, q) = ((ay * bb - by * ab) / determinant, (by * aa - ay * ab) / determinant);
    let root = Complex64::new(-0.5 * p, (q - 0.25 * p * p).max(0.0).sqrt());
    Ok(root.ln() / (SPACING * LAG as f64))
}

/// Samples of a run: the first time, their spacing, their number, and how many a lag is.
const FIRST: f64 = 60.0;
const SPACING: f64 = 2.0;
const STEPS: usize = 100;
const LAG: usize = 12;
