//! Which settings are tried in which scene.

use motile::ib_core::AnyKernel;
use motile::scene::StepSize;

use crate::work_precision::settings::{Flow, Settings, Stepper};
use crate::work_precision::studies::Study;

/// The settings of a study.
pub(crate) fn settings(study: Study) -> Vec<Settings> {
    let mut list = match study {
        Study::FixedEllipse => fixed(),
        Study::Relaxation => relaxation(),
        Study::Steady | Study::Strong | Study::Transient => swimmer(study),
        Study::Oblique => oblique(),
        Study::Ratio10 | Study::Ratio100 => contrast(),
        Study::Channel => channel(),
        Study::ElasticLayer => elastic(),
    };
    if study == Study::Transient {
        // The transient is short: a few long stages say nothing of it, and the finest grids nothing new.
        list.retain(|settings| {
            let fine = matches!(settings.flow, Flow::Grid { h, ratio, .. } if h * ratio < 0.02);
            settings.stepper == Stepper::Midpoint && !fine
        });
    }
    // Presets may be among the variations.
    let mut different: Vec<Settings> = Vec::new();
    list.retain(|settings| {
        let new = !different.contains(settings);
        different.push(*settings);
        new
    });
    list
}

fn grids(spacings: &[f64], ratio: f64) -> impl Iterator<Item = Settings> {
    spacings.iter().map(move |&h| Settings::grid(h, ratio))
}

fn nodes(all: &[usize], cells: usize) -> impl Iterator<Item = Settings> {
    all.iter().map(move |&nodes| Settings::integrals(nodes, cells * nodes))
}

fn fixed() -> Vec<Settings> {
    let spacings = [0.2, 0.1, 0.05, 0.025];
    let mut list: Vec<Settings> = nodes(&[16, 24, 32, 48, 64, 96], 1).collect();
    for kernel in AnyKernel::ALL {
        list.extend(grids(&spacings, 0.5).map(|settings| settings.with_kernel(kernel)));
    }
    list.extend(grids(&spacings, 0.5).map(Settings::uncorrected));
    list.extend(spacings.map(|h| Settings::thesis(h, StepSize::Fixed(1e-3))));
    list
}

fn relaxation() -> Vec<Settings> {
    let spacings = [0.2, 0.1, 0.05];
    let mut list = Vec::new();
    for step in [0.5, 0.25]
        .map(StepSize::OfLimit)
        .into_iter()
        .chain([1e-3, 1e-4].map(|tolerance| StepSize::Adaptive { tolerance }))
    {
        list.extend(nodes(&[16, 24, 32, 48], 2).map(|settings| settings.with_step(step)));
        list.extend(grids(&spacings, 0.5).map(|settings| settings.with_step(step)));
    }
    for step in [0.2, 0.1].map(StepSize::Fixed) {
        list.extend(
            grids(&spacings, 0.5).map(|settings| settings.with_step(step).with_stepper(Stepper::Chebyshev(16))),
        );
    }
    list.extend(grids(&spacings, 0.5).map(Settings::uncorrected));
    list.extend([0.2, 0.1, 0.05, 0.025].map(|h| Settings::thesis(h, StepSize::OfLimit(0.5))));
    list
}

/// Boundary integrals, the default among them, with steps of half the limit and nearly all of it.
fn integrals(all: &[usize]) -> Vec<Settings> {
    let mut list = vec![Settings::preset(), Settings::integrals(96, 384)];
    for step in [0.5, 0.9].map(StepSize::OfLimit) {
        for cells in [2, 3, 4] {
            list.extend(nodes(all, cells).map(|settings| settings.with_step(step)));
        }
    }
    list
}

fn swimmer(study: Study) -> Vec<Settings> {
    let mut list = integrals(&[16, 24, 32, 48, 64]);
    list.extend(nodes(&[16, 24, 32], 8));
    list.push(Settings::integrals(48, 192).with_step(StepSize::Adaptive { tolerance: 1e-4 }));
    list.push(Settings::integrals(48, 192).with_stepper(Stepper::Chebyshev(16)));
    let spacings = &[0.375, 0.3, 0.2, 0.15, 0.1, 0.05];
    for ratio in [1.0, 0.5, 0.25] {
        list.extend(grids(spacings, ratio));
    }
    list.extend(grids(spacings, 0.5).map(|settings| settings.with_step(StepSize::OfLimit(0.9))));
    list.push(Settings::grid(0.1, 0.5).with_stepper(Stepper::Chebyshev(16)));
    for kernel in AnyKernel::ALL {
        list.extend(grids(&[0.2, 0.1, 0.05], 0.5).map(|settings| settings.with_kernel(kernel)));
    }
    list.extend(grids(&[0.1, 0.05], 0.5).map(Settings::uncorrected));
    list.extend(thesis(&[0.1, 0.05, 0.025]));
    if study == Study::Steady {
        list.push(Settings::thesis(0.1, StepSize::Fixed(1e-3)));
        list.extend([0.2, 0.015, 0.0125].map(|h| Settings::thesis(h, LONG)));
    }
    list
}

fn oblique() -> Vec<Settings> {
    let mut list = integrals(&[16, 24, 32, 48, 64]);
    let spacings = &[0.2, 0.15, 0.1, 0.075, 0.05];
    for ratio in [1.0, 0.5, 0.25] {
        list.extend(grids(spacings, ratio));
    }
    for kernel in [AnyKernel::Peskin4, AnyKernel::Gaussian6, AnyKernel::BSpline6] {
        list.extend(grids(&[0.2, 0.1, 0.05], 0.5).map(|settings| settings.with_kernel(kernel)));
    }
    list.extend(grids(&[0.1, 0.05], 0.5).map(Settings::uncorrected));
    list.extend(thesis(&[0.1, 0.05]));
    list
}

/// Steps that are nearly as long as are stable.
const LONG: StepSize = StepSize::OfLimit(0.9);

/// Cowley's preset, and its method on these grids with steps as long as are stable.
fn thesis(spacings: &[f64]) -> Vec<Settings> {
    let preset = Settings::thesis(0.05, StepSize::Fixed(1e-3));
    spacings.iter().map(|&h| Settings::thesis(h, LONG)).chain([preset]).collect()
}

fn contrast() -> Vec<Settings> {
    let mut list = integrals(&[16, 24, 32, 48, 64]);
    let smeared = &[0.2, 0.1];
    list.extend(grids(smeared, 0.5).map(Settings::uncorrected));
    list.extend(smeared.iter().map(|&h| Settings::thesis(h, LONG)));
    list
}

fn channel() -> Vec<Settings> {
    let mut list = integrals(&[24, 32, 48, 64, 96]);
    let spacings = &[0.2, 0.1, 0.05];
    for ratio in [1.0, 0.5, 0.25] {
        list.extend(grids(spacings, ratio));
    }
    list.extend(grids(&[0.1, 0.05], 0.5).map(Settings::uncorrected));
    list.extend(thesis(&[0.1, 0.05, 0.025]));
    list
}

fn elastic() -> Vec<Settings> {
    let spacings = [0.2, 0.1, 0.05];
    let mut list = Vec::new();
    for ratio in [1.0, 1.5] {
        for step in [0.5, 0.25].map(StepSize::OfLimit) {
            list.extend(grids(&spacings, ratio).map(|settings| settings.with_step(step)));
            list.extend(grids(&spacings, ratio).map(|settings| settings.with_step(step).uncorrected()));
        }
    }
    for step in [0.2, 0.1, 0.05].map(StepSize::Fixed) {
        list.extend(
            grids(&spacings, 1.0).map(|settings| settings.with_step(step).with_stepper(Stepper::Chebyshev(16))),
        );
    }
    let peskin = grids(&spacings, 1.0).map(|settings| settings.with_kernel(AnyKernel::Peskin4));
    list.extend(peskin.map(Settings::uncorrected));
    list
}

/// Common settings of a series of refinements.
pub(crate) fn series(settings: &Settings) -> String {
    let flow = match settings.flow {
        Flow::Integrals { nodes, elements } => format!("cells {}", elements / nodes),
        Flow::Grid { ratio, .. } => format!("ratio {ratio}"),
    };
    format!("{} {flow} {:?} {:?} {:?}", settings.family(), settings.kernel, settings.step, settings.stepper)
}
