//! The tables of the study.

use motile_examples::{Summary, say};

use crate::stiffness::history::{FOLLOWED, Rows};
use crate::stiffness::run::{Job, Purpose};

/// Runs and their results.
pub(crate) type Points = [(Job, Summary)];

pub(crate) fn of(points: &Points, purpose: Purpose) -> Vec<&(Job, Summary)> {
    let mut chosen: Vec<_> = points.iter().filter(|(job, _)| job.purpose == purpose).collect();
    let key = |job: &Job| (job.width, -job.activity, job.stiffness);
    chosen.sort_by(|(a, _), (b, _)| key(a).partial_cmp(&key(b)).unwrap_or(std::cmp::Ordering::Equal));
    chosen
}

/// The runs of a purpose; if there are any, its title is printed.
fn section<'a>(points: &'a Points, purpose: Purpose, title: &str) -> Vec<&'a (Job, Summary)> {
    let chosen = of(points, purpose);
    if !chosen.is_empty() {
        say(title);
    }
    chosen
}

/// The same with the names of the columns below the title.
fn table<'a>(points: &'a Points, purpose: Purpose, title: &str, columns: &str) -> Vec<&'a (Job, Summary)> {
    let chosen = section(points, purpose, title);
    if !chosen.is_empty() {
        say(columns);
    }
    chosen
}

fn text<'a>(summary: &'a Summary, name: &str) -> &'a str {
    summary.values().get(name).and_then(|value| value.as_str()).unwrap_or("-")
}

pub(crate) fn print(points: &Points) {
    speeds(points);
    fits(points);
    lateral(points);
    passages(points);
    comparison(points);
    narrow(points);
    contrast(points);
    starts(points);
    rests(points);
}

/// Speed between rigid walls or unconfined, if it was computed.
fn speed_of(points: &Points, purpose: Purpose, width: f64, activity: f64) -> Option<f64> {
    let found = points.iter().find(|(job, _)| {
        job.purpose == purpose && job.activity == activity && (purpose == Purpose::Unconfined || job.width == width)
    });
    found.map(|(_, summary)| summary.number("speed"))
}

fn speeds(points: &Points) {
    let columns = format!(
        "  {:>5} {:>8} {:>8} {:>6}  {:>8} {:>8} {:>7}  {:>6} {:>6} {:>6}  {:>12} {:>6}",
        "width", "activity", "k", "h", "speed", "rigid", "", "aspect", "narrow", "wide", "displacement", "gap"
    );
    let title = "Speed between walls of springs (figures 4.4 to 4.9)";
    let chosen = table(points, Purpose::Speed, title, &columns);
    for (job, summary) in chosen {
        let rigid = speed_of(points, Purpose::Rigid, job.width, job.activity);
        let excess =
            rigid.map_or(String::new(), |rigid| format!("{:+.1} %", 100.0 * (summary.number("speed") / rigid - 1.0)));
        say(format_args!(
            "  {:>5} {:>8} {:>8} {:>6}  {:>8.5} {:>8.5} {excess:>7}  {:>6.3} {:>6.3} {:>6.3}  {:>12.4} {:>6.3}{}",
            job.width,
            job.activity,
            job.stiffness,
            job.spacing,
            summary.number("speed"),
            rigid.unwrap_or(f64::NAN),
            summary.number("aspect_ratio"),
            summary.number("channel_width_min"),
            summary.number("channel_width_max"),
            summary.number("largest_displacement"),
            summary.number("minimum_gap"),
            failure(summary)
        ));
    }
}

fn failure(summary: &Summary) -> String {
    summary.values().get("failure").and_then(|value| value.as_str()).map_or(String::new(), |text| format!("  {text}"))
}

/// The constant b of (4.3), `v = (v_unconfined - v_rigid) exp(-k/b) + v_rigid`, by least squares.
pub(crate) fn fitted(points: &Points, width: f64, activity: f64) -> Option<(f64, f64, f64)> {
    let rigid = speed_of(points, Purpose::Rigid, width, activity)?;
    let free = speed_of(points, Purpose::Unconfined, width, activity)?;
    let speeds: Vec<(f64, f64)> = of(points, Purpose::Speed)
        .into_iter()
        .filter(|(job, _)| (job.width, job.activity) == (width, activity))
        .map(|(job, summary)| (job.stiffness, summary.number("speed")))
        .collect();
    if speeds.len() < 2 {
        return None;
    }
    let error =
        |b: f64| -> f64 { speeds.iter().map(|(k, v)| ((free - rigid) * (-k / b).exp() + rigid - v).powi(2)).sum() };
    let candidates = (0..=4000).map(|n| 10_f64.powf(3.0 + 0.001 * f64::from(n)));
    let b = candidates.min_by(|a, b| error(*a).total_cmp(&error(*b)))?;
    Some((free, rigid, b))
}

fn fits(points: &Points) {
    let mut cases: Vec<(f64, f64)> =
        of(points, Purpose::Rigid).iter().map(|(job, _)| (job.width, job.activity)).collect();
    cases.dedup();
    for (width, activity) in cases {
        if let Some((free, rigid, b)) = fitted(points, width, activity) {
            say(format_args!(
                "  fit (4.3) at width {width}, activity {activity}: unconfined {free:.4}, rigid {rigid:.4}, b = {b:.3e}"
            ));
        }
    }
}

fn lateral(points: &Points) {
    let chosen = section(points, Purpose::Lateral, "Droplets that start 0.3 R0 off the centre line (figure 4.17)");
    for (job, summary) in chosen {
        say(format_args!(
            "  width {} activity {} k {:>8}: {}, amplitude {:.4}, growth rate {:+.4}{}",
            job.width,
            job.activity,
            job.stiffness,
            text(summary, "regime"),
            summary.number("amplitude"),
            summary.number("growth_rate"),
            failure(summary)
        ));
    }
}

fn passages(points: &Points) {
    let columns = format!(
        "  {:>8} {:>8} {:>6}  {:>12} {:>7} {:>8} {:>7} {:>7}",
        "k", "activity", "h", "verdict", "time", "furthest", "gap", "J"
    );
    let chosen = table(points, Purpose::Passage, "Passage through the constriction (figure 4.19)", &columns);
    for (job, summary) in chosen {
        say(format_args!(
            "  {:>8} {:>8} {:>6}  {:>12} {:>7.1} {:>8.2} {:>7.3} {:>7.3}{}{}",
            job.stiffness,
            job.activity,
            job.spacing,
            text(summary, "verdict"),
            summary.number("verdict_time"),
            summary.number("furthest_x"),
            summary.number("minimum_gap"),
            summary.number("smallest_jacobian"),
            method(job),
            failure(summary)
        ));
    }
}

/// What is not the default in a run.
fn method(job: &Job) -> String {
    let mut text = String::new();
    if job.thesis {
        text += "  thesis";
    }
    if job.equidistant {
        text += ", markers equally spaced";
    }
    if job.back > 0.0 {
        text += &format!(", walls {:.3} further back", job.back);
    }
    text
}

fn comparison(points: &Points) {
    let chosen = section(
        points,
        Purpose::Comparison,
        "Kinds of walls, viscosity 1000, activity -10, k = 1e4 (figures 4.2, 4.3, 4.22, 4.23)",
    );
    for (job, summary) in &chosen {
        say(format_args!(
            "  {:<11} {:<13} h {:<5} speed {:.5}  width {:.4} to {:.4}  J {:.3}{}",
            format!("{:?}", job.material),
            format!("{:?}", job.mesh),
            job.spacing,
            summary.number("speed"),
            summary.number("channel_width_min"),
            summary.number("channel_width_max"),
            summary.number("smallest_jacobian"),
            failure(summary)
        ));
        for (other, reference) in &chosen {
            if (other.material == job.material) != (other.mesh == job.mesh) && job != other {
                over_time(summary, other, reference);
            }
        }
    }
}

/// How far a run is from another one over the time of both, relative to the plateau of the other.
fn over_time(summary: &Summary, other: &Job, reference: &Summary) {
    let (rows, others) = (Rows::of(summary), Rows::of(reference));
    let of_plateau = |column: usize, plateau: f64| {
        let (largest, mean) = rows.difference(&others, column);
        format!("{:.2} % ({:.2} %)", 100.0 * largest / plateau, 100.0 * mean / plateau)
    };
    let list: Vec<String> = FOLLOWED
        .iter()
        .enumerate()
        .map(|(column, name)| format!("{} {}", name.replace('_', " "), of_plateau(column, reference.number(name))))
        .collect();
    say(format_args!(
        "    over time from {:?}, {:?}, largest (root mean square): {}",
        other.material,
        other.mesh,
        list.join(", ")
    ));
}

fn narrow(points: &Points) {
    let chosen = section(points, Purpose::Narrow, "Neo-Hookean channel of width 1 R0 (figure 4.25)");
    for (job, summary) in chosen {
        say(format_args!(
            "  activity {:>3} E {:>6} h {:<5} speed {:.5} (+- {:.1e})  aspect {:.3}  width {:.3} to {:.3}  J {:.3}  \
             gap {:.3}{}",
            job.activity,
            job.stiffness,
            job.spacing,
            summary.number("speed"),
            summary.number("speed_deviation"),
            summary.number("aspect_ratio"),
            summary.number("channel_width_min"),
            summary.number("channel_width_max"),
            summary.number("smallest_jacobian"),
            summary.number("minimum_gap"),
            failure(summary)
        ));
    }
}

/// Times at which runs on several grids are compared.
const COMPARED: [f64; 4] = [2.0, 5.0, 10.0, 20.0];

fn contrast(points: &Points) {
    let title = "Droplets more viscous than the exterior fluid between soft walls, k = 1e4, activity -2";
    let mut chosen = section(points, Purpose::Contrast, title);
    chosen.sort_by(|(a, _), (b, _)| a.width.total_cmp(&b.width).then(a.ratio.total_cmp(&b.ratio)));
    for (job, summary) in chosen {
        say(format_args!(
            "  width {} ratio {:<4} h {:<6} gap {:.4}  J {:.3}  steps {}{}",
            job.width,
            job.ratio,
            job.spacing,
            summary.number("minimum_gap"),
            summary.number("smallest_jacobian"),
            summary.number("steps"),
            failure(summary)
        ));
        let rows = Rows::of(summary);
        for time in COMPARED.into_iter().filter(|time| *time <= job.time) {
            let [speed, aspect, narrow, wide] = [0, 1, 2, 3].map(|column| rows.at(time, column));
            say(format_args!("    t {time:>4}  speed {speed:.5}  aspect {aspect:.4}  width {narrow:.4} to {wide:.4}"));
        }
    }
}

fn starts(points: &Points) {
    let chosen = section(
        points,
        Purpose::Start,
        "Starts in contact with walls of k = 1e6 in a straight channel, method of Cowley, activity -5",
    );
    for (job, summary) in chosen {
        let speeds = speeds_at(summary, &[1.5, 5.0, 9.0, 15.0]);
        say(format_args!("  h {:<5}{}: speed {}{}", job.spacing, method(job), speeds, failure(summary)));
    }
}

fn rests(points: &Points) {
    for (job, summary) in section(points, Purpose::Rest, "Whether a droplet of activity -1 comes to rest, width 2 R0") {
        let times: Vec<f64> = (1..=10).map(|n| 40.0 * f64::from(n)).collect();
        let speeds = speeds_at(summary, &times);
        say(format_args!("  k {:>8} h {:<5}: speed {speeds}{}", job.stiffness, job.spacing, failure(summary)));
    }
}

/// The speed at some times of a run.
fn speeds_at(summary: &Summary, times: &[f64]) -> String {
    let rows = Rows::of(summary);
    let speeds: Vec<String> = times.iter().map(|&time| format!("{:.4} at t = {time}", rows.at(time, 0))).collect();
    speeds.join(", ")
}
