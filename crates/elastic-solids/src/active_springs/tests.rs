use super::*;
use crate::Solid;
use crate::mesh::{equilateral_block, equilateral_strip};
use motile_scene::{Scene, Substrate};

/// Occupation of many bonds over many steps: mean, variance and autocovariance of the telegraph process, within three
/// standard errors, for steps long and short beside the time in which bonds forget.
#[test]
fn bonds_have_the_statistics_of_two_states() {
    let mesh = equilateral_strip(Vec2::ZERO, 40, 20, 0.1).unwrap();
    for (on, off, dt) in [(1.0, 2.0, 0.05), (0.3, 0.1, 1.0), (1.0, 1.0, 10.0)] {
        let law = ActiveSprings::new(1.0, on, off, 7).unwrap();
        let mut bonds = Bonds::new(&mesh, law);
        let (p, k, count) = (law.duty_ratio(), on + off, bonds.on().len() as f64);
        assert!((p - on / k).abs() < 1e-15);
        // What bonds remember falls by exp(-1/2) in the longest step.
        assert!((k * bonds.resolved_step() - 0.5).abs() < 1e-15);
        let deviation = |value: bool| f64::from(u8::from(value)) - p;
        // Samples as far apart as bonds remember are independent.
        let apart = (10.0 / (k * dt)).ceil() as usize;
        let (mut mean, mut lagged, mut samples) = (0.0, 0.0, 0.0);
        for _ in 0..20 {
            let before = bonds.on().to_vec();
            for step in 0..apart {
                bonds.end_step(mesh.points(), dt);
                bonds.keep_step();
                if step == 0 {
                    let pairs = before.iter().zip(bonds.on());
                    lagged += pairs.map(|(a, b)| deviation(*a) * deviation(*b)).sum::<f64>();
                }
            }
            mean += bonds.on().iter().map(|on| deviation(*on)).sum::<f64>();
            samples += count;
        }
        let variance = p * (1.0 - p);
        let [mean, lagged] = [mean, lagged].map(|sum| sum / samples);
        assert!(mean.abs() < 3.0 * (variance / samples).sqrt(), "{on} {off} {dt}: {mean:e}");
        let error = lagged - variance * (-k * dt).exp();
        assert!(error.abs() < 3.0 * (variance / samples).sqrt(), "{on} {off} {dt}: {error:e}");
    }
}

/// Contractions of the mean stress `sqrt(3) p f/l`, and variances and covariances of the stress of the whole, averaged
/// over a period and over independent states.
#[test]
fn stresses_have_their_mean_and_variances() {
    let (spacing, f) = (0.1, 2.0);
    let mesh = equilateral_strip(Vec2::ZERO, 30, 30, spacing).unwrap();
    let law = ActiveSprings::new(f, 1.0, 1.5, 3).unwrap();
    let p = law.duty_ratio();
    let mut bonds = Bonds::new(&mesh, law);
    let mut totals: Vec<[f64; 3]> = Vec::new();
    for _ in 0..1500 {
        bonds.end_step(mesh.points(), 1e3);
        bonds.keep_step();
        let mut stresses = vec![Mat2::ZERO; mesh.triangles().len()];
        bonds.add_stresses(&mesh, mesh.points(), &mut stresses);
        let total = stresses.iter().zip(mesh.areas()).fold(Mat2::ZERO, |sum, (s, area)| sum + *s * *area);
        totals.push([total.x_axis.x, total.y_axis.y, total.x_axis.y].map(|s| s / mesh.area()));
    }
    let count = totals.len() as f64;
    let mean = |value: &dyn Fn(&[f64; 3]) -> f64| totals.iter().map(value).sum::<f64>() / count;
    // Sums over the bonds themselves, halves on the boundary.
    let sum = |power: i32, weight: &dyn Fn(Vec2) -> f64| {
        let edges = mesh.edges().iter();
        edges
            .map(|edge| {
                let share: f64 = if edge.triangles.1.is_some() { 1.0 } else { 0.5 };
                share.powi(power) * weight(mesh.edge_vector(edge, mesh.points()) / spacing)
            })
            .sum::<f64>()
    };
    let unit = f * spacing / mesh.area();
    let means = [mean(&|s| s[0]), mean(&|s| s[1]), mean(&|s| s[2])];
    let exact = [sum(1, &|n| n.x * n.x), sum(1, &|n| n.y * n.y), sum(1, &|n| n.x * n.y)].map(|sum| p * unit * sum);
    let expected = 3.0_f64.sqrt() * p * f / spacing;
    assert!(exact[..2].iter().all(|stress| (stress / expected - 1.0).abs() < 1e-12) && exact[2].abs() < 1e-12);
    let fourth = [sum(2, &|n| n.x.powi(4)), sum(2, &|n| n.y.powi(4)), sum(2, &|n| (n.x * n.y).powi(2))];
    let variances = fourth.map(|sum| p * (1.0 - p) * unit * unit * sum);
    for k in 0..3 {
        let variance = mean(&|s| (s[k] - exact[k]).powi(2));
        assert!((means[k] - exact[k]).abs() < 3.0 * (variances[k] / count).sqrt(), "mean {k}: {means:?} {exact:?}");
        let error = variance / variances[k] - 1.0;
        assert!(error.abs() < 3.0 * (2.0 / count).sqrt(), "variance {k}: {error}");
    }
    // Of a lattice without a boundary.
    let whole = p * (1.0 - p) * f * f * 2.0 * 3.0_f64.sqrt() / mesh.area();
    for (variance, part) in variances.iter().zip([0.375, 0.375, 0.125]) {
        assert!((variance / (part * whole) - 1.0).abs() < 0.05, "{variance} {}", part * whole);
    }
    let covariance = mean(&|s| (s[0] - exact[0]) * (s[1] - exact[1]));
    let error = covariance - variances[2];
    assert!(error.abs() < 3.0 * (2.0 * variances[0] * variances[1] / count).sqrt(), "{error:e}");
}

#[test]
fn rates_follow_the_strain() {
    let law = ActiveSprings::new(1.0, 1.0, 2.0, 1).unwrap();
    let slip = law.with_sensitivities(0.0, 3.0).unwrap();
    let catch = law.with_sensitivities(0.0, -3.0).unwrap();
    let late = |law: &ActiveSprings, strain: f64| law.probability(false, strain, 1e6);
    for strain in [-0.2, 0.3] {
        assert!((late(&slip, strain) - 1.0 / (1.0 + 2.0 * (3.0 * strain).exp())).abs() < 1e-12);
        assert!((late(&catch, strain) - 1.0 / (1.0 + 2.0 * (-3.0 * strain).exp())).abs() < 1e-12);
        assert!((late(&law, strain) - 1.0 / 3.0).abs() < 1e-12);
    }
    // Of any strain.
    for strain in [1e300, -1.0] {
        for law in [slip, catch] {
            for on in [false, true] {
                assert!((0.0..=1.0).contains(&law.probability(on, strain, 0.1)));
            }
        }
    }
    assert!((law.probability(true, 0.0, 0.0) - 1.0).abs() < 1e-15 && law.probability(false, 0.0, 0.0) == 0.0);
}

#[test]
fn numbers_out_of_range_are_refused() {
    for (tension, on, off) in [(0.0, 1.0, 1.0), (1.0, 0.0, 1.0), (1.0, 1.0, -1.0), (f64::NAN, 1.0, 1.0)] {
        assert!(ActiveSprings::new(tension, on, off, 1).is_err());
    }
    let law = ActiveSprings::new(1.0, 1.0, 0.0, 1).unwrap();
    assert!(law.with_sensitivities(f64::INFINITY, 0.0).is_err() && law.with_sensitivities(0.0, f64::NAN).is_err());
    assert_eq!(law.duty_ratio(), 1.0);
}

/// A free lattice of springs K without a fluid between its points contracts by `p f/(K l)` in the mean, within three
/// standard errors.
#[test]
fn a_free_lattice_contracts() {
    let (spring, f) = (1.0, 0.005);
    let law = ActiveSprings::new(f, 0.4, 0.6, 5).unwrap();
    let mesh = equilateral_block(Vec2::ZERO, 12, 10, 1.0).unwrap();
    let solid = Solid::springs(mesh, 0.25 * 3.0_f64.sqrt() * spring).unwrap().with_active_springs(law);
    let mut scene = Scene::new(Substrate::new(1.0).unwrap());
    let handle = scene.add(solid);
    let mut strains = Vec::new();
    for sample in 0..160 {
        // Beyond the slowest motion of the whole.
        (0..160).for_each(|_| scene.step(0.25).unwrap());
        let solid = scene.body(handle).unwrap();
        let area: f64 = solid.jacobians().zip(solid.mesh().areas()).map(|(j, area)| j * area).sum();
        if sample > 2 {
            strains.push(0.5 * (area / solid.mesh().area() - 1.0));
        }
    }
    let count = strains.len() as f64;
    let mean = strains.iter().sum::<f64>() / count;
    let error = (strains.iter().map(|s| (s - mean).powi(2)).sum::<f64>() / (count * (count - 1.0))).sqrt();
    let expected = -law.duty_ratio() * f / spring;
    assert!((mean - expected).abs() < 3.0 * error && error < 0.02 * expected.abs(), "{mean:e} {expected:e} {error:e}");
}
