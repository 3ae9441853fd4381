use super::*;

const PLACE: Vec2 = Vec2::new(0.3, -0.7);

fn general() -> ImposedFlow {
    ImposedFlow { velocity: [0.2, -0.5], gradient: [[0.3, 1.1], [-0.4, -0.3]], bend: -1.6 }
}

/// Differences of a parabola are exact.
#[test]
fn gradients_are_the_slopes_of_the_velocity() {
    let (flow, step) = (general(), 0.125);
    let slope =
        |way: Vec2| (flow.velocity_at(PLACE + step * way) - flow.velocity_at(PLACE - step * way)) / (2.0 * step);
    let (by_x, by_y) = (slope(Vec2::X), slope(Vec2::Y));
    for (found, expected) in flow.gradient_at(PLACE).as_flattened().iter().zip([by_x.x, by_y.x, by_x.y, by_y.y]) {
        assert!((found - expected).abs() < 1e-14, "{found} {expected}");
    }
    let seen = flow.sample(PLACE, 2.5);
    assert_eq!((seen.velocity, seen.gradient), (flow.velocity_at(PLACE), flow.gradient_at(PLACE)));
    // What the fluid needs for the curvature d2u/dy2: dp/dx = eta d2u/dy2.
    let bent = (flow.velocity_at(PLACE + step * Vec2::Y) + flow.velocity_at(PLACE - step * Vec2::Y)
        - 2.0 * flow.velocity_at(PLACE))
        / (step * step);
    assert!((seen.pressure - 2.5 * bent.x * PLACE.x).abs() < 1e-13 && bent.y.abs() < 1e-13, "{bent}");
}

#[test]
fn named_flows_are_what_they_are_called() {
    assert_eq!(ImposedFlow::shear(2.0).velocity_at(PLACE), Vec2::new(-1.4, 0.0));
    assert_eq!(ImposedFlow::extension(2.0).velocity_at(PLACE), Vec2::new(0.6, 1.4));
    assert_eq!(ImposedFlow::rotation(2.0).velocity_at(PLACE), 2.0 * PLACE.perp());
    let poiseuille = ImposedFlow::poiseuille(3.0, 2.0).unwrap();
    for (y, speed) in [(0.0, 3.0), (1.0, 2.25), (2.0, 0.0), (-2.0, 0.0)] {
        assert!((poiseuille.velocity_at(Vec2::new(9.0, y)) - Vec2::new(speed, 0.0)).length() < 1e-14, "{y}");
    }
    let couette = ImposedFlow::couette([-1.0, 4.0], 2.0);
    for (y, speed) in [(-1.0, -1.0), (0.0, 1.5), (1.0, 4.0)] {
        assert!((couette.velocity_at(Vec2::new(9.0, y)) - Vec2::new(speed, 0.0)).length() < 1e-14, "{y}");
    }
    assert!(ImposedFlow::poiseuille(1.0, 0.0).is_err());
}

/// Half of the sum of the squares of the gradient, whose root is the rate of an extension.
#[test]
fn rates_and_sums() {
    assert_eq!((ImposedFlow::extension(-3.0).rate(), ImposedFlow::rotation(3.0).rate()), (3.0, 3.0));
    assert!((ImposedFlow::shear(2.0).rate() - 2.0_f64.sqrt()).abs() < 1e-15);
    assert_eq!((general().shear_rate(), ImposedFlow::NONE.is_none(), general().is_none()), (1.1, true, false));
    let other = ImposedFlow { velocity: [1.0, 2.0], gradient: [[4.0, 8.0], [16.0, -4.0]], bend: 32.0 };
    let sum = (general() + other).velocity_at(PLACE) - general().velocity_at(PLACE) - other.velocity_at(PLACE);
    assert!(sum.length() < 1e-13, "{sum}");
}

#[test]
fn flows_that_do_not_keep_areas_are_refused() {
    assert!(general().check().is_ok());
    let swelling = ImposedFlow { gradient: [[0.3, 1.1], [-0.4, -0.299]], ..general() };
    let error = swelling.check().unwrap_err();
    assert!(error.to_string().contains("the divergence of an imposed flow"), "{error}");
    for bad in [
        ImposedFlow { velocity: [f64::NAN, 0.0], ..general() },
        ImposedFlow { gradient: [[0.0, f64::INFINITY], [0.0, 0.0]], ..general() },
        ImposedFlow { bend: f64::NAN, ..general() },
    ] {
        assert!(bad.check().is_err(), "{bad:?}");
    }
}
