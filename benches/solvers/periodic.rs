//! Solvers of a periodic box, in units of one forward and one inverse real transform of the same size in the same run.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion};
use motile::stokes_grid::{Grid, PeriodicStokes, ProjectionStokes, RealFft2, Symbol};
use motile_timing::{PlainPair, print_ratios};

use crate::solve;

const SIZES: [usize; 7] = [120, 128, 240, 256, 480, 512, 1024];

/// The forward and inverse transform of the library, the columns changed while they are in the cache.
fn own_pair(n: usize) -> impl FnMut() {
    let mut transform = RealFft2::new(n, n).expect("a size");
    let identity = Symbol::new(n, n, |_, _| 1.0).expect("a size");
    let space: Vec<f64> = (0..n * n).map(|i| ((i * i) as f64).sin()).collect();
    let mut back = space.clone();
    move || {
        let rows = |j: usize| j * n..(j + 1) * n;
        let input = |j: usize, row: &mut [f64]| row.copy_from_slice(&space[rows(j)]);
        let done = transform.filter(&identity, input, |j, row| back[rows(j)].copy_from_slice(row));
        done.expect("a symbol of this size");
        black_box(&back);
    }
}

pub(crate) fn benches(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("periodic");
    for n in SIZES {
        let size = format!("{n}x{n}");
        let grid = Grid::periodic(n, n, 0.05).expect("a box");
        let mut plain = PlainPair::new(n, n);
        let mut own = own_pair(n);
        let mut streamfunction = solve(PeriodicStokes::new(grid, 100.0).expect("a solver"));
        let mut projection = solve(ProjectionStokes::new(grid, 100.0).expect("a solver"));
        group.bench_function(BenchmarkId::new("plain pair", &size), |b| b.iter(|| plain.run()));
        group.bench_function(BenchmarkId::new("own pair", &size), |b| b.iter(&mut own));
        group.bench_function(BenchmarkId::new("streamfunction", &size), |b| b.iter(&mut streamfunction));
        group.bench_function(BenchmarkId::new("projection", &size), |b| b.iter(&mut projection));
        print_ratios(
            &size,
            &mut [
                ("plain pair", &mut || plain.run()),
                ("own pair", &mut own),
                ("streamfunction", &mut streamfunction),
                ("projection", &mut projection),
            ],
        );
    }
    group.finish();
}
