use motile::prelude::*;
use motile_steady_states::SteadyState;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let method = Method::Integral(IntegralMethod { nodes: 72, elements: 288 });
    let region = Region::Channel { length: 12.0, width: 3.0, drive: Drive::ZeroGradient };
    let swimmer = SteadyState::find(&Setup { method, region, ..Setup::default() })?;
    println!("speed {:.5}", swimmer.measured()?.speed);
    for mode in swimmer.spectrum()?.modes.iter().take(3) {
        println!("{:.4} ({})", mode.value, mode.symmetry.name());
    }
    Ok(())
}
