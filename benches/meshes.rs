//! Meshing of a wavy wall of some ten thousand points and of a disc. `cargo bench --bench meshes`.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use motile::base::Vec2;
use motile::elastic_solids::{Interior, Mesher, Outline, SolidError};

fn wall() -> Result<Interior, SolidError> {
    let wave = |x: f64| -1.0 + 0.4 * (std::f64::consts::PI * x / 3.0).cos();
    Interior::new([Outline::flat(-6.0, 12.0, -2.5)?, Outline::profile(-6.0, 12.0, wave)?])
}

fn meshes(c: &mut Criterion) {
    let disc = Outline::circle(Vec2::ZERO, 1.0).and_then(|outline| Interior::new([outline]));
    for (name, region, spacing) in [("wavy wall", wall(), 0.046), ("disc", disc, 0.1)] {
        let region = region.expect("good outlines");
        let mesher = Mesher::new(spacing).expect("a good spacing");
        let points = mesher.mesh(&region).expect("a mesh").points().len();
        c.bench_function(&format!("{name}, {points} points"), |b| b.iter(|| mesher.mesh(black_box(&region))));
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = meshes
}
criterion_main!(benches);
