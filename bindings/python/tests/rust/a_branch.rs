use motile::prelude::*;
use motile_steady_states::{Continuation, Parameter, SteadyState};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let method = Method::Integral(IntegralMethod { nodes: 64, elements: 256 });
    let start = SteadyState::find(&Setup { region: Region::Plane, method, ..Setup::default() })?;
    let branch = Continuation::new(Parameter::Activity, -2.0, -0.3).follow(&start, |_, _| true)?;
    for point in &branch.special {
        println!("{} at {:.4}", point.kind.name(), point.value);
    }
    println!("{} states, {}", branch.points.len(), branch.end);
    Ok(())
}
