//! How scenes are drawn.

use std::path::Path;

use crate::{ColourMap, ColourScale, Error, Format, Limits, Picture, Samples, Snapshot, Vec2};

/// Distance of streamlines, as part of the smaller side.
const STREAMLINES: f64 = 0.05;

/// Times and positions (length) of something that moves, such as a centroid.
pub type Track = Vec<(f64, Vec2)>;

/// How scenes are drawn: pressure in colour, streamlines in the laboratory frame, the interfaces of all droplets
/// coloured by their concentrations, solids, rigid walls, and between walls the paths of the droplets.
///
/// ```
/// use motile::prelude::*;
/// use motile_output::{Look, Raster, Snapshot};
///
/// let Built { mut scene, .. } = Setup::default().build()?;
/// let path = std::env::temp_dir().join("a-droplet.png");
/// let raster = Raster::of(scene.system(), 0.2)?;
/// Look::default().write_picture(&Snapshot::take(scene.system_mut(), raster)?, &[], &path)?;
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Look {
    /// What the pictures say beside the time.
    pub caption: String,
    /// Concentration that counts as 1 (particles per length); if nothing is said, the unit.
    pub concentration: Option<f64>,
    /// Distance of streamlines (length); if nothing is said, a twentieth of the smaller side.
    pub streamline_spacing: Option<f64>,
}

/// The colour scales of pressure and concentration.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scales {
    pressure: ColourScale,
    concentration: ColourScale,
}

impl Look {
    /// Concentrations of all droplets, as they are drawn.
    fn concentrations(&self, seen: &Snapshot) -> Vec<Vec<f64>> {
        let unit = self.concentration.unwrap_or(1.0);
        seen.droplets.iter().map(|droplet| droplet.concentration.iter().map(|c| c / unit).collect()).collect()
    }

    /// Scales for all of these states.
    pub(crate) fn scales(&self, all: &[Snapshot]) -> Scales {
        let pressures: Vec<f64> = all.iter().flat_map(Snapshot::pressure).collect();
        let concentrations: Vec<f64> = all.iter().flat_map(|seen| self.concentrations(seen).concat()).collect();
        Scales {
            pressure: ColourScale::new(ColourMap::Rainbow, Limits::Most, &pressures),
            concentration: ColourScale::new(ColourMap::Magma, Limits::FromZero, &concentrations),
        }
    }

    pub(crate) fn picture(&self, seen: &Snapshot, scales: &Scales, tracks: &[Track]) -> Result<Picture, Error> {
        let [width, height] = seen.raster.size();
        let spacing = self.streamline_spacing.unwrap_or(STREAMLINES * width.min(height));
        let anchor = seen.droplets.first().map_or(Vec2::from(seen.raster.origin()), |droplet| droplet.centroid);
        let label = if self.concentration.is_some() { "concentration c/c_{0}" } else { "concentration c" };
        let mut picture = Picture::new(Samples::new(seen.raster, seen.pressure())?, scales.pressure, "pressure p")
            .title(format!("t = {:.1}   {}", seen.time, self.caption))
            .streamlines(Samples::new(seen.raster, seen.velocity())?, spacing, anchor);
        if !seen.droplets.is_empty() {
            picture = picture.interface_scale(scales.concentration, label);
        }
        for (droplet, values) in seen.droplets.iter().zip(self.concentrations(seen)) {
            picture = picture.interface(&droplet.markers, &values)?;
        }
        picture = seen.solids.iter().fold(picture, Picture::solid);
        let Some([below, above]) = seen.walls else { return Ok(picture) };
        let so_far = |track: &Track| {
            let now = track.partition_point(|(time, _)| *time <= seen.time);
            track[..now].iter().map(|(_, position)| *position).collect::<Vec<Vec2>>()
        };
        picture = picture.walls(below, above);
        Ok(tracks.iter().fold(picture, |picture, track| picture.track(last_period(&so_far(track), width))))
    }

    /// Draws a state to a PNG file, a single droplet in the middle of its periods; between walls with the tracks up to
    /// that time.
    ///
    /// # Errors
    /// [`Error::Write`], and what cannot be drawn.
    pub fn write_picture(&self, seen: &Snapshot, tracks: &[Track], path: impl AsRef<Path>) -> Result<(), Error> {
        let picture = self.picture(seen, &self.scales(std::slice::from_ref(seen)), tracks)?;
        let picture = if let [droplet] = &seen.droplets[..] {
            let middle = Vec2::from(seen.raster.origin()) + 0.5 * Vec2::from(seen.raster.size());
            let periodic = seen.raster.periodic();
            picture.centred_on(Vec2::from_fn(|k, _| if periodic[k] { droplet.centroid[k] } else { middle[k] }))?
        } else {
            picture
        };
        picture.draw(&Format::full())?.write_png(path)
    }
}

/// The end of a path that is no longer than three quarters of the period in x: more of it would be drawn over itself.
fn last_period(path: &[Vec2], period: f64) -> &[Vec2] {
    let Some(&end) = path.last() else { return path };
    let start = path.iter().rposition(|p| (p.x - end.x).abs() > 0.75 * period).map_or(0, |k| k + 1);
    &path[start..]
}

#[cfg(test)]
mod tests;
