//! Time of one evaluation of the velocities, beside that of a pair of two-dimensional real transforms, which is what a
//! solver on a grid spends at least.

use std::{f64::consts::TAU, hint::black_box};

use boundary_integral::{
    BoundaryIntegral, Channel, FluidDomain, FreeSpace, PeriodicBox, PeriodicCalculus, Settings, TensionPlacement,
};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use ib_core::{FlowSample, Hydrodynamics, MarkerKind, Markers, Vec2};
use realfft::RealFftPlanner;

/// Droplets in rows of four with four markers a node and a tension that makes them swim.
fn markers(nodes: usize, viscosity_inside: Option<f64>, droplets: usize) -> Markers {
    let count = 4 * nodes;
    let mut markers = Markers::new();
    let mut calculus = PeriodicCalculus::new(count).expect("a valid scene");
    for droplet in 0..droplets {
        markers.push_group(count, MarkerKind::Interface { viscosity_inside });
        let range = droplet * count..(droplet + 1) * count;
        let angle = |k: usize| TAU * k as f64 / count as f64;
        for (k, position) in markers.positions[range.clone()].iter_mut().enumerate() {
            let (sin, cos) = angle(k).sin_cos();
            let (column, row) = (droplet % 4, droplet / 4);
            *position = Vec2::new(1.05 * cos + 2.6 * column as f64, sin / 1.05 + 2.6 * row as f64);
        }
        let tension: Vec<f64> = (0..count).map(|k| 1.0 + 0.5 * angle(k).cos()).collect();
        let (positions, forces) = (&markers.positions[range.clone()], &mut markers.forces[range]);
        calculus.tension_forces(positions, &tension, TensionPlacement::Markers, forces).expect("a valid scene");
    }
    markers
}

fn evaluation<D: FluidDomain>(c: &mut Criterion, name: &str, domain: D, nodes: usize, ratio: f64, droplets: usize) {
    let settings = Settings { nodes, ..Settings::default() };
    let mut solver = BoundaryIntegral::new(domain, 1.0, settings).expect("a valid scene");
    let inside = if ratio == 1.0 { None } else { Some(ratio) };
    let mut markers = markers(nodes, inside, droplets);
    let mut group = c.benchmark_group(format!("{name} droplets {droplets} ratio {ratio}"));
    let (positions, forces) = (markers.positions.clone(), markers.forces.clone());
    let mut phase = 0.0f64;
    let mut iterations = (0u32, 0u32);
    group.bench_function(BenchmarkId::from_parameter(nodes), |b| {
        b.iter(|| {
            // Shapes and forces change from evaluation to evaluation by about a part in a thousand, as they do in a run.
            phase += 0.5;
            let stretch = [1.0 + 1e-3 * phase.sin(), 1.0 + 1e-3 * (1.7 * phase).cos()];
            let pull = [1.0 + 2e-3 * (1.3 * phase).sin(), 1.0 + 2e-3 * (0.7 * phase).cos()];
            for (all, base, factors) in
                [(&mut markers.positions, &positions, stretch), (&mut markers.forces, &forces, pull)]
            {
                for (value, base) in all.iter_mut().zip(base) {
                    *value = Vec2::new(factors[0] * base.x, factors[1] * base.y);
                }
            }
            let report = solver.velocities(black_box(&mut markers)).expect("a valid scene");
            iterations = (iterations.0 + report.iterations as u32, iterations.1 + 1);
            report
        });
    });
    if iterations.1 > 0 {
        println!("iterations: {:.1}", f64::from(iterations.0) / f64::from(iterations.1));
    }
}

/// Time of a thousand samples on a square that holds the droplet.
fn samples<D: FluidDomain>(c: &mut Criterion, name: &str, domain: D) {
    let mut solver = BoundaryIntegral::new(domain, 1.0, Settings::default()).expect("a valid scene");
    let mut markers = markers(64, Some(100.0), 1);
    solver.velocities(&mut markers).expect("a valid scene");
    let points: Vec<Vec2> =
        (0..1000).map(|k| Vec2::new(0.08 * f64::from(k % 32) - 1.25, 0.08 * f64::from(k / 32) - 1.25)).collect();
    let mut out = vec![FlowSample::default(); points.len()];
    c.bench_function(&format!("{name}: a thousand samples"), |b| {
        b.iter(|| solver.sample(&markers, black_box(&points), &mut out).expect("a valid scene"));
    });
}

/// Forward and inverse real transform of a square grid, rows and columns, with the transposes.
fn transform_pair(c: &mut Criterion, n: usize) {
    let mut real = RealFftPlanner::<f64>::new();
    let (forward, inverse) = (real.plan_fft_forward(n), real.plan_fft_inverse(n));
    let mut complex = rustfft::FftPlanner::<f64>::new();
    let (down, up) = (complex.plan_fft_forward(n), complex.plan_fft_inverse(n));
    let half = n / 2 + 1;
    let mut grid: Vec<f64> = (0..n * n).map(|i| (i as f64).sin()).collect();
    let zero = num_complex::Complex64::default();
    let (mut spectrum, mut turned) = (vec![zero; half * n], vec![zero; half * n]);
    let mut scratch = vec![zero; 8 * n];
    let transpose =
        |from: &[num_complex::Complex64], to: &mut [num_complex::Complex64], rows: usize, columns: usize| {
            for row in 0..rows {
                for column in 0..columns {
                    to[column * rows + row] = from[row * columns + column];
                }
            }
        };
    c.bench_function(&format!("transform pair {n}"), |b| {
        b.iter(|| {
            for (row, out) in grid.chunks_exact_mut(n).zip(spectrum.chunks_exact_mut(half)) {
                forward.process_with_scratch(row, out, &mut scratch).expect("a valid scene");
            }
            transpose(&spectrum, &mut turned, n, half);
            down.process_with_scratch(&mut turned, &mut scratch);
            up.process_with_scratch(&mut turned, &mut scratch);
            transpose(&turned, &mut spectrum, half, n);
            let factor = 1.0 / (n * n) as f64;
            for (row, out) in spectrum.chunks_exact_mut(half).zip(grid.chunks_exact_mut(n)) {
                row[0].im = 0.0;
                row[half - 1].im = 0.0;
                inverse.process_with_scratch(row, out, &mut scratch).expect("a valid scene");
                out.iter_mut().for_each(|value| *value *= factor);
            }
            black_box(&grid);
        });
    });
}

fn benches(c: &mut Criterion) {
    for n in [120, 240] {
        transform_pair(c, n);
    }
    for nodes in [64, 128, 256] {
        for ratio in [1.0, 100.0] {
            evaluation(c, "free space", FreeSpace, nodes, ratio, 1);
            evaluation(c, "box 6", PeriodicBox::new(6.0, 6.0).expect("a valid scene"), nodes, ratio, 1);
            evaluation(c, "channel 12 x 3", Channel::new(12.0, 3.0).expect("a valid scene"), nodes, ratio, 1);
        }
    }
    samples(c, "free space", FreeSpace);
    samples(c, "box 6", PeriodicBox::new(6.0, 6.0).expect("a valid scene"));
    samples(c, "channel 12 x 3", Channel::new(12.0, 3.0).expect("a valid scene"));
    for ratio in [1.0, 100.0] {
        evaluation(c, "free space", FreeSpace, 64, ratio, 10);
        evaluation(c, "box 10.4", PeriodicBox::new(10.4, 10.4).expect("a valid scene"), 64, ratio, 10);
    }
}

fn config() -> Criterion {
    Criterion::default()
        .sample_size(20)
        .warm_up_time(std::time::Duration::from_millis(200))
        .measurement_time(std::time::Duration::from_millis(600))
        .without_plots()
}

criterion_group! { name = all; config = config(); targets = benches }
criterion_main!(all);
