//! The flow that the wall of a tube returns for each wave: no slip, exactly.
//!
//! In units of the radius, a wave `exp(i m phi + i k z)` has three regular solutions of Stokes' equations. With psi of
//! order n the function `I_n(k r) exp(i n phi + i k z)`, and X = k r I_(n+1) in place of I_n, their components along f
//! are (f+- = f_x +- i f_y)
//!
//! ```text
//! 1:  k f+ psi_(m-1) + i k f_z psi_m
//! 2:  k f- psi_(m+1) + i k f_z psi_m
//! 3:  k f- (psi_(m+1) - X_(m+1)/2) - k f+ X_(m-1)/2 - i k f_z X_m,   pressure -2 k^2 psi_m
//! ```
//!
//! These stay independent as k falls to zero. For m = 0, three others take their place: the half sum and the half
//! difference of the first two, and `2 grad psi - grad(r d psi/dr)` with the gradient across the axis first. By the
//! reciprocal theorem, the wall answers to a force f at y with the flow `-1/(4 pi^2) SUM INT dk v_s(x) M_st
//! conj(v_t(y)).f`, where `M = V^-1 L V^-T`. Here V has the solutions at the wall, and L turns tractions on the wall
//! into velocities. Its inverse is the traction inside less the traction outside.

use nalgebra::Matrix3;

use super::bessel::{ratios_of_i, ratios_of_k};

/// The answer of the wall to one wave.
#[derive(Debug, Clone, Copy)]
pub(super) struct Answer {
    /// The matrix M.
    pub(super) matrix: Matrix3<f64>,
    /// `I_(m-1)/I_m` and `I_(m+1)/I_m` at the wall.
    pub(super) lower: f64,
    pub(super) upper: f64,
}

/// Returns velocities and tractions of the three solutions at the wall, as columns of the components r, phi/i, z/i.
/// Takes the values of the functions of order m - 1 and m + 1, over the one of order m.
fn solutions(m: f64, k: f64, lower: f64, upper: f64) -> [Matrix3<f64>; 2] {
    let (low, up, square) = (k * lower, k * upper, k * k);
    let slope = up + m;
    let (low_slope, up_slope) = (square + (m - 1.0) * low, square - (m + 1.0) * up);
    let mean = 0.5 * square;
    let (p, p_slope) = ((m + 2.0) * up - mean, (m + 2.0) * up_slope - mean * (1.0 + slope));
    let velocities = [[low, low, k], [up, -up, k], [p - mean, -p - mean, -k * up]];
    let slopes = [
        [low_slope, low_slope, k * slope],
        [up_slope, -up_slope, k * slope],
        [p_slope - mean * (1.0 + slope), -p_slope - mean * (1.0 + slope), -k * (up + up_slope)],
    ];
    with_tractions(m, k, velocities, slopes)
}

/// Returns the same for m = 0, from the values of the functions of orders 1 and 2 over the one of order 0.
fn axisymmetric(k: f64, one: f64, two: f64) -> [Matrix3<f64>; 2] {
    let square = k * k;
    let velocities = [[k * one, 0.0, k], [0.0, k * one, 0.0], [-square * two, 0.0, -square * one]];
    let slope = square - k * one;
    let slopes = [[slope, 0.0, square * one], [0.0, slope, 0.0], [-square * (k * one - two), 0.0, -square * k]];
    with_tractions(0.0, k, velocities, slopes)
}

fn with_tractions(m: f64, k: f64, velocities: [[f64; 3]; 3], slopes: [[f64; 3]; 3]) -> [Matrix3<f64>; 2] {
    let pressures = [0.0, 0.0, -2.0 * k * k];
    let traction = |s: usize| {
        let ([a, b, _], [da, db, dc]) = (velocities[s], slopes[s]);
        [2.0 * da - pressures[s], m * a + db - b, k * a + dc]
    };
    let tractions = [0, 1, 2].map(traction);
    [Matrix3::from_fn(|i, s| velocities[s][i]), Matrix3::from_fn(|i, s| tractions[s][i])]
}

/// Returns the inverse of a matrix whose columns have any size.
fn inverse(matrix: Matrix3<f64>) -> Option<Matrix3<f64>> {
    let sizes = [0, 1, 2].map(|s| matrix.column(s).norm());
    let scaled = Matrix3::from_fn(|i, s| matrix[(i, s)] / sizes[s]).try_inverse()?;
    Some(Matrix3::from_fn(|s, i| scaled[(s, i)] / sizes[s]))
}

/// Returns the answers for m = 0 .. orders - 1 at the wave number k (in units of 1/radius).
pub(super) fn answers(k: f64, orders: usize) -> Option<Vec<Answer>> {
    let mut inner = vec![0.0; orders + 2];
    ratios_of_i(k, &mut inner);
    let outer = ratios_of_k(k, orders + 2);
    let answer = |m: usize| {
        let upper = inner[m];
        let (lower, [inside, outside]) = if m == 0 {
            let second = inner[0] * inner[1];
            (upper, [axisymmetric(k, upper, second), axisymmetric(k, -outer[0], outer[0] * outer[1])])
        } else {
            let lower = 1.0 / inner[m - 1];
            // (-1)^n K_n obeys the recurrences of I_n; the solutions of order -m are mirror images.
            let mirrored = solutions(-(m as f64), k, -outer[m], -1.0 / outer[m - 1]);
            let outside = mirrored.map(|mut matrix| {
                matrix.row_mut(1).neg_mut();
                matrix
            });
            (lower, [solutions(m as f64, k, lower, upper), outside])
        };
        let [velocities, tractions] = inside;
        let back = inverse(velocities)?;
        let stiffness = tractions * back - outside[1] * inverse(outside[0])?;
        let stiffness = 0.5 * (stiffness + stiffness.transpose());
        let matrix = back * inverse(stiffness)? * back.transpose();
        Some(Answer { matrix: 0.5 * (matrix + matrix.transpose()), lower, upper })
    };
    (0..orders).map(answer).collect()
}
