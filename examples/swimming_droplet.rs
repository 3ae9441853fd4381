//! An active droplet swims in a periodic box, with all that a run can record.
//!
//! `cargo run --release --example swimming_droplet` simulates the droplet until it swims steadily, at 0.130 radii per
//! unit of time. It prints what was measured, and writes to `out/swimming_droplet/`:
//!
//! * `final.png`, a picture of the final state, and `swim.gif`, an animation of the run;
//! * `time_series.svg` and `concentration_profile.svg`, plots (also as PNG);
//! * `trajectory.csv`, all observables over time, and `summary.json`, the results;
//! * `vtk/fields.pvd` and `vtk/interface.pvd`, the flow and the interface for ParaView.
//!
//! To change anything about the scene without code, use the program `motile run` (docs/reference/program.md).

use motile::prelude::*;
use motile_cli::run::{OutputFlags, SceneRun, View};
use motile_steady_states::SteadyState;

pub(crate) fn main() -> anyhow::Result<()> {
    // A scene is data. What you leave out is the default: activity -2, viscosity 100, a box of 6 x 6.
    let setup = Setup { droplets: vec![DropletSetup::active(-2.0)], ..Setup::default() };
    let output = OutputFlags::default();
    let mut run = SceneRun::new(setup.build()?, &setup, 60.0, &output, "swimming_droplet", &View::of(&setup))?;
    run.go(None)?;

    // Newton's method finds the steady swimmer without a run: the speeds agree.
    let (speed, steady) = (run.last()?.observables.speed(), SteadyState::find(&setup)?.measured()?.speed);
    assert!((speed / steady - 1.0).abs() < 1e-3, "{speed} after the run, {steady} by Newton's method");
    let summary = run.summary()?;
    run.finish(&summary)
}
