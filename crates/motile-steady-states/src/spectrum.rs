//! Linear stability of a steady state: growth rates and modes of small disturbances.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use crate::model::FrameMotion;
use crate::modes::Part;
use crate::system::{DIFFERENCE, NO_EFFECT, Point, System};
use crate::{Stability, SteadyError};

/// Symmetry of a disturbance under the mirror image at the x axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Symmetry {
    /// Disturbance that is its own mirror image: the droplet stays on its straight path.
    Symmetric,
    /// Disturbance that changes its sign: the droplet turns or drifts aside.
    Antisymmetric,
    /// Disturbance of a state that is not mirror-symmetric itself.
    None,
}

impl Symmetry {
    /// Returns the part of the state space that holds such disturbances.
    pub(crate) fn part(self) -> Part {
        match self {
            Self::Symmetric => Part::Even,
            Self::Antisymmetric => Part::Odd,
            Self::None => Part::Full,
        }
    }

    /// Returns the name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Symmetric => "symmetric",
            Self::Antisymmetric => "antisymmetric",
            Self::None => "none",
        }
    }
}

/// Eigenvalue of the linearised equations: a disturbance of the steady state that grows as exp(value t).
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Eigenmode {
    /// Growth rate (real part) and angular frequency (imaginary part, not negative), both 1/time.
    pub value: Complex64,
    /// Symmetry of the mode.
    pub symmetry: Symmetry,
}

impl Eigenmode {
    /// Returns the number of eigenvalues that this one stands for: two for a conjugate pair.
    pub(crate) fn multiplicity(&self) -> usize {
        if self.value.im == 0.0 { 1 } else { 2 }
    }
}

/// Spectrum of the linearised equations about a steady state, for disturbances that conserve area and particles.
///
/// Rigid motions under which the region is invariant (shifts along a channel, for example) are left out: they neither
/// grow nor decay.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Spectrum {
    /// Eigenvalues, largest growth rate first, one of each conjugate pair.
    pub modes: Vec<Eigenmode>,
    /// Error estimate (1/time): the largest growth rate of a rigid motion, which is zero up to the truncation of the
    /// series.
    pub neutral: f64,
    /// Growth rate (1/time) that counts as zero: round-off, 1e-8 D/R^2.
    pub zero: f64,
    /// Error estimate of the growth rates (1/time): the rate of rigid motions, or round-off if that is more.
    pub error: f64,
}

/// Growth rate over D/R^2 that counts as zero: the error of central differences, 1e-10, times the number of entries
/// that it comes from.
pub(crate) const NO_GROWTH: f64 = 1e-8;

impl Spectrum {
    /// Returns the mode that grows fastest or decays slowest; `None` if there are no modes.
    #[must_use]
    pub fn leading(&self) -> Option<&Eigenmode> {
        self.modes.first()
    }

    /// Returns the stability of the state, undecided if the largest growth rate is zero within its error. Disturbances
    /// that neither grow nor decay to round-off, such as shifts of a droplet at rest, have no part in it.
    #[must_use]
    pub fn stability(&self) -> Stability {
        self.stability_within(self.error)
    }

    /// Returns the stability of the state if growth rates are off by as much as `error` (1/time), at least by
    /// round-off.
    #[must_use]
    pub fn stability_within(&self, error: f64) -> Stability {
        let rates = self.modes.iter().filter(|mode| mode.value.norm() > self.zero).map(|mode| mode.value.re);
        let error = error.max(self.zero);
        rates.reduce(f64::max).map_or(Stability::Stable, |rate| Stability::of_rate(rate, error))
    }

    /// Returns the number of growing disturbances by their rates alone, conjugate pairs counted twice.
    /// [`Spectrum::stability`] is the verdict, which compares the rates with their error.
    #[must_use]
    pub fn unstable(&self) -> usize {
        self.modes.iter().filter(|mode| mode.value.re > self.zero).map(Eigenmode::multiplicity).sum()
    }

    /// Returns the eigenvalues of one symmetry (1/time), largest growth rate first.
    pub fn of(&self, symmetry: Symmetry) -> impl Iterator<Item = Complex64> + '_ {
        self.modes.iter().filter(move |mode| mode.symmetry == symmetry).map(|mode| mode.value)
    }
}

/// Shape of an eigenmode as complex amplitudes A at the nodes of its steady state: the disturbance is
/// Re(A exp(value t)). Its largest Fourier coefficient is 1, in units of the radius or of the mean density.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ModeShape {
    /// Displacements along the outward normal (length).
    pub offsets: Vec<Complex64>,
    /// Changes of concentration at the nodes (particles per length).
    pub concentrations: Vec<Complex64>,
}

/// Linearised equations of one symmetry, restricted to disturbances that conserve area and particles and are at right
/// angles to rigid motions.
pub(crate) struct Reduced {
    pub(crate) matrix: DMatrix<f64>,
    /// Orthonormal columns that span these disturbances.
    basis: DMatrix<f64>,
    /// Largest growth rate of a rigid motion (1/time).
    neutral: f64,
}

/// Returns the orthonormal columns that span the orthogonal complement of some vectors, by Householder reflections.
pub(crate) fn complement(vectors: &[DVector<f64>], n: usize) -> DMatrix<f64> {
    let mut q = DMatrix::identity(n, n);
    for (k, vector) in vectors.iter().enumerate() {
        let column = q.transpose() * vector;
        let tail = column.rows(k, n - k);
        let mut reflector = tail.into_owned();
        reflector[0] += tail[0].signum() * tail.norm();
        let norm = reflector.norm();
        if norm == 0.0 {
            continue;
        }
        reflector /= norm;
        let mut right = q.columns_mut(k, n - k);
        let product = &right * &reflector;
        right -= 2.0 * product * reflector.transpose();
    }
    q.columns(vectors.len(), n - vectors.len()).into_owned()
}

impl System {
    /// Refuses states whose growth rates are not known.
    pub(crate) fn check_spectrum(&self) -> Result<(), SteadyError> {
        if self.model.has_field() {
            return Err(SteadyError::unsupported(
                "growth rates are not computed if particles diffuse inside",
                "Leave out the diffusion constant inside, or measure the growth in a run",
            ));
        }
        Ok(())
    }

    /// Returns the linearised equations about a steady state.
    pub(crate) fn reduced(&mut self, point: &Point, part: Part) -> Result<Reduced, SteadyError> {
        self.check_spectrum()?;
        let jacobian = self.jacobian(point, part)?;
        self.load(point)?;
        let (motions_of, generators) = self.generators(&point.base, part)?;
        let conserved = self.conserved_gradients(&point.base, part)?;
        // The equations take rigid motions to one another, turns to shifts in particular, but none to itself.
        let neutral = if generators.is_empty() {
            0.0
        } else {
            let motions = DMatrix::from_columns(&generators);
            let inverse = (motions.transpose() * &motions).try_inverse();
            let parts = inverse.map(|inverse| inverse * motions.transpose() * &jacobian * &motions);
            // A shift in a linear flow moves apart as that flow has it.
            let [[ux, _], [_, vy]] = self.model.imposed().gradient;
            let own = |motion: &FrameMotion| match motion {
                [x, ..] if *x != 0.0 => ux,
                [_, y, _] if *y != 0.0 => vy,
                _ => 0.0,
            };
            let parts = parts.map(|parts| parts.diagonal());
            parts.map_or(f64::NAN, |parts| {
                parts.iter().zip(&motions_of).map(|(part, motion)| (part - own(motion)).abs()).fold(0.0, f64::max)
            })
        };
        let conserved = conserved.into_iter().filter(|gradient| gradient.norm() > NO_EFFECT);
        let n = jacobian.nrows();
        let waves = self.unseen_waves(part).into_iter().map(|k| DVector::from_fn(n, |row, _| f64::from(row == k)));
        let removed: Vec<DVector<f64>> = conserved.chain(generators).chain(waves).collect();
        // The equations keep disturbances that conserve area and particles, and take rigid motions to zero: the
        // eigenvalues of the orthogonal complement are all others.
        let basis = complement(&removed, n);
        Ok(Reduced { matrix: basis.transpose() * jacobian * &basis, basis, neutral })
    }

    /// Returns the indices, among the coefficients of the given symmetry, of the largest waves of the shape, whose
    /// stretching the nodes do not see. A cortex does not answer it rightly, so these waves would decay slowly or grow.
    ///
    /// In the plane, it is the last wave, because the flow that undoes its stretching has waves beyond the nodes. Of a
    /// body of revolution, the two largest waves together move the point at a pole alone, where rings have no area.
    fn unseen_waves(&self, part: Part) -> Vec<usize> {
        if !self.model.has_cortex() {
            return Vec::new();
        }
        let (range, largest) = (self.modes.part(part), self.modes.largest());
        let first = if self.model.is_axisymmetric() { largest - 1 } else { largest };
        let waves = (first..=largest).flat_map(|wave| [false, true].map(|sine| (sine, wave)));
        let places = waves.map(|(sine, wave)| self.modes.index(false, sine, wave)).filter(|k| range.contains(k));
        places.map(|k| k - range.start).collect()
    }

    /// Returns the eigenvalues of all disturbances of a state of the given part, by symmetry if it is mirror-symmetric.
    pub(crate) fn spectrum(&mut self, point: &Point, part: Part) -> Result<Spectrum, SteadyError> {
        let symmetries: &[Symmetry] = match part {
            // Of bodies of revolution only disturbances that leave them so are known.
            Part::Even if self.model.is_axisymmetric() => &[Symmetry::Symmetric],
            Part::Even => &[Symmetry::Symmetric, Symmetry::Antisymmetric],
            _ => &[Symmetry::None],
        };
        let (mut modes, mut neutral) = (Vec::new(), 0.0_f64);
        for &symmetry in symmetries {
            let reduced = self.reduced(point, symmetry.part())?;
            neutral = neutral.max(reduced.neutral);
            let values = eigenvalues(&reduced.matrix)?;
            modes.extend(values.into_iter().filter(|z| z.im >= 0.0).map(|value| Eigenmode { value, symmetry }));
        }
        modes.sort_by(|a, b| b.value.re.total_cmp(&a.value.re));
        let zero = NO_GROWTH * self.model.rate_unit();
        Ok(Spectrum { modes, neutral, zero, error: neutral.max(zero) })
    }
}

impl System {
    /// Returns the coefficients of a mode, as many as the state has.
    pub(crate) fn mode(&mut self, point: &Point, mode: &Eigenmode) -> Result<DVector<Complex64>, SteadyError> {
        let part = mode.symmetry.part();
        let Reduced { matrix, basis, .. } = self.reduced(point, part)?;
        let (_, vector) = eigenvector(&matrix, mode.value)?;
        let range = self.modes.part(part);
        let mut whole = DVector::zeros(self.modes.len());
        whole.rows_mut(range.start, range.len()).copy_from(&(complex(&basis) * vector));
        Ok(whole)
    }

    /// Returns the shape of a mode.
    pub(crate) fn mode_shape(&mut self, point: &Point, mode: &Eigenmode) -> Result<ModeShape, SteadyError> {
        let state = self.mode(point, mode)?;
        let state = &state / largest(&state);
        let mut change = |component: fn(&Complex64) -> f64| -> Result<(Vec<f64>, Vec<f64>), SteadyError> {
            let direction = state.map(|z| component(&z));
            let mut side = |amount: f64| {
                self.load(&Point { state: &point.state + amount * &direction, ..point.clone() })?;
                Ok::<_, SteadyError>(self.model.concentrations.clone())
            };
            let (above, below) = (side(DIFFERENCE)?, side(-DIFFERENCE)?);
            let change = above.iter().zip(&below).map(|(a, b)| (a - b) / (2.0 * DIFFERENCE)).collect();
            let mut offsets = self.modes.synthesise(&direction).0;
            offsets.truncate(self.modes.nodes());
            Ok((offsets, change))
        };
        let ((h, c), (h_imaginary, c_imaginary)) = (change(|z| z.re)?, change(|z| z.im)?);
        let complex = |re: &[f64], im: &[f64]| re.iter().zip(im).map(|(re, im)| Complex64::new(*re, *im)).collect();
        Ok(ModeShape { offsets: complex(&h, &h_imaginary), concentrations: complex(&c, &c_imaginary) })
    }
}

/// Returns the real matrix as a complex one.
pub(crate) fn complex(matrix: &DMatrix<f64>) -> DMatrix<Complex64> {
    matrix.map(|value| Complex64::new(value, 0.0))
}

/// Returns the entry of the largest modulus.
fn largest(vector: &DVector<Complex64>) -> Complex64 {
    vector.iter().copied().fold(Complex64::ZERO, |a, b| if b.norm() > a.norm() { b } else { a })
}

/// Iterations of the Schur decomposition: it takes two or three per row, at most a few thousand rows.
const MOST_SWEEPS: usize = 100_000;

/// Returns the eigenvalues of a real matrix.
pub(crate) fn eigenvalues(matrix: &DMatrix<f64>) -> Result<Vec<Complex64>, SteadyError> {
    let failed = || SteadyError::singular("the eigenvalues", "Use another number of nodes");
    let schur = nalgebra::Schur::try_new(matrix.clone(), f64::EPSILON, MOST_SWEEPS).ok_or_else(failed)?;
    Ok(schur.complex_eigenvalues().iter().map(|z| Complex64::new(z.re, z.im)).collect())
}

/// Returns the eigenvalue nearest to `value` and its eigenvector, with the largest entry 1, by inverse iteration.
pub(crate) fn eigenvector(
    matrix: &DMatrix<f64>,
    value: Complex64,
) -> Result<(Complex64, DVector<Complex64>), SteadyError> {
    let (n, largest_rate) = (matrix.nrows(), matrix.amax());
    let matrix = complex(matrix);
    // Beside the eigenvalue by about its error, so that the matrix is regular.
    let shift = value + Complex64::new(1e-9, 1e-9) * value.norm().max(1e-6 * largest_rate);
    let lu = (&matrix - DMatrix::identity(n, n) * shift).lu();
    let mut vector = DVector::from_fn(n, |k, _| Complex64::new(1.0, 0.3 * k as f64 / n as f64));
    for _ in 0..4 {
        let failed = || SteadyError::singular("a mode", "Use another number of nodes");
        vector = lu.solve(&vector).ok_or_else(failed)?;
        vector /= largest(&vector);
    }
    let image = &matrix * &vector;
    Ok((vector.dotc(&image) / vector.dotc(&vector), vector))
}

#[cfg(test)]
mod tests;
