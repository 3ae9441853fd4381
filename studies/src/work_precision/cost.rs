//! Cost of a run.

use std::time::Instant;

use anyhow::{Result, bail};
use motile::scene::{Every, Hydrodynamics, Scene, System, integrator::RungeKuttaChebyshev};
use motile_cli::run::Summary;
use motile_timing::{PlainPair, median};

use crate::work_precision::settings::Stepper;

/// Steps between two measurements of the unit.
const EVERY: usize = 8;
/// Side of the transform that is the unit, in cells.
pub(crate) const UNIT: usize = 120;

/// Cost of a run.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cost {
    /// Seconds per unit of simulated time.
    pub(crate) seconds: f64,
    /// Cost in forward and inverse real FFTs of 120 x 120, measured by turns with the steps.
    pub(crate) pairs: f64,
    /// Median time of such a pair (seconds).
    pub(crate) pair: f64,
    /// Steps per unit of simulated time.
    pub(crate) steps: f64,
}

impl Cost {
    pub(crate) fn put(&self, summary: &mut Summary) {
        summary.put("seconds_per_time", self.seconds, "");
        summary.put("pairs_per_time", self.pairs, "");
        summary.put("pair_us", 1e6 * self.pair, "");
        summary.put("steps_per_time", self.steps, "");
    }

    /// Of something that took these times, by turns with pairs; `often` times per unit of simulated time. `most` is the
    /// mean processor time, which is the better measure of what takes longer than the machine goes without doing
    /// something else.
    fn new(times: &mut [f64], pairs: &mut [f64], most: Option<f64>, often: f64) -> Self {
        let (time, pair) = (median(times), median(pairs));
        let time = most.map_or(time, |most| time.min(most));
        Self { seconds: time * often, pairs: time * often / pair, pair, steps: often }
    }
}

/// Processor time of a run (seconds) from which on it is a measure.
const SHORT: f64 = 0.05;
/// Fewest steps that a cost is the median of: short runs are made again.
const ENOUGH: usize = 60;

/// Runs a scene that `make` makes to `time` by the midpoint rule or another integrator; `end` looks at it then.
pub(crate) fn march<H: Hydrodynamics, T>(
    make: impl Fn() -> Result<Scene<H>>,
    stepper: Stepper,
    time: f64,
    end: impl FnOnce(&mut System<H>) -> Result<T>,
) -> Result<(Cost, T)> {
    let mut meter = Meter::new();
    for run in 1.. {
        let mut scene = make()?;
        if let Stepper::Chebyshev(stages) = stepper {
            scene = scene.advanced_by(RungeKuttaChebyshev::new().with_most_stages(stages));
        }
        meter.last = None;
        let (busy, units) = (processor_time(), meter.units);
        let mut watch = |system: &mut System<H>| -> Result<(), std::convert::Infallible> {
            meter.stepped(system.steps());
            Ok(())
        };
        scene.run(time).observe(Every::Steps(1), &mut watch).go()?;
        // A run of a single long step has no other to be measured.
        if meter.times.len() >= ENOUGH || run == ENOUGH {
            let steps = scene.steps() as f64;
            let own = 2.0 * (meter.units - units) as f64 * median(&mut meter.pairs);
            // The clock of the processor is too coarse for short runs.
            let long = |own_time: &f64| *own_time > SHORT;
            let mean =
                processor_time().zip(busy).map(|(end, start)| end - start - own).filter(long).map(|time| time / steps);
            let cost = Cost::new(&mut meter.times, &mut meter.pairs, mean, steps / time);
            return Ok((cost, end(scene.system_mut())?));
        }
    }
    bail!("a run has to end")
}

/// Times of steps and of the unit.
struct Meter {
    unit: PlainPair,
    times: Vec<f64>,
    pairs: Vec<f64>,
    last: Option<Instant>,
    /// Steps of the run at the last observation.
    steps: usize,
    /// How often the unit was measured.
    units: usize,
}

impl Meter {
    fn new() -> Self {
        Self { unit: PlainPair::new(UNIT, UNIT), times: Vec::new(), pairs: Vec::new(), last: None, steps: 0, units: 0 }
    }

    fn stepped(&mut self, steps: usize) {
        let now = Instant::now();
        // The first step makes plans; the last observation may come twice.
        if let Some(last) = self.last.filter(|_| steps > 1 && steps != self.steps) {
            self.times.push((now - last).as_secs_f64());
        }
        if steps.is_multiple_of(EVERY) || self.pairs.len() < 3 {
            self.unit();
        }
        self.steps = steps;
        self.last = Some(Instant::now());
    }

    fn unit(&mut self) {
        // The step has emptied the caches of the transform.
        self.unit.run();
        let start = Instant::now();
        self.unit.run();
        self.units += 1;
        self.pairs.push(start.elapsed().as_secs_f64());
    }
}

/// The cost of something without time that is run again and again.
pub(crate) fn repeat(mut work: impl FnMut() -> Result<()>) -> Result<Cost> {
    let mut meter = Meter::new();
    let begin = Instant::now();
    while meter.times.len() < 10 || (begin.elapsed().as_secs_f64() < 0.3 && meter.times.len() < 300) {
        let start = Instant::now();
        work()?;
        meter.times.push(start.elapsed().as_secs_f64());
        meter.unit();
    }
    Ok(Cost::new(&mut meter.times, &mut meter.pairs, None, 1.0))
}

/// Seconds that this thread has had a processor for, where the system tells.
pub(crate) fn processor_time() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = text.split_whitespace().next()?.parse().ok()?;
    Some(1e-9 * nanoseconds)
}
