//! The tridiagonal systems of a channel's streamfunction.

use num_complex::Complex64;

use crate::symbol::second_difference;

/// Tables and sweeps for `T w = g`, `T psi = w` on rows 1..N of nodes, for each wave number m of x, where
///
/// `(T psi)[j] = psi[j-1] - (2 + k^2) psi[j] + psi[j+1]`, `k = 2 sin(pi m / nx)`, `psi[0] = psi[N] = 0`,
///
/// and the wall values of w are such that `w[0] = 2 (psi[1] - U_bottom)` and `w[N] = 2 (psi[N-1] + U_top)`, which is no slip.
/// (All lengths in cells, psi and U in the same units.)
///
/// The first problem is eliminated upwards and substituted downwards; the second one is eliminated downwards on the same way
/// and substituted upwards. So the spectrum is passed three times, and twice together with a transform. The influence of the
/// wall values on psi comes from a table.
#[derive(Debug, Clone)]
pub(crate) struct ChannelModes {
    ny: usize,
    width: usize,
    /// Reciprocal pivots of T from the bottom; those from the top are the same in reverse order.
    pivots: Vec<f64>,
    /// Solution of T E = 0 with E = 1 at the bottom and 0 at the top.
    harmonic: Vec<f64>,
    /// Solution of T P = E with P = 0 at both walls.
    influence: Vec<f64>,
    /// For the sum and the difference of the two wall values.
    sum_factor: Vec<f64>,
    difference_factor: Vec<f64>,
    wall_bottom: Vec<Complex64>,
    wall_top: Vec<Complex64>,
    carried: Vec<Complex64>,
    near_top: Vec<Complex64>,
}

impl ChannelModes {
    pub(crate) fn new(nx: usize, ny: usize) -> Self {
        let width = nx / 2 + 1;
        let n = ny as f64;
        let mut modes = Self {
            ny,
            width,
            pivots: vec![0.0; width * (ny - 1)],
            harmonic: vec![0.0; width * (ny - 1)],
            influence: vec![0.0; width * (ny - 1)],
            sum_factor: vec![0.0; width],
            difference_factor: vec![0.0; width],
            wall_bottom: vec![Complex64::ZERO; width],
            wall_top: vec![Complex64::ZERO; width],
            carried: vec![Complex64::ZERO; width],
            near_top: vec![Complex64::ZERO; width],
        };
        // The tables are zero for m = 0, whose flow is found otherwise.
        for m in 1..width {
            let k2 = second_difference(m, nx);
            // Solutions of T psi = 0 are sinh(j decay) and cosh(j decay).
            let decay = 2.0 * (0.5 * k2.sqrt()).asinh();
            let at = |j: usize| (j - 1) * width + m;
            for j in 1..ny {
                let y = j as f64;
                modes.pivots[at(j)] =
                    -(-decay).exp() * (-2.0 * y * decay).exp_m1() / (-2.0 * (y + 1.0) * decay).exp_m1();
                let harmonic = (-y * decay).exp() * (-2.0 * (n - y) * decay).exp_m1() / (-2.0 * n * decay).exp_m1();
                // What is too small to matter would only become subnormal, and slow.
                modes.harmonic[at(j)] = if harmonic < 1e-60 { 0.0 } else { harmonic };
            }
            let mut below = 0.0;
            for j in 1..ny {
                below = (modes.harmonic[at(j)] - below) * modes.pivots[at(j)];
                modes.influence[at(j)] = below;
            }
            for j in (1..ny - 1).rev() {
                modes.influence[at(j)] -= modes.pivots[at(j)] * modes.influence[at(j + 1)];
            }
            let (near, far) = (modes.influence[at(1)], modes.influence[at(ny - 1)]);
            modes.sum_factor[m] = 1.0 / (0.5 - near - far);
            modes.difference_factor[m] = 1.0 / (0.5 - near + far);
        }
        modes
    }

    fn row<'a>(&self, table: &'a [f64], j: usize) -> &'a [f64] {
        &table[(j - 1) * self.width..j * self.width]
    }

    /// Elimination of the first problem in row `j`, upwards; `below` is row `j - 1`, empty for the first.
    pub(crate) fn eliminate(&self, j: usize, below: &[Complex64], row: &mut [Complex64]) {
        let pivots = self.row(&self.pivots, j);
        if below.is_empty() {
            for (value, pivot) in row.iter_mut().zip(pivots) {
                *value *= *pivot;
            }
        } else {
            for ((value, pivot), below) in row.iter_mut().zip(pivots).zip(below) {
                *value = (*value - below) * *pivot;
            }
        }
    }

    /// Substitution of the first problem and elimination of the second one, downwards; then the wall values, for walls of
    /// velocities `bottom` and `top`.
    pub(crate) fn descend(&mut self, spectrum: &mut [Complex64], bottom: &[Complex64], top: &[Complex64]) {
        let (width, ny) = (self.width, self.ny);
        let mut carried = std::mem::take(&mut self.carried);
        let mut near_top = std::mem::take(&mut self.near_top);
        carried.fill(Complex64::ZERO);
        near_top.fill(Complex64::ZERO);
        for j in (1..ny).rev() {
            let pivots = self.row(&self.pivots, j);
            let (pivots_down, harmonic) = (self.row(&self.pivots, ny - j), self.row(&self.harmonic, ny - j));
            let (lower, upper) = spectrum.split_at_mut(j * width);
            let row = &mut lower[(j - 1) * width..];
            let sweep = Sweep { pivots, pivots_down, harmonic };
            if j + 1 == ny {
                sweep.first_row(row, &mut carried, &mut near_top);
            } else {
                sweep.row(row, &upper[..width], &mut carried, &mut near_top);
            }
        }
        let near_bottom = &spectrum[..width];
        for m in 0..width {
            // near_top has minus psi[N-1] without wall values, the first row has psi[1].
            let sum = (near_bottom[m] - near_top[m] - bottom[m] + top[m]) * self.sum_factor[m];
            let difference = (near_bottom[m] + near_top[m] - bottom[m] - top[m]) * self.difference_factor[m];
            self.wall_bottom[m] = (sum + difference) * 0.5;
            self.wall_top[m] = (sum - difference) * 0.5;
        }
        carried.fill(Complex64::ZERO);
        self.carried = carried;
        self.near_top = near_top;
    }

    /// Substitution of the second problem in row `j`, upwards, and the influence of the walls: gives the spectrum of psi.
    pub(crate) fn ascend(&mut self, j: usize, row: &mut [Complex64]) {
        let n = self.width;
        let start = (self.ny - j - 1) * n;
        let pivots = &self.pivots[start..start + n];
        let influence_top = &self.influence[start..start + n];
        let influence_bottom = &self.influence[(j - 1) * n..j * n];
        let (wall_bottom, wall_top) = (&self.wall_bottom[..n], &self.wall_top[..n]);
        let carried = &mut self.carried[..n];
        let row = &mut row[..n];
        for m in 0..n {
            let psi = row[m] - carried[m] * pivots[m];
            carried[m] = psi;
            row[m] = psi + wall_bottom[m] * influence_bottom[m] + wall_top[m] * influence_top[m];
        }
    }
}

/// The tables of one row on the way down.
struct Sweep<'a> {
    pivots: &'a [f64],
    pivots_down: &'a [f64],
    harmonic: &'a [f64],
}

impl Sweep<'_> {
    fn first_row(&self, row: &mut [Complex64], carried: &mut [Complex64], near_top: &mut [Complex64]) {
        for m in 0..row.len() {
            let w = row[m];
            carried[m] = w;
            near_top[m] = w * self.harmonic[m];
            row[m] = w * self.pivots_down[m];
        }
    }

    fn row(&self, row: &mut [Complex64], above: &[Complex64], carried: &mut [Complex64], near_top: &mut [Complex64]) {
        let n = row.len();
        let (above, carried, near_top) = (&above[..n], &mut carried[..n], &mut near_top[..n]);
        let (pivots, pivots_down, harmonic) = (&self.pivots[..n], &self.pivots_down[..n], &self.harmonic[..n]);
        for m in 0..n {
            let w = row[m] - carried[m] * pivots[m];
            carried[m] = w;
            near_top[m] += w * harmonic[m];
            row[m] = (w - above[m]) * pivots_down[m];
        }
    }
}
