use motile::setup::DropletSetup;

use super::*;

/// A ratio of viscosities keeps their sum, and each viscosity is that of its side.
#[test]
fn viscosities_by_ratio_and_one_by_one() {
    let droplet = DropletSetup { viscosity: Some(30.0), ..DropletSetup::active(-1.0) };
    let setup = Setup { viscosity: 10.0, droplets: vec![droplet], ..Setup::default() };
    let sides = |parameter: Parameter, value: f64| {
        let changed = parameter.with(&setup, value).unwrap();
        assert!((parameter.get(&changed).unwrap() / value - 1.0).abs() < 1e-12, "{parameter:?}");
        (changed.viscosity, changed.droplets[0].viscosity.unwrap())
    };
    for (ratio, outside, inside) in [(3.0, 10.0, 30.0), (1.0, 20.0, 20.0), (7.0, 5.0, 35.0)] {
        let (found, other) = sides(Parameter::ViscosityRatio, ratio);
        assert!((found / outside - 1.0).abs() < 1e-12 && (other / inside - 1.0).abs() < 1e-12, "{found} {other}");
    }
    assert_eq!(sides(Parameter::ViscosityInside, 4.0), (10.0, 4.0));
    assert_eq!(sides(Parameter::ViscosityOutside, 4.0), (4.0, 30.0));
}
