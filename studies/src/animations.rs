//! The animations of the pages, one of each scene in `examples/scenes` that a page shows.
//!
//! `cargo run --release -p studies -- animations` runs every scene to the time in its first lines (`--time T`) and
//! writes `out/animations/NAME.gif`; `--write` puts them into `docs/images/scenes`. `studies -- pages` puts them and
//! the text of the scenes into `README.md`.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use clap::Args;
use motile::base::Region;
use motile::scene::Every;
use motile::setup::{Built, Setup};
use motile_cli::run::say;
use motile_output::{Animation, Look, Raster};

use crate::tables::{pages_of, root};

/// Draws the animations of the first page.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Name of one scene; without it all
    scene: Option<String>,
    /// Write them to docs/images/scenes rather than to the directory
    #[arg(long)]
    write: bool,
    /// Directory of the animations
    #[arg(long, value_name = "DIRECTORY", default_value = "out/animations")]
    out: PathBuf,
}

/// Frames of an animation, their width (pixels), and cells of the fields along the longer side.
const FRAMES: usize = 32;
const WIDTH: f64 = 260.0;
const CELLS: f64 = 65.0;
/// Rectangle that is shown of unbounded fluid (R0).
const VIEW: [f64; 2] = [10.0, 8.0];
/// Largest file (bytes), and largest sum of all.
const LARGEST: u64 = 250_000;
const LARGEST_SUM: u64 = 1_500_000;

pub(crate) fn run(flags: &Flags) -> Result<()> {
    let names = names()?;
    if let Some(wanted) = &flags.scene {
        ensure!(names.contains(wanted), "there is no scene {wanted}. Use one of {}", names.join(", "));
    }
    let folder = if flags.write { root().join("docs/images/scenes") } else { flags.out.clone() };
    fs::create_dir_all(&folder)?;
    let mut sum = 0;
    for name in names {
        let wanted = match &flags.scene {
            Some(wanted) => *wanted == name,
            None => is_shown(&name)?,
        };
        if !wanted {
            continue;
        }
        let path = folder.join(format!("{name}.gif"));
        let [time, steps] = film(&name, &path).with_context(|| format!("scene {name}"))?;
        let bytes = fs::metadata(&path)?.len();
        ensure!(bytes <= LARGEST, "{}: {bytes} bytes, more than {LARGEST}", path.display());
        sum += bytes;
        say(format_args!("{name}: t = {time}, {steps} steps, {bytes} bytes"));
    }
    ensure!(sum <= LARGEST_SUM, "{sum} bytes of animations, more than {LARGEST_SUM}");
    Ok(())
}

/// Runs a scene and writes its animation: end time and number of steps.
fn film(name: &str, path: &Path) -> Result<[f64; 2]> {
    let text = read(name)?;
    let (setup, time) = (Setup::from_toml(&text)?, end(&text)?);
    let Built { mut scene, .. } = setup.build()?;
    let raster = match setup.region {
        Region::Plane | Region::Space | Region::Tube { .. } => {
            let height = if let Region::Tube { radius, .. } = setup.region { 2.0 * radius } else { VIEW[1] };
            let cells = [VIEW[0], height].map(|side| (side * CELLS / VIEW[0]).round() as usize);
            Raster::new([-0.5 * VIEW[0], -0.5 * height], [VIEW[0], height], cells, [false; 2])?
        }
        _ => {
            let [x, y] = setup.region.lengths();
            Raster::of(scene.system(), x.max(y) / CELLS)?
        }
    };
    let concentration = setup.droplets.iter().find_map(|droplet| Some(droplet.particles.as_ref()?.concentration));
    let look = Look { concentration, streamlines: false, colour_bars: false, scale_bar: false, ..Look::of(&setup) };
    let mut film = Animation::new(look, raster).of_width(WIDTH);
    scene.run(time).observe(Every::Time(time / FRAMES as f64), &mut film).go()?;
    film.write(&[], path)?;
    Ok([time, scene.steps() as f64])
}

/// Animation and text of a scene, as Markdown.
pub(crate) fn text(name: &str) -> Result<String> {
    let text = read(name)?;
    let code: Vec<&str> = text.lines().skip_while(|line| line.starts_with('#')).collect();
    Ok(format!("![{name}](docs/images/scenes/{name}.gif)\n\n```toml scene\n{}\n```\n", code.join("\n").trim()))
}

/// True if a page shows the animation of a scene.
fn is_shown(name: &str) -> Result<bool> {
    let picture = format!("scenes/{name}.gif");
    for page in pages_of()? {
        if fs::read_to_string(page)?.contains(&picture) {
            return Ok(true);
        }
    }
    Ok(false)
}

fn folder() -> PathBuf {
    root().join("examples/scenes")
}

fn read(name: &str) -> Result<String> {
    let path = folder().join(format!("{name}.toml"));
    fs::read_to_string(&path).with_context(|| path.display().to_string())
}

fn names() -> Result<Vec<String>> {
    let stem = |path: PathBuf| Some(path.file_stem()?.to_string_lossy().into_owned());
    let mut names: Vec<String> = fs::read_dir(folder())?.filter_map(|entry| stem(entry.ok()?.path())).collect();
    names.sort();
    Ok(names)
}

/// Time to which the comment at the start of a scene runs it.
fn end(text: &str) -> Result<f64> {
    let comment = text.lines().take_while(|line| line.starts_with('#'));
    let time = comment.filter_map(|line| line.split_once("--time ")).map(|(_, time)| time.trim()).next();
    Ok(time.context("no '--time T' in the comment at its start")?.parse()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_can_be_built_and_say_how_long_they_run() {
        let names = names().expect("scenes");
        assert!(names.len() > 8, "{names:?}");
        for name in names {
            let text = read(&name).expect("a scene");
            Setup::from_toml(&text).and_then(|setup| setup.build().map(drop)).expect(&name);
            assert!(end(&text).expect(&name) > 0.0);
            assert!(text.contains(&format!("run examples/scenes/{name}.toml --time ")), "{name}: no command");
            let lines = text.lines().filter(|line| !line.starts_with('#') && !line.is_empty());
            assert!(lines.count() <= 14, "{name} is longer than what is read at a glance");
        }
    }
}
