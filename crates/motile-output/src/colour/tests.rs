use super::*;

#[test]
fn symmetric_scale_ignores_a_rare_spike_and_has_its_middle_at_zero() {
    let mut values: Vec<f64> = (0..1000).map(|k| (f64::from(k) * 0.1).sin()).collect();
    values[17] = 1e6;
    let scale = ColourScale::new(ColourMap::Rainbow, Limits::Symmetric, &values);
    let [low, high] = scale.ends();
    assert_eq!(low, -high);
    assert!(high > 0.9 && high <= 1.0, "{high}");
    assert_eq!(scale.colour(0.0), ColourMap::Rainbow.at(0.5));
}

#[test]
fn most_leaves_out_what_stands_out() {
    let mut values: Vec<f64> = (0..200).map(f64::from).collect();
    (values[3], values[90]) = (-1e6, 1e6);
    assert_eq!(ColourScale::new(ColourMap::Rainbow, Limits::Most, &values).ends(), [0.0, 199.0]);
}

#[test]
fn empty_constant_and_nan_data_give_a_usable_scale() {
    for values in [vec![], vec![3.0; 4], vec![f64::NAN, f64::INFINITY], vec![0.0]] {
        for limits in [Limits::FromZero, Limits::Symmetric, Limits::Most] {
            let [low, high] = ColourScale::new(ColourMap::Viridis, limits, &values).ends();
            assert!(low.is_finite() && high.is_finite() && low < high, "{values:?} {limits:?}: {low} {high}");
        }
    }
}

#[test]
fn mixing_ends_at_its_ends() {
    let (a, b) = (Rgb([10, 20, 30]), Rgb([200, 100, 0]));
    assert_eq!(a.mix(b, 0.0), a);
    assert_eq!(a.mix(b, 1.0), b);
    assert_eq!(a.hex(), "#0a141e");
}
