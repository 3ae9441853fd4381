//! The pictures of model and methods in `docs/images`, drawn from what the library computes.

mod crates;
mod droplet;
mod flow_chart;
mod regimes;
mod staggered;
mod svg;

use std::fs;
use std::path::PathBuf;

use anyhow::{Result, ensure};
use clap::Args;
use motile_cli::run::say;

use crate::tables::root;

/// Draws the pictures of model and methods.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Write them to docs/images rather than to the directory
    #[arg(long)]
    write: bool,
    /// Directory of the pictures
    #[arg(long, value_name = "DIRECTORY", default_value = "out/pictures")]
    out: PathBuf,
}

/// Largest file of a picture (bytes).
const LARGEST: usize = 60_000;

pub(crate) fn run(flags: &Flags) -> Result<()> {
    let folder = if flags.write { root().join("docs/images") } else { flags.out.clone() };
    fs::create_dir_all(&folder)?;
    for (name, picture) in [
        ("model", droplet::picture()?),
        ("grid", staggered::grid()?),
        ("layers", staggered::layers()?),
        ("method", flow_chart::picture()),
        ("regimes", regimes::picture()?),
        ("crates", crates::picture()?),
    ] {
        ensure!(picture.len() < LARGEST, "{name}.svg has {} bytes, more than {LARGEST}", picture.len());
        fs::write(folder.join(format!("{name}.svg")), &picture)?;
        say(format_args!("{name}.svg: {} bytes", picture.len()));
    }
    Ok(())
}
