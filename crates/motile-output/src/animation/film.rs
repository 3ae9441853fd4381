//! Pictures of a droplet and the flow around it: of one time, and of a run.

use std::path::Path;

use anyhow::Result;
use motile::ib_core::{Hydrodynamics, Observer, System};

use crate::{
    Animation, ColourMap, ColourScale, Format, Limits, Picture, Raster, ScalarSamples, Snapshot, Vec2, VectorSamples,
};

/// Frames a second of animations.
const RATE: f64 = 12.0;
/// Most cells of a frame's fields in a direction: more would not be seen.
const FRAME_CELLS: usize = 120;

/// How droplets are drawn: pressure in colour, streamlines in the laboratory frame, the interface coloured by its
/// concentration.
#[derive(Debug, Clone)]
pub struct Look {
    /// What the pictures say beside the time.
    pub caption: String,
    /// Concentration that counts as 1 (particles per length).
    pub concentration: f64,
    /// Heights of rigid walls (length).
    pub walls: Option<[f64; 2]>,
    /// Distance of streamlines (length).
    pub streamline_spacing: f64,
}

/// The colour scales of pressure and concentration.
#[derive(Debug, Clone, Copy)]
struct Scales {
    pressure: ColourScale,
    concentration: ColourScale,
}

impl Look {
    fn scales<'a>(&self, snapshots: impl Iterator<Item = &'a Snapshot> + Clone) -> Scales {
        let pressures: Vec<f64> = snapshots.clone().flat_map(Snapshot::pressure).collect();
        let concentrations: Vec<f64> =
            snapshots.flat_map(|seen| seen.concentration.iter().map(|c| c / self.concentration)).collect();
        Scales {
            pressure: ColourScale::new(ColourMap::Rainbow, Limits::Most, &pressures),
            concentration: ColourScale::new(ColourMap::Magma, Limits::FromZero, &concentrations),
        }
    }

    fn picture(&self, seen: &Snapshot, scales: &Scales, track: &[Vec2]) -> Result<Picture> {
        let concentration: Vec<f64> = seen.concentration.iter().map(|c| c / self.concentration).collect();
        let flow = VectorSamples::new(seen.raster, seen.velocity())?;
        let picture = Picture::new(ScalarSamples::new(seen.raster, seen.pressure())?, scales.pressure, "pressure p")
            .title(format!("t = {:.1}   {}", seen.time, self.caption))
            .streamlines(flow, self.streamline_spacing, seen.centroid)
            .interface_scale(scales.concentration, "concentration c/c_{0}")
            .track(track)
            .interface(&seen.markers, &concentration)?;
        let picture = seen.solids.iter().fold(picture, Picture::solid_shape);
        Ok(match self.walls {
            Some([below, above]) => picture.walls(below, above),
            None => picture,
        })
    }

    /// Draws one time with the droplet in the middle of its periods, between walls with the path of its centroid so
    /// far.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write_picture(&self, seen: &Snapshot, track: &[Vec2], path: &Path) -> Result<()> {
        let track = if self.walls.is_some() { last_period(track, &seen.raster) } else { &[] };
        let picture = self.picture(seen, &self.scales(std::iter::once(seen)), track)?;
        let [low, size] = [seen.raster.origin(), seen.raster.size()].map(Vec2::from);
        let middle = low + 0.5 * size;
        let centre = Vec2::from_fn(|k, _| if seen.raster.periodic()[k] { seen.centroid[k] } else { middle[k] });
        picture.centred_on(centre)?.draw(&Format::full())?.write_png(path)
    }
}

/// Takes a snapshot whenever it is called, and makes an animation of them in the end.
#[derive(Debug)]
pub struct Film {
    look: Look,
    raster: Raster,
    frames: Vec<Snapshot>,
}

impl Film {
    /// A film of the region of `raster`.
    ///
    /// # Errors
    /// None for a raster that was made.
    pub fn new(look: Look, raster: &Raster) -> Result<Self> {
        let cells = raster.cells();
        let most = cells[0].max(cells[1]);
        let cells = cells.map(|n| (n * FRAME_CELLS.min(most) / most).max(1));
        let raster = Raster::new(raster.origin(), raster.size(), cells, raster.periodic())?;
        Ok(Self { look, raster, frames: Vec::new() })
    }

    /// How it is drawn.
    #[must_use]
    pub fn look(&self) -> &Look {
        &self.look
    }

    /// Writes the animation, between walls each frame with the path so far; `track` has times and positions of the
    /// centroid.
    ///
    /// # Errors
    /// No frames, a file that cannot be written.
    pub fn write(&self, track: &[(f64, Vec2)], path: &Path) -> Result<()> {
        let scales = self.look.scales(self.frames.iter());
        let positions: Vec<Vec2> = track.iter().map(|(_, position)| *position).collect();
        let mut animation = Animation::new(path, RATE);
        for seen in &self.frames {
            let so_far = &positions[..track.partition_point(|(time, _)| *time <= seen.time)];
            let track = if self.look.walls.is_some() { last_period(so_far, &self.raster) } else { &[] };
            animation.push(&self.look.picture(seen, &scales, track)?.draw(&Format::frame())?)?;
        }
        animation.finish()
    }
}

/// The end of a path that is no longer than three quarters of the period in x: more of it would be drawn over itself.
pub(crate) fn last_period<'a>(path: &'a [Vec2], raster: &Raster) -> &'a [Vec2] {
    let Some(&end) = path.last() else { return path };
    let reach = 0.75 * raster.size()[0];
    let start = path.iter().rposition(|p| (p.x - end.x).abs() > reach).map_or(0, |k| k + 1);
    &path[start..]
}

impl<H: Hydrodynamics> Observer<H> for Film {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        self.frames.push(Snapshot::take(system, self.raster)?);
        Ok(())
    }
}
