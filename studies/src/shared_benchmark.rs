//! A relaxing ellipse by motile and by IB2d, another immersed boundary code: error and cost side by side.
//!
//! `cargo run --release -p studies -- shared_benchmark` runs motile; with `--ib2d FOLDER`, a clone of IB2d, its Python
//! version runs the same in the same minutes (`studies/ib2d/relaxing_ellipse.py`, which needs numpy, scipy, numba,
//! matplotlib and, for its fast transforms, pyfftw). The ellipse (1.3 cos t, sin(t)/1.3) with tension 1 and viscosity 1
//! relaxes in a box of 6 x 6 to t = 2; the aspect ratio by the moments of area is compared with that of an independent
//! boundary-integral computation in `tests/reference`.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail, ensure};
use clap::Args;
use motile_tests::validation::interfaces::relax;
use motile_tests::validation::{Reference, Table, relaxation};
use motile_timing::median;

use crate::tables::{self, Measure, all_wanted, note};
use crate::work_precision::cost::processor_time;

/// A relaxing ellipse by motile and by IB2d.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Clone of IB2d; without it only motile runs
    #[arg(long, value_name = "FOLDER")]
    ib2d: Option<PathBuf>,
    /// Python with what IB2d needs
    #[arg(long, value_name = "FILE", default_value = "python3")]
    python: PathBuf,
    #[command(flatten)]
    keep: tables::Keep,
}

/// Cells of the box along a side and step of IB2d. Longer steps than the first of each are as accurate, shorter ones
/// too.
const IB2D: [(usize, f64); 5] = [(32, 0.0625), (64, 0.0625), (64, 0.0078125), (128, 0.03125), (256, 0.015625)];
/// Density for IB2d, which has inertia: ten times as much changes the aspect ratio by 1e-4, a tenth by 1e-5.
const DENSITY: f64 = 0.001;
/// Grid spacing and step of motile by a grid; nodes, markers and step by boundary integrals.
const GRID: [(f64, f64); 3] = [(0.2, 0.1), (0.1, 0.05), (0.05, 0.05)];
const INTEGRALS: [(usize, usize, f64); 3] = [(16, 64, 0.1), (32, 128, 0.05), (48, 256, 0.01)];
/// Time of the comparison.
const END: f64 = 2.0;
/// Repetitions, of which the median time counts, and processor time that is measured at least (seconds).
const REPETITIONS: usize = 5;
const LONG: f64 = 0.1;

/// How the table is made.
const COMMAND: &str = "shared_benchmark --ib2d FOLDER";

/// Result of a run: aspect ratio less that of the reference, relative change of the area, seconds.
type Found = [f64; 3];
/// Code, settings, and what runs them.
type Run = (&'static str, String, Box<dyn Fn() -> Result<Found>>);

pub(crate) fn run(flags: &Flags) -> Result<()> {
    let columns = "code | settings | error of the aspect ratio in % | change of the area in % | seconds";
    let title = "Relaxing ellipse by motile and by IB2d: processor time, medians of five runs by turns";
    let reference = Reference::read("ellipse_relaxation_box6")?.select("eta_in", "1").select("t", "2");
    let expected = reference.value("AR_moment")?;
    let mut runs: Vec<Run> = Vec::new();
    for (nodes, markers, dt) in INTEGRALS {
        let settings = format!("{nodes} nodes, {markers} markers, dt = {dt}");
        runs.push((
            "motile, boundary integrals",
            settings,
            Box::new(move || {
                let (found, seconds) = timed(|| relax(1, nodes, markers, dt))?;
                Ok([found.aspect_ratio, found.area_change, seconds])
            }),
        ));
    }
    for (h, dt) in GRID {
        runs.push((
            "motile, grid",
            format!("{0} x {0} cells, dt = {dt}", (6.0 / h).round()),
            Box::new(move || {
                let (found, seconds) = timed(|| relaxation::run(h, dt))?;
                Ok([found.aspect_ratio_error, found.area_change, seconds])
            }),
        ));
    }
    if let Some(folder) = flags.ib2d.as_ref().filter(|_| all_wanted()) {
        let code = folder.join("pyIB2d/IBM_Blackbox");
        ensure!(code.is_dir(), "--ib2d {}: there is no {}: give a clone of IB2d", folder.display(), code.display());
    }
    for (cells, dt) in IB2D {
        let Some(folder) = flags.ib2d.clone() else { continue };
        let python = flags.python.clone();
        runs.push((
            "IB2d",
            format!("{cells} x {cells} cells, dt = {dt}"),
            Box::new(move || {
                let [ratio, area, seconds] = ib2d(&python, &folder, cells, dt)?;
                Ok([ratio - expected, area - 1.0, seconds])
            }),
        ));
    }
    let mut table = Table::new(title, columns);
    let per_cent = |value: f64| format!("{:.1e}", 100.0 * value);
    let cells = |[error, area, _]: Found| format!("{} | {}", per_cent(error / expected), per_cent(area));
    if !all_wanted() {
        for (code, settings, run) in &runs {
            table.measure(format_args!("{code} | {settings}"), || Ok(cells(run()?) + " | "))?;
        }
        return flags.keep.tables("shared-benchmark", COMMAND, &[table]);
    }
    // By turns, so that what else the machine does meets all alike.
    let mut found = vec![Vec::new(); runs.len()];
    for _ in 0..REPETITIONS {
        for (found, (code, settings, run)) in found.iter_mut().zip(&runs) {
            // Python is not on every machine.
            match code.starts_with("motile") {
                true => found.push(note(&table, &format!("{code} | {settings}"), run)?),
                false => found.push(run()?),
            }
        }
    }
    for (found, (code, settings, _)) in found.iter().zip(&runs) {
        let seconds = median(&mut found.iter().map(|found| found[2]).collect::<Vec<_>>());
        table.row(format_args!("{code} | {settings} | {} | {seconds:.2e}", cells(found[0])));
    }
    flags.keep.tables("shared-benchmark", COMMAND, &[table])
}

/// Result of a run, and its processor time (seconds), which is too coarse a clock for a single short run.
fn timed<T>(run: impl Fn() -> Result<T>) -> Result<(T, f64)> {
    let clock = || processor_time().context("no clock of the processor's time");
    let start = clock()?;
    for count in 1.. {
        let found = run()?;
        let seconds = clock()? - start;
        if seconds > LONG {
            return Ok((found, seconds / f64::from(count)));
        }
    }
    bail!("no time goes by")
}

/// Aspect ratio, area over that at the start and seconds of a run of IB2d.
fn ib2d(python: &Path, folder: &Path, cells: usize, dt: f64) -> Result<Found> {
    let script = tables::root().join("studies/ib2d/relaxing_ellipse.py");
    let mut command = Command::new(python);
    command.arg(script).arg(folder).args([cells.to_string(), dt.to_string(), DENSITY.to_string(), END.to_string()]);
    // One core, as motile has.
    for threads in ["OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"] {
        command.env(threads, "1");
    }
    let done = command.output().with_context(|| format!("running {}", python.display()))?;
    ensure!(done.status.success(), "IB2d: {}", String::from_utf8_lossy(&done.stderr).trim());
    let printed = String::from_utf8_lossy(&done.stdout).into_owned();
    let last = printed.lines().last().unwrap_or_default();
    let numbers: Vec<f64> = last.split_whitespace().map(str::parse).collect::<Result<_, _>>()?;
    numbers.try_into().map_err(|_| anyhow::anyhow!("IB2d printed other than three numbers: {last}"))
}
