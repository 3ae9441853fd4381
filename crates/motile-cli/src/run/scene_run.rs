//! Runs of any scene, all of whose droplets and interfaces are recorded.

use std::collections::HashSet;

use anyhow::Result;
use motile::active_interface::observables::PeriodicObservables;
use motile::active_interface::{ActiveDroplet, ActiveInterface};
use motile::base::{Region, Vec2};
use motile::scene::{Handle, Scene};
use motile::setup::{AnyFlow, Built, Setup};

use super::{flags::OutputFlags, job::Job, job::Watch, summary::Summary};
use motile_output::{BodiesCsv, DropletsCsv, FlowCsv, InterfacesCsv, Look, ParaView, Raster, Snapshot};

/// Files for ParaView in a run.
const FILES: f64 = 20.0;
/// Most cells in a direction of the fields in pictures and files.
const MOST_CELLS: usize = 512;
/// Spacing of the fields in files over that of the picture: without a grid each point costs a sum over the interfaces.
const COARSER: f64 = 2.0;
/// Side of the square that pictures show of unbounded fluid (length scales of the scene).
const VIEW: f64 = 12.0;

/// A body with its name in results, and what was seen of it at the start.
type Recorded<B, O> = (String, Handle<B>, O);

/// Run of any scene. Its droplets, its interfaces across the period, its other bodies and its flow are recorded
/// (`droplets.csv`, `interfaces.csv`, `bodies.csv`, `flow.csv`), with files for ParaView and a picture of the end
/// (`final.png`) unless pictures are not wanted.
#[derive(Debug)]
pub struct SceneRun {
    /// Scene in its present state.
    pub scene: Scene<AnyFlow>,
    job: Job,
    region: Region,
    /// Spacing of the fields in the picture, and the length scale of the scene (length).
    spacing: f64,
    scale: f64,
    /// Droplets with their areas at the start (length squared, or volumes).
    droplets: Vec<Recorded<ActiveDroplet, f64>>,
    interfaces: Vec<Recorded<ActiveInterface, PeriodicObservables>>,
    of_droplets: Option<DropletsCsv>,
    of_interfaces: Option<InterfacesCsv>,
    of_bodies: Option<BodiesCsv>,
    of_flow: FlowCsv,
    files: Option<ParaView>,
}

impl SceneRun {
    /// Run to the time `end` of the scene that was built from `setup`, with fields of that spacing (length) in its
    /// pictures. Its results go to the directory in `output`, by default to `out/<name>/`.
    ///
    /// # Errors
    /// Those of [`Job::new`]; a state that cannot be measured; files that cannot be written.
    pub fn new(built: Built, setup: &Setup, end: f64, output: &OutputFlags, name: &str, spacing: f64) -> Result<Self> {
        let Built { mut scene, droplets, interfaces, .. } = built;
        let (described, setup) = (setup, &setup.placed()?);
        let mut taken = HashSet::new();
        let mut key = |name: &str| {
            let name = name.replace(' ', "_");
            let numbered = (2..).map(|number| format!("{name}_{number}"));
            std::iter::once(name.clone()).chain(numbered).find(|key| taken.insert(key.clone())).unwrap_or(name)
        };
        // At the start, also of a run that goes on from a checkpoint.
        let of_droplets = droplets.iter().zip(&setup.droplets);
        let droplets = of_droplets
            .map(|(&handle, droplet)| Ok((key(&droplet.name), handle, area(&mut scene, setup.region, handle)?)))
            .collect::<Result<Vec<_>>>()?;
        let of_interfaces = interfaces.iter().zip(&setup.interfaces);
        let interfaces = of_interfaces
            .map(|(&handle, interface)| Ok((key(&interface.name), handle, scene.observe(handle)?)))
            .collect::<Result<Vec<_>>>()?;

        let job = Job::new(&mut scene, described, end, output, name)?;
        let system = scene.system_mut();
        let path = |file: &str| job.directory.join(file);
        let some = (!droplets.is_empty(), !interfaces.is_empty(), BodiesCsv::has_bodies(system));
        let of_droplets = some.0.then(|| DropletsCsv::create(path("droplets.csv"), system)).transpose()?;
        let of_interfaces = some.1.then(|| InterfacesCsv::create(path("interfaces.csv"), system)).transpose()?;
        let of_bodies = some.2.then(|| BodiesCsv::create(path("bodies.csv"), system)).transpose()?;
        let of_flow = FlowCsv::create(path("flow.csv"), system)?;
        let centre = middle(&scene, droplets.first().map(|(_, handle, _)| *handle))?;
        let scale = setup.length_scale();
        let raster = view(setup.region, &scene, centre, COARSER * spacing, scale)?;
        let files = job.draws().then(|| ParaView::create(path("vtk"), raster)).transpose()?;
        let region = setup.region;
        Ok(Self {
            scene,
            job,
            region,
            spacing,
            scale,
            droplets,
            interfaces,
            of_droplets,
            of_interfaces,
            of_bodies,
            of_flow,
            files,
        })
    }

    /// Runs to the end.
    ///
    /// # Errors
    /// Files that cannot be written. The failure of the run itself is returned by [`SceneRun::finish`].
    pub fn go(&mut self) -> Result<()> {
        let (row, file) = (self.job.each_row(), self.job.each(FILES));
        let mut observers: Vec<Watch<'_>> = vec![(row, &mut self.of_flow)];
        if let Some(table) = &mut self.of_droplets {
            observers.push((row, table));
        }
        if let Some(table) = &mut self.of_interfaces {
            observers.push((row, table));
        }
        if let Some(table) = &mut self.of_bodies {
            observers.push((row, table));
        }
        if let Some(files) = &mut self.files {
            observers.push((file, files));
        }
        self.job.go(&mut self.scene, observers)
    }

    /// Observables of all droplets over time; `None` where there are none.
    #[must_use]
    pub fn droplets(&self) -> Option<&DropletsCsv> {
        self.of_droplets.as_ref()
    }

    /// Results: the end state of each droplet and interface, the change since the start, the cost of the run.
    ///
    /// # Errors
    /// A state that cannot be measured.
    pub fn summary(&mut self) -> Result<Summary> {
        let (mut summary, scene) = (Summary::default(), &mut self.scene);
        for (name, handle, start) in &self.droplets {
            let seen = scene.observe(*handle)?;
            let mut put = |key: &str, value: f64, about: &str| summary.put(&format!("{name}_{key}"), value, about);
            put("x", seen.centroid.x, "of its centroid, in the end (length)");
            put("y", seen.centroid.y, "of its centroid, in the end (length)");
            put("speed", seen.speed(), "of its centroid relative to the imposed flow, in the end (length per time)");
            put("deformation", seen.shape.deformation(), "D = (L - B)/(L + B) by area moments");
            let angle = seen.shape.angle.map_or(f64::NAN, f64::to_degrees);
            put("angle", angle, "of the long axis by area moments (degrees)");
            put("area_relative_change", area(scene, self.region, *handle)? / start - 1.0, "since the start");
        }
        for (name, handle, start) in &self.interfaces {
            let seen = scene.observe(*handle)?;
            let mut put = |key: &str, value: f64, about: &str| summary.put(&format!("{name}_{key}"), value, about);
            put("height_change", seen.height - start.height, "of its mean height, since the start (length)");
            put("length", seen.length, "over a period (length)");
            put("height_mode", seen.height_modes.amplitude(1), "amplitude of the longest wave (length)");
            let Some([most, least]) = seen.concentration_range else { continue };
            put("particle_relative_change", seen.particle_number / start.particle_number - 1.0, "since the start");
            let mean = start.particle_number / start.length;
            put("concentration_max", most / mean, "in its mean at the start");
            put("concentration_min", least / mean, "in its mean at the start");
            put("concentration_mode", seen.concentration_modes.amplitude(1) / mean, "of the longest wave");
            put("flux", seen.flux, "of particles along x (1/time)");
        }
        summary.put(
            "minimum_gap",
            scene.system().minimum_gap(),
            "between interfaces and to walls, over the run (length)",
        );
        self.job.put_cost(&mut summary, &self.scene);
        Ok(summary)
    }

    /// Writes and prints the results and draws the final state as `look` says.
    ///
    /// # Errors
    /// The failure of the run; files that cannot be written.
    pub fn finish(self, summary: &Summary, look: &Look) -> Result<()> {
        let Self { mut scene, job, region, spacing, scale, droplets, files, .. } = self;
        let picture = job.directory.join("final.png");
        let shown = job.look(look.clone());
        job.finish(summary, || {
            if files.is_none() {
                return Ok(());
            }
            let centre = middle(&scene, droplets.first().map(|(_, handle, _)| *handle))?;
            let raster = view(region, &scene, centre, spacing, scale)?;
            let seen = Snapshot::take(scene.system_mut(), raster)?;
            Ok(shown.write_picture(&seen, &[], picture)?)
        })
    }
}

/// Area of the smooth curve through a droplet's markers (length squared), or its volume (length cubed).
fn area(scene: &mut Scene<AnyFlow>, region: Region, droplet: Handle<ActiveDroplet>) -> Result<f64> {
    if region.is_axisymmetric() {
        return Ok(scene.observe(droplet)?.area);
    }
    Ok(scene.system_mut().deformation(droplet)?.area)
}

/// The mean of a droplet's markers (length), or the origin.
fn middle(scene: &Scene<AnyFlow>, droplet: Option<Handle<ActiveDroplet>>) -> Result<Vec2> {
    let Some(handle) = droplet else { return Ok(Vec2::ZERO) };
    let markers = scene.body(handle)?.markers();
    Ok(markers.iter().sum::<Vec2>() / markers.len() as f64)
}

/// Raster of that spacing (length) over a region, or over the surroundings of a centre in unbounded fluid, for a scene
/// of that length scale (length).
pub(super) fn view(region: Region, scene: &Scene<AnyFlow>, centre: Vec2, spacing: f64, scale: f64) -> Result<Raster> {
    let ([x, y], view) = (centre.to_array(), VIEW * scale);
    Ok(match region {
        Region::Tube { radius, .. } => {
            let half = region.half_length().map_or(0.5 * view.max(4.0 * radius), |half| half);
            let [_, height] = region.lengths();
            let (middle, sides) = (if region.half_length().is_some() { 0.0 } else { x }, [2.0 * half, height]);
            let cells = sides.map(|side| ((side / spacing).round() as usize).clamp(1, MOST_CELLS));
            Raster::new([middle - half, -0.5 * height], sides, cells, [false; 2])?
        }
        Region::Plane | Region::Space => {
            let cells = (view / spacing).round() as usize;
            Raster::new([x - 0.5 * view, y - 0.5 * view], [view; 2], [cells.min(MOST_CELLS); 2], [false; 2])?
        }
        _ => Raster::of(scene.system(), spacing)?,
    })
}

#[cfg(test)]
mod tests;
