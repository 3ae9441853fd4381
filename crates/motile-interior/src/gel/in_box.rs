//! Gel that fills a periodic box.

use motile_base::{Vec2, internal::at_least, positive};
use motile_scene::{Body, BodyError, BodyFlow, FluidView, MarkerKind, Observe, StepInfo, StepLimit};

use super::director::{Director, GelObservables};
use super::{elements::Elements, material::GelMaterial};
use crate::InteriorError;

/// Largest number of nodes.
const MOST_NODES: f64 = 1e6;

/// Active polar gel that fills a doubly periodic box: a body of a scene whose markers are nodes at rest, at which it
/// puts forces on the fluid. Its state are the angles of the director.
#[derive(Debug, Clone)]
pub struct GelInBox {
    director: Director,
    nodes: Vec<Vec2>,
    rest: Vec<Vec2>,
}

impl GelInBox {
    /// Creates a gel in a box of the given lengths about the origin (length), with numbers of nodes in x and y, and the
    /// director's angle to x (radians) as a function of position (length).
    ///
    /// # Errors
    /// Returns an error for a material that [`GelMaterial::checked`] refuses; lengths that are not positive; fewer than
    /// 4 nodes along a side; more than a million nodes.
    pub fn new(
        material: GelMaterial,
        lengths: [f64; 2],
        counts: [usize; 2],
        angle: impl FnMut(Vec2) -> f64,
    ) -> Result<Self, InteriorError> {
        lengths.into_iter().try_for_each(|length| positive("a length of the box", length).map(drop))?;
        counts.into_iter().try_for_each(|count| at_least("nodes along a side", count, 4).map(drop))?;
        let [columns, rows] = counts;
        let nodes = columns as f64 * rows as f64;
        if nodes > MOST_NODES {
            return Err(InteriorError::too_fine(nodes, MOST_NODES as usize));
        }
        let number = |column: usize, row: usize| column % columns + columns * (row % rows);
        let place = |column: usize, row: usize| {
            Vec2::new(column as f64 / columns as f64 - 0.5, row as f64 / rows as f64 - 0.5) * Vec2::from(lengths)
        };
        let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
        let nodes: Vec<Vec2> = cells.clone().map(|(column, row)| place(column, row)).collect();
        let triangles = cells.flat_map(|(i, j)| {
            let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
            [[a, b, c], [a, c, d]]
        });
        let elements = Elements::new(triangles.collect(), nodes.len(), lengths.map(Some));
        let angles = nodes.iter().copied().map(angle).collect();
        let mut director = Director::new(material.checked()?, elements, angles, None, 0);
        director.move_to(&nodes);
        Ok(Self { director, rest: vec![Vec2::ZERO; nodes.len()], nodes })
    }

    /// Returns the angles of the director to x at the nodes (radians).
    #[must_use]
    pub fn angles(&self) -> &[f64] {
        &self.director.angles
    }

    /// Returns the positions of the nodes (length), row after row from the lower left corner.
    #[must_use]
    pub fn nodes(&self) -> &[Vec2] {
        &self.nodes
    }
}

impl Body for GelInBox {
    of_director!();

    fn name(&self) -> &str {
        "gel"
    }

    fn kind(&self) -> MarkerKind {
        MarkerKind::Points
    }

    fn marker_count(&self) -> usize {
        self.nodes.len()
    }

    fn write_markers(&self, positions: &mut [Vec2]) {
        positions.copy_from_slice(&self.nodes);
    }

    fn write_forces(&mut self, view: &FluidView, forces: &mut [Vec2]) -> Result<(), BodyError> {
        self.director.grid = view.spacing.unwrap_or_default();
        Ok(self.director.write_forces(&self.nodes, forces)?)
    }

    fn state_len(&self) -> usize {
        self.nodes.len()
    }

    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]) {
        self.director.write_rate(velocities, &self.rest, rate);
    }

    fn properties(&self) -> Vec<(String, f64)> {
        let mut properties = self.director.material.properties();
        properties.push(("the number of nodes".to_owned(), self.nodes.len() as f64));
        properties
    }
}

impl Observe for GelInBox {
    type Observables = GelObservables;

    fn observables(&self, _view: &FluidView, _flow: &BodyFlow<'_>) -> Result<GelObservables, BodyError> {
        Ok(self.director.observables(&self.nodes))
    }
}
