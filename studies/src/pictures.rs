//! The picture of the regimes in `docs/images`, drawn from what the library computes. The drawings of model and methods
//! beside it are SVG files, to be edited as such.

mod regimes;

use std::fs;
use std::path::PathBuf;

use anyhow::{Result, ensure};
use clap::Args;
use motile_cli::run::say;

use crate::tables::root;

/// Draws the picture of the regimes.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Write it to docs/images rather than to the directory
    #[arg(long)]
    write: bool,
    /// Directory of the picture
    #[arg(long, value_name = "DIRECTORY", default_value = "out/pictures")]
    out: PathBuf,
}

/// Largest file of a picture (bytes).
const LARGEST: usize = 60_000;

pub(crate) fn run(flags: &Flags) -> Result<()> {
    let folder = if flags.write { root().join("docs/images") } else { flags.out.clone() };
    fs::create_dir_all(&folder)?;
    let (name, picture) = ("regimes", regimes::picture()?);
    ensure!(picture.len() < LARGEST, "{name}.svg has {} bytes, more than {LARGEST}", picture.len());
    fs::write(folder.join(format!("{name}.svg")), &picture)?;
    say(format_args!("{name}.svg: {} bytes", picture.len()));
    Ok(())
}
