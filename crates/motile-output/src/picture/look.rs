//! Draws pictures of scenes with these settings.

use std::path::Path;

use super::contents::{Format, Legends, Picture};
use super::paint::paint;
use super::solid_shape::SolidColour;
use crate::colour::PressureColours;
use crate::{ColourScale, OutputError, Snapshot, drawing::Drawing};
use motile::base::Vec2;
use motile::setup::Setup;

/// Distance of streamlines over the smaller side of the picture, by default.
const STREAMLINES: f64 = 0.05;
/// Points of type in a centimetre.
const POINTS_PER_CM: f64 = 72.0 / 2.54;

/// Path of a moving point, such as a centroid: times and positions (length).
pub type Track = Vec<(f64, Vec2)>;

/// Draws pictures of scenes with these settings.
///
/// A picture shows pressure in colour ([`motile::base::FlowSample::pressure`]), streamlines in the laboratory frame,
/// the interfaces of all droplets coloured by their concentrations (black without particles), densities of particles
/// that diffuse inside in place of the pressure, directors and defects of gels, solids and rigid walls, the time and a
/// scale bar; between walls also the paths of the droplets. In periodic directions everything is drawn with its
/// periodic images, so positions need not be wrapped. Lines are as wide as fits the size of the droplets on paper. If
/// the flow has a mirror line, so have the streamlines.
///
/// This draws a panel of a figure, one column wide, with pressures from -20 to 20 in colour:
///
/// ```
/// use motile::prelude::*;
/// use motile_output::{Look, Raster, Snapshot};
///
/// let Built { mut scene, .. } = Setup::default().build()?;
/// let path = std::env::temp_dir().join("a-droplet.svg");
/// let raster = Raster::of(scene.system(), 0.2)?;
/// let look = Look {
///     panel: "a)".into(),
///     width: 8.6,
///     font_size: 7.0,
///     pressure_range: Some([-20.0, 20.0]),
///     length_unit: "µm".into(),
///     colour_bars: false,
///     ..Look::default()
/// };
/// look.write_picture(&Snapshot::take(scene.system_mut(), raster)?, &[], &path)?;
/// assert!(std::fs::read_to_string(&path)?.contains("width=\"8.6cm\""));
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Look {
    /// Caption next to the time; empty by default.
    pub caption: String,
    /// Label of a panel of a figure, such as `a)`, at the upper left; none if empty, as by default.
    pub panel: String,
    /// Width on paper (cm), 16 by default; the height follows from the region. Frames of a [`crate::Animation`] have
    /// their own size.
    pub width: f64,
    /// Size of the type (pt), 8 by default.
    pub font_size: f64,
    /// Resolution of PNG files and of the colours in SVG files (pixels per cm), 75 by default; 118 are 300 dpi.
    pub resolution: f64,
    /// Lowest and highest pressure shown by colours (force per length); the pressures of all samples except the lowest
    /// and highest half percent if `None`, as by default. Ends of the colour bar that values exceed are triangles.
    pub pressure_range: Option<[f64; 2]>,
    /// Colours of the pressure, blue over white at zero to red by default.
    pub pressure_colours: PressureColours,
    /// Unit of the concentrations shown (particles per length); 1 if `None`, as by default.
    pub concentration: Option<f64>,
    /// Unit of length in the labels of axes and scale bar; no unit if empty, as by default, and `R_{0}` by [`Look::of`]
    /// for a droplet of radius 1. It is a text alone: positions are not converted.
    pub length_unit: String,
    /// True, as by default, if streamlines are drawn.
    pub streamlines: bool,
    /// Distance of streamlines (length); a twentieth of the smaller side if `None`, as by default.
    pub streamline_spacing: Option<f64>,
    /// True, as by default, if a scale bar is drawn.
    pub scale_bar: bool,
    /// True, as by default, if colour bars are drawn below the picture.
    pub colour_bars: bool,
    /// Quantity shown by the colour of solids, none by default.
    pub solids: SolidColour,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            caption: String::new(),
            panel: String::new(),
            width: 16.0,
            font_size: 8.0,
            resolution: 75.0,
            pressure_range: None,
            pressure_colours: PressureColours::default(),
            concentration: None,
            length_unit: String::new(),
            streamlines: true,
            streamline_spacing: None,
            scale_bar: true,
            colour_bars: true,
            solids: SolidColour::default(),
        }
    }
}

impl Look {
    /// Returns the default settings for pictures of a described scene, with its unit of length
    /// ([`Setup::length_unit`]).
    #[must_use]
    pub fn of(setup: &Setup) -> Self {
        Self { length_unit: setup.length_unit().into(), ..Self::default() }
    }

    /// Returns the colour scales that serve all of some states.
    pub(crate) fn legends(&self, all: &[Snapshot]) -> Legends {
        let pressures = all.iter().flat_map(|seen| seen.flow.iter().map(|sample| sample.pressure));
        let unit = self.concentration.unwrap_or(1.0);
        let of_droplets = all.iter().flat_map(|seen| &seen.droplets).map(|droplet| &droplet.concentration);
        let of_others = all.iter().flat_map(|seen| &seen.interfaces).map(|line| &line.concentration);
        let concentrations = of_droplets.chain(of_others).flatten().map(|c| c / unit);
        let label = if self.concentration.is_some() { "concentration c/c_{0}" } else { "concentration c" };
        let inside = all.iter().flat_map(|seen| &seen.inside).flat_map(|field| field.densities.iter().flatten());
        let solids = all.iter().flat_map(|seen| &seen.solids).flat_map(|solid| solid.values(self.solids));
        let of_solids = match self.solids {
            SolidColour::Stress => "stress deviator",
            SolidColour::InternalStress => "internal stress",
            _ => "displacement",
        };
        Legends {
            solids: ColourScale::from_zero(solids.copied(), of_solids).map(ColourScale::green),
            pressure: ColourScale::of_most(pressures, self.pressure_range, "pressure p")
                .coloured(self.pressure_colours),
            concentration: ColourScale::from_zero(concentrations, label),
            inside: ColourScale::from_zero(inside.copied(), "density inside C").map(ColourScale::green),
            unit,
        }
    }

    /// Returns the drawing of a state, with the tracks up to its time.
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
        paint(&Picture {
            seen,
            legends,
            look: self,
            streamline_spacing: spacing * format.streamline_spacing,
            tracks: if seen.walls.is_some() { tracks.iter().map(so_far).collect() } else { Vec::new() },
            view: [centre - 0.5 * size, centre + 0.5 * size],
            format: *format,
        })
    }

    /// Writes a picture of a state, as SVG or PNG by the end of the name. A single droplet is in
    /// the middle of its periods; between walls the tracks up to the time of the state are drawn.
    ///
    /// # Errors
    /// Returns [`OutputError::Size`] for a width outside of 1 to 100 cm, type outside of 1 to 72 pt, a resolution
    /// outside of 10 to 1000 pixels per cm, or a PNG file with a side of more than 16384 pixels; [`OutputError::Range`]
    /// for a range of the pressure that is empty or not finite; [`OutputError::Write`]; [`OutputError::Streamlines`];
    /// [`OutputError::Count`] for a snapshot with other than one sample for each cell; [`OutputError::Format`] for a
    /// name that ends in neither `.svg` nor `.png`.
    pub fn write_picture(&self, seen: &Snapshot, tracks: &[Track], path: impl AsRef<Path>) -> Result<(), OutputError> {
        OutputError::check_format(path.as_ref(), &["svg", "png"])?;
        self.picture(seen, tracks)?.write(path.as_ref(), 1.0)
    }

    /// Returns the text of the SVG file that [`Look::write_picture`] writes.
    ///
    /// # Errors
    /// Returns the same errors, except for the errors of the file.
    pub fn svg(&self, seen: &Snapshot, tracks: &[Track]) -> Result<String, OutputError> {
        Ok(self.picture(seen, tracks)?.svg())
    }

    /// Refuses sizes and ranges that no picture can have.
    ///
    /// # Errors
    /// Returns [`OutputError::Size`] and [`OutputError::Range`], as in [`Look::write_picture`].
    pub fn check(&self) -> Result<(), OutputError> {
        OutputError::check_size("a picture with a width (cm)", self.width, 1.0, 100.0)?;
        OutputError::check_size("type of a size (pt)", self.font_size, 1.0, 72.0)?;
        OutputError::check_size("a picture with a resolution (pixels per cm)", self.resolution, 10.0, 1000.0)?;
        if let Some([low, high]) = self.pressure_range
            && !(low < high && (high - low).is_finite())
        {
            return Err(OutputError::Range { low, high });
        }
        Ok(())
    }

    fn picture(&self, seen: &Snapshot, tracks: &[Track]) -> Result<Drawing, OutputError> {
        self.check()?;
        let still = Format {
            width: (self.width * self.resolution).round(),
            em: self.font_size / POINTS_PER_CM * self.resolution,
            per_cm: Some(self.resolution),
            levels: 256,
            streamline_spacing: 1.0,
            follows: true,
        };
        let legends = self.legends(std::slice::from_ref(seen));
        self.draw(seen, &legends, tracks, &still)
    }
}

/// Returns the end of a path that extends over at most three quarters of the period in x: more would be drawn over
/// itself.
fn last_period(path: &[Vec2], period: f64) -> &[Vec2] {
    let Some(&end) = path.last() else { return path };
    let start = path.iter().rposition(|p| (p.x - end.x).abs() > 0.75 * period).map_or(0, |k| k + 1);
    &path[start..]
}

#[cfg(test)]
mod tests;
