//! The flow of fluid interfaces: velocities on them from the forces on them, for any viscosity inside and outside.

mod equation;
mod factors;
mod inside;
mod interface;
mod obstacle;
mod rigid;

use motile_base::{Vec2, finite, positive, same_length, within};

use crate::{
    LayerError, Settings, Symmetry,
    curve::{Curve, LayerCurve},
    density::Density,
    error::finite_vectors,
    gmres::Outcome,
    layer::{Crossing, Layers},
    rigid_motion::RigidMotion,
    sample::{Place, Sampler},
    shares,
};
use equation::Equation;
pub use factors::DenseFactors;
use inside::InsideFlow;
pub use interface::{Inside, Interface};
use motile_base::{Drive, FlowSample, ImposedFlow, Region, boxes::Periods};
use num_complex::Complex64;
pub use obstacle::ObstacleLoad;
use rigid::RigidWalls;

/// Largest ratio of viscosities: with round-off of 1e-16 velocities are then right to 1e-8.
pub const MOST_CONTRAST: f64 = 1e8;

/// Effort and result of a solution for the velocities.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Solution {
    /// Iterations; none where all viscosities are equal.
    pub iterations: usize,
    /// Norm of the residual over the norm of the right-hand side.
    pub residual: f64,
    /// Mean pressure gradient along a channel (stress per length).
    pub pressure_gradient: f64,
}

/// State that one solution leaves for the next, for checkpoints.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct WarmStart {
    /// Velocities at the nodes (length per time), x then y, interface after interface.
    pub velocities: Vec<f64>,
    /// Directions that the iterative solver recycles.
    pub directions: Vec<f64>,
}

/// Stokes flow of fluid interfaces and rigid bodies: velocities on them from the forces on them.
///
/// The velocity v on an interface with the force per length F on it solves (Pozrikidis, Boundary Integral and
/// Singularity Methods, 1992)
///
/// ```text
/// (eta_in + eta_ext)/2 v(x) = 1/(4 pi) INT G(x, y) F(y) ds - (eta_in - eta_ext)/(4 pi) INT v(y) T(x, y) n ds
/// ```
///
/// with the Green's function G of the region and its stress T. Here n points outward, and eta_ext is the viscosity of
/// the fluid right outside of the interface, so that interfaces may lie inside one another. The single layer is
/// integrated by the rule of Kress, the double layer by the trapezoidal rule, both on `nodes` equally spaced values of
/// the parameter. Errors fall faster than any power of the number of nodes. If viscosities differ, the equation is
/// solved by GMRES. Nodes close to another interface get a separate quadrature, so that films are as thin as their flow
/// is resolved by the nodes, whatever the kernel.
///
/// A rigid body is the limit of eta_in to infinity, in which `v = U + Om x (x - x_c) + w/eta_in` with a density w. The
/// first two terms are the rigid motion P w/eta_ext, P the mean rigid motion of a density:
///
/// ```text
/// P w(x) + w(x)/2 = 1/(4 pi) INT G(x, y) F(y) ds - 1/(4 pi) INT w(y) T(x, y) n ds
/// ```
///
/// the completed double layer of Power and Miranda (SIAM J. Appl. Math. 47, 1987) with the forces on the surface F as
/// its completion: the body is free of force and torque where they have neither. The double layer of a rigid motion is
/// zero outside, so that w acts on all else as `eta_in v` does.
///
/// Call [`InterfaceFlow::load`], [`InterfaceFlow::solve`], then [`InterfaceFlow::velocities`] for the velocities on the
/// interfaces and [`InterfaceFlow::sample`] for the flow anywhere. While the numbers of interfaces and points stay the
/// same, nothing is allocated.
#[derive(Debug, Clone)]
#[doc(alias("Ewald", "double layer", "viscosity ratio", "drop", "boundary element method"))]
pub struct InterfaceFlow {
    region: Region,
    viscosity: f64,
    settings: Settings,
    layers: Layers,
    equation: Equation,
    /// Velocities at the nodes of the present interfaces, x then y, interface after interface.
    velocities: Vec<f64>,
    /// Motion of a rigid body at its nodes.
    motion: Vec<f64>,
    walls: Option<Box<RigidWalls>>,
    sampler: Sampler,
    inside: InsideFlow,
}

impl InterfaceFlow {
    /// Creates the flow in a region whose exterior fluid has this viscosity (stress times time), without interfaces.
    ///
    /// # Errors
    /// Returns an error for a viscosity or a length that is not positive and finite, periods of which one is more than
    /// 20 times the other, settings out of their range.
    pub fn new(region: Region, viscosity: f64, settings: Settings) -> Result<Self, LayerError> {
        positive("the viscosity", viscosity)?;
        settings.check()?;
        if region.is_axisymmetric() {
            return Err(LayerError::in_three_dimensions());
        }
        let [velocities, motion] = Default::default();
        let (layers, sampler) =
            (Layers::new(region, settings.tolerance, Symmetry::ToResolution)?, Sampler::new(settings.tolerance));
        let (equation, inside) = (Equation::new(), InsideFlow::default());
        Ok(Self { region, viscosity, settings, layers, equation, velocities, motion, walls: None, sampler, inside })
    }

    /// Adds rigid walls and obstacles at rest to a channel, in place of those that there were. These are open walls
    /// with the fluid on their left, which are the sides of a channel of another shape, and closed ones,
    /// counter-clockwise, with the fluid around them. They are a single layer whose forces f cancel the velocity on
    /// them,
    ///
    /// ```text
    /// 1/(4 pi eta) [INT G f ds over walls  +  layers of the interfaces]  +  forced flow  =  0    on walls
    /// ```
    ///
    /// with the Green's function G of the straight channel around them. The matrix of this equation is factorised here,
    /// once; the force of a uniform pressure behind a wall, which moves nothing, is taken out of f. A given flux is
    /// that between the walls, without the flow that a pressure gradient drives behind them.
    ///
    /// # Errors
    /// Returns an error for another region than a channel; what [`crate::SingleLayer::load`] refuses; more than 3000
    /// nodes; walls that cross or touch.
    pub fn with_walls<'a>(
        mut self,
        walls: impl Iterator<Item = LayerCurve<'a>> + Clone + Send,
    ) -> Result<Self, LayerError> {
        if self.region.slip() != [0.0; 2] {
            let remedy = "Leave one of them out";
            return Err(LayerError::no_such_flow(
                "slip along straight walls behind rigid walls of another shape",
                remedy,
            ));
        }
        let Region::Channel { length, width, drive } = self.region else { return Err(LayerError::no_channel()) };
        // The forcing is that of the flow between the walls.
        let region = Region::Channel { length, width, drive: Drive::ZeroGradient };
        self.layers = Layers::new(region, self.settings.tolerance, Symmetry::ToResolution)?;
        let walls =
            RigidWalls::new(&mut self.layers, &mut self.sampler, [length, width], drive, self.viscosity, walls)?;
        self.walls = Some(Box::new(walls));
        Ok(self)
    }

    /// Imposes a flow in place of the one that there was: in the plane any one, in a channel the flow of sliding walls
    /// ([`ImposedFlow::couette`]), a prescribed flux then being the flux of all flows, in a box a shear, after a strain
    /// (no dimension) by which the images above are displaced along x. The strain counts modulo whole periods.
    ///
    /// # Errors
    /// Returns an error for numbers that are not finite or a flow that does not keep areas; [`LayerError::Refused`] for
    /// a flow that the region does not have.
    pub fn impose(&mut self, flow: ImposedFlow, strain: f64) -> Result<(), LayerError> {
        flow.check()?;
        finite("the strain of the images", strain)?;
        let refuse = |flow, remedy| Err(LayerError::no_such_flow(flow, remedy));
        let along = ImposedFlow { velocity: [flow.velocity[0], 0.0], ..ImposedFlow::shear(flow.shear_rate()) };
        match self.region.without_slip() {
            _ if flow.is_none() => {}
            Region::Plane => {}
            Region::Box { .. } if flow != ImposedFlow::shear(flow.shear_rate()) => {
                return refuse(
                    "a flow other than a shear along x in a periodic box",
                    "Impose a shear along x, or use the plane",
                );
            }
            Region::Box { .. } => {}
            Region::Channel { .. } if flow != along => {
                return refuse(
                    "a flow in a channel that its sliding walls do not drive",
                    "Let the walls slide, prescribe a pressure gradient or a flux, or use the plane",
                );
            }
            Region::Channel { .. } if self.walls.is_some() => {
                return refuse("sliding walls behind rigid walls", "Leave one of them out");
            }
            Region::Channel { .. } => {}
            _ => return Err(LayerError::in_three_dimensions()),
        }
        self.layers.imposed = flow;
        self.layers.set_strain(strain);
        Ok(())
    }

    /// Returns the strain by which the images of a box are displaced (no dimension).
    #[must_use]
    pub fn strain(&self) -> f64 {
        self.layers.strain
    }

    /// Returns the periods of the region, and the displacement of images that are sheared.
    #[must_use]
    pub fn periods(&self) -> Periods {
        self.layers.images.periods
    }

    /// Returns the imposed flow, without what the drive of a channel drives.
    #[must_use]
    pub fn imposed(&self) -> ImposedFlow {
        self.layers.imposed
    }

    /// Returns the forces of the rigid walls on the fluid (force), wall by wall, from the last solution; those by which
    /// a pressure gradient pushes behind open walls are part of them.
    pub fn wall_forces(&self) -> impl Iterator<Item = Vec2> {
        let layers = &self.layers;
        let first = layers.stored.first;
        self.walls.iter().flat_map(move |walls| {
            (first..layers.curves.len()).map(move |wall| {
                let (start, entries) = (layers.entries(first).start, layers.entries(wall));
                let (x, y) =
                    walls.forces.as_slice()[entries.start - start..entries.end - start].split_at(entries.len() / 2);
                Vec2::new(x.iter().sum(), y.iter().sum())
            })
        })
    }

    /// Returns what closed rigid walls bear, wall by wall, from the last solution; `None` for open walls. The fluid
    /// inside of a closed wall is at rest at one pressure, so that all of it comes from the fluid around.
    pub fn obstacle_loads(&self) -> impl Iterator<Item = Option<ObstacleLoad>> {
        let layers = &self.layers;
        let first = layers.stored.first;
        self.walls.iter().flat_map(move |walls| {
            (first..layers.curves.len()).map(move |wall| {
                let (start, entries, curve) = (layers.entries(first).start, layers.entries(wall), &layers.curves[wall]);
                let forces = &walls.forces.as_slice()[entries.start - start..entries.end - start];
                (!curve.is_open()).then(|| ObstacleLoad::of(curve, forces))
            })
        })
    }

    /// Returns the region of the flow.
    #[must_use]
    pub fn region(&self) -> &Region {
        &self.region
    }

    /// Returns the viscosity of the exterior fluid (stress times time).
    #[must_use]
    pub fn viscosity(&self) -> f64 {
        self.viscosity
    }

    /// Returns the resolution and accuracy.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Returns the number of interfaces.
    #[must_use]
    pub fn len(&self) -> usize {
        self.layers.stored.first
    }

    /// Returns true if there are no interfaces.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the arc length of an interface (length), over one period of an open one. It is `None` if there is no
    /// such interface.
    #[must_use]
    pub fn perimeter(&self, interface: usize) -> Option<f64> {
        self.layers.curves[..self.len()].get(interface).map(Curve::perimeter)
    }

    /// Takes over interfaces, truncated to the modes that the nodes carry.
    ///
    /// # Errors
    /// Returns an error for:
    /// * a viscosity that is not positive and finite, or more than 1e8 times larger or smaller than the exterior one,
    ///   where round-off shows,
    /// * positions or forces that are not finite, too few or too many points, a clockwise curve, a node beyond a wall,
    ///   a rigid body so close to a straight wall that its nodes do not resolve the film (an error of 1 % in its
    ///   speed),
    /// * with open interfaces a sheared box, or between fluids of different viscosity a prescribed flux.
    pub fn load<'a>(
        &mut self,
        interfaces: impl Iterator<Item = Interface<'a>> + Clone + Send,
    ) -> Result<(), LayerError> {
        self.equation.clear();
        for Interface { inside, viscosity_outside: outside, .. } in interfaces.clone() {
            let viscosity_inside = if let Inside::Fluid { viscosity } = inside { viscosity } else { outside };
            for (what, viscosity) in [
                ("the viscosity inside an interface", viscosity_inside),
                ("the viscosity outside an interface", outside),
            ] {
                let ratio = positive(what, viscosity)? / self.viscosity;
                within("the ratio of viscosities to the exterior one", ratio, 1.0 / MOST_CONTRAST, MOST_CONTRAST)?;
            }
            self.equation.push(inside, outside);
        }
        self.layers.at_walls = self.viscosities_at_walls(interfaces.clone())?.map(|eta| eta / self.viscosity);
        let nodes = self.settings.nodes;
        let given = |Interface { positions, forces, period, .. }| (LayerCurve { positions, period, nodes }, forces);
        let before = self.len();
        self.layers.sharpness = self.equation.sharpness(self.viscosity);
        self.layers.load(&interfaces.map(given), false)?;
        self.check_films()?;
        let changed = before != self.len();
        if let Some(walls) = &mut self.walls
            && (changed || !walls.checked)
        {
            walls.checked = false;
            check_places(&self.layers)?;
            walls.checked = true;
        }
        Ok(())
    }

    /// Refuses films between rigid bodies and straight walls that the nodes do not resolve.
    fn check_films(&self) -> Result<(), LayerError> {
        let Some(walls) = &self.layers.walls else { return Ok(()) };
        let mut bodies = self.equation.sides.iter().zip(&self.layers.curves).enumerate();
        bodies.try_for_each(
            |(number, (sides, curve))| {
                if sides.is_rigid() { walls.check_film(number, curve) } else { Ok(()) }
            },
        )
    }

    /// Returns the viscosities below the lowest and above the highest open interface, at the walls of a channel (stress
    /// times time).
    fn viscosities_at_walls<'a>(
        &self,
        interfaces: impl Iterator<Item = Interface<'a>>,
    ) -> Result<[f64; 2], LayerError> {
        let mut found = [(f64::INFINITY, self.viscosity), (f64::NEG_INFINITY, self.viscosity)];
        let drive = self.region.drive().unwrap_or(Drive::ZeroGradient);
        let sheared = matches!(self.region, Region::Box { .. }) && !self.layers.imposed.is_none();
        for Interface { positions, period, inside, viscosity_outside: outside, .. } in interfaces {
            let (Inside::Fluid { viscosity: inside }, true) = (inside, period.x != 0.0) else { continue };
            if sheared {
                let flow = "a shear of a box with interfaces that are periodic along x, whose images slide past each \
                            other";
                return Err(LayerError::no_such_flow(flow, "Use a channel with walls that slide"));
            }
            if drive.flux().is_some() && inside != outside {
                let flow = "a flux along interfaces that are periodic along x, between fluids of different viscosity";
                return Err(LayerError::no_such_flow(flow, "Prescribe the pressure gradient"));
            }
            let height = positions.iter().map(|x| x.y).sum::<f64>() / positions.len() as f64;
            let [below, above] = if period.x > 0.0 { [outside, inside] } else { [inside, outside] };
            if height < found[0].0 {
                found[0] = (height, below);
            }
            if height > found[1].0 {
                found[1] = (height, above);
            }
        }
        Ok(found.map(|(_, viscosity)| viscosity))
    }

    /// Computes the single layer of the interfaces, at walls too.
    fn single_layer(&mut self) -> Result<(), LayerError> {
        self.layers.single_layer(self.equation.has_contrast());
        self.layers.crossing().map_or(Ok(()), |Crossing { curve, wall, place }| {
            Err(LayerError::CrossesWall { curve, x: place.re, y: place.im, wall: wall - self.len() })
        })
    }

    /// Replaces the flow of the single layer by the response of the walls to it and to the forcing.
    fn respond(&mut self) {
        if let Some(walls) = &mut self.walls {
            let moment = self.layers.force_moment(0..self.layers.stored.first);
            walls.respond(&mut self.layers, moment, true);
        }
    }

    /// Adds the response of the walls to the double layer of the velocities to the response of
    /// [`InterfaceFlow::respond`].
    fn settle_walls(&mut self) {
        let Self { layers, walls: Some(walls), equation, velocities, settings, .. } = self else { return };
        if equation.has_contrast() {
            let density = Density { values: velocities, contrasts: &equation.contrasts };
            layers.double_layer(density, settings.tolerance);
            walls.respond(layers, layers.dipole_moment(density), false);
            walls.combine();
        }
    }

    /// Solves for the velocities on the interfaces.
    ///
    /// # Errors
    /// Returns an error if there is no convergence.
    pub fn solve(&mut self) -> Result<Solution, LayerError> {
        if self.is_empty() {
            self.velocities.clear();
            if self.walls.is_some() {
                self.single_layer()?;
                self.respond();
            }
            return Ok(Solution { pressure_gradient: self.pressure_gradient(), ..Solution::default() });
        }
        let nodes = self.settings.nodes;
        self.single_layer()?;
        self.equation.begin(nodes);
        self.equation.add_flow(&self.layers);
        if self.walls.is_some() {
            self.respond();
            self.equation.add_flow(&self.layers);
        }
        let forced = self.layers.forced_flow(self.viscosity);
        if !forced.is_none() {
            for ((right, mobility), curve) in self.equation.right_sides().zip(&self.layers.curves) {
                let (along, across) = right.split_at_mut(nodes);
                for ((u, v), z) in along.iter_mut().zip(across).zip(&curve.nodes.position) {
                    let z = z + curve.centre;
                    let velocity = forced.velocity_at(Vec2::new(z.re, z.im));
                    *u += velocity.x * self.viscosity * mobility;
                    *v += velocity.y * self.viscosity * mobility;
                }
            }
        }
        let Outcome { iterations, residual } = self.solve_equation()?;
        self.settle_walls();
        Ok(Solution { iterations, residual, pressure_gradient: self.pressure_gradient() })
    }

    /// Returns the mean pressure gradient of the present velocities (stress per length).
    fn pressure_gradient(&self) -> f64 {
        let density = Density { values: &self.velocities, contrasts: &self.equation.contrasts };
        match &self.walls {
            Some(walls) => walls.gradient,
            None => self.layers.pressure_gradient(density, self.viscosity),
        }
    }

    /// Solves for the velocities on the interfaces (length per time) in the flow of other forces too. `flow` is
    /// viscosity times velocity (force per length in 2D) at all nodes, x then y, interface after interface, that all
    /// forces together have in fluid of the exterior viscosity everywhere.
    ///
    /// # Errors
    /// Returns an error if there is no convergence, or for slices of another length, or rigid walls that are curves.
    pub fn solve_in(&mut self, flow: &[f64], velocities: &mut [f64]) -> Result<Solution, LayerError> {
        let len = 2 * self.settings.nodes;
        same_length("the flow", len * self.len(), flow.len())?;
        same_length("the velocities", len * self.len(), velocities.len())?;
        within("the number of rigid walls", (self.layers.curves.len() - self.len()) as f64, 0.0, 0.0)?;
        self.layers.single_layer(true);
        self.equation.begin(self.settings.nodes);
        for ((right, mobility), flow) in self.equation.right_sides().zip(flow.chunks_exact(len)) {
            right.iter_mut().zip(flow).for_each(|(right, value)| *right = value * mobility);
        }
        let Outcome { iterations, residual } = self.solve_equation()?;
        velocities.copy_from_slice(&self.velocities);
        for (interface, values) in velocities.chunks_exact_mut(len).enumerate() {
            if let Some(motion) = self.rigid_motion(interface) {
                values.fill(0.0);
                motion.add(&self.layers.curves[interface], 1.0, values);
            }
        }
        Ok(Solution { iterations, residual, pressure_gradient: 0.0 })
    }

    fn solve_equation(&mut self) -> Result<Outcome, LayerError> {
        let Self { equation, layers, walls, settings, .. } = self;
        let outcome = equation.solve(layers, walls.as_deref_mut(), settings, self.viscosity)?;
        self.velocities.clone_from(&self.equation.solution);
        Ok(outcome)
    }

    /// Returns the range of the values of an interface among the velocities at all nodes.
    fn values(&self, interface: usize) -> std::ops::Range<usize> {
        let len = 2 * self.settings.nodes;
        len * interface..len * (interface + 1)
    }

    /// Refuses a list of velocities of another length than the points of an interface.
    fn check_points(&self, interface: usize, found: usize) -> Result<(), LayerError> {
        let expected = self.layers.curves[..self.len()].get(interface).map_or(0, |curve| curve.points);
        Ok(same_length("the velocities of an interface", expected, found)?)
    }

    /// Refuses velocities that do not belong to the present interfaces.
    fn check_solved(&self) -> Result<(), LayerError> {
        Ok(same_length("the solution", 2 * self.settings.nodes * self.len(), self.velocities.len())?)
    }

    /// Writes the velocities (length per time) of the last solution at the points of an interface, with the modes that
    /// the nodes carry.
    ///
    /// # Errors
    /// Returns an error if there is no such interface or no solution for it, or for another number of points,
    /// velocities that are not finite.
    pub fn velocities(&mut self, interface: usize, out: &mut [Vec2]) -> Result<(), LayerError> {
        self.check_points(interface, out.len())?;
        self.check_solved()?;
        let range = self.values(interface);
        let mut values = &self.velocities[range.clone()];
        if let Some(motion) = self.rigid_motion(interface) {
            self.motion.clear();
            self.motion.resize(range.len(), 0.0);
            motion.add(&self.layers.curves[interface], 1.0, &mut self.motion);
            values = &self.motion;
        }
        self.layers.plan(interface).transforms.at_points(values, out)?;
        finite_vectors("the velocity", interface, out)
    }

    /// Writes the velocities of [`InterfaceFlow::velocities`] at the points of all interfaces, one after the other.
    ///
    /// # Errors
    /// Returns the errors of [`InterfaceFlow::velocities`]; no solution for the present interfaces.
    pub fn all_velocities(&mut self, out: &mut [Vec2]) -> Result<(), LayerError> {
        let count = self.len();
        let points = |curves: &[Curve]| curves.iter().map(|curve| curve.points).sum::<usize>();
        same_length("the velocities of all interfaces", points(&self.layers.curves[..count]), out.len())?;
        self.check_solved()?;
        let mut rest = out;
        if self.equation.sides.iter().any(|sides| sides.is_rigid()) {
            return (0..count).try_for_each(|interface| {
                let points = self.layers.curves[interface].points;
                self.velocities(interface, rest.split_off_mut(..points).unwrap_or_default())
            });
        }
        let (values, Layers { curves, plans, starts, .. }) = (&self.velocities, &mut self.layers);
        let size = 2 * self.settings.nodes;
        let len = shares::curves(curves.len(), starts[curves.len()]);
        let mut results = std::array::from_fn::<_, { shares::MOST }, _>(|_| Ok(()));
        let shares = curves[..count].chunks(len).zip(values.chunks(size * len)).zip(plans.pieces()).zip(&mut results);
        let shares = shares.enumerate().map(|(share, (((curves, values), plans), result))| {
            let out = rest.split_off_mut(..points(curves)).unwrap_or_default();
            (share * len, curves, values, plans, out, result)
        });
        shares::each_of(starts[count], shares, |(first, curves, values, plans, out, result)| {
            let mut out = std::mem::take(out);
            **result =
                (*first..).zip(&**curves).zip(values.chunks(size)).try_for_each(|((interface, curve), values)| {
                    let out = out.split_off_mut(..curve.points).unwrap_or_default();
                    plans[curve.plan].transforms.at_points(values, out)?;
                    finite_vectors("the velocity", interface, out)
                });
        });
        results.into_iter().collect()
    }

    /// Returns the motion of a rigid body in the last solution. It is `None` if there is no rigid body of that number
    /// or no solution.
    #[must_use]
    pub fn rigid_motion(&self, interface: usize) -> Option<RigidMotion> {
        let curve = self.layers.curves.get(interface)?;
        self.equation.sides.get(interface).filter(|sides| sides.is_rigid())?;
        Some(RigidMotion::of(curve, self.velocities.get(self.values(interface))?))
    }

    /// Returns the force dipole (force times length) of the double layer of a rigid body in the last solution, `D_ij =
    /// -INT (w_i n_j + w_j n_i) ds` with the density w. What holds it rigid adds this to the dipole of the forces on
    /// its surface. `None` if there is no rigid body of that number or no solution.
    #[must_use]
    pub fn rigid_dipole(&self, interface: usize) -> Option<[[f64; 2]; 2]> {
        let curve = self.layers.curves.get(interface)?;
        let sides = self.equation.sides.get(interface).filter(|sides| sides.is_rigid())?;
        let (x, y) = self.velocities.get(self.values(interface))?.split_at(curve.len());
        let factor = -sides.contrast() * curve.weight();
        let nodes = x.iter().zip(y).zip(&curve.nodes.tangent);
        let [xx, xy, yy] = nodes.fold([0.0; 3], |[xx, xy, yy], ((x, y), tangent)| {
            let (nx, ny) = (factor * tangent.im, -factor * tangent.re);
            [xx + 2.0 * x * nx, xy + x * ny + y * nx, yy + 2.0 * y * ny]
        });
        Some([[xx, xy], [xy, yy]])
    }

    /// Takes over velocities (length per time) at the points of an interface in place of a solution. Those of a rigid
    /// body do not determine the flow around it, which follows from a solution alone.
    ///
    /// # Errors
    /// Returns an error if there is no such interface, or for another number of points, velocities that are not finite.
    pub fn set_velocities(&mut self, interface: usize, values: &[Vec2]) -> Result<(), LayerError> {
        self.check_points(interface, values.len())?;
        finite_vectors("the velocity", interface, values)?;
        let range = self.values(interface);
        self.velocities.resize(range.len() * self.len(), 0.0);
        Ok(self.layers.plan(interface).transforms.at_nodes(values, &mut self.velocities[range])?)
    }

    /// Writes the flow at points anywhere, at any distance from the interfaces, for the velocities that were solved for
    /// or set.
    ///
    /// # Errors
    /// Returns an error for points that are not finite, slices of different length, no solution, an interface beyond a
    /// rigid wall.
    pub fn sample(&mut self, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), LayerError> {
        same_length("out", points.len(), out.len())?;
        finite_vectors("the position", 0, points)?;
        self.check_solved()?;
        if self.walls.is_some() {
            self.single_layer()?;
            self.respond();
            self.settle_walls();
        }
        let motions: Vec<_> = (0..self.len()).map(|interface| self.rigid_motion(interface)).collect();
        let Self { layers, walls, equation, velocities, sampler, viscosity: exterior, .. } = self;
        if let Some(walls) = walls {
            layers.set_stored(walls.forces.as_slice(), true);
            layers.set_gradient(walls.gradient);
        }
        let density = Density { values: velocities, contrasts: &equation.contrasts };
        let viscosity = |place: Place| match place {
            Place::Exterior => *exterior,
            Place::Inside(curve) | Place::Beside { curve, left: true } => equation.sides[curve].viscosity(),
            Place::Beside { curve, left: false } => equation.sides[curve].outside,
        };
        sampler.sample(layers, density, points, out, viscosity, |interface| motions[interface])?;
        if walls.is_some() {
            layers.set_gradient(0.0);
        }
        Ok(())
    }

    /// Writes the velocities (length per time) at points inside an interface that encloses no others, for the
    /// velocities on it that were solved for or set; they are all that is needed, whatever lies outside. Spectrally
    /// accurate up to the interface, and far cheaper than [`InterfaceFlow::sample`], which also gives pressure and
    /// gradient, anywhere.
    ///
    /// # Errors
    /// Returns an error for points that are not finite, slices of different length, no such interface, no solution, no
    /// convergence.
    pub fn velocities_inside(&mut self, interface: usize, points: &[Vec2], out: &mut [Vec2]) -> Result<(), LayerError> {
        same_length("out", points.len(), out.len())?;
        finite_vectors("the position", 0, points)?;
        within("the number of an interface", interface as f64, 0.0, self.len() as f64 - 1.0)?;
        self.check_solved()?;
        let (range, images) = (self.values(interface), self.layers.images);
        let Self { layers, inside, velocities, settings, .. } = self;
        let curve = &layers.curves[interface];
        let transforms = &mut layers.plans[curve.plan].transforms;
        inside.prepare(curve, transforms, &velocities[range], settings)?;
        let home = |point: &Vec2| images.wrap(Complex64::new(point.x, point.y) - curve.centre);
        inside.write(points, |point| home(&point), out);
        // In a sheared box an image moves along with the imposed flow there.
        let imposed = layers.imposed;
        if images.periods[1].is_some() && !imposed.is_none() {
            for (point, velocity) in points.iter().zip(out) {
                let home = curve.centre + home(point);
                *velocity += imposed.velocity_at(*point) - imposed.velocity_at(Vec2::new(home.re, home.im));
            }
        }
        Ok(())
    }

    /// Returns the state that the next solution depends on besides the interfaces.
    #[must_use]
    pub fn warm_start(&self) -> WarmStart {
        let velocities = self.equation.solution.clone();
        WarmStart { directions: self.equation.gmres.save(velocities.len()), velocities }
    }

    /// Continues from the state that another solution left; directions that do not fit are dropped.
    pub fn resume(&mut self, WarmStart { velocities, directions }: WarmStart) {
        self.equation.gmres.restore(velocities.len(), &directions);
        self.equation.solution = velocities;
    }
}

/// Refuses interfaces beyond rigid walls.
fn check_places(layers: &Layers) -> Result<(), LayerError> {
    let (interfaces, walls) = layers.curves.split_at(layers.stored.first);
    for (curve, interface) in interfaces.iter().enumerate() {
        for z in &interface.nodes.position {
            let place = z + interface.centre;
            let left = |wall: &Curve| wall.winds_around(layers.images.wrap(place - wall.centre));
            if let Some(wall) = walls.iter().position(|wall| left(wall) != wall.is_open()) {
                return Err(LayerError::CrossesWall { curve, x: place.re, y: place.im, wall });
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
