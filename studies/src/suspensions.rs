//! Droplets that meet: pairs over their resolution, suspensions over fraction and ratio of viscosities from several
//! starts, when trajectories part, and the methods on sixteen droplets.
//!
//! `cargo run --release -p studies -- suspensions` prints five tables, `--part` some of them, which `--write` keeps as
//! `docs/tables/suspensions-PART.csv`.

mod crowds;
mod methods;
mod pairs;
mod parting;

use std::f64::consts::TAU;

use anyhow::Result;
use clap::{Args, builder::PossibleValuesParser};
use motile::base::Region;
use motile::scene::gap::Repulsion;
use motile::setup::{Distribution, DropletSetup, IntegralMethod, Method, Setup, SuspensionSetup};
use motile_tests::validation::Table;

use crate::tables;

/// Makes tables.
type Part = fn(&Flags) -> Result<Vec<Table>>;

/// The parts: two droplets that meet, suspensions over fraction and ratio of viscosities from several starts, when
/// trajectories part, the methods on sixteen droplets.
const PARTS: [(&str, Part); 4] = [
    ("pairs", |_| Ok(vec![pairs::table()?])),
    ("crowds", crowds::tables),
    ("parting", |_| Ok(vec![parting::table()?])),
    ("methods", |_| Ok(vec![methods::table()?])),
];

/// Droplets that meet, in pairs and in suspensions.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Random starts of each suspension
    #[arg(long, default_value_t = 8)]
    seeds: u64,
    /// One part alone
    #[arg(long, value_parser = PossibleValuesParser::new(PARTS.map(|(name, _)| name)))]
    part: Option<String>,
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
    let wanted = |part: &str| flags.part.as_deref().is_none_or(|only| only == part);
    for (part, tables) in PARTS.into_iter().filter(|(part, _)| wanted(part)) {
        let (name, command) = (format!("suspensions-{part}"), format!("suspensions --part {part}"));
        flags.keep.tables(&name, &command, &tables(flags)?)?;
    }
    Ok(())
}
