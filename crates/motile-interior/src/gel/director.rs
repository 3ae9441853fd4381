//! Director on a triangulation: energy, forces, rate of change.

use motile_base::Vec2;
use motile_scene::{BodyError, StepCause, StepLimit};

use super::stabiliser::Stabiliser;
use super::{defect, defect::Defect, elements::Elements, material::GelMaterial};
use crate::InteriorError;

/// Diffusivity of the stabiliser over the director's largest one: at 1 or more, the midpoint rule is stable at any
/// step, and at 2 to 5 the shortest waves decay within a few steps.
const STABILISER: f64 = 2.0;
/// Largest wave number, times the square root of the area, that stabilised steps resolve in time.
const WAVES: f64 = 20.0;

/// Variance along a coordinate of the blur of a velocity gradient, by the nodes' share of stresses and by their mean of
/// gradients, over the squared side of triangles of equal sides. A wave k has `i k (1 - (k s)^2 / 8)` each time.
const MESH_BLUR: f64 = 0.25;
/// Variance of the blur by spreading and interpolation with a cubic B-spline, half of both, over the squared grid
/// spacing.
const GRID_BLUR: f64 = 1.0 / 3.0;

/// Observables of a gel.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct GelObservables {
    /// Topological defects of the director.
    pub defects: Vec<Defect>,
    /// Frank energy `INT K1/2 (div p)^2 + K3/2 (curl p)^2 + k div p` (force times length).
    pub director_energy: f64,
    /// Mean director (no dimension): of length 1 if the director is uniform, 0 for asters and vortices.
    pub polarisation: [f64; 2],
}

/// Director at the nodes of a triangulation, given by its angles, so that |p| = 1 there; between nodes it is linear.
///
/// With the discrete energy
///
/// ```text
/// E = SUM_T A_T (K1/2 |grad p|^2 + (K3 - K1)/2 (curl p)^2 + k div p)
/// ```
///
/// of angles a and positions x, where |grad p|^2 = (div p)^2 + (curl p)^2 for |p| = 1. The rate W_i at which the fluid
/// turns the director at node i is linear in the nodes' velocities v. The forces on the fluid and the director's motion
/// are
///
/// ```text
/// F_i     = -dE/dx_i - SUM_j dE/da_j dW_j/dv_i + active part,   h_i = -(dE/da_i)/M_i
/// da_i/dt = W_i + h_i/gamma1
/// ```
///
/// with M_i the node's share of the area. So `SUM F v + dE/dt = -SUM M h^2/gamma1` without activity and where nodes
/// move with the fluid, as in the continuum (Cowley (1.4)), and the forces have neither resultant nor torque.
///
/// Mesh and grid blur the flow of a stress S to the flow of `S + b LAP S`. The active stress is therefore sharpened to
/// `S - b LAP S` inside. Without this, its flow at the distance r from a defect is too weak by `4 b/r^2`. This adds up
/// to an error that falls more slowly than the square of the spacing.
#[derive(Debug, Clone)]
pub(super) struct Director {
    pub(super) material: GelMaterial,
    pub(super) elements: Elements,
    /// Angle from tangent to director on the boundary, and the number of its nodes, which come first.
    anchoring: Option<(f64, usize)>,
    pub(super) angles: Vec<f64>,
    pub(super) directors: Vec<Vec2>,
    /// Couples -dE/da at the nodes (force times length).
    pub(super) couples: Vec<f64>,
    /// Stress at each node, active and of the molecular field, as (rows of d/dx, of d/dy).
    stresses: Vec<[Vec2; 2]>,
    /// Gradients of the velocity and of the angle at the nodes, times their masses.
    slopes: Vec<[Vec2; 3]>,
    /// At each node the active stress over the activity, (xx, xy), and minus its Laplacian times the node's mass (no
    /// dimension).
    active: Vec<[Vec2; 2]>,
    /// Number of the nodes on the boundary, which come first: there stresses are not sharpened.
    boundary: usize,
    /// Spacing of the flow's grid (length), by which the active stress is sharpened.
    pub(super) grid: f64,
    pub(super) stabiliser: Stabiliser,
    /// Diffusivity of the stabiliser (length squared per time) from the first evaluation of the next step on.
    coming: Option<f64>,
}

impl Director {
    /// Creates a director of given angles (radians); those at anchored nodes change once the nodes have positions.
    pub(super) fn new(
        material: GelMaterial,
        elements: Elements,
        angles: Vec<f64>,
        anchoring: Option<(f64, usize)>,
        boundary: usize,
    ) -> Self {
        let count = angles.len();
        let stabiliser = Stabiliser::new(&elements, anchoring.map_or(0, |(_, count)| count));
        let mut director = Self {
            active: vec![[Vec2::ZERO; 2]; count],
            boundary,
            grid: 0.0,
            stabiliser,
            coming: None,
            material,
            elements,
            anchoring,
            directors: vec![Vec2::ZERO; count],
            couples: vec![0.0; count],
            stresses: vec![[Vec2::ZERO; 2]; count],
            slopes: vec![[Vec2::ZERO; 3]; count],
            angles,
        };
        director.turn();
        director
    }

    /// Computes the director from its angles.
    fn turn(&mut self) {
        for (director, &angle) in self.directors.iter_mut().zip(&self.angles) {
            *director = Vec2::from_angle(angle);
        }
    }

    /// Returns the number of anchored nodes, which come first.
    fn anchored(&self) -> usize {
        self.anchoring.map_or(0, |(_, count)| count)
    }

    /// Returns the angles at the nodes that are not anchored.
    pub(super) fn free_angles(&self) -> &[f64] {
        &self.angles[self.anchored()..]
    }

    /// Takes over the angles of the nodes that are not anchored.
    pub(super) fn read(&mut self, angles: &[f64]) -> Result<(), BodyError> {
        if let Some(index) = angles.iter().position(|value| !value.is_finite()) {
            return Err(BodyError::NonFinite { what: "the angle of the director", index, value: angles[index] });
        }
        let anchored = self.anchored();
        self.angles[anchored..].copy_from_slice(angles);
        self.turn();
        Ok(())
    }

    /// Takes over the positions of the nodes (length), and turns the director on the boundary to its anchoring.
    pub(super) fn move_to(&mut self, nodes: &[Vec2]) {
        self.elements.move_to(nodes);
        if let Some((from_tangent, count)) = self.anchoring {
            for node in 0..count {
                let [before, after] = neighbours(node, count);
                self.angles[node] = self.elements.between(nodes[before], nodes[after]).to_angle() + from_tangent;
                self.directors[node] = Vec2::from_angle(self.angles[node]);
            }
        }
    }

    /// Returns the Frank energy (force times length).
    pub(super) fn energy(&self) -> f64 {
        let of = |(triangle, area): (usize, &f64)| {
            let slopes @ [x, y] = self.elements.gradient(triangle, &self.directors);
            let [_, _, more] = more_than_one_constant(&self.material, slopes);
            area * (0.5 * self.material.frank * (x.length_squared() + y.length_squared()) + more.x)
        };
        self.elements.areas.iter().enumerate().map(of).sum()
    }

    /// Returns the mean director, weighted by area (no dimension).
    pub(super) fn polarisation(&self) -> Vec2 {
        let masses = &self.elements.masses;
        let sum: Vec2 = self.directors.iter().zip(masses).map(|(director, mass)| *mass * *director).sum();
        sum / masses.iter().sum::<f64>()
    }

    /// Returns the observables, with the nodes at their positions (length).
    pub(super) fn observables(&self, nodes: &[Vec2]) -> GelObservables {
        GelObservables {
            defects: self.defects(nodes),
            director_energy: self.energy(),
            polarisation: self.polarisation().into(),
        }
    }

    /// Returns the topological defects.
    pub(super) fn defects(&self, nodes: &[Vec2]) -> Vec<Defect> {
        defect::defects(&self.elements, nodes, &self.angles, &self.directors)
    }

    /// Writes the forces on the fluid at the nodes (force), at the positions (length) that were taken over last;
    /// refuses triangles of no or negative area.
    pub(super) fn write_forces(&mut self, nodes: &[Vec2], forces: &mut [Vec2]) -> Result<(), InteriorError> {
        let anchored = self.anchored();
        let Self { material, elements, directors, couples, stresses, active, .. } = self;
        let area = elements.areas[elements.least];
        if area.is_nan() || area <= 0.0 {
            let Vec2 { x, y } = elements.place(elements.least, nodes, [1.0 / 3.0; 3]);
            return Err(InteriorError::Folded { x, y });
        }
        forces.fill(Vec2::ZERO);
        couples.fill(0.0);
        for (active, p) in active.iter_mut().zip(&*directors) {
            *active = [Vec2::new(p.x * p.x - 0.5, p.x * p.y), Vec2::ZERO];
        }
        let simple = material.bend() == material.frank && material.spontaneous_splay == 0.0;
        for (number, (triangle, slopes)) in elements.triangles.iter().zip(&elements.gradients).enumerate() {
            let [x, y] = elements.gradient(number, directors);
            if !simple {
                let (area, [push_x, push_y, energy]) =
                    (elements.areas[number], more_than_one_constant(material, [x, y]));
                let stress_x = Vec2::new(push_x.dot(x) - energy.x, push_x.dot(y));
                let stress_y = Vec2::new(push_y.dot(x), push_y.dot(y) - energy.x);
                for (&node, slope) in triangle.iter().zip(slopes) {
                    forces[node] += area * (slope.x * stress_x + slope.y * stress_y);
                    couples[node] -= area * directors[node].perp_dot(slope.x * push_x + slope.y * push_y);
                }
            }
            let weight = material.frank * elements.areas[number];
            let half = 0.5 * (x.length_squared() + y.length_squared());
            let mixed = x.dot(y);
            let (stress_x, stress_y) =
                (Vec2::new(x.length_squared() - half, mixed), Vec2::new(mixed, y.length_squared() - half));
            let [active_x, active_y] = triangle.iter().zip(slopes).fold([Vec2::ZERO; 2], |[x, y], (&node, slope)| {
                [x + slope.x * active[node][0], y + slope.y * active[node][0]]
            });
            for (&node, slope) in triangle.iter().zip(slopes) {
                active[node][1] += elements.areas[number] * (slope.x * active_x + slope.y * active_y);
                forces[node] += weight * (slope.x * stress_x + slope.y * stress_y);
                couples[node] -= weight * directors[node].perp_dot(slope.x * x + slope.y * y);
            }
        }
        // Couples on an anchored boundary turn its normals, all others the fluid.
        for (node, couple) in couples[..anchored].iter().enumerate() {
            let [before, after] = neighbours(node, anchored);
            let chord = elements.between(nodes[before], nodes[after]);
            let push = couple / chord.length_squared() * chord.perp();
            forces[after] += push;
            forces[before] -= push;
        }
        for (node, (stress, p)) in stresses.iter_mut().zip(&*directors).enumerate() {
            let field = if node < anchored { 0.0 } else { couples[node] / elements.masses[node] };
            let [active, bent] = active[node];
            // The squared side of triangles of equal sides, two for each node, is 2/sqrt(3) of its mass.
            let blur = MESH_BLUR * 2.0 / 3.0_f64.sqrt() + GRID_BLUR * self.grid * self.grid / elements.masses[node];
            let active = material.activity * if node < self.boundary { active } else { active + blur * bent };
            // 1/2 (p q + q p) with q normal to p.
            let aligned = -material.alignment * field * Vec2::new(-p.x * p.y, 0.5 * (p.x * p.x - p.y * p.y));
            let sum = active + aligned;
            *stress = [Vec2::new(sum.x, sum.y + 0.5 * field), Vec2::new(sum.y - 0.5 * field, -sum.x)];
        }
        for ((triangle, slopes), area) in elements.triangles.iter().zip(&elements.gradients).zip(&elements.areas) {
            let [x, y] =
                triangle.iter().fold([Vec2::ZERO; 2], |[x, y], &node| [x + stresses[node][0], y + stresses[node][1]]);
            for (&node, slope) in triangle.iter().zip(slopes) {
                forces[node] += area / 3.0 * (slope.x * x + slope.y * y);
            }
        }
        Ok(())
    }

    /// Writes the rates of change of the angles that are not anchored (1/time), after [`Director::write_forces`], from
    /// the velocities of the fluid and of the mesh at all nodes (length per time).
    pub(super) fn write_rate(&mut self, fluid: &[Vec2], mesh: &[Vec2], rate: &mut [f64]) {
        let anchored = self.anchored();
        let Self { material, elements, directors, couples, slopes, .. } = self;
        slopes.fill([Vec2::ZERO; 3]);
        for (number, (triangle, area)) in elements.triangles.iter().zip(&elements.areas).enumerate() {
            let ([vx, vy], turn) = (elements.gradient(number, fluid), angle_gradient(elements, number, directors));
            for &node in triangle {
                for (sum, slope) in slopes[node].iter_mut().zip([vx, vy, turn]) {
                    *sum += area / 3.0 * slope;
                }
            }
        }
        for (rate, node) in rate.iter_mut().zip(anchored..) {
            let (p, [vx, vy, turn]) = (directors[node], slopes[node]);
            let spin = 0.5 * (vx.y - vy.x);
            let (stretch, shear) = (0.5 * (vx.x - vy.y), 0.5 * (vx.y + vy.x));
            let strain = shear * (p.x * p.x - p.y * p.y) - 2.0 * stretch * p.x * p.y;
            let slip = fluid[node] - mesh[node];
            let carried = slip.dot(turn);
            let turned = spin - material.alignment * strain - carried + couples[node] / material.rotational_viscosity;
            *rate = turned / elements.masses[node];
        }
        if let Some(diffusivity) = self.coming.take() {
            self.stabiliser.freeze(&self.elements, diffusivity);
        }
        // The implicit part adds this again.
        self.stabiliser.add(&self.angles[anchored..], -1.0, rate);
    }

    /// Begins a step, with or without the stabiliser, in fluid of a viscosity (stress times time).
    pub(super) fn begin_step(&mut self, stabilised: bool, viscosity: f64) {
        let diffusivity = STABILISER * self.material.largest_diffusivity(viscosity);
        self.coming = Some(if stabilised { diffusivity } else { 0.0 });
    }

    /// Reports the largest stable step of the midpoint rule in fluid of a viscosity (stress times time).
    pub(super) fn step_limits(&self, viscosity: f64, limits: &mut dyn FnMut(StepLimit)) {
        let Self { material, elements, .. } = self;
        let bare = 2.0 / self.fastest_rate(viscosity);
        let area: f64 = elements.masses.iter().sum();
        let diffusion = material.largest_diffusivity(viscosity) * WAVES * WAVES / area;
        let active = 0.5 * material.activity.abs() * (1.0 + material.alignment.abs()) / viscosity;
        let dt = (2.0 / (diffusion + active + self.rate_of_splay(viscosity))).max(bare);
        limits(StepLimit { dt, reason: "the gel's director", cause: StepCause::Stabilised { bare } });
    }

    /// Returns the upper bound of the rates at which the director relaxes (1/time) in fluid of a viscosity (stress
    /// times time): by the molecular field, the flow that it drives, and the activity.
    fn fastest_rate(&self, viscosity: f64) -> f64 {
        let Self { material, elements, .. } = self;
        // No eigenvalue of the whole exceeds the largest of a single triangle: 3 times that of SUM g g over the
        // gradients g of its basis functions.
        let sharpest = elements.gradients.iter().map(|slopes| {
            let [xx, xy, yy] = slopes.iter().fold([0.0; 3], |[xx, xy, yy], slope| {
                [xx + slope.x * slope.x, xy + slope.x * slope.y, yy + slope.y * slope.y]
            });
            1.5 * (xx + yy + (xx - yy).hypot(2.0 * xy))
        });
        let active = 0.5 * material.activity.abs() * (1.0 + material.alignment.abs()) / viscosity;
        material.largest_diffusivity(viscosity) * sharpest.fold(0.0, f64::max) + active + self.rate_of_splay(viscosity)
    }

    /// Returns the upper bound of the rate at which spontaneous splay turns the director at the boundary (1/time) in
    /// fluid of a viscosity (stress times time).
    fn rate_of_splay(&self, viscosity: f64) -> f64 {
        let Self { material, elements, .. } = self;
        if material.spontaneous_splay == 0.0 {
            return 0.0;
        }
        // What is left of the gradients around a node is the boundary next to it, along the normal.
        let mut sides = vec![Vec2::ZERO; elements.masses.len()];
        for ((triangle, slopes), area) in elements.triangles.iter().zip(&elements.gradients).zip(&elements.areas) {
            triangle.iter().zip(slopes).for_each(|(&node, slope)| sides[node] += *area * *slope);
        }
        let largest = sides.iter().zip(&elements.masses).map(|(side, mass)| side.length() / mass).fold(0.0, f64::max);
        material.spontaneous_splay.abs() * largest * material.mobility(viscosity)
    }
}

/// Returns what a second Frank constant and spontaneous splay add in a triangle with the gradients (d/dx, d/dy) of the
/// director. First come the derivatives of the energy per area by both gradients (force), then this energy as x (force
/// per length).
fn more_than_one_constant(material: &GelMaterial, [x, y]: [Vec2; 2]) -> [Vec2; 3] {
    let (more, splay) = (material.bend() - material.frank, material.spontaneous_splay);
    let (divergence, curl) = (x.x + y.y, x.y - y.x);
    let energy = 0.5 * more * curl * curl + splay * divergence;
    [Vec2::new(splay, more * curl), Vec2::new(-more * curl, splay), Vec2::new(energy, 0.0)]
}

/// Returns the gradient of the angle in a triangle (1/length) from the differences D between corners, smooth also where
/// a defect passes by: `(4 - cos D) sin D / 3 = D + O(D^5)`, less the mean over the edges, so that they add up to zero.
fn angle_gradient(elements: &Elements, triangle: usize, directors: &[Vec2]) -> Vec2 {
    let [a, b, c] = elements.triangles[triangle].map(|node| directors[node]);
    let turn = |from: Vec2, to: Vec2| from.perp_dot(to) * (4.0 - from.dot(to)) / 3.0;
    let [first, second, third] = [turn(a, b), turn(b, c), turn(c, a)];
    let mean = (first + second + third) / 3.0;
    let [_, on_b, on_c] = elements.gradients[triangle];
    (first - mean) * on_b - (third - mean) * on_c
}

/// Neighbours of a node of a closed curve.
fn neighbours(node: usize, count: usize) -> [usize; 2] {
    [(node + count - 1) % count, (node + 1) % count]
}

#[cfg(test)]
mod tests;
