//! Steady swimmers against the reference, and what they cost.

use std::collections::HashMap;
use std::hint::black_box;
use std::time::Instant;

use anyhow::{Context, Result};
use motile::stokes_grid::Drive;
use motile::{Built, DropletSetup, Region, Setup};
use steady_states::{Complex64, SteadyState, Symmetry};

use super::{channel, head, nodes, row};

/// Nodes of the tables.
const NODES: [usize; 4] = [72, 96, 128, 160];

type Row = HashMap<String, String>;

fn rows(file: &str) -> Result<Vec<Row>> {
    let path = format!("{}/../tests/reference/{file}", env!("CARGO_MANIFEST_DIR"));
    let mut table = csv::ReaderBuilder::new().comment(Some(b'#')).from_path(&path).context(path)?;
    Ok(table.deserialize().collect::<Result<_, _>>()?)
}

fn number(row: &Row, name: &str) -> Result<f64> {
    Ok(row.get(name).with_context(|| format!("no column {name}"))?.parse()?)
}

/// The scenes of the reference with their names and rows.
fn scenes() -> Result<Vec<(String, Setup, Row)>> {
    let mut scenes = Vec::new();
    for file in ["steady_swimmer_box6.csv", "steady_swimmer_contrast_box6.csv"] {
        for row in rows(file)? {
            let (activity, inside, outside) =
                (number(&row, "zeta_dmu")?, number(&row, "eta_in")?, number(&row, "eta_ext")?);
            let droplet = DropletSetup::contractile(activity, number(&row, "A_over_zeta")? * activity.abs());
            let droplets = vec![DropletSetup { viscosity: Some(inside), ..droplet }];
            let name = format!("box 6, {activity}, viscosities {inside}/{outside}");
            scenes.push((name, Setup { viscosity: outside, droplets, ..Setup::default() }, row));
        }
    }
    for row in rows("channel_steady_swimmer.csv")? {
        let (width, activity) = (number(&row, "w")?, number(&row, "zeta_dmu")?);
        let setup = channel(number(&row, "l")?, width, activity, number(&row, "A")?, 72);
        scenes.push((format!("channel {width}, {activity}"), setup, row));
    }
    Ok(scenes)
}

/// Errors, residuals and seconds at each number of nodes; beside them those of a run.
pub(super) fn swimmers() -> Result<()> {
    head(&["swimmer", "nodes", "speed", "stresslet", "aspect ratio", "c max", "residual", "condition", "seconds"]);
    for (name, setup, reference) in scenes()? {
        let stresslet = if reference.contains_key("Sxx_f") { "Sxx_f" } else { "Sxx" };
        for count in NODES {
            let started = Instant::now();
            let state = SteadyState::find(&Setup { method: nodes(count), ..setup.clone() })?;
            let seconds = started.elapsed().as_secs_f64();
            let seen = state.measured()?;
            let mut cells = vec![name.clone(), count.to_string()];
            let values = [seen.speed, seen.stresslet, seen.aspect_ratio, seen.concentration[0]];
            for (value, column) in values.into_iter().zip(["speed", stresslet, "AR_mom", "cmax"]) {
                cells.push(format!("{:.0e}", (value / number(&reference, column)? - 1.0).abs()));
            }
            cells.extend([format!("{:.0e}", state.residual()), format!("{:.0e}", state.condition())]);
            cells.push(format!("{seconds:.2}"));
            row(&cells);
        }
    }
    // A run of the first scene, for comparison.
    let (name, setup, reference) = scenes()?.swap_remove(0);
    let Built { mut scene, droplets, .. } = setup.build()?;
    let started = Instant::now();
    for end in [40.0, 80.0, 160.0] {
        scene.run(end).go()?;
        let error = (scene.observe(droplets[0])?.speed() / number(&reference, "speed")? - 1.0).abs();
        let seconds = started.elapsed().as_secs_f64();
        row(&[format!("{name}, run to {end}"), "72/288".into(), format!("{error:.0e}"), format!("{seconds:.1} s")]);
    }
    Ok(())
}

/// Growth rates of swings in a channel of width 5.
pub(super) fn lateral() -> Result<()> {
    head(&["activity", "drive", "nodes", "growth rate", "error", "frequency", "error"]);
    for reference in rows("channel_lateral_stability.csv")? {
        let activity = number(&reference, "zeta_dmu")?;
        let mut setup = channel(12.0, 5.0, activity, number(&reference, "A")?, 72);
        let closed = reference.get("conv").is_some_and(|conv| conv == "q0");
        if closed {
            setup.region = Region::Channel { length: 12.0, width: 5.0, drive: Drive::ZeroFlux };
        }
        for count in NODES {
            let spectrum = SteadyState::find(&Setup { method: nodes(count), ..setup.clone() })?.spectrum()?;
            let swing = spectrum.of(Symmetry::Antisymmetric).find(|z| z.im > 0.0).unwrap_or(Complex64::ZERO);
            let error = |value: f64, name: &str| -> Result<String> {
                Ok(format!("{:.0e}", (value / number(&reference, name)? - 1.0).abs()))
            };
            row(&[
                activity.to_string(),
                if closed { "zero flux" } else { "zero gradient" }.into(),
                count.to_string(),
                format!("{:.7}", swing.re),
                error(swing.re, "growth")?,
                format!("{:.6}", swing.im),
                error(swing.im, "freq")?,
            ]);
        }
    }
    Ok(())
}

/// Seconds of a state and its spectrum over the nodes.
pub(super) fn cost() -> Result<()> {
    head(&["nodes", "state from nothing (s)", "state from a neighbour (s)", "spectrum (s)", "Jacobian (MB)"]);
    for count in [48, 72, 96, 128, 160, 192] {
        let setup = channel(12.0, 3.0, -2.0, 10.0, count);
        let started = Instant::now();
        let state = SteadyState::find(&setup)?;
        let first = started.elapsed().as_secs_f64();
        let started = Instant::now();
        black_box(state.at(steady_states::Parameter::Activity, -2.05)?);
        let neighbour = started.elapsed().as_secs_f64();
        let started = Instant::now();
        black_box(state.spectrum()?);
        let spectrum = started.elapsed().as_secs_f64();
        let memory = 8e-6 * (count * count) as f64;
        let cells = [first, neighbour, spectrum, memory].map(|value| format!("{value:.2}"));
        row(&[vec![count.to_string()], cells.to_vec()].concat());
    }
    Ok(())
}
