//! The flow between droplets, and the equation for their velocities.

use std::sync::PoisonError;

use sphere_harmonics::count;
use stokes_boundary_integrals::internal::{each_share, gmres::Outcome};

use super::{Near, Row, SpaceDroplets};
use crate::SpaceError;
use crate::close::{add_direct, add_direct_double, nearest, nearest_on_grid};
use crate::droplet::{fields, slices};
use crate::flow::{MOST_ITERATIONS, TOLERANCE, converged};
use crate::layers::Vectors;
use crate::reflections::Reflecting;
use crate::surface::{at, dot, put, vectors};
use crate::surroundings::{Source, Sources, Targets, emptied, lists, lists_mut};

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
        let kept = std::mem::take(&mut self.solved);
        let viscosities = self.droplets[0].viscosities;
        let right = std::mem::take(&mut self.right);
        let mut solution = std::mem::take(&mut self.solution);
        solution.resize(right.len(), 0.0);
        let outcome = if kept {
            Ok(Outcome::default())
        } else if self.surroundings.is_some() {
            let mut reflections = std::mem::take(&mut self.reflections);
            let outcome = reflections.solve(self, &right, &mut solution);
            if outcome.is_ok() {
                reflections.guess.keep(&solution);
            }
            self.reflections = reflections;
            outcome
        } else {
            let mut gmres = std::mem::take(&mut self.gmres);
            let matrix = |x: &[f64], out: &mut [f64], _accuracy: f64| self.free(x, out);
            let outcome = gmres.solve(matrix, &right, &mut solution, TOLERANCE, MOST_ITERATIONS);
            self.gmres = gmres;
            Ok(outcome)
        };
        (self.right, self.solution) = (right, solution);
        let outcome = outcome?;
        converged(outcome, viscosities)?;
        for (droplet, part) in self.droplets.iter_mut().zip(&self.parts) {
            droplet.flow.velocities.copy_from_slice(&self.solution[part.clone()]);
            droplet.flow.iterations = outcome.iterations;
            droplet.update_all_rates()?;
        }
        Ok(())
    }

    /// Takes over the velocities of droplets of another viscosity on their grids.
    pub(super) fn load(&mut self, x: &[f64]) {
        for ((droplet, source), part) in self.droplets.iter_mut().zip(&mut self.sources).zip(&self.parts) {
            if droplet.contrast() != 0.0 {
                source.load(&mut droplet.surface.grid, droplet.viscosities, &x[part.clone()]);
            }
        }
    }

    /// Adds the double layers of images at nodes close to them, less their sums over the grid, to `source.doubles` for
    /// velocities x, or to `flow.external` for the guess of the solution.
    pub(super) fn add_close_images(&mut self, x: Option<&[f64]>) {
        let mut nears = std::mem::take(&mut self.nears);
        for near in &mut nears {
            let to = near.to;
            let mut flow = match x {
                Some(_) => std::mem::replace(&mut self.sources[to].doubles[0], vectors(0)),
                None => std::mem::replace(&mut self.droplets[to].flow.external, vectors(0)),
            };
            self.add_rows(near, x.unwrap_or(&self.solution), true, &mut flow);
            match x {
                Some(_) => self.sources[to].doubles[0] = flow,
                None => self.droplets[to].flow.external = flow,
            }
        }
        self.nears = nears;
    }

    /// Adds the double layers of droplets, or of images, at nodes close to them, less the sums over their grids.
    fn add_rows(&self, near: &mut Near, x: &[f64], images: bool, flow: &mut Vectors) {
        let here = &self.sources[near.to];
        let Near { rows, used, place, velocity, .. } = near;
        for row in rows[..*used].iter().filter(|row| row.image.is_some() == images) {
            let (source, droplet) = (&self.sources[row.from], &self.droplets[row.from]);
            let [x, y, z] = fields(&x[self.parts[row.from].clone()], count(droplet.degree));
            let mut sums = [0.0; 3];
            for (k, [xx, xy, xz, yy, yz, zz]) in row.row.iter().enumerate() {
                sums[0] += xx * x[k] + xy * y[k] + xz * z[k];
                sums[1] += xy * x[k] + yy * y[k] + yz * z[k];
                sums[2] += xz * x[k] + yz * y[k] + zz * z[k];
            }
            put(place, 0, at(&here.nodes, row.node));
            velocity.iter_mut().for_each(|list| list.fill(0.0));
            let shift = row.image.unwrap_or_default();
            let origin = std::array::from_fn(|i| here.position[i] - shift[i]);
            add_direct_double(&source.places, [&source.normals, &source.velocities], place, origin, velocity);
            let (before, plain) = (at(flow, row.node), at(velocity, 0));
            put(flow, row.node, std::array::from_fn(|i| before[i] + droplet.contrast() * sums[i] - plain[i]));
        }
    }

    /// Writes the double layers of all others, times the difference of their viscosities, at the nodes of a droplet.
    fn doubles_of_others(&self, near: &mut Near, x: &[f64]) {
        let here = &self.sources[near.to];
        let mut doubles = std::mem::replace(&mut near.doubles, vectors(0));
        doubles.iter_mut().for_each(|list| list.fill(0.0));
        for (from, (other, source)) in self.droplets.iter().zip(&self.sources).enumerate() {
            if from != near.to && other.contrast() != 0.0 {
                let stresslets = [&source.normals, &source.velocities];
                add_direct_double(&source.places, stresslets, &here.nodes, here.position, &mut doubles);
            }
        }
        self.add_rows(near, x, false, &mut doubles);
        near.doubles = doubles;
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

impl Reflecting for SpaceDroplets {
    /// Writes the product with the matrix of all droplets: the double layer of each at itself and at the others.
    fn free(&mut self, x: &[f64], out: &mut [f64]) {
        self.load(x);
        for (droplet, part) in self.droplets.iter_mut().zip(&self.parts) {
            let (x, out) = (&x[part.clone()], &mut out[part.clone()]);
            if droplet.contrast() == 0.0 {
                out.iter_mut().zip(x).for_each(|(out, x)| *out = droplet.viscosities[1] * x);
            } else {
                droplet.product(x, out);
            }
        }
        let mut nears = std::mem::take(&mut self.nears);
        let all = &*self;
        each_share(&mut nears, |near| all.doubles_of_others(near, x));
        for ((near, droplet), part) in nears.iter().zip(&mut self.droplets).zip(&self.parts) {
            droplet.subtract(&near.doubles, &mut out[part.clone()]);
        }
        self.nears = nears;
    }

    /// Writes the product with the double layers that the surroundings reflect.
    fn reflected(&mut self, x: &[f64], out: &mut [f64], accuracy: f64) -> Result<(), SpaceError> {
        out.fill(0.0);
        self.load(x);
        let Self { droplets, sources, surroundings, lent, .. } = self;
        let Some(surroundings) = surroundings else { return Ok(()) };
        let surroundings = surroundings.get_mut().unwrap_or_else(PoisonError::into_inner);
        let (mut all, mut targets) =
            (emptied(std::mem::take(&mut lent.sources)), emptied(std::mem::take(&mut lent.targets)));
        for (source, droplet) in sources.iter_mut().zip(&*droplets) {
            let Source { places, normals, velocities, lab_nodes, doubles, .. } = source;
            doubles[0].iter_mut().for_each(|list| list.fill(0.0));
            if droplet.contrast() != 0.0 {
                let [places, normals, velocities] = [&*places, &*normals, &*velocities].map(lists);
                all.push(Sources::Stresslets { places, normals, velocities });
            }
            targets.push(Targets { places: lists(lab_nodes), flow: lists_mut(&mut doubles[0]) });
        }
        let outcome = surroundings.add_rough_flow(&all, &mut targets, accuracy);
        (lent.sources, lent.targets) = (emptied(all), emptied(targets));
        self.add_close_images(Some(x));
        for ((droplet, source), part) in self.droplets.iter_mut().zip(&self.sources).zip(&self.parts) {
            droplet.subtract(&source.doubles[0], &mut out[part.clone()]);
        }
        outcome
    }
}
