mod film;
mod free_body;
mod many;
mod sheared;

use std::f64::consts::PI;

use num_complex::Complex64;

use super::{equation::Operator, *};

const NODES: usize = 96;

/// Largest error of `A E = eta_ext E` at the first of two interfaces and of `A E = 0` at the second, for the rigid
/// motions E of the first, relative to the mean viscosity; and that of the flux of a uniform expansion.
fn errors(region: Region, second: Complex64, viscosities: [f64; 2]) -> [f64; 2] {
    let settings = Settings { nodes: NODES, tolerance: 1e-15, ..Settings::default() };
    let mut flow = InterfaceFlow::new(region, 1.0, settings).unwrap();
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / NODES as f64;
    let outline = |k: usize| Complex64::new(1.2 * angle(k).cos(), 0.9 * angle(k).sin()) * Complex64::cis(0.3);
    let curves = [Complex64::new(0.2, 0.1), second].map(|centre| {
        let place = |k: usize| Vec2::new((centre + outline(k)).re, (centre + outline(k)).im);
        (0..NODES).map(place).collect::<Vec<_>>()
    });
    let forces = vec![Vec2::ZERO; NODES];
    let interfaces = curves.iter().zip(viscosities);
    let given = interfaces.map(|(positions, viscosity)| Interface::closed(positions, &forces, [viscosity, 1.0]));
    flow.load(given).unwrap();
    let InterfaceFlow { layers, equation, .. } = &mut flow;
    layers.single_layer(true);
    let operator = Operator { sides: &equation.sides, contrasts: &equation.contrasts };
    let mobility = equation.sides[0].mobility();
    let mut apply = |v: &[f64]| {
        let mut out = vec![0.0; 4 * NODES];
        operator.apply(layers, None, v, 1e-15, &mut out);
        out
    };
    let outlines: Vec<Complex64> = (0..NODES).map(outline).collect();
    let tangent = |k: usize| Complex64::new(-1.2 * angle(k).sin(), 0.9 * angle(k).cos()) * Complex64::cis(0.3);
    let motions: [fn(Complex64) -> Complex64; 3] =
        [|_| Complex64::new(1.0, 0.0), |_| Complex64::new(0.0, 1.0), |z| Complex64::new(0.0, 1.0) * z];
    let mut rigid = 0.0f64;
    for motion in motions {
        let mut v = vec![0.0; 4 * NODES];
        for (i, z) in outlines.iter().enumerate() {
            (v[i], v[NODES + i]) = (motion(*z).re, motion(*z).im);
        }
        let out = apply(&v);
        for (i, out) in out.iter().enumerate() {
            let expected = mobility * if i < 2 * NODES { v[i] } else { 0.0 };
            rigid = rigid.max((out - expected).abs());
        }
    }
    // The flux through the first curve is multiplied by its inner viscosity, or with the growth term by the mean one.
    let flux = |v: &[f64]| -> f64 { (0..NODES).map(|i| v[i] * tangent(i).im - v[NODES + i] * tangent(i).re).sum() };
    let smooth: Vec<f64> = (0..4 * NODES).map(|i| (3.0 * angle(i % NODES)).sin() + 0.4).collect();
    let expanded: Vec<f64> = (0..4 * NODES)
        .map(|i| {
            let t = tangent(i % NODES);
            smooth[i]
                + if i < NODES {
                    t.im
                } else if i < 2 * NODES {
                    -t.re
                } else {
                    0.0
                }
        })
        .collect();
    let kept = flux(&apply(&expanded)) - (viscosities[0] * mobility).max(1.0) * flux(&expanded);
    [rigid, kept.abs() / flux(&expanded)]
}

#[test]
fn rigid_motions_and_flux() {
    for viscosities in [[10.0, 3.0], [1000.0, 0.001], [0.001, 50.0]] {
        let free = errors(Region::Plane, Complex64::new(3.1, 0.4), viscosities);
        assert!(free[0] < 1e-12 && free[1] < 1e-12, "{free:?}");
        let close = errors(Region::Plane, Complex64::new(2.65, 0.4), viscosities);
        assert!(close[0] < 1e-11, "{close:?}");
        let square = errors(Region::Box { lengths: [6.0, 7.0] }, Complex64::new(3.2, 3.6), viscosities);
        assert!(square[0] < 1e-12, "{square:?}");
        let large = errors(Region::Box { lengths: [14.0, 15.0] }, Complex64::new(2.9, 0.6), viscosities);
        assert!(large[0] < 1e-12, "{large:?}");
        for drive in [Drive::ZeroGradient, Drive::ZeroFlux] {
            let channel = Region::Channel { length: 7.0, width: 4.0, drive };
            let channel = errors(channel, Complex64::new(3.5, -0.4), viscosities);
            assert!(channel[0] < 1e-11, "{channel:?}");
        }
    }
}

/// Incompressible flow has no uniform growth: with less viscous fluid inside it is multiplied by the mean viscosity.
#[test]
fn growth_of_a_circle_has_the_eigenvalue_one() {
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / NODES as f64;
    let circle: Vec<Vec2> = (0..NODES).map(|k| Vec2::new(angle(k).cos(), angle(k).sin())).collect();
    for (viscosity, expected) in [(1e-3, 1.0), (0.5, 1.0), (3.0, 1.5)] {
        let settings = Settings { nodes: NODES, tolerance: 1e-14, ..Settings::default() };
        let mut flow = InterfaceFlow::new(Region::Plane, 1.0, settings).unwrap();
        flow.load(std::iter::once(Interface::closed(&circle, &circle, [viscosity, 1.0]))).unwrap();
        flow.solve().unwrap();
        let InterfaceFlow { layers, equation, .. } = &mut flow;
        let operator = Operator { sides: &equation.sides, contrasts: &equation.contrasts };
        let normals: Vec<f64> = circle.iter().map(|n| n.x).chain(circle.iter().map(|n| n.y)).collect();
        let mut out = vec![0.0; 2 * NODES];
        operator.apply(layers, None, &normals, 1e-14, &mut out);
        for (out, normal) in out.iter().zip(&normals) {
            assert!((out - expected * normal).abs() < 1e-12, "{viscosity}: {out} {normal}");
        }
    }
}

/// An open interface in a channel, fluid of a viscosity above or below it, with a pressure gradient.
fn two_fluids(shape: impl Fn(f64) -> Vec2, direction: f64, inside: f64, nodes: usize) -> InterfaceFlow {
    let drive = Drive::Gradient(-1.0);
    let region = Region::Channel { length: 3.0, width: 2.0, drive };
    let settings = Settings { nodes, tolerance: 1e-13, ..Settings::default() };
    let mut flow = InterfaceFlow::new(region, 1.0, settings).unwrap();
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / nodes as f64;
    let positions: Vec<Vec2> = (0..nodes).map(|k| shape(direction * angle(k))).collect();
    let forces = vec![Vec2::ZERO; nodes];
    let period = Vec2::new(direction * 3.0, 0.0);
    flow.load([Interface { period, ..Interface::closed(&positions, &forces, [inside, 1.0]) }].into_iter()).unwrap();
    flow.solve().unwrap();
    flow
}

fn sampled(flow: &mut InterfaceFlow, points: &[Vec2]) -> Vec<FlowSample> {
    let mut samples = vec![FlowSample::default(); points.len()];
    flow.sample(points, &mut samples).unwrap();
    samples
}

/// Two fluids on top of each other flow in parabolas whose velocity and shear stress are continuous.
#[test]
fn layers_of_two_fluids_flow_in_two_parabolas() {
    let y0 = 0.2;
    for (direction, inside) in [(1.0, 5.0), (-1.0, 0.1), (1.0, 1.0), (-1.0, 100.0)] {
        let shape = |t: f64| Vec2::new(3.0 * t / std::f64::consts::TAU, y0);
        let mut flow = two_fluids(shape, direction, inside, 32);
        let [below, above] = if direction > 0.0 { [1.0, inside] } else { [inside, 1.0] };
        // eta u = a (y -+ 1) + (1 - y^2)/2 on either side.
        let parabola = 0.5 * (1.0 - y0 * y0);
        let a = parabola * (1.0 / above - 1.0 / below) / ((y0 + 1.0) / below - (y0 - 1.0) / above);
        let expected = |y: f64| {
            let (eta, wall) = if y > y0 { (above, 1.0) } else { (below, -1.0) };
            (a * (y - wall) + 0.5 * (1.0 - y * y)) / eta
        };
        let heights = [-0.9, -0.3, 0.19, 0.199, 0.201, 0.21, 0.5, 0.95];
        let points: Vec<Vec2> = heights.iter().map(|&y| Vec2::new(0.3, y)).collect();
        for (point, sample) in points.iter().zip(sampled(&mut flow, &points)) {
            let error = (sample.velocity - Vec2::new(expected(point.y), 0.0)).length();
            assert!(error < 1e-11, "{direction} {inside} {point}: {error:e}");
        }
    }
}

/// The flux through every section and the velocity on the two sides of a wavy interface close to a wall; and what
/// coarser nodes give.
#[test]
fn flux_along_a_wavy_interface_is_the_same_everywhere() {
    let shape = |t: f64| Vec2::new(3.0 * t / std::f64::consts::TAU + 0.1 * t.sin(), -0.6 + 0.3 * t.cos());
    for (direction, inside) in [(1.0, 8.0), (-1.0, 0.125)] {
        let mut flow = two_fluids(shape, direction, inside, 128);
        let beside: Vec<Vec2> =
            (0..5).flat_map(|k| [1e-7, -1e-7].map(|d| shape(1.1 * f64::from(k)) + Vec2::new(0.0, d))).collect();
        for pair in sampled(&mut flow, &beside).chunks(2) {
            assert!((pair[0].velocity - pair[1].velocity).length() < 1e-6, "{pair:?}");
        }
        // Gauss-Legendre points of each fluid in two sections, where the interface is highest and lowest.
        let gauss = [(0.0, 128.0 / 225.0), (0.538_469_310_105_683, 0.478_628_670_499_366_5)];
        let gauss = [gauss[0], gauss[1], (0.906_179_845_938_664, 0.236_926_885_056_189)];
        let mut fluxes = [0.0, PI].map(|t| {
            let Vec2 { x, y: height } = shape(t);
            let mut flux = 0.0;
            for (from, to, pieces) in [(-1.0, height, 24), (height, 1.0, 24)] {
                let step = (to - from) / f64::from(pieces);
                for piece in 0..pieces {
                    let middle = from + (f64::from(piece) + 0.5) * step;
                    for (s, w) in gauss {
                        let signs: &[f64] = if s == 0.0 { &[1.0] } else { &[1.0, -1.0] };
                        for sign in signs {
                            let point = Vec2::new(x, middle + sign * 0.5 * s * step);
                            flux += 0.5 * step * w * sampled(&mut flow, &[point])[0].velocity.x;
                        }
                    }
                }
            }
            flux
        });
        fluxes[1] -= fluxes[0];
        assert!(fluxes[1].abs() < 1e-9 * fluxes[0], "{fluxes:?}");
        let errors = [32, 48, 64].map(|nodes| {
            let point = [Vec2::new(0.0, -0.2)];
            let [a, b] =
                [two_fluids(shape, direction, inside, nodes), flow.clone()].map(|mut f| sampled(&mut f, &point)[0]);
            (a.velocity - b.velocity).length() / b.velocity.length()
        });
        println!("{errors:?}");
        assert!(errors[2] < 1e-8 && errors[2] < 1e-4 * errors[0], "{errors:?}");
    }
}

#[test]
fn many_in_a_lattice_move_as_one_in_its_cell() {
    let (cell, side, nodes) = ([3.1, 2.7], 4, 64);
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / nodes as f64;
    let outline = |k: usize| Vec2::new(1.2 * angle(k).cos(), 0.9 * angle(k).sin() + 0.1 * (2.0 * angle(k)).sin());
    let forces: Vec<Vec2> = (0..nodes).map(|k| Vec2::new(angle(k).cos() + 0.2, (3.0 * angle(k)).sin())).collect();
    let velocities = |side: usize, viscosity: f64| {
        let place = |i: usize| Vec2::new(cell[0] * (i % side) as f64 + 0.4, cell[1] * (i / side) as f64 - 0.3);
        let curves: Vec<Vec<Vec2>> =
            (0..side * side).map(|i| (0..nodes).map(|k| place(i) + outline(k)).collect()).collect();
        let region = Region::Box { lengths: cell.map(|length| length * side as f64) };
        let settings = Settings { nodes, tolerance: 1e-9, ..Settings::default() };
        let mut flow = InterfaceFlow::new(region, 1.0, settings).unwrap();
        flow.load(curves.iter().map(|curve| Interface::closed(curve, &forces, [viscosity, 1.0]))).unwrap();
        if side > 1 {
            flow.layers.sum_fast().unwrap();
        }
        flow.solve().unwrap();
        let mut all = vec![Vec2::ZERO; nodes * side * side];
        for (index, out) in all.chunks_exact_mut(nodes).enumerate() {
            flow.velocities(index, out).unwrap();
        }
        all
    };
    for viscosity in [0.05, 1.0, 30.0] {
        let (one, many) = (velocities(1, viscosity), velocities(side, viscosity));
        let size = one.iter().map(|v| v.length()).fold(0.0, f64::max);
        let errors = many.iter().enumerate().map(|(i, v)| (*v - one[i % nodes]).length() / size);
        let error = errors.fold(0.0, f64::max);
        println!("{viscosity}: {error:.1e}");
        assert!(error < 1e-8, "{viscosity}: {error:e}");
    }
}

/// Without forces and contrast an interface goes with the imposed flow, whatever the viscosity.
#[test]
fn interfaces_go_with_the_imposed_flow() {
    let imposed = ImposedFlow { velocity: [0.3, -0.7], gradient: [[0.4, 0.2], [0.6, -0.4]], bend: 0.0 };
    for viscosity in [1.0, 0.25, 3.0] {
        let settings = Settings { nodes: 32, tolerance: 1e-14, ..Settings::default() };
        let mut flow = InterfaceFlow::new(Region::Plane, viscosity, settings).unwrap();
        flow.impose(imposed, 0.0).unwrap();
        let angle = |k: usize| std::f64::consts::TAU * k as f64 / 32.0;
        let place = |k: usize| Vec2::new(0.5 + angle(k).cos(), 0.8 * angle(k).sin() - 0.2);
        let positions: Vec<Vec2> = (0..32).map(place).collect();
        let forces = vec![Vec2::ZERO; 32];
        flow.load([Interface::closed(&positions, &forces, [viscosity; 2])].into_iter()).unwrap();
        flow.solve().unwrap();
        let mut velocities = vec![Vec2::ZERO; 32];
        flow.velocities(0, &mut velocities).unwrap();
        for (position, velocity) in positions.iter().zip(velocities) {
            let error = velocity.distance(imposed.velocity_at(*position));
            assert!(error < 1e-12, "{viscosity} {position}: {velocity}");
        }
    }
}

/// Near an open interface a sample is the same in any unit of length.
#[test]
fn samples_near_an_open_interface_do_not_depend_on_the_unit() {
    let seen = |unit: f64| -> Vec<Vec2> {
        let drive = Drive::Gradient(-1.0 / (unit * unit));
        let region = Region::Channel { length: 3.0 * unit, width: 2.0 * unit, drive };
        let settings = Settings { nodes: 64, tolerance: 1e-13, ..Settings::default() };
        let mut flow = InterfaceFlow::new(region, 1.0, settings).unwrap();
        let height = |part: f64| 0.2 * (std::f64::consts::TAU * part).sin();
        let place = |part: f64| unit * Vec2::new(3.0 * part, height(part));
        let positions: Vec<Vec2> = (0..64).map(|k| place(f64::from(k) / 64.0)).collect();
        let (forces, period) = (vec![Vec2::ZERO; 64], Vec2::new(3.0 * unit, 0.0));
        flow.load([Interface { period, ..Interface::closed(&positions, &forces, [5.0, 1.0]) }].into_iter()).unwrap();
        flow.solve().unwrap();
        let above = [-0.3, -0.2, -0.1, -0.05, 0.05, 0.1, 0.2, 0.3];
        let points: Vec<Vec2> = above.iter().map(|y| place(0.137) + Vec2::new(0.0, unit * y)).collect();
        sampled(&mut flow, &points).iter().map(|sample| sample.velocity).collect()
    };
    let exact = seen(1.0);
    for unit in [1.0 / 128.0, 128.0] {
        for (one, other) in seen(unit).iter().zip(&exact) {
            assert!(one.distance(*other) < 1e-11, "{unit}: {one} {other}");
        }
    }
}
