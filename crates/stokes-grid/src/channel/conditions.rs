//! What is prescribed along a channel.

use num_complex::Complex64;

use super::{Drive, Wall, WallMotion};
use crate::transform::RowTransform;
use crate::{Grid, StokesError};

/// The drive and the motion of the walls, with its transform along x.
#[derive(Debug, Clone)]
pub(crate) struct Conditions {
    pub(crate) drive: Drive,
    pub(crate) walls: WallMotion,
    /// Normalised transforms of the velocities of the bottom and the top wall.
    pub(crate) spectra: [Vec<Complex64>; 2],
}

impl Conditions {
    /// No mean pressure gradient and walls at rest, for spectra of `width` numbers.
    pub(crate) fn new(width: usize) -> Self {
        let zeros = vec![Complex64::ZERO; width];
        Self { drive: Drive::default(), walls: WallMotion::AT_REST, spectra: [zeros.clone(), zeros] }
    }

    pub(crate) fn set_drive(&mut self, drive: Drive) -> Result<(), StokesError> {
        drive.check()?;
        self.drive = drive;
        Ok(())
    }

    pub(crate) fn set_walls(
        &mut self,
        walls: WallMotion,
        grid: &Grid,
        rows: &mut RowTransform,
    ) -> Result<(), StokesError> {
        walls.check(grid)?;
        for (wall, spectrum) in [Wall::Bottom, Wall::Top].into_iter().zip(&mut self.spectra) {
            walls.spectrum(wall, rows, spectrum);
        }
        self.walls = walls;
        Ok(())
    }
}
