use motile::prelude::*;

use super::*;
use crate::{SteadyState, system::System};

/// The largest of the rates of shifts and turns, which do nothing, is told, of whatever symmetry it is.
#[test]
fn the_worst_neutral_mode_of_both_symmetries_counts() {
    let method = Method::Integral(IntegralMethod { nodes: 24, elements: 128 });
    let droplets = vec![DropletSetup::contractile(-0.2, 10.0)];
    let channel = Region::Channel { length: 7.0, width: 2.6, drive: Drive::ZeroGradient };
    let mut worst = Vec::new();
    for region in [Region::Plane, channel] {
        let setup = Setup { method, region, droplets: droplets.clone(), ..Setup::default() };
        let state = SteadyState::uniform(&setup).unwrap();
        let mut system = System::new(&setup).unwrap();
        let of = [Symmetry::Symmetric, Symmetry::Antisymmetric]
            .map(|symmetry| system.reduced(state.point(), symmetry.part()).unwrap().neutral);
        let all = system.spectrum(state.point(), Part::Even).unwrap().neutral;
        assert_eq!(all, of[0].max(of[1]), "{region:?}");
        worst.push(usize::from(of[1] > of[0]));
    }
    println!("{worst:?}");
}
