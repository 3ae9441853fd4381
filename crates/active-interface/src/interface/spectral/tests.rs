use super::*;
use crate::Curve;
use crate::interface::geometry::outward;

/// An ellipse at equal arc lengths: lengths, tangents and the force of a constant tension, to round-off with 128
/// markers.
#[test]
fn an_ellipse_to_round_off() {
    let curve = Curve::ellipse(1.3, 0.8).unwrap();
    // Markers of the polygon lie off the ellipse by a common factor, which does not matter for what is compared.
    let markers = curve.markers(256).unwrap();
    let mut geometry = Geometry::default();
    let mut spectral = SpectralCurve::new(256).unwrap();
    spectral.update(&markers, 0.0, &mut geometry);
    let scale = markers[0].x / 1.3;
    for (marker, tau) in markers.iter().zip(&geometry.tangents) {
        let exact = Vec2::new(-marker.y / 0.64, marker.x / 1.69).normalize();
        assert!((tau - exact).length() < 2e-7, "{}", (tau - exact).length());
    }
    assert!((geometry.perimeter / scale - curve.perimeter()).abs() < 1e-7);
    let mut before = geometry.directions[255];
    let mut forces: Vec<Vec2> = geometry
        .directions
        .iter()
        .map(|&here| {
            let force = here - before;
            before = here;
            force
        })
        .collect();
    spectral.sharpen(&mut forces);
    for (k, force) in forces.iter().enumerate() {
        let (x, y) = (markers[k].x / scale, markers[k].y / scale);
        let curvature = (1.3_f64 * 0.8).powi(-2) / (x * x / 1.3_f64.powi(4) + y * y / 0.8_f64.powi(4)).powf(1.5);
        let exact = -curvature / scale * outward(geometry.tangents[k]) * geometry.weights[k];
        assert!((force - exact).length() < 1e-5 * exact.length(), "{k}: {force} {exact}");
    }
}

/// Equidistribution: the rate of change of every segment's length is the same, and the area does not change.
#[test]
fn motion_keeps_spacing_and_area() {
    let markers = Curve::fourier(1.0, &[0.0, 0.1, 0.05], &[]).unwrap().markers(128).unwrap();
    let mut geometry = Geometry::default();
    let mut spectral = SpectralCurve::new(128).unwrap();
    spectral.update(&markers, 0.0, &mut geometry);
    let velocities: Vec<Vec2> = markers.iter().map(|x| Vec2::new(x.y + 0.2 * x.x * x.x, 0.3 * x.x - x.y)).collect();
    let (mut motion, mut slip) = (vec![Vec2::ZERO; 128], vec![0.0; 128]);
    spectral.equidistribute(&geometry, &velocities, Vec2::ZERO, 0.0, &mut motion, &mut slip);
    let area: f64 = (0..128).map(|k| motion[k].dot(outward(geometry.tangents[k])) * geometry.weights[k]).sum();
    assert!(area.abs() < 1e-13);
    let step = 1e-5;
    let moved: Vec<Vec2> = markers.iter().zip(&motion).map(|(x, v)| x + step * v).collect();
    let mut after = Geometry::default();
    spectral.update(&moved, 0.0, &mut after);
    let rates: Vec<f64> = after.lengths.iter().zip(&geometry.lengths).map(|(a, b)| (a - b) / step).collect();
    let mean = rates.iter().sum::<f64>() / 128.0;
    assert!(rates.iter().all(|rate| (rate - mean).abs() < 1e-6), "{mean}");
}

/// A translation moves all markers alike, on however few markers, and nothing slips along them.
#[test]
fn translation_is_exact() {
    let markers = Curve::fourier(1.0, &[0.0, 0.3, 0.1], &[]).unwrap().markers(16).unwrap();
    let mut geometry = Geometry::default();
    let mut spectral = SpectralCurve::new(16).unwrap();
    spectral.update(&markers, 0.0, &mut geometry);
    let carried = Vec2::new(10.0, -3.0);
    let (mut motion, mut slip) = (vec![Vec2::ZERO; 16], vec![0.0; 16]);
    spectral.equidistribute(&geometry, &[carried; 16], carried, 0.0, &mut motion, &mut slip);
    assert!(motion.iter().all(|motion| (*motion - carried).length() < 1e-14), "{motion:?}");
    assert!(slip.iter().all(|slip| slip.abs() < 1e-14), "{slip:?}");
}
