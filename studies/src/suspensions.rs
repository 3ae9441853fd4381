//! Droplets that meet: pairs over their resolution, suspensions over activity, fraction and ratio of viscosities, when
//! trajectories part, and the methods on sixteen droplets.
//!
//! `cargo run --release -p studies -- suspensions` prints four tables, one of them with `--part`, which `--write` keeps
//! as `docs/tables/suspensions.csv`, `suspensions-2.csv` ... With `--rows FILE` each row is kept there once it is
//! found, and a study that was ended goes on behind it.

mod crowds;
mod methods;
mod pairs;
mod parting;
mod rows;

use std::f64::consts::TAU;
use std::path::PathBuf;

use anyhow::Result;
use clap::{Args, builder::PossibleValuesParser};
use motile::base::Region;
use motile::scene::gap::Repulsion;
use motile::setup::{Distribution, DropletSetup, IntegralMethod, Method, Setup, SuspensionSetup};
use motile_tests::validation::Table;
use rows::Rows;

use crate::tables;

/// Makes a table.
type Part = fn(&Flags, &mut Rows) -> Result<Table>;

/// The tables in their order: two droplets that meet, suspensions over activity, fraction and ratio of viscosities,
/// when trajectories part, the methods on sixteen droplets.
const PARTS: [(&str, Part); 4] = [
    ("pairs", |_, rows| pairs::table(rows)),
    ("crowds", crowds::table),
    ("parting", |_, rows| parting::table(rows)),
    ("methods", |_, rows| methods::table(rows)),
];

/// Droplets that meet, in pairs and in suspensions.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Droplets of a suspension
    #[arg(long, default_value_t = 200)]
    count: usize,
    /// Time that suspensions are followed
    #[arg(long, default_value_t = 20.0)]
    time: f64,
    /// One of the tables alone
    #[arg(long, value_parser = PossibleValuesParser::new(PARTS.map(|(name, _)| name)))]
    part: Option<String>,
    /// Rows that have been found, which are not computed again; new ones are added
    #[arg(long)]
    rows: Option<PathBuf>,
    #[command(flatten)]
    keep: tables::Keep,
}

/// Cells of the particles for each node.
const CELLS: usize = 4;
/// Accuracy of the flow.
const TOLERANCE: f64 = 1e-6;

/// The repulsion that nodes resolve: it holds a film as thick as their distance against the capillary pressure.
fn held(nodes: usize, activity: f64) -> Result<Repulsion> {
    let droplet = DropletSetup::active(activity);
    let concentration = droplet.particles.map_or(0.0, |particles| particles.concentration);
    Ok(Repulsion::holding(TAU / nodes as f64, droplet.tension - activity * concentration)?)
}

/// A method without a grid with so many nodes.
fn integral(nodes: usize) -> Method {
    Method::Integral(IntegralMethod { nodes, elements: CELLS * nodes })
}

/// So many droplets at random places in a box, with the repulsion that `nodes` resolve.
fn suspension(count: usize, fraction: f64, activity: f64, ratio: f64, nodes: usize) -> Result<Setup> {
    let suspension = SuspensionSetup {
        count: Some(count),
        activity: Some(Distribution::Value(activity)),
        viscosity: Some(Distribution::Value(ratio * Setup::default().viscosity)),
        ..SuspensionSetup::default()
    };
    let side = (count as f64 * suspension.mean_area() / fraction).sqrt();
    Ok(Setup {
        region: Region::Box { lengths: [side; 2] },
        method: integral(nodes),
        tolerance: Some(TOLERANCE),
        repulsion: Some(held(nodes, activity)?),
        droplets: Vec::new(),
        suspension: vec![suspension],
        ..Setup::default()
    })
}

pub(crate) fn run(flags: &Flags) -> Result<()> {
    let mut rows = Rows::open(flags.rows.as_deref())?;
    let wanted = |part: &str| flags.part.as_deref().is_none_or(|only| only == part);
    for (number, (part, table)) in PARTS.into_iter().enumerate().filter(|(_, (part, _))| wanted(part)) {
        let name = if number > 0 { format!("suspensions-{}", number + 1) } else { "suspensions".to_owned() };
        flags.keep.tables(&name, &format!("suspensions --part {part}"), &[table(flags, &mut rows)?])?;
    }
    Ok(())
}
