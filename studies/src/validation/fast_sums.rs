//! Many droplets in a box by fast sums: errors and iterations.

use motile_tests::validation::fast_sums::{Suspension, error, few};
use motile_tests::validation::{StudyError, Table};

use crate::tables::{Measure, Once};
use crate::validation::Tables;

const TOLERANCES: [f64; 5] = [1e-3, 1e-4, 1e-6, 1e-8, 1e-10];
/// Copies of three droplets.
const COPIES: [[usize; 2]; 4] = [[3, 3], [4, 4], [5, 6], [5, 9]];
/// Tolerance of what is compared with.
const EXACT: f64 = 1e-13;

pub(crate) fn fast_sums() -> Tables {
    Ok(vec![errors()?, iterations()?])
}

fn errors() -> Result<Table, StudyError> {
    let mut table = Table::new(
        "Fast sums over copies of three droplets in a box, area fraction 0.3, films down to 0.02: largest error of a \
         velocity, relative to the largest, against sums over pairs in one copy, equal viscosities (single layer) and \
         a ratio of ten (double layer too)",
        "nodes | tolerance | equal viscosities | ratio 10",
    );
    let found = Once::new();
    let exact = || {
        let exact = |ratio| Ok((few(ratio), few(ratio).velocities(EXACT)?.0));
        found.get(|| [1.0, 10.0].into_iter().map(exact).collect::<Result<Vec<_>, StudyError>>())
    };
    for times in &COPIES {
        for tolerance in TOLERANCES {
            let nodes = few(1.0).repeated(*times).nodes();
            table.measure(format_args!("{nodes} | {tolerance:e}"), || {
                let errors = exact()?.iter().map(|(alone, exact)| error(alone, exact, *times, tolerance));
                let errors = errors.map(|error| Ok(format!("{:.1e}", error?)));
                Ok(errors.collect::<Result<Vec<_>, StudyError>>()?.join(" | "))
            })?;
        }
    }
    Ok(table)
}

fn iterations() -> Result<Table, StudyError> {
    let mut table = Table::new(
        "Iterations for many droplets in a box, from nothing, films down to 0.02: at tolerances of 1e-6 and 1e-8",
        "area fraction | ratio | tolerance 1e-6 | tolerance 1e-8",
    );
    for fraction in [0.1, 0.3, 0.5] {
        for ratio in [0.1, 10.0, 100.0] {
            table.measure(format_args!("{fraction} | {ratio}"), || {
                let suspension = Suspension::lattice([10, 10], fraction, ratio);
                let [coarse, fine] =
                    [1e-6, 1e-8].map(|tolerance| suspension.velocities(tolerance).map(|(_, count)| count));
                Ok(format!("{} | {}", coarse?, fine?))
            })?;
        }
    }
    Ok(table)
}
