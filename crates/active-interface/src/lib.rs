//! Active droplets.

mod crossing;
mod curve;
mod cyclic;
mod equidistant;
mod error;
mod excluded_volume;
mod face_value;
mod initial;
mod observables;
mod polygon;
mod positivity;
mod spline;
mod tension;
mod theory;
mod transport;
mod units;

pub use crossing::{CrossingFinder, first_crossing};
pub use curve::{Curve, markers_from_points};
pub use cyclic::{CirculantTridiagonal, CyclicTridiagonal};
pub use error::InterfaceError;
pub use excluded_volume::{ExcludedVolume, NoExcludedVolume, QuadraticExcludedVolume, StepExcludedVolume};
pub use face_value::{Flux, weno5};
pub use initial::InitialConcentration;
pub use observables::{
    ActiveRegion, ConcentrationProfile, Convention, EllipseFit, ForceMoments, FourierModes, Frame, InterfaceState,
    Observables, SquirmerFit, VelocityFrame, active_curvature, active_region, aspect_ratio_from_moments,
    centroid_velocity, concentration_modes, concentration_profile, fit_ellipse, fitted_curvature, force_moments,
    observe, shape_modes, squirmer_coefficients,
};
pub use polygon::{AreaMoments, polygon_area, polygon_moments, polygon_perimeter};
pub use positivity::{Repair, repair_positivity};
pub use tension::{ConstantTension, ContractileTension, Tension, TensionWarning};
pub use theory::{LinearTheory, ModeFlow, RoundDroplet, SquirmerFlow, equivalent_radius};
pub use transport::{Transport, cell_peclet};
pub use units::{Quantity, Units};
