use super::*;

#[test]
fn a_row_beside_a_few_markers() {
    let mut markers = Markers::new();
    markers.push_group(3, MarkerKind::Interface { viscosity_inside: None });
    markers.push_group(40, MarkerKind::Points);
    let heights = [0.1, 0.03, 1.5];
    for (k, height) in heights.iter().enumerate() {
        markers.positions[k] = Vec2::new(8.0 + 0.1 * k as f64, *height);
    }
    for k in 0..40 {
        markers.positions[3 + k] = Vec2::new(0.1 * k as f64, 0.0);
    }
    let mut clearance = Clearance::default();
    assert!(clearance.gaps(&markers, 0, 0.1, 4.0).is_empty(), "without forces they are tracers");
    markers.forces[10] = Vec2::new(1.0, 0.0);
    // The row repeats itself with the period of 4.
    let gaps = clearance.gaps(&markers, 0, 0.1, 4.0).to_vec();
    assert!((gaps[0] - 0.8).abs() < 1e-9 && (gaps[1] - 0.1).abs() < 1e-9 && gaps[2] == f64::INFINITY, "{gaps:?}");
    let mut alone = Markers::new();
    alone.push_group(3, MarkerKind::Interface { viscosity_inside: None });
    assert!(clearance.gaps(&alone, 0, 0.1, 4.0).is_empty());
}
