//! Flow, gradient and pressure away from, close to and on the interfaces.

use crate::scenes;

use std::f64::consts::TAU;

use motile_base::{Drive, FlowSample, Region, Vec2};
use motile_boundary_integrals::{BoundaryIntegral, PeriodicCalculus, Settings};
use motile_scene::{Hydrodynamics, Markers};
use scenes::{Ellipse, markers};

const COUNT: usize = 256;

fn pair(inside: f64) -> [Ellipse; 2] {
    let first = Ellipse {
        centre: [0.4, 0.1],
        axes: [1.15, 0.85],
        angle: 0.5,
        viscosity: Some(inside),
        tension: |t| 1.0 + 0.5 * t.cos(),
    };
    let second = Ellipse { centre: [2.8, 0.7], axes: [0.9, 1.0], angle: 0.0, viscosity: Some(0.5), ..first };
    [first, second]
}

struct Solved {
    solver: BoundaryIntegral,
    markers: Markers,
}

impl Solved {
    fn new(region: Region, ellipses: &[Ellipse], nodes: usize) -> Self {
        let settings = Settings { nodes, tolerance: 1e-13, ..Settings::default() };
        let mut solver = BoundaryIntegral::new(region, 1.0, settings).expect("a valid scene");
        let mut markers = markers(ellipses, COUNT);
        solver.velocities(&mut markers).expect("a valid scene");
        Self { solver, markers }
    }

    fn at(&mut self, points: &[Vec2]) -> Vec<FlowSample> {
        let mut out = vec![FlowSample::default(); points.len()];
        self.solver.sample(&self.markers, points, &mut out).expect("a valid scene");
        out
    }
}

/// Largest difference of velocity, gradient and pressure between two lists of samples.
fn difference(a: &[FlowSample], b: &[FlowSample]) -> [f64; 3] {
    let mut worst = [0.0f64; 3];
    for (a, b) in a.iter().zip(b) {
        worst[0] = worst[0].max((a.velocity - b.velocity).length());
        for i in 0..2 {
            for j in 0..2 {
                worst[1] = worst[1].max((a.gradient[i][j] - b.gradient[i][j]).abs());
            }
        }
        worst[2] = worst[2].max((a.pressure - b.pressure).abs());
    }
    worst
}

/// Points at all distances from the first interface, on both sides.
fn around(ellipse: &Ellipse) -> Vec<Vec2> {
    let mut points = Vec::new();
    for (index, distance) in [0.3, 0.1, 0.05, 0.02, 5e-3, 1e-3, 1e-4, 1e-6].into_iter().enumerate() {
        for k in 0..5 {
            let t = TAU * (0.13 + 0.2 * f64::from(k)) + index as f64;
            let (a, b) = (ellipse.point(t), ellipse.point(t + 1e-6));
            let normal = Vec2::new((b - a).y, -(b - a).x).normalize();
            points.push(a + distance * normal);
            points.push(a - distance * normal);
        }
    }
    points
}

fn converged_at_all_distances(region: Region) {
    for inside in [1.0, 20.0] {
        let ellipses = pair(inside);
        let points = around(&ellipses[0]);
        let (mut coarse, mut fine) = (Solved::new(region, &ellipses, 96), Solved::new(region, &ellipses, 160));
        let [velocity, gradient, pressure] = difference(&coarse.at(&points), &fine.at(&points));
        println!("{region:?} {inside}: {velocity:e} {gradient:e} {pressure:e}");
        assert!(velocity < 1e-12 && gradient < 1e-9 && pressure < 1e-10, "{velocity:e} {gradient:e} {pressure:e}");
    }
}

#[test]
fn converged_in_free_space() {
    converged_at_all_distances(Region::Plane);
}

#[test]
fn converged_in_boxes() {
    converged_at_all_distances(Region::Box { lengths: [5.2, 4.6] });
    converged_at_all_distances(Region::Box { lengths: [4.6, 5.8] });
}

#[test]
fn converged_in_a_channel() {
    converged_at_all_distances(Region::Channel { length: 5.2, width: 4.0, drive: Drive::Flux(0.3) });
}

fn satisfies_the_stokes_equations(region: Region, gradient_x: f64) {
    let ellipses = pair(20.0);
    let mut solved = Solved::new(region, &ellipses, 128);
    let h = 1e-4;
    // Inside the first, inside the second, outside, between the two and at 0.02 from the first.
    let close = around(&ellipses[0]);
    let centres =
        [Vec2::new(0.5, 0.2), Vec2::new(2.7, 0.9), Vec2::new(0.7, -1.5), Vec2::new(1.7, 0.5), close[30], close[31]];
    let viscosity = [20.0, 0.5, 1.0, 1.0, 1.0, 20.0];
    for (centre, viscosity) in centres.into_iter().zip(viscosity) {
        let offsets = [[0.0, 0.0], [h, 0.0], [-h, 0.0], [0.0, h], [0.0, -h]];
        let points: Vec<Vec2> = offsets.iter().map(|o| centre + Vec2::new(o[0], o[1])).collect();
        let [c, e, w, n, s] = solved.at(&points).try_into().expect("a valid scene");
        let slope = |a: f64, b: f64| (a - b) / (2.0 * h);
        for i in 0..2 {
            assert!((c.gradient[i][0] - slope(e.velocity[i], w.velocity[i])).abs() < 2e-6, "{centre}");
            assert!((c.gradient[i][1] - slope(n.velocity[i], s.velocity[i])).abs() < 2e-6, "{centre}");
        }
        assert!((c.gradient[0][0] + c.gradient[1][1]).abs() < 1e-11);
        let laplacian =
            |i: usize| slope(e.gradient[i][0], w.gradient[i][0]) + slope(n.gradient[i][1], s.gradient[i][1]);
        let x = slope(e.pressure, w.pressure) + gradient_x - viscosity * laplacian(0);
        let y = slope(n.pressure, s.pressure) - viscosity * laplacian(1);
        assert!(x.abs() < 2e-5 && y.abs() < 2e-5, "{centre}: {x:e} {y:e}");
    }
}

#[test]
fn stokes_equations() {
    satisfies_the_stokes_equations(Region::Plane, 0.0);
    satisfies_the_stokes_equations(Region::Box { lengths: [5.2, 4.6] }, 0.0);
    satisfies_the_stokes_equations(Region::Box { lengths: [4.6, 5.8] }, 0.0);
    satisfies_the_stokes_equations(Region::Channel { length: 5.2, width: 4.0, drive: Drive::default() }, 0.0);
    let channel = Region::Channel { length: 5.2, width: 4.0, drive: Drive::Gradient(-0.2) };
    satisfies_the_stokes_equations(channel, -0.2);
    let channel = Region::Channel { length: 5.2, width: 4.0, drive: Drive::Flux(0.3) };
    let mut solver =
        BoundaryIntegral::new(channel, 1.0, Settings { nodes: 128, tolerance: 1e-13, ..Settings::default() });
    let report =
        solver.as_mut().expect("a valid scene").velocities(&mut markers(&pair(20.0), COUNT)).expect("a valid scene");
    satisfies_the_stokes_equations(channel, report.mean_pressure_gradient[0]);
}

/// The velocity is continuous and the traction jumps by the force of the interface.
fn jumps_by_the_force(region: Region) {
    let ellipses = pair(20.0);
    let mut solved = Solved::new(region, &ellipses, 96);
    let mut calculus = PeriodicCalculus::new(COUNT).expect("a valid scene");
    let mut tangents = vec![Vec2::ZERO; COUNT];
    calculus.derivative(&solved.markers.positions()[..COUNT], &mut tangents).expect("a valid scene");
    let distance = 1e-7;
    // Markers that are nodes and markers that are not.
    for k in [0, 3, 57, 64, 131, 200] {
        let (position, tangent) = (solved.markers.positions()[k], tangents[k]);
        let normal = Vec2::new(tangent.y, -tangent.x).normalize();
        let on = solved.at(&[position + distance * normal, position - distance * normal, position]);
        for sample in &on {
            let error = (sample.velocity - solved.markers.velocities()[k]).length();
            assert!(error < 1e-6, "{error:e}");
        }
        let traction = |s: &FlowSample, viscosity: f64| {
            let shear = viscosity * (s.gradient[0][1] + s.gradient[1][0]);
            Vec2::new(
                (2.0 * viscosity * s.gradient[0][0] - s.pressure) * normal.x + shear * normal.y,
                shear * normal.x + (2.0 * viscosity * s.gradient[1][1] - s.pressure) * normal.y,
            )
        };
        let force = solved.markers.forces()[k] * (COUNT as f64 / TAU / tangent.length());
        let jump = traction(&on[0], 1.0) - traction(&on[1], 20.0) + force;
        assert!(jump.length() < 2e-5, "{jump}");
    }
}

#[test]
fn jump_conditions() {
    jumps_by_the_force(Region::Plane);
    jumps_by_the_force(Region::Box { lengths: [5.2, 4.6] });
    jumps_by_the_force(Region::Channel { length: 5.2, width: 4.0, drive: Drive::default() });
}

#[test]
fn a_resting_droplet_has_the_pressure_of_laplace() {
    let droplet = Ellipse { viscosity: Some(7.0), ..Ellipse::circle(0.2, 0.1, |_| 3.0) };
    let mut solved = Solved::new(Region::Plane, &[droplet], 48);
    let samples = solved.at(&[Vec2::new(0.0, 0.0), Vec2::new(1.19, 0.1), Vec2::new(1.21, 0.1), Vec2::new(5.0, 3.0)]);
    for (sample, pressure) in samples.iter().zip([3.0, 3.0, 0.0, 0.0]) {
        assert!(sample.velocity.length() < 1e-13);
        assert!((sample.pressure - pressure).abs() < 1e-11, "{}", sample.pressure);
    }
}

#[test]
fn the_mean_velocity_of_a_box_is_zero() {
    for (lx, ly) in [(6.0, 6.0), (5.4, 6.6), (7.0, 5.0)] {
        let ellipses = pair(20.0);
        let mut solved = Solved::new(Region::Box { lengths: [lx, ly] }, &ellipses, 128);
        // The flux through any line across the box is the mean of the velocity: lines that no interface crosses.
        let samples = 64;
        let across = |k: usize| k as f64 / samples as f64;
        let vertical: Vec<Vec2> = (0..samples).map(|k| Vec2::new(-1.1, ly * across(k))).collect();
        let horizontal: Vec<Vec2> = (0..samples).map(|k| Vec2::new(lx * across(k), -1.6)).collect();
        let u: f64 = solved.at(&vertical).iter().map(|s| s.velocity.x).sum::<f64>() / samples as f64;
        let v: f64 = solved.at(&horizontal).iter().map(|s| s.velocity.y).sum::<f64>() / samples as f64;
        assert!(u.abs() < 1e-13 && v.abs() < 1e-13, "{u:e} {v:e}");
    }
}

#[test]
fn samples_are_periodic() {
    let region = Region::Box { lengths: [5.2, 4.6] };
    let ellipses = pair(20.0);
    let mut solved = Solved::new(region, &ellipses, 96);
    let points = around(&ellipses[1]);
    let moved: Vec<Vec2> = points.iter().map(|p| p + Vec2::new(-3.0 * 5.2, 2.0 * 4.6)).collect();
    // Points at 1e-6 from the interface lose digits when they are moved by 15.
    let [velocity, gradient, pressure] = difference(&solved.at(&points), &solved.at(&moved));
    assert!(velocity < 1e-12 && gradient < 1e-7 && pressure < 1e-6, "{velocity:e} {gradient:e} {pressure:e}");
}

/// Interfaces far apart see each other by series, samples by direct summation over the nodes: at the markers both must
/// agree.
fn far_interfaces_move_with_the_flow(region: Region) {
    let mut ellipses = pair(20.0).to_vec();
    ellipses[1].centre = [5.1, 1.2];
    ellipses.push(Ellipse { centre: [-4.7, -0.8], axes: [0.5, 0.7], viscosity: None, ..ellipses[0] });
    ellipses.push(Ellipse { centre: [9.5, -1.0], axes: [0.3, 0.25], viscosity: Some(3.0), ..ellipses[0] });
    let mut solved = Solved::new(region, &ellipses, 96);
    let points: Vec<Vec2> = solved.markers.positions().iter().copied().step_by(17).collect();
    let samples = solved.at(&points);
    for (sample, velocity) in samples.iter().zip(solved.markers.velocities().iter().step_by(17)) {
        // A point on an interface is taken a billionth of a spacing inside.
        let error = (sample.velocity - velocity).length();
        println!("{region:?}: {error:e}");
        assert!(error < 1e-10, "{error:e}");
    }
}

#[test]
fn series_and_sums_agree() {
    far_interfaces_move_with_the_flow(Region::Plane);
    far_interfaces_move_with_the_flow(Region::Box { lengths: [17.0, 15.0] });
    far_interfaces_move_with_the_flow(Region::Box { lengths: [16.0, 5.5] });
    far_interfaces_move_with_the_flow(Region::Channel { length: 16.0, width: 5.0, drive: Drive::default() });
}
