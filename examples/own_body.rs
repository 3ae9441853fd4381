//! Your own body: a flagellum that swims by a wave of curvature.
//!
//! The flagellum is a chain of markers with springs between them. A phase that grows in time sets the curvature that
//! each part prefers. Since the phase is part of the state, `Flagellum` implements [`Body`]; if markers are all of the
//! state, a closure is enough (`MarkerBody`).
//!
//! `cargo run --release --example own_body` prints a speed of about 0.063 lengths per unit of time, against the
//! direction of the wave. A wave in the other direction swims equally fast the other way.

use std::f64::consts::TAU;

use motile::base::Vec2;
use motile::ib_core::{BSpline, ImmersedBoundary};
use motile::scene::{Body, BodyError, FluidView, MarkerKind, Scene, StepSize};
use motile::stokes_grid::{Grid, PeriodicStokes};

const MARKERS: usize = 41;
const SPACING: f64 = 1.0 / (MARKERS - 1) as f64;
const STRETCHING: f64 = 4e3;
const BENDING: f64 = 0.5;
/// Largest preferred curvature (1/length) and wave number (radians per length).
const CURVATURE: f64 = 6.0;
const WAVE_NUMBER: f64 = TAU;

/// Markers and the phase of the wave, whose state is the list x0, y0, x1, y1, ..., phase.
#[derive(Debug)]
struct Flagellum {
    positions: Vec<Vec2>,
    phase: f64,
    /// Rate at which the phase grows (radians per time).
    frequency: f64,
}

impl Flagellum {
    fn new(frequency: f64) -> Self {
        let place = |k: usize| Vec2::new(k as f64 * SPACING - 0.5, 0.0);
        Self { positions: (0..MARKERS).map(place).collect(), phase: 0.0, frequency }
    }

    fn centre(&self) -> Vec2 {
        self.positions.iter().sum::<Vec2>() / MARKERS as f64
    }
}

impl Body for Flagellum {
    fn name(&self) -> &str {
        "flagellum"
    }

    fn kind(&self) -> MarkerKind {
        MarkerKind::Points
    }

    fn marker_count(&self) -> usize {
        MARKERS
    }

    fn write_markers(&self, positions: &mut [Vec2]) {
        positions.copy_from_slice(&self.positions);
    }

    fn write_forces(&mut self, _view: &FluidView, forces: &mut [Vec2]) -> Result<(), BodyError> {
        forces.fill(Vec2::ZERO);
        for k in 1..MARKERS {
            let link = self.positions[k] - self.positions[k - 1];
            let pull = STRETCHING * (link.length() - SPACING) * link.normalize();
            forces[k - 1] += pull;
            forces[k] -= pull;
        }
        for k in 1..MARKERS - 1 {
            let before = self.positions[k] - self.positions[k - 1];
            let after = self.positions[k + 1] - self.positions[k];
            let preferred = CURVATURE * (WAVE_NUMBER * k as f64 * SPACING - self.phase).sin();
            // The energy is B/2 times the sum of (curvature - preferred)² times the spacing.
            let curvature = before.perp_dot(after) / SPACING.powi(3);
            let torque = BENDING * (curvature - preferred) / SPACING.powi(2);
            let (first, last) = (torque * after.perp(), torque * before.perp());
            forces[k - 1] -= first;
            forces[k] += first + last;
            forces[k + 1] -= last;
        }
        Ok(())
    }

    fn state_len(&self) -> usize {
        2 * MARKERS + 1
    }

    fn write_state(&self, state: &mut [f64]) {
        let coordinates = self.positions.iter().flat_map(|place| [place.x, place.y]);
        state.iter_mut().zip(coordinates.chain([self.phase])).for_each(|(to, value)| *to = value);
    }

    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError> {
        let places = state.chunks_exact(2).map(|pair| Vec2::new(pair[0], pair[1]));
        self.positions.iter_mut().zip(places).for_each(|(to, place)| *to = place);
        self.phase = state[2 * MARKERS];
        Ok(())
    }

    /// The length of the flagellum for places, and radians for the phase.
    fn write_scales(&self, scales: &mut [f64]) {
        scales.fill(MARKERS as f64 * SPACING);
        scales[2 * MARKERS] = 1.0;
    }

    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]) {
        let components = velocities.iter().flat_map(|velocity| [velocity.x, velocity.y]);
        rate.iter_mut().zip(components.chain([self.frequency])).for_each(|(to, value)| *to = value);
    }
}

/// Returns the speed along x of a flagellum whose wave has that frequency (radians per time).
fn speed(frequency: f64) -> Result<f64, Box<dyn std::error::Error>> {
    let solver = PeriodicStokes::new(Grid::periodic(64, 64, 0.04)?, 1.0)?;
    let mut scene = Scene::new(ImmersedBoundary::new(solver, BSpline::<4>));
    let flagellum = scene.add(Flagellum::new(frequency));
    let step = StepSize::Adaptive { tolerance: 1e-4 };
    // The flagellum bends in the first period. We measure its speed over the next two.
    scene.run(1.0).step_size(step).go()?;
    let start = scene.body(flagellum)?.centre();
    scene.run(3.0).step_size(step).go()?;
    Ok(0.5 * (scene.body(flagellum)?.centre() - start).x)
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let [right, left] = [speed(TAU)?, speed(-TAU)?];
    println!("speed {right:.4} lengths per unit of time, with a wave to the left {left:.4}");
    assert!((right + 0.0631).abs() < 0.001);
    assert!((left / right + 1.0).abs() < 1e-3);
    Ok(())
}
