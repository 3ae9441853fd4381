//! Waves of the parameter of a meridian, series of them, and points that the series give.

use motile_base::Vec2;

/// Waves that are multiplied at once by one factor.
pub(super) const LANES: usize = 8;

/// cos(k t) and sin(k t) for k = 0, 1, ...
#[derive(Debug, Clone, Default)]
pub(super) struct Waves {
    pub(super) cos: Vec<f64>,
    pub(super) sin: Vec<f64>,
}

impl Waves {
    pub(super) fn new(count: usize) -> Self {
        let zeros = vec![0.0; count.next_multiple_of(LANES)];
        Self { cos: zeros.clone(), sin: zeros }
    }

    /// Takes the waves of an angle.
    pub(super) fn fill(&mut self, angle: f64) {
        self.fill_from(angle.sin_cos());
    }

    /// Takes the waves of an angle with this sine and cosine, by products that keep the relative accuracy of the sines
    /// of small angles.
    pub(super) fn fill_from(&mut self, (s, c): (f64, f64)) {
        let (mut cos, mut sin) = ([1.0; LANES], [0.0; LANES]);
        for k in 1..LANES {
            (cos[k], sin[k]) = (cos[k - 1] * c - sin[k - 1] * s, sin[k - 1] * c + cos[k - 1] * s);
        }
        let (c, s) = (cos[LANES - 1] * c - sin[LANES - 1] * s, sin[LANES - 1] * c + cos[LANES - 1] * s);
        for (out_cos, out_sin) in self.cos.chunks_exact_mut(LANES).zip(self.sin.chunks_exact_mut(LANES)) {
            out_cos.copy_from_slice(&cos);
            out_sin.copy_from_slice(&sin);
            for (a, b) in cos.iter_mut().zip(&mut sin) {
                (*a, *b) = (*a * c - *b * s, *b * c + *a * s);
            }
        }
    }

    /// Takes the waves of the sum of two angles.
    pub(super) fn combine(&mut self, a: &Self, b: &Self) {
        let (a, b) = (a.cos.iter().zip(&a.sin), b.cos.iter().zip(&b.sin));
        let out = self.cos.iter_mut().zip(&mut self.sin);
        for ((cos, sin), ((c, s), (other_c, other_s))) in out.zip(a.zip(b)) {
            (*cos, *sin) = (c * other_c - s * other_s, s * other_c + c * other_s);
        }
    }
}

/// Returns the entries from k on.
pub(super) fn chunk(values: &[f64], k: usize) -> [f64; LANES] {
    let mut out = [0.0; LANES];
    out.copy_from_slice(&values[k..k + LANES]);
    out
}

/// Returns the sum of products.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; LANES];
    let (a, b) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    for (a, b) in a.zip(b) {
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += a * b;
        }
    }
    sums.iter().sum()
}

/// A series of cosines and one of sines in t from 0 to pi, coefficient k at the wave k.
#[derive(Debug, Clone, Default)]
pub(super) struct Pair {
    pub(super) cos: Vec<f64>,
    pub(super) sin: Vec<f64>,
}

impl Pair {
    pub(super) fn new(waves: usize) -> Self {
        let zeros = vec![0.0; waves.next_multiple_of(LANES)];
        Self { cos: zeros.clone(), sin: zeros }
    }
}

/// Place on a meridian and slopes of the position by the parameter (length).
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Point {
    pub(super) place: Vec2,
    pub(super) tangent: Vec2,
}

impl Point {
    /// Returns the outward normal times |X_t| (length), for a meridian that runs from the largest x to the least.
    pub(super) fn normal(&self) -> Vec2 {
        -self.tangent.perp()
    }
}
