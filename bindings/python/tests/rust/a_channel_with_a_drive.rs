use motile::active_interface::observables::net_flux;
use motile::prelude::*;
use motile::scene::Hydrodynamics;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let setup = Setup {
        // The mean flow, 0.1 on average over the width of 3, to the left, against the droplet.
        region: Region::Channel { length: 12.0, width: 3.0, drive: Drive::Flux(-0.3) },
        method: Method::Integral(IntegralMethod { nodes: 48, elements: 192 }),
        droplets: vec![DropletSetup::active(-3.0)],
        least_gap: Some(0.02),
        ..Setup::default()
    };
    let Built { mut scene, droplets, .. } = setup.build()?;
    scene.run(2.0).go()?;
    let seen = scene.observe(droplets[0])?;
    let flux = net_flux(scene.system_mut(), seen.centroid.x + 6.0)?;
    let gap = scene.system().minimum_wall_gap();
    println!("velocity {:.4} against a flux of {flux:.6}, gap {gap:?}", seen.velocity.x);
    println!("{} steps, {:?}", scene.steps(), scene.system().hydrodynamics().work());
    assert!((flux + 0.3).abs() < 1e-4);
    Ok(())
}
