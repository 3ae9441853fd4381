//! Cost and memory against size.
//!
//! `cargo run --release -p studies -- scaling` times the solver of a periodic box from 64 to 2048 cells squared, and
//! bodies of 100 to 100,000 markers, prints time and memory per cell and per marker, and writes `scaling.json` to
//! `out/scaling/`. A minute; where the tables bend, the data no longer fit into a cache. Times are those of the turn
//! least disturbed.

use std::hint::black_box;
use std::path::PathBuf;
use std::time::Duration;

use allocation_counter::measure;
use anyhow::{Context, Result};
use clap::Args;
use motile::base::Vec2;
use motile::elastic_solids::Solid;
use motile::elastic_solids::mesh::fitted_strip;
use motile::ib_core::{BSpline, ImmersedBoundary, Transfer};
use motile::scene::{Body, Hydrodynamics};
use motile::stokes_grid::{Grid, PeriodicStokes, StaggeredField, StokesSolver};
use motile_cli::run::say;
use motile_examples::positive;
use motile_timing::{PlainPair, Turns};
use serde_json::{Value, json};

/// Cost and memory against size.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Time spent on each size (seconds)
    #[arg(long, default_value_t = 1.5, value_parser = positive)]
    seconds: f64,
    /// Directory of the results
    #[arg(long, value_name = "DIRECTORY", default_value = "out/scaling")]
    out: PathBuf,
}

/// Cells of a side.
const CELLS: [usize; 11] = [64, 96, 128, 192, 256, 384, 512, 768, 1024, 1536, 2048];
/// Markers, about.
const MARKERS: [usize; 10] = [100, 200, 500, 1000, 2000, 5000, 10_000, 20_000, 50_000, 100_000];
/// Markers to a cell along each axis, of bodies that fill an area.
const SPACING: f64 = 1.0;
/// Width over height of the strips of markers.
const ASPECT: f64 = 4.0;

pub(crate) fn run(flags: &Flags) -> Result<()> {
    motile_cli::run::make_directory(&flags.out)?;
    let budget = Duration::from_secs_f64(flags.seconds);
    say(format_args!(
        "{:>6} {:>10} {:>10} {:>8} {:>10} {:>12} {:>10}",
        "cells", "pair us", "solve us", "pairs", "ns/cell", "bytes/cell", "total MB"
    ));
    let cells = CELLS.into_iter().map(|n| solver(n, budget)).collect::<Result<Vec<_>>>()?;
    say(format_args!(
        "\n{:>8} {:>8} {:>10} {:>10} {:>12} {:>10} {:>13}",
        "markers", "grid", "locate ns", "spread ns", "interpolate", "forces ns", "bytes/marker"
    ));
    let markers = MARKERS.into_iter().map(|count| body(count, budget)).collect::<Result<Vec<_>>>()?;
    let path = flags.out.join("scaling.json");
    let text = format!("{:#}\n", json!({ "cells": cells, "markers": markers }));
    std::fs::write(&path, text).with_context(|| format!("writing {}", path.display()))
}

/// A solve of an n x n box, beside the bare transforms.
fn solver(n: usize, budget: Duration) -> Result<Value> {
    let grid = Grid::periodic(n, n, 0.05)?;
    let mut solver = None;
    let used = measure(|| solver = PeriodicStokes::new(grid, 1.0).ok());
    let mut solver = solver.context("a solver")?;
    let mut force = StaggeredField::zeros(grid);
    force.components_mut().0.iter_mut().enumerate().for_each(|(k, f)| *f = (k as f64).sin());
    let mut velocity = StaggeredField::zeros(grid);
    let mut pair = PlainPair::new(n, n);
    let mut bare = || pair.run();
    let mut solve = || drop(black_box(solver.solve(black_box(&force), &mut velocity)));
    let turns = Turns::measure(budget, &mut [&mut bare, &mut solve]);
    let cells = (n * n) as f64;
    // Force and velocity, two components each, beside what the solver keeps.
    let bytes = used.bytes_current as f64 / cells + 4.0 * 8.0;
    let (pair, time) = (turns.least(0), turns.least(1));
    let ratio = time / pair;
    say(format_args!(
        "{n:>6} {:>10.1} {:>10.1} {ratio:>8.2} {:>10.2} {bytes:>12.1} {:>10.2}",
        1e6 * pair,
        1e6 * time,
        1e9 * time / cells,
        1e-6 * bytes * cells
    ));
    Ok(json!({
        "n": n,
        "pair_us": 1e6 * pair,
        "solve_us": 1e6 * time,
        "solve_pairs": ratio,
        "ns_per_cell": 1e9 * time / cells,
        "bytes_per_cell": bytes,
    }))
}

/// A strip of springs of about `count` points, in a box it fills a good part of.
fn body(count: usize, budget: Duration) -> Result<Value> {
    let h = 0.05;
    let height = h * SPACING * (count as f64 / ASPECT).sqrt();
    let columns = (ASPECT * height / h).round().max(8.0);
    let length = columns * h;
    let grid = Grid::periodic(columns as usize, columns as usize, h)?;
    let mesh = fitted_strip(Vec2::new(-0.5 * length, -0.5 * height), [length, height], SPACING * h)?;
    let (mut solid, mut transfer) = (None, None);
    let mut density = StaggeredField::zeros(grid);
    let velocity = StaggeredField::zeros(grid);
    let view = ImmersedBoundary::new(PeriodicStokes::new(grid, 1.0)?, BSpline::<4>).fluid_view();
    let mut forces = Vec::new();
    let mut positions = Vec::new();
    let used = measure(|| {
        solid = Solid::springs(mesh, 1.0).ok();
        if let Some(solid) = &solid {
            positions = vec![Vec2::ZERO; solid.marker_count()];
            forces = vec![Vec2::new(1.0, 0.5); solid.marker_count()];
            solid.write_markers(&mut positions);
        }
        let mut new = Transfer::new(grid, BSpline::<4>);
        new.locate(&positions);
        transfer = Some(new);
    });
    let (Some(mut solid), Some(transfer)) = (solid, transfer) else { anyhow::bail!("a body") };
    let markers = positions.len();
    let mut velocities = vec![Vec2::ZERO; markers];
    let (fixed, other) = (transfer.clone(), forces.clone());
    let mut moving = transfer.clone();
    let mut locate = || moving.locate(black_box(&positions));
    let mut spread = || drop(fixed.spread(&other, black_box(&mut density)));
    let mut interpolate = || drop(transfer.interpolate(black_box(&velocity), &mut velocities));
    let mut force = || drop(black_box(solid.write_forces(&view, &mut forces)));
    let turns = Turns::measure(budget, &mut [&mut locate, &mut spread, &mut interpolate, &mut force]);
    let per_marker = |work: usize| 1e9 * turns.least(work) / markers as f64;
    let [locate, spread, interpolate, force] = [0, 1, 2, 3].map(per_marker);
    let bytes = used.bytes_current as f64 / markers as f64;
    say(format_args!(
        "{markers:>8} {:>8} {locate:>10.1} {spread:>10.1} {interpolate:>12.1} {force:>10.1} {bytes:>13.0}",
        columns as usize
    ));
    Ok(json!({
        "markers": markers, "grid": columns, "locate_ns": locate, "spread_ns": spread, "interpolate_ns": interpolate,
        "forces_ns": force, "bytes_per_marker": bytes,
    }))
}
