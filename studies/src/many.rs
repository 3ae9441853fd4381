//! Cost of the methods over the number of droplets, with and without elastic solids, at the same error.
//!
//! `cargo run --release -p studies -- many` prints a table, which `--write` keeps as `docs/tables/many.csv`. Droplets
//! stand in a square lattice and swim alike, so that each errs as one alone in its cell: the error is that of the way
//! at t = 2 against the finest settings. Costs are times of a step, measured by turns, over the time that it takes in
//! the scene, in units of a forward and an inverse FFT of 120 x 120 values.

use std::cell::RefCell;
use std::time::Duration;

use anyhow::{Context, Result};
use motile::base::Region;
use motile::setup::{
    Built, DropletSetup, GridMethod, Hold, IntegralMethod, LayersMethod, Material, Method, Setup, SolidOutline,
    SolidSetup,
};
use motile_tests::validation::Table;
use motile_timing::{PlainPair, Turns};

use crate::tables::{self, Measure, Once, all_wanted, note};

/// Time spent on each number and kind of scene (seconds).
const SECONDS: f64 = 4.0;
const ACTIVITY: f64 = -2.0;
/// Side of a droplet's cell of the lattice (length).
const CELL: f64 = 3.6;
/// Droplets along a side.
const SIDES: [usize; 4] = [1, 2, 4, 8];
const TIME: f64 = 2.0;
/// Radius (length) and shear modulus (force per area) of the elastic nucleus of each droplet.
const NUCLEUS: f64 = 0.4;
const SHEAR: f64 = 1000.0;

/// A lattice of `side` x `side` droplets by a method, each with an elastic nucleus or none.
fn setup(side: usize, method: Method, nuclei: bool) -> Setup {
    let places = || (0..side * side).map(|k| [k % side, k / side].map(|j| CELL * (j as f64 + 0.5 - 0.5 * side as f64)));
    let droplet = |centre| DropletSetup { centre, ..DropletSetup::active(ACTIVITY) };
    let nucleus = |centre| SolidSetup {
        hold: Hold::Free,
        ..SolidSetup::new(
            SolidOutline::Disc { centre, radius: NUCLEUS },
            Material::NeoHookean { shear: SHEAR, bulk: 2.0 * SHEAR },
        )
    };
    Setup {
        region: Region::Box { lengths: [CELL * side as f64; 2] },
        method,
        droplets: places().map(droplet).collect(),
        solids: places().filter(|_| nuclei).map(nucleus).collect(),
        ..Setup::default()
    }
}

/// Way of one droplet (length), and steps of that run.
fn way(method: Method, nuclei: bool) -> Result<(f64, usize)> {
    let Built { mut scene, droplets, .. } = setup(1, method, nuclei).build()?;
    let droplet = *droplets.first().context("no droplet")?;
    let before = scene.observe(droplet)?.centroid;
    scene.run(TIME).go()?;
    Ok(((scene.observe(droplet)?.centroid - before).length(), scene.steps()))
}

/// Methods that are compared, with their names, and the finest settings.
fn methods(nuclei: bool) -> (Method, Vec<(String, Method)>) {
    let layers =
        |spacing| Method::Layers(LayersMethod { nodes: 48, elements: 192, ..LayersMethod::of_spacing(spacing) });
    // Solids on the grid leave no mobility correction.
    let made = |spacing| if nuclei { GridMethod::uncorrected(spacing) } else { GridMethod::of_spacing(spacing) };
    let grid = |spacing: f64| (format!("grid, h = {spacing}"), Method::Grid(made(spacing)));
    let integral = |nodes, elements| Method::Integral(IntegralMethod { nodes, elements });
    if nuclei {
        let named = |spacing: f64| (format!("layers, h = {spacing}"), layers(spacing));
        (layers(0.03), vec![named(0.1), named(0.06), grid(0.1), grid(0.06), grid(0.03)])
    } else {
        // Those of `motile::recommend`.
        let named = |nodes, elements| (format!("integrals, {nodes} nodes"), integral(nodes, elements));
        let integrals = [named(24, 96), named(48, 192), named(64, 192), named(96, 384)];
        let methods = integrals.into_iter().chain([0.1, 0.075, 0.05].map(grid)).collect();
        (integral(128, 512), methods)
    }
}

pub(crate) fn run(keep: tables::Keep) -> Result<()> {
    let counts = SIDES.map(|side| format!("cost of {}", side * side));
    let columns = format!("settings | nuclei | error in % | steps per time | {}", counts.join(" | "));
    let mut table = Table::new("FFT pairs a unit of time over the number of droplets", &columns);
    for nuclei in [false, true] {
        let (finest, methods) = methods(nuclei);
        let (exact, inside) = (Once::new(), if nuclei { "elastic" } else { "none" });
        let row = |method: Method| -> Result<(String, f64)> {
            let (found, steps) = way(method, nuclei)?;
            let (exact, rate) = (exact.get(|| Ok(way(finest, nuclei)?.0))?, steps as f64 / TIME);
            Ok((format!("{:.2} | {rate:.1}", 100.0 * (found / exact - 1.0).abs()), rate))
        };
        if !all_wanted() {
            for (name, method) in methods {
                let costs = " | ".repeat(SIDES.len());
                table.measure(format_args!("{name} | {inside}"), || Ok(row(method)?.0 + &costs))?;
            }
            continue;
        }
        let mut rows = Vec::new();
        for (name, method) in &methods {
            let name = format!("{name} | {inside}");
            let (cells, rate) = note(&table, &name, || row(*method))?;
            rows.push((format!("{name} | {cells}"), *method, rate));
        }
        for side in SIDES {
            let scenes = rows.iter().map(|(_, method, rate)| (setup(side, *method, nuclei), *rate));
            let costs = costs(scenes, SECONDS)?;
            for ((row, ..), cost) in rows.iter_mut().zip(costs) {
                *row += &format!(" | {cost:.0}");
            }
        }
        for (row, ..) in rows {
            table.row(format_args!("{row}"));
        }
    }
    keep.tables("many", "many", &[table])
}

/// Cost of a unit of time of scenes, each with its number of steps in that time, in FFT pairs: of steps by turns over
/// some seconds, once each scene has settled.
pub(crate) fn costs(scenes: impl Iterator<Item = (Setup, f64)>, seconds: f64) -> Result<Vec<f64>> {
    let mut settled = Vec::new();
    for (setup, rate) in scenes {
        let mut scene = setup.build()?.scene;
        // What is kept from step to step is there.
        (0..3).try_for_each(|_| scene.step(1.0 / rate))?;
        settled.push((scene, rate));
    }
    let rates: Vec<f64> = settled.iter().map(|(_, rate)| *rate).collect();
    let (mut pair, failed) = (PlainPair::new(120, 120), RefCell::new(None));
    let mut works: Vec<Box<dyn FnMut() + '_>> = vec![Box::new(|| pair.run())];
    for (scene, rate) in &mut settled {
        let failed = &failed;
        works.push(Box::new(move || drop(scene.step(1.0 / *rate).map_err(|error| failed.replace(Some(error))))));
    }
    let mut by_turns: Vec<&mut dyn FnMut()> = works.iter_mut().map(|work| work.as_mut() as &mut dyn FnMut()).collect();
    let turns = Turns::measure(Duration::from_secs_f64(seconds), &mut by_turns);
    drop(works);
    failed.into_inner().map_or(Ok(()), Err)?;
    Ok(rates.iter().enumerate().map(|(k, rate)| turns.least(1 + k) / turns.least(0) * rate).collect())
}
