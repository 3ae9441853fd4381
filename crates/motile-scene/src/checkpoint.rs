//! Checkpoints: the state of a scene on disk.

mod error;
mod file;

pub use crate::saved_state::{Record, SavedState};
pub use error::CheckpointError;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::{
    Body, Domain, Hydrodynamics, MarkerKind, Scene, SceneError, System,
    scene::{Findings, flow_properties},
    step_report::StepReport,
};
use motile_base::{
    ImposedFlow, SolveReport, Vec2,
    internal::{told, told_apart},
};

/// The whole state of a scene. A run that continues from it is bitwise the same as if it had never stopped.
///
/// It holds what observers have found so far as well ([`crate::System::record_mut`], [`crate::Warnings`]).
///
/// To resume, build the same scene again and pass the checkpoint to [`Scene::resume`]. The scene has to be the same:
/// its domain, the drive along it, the viscosities, the walls, the bodies and their materials
/// ([`crate::Body::properties`], with the numbers of markers and points that they started with), the number of nodes of
/// boundary integrals. If the scene was built from a description ([`Scene::described_by`]), each of its entries has to
/// be the same too. You may change how the scene is computed: time step, integrator and observers, grid spacing (with
/// markers and meshes as before), kernel, corrections, transport of particles. The flow of the state is then
/// recomputed. To continue with other parameters, use [`Scene::take_over`].
///
/// ```
/// use motile_scene::{Scene, Substrate, checkpoint::Checkpoint};
///
/// # let directory = std::env::temp_dir().join(format!("motile-{}", std::process::id()));
/// # std::fs::create_dir_all(&directory)?;
/// # let path = directory.join("scene.checkpoint");
/// let make = || Substrate::new(1.0).map(Scene::new);
/// let mut scene = make()?;
/// scene.run(2.0).go()?;
/// scene.checkpoint("an empty box").write(&path)?;
///
/// let mut again = make()?;
/// again.resume(&Checkpoint::read(&path)?)?;
/// assert_eq!(again.time(), 2.0);
/// # std::fs::remove_dir_all(&directory)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Of the program that wrote it ([`crate::VERSION`]).
    version: String,
    description: String,
    /// Of the results ([`crate::System::origin`]).
    origin: String,
    /// Of the description that the scene was built from.
    entries: BTreeMap<String, String>,
    time: f64,
    steps: u64,
    domain: Domain,
    /// Of the grid, if there was one (length).
    spacing: Option<f64>,
    properties: Vec<(String, f64)>,
    /// The imposed flow at the time of the state, and if it is a function of time at some later times (time).
    imposed: Vec<(f64, ImposedFlow)>,
    bodies: Vec<Part>,
    flow: SavedState,
    /// The flow at the markers, where it was known: x and y of all velocities, and what its evaluation found.
    known: Option<(Vec<[f64; 2]>, SolveReport)>,
    /// Its name and what it keeps.
    integrator: String,
    kept: SavedState,
    control: SavedState,
    report: StepReport,
    findings: Findings,
}

/// A named state.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Part {
    name: String,
    kind: u8,
    properties: Vec<(String, f64)>,
    saved: SavedState,
}

impl Part {
    fn of(body: &dyn Body) -> Self {
        let (name, properties) = (body.name().to_owned(), body.properties());
        Self { name, kind: kind(body.kind()), properties, saved: body.save() }
    }
}

/// Numbers that were computed in the same way differ by less than this fraction of them on any machine.
const ROUND_OFF: f64 = 1e-9;

/// Later times at which an imposed flow that is a function of time is compared, in mean steps so far, or in units of
/// time before the first step.
const LATER: [f64; 5] = [0.0, 1.0, 10.0, 100.0, 1000.0];

/// Names of the counts of a body that the length of its state follows from, or its resolution ([`Body::properties`]).
const COUNTS: [&str; 5] = [
    "the number of markers",
    "the number of markers at the start",
    "the number of points",
    "the number of free points",
    "the number of nodes",
];

/// Returns the imposed flow at the present time, and if it is a function of time at later times (time).
fn imposed_from_now<H: Hydrodynamics>(system: &System<H>) -> Vec<(f64, ImposedFlow)> {
    let (time, steps) = (system.time(), system.steps());
    let unit = if steps > 0 && time > 0.0 { time / steps as f64 } else { 1.0 };
    let count = if system.is_flow_of_time() { LATER.len() } else { 1 };
    LATER[..count].iter().map(|later| time + later * unit).map(|time| (time, system.imposed_at(time))).collect()
}

/// Refuses another imposed flow than the saved one, at any of the times at which either is known to change.
fn compare_flows<H: Hydrodynamics>(system: &System<H>, checkpoint: &Checkpoint) -> Result<(), SceneError> {
    let numbers = |flow: ImposedFlow, time: Option<f64>| {
        let at = time.map_or_else(String::new, |time| format!(" at the time {time}"));
        flow_properties(flow).map(|(name, value)| (format!("{name}{at}"), value)).collect::<Vec<_>>()
    };
    let compare = |time: Option<f64>, here: ImposedFlow, saved: ImposedFlow| {
        compare_properties("the scene", &numbers(here, time), &numbers(saved, time))
    };
    let changes = system.is_flow_of_time();
    match checkpoint.imposed[..] {
        // A steady one goes on at later times.
        [(now, saved)] => {
            let later = if changes { &LATER[..] } else { &LATER[..1] };
            let unit = if checkpoint.steps > 0 && now > 0.0 { now / checkpoint.steps as f64 } else { 1.0 };
            let times = later.iter().map(|later| now + later * unit);
            times.into_iter().try_for_each(|time| compare(changes.then_some(time), system.imposed_at(time), saved))
        }
        ref flows => flows.iter().try_for_each(|(time, saved)| compare(Some(*time), system.imposed_at(*time), *saved)),
    }
}

/// Returns the first length that a saved domain has otherwise than the present one, in words.
fn difference(saved: Domain, present: Domain) -> String {
    let lengths = |Domain { origin: [x, y], periods, walls }: Domain| {
        let [below, above] = walls.map_or([None; 2], |walls| walls.map(Some));
        let [period_x, period_y] = *periods;
        [
            ("period along x", period_x),
            ("period along y", period_y),
            ("lower wall", below),
            ("upper wall", above),
            ("origin in x", Some(x)),
            ("origin in y", Some(y)),
        ]
    };
    let pairs = lengths(saved).into_iter().zip(lengths(present));
    let texts = pairs.filter(|(saved, present)| saved != present).map(|((name, saved), (_, present))| {
        let [saved, present] = match (saved, present) {
            (Some(saved), Some(present)) => told_apart([saved, present]),
            (saved, present) => [saved, present].map(|value| value.map_or_else(|| "none".to_owned(), told)),
        };
        format!("the {name} of its domain is {saved}, here {present}")
    });
    texts.take(1).collect()
}

/// The first property that is not the same here and in a checkpoint.
fn compare_properties(of: &str, here: &[(String, f64)], saved: &[(String, f64)]) -> Result<(), SceneError> {
    let value = |list: &[(String, f64)], name: &str| list.iter().find(|entry| entry.0 == name).map(|entry| entry.1);
    let same =
        |a: f64, b: f64| a == b || (a - b).abs() <= ROUND_OFF * a.abs().min(b.abs()) || (a.is_nan() && b.is_nan());
    for (name, _) in here.iter().chain(saved) {
        let [present, saved] = [value(here, name), value(saved, name)];
        if !present.zip(saved).is_some_and(|(a, b)| same(a, b)) {
            return Err(SceneError::other_property(of, name, saved, present));
        }
    }
    Ok(())
}

/// Values of entries that say least.
const EMPTY: [&str; 6] = ["0.0", "0", "false", "\"\"", "a list of 0", "[]"];

/// Returns the first entry of a description ([`Scene::described_by`]) that is not the same here and in what was saved,
/// in words. A scene that was put together by hand has no entries, and none that is different.
#[must_use]
pub fn other_entry(here: &BTreeMap<String, String>, saved: &BTreeMap<String, String>) -> Option<String> {
    if here.is_empty() || saved.is_empty() {
        return None;
    }
    // Where a part is given on one side alone, such as a flow, its entries that are not zero tell more than the others.
    let telling = |key: &&String| match (here.get(*key), saved.get(*key)) {
        (Some(_), Some(_)) => 0,
        (one, other) => 1 + usize::from(one.or(other).is_some_and(|value| EMPTY.contains(&value.as_str()))),
    };
    let different = here.keys().chain(saved.keys()).filter(|key| here.get(*key) != saved.get(*key));
    let key = different.min_by_key(telling)?;
    let shown = |entries: &BTreeMap<String, String>| entries.get(key).map_or("not given", String::as_str).to_owned();
    Some(format!("{key} is {} in it and {} here", shown(saved), shown(here)))
}

/// Returns the number of a kind of markers in files.
fn kind(kind: MarkerKind) -> u8 {
    match kind {
        MarkerKind::Interface { viscosity_inside: None } => 0,
        MarkerKind::Interface { .. } => 1,
        MarkerKind::UnevenInterface { viscosity_inside: None } => 2,
        MarkerKind::UnevenInterface { .. } => 3,
        MarkerKind::Points => 4,
        MarkerKind::Rigid => 5,
        MarkerKind::OpenInterface { viscosity_inside: None, .. } => 6,
        MarkerKind::OpenInterface { .. } => 7,
    }
}

impl Checkpoint {
    /// Returns the version of the program that wrote it ([`crate::VERSION`]).
    #[must_use]
    pub fn version(&self) -> &str {
        &self.version
    }

    /// Returns the description that it was saved with.
    #[must_use]
    pub fn description(&self) -> &str {
        &self.description
    }

    /// Returns the origin of the run that wrote it ([`crate::System::origin`]).
    #[must_use]
    pub fn origin(&self) -> &str {
        &self.origin
    }

    /// Returns the time of the state (time).
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Returns the number of steps up to the state.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.steps
    }
}

impl<H: Hydrodynamics> Scene<H> {
    /// Returns the present state, with a description that distinguishes checkpoints.
    #[must_use]
    pub fn checkpoint(&self, description: impl Into<String>) -> Checkpoint {
        let (system, integrator) = (self.system(), self.integrator());
        let mut kept = SavedState::default();
        integrator.save(&mut kept);
        let mut control = SavedState::default();
        self.control.save(&mut control);
        let velocities = system.markers().velocities.iter().copied().map(Vec2::to_array);
        Checkpoint {
            version: crate::VERSION.to_owned(),
            description: description.into(),
            origin: system.origin().to_owned(),
            entries: self.entries.clone(),
            time: system.time(),
            steps: system.steps() as u64,
            domain: system.hydrodynamics().fluid_view().domain,
            spacing: system.hydrodynamics().fluid_view().spacing,
            properties: system.properties(),
            imposed: imposed_from_now(system),
            bodies: system.all_bodies().map(|(_, body)| Part::of(body)).collect(),
            flow: system.hydrodynamics().save(),
            known: system.is_evaluated().then(|| (velocities.collect(), *system.report())),
            integrator: integrator.name().to_owned(),
            kept,
            control,
            report: self.step_report().clone(),
            findings: system.findings.clone(),
        }
    }

    /// Continues from a checkpoint of this scene. The steps that follow are bitwise the steps that would have followed
    /// there. Another integrator starts afresh. After an error, the scene is as it was.
    ///
    /// # Errors
    /// Returns an error for:
    /// * a checkpoint of another domain, of other bodies, or of a state that a body refuses,
    /// * [`SceneError::Refused`] if another version of the program wrote it ([`Checkpoint::version`]), or if an entry
    ///   of the description ([`Scene::described_by`]), a body, the fluid or the imposed flow is different, with its
    ///   name and both values.
    ///
    /// An imposed flow that is a function of time is compared at the time of the state and at four later times, up to a
    /// thousand mean steps later.
    pub fn resume(&mut self, checkpoint: &Checkpoint) -> Result<(), SceneError> {
        self.compare(checkpoint)?;
        let before = self.checkpoint("");
        self.take(checkpoint).inspect_err(|_| {
            // It was the state a moment ago.
            let restored = self.take(&before);
            debug_assert!(restored.is_ok());
        })
    }

    /// Replaces the state of this scene with one saved from a scene that has the same bodies.
    ///
    /// Use this to change parameters in the middle of a run: build a second scene with the new activity, viscosity,
    /// region or imposed flow, and pass it the checkpoint of the first. Bodies keep their positions and whatever they
    /// carry, such as particles. The scene also takes over the time, the number of steps, and the strain of a sheared
    /// box. The flow is recomputed at the next step, and step-size control starts afresh. To continue a run with
    /// *unchanged* parameters, use [`Scene::resume`], which is bitwise exact.
    ///
    /// ```
    /// use motile_base::Vec2;
    /// use motile_scene::{MarkerBody, Scene, StepSize, Substrate};
    ///
    /// // A spring draws a point to the origin, on a substrate of friction 2.
    /// let build = |stiffness: f64| -> Result<_, Box<dyn std::error::Error>> {
    ///     let spring = move |positions: &[Vec2], forces: &mut [Vec2]| forces[0] = -stiffness * positions[0];
    ///     let mut scene = Scene::new(Substrate::new(2.0)?);
    ///     let point = scene.add(MarkerBody::new("point", vec![Vec2::X], spring));
    ///     Ok((scene, point))
    /// };
    /// let adaptive = StepSize::Adaptive { tolerance: 1e-4 };
    /// let (mut soft, _) = build(1.0)?;
    /// soft.run(1.0).step_size(adaptive).go()?;
    ///
    /// // From time 1 on, the spring is three times as stiff.
    /// let (mut stiff, point) = build(3.0)?;
    /// stiff.take_over(&soft.checkpoint("soft"))?;
    /// stiff.run(2.0).step_size(adaptive).go()?;
    /// let place = stiff.body(point)?.markers()[0];
    /// assert!((place.x - (-0.5_f64 - 1.5).exp()).abs() < 1e-3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// In every case, the scene is left as it was. Returns [`SceneError::Refused`] if the checkpoint has other bodies,
    /// another number of them, or bodies of another number of markers or points. Returns [`SceneError::Body`] if a body
    /// refuses its saved state, and [`SceneError`] if bodies would overlap or lie beyond the walls of this scene.
    pub fn take_over(&mut self, checkpoint: &Checkpoint) -> Result<(), SceneError> {
        self.compare_bodies(checkpoint)?;
        for ((_, body), part) in self.system().all_bodies().zip(&checkpoint.bodies) {
            let counts = |list: &[(String, f64)]| {
                list.iter().filter(|(name, _)| COUNTS.contains(&name.as_str())).cloned().collect::<Vec<_>>()
            };
            compare_properties(body.name(), &counts(&body.properties()), &counts(&part.properties))
                .map_err(SceneError::of_other_resolution)?;
        }
        let before = self.checkpoint("");
        let taken = self.take_bodies(checkpoint, &before);
        taken.inspect_err(|_| {
            let restored = self.take(&before);
            debug_assert!(restored.is_ok());
        })
    }

    fn take_bodies(&mut self, checkpoint: &Checkpoint, before: &Checkpoint) -> Result<(), SceneError> {
        let records = checkpoint.bodies.iter().map(|part| &part.saved);
        let system = self.system_mut();
        system.load(records, &before.flow, checkpoint.time, checkpoint.steps as usize)?;
        let periods = checkpoint.domain.periods;
        if let Some(height) = periods[1] {
            system.take_strain(periods.tilt / height)?;
        }
        system.forget_motion();
        system.evaluate()?;
        self.control = crate::scene::StepControl::default();
        self.report = checkpoint.report.clone();
        self.system_mut().findings.clone_from(&checkpoint.findings);
        Ok(())
    }

    /// Refuses a checkpoint of other bodies, by their number and names, or of a time that is none.
    fn compare_bodies(&self, checkpoint: &Checkpoint) -> Result<(), SceneError> {
        let system = self.system();
        let foreign = |problem: String| Err(SceneError::foreign_checkpoint(problem));
        let (expected, found) = (system.all_bodies().len(), checkpoint.bodies.len());
        if expected != found {
            return foreign(format!("it has {found} bodies, this scene {expected}"));
        }
        for (index, ((_, body), part)) in system.all_bodies().zip(&checkpoint.bodies).enumerate() {
            let (here, there) = (body.name(), &part.name);
            if here != there {
                return foreign(format!("its body {index} is {there:?} where this scene has {here:?}"));
            }
        }
        if !(checkpoint.time.is_finite() && usize::try_from(checkpoint.steps).is_ok()) {
            return foreign(format!("its time is {} after {} steps", checkpoint.time, checkpoint.steps));
        }
        Ok(())
    }

    fn compare(&self, checkpoint: &Checkpoint) -> Result<(), SceneError> {
        if checkpoint.version != crate::VERSION {
            return Err(SceneError::other_version(&checkpoint.version));
        }
        let physics = self.compare_physics(checkpoint);
        let Some(entry) = other_entry(&self.entries, &checkpoint.entries) else { return physics };
        // What the difference is, and where it was written.
        Err(physics.err().map_or_else(|| SceneError::other_entry(&entry), |error| error.with_entry(&entry)))
    }

    /// Refuses a checkpoint of another domain, or of bodies or fluid of something else.
    fn compare_physics(&self, checkpoint: &Checkpoint) -> Result<(), SceneError> {
        let system = self.system();
        let foreign = |problem: String| Err(SceneError::foreign_checkpoint(problem));
        let domain = system.hydrodynamics().fluid_view().domain;
        // The strain of a sheared box is part of the state.
        let unstrained = |domain: Domain| Domain { periods: (*domain.periods).into(), ..domain };
        if unstrained(domain) != unstrained(checkpoint.domain) {
            return Err(SceneError::other_domain(difference(checkpoint.domain, domain)));
        }
        compare_properties("the scene", &system.properties(), &checkpoint.properties)?;
        compare_flows(system, checkpoint)?;
        self.compare_bodies(checkpoint)?;
        for ((_, body), part) in system.all_bodies().zip(&checkpoint.bodies) {
            let here = body.name();
            compare_properties(here, &body.properties(), &part.properties)?;
            if kind(body.kind()) != part.kind {
                return foreign(format!("the markers of {here} are of another kind"));
            }
        }
        Ok(())
    }

    fn take(&mut self, checkpoint: &Checkpoint) -> Result<(), SceneError> {
        let records = checkpoint.bodies.iter().map(|part| &part.saved);
        self.system_mut().load(records, &checkpoint.flow, checkpoint.time, checkpoint.steps as usize)?;
        if checkpoint.integrator == self.integrator().name() {
            self.load_integrator(&checkpoint.kept)?;
            self.control = crate::scene::StepControl::load(&checkpoint.control)
                .ok_or_else(|| SceneError::foreign_checkpoint("it has no state of its time steps"))?;
        }
        self.report = checkpoint.report.clone();
        let same = self.system().hydrodynamics().fluid_view().spacing == checkpoint.spacing;
        if let Some((velocities, report)) = checkpoint.known.as_ref().filter(|_| same) {
            let velocities = velocities.iter().copied().map(Vec2::from);
            self.system_mut().take_flow(&checkpoint.flow, velocities, *report)?;
        }
        // The flow that was computed here is no work of the run.
        self.system_mut().findings.clone_from(&checkpoint.findings);
        Ok(())
    }
}

#[cfg(test)]
mod tests;
