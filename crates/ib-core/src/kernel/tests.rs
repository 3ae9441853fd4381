use proptest::prelude::*;

use super::*;

/// Sum of `weight * f(point - r)` over the points of a stencil.
fn moment(kernel: AnyKernel, role: Role, r: f64, f: impl Fn(f64) -> f64) -> f64 {
    let mut weights = [0.0; MAX_SUPPORT];
    let first = kernel.weights(role, r, &mut weights);
    (0..kernel.support(role)).map(|i| weights[i] * f((first + i as i64) as f64 - r)).sum()
}

const ROLES: [Role; 2] = [Role::Normal, Role::Tangential];

/// The Gaussian's published coefficients come from conditions, so it meets all of them.
#[test]
fn gaussian_conditions() {
    let k = Gaussian6::second_moment();
    // As published: with any other one the third derivative jumps.
    assert!((k - 0.714_075_092_976_608).abs() < 1e-14);
    let mut squares = Vec::new();
    for i in 0..50 {
        let r = 0.02 * i as f64 - 0.3;
        let m = |f: fn(f64) -> f64| moment(AnyKernel::Gaussian6, Role::Normal, r, f);
        assert!((m(|x| x * x) - k).abs() < 1e-13);
        assert!(m(|x| x * x * x).abs() < 1e-12);
        let mut w = [0.0; MAX_SUPPORT];
        Gaussian6.weights(Role::Normal, r, &mut w);
        assert!((w[0] + w[2] + w[4] - 0.5).abs() < 1e-14, "even-odd condition");
        squares.push(w.iter().map(|w| w * w).sum::<f64>());
    }
    for s in &squares {
        assert!((s - squares[0]).abs() < 1e-13, "the sum of squares does not depend on the position");
    }
}

#[test]
fn peskin_and_roma_conditions() {
    for i in 0..50 {
        let r = 0.02 * i as f64 - 0.3;
        let mut w = [0.0; MAX_SUPPORT];
        Peskin4.weights(Role::Normal, r, &mut w);
        assert!((w[0] + w[2] - 0.5).abs() < 1e-14);
        assert!((w.iter().map(|w| w * w).sum::<f64>() - 3.0 / 8.0).abs() < 1e-14);
        let mut w = [0.0; MAX_SUPPORT];
        Roma3.weights(Role::Normal, r, &mut w);
        assert!((w.iter().map(|w| w * w).sum::<f64>() - 0.5).abs() < 1e-14);
    }
    // Cowley (2.36) at a few points
    for (r, value) in [(0.0, 0.5), (1.0, 0.25), (2.0, 0.0), (0.5, (2.0 + 2.0_f64.sqrt()) / 8.0)] {
        assert!((Peskin4.value(Role::Normal, r) - value).abs() < 1e-15);
    }
}

/// The cubic and the quadratic B-spline as textbooks write them.
#[test]
fn bspline_values() {
    let cubic = |r: f64| {
        let r = r.abs();
        if r < 1.0 {
            2.0 / 3.0 - r * r + 0.5 * r * r * r
        } else if r < 2.0 {
            (2.0 - r).powi(3) / 6.0
        } else {
            0.0
        }
    };
    let quadratic = |r: f64| {
        let r = r.abs();
        if r < 0.5 {
            0.75 - r * r
        } else if r < 1.5 {
            0.5 * (1.5 - r).powi(2)
        } else {
            0.0
        }
    };
    for i in -250..250 {
        let r = 0.0101 * f64::from(i);
        assert!((BSpline::<4>.value(Role::Normal, r) - cubic(r)).abs() < 1e-15);
        assert!((BSpline::<4>.value(Role::Tangential, r) - quadratic(r)).abs() < 1e-15);
    }
}

/// The derivative of one spline is a difference of the one below: what makes the composite kernel divergence free.
#[test]
fn composite_splines_match() {
    let kernel = BSpline::<4>;
    let step = 1e-5;
    for i in 0..40 {
        let r = 0.05 * f64::from(i) + 0.011;
        let slope = (kernel.value(Role::Normal, r + step) - kernel.value(Role::Normal, r - step)) / (2.0 * step);
        let difference = kernel.value(Role::Tangential, r + 0.5) - kernel.value(Role::Tangential, r - 0.5);
        assert!((slope - difference).abs() < 1e-9);
    }
}

#[test]
fn transforms_against_quadrature() {
    for kernel in AnyKernel::ALL {
        for role in ROLES {
            assert!((kernel.transform(role, 0.0) - 1.0).abs() < 1e-12, "{} integrates to one", kernel.name());
            for theta in [0.3, 2.0, 5.5, 20.0, 55.0] {
                let (n, reach) = (60_000, 3.0);
                let sum: f64 = (0..n)
                    .map(|i| -reach + 2.0 * reach * (i as f64 + 0.5) / f64::from(n))
                    .map(|r| kernel.value(role, r) * (theta * r).cos())
                    .sum::<f64>()
                    * 2.0
                    * reach
                    / f64::from(n);
                assert!((kernel.transform(role, theta) - sum).abs() < 1e-8, "{} at {theta}", kernel.name());
            }
        }
    }
}

#[test]
fn names_parse_back() {
    for kernel in AnyKernel::ALL {
        assert_eq!(kernel.name().parse::<AnyKernel>().unwrap(), kernel);
    }
    assert!("hat".parse::<AnyKernel>().is_err());
}

proptest! {
    #[test]
    fn sums_first_moments_and_values(r in -40.0..40.0_f64) {
        for kernel in AnyKernel::ALL {
            for role in ROLES {
                prop_assert!((moment(kernel, role, r, |_| 1.0) - 1.0).abs() < 1e-13);
                prop_assert!(moment(kernel, role, r, |x| x).abs() < 1e-13);
                let mut weights = [0.0; MAX_SUPPORT];
                let first = kernel.weights(role, r, &mut weights);
                for (i, weight) in weights.iter().take(kernel.support(role)).enumerate() {
                    let value = kernel.value(role, (first + i as i64) as f64 - r);
                    prop_assert!((weight - value).abs() < 1e-12, "{}: {weight} {value}", kernel.name());
                }
            }
        }
    }
}

/// A kernel gives as much to points on either side.
#[test]
fn values_are_even() {
    for role in [Role::Normal, Role::Tangential] {
        for r in [0.2, 0.7, 1.3, 1.9] {
            assert_eq!(BSpline::<4>.value(role, -r), BSpline::<4>.value(role, r), "{r}");
            assert_eq!(Peskin4.value(role, -r), Peskin4.value(role, r), "{r}");
        }
    }
}
