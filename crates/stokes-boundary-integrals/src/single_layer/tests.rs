use super::*;
use crate::error::refused;
use crate::{PeriodicCalculus, TensionPlacement};
use motile_base::Drive;
use std::f64::consts::TAU;

const LENGTH: f64 = 5.0;

fn channel() -> Region {
    Region::Channel { length: LENGTH, width: 4.0, drive: Drive::default() }
}

fn regions() -> [Region; 3] {
    [channel(), Region::Box { lengths: [LENGTH, 6.0] }, Region::Box { lengths: [LENGTH, 3.4] }]
}

/// A wavy curve to the right or left at a height, `count` points.
fn wave(height: f64, direction: f64, count: usize) -> Vec<Vec2> {
    let at = |k: usize| TAU * k as f64 / count as f64;
    let place = |t: f64| {
        Vec2::new(direction * LENGTH * t / TAU + 0.1 * t.sin() + 0.2, height + 0.15 * t.cos() - 0.05 * (2.0 * t).sin())
    };
    (0..count).map(at).map(place).collect()
}

fn ellipse(centre: Vec2, count: usize) -> Vec<Vec2> {
    let at = |k: usize| TAU * k as f64 / count as f64;
    (0..count).map(at).map(|t| centre + Vec2::new(0.6 * t.cos(), 0.4 * t.sin())).collect()
}

/// Forces at the nodes from smooth densities per parameter, different for each curve.
fn forces(nodes: &[usize]) -> Vec<f64> {
    let mut all = Vec::new();
    for (curve, &n) in nodes.iter().enumerate() {
        let phase = 0.4 + curve as f64;
        for component in [0.0, 1.3] {
            let at = |k: usize| TAU * k as f64 / n as f64;
            all.extend(
                (0..n).map(|k| ((at(k) + phase).cos() + (2.0 * at(k) + component).sin() + 0.3) * TAU / n as f64),
            );
        }
    }
    all
}

/// Two open curves and a closed one with a film of `gap` (roughly) between all of them, at `n` nodes a curve and half
/// as many on the closed one.
fn loaded(region: Region, gap: f64, n: usize) -> (SingleLayer, Vec<Vec<Vec2>>) {
    reciprocal(region, gap, n, Symmetry::ToResolution)
}

fn reciprocal(region: Region, gap: f64, n: usize, reciprocity: Symmetry) -> (SingleLayer, Vec<Vec<Vec2>>) {
    let mut layer = SingleLayer::new(region, 1e-13, reciprocity).unwrap();
    let curves = vec![wave(-0.8, 1.0, n), wave(0.8 + gap, -1.0, n), ellipse(Vec2::new(0.4, -0.25 + gap), n / 2)];
    let open = |sign: f64| Vec2::new(sign * LENGTH, 0.0);
    let given = [
        LayerCurve { positions: &curves[0], period: open(1.0), nodes: n },
        LayerCurve { positions: &curves[1], period: open(-1.0), nodes: n },
        LayerCurve { positions: &curves[2], period: Vec2::ZERO, nodes: n / 2 },
    ];
    layer.load(given.into_iter()).unwrap();
    (layer, curves)
}

/// Velocities at the nodes and at points.
fn flow(region: Region, gap: f64, n: usize, points: &[Vec2]) -> (Vec<f64>, Vec<FlowSample>) {
    let (mut layer, _) = loaded(region, gap, n);
    let mut out = vec![0.0; layer.entry_count()];
    layer.apply(&forces(&[n, n, n / 2]), &mut out).unwrap();
    let mut samples = vec![FlowSample::default(); points.len()];
    layer.sample(1.0, points, &mut samples).unwrap();
    (out, samples)
}

/// Every `step`-th node of all curves.
fn every(values: &[f64], nodes: &[usize], step: usize) -> Vec<f64> {
    let mut first = 0;
    let mut kept = Vec::new();
    for &n in nodes {
        for _ in 0..2 {
            kept.extend(values[first..first + n].iter().step_by(step));
            first += n;
        }
    }
    kept
}

#[test]
fn coarse_and_fine_nodes_agree_at_nodes_and_close_points() {
    for region in regions() {
        for gap in [0.2, 0.02] {
            let on_curve = wave(-0.8, 1.0, 7);
            let mut points = vec![Vec2::new(0.4, -0.25 + gap), Vec2::new(-1.9, 0.1), Vec2::new(2.4, -1.2)];
            points.extend(on_curve.iter().flat_map(|x| [0.01, -0.01, 1e-4].map(|d| *x + Vec2::new(0.0, d))));
            points.extend(on_curve);
            let (coarse, at_coarse) = flow(region, gap, 96, &points);
            // Ten times as many: the plain sums are exact to round-off at most of these points.
            let (fine, at_fine) = flow(region, gap, 960, &points);
            let kept = every(&fine, &[960, 960, 480], 10);
            let error = coarse.iter().zip(&kept).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            let between = at_coarse.iter().zip(&at_fine).map(|(a, b)| (a.velocity - b.velocity).length());
            let between = between.fold(0.0, f64::max);
            println!("{region:?} {gap}: {error:.1e} {between:.1e}");
            assert!(error < 1e-10 && between < 1e-10, "{region:?} {gap}: {error:e} {between:e}");
        }
    }
}

#[test]
fn the_operator_is_symmetric() {
    for region in regions() {
        for (gap, n) in [(0.1, 96), (0.02, 96), (0.02, 52)] {
            let nodes = [n, n, n / 2];
            let mut layers =
                [Symmetry::ToResolution, Symmetry::ToRoundOff].map(|kind| reciprocal(region, gap, n, kind).0);
            let count = layers[0].entry_count();
            let (a, mut b) = (forces(&nodes), forces(&nodes));
            b.rotate_left(n / 3);
            let mut power = |f: &[f64], g: &[f64], reciprocity| {
                let mut out = vec![0.0; count];
                layers[usize::from(reciprocity == Symmetry::ToRoundOff)].apply(f, &mut out).unwrap();
                out.iter().zip(g).map(|(u, g)| u * g).sum::<f64>()
            };
            let exact = power(&a, &b, Symmetry::ToRoundOff) - power(&b, &a, Symmetry::ToRoundOff);
            assert!(exact.abs() < 1e-10, "{exact:e}");
            // Any forces lose power, resolved or not.
            let rough: Vec<f64> = (0..count).map(|k| ((k * k) as f64).sin()).collect();
            assert!(power(&rough, &rough, Symmetry::ToRoundOff) > 0.0);
            let smooth = forces(&nodes);
            let [accurate, exact] = [Symmetry::ToResolution, Symmetry::ToRoundOff].map(|r| power(&smooth, &smooth, r));
            println!("{gap} {n}: {:.1e}", accurate / exact - 1.0);
            assert!(n < 96 || (accurate / exact - 1.0).abs() < 1e-9, "{accurate} {exact}");
        }
    }
}

/// Two lines a film apart that are mirror images of each other, with few nodes and forces that these do not resolve.
#[test]
fn mirror_images_move_as_such() {
    let nodes = 20;
    let below: Vec<Vec2> = wave(-0.35, 1.0, nodes).into_iter().map(|x| Vec2::new(x.x, x.y.min(-0.2))).collect();
    // What lies to the left of a line lies to the right of its image, so that the image is passed the other way.
    let image = |k: usize| (nodes - k) % nodes;
    let above: Vec<Vec2> = (0..nodes)
        .map(|k| below[image(k)] - Vec2::new(if k == 0 { 0.0 } else { LENGTH }, 0.0))
        .map(|x| Vec2::new(x.x, -x.y))
        .collect();
    let rough = |k: usize| [((k * k) as f64).sin(), ((3 * k * k) as f64).cos()];
    let mut forces = vec![0.0; 4 * nodes];
    for k in 0..nodes {
        let [x, y] = rough(k);
        (forces[k], forces[nodes + k]) = (x, y);
        (forces[2 * nodes + image(k)], forces[3 * nodes + image(k)]) = (x, -y);
    }
    for region in regions() {
        let mut layer = SingleLayer::new(region, 1e-6, Symmetry::ToRoundOff).unwrap();
        let given = [(&below, 1.0), (&above, -1.0)];
        let given = given.map(|(positions, sign)| (positions, Vec2::new(sign * LENGTH, 0.0)));
        layer.load(given.into_iter().map(|(positions, period)| LayerCurve { positions, period, nodes })).unwrap();
        let mut flow = vec![0.0; 4 * nodes];
        layer.apply(&forces, &mut flow).unwrap();
        let size = flow.iter().fold(0.0_f64, |most, u| most.max(u.abs()));
        for k in 0..nodes {
            let [x, y] = [flow[k] - flow[2 * nodes + image(k)], flow[nodes + k] + flow[3 * nodes + image(k)]];
            assert!(x.hypot(y) < 1e-12 * size, "{region:?} {k}: {x:e} {y:e} of {size}");
        }
    }
}

/// A tall ellipse and its own images above and below, 0.05 apart; symmetry to round-off costs accuracy of the film.
#[test]
fn a_curve_close_to_its_own_image_moves_as_with_fine_nodes() {
    let flow = |kind: Symmetry, n: usize| {
        let mut layer = SingleLayer::new(Region::Box { lengths: [LENGTH, 1.25] }, 1e-13, kind).unwrap();
        let positions: Vec<Vec2> = ellipse(Vec2::ZERO, n).into_iter().map(Vec2::perp).collect();
        layer.load([LayerCurve { positions: &positions, period: Vec2::ZERO, nodes: n }].into_iter()).unwrap();
        let mut out = vec![0.0; layer.entry_count()];
        layer.apply(&forces(&[n]), &mut out).unwrap();
        every(&out, &[n], n / 96)
    };
    let fine = flow(Symmetry::ToResolution, 960);
    for kind in [Symmetry::ToResolution, Symmetry::ToRoundOff] {
        let error = flow(kind, 96).iter().zip(&fine).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        println!("{kind:?}: {error:.1e}");
        assert!(error < 1e-8, "{kind:?}: {error:e}");
    }
}

/// A small ellipse inside a large one and a third one beside them, in a box whose images are a series.
#[test]
fn closed_curves_in_a_box_move_as_by_all_images_node_by_node() {
    let curves = [(Vec2::ZERO, 2.0, 144), (Vec2::new(0.1, 0.2), 1.0, 96), (Vec2::new(2.4, 0.5), 1.5, 120)].map(
        |(centre, size, nodes)| -> Vec<Vec2> {
            ellipse(Vec2::ZERO, nodes).into_iter().map(|x| centre + size * x).collect()
        },
    );
    let loaded = |tolerance: f64| {
        let region = Region::Box { lengths: [LENGTH, 4.2] };
        let mut layer = SingleLayer::new(region, tolerance, Symmetry::ToRoundOff).unwrap();
        let given = curves.iter().map(|positions| (positions, positions.len()));
        let given = given.map(|(positions, nodes)| LayerCurve { positions, period: Vec2::ZERO, nodes });
        layer.load(given).unwrap();
        layer
    };
    let nodes = curves.each_ref().map(Vec::len);
    let (one, mut other) = (forces(&nodes), forces(&nodes));
    other.rotate_left(31);
    let mut layer = loaded(1e-12);
    let (mut u, mut v) = (vec![0.0; one.len()], vec![0.0; one.len()]);
    layer.apply(&one, &mut u).unwrap();
    // The sums at points have the Green's function of the box in closed form.
    for (index, curve) in curves.iter().enumerate() {
        let mut samples = vec![FlowSample::default(); curve.len()];
        layer.sample(1.0, curve, &mut samples).unwrap();
        let (x, y) = u[layer.entries(index)].split_at(curve.len());
        for ((x, y), sample) in x.iter().zip(y).zip(&samples) {
            assert!((sample.velocity - Vec2::new(*x, *y)).length() < 1e-10, "{index}: {sample:?} {x} {y}");
        }
    }
    // However few terms the series have, they are those of a symmetric operator.
    let mut layer = loaded(1e-3);
    layer.apply(&one, &mut u).unwrap();
    layer.apply(&other, &mut v).unwrap();
    let power = |u: &[f64], f: &[f64]| u.iter().zip(f).map(|(u, f)| u * f).sum::<f64>();
    let (there, back) = (power(&u, &other), power(&v, &one));
    assert!((there - back).abs() < 1e-13 * there.abs(), "{there} {back}");
}

#[test]
fn a_pressure_behind_a_curve_moves_nothing() {
    for region in regions() {
        let (mut layer, _) = loaded(region, 0.05, 96);
        let mut out = vec![0.0; layer.entry_count()];
        for curve in 0..3 {
            let mut forces = vec![0.0; layer.entry_count()];
            let range = layer.entries(curve);
            layer.normals(curve, &mut forces[range]).unwrap();
            layer.apply(&forces, &mut out).unwrap();
            let largest = out.iter().map(|u| u.abs()).fold(0.0, f64::max);
            assert!(largest < 1e-11, "{region:?} {curve}: {largest:e}");
        }
    }
}

#[test]
fn curves_that_do_not_go_on_with_the_region_are_refused() {
    let positions = wave(0.0, 1.0, 32);
    let load = |region, period| {
        let mut layer = SingleLayer::new(region, 1e-8, Symmetry::ToResolution).unwrap();
        layer.load([LayerCurve { positions: &positions, period, nodes: 32 }].into_iter())
    };
    assert_eq!(load(channel(), Vec2::new(LENGTH, 0.0)), Ok(()));
    for (region, period) in [
        (channel(), Vec2::new(4.9, 0.0)),
        (channel(), Vec2::new(LENGTH, 0.1)),
        (channel(), Vec2::new(f64::NAN, 0.0)),
        (Region::Plane, Vec2::new(LENGTH, 0.0)),
    ] {
        let error = load(region, period).unwrap_err();
        assert!(refused(&error, "curve 0 has the wrong period"), "{error}");
    }
}

/// A wave of small amplitude on an interface with tension relaxes at the rate tension k/(4 eta).
#[test]
fn waves_relax_at_their_rate() {
    let (nodes, amplitude) = (48, 1e-3);
    let region = Region::Channel { length: TAU, width: 40.0, drive: Drive::default() };
    let period = Vec2::new(TAU, 0.0);
    let at = |k: usize| TAU * k as f64 / nodes as f64;
    let positions: Vec<Vec2> = (0..nodes).map(|k| Vec2::new(at(k), amplitude * (2.0 * at(k)).cos())).collect();
    let mut forces = vec![Vec2::ZERO; nodes];
    let mut calculus = PeriodicCalculus::new(nodes).unwrap().with_period(period);
    calculus.tension_forces(&positions, &vec![3.0; nodes], TensionPlacement::Points, &mut forces).unwrap();
    let mut layer = SingleLayer::new(region, 1e-12, Symmetry::ToResolution).unwrap();
    layer.load([LayerCurve { positions: &positions, period, nodes }].into_iter()).unwrap();
    let forces: Vec<f64> = forces.iter().map(|f| f.x).chain(forces.iter().map(|f| f.y)).collect();
    let mut out = vec![0.0; 2 * nodes];
    layer.apply(&forces, &mut out).unwrap();
    for k in 0..nodes {
        let expected = -3.0 * 2.0 / 4.0 * positions[k].y;
        // The next term is of the third power of the amplitude.
        assert!((out[nodes + k] - expected).abs() < 10.0 * amplitude.powi(3), "{} {expected}", out[nodes + k]);
    }
}

#[test]
fn steady_state_allocates_nothing() {
    let kinds = [Symmetry::ToResolution, Symmetry::ToRoundOff];
    for (region, kind) in regions().into_iter().flat_map(|region| kinds.map(|kind| (region, kind))) {
        let (mut layer, curves) = reciprocal(region, 0.05, 64, kind);
        let forces = forces(&[64, 64, 32]);
        let mut out = vec![0.0; layer.entry_count()];
        let mut go = |layer: &mut SingleLayer| {
            let open = |sign: f64| Vec2::new(sign * LENGTH, 0.0);
            let periods = [open(1.0), open(-1.0), Vec2::ZERO];
            let given = curves.iter().zip(periods).zip([64, 64, 32]);
            layer.load(given.map(|((positions, period), nodes)| LayerCurve { positions, period, nodes })).unwrap();
            layer.apply(&forces, &mut out).unwrap();
        };
        go(&mut layer);
        assert_eq!(allocation_counter::measure(|| go(&mut layer)).count_total, 0);
    }
}
