//! Animations of runs.

use std::path::Path;

use motile::ib_core::{Hydrodynamics, Observer, System};

use crate::{Animation, Error, Format, Look, Raster, Snapshot, Track};

/// Frames a second of animations.
const RATE: f64 = 12.0;
/// Most cells of a frame's fields in a direction: more would not be seen.
const FRAME_CELLS: usize = 120;

/// Takes a [`Snapshot`] whenever it is called, and makes an animation of them in the end.
///
/// ```
/// use motile::prelude::*;
/// use motile_output::{Film, Look, Raster};
///
/// let Built { mut scene, .. } = Setup::default().build()?;
/// let mut film = Film::new(Look::default(), Raster::of(scene.system(), 0.2)?);
/// scene.run(0.2).observe(Every::Time(0.1), &mut film).go()?;
/// let path = std::env::temp_dir().join("a-droplet.gif");
/// film.write(&[], &path)?;
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Film {
    look: Look,
    raster: Raster,
    frames: Vec<Snapshot>,
}

impl Film {
    /// A film of the rectangle of `raster`, with fields on its cells or, where these are more than 120 in a direction, on
    /// larger ones.
    #[must_use]
    pub fn new(look: Look, raster: Raster) -> Self {
        Self { look, raster: raster.coarsened(FRAME_CELLS), frames: Vec::new() }
    }

    /// How it is drawn.
    #[must_use]
    pub fn look(&self) -> &Look {
        &self.look
    }

    /// Writes the animation (GIF), between walls each frame with the tracks so far.
    ///
    /// # Errors
    /// [`Error::Empty`] without frames, [`Error::Write`], and what cannot be drawn.
    pub fn write(&self, tracks: &[Track], path: impl AsRef<Path>) -> Result<(), Error> {
        let scales = self.look.scales(&self.frames);
        let mut animation = Animation::new(RATE);
        for seen in &self.frames {
            animation.push(&self.look.picture(seen, &scales, tracks)?.draw(&Format::frame())?)?;
        }
        animation.write(path)
    }
}

impl<H: Hydrodynamics> Observer<H> for Film {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        self.frames.push(Snapshot::take(system, self.raster)?);
        Ok(())
    }
}
