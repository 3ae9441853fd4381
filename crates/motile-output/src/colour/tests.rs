use super::*;

#[test]
fn most_leaves_out_what_stands_out() {
    let mut values: Vec<f64> = (0..200).map(f64::from).collect();
    (values[3], values[90]) = (-1e6, 1e6);
    let scale = ColourScale::of_most(values.into_iter(), None, "");
    assert_eq!([scale.low, scale.high], [0.0, 199.0]);
    assert_eq!((scale.colour(-1e6), scale.colour(0.0)), (scale.colour(0.0), scale.table(256)[0]));
}

#[test]
fn empty_constant_and_nan_data_give_a_usable_scale() {
    for values in [vec![], vec![3.0; 4], vec![f64::NAN, f64::INFINITY], vec![0.0]] {
        let from_zero = ColourScale::from_zero(values.iter().copied(), "");
        assert_eq!(from_zero.is_some(), values.contains(&3.0));
        for scale in from_zero.into_iter().chain([ColourScale::of_most(values.iter().copied(), None, "")]) {
            let [low, high] = [scale.low, scale.high];
            assert!(low.is_finite() && high.is_finite() && low < high, "{values:?}: {low} {high}");
            assert_eq!(scale.colour(f64::NAN), Rgb::GREY);
        }
    }
    let constant = ColourScale::of_most([3.0; 4].into_iter(), None, "");
    assert_eq!(constant.colour(3.0), viridis(0.5));
}

#[test]
fn mixing_ends_at_its_ends() {
    let (a, b) = (Rgb([10, 20, 30]), Rgb([200, 100, 0]));
    assert_eq!(a.mix(b, 0.0), a);
    assert_eq!(a.mix(b, 1.0), b);
    assert_eq!(a.hex(), "#0a141e");
}

/// CIELAB coordinates of a colour, and of what an eye without the middle cones sees in its place (Machado, Oliveira and
/// Fernandes 2009).
fn seen(Rgb(channels): Rgb, colour_blind: bool) -> [f64; 3] {
    let linear = |c: u8| {
        let v = f64::from(c) / 255.0;
        if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
    };
    let dot = |row: [f64; 3], v: [f64; 3]| row.iter().zip(v).map(|(a, b)| a * b).sum::<f64>();
    let mut light = channels.map(linear);
    if colour_blind {
        let rows =
            [[0.367_322, 0.860_646, -0.227_968], [0.280_085, 0.672_501, 0.047_413], [-0.011_820, 0.042_940, 0.968_881]];
        light = rows.map(|row| dot(row, light).clamp(0.0, 1.0));
    }
    let rows =
        [[0.412_456, 0.357_576, 0.180_438], [0.212_673, 0.715_152, 0.072_175], [0.019_334, 0.119_192, 0.950_304]];
    let [x, y, z] = rows.map(|row| dot(row, light));
    let f = |v: f64| if v > (6.0f64 / 29.0).powi(3) { v.cbrt() } else { 841.0 / 108.0 * v + 4.0 / 29.0 };
    let [x, y, z] = [f(x / 0.950_47), f(y), f(z / 1.088_83)];
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

#[test]
fn steps_of_the_pressure_look_equal_and_its_signs_differ_for_all_eyes() {
    let distance = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    let colours: Vec<Rgb> = (0..=40).map(|k| blue_red(f64::from(k) / 40.0)).collect();
    let steps: Vec<f64> = colours.windows(2).map(|w| distance(seen(w[0], false), seen(w[1], false))).collect();
    let mean = steps.iter().sum::<f64>() / steps.len() as f64;
    assert!(steps.iter().all(|step| (step / mean - 1.0).abs() < 0.2), "{steps:?}");
    for blind in [false, true] {
        let lab: Vec<[f64; 3]> = colours.iter().map(|&colour| seen(colour, blind)).collect();
        for k in 0..20 {
            assert!(lab[k][0] < lab[k + 1][0] && lab[40 - k][0] < lab[39 - k][0], "{blind} {k}: {lab:?}");
        }
        assert!((8..=20).all(|k| distance(lab[20 - k], lab[20 + k]) > 20.0), "{blind}: {lab:?}");
    }
}

#[test]
fn zero_is_white_and_exceeded_ends_are_known() {
    let values = [-10.0, 0.0, 40.0];
    let scale = |range| ColourScale::of_most(values.into_iter(), range, "").coloured(PressureColours::BlueRed);
    let whole = scale(None);
    let [white, red] = [whole.colour(0.0), whole.colour(40.0)];
    assert!(white.0.iter().all(|c| *c > 240) && red.0[0] > red.0[2] + 50, "{white:?} {red:?}");
    // Equal steps on both sides: a quarter of the way to blue.
    assert_eq!((whole.colour(-10.0), whole.exceeded), (blue_red(0.375), [false; 2]));
    let cut = scale(Some([-20.0, 20.0]));
    assert_eq!((cut.exceeded, cut.colour(40.0), cut.colour(-10.0)), ([false, true], blue_red(1.0), blue_red(0.25)));
    assert_eq!(cut.table(5), [0.0, 0.25, 0.5, 0.75, 1.0].map(blue_red));
    assert_eq!(scale(Some([-5.0, 50.0])).exceeded, [true, false]);
}
