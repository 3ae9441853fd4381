//! Pictures, plots, animations, CSV and ParaView files of simulations with motile.
//!
//! | for | there are |
//! |---|---|
//! | waiting | [`Progress`] |
//! | pictures of a flow | [`Picture`] of [`ScalarSamples`] and [`VectorSamples`] on a [`Raster`], drawn in a [`Format`] |
//! | animations | [`Animation`] |
//! | plots | [`Figure`] of [`Plot`]s of [`Series`], as SVG and PNG |
//! | tables | [`Trajectory`] (CSV) |
//! | ParaView | [`VtkFile`], [`VtkSeries`] |
//! | elastic solids | [`SolidMeter`], [`SolidFiles`], [`solid_shape`] |
//! | runs with a droplet | the observers [`Dial`], [`Recorder`], [`Film`], [`VtkOutput`] |
//!
//! Pictures need no fonts of the system and no C libraries: lines, areas and letters are drawn by [`Canvas`] and
//! [`Svg`], two implementations of [`Surface`].
//!
//! ```
//! use motile_output::{AxisScale, Figure, Plot, Series};
//!
//! let decay = (0..100).map(|k| f64::from(k) * 0.1).map(|t| (t, (-t).exp()));
//! let plot = Plot::new("Decay").x_axis("time t", AxisScale::Linear).series(Series::line("exp(−t)", decay));
//! let canvas = Figure::new(1).panel(plot).canvas().expect("one panel of usual size");
//! assert_eq!(canvas.size(), [1080, 680]);
//! ```

mod animation;
mod colour;
mod drawing;
mod field;
mod paraview;
mod picture;
mod plot;
mod progress;
mod recorder;
mod snapshot;
mod solids;
mod table;

pub use animation::Animation;
pub use animation::film::{Film, Look};
pub use colour::{ColourMap, ColourScale, Limits, Rgb, SERIES_COLOURS};
pub use drawing::axes::AxisScale;
pub use drawing::canvas::Canvas;
pub use drawing::surface::{Anchor, Pen, Pixel, Rect, Surface, TextStyle};
pub use drawing::svg::Svg;
pub use field::raster::{Raster, ScalarSamples, VectorSamples};
pub use field::streamlines::streamlines;
pub use paraview::file::{VtkFile, VtkSeries};
pub use paraview::observer::VtkOutput;
pub use picture::scene::{droplets, write_scene_picture};
pub use picture::{Format, Picture, SolidShape};
pub use plot::droplet::{concentration_plot, time_series};
pub use plot::{Figure, Marker, Plot, Series};
pub use progress::Progress;
pub use recorder::{Dial, Recorder};
pub use snapshot::{Snapshot, at_markers, domain_raster};
pub use solids::{SolidFiles, SolidMeter, solid_shape, solids};
pub use table::Trajectory;

/// A point or vector in the plane.
pub type Vec2 = nalgebra::Vector2<f64>;
