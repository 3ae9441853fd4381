use active_interface::theory::{RoundDroplet, Sphere};
use active_interface::{ContractileTension, Tension};

use super::*;

fn start(degree: usize, activity: f64, viscosities: [f64; 2], first_mode: f64) -> SpaceDroplet {
    let law = ContractileTension::thesis(10.0, activity, -2.0 * activity, 100.0).unwrap();
    let droplet = SpaceDroplet::sphere(degree, 1.0, viscosities, law).unwrap();
    droplet.with_particles(0.1, |s| 100.0 * (1.0 + first_mode * s[2])).unwrap()
}

/// Growth of all harmonics of a sphere with degrees 1 to 4 against the closed form, for the same result at all orders.
#[test]
fn disturbances_of_a_sphere_grow_as_linear_theory_says() {
    for (activity, viscosities) in [(-1.0, [100.0, 100.0]), (-7.0, [1000.0, 10.0]), (-2.0, [1.0, 10.0])] {
        let law = ContractileTension::thesis(10.0, activity, -2.0 * activity, 100.0).unwrap();
        let theory = Sphere::new(RoundDroplet {
            radius: 1.0,
            viscosity_inside: viscosities[0],
            viscosity_outside: viscosities[1],
            tension: law.value(100.0),
            activity: -law.slope(100.0),
            concentration: 100.0,
            diffusivity: 0.1,
        })
        .unwrap();
        let mut sphere = SteadyState::of(start(8, activity, viscosities, 0.0)).unwrap();
        let (state, radii) = (sphere.droplet.state.clone(), sphere.radii.clone());
        for order in 0..=4 {
            let matrix = sphere.linearise(order, &state, &radii).unwrap();
            let least = order.max(1);
            let size = matrix.nrows() / 2;
            for l in least..=4 {
                // Particles m = c R^2: relative changes of c are those of m minus twice those of R.
                let entry = |row: usize, column: usize| matrix[(l - least + row * size, l - least + column * size)];
                let [aa, ab] = [entry(0, 0) + 2.0 * entry(0, 1), entry(0, 1)];
                let [ba, bb] = [entry(1, 0) + 2.0 * entry(1, 1) - 2.0 * aa, entry(1, 1) - 2.0 * ab];
                let exact = theory.growth_matrix(l as u32).unwrap();
                let exact = [exact[0][0], 100.0 * exact[0][1], exact[1][0] / 100.0, exact[1][1]];
                let scale = exact.iter().fold(0.0_f64, |most, entry| most.max(entry.abs()));
                for (k, (found, exact)) in [aa, ab, ba, bb].into_iter().zip(exact).enumerate() {
                    // In the frame of the droplet, l = 1 is no change of shape.
                    if l > 1 || k == 3 {
                        assert!((found - exact).abs() < 1e-9 * scale, "{activity} {l} {order}: {found} {exact}");
                    }
                }
            }
        }
    }
}

/// Speed, aspect ratio and rates of an independent axisymmetric boundary-integral program.
#[test]
fn swimmers_are_those_of_an_axisymmetric_program() {
    for (degree, activity, speed, aspect, within) in
        [(16, -1.0, 0.126082125506, 0.957859972447, 3e-5), (20, -2.0, 0.215271677346, 0.938016788857, 1e-4)]
    {
        let mut swimmer = SteadyState::find(start(degree, activity, [100.0, 100.0], 0.9)).unwrap();
        let seen = swimmer.droplet_mut().observe().unwrap();
        assert!((seen.speed / speed - 1.0).abs() < within, "{activity}: {:e}", seen.speed / speed - 1.0);
        let found = seen.semi_axes[2] / seen.semi_axes[0];
        assert!((found / aspect - 1.0).abs() < within, "{activity}: {:e}", found / aspect - 1.0);
        assert!(seen.concentrations[0] > 0.0 && swimmer.droplet().warnings().is_empty());
        if activity > -1.5 {
            // The zeros of translation and turning, then the rates; the program's are -0.2263, -0.4379 and -0.2630.
            for (order, zeros, rate, within) in [(0, 1, -0.2263, 2e-3), (1, 2, -0.4379, 2e-3), (2, 0, -0.2630, 2e-3)] {
                let rates = swimmer.growth_rates(order).unwrap();
                assert!(rates[..zeros].iter().all(|rate| rate.norm() < 2e-3), "{order}: {:?}", &rates[..3]);
                assert!((rates[zeros].re - rate).abs() < within, "{order}: {:?}", &rates[..3]);
            }
        }
    }
}

/// Cases that the crowding of parameters was not tuned on: the axisymmetric swimmers of `motile steady` with 208 and
/// 256 nodes. Their speeds change by less than 3e-6 from 144 and 192 nodes.
#[test]
fn crowding_serves_other_activities() {
    let cases = [(-1.5, 0.175_788_165, 0.948_842_5, 1e-5), (-3.0, 0.277_843_979, 0.920_732_2, 1e-4)];
    for (activity, speed, aspect, within) in cases {
        let mut swimmer = SteadyState::find(start(20, activity, [100.0, 100.0], 0.9)).unwrap();
        let seen = swimmer.droplet_mut().observe().unwrap();
        let errors = [seen.speed / speed - 1.0, seen.semi_axes[2] / seen.semi_axes[0] / aspect - 1.0];
        assert!(errors.iter().all(|error| error.abs() < within), "{activity}: {errors:?}");
    }
}

/// Two viscosities: the speed of the same program at 100 inside and 10 outside.
#[test]
fn swimmers_of_two_viscosities_are_those_of_an_axisymmetric_program() {
    let mut swimmer = SteadyState::find(start(14, -1.0, [100.0, 10.0], 0.9)).unwrap();
    let seen = swimmer.droplet_mut().observe().unwrap();
    assert!((seen.speed / 0.188181299717 - 1.0).abs() < 1e-3, "{}", seen.speed);
    assert!((seen.semi_axes[2] / seen.semi_axes[0] / 0.96302090774 - 1.0).abs() < 1e-3);
}

#[test]
fn droplets_without_an_axis_or_particles_are_refused() {
    let law = || ContractileTension::thesis(10.0, -1.0, 2.0, 100.0).unwrap();
    let bare = SpaceDroplet::sphere(4, 1.0, [1.0, 1.0], law()).unwrap();
    assert!(SteadyState::find(bare).unwrap_err().to_string().contains("no particles"));
    let sphere = SpaceDroplet::sphere(4, 1.0, [1.0, 1.0], law()).unwrap();
    let oblique = sphere.with_particles(0.1, |s| 100.0 + s[0]).unwrap();
    assert!(SteadyState::find(oblique).unwrap_err().to_string().contains("not axisymmetric"));
    let shape = |s: [f64; 3]| [1.2 * s[0], s[1], s[2]];
    let stretched = SpaceDroplet::shaped(4, shape, [1.0, 1.0], law()).unwrap();
    assert!(SteadyState::find(stretched).unwrap_err().to_string().contains("along its radii"));
    let sheared = start(4, -1.0, [100.0, 100.0], 0.5).with_imposed_flow([[0.0, 1.0, 0.0], [0.0; 3], [0.0; 3]]);
    assert!(SteadyState::find(sheared.unwrap()).unwrap_err().to_string().contains("imposed flow"));
}
