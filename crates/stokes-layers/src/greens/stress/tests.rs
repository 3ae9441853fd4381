use num_complex::Complex64;

use super::*;
use crate::{
    Forcing, Geometry,
    greens::{Flow, GreensFunction},
};

const GEOMETRIES: [Geometry; 3] = [
    Geometry::Box { lengths: [7.0, 5.0] },
    Geometry::Box { lengths: [5.0, 7.0] },
    Geometry::Channel { length: 6.0, width: 2.0, forcing: Forcing::Gradient(0.0) },
];

/// Stresses at several sources as functions of source minus target.
fn at(geometry: &Geometry, target: Vec2, sources: &[Vec2]) -> Vec<[f64; 4]> {
    let kernel = StressKernel::new(&geometry.images(), 1e-6);
    let mut loaded = Sources::default();
    kernel.load(sources, &mut loaded);
    let mut out = Vec::new();
    kernel.stresses(target, &loaded, 1, |source, stress| {
        assert_eq!(source, out.len() + 1);
        out.push(stress);
    });
    assert_eq!(out.len() + 1, sources.len());
    out
}

#[test]
fn it_is_that_of_the_greens_function_of_points() {
    let target = Vec2::new(0.3, -0.4);
    let angle = |j: usize| 0.7 * j as f64;
    let sources: Vec<Vec2> =
        (0..20).map(|j| (0.2 + 0.1 * j as f64) * Vec2::new(angle(j).cos(), 0.8 * angle(j).sin())).collect();
    for geometry in GEOMETRIES {
        let greens = GreensFunction::new(&geometry, 1e-12);
        for (source, [xxx, xxy, xyy, yyy]) in sources[1..].iter().zip(at(&geometry, target, &sources)) {
            let d = source - target;
            let kernels = greens.at(Complex64::new(d.x, d.y));
            for (vx, vy, nx, ny) in [(1.0, 0.0, 1.0, 0.0), (0.3, -1.2, 0.8, 0.1), (0.0, 1.0, 0.2, -0.9)] {
                // The flow of points counts the double layer as negative; the normal is -i times the tangent.
                let mut flow = Flow::default();
                flow.add_dipole(&kernels, Complex64::new(vx, vy), Complex64::new(-ny, nx), -1.0);
                let (xx, s, yy) = (vx * nx, vx * ny + vy * nx, vy * ny);
                let found = Complex64::new(xxx * xx + xxy * s + xyy * yy, xxy * xx + xyy * s + yyy * yy);
                assert!((found - flow.velocity).norm() < 1e-5, "{geometry:?} {d}: {found} {}", flow.velocity);
            }
        }
    }
}

#[test]
fn close_to_the_source_it_is_that_of_the_plane() {
    for geometry in GEOMETRIES {
        let d = Vec2::new(0.003, -0.002);
        let [stress] = at(&geometry, Vec2::ZERO, &[d, d])[..] else { unreachable!() };
        let r4 = d.length_squared().powi(2);
        let products = [d.x * d.x * d.x, d.x * d.x * d.y, d.x * d.y * d.y, d.y * d.y * d.y];
        for (value, product) in stress.into_iter().zip(products) {
            assert!((value + 4.0 * product / r4).abs() < 0.02, "{value}, {}", -4.0 * product / r4);
        }
    }
}
