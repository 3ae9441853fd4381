//! Single and double layers on curves in a region, at the nodes of the curves.
//!
//! A layer is the sum of four contributions: of the nodes of curves that are close to each other, summed directly; of
//! all other curves and images, by multipoles; of what the region adds (walls, a mean flow); and of a correction at
//! nodes that are so close to a curve that its nodes do not resolve the Green's function. Many nodes are summed
//! together in place of the first two.

mod close;
mod rows;
mod wall_images;
mod walls;

use std::{
    array,
    f64::consts::{PI, TAU},
    ops::Range,
};

use motile_base::{InputError, Vec2, within};
use nalgebra::DMatrix;
use num_complex::Complex64;

use crate::images::{Images, check};
use crate::{
    LayerError, Symmetry,
    curve::{Curve, LayerCurve},
    density::{Density, StoredLayers},
    direct::DirectSums,
    ewald::{Ewald, filling},
    greens::{GreensFunction, Vectors, walls::Uncorrected},
    multipole::Multipoles,
    plan::{Plan, Plans},
    shares,
    transforms::REFINEMENT,
};
use close::CloseCorrection;
pub(crate) use close::{Crossing, bounding_box};
use motile_base::{Drive, ImposedFlow, Region};
use walls::Walls;

/// Nodes of several curves from which on fast sums cost less than sums over pairs and series (measured at ratios of
/// viscosities of 1, and of 10 and 100, whose iterations read what pairs have stored); otherwise of one curve, in any
/// region.
const MANY_IN_BOX: [usize; 2] = [250, 1500];
const MANY_IN_CHANNEL: [usize; 2] = [250, 2000];
const MANY_IN_PLANE: [usize; 2] = [4000, 10_000];
const MANY_OF_ONE: usize = 1000;
/// Tolerance below which fast sums show round-off: sums are then those over pairs, for any number of nodes.
const ROUND_OFF: f64 = 1e-12;
/// Minimum fraction of a circle around all curves in the plane that they fill where fast sums cost less (measured).
const FILLED: f64 = 0.005;

/// Layers on curves in a region. Flows are 4 pi times velocity times viscosity (force per length in 2D).
#[derive(Debug, Clone)]
pub(crate) struct Layers {
    pub(crate) region: Region,
    pub(crate) images: Images,
    /// Strain of the images of a box (no dimension).
    pub(crate) strain: f64,
    pub(crate) greens: GreensFunction,
    pub(crate) plans: Plans,
    pub(crate) curves: Vec<Curve>,
    /// The first node of each curve among the nodes of all, and their number.
    pub(crate) starts: Vec<usize>,
    pub(crate) stored: StoredLayers,
    /// Number of curves at the end that stay when others are loaded.
    fixed: usize,
    direct: DirectSums,
    multipoles: Multipoles,
    /// Tolerance of the sums over many nodes over the tolerance of all else, at most 1: where a small part of what they
    /// sum is to be right to the tolerance.
    pub(crate) sharpness: f64,
    /// Sums over many nodes, while they are used.
    pub(crate) fast: Option<Box<Ewald>>,
    pub(crate) walls: Option<Walls>,
    /// The imposed flow, without what the drive of a channel drives.
    pub(crate) imposed: ImposedFlow,
    /// Viscosities at the lower and upper wall of a channel over the viscosity of the exterior fluid.
    pub(crate) at_walls: [f64; 2],
    close: CloseCorrection,
    /// Flow of the last layer at the nodes.
    pub(crate) flow: Vec<Vectors>,
    /// Velocities at the fine nodes, curve after curve.
    pub(crate) fine: Vec<Complex64>,
}

impl Layers {
    /// Layers without curves.
    ///
    /// # Errors
    /// Returns an error for lengths of the region that are not positive and finite, periods of which one is more than
    /// 20 times the other, a forcing that is not finite, a tolerance outside of 1e-15 to 1e-3.
    pub(crate) fn new(region: Region, tolerance: f64, symmetry: Symmetry) -> Result<Self, InputError> {
        check(&region)?;
        within("the tolerance", tolerance, 1e-15, 1e-3)?;
        // Only the walls know of slip.
        let (region, slip) = (region.without_slip(), region.slip());
        let walls = if let Region::Channel { length, width, drive } = region {
            Some(Walls::new(length, width, drive, slip, tolerance))
        } else {
            None
        };
        let images = Images::of(&region, 0.0);
        Ok(Self {
            region,
            images,
            strain: 0.0,
            greens: GreensFunction::new(&region, images.tilt(), tolerance),
            plans: Plans::default(),
            curves: Vec::new(),
            starts: vec![0],
            stored: StoredLayers { first: 0, mutual: false },
            fixed: 0,
            direct: DirectSums::default(),
            multipoles: Multipoles::new(region, tolerance)?,
            sharpness: 1.0,
            fast: None,
            walls,
            imposed: ImposedFlow::NONE,
            at_walls: [1.0; 2],
            close: CloseCorrection::new(tolerance, symmetry),
            flow: Vec::new(),
            fine: Vec::new(),
        })
    }

    /// Displaces the images of a box by a strain (no dimension).
    pub(crate) fn set_strain(&mut self, strain: f64) {
        self.strain = strain;
        let images = Images::of(&self.region, strain);
        if images != self.images {
            self.images = images;
            self.greens = GreensFunction::new(&self.region, images.tilt(), self.multipoles.tolerance());
            self.multipoles.set_images(images);
        }
    }

    /// Keeps the present curves, behind those that are loaded from now on.
    pub(crate) fn fix(&mut self) {
        self.fixed = self.curves.len();
    }

    /// Takes over curves with their forces (none if these are given later), in place of all that are not fixed. The
    /// layers of the fixed curves are stored, or the layers of all curves if `all_stored`.
    ///
    /// # Errors
    /// Returns an error for numbers that are not finite, too few or too many points, a clockwise curve, an advance that
    /// is not the period of the region, a node beyond a wall.
    pub(crate) fn load<'a>(
        &mut self,
        curves: &(impl Iterator<Item = (LayerCurve<'a>, &'a [Vec2])> + Clone + Send),
        all_stored: bool,
    ) -> Result<(), LayerError> {
        let mut count = 0;
        let mut loaded = self.curves.len() - self.fixed;
        self.starts.truncate(1);
        if let Some(walls) = &mut self.walls {
            walls.clear();
        }
        for (index, (LayerCurve { nodes, .. }, _)) in curves.clone().enumerate() {
            let plan = self.plans.find(nodes)?;
            if index == loaded {
                self.curves.insert(index, Curve::new(nodes));
                self.flow.insert(index, Vectors::default());
                loaded += 1;
            } else if self.curves[index].len() != nodes {
                self.curves[index] = Curve::new(nodes);
            }
            self.curves[index].plan = plan;
            count += 1;
        }
        self.curves.drain(count..loaded);
        self.flow.drain(count..loaded);
        for curve in &self.curves {
            self.starts.push(self.starts[self.starts.len() - 1] + curve.len());
        }
        let len = shares::curves(self.curves.len(), self.starts[self.curves.len()]);
        self.plans.divide(self.curves.len().div_ceil(len));
        let mut results = array::from_fn::<_, { shares::MOST }, _>(|_| Ok(()));
        let pieces = self.curves[..count].chunks_mut(len).zip(self.plans.pieces()).zip(&mut results);
        let pieces = pieces.enumerate().map(|(piece, own)| (piece * len, curves.clone(), own));
        let region = &self.region;
        shares::each_of(self.starts[count], pieces, |(first, given, ((curves, plans), result))| {
            let mut given = given.clone().enumerate().skip(*first);
            **result = curves.iter_mut().zip(&mut given).try_for_each(|(curve, (index, given))| {
                curve.load(&mut plans[curve.plan].transforms, given, region, index)
            });
        });
        results.into_iter().collect::<Result<(), _>>()?;
        self.stored = StoredLayers { first: if all_stored { 0 } else { count }, mutual: all_stored };
        self.plan_fast()?;
        // The operator of stored layers is a matrix, which is symmetric.
        let closed = self.fast.is_none() && self.stored.first == self.curves.len();
        match &mut self.walls {
            Some(walls) => walls.load(&mut self.curves, &mut self.plans, closed),
            None => Ok(()),
        }
    }

    /// Prepares for fast sums where they pay: for many nodes of closed curves whose layers are not stored, in the plane
    /// as far as these are not far between.
    fn plan_fast(&mut self) -> Result<(), LayerError> {
        let Self { region, stored, curves, starts, .. } = &*self;
        let given = &curves[..stored.first];
        let [equal, different] = match region {
            _ if self.multipoles.tolerance() < ROUND_OFF => [usize::MAX; 2],
            _ if given.len() == 1 => [MANY_OF_ONE; 2],
            Region::Box { .. } => MANY_IN_BOX,
            Region::Channel { .. } => MANY_IN_CHANNEL,
            _ => MANY_IN_PLANE,
        };
        // Sums are sharper where viscosities differ.
        let many = if self.sharpness < 1.0 { different } else { equal };
        let pays = starts[stored.first] >= many
            && !stored.mutual
            && !given.iter().any(Curve::is_open)
            && (*region != Region::Plane || filling(curves) > FILLED);
        if pays {
            return self.sum_fast();
        }
        self.fast = None;
        Ok(())
    }

    /// Prepares for fast sums.
    pub(crate) fn sum_fast(&mut self) -> Result<(), LayerError> {
        let tolerance = self.sharp_tolerance();
        if let Some(walls) = self.walls.as_mut().filter(|walls| walls.uses_images()) {
            walls.use_modes(&mut self.curves, &mut self.plans)?;
        }
        let Self { region, fast, images, curves, .. } = self;
        match fast {
            Some(fast) if fast.tolerance() == tolerance => fast.set(images, curves, &[])?,
            _ => *fast = Ewald::new(region, images, tolerance, curves, &[])?.map(Box::new),
        }
        Ok(())
    }

    /// Returns the tolerance of the sums over many nodes.
    pub(crate) fn sharp_tolerance(&self) -> f64 {
        self.sharpness * self.multipoles.tolerance()
    }

    /// Returns true if the nodes are so many that all are summed together.
    pub(crate) fn sums_fast(&self) -> bool {
        self.fast.is_some()
    }

    /// Returns the entries of a curve in vectors over all nodes, x then y, curve after curve.
    pub(crate) fn entries(&self, curve: usize) -> Range<usize> {
        2 * self.starts[curve]..2 * self.starts[curve + 1]
    }

    /// Returns the plan of a curve.
    pub(crate) fn plan(&mut self, curve: usize) -> &mut Plan {
        &mut self.plans[self.curves[curve].plan]
    }

    /// Adds a multiple of the flow at the nodes of a curve to values there, x then y.
    pub(crate) fn add_flow(&self, curve: usize, factor: f64, values: &mut [f64]) {
        let Vectors { x, y } = &self.flow[curve];
        let (along, across) = values.split_at_mut(x.len());
        for (values, flow) in [(along, x), (across, y)] {
            values.iter_mut().zip(flow).for_each(|(value, flow)| *value += factor * flow);
        }
    }

    fn clear(&mut self) {
        for (flow, curve) in self.flow.iter_mut().zip(&self.curves) {
            flow.clear(curve.len());
        }
    }

    /// Computes the single layer of the forces at the nodes and stores the layers of curves whose forces are given
    /// later. With `double`, prepares for [`Layers::double_layer`].
    pub(crate) fn single_layer(&mut self, double: bool) {
        self.clear();
        let short = self.sharpness < 1.0 && self.sums_fast();
        let Self { direct, multipoles, fast, walls, close, curves, plans, flow, stored, images, .. } = self;
        let stored = *stored;
        close.resolve(short);
        if let Some(fast) = fast {
            close.find(curves, plans, images, stored);
            fast.place(curves);
            fast.add_forces(curves, 0..stored.first, plans, flow);
            if let Some(walls) = walls {
                walls.add_forces(curves, 0..stored.first, fast.uncorrected(), plans, flow);
            }
            close.add_forces(curves, plans, stored, double, flow);
            return;
        }
        let wave = match self.region {
            Region::Channel { length, .. } => Some(TAU / length),
            Region::Box { lengths } if curves.iter().any(Curve::is_open) => Some(TAU / lengths[0]),
            _ => None,
        };
        direct.load(curves, stored, wave);
        multipoles.divide(curves, stored, &mut direct.pairs);
        close.find(curves, plans, images, stored);

        direct.add_forces(plans, stored, flow);
        multipoles.add_forces(curves, 0..stored.first, flow);
        if let Some(walls) = walls {
            walls.add_forces(curves, 0..stored.first, Uncorrected::Row, plans, flow);
        }
        close.add_forces(curves, plans, stored, double, flow);
        if double {
            direct.prepare_stress();
        }
    }

    /// Computes the stored single layers for forces at the nodes of their curves, x then y, curve after curve.
    pub(crate) fn stored_layer(&mut self, forces: &[f64]) {
        self.set_stored(forces, false);
        self.clear();
        let Self { direct, fast, walls, close, curves, plans, flow, stored, .. } = self;
        if let Some(fast) = fast {
            let from = stored.first..curves.len();
            fast.add_forces(curves, from.clone(), plans, flow);
            if let Some(walls) = walls {
                walls.add_forces(curves, from, fast.uncorrected(), plans, flow);
            }
            close.add_stored(curves, plans, flow);
            return;
        }
        direct.add_stored(curves, plans, *stored, flow);
        self.add_indirect();
    }

    /// Writes the matrix of the stored single layers of curves of which all are stored, x then y, curve after curve.
    pub(crate) fn write_stored(&mut self, matrix: &mut DMatrix<f64>) {
        // What walls, images and corrections add, column by column.
        let mut forces = vec![0.0; matrix.ncols()];
        for column in 0..matrix.ncols() {
            forces[column] = 1.0;
            self.set_stored(&forces, false);
            self.clear();
            self.add_indirect();
            matrix.column_mut(column).fill(0.0);
            for curve in 0..self.curves.len() {
                let entries = self.entries(curve);
                self.add_flow(curve, 1.0, &mut matrix.column_mut(column).as_mut_slice()[entries]);
            }
            forces[column] = 0.0;
        }
        let place = |[curve, node]: [usize; 2]| {
            let x = 2 * self.starts[curve] + node;
            [x, x + self.curves[curve].len()]
        };
        self.direct.each_stored(&self.plans, |[target, source], [xx, xy, yy]| {
            let ([tx, ty], [sx, sy]) = (place(target), place(source));
            for (row, column, value) in [(tx, sx, xx), (tx, sy, xy), (ty, sx, xy), (ty, sy, yy)] {
                matrix[(row, column)] += value;
                if target != source {
                    matrix[(column, row)] += value;
                }
            }
        });
    }

    /// Adds the single layers of the stored curves except for the sums over pairs of nodes.
    fn add_indirect(&mut self) {
        let Self { multipoles, walls, close, curves, plans, flow, stored, .. } = self;
        multipoles.add_forces(curves, stored.first..curves.len(), flow);
        if let Some(walls) = walls {
            walls.add_forces(curves, stored.first..curves.len(), Uncorrected::Row, plans, flow);
        }
        close.add_stored(curves, plans, flow);
    }

    /// Interpolates shape and forces of the stored curves to their fine nodes.
    pub(crate) fn refine_stored(&mut self) {
        for curve in &mut self.curves[self.stored.first..] {
            curve.refine_forces(&mut self.plans[curve.plan].transforms);
        }
    }

    /// Takes over forces at the nodes of the stored curves; with `fine`, or where corrections read them, at the fine
    /// nodes too.
    pub(crate) fn set_stored(&mut self, forces: &[f64], fine: bool) {
        let mut first = 0;
        for (index, curve) in self.curves.iter_mut().enumerate().skip(self.stored.first) {
            let fine = fine || self.close.reads(index) || self.walls.as_ref().is_some_and(|walls| walls.refines(index));
            let values = &forces[first..first + 2 * curve.len()];
            curve.set_forces(&mut self.plans[curve.plan].transforms, values, fine);
            first += values.len();
        }
    }

    /// Computes the double layer at the nodes, walls and multipoles to an `accuracy` relative to the velocities.
    pub(crate) fn double_layer(&mut self, density: Density<'_>, accuracy: f64) {
        if let Some(walls) = self.walls.take_if(|walls| walls.is_refined()) {
            self.refine(density, |curve| walls.refines(curve));
            self.walls = Some(walls);
        }
        let mean = self.mean_flow(density);
        self.clear();
        let Self { direct, multipoles, fast, walls, close, curves, plans, fine, flow, stored, .. } = self;
        let mut uncorrected = Uncorrected::Row;
        if let Some(fast) = fast {
            fast.add_dipoles(curves, density, flow);
            uncorrected = fast.uncorrected();
        } else {
            for (index, (arrays, curve)) in direct.curves.iter_mut().zip(&curves[..stored.first]).enumerate() {
                let weight = density.contrasts[index] * curve.weight();
                arrays.dipoles.fill(density.of(index), &curve.nodes.tangent, weight);
            }
            direct.add_dipoles(curves, flow);
            let dipoles = direct.curves.iter().map(|arrays| &arrays.dipoles);
            multipoles.add_dipoles(&curves[..stored.first], dipoles, accuracy, flow);
        }
        if let Some(walls) = walls {
            walls.add_dipoles(curves, density, fine, (uncorrected, accuracy), plans, flow);
        }
        if let Some(mean) = mean {
            for flow in &mut *flow {
                flow.x.iter_mut().for_each(|u| *u -= mean.re);
                flow.y.iter_mut().for_each(|v| *v -= mean.im);
            }
        }
        close.add_dipoles(curves, plans, density, flow);
    }

    /// Returns the imposed flow over the viscosity of the exterior fluid times the viscosity of the fluid that drives
    /// it: next to a sliding wall, the viscosity there.
    fn forcing(&self) -> ImposedFlow {
        match &self.walls {
            Some(walls) if self.at_walls != [1.0; 2] => walls.sliding(&self.imposed, self.at_walls),
            _ => self.imposed,
        }
    }

    /// Returns the imposed flow together with what the drive of a channel drives in fluid of that viscosity, of the
    /// exterior fluid, in units of velocity there.
    pub(crate) fn forced_flow(&self, viscosity: f64) -> ImposedFlow {
        let forcing = self.forcing();
        self.walls.as_ref().map_or(forcing, |walls| forcing + walls.driven_flow(&forcing, viscosity))
    }

    /// Prescribes the mean pressure gradient along a channel (stress per length).
    pub(crate) fn set_gradient(&mut self, gradient: f64) {
        if let Some(walls) = &mut self.walls {
            walls.drive = Drive::Gradient(gradient);
        }
    }

    /// Returns a node on the wrong side of a stored curve, if the last single layer has come across one.
    pub(crate) fn crossing(&self) -> Option<Crossing> {
        self.close.crossing()
    }

    /// Returns the first moment M of the forces on some curves (force times area): at zero mean pressure gradient they
    /// drive the flux M/(2 l eta) through a channel of period l.
    pub(crate) fn force_moment(&self, from: Range<usize>) -> f64 {
        self.walls.as_ref().map_or(0.0, |walls| walls.force_moment(&self.curves[from]))
    }

    /// Returns the first moment of a double layer, which drives the flux M/(2 l eta) like the moment of forces.
    pub(crate) fn dipole_moment(&self, density: Density<'_>) -> f64 {
        self.walls.as_ref().map_or(0.0, |walls| walls.dipole_moment(&self.curves, density))
    }

    /// Returns the mean pressure gradient along a channel (stress per length), zero elsewhere.
    pub(crate) fn pressure_gradient(&self, density: Density<'_>, viscosity: f64) -> f64 {
        self.walls
            .as_ref()
            .map_or(0.0, |walls| walls.pressure_gradient(&self.curves, density, &self.forcing(), viscosity))
    }

    /// Interpolates velocities to the fine nodes of some curves.
    pub(crate) fn refine(&mut self, density: Density<'_>, of: impl Fn(usize) -> bool) {
        let nodes = density.nodes();
        let len = REFINEMENT * nodes;
        self.fine.resize(len * density.contrasts.len(), Complex64::default());
        let values = density.values.chunks_exact((2 * nodes).max(1));
        let all = self.fine.chunks_exact_mut(len.max(1)).zip(values).zip(&mut self.curves).enumerate();
        for (_, ((fine, values), curve)) in all.filter(|(index, _)| of(*index)) {
            let transforms = &mut self.plans[curve.plan].transforms;
            transforms.at_fine(values, fine);
            curve.set_wall_density(transforms, values);
        }
    }

    /// Returns the mean of the double layer in a box, 4 pi/area times the sum of X v.n, which its flow is reduced by,
    /// so that the mean of the velocity is zero. The x component of an interface that is periodic along x depends on
    /// where its period begins: there the mean of viscosity times velocity is.
    pub(crate) fn mean_flow(&self, density: Density<'_>) -> Option<Complex64> {
        let Region::Box { lengths: [lx, ly] } = self.region else { return None };
        let mut sum = Complex64::default();
        for (index, (curve, contrast)) in self.curves.iter().zip(density.contrasts).enumerate() {
            let (vx, vy) = density.of(index);
            for (i, (z, t)) in curve.nodes.position.iter().zip(&curve.nodes.tangent).enumerate() {
                let z = if curve.is_open() { Complex64::new(0.0, z.im) } else { *z };
                sum += z * ((vx[i] * t.im - vy[i] * t.re) * contrast * curve.weight());
            }
        }
        Some(sum * (4.0 * PI / (lx * ly)))
    }
}

#[cfg(test)]
mod tests;
