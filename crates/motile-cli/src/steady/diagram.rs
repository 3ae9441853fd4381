//! Branches of steady states over a parameter, with their stability and special points.

use std::path::PathBuf;

use anyhow::{Context, Result, ensure};
use motile::base::Vec2;
use motile::setup::Setup;
use motile_output::plot::{AxisScale, Figure, Marker, Plot, Series};
use motile_output::{CsvTable, Progress};
use motile_steady_states::{
    Branch, BranchPoint, Continuation, Eigenmode, Parameter, Profile, SpecialKind, SpecialPoint, Stability,
    SteadyError, SteadyState, Symmetry,
};

use crate::run::{ORIGIN_KEY, Summary, command, make_directory, say};

/// Settings of a diagram of steady states over a parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct DiagramSettings {
    /// Parameter.
    pub parameter: Parameter,
    /// First and last value of the parameter.
    pub range: [f64; 2],
    /// True to start from the swimmer at the first value, false from the droplet at rest.
    pub swimmer: bool,
    /// Largest step over the range (no dimension).
    pub step: f64,
    /// Further observables for the table, such as `beta`.
    pub observables: Vec<String>,
    /// True to continue from the last point in the directory of the results.
    pub resume: bool,
    /// True to show no progress.
    pub quiet: bool,
    /// Directory of the results.
    pub out: PathBuf,
}

/// Returns the stability in tables: 1 for stable states, -1 for unstable ones, 0 if it is undecided.
fn number(stability: Stability) -> f64 {
    match stability {
        Stability::Stable => 1.0,
        Stability::Unstable => -1.0,
        Stability::Undecided => 0.0,
    }
}

/// Kind of the end of a branch among special points.
const END: f64 = 3.0;

/// Columns of every table, before the observables that are asked for.
const COLUMNS: [&str; 17] = [
    "branch",
    "value",
    "speed",
    "velocity_x",
    "velocity_y",
    "y",
    "stresslet",
    "aspect_ratio",
    "c_max",
    "c_min",
    "unstable_modes",
    "growth_rate",
    "frequency",
    "antisymmetric",
    "tail",
    "growth_rate_error",
    "stability",
];

/// Follows the steady states of a scene over a parameter: from the droplet at rest also the swimmers that branch off
/// where it polarises. Writes to the directory of the settings: `branches.csv`, all points; `special.csv`, folds (kind
/// 0), branch points (1), Hopf points (2) and the ends of branches (3); `summary.json`, why they end; `diagram.svg`
/// (also as PNG), with stable states as full lines and unstable ones as dashed lines.
///
/// # Errors
/// Returns an error for settings without a range; a scene without such states; files that cannot be written.
pub fn draw(scene: &Setup, flags: &DiagramSettings) -> Result<()> {
    let DiagramSettings { parameter, range: [from, to], step, ref out, .. } = *flags;
    ensure!(from != to, "{} starts and ends at {from}. Use two different values", parameter.name());
    ensure!(
        step > 0.0 && step <= 0.5,
        "a step of {step} is not a fraction of the range. Use a number above 0, at most 0.5"
    );
    let setup = parameter.with(scene, from)?;
    make_directory(out)?;
    keep_scene(flags, &setup)?;
    let mut diagram = Diagram::new(flags, &setup)?;
    let settings = Continuation { largest_step: step, ..Continuation::new(parameter, from, to) };
    // A diagram that was broken off on its first branch begins anew, which takes no longer.
    if diagram.branch > 0 {
        let (state, upwards) = diagram.last(&setup)?;
        let rest = Continuation { upwards, ..settings };
        let mut first = true;
        let branch =
            rest.follow(&state, |point, special| std::mem::take(&mut first) || diagram.update_host(point, special))?;
        diagram.end(&branch)?;
    } else {
        let start = if flags.swimmer { SteadyState::find(&setup)? } else { SteadyState::uniform(&setup)? };
        let known = start.observables()?;
        for name in &flags.observables {
            ensure!(
                known.get(name).is_some(),
                "--observable {name}: there is no such observable. Use a column of the table of a run, such as beta"
            );
        }
        let rest = settings.follow(&start, |point, special| diagram.update_host(point, special))?;
        diagram.end(&rest)?;
        // What branches off first; from rest the swimmers along x, of which those along y are others by a turn.
        let wanted = |point: &SpecialPoint| {
            let along = point.critical.mode.symmetry == Symmetry::Symmetric;
            point.kind == SpecialKind::BranchPoint && (flags.swimmer || along)
        };
        if let Some(point) = rest.special.into_iter().find(wanted) {
            diagram.branch += 1;
            match settings.switch(&point, true, |point, special| diagram.update_host(point, special)) {
                Err(error @ SteadyError::Refused { .. }) if !setup.rigid_bodies.is_empty() => {
                    diagram.tell(format!("branch 1 does not begin: {error}"));
                }
                branch => diagram.end(&branch?)?,
            }
        }
    }
    diagram.finish()
}

/// Writes the scene at the first value of the parameter, with the version of the program, or compares it with the scene
/// of the diagram to continue.
fn keep_scene(flags: &DiagramSettings, setup: &Setup) -> Result<()> {
    let path = flags.out.join("scene.toml");
    let head = format!("# Of a diagram of motile {} over {}\n", motile::VERSION, flags.parameter.name());
    if flags.resume && path.exists() {
        let text = std::fs::read_to_string(&path)?;
        let place = path.display();
        ensure!(text.starts_with(&head), "{place} is of another version or parameter. Leave --resume out");
        if let Some(entry) = setup.difference(&Setup::from_toml(&text)?) {
            anyhow::bail!("{place} is of another scene: {entry}. Give the scene of the diagram, or leave --resume out");
        }
        return Ok(());
    }
    ensure!(
        !flags.resume || !flags.out.join("branches.csv").exists(),
        "{} has no scene: an older version made it. Leave --resume out",
        flags.out.display()
    );
    Ok(std::fs::write(&path, format!("{head}{}", setup.to_toml()?))?)
}

/// Files of a diagram.
struct Diagram<'a> {
    flags: &'a DiagramSettings,
    /// Of the results, for all files.
    origin: String,
    branch: usize,
    table: CsvTable,
    /// Kind, value and speed of special points, and frequency and symmetry of their modes.
    special: CsvTable,
    before: f64,
    /// Why each branch ends.
    ends: Vec<String>,
    progress: Progress,
}

impl<'a> Diagram<'a> {
    fn new(flags: &'a DiagramSettings, setup: &Setup) -> Result<Self> {
        let origin = format!("{}; command: {}", setup.origin(), command());
        let names: Vec<&str> = COLUMNS.into_iter().chain(flags.observables.iter().map(String::as_str)).collect();
        let open = |name: &str, names: &[&str], resume: bool| {
            let path = flags.out.join(name);
            if resume { CsvTable::resume(path, names, &origin) } else { CsvTable::with_origin(path, names, &origin) }
        };
        let table = open("branches.csv", &names, flags.resume)?;
        let branch = table.rows().last().map_or(0, |row| row[0] as usize);
        let resume = branch > 0 && flags.out.join("last.csv").exists();
        let table = if resume { table } else { open("branches.csv", &names, false)? };
        let special = open("special.csv", &["kind", "value", "speed", "frequency", "antisymmetric"], resume)?;
        let progress = Progress::new(flags.quiet);
        Ok(Self {
            flags,
            origin,
            branch: if resume { branch } else { 0 },
            table,
            special,
            before: flags.range[0],
            ends: Vec::new(),
            progress,
        })
    }

    /// Takes over a point of a branch; false to stop.
    fn update_host(&mut self, point: &BranchPoint, special: &[SpecialPoint]) -> bool {
        self.write(point, special).inspect_err(|error| eprintln!("error: {error:#}")).is_ok()
    }

    fn write(&mut self, point: &BranchPoint, special: &[SpecialPoint]) -> Result<()> {
        let DiagramSettings { parameter, range: [from, to], observables: ref observable, .. } = *self.flags;
        for SpecialPoint { kind, value: at, critical, .. } in special {
            let frequency = critical.mode.value.im;
            let (kind_name, mode) = (kind.name(), critical.mode.symmetry.name());
            let note =
                format!("{kind_name} at {} = {at:.7}, frequency {frequency:.5}, symmetry {mode}", parameter.name());
            self.progress.note(&note);
            let antisymmetric = critical.mode.symmetry == Symmetry::Antisymmetric;
            let speed = critical.state.measured()?.speed;
            self.special.push(&[f64::from(*kind as u8), *at, speed, frequency, f64::from(u8::from(antisymmetric))])?;
            self.special.flush()?;
        }
        let seen = point.state.measured()?;
        let velocity = point.state.velocity();
        let leading = point.spectrum.leading();
        let value = |of: fn(&Eigenmode) -> f64| leading.map_or(f64::NAN, of);
        let mut row = vec![
            self.branch as f64,
            point.value,
            seen.speed,
            velocity.x,
            velocity.y,
            seen.centroid.y,
            seen.stresslet,
            seen.aspect_ratio,
            seen.concentration[0],
            seen.concentration[1],
            point.spectrum.unstable() as f64,
            value(|mode| mode.value.re),
            value(|mode| mode.value.im),
            value(|mode| f64::from(u8::from(mode.symmetry == Symmetry::Antisymmetric))),
            point.state.tail(),
            point.spectrum.error,
            number(point.spectrum.stability()),
        ];
        if !observable.is_empty() {
            let all = point.state.observables()?;
            row.extend(observable.iter().map(|name| all.get(name).unwrap_or(f64::NAN)));
        }
        self.table.push(&row)?;
        self.table.flush()?;
        self.keep(point)?;
        self.progress.update((point.value - from) / (to - from), || {
            format!("branch {}: {} {:.4}, speed {:.5}", self.branch, parameter.name(), point.value, seen.speed)
        });
        self.before = point.value;
        Ok(())
    }

    /// Records why a branch ends, and where.
    fn end(&mut self, branch: &Branch) -> Result<()> {
        let Some(last) = branch.points.last() else { return Ok(()) };
        let end =
            format!("branch {} ends at {} = {:.6}: {}", self.branch, branch.parameter.name(), last.value, branch.end);
        self.tell(end);
        self.special.push(&[END, last.value, last.state.measured()?.speed, 0.0, 0.0])?;
        Ok(self.special.flush()?)
    }

    /// Records how a branch ends.
    fn tell(&mut self, end: String) {
        self.progress.note(&end);
        self.ends.push(end);
    }

    /// Writes the last point, from which a diagram can continue.
    fn keep(&self, point: &BranchPoint) -> Result<()> {
        let path = self.flags.out.join("last.csv");
        let partial = path.with_extension("part");
        let mut table = CsvTable::with_origin(&partial, &["x", "y", "density"], &self.origin)?;
        let velocity = point.state.velocity();
        table.push(&[point.value, f64::from(u8::from(point.value > self.before)), 0.0])?;
        table.push(&[velocity.x, velocity.y, f64::from(u8::from(point.state.is_mirror_symmetric()))])?;
        let profile = point.state.profile();
        for nucleus in &profile.nuclei {
            table.push(&[nucleus.x, nucleus.y, 0.0])?;
        }
        for (x, density) in profile.positions.iter().zip(&profile.density) {
            table.push(&[x.x, x.y, *density])?;
        }
        table.flush()?;
        Ok(std::fs::rename(partial, path)?)
    }

    /// Returns the last point that was written, and whether the parameter grew there.
    fn last(&mut self, setup: &Setup) -> Result<(SteadyState, bool)> {
        let table = CsvTable::resume(self.flags.out.join("last.csv"), &["x", "y", "density"], &self.origin)?;
        let parts = table.rows().split_at_checked(2 + setup.rigid_bodies.len());
        let Some(([place, velocity, nuclei @ ..], nodes)) = parts else {
            anyhow::bail!("last.csv is incomplete, so the run cannot continue. Leave --resume out")
        };
        let places = |rows: &[Vec<f64>]| rows.iter().map(|row| Vec2::new(row[0], row[1])).collect();
        let density = nodes.iter().map(|row| row[2]).collect();
        let profile = Profile { positions: places(nodes), density, nuclei: places(nuclei) };
        let setup = self.flags.parameter.with(setup, place[0])?;
        let moves = Vec2::new(velocity[0], velocity[1]);
        let state = SteadyState::near(&setup, &profile, moves, velocity[2] == 1.0).context("resuming from last.csv")?;
        self.before = place[0];
        Ok((state, place[1] == 1.0))
    }

    /// Draws the diagram.
    fn finish(mut self) -> Result<()> {
        let DiagramSettings { parameter, ref out, .. } = *self.flags;
        let seconds = self.progress.finish();
        self.table.flush()?;
        let rows = self.table.rows();
        let column = |name: &str| COLUMNS.iter().position(|column| *column == name).unwrap_or(0);
        let panel = |name: &str, label: &str| {
            let mut plot = Plot::new("").x_axis(parameter.name(), AxisScale::Linear).y_axis(label, AxisScale::Linear);
            let y = column(name);
            for branch in 0..=self.branch {
                for stability in [Stability::Stable, Stability::Unstable, Stability::Undecided] {
                    let shown =
                        |row: &Vec<f64>| row[0] as usize == branch && row[column("stability")] == number(stability);
                    if stability == Stability::Undecided && !rows.iter().any(shown) {
                        continue;
                    }
                    // Points of the other kind interrupt the line.
                    let points = rows.iter().filter(|row| row[0] as usize == branch);
                    let points = points.map(|row| (row[1], if shown(row) { row[y] } else { f64::NAN }));
                    let line = Series::line(stability.name(), points);
                    plot = plot.series(match stability {
                        Stability::Stable => line.marker(Marker::Disc),
                        Stability::Unstable => line.dashed().marker(Marker::Circle),
                        Stability::Undecided => line.dashed().marker(Marker::Diamond),
                    });
                }
            }
            plot
        };
        let mut speeds = panel("speed", "speed (length/time)");
        for kind in [SpecialKind::Fold, SpecialKind::BranchPoint, SpecialKind::Hopf] {
            let of_kind = self.special.rows().iter().filter(|row| row[0] == f64::from(kind as u8));
            let points: Vec<(f64, f64)> = of_kind.map(|row| (row[1], row[2])).collect();
            if !points.is_empty() {
                speeds = speeds.series(Series::points(kind.name(), points).marker(Marker::Diamond));
            }
        }
        let figure = Figure::new(1).of_origin(&self.origin).panel(speeds);
        let figure = figure.panel(panel("growth_rate", "leading growth rate (1/time)"));
        figure.write(out, "diagram")?;
        let mut summary = Summary::default();
        summary.put(ORIGIN_KEY, self.origin, "of the results");
        summary.put("points", rows.len(), "of all branches");
        let special = self.special.rows().iter().filter(|row| row[0] != END).count();
        summary.put("special_points", special, "folds, branch points, Hopf points");
        summary.put("ends", self.ends, "of branches");
        summary.put("seconds", seconds, "on one core");
        summary.write(&out.join("summary.json"))?;
        say(format_args!("{} points in {seconds:.1} s; results in {}", rows.len(), out.display()));
        Ok(())
    }
}
