//! Scenes of interfaces alone: against exact rates and reference values, several droplets, the seam of a box.

use std::f64::consts::TAU;

use motile::active_interface::{ActiveDroplet, polygon_moments};
use motile::base::{Region, Vec2};
use motile::scene::{Handle, Hydrodynamics, Scene, gap::Boundary};
use motile::setup::{AnyFlow, Built, DropletSetup, Setup};
use motile_tests::validation::StudyError;
use motile_tests::validation::growth::{Mode, rate_in_plane_limit};
use motile_tests::validation::interfaces::relax;
use motile_tests::validation::scene::{open_channel, reference, without_grid};
use motile_tests::validation::swimmers::{steady, transient};

#[test]
fn ellipse_to_1e_7_and_second_order_in_time() {
    for ratio in [1, 10] {
        let [coarse, fine] = [0.01, 0.0025].map(|dt| relax(ratio, 64, 256, dt).unwrap());
        assert!(fine.aspect_ratio.abs() < 1e-7 && fine.tip.abs() < 1e-7, "ratio {ratio}: {fine:?}");
        let order = (coarse.aspect_ratio / fine.aspect_ratio).log2() / 2.0;
        assert!((order - 2.0).abs() < 0.02, "ratio {ratio}: order {order}");
        assert!(fine.area_change.abs() < 1e-8, "ratio {ratio}: {fine:?}");
    }
}

#[test]
fn growth_rates_to_1e_6() {
    for (inside, viscosity) in [(100.0, 100.0), (1000.0, 10.0), (10.0, 100.0)] {
        // At activity -1, and at the threshold (2.20), where the rate is zero.
        for activity in [-1.0, -0.002 * (inside + viscosity)] {
            let droplet = DropletSetup { viscosity: Some(inside), ..DropletSetup::active(activity) };
            let setup = Setup { viscosity, droplets: vec![droplet], ..Setup::default() };
            let theory = Mode::Concentration(1).theory(&setup).unwrap();
            let rate = rate_in_plane_limit(&setup, Mode::Concentration(1), 48, 384).unwrap();
            // A part in a million of the diffusion constant.
            assert!((rate - theory).abs() < 1e-7, "{inside}/{viscosity} {activity}: {rate} {theory}");
        }
    }
}

#[test]
fn transient_at_the_default() {
    let (error, time) = transient(&reference(Setup::default(), -1.0)).unwrap();
    assert!(error.abs() < 2e-4, "{error} at {time}");
}

#[test]
fn swimmer_between_walls_at_the_default() {
    let errors = steady(&Setup { region: open_channel(12.0, 3.0), ..Setup::default() }, 60.0).unwrap();
    assert!(errors.speed.abs() < 1e-3 && errors.aspect_ratio.abs() < 1e-4, "{errors:?}");
    assert!(errors.stresslet.abs() < 0.002 && errors.beta.abs() < 5e-3, "{errors:?}");
    assert!(errors.gap.unwrap().abs() < 4e-5 && errors.flux.unwrap().abs() < 1e-3, "{errors:?}");
}

/// Fate of several swimmers.
#[derive(Debug, Clone, PartialEq)]
struct Several {
    /// Centroids at the end (length).
    centroids: Vec<Vec2>,
    /// Smallest gap between two of them, seen at intervals (length).
    gap: f64,
    /// Largest relative change of an area.
    area_change: f64,
    /// Largest relative change of a particle number.
    particle_change: f64,
    /// Iterations an evaluation, on average.
    iterations: f64,
}

/// Two swimmers like the first of a scene, of radius one, in unbounded fluid, that come towards each other along lines
/// `2 + offset` apart, to `time`. Each starts 2.5 from the middle.
fn passing(base: &Setup, offset: f64, time: f64) -> Result<Several, StudyError> {
    let height = 1.0 + 0.5 * offset;
    run(base, Region::Plane, &[([-2.5, height], 0.0), ([2.5, -height], 0.5 * TAU)], time)
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

/// Two droplets that pass closely, of equal viscosities and a hundred times as viscous as the exterior fluid.
#[test]
fn two_that_pass() {
    let thick = DropletSetup { viscosity: Some(1000.0), ..DropletSetup::active(-7.0) };
    let thick = Setup { viscosity: 10.0, droplets: vec![thick], ..without_grid(64, 256) };
    for (setup, offset, time) in [(without_grid(64, 256), EQUAL, 22.0), (thick, THICK, 26.0)] {
        let run = passing(&setup, offset, time).unwrap();
        assert!((0.03..0.07).contains(&run.gap), "{run:?}");
        assert!(run.area_change < 1e-5 && run.particle_change < 1e-12, "{run:?}");
        // A half turn about the middle exchanges them.
        assert!((run.centroids[0] + run.centroids[1]).length() < 1e-5, "{run:?}");
    }
}

#[test]
fn seams_do_not_show() {
    let [middle, corner] = [[0.0, 0.0], [2.9, 2.8]].map(|centre| {
        let droplet = DropletSetup { angle: 0.4, centre, ..DropletSetup::active(-4.0) };
        let setup = Setup { droplets: vec![droplet], ..without_grid(64, 256) };
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        scene.run(6.0).go().unwrap();
        let seen = scene.observe(droplets[0]).unwrap();
        (seen.centroid.x - centre[0], seen.centroid.y - centre[1], seen.speed())
    });
    assert!(corner.0 + 2.9 > 3.0 && corner.1 + 2.8 > 3.0, "{corner:?}");
    assert!((middle.0 - corner.0).abs() < 1e-7 && (middle.1 - corner.1).abs() < 1e-7, "{middle:?} {corner:?}");
    assert!((middle.2 - corner.2).abs() < 1e-7, "{middle:?} {corner:?}");
}

/// Distances of the lines on which two swimmers come towards each other, less two radii.
const EQUAL: f64 = 0.0;
const THICK: f64 = 0.14;
