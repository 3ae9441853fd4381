//! Fast sums against sums over pairs and series, and against identities.

use super::*;

const NODES: usize = 64;

/// Ellipses on a lattice over a box or a channel about y = 0, displaced and turned at random, the first two with a film
/// of 0.02 between them.
fn ellipses([lx, ly]: [f64; 2], [across, up]: [usize; 2]) -> Vec<Vec<Vec2>> {
    let mut seed = 7u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    };
    let cell = Vec2::new(lx / across as f64, ly / up as f64);
    let mut curves = Vec::new();
    for j in 0..up {
        for i in 0..across {
            let place = Vec2::new((i as f64 + 0.5) * cell.x, (j as f64 + 0.5) * cell.y - 0.5 * ly);
            let centre = place + 0.2 * Vec2::new(random() * cell.x, random() * cell.y);
            let (turn, stretch) = (random(), 1.0 + 0.2 * random());
            let size = 0.37 * cell.x.min(cell.y);
            let at = |k: usize| TAU * k as f64 / NODES as f64;
            let point = |t: f64| {
                centre + Vec2::new(size * stretch * t.cos(), size / stretch * t.sin()).rotate(Vec2::from_angle(turn))
            };
            curves.push((0..NODES).map(at).map(point).collect::<Vec<_>>());
        }
    }
    // The second one is moved to the film's distance from the first.
    let right = curves[0].iter().map(|x| x.x).fold(f64::NEG_INFINITY, f64::max);
    let left = curves[1].iter().map(|x| x.x).fold(f64::INFINITY, f64::min);
    let height = |curve: &[Vec2], end: f64| curve.iter().find(|x| x.x == end).map_or(0.0, |x| x.y);
    let shift = Vec2::new(right + 0.02 - left, height(&curves[0], right) - height(&curves[1], left));
    curves[1].iter_mut().for_each(|x| *x += shift);
    curves
}

/// Layers of curves with smooth forces, loaded after a strain.
fn loaded(region: Region, strain: f64, tolerance: f64, curves: &[Vec<Vec2>]) -> Layers {
    let mut layers = Layers::new(region, tolerance, Symmetry::ToResolution).unwrap();
    layers.set_strain(strain);
    // Close nodes to the same accuracy whatever the tolerance of the sums.
    layers.close = CloseCorrection::new(1e-13, Symmetry::ToResolution);
    let force = |curve: usize, k: usize| {
        let t = TAU * k as f64 / NODES as f64 + curve as f64;
        Vec2::new(t.cos() + 0.3, (2.0 * t).sin() - 0.1 * (curve % 3) as f64)
    };
    let forces: Vec<Vec<Vec2>> = (0..curves.len()).map(|curve| (0..NODES).map(|k| force(curve, k)).collect()).collect();
    let given = curves
        .iter()
        .zip(&forces)
        .map(|(positions, forces)| (LayerCurve { positions, period: Vec2::ZERO, nodes: NODES }, forces.as_slice()));
    layers.load(&given, false).unwrap();
    layers.sum_fast().unwrap();
    layers
}

/// Flow of the single layer, then that of a double layer.
fn flows(layers: &mut Layers) -> [Vec<f64>; 2] {
    let all = |layers: &Layers| layers.flow.iter().flat_map(|flow| flow.x.iter().chain(&flow.y)).copied().collect();
    layers.single_layer(true);
    let single = all(layers);
    let (values, contrasts) = density(&layers.curves);
    layers.double_layer(Density { values: &values, contrasts: &contrasts }, 1e-15);
    [single, all(layers)]
}

/// Smooth velocities without a flux through the curves, of different contrasts.
fn density(curves: &[Curve]) -> (Vec<f64>, Vec<f64>) {
    let mut values = Vec::new();
    for (number, curve) in curves.iter().enumerate() {
        let at = |k: usize, phase: f64| (TAU * 2.0 * k as f64 / NODES as f64 + phase + number as f64).cos();
        let mut x: Vec<f64> = (0..NODES).map(|k| at(k, 0.0) + 0.3).collect();
        let mut y: Vec<f64> = (0..NODES).map(|k| at(k, 1.0) - 0.2).collect();
        let normals: Vec<Complex64> = curve.nodes.tangent.iter().map(|t| Complex64::new(t.im, -t.re)).collect();
        let flux: f64 = normals.iter().enumerate().map(|(i, n)| x[i] * n.re + y[i] * n.im).sum();
        let square: f64 = normals.iter().map(Complex64::norm_sqr).sum();
        for (i, n) in normals.iter().enumerate() {
            x[i] -= flux / square * n.re;
            y[i] -= flux / square * n.im;
        }
        values.extend(x);
        values.extend(y);
    }
    (values, (0..curves.len()).map(|curve| 0.5 + 0.3 * (curve % 4) as f64).collect())
}

/// Largest difference over the largest value.
fn error(found: &[f64], expected: &[f64]) -> f64 {
    let largest = |values: &mut dyn Iterator<Item = f64>| values.map(f64::abs).fold(0.0, f64::max);
    let difference = largest(&mut found.iter().zip(expected).map(|(found, expected)| found - expected));
    difference / largest(&mut expected.iter().copied())
}

#[test]
fn fast_sums_are_the_sums_over_pairs_to_the_tolerance() {
    let square = Region::Box { lengths: [14.0, 14.0] };
    let flat = Region::Box { lengths: [24.0, 9.0] };
    let tall = Region::Box { lengths: [7.0, 25.0] };
    let channel = |drive| Region::Channel { length: 13.0, width: 11.0, drive };
    let cases = [
        (square, 0.0, [5, 5]),
        (flat, 0.0, [8, 3]),
        (tall, 0.0, [3, 8]),
        (square, 0.3, [5, 5]),
        (flat, -0.7, [8, 3]),
        (channel(Drive::ZeroGradient), 0.0, [5, 4]),
        (channel(Drive::ZeroFlux), 0.0, [5, 4]),
        (Region::Plane, 0.0, [5, 5]),
    ];
    for (region, strain, counts) in cases {
        let lengths = match region {
            Region::Box { lengths } => lengths,
            Region::Channel { length, width, .. } => [length, width],
            _ => [14.0, 14.0],
        };
        let curves = ellipses(lengths, counts);
        let mut layers = loaded(region, strain, 1e-13, &curves);
        layers.fast = None;
        let expected = flows(&mut layers);
        for tolerance in [1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10, 1e-12] {
            let mut layers = loaded(region, strain, tolerance, &curves);
            let [single, double] = flows(&mut layers);
            let errors = [error(&single, &expected[0]), error(&double, &expected[1])];
            println!("{region:?} strain {strain} {tolerance:e}: {:.1e} {:.1e}", errors[0], errors[1]);
            assert!(errors.iter().all(|error| *error < tolerance), "{region:?} {strain} {tolerance:e}: {errors:?}");
        }
    }
}

#[test]
fn fast_double_layers_of_rigid_motions_are_known() {
    // Minus half of 4 pi times the motion on the curve itself, nothing on others.
    let lengths = [14.0, 14.0];
    let curves = ellipses(lengths, [5, 5]);
    let mut layers = loaded(Region::Box { lengths }, 0.0, 1e-10, &curves);
    layers.single_layer(true);
    let mut contrasts = vec![0.0; curves.len()];
    contrasts[7] = 1.0;
    for motion in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
        let mut values = vec![0.0; 2 * NODES * curves.len()];
        let start = 2 * NODES * 7;
        for (i, z) in layers.curves[7].nodes.position.iter().enumerate() {
            values[start + i] = motion[0] - motion[2] * z.im;
            values[start + NODES + i] = motion[1] + motion[2] * z.re;
        }
        let density = Density { values: &values, contrasts: &contrasts };
        layers.double_layer(density, 1e-15);
        for (curve, flow) in layers.flow.iter().enumerate() {
            let expected = &values[2 * NODES * curve..2 * NODES * (curve + 1)];
            for (found, expected) in flow.x.iter().chain(&flow.y).zip(expected) {
                let error = (found + TAU * expected).abs();
                assert!(error < 1e-8, "{motion:?} {curve}: {found} {expected}");
            }
        }
    }
}

#[test]
fn fast_single_layers_are_reciprocal() {
    let lengths = [14.0, 14.0];
    let curves = ellipses(lengths, [5, 5]);
    let mut layers = loaded(Region::Box { lengths }, 0.0, 1e-10, &curves);
    let mut with_forces = |source: usize| {
        let Layers { curves, plans, .. } = &mut layers;
        for (number, curve) in curves.iter_mut().enumerate() {
            let factor = if number == source { 1.0 } else { 0.0 };
            let value = |i: usize| {
                factor * (2.0 * TAU * (i % NODES) as f64 / NODES as f64 + (i / NODES + source) as f64).cos() + factor
            };
            let values: Vec<f64> = (0..2 * NODES).map(value).collect();
            curve.set_forces(&mut plans[curve.plan].transforms, &values, false);
        }
        layers.clear();
        let Layers { fast: Some(fast), curves, plans, flow, .. } = &mut layers else { return Default::default() };
        fast.place(curves);
        fast.add_forces(curves, 0..curves.len(), plans, flow);
        let forces: Vec<Vec<Complex64>> = curves.iter().map(|curve| curve.nodes.force.clone()).collect();
        (forces, flow.clone())
    };
    let ((f, u), (g, v)) = (with_forces(3), with_forces(4));
    let power = |forces: &[Vec<Complex64>], flow: &[Vectors]| -> f64 {
        let nodes = forces.iter().flatten().zip(flow.iter().flat_map(|flow| flow.x.iter().zip(&flow.y)));
        nodes.map(|(force, (x, y))| force.re * x + force.im * y).sum()
    };
    let (one, other) = (power(&f, &v), power(&g, &u));
    let scale = power(&f, &u).abs();
    assert!((one - other).abs() < 1e-12 * scale && one.abs() > 1e-3 * scale, "{one} {other} {scale}");
}

#[cfg(feature = "rayon")]
#[test]
fn fast_sums_do_not_depend_on_the_number_of_threads() {
    let lengths = [14.0, 14.0];
    let curves = ellipses(lengths, [5, 5]);
    let channel = Region::Channel { length: 14.0, width: 14.0, drive: Drive::ZeroFlux };
    for region in [Region::Box { lengths }, channel, Region::Plane] {
        let bits = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let flows = pool.install(|| flows(&mut loaded(region, 0.0, 1e-8, &curves)));
            flows.map(|flow| flow.into_iter().map(f64::to_bits).collect::<Vec<_>>())
        };
        let expected = bits(1);
        assert_eq!(bits(2), expected);
        assert_eq!(bits(3), expected);
    }
}
