//! Gel between an interface along x and the rigid wall behind it.

use std::any::Any;

use active_interface::ActiveInterface;
use motile_base::{Vec2, finite, internal::at_least};
use motile_scene::{
    Body, BodyError, BodyFlow, FluidView, Handle, InteriorBody, MarkerKind, Observe, StepInfo, StepLimit,
};

use super::director::{Director, GelObservables};
use super::{Anchoring, Defect, DirectorStart, elements::Elements, material::GelMaterial};
use crate::InteriorError;

/// Largest number of nodes.
const MOST_NODES: f64 = 1e6;

/// Active polar gel in the layer between an interface that is periodic along x and a flat rigid wall: the "long cell"
/// of Cowley 5.2.2.3.1, whose cytoskeleton answers to the cell that passes. It is a body of a scene
/// ([`motile_scene::InteriorBody`] of the interface). Its state are the angles of the director.
///
/// The nodes stand in columns, one at each marker of the interface, from the interface to the wall. They move with the
/// markers, and as far less as they are closer to the wall. The fluid does not slip there, and the wall takes the
/// forces on it; the director is free there.
#[derive(Debug, Clone)]
pub struct GelInLayer {
    name: String,
    host: Handle<ActiveInterface>,
    director: Director,
    anchoring: Anchoring,
    /// Height of the wall (length).
    wall: f64,
    /// Nodes in a column, without its marker and its end on the wall.
    rows: usize,
    /// For all nodes, the interface's markers first, then the ends on the wall, then the rows between: positions
    /// (length), velocities of the fluid and of the nodes (length per time).
    nodes: Vec<Vec2>,
    fluid: Vec<Vec2>,
    motion: Vec<Vec2>,
    /// Forces on the fluid at all nodes (force).
    forces: Vec<Vec2>,
    /// True if the host is an interface with as many markers as the mesh was made for.
    fits: bool,
}

impl GelInLayer {
    /// Creates a gel between `interface`, which is or will be the body `host` of the scene, and the wall on its inside.
    /// The wall is at the height y = `wall` (length), and the nodes have a spacing across (length).
    ///
    /// # Errors
    /// Returns an error for:
    /// * a material that [`GelMaterial::checked`] refuses,
    /// * a spacing that is not positive, or more than a million nodes,
    /// * angles of the start that are not finite,
    /// * a closed interface, or one beyond the wall.
    pub fn new(
        interface: &ActiveInterface,
        host: Handle<ActiveInterface>,
        material: GelMaterial,
        anchoring: Anchoring,
        start: &DirectorStart,
        [wall, spacing]: [f64; 2],
    ) -> Result<Self, InteriorError> {
        let (markers, advance) = (interface.markers(), interface.advance());
        let count = markers.len();
        finite("the height of the wall", wall)?;
        motile_base::positive("the spacing of the mesh inside", spacing)?;
        at_least("markers", count, 8)?;
        // The inside is above where the interface runs to larger x.
        let depth = |marker: &Vec2| (wall - marker.y) * advance.signum();
        let deepest = markers.iter().map(depth).fold(0.0, f64::max);
        if advance == 0.0 || markers.iter().any(|marker| depth(marker) <= 0.0) {
            return Err(InteriorError::not_below_wall());
        }
        let cells = (deepest / spacing * (1.0 - 1e-12)).ceil().max(2.0);
        if cells * count as f64 > MOST_NODES {
            return Err(InteriorError::too_fine(cells * count as f64, MOST_NODES as usize));
        }
        let rows = cells as usize - 1;
        // The number of the node of a column in a row, counted from the interface.
        let number = |column: usize, row: usize| {
            let column = column % count;
            match row {
                0 => column,
                row if row == rows + 1 => count + column,
                row => (row + 1) * count + column,
            }
        };
        let cells = (0..=rows).flat_map(|row| (0..count).map(move |column| (column, row)));
        let triangles = cells.flat_map(|(i, j)| {
            let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
            [[a, b, c], [a, c, d]]
        });
        let total = (rows + 2) * count;
        let elements = Elements::new(triangles.collect(), total, [Some(advance.abs()), None]);
        let mut nodes = vec![Vec2::ZERO; total];
        nodes[..count].copy_from_slice(markers);
        place(&mut nodes, count, rows, wall);
        let angles = nodes.iter().copied().map(start.angles(Vec2::ZERO)?).collect();
        let anchored = anchoring.angle_from_tangent().map(|angle| (angle, count));
        let mut director = Director::new(material.checked()?, elements, angles, anchored, 2 * count);
        director.move_to(&nodes);
        let [fluid, motion, mut forces] = [(); 3].map(|()| vec![Vec2::ZERO; total]);
        director.write_forces(&nodes, &mut forces)?;
        let name = format!("gel of {}", interface.name());
        Ok(Self { name, host, director, anchoring, wall, rows, nodes, fluid, motion, forces, fits: true })
    }

    /// Returns the positions of the nodes (length): the markers of the interface, the ends of their columns on the
    /// wall, and the rows between.
    #[must_use]
    pub fn nodes(&self) -> &[Vec2] {
        &self.nodes
    }

    /// Returns the angles of the director to x at the nodes (radians).
    #[must_use]
    pub fn angles(&self) -> &[f64] {
        &self.director.angles
    }

    /// Returns the director at the nodes, of length 1 (no dimension).
    #[must_use]
    pub fn directors(&self) -> &[Vec2] {
        &self.director.directors
    }

    /// Returns the triangles by the numbers of their nodes, counter-clockwise.
    #[must_use]
    pub fn triangles(&self) -> &[[usize; 3]] {
        &self.director.elements.triangles
    }

    /// Returns the topological defects of the director.
    #[must_use]
    pub fn defects(&self) -> Vec<Defect> {
        self.director.defects(&self.nodes)
    }

    /// Returns the handle of the interface that encloses the gel.
    #[must_use]
    pub fn interface(&self) -> Handle<ActiveInterface> {
        self.host
    }

    fn markers(&self) -> usize {
        self.nodes.len() / (self.rows + 2)
    }

    /// Returns the interface, if it has as many markers as before.
    fn fitting<'a>(&self, host: &'a dyn Body) -> Option<&'a ActiveInterface> {
        let body: &dyn Any = host;
        body.downcast_ref::<ActiveInterface>().filter(|interface| interface.markers().len() == self.markers())
    }
}

/// Places the ends of columns on the wall and the rows between, below or above the markers, which come first.
fn place(nodes: &mut [Vec2], count: usize, rows: usize, wall: f64) {
    let (markers, rest) = nodes.split_at_mut(count);
    let (ends, inner) = rest.split_at_mut(count);
    for (end, marker) in ends.iter_mut().zip(&*markers) {
        *end = Vec2::new(marker.x, wall);
    }
    for (row, nodes) in inner.chunks_exact_mut(count).enumerate() {
        let part = (row + 1) as f64 / (rows + 1) as f64;
        for ((node, marker), end) in nodes.iter_mut().zip(&*markers).zip(&*ends) {
            *node = *marker + part * (*end - *marker);
        }
    }
}

impl InteriorBody for GelInLayer {
    fn host(&self) -> Handle<dyn Body> {
        self.host.into()
    }

    fn update_host(&mut self, host: &dyn Body) {
        let interface = self.fitting(host);
        self.fits = interface.is_some();
        if let Some(interface) = interface {
            let count = self.markers();
            self.nodes[..count].copy_from_slice(interface.markers());
            place(&mut self.nodes, count, self.rows, self.wall);
            self.director.move_to(&self.nodes);
        }
    }

    fn add_host_forces(&self, forces: &mut [Vec2]) {
        forces.iter_mut().zip(&self.forces).for_each(|(sum, force)| *sum += force);
    }

    fn host_moved(&mut self, host: &dyn Body, velocities: &[Vec2]) {
        let count = self.markers();
        if let Some(interface) = self.fitting(host) {
            self.fluid[..count].copy_from_slice(velocities);
            self.motion[..count].copy_from_slice(interface.marker_motion());
            // Ends of columns slide along the wall.
            place(&mut self.motion, count, self.rows, 0.0);
        }
    }
}

impl Body for GelInLayer {
    of_director!();

    fn name(&self) -> &str {
        &self.name
    }

    fn kind(&self) -> MarkerKind {
        MarkerKind::Points
    }

    fn marker_count(&self) -> usize {
        self.rows * self.markers()
    }

    fn write_markers(&self, positions: &mut [Vec2]) {
        positions.copy_from_slice(&self.nodes[2 * self.markers()..]);
    }

    fn as_interior_body(&mut self) -> Option<&mut dyn InteriorBody> {
        Some(self)
    }

    fn write_forces(&mut self, view: &FluidView, forces: &mut [Vec2]) -> Result<(), BodyError> {
        if !self.fits {
            return Err(InteriorError::changing_markers().into());
        }
        self.director.grid = view.spacing.unwrap_or_default();
        self.director.write_forces(&self.nodes, &mut self.forces)?;
        forces.copy_from_slice(&self.forces[2 * self.markers()..]);
        Ok(())
    }

    fn state_len(&self) -> usize {
        self.director.free_angles().len()
    }

    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]) {
        let first = 2 * self.markers();
        self.fluid[first..].copy_from_slice(velocities);
        self.director.write_rate(&self.fluid, &self.motion, rate);
    }

    fn properties(&self) -> Vec<(String, f64)> {
        let mut properties = self.director.material.properties();
        properties.push(("the number of nodes".to_owned(), self.nodes.len() as f64));
        properties.push(("the height of the wall".to_owned(), self.wall));
        properties.push(("the anchoring".to_owned(), f64::from(self.anchoring as u8)));
        properties
    }
}

impl Observe for GelInLayer {
    type Observables = GelObservables;

    fn observables(&self, _view: &FluidView, _flow: &BodyFlow<'_>) -> Result<GelObservables, BodyError> {
        Ok(self.director.observables(&self.nodes))
    }
}
