//! Verdicts on stability next to their errors.

use motile::prelude::*;
use motile_steady_states::{Stability, SteadyState};

/// The leading growth rate is 7.0e-4 (72 to 128 nodes). With 32 nodes it comes out negative, far within the error that
/// rigid motions show, so that nothing is decided.
#[test]
fn a_growth_rate_below_its_error_decides_nothing() {
    let region = Region::Channel { length: 8.0, width: 4.0, drive: Drive::ZeroGradient };
    let droplets = vec![DropletSetup { viscosity: Some(300.0), ..DropletSetup::active(-2.0) }];
    let spectrum = |nodes: usize| {
        let method = Method::Integral(IntegralMethod { nodes, elements: 4 * nodes });
        let setup = Setup { region, method, droplets: droplets.clone(), ..Setup::default() };
        SteadyState::find(&setup).unwrap().spectrum().unwrap()
    };
    let (coarse, fine) = (spectrum(32), spectrum(72));
    let rate = coarse.leading().unwrap().value.re;
    assert!(rate < 0.0 && coarse.unstable() == 0 && coarse.error > 0.01, "{rate} {}", coarse.error);
    assert_eq!((coarse.stability(), coarse.stability().decided()), (Stability::Undecided, None));
    let rate = fine.leading().unwrap().value.re;
    assert!((rate / 7.0e-4 - 1.0).abs() < 0.01 && fine.error < 1e-4, "{rate} {}", fine.error);
    assert_eq!(fine.stability(), Stability::Unstable);
}
