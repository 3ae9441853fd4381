//! The flow of many nodes at points anywhere, with its gradient and pressure.
//!
//! In terms of d = source minus target the smooth part has the kernels of [`Kernels`] with `e_1 = g conj(d)^2` and
//! `c_1 = (2 g + s g') conj(d)`, s = |d|^2 and g' = dg/ds; the others are derivatives of these.

use std::f64::consts::PI;

use motile_base::Vec2;
use num_complex::Complex64;

use super::{Ewald, columns::Part, polynomial::value, split::derivatives};
use crate::{
    curve::Curve,
    density::Density,
    greens::{Flow, Kernels, free},
    shares,
};

/// Largest distance of a node from a point, in units of the cut-off, below which the node is left out: nearer ones,
/// whose flow others take away again, would leave their round-off.
const LEFT_OUT: f64 = 0.05;

/// The smooth part of the Green's function with its derivatives, in units of the cut-off.
#[derive(Debug, Clone)]
pub(super) struct Smooth {
    /// b + ln r_c, and g with its derivatives by s, as powers of 2 s - 1.
    even: Vec<f64>,
    radial: [Vec<f64>; 3],
}

impl Smooth {
    fn new(tolerance: f64) -> Self {
        let [even, g, slope, bend] = derivatives(tolerance);
        Self { even, radial: [g, slope, bend] }
    }

    /// Kernels without the smooth part at d, in units of a cut-off of that length; the smooth part alone, with the
    /// other sign, of a node that is `left_out`.
    fn near(&self, d: Complex64, square: f64, cutoff: f64, left_out: bool) -> Kernels {
        let at = |powers: &[f64]| value(powers, 2.0 * square - 1.0);
        let (b, [g, slope, bend]) = (at(&self.even), self.radial.each_ref().map(|powers| at(powers)));
        let (first, second) = (2.0 * g + square * slope, 3.0 * slope + square * bend);
        let conj = d.conj();
        let mut kernels = Kernels {
            log: b + 0.5 * g * square - cutoff.ln(),
            c: [-first * conj, second * conj * conj, Complex64::ZERO],
            e: [-g * conj * conj, slope * conj.powi(3), -0.5 * bend * conj.powi(4)],
            background: first + square * second,
        };
        if !left_out {
            let free = free(d);
            kernels.log += free.log + cutoff.ln();
            kernels.c.iter_mut().zip(free.c).for_each(|(own, free)| *own += free);
            kernels.e.iter_mut().zip(free.e).for_each(|(own, free)| *own += free);
        }
        let unit = 1.0 / cutoff;
        kernels.c[0] *= unit;
        kernels.c[1] *= unit * unit;
        kernels.e[1] *= unit;
        kernels.e[2] *= unit * unit;
        kernels.background *= unit * unit;
        kernels
    }
}

impl Ewald {
    /// Writes the flow at points, the single layers of all curves less the double layers, without the flow in free
    /// space of nodes that [`Ewald::leaves_out`], none of which is as far as `nearest` (length).
    pub(crate) fn sample(
        &mut self,
        curves: &[Curve],
        density: Density<'_>,
        points: &[Vec2],
        nearest: f64,
        out: &mut Vec<Flow>,
    ) {
        self.left_out = (LEFT_OUT * self.cutoff).min(nearest);
        self.place(curves);
        let places = points.iter().map(|point| [point.x, point.y]);
        self.targets.sort(&self.lattice, self.cutoff, false, places);
        out.clear();
        out.resize(self.targets.points.len(), Flow::default());
        self.load_forces(curves, 0..curves.len());
        self.carry(2);
        self.add_sampled(false, out);
        if self.width.is_some() {
            self.lift_pressure(curves, out);
        }
        if let Some(cluster) = &mut self.cluster {
            cluster.remove_forces_at([&self.nodes[0], &self.nodes[1]], points, out);
        }
        if !density.vanishes() {
            self.load_dipoles(curves, density);
            self.carry(3);
            self.add_sampled(true, out);
            if self.width.is_some() {
                // The same of pairs of forces.
                let [xx, _, yy] = self.nodes.each_ref().map(|array| array.iter().sum::<f64>());
                let lift = 4.0 * PI * (xx - yy) / self.lattice.area();
                out.iter_mut().for_each(|flow| flow.pressure -= lift);
            }
            if let Some(cluster) = &mut self.cluster {
                cluster.place(curves);
                cluster.remove_dipoles_at(self.nodes.each_ref().map(Vec::as_slice), points, out);
            }
        }
    }

    /// Adds to the pressure around a row of images what that in a box lacks, `4 pi F_y (y - y')/area` of a force at y',
    /// which balances the background force of the box.
    fn lift_pressure(&self, curves: &[Curve], out: &mut [Flow]) {
        let slope = 4.0 * PI / self.lattice.area();
        let heights = curves.iter().flat_map(|curve| curve.nodes.position.iter().map(|z| z.im + curve.centre.im));
        let [mut force, mut moment] = [0.0; 2];
        for (y, across) in heights.zip(&self.nodes[1]) {
            force += across;
            moment += across * y;
        }
        for (entry, point) in self.targets.points.iter().enumerate() {
            // Heights in the box are those above its lower side.
            let y = self.targets.y[entry] * self.cutoff;
            let y = if y > 0.5 * self.lattice.lengths[1] { y - self.lattice.lengths[1] } else { y };
            out[*point as usize].pressure += slope * (force * y - moment);
        }
    }

    /// Returns true for a node so close to a point that samples there do without its flow in free space.
    pub(crate) fn leaves_out(&self, from: Complex64) -> bool {
        from.norm_sqr() < self.left_out.powi(2)
    }

    /// Adds the flow at the points of what the entries carry.
    fn add_sampled(&mut self, double: bool, out: &mut [Flow]) {
        let sign = if double { -1.0 } else { 1.0 };
        for part in [Part::Velocity, Part::Strain, Part::Pull] {
            self.spread(double, part);
            let Self { rows, targets, window, .. } = self;
            shares::each(rows, |share| {
                share.begin(targets);
                share.interpolate(targets, window);
            });
            for share in rows {
                let entries = share.entries(targets);
                for ((entry, u), v) in entries.zip(&share.flow[0]).zip(&share.flow[1]) {
                    let (flow, value) = (&mut out[targets.points[entry] as usize], sign * Complex64::new(*u, *v));
                    match part {
                        Part::Velocity => flow.velocity += value,
                        Part::Strain => flow.strain += value,
                        Part::Pull => {
                            flow.spin += Complex64::new(0.0, value.im);
                            flow.pressure -= 2.0 * value.re;
                        }
                    }
                }
            }
        }
        let Self { smooth, tolerance, cells, targets, carried: [a, b, c], cutoff, left_out, .. } = self;
        let least = (*left_out / *cutoff).powi(2);
        let smooth = smooth.get_or_insert_with(|| Smooth::new(*tolerance));
        let [columns, rows] = targets.counts();
        for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
            for target in targets.cell(column, row) {
                let flow = &mut out[targets.points[target] as usize];
                let place = Complex64::new(targets.x[target], targets.y[target]);
                for source in cells.around(column, row).flatten() {
                    let d = Complex64::new(cells.x[source], cells.y[source]) - place;
                    let square = d.norm_sqr();
                    if square >= 1.0 {
                        continue;
                    }
                    let kernels = smooth.near(d, square, *cutoff, square < least);
                    if double {
                        // v n = -i v z' as complex numbers, and v.n.
                        let product = Complex64::new(-b[source], a[source] - c[source]);
                        flow.add_products(&kernels, product, Complex64::new(0.0, -2.0 * (a[source] + c[source])));
                    } else {
                        flow.add_force(&kernels, Complex64::new(a[source], b[source]), 1.0);
                    }
                }
            }
        }
    }
}
