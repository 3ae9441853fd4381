//! A doubly periodic box: free-space pairs and moments where interfaces are close, rows of images where they are not.

use std::f64::consts::{PI, TAU};

use ib_core::FlowError;
use num_complex::Complex64;

use crate::{
    expansion::{Binomials, Expansion, Moments},
    field::{FieldKernel, Flow},
    images::Images,
    interface::{Interface, Transforms},
    lattice::{Lattice, MOST_TERMS},
    lattice_kernel::LatticePair,
    layers::Pair,
    pair_kernel::FreePair,
    planes::Vectors,
    stress::Dipoles,
    surroundings::{NodeVelocities, Surroundings},
};

/// The images of a box.
#[derive(Debug)]
pub(crate) struct BoxFlow {
    periods: [f64; 2],
    tolerance: f64,
    lattice: Lattice,
    binomials: Binomials,
    expansion: Expansion,
    moments: Vec<Moments>,
    /// Power at which the expansion stops.
    degree: usize,
    products: Vec<Complex64>,
    fluxes: Vec<f64>,
    /// 4 pi/area times the sum of X v.n, for sampling.
    mean: Complex64,
}

impl BoxFlow {
    pub(crate) fn new(periods: [f64; 2], tolerance: f64) -> Self {
        Self {
            periods,
            tolerance,
            lattice: Lattice::new(periods),
            binomials: Binomials::new(MOST_TERMS),
            expansion: Expansion::default(),
            moments: Vec::new(),
            degree: 0,
            products: Vec::new(),
            fluxes: Vec::new(),
            mean: Complex64::default(),
        }
    }

    fn offset(&self, target: &Interface, source: &Interface) -> Complex64 {
        self.images().wrap(source.centre - target.centre)
    }

    /// The power at which the expansion between two interfaces can stop, if it can be used at all.
    fn degree(&self, target: &Interface, source: &Interface) -> Option<usize> {
        let reach = self.offset(target, source).norm() + target.radius + source.radius;
        self.lattice.degree(reach, self.tolerance)
    }

    /// Adds the smooth flow of the moments of all interfaces at all nodes.
    fn add_smooth(&mut self, interfaces: &[Interface], out: &mut [Vectors]) {
        for (a, (target, out)) in interfaces.iter().zip(out).enumerate() {
            let mut any = false;
            self.expansion.moments().clear(self.degree);
            for (b, source) in interfaces.iter().enumerate() {
                if self.degree(target, source).is_none() {
                    continue;
                }
                any = true;
                let shift = self.offset(target, source) / self.lattice.unit;
                let total = self.expansion.moments();
                if a == b {
                    total.add(&self.moments[b]);
                } else {
                    total.add_shifted(&self.moments[b], shift);
                }
            }
            if any {
                self.expansion.add_flow(&self.lattice, &self.binomials, &target.position, out);
            }
        }
    }

    /// 4 pi/area times the sum of X v.n over all nodes, with contrast and weight in the dipoles.
    fn mean_flow<'a>(&self, parts: impl Iterator<Item = (&'a Interface, &'a Dipoles)>) -> Complex64 {
        let mut sum = Complex64::default();
        for (interface, dipoles) in parts {
            for (i, z) in interface.position.iter().enumerate() {
                sum += z * (dipoles.xx[i] + dipoles.yy[i]);
            }
        }
        sum * (4.0 * PI / self.lattice.area)
    }
}

impl Surroundings for BoxFlow {
    fn images(&self) -> Images {
        Images { periods: self.periods.map(Some) }
    }

    fn wave(&self) -> Option<(f64, bool)> {
        Some((TAU / self.lattice.unit, self.periods[1] < self.periods[0]))
    }

    fn pair(&self, target: &Interface, source: &Interface) -> Pair {
        let offset = self.offset(target, source);
        let vector = [offset.re, offset.im];
        if self.degree(target, source).is_some() {
            Pair::Free(FreePair { offset: vector })
        } else {
            let across = if self.periods[1] < self.periods[0] { offset.re } else { offset.im };
            let reach = across.abs() + target.radius + source.radius;
            Pair::Lattice(LatticePair::new(self.periods, vector, reach, self.tolerance))
        }
    }

    fn prepare(&mut self, interfaces: &mut [Interface], _transforms: &mut Transforms) -> Result<(), FlowError> {
        let pairs = interfaces.iter().enumerate().flat_map(|(i, a)| interfaces[i..].iter().map(move |b| (a, b)));
        self.degree = pairs.filter_map(|(a, b)| self.degree(a, b)).max().unwrap_or(0);
        self.moments.resize_with(interfaces.len(), Moments::default);
        Ok(())
    }

    fn add_forces(&mut self, interfaces: &[Interface], out: &mut [Vectors]) {
        if self.degree == 0 {
            return;
        }
        for (interface, moments) in interfaces.iter().zip(&mut self.moments) {
            moments.clear(self.degree);
            self.expansion.forces(&self.lattice, &interface.position, &interface.force, moments);
        }
        self.add_smooth(interfaces, out);
    }

    fn add_dipoles(
        &mut self,
        interfaces: &[Interface],
        dipoles: &[Dipoles],
        _velocities: NodeVelocities<'_>,
        _transforms: &mut Transforms,
        out: &mut [Vectors],
    ) {
        if self.degree > 0 {
            for ((interface, dipoles), moments) in interfaces.iter().zip(dipoles).zip(&mut self.moments) {
                moments.clear(self.degree);
                self.products.clear();
                self.fluxes.clear();
                for i in 0..interface.nodes() {
                    self.products.push(Complex64::new(dipoles.xx[i] - dipoles.yy[i], dipoles.s[i]));
                    self.fluxes.push(dipoles.xx[i] + dipoles.yy[i]);
                }
                self.expansion.dipoles(&self.lattice, &interface.position, &self.products, &self.fluxes, moments);
            }
            self.add_smooth(interfaces, out);
        }
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
        self.mean = sum * (4.0 * PI / self.lattice.area);
    }

    fn add_field(&self, _index: usize, flow: &mut Flow) {
        flow.velocity += self.mean;
    }
}
