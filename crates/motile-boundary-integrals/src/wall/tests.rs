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
        [1.0, -1.0].map(|sign| RigidWall::below(6.0, 48, |x| sign * peak(x - 0.7)).unwrap().sharpest_turn());
    assert!((crest - trough).abs() < 1e-12 && crest > 0.5, "{crest} {trough}");
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
