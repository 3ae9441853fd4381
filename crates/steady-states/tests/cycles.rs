//! Oscillations against the Hopf point that they come from.

use motile::prelude::*;
use steady_states::{LimitCycle, Parameter, SteadyState, Symmetry};

#[test]
fn swings_leave_the_hopf_point_with_the_square_of_their_amplitude_and_its_period() {
    let method = Method::Integral(IntegralMethod { nodes: 88, cells: 352 });
    let region = Region::Channel { length: 12.0, width: 5.0, drive: Drive::ZeroGradient };
    let droplets = vec![DropletSetup::contractile(-2.55, 10.0)];
    let state = SteadyState::find(&Setup { method, region, droplets, ..Setup::default() }).unwrap();
    let spectrum = state.spectrum().unwrap();
    let swing = spectrum.modes.iter().find(|mode| mode.value.im > 0.0 && mode.symmetry == Symmetry::Antisymmetric);
    let hopf = state.critical(swing.unwrap(), Parameter::Activity).unwrap();
    let start = Parameter::Activity.get(hopf.state.setup()).unwrap();
    let [small, large] = [0.2, 0.3].map(|amplitude| {
        let cycle = LimitCycle::from_hopf(&hopf, Parameter::Activity, amplitude, 5).unwrap();
        (cycle.amplitude().unwrap().powi(2), cycle.value(Parameter::Activity) - start, cycle.period())
    });
    let ratio = (large.1 / large.0) / (small.1 / small.0);
    assert!((ratio - 1.0).abs() < 0.1, "{small:?} {large:?}");
    let period = std::f64::consts::TAU / hopf.mode.value.im;
    let at_rest = small.2 - small.0 * (large.2 - small.2) / (large.0 - small.0);
    assert!((at_rest / period - 1.0).abs() < 2e-3, "{at_rest} {period}");
}
