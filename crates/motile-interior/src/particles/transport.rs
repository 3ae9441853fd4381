//! Transport of particles from cell to cell with the fluid.

use motile_base::Vec2;

use super::{cells::Cells, projection::Projection};
use crate::InteriorError;

/// Factor on the fluxes that the limiter lets pass: 1 would preserve linear fields on a regular mesh, 2 leaves room for
/// irregular ones.
const ROOM: f64 = 2.0;

/// Transport of particles with the fluid relative to the mesh.
///
/// Fluxes of fluid between cells come from velocities at the nodes, corrected so that the fluid that leaves each cell
/// matches the change of its area: a uniform density stays uniform however the mesh moves. The density at a face is the
/// mean of its two nodes. If diffusion is too weak for that to stay positive (element Peclet numbers above 2),
/// upwind diffusion is added in part, by the limiter of Zalesak, J. Comput. Phys. 31 (1979) 335, in the form of Kuzmin,
/// J. Comput. Phys. 228 (2009) 2517.
#[derive(Debug, Clone)]
pub(super) struct Transport {
    projection: Projection,
    fluxes: Vec<f64>,
    growth: Vec<f64>,
    densities: Vec<f64>,
    /// Diffusion that each edge lacks for upwind fluxes (length squared per time).
    missing: Vec<f64>,
    /// For each node the largest rise and fall of density to a neighbour, the added fluxes that would raise and lower
    /// it, and the sum of the diffusions that its edges lack.
    bounds: Vec<[f64; 5]>,
    pub(super) pace: Pace,
}

/// How fast the fluid moves relative to the mesh.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Pace {
    /// Largest flux through the faces of a cell, in and out, over its area (1/time).
    pub(super) turnover: f64,
    /// Largest speed at a node (length per time).
    pub(super) speed: f64,
}

impl Pace {
    /// Returns the longest stable step (time) of explicit transport combined with an implicit diffusion of a constant
    /// (length squared per time): no cell is emptied, or diffusion outweighs transport at all wave numbers. The
    /// midpoint rule multiplies a wave of wave number q by `((1 - s)(1 + s) - b^2/2 + i b)/(1 + s)^2`, `s = D q^2
    /// dt/2`, `b = u q dt`, which for large s is less than one where `dt < 2 D/u^2`.
    pub(super) fn longest_step(self, diffusion: f64) -> f64 {
        // As much as is in a cell leaves it: what flows in has been counted too.
        (2.0 / self.turnover).max(diffusion / self.speed.powi(2))
    }
}

impl Transport {
    pub(super) fn new(cells: &Cells, nodes: &[Vec2]) -> Result<Self, InteriorError> {
        let (count, edges) = (cells.areas.len(), cells.edges.len());
        Ok(Self {
            projection: Projection::new(cells, nodes)?,
            fluxes: vec![0.0; edges],
            growth: vec![0.0; count],
            densities: vec![0.0; count],
            missing: vec![0.0; edges],
            bounds: vec![[0.0; 5]; count],
            pace: Pace::default(),
        })
    }

    /// Takes over the velocities of the fluid and of the nodes at the nodes (length per time).
    pub(super) fn set_motion(&mut self, cells: &Cells, nodes: &[Vec2], (fluid, motion): (&[Vec2], &[Vec2])) {
        let Self { projection, fluxes, growth, .. } = self;
        cells.write_fluxes(nodes, (fluid, motion), fluxes, growth);
        // Nothing crosses the interface: the growth of the whole mesh is spread evenly.
        let expansion = growth.iter().sum::<f64>() / cells.areas.iter().sum::<f64>();
        for (growth, area) in growth.iter_mut().zip(&cells.areas) {
            *growth = expansion * area - *growth;
        }
        for (&[i, j], flux) in cells.edges.iter().zip(&*fluxes) {
            growth[i] -= flux;
            growth[j] += flux;
        }
        projection.correct(&cells.edges, growth, fluxes);
        growth.fill(0.0);
        for (&[i, j], flux) in cells.edges.iter().zip(&*fluxes) {
            growth[i] += flux.abs();
            growth[j] += flux.abs();
        }
        let turnover = growth.iter().zip(&cells.areas).map(|(flux, area)| flux / area).fold(0.0, f64::max);
        let square = fluid.iter().zip(motion).map(|(fluid, motion)| (*fluid - *motion).length_squared());
        self.pace = Pace { turnover, speed: square.fold(0.0, f64::max).sqrt() };
    }

    /// Adds the rates of the numbers of particles (1/time) by transport and by diffusion of a constant (length squared
    /// per time).
    pub(super) fn add(&mut self, cells: &Cells, numbers: &[f64], diffusion: f64, rate: &mut [f64]) {
        let Self { fluxes, densities: c, missing, bounds, .. } = self;
        c.iter_mut().zip(numbers).zip(&cells.areas).for_each(|((c, number), area)| *c = number / area);
        bounds.fill([0.0; 5]);
        for ((&[i, j], flux), (missing, weight)) in
            cells.edges.iter().zip(&*fluxes).zip(missing.iter_mut().zip(&cells.weights))
        {
            *missing = (0.5 * flux.abs() - diffusion * weight.max(0.0)).max(0.0);
            let rise = c[j] - c[i];
            for (node, rise) in [(i, rise), (j, -rise)] {
                let [up, down, raised, lowered, sum] = &mut bounds[node];
                (*up, *down) = (up.max(rise), down.min(rise));
                *sum += *missing;
                if rise > 0.0 {
                    *lowered += *missing * rise;
                } else {
                    *raised -= *missing * rise;
                }
            }
        }
        let lists = fluxes.iter().zip(&*missing).zip(&cells.weights);
        for (&[i, j], ((flux, missing), weight)) in cells.edges.iter().zip(lists) {
            let fall = c[i] - c[j];
            let (higher, lower) = if fall > 0.0 { (i, j) } else { (j, i) };
            let [up, _, raised, _, sum] = bounds[higher];
            let [_, down, _, lowered, other] = bounds[lower];
            let part = |room: f64, wanted: f64| if wanted > room { room / wanted } else { 1.0 };
            let kept = part(ROOM * sum * up, raised).min(part(-ROOM * other * down, lowered));
            let carried = 0.5 * flux * (c[i] + c[j]) + ((1.0 - kept) * missing + diffusion * weight) * fall;
            rate[i] -= carried;
            rate[j] += carried;
        }
    }
}

#[cfg(test)]
mod tests;
