//! Growth rates and modes of small disturbances of a steady state.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use crate::SteadyError;
use crate::modes::Part;
use crate::system::{Point, System};

/// Symmetry of a disturbance under the mirror image at the x axis, of a state that is its own mirror image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Symmetry {
    /// It is its own mirror image: the droplet stays on its straight path.
    Symmetric,
    /// It changes its sign: the droplet turns or drifts aside.
    Antisymmetric,
    /// The state itself is not symmetric.
    None,
}

impl Symmetry {
    pub(crate) fn part(self) -> Part {
        match self {
            Self::Symmetric => Part::Even,
            Self::Antisymmetric => Part::Odd,
            Self::None => Part::Full,
        }
    }

    /// Its name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Symmetric => "symmetric",
            Self::Antisymmetric => "antisymmetric",
            Self::None => "none",
        }
    }
}

/// An eigenvalue of the linearised equations and its mode.
#[derive(Debug, Clone, PartialEq)]
pub struct Eigenmode {
    /// Growth rate (real part) and angular frequency (imaginary part, not negative), both 1/time.
    pub value: Complex64,
    /// Its symmetry.
    pub symmetry: Symmetry,
}

impl Eigenmode {
    /// One, or two for a conjugate pair.
    pub(crate) fn multiplicity(&self) -> usize {
        if self.value.im == 0.0 { 1 } else { 2 }
    }
}

/// Eigenvalues of disturbances that keep area and number of particles, largest growth rate first, one of each
/// conjugate pair. Rigid motions that change nothing are left out of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrum {
    /// The eigenvalues.
    pub modes: Vec<Eigenmode>,
    /// Largest growth rate (1/time) of a rigid motion, which should have none: an error estimate.
    pub neutral: f64,
    /// Growth rates below this (1/time) are none: round-off.
    pub zero: f64,
}

/// Growth rates below this part of D/R^2 are none.
pub(crate) const NO_GROWTH: f64 = 1e-8;

impl Spectrum {
    /// The mode that grows fastest.
    #[must_use]
    pub fn leading(&self) -> Option<&Eigenmode> {
        self.modes.first()
    }

    /// Number of growing disturbances, conjugate pairs counting twice.
    #[must_use]
    pub fn unstable(&self) -> usize {
        self.modes.iter().filter(|mode| mode.value.re > self.zero).map(Eigenmode::multiplicity).sum()
    }

    /// Those of a symmetry.
    pub fn of(&self, symmetry: Symmetry) -> impl Iterator<Item = Complex64> + '_ {
        self.modes.iter().filter(move |mode| mode.symmetry == symmetry).map(|mode| mode.value)
    }
}

/// The shape of an eigenmode, as complex amplitudes at the nodes of its steady state: the disturbance is the real part
/// of the amplitude times exp(value t). Its largest Fourier coefficient is 1 (in units of the radius or of c0).
#[derive(Debug, Clone, PartialEq)]
pub struct ModeShape {
    /// Offsets along the outward normal (length).
    pub offsets: Vec<Complex64>,
    /// Changes of the concentration at the nodes (particles per length).
    pub concentrations: Vec<Complex64>,
}

/// A part of the linearised equations, without what is conserved and without rigid motions.
pub(crate) struct Reduced {
    pub(crate) matrix: DMatrix<f64>,
    /// Orthonormal columns: disturbances from those that are left.
    pub(crate) basis: DMatrix<f64>,
    neutral: f64,
}

/// Orthonormal columns that span what is at right angles to some vectors, by Householder reflections.
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
    /// Linearises about a steady state.
    pub(crate) fn reduced(&mut self, point: &Point, part: Part) -> Result<Reduced, SteadyError> {
        let jacobian = self.jacobian(point, part)?;
        self.load(point)?;
        let (_, generators) = self.generators(&point.base, part)?;
        let conserved = self.conserved_gradients(&point.base, part)?;
        // Rigid motions are taken to one another, turns to shifts in particular, but none to itself.
        let neutral = if generators.is_empty() {
            0.0
        } else {
            let motions = DMatrix::from_columns(&generators);
            let inverse = (motions.transpose() * &motions).try_inverse();
            let parts = inverse.map(|inverse| inverse * motions.transpose() * &jacobian * &motions);
            parts.map_or(f64::NAN, |parts| parts.diagonal().amax())
        };
        let conserved = conserved.into_iter().filter(|gradient| gradient.norm() > 1e-6);
        let removed: Vec<DVector<f64>> = conserved.chain(generators).collect();
        let n = jacobian.nrows();
        // Disturbances that are orthogonal to all of them: for the conserved the equations take these to themselves,
        // rigid motions are taken to zero, so that the eigenvalues are those of the rest.
        let basis = complement(&removed, n);
        Ok(Reduced { matrix: basis.transpose() * jacobian * &basis, basis, neutral })
    }

    /// All eigenvalues about a steady state; `mirror` says that it is its own mirror image.
    pub(crate) fn spectrum(&mut self, point: &Point, mirror: bool) -> Result<Spectrum, SteadyError> {
        let parts: &[(Part, Symmetry)] = if mirror {
            &[(Part::Even, Symmetry::Symmetric), (Part::Odd, Symmetry::Antisymmetric)]
        } else {
            &[(Part::Full, Symmetry::None)]
        };
        let (mut modes, mut neutral) = (Vec::new(), 0.0_f64);
        for &(part, symmetry) in parts {
            let reduced = self.reduced(point, part)?;
            neutral = neutral.max(reduced.neutral);
            let values = eigenvalues(&reduced.matrix)?;
            modes.extend(values.into_iter().filter(|z| z.im >= 0.0).map(|value| Eigenmode { value, symmetry }));
        }
        modes.sort_by(|a, b| b.value.re.total_cmp(&a.value.re));
        let zero = NO_GROWTH * self.model.diffusion_rate();
        Ok(Spectrum { modes, neutral, zero })
    }
}

/// Size of the disturbance for the change of the concentration.
const SMALL: f64 = 1e-5;

impl System {
    /// The shape of a mode.
    pub(crate) fn mode_shape(&mut self, point: &Point, mode: &Eigenmode) -> Result<ModeShape, SteadyError> {
        let part = mode.symmetry.part();
        let Reduced { matrix, basis, .. } = self.reduced(point, part)?;
        let (_, vector) = eigenvector(&matrix, mode.value)?;
        let state = basis.map(|v| Complex64::new(v, 0.0)) * vector;
        let largest = state.iter().copied().fold(Complex64::ZERO, |a, b| if b.norm() > a.norm() { b } else { a });
        let range = self.modes.part(part);
        let [real, imaginary] = [0, 1].map(|which| {
            let mut full = DVector::zeros(self.modes.len());
            for (k, value) in state.iter().enumerate() {
                let value = value / largest;
                full[range.start + k] = if which == 0 { value.re } else { value.im };
            }
            full
        });
        let mut change = |state: &DVector<f64>| -> Result<(Vec<f64>, Vec<f64>), SteadyError> {
            let mut sides = Vec::new();
            for amount in [SMALL, -SMALL] {
                self.load(&Point { state: &point.state + amount * state, ..point.clone() })?;
                sides.push(self.model.concentrations.clone());
            }
            let change = sides[0].iter().zip(&sides[1]).map(|(above, below)| (above - below) / (2.0 * SMALL)).collect();
            let mut offsets = self.modes.synthesise(state).0;
            offsets.truncate(self.modes.nodes());
            Ok((offsets, change))
        };
        let ((h, c), (h_imaginary, c_imaginary)) = (change(&real)?, change(&imaginary)?);
        let complex = |re: &[f64], im: &[f64]| re.iter().zip(im).map(|(re, im)| Complex64::new(*re, *im)).collect();
        Ok(ModeShape { offsets: complex(&h, &h_imaginary), concentrations: complex(&c, &c_imaginary) })
    }
}

/// Iterations of the Schur decomposition.
const MOST_ITERATIONS: usize = 100_000;

/// Eigenvalues of a real matrix.
pub(crate) fn eigenvalues(matrix: &DMatrix<f64>) -> Result<Vec<Complex64>, SteadyError> {
    let failed = SteadyError::Singular { what: "the eigenvalues", remedy: "use another number of nodes" };
    let schur = nalgebra::Schur::try_new(matrix.clone(), f64::EPSILON, MOST_ITERATIONS).ok_or(failed)?;
    Ok(schur.complex_eigenvalues().iter().map(|z| Complex64::new(z.re, z.im)).collect())
}

/// The eigenvector whose eigenvalue is near `value`, by inverse iteration, with the largest entry 1, and its
/// eigenvalue.
pub(crate) fn eigenvector(
    matrix: &DMatrix<f64>,
    value: Complex64,
) -> Result<(Complex64, DVector<Complex64>), SteadyError> {
    let n = matrix.nrows();
    let complex = matrix.map(|v| Complex64::new(v, 0.0));
    let shift = value + Complex64::new(1e-9, 1e-9) * value.norm().max(1e-3);
    let lu = (&complex - DMatrix::identity(n, n) * shift).lu();
    let mut vector = DVector::from_fn(n, |k, _| Complex64::new(1.0, 0.3 * k as f64 / n as f64));
    for _ in 0..4 {
        let failed = SteadyError::Singular { what: "a mode", remedy: "use another number of nodes" };
        vector = lu.solve(&vector).ok_or(failed)?;
        let largest = vector.iter().copied().fold(Complex64::ZERO, |a, b| if b.norm() > a.norm() { b } else { a });
        vector /= largest;
    }
    let image = &complex * &vector;
    Ok((vector.dotc(&image) / vector.dotc(&vector), vector))
}
