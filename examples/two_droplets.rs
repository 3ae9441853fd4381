//! Two active droplets meet in a periodic box: head-on, side by side, or one behind the other.
//!
//! `cargo run --release --example two_droplets` simulates two droplets that swim past each other, prints where they
//! are in the end and how close they came, and writes to `out/two_droplets/`:
//!
//! * `final.png`, a picture of the final state;
//! * `trajectory.csv`, positions, speeds and the distance over time, and `summary.json`, the results.
//!
//! `--help` lists the flags.

use std::process::ExitCode;

use anyhow::{Result, ensure};
use clap::{Parser, ValueEnum};
use motile::active_interface::{
    ActiveDroplet,
    observables::{InterfaceState, centroid_velocity},
    polygon_moments,
};
use motile::base::Region;
use motile::base::Vec2;
use motile::scene::{Handle, System};
use motile::setup::{AnyFlow, Built, DropletSetup, Particles};
use motile_cli::run::{Job, OutputFlags, Summary};
use motile_examples::{DropletFlags, MethodFlags, pair, positive};
use motile_output::{CsvTable, Look, Raster, Snapshot};

/// How the droplets start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Meeting {
    /// Towards each other.
    HeadOn,
    /// Abreast, the same way.
    SideBySide,
    /// One behind the other, the same way.
    LeaderAndFollower,
}

/// Two active droplets meet in a periodic box.
#[derive(Debug, Parser)]
#[command(after_help = "The default run takes 1,187 steps, 2,375 evaluations of the flow.")]
struct Flags {
    /// How the droplets start
    #[arg(long, value_enum, default_value_t = Meeting::HeadOn)]
    meeting: Meeting,
    /// Distance of their centres at the start (R0); without it 4, and side by side half of the box
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    distance: Option<f64>,
    /// Distance of their paths at the start (R0), across the first one's; without it 2.5 head-on, so that they pass
    /// each other, and 0 otherwise. Head-on with less than about 1.5 their interfaces come to touch, which ends the run
    #[arg(long, value_parser = motile_examples::not_negative, allow_hyphen_values = true)]
    lateral_offset: Option<f64>,
    /// Sides of the box (R0)
    #[arg(long = "box", value_name = "X,Y", default_value = "12,8", value_parser = pair, allow_hyphen_values = true)]
    sides: [f64; 2],
    /// Activity of the second droplet; without it that of the first
    #[arg(long, value_parser = motile_examples::finite, allow_hyphen_values = true)]
    second_activity: Option<f64>,
    /// Viscosity of the second droplet; without it that of the first
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    second_viscosity_in: Option<f64>,
    #[command(flatten)]
    droplet: DropletFlags,
    #[command(flatten)]
    method: MethodFlags,
    #[command(flatten)]
    output: OutputFlags,
}

fn main() -> ExitCode {
    motile_examples::run(meet)
}

fn meet(flags: &Flags) -> Result<()> {
    let (along, usual) = match flags.meeting {
        Meeting::SideBySide => (flags.sides[1], 0.5 * flags.sides[1]),
        Meeting::HeadOn | Meeting::LeaderAndFollower => (flags.sides[0], 4.0),
    };
    let distance = flags.distance.unwrap_or(usual);
    ensure!(
        distance > 2.0 && distance < along - 2.0,
        "--distance {distance}: the droplets or their images overlap, give more than 2 and less than {}",
        along - 2.0
    );
    let usual = if flags.meeting == Meeting::HeadOn { 2.5 } else { 0.0 };
    let aside = flags.lateral_offset.unwrap_or(usual);
    ensure!(
        flags.lateral_offset.is_none() || flags.meeting != Meeting::SideBySide,
        "--lateral-offset means nothing side by side: give --distance"
    );
    ensure!(
        aside <= 0.5 * flags.sides[1],
        "--lateral-offset {aside} is nearer to an image: give at most half of the box, {}",
        0.5 * flags.sides[1]
    );
    // Both droplets: where they start and which way they swim.
    let (half, aside) = (0.5 * distance, 0.5 * aside);
    let (places, second_angle) = match flags.meeting {
        Meeting::HeadOn => ([[-half, -aside], [half, aside]], 180.0),
        Meeting::SideBySide => ([[0.0, -half], [0.0, half]], 0.0),
        Meeting::LeaderAndFollower => ([[-half, -aside], [half, aside]], 0.0),
    };
    let mut setup = flags.method.setup(&flags.droplet, None)?;
    setup.region = Region::Box { lengths: flags.sides };
    // Films that a method cannot see drain until the droplets overlap: that is an error here.
    setup.least_gap = setup.least_gap.or(Some(0.0));
    let first = DropletSetup { name: "first droplet".to_owned(), centre: places[0], ..setup.droplets[0].clone() };
    let activity = flags.second_activity.unwrap_or(first.activity());
    let second = DropletSetup {
        name: "second droplet".to_owned(),
        centre: places[1],
        angle: first.angle + f64::to_radians(second_angle),
        viscosity: flags.second_viscosity_in.or(first.viscosity),
        particles: first.particles.map(|particles| Particles { activity, ..particles }),
        ..first.clone()
    };
    setup.droplets = vec![first, second];
    let Built { mut scene, droplets, .. } = setup.build()?;
    let (droplets, sides) = ([droplets[0], droplets[1]], Vec2::from(flags.sides));

    // The run, observed.
    let mut job = Job::new(&mut scene, &setup, flags.method.time, &flags.output, "two_droplets")?;
    let names = ["time", "x1", "y1", "speed1", "x2", "y2", "speed2", "distance"];
    let path = job.directory.join("trajectory.csv");
    let mut table = CsvTable::of_run(path, &names, scene.system_mut(), "two droplets")?;
    let mut record = |system: &mut System<AnyFlow>| -> Result<()> {
        let row = look(system, droplets, sides)?;
        Ok(table.push_state(system, &row)?)
    };
    job.go(&mut scene, vec![(job.each_row(), &mut record)])?;

    // The results, also of a run that broke off.
    let [_, x1, y1, speed1, x2, y2, speed2, distance] = look(scene.system_mut(), droplets, sides)?;
    let mut summary = Summary::default();
    summary.put("first", [x1, y1].to_vec(), "position of the first droplet (R0)");
    summary.put("second", [x2, y2].to_vec(), "position of the second droplet (R0)");
    summary.put("first_speed", speed1, "(R0 per time)");
    summary.put("second_speed", speed2, "(R0 per time)");
    summary.put("distance", distance, "of the centres (R0)");
    summary.put("minimum_gap", scene.system().minimum_gap(), "between the interfaces, over the run (R0)");
    summary.put(
        "repulsion",
        flags.method.repulsion.map(|values| values.to_vec()),
        "strength and range, if there was one",
    );
    for (name, droplet) in ["first_area_change", "second_area_change"].into_iter().zip(droplets) {
        let body = scene.body(droplet)?;
        let change = polygon_moments(body.markers())?.area / body.initial_area() - 1.0;
        summary.put(name, change, "relative, since the start");
    }
    job.put_cost(&mut summary, &scene);
    let (draws, picture) = (job.draws(), job.directory.join("final.png"));
    job.finish(&summary, || {
        if draws {
            let raster = Raster::of(scene.system(), flags.method.spacing(&setup))?;
            let seen = Snapshot::take(scene.system_mut(), raster)?;
            let concentration = setup.droplets[0].particles.map(|particles| particles.concentration);
            let [first, second] = [0, 1].map(|index| setup.droplets[index].activity());
            let caption = format!("activities {first} and {second}, viscosity outside {}", setup.viscosity);
            flags.output.look.apply(Look { caption, concentration, ..Look::of(&setup) }).write_picture(
                &seen,
                &[],
                picture,
            )?;
        }
        Ok(())
    })
}

/// Time, position and speed of both droplets in a box of these sides, and the distance of their centres or nearest
/// images.
fn look(system: &mut System<AnyFlow>, droplets: [Handle<ActiveDroplet>; 2], sides: Vec2) -> Result<[f64; 8]> {
    system.evaluate()?;
    let mut seen = [(Vec2::ZERO, 0.0); 2];
    for ((place, speed), droplet) in seen.iter_mut().zip(droplets) {
        let state = InterfaceState::of(system, droplet)?;
        *place = polygon_moments(state.markers)?.centroid;
        *speed = centroid_velocity(state.markers, state.velocities)?.length();
    }
    let [(a, speed1), (b, speed2)] = seen;
    let apart = b - a;
    let distance = (apart - sides * (apart / sides).round()).length();
    Ok([system.time(), a.x, a.y, speed1, b.x, b.y, speed2, distance])
}
