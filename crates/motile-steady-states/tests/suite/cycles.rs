//! Oscillations against the Hopf point that they come from.

use motile::prelude::*;
use motile_steady_states::{LimitCycle, Parameter, SteadyState, Symmetry};

#[test]
fn swings_leave_the_hopf_point_as_its_normal_form_has_it() {
    let method = Method::Integral(IntegralMethod { nodes: 128, elements: 512 });
    let region = Region::Channel { length: 12.0, width: 5.0, drive: Drive::ZeroGradient };
    let droplets = vec![DropletSetup::contractile(-2.55, 10.0)];
    let state = SteadyState::find(&Setup { method, region, droplets, ..Setup::default() }).unwrap();
    let spectrum = state.spectrum().unwrap();
    let swing = spectrum.modes.iter().find(|mode| mode.value.im > 0.0 && mode.symmetry == Symmetry::Antisymmetric);
    let hopf = state.critical(swing.unwrap(), Parameter::Activity).unwrap();
    let start = Parameter::Activity.get(hopf.state.setup()).unwrap();
    let [cycle, other] =
        [0.2, 0.3].map(|amplitude| LimitCycle::from_hopf(&hopf, Parameter::Activity, amplitude, 5).unwrap());
    let [small, large] = [&cycle, &other]
        .map(|cycle| (cycle.amplitude().unwrap().powi(2), cycle.value(Parameter::Activity) - start, cycle.period()));
    let ratio = (large.1 / large.0) / (small.1 / small.0);
    assert!((ratio - 1.0).abs() < 0.1, "{small:?} {large:?}");
    // Half of what a disturbance of the straight swimmer grows by, in the other direction: the normal form of a Hopf
    // point.
    // Nine instants resolve a small swing: harmonics fall off as powers of its amplitude.
    assert!(cycle.instants() == 9 && cycle.tail() < 1e-5, "{} {}", cycle.instants(), cycle.tail());
    let at = cycle.value(Parameter::Activity);
    let straight = hopf.state.at(Parameter::Activity, at).unwrap().spectrum().unwrap();
    let growth = straight.of(Symmetry::Antisymmetric).find(|z| z.im > 0.0).unwrap().re;
    let multipliers = cycle.multipliers().unwrap();
    let expected = -2.0 * growth * cycle.period();
    assert!(multipliers.neutral < 1e-2 && !multipliers.is_stable(), "{}", multipliers.neutral);
    assert!((multipliers.values[0].re.ln() / expected - 1.0).abs() < 0.1, "{} {expected}", multipliers.values[0]);
    // To another activity and back.
    let back = cycle.at(Parameter::Activity, at + 1e-4).unwrap().at(Parameter::Activity, at).unwrap();
    let change = back.amplitude().unwrap() - cycle.amplitude().unwrap();
    assert!(change.abs() < 1e-5, "{change}");
    let period = std::f64::consts::TAU / hopf.mode.value.im;
    let at_rest = small.2 - small.0 * (large.2 - small.2) / (large.0 - small.0);
    assert!((at_rest / period - 1.0).abs() < 2e-3, "{at_rest} {period}");
}
