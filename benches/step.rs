//! One step of each kind of scene, in units of the bare transforms of its grid measured by turns in the same run:
//! `cargo bench --bench step`.
//!
//! Without a grid the unit is the transform of the grid of spacing 0.05 that would do the same.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use motile::elastic_solids::{ChannelShape, Moduli};
use motile::prelude::*;
use motile::setup::{AnyFlow, Material, SolidSetup};
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

fn cells(setup: &Setup, spacing: f64) -> [usize; 2] {
    setup.region.lengths().map(|length| (length / spacing).round() as usize)
}

fn measure(c: &mut Criterion, name: &str, setup: &Setup, cells: [usize; 2]) {
    step(c, &format!("{name}, {} x {}", cells[0], cells[1]), cells, setup.build().expect("a good scene").scene);
}

fn on_grid(region: Region, spacing: f64) -> (Setup, [usize; 2]) {
    let setup = Setup { region, method: Method::Grid(GridMethod::of_spacing(spacing)), ..Setup::default() };
    let cells = cells(&setup, spacing);
    (setup, cells)
}

fn viscous(setup: &Setup) -> Setup {
    let droplet = DropletSetup { viscosity: Some(1e4), ..DropletSetup::default() };
    Setup { droplets: vec![droplet], ..setup.clone() }
}

fn between_walls(length: f64, width: f64) -> Region {
    Region::Channel { length, width, drive: Drive::ZeroGradient }
}

fn scenes(c: &mut Criterion) {
    for (side, spacing) in [(6.0, 0.1), (6.0, 0.05), (12.0, 0.05), (6.0, 0.025)] {
        let (setup, cells) = on_grid(Region::Box { lengths: [side, side] }, spacing);
        measure(c, "box", &setup, cells);
    }
    for width in [2.0, 5.0] {
        let (setup, cells) = on_grid(between_walls(12.0, width), 0.05);
        measure(c, "channel", &setup, cells);
    }
    for spacing in [0.1, 0.05] {
        let (setup, cells) = on_grid(Region::Box { lengths: [6.0, 6.0] }, spacing);
        let method = Method::Grid(GridMethod::uncorrected(spacing));
        measure(c, "ratio 100, arithmetic", &Setup { method, ..viscous(&setup) }, cells);
    }
    let (setup, cells) = on_grid(between_walls(6.0, 5.4), 0.1);
    let setup = Setup { method: Method::Layers(LayersMethod::of_spacing(0.1)), ..setup };
    let shear = Moduli::from_thesis_spring_constant(1e5).expect("good moduli").shear();
    let solids = SolidSetup::walls(&ChannelShape::Straight { width: 2.4 }, &Material::Springs { shear });
    measure(c, "elastic channel", &Setup { solids, ..setup }, cells);
    for nodes in [24, 64] {
        let method = Method::Integral(IntegralMethod { nodes, elements: 4 * nodes });
        let integrals = Setup { method, ..Setup::default() };
        measure(c, &format!("{nodes} nodes"), &integrals, [120, 120]);
        measure(c, &format!("{nodes} nodes, ratio 100"), &viscous(&integrals), [120, 120]);
        let narrow = Setup { region: between_walls(12.0, 3.0), ..integrals };
        measure(c, &format!("{nodes} nodes, channel"), &narrow, [240, 60]);
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
