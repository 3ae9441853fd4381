//! Settings that reach a target error.

use active_interface::ExcludedVolume;
use motile_base::{Drive, Region};
use motile_scene::StepSize;

use crate::SetupError;
use crate::setup::{DropletSetup, GridMethod, IntegralMethod, LayersMethod, Method, MethodKind, Particles, Setup};

/// Contents of a scene that set its errors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SceneKind {
    /// Droplets in a periodic box.
    Box,
    /// Droplets in a periodic box, more viscous than the exterior fluid by a factor of up to a hundred.
    ViscosityContrast,
    /// Droplets in a channel with rigid walls, with gaps of a few hundredths of the radius.
    Channel,
}

/// Returns the largest error at any time between t = 40 and 80, over the scenes of `docs/tables/recommended.csv` of
/// that kind that [`recommend`] covers, of these settings and of all finer ones of the same kind; on grids and for
/// small errors with a fifth or more to spare for places and directions that were not tried. From coarse to fine.
fn measured(scene: SceneKind, method: MethodKind) -> Vec<(f64, Method)> {
    // Error, nodes of the shape, cells of the concentration.
    let integrals: &[(f64, usize, usize)] = match scene {
        SceneKind::Box => &[(0.0085, 24, 96), (0.0012, 64, 192), (0.0007, 64, 256)],
        SceneKind::ViscosityContrast => &[(0.0065, 24, 48), (0.0025, 48, 192)],
        SceneKind::Channel => &[(0.0080, 48, 192), (0.0045, 64, 192), (0.0013, 80, 320), (0.0008, 96, 384)],
    };
    // Error, spacing of the grid over the radius, for the default kernel and markers half of that apart.
    let grids: &[(f64, f64)] = match scene {
        SceneKind::Box => &[(0.025, 0.1), (0.008, 0.075), (0.0025, 0.05)],
        // Of first order there.
        SceneKind::ViscosityContrast => &[],
        SceneKind::Channel => &[(0.036, 0.2), (0.0065, 0.1)],
    };
    let integral = |&(error, nodes, elements): &_| (error, Method::Integral(IntegralMethod { nodes, elements }));
    let layer = |&(error, nodes, elements): &_| {
        (error, Method::Layers(LayersMethod { nodes, elements, ..LayersMethod::default() }))
    };
    let grid = |&(error, spacing): &_| (error, Method::Grid(GridMethod::of_spacing(spacing)));
    match method {
        MethodKind::Integral => integrals.iter().map(integral).collect(),
        // Without solids they are the same.
        MethodKind::Layers => integrals.iter().map(layer).collect(),
        MethodKind::Grid => grids.iter().map(grid).collect(),
        MethodKind::Harmonics => Vec::new(),
    }
}

/// A method and the steps that go with it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Recommendation {
    /// Method of the flow.
    pub method: Method,
    /// Length of the steps of runs.
    pub step: StepSize,
}

/// Returns the cheapest settings (nodes and cells, or spacings and kernel, and the time step) that are known to give
/// the speed of a steady swimmer with a relative error below `target_error` (no dimension; 0.01 is 1 %) at every time,
/// in a kind of scene by a method. The grid spacing is for a radius of one.
///
/// On a grid, the speed oscillates while a droplet crosses the cells, by an amount that depends on its direction and on
/// where its path lies between grid lines. The error is the largest that was found, and the mean is often several times
/// better. Covered is one droplet in units of the defaults at activities down to -4 in a box (A = 2 |activity|), to
/// -1.5 with a contrast, in a channel to -2, by boundary integrals in one of width two to -4. Outside of this range,
/// take the settings as a start. A sharper edge of the concentration needs more cells ([`motile_scene::Warnings`]
/// reports it). The study `recommended` measures the data (`docs/tables/recommended.csv`). Steps are as long as by
/// default, each with an estimated error below 1e-4, which change the speed of a steady swimmer by less than 1e-5
/// (`studies -- time_steps --study default`).
///
/// ```
/// use motile::prelude::*;
/// use motile::setup::MethodKind;
/// use motile::{Recommendation, SceneKind, recommend};
///
/// let Recommendation { method, step, .. } = recommend(SceneKind::Box, MethodKind::Integral, 0.01)?;
/// let Method::Integral(integral) = method else { panic!("without a grid") };
/// assert!(integral.nodes < IntegralMethod::default().nodes);
/// let _setup = Setup { method, step, ..Setup::default() };
/// // Nothing that was measured is this accurate.
/// assert!(recommend(SceneKind::Box, MethodKind::Grid, 1e-7).is_err());
/// # Ok::<(), motile::SetupError>(())
/// ```
///
/// # Errors
/// Returns an error for a target below the smallest error that was measured, above 5 %, or not a number; a viscosity
/// contrast on a grid, which is of first order.
pub fn recommend(scene: SceneKind, method: MethodKind, target_error: f64) -> Result<Recommendation, SetupError> {
    const LARGEST: f64 = 0.05;
    let entries = measured(scene, method);
    if entries.is_empty() {
        let remedy =
            "with a viscosity contrast the grid method is only first-order accurate. Use integral or layers".to_owned();
        return Err(SetupError::Value { key: "method".to_owned(), value: method.name().to_owned(), remedy });
    }
    let found = entries.iter().find(|(error, _)| *error <= target_error).filter(|_| target_error <= LARGEST);
    let Some(&(_, method)) = found else {
        let smallest = entries.iter().map(|(error, _)| *error).fold(f64::INFINITY, f64::min);
        return Err(SetupError::TargetError { target: target_error, smallest, largest: LARGEST });
    };
    Ok(Recommendation { method, step: StepSize::default() })
}

impl Setup {
    /// Returns the largest relative error of the speed of a steady swimmer (no dimension) that was measured with
    /// settings that are no finer than these, in the kind of scene that this is, as [`recommend`] knows them. `None`
    /// for settings coarser than all that were measured, for other kernels than the default, and for scenes that differ
    /// from the measured ones in more than the place and heading of their droplet. Such scenes have another number of
    /// droplets, other bodies, walls, flows or radii, unbounded fluid, three dimensions, or activities beyond the range
    /// of [`recommend`].
    ///
    /// ```
    /// use motile::prelude::*;
    ///
    /// assert_eq!(Setup::default().expected_error(), Some(0.0007));
    /// let coarse = Method::Integral(IntegralMethod { nodes: 32, elements: 128 });
    /// assert_eq!(Setup { method: coarse, ..Setup::default() }.expected_error(), Some(0.0085));
    /// assert_eq!(Setup { region: Region::Plane, ..Setup::default() }.expected_error(), None);
    /// let strong = Setup { droplets: vec![DropletSetup::active(-9.0)], ..Setup::default() };
    /// assert_eq!(strong.expected_error(), None);
    /// ```
    #[must_use]
    pub fn expected_error(&self) -> Option<f64> {
        let scene = self.measured_kind()?;
        let as_fine = |known: &Method| match (self.method, known) {
            (Method::Integral(here), Method::Integral(there)) => {
                here.nodes >= there.nodes && here.elements >= there.elements
            }
            (Method::Layers(here), Method::Layers(there)) => {
                here.nodes >= there.nodes && here.elements >= there.elements
            }
            (Method::Grid(here), Method::Grid(there)) => {
                here.spacing <= there.spacing && GridMethod { spacing: there.spacing, ..here } == *there
            }
            _ => false,
        };
        let finest = measured(scene, self.method.kind()).into_iter().rev().find(|(_, known)| as_fine(known));
        finest.map(|(error, _)| error)
    }

    /// Returns the kind of the scenes that were measured, if this is one of them.
    fn measured_kind(&self) -> Option<SceneKind> {
        let [droplet] = self.droplets.as_slice() else { return None };
        let particles = droplet.particles.as_ref()?;
        // All else is as in the scenes that were measured.
        let plain = Particles {
            activity: particles.activity,
            excluded_volume: particles.excluded_volume,
            ..Particles::default()
        };
        let round = DropletSetup {
            name: droplet.name.clone(),
            centre: droplet.centre,
            angle: droplet.angle,
            viscosity: droplet.viscosity,
            particles: Some(plain),
            ..DropletSetup::default()
        };
        let like = Setup {
            region: self.region,
            method: self.method,
            viscosity: self.viscosity,
            droplets: vec![round],
            mirror_symmetric: self.mirror_symmetric,
            ..Setup::default()
        };
        if *self != like || !matches!(particles.excluded_volume, ExcludedVolume::Step(step) if step <= 10.0) {
            return None;
        }
        let ratio = droplet.viscosity.map_or(1.0, |inside| inside / self.viscosity);
        let (kind, strongest) = match self.region {
            Region::Box { lengths } if lengths.iter().all(|&length| length >= 6.0) => match ratio {
                1.0 => (SceneKind::Box, -4.0),
                1.0..=100.0 => (SceneKind::ViscosityContrast, -1.5),
                _ => return None,
            },
            Region::Channel { width, drive: Drive::ZeroGradient, .. } if width >= 2.0 && ratio == 1.0 => {
                (SceneKind::Channel, -2.0)
            }
            _ => return None,
        };
        (strongest..0.0).contains(&particles.activity).then_some(kind)
    }
}

/// Fewest droplets for which a grid can be cheaper than boundary integrals at the same error (`docs/tables/many.csv`).
const MANY: usize = 4;

/// Costs of a unit of time with sixteen droplets, in FFT pairs (`docs/tables/many.csv`): of boundary integrals by their
/// nodes, and of a grid by its spacing over the radius. With four and with sixty-four droplets their order is the same,
/// except that at four a spacing of 0.075 costs 14 % less than 24 nodes.
const OF_NODES: [(usize, f64); 4] = [(24, 775.0), (48, 1395.0), (64, 1525.0), (96, 2400.0)];
const OF_SPACING: [(f64, f64); 3] = [(0.1, 737.0), (0.075, 1008.0), (0.05, 1974.0)];

/// Returns the cost of a method with many droplets, as of the next finer settings that were measured.
fn cost(method: &Method) -> f64 {
    match method {
        Method::Integral(IntegralMethod { nodes, .. }) | Method::Layers(LayersMethod { nodes, .. }) => {
            OF_NODES.iter().find(|(known, _)| known >= nodes).map_or(f64::INFINITY, |(_, cost)| *cost)
        }
        Method::Grid(GridMethod { spacing, .. }) => {
            OF_SPACING.iter().find(|(known, _)| known <= spacing).map_or(f64::INFINITY, |(_, cost)| *cost)
        }
        Method::Harmonics(_) => f64::INFINITY,
    }
}

/// Returns the cheapest method for a scene of so many droplets, with its settings for an error of [`recommend`].
///
/// For up to three droplets, these are boundary integrals. For four or more, boundary integrals and a grid cost about
/// the same at the same error, because sums over many nodes are fast. In a box, boundary integrals are cheaper by about
/// a quarter for errors of 1 % and of 0.25 %, and a grid is cheaper by a few percent for errors of 2.5 %. In a channel,
/// a grid is cheaper by half for errors of 1 %. With elastic solids, these are layers: solids on a grid are off by 0.5
/// to 0.8 % however fine it is. Measured by `studies -- many` on lattices in a box with gaps of 1.6 radii. For narrow
/// films, use boundary integrals or layers with any number of droplets.
///
/// ```
/// use motile::prelude::*;
/// use motile::{SceneKind, cheapest};
///
/// let method = |droplets, solids| cheapest(SceneKind::Box, droplets, solids, 0.01).map(|found| found.method);
/// assert!(matches!(method(1, 0)?, Method::Integral(_)));
/// assert!(matches!(method(16, 0)?, Method::Integral(_)));
/// assert!(matches!(cheapest(SceneKind::Channel, 16, 0, 0.01)?.method, Method::Grid(_)));
/// assert!(matches!(method(16, 16)?, Method::Layers(_)));
/// // A contrast of viscosities is of first order on a grid.
/// let contrast = cheapest(SceneKind::ViscosityContrast, 16, 0, 0.01)?;
/// assert!(matches!(contrast.method, Method::Integral(_)));
/// # Ok::<(), motile::SetupError>(())
/// ```
///
/// # Errors
/// Returns the errors of [`recommend`] if no method has settings for the error.
pub fn cheapest(
    scene: SceneKind,
    droplets: usize,
    elastic_solids: usize,
    target_error: f64,
) -> Result<Recommendation, SetupError> {
    let of = |method| recommend(scene, method, target_error);
    if elastic_solids > 0 {
        of(MethodKind::Layers)
    } else if droplets < MANY {
        of(MethodKind::Integral)
    } else {
        match (of(MethodKind::Integral), of(MethodKind::Grid)) {
            (Ok(integral), Ok(grid)) if cost(&grid.method) < cost(&integral.method) => Ok(grid),
            (Err(_), Ok(grid)) => Ok(grid),
            (integral, _) => integral,
        }
    }
}

#[cfg(test)]
mod tests;
