//! Fast sums of boundary integrals over many droplets in a box: errors against sums over pairs, iterations.

use std::f64::consts::{PI, TAU};

use motile::base::{Drive, Region, Vec2};
use motile::boundary_integrals::{BoundaryIntegral, Settings};
use motile::scene::{Hydrodynamics, Markers};

use super::contrast::Droplet;
use crate::validation::StudyError;

/// Nodes of a droplet.
pub const NODES: usize = 64;
/// Thinnest film between droplets (length).
pub const FILM: f64 = 0.02;

/// Region of many droplets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Surroundings {
    /// Periodic box.
    Box,
    /// Channel between walls beside the outermost droplets.
    Channel,
    /// Unbounded fluid.
    Plane,
}

/// Droplets in a periodic box.
#[derive(Debug, Clone)]
pub struct Suspension {
    droplets: Vec<Droplet>,
    lengths: [f64; 2],
}

impl Suspension {
    /// Unit circles `ratio` times as viscous as the fluid outside, on a lattice of so many along x and y, displaced at
    /// random as far as films of [`FILM`] allow, the first two with such a film between them; `fraction` is their part
    /// of the area, tensions point into random directions.
    #[must_use]
    pub fn lattice(counts: [usize; 2], fraction: f64, ratio: f64) -> Self {
        let cell = (PI / fraction).sqrt();
        let mut seed = 12_345_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let mut droplets = Vec::new();
        for k in 0..counts[0] * counts[1] {
            let [i, j] = [k % counts[0], k / counts[0]];
            let mut place = |index: usize| (index as f64 + 0.5) * cell + (cell - 2.0 - FILM) * random();
            let [x, y] = [place(i), place(j)];
            droplets.push(Droplet::circle(1, ratio).at(x, y).turned(TAU * random()));
        }
        if let [first, second, ..] = &mut droplets[..] {
            let from = Vec2::from(first.centre);
            let towards = Vec2::from(second.centre) - from;
            let touching = from + towards * ((2.0 + FILM) / towards.length());
            second.centre = [touching.x, touching.y];
        }
        Self { droplets, lengths: counts.map(|count| count as f64 * cell) }
    }

    /// The box beside itself so many times along x and y, which moves as it does alone.
    #[must_use]
    pub fn repeated(&self, times: [usize; 2]) -> Self {
        let [lx, ly] = self.lengths;
        let shifts = (0..times[0] * times[1]).map(|k| [(k % times[0]) as f64 * lx, (k / times[0]) as f64 * ly]);
        let moved = |[dx, dy]: [f64; 2]| {
            self.droplets.iter().map(move |droplet| droplet.at(droplet.centre[0] + dx, droplet.centre[1] + dy))
        };
        let lengths = [lx * times[0] as f64, ly * times[1] as f64];
        Self { droplets: shifts.flat_map(moved).collect(), lengths }
    }

    /// Number of nodes.
    #[must_use]
    pub fn nodes(&self) -> usize {
        NODES * self.droplets.len()
    }

    /// Velocities at the nodes and the iterations that they took.
    ///
    /// # Errors
    /// Those of the solver.
    pub fn velocities(&self, tolerance: f64) -> Result<(Vec<Vec2>, usize), StudyError> {
        let (mut solver, mut markers) = self.solver(Surroundings::Box, tolerance)?;
        let iterations = solver.velocities(&mut markers)?.iterations;
        Ok((markers.velocities().to_vec(), iterations))
    }

    /// Solver and markers, in other surroundings too.
    ///
    /// # Errors
    /// Those of solvers that such surroundings are refused for.
    pub fn solver(
        &self,
        surroundings: Surroundings,
        tolerance: f64,
    ) -> Result<(BoundaryIntegral, Markers), StudyError> {
        let [length, height] = self.lengths;
        let region = match surroundings {
            Surroundings::Box => Region::Box { lengths: self.lengths },
            Surroundings::Channel => Region::Channel { length, width: height, drive: Drive::ZeroGradient },
            Surroundings::Plane => Region::Plane,
        };
        // The middle of a channel is at y = 0.
        let lower = if surroundings == Surroundings::Channel { 0.5 * height } else { 0.0 };
        let settings = Settings { nodes: NODES, tolerance, ..Settings::default() };
        let solver = BoundaryIntegral::new(region, 1.0, settings)?;
        let mut markers = Markers::new();
        for droplet in &self.droplets {
            let [x, y] = droplet.centre;
            droplet.at(x, y - lower).push_exact(NODES, &mut markers);
        }
        Ok((solver, markers))
    }
}

/// Three droplets, too few for fast sums, whose copies are enough.
#[must_use]
pub fn few(ratio: f64) -> Suspension {
    Suspension::lattice([3, 1], 0.3, ratio)
}

/// Largest error of the velocities of copies of a box at a tolerance, relative to the largest velocity, against those
/// in the box alone.
///
/// # Errors
/// Those of the solver.
pub fn error(alone: &Suspension, exact: &[Vec2], times: [usize; 2], tolerance: f64) -> Result<f64, StudyError> {
    let (found, _) = alone.repeated(times).velocities(tolerance)?;
    let largest = exact.iter().map(|v| v.length()).fold(0.0, f64::max);
    let differences = found.iter().zip(exact.iter().cycle()).map(|(found, exact)| found.distance(*exact));
    Ok(differences.fold(0.0, f64::max) / largest)
}
