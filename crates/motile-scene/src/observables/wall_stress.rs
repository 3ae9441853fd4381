//! Shear stress of the fluid on rigid walls of any shape, and the forces on them.

use std::f64::consts::TAU;

use motile_base::{FlowSample, InputError, PeriodicSeries, Vec2};

use super::channel_forces::{POINTS, SETTLED};
use crate::{Hydrodynamics, SceneError, System, WallOutline};

/// Distances from a wall at which the flow is sampled, over the distance of the wall's points.
const OFFSET: f64 = 1e-3;

/// Stresses of the fluid on a rigid wall at rest that is not one of the straight walls of the region.
///
/// All is per unit of depth, and for one period of a wall that is not closed. Of such a wall only the side counts on
/// which the outline says that the fluid is: what lies behind it, up to the straight wall of the region, does not.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
#[doc(alias("traction", "wall shear stress"))]
pub struct WallStress {
    /// Places on the wall (length).
    pub places: Vec<Vec2>,
    /// Shear stress of the fluid on the wall at each place (stress). On open walls it is positive along x, and on
    /// closed ones counter-clockwise.
    pub shear: Vec<f64>,
    /// Force of the fluid on the wall (force). The part across an open wall depends on the constant of the pressure,
    /// and is left out (zero). Along x, a mean pressure gradient adds a part to the force on an open wall that depends
    /// on where the period begins. Its mean over all beginnings is zero, so that the forces on both sides of a channel
    /// add up to the pressure drop times the mean width.
    pub force: Vec2,
    /// Integral of the shear stress alone along the wall (force).
    pub friction: Vec2,
    /// True for an obstacle, false for a side of a channel.
    pub closed: bool,
    /// Mean height of the upper side of a channel, and minus the mean height of a lower side (length): for both sides,
    /// the sum is the mean width. Zero for closed walls.
    pub reach: f64,
}

impl WallStress {
    /// Returns the largest shear stress in size (stress).
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.shear.iter().fold(0.0, |most, shear| most.max(shear.abs()))
    }
}

/// Returns the derivatives of an outline by the parameter, of which a turn is 2 pi.
fn slopes(outline: &WallOutline) -> Result<Vec<Vec2>, InputError> {
    let count = outline.points.len();
    let mut series = PeriodicSeries::new(count)?;
    // What an open wall advances by is no periodic function.
    let advance = |k: usize| (k as f64 / count as f64) * outline.period;
    let periodic: Vec<Vec2> = outline.points.iter().enumerate().map(|(k, point)| *point - advance(k)).collect();
    series.analyse_vectors(&periodic)?;
    series.differentiate();
    Ok(series.values().iter().map(|slope| Vec2::new(slope.re, slope.im) + outline.period / TAU).collect())
}

impl<H: Hydrodynamics> System<H> {
    /// Returns the shear stress of the fluid on each rigid wall besides the straight walls of the region, and the force
    /// on it, in the present state: in the order of [`System::obstacle_loads`]. The forces are integrals of stresses
    /// that are sampled at the wall, an independent check of the loads on obstacles.
    ///
    /// Walls are in the exterior fluid.
    ///
    /// # Errors
    /// Returns the errors of [`System::sample`].
    pub fn wall_stresses(&mut self) -> Result<Vec<WallStress>, SceneError> {
        self.evaluate()?;
        let outlines = self.hydrodynamics().wall_outlines();
        outlines.iter().map(|outline| self.stress_on(outline)).collect()
    }

    /// Returns the force of the fluid along x (force) on the straight wall of a channel opposite to its only open rigid
    /// wall. It is the integral of the shear stress over a period. Before it comes the number of the straight wall: 0
    /// for the lower one, 1 for the upper one. It is `None` if there is not exactly one open rigid wall.
    ///
    /// # Errors
    /// Returns the errors of [`System::sample`].
    pub fn opposite_wall_force(&mut self) -> Result<Option<(usize, f64)>, SceneError> {
        let (domain, outlines) = (self.hydrodynamics().fluid_view().domain, self.hydrodynamics().wall_outlines());
        let mut open = outlines.iter().filter(|outline| outline.period != Vec2::ZERO);
        let (Some(outline), None, Some(heights), Some(period)) =
            (open.next(), open.next(), domain.walls, domain.periods[0])
        else {
            return Ok(None);
        };
        self.evaluate()?;
        // The fluid is above a wall that runs along x.
        let wall = usize::from(outline.period.x > 0.0);
        let viscosity = self.viscosities_at_walls(self.hydrodynamics().fluid_view().viscosity)[wall];
        let factor = if wall == 0 { viscosity * period } else { -viscosity * period };
        let mut mean = |count: usize, shift: f64| {
            let x = |k: usize| domain.origin[0] + period * (k as f64 + shift) / count as f64;
            let points: Vec<Vec2> = (0..count).map(|k| Vec2::new(x(k), heights[wall])).collect();
            let mut samples = vec![FlowSample::default(); count];
            self.sample(&points, &mut samples)?;
            Ok::<_, SceneError>(factor * samples.iter().map(|s| s.gradient[0][1]).sum::<f64>() / count as f64)
        };
        let [mut count, most] = POINTS;
        let mut force = mean(count, 0.0)?;
        while count < most {
            let next = 0.5 * (force + mean(count, 0.5)?);
            let settled = (next - force).abs() <= SETTLED * next.abs();
            (force, count) = (next, 2 * count);
            if settled {
                break;
            }
        }
        Ok(Some((wall, force)))
    }

    fn stress_on(&mut self, outline: &WallOutline) -> Result<WallStress, SceneError> {
        let viscosity = self.hydrodynamics().fluid_view().viscosity;
        let (count, open) = (outline.points.len(), outline.period != Vec2::ZERO);
        let slopes = slopes(outline)?;
        // Into the fluid, which is on the left of open walls and on the right of closed ones.
        let side = if open { 1.0 } else { -1.0 };
        let normals: Vec<Vec2> = slopes.iter().map(|slope| side * slope.normalize().perp()).collect();
        let step = TAU / count as f64;
        let place = |k: usize, steps: f64| outline.points[k] + steps * OFFSET * step * slopes[k].length() * normals[k];
        // At two distances, from which the stress at the wall follows up to their square.
        let points: Vec<Vec2> = [1.0, 2.0].into_iter().flat_map(|s| (0..count).map(move |k| place(k, s))).collect();
        let mut samples = vec![FlowSample::default(); points.len()];
        self.sample(&points, &mut samples)?;
        let gradient = self.report().mean_pressure_gradient[0];
        let forward = if outline.period.x < 0.0 { -1.0 } else { 1.0 };
        let (mut shear, mut force, mut friction, mut area) = (Vec::with_capacity(count), Vec2::ZERO, Vec2::ZERO, 0.0);
        for k in 0..count {
            let traction = |sample: &FlowSample| {
                let [[xx, xy], [yx, yy]] = sample.gradient;
                let n = normals[k];
                let both = viscosity * (xy + yx);
                Vec2::new(2.0 * viscosity * xx * n.x + both * n.y, both * n.x + 2.0 * viscosity * yy * n.y)
                    - sample.pressure * n
            };
            let stress = 2.0 * traction(&samples[k]) - traction(&samples[count + k]);
            let (weight, tangent) = (step * slopes[k].length(), forward * slopes[k].normalize());
            let along = stress.dot(tangent);
            shear.push(along);
            friction += weight * along * tangent;
            force += weight * stress;
            area -= step * outline.points[k].y * slopes[k].x;
        }
        let reach = if open { area / outline.period.x.abs() } else { 0.0 };
        if open {
            force.y = 0.0;
        } else {
            // The mean gradient is no part of the samples' pressure; counter-clockwise, -INT y dx is the area.
            force.x -= gradient * area;
        }
        Ok(WallStress { places: outline.points.clone(), shear, force, friction, closed: !open, reach })
    }
}
