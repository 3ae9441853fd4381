//! Growth rates of small perturbations against linear theory (Cowley (2.18), (2.19)), the box's effect removed.

use motile::setup::{DropletSetup, Setup};
use motile_tests::validation::growth::{Mode, rate, rate_in_region};
use motile_tests::validation::scene::on_grid;

#[test]
fn growth_rates() {
    let setup = on_grid(0.1);
    for mode in [Mode::Concentration(1), Mode::Concentration(2), Mode::Concentration(3), Mode::Shape(2), Mode::Shape(3)]
    {
        let (theory, measured) = (mode.theory(&setup).unwrap(), rate(&setup, mode).unwrap());
        assert!((measured / theory - 1.0).abs() < 0.01, "{mode:?}: {measured} {theory}");
    }
}

/// In a 6 x 6 box the images slow mode 2 down from 0.5 to 0.4179 gamma/(eta R0): boundary-integral value for the mode
/// that decays by itself. A pure cos(2 theta) starts a little faster, 0.4187 at all resolutions, because the box
/// couples it to others.
#[test]
fn box_effect() {
    let droplet = DropletSetup { tension: 1.0, ..DropletSetup::active(0.0) };
    let setup = Setup { viscosity: 1.0, droplets: vec![droplet], ..on_grid(0.05) };
    let measured = rate_in_region(&setup, Mode::Shape(2)).unwrap();
    assert!((measured + 0.4183).abs() < 6e-4, "{measured}");
}
