//! Geometry in code, 3: an elastic solid on your own mesh.
//!
//! `cargo run --release --example mesh_in_code` builds a ring from points and triangles, stretches it, and lets it go
//! in a periodic box. A homogeneous stretch has exactly the energy density of the material times the area of the ring:
//! 45.53. The ring then returns to its shape at rest, and its elastic energy falls by a factor of more than a hundred.

use std::f64::consts::TAU;

use motile::elastic_solids::mesh::TriangleMesh;
use motile::elastic_solids::{DeformationGradient, EnergyDensity, Mat2, NeoHookean, Solid};
use motile::prelude::*;

/// Returns a ring between two radii, of rows of equal numbers of points.
fn ring(
    inner: f64,
    outer: f64,
    rows: usize,
    columns: usize,
) -> Result<TriangleMesh, motile::elastic_solids::SolidError> {
    let place = |row: usize, column: usize| {
        let radius = inner + (outer - inner) * row as f64 / rows as f64;
        // Every second row is turned by half a side.
        let angle = TAU * (column as f64 + 0.5 * (row % 2) as f64) / columns as f64;
        radius * Vec2::new(angle.cos(), angle.sin())
    };
    let points = (0..=rows).flat_map(|row| (0..columns).map(move |column| place(row, column))).collect();
    let at = |row: usize, column: usize| row * columns + column % columns;
    let triangles = (0..rows).flat_map(|row| {
        (0..columns).flat_map(move |k| {
            let [a, b, c, d] = [at(row, k), at(row, k + 1), at(row + 1, k), at(row + 1, k + 1)];
            if row % 2 == 0 { [[a, b, c], [b, d, c]] } else { [[a, b, d], [a, d, c]] }
        })
    });
    TriangleMesh::new(points, triangles.collect())
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (mesh, material) = (ring(0.6, 1.2, 6, 60)?, NeoHookean::new(200.0, 400.0)?);
    let stretch = DeformationGradient::new(Mat2::from_rows_array(&[1.2, 0.0, 0.0, 1.0 / 1.2]))?;
    let exact = material.energy(&stretch) * mesh.area();
    let solid = Solid::hyperelastic(mesh, material).deformed(|point| Vec2::new(1.2 * point.x, point.y / 1.2))?;
    let energy = |solid: &Solid| solid.law().energy(solid.positions());
    let start = energy(&solid)?;
    assert!((start / exact - 1.0).abs() < 1e-12, "{start} is not {exact}");

    let setup = Setup { method: Method::Grid(GridMethod::of_spacing(0.1)), ..Setup::default() };
    let mut scene = Scene::new(setup.flow()?);
    let solid = scene.add(solid);
    scene.run(10.0).go()?;
    let end = energy(scene.body(solid)?)?;
    println!("elastic energy {start:.4}, exactly {exact:.4}; after the run {end:.6}");
    assert!(end < 0.01 * start);
    Ok(())
}
