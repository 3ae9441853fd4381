//! Runs of droplets in three dimensions without symmetry.

use anyhow::{Context, Result};
use motile::base::{Region, internal::decimals};
use motile::scene::{Every, Handle, Scene, SceneError};
use motile::setup::{AnyFlow, Particles, Setup};
use motile::space_droplets::{SpaceBody, SpaceDroplet};
use motile_output::{CsvTable, Look, SpaceAnimation, SpaceCsv, SpaceParaView, SpaceSnapshot};

use super::job::{Job, Watch};
use super::scene_run::{View, caption};
use super::{OutputFlags, Steadiness, Summary, say};

/// Files for ParaView in a run.
const FILES: f64 = 20.0;
/// Time between the frames of the animation (over [`Setup::time_scale`]), and the smallest and largest number of
/// frames.
const FRAME_INTERVAL: f64 = 1.2;
const FRAMES: [f64; 2] = [50.0, 100.0];
/// Points of the flow in the picture, in each direction.
const CELLS: usize = 72;

/// Run of a scene of droplets in three dimensions without symmetry. The first droplet is in `trajectory.csv`; if there
/// are several, all are in `droplets.csv`. Unless pictures are not wanted, there are the surfaces for ParaView
/// (`vtk/surface.pvd`), a picture of the end (`final.png`) and an animation (`swim.gif`).
#[derive(Debug)]
pub struct SpaceRun {
    scene: Scene<AnyFlow>,
    body: Handle<SpaceBody>,
    job: Job,
    particles: Option<Particles>,
    radius: f64,
    degree: usize,
    trajectory: SpaceCsv,
    droplets: Option<SpaceCsv>,
    pictures: Option<(Look, SpaceAnimation, SpaceParaView)>,
    /// Time between frames of the animation, before their number is bounded.
    frame_interval: f64,
}

impl SpaceRun {
    /// Creates a run to the time `end` of the scene that was built from `setup`, whose droplets are `body`. Its results
    /// go to the directory in `output`, by default to `out/<name>/`.
    ///
    /// # Errors
    /// Returns the errors of [`Job::new`]; a state that cannot be measured; files that cannot be written.
    pub fn new(
        mut scene: Scene<AnyFlow>,
        body: Handle<SpaceBody>,
        setup: &Setup,
        end: f64,
        output: &OutputFlags,
        name: &str,
    ) -> Result<Self> {
        let job = Job::new(&mut scene, setup, end, output, name)?;
        let path = |file: &str| job.directory.join(file);
        let trajectory = SpaceCsv::create(path("trajectory.csv"), scene.system_mut(), body, Some(0))?;
        let several = setup.droplets.len() > 1;
        let droplets =
            several.then(|| SpaceCsv::create(path("droplets.csv"), scene.system_mut(), body, None)).transpose()?;
        let pictures = job.draws().then(|| -> Result<_> {
            // Another unit would be wrong for droplets of another mean concentration.
            let mut means = setup.droplets.iter().filter_map(|droplet| Some(droplet.particles?.concentration));
            let concentration = means.next().filter(|first| means.all(|other| other == *first));
            let region = match setup.region {
                Region::Space => String::new(),
                _ => View::of(setup).region,
            };
            let look = job.look(Look { caption: caption(setup, &region), concentration, ..Look::of(setup) });
            let film = SpaceAnimation::new(look.clone(), body);
            Ok((look, film, SpaceParaView::create(path("vtk"), body)?))
        });
        let pictures = pictures.transpose()?;
        let frame_interval = FRAME_INTERVAL * setup.time_scale();
        let degree = scene.body(body)?.droplets().droplets().first().map_or(0, SpaceDroplet::degree);
        let particles = setup.droplets.first().and_then(|droplet| droplet.particles);
        let radius = setup.length_scale();
        Ok(Self { scene, body, job, particles, radius, degree, trajectory, droplets, pictures, frame_interval })
    }

    /// Runs to the end. The last state is recorded even if the run fails.
    ///
    /// # Errors
    /// Returns an error for files that cannot be written. The failure of the run itself is returned by
    /// [`SpaceRun::finish`].
    pub fn go(&mut self) -> Result<()> {
        let row = self.job.each_row();
        let mut observers: Vec<Watch<'_>> = vec![(row, &mut self.trajectory)];
        if let Some(table) = &mut self.droplets {
            observers.push((row, table));
        }
        if let Some((_, film, files)) = &mut self.pictures {
            let frames = (self.job.end / self.frame_interval).clamp(FRAMES[0], FRAMES[1]);
            observers.push((Every::StepAfter(self.job.end / frames), film));
            observers.push((self.job.each(FILES), files));
        }
        self.job.go(&mut self.scene, observers)
    }

    /// Returns the results of the run: the final state of the first droplet, and of the others by their names, the
    /// changes since the start, and the cost.
    ///
    /// # Errors
    /// Returns an error for a state that cannot be measured.
    pub fn summary(&mut self) -> Result<Summary> {
        let mut summary = Summary::default();
        let table = self.trajectory.table();
        let value =
            |name: &str| -> Result<f64> { Ok(table.curve("time", name)?.last().context("nothing was measured")?.1) };
        for (name, about) in [
            ("speed", "of the centroid (length per time)"),
            ("heading_x", "direction of motion"),
            ("heading_y", "direction of motion"),
            ("heading_z", "direction of motion"),
            ("x", "of the centroid, at the end (length)"),
            ("y", "of the centroid, at the end (length)"),
            ("z", "of the centroid, at the end (length)"),
            ("deformation", "D = (L - B)/(L + B) by the second moments of the volume"),
            ("stresslet", "along the motion; below 0 a puller"),
            ("area", "(length squared)"),
        ] {
            summary.put(name, value(name)?, about);
        }
        if let Some(particles) = self.particles {
            for name in ["concentration_max", "concentration_min"] {
                summary.put(name, value(name)? / particles.concentration, "in c0");
            }
        }
        for (name, column) in [("volume_relative_change", "volume"), ("particle_relative_change", "particle_number")] {
            // The start of a run that was resumed is in its table alone.
            summary.put(name, change(table, column)?, "since the start");
        }
        let speeds = table.curve("time", "speed")?;
        let diffusion = self.particles.map_or(0.0, |particles| particles.diffusion);
        let steady = Steadiness::of(&speeds, diffusion, self.radius);
        summary.put("steady", steady.json(), steady.criterion());
        summary.put("tail_shape", value("tail_shape")?, "of the highest degrees: above 1e-2, use a higher degree");
        summary.put("tail_particles", value("tail_particles")?, "of the highest degrees: above 3e-2, likewise");
        let gaps = self.droplets.as_ref().unwrap_or(&self.trajectory).table().curve("time", "gap")?;
        let least = gaps.into_iter().map(|(_, gap)| gap).fold(f64::NAN, f64::min);
        if !least.is_nan() {
            summary.put("minimum_gap", least, "between droplets and to walls, over the run (length)");
        }
        if self.droplets.is_some() {
            let seen = self.scene.observe(self.body)?;
            let body = self.scene.body(self.body)?;
            for (name, seen) in body.names().iter().zip(seen).skip(1) {
                let name = name.replace(' ', "_");
                for (axis, place) in ["x", "y", "z"].into_iter().zip(seen.position) {
                    summary.put(&format!("{name}_{axis}"), place, "of its centroid, at the end (length)");
                }
                summary.put(&format!("{name}_speed"), seen.speed, "of its centroid, at the end (length per time)");
            }
        }
        self.job.put_cost(&mut summary, &self.scene);
        summary.put("method", "harmonics", "for the flow");
        summary.put("degree", self.degree, "of the spherical harmonics");
        Ok(summary)
    }

    /// Returns the outcome of the run, without summary and pictures.
    ///
    /// # Errors
    /// Returns an error for the failure of the run.
    pub fn outcome(self) -> Result<(), SceneError> {
        self.job.outcome()
    }

    /// Writes and prints the results; draws the final state (`final.png`) and the run (`swim.gif`), unless pictures are
    /// not wanted.
    ///
    /// # Errors
    /// Returns an error for the failure of the run; files that cannot be written.
    pub fn finish(self, summary: &Summary) -> Result<()> {
        let Self { mut scene, body, job, trajectory, droplets, pictures, .. } = self;
        let directory = job.directory.clone();
        job.finish(summary, || {
            let Some((look, film, _)) = pictures else { return Ok(()) };
            let seen = SpaceSnapshot::take(scene.system_mut(), body, CELLS)?;
            let tracks = tracks(droplets.as_ref().unwrap_or(&trajectory), droplets.is_some())?;
            look.write_space_picture(&seen, &tracks, directory.join("final.png"))?;
            film.write(directory.join("swim.gif"))?;
            if let Some(begins) = film.begins().filter(|begins| *begins > 0.0) {
                say(format_args!("swim.gif begins at t = {}, where the run was resumed", decimals(4, begins)));
            }
            Ok(())
        })
    }
}

/// Returns the paths of the centroids in a table, of one droplet or of all.
fn tracks(table: &SpaceCsv, of_all: bool) -> Result<Vec<Vec<[f64; 3]>>> {
    let column = |name: &str| table.table().curve("time", name);
    let ([x, y, z], mut tracks) = ([column("x")?, column("y")?, column("z")?], Vec::new());
    let numbers = if of_all { column("droplet")? } else { x.iter().map(|(time, _)| (*time, 0.0)).collect() };
    for (k, (_, number)) in numbers.into_iter().enumerate() {
        let number = number as usize;
        if tracks.len() <= number {
            tracks.resize(number + 1, Vec::new());
        }
        tracks[number].push([x[k].1, y[k].1, z[k].1]);
    }
    Ok(tracks)
}

/// Returns the change of a column from its first to its last row, over the first.
fn change(table: &CsvTable, column: &str) -> Result<f64> {
    let rows = table.curve("time", column)?;
    let [first, .., last] = rows.as_slice() else { return Ok(0.0) };
    Ok(if first.1 == 0.0 { 0.0 } else { last.1 / first.1 - 1.0 })
}
