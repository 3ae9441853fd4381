//! Droplets of fixed shape between curved rigid walls, and flow along such walls.

use std::f64::consts::TAU;

use motile::base::{Drive, FlowSample, Region, Vec2};
use motile::boundary_integrals::{BoundaryIntegral, PeriodicCalculus, RigidWall, Settings, TensionPlacement};
use motile::elastic_solids::ChannelShape;
use motile::scene::{Hydrodynamics, MarkerKind, Markers};
use motile::setup::{Built, DropletSetup, Setup, WallSetup};

use super::scene::{open_channel, without_grid};
use super::{Reference, ReferenceFile, StudyError};

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
    let (velocities, global) =
        (Reference::read(ReferenceFile::CurvedWalls)?, Reference::read(ReferenceFile::CurvedWallsGlobal)?);
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

/// Speed (length per time) at a time of a swimmer in this channel that started where it is widest, with so many nodes;
/// four cells of the concentration a node.
///
/// # Errors
/// A scene that cannot be set up, a run that fails.
pub fn speed(activity: f64, nodes: usize, time: f64) -> Result<f64, StudyError> {
    let shape = ChannelShape::Sinusoidal { width: 2.0 * HALF_WIDTH, amplitude: AMPLITUDE, waves: 1, phase: 0.0 };
    let setup = Setup {
        region: open_channel(PERIOD, WIDTH),
        walls: WallSetup::channel(&shape, 0.05),
        droplets: vec![DropletSetup::active(activity)],
        ..without_grid(nodes, 4 * nodes)
    };
    let Built { mut scene, droplets, .. } = setup.build()?;
    scene.run(time).go()?;
    Ok(scene.observe(droplets[0])?.speed())
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

/// The pressure gradient that drives a unit flux of unit viscosity through a channel between
/// y = -(1 + amplitude cos(2 pi x/length)) and its mirror image, by layers of so many nodes a wall.
///
/// # Errors
/// A scene that cannot be.
pub fn gradient(length: f64, amplitude: f64, nodes: usize) -> Result<f64, StudyError> {
    let half = |x: f64| 1.0 + amplitude * (TAU * x / length).cos();
    let region = Region::Channel { length, width: 2.0 * (1.5 + amplitude), drive: Drive::Flux(1.0) };
    let settings = Settings { nodes: 32, tolerance: 1e-13, ..Settings::default() };
    let walls = [RigidWall::below(length, nodes, |x| -half(x))?, RigidWall::above(length, nodes, half)?];
    let mut flow = BoundaryIntegral::new(region, 1.0, settings)?.with_walls(&walls)?;
    // Fluid in fluid, which changes nothing.
    let mut markers = Markers::new();
    markers.push_group(32, MarkerKind::UnevenInterface { viscosity_inside: None });
    for (k, position) in markers.positions_mut().iter_mut().enumerate() {
        *position = 0.2 * Vec2::from_angle(TAU * k as f64 / 32.0);
    }
    Ok(-flow.velocities(&mut markers)?.mean_pressure_gradient[0])
}

/// Mean pressure gradient to the second power of the amplitude, from the boundary conditions expanded about the
/// straight sides: with k = 2 pi/length, `3/2 (1 + amplitude^2 (3 k sinh(k)^2/(sinh(k) cosh(k) - k) - 3/2))`.
#[must_use]
pub fn small_amplitude(length: f64, amplitude: f64) -> f64 {
    let k = TAU / length;
    let (sinh, cosh) = (k.sinh(), k.cosh());
    1.5 * (1.0 + amplitude * amplitude * (3.0 * k * sinh * sinh / (sinh * cosh - k) - 1.5))
}

/// Mean pressure gradient in the limit of a long channel: 3/2 times the mean of 1/h^3, h the half width.
#[must_use]
pub fn lubrication(amplitude: f64) -> f64 {
    let square = amplitude * amplitude;
    1.5 * (1.0 + 0.5 * square) / (1.0 - square).powf(2.5)
}
