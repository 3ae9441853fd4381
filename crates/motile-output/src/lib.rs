//! Pictures, plots, animations, CSV and ParaView files of simulations with [`motile`].
//!
//! This run of a droplet leaves a trajectory and a picture:
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
//! | runs, as observers | [`TrajectoryCsv`], [`DropletsCsv`], [`ParaView`], [`Animation`], [`RunProgress`] |
//! | pictures of scenes | a [`Look`] at a [`Snapshot`] of all droplets, solids and the flow |
//! | streamlines | [`streamlines()`] of [`Samples`] on a [`Raster`] |
//! | plots | [`plot::Figure`] of [`plot::Plot`]s, as SVG and PNG; [`plot::time_series`], [`plot::concentration_plot`] |
//! | tables | [`CsvTable`], [`DropletMeter`], [`SolidMeter`], [`ForcesCsv`], [`WallShearCsv`] |
//! | many droplets | the module [`suspension`] |
//! | droplets without symmetry | [`SpaceCsv`], [`SpaceParaView`], [`SpaceSnapshot`], [`SpaceAnimation`] |
//! | ParaView | [`VtkFile`], [`VtkSeries`] |
//! | long work | [`Progress`] bar |
//!
//! Pictures and plots are drawn once, as vectors, and written as SVG or PNG. They need no fonts of the system and no C
//! libraries: Noto Sans is bundled (SIL Open Font License). Failures return an [`OutputError`].

mod animation;
mod bodies;
mod colour;
mod drawing;
mod droplets;
mod error;
mod forces;
mod interfaces;
mod paraview;
mod picture;
pub mod plot;
mod progress;
mod raster;
mod snapshot;
mod solids;
mod space;
mod streamlines;
pub mod suspension;
mod table;
mod time_label;
mod trajectory;

pub use animation::Animation;
pub use bodies::{BodiesCsv, FlowCsv};
pub(crate) use colour::ColourScale;
pub use colour::{PressureColours, Rgb};
pub use droplets::DropletsCsv;
pub use error::OutputError;
pub use forces::{ForcesCsv, WallShearCsv};
pub use interfaces::{InterfaceLine, InterfacesCsv};
pub use paraview::ParaView;
pub use paraview::file::{VtkFile, VtkSeries};
pub use picture::{Look, SolidColour, SolidShape, Track};
pub use progress::{Progress, RunProgress};
pub use raster::{Raster, Samples};
pub use snapshot::{DropletOutline, GelField, InteriorField, Snapshot};
pub use solids::SolidMeter;
pub use space::{files::SpaceParaView, picture::SpaceAnimation, snapshot::SpaceSnapshot, table::SpaceCsv};
pub use streamlines::streamlines;
pub use table::CsvTable;
pub use trajectory::{TrajectoryCsv, meter::DropletMeter};
