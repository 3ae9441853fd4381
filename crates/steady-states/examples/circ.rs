//! circ
use motile::prelude::*;
use steady_states::SteadyState;
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let method = Method::Integral(IntegralMethod { nodes: 32, cells: 128 });
    let mut setup = Setup { method, region: Region::Plane, droplets: vec![DropletSetup::contractile(-0.5, 1.0)], ..Setup::default() };
    setup.droplets[0].viscosity = Some(30.0);
    let s = SteadyState::uniform(&setup)?;
    println!("{:?}\n res {:.2e} it {} cond {:.2e}", s.measured()?, s.residual(), s.iterations(), s.condition());
    let t = std::time::Instant::now();
    let sp = s.spectrum()?;
    println!("{:?} neutral {:.2e}", t.elapsed(), sp.neutral);
    for m in sp.modes.iter().take(24) { println!("{:?}", m); }
    let law = setup.droplets[0].particles.unwrap().law(10.0)?;
    use motile::active_interface::Tension;
    let th = motile::active_interface::theory::LinearTheory::new(motile::active_interface::theory::RoundDroplet { radius: 1.0, viscosity_inside: 30.0, viscosity_outside: 100.0, tension: law.value(100.0), activity: -law.slope(100.0), concentration: 100.0, diffusivity: 0.1 })?;
    for k in 1..7 { println!("{} {}", th.shape_growth_rate(k), th.concentration_growth_rate(k)); }
    Ok(())
}
