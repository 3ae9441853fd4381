use active_interface::{ConstantTension, Tension};

use super::*;

/// A right-handed frame in general position.
fn frame() -> [[f64; 3]; 3] {
    let (s, c) = 0.7_f64.sin_cos();
    let (sb, cb) = 1.1_f64.sin_cos();
    [[c * cb, s * cb, -sb], [-s, c, 0.0], [c * sb, s * sb, cb]]
}

/// gamma = gamma(c) with the concentration as the cosine of the spheroid's parameter.
#[derive(Debug)]
struct Exponential;

impl Tension for Exponential {
    fn value(&self, c: f64) -> f64 {
        c.exp()
    }
    fn slope(&self, c: f64) -> f64 {
        c.exp()
    }
}

/// A spheroid of semi-axes 1.3^(-1/2), 1.3 about an axis in general position, parametrised about another one.
fn spheroid(degree: usize, viscosities: [f64; 2], exponential: bool) -> SpaceDroplet {
    let axes = frame();
    let stretch = move |s: [f64; 3]| {
        let along = dot(s, axes[2]);
        let (long, short) = (1.3, 1.0 / 1.3_f64.sqrt());
        std::array::from_fn(|i| short * s[i] + (long - short) * along * axes[2][i])
    };
    if exponential {
        let droplet = SpaceDroplet::shaped(degree, stretch, viscosities, Exponential).unwrap();
        droplet.with_particles(0.0, |s| dot(s, axes[2])).unwrap()
    } else {
        let law = ConstantTension::new(1.0).unwrap();
        SpaceDroplet::shaped(degree, stretch, viscosities, law).unwrap()
    }
}

/// Velocity at the pole, speed and stresslet of an independent axisymmetric boundary-integral program, with the error
/// of the velocity falling by more than 4 per two degrees.
#[test]
fn fixed_spheroids_in_general_position_are_those_of_an_axisymmetric_program() {
    let cases = [
        ([1.0, 1.0], true, [-0.321567228398753, -0.115460112151719, -1.38583189435886]),
        ([10.0, 1.0], false, [-0.0265585341922645, 0.0, -0.394886939171099]),
        ([10.0, 1.0], true, [-0.0572245192154756, -0.0144018528406857, -0.34143091410436]),
        ([1.0, 10.0], true, [-0.0699521158309059, -0.0378165902111936, -1.99655774985126]),
    ];
    let z = frame()[2];
    for (viscosities, exponential, [pole, speed, stresslet]) in cases {
        let mut errors = Vec::new();
        for degree in [8, 12, 16] {
            let mut droplet = spheroid(degree, viscosities, exponential);
            let seen = droplet.observe().unwrap();
            errors.push((dot(droplet.at(z).unwrap().1, z) - pole).abs());
            let within = if degree == 16 { 5e-10 } else { 3e-6 };
            assert!((dot(seen.velocity, z) - speed).abs() < within, "{viscosities:?} {degree} {:?}", seen.velocity);
            let along = dot(seen.stresslet.map(|row| dot(row, z)), z);
            assert!((along - stresslet).abs() < within, "{viscosities:?} {degree} {along}");
            let largest = seen.force_and_torque.iter().flatten().fold(0.0_f64, |most, value| most.max(value.abs()));
            assert!(largest < 1e-14, "{largest}");
            let axes = [1.3, 1.3_f64.powf(-0.5), 1.3_f64.powf(-0.5)];
            assert!(seen.semi_axes.iter().zip(axes).all(|(found, exact)| (found - exact).abs() < 1e-12));
        }
        assert!(errors[1] < errors[0] / 16.0 && errors[2] < errors[1] / 16.0, "{viscosities:?} {errors:?}");
        assert!(errors[2] < 4e-6, "{errors:?}");
    }
}

#[test]
fn high_degrees_give_the_spheroid_to_round_off() {
    let mut droplet = spheroid(36, [1.0, 1.0], true);
    droplet.evaluate().unwrap();
    let z = frame()[2];
    let pole = dot(droplet.at(z).unwrap().1, z);
    assert!((pole + 0.321567228398753).abs() < 1e-11, "{pole}");
}

#[test]
fn unresolved_particles_are_warned_of() {
    let step = |s: [f64; 3]| if s[2] > 0.3 { 1.0 } else { 0.0 };
    let law = ConstantTension::new(1.0).unwrap();
    let droplet = SpaceDroplet::sphere(6, 1.0, [1.0, 1.0], law).unwrap();
    assert!(droplet.warnings().is_empty());
    let mut sharp = droplet.with_particles(0.1, step).unwrap();
    sharp.evaluate().unwrap();
    let warnings = sharp.warnings();
    assert!(warnings[0].contains("negative") && warnings[0].contains("Use a degree above 6"), "{warnings:?}");
    assert!(warnings[1].contains("the particles are not resolved: the highest two degrees"), "{warnings:?}");
}
