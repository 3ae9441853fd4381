use super::uniform;

/// Mean, variance and correlations along each key, of 1e5 numbers: within four standard errors of those of independent
/// even ones.
#[test]
fn numbers_are_even_and_independent_along_all_keys() {
    const COUNT: u64 = 100_000;
    let keys: [fn(u64) -> f64; 4] =
        [|k| uniform(k, 3, 7), |k| uniform(1, k, 7), |k| uniform(1, 3, k), |k| uniform(k, k, k)];
    for (number, key) in keys.iter().enumerate() {
        let numbers: Vec<f64> = (0..COUNT).map(key).collect();
        assert!(numbers.iter().all(|u| (0.0..1.0).contains(u)));
        let count = COUNT as f64;
        let mean = numbers.iter().sum::<f64>() / count - 0.5;
        let variance = numbers.iter().map(|u| (u - 0.5).powi(2)).sum::<f64>() / count - 1.0 / 12.0;
        assert!(mean.abs() < 4.0 * (1.0 / (12.0 * count)).sqrt(), "{number}: {mean:e}");
        assert!(variance.abs() < 4.0 * (1.0 / (180.0 * count)).sqrt(), "{number}: {variance:e}");
        for lag in [1, 2, 1024] {
            let products = numbers.iter().zip(&numbers[lag..]).map(|(a, b)| (a - 0.5) * (b - 0.5));
            let correlation = products.sum::<f64>() / (count - lag as f64) * 12.0;
            assert!(correlation.abs() < 4.0 / count.sqrt(), "{number}, {lag}: {correlation:e}");
        }
    }
}
