//! The coefficients of the Runge-Kutta-Chebyshev scheme.

/// Damping of the scheme: within the interval of stability all modes decay by at least about a third of this.
const DAMPING: f64 = 2.0 / 13.0;

/// One stage after the first:
/// `Y_j = (1 - mu - nu) Y_0 + mu Y_{j-1} + nu Y_{j-2} + dt (rate f_{j-1} + first_rate f_0)` and the implicit part.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stage {
    pub(super) mu: f64,
    pub(super) nu: f64,
    pub(super) rate: f64,
    pub(super) first_rate: f64,
}

/// The second-order scheme of s stages (Sommeijer, Shampine and Verwer 1998), with the b_0 and b_1 of Verwer and
/// Sommeijer (2004), for which some of the rate may be implicit.
#[derive(Debug, Clone, Default)]
pub(super) struct Coefficients {
    /// `Y_1 = Y_0 + dt first f_0`; also the factor of the implicit part in every stage.
    pub(super) first: f64,
    pub(super) later: Vec<Stage>,
}

/// Returns the Chebyshev polynomial T_j of the first kind and its first two derivatives at w.
fn chebyshev(degree: usize, w: f64) -> [f64; 3] {
    let mut last = [1.0, 0.0, 0.0];
    let mut this = [w, 1.0, 0.0];
    if degree == 0 {
        return last;
    }
    for _ in 1..degree {
        let next = [
            2.0 * w * this[0] - last[0],
            2.0 * this[0] + 2.0 * w * this[1] - last[1],
            4.0 * this[1] + 2.0 * w * this[2] - last[2],
        ];
        (last, this) = (this, next);
    }
    this
}

impl Coefficients {
    /// Those of `stages` stages, at least two.
    pub(super) fn set(&mut self, stages: usize) {
        let stages = stages.max(2);
        if self.later.len() + 1 == stages {
            return;
        }
        let w0 = 1.0 + DAMPING / (stages * stages) as f64;
        let [_, first, second] = chebyshev(stages, w0);
        let w1 = first / second;
        let b = |j: usize| match j {
            1 => 1.0 / w0,
            j => {
                let [_, first, second] = chebyshev(j.max(2), w0);
                second / (first * first)
            }
        };
        self.first = w1 / w0;
        self.later.clear();
        for j in 2..=stages {
            let rate = 2.0 * b(j) * w1 / b(j - 1);
            self.later.push(Stage {
                mu: 2.0 * b(j) * w0 / b(j - 1),
                nu: -b(j) / b(j - 2),
                rate,
                first_rate: -(1.0 - b(j - 1) * chebyshev(j - 1, w0)[0]) * rate,
            });
        }
    }
}

/// Returns the length of the interval of stability of `stages` stages: about 0.65 (s^2 - 1).
pub(super) fn interval(stages: usize) -> f64 {
    let s = stages.max(2) as f64;
    2.0 / 3.0 * (s * s - 1.0) * (1.0 - 2.0 / 15.0 * DAMPING)
}

/// Returns the fewest stages whose interval is at least `length`.
pub(super) fn stages_for(length: f64) -> usize {
    let s = (length / (2.0 / 3.0 * (1.0 - 2.0 / 15.0 * DAMPING)) + 1.0).max(0.0).sqrt().ceil();
    // Not a number gives the fewest: the step itself will say what is wrong.
    if s.is_finite() { (s as usize).max(2) } else { 2 }
}

#[cfg(test)]
mod tests;
