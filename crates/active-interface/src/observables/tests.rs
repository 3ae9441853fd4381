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
        membrane: None,
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
        membrane: None,
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

/// In three dimensions: a spheroid has its aspect ratio, volume and surface, a thick lens the ratio of its second
/// moments `INT x^2 r^2 dx` and `INT r^4/4 dx`, and a sphere the projections of the flow on it, `sin^3` and `sin^3 cos`
/// in its frame: 4/5 of the first on B1 and 4/7 of the second on B2.
#[test]
fn spheroids_and_squirmers_in_three_dimensions() {
    let bulge = |t: f64, more: f64| t.sin() * (1.0 + more * t.sin().powi(2));
    let seen = |[along, more]: [f64; 2], velocity: &dyn Fn(Vec2) -> Vec2| {
        let centre = Vec2::new(4.0, 0.0);
        let angle = |k: u32| std::f64::consts::TAU * f64::from(k) / 96.0;
        let mut markers: Vec<Vec2> =
            (0..96).map(|k| centre + Vec2::new(along * angle(k).cos(), bulge(angle(k), more))).collect();
        (markers[0].y, markers[48].y) = (0.0, 0.0);
        let velocities: Vec<Vec2> = markers.iter().map(|x| velocity(*x - centre)).collect();
        let forces = vec![Vec2::ZERO; 96];
        let state = InterfaceState {
            markers: &markers,
            forces: &forces,
            velocities: &velocities,
            imposed: ImposedFlow::NONE,
            numbers: &[],
            viscosities: [1.0; 2],
            inside: None,
            membrane: None,
            enclosed: Vec::new(),
            axisymmetric: true,
            on_grid: false,
        };
        observe(&state, Convention::FarField).unwrap()
    };
    let spheroid = seen([1.5, 0.0], &|_| Vec2::new(0.2, 0.0));
    assert_relative_eq!(spheroid.aspect_ratio_moments, 1.5, max_relative = 1e-9);
    assert_relative_eq!(spheroid.area, 2.0 * PI, max_relative = 1e-9);
    let eccentricity = (1.0 - 1.0 / 2.25_f64).sqrt();
    let surface = 2.0 * PI * (1.0 + 1.5 / eccentricity * eccentricity.asin());
    assert_relative_eq!(spheroid.perimeter, surface, max_relative = 1e-9);
    assert_relative_eq!(spheroid.centroid.x, 4.0, max_relative = 1e-12);
    assert_relative_eq!(spheroid.velocity.x, 0.2, max_relative = 1e-9);

    let lens = seen([0.7, 0.4], &|_| Vec2::new(0.2, 0.0));
    let integral = |of: &dyn Fn(f64, f64) -> f64| {
        let parts = (1..1000).map(|k| f64::from(k) * PI / 1000.0);
        parts.map(|t| of(0.7 * t.cos(), bulge(t, 0.4)) * 0.7 * t.sin()).sum::<f64>()
    };
    let ratio = integral(&|x, r| x * x * r * r) / integral(&|_, r| 0.25 * r.powi(4));
    assert_relative_eq!(lens.aspect_ratio_moments, ratio.sqrt(), max_relative = 1e-9);

    let (b1, b2, speed) = (0.3, -0.1, 0.2);
    let sphere = seen([1.0, 0.0], &|n| {
        // On the upper half theta grows from the front towards the back; the lower half is its mirror image.
        let (cos, sin, side) = (n.x, n.y.abs(), n.y.signum());
        let around = sin.powi(3) * (b1 / 0.8 + 1.75 * b2 * cos);
        Vec2::new(speed - around * sin, around * cos * side)
    });
    assert_relative_eq!(sphere.velocity.x, speed, max_relative = 1e-9);
    assert_relative_eq!(sphere.aspect_ratio_moments, 1.0, max_relative = 1e-9);
    assert_relative_eq!(sphere.squirmer.b1, b1, max_relative = 1e-9);
    assert_relative_eq!(sphere.squirmer.b2, b2, max_relative = 1e-9);
    assert_relative_eq!(sphere.squirmer_laboratory.b1, b1 - speed, max_relative = 1e-9);
    assert_relative_eq!(sphere.squirmer_laboratory.b2, b2, max_relative = 1e-9);
}
