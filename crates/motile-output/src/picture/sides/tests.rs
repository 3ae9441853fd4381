use super::*;

/// A jump across a circle, smeared over two cells: either side has its own value up to the circle and across it.
#[test]
fn a_smeared_jump_is_sharp_again() {
    let raster = Raster::new([-2.0, -2.0], [4.0, 4.0], [80, 80], [true; 2]).unwrap();
    for centre in [Vec2::new(0.1, 0.03), Vec2::new(1.7, -1.9)] {
        let angles = (0..100).map(|k| f64::from(k) * std::f64::consts::TAU / 100.0);
        let curve: Vec<Vec2> = angles.map(|t| centre + Vec2::new(t.cos(), t.sin())).collect();
        // Distance from the circle, over the periods.
        let wrapped = |p: Vec2| Vec2::from([0, 1].map(|k| p[k] - centre[k] - 4.0 * ((p[k] - centre[k]) / 4.0).round()));
        let out = |p: Vec2| wrapped(p).length() - 1.0;
        let smeared = |p: Vec2| 3.0 - 2.0 * (0.5 + 0.5 * out(p) / 0.1).clamp(0.0, 1.0);
        let values: Vec<f64> = raster.points().into_iter().map(smeared).collect();
        let fields = sides(&raster, values.clone(), &[&curve], 0.12).unwrap();
        for k in 0..200 {
            let t = 0.1 + f64::from(k) * std::f64::consts::TAU / 200.0;
            let at = |radius: f64| centre + radius * Vec2::new(t.cos(), t.sin());
            for radius in [0.5, 0.95, 0.999, 1.05] {
                assert!((fields.inside.at(at(radius)) - 3.0).abs() < 1e-9, "{t} {radius}");
            }
            for radius in [1.3, 1.05, 1.001, 0.95] {
                assert!((fields.outside.at(at(radius)) - 1.0).abs() < 1e-9, "{t} {radius}");
            }
        }
        assert!(fields.inside.at(centre + Vec2::new(1.8, 0.0)).is_nan());
        // Without curves nothing is changed.
        assert_eq!(sides(&raster, values.clone(), &[], 0.12).unwrap().outside.values, values);
    }
}

/// A circle that is as narrow as the band keeps the samples inside.
#[test]
fn small_circles_keep_their_samples() {
    let raster = Raster::new([0.0, 0.0], [1.0, 1.0], [20, 20], [false; 2]).unwrap();
    let curve = [[0.45, 0.45], [0.55, 0.45], [0.55, 0.55], [0.45, 0.55]].map(Vec2::from);
    let inside = |p: &Vec2| (p.x - 0.5).abs() < 0.05 && (p.y - 0.5).abs() < 0.05;
    let values = raster.points().iter().map(|p| if inside(p) { 2.0 } else { 0.0 }).collect();
    let fields = sides(&raster, values, &[&curve], 0.2).unwrap();
    assert_eq!([fields.inside.at(Vec2::splat(0.5)), fields.outside.at(Vec2::splat(0.56))], [2.0, 0.0]);
}

/// Samples within three quarters of a cell of an interface are not trusted, even where nothing is smeared: their values
/// may be of the other side.
#[test]
fn samples_on_the_interface_are_not_trusted() {
    let raster = Raster::new([-2.0, -2.0], [4.0, 4.0], [40, 40], [false; 2]).unwrap();
    let curve: Vec<Vec2> = (0..400).map(|k| Vec2::from_angle(f64::from(k) * std::f64::consts::TAU / 400.0)).collect();
    let value = |p: &Vec2| match p.length() - 1.0 {
        gap if gap.abs() < 0.07 => 1e3,
        gap if gap < 0.0 => 3.0,
        _ => 1.0,
    };
    let values: Vec<f64> = raster.points().iter().map(value).collect();
    assert!(values.iter().filter(|value| **value == 1e3).count() > 20);
    let fields = sides(&raster, values, &[&curve], 0.0).unwrap();
    for k in 0..200 {
        let direction = Vec2::from_angle(f64::from(k) * std::f64::consts::TAU / 200.0);
        assert!((fields.inside.at(0.95 * direction) - 3.0).abs() < 1e-9, "{direction}");
        assert!((fields.outside.at(1.05 * direction) - 1.0).abs() < 1e-9, "{direction}");
    }
}

/// Samples that are farther apart along y than along x: those within three quarters of the larger distance are not
/// trusted.
#[test]
fn the_larger_distance_of_samples_counts() {
    for cells in [[80, 20], [20, 80]] {
        let raster = Raster::new([-2.0, -2.0], [4.0, 4.0], cells, [false; 2]).unwrap();
        let curve: Vec<Vec2> =
            (0..400).map(|k| Vec2::from_angle(f64::from(k) * std::f64::consts::TAU / 400.0)).collect();
        let value = |p: &Vec2| match p.length() - 1.0 {
            gap if gap.abs() < 0.14 => 1e3,
            gap if gap < 0.0 => 3.0,
            _ => 1.0,
        };
        let values: Vec<f64> = raster.points().iter().map(value).collect();
        assert!(values.iter().filter(|value| **value == 1e3).count() > 20);
        let fields = sides(&raster, values, &[&curve], 0.0).unwrap();
        for k in 0..200 {
            let direction = Vec2::from_angle(f64::from(k) * std::f64::consts::TAU / 200.0);
            assert!((fields.inside.at(0.95 * direction) - 3.0).abs() < 1e-9, "{cells:?} {direction}");
            assert!((fields.outside.at(1.05 * direction) - 1.0).abs() < 1e-9, "{cells:?} {direction}");
        }
    }
}
