//! Interfaces between fluids of different viscosity on a grid: a dense double layer on their markers.

mod equivalent;
mod error;
mod field;
mod rigid;
mod stresslet;

use std::ops::Range;

use input_checks::positive;
use stokes_layers::Geometry;
use stokes_layers::dense::{DoubleLayerMatrix, NodeCurve};
pub(crate) use stokes_layers::gmres::Outcome;
use stokes_layers::gmres::{Gmres, dot};

pub(crate) use equivalent::EquivalentForces;
pub(crate) use field::Nearby;
use rigid::{RIGID, RigidModes};

use crate::{FlowError, MarkerKind, Markers, Vec2, checkpoint::SavedState, hydrodynamics::MarkerGroup};

/// Residual of the iterations relative to the right-hand side.
const TOLERANCE: f64 = 1e-6;
/// Net forces and torques relative to the sum of all forces that count as none.
const ROUND_OFF: f64 = 1e-12;
/// Iterations before giving up.
const MOST_ITERATIONS: usize = 400;

/// What the solution for the velocities needed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Effort {
    pub(crate) iterations: usize,
    pub(crate) residual: f64,
    /// Part of the mean pressure gradient along x that comes from the contrast (force per volume).
    pub(crate) pressure_gradient: f64,
}

/// Velocities on interfaces between different viscosities from the velocities that the same forces have in a fluid of
/// one viscosity (boundary integral equation of Pozrikidis, 1992, with the single layer from a grid):
///
/// `A v = s`, A the [`DoubleLayerMatrix`], s the one-viscosity velocity times viscosity.
///
/// A stiff droplet answers to a rigid motion with the viscosity of the exterior fluid, eta, to all else with the mean
/// viscosity. A small error of s along the corresponding left eigenvectors phi, `A^T phi = eta phi`, is therefore
/// amplified by the ratio of viscosities. As `K^T phi = 0`, the forces phi are those under which the droplets move
/// rigidly, at any viscosity inside: with `K S = S K^T`, S the single layer, `K S phi = 0`. Droplets' own forces F
/// consist of `R F`, the sum of phi times the net force or torque of F for each rigid motion, and of forces F - R F
/// without either, which by reciprocity have nothing along phi: `phi . S F = F . S phi`, S phi a rigid motion of each
/// droplet. What the flow of F - R F has there is the grid's error; it is divided by the mean viscosity, as the rest of
/// that flow is, where that is the larger one. So errors do not grow with the ratio and are continuous where it passes
/// through one.
#[derive(Debug, Clone)]
pub(crate) struct Contrast {
    matrix: DoubleLayerMatrix,
    viscosity: f64,
    droplets: Vec<Droplet>,
    /// The curves of the droplets.
    curves: Vec<NodeCurve>,
    nodes: usize,
    rigid: RigidModes,
    /// Droplets and nodes of the last solutions.
    solved: [usize; 2],
    /// Left eigenvectors, dual to the rigid motions.
    left: Vec<f64>,
    /// Contrasts of the curves, while others take their places.
    contrasts: Vec<f64>,
    gmres: Gmres,
    own: Vec<f64>,
    other: Vec<f64>,
    right: Vec<f64>,
    velocities: Vec<f64>,
    /// Markers that are not on a droplet of another viscosity.
    targets: Vec<usize>,
}

/// Which markers a droplet has.
#[derive(Debug, Clone)]
pub(crate) struct Droplet {
    /// The number of its group.
    pub(crate) group: usize,
    pub(crate) markers: Range<usize>,
    /// Whether its markers are equally spaced.
    pub(crate) even: bool,
}

/// The viscosities inside and outside of a group if it is an interface and one of them is not that of the exterior
/// fluid.
///
/// # Errors
/// A viscosity that is not positive and finite; a rigid body.
pub(crate) fn other_viscosities(group: &MarkerGroup, exterior: f64) -> Result<Option<[f64; 2]>, FlowError> {
    if group.kind == MarkerKind::Rigid {
        return Err(FlowError::Unsupported {
            what: "a rigid body that is coupled to a grid alone",
            remedy: "use boundary integrals, or layers beside elastic solids",
        });
    }
    if !group.kind.is_interface() {
        return Ok(None);
    }
    let [inside, outside] = group.viscosities(exterior);
    let inside = positive("the viscosity inside an interface", inside)?;
    Ok((inside != exterior || outside != exterior).then_some([inside, outside]))
}

impl Contrast {
    /// For exterior fluid of the given viscosity in a box or a channel, whose `middle` is at that height; nodes closer
    /// to a wall than `least_gap` count as that far away.
    pub(crate) fn new(geometry: Geometry, middle: f64, viscosity: f64, least_gap: f64) -> Result<Self, FlowError> {
        Ok(Self {
            matrix: DoubleLayerMatrix::new(geometry, middle, least_gap)?,
            viscosity,
            droplets: Vec::new(),
            curves: Vec::new(),
            nodes: 0,
            rigid: RigidModes::default(),
            solved: [0; 2],
            left: Vec::new(),
            contrasts: Vec::new(),
            gmres: Gmres::default(),
            own: Vec::new(),
            other: Vec::new(),
            right: Vec::new(),
            velocities: Vec::new(),
            targets: Vec::new(),
        })
    }

    /// The droplets of another viscosity.
    pub(crate) fn droplets(&self) -> &[Droplet] {
        &self.droplets
    }

    /// Their curves.
    pub(crate) fn curves(&self) -> &[NodeCurve] {
        &self.curves
    }

    /// The markers that are not on them.
    pub(crate) fn others(&self) -> &[usize] {
        &self.targets
    }

    /// The last solutions, from which the next ones start.
    pub(crate) fn save(&self) -> SavedState {
        let [count, nodes] = self.solved;
        let counts = [count, nodes, self.left.len()].map(|count| count as u64).to_vec();
        SavedState { reals: [self.left.as_slice(), &self.velocities].concat(), counts }
    }

    /// Takes back what [`Contrast::save`] wrote.
    pub(crate) fn restore(&mut self, record: &SavedState) {
        let Ok([count, nodes, split]) = record.counts_of() else { return };
        let split = usize::try_from(split).unwrap_or(usize::MAX);
        let (Some(left), Some(velocities)) = (record.reals.get(..split), record.reals.get(split..)) else { return };
        // Three rigid motions a droplet.
        let len = nodes.saturating_mul(2);
        let fits = |list: &[f64], columns: u64| list.is_empty() || list.len() as u64 == columns.saturating_mul(len);
        if fits(left, count.saturating_mul(3)) && fits(velocities, 1) {
            (self.left, self.velocities) = (left.to_vec(), velocities.to_vec());
            self.solved = [count as usize, nodes as usize];
        }
    }

    /// Takes over the shapes of the droplets; refuses those that lie in one another.
    pub(crate) fn load(&mut self, markers: &Markers) -> Result<(), FlowError> {
        self.targets.clear();
        self.droplets.clear();
        self.nodes = 0;
        for (number, group) in markers.groups().iter().enumerate() {
            let Some(viscosities) = other_viscosities(group, self.viscosity)? else {
                self.targets.extend(group.range.clone());
                continue;
            };
            if viscosities[1] != self.viscosity {
                return Err(FlowError::Unsupported {
                    what: "an interface inside a droplet of another viscosity, coupled to a grid alone",
                    remedy: "use boundary integrals, or layers as they are beside solids (ImmersedLayers)",
                });
            }
            let index = self.droplets.len();
            if index == self.curves.len() {
                self.curves.push(NodeCurve::default());
            }
            let curve = &mut self.curves[index];
            let positions = &markers.positions[group.range.clone()];
            curve.load(&self.matrix, self.nodes, viscosities, positions)?;
            self.nodes += curve.len();
            let even = matches!(group.kind, MarkerKind::Interface { .. });
            self.droplets.push(Droplet { group: number, markers: group.range.clone(), even });
        }
        self.curves.truncate(self.droplets.len());
        let now = [self.curves.len(), self.nodes];
        if now != self.solved {
            // The last solutions are no guesses for other nodes.
            self.left.clear();
            self.velocities.clear();
            self.solved = now;
        }
        Ok(())
    }

    /// Computes the matrix and the left eigenvectors for the loaded droplets; returns the number of iterations.
    pub(crate) fn prepare(&mut self) -> Result<usize, FlowError> {
        self.matrix.build(&self.curves)?;
        self.rigid.fill(&self.curves);
        let outcome = self.find_left();
        if outcome.is_err() {
            self.left.clear();
        }
        outcome
    }

    fn find_left(&mut self) -> Result<usize, FlowError> {
        let Self { matrix, curves, nodes, rigid, left, gmres, right, contrasts: given, .. } = self;
        let nodes = *nodes;
        right.resize(2 * nodes, 0.0);
        let mut iterations = 0;
        if left.is_empty() {
            rigid.weighted(nodes).for_each(|motion| left.extend_from_slice(motion));
        }
        // Any viscosities inside have these left eigenvectors.
        given.clear();
        given.extend(curves.iter().map(|curve| curve.contrast));
        curves.iter_mut().for_each(|curve| curve.contrast = 1.0);
        let mut failure = None;
        for (weighted, column) in rigid.weighted(nodes).zip(left.chunks_exact_mut((2 * nodes).max(1))) {
            right.copy_from_slice(weighted);
            // Other eigenvalues of K are about one half.
            let product = |q: &[f64], out: &mut [f64], _: f64| {
                matrix.transposed_product(curves, q, out);
                out.iter_mut().for_each(|out| *out *= 2.0);
                for (motion, weighted) in rigid.motions(nodes).zip(rigid.weighted(nodes)) {
                    let amount = dot(motion, q);
                    for (out, weighted) in out.iter_mut().zip(weighted) {
                        *out += amount * weighted;
                    }
                }
            };
            let outcome = gmres.solve(product, right, column, TOLERANCE, MOST_ITERATIONS);
            match check("the rigid motions of droplets of another viscosity", outcome) {
                Ok(outcome) => iterations += outcome.iterations,
                Err(error) => failure = Some(error),
            }
        }
        for (curve, contrast) in curves.iter_mut().zip(&*given) {
            curve.contrast = *contrast;
        }
        failure.map_or(Ok(()), Err)?;
        Ok(iterations)
    }

    /// Fills `rigid` with the part of the forces at the nodes that carries net forces and torques, R F. Returns whether
    /// there are any.
    pub(crate) fn rigid_part(&self, forces: &[Vec2], rigid: &mut [Vec2]) -> bool {
        rigid.fill(Vec2::ZERO);
        let mut found = false;
        let (total, nodes) = (forces.iter().map(|force| force.length()).sum::<f64>(), self.nodes);
        for (index, left) in self.left.chunks_exact((2 * nodes).max(1)).enumerate() {
            let amount = self.rigid.component(index, forces);
            let curve = &self.curves[index / RIGID];
            if amount.abs() * curve.perimeter().sqrt() <= ROUND_OFF * total {
                continue;
            }
            found = true;
            for (i, rigid) in rigid.iter_mut().enumerate() {
                *rigid += amount * Vec2::new(left[i], left[nodes + i]);
            }
        }
        found
    }

    /// Fills `velocities` at the nodes of the prepared droplets from the one-viscosity velocities there: of the
    /// droplets' forces F, of R F, and of all other forces.
    pub(crate) fn solve(&mut self, of: [&[Vec2]; 3], velocities: &mut [Vec2]) -> Result<Effort, FlowError> {
        let nodes = self.nodes;
        for array in [&mut self.own, &mut self.other] {
            array.resize(2 * nodes, 0.0);
        }
        for (i, ((all, rigid), other)) in of[0].iter().zip(of[1]).zip(of[2]).enumerate() {
            let (own, other) = (self.viscosity * (all - rigid), self.viscosity * (rigid + other));
            [self.own[i], self.own[nodes + i]] = [own.x, own.y];
            [self.other[i], self.other[nodes + i]] = [other.x, other.y];
        }
        let outcome = match self.solve_nodes() {
            Ok(outcome) => outcome,
            Err(error) => {
                self.left.clear();
                self.velocities.clear();
                return Err(error);
            }
        };
        let (x, y) = self.velocities.split_at(self.nodes);
        for ((velocity, x), y) in velocities.iter_mut().zip(x).zip(y) {
            *velocity = Vec2::new(*x, *y);
        }
        let pressure_gradient = self.matrix.pressure_gradient(&self.curves, &self.velocities);
        Ok(Effort { iterations: outcome.iterations, residual: outcome.residual, pressure_gradient })
    }

    fn solve_nodes(&mut self) -> Result<Outcome, FlowError> {
        let Self { matrix, curves, nodes, rigid, left, gmres, own, other, right, velocities, .. } = self;
        let (curves, nodes) = (curves.as_slice(), *nodes);
        let len = 2 * nodes;

        // Splits off the rigid part, which the exterior viscosity alone resists.
        let project = |values: &mut [f64]| {
            for (motion, left) in rigid.motions(nodes).zip(left.chunks_exact(len)) {
                let amount = dot(left, values);
                for (value, motion) in values.iter_mut().zip(motion) {
                    *value -= amount * motion;
                }
            }
        };
        for ((right, own), other) in right.iter_mut().zip(&*own).zip(&*other) {
            *right = own + other;
        }
        project(right);
        // Rows in units of the mean viscosity, so that thick and thin droplets count alike.
        let divide = |values: &mut [f64]| {
            for curve in curves {
                let scale = 1.0 / (curve.outside + 0.5 * curve.contrast);
                curve.entries(nodes).for_each(|i| values[i] *= scale);
            }
        };
        divide(right);
        if velocities.is_empty() {
            velocities.extend_from_slice(right);
        }
        project(velocities);
        let product = |v: &[f64], out: &mut [f64], _: f64| {
            matrix.product(curves, v, out);
            project(out);
            divide(out);
        };
        let outcome = gmres.solve(product, right, velocities, TOLERANCE, MOST_ITERATIONS);
        let outcome = check("the velocities of droplets of another viscosity", outcome)?;
        project(velocities);
        for (index, (motion, left)) in rigid.motions(nodes).zip(left.chunks_exact(len)).enumerate() {
            let NodeCurve { outside, contrast, .. } = curves[index / RIGID];
            let amount = dot(left, other) / outside + dot(left, own) / outside.max(outside + 0.5 * contrast);
            for (value, motion) in velocities.iter_mut().zip(motion) {
                *value += amount * motion;
            }
        }
        Ok(outcome)
    }
}

fn check(what: &'static str, outcome: Outcome) -> Result<Outcome, FlowError> {
    let Outcome { iterations, residual } = outcome;
    // Round-off is what is left of a right-hand side of zero.
    if residual <= 2.0 * TOLERANCE {
        Ok(outcome)
    } else {
        Err(FlowError::NoConvergence { what, iterations, residual, tolerance: TOLERANCE })
    }
}
