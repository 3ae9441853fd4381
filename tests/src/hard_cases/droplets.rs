//! Single droplets: strong activity, contrasts of viscosity, coarse and odd grids, narrow places.

use motile::stokes_grid::Drive;
use motile::{Swimmer, active_interface::ActiveDroplet};

use crate::hard_cases::drive::{ADAPTIVE, run, run_way, swimmer};
use crate::hard_cases::{CaseError, Ending, Extent, Look, Outcome, Recipe, Trial, Way, expand};

const ALL: &[Way] = &[Way::Grid, Way::Integral, Way::Thesis];
const EVERY: &[Way] = &[Way::Grid, Way::Integral, Way::Thesis, Way::Chebyshev];
const ACCURATE: &[Way] = &[Way::Grid, Way::Integral, Way::Chebyshev];

/// Markers that move with the fluid, unfiltered, take on wiggles in long runs, on which the interface crosses itself.
const WIGGLING: &[Ending] = &[Ending::Finished, Ending::SelfCrossing];
/// Films that drain for a long time become thinner than a grid can see.
const DRAINED: &[Ending] = &[Ending::Finished, Ending::Crossing];

fn coarse() -> Swimmer {
    Swimmer { spacing: 0.1, ..Swimmer::default() }
}

fn in_box(way: Way, base: &Swimmer, until: f64, look: Look<'_>) -> Result<Outcome, CaseError> {
    run_way(way, swimmer(way, base).build()?.0, until, look)
}

pub(crate) fn trials() -> Vec<Trial> {
    expand(&[
        Recipe::new(1, "activity -15, viscosity 750, A = 30", EVERY, |way, extent, look| {
            let base = Swimmer { activity: -15.0, excluded_volume: 30.0, viscosity: 750.0, ..coarse() };
            in_box(way, &base, extent.pick(5.0, 60.0), look)
        }),
        Recipe::new(1, "activity -5, A = 3: no plateau", ALL, |way, _, look| {
            in_box(way, &Swimmer { activity: -5.0, excluded_volume: 3.0, ..coarse() }, 200.0, look)
        })
        .ending_in(&[Ending::Collapsed]),
        Recipe::new(2, "viscosity ratio 1000", ALL, |way, extent, look| {
            let base = Swimmer { activity: -3.0, viscosity: 10.0, viscosity_inside: Some(1e4), ..coarse() };
            in_box(way, &base, extent.pick(4.0, 40.0), look)
        }),
        Recipe::new(2, "viscosity ratio 0.001", ALL, |way, extent, look| {
            let base = Swimmer { activity: -3.0, viscosity: 100.0, viscosity_inside: Some(0.1), ..coarse() };
            in_box(way, &base, extent.pick(1.0, 20.0), look)
        }),
        Recipe::new(3, "viscosity 10, tension up to 1000", ACCURATE, low_viscosity),
        Recipe::new(3, "viscosity 10, tension up to 1000", &[Way::Thesis], low_viscosity).ending_in(WIGGLING),
        Recipe::new(5, "five cells a radius", &[Way::Grid], five_cells),
        Recipe::new(5, "five cells a radius", &[Way::Thesis], five_cells).ending_in(WIGGLING),
        Recipe::new(6, "a box of 2.2 R0", &[Way::Integral], narrow_box),
        Recipe::new(6, "a box of 2.2 R0", &[Way::Grid, Way::Thesis], narrow_box).ending_in(DRAINED),
        Recipe::new(7, "a circle that touches both walls", ALL, |way, extent, look| {
            let base = Swimmer { activity: -4.0, lengths: [6.0, 2.0], ..coarse() };
            let scene = swimmer(way, &base).build_in_channel(Drive::ZeroGradient)?.0;
            run_way(way, scene, extent.pick(5.0, 60.0), look)
        })
        .area_within(2e-3),
        Recipe::new(10, "a long time: no creep", &[Way::Grid, Way::Integral], long),
        Recipe::new(10, "a long time: no creep", &[Way::Thesis], long).ending_in(WIGGLING),
        Recipe::new(11, "no particles on half of the interface", EVERY, |way, extent, look| {
            filled(way, extent, look, |x| if x < 0.5 { 1.0 } else { 0.0 })
        }),
        Recipe::new(11, "all particles on a twentieth of the interface", EVERY, |way, extent, look| {
            filled(way, extent, look, |x| (-((x - 0.5) / 0.03).powi(2)).exp())
        }),
        // The finer the resolution, the more they are crowded: pushed apart they make the tension there -1e5, and under
        // a negative tension an interface buckles the faster the shorter the waves that it has. There is nothing to
        // converge to.
        Recipe::new(11, "all particles on one segment", EVERY, |way, extent, look| {
            let mut first = true;
            let all_on_one = |_: f64| f64::from(u8::from(std::mem::take(&mut first)));
            filled(way, extent, look, all_on_one)
        })
        .ending_in(&[Ending::Finished, Ending::Stagnated, Ending::SelfCrossing]),
        Recipe::new(16, "a grid of 7 x 1000", &[Way::Grid, Way::Thesis], |way, extent, look| {
            let base = Swimmer { spacing: 0.3, lengths: [2.1, 300.0], ..coarse() };
            in_box(way, &base, extent.pick(1.0, 10.0), look)
        })
        .ending_in(DRAINED)
        .area_within(1e-2),
        Recipe::new(16, "a grid of 997 x 991", &[Way::Grid], |way, extent, look| {
            let base = Swimmer { spacing: 0.0125, lengths: [12.4625, 12.3875], ..coarse() };
            in_box(way, &base, extent.pick(0.01, 0.1), look)
        }),
        Recipe::new(19, "markers 2 h apart", &[Way::Grid, Way::Thesis], |way, extent, look| {
            in_box(way, &Swimmer { marker_spacing: Some(0.2), ..coarse() }, extent.pick(5.0, 60.0), look)
        })
        .area_within(2e-2),
        Recipe::new(19, "markers h/10 apart", &[Way::Grid, Way::Thesis], |way, extent, look| {
            in_box(way, &Swimmer { marker_spacing: Some(0.01), ..coarse() }, extent.pick(0.5, 20.0), look)
        }),
    ])
}

fn long(way: Way, extent: Extent, look: Look<'_>) -> Result<Outcome, CaseError> {
    in_box(way, &coarse(), extent.pick(40.0, 1000.0), look)
}

fn low_viscosity(way: Way, extent: Extent, look: Look<'_>) -> Result<Outcome, CaseError> {
    let base = Swimmer { activity: -5.0, excluded_volume: 10.0, viscosity: 10.0, ..coarse() };
    in_box(way, &base, extent.pick(0.5, 10.0), look)
}

fn five_cells(way: Way, extent: Extent, look: Look<'_>) -> Result<Outcome, CaseError> {
    in_box(way, &Swimmer { activity: -4.0, spacing: 0.2, ..coarse() }, extent.pick(20.0, 100.0), look)
}

fn narrow_box(way: Way, extent: Extent, look: Look<'_>) -> Result<Outcome, CaseError> {
    in_box(way, &Swimmer { activity: -3.0, lengths: [2.2, 2.2], ..coarse() }, extent.pick(5.0, 60.0), look)
}

/// A droplet whose particles are spread as `density` says for places along the interface from 0 to 1, whatever its sum.
fn filled(way: Way, extent: Extent, look: Look<'_>, density: impl FnMut(f64) -> f64) -> Result<Outcome, CaseError> {
    let swimmer = swimmer(way, &coarse());
    let (mut scene, handle) = swimmer.build()?;
    let body = scene.body(handle)?;
    let count = body.markers().len();
    let shares: Vec<f64> = (0..count).map(|k| (k as f64 + 0.5) / count as f64).map(density).collect();
    let unit = body.particle_numbers().iter().sum::<f64>() / shares.iter().sum::<f64>();
    let numbers = shares.iter().map(|share| unit * share).collect();
    let droplet = ActiveDroplet::new(body.markers(), numbers, swimmer.tension()?, swimmer.diffusion)?
        .with_motion(swimmer.motion)
        .with_flux(swimmer.flux)
        .with_area_constraint(swimmer.area_constraint);
    *scene.body_mut(handle)? = droplet;
    let until = extent.pick(1.0, 20.0);
    match way {
        // The start is over in a thousandth of the time that the rest takes.
        Way::Integral => Ok(run(scene, until, ADAPTIVE, look)),
        _ => run_way(way, scene, until, look),
    }
}
