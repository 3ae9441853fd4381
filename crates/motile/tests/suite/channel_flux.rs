//! Fluxes along channels that several droplets share.

use motile::active_interface::observables::{gap_flow, net_flux};
use motile::prelude::*;

/// The line through droplets above each other meets four interfaces, at each of which the shear jumps.
#[test]
fn no_fluid_passes_through_a_closed_channel() {
    let droplet = |y| DropletSetup { centre: [0.0, y], ..DropletSetup::active(-2.0) };
    let setup = Setup {
        region: Region::Channel { length: 12.0, width: 6.0, drive: Drive::ZeroFlux },
        method: Method::Integral(IntegralMethod { nodes: 48, elements: 192 }),
        droplets: vec![droplet(1.3), droplet(-1.3)],
        ..Setup::default()
    };
    let Built { mut scene, droplets, .. } = setup.build().unwrap();
    scene.run(0.1).go().unwrap();
    let flow = gap_flow(scene.system_mut(), droplets[0]).unwrap();
    assert!(flow.net().abs() < 1e-6 && flow.retrograde().is_some_and(|flux| flux > 0.1), "{flow:?}");
    // Through images of the droplets too.
    for x in [-12.2, 0.4, 12.7] {
        let flux = net_flux(scene.system_mut(), x).unwrap();
        assert!(flux.abs() < 1e-6, "{x}: {flux:e}");
    }
}
