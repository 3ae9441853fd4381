//! Time of one evaluation of the velocities, in units of a pair of two-dimensional real transforms, which is what a
//! solver on a grid spends at least.
//!
//! `cargo bench --bench boundary_integral` prints a table. All rows and the transforms are timed in turns, and the
//! fastest of many turns counts, so that other work of the machine does not matter much.

use std::{cell::Cell, f64::consts::TAU, hint::black_box, rc::Rc, time::Instant};

use motile::base::{Drive, FlowSample, Region, Vec2};
use motile::boundary_integrals::{BoundaryIntegral, PeriodicCalculus, Settings, TensionPlacement};
use motile::scene::{Hydrodynamics, MarkerKind, Markers};
use motile_timing::PlainPair;

/// How often each row is timed.
const TURNS: usize = 200;

/// Droplets in rows of four with four markers a node and a tension that makes them swim.
fn markers(nodes: usize, viscosity_inside: Option<f64>, droplets: usize) -> Markers {
    let count = 4 * nodes;
    let mut markers = Markers::new();
    let mut calculus = PeriodicCalculus::new(count).expect("a valid scene");
    for droplet in 0..droplets {
        markers.push_group(count, MarkerKind::Interface { viscosity_inside });
        let range = droplet * count..(droplet + 1) * count;
        let angle = |k: usize| TAU * k as f64 / count as f64;
        for (k, position) in markers.positions_mut()[range.clone()].iter_mut().enumerate() {
            let (sin, cos) = angle(k).sin_cos();
            let (column, row) = (droplet % 4, droplet / 4);
            *position = Vec2::new(1.05 * cos + 2.6 * column as f64, sin / 1.05 + 2.6 * row as f64);
        }
        let tension: Vec<f64> = (0..count).map(|k| 1.0 + 0.5 * angle(k).cos()).collect();
        let [positions, forces, _] = markers.lists_mut();
        let (positions, forces) = (&positions[range.clone()], &mut forces[range]);
        calculus.tension_forces(positions, &tension, TensionPlacement::Points, forces).expect("a valid scene");
    }
    markers
}

/// Program to be timed, with its name.
struct Row {
    name: String,
    run: Box<dyn FnMut()>,
    /// Iterations and evaluations.
    work: Rc<Cell<[f64; 2]>>,
    /// Fastest time (seconds).
    best: f64,
}

impl Row {
    fn new(name: String, work: Rc<Cell<[f64; 2]>>, run: impl FnMut() + 'static) -> Self {
        Self { name, run: Box::new(run), work, best: f64::INFINITY }
    }

    /// Runs for about a millisecond.
    fn time(&mut self) {
        let clock = Instant::now();
        let mut count = 0;
        while count == 0 || clock.elapsed().as_secs_f64() < 1e-3 {
            (self.run)();
            count += 1;
        }
        self.best = self.best.min(clock.elapsed().as_secs_f64() / f64::from(count));
    }
}

fn evaluation(name: &str, region: Region, nodes: usize, ratio: f64, droplets: usize) -> Row {
    let settings = Settings { nodes, ..Settings::default() };
    let mut solver = BoundaryIntegral::new(region, 1.0, settings).expect("a valid scene");
    let inside = if ratio == 1.0 { None } else { Some(ratio) };
    let mut markers = markers(nodes, inside, droplets);
    let (positions, forces) = (markers.positions().to_vec(), markers.forces().to_vec());
    let work = Rc::new(Cell::new([0.0; 2]));
    let counted = Rc::clone(&work);
    let mut phase = 0.0f64;
    Row::new(format!("{name} | {droplets} | {ratio} | {nodes}"), work, move || {
        // Shapes and forces change from evaluation to evaluation by about a part in a thousand, as they do in a run.
        phase += 0.5;
        let stretch = [1.0 + 1e-3 * phase.sin(), 1.0 + 1e-3 * (1.7 * phase).cos()];
        let pull = [1.0 + 2e-3 * (1.3 * phase).sin(), 1.0 + 2e-3 * (0.7 * phase).cos()];
        let [places, pulls, _] = markers.lists_mut();
        for (all, base, factors) in [(places, &positions, stretch), (pulls, &forces, pull)] {
            for (value, base) in all.iter_mut().zip(base) {
                *value = Vec2::new(factors[0] * base.x, factors[1] * base.y);
            }
        }
        let report = solver.velocities(black_box(&mut markers)).expect("a valid scene");
        let [iterations, evaluations] = counted.get();
        counted.set([iterations + report.iterations as f64, evaluations + 1.0]);
    })
}

/// A thousand samples on a square that holds the droplet.
fn samples(name: &str, region: Region) -> Row {
    let mut solver = BoundaryIntegral::new(region, 1.0, Settings::default()).expect("a valid scene");
    let mut markers = markers(64, Some(100.0), 1);
    solver.velocities(&mut markers).expect("a valid scene");
    let points: Vec<Vec2> =
        (0..1000).map(|k| Vec2::new(0.08 * f64::from(k % 32) - 1.25, 0.08 * f64::from(k / 32) - 1.25)).collect();
    let mut out = vec![FlowSample::default(); points.len()];
    Row::new(format!("{name}, a thousand samples | 1 | 100 | 64"), Rc::default(), move || {
        solver.sample(&markers, black_box(&points), &mut out).expect("a valid scene");
    })
}

/// A forward and an inverse real transform of a square grid.
fn transform_pair(n: usize) -> Row {
    let mut pair = PlainPair::new(n, n);
    Row::new(format!("transforms, {n} x {n} | | | "), Rc::default(), move || pair.run())
}

fn main() {
    let square = |side| Region::Box { lengths: [side, side] };
    let channel = || Region::Channel { length: 12.0, width: 3.0, drive: Drive::default() };
    let mut rows = vec![transform_pair(120), transform_pair(240)];
    for nodes in [64, 128, 256] {
        for ratio in [1.0, 100.0] {
            rows.push(evaluation("free space", Region::Plane, nodes, ratio, 1));
            rows.push(evaluation("box 6", square(6.0), nodes, ratio, 1));
            rows.push(evaluation("channel 12 x 3", channel(), nodes, ratio, 1));
        }
    }
    for ratio in [1.0, 100.0] {
        rows.push(evaluation("free space", Region::Plane, 64, ratio, 10));
        rows.push(evaluation("box 10.4", square(10.4), 64, ratio, 10));
    }
    rows.extend([
        samples("free space", Region::Plane),
        samples("box 6", square(6.0)),
        samples("channel 12 x 3", channel()),
    ]);
    for _ in 0..TURNS {
        rows.iter_mut().for_each(Row::time);
    }
    println!(
        "| scene | droplets | ratio | nodes | microseconds | pairs at 120 x 120 | pairs at 240 x 240 | iterations |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    let pairs = [rows[0].best, rows[1].best];
    for Row { name, work, best, .. } in &rows {
        let [iterations, evaluations] = work.get();
        let iterations = if iterations > 0.0 { format!("{:.1}", iterations / evaluations) } else { String::new() };
        let [small, large] = pairs.map(|pair| best / pair);
        println!("| {name} | {:.1} | {small:.2} | {large:.3} | {iterations} |", best * 1e6);
    }
}
