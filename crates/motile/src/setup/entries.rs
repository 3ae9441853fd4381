//! Entries of a description that a resumed run has to agree with.

use std::collections::BTreeMap;

use ib_core::AnyKernel;
use motile_base::{Drive, Region};

use super::{GridMethod, GridSolver, LayersMethod, Method, Particles, Setup};
use motile_scene::{StepSize, integrator::IntegratorKind};

impl Setup {
    /// Returns the description with all that a resumed run may change at its default: `step`, `integrator`,
    /// `tolerance`, `least-gap`, spacing, kernel, correction and solver of the grid, and the flux of particles. A drive
    /// of zero is the same however it is written.
    fn kept(&self) -> Self {
        let region = match self.region {
            Region::Channel { length, width, drive } => Region::Channel { length, width, drive: zero_drive(drive) },
            Region::SlipChannel { length, width, drive, slip } => {
                Region::SlipChannel { length, width, drive: zero_drive(drive), slip }
            }
            Region::Tube { radius, shape, drive, length } => {
                Region::Tube { radius, shape, drive: zero_drive(drive), length }
            }
            region => region,
        };
        let method = match self.method {
            Method::Integral(_) | Method::Harmonics(_) => self.method,
            Method::Layers(LayersMethod { nodes, elements, .. }) => {
                Method::Layers(LayersMethod { nodes, elements, ..LayersMethod::default() })
            }
            Method::Grid(GridMethod { marker_spacing, .. }) => {
                let (kernel, solver) = (AnyKernel::BSpline4, GridSolver::default());
                Method::Grid(GridMethod { marker_spacing, kernel, solver, ..GridMethod::default() })
            }
        };
        let mut kept = Self {
            region,
            method,
            step: StepSize::default(),
            integrator: IntegratorKind::default(),
            tolerance: None,
            least_gap: None,
            ..self.clone()
        };
        let droplets = kept.droplets.iter_mut().chain(kept.suspension.iter_mut().map(|many| &mut many.droplet));
        let particles = droplets.map(|droplet| &mut droplet.particles);
        let particles = particles.chain(kept.interfaces.iter_mut().map(|interface| &mut interface.particles));
        particles.flatten().for_each(|particles| particles.flux = Particles::default().flux);
        kept
    }

    /// Returns the keys and values that a resumed run has to agree with ([`motile_scene::Scene::described_by`]), as
    /// they are in a scene file. These are all except `step`, `integrator`, `tolerance`, `least-gap`, the grid's
    /// `spacing`, `kernel`, `corrected` and `solver`, and the particles' `flux`. Without the feature `toml` there is
    /// one entry, a number that stands for all of them.
    #[must_use]
    pub fn entries(&self) -> BTreeMap<String, String> {
        let mut entries = BTreeMap::new();
        #[cfg(feature = "toml")]
        match super::file::writer::table(&self.kept()) {
            Ok(table) => add("", &toml::Value::Table(table), &mut entries),
            // A seed that TOML has no number for.
            Err(_) => drop(entries.insert(DESCRIPTION.to_owned(), self.kept().hash())),
        }
        #[cfg(not(feature = "toml"))]
        entries.insert(DESCRIPTION.to_owned(), self.kept().hash());
        entries
    }

    /// Returns the first of the [`Setup::entries`] that is not the same as in a saved description, with both values, in
    /// words.
    ///
    /// ```
    /// use motile::prelude::*;
    ///
    /// let saved = Setup { viscosity: 50.0, ..Setup::default() };
    /// let text = Setup::default().difference(&saved).unwrap_or_default();
    /// // With the feature `toml`: viscosity is 50.0 in it and 100.0 here
    /// assert!(text.contains(" in it and ") && saved.difference(&saved).is_none());
    /// ```
    #[must_use]
    pub fn difference(&self, saved: &Self) -> Option<String> {
        motile_scene::checkpoint::other_entry(&self.entries(), &saved.entries())
    }

    /// FNV-1a of the printed description (hexadecimal).
    pub(super) fn hash(&self) -> String {
        let hash = format!("{self:?}")
            .bytes()
            .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3));
        format!("{hash:016x}")
    }
}

/// Key of the number of a description whose entries are not known.
const DESCRIPTION: &str = "the number of the description";

/// Adds the leaves of a value at a key.
#[cfg(feature = "toml")]
fn add(key: &str, value: &toml::Value, entries: &mut BTreeMap<String, String>) {
    match value {
        toml::Value::Table(table) => {
            let dot = if key.is_empty() { "" } else { "." };
            table.iter().for_each(|(name, value)| add(&format!("{key}{dot}{name}"), value, entries));
        }
        toml::Value::Array(list) => {
            entries.insert(key.to_owned(), format!("a list of {}", list.len()));
            list.iter().enumerate().for_each(|(k, value)| add(&format!("{key}[{k}]"), value, entries));
        }
        leaf => drop(entries.insert(key.to_owned(), leaf.to_string())),
    }
}

/// Returns the drive, if it is zero in the shorter way of writing that.
fn zero_drive(drive: Drive) -> Drive {
    match drive {
        Drive::Gradient(0.0) => Drive::ZeroGradient,
        Drive::Flux(0.0) => Drive::ZeroFlux,
        drive => drive,
    }
}
