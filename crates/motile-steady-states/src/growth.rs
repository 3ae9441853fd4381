//! Change of a growth rate with a parameter.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use crate::SteadyError;
use crate::modes::Part;
use crate::response::{Linearised, Response, Tangent};
use crate::spectrum::{Eigenmode, complex};
use crate::stencil::Stencil;
use crate::system::{NO_EFFECT, Point, System};

/// Largest coefficient of a disturbance in differences, in units of the radius and the mean density.
const AMPLITUDE: f64 = 3e-3;
/// Step of the parameter in mixed differences, over the step in other total derivatives.
const LONGER: f64 = 3.0;

/// Disturbance of a steady state with its adjoint.
///
/// With the gradients q of the conserved quantities and the rigid motions g of the state, a disturbance v that grows at
/// the rate s, with the velocities w of the frame, solves
///
/// ```text
/// J v - g w + q c = s v,   g.v = 0,   q.v = 0
/// ```
///
/// where c vanishes up to the truncation of the series. This leaves out the rigid motions themselves. With the left
/// vector (l, a, b) of these equations, a change of state and parameters changes the rate by
/// `ds = (l.d(J v - g w) + l.dq c + a dg.v + b dq.v)/(l.v)`.
pub(crate) struct Disturbance {
    pub(crate) value: Complex64,
    /// True for a growth rate without a frequency.
    is_real: bool,
    part: Part,
    /// Coefficients and motion of the frame, real and imaginary part.
    right: [Tangent; 2],
    /// Coefficients v and l.
    vectors: [DVector<Complex64>; 2],
    /// Numbers a of the left vector.
    of_motions: Vec<Complex64>,
    /// Numbers c of the right vector and b of the left vector.
    of_conserved: Vec<[Complex64; 2]>,
}

/// Vectors that the equations of a disturbance are bordered by: the derivatives of the coefficients by rigid motions
/// (1/time), and of the conserved quantities by the coefficients, times the unit of rates.
struct Border {
    motions: Vec<[f64; 3]>,
    generators: Vec<DVector<f64>>,
    gradients: Vec<DVector<f64>>,
}

impl Border {
    /// Returns the vectors at a point, which it loads.
    fn of(system: &mut System, point: &Point, part: Part, unit: f64) -> Result<Self, SteadyError> {
        system.load(point)?;
        let (motions, generators) = system.generators(&point.base, part)?;
        let gradients = system.conserved_gradients(&point.base, part)?;
        let gradients = gradients.into_iter().filter(|gradient| gradient.norm() > NO_EFFECT);
        Ok(Self { motions, generators, gradients: gradients.map(|gradient| unit * gradient).collect() })
    }
}

impl Disturbance {
    /// Returns the disturbance of a state whose eigenvalue is nearest to the eigenvalue of a mode.
    pub(crate) fn new(system: &mut System, point: &Point, mode: &Eigenmode) -> Result<Self, SteadyError> {
        let part = mode.symmetry.part();
        let range = system.modes.part(part);
        system.check_spectrum()?;
        let jacobian = system.fine_jacobian(point, part)?;
        let unit = system.model.rate_unit();
        let Border { motions, generators, gradients } = Border::of(system, point, part, unit)?;
        let (n, frames) = (range.len(), motions.len());
        let size = n + frames + gradients.len();
        let mut matrix = DMatrix::zeros(size, size);
        matrix.view_mut((0, 0), (n, n)).copy_from(&jacobian);
        for (k, generator) in generators.iter().enumerate() {
            matrix.view_mut((0, n + k), (n, 1)).copy_from(&-generator);
            matrix.view_mut((n + k, 0), (1, n)).copy_from(&generator.transpose());
        }
        for (k, gradient) in gradients.iter().enumerate() {
            matrix.view_mut((0, n + frames + k), (n, 1)).copy_from(gradient);
            matrix.view_mut((n + frames + k, 0), (1, n)).copy_from(&gradient.transpose());
        }
        let (value, right) = nearest(&matrix, n, mode.value)?;
        let (_, left) = nearest(&matrix.transpose(), n, mode.value)?;
        let component = |of: fn(&Complex64) -> f64| {
            let mut state = DVector::zeros(system.modes.len());
            state.rows_mut(range.start, n).copy_from(&right.rows(0, n).map(|z| of(&z)));
            let mut frame = [0.0; 3];
            for (k, motion) in motions.iter().enumerate() {
                frame.iter_mut().zip(motion).for_each(|(total, part)| *total += part * of(&right[n + k]));
            }
            Tangent { state, frame }
        };
        let is_real = mode.value.im == 0.0;
        Ok(Self {
            value: if is_real { value.re.into() } else { value },
            is_real,
            part,
            right: [component(|z| z.re), component(|z| z.im)],
            vectors: [right.rows(0, n).into_owned(), left.rows(0, n).into_owned()],
            of_motions: (n..n + frames).map(|k| left[k]).collect(),
            of_conserved: (n + frames..size).map(|k| [right[k], left[k]]).collect(),
        })
    }

    /// Returns the number of parts that the eigenvalue has: the growth rate and, if it oscillates, the frequency.
    pub(crate) fn parts(&self) -> usize {
        if self.is_real { 1 } else { 2 }
    }

    /// Returns the total derivative of the eigenvalue by the parameter of a response (1/time over its unit).
    pub(crate) fn derivative(
        &self,
        linearised: &mut Linearised,
        response: &Response,
    ) -> Result<Complex64, SteadyError> {
        let (range, unit) = (linearised.system.modes.part(self.part), linearised.system.model.rate_unit());
        let (n, motions) = (range.len(), self.of_motions.len());
        let along = |system: &mut System, point: &Point, tangent: &Tangent| {
            let size = tangent.state.amax();
            if size == 0.0 {
                return Ok(DVector::zeros(n));
            }
            Stencil::CENTRAL.derivative(AMPLITUDE / size, |amount| {
                Ok(system.residual(&tangent.from(point, amount))?.rows(range.start, n).into_owned())
            })
        };
        let longer = Response { step: LONGER * response.step, ..response.clone() };
        let total = linearised.total(&longer, |_, system, point| {
            let mut all = Vec::with_capacity((2 + motions + self.of_conserved.len()) * n);
            for tangent in &self.right {
                all.extend(along(system, point, tangent)?.iter());
            }
            let Border { generators, gradients, .. } = Border::of(system, point, self.part, unit)?;
            generators.iter().chain(&gradients).for_each(|vector| all.extend(vector.iter()));
            Ok(DVector::from_vec(all))
        })?;
        if total.len() != (2 + motions + self.of_conserved.len()) * n {
            return Err(SteadyError::singular("the change of a mode", "Use another number of nodes"));
        }
        let total = total.map(Complex64::from);
        let [right, left] = &self.vectors;
        let block = |k: usize| total.rows(k * n, n);
        let mut change = left.dot(&block(0)) + Complex64::I * left.dot(&block(1));
        for (k, multiplier) in self.of_motions.iter().enumerate() {
            change += multiplier * right.dot(&block(2 + k));
        }
        for (k, [source, multiplier]) in self.of_conserved.iter().enumerate() {
            let gradient = block(2 + motions + k);
            change += source * left.dot(&gradient) + multiplier * right.dot(&gradient);
        }
        let change = change / left.dot(right);
        Ok(if self.is_real { change.re.into() } else { change })
    }
}

/// Returns the eigenvalue nearest to `value` of `A z = s B z`, where B is one for the first n unknowns and zero for the
/// others, and its vector with the largest of these entries 1, by inverse iteration.
fn nearest(matrix: &DMatrix<f64>, n: usize, value: Complex64) -> Result<(Complex64, DVector<Complex64>), SteadyError> {
    let (size, largest) = (matrix.nrows(), matrix.amax());
    let whole = complex(matrix);
    let shift = value + Complex64::new(1e-9, 1e-9) * value.norm().max(1e-6 * largest);
    let mut shifted = whole;
    for k in 0..n {
        shifted[(k, k)] -= shift;
    }
    let lu = shifted.lu();
    let mut vector = DVector::from_fn(size, |k, _| Complex64::new(1.0, 0.3 * k as f64 / size as f64));
    let mut found = value;
    for _ in 0..5 {
        vector.rows_mut(n, size - n).fill(Complex64::ZERO);
        let failed = || SteadyError::singular("a mode", "Use another number of nodes");
        let next = lu.solve(&vector).ok_or_else(failed)?;
        let first = next.rows(0, n);
        found = shift + vector.rows(0, n).dotc(&first).inv() * vector.rows(0, n).norm_squared();
        let place = (0..n).max_by(|a, b| first[*a].norm().total_cmp(&first[*b].norm())).unwrap_or(0);
        let largest = first[place];
        vector = next / largest;
    }
    Ok((found, vector))
}
