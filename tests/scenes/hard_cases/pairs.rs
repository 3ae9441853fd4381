//! Two droplets.

use motile::base::Drive;
use motile::base::Region;
use motile::scene::gap::Repulsion;
use motile::setup::{DropletSetup, ExcludedVolume, GridMethod, LayersMethod, Method, Particles, Setup};

use crate::hard_cases::drive::{by, held, run_way};
use crate::hard_cases::{CaseError, Ending, Extent, Look, Outcome, Recipe, Trial, Way, expand};

/// Two swimmers that press against each other, with or without a repulsion.
fn head_on(repulsion: Option<Repulsion>, way: Way, extent: Extent, look: Look<'_>) -> Result<Outcome, CaseError> {
    let droplet = |name: &str, x: f64, angle: f64| DropletSetup {
        name: name.to_owned(),
        centre: [x, 0.0],
        angle,
        ..DropletSetup::active(-4.0)
    };
    let setup = Setup {
        region: Region::Box { lengths: [8.0, 4.0] },
        method: Method::Grid(GridMethod::of_spacing(0.1)),
        repulsion,
        droplets: vec![droplet("first droplet", -1.3, 0.0), droplet("second droplet", 1.3, std::f64::consts::PI)],
        ..Setup::default()
    };
    run_way(way, by(way, &setup).build()?.scene, extent.pick(6.0, 60.0), look)
}

pub(crate) fn trials() -> Vec<Trial> {
    expand(&[
        Recipe::new(
            13,
            "two swimmers head-on",
            &[Way::Grid, Way::Integral, Way::Thesis, Way::Chebyshev],
            |way, extent, look| head_on(None, way, extent, look),
        )
        // They press against each other until the film between them is thinner than the method can see, later the finer
        // it is.
        .ending_in(&[Ending::Finished, Ending::Crossing, Ending::Stagnated, Ending::SelfCrossing])
        .area_within(2e-3),
        Recipe::new(
            13,
            "two swimmers head-on, held apart",
            &[Way::Grid, Way::Integral, Way::Chebyshev],
            |way, extent, look| head_on(Some(held(0.2)), way, extent, look),
        )
        .area_within(2e-3),
        Recipe::new(13, "a passive droplet overtakes another", &[Way::Grid, Way::Integral], |way, extent, look| {
            // At the centre line the flow is faster than beside it.
            let particles =
                Particles { activity: 0.0, excluded_volume: ExcludedVolume::Step(0.0), ..Particles::default() };
            let first = DropletSetup { centre: [-1.6, 0.4], particles: Some(particles), ..DropletSetup::default() };
            let name = "second droplet".to_owned();
            let second = DropletSetup { name, centre: [1.0, -1.3], ..DropletSetup::passive(10.0) };
            let setup = Setup {
                region: Region::Channel { length: 10.0, width: 5.0, drive: Drive::Gradient(-2.0) },
                method: Method::Grid(GridMethod::of_spacing(0.1)),
                viscosity: 10.0,
                droplets: vec![first, second],
                ..Setup::default()
            };
            let scene = by(way, &setup).build()?.scene;
            run_way(way, scene, extent.pick(6.0, 40.0), look)
        })
        .area_within(2e-3),
        Recipe::new(18, "net forces at a viscosity ratio of 10", &[Way::Grid, Way::Integral], |way, extent, look| {
            let droplet = |name: &str, x: f64| DropletSetup {
                name: name.to_owned(),
                centre: [x, 0.0],
                viscosity: Some(100.0),
                ..DropletSetup::passive(10.0)
            };
            let setup = Setup {
                region: Region::Box { lengths: [8.0, 4.0] },
                method: Method::Layers(LayersMethod::of_spacing(0.1)),
                viscosity: 10.0,
                repulsion: Some(Repulsion::new(2000.0, 0.3).expect("a repulsion")),
                droplets: vec![droplet("first droplet", -1.05), droplet("second droplet", 1.05)],
                ..Setup::default()
            };
            let scene = by(way, &setup).build()?.scene;
            run_way(way, scene, extent.pick(0.2, 10.0), look)
        }),
    ])
}
