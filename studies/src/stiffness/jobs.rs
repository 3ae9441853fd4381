//! Which runs the study consists of.

use clap::ValueEnum;
use motile::MeshKind;

use crate::stiffness::run::WallMaterial;

use crate::stiffness::run::{Job, Purpose};

/// Width that is none.
const LARGE: f64 = 12.0;
const ACTIVITIES: [f64; 5] = [-1.0, -2.0, -3.0, -4.0, -5.0];

/// All runs at grid spacing `h`, or those with one purpose, the longest first, so that no thread is left with one of
/// them in the end.
pub(crate) fn list(only: Option<Purpose>, full: bool, thesis: bool, h: f64) -> Vec<Job> {
    let mut jobs = Vec::new();
    for purpose in Purpose::value_variants().iter().filter(|purpose| only.is_none_or(|only| only == **purpose)) {
        jobs.extend(match purpose {
            Purpose::Speed => speeds(full, h),
            Purpose::Lateral => lateral(full, h),
            Purpose::Passage => passages(thesis, h),
            Purpose::Comparison => comparisons(h),
            Purpose::Narrow => narrow(h),
            Purpose::Contrast => contrasts(h),
            Purpose::Start => starts(h),
            Purpose::Rest => rests(h),
            // They come with the speeds.
            Purpose::Rigid | Purpose::Unconfined => Vec::new(),
        });
    }
    jobs.sort_by(|a, b| b.size().total_cmp(&a.size()));
    jobs
}

/// All pairs.
fn pairs<'a>(first: &'a [f64], second: &'a [f64]) -> impl Iterator<Item = (f64, f64)> + 'a {
    first.iter().flat_map(move |&one| second.iter().map(move |&other| (one, other)))
}

fn speeds(full: bool, h: f64) -> Vec<Job> {
    let widths: &[f64] = if full { &[2.0, 3.0, 5.0] } else { &[2.0] };
    let activities: &[f64] = if full { &ACTIVITIES } else { &[-2.0, -4.0] };
    let stiffnesses: Vec<f64> =
        if full { (1..=10).map(|k| 1e4 * f64::from(k)).chain([1e6]).collect() } else { vec![1e4, 3e4, 1e5, 1e6] };
    let time = 60.0;
    let mut jobs = Vec::new();
    for (width, activity) in pairs(widths, activities) {
        jobs.extend(stiffnesses.iter().map(|&k| Job::new(Purpose::Speed, width, activity, k, h, time)));
        jobs.push(Job::new(Purpose::Rigid, width, activity, f64::INFINITY, h, time));
        jobs.push(Job::new(Purpose::Unconfined, LARGE, activity, 0.0, h, time));
    }
    if !full {
        // Where Cowley's least active droplet swims, and where it does not.
        jobs.extend([1e4, 4e4].map(|k| Job::new(Purpose::Speed, 2.0, -1.0, k, h, 150.0)));
    }
    jobs.dedup();
    jobs
}

fn lateral(full: bool, h: f64) -> Vec<Job> {
    let widths: &[f64] = if full { &[3.0, 4.0, 5.0] } else { &[3.0] };
    let activities: &[f64] = if full { &ACTIVITIES } else { &[-4.0] };
    let stiffnesses: &[f64] = if full { &[1e4, 2e4, 4e4, 6e4, 8e4, 1e5, 1e6] } else { &[1e4, 1e5, 1e6] };
    // Wider channels take longer to cross.
    let time = |width| {
        if width > 4.5 {
            600.0
        } else if width > 3.5 {
            400.0
        } else {
            150.0
        }
    };
    let job = |width, activity, k| Job {
        excluded_volume: 13.5,
        ..Job::new(Purpose::Lateral, width, activity, k, h, time(width))
    };
    pairs(widths, activities)
        .flat_map(|(width, activity)| stiffnesses.iter().map(move |&k| job(width, activity, k)))
        .collect()
}

fn passages(thesis: bool, h: f64) -> Vec<Job> {
    let job = |(k, activity)| Job { thesis, ..Job::new(Purpose::Passage, 2.0, activity, k, h, 300.0) };
    pairs(&[1e4, 5e4, 1e5, 1e6], &ACTIVITIES).map(job).collect()
}

fn comparisons(h: f64) -> Vec<Job> {
    let job =
        Job { viscosity: 1000.0, excluded_volume: 20.0, ..Job::new(Purpose::Comparison, 2.0, -10.0, 1e4, h, 80.0) };
    let kinds = |mesh| [WallMaterial::Springs, WallMaterial::NeoHookean].map(|material| Job { material, mesh, ..job });
    [MeshKind::Equilateral, MeshKind::Unstructured].into_iter().flat_map(kinds).collect()
}

fn contrasts(h: f64) -> Vec<Job> {
    // On the finest grids only the beginning.
    let time = if h < 0.04 { 5.0 } else { 20.0 };
    // In the narrower channel the droplet touches the walls when it starts. It keeps its viscosity of 100; the
    // exterior fluid is less viscous.
    let job = |(width, ratio)| Job {
        viscosity: 100.0 / ratio,
        ratio,
        ..Job::new(Purpose::Contrast, width, -2.0, 1e4, h, time)
    };
    pairs(&[2.0, 2.2], &[1.0, 10.0, 100.0]).map(job).collect()
}

fn starts(h: f64) -> Vec<Job> {
    let start = Job { thesis: true, ..Job::new(Purpose::Start, 2.0, -5.0, 1e6, h, 15.0) };
    let passage = Job { purpose: Purpose::Passage, time: 300.0, ..start };
    [0.0, 0.3 * h, 0.6 * h, h]
        .map(|back| Job { back, ..start })
        .into_iter()
        .chain([Job { equidistant: true, ..start }])
        .chain([Job { back: 0.6 * h, ..passage }, Job { equidistant: true, ..passage }])
        .collect()
}

fn rests(h: f64) -> Vec<Job> {
    [4e4, 6e4, 1e5].map(|k| Job::new(Purpose::Rest, 2.0, -1.0, k, h, 400.0)).to_vec()
}

fn narrow(h: f64) -> Vec<Job> {
    let job = |(young, activity)| Job {
        material: WallMaterial::NeoHookean,
        mesh: MeshKind::Unstructured,
        ..Job::new(Purpose::Narrow, 1.0, activity, young, h, 60.0)
    };
    pairs(&[1e3, 1e4], &ACTIVITIES).map(job).collect()
}
