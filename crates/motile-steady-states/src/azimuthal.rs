//! Stability of swimmers in three dimensions against disturbances that vary around the axis.

use std::f64::consts::PI;

use motile::active_interface::Tension;
use motile_base::{PeriodicSeries, Region, Vec2, within};
use nalgebra::{DMatrix, DVector, Dyn, LU};
use num_complex::Complex64;
use stokes_axisymmetric::Disturbances;

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
    /// Slope of the tension by the concentration (force times length), with what the cortex adds to it.
    pull: f64,
    /// Stresses along the meridian and around the axis, the tension and what the cortex adds (force per length).
    stresses: [f64; 2],
    /// Rates at which the surface is stretched along the meridian and around the axis, and turned, `n.dv/ds` (1/time).
    stretching: [f64; 2],
    turning: f64,
    /// Dilatational and shear viscosity of the cortex (force times time per length).
    viscosities: [f64; 2],
}

/// Changes of the stresses of the surface (force per length): along the meridian and around the axis as cos(m phi), and
/// of the shear stress between both as sin(m phi).
struct Stresses {
    along: Vec<f64>,
    around: Vec<f64>,
    shear: Vec<f64>,
}

impl Stresses {
    fn new(nodes: usize) -> Self {
        let zeros = || vec![0.0; nodes];
        Self { along: zeros(), around: zeros(), shear: zeros() }
    }

    /// Sets the stresses of a cortex at a node from the changes of the rates of deformation.
    fn set(&mut self, j: usize, [dilatational, shear]: [f64; 2], [along, around, across]: [f64; 3]) {
        let (spread, less) = (dilatational * (along + around), shear * (along - around));
        (self.along[j], self.around[j], self.shear[j]) = (spread + less, spread - less, 2.0 * shear * across);
    }
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
        let [velocity, strain] = [0, 1].map(|order| shifted(&|k| complex(model.velocities[k]), order));
        let (velocity, strain) = (velocity?, strain?);
        let of_concentration = |k: usize| Complex64::new(model.concentrations[k], 0.0);
        let (concentration, gradient) = (shifted(&of_concentration, 0)?, shifted(&of_concentration, 1)?);
        let cortex = model.setup.droplets[0].cortex;
        let node = |j: usize| {
            let (place, slope) = (vector(&place[j]), vector(&first[j]));
            let stretch = slope.length();
            let tangent = slope / stretch;
            let normal = -tangent.perp();
            let c = concentration[j].re;
            let (velocity, strain) = (vector(&velocity[j]), vector(&strain[j]) / stretch);
            let stretching = [strain.dot(tangent), velocity.y / place.y];
            let viscosities = [cortex.viscosity_at(c), cortex.shear_viscosity];
            let [along, around] = stretching;
            let (spread, less) = (viscosities[0] * (along + around), viscosities[1] * (along - around));
            let tension = model.law.value(c) + spread;
            Node {
                place,
                tangent,
                normal,
                stretch,
                curvatures: [-vector(&second[j]).dot(normal) / (stretch * stretch), normal.y / place.y],
                slip: (velocity - Vec2::new(speed, 0.0)).dot(tangent),
                concentration: c,
                gradient: gradient[j].re / stretch,
                pull: model.law.slope(c) + cortex.per_concentration * (along + around),
                stresses: [tension + less, tension - less],
                stretching,
                turning: strain.dot(normal),
                viscosities,
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

    /// Returns the changes of the forces per parameter and azimuth (force) along, from and around the axis that changes
    /// of the stresses of a surface as it was cause, at an order.
    fn forces(&self, order: usize, stresses: &Stresses) -> [DVector<f64>; 3] {
        let (m, even) = (order as f64, order.is_multiple_of(2));
        let Stresses { along, around, shear } = stresses;
        let mut forces = [
            self.slope(even, |node, j| node.place.y * along[j] * node.tangent.x),
            self.slope(!even, |node, j| node.place.y * along[j] * node.tangent.y),
            self.slope(!even, |node, j| node.place.y * shear[j]),
        ];
        for (j, node) in self.nodes.iter().enumerate() {
            let sheared = node.stretch * shear[j] * node.tangent;
            forces[0][j] += m * sheared.x;
            forces[1][j] += m * sheared.y - node.stretch * around[j];
            forces[2][j] += sheared.y - m * node.stretch * around[j];
        }
        forces
    }

    /// Returns the changes of the stresses of the cortex that velocities along, from and around the axis cause at an
    /// order, on a surface as it was.
    fn cortex(&self, order: usize, velocities: [&DVector<f64>; 3]) -> Stresses {
        let (m, even) = (order as f64, order.is_multiple_of(2));
        let mut stresses = Stresses::new(self.nodes.len());
        // Velocities along the axis have the parity of the order, the others the other one.
        let [x, r, phi] = velocities;
        let [along_x, along_r, along_phi] =
            [(even, x), (!even, r), (!even, phi)].map(|(cosine, values)| &self.slopes[usize::from(!cosine)] * values);
        for (j, node) in self.nodes.iter().enumerate() {
            let Node { place, tangent, stretch, viscosities, .. } = node;
            let along = (along_x[j] * tangent.x + along_r[j] * tangent.y) / stretch;
            let around = (r[j] + m * phi[j]) / place.y;
            let beside = (m * (x[j] * tangent.x + r[j] * tangent.y) + phi[j] * tangent.y) / place.y;
            stresses.set(j, *viscosities, [along, around, 0.5 * (along_phi[j] / stretch - beside)]);
        }
        stresses
    }

    /// Returns the factors of the equations `v' - M B v' = V'` of the velocities of a surface with a cortex, whose
    /// forces are B v', at an order; `None` without a cortex.
    fn resisted(&self, disturbances: &Disturbances, order: usize) -> Result<Option<Factors>, SteadyError> {
        if self.nodes.iter().all(|node| node.viscosities == [0.0; 2]) {
            return Ok(None);
        }
        let n = self.nodes.len();
        let components = if order == 0 { 2 } else { 3 };
        let zeros = DVector::zeros(n);
        let mut matrix = DMatrix::identity(components * n, components * n);
        for column in 0..components * n {
            let mut unit = [zeros.clone(), zeros.clone(), zeros.clone()];
            unit[column / n][column % n] = 1.0;
            let stresses = self.cortex(order, [&unit[0], &unit[1], &unit[2]]);
            let response = response(disturbances, [&zeros, &zeros], &self.forces(order, &stresses))?;
            for (component, velocity) in response.iter().enumerate().take(components) {
                matrix.view_mut((component * n, column), (n, 1)).iter_mut().zip(velocity).for_each(|(a, v)| *a -= v);
            }
        }
        Ok(Some(matrix.lu()))
    }
}

type Factors = LU<f64, Dyn, Dyn>;

/// Returns the velocities along, from and around the axis of displacements and forces.
fn response(
    disturbances: &Disturbances,
    [x, r]: [&DVector<f64>; 2],
    forces: &[DVector<f64>; 3],
) -> Result<[Vec<f64>; 3], SteadyError> {
    let mut velocity = [vec![0.0; x.len()], vec![0.0; x.len()], vec![0.0; x.len()]];
    let [along, from, around] = &mut velocity;
    let forces = forces.each_ref().map(DVector::as_slice);
    disturbances.velocities([x.as_slice(), r.as_slice()], forces, [along, from, around])?;
    Ok(velocity)
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
    /// P'         = r ((T_1' + kappa_2 eta T_1) tau + T_1 eta_s n)
    /// g'_x       = dP'_x/dt - T_2 h m^2/r eta n_x + m h S tau_x
    /// g'_r       = dP'_r/dt - T_2 h m^2/r eta n_r + m h S tau_r - h (T_2' + kappa_1 eta T_2)
    /// g'_phi     = -m h (T_2' + kappa_1 eta T_2 + T_2 eta n_r/r) + d(r S)/dt + h S tau_r
    /// ```
    ///
    /// and v' of the forces g' and the displacements eta n by [`stokes_axisymmetric::Disturbances`]. Without a cortex,
    /// the stresses T_1 along the meridian and T_2 around the axis are the tension gamma, and the shear stress
    /// S sin(m phi) vanishes. A cortex adds `kappa_d (e_1 + e_2) +- mu_s (e_1 - e_2)` to them, and S is 2 mu_s e_12.
    /// The rates of deformation and their changes are
    ///
    /// ```text
    /// e_1  = tau.v_s,      e_1' = tau.v'_s + eta_s n.v_s - kappa_1 eta e_1
    /// e_2  = v_r/r,        e_2' = (v'_r + m v'_phi)/r - kappa_2 eta e_2
    /// e_12 = (dv'_phi/ds - (m v'.tau + v'_phi tau_r + m eta n.v_s)/r)/2
    /// ```
    ///
    /// so that v' solves linear equations. The shortest waves are left out.
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
        let resisted = surface.resisted(&disturbances, order)?;
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
            // Stresses of points that keep their velocity, with what the change of lengths and directions adds.
            let mut stresses = Stresses::new(n);
            for (j, node) in surface.nodes.iter().enumerate() {
                let ([first, second], [along, around]) = (node.curvatures, node.stretching);
                let ((eta, tilt), (c, _)) = (shape(j), change(j));
                let rates = [
                    tilt * node.turning - first * eta * along,
                    -second * eta * around,
                    -0.5 * m * eta * node.turning / node.place.y,
                ];
                stresses.set(j, node.viscosities, rates);
                stresses.along[j] += node.pull * c + second * eta * node.stresses[0];
                stresses.around[j] += node.pull * c + first * eta * node.stresses[1];
            }
            let mut forces = surface.forces(order, &stresses);
            let bend = |node: &Node, j: usize| node.place.y * node.stresses[0] * shape(j).1 * node.normal;
            forces[0] += surface.slope(even, |node, j| bend(node, j).x);
            forces[1] += surface.slope(!even, |node, j| bend(node, j).y);
            let mut displacements = [DVector::zeros(n), DVector::zeros(n)];
            for (j, node) in surface.nodes.iter().enumerate() {
                let eta = shape(j).0;
                let bent = node.stresses[1] * node.stretch * m * eta / node.place.y;
                forces[0][j] -= m * bent * node.normal.x;
                forces[1][j] -= m * bent * node.normal.y;
                forces[2][j] -= bent * node.normal.y;
                (displacements[0][j], displacements[1][j]) = (eta * node.normal.x, eta * node.normal.y);
            }
            let mut velocity = response(&disturbances, [&displacements[0], &displacements[1]], &forces)?;
            if let Some(factors) = &resisted {
                let mut all = DVector::from_vec(velocity.concat());
                all.resize_vertically_mut(factors.l().nrows(), 0.0);
                if !factors.solve_mut(&mut all) {
                    return Err(singular());
                }
                velocity.iter_mut().zip(all.as_slice().chunks_exact(n)).for_each(|(v, new)| v.copy_from_slice(new));
            }
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
