//! Work at markers, in units of the bare transforms of the grid measured by turns in the same run: spreading,
//! interpolation, forces of a droplet and of solids. `cargo bench --bench markers`.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use motile::base::Vec2;
use motile::elastic_solids::mesh::fitted_strip;
use motile::elastic_solids::{NeoHookean, Solid};
use motile::ib_core::{AnyKernel, ImmersedBoundary, Transfer};
use motile::scene::{Body, Hydrodynamics};
use motile::setup::{GridMethod, Method, Setup};
use motile::stokes_grid::{Grid, PeriodicStokes, StaggeredField};
use motile_timing::{PlainPair, print_ratios};

/// A body in a box of n x n cells.
fn body(c: &mut Criterion, name: &str, n: usize, mut body: impl Body) {
    let grid = Grid::periodic(n, n, 6.0 / n as f64).expect("a good grid");
    let solver = PeriodicStokes::new(grid, 1.0).expect("a good viscosity");
    let view = ImmersedBoundary::new(solver, AnyKernel::BSpline4).fluid_view();
    let count = body.marker_count();
    let (mut positions, mut forces) = (vec![Vec2::ZERO; count], vec![Vec2::ZERO; count]);
    body.write_markers(&mut positions);
    body.write_forces(&view, &mut forces).expect("a good state");
    let given = forces.clone();
    let (mut density, velocity) = (StaggeredField::zeros(grid), StaggeredField::zeros(grid));
    let mut velocities = vec![Vec2::ZERO; count];
    let mut transfer = Transfer::new(grid, AnyKernel::BSpline4);
    transfer.locate(&positions);
    let (spreading, interpolating) = (transfer.clone(), transfer.clone());
    let mut pair = PlainPair::new(n, n);
    let mut pair = || pair.run();
    let mut force = || body.write_forces(black_box(&view), &mut forces).expect("a good state");
    let mut locate = || transfer.locate(black_box(&positions));
    let mut spread = || spreading.spread(black_box(&given), &mut density).expect("lists that fit");
    let mut interpolate = || interpolating.interpolate(black_box(&velocity), &mut velocities).expect("lists that fit");
    let mut group = c.benchmark_group(format!("{name}, {count} markers, {n} x {n}"));
    group.bench_function("forces", |b| b.iter(&mut force));
    group.bench_function("locate", |b| b.iter(&mut locate));
    group.bench_function("spread", |b| b.iter(&mut spread));
    group.bench_function("interpolate", |b| b.iter(&mut interpolate));
    group.finish();
    print_ratios(
        &format!("{name}, {count} markers, {n} x {n}"),
        &mut [
            ("pair", &mut pair),
            ("forces", &mut force),
            ("locate", &mut locate),
            ("spread", &mut spread),
            ("interpolate", &mut interpolate),
        ],
    );
}

fn markers(c: &mut Criterion) {
    for n in [120, 240, 480] {
        let spacing = 6.0 / n as f64;
        let setup = Setup { method: Method::Grid(GridMethod::of_spacing(spacing)), ..Setup::default() };
        body(c, "droplet", n, setup.droplet(&setup.droplets[0]).expect("a good droplet"));
        let mesh = || fitted_strip(Vec2::new(-3.0, -1.0), [6.0, 2.0], spacing).expect("a good mesh");
        body(c, "springs", n, Solid::springs(mesh(), 1.0).expect("a good modulus"));
        body(c, "neo-Hookean", n, Solid::hyperelastic(mesh(), NeoHookean::new(1.0, 3.0).expect("good moduli")));
    }
}

fn short() -> Criterion {
    let time = Duration::from_millis(400);
    Criterion::default().sample_size(20).warm_up_time(Duration::from_millis(100)).measurement_time(time)
}

criterion_group! {
    name = benches;
    config = short();
    targets = markers
}
criterion_main!(benches);
