//! Steady swimmers against the reference, and what they cost.

use std::collections::HashMap;
use std::hint::black_box;
use std::time::Instant;

use anyhow::{Context, Result};
use motile::base::Drive;
use motile::base::Region;
use motile::setup::{Built, DropletSetup, Setup};
use motile_steady_states::{Complex64, Continuation, Cost, Parameter, SteadyState, Symmetry};
use motile_tests::validation::Table;

use super::{channel, nodes};

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

/// Errors, residuals and seconds at each number of nodes; then those of runs.
pub(super) fn swimmers() -> Result<Vec<Table>> {
    let header =
        ["swimmer", "nodes", "speed", "stresslet", "aspect ratio", "c max", "residual", "condition", "seconds"];
    let mut table = Table::new("Steady swimmers: relative errors", &header);
    for (name, setup, reference) in scenes()? {
        let stresslet = if reference.contains_key("Sxx_f") { "Sxx_f" } else { "Sxx" };
        for count in NODES {
            let (state, seconds) = timed(|| Ok(SteadyState::find(&Setup { method: nodes(count), ..setup.clone() })?))?;
            let seen = state.measured()?;
            let mut cells = vec![name.clone(), count.to_string()];
            let values = [seen.speed, seen.stresslet, seen.aspect_ratio, seen.concentration[0]];
            for (value, column) in values.into_iter().zip(["speed", stresslet, "AR_mom", "cmax"]) {
                cells.push(format!("{:.0e}", (value / number(&reference, column)? - 1.0).abs()));
            }
            cells.extend([format!("{:.0e}", state.residual()), format!("{:.0e}", state.condition())]);
            cells.push(format!("{seconds:.2}"));
            table.push(cells);
        }
    }
    Ok(vec![table, beside_runs()?])
}

/// Cost of an error of the speed of 1e-4 by a state of 48 nodes, from nothing and from its neighbour at an activity
/// of -2.05, and by a run of 72 nodes and 288 cells, by turns.
fn beside_runs() -> Result<Table> {
    let header = [
        "swimmer",
        "error of the state",
        "from nothing (s)",
        "from a neighbour (s)",
        "run to",
        "its error",
        "run (s)",
        "run/from nothing",
        "run/from a neighbour",
    ];
    let mut table = Table::new("A state of 48 nodes beside a run of 72/288", &header);
    for (name, setup, reference) in scenes()? {
        if number(&reference, if reference.contains_key("zeta_dmu") { "zeta_dmu" } else { "activity" })? != -2.0 {
            continue;
        }
        let error = |speed: f64| anyhow::Ok((speed / number(&reference, "speed")? - 1.0).abs());
        let coarse = Setup { method: nodes(48), ..setup.clone() };
        let (mut seconds, mut ours) = ([0.0; 2], f64::NAN);
        let mut states = || -> Result<()> {
            let (state, first) = timed(|| Ok(SteadyState::find(&coarse)?))?;
            let neighbour = state.at(Parameter::Activity, -2.05)?;
            let (state, second) = timed(|| Ok(neighbour.at(Parameter::Activity, -2.0)?))?;
            ours = error(state.measured()?.speed)?;
            seconds = [seconds[0] + 0.5 * first, seconds[1] + 0.5 * second];
            Ok(())
        };
        states()?;
        let Built { mut scene, droplets, .. } = Setup { method: nodes(72), ..setup }.build()?;
        let (mut end, mut left, mut run) = (0.0, f64::INFINITY, 0.0);
        while left > 1e-4 && end < 400.0 {
            end += 20.0;
            run += timed(|| Ok(scene.run(end).go()?))?.1;
            left = error(scene.observe(droplets[0])?.speed())?;
        }
        states()?;
        let [ours, theirs] = [ours, left].map(|error| format!("{error:.0e}"));
        let [first, second] = seconds.map(|seconds| format!("{seconds:.3}"));
        let [over_first, over_second] = seconds.map(|seconds| format!("{:.0}", run / seconds));
        let run = format!("{run:.1}");
        table.push([name, ours, first, second, end.to_string(), theirs, run, over_first, over_second]);
    }
    Ok(table)
}

fn timed<T>(work: impl FnOnce() -> Result<T>) -> Result<(T, f64)> {
    let started = Instant::now();
    let value = work()?;
    Ok((value, started.elapsed().as_secs_f64()))
}

/// Growth rates of swings in a channel of width 5.
pub(super) fn lateral() -> Result<Vec<Table>> {
    let header = ["activity", "drive", "nodes", "growth rate", "error", "frequency", "error of the frequency"];
    let mut table = Table::new("Swings across a channel of width 5: l = 12, A = 10", &header);
    for reference in rows("channel_lateral_stability.csv")? {
        let activity = number(&reference, "zeta_dmu")?;
        let mut setup = channel(12.0, 5.0, activity, number(&reference, "A")?, 72);
        let closed = reference.get("conv").is_some_and(|conv| conv == "q0");
        if closed {
            setup.region = Region::Channel { length: 12.0, width: 5.0, drive: Drive::ZeroFlux };
        }
        let mut push = |how: String, swing: Complex64| -> Result<()> {
            let error = |value: f64, name: &str| -> Result<String> {
                Ok(format!("{:.0e}", (value / number(&reference, name)? - 1.0).abs()))
            };
            table.push([
                activity.to_string(),
                if closed { "zero flux" } else { "zero gradient" }.into(),
                how,
                format!("{:.7}", swing.re),
                error(swing.re, "growth")?,
                format!("{:.6}", swing.im),
                error(swing.im, "freq")?,
            ]);
            Ok(())
        };
        for count in NODES {
            let spectrum = SteadyState::find(&Setup { method: nodes(count), ..setup.clone() })?.spectrum()?;
            let swing = spectrum.of(Symmetry::Antisymmetric).find(|z| z.im > 0.0).unwrap_or(Complex64::ZERO);
            push(count.to_string(), swing)?;
        }
        if activity < -3.0 {
            for count in [48, 72, 108] {
                let run = fitted(&Setup { method: nodes(count), ..setup.clone() })?;
                push(format!("a run of {count}/{}", 4 * count), run)?;
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

/// Seconds of a state and its spectrum over the nodes, points of a branch per second, memory.
pub(super) fn cost() -> Result<Vec<Table>> {
    let header = [
        "nodes",
        "unknowns",
        "state from nothing (s)",
        "from a neighbour (s)",
        "Jacobian (s)",
        "LU (s)",
        "eigenvalues (s)",
        "spectrum (s)",
        "points of a branch per second",
        "largest memory of the program (MB)",
    ];
    let mut table = Table::new("Cost: channel of width 3, activity -2", &header);
    for count in [48, 72, 96, 128, 160, 192] {
        let setup = channel(12.0, 3.0, -2.0, 10.0, count);
        let (state, first) = timed(|| Ok(SteadyState::find(&setup)?))?;
        let (_, neighbour) = timed(|| Ok(black_box(state.at(Parameter::Activity, -2.05)?)))?;
        let (_, spectrum) = timed(|| Ok(black_box(state.spectrum()?)))?;
        let settings = Continuation { most_points: 6, ..Continuation::new(Parameter::Activity, -2.0, -3.0) };
        let (branch, followed) = timed(|| Ok(settings.follow(&state, |_, _| true)?))?;
        let Cost { jacobian, factorisation, eigenvalues, unknowns, .. } = state.cost()?;
        let rate = branch.points.len() as f64 / followed;
        let parts = [first, neighbour, jacobian, factorisation, eigenvalues, spectrum, rate];
        let cells = parts.map(|value| if value < 0.01 { format!("{value:.1e}") } else { format!("{value:.3}") });
        table.push([vec![count.to_string(), unknowns.to_string()], cells.to_vec(), vec![memory()]].concat());
    }
    Ok(vec![table])
}

/// Most memory that this process has had (MB), where the system tells.
fn memory() -> String {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let kilobytes =
        status.lines().find_map(|line| line.strip_prefix("VmHWM:")?.split_whitespace().next()?.parse().ok());
    kilobytes.map_or_else(String::new, |value: f64| format!("{:.0}", 1e-3 * value))
}
