//! Error against cost.

use motile_output::plot::{AxisScale, Figure, Marker, Plot, Series};

use crate::work_precision::front::{Point, front};
use crate::work_precision::studies::Study;

const FAMILIES: [(&str, Marker); 4] = [
    ("boundary integrals", Marker::Disc),
    ("grid, corrected", Marker::Square),
    ("grid, uncorrected", Marker::Circle),
    ("thesis", Marker::Triangle),
];

/// All points of a study, the front as a line.
pub(crate) fn figure(study: Study, points: &[Point]) -> Figure {
    let at = |point: &Point| (point.pairs(), 100.0 * point.error());
    let mut plot = Plot::new(study.title())
        .x_axis("cost (transforms of 120 × 120 per time)", AxisScale::Logarithmic)
        .y_axis("error (%)", AxisScale::Logarithmic);
    for (family, marker) in FAMILIES {
        let own: Vec<_> = points.iter().filter(|point| point.settings.family() == family).map(at).collect();
        if !own.is_empty() {
            plot = plot.series(Series::points(family, own).marker(marker));
        }
    }
    plot = plot.series(Series::line("front", front(points).into_iter().map(at)).dashed());
    Figure::new(1).panel(plot).panel_size(640.0, 420.0)
}
