//! The results of a run with a droplet.

use motile::{
    active_interface::Observables,
    ib_core::{hydrodynamics::FlowWork, scene::StepReport},
};

use motile_output::SolidMeter;

use crate::{Steadiness, Summary};

/// What a run took.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RunCost {
    /// Time reached.
    pub time: f64,
    /// Steps.
    pub steps: usize,
    /// Wall clock time (seconds).
    pub seconds: f64,
    /// Work for the flow.
    pub work: FlowWork,
    /// How long the steps were, what made them so, and how many were taken back.
    pub report: StepReport,
    /// Stages of the integrator.
    pub stages: usize,
    /// Why the run broke off, if it did.
    pub failure: Option<String>,
}

/// The results that all scenes with a droplet have: its state in the end compared with the start.
#[must_use]
pub fn droplet_summary(
    first: &Observables,
    last: &Observables,
    steadiness: &Steadiness,
    cost: &RunCost,
    mean_concentration: f64,
) -> Summary {
    let mut summary = Summary::new();
    let value = |name: &str| last.get(name).unwrap_or(f64::NAN);
    let entries = [
        ("speed", "of the centroid (R0 per time)"),
        ("heading_degrees", "direction of motion, from x"),
        ("aspect_ratio_moments", "along over across the motion, from area moments"),
        ("aspect_ratio_ellipse", "the same of a fitted ellipse"),
        ("stresslet_xx", "axes along the motion; below 0 a puller"),
        ("beta", "B2/|B1| in the droplet's frame"),
        ("b1", "squirmer coefficient (R0 per time)"),
        ("b2", "squirmer coefficient (R0 per time)"),
        ("active_fraction", "of the perimeter"),
        ("active_curvature", "signed, of the active region (1/R0)"),
    ];
    for (name, about) in entries {
        summary.put(name, value(name), about);
    }
    for name in ["concentration_max", "concentration_min"] {
        summary.put(name, value(name) / mean_concentration, "in c0");
    }
    summary.put("perimeter", last.perimeter, "(R0)");
    summary.put("area_relative_change", last.area / first.area - 1.0, "since the start");
    let particles = last.particle_number / first.particle_number - 1.0;
    summary.put("particle_relative_change", particles, "since the start");
    summary.put("steady", steadiness.json(), "speed within 0.1 % of its final mean");
    summary.put("time", cost.time, "simulated");
    summary.put("steps", cost.steps, "");
    summary.put("dt", cost.time / cost.steps as f64, "mean time step");
    let report = &cost.report;
    summary.put("dt_shortest", report.shortest, "");
    summary.put("dt_longest", report.longest, "");
    let limiting = report.most_limiting().map(|limiting| match limiting.body.as_str() {
        "" => limiting.reason.clone(),
        body => format!("{} of {body}", limiting.reason),
    });
    summary.put("dt_set_by", limiting, "for most steps");
    summary.put("steps_rejected", report.rejections, "for their error");
    summary.put("steps_failed", report.failures, "and taken anew");
    summary.put("stages", cost.stages, "of all steps");
    let work = cost.work;
    summary.put("stokes_solves", work.stokes_solves, "on the grid");
    let mean = work.iterations as f64 / work.evaluations.max(1) as f64;
    summary.put("solver_iterations_mean", mean, "of an evaluation of the flow");
    summary.put("solver_iterations_max", work.most_iterations, "");
    summary.put("seconds", cost.seconds, "of computation");
    summary.put("finished", cost.failure.is_none(), "");
    if let Some(failure) = &cost.failure {
        summary.put("failure", failure.as_str(), "");
    }
    summary
}

/// Puts the values of [`SolidMeter::measure`] into the results of a run.
pub fn put_solids(summary: &mut Summary, values: &[f64; 8]) {
    let about = [
        "in the end (R0)",
        "in the end (R0)",
        "between droplet and walls, in the end (R0)",
        "of the walls, in any direction (R0)",
        "across their surface (R0)",
        "mean displacement of a wall along the channel (R0)",
        "of the walls",
        "deformed over reference area of a triangle",
    ];
    for ((name, value), about) in SolidMeter::NAMES.iter().zip(values).zip(about) {
        summary.put(name, *value, about);
    }
}
