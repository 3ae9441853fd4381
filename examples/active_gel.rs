//! An active polar gel inside a droplet.
//!
//! `cargo run --release --example active_gel` fills a passive droplet with a gel whose director is random at the start
//! and normal to the interface. Whatever happens inside, the charges of the defects add up to one, by the theorem of
//! Poincare and Hopf. Most defects annihilate within a few units of time, while the energy of the director falls.

use motile::interior::{Anchoring, DirectorStart, GelInDroplet, GelMaterial};
use motile::prelude::*;
use motile::setup::GelSetup;

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let material = GelMaterial { activity: 0.0, ..GelMaterial::default() };
    let start = DirectorStart::Random { seed: 3 };
    let gel = GelSetup { material, anchoring: Anchoring::Homeotropic, start, spacing: None };
    let setup = Setup {
        method: Method::Grid(GridMethod::of_spacing(0.15)),
        droplets: vec![DropletSetup { gel: Some(gel), ..DropletSetup::passive(200.0) }],
        ..Setup::default()
    };
    let mut scene = setup.build()?.scene;
    let (gel, _) = scene.system().bodies::<GelInDroplet>().next().ok_or("a scene without a gel")?;
    let (mut counts, mut last) = (Vec::new(), f64::INFINITY);
    for time in [0.0, 0.1, 1.0, 8.0] {
        scene.run(time).go()?;
        let seen = scene.observe(gel)?;
        println!("t = {time}: {} defects, energy of the director {:.2}", seen.defects.len(), seen.director_energy);
        assert_eq!(seen.defects.iter().map(|defect| defect.charge).sum::<i32>(), 1);
        assert!(seen.director_energy < last, "the energy of a passive gel rises");
        last = seen.director_energy;
        counts.push(seen.defects.len());
    }
    assert!(counts[0] > 10 && counts[3] <= 3, "{counts:?}");
    Ok(())
}
