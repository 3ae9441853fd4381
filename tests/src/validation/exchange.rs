//! Exchange of particles between a round droplet's interface and its inside, where they diffuse, against linear theory;
//! and the speed of a droplet that swims with it.

use std::f64::consts::TAU;

use motile::active_interface::{ActiveDroplet, ConstantTension, ContractileTension, Curve, Exchange, ExcludedVolume};
use motile::base::{Region, Vec2};
use motile::boundary_integrals::{BoundaryIntegral, Settings};
use motile::interior::ParticlesInDroplet;
use motile::scene::{Scene, integrator::Dynamics as _};
use motile::setup::{Built, ExchangeSetup, Particles, Setup};

use super::{StudyError, scene::without_grid};

/// Rate k_on of binding (length per time).
pub const BINDING: f64 = 0.6;
/// Rate k_off of unbinding (1/time).
pub const UNBINDING: f64 = 0.4;
/// Diffusion constant on the interface (length squared per time).
pub const DIFFUSION: f64 = 0.1;
/// Mean concentration on the interface (1/length).
pub const MEAN: f64 = 100.0;
/// Viscosity inside and outside (stress times time).
const VISCOSITY: f64 = 100.0;
/// Length of the step from which rates are measured (time).
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

/// Growth rate (1/time) of mode k on the interface of the unit disc at an activity (force times length), without
/// exchange.
#[must_use]
pub fn bare_rate(k: f64, activity: f64) -> f64 {
    -k * (activity * MEAN / (4.0 * VISCOSITY) + DIFFUSION * k)
}

/// Mode of the density inside the unit disc, J_k(q r) cos(k theta) or I_k(q r) cos(k theta).
#[derive(Debug, Clone, Copy)]
pub struct Mode {
    /// Wave number along the interface.
    pub k: f64,
    /// Radial wave number (1/length).
    pub q: f64,
    /// True for I_k, a mode that grows.
    pub modified: bool,
    /// Diffusion constant inside (length squared per time).
    pub bulk: f64,
}

impl Mode {
    /// Its growth rate (1/time).
    #[must_use]
    pub fn rate(&self) -> f64 {
        if self.modified { self.bulk * self.q * self.q } else { -self.bulk * self.q * self.q }
    }

    /// Residual of the dispersion relation, where the rate without exchange is `bare`.
    fn defect(&self, bare: f64) -> f64 {
        let [value, slope] = bessel(self.k, self.q, self.modified);
        let x = self.bulk * self.q * slope;
        (self.rate() - bare) * (BINDING * value + x) + UNBINDING * x
    }

    /// The fastest-growing or slowest decaying one, where the rate without exchange is `bare`.
    #[must_use]
    pub fn find(k: f64, bulk: f64, bare: f64) -> Self {
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

/// Growth rate (1/time) of a mode at an activity (force times length), on `markers` markers and half as many nodes and
/// a mesh of that spacing (length), from a short step and the Rayleigh quotient: its error is that of the operator, as
/// it is symmetric in the densities weighted by areas, and by lengths times k_off/k_on.
///
/// # Errors
/// Scenes that cannot be set up, a step that fails.
pub fn rate(mode: Mode, activity: f64, markers: usize, spacing: f64) -> Result<f64, StudyError> {
    let nodes = markers / 2;
    let flow = BoundaryIntegral::new(Region::Plane, VISCOSITY, Settings { nodes, ..Settings::default() })?;
    let mut scene = Scene::new(flow);
    let circle = Curve::circle(1.0)?.markers(markers)?;
    let length = circle[0].distance(circle[1]);
    // Without activity the equations are linear at any size.
    let part = if activity == 0.0 { 0.3 } else { 1e-4 };
    let size = part * MEAN / mode.on().abs().max(1.0);
    let wave = |segment: usize| mode.on() * (mode.k * TAU * (segment as f64 + 0.5) / markers as f64).cos();
    let numbers = (0..markers).map(|segment| length * (MEAN + size * wave(segment))).collect();
    let droplet = if activity == 0.0 {
        ActiveDroplet::new(&circle, numbers, ConstantTension::new(10.0)?, DIFFUSION)?
    } else {
        let law = ContractileTension::new(10.0 - activity * MEAN, activity, ExcludedVolume::None, 1.0)?;
        ActiveDroplet::new(&circle, numbers, law, DIFFUSION)?
    };
    let droplet = droplet.with_open_number();
    let exchange = Exchange::new(BINDING, UNBINDING)?;
    let rest = exchange.concentration_at_rest(MEAN).unwrap_or_default();
    let host = scene.add(droplet.clone());
    let density = |at: Vec2| rest + size * mode.density(at);
    let at_start = ParticlesInDroplet::new(&droplet, host, exchange, mode.bulk, density, spacing)?;
    scene.add(at_start.clone());
    let [mut before, mut after] = [Vec::new(), Vec::new()];
    scene.system().write_state(&mut before);
    scene.step(STEP)?;
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
    Ok((1.0 + above / below).ln() / STEP)
}

/// Speed (length per time) at a time of a swimmer of activity -4 with such a field inside, on `markers` markers and
/// half as many nodes, in the plane.
///
/// # Errors
/// Scenes that cannot be set up, a run that fails.
pub fn speed(bulk: f64, markers: usize, spacing: f64, time: f64) -> Result<f64, StudyError> {
    let exchange = ExchangeSetup {
        diffusion_inside: Some(bulk),
        spacing_inside: Some(spacing),
        ..ExchangeSetup::new(BINDING, UNBINDING)
    };
    let mut setup = Setup { region: Region::Plane, ..without_grid(markers / 2, markers) };
    setup.droplets[0].particles = Some(Particles { activity: -4.0, exchange: Some(exchange), ..Particles::default() });
    let Built { mut scene, droplets, .. } = setup.build()?;
    scene.run(time).go()?;
    Ok(scene.observe(droplets[0])?.speed())
}
