//! Several swimmers at once.

use std::f64::consts::TAU;

use motile::Swimmer;
use motile::active_interface::{ActiveDroplet, Curve, InitialConcentration, curve::polygon_moments};
use motile::boundary_integral::{BoundaryIntegral, Region, Settings};
use motile::ib_core::{Handle, Scene, Vec2};

use crate::validation::StudyError;

/// What became of several swimmers.
#[derive(Debug, Clone, PartialEq)]
pub struct Several {
    /// Centroids at the end (length).
    pub centroids: Vec<Vec2>,
    /// Smallest gap between two of them, seen at intervals (length).
    pub gap: f64,
    /// Largest relative change of an area.
    pub area_change: f64,
    /// Largest relative change of a particle number.
    pub particle_change: f64,
    /// Iterations an evaluation, on average.
    pub iterations: f64,
    /// Time steps.
    pub steps: usize,
}

/// Two swimmers in unbounded fluid that come towards each other along lines `2 + offset` apart, to `time`. Each starts
/// 2.5 from the middle.
///
/// # Errors
/// What a run can fail with.
pub fn passing(swimmer: &Swimmer, offset: f64, time: f64) -> Result<Several, StudyError> {
    let height = swimmer.radius + 0.5 * offset;
    let places = [(Vec2::new(-2.5, height), 0.0), (Vec2::new(2.5, -height), 0.5 * TAU)];
    run(swimmer, Region::Plane, &places, [None; 2], time)
}

/// Ten swimmers in a square box of the side `swimmer.lengths[0]`, in two rows and a half, each with a heading of its
/// own, to `time`.
///
/// # Errors
/// What a run can fail with.
pub fn ten_in_a_box(swimmer: &Swimmer, time: f64) -> Result<Several, StudyError> {
    let side = swimmer.lengths[0];
    let places: Vec<_> = (0..10)
        .map(|k| {
            let (row, column) = (f64::from(k / 4), f64::from(k % 4));
            let shift = if k / 4 == 1 { 0.5 } else { 0.0 };
            // Golden angles: no two alike.
            (Vec2::new((column + shift) * side / 4.0, row * side / 3.0), 2.399_963 * f64::from(k))
        })
        .collect();
    run(swimmer, Region::Box { lengths: [side, side] }, &places, [Some(side); 2], time)
}

fn run(
    swimmer: &Swimmer,
    region: Region,
    places: &[(Vec2, f64)],
    periods: [Option<f64>; 2],
    time: f64,
) -> Result<Several, StudyError> {
    let settings = Settings { nodes: swimmer.nodes, ..Settings::default() };
    let flow = BoundaryIntegral::new(region, swimmer.viscosity, settings)?;
    let mut scene = Scene::new(flow).with_step_size(swimmer.step);
    let mut droplets: Vec<Handle<ActiveDroplet>> = Vec::new();
    for &(centre, heading) in places {
        let curve = Curve::circle(swimmer.radius)?.rotated(heading).translated(centre);
        let markers = curve.markers(swimmer.concentration_cells)?;
        let numbers =
            InitialConcentration::polarised(swimmer.mean_concentration, heading)?.particle_numbers(&markers)?;
        let droplet = ActiveDroplet::new(&markers, numbers, swimmer.tension()?, swimmer.diffusion)?;
        droplets.push(scene.add(match swimmer.viscosity_inside {
            Some(inside) => droplet.with_viscosity_inside(inside)?,
            None => droplet,
        }));
    }
    let particles = |scene: &Scene<_>, droplet: Handle<ActiveDroplet>| -> Result<f64, StudyError> {
        Ok(scene.body(droplet)?.particle_numbers().iter().sum())
    };
    let start = droplets.iter().map(|&droplet| particles(&scene, droplet)).collect::<Result<Vec<_>, _>>()?;
    let (mut least, mut area_change, mut particle_change) = (f64::INFINITY, 0.0_f64, 0.0_f64);
    let looks = (4.0 * time).ceil() as u32;
    for look in 1..=looks {
        scene.run(time * f64::from(look) / f64::from(looks)).go()?;
        for (k, &droplet) in droplets.iter().enumerate() {
            let body = scene.body(droplet)?;
            area_change = area_change.max((polygon_moments(body.markers())?.area / body.initial_area() - 1.0).abs());
            particle_change = particle_change.max((particles(&scene, droplet)? / start[k] - 1.0).abs());
            for &other in &droplets[..k] {
                least = least.min(gap(body.markers(), scene.body(other)?.markers(), periods));
            }
        }
    }
    let centroids = droplets
        .iter()
        .map(|&droplet| Ok(polygon_moments(scene.body(droplet)?.markers())?.centroid))
        .collect::<Result<_, StudyError>>()?;
    let work = motile::ib_core::Hydrodynamics::work(scene.system().hydrodynamics());
    let iterations = work.iterations as f64 / work.evaluations as f64;
    Ok(Several { centroids, gap: least, area_change, particle_change, iterations, steps: scene.steps() })
}

/// Smallest distance of the markers of one droplet from the sides of another, the closest image of it.
fn gap(first: &[Vec2], second: &[Vec2], periods: [Option<f64>; 2]) -> f64 {
    let middle = |points: &[Vec2]| points.iter().sum::<Vec2>() / points.len() as f64;
    let between = middle(second) - middle(first);
    let shift = Vec2::from([0, 1].map(|i| periods[i].map_or(0.0, |period| (between[i] / period).round() * period)));
    let mut least = f64::INFINITY;
    for point in first.iter().map(|point| point + shift) {
        for (k, from) in second.iter().enumerate() {
            let along = second[(k + 1) % second.len()] - from;
            let t = ((point - from).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
            least = least.min((point - from - t * along).norm_squared());
        }
    }
    least.sqrt()
}
