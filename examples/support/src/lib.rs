//! What the examples of motile share: the command line, a progress bar, pictures of flows, animations, plots, and files
//! for other programs. Most works on plain data (positions, samples, numbers), so that any scene can use it; what
//! scenes with a droplet share is built on that.
//!
//! | for | there are |
//! |---|---|
//! | flags | [`run`] around groups such as [`DropletFlags`], [`MethodFlags`], [`BoxFlags`], [`ChannelFlags`], [`OutputFlags`] |
//! | waiting | [`Progress`] |
//! | pictures of a flow | [`Picture`] of [`ScalarSamples`] and [`VectorSamples`] on a [`Raster`], drawn in a [`Format`] |
//! | animations | [`Animation`] |
//! | plots | [`Figure`] of [`Plot`]s of [`Series`], as SVG and PNG |
//! | results | [`Summary`] (`summary.json` and a table), [`Trajectory`] (CSV) |
//! | studies | [`RunPool`] (parallel, resumable), [`write_results`] (CSV) |
//! | ParaView | [`VtkFile`], [`VtkSeries`] |
//! | elastic solids | [`Passage`], [`SolidMeter`], [`SolidFiles`], [`solid_shape`] |
//! | runs with a droplet | [`WatchedRun`] with the observers [`Dial`], [`Recorder`], [`Film`], [`VtkOutput`] |
//!
//! Pictures need no fonts of the system and no C libraries: lines, areas and letters are drawn by [`Canvas`] and
//! [`Svg`], two implementations of [`Surface`].
//!
//! ```
//! use support::{AxisScale, Figure, Plot, Series};
//!
//! let decay = (0..100).map(|k| f64::from(k) * 0.1).map(|t| (t, (-t).exp()));
//! let plot = Plot::new("Decay").x_axis("time t", AxisScale::Linear).series(Series::line("exp(−t)", decay));
//! let canvas = Figure::new(1).panel(plot).canvas().expect("one panel of usual size");
//! assert_eq!(canvas.size(), [1080, 680]);
//! ```

mod animation;
mod axes;
mod base64;
mod canvas;
mod checkpoint_flags;
mod colour;
mod colour_bar;
mod command_line;
mod droplet_plots;
mod droplet_summary;
mod film;
mod flags;
mod font;
mod method_flags;
mod palette;
mod parse;
mod passage;
mod picture;
mod picture_paint;
mod plot;
mod plot_paint;
mod progress;
mod raster;
mod recorder;
mod run_pool;
mod scene_picture;
mod snapshot;
mod solids;
mod steady;
mod streamlines;
mod summary;
mod surface;
mod svg;
mod ticks;
mod trajectory;
mod vtk;
mod vtk_output;
mod wall_flags;
mod watched_run;

pub use animation::Animation;
pub use axes::AxisScale;
pub use canvas::Canvas;
pub use checkpoint_flags::CheckpointFlags;
pub use colour::{ColourMap, ColourScale, Limits, Rgb, SERIES_COLOURS};
pub use command_line::{run, say};
pub use droplet_plots::{concentration_plot, time_series};
pub use droplet_summary::{RunCost, droplet_summary};
pub use film::{Film, Look};
pub use flags::{BoxFlags, ChannelFlags, Drive, DropletFlags, Initial, OutputFlags};
pub use method_flags::{Contrast, FlowMethod, MethodFlags, Preset};
pub use parse::{TimeStep, activity, count, finite, kernel, not_negative, pair, positive, seed};
pub use passage::{Decided, Passage, Verdict};
pub use picture::{Format, Picture, SolidShape};
pub use plot::{Figure, Marker, Plot, Series};
pub use progress::Progress;
pub use raster::{Raster, ScalarSamples, VectorSamples};
pub use recorder::{Dial, Recorder, check_run};
pub use run_pool::RunPool;
pub use scene_picture::{droplets, write_scene_picture};
pub use snapshot::{Snapshot, at_markers, domain_raster};
pub use solids::{SolidFiles, SolidMeter, put_solids, solid_shape, solids};
pub use steady::Steadiness;
pub use streamlines::streamlines;
pub use summary::{Summary, make_directory, write_results};
pub use surface::{Anchor, Pen, Pixel, Rect, Surface, TextStyle};
pub use svg::Svg;
pub use trajectory::Trajectory;
pub use vtk::{VtkFile, VtkSeries};
pub use vtk_output::VtkOutput;
pub use wall_flags::{ElasticFlags, Material, Mesh, SurfaceRule, wall_caption};
pub use watched_run::{WatchedRun, caption};

/// A point or vector in the plane.
pub type Vec2 = nalgebra::Vector2<f64>;
