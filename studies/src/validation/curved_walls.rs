//! Rigid walls of any shape.

use motile_tests::validation::{Table, curved_walls};

use super::Tables;
use crate::tables::Measure;

/// Droplets in films beside curved walls, against exact values.
pub(super) fn curved_walls() -> Tables {
    let mut films = Table::new(
        "Films beside a curved wall: largest error of velocity on the interface, relative",
        "film | viscosity inside | 32 and 64 nodes | 64 and 96 | 96 and 160 | 128 and 240",
    );
    let nodes = [[32, 64], [64, 96], [96, 160], [128, 240]];
    for film in [0.1, 0.03, 0.01] {
        for inside in [1.0, 10.0] {
            films.measure(format_args!("{film} | {inside}"), || {
                let errors = curved_walls::film(film, inside, &nodes)?;
                Ok(errors.into_iter().map(|error| format!("{error:.1e}")).collect::<Vec<_>>().join(" | "))
            })?;
        }
    }
    Ok(vec![films])
}
