//! Output and checkpoints of a run, as flags of a command line.

mod look;

use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context, Result, ensure};
use clap::Args;
use motile::scene::{Run, Scene, SceneError, checkpoint::Checkpoint};
use motile::setup::{AnyFlow, Setup};
use motile_output::Look;

pub use look::LookFlags;

use super::places::{Places, are_one};
use super::summary::make_directory;

/// Default number of steps between checkpoints.
const EVERY: usize = 500;

/// First line of scene files that runs write.
const WRITTEN: &str = "# Written by a run of motile (--write-scene), which replaces this file without asking.";

/// Files that runs leave in their directory.
const RESULTS: [&str; 13] = [
    "summary.json",
    "summary.json.part",
    "trajectory.csv",
    "droplets.csv",
    "interfaces.csv",
    "bodies.csv",
    "flow.csv",
    "final.png",
    "swim.gif",
    "time_series.svg",
    "time_series.png",
    "concentration_profile.svg",
    "concentration_profile.png",
];

/// Run of a scene that was built from a [`Setup`].
type FlowRun<'a> = Run<'a, AnyFlow>;

/// Request of the user to stop the run.
static STOP: AtomicBool = AtomicBool::new(false);

/// Checkpoints of a run: where they are saved, how often, and from which one the run continues.
#[derive(Debug, Clone, Default, PartialEq, Eq, Args)]
pub struct CheckpointFlags {
    /// File to save checkpoints to; Ctrl-C, SIGTERM and SIGHUP then save one and end the run
    #[arg(long, value_name = "FILE")]
    pub checkpoint: Option<PathBuf>,
    /// Steps between checkpoints [default: 500]
    #[arg(long, value_name = "STEPS", value_parser = steps, requires = "checkpoint", allow_hyphen_values = true)]
    pub checkpoint_every: Option<usize>,
    /// Checkpoint to continue from; give the flags of the run that saved it. Tables and results cover the whole run,
    /// the animation the rest. They are bitwise identical to a run without a break, except after the end of a run with
    /// a shorter --time, whose last steps are shorter
    #[arg(long, value_name = "FILE")]
    pub resume: Option<PathBuf>,
}

impl CheckpointFlags {
    /// Brings the scene to the state of the checkpoint to continue from, if one is given. If the checkpoint was saved
    /// with other settings that may change ([`Setup::entries`]), which its description shows, the run continues with
    /// those given now and a note is printed.
    ///
    /// # Errors
    /// Returns an error for a checkpoint that cannot be read, is of another scene or other physics, or not before the
    /// time `end`; a file to save to that cannot be written.
    pub fn resume(&self, scene: &mut Scene<AnyFlow>, description: &str, end: f64) -> Result<()> {
        self.try_file()?;
        let Some(path) = &self.resume else { return Ok(()) };
        let flag = || format!("--resume {}", path.display());
        let checkpoint = Checkpoint::read(path).with_context(flag)?;
        let time = checkpoint.time();
        ensure!(time < end, "{}: the checkpoint was saved at t = {time}. Use a --time above that", flag());
        scene.resume(&checkpoint).with_context(flag)?;
        if checkpoint.description() != description {
            eprintln!(
                "note: the checkpoint was saved with other settings of the computation ({}), the run continues with \
                 those given now",
                checkpoint.description()
            );
        }
        Ok(())
    }

    /// Refuses a place where checkpoints cannot be saved.
    fn try_file(&self) -> Result<()> {
        let Some(path) = &self.checkpoint else { return Ok(()) };
        let flag = || format!("--checkpoint {}", path.display());
        let special = path.metadata().is_ok_and(|data| !data.is_file());
        ensure!(!special, "{}: the path exists, but is not a file. Use another name", flag());
        ensure!(
            !is_foreign(path, &Checkpoint::MARK).with_context(flag)?,
            "{}: a file with this name exists and is not a checkpoint. Use another name",
            flag()
        );
        // Under a name that is nobody else's.
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let trial = path.with_file_name(format!(".{name}.{}.trial", std::process::id()));
        std::fs::write(&trial, "trial").and_then(|()| std::fs::remove_file(&trial)).with_context(flag)
    }

    /// Returns the run that saves checkpoints as the flags say and ends on Ctrl-C, SIGTERM and SIGHUP.
    ///
    /// # Errors
    /// Returns an error if signals cannot be caught.
    pub(crate) fn watch<'a>(&'a self, run: FlowRun<'a>, description: &'a str) -> Result<FlowRun<'a>> {
        let Some(path) = &self.checkpoint else { return Ok(run) };
        let every = self.checkpoint_every.unwrap_or(EVERY);
        match ctrlc::set_handler(|| STOP.store(true, Ordering::Relaxed)) {
            // A second run of the same program is listened to already.
            Ok(()) | Err(ctrlc::Error::MultipleHandlers) => {}
            Err(error) => return Err(error).context("Ctrl-C cannot be listened to"),
        }
        Ok(run.save(every, path, description).stop_on(&STOP))
    }

    /// Saves the last state of a run: to the file of the flags if the run ended or was stopped. If it failed, to a file
    /// whose name has `.last` added, so that the last periodic checkpoint stays.
    ///
    /// # Errors
    /// Returns an error for a file that cannot be written.
    pub fn save(&self, scene: &Scene<AnyFlow>, description: &str, outcome: &Result<(), SceneError>) -> Result<()> {
        let Some(path) = &self.checkpoint else { return Ok(()) };
        let mut path = path.clone().into_os_string();
        if !matches!(outcome, Ok(()) | Err(SceneError::Stopped { .. })) {
            path.push(".last");
        }
        Ok(scene.checkpoint(description).write(Path::new(&path))?)
    }
}

/// Output of a run: which files are written, and where.
#[derive(Debug, Clone, Default, PartialEq, Args)]
pub struct OutputFlags {
    /// Draw no pictures, plots and animations
    #[arg(long)]
    pub no_pictures: bool,
    /// Show no progress
    #[arg(long)]
    pub quiet: bool,
    /// Most rows of the tables of a run, at equal times; without it 1000. What a summary says of a whole run
    /// (amplitude, period, mean speed) comes from them
    #[arg(long, value_name = "ROWS", value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
    pub rows: Option<u32>,
    /// Directory of the results [default: out/ and the name of the scene or example]
    #[arg(long, value_name = "DIRECTORY")]
    pub out: Option<PathBuf>,
    /// Write the scene to this TOML file, for `motile run`
    #[arg(long, value_name = "FILE")]
    pub write_scene: Option<PathBuf>,
    /// Checkpoints of the run
    #[command(flatten)]
    pub checkpoints: CheckpointFlags,
    /// Settings of the pictures
    #[command(flatten)]
    pub look: LookFlags,
}

impl OutputFlags {
    /// Refuses two files of the run `name` that are one and the same, also by links; `scene` is the scene file that it
    /// reads. A checkpoint may replace the one from which the run continues.
    ///
    /// # Errors
    /// Returns an error for two flags, or a flag and a result, that name the same file; sizes that no picture can have.
    pub fn check(&self, name: &str, scene: Option<&Path>) -> Result<()> {
        self.look.apply(Look::default()).check()?;
        let (directory, mut places) = (self.place(name), Places::default());
        let CheckpointFlags { checkpoint, resume, .. } = &self.checkpoints;
        let saved = checkpoint.as_deref();
        let resume = resume.as_deref().filter(|resume| !saved.is_some_and(|saved| are_one(resume, saved)));
        let files = [("--scene", scene), ("--write-scene", self.write_scene.as_deref())];
        for (flag, path) in files.into_iter().chain([("--checkpoint", saved), ("--resume", resume)]) {
            if let Some(path) = path {
                places.add(format!("{flag} {}", path.display()), path)?;
            }
        }
        places.check_directory(&format!("--out {}", directory.display()), &directory)?;
        places.add(format!("the files for ParaView in --out {}", directory.display()), &directory.join("vtk"))?;
        RESULTS.iter().try_for_each(|file| {
            places.add(format!("the result {file} in --out {}", directory.display()), &directory.join(file))
        })
    }

    /// Writes the scene file, if one is asked for. It begins with a line that says that it may be replaced.
    ///
    /// # Errors
    /// Returns an error for a file that cannot be written, or that no run has written.
    pub fn write_scene(&self, setup: &Setup) -> Result<()> {
        let Some(path) = &self.write_scene else { return Ok(()) };
        let flag = || format!("--write-scene {}", path.display());
        let foreign = is_foreign(path, WRITTEN.as_bytes()).with_context(flag)?;
        ensure!(!foreign, "{}: a file with this name exists, and no run has written it. Use another name", flag());
        std::fs::write(path, format!("{WRITTEN}\n{}", setup.to_toml()?)).with_context(flag)
    }

    /// Returns the directory of the results of the run `name`, created if needed.
    ///
    /// # Errors
    /// Returns an error for a directory that cannot be created.
    pub fn directory(&self, name: &str) -> Result<PathBuf> {
        let directory = self.place(name);
        make_directory(&directory)?;
        Ok(directory)
    }

    fn place(&self, name: &str) -> PathBuf {
        self.out.clone().unwrap_or_else(|| Path::new("out").join(name))
    }
}

/// Returns true if there is a file that begins otherwise, which would be lost.
fn is_foreign(path: &Path, beginning: &[u8]) -> std::io::Result<bool> {
    if !path.exists() {
        return Ok(false);
    }
    let mut first = Vec::with_capacity(beginning.len());
    std::fs::File::open(path)?.take(beginning.len() as u64).read_to_end(&mut first)?;
    Ok(!first.is_empty() && first != beginning)
}

fn steps(text: &str) -> Result<usize, String> {
    let number = text.trim().parse().ok().filter(|number| (1..=1_000_000_000).contains(number));
    number.ok_or_else(|| "must be a whole number from 1 to 1000000000".to_owned())
}

#[cfg(test)]
mod tests;
