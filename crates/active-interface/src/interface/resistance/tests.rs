use std::f64::consts::TAU;

use motile_base::Region;
use motile_scene::Body;

use super::*;
use crate::{Cortex, Curve};

fn view(shape_modes: Option<usize>) -> FluidView {
    FluidView {
        domain: Region::Box { lengths: [6.0, 6.0] }.into(),
        viscosity: 2.0,
        spacing: None,
        second_order: true,
        shape_modes,
        nodes: shape_modes,
        interface_stiffness: 8.0,
    }
}

/// An ellipse, and one period of a wave, of so many markers, with a cortex and friction, after its forces are written.
fn interfaces(count: usize, modes: Option<usize>) -> [ActiveInterface; 2] {
    let ellipse = Curve::ellipse(1.6, 1.0 / 1.6).unwrap().markers(count).unwrap();
    let wave = crate::wave(0.1, 6.0, &[0.4], &[0.0, 0.2], count).unwrap();
    let closed = crate::ActiveDroplet::passive(&ellipse, 1.0).unwrap().interface;
    [closed, ActiveInterface::periodic_passive(&wave, 6.0, 1.0).unwrap()].map(|interface| {
        let mut made = interface.with_cortex_viscosity(3.0).unwrap().with_friction(0.7).unwrap();
        made.write_forces(&view(modes), &mut vec![Vec2::ZERO; count]).unwrap();
        made
    })
}

/// Some numbers without a pattern.
fn scatter(count: usize, seed: f64) -> Vec<f64> {
    (0..count).map(|k| (seed * (k as f64 + 1.0) * (k as f64 + 0.3)).sin()).collect()
}

fn vectors(list: &[f64]) -> Vec<Vec2> {
    list.chunks_exact(2).map(|pair| Vec2::new(pair[0], pair[1])).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Forces are the exact transpose of rates, of odd and even numbers of markers, polygons and smooth curves.
#[test]
fn forces_are_the_transpose_of_rates() {
    for (count, modes) in [(64, None), (65, None), (64, Some(32)), (65, Some(33)), (64, Some(64))] {
        for mut interface in interfaces(count, modes) {
            let velocities = vectors(&scatter(2 * count, 0.37));
            let stresses = scatter(interface.stress_count(), 0.91);
            assert_eq!(stresses.len(), 3 * count);
            let mut rates = vec![0.0; stresses.len()];
            interface.write_rates(&velocities, &mut rates);
            let mut forces = vec![Vec2::ZERO; count];
            interface.add_stress_forces(&stresses, &mut forces);
            let power: f64 = -forces.iter().zip(&velocities).map(|(force, v)| force.dot(*v)).sum::<f64>();
            assert!((power - dot(&rates, &stresses)).abs() < 1e-12 * dot(&stresses, &stresses), "{count} {modes:?}");
        }
    }
}

/// In place of a rotated inverse: symmetric, and positive for the waves that are resolved.
#[test]
fn the_preconditioner_is_symmetric_and_positive() {
    for (count, modes) in [(64, None), (65, Some(33)), (64, Some(64))] {
        for mut interface in interfaces(count, modes) {
            let [one, other] = [0.37, 0.91].map(|seed| scatter(interface.stress_count(), seed));
            let mut improve = |rates: &[f64]| {
                let mut stresses = rates.to_vec();
                interface.precondition(&mut stresses);
                stresses
            };
            let [first, second] = [&one, &other].map(|rates| improve(rates));
            let size = dot(&one, &first);
            assert!(size > 0.0 && dot(&other, &second) > 0.0);
            assert!((dot(&other, &first) - dot(&one, &second)).abs() < 1e-12 * size);
        }
    }
}

/// A circle that grows in a source flow `r/R` stretches at the rate 1/R, a rotation does not stretch it, and the power
/// of the cortex is minus `INT eta_s Th^2 ds`.
#[test]
fn rates_and_powers_on_a_circle() {
    let (radius, viscosity, count) = (1.3, 3.0, 96);
    let markers = Curve::circle(radius).unwrap().markers(count).unwrap();
    for modes in [None, Some(48)] {
        let droplet = crate::ActiveDroplet::passive(&markers, 1.0).unwrap().with_cortex_viscosity(viscosity).unwrap();
        let mut interface = droplet.interface;
        interface.write_forces(&view(modes), &mut vec![Vec2::ZERO; count]).unwrap();
        let power = |interface: &mut ActiveInterface, flow: &dyn Fn(Vec2) -> Vec2| {
            let velocities: Vec<Vec2> = markers.iter().map(|x| flow(*x)).collect();
            let [mut stresses, mut compliances] = [0; 2].map(|_| vec![0.0; count]);
            interface.write_rates(&velocities, &mut stresses);
            interface.write_compliances(&mut compliances);
            stresses.iter_mut().zip(&compliances).for_each(|(stress, compliance)| *stress /= compliance);
            let mut forces = vec![Vec2::ZERO; count];
            interface.add_stress_forces(&stresses, &mut forces);
            forces.iter().zip(&velocities).map(|(force, v)| force.dot(*v)).sum::<f64>()
        };
        // Markers lie on a circle that is larger by that of the polygon of the same area.
        let found = power(&mut interface, &|x| x / radius);
        assert!((found * radius / (-viscosity * TAU) - 1.0).abs() < 2e-3, "{found}");
        assert!(power(&mut interface, &|x| x.perp()).abs() < 1e-13);
        // v = (x, -y) has Th = -cos 2 th ... of amplitude one, whose square has the mean 1/2.
        let found = power(&mut interface, &|x| Vec2::new(x.x, -x.y));
        assert!((found / (-viscosity * 0.5 * TAU * radius) - 1.0).abs() < 3e-3, "{found}");
    }
}

/// Total tensions are those of the law and the viscous ones, which a saved state keeps.
#[test]
fn tensions_are_total_and_saved() {
    let [mut interface, _] = interfaces(64, Some(32));
    let stresses = scatter(interface.stress_count(), 0.5);
    interface.set_stresses(&stresses);
    for (total, viscous) in interface.tensions().iter().zip(&stresses) {
        assert_eq!(*total, 1.0 + viscous);
    }
    let saved = interface.save();
    let [mut other, _] = interfaces(64, Some(32));
    other.load(&view(Some(32)), &saved).unwrap();
    assert_eq!((other.stresses(), other.tensions()), (&stresses[..], interface.tensions()));
    // A cortex in place of both, and nothing in place of them.
    let bare = |cortex: f64| {
        let markers = Curve::ellipse(1.6, 1.0 / 1.6).unwrap().markers(64).unwrap();
        let made = crate::ActiveDroplet::passive(&markers, 1.0).unwrap().with_cortex_viscosity(cortex).unwrap();
        let mut made = made.interface;
        made.load(&view(Some(32)), &saved).unwrap();
        made
    };
    assert_eq!((bare(2.0).stresses(), bare(0.0).stresses().len()), (&[0.0; 64][..], 0));
    assert!(bare(0.0).as_viscous().is_none() && bare(2.0).as_viscous().is_some());
}

#[test]
fn impossible_resistances_are_refused() {
    let markers = Curve::circle(1.0).unwrap().markers(64).unwrap();
    let droplet = || crate::ActiveDroplet::passive(&markers, 1.0).unwrap();
    for wrong in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(droplet().with_cortex_viscosity(wrong).is_err() && droplet().with_friction(wrong).is_err());
        assert!(droplet().with_cortex(Cortex { per_concentration: wrong, ..Cortex::new(1.0) }).is_err());
    }
    let mut forces = vec![Vec2::ZERO; 64];
    let on_grid = FluidView { spacing: Some(0.1), ..view(None) };
    let plain = FluidView { second_order: false, ..on_grid.clone() };
    let mut made = droplet().with_cortex_viscosity(1.0).unwrap();
    assert!(made.write_forces(&on_grid, &mut forces).is_ok());
    let error = made.write_forces(&plain, &mut forces).unwrap_err().to_string();
    assert!(error.starts_with("a cortex needs more accurate velocities"), "{error}");
    assert!(droplet().with_friction(1.0).unwrap().write_forces(&plain, &mut forces).is_ok());
    assert!(droplet().with_cortex(Cortex { shear_viscosity: 1.0, ..Cortex::new(1.0) }).is_err());
    // A substrate touches a body of revolution on one side.
    assert!(droplet().axisymmetric().unwrap().with_friction(1.0).is_err());
    let mut made = droplet().with_friction(1.0).unwrap().axisymmetric().unwrap();
    assert!(made.write_forces(&view(Some(32)), &mut forces).is_err());
}

/// The power of the forces of stresses is minus that of the stresses, also for a cortex given before the symmetry.
#[test]
fn forces_of_rings_are_the_transpose_of_their_rates() {
    let error = |count: usize| {
        let markers = Curve::ellipse(1.3, 0.8).unwrap().markers(count).unwrap();
        let made = crate::ActiveDroplet::passive(&markers, 1.0).unwrap().with_cortex_viscosity(3.0).unwrap();
        let cortex = Cortex { shear_viscosity: 2.0, ..Cortex::new(3.0) };
        let mut made = made.axisymmetric().unwrap().with_cortex(cortex).unwrap();
        made.write_forces(&view(Some(64)), &mut vec![Vec2::ZERO; count]).unwrap();
        let markers = made.markers().to_vec();
        let velocities: Vec<Vec2> =
            markers.iter().map(|x| Vec2::new(x.x * x.x - 0.3 * x.y * x.y, x.y * (0.4 + x.x))).collect();
        let viscous = made.as_viscous().unwrap();
        let mut rates = vec![0.0; viscous.stress_count()];
        viscous.write_rates(&velocities, &mut rates);
        // The difference of stresses vanishes at the poles as the square of the distance from the axis.
        let half = count / 2;
        let isotropic = markers.iter().take(half + 1).map(|x| 1.0 + 0.5 * x.x - x.x * x.x);
        let stresses: Vec<f64> =
            isotropic.chain(markers.iter().take(half + 1).map(|x| x.y * x.y * (0.7 - x.x))).collect();
        let mut forces = vec![Vec2::ZERO; count];
        viscous.add_stress_forces(&stresses, &mut forces);
        let quadrature = crate::interface::geometry::Rings::quadrature(count);
        let all = quadrature.iter().zip(forces.iter().zip(&velocities));
        let power: f64 = all.map(|(weight, (force, v))| weight * force.dot(*v)).sum();
        let exact: f64 = stresses.iter().zip(&rates).map(|(stress, rate)| stress * rate).sum();
        (power / exact + 1.0).abs()
    };
    // To the accuracy of the series through the curve.
    let errors = [48, 96, 192].map(error);
    println!("{errors:?}");
    assert!(errors[1] < 1e-3 * errors[0] && errors[2] < 1e-12, "{errors:?}");
}
