//! Random suspensions: what they do over several diameters of travel, from several starts, and what random starts show.

use anyhow::{Context, Result};
use motile::analysis::suspension::rotational_diffusion;
use motile::scene::Every;
use motile::setup::{Built, Setup};
use motile_cli::run::say;
use motile_output::suspension::SuspensionCsv;
use motile_tests::validation::Table;

use super::{Flags, held, suspension};
use crate::book::statistics::mean;
use crate::tables::{Measure, all_wanted};

/// Nodes of the droplets, which the repulsion of all runs is made for, and half and twice as many, which check them.
const NODES: usize = 32;
const COARSER: usize = 16;
const FINER: usize = 64;
/// Rows of the tables of a suspension, and the gap of droplets in contact (R0).
const ROWS: f64 = 100.0;
const CONTACT: f64 = 0.2;
/// Random starts that nothing has moved yet.
const STARTS: u64 = 200;
/// Area fraction that speeds are compared with.
const DILUTE: f64 = 0.1;
const DIAMETER: f64 = 2.0;

/// A suspension that is run from several starts.
#[derive(Debug, Clone, Copy)]
struct Crowd {
    /// Droplets.
    count: usize,
    fraction: f64,
    /// Viscosity inside over that outside.
    ratio: f64,
    activity: f64,
    nodes: usize,
    time: f64,
    /// Most starts.
    seeds: u64,
}

/// Activities are in proportion to the sum of the viscosities, so that lone droplets are as far from their threshold.
const CROWDS: [Crowd; 6] = [
    Crowd { fraction: 0.1, ..USUAL },
    Crowd { fraction: 0.5, ..USUAL },
    Crowd { fraction: 0.5, nodes: COARSER, seeds: 4, ..USUAL },
    Crowd { fraction: 0.5, nodes: FINER, seeds: 4, ..USUAL },
    Crowd { fraction: 0.1, ..VISCOUS },
    Crowd { fraction: 0.5, ..VISCOUS },
];
const USUAL: Crowd =
    Crowd { count: 16, fraction: 0.1, ratio: 1.0, activity: -1.5, nodes: NODES, time: 180.0, seeds: u64::MAX };
const VISCOUS: Crowd = Crowd { ratio: 10.0, activity: -8.25, time: 90.0, ..USUAL };

impl Crowd {
    fn setup(self, seed: u64) -> Result<Setup> {
        let mut setup = suspension(self.count, self.fraction, self.activity, self.ratio, self.nodes)?;
        setup.suspension[0].seed = seed;
        // Films that nodes of all runs resolve.
        setup.repulsion = Some(held(NODES, self.activity)?);
        Ok(setup)
    }

    /// Adds the rows of its runs.
    fn runs(self, flags: &Flags, table: &mut Table) -> Result<()> {
        let Self { count, fraction, ratio, activity, nodes, time, seeds } = self;
        for seed in 1..=flags.seeds.min(seeds) {
            let name = format!("{count} | {fraction} | {ratio} | {activity} | {nodes} | {seed} | {time}");
            table.measure(name, || row(self, seed))?;
        }
        Ok(())
    }
}

const RUN: &str = "droplets | fraction | ratio | activity | nodes | seed | time | diameters travelled | polar order at \
    start | polar order | nematic order | contacts at start | contacts | cluster at start | largest cluster | speed | \
    square displacement | rotational diffusion | film | area change | steps | end";
/// What finished runs end with.
const FINISHED: &str = "finished";

/// Means and standard errors over the starts of each suspension, and of random starts; and a row of each run.
pub(super) fn tables(flags: &Flags) -> Result<Vec<Table>> {
    let title = "means over runs of suspensions from random starts, with standard errors";
    let columns = "droplets | fraction | ratio | activity | nodes | finished | diameters travelled | polar order at \
        start | polar order | growth of polar order | contacts a droplet | largest cluster | speed | speed over that at 0.1 \
        | rotational diffusion";
    let mut table = Table::new(title, columns);
    let mut dilute: Vec<(Crowd, [f64; 2])> = Vec::new();
    let mut runs = Table::new("runs of suspensions from random starts", RUN);
    for crowd in CROWDS {
        let before = runs.rows().len();
        crowd.runs(flags, &mut runs)?;
        if !all_wanted() {
            continue;
        }
        let all = &runs.rows()[before..];
        let done: Vec<&Vec<String>> = all.iter().filter(|run| run.last().is_some_and(|end| end == FINISHED)).collect();
        let numbers = |name: &str| -> Result<Vec<f64>> {
            let place = Table::cells(RUN).iter().position(|column| column == name).context("a column")?;
            Ok(done.iter().map(|run| run[place].parse().unwrap_or(f64::NAN)).collect())
        };
        let of = |name: &str| -> Result<[f64; 2]> {
            Ok(with_error(&numbers(name)?.into_iter().filter(|value| value.is_finite()).collect::<Vec<_>>()))
        };
        let [first, last] = [numbers("polar order at start")?, numbers("polar order")?];
        let growth: Vec<f64> = first.iter().zip(&last).map(|(first, last)| last - first).collect();
        let speed = of("speed")?;
        if crowd.fraction == DILUTE {
            dilute.push((crowd, speed));
        }
        let alike = |other: &Crowd| other.ratio == crowd.ratio && other.nodes == crowd.nodes;
        let free = dilute.iter().find(|(other, _)| alike(other)).map(|(_, speed)| *speed);
        let relative = free.filter(|_| crowd.fraction != DILUTE).map_or_else(String::new, |free| {
            let part = speed[0] / free[0];
            shown([part, part * (speed[1] / speed[0]).hypot(free[1] / free[0])])
        });
        let Crowd { count, fraction, ratio, activity, nodes, .. } = crowd;
        table.row(format_args!(
            "{count} | {fraction} | {ratio} | {activity} | {nodes} | {} of {} | {:.1} | {} | {} | {} | {} | {} | {} | \
             {relative} | {}",
            done.len(),
            all.len(),
            of("diameters travelled")?[0],
            shown(of("polar order at start")?),
            shown(of("polar order")?),
            shown(with_error(&growth)),
            shown(of("contacts")?),
            shown(of("largest cluster")?),
            shown(speed),
            shown(of("rotational diffusion")?),
        ));
    }
    let mut seen: Vec<(usize, f64)> = Vec::new();
    for Crowd { count, fraction, .. } in CROWDS {
        if !seen.contains(&(count, fraction)) {
            seen.push((count, fraction));
            table.measure(format_args!("{count} | {fraction} |  |  |  | {STARTS} random starts"), || {
                starts(count, fraction)
            })?;
        }
    }
    Ok(vec![table, runs])
}

/// The mean of random starts: orders, contacts and clusters that are there without any motion.
fn starts(count: usize, fraction: f64) -> Result<String> {
    let crowd = Crowd { count, fraction, ..USUAL };
    let mut seen = [const { Vec::new() }; 3];
    for seed in 1..=STARTS {
        let Built { mut scene, .. } = crowd.setup(seed)?.build()?;
        let (mut tables, folder) = observer(scene.system_mut())?;
        motile::scene::Observer::observe(&mut tables, scene.system_mut())
            .map_err(|error| anyhow::anyhow!("{error}"))?;
        std::fs::remove_dir_all(&folder)?;
        let last = |column: &str| tables.last(column).unwrap_or(f64::NAN);
        let contacts = 2.0 * last("contacts") / count as f64;
        let found = [last("polar_order"), contacts, last("largest_cluster")];
        seen.iter_mut().zip(found).for_each(|(list, value)| list.push(value));
    }
    let [order, contacts, cluster] = seen.map(|list| shown(with_error(&list)));
    Ok(format!("0 | {order} |  |  | {contacts} | {cluster} |  |  | "))
}

type System = motile::scene::System<Box<dyn motile::scene::Hydrodynamics>>;

/// The observer of a suspension, and its folder.
fn observer(system: &mut System) -> Result<(SuspensionCsv, std::path::PathBuf)> {
    let folder = std::env::temp_dir().join(format!("suspensions-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    Ok((SuspensionCsv::create(&folder, system, CONTACT)?, folder))
}

/// A row: means over the second half of the run, and the start.
fn row(crowd: Crowd, seed: u64) -> Result<String> {
    let Built { mut scene, .. } = crowd.setup(seed)?.build()?;
    let (mut tables, folder) = observer(scene.system_mut())?;
    let end = match scene.run(crowd.time).observe(Every::StepAfter(crowd.time / ROWS), &mut tables).go() {
        Ok(()) => FINISHED.to_owned(),
        Err(error) => {
            say(error);
            format!("at {:.1}", scene.time())
        }
    };
    std::fs::remove_dir_all(&folder)?;
    let curve = |column: &str| tables.table().curve("time", column);
    let half = 0.5 * scene.time();
    let late = |column: &str| -> Result<f64> {
        let late = curve(column)?.into_iter().filter(|row| row.0 >= half && row.1.is_finite());
        Ok(mean(late.map(|row| row.1).collect::<Vec<_>>().into_iter()).0)
    };
    let first = |column: &str| Ok::<f64, anyhow::Error>(curve(column)?.first().context("no row")?.1);
    // Of all droplets on average, by the trapezoidal rule.
    let way: f64 = curve("speed")?.windows(2).map(|pair| 0.5 * (pair[0].1 + pair[1].1) * (pair[1].0 - pair[0].0)).sum();
    let diffusion = tables.diffusion(half);
    let interval = diffusion.get(1).map_or(0.0, |row| row[0]);
    let correlation: Vec<f64> = diffusion.iter().map(|row| row[2]).collect();
    let diffusion = rotational_diffusion(&correlation, interval).map_or_else(String::new, |rate| format!("{rate:.5}"));
    let each = 2.0 / crowd.count as f64;
    Ok(format!(
        "{:.2} | {:.4} | {:.4} | {:.4} | {:.3} | {:.3} | \
         {:.2} | {:.2} | {:.5} | {:.2} | {diffusion} | {:.3} | {:.0e} | {} | {end}",
        way / DIAMETER,
        first("polar_order")?,
        late("polar_order")?,
        late("nematic_order")?,
        each * first("contacts")?,
        each * late("contacts")?,
        first("largest_cluster")?,
        late("largest_cluster")?,
        late("speed")?,
        tables.last("square_displacement").unwrap_or(f64::NAN),
        late("film")?,
        curve("area_change")?.iter().map(|row| row.1).fold(0.0, f64::max),
        scene.steps()
    ))
}

/// The mean and its standard error.
fn with_error(values: &[f64]) -> [f64; 2] {
    let (mean, deviation) = mean(values.iter().copied());
    [mean, deviation / (values.len() as f64).sqrt()]
}

fn shown([value, error]: [f64; 2]) -> String {
    if value.is_nan() {
        return String::new();
    }
    // Two digits of the error.
    let digits = if error > 0.0 { (1.0 - error.log10().floor()).clamp(0.0, 6.0) as usize } else { 3 };
    format!("{value:.digits$} ± {error:.digits$}")
}
