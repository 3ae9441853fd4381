//! The picture of a flow: what is in it.

mod colour_bar;
pub(crate) mod look;
mod paint;

use colour_bar::Legend;

use crate::{ColourScale, Error, Samples, Vec2, drawing::image::Image};

/// Size and detail of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Format {
    /// Width of the image (pixels, 160 to 8000); its height follows from the shape of the region.
    pub width: usize,
    /// Number of colours of the field, at least two: few show contour bands, and make animations small.
    pub levels: usize,
    /// Factor on the distance between streamlines.
    pub streamline_spacing: f64,
    /// Width of the image relative to the size of the type, at least 20.
    pub type_sizes: f64,
}

impl Format {
    /// 1200 pixels wide, with smooth colours.
    #[must_use]
    pub fn full() -> Self {
        Self { width: 1200, levels: 256, streamline_spacing: 1.0, type_sizes: 58.0 }
    }

    /// 440 pixels wide, with contour bands and fewer streamlines, for animations.
    #[must_use]
    pub fn frame() -> Self {
        Self { width: 440, levels: 20, streamline_spacing: 2.0, type_sizes: 37.0 }
    }
}

/// A closed curve of the plane with a value at each point.
#[derive(Debug, Clone)]
struct ColouredCurve {
    points: Vec<Vec2>,
    values: Vec<f64>,
}

/// A solid as it is drawn.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SolidShape {
    /// Closed outlines of what is filled (length), one within another for a hole.
    pub area: Vec<Vec<Vec2>>,
    /// Lines that are drawn as its surface (length).
    pub edges: Vec<Vec<Vec2>>,
}

/// The velocity whose streamlines are drawn.
#[derive(Debug, Clone)]
struct Flow {
    velocity: Samples<Vec2>,
    spacing: f64,
    anchor: Vec2,
}

/// The picture of a flow: a field in colour, streamlines, interfaces coloured by a value on them, walls, solids,
/// tracks. Described by what is given to it, drawn by [`Picture::draw`].
///
/// Positions are lengths in the units of the axes. In the periodic directions of the fields everything is drawn with
/// its periodic images, so positions need not be wrapped.
///
/// ```
/// use motile_output::{ColourMap, ColourScale, Format, Limits, Picture, Raster, Samples, Vec2};
///
/// let raster = Raster::new([-3.0, -3.0], [6.0, 6.0], [60, 60], [true, true])?;
/// let pressure: Vec<f64> = raster.points().iter().map(|p| p.x.sin() * p.y.cos()).collect();
/// let scale = ColourScale::new(ColourMap::Rainbow, Limits::Symmetric, &pressure);
/// let circle: Vec<Vec2> = (0..90).map(|k| f64::from(k) * 4f64.to_radians()).map(|t| Vec2::new(t.cos(), t.sin())).collect();
/// let concentration: Vec<f64> = circle.iter().map(|p| 1.0 - p.x).collect();
/// let over_interface = ColourScale::new(ColourMap::Magma, Limits::FromZero, &concentration);
/// let picture = Picture::new(Samples::new(raster, pressure)?, scale, "pressure p R_{0}/γ_{0}")
///     .title("t = 12.5")
///     .interface_scale(over_interface, "concentration c/c_{0}")
///     .interface(&circle, &concentration)?;
/// let image = picture.draw(&Format::frame())?;
/// assert_eq!(image.size()[0], 440);
/// # Ok::<(), motile_output::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Picture {
    title: String,
    field: Samples<f64>,
    field_legend: Legend,
    flow: Option<Flow>,
    view: [Vec2; 2],
    walls: Option<[f64; 2]>,
    solids: Vec<SolidShape>,
    tracks: Vec<Vec<Vec2>>,
    interfaces: Vec<ColouredCurve>,
    interface_legend: Option<Legend>,
    length_unit: String,
}

impl Picture {
    /// A picture of `field` in the colours of `scale`, over the rectangle of its raster; `label` names the field with
    /// its unit.
    #[must_use]
    pub fn new(field: Samples<f64>, scale: ColourScale, label: &str) -> Self {
        let (low, size) = (Vec2::from(field.raster().origin()), Vec2::from(field.raster().size()));
        Self {
            title: String::new(),
            field,
            field_legend: Legend { scale, label: label.to_string() },
            flow: None,
            view: [low, low + size],
            walls: None,
            solids: Vec::new(),
            tracks: Vec::new(),
            interfaces: Vec::new(),
            interface_legend: None,
            length_unit: "R_{0}".to_string(),
        }
    }

    /// A line of text above the picture, such as the time and the parameters.
    #[must_use]
    pub fn title(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// The unit of length on axes and scale bar; `R_{0}` if nothing is said.
    #[must_use]
    pub fn length_unit(mut self, unit: &str) -> Self {
        self.length_unit = unit.to_string();
        self
    }

    /// Shows the rectangle between two corners instead of that of the raster.
    ///
    /// # Errors
    /// [`Error::Rectangle`]: one that is empty, not finite, or more than 20 times as long as wide.
    pub fn view(mut self, low: Vec2, high: Vec2) -> Result<Self, Error> {
        let size = high - low;
        if !(low.iter().chain(&size).all(|v| v.is_finite()) && size.min() > 0.0 && size.max() < 20.0 * size.min()) {
            return Err(Error::Rectangle { corner: low.into(), size: size.into() });
        }
        self.view = [low, high];
        Ok(self)
    }

    /// Shows a rectangle of the raster's size with its centre at `centre`: a camera that moves along.
    ///
    /// # Errors
    /// As [`Picture::view`].
    pub fn centred_on(self, centre: Vec2) -> Result<Self, Error> {
        let half = Vec2::from(self.field.raster().size()) * 0.5;
        self.view(centre - half, centre + half)
    }

    /// Draws streamlines of `velocity`, about `spacing` (length) apart, the first of them through `anchor`: with an
    /// anchor that moves along with what moves, the lines do not flicker in animations.
    #[must_use]
    pub fn streamlines(mut self, velocity: Samples<Vec2>, spacing: f64, anchor: Vec2) -> Self {
        self.flow = Some(Flow { velocity, spacing, anchor });
        self
    }

    /// The colours of interfaces; `label` names the value on them.
    #[must_use]
    pub fn interface_scale(mut self, scale: ColourScale, label: &str) -> Self {
        self.interface_legend = Some(Legend { scale, label: label.to_string() });
        self
    }

    /// Draws the closed curve through `points` with the colours of the `values` at them, as
    /// [`Picture::interface_scale`] says; black without one.
    ///
    /// # Errors
    /// [`Error::Count`]: numbers of points and values that differ. [`Error::Empty`]: none.
    pub fn interface(mut self, points: &[Vec2], values: &[f64]) -> Result<Self, Error> {
        Error::check_count("values at the points of an interface", values.len(), points.len())?;
        if points.is_empty() {
            return Err(Error::Empty("an interface without points"));
        }
        self.interfaces.push(ColouredCurve { points: points.to_vec(), values: values.to_vec() });
        Ok(self)
    }

    /// Draws rigid walls below and above the given heights; the view is widened to show them.
    #[must_use]
    pub fn walls(mut self, below: f64, above: f64) -> Self {
        self.walls = Some([below, above]);
        self
    }

    /// Draws a solid.
    #[must_use]
    pub fn solid(mut self, shape: &SolidShape) -> Self {
        self.solids.push(shape.clone());
        self
    }

    /// Draws a path, such as that of a centroid.
    #[must_use]
    pub fn track(mut self, path: &[Vec2]) -> Self {
        self.tracks.push(path.to_vec());
        self
    }

    /// Draws the picture.
    ///
    /// # Errors
    /// [`Error::Size`]: an image too small or too large. [`Error::Streamlines`]: streamlines too dense.
    pub fn draw(&self, format: &Format) -> Result<Image, Error> {
        paint::paint(self, format)
    }
}

#[cfg(test)]
mod tests;
