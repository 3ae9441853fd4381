//! Constrictions of tubes that a droplet passes, beside those of channels in the plane.

use std::error::Error;

use anyhow::{Context, Result, bail};
use motile::active_interface::polygon_moments;
use motile::base::{Drive, Region, TubeShape};
use motile::scene::{Every, SceneError, System};
use motile::setup::{AnyFlow, Built, DropletSetup, Setup};
use motile_cli::run::{Decided, say};

use motile_tests::validation::Table;
use toml::{Table as Toml, Value};

use super::scene;
use crate::tables::Measure;

/// End of the runs, and place on the axis where they start (R0).
const TIME: f64 = 160.0;
const START: f64 = -4.0;
/// How far back from the furthest it has come a droplet counts as turned back (R0).
const BACK: f64 = 1.0;
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
    let mut setup = Setup::from_toml(&scene.as_table().context("no scene")?.to_string())?;
    if let Region::Channel { drive, .. } = &mut setup.region {
        *drive = closed;
    }
    let mut scene: Toml = setup.to_toml()?.parse()?;
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
    Ok(Setup::from_toml(&scene.to_string())?)
}

/// Runs a scene: true where the droplet passes the place `beyond` (R0), and where the run ended in an error.
fn passes(setup: &Setup, beyond: f64) -> Result<[bool; 2]> {
    let Built { mut scene, droplets, .. } = setup.build()?;
    let (mut x, mut furthest) = (START, START);
    let mut follow = |system: &mut System<AnyFlow>| -> Result<(), Box<dyn Error + Send + Sync>> {
        x = polygon_moments(system.body(droplets[0])?.markers())?.centroid.x;
        furthest = furthest.max(x);
        if x > beyond || x < furthest - BACK { Err(Decided.into()) } else { Ok(()) }
    };
    let failed = match scene.run(TIME).observe(Every::Steps(1), &mut follow).go() {
        Err(SceneError::Observer { source, .. }) if !source.is::<Decided>() => bail!("{source}"),
        Err(SceneError::Observer { .. }) | Ok(_) => false,
        Err(error) => {
            say(error);
            true
        }
    };
    say(format_args!("at x = {x:.2} at t = {:.1}", scene.time()));
    Ok([x > beyond, failed])
}

/// What is known of the least throat: throats that are not passed and that are (R0), runs, and those that ended in an
/// error, as the film to the wall is thinner than the nodes resolve, judged by how far they had come.
type Boundary = ([f64; 2], usize, usize);

/// By bisection between a throat that is not passed and one that is; with one end that is not a number where the first
/// two are not so.
fn boundary(setup: impl Fn(f64) -> Result<Setup> + Sync, beyond: f64, mut ends: [f64; 2]) -> Result<Boundary> {
    let run = |throat: f64| passes(&setup(throat)?, beyond);
    let (narrow, wide) = rayon::join(|| run(ends[0]), || run(ends[1]));
    let ([held, first], [passed, second]) = (narrow?, wide?);
    let (mut runs, mut failed) = (2, usize::from(first) + usize::from(second));
    match [held, passed] {
        [false, true] => {}
        [true, _] => ends = [f64::NAN, ends[0]],
        _ => ends = [ends[1], f64::NAN],
    }
    while ends[1] - ends[0] > WITHIN * (ends[0] + ends[1]) {
        let middle = 0.5 * (ends[0] + ends[1]);
        let [passed, in_error] = run(middle)?;
        ends[usize::from(passed)] = middle;
        (runs, failed) = (runs + 1, failed + usize::from(in_error));
    }
    Ok((ends, runs, failed))
}

/// Least diameters of throats in tubes, and least widths in the plane with closed ends and with a flux.
pub(super) fn constrictions() -> Result<Table> {
    let [long, ramp] = THROAT;
    let title = format!(
        "Least throats {long} R0 long behind ramps of {ramp} R0 that droplets of activity -4, A = 10 pass by \
         t = {TIME} from x = {START} R0, of tubes of diameter and channels of width {WIDTH} R0, 16 R0 long"
    );
    let header = "in | nodes | not passed | passed | half of the bracket over its middle | runs | in errors";
    let mut table = Table::new(&title, header);
    let beyond = 0.5 * long + ramp + 1.0;
    let work = |(place, count, ends): (Place, usize, [f64; 2])| match place {
        Place::Tube => boundary(|throat| in_tube(count, throat), beyond, ends),
        Place::Plane(drive) => boundary(|width| in_channel(drive, width), beyond, ends),
    };
    for (place, count, between) in CASES {
        let name = match place {
            Place::Tube => "tube, no flux",
            Place::Plane(Drive::ZeroFlux) => "plane, no flux",
            Place::Plane(_) => "plane, no pressure drop",
        };
        let of = |value: f64| if value.is_finite() { format!("{value:.4}") } else { "-".to_owned() };
        table.measure(format_args!("{name} | {count}"), || {
            let (ends, runs, failed) = work((place, count, between))?;
            let ([held, passed], error) = (ends.map(of), of((ends[1] - ends[0]) / (ends[0] + ends[1])));
            Ok(format!("{held} | {passed} | {error} | {runs} | {failed}"))
        })?;
    }
    Ok(table)
}
