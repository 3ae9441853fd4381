//! Walls, drives and what is measured in channels.

use crate::scenes;

use motile_base::{Drive, FlowSample, Region, SolveReport, Vec2};
use motile_boundary_integrals::{BoundaryIntegral, Settings};
use motile_scene::{Hydrodynamics, Markers};
use scenes::{Ellipse, markers};

const COUNT: usize = 256;

struct Solved {
    /// Period and width.
    lengths: [f64; 2],
    solver: BoundaryIntegral,
    markers: Markers,
    report: SolveReport,
}

fn solve(period: f64, width: f64, drive: Drive, ellipses: &[Ellipse]) -> Solved {
    let region = Region::Channel { length: period, width, drive };
    let settings = Settings { nodes: 128, tolerance: 1e-14, ..Settings::default() };
    let mut solver = BoundaryIntegral::new(region, 1.0, settings).expect("a valid scene");
    let mut markers = markers(ellipses, COUNT);
    let report = solver.velocities(&mut markers).expect("a valid scene");
    Solved { lengths: [period, width], solver, markers, report }
}

impl Solved {
    fn at(&mut self, points: &[Vec2]) -> Vec<FlowSample> {
        let mut out = vec![FlowSample::default(); points.len()];
        self.solver.sample(&self.markers, points, &mut out).expect("a valid scene");
        out
    }

    /// Flux through the line at x, by the rule of Clenshaw and Curtis over the height.
    fn flux(&mut self, x: f64) -> f64 {
        const N: usize = 48;
        let half = 0.5 * self.lengths[1];
        let angle = |k: usize| std::f64::consts::PI * k as f64 / N as f64;
        let points: Vec<Vec2> = (0..=N).map(|k| Vec2::new(x, half * angle(k).cos())).collect();
        let samples = self.at(&points);
        let weight = |k: usize| {
            let mut sum = 1.0;
            for j in 1..=N / 2 {
                let factor = if 2 * j == N { 1.0 } else { 2.0 };
                sum -= factor * (2.0 * j as f64 * angle(k)).cos() / (4 * j * j - 1) as f64;
            }
            sum * if k == 0 || k == N { 1.0 } else { 2.0 } / N as f64
        };
        half * samples.iter().enumerate().map(|(k, sample)| weight(k) * sample.velocity.x).sum::<f64>()
    }

    /// Integral of the shear stress over the wall at y.
    fn wall_shear(&mut self, y: f64) -> f64 {
        const N: usize = 128;
        let period = self.lengths[0];
        let points: Vec<Vec2> = (0..N).map(|k| Vec2::new(period * k as f64 / N as f64, y)).collect();
        self.at(&points).iter().map(|sample| sample.gradient[0][1]).sum::<f64>() * period / N as f64
    }
}

#[test]
fn flux_pressure_gradient_and_wall_shear() {
    // channel_fixed_shape_global.csv: period 6, width 3, tension 1 + 0.5 cos t; flux, pressure gradient, shear at top.
    let tension = |t: f64| 1.0 + 0.5 * t.cos();
    let circle = Ellipse::circle(0.0, 0.0, tension);
    let ellipse = Ellipse { axes: [1.3, 1.0 / 1.3], ..circle };
    let raised = Ellipse { centre: [0.0, 0.3], ..circle };
    let table = [
        (circle, Drive::ZeroGradient, -6.544_984_694_978_7e-2, 0.0, 0.0),
        (circle, Drive::ZeroFlux, 0.0, -2.908_882_086_657_2e-2, -0.261_799_387_799_15),
        (raised, Drive::ZeroFlux, 0.0, -2.908_882_086_657_2e-2, -0.261_799_387_799_15),
        (ellipse, Drive::ZeroGradient, -4.825_802_316_398e-2, 0.0, 0.0),
        (ellipse, Drive::ZeroFlux, 0.0, -2.144_801_029_510_2e-2, -0.193_032_092_655_92),
    ];
    for (shape, drive, flux, gradient, shear) in table {
        let mut solved = solve(6.0, 3.0, drive, &[shape]);
        assert!((solved.flux(2.3) - flux).abs() < 1e-13, "{:e}", solved.flux(2.3) - flux);
        assert!((solved.report.mean_pressure_gradient[0] - gradient).abs() < 1e-13);
        assert!((solved.wall_shear(1.5) - shear).abs() < 1e-12, "{:e}", solved.wall_shear(1.5) - shear);
        assert!((solved.wall_shear(-1.5) + shear).abs() < 1e-12);
    }
}

fn contrasting() -> [Ellipse; 2] {
    let first = Ellipse {
        centre: [0.0, 0.2],
        axes: [1.1, 0.9],
        angle: 0.3,
        viscosity: Some(30.0),
        tension: |t| 1.0 + 0.5 * t.cos(),
    };
    [first, Ellipse { centre: [2.6, -0.3], viscosity: Some(0.1), ..first }]
}

#[test]
fn walls_do_not_slip_and_the_flux_is_the_given_one() {
    for (drive, expected) in [(Drive::ZeroFlux, 0.0), (Drive::Flux(0.7), 0.7)] {
        let mut solved = solve(7.0, 3.2, drive, &contrasting());
        let wall: Vec<Vec2> = (0..50).flat_map(|k| [-1.6, 1.6].map(|y| Vec2::new(0.15 * f64::from(k), y))).collect();
        for sample in solved.at(&wall) {
            assert!(sample.velocity.length() < 1e-12, "{}", sample.velocity);
        }
        let flux = solved.flux(-2.0);
        assert!((flux - expected).abs() < 1e-12, "{flux}");
        // The balance of forces on the fluid of one period.
        let shear = solved.wall_shear(1.6) - solved.wall_shear(-1.6);
        let pressure = solved.report.mean_pressure_gradient[0] * 7.0 * 3.2;
        assert!((shear - pressure).abs() < 1e-11, "{shear} {pressure}");
    }
}

#[test]
fn imposed_gradient_and_imposed_flux_agree() {
    // The flux that a gradient drives past two droplets, imposed, needs that gradient.
    let mut driven = solve(7.0, 3.2, Drive::Gradient(-0.4), &contrasting());
    let flux = driven.flux(-2.0);
    let imposed = solve(7.0, 3.2, Drive::Flux(flux), &contrasting());
    assert!((imposed.report.mean_pressure_gradient[0] + 0.4).abs() < 1e-11);
    for (a, b) in driven.markers.velocities().iter().zip(imposed.markers.velocities()) {
        assert!((a - b).length() < 1e-12);
    }
}

#[test]
fn a_thin_film_converges() {
    // A gap of 0.05 to the upper wall.
    let tension = |t: f64| 1.0 + 0.5 * (t - 0.8).cos();
    let shape = Ellipse { viscosity: Some(5.0), ..Ellipse::circle(0.0, 0.45, tension) };
    let run = |nodes: usize| {
        let settings = Settings { nodes, tolerance: 1e-12, ..Settings::default() };
        let mut solver =
            BoundaryIntegral::new(Region::Channel { length: 8.0, width: 3.0, drive: Drive::default() }, 1.0, settings)
                .expect("a valid scene");
        let mut markers = markers(&[shape], 512);
        solver.velocities(&mut markers).expect("a valid scene");
        markers.velocities().to_vec()
    };
    let reference = run(320);
    let error = |velocities: &[Vec2]| -> f64 {
        velocities.iter().zip(&reference).map(|(a, b)| (a - b).length()).fold(0.0, f64::max)
    };
    let errors = [error(&run(64)), error(&run(96)), error(&run(128))];
    println!("{errors:?}");
    assert!(errors[0] < 1e-7 && errors[1] < 0.05 * errors[0] && errors[2] < 0.05 * errors[1], "{errors:?}");
}
