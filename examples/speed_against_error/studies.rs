//! The scenes and what their errors are.

use std::f64::consts::TAU;

use anyhow::{Result, ensure};
use motile::active_interface::{ActiveDroplet, Convention, Curve, observe, polygon_moments};
use motile::boundary_integral::{self, BoundaryIntegral, PeriodicCalculus, TensionPlacement};
use motile::elastic_solids::{ElasticForces, ElasticSolid, NeoHookean, Solid, fitted_strip};
use motile::ib_core::{
    AnyKernel, Handle, Hydrodynamics, ImmersedBoundary, MarkerKind, Markers, MobilityDeficit, Scene, StepSize, Vec2,
};
use motile::stokes_grid::{ChannelStokes, Drive, Grid, PeriodicStokes};
use motile::{AnyFlow, Method, Swimmer};
use motile_validation::{Case, Reference, ReferenceFile, fixed_shapes};

use crate::cost::{Cost, Marched, march, repeat};
use crate::settings::{Flow, Preset, Settings};

/// A scene whose error is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Study {
    FixedEllipse,
    Relaxation,
    Steady,
    Transient,
    Ratio10,
    Ratio100,
    Channel,
    ElasticLayer,
}

impl Study {
    pub(crate) const ALL: [Self; 8] = [
        Self::FixedEllipse,
        Self::Relaxation,
        Self::Steady,
        Self::Transient,
        Self::Ratio10,
        Self::Ratio100,
        Self::Channel,
        Self::ElasticLayer,
    ];

    /// For files.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::FixedEllipse => "fixed_ellipse",
            Self::Relaxation => "relaxation",
            Self::Steady => "steady_swimmer",
            Self::Transient => "transient",
            Self::Ratio10 => "ratio_10",
            Self::Ratio100 => "ratio_100",
            Self::Channel => "channel",
            Self::ElasticLayer => "elastic_layer",
        }
    }

    pub(crate) fn title(self) -> &'static str {
        match self {
            Self::FixedEllipse => "(a) Velocities on a fixed ellipse",
            Self::Relaxation => "(b) Relaxation of an ellipse",
            Self::Steady => "(c) Steady swimmer",
            Self::Transient => "(d) Transient of a swimmer",
            Self::Ratio10 => "(e) Swimmer ten times as viscous as its surroundings",
            Self::Ratio100 => "(e) Swimmer a hundred times as viscous as its surroundings",
            Self::Channel => "(f) Swimmer in a channel of width 2",
            Self::ElasticLayer => "(g) Elastic layer",
        }
    }

    /// The scene and its error.
    pub(crate) fn about(self) -> &'static str {
        match self {
            Self::FixedEllipse => {
                "Ellipse 1.3 : 1/1.3 with the tension 1 + 0.5 cos t in a 6 x 6 box; largest error of the velocity at eight points, over \
                 the largest velocity there; cost per evaluation of the velocities."
            }
            Self::Relaxation => {
                "The same ellipse with tension and viscosity 1 relaxes to t = 2; error of its aspect ratio less one."
            }
            Self::Steady => {
                "Activity -2, excluded volume 4, viscosity 100, 6 x 6 box, from the polarised start to t = 80; error of the speed."
            }
            Self::Transient => {
                "Activity -1, excluded volume 2, 6 x 6 box, from the polarised start; largest error of the speed at the times of the \
                 reference."
            }
            Self::Ratio10 => {
                "Activity -1, excluded volume 2, viscosity 100 in surroundings of 10, 6 x 6 box, t = 80; error of the speed."
            }
            Self::Ratio100 => {
                "Activity -1, excluded volume 2, viscosity 100 in surroundings of 1, 6 x 6 box, t = 80; error of the speed against boundary \
                 integrals with 160 nodes and 1280 cells."
            }
            Self::Channel => {
                "Activity -2, excluded volume 10, viscosity 100, period 12, width 2, no mean pressure gradient, t = 80; error of the speed."
            }
            Self::ElasticLayer => {
                "A sheared neo-Hookean layer on a wall relaxes below a fluid as viscous (channel of height 2, layer 0.87) over one time \
                 eta/mu; error of the rate against mu/eta (1 - a/H); cost per time eta/mu."
            }
        }
    }

    /// Error and cost.
    pub(crate) fn run(self, settings: &Settings) -> Result<(f64, Cost)> {
        match self {
            Self::FixedEllipse => fixed_ellipse(settings),
            Self::Relaxation => relaxation(settings),
            Self::Steady => {
                let reference = Reference::read(ReferenceFile::SteadySwimmers)?.select("zeta_dmu", "-2.0");
                steady(&boxed(settings, -2.0, None), settings, reference.value("speed")?)
            }
            Self::Transient => transient(settings),
            Self::Ratio10 => {
                let reference = Reference::read(ReferenceFile::SteadySwimmerContrast)?.select("zeta_dmu", "-1.0");
                steady(&boxed(settings, -1.0, Some(10.0)), settings, reference.value("speed")?)
            }
            Self::Ratio100 => steady(&boxed(settings, -1.0, Some(1.0)), settings, RATIO_100),
            Self::Channel => {
                let reference = Reference::read(ReferenceFile::ChannelSwimmers)?
                    .select("conv", "p0")
                    .select("w", "2")
                    .select("zeta_dmu", "-2.0");
                channel(settings, reference.value("speed")?)
            }
            Self::ElasticLayer => elastic_layer(settings),
        }
    }
}

/// Speed of the swimmer of ratio 100 with 160 nodes, 1280 cells and steps of a quarter of the limit
/// (`--reference` computes it).
const RATIO_100: f64 = 0.0;

/// Time by which a swimmer is steady.
const STEADY: f64 = 80.0;

/// The swimmer of the reference tables for a box; the surroundings may have another viscosity.
pub(crate) fn boxed(settings: &Settings, activity: f64, outside: Option<f64>) -> Swimmer {
    Swimmer {
        activity,
        excluded_volume: 2.0 * activity.abs(),
        viscosity: outside.unwrap_or(100.0),
        viscosity_inside: outside.map(|_| 100.0),
        lengths: [6.0; 2],
        ..settings.swimmer()
    }
}

/// Speed at present.
fn speed(scene: &mut dyn Marched<AnyFlow>, droplet: Handle<ActiveDroplet>) -> Result<f64> {
    let system = scene.system();
    system.evaluate()?;
    let body: &ActiveDroplet = system.find().ok_or_else(|| anyhow::anyhow!("no droplet"))?;
    Ok(observe(&body.interface_state(system, droplet.index()), Convention::FarField)?.speed())
}

fn steady(swimmer: &Swimmer, settings: &Settings, reference: f64) -> Result<(f64, Cost)> {
    ensure!(reference > 0.0, "there is no reference value");
    let (scene, droplet) = swimmer.build()?;
    let (cost, found) = march(scene, settings.stepper, STEADY, |scene| speed(scene, droplet))?;
    Ok((found / reference - 1.0, cost))
}

/// The speed that [`Study::Ratio100`] compares with.
pub(crate) fn reference_of_ratio_100() -> Result<f64> {
    let settings = Settings::integrals(160, 1280).with_step(StepSize::OfLimit(0.25));
    let (scene, droplet) = boxed(&settings, -1.0, Some(1.0)).build()?;
    Ok(march(scene, settings.stepper, STEADY, |scene| speed(scene, droplet))?.1)
}

fn channel(settings: &Settings, reference: f64) -> Result<(f64, Cost)> {
    let swimmer = Swimmer { activity: -2.0, excluded_volume: 10.0, lengths: [12.0, 2.0], ..settings.swimmer() };
    let (scene, droplet) = swimmer.build_in_channel(Drive::ZeroGradient)?;
    let (cost, found) = march(scene, settings.stepper, STEADY, |scene| speed(scene, droplet))?;
    Ok((found / reference - 1.0, cost))
}

fn transient(settings: &Settings) -> Result<(f64, Cost)> {
    let reference = Reference::read(ReferenceFile::Transient)?;
    let (times, speeds) = (reference.column("t")?, reference.column("speed")?);
    let (mut scene, droplet) = boxed(settings, -1.0, None).build()?;
    let mut worst = 0.0_f64;
    for (&time, expected) in times.iter().zip(speeds) {
        if time > 0.0 {
            scene.run(time).go()?;
        }
        let error = speed(&mut scene, droplet)? / expected - 1.0;
        if error.abs() > worst.abs() {
            worst = error;
        }
    }
    // The cost from a run nobody interrupts.
    let (scene, _) = boxed(settings, -1.0, None).build()?;
    let end = times.iter().fold(0.0_f64, |a, &t| a.max(t)).min(10.0);
    let (cost, ()) = march(scene, settings.stepper, end, |_| Ok(()))?;
    Ok((worst, cost))
}

fn periodic(h: f64) -> Result<PeriodicStokes> {
    let cells = (6.0 / h).round() as usize;
    Ok(PeriodicStokes::new(Grid::periodic(cells, cells, h)?, 1.0)?)
}

fn grid_flow(settings: &Settings, h: f64) -> Result<ImmersedBoundary<PeriodicStokes, AnyKernel>> {
    let solver = periodic(h)?;
    Ok(if settings.corrected {
        ImmersedBoundary::new(solver, settings.kernel)
    } else {
        ImmersedBoundary::uncorrected(solver, settings.kernel)
    })
}

fn integral_flow(nodes: usize) -> Result<BoundaryIntegral<boundary_integral::PeriodicBox>> {
    let domain = boundary_integral::PeriodicBox::new(6.0, 6.0)?;
    let settings =
        boundary_integral::Settings { nodes, reference_perimeter: TAU, ..boundary_integral::Settings::default() };
    Ok(BoundaryIntegral::new(domain, 1.0, settings)?)
}

fn fixed_ellipse(settings: &Settings) -> Result<(f64, Cost)> {
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
            let seen: Vec<Vec2> = markers.velocities.iter().step_by(every).copied().collect();
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
    for (k, position) in markers.positions.iter_mut().enumerate() {
        *position = Vec2::new(1.3 * angle(k).cos(), angle(k).sin() / 1.3);
    }
    let tension: Vec<f64> = (0..count).map(|k| 1.0 + 0.5 * angle(k).cos()).collect();
    let (positions, forces) = (&markers.positions, &mut markers.forces);
    PeriodicCalculus::new(count)?.tension_forces(positions, &tension, TensionPlacement::Markers, forces)?;
    Ok(markers)
}

fn relaxation(settings: &Settings) -> Result<(f64, Cost)> {
    let all = Reference::read(ReferenceFile::EllipseRelaxation)?;
    let expected = all.select("eta_in", "1").select("t", "2").value("AR_moment")?;
    let curve = Curve::ellipse(1.3, 1.0 / 1.3)?;
    let (flow, count): (AnyFlow, usize) = match settings.flow {
        Flow::Grid { h, ratio, .. } => {
            (Box::new(grid_flow(settings, h)?), 2 * (0.5 * curve.perimeter() / (ratio * h)).round() as usize)
        }
        Flow::Integrals { nodes, cells } => (Box::new(integral_flow(nodes)?), cells),
    };
    let mut scene = Scene::new(flow).with_step_size(settings.step);
    let droplet = ActiveDroplet::passive(&curve.markers(count)?, 1.0)?;
    scene.add(match settings.preset {
        Preset::Default => droplet,
        Preset::Thesis => {
            let thesis = Swimmer::thesis();
            droplet.with_motion(thesis.motion).with_area_constraint(thesis.area_constraint)
        }
    });
    let (cost, ratio) = march(scene, settings.stepper, 2.0, |scene| {
        let body: &ActiveDroplet = scene.system().find().ok_or_else(|| anyhow::anyhow!("no droplet"))?;
        let moments = polygon_moments(body.markers())?;
        Ok((moments.xx / moments.yy).sqrt())
    })?;
    Ok(((ratio - 1.0) / (expected - 1.0) - 1.0, cost))
}

/// Thickness of the layer with which the lattice is equilateral, height of the channel, period, viscosity, shear modulus and shear.
const THICKNESS: f64 = 0.866_025_403_784_438_6;
const HEIGHT: f64 = 2.0;
const LENGTH: f64 = 1.6;
const VISCOSITY: f64 = 10.0;
const SHEAR: f64 = 5.0;
const AMPLITUDE: f64 = 0.3;

fn elastic_layer(settings: &Settings) -> Result<(f64, Cost)> {
    let Flow::Grid { h, ratio, .. } = settings.flow else { anyhow::bail!("solids need a grid") };
    ensure!(settings.swimmer().method == Method::ImmersedBoundary, "solids need a grid");
    let grid = Grid::channel((LENGTH / h).round() as usize, (HEIGHT / h).round() as usize, h)?;
    let mut scene = Scene::new(ImmersedBoundary::new(ChannelStokes::new(grid, VISCOSITY)?, settings.kernel))
        .with_step_size(settings.step);
    let mesh = fitted_strip(Vec2::new(0.0, -0.5 * HEIGHT), [LENGTH, THICKNESS], ratio * h)?;
    let solid = ElasticSolid::new(mesh, NeoHookean::new(SHEAR, 3.0 * SHEAR)?)
        .pinned(|s| s.y < -0.5 * HEIGHT + 1e-9)?
        .deformed(|s| s + Vec2::new(AMPLITUDE * (s.y + 0.5 * HEIGHT), 0.0))?;
    let solid =
        if settings.corrected { solid.surface_corrected(&MobilityDeficit::new(&settings.kernel)) } else { solid };
    let start = slide(&solid);
    scene.add(solid);
    let time = VISCOSITY / SHEAR;
    let (cost, end) = march(scene, settings.stepper, time, |scene| {
        let body: &ElasticSolid<NeoHookean> = scene.system().find().ok_or_else(|| anyhow::anyhow!("no solid"))?;
        Ok(slide(body))
    })?;
    let rate = -(end / start).ln();
    let per_time = Cost { seconds: cost.seconds * time, pairs: cost.pairs * time, steps: cost.steps * time, ..cost };
    Ok((rate / (1.0 - THICKNESS / HEIGHT) - 1.0, per_time))
}

/// Mean displacement of the upper surface along x.
fn slide<F: ElasticForces>(solid: &Solid<F>) -> f64 {
    let surface = solid.mesh().boundary_loops().iter().find(|boundary| boundary.periods == -1);
    let displacements: Vec<Vec2> = solid.displacements().collect();
    surface.map_or(f64::NAN, |surface| {
        surface.points.iter().map(|&point| displacements[point].x).sum::<f64>() / surface.points.len() as f64
    })
}
