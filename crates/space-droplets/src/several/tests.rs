use active_interface::{ConstantTension, ContractileTension, ExcludedVolume};
use motile_scene::integrator::{Midpoint, RungeKuttaChebyshev};
use stokes_axisymmetric::{AxisymmetricFlow, Interface, MeridianCalculus, Settings, TensionPlacement, Vec2};

use super::*;

/// A sphere whose tension grows along an axis; its flow outside is that of a dipole.
fn marangoni(degree: usize, axis: [f64; 3], position: [f64; 3]) -> SpaceDroplet {
    let law = ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0).unwrap();
    let droplet = SpaceDroplet::sphere(degree, 1.0, [1.0, 1.0], law).unwrap();
    droplet.with_particles(0.1, |s| 1.0 + dot(s, axis)).unwrap().with_position(position).unwrap()
}

/// With equal viscosities, a sphere moves with the mean of the flow over its volume. The dipole of the other is
/// harmonic, so the mean is the value at the centre, at any gap.
#[test]
fn two_marangoni_spheres_move_at_the_closed_form_at_any_gap() {
    let (first, second) = ([0.6, 0.0, 0.8], [0.0, -0.8, 0.6]);
    for gap in [3.0, 0.5, 0.1, 0.01, 0.001] {
        let direction = [2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0];
        let distance = 2.0 + gap;
        let place = direction.map(|x| distance * x);
        let droplets = vec![marangoni(14, first, [0.0; 3]), marangoni(14, second, place)];
        let mut pair = SpaceDroplets::new(droplets).unwrap();
        let speed = -1.0 / 15.0;
        for (k, (own, other)) in [(first, second), (second, first)].into_iter().enumerate() {
            let velocity = pair.observe(k).unwrap().velocity;
            for i in 0..3 {
                let dipole = (3.0 * direction[i] * dot(direction, other) - other[i]) / (2.0 * distance.powi(3));
                let error = velocity[i] - speed * (own[i] + dipole);
                assert!(error.abs() < 2e-9, "{gap} {k}: {error:e}");
            }
        }
        assert!((pair.gap(0, 1).unwrap() - gap).abs() < 0.05);
    }
}

/// Two deformed drops in general position: the power of the forces of each in the flow of the other is the same, up to
/// the flow in the gap that the degree leaves out.
#[test]
fn close_deformed_droplets_obey_the_reciprocal_theorem() {
    let error = |degree: usize| {
        let drop = |position: [f64; 3], turn: usize| {
            let law = ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0).unwrap();
            let shape = |s: [f64; 3]| [1.2 * s[turn % 3], s[(turn + 1) % 3], 0.9 * s[(turn + 2) % 3]];
            let droplet = SpaceDroplet::shaped(degree, shape, [1.0, 1.0], law).unwrap();
            let droplet = droplet.with_particles(0.1, |s| 1.0 + s[0] * s[1] - 0.3 * s[2]).unwrap();
            droplet.with_position(position).unwrap()
        };
        let mut pair = SpaceDroplets::new(vec![drop([0.0; 3], 0), drop([1.65, 1.55, 0.3], 1)]).unwrap();
        let gap = pair.gap(0, 1).unwrap();
        assert!(gap > 0.09 && gap < 0.13, "{gap}");
        let mut nodes = sphere_harmonics::Grid::gauss(degree).unwrap();
        let mut field = vec![0.0; nodes.coefficients()];
        let [a, b] = [0, 1].map(|k: usize| {
            let flow = &pair.droplets[k].flow;
            let mut power = 0.0;
            for (velocity, force) in flow.external.iter().zip(&flow.forces) {
                nodes.forward(velocity, &mut field).unwrap();
                power += field.iter().zip(force).map(|(u, f)| u * f).sum::<f64>();
            }
            power
        });
        (a / b - 1.0).abs()
    };
    let errors = [8, 12, 16].map(error);
    assert!(errors[2] < 0.05 * errors[0] && errors[2] < 1e-5, "{errors:?}");
}

/// A repulsion opens a gap, and leaves the centre of two equal drops where it is.
#[test]
fn repelled_droplets_separate_without_a_net_force() {
    let drop = |x: f64| {
        let law = ConstantTension::new(1.0).unwrap();
        SpaceDroplet::sphere(8, 1.0, [1.0, 1.0], law).unwrap().with_position([x, 0.1 * x, 0.0]).unwrap()
    };
    let pair = SpaceDroplets::new(vec![drop(-1.05), drop(1.05)]).unwrap();
    let mut pair = pair.with_repulsion(Repulsion::new(2.0, 0.4).unwrap());
    let before = pair.gap(0, 1).unwrap();
    let net = |pair: &SpaceDroplets, i: usize| pair.droplets.iter().map(|drop| drop.flow.forces[i][0]).sum::<f64>();
    let first = pair.droplets[0].flow.forces[0][0];
    assert!(first < -1e-3 && (0..3).all(|i| net(&pair, i).abs() < 1e-12 * first.abs()), "{first}");
    pair.advance(0.6, StepSize::Adaptive { tolerance: 1e-3 }, &mut RungeKuttaChebyshev::new(), |_| {}).unwrap();
    assert!(pair.gap(0, 1).unwrap() > before + 0.02);
    let [left, right] = [0, 1].map(|k| pair.observe(k).unwrap().position);
    assert!(left.iter().zip(right).all(|(left, right)| (left + right).abs() < 1e-4), "{left:?} {right:?}");
}

/// Two viscous spheres far apart: each moves with its own speed and the dipole of the other, up to what the second
/// reflection leaves out, of the order of the distance to the power -6.
#[test]
fn distant_viscous_spheres_move_in_the_dipole_of_each_other() {
    let axis = [0.6, 0.0, 0.8];
    let error = |distance: f64| {
        let drop = |ratio: f64, x: f64| {
            let law = ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0).unwrap();
            let droplet = SpaceDroplet::sphere(8, 1.0, [ratio, 1.0], law).unwrap();
            droplet.with_particles(0.1, |s| 1.0 + dot(s, axis)).unwrap().with_position([x, 0.0, 0.0]).unwrap()
        };
        let ratios = [10.0, 3.0];
        let mut pair = SpaceDroplets::new(vec![drop(ratios[0], 0.0), drop(ratios[1], distance)]).unwrap();
        let own = ratios.map(|ratio| -1.0 / (3.0 * (2.0 + 3.0 * ratio)));
        let velocity = pair.observe(0).unwrap().velocity;
        let dipole = |i: usize| (3.0 * if i == 0 { axis[0] } else { 0.0 } - axis[i]) / (2.0 * distance.powi(3));
        let square = |i: usize| (velocity[i] - own[0] * axis[i] - own[1] * dipole(i)).powi(2);
        (0..3).map(square).sum::<f64>().sqrt() / own[1].abs()
    };
    let errors = [4.0, 8.0].map(error);
    assert!(errors[0] < 1e-3 && errors[1] < errors[0] / 40.0, "{errors:?}");
}

/// Close viscous droplets: velocities converge exponentially with the degree, and a common rotation is a rotation.
#[test]
fn close_viscous_droplets_converge_with_the_degree() {
    let pair = |degree: usize, tension: f64, turn: f64| {
        let drop = |ratio: f64, position: [f64; 3]| {
            let law = ContractileTension::new(tension, -0.5 * tension, ExcludedVolume::None, 1.0).unwrap();
            let shape = |s: [f64; 3]| [1.1 * s[0], s[1], 0.9 * s[2]];
            let droplet = SpaceDroplet::shaped(degree, shape, [ratio, 1.0], law).unwrap();
            let droplet = droplet.with_particles(0.1, |s| 1.0 + s[1] - 0.3 * s[2] * s[0]).unwrap();
            let rotation = [[0.0, -turn, 0.0], [turn, 0.0, 0.0], [0.0; 3]];
            droplet.with_position(position).unwrap().with_imposed_flow(rotation).unwrap()
        };
        SpaceDroplets::new(vec![drop(5.0, [0.0; 3]), drop(0.2, [2.0, 0.9, 0.0])]).unwrap()
    };
    let velocity = |degree: usize| pair(degree, 1.0, 0.0).observe(0).unwrap().velocity;
    let [coarse, middle, fine] = [8, 12, 16].map(velocity);
    let difference = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
    let errors = [difference(coarse, fine), difference(middle, fine)];
    assert!(errors[1] < 0.2 * errors[0] && errors[1] < 1e-5, "{errors:?}");

    let turning = pair(12, 0.0, 0.5);
    for droplet in turning.droplets() {
        let (place, velocity, _) = droplet.at([0.6, 0.8, 0.0]).unwrap();
        let n = count(12);
        let place: [f64; 3] = std::array::from_fn(|i| place[i] + droplet.state[4 * n + i]);
        let exact = [-0.5 * place[1], 0.5 * place[0], 0.0];
        assert!(difference(velocity, exact) < 1e-6, "{velocity:?} {exact:?}");
    }
}

#[test]
fn droplets_that_overlap_or_are_in_different_fluids_are_refused() {
    let message = |droplets: Vec<SpaceDroplet>| SpaceDroplets::new(droplets).unwrap_err().to_string();
    let z = [0.0, 0.0, 1.0];
    assert!(message(Vec::new()).contains("0 droplets are too few"));
    let overlapping = message(vec![marangoni(4, z, [0.0; 3]), marangoni(4, z, [1.5, 0.0, 0.0])]);
    assert!(overlapping.contains("droplets 0 and 1 overlap"), "{overlapping}");
    let inside = message(vec![marangoni(6, z, [0.0; 3]), marangoni(6, z, [0.1, 0.0, 0.0])]);
    assert!(inside.contains("droplets 0 and 1 overlap"), "{inside}");
    let drop = |inside: f64, outside: f64, x: f64| {
        let law = ConstantTension::new(1.0).unwrap();
        let drop = SpaceDroplet::sphere(4, 1.0, [inside, outside], law).unwrap();
        drop.with_position([x, 0.0, 0.0]).unwrap()
    };
    assert!(message(vec![drop(1.0, 1.0, 0.0), drop(2.0, 2.0, 4.0)]).contains("another fluid"));
    let mut pair = SpaceDroplets::new(vec![drop(1.0, 1.0, 0.0), drop(1.0, 1.0, 4.0)]).unwrap();
    assert!(pair.observe(2).unwrap_err().to_string().contains("There are 2"));
    assert!(pair.gap(1, 1).is_err());
}

/// Droplets that meet within a step, at a stage of the integrator, and one that meets a wall there.
#[test]
fn overlaps_within_a_step_name_the_droplets_and_keep_the_state() {
    // A droplet moves against the gradient of its tension, at 1/15.
    let droplets = vec![marangoni(6, [-1.0, 0.0, 0.0], [0.0; 3]), marangoni(6, [1.0, 0.0, 0.0], [2.05, 0.0, 0.0])];
    let mut pair = SpaceDroplets::new(droplets).unwrap();
    let before: Vec<Vec<f64>> = pair.droplets.iter().map(|droplet| droplet.state.clone()).collect();
    let error = pair.advance(8.0, StepSize::Fixed(4.0), &mut Midpoint::default(), |_| {}).unwrap_err();
    assert!(matches!(error, SpaceError::Overlap { time: 0.0, first: 0, second: 1 }), "{error:?}");
    assert!(pair.time() == 0.0 && pair.droplets.iter().zip(&before).all(|(droplet, state)| droplet.state == *state));
    let speed = pair.observe(0).unwrap().velocity[0];
    assert!(speed > 0.0 && pair.observe(1).unwrap().velocity[0] < 0.0, "{speed}");
    let slit = crate::Slit::new(-1.3, 1.3).unwrap();
    let mut drop = marangoni(6, [0.0, 0.0, -1.0], [0.0; 3]).with_surroundings(slit).unwrap();
    let before = drop.state.clone();
    let error = drop.advance(60.0, StepSize::Fixed(30.0), &mut Midpoint::default(), |_| {}).unwrap_err();
    assert!(matches!(error, SpaceError::Wall { time: 0.0, droplet: 0, .. }), "{error:?}");
    assert!(drop.state == before && drop.observe().unwrap().velocity[2] > 0.0);
}

/// Two droplets of different viscosities close to each other, with a repulsion.
fn close_pair(degree: usize, ratios: [f64; 2], gap: f64) -> SpaceDroplets {
    let drop = |ratio: f64, x: f64| {
        let law = ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0).unwrap();
        let droplet = SpaceDroplet::sphere(degree, 1.0, [ratio, 1.0], law).unwrap();
        droplet.with_particles(0.1, |s| 1.0 + s[1] - 0.3 * s[2] * s[0]).unwrap().with_position([x, 0.1, 0.0]).unwrap()
    };
    SpaceDroplets::new(vec![drop(ratios[0], 0.0), drop(ratios[1], 2.0 + gap)]).unwrap()
}

#[test]
fn evaluations_in_steady_state_do_not_allocate() {
    in_pool(|| {
        for ratios in [[1.0, 1.0], [5.0, 0.2]] {
            let mut pair = close_pair(6, ratios, 0.1).with_repulsion(Repulsion::new(2.0, 0.4).unwrap());
            pair.evaluate().unwrap();
            pair.known = false;
            let counted = allocation_counter::measure(|| pair.evaluate().unwrap());
            assert_eq!(counted.count_total, 0, "{ratios:?}");
        }
    });
}

/// Calls a function on a thread of a pool, whose queue for other threads would allocate now and then.
#[cfg(feature = "rayon")]
fn in_pool(work: impl FnOnce() + Send) {
    rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(work);
}

#[cfg(not(feature = "rayon"))]
fn in_pool(work: impl FnOnce()) {
    work();
}

#[test]
fn evaluations_in_surroundings_do_not_allocate() {
    in_pool(count_allocations_in_surroundings);
}

fn count_allocations_in_surroundings() {
    let surroundings: [fn(SpaceDroplets) -> SpaceDroplets; 3] = [
        |pair| pair.with_surroundings(crate::Slit::new(-1.8, 2.0).unwrap()).unwrap(),
        |pair| pair.with_surroundings(crate::Tube::new(1.9).unwrap().along([1.0, 0.0, 0.0]).unwrap()).unwrap(),
        |pair| pair.with_surroundings(crate::PeriodicBox::new([5.0, 3.0, 3.0]).unwrap()).unwrap(),
    ];
    for (k, surround) in surroundings.into_iter().enumerate() {
        for ratios in [[1.0, 1.0], [5.0, 0.2]] {
            let mut pair = surround(close_pair(6, ratios, 0.1).with_repulsion(Repulsion::new(2.0, 0.4).unwrap()));
            for _ in 0..2 {
                pair.known = false;
                pair.evaluate().unwrap();
            }
            pair.known = false;
            let counted = allocation_counter::measure(|| pair.evaluate().unwrap());
            assert_eq!(counted.count_total, 0, "{k}: {ratios:?}");
        }
    }
}

#[cfg(feature = "rayon")]
#[test]
fn results_of_several_droplets_do_not_depend_on_the_number_of_threads() {
    let rates = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let pair = close_pair(6, [5.0, 0.2], 0.1);
            let mut pair = pair.with_repulsion(Repulsion::new(2.0, 0.4).unwrap());
            pair.evaluate().unwrap();
            pair.droplets.iter().flat_map(|droplet| droplet.flow.rates.clone()).collect::<Vec<f64>>()
        })
    };
    assert_eq!(rates(1), rates(3));
}

/// Extreme ratios of the viscosities with a narrow gap, and very low and high degrees.
#[test]
fn extreme_droplets_are_computed_or_refused_in_words() {
    for ratios in [[1e2, 1e-2], [1e-2, 1e-2], [1e2, 1e2]] {
        let velocities = [8, 12].map(|degree| {
            let mut pair = close_pair(degree, ratios, 0.02);
            [pair.observe(0).unwrap().velocity, pair.observe(1).unwrap().velocity]
        });
        let norm = velocities[1].iter().flatten().map(|v| v * v).sum::<f64>().sqrt();
        let change: f64 = (0..6).map(|i| (velocities[0][i / 3][i % 3] - velocities[1][i / 3][i % 3]).powi(2)).sum();
        assert!(change.sqrt() < 0.05 * norm, "{ratios:?}: {velocities:?}");
    }
    let mut coarse = close_pair(4, [1.0, 1.0], 0.01);
    assert!(coarse.observe(0).unwrap().speed.is_finite());
}

/// Swimmers from noise at a very low degree: the run ends and conserves particles.
#[test]
fn droplets_start_from_noise() {
    let drop = |x: f64| {
        let law = ContractileTension::thesis(10.0, -2.0, 4.0, 100.0).unwrap();
        let droplet = SpaceDroplet::sphere(4, 1.0, [100.0, 100.0], law).unwrap();
        let noise = |s: [f64; 3]| (37.0 * s[0] + 11.0 * s[1] * x).sin() + (53.0 * s[2] - 5.0 * s[0]).cos();
        let droplet = droplet.with_particles(0.1, |s| 100.0 * (1.0 + 0.2 * noise(s))).unwrap();
        droplet.with_position([x, 0.0, 0.0]).unwrap()
    };
    let mut pair = SpaceDroplets::new(vec![drop(-1.2), drop(1.2)]).unwrap();
    let before = pair.observe(0).unwrap().particles;
    pair.advance(1.0, StepSize::Adaptive { tolerance: 1e-2 }, &mut RungeKuttaChebyshev::new(), |_| {}).unwrap();
    let after = pair.observe(0).unwrap();
    assert!((after.particles / before - 1.0).abs() < 1e-12 && after.speed.is_finite());
}

/// Two spheroids of different viscosities that face each other on an axis, against the axisymmetric code: velocities at
/// the surface of the first one.
#[test]
fn droplets_on_one_axis_flow_as_in_the_axisymmetric_code() {
    let (count, gap) = (160, 0.2);
    let distance = 2.2 + gap;
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / count as f64;
    let viscosities = [[5.0, 1.0], [0.5, 1.0]];
    // Particles gather on the sides that face away from the other.
    let places = [0.0, distance];
    let signs = [-1.0, 1.0];
    let curve = |x: f64| -> Vec<Vec2> {
        (0..count).map(|k| Vec2::new(x + 1.1 * angle(k).cos(), 0.95 * angle(k).sin())).collect()
    };
    let curves = places.map(curve);
    let mut calculus = MeridianCalculus::new(count).unwrap();
    let forces: Vec<Vec<Vec2>> = (0..2)
        .map(|i| {
            let tensions: Vec<f64> = (0..count).map(|k| 1.5 + 0.5 * signs[i] * angle(k).cos()).collect();
            let mut forces = vec![Vec2::ZERO; count];
            calculus.tension_forces(&curves[i], &tensions, TensionPlacement::Points, &mut forces).unwrap();
            forces
        })
        .collect();
    let mut flow = AxisymmetricFlow::new(1.0, Settings { nodes: count, ..Settings::default() }).unwrap();
    flow.load((0..2).map(|i| Interface::closed(&curves[i], &forces[i], viscosities[i]))).unwrap();
    flow.solve().unwrap();
    let mut exact = vec![Vec2::ZERO; count];
    flow.velocities(0, &mut exact).unwrap();
    let largest = exact.iter().map(|u| u.x.hypot(u.y)).fold(0.0, f64::max);
    let error = |degree: usize| {
        let drop = |i: usize| {
            let law = ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0).unwrap();
            let shape = |s: [f64; 3]| [0.95 * s[0], 0.95 * s[1], 1.1 * s[2]];
            let drop = SpaceDroplet::shaped(degree, shape, viscosities[i], law).unwrap();
            let drop = drop.with_particles(0.1, |s| 1.0 + signs[i] * s[2]).unwrap();
            drop.with_position([0.0, 0.0, places[i]]).unwrap()
        };
        let mut pair = SpaceDroplets::new(vec![drop(0), drop(1)]).unwrap();
        pair.evaluate().unwrap();
        let difference = |k: usize| {
            let (sin, cos) = angle(k).sin_cos();
            let (_, velocity, _) = pair.droplets()[0].at([0.6 * sin, 0.8 * sin, cos]).unwrap();
            let across = 0.6 * velocity[0] + 0.8 * velocity[1];
            (velocity[2] - exact[k].x).hypot(across - exact[k].y) / largest
        };
        (0..=count / 2).step_by(8).map(difference).fold(0.0, f64::max)
    };
    let errors = [6, 10, 14].map(error);
    assert!(errors.windows(2).all(|pair| pair[1] < 0.2 * pair[0]) && errors[2] < 2e-4, "{errors:?}");
}

/// Two swimmers that pass each other, and the same ones turned in space: their paths and headings turn with them, up to
/// an error of the degree.
#[test]
fn encounters_do_not_depend_on_the_axes() {
    let turned = [[0.8, 0.0, 0.6], [0.36, 0.8, -0.48], [-0.48, 0.6, 0.64]];
    let plain = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let ends = |degree: usize, axes: [[f64; 3]; 3]| {
        let turn = |v: [f64; 3]| -> [f64; 3] { std::array::from_fn(|i| (0..3).map(|j| v[j] * axes[j][i]).sum()) };
        let drop = |place: [f64; 3], rear: [f64; 3]| {
            let law = ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0).unwrap();
            let droplet = SpaceDroplet::sphere(degree, 1.0, [1.0, 1.0], law).unwrap();
            let rear = turn(rear);
            let droplet = droplet.with_particles(0.5, |s| 1.0 + 0.8 * dot(s, rear)).unwrap();
            droplet.with_position(turn(place)).unwrap()
        };
        let droplets = vec![drop([-1.2, 0.0, 0.4], [-1.0, 0.0, 0.0]), drop([1.2, 0.0, -0.4], [1.0, 0.0, 0.0])];
        let mut pair = SpaceDroplets::new(droplets).unwrap();
        pair.advance(1.0, StepSize::Fixed(0.1), &mut Midpoint::default(), |_| {}).unwrap();
        let seen = [0, 1].map(|k| pair.observe(k).unwrap());
        seen.map(|seen| [seen.position, seen.velocity].map(|vector| axes.map(|axis| dot(axis, vector))))
    };
    let error = |degree: usize| {
        let (exact, found) = (ends(degree, plain), ends(degree, turned));
        let pairs = exact.iter().flatten().flatten().zip(found.iter().flatten().flatten());
        pairs.map(|(exact, found)| (exact - found).abs()).fold(0.0, f64::max)
    };
    let errors = [error(6), error(10)];
    assert!(errors[1] < 0.2 * errors[0] && errors[1] < 1e-5, "{errors:?}");
}
