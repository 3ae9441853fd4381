//! try
use motile::prelude::*;
use steady_states::SteadyState;
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let args: Vec<String> = std::env::args().collect();
    let nodes: usize = args[1].parse()?;
    let act: f64 = args[2].parse()?;
    let a: f64 = args[3].parse()?;
    let method = Method::Integral(IntegralMethod { nodes, cells: 4 * nodes });
    let mut setup = Setup { method, droplets: vec![DropletSetup::contractile(act, a)], ..Setup::default() };
    if args.len() > 4 { let w: f64 = args[4].parse()?; setup.region = Region::Channel { length: 12.0, width: w, drive: motile::stokes_grid::Drive::ZeroGradient }; }
    if args.len() > 6 { setup.droplets[0].viscosity = Some(args[5].parse()?); setup.viscosity = args[6].parse()?; setup.region = Region::default(); }
    let t = std::time::Instant::now();
    let s = SteadyState::find(&setup)?;
    println!("{:?}", t.elapsed());
    println!("{:?}\n res {:.2e} it {} cond {:.2e}", s.measured()?, s.residual(), s.iterations(), s.condition());
    let t = std::time::Instant::now();
    let sp = s.spectrum()?;
    println!("{:?} neutral {:.2e}", t.elapsed(), sp.neutral);
    for m in sp.modes.iter().take(8) { println!("{:?}", m); }
    Ok(())
}
