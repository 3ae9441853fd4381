//! Separable least squares: models that are linear in their amplitudes and nonlinear in one or two rates.

use super::regression::{Solution, inflation};

/// Relaxation of a linear system of one or two variables, in units of time of the length of the record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Model {
    /// `A e^(p0 t)`.
    Exponential,
    /// `e^(p0 t) (A cosh(q t) + B sinh(q t)/q)` with `q^2 = p1`: an oscillation where p1 is negative.
    Oscillator,
}

/// Values of the functions of a model at one time, their derivatives by t (second index 1) and by the rates.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Basis {
    values: [[f64; 2]; 2],
    by_rate: [[[f64; 2]; 2]; 2],
}

impl Model {
    /// Returns the number of rates, and of amplitudes.
    pub(super) fn order(self) -> usize {
        match self {
            Self::Exponential => 1,
            Self::Oscillator => 2,
        }
    }

    /// Functions at time `t`: values[function][derivative], by_rate[function][derivative][rate].
    fn basis(self, rates: &[f64], t: f64) -> Basis {
        let s = rates[0];
        let e = (s * t).exp();
        if self == Self::Exponential {
            return Basis {
                values: [[e, s * e], [0.0; 2]],
                by_rate: [[[t * e, 0.0], [(1.0 + s * t) * e, 0.0]], [[0.0; 2]; 2]],
            };
        }
        let d = rates[1];
        let [c, f, f_d] = hyperbolic(d, t);
        let c_d = 0.5 * t * f;
        let (c1, f1) = (e * (s * c + d * f), e * (s * f + c));
        let (c, f) = (e * c, e * f);
        Basis {
            values: [[c, c1], [f, f1]],
            by_rate: [
                [[t * c, e * c_d], [t * c1 + c, e * (s * c_d + d * f_d) + f]],
                [[t * f, e * f_d], [t * f1 + f, e * (s * f_d + c_d)]],
            ],
        }
    }
}

/// Returns `cosh(q t)`, `sinh(q t)/q` and the derivative of the latter by d, where `q^2 = d`; smooth in d through zero.
fn hyperbolic(d: f64, t: f64) -> [f64; 3] {
    let x = d * t * t;
    if x.abs() < 1e-2 {
        let cosh = 1.0 + x / 2.0 * (1.0 + x / 12.0 * (1.0 + x / 30.0 * (1.0 + x / 56.0)));
        let sinh = t * (1.0 + x / 6.0 * (1.0 + x / 20.0 * (1.0 + x / 42.0 * (1.0 + x / 72.0))));
        let slope = t.powi(3) / 6.0 * (1.0 + x / 10.0 * (1.0 + x / 28.0 * (1.0 + x / 54.0)));
        return [cosh, sinh, slope];
    }
    let q = d.abs().sqrt();
    let [cosh, sinh] = if d > 0.0 { [(q * t).cosh(), (q * t).sinh() / q] } else { [(q * t).cos(), (q * t).sin() / q] };
    [cosh, sinh, (t * cosh - sinh) / (2.0 * d)]
}

/// The data of a fit: values, and their derivatives times a weight where they are known, at times from 0 to 1.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Data {
    times: Vec<f64>,
    data: Vec<f64>,
    /// Weight of the derivatives; `None` if there are none.
    weight: Option<f64>,
}

/// A fitted model.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SeparableFit {
    pub(super) rates: Vec<f64>,
    /// Covariance of the rates.
    pub(super) covariance: Vec<Vec<f64>>,
    /// Root mean square of the residuals over the root mean square of the data.
    pub(super) residual: f64,
}

impl Data {
    /// Creates data of a fit, with `values` and `derivatives` scaled to a mean square of one; `None` if one of them
    /// vanishes.
    pub(super) fn new(times: Vec<f64>, values: &[f64], derivatives: Option<&[f64]>) -> Option<Self> {
        let rms = |list: &[f64]| (list.iter().map(|v| v * v).sum::<f64>() / list.len() as f64).sqrt();
        let size = rms(values);
        let usable = |size: f64| size.is_finite() && size > 0.0;
        let rate = derivatives.map(rms);
        if !(usable(size) && rate.is_none_or(usable)) {
            return None;
        }
        let mut data: Vec<f64> = values.iter().map(|y| y / size).collect();
        if let (Some(derivatives), Some(rate)) = (derivatives, rate) {
            data.extend(derivatives.iter().map(|d| d / rate));
        }
        Some(Self { times, data, weight: rate.map(|rate| size / rate) })
    }

    /// Returns the weights of the values and of their derivatives.
    fn weights(&self) -> impl Iterator<Item = f64> {
        [Some(1.0), self.weight].into_iter().flatten()
    }

    fn bases(&self, model: Model, rates: &[f64]) -> Vec<Basis> {
        self.times.iter().map(|&t| model.basis(rates, t)).collect()
    }

    fn columns(&self, count: usize, bases: &[Basis], entry: impl Fn(&Basis, usize, usize) -> f64) -> Vec<Vec<f64>> {
        let entry = &entry;
        let series = |column: usize| {
            self.weights().enumerate().flat_map(move |(derivative, weight)| {
                bases.iter().map(move |basis| weight * entry(basis, derivative, column))
            })
        };
        (0..count).map(|column| series(column).collect()).collect()
    }

    /// Amplitudes of least squares for given rates.
    fn amplitudes(&self, model: Model, rates: &[f64]) -> Option<Solution> {
        let bases = self.bases(model, rates);
        Solution::new(self.columns(model.order(), &bases, |basis, k, j| basis.values[j][k]), &self.data)
    }

    /// Gauss-Newton step: least squares solution for the changes of rates and amplitudes.
    fn linearised(&self, model: Model, rates: &[f64], best: &Solution) -> Option<Solution> {
        let (order, bases) = (model.order(), self.bases(model, rates));
        let columns = self.columns(2 * order, &bases, |basis, k, column| {
            if column < order {
                (0..order).map(|j| best.coefficients[j] * basis.by_rate[j][k][column]).sum()
            } else {
                basis.values[column - order][k]
            }
        });
        Solution::new(columns, &best.residuals)
    }

    /// Returns the fit of a model, by variable projection: Gauss-Newton steps in the rates from `rates` on, halved
    /// until the residual falls, with the best amplitudes for each. `None` if the data do not determine the model.
    pub(super) fn fit(&self, model: Model, mut rates: Vec<f64>) -> Option<SeparableFit> {
        const ITERATIONS: usize = 100;
        const HALVINGS: usize = 30;
        let mut best = self.amplitudes(model, &rates)?;
        for _ in 0..ITERATIONS {
            let direction = self.linearised(model, &rates, &best)?.coefficients;
            let before = best.power();
            let improved = (0..HALVINGS).find_map(|halving| {
                let factor = 0.5_f64.powi(halving as i32);
                let trial: Vec<f64> = rates.iter().zip(direction.iter()).map(|(p, d)| p + factor * d).collect();
                let solution = self.amplitudes(model, &trial)?;
                (solution.power() < before).then_some((trial, solution))
            });
            let Some((trial, solution)) = improved else { break };
            let gain = 1.0 - solution.power() / before;
            (rates, best) = (trial, solution);
            if gain < 1e-10 {
                break;
            }
        }
        let last = self.linearised(model, &rates, &best)?;
        let (rows, order) = (self.data.len(), model.order());
        let count = self.times.len();
        // Values and derivatives are two series.
        let parts = best.residuals.chunks_exact(count);
        let correlated = parts.map(inflation).fold(1.0, f64::max);
        let freedom = rows.checked_sub(2 * order).filter(|&freedom| freedom > 0);
        let power = best.power();
        let variance = freedom.map_or(f64::INFINITY, |freedom| power / freedom as f64 * correlated);
        let scaled = |row: &Vec<f64>| row[..order].iter().map(|value| value * variance).collect();
        let covariance = last.inverse[..order].iter().map(scaled).collect();
        Some(SeparableFit { rates, covariance, residual: (power / rows as f64).sqrt() })
    }
}

#[cfg(test)]
mod tests;
