use super::*;

#[test]
fn derivatives_of_the_basis() {
    for rates in [[0.3, -4.0], [-1.0, 2.5], [0.2, 3e-4], [0.2, -0.02], [0.5, 0.0]] {
        for model in [Model::Exponential, Model::Oscillator] {
            for t in [0.0, 0.4, 1.0] {
                let here = model.basis(&rates, t);
                let step = 1e-5;
                let slope = |plus: &Basis, minus: &Basis, f: usize, k: usize| {
                    (plus.values[f][k] - minus.values[f][k]) / (2.0 * step)
                };
                let (later, earlier) = (model.basis(&rates, t + step), model.basis(&rates, t - step));
                for f in 0..model.order() {
                    assert!((slope(&later, &earlier, f, 0) - here.values[f][1]).abs() < 1e-8);
                    for p in 0..model.order() {
                        let moved = |by: f64| {
                            let mut rates = rates;
                            rates[p] += by;
                            model.basis(&rates, t)
                        };
                        let (plus, minus) = (moved(step), moved(-step));
                        for k in 0..2 {
                            let error = slope(&plus, &minus, f, k) - here.by_rate[f][k][p];
                            assert!(error.abs() < 1e-7, "{model:?} {rates:?} {t} {f} {k} {p}: {error}");
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn rates_from_a_rough_start() {
    let times: Vec<f64> = (0..=60).map(|i| f64::from(i) / 60.0).collect();
    let values: Vec<f64> = times.iter().map(|t| (0.4 * t).exp() * (9.0 * t + 0.7).cos()).collect();
    let fit = Data::new(times.clone(), &values, None).unwrap().fit(Model::Oscillator, vec![0.0, -70.0]).unwrap();
    assert!((fit.rates[0] - 0.4).abs() < 1e-10 && (fit.rates[1] + 81.0).abs() < 1e-8, "{fit:?}");
    assert!(fit.residual < 1e-12);
    // One exponential does not determine two.
    let values: Vec<f64> = times.iter().map(|t| (-2.0 * t).exp()).collect();
    let data = Data::new(times, &values, None).unwrap();
    assert!((data.fit(Model::Exponential, vec![-1.0]).unwrap().rates[0] + 2.0).abs() < 1e-12);
    assert!(Data::new(vec![0.0, 1.0], &[0.0, 0.0], None).is_none());
}
