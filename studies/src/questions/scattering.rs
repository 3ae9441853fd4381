//! Encounters of two swimmers in unbounded fluid: how they turn, over the offset of their lines.

use anyhow::Result;
use motile_cli::run::say;
use motile_tests::validation::Table;
use space_droplets::{
    ContractileTension, EdgeFollowing, Repulsion, RungeKuttaChebyshev, SpaceDroplet, SpaceDroplets, StepSize,
};

use crate::tables::Measure;

/// Time between samples, longest run, and tolerance of the steps.
const SAMPLE: f64 = 0.5;
const UNTIL: f64 = 80.0;
const TOLERANCE: f64 = 1e-2;
/// Time in which a swimmer becomes steady alone.
const SETTLED: f64 = 25.0;
/// Gap below which swimmers are in contact (R0).
const CONTACT: f64 = 0.2;
/// Gap above which they have parted (R0).
const PARTED: f64 = 3.0;
/// A repulsion: its strength (force per length squared) and range (R0).
type Pushes = Option<[f64; 2]>;

const REPULSION: Pushes = Some([50.0, 0.4]);

/// A swimmer: name, activity, excluded volume.
type Swimmer = (&'static str, f64, f64);

const PUSHER: Swimmer = ("pusher", -1.0, 2.0);
const PULLER: Swimmer = ("puller", -2.0, 10.0);

/// Two swimmers on lines whose directions differ by an angle (degrees), at an offset across both; each starts so far
/// from the place where the lines are closest (R0).
#[derive(Debug, Clone, Copy)]
struct Meeting {
    swimmer: Swimmer,
    degree: usize,
    angle: f64,
    offset: f64,
    distance: f64,
    repulsion: Pushes,
}

/// How an encounter ends.
#[derive(Debug, Clone, Copy, PartialEq)]
enum End {
    Part,
    Together,
    /// The run ends in an error, because the gap is not resolved.
    Unresolved,
}

/// How an encounter ends, how long and how close the swimmers are together, and how they turn.
#[derive(Debug, Clone, Copy)]
struct Outcome {
    end: End,
    time: f64,
    contact: f64,
    gap: f64,
    /// Angles by which the two swimmers turn, and the part of the first that is away from the other (degrees).
    turned: [f64; 2],
    away: f64,
    /// Angle by which the line between the two turns (degrees).
    line: f64,
    /// Speed at the end over the speed alone.
    speed: f64,
    /// Samples with a warning.
    warned: usize,
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

/// Angle between two vectors (degrees).
fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    (dot(a, b) / (dot(a, a) * dot(b, b)).sqrt()).clamp(-1.0, 1.0).acos().to_degrees()
}

/// A sphere with particles at the rear.
fn sphere((_, activity, strength): Swimmer, degree: usize, heading: [f64; 3]) -> Result<SpaceDroplet> {
    let law = ContractileTension::thesis(10.0, activity, strength, 100.0)?;
    let droplet = SpaceDroplet::sphere(degree, 1.0, [100.0; 2], law)?;
    // Parameters follow the edge of the particles as in scenes.
    let droplet = droplet.with_particles(0.1, |s| 100.0 * (1.0 - 0.9 * dot(s, heading)))?;
    Ok(droplet.with_edge_following(EdgeFollowing { strength: 4.0, time: 1.0 })?)
}

/// A swimmer that has become steady, at time 0 and a place.
fn settled(swimmer: Swimmer, degree: usize, heading: [f64; 3], place: [f64; 3]) -> Result<SpaceDroplet> {
    let mut alone = sphere(swimmer, degree, heading)?;
    let steps = StepSize::Adaptive { tolerance: 1e-3 };
    alone.advance(SETTLED, steps, &mut RungeKuttaChebyshev::new(), |_| {})?;
    let mut droplet = sphere(swimmer, degree, heading)?;
    droplet.resume(0.0, alone.state())?;
    Ok(droplet.with_position(place)?)
}

/// Heading of a swimmer: away from the mean place of its particles, whatever the flow of the other.
fn heading(droplet: &SpaceDroplet) -> [f64; 3] {
    droplet.positions().map(|positions| -positions.iter().zip(droplet.particles()).map(|(x, m)| x * m).sum::<f64>())
}

/// The two swimmers of a meeting at its start, and their speed alone.
fn start(meeting: &Meeting) -> Result<(SpaceDroplets, f64)> {
    let Meeting { swimmer, degree, angle, offset, distance, repulsion } = *meeting;
    let (sin, cos) = angle.to_radians().sin_cos();
    let mut droplets = Vec::new();
    for (direction, side) in [[1.0, 0.0, 0.0], [cos, sin, 0.0]].into_iter().zip([0.5, -0.5]) {
        let place = [-distance * direction[0], -distance * direction[1], side * offset];
        droplets.push(settled(swimmer, degree, direction, place)?);
    }
    let alone = droplets[0].observe()?.speed;
    let pair = SpaceDroplets::new(droplets)?;
    let Some([strength, range]) = repulsion else { return Ok((pair, alone)) };
    Ok((pair.with_repulsion(Repulsion::new(strength, range)?), alone))
}

fn meet(meeting: &Meeting) -> Result<Outcome> {
    let (mut pair, alone) = start(meeting)?;
    let headings = |pair: &SpaceDroplets| [0, 1].map(|k: usize| heading(&pair.droplets()[k]));
    let before = headings(&pair);
    let (mut integrator, mut last, mut line) = (RungeKuttaChebyshev::new(), f64::INFINITY, None);
    let mut found = Outcome {
        end: End::Together,
        time: 0.0,
        contact: 0.0,
        gap: f64::INFINITY,
        turned: [0.0; 2],
        away: 0.0,
        line: 0.0,
        speed: 1.0,
        warned: 0,
    };
    while found.end == End::Together && found.time < UNTIL {
        let steps = StepSize::Adaptive { tolerance: TOLERANCE };
        match pair.advance(found.time + SAMPLE, steps, &mut integrator, |_| {}) {
            Ok(_) => {}
            Err(error) => {
                say(error);
                found.end = End::Unresolved;
                break;
            }
        }
        found.time += SAMPLE;
        let gap = pair.gap(0, 1)?;
        found.gap = found.gap.min(gap);
        found.contact += if gap < CONTACT { SAMPLE } else { 0.0 };
        found.warned += usize::from(!pair.droplets()[0].warnings().is_empty());
        let (one, other) = (pair.observe(0)?, pair.observe(1)?);
        let now = std::array::from_fn(|i| other.position[i] - one.position[i]);
        found.line += line.map_or(0.0, |before| angle(before, now));
        line = Some(now);
        found.speed = one.speed / alone;
        if gap > PARTED && gap > last {
            found.end = End::Part;
        }
        last = gap;
    }
    let after = headings(&pair);
    found.turned = [0, 1].map(|k| angle(before[k], after[k]));
    found.away = (after[0][2] / dot(after[0], after[0]).sqrt()).asin().to_degrees();
    Ok(found)
}

/// Meetings of one kind at these offsets.
fn over(kind: Meeting, offsets: &[f64]) -> impl Iterator<Item = Meeting> {
    offsets.iter().map(move |&offset| Meeting { offset, ..kind })
}

/// Outcomes of meetings.
pub(super) fn scattering() -> Result<Vec<Table>> {
    let header = "swimmer | angle | offset | distance | repulsion | degree | end | at | contact | smallest gap | \
                  turned by | other by | away | line by | speed | warned";
    let mut table = Table::new("Two swimmers that meet in unbounded fluid", header);
    let pushers =
        Meeting { swimmer: PUSHER, degree: 8, angle: 180.0, offset: 0.0, distance: 3.0, repulsion: REPULSION };
    let meetings = over(Meeting { degree: 10, ..pushers }, &[0.25, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0])
        .chain(over(pushers, &[0.0, 1.0]))
        .chain(over(Meeting { repulsion: None, ..pushers }, &[1.0]))
        .chain(over(Meeting { angle: 90.0, ..pushers }, &[0.0, 1.0, 2.5]))
        .chain(over(Meeting { swimmer: PULLER, ..pushers }, &[2.5]))
        .chain(over(Meeting { degree: 14, ..pushers }, &[0.25, 1.0]))
        .chain(over(Meeting { swimmer: PULLER, degree: 12, ..pushers }, &[1.0, 1.5]));
    for meeting in meetings {
        let Meeting { swimmer: (name, ..), degree, angle, offset, distance, repulsion } = meeting;
        let range = repulsion.map_or_else(|| "off".to_owned(), |[_, range]| range.to_string());
        table.measure(format_args!("{name} | {angle} | {offset} | {distance} | {range} | {degree}"), || {
            let found = meet(&meeting)?;
            let Outcome { end, time, contact, gap, turned: [one, other], away, line, speed, warned } = found;
            let end = match end {
                End::Part => "part",
                End::Together => "together",
                End::Unresolved => "not resolved",
            };
            Ok(format!(
                "{end} | {time} | {contact:.1} | {gap:.3} | {one:.1} | {other:.1} | {away:.1} | {line:.0} | \
                 {speed:.3} | {warned}"
            ))
        })?;
    }
    Ok(vec![table])
}
