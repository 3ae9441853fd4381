//! Fields inside droplets: active polar gels, and particles that diffuse.
//!
//! * [`DiscMesh`]: triangular mesh inside a closed curve that follows the markers of the curve.
//! * [`GelInDroplet`], [`GelInLayer`], [`GelInBox`]: active polar gel that fills a droplet, the layer between an
//!   interface along x and the wall behind it, or a box.
//! * [`ParticlesInDroplet`]: particles that diffuse inside a droplet and are exchanged with its interface.
//!
//! The director p of a gel, |p| = 1, has the Frank energy of splay and bend with spontaneous splay. The molecular
//! field h, the dynamics and the stress are as in Cowley (1.5), (1.7) without relaxation of stress (tau = 0):
//!
//! ```text
//! F       = INT K1/2 (div p)^2 + K3/2 (curl p)^2 + k div p,   h = -dF/dp
//! Dp_i/Dt = h_i/gamma1 - nu1 u_ij p_j       (corotational; the part normal to p)
//! sigma   = 2 eta u - zeta_b (p p - 1/2) + nu1/2 (p h + h p) + 1/2 (p h - h p) - (grad p) . dF/d(grad p)
//! ```
//!
//! Here u is the rate of strain, nu1 < 0 for rods, and zeta_b < 0 for a contractile gel. The last terms are the
//! antisymmetric and the Ericksen stress.
//!
//! A gel is a separate body, in addition to the droplet that it fills. In this example, a contractile gel fills a
//! droplet of constant tension, with a director that is free at the interface and starts nearly uniform:
//!
//! ```
//! use active_interface::{ActiveDroplet, Curve};
//! use ib_core::{AnyKernel, ImmersedBoundary};
//! use motile_interior::{Anchoring, DirectorStart, GelInDroplet, GelMaterial};
//! use motile_scene::Scene;
//! use stokes_grid::{Grid, PeriodicStokes};
//!
//! let solver = PeriodicStokes::new(Grid::periodic(32, 32, 0.1875)?, 100.0)?;
//! let mut scene = Scene::new(ImmersedBoundary::new(solver, AnyKernel::BSpline4));
//! let droplet = ActiveDroplet::passive(&Curve::circle(1.0)?.markers(64)?, 100.0)?;
//! let host = scene.add(droplet.clone());
//! let material = GelMaterial { activity: -50.0, ..GelMaterial::default() };
//! let start = DirectorStart::Uniform { angle: 0.0, noise: 0.1, seed: 1 };
//! let gel = scene.add(GelInDroplet::new(&droplet, host, material, Anchoring::Free, &start, 0.2)?);
//! scene.run(0.5).go()?;
//! let seen = scene.observe(gel)?;
//! println!("energy {:.3}, {} defects", seen.director_energy, seen.defects.len());
//! assert!(seen.polarisation[0] > 0.99 && seen.defects.is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Equations of Cowley refer to Natasha Cowley, "Effects of mechanical properties of the environment on cell
//! migration", PhD thesis, University of Sheffield.

mod error;
mod factor;
mod filling;
mod gel;
mod laplacian;
mod mesh;
mod particles;

pub use error::InteriorError;
pub use gel::{Anchoring, Defect, DirectorStart, GelInBox, GelInDroplet, GelInLayer, GelMaterial, GelObservables};
pub use mesh::DiscMesh;
pub use particles::{InteriorObservables, ParticlesInDroplet};
