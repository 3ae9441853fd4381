//! Contents of a picture: state, colour scales, size.

use crate::{ColourScale, Look, Snapshot};
use motile::base::Vec2;

/// Size and detail of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Format {
    /// Width of the image (pixels); its height follows from the shape of the region.
    pub(crate) width: f64,
    /// Size of the type (pixels).
    pub(crate) em: f64,
    /// Pixels per centimetre on paper; `None` for images that have no size there.
    pub(crate) per_cm: Option<f64>,
    /// Number of colours of the pressure: few give contour bands and small animations.
    pub(crate) levels: usize,
    /// Factor on the distance between streamlines.
    pub(crate) streamline_spacing: f64,
    /// True if a single droplet is drawn in the middle of its periods.
    pub(crate) follows: bool,
}

impl Format {
    /// Format of the frames of animations.
    pub(crate) const FRAME: Self =
        Self { width: 440.0, em: 12.0, per_cm: None, levels: 20, streamline_spacing: 2.0, follows: false };
}

/// Colour scales of the pressure, of concentrations and densities inside if there are particles, and of solids where
/// they are coloured.
#[derive(Debug)]
pub(crate) struct Legends {
    pub(crate) pressure: ColourScale,
    pub(crate) concentration: Option<ColourScale>,
    pub(crate) inside: Option<ColourScale>,
    pub(crate) solids: Option<ColourScale>,
    /// Unit of the concentrations (particles per length).
    pub(crate) unit: f64,
}

/// Contents of a picture.
#[derive(Debug)]
pub(crate) struct Picture<'a> {
    pub(crate) seen: &'a Snapshot,
    pub(crate) look: &'a Look,
    pub(crate) legends: &'a Legends,
    pub(crate) streamline_spacing: f64,
    pub(crate) tracks: Vec<Vec<Vec2>>,
    /// Lower left and upper right corner of the part shown (length).
    pub(crate) view: [Vec2; 2],
    pub(crate) format: Format,
}
