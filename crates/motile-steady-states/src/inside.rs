//! Particles inside a droplet that are exchanged with its interface: well mixed, or carried along and diffusing.

use std::f64::consts::{PI, TAU};

use motile::active_interface::Exchange;
use motile::setup::Particles;
use motile_base::{Vec2, internal::gauss_legendre};
use nalgebra::{DMatrix, DVector, Dyn, LU};

use crate::SteadyError;
use crate::flow::Flow;
use crate::iteration::{CONTRACTION, MOST_ITERATIONS};

/// Degree of the polynomials that a field inside is made of, and points of the quadrature from the centre to a node.
/// Densities inside are smooth: at a Peclet number of 10 the error is 1e-8.
const DEGREE: usize = 16;
const RADIAL_POINTS: usize = DEGREE + 4;
/// Relative correction of a field below which it is found.
const ROUND_OFF: f64 = 1e-13;

/// Particles inside a droplet.
#[derive(Debug)]
pub(crate) struct Inside {
    pub(crate) exchange: Exchange,
    /// Area that they are spread over (length squared).
    area: f64,
    /// Number of particles on the interface and inside.
    pub(crate) total: f64,
    /// Concentration of the circle at rest (particles per length).
    pub(crate) at_rest: f64,
    /// Their densities, where they are not well mixed.
    pub(crate) field: Option<Field>,
}

impl Inside {
    /// Returns the inside of a droplet of that radius (length) and so many nodes; `None` if nothing is exchanged.
    pub(crate) fn new(particles: &Particles, radius: f64, nodes: usize) -> Result<Option<Self>, SteadyError> {
        let exchanges = |binding: f64, unbinding: f64| binding > 0.0 || unbinding > 0.0;
        let Some(setup) = particles.exchange.filter(|setup| exchanges(setup.binding, setup.unbinding)) else {
            return Ok(None);
        };
        let exchange = Exchange::new(setup.binding, setup.unbinding)?;
        let (perimeter, area) = (TAU * radius, PI * radius * radius);
        let density = |on| exchange.concentration_at_rest(on).unwrap_or(f64::INFINITY);
        let inside = setup.number_inside.unwrap_or_else(|| density(particles.concentration) * area);
        let total = perimeter * particles.concentration + inside;
        if setup.diffusion_inside.is_some() && setup.binding == 0.0 {
            return Err(SteadyError::unsupported(
                "particles diffuse inside that never bind",
                "Use a positive rate of binding, or leave out the diffusion constant inside",
            ));
        }
        let field = setup.diffusion_inside.map(|diffusion| Field::new(diffusion, exchange, nodes));
        Ok(Some(Self { exchange, area, total, at_rest: total / (perimeter + density(1.0) * area), field }))
    }

    /// Returns the number of particles inside with so many on the interface.
    pub(crate) fn number(&self, on: f64) -> f64 {
        self.field.as_ref().map_or(self.total - on, |field| field.number)
    }

    /// Returns the density of particles inside next to a node (particles per area), with so many on the interface.
    pub(crate) fn density(&self, on: f64, node: usize) -> f64 {
        self.field.as_ref().map_or_else(|| self.number(on) / self.area, |field| field.wall[node])
    }
}

/// Interface that a field is at rest with: nodes, derivatives by the parameter, concentrations.
#[derive(Clone, Copy)]
pub(crate) struct Wall<'a> {
    pub(crate) positions: &'a [Vec2],
    pub(crate) tangents: &'a [Vec2],
    pub(crate) concentrations: &'a [f64],
}

/// Density b of particles inside that is steady in the moving frame, for the flow w relative to it:
///
/// ```text
/// div(b w - D grad b) = 0,   -D db/dn = k_on b - k_off c on the interface
/// ```
///
/// A polynomial, by Galerkin's method: for each polynomial p of the degree, `INT (D grad b - b w).grad p dA + INT
/// (k_on b - k_off c) p ds = 0`. With p = 1 as many particles bind as unbind, to round-off. The equations are linear in
/// b and change little from one state to the next: they are solved by corrections with the matrix of an earlier state.
#[derive(Debug)]
pub(crate) struct Field {
    diffusion: f64,
    exchange: Exchange,
    /// Points and weights of the quadrature on (0, 1).
    rule: Vec<(f64, f64)>,
    points: Vec<Vec2>,
    weights: DVector<f64>,
    flow: Vec<Vec2>,
    /// Polynomials and their derivatives at the points, and on the interface: a column each.
    values: [DMatrix<f64>; 3],
    on_wall: [DMatrix<f64>; 3],
    coefficients: DVector<f64>,
    factors: Option<LU<f64, Dyn, Dyn>>,
    /// Density at the nodes of the interface (particles per area).
    pub(crate) wall: Vec<f64>,
    /// Number of particles inside.
    pub(crate) number: f64,
}

impl Field {
    fn new(diffusion: f64, exchange: Exchange, nodes: usize) -> Self {
        let count = (DEGREE + 1) * (DEGREE + 2) / 2;
        let points = nodes * RADIAL_POINTS;
        let matrices = |rows: usize| std::array::from_fn(|_| DMatrix::zeros(rows, count));
        Self {
            diffusion,
            exchange,
            rule: gauss_legendre(RADIAL_POINTS)
                .into_iter()
                .map(|(x, weight)| (0.5 * (1.0 + x), 0.5 * weight))
                .collect(),
            points: vec![Vec2::ZERO; points],
            weights: DVector::zeros(points),
            flow: vec![Vec2::ZERO; points],
            values: matrices(points),
            on_wall: matrices(nodes),
            coefficients: DVector::zeros(count),
            factors: None,
            wall: vec![0.0; nodes],
            number: 0.0,
        }
    }

    /// Solves for the field of an interface whose flow is solved for, in a frame of that velocity.
    pub(crate) fn solve(
        &mut self,
        wall: Wall<'_>,
        flow: &mut Flow,
        frame: impl Fn(Vec2) -> Vec2,
    ) -> Result<(), SteadyError> {
        let step = TAU / wall.positions.len() as f64;
        let centre = wall.positions.iter().sum::<Vec2>() / wall.positions.len() as f64;
        for (j, (x, tangent)) in wall.positions.iter().zip(wall.tangents).enumerate() {
            let arm = *x - centre;
            for (q, (r, weight)) in self.rule.iter().enumerate() {
                let point = j * RADIAL_POINTS + q;
                self.points[point] = centre + *r * arm;
                self.weights[point] = r * weight * arm.perp_dot(*tangent) * step;
            }
        }
        flow.velocities_inside(&self.points, &mut self.flow)?;
        self.flow.iter_mut().zip(&self.points).for_each(|(w, x)| *w -= frame(*x));
        let unit = wall.positions.iter().map(|x| x.distance(centre)).fold(0.0, f64::max);
        polynomials(&self.points, centre, unit, &mut self.values);
        polynomials(wall.positions, centre, unit, &mut self.on_wall);
        let lengths = DVector::from_iterator(wall.positions.len(), wall.tangents.iter().map(|t| t.length() * step));
        let on = DVector::from_row_slice(wall.concentrations);
        let (mut before, mut renewed) = (f64::INFINITY, false);
        for _ in 0..MOST_ITERATIONS {
            let factors = self.factors.take().unwrap_or_else(|| {
                renewed = true;
                self.matrix(&lengths).lu()
            });
            let correction = factors
                .solve(&self.residual(&on, &lengths))
                .ok_or_else(|| SteadyError::singular("the particles inside", "Use other rates of exchange"))?;
            let size = correction.amax();
            let stalled = size > CONTRACTION * before;
            if stalled && !renewed {
                // The matrix is too old: the same iteration with a new one.
                before = f64::INFINITY;
                continue;
            }
            self.coefficients -= correction;
            self.factors = Some(factors);
            if stalled || size <= ROUND_OFF * self.coefficients.amax() {
                break;
            }
            before = size;
        }
        self.wall.copy_from_slice((&self.on_wall[0] * &self.coefficients).as_slice());
        self.number = (&self.values[0] * &self.coefficients).dot(&self.weights);
        Ok(())
    }

    /// Returns the residual of the equations for each polynomial (1/time).
    fn residual(&self, on: &DVector<f64>, lengths: &DVector<f64>) -> DVector<f64> {
        let [b, bx, by] = self.values.each_ref().map(|matrix| matrix * &self.coefficients);
        let flux = |slope: &DVector<f64>, along: fn(&Vec2) -> f64| -> DVector<f64> {
            let points = self.flow.iter().zip(slope.iter()).zip(b.iter().zip(self.weights.iter()));
            let values = points.map(|((w, slope), (b, weight))| weight * (self.diffusion * slope - along(w) * b));
            DVector::from_iterator(b.len(), values)
        };
        let [_, px, py] = &self.values;
        let lost = self.exchange.binding() * (&self.on_wall[0] * &self.coefficients) - self.exchange.unbinding() * on;
        px.tr_mul(&flux(&bx, |w| w.x))
            + py.tr_mul(&flux(&by, |w| w.y))
            + self.on_wall[0].tr_mul(&lost.component_mul(lengths))
    }

    /// Returns the derivatives of the residual by the coefficients.
    fn matrix(&self, lengths: &DVector<f64>) -> DMatrix<f64> {
        let flux = |slopes: &DMatrix<f64>, along: fn(&Vec2) -> f64| {
            let mut flux = self.diffusion * slopes;
            for (mut column, values) in flux.column_iter_mut().zip(self.values[0].column_iter()) {
                for (k, flux) in column.iter_mut().enumerate() {
                    *flux = self.weights[k] * (*flux - along(&self.flow[k]) * values[k]);
                }
            }
            flux
        };
        let [_, px, py] = &self.values;
        let mut bound = self.exchange.binding() * &self.on_wall[0];
        bound.column_iter_mut().for_each(|mut column| column.component_mul_assign(lengths));
        px.tr_mul(&flux(px, |w| w.x)) + py.tr_mul(&flux(py, |w| w.y)) + self.on_wall[0].tr_mul(&bound)
    }
}

/// Products of Legendre polynomials in x and y over a unit of length about a centre, with their derivatives by x and y
/// (1/length).
fn polynomials(points: &[Vec2], centre: Vec2, unit: f64, [values, by_x, by_y]: &mut [DMatrix<f64>; 3]) {
    let mut columns = 0..;
    let [x, y] = [|point: Vec2| point.x, |point: Vec2| point.y]
        .map(|along| points.iter().map(|point| legendre(along((*point - centre) / unit), unit)).collect::<Vec<_>>());
    for (i, j) in (0..=DEGREE).flat_map(|i| (0..=DEGREE - i).map(move |j| (i, j))) {
        let column = columns.next().unwrap_or_default();
        for k in 0..points.len() {
            let ([p, dp], [q, dq]) = (x[k][i], y[k][j]);
            values[(k, column)] = p * q;
            by_x[(k, column)] = dp * q;
            by_y[(k, column)] = p * dq;
        }
    }
}

/// Returns the Legendre polynomials at a place over a unit of length, with their derivatives by the length.
fn legendre(x: f64, unit: f64) -> [[f64; 2]; DEGREE + 1] {
    let mut all = [[1.0, 0.0]; DEGREE + 1];
    all[1] = [x, 1.0 / unit];
    for n in 1..DEGREE {
        let (m, [[before, slope_before], [now, _]]) = (n as f64, [all[n - 1], all[n]]);
        let next = ((2.0 * m + 1.0) * x * now - m * before) / (m + 1.0);
        all[n + 1] = [next, slope_before + (2.0 * m + 1.0) * now / unit];
    }
    all
}

#[cfg(test)]
mod tests;
