//! The speed of swimmers by settings from coarse to fine, which `motile::recommend` chooses from.

use crate::tables::{Measure, Once};
use motile::SceneKind;
use motile::base::Region;
use motile::scene::StepSize;
use motile::setup::{DropletSetup, GridMethod, IntegralMethod, Method, Setup};
use motile_steady_states::SteadyState;
use motile_tests::validation::Table;
use motile_tests::validation::headings::{course, off_axis};
use motile_tests::validation::scene::{open_channel, reference, without_grid};

use crate::validation::{Tables, per_cent};

/// The time from which a swimmer counts as steady, and that of its last look (10 s).
const WINDOW: [f64; 2] = [40.0, 80.0];
/// Steps of the runs that others are compared with.
const EXACT: StepSize = StepSize::Adaptive { tolerance: 1e-5 };
/// How far the reference is from a state by Newton's method with these nodes and elements is a row of its own, if the
/// droplet swims along the axis.
const NEWTON: (usize, usize) = (160, 2048);
/// Between two looks: no multiple of the time in which a swimmer crosses a cell.
const EVERY: f64 = 0.8;

const INTEGRALS: [(usize, usize); 9] =
    [(16, 64), (24, 48), (24, 96), (32, 128), (48, 192), (64, 192), (64, 256), (80, 320), (96, 384)];
const SPACINGS: &[f64] = &[0.2, 0.15, 0.1, 0.075, 0.05];
/// Those that divide the widths and lengths of the channels.
const CHANNEL_SPACINGS: &[f64] = &[0.2, 0.1, 0.0625, 0.05];

/// The scenes of a kind: name, and description, with places of droplets in units of the grid spacing.
fn scenes(kind: SceneKind) -> Vec<(String, Setup)> {
    let method = Method::default();
    match kind {
        SceneKind::Box => {
            // Activity, heading (radians), place across the x axis (grid spacings).
            let all = [
                (-2.0, 0.0, 0.0),
                (-4.0, 0.0, 0.0),
                (-2.0, 0.0, 0.5),
                (-4.0, 0.0, 0.25),
                (-4.0, 0.0, 0.5),
                (-2.0, 0.4, 0.0),
                (-3.0, 0.2, 0.0),
                (-4.0, 0.4, 0.0),
                (-4.0, 0.6, 0.0),
            ];
            let one = |&(activity, angle, across): &(f64, f64, f64)| {
                let mut setup = off_axis(method, activity, angle);
                setup.droplets[0].centre = [0.0, across];
                (format!("activity {activity}, heading {angle}, {across} h off the axis"), setup)
            };
            all.iter().map(one).collect()
        }
        SceneKind::ViscosityContrast => {
            let all = [(10.0, 0.0), (10.0, 0.4), (1.0, 0.0), (1.0, 0.4)];
            let one = |&(viscosity, angle): &(f64, f64)| {
                let droplet = DropletSetup { viscosity: Some(100.0), angle, ..DropletSetup::default() };
                let setup = Setup { viscosity, droplets: vec![droplet], ..Setup::default() };
                (format!("viscosity 100 in {viscosity}, heading {angle}"), reference(setup, -1.0))
            };
            all.iter().map(one).collect()
        }
        SceneKind::Channel => {
            let all = [(2.0, -2.0), (3.0, -2.0), (2.0, -4.0)];
            let one = |&(width, activity): &(f64, f64)| {
                let region: Region = open_channel(12.0, width);
                let droplets = vec![DropletSetup::active(activity)];
                (format!("width {width}, activity {activity}"), Setup { region, droplets, ..Setup::default() })
            };
            all.iter().map(one).collect()
        }
    }
}

/// The settings of a kind of scenes, from coarse to fine, and their steps.
fn settings(kind: SceneKind) -> Vec<(String, Method, StepSize)> {
    let step = StepSize::default();
    let integral = |&(nodes, elements): &(usize, usize)| {
        (format!("{nodes} nodes, {elements} elements"), Method::Integral(IntegralMethod { nodes, elements }), step)
    };
    let grid = |&h: &f64| (format!("h = {h}"), Method::Grid(GridMethod::of_spacing(h)), step);
    let spacings = match kind {
        SceneKind::Box => SPACINGS,
        // Of first order on a grid.
        SceneKind::ViscosityContrast => &[],
        SceneKind::Channel => CHANNEL_SPACINGS,
    };
    let mut all: Vec<_> = INTEGRALS.iter().map(integral).chain(spacings.iter().map(grid)).collect();
    if kind == SceneKind::Box {
        // The error of the time step is far below that of the grid at ten times the preset's step.
        all.push(("preset, h = 0.05".to_owned(), Method::Grid(GridMethod::thesis()), StepSize::Fixed(0.01)));
    }
    all
}

pub(crate) fn recommended() -> Tables {
    let mut table = Table::new(
        &format!(
            "Errors of the speed in % between t = {} and {}, against boundary integrals with 128 nodes and 1024 elements: \
             of its mean, and the largest at any time",
            WINDOW[0], WINDOW[1]
        ),
        "kind | settings | scene | of the mean | largest",
    );
    for kind in [SceneKind::Box, SceneKind::ViscosityContrast, SceneKind::Channel] {
        for (name, scene) in scenes(kind) {
            let late = |setup: &Setup| {
                let speeds = course(setup, EVERY, WINDOW[1])?.speeds;
                let first = (WINDOW[0] / EVERY) as usize;
                Ok::<_, motile_tests::validation::StudyError>(speeds[first..].to_vec())
            };
            let found = Once::new();
            let exact = || {
                let method = without_grid(128, 1024).method;
                found.get(|| late(&Setup { method, step: EXACT, ..scene.clone() }))
            };
            let mean = |speeds: &[f64]| speeds.iter().sum::<f64>() / speeds.len() as f64;
            if kind == SceneKind::Box && name.contains("heading 0, 0 h") {
                let (nodes, elements) = NEWTON;
                let method = Method::Integral(IntegralMethod { nodes, elements });
                table.measure(
                    format_args!("{kind:?} | Newton, {nodes} nodes, {elements} elements | {name}"),
                    || {
                        let state = SteadyState::find(&Setup { method, ..scene.clone() })?;
                        let error = state.measured()?.speed / mean(exact()?) - 1.0;
                        Ok([error, error.abs()].map(per_cent).join(" | "))
                    },
                )?;
            }
            for (settings, method, step) in settings(kind) {
                let mut setup = Setup { method, step, ..scene.clone() };
                if let Method::Grid(grid) = method {
                    setup.droplets[0].centre[1] *= grid.spacing;
                }
                if method == Method::Grid(GridMethod::thesis()) {
                    let (preset, own) = (DropletSetup::thesis(), &mut setup.droplets[0]);
                    (own.motion, own.area_constraint) = (preset.motion, preset.area_constraint);
                    if let (Some(own), Some(preset)) = (&mut own.particles, preset.particles) {
                        own.flux = preset.flux;
                    }
                }
                table.measure(format_args!("{kind:?} | {settings} | {name}"), || {
                    let (exact, found) = (exact()?, late(&setup));
                    Ok(match found {
                        Ok(found) => {
                            let errors = found.iter().zip(exact).map(|(found, exact)| (found / exact - 1.0).abs());
                            let (mean, most) = (mean(&found) / mean(exact) - 1.0, errors.fold(0.0, f64::max));
                            [mean, most].map(per_cent).join(" | ")
                        }
                        Err(error) => format!("ends: {error} | "),
                    })
                })?;
            }
        }
    }
    Ok(vec![table])
}

#[cfg(test)]
mod tests;
