//! Tension laws from tables.

use pyo3::PyResult;

use motile::active_interface::Tension;

use crate::error::refused;

/// Tension as a function of the concentration through the points of a table, by cubic polynomials between them; beyond
/// the table it goes on straight. Slopes of measured tables never change the sense of one that rises or falls
/// throughout (Fritsch and Carlson, "Monotone piecewise cubic interpolation", 1980, with the harmonic means of Fritsch
/// and Butland); those of a smooth function are of the polynomial through five points, so that the error is of the
/// fourth order in their distance.
#[derive(Debug, Clone)]
pub(crate) struct TabulatedTension {
    concentrations: Vec<f64>,
    tensions: Vec<f64>,
    slopes: Vec<f64>,
}

impl TabulatedTension {
    pub(crate) fn new(concentrations: Vec<f64>, tensions: Vec<f64>, smooth: bool) -> PyResult<Self> {
        let refuse = |problem: &str, remedy: &str| {
            refused(&format!("{problem}. {remedy}"), Some("tension".into()), None, Some(remedy.into()))
        };
        if concentrations.len() != tensions.len() || concentrations.len() < 3 {
            let problem = format!("{} concentrations and {} tensions", concentrations.len(), tensions.len());
            return Err(refuse(&problem, "Use equally many of both, at least three"));
        }
        if !concentrations.iter().chain(&tensions).all(|value| value.is_finite()) {
            return Err(refuse("the table of a tension has a value that is not finite", "Use finite numbers"));
        }
        if !concentrations.windows(2).all(|pair| pair[0] < pair[1]) {
            return Err(refuse("the concentrations of a tension are not increasing", "Sort the table"));
        }
        let intervals = concentrations.windows(2).zip(tensions.windows(2));
        let steps: Vec<[f64; 2]> = intervals.map(|(c, g)| [c[1] - c[0], (g[1] - g[0]) / (c[1] - c[0])]).collect();
        let mut slopes = vec![steps[0][1]];
        for pair in steps.windows(2) {
            let ([h0, d0], [h1, d1]) = (pair[0], pair[1]);
            let (w0, w1) = (2.0 * h1 + h0, h1 + 2.0 * h0);
            slopes.push(if d0 * d1 > 0.0 { (w0 + w1) / (w0 / d0 + w1 / d1) } else { 0.0 });
        }
        slopes.push(steps[steps.len() - 1][1]);
        if smooth && concentrations.len() >= 5 {
            slopes = (0..concentrations.len()).map(|k| slope_of_five(&concentrations, &tensions, k)).collect();
        }
        Ok(Self { concentrations, tensions, slopes })
    }

    /// Value and slope.
    fn at(&self, c: f64) -> [f64; 2] {
        let k = self.concentrations.partition_point(|&known| known <= c);
        let last = self.concentrations.len() - 1;
        if k == 0 || k > last {
            let end = if k == 0 { 0 } else { last };
            return [self.tensions[end] + self.slopes[end] * (c - self.concentrations[end]), self.slopes[end]];
        }
        let h = self.concentrations[k] - self.concentrations[k - 1];
        let t = (c - self.concentrations[k - 1]) / h;
        let [(a, b), (p, q)] = [&self.tensions, &self.slopes].map(|list| (list[k - 1], list[k]));
        let (b, p, q) = (b - a, h * p, h * q);
        // a + p t + (3 b - 2 p - q) t^2 + (p + q - 2 b) t^3
        let (second, third) = (3.0 * b - 2.0 * p - q, p + q - 2.0 * b);
        [a + t * (p + t * (second + t * third)), (p + t * (2.0 * second + 3.0 * t * third)) / h]
    }
}

/// Slope at point k of the polynomial through the five points of a table around it.
fn slope_of_five(x: &[f64], y: &[f64], k: usize) -> f64 {
    let first = k.saturating_sub(2).min(x.len() - 5);
    let others = |j: usize| (first..first + 5).filter(move |&i| i != j && i != k);
    // Each point by the slope of its Lagrange polynomial; those of the constant one add up to zero.
    let slope = |j: usize| others(j).map(|i| (x[k] - x[i]) / (x[j] - x[i])).product::<f64>() / (x[j] - x[k]);
    (first..first + 5).filter(|&j| j != k).map(|j| slope(j) * (y[j] - y[k])).sum()
}

impl Tension for TabulatedTension {
    fn value(&self, c: f64) -> f64 {
        self.at(c)[0]
    }

    fn slope(&self, c: f64) -> f64 {
        self.at(c)[1]
    }
}
