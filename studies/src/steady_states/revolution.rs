//! Swimmers in tubes in three dimensions.

use anyhow::{Context, Result};
use motile::motile_base::Region;
use motile::setup::{DropletSetup, Setup};
use motile_tests::validation::Table;
use steady_states::SteadyState;

use super::bifurcations::digits;
use super::nodes;

/// Pairs of nodes of a table whose digits should agree.
const PAIR: [usize; 2] = [128, 160];
/// Radii of tubes.
const RADII: [f64; 4] = [2.0, 1.5, 1.25, 1.1];

/// Swimmers of activity -2 in tubes, at two numbers of nodes each.
pub(super) fn tubes() -> Result<Vec<Table>> {
    let header = ["radius", "nodes", "speed", "film", "aspect ratio", "stresslet", "tail", "m = 0", "m = 1"];
    let mut table = Table::new("Swimmers in tubes without flux, viscosities 100, activity -2, A = 4", &header);
    for (radius, count) in RADII.into_iter().flat_map(|radius| PAIR.map(|count| (radius, count))) {
        let mut cells = vec![radius.to_string(), count.to_string()];
        let (region, droplets) = (Region::tube(radius), vec![DropletSetup::contractile(-2.0, 4.0)]);
        let setup = Setup { region, droplets, method: nodes(count), ..Setup::default() };
        let state = SteadyState::find(&setup)?;
        let seen = state.measured()?;
        let widest = state.profile().positions.iter().map(|x| x.y).fold(0.0, f64::max);
        let leading = state.spectrum()?.leading().map_or(f64::NAN, |mode| mode.value.re);
        cells.extend([digits(seen.speed, 6), digits(radius - widest, 5), digits(seen.aspect_ratio, 6)]);
        cells.extend([digits(seen.stresslet, 6), format!("{:.0e}", state.tail()), format!("{leading:.4}")]);
        cells.push(turning(&state)?);
        table.push(cells);
    }
    Ok(vec![table])
}

/// Leading eigenvalue of disturbances that turn a swimmer.
fn turning(state: &SteadyState) -> Result<String> {
    let spectrum = state.spectrum_around(1)?;
    let value = spectrum.leading().context("no modes")?.value;
    let swing = if value.im == 0.0 { String::new() } else { format!(" + {:.4} i", value.im.abs()) };
    Ok(format!("{:.5}{swing}", value.re))
}
