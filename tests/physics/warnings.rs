//! Runs warn of what they do not resolve, and of nothing else.

use std::f64::consts::TAU;

use motile::active_interface::{Flux, Tension};
use motile::base::Drive;
use motile::base::Region;
use motile::scene::{Every, Scene, Warnings};
use motile::setup::{
    AnyFlow, Built, DropletSetup, DropletShape, GridMethod, IntegralMethod, LayersMethod, Method, Particles, Setup,
    SolidOutline, WallSetup,
};

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
    // Programs of the README and the guide.
    let guide = Method::Integral(IntegralMethod { nodes: 48, elements: 192 });
    assert!(causes(&Setup { method: guide, ..Setup::default() }, 2.0).is_empty());
    let region = Region::Channel { length: 12.0, width: 3.0, drive: Drive::Flux(-0.3) };
    // Its stresslet is 2 % off.
    assert_eq!(causes(&Setup { region, ..channel(3.0, guide, -3.0) }, 1.0), ["stresslet not resolved"]);
    let droplets = [(-1.5, -3.0, None), (1.5, -2.0, Some(1000.0))].map(|(x, activity, viscosity)| DropletSetup {
        centre: [x, 0.0],
        viscosity,
        ..DropletSetup::active(activity)
    });
    let region = Region::Box { lengths: [8.0, 6.0] };
    let two = Setup { region, method: guide, droplets: droplets.into(), ..Setup::default() };
    assert_eq!(causes(&two, 1.0), ["stresslet not resolved"]);
}

/// Settings of first order, few nodes and sharp corners cost a per cent and more without a word from the solution.
#[test]
fn settings_that_cost_a_per_cent_are_told() {
    let integral = |nodes| Method::Integral(IntegralMethod { nodes, elements: 300 });
    let of = |method| Setup { method, ..Setup::default() };
    assert_eq!(causes(&of(integral(16)), 0.1), ["shape not resolved"]);
    assert!(causes(&of(integral(24)), 0.1).is_empty());
    let mut upwind = of(integral(24));
    upwind.droplets[0].particles = Some(Particles { flux: Flux::Upwind, ..Particles::default() });
    assert_eq!(causes(&upwind, 0.1), ["edge of the concentration smeared"]);
    let uncorrected = of(Method::Grid(GridMethod::uncorrected(0.05)));
    assert_eq!(but_stresslets(&uncorrected, 0.1), ["interfaces smeared over the grid"]);
    let corners = vec![[2.0, -0.5], [2.5, -0.5], [2.5, 0.5], [2.0, 0.5]];
    let outline = SolidOutline::Polygon { corners: corners.clone(), rounding: 0.0 };
    for (rounding, expected) in [(0.0, &["corners not resolved"][..]), (0.125, &[])] {
        let walls = vec![WallSetup { rounding, ..WallSetup::new(outline.clone(), 0.1) }];
        let setup = Setup { walls, ..channel(6.0, integral(24), -1.0) };
        assert_eq!(causes(&setup, 0.05), expected, "{rounding}");
    }
    // An arc of the radius of the spacing turns by a radian from node to node, and less between points of its line.
    let arcs = SolidOutline::Polygon { corners, rounding: 0.1 };
    let walls = vec![WallSetup::new(arcs, 0.1)];
    assert_eq!(causes(&Setup { walls, ..channel(6.0, integral(24), -1.0) }, 0.05), ["corners not resolved"]);
    // The wedge of the guide has arcs that its nodes resolve.
    let corners = vec![[4.0, -1.2], [5.0, -1.2], [4.5, -0.8]];
    for (rounding, expected) in [(0.08, &[][..]), (0.05, &["corners not resolved"])] {
        let arcs = SolidOutline::Polygon { corners: corners.clone(), rounding };
        let walls = vec![WallSetup::new(arcs, 0.05)];
        assert_eq!(causes(&Setup { walls, ..channel(12.0, integral(24), -1.0) }, 0.05), expected, "{rounding}");
    }
    let round = SolidOutline::Disc { centre: [2.0, 0.0], radius: 0.3 };
    let walls = vec![WallSetup::new(round, 0.1)];
    assert!(causes(&Setup { walls, ..channel(6.0, integral(24), -1.0) }, 0.05).is_empty());
}

/// A value beyond its limit is not written as the limit.
#[test]
fn messages_tell_values_from_their_limits() {
    let droplet = DropletSetup::passive(10.0).with_radius(0.499);
    let setup = Setup { droplets: vec![droplet], method: grid(0.1), ..Setup::default() };
    let warnings = setup.build().unwrap().scene.system_mut().warnings();
    let said = &warnings[0].message;
    assert!(said.starts_with("its radius is 0.499 (length), below 0.5, 5 grid spacings"), "{said}");
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
    // So viscous that the particles do not collapse at once, for which the scene would be refused.
    let droplets = vec![DropletSetup::contractile(-10.0, 9.0)];
    let unbalanced = Setup { viscosity: 500.0, droplets, ..Setup::default() };
    assert!(but_stresslets(&unbalanced, 0.1).contains(&"tension without a plateau".to_owned()));
}

/// A law of the test: gamma = 10 + slope c.
#[derive(Debug)]
struct Linear(f64);

impl Tension for Linear {
    fn value(&self, c: f64) -> f64 {
        10.0 + self.0 * c
    }

    fn slope(&self, _c: f64) -> f64 {
        self.0
    }
}

/// A law of the test that levels off: gamma = 10 + 400 c/(c + 100).
#[derive(Debug)]
struct Saturating;

impl Tension for Saturating {
    fn value(&self, c: f64) -> f64 {
        10.0 + 400.0 * c / (c + 100.0)
    }

    fn slope(&self, c: f64) -> f64 {
        4e4 / (c + 100.0).powi(2)
    }
}

/// A law with the values of the one that levels off, and the slope at the mean concentration everywhere.
#[derive(Debug)]
struct SameSlope;

impl Tension for SameSlope {
    fn value(&self, c: f64) -> f64 {
        Saturating.value(c)
    }

    fn slope(&self, _c: f64) -> f64 {
        1.0
    }
}

#[test]
fn a_wrong_slope_is_told() {
    let method = Method::Integral(IntegralMethod { nodes: 24, elements: 96 });
    let Built { mut scene, droplets, .. } = Setup { method, ..Setup::default() }.build().unwrap();
    let told = |scene: &mut Scene<AnyFlow>| {
        scene.system_mut().warnings().iter().any(|warning| warning.cause == "slope of the tension wrong")
    };
    scene.body_mut(droplets[0]).unwrap().set_tension(Saturating);
    assert!(!told(&mut scene));
    scene.body_mut(droplets[0]).unwrap().set_tension(SameSlope);
    assert!(told(&mut scene));
}

/// Where an activity lowers the tension below zero, by any method and in any region, the start says so.
#[test]
fn negative_tension_is_told() {
    let of = |region, method, activity| {
        let droplets = vec![DropletSetup::active(activity)];
        let Built { mut scene, .. } = Setup { region, method, droplets, ..Setup::default() }.build().unwrap();
        let warnings = scene.system_mut().warnings();
        warnings.into_iter().find(|warning| warning.cause == "tension negative")
    };
    let integral = Method::Integral(IntegralMethod { nodes: 48, elements: 192 });
    let layers = Method::Layers(LayersMethod { spacing: 0.1, ..LayersMethod::default() });
    let channel = Region::Channel { length: 6.0, width: 3.0, drive: Drive::ZeroGradient };
    let square = Region::Box { lengths: [6.0, 6.0] };
    let cases = [
        (Region::Plane, integral),
        (Region::Space, integral),
        (Region::tube(2.0), integral),
        (square, integral),
        (channel, integral),
        (square, grid(0.1)),
        (channel, layers),
    ];
    for (region, method) in cases {
        let warning = of(region, method, 0.5).expect("a warning");
        // Half is covered, at twice the mean concentration of 100: 10 - 0.5 200 - Pi(200), Pi(200) = 100 ln 2.
        assert!(warning.message.starts_with("its tension is -1.59"), "{warning}");
        assert!((warning.excess - 16.9).abs() < 0.1, "{warning}");
        assert!(warning.message.contains("use a weaker excluded volume"), "{warning}");
        // 10 + 0.5 200 - 100 ln 2 is 41.
        assert!(of(region, method, -0.5).is_none(), "{region:?}");
    }
}

/// Laws that do not say so themselves are looked at too.
#[test]
fn laws_of_your_own_are_looked_at() {
    let of = |law: Box<dyn Tension>| {
        let built = Setup { region: Region::Plane, ..Setup::default() }.build().unwrap();
        let (mut scene, droplet) = (built.scene, built.droplets[0]);
        scene.body_mut(droplet).unwrap().set_tension(law);
        let warnings = scene.system_mut().warnings();
        warnings.into_iter().map(|warning| warning.cause.to_string()).collect::<Vec<_>>()
    };
    assert_eq!(of(Box::new(Linear(2.0))), ["tension without a plateau"]);
    assert_eq!(of(Box::new(Linear(-0.5))), ["tension negative"]);
    assert!(of(Box::new(Saturating)).is_empty());
    assert!(of(Box::new(Linear(0.0))).is_empty());
}

/// Bending holds the waves of an interface under compression that are shorter than those it buckles in.
#[test]
fn bending_makes_a_negative_tension_meaningful() {
    let of = |bending: f64| {
        let droplet = DropletSetup { bending, ..DropletSetup::active(0.5) };
        let setup = Setup { region: Region::Plane, droplets: vec![droplet], ..Setup::default() };
        let warnings = setup.build().unwrap().scene.system_mut().warnings();
        warnings.iter().any(|warning| warning.cause == "tension negative")
    };
    // 36 waves around a circle of radius 1: B 36^2 is 259 and 26, next to a tension of -159.
    assert!(!of(0.2));
    assert!(of(0.02));
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
