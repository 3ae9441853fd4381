//! What is measured on a droplet. Every function works on plain slices.

mod active_region;
mod channel_flow;
mod circle_fit;
mod ellipse_fit;
mod fourier;
mod frame;
mod moments;
mod normal_stress;
mod profile;
mod record;
mod squirmer;

pub use active_region::{ActiveRegion, active_curvature, active_region};
pub use channel_flow::{GapFlow, gap_flow, net_flux, pressure_drop};
pub use ellipse_fit::{EllipseFit, fit_ellipse};
pub use fourier::{FourierModes, concentration_modes, shape_modes};
pub use frame::{Frame, centroid_velocity};
pub use moments::{Convention, ForceMoments, force_moments};
pub use normal_stress::stress_curvature;
pub use profile::{ConcentrationProfile, concentration_profile};
pub use record::{InterfaceState, Observables, observe};
pub use squirmer::{SquirmerFit, VelocityFrame, squirmer_coefficients};
