//! One step of each kind of scene, in units of the bare transforms of its grid measured by turns in the same run:
//! `cargo bench --bench step`.
//!
//! Without a grid the unit is the transform of the grid of spacing 0.05 that would do the same.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use motile::elastic_solids::Moduli;
use motile::setup::{
    ChannelShape, Contrast, DropletSetup, GridMethod, IntegralMethod, Material, Method, Region, Setup, SolidSetup,
};
use motile::stokes_grid::Drive;
use motile_timing::{PlainPair, print_ratios};

/// A step small enough that thousands of them stay in the same regime.
const DT: f64 = 1e-4;

fn step(c: &mut Criterion, name: &str, setup: &Setup) {
    let mut scene = setup.build().expect("a good scene").scene;
    scene.step(DT).expect("a good scene");
    let mut step = || black_box(&mut scene).step(DT).expect("a good scene");
    let spacing = if let Method::Grid(grid) = setup.method { grid.spacing } else { 0.05 };
    let [nx, ny] = setup.region.lengths().map(|length| (length / spacing).round() as usize);
    let name = format!("{name}, {nx} x {ny}");
    c.bench_function(&name, |b| b.iter(&mut step));
    let mut pair = PlainPair::new(nx, ny);
    print_ratios(&name, &mut [("pair", &mut || pair.run()), ("step", &mut step)]);
}

fn in_box(side: f64, method: Method) -> Setup {
    Setup { region: Region::Box { lengths: [side, side] }, method, ..Setup::default() }
}

fn in_channel(length: f64, width: f64, method: Method) -> Setup {
    Setup { region: Region::Channel { length, width, drive: Drive::ZeroGradient }, method, ..Setup::default() }
}

fn on_grid(spacing: f64) -> Method {
    Method::Grid(GridMethod::of_spacing(spacing))
}

fn scenes(c: &mut Criterion) {
    for (side, spacing) in [(6.0, 0.1), (6.0, 0.05), (12.0, 0.05), (6.0, 0.025)] {
        step(c, "box", &in_box(side, on_grid(spacing)));
    }
    for width in [2.0, 5.0] {
        step(c, "channel", &in_channel(12.0, width, on_grid(0.05)));
    }
    let thick = vec![DropletSetup { viscosity: Some(1e4), ..DropletSetup::default() }];
    for spacing in [0.1, 0.05] {
        let sharp = GridMethod::of_spacing(spacing);
        let arithmetic = GridMethod { contrast: Contrast::Arithmetic, corrected: false, ..sharp };
        for (name, grid) in [("ratio 100, sharp", sharp), ("ratio 100, arithmetic", arithmetic)] {
            step(c, name, &Setup { droplets: thick.clone(), ..in_box(6.0, Method::Grid(grid)) });
        }
    }
    let shear = Moduli::from_thesis_spring_constant(1e5).expect("good moduli").shear();
    let solids = SolidSetup::walls(&ChannelShape::Straight { width: 2.4 }, &Material::Springs { shear });
    step(c, "elastic channel", &Setup { solids, ..in_channel(6.0, 5.4, on_grid(0.1)) });
    for nodes in [24, 64] {
        let method = Method::Integral(IntegralMethod { nodes, cells: 4 * nodes });
        step(c, &format!("{nodes} nodes"), &in_box(6.0, method));
        step(c, &format!("{nodes} nodes, ratio 100"), &Setup { droplets: thick.clone(), ..in_box(6.0, method) });
        step(c, &format!("{nodes} nodes, channel"), &in_channel(12.0, 3.0, method));
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
