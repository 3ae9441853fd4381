//! The flow of a droplet, its forces, and its rates of change.

use std::f64::consts::{PI, TAU};

use motile_base::internal::Refuse;
use sphere_harmonics::{Grid, count};
use stokes_boundary_integrals::internal::gmres::Outcome;

use crate::droplet::{EdgeFollowing, fields, slices};
use crate::layers::{Layers, Vectors};
use crate::reflections::Reflecting;
use crate::surface::{Surface, at, dot, put, vectors};
use crate::surroundings::Around;
use crate::{SpaceDroplet, SpaceError};

/// Residual of the equation for two viscosities, over its right-hand side.
pub(crate) const TOLERANCE: f64 = 1e-12;
/// Most iterations for two viscosities.
pub(crate) const MOST_ITERATIONS: usize = 200;

/// The flow of the present state, and memory for it.
#[derive(Debug, Clone)]
pub(crate) struct Flow {
    pub(crate) known: bool,
    /// The velocities were taken from a saved state of the present one.
    pub(crate) solved: bool,
    /// Concentrations, tensions and their slopes, on the fine grid.
    pub(crate) concentrations: Vec<f64>,
    pub(crate) tensions: Vec<f64>,
    /// Coefficients of the force per area of the unit sphere.
    pub(crate) forces: Vectors,
    /// Coefficients of the velocity in the laboratory, one component after the other.
    pub(crate) velocities: Vec<f64>,
    /// The velocity on the fine grid.
    pub(crate) values: Vectors,
    pub(crate) velocity: [f64; 3],
    /// The rates of change of the state.
    pub(crate) rates: Vec<f64>,
    pub(crate) iterations: usize,
    /// Positions of the nodes in the frame, later velocities there.
    pub(crate) at_nodes: Vectors,
    /// The flow of other droplets at the nodes, times the viscosity outside.
    pub(crate) external: Vectors,
    results: Vectors,
    pub(crate) right: Vec<f64>,
    pub(crate) normals: Vectors,
    mesh: Vectors,
    particles: Vec<f64>,
    gradient: [Vec<f64>; 2],
    tangential: [Vec<f64>; 2],
    scalar: Vec<f64>,
    /// Coefficients of the concentration.
    pub(crate) scalar_concentration: Vec<f64>,
}

impl SpaceDroplet {
    /// Computes the surface, its forces and the places of the nodes.
    pub(crate) fn prepare(&mut self) -> Result<(), SpaceError> {
        self.update_surface()?;
        self.update_forces()?;
        let n = count(self.degree);
        for (field, values) in fields(&self.state, n).iter().zip(&mut self.flow.at_nodes) {
            self.nodes.backward(field, values)?;
        }
        self.layers.place(&self.flow.at_nodes);
        if self.viscosities[0] != self.viscosities[1] {
            for (values, field) in self.surface.normals.iter().zip(&mut self.flow.normals) {
                self.surface.grid.forward(values, field)?;
            }
        }
        if let Some(mut around) = self.around.take() {
            let outcome = around.apply(self);
            self.around = Some(around);
            outcome?;
        }
        Ok(())
    }

    /// Computes the velocities and the rates of what [`SpaceDroplet::prepare`] has prepared.
    pub(crate) fn finish(&mut self) -> Result<(), SpaceError> {
        self.update_right()?;
        self.solve()?;
        self.update_all_rates()
    }

    /// Computes the rates from the velocities.
    pub(crate) fn update_all_rates(&mut self) -> Result<(), SpaceError> {
        self.update_motion()?;
        self.update_transport()?;
        self.flow.known = true;
        Ok(())
    }

    /// Computes the geometry of the present state.
    pub(crate) fn update_surface(&mut self) -> Result<(), SpaceError> {
        let n = count(self.degree);
        self.surface.update(fields(&self.state, n))?;
        let volume = self.surface.volume();
        let smallest = self.surface.area.iter().fold(f64::INFINITY, |least, area| least.min(*area));
        let failed = |problem| Err(SpaceError::Shape { time: self.time, degree: self.degree, problem });
        if !volume.is_finite() || !self.state[3 * n..].iter().all(|value| value.is_finite()) {
            return failed("or the particles have values that are not finite numbers");
        }
        if volume <= 0.0 {
            return failed("encloses no volume, or it is turned inside out");
        }
        if smallest < 1e-6 * volume.cbrt().powi(2) {
            return failed("has parameters that crowd in a point or a fold");
        }
        Ok(())
    }

    /// Moves the frame to the centroid and restores the volume.
    pub(crate) fn centre(&mut self) {
        let n = count(self.degree);
        let volume = self.surface.volume();
        let centroid = self.surface.centroid(volume);
        let scale = (self.volume / volume).cbrt();
        for (i, shift) in centroid.iter().enumerate() {
            self.state[i * n] -= (4.0 * PI).sqrt() * shift;
            self.state[i * n..(i + 1) * n].iter_mut().for_each(|value| *value *= scale);
            self.state[4 * n + i] += shift;
        }
        self.flow.known = false;
    }

    /// Concentrations, tensions, and weak forces: `(fJ)_lm = - INT (gamma/J) [(H a - F b) d_theta Y + (E b - F a) d_phi
    /// Y/sin(theta)]`. Nothing is differentiated twice.
    fn update_forces(&mut self) -> Result<(), SpaceError> {
        let n = count(self.degree);
        let Self { surface, flow, state, tension, .. } = self;
        surface.grid.backward(&state[3 * n..4 * n], &mut flow.particles)?;
        for k in 0..flow.particles.len() {
            flow.concentrations[k] = flow.particles[k] / surface.area[k];
        }
        tension.values(&flow.concentrations, &mut flow.tensions);
        if let Some(k) = flow.tensions.iter().position(|tension| !tension.is_finite()) {
            let what = format!("the tension at the concentration {} is {}", flow.concentrations[k], flow.tensions[k]);
            return Err(SpaceError::refused(what, "", "Use a tension law that is finite at all concentrations"));
        }
        for i in 0..3 {
            for k in 0..flow.particles.len() {
                let tangents = [surface.along_theta[i][k], surface.along_phi[i][k]];
                let [theta, phi] = surface.contravariant(k, tangents);
                let scale = -flow.tensions[k] * surface.area[k];
                (flow.tangential[0][k], flow.tangential[1][k]) = (scale * theta, scale * phi);
            }
            let [theta, phi] = &flow.tangential;
            surface.grid.forward_gradient([theta, phi], &mut flow.forces[i])?;
        }
        Ok(())
    }

    /// The right-hand side for the velocities: the single layer, the imposed flow and the flow of others. For equal
    /// viscosities, also the velocities; otherwise, the matrix.
    pub(crate) fn update_right(&mut self) -> Result<(), SpaceError> {
        let n = count(self.degree);
        let [inside, outside] = self.viscosities;
        let Self { nodes, layers, flow, state, gradient, .. } = self;
        let positions = fields(state, n);
        layers.single(positions, slices(&flow.forces), &mut flow.results);
        spread(layers, nodes, &mut flow.results);
        let shift = [0, 1, 2].map(|i| state[4 * n + i]);
        for k in 0..nodes.len() {
            let place = at(&flow.at_nodes, k);
            let place = [0, 1, 2].map(|i| place[i] + shift[i]);
            for (i, row) in gradient.iter().enumerate() {
                flow.results[i][k] += outside * dot(*row, place) + flow.external[i][k];
            }
        }
        for (values, field) in flow.results.iter().zip(flow.right.chunks_exact_mut(n)) {
            nodes.forward(values, field)?;
        }
        flow.iterations = 0;
        if inside == outside {
            for (velocity, right) in flow.velocities.iter_mut().zip(&flow.right) {
                *velocity = right / outside;
            }
            return Ok(());
        }
        layers.prepare_double(positions, slices(&flow.normals));
        Ok(())
    }

    /// Writes the product with the matrix of a droplet of two viscosities to `out`.
    pub(crate) fn product(&mut self, x: &[f64], out: &mut [f64]) {
        let Self { nodes, layers, flow, .. } = self;
        product(nodes, layers, [&mut flow.at_nodes, &mut flow.results], self.viscosities, x, out);
    }

    /// Subtracts the coefficients of values at the nodes from a list.
    pub(crate) fn subtract(&mut self, values: &Vectors, out: &mut [f64]) {
        let Self { nodes, flow, degree, .. } = self;
        for (values, out) in values.iter().zip(out.chunks_exact_mut(count(*degree))) {
            // The lengths fit: transforms cannot fail.
            let _ = nodes.forward(values, &mut flow.scalar);
            out.iter_mut().zip(&flow.scalar).for_each(|(out, value)| *out -= value);
        }
    }

    /// Solves for the velocities of a droplet that is alone.
    fn solve(&mut self) -> Result<(), SpaceError> {
        let [inside, outside] = self.viscosities;
        if inside == outside || std::mem::take(&mut self.flow.solved) {
            return Ok(());
        }
        let Self { nodes, layers, flow, gmres, viscosities, around, surface, .. } = self;
        let Flow { at_nodes, results, scalar, right, velocities, .. } = flow;
        let outcome = if let Some(around) = around {
            let mut reflections = std::mem::take(&mut around.reflections);
            let (viscosities, grid) = (*viscosities, &mut surface.grid);
            let mut alone = Alone { nodes, layers, lists: [at_nodes, results], viscosities, grid, scalar, around };
            let outcome = reflections.solve(&mut alone, right, velocities);
            if outcome.is_ok() {
                reflections.guess.keep(velocities);
            }
            around.reflections = reflections;
            outcome?
        } else {
            let matrix = |x: &[f64], out: &mut [f64], _accuracy: f64| {
                product(nodes, layers, [&mut *at_nodes, &mut *results], *viscosities, x, out);
            };
            gmres.solve(matrix, right, velocities, TOLERANCE, MOST_ITERATIONS)
        };
        self.flow.iterations = outcome.iterations;
        converged(outcome, self.viscosities)
    }

    /// The velocity of the droplet, and the motion of its parameters.
    fn update_motion(&mut self) -> Result<(), SpaceError> {
        let leak = self.update_droplet_velocity()?;
        let n = count(self.degree);
        let Self { surface, flow, edge, radius, degree, .. } = self;
        if let Some(edge) = edge {
            follow(surface, flow, *edge, *radius, *degree)?;
        }
        for k in 0..surface.weights.len() {
            let normal = at(&surface.normals, k);
            let area = surface.area[k];
            let speed = (dot(flow.relative(k), normal) / area - leak) / area;
            let slide = if edge.is_some() { [flow.tangential[0][k], flow.tangential[1][k]] } else { [0.0; 2] };
            let (a, b) = (at(&surface.along_theta, k), at(&surface.along_phi, k));
            let mesh = std::array::from_fn(|i| speed * normal[i] + slide[0] * a[i] + slide[1] * b[i]);
            put(&mut flow.mesh, k, mesh);
        }
        for i in 0..3 {
            surface.grid.forward(&flow.mesh[i], &mut flow.rates[i * n..(i + 1) * n])?;
            surface.grid.backward(&flow.rates[i * n..(i + 1) * n], &mut flow.mesh[i])?;
            flow.rates[4 * n + i] = flow.velocity[i];
        }
        Ok(())
    }

    /// The velocity on the fine grid, the velocity of the droplet, and the slope of the concentration. Returns the mean
    /// normal velocity, which is the truncation error of the flux.
    fn update_droplet_velocity(&mut self) -> Result<f64, SpaceError> {
        let n = count(self.degree);
        let Self { surface, flow, .. } = self;
        for (i, values) in flow.values.iter_mut().enumerate() {
            surface.grid.backward(&flow.velocities[i * n..(i + 1) * n], values)?;
        }
        let volume = surface.volume();
        let through = |k: usize| dot(at(&flow.values, k), at(&surface.normals, k));
        let flux = surface.integral(through);
        let centroid = surface.centroid(volume);
        let moment = |i: usize| surface.integral(|k| surface.positions[i][k] * through(k));
        flow.velocity = std::array::from_fn(|i| (moment(i) - flux * centroid[i]) / volume);
        let leak = flux / surface.integral(|k| surface.area[k]);

        // The slope of the concentration, projected to the degree.
        surface.grid.forward(&flow.concentrations, &mut flow.scalar_concentration)?;
        surface.grid.backward_theta(&flow.scalar_concentration, &mut flow.gradient[0])?;
        surface.grid.backward_phi(&flow.scalar_concentration, &mut flow.gradient[1])?;
        Ok(leak)
    }

    /// The weak transport of particles, with the velocity of the parameters in `flow.mesh`.
    fn update_transport(&mut self) -> Result<(), SpaceError> {
        let n = count(self.degree);
        let Self { surface, flow, diffusivity, .. } = self;
        // Particles move with the fluid relative to the parameters, as these move after truncation.
        for k in 0..surface.weights.len() {
            let (velocity, mesh) = (flow.relative(k), at(&flow.mesh, k));
            let relative: [f64; 3] = std::array::from_fn(|i| velocity[i] - mesh[i]);
            let (a, b) = (at(&surface.along_theta, k), at(&surface.along_phi, k));
            let drift = surface.contravariant(k, [dot(relative, a), dot(relative, b)]);
            let slope = surface.contravariant(k, [flow.gradient[0][k], flow.gradient[1][k]]);
            for i in 0..2 {
                flow.tangential[i][k] = flow.particles[k] * drift[i] - *diffusivity * surface.area[k] * slope[i];
            }
        }
        let [theta, phi] = &flow.tangential;
        surface.grid.forward_gradient([theta, phi], &mut flow.rates[3 * n..4 * n])?;
        Ok(())
    }

    /// Computes the rates of a star shape from its radii; the parameters move along the radius. Writes the rates of the
    /// radii, and the rates of the particles to `flow.rates`.
    pub(crate) fn star_rates(
        &mut self,
        directions: &Vectors,
        radii: &[f64],
        rates: &mut [f64],
    ) -> Result<(), SpaceError> {
        let n = count(self.degree);
        self.flow.known = false;
        let Self { surface, flow, state, .. } = self;
        surface.grid.backward(radii, &mut flow.particles)?;
        for i in 0..3 {
            let products = flow.particles.iter().zip(&directions[i]).map(|(radius, direction)| radius * direction);
            flow.values[i].iter_mut().zip(products).for_each(|(position, product)| *position = product);
            surface.grid.forward(&flow.values[i], &mut state[i * n..(i + 1) * n])?;
        }
        self.prepare()?;
        self.update_right()?;
        self.solve()?;
        self.update_droplet_velocity()?;
        let Self { surface, flow, around, .. } = self;
        if around.is_some() {
            // Walls feel where the droplet is across the axis, so that a shift is a disturbance.
            flow.velocity[..2].fill(0.0);
        }
        for k in 0..surface.weights.len() {
            let normal = at(&surface.normals, k);
            flow.tangential[0][k] = dot(flow.relative(k), normal) / dot(at(directions, k), normal);
        }
        surface.grid.forward(&flow.tangential[0], rates)?;
        surface.grid.backward(rates, &mut flow.tangential[0])?;
        for (mesh, direction) in flow.mesh.iter_mut().zip(directions) {
            let products = flow.tangential[0].iter().zip(direction).map(|(rate, direction)| rate * direction);
            mesh.iter_mut().zip(products).for_each(|(mesh, product)| *mesh = product);
        }
        self.update_transport()
    }
}

/// The equation of a droplet that is alone in surroundings.
struct Alone<'a> {
    nodes: &'a mut Grid,
    layers: &'a mut Layers,
    lists: [&'a mut Vectors; 2],
    viscosities: [f64; 2],
    grid: &'a mut Grid,
    scalar: &'a mut Vec<f64>,
    around: &'a mut Around,
}

impl Reflecting for Alone<'_> {
    fn free(&mut self, x: &[f64], out: &mut [f64]) {
        let [at_nodes, results] = &mut self.lists;
        product(self.nodes, self.layers, [at_nodes, results], self.viscosities, x, out);
    }

    fn reflected(&mut self, x: &[f64], out: &mut [f64], accuracy: f64) -> Result<(), SpaceError> {
        let Self { nodes, viscosities, grid, scalar, around, .. } = self;
        around.source.load(grid, *viscosities, x);
        around.double(accuracy)?;
        for (values, out) in around.source.doubles[0].iter().zip(out.chunks_exact_mut(nodes.coefficients())) {
            nodes.forward(values, scalar)?;
            out.iter_mut().zip(&**scalar).for_each(|(out, value)| *out = -value);
        }
        Ok(())
    }
}

/// Writes `eta_out x - (eta_out - eta_in) D x` for the double layer D of one droplet.
fn product(
    nodes: &mut Grid,
    layers: &mut Layers,
    [at_nodes, results]: [&mut Vectors; 2],
    [inside, outside]: [f64; 2],
    x: &[f64],
    out: &mut [f64],
) {
    let n = nodes.coefficients();
    // The lengths fit: transforms cannot fail.
    let fields = fields(x, n);
    for (field, values) in fields.iter().zip(&mut *at_nodes) {
        let _ = nodes.backward(field, values);
    }
    layers.double(fields, at_nodes, results);
    spread(layers, nodes, results);
    for (values, field) in results.iter().zip(out.chunks_exact_mut(n)) {
        let _ = nodes.forward(values, field);
    }
    for (out, x) in out.iter_mut().zip(x) {
        *out = outside * x - (outside - inside) * *out;
    }
}

/// Refuses velocities that have not converged.
pub(crate) fn converged(outcome: Outcome, [inside, outside]: [f64; 2]) -> Result<(), SpaceError> {
    let Outcome { residual, iterations } = outcome;
    let failed = residual.is_nan() || residual > 10.0 * TOLERANCE;
    if failed { Err(SpaceError::NotConverged { inside, outside, residual, iterations }) } else { Ok(()) }
}

/// Completes an axisymmetric field of which the layers know a column of each hemisphere.
fn spread(layers: &Layers, nodes: &Grid, field: &mut Vectors) {
    if !layers.first_only {
        return;
    }
    let (rows, columns) = (nodes.rows(), nodes.columns());
    for row in 0..rows {
        let first = if row < rows.div_ceil(2) { 0 } else { columns / 2 };
        let [x, y, z] = at(field, row * columns + first);
        for column in 0..columns {
            let (sin, cos) = (TAU * (column as f64 - first as f64) / columns as f64).sin_cos();
            put(field, row * columns + column, [cos * x - sin * y, sin * x + cos * y, z]);
        }
    }
}

/// Writes the contravariant velocity of the parameters that makes the monitor uniform to `flow.tangential`. It is the
/// gradient of phi on the unit sphere over M J, with `phi_lm = (M J)_lm exp(-2 (l/p)^4)/(time l (l + 1))`.
fn follow(
    surface: &mut Surface,
    flow: &mut Flow,
    edge: EdgeFollowing,
    radius: f64,
    degree: usize,
) -> Result<(), SpaceError> {
    let [least, most] = flow
        .concentrations
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], &c| [c.min(least), c.max(most)]);
    // Below a range of a percent of the mean the particles have no edge.
    let range = (most - least).max(0.01 * most.abs());
    let scale = if range > 0.0 { edge.strength * radius / range } else { 0.0 };
    let monitor = &mut flow.mesh[0];
    for (k, monitor) in monitor.iter_mut().enumerate() {
        let slope = [flow.gradient[0][k], flow.gradient[1][k]];
        let [theta, phi] = surface.contravariant(k, slope);
        let square = slope[0] * theta + slope[1] * phi;
        *monitor = surface.area[k] * (1.0 + scale * scale * square).sqrt();
    }
    surface.grid.forward(monitor, &mut flow.scalar)?;
    for (place, value) in flow.scalar.iter_mut().enumerate() {
        let l = place.isqrt() as f64;
        let smooth = (-2.0 * (l / degree as f64).powi(4)).exp();
        *value *= if place == 0 { 0.0 } else { smooth / (edge.time * l * (l + 1.0)) };
    }
    let [theta, phi] = &mut flow.tangential;
    surface.grid.backward_theta(&flow.scalar, theta)?;
    surface.grid.backward_phi(&flow.scalar, phi)?;
    for k in 0..monitor.len() {
        theta[k] /= monitor[k];
        phi[k] /= monitor[k];
    }
    Ok(())
}

impl Flow {
    /// Returns the velocity at a point of the fine grid in the frame of the droplet.
    #[inline(always)]
    fn relative(&self, k: usize) -> [f64; 3] {
        std::array::from_fn(|i| self.values[i][k] - self.velocity[i])
    }

    /// Creates memory for n coefficients, and for so many nodes and points of the fine grid.
    pub(crate) fn new(n: usize, nodes: usize, fine: usize) -> Self {
        let list = |len: usize| vec![0.0; len];
        Self {
            known: false,
            solved: false,
            concentrations: list(fine),
            tensions: list(fine),
            forces: vectors(n),
            velocities: list(3 * n),
            values: vectors(fine),
            velocity: [0.0; 3],
            rates: list(4 * n + 3),
            iterations: 0,
            at_nodes: vectors(nodes),
            external: vectors(nodes),
            results: vectors(nodes),
            right: list(3 * n),
            normals: vectors(n),
            mesh: vectors(fine),
            particles: list(fine),
            gradient: [list(fine), list(fine)],
            tangential: [list(fine), list(fine)],
            scalar: list(n),
            scalar_concentration: list(n),
        }
    }
}
