//! Speed of a swimmer on the axis of a tube.

use anyhow::Result;
use motile::base::Region;
use motile::setup::{DropletSetup, IntegralMethod, Method, Setup};
use motile_tests::validation::Table;
use space_droplets::{SteadyState, Tube};

use super::swimmer;
use crate::tables::{Measure, Once};

const RADIUS: f64 = 1.5;
/// Nodes of the axisymmetric code.
const NODES: usize = 128;
/// Part of the wall's flow that is left out.
const TOLERANCE: f64 = 1e-7;

/// Speeds by Newton's method, and their difference from the axisymmetric code.
pub(super) fn tube() -> Result<Table> {
    let title = "Swimmers without symmetry in a tube of radius 1.5, activity -2, A = 4, viscosities 100";
    let mut table = Table::new(title, "degree | speed | axisymmetric | difference | film");
    let exact = Once::new();
    for degree in [10, 16, 24] {
        table.measure(degree, || {
            let exact = *exact.get(|| {
                let method = Method::Integral(IntegralMethod { nodes: NODES, elements: 4 * NODES });
                let droplets = vec![DropletSetup::contractile(-2.0, 4.0)];
                let setup = Setup { region: Region::tube(RADIUS), method, droplets, ..Setup::default() };
                Ok(motile_steady_states::SteadyState::find(&setup)?.measured()?.speed)
            })?;
            let tube = Tube::new(RADIUS)?.with_tolerance(TOLERANCE)?;
            let droplet = swimmer(degree, [100.0; 2], -2.0, 4.0)?.with_surroundings(tube)?;
            let mut state = SteadyState::find(droplet)?;
            let speed = state.droplet_mut().observe()?.speed;
            let reach = state.droplet().mesh()?.points.iter().map(|[x, y, _]| x.hypot(*y)).fold(0.0, f64::max);
            Ok(format!("{speed:.6} | {exact:.6} | {:.1e} | {:.4}", (speed / exact - 1.0).abs(), RADIUS - reach))
        })?;
    }
    Ok(table)
}
