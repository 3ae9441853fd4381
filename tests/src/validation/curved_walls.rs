//! Droplets of fixed shape between curved rigid walls, and flow along such walls.

use std::f64::consts::TAU;

use motile::base::{Drive, FlowSample, Region, Vec2};
use motile::boundary_integrals::{BoundaryIntegral, PeriodicCalculus, RigidWall, Settings, TensionPlacement};
use motile::scene::{Hydrodynamics, MarkerKind, Markers};

use super::{Reference, StudyError};

/// Period of the channel of the reference values, its mean half width and the amplitude of its sides.
const PERIOD: f64 = 12.0;
const HALF_WIDTH: f64 = 1.5;
const AMPLITUDE: f64 = 0.3;
/// Width of the straight channel around it.
const WIDTH: f64 = 5.0;
const GAUSS: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];

/// Largest errors over all droplets of the reference tables.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct CurvedErrors {
    /// Of the velocities of markers.
    pub markers: f64,
    /// Of the velocities off the interface, also close to it and to walls.
    pub field: f64,
    /// Of the flux.
    pub flux: f64,
    /// Of the force of each wall along the channel.
    pub force: f64,
}

fn side(x: f64) -> f64 {
    HALF_WIDTH + AMPLITUDE * (TAU * x / PERIOD).cos()
}

/// The channel of the reference values, as layers of so many nodes a wall.
fn channel(drive: Drive, droplet: usize, wall: usize) -> Result<BoundaryIntegral, StudyError> {
    let region = Region::Channel { length: PERIOD, width: WIDTH, drive };
    let settings = Settings { nodes: droplet, tolerance: 1e-13, ..Settings::default() };
    let walls = [RigidWall::below(PERIOD, wall, |x| -side(x))?, RigidWall::above(PERIOD, wall, side)?];
    Ok(BoundaryIntegral::new(region, 1.0, settings)?.with_walls(&walls)?)
}

/// An ellipse with tension as a function of its parameter t.
fn ellipse(
    centre: Vec2,
    axes: [f64; 2],
    count: usize,
    viscosity_inside: Option<f64>,
    tension: impl Fn(f64) -> f64,
) -> Result<Markers, StudyError> {
    let mut markers = Markers::new();
    markers.push_group(count, MarkerKind::UnevenInterface { viscosity_inside });
    let angle = |k: usize| TAU * k as f64 / count as f64;
    for (k, position) in markers.positions_mut().iter_mut().enumerate() {
        *position = centre + Vec2::new(axes[0] * angle(k).cos(), axes[1] * angle(k).sin());
    }
    let tension: Vec<f64> = (0..count).map(|k| tension(angle(k))).collect();
    let mut calculus = PeriodicCalculus::new(count)?;
    let [positions, forces, _] = markers.lists_mut();
    calculus.tension_forces(positions, &tension, TensionPlacement::Points, forces)?;
    Ok(markers)
}

/// Against the reference values with so many nodes of the droplet and of each wall.
///
/// # Errors
/// Reference values that cannot be read, a scene that cannot be.
pub fn fixed(droplet: usize, wall: usize) -> Result<CurvedErrors, StudyError> {
    let mut flow = channel(Drive::default(), droplet, wall)?;
    let mut errors = CurvedErrors::default();
    let (velocities, global) = (Reference::read("curved_walls_velocities")?, Reference::read("curved_walls_global")?);
    for (x0, y0, a) in [("0", "0", "1"), ("3", "0.2", "1"), ("6", "0", "1"), ("4.5", "-0.1", "1")]
        .into_iter()
        .chain([("6", "0.1", "1.3"), ("1", "0.3", "1.3")])
    {
        for (gamma, amplitude, phase) in [("const1", 0.0, 0.0), ("1+0.5cos", 0.5, 0.0), ("1+0.5cos(t-0.7)", 0.5, 0.7)] {
            let of = |table: &Reference| {
                table.clone().select("x0", x0).select("y0", y0).select("a", a).select("gamma", gamma)
            };
            let (rows, global) = (of(&velocities), of(&global));
            let number = |name| global.value(name);
            let (centre, a) = (Vec2::new(number("x0")?, number("y0")?), number("a")?);
            let tension = |t: f64| 1.0 + amplitude * (t - phase).cos();
            let mut markers = ellipse(centre, [a, 1.0 / a], 8 * droplet.div_ceil(8), None, tension)?;
            flow.velocities(&mut markers)?;
            let stride = markers.velocities().len() / 8;
            let [vx, vy] = ["vx", "vy"].map(|name| rows.clone().select("kind", "marker").column(name));
            for ((found, vx), vy) in markers.velocities().iter().step_by(stride).zip(vx?).zip(vy?) {
                errors.markers = errors.markers.max(found.distance(Vec2::new(vx, vy)));
            }
            let field = rows.select("kind", "field");
            let [x, y, vx, vy] = ["x", "y", "vx", "vy"].map(|name| field.column(name));
            let points: Vec<Vec2> = x?.into_iter().zip(y?).map(|(x, y)| Vec2::new(x, y)).collect();
            let mut samples = vec![FlowSample::default(); points.len()];
            flow.sample(&markers, &points, &mut samples)?;
            for ((found, vx), vy) in samples.iter().zip(vx?).zip(vy?) {
                errors.field = errors.field.max(found.velocity.distance(Vec2::new(vx, vy)));
            }
            let forces: Vec<Vec2> = flow.wall_forces().collect();
            for (force, name) in forces.iter().zip(["Fx_lower", "Fx_upper"]) {
                errors.force = errors.force.max((force.x - number(name)?).abs());
            }
            let flux = flux(&mut flow, &markers, centre.x + 0.5 * PERIOD)?;
            errors.flux = errors.flux.max((flux - number("flux")?).abs());
        }
    }
    Ok(errors)
}

/// Flux through the section at x.
fn flux(flow: &mut BoundaryIntegral, markers: &Markers, x: f64) -> Result<f64, StudyError> {
    const PIECES: usize = 40;
    let step = 2.0 * side(x) / PIECES as f64;
    let at = |k: usize, s: f64| Vec2::new(x, step * (k as f64 + 0.5 + 0.5 * s) - side(x));
    let points: Vec<Vec2> = (0..PIECES).flat_map(|k| GAUSS.map(|(s, _)| at(k, s))).collect();
    let mut samples = vec![FlowSample::default(); points.len()];
    flow.sample(markers, &points, &mut samples)?;
    let weights = GAUSS.iter().map(|(_, weight)| 0.5 * step * weight).cycle();
    Ok(samples.iter().zip(weights).map(|(sample, weight)| weight * sample.velocity.x).sum())
}

/// Largest difference of marker velocities from those with 256 nodes of the droplet and 384 of a wall, over the largest
/// velocity: a circle of radius 0.65 in a film of that width below the upper wall where the channel is widest, with
/// numbers of nodes of the droplet, each with that of a wall, that are multiples of 16.
///
/// # Errors
/// A scene that cannot be.
pub fn film(width: f64, viscosity_inside: f64, nodes: &[[usize; 2]]) -> Result<Vec<f64>, StudyError> {
    let velocities = |[droplet, wall]: [usize; 2]| -> Result<Vec<Vec2>, StudyError> {
        let centre = Vec2::new(0.1, side(0.1) - width - 0.65);
        let tension = |t: f64| 1.0 + 0.5 * (t - 0.7).cos();
        let mut markers = ellipse(centre, [0.65; 2], droplet, Some(viscosity_inside), tension)?;
        channel(Drive::default(), droplet, wall)?.velocities(&mut markers)?;
        Ok(markers.velocities().iter().step_by(droplet / 16).copied().collect())
    };
    let reference = velocities([256, 384])?;
    let largest = reference.iter().map(|v| v.length()).fold(0.0, f64::max);
    let error = |nodes: &[usize; 2]| {
        let found = velocities(*nodes)?;
        Ok(found.iter().zip(&reference).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max) / largest)
    };
    nodes.iter().map(error).collect()
}
