//! Images in closed form against modes over fine nodes.

use motile_base::{Drive, Region, Vec2};

use super::*;
use crate::{LayerCurve, Symmetry, layer::Layers};

const WIDTH: f64 = 2.4;

/// Outlines of ellipses between two walls, one at a gap (length) from the lower wall and one from the upper wall.
fn ellipses(nodes: usize, gap: f64) -> [Vec<Vec2>; 2] {
    let ellipse = |centre: Vec2, [a, b]: [f64; 2]| {
        let at = |k: usize| TAU * k as f64 / nodes as f64;
        (0..nodes).map(|k| centre + Vec2::new(a * at(k).cos(), b * at(k).sin())).collect()
    };
    let half = 0.5 * WIDTH;
    [
        ellipse(Vec2::new(-1.4, -half + gap + 0.9), [1.1, 0.9]),
        ellipse(Vec2::new(1.3, half - 1.5 * gap - 1.0), [1.0, 1.0]),
    ]
}

fn loaded(drive: Drive, tolerance: f64, outlines: &[Vec<Vec2>]) -> Layers {
    let region = Region::Channel { length: 6.0, width: WIDTH, drive };
    let mut layers = Layers::new(region, tolerance, Symmetry::ToResolution).unwrap();
    let nodes = outlines[0].len();
    let force = |curve: usize, k: usize| {
        let t = TAU * k as f64 / nodes as f64 + curve as f64;
        Vec2::new(t.cos() + 0.3, (2.0 * t).sin() - 0.1) / nodes as f64
    };
    let forces: Vec<Vec<Vec2>> =
        (0..outlines.len()).map(|curve| (0..nodes).map(|k| force(curve, k)).collect()).collect();
    let given = outlines
        .iter()
        .zip(&forces)
        .map(|(positions, forces)| (LayerCurve { positions, period: Vec2::ZERO, nodes }, forces.as_slice()));
    layers.load(&given, false).unwrap();
    layers
}

/// Flow of the single layer, then that of a double layer.
fn flows(layers: &mut Layers) -> [Vec<f64>; 2] {
    let all = |layers: &Layers| layers.flow.iter().flat_map(|flow| flow.x.iter().chain(&flow.y)).copied().collect();
    layers.single_layer(true);
    let single = all(layers);
    let nodes = layers.curves[0].len();
    let velocity =
        |j: usize| (TAU * 2.0 * j as f64 / nodes as f64).cos() + 0.3 * (TAU * 0.5 * (j / nodes) as f64).sin();
    let values: Vec<f64> = (0..2 * nodes * layers.curves.len()).map(velocity).collect();
    let contrasts = [0.5, -0.8];
    layers.double_layer(Density { values: &values, contrasts: &contrasts[..layers.curves.len()] }, 1e-15);
    [single, all(layers)]
}

fn with_modes(mut layers: Layers) -> Layers {
    let Layers { walls, curves, plans, .. } = &mut layers;
    walls.as_mut().unwrap().use_modes(curves, plans).unwrap();
    layers
}

/// Largest difference over the largest value.
fn error(found: &[f64], expected: &[f64]) -> f64 {
    let largest = |values: &mut dyn Iterator<Item = f64>| values.map(f64::abs).fold(0.0, f64::max);
    let difference = largest(&mut found.iter().zip(expected).map(|(found, expected)| found - expected));
    difference / largest(&mut expected.iter().copied())
}

/// Errors of the single and of a double layer by images, against sums of modes.
fn errors(drive: Drive, nodes: usize, gap: f64) -> [f64; 2] {
    let layers = loaded(drive, 1e-13, &ellipses(nodes, gap));
    let mut modes = with_modes(layers.clone());
    let Layers { walls: Some(walls), curves, plans, .. } = &mut modes else { return [f64::NAN; 2] };
    walls.use_modes(curves, plans).unwrap();
    let mut images = layers;
    let Layers { walls: Some(walls), curves, plans, .. } = &mut images else { return [f64::NAN; 2] };
    walls.use_images(curves, plans);
    let [modes, images] = [flows(&mut modes), flows(&mut images)];
    let found = [0, 1].map(|layer| error(&images[layer], &modes[layer]));
    println!("{drive:?} {nodes} {gap}: {found:?}");
    found
}

/// 1e-10 is far below what the nodes leave of a film. At narrower gaps, 64 fine nodes for each node are too few for the
/// modes that this compares with.
#[test]
fn images_are_the_sums_of_modes() {
    for drive in [Drive::ZeroGradient, Drive::ZeroFlux] {
        for (nodes, gap) in [(48, 0.1), (48, 0.02), (96, 0.1), (96, 0.02)] {
            let [single, double] = errors(drive, nodes, gap);
            assert!(single < 1e-10 && double < 1e-10, "{drive:?} {nodes} {gap}: {single:e} {double:e}");
        }
    }
}

/// In a gap that is too narrow for modes, images of few nodes agree with images of many, because the curves and what is
/// on them are the same.
#[test]
fn images_in_the_narrowest_gaps_do_not_depend_on_the_nodes() {
    for gap in [0.004, 0.003] {
        let [few, many] = [48, 192].map(|nodes| {
            let mut layers = loaded(Drive::ZeroGradient, 1e-13, &ellipses(nodes, gap));
            assert!(layers.walls.as_ref().unwrap().uses_images());
            let step = nodes / 48;
            flows(&mut layers).map(|flow| flow.into_iter().step_by(step).collect::<Vec<_>>())
        });
        let [single, double] = [0, 1].map(|layer| error(&few[layer], &many[layer]));
        println!("{gap}: {single:e} {double:e}");
        assert!(single < 1e-9 && double < 1e-9, "{gap}: {single:e} {double:e}");
    }
}

/// However narrow the gap is, the images take no more modes than the width of the channel needs, and only the images of
/// the nodes next to the wall take fine nodes.
#[test]
fn narrow_gaps_take_few_modes() {
    let count = |gap: f64| {
        let mut layers = loaded(Drive::ZeroGradient, 1e-10, &ellipses(64, gap)[..1]);
        layers.single_layer(false);
        let walls = layers.walls.as_ref().unwrap();
        (walls.uses_images(), walls.mode_count(), walls.images.close.len())
    };
    let (wide, narrow, narrower) = (count(0.2), count(0.006), count(0.003));
    println!("{wide:?} {narrow:?} {narrower:?}");
    assert!(!wide.0 && narrow.0 && narrower.0);
    assert_eq!(narrow.1, 11);
    assert!(narrower.1 == narrow.1 && narrower.2 <= narrow.2 + 2 && narrow.2 < 32);
}
