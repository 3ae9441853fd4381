//! Viscoelastic layers against exact solutions, and droplets between walls that twitch.

use motile::base::{Drive, Region};
use motile::elastic_solids::ChannelShape;
use motile::setup::{ActiveSpringsSetup, Built, DropletSetup, LayersMethod, Material, Method, Setup, SolidSetup};
use motile_tests::validation::viscoelastic::{Layers, Motion};
use motile_tests::validation::{StudyError, Table, order};

use super::Tables;
use crate::book::statistics::mean;
use crate::tables::Measure;

/// Layers of which the others differ in one thing.
const LAYERS: Layers = Layers { springs: false, layered: false, moduli: [20.0, 60.0], time: 0.5, thickness: 0.6 };
/// Motions and their names.
const MOTIONS: [(&str, Motion); 7] = [
    ("relaxation", Motion::Relaxation),
    ("two layers, sum", Motion::Sum),
    ("two layers, difference", Motion::Difference),
    ("start-up", Motion::StartUp),
    ("creep", Motion::Creep),
    ("oscillation, w = 2", Motion::Oscillation(2.0)),
    ("oscillation, w = 20", Motion::Oscillation(20.0)),
];
/// Seeds of the walls.
const SEEDS: u64 = 20;

pub(super) fn viscoelastic() -> Tables {
    Ok(vec![spacings()?, steps()?, parameters()?, twitching()?])
}

/// Errors as texts, and their order.
fn with_order(sizes: &[f64], errors: &[f64]) -> [String; 2] {
    let texts: Vec<String> = errors.iter().map(|error| format!("{error:.1e}")).collect();
    [texts.join(", "), format!("{:.2}", order(sizes, errors))]
}

/// The spacing of the grid.
fn spacings() -> Result<Table, StudyError> {
    let spacings = [0.2, 0.1, 0.05];
    let mut table = Table::new(
        &format!(
            "Layers of a standard linear solid (Ginf = 20, G1 = 60, tau = 0.5, thickness 0.6) in a fluid of viscosity \
             10 between walls 2 apart, in 200 steps of the time 1 or of a period: largest error of the shear over its \
             largest value, of oscillations of the complex amplitude, at h = {spacings:?}"
        ),
        "motion | material | surface | errors | order",
    );
    for (layered, surface) in [(false, "grid"), (true, "layers")] {
        for (springs, material) in [(false, "neo-Hookean"), (true, "springs")] {
            for (name, motion) in MOTIONS {
                table.measure(format_args!("{name} | {material} | {surface}"), || {
                    let layers = Layers { springs, layered, ..LAYERS };
                    let errors = spacings.iter().map(|&h| layers.compare(motion, h, 200));
                    Ok(with_order(&spacings, &errors.collect::<Result<Vec<f64>, _>>()?).join(" | "))
                })?;
            }
        }
    }
    Ok(table)
}

/// The time step, which is all that triangles and surfaces that are layers err by.
fn steps() -> Result<Table, StudyError> {
    let counts = [20, 40, 80, 160];
    let mut table = Table::new(
        &format!("The same by layers and triangles at h = 0.1, in {counts:?} steps of the time 1 or of a period"),
        "motion | errors | order",
    );
    let sizes: Vec<f64> = counts.map(|count| 1.0 / count as f64).to_vec();
    for (name, motion) in MOTIONS {
        table.measure(name, || {
            let layers = Layers { layered: true, ..LAYERS };
            let errors = counts.iter().map(|&count| layers.compare(motion, 0.1, count));
            Ok(with_order(&sizes, &errors.collect::<Result<Vec<f64>, _>>()?).join(" | "))
        })?;
    }
    Ok(table)
}

/// Other relaxation times, moduli and thicknesses: chosen ends, then drawn at random.
fn parameters() -> Result<Table, StudyError> {
    let mut table = Table::new(
        "Other parameters, triangles by layers at h = 0.1, in 400 steps of the time 1, 100 of a period: errors; no \
         oscillation where its start lasts for hundreds of periods",
        "tau | Ginf | G1 | thickness | relaxation | sum | start-up | creep | rate w | oscillation",
    );
    let mut state = 7_u64;
    let mut random = |low: f64, high: f64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * (state >> 33) as f64 / f64::from(1_u32 << 31)
    };
    let mut cases: Vec<(Layers, f64)> =
        [1e-8, 1e-4, 1e-2, 1e2, 1e4, 1e8].map(|time| (Layers { layered: true, time, ..LAYERS }, 5.0)).to_vec();
    cases.extend((0..8).map(|_| {
        let time = 10_f64.powf(random(-2.0, -0.3));
        let rest = 10_f64.powf(random(0.7, 1.7));
        let moduli = [rest, rest * 10_f64.powf(random(-1.0, 0.8))];
        let thickness = 0.1 * random(3.0, 9.0).round();
        (Layers { layered: true, time, moduli, thickness, ..LAYERS }, 10_f64.powf(random(0.0, 1.0)))
    }));
    for (layers, rate) in cases {
        let [rest, relaxing] = layers.moduli;
        let Layers { time, thickness, .. } = layers;
        table.measure(format_args!("{time:.3e} | {rest:.2} | {relaxing:.2} | {thickness:.1}"), || {
            let errors = [Motion::Relaxation, Motion::Sum, Motion::StartUp, Motion::Creep]
                .map(|motion| {
                    layers.compare(motion, 0.1, 400).map_or_else(|e| e.to_string(), |error| format!("{error:.1e}"))
                })
                .join(" | ");
            let oscillation = match layers.time < 1.0 {
                true => format!("{rate:.2} | {:.1e}", layers.compare(Motion::Oscillation(rate), 0.1, 100)?),
                false => " | ".to_owned(),
            };
            Ok(format!("{errors} | {oscillation}"))
        })?;
    }
    Ok(table)
}

fn twitching() -> Result<Table, StudyError> {
    let mut table = Table::new(
        "A droplet in a channel of width 3 between walls of springs (k = 1e4, 1.5 thick) whose active springs have the \
         tension 5 and the rates 0.5 and 1, from t = 1 to 3, h = 0.2: mean over 20 seeds and its standard error",
        "activity | walls | speed along | error along | speed across | error across",
    );
    for activity in [Some(-4.0), None] {
        for tension in [0.0, 5.0] {
            let name = activity.map_or("passive".to_owned(), |activity: f64| activity.to_string());
            let walls = if tension == 0.0 { "elastic" } else { "twitching" };
            table.measure(format_args!("{name} | {walls}"), || {
                let count = if tension == 0.0 { 1 } else { SEEDS };
                let runs = (0..count).map(|seed| run(activity, tension, seed)).collect::<Result<Vec<_>, _>>()?;
                let statistics = |k: usize| {
                    let (mean, deviation) = mean(runs.iter().map(|run| run[k]));
                    let error = deviation / (count as f64).sqrt();
                    if count > 1 { format!("{mean:.6} | {error:.6}") } else { format!("{mean:.6} | ") }
                };
                Ok(format!("{} | {}", statistics(0), statistics(1)))
            })?;
        }
    }
    Ok(table)
}

/// Speeds of the droplet along and across the channel (R0 per time).
fn run(activity: Option<f64>, tension: f64, seed: u64) -> Result<[f64; 2], StudyError> {
    let mut solids = SolidSetup::walls(&ChannelShape::Straight { width: 3.0 }, &Material::Springs { shear: 93.75 });
    for (number, wall) in solids.iter_mut().enumerate().filter(|_| tension > 0.0) {
        let seed = 2 * seed + number as u64 + 1;
        let (on_sensitivity, off_sensitivity) = (0.0, 0.0);
        wall.active_springs =
            Some(ActiveSpringsSetup { tension, on: 0.5, off: 1.0, seed, on_sensitivity, off_sensitivity });
    }
    let droplet = match activity {
        Some(activity) => DropletSetup::active(activity),
        None => DropletSetup { particles: None, ..DropletSetup::default() },
    };
    let setup = Setup {
        region: Region::Channel { length: 12.0, width: 6.0, drive: Drive::ZeroGradient },
        method: Method::Layers(LayersMethod { nodes: 48, elements: 192, ..LayersMethod::of_spacing(0.2) }),
        droplets: vec![droplet],
        solids,
        ..Setup::default()
    };
    let Built { mut scene, droplets, .. } = setup.build()?;
    scene.run(1.0).go()?;
    let start = scene.observe(droplets[0])?.centroid;
    scene.run(3.0).go()?;
    let end = scene.observe(droplets[0])?.centroid;
    Ok([0.5 * (end.x - start.x), 0.5 * (end.y - start.y)])
}
