//! A run of a scene with a droplet, from the first check to the last file.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use motile::{
    Method, SolidGap, Swimmer,
    active_interface::{
        ActiveDroplet,
        observables::{ConcentrationProfile, Frame, concentration_profile},
        trajectory::TrajectoryRecord,
    },
    ib_core::{Every, Handle, Hydrodynamics, Integrator, Observer, Scene, SceneError, StepSize, System, Vec2},
};

use crate::{CheckpointFlags, Decided, OutputFlags, RunCost, Steadiness, Summary, droplet_summary, put_solids};
use motile_output::{Film, Look, ParaView, RunProgress, Snapshot, TrajectoryCsv, concentration_plot, time_series};

/// Rows of the trajectory and files for ParaView in a run.
const ROWS: f64 = 1000.0;
const FILES: f64 = 20.0;
/// Time between frames of the animation, of which there are some number in this range.
const FRAME_INTERVAL: f64 = 1.2;
const FRAMES: [f64; 2] = [50.0, 150.0];
/// Spacing of the fields over that of a grid where there is no grid: there each point costs a sum over the interface.
const COARSER: f64 = 2.0;
/// How deep a droplet may come into an elastic solid, in grid spacings, before its run ends with an error.
const SOLID_OVERLAP: f64 = 0.25;
/// Distance of streamlines (R0).
const STREAMLINES: f64 = 0.24;

/// Most steps of a run: more would take weeks.
const MOST_STEPS: f64 = 1e9;

/// Refuses a run that could not start with its time step, or could not end in a lifetime, before anything is written.
///
/// # Errors
/// A time step that is not stable, or one so short that the run would take more than 1e9 steps.
pub fn check_run<H: Hydrodynamics, I: Integrator>(scene: &Scene<H, I>, end: f64, step: StepSize) -> Result<()> {
    let dt = match step {
        StepSize::Fixed(dt) => {
            scene.check_step(dt)?;
            dt
        }
        StepSize::OfLimit(fraction) => scene.step_limit().map_or(f64::INFINITY, |(limit, ..)| fraction * limit),
        StepSize::Adaptive { .. } => f64::INFINITY,
    };
    ensure!(
        end / dt <= MOST_STEPS,
        "time {end} would take {:.0e} steps of {dt:.1e}: give a higher viscosity, a larger spacing or a shorter time",
        end / dt
    );
    Ok(())
}

/// A run of a scene with one droplet, and all that watches it.
#[derive(Debug)]
pub struct WatchedRun {
    droplet: Handle<ActiveDroplet>,
    swimmer: Swimmer,
    end: f64,
    directory: PathBuf,
    start: ConcentrationProfile,
    recorder: TrajectoryCsv,
    progress: RunProgress,
    pictures: Option<(Film, ParaView)>,
    cost: RunCost,
    gap: SolidGap,
    checkpoints: CheckpointFlags,
    description: String,
}

impl WatchedRun {
    /// A run to time `end` of a scene that was made from `swimmer`. Its results go where `output` says, by default to
    /// `out/<name>/`; pictures bear the `caption`.
    ///
    /// # Errors
    /// A time step that is not stable, before anything is written; a directory that cannot be made.
    pub fn new<H: Hydrodynamics, I: Integrator>(
        scene: &mut Scene<H, I>,
        droplet: Handle<ActiveDroplet>,
        swimmer: &Swimmer,
        end: f64,
        output: &OutputFlags,
        name: &str,
        caption: String,
    ) -> Result<Self> {
        check_run(scene, end, swimmer.step)?;
        // The time step may change on the way.
        let description = format!("{name}: {:?}", Swimmer { step: StepSize::default(), ..swimmer.clone() });
        output.checkpoints.resume(scene, &description, end)?;
        let body = scene.body(droplet)?;
        let frame = Frame::new(Vec2::new(swimmer.offset[0], swimmer.offset[1]), swimmer.angle)?;
        let start = concentration_profile(body.markers(), body.particle_numbers(), &frame)?;
        let spacing = match swimmer.method {
            Method::BoundaryIntegral => COARSER * swimmer.spacing,
            Method::ImmersedBoundary => swimmer.spacing,
        };

        let directory = output.directory(name)?;
        let recorder = TrajectoryCsv::create(directory.join("trajectory.csv"), scene.system_mut(), droplet)?;
        let pictures = if output.no_pictures {
            None
        } else {
            let concentration = Some(swimmer.mean_concentration);
            let look = Look { caption, concentration, streamline_spacing: Some(STREAMLINES) };
            Some((Film::new(look, spacing), ParaView::create(directory.join("vtk"), spacing)?))
        };
        Ok(Self {
            droplet,
            swimmer: swimmer.clone(),
            end,
            directory,
            start,
            recorder,
            progress: RunProgress::new(end, output.quiet),
            pictures,
            cost: RunCost::default(),
            gap: SolidGap::new(SOLID_OVERLAP * swimmer.spacing),
            checkpoints: output.checkpoints.clone(),
            description,
        })
    }

    /// The same where solids are meshed this far behind the surfaces where they stop the fluid (length): widths and
    /// gaps are those between these surfaces.
    #[must_use]
    pub fn with_set_back(mut self, set_back: f64) -> Self {
        self.gap = self.gap.with_set_back(set_back);
        self.recorder.set_back(set_back);
        self
    }

    /// Runs. What the scene has come to is recorded even where it breaks off.
    ///
    /// # Errors
    /// What made the run break off, as the inner result; files that cannot be written.
    pub fn go<H: Hydrodynamics, I: Integrator>(&mut self, scene: &mut Scene<H, I>) -> Result<Result<(), SceneError>> {
        self.go_until(scene, &mut |_: &mut System<H>| Ok::<(), std::convert::Infallible>(()))
    }

    /// Runs until an observer, which looks at every step, ends the run by the error [`Decided`].
    ///
    /// # Errors
    /// As [`WatchedRun::go`].
    pub fn go_until<H: Hydrodynamics, I: Integrator>(
        &mut self,
        scene: &mut Scene<H, I>,
        end: &mut dyn Observer<H>,
    ) -> Result<Result<(), SceneError>> {
        let mut run = scene
            .run(self.end)
            .step_size(self.swimmer.step)
            .observe(Every::StepAfter(self.end / ROWS), &mut self.recorder)
            .observe(Every::Steps(1), &mut self.gap)
            .observe(Every::Steps(1), end)
            .observe(Every::Steps(1), &mut self.progress);
        if let Some((film, vtk)) = &mut self.pictures {
            let frames = (self.end / FRAME_INTERVAL).clamp(FRAMES[0], FRAMES[1]);
            run =
                run.observe(Every::StepAfter(self.end / frames), film).observe(Every::StepAfter(self.end / FILES), vtk);
        }
        let run = self.checkpoints.watch(run, &self.description)?;
        let outcome = match run.go() {
            Err(SceneError::Observer { source, .. }) if source.is::<Decided>() => Ok(()),
            outcome => outcome,
        };
        self.cost = RunCost {
            time: scene.time(),
            steps: scene.steps(),
            seconds: self.progress.finish(),
            work: scene.system().hydrodynamics().work(),
            report: scene.step_report().clone(),
            stages: scene.integrator_work().stages,
            failure: outcome.as_ref().err().map(SceneError::explanation),
        };
        self.checkpoints.save(scene, &self.description, &outcome)?;
        self.recorder.finish(scene.system_mut())?;
        Ok(outcome)
    }

    /// What was measured.
    #[must_use]
    pub fn recorder(&self) -> &TrajectoryCsv {
        &self.recorder
    }

    /// Where the results are.
    #[must_use]
    pub fn directory(&self) -> &Path {
        &self.directory
    }

    /// The results that all scenes with a droplet have.
    ///
    /// # Errors
    /// A run that has not been.
    pub fn summary(&self) -> Result<Summary> {
        let (first, last) = self.records().first().zip(self.records().last()).context("nothing was measured")?;
        let speeds = self.recorder.table().curve("time", "speed")?;
        let steadiness = Steadiness::of(&speeds, self.swimmer.diffusion / self.swimmer.radius.powi(2));
        let mut summary = droplet_summary(
            &first.observables,
            &last.observables,
            &steadiness,
            &self.cost,
            self.swimmer.mean_concentration,
        );
        let method = match self.swimmer.method {
            Method::BoundaryIntegral => "boundary-integral",
            Method::ImmersedBoundary => "immersed-boundary",
        };
        summary.put("method", method, "for the flow");
        if let Some(values) = self.recorder.last_solids() {
            put_solids(&mut summary, values);
            let least = self.gap.smallest().map(|(gap, _)| gap);
            summary.put("minimum_gap", least, "between droplet and walls, over the run (R0)");
        }
        Ok(summary)
    }

    /// Draws the final state (`final.png`), the run (`swim.gif`) and the plots, unless pictures are not wanted.
    ///
    /// # Errors
    /// Files that cannot be written.
    pub fn write_pictures<H: Hydrodynamics, I: Integrator>(&self, scene: &mut Scene<H, I>) -> Result<()> {
        let (Some((film, _)), Some(last)) = (&self.pictures, self.records().last()) else { return Ok(()) };
        let (directory, trajectory) = (&self.directory, self.recorder.table());
        time_series(trajectory)?.write(directory, "time_series")?;
        let body = scene.body(self.droplet)?;
        let frame = Frame::of_motion(last.observables.centroid, last.observables.velocity)?;
        let profile = concentration_profile(body.markers(), body.particle_numbers(), &frame)?;
        concentration_plot(&self.start, &profile, self.cost.time, self.swimmer.mean_concentration)
            .write(directory, "concentration_profile")?;
        let tracks = [self.recorder.track()];
        let seen = Snapshot::take(scene.system_mut(), self.swimmer.spacing)?;
        film.look().write_picture(&seen, &tracks, directory.join("final.png"))?;
        Ok(film.write(&tracks, directory.join("swim.gif"))?)
    }

    fn records(&self) -> &[TrajectoryRecord] {
        self.recorder.records().records()
    }
}

/// The parameters of a swimmer as they stand above a picture.
#[must_use]
pub fn caption(swimmer: &Swimmer) -> String {
    let Swimmer { activity, excluded_volume, viscosity, .. } = swimmer;
    let viscosities = match swimmer.viscosity_inside {
        Some(inside) => format!("η = {inside} in {viscosity}"),
        None => format!("η = {viscosity}"),
    };
    format!("ζΔμ = {activity},  A = {excluded_volume},  {viscosities}").replace('-', "−")
}
