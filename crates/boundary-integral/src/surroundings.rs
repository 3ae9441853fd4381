//! What surrounds the interfaces, as the sums over their nodes see it.

use ib_core::FlowError;
use num_complex::Complex64;

use crate::{
    box_flow::BoxFlow,
    channel_flow::ChannelFlow,
    domain::sealed::Kind,
    far::{Division, Far, Smooth, too_close},
    field::{FieldKernel, Flow},
    images::Images,
    interface::{Interface, Transforms},
    layers::Pair,
    pair_kernel::FreePair,
    planes::Vectors,
    stress::Dipoles,
};

/// Velocities at the nodes, x then y, interface after interface, with the difference of viscosities (inside minus
/// outside) of each interface.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NodeVelocities<'a> {
    pub(crate) values: &'a [f64],
    pub(crate) contrasts: &'a [f64],
}

impl<'a> NodeVelocities<'a> {
    /// The components at the nodes of one interface.
    pub(crate) fn of(&self, interface: usize, nodes: usize) -> (&'a [f64], &'a [f64]) {
        self.values[2 * nodes * interface..2 * nodes * (interface + 1)].split_at(nodes)
    }
}

/// Images and walls: which Green's function acts between pairs, and what is added to the sums over pairs. Flows are 4
/// pi times velocity times viscosity.
pub(crate) trait Surroundings: std::fmt::Debug + Send {
    /// The periods.
    fn images(&self) -> Images;

    /// Wave number and direction of rows of images, as in [`crate::planes::Planes::fill`].
    fn wave(&self) -> Option<(f64, bool)>;

    /// What of the Green's function between two interfaces goes by sums over nodes and what by a series.
    fn divide(&self, target: &Interface, source: &Interface, own: bool, out: &mut Division);

    /// The series between interfaces.
    fn far(&self, tolerance: f64) -> Far;

    /// Takes over the present shapes.
    ///
    /// # Errors
    /// A node beyond a wall; the number of the interface is its index here.
    fn prepare(&mut self, interfaces: &mut [Interface], transforms: &mut Transforms) -> Result<(), FlowError>;

    /// Adds what sums over nodes and series lack of the single layer.
    fn add_forces(&mut self, interfaces: &[Interface], out: &mut [Vectors]);

    /// Adds what sums over nodes and series lack of the double layer, to an accuracy relative to the velocities.
    fn add_dipoles(
        &mut self,
        interfaces: &[Interface],
        dipoles: &[Dipoles],
        velocities: NodeVelocities<'_>,
        accuracy: f64,
        transforms: &mut Transforms,
        out: &mut [Vectors],
    );

    /// Velocity of the imposed flow at height y, in surroundings of the given viscosity.
    fn imposed(&self, _y: f64, _viscosity: f64) -> f64 {
        0.0
    }

    /// Mean pressure gradient along x.
    fn pressure_gradient(&self, _interfaces: &[Interface], _velocities: NodeVelocities<'_>, _viscosity: f64) -> f64 {
        0.0
    }

    /// The Green's function at points away from the interfaces.
    fn field(&self) -> FieldKernel;

    /// Prepares the flow that [`FieldKernel`] lacks at points.
    fn begin_field(
        &mut self,
        _interfaces: &[Interface],
        _velocities: NodeVelocities<'_>,
        _transforms: &mut Transforms,
        _points: &[Complex64],
    ) {
    }

    /// Adds the flow that [`FieldKernel`] lacks at the point of that number.
    fn add_field(&self, _index: usize, _flow: &mut Flow) {}
}

pub(crate) fn surroundings(kind: Kind, tolerance: f64) -> Box<dyn Surroundings> {
    match kind {
        Kind::Free(_) => Box::new(Unbounded),
        Kind::Periodic(domain) => Box::new(BoxFlow::new(domain.periods(), tolerance)),
        Kind::Channel(domain) => Box::new(ChannelFlow::new(&domain, tolerance)),
    }
}

/// Nothing.
#[derive(Debug)]
struct Unbounded;

impl Surroundings for Unbounded {
    fn images(&self) -> Images {
        Images { periods: [None; 2] }
    }

    fn wave(&self) -> Option<(f64, bool)> {
        None
    }

    fn divide(&self, target: &Interface, source: &Interface, own: bool, out: &mut Division) {
        let distance = target.centre - source.centre;
        out.clear(distance);
        if own || too_close(target.radius + source.radius, distance) {
            out.pairs.push((Pair::Free(FreePair { offset: [-distance.re, -distance.im] }), own));
        } else {
            out.smooth = Smooth::Free;
            out.nearest = distance.norm();
        }
    }

    fn far(&self, tolerance: f64) -> Far {
        Far::new(None, f64::INFINITY, None, tolerance)
    }

    fn prepare(&mut self, _interfaces: &mut [Interface], _transforms: &mut Transforms) -> Result<(), FlowError> {
        Ok(())
    }

    fn add_forces(&mut self, _interfaces: &[Interface], _out: &mut [Vectors]) {}

    fn add_dipoles(
        &mut self,
        _interfaces: &[Interface],
        _dipoles: &[Dipoles],
        _velocities: NodeVelocities<'_>,
        _accuracy: f64,
        _transforms: &mut Transforms,
        _out: &mut [Vectors],
    ) {
    }

    fn field(&self) -> FieldKernel {
        FieldKernel::Free
    }
}
