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
            Self::Ratio10 => "(e) Swimmer ten times as viscous as its surroundings",
            Self::Ratio100 => "(e) Swimmer a hundred times as viscous as its surroundings",
            Self::Channel => "(f) Swimmer in a channel of width 2",
            Self::ElasticLayer => "(g) Elastic layer",
        }
    }

    /// The scene and its error.
    pub(crate) fn about(self) -> &'static str {
        match self {
            Self::FixedEllipse => {
                "Ellipse 1.3 : 1/1.3 with the tension 1 + 0.5 cos t in a 6 x 6 box; largest error of the velocity at \
                 eight points, over the largest velocity there; cost per evaluation of the velocities."
            }
            Self::Relaxation => {
                "The same ellipse with tension and viscosity 1 relaxes to t = 2; error of its aspect ratio less one."
            }
            Self::Steady => {
                "Activity -2, excluded volume 4, viscosity 100, 6 x 6 box, from the polarised start to t = 80; error \
                 of the speed."
            }
            Self::Strong => {
                "Activity -4, excluded volume 8, viscosity 100, 6 x 6 box, from the polarised start to t = 80; error \
                 of the speed. The edge of the crowded region is twice as sharp."
            }
            Self::Oblique => {
                "Activity -3, excluded volume 6, viscosity 100, 6 x 6 box, swimming at 0.4 radians from the x axis \
                 from a place between the grid points; error of the speed against boundary integrals with 96 nodes and \
                 512 cells. The images turn the droplet, and so may a grid; its speed depends on its direction."
            }
            Self::Transient => {
                "Activity -1, excluded volume 2, 6 x 6 box, from the polarised start; largest error of the speed at \
                 the times of the reference."
            }
            Self::Ratio10 => {
                "Activity -1, excluded volume 2, viscosity 100 in surroundings of 10, 6 x 6 box, t = 80; error of the \
                 speed."
            }
            Self::Ratio100 => {
                "Activity -1, excluded volume 2, viscosity 100 in surroundings of 1, 6 x 6 box, t = 80; error of the \
                 speed against boundary integrals with 160 nodes and 1280 cells."
            }
            Self::Channel => {
                "Activity -2, excluded volume 10, viscosity 100, period 12, width 2, no mean pressure gradient, t = \
                 80; error of the speed."
            }
            Self::ElasticLayer => {
                "A sheared neo-Hookean layer on a wall relaxes below a fluid as viscous (channel of height 2, layer \
                 0.87) over one time eta/mu; error of the rate against mu/eta (1 - a/H); cost per time eta/mu."
            }
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
