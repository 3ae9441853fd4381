//! Outlines as they are clicked, traced and gone wrong.

use super::*;

fn points(list: &[[f64; 2]]) -> Vec<Vec2> {
    list.iter().copied().map(Vec2::from).collect()
}

#[test]
fn direction_and_repeated_points_do_not_matter() {
    for scale in [1.0, 1e-6, 1e9] {
        let square = points(&[[1.0, 1.0], [3.0, 1.0], [3.0, 2.0], [1.0, 2.0]]);
        let square: Vec<Vec2> = square.into_iter().map(|point| point * scale).collect();
        let repeated = [vec![square[0]], square.clone(), vec![square[3], square[0]]].concat();
        let mut clockwise = repeated.clone();
        clockwise.reverse();
        for (given, turned) in [(repeated, false), (clockwise, true)] {
            let outline = closed(&given).unwrap();
            assert_eq!((outline.points.len(), outline.repeated, outline.was_clockwise), (4, 3, turned));
            assert!((outline.area / (2.0 * scale * scale) - 1.0).abs() < 1e-14);
            assert!((outline.perimeter / (6.0 * scale) - 1.0).abs() < 1e-14);
            assert!((outline.centroid / scale).distance(Vec2::new(2.0, 1.5)) < 1e-14);
            assert!(polygon::area(&outline.points) > 0.0);
        }
    }
}

#[test]
fn what_is_no_outline_is_refused() {
    for (list, said) in [
        (&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0]][..], "the outline has 2 different points. Give at least 3"),
        (&[], "the outline has 0 different points"),
        (&[[0.0, 0.0], [1.0, f64::NAN], [1.0, 1.0]], "point 1 of the outline, (1, NaN), is not a finite number"),
        (&[[0.0, 0.0], [1e60, 0.0], [1.0, 1.0]], "point 1 of the outline"),
        (&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]], "the outline encloses no area"),
        (
            &[[0.0, 0.0], [3.0, 3.0], [3.0, 0.0], [0.0, 2.0]],
            "crosses or touches itself near (1.2000, 1.2000), at its points 0 and 2",
        ),
    ] {
        let error = closed(&points(list)).unwrap_err().to_string();
        assert!(error.contains(said), "{error}");
    }
    // The numbers of a crossing are those of the given points, whichever their direction.
    let bow = points(&[[0.0, 0.0], [0.0, 2.0], [3.0, 0.0], [3.0, 3.5]]);
    let OutlineError::Crossing { first, second, .. } = closed(&bow).unwrap_err() else { panic!("no crossing") };
    let mut pair = [first, second];
    pair.sort_unstable();
    assert_eq!(pair, [1, 3]);
}

#[test]
fn lines_repeat_themselves() {
    let given = points(&[[4.0, 1.0], [3.0, 2.0], [2.0, 1.5], [0.0, 1.0]]);
    let outline = line(&given, 4.0).unwrap();
    assert_eq!((outline.points.len(), outline.repeated, outline.was_clockwise), (3, 1, true));
    // Trapezia of 2 x 1.25, 1 x 1.75 and 1 x 1.5.
    assert!((outline.area - 5.75).abs() < 1e-14);
    let error = line(&given, 3.0).unwrap_err().to_string();
    assert!(error.contains("further apart than the length of the region. Set `scale`"), "{error}");
    assert!(line(&given, -1.0).is_err());
    // A line in a wrong unit, and one that stands upright.
    for (given, period) in [(given, 410.0), (points(&[[1.0, 0.0], [1.0, 1.0], [1.0, 2.0]]), 4.0)] {
        let error = line(&given, period).unwrap_err().to_string();
        assert!(error.contains("covers hardly any of the length of the region. Set `scale`"), "{error}");
    }
    let looped = points(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, -1.0], [3.0, -1.0]]);
    assert!(matches!(line(&looped, 4.0), Err(OutlineError::Crossing { .. })));
}
