use super::*;

const NODES: usize = 24;

fn ellipse(centre: Vec2, turned: f64) -> Profile {
    let at = |k: usize| centre + Vec2::from_angle(turned).rotate(Vec2::new(1.5, 0.8) * Vec2::from_angle(angle(k)));
    Profile { positions: (0..NODES).map(at).collect(), density: vec![1.0; NODES], nuclei: Vec::new() }
}

fn angle(k: usize) -> f64 {
    TAU * k as f64 / NODES as f64
}

/// Moments of an ellipse along its axes, which lie aslant.
#[test]
fn moments_of_an_ellipse_aslant() {
    let moments = ellipse(Vec2::new(0.4, -0.3), 0.6).moments().unwrap();
    assert!(moments.centroid.distance(Vec2::new(0.4, -0.3)) < 1e-12);
    let along = moments.aspect_ratio(Vec2::from_angle(0.6));
    assert!((along - 1.5 / 0.8).abs() < 1e-12, "{along}");
    // At 45 degrees to the axes as much along as across.
    assert!((moments.aspect_ratio(Vec2::from_angle(0.6 + 0.125 * TAU)) - 1.0).abs() < 1e-12);
}

/// Extrema lie between the nodes.
#[test]
fn extrema_between_the_nodes() {
    let positions = (0..NODES).map(|k| Vec2::from_angle(angle(k))).collect();
    let density = (0..NODES).map(|k| 2.0 + (angle(k) - 0.37).cos()).collect();
    let [high, low] = Profile { positions, density, nuclei: Vec::new() }.extrema().unwrap();
    assert!((high - 3.0).abs() < 1e-9 && (low - 1.0).abs() < 1e-9, "{high} {low}");
}

/// A droplet above the axis becomes one on it, which begins at its front.
#[test]
fn symmetrised_droplets_begin_at_their_front() {
    for (height, first) in [(0.0, 0), (0.25, 0), (-0.3, 3)] {
        let mut given = ellipse(Vec2::new(0.4, height), 0.0);
        given.positions.rotate_left(first);
        let found = given.symmetrised().unwrap();
        let exact = ellipse(Vec2::new(0.4, 0.0), 0.0);
        for (one, other) in found.positions.iter().zip(&exact.positions) {
            assert!(one.distance(*other) < 1e-9, "{height} {first}: {one} {other}");
        }
    }
}
