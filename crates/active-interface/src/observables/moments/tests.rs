use super::*;
use crate::{
    Curve,
    curve::polygon_moments,
    theory::{LinearTheory, RoundDroplet},
};
use proptest::prelude::*;

/// Forces on the fluid: differences of the tension times the direction of the segments.
fn forces(markers: &[Vec2], tension: impl Fn(Vec2) -> f64) -> Vec<Vec2> {
    let m = markers.len();
    let pull = |k: usize| {
        let (a, b) = (markers[k], markers[(k + 1) % m]);
        (b - a).normalize() * tension((a + b) * 0.5)
    };
    (0..m).map(|k| pull(k) - pull((k + m - 1) % m)).collect()
}

fn x_frame() -> Frame {
    Frame::new(Vec2::ZERO, 0.0).unwrap()
}

/// The entries of the reference tables: F2xx, F2yy, Sxx, F3xxx, F3xyy, F3yxy, F3yyx, Nxyy, Nyxy, Nyyx.
fn entries(moments: &ForceMoments) -> [f64; 10] {
    let (f, n) = (moments.quadrupole.unwrap(), moments.mixed_quadrupole().unwrap());
    [
        moments.dipole[0][0],
        moments.dipole[1][1],
        moments.stresslet()[0][0],
        f[0][0][0],
        f[0][1][1],
        f[1][0][1],
        f[1][1][0],
        n[0][1][1],
        n[1][0][1],
        n[1][1][0],
    ]
}

fn check(found: impl Fn(usize) -> ForceMoments, wanted: [f64; 10]) {
    let errors = [125, 250, 500].map(|count| {
        let entries = entries(&found(count));
        entries.iter().zip(wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    });
    for pair in errors.windows(2) {
        assert!((pair[0] / pair[1]).log2() > 1.95, "{errors:?}");
    }
    // 250 markers are ds = 0.025 R0, as at h = 0.05.
    assert!(errors[1] < 1e-3, "{errors:?}");
}

#[test]
fn moments_of_the_reference_ellipse() {
    // reference/fixed_shape_moments_equal_viscosity.csv, ellipse, const1 and 1+0.5cos
    let uniform = [-4.544_251_551_338_3, -2.063_804_009_332_2, -1.240_223_771_003, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let varying = [
        -4.544_251_551_338_3,
        -2.063_804_009_332_2,
        -1.240_223_771_003,
        -1.653_956_879_503_7,
        0.579_096_277_967_76,
        -0.762_376_326_098_12,
        -0.762_376_326_098_12,
        0.894_315_070_710_63,
        -0.447_157_535_355_32,
        -0.447_157_535_355_32,
    ];
    for (amplitude, wanted) in [(0.0, uniform), (0.5, varying)] {
        let moments = |count| {
            let markers = Curve::ellipse(1.3, 1.0 / 1.3).unwrap().markers(count).unwrap();
            let tension = |p: Vec2| 1.0 + amplitude * (p.y * 1.3).atan2(p.x / 1.3).cos();
            let forces = forces(&markers, tension);
            let rest = vec![Vec2::ZERO; count];
            force_moments(&markers, &forces, &rest, [1.0, 1.0], Convention::FarField, &x_frame()).unwrap()
        };
        check(moments, wanted);
        let total = moments(250).force;
        assert!(total[0].abs() < 1e-14 && total[1].abs() < 1e-14);
    }
}

#[test]
fn both_conventions_on_the_reference_circle() {
    // reference/fixed_shape_moments_ratio_10.csv, circle, 1+0.5cos, L = inf; the velocities are those of the exact
    // flow.
    use std::f64::consts::{FRAC_PI_4, PI};
    let printed = [
        -PI,
        -PI,
        0.0,
        -1.106_697_412_060_0,
        FRAC_PI_4,
        -FRAC_PI_4,
        -1.106_697_412_060_0,
        1.154_297_300_750_8,
        -0.416_499_026_044_1,
        -0.737_798_274_706_69,
    ];
    let far_field = [
        -PI,
        -PI,
        0.0,
        -0.464_098_914_734_86,
        FRAC_PI_4,
        -FRAC_PI_4,
        -0.464_098_914_734_86,
        0.940_097_801_642_4,
        -0.630_698_525_152_5,
        -0.309_399_276_489_9,
    ];
    let theory = LinearTheory::new(RoundDroplet {
        radius: 1.0,
        viscosity_inside: 10.0,
        viscosity_outside: 1.0,
        tension: 1.0,
        activity: -1.0,
        concentration: 1.0,
        diffusivity: 0.0,
    })
    .unwrap();
    let flow = theory.mode_flow(1, 0.5, 0.0).unwrap();
    let speed = theory.swimming_speed(0.5).unwrap();
    for (convention, wanted) in [(Convention::AsPrinted, printed), (Convention::FarField, far_field)] {
        let moments = |count| {
            let markers = Curve::circle(1.0).unwrap().markers(count).unwrap();
            let forces = forces(&markers, |p| 1.0 + 0.5 * p.x / p.length());
            let velocities: Vec<Vec2> = markers
                .iter()
                .map(|p| {
                    let (sin, cos) = p.y.atan2(p.x).sin_cos();
                    let [radial, azimuthal] = flow.velocity(1.0, p.y.atan2(p.x));
                    // In the frame of the fluid far away, where the droplet swims along -x.
                    Vec2::new(radial * cos - azimuthal * sin - speed, radial * sin + azimuthal * cos)
                })
                .collect();
            force_moments(&markers, &forces, &velocities, [10.0, 1.0], convention, &x_frame()).unwrap()
        };
        check(moments, wanted);
    }
}

/// The corrected (2.60): a circle of any tension moves at 3 [abs(N_xyy) + (N_yxy - N_yyx)/3]/(8 pi R^2 Sigma).
#[test]
fn speed_of_a_circle_is_its_corrected_source_dipole() {
    use std::f64::consts::PI;
    let (radius, amplitudes) = (1.3, [0.5, 0.4, -0.3]);
    for viscosity in [0.1, 1.0, 10.0, 100.0] {
        let droplet = RoundDroplet {
            radius,
            viscosity_inside: viscosity,
            viscosity_outside: 1.0,
            tension: 1.0,
            activity: -1.0,
            concentration: 1.0,
            diffusivity: 0.0,
        };
        let theory = LinearTheory::new(droplet).unwrap();
        let flows: Vec<_> = (1..4).zip(amplitudes).map(|(k, c)| theory.mode_flow(k, c, 0.0).unwrap()).collect();
        let speed = theory.swimming_speed(amplitudes[0]).unwrap();
        let along = Frame::new(Vec2::ZERO, PI).unwrap();
        for convention in [Convention::AsPrinted, Convention::FarField] {
            let sums = |count: usize, share: f64| {
                let markers: Vec<Vec2> = Curve::circle(radius).unwrap().markers(count).unwrap();
                let tension = |p: Vec2| {
                    let angle = p.y.atan2(p.x);
                    1.0 + (1..4).zip(amplitudes).map(|(k, c)| c * (f64::from(k) * angle).cos()).sum::<f64>()
                };
                let velocity = |p: &Vec2| {
                    let angle = p.y.atan2(p.x);
                    let [radial, azimuthal] = flows.iter().fold([0.0; 2], |[a, b], flow| {
                        let [radial, azimuthal] = flow.velocity(radius, angle);
                        [a + radial, b + azimuthal]
                    });
                    let (sin, cos) = angle.sin_cos();
                    // It swims along -x.
                    Vec2::new(radial * cos - azimuthal * sin - speed, radial * sin + azimuthal * cos)
                };
                let (forces, velocities) =
                    (forces(&markers, tension), markers.iter().map(velocity).collect::<Vec<_>>());
                let moments =
                    force_moments(&markers, &forces, &velocities, [viscosity, 1.0], convention, &along).unwrap();
                let n = moments.mixed_quadrupole().unwrap();
                (n[0][1][1].abs() + share * (n[1][0][1] - n[1][1][0])) * 3.0
                    / (8.0 * PI * radius * radius * (viscosity + 1.0) * speed)
            };
            // A polygon with the angles of the circle has no error in it.
            let found = sums(200, 1.0 / 3.0);
            assert!((found - 1.0).abs() < 1e-13, "{viscosity}: {found}");
            // Cowley's share of -1/4 and none at all leave the contrast.
            let contrast = match convention {
                Convention::FarField => (1.0 - viscosity) / (1.0 + viscosity),
                Convention::AsPrinted => (viscosity - 1.0) / (1.0 + viscosity),
            };
            for (share, left) in [(-0.25, 7.0 / 32.0), (0.0, 1.0 / 8.0)] {
                let found = sums(200, share);
                assert!((found - 1.0 - left * contrast).abs() < 1e-3, "{viscosity}, {share}: {found}");
            }
        }
    }
}

#[test]
fn bad_input_is_refused() {
    let list = [Vec2::ZERO; 5];
    let call = |n: usize, viscosity: f64| {
        force_moments(&list, &list[..n], &list, [viscosity, 1.0], Convention::FarField, &x_frame())
    };
    assert!(call(5, 1.0).is_ok());
    assert!(call(4, 1.0).is_err());
    assert!(call(5, f64::NAN).is_err());
}

proptest! {
    #[test]
    fn moments_turn_with_the_droplet(angle in -3.0..3.0f64, x in -4.0..4.0f64) {
        let moments = |angle: f64, x: f64| {
            let at = Vec2::new(x, 1.0);
            let curve = Curve::fourier(1.0, &[0.0, 0.1, 0.05], &[0.0, 0.05]).unwrap().rotated(angle).translated(at);
            let markers = curve.markers(60).unwrap();
            let frame = Frame::new(polygon_moments(&markers).unwrap().centroid, angle).unwrap();
            let forces = forces(&markers, |p| 2.0 + frame.coordinates(p).x);
            let turn = Vec2::from_angle(angle);
            let velocity = |p: &Vec2| turn.rotate(Vec2::new(frame.coordinates(*p).y, 0.3));
            let velocities: Vec<Vec2> = markers.iter().map(velocity).collect();
            force_moments(&markers, &forces, &velocities, [3.0, 1.0], Convention::FarField, &frame).unwrap()
        };
        let (a, b) = (moments(0.0, 0.0), moments(angle, x));
        for (a, b) in entries(&a).iter().zip(entries(&b)) {
            prop_assert!((a - b).abs() < 1e-10);
        }
        // The decomposition: S is symmetric, S + N = F, the symmetric part of N is zero.
        let (s, n) = (b.symmetric_quadrupole().unwrap(), b.mixed_quadrupole().unwrap());
        prop_assert!((s[0][1][1] - s[1][0][1]).abs() < 1e-12 && (s[0][0][1] - s[1][0][0]).abs() < 1e-12);
        prop_assert!((n[0][1][1] + n[1][0][1] + n[1][1][0]).abs() < 1e-12 && n[0][0][0].abs() < 1e-12);
        prop_assert!((s[0][1][1] + n[0][1][1] - b.quadrupole.unwrap()[0][1][1]).abs() < 1e-12);
    }
}

/// In axes at an angle to those of a stretched droplet the stresslet is that tensor in these axes: `s cos 2a` on the
/// diagonal, `s sin 2a` off it.
#[test]
fn stresslets_turn_with_the_axes() {
    let markers = Curve::ellipse(1.5, 0.7).unwrap().markers(200).unwrap();
    let forces = forces(&markers, |_| 2.0);
    let rest = vec![Vec2::ZERO; 200];
    let seen = |angle: f64| {
        let frame = Frame::new(Vec2::ZERO, angle).unwrap();
        force_moments(&markers, &forces, &rest, [1.0; 2], Convention::FarField, &frame).unwrap().stresslet()
    };
    let own = seen(0.0)[0][0];
    assert!(own < -1.0 && seen(0.0)[0][1].abs() < 1e-12, "a tension pulls its ends together: {own}");
    for angle in [0.3, 1.0, -2.2] {
        let [[xx, xy], [yx, yy]] = seen(-angle);
        let expected = [own * (2.0 * angle).cos(), own * (2.0 * angle).sin()];
        assert!((xx - expected[0]).abs() + (xy - expected[1]).abs() < 1e-11, "{angle}: {xx} {xy} {expected:?}");
        assert!((yx - xy).abs() + (yy + xx).abs() < 1e-12);
    }
}

/// The dipole of a rigid body inside in axes that are turned: `D'_ij = a_i D a_j` with the axes a of the frame.
#[test]
fn dipoles_of_rigid_bodies_turn_with_the_axes() {
    let dipole = [[1.0, 0.4], [-0.3, 2.0]];
    let body = Enclosed {
        positions: Vec::new(),
        forces: Vec::new(),
        velocities: Vec::new(),
        viscosities: [1.0; 2],
        rigid_dipole: Some(dipole),
    };
    for heading in [0.0, 0.7, -2.0_f64] {
        let frame = Frame::new(Vec2::ZERO, heading).unwrap();
        let mut moments = ForceMoments { quadrupole: Some(Default::default()), ..ForceMoments::default() };
        moments.add_body(&body, Vec2::ZERO, Convention::FarField, &frame).unwrap();
        let (sin, cos) = heading.sin_cos();
        let axes = [[cos, sin], [-sin, cos]];
        for i in 0..2 {
            for j in 0..2 {
                let of = |k: usize, l: usize| axes[i][k] * dipole[k][l] * axes[j][l];
                let exact = of(0, 0) + of(0, 1) + of(1, 0) + of(1, 1);
                assert!((moments.dipole[i][j] - exact).abs() < 1e-14, "{heading}: {:?}", moments.dipole);
            }
        }
        assert_eq!(moments.quadrupole, None);
    }
}
