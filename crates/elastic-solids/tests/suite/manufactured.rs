//! Hyperelastic triangles in equilibrium under forces of which the exact deformation is known.

use elastic_solids::{
    DeformationGradient, ElasticForces, EnergyDensity, Hyperelastic, Interior, Mat2, Mesher, NeoHookean, Outline,
    Solid, mesh::TriangleMesh,
};
use motile_base::Vec2;

const AMPLITUDE: f64 = 0.1;

/// A deformation of the square of size 2 that keeps areas: two shears that follow each other.
fn exact(s: Vec2) -> Vec2 {
    let x = s.x + AMPLITUDE * (2.0 * s.y).sin();
    Vec2::new(x, s.y + AMPLITUDE * (2.0 * x).sin())
}

fn exact_gradient(s: Vec2) -> Mat2 {
    let x = s.x + AMPLITUDE * (2.0 * s.y).sin();
    let [first, second] = [2.0 * AMPLITUDE * (2.0 * s.y).cos(), 2.0 * AMPLITUDE * (2.0 * x).cos()];
    Mat2::from_rows_array(&[1.0, first, second, 1.0 + first * second])
}

fn square(spacing: f64) -> TriangleMesh {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| Vec2::new(x, y));
    let region = Interior::new([Outline::polygon(&corners).expect("a square")]).expect("a square");
    Mesher::new(spacing).expect("a spacing").turned(0.2).expect("an angle").mesh(&region).expect("a mesh")
}

/// Points inside a triangle by the shares of its corners, with which quadratic functions are integrated exactly.
const PLACES: [[f64; 3]; 3] = [[4.0, 1.0, 1.0], [1.0, 4.0, 1.0], [1.0, 1.0, 4.0]];

/// Errors of the equilibrium with the boundary held where it is exactly, root mean squares: of the displacement, of the
/// deformation gradient from that of the exact displacement of the corners, and of the pressure in the triangles.
fn errors(spacing: f64, material: NeoHookean) -> [f64; 3] {
    let mesh = square(spacing);
    let law = Hyperelastic::new(&mesh, material);
    let points = mesh.points();
    // Loads that hold the exact deformation, by the principle of virtual work.
    let mut loads = vec![Vec2::ZERO; points.len()];
    for corners in mesh.triangles() {
        let at = corners.map(|point| points[point]);
        for shares in PLACES {
            let place = (0..3).map(|k| at[k] * (shares[k] / 6.0)).sum();
            let stress = material.stress(&DeformationGradient::new(exact_gradient(place)).expect("upright"));
            for k in 0..3 {
                // The share of a corner has the gradient of the opposite side, turned, over twice the area.
                let opposite = at[(k + 2) % 3] - at[(k + 1) % 3];
                loads[corners[k]] += stress * opposite.perp() * (0.5 / 3.0);
            }
        }
    }
    let mut inner = vec![true; points.len()];
    mesh.boundary_loops().iter().flat_map(|outline| &outline.points).for_each(|point| inner[*point] = false);
    let residual = |positions: &[Vec2]| {
        let mut forces = loads.clone();
        law.add_forces(positions, &mut forces).expect("upright triangles");
        forces.iter_mut().zip(&inner).filter(|(_, inner)| !**inner).for_each(|(force, _)| *force = Vec2::ZERO);
        forces
    };
    let dot = |a: &[Vec2], b: &[Vec2]| a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum::<f64>();
    let mut positions: Vec<Vec2> = points.iter().map(|s| exact(*s)).collect();
    let mut forces = residual(&positions);
    let scale = dot(&forces, &forces);
    let mut direction = forces.clone();
    let mut squared = scale;
    for _ in 0..40_000 {
        if squared < 1e-16 * scale {
            break;
        }
        let reach = 1e-6 / direction.iter().map(|v| v.length()).fold(0.0, f64::max);
        let moved = |by: f64| -> Vec<Vec2> { positions.iter().zip(&direction).map(|(x, d)| x + by * d).collect() };
        let slope = dot(&forces, &direction);
        let curvature =
            (dot(&residual(&moved(-reach)), &direction) - dot(&residual(&moved(reach)), &direction)) / reach;
        positions = moved(2.0 * slope / curvature);
        let (before, now) = (forces, residual(&positions));
        let next = dot(&now, &now);
        let keep = ((next - dot(&now, &before)) / squared).max(0.0);
        direction = now.iter().zip(&direction).map(|(force, d)| force + keep * d).collect();
        (forces, squared) = (now, next);
    }
    assert!(squared < 1e-12 * scale, "{squared:e} {scale:e}");
    let off: Vec<Vec2> = points.iter().zip(&positions).map(|(s, x)| *x - exact(*s)).collect();
    let displacement = (dot(&off, &off) / points.len() as f64).sqrt();
    let mut energy = 0.0;
    for (corners, area) in mesh.triangles().iter().zip(mesh.areas()) {
        let sides = |of: &dyn Fn(usize) -> Vec2| {
            Mat2::from_cols(of(corners[1]) - of(corners[0]), of(corners[2]) - of(corners[0]))
        };
        let gradient = sides(&|point| off[point]) * sides(&|point| points[point]).inverse();
        energy += area * gradient.to_cols_array().iter().map(|entry| entry * entry).sum::<f64>();
    }
    let mut solid = Solid::hyperelastic(mesh.clone(), material);
    solid.set_positions(&positions).expect("as many");
    let mut pressure = 0.0;
    for ((corners, area), stress) in mesh.triangles().iter().zip(mesh.areas()).zip(solid.stresses().expect("upright")) {
        let centroid = corners.iter().map(|point| points[*point]).sum::<Vec2>() / 3.0;
        let exact = material.cauchy_stress(&DeformationGradient::new(exact_gradient(centroid)).expect("upright"));
        pressure += area * (0.5 * (stress - exact).trace()).powi(2);
    }
    [displacement, (energy / mesh.area()).sqrt(), (pressure / mesh.area()).sqrt()]
}

/// Second order of the displacement and more than the first of its gradient at any bulk modulus, also where triangles
/// share their change of area; alone they stay 30 times as far off at 1e4, however many there are. Pressures are of
/// first order; with the change of area of each triangle alone they are 20 times as far off at 11.
#[test]
fn equilibria_converge_at_any_bulk_modulus() {
    let bounds = [(1.0, 7e-5, 5e-3), (9.0, 9e-4, 0.05), (11.0, 2e-4, 3e-3), (100.0, 2e-4, 5e-3), (1e4, 2e-4, 0.15)];
    for (bulk, bound, pressure) in bounds {
        let material = NeoHookean::new(1.0, bulk).unwrap();
        let [coarse, fine] = [0.2, 0.1].map(|spacing| errors(spacing, material));
        let found = [0, 1, 2].map(|k| (coarse[k] / fine[k]).log2());
        let converge = found[0] > 1.9 && found[1] > 1.3 && found[2] > 0.85;
        assert!(converge && fine[0] < bound && fine[2] < pressure, "{bulk}: {coarse:?} {fine:?}");
    }
}
