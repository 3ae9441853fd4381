use super::*;

/// Where nothing else is wanted, nodes are as far apart as the curvature allows: a tenth of a right angle, 40 on a
/// circle, whose number is even.
#[test]
fn gentle_walls_take_fewer_nodes() {
    let centre = Vec2::new(0.3, -0.2);
    for nodes in [24, 128] {
        let wall = RigidWall::post(centre, 1.5, nodes).unwrap().graded(|_| 10.0).unwrap();
        assert_eq!(wall.nodes, if nodes < 42 { nodes } else { 42 });
        assert!(wall.points.iter().all(|point| (point.distance(centre) - 1.5).abs() < 1e-8));
    }
}

/// A crest is as sharp as the same trough, on the way to it and from it.
#[test]
fn walls_turn_to_both_sides() {
    let peak = |x: f64| 0.5 * (-(x / 0.1).powi(2)).exp();
    let [crest, trough] =
        [1.0, -1.0].map(|sign| RigidWall::below(6.0, 48, |x| sign * peak(x - 0.7)).unwrap().sharpest_turn().0);
    assert!((crest - trough).abs() < 1e-12 && crest > 0.5, "{crest} {trough}");
}

/// The points of a closed polygon of straight sides, 16 per node at equal distances.
fn polygon(corners: &[Vec2], nodes: usize) -> Vec<Vec2> {
    let side = |k: usize| [corners[k], corners[(k + 1) % corners.len()]];
    let sides: Vec<[Vec2; 2]> = (0..corners.len()).map(side).collect();
    let step = sides.iter().map(|[a, b]| a.distance(*b)).sum::<f64>() / (16 * nodes) as f64;
    let (mut points, mut left) = (Vec::new(), 0.0);
    for [a, b] in sides {
        let length = a.distance(b);
        while left < length - 1e-9 * step {
            points.push(a + (b - a) * (left / length));
            left += step;
        }
        left -= length;
    }
    points
}

/// The rounding that is asked for resolves the corner, and nine tenths of it do not, however sharp the corner is and
/// however the wall has been rounded and graded before. A wedge needs several times what a right angle needs.
#[test]
fn the_rounding_that_is_asked_for_suffices() {
    let limit = 0.7;
    let mut over_spacing = Vec::new();
    for tip in [0.3_f64, 0.6, 1.0, 1.3] {
        let corners = [Vec2::ZERO, Vec2::new(4.0, 0.0), Vec2::new(4.0 - 3.0 * tip.cos(), 3.0 * tip.sin())];
        let sharp = RigidWall::obstacle(polygon(&corners, 200), 200).unwrap();
        for before in [0.0, 0.05, 0.1] {
            let wall = sharp.clone().rounded(before).unwrap();
            let found = wall.sharp_corner(3, limit).unwrap().expect("a sharp corner");
            let enough = found.rounding.expect("a rounding");
            assert!((found.wall, found.spacing > 0.04 && found.spacing < 0.06) == (3, true), "{found:?}");
            for (factor, resolved) in [(1.01, true), (0.9, false)] {
                let rounded = sharp.clone().rounded(factor * enough).unwrap();
                assert_eq!(rounded.sharp_corner(0, limit).unwrap().is_none(), resolved, "{tip} {before} {enough}");
            }
            if before == 0.0 {
                over_spacing.push(enough / found.spacing);
            }
        }
        // Nodes that are spread keep their distance at a corner. A needle would lose its shape.
        if tip < 0.5 {
            continue;
        }
        let graded = sharp.clone().rounded(0.05).unwrap().graded(|_| 0.05).unwrap();
        let found = graded.sharp_corner(0, limit).unwrap().and_then(|found| found.rounding).expect("a rounding");
        let cured = sharp.clone().rounded(1.1 * found).unwrap().graded(|_| 0.05).unwrap();
        assert!(cured.sharp_corner(0, limit).unwrap().is_none(), "{tip} {found}");
    }
    assert!(over_spacing[0] > 2.0 * over_spacing[2] && over_spacing[2] > 1.25, "{over_spacing:?}");
}

/// The distance of nodes follows a dip from a reach before it to a reach behind it, within 1e-4 of the change.
#[test]
fn spacings_follow_the_least_ones() {
    let (reach, mut values) = (24, vec![1.0; 256]);
    values[100..110].fill(0.2);
    let smooth = smoothed_below(&values, reach).unwrap();
    for (k, value) in smooth.iter().enumerate() {
        let away = (100_usize.saturating_sub(k)).max(k.saturating_sub(109));
        let expected = [0.2 - 1e-4..0.2 + 1e-4, 0.2 - 1e-12..1.0 + 1e-12, 1.0 - 1e-4..1.0 + 1e-4];
        let expected = &expected[(away > 0) as usize + (away > 2 * reach) as usize];
        assert!(expected.contains(value), "{k}: {value}");
    }
}

/// A flat wall takes as many nodes as the wish, whether it is the lower or the upper one; its last node is as far from
/// the first one of the next period.
#[test]
fn flat_walls_take_the_nodes_that_are_wanted() {
    for upper in [false, true] {
        let wall = if upper { RigidWall::above(6.0, 32, |_| 1.0) } else { RigidWall::below(6.0, 32, |_| -1.0) };
        let wall = wall.unwrap().graded(|_| 0.1).unwrap();
        assert!((60..=62).contains(&wall.nodes), "{}", wall.nodes);
        let many = wall.points.len();
        let next = |k: usize| if k + 1 == many { wall.points[0] + wall.period } else { wall.points[k + 1] };
        let step = 6.0 / many as f64;
        assert!((0..many).all(|k| (wall.points[k].distance(next(k)) / step - 1.0).abs() < 1e-6));
    }
}
