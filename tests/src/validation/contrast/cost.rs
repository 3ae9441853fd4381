//! Cost of an evaluation, in transforms of the grid.

use std::hint::black_box;
use std::time::Instant;

use motile::base::Region;
use motile::base::Vec2;
use motile::scene::{Hydrodynamics, MarkerKind, Markers};
use motile::stokes_grid::{RealFft2, Symbol};

use super::{Droplet, layers, smeared};
use crate::validation::StudyError;
use crate::validation::scene::open_channel;

/// The cost of an evaluation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cost {
    /// Time (seconds), the least of all evaluations.
    pub seconds: f64,
    /// Cost in units of one forward and one inverse real transform of the grid.
    pub pairs: f64,
    /// Solves on the grid an evaluation.
    pub solves: f64,
    /// Iterations an evaluation.
    pub iterations: f64,
}

/// A scene to time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CostScene {
    /// Grid spacing (length), for layers the measure of the cost alone.
    pub h: f64,
    /// Nodes of layers.
    pub nodes: usize,
    /// Viscosity of the droplet, that of the exterior fluid being one.
    pub ratio: f64,
    /// A viscosity that is smeared instead of layers.
    pub smeared: bool,
    /// Points that stand for solids along the walls of a channel 12 x 6 long and wide; none in a box 6 x 6.
    pub solid_points: usize,
}

impl CostScene {
    /// Times evaluations of a round droplet that moves by 0.002 from one to the next, about what a time step does.
    ///
    /// # Errors
    /// Those of an evaluation.
    pub fn cost(&self) -> Result<Cost, StudyError> {
        let region = if self.solid_points == 0 { Region::Box { lengths: [6.0; 2] } } else { open_channel(12.0, 6.0) };
        let mut flow = if self.smeared { smeared(region, self.h, 1e-4)? } else { layers(region, self.nodes)? };
        let mut markers = Markers::new();
        Droplet::circle(1, self.ratio).at(0.01, 0.013).push_even(0.5 * self.h, &mut markers)?;
        let droplet = markers.len();
        if self.solid_points > 0 {
            markers.push_group(self.solid_points, MarkerKind::Points);
            // Two walls, 1.5 thick, on a lattice as wide as it takes.
            let columns = (f64::from(self.solid_points as u32) * 12.0 / 3.0).sqrt().ceil() as usize;
            for k in 0..self.solid_points {
                let (i, j) = (k % columns, k / columns);
                let step = 12.0 / columns as f64;
                let y = step * (j as f64 + 0.5);
                let y = if y < 1.5 { 1.4 + y } else { 0.1 - y };
                markers.positions_mut()[droplet + k] = Vec2::new(step * i as f64 - 6.0, y.clamp(-3.0, 3.0));
                markers.forces_mut()[droplet + k] = 1e-4 * Vec2::new((i as f64).sin(), (j as f64).cos());
            }
        }
        const EVALUATIONS: usize = 20;
        let mut best = f64::INFINITY;
        flow.velocities(&mut markers)?;
        flow.velocities(&mut markers)?;
        let before = flow.work();
        for _ in 0..EVALUATIONS {
            markers.positions_mut()[..droplet].iter_mut().for_each(|x| x.x += 0.002);
            let clock = Instant::now();
            flow.velocities(&mut markers)?;
            best = best.min(clock.elapsed().as_secs_f64());
        }
        let after = flow.work();
        let each = |after: usize, before: usize| (after - before) as f64 / EVALUATIONS as f64;
        Ok(Cost {
            seconds: best,
            pairs: best / transform_pair(region.lengths().map(|length| (length / self.h).round() as usize))?,
            solves: each(after.stokes_solves, before.stokes_solves),
            iterations: each(after.iterations, before.iterations),
        })
    }
}

/// Time of a forward and an inverse real transform of a grid (seconds).
fn transform_pair([nx, ny]: [usize; 2]) -> Result<f64, StudyError> {
    let mut transform = RealFft2::new(nx, ny)?;
    let symbol = Symbol::new(nx, ny, |_, _| 1.0)?;
    let values: Vec<f64> = (0..nx * ny).map(|k| (k as f64).sin()).collect();
    let mut out = vec![0.0; nx * ny];
    let mut best = f64::INFINITY;
    for _ in 0..40 {
        let clock = Instant::now();
        transform.filter(
            &symbol,
            |j, row| row.copy_from_slice(&values[j * nx..(j + 1) * nx]),
            |j, row| out[j * nx..(j + 1) * nx].copy_from_slice(row),
        )?;
        best = best.min(clock.elapsed().as_secs_f64());
    }
    black_box(&out);
    Ok(best)
}
