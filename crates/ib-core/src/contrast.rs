//! Interfaces between fluids of different viscosity on a grid: a dense double layer on their markers.

mod equivalent;
mod error;
mod field;
mod rigid;

use std::ops::Range;

use stokes_layers::Geometry;
use stokes_layers::dense::{DoubleLayerMatrix, NodeCurve};
pub(crate) use stokes_layers::gmres::Outcome;
use stokes_layers::gmres::{Gmres, dot};

pub(crate) use equivalent::EquivalentForces;
pub(crate) use field::Nearby;
use rigid::RigidModes;

use crate::{FlowError, MarkerKind, Markers, Vec2, checkpoint::SavedState};

/// Residual of the iterations relative to the right-hand side.
const TOLERANCE: f64 = 1e-6;
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
/// A stiff droplet answers to a rigid motion with the viscosity of its surroundings, to all else with the mean
/// viscosity. A small error of s along the corresponding left eigenvectors phi, `A^T phi = eta phi`, is therefore
/// amplified by the ratio of viscosities. Reciprocity tells what a droplet's own forces have there: their net force and
/// torque, which are zero. So phi is computed and that part of s is removed from the flow of the droplets' own forces,
/// while the flow of all other forces (solids, other interfaces, walls that move) keeps it.
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
    pub(crate) markers: Range<usize>,
    /// Whether its markers are equally spaced.
    pub(crate) even: bool,
}

/// The viscosity inside a group if it is an interface to another viscosity than that of the surroundings.
///
/// # Errors
/// A viscosity that is not positive and finite.
pub(crate) fn other_viscosity(kind: &MarkerKind, surroundings: f64) -> Result<Option<f64>, FlowError> {
    let (MarkerKind::Interface { viscosity_inside: Some(value) }
    | MarkerKind::UnevenInterface { viscosity_inside: Some(value) }) = *kind
    else {
        return Ok(None);
    };
    if !(value.is_finite() && value > 0.0) {
        let remedy = "give a positive finite viscosity, or none for that of the surroundings";
        return Err(FlowError::Parameter { name: "the viscosity inside an interface", value, remedy });
    }
    Ok((value != surroundings).then_some(value))
}

impl Contrast {
    /// For exterior fluid of the given viscosity in a box or a channel, whose `middle` is at that height; nodes closer
    /// to a wall than `least_gap` count as that far away.
    pub(crate) fn new(region: Geometry, middle: f64, viscosity: f64, least_gap: f64) -> Result<Self, FlowError> {
        Ok(Self {
            matrix: DoubleLayerMatrix::new(region, middle, viscosity, least_gap)?,
            viscosity,
            droplets: Vec::new(),
            curves: Vec::new(),
            nodes: 0,
            rigid: RigidModes::default(),
            solved: [0; 2],
            left: Vec::new(),
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
        let Ok([count, nodes, split]) = record.counts_of("droplets of another viscosity") else { return };
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

    /// Takes over the shapes of the droplets.
    pub(crate) fn load(&mut self, markers: &Markers) -> Result<(), FlowError> {
        self.targets.clear();
        self.droplets.clear();
        self.nodes = 0;
        for group in markers.groups() {
            let Some(viscosity) = other_viscosity(&group.kind, self.viscosity)? else {
                self.targets.extend(group.range.clone());
                continue;
            };
            let index = self.droplets.len();
            if index == self.curves.len() {
                self.curves.push(NodeCurve::default());
            }
            let curve = &mut self.curves[index];
            let positions = &markers.positions[group.range.clone()];
            curve.load(&self.matrix, self.nodes, viscosity - self.viscosity, positions)?;
            self.nodes += curve.len();
            let even = matches!(group.kind, MarkerKind::Interface { .. });
            self.droplets.push(Droplet { markers: group.range.clone(), even });
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

    /// Fills `velocities` at the nodes of the loaded droplets from the one-viscosity velocities there: `own` those of
    /// the droplets' forces, `other` those of all other forces.
    pub(crate) fn solve(&mut self, own: &[Vec2], other: &[Vec2], velocities: &mut [Vec2]) -> Result<Effort, FlowError> {
        let len = 2 * self.nodes;
        for array in [&mut self.own, &mut self.other, &mut self.right] {
            array.resize(len, 0.0);
        }
        for (stresses, velocities) in [(&mut self.own, own), (&mut self.other, other)] {
            let (x, y) = stresses.split_at_mut(self.nodes);
            for ((x, y), velocity) in x.iter_mut().zip(y).zip(velocities) {
                (*x, *y) = (self.viscosity * velocity.x, self.viscosity * velocity.y);
            }
        }
        self.matrix.build(&self.curves)?;
        self.rigid.fill(&self.curves, self.nodes);
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

    /// Left eigenvectors, then the velocities at the nodes.
    fn solve_nodes(&mut self) -> Result<Outcome, FlowError> {
        let Self { matrix, curves, nodes, rigid, left, gmres, own, other, right, velocities, .. } = self;
        let (curves, nodes, viscosity) = (curves.as_slice(), *nodes, self.viscosity);
        let len = 2 * nodes;
        let mut iterations = 0;

        let weighted = || rigid.weighted(nodes);
        if left.is_empty() {
            weighted().for_each(|motion| left.extend_from_slice(motion));
        }
        for (index, column) in left.chunks_exact_mut(len).enumerate() {
            right.copy_from_slice(weighted().nth(index).unwrap_or_default());
            let product = |q: &[f64], out: &mut [f64], _: f64| {
                matrix.transposed_product(curves, q, out);
                // Half the contrast is about what the other eigenvalues lie above that of the rigid motions.
                for curve in curves {
                    let scale = 2.0 / curve.contrast;
                    for i in curve.entries(nodes) {
                        out[i] = scale * (out[i] - viscosity * q[i]);
                    }
                }
                for (motion, weighted) in rigid.motions(nodes).zip(rigid.weighted(nodes)) {
                    let amount = dot(motion, q);
                    for (out, weighted) in out.iter_mut().zip(weighted) {
                        *out += amount * weighted;
                    }
                }
            };
            let outcome = gmres.solve(product, right, column, TOLERANCE, MOST_ITERATIONS);
            iterations += check("the rigid motions of droplets of another viscosity", outcome)?.iterations;
        }

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
                let scale = 1.0 / (viscosity + 0.5 * curve.contrast);
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
        for (motion, left) in rigid.motions(nodes).zip(left.chunks_exact(len)) {
            let amount = dot(left, other) / viscosity;
            for (value, motion) in velocities.iter_mut().zip(motion) {
                *value += amount * motion;
            }
        }
        Ok(Outcome { iterations: iterations + outcome.iterations, residual: outcome.residual })
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
