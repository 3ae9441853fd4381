//! The figures of the study.

use motile_examples::Summary;
use motile_output::{AxisScale, Figure, Marker, Plot, SERIES_COLOURS, Series};

use crate::viscosity_contrast::run::{Domain, Job};
use crate::viscosity_contrast::statements::{Points, equal, pairs, source_dipole};

/// All figures with their names.
pub(crate) fn all(points: &Points) -> [(&'static str, Figure); 5] {
    [
        ("speed", speed(points)),
        ("speed_and_source_dipole", source_dipoles(points)),
        ("shape", shape(points)),
        ("active_region", active_region(points)),
        ("beta", beta(points)),
    ]
}

/// A family of droplets.
struct Family {
    name: &'static str,
    has: fn(&Job) -> bool,
}

/// All families, in the order of their colours.
const FAMILIES: [Family; 4] = [
    Family { name: "equal viscosities", has: equal },
    Family { name: "more viscous inside, sum 1000", has: |job| job.inside > job.outside && job.sum() == 1000.0 },
    Family { name: "more viscous inside", has: |job| job.inside > job.outside && job.sum() != 1000.0 },
    Family { name: "more viscous outside", has: |job| job.inside < job.outside },
];

/// Discs for unbounded fluid, circles for the box, in the colours of the families.
fn by_family(
    mut plot: Plot,
    points: &Points,
    x: impl Fn(&Job, &Summary) -> f64 + Copy,
    y: impl Fn(&Job, &Summary) -> f64 + Copy,
) -> Plot {
    for (family, colour) in FAMILIES.iter().zip(SERIES_COLOURS) {
        for (domain, marker) in [(Domain::Unbounded, Marker::Disc), (Domain::Box, Marker::Circle)] {
            let label = if domain == Domain::Unbounded { family.name } else { "" };
            let values = pairs(points, x, y, |job| job.domain == domain && (family.has)(job));
            plot = plot.series(Series::points(label, values).marker(marker).colour(colour));
        }
    }
    plot
}

fn plot(title: &str, x: &str, y: &str) -> Plot {
    Plot::new(title).x_axis(x, AxisScale::Linear).y_axis(y, AxisScale::Linear)
}

/// Figures 2.8 to 2.10.
fn speed(points: &Points) -> Figure {
    let estimate = "|ζΔμ| c_{0} / 4(η_{in} + η_{ext})";
    let unbounded = |job: &Job| job.domain == Domain::Unbounded;
    let lines = |mut plot: Plot, keys: Vec<f64>, key: fn(&Job) -> f64, wanted: fn(&Job) -> bool, shift: f64| {
        for (value, colour) in keys.into_iter().zip(SERIES_COLOURS) {
            let mut line = pairs(
                points,
                |job, _| job.estimate(),
                |job, s| s.number("speed") - shift * (job.inside - job.outside) / (4.0 * job.sum()),
                |job| unbounded(job) && wanted(job) && key(job) == value,
            );
            line.sort_by(|a, b| a.0.total_cmp(&b.0));
            plot = plot.series(Series::line(&format!("{value}"), line).marker(Marker::Disc).colour(colour));
        }
        plot
    };
    let keys = |key: fn(&Job) -> f64, wanted: fn(&Job) -> bool| {
        let mut all: Vec<f64> = points.iter().map(|(job, _)| job).filter(|job| wanted(job)).map(key).collect();
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    };
    let sum: fn(&Job) -> bool = |job| job.sum() == 1000.0;
    let difference: fn(&Job) -> f64 = |job| job.inside - job.outside;
    let viscosity: fn(&Job) -> f64 = |job| job.outside;
    Figure::new(2)
        .panel(lines(plot("Equal viscosities η (2.8)", estimate, "|v|"), keys(viscosity, equal), viscosity, equal, 0.0))
        .panel(lines(
            plot("η_{in} − η_{ext}, sum 1000 (2.9)", estimate, "|v|"),
            keys(difference, sum),
            difference,
            sum,
            0.0,
        ))
        .panel(lines(
            plot("The same, shifted (2.10)", estimate, "|v| less shift"),
            keys(difference, sum),
            difference,
            sum,
            0.1,
        ))
}

/// Figures 2.11 to 2.13.
fn source_dipoles(points: &Points) -> Figure {
    let speed = |_: &Job, s: &Summary| s.number("speed");
    let corrected = "(|N_{xyy}| − (N_{yxy} − N_{yyx})/4) / (η_{in} + η_{ext})";
    Figure::new(2)
        .panel(by_family(
            plot("Speed and source dipole (2.11, 2.12)", "|N_{xyy}| / (η_{in} + η_{ext})", "|v|"),
            points,
            |job, s| s.number("n_xyy").abs() / job.sum(),
            speed,
        ))
        .panel(by_family(
            plot("With (2.60), far field", corrected, "|v|"),
            points,
            |job, s| source_dipole(s, "") / job.sum(),
            speed,
        ))
        .panel(by_family(
            plot("As printed (2.12)", "|N_{xyy}| / (η_{in} + η_{ext})", "|v|"),
            points,
            |job, s| s.number("n_xyy_printed").abs() / job.sum(),
            speed,
        ))
        .panel(by_family(
            plot("With (2.60), as printed (2.13)", corrected, "|v|"),
            points,
            |job, s| source_dipole(s, "_printed") / job.sum(),
            speed,
        ))
}

/// Figures 2.14 to 2.16 and 2.19.
fn shape(points: &Points) -> Figure {
    let aspect = |_: &Job, s: &Summary| s.number("aspect_ratio_moments");
    Figure::new(2)
        .panel(by_family(plot("Active fraction (2.14)", "aspect ratio", "active fraction"), points, aspect, |_, s| {
            s.number("active_fraction")
        }))
        .panel(by_family(plot("Stresslet (2.15)", "aspect ratio", "S_{xx}"), points, aspect, |_, s| {
            s.number("stresslet_xx")
        }))
        .panel(by_family(
            plot("Stresslet and quadrupole (2.16)", "aspect ratio", "S_{xx} / |S_{xxx}|"),
            points,
            aspect,
            |_, s| s.number("stresslet_xx") / s.number("s_xxx").abs(),
        ))
        .panel(by_family(
            plot("Active region (2.19)", "aspect ratio", "curvature (1/R_{0})"),
            points,
            aspect,
            |_, s| s.number("active_curvature"),
        ))
}

/// Figures 2.17 and 2.18.
fn active_region(points: &Points) -> Figure {
    Figure::new(2)
        .panel(by_family(
            plot("Active fraction (2.17)", "S_{xx} / |S_{xxx}|", "active fraction"),
            points,
            |_, s| s.number("stresslet_xx") / s.number("s_xxx").abs(),
            |_, s| s.number("active_fraction"),
        ))
        .panel(by_family(
            plot("As printed (2.18)", "ζΔμ", "F_{yyx} − F_{yxy}"),
            points,
            |job, _| job.activity,
            |_, s| s.number("f_yyx_printed") - s.number("f_yxy_printed"),
        ))
}

/// Figures 2.23 to 2.26.
fn beta(points: &Points) -> Figure {
    let beta = |_: &Job, s: &Summary| s.number("beta");
    Figure::new(2)
        .panel(by_family(plot("Squirmer parameter (2.23)", "ζΔμ", "β"), points, |job, _| job.activity, beta))
        .panel(by_family(
            plot("Squirmer parameter (2.24)", "active fraction", "β"),
            points,
            |_, s| s.number("active_fraction"),
            beta,
        ))
        .panel(by_family(
            plot("Stresslet over source dipole (2.25)", "S_{xx} / |N_{yxy}|", "β"),
            points,
            |_, s| s.number("stresslet_xx") / s.number("n_yxy").abs(),
            beta,
        ))
        .panel(by_family(
            plot("With (2.60) (2.26)", "S_{xx} / (|N_{xyy}| − (N_{yxy} − N_{yyx})/4)", "β"),
            points,
            |_, s| s.number("stresslet_xx") / source_dipole(s, ""),
            beta,
        ))
}
