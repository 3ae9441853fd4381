//! Pictures of scenes: contents and settings.

mod paint;

use std::path::Path;

use crate::{ColourScale, OutputError, Snapshot, drawing::Drawing};
use motile::motile_base::Vec2;

/// Distance of streamlines over the smaller side of the picture, by default.
const STREAMLINES: f64 = 0.05;

/// Path of a moving point, such as a centroid: times and positions (length).
pub type Track = Vec<(f64, Vec2)>;

/// Settings of pictures of scenes.
///
/// A picture shows pressure in colour, streamlines in the laboratory frame, the interfaces of all droplets coloured by
/// their concentrations (black without particles), densities of particles that diffuse inside in place of the pressure,
/// directors and defects of gels, solids and rigid walls, the time and a scale bar; between walls also the paths of the
/// droplets. In periodic directions everything is drawn with its periodic images, so positions need not be wrapped.
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
    /// Caption beside the time.
    pub caption: String,
    /// Unit of the concentrations shown (particles per length); 1 if `None`.
    pub concentration: Option<f64>,
    /// Distance of streamlines (length); a twentieth of the smaller side if `None`.
    pub streamline_spacing: Option<f64>,
    /// Quantity shown by the colour of solids.
    pub solids: SolidColour,
}

/// Quantity shown by the colour of solids.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum SolidColour {
    /// No quantity: all solids are grey.
    #[default]
    Plain,
    /// Displacement of each triangle from its reference position (length).
    Displacement,
    /// Deviator of the Cauchy stress, `sqrt(((s_xx - s_yy)/2)^2 + s_xy^2)` (force per length).
    Stress,
}

/// Shape of a solid, with values for colours.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct SolidShape {
    /// Closed outlines of the filled area (length), one within another for a hole.
    pub area: Vec<Vec<Vec2>>,
    /// Lines of the surface (length).
    pub edges: Vec<Vec<Vec2>>,
    /// Corners of the triangles (length), for colours.
    pub triangles: Vec<[Vec2; 3]>,
    /// Displacement of each triangle from its reference position (length).
    pub displacement: Vec<f64>,
    /// Deviator of the Cauchy stress in each triangle (force per length); not a number if one is inverted.
    pub stress: Vec<f64>,
}

impl SolidShape {
    /// Values that a colour shows, one for each triangle.
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
    /// Number of colours of the pressure: few give contour bands and small animations.
    levels: usize,
    /// Factor on the distance between streamlines.
    streamline_spacing: f64,
    /// Width of the image relative to the size of the type.
    type_sizes: f64,
    /// True if a single droplet is drawn in the middle of its periods.
    follows: bool,
}

impl Format {
    const STILL: Self = Self { width: 1200, levels: 256, streamline_spacing: 1.0, type_sizes: 58.0, follows: true };
    /// Format of the frames of animations.
    pub(crate) const FRAME: Self =
        Self { width: 440, levels: 20, streamline_spacing: 2.0, type_sizes: 37.0, follows: false };
}

/// Colour scales of the pressure, of concentrations and densities inside where there are particles, and of solids where
/// they are coloured.
#[derive(Debug)]
pub(crate) struct Legends {
    pressure: ColourScale,
    concentration: Option<ColourScale>,
    inside: Option<ColourScale>,
    solids: Option<ColourScale>,
    /// Unit of the concentrations (particles per length).
    unit: f64,
}

/// Contents of a picture.
#[derive(Debug)]
struct Picture<'a> {
    seen: &'a Snapshot,
    legends: &'a Legends,
    title: String,
    solids: SolidColour,
    streamline_spacing: f64,
    tracks: Vec<Vec<Vec2>>,
    /// Lower left and upper right corner of the part shown (length).
    view: [Vec2; 2],
    format: &'a Format,
}

impl Look {
    /// Colour scales that serve all of some states.
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

    /// Drawing of a state, with the tracks up to its time.
    pub(crate) fn draw(
        &self,
        seen: &Snapshot,
        legends: &Legends,
        tracks: &[Track],
        format: &Format,
    ) -> Result<Drawing, OutputError> {
        let (corner, size) = (Vec2::from(seen.raster.origin), Vec2::from(seen.raster.size));
        let mut centre = corner + 0.5 * size;
        if let ([droplet], true) = (&seen.droplets[..], format.follows) {
            (0..2).filter(|&k| seen.raster.periodic[k]).for_each(|k| centre[k] = droplet.centroid[k]);
        }
        let so_far = |track: &Track| {
            let path: Vec<Vec2> = track.iter().filter(|(time, _)| *time <= seen.time).map(|(_, at)| *at).collect();
            last_period(&path, size.x).to_vec()
        };
        let spacing = self.streamline_spacing.unwrap_or(STREAMLINES * size.x.min(size.y));
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

    /// Writes a picture of a state, as SVG where the name ends in `.svg` and as PNG otherwise. A single droplet is in
    /// the middle of its periods; between walls the tracks up to the time of the state are drawn.
    ///
    /// # Errors
    /// [`OutputError::Write`]; [`OutputError::Streamlines`]; [`OutputError::Count`] for a snapshot with other than one
    /// sample for each cell.
    pub fn write_picture(&self, seen: &Snapshot, tracks: &[Track], path: impl AsRef<Path>) -> Result<(), OutputError> {
        let legends = self.legends(std::slice::from_ref(seen));
        self.draw(seen, &legends, tracks, &Format::STILL)?.write(path.as_ref(), 1.0)
    }
}

/// End of a path that extends over at most three quarters of the period in x: more would be drawn over itself.
fn last_period(path: &[Vec2], period: f64) -> &[Vec2] {
    let Some(&end) = path.last() else { return path };
    let start = path.iter().rposition(|p| (p.x - end.x).abs() > 0.75 * period).map_or(0, |k| k + 1);
    &path[start..]
}

#[cfg(test)]
mod tests;
