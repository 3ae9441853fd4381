use super::*;
use crate::{ContractileTension, Curve, ExcludedVolume, InitialConcentration, Tension, theory::SquirmerFlow};
use approx::assert_relative_eq;
use std::collections::HashSet;

/// A round droplet in the polarised state with the flow of a squirmer, seen from the laboratory.
fn droplet(count: usize, heading: f64, forces: bool) -> (Vec<Vec2>, Vec<Vec2>, Vec<Vec2>, Vec<f64>) {
    let centre = Vec2::new(2.0, -1.0);
    let markers = Curve::circle(1.0).unwrap().translated(centre).markers(count).unwrap();
    let numbers = InitialConcentration::polarised(100.0, heading).unwrap().particle_numbers(&markers).unwrap();
    let squirmer = SquirmerFlow::new(1.0, 0.3, -0.1).unwrap();
    let turn = Vec2::from_angle(heading);
    let velocities = markers
        .iter()
        .map(|p| {
            let on_circle = Vec2::from_angle(-heading).rotate(p - centre).normalize();
            turn.rotate(squirmer.velocity(on_circle, VelocityFrame::Laboratory))
        })
        .collect();
    // gamma = 10 + c - Pi(c), as in the reference: A = 2, T = 2, a = 20, c0 = 100.
    let law = ContractileTension::new(10.0, -1.0, ExcludedVolume::Step(2.0), 100.0).unwrap();
    let pull = |k: usize| {
        let chord = markers[(k + 1) % count] - markers[k];
        chord.normalize() * law.value(numbers[k] / chord.length())
    };
    let strength = if forces { 1.0 } else { 0.0 };
    let forces = (0..count).map(|k| (pull(k) - pull((k + count - 1) % count)) * strength).collect();
    (markers, forces, velocities, numbers)
}

fn record(count: usize, heading: f64) -> Observables {
    let (markers, forces, velocities, numbers) = droplet(count, heading, true);
    let state = InterfaceState {
        markers: &markers,
        forces: &forces,
        velocities: &velocities,
        imposed: ImposedFlow::NONE,
        numbers: &numbers,
        viscosities: [100.0, 100.0],
        inside: None,
        enclosed: Vec::new(),
        axisymmetric: false,
        on_grid: false,
    };
    observe(&state, Convention::FarField).unwrap()
}

#[test]
fn the_start_of_the_reference_transient() {
    // reference/swimmer_transient_box6_activity_1.csv, t = 0: Sxx, Nxyy, active_frac, cmax, kappa_act
    let errors = [125, 250].map(|count| {
        let record = record(count, 0.8);
        assert_relative_eq!(record.active_region.unwrap().fraction, 0.5, epsilon = 1e-7);
        assert_relative_eq!(record.active_curvature.unwrap(), 1.0, epsilon = 1e-3);
        assert_relative_eq!(record.concentration_range.unwrap()[0], 200.0, max_relative = 2e-3);
        let found = [record.moments.stresslet()[0][0], record.get("n_xyy").unwrap()];
        [(found[0] / -4.839_138_94 - 1.0).abs(), (found[1] / -201.709_187 - 1.0).abs()]
    });
    for (coarse, fine) in errors[0].iter().zip(errors[1]) {
        assert!(fine < 1e-3 && (coarse / fine).log2() > 1.9, "{errors:?}");
    }
}

#[test]
fn motion_and_flow_of_a_squirmer() {
    let record = record(200, -2.0);
    assert_relative_eq!(record.speed(), 0.15, max_relative = 1e-3);
    assert_relative_eq!(record.heading().unwrap(), -2.0, max_relative = 1e-10);
    assert_relative_eq!(record.squirmer.beta().unwrap(), -1.0 / 3.0, max_relative = 1e-3);
    assert_relative_eq!(record.squirmer_laboratory.b1, 0.15, max_relative = 1e-3);
    assert_relative_eq!(record.aspect_ratio_moments, 1.0, max_relative = 1e-10);
    assert_relative_eq!(record.get("aspect_ratio_ellipse").unwrap(), 1.0, max_relative = 1e-10);
    assert_relative_eq!(record.get("x").unwrap(), 2.0, max_relative = 1e-12);
    assert_relative_eq!(record.get("concentration_mode_1").unwrap(), 1.0, max_relative = 1e-10);
    assert_relative_eq!(record.get("area").unwrap(), PI, max_relative = 1e-13);
    assert_eq!(record.get("nonsense"), None);
}

#[test]
fn the_columns_have_names_of_their_own() {
    let record = record(60, 0.0);
    let entries = record.entries();
    let names: HashSet<&str> = entries.iter().map(|entry| entry.0).collect();
    assert_eq!(names.len(), entries.len());
    // A circle has no inclination.
    let mut known = entries.iter().filter(|entry| entry.0 != "inclination_degrees");
    assert!(known.all(|entry| entry.1.is_some_and(f64::is_finite)), "{entries:?}");
    assert_eq!(record.get("inclination_degrees"), None);
}

#[test]
fn a_drop_without_particles_at_rest() {
    let (markers, forces, _, _) = droplet(40, 0.0, false);
    let rest = vec![Vec2::ZERO; 40];
    let viscosities = [1.0, 2.0];
    let state = InterfaceState {
        markers: &markers,
        forces: &forces,
        velocities: &rest,
        imposed: ImposedFlow::NONE,
        numbers: &[],
        viscosities,
        inside: None,
        enclosed: Vec::new(),
        axisymmetric: false,
        on_grid: false,
    };
    let record = observe(&state, Convention::AsPrinted).unwrap();
    assert_eq!(record.get("concentration_max"), None);
    assert_eq!(record.get("active_fraction"), None);
    assert_eq!(record.get("beta"), None);
    assert_eq!(record.particle_number, 0.0);
    assert_eq!(record.heading(), None);
    assert!(record.entries().iter().all(|entry| entry.1.is_none_or(f64::is_finite)));
    for bad in [
        InterfaceState { markers: &markers[..7], ..state.clone() },
        InterfaceState { forces: &forces[..7], ..state.clone() },
        InterfaceState { velocities: &rest[1..], ..state.clone() },
        InterfaceState { numbers: &[1.0], ..state.clone() },
        InterfaceState { viscosities: [f64::NAN, 1.0], ..state.clone() },
    ] {
        assert!(observe(&bad, Convention::FarField).is_err());
    }
}
