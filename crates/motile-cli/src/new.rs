//! Scenes to begin with.

use std::fs::OpenOptions;
use std::io::{ErrorKind, Write as _};
use std::path::PathBuf;

use anyhow::{Context, Result, bail};
use clap::Args;
use motile::setup::Setup;
use motile_cli::run::say;

/// Options of a new scene.
#[derive(Debug, Args)]
pub(crate) struct NewFlags {
    /// File to write [default: scene.toml]
    #[arg(value_name = "FILE", default_value = "scene.toml", hide_default_value = true)]
    file: PathBuf,
    /// Example to write, by its name, in place of a swimmer in a channel
    #[arg(long, value_name = "NAME", conflicts_with = "all")]
    example: Option<String>,
    /// List the examples
    #[arg(long)]
    list: bool,
    /// Write every key, with its dimension and its default
    #[arg(long)]
    all: bool,
}

/// Names and texts of the examples.
macro_rules! examples {
    ($($name:literal),*) => {
        [$(($name, include_str!(concat!("../scenes/", $name, ".toml")))),*]
    };
}

/// Examples, which the repository has in `examples/scenes`.
const EXAMPLES: [(&str, &str); 18] = examples![
    "active_walls",
    "circles",
    "constriction",
    "drop",
    "elastic_walls",
    "encounter",
    "exchange",
    "gel",
    "living_walls",
    "meeting",
    "nucleus",
    "rigid_channel",
    "rigid_walls",
    "shear",
    "slit",
    "suspension",
    "swimmer",
    "tube"
];

/// Writes a scene file, or lists the examples.
///
/// # Errors
/// Returns an error for an example that does not exist; a file that exists already or cannot be written.
pub(crate) fn write(flags: &NewFlags) -> Result<()> {
    let names = || EXAMPLES.map(|(name, _)| name).join(", ");
    if flags.list {
        for (name, text) in EXAMPLES {
            let about = text.lines().next().unwrap_or_default();
            say(format_args!("{name:<14} {}", about.trim_start_matches("# ")));
        }
        return Ok(());
    }
    let text = match &flags.example {
        Some(wanted) => match EXAMPLES.iter().find(|(name, _)| name == wanted) {
            Some((_, text)) => text,
            None => bail!("--example {wanted} is not one of {}", names()),
        },
        None if flags.all => Setup::ANNOTATED,
        None => include_str!("new/scene.toml"),
    };
    let path = flags.file.display();
    let mut file = match OpenOptions::new().write(true).create_new(true).open(&flags.file) {
        Err(error) if error.kind() == ErrorKind::AlreadyExists => bail!("{path} exists already. Use another name"),
        file => file.with_context(|| format!("writing {path}"))?,
    };
    file.write_all(text.as_bytes()).with_context(|| format!("writing {path}"))?;
    say(format_args!("{path} is written: `motile check {path}` says what it does, `motile run {path}` runs it"));
    Ok(())
}
