use std::f64::consts::PI;

use proptest::prelude::*;

use super::*;
use motile_scene::Body;

const COUNT: usize = 24;

/// Nodes of a wavy line of length about 1, or of a deformed circle.
fn line(waves: [f64; 4], closed: bool) -> Vec<Vec2> {
    let at = |k: usize| {
        let s = k as f64 / COUNT as f64;
        let turn = 2.0 * PI * s;
        let ripple = waves[0] * (2.0 * turn).sin() + waves[1] * (3.0 * turn).cos();
        let other = waves[2] * turn.cos() + waves[3] * (2.0 * turn).cos();
        let base = if closed { 0.3 * Vec2::from_angle(turn) } else { Vec2::new(s, 0.0) };
        base + Vec2::new(0.2 * ripple, other)
    };
    (0..COUNT).map(at).collect()
}

fn energy(fibre: &Fibre) -> f64 {
    let loads: f64 = fibre.loads.iter().map(|(node, force)| force.dot(fibre.nodes[*node])).sum();
    fibre.energies().iter().sum::<f64>() - loads
}

proptest! {
    #[test]
    fn forces_are_minus_the_gradient_of_the_energy(
        rest in prop::array::uniform4(-0.03..0.03_f64),
        now in prop::array::uniform4(-0.05..0.05_f64),
        kind in 0..4_usize,
    ) {
        let closed = kind == 1;
        let nodes = line(rest, closed);
        let fibre = match kind {
            1 => Fibre::closed(&nodes, 3.0, 0.07),
            2 => Fibre::periodic(&nodes, Vec2::new(1.0, 0.1), 3.0, 0.07),
            _ => Fibre::new(&nodes, 3.0, 0.07),
        };
        let mut fibre = fibre.unwrap();
        if kind == 3 {
            let moving = FibreWave { amplitude: Vec2::new(0.1, 0.2), wave_number: 3.0, frequency: 2.0, phase: 0.3 };
            let target = Target { wave: Some(moving), velocity: Vec2::X, ..Target::fixed(5, Vec2::Y, 0.8) };
            let wave = FibreWave { amplitude: 2.0, wave_number: 5.0, frequency: 3.0, phase: 0.1 };
            fibre = fibre.with_ends([FibreEnd::Clamped; 2]).unwrap();
            fibre = fibre.with_targets([target]).unwrap().with_load(7, Vec2::new(0.2, -0.4)).unwrap();
            fibre = fibre.with_curvature_wave(wave).unwrap();
            fibre.set_time(0.7);
        }
        let points = line(now, closed);
        let fibre = fibre.deformed(&points).unwrap();
        let forces = fibre.node_forces();
        let size: f64 = forces.iter().map(|f| f.length()).sum();
        if kind < 2 {
            let total: Vec2 = forces.iter().sum();
            let torque: f64 = points.iter().zip(&forces).map(|(x, f)| x.perp_dot(*f)).sum();
            prop_assert!(total.length() < 1e-13 * size && torque.abs() < 1e-13 * size, "{total} {torque} {size}");
        }
        let direction: Vec<Vec2> = (0..COUNT).map(|k| Vec2::from_angle((k * k) as f64)).collect();
        let moved = |step: f64| {
            let moved: Vec<Vec2> = points.iter().zip(&direction).map(|(x, d)| *x + step * *d).collect();
            energy(&fibre.clone().deformed(&moved).unwrap())
        };
        // Central differences of sixth order.
        let step = 2e-4;
        let pair = |k: f64| moved(k * step) - moved(-k * step);
        let slope = (45.0 * pair(1.0) - 9.0 * pair(2.0) + pair(3.0)) / (60.0 * step);
        let exact: f64 = forces.iter().zip(&direction).map(|(f, d)| f.dot(*d)).sum();
        prop_assert!((slope + exact).abs() < 1e-8 * size, "{slope} {exact} {size}");
    }
}

/// Solves a linear system by elimination.
fn solve(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    let count = right.len();
    for column in 0..count {
        let largest = |a: &usize, b: &usize| matrix[*a][column].abs().total_cmp(&matrix[*b][column].abs());
        let pivot = (column..count).max_by(largest).unwrap();
        matrix.swap(column, pivot);
        right.swap(column, pivot);
        let top = matrix[column].clone();
        for row in column + 1..count {
            let factor = matrix[row][column] / top[column];
            if factor != 0.0 {
                matrix[row].iter_mut().zip(&top).skip(column).for_each(|(value, top)| *value -= factor * top);
                right[row] -= factor * right[column];
            }
        }
    }
    for row in (0..count).rev() {
        let rest: f64 = (row + 1..count).map(|k| matrix[row][k] * right[k]).sum();
        right[row] = (right[row] - rest) / matrix[row][row];
    }
    right
}

/// Moves the nodes of a fibre with a held first node to equilibrium, by Newton's method.
fn to_equilibrium(mut fibre: Fibre) -> Fibre {
    let free = 2 * (fibre.nodes.len() - 1);
    let forces_at = |fibre: &Fibre, state: &[f64]| {
        let mut nodes = fibre.nodes.clone();
        motile_scene::points::read(state, &mut nodes[1..]).unwrap();
        let mut forces = vec![Vec2::ZERO; nodes.len()];
        fibre.add_forces(&nodes, &mut forces);
        forces[1..].iter().flat_map(|force| force.to_array()).collect::<Vec<f64>>()
    };
    for _ in 0..40 {
        let mut state = vec![0.0; free];
        motile_scene::points::write(&fibre.nodes[1..], &mut state);
        let residual = forces_at(&fibre, &state);
        let step = 1e-6;
        let mut columns = Vec::new();
        for k in 0..free {
            let shifted = |by: f64| {
                let mut state = state.clone();
                state[k] += by;
                forces_at(&fibre, &state)
            };
            let pairs = shifted(step).into_iter().zip(shifted(-step));
            columns.push(pairs.map(|(a, b)| (a - b) / (2.0 * step)).collect::<Vec<f64>>());
        }
        let matrix = (0..free).map(|row| columns.iter().map(|column| column[row]).collect()).collect();
        let change = solve(matrix, residual);
        let size = change.iter().fold(0.0_f64, |most, c| most.max(c.abs()));
        let factor = (0.5 * fibre.elasticity.lengths[0] / size).min(1.0);
        state.iter_mut().zip(&change).for_each(|(x, c)| *x -= factor * c);
        motile_scene::points::read(&state, &mut fibre.nodes[1..]).unwrap();
        if size < 1e-11 {
            return fibre;
        }
    }
    panic!("no equilibrium")
}

/// Returns the tip of a clamped beam of length 1 along x under an end force across it, by the discrete fibre.
fn tip(segments: usize, force: f64) -> Vec2 {
    let nodes: Vec<Vec2> = (0..=segments).map(|k| Vec2::new(k as f64 / segments as f64, 0.0)).collect();
    let beam = Fibre::new(&nodes, 1e6, 1.0).unwrap().with_ends([FibreEnd::Clamped, FibreEnd::Free]).unwrap();
    let mut beam = beam;
    // In parts, so that Newton's method stays near the solution.
    for _ in 0..4 {
        beam = to_equilibrium(beam.with_load(segments, Vec2::new(0.0, 0.25 * force)).unwrap());
    }
    let held = beam.node_forces()[0];
    assert!((held - Vec2::new(0.0, force)).length() < 1e-5 * force, "the clamp takes up the load: {held}");
    let torque = beam.elasticity.clamp_torque(&beam.nodes, 0, |_| 0.0);
    assert!((torque / (beam.nodes[segments].x * force) - 1.0).abs() < 1e-5, "{torque}");
    beam.nodes[segments]
}

/// Returns the tip of an inextensible beam by its ordinary differential equation `theta'' = -F cos(theta)`, with
/// `theta(0) = 0` and `theta'(1) = 0`, integrated with Runge and Kutta's method after shooting.
fn elastica(force: f64) -> Vec2 {
    let shoot = |start: f64| {
        let steps = 2000;
        let dt = 1.0 / f64::from(steps);
        let slope = |[_, _, theta, curvature]: [f64; 4]| [theta.cos(), theta.sin(), curvature, -force * theta.cos()];
        let mut y = [0.0, 0.0, 0.0, start];
        let ahead = |y: [f64; 4], k: [f64; 4], by: f64| std::array::from_fn(|i| y[i] + by * k[i]);
        for _ in 0..steps {
            let a = slope(y);
            let b = slope(ahead(y, a, 0.5 * dt));
            let c = slope(ahead(y, b, 0.5 * dt));
            let d = slope(ahead(y, c, dt));
            y = std::array::from_fn(|i| y[i] + dt / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
        }
        y
    };
    let (mut low, mut high) = (0.0, force);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if shoot(middle)[3] < 0.0 { low = middle } else { high = middle }
    }
    let [x, y, ..] = shoot(low);
    Vec2::new(x, y)
}

#[test]
fn a_cantilever_bends_as_the_elastica_to_second_order() {
    // Small forces: Euler and Bernoulli.
    let small = 1e-3;
    assert!((elastica(small).y / (small / 3.0) - 1.0).abs() < 1e-6);
    for force in [small, 5.0] {
        let exact = elastica(force);
        let errors = [10, 20].map(|segments| tip(segments, force).distance(exact));
        let order = (errors[0] / errors[1]).log2();
        assert!(errors[1] < 2e-3 * exact.y, "{errors:?}");
        assert!((order - 2.0).abs() < 0.1, "{errors:?} {order}");
    }
}

#[test]
fn an_unstressed_fibre_has_no_forces() {
    for (ends, closed) in [(FibreEnd::Free, true), (FibreEnd::Clamped, false), (FibreEnd::Pinned, false)] {
        let nodes: Vec<Vec2> = (0..40).map(|k| 0.5 * Vec2::from_angle(2.0 * PI * f64::from(k) / 40.0)).collect();
        let fibre = if closed { Fibre::closed(&nodes, 3.0, 0.7) } else { Fibre::new(&nodes[..20], 3.0, 0.7) };
        let fibre = fibre.unwrap().with_ends([ends; 2]).unwrap();
        assert!(fibre.energies().iter().sum::<f64>() < 1e-25, "{ends:?} {:?}", fibre.energies());
        assert!(fibre.node_forces().iter().all(|force| force.length() < 1e-10));
        let straight = fibre.with_reference_curvature(0.0).unwrap();
        // Each node turns by as much; a clamp by half of it over half of the length.
        let (turn, hinges) = (2.0 * PI / 40.0, if closed { 40 } else { 18 + i32::from(ends == FibreEnd::Clamped) });
        let exact = 0.5 * 0.7 * turn * turn / (2.0 * 0.5 * (0.5 * turn).sin()) * f64::from(hinges);
        assert!((straight.energies()[1] / exact - 1.0).abs() < 1e-12, "{:?} {exact}", straight.energies());
    }
}

#[test]
fn what_is_no_fibre_is_refused() {
    let nodes = line([0.0; 4], false);
    let says = |result: Result<Fibre, SolidError>, words: &str| {
        let text = result.unwrap_err().to_string();
        assert!(text.contains(words), "{text}");
    };
    says(Fibre::new(&nodes[..2], 1.0, 1.0), "the nodes of a fibre");
    says(Fibre::new(&[Vec2::X, Vec2::Y, Vec2::Y, Vec2::ZERO], 1.0, 1.0), "the nodes 1 and 2 of a fibre coincide");
    says(Fibre::closed(&[Vec2::X, Vec2::Y, Vec2::X], 1.0, 1.0), "the nodes 2 and 0 of a fibre coincide");
    says(Fibre::new(&[Vec2::X, Vec2::NAN, Vec2::ZERO], 1.0, 1.0), "the nodes of a fibre");
    says(Fibre::new(&nodes, -1.0, 1.0), "the stretching modulus");
    says(Fibre::new(&nodes, 1.0, f64::NAN), "the bending modulus");
    let fibre = || Fibre::new(&nodes, 1.0, 1.0).unwrap();
    says(fibre().with_targets([Target::fixed(99, Vec2::X, 1.0)]), "node 99 of fibre, which does not exist");
    says(fibre().with_targets([Target::fixed(1, Vec2::X, -1.0)]), "the stiffness of a target");
    says(fibre().with_load(3, Vec2::NAN), "the load");
    says(fibre().with_rest_lengths(&[1.0]), "the lengths at rest");
    says(fibre().with_rest_length(0.0), "the length at rest");
    says(fibre().with_reference_curvature(f64::INFINITY), "the curvatures at rest");
    says(fibre().deformed(&nodes[1..]), "the nodes of a fibre");
    let ring = Fibre::closed(&line([0.0; 4], true), 1.0, 1.0).unwrap();
    says(ring.with_ends([FibreEnd::Pinned, FibreEnd::Free]), "no ends that can be held");
    let wave = FibreWave { amplitude: f64::NAN, wave_number: 1.0, frequency: 1.0, phase: 0.0 };
    says(fibre().with_curvature_wave(wave), "the amplitude of the wave");
}
