//! From rest to swimming: a bifurcation diagram.
//!
//! `cargo run --release --example bifurcation` follows a droplet at rest over its activity in unbounded fluid. It finds
//! the branch point where the droplet polarises, where the slope of its tension is exactly 4 D eta/(R0 c0) = 0.4, and
//! follows the swimmers that branch off there up to activity -0.8. `motile steady SCENE.toml --along KEY --to VALUE`
//! draws such diagrams.

use motile::active_interface::{ContractileTension, Tension};
use motile::prelude::*;
use motile_steady_states::{Continuation, Parameter, SpecialKind, SteadyState};

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let setup = Setup {
        region: Region::Plane,
        method: Method::Integral(IntegralMethod { nodes: 64, elements: 256 }),
        droplets: vec![DropletSetup::active(-0.3)],
        ..Setup::default()
    };
    let settings = Continuation::new(Parameter::Activity, -0.3, -0.8);
    let rest = settings.follow(&SteadyState::uniform(&setup)?, |point, special| {
        println!("at rest, activity {:.3}: {}", point.value, point.spectrum.stability().name());
        special.is_empty()
    })?;
    let start = rest.special.iter().find(|point| point.kind == SpecialKind::BranchPoint).ok_or("no branch point")?;
    // There the slope of the tension at the mean concentration, -zeta less the excluded volume's part, is exactly
    // 4 D eta/(R0 c0).
    let slope = ContractileTension::thesis(10.0, start.value, 10.0, 100.0)?.slope(100.0);
    let exact = 4.0 * 0.1 * setup.viscosity / 100.0;
    println!("swimmers branch off at {:.6}, where the slope is {slope:.6}, exactly {exact:.6}", start.value);
    assert!((slope / exact - 1.0).abs() < 1e-5);

    let swimmers = settings.switch(start, true, |_, _| true)?;
    let last = swimmers.points.last().ok_or("an empty branch")?;
    let speed = last.state.measured()?.speed;
    println!(
        "{} swimmers, the last at activity {:.3} with speed {speed:.4}: {}",
        swimmers.points.len(),
        last.value,
        swimmers.end
    );
    assert!((last.value + 0.8).abs() < 1e-9 && speed > 0.0);
    Ok(())
}
