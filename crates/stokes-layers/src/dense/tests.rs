use super::*;
use crate::InputError;

fn curves(layer: &DoubleLayerMatrix) -> Vec<NodeCurve> {
    let mut first = 0;
    [(Vec2::new(0.1, 0.2), 40, 3.0), (Vec2::new(2.2, 2.7), 24, -0.8)]
        .into_iter()
        .map(|(centre, nodes, contrast)| {
            let mut curve = NodeCurve::default();
            let positions: Vec<Vec2> = (0..nodes)
                .map(|k| std::f64::consts::TAU * k as f64 / nodes as f64)
                .map(|t| centre + Vec2::new(0.9 * t.cos(), 0.6 * t.sin()))
                .collect();
            curve.load(layer, first, [1.0 + contrast, 1.0], &positions).unwrap();
            first += nodes;
            curve
        })
        .collect()
}

fn layers() -> [DoubleLayerMatrix; 4] {
    let channel = |forcing| Geometry::Channel { length: 5.0, width: 5.0, forcing };
    [
        Geometry::Box { lengths: [5.0; 2] },
        Geometry::Box { lengths: [5.0, 4.8] },
        channel(Forcing::Gradient(0.0)),
        channel(Forcing::Flux(0.0)),
    ]
    .map(|geometry| DoubleLayerMatrix::new(geometry, 1.5, 1e-3).unwrap())
}

fn vector(len: usize, seed: f64) -> Vec<f64> {
    (0..len).map(|k| (seed * (k * k + 1) as f64).sin()).collect()
}

#[test]
fn the_transposed_product_is_that_of_the_transposed_matrix() {
    for mut layer in layers() {
        let curves = curves(&layer);
        layer.build(&curves).unwrap();
        let (v, q) = (vector(128, 0.7), vector(128, 1.3));
        let (mut av, mut aq) = (vec![0.0; 128], vec![0.0; 128]);
        layer.product(&curves, &v, &mut av);
        layer.transposed_product(&curves, &q, &mut aq);
        for curve in &curves {
            curve.entries(64).for_each(|i| aq[i] = q[i] + curve.contrast * aq[i]);
        }
        let (left, right) = (dot(&q, &av), dot(&aq, &v));
        // The walls' modes are truncated for each distance on its own.
        assert!((left - right).abs() < 1e-5 * left.abs().max(1.0), "{left} {right}");
    }
}

#[test]
fn rigid_motions_are_multiplied_by_the_exterior_viscosity() {
    for mut layer in layers() {
        let mut curves = curves(&layer);
        // Far from each other the trapezoidal rule is exact.
        curves.truncate(1);
        layer.build(&curves).unwrap();
        let mut out = vec![0.0; 80];
        for motion in [|_: Vec2| Vec2::new(1.0, 0.0), |_| Vec2::new(0.0, 1.0), |r: Vec2| Vec2::new(-r.y, r.x)] {
            let values: Vec<Vec2> = curves[0].positions.iter().map(|r| motion(*r)).collect();
            let v: Vec<f64> = values.iter().map(|v| v.x).chain(values.iter().map(|v| v.y)).collect();
            layer.product(&curves, &v, &mut out);
            for (out, v) in out.iter().zip(&v) {
                assert!((out - v).abs() < 1e-4, "{out} {v}");
            }
        }
    }
}

#[test]
fn what_cannot_be_is_refused_before_memory_is_taken() {
    assert_eq!(DoubleLayerMatrix::new(Geometry::Plane, 0.0, 0.1).unwrap_err(), LayerError::NoPeriod);
    assert!(DoubleLayerMatrix::new(Geometry::Box { lengths: [1.0, -1.0] }, 0.0, 0.1).is_err());
    let mut layer = layers()[0].clone();
    let mut curve = NodeCurve::default();
    let error = curve.load(&layer, 0, [2.0, 1.0], &[Vec2::ZERO; 7]).unwrap_err();
    assert!(matches!(error, LayerError::Input(InputError::OutOfRange { value: 7.0, minimum: 8.0, .. })), "{error}");
    let circle = |k: usize| 1e-3 * std::f64::consts::TAU * k as f64;
    let positions: Vec<Vec2> = (0..1000).map(|k| Vec2::new(circle(k).cos(), circle(k).sin())).collect();
    curve.load(&layer, 0, [2.0, 1.0], &positions).unwrap();
    let error = layer.build(&vec![curve; 11]).unwrap_err();
    assert!(matches!(error, LayerError::Input(InputError::OutOfRange { value: 11_000.0, .. })), "{error}");
}

/// Nodes of a circle of radius one about the middle of a region.
fn circle(layer: &DoubleLayerMatrix, nodes: usize, contrast: f64) -> NodeCurve {
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / nodes as f64;
    let positions: Vec<Vec2> = (0..nodes).map(|k| Vec2::new(angle(k).cos(), 1.5 + angle(k).sin())).collect();
    let mut curve = NodeCurve::default();
    curve.load(layer, 0, [1.0 + contrast, 1.0], &positions).unwrap();
    curve
}

#[test]
fn growth_is_multiplied_by_the_mean_viscosity() {
    // So large a box is the plane but for the ratio of areas.
    let mut layer = DoubleLayerMatrix::new(Geometry::Box { lengths: [4e3; 2] }, 1.5, 1e-3).unwrap();
    for (contrast, expected) in [(-0.8, 0.6), (-0.1, 0.95), (3.0, 4.0)] {
        let curves = [circle(&layer, 64, contrast)];
        layer.build(&curves).unwrap();
        let normals = curves[0].normals.iter().zip(&curves[0].weights).map(|(n, w)| n / *w);
        let normals: Vec<Vec2> = normals.collect();
        let v: Vec<f64> = normals.iter().map(|n| n.x).chain(normals.iter().map(|n| n.y)).collect();
        let mut out = vec![0.0; 128];
        layer.product(&curves, &v, &mut out);
        for (out, v) in out.iter().zip(&v) {
            assert!((out - expected * v).abs() < 1e-5, "{contrast}: {out} {v}");
        }
    }
}

#[test]
fn lengths_and_areas_of_curves_are_of_fourth_order() {
    let layer = layers()[0].clone();
    let errors = [16, 32, 64].map(|nodes| {
        let curve = circle(&layer, nodes, 1.0);
        [curve.perimeter() - std::f64::consts::TAU, curve.area - std::f64::consts::PI].map(f64::abs)
    });
    for pair in errors.windows(2) {
        let orders = [0, 1].map(|k| (pair[0][k] / pair[1][k]).log2());
        assert!(orders.iter().all(|order| (order - 4.0).abs() < 0.1), "{orders:?} {errors:?}");
    }
}
