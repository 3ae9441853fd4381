//! The scenes and what their errors are.

use anyhow::Result;

use crate::work_precision::cost::Cost;
use crate::work_precision::settings::Settings;
use crate::work_precision::{shapes, swimmers};

/// A scene whose error is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Study {
    FixedEllipse,
    Relaxation,
    Steady,
    Strong,
    Oblique,
    Transient,
    Ratio10,
    Ratio100,
    Channel,
    ElasticLayer,
}

/// Computes error and cost.
type Run = fn(&Settings) -> Result<(f64, Cost)>;

use Study::*;

/// Each with its name for files, its title, and what computes it.
const TABLE: [(Study, &str, &str, Run); 10] = [
    (FixedEllipse, "fixed_ellipse", "(a) Velocities on a fixed ellipse", shapes::fixed_ellipse),
    (Relaxation, "relaxation", "(b) Relaxation of an ellipse", shapes::relaxation),
    (Steady, "steady_swimmer", "(c) Steady swimmer", |settings| swimmers::steady(settings, -2.0)),
    (Strong, "strong_swimmer", "(c) Steady swimmer of activity -4", |settings| swimmers::steady(settings, -4.0)),
    (Oblique, "oblique_swimmer", "(c) Steady swimmer not along the grid", swimmers::oblique),
    (Transient, "transient", "(d) Transient of a swimmer", swimmers::transient),
    (Ratio10, "ratio_10", "(e) Swimmer ten times as viscous as the exterior fluid", swimmers::ratio_10),
    (Ratio100, "ratio_100", "(e) Swimmer a hundred times as viscous as the exterior fluid", swimmers::ratio_100),
    (Channel, "channel", "(f) Swimmer in a channel of width 2", swimmers::channel),
    (ElasticLayer, "elastic_layer", "(g) Elastic layer", shapes::elastic_layer),
];

impl Study {
    pub(crate) fn all() -> impl Iterator<Item = Self> {
        TABLE.into_iter().map(|(study, ..)| study)
    }

    /// For files.
    pub(crate) fn name(self) -> &'static str {
        TABLE[self as usize].1
    }

    pub(crate) fn title(self) -> &'static str {
        TABLE[self as usize].2
    }

    /// Error and cost.
    pub(crate) fn run(self, settings: &Settings) -> Result<(f64, Cost)> {
        TABLE[self as usize].3(settings)
    }
}
