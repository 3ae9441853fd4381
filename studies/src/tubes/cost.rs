//! Cost of an evaluation of the flow of bodies of revolution, beside the plane's.

use std::cell::RefCell;
use std::time::Duration;

use anyhow::{Context, Result, bail, ensure};
use motile::base::Region;
use motile::scene::{Scene, SceneError};
use motile::setup::{AnyFlow, DropletSetup};
use motile_cli::run::say;
use motile_tests::validation::Table;
use motile_timing::Turns;
use rayon::ThreadPoolBuilder;

use super::scene;

const NODES: [usize; 2] = [64, 128];
/// Distance of the centres of droplets (R0), and time spent on each number of nodes and droplets (seconds).
const DISTANCE: f64 = 3.0;
const SECONDS: f64 = 20.0;
/// Step (time), so short that nothing moves.
const STEP: f64 = 1e-6;

/// Least times of an evaluation, in a step that makes two, on one thread and on two by turns.
pub(super) fn cost() -> Result<Table> {
    ensure!(
        cfg!(feature = "rayon"),
        "motile runs on one thread here: cargo run --release -p studies --features rayon -- tubes cost"
    );
    let pools = [1, 2].map(|threads| ThreadPoolBuilder::new().num_threads(threads).build());
    let [Ok(one), Ok(two)] = pools else { bail!("no threads to be had") };
    let header = "region | droplets | nodes | ms | over the plane's | two threads";
    let mut table = Table::new("Cost of an evaluation, activity -2, viscosities 100", header);
    let regions = [("plane", Region::Plane), ("space", Region::Space), ("tube of radius 1.5", Region::tube(1.5))];
    for (droplets, nodes) in [1, 4].into_iter().flat_map(|droplets| NODES.map(|nodes| (droplets, nodes))) {
        let built = regions.map(|(_, region)| build(region, droplets, nodes));
        let [plane, space, tube] = built.map(|scene| scene.map(RefCell::new));
        let scenes = [plane?, space?, tube?];
        let failed: RefCell<Option<SceneError>> = RefCell::new(None);
        let step = |k: usize, pool: &rayon::ThreadPool| {
            let scene = &mut *scenes[k].borrow_mut();
            if let Err(error) = pool.install(|| scene.step(STEP)) {
                failed.replace(Some(error));
            }
        };
        let evaluations = |k: usize| scenes[k].borrow().system().work().evaluations;
        let before: [usize; 3] = std::array::from_fn(evaluations);
        (0..3).for_each(|k| step(k, &one));
        let each: [usize; 3] = std::array::from_fn(|k| evaluations(k) - before[k]);
        let mut works: Vec<_> =
            (0..3).flat_map(|k| [&one, &two].map(|pool| (k, pool))).map(|(k, pool)| move || step(k, pool)).collect();
        let mut works: Vec<&mut dyn FnMut()> = works.iter_mut().map(|work| work as &mut dyn FnMut()).collect();
        let turns = Turns::measure(Duration::from_secs_f64(SECONDS), &mut works);
        drop(works);
        failed.take().map_or(Ok(()), Err)?;
        let least = |k: usize, threads: usize| 1e3 * turns.least(2 * k + threads - 1) / each[k] as f64;
        for (k, (name, _)) in regions.into_iter().enumerate() {
            let [single, double] = [1, 2].map(|threads| least(k, threads));
            let cells = [name.to_owned(), droplets.to_string(), nodes.to_string(), format!("{single:.3}")];
            let rest = [format!("{:.1}", single / least(0, 1)), format!("{:.2}", single / double)];
            say(format_args!("{cells:?} {rest:?}"));
            table.push(cells.into_iter().chain(rest));
        }
    }
    Ok(table)
}

/// Droplets in a row along x.
fn build(region: Region, droplets: usize, nodes: usize) -> Result<Scene<AnyFlow>> {
    let first = DropletSetup::contractile(-2.0, 4.0);
    let mut setup = scene(region, first, nodes);
    let droplet = setup.droplets.pop().context("no droplet")?;
    setup.droplets = (0..droplets)
        .map(|k| {
            let x = DISTANCE * (k as f64 - 0.5 * (droplets as f64 - 1.0));
            DropletSetup { centre: [x, 0.0], name: format!("droplet {}", k + 1), ..droplet.clone() }
        })
        .collect();
    Ok(setup.build()?.scene)
}
