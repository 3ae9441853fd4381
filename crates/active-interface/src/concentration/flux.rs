//! The concentration that a flux carries through a segment's end.

use serde::{Deserialize, Serialize};

/// How the concentration at a marker follows from that of the segments around it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Flux {
    /// The segment upstream (first order; smears the edge of the concentration).
    Upwind,
    /// Weighted essentially non-oscillatory reconstruction from five segments, two of them downstream: fifth order
    /// where the concentration is smooth, without oscillations where it is not (Jiang and Shu 1996, with the weights of
    /// Borges, Carmona, Costa and Don 2008).
    #[default]
    Weno5,
}

/// Value at the end between the third and the fourth of five cells of equal size, from their averages: the WENO-Z
/// scheme, upwinded towards the first cell.
///
/// With the three parabolas' values p_i, their smoothness indicators b_i and t = |b_0 - b_2|, the weights are
/// proportional to d_i (1 + (t / (b_i + e))^2), d = (1, 6, 3)/10. The small number e is 1e-12 of the mean square of the
/// five averages, so that the result scales with the data.
#[inline]
#[must_use]
pub(crate) fn weno5(v: [f64; 5]) -> f64 {
    let [a, b, c, d, e] = v;
    let p0 = (2.0 * a - 7.0 * b + 11.0 * c) / 6.0;
    let p1 = (-b + 5.0 * c + 2.0 * d) / 6.0;
    let p2 = (2.0 * c + 5.0 * d - e) / 6.0;
    let square = |x: f64| x * x;
    let b0 = 13.0 / 12.0 * square(a - 2.0 * b + c) + 0.25 * square(a - 4.0 * b + 3.0 * c);
    let b1 = 13.0 / 12.0 * square(b - 2.0 * c + d) + 0.25 * square(b - d);
    let b2 = 13.0 / 12.0 * square(c - 2.0 * d + e) + 0.25 * square(3.0 * c - 4.0 * d + e);
    let t = (b0 - b2).abs();
    let small = 2e-13 * (a * a + b * b + c * c + d * d + e * e) + f64::MIN_POSITIVE;
    let weight = |linear: f64, smoothness: f64| linear * (1.0 + square(t / (smoothness + small)));
    let (w0, w1, w2) = (weight(0.1, b0), weight(0.6, b1), weight(0.3, b2));
    (w0 * p0 + w1 * p1 + w2 * p2) / (w0 + w1 + w2)
}

#[cfg(test)]
mod tests;
