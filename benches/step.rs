//! One step of each kind of scene, in units of the bare transforms of its grid measured by turns in the same run:
//! `cargo bench --bench step`.
//!
//! Without a grid the unit is the transform of the grid of spacing 0.05 that would do the same.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use motile::elastic_solids::Moduli;
use motile::ib_core::Scene;
use motile::stokes_grid::Drive;
use motile::{AnyFlow, ContrastMethod, ElasticChannel, Method, Swimmer};
use motile_timing::{PlainPair, print_ratios};

/// A step small enough that thousands of them stay in the same regime.
const DT: f64 = 1e-4;

fn step(c: &mut Criterion, name: &str, [nx, ny]: [usize; 2], scene: Scene<AnyFlow>) {
    let mut scene = scene;
    scene.step(DT).expect("a good scene");
    let mut step = || black_box(&mut scene).step(DT).expect("a good scene");
    c.bench_function(name, |b| b.iter(&mut step));
    let mut pair = PlainPair::new(nx, ny);
    print_ratios(name, &mut [("pair", &mut || pair.run()), ("step", &mut step)]);
}

fn grid(lengths: [f64; 2], spacing: f64) -> (Swimmer, [usize; 2]) {
    let swimmer = Swimmer { method: Method::ImmersedBoundary, lengths, spacing, ..Swimmer::default() };
    (swimmer, lengths.map(|length| (length / spacing).round() as usize))
}

fn in_box(c: &mut Criterion, name: &str, swimmer: &Swimmer, cells: [usize; 2]) {
    step(c, &format!("{name}, {} x {}", cells[0], cells[1]), cells, swimmer.build().expect("a good swimmer").0);
}

fn in_channel(c: &mut Criterion, name: &str, swimmer: &Swimmer, cells: [usize; 2]) {
    let built = swimmer.build_in_channel(Drive::ZeroGradient).expect("a good swimmer");
    step(c, &format!("{name}, {} x {}", cells[0], cells[1]), cells, built.0);
}

fn scenes(c: &mut Criterion) {
    for (side, spacing) in [(6.0, 0.1), (6.0, 0.05), (12.0, 0.05), (6.0, 0.025)] {
        let (swimmer, cells) = grid([side, side], spacing);
        in_box(c, "box", &swimmer, cells);
    }
    for width in [2.0, 5.0] {
        let (swimmer, cells) = grid([12.0, width], 0.05);
        in_channel(c, "channel", &swimmer, cells);
    }
    for spacing in [0.1, 0.05] {
        let (swimmer, cells) = grid([6.0, 6.0], spacing);
        let thick = Swimmer { viscosity_inside: Some(1e4), ..swimmer };
        in_box(c, "ratio 100, sharp", &thick, cells);
        let smeared = Swimmer { contrast: ContrastMethod::Arithmetic, ..thick };
        in_box(c, "ratio 100, arithmetic", &smeared, cells);
    }
    let (swimmer, cells) = grid([6.0, 2.4], 0.1);
    let moduli = Moduli::from_thesis_spring_constant(1e5).expect("good moduli");
    let walls = ElasticChannel::new(swimmer, moduli).build().expect("a good channel").0;
    // The walls are 1.5 thick on both sides.
    step(c, "elastic channel", [cells[0], cells[1] + 30], walls);
    for nodes in [24, 64] {
        let integrals = Swimmer { nodes, concentration_cells: 4 * nodes, ..Swimmer::default() };
        let thick = Swimmer { viscosity_inside: Some(1e4), ..integrals.clone() };
        in_box(c, &format!("{nodes} nodes"), &integrals, [120, 120]);
        in_box(c, &format!("{nodes} nodes, ratio 100"), &thick, [120, 120]);
        let narrow = Swimmer { lengths: [12.0, 3.0], ..integrals };
        in_channel(c, &format!("{nodes} nodes, channel"), &narrow, [240, 60]);
    }
}

fn short() -> Criterion {
    let time = Duration::from_millis(500);
    Criterion::default().sample_size(20).warm_up_time(Duration::from_millis(100)).measurement_time(time)
}

criterion_group! {
    name = benches;
    config = short();
    targets = scenes
}
criterion_main!(benches);
