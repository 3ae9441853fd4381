//! Tangential velocities of the walls of a channel.

use motile_base::Vec2;
use motile_base::{
    internal::{all_finite, sum},
    not_negative, same_length,
};
use num_complex::Complex64;

use crate::transform::RowTransform;
use crate::{Grid, StokesError};

/// One of the two walls of a channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Wall {
    /// The wall at the first row of nodes.
    Bottom,
    /// The wall at the last row of nodes.
    Top,
}

/// Tangential velocities (length per time) of both walls of a channel, uniform or functions of x. Walls never move
/// along their normal. Fluid can slip along them ([`WallMotion::with_slip`]).
///
/// The default, [`WallMotion::AT_REST`], fits every grid, periodic ones included.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct WallMotion {
    bottom: Vec<f64>,
    top: Vec<f64>,
    /// Slip lengths of the bottom and the top wall (length).
    slip: [f64; 2],
}

impl WallMotion {
    /// Walls at rest.
    pub const AT_REST: Self = Self { bottom: Vec::new(), top: Vec::new(), slip: [0.0; 2] };

    /// Creates walls that slide with uniform velocities (length per time).
    ///
    /// # Errors
    /// Returns an error for a periodic grid, or a velocity that is not finite.
    pub fn uniform(grid: &Grid, bottom: f64, top: f64) -> Result<Self, StokesError> {
        Self::from_fn(grid, |_| bottom, |_| top)
    }

    /// Returns the walls whose velocities (length per time) are functions of x (length, from the grid's origin of
    /// coordinates), taken at the columns of nodes.
    ///
    /// # Errors
    /// Returns an error for a periodic grid, or a velocity that is not finite.
    pub fn from_fn(grid: &Grid, bottom: impl Fn(f64) -> f64, top: impl Fn(f64) -> f64) -> Result<Self, StokesError> {
        if !grid.has_walls() {
            return Err(StokesError::needs_channel());
        }
        let x = |i: usize| grid.origin()[0] + i as f64 * grid.spacing();
        let bottom: Vec<f64> = (0..grid.nx()).map(|i| bottom(x(i))).collect();
        let top: Vec<f64> = (0..grid.nx()).map(|i| top(x(i))).collect();
        all_finite("the velocity of the bottom wall", &bottom)?;
        all_finite("the velocity of the top wall", &top)?;
        Ok(Self { bottom, top, slip: [0.0; 2] })
    }

    /// Lets fluid slip along the bottom and the top wall with these slip lengths b (length): at a wall of velocity U it
    /// moves with `u = U + b du/dn`, n being the normal into the fluid. The ghost velocity behind a wall is then
    /// `((2 b - h) u + 2 h U)/(2 b + h)`.
    ///
    /// # Errors
    /// Returns an error for a length that is negative or not finite.
    pub fn with_slip(self, slip: [f64; 2]) -> Result<Self, StokesError> {
        for length in slip {
            not_negative("the slip length of a wall", length)?;
        }
        Ok(Self { slip, ..self })
    }

    /// Returns the slip lengths of the bottom and the top wall (length).
    #[must_use]
    pub fn slip(&self) -> [f64; 2] {
        self.slip
    }

    /// Returns these walls at rest, with the same slip.
    pub(crate) fn at_rest(&self) -> Self {
        Self { slip: self.slip, ..Self::AT_REST }
    }

    /// Returns the velocity gradient at a wall over the one without slip, `h/(h + 2 b)` (no dimension), for the
    /// velocity half of the spacing h (length) away from the wall.
    pub(crate) fn stick(&self, wall: Wall, spacing: f64) -> f64 {
        let slip = self.slip[usize::from(wall == Wall::Top)];
        spacing / (spacing + 2.0 * slip)
    }

    /// Returns the velocities of a wall (length per time) at the columns of nodes; empty for walls at rest.
    #[must_use]
    pub fn velocities(&self, wall: Wall) -> &[f64] {
        match wall {
            Wall::Bottom => &self.bottom,
            Wall::Top => &self.top,
        }
    }

    /// Returns the velocity of a wall (length per time) at column `i` of nodes.
    #[must_use]
    pub fn at(&self, wall: Wall, i: usize) -> f64 {
        self.velocities(wall).get(i).copied().unwrap_or(0.0)
    }

    /// Returns the mean velocity of a wall over x (length per time).
    #[must_use]
    pub fn mean(&self, wall: Wall) -> f64 {
        let velocities = self.velocities(wall);
        if velocities.is_empty() { 0.0 } else { sum(velocities) / velocities.len() as f64 }
    }

    /// Returns true if both walls are at rest.
    #[must_use]
    pub fn is_at_rest(&self) -> bool {
        self.bottom.iter().chain(&self.top).all(|velocity| *velocity == 0.0)
    }

    /// Returns the velocity along x (length per time) at a point (length) that varies linearly between the walls of a
    /// channel, and linearly between the columns of nodes.
    ///
    /// Between walls that slide uniformly, this is Couette flow. The velocity of the fluid minus it vanishes on both
    /// walls, so that it can be interpolated there.
    #[must_use]
    pub fn between(&self, grid: &Grid, point: Vec2) -> f64 {
        let ([x0, y0], [_, width], nx) = (grid.origin(), grid.lengths(), grid.nx());
        let place = ((point.x - x0) / grid.spacing()).rem_euclid(nx as f64);
        let (column, share) = (place as usize % nx, place - place.floor());
        let along = |wall| (1.0 - share) * self.at(wall, column) + share * self.at(wall, (column + 1) % nx);
        let height = (point.y - y0) / width;
        (1.0 - height) * along(Wall::Bottom) + height * along(Wall::Top)
    }

    /// Writes the Fourier coefficients of the velocities of a wall.
    pub(crate) fn spectrum(&self, wall: Wall, rows: &mut RowTransform, out: &mut [Complex64]) {
        let fill = |row: &mut [f64]| {
            let scale = 1.0 / row.len() as f64;
            for (i, value) in row.iter_mut().enumerate() {
                *value = scale * self.at(wall, i);
            }
        };
        rows.forward(fill, out);
    }

    /// Refuses wall velocities that do not belong to the grid.
    pub(crate) fn check(&self, grid: &Grid) -> Result<(), StokesError> {
        let found = self.bottom.len();
        if found == 0 {
            Ok(())
        } else if grid.has_walls() {
            Ok(same_length("the wall motion", grid.nx(), found)?)
        } else {
            Err(StokesError::needs_channel())
        }
    }
}
