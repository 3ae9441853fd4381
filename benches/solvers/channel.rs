//! Solvers of a channel, in units of one pass of real transforms in x, forward and inverse, of the same size in the
//! same run.

use criterion::{BenchmarkId, Criterion};
use motile::stokes_grid::{ChannelStokes, Grid, ProjectionStokes, WallTreatment};
use motile_timing::{PlainPair, print_ratios};

use crate::solve;

const SIZES: [(usize, usize); 4] = [(240, 40), (240, 100), (480, 80), (960, 400)];

fn projection(grid: Grid, treatment: WallTreatment) -> ProjectionStokes {
    let mut solver = ProjectionStokes::new(grid, 100.0).expect("a solver");
    solver.set_wall_treatment(treatment).expect("a channel");
    solver
}

pub(crate) fn benches(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("channel");
    for (nx, ny) in SIZES {
        let size = format!("{nx}x{ny}");
        let grid = Grid::channel(nx, ny, 0.05).expect("a channel");
        let mut plain = PlainPair::new(nx, ny);
        let mut streamfunction = solve(ChannelStokes::new(grid, 100.0).expect("a solver"));
        let mut exact = solve(projection(grid, WallTreatment::Exact));
        let mut lagged = solve(projection(grid, WallTreatment::Lagged));
        group.bench_function(BenchmarkId::new("x transforms", &size), |b| b.iter(|| plain.rows()));
        group.bench_function(BenchmarkId::new("streamfunction", &size), |b| b.iter(&mut streamfunction));
        group.bench_function(BenchmarkId::new("projection", &size), |b| b.iter(&mut exact));
        group.bench_function(BenchmarkId::new("projection, lagged walls", &size), |b| b.iter(&mut lagged));
        print_ratios(
            &size,
            &mut [
                ("x transforms", &mut || plain.rows()),
                ("streamfunction", &mut streamfunction),
                ("projection", &mut exact),
                ("projection, lagged walls", &mut lagged),
            ],
        );
    }
    group.finish();
}
