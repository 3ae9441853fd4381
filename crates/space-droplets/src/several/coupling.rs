//! The flow between droplets, and the equation for their velocities.

use std::sync::PoisonError;

use sphere_harmonics::count;
use stokes_boundary_integrals::internal::{each_share, gmres::Outcome};

use super::{Near, Row, SpaceDroplets};
use crate::close::{add_direct, add_direct_double, nearest, nearest_on_grid};
use crate::droplet::{fields, slices};
use crate::flow::{MOST_ITERATIONS, TOLERANCE, converged};
use crate::surface::{at, dot, put};
use crate::surroundings::{Source, Sources, Targets, emptied, lists, lists_mut};
use crate::{SpaceDroplet, SpaceError};

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
        let kept = std::mem::take(&mut self.solved);
        let viscosities = self.droplets[0].viscosities;
        let (mut gmres, right) = (std::mem::take(&mut self.gmres), std::mem::take(&mut self.right));
        let mut solution = std::mem::take(&mut self.solution);
        let mut failed = Ok(());
        let matrix = |x: &[f64], out: &mut [f64], _accuracy: f64| {
            self.product(x, out);
            if let Err(error) = self.reflect(out) {
                failed = Err(error);
            }
        };
        let outcome = if kept {
            Outcome::default()
        } else {
            gmres.solve(matrix, &right, &mut solution, TOLERANCE, MOST_ITERATIONS)
        };
        (self.gmres, self.right, self.solution) = (gmres, right, solution);
        failed?;
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
        self.parts.clear();
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
            self.parts.push(range);
        }
        let mut nears = std::mem::take(&mut self.nears);
        let all = &*self;
        each_share(&mut nears, |near| all.doubles_of_others(near, x));
        for (to, (near, droplet)) in nears.iter().zip(&mut self.droplets).enumerate() {
            let part = self.parts[to].clone();
            let n = count(droplet.degree);
            for (values, out) in near.doubles.iter().zip(out[part].chunks_exact_mut(n)) {
                let mut field = std::mem::take(&mut droplet.flow.scalar_concentration);
                let _ = droplet.nodes.forward(values, &mut field);
                out.iter_mut().zip(&field).for_each(|(out, value)| *out -= value);
                droplet.flow.scalar_concentration = field;
            }
        }
        self.nears = nears;
    }

    /// Adds the double layers that the surroundings reflect, of the velocities that [`SpaceDroplets::product`] has
    /// left.
    fn reflect(&mut self, out: &mut [f64]) -> Result<(), SpaceError> {
        let Self { droplets, sources, surroundings, lent, parts, .. } = self;
        let Some(surroundings) = surroundings else { return Ok(()) };
        let surroundings = surroundings.get_mut().unwrap_or_else(PoisonError::into_inner);
        for (droplet, source) in droplets.iter().zip(&mut *sources) {
            let [inside, outside] = droplet.viscosities;
            source.velocities.iter_mut().flatten().for_each(|value| *value *= outside - inside);
            source.doubles[0].iter_mut().for_each(|list| list.fill(0.0));
        }
        let (mut all, mut targets) =
            (emptied(std::mem::take(&mut lent.sources)), emptied(std::mem::take(&mut lent.targets)));
        for (source, droplet) in sources.iter_mut().zip(&*droplets) {
            let Source { places, normals, velocities, lab_nodes, doubles, .. } = source;
            if droplet.viscosities[0] != droplet.viscosities[1] {
                let [places, normals, velocities] = [&*places, &*normals, &*velocities].map(lists);
                all.push(Sources::Stresslets { places, normals, velocities });
            }
            targets.push(Targets { places: lists(lab_nodes), flow: lists_mut(&mut doubles[0]) });
        }
        let outcome = surroundings.add_flow(&all, &mut targets);
        (lent.sources, lent.targets) = (emptied(all), emptied(targets));
        for ((droplet, source), part) in droplets.iter_mut().zip(sources).zip(&*parts) {
            let SpaceDroplet { nodes, flow, degree, .. } = droplet;
            for (values, out) in source.doubles[0].iter().zip(out[part.clone()].chunks_exact_mut(count(*degree))) {
                // The lengths fit: transforms cannot fail.
                let _ = nodes.forward(values, &mut flow.scalar_concentration);
                out.iter_mut().zip(&flow.scalar_concentration).for_each(|(out, value)| *out -= value);
            }
        }
        outcome
    }

    /// Writes the double layers of all others, times the difference of their viscosities, at the nodes of a droplet.
    fn doubles_of_others(&self, near: &mut Near, x: &[f64]) {
        let here = &self.sources[near.to];
        let Near { to, doubles, part, rows, used, place, velocity, .. } = near;
        doubles.iter_mut().for_each(|list| list.fill(0.0));
        for (from, other) in self.droplets.iter().enumerate() {
            let [inside, outside] = other.viscosities;
            if inside == outside {
                continue;
            }
            let source = &self.sources[from];
            let stresslets = [&source.normals, &source.velocities];
            part.iter_mut().for_each(|list| list.fill(0.0));
            if from != *to {
                add_direct_double(&source.places, stresslets, &here.nodes, here.position, part);
            }
            let [x, y, z] = fields(&x[self.parts[from].clone()], count(other.degree));
            for row in rows[..*used].iter().filter(|row| row.from == from) {
                let mut sums = [0.0; 3];
                for (k, [xx, xy, xz, yy, yz, zz]) in row.row.iter().enumerate() {
                    sums[0] += xx * x[k] + xy * y[k] + xz * z[k];
                    sums[1] += xy * x[k] + yy * y[k] + yz * z[k];
                    sums[2] += xz * x[k] + yz * y[k] + zz * z[k];
                }
                if let Some(shift) = row.image {
                    // The surroundings have summed the image over the grid: the row takes its place.
                    put(place, 0, at(&here.nodes, row.node));
                    velocity.iter_mut().for_each(|list| list.fill(0.0));
                    let origin = std::array::from_fn(|i| here.position[i] - shift[i]);
                    add_direct_double(&source.places, stresslets, place, origin, velocity);
                    let (before, plain) = (at(part, row.node), at(velocity, 0));
                    sums = std::array::from_fn(|i| before[i] + sums[i] - plain[i]);
                }
                put(part, row.node, sums);
            }
            for (sum, part) in doubles.iter_mut().zip(&*part) {
                sum.iter_mut().zip(part).for_each(|(sum, part)| *sum += (outside - inside) * part);
            }
        }
    }

    /// The flow of all other droplets at the nodes of each.
    pub(super) fn couple(&mut self) -> Result<(), SpaceError> {
        let mut nears = std::mem::take(&mut self.nears);
        for (near, droplet) in nears.iter_mut().zip(&mut self.droplets) {
            std::mem::swap(&mut near.flow, &mut droplet.flow.external);
        }
        let all = &*self;
        each_share(&mut nears, |near| near.outcome = all.flow_of_others(near));
        let mut outcome = Ok(());
        for (near, droplet) in nears.iter_mut().zip(&mut self.droplets) {
            std::mem::swap(&mut near.flow, &mut droplet.flow.external);
            outcome = outcome.and(std::mem::replace(&mut near.outcome, Ok(())));
        }
        self.nears = nears;
        outcome
    }

    /// Lists the shifts by which one droplet, or an image of it, comes within a distance of another.
    pub(super) fn find_shifts(&self, from: usize, to: usize, distance: f64, shifts: &mut Vec<[f64; 3]>) {
        shifts.clear();
        if from != to {
            shifts.push([0.0; 3]);
        }
        if let Some(surroundings) = self.surroundings() {
            let (source, here) = (&self.sources[from], &self.sources[to]);
            let displacement = std::array::from_fn(|i| source.position[i] - here.position[i]);
            surroundings.images(displacement, source.reach + here.reach + distance, &mut |shift| shifts.push(shift));
        }
    }

    /// Computes the single layers of all others at the nodes of a droplet, and the rows of their double layers at close
    /// nodes. Images are in the flow of the surroundings, except that close ones are summed badly there.
    fn flow_of_others(&self, near: &mut Near) -> Result<(), SpaceError> {
        let Near { to, flow, shifts, close, rows, used, place: one, velocity: plain, work, .. } = near;
        flow.iter_mut().for_each(|list| list.fill(0.0));
        *used = 0;
        let (here, own) = (&self.droplets[*to], &self.sources[*to]);
        for (from, other) in self.droplets.iter().enumerate() {
            let source = &self.sources[from];
            let threshold = DIGITS / (4 * other.degree + 2) as f64 * other.radius;
            work.fit(other.degree)?;
            self.find_shifts(from, *to, threshold, shifts);
            for &shift in &*shifts {
                let image = shift != [0.0; 3];
                close.clear();
                for k in 0..here.flow.at_nodes[0].len() {
                    let place = self.relative(*to, from, at(&here.flow.at_nodes, k));
                    let place: [f64; 3] = std::array::from_fn(|i| place[i] - shift[i]);
                    if dot(place, place).sqrt() < source.reach + threshold {
                        let (start, distance) = nearest_on_grid(&other.surface, place);
                        if distance <= -threshold {
                            return Err(self.overlap(from, *to));
                        }
                        if distance < threshold {
                            close.push((k, place, start, at(flow, k)));
                        }
                    }
                }
                if !image {
                    add_direct(&source.places, &source.forces, &here.flow.at_nodes, own.position, flow);
                }
                for (k, place, start, before) in &mut *close {
                    let positions = fields(&other.state, count(other.degree));
                    let found = nearest(positions, *place, *start, &mut work.here)?;
                    if found.distance <= 0.0 {
                        return Err(self.overlap(from, *to));
                    }
                    let forces = slices(&other.flow.forces);
                    let mut close = self.close[from].single(positions, forces, *place, &found, work)?;
                    if image {
                        put(one, 0, at(&here.flow.at_nodes, *k));
                        plain.iter_mut().for_each(|list| list.fill(0.0));
                        let origin = std::array::from_fn(|i| own.position[i] - shift[i]);
                        add_direct(&source.places, &source.forces, one, origin, plain);
                        let sum = at(plain, 0);
                        close.iter_mut().zip(sum).for_each(|(close, sum)| *close -= sum);
                    }
                    put(flow, *k, std::array::from_fn(|i| before[i] + close[i]));
                    if other.viscosities[0] != other.viscosities[1] {
                        if rows.len() == *used {
                            rows.push(Row { from, node: *k, image: None, row: Vec::new() });
                        }
                        let row = &mut rows[*used];
                        *used += 1;
                        (row.from, row.node, row.image) = (from, *k, image.then_some(shift));
                        let normals = slices(&other.flow.normals);
                        self.close[from].double_row(positions, normals, *place, &found, work, &mut row.row)?;
                    }
                }
            }
        }
        Ok(())
    }
}
