//! Behaviour of many droplets together, over activity, fraction and ratio of viscosities.

use anyhow::Result;
use motile::analysis::suspension::rotational_diffusion;
use motile::scene::Every;
use motile::setup::Built;
use motile_cli::run::say;
use motile_output::suspension::SuspensionCsv;
use motile_tests::validation::Table;

use super::{Flags, Rows};

const NODES: usize = 48;
/// Parts of the area, activities, viscosities inside over that outside.
const FRACTIONS: [f64; 3] = [0.1, 0.3, 0.5];
const ACTIVITIES: [f64; 3] = [-1.5, -2.0, -3.0];
const RATIOS: [f64; 2] = [1.0, 10.0];
/// Rows of the tables of a suspension, and the gap of droplets in contact (R0).
const ROWS: f64 = 100.0;
const CONTACT: f64 = 0.2;

pub(super) fn table(flags: &Flags, rows: &mut Rows) -> Result<Table> {
    let columns = "fraction | activity | ratio | polar order | nematic order | contacts a droplet | largest cluster | \
        square displacement | rotational diffusion | least film | film held | contacts over stress | area \
        change | steps | end";
    let mut table = Table::new("random suspensions", columns);
    let ways = FRACTIONS.into_iter().flat_map(|fraction| ACTIVITIES.map(|activity| (fraction, activity)));
    for ((fraction, activity), ratio) in ways.flat_map(|way| RATIOS.map(|ratio| (way, ratio))) {
        let name = format!("crowd {} {} {fraction} {activity} {ratio}", flags.count, flags.time);
        table.row(format_args!("{}", rows.row(&name, || crowd(flags, fraction, activity, ratio))?));
    }
    Ok(table)
}

/// A row: means over the second half of the run.
fn crowd(flags: &Flags, fraction: f64, activity: f64, ratio: f64) -> Result<String> {
    let setup = super::suspension(flags.count, fraction, activity, ratio, NODES)?;
    let Built { mut scene, .. } = setup.build()?;
    let directory = std::env::temp_dir().join(format!("suspensions-{}", std::process::id()));
    std::fs::create_dir_all(&directory)?;
    let mut tables = SuspensionCsv::create(&directory, scene.system_mut(), CONTACT)?;
    let end = match scene.run(flags.time).observe(Every::StepAfter(flags.time / ROWS), &mut tables).go() {
        Ok(()) => "finished".to_owned(),
        Err(error) => {
            say(error);
            format!("at {:.1}", scene.time())
        }
    };
    let half = 0.5 * scene.time();
    let mean_of = |column: &str, of: &dyn Fn(f64) -> f64| -> Result<f64> {
        let curve = tables.table().curve("time", column)?;
        let late: Vec<f64> =
            curve.into_iter().filter(|row| row.0 >= half && row.1.is_finite()).map(|row| of(row.1)).collect();
        Ok(late.iter().sum::<f64>() / late.len() as f64)
    };
    let mean = |column: &str| mean_of(column, &|value| value);
    // Pressure of the contacts over the largest part of the mean stress.
    let size = |column: &str| mean_of(column, &f64::abs);
    let stress = ["stress_xx", "stress_xy", "stress_yy"].into_iter().map(size).collect::<Result<Vec<_>>>()?;
    let share = size("contact_stress")? / stress.into_iter().fold(0.0, f64::max);
    let diffusion = tables.diffusion(half);
    let interval = diffusion.get(1).map_or(0.0, |row| row[0]);
    let correlation: Vec<f64> = diffusion.iter().map(|row| row[2]).collect();
    let changes = tables.table().curve("time", "area_change")?;
    let diffusion = rotational_diffusion(&correlation, interval).map_or_else(String::new, |rate| format!("{rate:.3}"));
    let row = format!(
        "{fraction} | {activity} | {ratio} | {:.2} | {:.2} | {:.2} | {:.1} | {:.2} | {diffusion} | {:.3} | {:.3} | \
         {share:.2} | {:.0e} | {} | {end}",
        mean("polar_order")?,
        mean("nematic_order")?,
        2.0 * mean("contacts")? / flags.count as f64,
        mean("largest_cluster")?,
        tables.last("square_displacement").unwrap_or(f64::NAN),
        scene.system().minimum_gap().unwrap_or(f64::NAN),
        mean("film")?,
        changes.iter().map(|row| row.1).fold(0.0, f64::max),
        scene.steps()
    );
    std::fs::remove_dir_all(&directory)?;
    Ok(row)
}
