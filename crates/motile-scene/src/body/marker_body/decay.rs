//! The fastest decay of displacements of markers under a law for their forces.

mod tree;

use std::f64::consts::PI;

use crate::FluidView;
use motile_base::Vec2;
use tree::Tree;

/// Fewest and most evaluations of the law.
const EVALUATIONS: [usize; 2] = [10, 30];
/// Size of the perturbation over the size of the body.
const PERTURBATION: f64 = 1e-6;
/// Fraction of the estimate that may be missing when it is taken.
const TOLERANCE: f64 = 0.1;
/// Most markers of which every pair is summed by itself.
const MOST_PAIRED: usize = 1000;

/// Returns the fastest decay of displacements of markers (1/time) under a law for their forces, as
/// [`MarkerBody::new`](crate::MarkerBody::new) estimates it. Use it for the step limit of a body that you write.
///
/// From positions (length), `law` writes the forces on the fluid (force; zero before the call). It is called at most
/// thirty times, at places near `positions`. Zero if nothing decays, and without markers.
pub fn fastest_decay(view: &FluidView, positions: &[Vec2], mut law: impl FnMut(&[Vec2], &mut [Vec2])) -> f64 {
    if positions.is_empty() { 0.0 } else { Mobility::new(view, positions).fastest_decay(&mut law) }
}

/// Mobility of markers, from above: forces at the distance r move a marker by `(ln(L/r) + 1)/(4 pi eta)`. Here L is the
/// smallest width of the domain and r at least the resolution, because forces that differ within it cancel on a grid.
#[derive(Debug)]
pub(super) struct Mobility<'a> {
    positions: &'a [Vec2],
    viscosity: f64,
    width: f64,
    gyration: f64,
    finest: f64,
}

impl<'a> Mobility<'a> {
    pub(super) fn new(view: &FluidView, positions: &'a [Vec2]) -> Self {
        let count = positions.len() as f64;
        let centre = positions.iter().sum::<Vec2>() / count;
        let gyration = (positions.iter().map(|p| (p - centre).length_squared()).sum::<f64>() / count).sqrt();
        let [x, y] = *view.domain.periods;
        let height = view.domain.walls.map(|[below, above]| above - below);
        let width = [x, y, height].into_iter().flatten().fold(f64::INFINITY, f64::min);
        let width = if width.is_finite() { width } else { gyration };
        let finest = view.spacing.unwrap_or(gyration / count);
        Self { positions, viscosity: view.viscosity, width, gyration, finest }
    }

    /// Returns the velocity for a unit force at the distance r (length).
    fn at(&self, r: f64) -> f64 {
        if r > 0.0 { ((self.width / r).ln().max(0.0) + 1.0) / (4.0 * PI * self.viscosity) } else { 0.0 }
    }

    /// Returns the velocity of all markers under a unit force on each, or of one alone where that is faster.
    pub(super) fn largest(&self) -> f64 {
        self.at(self.finest).max(self.positions.len() as f64 * self.at(self.gyration.max(self.finest)))
    }

    /// [`Mobility::at`] with its derivative, forces within the resolution counting as that far away.
    fn with_slope(&self, r: f64) -> [f64; 2] {
        let flat = r < self.finest || r > self.width || r == 0.0;
        [self.at(r.max(self.finest)), if flat { 0.0 } else { -1.0 / (4.0 * PI * self.viscosity * r) }]
    }

    /// Turns forces at many markers into velocities.
    fn apply_tree(&self, tree: &Tree<'_>, forces: &[Vec2], velocities: &mut [Vec2]) {
        tree.sum(forces, |r| self.with_slope(r), velocities);
        let own = self.at(self.finest);
        velocities.iter_mut().zip(forces).for_each(|(velocity, force)| *velocity += own * *force);
    }

    /// Turns forces at all markers into velocities.
    fn apply(&self, forces: &[Vec2], velocities: &mut [Vec2]) {
        let own = self.at(self.finest);
        velocities.iter_mut().zip(forces).for_each(|(velocity, force)| *velocity = own * *force);
        for (i, place) in self.positions.iter().enumerate() {
            for (j, other) in self.positions[..i].iter().enumerate() {
                let mobility = self.at(place.distance(*other).max(self.finest));
                velocities[i] += mobility * forces[j];
                velocities[j] += mobility * forces[i];
            }
        }
    }

    /// Returns the fastest decay of displacements under a law (1/time). It is the largest eigenvalue of the mobility
    /// times the derivative of the forces, by the power method. Of more than [`MOST_PAIRED`] markers, those far away
    /// are taken together.
    pub(super) fn fastest_decay(&self, law: &mut dyn FnMut(&[Vec2], &mut [Vec2])) -> f64 {
        if self.positions.len() > MOST_PAIRED {
            let tree = Tree::new(self.positions);
            self.power_method(law, |forces, out| self.apply_tree(&tree, forces, out))
        } else {
            self.power_method(law, |forces, out| self.apply(forces, out))
        }
    }

    /// Returns the largest eigenvalue of a matrix times the derivative of the forces; zero if that is not a number.
    ///
    /// The fastest modes lie densely, so that the estimate approaches it only as `1 - c/k` after k evaluations. What is
    /// missing is k times the last change.
    pub(super) fn power_method(
        &self,
        law: &mut dyn FnMut(&[Vec2], &mut [Vec2]),
        matrix: impl Fn(&[Vec2], &mut [Vec2]),
    ) -> f64 {
        let count = self.positions.len();
        let size = [self.gyration, self.finest].into_iter().find(|size| *size > 0.0).unwrap_or(1.0);
        let norm = |list: &[Vec2]| list.iter().map(|v| v.length_squared()).sum::<f64>().sqrt();
        let [mut before, mut forces] = [vec![Vec2::ZERO; count], vec![Vec2::ZERO; count]];
        law(self.positions, &mut before);
        // Neighbours move against each other; the angles keep the direction from being orthogonal to a mode.
        let mut direction: Vec<Vec2> = (0..count).map(|k| Vec2::from_angle(PI * k as f64 + (k % 7) as f64)).collect();
        let mut radius = 0.0_f64;
        for evaluations in 2..=EVALUATIONS[1] {
            let factor = PERTURBATION * size * (count as f64).sqrt() / norm(&direction);
            let moved: Vec<Vec2> = self.positions.iter().zip(&direction).map(|(x, d)| x + factor * d).collect();
            forces.fill(Vec2::ZERO);
            law(&moved, &mut forces);
            forces.iter_mut().zip(&before).for_each(|(force, before)| *force -= before);
            matrix(&forces, &mut direction);
            let grown = norm(&direction) / (PERTURBATION * size * (count as f64).sqrt());
            if grown == 0.0 || !grown.is_finite() {
                return 0.0;
            }
            let last = std::mem::replace(&mut radius, grown);
            let missing = evaluations as f64 * (radius - last).abs();
            if evaluations >= EVALUATIONS[0] && missing < TOLERANCE * radius {
                return radius + missing;
            }
        }
        radius * (1.0 + TOLERANCE)
    }
}
