//! Viscosity that varies: against one viscosity, exact solutions, and its own residual.

use crate::common::refused;
use std::f64::consts::TAU;

use motile_base::{Drive, InputError};
use stokes_grid::{
    CentreField, ChannelStokes, Grid, NodeField, PeriodicStokes, StaggeredField, StokesError, StokesSolver,
    TwoPhaseStokes, WallMotion, divergence,
};

const SPACINGS: [usize; 3] = [32, 64, 128];

/// A flow with a viscosity and a pressure: functions of (x, y).
struct Flow {
    velocity: fn(f64, f64) -> [f64; 2],
    viscosity: fn(f64, f64) -> f64,
    pressure: fn(f64, f64) -> f64,
}

/// Central differences of smooth functions, good to ten digits: enough for errors of 1e-5.
fn slope(f: impl Fn(f64) -> f64) -> f64 {
    let e = 1e-3;
    (8.0 * (f(e) - f(-e)) - (f(2.0 * e) - f(-2.0 * e))) / (12.0 * e)
}

impl Flow {
    /// Components xx, xy and yy of `2 eta D - p`.
    fn stress(&self, x: f64, y: f64) -> [f64; 3] {
        let dx = |c: usize| slope(|e| (self.velocity)(x + e, y)[c]);
        let dy = |c: usize| slope(|e| (self.velocity)(x, y + e)[c]);
        let (eta, p) = ((self.viscosity)(x, y), (self.pressure)(x, y));
        [2.0 * eta * dx(0) - p, eta * (dy(0) + dx(1)), 2.0 * eta * dy(1) - p]
    }

    fn force(&self, x: f64, y: f64) -> [f64; 2] {
        let dx = |c: usize| slope(|e| self.stress(x + e, y)[c]);
        let dy = |c: usize| slope(|e| self.stress(x, y + e)[c]);
        [-dx(0) - dy(1), -dx(1) - dy(2)]
    }

    fn fill(&self, grid: &Grid, value: impl Fn(f64, f64) -> [f64; 2]) -> StaggeredField {
        let (nx, h) = (grid.nx(), grid.spacing());
        let mut field = StaggeredField::zeros(*grid);
        let (x, y) = field.components_mut();
        for (k, x) in x.iter_mut().enumerate() {
            *x = value((k % nx) as f64 * h, ((k / nx) as f64 + 0.5) * h)[0];
        }
        for (k, y) in y.iter_mut().enumerate() {
            *y = value(((k % nx) as f64 + 0.5) * h, (k / nx) as f64 * h)[1];
        }
        field
    }

    /// Largest errors of velocity and pressure.
    fn errors<S: StokesSolver>(&self, solver: S) -> [f64; 2] {
        let grid = *solver.grid();
        let mut flow = TwoPhaseStokes::new(solver).unwrap().with_tolerance(1e-10).unwrap();
        flow.set_viscosity(self.viscosity).unwrap();
        let force = self.fill(&grid, |x, y| self.force(x, y));
        let mut velocity = StaggeredField::zeros(grid);
        flow.solve(&force, &mut velocity).unwrap();
        let exact = self.fill(&grid, self.velocity);
        let pairs = velocity.x().iter().zip(exact.x()).chain(velocity.y().iter().zip(exact.y()));
        let error = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let mut pressure = CentreField::zeros(grid);
        flow.pressure(&force, &velocity, &mut pressure).unwrap();
        let (nx, h) = (grid.nx(), grid.spacing());
        let differences: Vec<f64> = pressure
            .values()
            .iter()
            .enumerate()
            .map(|(k, p)| p - (self.pressure)(((k % nx) as f64 + 0.5) * h, ((k / nx) as f64 + 0.5) * h))
            .collect();
        let mean = differences.iter().sum::<f64>() / differences.len() as f64;
        [error, differences.iter().map(|d| (d - mean).abs()).fold(0.0, f64::max)]
    }
}

/// Ratio e^4.6 = 100 of the viscosities.
const BOX: Flow = Flow {
    velocity: |x, y| {
        let (sx, cx, sy, cy) = ((TAU * x).sin(), (TAU * x).cos(), (TAU * y).sin(), (TAU * y).cos());
        [sx * cy - 2.0 * (2.0 * TAU * y).sin(), -cx * sy]
    },
    viscosity: |x, y| (2.3 * (TAU * x).sin() * (TAU * y).cos()).exp(),
    pressure: |x, y| (TAU * x).cos() * (TAU * y).sin(),
};

/// Between y = 0 and 1, from psi = y^2 (1-y)^2 (2 + sin kx), in a stratified fluid.
const CHANNEL: Flow = Flow {
    velocity: |x, y| {
        let (shape, slope) = (y * y * (1.0 - y) * (1.0 - y), 2.0 * y * (1.0 - y) * (1.0 - 2.0 * y));
        [slope * (2.0 + (TAU * x).sin()), -shape * TAU * (TAU * x).cos()]
    },
    viscosity: |x, y| (3.0 * (y - 0.5) + 0.8 * (TAU * x).cos()).exp(),
    pressure: |x, y| (TAU * x).sin() * y.exp(),
};

#[test]
fn second_order_where_the_viscosity_varies_smoothly() {
    let found = SPACINGS.map(|n| {
        let grid = Grid::periodic(n, n, 1.0 / n as f64).unwrap().with_origin([0.0; 2]).unwrap();
        BOX.errors(PeriodicStokes::new(grid, 1.0).unwrap())
    });
    let between = SPACINGS.map(|n| {
        let grid = Grid::channel(n, n, 1.0 / n as f64).unwrap().with_origin([0.0; 2]).unwrap();
        CHANNEL.errors(ChannelStokes::new(grid, 2.0).unwrap())
    });
    for errors in [found, between] {
        for quantity in 0..2 {
            let order = (errors[1][quantity] / errors[2][quantity]).log2();
            assert!(order > 1.85, "{quantity}: order {order} of {errors:?}");
        }
        assert!(errors[2][0] < 3e-3, "{errors:?}");
    }
}

/// A force that is smooth on every grid: the number of iterations can be compared.
fn droplet_iterations<S: StokesSolver>(solver: S, ratio: f64, tolerance: f64) -> (usize, f64) {
    let grid = *solver.grid();
    let h = 1.0 / 16.0;
    let mut flow = TwoPhaseStokes::new(solver).unwrap().with_tolerance(tolerance).unwrap();
    let indicator = |x: f64, y: f64| 0.5 * (1.0 + ((1.0 - (x - 2.0).hypot(y - 2.0)) / (0.5 * h)).tanh());
    flow.set_viscosity(|x, y| 1.0 + (ratio - 1.0) * indicator(x, y)).unwrap();
    let ring = |x: f64, y: f64| (-(((x - 2.0).hypot(y - 2.0) - 1.0) / 0.2).powi(2)).exp();
    let force = BOX.fill(&grid, |x, y| [ring(x, y) * (y - 2.0), ring(x, y) * (x - 2.0) * (y - 1.0)]);
    let mut velocity = StaggeredField::zeros(grid);
    let before = flow.work().forward_transforms;
    let report = flow.solve(&force, &mut velocity).unwrap();
    assert_eq!(report.iterations + 1, flow.history().len());
    // A solution of the flow of one viscosity for the first residual, for each iteration and for the last residual.
    assert_eq!(flow.work().forward_transforms - before, report.iterations + 2);
    let mut rate = CentreField::zeros(grid);
    divergence(&velocity, &mut rate).unwrap();
    assert!(rate.values().iter().all(|d| d.abs() < 1e-11));
    (report.iterations, report.residual)
}

#[test]
fn the_number_of_iterations_does_not_depend_on_the_grid() {
    for ratio in [10.0, 100.0, 1000.0] {
        for tolerance in [1e-4, 1e-6, 1e-8] {
            let counts = [64, 128, 256].map(|n| {
                let grid = Grid::periodic(n, n, 4.0 / n as f64).unwrap().with_origin([0.0; 2]).unwrap();
                let (iterations, residual) =
                    droplet_iterations(PeriodicStokes::new(grid, 1.0).unwrap(), ratio, tolerance);
                assert!(residual <= 1.1 * tolerance);
                iterations
            });
            println!("ratio {ratio}, tolerance {tolerance:e}: {counts:?} iterations");
            // On the coarsest grid the layer where the viscosity changes is as thin as a cell.
            assert!(counts[2] as f64 <= 1.1 * counts[1] as f64, "{ratio} {tolerance}: {counts:?}");
            assert!(counts[2] as f64 <= 12.0 * ratio.sqrt(), "{ratio} {tolerance}: {counts:?}");
        }
    }
}

#[test]
fn a_uniform_viscosity_takes_one_iteration() {
    let periodic = Grid::periodic(24, 20, 0.1).unwrap();
    let channel = Grid::channel(24, 20, 0.1).unwrap();
    let driven = |drive, moves: bool, viscosity| {
        let mut solver = ChannelStokes::new(channel, viscosity).unwrap();
        solver.set_drive(drive).unwrap();
        if moves {
            solver.set_walls(WallMotion::from_fn(&channel, |x| 0.2 + x.cos(), |_| -0.4).unwrap()).unwrap();
        }
        Box::new(solver) as Box<dyn StokesSolver>
    };
    let solver = |kind: usize, viscosity| match kind {
        0 => Box::new(PeriodicStokes::new(periodic, viscosity).unwrap()),
        1 => driven(Drive::ZeroGradient, false, viscosity),
        2 => driven(Drive::Gradient(-0.3), true, viscosity),
        3 => driven(Drive::ZeroFlux, true, viscosity),
        _ => driven(Drive::Flux(0.8), false, viscosity),
    };
    for kind in 0..5 {
        let make = |viscosity| solver(kind, viscosity);
        let mut plain = make(0.7);
        let grid = *plain.grid();
        let force = BOX.fill(&grid, |x, y| [(3.0 * x + y).sin() + 0.3, (x * y).cos()]);
        let (mut expected, mut found) = (StaggeredField::zeros(grid), StaggeredField::zeros(grid));
        let report = plain.solve(&force, &mut expected).unwrap();
        // None where it is that of the solver.
        let mut same = TwoPhaseStokes::new(make(0.7)).unwrap();
        assert_eq!(same.solve(&force, &mut found).unwrap(), report);
        assert_eq!(found, expected);
        let mut two_phase = TwoPhaseStokes::new(make(0.9)).unwrap();
        two_phase.set_viscosity(|_, _| 0.7).unwrap();
        let again = two_phase.solve(&force, &mut found).unwrap();
        assert_eq!(again.iterations, 1);
        for (a, b) in report.mean_pressure_gradient.iter().zip(again.mean_pressure_gradient) {
            assert!((a - b).abs() < 1e-12, "{report:?} {again:?}");
        }
        let largest = |field: &StaggeredField| field.x().iter().fold(0.0_f64, |max, u| max.max(u.abs()));
        for (a, b) in found.x().iter().chain(found.y()).zip(expected.x().iter().chain(expected.y())) {
            assert!((a - b).abs() < 1e-12 * largest(&expected), "{a} {b}");
        }
        let (mut p, mut q) = (CentreField::zeros(grid), CentreField::zeros(grid));
        plain.pressure(&force, &expected, &mut p).unwrap();
        two_phase.pressure(&force, &found, &mut q).unwrap();
        for (p, q) in p.values().iter().zip(q.values()) {
            assert!((p - q).abs() < 1e-11, "{p} {q}");
        }
        // The next one starts from the solution.
        assert_eq!(two_phase.solve(&force, &mut found).unwrap().iterations, 0);
    }
}

/// Two layers between walls that slide: the shear stress is uniform, so the shear rates are as the inverse viscosities.
#[test]
fn layers_share_the_shear_as_the_inverse_of_their_viscosities() {
    let grid = Grid::channel(8, 40, 0.05).unwrap();
    let mut solver = ChannelStokes::new(grid, 1.0).unwrap();
    solver.set_walls(WallMotion::uniform(&grid, 0.0, 1.0).unwrap()).unwrap();
    let mut flow = TwoPhaseStokes::new(solver).unwrap().with_tolerance(1e-12).unwrap();
    // Nodes on the boundary between the layers take the harmonic mean, which makes this exact.
    let (mut centres, mut nodes) = (CentreField::zeros(grid), NodeField::zeros(grid));
    centres.values_mut().iter_mut().enumerate().for_each(|(k, eta)| *eta = if k / 8 < 20 { 1.0 } else { 50.0 });
    for (k, eta) in nodes.values_mut().iter_mut().enumerate() {
        *eta = match (k / 8).cmp(&20) {
            std::cmp::Ordering::Less => 1.0,
            std::cmp::Ordering::Equal => 2.0 / (1.0 + 1.0 / 50.0),
            std::cmp::Ordering::Greater => 50.0,
        };
    }
    flow.set_viscosity_fields(&centres, &nodes).unwrap();
    let mut velocity = StaggeredField::zeros(grid);
    flow.solve(&StaggeredField::zeros(grid), &mut velocity).unwrap();
    let stress = 1.0 / (1.0 + 1.0 / 50.0);
    for (k, u) in velocity.x().iter().enumerate() {
        let y = ((k / 8) as f64 + 0.5) * 0.05;
        let exact = if y < 1.0 { stress * y } else { stress * (1.0 + (y - 1.0) / 50.0) };
        assert!((u - exact).abs() < 1e-10, "{y}: {u} {exact}");
    }
}

#[test]
fn solutions_start_from_the_extrapolation_of_the_last_two() {
    let grid = Grid::periodic(64, 64, 4.0 / 64.0).unwrap().with_origin([0.0; 2]).unwrap();
    let mut flow = TwoPhaseStokes::new(PeriodicStokes::new(grid, 1.0).unwrap()).unwrap();
    let mut velocity = StaggeredField::zeros(grid);
    let mut counts = Vec::new();
    for step in 0..6 {
        let x = 2.0 + 1e-3 * f64::from(step);
        let indicator = |px: f64, py: f64| 0.5 * (1.0 + ((1.0 - (px - x).hypot(py - 2.0)) / 0.06).tanh());
        flow.set_viscosity(|px, py| 1.0 + 99.0 * indicator(px, py)).unwrap();
        let ring = |px: f64, py: f64| (-(((px - x).hypot(py - 2.0) - 1.0) / 0.2).powi(2)).exp();
        let force = BOX.fill(&grid, |px, py| [ring(px, py) * (py - 2.0), ring(px, py) * (px - 2.0)]);
        counts.push(flow.solve(&force, &mut velocity).unwrap().iterations);
    }
    assert!(counts[2..].iter().all(|count| 2 * count < counts[0] + 2), "{counts:?}");
}

#[test]
fn what_is_wrong_is_said() {
    let grid = Grid::periodic(16, 16, 0.1).unwrap();
    let other = Grid::periodic(16, 18, 0.1).unwrap();
    let solver = || PeriodicStokes::new(grid, 1.0).unwrap();
    let mut flow = TwoPhaseStokes::new(solver()).unwrap();
    for value in [0.0, -2.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(flow.set_viscosity(|_, _| value), Err(StokesError::Input(InputError::NotPositive { .. }))));
        assert!(TwoPhaseStokes::new(solver()).unwrap().with_tolerance(value.min(0.0)).is_err());
    }
    assert_eq!(flow.viscosity_fields().0.values()[3], 1.0);
    let (centres, nodes) = (CentreField::zeros(other), NodeField::zeros(grid));
    let found = flow.set_viscosity_fields(&centres, &nodes);
    assert!(refused(&found, "the viscosity at the centres belongs to another grid"));
    let mut velocity = StaggeredField::zeros(grid);
    let mut force = StaggeredField::zeros(grid);
    force.components_mut().0[5] = f64::NAN;
    assert!(matches!(flow.solve(&force, &mut velocity), Err(StokesError::Input(InputError::NotFinite { .. }))));
    force.components_mut().0[5] = 1.0;
    let mut flow = flow.with_most_iterations(3);
    flow.set_viscosity(|x, _| if x < 0.0 { 1.0 } else { 1e4 }).unwrap();
    let found = flow.solve(&force, &mut velocity);
    let Err(StokesError::NoConvergence { iterations: 3, residual, history, .. }) = found else {
        panic!("{found:?}");
    };
    assert!(residual > 1e-6 && history.len() == 4);
    assert!(velocity.x().iter().all(|u| *u == 0.0));
}
