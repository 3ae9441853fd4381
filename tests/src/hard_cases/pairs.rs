//! Two droplets.

use motile::Swimmer;
use motile::active_interface::{ActiveDroplet, Curve};
use motile::ib_core::Vec2;
use motile::stokes_grid::Drive;

use crate::hard_cases::drive::{run_way, swimmer};
use crate::hard_cases::{Ending, Recipe, Trial, Way, expand};

pub(crate) fn trials() -> Vec<Trial> {
    expand(&[
        Recipe::new(
            13,
            "two swimmers head-on",
            &[Way::Grid, Way::Integral, Way::Thesis, Way::Chebyshev],
            |way, extent, look| {
                let base = Swimmer {
                    activity: -4.0,
                    spacing: 0.1,
                    lengths: [8.0, 4.0],
                    offset: [-1.3, 0.0],
                    ..Swimmer::default()
                };
                let first = swimmer(way, &base);
                let second = Swimmer { offset: [1.3, 0.0], angle: std::f64::consts::PI, ..first.clone() };
                let mut scene = first.empty_box()?;
                for (name, swimmer) in [("first droplet", &first), ("second droplet", &second)] {
                    scene.add(swimmer.droplet_for_method()?.with_name(name));
                }
                run_way(way, scene, extent.pick(6.0, 60.0), look)
            },
        )
        // They press against each other until the film between them is thinner than the method can see, later the finer
        // it is.
        .ending_in(&[Ending::Finished, Ending::Crossing, Ending::Stagnated, Ending::SelfCrossing])
        .area_within(2e-3),
        Recipe::new(13, "a passive droplet overtakes another", &[Way::Grid, Way::Integral], |way, extent, look| {
            // At the centre line the flow is faster than beside it.
            let base = Swimmer {
                activity: 0.0,
                excluded_volume: 0.0,
                viscosity: 10.0,
                spacing: 0.1,
                lengths: [10.0, 5.0],
                offset: [-1.6, 0.4],
                ..Swimmer::default()
            };
            let (mut scene, _) = swimmer(way, &base).build_in_channel(Drive::Gradient(-2.0))?;
            let curve = Curve::circle(1.0)?.translated(Vec2::new(1.0, -1.3));
            let markers = curve.markers(if way == Way::Integral { 256 } else { 128 })?;
            scene.add(ActiveDroplet::passive(&markers, 10.0)?.with_name("second droplet"));
            run_way(way, scene, extent.pick(6.0, 40.0), look)
        })
        .area_within(2e-3),
    ])
}
