//! Orders of convergence on smooth exact solutions.

use std::f64::consts::PI;

use stokes_grid::{
    CentreField, ChannelStokes, Grid, NodeField, PeriodicStokes, ProjectionStokes, StaggeredField, StokesSolver, Wall,
    WallMotion, normal_strain_rates, shear_strain_rate, streamfunction, vorticity, wall_shear_stress,
};

const ETA: f64 = 1.3;

/// A smooth flow with its pressure: functions of (x, y).
struct Flow {
    psi: fn(f64, f64) -> f64,
    velocity: fn(f64, f64) -> [f64; 2],
    /// `[du/dx, du/dy, dv/dx]`; dv/dy is minus the first.
    gradient: fn(f64, f64) -> [f64; 3],
    laplacian: fn(f64, f64) -> [f64; 2],
    pressure: fn(f64, f64) -> f64,
    pressure_gradient: fn(f64, f64) -> [f64; 2],
}

impl Flow {
    fn force(&self, x: f64, y: f64) -> [f64; 2] {
        let (lap, grad) = ((self.laplacian)(x, y), (self.pressure_gradient)(x, y));
        [grad[0] - ETA * lap[0], grad[1] - ETA * lap[1]]
    }
}

const K: f64 = 2.0 * PI;

/// A channel 0 < y < 1 of length 1: psi = y^2 (1-y)^2 (2 + sin kx) plus the flow of walls that slide as 0.2 + 0.1 cos
/// kx at the bottom, -y (1-y)^2 U, and sin kx at the top, -y^2 (1-y) U with its sign; p = e^y sin kx + y^3.
const CHANNEL: Flow = Flow {
    psi: |x, y| shape(y)[0] * (2.0 + (K * x).sin()) + low(y)[0] * bottom(x)[0] + high(y)[0] * top(x)[0],
    velocity: |x, y| {
        let u = shape(y)[1] * (2.0 + (K * x).sin()) + low(y)[1] * bottom(x)[0] + high(y)[1] * top(x)[0];
        let v = shape(y)[0] * K * (K * x).cos() + low(y)[0] * bottom(x)[1] + high(y)[0] * top(x)[1];
        [u, -v]
    },
    gradient: |x, y| {
        let ux = shape(y)[1] * K * (K * x).cos() + low(y)[1] * bottom(x)[1] + high(y)[1] * top(x)[1];
        let uy = shape(y)[2] * (2.0 + (K * x).sin()) + low(y)[2] * bottom(x)[0] + high(y)[2] * top(x)[0];
        let vx = shape(y)[0] * K * K * (K * x).sin() - low(y)[0] * bottom(x)[2] - high(y)[0] * top(x)[2];
        [ux, uy, vx]
    },
    laplacian: |x, y| {
        let (s, l, h) = (shape(y), low(y), high(y));
        let (wave, b, t) = ([2.0 + (K * x).sin(), K * (K * x).cos(), -K * K * (K * x).sin()], bottom(x), top(x));
        let u = s[1] * wave[2] + s[3] * wave[0] + l[1] * b[2] + l[3] * b[0] + h[1] * t[2] + h[3] * t[0];
        let v = -K * K * (s[0] * wave[1] + l[0] * b[1] + h[0] * t[1]) + s[2] * wave[1] + l[2] * b[1] + h[2] * t[1];
        [u, -v]
    },
    pressure: |x, y| y.exp() * (K * x).sin() + y.powi(3),
    pressure_gradient: |x, y| [K * y.exp() * (K * x).cos(), y.exp() * (K * x).sin() + 3.0 * y * y],
};

/// `y^2 (1-y)^2` and its derivatives.
fn shape(y: f64) -> [f64; 4] {
    [
        y * y * (1.0 - y) * (1.0 - y),
        2.0 * y - 6.0 * y * y + 4.0 * y.powi(3),
        2.0 - 12.0 * y + 12.0 * y * y,
        24.0 * y - 12.0,
    ]
}

/// `y (1-y)^2`, with slope one at the bottom only, and its derivatives.
fn low(y: f64) -> [f64; 4] {
    [y * (1.0 - y) * (1.0 - y), 1.0 - 4.0 * y + 3.0 * y * y, -4.0 + 6.0 * y, 6.0]
}

/// `-y^2 (1-y)`, with slope one at the top only, and its derivatives.
fn high(y: f64) -> [f64; 4] {
    [-y * y * (1.0 - y), -2.0 * y + 3.0 * y * y, -2.0 + 6.0 * y, 6.0]
}

/// The velocity of the bottom wall and two derivatives.
fn bottom(x: f64) -> [f64; 3] {
    [0.2 + 0.1 * (K * x).cos(), -0.1 * K * (K * x).sin(), -0.1 * K * K * (K * x).cos()]
}

/// The velocity of the top wall and two derivatives.
fn top(x: f64) -> [f64; 3] {
    [0.15 * (K * x).sin(), 0.15 * K * (K * x).cos(), -0.15 * K * K * (K * x).sin()]
}

/// A periodic box of width 1: psi = sin(kx) cos(2ky) / k, p = cos(kx) sin(ky).
const BOX: Flow = Flow {
    psi: |x, y| (K * x).sin() * (2.0 * K * y).cos() / K,
    velocity: |x, y| [-2.0 * (K * x).sin() * (2.0 * K * y).sin(), -(K * x).cos() * (2.0 * K * y).cos()],
    gradient: |x, y| {
        [
            -2.0 * K * (K * x).cos() * (2.0 * K * y).sin(),
            -4.0 * K * (K * x).sin() * (2.0 * K * y).cos(),
            K * (K * x).sin() * (2.0 * K * y).cos(),
        ]
    },
    laplacian: |x, y| {
        [10.0 * K * K * (K * x).sin() * (2.0 * K * y).sin(), 5.0 * K * K * (K * x).cos() * (2.0 * K * y).cos()]
    },
    pressure: |x, y| (K * x).cos() * (K * y).sin(),
    pressure_gradient: |x, y| [-K * (K * x).sin() * (K * y).sin(), K * (K * x).cos() * (K * y).cos()],
};

/// Position of entry `k`, shifted by halves of a cell.
fn position(grid: &Grid, k: usize, half: [f64; 2]) -> (f64, f64) {
    let (i, j) = (k % grid.nx(), k / grid.nx());
    let [x0, y0] = grid.origin();
    (x0 + (i as f64 + half[0]) * grid.spacing(), y0 + (j as f64 + half[1]) * grid.spacing())
}

const X_FACE: [f64; 2] = [0.0, 0.5];
const Y_FACE: [f64; 2] = [0.5, 0.0];
const CENTRE: [f64; 2] = [0.5, 0.5];
const NODE: [f64; 2] = [0.0, 0.0];

/// The largest error against `exact`, both without their means if `free` of a constant.
fn error(grid: &Grid, values: &[f64], half: [f64; 2], free: bool, exact: impl Fn(f64, f64) -> f64) -> f64 {
    let differences: Vec<f64> = values
        .iter()
        .enumerate()
        .map(|(k, value)| {
            let (x, y) = position(grid, k, half);
            value - exact(x, y)
        })
        .collect();
    let shift = if free { differences.iter().sum::<f64>() / differences.len() as f64 } else { 0.0 };
    differences.iter().fold(0.0, |m, d| m.max((d - shift).abs()))
}

/// Largest errors of u, v, p, psi, vorticity, D_xx, D_yy, D_xy and, with walls, of the shear stress at both.
fn errors(flow: &Flow, solver: &mut dyn StokesSolver) -> Vec<f64> {
    let grid = *solver.grid();
    let mut force = StaggeredField::zeros(grid);
    let (fx, fy) = force.components_mut();
    for (k, f) in fx.iter_mut().enumerate() {
        let (x, y) = position(&grid, k, X_FACE);
        *f = flow.force(x, y)[0];
    }
    for (k, f) in fy.iter_mut().enumerate() {
        let (x, y) = position(&grid, k, Y_FACE);
        *f = flow.force(x, y)[1];
    }
    let (mut velocity, mut p) = (StaggeredField::zeros(grid), CentreField::zeros(grid));
    solver.solve(&force, &mut velocity).unwrap();
    solver.pressure(&force, &velocity, &mut p).unwrap();
    let walls = solver.walls().clone();
    let (mut psi, mut omega, mut xy) = (NodeField::zeros(grid), NodeField::zeros(grid), NodeField::zeros(grid));
    let (mut xx, mut yy) = (CentreField::zeros(grid), CentreField::zeros(grid));
    streamfunction(&velocity, &mut psi).unwrap();
    vorticity(&velocity, &walls, &mut omega).unwrap();
    normal_strain_rates(&velocity, &mut xx, &mut yy).unwrap();
    shear_strain_rate(&velocity, &walls, &mut xy).unwrap();
    let gradient = |x, y| (flow.gradient)(x, y);
    let mut errors = vec![
        error(&grid, velocity.x(), X_FACE, false, |x, y| (flow.velocity)(x, y)[0]),
        error(&grid, velocity.y(), Y_FACE, false, |x, y| (flow.velocity)(x, y)[1]),
        error(&grid, p.values(), CENTRE, true, flow.pressure),
        error(&grid, psi.values(), NODE, false, flow.psi),
        error(&grid, omega.values(), NODE, false, |x, y| gradient(x, y)[2] - gradient(x, y)[1]),
        error(&grid, xx.values(), CENTRE, false, |x, y| gradient(x, y)[0]),
        error(&grid, yy.values(), CENTRE, false, |x, y| -gradient(x, y)[0]),
        error(&grid, xy.values(), NODE, false, |x, y| 0.5 * (gradient(x, y)[1] + gradient(x, y)[2])),
    ];
    if grid.has_walls() {
        let mut stress = vec![0.0; grid.nx()];
        for (wall, y) in [(Wall::Bottom, 0.0), (Wall::Top, 1.0)] {
            wall_shear_stress(&velocity, ETA, &walls, wall, &mut stress).unwrap();
            errors.push(error(&grid, &stress, NODE, false, |x, _| ETA * gradient(x, y)[1]));
        }
    }
    errors
}

/// Orders between errors on grids whose spacings differ by a factor of two.
fn orders(coarse: &[f64], fine: &[f64]) -> Vec<f64> {
    coarse.iter().zip(fine).map(|(a, b)| (a / b).log2()).collect()
}

fn check(name: &str, flow: &Flow, sizes: [usize; 3], make: impl Fn(usize) -> Box<dyn StokesSolver>) {
    let errors = sizes.map(|n| errors(flow, &mut *make(n)));
    for (n, errors) in sizes.iter().zip(&errors) {
        println!("{name} {n:>4}: {}", errors.iter().map(|e| format!("{e:.2e} ")).collect::<String>());
    }
    let orders = orders(&errors[1], &errors[2]);
    println!("{name} order: {orders:.2?}");
    for (k, order) in orders.iter().enumerate() {
        let least = if k < 2 { 1.9 } else { 1.85 };
        let most = if k < 2 { 2.1 } else { 2.3 };
        assert!((least..most).contains(order), "{name}: order {order} of quantity {k}");
    }
    assert!(orders[2] >= 1.9, "{name}: order {} of the pressure", orders[2]);
}

#[test]
fn a_channel_is_solved_to_second_order_with_sliding_walls() {
    let grid = |n: usize| Grid::channel(n, n, 1.0 / n as f64).unwrap().with_origin([0.0, 0.0]).unwrap();
    let walls = |grid: &Grid| WallMotion::from_fn(grid, |x| bottom(x)[0], |x| top(x)[0]).unwrap();
    check("channel", &CHANNEL, [40, 80, 160], |n| {
        let mut solver = ChannelStokes::new(grid(n), ETA).unwrap();
        solver.set_walls(walls(&grid(n))).unwrap();
        Box::new(solver)
    });
}

#[test]
fn a_channel_is_solved_to_second_order_by_projection() {
    let grid = |n: usize| Grid::channel(n, n, 1.0 / n as f64).unwrap().with_origin([0.0, 0.0]).unwrap();
    check("channel, projection", &CHANNEL, [40, 80, 160], |n| {
        let mut solver = ProjectionStokes::new(grid(n), ETA).unwrap();
        solver.set_walls(WallMotion::from_fn(&grid(n), |x| bottom(x)[0], |x| top(x)[0]).unwrap()).unwrap();
        Box::new(solver)
    });
}

#[test]
fn a_box_is_solved_to_second_order() {
    let grid = |n: usize| Grid::periodic(n, n, 1.0 / n as f64).unwrap();
    check("box, projection", &BOX, [32, 64, 128], |n| Box::new(ProjectionStokes::new(grid(n), ETA).unwrap()));
    check("box", &BOX, [32, 64, 128], |n| Box::new(PeriodicStokes::new(grid(n), ETA).unwrap()));
}
