//! Errors of the default steps, in scenes of all kinds.

use std::f64::consts::PI;

use anyhow::Result;
use motile::base::{Drive, Region, Vec2};
use motile::elastic_solids::ChannelShape;
use motile::scene::StepSize;
use motile::setup::{
    Built, DropletSetup, ExchangeSetup, GridMethod, LayersMethod, Material, Method, Particles, RigidBodySetup, Setup,
    SolidSetup,
};
use motile_tests::validation::{Table, scene::open_channel};

use crate::tables::Measure as _;

/// Tolerance of the steps that the default is compared with.
const FINE: f64 = 1e-6;
/// Looks at a run.
const LOOKS: usize = 100;

/// Quantity whose error is measured.
#[derive(Debug, Clone, Copy)]
enum Measure {
    /// Speed at the end.
    Speed,
    /// Change of the heading over the second half of the run, per time.
    Turning,
    /// Half the range of heights over the second half of the run: amplitude of a lateral cycle.
    Amplitude,
}

/// Scenes, the times that they are run to, and what is measured.
fn scenes() -> Vec<(&'static str, Setup, f64, Measure)> {
    let of = |activity: f64| Setup { droplets: vec![DropletSetup::active(activity)], ..Setup::default() };
    let grid = |spacing: f64| Setup { method: Method::Grid(GridMethod::of_spacing(spacing)), ..Setup::default() };
    let crowded = Setup { droplets: vec![DropletSetup::contractile(-4.0, 40.0)], ..Setup::default() };
    let contrast = |inside: f64, outside: f64| {
        let droplet = DropletSetup { viscosity: Some(inside), ..DropletSetup::default() };
        Setup { viscosity: outside, droplets: vec![droplet], ..Setup::default() }
    };
    let channel = |width: f64, activity: f64, aside: f64| {
        let droplet = DropletSetup { centre: [0.0, aside], ..DropletSetup::active(activity) };
        Setup { region: open_channel(12.0, width), droplets: vec![droplet], ..Setup::default() }
    };
    let meeting = |method: Method| {
        let droplet = |x: f64, angle: f64| DropletSetup {
            name: format!("droplet at {x}"),
            centre: [x, -0.3 * x],
            angle,
            ..DropletSetup::default()
        };
        let region = Region::Box { lengths: [12.0, 8.0] };
        Setup { region, method, droplets: vec![droplet(-2.0, 0.0), droplet(2.0, PI)], ..Setup::default() }
    };
    let nucleus = |region: Region| {
        let core = RigidBodySetup { centre: [0.1, 0.2], ..RigidBodySetup::disc(0.4) };
        Setup { region, rigid_bodies: vec![core], ..of(-4.0) }
    };
    let exchange = |diffusion: f64| {
        let exchange = ExchangeSetup { diffusion_inside: Some(diffusion), ..ExchangeSetup::new(1.0, 1.0) };
        let particles = Particles { activity: -4.0, exchange: Some(exchange), ..Particles::default() };
        Setup {
            droplets: vec![DropletSetup { particles: Some(particles), ..DropletSetup::default() }],
            ..Setup::default()
        }
    };
    let elastic = Setup {
        region: Region::Channel { length: 6.0, width: 4.0, drive: Drive::ZeroGradient },
        method: Method::Layers(LayersMethod::of_spacing(0.1)),
        solids: SolidSetup::walls(
            &ChannelShape::Straight { width: 2.2 },
            &Material::NeoHookean { shear: 1000.0, bulk: 2000.0 },
        ),
        ..of(-4.0)
    };
    let Setup { method, .. } = Setup::default();
    use Measure::{Amplitude, Speed, Turning};
    vec![
        ("swimmer in a box", Setup::default(), 60.0, Speed),
        ("the same for long", Setup::default(), 200.0, Speed),
        ("activity -4", of(-4.0), 60.0, Speed),
        ("activity -4, A = 40", crowded, 60.0, Speed),
        ("viscosity 10 in 100", contrast(10.0, 100.0), 60.0, Speed),
        ("viscosity 1000 in 10", contrast(1000.0, 10.0), 60.0, Speed),
        ("channel of width 2, activity -4", channel(2.0, -4.0, 0.0), 60.0, Speed),
        ("channel of width 5, activity -5: cycle", channel(5.0, -5.0, 0.3), 200.0, Amplitude),
        ("two droplets with a film", meeting(method), 20.0, Speed),
        ("nucleus in the plane, activity -4", nucleus(Region::Plane), 20.0, Turning),
        ("nucleus in a box, activity -4", nucleus(Region::Box { lengths: [6.0; 2] }), 20.0, Turning),
        ("exchange, D_b = 1, activity -4", exchange(1.0), 4.0, Speed),
        ("elastic channel, h = 0.1, activity -4", elastic, 2.0, Speed),
        ("grid, h = 0.1", grid(0.1), 60.0, Speed),
        ("grid, h = 0.05", grid(0.05), 10.0, Speed),
        ("grid, h = 0.1, activity -4", Setup { droplets: of(-4.0).droplets, ..grid(0.1) }, 60.0, Speed),
        ("grid, h = 0.1, two droplets with a film", meeting(grid(0.1).method), 20.0, Speed),
    ]
}

/// One run.
struct Found {
    value: f64,
    place: Vec2,
    steps: usize,
    retried: usize,
}

fn found(setup: &Setup, until: f64, measure: Measure) -> Result<Found> {
    let Built { mut scene, droplets, .. } = setup.build()?;
    let (mut heights, mut turned, mut last) = (Vec::new(), 0.0, None);
    for look in 1..=LOOKS {
        scene.run(until * look as f64 / LOOKS as f64).go()?;
        let seen = scene.observe(droplets[0])?;
        if 2 * look >= LOOKS {
            heights.push(seen.centroid.y);
            if let Some(heading) = seen.heading().map(Vec2::from_angle) {
                turned += last.replace(heading).map_or(0.0, |before: Vec2| before.angle_to(heading));
            }
        }
    }
    let seen = scene.observe(droplets[0])?;
    let [low, high] = [f64::min, f64::max].map(|pick| heights.iter().copied().reduce(pick).unwrap_or(f64::NAN));
    let value = match measure {
        Measure::Speed => seen.speed(),
        Measure::Turning => turned / (0.5 * until),
        Measure::Amplitude => 0.5 * (high - low),
    };
    let report = scene.step_report();
    Ok(Found { value, place: seen.centroid, steps: scene.steps(), retried: report.rejections + report.failures })
}

pub(super) fn default_steps() -> Result<Table> {
    let title = "Errors of the default steps, against adaptive ones of 1e-6: of the speed at the end, of the rate of \
                 turning or of a cycle's amplitude, and of the position at the end (R0)";
    let columns = "scene | time | measured | value | error in % | of position | steps | retried | steps at 1e-6";
    let mut table = Table::new(title, columns);
    for (name, setup, until, measure) in scenes() {
        table.measure(format_args!("{name} | {until} | {}", format!("{measure:?}").to_lowercase()), || {
            let fine = Setup { step: StepSize::Adaptive { tolerance: FINE }, ..setup.clone() };
            let runs = found(&setup, until, measure).and_then(|found_| Ok((found_, found(&fine, until, measure)?)));
            Ok(match runs {
                Ok((Found { value, place, steps, retried }, fine)) => {
                    let error = 100.0 * (value / fine.value - 1.0).abs();
                    let apart = place.distance(fine.place);
                    format!("{value:.6} | {error:.1e} | {apart:.1e} | {steps} | {retried} | {}", fine.steps)
                }
                Err(error) => format!("ends: {error} |  |  |  |  | "),
            })
        })?;
    }
    Ok(table)
}
