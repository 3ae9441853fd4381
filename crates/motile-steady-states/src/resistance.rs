//! Forces of an interface that resists its own motion: cortex and friction.

use std::f64::consts::TAU;

use motile::active_interface::Cortex;
use motile::base::Region;
use motile_base::Vec2;
use nalgebra::{DMatrix, DVector, Dyn, LU};

use crate::SteadyError;

/// Most corrections of stresses with the same matrix.
const MOST: usize = 30;
/// Correction over the stresses that is round-off.
const ROUND_OFF: f64 = 1e-14;
/// Correction over the stresses that is taken for round-off of the flow if corrections no longer shrink.
const ACCEPTED: f64 = 1e-10;
/// Factor by which corrections shrink at least; if they do not, the matrix is too old, or what is left is round-off.
const CONTRACTION: f64 = 0.3;

/// Stresses of an interface that follow from its velocity v at the nodes.
///
/// The stresses g of a cortex and the friction per length are proportional to the rates of deformation Q v by a matrix
/// E, and the velocity follows from all forces, `v = V(F - P g)`. With M the response of V to forces they solve
///
/// ```text
/// (1 + E Q M P) g = E Q V(F),
/// ```
///
/// and friction in the plane, whose total has to vanish, moves all fluid at one more velocity that makes it so. These
/// are linear equations of as many unknowns as stresses. The matrix of an earlier state improves stresses of this one
/// until nothing is left; in derivatives it belongs to the state itself, so that one improvement is exact to first
/// order.
#[derive(Debug, Clone)]
pub(crate) struct Resistance {
    cortex: Cortex,
    friction: f64,
    nodes: usize,
    /// Bodies of revolution have two stresses of the cortex, along the meridian and around the axis.
    axisymmetric: bool,
    /// Stresses along (force, or force per length in three dimensions) and around at the nodes.
    pub(crate) along: Vec<f64>,
    pub(crate) around: Vec<f64>,
    /// Friction per length on the fluid with the other sign (force per length).
    drag: Vec<Vec2>,
    /// True if nothing takes up the total of the friction: it vanishes, at a velocity of all fluid (length per time).
    holds: bool,
    uniform: Vec2,
    /// Lengths that belong to the nodes (length).
    weights: Vec<f64>,
    /// Factors of the matrix, and velocities by stresses: x and y of the nodes, then of discs inside.
    factors: Option<LU<f64, Dyn, Dyn>>,
    by_stress: DMatrix<f64>,
    /// Only first-order changes count, about the state of the matrix.
    fixed: bool,
}

/// Rates of deformation of an interface.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Strain<'a> {
    /// Along the interface and around the axis (1/time).
    pub(crate) along: &'a [f64],
    pub(crate) around: &'a [f64],
    pub(crate) velocities: &'a [Vec2],
}

impl Resistance {
    /// Returns the resistance of an interface of so many nodes; `None` if there is none.
    pub(crate) fn new(cortex: Cortex, friction: f64, nodes: usize, region: &Region) -> Option<Self> {
        let axisymmetric = region.is_axisymmetric();
        (!cortex.is_none() || friction > 0.0).then(|| Self {
            cortex,
            friction,
            nodes,
            axisymmetric,
            along: vec![0.0; nodes],
            around: vec![0.0; if axisymmetric { nodes } else { 0 }],
            drag: vec![Vec2::ZERO; nodes],
            holds: friction > 0.0 && *region == Region::Plane,
            uniform: Vec2::ZERO,
            weights: vec![0.0; nodes],
            factors: None,
            by_stress: DMatrix::zeros(0, 0),
            fixed: false,
        })
    }

    /// Takes over stresses and matrix of a neighbouring state.
    pub(crate) fn adopt(&mut self, other: &Self) {
        if other.nodes == self.nodes && other.unknowns() == self.unknowns() {
            *self = Self { cortex: self.cortex, friction: self.friction, fixed: false, ..other.clone() };
        }
    }

    /// Returns the number of nodes of different stresses: on bodies of revolution without their mirror image.
    fn distinct(&self) -> usize {
        if self.axisymmetric { self.nodes / 2 + 1 } else { self.nodes }
    }

    pub(crate) fn has_cortex(&self) -> bool {
        !self.cortex.is_none()
    }

    /// Takes over the derivatives of a curve by the parameter.
    pub(crate) fn set_curve(&mut self, tangents: &[Vec2]) {
        let step = TAU / self.nodes as f64;
        self.weights.iter_mut().zip(tangents).for_each(|(weight, tangent)| *weight = step * tangent.length());
    }

    /// Returns the velocity of all fluid (length per time) at which the total of the friction vanishes.
    pub(crate) fn uniform(&self) -> Vec2 {
        self.uniform
    }

    /// Returns the numbers of unknowns of the cortex and of friction.
    fn counts(&self) -> [usize; 2] {
        let fields = if self.axisymmetric { 2 } else { 1 };
        [
            if self.has_cortex() { fields * self.distinct() } else { 0 },
            if self.friction > 0.0 { 2 * self.nodes } else { 0 },
        ]
    }

    /// Returns the number of stresses that are unknown.
    fn unknowns(&self) -> usize {
        self.counts().iter().sum()
    }

    pub(crate) fn fix(&mut self, fixed: bool) {
        self.fixed = fixed;
    }

    pub(crate) fn is_fixed(&self) -> bool {
        self.fixed
    }

    /// Returns the stresses that are proportional to the rates of deformation, less the present ones.
    fn residual(&self, strain: Strain<'_>, concentrations: &[f64]) -> DVector<f64> {
        let (distinct, [of_cortex, _]) = (self.distinct(), self.counts());
        let mut residual = self.stresses_of(strain, concentrations);
        for (k, value) in residual.iter_mut().enumerate() {
            *value -= match (k < of_cortex, k < distinct) {
                (true, true) => self.along[k],
                (true, false) => self.around[k - distinct],
                _ => {
                    let k = k - of_cortex;
                    let Vec2 { x, y } = self.drag[k % self.nodes];
                    if k < self.nodes { x } else { y }
                }
            };
        }
        if self.holds {
            // The friction of the uniform velocity, and a total of zero.
            let (nodes, first) = (self.nodes, residual.len() - 2 * self.nodes);
            for k in 0..nodes {
                residual[first + k] += self.friction * self.uniform.x;
                residual[first + nodes + k] += self.friction * self.uniform.y;
            }
            let total: Vec2 = self.drag.iter().zip(&self.weights).map(|(drag, weight)| *weight * *drag).sum();
            let mean = total / self.weights.iter().sum::<f64>();
            let last = residual.len();
            residual = residual.resize_vertically(last + 2, 0.0);
            (residual[last], residual[last + 1]) = (-mean.x, -mean.y);
        }
        residual
    }

    /// Returns the stresses E Q v.
    fn stresses_of(&self, strain: Strain<'_>, concentrations: &[f64]) -> DVector<f64> {
        let (distinct, mut stresses) = (self.distinct(), Vec::with_capacity(self.unknowns()));
        if self.has_cortex() {
            let viscosity = |k: usize| self.cortex.viscosity_at(concentrations[k]);
            if self.axisymmetric {
                let shear = self.cortex.shear_viscosity;
                for (own, other) in [(strain.along, strain.around), (strain.around, strain.along)] {
                    let stress = |k: usize| viscosity(k) * (own[k] + other[k]) + shear * (own[k] - other[k]);
                    stresses.extend((0..distinct).map(stress));
                }
            } else {
                stresses.extend((0..distinct).map(|k| viscosity(k) * strain.along[k]));
            }
        }
        if self.friction > 0.0 {
            stresses.extend(strain.velocities.iter().map(|v| self.friction * v.x));
            stresses.extend(strain.velocities.iter().map(|v| self.friction * v.y));
        }
        DVector::from_vec(stresses)
    }

    /// Sets one unknown to a value, all others to zero.
    pub(crate) fn set_one(&mut self, unknown: usize, value: f64) {
        let zeros = DVector::zeros(self.unknowns());
        self.clear();
        let mut one = zeros;
        one[unknown] = value;
        self.add(&one);
    }

    /// Sets all stresses to zero.
    pub(crate) fn clear(&mut self) {
        self.along.fill(0.0);
        self.around.fill(0.0);
        self.drag.fill(Vec2::ZERO);
    }

    /// Adds to the stresses.
    fn add(&mut self, correction: &DVector<f64>) {
        let (nodes, distinct, [of_cortex, _]) = (self.nodes, self.distinct(), self.counts());
        let unknowns = self.unknowns();
        for (k, value) in correction.iter().enumerate() {
            if k < of_cortex {
                let list = if k < distinct { &mut self.along } else { &mut self.around };
                let place = k % distinct;
                list[place] += value;
                if self.axisymmetric && place > 0 && 2 * place < nodes {
                    list[nodes - place] += value;
                }
            } else if k >= unknowns {
                *(if k == unknowns { &mut self.uniform.x } else { &mut self.uniform.y }) += value;
            } else {
                let k = k - of_cortex;
                let drag = &mut self.drag[k % nodes];
                *(if k < nodes { &mut drag.x } else { &mut drag.y }) += value;
            }
        }
    }

    /// Adds the friction to the forces on the fluid at the nodes (force).
    pub(crate) fn add_drag(&self, forces: &mut [Vec2]) {
        if self.friction > 0.0 {
            for ((force, drag), weight) in forces.iter_mut().zip(&self.drag).zip(&self.weights) {
                *force -= *weight * *drag;
            }
        }
    }

    /// Takes over the matrix of a state, by the rates of deformation and the velocities that each unknown of the size
    /// `unit` causes. The velocities of discs come after the nodes.
    pub(crate) fn renew(
        &mut self,
        concentrations: &[f64],
        unit: f64,
        mut response: impl FnMut(&mut Self, usize) -> Result<([Vec<f64>; 2], Vec<Vec2>), SteadyError>,
    ) -> Result<(), SteadyError> {
        let (count, kept) = (self.unknowns(), (self.along.clone(), self.around.clone(), self.drag.clone()));
        let [of_cortex, _] = self.counts();
        let size = count + if self.holds { 2 } else { 0 };
        let mut matrix = DMatrix::identity(size, size);
        self.by_stress = DMatrix::zeros(0, 0);
        for unknown in 0..count {
            let ([along, around], velocities) = response(self, unknown)?;
            let strain = Strain { along: &along, around: &around, velocities: &velocities[..self.nodes] };
            let column = self.stresses_of(strain, concentrations) / unit;
            let mut own = matrix.view_mut((0, unknown), (count, 1));
            own -= column;
            if self.by_stress.ncols() != count {
                self.by_stress = DMatrix::zeros(2 * velocities.len(), count);
            }
            for (k, velocity) in velocities.iter().enumerate() {
                self.by_stress[(2 * k, unknown)] = velocity.x / unit;
                self.by_stress[(2 * k + 1, unknown)] = velocity.y / unit;
            }
        }
        (self.along, self.around, self.drag) = kept;
        if self.holds {
            let perimeter: f64 = self.weights.iter().sum();
            for (axis, k) in (0..2).flat_map(|axis| (0..self.nodes).map(move |k| (axis, k))) {
                let row = of_cortex + axis * self.nodes + k;
                matrix[(row, count + axis)] = -self.friction;
                matrix[(count + axis, row)] = self.weights[k] / perimeter;
                matrix[(count + axis, count + axis)] = 0.0;
            }
        }
        self.factors = Some(matrix.lu());
        Ok(())
    }

    pub(crate) fn has_matrix(&self) -> bool {
        self.factors.is_some()
    }

    /// Returns the first-order changes of the velocities of nodes and discs by the change of the stresses.
    pub(crate) fn first_order(&self, strain: Strain<'_>, concentrations: &[f64]) -> Result<Vec<Vec2>, SteadyError> {
        let correction = self.solve(&self.residual(strain, concentrations))?;
        let count = self.unknowns();
        let uniform = if self.holds { Vec2::new(correction[count], correction[count + 1]) } else { Vec2::ZERO };
        let change = &self.by_stress * correction.rows(0, count);
        Ok(change.as_slice().chunks_exact(2).map(|v| Vec2::new(v[0], v[1]) + uniform).collect())
    }

    /// Corrects the stresses, unless they are right or corrections no longer shrink; then returns true.
    pub(crate) fn correct(
        &mut self,
        strain: Strain<'_>,
        concentrations: &[f64],
        progress: &mut Progress,
    ) -> Result<bool, SteadyError> {
        let correction = self.solve(&self.residual(strain, concentrations))?;
        let [of_cortex, of_friction] = self.counts();
        let size = if of_cortex > 0 { correction.rows(0, of_cortex).amax() } else { 0.0 };
        let size = size.max(if of_friction > 0 {
            progress.radius * correction.rows(of_cortex, of_friction).amax()
        } else {
            0.0
        });
        if !size.is_finite() {
            return Err(failed());
        }
        let largest = self.along.iter().chain(&self.around).map(|g| g.abs()).fold(progress.scale, f64::max);
        progress.scale = self.drag.iter().map(|g| progress.radius * g.length()).fold(largest, f64::max);
        progress.iterations += 1;
        let (stalled, right) = (size > CONTRACTION * progress.size, size <= ROUND_OFF * progress.scale);
        progress.size = size;
        if stalled || right || progress.iterations > MOST {
            return Ok(true);
        }
        self.add(&correction);
        Ok(false)
    }

    fn solve(&self, residual: &DVector<f64>) -> Result<DVector<f64>, SteadyError> {
        self.factors.as_ref().and_then(|factors| factors.solve(residual)).ok_or_else(failed)
    }
}

/// Progress of corrections with one matrix.
#[derive(Debug)]
pub(crate) struct Progress {
    /// Length that makes friction a stress.
    radius: f64,
    /// Largest of the stresses, with the tension among them.
    scale: f64,
    /// Size of the last correction.
    size: f64,
    iterations: usize,
}

impl Progress {
    pub(crate) fn new(radius: f64, scale: f64) -> Self {
        Self { radius, scale, size: f64::INFINITY, iterations: 0 }
    }

    /// Returns true if the last correction was as small as the errors of the flow let it be.
    pub(crate) fn is_done(&self) -> bool {
        self.size <= ACCEPTED * self.scale
    }
}

fn failed() -> SteadyError {
    SteadyError::singular("the stresses of the cortex", "Use another number of nodes, or a smaller viscosity")
}
