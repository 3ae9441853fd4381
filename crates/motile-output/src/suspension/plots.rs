//! Plots of what many droplets do together.

use motile::analysis::suspension::PairCorrelations;

use super::SuspensionCsv;
use crate::OutputError;
use crate::plot::{AxisScale, Figure, Plot, Series};

/// Draws a run of a suspension: orders of the headings, contacts and the largest cluster over time; mean square
/// displacement and correlation of headings over the time between two states from the time `from` on
/// ([`SuspensionCsv::diffusion`]); correlations of `pairs` over their distance.
///
/// # Errors
/// Returns [`OutputError::Column`] for a table without the columns of a suspension.
pub fn suspension_plots(tables: &SuspensionCsv, from: f64, pairs: &PairCorrelations) -> Result<Figure, OutputError> {
    let plot =
        |title: &str, x: &str, y: &str| Plot::new(title).x_axis(x, AxisScale::Linear).y_axis(y, AxisScale::Linear);
    let over_time = |label: &str, column: &str| -> Result<Series, OutputError> {
        Ok(Series::line(label, tables.table().curve("time", column)?))
    };
    let diffusion = tables.diffusion(from);
    let over_lag = |label: &str, column: usize| Series::line(label, diffusion.iter().map(|row| (row[0], row[column])));
    let over_distance =
        |label: &str, values: &[f64]| Series::line(label, pairs.distances.iter().copied().zip(values.iter().copied()));
    Ok(Figure::new(2)
        .of_origin(tables.table().origin())
        .panel(
            plot("Order of headings", "t", "order")
                .series(over_time("polar", "polar_order")?)
                .series(over_time("nematic", "nematic_order")?),
        )
        .panel(
            plot("Contacts", "t", "number")
                .series(over_time("pairs in contact", "contacts")?)
                .series(over_time("largest cluster", "largest_cluster")?),
        )
        .panel(plot("Mean square displacement", "\u{394}t", "length^{2}").series(over_lag("", 1)))
        .panel(plot("Correlation of headings", "\u{394}t", "").series(over_lag("", 2)))
        .panel(plot("Pair correlation", "distance", "g").series(over_distance("", &pairs.pairs)).horizontal(1.0, ""))
        .panel(plot("Correlation of velocities", "distance", "").series(over_distance("", &pairs.velocities))))
}
