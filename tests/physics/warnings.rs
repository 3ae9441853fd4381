//! Runs warn of what they do not resolve, and of nothing else.

use std::f64::consts::TAU;

use motile::motile_base::Drive;
use motile::motile_base::Region;
use motile::motile_scene::{Every, Warnings};
use motile::setup::{Built, DropletSetup, DropletShape, GridMethod, Method, Particles, Setup};

/// The causes that a run of `setup` warns of, in the order of their names.
fn causes(setup: &Setup, time: f64) -> Vec<String> {
    let Built { mut scene, .. } = setup.build().expect("a valid setup");
    let mut warnings = Warnings::default();
    scene.run(time).observe(Every::Steps(1), &mut warnings).go().expect("a run");
    assert!(warnings.worst().iter().all(|(_, warning)| warning.excess > 1.0), "{warnings:?}");
    let mut causes: Vec<_> = warnings.worst().iter().map(|(_, warning)| warning.cause.to_string()).collect();
    causes.sort_unstable();
    causes
}

/// The causes but that of stresslets, which a tenth of the radius resolves in wide channels alone.
fn but_stresslets(setup: &Setup, time: f64) -> Vec<String> {
    causes(setup, time).into_iter().filter(|cause| cause != "stresslet not resolved").collect()
}

fn channel(width: f64, method: Method, activity: f64) -> Setup {
    let region = Region::Channel { length: 6.0, width, drive: Drive::ZeroGradient };
    Setup { region, method, droplets: vec![DropletSetup::active(activity)], ..Setup::default() }
}

fn grid(spacing: f64) -> Method {
    Method::Grid(GridMethod::of_spacing(spacing))
}

#[test]
fn what_is_resolved_gives_no_warning() {
    assert!(causes(&Setup::default(), 1.0).is_empty());
    assert!(causes(&Setup { method: grid(0.05), ..Setup::default() }, 1.0).is_empty());
    assert!(causes(&channel(3.0, Method::default(), -2.0), 1.0).is_empty());
}

#[test]
fn thin_films_edges_and_small_droplets_are_told() {
    assert_eq!(but_stresslets(&channel(2.1, grid(0.1), -1.0), 0.2), ["thin film"]);
    // A closed channel of width 2.6 is 4 % off at gaps of three spacings, an open one 0.3 %.
    assert!(but_stresslets(&channel(2.6, grid(0.1), -1.5), 0.2).is_empty());
    let Region::Channel { length, width, .. } = channel(2.6, grid(0.1), -1.5).region else { return };
    let closed = Region::Channel { length, width, drive: Drive::ZeroFlux };
    let closed = |spacing| Setup { region: closed, ..channel(width, grid(spacing), -1.5) };
    assert_eq!(but_stresslets(&closed(0.1), 0.2), ["thin film"]);
    assert!(but_stresslets(&closed(0.05), 0.2).is_empty());
    let edge = "edge of the concentration not resolved";
    assert_eq!(but_stresslets(&channel(5.0, grid(0.1), -8.0), 1.0), [edge]);
    let still = Particles { diffusion: 0.0, ..Particles::default() };
    let still = DropletSetup { particles: Some(still), ..DropletSetup::default() };
    assert_eq!(but_stresslets(&Setup { droplets: vec![still], ..Setup::default() }, 0.2), [edge]);
    let small = DropletSetup { shape: DropletShape::Round { radius: 0.4 }, ..DropletSetup::passive(10.0) };
    let small = Setup { droplets: vec![small], method: grid(0.1), ..Setup::default() };
    assert_eq!(but_stresslets(&small, 0.2), ["droplet not resolved"]);
    let unbalanced = Setup { droplets: vec![DropletSetup::contractile(-10.0, 9.0)], ..Setup::default() };
    assert!(but_stresslets(&unbalanced, 0.1).contains(&"tension without a plateau".to_owned()));
}

/// A film between droplets is seen before the first step and after one was moved by hand.
#[test]
fn the_start_is_looked_at() {
    let droplet = |x: f64| DropletSetup { centre: [x, 0.0], ..DropletSetup::passive(10.0) };
    for method in [grid(0.1), Method::default()] {
        let films = |gap: f64| {
            let droplets = vec![droplet(-1.5), droplet(0.5 + gap)];
            let region = Region::Box { lengths: [8.0, 6.0] };
            let mut scene = Setup { region, method, droplets, ..Setup::default() }.build().unwrap().scene;
            let warnings = scene.system_mut().warnings();
            let films = warnings.iter().filter(|warning| warning.cause == "thin film");
            films.map(|warning| warning.excess).collect::<Vec<_>>()
        };
        assert!(films(0.5).is_empty());
        let resolved = if method == grid(0.1) { 0.1 } else { 0.3 * TAU / 72.0 };
        let [excess] = films(0.02)[..] else { panic!("{:?}", films(0.02)) };
        // Markers stand up to 2e-4 outside of a circle, so that their polygon has its area.
        assert!((excess - resolved / 0.02).abs() < 0.03 * excess, "{excess}");
    }
}

/// Of each body and cause the worst, and when it was.
#[test]
fn the_worst_is_kept() {
    let Built { mut scene, .. } = channel(2.1, grid(0.1), -6.0).build().unwrap();
    let mut warnings = Warnings::default();
    let mut least = (f64::INFINITY, 0.0);
    for _ in 0..40 {
        scene.run(scene.time() + 0.05).observe(Every::Steps(1), &mut warnings).go().unwrap();
        let gap = scene.system_mut().wall_gap().unwrap();
        if gap < least.0 {
            least = (gap, scene.time());
        }
    }
    let films: Vec<_> = warnings.worst().iter().filter(|(_, warning)| warning.cause == "thin film").collect();
    assert_eq!(films.len(), 1);
    let (time, film) = films[0];
    let narrowest = scene.system().minimum_wall_gap().unwrap();
    assert!((film.excess - 0.1 / narrowest).abs() < 1e-12 * film.excess, "{film:?} {narrowest}");
    assert!((time - least.1).abs() <= 0.05, "{time} {least:?}");
}
