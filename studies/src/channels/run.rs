//! A run by its parameters, and what is measured in it.

use anyhow::{Result, bail};
use motile::active_interface::{
    ActiveDroplet, Observables,
    trajectory::{RegimeCriteria, TrajectoryRecorder},
};
use motile::ib_core::{Every, Handle, Hydrodynamics, Scene};
use motile::stokes_grid::Drive;
use motile::{Built, DropletSetup, GridMethod, Method, Particles, Region, Setup};
use motile_examples::{Steadiness, Summary};

/// Excluded volume of the runs for speeds, and of those for amplitudes: Cowley does not give its own, and which
/// droplets oscillate depends on it; with 13.5 those do that do in Cowley.
const EXCLUDED_VOLUME: f64 = 10.0;
const EXCLUDED_VOLUME_OSCILLATING: f64 = 13.5;
/// Where the runs for amplitudes start (R0).
const OFFSET: f64 = 0.3;
/// Width of the channels of (3.7) and of (3.9) (R0).
pub(crate) const NARROW: f64 = 2.0;
pub(crate) const OSCILLATING: f64 = 3.0;
/// Fits to Cowley's own points for w = 2, figures 3.1 and 3.2: activity, viscosity, a and b of
/// |v| = a exp(-l/10) + b.
pub(crate) const THESIS_FITS: [(f64, f64, f64, f64); 5] = [
    (-2.0, 100.0, 0.20, 0.016),
    (-4.0, 50.0, 0.54, 0.094),
    (-4.0, 100.0, 0.34, 0.051),
    (-4.0, 200.0, 0.22, 0.012),
    (-5.0, 100.0, 0.42, 0.061),
];

/// What a run contributes to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// Speed in a channel, of a droplet on the centre line.
    Speed,
    /// Speed in a large periodic box.
    Unconfined,
    /// Amplitude in a channel, of a droplet that starts off the centre line.
    Amplitude,
}

/// A run by its parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Job {
    pub(crate) purpose: Purpose,
    pub(crate) length: f64,
    pub(crate) width: f64,
    pub(crate) activity: f64,
    pub(crate) viscosity: f64,
    pub(crate) spacing: f64,
    pub(crate) time: f64,
}

impl Job {
    fn excluded_volume(&self) -> f64 {
        if self.purpose == Purpose::Amplitude { EXCLUDED_VOLUME_OSCILLATING } else { EXCLUDED_VOLUME }
    }

    pub(crate) fn name(&self) -> String {
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
    pub(crate) fn fits(&self) -> bool {
        [self.length, self.width].iter().all(|side| (side / self.spacing - (side / self.spacing).round()).abs() < 1e-6)
    }

    /// The speed that Cowley's fit and its expression (3.7) give.
    pub(crate) fn thesis_speeds(&self) -> [Option<f64>; 2] {
        if self.purpose != Purpose::Speed || self.width != NARROW {
            return [None, None];
        }
        let fit = THESIS_FITS.iter().find(|fit| (fit.0, fit.1) == (self.activity, self.viscosity));
        let decay = (-self.length / 10.0).exp();
        let ratio = self.activity.abs() / self.viscosity;
        [fit.map(|(_, _, a, b)| a * decay + b), Some(10.0 * ratio * decay + ratio)]
    }

    pub(crate) fn run(&self) -> Result<Summary> {
        let (length, width) = (self.length, self.width);
        let centre = [0.0, if self.purpose == Purpose::Amplitude { OFFSET } else { 0.0 }];
        let droplet = DropletSetup { centre, ..DropletSetup::contractile(self.activity, self.excluded_volume()) };
        let setup = Setup {
            region: match self.purpose {
                Purpose::Unconfined => Region::Box { lengths: [length, width] },
                _ => Region::Channel { length, width, drive: Drive::ZeroGradient },
            },
            method: Method::Grid(GridMethod::of_spacing(self.spacing)),
            viscosity: self.viscosity,
            droplets: vec![droplet],
            ..Setup::default()
        };
        let Built { mut scene, droplets, .. } = setup.build()?;
        self.watch(&mut scene, droplets[0])
    }

    fn watch<H: Hydrodynamics>(&self, scene: &mut Scene<H>, droplet: Handle<ActiveDroplet>) -> Result<Summary> {
        let mut recorder = TrajectoryRecorder::new(droplet);
        let interval = Every::StepAfter(self.time / 600.0);
        scene.run(self.time).observe(interval, &mut recorder).go()?;
        let Some(last) = recorder.records().last() else { bail!("nothing was measured") };
        let seen = &last.observables;
        let speeds: Vec<(f64, f64)> = recorder.records().iter().map(|r| (r.time, r.observables.speed())).collect();
        let steadiness = Steadiness::of(&speeds, Particles::default().diffusion);
        let report = recorder.regime(&RegimeCriteria::default())?;
        let [fit, expression] = self.thesis_speeds();

        let mut summary = Summary::default();
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
        summary.put("area_relative_change", seen.area / scene.body(droplet)?.initial_area() - 1.0, "");
        summary.put("steps", scene.steps(), "");
        Ok(summary)
    }
}

/// Half the axis across the motion of the ellipse with the area and the aspect ratio of the droplet (length).
fn radius_across(seen: &Observables) -> f64 {
    (seen.area / (std::f64::consts::PI * seen.aspect_ratio_moments)).sqrt()
}
