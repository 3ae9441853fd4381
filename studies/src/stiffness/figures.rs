//! The figures of the study.

use std::path::Path;

use anyhow::Result;
use motile_examples::Summary;
use motile_output::{AxisScale, Figure, Marker, Plot, SERIES_COLOURS, Series};

use crate::stiffness::run::{Job, Purpose};
use crate::stiffness::tables::{Points, fitted, of};

pub(crate) fn write(points: &Points, directory: &Path) -> Result<()> {
    let mut widths: Vec<f64> = of(points, Purpose::Speed).iter().map(|(job, _)| job.width).collect();
    widths.dedup();
    for width in widths {
        let k = |job: &Job, _: &Summary| job.stiffness;
        let log = ("stiffness k", AxisScale::Logarithmic);
        let value = |name: &'static str| move |_: &Job, summary: &Summary| summary.number(name);
        let figure = Figure::new(2)
            .panel(with_fits(
                points,
                width,
                panel(points, width, "Speed", log, "|v| (R_{0} per time)", k, value("speed")),
            ))
            .panel(panel(points, width, "Aspect ratio", log, "a/b", k, value("aspect_ratio")))
            .panel(panel(points, width, "Curvature of the active region", log, "1/R_{0}", k, value("active_curvature")))
            .panel(panel(
                points,
                width,
                "Walls and droplet",
                ("largest displacement of the walls (R_{0})", AxisScale::Linear),
                "a/b − 1",
                value("largest_displacement"),
                |_, summary| summary.number("aspect_ratio") - 1.0,
            ));
        figure.write(directory, &format!("stiffness_width_{width}"))?;
    }
    Ok(())
}

fn activities(points: &Points, width: f64) -> Vec<f64> {
    let chosen = of(points, Purpose::Speed);
    let mut activities: Vec<f64> =
        chosen.iter().filter(|(job, _)| job.width == width).map(|(job, _)| job.activity).collect();
    activities.dedup();
    activities
}

fn panel(
    points: &Points,
    width: f64,
    title: &str,
    (x_name, x_scale): (&str, AxisScale),
    y_name: &str,
    x: impl Fn(&Job, &Summary) -> f64,
    y: impl Fn(&Job, &Summary) -> f64,
) -> Plot {
    let mut plot =
        Plot::new(&format!("{title}, w = {width}")).x_axis(x_name, x_scale).y_axis(y_name, AxisScale::Linear);
    for (activity, colour) in activities(points, width).into_iter().zip(SERIES_COLOURS.iter().cycle()) {
        let chosen =
            of(points, Purpose::Speed).into_iter().filter(|(job, _)| (job.width, job.activity) == (width, activity));
        let values: Vec<(f64, f64)> = chosen.map(|(job, summary)| (x(job, summary), y(job, summary))).collect();
        let label = format!("ζΔμ = {activity}").replace('-', "−");
        plot = plot.series(Series::points(&label, values).marker(Marker::Disc).colour(*colour));
    }
    plot
}

/// Adds the fits (4.3).
fn with_fits(points: &Points, width: f64, mut plot: Plot) -> Plot {
    for (activity, colour) in activities(points, width).into_iter().zip(SERIES_COLOURS.iter().cycle()) {
        let runs = of(points, Purpose::Speed);
        let like = runs.iter().find(|(job, _)| (job.width, job.activity) == (width, activity));
        if let Some((free, rigid, b)) = like.and_then(|(job, _)| fitted(points, job)) {
            let curve = (0..=60).map(|n| 10_f64.powf(4.0 + f64::from(n) / 30.0));
            let curve = curve.map(|k| (k, (free - rigid) * (-k / b).exp() + rigid));
            plot = plot.series(Series::line("", curve).colour(*colour));
        }
    }
    plot
}
