//! Single droplets: strong activity, contrasts of viscosity, coarse and odd grids, narrow places.

use motile::active_interface::ContractileTension;
use motile::base::Drive;
use motile::base::Region;
use motile::scene::Body;
use motile::scene::gap::Repulsion;
use motile::setup::{Built, DropletSetup, ExcludedVolume, GridMethod, LayersMethod, Method, Particles, Setup};

use crate::hard_cases::drive::{ADAPTIVE, by, held, run, run_way};
use crate::hard_cases::{CaseError, Ending, Extent, Look, Outcome, Recipe, Trial, Way, expand};

const ALL: &[Way] = &[Way::Grid, Way::Integral, Way::Thesis];
const EVERY: &[Way] = &[Way::Grid, Way::Integral, Way::Thesis, Way::Chebyshev];
const ACCURATE: &[Way] = &[Way::Grid, Way::Integral, Way::Chebyshev];

/// Markers that move with the fluid, unfiltered, gather modes above the cut-off in long runs, and the interface crosses
/// itself.
const UNFILTERED: &[Ending] = &[Ending::Finished, Ending::SelfCrossing];
/// Films that drain for a long time become thinner than a grid can see.
const DRAINED: &[Ending] = &[Ending::Finished, Ending::Crossing];

/// The default droplet in a box of these lengths.
fn on_grid(grid: GridMethod, lengths: [f64; 2]) -> Setup {
    Setup { region: Region::Box { lengths }, method: Method::Grid(grid), ..Setup::default() }
}

fn coarse() -> Setup {
    on_grid(GridMethod::of_spacing(0.1), [6.0, 6.0])
}

/// The coarse scene by layers, which contrasts of viscosity need.
fn layers() -> Setup {
    Setup { method: Method::Layers(LayersMethod::of_spacing(0.1)), ..coarse() }
}

fn with_markers(spacing: f64) -> Setup {
    on_grid(GridMethod { marker_spacing: Some(spacing), ..GridMethod::of_spacing(0.1) }, [6.0, 6.0])
}

/// One droplet of this activity and this strength of the excluded volume.
fn one(activity: f64, strength: f64) -> Vec<DropletSetup> {
    let excluded_volume = ExcludedVolume::Step(strength);
    vec![DropletSetup {
        particles: Some(Particles { activity, excluded_volume, ..Particles::default() }),
        ..DropletSetup::default()
    }]
}

/// One droplet of activity -3 and this viscosity.
fn of_viscosity(viscosity: f64) -> Vec<DropletSetup> {
    vec![DropletSetup { viscosity: Some(viscosity), ..DropletSetup::active(-3.0) }]
}

fn run_by(way: Way, base: &Setup, until: f64, look: Look<'_>) -> Result<Outcome, CaseError> {
    run_way(way, by(way, base).build()?.scene, until, look)
}

pub(crate) fn trials() -> Vec<Trial> {
    expand(&[
        Recipe::new(1, "activity -15, viscosity 750, A = 30", EVERY, |way, extent, look| {
            let base = Setup { viscosity: 750.0, droplets: one(-15.0, 30.0), ..coarse() };
            run_by(way, &base, extent.pick(5.0, 60.0), look)
        }),
        Recipe::new(1, "activity -5, A = 3: no plateau", ALL, |way, _, look| {
            // A description with this law is refused, so the droplet gets the law afterwards.
            let base = Setup { droplets: one(-2.0, 3.0), ..coarse() };
            let Built { mut scene, droplets, .. } = by(way, &base).build()?;
            let law = ContractileTension::thesis(10.0, -5.0, 3.0, 100.0)?;
            scene.body_mut(droplets[0])?.set_tension(law);
            run_way(way, scene, 200.0, look)
        })
        .ending_in(&[Ending::Collapsed]),
        Recipe::new(2, "viscosity ratio 1000", ALL, |way, extent, look| {
            let base = Setup { viscosity: 10.0, droplets: of_viscosity(1e4), ..layers() };
            run_by(way, &base, extent.pick(4.0, 40.0), look)
        }),
        Recipe::new(2, "viscosity ratio 0.001", ALL, |way, extent, look| {
            let base = Setup { droplets: of_viscosity(0.1), ..layers() };
            run_by(way, &base, extent.pick(1.0, 20.0), look)
        }),
        Recipe::new(2, "viscosities equal but for the last digit", &[Way::Grid, Way::Integral], |way, extent, look| {
            let base = Setup { droplets: of_viscosity(100.0_f64.next_up()), ..layers() };
            run_by(way, &base, extent.pick(1.0, 20.0), look)
        }),
        Recipe::new(3, "viscosity 10, tension up to 1000", ACCURATE, low_viscosity),
        Recipe::new(3, "viscosity 10, tension up to 1000", &[Way::Thesis], low_viscosity).ending_in(UNFILTERED),
        Recipe::new(5, "five cells a radius", &[Way::Grid], five_cells),
        Recipe::new(5, "five cells a radius", &[Way::Thesis], five_cells).ending_in(UNFILTERED),
        Recipe::new(6, "a box of 2.2 R0", &[Way::Integral], |way, extent, look| narrow_box(None, way, extent, look)),
        Recipe::new(6, "a box of 2.2 R0", &[Way::Grid, Way::Thesis], |way, extent, look| {
            narrow_box(None, way, extent, look)
        })
        .ending_in(DRAINED),
        Recipe::new(6, "a box of 2.2 R0, held apart", &[Way::Grid], |way, extent, look| {
            narrow_box(Some(held(0.2)), way, extent, look)
        }),
        Recipe::new(7, "a circle that touches both walls", ALL, |way, extent, look| {
            let region = Region::Channel { length: 6.0, width: 2.0, drive: Drive::ZeroGradient };
            let base = Setup { region, droplets: one(-4.0, 10.0), ..coarse() };
            run_by(way, &base, extent.pick(5.0, 60.0), look)
        })
        .area_within(2e-3),
        Recipe::new(7, "a channel of 2.2 R0, viscosity ratio 10", &[Way::Integral], film),
        Recipe::new(10, "a long time: no creep", &[Way::Grid, Way::Integral], long),
        Recipe::new(10, "a long time: no creep", &[Way::Thesis], long).ending_in(UNFILTERED),
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
            seven_columns(None, way, extent, look)
        })
        .ending_in(DRAINED)
        .area_within(1e-2),
        Recipe::new(16, "a grid of 7 x 1000, held apart", &[Way::Grid], |way, extent, look| {
            seven_columns(Some(held(0.6)), way, extent, look)
        }),
        Recipe::new(16, "a grid of 997 x 991", &[Way::Grid], |way, extent, look| {
            let base = on_grid(GridMethod::of_spacing(0.0125), [12.4625, 12.3875]);
            run_by(way, &base, extent.pick(0.01, 0.1), look)
        }),
        Recipe::new(19, "markers 2 h apart", &[Way::Grid, Way::Thesis], |way, extent, look| {
            run_by(way, &with_markers(0.2), extent.pick(5.0, 60.0), look)
        })
        .area_within(2e-2),
        Recipe::new(19, "markers h/10 apart", &[Way::Grid, Way::Thesis], |way, extent, look| {
            run_by(way, &with_markers(0.01), extent.pick(0.5, 20.0), look)
        }),
    ])
}

fn long(way: Way, extent: Extent, look: Look<'_>) -> Result<Outcome, CaseError> {
    run_by(way, &coarse(), extent.pick(40.0, 1000.0), look)
}

fn low_viscosity(way: Way, extent: Extent, look: Look<'_>) -> Result<Outcome, CaseError> {
    let base = Setup { viscosity: 10.0, droplets: one(-5.0, 10.0), ..coarse() };
    run_by(way, &base, extent.pick(0.5, 10.0), look)
}

fn five_cells(way: Way, extent: Extent, look: Look<'_>) -> Result<Outcome, CaseError> {
    let base = Setup { droplets: one(-4.0, 10.0), ..on_grid(GridMethod::of_spacing(0.2), [6.0, 6.0]) };
    run_by(way, &base, extent.pick(20.0, 100.0), look)
}

/// The film at the walls becomes thin.
fn film(way: Way, extent: Extent, look: Look<'_>) -> Result<Outcome, CaseError> {
    let region = Region::Channel { length: 6.0, width: 2.2, drive: Drive::ZeroGradient };
    let particles = Particles { activity: -8.0, excluded_volume: ExcludedVolume::Step(16.0), ..Particles::default() };
    let droplets =
        vec![DropletSetup { particles: Some(particles), viscosity: Some(1000.0), ..DropletSetup::default() }];
    run_by(way, &Setup { region, droplets, ..coarse() }, extent.pick(10.0, 20.0), look)
}

fn seven_columns(repulsion: Option<Repulsion>, way: Way, extent: Extent, look: Look<'_>) -> Result<Outcome, CaseError> {
    let base = Setup { repulsion, ..on_grid(GridMethod::of_spacing(0.3), [2.1, 300.0]) };
    run_by(way, &base, extent.pick(1.0, 10.0), look)
}

fn narrow_box(repulsion: Option<Repulsion>, way: Way, extent: Extent, look: Look<'_>) -> Result<Outcome, CaseError> {
    let base = Setup { repulsion, droplets: one(-3.0, 10.0), ..on_grid(GridMethod::of_spacing(0.1), [2.2, 2.2]) };
    run_by(way, &base, extent.pick(5.0, 60.0), look)
}

/// A droplet whose particles are spread as `density` says for places along the interface from 0 to 1, whatever its sum.
fn filled(way: Way, extent: Extent, look: Look<'_>, density: impl FnMut(f64) -> f64) -> Result<Outcome, CaseError> {
    let Built { mut scene, droplets, .. } = by(way, &coarse()).build()?;
    let body = scene.body_mut(droplets[0])?;
    let count = body.markers().len();
    let shares: Vec<f64> = (0..count).map(|k| (k as f64 + 0.5) / count as f64).map(density).collect();
    let unit = body.particle_numbers().iter().sum::<f64>() / shares.iter().sum::<f64>();
    let mut state = vec![0.0; body.state_len()];
    body.write_state(&mut state);
    // The particle numbers stand behind the markers.
    state[2 * count..].iter_mut().zip(shares).for_each(|(number, share)| *number = unit * share);
    body.read_state(&state)?;
    let until = extent.pick(1.0, 20.0);
    match way {
        // The start is over in a thousandth of the time that the rest takes.
        Way::Integral => Ok(run(scene, until, ADAPTIVE, look)),
        _ => run_way(way, scene, until, look),
    }
}
