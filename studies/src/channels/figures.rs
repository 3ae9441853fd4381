//! The figures of the study, and its table.

use motile_examples::{Summary, say};
use motile_output::{AxisScale, Figure, Marker, Plot, Rgb, SERIES_COLOURS, Series};

use crate::channels::run::{Job, NARROW, OSCILLATING, Purpose, THESIS_FITS};

/// Runs and their results.
pub(crate) type Points = [(Job, Summary)];

/// The values of an entry over a parameter, for the runs that are wanted.
fn series(points: &Points, x: fn(&Job) -> f64, y: &str, wanted: impl Fn(&Job) -> bool) -> Vec<(f64, f64)> {
    let chosen = points.iter().filter(|(job, _)| wanted(job));
    let mut values: Vec<(f64, f64)> = chosen.map(|(job, summary)| (x(job), summary.number(y))).collect();
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    values
}

fn in_narrow_channels(points: &Points, activity: f64, viscosity: f64) -> Vec<(f64, f64)> {
    series(
        points,
        |job| job.length,
        "speed",
        |job| (job.purpose, job.width, job.activity, job.viscosity) == (Purpose::Speed, NARROW, activity, viscosity),
    )
}

/// Table of the speeds in channels as wide as the droplet, with Cowley's fits and the deviation from them.
pub(crate) fn print_speeds(points: &Points) {
    say("Speed in channels as wide as the droplet");
    say(format_args!(
        "  {:>6} {:>8} {:>9}  {:>7}  {:>11} {:>12}  {:>9}",
        "length", "activity", "viscosity", "speed", "Cowley, fit", "Cowley (3.7)", "deviation"
    ));
    for (activity, viscosity, _, _) in THESIS_FITS {
        for (length, speed) in in_narrow_channels(points, activity, viscosity) {
            let job = points.iter().map(|(job, _)| job).find(|job| {
                (job.purpose, job.length, job.width) == (Purpose::Speed, length, NARROW)
                    && (job.activity, job.viscosity) == (activity, viscosity)
            });
            if let Some([Some(fit), Some(expression)]) = job.map(Job::thesis_speeds) {
                let deviation = 100.0 * (speed / fit - 1.0);
                say(format_args!(
                    "  {length:>6} {activity:>8} {viscosity:>9}  {speed:>7.4}  {fit:>11.4} {expression:>12.4}  \
                     {deviation:>+7.1} %"
                ));
            }
        }
    }
}

fn curve(from: f64, to: f64, f: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    (0..=80).map(|k| from + (to - from) * f64::from(k) / 80.0).map(|x| (x, f(x))).collect()
}

/// Entries of the legend without points: what lines of all colours mean.
fn key(label: &str) -> Series {
    Series::line(label, [(f64::NAN, f64::NAN)]).colour(Rgb::GREY)
}

/// Figures 3.1 and 3.2 of Cowley.
pub(crate) fn speed_against_length(points: &Points) -> Figure {
    let longest = points.iter().map(|(job, _)| job.length).fold(8.0, f64::max);
    let panel = |title: &str, chosen: &dyn Fn(f64, f64) -> Option<String>| {
        let mut plot = Plot::new(title)
            .x_axis("length l (R_{0})", AxisScale::Linear)
            .y_axis("|v| (R_{0} per time)", AxisScale::Linear);
        let fits = THESIS_FITS.iter().filter_map(|fit| Some((fit, chosen(fit.0, fit.1)?)));
        for (&(activity, viscosity, a, b), (colour, label)) in
            fits.clone().map(|(fit, _)| fit).zip(SERIES_COLOURS.into_iter().zip(fits.map(|(_, label)| label)))
        {
            let ratio = activity.abs() / viscosity;
            plot = plot
                .series(
                    Series::points(&label, in_narrow_channels(points, activity, viscosity))
                        .marker(Marker::Disc)
                        .colour(colour),
                )
                .series(Series::line("", curve(6.0, longest, |l| a * (-l / 10.0).exp() + b)).colour(colour))
                .series(
                    Series::line("", curve(6.0, longest, |l| ratio * (10.0 * (-l / 10.0).exp() + 1.0)))
                        .dashed()
                        .colour(colour),
                );
        }
        plot.series(key("Cowley, fit to its points")).series(key("Cowley, (3.7)").dashed())
    };
    Figure::new(2)
        .panel(panel("Speed in channels of width 2, η = 100", &|activity, viscosity| {
            (viscosity == 100.0).then(|| format!("ζΔμ = −{}", activity.abs()))
        }))
        .panel(panel("Speed in channels of width 2, ζΔμ = −4", &|activity, viscosity| {
            (activity == -4.0).then(|| format!("η = {viscosity}"))
        }))
}

/// Figure 3.4 of Cowley.
pub(crate) fn speed_against_width(points: &Points) -> Figure {
    let mut plot = Plot::new("Speed in channels of length 12, η = 100")
        .x_axis("width w (R_{0})", AxisScale::Linear)
        .y_axis("|v| (R_{0} per time)", AxisScale::Linear)
        .x_range(1.9, 6.4);
    for (activity, colour) in [-1.0, -2.0, -3.0, -4.0, -5.0].into_iter().zip(SERIES_COLOURS) {
        let of = |job: &Job, purpose| (job.purpose, job.activity, job.viscosity) == (purpose, activity, 100.0);
        let speeds = series(points, |job| job.width, "speed", |job| of(job, Purpose::Speed) && job.length == 12.0);
        let unconfined = series(points, |_| 0.0, "speed", |job| of(job, Purpose::Unconfined));
        let label = format!("ζΔμ = −{}", activity.abs());
        plot = plot.series(Series::line(&label, speeds).marker(Marker::Disc).colour(colour));
        if let Some(&(_, speed)) = unconfined.first() {
            plot = plot.series(Series::line("", [(1.9, speed), (5.2, speed)]).dashed().colour(colour));
        }
    }
    Figure::new(1).panel(plot.series(key("box 12 × 12").dashed())).panel_size(640.0, 400.0)
}

/// Figure 3.11 of Cowley.
pub(crate) fn amplitude_against_length(points: &Points) -> Figure {
    let steady = |points: &Points, yes: bool| {
        let chosen: Vec<(Job, Summary)> = points
            .iter()
            .filter(|(job, summary)| {
                let regime = summary.values().get("regime").and_then(|regime| regime.as_str());
                job.purpose == Purpose::Amplitude && (regime == Some("steady oscillation")) == yes
            })
            .cloned()
            .collect();
        series(&chosen, |job| job.length, "amplitude", |_| true)
    };
    let all = |y| series(points, |job| job.length, y, |job| job.purpose == Purpose::Amplitude);
    let radius = all("radius_across").last().map_or(1.0, |last| last.1);
    let end = all("amplitude").last().map_or(36.0, |last| last.0);
    let thesis = curve(18.0, end, |l| 0.6 * (0.5 * OSCILLATING - radius) * (1.0 - (-(l - 18.0) / 10.0).exp()));
    let plot = Plot::new("Oscillations in channels of width 3, ζΔμ = −4, η = 100, A = 13.5")
        .x_axis("length l (R_{0})", AxisScale::Linear)
        .y_axis("amplitude (R_{0})", AxisScale::Linear)
        .series(Series::points("steady oscillation", steady(points, true)))
        .series(Series::points("growing or decaying", steady(points, false)).marker(Marker::Circle))
        .series(Series::line("Cowley, (3.9)", thesis));
    Figure::new(1).panel(plot).panel_size(640.0, 400.0)
}
