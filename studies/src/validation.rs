//! Compares motile with exact and independently computed values, study by study, and prints the tables of
//! `docs/validation.md`, and those of solids in `docs/elastic.md`.
//!
//! `cargo run --release -p studies -- validation all` runs everything (about half an hour on one core), a study's name
//! only that study; `--quick` leaves out the finest grids.

mod active_walls;
mod channels;
mod contrast;
mod curved_walls;
mod elastic_walls;
mod fast_sums;
mod headings;
mod imposed_flows;
mod interfaces;
mod recommended;
mod soft_walls;
mod solids;
mod two_droplets;
mod viscoelastic;

use clap::{Args, builder::PossibleValuesParser};
use motile::active_interface::Motion;
use motile::base::Region;
use motile::ib_core::{AnyKernel, Kernel};
use motile::scene::StepSize;
use motile::setup::{DropletSetup, GridMethod, Method, Setup};
use motile_cli::run::say;
use motile_tests::validation::growth::Mode;
use motile_tests::validation::scene::{on_grid, open_channel, reference, without_grid};
use motile_tests::validation::swimmers::{LongRun, long_run, speeds, steady, transient};
use motile_tests::validation::{Case, StudyError, Table, fixed_shapes, growth, order, relaxation, resolution};

use crate::tables;

/// Compares motile with exact and independently computed values.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// The comparison
    #[arg(default_value = ALL, value_parser = names())]
    study: String,
    /// Leave out the finest grids and the longest runs.
    #[arg(long)]
    quick: bool,
    /// Write the tables to docs/tables, with the commit and what they depend on
    #[arg(long, conflicts_with = "quick")]
    write: bool,
    /// Fail if the tables are not those of docs/tables
    #[arg(long, conflicts_with = "quick")]
    check: bool,
}

type Tables = Result<Vec<Table>, StudyError>;

/// Function that runs a study, with or without the finest grids.
type Run = fn(bool) -> Tables;

/// All studies.
const STUDIES: [(&str, Run); 40] = [
    ("fixed-shapes", fixed),
    ("relaxation", relax),
    ("growth", grow),
    ("steady", swim),
    ("without-grid", integrals),
    ("transient", start),
    ("threshold", threshold),
    ("marker-spacing", marker_spacing),
    ("long-run", long),
    ("invariance", invariance),
    ("headings", headings::headings),
    ("recommended", recommended::recommended),
    ("channel-shapes", channels::channel_shapes),
    ("channel-swimmers", channels::channel_swimmers),
    ("channel-length", channels::channel_length),
    ("lateral", channels::sideways),
    ("regimes", channels::regimes),
    ("contrast-shapes", contrast::shapes),
    ("contrast-close", contrast::close),
    ("contrast-iterations", contrast::iterations),
    ("contrast-decay", contrast::decay),
    ("contrast-runs", contrast::runs),
    ("contrast-cost", contrast::cost),
    ("interface-relaxation", interfaces::relaxation),
    ("interface-growth", interfaces::growth),
    ("interface-transient", interfaces::transients),
    ("interface-channel", interfaces::channel),
    ("interface-lateral", interfaces::lateral_modes),
    ("interface-several", interfaces::several),
    ("interface-long-runs", interfaces::long_runs),
    ("active-walls", active_walls::active_walls),
    ("imposed-flows", imposed_flows::imposed_flows),
    ("two-droplets", two_droplets::two_droplets),
    ("curved-walls", curved_walls::curved_walls),
    ("elastic-walls", elastic_walls::elastic_walls),
    ("solids", solids::solids),
    ("viscoelastic", viscoelastic::viscoelastic),
    ("soft-walls", soft_walls::soft_walls),
    ("fast-sums", fast_sums::fast_sums),
    ("cost", interfaces::cost),
];
/// The name for all of them.
const ALL: &str = "all";

fn names() -> PossibleValuesParser {
    PossibleValuesParser::new([ALL].into_iter().chain(STUDIES.map(|(name, _)| name)))
}

pub(crate) fn run(flags: &Flags) -> anyhow::Result<()> {
    for (name, run) in STUDIES.into_iter().filter(|(name, _)| [ALL, *name].contains(&flags.study.as_str())) {
        let found = run(flags.quick)?;
        found.iter().for_each(say);
        let solids = ["solids", "elastic-walls", "viscoelastic", "soft-walls"]
            .contains(&name)
            .then_some("crates/elastic-solids");
        let inputs: Vec<&str> = ["tests/src/validation"].into_iter().chain(solids).collect();
        if flags.check {
            tables::check(name, &found)?;
        } else if flags.write {
            tables::write(name, &format!("validation {name}"), &inputs, &found)?;
        }
    }
    Ok(())
}

fn spacings(quick: bool) -> &'static [f64] {
    if quick { &[0.1, 0.05] } else { &[0.1, 0.05, 0.025] }
}

fn per_cent(value: f64) -> String {
    format!("{:.3}", 100.0 * value)
}

fn fixed(quick: bool) -> Tables {
    let spacings = spacings(quick);
    let mut table = Table::new(
        "Marker velocities on fixed shapes: largest error over eight markers, % of the largest velocity",
        &["kernel", "correction", "shape, tension", "errors at h = 0.1, 0.05, 0.025", "order"],
    );
    for kernel in AnyKernel::ALL {
        for corrected in [false, true] {
            for case in Case::ALL {
                let errors = spacings
                    .iter()
                    .map(|&h| Ok(fixed_shapes::errors(&kernel, corrected, h, case)?.maximum))
                    .collect::<Result<Vec<_>, StudyError>>()?;
                table.push([
                    kernel.name().to_owned(),
                    if corrected { "on" } else { "off" }.to_owned(),
                    case.name().to_owned(),
                    errors.iter().map(|&e| per_cent(e)).collect::<Vec<_>>().join(" / "),
                    format!("{:.2}", order(spacings, &errors)),
                ]);
            }
        }
    }
    Ok(vec![table])
}

fn relax(quick: bool) -> Tables {
    let mut table = Table::new(
        "Relaxation of an ellipse to t = 2: error of the aspect ratio, change of the area",
        &["h", "dt", "error of the aspect ratio", "relative change of the area"],
    );
    for &h in spacings(quick) {
        for dt in [0.04, 0.01, 0.0025] {
            let run = relaxation::run(h, dt)?;
            let (error, area) = (format!("{:.2e}", run.aspect_ratio_error), format!("{:.1e}", run.area_change));
            table.push([h.to_string(), dt.to_string(), error, area]);
        }
    }
    Ok(vec![table])
}

fn grow(quick: bool) -> Tables {
    let mut table = Table::new(
        "Growth rates of small perturbations, box effect removed, h = 0.05: error in %",
        &["mode", "theory", "default", "error", "thesis preset", "error"],
    );
    let (accurate, thesis) = (on_grid(0.05), Setup::thesis());
    let modes = if quick { &Mode::ALL[..3] } else { &Mode::ALL[..] };
    for &mode in modes {
        let theory = mode.theory(&accurate)?;
        let rates = [growth::rate(&accurate, mode)?, growth::rate(&thesis, mode)?];
        let mut row = vec![format!("{mode:?}"), format!("{theory:.4}")];
        for rate in rates {
            row.push(format!("{rate:.4}"));
            row.push(per_cent((rate - theory) / theory.abs()));
        }
        table.push(row);
    }
    Ok(vec![table])
}

fn swim(quick: bool) -> Tables {
    let mut table = Table::new(
        "Steady swimmers in a 6 x 6 box: errors in % of speed, aspect ratio, stresslet, beta, active fraction, maximum \
         concentration",
        &["preset", "activity", "h", "ds", "errors", "area change", "steps", "seconds"],
    );
    let accurate: &[(f64, f64)] = if quick {
        &[(0.2, 0.05), (0.1, 0.05), (0.05, 0.025)]
    } else {
        &[(0.2, 0.05), (0.1, 0.05), (0.1, 0.025), (0.05, 0.025), (0.05, 0.0125), (0.025, 0.0125)]
    };
    let thesis: &[(f64, f64)] =
        if quick { &[(0.1, 0.05), (0.05, 0.025)] } else { &[(0.2, 0.1), (0.1, 0.05), (0.05, 0.025), (0.025, 0.0125)] };
    for activity in [-2.0, -4.0] {
        for (name, resolutions) in [("default", accurate), ("thesis", thesis)] {
            for &(h, ds) in resolutions {
                let (preset, base) = if name == "thesis" {
                    // The error of the time step is far below that of the grid at ten times Cowley's step.
                    (GridMethod::thesis(), Setup { step: StepSize::Fixed(0.2 * h), ..Setup::thesis() })
                } else {
                    (GridMethod::default(), Setup::default())
                };
                let method = Method::Grid(GridMethod { spacing: h, marker_spacing: Some(ds), ..preset });
                let clock = std::time::Instant::now();
                let errors = steady(&reference(Setup { method, ..base }, activity), 80.0)?;
                table.push([
                    name.to_owned(),
                    activity.to_string(),
                    h.to_string(),
                    ds.to_string(),
                    errors.list().map(per_cent).join(" / "),
                    format!("{:.1e}", errors.area_change),
                    errors.steps.to_string(),
                    format!("{:.1}", clock.elapsed().as_secs_f64()),
                ]);
            }
        }
    }
    Ok(vec![table])
}

fn start(quick: bool) -> Tables {
    let mut table =
        Table::new("Transient at activity -1: largest relative error of the speed", &["h", "error in %", "at time"]);
    for &h in spacings(quick) {
        let (error, time) = transient(&reference(on_grid(h), -1.0))?;
        table.push([h.to_string(), per_cent(error), time.to_string()]);
    }
    Ok(vec![table])
}

fn threshold(quick: bool) -> Tables {
    let mut table = Table::new(
        "A perturbed droplet, viscosity 100, box 6: does it swim?",
        &["activity", "until", "largest speed in the first half", "speed at the end", "verdict"],
    );
    for activity in [-0.3, -0.5] {
        let run = resolution::perturbed(activity, 0.1, if quick { 200.0 } else { 400.0 })?;
        let verdict = if run.swims { "swims" } else { "comes to rest" };
        table.push([
            activity.to_string(),
            run.time.to_string(),
            format!("{:.2e}", run.largest_early_speed),
            format!("{:.2e}", run.speed),
            verdict.to_owned(),
        ]);
    }
    let droplets = vec![DropletSetup::active(-1.0)];
    let weak = Setup { region: open_channel(12.0, 2.0), droplets, ..on_grid(0.1) };
    let mut narrow = Table::new(
        "Activity -1 in a channel of width 2 R0, polarised start: speed at two times",
        &["t = 50", "t = 300"],
    );
    narrow.push(speeds(&weak, &[50.0, 300.0])?.iter().map(|speed| format!("{speed:.1e}")));
    Ok(vec![table, narrow])
}

fn integrals(quick: bool) -> Tables {
    let mut table = Table::new(
        "Steady swimmers without a grid, 6 x 6 box: errors in % of speed, aspect ratio, stresslet, beta, active \
         fraction, maximum concentration",
        &["viscosities in/out", "activity", "nodes", "elements", "errors", "area change", "steps", "seconds"],
    );
    let all = [(32, 256), (48, 256), (64, 256), (64, 512), (96, 384), (128, 512), (192, 768)];
    for (inside, viscosity, activity) in [(None, 100.0, -2.0), (None, 100.0, -4.0), (Some(100.0), 10.0, -1.0)] {
        for &(nodes, cells) in if quick { &all[2..5] } else { &all[..] } {
            let droplets = vec![DropletSetup { viscosity: inside, ..DropletSetup::default() }];
            let setup = Setup { viscosity, droplets, ..without_grid(nodes, cells) };
            let clock = std::time::Instant::now();
            let errors = steady(&reference(setup, activity), 80.0)?;
            table.push([
                format!("{}/{viscosity}", inside.unwrap_or(viscosity)),
                activity.to_string(),
                nodes.to_string(),
                cells.to_string(),
                errors.list().map(per_cent).join(" / "),
                format!("{:.1e}", errors.area_change),
                errors.steps.to_string(),
                format!("{:.1}", clock.elapsed().as_secs_f64()),
            ]);
        }
    }
    Ok(vec![table])
}

fn marker_spacing(_quick: bool) -> Tables {
    let mut table = Table::new(
        "Marker spacing at fixed h = 0.1: viscosity 10, activity -2, speed at t = 3",
        &["ds", "speed", "element Peclet number", "warned"],
    );
    for ds in [0.05, 0.025, 0.0125, 0.00625] {
        let row = resolution::marker_spacing(ds)?;
        table.push([
            ds.to_string(),
            format!("{:.4}", row.speed),
            format!("{:.2}", row.peclet),
            if row.warned { "yes" } else { "no" }.to_owned(),
        ]);
    }
    Ok(vec![table])
}

fn push_run(table: &mut Table, name: String, run: &LongRun) {
    table.push([
        name,
        format!("{:.6}", run.speed),
        format!("{:.1e}", run.speed_spread),
        format!("{:.1e}", run.area_change),
        format!("{:.0e}", run.particle_change),
        format!("{:.1e}", run.perimeter_creep),
        format!("{:.2e}", run.turning_rate()),
    ]);
}

const RUN_HEADER: [&str; 7] = [
    "run",
    "speed",
    "spread of speed in the second half",
    "area change",
    "particle change",
    "change of the perimeter in the second half",
    "turning rate",
];

fn long(quick: bool) -> Tables {
    let mut table = Table::new("A long run: activity -4, A = 10, box 6, to t = 250 (quick: 60)", &RUN_HEADER);
    for h in if quick { vec![0.1] } else { vec![0.1, 0.05] } {
        let setup = Setup { droplets: vec![DropletSetup::active(-4.0)], ..on_grid(h) };
        let time = if quick { 60.0 } else { 250.0 };
        push_run(&mut table, format!("h = {h}"), &long_run(&setup, time)?);
        let motion = Motion::Equidistributed { relaxation: 50.0, filter: false };
        let droplets = vec![DropletSetup { motion, ..DropletSetup::active(-4.0) }];
        match long_run(&Setup { droplets, ..setup }, time) {
            Ok(run) => push_run(&mut table, format!("h = {h}, without the filter"), &run),
            Err(error) => table.push([format!("h = {h}, without the filter"), format!("ends: {error}")]),
        }
    }
    Ok(vec![table])
}

fn invariance(quick: bool) -> Tables {
    let mut tables = Vec::new();
    for h in if quick { vec![0.1] } else { vec![0.1, 0.05] } {
        let title = format!("Headings and sub-grid offsets: activity -4, A = 10, 12 x 12 box, h = {h}, to t = 40");
        let mut table = Table::new(&title, &RUN_HEADER);
        let mut speeds = Vec::new();
        for degrees in [0.0_f64, 15.0, 30.0, 45.0] {
            for offset in [[0.0, 0.0], [0.0, 0.3], [0.3, 0.5], [0.5, 0.5], [0.25, 0.7]] {
                if quick && degrees > 0.0 && offset != [0.0, 0.0] {
                    continue;
                }
                let droplet = DropletSetup {
                    angle: degrees.to_radians(),
                    centre: offset.map(|x| x * h),
                    ..DropletSetup::active(-4.0)
                };
                let region = Region::Box { lengths: [12.0; 2] };
                let run = long_run(&Setup { region, droplets: vec![droplet], ..on_grid(h) }, 40.0)?;
                speeds.push((degrees, run.speed));
                push_run(&mut table, format!("{degrees} degrees, offset ({}, {}) h", offset[0], offset[1]), &run);
            }
        }
        let mut spread =
            Table::new(&format!("Spread of the speed over the offsets, h = {h}"), &["heading", "spread in %"]);
        for degrees in [0.0, 15.0, 30.0, 45.0] {
            let of: Vec<f64> = speeds.iter().filter(|(d, _)| *d == degrees).map(|(_, v)| *v).collect();
            let (max, min) = of.iter().fold((0.0_f64, f64::INFINITY), |(a, b), &v| (a.max(v), b.min(v)));
            spread.push([format!("{degrees} degrees"), per_cent(max / min - 1.0)]);
        }
        tables.extend([table, spread]);
    }
    Ok(tables)
}
