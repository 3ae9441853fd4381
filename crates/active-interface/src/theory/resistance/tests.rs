use approx::assert_relative_eq;

use crate::theory::{FlatInterface, LinearTheory, RoundDroplet, Sphere, Stratum, StratumEnd};

const UNIT: RoundDroplet = RoundDroplet {
    radius: 1.0,
    viscosity_inside: 100.0,
    viscosity_outside: 100.0,
    tension: 10.0,
    activity: -2.0,
    concentration: 100.0,
    diffusivity: 0.1,
};
const OTHER: RoundDroplet = RoundDroplet { radius: 1.3, viscosity_inside: 70.0, viscosity_outside: 130.0, ..UNIT };

fn circle(droplet: RoundDroplet, cortex: f64, friction: f64) -> LinearTheory {
    LinearTheory::new(droplet).unwrap().with_cortex(cortex).unwrap().with_friction(friction).unwrap()
}

#[test]
fn a_cortex_slows_concentrations_but_no_shapes() {
    // Closed forms, whose responses agree with an independent boundary-integral program: speed for a difference of
    // tensions of 1, threshold, growth of the concentration in modes 1 to 3, of the shape in mode 2, emulsion.
    for (droplet, cortex, expected) in [
        (UNIT, 50.0, [0.00111111111111, -0.45, 0.344444444444, 0.4, 0.190909090909, -0.05, 1.6]),
        (
            OTHER,
            150.0,
            [
                0.000970149253731,
                -0.396449704142,
                0.239335865053,
                0.251118487516,
                0.0860123223327,
                -0.0384615384615,
                1.58780487805,
            ],
        ),
        (UNIT, 1e6, [4.99800079968e-07, -1000.4, -0.099800079968, -0.399800039992, -0.899800026663, -0.05, 1.99990002]),
    ] {
        let theory = circle(droplet, cortex, 0.0);
        let found = [
            theory.swimming_speed(0.5).unwrap(),
            theory.activity_threshold(),
            theory.concentration_growth_rate(1),
            theory.concentration_growth_rate(2),
            theory.concentration_growth_rate(3),
            theory.shape_growth_rate(2),
            theory.emulsion_coefficient(),
        ];
        for (found, expected) in found.into_iter().zip(expected) {
            assert_relative_eq!(found, expected, max_relative = 1e-11);
        }
        for k in 1..5 {
            let [[aa, _], [ba, bb]] = theory.growth_matrix(k).unwrap();
            assert_relative_eq!(aa, theory.shape_growth_rate(k), max_relative = 1e-12);
            assert_relative_eq!(bb, theory.concentration_growth_rate(k), max_relative = 1e-12);
            assert!(ba.abs() < 1e-9);
        }
    }
}

#[test]
fn friction_couples_concentration_and_shape() {
    for (droplet, friction, [speed, threshold], growth, matrices) in [
        (
            RoundDroplet { tension: 210.0, ..UNIT },
            20.0,
            [0.00121951219512, -0.41],
            0.387804878049,
            [
                [0.575800156128, 2.45901639344, -7.80640124902e-05, -1.00819672131],
                [0.575459199036, 2.52935862692, -3.01114122252e-05, -1.54290876242],
            ],
        ),
        (
            RoundDroplet { tension: 210.0, ..OTHER },
            90.0,
            [0.00109051254089, -0.352692307692],
            0.276370722642,
            [
                [0.43777122184, 6.40565270042, -0.000343668351229, -0.652664836254],
                [0.519811704401, 7.38701205964, -0.00014861964739, -1.08096609806],
            ],
        ),
    ] {
        let theory = circle(droplet, 0.0, friction);
        assert_relative_eq!(theory.swimming_speed(0.5).unwrap(), speed, max_relative = 1e-11);
        assert_relative_eq!(theory.activity_threshold(), threshold, max_relative = 1e-11);
        assert_relative_eq!(theory.concentration_growth_rate(1), growth, max_relative = 1e-11);
        for (k, [cc, cs, sc, ss]) in (2..).zip(matrices) {
            let [[aa, ab], [ba, bb]] = theory.growth_matrix(k).unwrap();
            for (found, expected) in [(bb, cc), (ba, cs), (ab, sc), (aa, ss)] {
                assert_relative_eq!(found, expected, max_relative = 1e-11);
            }
        }
    }
}

#[test]
fn flows_of_modes_have_the_velocities_of_the_matrix() {
    // The radial velocity on the circle is da/dt, and no resistance gives the flow without it.
    let plain = LinearTheory::new(OTHER).unwrap();
    let faint = circle(OTHER, 1e-9, 1e-9);
    let theory = circle(OTHER, 70.0, 30.0);
    for k in 1..5 {
        let (flow, limit) = (theory.mode_flow(k, 0.3, 0.02).unwrap(), faint.mode_flow(k, 0.3, 0.02).unwrap());
        let expected = plain.mode_flow(k, 0.3, 0.02).unwrap().coefficients();
        for (found, expected) in limit.coefficients().into_iter().zip(expected) {
            assert_relative_eq!(found, expected, max_relative = 1e-8);
        }
        let [inside, outside] = [1.0, 1.0 + 1e-14].map(|part| flow.velocity(part * 1.3, 0.4));
        assert_relative_eq!(inside[0], outside[0], epsilon = 1e-13);
        assert_relative_eq!(inside[1], outside[1], epsilon = 1e-13);
        if k > 1 {
            let [[aa, ab], _] = theory.growth_matrix(k).unwrap();
            let rate = (aa * 0.02 + ab * 0.3) * (f64::from(k) * 0.4).cos();
            assert_relative_eq!(inside[0], rate, max_relative = 1e-11);
        }
    }
}

#[test]
fn an_uneven_cortex_slows_a_droplet_less() {
    let theory = |cortex| circle(UNIT, cortex, 0.0);
    for (mean, uneven, speed) in [(150.0, 100.0, 0.000921378535857), (200.0, 200.0, 0.000873087001979)] {
        assert_relative_eq!(theory(mean).uneven_cortex_speed(1.0, uneven).unwrap(), speed, max_relative = 1e-11);
    }
    assert_relative_eq!(theory(50.0).uneven_cortex_speed(1.0, 0.0).unwrap(), 1.0 / 900.0, max_relative = 1e-14);
    assert!(theory(50.0).uneven_cortex_speed(1.0, 51.0).is_err());
}

#[test]
fn a_sphere_with_a_cortex_has_the_growth_rates_of_lamb() {
    // Lamb's solution with a cortex by its dissipation, an independent computation by computer algebra: speed,
    // threshold, buoyant velocity, ratio of viscosities in an emulsion, matrices of l = 2 and l = 3.
    let droplet = RoundDroplet { activity: -1.0, tension: 110.0, ..UNIT };
    for (inside, dilatational, shear, expected, matrices) in [
        (
            100.0,
            50.0,
            0.0,
            [0.00111111111111, -0.6, 0.00259259259259, 1.6],
            [
                [-0.121739130435, 19.1304347826, -0.000434782608696, -0.497391304348],
                [-0.590728476821, 29.1390728477, -0.000264900662252, -0.832544938505],
            ],
        ),
        (
            100.0,
            100.0,
            30.0,
            [0.000952380952381, -0.7, 0.00253968253968, 2.44],
            [
                [-0.231546518792, 20.0616142945, -0.000455945779421, -0.4662969809],
                [-0.771782178218, 35.396039604, -0.000321782178218, -0.789603960396],
            ],
        ),
        (
            20.0,
            0.0,
            50.0,
            [0.0025641025641, -0.26, 0.00307692307692, 0.6],
            [
                [0.32416079569, 74.7617074182, -0.00169912971405, -0.729382511397],
                [-0.149851476498, 147.999301066, -0.00134544819151, -1.28778612616],
            ],
        ),
    ] {
        let droplet = RoundDroplet { viscosity_inside: inside, ..droplet };
        let sphere = Sphere::new(droplet).unwrap();
        let theory = sphere.with_cortex(dilatational).unwrap().with_shear_viscosity(shear).unwrap();
        let ratio = expected[3];
        let found = [
            theory.swimming_speed(1.0).unwrap(),
            theory.activity_threshold(),
            theory.settling_speed(4.0 / 3.0 * std::f64::consts::PI).unwrap(),
            theory.emulsion_coefficient(),
        ];
        let expected = [expected[0], expected[1], expected[2], (1.0 + 2.5 * ratio) / (1.0 + ratio)];
        for (found, expected) in found.into_iter().zip(expected) {
            assert_relative_eq!(found, expected, max_relative = 1e-11);
        }
        for (l, [cc, cs, sc, ss]) in (2..).zip(matrices) {
            let [[aa, ab], [ba, bb]] = theory.growth_matrix(l).unwrap();
            for (found, expected) in [(bb, cc), (ba, cs), (ab, sc), (aa, ss)] {
                assert_relative_eq!(found, expected, max_relative = 1e-11);
            }
        }
        // A faint cortex is none.
        let faint = sphere.with_shear_viscosity(1e-9).unwrap();
        for l in 1..5 {
            let [found, expected] = [faint, sphere].map(|theory| theory.growth_matrix(l).unwrap());
            for (found, expected) in found.as_flattened().iter().zip(expected.as_flattened()) {
                assert_relative_eq!(*found, *expected, max_relative = 1e-9, epsilon = 1e-12);
            }
        }
    }
}

#[test]
fn a_flat_interface_with_a_cortex_is_the_limit_of_short_waves_on_a_circle() {
    let wave =
        FlatInterface { wave_number: 3.0, tension: 10.0, activity: -2.0, concentration: 100.0, diffusivity: 0.1 };
    let fluid = |viscosity| Stratum { viscosity, end: StratumEnd::None };
    let [[growth, _], [_, relaxation]] = wave.resisted_growth_matrix(fluid(70.0), fluid(130.0), [50.0, 0.0]).unwrap();
    // A line of many waves around a circle.
    let k = 30_000;
    let theory = circle(RoundDroplet { radius: 1e4, ..OTHER }, 50.0, 0.0);
    assert_relative_eq!(growth, theory.concentration_growth_rate(k), max_relative = 1e-8);
    assert_relative_eq!(relaxation, theory.shape_growth_rate(k), max_relative = 1e-8);
    assert!(wave.resisted_mobility(fluid(1.0), fluid(1.0), [-1.0, 0.0]).is_err());
}

#[test]
fn resistances_are_not_negative() {
    let theory = LinearTheory::new(UNIT).unwrap();
    assert!(theory.with_cortex(-1.0).is_err() && theory.with_friction(f64::NAN).is_err());
    let sphere = Sphere::new(UNIT).unwrap();
    assert!(sphere.with_cortex(f64::INFINITY).is_err() && sphere.with_shear_viscosity(-1.0).is_err());
}
