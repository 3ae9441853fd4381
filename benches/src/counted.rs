//! Kernels and steps whose instructions are counted. They are compiled as users compile them, which programs that only
//! call the libraries are not.

use std::hint::black_box;

use anyhow::Result;
use motile::active_interface::Curve;
use motile::base::Vec2;
use motile::boundary_integrals::{PeriodicCalculus, TensionPlacement};
use motile::elastic_solids::mesh::fitted_strip;
use motile::elastic_solids::{ChannelShape, NeoHookean, Solid};
use motile::ib_core::{AnyKernel, ImmersedBoundary, Transfer};
use motile::prelude::*;
use motile::scene::{Body, Hydrodynamics};
use motile::setup::{FlowSetup, Material, SolidSetup};
use motile::stokes_grid::{ChannelStokes, Grid, PeriodicStokes, StaggeredField, StokesSolver};

/// Time step of scenes: steps alike.
const DT: f64 = 1e-4;

/// Does the work that valgrind counts: it looks for the name of this function.
///
/// # Errors
/// Returns the error of the work.
#[inline(never)]
pub fn counted(work: &mut dyn FnMut() -> Result<()>) -> Result<()> {
    black_box(work())
}

/// Once to warm up, once counted.
fn count(mut work: impl FnMut() -> Result<()>) -> Result<()> {
    work()?;
    counted(&mut work)
}

fn solve(mut solver: impl StokesSolver) -> Result<()> {
    let grid = *solver.grid();
    let wave = |count: usize| (0..count).map(|i| ((i * i) as f64).sin()).collect();
    let (x, y) = (wave(grid.nx() * grid.ny()), wave(grid.nx() * grid.node_rows()));
    let (force, mut velocity) = (StaggeredField::from_components(grid, x, y)?, StaggeredField::zeros(grid));
    count(|| {
        solver.solve(black_box(&force), &mut velocity)?;
        Ok(())
    })
}

fn transfer(spreads: bool) -> Result<()> {
    let grid = Grid::periodic(120, 120, 0.05)?;
    let positions = Curve::circle(1.0)?.markers(400)?;
    let mut transfer = Transfer::new(grid, AnyKernel::BSpline4);
    transfer.locate(&positions);
    let (mut field, mut values) = (StaggeredField::zeros(grid), vec![Vec2::new(1.0, 2.0); positions.len()]);
    count(|| {
        if spreads {
            transfer.spread(black_box(&values), &mut field)?;
        } else {
            transfer.interpolate(black_box(&field), &mut values)?;
        }
        Ok(())
    })
}

fn forces() -> Result<()> {
    let mesh = fitted_strip(Vec2::new(-3.0, -1.0), [6.0, 2.0], 0.05)?;
    let mut solid = Solid::hyperelastic(mesh, NeoHookean::new(1.0, 3.0)?);
    let flow = ImmersedBoundary::new(PeriodicStokes::new(Grid::periodic(60, 60, 0.1)?, 1.0)?, AnyKernel::BSpline4);
    let (view, mut out) = (flow.fluid_view(), vec![Vec2::ZERO; solid.marker_count()]);
    count(|| Ok(solid.write_forces(black_box(&view), &mut out)?))
}

fn derivatives() -> Result<()> {
    let points = Curve::circle(1.0)?.markers(288)?;
    let (tension, mut out) = (vec![1.0; points.len()], vec![Vec2::ZERO; points.len()]);
    let mut calculus = PeriodicCalculus::new(points.len())?;
    let placement = TensionPlacement::Points;
    count(|| Ok(calculus.tension_forces(black_box(&points), &tension, placement, &mut out)?))
}

/// Three steps of a scene.
fn steps(setup: &Setup) -> Result<()> {
    let mut scene = setup.build()?.scene;
    count(|| {
        for _ in 0..3 {
            scene.step(DT)?;
        }
        Ok(())
    })
}

fn channel() -> Region {
    Region::Channel { length: 6.0, width: 3.0, drive: Drive::ZeroGradient }
}

fn on_grid(region: Region) -> Setup {
    Setup { region, method: Method::Grid(GridMethod::of_spacing(0.1)), ..Setup::default() }
}

fn by_layers(region: Region) -> Setup {
    Setup { region, method: Method::Layers(LayersMethod::of_spacing(0.1)), ..Setup::default() }
}

fn viscous(setup: Setup) -> Setup {
    let droplets = vec![DropletSetup { viscosity: Some(1e3), ..DropletSetup::default() }];
    Setup { droplets, ..setup }
}

fn in_flow(flow: FlowSetup) -> Setup {
    Setup { region: Region::Plane, flow, ..Setup::default() }
}

/// Work to count.
pub type Work = fn() -> Result<()>;

/// Kernels and steps by name. Each calls [`counted`] once, after it has warmed up.
pub const WORKS: [(&str, Work); 14] = [
    ("periodic Stokes solve, 120 x 120", || solve(PeriodicStokes::new(Grid::periodic(120, 120, 0.05)?, 1.0)?)),
    ("channel Stokes solve, 120 x 60", || solve(ChannelStokes::new(Grid::channel(120, 60, 0.05)?, 1.0)?)),
    ("spread 400 markers", || transfer(true)),
    ("interpolate at 400 markers", || transfer(false)),
    ("forces of a neo-Hookean solid", forces),
    ("tension forces of a curve, 288 points", derivatives),
    ("three steps, box on a grid", || steps(&on_grid(Region::Box { lengths: [6.0, 6.0] }))),
    ("three steps, ratio 10 in a channel by layers", || steps(&viscous(by_layers(channel())))),
    ("three steps, elastic channel", || {
        let shape = ChannelShape::Straight { width: 2.4 };
        let solids = SolidSetup::walls(&shape, &Material::Springs { shear: 100.0 });
        let region = Region::Channel { length: 6.0, width: 5.4, drive: Drive::ZeroGradient };
        steps(&Setup { solids, ..by_layers(region) })
    }),
    ("three steps, box without a grid", || steps(&Setup::default())),
    ("three steps, channel without a grid", || steps(&Setup { region: channel(), ..Setup::default() })),
    ("three steps, ratio 10 without a grid", || steps(&viscous(Setup::default()))),
    ("three steps, plane without a grid", || steps(&in_flow(FlowSetup::default()))),
    ("three steps, plane without a grid, in a shear", || {
        steps(&in_flow(FlowSetup { shear: 1.0, ..FlowSetup::default() }))
    }),
];
