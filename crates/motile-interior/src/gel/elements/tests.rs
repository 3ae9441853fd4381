use super::*;

/// A triangle across the seams of a box, from each of its corners, is that in the middle of the box.
#[test]
fn triangles_across_seams_are_those_in_the_middle() {
    let (periods, corners) = ([Some(4.0), Some(3.0)], [(0.0, 0.0), (1.0, 0.1), (0.3, 0.8)]);
    let seen = |shift: Vec2| {
        let wrapped = |at: Vec2| Vec2::new(at.x.rem_euclid(4.0) - 2.0, at.y.rem_euclid(3.0) - 1.5);
        let nodes: Vec<Vec2> = corners.iter().map(|&(x, y)| wrapped(Vec2::new(x, y) + shift)).collect();
        let mut elements = Elements::new(vec![[0, 1, 2], [1, 2, 0], [2, 0, 1]], 3, periods);
        elements.move_to(&nodes);
        assert!(elements.areas.iter().all(|area| (area - elements.areas[0]).abs() < 1e-12), "{shift}");
        let place = elements.place(0, &nodes, [0.2, 0.3, 0.5]) - nodes[0];
        (elements.areas[0], elements.gradients[0], place)
    };
    let (area, gradients, place) = seen(Vec2::new(2.0, 1.5));
    assert!((area - 0.5 * (0.8 - 0.03)).abs() < 1e-12 && place.distance(Vec2::new(0.45, 0.43)) < 1e-12);
    for shift in [(1.5, 1.0), (3.5, 1.4), (1.9, 2.6), (3.4, 2.7), (3.8, 2.95), (1.0, 0.0)] {
        let (other_area, other, other_place) = seen(Vec2::new(shift.0, shift.1));
        assert!((other_area - area).abs() < 1e-12 && other_place.distance(place) < 1e-12, "{shift:?}");
        assert!(other.iter().zip(gradients).all(|(one, two)| one.distance(two) < 1e-12), "{shift:?}");
    }
}
