//! Moments of sources for the three solutions of each wave, and the flow of multiples of these.

use num_complex::Complex64;

use super::wall::Answer;
use super::waves::{FUNCTIONS, Sums};

/// Moments for the three solutions.
pub(super) type Moments = [Complex64; 3];
/// Multiples of each function, by component and phase.
pub(super) type Factors = [[[f64; FUNCTIONS]; 2]; 3];
/// No flow.
pub(super) const NO_FLOW: Factors = [[[0.0; FUNCTIONS]; 2]; 3];

const I: Complex64 = Complex64::new(0.0, 1.0);

/// The functions of one order: psi, or X.
#[derive(Clone, Copy)]
enum Kind {
    Psi,
    X,
}

/// Components: f_x - i f_y, f_x + i f_y, f_z.
#[derive(Clone, Copy)]
enum Part {
    Minus,
    Plus,
    Along,
}

/// Waves even along the axis, whose transverse parts have `cos(k z)`, or odd ones.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Parity(pub(super) usize);

impl Parity {
    pub(super) const BOTH: [Self; 2] = [Self(0), Self(1)];

    /// Returns place and sign of the phase of transverse parts, or of parts along the axis: its derivative over k.
    fn phase(self, derived: bool) -> (usize, f64) {
        match (self.0, derived) {
            (0, false) => (0, 1.0),
            (0, true) => (1, -1.0),
            (_, false) => (1, 1.0),
            (_, true) => (0, 1.0),
        }
    }
}

/// Sums of sources, over the values of the functions at the wall.
pub(super) struct Sources<'a> {
    pub(super) k: f64,
    pub(super) sums: &'a [Sums],
    pub(super) answers: &'a [Answer],
    /// True for stresslets, whose weights are xx, xy, xz, yy, yz, zz of `u n + n u`.
    pub(super) stresslets: bool,
}

impl Sources<'_> {
    /// Returns the sum over the functions of an order, which may be negative.
    fn sum(&self, kind: Kind, n: isize, weight: usize, (phase, sign): (usize, f64)) -> Complex64 {
        let [a, b, c, d] = self.sums[n.unsigned_abs()][weight][phase];
        let (psi, x) = (Complex64::new(a, b), Complex64::new(c, d));
        let value = match kind {
            Kind::Psi => psi,
            // X_(-n) = k r I_(n-1), and k r (I_(n-1) - I_(n+1)) = 2 n I_n.
            Kind::X if n < 0 => x - 2.0 * n as f64 * psi,
            Kind::X => x,
        };
        sign * if n < 0 { value.conj() } else { value }
    }

    /// Returns the moment of one component of a solution with the functions of order n.
    fn part(&self, kind: Kind, n: usize, part: Part, parity: Parity) -> Complex64 {
        let derived = matches!(part, Part::Along);
        if self.stresslets {
            return self.derivative(kind, n, part, parity, derived);
        }
        let phase = parity.phase(derived);
        let sum = |weight: usize| self.sum(kind, n as isize, weight, phase);
        match part {
            Part::Minus => sum(0) - I * sum(1),
            Part::Plus => sum(0) + I * sum(1),
            Part::Along => sum(2),
        }
    }

    /// Returns the moment of a stresslet: the derivative of a part along the other vector.
    fn derivative(&self, kind: Kind, n: usize, part: Part, parity: Parity, derived: bool) -> Complex64 {
        let (here, k) = (parity.phase(derived), self.k);
        let answer = &self.answers[n];
        let (upper, lower, n) = (answer.upper, answer.lower, n as isize);
        // Sums with the components of the tensor for this part and -, + and z.
        let minus = |kind: Kind, n: isize| {
            let sum = |weight: usize| self.sum(kind, n, weight, here);
            match part {
                Part::Minus => sum(0) - sum(3) - 2.0 * I * sum(1),
                Part::Plus => sum(0) + sum(3),
                Part::Along => sum(2) - I * sum(4),
            }
        };
        let plus = |kind: Kind, n: isize| {
            let sum = |weight: usize| self.sum(kind, n, weight, here);
            match part {
                Part::Minus => sum(0) + sum(3),
                Part::Plus => sum(0) - sum(3) + 2.0 * I * sum(1),
                Part::Along => sum(2) + I * sum(4),
            }
        };
        let along = {
            // The second derivative of a phase is -k^2 times it.
            let (phase, sign) = parity.phase(!derived);
            let sign = if derived { -sign } else { sign };
            let sum = |weight: usize| self.sum(kind, n, weight, (phase, sign));
            match part {
                Part::Minus => sum(2) - I * sum(4),
                Part::Plus => sum(2) + I * sum(4),
                Part::Along => sum(5),
            }
        };
        let half = 0.5 * k * (upper * minus(kind, n + 1) + lower * plus(kind, n - 1)) + k * along;
        match kind {
            Kind::Psi => half,
            Kind::X => half + k * upper * minus(Kind::Psi, n + 1),
        }
    }

    /// Returns minus the pressure of the third solution times `u.n`.
    fn pressure(&self, m: usize, parity: Parity) -> Complex64 {
        if !self.stresslets {
            return Complex64::ZERO;
        }
        let sum = |weight: usize| self.sum(Kind::Psi, m as isize, weight, parity.phase(false));
        self.k * self.k * (sum(0) + sum(3) + sum(5))
    }

    /// Returns the moments of order m.
    pub(super) fn moments(&self, m: usize, parity: Parity) -> Moments {
        let (k, Answer { lower, upper, .. }) = (self.k, &self.answers[m]);
        let part = |kind: Kind, n: usize, part: Part| self.part(kind, n, part, parity);
        let (psi, x) = (part(Kind::Psi, m, Part::Along), part(Kind::X, m, Part::Along));
        let right = upper * part(Kind::Psi, m + 1, Part::Minus);
        let right_x = upper * part(Kind::X, m + 1, Part::Minus);
        let pressure = self.pressure(m, parity);
        if m == 0 {
            let third = -k * (right_x.re + x.re) + pressure.re;
            return [(k * (right.re + psi.re)).into(), Complex64::new(0.0, -k * right.im), third.into()];
        }
        let left = lower * part(Kind::Psi, m - 1, Part::Plus);
        let left_x = lower * part(Kind::X, m - 1, Part::Plus);
        let third = k * (right - 0.5 * right_x - 0.5 * left_x - x) + pressure;
        [k * (left + psi), k * (right + psi), third]
    }
}

/// Adds the flow of multiples of the solutions of order m to the factors of orders m - 1, m and m + 1.
pub(super) fn add_solutions(
    k: f64,
    m: usize,
    parity: Parity,
    answer: &Answer,
    multiples: &Moments,
    factors: &mut [Factors],
) {
    let [first, second, third] = multiples.map(|multiple| k * multiple);
    let (lower, upper) = (answer.lower, answer.upper);
    if m == 0 {
        // Real parts of what belongs to the first and third solution, the imaginary one of the second.
        add(&mut factors[1], Kind::Psi, Part::Minus, parity, upper * (first.re - I * second.im));
        add(&mut factors[1], Kind::X, Part::Minus, parity, Complex64::from(-upper * third.re));
        add(&mut factors[0], Kind::Psi, Part::Along, parity, first.re.into());
        add(&mut factors[0], Kind::X, Part::Along, parity, (-third.re).into());
        return;
    }
    add(&mut factors[m - 1], Kind::Psi, Part::Plus, parity, lower * first);
    add(&mut factors[m - 1], Kind::X, Part::Plus, parity, -0.5 * lower * third);
    add(&mut factors[m + 1], Kind::Psi, Part::Minus, parity, upper * (second + third));
    add(&mut factors[m + 1], Kind::X, Part::Minus, parity, -0.5 * upper * third);
    add(&mut factors[m], Kind::Psi, Part::Along, parity, first + second);
    add(&mut factors[m], Kind::X, Part::Along, parity, -third);
}

/// Adds the real part of the conjugate of a part times a multiple.
fn add(factors: &mut Factors, kind: Kind, part: Part, parity: Parity, multiple: Complex64) {
    let (phase, sign) = parity.phase(matches!(part, Part::Along));
    let (re, im) = (sign * multiple.re, sign * multiple.im);
    let f = match kind {
        Kind::Psi => 0,
        Kind::X => 2,
    };
    let mut put = |component: usize, cos: f64, sin: f64| {
        let list = &mut factors[component][phase];
        list[f] += cos;
        list[f + 1] += sin;
    };
    match part {
        Part::Plus => {
            put(0, re, im);
            put(1, im, -re);
        }
        Part::Minus => {
            put(0, re, im);
            put(1, -im, re);
        }
        Part::Along => put(2, re, im),
    }
}
