//! A doubly periodic box.

use std::f64::consts::{PI, TAU};

use ib_core::FlowError;
use num_complex::Complex64;

use crate::{
    far::{Division, Far, Smooth, too_close},
    field::{FieldKernel, Flow},
    images::Images,
    interface::{Interface, Transforms},
    lattice_kernel::LatticePair,
    layers::Pair,
    pair_kernel::FreePair,
    planes::Vectors,
    series::{ImageKernel, SeriesFinder},
    stress::Dipoles,
    surroundings::{NodeVelocities, Surroundings},
};

/// The images of a box.
#[derive(Debug)]
pub(crate) struct BoxFlow {
    periods: [f64; 2],
    tolerance: f64,
    /// 4 pi/area times the sum of X v.n, for sampling.
    mean: Complex64,
}

impl BoxFlow {
    pub(crate) fn new(periods: [f64; 2], tolerance: f64) -> Self {
        Self { periods, tolerance, mean: Complex64::default() }
    }

    fn area(&self) -> f64 {
        self.periods[0] * self.periods[1]
    }

    /// Whether rows of images run along y.
    fn transposed(&self) -> bool {
        self.periods[1] < self.periods[0]
    }

    /// 4 pi/area times the sum of X v.n over all nodes, with contrast and weight in the dipoles.
    fn mean_flow<'a>(&self, parts: impl Iterator<Item = (&'a Interface, &'a Dipoles)>) -> Complex64 {
        let mut sum = Complex64::default();
        for (interface, dipoles) in parts {
            for (i, z) in interface.position.iter().enumerate() {
                sum += z * (dipoles.xx[i] + dipoles.yy[i]);
            }
        }
        sum * (4.0 * PI / self.area())
    }
}

impl Surroundings for BoxFlow {
    fn images(&self) -> Images {
        Images { periods: self.periods.map(Some) }
    }

    fn wave(&self) -> Option<(f64, bool)> {
        None
    }

    fn divide(&self, target: &Interface, source: &Interface, own: bool, out: &mut Division) {
        let distance = self.images().wrap(target.centre - source.centre);
        out.clear(distance);
        out.smooth = Smooth::Images;
        let reach = target.radius + source.radius;
        for i in -2..=2 {
            for j in -2..=2 {
                let e = distance + Complex64::new(f64::from(i) * self.periods[0], f64::from(j) * self.periods[1]);
                let itself = own && (i, j) == (0, 0);
                if itself || too_close(reach, e) {
                    out.direct.push(e);
                    // A pair of interfaces serves both directions, so of two opposite images of its own one is enough.
                    if !own || i > 0 || (i == 0 && j >= 0) {
                        out.pairs.push((Pair::Free(FreePair { offset: [-e.re, -e.im] }), itself));
                    }
                } else {
                    out.nearest = out.nearest.min(e.norm());
                }
            }
        }
    }

    fn far(&self, tolerance: f64) -> Far {
        let transposed = self.transposed();
        let period = self.periods[0].min(self.periods[1]);
        let kernel = ImageKernel::Lattice(LatticePair::new(self.periods, tolerance.min(1e-12) * 1e-3), self.area());
        let finder = SeriesFinder::new(kernel, self.images(), Some((TAU / period, transposed)));
        Far::new(Some(finder), self.area(), Some(period), tolerance)
    }

    fn prepare(&mut self, _interfaces: &mut [Interface], _transforms: &mut Transforms) -> Result<(), FlowError> {
        Ok(())
    }

    fn add_forces(&mut self, _interfaces: &[Interface], _out: &mut [Vectors]) {}

    fn add_dipoles(
        &mut self,
        interfaces: &[Interface],
        dipoles: &[Dipoles],
        _velocities: NodeVelocities<'_>,
        _accuracy: f64,
        _transforms: &mut Transforms,
        out: &mut [Vectors],
    ) {
        let mean = self.mean_flow(interfaces.iter().zip(dipoles));
        for out in out {
            out.x.iter_mut().for_each(|u| *u -= mean.re);
            out.y.iter_mut().for_each(|v| *v -= mean.im);
        }
    }

    fn field(&self) -> FieldKernel {
        FieldKernel::lattice(self.periods, self.tolerance)
    }

    fn begin_field(
        &mut self,
        interfaces: &[Interface],
        velocities: NodeVelocities<'_>,
        _transforms: &mut Transforms,
        _points: &[Complex64],
    ) {
        let mut sum = Complex64::default();
        for (index, (interface, contrast)) in interfaces.iter().zip(velocities.contrasts).enumerate() {
            let (vx, vy) = velocities.of(index, interface.nodes());
            for (i, (z, t)) in interface.position.iter().zip(&interface.tangent).enumerate() {
                sum += z * ((vx[i] * t.im - vy[i] * t.re) * contrast * interface.weight());
            }
        }
        self.mean = sum * (4.0 * PI / self.area());
    }

    fn add_field(&self, _index: usize, flow: &mut Flow) {
        flow.velocity += self.mean;
    }
}
