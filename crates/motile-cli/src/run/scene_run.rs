//! Runs of any scene, all of whose bodies are recorded.

mod results;
mod view;

use std::collections::HashSet;

use anyhow::{Context, Result};
use motile::active_interface::observables::{ConcentrationProfile, Frame, PeriodicObservables, concentration_profile};
use motile::active_interface::{ActiveDroplet, ActiveInterface};
use motile::analysis::trajectory::TrajectoryRecord;
use motile::base::{Region, Vec2, internal::decimals};
use motile::scene::{Body, Every, Handle, Observer, Scene, SceneError, gap::SolidGap};
use motile::setup::{AnyFlow, Built, MethodKind, Numbers, Particles, Setup};

use super::{flags::OutputFlags, job::Job, job::Watch, summary::Summary, words::say};
use motile_output::plot::{concentration_plot, time_series};
use motile_output::{
    Animation, BodiesCsv, CsvTable, DropletsCsv, FlowCsv, ForcesCsv, InterfacesCsv, Look, ParaView, Raster, Snapshot,
    SolidColour, Track, TrajectoryCsv, WallShearCsv,
};
pub use view::View;
pub(super) use view::caption;
use view::view_of;

/// Files for ParaView in a run.
const FILES: f64 = 20.0;
/// Time between the frames of the animation (over [`Setup::time_scale`]), and the smallest and largest number of
/// frames.
const FRAME_INTERVAL: f64 = 1.2;
const FRAMES: [f64; 2] = [50.0, 150.0];
/// Spacing of the fields in animations and files over the picture's if there is no grid, because each point then costs
/// a sum over the interfaces.
const COARSER: f64 = 2.0;
/// Places on each wall in a table of its shear stress.
const WALL_PLACES: usize = 128;
/// Depth to which a droplet may enter an elastic solid before its run ends with an error (grid spacings).
const SOLID_OVERLAP: f64 = 0.25;
/// Distance of streamlines around droplets (radii).
const STREAMLINES: f64 = 0.24;

/// A body with its name in results, and what was seen of it at the start.
type Recorded<B, O> = (String, Handle<B>, O);

/// The first droplet of a scene, if it has particles: what is known of it at the start, and its trajectory.
#[derive(Debug)]
struct First {
    droplet: Handle<ActiveDroplet>,
    particles: Particles,
    /// Dimensionless numbers of the droplet.
    numbers: Option<Numbers>,
    /// Radius of the droplet (length).
    radius: f64,
    start: ConcentrationProfile,
    recorder: TrajectoryCsv,
}

/// Tables of the bodies that a scene has, and of its flow.
#[derive(Debug)]
struct Tables {
    droplets: Option<DropletsCsv>,
    interfaces: Option<InterfacesCsv>,
    bodies: Option<BodiesCsv>,
    flow: Option<FlowCsv>,
    forces: Option<ForcesCsv>,
    wall_shear: Option<WallShearCsv>,
}

/// Run of any scene, with records of all of its bodies: `droplets.csv`, `interfaces.csv`, `bodies.csv` (rigid bodies,
/// shells, fibres, solids, gels). If the first droplet has particles, its observables are in `trajectory.csv` (and in
/// `droplets.csv` only if there are several), with plots over time. If it has none, or if a flow is imposed, there is
/// `flow.csv`. If a rigid body is held or moved, its forces are in `bodies.csv`, the forces along the channel in
/// `forces.csv`, and the shear stress on straight walls in `wall_shear.csv`. Unless pictures are not wanted, there are
/// files for ParaView, a picture of the end (`final.png`) and an animation (`swim.gif`).
#[derive(Debug)]
pub struct SceneRun {
    /// Scene in its present state.
    pub scene: Scene<AnyFlow>,
    job: Job,
    region: Region,
    method: MethodKind,
    /// Raster of the picture.
    raster: Raster,
    /// Time between frames of the animation, before their number is bounded.
    frame_interval: f64,
    first: Option<First>,
    /// Droplets with their areas at the start (length squared, or volumes).
    droplets: Vec<Recorded<ActiveDroplet, f64>>,
    interfaces: Vec<Recorded<ActiveInterface, PeriodicObservables>>,
    /// Names of all other bodies, with the numbers of their handles.
    bodies: Vec<(String, usize)>,
    /// Droplets and solids that a weight or a force pulls at.
    pulled: Vec<(String, Handle<dyn Body>)>,
    tables: Tables,
    pictures: Option<(Look, Animation, ParaView)>,
    gap: SolidGap,
}

impl SceneRun {
    /// Creates a run to the time `end` of the scene that was built from `setup`. Its results go to the directory in
    /// `output`, by default to `out/<name>/`.
    ///
    /// # Errors
    /// Returns the errors of [`Job::new`]; a state that cannot be measured; files that cannot be written.
    pub fn new(built: Built, setup: &Setup, end: f64, output: &OutputFlags, name: &str, view: &View) -> Result<Self> {
        let Built { mut scene, droplets: all_droplets, solids, interfaces: all_interfaces, .. } = built;
        let (described, setup) = (setup, &setup.placed()?);
        let mut taken = HashSet::new();
        let mut key = |name: &str| {
            let name = name.replace(' ', "_");
            let numbered = (2..).map(|number| format!("{name}_{number}"));
            std::iter::once(name.clone()).chain(numbered).find(|key| taken.insert(key.clone())).unwrap_or(name)
        };
        // At the start, also of a run that goes on from a checkpoint.
        let first = all_droplets
            .first()
            .zip(setup.droplets.first())
            .and_then(|(&handle, droplet)| Some((handle, droplet, droplet.particles?)));
        let first = first.map(|(handle, droplet, particles)| -> Result<_> {
            let (body, frame) = (scene.body(handle)?, Frame::new(Vec2::from(droplet.centre), droplet.angle)?);
            let start = concentration_profile(body.markers(), body.particle_numbers(), &frame)?;
            Ok((handle, particles, setup.numbers(droplet)?, start))
        });
        let first = first.transpose()?;
        let only = first.is_some() && all_droplets.len() == 1;
        let of_droplets = all_droplets.iter().zip(&setup.droplets).filter(|_| !only);
        let droplets = of_droplets
            .map(|(&handle, droplet)| {
                Ok((key(&droplet.name), handle, results::area(&mut scene, setup.region, handle)?))
            })
            .collect::<Result<Vec<_>>>()?;
        let of_interfaces = all_interfaces.iter().zip(&setup.interfaces);
        let interfaces = of_interfaces
            .map(|(&handle, interface)| Ok((key(&interface.name), handle, scene.observe(handle)?)))
            .collect::<Result<Vec<_>>>()?;
        let mut known: HashSet<usize> = all_droplets.iter().map(Handle::index).collect();
        known.extend(all_interfaces.iter().map(Handle::index));
        let others = scene.system().all_bodies().filter(|(handle, _)| !known.contains(&handle.index()));
        let bodies: Vec<(String, usize)> = others.map(|(handle, body)| (key(body.name()), handle.index())).collect();
        let pulls = |forces: [[f64; 2]; 2]| forces != [[0.0; 2]; 2];
        let pulled_droplets = (all_droplets.iter().zip(&setup.droplets))
            .filter(|(_, droplet)| pulls([droplet.body_force, droplet.force]))
            .map(|(&handle, droplet)| {
                let known = droplets.iter().find(|(_, other, _)| *other == handle).map(|(name, ..)| name.clone());
                (known.unwrap_or_else(|| droplet.name.replace(' ', "_")), handle.into())
            });
        let pulled_solids = (solids.iter().zip(&setup.solids))
            .filter(|(_, solid)| pulls([solid.body_force, solid.force]))
            .filter_map(|(&handle, _)| {
                let (name, _) = bodies.iter().find(|(_, index)| *index == handle.index())?;
                Some((name.clone(), handle.into()))
            });
        let pulled = pulled_droplets.chain(pulled_solids).collect();

        let job = Job::new(&mut scene, described, end, output, name)?;
        let radius = setup.length_scale();
        let system = scene.system_mut();
        let path = |file: &str| job.directory.join(file);
        let first = first.map(|(droplet, particles, numbers, start)| -> Result<_> {
            let recorder = TrajectoryCsv::create(path("trajectory.csv"), system, droplet)?;
            Ok(First { droplet, particles, numbers, radius, start, recorder })
        });
        let first = first.transpose()?;
        let system = scene.system_mut();
        let (has_bodies, has_flow) = (BodiesCsv::has_bodies(system), first.is_none() || !setup.flow.is_none());
        let holds = ForcesCsv::has_held_bodies(system);
        let has_walls = holds && system.channel_forces()?.is_some();
        let tables = Tables {
            droplets: (!droplets.is_empty()).then(|| DropletsCsv::create(path("droplets.csv"), system)).transpose()?,
            interfaces: (!interfaces.is_empty())
                .then(|| InterfacesCsv::create(path("interfaces.csv"), system))
                .transpose()?,
            bodies: has_bodies.then(|| BodiesCsv::create(path("bodies.csv"), system)).transpose()?,
            // In a box a row costs as much as several steps, and a trajectory has the gradient and the gap.
            flow: has_flow.then(|| FlowCsv::create(path("flow.csv"), system)).transpose()?,
            forces: holds.then(|| ForcesCsv::create(path("forces.csv"), system)).transpose()?,
            wall_shear: has_walls
                .then(|| WallShearCsv::create(path("wall_shear.csv"), system, WALL_PLACES))
                .transpose()?,
        };

        let centre = Vec2::from(setup.droplets.first().map_or([0.0; 2], |droplet| droplet.centre));
        let raster = |spacing: f64| view_of(setup.region, &scene, centre, spacing, radius);
        let (method, spacing) = (setup.method.kind(), output.look.picture_spacing.unwrap_or(view.spacing));
        let coarse = raster(if method == MethodKind::Integral { COARSER * spacing } else { spacing })?;
        let still = raster(spacing)?;
        let pictures = job.draws().then(|| -> Result<_> {
            // Another unit would be wrong for bodies of another mean concentration.
            let of_droplets = setup.droplets.iter().filter_map(|droplet| droplet.particles);
            let means = of_droplets.chain(setup.interfaces.iter().filter_map(|interface| interface.particles));
            let mut means = means.map(|particles| particles.concentration);
            let concentration = means.next().filter(|first| means.all(|other| other == *first));
            let internal = setup.solids.iter().any(|s| !s.relaxation.is_empty() || s.active_springs.is_some());
            let solids = if internal { SolidColour::InternalStress } else { SolidColour::Stress };
            let streamline_spacing = setup.droplets.first().map(|_| STREAMLINES * radius);
            let caption = caption(setup, &view.region);
            let look = job.look(Look { caption, concentration, streamline_spacing, solids, ..Look::of(setup) });
            let files = ParaView::create(path("vtk"), coarse)?;
            Ok((look.clone(), Animation::new(look, coarse), files))
        });
        let pictures = pictures.transpose()?;
        Ok(Self {
            scene,
            job,
            region: setup.region,
            method,
            raster: still,
            frame_interval: FRAME_INTERVAL * setup.time_scale(),
            first,
            droplets,
            interfaces,
            bodies,
            pulled,
            tables,
            pictures,
            gap: SolidGap::new(SOLID_OVERLAP * setup.method.spacing().unwrap_or(view.spacing)),
        })
    }

    /// Runs to the end, or until the observer `end`, called at every step, returns the error [`super::Decided`]. The
    /// last state is recorded even if the run fails.
    ///
    /// # Errors
    /// Returns an error for files that cannot be written. The failure of the run itself is returned by
    /// [`SceneRun::finish`].
    pub fn go(&mut self, end: Option<&mut dyn Observer<AnyFlow>>) -> Result<()> {
        let (time, row) = (self.job.end, self.job.each_row());
        let mut observers: Vec<Watch<'_>> = Vec::new();
        if let Some(first) = &mut self.first {
            observers.push((row, &mut first.recorder));
        }
        observers.push((Every::Steps(1), &mut self.gap));
        if let Some(table) = &mut self.tables.flow {
            observers.push((row, table));
        }
        if let Some(table) = &mut self.tables.droplets {
            observers.push((row, table));
        }
        if let Some(table) = &mut self.tables.interfaces {
            observers.push((row, table));
        }
        if let Some(table) = &mut self.tables.bodies {
            observers.push((row, table));
        }
        if let Some(table) = &mut self.tables.forces {
            observers.push((row, table));
        }
        if let Some(table) = &mut self.tables.wall_shear {
            observers.push((self.job.each(FILES), table));
        }
        if let Some(end) = end {
            observers.push((Every::Steps(1), end));
        }
        if let Some((_, film, files)) = &mut self.pictures {
            let frames = (time / self.frame_interval).clamp(FRAMES[0], FRAMES[1]);
            observers.push((Every::StepAfter(time / frames), film));
            observers.push((self.job.each(FILES), files));
        }
        self.job.go(&mut self.scene, observers)?;
        match &mut self.first {
            // The rows of a run that was stopped are to be those of a run that was not.
            Some(first) if !self.job.is_stopped() => Ok(first.recorder.finish(self.scene.system_mut())?),
            _ => Ok(()),
        }
    }

    /// Returns the outcome of the run, without summary and pictures.
    ///
    /// # Errors
    /// Returns an error for the failure of the run.
    pub fn outcome(self) -> Result<(), SceneError> {
        self.job.outcome()
    }

    /// Returns the observables of all droplets over time. It is `None` for a scene without droplets, or with a single
    /// one that has particles ([`SceneRun::table`]).
    #[must_use]
    pub fn droplets(&self) -> Option<&DropletsCsv> {
        self.tables.droplets.as_ref()
    }

    /// Returns the times and centroids of the first droplet (length), as [`TrajectoryCsv::track`].
    ///
    /// # Errors
    /// Returns an error for a first droplet without particles.
    pub fn track(&self) -> Result<Track> {
        Ok(self.first()?.recorder.track())
    }

    /// Returns the observables of the first droplet in the order of time, also from before the checkpoint from which
    /// the run continues.
    ///
    /// # Errors
    /// Returns an error for a first droplet without particles.
    pub fn table(&self) -> Result<&CsvTable> {
        Ok(self.first()?.recorder.table())
    }

    /// Returns the number of particles of the first droplet at the start, on the interface and inside (no dimension).
    ///
    /// # Errors
    /// Returns an error for a first droplet without particles; a run that has not begun.
    pub fn totals(&self) -> Result<f64> {
        let table = self.table()?;
        let first =
            |column| -> Result<f64> { Ok(table.curve("time", column)?.first().context("nothing was measured")?.1) };
        Ok(first("particle_number")? + first("number_inside").unwrap_or(0.0))
    }

    /// Returns the last measurement of the first droplet.
    ///
    /// # Errors
    /// Returns an error for a first droplet without particles; a run that has not begun.
    pub fn last(&self) -> Result<&TrajectoryRecord> {
        self.first()?.recorder.last().context("nothing was measured")
    }

    fn first(&self) -> Result<&First> {
        self.first.as_ref().context("the first droplet of the scene has no particles")
    }

    /// Writes and prints the results; draws the final state (`final.png`), the run (`swim.gif`) and the plots of the
    /// first droplet, unless pictures are not wanted.
    ///
    /// # Errors
    /// Returns an error for the failure of the run; files that cannot be written.
    pub fn finish(self, summary: &Summary) -> Result<()> {
        let Self { mut scene, job, raster, first, pictures, .. } = self;
        let directory = job.directory.clone();
        job.finish(summary, || {
            let Some((look, film, _)) = pictures else { return Ok(()) };
            let mut tracks = Vec::new();
            if let Some(First { droplet, particles, start, recorder, .. }) = &first {
                let Some(last) = recorder.last() else { return Ok(()) };
                time_series(recorder.table())?.write(&directory, "time_series")?;
                let body = scene.body(*droplet)?;
                let frame = last.observables.frame();
                let profile = concentration_profile(body.markers(), body.particle_numbers(), &frame)?;
                concentration_plot(start, &profile, scene.time(), particles.concentration)
                    .of_origin(scene.system().origin())
                    .write(&directory, "concentration_profile")?;
                tracks.push(recorder.track());
            }
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

#[cfg(test)]
mod tests;
