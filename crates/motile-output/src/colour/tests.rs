use super::*;

#[test]
fn most_leaves_out_what_stands_out() {
    let mut values: Vec<f64> = (0..200).map(f64::from).collect();
    (values[3], values[90]) = (-1e6, 1e6);
    let scale = ColourScale::of_most(values.into_iter(), "");
    assert_eq!([scale.low, scale.high], [0.0, 199.0]);
    assert_eq!((scale.colour(-1e6), scale.colour(0.0)), (scale.colour(0.0), scale.table(256)[0]));
}

#[test]
fn empty_constant_and_nan_data_give_a_usable_scale() {
    for values in [vec![], vec![3.0; 4], vec![f64::NAN, f64::INFINITY], vec![0.0]] {
        let from_zero = ColourScale::from_zero(values.iter().copied(), "");
        assert_eq!(from_zero.is_some(), values.contains(&3.0));
        for scale in from_zero.into_iter().chain([ColourScale::of_most(values.iter().copied(), "")]) {
            let [low, high] = [scale.low, scale.high];
            assert!(low.is_finite() && high.is_finite() && low < high, "{values:?}: {low} {high}");
            assert_eq!(scale.colour(f64::NAN), Rgb::GREY);
        }
    }
    let constant = ColourScale::of_most([3.0; 4].into_iter(), "");
    assert_eq!(constant.colour(3.0), rainbow(0.5));
}

#[test]
fn mixing_ends_at_its_ends() {
    let (a, b) = (Rgb([10, 20, 30]), Rgb([200, 100, 0]));
    assert_eq!(a.mix(b, 0.0), a);
    assert_eq!(a.mix(b, 1.0), b);
    assert_eq!(a.hex(), "#0a141e");
}
