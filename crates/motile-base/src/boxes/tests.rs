use super::*;

const PLANE: [Option<f64>; 2] = [None; 2];

/// Places of a set without order, in the square from 0 to `side` (Weyl's sequence).
fn places(count: usize, side: f64) -> Vec<Vec2> {
    let part = |k: usize, step: f64| side * (k as f64 * step).fract();
    (0..count).map(|k| Vec2::new(part(k, 0.754_877_666_246_693), part(k, 0.569_840_290_998_053))).collect()
}

fn square(centre: Vec2) -> Frame {
    Frame::around([centre - Vec2::ONE, centre + Vec2::ONE])
}

#[test]
fn boxes_are_near_over_images() {
    let (frame, periods) = (square(Vec2::ONE), [Some(5.0), None]);
    assert!(frame.moved(Vec2::new(2.5, 0.0)).is_near(&frame, periods, 0.6));
    assert!(!frame.moved(Vec2::new(2.5, 0.0)).is_near(&frame, periods, 0.4));
    assert!(!frame.moved(Vec2::new(0.0, 2.5)).is_near(&frame, periods, 0.4));
    assert!(frame.moved(Vec2::new(5.3, 0.3)).is_inside(&frame, periods, 0.31));
    assert!(!frame.moved(Vec2::new(5.3, 0.3)).is_inside(&frame, periods, 0.29));
}

#[test]
fn a_tree_misses_nothing_that_is_near() {
    for (count, side) in [(0, 1.0), (1, 1.0), (8, 5.0), (9, 5.0), (300, 40.0)] {
        let frames: Vec<Frame> = places(count, side).into_iter().map(square).collect();
        let mut tree = BoxTree::default();
        for by_place in [true, false] {
            if by_place {
                tree.build_by_place(&frames);
            } else {
                tree.build(frames.iter().copied());
            }
            assert_eq!(tree.frame().is_some(), count > 0);
            for (frame, periods) in frames.iter().flat_map(|f| [(f, PLANE), (f, [Some(side), Some(1.5 * side)])]) {
                let mut found = Vec::new();
                tree.each_near(frame, periods, 0.7, &mut |item| found.push(item));
                found.sort_unstable();
                found.retain(|&item| frames[item].is_near(frame, periods, 0.7));
                let all = (0..count).filter(|&item| frames[item].is_near(frame, periods, 0.7));
                assert!(found.iter().copied().eq(all), "{count} {found:?}");
            }
        }
    }
}

/// Four times as many at the same density: a quadratic search looks at four times as many for each.
#[test]
fn pairs_looked_at_are_not_quadratic() {
    let looks = |count: usize| {
        let side = 4.0 * (count as f64).sqrt();
        let frames: Vec<Frame> = places(count, side).into_iter().map(square).collect();
        let mut tree = BoxTree::default();
        tree.build_by_place(&frames);
        let (mut pairs, mut nearest) = (0, 0);
        for frame in &frames {
            tree.each_near(frame, [Some(side); 2], 0.5, &mut |_| pairs += 1);
            let mut squared = f64::INFINITY;
            tree.search(frame.centre + Vec2::splat(0.1), [Some(side); 2], squared, &mut |item| {
                nearest += 1;
                squared = squared.min((frames[item].centre - frame.centre).length_squared() + 0.02);
                squared
            });
        }
        [pairs, nearest].map(|looks| looks as f64 / count as f64)
    };
    // Pairs of each item, and items looked at for the nearest one.
    let [few, many] = [1000, 4000].map(looks);
    assert!(few[0] < 27.0 && many[0] < 27.0, "{few:?} {many:?}");
    assert!(few[1] < 34.0 && many[1] < 46.0, "{few:?} {many:?}");
}

/// Among all images in a few rows and columns, in boxes whose rows are displaced.
#[test]
fn the_nearest_image_is_the_nearest_of_all() {
    for (tilt, lengths) in [(0.0, [2.0, 3.0]), (0.9, [2.0, 1.5]), (-0.7, [2.0, 1.1]), (1.0, [2.0, 2.0])] {
        let periods = Periods { lengths: lengths.map(Some), tilt };
        for k in 0..400 {
            let difference =
                Vec2::new((0.617 * f64::from(k)).rem_euclid(12.0) - 6.0, 4.0 * (0.37 * f64::from(k)).sin());
            let found = nearest_image(difference, periods);
            let steps = (-9..=9).flat_map(|i| (-9..=9).map(move |j| (f64::from(i), f64::from(j))));
            let image = |(i, j): (f64, f64)| difference + Vec2::new(i * lengths[0] + j * tilt, j * lengths[1]);
            let least = steps.map(image).map(Vec2::length).fold(f64::INFINITY, f64::min);
            assert!((found.length() - least).abs() < 1e-12, "{tilt} {difference}: {found} {least}");
        }
    }
}
