use motile::prelude::*;
use motile::scene::Hydrodynamics;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let method = Method::Integral(IntegralMethod { nodes: 48, elements: 192 });
    let setup = Setup { method, droplets: vec![DropletSetup::active(-2.0)], ..Setup::default() };
    let Built { mut scene, droplets, .. } = setup.build()?;
    scene.run(20.0).go()?;
    let seen = scene.observe(droplets[0])?;
    println!("speed {:.4}, stresslet {:.1}", seen.speed(), seen.moments.stresslet()[0][0]);
    println!("{} steps, {:?}", scene.steps(), scene.system().hydrodynamics().work());
    assert!((seen.speed() - 0.130).abs() < 0.001);
    Ok(())
}
