use std::f64::consts::TAU;

use active_interface::{ConstantTension, ContractileTension, ExcludedVolume};
use stokes_axisymmetric::{AxisymmetricFlow, Interface, MeridianCalculus, Settings, TensionPlacement, Vec2};

use super::*;
use crate::{EdgeFollowing, RungeKuttaChebyshev, SpaceDroplet, SpaceDroplets, SteadyState, StepSize};

/// Adds the flow of forces in unbounded fluid.
fn free(place: [f64; 3], force: [f64; 3], target: [f64; 3]) -> [f64; 3] {
    let r: [f64; 3] = std::array::from_fn(|i| target[i] - place[i]);
    let inverse = 1.0 / dot(r, r).sqrt();
    let along = dot(r, force) * inverse * inverse;
    std::array::from_fn(|i| inverse * (force[i] + along * r[i]) / (8.0 * PI))
}

/// Returns the flow that the wall adds to a force.
fn wall_flow(tube: &mut Tube, place: [f64; 3], force: [f64; 3], target: [f64; 3]) -> [f64; 3] {
    let (places, forces) = (place.map(|x| [x]), force.map(|x| [x]));
    let sources =
        Sources::Forces { places: places.each_ref().map(|x| &x[..]), forces: forces.each_ref().map(|x| &x[..]) };
    flow_at(tube, sources, target)
}

fn flow_at(tube: &mut Tube, sources: Sources<'_>, target: [f64; 3]) -> [f64; 3] {
    let target = target.map(|x| [x]);
    let mut flow = [[0.0]; 3];
    let [x, y, z] = &mut flow;
    let places = target.each_ref().map(|x| &x[..]);
    let mut targets = [Targets { places, flow: [&mut x[..], &mut y[..], &mut z[..]] }];
    tube.add_flow(&[sources], &mut targets).unwrap();
    flow.map(|list| list[0])
}

#[test]
fn fluid_does_not_slip_on_the_wall() {
    // Waves are left out by what they do at the source: at the wall, the root of that remains.
    for (radius, r) in [(1.0, 0.0), (1.0, 0.3), (3e-6, 1.5e-6), (1.0, 0.8)] {
        let mut tube = Tube::new(radius).unwrap();
        let place = [0.6 * r, 0.8 * r, 0.2 * radius];
        for force in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.3, -0.5, 0.7]] {
            for (angle, z) in [(0.7, 0.4), (0.9, 0.2), (4.0, -1.5), (2.0, 0.0)] {
                let target = [radius * f64::cos(angle), radius * f64::sin(angle), radius * z];
                let (mine, free) = (wall_flow(&mut tube, place, force, target), free(place, force, target));
                let slip = (0..3).map(|i| (mine[i] + free[i]).abs()).fold(0.0, f64::max) * radius;
                let allowed = if r > 0.5 * radius { 1e-6 } else { 1e-9 };
                assert!(slip < allowed, "{radius} {r} {force:?} {angle} {z}: {slip:e} {mine:?} {free:?}");
            }
        }
    }
}

/// Returns the velocity of the wall's flow at a force, along it, as a factor of `-F/(6 pi R)`.
fn drag(place: f64, force: [f64; 3]) -> f64 {
    let mut tube = Tube::new(2.0).unwrap();
    let flow = wall_flow(&mut tube, [2.0 * place, 0.0, 0.3], force, [2.0 * place, 0.0, 0.3]);
    -6.0 * PI * 2.0 * dot(flow, force)
}

/// A small sphere in a tube: the published first coefficients of its drag, 2.10444 along the axis, which falls by
/// 0.6977 times the square of the distance from the axis, and 1.8044 across it (Happel and Brenner, Low Reynolds number
/// hydrodynamics, chapter 7).
#[test]
fn small_spheres_have_the_published_drag() {
    let (along, across) = ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    assert!((drag(0.0, along) - 2.104443).abs() < 1e-6, "{}", drag(0.0, along));
    assert!((drag(0.0, across) - 1.804360).abs() < 1e-6, "{}", drag(0.0, across));
    let curvature = (drag(0.03, along) - drag(0.0, along)) / 0.03_f64.powi(2);
    assert!((curvature + 0.6977).abs() < 3e-3, "{curvature}");
    // Close to the wall, nearly a plane: 9/8 and 9/16 over the distance (Lorentz).
    for (force, factor) in [(across, 9.0 / 8.0), ([0.0, 1.0, 0.0], 9.0 / 16.0), (along, 9.0 / 16.0)] {
        let value = 0.05 * drag(0.95, force);
        assert!((value / factor - 1.0).abs() < 0.07, "{value} {factor}");
    }
}

#[test]
fn reflected_flows_are_reciprocal() {
    let mut tube = Tube::new(1.3).unwrap();
    let (a, b) = ([0.2, 0.5, 0.1], [-0.6, 0.3, 0.7]);
    let (f, g) = ([0.3, -0.5, 0.7], [0.9, 0.1, -0.4]);
    let one = dot(wall_flow(&mut tube, a, f, b), g);
    let other = dot(wall_flow(&mut tube, b, g, a), f);
    assert!((one - other).abs() < 1e-9 * one.abs(), "{one} {other}");
}

/// By the reciprocal theorem, a stresslet u n at y gives the flow `u.s n` at x along g, with the stress s at y of the
/// reflected flow of a force g at x. For u across n, the pressure does not count.
#[test]
fn reflected_stresslets_are_stresses_of_reflected_forces() {
    let mut tube = Tube::new(1.3).unwrap();
    for (x, y) in [([0.2, 0.5, 0.1], [-0.6, 0.3, 0.7]), ([0.1, 0.0, 0.1], [0.0, 0.0, 0.4])] {
        let (u, n) = ([0.3, -0.5, 0.7], [0.5, 1.0, 0.5]);
        for g in [[0.9, 0.1, -0.4], [0.0, 1.0, 0.0]] {
            let h = 1e-3;
            let slope = |along: [f64; 3], part: [f64; 3], tube: &mut Tube| {
                let value = |factor: f64, tube: &mut Tube| {
                    let place = std::array::from_fn(|i| y[i] + factor * h * along[i]);
                    dot(wall_flow(tube, x, g, place), part)
                };
                let near = value(1.0, tube) - value(-1.0, tube);
                let far = value(2.0, tube) - value(-2.0, tube);
                (8.0 * near - far) / (12.0 * h)
            };
            let stress = slope(n, u, &mut tube) + slope(u, n, &mut tube);
            let (places, normals, velocities) = (y.map(|x| [x]), n.map(|x| [x]), u.map(|x| [x]));
            let sources = Sources::Stresslets {
                places: places.each_ref().map(|x| &x[..]),
                normals: normals.each_ref().map(|x| &x[..]),
                velocities: velocities.each_ref().map(|x| &x[..]),
            };
            let flow = dot(flow_at(&mut tube, sources, x), g);
            assert!((flow - stress).abs() < 1e-8, "{flow} {stress}");
        }
    }
}

/// A sphere whose tension grows along an axis.
fn marangoni(degree: usize, viscosities: [f64; 2], axis: [f64; 3], length: f64) -> SpaceDroplet {
    let law = ContractileTension::new(length, -0.5 * length.powi(3), ExcludedVolume::None, 1.0).unwrap();
    let droplet = SpaceDroplet::sphere(degree, length, viscosities, law).unwrap();
    droplet.with_particles(0.1, |s| (1.0 + dot(s, axis)) / length.powi(2)).unwrap()
}

/// The double layer of a constant velocity vanishes outside, also what the wall reflects of it, the pressure among it.
#[test]
fn stresslets_of_a_constant_velocity_reflect_nothing() {
    let grid = sphere_harmonics::Grid::gauss(12).unwrap();
    let weights: Vec<f64> = grid.weights().collect();
    let (mut places, mut normals) = ([(); 3].map(|()| Vec::new()), [(); 3].map(|()| Vec::new()));
    for (point, weight) in grid.points().zip(&weights) {
        let direction = sphere_harmonics::Point::direction(point);
        for i in 0..3 {
            places[i].push([0.3, -0.2, 0.1][i] + 0.4 * direction[i]);
            normals[i].push(0.16 * weight * direction[i]);
        }
    }
    let velocities = [0.3, -0.5, 0.7].map(|u| vec![u; weights.len()]);
    let mut tube = Tube::new(1.0).unwrap();
    let sources = Sources::Stresslets {
        places: places.each_ref().map(|x| &x[..]),
        normals: normals.each_ref().map(|x| &x[..]),
        velocities: velocities.each_ref().map(|x| &x[..]),
    };
    let flow = flow_at(&mut tube, sources, [-0.3, 0.4, 0.2]);
    assert!(dot(flow, flow).sqrt() < 1e-9, "{flow:?}");
}

/// A drop of the fluid's viscosity and of constant tension moves with the mean of the imposed flow over its volume.
#[test]
fn round_drops_move_with_the_mean_of_poiseuille() {
    for place in [0.0, 0.5] {
        let drop = SpaceDroplet::sphere(8, 0.4, [2.0, 2.0], ConstantTension::new(1.0).unwrap()).unwrap();
        let tube = Tube::new(1.2).unwrap().with_mean_flow(0.7).unwrap();
        let drop = drop.with_position([place, 0.0, 3.0]).unwrap();
        let velocity = drop.with_surroundings(tube).unwrap().observe().unwrap().velocity;
        let exact = 1.4 * (1.0 - (place * place + 0.4 * 0.16) / 1.44);
        assert!((velocity[2] - exact).abs() < 1e-12 && velocity[0].abs() < 1e-12, "{velocity:?} {exact}");
    }
}

#[test]
fn results_depend_on_neither_units_nor_axes() {
    let velocity = |degree: usize, length: f64, axes: [[f64; 3]; 3], viscosities: [f64; 2]| {
        let turn = |v: [f64; 3]| -> [f64; 3] { std::array::from_fn(|i| (0..3).map(|j| v[j] * axes[j][i]).sum()) };
        let axis = turn([0.48, 0.64, 0.6]);
        let droplet =
            marangoni(degree, viscosities, axis, length).with_position(turn([0.3 * length, 0.1 * length, 0.0]));
        let tube = Tube::new(1.6 * length).unwrap().along(axes[2]).unwrap();
        let velocity = droplet.unwrap().with_surroundings(tube).unwrap().observe().unwrap().velocity;
        axes.map(|axis| dot(axis, velocity) / length)
    };
    let plain = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let turned = [[0.8, 0.0, 0.6], [0.36, 0.8, -0.48], [-0.48, 0.6, 0.64]];
    // A turned grid samples the reflected flow elsewhere: an error of the degree.
    let cases =
        [(6, [4.0, 1.0], 1e-6, plain, 1e-9), (6, [1.0, 1.0], 1e5, turned, 3e-4), (12, [1.0, 1.0], 1.0, turned, 1e-7)];
    for (degree, viscosities, length, axes, allowed) in cases {
        let exact = velocity(degree, 1.0, plain, viscosities);
        let found = velocity(degree, length, axes, viscosities);
        for i in 0..3 {
            let error = ((found[i] - exact[i]) / exact[2]).abs();
            assert!(error < allowed, "{degree} {length}: {error:e} {found:?} {exact:?}");
        }
    }
}

#[test]
fn the_tolerance_bounds_what_is_left_out() {
    let velocity = |tolerance: f64| {
        let tube = Tube::new(1.4).unwrap().with_tolerance(tolerance).unwrap();
        let droplet = marangoni(8, [1.0, 1.0], [0.6, 0.0, 0.8], 1.0).with_position([0.1, 0.1, 0.0]).unwrap();
        droplet.with_surroundings(tube).unwrap().observe().unwrap().velocity
    };
    let exact = velocity(1e-12);
    for tolerance in [1e-4, 1e-6, 3e-10] {
        let found = velocity(tolerance);
        let error = (0..3).map(|i| (found[i] - exact[i]).abs() * 15.0).fold(0.0, f64::max);
        assert!(error < tolerance, "{tolerance}: {error:e}");
    }
    assert!(Tube::new(1.0).unwrap().with_tolerance(0.0).is_err());
}

#[test]
fn several_droplets_feel_one_tube() {
    // One droplet, and the same one as a group.
    let with = |viscosities: [f64; 2]| marangoni(5, viscosities, [0.6, 0.0, 0.8], 1.0).with_position([0.2, 0.0, 0.0]);
    let droplet = || with([3.0, 1.0]).unwrap();
    let tube = || Tube::new(1.7).unwrap();
    let alone = droplet().with_surroundings(tube()).unwrap().observe().unwrap().velocity;
    let mut one = SpaceDroplets::new(vec![droplet()]).unwrap().with_surroundings(tube()).unwrap();
    let found = one.observe(0).unwrap().velocity;
    assert!((0..3).all(|i| (found[i] - alone[i]).abs() < 1e-10), "{found:?} {alone:?}");
    // Droplets that are far from each other in a tube do not feel each other at all.
    let droplet = || with([1.0, 1.0]).unwrap();
    let alone = droplet().with_surroundings(tube()).unwrap().observe().unwrap().velocity;
    let far = droplet().with_position([0.2, 0.0, 15.0]).unwrap();
    let mut two = SpaceDroplets::new(vec![droplet(), far]).unwrap().with_surroundings(tube()).unwrap();
    for k in 0..2 {
        let found = two.observe(k).unwrap().velocity;
        assert!((0..3).all(|i| (found[i] - alone[i]).abs() < 1e-9), "{found:?} {alone:?}");
    }
}

#[test]
fn droplets_that_do_not_fit_are_refused() {
    let droplet = || marangoni(6, [1.0, 1.0], [0.0, 0.0, 1.0], 1.0);
    let error = droplet().with_surroundings(Tube::new(0.9).unwrap()).unwrap_err().to_string();
    assert!(error.contains("crosses the wall of the tube of radius 0.9") && error.contains("wider tube"), "{error}");
    let moved = droplet().with_position([0.0, 1.0, 0.0]).unwrap();
    assert!(matches!(moved.with_surroundings(Tube::new(1.9).unwrap()), Err(SpaceError::Wall { .. })));
    for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(Tube::new(radius).is_err());
    }
    assert!(Tube::new(1.0).unwrap().along([0.0; 3]).is_err());
    assert!(Tube::new(1.0).unwrap().with_mean_flow(f64::NAN).is_err());
    let inside = droplet().with_surroundings(Tube::new(2.0).unwrap()).unwrap();
    assert!(SpaceDroplets::new(vec![inside]).unwrap_err().to_string().contains("surroundings of its own"));
    let sideways = droplet().with_surroundings(Tube::new(2.0).unwrap().along([1.0, 0.0, 0.0]).unwrap()).unwrap();
    assert!(SteadyState::find(sideways).unwrap_err().to_string().contains("not symmetric about the z axis"));
    // Nearly touching droplets either work or say that they are too close.
    for gap in [0.1, 0.01, 1e-4] {
        let mut close = droplet().with_surroundings(Tube::new(1.0 + gap).unwrap()).unwrap();
        match close.observe() {
            Ok(seen) => assert!(seen.velocity[2].is_finite() && seen.speed < 1.0 / 15.0),
            Err(error) => assert!(error.to_string().contains("too close to the wall"), "{error}"),
        }
    }
}

/// The straight swimmer of activity -2 in a tube of radius 1.5, against the axisymmetric code with 128 nodes
/// (docs/tables/steady-tubes.csv): speed .117620, rate .02103 + .1814 i of its lateral oscillation.
#[test]
fn steady_swimmers_have_the_speed_and_rates_of_the_axisymmetric_code() {
    let law = ContractileTension::thesis(10.0, -2.0, 4.0, 100.0).unwrap();
    let droplet = SpaceDroplet::sphere(10, 1.0, [100.0; 2], law).unwrap();
    let droplet = droplet.with_particles(0.1, |s| 100.0 * (1.0 + 0.9 * s[2])).unwrap();
    let tube = Tube::new(1.5).unwrap().with_tolerance(1e-6).unwrap();
    let mut state = SteadyState::find(droplet.with_surroundings(tube).unwrap()).unwrap();
    let speed = state.droplet_mut().observe().unwrap().speed;
    assert!((speed / 0.117620 - 1.0).abs() < 1e-3, "{speed}");
    let rate = state.growth_rates(1).unwrap()[0];
    assert!((rate - Complex64::new(0.02103, 0.1814)).norm() < 4e-3, "{rate}");
}

/// Spheres with a gradient of tension along the axis, against the axisymmetric code: velocities at their surfaces.
#[test]
fn flows_on_the_axis_are_those_of_the_axisymmetric_code() {
    let (count, radius) = (128, 1.6);
    let angle = |k: usize| TAU * k as f64 / count as f64;
    let sphere: Vec<Vec2> = (0..count).map(|k| Vec2::from_angle(angle(k))).collect();
    let tensions: Vec<f64> = (0..count).map(|k| 1.0 + 0.5 * angle(k).cos()).collect();
    let mut forces = vec![Vec2::ZERO; count];
    let mut calculus = MeridianCalculus::new(count).unwrap();
    calculus.tension_forces(&sphere, &tensions, TensionPlacement::Points, &mut forces).unwrap();
    for inside in [1.0, 5.0] {
        let settings = Settings { nodes: count, ..Settings::default() };
        let mut flow = AxisymmetricFlow::new(1.0, settings).unwrap().with_tube(radius).unwrap();
        flow.load([Interface::closed(&sphere, &forces, [inside, 1.0])].into_iter()).unwrap();
        flow.solve().unwrap();
        let mut exact = vec![Vec2::ZERO; count];
        flow.velocities(0, &mut exact).unwrap();
        let error = |degree: usize| {
            let droplet = marangoni(degree, [inside, 1.0], [0.0, 0.0, 1.0], 1.0);
            let mut droplet = droplet.with_surroundings(Tube::new(radius).unwrap()).unwrap();
            droplet.evaluate().unwrap();
            let difference = |k: usize| {
                let (sin, cos) = angle(k).sin_cos();
                let (_, velocity, _) = droplet.at([0.6 * sin, 0.8 * sin, cos]).unwrap();
                let across = 0.6 * velocity[0] + 0.8 * velocity[1];
                (velocity[2] - exact[k].x).abs().max((across - exact[k].y).abs())
            };
            (0..=count / 2).step_by(8).map(difference).fold(0.0, f64::max)
        };
        let degrees: &[usize] = if inside == 1.0 { &[6, 10, 16] } else { &[6, 10] };
        let errors: Vec<f64> = degrees.iter().map(|&degree| error(degree)).collect();
        assert!(errors[0] < 1e-5 && errors.windows(2).all(|pair| pair[1] < 0.1 * pair[0]), "{inside}: {errors:?}");
        assert!(errors.last().is_some_and(|error| *error < if inside == 1.0 { 1e-8 } else { 1e-7 }), "{errors:?}");
    }
}

/// Two spheres of viscosity ratios 10 and 0.1 on the axis, against the axisymmetric code: velocities at both surfaces.
#[test]
fn pairs_on_the_axis_flow_as_in_the_axisymmetric_code() {
    let (count, radius, places, ratios) = (96, 1.6, [-1.4, 1.4], [10.0, 0.1]);
    let angle = |k: usize| TAU * k as f64 / count as f64;
    let curves =
        places.map(|z| (0..count).map(|k| Vec2::new(z, 0.0) + Vec2::from_angle(angle(k))).collect::<Vec<Vec2>>());
    let tensions: Vec<f64> = (0..count).map(|k| 1.0 + 0.5 * angle(k).cos()).collect();
    let mut calculus = MeridianCalculus::new(count).unwrap();
    let forces = curves.each_ref().map(|curve| {
        let mut forces = vec![Vec2::ZERO; count];
        calculus.tension_forces(curve, &tensions, TensionPlacement::Points, &mut forces).unwrap();
        forces
    });
    let settings = Settings { nodes: count, ..Settings::default() };
    let mut flow = AxisymmetricFlow::new(1.0, settings).unwrap().with_tube(radius).unwrap();
    flow.load((0..2).map(|i| Interface::closed(&curves[i], &forces[i], [ratios[i], 1.0]))).unwrap();
    flow.solve().unwrap();
    let exact = [0, 1].map(|i| {
        let mut exact = vec![Vec2::ZERO; count];
        flow.velocities(i, &mut exact).unwrap();
        exact
    });
    let largest = exact.iter().flatten().map(|u| u.x.hypot(u.y)).fold(0.0, f64::max);
    let error = |degree: usize| {
        let drop = |i: usize| {
            marangoni(degree, [ratios[i], 1.0], [0.0, 0.0, 1.0], 1.0).with_position([0.0, 0.0, places[i]]).unwrap()
        };
        let pair = SpaceDroplets::new(vec![drop(0), drop(1)]).unwrap();
        let mut pair = pair.with_surroundings(Tube::new(radius).unwrap()).unwrap();
        pair.evaluate().unwrap();
        let difference = |i: usize, k: usize| {
            let (sin, cos) = angle(k).sin_cos();
            let (_, velocity, _) = pair.droplets()[i].at([0.6 * sin, 0.8 * sin, cos]).unwrap();
            let across = 0.6 * velocity[0] + 0.8 * velocity[1];
            (velocity[2] - exact[i][k].x).hypot(across - exact[i][k].y) / largest
        };
        (0..=count).step_by(8).map(|k| difference(k % 2, k / 2)).fold(0.0, f64::max)
    };
    let errors = [5, 8].map(error);
    // The flow in the gap of 0.8 falls by 2.3 for each degree.
    assert!(errors[1] < 0.1 * errors[0] && errors[1] < 2e-4, "{errors:?}");
}

/// A swimmer that oscillates nearly in a plane leaves it for a helix: of the two circular motions of the centroid, `z =
/// a exp(i w t) + b exp(-i w t)`, the larger one grows faster.
#[test]
#[ignore = "a run of ten seconds"]
fn lateral_oscillations_become_helices() {
    let frequency = 0.1814;
    let law = ContractileTension::thesis(10.0, -2.0, 4.0, 100.0).unwrap();
    let shape = |s: [f64; 3]| [1.02 * s[0], 1.02 * s[1], s[2] / (1.02 * 1.02)];
    let particles = |s: [f64; 3]| 100.0 * (1.0 + 0.9 * s[2] + 0.03 * s[0] + 0.04 * s[1]);
    let droplet = SpaceDroplet::shaped(8, shape, [100.0; 2], law).unwrap().with_particles(0.1, particles).unwrap();
    let droplet = droplet.with_edge_following(EdgeFollowing { strength: 1.5, time: 4.0 }).unwrap();
    let tube = Tube::new(1.5).unwrap().with_tolerance(1e-5).unwrap();
    let mut droplet = droplet.with_position([0.1, 0.02, 0.0]).unwrap().with_surroundings(tube).unwrap();
    let (mut parts, mut integrator) = (Vec::new(), RungeKuttaChebyshev::new());
    for sample in 1..=33 {
        let steps = StepSize::Adaptive { tolerance: 1e-2 };
        droplet.advance(2.0 * f64::from(sample), steps, &mut integrator, |_| {}).unwrap();
        let seen = droplet.observe().unwrap();
        let place = Complex64::new(seen.position[0], seen.position[1]);
        let turned = Complex64::new(seen.velocity[1], -seen.velocity[0]) / frequency;
        parts.push([0.25 * (place + turned).norm_sqr(), 0.25 * (place - turned).norm_sqr()]);
    }
    // Means over half a period, of 17.
    let mean = |end: usize, i: usize| parts[end - 9..end].iter().map(|pair| pair[i]).sum::<f64>() / 9.0;
    let sense = |end: usize| (mean(end, 1) - mean(end, 0)) / (mean(end, 1) + mean(end, 0));
    let growth = ((mean(33, 0) + mean(33, 1)) / (mean(17, 0) + mean(17, 1))).sqrt();
    assert!(growth > 1.4 && growth < 2.5, "{growth}");
    assert!(sense(17) > 0.6 && sense(33) > sense(17) + 0.04 && sense(33) < 1.0, "{} {}", sense(17), sense(33));
}
