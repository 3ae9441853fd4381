//! Plots of the observables of a droplet.

use motile::active_interface::observables::ConcentrationProfile;

use crate::drawing::axes::AxisScale;
use crate::plot::{contents::Plot, figure::Figure, series::Series};
use crate::time_label::time_label;
use crate::{CsvTable, OutputError};

/// Returns the figure of speed, aspect ratios, stresslet and squirmer parameter over time; between walls also of height
/// and gap. Quantities are in the units of the scene.
///
/// # Errors
/// Returns [`OutputError::Column`] for a table without these columns.
pub fn time_series(table: &CsvTable) -> Result<Figure, OutputError> {
    let plot = |title: &str, label: &str| {
        Plot::new(title).x_axis("time t", AxisScale::Linear).y_axis(label, AxisScale::Linear)
    };
    let line = |label: &str, column: &str| Ok::<_, OutputError>(Series::line(label, table.curve("time", column)?));
    let figure = Figure::new(2)
        .panel(plot("Speed", "|v|").series(line("", "speed")?))
        .panel(
            plot("Shape", "aspect ratio a/b")
                .series(line("area moments", "aspect_ratio_moments")?)
                .series(line("fitted ellipse", "aspect_ratio_ellipse")?.dashed())
                .horizontal(1.0, ""),
        )
        .panel(
            plot("Stresslet along the motion", "S_{xx}")
                .series(line("", "stresslet_xx")?)
                .horizontal(0.0, "pushers above, pullers below"),
        )
        .panel(plot("Squirmer parameter", "β = B_{2}/|B_{1}|").series(line("", "beta")?).horizontal(0.0, "neutral"));
    let figure = figure.of_origin(table.origin());
    if table.curve("time", "gap").is_err() {
        return Ok(figure);
    }
    Ok(figure
        .panel(plot("Height of the centroid", "y").series(line("", "y")?).horizontal(0.0, ""))
        .panel(plot("Gap to the walls", "gap").series(line("", "gap")?).horizontal(0.0, "")))
}

/// Returns the figure of the concentration over `mean_concentration` (particles per length) along the interface,
/// counter-clockwise from the front, at the start and at `time`.
#[must_use]
pub fn concentration_plot(
    start: &ConcentrationProfile,
    end: &ConcentrationProfile,
    time: f64,
    mean_concentration: f64,
) -> Figure {
    let line = |label: &str, profile: &ConcentrationProfile| {
        let arc = profile.arc.iter().map(|s| s / profile.perimeter);
        Series::line(label, arc.zip(profile.concentration.iter().map(|c| c / mean_concentration)).collect::<Vec<_>>())
    };
    let plot = Plot::new("Concentration along the interface")
        .x_axis("arc length from the front, in perimeters (rear: 0.5)", AxisScale::Linear)
        .x_range(0.0, 1.0)
        .y_axis("c/c_{0}", AxisScale::Linear)
        .series(line(&format!("t = {}", time_label(time)), end))
        .series(line("t = 0", start).dashed())
        .horizontal(1.0, "mean at the start");
    Figure::new(1).panel(plot)
}
