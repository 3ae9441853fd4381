//! Studies of scenes of interfaces alone, without a grid.

use std::time::Instant;

use motile::base::Region;
use motile::scene::StepSize;
use motile::setup::{DropletSetup, GridMethod, Method, Setup};
use motile_tests::validation::growth::{Mode, rate_in_plane, rate_in_plane_limit};
use motile_tests::validation::interfaces::{Several, passing, relax, ten_in_a_box};
use motile_tests::validation::scene::{on_grid, open_channel, reference, without_grid};
use motile_tests::validation::swimmers::{long_run, steady, transient};
use motile_tests::validation::{StudyError, Table, lateral};

use crate::validation::{Tables, per_cent};

/// Nodes and cells.
const RESOLUTIONS: [(usize, usize); 5] = [(48, 192), (64, 256), (96, 384), (128, 512), (192, 768)];

fn resolutions(quick: bool) -> &'static [(usize, usize)] {
    if quick { &RESOLUTIONS[1..3] } else { &RESOLUTIONS }
}

pub(crate) fn relaxation(quick: bool) -> Tables {
    let mut table = Table::new(
        "Relaxation of an ellipse without a grid, 6 x 6 box, to t = 2: errors of aspect ratio and tip, change of the \
         area",
        &["viscosities in/out", "nodes", "markers", "dt", "aspect ratio", "tip", "area"],
    );
    for ratio in [1, 10] {
        let mut push = |nodes: usize, markers: usize, dt: f64| -> Result<(), StudyError> {
            let run = relax(ratio, nodes, markers, dt)?;
            table.push([
                format!("{ratio}/1"),
                nodes.to_string(),
                markers.to_string(),
                dt.to_string(),
                format!("{:.1e}", run.aspect_ratio),
                format!("{:.1e}", run.tip),
                format!("{:.1e}", run.area_change),
            ]);
            Ok(())
        };
        for dt in if quick { &[0.02, 0.01][..] } else { &[0.04, 0.02, 0.01, 0.005, 0.0025, 0.00125][..] } {
            push(64, 256, *dt)?;
        }
        for nodes in [24, 32, 48] {
            push(nodes, 256, 0.005)?;
        }
    }
    Ok(vec![table])
}

pub(crate) fn growth(quick: bool) -> Tables {
    let mut table = Table::new(
        "Growth rates (2.18), (2.19) in unbounded fluid: relative errors",
        &["viscosities in/out", "activity", "mode", "theory", "384 elements", "from 768 and 1536 elements"],
    );
    let modes =
        [Mode::Concentration(1), Mode::Concentration(2), Mode::Concentration(3), Mode::Shape(2), Mode::Shape(3)];
    let modes = if quick { &modes[..1] } else { &modes[..] };
    for (inside, viscosity) in [(100.0, 100.0), (1000.0, 10.0), (10.0, 100.0)] {
        // The second activity is the threshold (2.20), where the first mode neither grows nor decays.
        let threshold = -2.0 * 0.1 * (inside + viscosity) / 100.0;
        for activity in [-1.0, threshold] {
            let droplets = vec![DropletSetup { viscosity: Some(inside), ..DropletSetup::active(activity) }];
            let setup = Setup { viscosity, droplets, ..Setup::default() };
            for &mode in modes {
                let theory = mode.theory(&setup)?;
                // Where the rate is zero, errors are relative to that of diffusion.
                let scale = if theory.abs() < 1e-9 { 0.1 } else { theory.abs() };
                let coarse = rate_in_plane(&setup, mode, 64, 384)?;
                let limit = rate_in_plane_limit(&setup, mode, 64, 768)?;
                table.push([
                    format!("{inside}/{viscosity}"),
                    format!("{activity:.2}"),
                    format!("{mode:?}"),
                    format!("{theory:.6}"),
                    format!("{:.1e}", (coarse - theory) / scale),
                    format!("{:.1e}", (limit - theory) / scale),
                ]);
            }
        }
    }
    Ok(vec![table])
}

pub(crate) fn transients(quick: bool) -> Tables {
    let mut table = Table::new(
        "Transient at activity -1 without a grid, 6 x 6 box: largest relative error of the speed",
        &["nodes", "elements", "error in %", "at time"],
    );
    for &(nodes, cells) in resolutions(quick) {
        let (error, time) = transient(&reference(without_grid(nodes, cells), -1.0))?;
        table.push([nodes.to_string(), cells.to_string(), format!("{:.4}", 100.0 * error), time.to_string()]);
    }
    Ok(vec![table])
}

pub(crate) fn channel(quick: bool) -> Tables {
    let mut table = Table::new(
        "Steady swimmers in channels without a grid (period 12, A = 10): errors in % of speed, aspect ratio, \
         stresslet, beta, gap",
        &["width", "activity", "nodes", "elements", "errors", "area change", "seconds"],
    );
    for (width, activity, time) in
        [(2.0, -2.0, 400.0), (2.0, -4.0, 400.0), (3.0, -2.0, 60.0), (5.0, -2.0, 60.0), (5.0, -4.0, 60.0)]
    {
        for &(nodes, cells) in if quick { &RESOLUTIONS[1..3] } else { &RESOLUTIONS[..4] } {
            let (region, droplets) = (open_channel(12.0, width), vec![DropletSetup::active(activity)]);
            let setup = Setup { region, droplets, ..without_grid(nodes, cells) };
            let clock = Instant::now();
            let start = [width.to_string(), activity.to_string(), nodes.to_string(), cells.to_string()];
            match steady(&setup, time) {
                Ok(e) => {
                    let list = [e.speed, e.aspect_ratio, e.stresslet, e.beta, e.gap.unwrap_or(f64::NAN)];
                    let list = list.map(per_cent).join(" / ");
                    let seconds = format!("{:.1}", clock.elapsed().as_secs_f64());
                    table.push(start.into_iter().chain([list, format!("{:.1e}", e.area_change), seconds]));
                }
                Err(StudyError::Scene(error)) => {
                    table.push(start.into_iter().chain([format!("ends: {error}"), String::new(), String::new()]));
                }
                Err(error) => return Err(error),
            }
        }
    }
    Ok(vec![table])
}

pub(crate) fn lateral_modes(quick: bool) -> Tables {
    let mut modes = Table::new(
        "Lateral offset in a channel without a grid (width 5, period 12, A = 10): growth rate and angular frequency \
         from t = 40 to 100",
        &["activity", "nodes", "elements", "growth rate", "error in %", "frequency", "error in %"],
    );
    for activity in [-2.0, -4.0] {
        let (growth, frequency) = lateral::reference(activity)?;
        for &(nodes, cells) in &[(64, 256), (96, 384), (96, 768), (128, 512), (192, 768)][..if quick { 2 } else { 5 }] {
            let droplets = vec![DropletSetup { centre: [0.0, 1e-3], ..DropletSetup::active(activity) }];
            let setup = Setup { region: open_channel(12.0, 5.0), droplets, ..without_grid(nodes, cells) };
            let mode = lateral::mode(&setup, 40.0, 100.0)?;
            let found = mode.frequency.map_or(f64::NAN, |w| w.value);
            modes.push([
                activity.to_string(),
                nodes.to_string(),
                cells.to_string(),
                format!("{:.6}", mode.growth_rate.value),
                per_cent(mode.growth_rate.value / growth - 1.0),
                format!("{found:.6}"),
                per_cent(found / frequency - 1.0),
            ]);
        }
    }
    Ok(vec![modes])
}

pub(crate) fn several(quick: bool) -> Tables {
    let mut table = Table::new(
        "Several swimmers without a grid",
        &[
            "scene",
            "ratio",
            "nodes",
            "elements",
            "smallest gap",
            "largest shift from the finest run",
            "area",
            "particles",
            "iterations",
            "seconds",
        ],
    );
    type Run<'a> = &'a dyn Fn(&Setup) -> Result<Several, StudyError>;
    let mut push = |name: &str, base: &Setup, all: &[(usize, usize)], run: Run<'_>| -> Result<(), StudyError> {
        let ratio = base.droplets[0].viscosity.map_or(1.0, |inside| inside / base.viscosity);
        let mut rows = Vec::new();
        for &(nodes, cells) in all {
            let clock = Instant::now();
            let found = run(&Setup { method: without_grid(nodes, cells).method, ..base.clone() })?;
            rows.push((nodes, cells, found, clock.elapsed().as_secs_f64()));
        }
        let finest = rows.last().map(|row| row.2.centroids.clone()).unwrap_or_default();
        for (nodes, cells, found, seconds) in rows {
            let shifts = found.centroids.iter().zip(&finest).map(|(a, b)| (a - b).length());
            table.push([
                name.to_owned(),
                ratio.to_string(),
                nodes.to_string(),
                cells.to_string(),
                format!("{:.4}", found.gap),
                format!("{:.1e}", shifts.fold(0.0, f64::max)),
                format!("{:.1e}", found.area_change),
                format!("{:.0e}", found.particle_change),
                format!("{:.1}", found.iterations),
                format!("{seconds:.1}"),
            ]);
        }
        Ok(())
    };
    let equal = Setup::default();
    let viscous = DropletSetup { viscosity: Some(1000.0), ..DropletSetup::active(-7.0) };
    let viscous = Setup { viscosity: 10.0, droplets: vec![viscous], ..Setup::default() };
    let all = if quick { &RESOLUTIONS[1..3] } else { &RESOLUTIONS[1..4] };
    for (base, offset) in [(&equal, EQUAL_OFFSET), (&viscous, THICK_OFFSET)] {
        push("two that pass, to t = 40", base, all, &|setup| passing(setup, offset, 40.0))?;
    }
    let ten = |base: &Setup| Setup { region: Region::Box { lengths: [10.4; 2] }, ..base.clone() };
    let time = if quick { 5.0 } else { 20.0 };
    let all = if quick { &RESOLUTIONS[1..2] } else { &RESOLUTIONS[1..3] };
    for base in [&equal, &viscous] {
        push(&format!("ten in a box of 10.4, to t = {time}"), &ten(base), all, &|setup| ten_in_a_box(setup, time))?;
    }
    Ok(vec![table])
}

/// Distances of the lines on which two swimmers come towards each other, less two radii, for which they pass at a gap
/// of about 0.05.
const EQUAL_OFFSET: f64 = 0.0;
const THICK_OFFSET: f64 = 0.14;

pub(crate) fn long_runs(quick: bool) -> Tables {
    let mut table = Table::new(
        "Long runs without a grid, 6 x 6 box, A = 2 |activity|, from an angle of 0.02: rate at which the angle grows, \
         speed, what must not change",
        &[
            "activity",
            "until",
            "crossings of the edge",
            "rate",
            "angle",
            "speed",
            "spread of speed in the second half",
            "area",
            "particles",
            "perimeter in the second half",
        ],
    );
    for (activity, time) in [(-1.0, 250.0), (-2.0, 250.0), (-3.0, 250.0), (-5.0, 100.0)] {
        let time = if quick { 60.0 } else { time };
        let droplets = vec![DropletSetup { angle: 0.02, ..DropletSetup::default() }];
        let run = long_run(&reference(Setup { droplets, ..Setup::default() }, activity), time)?;
        table.push([
            activity.to_string(),
            time.to_string(),
            run.crossings.to_string(),
            format!("{:.4}", run.divergence()),
            format!("{:.4}", run.headings[1]),
            format!("{:.6}", run.speed),
            format!("{:.0e}", run.speed_spread),
            format!("{:.1e}", run.area_change),
            format!("{:.0e}", run.particle_change),
            format!("{:.1e}", run.perimeter_creep),
        ]);
    }
    Ok(vec![table])
}

pub(crate) fn cost(quick: bool) -> Tables {
    let mut tables = Vec::new();
    for activity in [-2.0, -4.0] {
        let mut rows: Vec<(String, f64, f64, usize)> = Vec::new();
        let mut push = |name: String, setup: Setup| -> Result<(), StudyError> {
            let clock = Instant::now();
            let errors = steady(&reference(setup, activity), 60.0)?;
            rows.push((name, errors.speed, clock.elapsed().as_secs_f64(), errors.steps));
            Ok(())
        };
        for (nodes, cells) in [(24, 96), (32, 128), (48, 192), (64, 256), (96, 384), (128, 512), (192, 768)] {
            push(format!("without a grid, {nodes} nodes, {cells} elements"), without_grid(nodes, cells))?;
        }
        for &h in if quick { &[0.2, 0.1, 0.05][..] } else { &[0.2, 0.1, 0.05, 0.025][..] } {
            push(format!("immersed boundary, h = {h}"), on_grid(h))?;
        }
        for &h in if quick { &[0.1][..] } else { &[0.1, 0.05, 0.025][..] } {
            let method = Method::Grid(GridMethod { spacing: h, ..GridMethod::thesis() });
            let setup = Setup { method, step: StepSize::Fixed(0.1 * h), ..Setup::thesis() };
            push(format!("thesis, h = {h}, steps of 0.1 h"), setup)?;
        }
        let fastest = rows.iter().map(|row| row.2).fold(f64::INFINITY, f64::min);
        let title = format!(
            "Cost of a swimmer to t = 60, 6 x 6 box, viscosity 100, activity {activity}: times relative to the fastest \
             run"
        );
        let mut table = Table::new(&title, &["method", "error of the speed in %", "steps", "time"]);
        for (name, error, seconds, steps) in &rows {
            table.push([name.clone(), per_cent(*error), steps.to_string(), format!("{:.1}", seconds / fastest)]);
        }
        let title = format!("The same: the least time for an error, activity {activity}");
        let mut least = Table::new(&title, &["method", "1 %", "0.1 %", "0.01 %"]);
        for method in ["without a grid", "immersed boundary", "thesis"] {
            let within = |bound: f64| {
                let mut own = rows.iter().filter(|row| row.0.starts_with(method)).rev().peekable();
                // From the finest on, as long as all finer ones are within the bound too: no lucky sign change counts.
                let mut best = None;
                while let Some(row) = own.next_if(|row| row.1.abs() <= bound) {
                    best = Some(row.2);
                }
                best.map_or("-".to_owned(), |seconds| format!("{:.1}", seconds / fastest))
            };
            least.push([method.to_owned(), within(1e-2), within(1e-3), within(1e-4)]);
        }
        tables.extend([table, least]);
    }
    Ok(tables)
}
