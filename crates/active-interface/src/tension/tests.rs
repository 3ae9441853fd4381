use super::*;
use approx::assert_relative_eq;
use proptest::prelude::*;

#[test]
fn linear_law_is_equation_2_38() {
    let law = ContractileTension::new(10.0, -2.0, ExcludedVolume::None, 1.0).unwrap();
    assert_relative_eq!(law.value(100.0), 210.0);
    assert_relative_eq!(law.slope(100.0), 2.0);
    assert_eq!(ConstantTension::new(3.0).unwrap().value(7.0), 3.0);
}

#[test]
fn tension_is_largest_on_the_plateau() {
    let law = ContractileTension::thesis(10.0, -4.0, 10.0, 100.0).unwrap();
    let c = law.plateau().unwrap();
    assert!(law.slope(c).abs() < 1e-10);
    assert!(law.value(c) > law.value(c - 5.0) && law.value(c) > law.value(c + 5.0));
    let quadratic = ContractileTension::new(10.0, -4.0, ExcludedVolume::Quadratic(0.02), 1.0).unwrap();
    assert_relative_eq!(quadratic.plateau().unwrap(), 200.0);
}

#[test]
fn a_missing_plateau_is_reported() {
    let law = |activity| ContractileTension::thesis(10.0, activity, 10.0, 100.0).unwrap();
    assert_eq!(law(-9.9).warning(), None);
    assert!(law(-10.0).warning().is_some_and(|message| message.contains("-10")));
    assert_eq!(law(1.0).warning(), None);
    assert!(ContractileTension::new(10.0, -1.0, ExcludedVolume::None, 1.0).unwrap().warning().is_some());
    assert_eq!(ConstantTension::new(1.0).unwrap().warning(), None);
}

#[test]
fn slices_and_errors() {
    let law: Arc<dyn Tension> = Arc::new(ContractileTension::thesis(10.0, -2.0, 10.0, 100.0).unwrap());
    let mut out = [0.0; 3];
    law.values(&[0.0, 100.0, 300.0], &mut out);
    assert_eq!(out[2], law.value(300.0));
    let boxed: Box<dyn Tension> = Box::new(Arc::clone(&law));
    assert_eq!((boxed.value(150.0), boxed.slope(150.0)), (law.value(150.0), law.slope(150.0)));
    assert!(
        Box::<dyn Tension>::from(Box::new(ContractileTension::thesis(1.0, -9.0, 3.0, 1.0).unwrap()))
            .warning()
            .is_some()
    );
    assert!(ConstantTension::new(-1.0).is_err());
    assert!(ContractileTension::new(1.0, f64::NAN, ExcludedVolume::None, 1.0).is_err());
    assert!(ContractileTension::new(1.0, -1.0, ExcludedVolume::Quadratic(-1.0), 1.0).is_err());
    assert!(ContractileTension::new(1.0, -1.0, ExcludedVolume::Step(1.0), -100.0).is_err());
}

proptest! {
    #[test]
    fn slope_is_the_derivative(c in 0.0..800.0f64, activity in -15.0..1.0f64, strength in 0.0..20.0f64) {
        let law = ContractileTension::thesis(10.0, activity, strength, 100.0).unwrap();
        let step = 1e-3;
        let difference = (law.value(c + step) - law.value(c - step)) / (2.0 * step);
        prop_assert!((difference - law.slope(c)).abs() < 1e-5);
    }
}
