//! An active droplet swims in a periodic box.
//!
//! `cargo run --release --example swimming_droplet` simulates it until it swims steadily, prints what was measured, and
//! writes to `out/swimming_droplet/`:
//!
//! * `final.png`, a picture of the final state, and `swim.gif`, an animation of the run;
//! * `time_series.svg` and `concentration_profile.svg`, plots (also as PNG);
//! * `trajectory.csv`, all observables over time, and `summary.json`, the results;
//! * `vtk/fields.pvd` and `vtk/interface.pvd`, the flow and the interface for ParaView.
//!
//! `--help` lists the flags.

use std::{path::Path, process::ExitCode};

use anyhow::{Context, Result};
use clap::Parser;
use motile::Swimmer;
use motile::active_interface::{Frame, concentration_profile};
use motile::ib_core::{Every, Hydrodynamics, Vec2};
use support::{
    BoxFlags, Dial, DropletFlags, Film, Look, MethodFlags, OutputFlags, Recorder, RunCost, Snapshot, Steadiness,
    VtkOutput, check_run, concentration_plot, domain_raster, droplet_summary, time_series,
};

/// Rows of the trajectory, frames of the animation and files for ParaView in a run.
const ROWS: f64 = 1000.0;
const FRAMES: f64 = 60.0;
const FILES: f64 = 20.0;
/// Most cells in a direction of the fields in pictures and files.
const MOST_CELLS: usize = 512;

/// An active droplet swims in a periodic box.
#[derive(Debug, Parser)]
struct Flags {
    #[command(flatten)]
    droplet: DropletFlags,
    #[command(flatten)]
    region: BoxFlags,
    #[command(flatten)]
    method: MethodFlags,
    #[command(flatten)]
    output: OutputFlags,
}

fn main() -> ExitCode {
    support::run(swim)
}

fn swim(flags: &Flags) -> Result<()> {
    // The droplet, in the middle of its box unless an offset is given, and the box.
    flags.region.cells(&flags.method)?;
    let side = flags.region.side;
    let swimmer =
        Swimmer { lengths: [side, side], offset: flags.region.offset, ..flags.droplet.swimmer(&flags.method) };
    let (mut scene, droplet) = swimmer.build()?;
    check_run(&mut scene, flags.method.time, swimmer.step)?;
    let start = scene.body(droplet);
    let start_frame = Frame::new(Vec2::zeros(), swimmer.angle)?;
    let start_profile = concentration_profile(start.markers(), start.particle_numbers(), &start_frame)?;

    // What watches the run.
    let directory = flags.output.directory("swimming_droplet")?;
    let end = flags.method.time;
    let domain = scene.system().hydrodynamics().medium().domain;
    let raster = domain_raster(&domain, swimmer.spacing, MOST_CELLS)?;
    let look = Look {
        caption: caption(&swimmer),
        concentration: swimmer.mean_concentration,
        walls: None,
        streamline_spacing: 0.24,
    };
    let mut dial = Dial::new(end, flags.output.quiet, droplet);
    let mut recorder = Recorder::create(&directory.join("trajectory.csv"), scene.system_mut(), droplet)?;
    let mut film = Film::new(look.clone(), &raster)?;
    let mut vtk = None;

    // The run.
    let mut run = scene
        .run(end)
        .step_size(swimmer.step)
        .observe(Every::Time(end / ROWS), &mut recorder)
        .observe(Every::Steps(1), &mut dial);
    if !flags.output.no_pictures {
        let vtk = vtk.insert(VtkOutput::create(&directory.join("vtk"), raster, droplet)?);
        run = run.observe(Every::Time(end / FRAMES), &mut film).observe(Every::Time(end / FILES), vtk);
    }
    let outcome = run.go();
    let seconds = dial.finish();

    // The results, also of a run that broke off.
    recorder.finish(scene.system_mut())?;
    let cost = RunCost {
        time: scene.time(),
        steps: scene.steps(),
        seconds,
        stokes_solves: scene.system().hydrodynamics().work().stokes_solves,
        failure: outcome.as_ref().err().map(ToString::to_string),
    };
    let (first, last) = recorder.first().zip(recorder.last()).context("nothing was measured")?;
    let speeds = recorder.trajectory().curve("time", "speed")?;
    let steadiness = Steadiness::of(&speeds, swimmer.diffusion / swimmer.radius.powi(2));
    let summary = droplet_summary(first, last, &steadiness, &cost, swimmer.mean_concentration);
    summary.write(&directory.join("summary.json"))?;
    print!("{}", summary.table());

    if !flags.output.no_pictures {
        let body = scene.body(droplet);
        let frame = Frame::of_motion(last.centroid, last.velocity)?;
        let profile = concentration_profile(body.markers(), body.particle_numbers(), &frame)?;
        concentration_plot(&start_profile, &profile, cost.time, swimmer.mean_concentration)?
            .write(&directory, "concentration_profile")?;
        time_series(recorder.trajectory())?.write(&directory, "time_series")?;
        look.write_picture(&Snapshot::take(scene.system_mut(), raster)?, &[], &directory.join("final.png"))?;
        film.write(false, &directory.join("swim.gif"))?;
    }
    println!("results in {}", shown(&directory));
    Ok(outcome?)
}

fn caption(swimmer: &Swimmer) -> String {
    let Swimmer { activity, excluded_volume, viscosity, .. } = swimmer;
    format!("ζΔμ = {activity},  A = {excluded_volume},  η = {viscosity}").replace('-', "−")
}

fn shown(directory: &Path) -> String {
    format!("{}{}", directory.display(), std::path::MAIN_SEPARATOR)
}
