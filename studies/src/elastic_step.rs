//! Where the time of a step goes between elastic walls.
//!
//! `cargo run --release -p studies -- elastic_step` times, for walls of 17,000 points on a grid of 240 x 100 cells (or
//! `--spacing`), the elastic forces, the transfer between points and grid, and the Stokes solve, one after another on
//! the state of a running scene, and prints the median of many; `--write` keeps it as `docs/tables/elastic-step.csv`.

use std::time::Instant;

use anyhow::Result;
use clap::Args;
use motile::base::Region;
use motile::base::{Drive, Vec2};
use motile::elastic_solids::ChannelShape;
use motile::elastic_solids::Moduli;
use motile::ib_core::{AnyKernel, Transfer};
use motile::scene::{Body, Hydrodynamics};
use motile::setup::{Built, DropletSetup, LayersMethod, Material, Method, Setup, SolidSetup};
use motile::stokes_grid::{ChannelStokes, Grid, StaggeredField, StokesSolver};
use motile_examples::positive;
use motile_tests::validation::Table;

use crate::tables;

/// Times the parts of a step between elastic walls.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Grid spacing h (R0)
    #[arg(long, default_value_t = 0.05, value_parser = positive, allow_hyphen_values = true)]
    spacing: f64,
    /// Spacing of the points of the walls (R0); without it that of the grid
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    mesh_spacing: Option<f64>,
    /// Repetitions
    #[arg(long, default_value_t = 200)]
    repetitions: usize,
    #[command(flatten)]
    keep: tables::Keep,
}

pub(crate) fn run(flags: &Flags) -> Result<()> {
    let [lx, height] = [12.0, 5.0];
    let shear = Moduli::from_thesis_spring_constant(1e5)?.shear();
    let walls = SolidSetup::walls(&ChannelShape::Straight { width: 2.0 }, &Material::Springs { shear });
    let setup = Setup {
        region: Region::Channel { length: lx, width: height, drive: Drive::ZeroGradient },
        method: Method::Layers(LayersMethod::of_spacing(flags.spacing)),
        droplets: vec![DropletSetup::active(-4.0)],
        solids: walls.into_iter().map(|wall| SolidSetup { mesh_spacing: flags.mesh_spacing, ..wall }).collect(),
        ..Setup::default()
    };
    let Built { mut scene, solids: walls, .. } = setup.build()?;
    (0..10).try_for_each(|_| scene.step(0.01))?;
    let view = scene.system().hydrodynamics().fluid_view();
    let markers = scene.system_mut().evaluate()?.clone();

    let cells = [lx, height].map(|length| (length / flags.spacing).round() as usize);
    let grid = Grid::channel(cells[0], cells[1], flags.spacing)?;
    let mut solver = ChannelStokes::new(grid, view.viscosity)?;
    let mut transfer = Transfer::new(grid, AnyKernel::BSpline4);
    let (mut density, mut velocity) = (StaggeredField::zeros(grid), StaggeredField::zeros(grid));
    let mut velocities = vec![Vec2::ZERO; markers.len()];

    let mut forces = vec![Vec2::ZERO; markers.len()];
    let title = format!(
        "Time of the parts of a step between elastic walls, {} x {} cells, {} markers, one core",
        cells[0],
        cells[1],
        markers.len()
    );
    let mut table = Table::new(&title, &["part", "ms"]);
    let mut median = |name: &str, work: &mut dyn FnMut() -> Result<()>| -> Result<()> {
        let mut times = Vec::with_capacity(flags.repetitions);
        for _ in 0..flags.repetitions {
            let start = Instant::now();
            work()?;
            times.push(start.elapsed().as_secs_f64() * 1e3);
        }
        times.sort_by(f64::total_cmp);
        let value = times[times.len() / 2];
        table.push([name.to_owned(), format!("{value:.3}")]);
        Ok(())
    };
    median("elastic forces", &mut || {
        for wall in &walls {
            let wall = scene.body_mut(*wall)?;
            let count = wall.marker_count();
            wall.write_forces(&view, &mut forces[..count])?;
        }
        Ok(())
    })?;
    median("places", &mut || {
        transfer.locate(markers.positions());
        Ok(())
    })?;
    median("spread", &mut || {
        density.fill(0.0);
        transfer.spread(markers.forces(), &mut density)?;
        Ok(())
    })?;
    median("Stokes solve", &mut || Ok(solver.solve(&density, &mut velocity).map(|_| ())?))?;
    median("interpolate", &mut || {
        transfer.interpolate(&velocity, &mut velocities)?;
        Ok(())
    })?;
    median("whole step of two", &mut || Ok(scene.step(1e-3)?))?;
    let mesh = flags.mesh_spacing.map(|spacing| format!(" --mesh-spacing {spacing}")).unwrap_or_default();
    let command = format!("elastic_step --spacing {}{mesh}", flags.spacing);
    flags.keep.tables("elastic-step", &command, &["crates/elastic-solids", "studies/src/elastic_step.rs"], &[table])
}
