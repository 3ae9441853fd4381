//! Speed and amplitude of droplets in rigid channels of many lengths and widths, beside the fits of the thesis
//! (chapter 3).
//!
//! `cargo run --release --example channel_study` makes the runs, a few minutes on two cores; `--full` makes them on
//! a fine grid, which takes an hour or more. Each finished run leaves a file in `out/channel_study/runs/` and is not
//! made again; delete the directory to start afresh. From all runs come `points.csv` and the figures (SVG and PNG)
//! `speed_against_length`, `speed_against_width` and `amplitude_against_length`.

use std::process::ExitCode;

use anyhow::{Result, bail, ensure};
use clap::Parser;
use motile::active_interface::{ActiveDroplet, Observables, RegimeCriteria, TrajectoryRecorder};
use motile::ib_core::{Every, Handle, Hydrodynamics, Scene, SceneError, StepSize};
use motile::{Swimmer, stokes_grid::Drive};
use support::{
    AxisScale, Figure, Marker, OutputFlags, Plot, RunPool, SERIES_COLOURS, Series, Steadiness, Summary, positive,
    write_results,
};

/// Speed and amplitude of droplets in rigid channels, beside the fits of the thesis.
#[derive(Debug, Parser)]
struct Flags {
    /// Fine grid, long runs and more lengths
    #[arg(long)]
    full: bool,
    /// Grid spacing h (R0), at most 0.25; without it 0.1, or 0.05 with --full
    #[arg(long, value_parser = spacing, allow_hyphen_values = true)]
    spacing: Option<f64>,
    /// Time of each run for a speed (those for an amplitude take six times as long); without it 80, or 150 with --full
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    time: Option<f64>,
    /// Runs at a time; without it as many as there are processors
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    #[command(flatten)]
    output: OutputFlags,
}

/// A grid spacing that resolves a droplet, and channels of length 36 with at most some thousand cells.
fn spacing(text: &str) -> Result<f64, String> {
    positive(text)
        .ok()
        .filter(|h| (0.01..=0.25).contains(h))
        .ok_or_else(|| "must be a number from 0.01 to 0.25".to_string())
}

/// What a run contributes to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Purpose {
    /// Speed in a channel, of a droplet on the centre line.
    Speed,
    /// Speed in a large periodic box.
    Unconfined,
    /// Amplitude in a channel, of a droplet that starts off the centre line.
    Amplitude,
}

/// A run by its parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Job {
    purpose: Purpose,
    length: f64,
    width: f64,
    activity: f64,
    viscosity: f64,
    spacing: f64,
    time: f64,
}

/// Excluded volume of the runs for speeds, and of those for amplitudes: the thesis does not give its own, and which
/// droplets oscillate depends on it; with 13.5 those do that do in the thesis.
const EXCLUDED_VOLUME: f64 = 10.0;
const EXCLUDED_VOLUME_OSCILLATING: f64 = 13.5;
/// Side of the box that is called unconfined (R0).
const BOX: f64 = 12.0;
/// Where the runs for amplitudes start (R0).
const OFFSET: f64 = 0.3;
/// Width of the channels of (3.7) and of (3.9) (R0).
const NARROW: f64 = 2.0;
const OSCILLATING: f64 = 3.0;
/// Fits to the thesis' own points for w = 2, figures 3.1 and 3.2: activity, viscosity, a and b of
/// |v| = a exp(-l/10) + b.
const THESIS_FITS: [(f64, f64, f64, f64); 5] = [
    (-2.0, 100.0, 0.20, 0.016),
    (-4.0, 100.0, 0.34, 0.051),
    (-5.0, 100.0, 0.42, 0.061),
    (-4.0, 50.0, 0.54, 0.094),
    (-4.0, 200.0, 0.22, 0.012),
];

impl Job {
    fn excluded_volume(&self) -> f64 {
        if self.purpose == Purpose::Amplitude { EXCLUDED_VOLUME_OSCILLATING } else { EXCLUDED_VOLUME }
    }

    fn name(&self) -> String {
        let Self { purpose, length, width, activity, viscosity, spacing, time } = self;
        let kind = match purpose {
            Purpose::Speed => "speed",
            Purpose::Unconfined => "unconfined",
            Purpose::Amplitude => "amplitude",
        };
        let volume = self.excluded_volume();
        format!("{kind}_l{length}_w{width}_z{activity}_A{volume}_eta{viscosity}_h{spacing}_t{time}")
    }

    /// Whether the channel is a whole number of cells long and wide.
    fn fits(&self) -> bool {
        [self.length, self.width].iter().all(|side| (side / self.spacing - (side / self.spacing).round()).abs() < 1e-6)
    }

    /// The speed that the thesis' fit and its expression (3.7) give.
    fn thesis_speeds(&self) -> [Option<f64>; 2] {
        if self.purpose != Purpose::Speed || self.width != NARROW {
            return [None, None];
        }
        let fit = THESIS_FITS.iter().find(|fit| (fit.0, fit.1) == (self.activity, self.viscosity));
        let decay = (-self.length / 10.0).exp();
        let ratio = self.activity.abs() / self.viscosity;
        [fit.map(|(_, _, a, b)| a * decay + b), Some(10.0 * ratio * decay + ratio)]
    }

    fn run(&self) -> Result<Summary> {
        let swimmer = Swimmer {
            activity: self.activity,
            excluded_volume: self.excluded_volume(),
            viscosity: self.viscosity,
            lengths: [self.length, self.width],
            spacing: self.spacing,
            offset: [0.0, if self.purpose == Purpose::Amplitude { OFFSET } else { 0.0 }],
            step: StepSize::OfLimit(0.5),
            ..Swimmer::default()
        };
        if self.purpose == Purpose::Unconfined {
            let (mut scene, droplet) = swimmer.build()?;
            self.watch(&mut scene, droplet, &swimmer)
        } else {
            let (mut scene, droplet) = swimmer.build_in_channel(Drive::ZeroGradient)?;
            self.watch(&mut scene, droplet, &swimmer)
        }
    }

    fn watch<H: Hydrodynamics>(
        &self,
        scene: &mut Scene<H>,
        droplet: Handle<ActiveDroplet>,
        swimmer: &Swimmer,
    ) -> Result<Summary> {
        let mut recorder = TrajectoryRecorder::new(droplet);
        let interval = Every::Time(self.time / 600.0);
        let outcome: Result<(), SceneError> =
            scene.run(self.time).step_size(swimmer.step).observe(interval, &mut recorder).go();
        outcome?;
        let Some(last) = recorder.records().last() else { bail!("nothing was measured") };
        let seen = &last.observables;
        let speeds: Vec<(f64, f64)> = recorder.records().iter().map(|r| (r.time, r.observables.speed())).collect();
        let steadiness = Steadiness::of(&speeds, swimmer.diffusion / swimmer.radius.powi(2));
        let report = recorder.regime(&RegimeCriteria::default())?;
        let [fit, expression] = self.thesis_speeds();

        let mut summary = Summary::new();
        let parameters = [
            ("length", self.length),
            ("width", self.width),
            ("activity", self.activity),
            ("excluded_volume", self.excluded_volume()),
            ("viscosity", self.viscosity),
            ("spacing", self.spacing),
            ("time", self.time),
        ];
        for (name, value) in parameters {
            summary.put(name, value, "");
        }
        summary.put("speed", steadiness.final_speed, "");
        summary.put("thesis_fit", fit, "");
        summary.put("thesis_3_7", expression, "");
        summary.put("steady_since", steadiness.since, "");
        summary.put("regime", report.regime.to_string(), "");
        summary.put("amplitude", report.evidence.amplitude, "");
        summary.put("period", report.evidence.period.map(|period| period.value), "");
        summary.put("aspect_ratio", seen.aspect_ratio_moments, "");
        summary.put("radius_across", radius_across(seen), "");
        summary.put("stresslet_xx", seen.get("stresslet_xx"), "");
        summary.put("beta", seen.get("beta"), "");
        summary.put("gap", last.gap, "");
        summary.put("area_relative_change", seen.area / scene.body(droplet).initial_area() - 1.0, "");
        summary.put("steps", scene.steps(), "");
        Ok(summary)
    }
}

/// Half the axis across the motion of the ellipse with the area and the aspect ratio of the droplet (length).
fn radius_across(seen: &Observables) -> f64 {
    (seen.area / (std::f64::consts::PI * seen.aspect_ratio_moments)).sqrt()
}

fn main() -> ExitCode {
    support::run(study)
}

fn study(flags: &Flags) -> Result<()> {
    let (jobs, left_out): (Vec<Job>, Vec<Job>) = jobs(flags).into_iter().partition(Job::fits);
    if let Some(first) = left_out.first() {
        let count = left_out.len();
        eprintln!(
            "note: {count} runs are left out, their channels are no whole number of cells (such as {})",
            first.name()
        );
    }
    ensure!(!jobs.is_empty(), "no channel is a whole number of cells: give a spacing that divides 2, such as 0.1");
    let directory = flags.output.directory("channel_study")?;
    let threads = flags
        .threads
        .map_or_else(|| std::thread::available_parallelism().map_or(1, std::num::NonZero::get), usize::from);
    let runs = directory.join("runs");
    let results = RunPool::new(&runs, threads, flags.output.quiet)?.run(&jobs, Job::name, Job::run);

    let mut points: Vec<(Job, Summary)> = Vec::new();
    let mut failures = Vec::new();
    for (job, result) in jobs.into_iter().zip(results) {
        match result {
            Ok(summary) => points.push((job, summary)),
            Err(error) => failures.push(error),
        }
    }
    let rows: Vec<Summary> = points.iter().map(|(_, summary)| summary.clone()).collect();
    write_results(&directory.join("points.csv"), &rows)?;
    print_speeds(&points);
    if !flags.output.no_pictures {
        speed_against_length(&points).write(&directory, "speed_against_length")?;
        speed_against_width(&points).write(&directory, "speed_against_width")?;
        amplitude_against_length(&points).write(&directory, "amplitude_against_length")?;
    }
    println!("results of {} runs in {}", points.len(), directory.display());
    match failures.into_iter().next() {
        Some(first) => Err(first.context("a run failed; the study can be started again")),
        None => Ok(()),
    }
}

/// All runs, the longest first, so that no thread is left with one of them in the end.
fn jobs(flags: &Flags) -> Vec<Job> {
    let spacing = flags.spacing.unwrap_or(if flags.full { 0.05 } else { 0.1 });
    let time = flags.time.unwrap_or(if flags.full { 150.0 } else { 80.0 });
    let lengths: &[f64] =
        if flags.full { &[8.0, 10.0, 12.0, 16.0, 18.0, 24.0, 30.0, 36.0] } else { &[8.0, 12.0, 24.0, 36.0] };
    let base =
        Job { purpose: Purpose::Speed, length: 12.0, width: NARROW, activity: -4.0, viscosity: 100.0, spacing, time };
    let oscillating = [12.0, 15.0, 18.0, 24.0, 30.0, 36.0].map(|length| Job {
        purpose: Purpose::Amplitude,
        length,
        width: OSCILLATING,
        time: 6.0 * time,
        ..base
    });
    let mut jobs = oscillating.to_vec();
    for (activity, viscosity, _, _) in THESIS_FITS {
        jobs.extend(lengths.iter().map(|&length| Job { length, activity, viscosity, ..base }));
    }
    for activity in [-1.0, -2.0, -3.0, -4.0, -5.0] {
        let widths = [2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0];
        jobs.extend(widths.map(|width| Job { width, activity, ..base }));
        jobs.push(Job { purpose: Purpose::Unconfined, length: BOX, width: BOX, activity, ..base });
    }
    let size = |job: &Job| job.length * job.width * job.time;
    jobs.sort_by(|a, b| size(b).total_cmp(&size(a)));
    // Channels of length 12 and width 2 belong to both series.
    let mut different: Vec<Job> = Vec::new();
    for job in jobs {
        if !different.contains(&job) {
            different.push(job);
        }
    }
    different
}

type Points = [(Job, Summary)];

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

/// Table of the speeds in channels as wide as the droplet, with the thesis' fits and the deviation from them.
fn print_speeds(points: &Points) {
    println!(
        "speed in channels of width 2: length, activity, viscosity; here; thesis' fit, (3.7); deviation from the fit"
    );
    for (activity, viscosity, _, _) in THESIS_FITS {
        for (length, speed) in in_narrow_channels(points, activity, viscosity) {
            let job = points.iter().map(|(job, _)| job).find(|job| {
                (job.purpose, job.length, job.width) == (Purpose::Speed, length, NARROW)
                    && (job.activity, job.viscosity) == (activity, viscosity)
            });
            if let Some([Some(fit), Some(expression)]) = job.map(Job::thesis_speeds) {
                let deviation = 100.0 * (speed / fit - 1.0);
                println!(
                    "  {length:>4} {activity:>4} {viscosity:>5}  {speed:.4}  {fit:.4} {expression:.4}  {deviation:+.1} %"
                );
            }
        }
    }
}

fn curve(from: f64, to: f64, f: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    (0..=80).map(|k| from + (to - from) * f64::from(k) / 80.0).map(|x| (x, f(x))).collect()
}

/// Entries of the legend without points: what lines of all colours mean.
fn key(label: &str) -> Series {
    Series::line(label, [(f64::NAN, f64::NAN)]).colour(support::Rgb::GREY)
}

fn speed_against_length(points: &Points) -> Figure {
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
        plot.series(key("thesis, fit to its points")).series(key("thesis, (3.7)").dashed())
    };
    Figure::new(2)
        .panel(panel("Speed in channels of width 2, η = 100", &|activity, viscosity| {
            (viscosity == 100.0).then(|| format!("ζΔμ = −{}", activity.abs()))
        }))
        .panel(panel("Speed in channels of width 2, ζΔμ = −4", &|activity, viscosity| {
            (activity == -4.0).then(|| format!("η = {viscosity}"))
        }))
}

fn speed_against_width(points: &Points) -> Figure {
    let mut plot = Plot::new("Speed in channels of length 12, η = 100")
        .x_axis("width w (R_{0})", AxisScale::Linear)
        .y_axis("|v| (R_{0} per time)", AxisScale::Linear)
        .x_range(1.9, 6.6);
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

fn amplitude_against_length(points: &Points) -> Figure {
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
        .series(Series::line("thesis, (3.9)", thesis));
    Figure::new(1).panel(plot).panel_size(640.0, 400.0)
}
