//! Pictures of scenes.

mod paint;

use std::path::Path;

use crate::{ColourScale, Error, Snapshot, Vec2, drawing::Drawing};

/// Distance of streamlines, as part of the smaller side.
const STREAMLINES: f64 = 0.05;

/// Times and positions (length) of something that moves, such as a centroid.
pub type Track = Vec<(f64, Vec2)>;

/// How scenes are drawn: pressure in colour, streamlines in the laboratory frame, the interfaces of all droplets
/// coloured by their concentrations (black without particles), the densities of particles that diffuse inside in place
/// of the pressure, the directors and defects of gels, solids, rigid walls, between walls the paths of the droplets,
/// the time and a scale bar. In periodic directions everything is drawn with its periodic images, so positions need not
/// be wrapped.
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
    /// What the colour of solids shows.
    pub solids: SolidColour,
}

/// What the colour of solids shows.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum SolidColour {
    /// Nothing: all solids are grey.
    #[default]
    Plain,
    /// The distance of each triangle from its reference place (length).
    Displacement,
    /// The deviator of the Cauchy stress, `sqrt(((s_xx - s_yy)/2)^2 + s_xy^2)` (force per length).
    Stress,
}

/// A solid as it is drawn.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SolidShape {
    /// Closed outlines of what is filled (length), one within another for a hole.
    pub area: Vec<Vec<Vec2>>,
    /// Lines that are drawn as its surface (length).
    pub edges: Vec<Vec<Vec2>>,
    /// The corners of its triangles (length), for colours.
    pub triangles: Vec<[Vec2; 3]>,
    /// Of each triangle the distance from its reference place (length).
    pub displacement: Vec<f64>,
    /// Of each triangle the deviator of the Cauchy stress (force per length), not a number if it is inverted.
    pub stress: Vec<f64>,
}

impl SolidShape {
    /// The values that a colour shows, one a triangle.
    fn values(&self, colour: SolidColour) -> &[f64] {
        match colour {
            SolidColour::Plain => &[],
            SolidColour::Displacement => &self.displacement,
            SolidColour::Stress => &self.stress,
        }
    }
}

/// Size and detail of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Format {
    /// Width of the image (pixels); its height follows from the shape of the region.
    width: usize,
    /// Number of colours of the pressure: few show contour bands, and make animations small.
    levels: usize,
    /// Factor on the distance between streamlines.
    streamline_spacing: f64,
    /// Width of the image relative to the size of the type.
    type_sizes: f64,
    /// Whether a single droplet is in the middle of its periods.
    follows: bool,
}

impl Format {
    const STILL: Self = Self { width: 1200, levels: 256, streamline_spacing: 1.0, type_sizes: 58.0, follows: true };
    /// For animations.
    pub(crate) const FRAME: Self =
        Self { width: 440, levels: 20, streamline_spacing: 2.0, type_sizes: 37.0, follows: false };
}

/// The colour scales of pressure, concentration and density inside where there are particles, and solids where they are
/// coloured.
#[derive(Debug)]
pub(crate) struct Legends {
    pressure: ColourScale,
    concentration: Option<ColourScale>,
    inside: Option<ColourScale>,
    solids: Option<ColourScale>,
    /// Concentration that counts as 1 (particles per length).
    unit: f64,
}

/// A picture: what is in it.
#[derive(Debug)]
struct Picture<'a> {
    seen: &'a Snapshot,
    legends: &'a Legends,
    title: String,
    solids: SolidColour,
    streamline_spacing: f64,
    tracks: Vec<Vec<Vec2>>,
    /// Lower left and upper right corner of what is shown (length).
    view: [Vec2; 2],
    format: &'a Format,
}

impl Look {
    /// Scales for all of these states.
    pub(crate) fn legends(&self, all: &[Snapshot]) -> Legends {
        let pressures = all.iter().flat_map(|seen| seen.flow.iter().map(|sample| sample.pressure));
        let unit = self.concentration.unwrap_or(1.0);
        let droplets = all.iter().flat_map(|seen| &seen.droplets);
        let concentrations = droplets.flat_map(|droplet| droplet.concentration.iter().map(|c| c / unit));
        let label = if self.concentration.is_some() { "concentration c/c_{0}" } else { "concentration c" };
        let inside = all.iter().flat_map(|seen| &seen.inside).flat_map(|field| field.densities.iter().flatten());
        let solids = all.iter().flat_map(|seen| &seen.solids).flat_map(|solid| solid.values(self.solids));
        let of_solids = if self.solids == SolidColour::Stress { "stress deviator" } else { "displacement" };
        Legends {
            solids: ColourScale::from_zero(solids.copied(), of_solids).map(ColourScale::green),
            pressure: ColourScale::of_most(pressures, "pressure p"),
            concentration: ColourScale::from_zero(concentrations, label),
            inside: ColourScale::from_zero(inside.copied(), "density inside C").map(ColourScale::green),
            unit,
        }
    }

    /// A state with the tracks up to its time.
    pub(crate) fn draw(
        &self,
        seen: &Snapshot,
        legends: &Legends,
        tracks: &[Track],
        format: &Format,
    ) -> Result<Drawing, Error> {
        let (corner, size) = (Vec2::from(seen.raster.origin), Vec2::from(seen.raster.size));
        let mut centre = corner + 0.5 * size;
        if let ([droplet], true) = (&seen.droplets[..], format.follows) {
            (0..2).filter(|&k| seen.raster.periodic[k]).for_each(|k| centre[k] = droplet.centroid[k]);
        }
        let so_far = |track: &Track| {
            let path: Vec<Vec2> = track.iter().filter(|(time, _)| *time <= seen.time).map(|(_, at)| *at).collect();
            last_period(&path, size.x).to_vec()
        };
        let spacing = self.streamline_spacing.unwrap_or(STREAMLINES * size.min_element());
        paint::paint(&Picture {
            seen,
            legends,
            title: format!("t = {:.1}   {}", seen.time, self.caption),
            solids: self.solids,
            streamline_spacing: spacing * format.streamline_spacing,
            tracks: if seen.walls.is_some() { tracks.iter().map(so_far).collect() } else { Vec::new() },
            view: [centre - 0.5 * size, centre + 0.5 * size],
            format,
        })
    }

    /// Draws a state to a file, SVG where its name ends in `.svg` and PNG otherwise, a single droplet in the middle of
    /// its periods; between walls with the tracks up to that time.
    ///
    /// # Errors
    /// [`Error::Write`], [`Error::Streamlines`]; [`Error::Count`] for a snapshot of your own with other than one sample
    /// a cell.
    pub fn write_picture(&self, seen: &Snapshot, tracks: &[Track], path: impl AsRef<Path>) -> Result<(), Error> {
        let legends = self.legends(std::slice::from_ref(seen));
        self.draw(seen, &legends, tracks, &Format::STILL)?.write(path.as_ref(), 1.0)
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
