//! Several swimmers at once.

use std::f64::consts::TAU;

use motile::active_interface::{ActiveDroplet, polygon_moments};
use motile::base::Region;
use motile::base::Vec2;
use motile::scene::{Handle, Hydrodynamics, Scene, gap::Boundary};
use motile::setup::{AnyFlow, Built, DropletSetup, Setup};

use crate::validation::StudyError;

/// Fate of several swimmers.
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
}

/// Two swimmers like the first of a scene, of radius one, in unbounded fluid, that come towards each other along lines
/// `2 + offset` apart, to `time`. Each starts 2.5 from the middle.
///
/// # Errors
/// Those of a run.
pub fn passing(base: &Setup, offset: f64, time: f64) -> Result<Several, StudyError> {
    let height = 1.0 + 0.5 * offset;
    run(base, Region::Plane, &[([-2.5, height], 0.0), ([2.5, -height], 0.5 * TAU)], time)
}

/// Ten swimmers like the first of a scene in its square box, in two rows and a half, each with a heading of its own, to
/// `time`.
///
/// # Errors
/// Those of a run.
pub fn ten_in_a_box(base: &Setup, time: f64) -> Result<Several, StudyError> {
    let [side, _] = base.region.lengths();
    let places: Vec<_> = (0..10)
        .map(|k| {
            let (row, column) = (f64::from(k / 4), f64::from(k % 4));
            let shift = if k / 4 == 1 { 0.5 } else { 0.0 };
            // Golden angles: no two alike.
            ([(column + shift) * side / 4.0, row * side / 3.0], 2.399_963 * f64::from(k))
        })
        .collect();
    run(base, base.region, &places, time)
}

fn run(base: &Setup, region: Region, places: &[([f64; 2], f64)], time: f64) -> Result<Several, StudyError> {
    let placed = |&(centre, angle)| DropletSetup { centre, angle, ..base.droplets[0].clone() };
    let setup = Setup { region, droplets: places.iter().map(placed).collect(), ..base.clone() };
    let Built { mut scene, droplets, .. } = setup.build()?;
    let periods = scene.system().hydrodynamics().fluid_view().domain.periods;
    let particles = |scene: &Scene<AnyFlow>, droplet: Handle<ActiveDroplet>| -> Result<f64, StudyError> {
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
                let gap = Boundary::of(scene.body(other)?, periods).smallest(body.markers(), periods);
                least = gap.map_or(least, |(gap, _)| least.min(gap));
            }
        }
    }
    let centroids = droplets
        .iter()
        .map(|&droplet| Ok(polygon_moments(scene.body(droplet)?.markers())?.centroid))
        .collect::<Result<_, StudyError>>()?;
    let work = scene.system().hydrodynamics().work();
    let iterations = work.iterations as f64 / work.evaluations as f64;
    Ok(Several { centroids, gap: least, area_change, particle_change, iterations })
}
