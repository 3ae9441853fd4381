//! A steady swimmer and its stability, without a run.
//!
//! `cargo run --release --example steady_state` finds the swimmer of activity -2 in unbounded fluid by Newton's method:
//! its speed is 0.135125. Doubling the nodes shows the error of its speed, which falls faster than any power of their
//! number. The swimmer is stable: apart from a shift and a turn, which change nothing, all disturbances decay.

use motile::prelude::*;
use motile_steady_states::{Stability, SteadyState};

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let swimmer = |nodes: usize| {
        let method = Method::Integral(IntegralMethod { nodes, elements: 4 * nodes });
        SteadyState::find(&Setup { region: Region::Plane, method, ..Setup::default() })
    };
    let [coarse, state, fine] = [swimmer(48)?, swimmer(96)?, swimmer(144)?];
    let [first, second, last] = [&coarse, &state, &fine].map(|state| state.measured().map(|seen| seen.speed));
    let (first, second, last) = (first?, second?, last?);
    println!("speeds {first:.8}, {second:.8}, {last:.8}");
    assert!((second - last).abs() < 0.1 * (first - last).abs() && (second / last - 1.0).abs() < 1e-4);

    let spectrum = state.spectrum()?;
    let leading = spectrum.leading().ok_or("a spectrum without modes")?;
    println!("{}: leading growth rate {:.5}, error {:.1e}", spectrum.stability().name(), leading.value, spectrum.error);
    assert!(spectrum.stability() == Stability::Stable && state.residual() < 1e-6);
    Ok(())
}
