//! Interfaces inside one another.

use crate::scenes;

use motile_base::{FlowSample, Region, Vec2};
use motile_boundary_integrals::{BoundaryIntegral, Settings};
use motile_scene::{Hydrodynamics, Markers};
use scenes::{Ellipse, markers};

const COUNT: usize = 192;

fn solver(region: Region, nodes: usize) -> BoundaryIntegral {
    let settings = Settings { nodes, tolerance: 1e-13, ..Settings::default() };
    BoundaryIntegral::new(region, 1.0, settings).expect("a valid scene")
}

/// An interface inside another one, whose inner viscosity it has around it.
fn nested([outer, inner]: [Ellipse; 2]) -> Markers {
    let mut markers = markers(&[outer, inner], COUNT);
    markers.set_viscosity_outside(1, outer.viscosity).expect("a viscosity");
    markers
}

/// Velocity of the centroid of a circle around the origin.
fn centroid_velocity(markers: &Markers, group: usize) -> Vec2 {
    let range = markers.groups()[group].range.clone();
    let count = range.len() as f64;
    let normals = markers.positions()[range.clone()].iter().map(|position| position.normalize());
    normals.zip(&markers.velocities()[range]).map(|(n, v)| 2.0 * v.dot(n) * n).sum::<Vec2>() / count
}

/// A droplet of radius 1 with the tension 1 + cos theta, exterior viscosity 1, around a concentric one of radius rho
/// and constant tension: with beta = (core - middle)/(core + middle), `U = -1/(4 (1 + middle (1 + beta rho^4)/(1 - beta
/// rho^4)))` and `V/U = (2 - rho^2 (1 + beta))/(1 - beta rho^4)`.
#[test]
fn three_viscosities_around_one_centre() {
    for (middle, core) in [(10.0, 0.5), (0.1, 10.0), (3.0, 3.0), (1.0, 100.0), (100.0, 1.0), (30.0, 3e3)] {
        for rho in [0.3_f64, 0.7, 0.9] {
            let outer = Ellipse { viscosity: Some(middle), ..Ellipse::circle(0.0, 0.0, |t| 1.0 + t.cos()) };
            let inner = Ellipse { axes: [rho; 2], viscosity: Some(core), ..Ellipse::circle(0.0, 0.0, |_| 1.0) };
            let mut markers = nested([outer, inner]);
            solver(Region::Plane, 128).velocities(&mut markers).unwrap();
            let beta = (core - middle) / (core + middle);
            let shape = beta * rho.powi(4);
            let speed = -0.25 / (1.0 + middle * (1.0 + shape) / (1.0 - shape));
            let ratio = (2.0 - rho * rho * (1.0 + beta)) / (1.0 - shape);
            for (group, expected) in [(0, speed), (1, ratio * speed)] {
                let error = (centroid_velocity(&markers, group) - Vec2::new(expected, 0.0)).length() / speed.abs();
                assert!(error < 1e-9, "{middle} {core} {rho} {group}: {error:e}");
            }
        }
    }
}

/// An interface without tension between equal fluids moves with the fluid there, whatever is outside.
#[test]
fn an_interface_that_is_none_moves_with_the_fluid() {
    let channel = Region::Channel { length: 6.0, width: 3.0, drive: motile_base::Drive::ZeroGradient };
    for region in [Region::Plane, Region::Box { lengths: [6.0, 5.0] }, channel] {
        let outer = Ellipse { viscosity: Some(0.1), axes: [1.1, 0.9], ..Ellipse::circle(0.1, 0.2, |t| 1.0 + t.cos()) };
        let inner = Ellipse { axes: [0.3, 0.2], ..Ellipse::circle(0.4, 0.3, |_| 0.0) };
        let mut markers = nested([outer, inner]);
        let mut flow = solver(region, 96);
        flow.velocities(&mut markers).unwrap();
        let mut alone = scenes::markers(&[outer], COUNT);
        flow.velocities(&mut alone).unwrap();
        let mut seen = vec![FlowSample::default(); COUNT];
        flow.sample(&alone, &markers.positions()[COUNT..], &mut seen).unwrap();
        let fastest = alone.velocities().iter().map(|v| v.length()).fold(0.0, f64::max);
        for (velocity, sample) in markers.velocities()[COUNT..].iter().zip(&seen) {
            assert!((velocity - sample.velocity).length() < 1e-10 * fastest, "{region:?}");
        }
    }
}

/// Off the centre, close to the outer interface, with forces that do not balance: the work of one set of forces on the
/// velocities of another is that of the other on the one, and errors fall with the number of nodes.
#[test]
fn reciprocity_and_convergence() {
    for (region, bounds) in [(Region::Plane, [1e-4, 1e-8]), (Region::Box { lengths: [5.0; 2] }, [1e-4, 1e-8])] {
        let outer = Ellipse { viscosity: Some(20.0), axes: [1.2, 0.9], ..Ellipse::circle(0.0, 0.0, |t| 1.0 + t.cos()) };
        let inner =
            Ellipse { viscosity: Some(0.4), axes: [0.4, 0.5], ..Ellipse::circle(0.55, 0.1, |t| 2.0 - (t + 0.3).sin()) };
        let solved = |nodes: usize, pull: f64| {
            let mut markers = nested([outer, inner]);
            for force in &mut markers.forces_mut()[COUNT..] {
                *force += pull / COUNT as f64 * Vec2::new(1.0, -0.5);
            }
            solver(region, nodes).velocities(&mut markers).unwrap();
            markers
        };
        let [one, other] = [solved(160, 0.0), solved(160, 3.0)];
        let work = |forces: &Markers, velocities: &Markers| -> f64 {
            forces.forces().iter().zip(velocities.velocities()).map(|(f, v)| f.dot(*v)).sum()
        };
        let (there, back) = (work(&one, &other), work(&other, &one));
        assert!((there - back).abs() < 1e-9 * work(&other, &other), "{there} {back}");
        let fastest = other.velocities().iter().map(|v| v.length()).fold(0.0, f64::max);
        for (nodes, bound) in [48, 96].into_iter().zip(bounds) {
            let coarse = solved(nodes, 3.0);
            let differences = coarse.velocities().iter().zip(other.velocities()).map(|(a, b)| (a - b).length());
            let error = differences.fold(0.0, f64::max) / fastest;
            assert!(error < bound, "{region:?} {nodes}: {error:e}");
        }
    }
}
