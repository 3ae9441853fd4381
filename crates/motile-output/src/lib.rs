//! Pictures, plots, animations, CSV and ParaView files of simulations with [`motile`].
//!
//! Ten lines that run a droplet and leave a trajectory and a picture:
//!
//! ```
//! use motile::prelude::*;
//! use motile_output::{Look, Raster, Snapshot, TrajectoryCsv};
//!
//! let Built { mut scene, droplets, .. } = Setup::default().build()?;
//! # let directory = std::env::temp_dir().join("motile-output-first-page");
//! # std::fs::create_dir_all(&directory)?;
//! let mut rows = TrajectoryCsv::create(directory.join("trajectory.csv"), scene.system_mut(), droplets[0])?;
//! scene.run(2.0).observe(Every::Time(0.1), &mut rows).go()?;
//! rows.finish(scene.system_mut())?;
//! let raster = Raster::of(scene.system(), 0.1)?;
//! let seen = Snapshot::take(scene.system_mut(), raster)?;
//! Look::default().write_picture(&seen, &[], directory.join("final.png"))?;
//! # assert!(directory.join("final.png").metadata()?.len() > 10_000);
//! # assert_eq!(std::fs::read_to_string(directory.join("trajectory.csv"))?.lines().count(), 22);
//! # std::fs::remove_dir_all(&directory)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | for | there are |
//! |---|---|
//! | runs, as observers | [`TrajectoryCsv`], [`ParaView`], [`Film`], [`RunProgress`] |
//! | pictures of scenes | a [`Look`] at a [`Snapshot`] of all droplets, solids and the flow |
//! | streamlines | [`streamlines()`] of [`Samples`] on a [`Raster`] |
//! | plots | [`Figure`] of [`Plot`]s of [`Series`], as SVG and PNG; [`time_series`], [`concentration_plot`] |
//! | tables | [`CsvTable`], [`SolidMeter`] |
//! | ParaView | [`VtkFile`], [`VtkSeries`] |
//! | waiting | [`Progress`] |
//!
//! Pictures and plots are drawn once, as vectors, and written as SVG or PNG. They need no fonts of the system and no C
//! libraries: Noto Sans is bundled (SIL Open Font License). What cannot be drawn or written ends in an [`Error`].

mod animation;
mod base64;
mod colour;
mod drawing;
mod error;
mod field;
mod paraview;
mod picture;
mod plot;
mod progress;
mod snapshot;
mod solids;
mod table;
mod trajectory;

pub use animation::Film;
pub(crate) use colour::ColourScale;
pub use colour::{Rgb, SERIES_COLOURS};
pub use drawing::axes::AxisScale;
pub use error::Error;
pub use field::raster::{Raster, Samples};
pub use field::streamlines::streamlines;
pub use motile::ib_core::Vec2;
pub use paraview::ParaView;
pub use paraview::file::{VtkFile, VtkSeries};
pub use picture::{Look, SolidColour, SolidShape, Track};
pub use plot::droplet::{concentration_plot, time_series};
pub use plot::{Figure, Marker, Plot, Series};
pub use progress::{Progress, RunProgress};
pub use snapshot::{DropletOutline, GelField, InteriorField, Snapshot};
pub use solids::SolidMeter;
pub use table::CsvTable;
pub use trajectory::TrajectoryCsv;
