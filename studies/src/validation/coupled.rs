//! The coupled problem against exact solutions: a round swimmer, and drops with surfactant in weak flows.

use motile::setup::FlowSetup;
use motile_tests::validation::coupled::{refinements, resolution};
use motile_tests::validation::imposed::{EXTENSION, SHEAR};
use motile_tests::validation::surfactant::{Drop, Response};
use motile_tests::validation::{StudyError, Table, order};

use super::Tables;
use crate::tables::{Measure, Once};

pub(super) fn coupled() -> Tables {
    let mut table = Table::new(
        "A round droplet in unbounded fluid, linear tension, from q = 0.1 to t = 4: errors of the modes 1 to 4 of the \
         concentration over the first, and of the displacement; orders in space from errors, in time from changes \
         with the step",
        "refined | method | resolution | step | modes | displacement | orders",
    );
    for refinement in refinements() {
        let refined = if refinement.in_space { "space" } else { "time" };
        let rows = Once::new();
        for (level, (method, dt)) in refinement.levels.iter().enumerate() {
            let name = format!("{refined} | {} | {} | {dt}", refinement.method, resolution(method));
            table.measure(name, || {
                let row = &rows.get(|| refinement.rows())?[level];
                let [modes, displacement] = row.errors;
                let orders = row.orders.map_or_else(String::new, |[a, b]| format!("{a:.2}, {b:.2}"));
                Ok(format!("{modes:.1e} | {displacement:.1e} | {orders}"))
            })?;
        }
    }
    Ok(vec![table])
}

/// Capillary numbers, each half of the one before.
const CAPILLARY: [f64; 3] = [0.04, 0.02, 0.01];

pub(super) fn surfactant() -> Tables {
    let mut table = Table::new(
        "Steady drops with insoluble surfactant in weak flows: response over the capillary number by first-order \
         theory, relative distance from it at Ca = 0.04, 0.02, 0.01, and its order in Ca; tension at rest 1, D = 0.1",
        "flow | ratio | zeta c0 | quantity | theory | at Ca = 0.04, 0.02, 0.01 | order",
    );
    type Run<'a> = &'a dyn Fn(f64) -> Result<Response, StudyError>;
    let mut push = |flow: &str, drop: Drop, theory: Response, run: Run<'_>, quantities: usize| {
        let found = Once::new();
        for (k, name) in Response::NAMES.into_iter().enumerate().take(quantities) {
            let (Drop { ratio, elasticity, .. }, theory) = (drop, theory.list()[k]);
            table.measure(format_args!("{flow} | {ratio} | {elasticity} | {name} | {theory:.6}"), || {
                let found = found.get(|| {
                    let [a, b, c] = CAPILLARY.map(run);
                    Ok([a?, b?, c?])
                })?;
                let errors = (*found).map(|found| found.list()[k] / theory - 1.0);
                let texts = errors.map(|error| format!("{error:.1e}")).join(", ");
                Ok(format!("{texts} | {:.2}", order(&CAPILLARY, &errors)))
            })?;
        }
        Ok::<(), StudyError>(())
    };
    for ratio in [0.1, 1.0, 10.0] {
        let drop = Drop { ratio, elasticity: 0.5, diffusion: 0.1 };
        let extended = |ca| drop.plane(FlowSetup { extension: ca, ..EXTENSION }, ca, 32);
        push("plane extension", drop, drop.plane_theory(), &extended, 3)?;
        // Shear is extension at half its rate; the surface also turns.
        let sheared = |ca| drop.plane(FlowSetup { shear: ca, ..SHEAR }, ca, 32);
        push("plane shear", drop, drop.plane_theory().half(), &sheared, 2)?;
    }
    for elasticity in [0.0, 0.5, 10.0] {
        let drop = Drop { ratio: 1.0, elasticity, diffusion: 0.1 };
        let extended = |ca| drop.space(ca, 32, 64);
        push("axisymmetric extension", drop, drop.space_theory(), &extended, 3)?;
    }
    Ok(vec![table])
}
