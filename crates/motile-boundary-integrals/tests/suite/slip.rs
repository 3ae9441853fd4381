//! Straight walls along which fluid slips.

use crate::scenes;

use std::f64::consts::{PI, TAU};

use motile_base::{Drive, FlowSample, ImposedFlow, Region, SolveReport, Vec2};
use motile_boundary_integrals::{BoundaryIntegral, RigidWall, Settings};
use motile_scene::{Hydrodynamics, Markers};
use scenes::{Ellipse, markers};

const COUNT: usize = 256;

fn channel(length: f64, width: f64, drive: Drive, slip: [f64; 2]) -> BoundaryIntegral {
    let region = Region::Channel { length, width, drive }.with_slip(slip);
    let settings = Settings { nodes: 128, tolerance: 1e-14, ..Settings::default() };
    BoundaryIntegral::new(region, 1.0, settings).expect("a channel")
}

fn at(solver: &mut BoundaryIntegral, markers: &Markers, points: &[Vec2]) -> Vec<FlowSample> {
    let mut out = vec![FlowSample::default(); points.len()];
    solver.sample(markers, points, &mut out).expect("a valid scene");
    out
}

/// Flux through the line at x, by the rule of Clenshaw and Curtis over the height.
fn flux(solver: &mut BoundaryIntegral, markers: &Markers, x: f64) -> f64 {
    const N: usize = 48;
    let half = 0.5 * solver.region().lengths()[1];
    let angle = |k: usize| PI * k as f64 / N as f64;
    let points: Vec<Vec2> = (0..=N).map(|k| Vec2::new(x, half * angle(k).cos())).collect();
    let samples = at(solver, markers, &points);
    let weight = |k: usize| {
        let terms = (1..=N / 2).map(|j| {
            let factor = if 2 * j == N { 1.0 } else { 2.0 };
            factor * (2.0 * j as f64 * angle(k)).cos() / (4 * j * j - 1) as f64
        });
        (1.0 - terms.sum::<f64>()) * if k == 0 || k == N { 1.0 } else { 2.0 } / N as f64
    };
    half * samples.iter().enumerate().map(|(k, sample)| weight(k) * sample.velocity.x).sum::<f64>()
}

/// Velocity of the centroid of the unit circle along x: the mean of `2 cos(t) v.n`.
fn speed(markers: &Markers) -> f64 {
    let terms = markers.velocities().iter().enumerate().map(|(k, v)| {
        let (sin, cos) = (TAU * k as f64 / COUNT as f64).sin_cos();
        2.0 * cos * (v.x * cos + v.y * sin)
    });
    terms.sum::<f64>() / COUNT as f64
}

/// Velocities from an independent boundary-integral program (error 1e-12), period, width, height, slip of both walls;
/// and the flux `-pi gamma_1 R^2/(4 l eta)`, which does not depend on slip.
#[test]
fn a_circle_in_a_channel_with_slip() {
    let cases = [
        (6.0, 3.0, 0.0, 0.0, Some(-0.053_127_727_068)),
        (6.0, 3.0, 0.0, 0.05, Some(-0.054_177_027_970)),
        (6.0, 3.0, 0.0, 0.5, Some(-0.058_015_464_223)),
        (6.0, 3.0, 0.0, 10.0, Some(-0.061_184_466_197)),
        (6.0, 3.0, 0.0, 1e6, None),
        (6.0, 3.0, 0.3, 0.05, Some(-0.054_124_216_680)),
        (6.0, 3.0, 0.3, 0.5, Some(-0.057_144_217_131)),
        (12.0, 2.4, 0.0, 0.05, Some(-0.029_316_309_697)),
        (12.0, 2.4, 0.0, 0.5, Some(-0.035_338_785_056)),
    ];
    for (length, width, height, slip, expected) in cases {
        let circle = Ellipse::circle(0.0, height, |t| 1.0 + 0.5 * t.cos());
        let mut solver = channel(length, width, Drive::ZeroGradient, [slip; 2]);
        let mut markers = markers(&[circle], COUNT);
        solver.velocities(&mut markers).expect("a valid scene");
        if let Some(expected) = expected {
            let found = speed(&markers);
            assert!((found - expected).abs() < 2e-12, "{length} {width} {height} {slip}: {found} {expected}");
        }
        let found = flux(&mut solver, &markers, 2.3);
        let expected = -PI * 0.5 / (4.0 * length);
        let round_off = 1e-12 + 1e-15 * slip;
        assert!((found - expected).abs() < round_off, "{length} {width} {height} {slip}: flux {found} {expected}");
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

/// Slip at both walls, prescribed drives and the balance of forces with other viscosities and walls that slide.
#[test]
fn droplets_between_unlike_walls_that_slide() {
    for slip in [[0.1, 0.1], [0.3, 0.0], [0.05, 2.0]] {
        for (drive, sliding) in [
            (Drive::ZeroGradient, [0.0; 2]),
            (Drive::Gradient(-0.4), [0.2, -0.1]),
            (Drive::ZeroFlux, [0.2, -0.1]),
            (Drive::Flux(0.7), [0.0; 2]),
        ] {
            let (length, width) = (7.0, 3.2);
            let mut solver = channel(length, width, drive, slip);
            solver.impose(ImposedFlow::couette_with_slip(sliding, width, slip), 0.0).expect("a channel");
            let mut markers = markers(&contrasting(), COUNT);
            let SolveReport { mean_pressure_gradient: [gradient, _], .. } =
                solver.velocities(&mut markers).expect("a valid scene");
            let mut shear = [0.0; 2];
            for (wall, out) in [-1.0, 1.0].into_iter().enumerate() {
                let points: Vec<Vec2> = (0..128).map(|k| Vec2::new(length * f64::from(k) / 128.0, out * 1.6)).collect();
                for sample in at(&mut solver, &markers, &points) {
                    let slope = sample.gradient[0][1];
                    let error = sample.velocity.x - sliding[wall] + slip[wall] * out * slope;
                    assert!(error.abs() < 1e-11, "{slip:?} {drive:?} wall {wall}: {error:e}");
                    assert!(sample.velocity.y.abs() < 1e-11, "{}", sample.velocity);
                    shear[wall] += slope * length / 128.0;
                }
            }
            let balance = shear[1] - shear[0] - gradient * length * width;
            assert!(balance.abs() < 1e-11, "{slip:?} {drive:?}: {balance:e}");
            if let Some(expected) = drive.flux() {
                let found = flux(&mut solver, &markers, -2.0);
                assert!((found - expected).abs() < 1e-11, "{slip:?} {drive:?}: {found}");
            }
        }
    }
}

/// Couette and Poiseuille flow of fluid alone, to round-off, also with lengths of micrometres.
#[test]
fn plane_flows_slip() {
    for unit in [1.0, 1e-6] {
        for (width, [lower, upper]) in [(2.0, [0.1, 0.1]), (3.0, [0.2, 1.0]), (3.0, [0.0, 5.0])] {
            let (width, slip) = (width * unit, [lower * unit, upper * unit]);
            let sum = width + slip[0] + slip[1];
            let heights: Vec<Vec2> =
                (0..=10).map(|j| Vec2::new(0.3 * unit, width * (0.1 * f64::from(j) - 0.5))).collect();
            let empty = Markers::new();
            // Poiseuille: G = 1, y from the lower wall.
            let mut solver = channel(6.0 * unit, width, Drive::Gradient(-1.0), slip);
            solver.velocities(&mut empty.clone()).expect("a channel");
            let p = (0.5 * width * width + slip[1] * width) / sum;
            for (place, sample) in heights.iter().zip(at(&mut solver, &empty, &heights)) {
                let y = place.y + 0.5 * width;
                let expected = -0.5 * y * y + p * (y + slip[0]);
                assert!((sample.velocity.x - expected).abs() < 1e-13 * width * sum, "{} {expected}", sample.velocity.x);
            }
            let through = flux(&mut solver, &empty, 0.0);
            let expected = -width.powi(3) / 6.0 + p * (0.5 * width * width + slip[0] * width);
            assert!((through / expected - 1.0).abs() < 1e-13, "{through} {expected}");
            let mut held = channel(6.0 * unit, width, Drive::Flux(expected), slip);
            let report = held.velocities(&mut empty.clone()).expect("a channel");
            assert!((report.mean_pressure_gradient[0] + 1.0).abs() < 1e-13, "{:?}", report.mean_pressure_gradient);
            // Couette.
            let mut solver = channel(6.0 * unit, width, Drive::ZeroGradient, slip);
            solver.impose(ImposedFlow::couette_with_slip([0.0, unit], width, slip), 0.0).expect("a channel");
            for (place, sample) in heights.iter().zip(at(&mut solver, &empty, &heights)) {
                let expected = unit * (place.y + 0.5 * width + slip[0]) / sum;
                assert!((sample.velocity.x - expected).abs() < 1e-13 * unit);
                assert!((sample.gradient[0][1] - unit / sum).abs() < 1e-13);
            }
        }
    }
}

/// Sums over many nodes by transforms, which correct a box in place of a row, give the same flow.
#[test]
fn fast_sums_slip_too() {
    let shape = |x: f64, y: f64| Ellipse { viscosity: Some(5.0), ..Ellipse::circle(x, y, |t| 1.0 + 0.5 * t.cos()) };
    let shapes: Vec<Ellipse> =
        (0..45).map(|k| shape(-48.0 + 2.2 * f64::from(k), 0.3 * f64::from(k % 3) - 0.2)).collect();
    let run = |tolerance: f64| {
        let region = Region::Channel { length: 100.0, width: 3.2, drive: Drive::ZeroFlux }.with_slip([0.4, 0.1]);
        let settings = Settings { nodes: 48, tolerance, ..Settings::default() };
        let mut solver = BoundaryIntegral::new(region, 1.0, settings).expect("a channel");
        let mut markers = markers(&shapes, 48);
        solver.velocities(&mut markers).expect("a valid scene");
        markers.velocities().to_vec()
    };
    // Tolerances of round-off are summed directly.
    let (fast, direct) = (run(1e-9), run(1e-15));
    let largest = direct.iter().map(|v| v.length()).fold(0.0, f64::max);
    let error = fast.iter().zip(&direct).map(|(a, b)| (a - b).length()).fold(0.0, f64::max);
    assert!(error > 0.0 && error < 1e-7 * largest, "{error:e} {largest:e}");
}

#[test]
fn slip_behind_curved_walls_is_refused() {
    let walls = [RigidWall::post(Vec2::ZERO, 0.5, 48).expect("a disc")];
    let refused = channel(6.0, 3.0, Drive::ZeroGradient, [0.1; 2]).with_walls(&walls);
    let text = refused.err().map(|error| error.to_string()).unwrap_or_default();
    assert!(text.contains("slip"), "{text}");
}

/// Resistance of a layer of fluid beside a wall with slip, over `2 k eta`, from its streamfunction: A, B and C of the
/// force `[[A, C], [C, B]]` per velocity `(u sin kx, v cos kx)` of the fluid below.
fn resistance(k: f64, thickness: f64, slip: f64) -> [f64; 3] {
    let (s, b) = (k * thickness, 2.0 * k * slip);
    let (sinh, cosh) = (s.sinh(), s.cosh());
    let over = sinh * sinh - s * s + b * (sinh * cosh - s);
    let a = sinh * cosh - s + b * sinh * sinh;
    [a / over, (sinh * cosh + s + b * cosh * cosh) / over, (s * s + b * s) / over]
}

/// A flat interface between walls with unlike slip lengths, and fluids of unlike viscosities.
#[test]
fn a_flat_interface_between_walls_with_slip() {
    let (below, above, period, slip) = (0.6, 2.0, TAU / 1.5, [0.1, 0.7]);
    let (k, height) = (TAU / period, 0.5 * (below - above));
    for inside in [None, Some(4.0)] {
        let mut solver = channel(period, below + above, Drive::ZeroGradient, slip);
        let mut markers = Markers::new();
        let kind = motile_scene::MarkerKind::OpenInterface { viscosity_inside: inside, advance: period };
        markers.push_group(COUNT, kind);
        let x = |j: usize| period * j as f64 / COUNT as f64;
        let (along, across) = (0.7, -0.4);
        let [positions, forces, _] = markers.lists_mut();
        for (j, (position, force)) in positions.iter_mut().zip(forces).enumerate() {
            let weight = period / COUNT as f64;
            *position = Vec2::new(x(j), height);
            *force = weight * Vec2::new(along * (k * x(j)).sin(), across * (k * x(j)).cos());
        }
        solver.velocities(&mut markers).expect("a valid scene");
        let ([a, b, c], [d, e, f]) = (resistance(k, below, slip[0]), resistance(k, above, slip[1]));
        let ratio = inside.unwrap_or(1.0);
        let [xx, xy, yy] = [a + ratio * d, c - ratio * f, b + ratio * e].map(|entry| 2.0 * k * entry);
        let determinant = xx * yy - xy * xy;
        let [u, v] = [(yy * along - xy * across) / determinant, (xx * across - xy * along) / determinant];
        for (j, velocity) in markers.velocities().iter().enumerate() {
            let exact = Vec2::new(u * (k * x(j)).sin(), v * (k * x(j)).cos());
            assert!((velocity - exact).length() < 1e-11, "{inside:?} {j}: {velocity} {exact}");
        }
    }
}
