use super::*;

type Vec3 = [f64; 3];

fn dot3(a: Vec3, b: Vec3) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Sum over 4000 azimuths of a kernel's velocity in x and from the axis, for a vector of the ring along x and r.
fn summed_over_angles(d: Vec2, target: f64, source: f64, kernel: impl Fn(Vec3, Vec3) -> (Vec3, f64)) -> [f64; 3] {
    let count = 4000;
    let mut sums = [0.0; 3];
    for k in 0..count {
        let phi = TAU * k as f64 / f64::from(count);
        // Components along the axis, from it, and across; r cos(phi) - r0 without cancellation.
        let w = 2.0 * (0.5 * phi).sin().powi(2);
        let x = [d.x, d.y - source * w, source * phi.sin()];
        let ([u, v, _], p) = kernel(x, [1.0, 1.0 - w, phi.sin()]);
        let weight = TAU / f64::from(count);
        sums = [sums[0] + weight * u, sums[1] + weight * v, sums[2] + weight * p];
    }
    assert!(target + d.y > 0.0);
    sums
}

fn close(found: f64, exact: f64, scale: f64, tolerance: f64, what: &str) {
    let error = (found - exact).abs() / scale;
    assert!(error < tolerance, "{what}: {found} for {exact}, error {error:e}");
}

/// Places: source less target, distance of the target and of the source from the axis. The least distance of a ring
/// from its target is 0.02 of the radius, so that 4000 points sum to round-off.
fn places() -> Vec<(Vec2, f64, f64)> {
    [
        (Vec2::new(0.3, 0.4), 0.5),
        (Vec2::new(1.3, -0.2), 0.9),
        (Vec2::new(-0.02, 0.01), 1.0),
        (Vec2::new(0.7, 0.5), 1e-3),
        (Vec2::new(0.5, 1e-6 - 0.8), 0.8),
        (Vec2::new(0.6, 0.3), 0.0),
        (Vec2::new(0.1, -0.005), 0.06),
        (Vec2::new(-1.0, 0.6), 0.35),
        (Vec2::new(4.0, 1.0), 2.0),
    ]
    .into_iter()
    .map(|(d, target)| (d, target, target + d.y))
    .collect()
}

#[test]
fn velocities_and_pressures_are_those_of_sums_over_the_azimuth() {
    let (force, normal, density) = (Vec2::new(0.7, -0.4), Vec2::new(0.6, 0.8), Vec2::new(-0.3, 0.9));
    let turned = |a: Vec2, e: Vec3| [a.x, a.y * e[1], a.y * e[2]];
    for (d, target, source) in places() {
        let ring = Ring::new(d, target, source, Wanted::Gradients);
        let single = summed_over_angles(d, target, source, |x, e| {
            let (f, square) = (turned(force, e), dot3(x, x));
            let (rho, pull) = (square.sqrt(), dot3(x, f));
            (std::array::from_fn(|i| f[i] / rho + x[i] * pull / (square * rho)), -2.0 * pull / (square * rho))
        });
        let double = summed_over_angles(d, target, source, |x, e| {
            let (q, n, square) = (turned(density, e), turned(normal, e), dot3(x, x));
            let fifth = square * square * square.sqrt();
            let both = dot3(x, q) * dot3(x, n);
            (x.map(|x| -6.0 * both * x / fifth), 12.0 * both / fifth - 4.0 * dot3(q, n) / (square * square.sqrt()))
        });
        for (name, (velocity, pressure, _), exact) in
            [("single", ring.single_flow(force), single), ("double", ring.double_flow(normal, density), double)]
        {
            let what = format!("{name} layer at {d:?} from {target}");
            let scale = exact[0].hypot(exact[1]);
            close(velocity[0], exact[0], scale, 1e-13, &what);
            close(velocity[1], exact[1], scale, 1e-13, &what);
            // A pressure that cancels is compared with the sum of its parts.
            close(pressure, exact[2], exact[2].abs().max(scale / d.length()), 1e-13, &what);
        }
    }
}

#[test]
fn gradients_are_the_derivatives_of_the_velocities() {
    let (force, normal, density) = (Vec2::new(0.7, -0.4), Vec2::new(0.6, 0.8), Vec2::new(-0.3, 0.9));
    for (d, target, source) in places().into_iter().filter(|(_, target, _)| *target > 0.01) {
        let flow = |x: f64, r: f64, double: bool| {
            let ring = Ring::new(d - Vec2::new(x, r), target + r, source, Wanted::Gradients);
            if double { ring.double_flow(normal, density) } else { ring.single_flow(force) }
        };
        for double in [false, true] {
            let (_, _, gradient) = flow(0.0, 0.0, double);
            let scale = gradient.as_flattened().iter().fold(0.0, |a: f64, b| a.max(b.abs()));
            let h = 2e-3 * d.length().min(target);
            for (j, row) in gradient.into_iter().enumerate() {
                for (step, found) in [Vec2::new(h, 0.0), Vec2::new(0.0, h)].into_iter().zip(row) {
                    let at = |s: f64| flow(s * step.x, s * step.y, double).0[j];
                    let slope = (45.0 * (at(1.0) - at(-1.0)) - 9.0 * (at(2.0) - at(-2.0)) + at(3.0) - at(-3.0)) / 60.0;
                    close(found, slope / h, scale, 1e-10, &format!("{j} along {step:?} at {d:?}, {double}"));
                }
            }
        }
    }
}

/// Both branches at the bound between them.
#[test]
fn sums_and_elliptic_integrals_agree_where_they_meet() {
    for share in [0.5 * NEAR_AXIS, 0.999 * NEAR_AXIS, 1.001 * NEAR_AXIS] {
        let (distance, product) = (1.0 - share, share);
        let (a, b) = (summed::<4, 5>(distance, product), elliptic_moments(distance, product, Wanted::Gradients));
        let tolerance = if share < 0.9 * NEAR_AXIS { 3e-12 } else { 2e-13 };
        for (a, b) in a[..3].as_flattened().iter().zip(b.as_flattened()).filter(|(_, b)| **b != 0.0) {
            assert!((a / b - 1.0).abs() < tolerance, "{a} {b} at {share}");
        }
    }
}

/// Values of K and E at the modulus 1/2 (parameter 1/4) and next to the logarithm, `K = ln(4/k') + ...`.
#[test]
fn elliptic_integrals_have_their_known_values() {
    let (k, difference) = elliptic(0.75);
    assert!((k - 1.685_750_354_812_596).abs() < 1e-15);
    assert!((k - difference - 1.467_462_209_339_427_2).abs() < 2e-15);
    let complement: f64 = 1e-14;
    let (k, difference) = elliptic(complement);
    let log = (4.0 / complement.sqrt()).ln();
    assert!((k / (log + 0.25 * complement * (log - 1.0)) - 1.0).abs() < 1e-15);
    assert!((k - difference - 1.0).abs() < 1e-14 * k);
}
