//! A run of a scene with a droplet, from the first check to the last file.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use motile::{
    active_interface::{
        ActiveDroplet,
        observables::{ConcentrationProfile, Frame, concentration_profile},
        trajectory::TrajectoryRecord,
    },
    ib_core::{
        Every, Handle, Hydrodynamics, Integrator, Observer, Scene, SceneError, StepSize, System, Vec2, gap::SolidGap,
    },
};

use motile::{DropletSetup, Exclusion, Method, Particles, Region, Setup};

use crate::{
    CheckpointFlags, Decided, MethodFlags, OutputFlags, RunCost, Steadiness, Summary, droplet_summary, put_solids,
};
use motile_output::{
    Film, Look, ParaView, Raster, RunProgress, Snapshot, TrajectoryCsv, concentration_plot, time_series,
};

/// Rows of the trajectory and files for ParaView in a run.
const ROWS: f64 = 1000.0;
const FILES: f64 = 20.0;
/// Time between frames of the animation, of which there are some number in this range.
const FRAME_INTERVAL: f64 = 1.2;
const FRAMES: [f64; 2] = [50.0, 150.0];
/// Most cells in a direction of the fields in pictures and files.
const MOST_CELLS: usize = 512;
/// Spacing of the fields over that of a grid where there is no grid: there each point costs a sum over the interface.
const COARSER: f64 = 2.0;
/// How deep a droplet may come into an elastic solid, in grid spacings, before its run ends with an error.
const SOLID_OVERLAP: f64 = 0.25;
/// Side of what is shown of unbounded fluid (R0).
const VIEW: f64 = 12.0;
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
    setup: Setup,
    particles: Particles,
    /// Area of the droplet at the start.
    area: f64,
    end: f64,
    directory: PathBuf,
    raster: Raster,
    start: ConcentrationProfile,
    recorder: TrajectoryCsv,
    progress: RunProgress,
    pictures: Option<(Look, Film, ParaView)>,
    cost: RunCost,
    gap: SolidGap,
    checkpoints: CheckpointFlags,
    description: String,
}

impl WatchedRun {
    /// A run of a scene that was made from `setup`, watching its first droplet. Its results go where `output` says, by
    /// default to `out/<name>/`; pictures bear the `caption`.
    ///
    /// # Errors
    /// A time step that is not stable, before anything is written; a directory that cannot be made.
    pub fn new<H: Hydrodynamics, I: Integrator>(
        scene: &mut Scene<H, I>,
        droplets: &[Handle<ActiveDroplet>],
        setup: &Setup,
        method: &MethodFlags,
        output: &OutputFlags,
        name: &str,
        caption: String,
    ) -> Result<Self> {
        let (end, spacing) = (method.time, method.spacing(setup));
        let (Some(&droplet), Some(DropletSetup { centre: [x, y], angle, particles: Some(particles), .. })) =
            (droplets.first(), setup.droplets.first())
        else {
            bail!("the first droplet of the scene is the one that is watched: give one with particles");
        };
        check_run(scene, end, setup.step)?;
        output.write_scene(setup)?;
        // The time step may change on the way.
        let description = format!("{name}: scene {}", setup.fingerprint());
        output.checkpoints.resume(scene, &description, end)?;
        let body = scene.body(droplet)?;
        let frame = Frame::new(Vec2::new(*x, *y), *angle)?;
        let start = concentration_profile(body.markers(), body.particle_numbers(), &frame)?;
        let raster = |spacing: f64| match setup.region {
            Region::Plane => {
                let cells = (VIEW / spacing).round() as usize;
                Raster::new([x - 0.5 * VIEW, y - 0.5 * VIEW], [VIEW; 2], [cells.min(MOST_CELLS); 2], [false; 2])
            }
            _ => Raster::of(scene.system(), spacing),
        };
        let still = raster(spacing)?;
        let watched = match setup.method {
            Method::Integral(_) => raster(COARSER * spacing)?,
            Method::Grid(_) => still,
        };

        let directory = output.directory(name)?;
        let mut recorder = TrajectoryCsv::create(directory.join("trajectory.csv"), scene.system_mut(), droplet)?;
        // Widths and gaps are those between the surfaces where walls stop the fluid.
        recorder.set_back(setup.set_back());
        let pictures = if output.no_pictures {
            None
        } else {
            let concentration = Some(particles.concentration);
            let look = Look { caption, concentration, streamline_spacing: Some(STREAMLINES) };
            Some((look.clone(), Film::new(look, watched), ParaView::create(directory.join("vtk"), watched)?))
        };
        Ok(Self {
            droplet,
            setup: setup.clone(),
            particles: *particles,
            area: scene.body(droplet)?.initial_area(),
            end,
            directory,
            raster: still,
            start,
            recorder,
            progress: RunProgress::new(end, output.quiet),
            pictures,
            cost: RunCost::default(),
            gap: SolidGap::new(SOLID_OVERLAP * spacing).with_set_back(setup.set_back()),
            checkpoints: output.checkpoints.clone(),
            description,
        })
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
            .step_size(self.setup.step)
            .observe(Every::StepAfter(self.end / ROWS), &mut self.recorder)
            .observe(Every::Steps(1), &mut self.gap)
            .observe(Every::Steps(1), end)
            .observe(Every::Steps(1), &mut self.progress);
        if let Some((_, film, vtk)) = &mut self.pictures {
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
        let steadiness = Steadiness::of(&speeds, self.particles.diffusion * std::f64::consts::PI / self.area);
        let mut summary = droplet_summary(
            &first.observables,
            &last.observables,
            &steadiness,
            &self.cost,
            self.particles.concentration,
        );
        let method = match self.setup.method {
            Method::Integral(_) => "boundary-integral",
            Method::Grid(_) => "immersed-boundary",
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
        let (Some((look, film, _)), Some(last)) = (&self.pictures, self.records().last()) else { return Ok(()) };
        let (directory, trajectory) = (&self.directory, self.recorder.table());
        time_series(trajectory)?.write(directory, "time_series")?;
        let body = scene.body(self.droplet)?;
        let frame = Frame::of_motion(last.observables.centroid, last.observables.velocity)?;
        let profile = concentration_profile(body.markers(), body.particle_numbers(), &frame)?;
        concentration_plot(&self.start, &profile, self.cost.time, self.particles.concentration)
            .write(directory, "concentration_profile")?;
        let tracks = [self.recorder.track()];
        let seen = Snapshot::take(scene.system_mut(), self.raster)?;
        look.write_picture(&seen, &tracks, directory.join("final.png"))?;
        Ok(film.write(&tracks, directory.join("swim.gif"))?)
    }

    fn records(&self) -> &[TrajectoryRecord] {
        self.recorder.records().records()
    }
}

/// The parameters of a scene's first droplet as they stand above a picture.
#[must_use]
pub fn caption(setup: &Setup) -> String {
    let droplet = setup.droplets.first();
    let viscosities = match droplet.and_then(|droplet| droplet.viscosity) {
        Some(inside) => format!("η = {inside} in {}", setup.viscosity),
        None => format!("η = {}", setup.viscosity),
    };
    let particles = match droplet.and_then(|droplet| droplet.particles) {
        Some(Particles { activity, excluded_volume: Exclusion::Step(strength), .. }) => {
            format!("ζΔμ = {activity},  A = {strength},  ")
        }
        Some(Particles { activity, .. }) => format!("ζΔμ = {activity},  "),
        None => String::new(),
    };
    format!("{particles}{viscosities}").replace('-', "−")
}

#[cfg(test)]
mod tests;
