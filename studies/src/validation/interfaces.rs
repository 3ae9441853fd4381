//! Studies of scenes of interfaces alone, without a grid.

use std::time::Instant;

use motile::Swimmer;
use motile::ib_core::StepSize;
use motile_tests::validation::growth::Mode;
use motile_tests::validation::interfaces::{
    Several, growth_rate, growth_rate_limit, passing, relax, steady_in_channel, ten_in_a_box, turning,
};
use motile_tests::validation::lateral::{self, Method};
use motile_tests::validation::swimmers::{reference_swimmer, steady, steady_without_grid, transient_without_grid};
use motile_tests::validation::{StudyError, Table};

use crate::validation::{Tables, per_cent};

/// Nodes and cells.
const RESOLUTIONS: [(usize, usize); 5] = [(48, 192), (64, 256), (96, 384), (128, 512), (192, 768)];

fn resolutions(quick: bool) -> &'static [(usize, usize)] {
    if quick { &RESOLUTIONS[1..3] } else { &RESOLUTIONS }
}

pub(crate) fn relaxation(quick: bool) -> Tables {
    let mut table = Table::new(
        "Relaxation of an ellipse without a grid, 6 x 6 box, to t = 2: errors of aspect ratio and tip, change of the area",
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
        &["viscosities in/out", "activity", "mode", "theory", "384 cells", "from 768 and 1536 cells"],
    );
    let modes =
        [Mode::Concentration(1), Mode::Concentration(2), Mode::Concentration(3), Mode::Shape(2), Mode::Shape(3)];
    let modes = if quick { &modes[..1] } else { &modes[..] };
    for (inside, viscosity) in [(100.0, 100.0), (1000.0, 10.0), (10.0, 100.0)] {
        // The second activity is the threshold (2.20), where the first mode neither grows nor decays.
        let threshold = -2.0 * 0.1 * (inside + viscosity) / 100.0;
        for activity in [-1.0, threshold] {
            let swimmer =
                Swimmer { activity, viscosity, viscosity_inside: Some(inside), nodes: 64, ..Swimmer::default() };
            for &mode in modes {
                let theory = mode.theory(&swimmer);
                // Where the rate is zero, errors are relative to that of diffusion.
                let scale = if theory.abs() < 1e-9 { swimmer.diffusion } else { theory.abs() };
                let coarse = growth_rate(&swimmer, mode, 384)?;
                let limit = growth_rate_limit(&swimmer, mode, 768)?;
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
        &["nodes", "cells", "error in %", "at time"],
    );
    for &(nodes, concentration_cells) in resolutions(quick) {
        let (error, time) = transient_without_grid(&Swimmer { nodes, concentration_cells, ..Swimmer::default() })?;
        table.push([
            nodes.to_string(),
            concentration_cells.to_string(),
            format!("{:.4}", 100.0 * error),
            time.to_string(),
        ]);
    }
    Ok(vec![table])
}

pub(crate) fn channel(quick: bool) -> Tables {
    let mut table = Table::new(
        "Steady swimmers in channels without a grid (period 12, A = 10): errors in % of speed, aspect ratio, stresslet, beta, gap",
        &["width", "activity", "nodes", "cells", "errors", "area change", "seconds"],
    );
    for (width, activity, time) in
        [(2.0, -2.0, 400.0), (2.0, -4.0, 400.0), (3.0, -2.0, 60.0), (5.0, -2.0, 60.0), (5.0, -4.0, 60.0)]
    {
        for &(nodes, concentration_cells) in if quick { &RESOLUTIONS[1..3] } else { &RESOLUTIONS[..4] } {
            let lengths = [12.0, width];
            let swimmer = Swimmer { activity, lengths, nodes, concentration_cells, ..Swimmer::default() };
            let clock = Instant::now();
            let start = [width.to_string(), activity.to_string(), nodes.to_string(), concentration_cells.to_string()];
            match steady_in_channel(&swimmer, time) {
                Ok(e) => {
                    let list = [e.speed, e.aspect_ratio, e.stresslet, e.beta, e.gap].map(per_cent).join(" / ");
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
        "Lateral offset in a channel without a grid (width 5, period 12, A = 10): growth rate and angular frequency from t = 40 to 100",
        &["activity", "nodes", "cells", "growth rate", "error in %", "frequency", "error in %"],
    );
    for activity in [-2.0, -4.0] {
        let (growth, frequency) = lateral::reference(activity)?;
        for &(nodes, concentration_cells) in
            &[(64, 256), (96, 384), (96, 768), (128, 512), (192, 768)][..if quick { 2 } else { 5 }]
        {
            let offset = [0.0, 1e-3];
            let swimmer =
                Swimmer { activity, nodes, concentration_cells, lengths: [12.0, 5.0], offset, ..Swimmer::default() };
            let mode = lateral::mode(&swimmer, Method::BoundaryIntegral, 40.0, 100.0)?;
            let found = mode.frequency.map_or(f64::NAN, |w| w.value);
            modes.push([
                activity.to_string(),
                nodes.to_string(),
                concentration_cells.to_string(),
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
            "cells",
            "smallest gap",
            "largest shift from the finest run",
            "area",
            "particles",
            "iterations",
            "seconds",
        ],
    );
    type Run<'a> = &'a dyn Fn(&Swimmer) -> Result<Several, StudyError>;
    let mut push = |name: &str, base: &Swimmer, all: &[(usize, usize)], run: Run<'_>| -> Result<(), StudyError> {
        let ratio = base.viscosity_inside.map_or(1.0, |inside| inside / base.viscosity);
        let mut rows = Vec::new();
        for &(nodes, concentration_cells) in all {
            let clock = Instant::now();
            let found = run(&Swimmer { nodes, concentration_cells, ..base.clone() })?;
            rows.push((nodes, concentration_cells, found, clock.elapsed().as_secs_f64()));
        }
        let finest = rows.last().map(|row| row.2.centroids.clone()).unwrap_or_default();
        for (nodes, cells, found, seconds) in rows {
            let shifts = found.centroids.iter().zip(&finest).map(|(a, b)| (a - b).norm());
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
    let equal = Swimmer { activity: -2.0, ..Swimmer::default() };
    let thick = Swimmer { activity: -7.0, viscosity: 10.0, viscosity_inside: Some(1000.0), ..Swimmer::default() };
    let all = if quick { &RESOLUTIONS[1..3] } else { &RESOLUTIONS[1..4] };
    for (base, offset) in [(&equal, EQUAL_OFFSET), (&thick, THICK_OFFSET)] {
        push("two that pass, to t = 40", base, all, &|swimmer| passing(swimmer, offset, 40.0))?;
    }
    let ten = |base: &Swimmer| Swimmer { lengths: [10.4, 10.4], ..base.clone() };
    let time = if quick { 5.0 } else { 20.0 };
    let all = if quick { &RESOLUTIONS[1..2] } else { &RESOLUTIONS[1..3] };
    for base in [&equal, &thick] {
        push(&format!("ten in a box of 10.4, to t = {time}"), &ten(base), all, &|swimmer| ten_in_a_box(swimmer, time))?;
    }
    Ok(vec![table])
}

/// Distances of the lines on which two swimmers come towards each other, less two radii, for which they pass at a gap
/// of about 0.05.
const EQUAL_OFFSET: f64 = 0.0;
const THICK_OFFSET: f64 = 0.14;

pub(crate) fn long_runs(quick: bool) -> Tables {
    let mut table = Table::new(
        "Long runs without a grid, 6 x 6 box, A = 2 |activity|, from an angle of 0.02: rate at which the angle grows, speed, what must not change",
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
        let swimmer = Swimmer { activity, excluded_volume: 2.0 * activity.abs(), angle: 0.02, ..Swimmer::default() };
        let run = turning(&swimmer, time)?;
        table.push([
            activity.to_string(),
            time.to_string(),
            run.crossings.to_string(),
            format!("{:.4}", run.rate),
            format!("{:.4}", run.angle),
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
        let mut push = |name: String, run: &dyn Fn() -> Result<(f64, usize), StudyError>| -> Result<(), StudyError> {
            let clock = Instant::now();
            let (error, steps) = run()?;
            rows.push((name, error, clock.elapsed().as_secs_f64(), steps));
            Ok(())
        };
        for (nodes, concentration_cells) in
            [(24, 96), (32, 128), (48, 192), (64, 256), (96, 384), (128, 512), (192, 768)]
        {
            let base = Swimmer { nodes, concentration_cells, ..Swimmer::default() };
            push(format!("without a grid, {nodes} nodes, {concentration_cells} cells"), &|| {
                let errors = steady_without_grid(&reference_swimmer(&base, activity, 0.05), 60.0)?;
                Ok((errors.speed, errors.steps))
            })?;
        }
        for h in if quick { &[0.2, 0.1, 0.05][..] } else { &[0.2, 0.1, 0.05, 0.025][..] } {
            push(format!("immersed boundary, h = {h}"), &|| {
                let errors = steady(&reference_swimmer(&Swimmer::default(), activity, *h), 60.0)?;
                Ok((errors.speed, errors.steps))
            })?;
        }
        for h in if quick { &[0.1][..] } else { &[0.1, 0.05, 0.025][..] } {
            push(format!("thesis, h = {h}, steps of 0.1 h"), &|| {
                let base = Swimmer { step: StepSize::Fixed(0.1 * h), ..Swimmer::thesis() };
                let errors = steady(&reference_swimmer(&base, activity, *h), 60.0)?;
                Ok((errors.speed, errors.steps))
            })?;
        }
        let fastest = rows.iter().map(|row| row.2).fold(f64::INFINITY, f64::min);
        let title = format!(
            "Cost of a swimmer to t = 60, 6 x 6 box, viscosity 100, activity {activity}: times relative to the fastest run"
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
