use super::*;
use approx::assert_relative_eq;

#[test]
fn table_a_1() {
    let units = Units::thesis();
    let rows = [
        (Quantity::Length, 1.0, 10e-6),
        (Quantity::Viscosity, 10.0, 1e2),
        (Quantity::Viscosity, 1e3, 1e4),
        (Quantity::Diffusivity, 0.1, 1e-12),
        (Quantity::Concentration, 100.0, 10e6),
        (Quantity::Tension, 10.0, 100e-6),
        (Quantity::Stress, 1e3, 1e3), // table A.2, elastic modulus
    ];
    for (quantity, value, si) in rows {
        assert_relative_eq!(units.to_si(quantity, value).unwrap(), si, max_relative = 1e-14);
        assert_relative_eq!(units.from_si(quantity, si).unwrap(), value, max_relative = 1e-14);
    }
    // The activity that makes the active tension of c0 what it is in the calculation; the table has 1.5e-8 N.
    let activity = units.to_si(Quantity::Activity, 15.0).unwrap();
    let concentration = units.to_si(Quantity::Concentration, 100.0).unwrap();
    assert_relative_eq!(activity, 1.5e-9, max_relative = 1e-14);
    let tension = units.to_si(Quantity::Tension, 1500.0).unwrap();
    assert_relative_eq!(activity * concentration, tension, max_relative = 1e-14);
}

#[test]
fn derived_units_are_consistent() {
    let units = Units::new(2.0, 3.0, 7.0).unwrap();
    let unit = |quantity| units.unit(quantity);
    assert_relative_eq!(unit(Quantity::Speed), unit(Quantity::Length) / unit(Quantity::Time));
    assert_relative_eq!(unit(Quantity::Stress), unit(Quantity::Viscosity) / unit(Quantity::Time));
    assert_relative_eq!(unit(Quantity::Diffusivity), unit(Quantity::Length).powi(2) / unit(Quantity::Time));
    assert_relative_eq!(unit(Quantity::Activity) * unit(Quantity::Concentration), unit(Quantity::Tension));
    assert_eq!(Quantity::Viscosity.unit(), "Pa s");
    assert!(Units::new(0.0, 1.0, 1.0).is_err());
    assert!(units.to_si(Quantity::Time, f64::NAN).is_err());
}
