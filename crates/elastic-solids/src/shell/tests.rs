use std::f64::consts::TAU;

use proptest::prelude::*;

use super::*;

const COUNT: usize = 48;

fn curve(radius: f64, modes: &[[f64; 2]]) -> Vec<Vec2> {
    let at = |k: usize| {
        let angle = TAU * k as f64 / COUNT as f64;
        let waves = modes.iter().zip(2..).map(|([a, b], m)| {
            let phase = f64::from(m) * angle;
            a * phase.cos() * Vec2::from_angle(angle) + b * phase.sin() * Vec2::from_angle(angle).perp()
        });
        radius * Vec2::from_angle(angle) + waves.sum::<Vec2>()
    };
    (0..COUNT).map(at).collect()
}

fn forces(shell: &mut Shell) -> Vec<Vec2> {
    let mut forces = vec![Vec2::ZERO; COUNT];
    shell.write_forces(&crate::solid::tests::fluid_view(), &mut forces).unwrap();
    forces
}

proptest! {
    #[test]
    fn forces_are_minus_the_gradient_of_the_energy(
        rest in prop::array::uniform3(prop::array::uniform2(-0.05..0.05_f64)),
        now in prop::array::uniform3(prop::array::uniform2(-0.08..0.08_f64)),
        stretch in 0.8..1.3_f64,
        turning in any::<bool>(),
    ) {
        let measure = if turning { BendingMeasure::TurningAngle } else { BendingMeasure::Curvature };
        let shell = Shell::new(&curve(1.0, &rest), 3.0, 0.7).unwrap().with_measure(measure);
        let points = curve(stretch, &now);
        let mut shell = shell.deformed(&points).unwrap();
        let forces = forces(&mut shell);
        let total: Vec2 = forces.iter().sum();
        let torque: f64 = points.iter().zip(&forces).map(|(x, f)| x.perp_dot(*f)).sum();
        let size: f64 = forces.iter().map(|f| f.length()).sum();
        prop_assert!(total.length() < 1e-12 * size && torque.abs() < 1e-11 * size, "{total} {torque} {size}");
        let direction: Vec<Vec2> = (0..COUNT).map(|k| Vec2::from_angle((k * k) as f64) / COUNT as f64).collect();
        let step = 1e-4;
        let mut energy = |sign: f64| {
            let moved: Vec<Vec2> = points.iter().zip(&direction).map(|(x, d)| *x + sign * step * *d).collect();
            shell = shell.clone().deformed(&moved).unwrap();
            shell.energy()
        };
        let slope = (8.0 * (energy(1.0) - energy(-1.0)) - (energy(2.0) - energy(-2.0))) / (12.0 * step);
        let exact: f64 = forces.iter().zip(&direction).map(|(f, d)| f.dot(*d)).sum();
        prop_assert!((slope + exact).abs() < 1e-6 * (size / COUNT as f64 + 1.0), "{slope} {exact}");
    }
}

#[test]
fn an_unstressed_shell_has_no_forces() {
    let mut shell = Shell::new(&curve(1.0, &[[0.1, 0.03]]), 3.0, 0.7).unwrap();
    assert!(shell.energy() < 1e-25);
    assert!(forces(&mut shell).iter().all(|force| force.length() < 1e-11));
    let mut curved = shell.with_reference_curvature(0.0).unwrap();
    assert!(curved.energy() > 0.5 && forces(&mut curved).iter().any(|force| force.length() > 1e-3));
}

#[test]
fn what_is_no_shell_is_refused() {
    let circle = curve(1.0, &[]);
    assert!(Shell::new(&circle, -1.0, 0.1).is_err() && Shell::new(&circle, 1.0, f64::NAN).is_err());
    assert!(Shell::new(&circle[..5], 1.0, 0.1).is_err() && Shell::new(&[Vec2::X; 20], 1.0, 0.1).is_err());
    let shell = Shell::new(&circle, 1.0, 0.1).unwrap();
    assert!(shell.clone().with_viscosity_inside(0.0).is_err());
    assert!(shell.clone().with_reference_curvature(f64::INFINITY).is_err());
    assert!(shell.deformed(&circle[1..]).is_err());
}

/// Short waves on a circle relax as those on a flat membrane, `q (E_s + B q^2)/(2 (eta_in + eta_ext))`: along it by
/// stretching, across it by bending.
#[test]
fn step_limits_are_those_of_the_shortest_wave() {
    const MODES: usize = 32;
    let view = crate::solid::tests::fluid_view();
    let wave = (MODES / 2) as f64;
    for ([stretching, bending], along) in [([3.0, 0.0], true), ([0.0, 0.2], false)] {
        let shell = Shell::new(&curve(1.0, &[]), stretching, bending).unwrap().with_viscosity_inside(2.0).unwrap();
        let limit = |modes: usize| {
            let mut dt = f64::NAN;
            shell.step_limits(&FluidView { shape_modes: Some(modes), ..view }, &mut |limit| dt = limit.dt);
            dt
        };
        let dt = limit(MODES);
        // Markers have no shorter waves than they stand apart.
        assert_eq!(limit(10 * COUNT), limit(COUNT));
        let amplitude = 1e-6;
        let normals: Vec<Vec2> = curve(1.0, &[]);
        let way = |k: usize| if along { normals[k].perp() } else { normals[k] };
        let phase = |k: usize| (wave * TAU * k as f64 / COUNT as f64).cos();
        let moved: Vec<Vec2> = (0..COUNT).map(|k| normals[k] + amplitude * phase(k) * way(k)).collect();
        let pulled = forces(&mut shell.deformed(&moved).unwrap());
        // Force per length over amplitude, and the mobility of a wave.
        let density = -pulled[0].dot(way(0)) / amplitude * COUNT as f64 / TAU;
        let rate = density / (2.0 * (view.viscosity + 2.0) * wave);
        assert!((0.5 * dt * rate - 1.0).abs() < 0.02, "{along}: {dt} {rate}");
    }
}
