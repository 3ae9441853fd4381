//! Rigid walls of any shape against exact values and limits.

use motile_tests::validation::{curved_walls, order};

/// `curved_walls_*.csv`: droplets of fixed shape in a wavy channel; errors fall faster than any power of the nodes.
#[test]
fn droplets_between_curved_walls() {
    let coarse = curved_walls::fixed(32, 48).unwrap();
    let fine = curved_walls::fixed(96, 96).unwrap();
    println!("{coarse:?} {fine:?}");
    assert!(coarse.markers < 1e-3 && fine.markers < 1e-11 && fine.field < 1e-11, "{coarse:?} {fine:?}");
    assert!(fine.flux < 1e-11 && fine.force < 1e-11, "{fine:?}");
}

/// The flux along a wavy channel: the error of the small-amplitude series is of the fourth power of the amplitude, that
/// of lubrication of the second power of the slope.
#[test]
fn flow_along_wavy_walls() {
    let amplitudes = [0.2, 0.1, 0.05];
    let errors = amplitudes.map(|a| {
        let exact = curved_walls::gradient(6.0, a, 96).unwrap();
        (curved_walls::small_amplitude(6.0, a) / exact - 1.0).abs()
    });
    assert!((order(&amplitudes, &errors) - 4.0).abs() < 0.2, "{errors:?}");
    let lengths = [12.0, 24.0, 48.0];
    let errors = lengths.map(|length| {
        let exact = curved_walls::gradient(length, 0.3, (8.0 * length) as usize).unwrap();
        (curved_walls::lubrication(0.3) / exact - 1.0).abs()
    });
    let slopes = lengths.map(|length| 1.0 / length);
    assert!((order(&slopes, &errors) - 2.0).abs() < 0.1, "{errors:?}");
    // The two limits meet.
    let [small, long] = [curved_walls::small_amplitude(1e3, 0.01), curved_walls::lubrication(0.01)];
    assert!((small / long - 1.0).abs() < 1e-6, "{small} {long}");
}
