//! Cowley's statements beside what the runs say.

use motile_examples::Summary;
use motile_tests::validation::Table;

use crate::viscosity_contrast::run::{Domain, Job};

/// Runs and their results.
pub(crate) type Points = [(Job, Summary)];

/// Values of two entries of the runs that swim and are wanted.
pub(crate) fn pairs(
    points: &Points,
    x: impl Fn(&Job, &Summary) -> f64,
    y: impl Fn(&Job, &Summary) -> f64,
    wanted: impl Fn(&Job) -> bool,
) -> Vec<(f64, f64)> {
    let swims = |summary: &Summary| summary.values().get("swims").and_then(serde_json::Value::as_bool) == Some(true);
    let chosen = points.iter().filter(|(job, summary)| wanted(job) && swims(summary));
    chosen
        .map(|(job, summary)| (x(job, summary), y(job, summary)))
        .filter(|(x, y)| x.is_finite() && y.is_finite())
        .collect()
}

pub(crate) fn equal(job: &Job) -> bool {
    job.inside == job.outside
}

/// (2.60) times the sum of the viscosities; `suffix` chooses the convention.
pub(crate) fn source_dipole(summary: &Summary, suffix: &str) -> f64 {
    let n = |name: &str| summary.number(&format!("{name}{suffix}"));
    n("n_xyy").abs() - 0.25 * (n("n_yxy") - n("n_yyx"))
}

/// Correlation coefficient.
fn correlation(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let (mx, my) = points.iter().fold((0.0, 0.0), |(a, b), (x, y)| (a + x / n, b + y / n));
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for (x, y) in points {
        xx += (x - mx) * (x - mx);
        xy += (x - mx) * (y - my);
        yy += (y - my) * (y - my);
    }
    xy / (xx * yy).sqrt()
}

/// Mean of y/x, and its standard deviation relative to that: how well a line through the origin fits.
fn slope(points: &[(f64, f64)]) -> (f64, f64) {
    let n = points.len() as f64;
    let mean = points.iter().map(|(x, y)| y / x).sum::<f64>() / n;
    let variance = points.iter().map(|(x, y)| (y / x - mean).powi(2)).sum::<f64>() / n;
    (mean, variance.sqrt() / mean.abs())
}

/// Relative spread (largest less smallest over the mean) of values that share a key, the mean over the keys.
fn spread(mut values: Vec<(f64, f64)>) -> f64 {
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    let groups: Vec<f64> = values
        .chunk_by(|a, b| (a.0 - b.0).abs() < 1e-9)
        .filter(|group| group.len() > 1)
        .map(|group| {
            let all = group.iter().map(|(_, v)| *v);
            let (least, most) = all.clone().fold((f64::INFINITY, 0.0_f64), |(a, b), v| (a.min(v), b.max(v)));
            (most - least) / (all.sum::<f64>() / group.len() as f64)
        })
        .collect();
    groups.iter().sum::<f64>() / groups.len() as f64
}

/// The table in Markdown, for unbounded fluid and for the box.
pub(crate) fn table(points: &Points) -> Table {
    let header = ["figure", "Cowley", "unbounded fluid", "box 12 x 12"];
    let mut table = Table::new("Section 2.3 of Cowley: statements beside what the runs say", &header);
    for (figure, statement, measure) in STATEMENTS {
        let of = |domain: Domain| {
            let own: Vec<_> = points.iter().filter(|(job, _)| job.domain == domain).cloned().collect();
            measure(&own)
        };
        table.push([figure.to_owned(), statement.to_owned(), of(Domain::Unbounded), of(Domain::Box)]);
    }
    table
}

type Measure = fn(&Points) -> String;

/// Figure or section, statement, and what the runs say to it.
const STATEMENTS: [(&str, &str, Measure); 18] = [
    ("2.8", "equal viscosities: speeds do not collapse over abs(zeta_dmu) c0/4(eta_in + eta_ext)", |points| {
        let speeds = pairs(points, |job, _| job.estimate(), |_, s| s.number("speed"), equal);
        format!("spread at the same abscissa {:.1} %", 100.0 * spread(speeds))
    }),
    ("2.8", "the threshold agrees with linear theory (2.20)", |points| thresholds(points, equal)),
    ("2.9", "constant sum: the larger the difference of viscosities, the faster", |points| {
        constant_sum(points, |job, s| s.number("speed") + 0.0 * job.sum())
    }),
    ("2.10", "a shift by (D/R0)(eta_in - eta_ext)/4(eta_in + eta_ext) collapses the curves", |points| {
        constant_sum(points, |job, s| s.number("speed") - 0.1 * (job.inside - job.outside) / (4.0 * job.sum()))
    }),
    ("2.3.3.3", "(1000, 10) moves steadily at -1, below the threshold -2.02 of linear theory", |points| {
        points.iter().find(|(job, _)| (job.inside, job.outside, job.activity) == (1000.0, 10.0, -1.0)).map_or_else(
            || "not run".to_owned(),
            |(_, s)| {
                format!("decays: speed {:.1e}, rate {:.4} (theory -0.0505)", s.number("speed"), s.number("speed_rate"))
            },
        )
    }),
    ("2.3.3.3", "contrast lowers the threshold", |points| thresholds(points, |job| !equal(job))),
    ("2.11", "equal viscosities: speed proportional to abs(N_xyy)/(eta_in + eta_ext)", |points| {
        line(&pairs(points, |job, s| s.number("n_xyy").abs() / job.sum(), |_, s| s.number("speed"), equal))
    }),
    ("2.12", "all droplets: linear, with slopes that depend on the difference", |points| {
        conventions(points, |s, suffix| s.number(&format!("n_xyy{suffix}")).abs())
    }),
    ("2.13", "the correction (2.60) restores one line", |points| conventions(points, source_dipole)),
    (
        "2.13",
        "(not in Cowley) the factor a for which abs(N_xyy) + a (N_yxy - N_yyx) comes closest to one line",
        |points| {
            let with = |suffix: &str| {
                let scatter = |a: f64| slope(&source_dipoles(points, a, suffix)).1;
                let factors = (-100..=100).map(|k| 0.01 * f64::from(k));
                let best = factors.min_by(|a, b| scatter(*a).total_cmp(&scatter(*b))).unwrap_or(0.0);
                format!("a = {best:.2}: {}", line(&source_dipoles(points, best, suffix)))
            };
            format!("far field: {}; as printed: {}", with(""), with("_printed"))
        },
    ),
    ("2.3.1", "equal viscosities: nearly circles", |points| deformation(points, equal)),
    ("2.3.1", "contrast: pronounced deformation", |points| deformation(points, |job| !equal(job))),
    ("2.15", "aspect ratio falls with the stresslet", |points| {
        related(points, |s| s.number("stresslet_xx"), |s| s.number("aspect_ratio_moments"))
    }),
    ("2.17", "active fraction falls with S_xx/abs(S_xxx)", |points| {
        related(points, |s| s.number("stresslet_xx") / s.number("s_xxx").abs(), |s| s.number("active_fraction"))
    }),
    ("2.18", "F_yyx - F_yxy is negative where the active region is concave, and only there", |points| {
        let swimming = pairs(
            points,
            |_, s| s.number("f_yyx_printed") - s.number("f_yxy_printed"),
            |_, s| s.number("active_curvature"),
            |job| !equal(job),
        );
        let negative = swimming.iter().filter(|p| p.0 < 0.0).count();
        let concave = swimming.iter().filter(|p| p.1 < 0.0).count();
        let both = swimming.iter().filter(|p| p.0 < 0.0 && p.1 < 0.0).count();
        format!("of {}: {negative} negative, {concave} concave, {both} both", swimming.len())
    }),
    ("2.19", "curvature of the active region rises with the aspect ratio", |points| {
        related(points, |s| s.number("aspect_ratio_moments"), |s| s.number("active_curvature"))
    }),
    ("2.24", "beta rises with the active fraction", |points| {
        related(points, |s| s.number("active_fraction"), |s| s.number("beta"))
    }),
    (
        "2.25, 2.26",
        "beta proportional to S_xx over the source dipole: abs(N_yxy) for equal viscosities, (2.60) for all",
        |points| {
            let same = pairs(
                points,
                |_, s| s.number("stresslet_xx") / s.number("n_yxy").abs(),
                |_, s| s.number("beta"),
                equal,
            );
            let all = pairs(
                points,
                |_, s| s.number("stresslet_xx") / source_dipole(s, ""),
                |_, s| s.number("beta"),
                |_| true,
            );
            let printed = pairs(
                points,
                |_, s| s.number("stresslet_xx_printed") / source_dipole(s, "_printed"),
                |_, s| s.number("beta"),
                |_| true,
            );
            let [same, all, printed] = [same, all, printed].map(|points| correlation(&points));
            format!("correlation {same:.3}; all {all:.3}, as printed {printed:.3}")
        },
    ),
];

/// Which droplets below and above the threshold (2.20) swim.
fn thresholds(points: &Points, wanted: impl Fn(&Job) -> bool) -> String {
    let mut counts = [[0; 2]; 2];
    for (job, summary) in points.iter().filter(|(job, _)| wanted(job)) {
        let above = job.activity < -0.002 * job.sum();
        let swims = summary.values().get("swims").and_then(serde_json::Value::as_bool) == Some(true);
        counts[usize::from(above)][usize::from(swims)] += 1;
    }
    let [[rest, early], [late, swim]] = counts;
    format!("below it {early} of {} swim, above it {swim} of {}", rest + early, late + swim)
}

fn constant_sum(points: &Points, value: impl Fn(&Job, &Summary) -> f64) -> String {
    let wanted = |job: &Job| job.sum() == 1000.0;
    let values = pairs(points, |job, _| job.activity, &value, wanted);
    let rises = pairs(points, |job, _| job.inside - job.outside, &value, |job| wanted(job) && job.activity == -5.0);
    let mut rises = rises;
    rises.sort_by(|a, b| a.0.total_cmp(&b.0));
    let list: Vec<String> = rises.iter().map(|(d, v)| format!("{v:.4} ({d:+})")).collect();
    format!("spread {:.1} %; at -5: {}", 100.0 * spread(values), list.join(", "))
}

/// Speeds over `(|N_xyy| + a (N_yxy - N_yyx))/(eta_in + eta_ext)`.
fn source_dipoles(points: &Points, a: f64, suffix: &str) -> Vec<(f64, f64)> {
    let dipole = |s: &Summary| {
        let n = |name: &str| s.number(&format!("{name}{suffix}"));
        n("n_xyy").abs() + a * (n("n_yxy") - n("n_yyx"))
    };
    pairs(points, |job, s| dipole(s) / job.sum(), |_, s| s.number("speed"), |_| true)
}

fn deformation(points: &Points, wanted: impl Fn(&Job) -> bool) -> String {
    let off = pairs(points, |job, _| job.sum(), |_, s| (s.number("aspect_ratio_moments") - 1.0).abs(), wanted);
    format!("aspect ratios within {:.3} of 1", off.iter().map(|p| p.1).fold(0.0, f64::max))
}

fn line(points: &[(f64, f64)]) -> String {
    let (mean, deviation) = slope(points);
    format!("slope {mean:.4}, scatter {:.2} %, correlation {:.5}", 100.0 * deviation, correlation(points))
}

fn conventions(points: &Points, dipole: impl Fn(&Summary, &str) -> f64) -> String {
    let with =
        |suffix: &str| line(&pairs(points, |job, s| dipole(s, suffix) / job.sum(), |_, s| s.number("speed"), |_| true));
    format!("far field: {}; as printed: {}", with(""), with("_printed"))
}

fn related(points: &Points, x: impl Fn(&Summary) -> f64, y: impl Fn(&Summary) -> f64) -> String {
    let of = |wanted: fn(&Job) -> bool| correlation(&pairs(points, |_, s| x(s), |_, s| y(s), wanted));
    format!("correlation {:.2} (equal viscosities {:.2})", of(|_| true), of(equal))
}
