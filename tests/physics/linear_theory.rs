//! Growth rates of small perturbations against linear theory (Cowley (2.18), (2.19)), the box's effect removed.

use std::f64::consts::PI;

use motile::base::Region;
use motile::setup::{DropletSetup, Setup};
use motile_tests::validation::growth::{Mode, rate, rate_in_region};
use motile_tests::validation::scene::{on_grid, without_grid};

#[test]
fn growth_rates() {
    let setup = on_grid(0.1);
    for mode in [Mode::Concentration(1), Mode::Concentration(2), Mode::Concentration(3), Mode::Shape(2), Mode::Shape(3)]
    {
        let (theory, measured) = (mode.theory(&setup).unwrap(), rate(&setup, mode).unwrap());
        assert!((measured / theory - 1.0).abs() < 0.01, "{mode:?}: {measured} {theory}");
    }
}

/// Size (gamma/(eta R0)) of the rate of mode 2 of a circle of radius 1 in a square periodic box, by its Fourier series.
///
/// A circle with r = 1 + e cos 2 theta has the normal force -3 e gamma cos 2 theta, but for a pressure. The part of its
/// transform across the wave vector k at the angle phi is 4 i pi sin(2 phi) J_2(k)/k, and the normal velocity of the
/// sum over all k, projected on cos 2 theta,
///
///     48 pi/L^2 SUM_k (sin(2 phi) J_2(k)/k^2)^2,
///
/// goes to 12 INT J_2^2/k^3 dk = 1/2 in free space. What couples mode 2 to others changes it by 4e-7.
fn rate_in_box(length: f64) -> f64 {
    // Bessel's integral by the midpoint rule, exact to round-off for more points than k and some.
    let bessel = |k: f64| {
        let n = 40.0 + 2.0 * k.ceil();
        let at = |j: f64| PI * (j + 0.5) / n;
        (0..n as usize).map(|j| at(j as f64)).map(|t| (2.0 * t - k * t.sin()).cos()).sum::<f64>() / n
    };
    let wave = 2.0 * PI / length;
    let term = |m: u32, n: u32| {
        let (x, y) = (wave * f64::from(m), wave * f64::from(n));
        let square = x * x + y * y;
        (2.0 * x * y / square * bessel(square.sqrt()) / square).powi(2)
    };
    // The terms with m or n = 0 vanish, and all quadrants are alike. Beyond the largest wave number K the mean of J_2^2
    // is 1/(pi k), which leaves 4/(pi K^3).
    let largest = 100.0;
    let count = (largest / wave) as u32;
    let inside = |m: u32, n: u32| f64::from(m).hypot(f64::from(n)) * wave <= largest;
    let pairs = (1..=count).flat_map(|m| (1..=count).map(move |n| (m, n)));
    let sum: f64 = pairs.filter(|(m, n)| inside(*m, *n)).map(|(m, n)| term(m, n)).sum();
    4.0 * 48.0 * PI / length.powi(2) * sum + 4.0 / (PI * largest.powi(3))
}

#[test]
fn images_slow_the_relaxation_down() {
    let exact = [6.0, 12.0, 24.0].map(rate_in_box);
    assert!((exact[0] - 0.418_679).abs() < 1e-6 && (exact[1] - 0.478_986).abs() < 1e-6, "{exact:?}");
    // Free space, from terms in 1/L^2 and 1/L^4.
    let [first, second] = [(4.0 * exact[1] - exact[0]) / 3.0, (4.0 * exact[2] - exact[1]) / 3.0];
    assert!(((16.0 * second - first) / 15.0 - 0.5).abs() < 1e-5, "{exact:?}");
    let droplet = DropletSetup { tension: 1.0, ..DropletSetup::active(0.0) };
    let error = |base: Setup, length: f64, exact: f64| {
        let region = Region::Box { lengths: [length; 2] };
        let setup = Setup { viscosity: 1.0, region, droplets: vec![droplet.clone()], ..base };
        -rate_in_region(&setup, Mode::Shape(2)).unwrap() - exact
    };
    // Errors of the markers are of second order.
    for (length, exact) in [(6.0, exact[0]), (12.0, exact[1])] {
        let errors = [128, 256].map(|cells| error(without_grid(32, cells), length, exact));
        let extrapolated = (4.0 * errors[1] - errors[0]) / 3.0;
        assert!(errors[1].abs() < 5e-5 && extrapolated.abs() < 3e-6, "{length}: {errors:?}");
    }
    let errors = [0.1, 0.05].map(|h| error(on_grid(h), 6.0, exact[0]));
    assert!(errors[1].abs() < 2.5e-4 && errors[1].abs() < 0.5 * errors[0].abs(), "{errors:?}");
}
