//! Tridiagonal systems for the streamfunction of a channel, one for each wave number of x.

use num_complex::Complex64;

use crate::transform::second_difference;

/// Influence of a wall on a row, relative to that nearby, below which it is left out: a ten-thousandth of round-off, so
/// that nothing changes. Skipping it saves half of the work in the middle of a wide channel.
const NEGLIGIBLE: f64 = 1e-20;

/// Tables and sweeps for the Dirichlet problems `(T - s) w = g`, `T psi = w` on rows 1..N of nodes, for each wave
/// number m of x, where
///
/// `(T psi)[j] = psi[j-1] - (2 + k^2) psi[j] + psi[j+1]`, `k = 2 sin(pi m / nx)`, `psi[0] = psi[N] = 0`,
///
/// s is the friction times h^2 over the viscosity, and the no-slip condition gives the wall values
/// `w[0] = 2 (psi[1] - U_bottom)` and `w[N] = 2 (psi[N-1] + U_top)` (lengths in cells). Along a wall with the slip
/// length b it is `1/(1 + 2 b)` of that.
///
/// The first problem is eliminated upwards and substituted downwards; in the same downward sweep the second one is
/// eliminated, to be substituted upwards. So the spectrum is passed three times, twice of them together with a
/// transform. The influence of the wall values on psi comes from a table.
#[derive(Debug, Clone)]
pub(crate) struct ChannelModes {
    ny: usize,
    width: usize,
    /// Reciprocal pivots of T from the bottom; those from the top are the same in reverse order.
    pivots: Vec<f64>,
    /// Those of T - s, where s is not zero.
    screened: Option<Vec<f64>>,
    /// Solution of T E = 0 with E = 1 at the bottom and 0 at the top.
    harmonic: Vec<f64>,
    /// Solution of T P = E' with P = 0 at both walls, where (T - s) E' = 0 with the values of E at the walls.
    influence: Vec<f64>,
    /// Number of wave numbers that a wall `d` rows away reaches: beyond, `pivots` equal `limits`, `harmonic` and
    /// `influence` are zero. All of them with friction.
    reach: Vec<usize>,
    /// Reciprocal pivots of T far from the walls.
    limits: Vec<f64>,
    /// Factors of the sum and of the difference of the two wall values.
    sum_factor: Vec<f64>,
    difference_factor: Vec<f64>,
    /// With slip the inverse of the symmetric matrix of the two wall values, in place of these factors: of the bottom,
    /// of both, of the top.
    slipping: Option<Vec<[f64; 3]>>,
    wall_bottom: Vec<Complex64>,
    wall_top: Vec<Complex64>,
    carried: Vec<Complex64>,
    near_top: Vec<Complex64>,
}

impl ChannelModes {
    /// Tables for a screening s and the slip lengths of the bottom and the top wall over the spacing.
    pub(crate) fn new(nx: usize, ny: usize, screening: f64, slip: [f64; 2]) -> Self {
        let width = nx / 2 + 1;
        let n = ny as f64;
        let mut modes = Self {
            ny,
            width,
            pivots: vec![0.0; width * (ny - 1)],
            screened: (screening > 0.0).then(|| vec![0.0; width * (ny - 1)]),
            harmonic: vec![0.0; width * (ny - 1)],
            influence: vec![0.0; width * (ny - 1)],
            reach: vec![0; ny],
            limits: vec![0.0; width],
            sum_factor: vec![0.0; width],
            difference_factor: vec![0.0; width],
            slipping: (slip != [0.0; 2]).then(|| vec![[0.0; 3]; width]),
            wall_bottom: vec![Complex64::ZERO; width],
            wall_top: vec![Complex64::ZERO; width],
            carried: vec![Complex64::ZERO; width],
            near_top: vec![Complex64::ZERO; width],
        };
        // The tables are zero for m = 0, whose flow is the mean flow.
        for m in 1..width {
            let k2 = second_difference(m, nx);
            // Solutions of T psi = 0 are sinh(j decay) and cosh(j decay).
            let decay = |k2: f64| 2.0 * (0.5 * k2.sqrt()).asinh();
            let (decay, screened) = (decay(k2), decay(k2 + screening));
            modes.limits[m] = -(-decay).exp();
            let at = |j: usize| (j - 1) * width + m;
            let pivot = |decay: f64, y: f64| {
                -(-decay).exp() * (-2.0 * y * decay).exp_m1() / (-2.0 * (y + 1.0) * decay).exp_m1()
            };
            let harmonic = |decay: f64, y: f64| {
                let harmonic = (-y * decay).exp() * (-2.0 * (n - y) * decay).exp_m1() / (-2.0 * n * decay).exp_m1();
                if harmonic < NEGLIGIBLE { 0.0 } else { harmonic }
            };
            let mut below = 0.0;
            for j in 1..ny {
                let y = j as f64;
                modes.pivots[at(j)] = pivot(decay, y);
                modes.harmonic[at(j)] = harmonic(decay, y);
                if let Some(pivots) = &mut modes.screened {
                    pivots[at(j)] = pivot(screened, y);
                }
                below = (harmonic(screened, y) - below) * modes.pivots[at(j)];
                modes.influence[at(j)] = below;
            }
            for j in (1..ny - 1).rev() {
                modes.influence[at(j)] -= modes.pivots[at(j)] * modes.influence[at(j + 1)];
            }
            for j in 1..ny {
                if modes.influence[at(j)].abs() < NEGLIGIBLE {
                    modes.influence[at(j)] = 0.0;
                }
                let at = at(j);
                if screening > 0.0
                    || modes.influence[at] != 0.0
                    || modes.harmonic[at] != 0.0
                    || modes.pivots[at] != modes.limits[m]
                {
                    modes.reach[j] = m + 1;
                }
            }
            let (near, far) = (modes.influence[at(1)], modes.influence[at(ny - 1)]);
            modes.sum_factor[m] = 1.0 / (0.5 - near - far);
            modes.difference_factor[m] = 1.0 / (0.5 - near + far);
            if let Some(slipping) = &mut modes.slipping {
                let [bottom, top] = slip.map(|slip| 0.5 + slip - near);
                let determinant = bottom * top - far * far;
                slipping[m] = [top, far, bottom].map(|entry| entry / determinant);
            }
        }
        modes
    }

    /// Reciprocal pivots of the first problem.
    fn first(&self) -> &[f64] {
        self.screened.as_ref().unwrap_or(&self.pivots)
    }

    fn row<'a>(&self, table: &'a [f64], j: usize) -> &'a [f64] {
        &table[(j - 1) * self.width..j * self.width]
    }

    /// Eliminates the first problem in row `j`, upwards; `below` is row `j - 1`, empty for the first.
    pub(crate) fn eliminate(&self, j: usize, below: &[Complex64], row: &mut [Complex64]) {
        let near = self.reach[j];
        if below.is_empty() {
            for (value, pivot) in row.iter_mut().zip(self.row(self.first(), j)) {
                *value *= *pivot;
            }
            return;
        }
        let (row_near, row_far) = row.split_at_mut(near);
        let (below_near, below_far) = below.split_at(near);
        for ((value, pivot), below) in row_near.iter_mut().zip(self.row(self.first(), j)).zip(below_near) {
            *value = (*value - below) * *pivot;
        }
        for ((value, pivot), below) in row_far.iter_mut().zip(&self.limits[near..]).zip(below_far) {
            *value = (*value - below) * *pivot;
        }
    }

    /// Substitutes the first problem and eliminates the second one, downwards, then computes the wall values for walls
    /// of velocities `bottom` and `top`.
    pub(crate) fn descend(&mut self, spectrum: &mut [Complex64], bottom: &[Complex64], top: &[Complex64]) {
        let (width, ny) = (self.width, self.ny);
        let mut carried = std::mem::take(&mut self.carried);
        let mut near_top = std::mem::take(&mut self.near_top);
        for zeros in [&mut carried, &mut near_top, &mut self.wall_top] {
            zeros.fill(Complex64::ZERO);
        }
        for j in (1..ny).rev() {
            let near = self.reach[j].max(self.reach[ny - j]);
            let (lower, upper) = spectrum.split_at_mut(j * width);
            let row = &mut lower[(j - 1) * width..];
            let sweep = Sweep {
                pivots: &self.row(self.first(), j)[..near],
                pivots_down: &self.row(&self.pivots, ny - j)[..near],
                harmonic: &self.row(&self.harmonic, ny - j)[..near],
                limits: &self.limits[near..],
            };
            // Above the first row there is none.
            let above = if j + 1 == ny { &self.wall_top } else { &upper[..width] };
            sweep.row(row, above, &mut carried, &mut near_top);
        }
        let near_bottom = &spectrum[..width];
        let matrices = self.slipping.iter().flatten();
        for (m, [on_bottom, on_both, on_top]) in matrices.enumerate() {
            let (below, above) = (near_bottom[m] - bottom[m], top[m] - near_top[m]);
            self.wall_bottom[m] = below * on_bottom + above * on_both;
            self.wall_top[m] = below * on_both + above * on_top;
        }
        for m in 0..if self.slipping.is_some() { 0 } else { width } {
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

    /// Substitutes the second problem in row `j`, upwards, and adds the influence of the walls, which gives the
    /// spectrum of psi.
    pub(crate) fn ascend(&mut self, j: usize, row: &mut [Complex64]) {
        let (near, far) = (self.reach[j].max(self.reach[self.ny - j]), self.width);
        let pivots = self.row(&self.pivots, self.ny - j);
        let from_top = &self.row(&self.influence, self.ny - j)[..near];
        let from_bottom = &self.row(&self.influence, j)[..near];
        let walls = self.wall_bottom[..near].iter().zip(from_bottom).zip(self.wall_top[..near].iter().zip(from_top));
        let mut carried = std::mem::take(&mut self.carried);
        let (carried_near, carried_far) = carried.split_at_mut(near);
        let (row_near, row_far) = row[..far].split_at_mut(near);
        for (((row, carried), pivot), ((bottom, by_bottom), (top, by_top))) in
            row_near.iter_mut().zip(carried_near).zip(&pivots[..near]).zip(walls)
        {
            let psi = *row - *carried * pivot;
            *carried = psi;
            *row = psi + bottom * by_bottom + top * by_top;
        }
        for ((row, carried), pivot) in row_far.iter_mut().zip(carried_far).zip(&self.limits[near..]) {
            *row -= *carried * pivot;
            *carried = *row;
        }
        self.carried = carried;
    }
}

/// Tables of one row in the downward sweep: for wave numbers that the walls reach, and limits for those beyond.
struct Sweep<'a> {
    pivots: &'a [f64],
    pivots_down: &'a [f64],
    harmonic: &'a [f64],
    limits: &'a [f64],
}

impl Sweep<'_> {
    /// Sweeps a row; `above` is the row above.
    fn row(&self, row: &mut [Complex64], above: &[Complex64], carried: &mut [Complex64], near_top: &mut [Complex64]) {
        let near = self.harmonic.len();
        let (row_near, row_far) = row.split_at_mut(near);
        let (carried_near, carried_far) = carried.split_at_mut(near);
        let (above_near, above_far) = above.split_at(near);
        let pivots = self.pivots.iter().zip(self.pivots_down);
        let top = near_top[..near].iter_mut().zip(self.harmonic);
        for ((((row, carried), above), (pivot, pivot_down)), (top, harmonic)) in
            row_near.iter_mut().zip(carried_near).zip(above_near).zip(pivots).zip(top)
        {
            let w = *row - *carried * pivot;
            *carried = w;
            *top += w * harmonic;
            *row = (w - above) * *pivot_down;
        }
        for (((row, carried), above), pivot) in row_far.iter_mut().zip(carried_far).zip(above_far).zip(self.limits) {
            let w = *row - *carried * pivot;
            *carried = w;
            *row = (w - above) * *pivot;
        }
    }
}
