//! Green's function of a channel against the Stokes equations and its walls.

use super::*;
use crate::greens::{Flow, GreensFunction};

/// Velocity and gradient at a target by a unit force at a source, times 4 pi viscosity.
fn greens_function(modes: &mut WallModes, target: [f64; 2], source: [f64; 2], force: Complex64) -> (Complex64, Flow) {
    let mut from = WallPoints::new(TAU / modes.k, modes.half);
    let mut to = from.clone();
    from.push(source[0], source[1]);
    to.push(target[0], target[1]);
    from.prepare();
    to.prepare();
    modes.begin(Uncorrected::Row, from.gap(), to.gap(), 1e-15);
    modes.add_forces(&from, to.gap(), |_| force);
    modes.solve();
    let walls = modes.flow(&to, 0);
    let mut row = Flow::default();
    let d = Complex64::new(source[0] - target[0], source[1] - target[1]);
    row.add_force(&GreensFunction::Row { k: modes.k }.at(d), force, 1.0);
    let mut fast = Vec::new();
    modes.velocities(&to, &mut fast);
    let fast = Complex64::new(fast[0][0], fast[0][1]);
    assert!((fast - walls.velocity).norm() < 1e-11, "{fast} {}", walls.velocity);
    (row.velocity + walls.velocity, walls)
}

/// Both the source and the target are as far from a wall as the sum decays over.
#[test]
fn modes_fall_with_both_distances() {
    let mut modes = WallModes::new(6.0, 1.0, false);
    let mut count = |source: f64, target: f64| {
        modes.begin(Uncorrected::Row, source, target, 1e-12);
        modes.modes
    };
    assert_eq!(count(0.5, 0.25), count(0.25, 0.5));
    assert!(count(0.5, 0.5) < count(0.5, 0.25) && count(0.5, 0.25) < count(0.25, 0.25));
}

#[test]
fn greens_function_of_a_channel() {
    // channel_greens_function.csv: period 4, width 2; zero flux, target, source, (Gxx, Gxy, Gyx, Gyy).
    let table = [
        (false, [0.5, 0.3], [0.0, 0.0], [1.1784861392876, 0.44573020238905, 0.2745808454774, -0.046810182975054]),
        (false, [0.1, 0.05], [0.0, 0.0], [2.7597646762562, 0.40098683955777, 0.3933797966449, 1.2832398475756]),
        (false, [1.9, -0.6], [0.0, 0.4], [0.60845732698052, -0.01223564484989, -0.0066381849594813, -0.02968392467597]),
        (false, [0.0, 0.75], [0.0, 0.2], [0.1874090388085, 0.0, 0.0, 0.26449726269913]),
        (false, [-0.7, -0.85], [-0.6, -0.8], [1.4982178003109, 0.60070494851271, 0.12361745052196, 0.070804536013316]),
        (false, [2.0, 0.0], [0.0, 0.0], [1.1789380383492, 0.0, 0.0, -0.12475063742573]),
        (false, [0.3, 0.95], [0.2, 0.93], [0.92305173530545, 0.39248444104763, -0.17181458083639, -0.17705677679815]),
        (true, [0.5, 0.3], [0.0, 0.0], [0.10641764625007, 0.44573020238905, 0.2745808454774, -0.046810182975054]),
        (true, [0.1, 0.05], [0.0, 0.0], [1.5846126742728, 0.40098683955777, 0.3933797966449, 1.2832398475756]),
        (
            true,
            [1.9, -0.6],
            [0.0, 0.4],
            [-0.024887751983179, -0.01223564484989, -0.0066381849594813, -0.02968392467597],
        ),
        (true, [0.0, 0.75], [0.0, 0.2], [-0.30739180413189, 0.0, 0.0, 0.26449726269913]),
        (true, [-0.7, -0.85], [-0.6, -0.8], [1.3805258855258, 0.60070494851271, 0.12361745052196, 0.070804536013316]),
        (true, [2.0, 0.0], [0.0, 0.0], [0.00084079325303654, 0.0, 0.0, -0.12475063742573]),
        (true, [0.3, 0.95], [0.2, 0.93], [0.90753354386873, 0.39248444104763, -0.17181458083639, -0.17705677679815]),
    ];
    for (zero_flux, target, source, [xx, xy, yx, yy]) in table {
        let mut modes = WallModes::new(4.0, 1.0, zero_flux);
        let (x, _) = greens_function(&mut modes, target, source, Complex64::new(1.0, 0.0));
        let (y, _) = greens_function(&mut modes, target, source, I);
        let error = (x - Complex64::new(xx, yx)).norm().max((y - Complex64::new(xy, yy)).norm());
        assert!(error < 1e-12, "{target:?} {source:?}: {error:e}");
    }
}

#[test]
fn gradient_and_pressure_satisfy_the_stokes_equations() {
    let mut modes = WallModes::new(5.0, 1.2, true);
    let (source, force) = ([0.3, 0.5], Complex64::new(0.6, -0.8));
    let step = 1e-4;
    let mut at = |dx: f64, dy: f64| greens_function(&mut modes, [0.9 + dx, -0.4 + dy], source, force).1;
    let centre = at(0.0, 0.0);
    let (east, west) = (at(step, 0.0), at(-step, 0.0));
    let (north, south) = (at(0.0, step), at(0.0, -step));
    let scale = 0.5 / step;
    let velocity = |flow: &Flow| [flow.velocity.re, flow.velocity.im];
    for i in 0..2 {
        let difference = |a: &Flow, b: &Flow| scale * (velocity(a)[i] - velocity(b)[i]);
        assert!((centre.gradient()[i][0] - difference(&east, &west)).abs() < 1e-7);
        assert!((centre.gradient()[i][1] - difference(&north, &south)).abs() < 1e-7);
    }
    let slope = |flow: &Flow, i: usize, j: usize| scale * flow.gradient()[i][j];
    let laplacian = |i: usize| slope(&east, i, 0) - slope(&west, i, 0) + slope(&north, i, 1) - slope(&south, i, 1);
    // The mean pressure gradient is not part of the pressure.
    let mean = 1.5 * modes.k / 1.2f64.powi(3) * (1.2f64.powi(2) - 0.25) * force.re;
    assert!((scale * (east.pressure - west.pressure) + mean - laplacian(0)).abs() < 1e-7);
    assert!((scale * (north.pressure - south.pressure) - laplacian(1)).abs() < 1e-7);
}

/// The odd part of the walls' equation where a mode is much longer than the channel is wide: (sinh z - z)/2 against its
/// series, `z^3/12 (1 + z^2/20 + z^4/840 + z^6/60480)`.
#[test]
fn long_waves_keep_their_digits() {
    for z in [1e-4_f64, 1e-3, 1e-2, 0.1] {
        let series = 1.0 + z.powi(2) / 20.0 + z.powi(4) / 840.0 + z.powi(6) / 60_480.0;
        let odd = z.powi(3) / 12.0 * series;
        let found = factors(z, 0.5).odd[1];
        assert!((found * odd / 0.5 - 1.0).abs() < 1e-13, "{z}: {found}");
    }
}

/// The whole flow at a target by a unit force at a source, times 4 pi viscosity, between walls with slip.
fn slipping_flow(
    [period, half]: [f64; 2],
    slip: [f64; 2],
    zero_flux: bool,
    target: [f64; 2],
    source: [f64; 2],
    force: Complex64,
) -> Flow {
    let mut modes = WallModes::new(period, half, zero_flux).with_slip(Slipping::new(half, slip));
    let (_, walls) = greens_function(&mut modes, target, source, force);
    let mut flow = Flow::default();
    let d = Complex64::new(source[0] - target[0], source[1] - target[1]);
    flow.add_force(&GreensFunction::Row { k: modes.k }.at(d), force, 1.0);
    flow += walls;
    flow
}

const SLIPS: [[f64; 2]; 6] = [[0.1, 0.1], [0.3, 0.0], [0.0, 2.0], [0.05, 0.7], [4e3, 0.2], [1e4, 1e4]];

/// Navier's condition at both walls, narrow and wide channels, and no flux where none is wanted.
#[test]
fn fluid_slips_along_the_walls() {
    for (period, half) in [(4.0, 1.0), (6.0, 1.5), (12.0, 0.6), (2.0, 3.0)] {
        for slip in SLIPS {
            for (zero_flux, force) in [(false, I), (false, Complex64::new(1.0, 0.0)), (true, Complex64::new(0.6, 0.8))]
            {
                let source = [0.3, 0.4 * half];
                for (wall, out) in [-1.0, 1.0].into_iter().enumerate() {
                    for x in [0.2, -0.9, 1.7] {
                        let at = [x, out * half];
                        let flow = slipping_flow([period, half], slip, zero_flux, at, source, force);
                        let slope = out * flow.gradient()[0][1];
                        let error = (flow.velocity.re + slip[wall] * slope).abs() / (1.0 + slip[wall]);
                        assert!(error < 1e-11, "{period} {half} {slip:?} wall {wall}: {error:e}");
                        assert!(flow.velocity.im.abs() < 1e-11, "{:e}", flow.velocity.im);
                    }
                }
                if zero_flux {
                    // Simpson's rule far from the source, where the flow is smooth.
                    let (n, x) = (200, 0.3 + 0.5 * period);
                    let u = |j: usize| {
                        let y = half * (2.0 * j as f64 / n as f64 - 1.0);
                        slipping_flow([period, half], slip, true, [x, y], source, force).velocity.re
                    };
                    let inner = |from: usize| (from..n).step_by(2).map(u).sum::<f64>();
                    let flux = (u(0) + u(n) + 4.0 * inner(1) + 2.0 * inner(2)) * 2.0 * half / n as f64 / 3.0;
                    assert!(flux.abs() < 1e-6 * half, "{period} {half} {slip:?}: flux {flux:e}");
                }
            }
        }
    }
}

/// G(x, y) is the transpose of G(y, x), and the pressure of the walls balances the stresses.
#[test]
fn slipping_walls_are_reciprocal() {
    let (a, b) = ([0.3, 0.5], [-0.4, -0.8]);
    for slip in SLIPS {
        for zero_flux in [false, true] {
            let flow = |to, from, force| slipping_flow([5.0, 1.2], slip, zero_flux, to, from, force).velocity;
            let one = Complex64::new(1.0, 0.0);
            // The mean flow of a force is as large as that, with a given flux less the same.
            let scale = 1.0 + slip[0].min(slip[1]);
            let diagonal =
                (flow(a, b, one).re - flow(b, a, one).re).abs().max((flow(a, b, I).im - flow(b, a, I).im).abs());
            let across = (flow(a, b, one).im - flow(b, a, I).re).abs();
            assert!(diagonal.max(across) < 1e-12 * scale, "{slip:?}: {diagonal:e} {across:e}");
        }
    }
}

/// With no slip length at either wall, the general formulas give the flow of no slip.
#[test]
fn slip_lengths_of_nothing_are_no_slip() {
    let tiny = slipping_flow([4.0, 1.0], [1e-14, 1e-15], true, [0.5, 0.3], [0.0, 0.0], Complex64::new(1.0, 0.0));
    assert!((tiny.velocity - Complex64::new(0.10641764625007, 0.2745808454774)).norm() < 1e-12, "{tiny:?}");
}
