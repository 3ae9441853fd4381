use std::f64::consts::TAU;

use super::*;

/// A spheroid has its aspect ratio, and the surface of one.
#[test]
fn moments_of_spheroids() {
    for along in [1.0, 1.5, 0.7_f64] {
        let at = |k: usize| {
            let (sin, cos) = (TAU * k as f64 / 64.0).sin_cos();
            Vec2::new(0.4 + along * cos, if k.is_multiple_of(32) { 0.0 } else { sin })
        };
        let profile = Profile { positions: (0..64).map(at).collect(), density: vec![1.0; 64], nuclei: Vec::new() };
        let moments = VolumeMoments::of(&profile).unwrap();
        assert!((moments.aspect_ratio / along - 1.0).abs() < 1e-9, "{along}: {}", moments.aspect_ratio);
        assert!((moments.centroid - 0.4).abs() < 1e-12, "{along}: {}", moments.centroid);
        if along > 1.0 {
            let eccentricity = (1.0 - 1.0 / (along * along)).sqrt();
            let surface = 2.0 * PI * (1.0 + along / eccentricity * eccentricity.asin());
            assert!((moments.surface / surface - 1.0).abs() < 1e-9, "{along}: {}", moments.surface);
        }
    }
}
