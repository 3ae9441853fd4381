//! Runs of scenes with a droplet, from the check of their settings to their pictures.

mod results;

use anyhow::{Context, Result, bail};
use motile::active_interface::ActiveDroplet;
use motile::active_interface::observables::{ConcentrationProfile, Frame, concentration_profile};
use motile::analysis::trajectory::TrajectoryRecord;
use motile::base::{Vec2, internal::decimals};
use motile::scene::{Every, Handle, Observer, Scene, SceneError, gap::SolidGap};
use motile::setup::{AnyFlow, Built, DropletSetup, ExcludedVolume, GridMethod, MethodKind, Numbers, Particles, Setup};

use super::scene_run::view as view_of;
use super::{flags::OutputFlags, job::Job, job::Watch, summary::Summary, words::say};
use motile_output::plot::{concentration_plot, time_series};
use motile_output::{
    Animation, CsvTable, DropletsCsv, Look, ParaView, Raster, Snapshot, SolidColour, Track, TrajectoryCsv,
};

/// Files for ParaView in a run.
const FILES: f64 = 20.0;
/// Time between the frames of the animation (R^2/D), and the smallest and largest number of frames.
const FRAME_INTERVAL: f64 = 0.12;
const FRAMES: [f64; 2] = [50.0, 150.0];
/// Spacing of the fields over that of a grid where there is no grid: there each point costs a sum over the interface.
const COARSER: f64 = 2.0;
/// Depth to which a droplet may enter an elastic solid before its run ends with an error (grid spacings).
const SOLID_OVERLAP: f64 = 0.25;
/// Distance of streamlines (length scales of the scene).
const STREAMLINES: f64 = 0.24;

/// Resolution and caption of the pictures of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// Spacing of the raster of fields in pictures (length).
    pub spacing: f64,
    /// Text about the region in the title of a picture; empty where the picture shows the region itself.
    pub region: String,
}

impl View {
    /// View with the spacing of a scene's grid, or a twentieth of its length scale where it has none, and no text.
    #[must_use]
    pub fn of(setup: &Setup) -> Self {
        let spacing = setup.method.spacing().unwrap_or(GridMethod::default().spacing * setup.length_scale());
        Self { spacing, region: String::new() }
    }
}

/// Run of a scene whose first droplet is measured, drawn and recorded (`trajectory.csv`). If there are several, a table
/// of all of them is written as well (`droplets.csv`, [`DropletsCsv`]).
#[derive(Debug)]
pub struct WatchedRun {
    /// Scene in its present state.
    pub scene: Scene<AnyFlow>,
    job: Job,
    droplet: Handle<ActiveDroplet>,
    particles: Particles,
    /// Dimensionless numbers of the droplet.
    numbers: Option<Numbers>,
    method: MethodKind,
    /// Radius of the droplet (length).
    radius: f64,
    raster: Raster,
    start: ConcentrationProfile,
    recorder: TrajectoryCsv,
    /// Table of all droplets, where there are several.
    droplets: Option<DropletsCsv>,
    pictures: Option<(Look, Animation, ParaView)>,
    gap: SolidGap,
}

impl WatchedRun {
    /// Run to the time `end` of the scene that was built from `setup`, recording its first droplet. Its results go to
    /// the directory in `output`, by default to `out/<name>/`.
    ///
    /// # Errors
    /// Those of [`Job::new`]; a first droplet without particles.
    pub fn new(built: Built, setup: &Setup, end: f64, output: &OutputFlags, name: &str, view: &View) -> Result<Self> {
        let Built { mut scene, droplets, .. } = built;
        let (described, setup) = (setup, &setup.placed()?);
        let (Some(&droplet), Some(&DropletSetup { centre: [x, y], angle, particles: Some(particles), .. })) =
            (droplets.first(), setup.droplets.first())
        else {
            bail!("the first droplet of the scene is the one that is watched: give one with particles");
        };
        let (body, frame) = (scene.body(droplet)?, Frame::new(Vec2::new(x, y), angle)?);
        let start = concentration_profile(body.markers(), body.particle_numbers(), &frame)?;
        let numbers = setup.numbers(&setup.droplets[0])?;
        let job = Job::new(&mut scene, described, end, output, name)?;
        let radius = setup.length_scale();
        let raster = |spacing: f64| view_of(setup.region, &scene, Vec2::new(x, y), spacing, radius);
        let (method, spacing) = (setup.method.kind(), view.spacing);
        let watched = raster(if method != MethodKind::Integral { spacing } else { COARSER * spacing })?;
        let still = raster(spacing)?;
        let recorder = TrajectoryCsv::create(job.directory.join("trajectory.csv"), scene.system_mut(), droplet)?;
        let several = droplets.len() > 1;
        let table = several.then(|| DropletsCsv::create(job.directory.join("droplets.csv"), scene.system_mut()));
        let gap = SolidGap::new(SOLID_OVERLAP * spacing);
        let mut pictures = None;
        if job.draws() {
            let caption = caption(setup, &view.region);
            // Another unit would be wrong for droplets of another mean concentration.
            let means = setup.droplets.iter().filter_map(|droplet| droplet.particles);
            let alike = means.clone().all(|other| other.concentration == particles.concentration);
            let concentration = alike.then_some(particles.concentration);
            let internal = setup.solids.iter().any(|s| !s.relaxation.is_empty() || s.active_springs.is_some());
            let solids = if internal { SolidColour::InternalStress } else { SolidColour::Stress };
            let streamline_spacing = Some(STREAMLINES * radius);
            let look = Look { caption, concentration, streamline_spacing, solids, ..Look::of(setup) };
            let look = output.look.apply(look);
            let vtk = ParaView::create(job.directory.join("vtk"), watched)?;
            pictures = Some((look.clone(), Animation::new(look, watched), vtk));
        }
        let (raster, droplets) = (still, table.transpose()?);
        Ok(Self {
            scene,
            job,
            droplet,
            particles,
            numbers,
            method,
            radius,
            raster,
            start,
            recorder,
            droplets,
            pictures,
            gap,
        })
    }

    /// Runs to the end, or until the observer `end`, called at every step, returns the error [`super::Decided`]. The
    /// last state is recorded even if the run fails.
    ///
    /// # Errors
    /// Files that cannot be written. The failure of the run itself is returned by [`WatchedRun::finish`].
    pub fn go(&mut self, end: Option<&mut dyn Observer<AnyFlow>>) -> Result<()> {
        let time = self.job.end;
        let row = self.job.each_row();
        let mut observers: Vec<Watch<'_>> = vec![(row, &mut self.recorder), (Every::Steps(1), &mut self.gap)];
        if let Some(table) = &mut self.droplets {
            observers.push((row, table));
        }
        if let Some(end) = end {
            observers.push((Every::Steps(1), end));
        }
        if let Some((_, film, vtk)) = &mut self.pictures {
            let interval = FRAME_INTERVAL * self.radius * self.radius / self.particles.diffusion;
            let frames = (time / interval).clamp(FRAMES[0], FRAMES[1]);
            observers.push((Every::StepAfter(time / frames), film));
            observers.push((self.job.each(FILES), vtk));
        }
        self.job.go(&mut self.scene, observers)?;
        if self.job.is_stopped() {
            // The rows are to be those of a run that was not stopped.
            return Ok(());
        }
        Ok(self.recorder.finish(self.scene.system_mut())?)
    }

    /// Outcome of the run, without summary and pictures.
    ///
    /// # Errors
    /// The failure of the run.
    pub fn outcome(self) -> Result<(), SceneError> {
        self.job.outcome()
    }

    /// Times and centroids of the droplet (length), as [`TrajectoryCsv::track`].
    #[must_use]
    pub fn track(&self) -> Track {
        self.recorder.track()
    }

    /// Observables of the droplet in the order of time, also from before the checkpoint that the run goes on from.
    #[must_use]
    pub fn table(&self) -> &CsvTable {
        self.recorder.table()
    }

    /// Number of particles at the start, on the interface and inside (no dimension).
    ///
    /// # Errors
    /// A run that has not begun.
    pub fn totals(&self) -> Result<f64> {
        let table = self.recorder.table();
        let first =
            |column| -> Result<f64> { Ok(table.curve("time", column)?.first().context("nothing was measured")?.1) };
        Ok(first("particle_number")? + first("number_inside").unwrap_or(0.0))
    }

    /// Last value in a column of the trajectory; `None` if it has no such column.
    #[must_use]
    pub fn last_of(&self, column: &str) -> Option<f64> {
        Some(self.recorder.table().curve("time", column).ok()?.last()?.1)
    }

    /// Last measurement of the droplet.
    ///
    /// # Errors
    /// A run that has not begun.
    pub fn last(&self) -> Result<&TrajectoryRecord> {
        self.recorder.last().context("nothing was measured")
    }

    /// Writes and prints the results; draws the final state (`final.png`), the run (`swim.gif`) and the plots, unless
    /// pictures are not wanted.
    ///
    /// # Errors
    /// The failure of the run; files that cannot be written.
    pub fn finish(self, summary: &Summary) -> Result<()> {
        let Self { mut scene, job, droplet, particles, raster, start, recorder, pictures, .. } = self;
        let directory = job.directory.clone();
        job.finish(summary, || {
            let (Some((look, film, _)), Some(last)) = (pictures, recorder.last()) else {
                return Ok(());
            };
            time_series(recorder.table())?.write(&directory, "time_series")?;
            let body = scene.body(droplet)?;
            let frame = last.observables.frame();
            let profile = concentration_profile(body.markers(), body.particle_numbers(), &frame)?;
            concentration_plot(&start, &profile, scene.time(), particles.concentration)
                .write(&directory, "concentration_profile")?;
            let tracks = [recorder.track()];
            let seen = Snapshot::take(scene.system_mut(), raster)?;
            look.write_picture(&seen, &tracks, directory.join("final.png"))?;
            film.write(&tracks, directory.join("swim.gif"))?;
            if let Some(begins) = film.begins().filter(|begins| *begins > 0.0) {
                say(format_args!("swim.gif begins at t = {}, where the run was resumed", decimals(4, begins)));
            }
            Ok(())
        })
    }
}

/// Title of pictures: the parameters of all droplets of a scene, and of their particles. Where droplets differ, it
/// tells the least and the largest value.
fn caption(setup: &Setup, region: &str) -> String {
    let droplets = || setup.droplets.iter();
    let particles = || droplets().filter_map(|droplet| droplet.particles);
    let strength = |particles: Particles| match particles.excluded_volume {
        ExcludedVolume::Step(strength) => Some(strength),
        _ => None,
    };
    let mut parts = vec![format!("ζΔμ = {}", range(particles().map(|particles| particles.activity)))];
    if particles().all(|particles| strength(particles).is_some()) {
        parts.push(format!("A = {}", range(particles().filter_map(strength))));
    }
    let inside = droplets()
        .any(|droplet| droplet.viscosity.is_some())
        .then(|| range(droplets().map(|droplet| droplet.viscosity.unwrap_or(setup.viscosity))) + " in ");
    parts.push(format!("η = {}{}", inside.unwrap_or_default(), setup.viscosity));
    if !region.is_empty() {
        parts.push(region.to_owned());
    }
    parts.join(",  ").replace('-', "−")
}

/// One value that all have, or the least and the largest value.
fn range(values: impl Iterator<Item = f64>) -> String {
    let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)]);
    if low == high { format!("{low}") } else { format!("{low} to {high}") }
}

#[cfg(test)]
mod tests;
