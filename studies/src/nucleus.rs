//! Droplets with a nucleus: whether they swim in circles.
//!
//! `cargo run --release -p studies -- nucleus` prints two tables, which `--write` keeps as `docs/tables/nucleus.csv`:
//! steady states with a rigid nucleus that runs lead to, found by Newton's method from their ends, and the branch of
//! those that swim in circles over the radius of the nucleus. With `--elastic` it prints one of runs with an elastic
//! nucleus that nothing holds, as Cowley's, and with a rigid one in the same box (`docs/tables/nucleus-elastic.csv`).

use anyhow::{Context, Result};
use clap::Args;
use motile::base::Region;
use motile::base::Vec2;
use motile::setup::{
    Built, DropletSetup, Hold, IntegralMethod, LayersMethod, Material, Method, RigidBodySetup, Setup, SolidOutline,
    SolidSetup,
};
use motile_cli::command_line::positive;
use motile_cli::run::{explained, say};

use crate::track::turning_rate;
use motile_steady_states::{Parameter, Profile, SteadyState};
use motile_tests::validation::Table;

use crate::tables::{self, Measure, all_wanted};

/// Circles of droplets with a nucleus.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Time to which they swim before Newton's method takes over
    #[arg(long, default_value_t = 60.0, value_parser = positive)]
    time: f64,
    /// Runs with an elastic nucleus
    #[arg(long)]
    elastic: bool,
    #[command(flatten)]
    keep: tables::Keep,
}

/// Activity, viscosity of the droplet, radius and place of the nucleus.
type Scene = (f64, f64, f64, [f64; 2]);

const ASIDE: [f64; 2] = [0.05, 0.15];

const SCENES: [Scene; 11] = [
    (-1.0, 100.0, 0.3, ASIDE),
    (-1.0, 100.0, 0.5, ASIDE),
    (-1.0, 100.0, 0.5, [-0.3, 0.25]),
    (-1.0, 100.0, 0.7, ASIDE),
    (-2.0, 100.0, 0.3, ASIDE),
    (-2.0, 100.0, 0.5, ASIDE),
    (-2.0, 100.0, 0.7, ASIDE),
    (-4.0, 100.0, 0.5, ASIDE),
    (-4.0, 100.0, 0.7, ASIDE),
    (-2.0, 20.0, 0.5, ASIDE),
    (-2.0, 500.0, 0.5, ASIDE),
];
/// Nodes of the runs and of the steady states.
const NODES: [usize; 2] = [48, 72];
/// Radii of the branch, and the scene it starts from.
const RADII: [f64; 12] = [0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65, 0.7, 0.75];
const FROM: Scene = (-1.0, 100.0, 0.5, ASIDE);

fn setup(&(activity, viscosity, radius, centre): &Scene, nodes: usize) -> Setup {
    Setup {
        region: Region::Plane,
        method: Method::Integral(IntegralMethod { nodes, elements: 4 * nodes }),
        droplets: vec![DropletSetup { viscosity: Some(viscosity), ..DropletSetup::active(activity) }],
        rigid_bodies: vec![RigidBodySetup { centre, ..RigidBodySetup::disc(radius) }],
        ..Setup::default()
    }
}

/// The steady state that a run leads to.
fn found(of: &Scene, time: f64) -> Result<SteadyState> {
    let Built { mut scene, droplets, rigid_bodies, .. } = setup(of, NODES[0]).build()?;
    let droplet = *droplets.first().context("no droplet")?;
    let nucleus = *rigid_bodies.first().context("no nucleus")?;
    scene.run(time).go()?;
    let (seen, disc) = (scene.observe(droplet)?, scene.observe(nucleus)?);
    // About its centroid, on its way along x.
    let back = seen.velocity.try_normalize().unwrap_or(Vec2::X) * Vec2::new(1.0, -1.0);
    let moved = |x: Vec2| back.rotate(x - seen.centroid);
    let body = scene.body(droplet)?;
    let markers: Vec<Vec2> = body.markers().iter().map(|x| moved(*x)).collect();
    let profile = Profile::from_markers(&markers, body.particle_numbers())?.with_nuclei(vec![moved(disc.centre)]);
    Ok(SteadyState::near(&setup(of, NODES[1]), &profile, Vec2::new(seen.speed(), 0.0), false)?)
}

const VALUES: &str =
    "speed | turning rate | track radius | offset | aside | least film | growth | frequency | last modes";

fn values(state: &SteadyState) -> Result<String> {
    let (seen, velocity) = (state.measured()?, state.velocity());
    let profile = state.profile();
    let centre = *profile.nuclei.first().context("no nucleus")?;
    let radius = Parameter::NucleusRadius.get(state.setup()).context("no nucleus")?;
    let film = profile.positions.iter().map(|x| x.distance(centre) - radius).fold(f64::INFINITY, f64::min);
    let offset = centre - seen.centroid;
    let leading = state.spectrum()?.leading().map(|mode| mode.value).unwrap_or_default();
    let turning = state.turning_rate();
    let straight = turning.abs() < 1e-8;
    let (turns, radius) = match straight {
        true => ("0".to_owned(), "straight".to_owned()),
        false => (format!("{turning:+.5}"), format!("{:.3}", seen.speed / turning.abs())),
    };
    Ok(format!(
        "{:.5} | {turns} | {radius} | {:.4} | {:+.4} | {film:.3} | {:+.4} | {:.4} | {:.0e}",
        seen.speed,
        offset.length(),
        velocity.try_normalize().unwrap_or(Vec2::X).perp_dot(offset),
        leading.re,
        leading.im,
        state.tail()
    ))
}

/// A row, or what went wrong.
fn push(table: &mut Table, row: &str, state: Result<SteadyState>) -> Option<SteadyState> {
    let (values, state) = match state.and_then(|state| Ok((values(&state)?, state))) {
        Ok((values, state)) => (values, Some(state)),
        Err(error) => (explained(&error), None),
    };
    say(format_args!("{row} | {values}"));
    table.row(format_args!("{row} | {values}"));
    state
}

/// Activities, shear moduli (stress), and radius of elastic nuclei, side of the box, grid spacing, end of the runs.
const ACTIVITIES: [f64; 2] = [-1.0, -2.0];
const SHEARS: [f64; 3] = [50.0, 200.0, 1000.0];
const RADIUS: f64 = 0.5;
const SIDE: f64 = 8.0;
const SPACING: f64 = 0.1;
const END: f64 = 160.0;
/// Looks at a run.
const LOOKS: u32 = 320;

/// Runs with an elastic nucleus, or with a rigid one where no modulus is given: speed, turning rate, and place of the
/// nucleus aside of the line of motion.
fn circle(activity: f64, shear: Option<f64>) -> Result<[f64; 3]> {
    let mut setup = setup(&(activity, 100.0, RADIUS, ASIDE), NODES[0]);
    setup.region = Region::Box { lengths: [SIDE; 2] };
    if let Some(shear) = shear {
        setup.rigid_bodies.clear();
        setup.method = Method::Layers(LayersMethod::of_spacing(SPACING));
        let disc = SolidOutline::Disc { centre: ASIDE, radius: RADIUS };
        let disc = SolidSetup::new(disc, Material::NeoHookean { shear, bulk: 2.0 * shear });
        setup.solids = vec![SolidSetup { hold: Hold::Free, ..disc }];
    }
    let Built { mut scene, droplets, rigid_bodies, solids, .. } = setup.build()?;
    let droplet = *droplets.first().context("no droplet")?;
    let (mut headings, mut last) = (Vec::new(), [0.0; 3]);
    for look in 1..=LOOKS {
        scene.run(END * f64::from(look) / f64::from(LOOKS)).go()?;
        let seen = scene.observe(droplet)?;
        let centre = match (rigid_bodies.first(), solids.first()) {
            (Some(disc), _) => scene.observe(*disc)?.centre,
            (None, Some(disc)) => {
                let points = scene.body(*disc)?.positions();
                points.iter().sum::<Vec2>() / points.len() as f64
            }
            (None, None) => Vec2::ZERO,
        };
        headings.push((scene.time(), seen.velocity.y.atan2(seen.velocity.x).to_degrees()));
        let along = seen.velocity.try_normalize().unwrap_or(Vec2::X);
        last = [seen.speed(), 0.0, along.perp_dot(centre - seen.centroid)];
    }
    last[1] = turning_rate(&headings).context("too few looks")?;
    Ok(last)
}

fn elastic(keep: tables::Keep) -> Result<()> {
    let columns = "activity | shear modulus | speed | turning rate | track radius | aside";
    let title = format!(
        "Droplets with a free elastic nucleus of {RADIUS} R0, box of {SIDE} x {SIDE}, h = {SPACING}: means of t = {} \
         to {END}; place of the nucleus in the end",
        END / 2.0
    );
    let mut table = Table::new(&title, columns);
    for activity in ACTIVITIES {
        for shear in SHEARS.map(Some).into_iter().chain([None]) {
            let name = shear.map_or("rigid".to_owned(), |shear| shear.to_string());
            table.measure(format_args!("{activity} | {name}"), || {
                let [speed, turning, aside] = circle(activity, shear)?;
                Ok(format!("{speed:.5} | {turning:+.5} | {:.3} | {aside:+.4}", speed / turning.abs()))
            })?;
        }
    }
    keep.tables("nucleus-elastic", "nucleus --elastic", &[table])
}

pub(crate) fn run(flags: &Flags) -> Result<()> {
    if flags.elastic {
        return elastic(flags.keep);
    }
    let columns = format!("activity | viscosity | radius | start | {VALUES}");
    let mut table = Table::new("Steady droplets with a rigid nucleus, and the mode that grows fastest", &columns);
    for scene in &SCENES {
        let (activity, viscosity, radius, [x, y]) = scene;
        table.measure(format_args!("{activity} | {viscosity} | {radius} | {x}, {y}"), || {
            Ok(found(scene, flags.time).and_then(|state| values(&state)).unwrap_or_else(|error| explained(&error)))
        })?;
    }
    let title = "Droplets of activity -1 that swim in circles, over the radius of the nucleus";
    let mut branch = Table::new(title, &format!("radius | {VALUES}"));
    let (before, after): (Vec<f64>, Vec<f64>) = RADII.into_iter().partition(|radius| *radius < FROM.2);
    if !all_wanted() {
        return flags.keep.tables("nucleus", "nucleus", &[table]);
    }
    let first = found(&FROM, flags.time).context("there is no state to start from")?;
    for list in [before.into_iter().rev().collect::<Vec<_>>(), after] {
        let mut state = first.clone();
        for radius in list {
            let next = Parameter::NucleusRadius.with(state.setup(), radius);
            let next = next.and_then(|setup| SteadyState::near(&setup, state.profile(), state.velocity(), false));
            match push(&mut branch, &radius.to_string(), next.map_err(Into::into)) {
                Some(next) => state = next,
                None => break,
            }
        }
    }
    flags.keep.tables("nucleus", "nucleus", &[table, branch])
}
