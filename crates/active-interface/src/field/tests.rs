use super::*;
use crate::error::refused;

const TABLE: fn(f64, f64) -> f64 = |x, y| (0.7 * x).sin() * (0.4 * y).cos();

fn table(count: usize, side: f64) -> Table {
    let spacing = side / (count - 1) as f64;
    let at = |k: usize| -0.5 * side + spacing * k as f64;
    let rows: Vec<Vec<f64>> = (0..count).map(|j| (0..count).map(|i| TABLE(at(i), at(j))).collect()).collect();
    Table::new(Vec2::splat(-0.5 * side), Vec2::splat(spacing), &rows).unwrap()
}

#[test]
fn a_table_is_interpolated_to_third_order_and_continues_beyond_its_edge() {
    let error = |count: usize| {
        let field = Field::table(table(count, 6.0));
        let places = (0..400).map(|k| 2.2 * Vec2::new((1.7 * f64::from(k)).sin(), (2.9 * f64::from(k)).cos()));
        places.map(|x| (field.value(x, 0.0) - TABLE(x.x, x.y)).abs()).fold(0.0, f64::max)
    };
    let [coarse, fine] = [error(13), error(25)];
    assert!(fine < 4e-4 && coarse / fine > 6.0, "{coarse} {fine}");
    let field = Field::table(table(13, 6.0));
    let [edge, beyond] = [3.0, 30.0].map(|x| field.value(Vec2::new(x, 0.3), 0.0));
    assert!((edge - TABLE(3.0, 0.3)).abs() < 1e-3 && edge == beyond);
    // A linear field is exact up to the edge.
    let rows = [vec![0.0, 2.0, 4.0], vec![1.0, 3.0, 5.0]];
    let plane = Field::table(Table::new(Vec2::ZERO, Vec2::new(1.0, 0.5), &rows).unwrap());
    for x in [0.1, 0.9, 1.0, 1.3, 2.0] {
        assert!((plane.value(Vec2::new(x, 0.2), 0.0) - 2.0 * x - 0.4).abs() < 1e-13);
    }
}

#[test]
fn tables_spots_and_waves_repeat_with_periods() {
    let row: Vec<f64> = (0..12).map(|k| (TAU * f64::from(k) / 12.0).sin()).collect();
    let table = Table::new(Vec2::new(-3.0, 0.0), Vec2::new(0.5, 1.0), &[row]).unwrap();
    let spot = Field::spot(Vec2::new(2.8, 0.0), 0.5, 3.0).unwrap();
    let wave = Field::wave(1.0, Vec2::new(TAU / 3.0, 0.0), 0.1, 0.0).unwrap();
    let field = (Field::table(table) + spot + wave).periodic([Some(6.0), None]).unwrap();
    for x in [-3.0, -0.3, 0.1, 2.9] {
        let [here, there] = [x, x + 6.0].map(|x| field.value(Vec2::new(x, 0.4), 0.7));
        assert!((here - there).abs() < 1e-13 * 4.0, "{here} {there}");
    }
    // A spot near one side is felt at the other.
    let spot = Field::spot(Vec2::new(2.8, 0.0), 0.5, 3.0).unwrap().periodic([Some(6.0), None]).unwrap();
    let expected = 3.0 * (-0.5 * (0.4_f64 / 0.5).powi(2)).exp();
    assert!((spot.value(Vec2::new(-2.8, 0.0), 0.0) - expected).abs() < 1e-12);
}

#[test]
fn fields_that_do_not_fit_are_refused() {
    let wave = Field::wave(1.0, Vec2::new(1.0, 0.0), 0.0, 0.0).unwrap();
    let error = wave.periodic([Some(6.0), None]).unwrap_err();
    assert!(refused(&error, "does not fit the period 6"), "{error}");
    let wide = Field::spot(Vec2::ZERO, 7.0, 1.0).unwrap().periodic([Some(6.0), None]).unwrap_err();
    assert!(refused(&wide, "wider than the period"));
    let short = Field::table(table(13, 6.0)).periodic([Some(6.0), None]).unwrap_err();
    assert!(refused(&short, "a table does not repeat"), "{short}");
    let ragged = Table::new(Vec2::ZERO, Vec2::ONE, &[vec![1.0], vec![1.0, 2.0]]).unwrap_err();
    assert!(refused(&ragged, "different lengths"));
    for bad in [f64::NAN, f64::INFINITY] {
        assert!(Field::uniform(bad).is_err() && Field::spot(Vec2::ZERO, bad, 1.0).is_err());
        assert!(Field::gradient(Vec2::new(bad, 0.0), Vec2::ZERO).is_err());
        assert!(Field::wave(1.0, Vec2::ZERO, bad, 0.0).is_err());
    }
}

#[test]
fn symmetry_about_the_axis_is_known() {
    let gradient = |x, y| Field::gradient(Vec2::new(x, y), Vec2::ZERO).unwrap();
    assert!(gradient(1.0, 0.0).is_symmetric(1.0) && !gradient(1.0, 0.1).is_symmetric(1.0));
    assert!(Field::of(|x| x.y * x.y).is_symmetric(1e-6) && !Field::of(|x| x.y).is_symmetric(1e-6));
    assert!(Field::table(table(13, 6.0)).is_symmetric(1.0));
    assert!(!Field::spot(Vec2::new(0.0, 0.1), 1.0, 1.0).unwrap().is_symmetric(1.0));
}

#[test]
fn a_modulation_multiplies_and_frequencies_add() {
    let wave = Field::wave(2.0, Vec2::new(1.0, 0.0), 3.0, 0.2).unwrap();
    let modulation = Modulation { mean: 0.5, amplitude: 0.25, frequency: 2.0, phase: 0.1 };
    let field = wave.modulated(modulation).unwrap();
    let (x, t) = (0.7, 0.9_f64);
    let expected = 2.0 * (x - 3.0 * t + 0.2).sin() * (0.5 + 0.25 * (2.0 * t + 0.1).cos());
    assert!((field.value(Vec2::new(x, 5.0), t) - expected).abs() < 1e-15);
    assert!(field.depends_on_time() && field.highest_frequency() == 5.0);
    assert!(!Field::uniform(1.0).unwrap().depends_on_time());
}
