//! Errors of passive shapes and solids.

use std::f64::consts::TAU;

use anyhow::{Result, anyhow, bail};
use motile::active_interface::{ActiveDroplet, Curve, Motion, polygon_moments};
use motile::base::{Region, Vec2};
use motile::boundary_integrals::{self, BoundaryIntegral, PeriodicCalculus, TensionPlacement};
use motile::elastic_solids::mesh::fitted_strip;
use motile::elastic_solids::{NeoHookean, Solid};
use motile::ib_core::{AnyKernel, ImmersedBoundary};
use motile::scene::{Hydrodynamics, MarkerKind, Markers, Scene};
use motile::setup::AnyFlow;
use motile::stokes_grid::{ChannelStokes, Grid, PeriodicStokes};
use motile_tests::validation::{Case, Reference, fixed_shapes, solids::slide};

use crate::work_precision::cost::{Cost, march, repeat};
use crate::work_precision::settings::{Flow, Preset, Settings};

fn grid_flow(settings: &Settings, h: f64) -> Result<ImmersedBoundary<PeriodicStokes, AnyKernel>> {
    let cells = (6.0 / h).round() as usize;
    let solver = PeriodicStokes::new(Grid::periodic(cells, cells, h)?, 1.0)?;
    Ok(if settings.corrected {
        ImmersedBoundary::new(solver, settings.kernel)
    } else {
        ImmersedBoundary::uncorrected(solver, settings.kernel)
    })
}

fn integral_flow(nodes: usize) -> Result<BoundaryIntegral> {
    let region = Region::Box { lengths: [6.0, 6.0] };
    let settings = boundary_integrals::Settings { nodes, ..boundary_integrals::Settings::default() };
    Ok(BoundaryIntegral::new(region, 1.0, settings)?)
}

/// Velocities on the ellipse of the reference table.
pub(crate) fn fixed_ellipse(settings: &Settings) -> Result<(f64, Cost)> {
    let case = Case::EllipseGradient;
    match settings.flow {
        Flow::Grid { h, .. } => {
            let mut flow = grid_flow(settings, h)?;
            let (errors, mut markers) = fixed_shapes::compare(&mut flow, h, case)?;
            Ok((errors.maximum, repeat(|| Ok(flow.velocities(&mut markers).map(|_| ())?))?))
        }
        Flow::Integrals { nodes, .. } => {
            let mut flow = integral_flow(nodes)?;
            let mut markers = exact_ellipse(nodes.next_multiple_of(8))?;
            flow.velocities(&mut markers)?;
            let every = markers.len() / 8;
            let seen: Vec<Vec2> = markers.velocities().iter().step_by(every).copied().collect();
            let error = fixed_shapes::compare_velocities(&seen, case)?.maximum;
            Ok((error, repeat(|| Ok(flow.velocities(&mut markers).map(|_| ())?))?))
        }
    }
}

/// Markers at equal steps of the parameter with spectrally accurate forces.
fn exact_ellipse(count: usize) -> Result<Markers> {
    let mut markers = Markers::new();
    markers.push_group(count, MarkerKind::UnevenInterface { viscosity_inside: None });
    let angle = |k: usize| TAU * k as f64 / count as f64;
    for (k, position) in markers.positions_mut().iter_mut().enumerate() {
        *position = Vec2::new(1.3 * angle(k).cos(), angle(k).sin() / 1.3);
    }
    let tension: Vec<f64> = (0..count).map(|k| 1.0 + 0.5 * angle(k).cos()).collect();
    let [positions, forces, _] = markers.lists_mut();
    PeriodicCalculus::new(count)?.tension_forces(positions, &tension, TensionPlacement::Points, forces)?;
    Ok(markers)
}

/// Aspect ratio, less one, of the relaxing ellipse at t = 2.
pub(crate) fn relaxation(settings: &Settings) -> Result<(f64, Cost)> {
    let all = Reference::read("ellipse_relaxation_box6")?;
    let expected = all.select("eta_in", "1").select("t", "2").value("AR_moment")?;
    let curve = Curve::ellipse(1.3, 1.0 / 1.3)?;
    let count = match settings.flow {
        Flow::Grid { h, ratio, .. } => 2 * (0.5 * curve.perimeter() / (ratio * h)).round() as usize,
        Flow::Integrals { elements, .. } => elements,
    };
    let make = || {
        let flow: AnyFlow = match settings.flow {
            Flow::Grid { h, .. } => Box::new(grid_flow(settings, h)?),
            Flow::Integrals { nodes, .. } => Box::new(integral_flow(nodes)?),
        };
        let mut scene = Scene::new(flow).with_step_size(settings.step);
        let droplet = ActiveDroplet::passive(&curve.markers(count)?, 1.0)?;
        scene.add(match settings.preset {
            Preset::Default => droplet,
            Preset::Thesis => droplet.with_motion(Motion::WithFluid).with_area_constraint(true),
        });
        Ok(scene)
    };
    let (cost, ratio) = march(make, settings.stepper, 2.0, |system| {
        let (_, body) = system.bodies::<ActiveDroplet>().next().ok_or_else(|| anyhow!("no droplet"))?;
        let moments = polygon_moments(body.markers())?;
        Ok((moments.xx / moments.yy).sqrt())
    })?;
    Ok(((ratio - 1.0) / (expected - 1.0) - 1.0, cost))
}

/// Thickness of the layer with which the lattice is equilateral, height of the channel, period, viscosity, shear
/// modulus and shear.
const THICKNESS: f64 = 0.866_025_403_784_438_6;
const HEIGHT: f64 = 2.0;
const LENGTH: f64 = 1.6;
const VISCOSITY: f64 = 10.0;
const SHEAR: f64 = 5.0;
const AMPLITUDE: f64 = 0.3;

/// Rate at which a sheared layer relaxes: the stress is `eta dgamma/dt + mu gamma` in it, `eta du/dy` above, and the
/// same everywhere, so that with both walls at rest gamma decays at the rate `mu/eta (1 - a/H)`.
pub(crate) fn elastic_layer(settings: &Settings) -> Result<(f64, Cost)> {
    let Flow::Grid { h, ratio, .. } = settings.flow else { bail!("solids need a grid") };
    let grid = Grid::channel((LENGTH / h).round() as usize, (HEIGHT / h).round() as usize, h)?;
    let solid = || -> Result<Solid> {
        let mesh = fitted_strip(Vec2::new(0.0, -0.5 * HEIGHT), [LENGTH, THICKNESS], ratio * h)?;
        let solid = Solid::hyperelastic(mesh, NeoHookean::new(SHEAR, 3.0 * SHEAR)?)
            .pinned(|s| s.y < -0.5 * HEIGHT + 1e-9)?
            .deformed(|s| s + Vec2::new(AMPLITUDE * (s.y + 0.5 * HEIGHT), 0.0))?;
        Ok(solid)
    };
    let make = || {
        let flow = ImmersedBoundary::new(ChannelStokes::new(grid, VISCOSITY)?, settings.kernel);
        let mut scene = Scene::new(flow).with_step_size(settings.step);
        scene.add(solid()?);
        Ok(scene)
    };
    let start = slide(&solid()?);
    let time = VISCOSITY / SHEAR;
    let (cost, end) = march(make, settings.stepper, time, |system| {
        let (_, layer) = system.bodies::<Solid>().next().ok_or_else(|| anyhow!("no solid"))?;
        Ok(slide(layer))
    })?;
    let rate = -(end / start).ln();
    let per_time = Cost { seconds: cost.seconds * time, pairs: cost.pairs * time, steps: cost.steps * time, ..cost };
    Ok((rate / (1.0 - THICKNESS / HEIGHT) - 1.0, per_time))
}
