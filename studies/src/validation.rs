//! Compares motile with exact and independently computed values, study by study, and prints the tables of
//! `docs/evidence/accuracy.md`, and the tables of solids in `docs/evidence/results/elastic-walls.md`.
//!
//! `cargo run --release -p studies -- validation all` runs everything (about half an hour on one core), a study's name
//! only that study.

mod active_walls;
mod channels;
mod contrast;
mod coupled;
mod curved_walls;
mod elastic_walls;
mod fast_sums;
mod imposed_flows;
mod recommended;
mod soft_walls;
mod solids;
mod stresslet;
mod two_droplets;
mod viscoelastic;

use clap::{Args, builder::PossibleValuesParser};
use motile::ib_core::{AnyKernel, Kernel};
use motile::scene::StepSize;
use motile::setup::{GridMethod, Method, Setup};
use motile_tests::validation::growth::Mode;
use motile_tests::validation::scene::{on_grid, reference};
use motile_tests::validation::swimmers::steady;
use motile_tests::validation::{Case, StudyError, Table, fixed_shapes, growth, order};

use crate::tables::{self, Measure};

/// Compares motile with exact and independently computed values.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// The comparison
    #[arg(default_value = ALL, value_parser = names())]
    study: String,
    #[command(flatten)]
    keep: tables::Keep,
}

type Tables = Result<Vec<Table>, StudyError>;

type Run = fn() -> Tables;

/// All studies.
const STUDIES: [(&str, Run); 18] = [
    ("fixed-shapes", fixed),
    ("growth", grow),
    ("steady", swim),
    ("recommended", recommended::recommended),
    ("channel-swimmers", channels::channel_swimmers),
    ("stresslet", stresslet::stresslet),
    ("contrast-shapes", contrast::shapes),
    ("active-walls", active_walls::active_walls),
    ("imposed-flows", imposed_flows::imposed_flows),
    ("coupled", coupled::coupled),
    ("surfactant", coupled::surfactant),
    ("two-droplets", two_droplets::two_droplets),
    ("curved-walls", curved_walls::curved_walls),
    ("elastic-walls", elastic_walls::elastic_walls),
    ("solids", solids::solids),
    ("viscoelastic", viscoelastic::viscoelastic),
    ("soft-walls", soft_walls::soft_walls),
    ("fast-sums", fast_sums::fast_sums),
];
/// The name for all of them.
const ALL: &str = "all";

fn names() -> PossibleValuesParser {
    PossibleValuesParser::new([ALL].into_iter().chain(STUDIES.map(|(name, _)| name)))
}

pub(crate) fn run(flags: &Flags) -> anyhow::Result<()> {
    for (name, run) in STUDIES.into_iter().filter(|(name, _)| [ALL, *name].contains(&flags.study.as_str())) {
        flags.keep.tables(name, &format!("validation {name}"), &run()?)?;
    }
    Ok(())
}

const SPACINGS: [f64; 3] = [0.1, 0.05, 0.025];

fn per_cent(value: f64) -> String {
    format!("{:.3}", 100.0 * value)
}

fn fixed() -> Tables {
    let mut table = Table::new(
        "Marker velocities on fixed shapes: largest error over eight markers, % of the largest velocity",
        "kernel | correction | shape, tension | errors at h = 0.1, 0.05, 0.025 | order",
    );
    for kernel in AnyKernel::ALL {
        for corrected in [false, true] {
            for case in Case::ALL {
                let on = if corrected { "on" } else { "off" };
                table.measure(format_args!("{} | {on} | {}", kernel.name(), case.name()), || {
                    let error = |&h: &f64| Ok(fixed_shapes::errors(&kernel, corrected, h, case)?.maximum);
                    let errors = SPACINGS.iter().map(error).collect::<Result<Vec<_>, StudyError>>()?;
                    let order = order(&SPACINGS, &errors);
                    Ok(format!("{} | {order:.2}", list(errors)))
                })?;
            }
        }
    }
    Ok(vec![table])
}

/// Errors in per cent.
fn list(errors: impl IntoIterator<Item = f64>) -> String {
    errors.into_iter().map(per_cent).collect::<Vec<_>>().join(" / ")
}

fn grow() -> Tables {
    let mut table = Table::new(
        "Growth rates of small perturbations, box effect removed, h = 0.05: error in %",
        "mode | theory | default | error | thesis preset | error",
    );
    let (accurate, thesis) = (on_grid(0.05), Setup::thesis());
    for mode in Mode::ALL {
        table.measure(format_args!("{mode:?}"), || {
            let theory = mode.theory(&accurate)?;
            let [own, cowley] = [growth::rate(&accurate, mode)?, growth::rate(&thesis, mode)?];
            let [error, other] = [own, cowley].map(|rate| per_cent((rate - theory) / theory.abs()));
            Ok(format!("{theory:.4} | {own:.4} | {error} | {cowley:.4} | {other}"))
        })?;
    }
    Ok(vec![table])
}

fn swim() -> Tables {
    let mut table = Table::new(
        "Steady swimmers in a 6 x 6 box: errors in % of speed, aspect ratio, stresslet, beta, active fraction, maximum \
         concentration",
        "preset | activity | h | ds | errors",
    );
    let accurate = [(0.2, 0.05), (0.1, 0.05), (0.1, 0.025), (0.05, 0.025), (0.05, 0.0125), (0.025, 0.0125)];
    let thesis = [(0.2, 0.1), (0.1, 0.05), (0.05, 0.025), (0.025, 0.0125)];
    for activity in [-2.0, -4.0] {
        for (name, resolutions) in [("default", &accurate[..]), ("thesis", &thesis)] {
            for &(h, ds) in resolutions {
                let (preset, base) = if name == "thesis" {
                    // The error of the time step is far below that of the grid at ten times Cowley's step.
                    (GridMethod::thesis(), Setup { step: StepSize::Fixed(0.2 * h), ..Setup::thesis() })
                } else {
                    (GridMethod::default(), Setup::default())
                };
                let method = Method::Grid(GridMethod { spacing: h, marker_spacing: Some(ds), ..preset });
                table.measure(format_args!("{name} | {activity} | {h} | {ds}"), || {
                    Ok(list(steady(&reference(Setup { method, ..base }, activity), 80.0)?.list()))
                })?;
            }
        }
    }
    Ok(vec![table])
}
