//! Velocities on fixed shapes against boundary-integral values.

use std::f64::consts::TAU;

use motile::active_interface::Curve;
use motile::base::Vec2;
use motile::ib_core::{ImmersedBoundary, Kernel};
use motile::scene::{Hydrodynamics, MarkerKind, Markers};
use motile::stokes_grid::{Grid, PeriodicStokes, StokesSolver};

use crate::validation::{Reference, StudyError};

/// A shape and a tension on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Case {
    /// The unit circle with gamma = 1 + 0.5 cos t.
    Circle,
    /// The ellipse (1.3 cos t, sin t / 1.3) with gamma = 1.
    EllipseUniform,
    /// Ellipse with gamma = 1 + 0.5 cos t.
    EllipseGradient,
}

impl Case {
    /// All cases.
    pub const ALL: [Self; 3] = [Self::Circle, Self::EllipseUniform, Self::EllipseGradient];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Circle => "circle, 1 + 0.5 cos",
            Self::EllipseUniform => "ellipse, 1",
            Self::EllipseGradient => "ellipse, 1 + 0.5 cos",
        }
    }

    fn axis(self) -> f64 {
        if self == Self::Circle { 1.0 } else { 1.3 }
    }

    fn tension(self, t: f64) -> f64 {
        if self == Self::EllipseUniform { 1.0 } else { 1.0 + 0.5 * t.cos() }
    }

    fn reference(self) -> Result<Reference, StudyError> {
        let all = Reference::read("fixed_shape_velocities_equal_viscosity")?;
        Ok(self.select(all).select("L", "6").select("kind", "marker"))
    }

    /// The rows of a table that belong to the case.
    pub fn select(self, table: Reference) -> Reference {
        let shape = if self == Self::Circle { "circle" } else { "ellipse" };
        let gamma = if self == Self::EllipseUniform { "const1" } else { "1+0.5cos" };
        table.select("shape", shape).select("gamma", gamma)
    }
}

/// Errors of the marker velocities at the eight reference points, relative to the largest velocity there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// Largest.
    pub maximum: f64,
    /// Root mean square.
    pub rms: f64,
}

/// The errors with grid spacing `h` in a 6 x 6 box, markers h/2 apart, viscosity 1.
///
/// # Errors
/// A spacing that does not divide the box, and what a setup can fail with.
pub fn errors<K: Kernel>(kernel: &K, corrected: bool, h: f64, case: Case) -> Result<Errors, StudyError> {
    let cells = (6.0 / h).round() as usize;
    let solver = PeriodicStokes::new(Grid::periodic(cells, cells, h)?, 1.0)?;
    Ok(compare(&mut couple(solver, kernel, corrected), h, case)?.0)
}

/// The errors of any flow in a 6 x 6 box of viscosity 1, markers h/2 apart, and the markers.
///
/// # Errors
/// Those of an evaluation.
pub fn compare<H: Hydrodynamics>(flow: &mut H, h: f64, case: Case) -> Result<(Errors, Markers), StudyError> {
    let mut shape = Shape::new(case, 0.0, h)?;
    flow.velocities(&mut shape.markers)?;
    Ok((shape.compare(&case.reference()?)?, shape.markers))
}

/// The errors of velocities at the eight points of the reference, equally spaced in the parameter t.
///
/// # Errors
/// Reference values that are not readable.
pub fn compare_velocities(velocities: &[Vec2], case: Case) -> Result<Errors, StudyError> {
    errors_of(&case.reference()?, |j| velocities.get(j).copied().unwrap_or_default())
}

/// The immersed boundary method with or without the mobility correction.
pub fn couple<S: StokesSolver, K: Kernel>(solver: S, kernel: &K, corrected: bool) -> ImmersedBoundary<S, K> {
    if corrected {
        ImmersedBoundary::new(solver, kernel.clone())
    } else {
        ImmersedBoundary::uncorrected(solver, kernel.clone())
    }
}

/// Markers on a shape of the reference table, with the forces of its tension.
#[derive(Debug)]
pub struct Shape {
    /// The markers.
    pub markers: Markers,
    case: Case,
    height: f64,
}

impl Shape {
    /// The shape with its centre at the height `height`, markers h/2 apart, another viscosity inside if there is one.
    ///
    /// # Errors
    /// A spacing that leaves too few markers.
    pub fn new(case: Case, height: f64, h: f64) -> Result<Self, StudyError> {
        let a = case.axis();
        let curve = if case == Case::Circle { Curve::circle(1.0)? } else { Curve::ellipse(a, 1.0 / a)? };
        let curve = curve.translated(Vec2::new(0.0, height));
        // A multiple of eight puts markers on the reference points of the circle.
        let count = 8 * (curve.perimeter() / (4.0 * h)).round() as usize;
        let mut markers = Markers::new();
        markers.push_group(count, MarkerKind::Interface { viscosity_inside: None });
        markers.positions_mut().copy_from_slice(&curve.markers(count)?);
        let mut shape = Self { markers, case, height };
        for k in 0..count {
            let (here, next) = (shape.markers.positions()[k], shape.markers.positions()[(k + 1) % count]);
            let pull = case.tension(shape.parameter(0.5 * (here + next))) * (next - here).normalize();
            shape.markers.forces_mut()[k] += pull;
            shape.markers.forces_mut()[(k + 1) % count] -= pull;
        }
        Ok(shape)
    }

    fn parameter(&self, point: Vec2) -> f64 {
        let a = self.case.axis();
        ((point.y - self.height) * a).atan2(point.x / a).rem_euclid(TAU)
    }

    /// Errors at the eight markers of `reference`.
    ///
    /// # Errors
    /// Reference values without these columns.
    pub fn compare(&self, reference: &Reference) -> Result<Errors, StudyError> {
        let parameters: Vec<f64> = self.markers.positions().iter().map(|&point| self.parameter(point)).collect();
        errors_of(reference, |j| at_parameter(&parameters, self.markers.velocities(), TAU * j as f64 / 8.0))
    }
}

/// Errors of the velocities at the eight markers of `reference`.
fn errors_of(reference: &Reference, velocity: impl Fn(usize) -> Vec2) -> Result<Errors, StudyError> {
    let (vx, vy) = (reference.column("vx")?, reference.column("vy")?);
    let largest = vx.iter().zip(&vy).map(|(x, y)| x.hypot(*y)).fold(0.0, f64::max);
    let (mut maximum, mut sum) = (0.0_f64, 0.0);
    for (j, (vx, vy)) in vx.iter().zip(&vy).enumerate() {
        let error = (velocity(j) - Vec2::new(*vx, *vy)).length() / largest;
        maximum = maximum.max(error);
        sum += error * error / 8.0;
    }
    Ok(Errors { maximum, rms: sum.sqrt() })
}

/// Velocity at the parameter `t`, by cubic interpolation in the parameters of the markers around it.
fn at_parameter(parameters: &[f64], velocities: &[Vec2], t: f64) -> Vec2 {
    let count = parameters.len();
    let offset = |k: usize| (parameters[k % count] - t + 0.5 * TAU).rem_euclid(TAU) - 0.5 * TAU;
    let nearest = (0..count).min_by(|&a, &b| offset(a).abs().total_cmp(&offset(b).abs())).unwrap_or(0);
    let first = if offset(nearest) > 0.0 { nearest + count - 2 } else { nearest + count - 1 };
    let mut sum = Vec2::ZERO;
    for i in 0..4 {
        let mut weight = 1.0;
        for j in 0..4 {
            if i != j {
                weight *= -offset(first + j) / (offset(first + i) - offset(first + j));
            }
        }
        sum += weight * velocities[(first + i) % count];
    }
    sum
}
