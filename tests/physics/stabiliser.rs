//! The stabiliser of crowded particles: how much a wave grows in one step, by the symbol of the step.

use std::f64::consts::TAU;

use motile::active_interface::theory::{FlatInterface, Stratum, StratumEnd};
use motile::active_interface::{ActiveDroplet, ActiveInterface, ContractileTension, Curve, ExcludedVolume, wave};
use motile::base::Region;
use motile::boundary_integrals::{BoundaryIntegral, Settings};
use motile::prelude::*;
use motile::scene::{Hydrodynamics, SceneError};
use motile::setup::AnyFlow;
use motile_tests::validation::scene::on_grid;

/// Hardly any diffusion (length squared per time).
const DIFFUSION: f64 = 1e-6;
const AMPLITUDE: f64 = 1e-7;

/// Crowded particles: with c = 1, viscosity 1 and h, the unit `h eta/(c |gamma'|)` of the steps is h.
fn law() -> ContractileTension {
    ContractileTension::new(1.01, 1.0, ExcludedVolume::None, 1.0).expect("a law")
}

/// Returns the factor of a wave in one step of the midpoint rule: the wave decays at `rate` (1/time), and the
/// stabiliser at `implicit` (1/time).
fn factor(rate: f64, implicit: f64, dt: f64) -> f64 {
    let (a, b) = (rate * dt, implicit / rate);
    1.0 - a * (1.0 + a * (b - 0.5)) / (1.0 + 0.5 * a * b).powi(2)
}

/// Returns the longest stable step for interfaces that move each other, over h: `neighbours(q)` is the mobility of a
/// wave over the mobility of one interface alone. A wave grows if `dt (rate/2 - implicit) > 1`.
fn longest_step(h: f64, neighbours: impl Fn(f64) -> f64) -> f64 {
    let waves = (1..4000).map(|k| f64::from(k) * 1e-3 / h);
    let fastest = waves.map(|q| 0.25 * q * (0.5 * neighbours(q) - q * h)).fold(0.0, f64::max);
    1.0 / (fastest * h)
}

/// Numbers of particles on elements of a length: one wave more or less than uniform.
fn numbers(count: usize, length: f64, cosine: impl Fn(usize) -> f64, sign: f64) -> Vec<f64> {
    (0..count).map(|k| length * (1.0 + sign * AMPLITUDE * cosine(k))).collect()
}

/// Returns the factor of `waves` waves of the concentration on a circle in one step, from two opposite waves.
fn circle(flow: &dyn Fn() -> AnyFlow, count: usize, waves: usize, dt: f64) -> f64 {
    let cosine = |k: usize| (TAU * waves as f64 * (k as f64 + 0.5) / count as f64).cos();
    let project = |numbers: &[f64]| numbers.iter().enumerate().map(|(k, n)| n * cosine(k)).sum::<f64>();
    let markers = Curve::circle(1.0).and_then(|circle| circle.markers(count)).expect("a circle");
    let (mut before, mut after) = (0.0, 0.0);
    for sign in [1.0, -1.0] {
        let numbers = numbers(count, markers[0].distance(markers[1]), cosine, sign);
        before += sign * project(&numbers);
        let mut scene = Scene::new(flow());
        let droplet = scene.add(ActiveDroplet::new(&markers, numbers, law(), DIFFUSION).expect("a droplet"));
        scene.step(dt).expect("a step");
        after += sign * project(scene.body(droplet).expect("its droplet").particle_numbers());
    }
    after / before
}

fn grid(h: f64, side: f64) -> AnyFlow {
    Setup { viscosity: 1.0, region: Region::Box { lengths: [side; 2] }, ..on_grid(h) }.flow().expect("a flow")
}

fn integrals(region: Region, nodes: usize) -> BoundaryIntegral {
    BoundaryIntegral::new(region, 1.0, Settings { nodes, tolerance: 1e-10, ..Settings::default() }).expect("a solver")
}

/// On a circle, the mobility of mode k is 1/(4 eta k), and differences replace derivatives.
fn symbol(h: f64, count: usize, waves: usize, dt: f64) -> f64 {
    let half = 0.5 * TAU / count as f64;
    let square = ((waves as f64 * half).sin() / half.sin()).powi(2);
    factor(square / (4.0 * waves as f64), 0.25 * h * square, dt)
}

/// The corrected grid has the mobility of the fluid for all waves that are near to growing. So waves of markers that
/// the grid takes for others are not what shortens the stable step there.
#[test]
fn one_step_multiplies_a_wave_on_a_circle_by_the_symbol() {
    let h = 0.1;
    let count = 4 * (TAU / (2.0 * h)).round() as usize;
    let nodes = 48;
    let finest = 2.0 / (0.5 * f64::from(nodes));
    let integral = || Box::new(integrals(Region::Plane, nodes as usize)) as AnyFlow;
    for unit in [4.0, 8.0, 32.0, 60.0, 70.0, 100.0] {
        let mut most = [f64::NEG_INFINITY; 2];
        for waves in [3, 4, 5, 8] {
            let dt = unit * h;
            let (found, expected) = (circle(&|| grid(h, 12.0), count, waves, dt), symbol(h, count, waves, dt));
            assert!((found - expected).abs() < 3e-3, "grid, {waves} waves, {unit}: {found} {expected}");
            most[0] = most[0].max(found);
            let (dt, count) = (unit * finest, 8 * nodes as usize);
            let (found, expected) = (circle(&integral, count, waves, dt), symbol(finest, count, waves, dt));
            assert!((found - expected).abs() < 1.5e-3, "integrals, {waves} waves, {unit}: {found} {expected}");
            most[1] = most[1].max(found);
        }
        assert!(most.map(|most| most > 1.0) == [unit > 64.0; 2], "{unit}: {most:?}");
    }
}

/// The mobility of one of two flat interfaces with a gap, which move alike, over the mobility of one alone.
fn with_neighbour(q: f64, gap: f64) -> f64 {
    1.0 + (1.0 - q * gap) * (-q * gap).exp()
}

/// Two interfaces closer than h push the same fluid twice, and need a quarter of the step. On a grid, pressed droplets
/// cross each other at half of the step that one of them could take; half of 16 is what the limit keeps to.
#[test]
fn a_second_interface_within_a_spacing_needs_a_quarter_of_the_step() {
    let h = 0.1;
    let together = |gap: f64| longest_step(h, |q| with_neighbour(q, gap * h));
    assert!((longest_step(h, |_| 1.0) - 64.0).abs() < 1e-6 && (together(0.0) - 16.0).abs() < 1e-6);
    let grows = |gap: f64, unit: f64| match pressed(h, gap * h, unit * h) {
        Ok(growth) => {
            assert!(!(0.2..5.0).contains(&growth), "neither grows nor decays: {gap} {unit} {growth}");
            growth > 1.0
        }
        Err(error) => {
            assert!(matches!(error, SceneError::Crossing { .. }), "{error}");
            true
        }
    };
    for (gap, below, above) in [(0.3, 16.0, 32.0), (1.0, 24.0, 40.0), (4.0, 48.0, 72.0)] {
        let limit = together(gap);
        assert!(below < limit && limit < above, "{gap}: {limit}");
        assert!(!grows(gap, below) && grows(gap, above), "{gap}");
    }
    let mut scene = Scene::new(grid(h, 8.0));
    let markers = Curve::circle(1.0).and_then(|circle| circle.markers(124)).expect("a circle");
    let even = vec![markers[0].distance(markers[1]); 124];
    scene.add(ActiveDroplet::new(&markers, even, law(), DIFFUSION).expect("a droplet"));
    scene.step(1e-9).expect("a step");
    let (limit, reason, _) = scene.step_limit().expect("a limit");
    assert!(reason == "the coupling of concentration and tension" && limit < 0.6 * together(0.0) * h, "{limit}");
}

/// With boundary integrals, the symbol of a pair has the exact mobility of the linear theory of flat interfaces.
#[test]
fn a_pair_of_flat_interfaces_grows_by_its_symbol() {
    for (gap, unit, grows) in [(0.04, 8.0, false), (0.04, 16.0, false), (0.04, 32.0, true), (0.32, 32.0, false)] {
        let waves = [2, 3, 4, 5, 6].map(|waves| pair(gap, waves, unit));
        for [found, expected] in waves {
            assert!((found - expected).abs() < 0.02 * (1.0 + expected.abs()), "{gap} {unit}: {found} {expected}");
        }
        assert_eq!(waves.iter().any(|[found, _]| *found > 1.0), grows, "{gap} {unit}: {waves:?}");
    }
}

/// Markers of a stadium, two half discs of a radius and straight sides between them.
fn stadium(middle: Vec2, straight: f64, radius: f64, count: usize) -> Vec<Vec2> {
    let length = 2.0 * straight + TAU * radius;
    let place = |s: f64| {
        let (right, left) = (0.5 * TAU * radius, 0.5 * TAU * radius + straight);
        if s < right {
            Vec2::new(0.5 * straight, 0.0) + radius * Vec2::from_angle(s / radius - 0.25 * TAU)
        } else if s < left {
            Vec2::new(0.5 * straight - (s - right), radius)
        } else if s < left + right {
            Vec2::new(-0.5 * straight, 0.0) + radius * Vec2::from_angle((s - left) / radius + 0.25 * TAU)
        } else {
            Vec2::new(-0.5 * straight + (s - left - right), -radius)
        }
    };
    (0..count).map(|k| middle + place(length * k as f64 / count as f64)).collect()
}

/// Returns the growth in 40 steps of a difference of the numbers of particles on two stadiums, one above the other with
/// a gap, on a grid.
fn pressed(h: f64, gap: f64, dt: f64) -> Result<f64, SceneError> {
    let (straight, radius) = (4.0, 0.8);
    let count = 2 * ((2.0 * straight + TAU * radius) / h).round() as usize;
    let run = |sign: f64, steps: usize| {
        let mut scene = Scene::new(grid(h, 8.0));
        let mut add = |above: f64| {
            let markers = stadium(Vec2::new(0.0, above * (radius + 0.5 * gap)), straight, radius, count);
            // Mirror images of each other: waves along x.
            let wave = |k: usize| (1..30).map(|m| (0.3 * f64::from(m) * markers[k].x + f64::from(m * m)).cos()).sum();
            let numbers = numbers(count, markers[0].distance(markers[1]), wave, sign);
            scene.add(ActiveDroplet::new(&markers, numbers, law(), DIFFUSION).expect("a droplet"))
        };
        let handles = [add(1.0), add(-1.0)];
        (0..steps).try_for_each(|_| scene.step(dt).map(|_| ()))?;
        Ok::<_, SceneError>(scene.body(handles[0])?.particle_numbers().to_vec())
    };
    let spread = |steps: usize| -> Result<f64, SceneError> {
        let (more, less) = (run(1.0, steps)?, run(-1.0, steps)?);
        Ok(more.iter().zip(&less).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs())))
    };
    Ok(spread(40)? / spread(0)?)
}

/// Returns the factor of the waves on the upper of two flat interfaces with a gap in a step, found and by the symbol.
fn pair(gap: f64, waves: usize, unit: f64) -> [f64; 2] {
    let (nodes, period, elements) = (48, 6.0, 384);
    let region = Region::Box { lengths: [period, 30.0] };
    let h = 0.5 / integrals(region, nodes).fluid_view().interface_stiffness;
    let dt = unit * h;
    let (q, length) = (TAU * waves as f64 / period, period / elements as f64);
    let cosine = |j: usize| (TAU * waves as f64 * (j as f64 + 0.5) / elements as f64).cos();
    let mut after = 0.0;
    for sign in [1.0, -1.0] {
        let mut scene = Scene::new(integrals(region, nodes));
        // The fluid between them is exterior, so the lower one runs backwards.
        let mut add = |height: f64, advance: f64| {
            let markers = wave(height, advance, &[0.0], &[], elements).expect("markers");
            let numbers = numbers(elements, length, cosine, sign);
            scene.add(ActiveInterface::periodic(&markers, advance, numbers, law(), DIFFUSION).expect("an interface"))
        };
        add(-0.5 * gap, -period);
        let upper = add(0.5 * gap, period);
        scene.step(dt).expect("a step");
        let numbers = scene.body(upper).expect("an interface").particle_numbers();
        after += sign * numbers.iter().enumerate().map(|(j, n)| n * cosine(j)).sum::<f64>();
    }
    let found = after / (elements as f64 * length * AMPLITUDE);
    let interface =
        FlatInterface { wave_number: q, tension: 0.01, activity: 1.0, concentration: 1.0, diffusivity: DIFFUSION };
    let between = Stratum { viscosity: 1.0, end: StratumEnd::Same { thickness: gap } };
    let above = Stratum { viscosity: 1.0, end: StratumEnd::None };
    let mobility = interface.mobility(between, above).expect("a mobility")[0][0];
    [found, factor(q * q * mobility, 0.25 * h * q * q, dt)]
}
