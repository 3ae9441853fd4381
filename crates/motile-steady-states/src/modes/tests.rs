use super::*;

/// Coefficients come back from the offsets, densities and places that they stand for, in units of length and density.
#[test]
fn coefficients_come_back() {
    for scales in [[1.0, 1.0], [2.0, 30.0], [0.5, 0.0]] {
        for nuclei in [0, 2] {
            let mut modes = Modes::new(16, scales, nuclei).unwrap();
            let state = DVector::from_fn(modes.len(), |k, _| 0.1 + 0.03 * (k as f64).sin());
            let (offsets, density) = modes.synthesise(&state);
            let back = modes.analyse(&offsets, &density).unwrap();
            assert!((&back - &state).amax() < 1e-13, "{scales:?} {nuclei}: {back} {state}");
        }
    }
}

/// The place of a disc is in units of length, along and across.
#[test]
fn places_of_discs_are_lengths() {
    let mut modes = Modes::new(16, [2.0, 1.0], 1).unwrap();
    let (mut offsets, mut density) = (vec![0.0; 17], vec![0.0; 17]);
    (offsets[16], density[16]) = (0.6, -0.4);
    let state = modes.analyse(&offsets, &density).unwrap();
    let mut found: Vec<f64> = state.iter().copied().filter(|value| *value != 0.0).collect();
    found.sort_by(f64::total_cmp);
    assert_eq!(found, [-0.2, 0.3]);
}
