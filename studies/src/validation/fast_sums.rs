//! Many droplets in a box by fast sums: errors and iterations.

use motile_tests::validation::fast_sums::{Suspension, error, few};
use motile_tests::validation::{StudyError, Table};

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
    let exact = |ratio| Ok((few(ratio), few(ratio).velocities(EXACT)?.0));
    let exact = [1.0, 10.0].into_iter().map(exact).collect::<Result<Vec<_>, StudyError>>()?;
    for times in &COPIES {
        for tolerance in TOLERANCES {
            let nodes = exact[0].0.repeated(*times).nodes();
            let errors = exact.iter().map(|(alone, exact)| error(alone, exact, *times, tolerance));
            let [equal, other] = errors.collect::<Result<Vec<_>, _>>()?[..] else { continue };
            table.row(format_args!("{nodes} | {tolerance:e} | {equal:.1e} | {other:.1e}"));
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
            let suspension = Suspension::lattice([10, 10], fraction, ratio);
            let [coarse, fine] = [1e-6, 1e-8].map(|tolerance| suspension.velocities(tolerance).map(|(_, count)| count));
            table.row(format_args!("{fraction} | {ratio} | {} | {}", coarse?, fine?));
        }
    }
    Ok(table)
}
