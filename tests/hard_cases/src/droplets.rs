//! Single droplets: strong activity, contrasts of viscosity, coarse and odd grids, narrow places.

use motile::stokes_grid::Drive;
use motile::{Swimmer, active_interface::ActiveDroplet};

use crate::drive::{ADAPTIVE, run, run_way, swimmer};
use crate::{CaseError, Ending, Extent, Look, Outcome, Recipe, Trial, Way, expand};

const FINISHED: &[Ending] = &[Ending::Finished];
const ALL: &[Way] = &[Way::Grid, Way::Integral, Way::Thesis];

fn coarse() -> Swimmer {
    Swimmer { spacing: 0.1, ..Swimmer::default() }
}

fn in_box(way: Way, base: &Swimmer, until: f64, look: Look<'_>) -> Result<Outcome, CaseError> {
    run_way(way, swimmer(way, base).build()?.0, until, look)
}

pub(crate) fn trials() -> Vec<Trial> {
    expand(&[
        Recipe {
            number: 1,
            name: "activity -15, viscosity 750, A = 30",
            ways: &[Way::Grid, Way::Integral, Way::Thesis, Way::Chebyshev],
            expected: FINISHED,
            area: 1e-3,
            run: |way, extent, look| {
                let base = Swimmer { activity: -15.0, excluded_volume: 30.0, viscosity: 750.0, ..coarse() };
                in_box(way, &base, extent.pick(5.0, 60.0), look)
            },
        },
        Recipe {
            number: 1,
            name: "activity -5, A = 3: no plateau",
            ways: ALL,
            expected: &[Ending::Collapsed],
            area: 1e-3,
            run: |way, _, look| in_box(way, &Swimmer { activity: -5.0, excluded_volume: 3.0, ..coarse() }, 200.0, look),
        },
        Recipe {
            number: 2,
            name: "viscosity ratio 1000",
            ways: ALL,
            expected: FINISHED,
            area: 1e-3,
            run: |way, extent, look| {
                let base = Swimmer { activity: -3.0, viscosity: 10.0, viscosity_inside: Some(1e4), ..coarse() };
                in_box(way, &base, extent.pick(4.0, 40.0), look)
            },
        },
        Recipe {
            number: 2,
            name: "viscosity ratio 0.001",
            ways: ALL,
            expected: FINISHED,
            area: 1e-3,
            run: |way, extent, look| {
                let base = Swimmer { activity: -3.0, viscosity: 100.0, viscosity_inside: Some(0.1), ..coarse() };
                in_box(way, &base, extent.pick(1.0, 20.0), look)
            },
        },
        Recipe {
            number: 3,
            name: "viscosity 10, tension up to 1000",
            ways: &[Way::Grid, Way::Integral, Way::Thesis, Way::Chebyshev],
            expected: FINISHED,
            area: 1e-3,
            run: |way, extent, look| {
                let base = Swimmer { activity: -5.0, excluded_volume: 10.0, viscosity: 10.0, ..coarse() };
                in_box(way, &base, extent.pick(0.5, 10.0), look)
            },
        },
        Recipe {
            number: 5,
            name: "five cells a radius",
            ways: &[Way::Grid, Way::Thesis],
            expected: FINISHED,
            area: 1e-3,
            run: |way, extent, look| {
                in_box(way, &Swimmer { activity: -4.0, spacing: 0.2, ..coarse() }, extent.pick(20.0, 100.0), look)
            },
        },
        Recipe {
            number: 6,
            name: "a box of 2.2 R0",
            ways: ALL,
            expected: FINISHED,
            area: 1e-3,
            run: |way, extent, look| {
                in_box(way, &Swimmer { activity: -3.0, lengths: [2.2, 2.2], ..coarse() }, extent.pick(5.0, 60.0), look)
            },
        },
        Recipe {
            number: 7,
            name: "a circle that touches both walls",
            ways: ALL,
            expected: FINISHED,
            area: 2e-3,
            run: |way, extent, look| {
                let base = Swimmer { activity: -4.0, lengths: [6.0, 2.0], ..coarse() };
                let scene = swimmer(way, &base).build_in_channel(Drive::ZeroGradient)?.0;
                run_way(way, scene, extent.pick(5.0, 60.0), look)
            },
        },
        Recipe {
            number: 10,
            name: "a long time: no creep",
            ways: ALL,
            expected: FINISHED,
            area: 1e-3,
            run: |way, extent, look| in_box(way, &coarse(), extent.pick(40.0, 1000.0), look),
        },
        Recipe {
            number: 11,
            name: "no particles on half of the interface",
            ways: &[Way::Grid, Way::Integral, Way::Thesis, Way::Chebyshev],
            expected: FINISHED,
            area: 1e-3,
            run: |way, extent, look| filled(way, extent, look, |k, count| if 2 * k < count { 2.0 } else { 0.0 }),
        },
        Recipe {
            number: 11,
            name: "all particles on one segment",
            ways: &[Way::Grid, Way::Thesis, Way::Chebyshev],
            expected: FINISHED,
            area: 1e-3,
            run: |way, extent, look| filled(way, extent, look, |k, count| if k == 0 { count as f64 } else { 0.0 }),
        },
        Recipe {
            number: 11,
            name: "all particles on one segment",
            ways: &[Way::Integral],
            // Pushed apart, they make the tension there -1e5: the interface buckles at all wave numbers, where a grid smears what its
            // kernel does not see.
            expected: &[Ending::Stagnated, Ending::SelfCrossing],
            area: 1e-3,
            run: |way, extent, look| filled(way, extent, look, |k, count| if k == 0 { count as f64 } else { 0.0 }),
        },
        Recipe {
            number: 16,
            name: "a grid of 7 x 1000",
            ways: &[Way::Grid, Way::Thesis],
            expected: FINISHED,
            area: 1e-2,
            run: |way, extent, look| {
                let base = Swimmer { spacing: 0.3, lengths: [2.1, 300.0], ..coarse() };
                in_box(way, &base, extent.pick(1.0, 10.0), look)
            },
        },
        Recipe {
            number: 16,
            name: "a grid of 997 x 991",
            ways: &[Way::Grid],
            expected: FINISHED,
            area: 1e-3,
            run: |way, extent, look| {
                let base = Swimmer { spacing: 0.0125, lengths: [12.4625, 12.3875], ..coarse() };
                in_box(way, &base, extent.pick(0.01, 0.1), look)
            },
        },
        Recipe {
            number: 19,
            name: "markers 2 h apart",
            ways: &[Way::Grid, Way::Thesis],
            expected: FINISHED,
            area: 2e-2,
            run: |way, extent, look| {
                in_box(way, &Swimmer { marker_spacing: Some(0.2), ..coarse() }, extent.pick(5.0, 60.0), look)
            },
        },
        Recipe {
            number: 19,
            name: "markers h/10 apart",
            ways: &[Way::Grid, Way::Thesis],
            expected: FINISHED,
            area: 1e-3,
            run: |way, extent, look| {
                in_box(way, &Swimmer { marker_spacing: Some(0.01), ..coarse() }, extent.pick(0.5, 20.0), look)
            },
        },
    ])
}

/// A droplet whose particles are spread as `share` says (times the mean), for the number of a segment and of all.
fn filled(way: Way, extent: Extent, look: Look<'_>, share: impl Fn(usize, usize) -> f64) -> Result<Outcome, CaseError> {
    let swimmer = swimmer(way, &coarse());
    let (mut scene, handle) = swimmer.build()?;
    let body = scene.body(handle);
    let count = body.markers().len();
    let mean = body.particle_numbers().iter().sum::<f64>() / count as f64;
    let numbers = (0..count).map(|k| mean * share(k, count)).collect();
    let droplet = ActiveDroplet::new(body.markers(), numbers, swimmer.tension()?, swimmer.diffusion)?
        .with_motion(swimmer.motion)
        .with_flux(swimmer.flux)?
        .with_area_constraint(swimmer.area_constraint);
    *scene.body_mut(handle) = droplet;
    let until = extent.pick(1.0, 20.0);
    match way {
        // The start is over in a thousandth of the time that the rest takes.
        Way::Integral => Ok(run(scene, until, ADAPTIVE, look)),
        _ => run_way(way, scene, until, look),
    }
}
