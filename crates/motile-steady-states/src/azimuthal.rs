//! Stability of swimmers in three dimensions against disturbances that vary around the axis.

use std::f64::consts::PI;

use motile::active_interface::Tension;
use motile_base::{PeriodicSeries, Region, Vec2, within};
use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use crate::spectrum::{Eigenmode, NO_GROWTH, Spectrum, Symmetry, eigenvalues};
use crate::system::{Point, System};
use crate::{SteadyError, SteadyState};

/// Largest order: disturbances of m = 1 turn a swimmer, and disturbances of m = 2 flatten it.
const MOST_ORDER: f64 = 2.0;
/// Fraction of the waves of a disturbance off the axis that is kept. Products with normals alias higher ones to the
/// poles, where a displacement that does not vanish is a singular one, whose growth rate falls as the logarithm of the
/// nodes.
const KEPT: f64 = 11.0 / 12.0;
/// Speed, over the radius times the rate of diffusion, of a droplet that swims: one at rest cannot be turned.
const SLOWEST: f64 = 1e-9;

/// Undisturbed surface at nodes: t_j = pi (j + 1/2)/N on the meridian.
struct Surface {
    nodes: Vec<Node>,
    /// Matrices of derivatives by t of even and of odd functions of t.
    slopes: [DMatrix<f64>; 2],
}

/// Quantities of the undisturbed droplet at a node.
struct Node {
    place: Vec2,
    tangent: Vec2,
    normal: Vec2,
    /// |X_t| (length).
    stretch: f64,
    /// Curvatures along the meridian and around the axis (1/length), positive on a sphere.
    curvatures: [f64; 2],
    /// Velocity along the tangent in the frame of the droplet (length per time).
    slip: f64,
    /// Concentration (particles per area) and its slope along the meridian.
    concentration: f64,
    gradient: f64,
    /// Tension (force per length) and its slope by the concentration.
    tension: [f64; 2],
}

/// Returns the coefficients of waves of functions at the nodes: cosines start at 0, sines at 1.
fn wave(cosine: bool, k: usize, t: f64) -> (f64, f64) {
    let n = k as f64;
    let (s, c) = (n * t).sin_cos();
    if cosine { (c, -n * s) } else { (s, n * c) }
}

/// Returns the parameter of a node.
fn angle(node: usize, nodes: usize) -> f64 {
    PI * (node as f64 + 0.5) / nodes as f64
}

impl Surface {
    fn new(system: &System, speed: f64) -> Result<Self, SteadyError> {
        let model = &system.model;
        let (count, n) = (model.nodes(), model.nodes() / 2);
        let mut series = PeriodicSeries::new(count)?;
        // The values, first and second derivatives half an interval after the points.
        let mut shifted = |values: &dyn Fn(usize) -> Complex64, order: usize| -> Result<Vec<Complex64>, SteadyError> {
            series.analyse((0..count).map(values))?;
            (0..order).for_each(|_| series.differentiate());
            series.shift(PI / count as f64);
            Ok(series.values()[..n].to_vec())
        };
        let complex = |v: Vec2| Complex64::new(v.x, v.y);
        let vector = |z: &Complex64| Vec2::new(z.re, z.im);
        let [place, first, second] = [0, 1, 2].map(|order| shifted(&|k| complex(model.positions[k]), order));
        let (place, first, second) = (place?, first?, second?);
        let velocity = shifted(&|k| complex(model.velocities[k]), 0)?;
        let of_concentration = |k: usize| Complex64::new(model.concentrations[k], 0.0);
        let (concentration, gradient) = (shifted(&of_concentration, 0)?, shifted(&of_concentration, 1)?);
        let node = |j: usize| {
            let (place, slope) = (vector(&place[j]), vector(&first[j]));
            let stretch = slope.length();
            let tangent = slope / stretch;
            let normal = -tangent.perp();
            let c = concentration[j].re;
            Node {
                place,
                tangent,
                normal,
                stretch,
                curvatures: [-vector(&second[j]).dot(normal) / (stretch * stretch), normal.y / place.y],
                slip: (vector(&velocity[j]) - Vec2::new(speed, 0.0)).dot(tangent),
                concentration: c,
                gradient: gradient[j].re / stretch,
                tension: [model.law.value(c), model.law.slope(c)],
            }
        };
        let slopes = [true, false].map(|cosine| {
            let first = usize::from(!cosine);
            let values = DMatrix::from_fn(n, n, |j, k| wave(cosine, k + first, angle(j, n)).0);
            let slopes = DMatrix::from_fn(n, n, |j, k| wave(cosine, k + first, angle(j, n)).1);
            values.try_inverse().map(|inverse| slopes * inverse)
        });
        let [Some(even), Some(odd)] = slopes else { return Err(singular()) };
        Ok(Self { nodes: (0..n).map(node).collect(), slopes: [even, odd] })
    }

    /// Returns the derivative by t of values with the distance from the axis as a factor, even in t or odd. They are
    /// sin(t) times a function of the other parity, so that nothing comes out of the poles.
    fn slope(&self, even: bool, values: impl Fn(&Node, usize) -> f64) -> DVector<f64> {
        let n = self.nodes.len();
        let values = self.nodes.iter().enumerate().map(|(j, node)| values(node, j) / angle(j, n).sin());
        let values = DVector::from_iterator(n, values);
        let mut slopes = &self.slopes[usize::from(even)] * &values;
        for (j, (slope, value)) in slopes.iter_mut().zip(&values).enumerate() {
            let (s, c) = angle(j, n).sin_cos();
            *slope = s * *slope + c * value;
        }
        slopes
    }
}

fn singular() -> SteadyError {
    SteadyError::singular("the waves of a disturbance", "Use another number of nodes")
}

impl System {
    /// Returns the matrix of the rates (1/time) of disturbances of an order m about a steady state in three dimensions,
    /// of offsets eta along the normal and of the concentration c', both times cos(m phi).
    ///
    /// With the surface's tangent tau, normal n, curvatures kappa_1 and kappa_2, the slip q and h = |X_t|
    ///
    /// ```text
    /// deta/dt    = v'.n - q eta_s
    /// h r dc'/dt = -d/dt(r (kappa_2 eta q c + v'.tau c + q c' - D c'_s - (kappa_2 - kappa_1) eta D c_s))
    ///              - m h (c v'_phi + m D c'/r) - h r (kappa_1 + kappa_2) c deta/dt
    /// P'         = r ((gamma' + kappa_2 eta gamma) tau + gamma eta_s n)
    /// g'_x       = dP'_x/dt - gamma h m^2/r eta n_x
    /// g'_r       = dP'_r/dt - gamma h m^2/r eta n_r - h (gamma' + kappa_1 eta gamma)
    /// g'_phi     = -m h (gamma' + kappa_1 eta gamma + gamma eta n_r/r)
    /// ```
    ///
    /// and v' of the forces g' and the displacements eta n by [`stokes_axisymmetric::Disturbances`]. The
    /// shortest waves are left out.
    pub(crate) fn around(&mut self, point: &Point, order: usize) -> Result<DMatrix<f64>, SteadyError> {
        self.load(point)?;
        let Some(disturbances) = self.model.flow.disturbances(order)? else {
            return Err(SteadyError::unsupported(
                "the droplet is in two dimensions",
                "Use the region `space` or `tube`",
            ));
        };
        let surface = Surface::new(self, point.frame[0])?;
        let (n, m, even) = (surface.nodes.len(), order as f64, order.is_multiple_of(2));
        let kept = if order == 0 { n } else { (KEPT * n as f64) as usize };
        let [radius, mean] = [self.model.radius, self.model.concentration];
        let diffusion = self.model.diffusion;
        // Values and slopes of the functions of one field.
        let functions = |j: usize, k: usize| {
            let t = disturbances.parameters()[j];
            if order == 0 {
                return wave(true, k, t);
            }
            let (value, slope) = wave(false, k + 1, t);
            let (s, c) = t.sin_cos();
            let power = s.powi(order as i32 - 1);
            let of_power = if order == 1 { 0.0 } else { (m - 1.0) * s.powi(order as i32 - 2) * c };
            (power * value, power * slope + of_power * value)
        };
        let values = DMatrix::from_fn(n, n, |j, k| functions(j, k).0);
        let factors = values.lu();
        let coefficients = |offsets: &DVector<f64>, concentrations: &DVector<f64>| {
            let fields = [(offsets, radius), (concentrations, mean)];
            let lists = fields.map(|(field, unit)| factors.solve(&(field / unit)));
            let [Some(h), Some(c)] = lists else { return Err(singular()) };
            Ok(DVector::from_iterator(2 * kept, h.iter().take(kept).chain(c.iter().take(kept)).copied()))
        };
        let mut matrix = DMatrix::zeros(2 * kept, 2 * kept);
        for column in 0..2 * kept {
            let (of_shape, k) = (column < kept, column % kept);
            let of = |j: usize, wanted: bool| {
                let (value, slope) = functions(j, k);
                let unit = if of_shape { radius } else { mean };
                if wanted { (unit * value, unit * slope / surface.nodes[j].stretch) } else { (0.0, 0.0) }
            };
            let shape = |j: usize| of(j, of_shape);
            let change = |j: usize| of(j, !of_shape);
            // gamma' + kappa eta gamma, with the curvature along or around.
            let pull = |node: &Node, j: usize, along: usize| {
                node.tension[1] * change(j).0 + node.curvatures[along] * shape(j).0 * node.tension[0]
            };
            let stress = |node: &Node, j: usize| {
                node.place.y * (pull(node, j, 1) * node.tangent + node.tension[0] * shape(j).1 * node.normal)
            };
            let mut forces = [
                surface.slope(even, |node, j| stress(node, j).x),
                surface.slope(!even, |node, j| stress(node, j).y),
                DVector::zeros(n),
            ];
            let mut displacements = [vec![0.0; n], vec![0.0; n]];
            for (j, node) in surface.nodes.iter().enumerate() {
                let eta = shape(j).0;
                let bent = node.tension[0] * node.stretch * m * eta / node.place.y;
                forces[0][j] -= m * bent * node.normal.x;
                forces[1][j] -= m * bent * node.normal.y + node.stretch * pull(node, j, 0);
                forces[2][j] = -m * node.stretch * pull(node, j, 0) - bent * node.normal.y;
                (displacements[0][j], displacements[1][j]) = (eta * node.normal.x, eta * node.normal.y);
            }
            let mut velocity = [vec![0.0; n], vec![0.0; n], vec![0.0; n]];
            let [x, r, around] = &mut velocity;
            disturbances.velocities(
                [&displacements[0], &displacements[1]],
                [forces[0].as_slice(), forces[1].as_slice(), forces[2].as_slice()],
                [x, r, around],
            )?;
            let [x, r, around] = &velocity;
            let flux = surface.slope(even, |node, j| {
                let ((eta, _), (c, slope)) = (shape(j), change(j));
                let [first, second] = node.curvatures;
                let carried = (second * eta * node.slip + Vec2::new(x[j], r[j]).dot(node.tangent)) * node.concentration;
                let spread = slope + (second - first) * eta * node.gradient;
                node.place.y * (carried + node.slip * c - diffusion * spread)
            });
            let (mut offsets, mut concentrations) = (DVector::zeros(n), DVector::zeros(n));
            for (j, node) in surface.nodes.iter().enumerate() {
                let Node { place, stretch, curvatures: [first, second], concentration, .. } = node;
                offsets[j] = Vec2::new(x[j], r[j]).dot(node.normal) - node.slip * shape(j).1;
                let beside = m * (concentration * around[j] + m * diffusion * change(j).0 / place.y) / place.y;
                concentrations[j] =
                    -flux[j] / (stretch * place.y) - beside - (first + second) * concentration * offsets[j];
            }
            matrix.set_column(column, &coefficients(&offsets, &concentrations)?);
        }
        Ok(matrix)
    }
}

impl SteadyState {
    /// Returns the spectrum in three dimensions of disturbances that vary as cos(m phi) around the axis, m the order.
    /// Disturbances of m = 1 turn a swimmer and push it sideways, and disturbances of m = 2 flatten it. Shifts across
    /// the axis and turns, which neither grow nor decay in unbounded fluid, are left out: the eigenvalues nearest to
    /// zero, of which [`Spectrum::neutral`] is the largest. A turned droplet swims aside, so that their error is the
    /// root of the matrix'.
    ///
    /// The equations are linearised by hand and integrated over the azimuth by quadrature. For disturbances of m = 0,
    /// use [`SteadyState::spectrum`].
    ///
    /// # Errors
    /// Returns an error for another order; a state in two dimensions; eigenvalues that do not converge; a flow that
    /// cannot be solved for.
    pub fn spectrum_around(&self, order: usize) -> Result<Spectrum, SteadyError> {
        within("the order of a disturbance", order as f64, 1.0, MOST_ORDER)?;
        if self.setup().droplets.iter().any(|droplet| !droplet.cortex.is_none()) {
            return Err(SteadyError::unsupported(
                "disturbances around the axis of a droplet with a cortex are not computed",
                "Leave the cortex out, or use `SteadyState::spectrum` for disturbances that leave the droplet a body \
                 of revolution",
            ));
        }
        let mut system = System::new(self.setup())?;
        let matrix = system.around(self.point(), order)?;
        let unit = system.model.rate_unit();
        // Shifts and, of droplets that swim, turns.
        let swims = self.velocity().length() > SLOWEST * system.model.radius * unit;
        let motions = match order {
            1 if self.setup().region == Region::Space => 1 + usize::from(swims),
            _ => 0,
        };
        let mut values = eigenvalues(&matrix)?;
        values.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
        let neutral = values.drain(..motions).map(Complex64::norm).fold(0.0, f64::max);
        let symmetry = if order.is_multiple_of(2) { Symmetry::Symmetric } else { Symmetry::Antisymmetric };
        let mut modes: Vec<Eigenmode> =
            values.into_iter().filter(|z| z.im >= 0.0).map(|value| Eigenmode { value, symmetry }).collect();
        modes.sort_by(|a, b| b.value.re.total_cmp(&a.value.re));
        // The eigenvalue of a turn and a shift is the root of an error of the matrix, which others have as it is.
        let error = if motions == 2 { neutral * neutral / unit } else { neutral };
        let zero = NO_GROWTH * unit;
        Ok(Spectrum { modes, neutral, zero, error: error.max(zero) })
    }
}

#[cfg(test)]
mod tests;
