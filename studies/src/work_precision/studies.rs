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

impl Study {
    pub(crate) const ALL: [Self; 10] = [
        Self::FixedEllipse,
        Self::Relaxation,
        Self::Steady,
        Self::Strong,
        Self::Oblique,
        Self::Transient,
        Self::Ratio10,
        Self::Ratio100,
        Self::Channel,
        Self::ElasticLayer,
    ];

    /// For files.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::FixedEllipse => "fixed_ellipse",
            Self::Relaxation => "relaxation",
            Self::Steady => "steady_swimmer",
            Self::Strong => "strong_swimmer",
            Self::Oblique => "oblique_swimmer",
            Self::Transient => "transient",
            Self::Ratio10 => "ratio_10",
            Self::Ratio100 => "ratio_100",
            Self::Channel => "channel",
            Self::ElasticLayer => "elastic_layer",
        }
    }

    pub(crate) fn title(self) -> &'static str {
        match self {
            Self::FixedEllipse => "(a) Velocities on a fixed ellipse",
            Self::Relaxation => "(b) Relaxation of an ellipse",
            Self::Steady => "(c) Steady swimmer",
            Self::Strong => "(c) Steady swimmer of activity -4",
            Self::Oblique => "(c) Steady swimmer not along the grid",
            Self::Transient => "(d) Transient of a swimmer",
            Self::Ratio10 => "(e) Swimmer ten times as viscous as the exterior fluid",
            Self::Ratio100 => "(e) Swimmer a hundred times as viscous as the exterior fluid",
            Self::Channel => "(f) Swimmer in a channel of width 2",
            Self::ElasticLayer => "(g) Elastic layer",
        }
    }

    /// Error and cost.
    pub(crate) fn run(self, settings: &Settings) -> Result<(f64, Cost)> {
        match self {
            Self::FixedEllipse => shapes::fixed_ellipse(settings),
            Self::Relaxation => shapes::relaxation(settings),
            Self::Steady => swimmers::steady(settings, -2.0),
            Self::Strong => swimmers::steady(settings, -4.0),
            Self::Oblique => swimmers::oblique(settings),
            Self::Transient => swimmers::transient(settings),
            Self::Ratio10 => swimmers::ratio_10(settings),
            Self::Ratio100 => swimmers::ratio_100(settings),
            Self::Channel => swimmers::channel(settings),
            Self::ElasticLayer => shapes::elastic_layer(settings),
        }
    }
}
