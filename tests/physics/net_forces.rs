//! Net forces and torques on droplets of other viscosities, by boundary integrals and by layers beside a grid.

use std::f64::consts::TAU;

use motile::base::Region;
use motile::base::{FlowSample, Vec2};
use motile::scene::{Hydrodynamics, MarkerKind, Markers};
use motile::setup::{AnyFlow, IntegralMethod, LayersMethod, Method};
use motile_tests::validation::contrast::Droplet;
use motile_tests::validation::scene::{flow, open_channel};

const REGIONS: [fn() -> Region; 2] = [|| Region::Box { lengths: [6.0; 2] }, || open_channel(6.0, 4.0)];

pub(crate) fn layers(region: Region, h: f64) -> AnyFlow {
    let method = LayersMethod { nodes: 128, elements: 512, ..LayersMethod::of_spacing(h) };
    flow(region, Method::Layers(method), 1.0, 1e-10).expect("a valid scene")
}

/// The scene with a force on a point, however small, so that layers need the grid.
pub(crate) fn beside_a_point(mut markers: Markers) -> Markers {
    let count = markers.len();
    markers.push_group(1, MarkerKind::Points);
    markers.positions_mut()[count] = Vec2::new(-2.5, 1.5);
    markers.forces_mut()[count] = Vec2::splat(1e-13);
    markers
}

fn integral(region: Region) -> AnyFlow {
    flow(region, Method::Integral(IntegralMethod { nodes: 128, elements: 512 }), 1.0, 1e-10).expect("a valid scene")
}

/// An ellipse and a circle a quarter apart.
fn pair(first: f64, second: f64) -> [Droplet; 2] {
    let ellipse = Droplet { axes: [0.9, 0.7], ..Droplet::circle(1, first).at(-0.95, 0.1) };
    [ellipse, Droplet { axes: [0.7; 2], ..Droplet::circle(2, second).at(0.9, -0.13) }]
}

/// The droplets with their tensions, and on each a net force and a torque (force per length and radius).
fn scene(droplets: &[Droplet; 2], spacing: f64, pulls: [[f64; 3]; 2]) -> Markers {
    let mut markers = Markers::new();
    for (droplet, [x, y, torque]) in droplets.iter().zip(pulls) {
        let start = markers.len();
        droplet.push_even(spacing, &mut markers).expect("enough markers");
        let count = markers.len() - start;
        let perimeter = TAU * (0.5 * (droplet.axes[0].powi(2) + droplet.axes[1].powi(2))).sqrt();
        let [positions, forces, _] = markers.lists_mut();
        for (position, force) in positions.iter().zip(forces).skip(start) {
            let [u, v] = [position.x - droplet.centre[0], position.y - droplet.centre[1]];
            *force += perimeter / count as f64 * Vec2::new(x - torque * v, y + torque * u);
        }
    }
    markers
}

fn work(forces: &Markers, velocities: &Markers) -> f64 {
    forces.forces().iter().zip(velocities.velocities()).map(|(force, velocity)| force.dot(*velocity)).sum()
}

/// The mean velocity of each droplet's markers.
pub(crate) fn means(markers: &Markers) -> [Vec2; 2] {
    [0, 1].map(|index| {
        let range = markers.groups()[index].range.clone();
        let count = range.len() as f64;
        markers.velocities()[range].iter().sum::<Vec2>() / count
    })
}

#[test]
fn droplets_are_pulled_as_fast_as_they_should() {
    for region in REGIONS {
        for ratios in [[300.0, 30.0], [0.05, 1.0], [1.1, 20.0]] {
            let droplets = pair(ratios[0], ratios[1]);
            let pulls = [[1.0, 0.3, 0.7], [-0.6, 0.2, -0.4]];
            let mut exact = scene(&droplets, TAU * 0.8 / 512.0, pulls);
            integral(region()).velocities(&mut exact).unwrap();
            let exact = means(&exact);
            let mut markers = beside_a_point(scene(&droplets, TAU * 0.8 / 512.0, pulls));
            layers(region(), 0.1).velocities(&mut markers).unwrap();
            for (found, exact) in means(&markers).iter().zip(&exact) {
                let error = (found - exact).length() / exact.length();
                assert!(error < 1e-5, "{:?} {ratios:?}: {error:e}", region());
            }
        }
    }
}

#[test]
fn two_sets_of_forces_do_the_same_work_on_each_others_flow() {
    for region in REGIONS {
        for ratios in [[300.0, 30.0], [0.05, 1.0], [1.1, 20.0]] {
            let droplets = pair(ratios[0], ratios[1]);
            let difference = |mut flow: AnyFlow, spacing: f64| {
                let mut one = scene(&droplets, spacing, [[1.0, 0.3, 0.7], [0.0; 3]]);
                let mut two = scene(&droplets, spacing, [[0.0; 3], [0.5, -0.8, 0.6]]);
                flow.velocities(&mut one).unwrap();
                flow.velocities(&mut two).unwrap();
                let scale = (work(&one, &one) * work(&two, &two)).sqrt();
                (work(&one, &two) - work(&two, &one)).abs() / scale
            };
            let integral = difference(integral(region()), TAU * 0.8 / 512.0);
            assert!(integral < 1e-9, "{:?} {ratios:?}: {integral}", region());
        }
    }
}

/// Twice the viscosity times the square of the rate of strain, summed over a lattice of points.
fn dissipation(flow: &mut AnyFlow, region: Region, markers: &Markers, droplets: &[Droplet; 2], count: u32) -> f64 {
    let lengths = match region {
        Region::Box { lengths } => lengths,
        Region::Channel { length, width, .. } => [length, width],
        _ => unreachable!("no finite dissipation"),
    };
    let place = |k: u32, length: f64| ((f64::from(k) + 0.5) / f64::from(count) - 0.5) * length;
    let points: Vec<Vec2> =
        (0..count * count).map(|k| Vec2::new(place(k % count, lengths[0]), place(k / count, lengths[1]))).collect();
    let mut samples = vec![FlowSample::default(); points.len()];
    flow.sample(markers, &points, &mut samples).expect("a valid scene");
    let area = lengths[0] * lengths[1] / points.len() as f64;
    let sum = points.iter().zip(&samples).map(|(point, sample)| {
        let inside = droplets.iter().find(|droplet| {
            let [x, y] =
                [(point.x - droplet.centre[0]) / droplet.axes[0], (point.y - droplet.centre[1]) / droplet.axes[1]];
            x * x + y * y < 1.0
        });
        let [[xx, xy], [yx, yy]] = sample.gradient;
        inside.map_or(1.0, |droplet| droplet.ratio) * (2.0 * (xx * xx + yy * yy) + (xy + yx) * (xy + yx)) * area
    });
    sum.sum()
}

#[test]
fn the_work_of_net_forces_is_dissipated() {
    for region in REGIONS {
        for ratios in [[300.0, 30.0], [0.05, 1.0], [1.1, 20.0]] {
            let droplets = pair(ratios[0], ratios[1]);
            let pulls = [[1.0, 0.3, 0.7], [-0.6, 0.2, -0.4]];
            let ratio = |mut flow: AnyFlow, spacing: f64, count: u32| {
                let mut markers = scene(&droplets, spacing, pulls);
                flow.velocities(&mut markers).unwrap();
                dissipation(&mut flow, region(), &markers, &droplets, count) / work(&markers, &markers) - 1.0
            };
            let integral = ratio(integral(region()), TAU * 0.8 / 512.0, 200);
            assert!(integral.abs() < 2e-3, "{:?} {ratios:?}: {integral}", region());
        }
    }
}

#[test]
fn velocities_are_continuous_where_the_ratio_passes_through_one() {
    for region in REGIONS {
        let velocities = |ratio: f64| {
            let mut markers = scene(&pair(ratio, 1.0), TAU * 0.8 / 512.0, [[1.0, 0.3, 0.7], [-0.6, 0.2, -0.4]]);
            integral(region()).velocities(&mut markers).unwrap();
            markers.velocities().to_vec()
        };
        let equal = velocities(1.0);
        let largest = equal.iter().map(|v| v.length()).fold(0.0, f64::max);
        for change in [-1e-2, -1e-4, -1e-6, -1e-12, f64::EPSILON, 1e-14, 1e-9, 1e-4, 1e-2] {
            let moved = velocities(1.0 + change).iter().zip(&equal).map(|(a, b)| (a - b).length()).fold(0.0, f64::max);
            // Proportional to the change, up to the tolerance of the iterations.
            assert!(moved < (0.3 * change.abs() + 1e-7) * largest, "{change:e}: {:e}", moved / largest);
            assert!(moved > 0.05 * (change.abs() - 1e-7) * largest, "{change:e}: {:e}", moved / largest);
        }
    }
}
