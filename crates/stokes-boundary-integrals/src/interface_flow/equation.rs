//! The integral equation for the velocities on interfaces, over the mean viscosity of each, and its solution by GMRES.

use std::f64::consts::PI;

use crate::{
    LayerError, Settings,
    curve::Curve,
    density::Density,
    gmres::{Gmres, Outcome},
    layer::Layers,
    rigid_motion::RigidMotion,
};

use super::{interface::Inside, rigid::RigidWalls};

/// Least relative residual that is asked for: round-off of a sum over some nodes.
const ATTAINABLE: f64 = 1e-15;
/// Iterations beyond which the residual is computed instead of taken from the recurrence, whose basis loses its
/// orthogonality to round-off in longer cycles.
const TRUSTED: usize = 32;
/// Error of a product over the tolerance that counts as round-off when the residual is computed: products are sums of
/// about a hundred terms, each right to the tolerance.
const PRODUCTS: f64 = 100.0;
/// Largest relative residual that is asked for in place of a smaller one that turns out not to be attainable.
const LOOSEST: f64 = 1e-10;

/// Fraction of the tolerance that the sums and the residual may be off by for many interfaces: they bound a mean over
/// all, and where films are thin the error is larger (measured).
const MANY: f64 = 0.125;

const FOUR_PI: f64 = 4.0 * PI;

/// Interior and exterior of an interface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sides {
    inside: Inside,
    /// Viscosity outside (stress times time).
    pub(super) outside: f64,
}

impl Sides {
    pub(super) fn is_rigid(self) -> bool {
        self.inside == Inside::Rigid
    }

    /// Returns the viscosity inside; around a rigid body that outside.
    pub(super) fn viscosity(self) -> f64 {
        if let Inside::Fluid { viscosity } = self.inside { viscosity } else { self.outside }
    }

    /// Returns the factor of the velocity in the double layer, the viscosity inside less that outside. The density of a
    /// rigid body is the one of the completed equation over the viscosity outside.
    pub(super) fn contrast(self) -> f64 {
        if self.is_rigid() { self.outside } else { self.viscosity() - self.outside }
    }

    /// Returns the inverse of the mean viscosity, of half the viscosity outside for a rigid body.
    pub(super) fn mobility(self) -> f64 {
        2.0 / if self.is_rigid() { self.outside } else { self.viscosity() + self.outside }
    }
}

/// The equation for the present interfaces and the memory of its solution.
#[derive(Debug, Clone)]
pub(super) struct Equation {
    pub(super) sides: Vec<Sides>,
    /// [`Sides::contrast`] of each interface.
    pub(super) contrasts: Vec<f64>,
    pub(super) gmres: Gmres,
    right: Vec<f64>,
    /// Velocities last solved for, from which the next solution starts: at the nodes, x then y, interface after
    /// interface.
    pub(super) solution: Vec<f64>,
    /// Left-hand side for the last solution.
    image: Vec<f64>,
    /// Velocities of which rigid motions are multiplied by their factors.
    scaled: Vec<f64>,
}

impl Equation {
    pub(super) fn new() -> Self {
        let [right, solution, image, scaled] = Default::default();
        Self { sides: Vec::new(), contrasts: Vec::new(), gmres: Gmres::recycling(), right, solution, image, scaled }
    }

    pub(super) fn clear(&mut self) {
        self.sides.clear();
        self.contrasts.clear();
    }

    pub(super) fn push(&mut self, inside: Inside, outside: f64) {
        let sides = Sides { inside, outside };
        self.sides.push(sides);
        self.contrasts.push(sides.contrast());
    }

    /// Returns true if a viscosity differs or a body is rigid, so that there is something to iterate.
    pub(super) fn has_contrast(&self) -> bool {
        self.contrasts.iter().any(|contrast| *contrast != 0.0)
    }

    /// Returns the part of its largest value that a product is to be right to for each part of the tolerance of
    /// velocities, where the exterior fluid has that viscosity. A rigid motion is multiplied by eta_ext alone, one of
    /// several interfaces together by the exterior viscosity, so an error in it counts that much more.
    fn sensitivity(&self, viscosity: f64) -> f64 {
        let least = |sides: &Sides| sides.outside.min(viscosity) * sides.mobility();
        self.sides.iter().map(least).fold(1.0, f64::min)
    }

    /// Returns the tolerance of fast sums over the tolerance of velocities, a power of 2.
    pub(super) fn sharpness(&self, viscosity: f64) -> f64 {
        if self.has_contrast() { (MANY * self.sensitivity(viscosity)).log2().floor().exp2() } else { 1.0 }
    }

    /// Returns the right-hand side of zeros for so many nodes of each interface.
    pub(super) fn begin(&mut self, nodes: usize) {
        self.right.clear();
        self.right.resize(2 * nodes * self.sides.len(), 0.0);
    }

    /// Returns the right-hand side of each interface, x then y, with its [`Sides::mobility`].
    pub(super) fn right_sides(&mut self) -> impl Iterator<Item = (&mut [f64], f64)> {
        let len = self.right.len() / self.sides.len().max(1);
        self.right.chunks_exact_mut(len.max(1)).zip(self.sides.iter().map(|sides| sides.mobility()))
    }

    /// Adds the flow of the last layer to the right-hand side.
    pub(super) fn add_flow(&mut self, layers: &Layers) {
        for (index, (right, mobility)) in self.right_sides().enumerate() {
            layers.add_flow(index, mobility / FOUR_PI, right);
        }
    }

    /// Solves for the right-hand side, from the last solution or from the right-hand side as a guess; `viscosity` is
    /// the viscosity of the exterior fluid.
    pub(super) fn solve(
        &mut self,
        layers: &mut Layers,
        walls: Option<&mut RigidWalls>,
        settings: &Settings,
        viscosity: f64,
    ) -> Result<Outcome, LayerError> {
        let cold = !settings.warm_start || self.solution.len() != self.right.len();
        let contrast = self.has_contrast();
        if cold || !contrast {
            self.solution.clone_from(&self.right);
        }
        if !contrast {
            return Ok(Outcome::default());
        }
        if cold {
            self.gmres.forget();
        }
        self.iterate(layers, walls, settings, viscosity).inspect_err(|_| self.solution.clear())
    }

    fn iterate(
        &mut self,
        layers: &mut Layers,
        mut walls: Option<&mut RigidWalls>,
        &Settings { tolerance, most_iterations, .. }: &Settings,
        viscosity: f64,
    ) -> Result<Outcome, LayerError> {
        let many = if layers.sums_fast() { MANY } else { 1.0 };
        let mut goal = (many * tolerance * self.sensitivity(viscosity)).max(ATTAINABLE);
        let Self { sides, contrasts, gmres, right, solution, image, scaled } = self;
        let operator = Operator { sides, contrasts };
        // Of few interfaces the iteration finds the rigid motions by itself.
        let preconditioned = layers.sums_fast();
        let finest = if preconditioned { layers.sharpness * tolerance } else { tolerance };
        // In a film next to a rigid body the sides cancel but for a small part, which products must not lose at any
        // iteration.
        let rigid = sides.iter().any(|sides| sides.is_rigid());
        if preconditioned {
            operator.scale_motions(&layers.curves, solution, f64::recip);
        }
        let mut product = |v: &[f64], out: &mut [f64], accuracy: f64| {
            let mut v = v;
            if preconditioned {
                scaled.clear();
                scaled.extend_from_slice(v);
                operator.scale_motions(&layers.curves, scaled, |factor| factor);
                v = scaled;
            }
            let accuracy = if rigid { finest } else { accuracy.max(finest) };
            operator.apply(layers, walls.as_deref_mut(), v, accuracy, out);
        };
        let mut outcome = gmres.solve(&mut product, right, solution, goal, most_iterations);
        while outcome.iterations > TRUSTED {
            image.resize(right.len(), 0.0);
            product(solution, image, tolerance);
            let squares = image.iter().zip(right.iter()).zip(solution.iter());
            let [left, size, scale] = squares.fold([0.0; 3], |[left, size, scale], ((image, right), solution)| {
                [left + (image - right).powi(2), size + solution * solution, scale + right * right]
            });
            let residual = (left / scale).sqrt();
            if residual <= goal + PRODUCTS * tolerance * (size / scale).sqrt() {
                break;
            }
            if goal > LOOSEST || outcome.residual > goal {
                outcome.residual = residual;
                break;
            }
            goal *= 10.0;
            gmres.forget();
            solution.clone_from(right);
            let before = outcome.iterations;
            outcome = gmres.solve(&mut product, right, solution, goal, most_iterations);
            outcome.iterations += before;
        }
        if preconditioned {
            operator.scale_motions(&layers.curves, solution, |factor| factor);
        }
        let Outcome { iterations, residual } = outcome;
        if residual <= goal {
            Ok(outcome)
        } else {
            Err(LayerError::NoConvergence { iterations, residual, tolerance: goal })
        }
    }
}

/// Left-hand side of the equation.
pub(super) struct Operator<'a> {
    pub(super) sides: &'a [Sides],
    pub(super) contrasts: &'a [f64],
}

impl Operator<'_> {
    /// Multiplies the mean rigid motion of each interface by a function of the factor that undoes what the interface
    /// alone does to it, `(eta_in + eta_ext)/(2 eta_ext)`.
    ///
    /// As a preconditioner this is the inverse of each interface's own block, up to its deformation. The double layer
    /// of a circle on itself is zero apart from rigid motions, which the block multiplies by `2 eta_ext/(eta_in +
    /// eta_ext)`, and from uniform growth, for which there is [`growth`].
    fn scale_motions(&self, curves: &[Curve], values: &mut [f64], factor: impl Fn(f64) -> f64) {
        let len = values.len() / self.sides.len().max(1);
        for ((sides, curve), values) in self.sides.iter().zip(curves).zip(values.chunks_exact_mut(len.max(1))) {
            if !sides.is_rigid() {
                let own = 1.0 / (sides.outside * sides.mobility());
                RigidMotion::of(curve, values).add(curve, factor(own) - 1.0, values);
            }
        }
    }

    /// Returns the left-hand side for velocities v: `out = v + mobility/(4 pi) double layer`, the response of the walls
    /// to it, the growth term of [`growth`], and twice the mean motion of a rigid body.
    pub(super) fn apply(
        &self,
        layers: &mut Layers,
        walls: Option<&mut RigidWalls>,
        v: &[f64],
        accuracy: f64,
        out: &mut [f64],
    ) {
        let density = Density { values: v, contrasts: self.contrasts };
        let len = 2 * density.nodes();
        layers.double_layer(density, accuracy);
        out.copy_from_slice(v);
        let values = || v.chunks_exact(len).zip(self.sides).enumerate();
        for ((index, (v, sides)), out) in values().zip(out.chunks_exact_mut(len)) {
            layers.add_flow(index, sides.mobility() / FOUR_PI, out);
            let curve = &layers.curves[index];
            // Uniform growth is multiplied by eta_in alone.
            let lacking = 1.0 - sides.viscosity() * sides.mobility();
            if lacking > 0.0 {
                growth(curve, lacking, v, out);
            }
            if sides.is_rigid() {
                RigidMotion::of(curve, v).add(curve, 2.0, out);
            }
        }
        if let Some(walls) = walls {
            walls.respond(layers, layers.dipole_moment(density), false);
            for ((index, (_, sides)), out) in values().zip(out.chunks_exact_mut(len)) {
                layers.add_flow(index, sides.mobility() / FOUR_PI, out);
            }
        }
    }
}

/// Adds `lacking` times the mean of v.n along n: moves the eigenvalue of uniform growth, which incompressible flow does
/// not have, to the eigenvalue of the other motions.
pub(super) fn growth(curve: &Curve, lacking: f64, v: &[f64], out: &mut [f64]) {
    let (vx, vy) = v.split_at(curve.len());
    let (x, y) = out.split_at_mut(curve.len());
    let tangents = &curve.nodes.tangent;
    let [mut flux, mut length] = [0.0; 2];
    for (i, t) in tangents.iter().enumerate() {
        flux += vx[i] * t.im - vy[i] * t.re;
        length += t.norm_sqr().sqrt();
    }
    let mean = lacking * flux / length;
    for (i, t) in tangents.iter().enumerate() {
        let factor = mean / t.norm_sqr().sqrt();
        x[i] += factor * t.im;
        y[i] -= factor * t.re;
    }
}
