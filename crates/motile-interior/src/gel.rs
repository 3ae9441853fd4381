//! Active polar gel: director, stresses, defects.

/// Methods of bodies whose state is the free angles of their `director`.
macro_rules! of_director {
    () => {
        fn write_state(&self, state: &mut [f64]) {
            state.copy_from_slice(self.director.free_angles());
        }

        fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError> {
            self.director.read(state)
        }

        fn begin_step(&mut self, view: &FluidView, step: StepInfo) -> Result<(), BodyError> {
            self.director.begin_step(step.stabilised, view.viscosity);
            Ok(())
        }

        fn add_implicit(&mut self, state: &[f64], factor: f64, out: &mut [f64]) {
            self.director.stabiliser.add(state, factor, out);
        }

        fn solve_implicit(&mut self, factor: f64, state: &mut [f64]) {
            self.director.stabiliser.solve(factor, state);
        }

        fn step_limits(&self, view: &FluidView, limits: &mut dyn FnMut(StepLimit)) {
            self.director.step_limits(view.viscosity, limits);
        }

        /// Angles (radians).
        fn write_scales(&self, scales: &mut [f64]) {
            scales.fill(1.0);
        }
    };
}

mod conditions;
mod defect;
mod director;
mod elements;
mod in_box;
mod in_layer;
mod material;
mod stabiliser;

pub use conditions::{Anchoring, DirectorStart};
pub use defect::Defect;
pub use director::GelObservables;
pub use in_box::GelInBox;
pub use in_layer::GelInLayer;
pub use material::GelMaterial;

use std::f64::consts::PI;

use active_interface::ActiveDroplet;
use motile_base::Vec2;
use motile_scene::{
    Body, BodyError, BodyFlow, FluidView, Handle, InteriorBody, MarkerKind, Observe, StepInfo, StepLimit, Warning,
};

use director::Director;
use elements::Elements;

use crate::{
    InteriorError,
    filling::{Filling, in_droplet},
    mesh::GROWTH,
};

/// Largest relative error of the activity at which an aster or a vortex loses its stability, on a mesh and a grid of
/// that spacing over the radius, and its order in the spacing. It is the worst of two modes each at alignments down to
/// -0.6 (`tests/rates.rs`). Growth rates are off by up to twice as much.
const CORE_ERROR: f64 = 0.04;
const CORE_SPACING: f64 = 0.05;
const CORE_ORDER: f64 = 0.85;

/// Active polar gel that fills a droplet: a body of a scene ([`motile_scene::InteriorBody`] of the droplet) that puts
/// forces on the fluid at the nodes of a [`DiscMesh`](crate::DiscMesh) whose boundary nodes are the droplet's markers.
/// Its state are the angles of the director.
///
/// The forces have neither resultant nor torque: the couple that turns the director at an anchored interface turns the
/// interface back.
#[derive(Debug, Clone)]
pub struct GelInDroplet {
    name: String,
    filling: Filling,
    director: Director,
    anchoring: Anchoring,
    /// Forces on the fluid at all nodes (force), the droplet's markers first.
    forces: Vec<Vec2>,
}

impl GelInDroplet {
    /// Creates a gel in `droplet`, which is or will be the body `host` of the scene, on a mesh of a spacing (length).
    ///
    /// # Errors
    /// Returns an error for:
    /// * a material that [`GelMaterial::checked`] refuses,
    /// * a spacing that is not positive,
    /// * a mesh of too many nodes,
    /// * angles of the start that are not finite,
    /// * a droplet with a number of markers that changes, or so bent that the mesh folds.
    pub fn new(
        droplet: &ActiveDroplet,
        host: Handle<ActiveDroplet>,
        material: GelMaterial,
        anchoring: Anchoring,
        start: &DirectorStart,
        spacing: f64,
    ) -> Result<Self, InteriorError> {
        let filling = Filling::new(droplet, host, spacing, GROWTH)?;
        let (nodes, markers) = (&filling.nodes, filling.markers());
        let angle = start.angles(markers.iter().sum::<Vec2>() / markers.len() as f64)?;
        let angles = nodes.iter().copied().map(angle).collect();
        let elements = Elements::new(filling.mesh.triangles().to_vec(), nodes.len(), [None; 2]);
        let anchored = anchoring.angle_from_tangent().map(|angle| (angle, markers.len()));
        let mut director = Director::new(material.checked()?, elements, angles, anchored, markers.len());
        director.move_to(nodes);
        let mut forces = vec![Vec2::ZERO; nodes.len()];
        director.write_forces(nodes, &mut forces)?;
        Ok(Self { name: format!("gel of {}", droplet.name()), filling, director, anchoring, forces })
    }

    in_droplet!(mesh);

    /// Returns the director at the nodes, of length 1 (no dimension).
    #[must_use]
    pub fn directors(&self) -> &[Vec2] {
        &self.director.directors
    }

    /// Returns the topological defects of the director.
    #[must_use]
    pub fn defects(&self) -> Vec<Defect> {
        self.director.defects(&self.filling.nodes)
    }
}

impl InteriorBody for GelInDroplet {
    in_droplet!(interior_body);

    fn update_host(&mut self, host: &dyn Body) {
        if self.filling.update_host(host, |_| true).is_some() {
            self.director.move_to(&self.filling.nodes);
        }
    }

    fn add_host_forces(&self, forces: &mut [Vec2]) {
        forces.iter_mut().zip(&self.forces).for_each(|(sum, force)| *sum += force);
    }
}

impl Body for GelInDroplet {
    in_droplet!(body);
    of_director!();

    fn write_forces(&mut self, view: &FluidView, forces: &mut [Vec2]) -> Result<(), BodyError> {
        self.filling.check()?;
        self.director.grid = view.spacing.unwrap_or_default();
        self.director.write_forces(&self.filling.nodes, &mut self.forces)?;
        forces.copy_from_slice(&self.forces[self.filling.inner()]);
        Ok(())
    }

    fn state_len(&self) -> usize {
        self.director.free_angles().len()
    }

    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]) {
        self.filling.set_flow(velocities);
        self.director.write_rate(&self.filling.fluid, &self.filling.motion, rate);
    }

    fn warnings(&self, _view: &FluidView) -> Vec<Warning> {
        if self.defects().is_empty() {
            return Vec::new();
        }
        // The side of a triangle of equal sides, as large as the largest, over the radius of the disc.
        let areas = &self.director.elements.areas;
        let largest = areas.iter().copied().fold(0.0, f64::max);
        let spacing = (4.0 * PI * largest / (3.0_f64.sqrt() * areas.iter().sum::<f64>())).sqrt();
        let error = CORE_ERROR * (spacing / CORE_SPACING).powf(CORE_ORDER);
        let message = format!(
            "the activity at which the director around a defect becomes unstable is off by up to {:.1} %, and growth \
             rates by twice as much. Use a finer mesh and a finer grid, both with a spacing of {:.3} radii for 1 %",
            100.0 * error,
            CORE_SPACING * (0.01 / CORE_ERROR).powf(1.0 / CORE_ORDER)
        );
        let (body, cause) = (self.name.clone(), "core of a defect not resolved".into());
        if error > 0.01 { vec![Warning { body, cause, excess: 100.0 * error, message }] } else { Vec::new() }
    }

    fn properties(&self) -> Vec<(String, f64)> {
        let mut properties = self.director.material.properties();
        properties.push(("the number of nodes".to_owned(), self.filling.nodes.len() as f64));
        properties.push(("the anchoring".to_owned(), f64::from(self.anchoring as u8)));
        properties
    }
}

impl Observe for GelInDroplet {
    type Observables = GelObservables;

    fn observables(&self, _view: &FluidView, _flow: &BodyFlow<'_>) -> Result<GelObservables, BodyError> {
        Ok(self.director.observables(&self.filling.nodes))
    }
}
