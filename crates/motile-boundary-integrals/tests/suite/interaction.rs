//! Several interfaces: gaps, seams, contrasts.

use crate::scenes;

use motile_base::{Region, Vec2};
use motile_boundary_integrals::{BoundaryIntegral, Settings};
use motile_scene::Hydrodynamics;
use scenes::{Ellipse, markers};

const COUNT: usize = 512;

fn velocities(region: Region, ellipses: &[Ellipse], nodes: usize, tolerance: f64) -> Vec<Vec2> {
    let settings = Settings { nodes, tolerance, ..Settings::default() };
    let mut solver = BoundaryIntegral::new(region, 1.0, settings).expect("a valid scene");
    let mut markers = markers(ellipses, COUNT);
    solver.velocities(&mut markers).expect("a valid scene");
    markers.velocities().to_vec()
}

/// Largest error over the largest velocity.
fn error(found: &[Vec2], reference: &[Vec2]) -> f64 {
    let scale = reference.iter().map(|v| v.length()).fold(0.0, f64::max);
    found.iter().zip(reference).map(|(a, b)| (a - b).length()).fold(0.0, f64::max) / scale
}

fn circles(gap: f64, viscosity: f64) -> [Ellipse; 2] {
    let circle = |x, tension| Ellipse { viscosity: Some(viscosity), ..Ellipse::circle(x, 0.0, tension) };
    [circle(0.0, |t| 1.0 + 0.5 * t.cos()), circle(2.0 + gap, |t| 1.0 + 0.3 * (t - 1.0).cos())]
}

#[test]
fn gaps_between_droplets() {
    // 64 nodes are 0.098 apart. With equal viscosities the gap does not matter; with a contrast the velocity itself is
    // less smooth the closer the interfaces are.
    let table = [
        (1.0, [(0.4, 1e-10), (0.1, 3e-9), (0.05, 5e-9), (0.02, 1e-8)]),
        (10.0, [(0.4, 1e-9), (0.1, 5e-6), (0.05, 1e-4), (0.02, 1e-3)]),
        (100.0, [(0.4, 1e-9), (0.1, 5e-6), (0.05, 2e-4), (0.02, 1e-3)]),
    ];
    for (ratio, row) in table {
        for (gap, bound) in row {
            let droplets = circles(gap, ratio);
            let reference = velocities(Region::Plane, &droplets, 320, 1e-13);
            let found = error(&velocities(Region::Plane, &droplets, 64, 1e-12), &reference);
            println!("ratio {ratio} gap {gap}: {found:.1e}");
            assert!(found < bound, "ratio {ratio} gap {gap}: {found:e}");
            let finer = error(&velocities(Region::Plane, &droplets, 128, 1e-12), &reference);
            assert!(finer < 0.05 * found || finer < 1e-11, "ratio {ratio} gap {gap}: {found:e} {finer:e}");
        }
    }
}

fn three(ratio: f64) -> [Ellipse; 3] {
    let first = Ellipse {
        centre: [0.3, 0.1],
        axes: [1.2, 0.8],
        angle: 0.4,
        viscosity: Some(ratio),
        tension: |t| 1.0 + 0.5 * t.cos(),
    };
    let second = Ellipse { centre: [2.6, 0.9], axes: [0.9, 1.0], angle: 0.1, viscosity: Some(2.0), ..first };
    let third = Ellipse { centre: [4.9, -1.1], axes: [0.5, 0.6], viscosity: None, ..second };
    [first, second, third]
}

#[test]
fn extreme_ratios_converge_in_a_box() {
    let region = Region::Box { lengths: [6.5, 4.5] };
    for ratio in [0.001, 1000.0] {
        let reference = velocities(region, &three(ratio), 192, 1e-13);
        let found = [64, 96, 128].map(|nodes| error(&velocities(region, &three(ratio), nodes, 1e-13), &reference));
        assert!(found[0] < 1e-7 && found[1] < 1e-10 && found[2] < 1e-12, "{ratio}: {found:?}");
        // The tolerance bounds what the sums leave out.
        let loose = error(&velocities(region, &three(ratio), 128, 1e-8), &reference);
        assert!(loose < 3e-8, "{loose:e}");
    }
}

#[test]
fn images_turn_with_the_box_and_seams_do_not_show() {
    let region = Region::Box { lengths: [6.5, 4.5] };
    let droplets = three(20.0);
    let expected = velocities(region, &droplets, 96, 1e-13);
    let mut turned = droplets;
    for droplet in &mut turned {
        droplet.centre = [-droplet.centre[1], droplet.centre[0]];
        droplet.angle += std::f64::consts::FRAC_PI_2;
    }
    let found = velocities(Region::Box { lengths: [4.5, 6.5] }, &turned, 96, 1e-13);
    let back: Vec<Vec2> = found.iter().map(|v| Vec2::new(v.y, -v.x)).collect();
    assert!(error(&back, &expected) < 1e-12);
    let mut moved = droplets;
    moved[1].centre[0] += 13.0;
    moved[2].centre[1] -= 4.5;
    assert!(error(&velocities(region, &moved, 96, 1e-13), &expected) < 5e-12);
}

#[test]
fn a_large_box_is_free_space_less_its_mean_flow() {
    // The leading image effect of force-free droplets falls off with the square of the period.
    let droplets = circles(0.4, 5.0);
    let free = velocities(Region::Plane, &droplets, 64, 1e-12);
    let [near, far] =
        [40.0, 80.0].map(|l| error(&velocities(Region::Box { lengths: [l, l] }, &droplets, 64, 1e-12), &free));
    assert!((near / far - 4.0).abs() < 0.1, "{near:e} {far:e}");
}

#[test]
fn rows_of_images_and_moments_agree() {
    // A droplet that fills most of the box is summed by rows, a small one by moments: the same lattice of droplets seen
    // with one droplet a cell and with two goes both ways.
    let droplet = Ellipse { centre: [0.2, 0.1], axes: [1.3, 1.1], angle: 0.3, ..three(8.0)[0] };
    let one = velocities(Region::Box { lengths: [3.0, 3.4] }, &[droplet], 96, 1e-13);
    let copy = Ellipse { centre: [3.2, 0.1], ..droplet };
    let two = velocities(Region::Box { lengths: [6.0, 3.4] }, &[droplet, copy], 96, 1e-13);
    assert!(error(&two[..COUNT], &one) < 1e-11, "{:e}", error(&two[..COUNT], &one));
    assert!(error(&two[COUNT..], &one) < 1e-11);
    let four = [droplet, copy, Ellipse { centre: [0.2, 3.5], ..droplet }, Ellipse { centre: [3.2, 3.5], ..droplet }];
    let four = velocities(Region::Box { lengths: [6.0, 6.8] }, &four, 96, 1e-13);
    assert!(error(&four[..COUNT], &one) < 1e-11, "{:e}", error(&four[..COUNT], &one));
}

#[test]
fn more_nodes_than_are_stored_give_the_same_flow() {
    // 24 droplets with 64 nodes exceed what is stored; their lattice is that of one droplet a cell.
    let droplet = Ellipse { centre: [0.2, 0.1], axes: [0.8, 0.9], angle: 0.3, ..three(8.0)[0] };
    let one = velocities(Region::Box { lengths: [2.5, 2.5] }, &[droplet], 64, 1e-9);
    let many: Vec<Ellipse> = (0..6)
        .flat_map(|i| (0..4).map(move |j| [0.2 + 2.5 * f64::from(i), 0.1 + 2.5 * f64::from(j)]))
        .map(|centre| Ellipse { centre, ..droplet })
        .collect();
    let many = velocities(Region::Box { lengths: [15.0, 10.0] }, &many, 64, 1e-9);
    for found in many.chunks_exact(COUNT) {
        assert!(error(found, &one) < 1e-7, "{:e}", error(found, &one));
    }
}
