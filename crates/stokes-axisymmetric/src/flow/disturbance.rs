//! Disturbances of an interface of revolution that vary as cos(m phi) around the axis.

use std::f64::consts::PI;

use motile_base::{Vec2, same_length, within};
use nalgebra::{DMatrix, DVector};

use super::{
    AxisymmetricFlow,
    container::{Tube, Walls, poiseuille},
    meridian::{Grid, Half, Meridian},
    panels::{Panels, Source, Spot},
    ring::Wanted,
    waves::{Pair, Waves},
};
use crate::refusal::{not_one_interface, singular_surfaces};
use stokes_boundary_integrals::{LayerError, internal::DenseFactors};

/// Largest order: the integrals over the azimuth take 16 points for every panel of a few waves.
const MOST_ORDER: f64 = 8.0;
/// Length of a panel of the integral over the azimuth, in the variable v of `theta = (d/sqrt(r r0)) sinh(v)`, in which
/// the nearest singularities are at the distance of pi/2 from the real axis.
const PANEL: f64 = 2.2;

/// Vector along the axis, from it and around it, as the target sees it.
type Space = [f64; 3];

/// Velocities on an interface of revolution that small disturbances of its shape and of the forces on it cause.
///
/// Displacements and forces have components along and from the axis that vary as cos(m phi) with the azimuth, and one
/// around it that varies as sin(m phi). Every ring of the undisturbed surface is a ring of displaced points, and
/// velocities are those at the displaced points less those at the points that they come from.
#[derive(Debug, Clone)]
pub struct Disturbances {
    order: usize,
    grid: Grid,
    half: Half,
    /// Velocities at the nodes, x, r (and phi) of all, by the coefficients of the forces and of the displacements.
    by_forces: DMatrix<f64>,
    by_shape: DMatrix<f64>,
}

/// Rows of the layers at a target for its components of velocity, by coefficients of the source: forces, velocities,
/// displacements.
struct Rows {
    forces: [Vec<f64>; 3],
    velocities: [Vec<f64>; 3],
    shape: [Vec<f64>; 3],
}

/// Points of a layer and of its target that are displaced.
#[derive(Debug, Clone, Copy)]
enum Displaced<'a> {
    /// Points and target on the same surface, the waves of the target.
    Both(&'a Waves),
    /// The points alone.
    Source,
    /// The target alone, with its waves and their surface's number of waves.
    Target(&'a Waves, usize),
    Nothing,
}

/// Integrals over the azimuth for the three components at the target.
#[derive(Default)]
struct Kernels {
    /// By forces and by velocities on the ring.
    forces: [Space; 3],
    velocities: [Space; 3],
    /// By displacements of the ring less the displacements of the target, along and from the axis; by the displacements
    /// of the ring; and by the slopes of these.
    differences: [[f64; 2]; 3],
    places: [[f64; 2]; 3],
    slopes: [[f64; 2]; 3],
}

fn dot(a: Space, b: Space) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Returns true for cosines, false for sines: components of displacements and velocities, along, from and around the
/// axis.
fn even(order: usize) -> [bool; 3] {
    let even = order.is_multiple_of(2);
    [even, !even, !even]
}

/// Waves of a component: cosines start at 0, sines at 1.
fn of(waves: &Waves, cosine: bool, count: usize) -> &[f64] {
    if cosine { &waves.cos[..count] } else { &waves.sin[1..=count] }
}

/// Integrals for a point of a quadrature, with the velocity on it and the contrast of the double layer if there is one.
fn kernels(
    order: usize,
    gauss: &[(f64, f64)],
    source: &Source<'_>,
    target: f64,
    force: Vec2,
    double: Option<(f64, Vec2)>,
) -> Kernels {
    let mut sum = Kernels::default();
    let (Vec2 { x, y: r }, radius) = (source.ring.offset(), source.point.place.y);
    let (tangent, normal) = (source.point.tangent, source.point.normal());
    let distance = x * x + r * r;
    let scale = (distance / (radius * target)).sqrt();
    let last = (PI / scale).asinh();
    let panels = (last / PANEL).ceil().max(1.0);
    for panel in 0..panels as usize {
        for (u, weight) in gauss {
            let v = last / panels * (panel as f64 + u);
            let (growth, theta) = (v.exp(), scale * v.sinh());
            let weight = 2.0 * weight * last / panels * scale * 0.5 * (growth + 1.0 / growth);
            let (sh, ch) = (0.5 * theta).sin_cos();
            let (sin, w) = (2.0 * sh * ch, 2.0 * sh * sh);
            let cos = 1.0 - w;
            let (mut half_sin, mut half_cos) = (0.0, 1.0);
            for _ in 0..order {
                (half_sin, half_cos) = (half_sin * ch + half_cos * sh, half_cos * ch - half_sin * sh);
            }
            let (s, less) = (2.0 * half_sin * half_cos, 2.0 * half_sin * half_sin);
            let c = 1.0 - less;
            let d = [x, r - radius * w, radius * sin];
            let inverse = 1.0 / (distance + 2.0 * radius * target * w);
            let root = inverse.sqrt();
            let (third, fifth) = (inverse * root, inverse * inverse * root);
            // The ring's own directions, and d along them.
            let axes = [[1.0, 0.0, 0.0], [0.0, cos, sin], [0.0, -sin, cos]];
            let along = [x, r + target * w, target * sin];
            let vector = |a: Vec2| [a.x, a.y * cos, a.y * sin];
            let project = |a: Vec2| a.x * x + a.y * along[1];
            let turn = [[c, c, s], [c, c, s], [-s, -s, c]];
            let (g, dg) = (vector(force), project(force));
            // Derivative of the velocity by d, the direction last.
            let mut slope = [[0.0; 3]; 3];
            for i in 0..3 {
                for k in 0..3 {
                    slope[i][k] = (d[i] * g[k] - g[i] * d[k]) * third - 3.0 * d[i] * dg * d[k] * fifth;
                }
                slope[i][i] += dg * third;
                for b in 0..3 {
                    sum.forces[i][b] += weight * turn[i][b] * (axes[b][i] * root + d[i] * along[b] * third);
                }
            }
            if let Some((contrast, velocity)) = double {
                let (q, dq) = (vector(velocity), project(velocity));
                let (n, dn) = (vector(radius * normal), radius * project(normal));
                let factor = -6.0 * contrast * fifth;
                for i in 0..3 {
                    for k in 0..3 {
                        let both = q[k] * dn + dq * n[k] - 5.0 * dq * dn * d[k] * inverse;
                        slope[i][k] += factor * both * d[i];
                    }
                    slope[i][i] += factor * dq * dn;
                    let of_normal = along.map(|along| weight * factor * dq * along * d[i]);
                    for b in 0..3 {
                        sum.velocities[i][b] += weight * turn[i][b] * factor * along[b] * dn * d[i];
                    }
                    let [c, _, s] = turn[i];
                    let m = order as f64;
                    sum.slopes[i][0] -= radius * of_normal[1] * c;
                    sum.slopes[i][1] += radius * of_normal[0] * c;
                    sum.places[i][0] += m * tangent.y * of_normal[2] * s;
                    sum.places[i][1] += (tangent.y * of_normal[0] - tangent.x * of_normal[1]) * c;
                    sum.places[i][1] -= m * tangent.x * of_normal[2] * s;
                }
            }
            for (i, [x, r, around]) in slope.into_iter().enumerate().take(2) {
                sum.differences[i][0] += weight * x;
                sum.differences[i][1] += weight * r;
                sum.places[i][0] -= weight * less * x;
                sum.places[i][1] += weight * (c * sin * around - (less + c * w) * r);
            }
            sum.places[2][0] -= weight * s * slope[2][0];
            sum.places[2][1] -= weight * s * dot(axes[1], slope[2]);
        }
    }
    sum
}

impl Rows {
    fn new(waves: usize, of_shape: usize) -> Self {
        let rows = |count: usize| [0; 3].map(|_| vec![0.0; count]);
        Self { forces: rows(3 * waves), velocities: rows(3 * waves), shape: rows(2 * of_shape) }
    }

    /// Adds the layers of a surface at a spot, with the solution on it and the contrast if it has a double layer.
    fn add(
        &mut self,
        order: usize,
        (grid, meridian): (&Grid, &Meridian),
        double: Option<(f64, &Pair)>,
        spot: &Spot,
        displaced: Displaced<'_>,
        panels: &mut Panels,
    ) {
        let n = grid.nodes;
        let gauss = panels.gauss.clone();
        let even = even(order);
        let [mut difference, mut slope] = [vec![0.0; n], vec![0.0; n]];
        panels.each((grid, meridian), spot, Wanted::Both, |source| {
            let force = source.force_on(meridian);
            let double = double.map(|(contrast, solution)| {
                let velocity = Vec2::new(
                    super::waves::dot(&solution.cos, &source.waves.cos),
                    super::waves::dot(&solution.sin, &source.waves.sin),
                );
                (contrast, velocity)
            });
            let kernels = kernels(order, &gauss, &source, spot.place.y, force, double);
            let weight = source.weight;
            let components = if order == 0 { 2 } else { 3 };
            if let Displaced::Target(waves, count) = displaced {
                for (b, cosine) in even.into_iter().enumerate().take(2) {
                    let waves = of(waves, cosine, count);
                    for i in 0..components {
                        let factor = -weight * kernels.differences[i][b];
                        add(&mut self.shape[i][count * b..count * (b + 1)], factor, waves);
                    }
                }
            }
            for (b, cosine) in even.into_iter().enumerate().take(components) {
                let forces = of(source.waves, !cosine, n);
                let waves = of(source.waves, cosine, n);
                for i in 0..components {
                    let range = n * b..n * (b + 1);
                    add(&mut self.forces[i][range.clone()], weight * kernels.forces[i][b], forces);
                    if double.is_some() {
                        add(&mut self.velocities[i][range], weight * kernels.velocities[i][b], waves);
                    }
                }
            }
            if matches!(displaced, Displaced::Target(..) | Displaced::Nothing) {
                return;
            }
            for (b, cosine) in even.into_iter().enumerate().take(2) {
                let waves = of(source.waves, cosine, n);
                let range = if cosine { 0..n } else { 1..n + 1 };
                match (displaced, source.halves) {
                    (Displaced::Both(_), Some([middle, half])) => {
                        let (sign, middle) = if cosine { (-2.0, &middle.sin) } else { (2.0, &middle.cos) };
                        let pairs = middle[range.clone()].iter().zip(&half.sin[range.clone()]);
                        difference.iter_mut().zip(pairs).for_each(|(out, (middle, half))| *out = sign * middle * half);
                    }
                    (Displaced::Both(target), None) => {
                        let pairs = waves.iter().zip(of(target, cosine, n));
                        difference.iter_mut().zip(pairs).for_each(|(out, (at, target))| *out = at - target);
                    }
                    _ => difference.copy_from_slice(waves),
                }
                if double.is_some() {
                    let (sign, waves) = if cosine { (-1.0, &source.waves.sin) } else { (1.0, &source.waves.cos) };
                    for (out, k) in slope.iter_mut().zip(range) {
                        *out = sign * k as f64 * waves[k];
                    }
                }
                for i in 0..components {
                    let row = &mut self.shape[i][n * b..n * (b + 1)];
                    add(row, weight * kernels.differences[i][b], &difference);
                    add(row, weight * kernels.places[i][b], waves);
                    if double.is_some() {
                        add(row, weight * kernels.slopes[i][b], &slope);
                    }
                }
            }
        });
    }
}

/// Matrices of the rows of all targets, component by component, in the order of [`Rows`].
struct Layers {
    forces: DMatrix<f64>,
    velocities: DMatrix<f64>,
    shape: DMatrix<f64>,
}

impl Layers {
    /// Layers of a surface at targets, for the rows of each of them.
    fn new(components: usize, [targets, waves, of_shape]: [usize; 3], mut rows: impl FnMut(usize, &mut Rows)) -> Self {
        let zeros = |columns: usize| DMatrix::zeros(components * targets, columns);
        let (forces, velocities) = (zeros(components * waves), zeros(components * waves));
        let mut layers = Self { forces, velocities, shape: zeros(2 * of_shape) };
        for target in 0..targets {
            let mut row = Rows::new(waves, of_shape);
            rows(target, &mut row);
            let Self { forces, velocities, shape } = &mut layers;
            for (matrix, rows) in [(forces, &row.forces), (velocities, &row.velocities), (shape, &row.shape)] {
                for (i, row) in rows.iter().enumerate().take(components) {
                    let columns = matrix.ncols();
                    let mut out = matrix.row_mut(targets * i + target);
                    out.iter_mut().zip(&row[..columns]).for_each(|(out, value)| *out = *value);
                }
            }
        }
        layers
    }
}

fn add(row: &mut [f64], factor: f64, waves: &[f64]) {
    row.iter_mut().zip(waves).for_each(|(row, wave)| *row += factor * wave);
}

/// Coefficients of values at the nodes.
fn analyse(grid: &Grid, cosine: bool, values: &[f64], out: &mut [f64]) {
    let n = grid.nodes;
    out.fill(0.0);
    for (waves, value) in grid.waves.iter().zip(values) {
        add(out, 2.0 / n as f64 * value, of(waves, cosine, n));
    }
    out[if cosine { 0 } else { n - 1 }] *= 0.5;
}

impl Disturbances {
    /// Returns the parameters of the nodes, from 0 at the pole of the largest x to pi at the other one.
    #[must_use]
    pub fn parameters(&self) -> &[f64] {
        &self.grid.parameters
    }

    /// Writes the velocities (length per time) at the nodes, along, from and around the axis, for displacements
    /// (length) along and from it, and for changes of the force per parameter and azimuth (force), at the nodes. Of the
    /// order 0 the components around the axis have no part.
    ///
    /// # Errors
    /// Returns an error for lists of another length than the number of nodes.
    pub fn velocities(
        &self,
        displacements: [&[f64]; 2],
        forces: [&[f64]; 3],
        out: [&mut [f64]; 3],
    ) -> Result<(), LayerError> {
        let (n, even) = (self.grid.nodes, even(self.order));
        let lengths = displacements.iter().chain(&forces).map(|list| list.len());
        lengths.chain(out.iter().map(|list| list.len())).try_for_each(|len| same_length("values at nodes", n, len))?;
        let components = self.by_forces.nrows() / n;
        let (mut shape, mut pull) = (DVector::zeros(2 * n), DVector::zeros(components * n));
        for (b, values) in displacements.into_iter().enumerate() {
            analyse(&self.grid, even[b], values, &mut shape.as_mut_slice()[n * b..n * (b + 1)]);
        }
        for (b, values) in forces.into_iter().enumerate().take(components) {
            analyse(&self.grid, !even[b], values, &mut pull.as_mut_slice()[n * b..n * (b + 1)]);
        }
        let velocities = &self.by_forces * pull + &self.by_shape * shape;
        for (out, values) in out.into_iter().zip(velocities.as_slice().chunks_exact(n)) {
            out.copy_from_slice(values);
        }
        Ok(())
    }

    /// Computes velocities of order 0 for displacements (length) and forces (force) at the points that the interface
    /// was given by, closed curves with forces on halves of rings as in [`AxisymmetricFlow::load`].
    ///
    /// # Errors
    /// Returns an error for lists of another length than the number of points.
    pub fn velocities_at_points(
        &self,
        displacements: &[Vec2],
        forces: &[Vec2],
        out: &mut [Vec2],
    ) -> Result<(), LayerError> {
        let (n, count) = (self.grid.nodes, 2 * self.half.intervals());
        [displacements.len(), forces.len(), out.len()]
            .into_iter()
            .try_for_each(|len| same_length("values at points", count, len))?;
        let (mut shape, mut force) = (Pair::new(n + 1), Pair::new(n + 1));
        self.half.analyse(n, |k| displacements[k].into(), &mut shape);
        let factor = count as f64 / (2.0 * PI * PI);
        self.half.analyse(n, |k| (factor * forces[k].y, factor * forces[k].x), &mut force);
        let list = |a: &[f64], b: &[f64]| DVector::from_iterator(2 * n, a[..n].iter().chain(&b[1..=n]).copied());
        let pull = DVector::from_iterator(2 * n, force.sin[1..=n].iter().chain(&force.cos[..n]).copied());
        let velocities = &self.by_forces * pull + &self.by_shape * list(&shape.cos, &shape.sin);
        let (x, r) = velocities.as_slice().split_at(n);
        let mut series = Pair::new(n + 1);
        self.grid.analyse(x, r, &mut series);
        for k in 0..=self.half.intervals() {
            let (x, r) = self.half.value(&series, n.min(self.half.intervals()) + 1, k);
            (out[k], out[(count - k) % count]) = (Vec2::new(x, r), Vec2::new(x, -r));
        }
        (out[0].y, out[count / 2].y) = (0.0, 0.0);
        Ok(())
    }
}

impl AxisymmetricFlow {
    /// Returns the velocities that small disturbances of an order m cause on the interface of the last solution, in
    /// unbounded fluid or in a container: the derivative of the equations of the flow. With d from a target to a
    /// source, the stress kernel K and the vector N of the area, a disturbance changes
    ///
    /// ```text
    /// G(d) g            by   G(d) g' + (d'.grad) G(d) g
    /// K(d)[u, N]        by   K(d)[u', N] + (d'.grad) K(d)[u, N] + K(d)[u, N'],       N' = X'_t x X_phi + X_t x X'_phi
    /// ```
    ///
    /// integrated over the azimuth with cos(m phi) or sin(m phi) on panels on which the kernels are smooth.
    ///
    /// # Errors
    /// Returns an error for anything but one interface, an order above 8, or equations that are singular to round-off.
    pub fn disturbances(&mut self, order: usize) -> Result<Disturbances, LayerError> {
        within("the order of a disturbance", order as f64, 0.0, MOST_ORDER)?;
        let Self { viscosity, grid, panels, surfaces, sides, walls, tube, flux, solution, .. } = self;
        let (n, even) = (grid.nodes, even(order));
        let ([meridian], [sides]) = (surfaces.as_slice(), sides.as_slice()) else {
            return Err(not_one_interface(surfaces.len()));
        };
        if sides.inside.is_none() {
            return Err(not_one_interface(0));
        }
        let components = if order == 0 { 2 } else { 3 };
        let contrast = sides.contrast();
        let double = (contrast != 0.0).then(|| (contrast, &solution[0]));
        let surface = (&*grid, meridian);
        let mut layers = Layers::new(components, [n; 3], |j, rows| {
            let (place, waves) = (meridian.nodes[j].place, &grid.waves[j]);
            let spot = Spot { place, foot: grid.parameters[j], offset: Vec2::ZERO, gap: 0.0 };
            rows.add(order, surface, double, &spot, Displaced::Both(waves), panels);
        });
        if let Some(Tube { radius, .. }) = tube {
            for (j, node) in meridian.nodes.iter().enumerate() {
                let slope = 8.0 * PI * *viscosity * *flux * poiseuille(*radius, node.place.y)[1];
                for (k, wave) in of(&grid.waves[j], even[1], n).iter().enumerate() {
                    layers.shape[(j, n + k)] += slope * wave;
                }
            }
        }
        let values = DMatrix::from_fn(components * n, components * n, |row, column| {
            let b = row / n;
            if b == column / n { of(&grid.waves[row % n], even[b], n)[column % n] } else { 0.0 }
        });
        let mean = 8.0 * PI * sides.mean();
        let mut left = mean * &values - &layers.velocities;
        if let Some(walls) = walls {
            let Walls { grid: wall, meridian: sides, panels: beside, factors: kept, shift, .. } = &mut **walls;
            let (wall, shift, count) = ((&*wall, &*sides), *shift, wall.nodes);
            let onto = Layers::new(components, [n, count, n], |j, rows| {
                let spot = wall.1.spot(wall.0, meridian.nodes[j].place - shift, beside);
                rows.add(order, wall, None, &spot, Displaced::Target(&grid.waves[j], n), beside);
            });
            let mut from = Layers::new(components, [count, n, n], |j, rows| {
                let spot = meridian.spot(grid, wall.1.nodes[j].place + shift, panels);
                rows.add(order, surface, double, &spot, Displaced::Source, panels);
            });
            let factors = (order > 0).then(|| {
                let own = Layers::new(components, [count, count, 0], |j, rows| {
                    let place = wall.1.nodes[j].place;
                    let spot = Spot { place, foot: wall.0.parameters[j], offset: Vec2::ZERO, gap: 0.0 };
                    rows.add(order, wall, None, &spot, Displaced::Nothing, beside);
                });
                DenseFactors::new(own.forces)
            });
            let Layers { forces, velocities, shape } = &mut from;
            for matrix in [forces, velocities, shape] {
                let factors = factors.as_ref().unwrap_or(kept);
                if !factors.is_regular() {
                    return Err(LayerError::singular_walls());
                }
                factors.solve(matrix);
            }
            layers.forces -= &onto.forces * from.forces;
            layers.shape += onto.shape - &onto.forces * from.shape;
            left += &onto.forces * from.velocities;
        }
        let Layers { mut forces, mut shape, .. } = layers;
        if contrast == 0.0 {
            forces /= mean;
            shape /= mean;
        } else {
            let factors = left.lu();
            if !(factors.solve_mut(&mut forces) && factors.solve_mut(&mut shape)) {
                return Err(singular_surfaces());
            }
            (forces, shape) = (&values * forces, &values * shape);
        }
        let half = Half::new(meridian.points / 2);
        Ok(Disturbances { order, grid: grid.clone(), half, by_forces: forces, by_shape: shape })
    }
}
