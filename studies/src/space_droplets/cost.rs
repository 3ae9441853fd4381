//! Time of an evaluation next to the axisymmetric code at a similar error.

use std::fs;
use std::time::Instant;

use anyhow::{Result, bail};
use motile::base::Region;
use motile::setup::{DropletSetup, IntegralMethod, Method, Setup};
use motile_cli::run::say;
use motile_tests::validation::Table;
use rayon::{ThreadPool, ThreadPoolBuilder};
use space_droplets::SteadyState;

use super::swimmer;

/// Degrees, and numbers of nodes of the axisymmetric code with a similar error of the speed.
const PAIRS: [(usize, usize); 4] = [(12, 64), (16, 72), (24, 96), (32, 128)];
/// Nodes of the speed that errors count from.
const EXACT: usize = 160;
const ACTIVITY: f64 = -1.0;
const STRENGTH: f64 = 2.0;
/// Time spent on each degree (seconds), and a step so short that nothing moves (time).
const SECONDS: f64 = 8.0;
const STEP: f64 = 1e-6;
/// Ticks of processor time are a few milliseconds (seconds).
const MANY_TICKS: f64 = 0.15;

/// A swimmer along the axis of the axisymmetric code.
fn axisymmetric(nodes: usize) -> Setup {
    let method = Method::Integral(IntegralMethod { nodes, elements: 4 * nodes });
    let droplets = vec![DropletSetup::contractile(ACTIVITY, STRENGTH)];
    Setup { region: Region::Space, method, droplets, ..Setup::default() }
}

fn exact_speed(nodes: usize) -> Result<f64> {
    Ok(motile_steady_states::SteadyState::find(&axisymmetric(nodes))?.measured()?.speed)
}

/// Processor time of this thread (seconds), which other load on the machine hardly changes. Only Linux has it.
fn processor_time() -> Option<f64> {
    let text = fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(1e-9 * text.split_whitespace().next()?.parse::<f64>().ok()?)
}

/// Processor time of a work on the only thread of a pool (seconds), or its time if there is none: the mean of so many
/// that the ticks by which it is counted do not matter.
fn time(pool: &ThreadPool, mut work: impl FnMut() -> Result<()> + Send) -> Result<f64> {
    pool.install(|| {
        let (start, before, mut count) = (Instant::now(), processor_time(), 0.0);
        loop {
            work()?;
            count += 1.0;
            let elapsed = start.elapsed().as_secs_f64();
            let spent = before.zip(processor_time()).map_or(elapsed, |(before, after)| after - before);
            if spent > MANY_TICKS {
                return Ok(spent / count);
            }
        }
    })
}

/// Least times of an evaluation on one thread by turns with the axisymmetric code, and errors of the steady speed.
pub(super) fn cost() -> Result<Table> {
    let header = "degree | error of the speed | ms | viscosity ratio 10, ms | nodes | error with these | \
                  axisymmetric, ms | over the axisymmetric";
    let mut table = Table::new("An evaluation of the flow of a swimmer without symmetry, activity -1, A = 2", header);
    let Ok(one) = ThreadPoolBuilder::new().num_threads(1).build() else { bail!("no thread to be had") };
    let exact = exact_speed(EXACT)?;
    for (degree, nodes) in PAIRS {
        let mut state = SteadyState::find(swimmer(degree, [100.0; 2], ACTIVITY, STRENGTH)?)?;
        let error = (state.droplet_mut().observe()?.speed / exact - 1.0).abs();
        let other = (exact_speed(nodes)? / exact - 1.0).abs();
        let mut droplets = [state.into_droplet(), swimmer(degree, [1000.0, 100.0], ACTIVITY, STRENGTH)?];
        let states = droplets.each_ref().map(|droplet| droplet.state().to_vec());
        let mut scene = axisymmetric(nodes).build()?.scene;
        scene.step(STEP)?;
        let before = scene.system().work().evaluations;
        scene.step(STEP)?;
        let each = (scene.system().work().evaluations - before) as f64;
        let (start, mut least, mut turns) = (Instant::now(), [f64::INFINITY; 3], 0);
        while turns < 3 || start.elapsed().as_secs_f64() < SECONDS {
            let of_axis = time(&one, || Ok(scene.step(STEP).map(drop)?))? / each;
            least[0] = least[0].min(of_axis);
            for (k, (droplet, state)) in droplets.iter_mut().zip(&states).enumerate() {
                // From rest, so that a solution is not known already.
                let of_evaluation = time(&one, || Ok(droplet.resume(0.0, state).and_then(|()| droplet.evaluate())?))?;
                least[k + 1] = least[k + 1].min(of_evaluation);
            }
            turns += 1;
        }
        let [axis, plain, contrast] = least.map(|seconds| 1e3 * seconds);
        let ratio = plain / axis;
        let row = format!(
            "{degree} | {error:.0e} | {plain:.2} | {contrast:.2} | {nodes} | {other:.0e} | {axis:.3} | {ratio:.1}"
        );
        say(&row);
        table.row(format_args!("{row}"));
    }
    Ok(table)
}
