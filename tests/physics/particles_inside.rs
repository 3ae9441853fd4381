//! Particles that diffuse inside a droplet and are exchanged with its interface, against linear theory.

use std::f64::consts::{PI, TAU};

use motile::active_interface::{ActiveDroplet, ConstantTension, ContractileTension, Curve, Exchange, ExcludedVolume};
use motile::boundary_integral::{BoundaryIntegral, Settings};
use motile::interior_fields::{InteriorObservables, ParticlesInDroplet};
use motile::motile_base::Region;
use motile::motile_scene::integrator::Dynamics as _;
use motile::prelude::*;
use motile::setup::{AnyFlow, ExchangeSetup, Exclusion};
use motile_tests::validation::scene::{on_grid, without_grid};

const BINDING: f64 = 0.6;
const UNBINDING: f64 = 0.4;
const DIFFUSION: f64 = 0.1;
const MEAN: f64 = 100.0;
const VISCOSITY: f64 = 100.0;
const STEP: f64 = 1e-4;

/// The Bessel functions J_k, or I_k where `modified`, and their derivatives, by integrals over a period.
fn bessel(k: f64, x: f64, modified: bool) -> [f64; 2] {
    let count = 200;
    let mut sums = [0.0; 2];
    for step in 0..count {
        let angle = TAU * f64::from(step) / f64::from(count);
        let (sin, cos) = angle.sin_cos();
        let terms = if modified {
            [(x * cos).exp() * (k * angle).cos(), cos * (x * cos).exp() * (k * angle).cos()]
        } else {
            [(k * angle - x * sin).cos(), sin * (k * angle - x * sin).sin()]
        };
        sums.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term / f64::from(count));
    }
    sums
}

/// A mode of the unit disc: wave number along the interface and radial one, growing where `modified`.
#[derive(Debug, Clone, Copy)]
struct Mode {
    k: f64,
    q: f64,
    modified: bool,
    bulk: f64,
}

impl Mode {
    fn rate(&self) -> f64 {
        if self.modified { self.bulk * self.q * self.q } else { -self.bulk * self.q * self.q }
    }

    /// What vanishes at a root of the dispersion relation, where the rate without exchange is `bare`.
    fn defect(&self, bare: f64) -> f64 {
        let [value, slope] = bessel(self.k, self.q, self.modified);
        let x = self.bulk * self.q * slope;
        (self.rate() - bare) * (BINDING * value + x) + UNBINDING * x
    }

    /// The fastest-growing or slowest decaying one.
    fn find(k: f64, bulk: f64, bare: f64) -> Self {
        let at = |s: f64| {
            let modified = s > 0.0;
            Self { k, q: (s.abs() / bulk).sqrt(), modified, bulk }
        };
        let (mut above, step) = (bare.max(0.0) + 0.01, 0.01);
        // Relative to the sign at great rates; x and I vanish together at 0.
        while (at(above - step).defect(bare) > 0.0) == (at(above).defect(bare) > 0.0) || above.abs() < 1.5 * step {
            above -= step;
        }
        let mut below = above - step;
        for _ in 0..60 {
            let middle = 0.5 * (above + below);
            let same = (at(middle).defect(bare) > 0.0) == (at(above).defect(bare) > 0.0);
            if same { above = middle } else { below = middle }
        }
        at(above)
    }

    fn density(&self, at: Vec2) -> f64 {
        let [value, _] = bessel(self.k, self.q * at.length(), self.modified);
        value * (self.k * at.to_angle()).cos()
    }

    /// The amplitude on the interface of density J_k or I_k inside.
    fn on(&self) -> f64 {
        let [value, slope] = bessel(self.k, self.q, self.modified);
        (BINDING * value + self.bulk * self.q * slope) / UNBINDING
    }
}

/// The rate of a mode from a short step and the Rayleigh quotient: its error is that of the operator, as it is
/// symmetric in the densities weighted by areas, and by lengths times k_off/k_on.
fn quotient(mode: Mode, activity: f64, markers: usize, spacing: f64) -> f64 {
    let nodes = markers / 2;
    let flow = BoundaryIntegral::new(Region::Plane, VISCOSITY, Settings { nodes, ..Settings::default() })
        .expect("a scene that works");
    let mut scene = Scene::new(flow);
    let circle = Curve::circle(1.0).expect("a scene that works").markers(markers).expect("a scene that works");
    let length = circle[0].distance(circle[1]);
    // Without activity the equations are linear at any size.
    let part = if activity == 0.0 { 0.3 } else { 1e-4 };
    let size = part * MEAN / mode.on().abs().max(1.0);
    let wave = |segment: usize| mode.on() * (mode.k * TAU * (segment as f64 + 0.5) / markers as f64).cos();
    let numbers = (0..markers).map(|segment| length * (MEAN + size * wave(segment))).collect();
    let droplet = if activity == 0.0 {
        ActiveDroplet::new(&circle, numbers, ConstantTension::new(10.0).expect("a scene that works"), DIFFUSION)
            .expect("a scene that works")
    } else {
        let law = ContractileTension::new(10.0 - activity * MEAN, activity, ExcludedVolume::None)
            .expect("a scene that works");
        ActiveDroplet::new(&circle, numbers, law, DIFFUSION).expect("a scene that works")
    };
    let droplet = droplet.with_open_number();
    let exchange = Exchange::new(BINDING, UNBINDING).expect("a scene that works");
    let rest = exchange.concentration_at_rest(MEAN).expect("a scene that works");
    let host = scene.add(droplet.clone());
    let density = |at: Vec2| rest + size * mode.density(at);
    let inside =
        ParticlesInDroplet::new(&droplet, host, exchange, mode.bulk, density, spacing).expect("a scene that works");
    scene.add(inside.clone());
    let at_start = inside;
    let [mut before, mut after] = [Vec::new(), Vec::new()];
    scene.system().write_state(&mut before);
    scene.step(STEP).expect("a scene that works");
    scene.system().write_state(&mut after);
    let change: Vec<f64> = after.iter().zip(&before).map(|(after, before)| (after - before) / size).collect();
    let [mut above, mut below] = [0.0; 2];
    for segment in 0..markers {
        let value = wave(segment) * UNBINDING / BINDING;
        above += value * change[2 * markers + segment];
        below += value * length * wave(segment);
    }
    let areas = at_start.numbers().iter().zip(at_start.densities()).map(|(number, density)| number / density);
    for ((node, area), change) in at_start.nodes().iter().zip(areas).zip(&change[3 * markers..]) {
        let value = mode.density(*node);
        above += value * change;
        below += value * area * value;
    }
    (1.0 + above / below).ln() / STEP
}

fn assert_second_order(mode: Mode, activity: f64) {
    let errors = [(32, 0.24), (64, 0.12), (128, 0.06)]
        .map(|(markers, spacing)| (quotient(mode, activity, markers, spacing) - mode.rate()).abs());
    let bound = 0.003 * (1.0 + mode.rate().abs());
    assert!(errors[2] < bound, "{mode:?}: {errors:?} of {}", mode.rate());
    assert!((errors[0] / errors[2]).log2() > 3.5, "{mode:?}: {errors:?} of {}", mode.rate());
}

#[test]
fn diffusing_modes_decay_at_the_exact_rates() {
    for (k, bulk) in [(0.0, 0.3), (1.0, 0.3), (2.0, 1.0), (3.0, 0.1), (4.0, 0.5)] {
        let mode = Mode::find(k, bulk, -DIFFUSION * k * k);
        assert!(!mode.modified);
        assert_second_order(mode, 0.0);
    }
}

#[test]
fn active_modes_grow_at_the_exact_rates() {
    for (k, bulk) in [(1.0, 0.3), (2.0, 1.0), (3.0, 0.1), (4.0, 20.0)] {
        let activity = -8.0;
        let bare = -k * (activity * MEAN / (2.0 * 2.0 * VISCOSITY) + DIFFUSION * k);
        let mode = Mode::find(k, bulk, bare);
        assert!(mode.modified, "{mode:?}");
        assert_second_order(mode, activity);
    }
}

/// The activities at which modes neither grow nor decay, their densities inside being r^k cos k theta: rates are linear
/// in the activity.
#[test]
fn what_diffuses_inside_sets_the_thresholds() {
    for (k, bulk) in [(1.0, 0.3), (2.0, 1.0), (3.0, 0.1)] {
        // Almost at rest: I_k(q r) differs from r^k by q^2/(4 k + 4).
        let mode = Mode { k, q: 0.05, modified: true, bulk };
        let exact = -4.0 / k * (DIFFUSION * k * k + UNBINDING / (1.0 + BINDING / (k * bulk)));
        let errors = [(32, 0.24), (64, 0.12), (128, 0.06)].map(|(markers, spacing)| {
            let at = [0.5 * exact, 1.5 * exact];
            let [low, high] = at.map(|activity| quotient(mode, activity, markers, spacing));
            let found = at[0] - low * (at[1] - at[0]) / (high - low);
            (found / exact - 1.0).abs()
        });
        assert!(errors[2] < 5e-3 && (errors[1] / errors[2]).log2() > 1.8, "mode {k}: {errors:?} of {exact}");
    }
}

/// A swimmer with particles inside.
fn swimmer(method: Setup, region: Region, exchange: ExchangeSetup) -> Built {
    let particles = Particles {
        activity: -3.0,
        excluded_volume: Exclusion::Step(10.0),
        exchange: Some(exchange),
        ..Particles::default()
    };
    let droplet = DropletSetup { particles: Some(particles), ..DropletSetup::default() };
    Setup { region, droplets: vec![droplet], ..method }.build().expect("a scene that works")
}

fn seen(scene: &mut Scene<AnyFlow>) -> InteriorObservables {
    let (inside, _) = scene.system().bodies::<ParticlesInDroplet>().next().expect("a field");
    scene.observe(inside).expect("a good state")
}

#[test]
fn no_particle_is_lost_however_the_droplet_moves() {
    let with = |bulk: f64| ExchangeSetup { diffusion_inside: Some(bulk), ..ExchangeSetup::new(BINDING, UNBINDING) };
    let square = Region::Box { lengths: [5.0; 2] };
    let channel = Region::Channel { length: 5.0, width: 2.6, drive: Drive::ZeroGradient };
    for (method, region, bulk) in
        [(on_grid(0.1), square, 0.05), (on_grid(0.1), channel, 1e-4), (without_grid(48, 96), Region::Plane, 0.5)]
    {
        let Built { mut scene, .. } = swimmer(method, region, with(bulk));
        let start = seen(&mut scene);
        scene.run(2.0).go().unwrap();
        let end = seen(&mut scene);
        let total = |seen: InteriorObservables| seen.number + seen.number_on;
        assert!((total(end) / total(start) - 1.0).abs() < 1e-12, "{bulk}: {start:?} {end:?}");
        assert!(end.range[0] >= 0.0 && (end.number / start.number - 1.0).abs() > 1e-4, "{bulk}: {start:?} {end:?}");
    }
}

/// A front that diffusion does not resolve.
#[test]
fn sharp_fields_stay_between_their_bounds() {
    let mut built = swimmer(on_grid(0.1), Region::Box { lengths: [5.0; 2] }, ExchangeSetup::new(0.0, 0.0));
    let (scene, host) = (&mut built.scene, built.droplets[0]);
    let droplet = scene.body(host).unwrap().clone();
    let exchange = Exchange::new(0.0, 0.0).unwrap();
    let step = |at: Vec2| if at.x > 0.2 { 1.0 } else { 0.0 };
    let field = ParticlesInDroplet::new(&droplet, host, exchange, 1e-9, step, 0.1).unwrap();
    let field = scene.add(field);
    let before = scene.observe(field).unwrap().number;
    scene.run(3.0).go().unwrap();
    let InteriorObservables { number, range, .. } = scene.observe(field).unwrap();
    assert!(range[0] > -1e-12 && range[1] < 1.02, "{range:?}");
    assert!((number / before - 1.0).abs() < 1e-12);
}

/// Without exchange nothing happens to a uniform field, but for the error of the steps.
#[test]
fn a_uniform_field_stays_uniform_however_the_droplet_moves() {
    for (method, ratio) in [(without_grid(48, 96), 0.35), (on_grid(0.1), 0.5)] {
        let spread = [0.04, 0.02].map(|dt| {
            let exchange =
                ExchangeSetup { number_inside: Some(PI), diffusion_inside: Some(0.01), ..ExchangeSetup::new(0.0, 0.0) };
            let mut built = swimmer(method.clone(), Region::Box { lengths: [5.0; 2] }, exchange);
            while built.scene.time() < 2.0 - 0.5 * dt {
                built.scene.step(dt).unwrap();
            }
            let [least, largest] = seen(&mut built.scene).range;
            largest - least
        });
        assert!(spread[1] < 1e-3 && spread[1] < ratio * spread[0], "{spread:?}");
    }
}

#[test]
fn fast_diffusion_is_a_pool() {
    let number = |bulk: Option<f64>| {
        let exchange = ExchangeSetup { diffusion_inside: bulk, ..ExchangeSetup::new(BINDING, UNBINDING) };
        let Built { mut scene, droplets, .. } = swimmer(on_grid(0.1), Region::Box { lengths: [5.0; 2] }, exchange);
        for _ in 0..20 {
            scene.step(0.02).unwrap();
        }
        scene.observe(droplets[0]).unwrap().particle_number
    };
    let start = TAU * MEAN;
    let pool = number(None);
    let errors = [10.0, 100.0, 1000.0].map(|bulk| (number(Some(bulk)) - pool).abs() / (pool - start).abs());
    assert!(errors[2] < 0.02 && errors[2] < errors[0], "{errors:?}, {pool} of {start}");
}
