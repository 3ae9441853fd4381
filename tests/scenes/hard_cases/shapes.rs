//! Droplets without particles of difficult shapes, and some that are carried far.

use motile::active_interface::{ActiveDroplet, Curve};
use motile::base::{Drive, Region, Vec2};
use motile::boundary_integrals::{BoundaryIntegral, Settings};
use motile::ib_core::{BSpline, ImmersedBoundary};
use motile::scene::{Hydrodynamics, Scene};
use motile::setup::AnyFlow;
use motile::stokes_grid::{ChannelStokes, Grid, PeriodicStokes};

use crate::hard_cases::drive::{ADAPTIVE, run, run_way};
use crate::hard_cases::{CaseError, Look, Outcome, Recipe, Trial, Way, Weight, expand};

const SPACING: f64 = 0.1;

/// A droplet of constant tension 10 in a box of fluid of viscosity 10.
fn relax(way: Way, curve: &Curve, side: f64, until: f64, look: Look<'_>) -> Result<Outcome, CaseError> {
    let flow: AnyFlow = match way {
        Way::Integral => {
            let settings = Settings { nodes: 192, ..Settings::default() };
            let flow = BoundaryIntegral::new(Region::Box { lengths: [side, side] }, 10.0, settings)
                .and_then(|flow| flow.with_reference_perimeter(curve.perimeter()));
            Box::new(flow.map_err(motile::SetupError::from)?)
        }
        _ => {
            let cells = (side / SPACING).round() as usize;
            let solver = PeriodicStokes::new(Grid::periodic(cells, cells, SPACING)?, 10.0)?;
            Box::new(ImmersedBoundary::new(solver, BSpline::<4>))
        }
    };
    let markers = match way {
        Way::Integral => curve.markers(192)?,
        _ => curve.markers_with_spacing(0.5 * SPACING)?,
    };
    let mut scene = Scene::new(flow);
    scene.add(ActiveDroplet::passive(&markers, 10.0)?);
    // Half of what is stable would make for a change of area of 1e-3: as much as the time step's error.
    match way {
        Way::Chebyshev => run_way(way, scene, until, look),
        _ => Ok(run(scene, until, ADAPTIVE, look)),
    }
}

/// Change of the area of shapes that relax.
const RELAXED: f64 = 1e-4;

/// A channel of viscosity 1 in which the fluid is driven, with a droplet of tension 10 at the height y.
fn carried(
    [length, width]: [f64; 2],
    y: f64,
    drive: Drive,
    way: Way,
    until: f64,
    look: Look<'_>,
) -> Result<Outcome, CaseError> {
    let cells = [length, width].map(|side| (side / SPACING).round() as usize);
    let mut solver = ChannelStokes::new(Grid::channel(cells[0], cells[1], SPACING)?, 1.0)?;
    solver.set_drive(drive)?;
    let flow: AnyFlow = Box::new(ImmersedBoundary::new(solver, BSpline::<4>));
    let mut scene = Scene::new(flow);
    let curve = Curve::circle(1.0)?.translated(Vec2::new(0.0, y));
    scene.add(ActiveDroplet::passive(&curve.markers_with_spacing(0.5 * SPACING)?, 10.0)?);
    run_way(way, scene, until, look)
}

pub(crate) fn trials() -> Vec<Trial> {
    expand(&[
        // A mean speed of one; the droplet in the middle is faster.
        Recipe::new(9, "across the periodic boundary", &[Way::Grid], |way, extent, look| {
            carried([3.0, 3.0], 0.0, Drive::Flux(3.0), way, extent.pick(15.0, 300.0), look)
        }),
        Recipe::new(12, "a 5:1 ellipse relaxes", &[Way::Grid, Way::Integral, Way::Chebyshev], |way, extent, look| {
            let stretch = 5.0_f64.sqrt();
            relax(way, &Curve::ellipse(stretch, 1.0 / stretch)?, 6.0, extent.pick(3.0, 40.0), look)
        })
        .area_within(RELAXED),
        Recipe::new(
            12,
            "a star with five deep lobes relaxes",
            &[Way::Grid, Way::Integral, Way::Chebyshev],
            |way, extent, look| {
                let curve = Curve::fourier(1.0, &[0.0, 0.0, 0.0, 0.0, 0.6], &[])?;
                relax(way, &curve, 6.0, extent.pick(3.0, 40.0), look)
            },
        )
        .area_within(RELAXED),
        Recipe::new(17, "driven along a wall at a gap of 1.5 h", &[Way::Grid, Way::Chebyshev], |way, extent, look| {
            carried([6.0, 4.0], -1.0 + 1.5 * SPACING, Drive::Gradient(-1.0), way, extent.pick(3.0, 60.0), look)
        }),
        Recipe::new(18, "a net force in a periodic box", &[Way::Grid], |way, extent, look| {
            let solver = PeriodicStokes::new(Grid::periodic(60, 60, SPACING)?, 10.0)?;
            let flow: AnyFlow = Box::new(ImmersedBoundary::new(solver, BSpline::<4>));
            assert!(flow.fluid_view().domain.walls.is_none());
            let mut scene = Scene::new(flow);
            let curve = Curve::circle(1.0)?;
            scene.add(ActiveDroplet::passive(&curve.markers_with_spacing(0.5 * SPACING)?, 10.0)?);
            scene.add(Weight::new(16, 0.4, Vec2::new(1.0, -2.0)));
            run_way(way, scene, extent.pick(5.0, 60.0), look)
        }),
    ])
}
