//! A run from the flags to the files.

use std::path::{Path, PathBuf};

use motile::Swimmer;
use motile_examples::{OutputFlags, Summary, WatchedRun, caption};

fn directory(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("motile-{name}-{}", std::process::id()))
}

fn output(directory: &Path, no_pictures: bool) -> OutputFlags {
    OutputFlags { no_pictures, quiet: true, out: Some(directory.to_path_buf()), ..OutputFlags::default() }
}

#[test]
fn a_run_in_a_channel_leaves_all_its_files() {
    let directory = directory("channel-run");
    let swimmer = Swimmer { spacing: 0.25, lengths: [6.0, 3.0], ..Swimmer::default() };
    let (mut scene, droplet) = swimmer.build_in_channel(motile::stokes_grid::Drive::ZeroGradient).unwrap();
    let (flags, title) = (output(&directory, false), caption(&swimmer));
    let mut run = WatchedRun::new(&mut scene, droplet, &swimmer, 1.0, &flags, "", title).unwrap();
    run.go(&mut scene).unwrap().unwrap();
    let summary = run.summary().unwrap();
    run.write_pictures(&mut scene).unwrap();

    let files =
        ["final.png", "swim.gif", "time_series.svg", "concentration_profile.png", "trajectory.csv", "vtk/fields.pvd"];
    for file in files {
        assert!(directory.join(file).metadata().is_ok_and(|data| data.len() > 200), "{file}");
    }
    let header = std::fs::read_to_string(directory.join("trajectory.csv")).unwrap();
    assert!(header.starts_with("time,x,y,") && header.lines().next().unwrap().contains(",gap,"));
    assert_eq!(run.recorder().table().rows().len(), run.recorder().records().len());
    assert_eq!(summary.number("time"), 1.0);
    assert!(summary.number("speed") > 0.05 && summary.number("area_relative_change").abs() < 1e-4);
    std::fs::remove_dir_all(&directory).unwrap();
}

#[test]
fn a_run_that_breaks_off_keeps_what_it_has() {
    // A step that is stable at the start, but not when the particles have gathered.
    let directory = directory("broken-run");
    let step = motile::ib_core::StepSize::Fixed(0.1);
    let method = motile::Method::ImmersedBoundary;
    let swimmer = Swimmer { method, spacing: 0.1, lengths: [4.0, 4.0], step, ..Swimmer::default() };
    let (mut scene, droplet) = swimmer.build().unwrap();
    let flags = output(&directory, true);
    let mut run = WatchedRun::new(&mut scene, droplet, &swimmer, 100.0, &flags, "", String::new()).unwrap();
    let error = run.go(&mut scene).unwrap().unwrap_err();
    let summary: Summary = run.summary().unwrap();
    let time = summary.number("time");
    assert!(time > 0.0 && time < 100.0);
    assert_eq!(run.recorder().table().column("time").unwrap().last(), Some(&time));
    assert_eq!(summary.values()["failure"], error.to_string());
    assert_eq!(summary.values()["finished"], false);
    let files = std::fs::read_dir(&directory).unwrap().count();
    assert_eq!(files, 1, "without pictures there is the trajectory alone");
    std::fs::remove_dir_all(&directory).unwrap();
}

#[test]
fn an_unstable_step_is_refused_before_anything_is_written() {
    let directory = directory("refused-run");
    let swimmer = Swimmer { spacing: 0.25, step: motile::ib_core::StepSize::Fixed(5.0), ..Swimmer::default() };
    let (mut scene, droplet) = swimmer.build().unwrap();
    let flags = output(&directory, true);
    let refused = WatchedRun::new(&mut scene, droplet, &swimmer, 10.0, &flags, "", String::new());
    assert!(refused.unwrap_err().to_string().contains("time step 5"));
    assert!(!directory.exists());
}
