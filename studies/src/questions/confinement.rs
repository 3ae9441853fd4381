//! Speed over the width of a channel, for interfaces with friction.
//!
//! States are found one from the other: in the widest channel from one friction to the next, then from one width to the
//! next at each friction.

use anyhow::Result;
use motile::base::{Drive, Region};
use motile::setup::{DropletSetup, Setup};
use motile_cli::run::explained;
use motile_steady_states::{SteadyError, SteadyState};
use motile_tests::validation::Table;

use super::nodes;
use crate::tables::{Measure, Once};

/// Friction xi R/(2 (eta_in + eta_ext)) of the interface.
const FRICTIONS: [f64; 6] = [0.0, 0.1, 0.3, 1.0, 3.0, 5.0];
/// Widths of the channel; the speed in the first is the unit.
const WIDTHS: [f64; 5] = [12.0, 6.0, 4.0, 3.0, 2.4];
const NODES: [usize; 2] = [48, 96];

/// What is held fixed while the friction changes.
#[derive(Debug, Clone, Copy)]
enum Held {
    /// Activity over the threshold in the plane with this friction.
    OverThreshold(f64),
    Activity(f64),
}

/// A row of channels.
#[derive(Debug, Clone, Copy)]
struct Case {
    length: f64,
    drive: (&'static str, Drive),
    held: Held,
    nodes: usize,
}

const OPEN: (&str, Drive) = ("zero gradient", Drive::ZeroGradient);
const SHUT: (&str, Drive) = ("zero flux", Drive::ZeroFlux);

/// Steady swimmers at fixed multiples of the threshold in the plane, or at a fixed activity.
pub(super) fn confinement() -> Result<Vec<Table>> {
    let header = "length | drive | held | nodes | friction | width | activity | speed | over the widest | aspect ratio";
    let mut table = Table::new("Swimmers in channels, with friction", header);
    for (length, drive, held) in [
        (12.0, OPEN, Held::OverThreshold(4.0)),
        (12.0, SHUT, Held::OverThreshold(4.0)),
        (12.0, OPEN, Held::Activity(-4.0)),
        (24.0, OPEN, Held::OverThreshold(4.0)),
    ] {
        for nodes in NODES {
            Case { length, drive, held, nodes }.measure(&mut table)?;
        }
    }
    Ok(vec![table])
}

/// A state, or why there is none.
type State = Result<SteadyState, String>;

impl Case {
    fn measure(self, table: &mut Table) -> Result<()> {
        let Self { length, drive: (drive, _), held, nodes } = self;
        let held = match held {
            Held::OverThreshold(factor) => format!("{factor} thresholds"),
            Held::Activity(activity) => format!("activity {activity}"),
        };
        // The widest channel, from one friction to the next.
        let widest = FRICTIONS.map(|_| Once::<State>::new());
        for (k, friction) in FRICTIONS.into_iter().enumerate() {
            let states = WIDTHS.map(|_| Once::<State>::new());
            for (j, width) in WIDTHS.into_iter().enumerate() {
                let name = format!("{length} | {drive} | {held} | {nodes} | {friction} | {width}");
                table.measure(name, || {
                    let unit = state(k, &widest, |k, last| {
                        let setup = self.setup(FRICTIONS[k], WIDTHS[0]);
                        last.map_or_else(|| SteadyState::find(&setup), |last| last.follow(&setup)).map_err(told)
                    })?;
                    let found = state(j, &states, |j, last| match last {
                        Some(last) => self.narrowed(friction, [WIDTHS[j - 1], WIDTHS[j]], last, 2),
                        None => unit.clone(),
                    })?;
                    let activity = self.activity(friction);
                    let speed = |state: &State| state.as_ref().ok().and_then(|state| state.measured().ok());
                    Ok(match found {
                        Ok(found) => {
                            let seen = found.measured()?;
                            let over =
                                speed(unit).map_or_else(String::new, |unit| format!("{:.4}", seen.speed / unit.speed));
                            format!("{activity:.3} | {:.5} | {over} | {:.4}", seen.speed, seen.aspect_ratio)
                        }
                        Err(error) => format!("{activity:.3} | {error} |  | "),
                    })
                })?;
            }
        }
        Ok(())
    }

    /// Returns the activity at a friction.
    fn activity(self, friction: f64) -> f64 {
        match self.held {
            // The closed form of the plane.
            Held::OverThreshold(factor) => -0.4 * factor * (1.0 + 0.5 * friction),
            Held::Activity(activity) => activity,
        }
    }

    fn setup(self, friction: f64, width: f64) -> Setup {
        let droplet = DropletSetup { friction: 400.0 * friction, ..DropletSetup::active(self.activity(friction)) };
        let region = Region::Channel { length: self.length, width, drive: self.drive.1 };
        Setup { region, method: nodes(self.nodes), droplets: vec![droplet], ..Setup::default() }
    }

    /// Returns the state in a channel of another width, at first in one step, then in up to four.
    fn narrowed(self, friction: f64, [from, to]: [f64; 2], last: &SteadyState, halvings: usize) -> State {
        last.follow(&self.setup(friction, to)).map_err(told).or_else(|error| {
            if halvings == 0 {
                return Err(error);
            }
            let middle = 0.5 * (from + to);
            let half = self.narrowed(friction, [from, middle], last, halvings - 1)?;
            self.narrowed(friction, [middle, to], &half, halvings - 1)
        })
    }
}

fn told(error: SteadyError) -> String {
    explained(&error.into())
}

/// Returns the state number k of a row of which each is found from the one before.
fn state(k: usize, row: &[Once<State>], find: impl Fn(usize, Option<&SteadyState>) -> State) -> Result<&State> {
    let mut last = row[0].get(|| Ok(find(0, None)))?;
    for (k, once) in row.iter().enumerate().take(k + 1).skip(1) {
        let next = || last.as_ref().map_err(Clone::clone).and_then(|last| find(k, Some(last)));
        last = once.get(|| Ok(next()))?;
    }
    Ok(last)
}
