//! Turning of swimmers in gradients of activity across their way.

use anyhow::{Context, Result};
use motile::active_interface::Cortex;
use motile::base::Region;
use motile::setup::{DropletSetup, FieldEntry, FieldsSetup, GradientSetup, Setup};
use motile_tests::validation::Table;

use super::nodes;
use crate::tables::Measure;

/// Times between which the heading turns: after the start has settled.
const TIMES: [f64; 2] = [30.0, 50.0];

/// A swimmer: name, region, activity, viscosity inside, cortex.
type Swimmer = (&'static str, Region, f64, f64, f64);

/// Heading (radians) at two times, and the place at the second.
fn headings(&(_, region, activity, inside, cortex): &Swimmer, slope: f64, count: usize) -> Result<[f64; 2]> {
    let gradient = GradientSetup { slope: [0.0, slope], origin: [0.0; 2] };
    let entry = FieldEntry { gradient: Some(gradient), ..FieldEntry::default() };
    let droplet = DropletSetup {
        viscosity: Some(inside),
        cortex: Cortex::new(cortex),
        fields: FieldsSetup { activity: vec![entry], ..FieldsSetup::default() },
        ..DropletSetup::active(activity)
    };
    let setup = Setup { region, method: nodes(count), droplets: vec![droplet], ..Setup::default() };
    let built = setup.build()?;
    let (mut scene, droplet) = (built.scene, *built.droplets.first().context("no droplet")?);
    let mut found = [0.0; 2];
    for (heading, time) in found.iter_mut().zip(TIMES) {
        scene.run(time).go()?;
        let velocity = scene.observe(droplet)?.velocity;
        *heading = velocity.y.atan2(velocity.x);
    }
    Ok(found)
}

/// Rates of turning over the slope of the activity.
pub(super) fn gradients() -> Result<Vec<Table>> {
    let header = "region | activity | viscosity inside | cortex | slope | nodes | turning rate | over the slope";
    let mut table = Table::new("Swimmers in a gradient of activity across their way", header);
    let square = Region::Box { lengths: [6.0; 2] };
    let swimmers: [Swimmer; 9] = [
        ("plane", Region::Plane, -0.5, 100.0, 0.0),
        ("plane", Region::Plane, -1.0, 100.0, 0.0),
        ("plane", Region::Plane, -2.0, 100.0, 0.0),
        ("plane", Region::Plane, -4.0, 100.0, 0.0),
        ("plane", Region::Plane, -2.0, 20.0, 0.0),
        ("plane", Region::Plane, -2.0, 500.0, 0.0),
        ("plane", Region::Plane, -2.0, 100.0, 200.0),
        ("box 6", square, -1.0, 100.0, 0.0),
        ("box 6", square, -2.0, 100.0, 0.0),
    ];
    for swimmer in swimmers {
        let (name, _, activity, inside, cortex) = swimmer;
        for (slope, count) in [(0.002, 96), (0.02, 48), (0.02, 96)] {
            table.measure(format_args!("{name} | {activity} | {inside} | {cortex} | {slope} | {count}"), || {
                let [before, after] = headings(&swimmer, slope, count)?;
                let rate = (after - before) / (TIMES[1] - TIMES[0]);
                Ok(format!("{rate:.3e} | {:.4}", rate / slope))
            })?;
        }
    }
    Ok(vec![table])
}
