//! Friction of the fluid: a circle in Brinkman's equation.

use std::f64::consts::TAU;

use ib_core::{AnyKernel, Hydrodynamics, ImmersedBoundary, MarkerKind, Markers, SmearedContrast, Vec2};
use stokes_grid::{Grid, PeriodicStokes};

const ETA: f64 = 100.0;
const ALPHA: f64 = 100.0;
/// Velocities by tensions cos(t), cos(2 t) and cos(3 t) on the unit circle in unbounded fluid with viscosity and
/// friction 100 inside and outside, from modified Bessel functions: `v_r = u cos(m t)`, `v_t = w sin(m t)`. For m = 1,
/// u is the speed.
const EXACT: [[f64; 2]; 3] = [
    [-8.170_750_391_52e-4, f64::NAN],
    [-2.635_285_350_04e-4, -2.164_545_318_19e-3],
    [-8.561_703_019_77e-5, -2.380_245_560_67e-3],
];

/// Markers of the unit circle with the forces of a tension cos(m t), exact integrals over arcs.
fn circle(count: usize, mode: f64, centre: Vec2) -> Markers {
    let mut markers = Markers::new();
    markers.push_group(count, MarkerKind::Interface { viscosity_inside: None });
    let pull = |t: f64| (mode * t).cos() * Vec2::new(-t.sin(), t.cos());
    let [positions, forces, _] = markers.lists_mut();
    for (k, (position, force)) in positions.iter_mut().zip(forces).enumerate() {
        let at = |k: f64| TAU * k / count as f64;
        *position = centre + Vec2::from_angle(at(k as f64));
        *force = pull(at(k as f64 + 0.5)) - pull(at(k as f64 - 0.5));
    }
    markers
}

/// Amplitudes u and w of the mode m in the velocities; for m = 1 the velocity of the centroid twice.
fn amplitudes(markers: &Markers, mode: f64) -> [f64; 2] {
    let count = markers.len() as f64;
    let mut sums = [0.0; 2];
    for (k, v) in markers.velocities().iter().enumerate() {
        let t = TAU * k as f64 / count;
        let (sin, cos) = t.sin_cos();
        sums[0] += 2.0 / count * (v.x * cos + v.y * sin) * (mode * t).cos();
        sums[1] += 2.0 / count * (v.y * cos - v.x * sin) * (mode * t).sin();
    }
    sums
}

fn found(side: f64, spacing: f64, mode: usize, corrected: bool) -> [f64; 2] {
    let cells = (side / spacing).round() as usize;
    let mut solver =
        PeriodicStokes::new(Grid::periodic(cells, cells, spacing).expect("a grid"), ETA).expect("a solver");
    solver.set_friction(ALPHA).expect("friction");
    let count = 2 * (TAU / spacing).round() as usize;
    let mut markers = circle(count, mode as f64, Vec2::new(0.013, 0.021));
    if corrected {
        ImmersedBoundary::new(solver, AnyKernel::BSpline4).velocities(&mut markers).expect("velocities");
    } else {
        let mut flow = SmearedContrast::new(solver, AnyKernel::BSpline4).expect("a flow");
        flow.velocities(&mut markers).expect("velocities");
    }
    amplitudes(&markers, mode as f64)
}

/// The mobility correction stays of second order: friction changes the flow within a cell by `alpha h^2/eta` only. The
/// error is below `0.35 h^2` for modes 2 and 3, whose waves are 31 and 21 cells long at h = 0.1.
#[test]
fn circles_move_as_in_brinkmans_equation() {
    for mode in [2, 3] {
        let error = |spacing: f64, corrected: bool| {
            let [u, w] = found(16.0, spacing, mode, corrected);
            let [exact_u, exact_w] = EXACT[mode - 1];
            ((u - exact_u).abs() / exact_w.abs()).max((w / exact_w - 1.0).abs())
        };
        let errors = [0.2, 0.1, 0.05].map(|spacing| error(spacing, true));
        println!("mode {mode}: {errors:?}, uncorrected {}", error(0.1, false));
        for (spacing, error) in [0.2, 0.1, 0.05_f64].into_iter().zip(errors) {
            assert!(error < 0.35 * (mode as f64 / 2.0).powi(2) * spacing * spacing, "mode {mode}: {errors:?}");
        }
        assert!(errors[0] > 12.0 * errors[2], "mode {mode}: {errors:?}");
        let [coarse, fine] = [0.1, 0.05].map(|spacing| error(spacing, false));
        let order = (coarse / fine).log2();
        assert!((order - 1.0).abs() < 0.15, "mode {mode}, uncorrected: {coarse} {fine}");
    }
}

/// The speed hardly depends on the box, which is many screening lengths wide.
#[test]
fn a_swimmer_in_large_boxes() {
    let speeds = [16.0, 32.0].map(|side| found(side, 0.1, 1, true)[0]);
    assert!((speeds[0] / speeds[1] - 1.0).abs() < 1e-6, "{speeds:?}");
    assert!((speeds[1] / EXACT[0][0] - 1.0).abs() < 2e-3, "{speeds:?}");
}
