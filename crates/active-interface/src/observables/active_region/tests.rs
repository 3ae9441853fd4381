use super::*;
use crate::Curve;
use approx::assert_relative_eq;

/// ln cosh without overflow.
fn ln_cosh(x: f64) -> f64 {
    x.abs() + (-2.0 * x.abs()).exp().ln_1p()
}

/// Particle numbers of a plateau between `from` and `to` on a closed line of length 1, edges of width `width`.
fn plateau(m: usize, from: f64, to: f64, width: f64) -> (Vec<f64>, Vec<f64>) {
    // integral of (tanh((s - from)/width) - tanh((s - to)/width))/2
    let integral = |s: f64| 0.5 * width * (ln_cosh((s - from) / width) - ln_cosh((s - to) / width));
    let h = 1.0 / m as f64;
    (vec![h; m], (0..m).map(|k| integral((k + 1) as f64 * h) - integral(k as f64 * h) + 1e-3 * h).collect())
}

#[test]
fn edges_are_found_between_the_markers() {
    // Edges of the width that the steady swimmers have: 0.1 R0 of 6.28 R0 from foot to top.
    for shift in [0.0, 0.1, 0.3, 0.5, 0.7] {
        let m = 240;
        let (from, to) = (0.31 + shift / m as f64, 0.62 + 0.37 * shift / m as f64);
        let (lengths, numbers) = plateau(m, from, to, 0.008);
        let region = active_region(&lengths, &numbers).unwrap().unwrap();
        assert!((region.fraction - (to - from)).abs() < 2e-4, "{shift}: {}", region.fraction - (to - from));
        assert!((region.start - from).abs() < 2e-4 && (region.end - to).abs() < 2e-4);
    }
}

#[test]
fn the_location_is_of_fourth_order() {
    // An edge without symmetry, so that the error of a lower order would show.
    let error = |m: usize, shift: f64| {
        let h = std::f64::consts::TAU / m as f64;
        // c = exp(sin s + 0.3 cos 2s), averaged by Simpson's rule on 8 parts
        let f = |s: f64| ((s + shift * h).sin() + 0.3 * (2.0 * (s + shift * h)).cos()).exp();
        let numbers: Vec<f64> = (0..m)
            .map(|k| {
                let parts = 8;
                (0..=parts)
                    .map(|i| {
                        let weight = if i == 0 || i == parts { 1.0 } else { 2.0 + 2.0 * f64::from(i % 2) };
                        weight * f((k as f64 + f64::from(i) / f64::from(parts)) * h) * h / (3.0 * f64::from(parts))
                    })
                    .sum()
            })
            .collect();
        let region = active_region(&vec![h; m], &numbers).unwrap().unwrap();
        // The zero of c'' by Newton's method: with g = ln c, g'^2 + g'' = 0.
        let mut s = region.start + shift * h;
        for _ in 0..50 {
            let g = s.cos() - 0.6 * (2.0 * s).sin();
            let g2 = -s.sin() - 1.2 * (2.0 * s).cos();
            let g3 = -s.cos() + 2.4 * (2.0 * s).sin();
            s -= (g * g + g2) / (2.0 * g * g2 + g3);
        }
        (region.start + shift * h - s).abs()
    };
    // The largest error over positions of the edge between the markers.
    let largest = |m| (0..10).map(|i| error(m, f64::from(i) / 10.0)).fold(0.0, f64::max);
    let (coarse, fine) = (largest(60), largest(120));
    assert!(fine < 2e-5 && (coarse / fine).log2() > 3.5, "{coarse:e} {fine:e}");
}

#[test]
fn the_polarised_state_is_half_active() {
    // reference/swimmer_transient_box6_activity_1.csv, t = 0: active_frac 0.5, kappa_act 1
    let markers = Curve::circle(1.0).unwrap().markers(250).unwrap();
    let numbers = crate::InitialConcentration::polarised(100.0, 0.3).unwrap().particle_numbers(&markers).unwrap();
    let lengths: Vec<f64> = edges(&markers).map(|(a, b)| (b - a).length()).collect();
    let region = active_region(&lengths, &numbers).unwrap().unwrap();
    assert_relative_eq!(region.fraction, 0.5, epsilon = 1e-8);
    assert_relative_eq!(active_curvature(&markers, &region).unwrap(), 1.0, max_relative = 1e-3);
    assert_eq!(active_region(&lengths, &lengths).unwrap(), None);
}

#[test]
fn a_dent_has_negative_curvature() {
    let markers = Curve::fourier(1.0, &[0.0, 0.25, 0.0], &[]).unwrap().markers(200).unwrap();
    let perimeter = crate::curve::polygon_perimeter(&markers).unwrap();
    let region = |middle: f64| ActiveRegion {
        start: (middle - 0.04) * perimeter,
        end: (middle + 0.04) * perimeter,
        length: 0.08 * perimeter,
        fraction: 0.08,
    };
    let (dent, tip) = (active_curvature(&markers, &region(0.25)), active_curvature(&markers, &region(0.5)));
    assert!(dent.clone().unwrap() < -0.1 && tip.clone().unwrap() > 1.0, "{dent:?} {tip:?}");
    // The tip across marker 0 is the same as the other one.
    assert_relative_eq!(active_curvature(&markers, &region(1.0)).unwrap(), tip.unwrap(), max_relative = 1e-9);
}

#[test]
fn bad_input_is_refused() {
    assert!(active_region(&[1.0; 7], &[1.0; 7]).is_err());
    assert!(active_region(&[1.0; 9], &[1.0; 8]).is_err());
    assert!(active_region(&[0.0; 9], &[1.0; 9]).is_err());
    let markers = Curve::circle(1.0).unwrap().markers(10).unwrap();
    let empty = ActiveRegion { start: 0.0, end: 0.0, length: 0.0, fraction: 0.0 };
    assert!(active_curvature(&markers, &empty).is_err());
}

/// A region all around, and one longer than that.
#[test]
fn a_circle_that_is_active_all_around_has_its_curvature() {
    let markers = Curve::circle(2.0).unwrap().markers(64).unwrap();
    let perimeter = crate::polygon_perimeter(&markers).unwrap();
    let of = |length: f64| {
        let region = ActiveRegion { start: 0.3, end: 0.3 + length, length, fraction: length / perimeter };
        active_curvature(&markers, &region)
    };
    assert!((of(perimeter).unwrap() - 0.5).abs() < 2e-3 && of(1.001 * perimeter).is_err());
}
