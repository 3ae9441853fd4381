//! Single and double layers on curves, at their nodes and at points anywhere.
//!
//! A layer is the sum of four contributions: of the nodes of curves that are close to each other, summed directly; of
//! all other curves and images, by multipoles; of what the region adds (walls, a mean flow); and of a correction at
//! nodes and points that are so close to a curve that its nodes do not resolve the Green's function.

mod dipoles;
mod direct;
mod plan;
mod points;
mod stokeslets;
mod sums;
mod walls;

use std::{
    f64::consts::{PI, TAU},
    ops::Range,
};

use input_checks::InputError;
use num_complex::Complex64;

use crate::{
    Forcing, Geometry, LayerError,
    close::{CloseCorrection, Crossing},
    curve::{Curve, GivenCurve, REFINEMENT},
    greens::{GreensFunction, Vectors},
    multipole::Multipoles,
};
pub(crate) use dipoles::Dipoles;
use direct::DirectSums;
pub(crate) use direct::{DirectPair, Pair};
pub(crate) use plan::{Kept, Plan};
use walls::Walls;

/// Velocities at the nodes, x then y, curve after curve, and what each curve's are multiplied by in a double layer (the
/// viscosity inside less that outside); curves behind these have no double layer.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Density<'a> {
    pub(crate) values: &'a [f64],
    pub(crate) contrasts: &'a [f64],
}

impl<'a> Density<'a> {
    /// Nodes of each curve.
    pub(crate) fn nodes(&self) -> usize {
        self.values.len() / (2 * self.contrasts.len()).max(1)
    }

    /// The components at the nodes of one curve.
    pub(crate) fn of(&self, curve: usize) -> (&'a [f64], &'a [f64]) {
        let nodes = self.nodes();
        self.values[2 * nodes * curve..2 * nodes * (curve + 1)].split_at(nodes)
    }

    /// What the velocities of a curve are multiplied by.
    pub(crate) fn contrast(&self, curve: usize) -> f64 {
        self.contrasts.get(curve).copied().unwrap_or(0.0)
    }

    fn vanishes(&self) -> bool {
        self.contrasts.iter().all(|contrast| *contrast == 0.0)
    }
}

/// Layers on curves in a region. Flows are 4 pi times velocity times viscosity.
#[derive(Debug, Clone)]
pub(crate) struct Layers {
    pub(crate) geometry: Geometry,
    greens: GreensFunction,
    pub(crate) plans: Vec<Plan>,
    pub(crate) curves: Vec<Curve>,
    /// The first node of each curve among those of all, and their number.
    pub(crate) starts: Vec<usize>,
    /// Curves whose forces come later.
    pub(crate) kept: Kept,
    /// Number of curves at the end that stay as they are when others are loaded.
    fixed: usize,
    direct: DirectSums,
    multipoles: Multipoles,
    walls: Option<Walls>,
    close: CloseCorrection,
    /// The flow at the nodes.
    pub(crate) out: Vec<Vectors>,
    /// Velocities at the fine nodes, curve after curve.
    fine: Vec<Complex64>,
    points: points::PointSums,
}

impl Layers {
    /// Where `symmetric`, corrections of the single layer for close nodes are the same in both directions.
    pub(crate) fn new(geometry: Geometry, tolerance: f64, symmetric: bool) -> Result<Self, InputError> {
        let walls = if let Geometry::Channel { length, width, forcing } = geometry {
            Some(Walls::new(length, width, forcing, tolerance))
        } else {
            None
        };
        Ok(Self {
            geometry,
            greens: GreensFunction::new(&geometry, tolerance),
            plans: Vec::new(),
            curves: Vec::new(),
            starts: vec![0],
            kept: Kept { first: 0, among: false },
            fixed: 0,
            direct: DirectSums::default(),
            multipoles: Multipoles::new(geometry, tolerance)?,
            walls,
            close: CloseCorrection::new(tolerance, symmetric),
            out: Vec::new(),
            fine: Vec::new(),
            points: points::PointSums::new(tolerance),
        })
    }

    /// Keeps the present curves as they are when others are loaded, in front of them.
    pub(crate) fn fix(&mut self) {
        self.fixed = self.curves.len();
    }

    /// Takes over curves, in place of all that are not fixed; the single layers of the fixed ones come later, or of all
    /// of them.
    ///
    /// # Errors
    /// Numbers that are not finite, too few or too many points, a clockwise curve, a curve that goes on by something
    /// else than the period, a node beyond a wall.
    pub(crate) fn load<'a>(
        &mut self,
        curves: impl Iterator<Item = GivenCurve<'a>>,
        all_later: bool,
    ) -> Result<(), LayerError> {
        let mut count = 0;
        let mut loaded = self.curves.len() - self.fixed;
        self.starts.truncate(1);
        for (index, given) in curves.enumerate() {
            let plan = Plan::find(&mut self.plans, given.nodes)?;
            if index == loaded {
                self.curves.insert(index, Curve::new(given.nodes));
                self.out.insert(index, Vectors::default());
                loaded += 1;
            } else if self.curves[index].len() != given.nodes {
                self.curves[index] = Curve::new(given.nodes);
            }
            let curve = &mut self.curves[index];
            curve.plan = plan;
            curve.load(&mut self.plans[plan].transforms, given, &self.geometry, index)?;
            count += 1;
        }
        self.curves.drain(count..loaded);
        self.out.drain(count..loaded);
        for curve in &self.curves {
            self.starts.push(self.starts[self.starts.len() - 1] + curve.len());
        }
        self.kept = if all_later { Kept { first: 0, among: true } } else { Kept { first: count, among: false } };
        match &mut self.walls {
            Some(walls) => walls.load(&mut self.curves, &mut self.plans),
            None => Ok(()),
        }
    }

    /// The entries of a curve in vectors over all nodes, x then y, curve after curve.
    pub(crate) fn entries(&self, curve: usize) -> Range<usize> {
        2 * self.starts[curve]..2 * self.starts[curve + 1]
    }

    /// The plan of a curve.
    pub(crate) fn plan(&mut self, curve: usize) -> &mut Plan {
        &mut self.plans[self.curves[curve].plan]
    }

    /// The flow of the last layer at the nodes.
    pub(crate) fn flow(&self) -> &[Vectors] {
        &self.out
    }

    fn clear(&mut self) {
        for (out, curve) in self.out.iter_mut().zip(&self.curves) {
            out.clear(curve.len());
        }
    }

    /// Computes the single layer of the forces at the nodes, but for those that come later, which it prepares for. With
    /// `double`, prepares for [`Layers::double_layer`].
    pub(crate) fn single_layer(&mut self, double: bool) {
        self.clear();
        let Self { direct, multipoles, walls, close, curves, plans, out, kept, .. } = self;
        let kept = *kept;
        let wave = match self.geometry {
            Geometry::Channel { length, .. } => Some(TAU / length),
            Geometry::Box { lengths } if kept.first < curves.len() || curves.iter().any(Curve::is_open) => {
                Some(TAU / lengths[0])
            }
            _ => None,
        };
        direct.load(curves, kept, wave);
        multipoles.divide(curves, kept, &mut direct.pairs);
        close.find(curves, plans, &self.geometry.images(), kept);

        direct.add_forces(plans, kept, out);
        multipoles.add_forces(&curves[..kept.first], out);
        if let Some(walls) = walls {
            walls.add_forces(curves, 0..kept.first, out);
        }
        close.add_forces(curves, plans, kept, double, out);
        if double {
            direct.prepare_stress();
        }
    }

    /// Computes the single layer of forces that came later, at the nodes of their curves, x then y, curve after curve.
    pub(crate) fn kept_layer(&mut self, forces: &[f64]) {
        self.set_kept(forces, self.walls.as_ref().is_some_and(Walls::is_refined));
        self.clear();
        let Self { direct, walls, close, curves, plans, out, kept, .. } = self;
        direct.add_kept(curves, plans, *kept, out);
        if let Some(walls) = walls {
            walls.add_forces(curves, kept.first..curves.len(), out);
        }
        close.add_kept(curves, out);
    }

    /// Interpolates forces that came later to the fine nodes.
    pub(crate) fn refine_kept(&mut self) {
        for curve in &mut self.curves[self.kept.first..] {
            curve.refine_forces(&mut self.plans[curve.plan].transforms);
        }
    }

    /// Takes over forces that come later; at the fine nodes too, where they are asked for.
    pub(crate) fn set_kept(&mut self, forces: &[f64], fine: bool) {
        let mut first = 0;
        for curve in &mut self.curves[self.kept.first..] {
            let values = &forces[first..first + 2 * curve.len()];
            curve.set_forces(&mut self.plans[curve.plan].transforms, values, fine);
            first += values.len();
        }
    }

    /// Computes the double layer at the nodes: walls and multipoles to an accuracy relative to the velocities.
    pub(crate) fn double_layer(&mut self, density: Density<'_>, accuracy: f64) {
        if self.walls.as_ref().is_some_and(Walls::is_refined) {
            self.refine(density);
        }
        let mean = self.mean_flow(density);
        self.clear();
        let Self { direct, multipoles, walls, close, curves, fine, out, kept, .. } = self;
        for (index, (arrays, curve)) in direct.curves.iter_mut().zip(&curves[..kept.first]).enumerate() {
            let weight = density.contrasts[index] * curve.weight();
            arrays.dipoles.fill(density.of(index), &curve.nodes.tangent, weight);
        }

        direct.add_dipoles(curves, out);
        let dipoles = direct.curves.iter().map(|arrays| &arrays.dipoles);
        multipoles.add_dipoles(&curves[..kept.first], dipoles, accuracy, out);
        if let Some(walls) = walls {
            walls.add_dipoles(curves, density, fine, accuracy, out);
        }
        if let Some(mean) = mean {
            for out in &mut *out {
                out.x.iter_mut().for_each(|u| *u -= mean.re);
                out.y.iter_mut().for_each(|v| *v -= mean.im);
            }
        }
        close.add_dipoles(density, out);
    }

    /// Velocity at height y of the flow that the forcing of a channel drives.
    pub(crate) fn forced_flow(&self, y: f64, viscosity: f64) -> f64 {
        self.walls.as_ref().map_or(0.0, |walls| walls.forced_flow(y, viscosity))
    }

    /// Drives the flow by a mean pressure gradient (force per volume).
    pub(crate) fn set_gradient(&mut self, gradient: f64) {
        if let Some(walls) = &mut self.walls {
            walls.forcing = Forcing::Gradient(gradient);
        }
    }

    /// The two curves and the place where a node lies on the wrong side of a fixed curve, as far as the last single
    /// layer has seen.
    pub(crate) fn crossing(&self) -> Option<Crossing> {
        self.close.crossing()
    }

    /// What the flux through the channel of the forces of some curves, without a mean pressure gradient, is `1/(2 l
    /// eta)` times of.
    pub(crate) fn force_moment(&self, from: Range<usize>) -> f64 {
        self.walls.as_ref().map_or(0.0, |walls| walls.force_moment(&self.curves[from]))
    }

    /// The same of a double layer.
    pub(crate) fn dipole_moment(&self, density: Density<'_>) -> f64 {
        self.walls.as_ref().map_or(0.0, |walls| walls.dipole_moment(&self.curves, density))
    }

    /// Mean pressure gradient along x (force per volume).
    pub(crate) fn pressure_gradient(&self, density: Density<'_>, viscosity: f64) -> f64 {
        self.walls.as_ref().map_or(0.0, |walls| walls.pressure_gradient(&self.curves, density, viscosity))
    }

    /// Interpolates velocities to the fine nodes.
    fn refine(&mut self, density: Density<'_>) {
        let nodes = density.nodes();
        let len = REFINEMENT * nodes;
        self.fine.resize(len * density.contrasts.len(), Complex64::default());
        let values = density.values.chunks_exact((2 * nodes).max(1));
        for ((fine, values), curve) in self.fine.chunks_exact_mut(len.max(1)).zip(values).zip(&self.curves) {
            self.plans[curve.plan].transforms.at_fine(values, fine);
        }
    }

    /// 4 pi/area times the sum of X v.n in a box, whose mean velocity is zero.
    fn mean_flow(&self, density: Density<'_>) -> Option<Complex64> {
        let Geometry::Box { lengths: [lx, ly] } = self.geometry else { return None };
        let mut sum = Complex64::default();
        for (index, (curve, contrast)) in self.curves.iter().zip(density.contrasts).enumerate() {
            let (vx, vy) = density.of(index);
            for (i, (z, t)) in curve.nodes.position.iter().zip(&curve.nodes.tangent).enumerate() {
                sum += z * ((vx[i] * t.im - vy[i] * t.re) * contrast * curve.weight());
            }
        }
        Some(sum * (4.0 * PI / (lx * ly)))
    }
}
