use super::*;
use crate::surface::{at, dot};
use active_interface::{ContractileTension, ExcludedVolume};

/// The closed form is U = -2 gamma_1/(3 (2 eta_e + 3 eta_i)), in any direction.
#[test]
fn marangoni_spheres_move_at_the_closed_form() {
    let length = (1.0_f64 + 4.0 + 0.25).sqrt();
    let axis = [1.0 / length, 2.0 / length, -0.5 / length];
    for viscosities in [[1.0, 1.0], [10.0, 1.0], [1.0, 10.0], [100.0, 1.0], [1.0, 100.0]] {
        let law = ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0).unwrap();
        let mut droplet = SpaceDroplet::sphere(10, 1.0, viscosities, law).unwrap();
        droplet = droplet.with_particles(0.0, |s| 1.0 + dot(s, axis)).unwrap();
        droplet.evaluate().unwrap();
        let exact = -2.0 * 0.5 / (3.0 * (2.0 * viscosities[1] + 3.0 * viscosities[0]));
        for (velocity, along) in droplet.flow.velocity.iter().zip(axis) {
            let error = (velocity / (exact * along) - 1.0).abs();
            assert!(error < 1e-11, "{viscosities:?}: {error:e}");
        }
    }
}

/// A droplet without symmetry, with all lengths in one unit and all forces in another.
fn scaled(degree: usize, length: f64, stress: f64, viscosities: [f64; 2]) -> SpaceDroplet {
    let shape = |s: [f64; 3]| [s[0] + 0.1 * s[1] * s[2], 0.9 * s[1], 1.1 * s[2] + 0.05 * s[0] * s[0]];
    let concentration = 100.0 / length.powi(2);
    let (force, activity) = (10.0 * stress * length, -stress * length.powi(3));
    let law = ContractileTension::thesis(force, activity, -2.0 * activity, concentration).unwrap();
    let viscosities = viscosities.map(|viscosity| stress * viscosity);
    let droplet = SpaceDroplet::shaped(degree, |s| shape(s).map(|x| length * x), viscosities, law).unwrap();
    let edge = EdgeFollowing { strength: 1.2, time: 2.0 };
    let droplet = droplet.with_particles(0.1 * length * length, |s| concentration * (1.0 + 0.5 * s[0])).unwrap();
    droplet.with_edge_following(edge).unwrap()
}

#[test]
fn results_do_not_depend_on_units() {
    let mut plain = scaled(6, 1.0, 1.0, [3.0, 1.0]);
    // Micrometres in SI units.
    let mut tiny = scaled(6, 1e-6, 1e-3, [3.0, 1.0]);
    plain.evaluate().unwrap();
    tiny.evaluate().unwrap();
    let n = count(6);
    for k in 0..3 * n {
        let (plain, tiny) = (plain.flow.rates[k], 1e6 * tiny.flow.rates[k]);
        assert!((plain - tiny).abs() < 1e-9, "{k}: {plain} {tiny}");
    }
    for k in 3 * n..4 * n {
        assert!((plain.flow.rates[k] - tiny.flow.rates[k]).abs() < 1e-7, "{k}");
    }
}

#[test]
fn particles_and_volume_are_conserved_at_any_viscosities() {
    for viscosities in [[1.0, 1.0], [100.0, 1.0], [1.0, 100.0]] {
        let mut droplet = scaled(8, 1.0, 1.0, viscosities);
        droplet.evaluate().unwrap();
        let n = count(8);
        assert!(droplet.flow.rates[3 * n].abs() < 1e-11 * droplet.flow.rates[3 * n + 1].abs());
        let flow = &droplet.flow;
        let flux = droplet.surface.integral(|k| dot(at(&flow.values, k), at(&droplet.surface.normals, k)));
        let through = |k: usize| dot(at(&flow.values, k), at(&droplet.surface.normals, k)).abs();
        assert!(flux.abs() < 2e-4 * droplet.surface.integral(through), "{viscosities:?}: {flux}");
        assert!(flow.iterations < 30, "{}", flow.iterations);
    }
}

/// The forces are minus the gradient of the discrete energy INT gamma J, whose differences are of fourth order here.
#[test]
fn forces_are_the_gradient_of_the_energy() {
    let n = count(6);
    let mut droplet = scaled(6, 1.0, 1.0, [1.0, 1.0]);
    droplet.tension = Box::new(active_interface::ConstantTension::new(1.0).unwrap());
    droplet.evaluate().unwrap();
    let forces = droplet.flow.forces.clone();
    let start = droplet.state.clone();
    for place in [2, n + 7, 2 * n + 20] {
        let h = 1e-3;
        let mut energy = |step: f64| {
            droplet.state.copy_from_slice(&start);
            droplet.state[place] += step;
            droplet.update_surface().unwrap();
            droplet.surface.integral(|k| droplet.surface.area[k])
        };
        let slope = (8.0 * (energy(h) - energy(-h)) - energy(2.0 * h) + energy(-2.0 * h)) / (12.0 * h);
        let force = forces[place / n][place % n];
        assert!((slope + force).abs() < 1e-10, "{place}: {slope} {force}");
    }
}

#[test]
fn droplets_at_rest_stay_at_rest() {
    let law = ContractileTension::thesis(10.0, -1.0, 2.0, 100.0).unwrap();
    let droplet = SpaceDroplet::sphere(4, 1.0, [1.0, 2.0], law).unwrap();
    let mut droplet = droplet.with_particles(0.1, |_| 100.0).unwrap();
    droplet.evaluate().unwrap();
    // Tensions of 110 over viscosities of 1: round-off only.
    let largest = droplet.flow.rates.iter().fold(0.0_f64, |most, rate| most.max(rate.abs()));
    assert!(largest < 1e-10, "{largest}");
}

#[test]
fn bad_input_is_refused_in_words() {
    let law = || active_interface::ConstantTension::new(1.0).unwrap();
    let message = |result: Result<SpaceDroplet, SpaceError>| result.unwrap_err().to_string();
    let sphere = |degree, radius, viscosities| SpaceDroplet::sphere(degree, radius, viscosities, law());
    let error = message(sphere(0, 1.0, [1.0, 1.0]));
    assert_eq!(error, "the degree of a droplet is out of range: 0. Use a degree from 2 to 96; 16 is a good start");
    assert!(message(sphere(4, 1.0, [1.0, -1.0])).starts_with("the viscosity outside is -1. Use a positive"));
    assert!(message(sphere(4, f64::NAN, [1.0, 1.0])).starts_with("the radius is NaN. Use a positive"));
    let good = || sphere(4, 1.0, [1.0, 1.0]).unwrap();
    assert!(message(good().with_particles(f64::INFINITY, |_| 1.0)).contains("the diffusivity"));
    assert!(message(good().with_particles(0.1, |_| f64::NAN)).contains("entry 0 of the concentrations is NaN"));
    let expanding = [[1.0, 0.0, 0.0], [0.0; 3], [0.0; 3]];
    assert!(message(good().with_imposed_flow(expanding)).contains("does not conserve volume"));
    assert!(message(good().with_quadrature(2, 8)).contains("2 rings of 8 points"));
    assert!(message(good().with_edge_following(EdgeFollowing { strength: 1.0, time: 0.0 })).contains("the time"));
    let inverted = SpaceDroplet::shaped(4, |s| s.map(|x| -x), [1.0, 1.0], law());
    assert!(message(inverted).contains("turned inside out"));
    #[derive(Debug)]
    struct Broken;
    impl Tension for Broken {
        fn value(&self, c: f64) -> f64 {
            (c - 1.5).ln()
        }
        fn slope(&self, c: f64) -> f64 {
            1.0 / (c - 1.5)
        }
    }
    let broken = SpaceDroplet::sphere(4, 1.0, [1.0, 1.0], Broken).unwrap();
    let mut broken = broken.with_particles(0.1, |_| 1.0).unwrap();
    assert!(broken.evaluate().unwrap_err().to_string().contains("Use a tension law that is finite"));
    let flat = SpaceDroplet::shaped(4, |s| [s[0], s[1], 0.0], [1.0, 1.0], law());
    assert!(matches!(flat, Err(SpaceError::Shape { degree: 4, .. })));
}

#[cfg(not(feature = "rayon"))]
#[test]
fn evaluations_allocate_nothing() {
    let mut droplet = scaled(6, 1.0, 1.0, [10.0, 1.0]);
    droplet.evaluate().unwrap();
    droplet.state[5] += 0.01;
    droplet.flow.known = false;
    let counted = allocation_counter::measure(|| droplet.evaluate().unwrap());
    assert_eq!(counted.count_total, 0);
}

#[cfg(feature = "rayon")]
#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let rates = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut droplet = scaled(8, 1.0, 1.0, [10.0, 1.0]);
        pool.install(|| droplet.evaluate()).unwrap();
        droplet.flow.rates.clone()
    };
    let single = rates(1);
    assert!(single.iter().zip(rates(3)).all(|(a, b)| a.to_bits() == b.to_bits()));
}

/// Without tension, a rotation turns any drop rigidly, and a sphere follows an extension E with the normal velocity
/// 5/(2 r + 3) n.E.n at the ratio r of viscosities (Taylor).
#[test]
fn imposed_flows_turn_and_stretch_drops_without_tension_as_they_must() {
    let law = || active_interface::ConstantTension::new(0.0).unwrap();
    let rotation = [[0.0, -0.3, 0.2], [0.3, 0.0, -0.5], [-0.2, 0.5, 0.0]];
    let extension = [[0.4, 0.1, 0.0], [0.1, -0.7, 0.2], [0.0, 0.2, 0.3]];
    let direction = [0.48, -0.6, 0.64];
    for ratio in [1.0, 10.0, 0.01] {
        let shape = |s: [f64; 3]| [1.2 * s[0] + 0.1 * s[1] * s[2], s[1], 0.8 * s[2]];
        let drop = SpaceDroplet::shaped(10, shape, [ratio, 1.0], law()).unwrap();
        let mut drop = drop.with_imposed_flow(rotation).unwrap();
        drop.evaluate().unwrap();
        let (place, velocity, _) = drop.at(direction).unwrap();
        let difference: [f64; 3] = std::array::from_fn(|i| velocity[i] - dot(rotation[i], place));
        assert!(dot(difference, difference).sqrt() < 1e-8, "{ratio}: {difference:?}");

        let sphere = SpaceDroplet::sphere(6, 2.0, [ratio, 1.0], law()).unwrap();
        let mut sphere = sphere.with_imposed_flow(extension).unwrap();
        sphere.evaluate().unwrap();
        let velocity = sphere.at(direction).unwrap().1;
        let exact = 2.0 * 5.0 / (2.0 * ratio + 3.0) * dot(extension.map(|row| dot(row, direction)), direction);
        assert!((dot(velocity, direction) - exact).abs() < 1e-10, "{ratio}: {velocity:?}");
    }
}
