//! Active droplets in three-dimensional Stokes flow without symmetry.
//!
//! Use this crate if the heading of a swimmer, a shear flow or a disturbance breaks the symmetry of a droplet. For
//! axisymmetric droplets, `motile-boundary-integrals` is faster. The model is the one of `active-interface`, with
//! concentrations per area and the tension per length:
//!
//! ```text
//! f = div_s(gamma (1 - n n)),   gamma = gamma0 - zeta c - Pi(c)     force per area on the fluid
//! dc/dt + div_s(c u) = D lap_s c                                    particles on the surface
//! eta_e u(x) - (eta_e - eta_i)/(8 pi) INT T (u - u(x)) n dA = 1/(8 pi) INT G f dA
//! ```
//!
//! with the Stokeslet G and the stresslet T. In this example, a droplet with an oblique gradient of tension swims along
//! the gradient at the speed of the closed form:
//!
//! ```
//! use space_droplets::{ContractileTension, ExcludedVolume, SpaceDroplet};
//!
//! // Tension 1 + 0.5 c, and concentrations 1 + s.axis on the unit sphere.
//! let axis = [0.6, 0.0, 0.8];
//! let law = ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0)?;
//! let along = |s: [f64; 3]| s[0] * axis[0] + s[2] * axis[2];
//! let mut droplet = SpaceDroplet::sphere(8, 1.0, [10.0, 1.0], law)?.with_particles(0.1, |s| 1.0 + along(s))?;
//! let velocity = droplet.observe()?.velocity;
//! let exact = -2.0 * 0.5 / (3.0 * (2.0 * 1.0 + 3.0 * 10.0));
//! println!("velocity along the axis {:.8}, exact {exact:.8}", along(velocity));
//! assert!((along(velocity) - exact).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What there is
//!
//! * [`SpaceDroplet`]: a droplet with its flow, particles and imposed linear flow. [`SpaceDroplet::advance`] runs it
//!   with the integrators of `motile-scene`, [`SpaceDroplet::observe`] measures it.
//! * [`EdgeFollowing`]: parameters that crowd at the sharp edge of the particles of a swimmer.
//! * [`SpaceDroplets`]: several droplets in one fluid, also close to each other, with or without repulsion.
//! * [`Surroundings`]: walls or a periodic box around droplets: [`Tube`], [`Slit`], [`PeriodicBox`], or your own.
//! * [`SpaceBody`]: droplets as a body of a scene of `motile-scene`, with its observers and checkpoints.
//! * [`SteadyState`]: steady axisymmetric swimmers, and the growth of disturbances of any order in phi.
//!
//! # Method
//!
//! Positions and particles are sums of spherical harmonics up to a degree p (`sphere-harmonics`). Forces and transport
//! are weak: they are integrals against gradients of harmonics. So the net force, the net torque and the change of the
//! number of particles are zero to round-off at any degree. The layers are integrated on a polar grid about each target
//! point, where the singularity cancels; errors fall exponentially with the degree. For two viscosities, the double
//! layer is a matrix of 12 (p + 1)^4 numbers: 8 MB at p = 16 and 114 MB at p = 32.
//!
//! The degree is the resolution. 8 to 12 is enough for droplets without sharp particles. A swimmer of activity -1 in
//! Cowley's units has an error of the speed of 1e-5 at p = 16 if parameters crowd at the edge.
//! [`SpaceDroplet::warnings`] says when the degree is too low. [`SteadyState`] crowds parameters at the edge of the
//! particles. At p = 24 and viscosities of 100, its speeds have errors of 8e-7, 6e-7, 6e-6 and 9e-6 at the activities
//! -1, -1.5, -2 and -3, compared with axisymmetric boundary integrals. The aspect ratio is off by 3e-5 at -3.
//!
//! With the feature `rayon`, off by default, several threads compute the flow, and results are bitwise identical.

mod body;
mod close;
mod closest;
mod droplet;
mod error;
mod flow;
mod guess;
mod lattice;
mod layers;
mod mesh;
mod observables;
mod polar;
mod reflections;
mod run;
mod several;
mod slit;
mod steady;
mod surface;
mod surroundings;
mod tube;
mod waves;

pub use active_interface::{ConstantTension, ContractileTension, ExcludedVolume, Tension};
pub use body::{SpaceBody, SpaceFluid};
pub use droplet::{EdgeFollowing, LARGEST_DEGREE, SpaceDroplet};
pub use error::SpaceError;
pub use lattice::PeriodicBox;
pub use mesh::SurfaceMesh;
pub use motile_scene::{
    Repulsion, StepSize,
    integrator::{Integrator, Midpoint, RungeKutta, RungeKuttaChebyshev},
};
pub use observables::Observation;
pub use run::RunReport;
pub use several::SpaceDroplets;
pub use slit::Slit;
pub use steady::SteadyState;
pub use surroundings::{Components, Sources, Surroundings, Targets};
pub use tube::Tube;
