//! A gel that fills a periodic box.

use ib_core::body::{StepInfo, StepLimit};
use ib_core::input::{at_least, positive};
use ib_core::scene::BodyFlow;
use ib_core::{Body, BodyError, Discretisation, MarkerKind, Observe, Vec2};

use super::{GelMaterial, GelObservables, director::Director, elements::Elements};
use crate::InteriorError;

/// The most nodes.
const MOST_NODES: f64 = 1e6;

/// A polar gel that fills a box with two periods, a body of a scene: its markers are nodes at rest, at which it puts
/// its forces on the fluid, and its state are the angles of the director.
#[derive(Debug, Clone)]
pub struct GelInBox {
    director: Director,
    nodes: Vec<Vec2>,
    rest: Vec<Vec2>,
}

impl GelInBox {
    /// A gel in the box of those lengths about the origin, with so many nodes in x and y, with the director at `angle`
    /// (to x) of the place (length).
    ///
    /// # Errors
    /// Constants that no gel has, lengths that are not positive, fewer than 4 nodes along a side, more than a million.
    pub fn new(
        material: GelMaterial,
        lengths: [f64; 2],
        counts: [usize; 2],
        angle: impl Fn(Vec2) -> f64,
    ) -> Result<Self, InteriorError> {
        lengths.into_iter().try_for_each(|length| positive("a length of the box", length).map(drop))?;
        counts.into_iter().try_for_each(|count| at_least("nodes along a side", count, 4).map(drop))?;
        let [columns, rows] = counts;
        let nodes = columns as f64 * rows as f64;
        if nodes > MOST_NODES {
            return Err(InteriorError::TooFine { nodes, most: MOST_NODES as usize });
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
        let angles = nodes.iter().map(|node| angle(*node)).collect();
        let mut director = Director::new(material.checked()?, elements, angles, None);
        director.move_to(&nodes);
        Ok(Self { director, rest: vec![Vec2::ZERO; nodes.len()], nodes })
    }

    /// Angles of the director at the nodes.
    #[must_use]
    pub fn angles(&self) -> &[f64] {
        &self.director.angles
    }

    /// Where the nodes are (length).
    #[must_use]
    pub fn nodes(&self) -> &[Vec2] {
        &self.nodes
    }
}

impl Body for GelInBox {
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

    fn write_forces(&mut self, _medium: &Discretisation, forces: &mut [Vec2]) -> Result<(), BodyError> {
        Ok(self.director.write_forces(&self.nodes, forces)?)
    }

    fn state_len(&self) -> usize {
        self.nodes.len()
    }

    fn write_state(&self, state: &mut [f64]) {
        state.copy_from_slice(self.director.free_angles());
    }

    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError> {
        self.director.read(state)
    }

    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]) {
        self.director.write_rate(velocities, &self.rest, rate);
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
        properties.push(("the number of nodes".to_owned(), self.nodes.len() as f64));
        properties
    }
}

impl Observe for GelInBox {
    type Observables = GelObservables;

    fn observables(&self, _medium: &Discretisation, _flow: &BodyFlow<'_>) -> Result<GelObservables, BodyError> {
        Ok(GelObservables::of(&self.director, &self.nodes))
    }
}
