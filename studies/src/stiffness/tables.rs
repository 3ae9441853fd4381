//! The tables of the study.

use motile_examples::Summary;
use motile_tests::validation::Table;

use crate::stiffness::history::{FOLLOWED, Rows};
use crate::stiffness::run::{Job, Purpose};

/// Runs and their results.
pub(crate) type Points = [(Job, Summary)];

/// What a column shows of a run.
type Value = fn(&Job, &Summary) -> String;

pub(crate) fn of(points: &Points, purpose: Purpose) -> Vec<&(Job, Summary)> {
    let mut chosen: Vec<_> = points.iter().filter(|(job, _)| job.purpose == purpose).collect();
    let key = |job: &Job| (job.width, -job.activity, job.stiffness, job.ratio, -job.spacing);
    chosen.sort_by(|(a, _), (b, _)| key(a).partial_cmp(&key(b)).unwrap_or(std::cmp::Ordering::Equal));
    chosen
}

/// The tables of a purpose.
pub(crate) fn tables(points: &Points, purpose: Purpose) -> Vec<Table> {
    match purpose {
        Purpose::Speed => vec![speeds(points), fits(points)],
        Purpose::Lateral => vec![lateral(points)],
        Purpose::Passage => vec![map(points), passages(points)],
        Purpose::Comparison => vec![comparison(points), over_time(points)],
        Purpose::Narrow => vec![narrow(points)],
        Purpose::Contrast => vec![contrast(points)],
        Purpose::Start => vec![starts(points)],
        Purpose::Rest => vec![rests(points)],
        Purpose::Rigid | Purpose::Unconfined => Vec::new(),
    }
}

/// A row for each run of a purpose.
fn rows(points: &Points, purpose: Purpose, title: &str, columns: &[(&str, Value)]) -> Table {
    let names: Vec<&str> = columns.iter().map(|(name, _)| *name).collect();
    let mut table = Table::new(title, &names);
    for (job, summary) in of(points, purpose) {
        table.push(columns.iter().map(|(_, value)| value(job, summary)));
    }
    table
}

const WIDTH: (&str, Value) = ("width", |job, _| job.width.to_string());
const ACTIVITY: (&str, Value) = ("activity", |job, _| job.activity.to_string());
const STIFFNESS: (&str, Value) = ("k", |job, _| format!("{:e}", job.stiffness));
const SPACING: (&str, Value) = ("h", |job, _| job.spacing.to_string());
const SPEED: (&str, Value) = ("speed", |_, run| format!("{:.5}", run.number("speed")));
const ASPECT: (&str, Value) = ("aspect ratio", |_, run| format!("{:.3}", run.number("aspect_ratio")));
const CHANNEL: (&str, Value) = ("width of the channel", |_, run| {
    format!("{:.3} - {:.3}", run.number("channel_width_min"), run.number("channel_width_max"))
});
const GAP: (&str, Value) = ("smallest gap", |_, run| format!("{:.4}", run.number("minimum_gap")));
const JACOBIAN: (&str, Value) = ("smallest J", |_, run| format!("{:.2}", run.number("smallest_jacobian")));
const FAILURE: (&str, Value) = ("failure", |_, run| text(run, "failure").to_owned());

fn text<'a>(summary: &'a Summary, name: &str) -> &'a str {
    summary.values().get(name).and_then(|value| value.as_str()).unwrap_or_default()
}

/// Speed between rigid walls or unconfined, if it was computed.
fn speed_of(points: &Points, purpose: Purpose, like: &Job) -> Option<f64> {
    let same = |job: &Job| {
        job.purpose == purpose
            && (job.activity, job.time) == (like.activity, like.time)
            && (purpose == Purpose::Unconfined || job.width == like.width)
    };
    points.iter().find(|(job, _)| same(job)).map(|(_, summary)| summary.number("speed"))
}

fn speeds(points: &Points) -> Table {
    let columns = [WIDTH, ACTIVITY, STIFFNESS, SPACING, SPEED, ASPECT, CHANNEL, GAP, FAILURE];
    let mut names: Vec<&str> = columns.iter().map(|(name, _)| *name).collect();
    names.splice(5..5, ["rigid", "over rigid"]);
    names.insert(9, "largest displacement");
    let mut table = Table::new("Speed between walls of springs (figures 4.4 to 4.9)", &names);
    for (job, summary) in of(points, Purpose::Speed) {
        let mut row: Vec<String> = columns.iter().map(|(_, value)| value(job, summary)).collect();
        let rigid = speed_of(points, Purpose::Rigid, job);
        let excess = rigid.map(|rigid| 100.0 * (summary.number("speed") / rigid - 1.0));
        let shown = [rigid.map(|v| format!("{v:.5}")), excess.map(|e| format!("{e:+.1} %"))];
        row.splice(5..5, shown.map(Option::unwrap_or_default));
        row.insert(9, format!("{:.4}", summary.number("largest_displacement")));
        table.push(row);
    }
    table
}

/// The constant b of (4.3), `v = (v_unconfined - v_rigid) exp(-k/b) + v_rigid`, by least squares over the runs of the
/// width, activity and spacing of a job.
pub(crate) fn fitted(points: &Points, like: &Job) -> Option<(f64, f64, f64)> {
    let rigid = speed_of(points, Purpose::Rigid, like)?;
    let free = speed_of(points, Purpose::Unconfined, like)?;
    let key = |job: &Job| (job.width, job.activity, job.spacing, job.time);
    let runs = of(points, Purpose::Speed).into_iter().filter(|(job, _)| key(job) == key(like));
    let speeds: Vec<(f64, f64)> = runs.map(|(job, summary)| (job.stiffness, summary.number("speed"))).collect();
    if speeds.len() < 2 {
        return None;
    }
    let error =
        |b: f64| -> f64 { speeds.iter().map(|(k, v)| ((free - rigid) * (-k / b).exp() + rigid - v).powi(2)).sum() };
    let candidates = (0..=4000).map(|n| 10_f64.powf(3.0 + 0.001 * f64::from(n)));
    let b = candidates.min_by(|a, b| error(*a).total_cmp(&error(*b)))?;
    Some((free, rigid, b))
}

fn fits(points: &Points) -> Table {
    let columns = ["width", "activity", "h", "unconfined", "rigid", "b"];
    let mut table = Table::new("Fits of (4.3) to the speeds", &columns);
    for (job, _) in of(points, Purpose::Rigid) {
        if let Some((free, rigid, b)) = fitted(points, job) {
            let [width, activity, h] = [job.width, job.activity, job.spacing].map(|value| value.to_string());
            table.push([width, activity, h, format!("{free:.5}"), format!("{rigid:.5}"), format!("{b:.3e}")]);
        }
    }
    table
}

fn lateral(points: &Points) -> Table {
    let title = "Droplets that start 0.3 R0 off the centre line (figure 4.17), A = 13.5";
    let columns: [(&str, Value); 3] = [
        ("regime", |_, run| text(run, "regime").to_owned()),
        ("amplitude", |_, run| format!("{:.4}", run.number("amplitude"))),
        ("growth rate", |_, run| format!("{:+.4}", run.number("growth_rate"))),
    ];
    rows(points, Purpose::Lateral, title, &[&[WIDTH, ACTIVITY, STIFFNESS, SPACING][..], &columns, &[FAILURE]].concat())
}

/// Verdicts and their times by stiffness and activity.
fn map(points: &Points) -> Table {
    let chosen = of(points, Purpose::Passage);
    let mut activities: Vec<f64> = chosen.iter().map(|(job, _)| job.activity).collect();
    activities.dedup();
    let mut lines: Vec<(f64, f64, String)> =
        chosen.iter().map(|(job, _)| (-job.spacing, job.stiffness, method(job))).collect();
    lines.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
    lines.dedup();
    let names = ["h", "k", "method"].map(str::to_owned).into_iter().chain(activities.iter().map(f64::to_string));
    let names: Vec<String> = names.collect();
    let title = "Passage through the constriction (figure 4.19): verdict and its time over the activity";
    let mut table = Table::new(title, &names.iter().map(String::as_str).collect::<Vec<_>>());
    for (spacing, stiffness, method_of_line) in lines {
        let verdict = |activity: &f64| {
            let run = chosen.iter().find(|(job, _)| {
                (job.activity, -job.spacing, job.stiffness) == (*activity, spacing, stiffness)
                    && method(job) == method_of_line
            });
            run.map_or(String::new(), |(_, summary)| {
                let verdict = text(summary, "verdict");
                format!("{} ({:.0})", verdict.replace('_', " "), summary.number("verdict_time"))
            })
        };
        let key = [(-spacing).to_string(), format!("{stiffness:e}"), method_of_line.clone()];
        table.push(key.into_iter().chain(activities.iter().map(verdict)));
    }
    table
}

fn passages(points: &Points) -> Table {
    let columns: [(&str, Value); 4] = [
        ("method", |job, _| method(job)),
        ("verdict", |_, run| text(run, "verdict").to_owned()),
        ("time", |_, run| format!("{:.1}", run.number("verdict_time"))),
        ("furthest x", |_, run| format!("{:.2}", run.number("furthest_x"))),
    ];
    let columns = [&[STIFFNESS, ACTIVITY, SPACING][..], &columns, &[GAP, JACOBIAN, FAILURE]].concat();
    rows(points, Purpose::Passage, "Passage through the constriction: films and furthest places", &columns)
}

/// What is not the default in a run.
fn method(job: &Job) -> String {
    let mut parts = Vec::new();
    if job.thesis {
        parts.push("thesis".to_owned());
    }
    if job.equidistant {
        parts.push("markers equally spaced".to_owned());
    }
    if job.back > 0.0 {
        parts.push(format!("walls {:.3} further back", job.back));
    }
    parts.join(", ")
}

const KIND: [(&str, Value); 2] =
    [("material", |job, _| format!("{:?}", job.material)), ("mesh", |job, _| format!("{:?}", job.mesh))];

fn comparison(points: &Points) -> Table {
    let title = "Kinds of walls, viscosity 1000, activity -10, k = 1e4 (figures 4.2, 4.3, 4.22, 4.23)";
    rows(points, Purpose::Comparison, title, &[&KIND[..], &[SPACING, SPEED, CHANNEL, JACOBIAN, FAILURE]].concat())
}

/// How far runs are from one another over the time of both, relative to the plateau of the other.
fn over_time(points: &Points) -> Table {
    let chosen = of(points, Purpose::Comparison);
    let names = FOLLOWED.map(|name| name.replace('_', " "));
    let header: Vec<&str> = ["run", "other run", "h"].into_iter().chain(names.iter().map(String::as_str)).collect();
    let title = "Largest difference over the run (root mean square) in per cent of the plateau of the other";
    let mut table = Table::new(title, &header);
    for (job, summary) in &chosen {
        for (other, reference) in &chosen {
            let alike = (other.material == job.material) != (other.mesh == job.mesh);
            if !alike || job.spacing != other.spacing {
                continue;
            }
            let (rows, others) = (Rows::of(summary), Rows::of(reference));
            let differences = FOLLOWED.iter().enumerate().map(|(column, name)| {
                let ((largest, mean), plateau) = (rows.difference(&others, column), reference.number(name));
                format!("{:.2} ({:.2})", 100.0 * largest / plateau, 100.0 * mean / plateau)
            });
            let kind = |job: &Job| format!("{:?}, {:?}", job.material, job.mesh);
            table.push([kind(job), kind(other), job.spacing.to_string()].into_iter().chain(differences));
        }
    }
    table
}

fn narrow(points: &Points) -> Table {
    let young = ("E", STIFFNESS.1);
    let deviation: (&str, Value) = ("deviation", |_, run| format!("{:.1e}", run.number("speed_deviation")));
    let columns = [ACTIVITY, young, SPACING, SPEED, deviation, ASPECT, CHANNEL, GAP, JACOBIAN, FAILURE];
    rows(points, Purpose::Narrow, "Neo-Hookean channel of width 1 R0 (figure 4.25), t = 60", &columns)
}

/// Rows of several times of each run: the columns before the time, and what [`FOLLOWED`] tells.
fn histories(points: &Points, purpose: Purpose, title: &str, times: &[f64], keys: &[(&str, Value)]) -> Table {
    let names = FOLLOWED.map(|name| name.replace('_', " "));
    let mut header: Vec<&str> = keys.iter().map(|(name, _)| *name).collect();
    header.push("t");
    header.extend(names.iter().map(String::as_str));
    header.push("failure");
    let mut table = Table::new(title, &header);
    for (job, summary) in of(points, purpose) {
        let rows = Rows::of(summary);
        for &time in times.iter().filter(|time| **time <= job.time) {
            let key = keys.iter().map(|(_, value)| value(job, summary));
            let values = (0..FOLLOWED.len()).map(|column| format!("{:.5}", rows.at(time, column)));
            let row = key.chain([time.to_string()]).chain(values).chain([text(summary, "failure").to_owned()]);
            table.push(row.collect::<Vec<_>>());
        }
    }
    table
}

fn contrast(points: &Points) -> Table {
    let title = "Droplets more viscous than the exterior fluid between soft walls, k = 1e4, activity -2";
    let ratio: (&str, Value) = ("ratio", |job, _| job.ratio.to_string());
    histories(points, Purpose::Contrast, title, &[2.0, 5.0, 10.0, 20.0], &[WIDTH, ratio, SPACING])
}

fn starts(points: &Points) -> Table {
    let title = "Starts in contact with walls of k = 1e6 in a straight channel, method of Cowley, activity -5";
    let how: (&str, Value) = ("method", |job, _| method(job));
    histories(points, Purpose::Start, title, &[1.5, 5.0, 9.0, 15.0], &[SPACING, how])
}

fn rests(points: &Points) -> Table {
    let title = "Whether a droplet of activity -1 comes to rest, width 2 R0";
    let times: Vec<f64> = (1..=10).map(|n| 40.0 * f64::from(n)).collect();
    histories(points, Purpose::Rest, title, &times, &[STIFFNESS, SPACING])
}
