//! Constrictions of tubes that a droplet passes, beside those of channels in the plane.

use std::thread::ScopedJoinHandle;

use anyhow::{Context, Result, bail};
use motile::base::{Drive, Region, TubeShape};
use motile::scene::{Every, SceneError};
use motile::setup::{DropletSetup, Setup};
use motile_cli::run::{Decided, say};

use motile_tests::validation::Table;
use toml::{Table as Toml, Value};

use super::scene;
use crate::passage::{Passage, Verdict};

/// Sources that the table depends on besides those of every run.
pub(super) const INPUTS: [&str; 3] =
    ["studies/src/tubes/constrictions.rs", "studies/src/passage.rs", "studies/book/data/environment-constriction.toml"];
/// End of the runs, and place on the axis where they start (R0).
const TIME: f64 = 160.0;
const START: f64 = -4.0;
/// Half of the distance of the last two throats over their middle.
const WITHIN: f64 = 0.02;
/// Diameter of tubes and width of the channel (R0).
const WIDTH: f64 = 3.0;
/// Lengths of the throat and of its ramps (R0).
const THROAT: [f64; 2] = [2.0, 1.0];
/// Places of constrictions, nodes, and diameters or widths of throats that are not passed and that are (R0); coarser
/// bisections ended in these.
const CASES: [(Place, usize, [f64; 2]); 4] = [
    (Place::Plane(Drive::ZeroFlux), 56, [1.4, 2.6]),
    (Place::Plane(Drive::ZeroGradient), 56, [1.36, 1.41]),
    (Place::Tube, 48, [2.25, 2.3]),
    (Place::Tube, 64, [2.25, 2.3]),
];
/// Constrictions in the plane, one of whose scenes is taken with its ends closed.
const PLANE: &str = include_str!("../../book/data/environment-constriction.toml");

/// Surroundings of a droplet before a constriction.
#[derive(Debug, Clone, Copy)]
enum Place {
    /// A tube without flux.
    Tube,
    /// A channel in the plane.
    Plane(Drive),
}

/// The droplet of the plane's constrictions before one of a tube, of that diameter (R0).
fn in_tube(count: usize, diameter: f64) -> Result<Setup> {
    let [throat_length, ramp] = THROAT;
    let shape = TubeShape::Constriction { throat: 0.5 * diameter, throat_length, ramp };
    let region = Region::Tube { radius: 0.5 * WIDTH, shape, drive: Drive::ZeroFlux, length: Some(16.0) };
    let droplet = DropletSetup { centre: [START, 0.0], ..DropletSetup::contractile(-4.0, 10.0) };
    Ok(scene(region, droplet, count))
}

/// That droplet before a constriction of a channel in the plane.
fn in_channel(closed: Drive, width: f64) -> Result<Setup> {
    let [throat_length, ramp] = THROAT;
    let data: Toml = toml::from_str(PLANE)?;
    let scene = data.get("plan").and_then(|plan| plan.get("scene")).context("no scene")?;
    let mut setup: Setup = scene.clone().try_into()?;
    if let Region::Channel { drive, .. } = &mut setup.region {
        *drive = closed;
    }
    let mut scene = Value::try_from(&setup)?;
    let walls = scene.get_mut("walls").and_then(Value::as_array_mut).context("no walls")?;
    for wall in walls {
        let sides = wall.get_mut("outline").and_then(Value::as_table_mut).context("no outline")?;
        for (_, side) in sides.iter_mut() {
            let shape = side.get_mut("constriction").and_then(Value::as_table_mut).context("no constriction")?;
            for (key, value) in [("width", WIDTH), ("throat", width), ("throat-length", throat_length), ("ramp", ramp)]
            {
                shape.insert(key.to_owned(), Value::Float(value));
            }
        }
    }
    Ok(scene.try_into()?)
}

/// What is known of the least throat.
#[derive(Debug)]
struct Boundary {
    /// Throats that are not passed and that are (R0), as far as there are.
    ends: [f64; 2],
    /// Runs, and those that ended in an error, as the film to the wall is thinner than the nodes resolve, judged by how
    /// far they had come.
    runs: usize,
    failed: usize,
}

/// Runs a scene: true where the droplet passes the place `beyond` (R0), and where the run ended in an error.
fn passes(setup: &Setup, beyond: f64) -> Result<[bool; 2]> {
    let mut scene = setup.build()?.scene;
    let mut passage = Passage::new(beyond);
    let failed = match scene.run(TIME).observe(Every::Steps(1), &mut passage).go() {
        Err(SceneError::Observer { source, .. }) if !source.is::<Decided>() => bail!("{source}"),
        Err(SceneError::Observer { .. }) | Ok(_) => false,
        Err(error) => {
            say(error);
            true
        }
    };
    say(format_args!("{:?} at t = {:.1}", passage.verdict(), passage.time()));
    Ok([passage.verdict() == Verdict::Passed, failed])
}

/// Results of two works that are done side by side.
fn both<T: Send>(works: [impl FnOnce() -> Result<T> + Send; 2]) -> Result<[T; 2]> {
    std::thread::scope(|scope| {
        let [first, second] = works.map(|work| scope.spawn(work)).map(ScopedJoinHandle::join);
        let (Ok(first), Ok(second)) = (first, second) else { bail!("a run has panicked") };
        Ok([first?, second?])
    })
}

impl Boundary {
    /// By bisection between a throat that is not passed and one that is; with one end that is not a number where the
    /// first two are not so.
    fn found(setup: impl Fn(f64) -> Result<Setup> + Sync, beyond: f64, ends: [f64; 2]) -> Result<Self> {
        let run = |throat: f64| passes(&setup(throat)?, beyond);
        let [narrow, wide] = both(ends.map(|throat| move || run(throat)))?;
        let failed = [narrow, wide].into_iter().filter(|[_, failed]| *failed).count();
        let mut found = Self { ends, runs: 2, failed };
        match [narrow[0], wide[0]] {
            [false, true] => {}
            [true, _] => found.ends = [f64::NAN, ends[0]],
            _ => found.ends = [ends[1], f64::NAN],
        }
        while found.error() > WITHIN * found.middle() {
            let middle = found.middle();
            let [passed, failed] = run(middle)?;
            found.ends[usize::from(passed)] = middle;
            found.runs += 1;
            found.failed += usize::from(failed);
        }
        Ok(found)
    }

    /// Ends that were found.
    fn known(&self) -> [bool; 2] {
        self.ends.map(f64::is_finite)
    }

    fn middle(&self) -> f64 {
        0.5 * (self.ends[0] + self.ends[1])
    }

    fn error(&self) -> f64 {
        0.5 * (self.ends[1] - self.ends[0])
    }
}

/// Least diameters of throats in tubes, and least widths in the plane with closed ends and with a flux.
pub(super) fn constrictions() -> Result<Table> {
    let [long, ramp] = THROAT;
    let title = format!(
        "Least throats {long} R0 long behind ramps of {ramp} R0 that droplets of activity -4, A = 10 pass by \
         t = {TIME} from x = {START} R0, of tubes of diameter and channels of width {WIDTH} R0, 16 R0 long"
    );
    let header = ["in", "nodes", "not passed", "passed", "half of the bracket over its middle", "runs", "in errors"];
    let mut table = Table::new(&title, &header);
    let beyond = 0.5 * long + ramp + 1.0;
    let work = &|(place, count, ends): (Place, usize, [f64; 2])| match place {
        Place::Tube => Boundary::found(|throat| in_tube(count, throat), beyond, ends),
        Place::Plane(drive) => Boundary::found(|width| in_channel(drive, width), beyond, ends),
    };
    let pair = &|k: usize| both([k, k + 1].map(|k| move || work(CASES[k])));
    let found = both([0, 2].map(|k| move || pair(k)))?;
    for ((place, count, _), found) in CASES.into_iter().zip(found.into_iter().flatten()) {
        let name = match place {
            Place::Tube => "tube, no flux",
            Place::Plane(Drive::ZeroFlux) => "plane, no flux",
            Place::Plane(_) => "plane, no pressure drop",
        };
        let Boundary { ends: [held, passed], failed, runs } = found;
        let of = |known: bool, value: f64| if known { format!("{value:.4}") } else { "-".to_owned() };
        let known = found.known();
        let cells = [name.to_owned(), count.to_string(), of(known[0], held), of(known[1], passed)];
        let error = of(known == [true; 2], found.error() / found.middle());
        let cells: Vec<String> = cells.into_iter().chain([error, runs.to_string(), failed.to_string()]).collect();
        say(cells.join("  "));
        table.push(cells);
    }
    Ok(table)
}
