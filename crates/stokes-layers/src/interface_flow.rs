//! The flow of fluid interfaces: velocities on them from the forces on them, for any viscosity inside and outside.

mod free_body;
mod rigid;

use std::f64::consts::PI;

use input_checks::{positive, same_length, within};
use num_complex::Complex64;

use crate::{
    Forcing, Geometry, LayerError, Settings, Vec2,
    close::Crossing,
    curve::{Curve, GivenCurve},
    gmres::{Gmres, Outcome},
    greens::{Flow, Vectors},
    layer::{Density, Layers},
    single_layer::LayerCurve,
};
pub use free_body::RigidMotion;
use rigid::RigidWalls;

/// The least residual that round-off lets be reached, as part of the right-hand side.
const ATTAINABLE: f64 = 1e-15;
/// Iterations after which the residual is computed.
const TRUSTED: usize = 32;
/// What products may err by, in units of the tolerance.
const PRODUCTS: f64 = 100.0;
/// The loosest residual that is asked for where a tighter one turns out not to be true.
const LOOSEST: f64 = 1e-10;

const FOUR_PI: f64 = 4.0 * PI;
/// Largest ratio of the periods of a box.
pub(crate) const LARGEST_RATIO: f64 = 20.0;
/// Largest ratio of viscosities: velocities are then right to some 1e-8.
const MOST_CONTRAST: f64 = 1e8;

/// What an interface encloses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Inside {
    /// Fluid.
    Fluid {
        /// Its viscosity (stress times time).
        viscosity: f64,
    },
    /// A rigid body that moves freely: the forces on its surface are all that act on it.
    Rigid,
}

/// An interface as points of equally spaced parameters: point k of n belongs to the parameter 2 pi k/n.
#[derive(Debug, Clone, Copy)]
pub struct Interface<'a> {
    /// Points, counter-clockwise or with the inside on the left, at least as many as the settings have nodes (length).
    pub positions: &'a [Vec2],
    /// How far the interface goes on in a turn of the parameter (length): zero for a closed one, plus or minus the
    /// period of the region along x for an open one.
    pub period: Vec2,
    /// Force on the fluid at each point (force): the force per length times the length that belongs to the point.
    pub forces: &'a [Vec2],
    /// What is inside.
    pub inside: Inside,
    /// Viscosity outside (stress times time), of another fluid than the exterior where the interface lies inside
    /// another one.
    pub viscosity_outside: f64,
}

impl<'a> Interface<'a> {
    /// A closed interface between fluids of these viscosities inside and outside (stress times time).
    #[must_use]
    pub fn closed(positions: &'a [Vec2], forces: &'a [Vec2], [inside, outside]: [f64; 2]) -> Self {
        let inside = Inside::Fluid { viscosity: inside };
        Self { positions, period: Vec2::ZERO, forces, inside, viscosity_outside: outside }
    }

    /// The surface of a rigid body in fluid of that viscosity (stress times time).
    #[must_use]
    pub fn rigid(positions: &'a [Vec2], forces: &'a [Vec2], viscosity_outside: f64) -> Self {
        Self { positions, period: Vec2::ZERO, forces, inside: Inside::Rigid, viscosity_outside }
    }
}

/// What a solution needed and found.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Solution {
    /// Iterations; none where all viscosities are equal.
    pub iterations: usize,
    /// Relative residual.
    pub residual: f64,
    /// Mean pressure gradient along a channel (force per volume).
    pub pressure_gradient: f64,
}

/// The flow at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlowSample {
    /// Velocity (length per time).
    pub velocity: Vec2,
    /// Pressure (force per length in 2D), periodic part.
    pub pressure: f64,
    /// Velocity gradient `[[du/dx, du/dy], [dv/dx, dv/dy]]` (1/time).
    pub gradient: [[f64; 2]; 2],
}

impl Default for FlowSample {
    fn default() -> Self {
        Self { velocity: Vec2::ZERO, pressure: 0.0, gradient: [[0.0; 2]; 2] }
    }
}

/// What one solution leaves for the next.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct WarmStart {
    /// Velocities at the nodes, x then y, interface after interface.
    pub velocities: Vec<f64>,
    /// Directions of earlier iterations; see [`Gmres::save`].
    pub directions: Vec<f64>,
}

/// Stokes flow of closed fluid interfaces.
///
/// The velocity at an interface with force per length F on it is (Pozrikidis, Boundary Integral and Singularity
/// Methods, 1992)
///
/// ```text
/// (eta_in + eta_out)/2 v(x) = 1/(4 pi) INT G(x, y) F(y) ds - (eta_in - eta_out)/(4 pi) INT v(y) T(x, y) n ds
/// ```
///
/// with the Green's function G of the region and its stress T; n points outward, and eta_out is the viscosity of the
/// fluid right outside of the interface, so that interfaces may lie inside one another. The single layer is integrated
/// by the rule of Kress, the double layer by the trapezoidal rule, both on `nodes` equally spaced values of the
/// parameter, so that errors fall faster than any power of the number of nodes. Where viscosities differ the equation
/// is solved by GMRES. Nodes close to another interface get a quadrature of their own, so that gaps are limited by what
/// the film between them needs, not by the kernel.
///
/// A rigid body is the limit of eta_in to infinity, in which `v = U + Om x (x - x_c) + w/eta_in`: with the rigid motion
/// P w/eta_out for the first two terms, P the mean motion of a density w,
///
/// ```text
/// P w(x) + w(x)/2 = 1/(4 pi) INT G(x, y) F(y) ds - 1/(4 pi) INT w(y) T(x, y) n ds
/// ```
///
/// the completed double layer of Power and Miranda (SIAM J. Appl. Math. 47, 1987) with the forces on the surface F as
/// its completion: where they have neither resultant nor torque the body is free of both. The double layer of a rigid
/// motion is nothing outside, so that w acts on all else as `eta_in v` would.
///
/// [`InterfaceFlow::load`], [`InterfaceFlow::solve`], then [`InterfaceFlow::velocities`] on the interfaces and
/// [`InterfaceFlow::sample`] anywhere. While the numbers of interfaces and points stay the same nothing is allocated.
#[derive(Debug, Clone)]
pub struct InterfaceFlow {
    geometry: Geometry,
    viscosity: f64,
    settings: Settings,
    layers: Layers,
    gmres: Gmres,
    /// Inside, and inside less outside, interface by interface.
    viscosities: Vec<f64>,
    contrasts: Vec<f64>,
    /// 2/(inside + outside).
    scales: Vec<f64>,
    /// Velocities at the nodes, x then y, interface after interface: those last solved for, from which the next
    /// solution starts, and those of the present interfaces.
    solution: Vec<f64>,
    velocities: Vec<f64>,
    right: Vec<f64>,
    /// Unit normals at the nodes, as velocities.
    normals: Vec<f64>,
    deflation: Vec<f64>,
    /// The product of the last solution.
    image: Vec<f64>,
    /// Which interfaces are those of rigid bodies, and the motion of one at the nodes.
    bodies: Vec<bool>,
    motion: Vec<f64>,
    rigid: Option<Box<RigidWalls>>,
    /// Whether the interfaces are known to lie between the walls.
    placed: bool,
}

impl InterfaceFlow {
    /// For exterior fluid of the given viscosity (stress times time).
    ///
    /// # Errors
    /// A viscosity or a length that is not positive and finite, periods of which one is more than 20 times the other,
    /// settings out of their range.
    pub fn new(geometry: Geometry, viscosity: f64, settings: Settings) -> Result<Self, LayerError> {
        positive("the viscosity", viscosity)?;
        geometry.check()?;
        if let Geometry::Box { lengths: [lx, ly] } = geometry {
            within("the ratio of the periods", lx.max(ly) / lx.min(ly), 1.0, LARGEST_RATIO)?;
        }
        settings.check()?;
        Ok(Self {
            geometry,
            viscosity,
            settings,
            layers: Layers::new(geometry, settings.tolerance, false)?,
            gmres: Gmres::recycling(),
            viscosities: Vec::new(),
            contrasts: Vec::new(),
            scales: Vec::new(),
            solution: Vec::new(),
            velocities: Vec::new(),
            right: Vec::new(),
            normals: Vec::new(),
            deflation: Vec::new(),
            image: Vec::new(),
            bodies: Vec::new(),
            motion: Vec::new(),
            rigid: None,
            placed: true,
        })
    }

    /// The same between rigid walls and obstacles at rest in a channel, in place of those that there were: open walls
    /// with the fluid on their left, that are the sides of a channel of another shape, and closed ones,
    /// counter-clockwise, around which it flows. They are a single layer whose forces f cancel the velocity on them,
    ///
    /// ```text
    /// 1/(4 pi eta) [INT G f ds over walls  +  layers of the interfaces]  +  forced flow  =  0    on walls
    /// ```
    ///
    /// with the Green's function G of the straight channel around them. The matrix of this equation is factorised here,
    /// once; a uniform pressure behind a wall, which moves nothing, is taken out of f. A given flux is that between
    /// the walls, without what a pressure gradient drives behind them.
    ///
    /// # Errors
    /// Another region than a channel; what [`crate::SingleLayer::load`] refuses; more than 3000 nodes; walls that cross
    /// or touch.
    pub fn with_walls<'a>(mut self, walls: impl Iterator<Item = LayerCurve<'a>> + Clone) -> Result<Self, LayerError> {
        let Geometry::Channel { length, width, forcing } = self.geometry else { return Err(LayerError::NoChannel) };
        // What is forced is the flow between the walls.
        let geometry = Geometry::Channel { length, width, forcing: Forcing::Gradient(0.0) };
        self.layers = Layers::new(geometry, self.settings.tolerance, false)?;
        let rigid = RigidWalls::new(&mut self.layers, [length, width], forcing, self.viscosity, walls)?;
        self.rigid = Some(Box::new(rigid));
        self.placed = false;
        Ok(self)
    }

    /// Forces of the walls on the fluid from the last solution (force), wall by wall as many as there are; what a
    /// pressure gradient does behind open walls is part of them.
    pub fn wall_forces(&self) -> impl Iterator<Item = Vec2> {
        let walls = self.rigid.as_ref().map(|rigid| &rigid.forces);
        let first = self.layers.kept.first;
        walls.into_iter().flat_map(move |forces| {
            (first..self.layers.curves.len()).map(move |wall| {
                let start = self.layers.entries(first).start;
                let entries = self.layers.entries(wall);
                let (x, y) = forces.as_slice()[entries.start - start..entries.end - start]
                    .split_at(self.layers.curves[wall].len());
                Vec2::new(x.iter().sum(), y.iter().sum())
            })
        })
    }

    /// The geometry.
    #[must_use]
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// Viscosity of the exterior fluid (stress times time).
    #[must_use]
    pub fn viscosity(&self) -> f64 {
        self.viscosity
    }

    /// Resolution and accuracy.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Number of interfaces.
    #[must_use]
    pub fn len(&self) -> usize {
        self.layers.kept.first
    }

    /// Whether there are no interfaces.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Length of an interface (length), none where there is no interface of that number.
    #[must_use]
    pub fn perimeter(&self, interface: usize) -> Option<f64> {
        self.layers.curves[..self.len()].get(interface).map(Curve::perimeter)
    }

    /// Takes over interfaces, truncated to the modes that the nodes carry.
    ///
    /// # Errors
    /// A viscosity that is not positive and finite, or more than 1e8 times larger or smaller than the exterior one,
    /// where round-off would show; positions or forces that are not finite, too few or too many points, a clockwise
    /// curve, a node beyond a wall.
    pub fn load<'a>(&mut self, interfaces: impl Iterator<Item = Interface<'a>> + Clone) -> Result<(), LayerError> {
        self.viscosities.clear();
        self.contrasts.clear();
        self.scales.clear();
        self.bodies.clear();
        for Interface { inside, viscosity_outside: outside, .. } in interfaces.clone() {
            self.bodies.push(inside == Inside::Rigid);
            let inside = match inside {
                Inside::Fluid { viscosity } => positive("the viscosity inside an interface", viscosity)?,
                Inside::Rigid => outside,
            };
            positive("the viscosity outside an interface", outside)?;
            for viscosity in [inside, outside] {
                let ratio = viscosity / self.viscosity;
                within("the ratio of viscosities to the exterior one", ratio, 1.0 / MOST_CONTRAST, MOST_CONTRAST)?;
            }
            self.viscosities.push(inside);
            // The density of a rigid body is w/eta_out.
            let density = self.bodies.last().is_some_and(|rigid| *rigid);
            self.contrasts.push(if density { outside } else { inside - outside });
            self.scales.push(2.0 / if density { outside } else { inside + outside });
        }
        let nodes = self.settings.nodes;
        let given =
            |Interface { positions, forces, period, .. }| GivenCurve { positions, forces: Some(forces), period, nodes };
        let before = self.len();
        self.layers.load(interfaces.map(given), false)?;
        if self.rigid.is_some() && !(self.placed && before == self.len()) {
            self.placed = false;
            self.check_places()?;
            self.placed = true;
        }
        Ok(())
    }

    /// Refuses interfaces beyond walls.
    fn check_places(&self) -> Result<(), LayerError> {
        let (interfaces, walls) = self.layers.curves.split_at(self.len());
        for (curve, interface) in interfaces.iter().enumerate() {
            for z in &interface.nodes.position {
                let place = z + interface.centre;
                let left = |wall: &Curve| wall.winds_around(self.geometry.images().wrap(place - wall.centre));
                if let Some(wall) = walls.iter().position(|wall| left(wall) != wall.is_open()) {
                    return Err(LayerError::CrossesWall { curve, x: place.re, y: place.im, wall });
                }
            }
        }
        Ok(())
    }

    /// Computes the single layer of the interfaces, at walls too.
    fn single_layer(&mut self, contrast: bool) -> Result<(), LayerError> {
        self.layers.single_layer(contrast);
        self.layers.crossing().map_or(Ok(()), |Crossing { curve, wall, place }| {
            Err(LayerError::CrossesWall { curve, x: place.re, y: place.im, wall: wall - self.len() })
        })
    }

    /// After the response to the single layer, finds the forces of walls and the pressure gradient for velocities on
    /// the interfaces.
    fn settle_walls(&mut self) {
        let Self { layers, rigid: Some(rigid), contrasts, velocities, settings, .. } = self else { return };
        if contrasts.iter().any(|contrast| *contrast != 0.0) {
            let density = Density { values: velocities, contrasts };
            layers.double_layer(density, settings.tolerance);
            rigid.respond(layers, layers.dipole_moment(density), false);
            rigid.combine();
        }
    }

    /// Solves for the velocities on the interfaces.
    ///
    /// # Errors
    /// No convergence.
    pub fn solve(&mut self) -> Result<Solution, LayerError> {
        if self.is_empty() {
            self.velocities.clear();
            return Ok(Solution::default());
        }
        let nodes = self.settings.nodes;
        let contrast = self.contrasts.iter().any(|contrast| *contrast != 0.0);
        // Right-hand side and guess: the single layer and the forced flow over the mean viscosity.
        self.right.clear();
        self.single_layer(contrast)?;
        for (Vectors { x, y }, scale) in self.layers.flow().iter().zip(&self.scales) {
            self.right.extend(x.iter().chain(y).map(|value| value / FOUR_PI * scale));
        }
        if let Some(rigid) = &mut self.rigid {
            let moment = self.layers.force_moment(0..self.layers.kept.first);
            rigid.respond(&mut self.layers, moment, true);
            let flow = self.layers.flow().iter().zip(&self.scales);
            let response = flow.flat_map(|(Vectors { x, y }, scale)| x.iter().chain(y).map(move |u| (u, scale)));
            for (value, (u, scale)) in self.right.iter_mut().zip(response) {
                *value += u / FOUR_PI * scale;
            }
        }
        for (index, (curve, scale)) in self.layers.curves.iter().zip(&self.scales).enumerate() {
            let right = &mut self.right[2 * nodes * index..][..nodes];
            for (value, z) in right.iter_mut().zip(&curve.nodes.position) {
                *value += self.layers.forced_flow(z.im + curve.centre.im, self.viscosity) * self.viscosity * scale;
            }
        }
        let Outcome { iterations, residual } = self.solve_right(contrast)?;
        self.settle_walls();
        if let Some(rigid) = &self.rigid {
            return Ok(Solution { iterations, residual, pressure_gradient: rigid.gradient });
        }
        let density = Density { values: &self.velocities, contrasts: &self.contrasts };
        Ok(Solution { iterations, residual, pressure_gradient: self.layers.pressure_gradient(density, self.viscosity) })
    }

    /// The same in the flow of other forces too: `flow` has viscosity times velocity at all nodes, x then y, interface
    /// after interface, that all forces have in fluid of the exterior viscosity everywhere. Writes velocities there.
    ///
    /// # Errors
    /// No convergence, slices of another length, rigid walls that are curves.
    pub fn solve_in(&mut self, flow: &[f64], velocities: &mut [f64]) -> Result<Solution, LayerError> {
        let entries = 2 * self.settings.nodes * self.len();
        same_length("the flow", entries, flow.len())?;
        same_length("the velocities", entries, velocities.len())?;
        within("the number of rigid walls", (self.layers.curves.len() - self.len()) as f64, 0.0, 0.0)?;
        self.single_layer(true)?;
        self.right.clear();
        let nodes = flow.chunks_exact(2 * self.settings.nodes).zip(&self.scales);
        self.right.extend(nodes.flat_map(|(flow, scale)| flow.iter().map(move |value| value * scale)));
        let Outcome { iterations, residual } = self.solve_right(true)?;
        velocities.copy_from_slice(&self.velocities);
        let interfaces = velocities.chunks_exact_mut(2 * self.settings.nodes).zip(&self.layers.curves);
        for (values, curve) in interfaces.zip(&self.bodies).filter_map(|(pair, rigid)| rigid.then_some(pair)) {
            let motion = RigidMotion::of(curve, values);
            values.fill(0.0);
            motion.add(curve, 1.0, values);
        }
        Ok(Solution { iterations, residual, pressure_gradient: 0.0 })
    }

    /// Solves for the velocities of the right-hand side.
    fn solve_right(&mut self, contrast: bool) -> Result<Outcome, LayerError> {
        let cold = !self.settings.warm_start || self.solution.len() != self.right.len();
        if cold || !contrast {
            self.solution.clone_from(&self.right);
        }
        let mut outcome = Outcome::default();
        if contrast {
            if cold {
                self.gmres.forget();
            }
            outcome = self.solve_contrast().inspect_err(|_| self.solution.clear())?;
        }
        self.velocities.clone_from(&self.solution);
        Ok(outcome)
    }

    fn solve_contrast(&mut self) -> Result<Outcome, LayerError> {
        let Settings { tolerance, most_iterations, .. } = self.settings;
        self.normals.clear();
        self.deflation.clear();
        let mut goal = tolerance;
        let interfaces = self.layers.curves.iter().zip(&self.viscosities).zip(&self.scales).zip(&self.bodies);
        for (((curve, viscosity), scale), rigid) in interfaces {
            // A rigid motion is multiplied by eta_out alone, or with what is around by the exterior viscosity, so a
            // residual in it counts that much more.
            let outside = if *rigid { *viscosity } else { 2.0 / scale - viscosity };
            goal = goal.min(tolerance * outside.min(self.viscosity) * scale);
            // A uniform expansion is multiplied by eta_in alone. The velocity has none, so the operator may do with it
            // as it likes: what is added makes the factor that of the rest.
            self.deflation.push((1.0 - viscosity * scale).max(0.0) / curve.perimeter());
            // Not `norm`, whose care for overflow is slow.
            self.normals.extend(curve.nodes.tangent.iter().map(|t| t.im / t.norm_sqr().sqrt()));
            self.normals.extend(curve.nodes.tangent.iter().map(|t| -t.re / t.norm_sqr().sqrt()));
        }
        goal = goal.max(ATTAINABLE);
        let Self { gmres, layers, rigid, contrasts, scales, bodies, .. } = self;
        let Self { right, solution, normals, deflation, image, .. } = self;
        let operator = Operator { contrasts, scales, bodies, normals, deflation };
        let mut product = |v: &[f64], out: &mut [f64], accuracy: f64| {
            operator.apply(layers, rigid.as_deref_mut(), v, accuracy.max(tolerance), out);
        };
        let mut outcome = gmres.solve(&mut product, right, solution, goal, most_iterations);
        // The residual of a long cycle may be known by round-off alone, and then be far from true.
        while outcome.iterations > TRUSTED {
            image.resize(right.len(), 0.0);
            product(solution, image, tolerance);
            let squares = image.iter().zip(right.iter()).zip(solution.iter());
            let [left, size, scale] = squares.fold([0.0; 3], |[left, size, scale], ((image, right), solution)| {
                [left + (image - right).powi(2), size + solution * solution, scale + right * right]
            });
            // The product is as exact as the tolerance says.
            let residual = (left / scale).sqrt();
            if residual <= goal + PRODUCTS * tolerance * (size / scale).sqrt() {
                break;
            }
            if goal > LOOSEST || outcome.residual > goal {
                outcome.residual = residual;
                break;
            }
            goal *= 10.0;
            gmres.forget();
            solution.clone_from(right);
            let before = outcome.iterations;
            outcome = gmres.solve(&mut product, right, solution, goal, most_iterations);
            outcome.iterations += before;
        }
        let Outcome { iterations, residual } = outcome;
        if residual <= goal {
            Ok(outcome)
        } else {
            Err(LayerError::NoConvergence { iterations, residual, tolerance: goal })
        }
    }

    /// Velocities (length per time) at the points of an interface from the last solution, with the modes that the nodes
    /// carry alone.
    ///
    /// # Errors
    /// No such interface or no solution for it, another number of points, velocities that are not finite.
    pub fn velocities(&mut self, interface: usize, out: &mut [Vec2]) -> Result<(), LayerError> {
        let nodes = self.settings.nodes;
        let expected = self.layers.curves[..self.len()].get(interface).map_or(0, |curve| curve.points);
        same_length("the velocities of an interface", expected, out.len())?;
        same_length("the solution", 2 * nodes * self.len(), self.velocities.len())?;
        let mut values = &self.velocities[2 * nodes * interface..][..2 * nodes];
        if self.bodies[interface] {
            let curve = &self.layers.curves[interface];
            self.motion.clear();
            self.motion.resize(2 * nodes, 0.0);
            RigidMotion::of(curve, values).add(curve, 1.0, &mut self.motion);
            values = &self.motion;
        }
        self.layers.plan(interface).transforms.at_points(values, out)?;
        finite_vectors("the velocity", interface, out)
    }

    /// The motion of a rigid body from the last solution; none where there is no rigid body of that number or no
    /// solution.
    #[must_use]
    pub fn rigid_motion(&self, interface: usize) -> Option<RigidMotion> {
        let nodes = self.settings.nodes;
        let curve = self.layers.curves.get(interface).filter(|_| self.bodies.get(interface) == Some(&true))?;
        Some(RigidMotion::of(curve, self.velocities.get(2 * nodes * interface..2 * nodes * (interface + 1))?))
    }

    /// Takes over velocities at the points of an interface, as if they were the solution. They are none for a rigid
    /// body, whose flow follows from a solution alone.
    ///
    /// # Errors
    /// No such interface, another number of points, velocities that are not finite.
    pub fn set_velocities(&mut self, interface: usize, values: &[Vec2]) -> Result<(), LayerError> {
        let nodes = self.settings.nodes;
        let expected = self.layers.curves[..self.len()].get(interface).map_or(0, |curve| curve.points);
        same_length("the velocities of an interface", expected, values.len())?;
        finite_vectors("the velocity", interface, values)?;
        self.velocities.resize(2 * nodes * self.len(), 0.0);
        self.layers
            .plan(interface)
            .transforms
            .at_nodes(values, &mut self.velocities[2 * nodes * interface..][..2 * nodes])?;
        Ok(())
    }

    /// The flow at points anywhere, at any distance from the interfaces, for the velocities that were solved for or
    /// set.
    ///
    /// # Errors
    /// Points that are not finite, slices of different length, no solution.
    pub fn sample(&mut self, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), LayerError> {
        same_length("out", points.len(), out.len())?;
        finite_vectors("the position", 0, points)?;
        same_length("the solution", 2 * self.settings.nodes * self.len(), self.velocities.len())?;
        if self.rigid.is_some() {
            self.single_layer(self.contrasts.iter().any(|contrast| *contrast != 0.0))?;
            let moment = self.layers.force_moment(0..self.layers.kept.first);
            if let Some(rigid) = &mut self.rigid {
                rigid.respond(&mut self.layers, moment, true);
            }
            self.settle_walls();
        }
        let motions: Vec<_> = (0..self.len()).map(|interface| self.rigid_motion(interface)).collect();
        let Self { layers, rigid, viscosities, contrasts, velocities, .. } = self;
        if let Some(rigid) = rigid {
            layers.set_kept(rigid.forces.as_slice(), true);
            layers.set_gradient(rigid.gradient);
        }
        let density = Density { values: velocities, contrasts };
        let viscosity = |inside: Option<usize>| inside.map_or(self.viscosity, |interface| viscosities[interface]);
        flow_samples(layers, density, points, out, viscosity, &motions);
        if rigid.is_some() {
            layers.set_gradient(0.0);
        }
        Ok(())
    }

    /// What the next solution depends on besides the interfaces.
    #[must_use]
    pub fn warm_start(&self) -> WarmStart {
        let directions = if self.gmres.len() == self.solution.len() { self.gmres.save() } else { Vec::new() };
        WarmStart { velocities: self.solution.clone(), directions }
    }

    /// Continues from what another solution left; what does not fit is ignored.
    pub fn resume(&mut self, WarmStart { velocities, directions }: WarmStart) {
        self.gmres.restore(velocities.len(), &directions);
        self.solution = velocities;
    }
}

/// The left-hand side of the equation over the mean viscosity of each interface.
struct Operator<'a> {
    contrasts: &'a [f64],
    scales: &'a [f64],
    bodies: &'a [bool],
    normals: &'a [f64],
    deflation: &'a [f64],
}

impl Operator<'_> {
    /// `out = v + scale/(4 pi) double layer + deflation`, and twice the mean motion of a rigid body.
    fn apply(&self, layers: &mut Layers, rigid: Option<&mut RigidWalls>, v: &[f64], accuracy: f64, out: &mut [f64]) {
        let density = Density { values: v, contrasts: self.contrasts };
        let nodes = density.nodes();
        layers.double_layer(density, accuracy);
        let interfaces = layers.curves[..self.contrasts.len()].iter().zip(layers.flow());
        for (index, (curve, sum)) in interfaces.enumerate() {
            let range = 2 * nodes * index..2 * nodes * (index + 1);
            let (x, y) = out[range.clone()].split_at_mut(nodes);
            let (vx, vy) = density.of(index);
            let (nx, ny) = self.normals[range].split_at(nodes);
            let factor = self.scales[index] / FOUR_PI;
            let growth = if self.deflation[index] > 0.0 {
                let tangents = &curve.nodes.tangent;
                let flux: f64 = (0..nodes).map(|i| (vx[i] * nx[i] + vy[i] * ny[i]) * tangents[i].norm()).sum();
                self.deflation[index] * flux * curve.weight()
            } else {
                0.0
            };
            for i in 0..nodes {
                x[i] = vx[i] + factor * sum.x[i] + growth * nx[i];
                y[i] = vy[i] + factor * sum.y[i] + growth * ny[i];
            }
            if self.bodies[index] {
                let range = 2 * nodes * index..2 * nodes * (index + 1);
                RigidMotion::of(curve, &v[range.clone()]).add(curve, 2.0, &mut out[range]);
            }
        }
        if let Some(rigid) = rigid {
            rigid.respond(layers, layers.dipole_moment(density), false);
            for ((values, sum), scale) in out.chunks_exact_mut(2 * nodes).zip(layers.flow()).zip(self.scales) {
                for (value, u) in values.iter_mut().zip(sum.x.iter().chain(&sum.y)) {
                    *value += scale / FOUR_PI * u;
                }
            }
        }
    }
}

pub(crate) fn finite_vectors(what: &'static str, curve: usize, values: &[Vec2]) -> Result<(), LayerError> {
    match values.iter().position(|value| !(value.x.is_finite() && value.y.is_finite())) {
        Some(point) => Err(LayerError::NonFinite { what, curve, point, x: values[point].x, y: values[point].y }),
        None => Ok(()),
    }
}

/// The flow at points, for the viscosity that fluid inside a curve or none has, and the motions of the curves that
/// have rigid bodies inside.
pub(crate) fn flow_samples(
    layers: &mut Layers,
    density: Density<'_>,
    points: &[Vec2],
    out: &mut [FlowSample],
    viscosity: impl Fn(Option<usize>) -> f64,
    motions: &[Option<RigidMotion>],
) {
    let points = points.iter().map(|point| Complex64::new(point.x, point.y));
    layers.prepare_points(density, points.clone());
    let exterior = viscosity(None);
    for (index, (point, out)) in points.zip(out).enumerate() {
        let (flow, inside) = layers.flow_at(index, point, density);
        if let Some(motion) = inside.and_then(|curve| *motions.get(curve)?) {
            let centre = Complex64::new(motion.centre.x, motion.centre.y);
            let arm = layers.geometry.images().wrap(point - centre);
            *out = motion.sample(motion.centre + Vec2::new(arm.re, arm.im));
            continue;
        }
        let viscosity = viscosity(inside);
        *out = flow_sample(&flow, viscosity);
        // The forced flow is a parabola, so this difference is its slope.
        let forced = |y: f64| layers.forced_flow(y, exterior) * exterior / viscosity;
        out.velocity.x += forced(point.im);
        out.gradient[0][1] += 0.5 * (forced(point.im + 1.0) - forced(point.im - 1.0));
    }
}

fn flow_sample(flow: &Flow, viscosity: f64) -> FlowSample {
    let factor = 1.0 / FOUR_PI;
    let scale = factor / viscosity;
    FlowSample {
        velocity: Vec2::new(flow.velocity.re * scale, flow.velocity.im * scale),
        pressure: flow.pressure * factor,
        gradient: flow.gradient().map(|row| row.map(|slope| slope * scale)),
    }
}

#[cfg(test)]
mod tests;
