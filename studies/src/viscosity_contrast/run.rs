//! A run by its parameters, and what is measured in it.

use anyhow::Result;
use motile::active_interface::{ActiveDroplet, Convention, observables::InterfaceState, observe};
use motile::ib_core::{Handle, Hydrodynamics, Scene, SceneError};
use motile::{Built, DropletSetup, IntegralMethod, Method, Region, Setup};
use motile_examples::Summary;

/// Side of the box (R0).
const BOX: f64 = 12.0;
/// A droplet slower than this, or whose speed falls by more than this a unit of time, does not swim.
const LEAST_SPEED: f64 = 1e-3;
const LEAST_RATE: f64 = -0.02;

/// Where a droplet swims.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Domain {
    Unbounded,
    Box,
}

/// A run by its parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Job {
    pub(crate) domain: Domain,
    pub(crate) inside: f64,
    pub(crate) outside: f64,
    pub(crate) activity: f64,
    pub(crate) excluded_volume: f64,
    pub(crate) nodes: usize,
    pub(crate) cells: usize,
    pub(crate) time: f64,
}

impl Job {
    pub(crate) fn name(&self) -> String {
        let Self { domain, inside, outside, activity, excluded_volume, nodes, cells, time } = self;
        let place = match domain {
            Domain::Unbounded => "unbounded",
            Domain::Box => "box",
        };
        format!("{place}_in{inside}_out{outside}_z{activity:.3}_A{excluded_volume}_n{nodes}_{cells}_t{time}")
    }

    pub(crate) fn sum(&self) -> f64 {
        self.inside + self.outside
    }

    /// The speed (2.59) of a round droplet whose first mode of the concentration is c0 = 100, abscissa of figures 2.8
    /// to 2.10.
    pub(crate) fn estimate(&self) -> f64 {
        -self.activity * 100.0 / (4.0 * self.sum())
    }

    pub(crate) fn run(&self) -> Result<Summary> {
        let viscosity = (self.inside != self.outside).then_some(self.inside);
        let droplet = DropletSetup { viscosity, ..DropletSetup::contractile(self.activity, self.excluded_volume) };
        let setup = Setup {
            region: match self.domain {
                Domain::Unbounded => Region::Plane,
                Domain::Box => Region::Box { lengths: [BOX, BOX] },
            },
            method: Method::Integral(IntegralMethod { nodes: self.nodes, cells: self.cells }),
            viscosity: self.outside,
            droplets: vec![droplet],
            ..Setup::default()
        };
        let Built { scene, droplets, .. } = setup.build()?;
        self.watch(scene, droplets[0])
    }

    fn watch<H: Hydrodynamics>(&self, mut scene: Scene<H>, droplet: Handle<ActiveDroplet>) -> Result<Summary> {
        // A droplet that comes apart is a result, not a failure of the study.
        let middle = 0.75 * self.time;
        let early = scene.run(middle).go().and_then(|()| speed(&mut scene, droplet));
        let ended = early.and_then(|early| scene.run(self.time).go().map(|()| early));
        scene.system_mut().evaluate()?;
        let state = InterfaceState::of(scene.system(), droplet)?;
        let seen = observe(&state, Convention::FarField)?;
        let printed = observe(&state, Convention::AsPrinted)?;
        let (rate, outcome) = match &ended {
            Ok(early) => ((seen.speed() / early).ln() / (self.time - middle), String::new()),
            Err(error) => (f64::NAN, error.to_string()),
        };
        let swims = ended.is_ok() && seen.speed() > LEAST_SPEED && rate > LEAST_RATE;
        let mut summary = Summary::default();
        summary.put("unbounded", self.domain == Domain::Unbounded, "");
        let parameters = [
            ("viscosity_inside", self.inside),
            ("viscosity_outside", self.outside),
            ("activity", self.activity),
            ("excluded_volume", self.excluded_volume),
            ("time", scene.time()),
            ("estimate", self.estimate()),
            ("speed", seen.speed()),
            ("speed_rate", rate),
        ];
        for (name, value) in parameters {
            summary.put(name, value, "");
        }
        summary.put("swims", swims, "");
        summary.put("ended_by", outcome, "");
        for name in ENTRIES {
            summary.put(name, seen.get(name), "");
        }
        for name in PRINTED {
            summary.put(&format!("{name}_printed"), printed.get(name), "");
        }
        Ok(summary)
    }
}

fn speed<H: Hydrodynamics>(scene: &mut Scene<H>, droplet: Handle<ActiveDroplet>) -> Result<f64, SceneError> {
    scene.system_mut().evaluate()?;
    let state = InterfaceState::of(scene.system(), droplet)?;
    Ok(observe(&state, Convention::FarField).map_or(f64::NAN, |seen| seen.speed()))
}

/// Observables of each run, and those which are also recorded in the convention of Cowley's print.
const ENTRIES: [&str; 17] = [
    "aspect_ratio_moments",
    "active_fraction",
    "active_curvature",
    "beta",
    "beta_laboratory",
    "stresslet_xx",
    "s_xxx",
    "s_xyy",
    "n_xyy",
    "n_yxy",
    "n_yyx",
    "f_yxy",
    "f_yyx",
    "concentration_max",
    "concentration_mode_1",
    "shape_mode_2",
    "shape_mode_3",
];
const PRINTED: [&str; 8] = ["stresslet_xx", "s_xxx", "s_xyy", "n_xyy", "n_yxy", "n_yyx", "f_yxy", "f_yyx"];
