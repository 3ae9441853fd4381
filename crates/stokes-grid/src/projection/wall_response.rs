//! Flow of one wave number along a channel whose walls move: the response of the velocity to its walls.

/// Response to the two walls of a channel at one wave number, in units of the cell.
///
/// For the decay lambda, `2 cosh(lambda) - 2 = k^2`, and N cells, the difference equations have solutions in closed
/// form. `harmonic` is the intermediate velocity between walls of which the lower one has the value 1 and the upper one
/// 0. `velocity` is the x velocity of the Stokes flow between walls of which the lower one moves with the velocity 1.
/// Mirrored rows belong to the other wall.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct WallResponse {
    pub(crate) harmonic: Vec<f64>,
    pub(crate) velocity: Vec<f64>,
    /// Velocities of the walls per intermediate velocity there, for equal and for opposite values on both.
    pub(crate) slip: [f64; 2],
}

impl WallResponse {
    /// Creates the response for minus the symbol of the second difference along x, `k2 > 0`, and `n` cells across.
    pub(crate) fn new(k2: f64, n: usize) -> Self {
        let mode = Mode::new(k2, n);
        let halves = (0..n).map(|j| mode.at(j));
        let (harmonic, velocity) = halves.map(|[even, odd]| (0.5 * (even.0 + odd.0), 0.5 * (even.1 + odd.1))).unzip();
        Self { harmonic, velocity, slip: mode.slip }
    }
}

/// Constants of a wave number.
struct Mode {
    decay: f64,
    cells: f64,
    /// `tanh(lambda / 2)` and `1 / cosh(lambda / 2)`.
    tanh: f64,
    sech: f64,
    slip: [f64; 2],
}

/// Intermediate velocity and velocity in a row.
type Row = (f64, f64);

impl Mode {
    fn new(k2: f64, n: usize) -> Self {
        let decay = 2.0 * (0.5 * k2.sqrt()).asinh();
        let (cells, tanh) = (n as f64, (0.5 * decay).tanh());
        let ratio = 2.0 * tanh * cells * csch(decay * cells);
        // 1 - ratio without cancellation, from the two factors of it, each of which is near one for long waves.
        let short = tanh_defect(decay);
        let rest = short + (1.0 - short) * sinh_defect(decay * cells);
        let slip = [0.5 * (tanh * tanh + rest), 0.5 * (1.0 + tanh * tanh + ratio)];
        Self { decay, cells, tanh, sech: 1.0 / (0.5 * decay).cosh(), slip }
    }

    /// Returns the rows for equal walls and for opposite ones, the lower of which has the value 1.
    fn at(&self, j: usize) -> [Row; 2] {
        let below = j as f64 + 0.5;
        let distance = below.min(self.cells - below);
        let side = if below <= 0.5 * self.cells { 1.0 } else { -1.0 };
        let [even, odd] = [self.even(distance), self.odd(distance)];
        [even, (side * odd.0, side * odd.1)]
    }

    /// Returns the equal walls, at a distance from the nearer one.
    fn even(&self, distance: f64) -> Row {
        let (half, x) = (0.5 * self.cells, 0.5 * self.cells - distance);
        let (cosh, sinh) = over_cosh(self.decay, x, half);
        let slope = if self.decay * self.cells < 1.0 {
            x * self.tanh * sinh - 0.5 * cosh * self.coth_excess(half)
        } else {
            0.5 * cosh - self.tanh * (distance * sinh + self.far(distance))
        };
        (self.sech * cosh, self.sech * slope / self.slip[0])
    }

    /// Returns the opposite walls, at a distance from the nearer one.
    fn odd(&self, distance: f64) -> Row {
        let (half, x) = (0.5 * self.cells, 0.5 * self.cells - distance);
        let (cosh, sinh) = over_sinh(self.decay, x, half);
        let slope = 0.5 * sinh - self.tanh * (distance * cosh - self.far(distance));
        (self.sech * sinh, self.sech * slope / self.slip[1])
    }

    /// Returns `N cosh(lambda d) / sinh(lambda N)`: what the other wall adds.
    fn far(&self, distance: f64) -> f64 {
        self.cells * over_sinh(self.decay, distance, self.cells).0
    }

    /// Returns `2 X tanh(lambda/2) coth(lambda X) - 1` for long waves.
    fn coth_excess(&self, half: f64) -> f64 {
        let z = self.decay * half;
        let coth = coth_defect(z);
        coth - tanh_defect(self.decay) * (1.0 + coth)
    }
}

/// Returns `1 / sinh(z)`, zero if that underflows.
fn csch(z: f64) -> f64 {
    -2.0 * (-z).exp() / (-2.0 * z).exp_m1()
}

/// Returns `cosh(decay a) / cosh(decay b)` and `sinh(decay a) / cosh(decay b)` for 0 <= a <= b.
fn over_cosh(decay: f64, a: f64, b: f64) -> (f64, f64) {
    scaled(decay, a, b, 1.0 + (-2.0 * decay * b).exp())
}

/// Returns `cosh(decay a) / sinh(decay b)` and `sinh(decay a) / sinh(decay b)` for 0 <= a <= b.
fn over_sinh(decay: f64, a: f64, b: f64) -> (f64, f64) {
    scaled(decay, a, b, -(-2.0 * decay * b).exp_m1())
}

/// Returns `cosh(decay a)` and `sinh(decay a)` over `divisor exp(decay b) / 2`; the difference of a and b is taken
/// first, so that large exponents do not round.
fn scaled(decay: f64, a: f64, b: f64, divisor: f64) -> (f64, f64) {
    let scale = (decay * (a - b)).exp() / divisor;
    (scale * (1.0 + (-2.0 * decay * a).exp()), -scale * (-2.0 * decay * a).exp_m1())
}

/// Returns `1 - tanh(z / 2) / (z / 2)`.
fn tanh_defect(z: f64) -> f64 {
    // Of cosh and sinh, since 1 - tanh(y) / y = (y cosh(y) - sinh(y)) / (y cosh(y)).
    let y = 0.5 * z;
    y * y * cosh_minus_sinh(y) / y.cosh()
}

/// Returns `1 - z / sinh(z)`.
fn sinh_defect(z: f64) -> f64 {
    if z > 2.0 {
        return 1.0 - z * csch(z);
    }
    // sinh(z) / z - 1, term by term.
    let excess = series(z * z, |k| 2.0 * k * (2.0 * k + 1.0));
    excess / (1.0 + excess)
}

/// Returns `z coth(z) - 1`.
fn coth_defect(z: f64) -> f64 {
    z * z * z * cosh_minus_sinh(z) / z.sinh()
}

/// Returns `(cosh(z) - sinh(z) / z) / z^2`.
fn cosh_minus_sinh(z: f64) -> f64 {
    if z > 1.0 {
        return (z.cosh() - z.sinh() / z) / (z * z);
    }
    // The sum over k of z^(2 k) / ((2 k + 3) (2 k + 1)!).
    (1.0 + series(z * z, |k| 2.0 * k * (2.0 * k + 3.0))) / 3.0
}

/// Terms of the series in use, far more than arguments up to 2 need.
const TERMS: u32 = 16;

/// Returns the sum over k = 1, 2, ... of terms whose ratio to the one before is `x / divisor(k)`, the zeroth being one.
fn series(x: f64, divisor: impl Fn(f64) -> f64) -> f64 {
    let (mut term, mut sum) = (1.0, 0.0);
    for k in 1..TERMS {
        term *= x / divisor(f64::from(k));
        sum += term;
    }
    sum
}

#[cfg(test)]
mod tests;
