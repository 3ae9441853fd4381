use super::*;
use crate::{
    BSpline,
    kernel::{Gaussian6, Peskin4},
};
use motile_base::Vec2;

/// The tangential deficit `G_t(0)` of forces that do not vary along a flat interface with this unit `tangent` (no
/// dimension): half of how much the grid rounds off the kink in the velocity, in units of h/eta times the force per
/// length.
fn flat(table: &MobilityDeficit, tangent: Vec2) -> f64 {
    let rest = table.at(0.0);
    let z = tangent.x.powi(4) + tangent.y.powi(4) - 0.75;
    (rest.tangential + rest.tangential_slope * z + rest.tangential_curvature * (32.0 * z * z - 1.0)).max(0.0)
}

#[test]
fn cubic_quadratic_table() {
    // (q, A_t, B_t, A_n, B_n) of the flat-interface analysis, independently computed to four digits.
    let expected = [
        (0.05, 0.2539, -0.0839, 0.0051, 0.0001),
        (0.1, 0.2488, -0.0698, 0.0101, 0.0004),
        (0.5, 0.2115, -0.0032, 0.0434, 0.0045),
        (1.0, 0.1723, 0.0165, 0.0704, 0.0057),
        (2.0, 0.1162, 0.0065, 0.0867, -0.0021),
        (4.0, 0.0625, 0.0, 0.0618, -0.0009),
        (6.0, 0.0417, 0.0, 0.0417, 0.0),
    ];
    let table = MobilityDeficit::new(&BSpline::<4>);
    for (q, at, bt, an, bn) in expected {
        let d = table.at(q);
        assert!((d.tangential - at).abs() < 3e-4, "q {q}: {d:?}");
        assert!((d.normal - an).abs() < 3e-4, "q {q}: {d:?}");
        assert!((d.tangential_slope - bt).abs() < 5e-4, "q {q}: {d:?}");
        assert!((d.normal_slope - bn).abs() < 2e-4, "q {q}: {d:?}");
    }
}

#[test]
fn coupling_of_tangent_and_normal() {
    // Trapezoidal rule with 8e4 points in sinh^-1(k) at an angle of pi/8 (a script).
    let table = MobilityDeficit::new(&BSpline::<4>);
    for (q, expected) in [(0.05, -9.36e-4), (0.1, -1.679e-3), (0.5, -3.079e-3), (1.0, -7.03e-4), (2.0, 1.497e-3)] {
        let cross = table.at(q).cross;
        assert!((cross - expected).abs() < 2e-5, "q {q}: {cross}");
    }
}

/// The coefficients in cos(4 angle) and cos(8 angle) stand for the deficits in every direction.
#[test]
fn every_direction() {
    let table = MobilityDeficit::new(&BSpline::<4>);
    let transforms = Transforms::new(&BSpline::<4>);
    for q in [0.1, 0.5, 1.0] {
        let deficit = table.at(q);
        for angle in [0.0, 0.1, 0.2, 0.3, std::f64::consts::FRAC_PI_8, 0.6, std::f64::consts::FRAC_PI_4] {
            let [tangential, normal, cross] = deficits(&transforms, q, angle);
            let z = 0.25 * (4.0 * angle).cos();
            let along = deficit.tangential + deficit.tangential_slope * z;
            let along = along + deficit.tangential_curvature * (32.0 * z * z - 1.0);
            // What is left of the series is a part of its last term.
            let rest = 0.3 * deficit.tangential_curvature.abs() + 1e-5;
            assert!((along - tangential).abs() < rest, "q {q}, {angle}: {along} {tangential} {deficit:?}");
            assert!((deficit.normal + deficit.normal_slope * z - normal).abs() < 1e-4, "q {q}, {angle}: {normal}");
            assert!((deficit.cross * (4.0 * angle).sin() - cross).abs() < 5e-4, "q {q}, {angle}: {cross}");
        }
    }
}

#[test]
fn zero_wave_number_is_the_kink_constant() {
    // Direct quadrature of the same integral at q = 0 (a script with 1.2e5 trapezoidal points), 0 and 45 degrees.
    for (table, along, across) in
        [(MobilityDeficit::new(&BSpline::<4>), 0.2333, 0.2833), (MobilityDeficit::new(&Peskin4), 0.381, 0.395)]
    {
        let d = table.at(0.0);
        assert!((d.tangential + 0.25 * d.tangential_slope - along).abs() < 3e-3, "{d:?}");
        assert!((d.tangential - 0.25 * d.tangential_slope - across).abs() < 3e-3, "{d:?}");
    }
}

#[test]
fn stiffness_of_the_kernels() {
    let of = |deficit: MobilityDeficit| deficit.interface_stiffness(false);
    assert!((of(MobilityDeficit::new(&Peskin4)) - 0.125).abs() < 0.01);
    assert!((of(MobilityDeficit::new(&BSpline::<4>)) - 0.188).abs() < 0.01);
    assert!(of(MobilityDeficit::new(&Gaussian6)) < 0.12);
}

/// A kernel that spreads nothing loses all of the mobility 1/(4 q), tangential and normal, and couples neither.
#[test]
fn a_kernel_that_spreads_nothing_loses_everything() {
    let nothing = Transforms { normal: Vec::new(), tangential: Vec::new() };
    for q in [0.05, 0.5, 2.0, 6.0] {
        for angle in [0.0, 0.3] {
            let [tangential, normal, cross] = deficits(&nothing, q, angle);
            assert!((4.0 * q * tangential - 1.0).abs() < 1e-9, "q {q}: {tangential}");
            assert!((4.0 * q * normal - 1.0).abs() < 1e-9, "q {q}: {normal}");
            assert_eq!(cross, 0.0);
        }
    }
}

#[test]
fn the_normal_correction_fades_at_the_spacing_of_the_grid() {
    for (q, expected) in [(0.0, 1.0), (1.0, 0.939_413_062_813_475_8), (2.0, (-1.0_f64).exp()), (4.0, (-16.0_f64).exp())]
    {
        assert!((normal_taper(q) / expected - 1.0).abs() < 1e-14, "{q}");
    }
}

/// Forces that hardly vary along a flat interface of any direction.
#[test]
fn flat_interfaces_in_every_direction() {
    let (table, transforms) = (MobilityDeficit::new(&BSpline::<4>), Transforms::new(&BSpline::<4>));
    let rest = 0.3 * table.at(0.0).tangential_curvature.abs() + 1e-5;
    for angle in [0.0, 0.2, std::f64::consts::FRAC_PI_8, 0.6, std::f64::consts::FRAC_PI_4] {
        let [tangential, ..] = deficits(&transforms, 1e-6, angle);
        let flat = flat(&table, Vec2::from_angle(angle));
        assert!((flat - tangential).abs() < rest, "{angle}: {flat} {tangential} {rest}");
    }
}

/// The harmonic is even in q, also between the first two entries of its table.
#[test]
fn the_harmonic_of_long_waves() {
    let (table, transforms) = (MobilityDeficit::new(&BSpline::<4>), Transforms::new(&BSpline::<4>));
    let drop = table.harmonic(0.0) - table.harmonic(0.125);
    for q in [0.03, 0.05, 0.08] {
        let (found, exact) = (table.harmonic(q), harmonic(&transforms, 1.0, q));
        assert!((found - exact).abs() < 0.02 * drop.abs(), "q {q}: {found} {exact} {drop}");
    }
}
