//! Scenes: runs, state and output.

use std::collections::BTreeMap;
use std::error::Error;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard};
use std::time::Instant;

use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods as _, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use motile::active_interface::{ActiveDroplet, observables::InterfaceState};
use motile::base::{FlowSample, Region, Vec2};
use motile::elastic_solids::RigidBody;
use motile::scene::{
    Body, Every, Handle, Observer as _, SceneError, StepSize, System, Warnings, checkpoint::Checkpoint,
};
use motile::setup::{AnyFlow, Built, Setup as Description};
use motile::space_droplets::SpaceBody;
use motile_output::{
    DropletMeter, Look, ParaView, Raster, Snapshot, SolidColour, SpaceCsv, SpaceParaView, SpaceSnapshot,
};

use crate::error::{failed, of_setup, refused};
use crate::setup::Setup;
use crate::tension::TabulatedTension;
use crate::value::{described, from_python};
use crate::work::{BETWEEN_LOOKS, unless_interrupted};

/// Fluid shown around the bodies of a region without an end (length scales of the scene).
const MARGIN: f64 = 2.0;
/// Default spacing of the flow in pictures (length scales of the scene).
const SPACING: f64 = 0.1;
/// Default number of samples of the flow along a side of pictures in three dimensions, and the side (length scales).
const CELLS: usize = 72;
const VIEW: f64 = 7.0;

type AnyScene = motile::scene::Scene<AnyFlow>;

/// A scene and what has been recorded of it.
struct State {
    scene: AnyScene,
    droplets: Vec<Handle<ActiveDroplet>>,
    /// Droplets in three dimensions without symmetry.
    space: Option<Handle<SpaceBody>>,
    meters: Vec<DropletMeter>,
    /// Values of the droplets' meters, droplet after droplet, record after record.
    records: Vec<f64>,
    warnings: Warnings,
    /// Tension laws that droplets were given since they were made.
    laws: Vec<(usize, TabulatedTension)>,
}

/// Bodies in a fluid, with their state: what `Setup.build` makes.
#[pyclass(module = "motile._motile", frozen)]
pub(crate) struct Scene {
    state: Mutex<State>,
    description: Description,
    /// Length scale of the scene, and the name of its unit of length in pictures.
    scale: f64,
    unit: &'static str,
}

fn array_of<'py>(py: Python<'py>, points: &[Vec2]) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let flat: Vec<f64> = points.iter().flat_map(|point| point.to_array()).collect();
    PyArray1::from_vec(py, flat).reshape([points.len(), 2])
}

fn points_of(points: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<Vec2>> {
    let points = points.as_array();
    if points.ncols() != 2 {
        return Err(refused(
            &format!("points have shape ({}, {}). Use an array of shape (n, 2)", points.nrows(), points.ncols()),
            None,
            None,
            None,
        ));
    }
    Ok(points.rows().into_iter().map(|row| Vec2::new(row[0], row[1])).collect())
}

impl Scene {
    pub(crate) fn new(py: Python<'_>, description: &Description) -> PyResult<Self> {
        let own = description.clone();
        let made = unless_interrupted(py, None, move |_| {
            let placed = own.placed()?;
            Ok((placed.build()?, placed.length_scale(), placed.length_unit()))
        })?;
        py.detach(|| {
            let (built, scale, unit) = made.map_err(|error| of_setup(&error))?;
            let Built { mut scene, droplets, space, .. } = built;
            let meters = droplets.iter().map(|&droplet| DropletMeter::of(scene.system_mut(), droplet));
            let meters = meters.collect::<Result<_, _>>().map_err(failed)?;
            let (records, warnings, laws) = (Vec::new(), Warnings::default(), Vec::new());
            let state = State { scene, droplets, space, meters, records, warnings, laws };
            Ok(Self { state: Mutex::new(state), description: description.clone(), scale, unit })
        })
    }

    /// The state, unless a run is going on.
    fn lock(&self) -> PyResult<MutexGuard<'_, State>> {
        self.state.try_lock().map_err(|_| {
            let remedy = "Wait until the run has ended, or use one scene per thread";
            refused(&format!("the scene is in use by a run. {remedy}"), None, None, Some(remedy.to_owned()))
        })
    }

    fn droplet(state: &State, index: usize) -> PyResult<Handle<ActiveDroplet>> {
        let count = state.droplets.len();
        let missing = || failed(format!("there is no droplet {index}: the scene has {count}"));
        state.droplets.get(index).copied().ok_or_else(missing)
    }
}

impl State {
    fn set_tension(&mut self, index: usize, law: TabulatedTension) -> PyResult<()> {
        let droplet = Scene::droplet(self, index)?;
        self.scene.body_mut(droplet).map_err(failed)?.set_tension(law.clone());
        self.laws.retain(|(other, _)| *other != index);
        self.laws.push((index, law));
        Ok(())
    }

    fn advance(&mut self, until: f64, every: Option<f64>, step: Option<StepSize>, tick: &Py<PyAny>) -> PyResult<()> {
        let mut signal = None;
        let mut last = Instant::now();
        let mut look = |system: &mut System<AnyFlow>| -> Result<(), Box<dyn Error + Send + Sync>> {
            if last.elapsed() < BETWEEN_LOOKS {
                return Ok(());
            }
            last = Instant::now();
            let looked = Python::attach(|py| {
                py.check_signals()?;
                if tick.is_none(py) { Ok(()) } else { tick.call1(py, (system.time(),)).map(|_| ()) }
            });
            looked.map_err(|error| {
                signal = Some(error);
                "stopped from Python".into()
            })
        };
        let Self { scene, meters, records, warnings, space, .. } = self;
        let mut record = |system: &mut System<AnyFlow>| -> Result<(), Box<dyn Error + Send + Sync>> {
            warnings.look(system);
            for meter in &*meters {
                let record = meter.record(system)?;
                records.extend(meter.row(&record));
            }
            if let Some(body) = *space {
                records.extend(rows_in_space(system, body)?.into_iter().flatten());
            }
            Ok(())
        };
        let step = step.unwrap_or(scene.step_size());
        let run = scene.run(until).step_size(step).observe(Every::Steps(1), &mut look);
        let ended = match every {
            Some(every) => run.observe(Every::Time(every), &mut record).go(),
            None => run.observe(Every::Steps(1), &mut record).go(),
        };
        match (ended, signal) {
            (_, Some(error)) => Err(error),
            (Err(error), None) => Err(failed(error)),
            (Ok(()), None) => Ok(()),
        }
    }
}

/// Rows of the table of all droplets in three dimensions.
fn rows_in_space(
    system: &mut System<AnyFlow>,
    body: Handle<SpaceBody>,
) -> Result<Vec<Vec<f64>>, Box<dyn Error + Send + Sync>> {
    let (time, seen) = (system.time(), system.observe(body)?);
    let droplets = system.body(body)?.droplets();
    let row = |(number, seen)| Ok(SpaceCsv::row(time, seen, droplets.smallest_gap(number)?));
    seen.iter().enumerate().map(row).collect()
}

impl State {
    /// Droplets in three dimensions, for what only they have.
    fn in_space(&self, index: usize) -> PyResult<Handle<SpaceBody>> {
        let body = self.space.ok_or_else(|| failed("the scene is two-dimensional or axisymmetric"))?;
        let count = self.count();
        if index < count {
            Ok(body)
        } else {
            Err(failed(format!("there is no droplet {index}: the scene has {count}")))
        }
    }

    /// Number of droplets.
    fn count(&self) -> usize {
        let in_space = self.space.and_then(|body| self.scene.body(body).ok()).map(|body| body.names().len());
        in_space.unwrap_or(self.droplets.len())
    }

    /// Names of the values of a record.
    fn names(&self) -> Vec<&'static str> {
        match (self.space, self.meters.first()) {
            (Some(_), _) => SpaceCsv::columns(true),
            (None, Some(meter)) => meter.names().to_vec(),
            (None, None) => vec!["time"],
        }
    }
}

/// Points in three dimensions as an array of shape (n, 3).
fn array_in_space<'py>(py: Python<'py>, points: &[[f64; 3]]) -> PyResult<Bound<'py, PyArray2<f64>>> {
    PyArray1::from_slice(py, points.as_flattened()).reshape([points.len(), 3])
}

#[pymethods]
impl Scene {
    /// Advances the scene to a time and records all droplets every so often; `tick` is called with the time now and
    /// then.
    #[pyo3(signature = (until, every=None, step=None, tick=None))]
    fn advance(
        &self,
        py: Python<'_>,
        until: f64,
        every: Option<f64>,
        step: Option<&Bound<'_, PyAny>>,
        tick: Option<Py<PyAny>>,
    ) -> PyResult<()> {
        let step = match step.map(|step| from_python(step, "step")).transpose()?.flatten() {
            Some(value) => Some(described(value)?),
            None => None,
        };
        let tick = tick.unwrap_or_else(|| py.None());
        py.detach(|| self.lock()?.advance(until, every, step, &tick))
    }

    /// Names of what is recorded of a droplet, the time first.
    #[getter]
    fn names(&self) -> PyResult<Vec<&'static str>> {
        Ok(self.lock()?.names())
    }

    /// All records: an array of records by droplets by names.
    fn records<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let state = self.lock()?;
        let (names, droplets) = (state.names().len(), state.count());
        let count = state.records.len() / (names * droplets).max(1);
        PyArray1::from_slice(py, &state.records).reshape([count, droplets, names])
    }

    /// Time of the present state.
    #[getter]
    fn time(&self) -> PyResult<f64> {
        Ok(self.lock()?.scene.time())
    }

    /// Number of steps up to the present state.
    #[getter]
    fn steps(&self) -> PyResult<usize> {
        Ok(self.lock()?.scene.steps())
    }

    /// Number of droplets.
    #[getter]
    fn droplet_count(&self) -> PyResult<usize> {
        Ok(self.lock()?.count())
    }

    /// True for droplets in three dimensions without symmetry.
    #[getter]
    fn lacks_symmetry(&self) -> PyResult<bool> {
        Ok(self.lock()?.space.is_some())
    }

    /// Surface of a droplet in three dimensions: points of shape (n, 3), numbers of the corners of triangles of shape
    /// (m, 3), and at the points concentrations, tensions and velocities of shape (n, 3).
    #[allow(clippy::type_complexity)]
    fn mesh<'py>(
        &self,
        py: Python<'py>,
        droplet: usize,
    ) -> PyResult<(
        Bound<'py, PyArray2<f64>>,
        Bound<'py, PyArray2<i64>>,
        Bound<'py, PyArray1<f64>>,
        Bound<'py, PyArray1<f64>>,
        Bound<'py, PyArray2<f64>>,
    )> {
        let mesh = py.detach(|| {
            let mut state = self.lock()?;
            let body = state.in_space(droplet)?;
            state.scene.system_mut().evaluate().map_err(failed)?;
            state.scene.body(body).map_err(failed)?.droplets().droplets()[droplet].mesh().map_err(failed)
        })?;
        let corners: Vec<i64> = mesh.triangles.iter().flatten().map(|&corner| corner as i64).collect();
        let corners = PyArray1::from_vec(py, corners).reshape([mesh.triangles.len(), 3])?;
        let [concentrations, tensions] = [mesh.concentrations, mesh.tensions].map(|list| PyArray1::from_vec(py, list));
        let velocities = array_in_space(py, &mesh.velocities)?;
        Ok((array_in_space(py, &mesh.points)?, corners, concentrations, tensions, velocities))
    }

    /// Velocities of the fluid (length per time) at points in three dimensions, arrays of shape (n, 3).
    fn velocities_in_space<'py>(
        &self,
        py: Python<'py>,
        points: &Bound<'py, PyArray2<f64>>,
        error: f64,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let points: Vec<[f64; 3]> =
            points.try_readonly()?.as_array().rows().into_iter().map(|row| [row[0], row[1], row[2]]).collect();
        let found = py.detach(|| {
            let mut state = self.lock()?;
            let body = state.in_space(0)?;
            state.scene.system_mut().evaluate().map_err(failed)?;
            state.scene.body(body).map_err(failed)?.droplets().velocities_at(&points, error).map_err(failed)
        })?;
        array_in_space(py, &found)
    }

    /// Warnings of the records so far, the worst of each kind.
    #[getter]
    fn warnings(&self) -> PyResult<Vec<String>> {
        Ok(self.lock()?.warnings.worst().iter().map(|(_, warning)| warning.to_string()).collect())
    }

    /// Smallest gap so far between an interface and another body or wall (length); None where there is none.
    #[getter]
    fn minimum_gap(&self) -> PyResult<Option<f64>> {
        let state = self.lock()?;
        if let Some(body) = state.space {
            let droplets = state.scene.body(body).map_err(failed)?.droplets();
            let gaps = (0..state.count()).map(|number| droplets.smallest_gap(number).map_err(failed));
            return Ok(gaps.collect::<PyResult<Vec<_>>>()?.into_iter().flatten().reduce(f64::min));
        }
        let gaps = [state.scene.system().minimum_gap(), state.scene.system().minimum_wall_gap()];
        Ok(gaps.into_iter().flatten().reduce(f64::min))
    }

    /// Names, forces of the fluid (force) and, of rigid bodies, its torques (force times length) of all bodies, in the
    /// order of `bodies`.
    #[allow(clippy::type_complexity)]
    fn body_forces(&self, py: Python<'_>) -> PyResult<Vec<(String, [f64; 2], Option<f64>)>> {
        py.detach(|| {
            let mut state = self.lock()?;
            let system = state.scene.system_mut();
            let rigid: Vec<Handle<RigidBody>> = system.bodies().map(|(handle, _)| handle).collect();
            let named = system.all_bodies().map(|(handle, body)| (handle, body.name().to_owned()));
            let named: Vec<(Handle<dyn Body>, String)> = named.collect();
            let forces = named.into_iter().map(|(handle, name)| {
                let force = system.force_on(handle).map_err(failed)?;
                let rigid = rigid.iter().find(|rigid| rigid.index() == handle.index());
                let torque = rigid.map(|rigid| system.observe(*rigid).map(|seen| seen.torque)).transpose();
                Ok((name, force.to_array(), torque.map_err(failed)?))
            });
            forces.collect()
        })
    }

    /// Forces along the channel by their names; None without straight walls.
    fn channel_forces(&self, py: Python<'_>) -> PyResult<Option<BTreeMap<&'static str, Option<f64>>>> {
        py.detach(|| {
            let mut state = self.lock()?;
            let forces = state.scene.system_mut().channel_forces().map_err(failed)?;
            Ok(forces.map(|forces| {
                BTreeMap::from([
                    ("pressure_drop", Some(forces.pressure_drop)),
                    ("extra_pressure_drop", forces.extra_pressure_drop),
                    ("force_lower", Some(forces.on_walls[0])),
                    ("force_upper", Some(forces.on_walls[1])),
                    ("force_bodies_x", Some(forces.on_bodies.x)),
                    ("force_bodies_y", Some(forces.on_bodies.y)),
                    ("force_obstacles_x", Some(forces.on_obstacles.x)),
                    ("force_obstacles_y", Some(forces.on_obstacles.y)),
                    ("force_plates", Some(forces.on_plates)),
                ])
            }))
        })
    }

    /// Shear stresses of the fluid on the lower and the upper wall (stress) at that many places of each; None without
    /// straight walls.
    #[allow(clippy::type_complexity)]
    fn wall_shear<'py>(
        &self,
        py: Python<'py>,
        count: usize,
    ) -> PyResult<Option<(Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>)>> {
        let found = py.detach(|| {
            let mut state = self.lock()?;
            let system = state.scene.system_mut();
            let domain = system.hydrodynamics().fluid_view().domain;
            let period = domain.periods[0].unwrap_or_default();
            let places = (0..count).map(|k| domain.origin[0] + period * k as f64 / count as f64).collect::<Vec<_>>();
            Ok::<_, PyErr>(system.wall_shear(count).map_err(failed)?.map(|[lower, upper]| [places, lower, upper]))
        })?;
        Ok(found.map(|lists| {
            let [places, lower, upper] = lists.map(|list| PyArray1::from_vec(py, list));
            (places, lower, upper)
        }))
    }

    /// Names and markers of all bodies, droplets first.
    fn bodies<'py>(&self, py: Python<'py>) -> PyResult<Vec<(String, Bound<'py, PyArray2<f64>>)>> {
        let state = self.lock()?;
        let bodies = state.scene.system().all_bodies();
        let named = |(_, body): (_, &dyn Body)| {
            let mut markers = vec![Vec2::ZERO; body.marker_count()];
            body.write_markers(&mut markers);
            Ok((body.name().to_owned(), array_of(py, &markers)?))
        };
        bodies.map(named).collect()
    }

    /// Markers of a droplet (length), in counter-clockwise order.
    fn positions<'py>(&self, py: Python<'py>, droplet: usize) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let state = self.lock()?;
        let droplet = Self::droplet(&state, droplet)?;
        array_of(py, state.scene.body(droplet).map_err(failed)?.markers())
    }

    /// Concentrations of the segments that follow the markers of a droplet (particles per length).
    fn concentration<'py>(&self, py: Python<'py>, droplet: usize) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let state = self.lock()?;
        let droplet = Self::droplet(&state, droplet)?;
        Ok(PyArray1::from_slice(py, state.scene.body(droplet).map_err(failed)?.concentrations()))
    }

    /// Velocities of the fluid at the markers of a droplet (length per time).
    fn velocities<'py>(&self, py: Python<'py>, droplet: usize) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let velocities = py.detach(|| {
            let mut state = self.lock()?;
            let droplet = Self::droplet(&state, droplet)?;
            let system = state.scene.system_mut();
            system.evaluate().map_err(failed)?;
            Ok::<_, PyErr>(InterfaceState::of(system, droplet).map_err(failed)?.velocities.to_vec())
        })?;
        array_of(py, &velocities)
    }

    /// All observables of a droplet in the present state.
    fn observe<'py>(&self, py: Python<'py>, droplet: usize) -> PyResult<Bound<'py, PyDict>> {
        let entries = py.detach(|| {
            let mut state = self.lock()?;
            if state.space.is_some() {
                let body = state.in_space(droplet)?;
                let rows = rows_in_space(state.scene.system_mut(), body).map_err(failed)?;
                let values = rows[droplet].iter().map(|value| value.is_finite().then_some(*value));
                return Ok(SpaceCsv::columns(true).into_iter().zip(values).skip(1).collect());
            }
            let droplet = Self::droplet(&state, droplet)?;
            Ok::<_, PyErr>(state.scene.observe(droplet).map_err(failed)?.entries())
        })?;
        let observables = PyDict::new(py);
        entries.into_iter().try_for_each(|(name, value)| observables.set_item(name, value))?;
        Ok(observables)
    }

    /// Gives a droplet the tension of a table: concentrations that rise (particles per length) and tensions (force), of
    /// a smooth function or measured.
    fn set_tension(&self, droplet: usize, concentrations: Vec<f64>, tensions: Vec<f64>, smooth: bool) -> PyResult<()> {
        let law = TabulatedTension::new(concentrations, tensions, smooth)?;
        self.lock()?.set_tension(droplet, law)
    }

    /// Velocities (length per time), pressures (stress) with the mean pressure gradient, and velocity gradients
    /// (1/time) at points, an array of shape (n, 2).
    #[allow(clippy::type_complexity)]
    fn sample<'py>(
        &self,
        py: Python<'py>,
        points: &Bound<'py, PyArray2<f64>>,
    ) -> PyResult<(Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray3<f64>>)> {
        let points = points_of(&points.try_readonly()?)?;
        let samples = py.detach(|| {
            let mut samples = vec![FlowSample::default(); points.len()];
            let mut state = self.lock()?;
            let system = state.scene.system_mut();
            system.sample(&points, &mut samples).map_err(failed)?;
            // Tubes that are not straight have no mean one: their samples are complete.
            let known = |slope: f64| if slope.is_finite() { slope } else { 0.0 };
            let gradient = system.report().mean_pressure_gradient.map(known);
            let gradient = Vec2::from(gradient);
            for (sample, point) in samples.iter_mut().zip(&points) {
                sample.pressure += gradient.dot(*point);
            }
            Ok::<_, PyErr>(samples)
        })?;
        let velocities: Vec<Vec2> = samples.iter().map(|sample| sample.velocity).collect();
        let pressures: Vec<f64> = samples.iter().map(|sample| sample.pressure).collect();
        let gradients = samples.iter().flat_map(|sample| sample.gradient).flatten().collect();
        let gradients = PyArray1::from_vec(py, gradients).reshape([points.len(), 2, 2])?;
        Ok((array_of(py, &velocities)?, PyArray1::from_vec(py, pressures), gradients))
    }

    /// Picture of the present state as SVG, with the flow on a raster of that spacing (length); keywords are those of
    /// `look_of`.
    #[pyo3(signature = (spacing=None, **look))]
    fn svg(&self, py: Python<'_>, spacing: Option<f64>, look: Option<&Bound<'_, PyDict>>) -> PyResult<String> {
        let look = look_of(look, self.unit)?;
        py.detach(|| {
            if let Some(seen) = self.seen_in_space(spacing)? {
                return look.space_svg(&seen, &[]).map_err(failed);
            }
            let seen = self.seen(spacing)?;
            look.svg(&seen, &[]).map_err(failed)
        })
    }

    /// Writes a picture of the present state, as SVG or PNG by the end of the name.
    #[pyo3(signature = (path, spacing=None, **look))]
    fn write_picture(
        &self,
        py: Python<'_>,
        path: PathBuf,
        spacing: Option<f64>,
        look: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<()> {
        let look = look_of(look, self.unit)?;
        py.detach(move || {
            if let Some(seen) = self.seen_in_space(spacing)? {
                return look.write_space_picture(&seen, &[], path).map_err(failed);
            }
            let seen = self.seen(spacing)?;
            look.write_picture(&seen, &[], path).map_err(failed)
        })
    }

    /// Writes the flow and the bodies of the present state into a folder, as files for ParaView.
    #[pyo3(signature = (folder, spacing=None))]
    fn write_paraview(&self, py: Python<'_>, folder: PathBuf, spacing: Option<f64>) -> PyResult<()> {
        py.detach(|| {
            let mut state = self.lock()?;
            if let Some(body) = state.space {
                let mut files = SpaceParaView::create(folder, body).map_err(failed)?;
                return files.observe(state.scene.system_mut()).map_err(failed);
            }
            let raster = self.raster(&mut state, spacing)?;
            let mut files = ParaView::create(folder, raster).map_err(failed)?;
            files.observe(state.scene.system_mut()).map_err(failed)
        })
    }

    /// Another scene in the same state, with the same records.
    fn copy(&self, py: Python<'_>) -> PyResult<Self> {
        let copy = Self::new(py, &self.description)?;
        {
            let (state, mut other) = (self.lock()?, copy.lock()?);
            for (index, law) in &state.laws {
                other.set_tension(*index, law.clone())?;
            }
            other.scene.resume(&state.scene.checkpoint(self.description.fingerprint())).map_err(failed)?;
            other.records.clone_from(&state.records);
            other.warnings.clone_from(&state.warnings);
        }
        Ok(copy)
    }

    /// Setup that the scene was built from.
    #[getter]
    fn setup(&self) -> Setup {
        Setup { description: self.description.clone() }
    }

    /// State and records, for `pickle`.
    fn packed<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyBytes>, Bound<'py, PyArray1<f64>>)> {
        let state = self.lock()?;
        if !state.laws.is_empty() {
            let remedy = "Save the state with `save`, and build the scene, set its laws and `load` the state there";
            let message = format!("a scene with a tension law of your own cannot be pickled. {remedy}");
            return Err(refused(&message, Some("tension".into()), None, Some(remedy.to_owned())));
        }
        let bytes = state.scene.checkpoint(self.description.fingerprint()).to_bytes().map_err(failed)?;
        Ok((PyBytes::new(py, &bytes), PyArray1::from_slice(py, &state.records)))
    }

    /// Takes over a state and records that `packed` returned.
    #[expect(clippy::needless_pass_by_value, reason = "pyo3 extracts arrays by value")]
    fn unpack(&self, bytes: &[u8], records: PyReadonlyArray1<'_, f64>) -> PyResult<()> {
        let mut state = self.lock()?;
        let saved = Checkpoint::from_bytes(bytes).map_err(failed)?;
        state.scene.resume(&saved).map_err(|error: SceneError| failed(error))?;
        state.records = records.as_array().to_vec();
        Ok(())
    }

    /// Saves the state to a file.
    fn save(&self, py: Python<'_>, path: &Bound<'_, PyAny>) -> PyResult<()> {
        let path: PathBuf = path.extract()?;
        let description = self.description.fingerprint();
        py.detach(|| self.lock()?.scene.checkpoint(description).write(&path).map_err(failed))
    }

    /// Goes on from a saved state of this scene.
    fn load(&self, py: Python<'_>, path: &Bound<'_, PyAny>) -> PyResult<()> {
        let path: PathBuf = path.extract()?;
        py.detach(|| {
            let saved = Checkpoint::read(&path).map_err(failed)?;
            let mut state = self.lock()?;
            state.scene.resume(&saved).map_err(|error: SceneError| failed(error))
        })
    }
}

/// Settings of a picture by their names, with the name of the unit of length.
fn look_of(given: Option<&Bound<'_, PyDict>>, unit: &str) -> PyResult<Look> {
    let mut look = Look { length_unit: unit.to_owned(), ..Look::default() };
    for (name, value) in given.into_iter().flatten() {
        let name: String = name.extract()?;
        match name.as_str() {
            "caption" => look.caption = value.extract()?,
            "panel" => look.panel = value.extract()?,
            "width" => look.width = value.extract()?,
            "font_size" => look.font_size = value.extract()?,
            "resolution" => look.resolution = value.extract()?,
            "pressure_range" => look.pressure_range = value.extract()?,
            "concentration" => look.concentration = value.extract()?,
            "length_unit" => look.length_unit = value.extract()?,
            "streamlines" => look.streamlines = value.extract()?,
            "streamline_spacing" => look.streamline_spacing = value.extract()?,
            "scale_bar" => look.scale_bar = value.extract()?,
            "colour_bars" => look.colour_bars = value.extract()?,
            "solids" => look.solids = solid_colour(&value.extract::<String>()?)?,
            _ => {
                let text = format!("a picture has no setting {name}");
                return Err(pyo3::exceptions::PyTypeError::new_err(text));
            }
        }
    }
    Ok(look)
}

/// Quantity that the colour of solids shows.
fn solid_colour(name: &str) -> PyResult<SolidColour> {
    match name {
        "plain" => Ok(SolidColour::Plain),
        "displacement" => Ok(SolidColour::Displacement),
        "stress" => Ok(SolidColour::Stress),
        "internal-stress" => Ok(SolidColour::InternalStress),
        _ => {
            let remedy = "Use plain, displacement, stress or internal-stress";
            let text = format!("solids cannot show {name}. {remedy}");
            Err(refused(&text, Some("solids".into()), Some(name.into()), Some(remedy.into())))
        }
    }
}

impl Scene {
    /// State of droplets in three dimensions without symmetry; none in other scenes.
    fn seen_in_space(&self, spacing: Option<f64>) -> PyResult<Option<SpaceSnapshot>> {
        let mut state = self.lock()?;
        let Some(body) = state.space else { return Ok(None) };
        let cells = spacing.map_or(CELLS, |spacing| (VIEW * self.scale / spacing).clamp(4.0, 400.0) as usize);
        SpaceSnapshot::take(state.scene.system_mut(), body, cells).map(Some).map_err(failed)
    }

    fn seen(&self, spacing: Option<f64>) -> PyResult<Snapshot> {
        let mut state = self.lock()?;
        let raster = self.raster(&mut state, spacing)?;
        Snapshot::take(state.scene.system_mut(), raster).map_err(failed)
    }

    /// Raster over the region, or around the bodies where it has no end, by default of a tenth of the length scale.
    fn raster(&self, state: &mut State, spacing: Option<f64>) -> PyResult<Raster> {
        let (system, margin) = (state.scene.system_mut(), MARGIN * self.scale);
        let spacing = spacing.unwrap_or(SPACING * self.scale);
        let around = match self.description.region {
            Region::Plane | Region::Space => Raster::around(system, margin, spacing),
            Region::Tube { radius, .. } if spacing > 0.0 => {
                let places = system.markers().positions().iter().map(|place| place.x);
                let [low, high] = places.fold([f64::INFINITY, -f64::INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
                let size = [high - low + 2.0 * margin, 2.0 * radius];
                let cells = size.map(|side| (side / spacing).ceil().max(1.0) as usize);
                Raster::new([low - margin, -radius], size, cells, [false; 2])
            }
            _ => Raster::of(system, spacing),
        };
        around.map_err(failed)
    }
}
