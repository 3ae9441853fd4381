use super::*;
use proptest::prelude::*;

#[test]
fn extremes() {
    assert_eq!(wall_gap(&[], [-1.0, 1.0]), f64::INFINITY);
    assert_eq!(wall_gap(&[Vec2::new(0.0, 1.125)], [-1.0, 1.0]), -0.125);
    for markers in [[Vec2::new(0.0, f64::NAN), Vec2::ZERO], [Vec2::ZERO, Vec2::new(0.0, f64::NAN)]] {
        assert!(wall_gap(&markers, [-1.0, 1.0]).is_nan());
    }
}

proptest! {
    #[test]
    fn a_circle(x in -9.0..9.0f64, y in -0.9..0.9f64, radius in 0.1..2.0f64) {
        let circle: Vec<Vec2> = (0..360).map(|k| {
            let (sin, cos) = (f64::from(k)).to_radians().sin_cos();
            Vec2::new(x + radius * cos, y + radius * sin)
        }).collect();
        let expected = (1.5 - y.abs()) - radius;
        prop_assert!((wall_gap(&circle, [-1.5, 1.5]) - expected).abs() < 1e-14);
    }
}

/// Circles of radius 0.3 at places, in a box of these lengths.
fn circles(places: &[Vec2], lengths: [f64; 2]) -> (Surfaces, FluidView) {
    let bodies = places.iter().map(|place| {
        let mut boundary = Boundary::default();
        let corners: Vec<Vec2> = (0..24)
            .map(|k| f64::from(15 * k).to_radians())
            .map(|t| place + 0.3 * Vec2::new(t.cos(), t.sin()))
            .collect();
        boundary.push_loop(&corners);
        (boundary, MarkerKind::Interface { viscosity_inside: None })
    });
    let domain = Domain { origin: [0.0; 2], periods: lengths.map(Some).into(), walls: None };
    let view = FluidView {
        domain,
        viscosity: 1.0,
        spacing: None,
        second_order: true,
        shape_modes: Some(24),
        nodes: Some(24),
        interface_stiffness: 1.0,
    };
    (Surfaces::of(bodies), view)
}

proptest! {
    #[test]
    fn near_pairs_and_the_narrowest_gap_are_those_of_all(
        places in prop::collection::vec((-3.0..3.0f64, -2.0..2.0f64), 2..12), reach in 0.01..2.0f64,
    ) {
        let places: Vec<Vec2> = places.into_iter().map(Vec2::from).collect();
        let (surfaces, view) = circles(&places, [6.0, 4.0]);
        let all = surfaces.gaps(&view, f64::INFINITY, |_| true).narrowest;
        prop_assert_eq!(surfaces.narrowest(&view), all);
        // The narrowest gap of each pair by itself.
        let pairs = surfaces.pairs_near(&view, reach);
        for a in 0..places.len() {
            for b in a..places.len() {
                let own = surfaces.gaps(&view, f64::INFINITY, |pair| pair == [a, b] || pair == [b, a]).narrowest;
                let expected = own.map(|gap| gap.width).filter(|width| width.abs() < reach);
                let found: Vec<f64> = pairs.iter().filter(|(pair, _)| *pair == [a, b]).map(|pair| pair.1).collect();
                if expected.is_some() || own.is_none_or(|gap| gap.width >= reach) {
                    prop_assert_eq!(found, expected.into_iter().collect::<Vec<f64>>());
                }
            }
        }
    }
}

/// Squares of the size 1 that are no interfaces: only where they have crossed, and no gaps of theirs are kept.
#[test]
fn solids_that_have_crossed_are_found() {
    let view = FluidView { spacing: Some(0.1), ..circles(&[], [6.0, 6.0]).1 };
    let crossed = |apart: f64| {
        let squares = [(0.0, 0.0), (1.0 + apart, 0.3)].map(|(x, y)| {
            let mut square = Boundary::default();
            let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
            square.push_loop(&corners.map(|(u, v)| Vec2::new(x + u, y + v)));
            (square, MarkerKind::Points)
        });
        let gaps = Surfaces::of(squares).gaps_near(&view, 0.0);
        assert_eq!(gaps.narrowest, None);
        gaps.crossed.map(|overlap| (overlap.body, overlap.other, (1e6 * overlap.depth).round()))
    };
    assert_eq!([0.3, 0.01, -0.024].map(crossed), [None; 3]);
    assert_eq!(crossed(-0.026), Some((0, 1, 26e3)));
    // Over the period too.
    assert_eq!(crossed(4.01), None);
    assert!(crossed(3.97).is_none() && crossed(4.03).is_some());
}
