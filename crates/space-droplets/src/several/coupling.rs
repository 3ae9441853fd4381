//! The flow between droplets, and the equation for their velocities.

use sphere_harmonics::count;
use stokes_boundary_integrals::internal::each_share;

use super::{Row, SpaceDroplets};
use crate::SpaceError;
use crate::close::{add_direct, add_direct_double, nearest, nearest_on_grid};
use crate::droplet::{fields, slices};
use crate::flow::{MOST_ITERATIONS, TOLERANCE, converged};
use crate::layers::Vectors;
use crate::surface::{at, dot, put};

/// Exponent of the error of the plain sum over the fine grid: closer targets are integrated about their nearest point.
const DIGITS: f64 = 22.0;

impl SpaceDroplets {
    /// Solves for the velocities of droplets of which some have another viscosity inside, and computes the rates.
    pub(super) fn solve(&mut self) -> Result<(), SpaceError> {
        self.right.clear();
        for droplet in &mut self.droplets {
            droplet.update_right()?;
            self.right.extend_from_slice(&droplet.flow.right);
        }
        self.solution.resize(self.right.len(), 0.0);
        let viscosities = self.droplets[0].viscosities;
        let (mut gmres, right) = (std::mem::take(&mut self.gmres), std::mem::take(&mut self.right));
        let mut solution = std::mem::take(&mut self.solution);
        let matrix = |x: &[f64], out: &mut [f64], _accuracy: f64| self.product(x, out);
        let outcome = gmres.solve(matrix, &right, &mut solution, TOLERANCE, MOST_ITERATIONS);
        (self.gmres, self.right, self.solution) = (gmres, right, solution);
        converged(outcome, viscosities)?;
        let mut start = 0;
        for droplet in &mut self.droplets {
            let len = droplet.flow.velocities.len();
            droplet.flow.velocities.copy_from_slice(&self.solution[start..start + len]);
            droplet.flow.iterations = outcome.iterations;
            start += len;
            droplet.update_all_rates()?;
        }
        Ok(())
    }

    /// Writes the product with the matrix of all droplets: the double layer of each at itself and at the others.
    fn product(&mut self, x: &[f64], out: &mut [f64]) {
        let mut start = 0;
        let mut parts = Vec::with_capacity(self.droplets.len());
        for (droplet, source) in self.droplets.iter_mut().zip(&mut self.sources) {
            let n = count(droplet.degree);
            let range = start..start + 3 * n;
            start = range.end;
            let [inside, outside] = droplet.viscosities;
            if inside == outside {
                out[range.clone()].iter_mut().zip(&x[range.clone()]).for_each(|(out, x)| *out = outside * x);
            } else {
                droplet.product(&x[range.clone()], &mut out[range.clone()]);
                // The lengths fit: transforms cannot fail.
                for (field, values) in fields(&x[range.clone()], n).iter().zip(&mut source.velocities) {
                    let _ = droplet.surface.grid.backward(field, values);
                }
            }
            parts.push(range);
        }
        for to in 0..self.droplets.len() {
            let [mut sum, mut part] = std::mem::take(&mut self.sources[to].doubles);
            sum.iter_mut().for_each(|list| list.fill(0.0));
            for (from, other) in self.droplets.iter().enumerate() {
                let [inside, outside] = other.viscosities;
                if from == to || inside == outside {
                    continue;
                }
                self.double_of_other(from, to, &x[parts[from].clone()], &mut part);
                for (sum, part) in sum.iter_mut().zip(&part) {
                    sum.iter_mut().zip(part).for_each(|(sum, part)| *sum += (outside - inside) * part);
                }
            }
            let droplet = &mut self.droplets[to];
            let n = count(droplet.degree);
            for (values, out) in sum.iter().zip(out[parts[to].clone()].chunks_exact_mut(n)) {
                let mut field = std::mem::take(&mut droplet.flow.scalar_concentration);
                let _ = droplet.nodes.forward(values, &mut field);
                out.iter_mut().zip(&field).for_each(|(out, value)| *out -= value);
                droplet.flow.scalar_concentration = field;
            }
            self.sources[to].doubles = [sum, part];
        }
    }

    /// Writes the double layer of one droplet, with these coefficients of its velocity, at the nodes of another.
    fn double_of_other(&self, from: usize, to: usize, x: &[f64], out: &mut Vectors) {
        let (source, here) = (&self.sources[from], &self.sources[to]);
        out.iter_mut().for_each(|list| list.fill(0.0));
        add_direct_double(&source.places, [&source.normals, &source.velocities], &here.nodes, here.position, out);
        let [x, y, z] = fields(x, x.len() / 3);
        for row in self.rows[to].iter().filter(|row| row.from == from) {
            let mut sums = [0.0; 3];
            for (k, [xx, xy, xz, yy, yz, zz]) in row.row.iter().enumerate() {
                sums[0] += xx * x[k] + xy * y[k] + xz * z[k];
                sums[1] += xy * x[k] + yy * y[k] + yz * z[k];
                sums[2] += xz * x[k] + yz * y[k] + zz * z[k];
            }
            put(out, row.node, sums);
        }
    }

    /// The flow of all other droplets at the nodes of each.
    pub(super) fn couple(&mut self) -> Result<(), SpaceError> {
        let external = self.droplets.iter_mut().map(|droplet| std::mem::take(&mut droplet.flow.external));
        let mut flows: Vec<_> = external.enumerate().map(|(to, flow)| (to, flow, Ok(Vec::new()))).collect();
        let all = &*self;
        each_share(&mut flows, |(to, flow, outcome)| *outcome = all.flow_of_others(*to, flow));
        for (to, flow, outcome) in flows {
            self.droplets[to].flow.external = flow;
            self.rows[to] = outcome?;
        }
        Ok(())
    }

    /// Writes the single layers of all others at the nodes of a droplet, and returns the rows of their double layers at
    /// close nodes.
    fn flow_of_others(&self, to: usize, flow: &mut Vectors) -> Result<Vec<Row>, SpaceError> {
        flow.iter_mut().for_each(|list| list.fill(0.0));
        let (here, own) = (&self.droplets[to], &self.sources[to]);
        let (mut close, mut rows) = (Vec::new(), Vec::new());
        for (from, other) in self.droplets.iter().enumerate().filter(|(from, _)| *from != to) {
            let source = &self.sources[from];
            let threshold = DIGITS / (4 * other.degree + 2) as f64 * other.radius;
            close.clear();
            for k in 0..here.flow.at_nodes[0].len() {
                let place = self.relative(to, from, at(&here.flow.at_nodes, k));
                if dot(place, place).sqrt() < source.reach + threshold {
                    let (start, distance) = nearest_on_grid(&other.surface, place);
                    if distance <= -threshold {
                        return Err(self.overlap(from, to));
                    }
                    if distance < threshold {
                        close.push((k, place, start));
                    }
                }
            }
            let before: Vec<[f64; 3]> = close.iter().map(|(k, ..)| at(flow, *k)).collect();
            add_direct(&source.places, &source.forces, &here.flow.at_nodes, own.position, flow);
            let n = count(other.degree);
            for ((k, place, start), before) in close.iter().zip(before) {
                let positions = fields(&other.state, n);
                let found = nearest(positions, *place, *start)?;
                if found.distance <= 0.0 {
                    return Err(self.overlap(from, to));
                }
                let velocity = self.close[from].single(positions, slices(&other.flow.forces), *place, &found)?;
                put(flow, *k, std::array::from_fn(|i| before[i] + velocity[i]));
                if other.viscosities[0] != other.viscosities[1] {
                    let normals = slices(&other.flow.normals);
                    let row = self.close[from].double_row(positions, normals, *place, &found)?;
                    rows.push(Row { from, node: *k, row });
                }
            }
        }
        Ok(rows)
    }
}
