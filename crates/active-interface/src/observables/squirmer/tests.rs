use super::*;
use crate::Curve;
use approx::assert_relative_eq;

#[test]
fn a_squirmer_is_recovered() {
    let (b1, b2, heading) = (0.7, -0.4, 2.1);
    let markers = Curve::circle(1.3).unwrap().translated(Vec2::new(1.0, 2.0)).markers(40).unwrap();
    let frame = Frame::new(Vec2::new(1.0, 2.0), heading).unwrap();
    // Laboratory frame: the co-moving flow plus the swimming velocity B1/2.
    let velocities: Vec<Vec2> = markers
        .iter()
        .map(|p| {
            let r = frame.coordinates(*p);
            let theta = r.y.atan2(r.x);
            let azimuthal = b1 * theta.sin() + 0.5 * b2 * (2.0 * theta).sin();
            let outer = Vec2::new(-(theta + heading).sin(), (theta + heading).cos()) * azimuthal;
            outer + Vec2::new(heading.cos(), heading.sin()) * (0.5 * b1)
        })
        .collect();
    let fit = squirmer_coefficients(&markers, &velocities, VelocityFrame::CoMoving, &frame).unwrap();
    assert_relative_eq!(fit.b1, b1, max_relative = 1e-12);
    assert_relative_eq!(fit.b2, b2, max_relative = 1e-12);
    assert_relative_eq!(fit.beta().unwrap(), b2 / b1, max_relative = 1e-12);
    let lab = squirmer_coefficients(&markers, &velocities, VelocityFrame::Laboratory, &frame).unwrap();
    assert_relative_eq!(lab.b1, 0.5 * b1, max_relative = 1e-12);
    assert_relative_eq!(lab.b2, b2, max_relative = 1e-12);
    assert!(squirmer_coefficients(&markers, &velocities[1..], VelocityFrame::CoMoving, &frame).is_err());
    assert_eq!(SquirmerFit::default().beta(), None);
}

#[test]
fn second_order_on_an_ellipse() {
    // The reference is the integral over the polar angle with 100 times as many points.
    let fit = |count: usize| {
        let markers = Curve::ellipse(1.3, 0.8).unwrap().markers(count).unwrap();
        let frame = Frame::new(Vec2::ZERO, 0.0).unwrap();
        let velocities: Vec<Vec2> = markers.iter().map(|p| Vec2::new(p.x * p.y, 0.4 + p.x * p.x - p.y)).collect();
        squirmer_coefficients(&markers, &velocities, VelocityFrame::Laboratory, &frame).unwrap()
    };
    let n = 20_000;
    let mut exact = SquirmerFit::default();
    for i in 0..n {
        let theta = 2.0 * PI * f64::from(i) / f64::from(n);
        let (s, c) = theta.sin_cos();
        let r = 1.0 / ((c / 1.3).powi(2) + (s / 0.8).powi(2)).sqrt();
        let (x, y) = (r * c, r * s);
        let azimuthal = (0.4 + x * x - y) * c - x * y * s;
        exact.b1 += azimuthal * s * 2.0 / f64::from(n);
        exact.b2 += azimuthal * 8.0 * s * c / f64::from(n);
    }
    let error = |count| {
        let fit = fit(count);
        (fit.b1 - exact.b1).hypot(fit.b2 - exact.b2)
    };
    let (coarse, fine) = (error(60), error(120));
    assert!((coarse / fine).log2() > 1.9, "{coarse} {fine}");
}
