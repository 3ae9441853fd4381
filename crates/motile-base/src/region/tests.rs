use super::*;

#[test]
fn lengths_and_periods_are_those_of_the_fluid() {
    let channel = Region::Channel { length: 8.0, width: 3.0, drive: Drive::Flux(0.5) };
    assert_eq!((channel.lengths(), channel.periods()), ([8.0, 3.0], [Some(8.0), None]));
    assert_eq!((channel.drive(), channel.drive().and_then(Drive::flux)), (Some(Drive::Flux(0.5)), Some(0.5)));
    let square = Region::Box { lengths: [6.0, 5.0] };
    assert_eq!((square.lengths(), square.periods(), square.drive()), ([6.0, 5.0], [Some(6.0), Some(5.0)], None));
    // A tube whose sides come first in or out is as wide.
    for amplitude in [0.25, -0.25] {
        let shape = TubeShape::Sinusoidal { amplitude, period: 4.0 };
        let tube = Region::Tube { radius: 2.0, shape, drive: Drive::ZeroFlux, length: Some(16.0) };
        assert_eq!((tube.lengths(), tube.periods()), ([16.0, 4.5], [None; 2]));
    }
    assert_eq!((Region::Plane.lengths(), Region::Plane.periods()), ([f64::INFINITY; 2], [None; 2]));
    let slit = Region::Slit { lower: -2.0, upper: 1.0 };
    assert_eq!((slit.lengths(), slit.periods(), slit.drive()), ([f64::INFINITY; 2], [None; 2], None));
    let cuboid = Region::SpaceBox { lengths: [6.0, 5.0, 4.0] };
    assert_eq!((cuboid.lengths(), cuboid.periods()), ([6.0, 5.0], [Some(6.0), Some(5.0)]));
    assert!(!slit.is_axisymmetric() && !cuboid.is_axisymmetric());
}

#[test]
fn one_of_gradient_and_flux_is_held_fixed() {
    for (drive, gradient, flux) in [
        (Drive::ZeroGradient, 0.0, None),
        (Drive::Gradient(-2.0), -2.0, None),
        (Drive::ZeroFlux, 0.0, Some(0.0)),
        (Drive::Flux(3.0), 0.0, Some(3.0)),
    ] {
        assert_eq!((drive.gradient(), drive.flux()), (gradient, flux), "{drive:?}");
    }
}

#[test]
fn bad_numbers_are_refused_by_name() {
    let channel = |length, width, drive| Region::Channel { length, width, drive };
    for (region, name) in [
        (Region::Box { lengths: [0.0, 1.0] }, "the period in x"),
        (Region::Box { lengths: [1.0, f64::NAN] }, "the period in y"),
        (Region::SpaceBox { lengths: [1.0, 1.0, -1.0] }, "the period in z"),
        (Region::Slit { lower: f64::NAN, upper: 1.0 }, "the height of the lower wall"),
        (Region::Slit { lower: 0.0, upper: f64::INFINITY }, "the height of the upper wall"),
        (Region::Slit { lower: 1.0, upper: 1.0 }, "the distance of the upper wall"),
        (channel(-1.0, 1.0, Drive::ZeroFlux), "the period of the channel"),
        (channel(1.0, f64::INFINITY, Drive::ZeroFlux), "the width of the channel"),
        (channel(1.0, 1.0, Drive::Flux(f64::NAN)), "the imposed flux"),
        (channel(1.0, 1.0, Drive::Gradient(f64::INFINITY)), "the imposed pressure gradient"),
    ] {
        let error = region.check().unwrap_err().to_string();
        assert!(error.starts_with(name), "{error}");
    }
    assert!(Region::Plane.check().is_ok() && channel(1.0, 1.0, Drive::ZeroGradient).check().is_ok());
}

/// Tubes that are shorter than their shape are told the length that they want.
#[test]
fn short_tubes_are_told_their_least_length() {
    let tube = |shape, length| Region::Tube { radius: 1.5, shape, drive: Drive::ZeroFlux, length: Some(length) };
    let wavy = TubeShape::Sinusoidal { amplitude: 0.3, period: 6.0 };
    let narrow = TubeShape::Constriction { throat: 0.9, throat_length: 2.0, ramp: 1.0 };
    for (shape, least) in [(wavy, 12.0), (narrow, 10.0)] {
        let error = tube(shape, least - 0.5).check().unwrap_err().to_string();
        assert!(error.contains(&format!("from {least}")) && error.contains("length of a tube"), "{error}");
        assert!(tube(shape, least).check().is_ok());
    }
}

/// A throat that is wider than the ends leaves them the narrowest.
#[test]
fn the_least_radius_is_that_of_the_narrowest_place() {
    let throat = |throat| TubeShape::Constriction { throat, throat_length: 2.0, ramp: 1.0 };
    let wavy = |amplitude| TubeShape::Sinusoidal { amplitude, period: 6.0 };
    for (shape, least) in
        [(TubeShape::Straight, 1.5), (throat(0.5), 0.5), (throat(2.0), 1.5), (wavy(0.25), 1.25), (wavy(-0.25), 1.25)]
    {
        assert_eq!(shape.least_radius(1.5), least, "{shape:?}");
        let places = (0..=2000).map(|k| shape.radius(1.5, 10.0, 0.01 * f64::from(k - 1000)));
        assert!((places.fold(f64::INFINITY, f64::min) - least).abs() < 1e-3, "{shape:?}");
    }
}
