//! A gel that fills a droplet.

use active_interface::ActiveDroplet;
use ib_core::body::{Guest, StepInfo, StepLimit};
use ib_core::scene::BodyFlow;
use ib_core::{Body, BodyError, Discretisation, Handle, MarkerKind, Observe, Vec2};

use super::{Anchoring, Defect, DirectorStart, GelMaterial, director::Director, elements::Elements};
use crate::{InteriorError, filling::Filling};

/// What is seen of a gel at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct GelObservables {
    /// Points about which the director turns.
    pub defects: Vec<Defect>,
    /// Frank energy (force times length).
    pub director_energy: f64,
    /// The mean director (no dimension): of length 1 where it is the same everywhere, 0 for asters and vortices.
    pub polarisation: [f64; 2],
}

impl GelObservables {
    pub(super) fn of(director: &Director, nodes: &[Vec2]) -> Self {
        Self {
            defects: director.defects(nodes),
            director_energy: director.energy(),
            polarisation: director.polarisation().into(),
        }
    }
}

/// A polar gel that fills a droplet, a body of a scene ([`ib_core::body::Guest`]): it puts forces on the fluid at the
/// nodes of a [`DiscMesh`](crate::DiscMesh) whose boundary are the droplet's markers, and its state are the angles of
/// the director.
///
/// It has no torque and no resultant: what turns the director at an anchored interface turns the interface back.
#[derive(Debug, Clone)]
pub struct GelInDroplet {
    name: String,
    filling: Filling,
    director: Director,
    anchoring: Anchoring,
    /// At all nodes, the droplet's markers first.
    forces: Vec<Vec2>,
}

impl GelInDroplet {
    /// A gel in `droplet`, which is or will be the body `host` of the scene, on a mesh of that spacing (length) inside.
    ///
    /// # Errors
    /// Constants that no gel has, a spacing or start that cannot be used, a droplet whose number of markers changes, or
    /// one so bent that the mesh folds.
    pub fn new(
        droplet: &ActiveDroplet,
        host: Handle<ActiveDroplet>,
        material: GelMaterial,
        anchoring: Anchoring,
        start: &DirectorStart,
        spacing: f64,
    ) -> Result<Self, InteriorError> {
        let filling = Filling::new(droplet, host, spacing)?;
        let (nodes, markers) = (&filling.nodes, filling.markers());
        let angles = start.angles(nodes, markers.iter().sum::<Vec2>() / markers.len() as f64)?;
        let elements = Elements::new(filling.mesh.triangles().to_vec(), nodes.len(), [None; 2]);
        let anchored = anchoring.angle_from_tangent().map(|angle| (angle, markers.len()));
        let mut director = Director::new(material.checked()?, elements, angles, anchored);
        director.move_to(nodes);
        let mut forces = vec![Vec2::ZERO; nodes.len()];
        director.write_forces(nodes, &mut forces)?;
        Ok(Self { name: format!("gel of {}", droplet.name()), filling, director, anchoring, forces })
    }

    /// Where the nodes are (length), the droplet's markers first.
    #[must_use]
    pub fn nodes(&self) -> &[Vec2] {
        &self.filling.nodes
    }

    /// Triangles by the numbers of their nodes, counter-clockwise.
    #[must_use]
    pub fn triangles(&self) -> &[[usize; 3]] {
        self.filling.mesh.triangles()
    }

    /// The director at the nodes (no dimension).
    #[must_use]
    pub fn directors(&self) -> &[Vec2] {
        &self.director.directors
    }

    /// The points about which the director turns.
    #[must_use]
    pub fn defects(&self) -> Vec<Defect> {
        self.director.defects(&self.filling.nodes)
    }

    /// The droplet that it fills.
    #[must_use]
    pub fn droplet(&self) -> Handle<ActiveDroplet> {
        self.filling.host
    }
}

impl Guest for GelInDroplet {
    fn host(&self) -> Handle<dyn Body> {
        self.filling.host.into()
    }

    fn see(&mut self, host: &dyn Body) {
        if self.filling.see(host, |_| true).is_some() {
            self.director.move_to(&self.filling.nodes);
        }
    }

    fn add_host_forces(&self, forces: &mut [Vec2]) {
        forces.iter_mut().zip(&self.forces).for_each(|(sum, force)| *sum += force);
    }

    fn see_motion(&mut self, host: &dyn Body, velocities: &[Vec2]) {
        self.filling.see_motion(host, velocities);
    }
}

impl Body for GelInDroplet {
    fn name(&self) -> &str {
        &self.name
    }

    fn kind(&self) -> MarkerKind {
        MarkerKind::Points
    }

    fn marker_count(&self) -> usize {
        self.filling.inner_count()
    }

    fn write_markers(&self, positions: &mut [Vec2]) {
        positions.copy_from_slice(&self.filling.nodes[self.filling.inner()]);
    }

    fn write_forces(&mut self, _medium: &Discretisation, forces: &mut [Vec2]) -> Result<(), BodyError> {
        self.filling.check()?;
        self.director.write_forces(&self.filling.nodes, &mut self.forces)?;
        forces.copy_from_slice(&self.forces[self.filling.inner()]);
        Ok(())
    }

    fn state_len(&self) -> usize {
        self.director.free_angles().len()
    }

    fn write_state(&self, state: &mut [f64]) {
        state.copy_from_slice(self.director.free_angles());
    }

    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError> {
        self.director.read(state)
    }

    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]) {
        self.filling.set_flow(velocities);
        self.director.write_rate(&self.filling.fluid, &self.filling.motion, rate);
    }

    fn begin_step(&mut self, medium: &Discretisation, step: StepInfo) -> Result<(), BodyError> {
        self.director.begin_step(step.stabilised, medium.viscosity);
        Ok(())
    }

    fn add_implicit(&mut self, state: &[f64], factor: f64, out: &mut [f64]) {
        self.director.stabiliser.add(state, factor, out);
    }

    fn solve_implicit(&mut self, factor: f64, state: &mut [f64]) {
        self.director.stabiliser.solve(factor, state);
    }

    fn step_limits(&self, medium: &Discretisation, limits: &mut dyn FnMut(StepLimit)) {
        self.director.step_limits(medium.viscosity, limits);
    }

    fn properties(&self) -> Vec<(String, f64)> {
        let mut properties = self.director.material.properties();
        properties.push(("the number of nodes".to_owned(), self.filling.nodes.len() as f64));
        properties.push(("the anchoring".to_owned(), f64::from(self.anchoring as u8)));
        properties
    }

    fn as_guest(&mut self) -> Option<&mut dyn Guest> {
        Some(self)
    }
}

impl Observe for GelInDroplet {
    type Observables = GelObservables;

    fn observables(&self, _medium: &Discretisation, _flow: &BodyFlow<'_>) -> Result<GelObservables, BodyError> {
        Ok(GelObservables::of(&self.director, &self.filling.nodes))
    }
}
