//! The flow of interfaces by boundary integrals.

use crate::RigidWall;
use ib_core::input::{all_points_finite, positive};
use ib_core::{
    Discretisation, Domain, FlowError, FlowSample, Hydrodynamics, MarkerKind, Markers,
    checkpoint::SavedState,
    gap::Boundary,
    hydrodynamics::{FlowWork, SolveReport},
};
use ib_core::{Vec2, hydrodynamics::MarkerGroup};
use stokes_grid::Drive;
use stokes_layers::{Forcing, Geometry, InterfaceFlow, LayerError, Settings, Solution, WarmStart};

/// Stokes flow of closed fluid interfaces in the plane, a periodic box or a channel, without a grid:
/// [`stokes_layers::InterfaceFlow`], which has the equations, for the markers of bodies.
///
/// Every interface comes as a group of markers, [`MarkerKind::Interface`], [`MarkerKind::UnevenInterface`] or
/// [`MarkerKind::Rigid`]: `nodes` or more markers, counter-clockwise, marker k at the parameter 2 pi k/markers.
/// Positions and forces are truncated to the modes that the nodes carry and the velocities come back with these modes
/// alone. Points on which nothing pulls ([`MarkerKind::Points`]) are carried along.
#[derive(Debug, Clone)]
pub struct BoundaryIntegral {
    flow: InterfaceFlow,
    /// Fastest relaxation, as in [`Discretisation`].
    stiffness: f64,
    work: FlowWork,
    walls: Boundary,
    samples: Vec<FlowSample>,
}

impl BoundaryIntegral {
    /// A solver for exterior fluid of the given viscosity (stress times time).
    ///
    /// # Errors
    /// A viscosity that is not positive and finite, or a region or settings out of their range.
    pub fn new(geometry: Geometry, viscosity: f64, settings: Settings) -> Result<Self, LayerError> {
        let flow = InterfaceFlow::new(geometry, viscosity, settings)?;
        let stiffness = stiffness(settings.nodes, std::f64::consts::TAU);
        Ok(Self { flow, stiffness, work: FlowWork::default(), walls: Boundary::default(), samples: Vec::new() })
    }

    /// The same solver for interfaces of which the smallest has this perimeter (length): what
    /// [`Hydrodynamics::discretisation`] assumes until a first evaluation has seen the real ones; 2 pi unless it is
    /// set.
    ///
    /// # Errors
    /// A perimeter that is not positive and finite.
    pub fn with_reference_perimeter(self, perimeter: f64) -> Result<Self, LayerError> {
        positive("the reference perimeter", perimeter)?;
        Ok(Self { stiffness: stiffness(self.settings().nodes, perimeter), ..self })
    }

    /// The same between rigid walls and obstacles in a channel ([`InterfaceFlow::with_walls`]), which is wider than
    /// what they leave. Costs time and memory that grow with the third and second power of the number of their nodes.
    ///
    /// # Errors
    /// Another region than a channel; more than 3000 nodes in all; walls beyond those of the channel; walls that cross
    /// or touch.
    pub fn with_walls(self, walls: &[RigidWall]) -> Result<Self, LayerError> {
        let flow = self.flow.with_walls(walls.iter().map(RigidWall::curve))?;
        let mut boundary = Boundary::default();
        walls.iter().for_each(|wall| wall.add_to(&mut boundary));
        boundary.sort();
        Ok(Self { flow, walls: boundary, ..self })
    }

    /// Forces of the rigid walls on the fluid (force), in their order, from the last evaluation.
    pub fn wall_forces(&self) -> impl Iterator<Item = Vec2> {
        self.flow.wall_forces()
    }

    /// The geometry.
    #[must_use]
    pub fn geometry(&self) -> &Geometry {
        self.flow.geometry()
    }

    /// Resolution and accuracy.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        self.flow.settings()
    }

    /// Takes over positions and forces of the interfaces.
    fn load(&mut self, markers: &Markers) -> Result<(), FlowError> {
        let forced =
            |group: &MarkerGroup| markers.forces()[group.range.clone()].iter().any(|force| *force != Vec2::ZERO);
        if markers.groups().iter().any(|group| group.kind == MarkerKind::Points && forced(group)) {
            return Err(FlowError::Unsupported {
                what: "forces on points that are not on a closed interface",
                remedy: "use the immersed boundary method for scenes with solids or gels",
            });
        }
        let viscosity = self.flow.viscosity();
        let (positions, forces) = (markers.positions(), markers.forces());
        let interface = |(_, group): (usize, &MarkerGroup)| group.interface(positions, forces, viscosity);
        Ok(self.flow.load(interfaces(markers).map(interface))?)
    }

    /// Writes the velocities of points that are not on an interface, of which the flow of the interfaces is known.
    fn carry_points(&mut self, markers: &mut Markers) -> Result<(), FlowError> {
        let Self { flow, samples, .. } = self;
        for index in 0..markers.groups().len() {
            let MarkerGroup { range, kind, .. } = &markers.groups()[index];
            if *kind == MarkerKind::Points {
                let range = range.clone();
                samples.resize(range.len(), FlowSample::default());
                flow.sample(&markers.positions()[range.clone()], samples)?;
                markers.velocities_mut()[range].iter_mut().zip(&*samples).for_each(|(to, seen)| *to = seen.velocity);
            }
        }
        Ok(())
    }
}

/// The groups of markers that are interfaces, numbered as the layers have them.
fn interfaces(markers: &Markers) -> impl Iterator<Item = (usize, &MarkerGroup)> + Clone {
    markers.groups().iter().filter(|group| group.kind.is_interface()).enumerate()
}

impl Hydrodynamics for BoundaryIntegral {
    /// A wave number q on an interface relaxes at the rate `gamma q/(2 (eta_in + eta_out))`, so the stiffness is
    /// `q eta_out/(2 (eta_in + eta_out))` with the largest wave number that the nodes carry, the largest over the
    /// interfaces of the last evaluation; before the first one `q/4` with the reference perimeter.
    fn discretisation(&self) -> Discretisation {
        Discretisation {
            domain: domain(self.geometry()),
            viscosity: self.flow.viscosity(),
            spacing: None,
            shape_modes: Some(self.settings().nodes),
            interface_stiffness: self.stiffness,
        }
    }

    fn drive(&self) -> Option<Drive> {
        let Geometry::Channel { forcing, .. } = *self.geometry() else { return None };
        Some(match forcing {
            Forcing::Gradient(gradient) => Drive::Gradient(gradient),
            Forcing::Flux(flux) => Drive::Flux(flux),
        })
    }

    fn walls(&self) -> Option<&Boundary> {
        if self.walls.is_empty() { None } else { Some(&self.walls) }
    }

    fn velocities(&mut self, markers: &mut Markers) -> Result<SolveReport, FlowError> {
        self.load(markers)?;
        self.work.evaluations += 1;
        if self.flow.is_empty() {
            return Ok(SolveReport::default());
        }
        let (nodes, viscosity) = (self.settings().nodes, self.flow.viscosity());
        let rates = interfaces(markers).filter_map(|(index, group)| {
            let rate = stiffness(nodes, self.flow.perimeter(index)?);
            let [inside, outside] = group.viscosities(viscosity);
            Some(rate * 2.0 * outside / (outside + inside))
        });
        self.stiffness = rates.fold(0.0, f64::max);
        let Solution { iterations, residual, pressure_gradient } = self.flow.solve()?;
        self.work.iterations += iterations;
        self.work.most_iterations = self.work.most_iterations.max(iterations);
        let mut interface = 0;
        for index in 0..markers.groups().len() {
            let MarkerGroup { range, kind, .. } = &markers.groups()[index];
            if kind.is_interface() {
                let range = range.clone();
                self.flow.velocities(interface, &mut markers.velocities_mut()[range])?;
                interface += 1;
            }
        }
        self.carry_points(markers)?;
        Ok(SolveReport { iterations, residual, mean_pressure_gradient: [pressure_gradient, 0.0] })
    }

    fn sample(&mut self, markers: &Markers, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), FlowError> {
        all_points_finite("the points to sample", points)?;
        self.load(markers)?;
        if markers.groups().iter().any(|group| group.kind == MarkerKind::Rigid) {
            // Velocities do not tell of the layer on a rigid body. What the next step starts from stays what it is.
            let before = self.flow.warm_start();
            self.flow.solve()?;
            self.flow.resume(before);
            return Ok(self.flow.sample(points, out)?);
        }
        for (index, group) in interfaces(markers) {
            self.flow.set_velocities(index, &markers.velocities()[group.range.clone()])?;
        }
        Ok(self.flow.sample(points, out)?)
    }

    fn work(&self) -> FlowWork {
        self.work
    }

    fn save(&self) -> SavedState {
        let WarmStart { velocities, directions } = self.flow.warm_start();
        let counts = vec![velocities.len() as u64];
        SavedState { reals: [&[self.stiffness], velocities.as_slice(), directions.as_slice()].concat(), counts }
    }

    fn load(&mut self, saved: &SavedState) {
        let ([stiffness, rest @ ..], &[count]) = (saved.reals.as_slice(), saved.counts.as_slice()) else { return };
        let count = usize::try_from(count).unwrap_or(usize::MAX);
        let (Some(velocities), Some(directions)) = (rest.get(..count), rest.get(count..)) else { return };
        self.stiffness = *stiffness;
        self.flow.resume(WarmStart { velocities: velocities.to_vec(), directions: directions.to_vec() });
    }
}

/// A region as bodies see it, with its middle at the origin.
fn domain(geometry: &Geometry) -> Domain {
    let unbounded = Domain { origin: [0.0; 2], periods: [None; 2], walls: None };
    match *geometry {
        Geometry::Box { lengths } => {
            Domain { origin: lengths.map(|length| -0.5 * length), periods: lengths.map(Some), ..unbounded }
        }
        Geometry::Channel { length, width, .. } => {
            let (origin, walls) = ([-0.5 * length, -0.5 * width], Some([-0.5 * width, 0.5 * width]));
            Domain { origin, periods: [Some(length), None], walls }
        }
        Geometry::Plane => unbounded,
    }
}

/// A quarter of the largest wave number of a curve.
fn stiffness(nodes: usize, perimeter: f64) -> f64 {
    0.25 * (nodes / 2) as f64 * std::f64::consts::TAU / perimeter
}
