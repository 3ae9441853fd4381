//! The flow of interfaces by boundary integrals.

use ib_core::{
    FlowError, FlowReport, FlowSample, FlowWork, Hydrodynamics, MarkerKind, Markers, Medium, SavedState, Vec2,
};
use num_complex::Complex64;

use crate::{
    BoundaryIntegralError, FluidDomain, Settings,
    contrast::{Contrast, Parts},
    error::positive,
    far::{Division, Far},
    gmres::Outcome,
    interface::{Interface, Transforms},
    layers::{Direct, Layers},
    near::Near,
    sampler::{Sampler, Scene},
    surroundings::{NodeVelocities, Surroundings, surroundings},
    transform::{copy_band, largest_wave},
};

const FOUR_PI: f64 = 4.0 * std::f64::consts::PI;

/// Stokes flow of closed fluid interfaces in free space, a periodic box or a channel, without a grid.
///
/// The velocity at an interface with force per length F on it is (thesis, section 2.2.3; Pozrikidis, Boundary Integral
/// and Singularity Methods, 1992)
///
/// ```text
/// (eta_in + eta_out)/2 v(x) = 1/(4 pi) INT G(x, y) F(y) ds - (eta_in - eta_out)/(4 pi) INT v(y) T(x, y) n ds
/// ```
///
/// with the Green's function G of the domain and its stress T; n points outward. The single layer is integrated by the
/// rule of Kress, the double layer by the trapezoidal rule, both on `nodes` equally spaced values of the parameter, so
/// that errors fall faster than any power of the number of nodes. Where viscosities differ the equation is solved by
/// GMRES. Nodes close to another interface get a quadrature of their own, so that gaps are limited by what the film
/// between them needs, not by the kernel.
///
/// Every interface comes as a group of markers, [`MarkerKind::Interface`] or [`MarkerKind::UnevenInterface`]: `nodes`
/// or more markers, counter-clockwise, marker k at the parameter 2 pi k/markers. Positions and forces are truncated to
/// the modes that the nodes carry and the velocities come back with these modes alone.
#[derive(Debug)]
pub struct BoundaryIntegral<D> {
    domain: D,
    viscosity: f64,
    settings: Settings,
    surroundings: Box<dyn Surroundings>,
    transforms: Transforms,
    interfaces: Vec<Interface>,
    layers: Layers,
    far: Far,
    division: Division,
    near: Near,
    contrast: Contrast,
    sampler: Sampler,
    /// Velocities at the nodes, x then y, interface after interface.
    velocities: Vec<f64>,
    single_layer: Vec<f64>,
    buffer: Vec<Complex64>,
    /// Fastest relaxation, as in [`Medium`].
    stiffness: f64,
    work: FlowWork,
}

impl<D: FluidDomain> BoundaryIntegral<D> {
    /// A solver for surroundings of the given viscosity (stress times time).
    ///
    /// # Errors
    /// A viscosity that is not positive and finite, or settings out of their range.
    pub fn new(domain: D, viscosity: f64, settings: Settings) -> Result<Self, BoundaryIntegralError> {
        positive("the viscosity", viscosity)?;
        settings.check()?;
        let Settings { nodes, tolerance, .. } = settings;
        let surroundings = surroundings(domain.kind(), tolerance);
        Ok(Self {
            domain,
            viscosity,
            settings,
            far: surroundings.far(tolerance),
            division: Division::new(),
            surroundings,
            transforms: Transforms::new(nodes),
            interfaces: Vec::new(),
            layers: Layers::new(nodes),
            near: Near::new(nodes, tolerance),
            contrast: Contrast::default(),
            sampler: Sampler::new(nodes, tolerance),
            velocities: Vec::new(),
            single_layer: Vec::new(),
            buffer: vec![Complex64::default(); nodes],
            stiffness: stiffness(nodes, settings.reference_perimeter),
            work: FlowWork::default(),
        })
    }

    /// The region.
    pub fn domain(&self) -> &D {
        &self.domain
    }

    /// Resolution and accuracy.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Takes over positions and forces and their truncation to the nodes.
    fn load(&mut self, markers: &Markers) -> Result<(), FlowError> {
        let nodes = self.settings.nodes;
        check(markers, nodes)?;
        self.interfaces.resize_with(markers.groups().len(), || Interface::new(nodes));
        for (interface, group) in self.interfaces.iter_mut().zip(markers.groups()) {
            let viscosity = match group.kind {
                MarkerKind::Interface { viscosity_inside } | MarkerKind::UnevenInterface { viscosity_inside } => {
                    viscosity_inside.unwrap_or(self.viscosity)
                }
                MarkerKind::Points => self.viscosity,
            };
            let complex = |value: &Vec2| Complex64::new(value.x, value.y);
            let positions = markers.positions[group.range.clone()].iter().map(complex);
            let forces = markers.forces[group.range.clone()].iter().map(complex);
            interface.load(&mut self.transforms, viscosity, positions, forces, group.range.len());
            if interface.signed_area() <= 0.0 {
                return Err(FlowError::Unsupported {
                    what: "an interface whose markers run clockwise or that crosses itself",
                    remedy: "give its markers in counter-clockwise order",
                });
            }
        }
        Ok(())
    }

    /// The single layer at the nodes divided by 4 pi, with the imposed flow, into `self.single_layer`.
    fn add_single_layer(&mut self, contrast: bool) -> Result<(), FlowError> {
        let Self { surroundings, interfaces, layers, far, division, near, transforms, .. } = self;
        surroundings.prepare(interfaces, transforms)?;
        layers.load(interfaces, surroundings.wave());
        divide(surroundings.as_ref(), interfaces, layers, far, division);
        near.find(interfaces, transforms, &surroundings.images());
        layers.add_forces();
        far.add_forces(interfaces, &mut layers.out);
        surroundings.add_forces(interfaces, &mut layers.out);
        if !near.is_empty() {
            near.add_forces(interfaces, transforms, contrast, &mut layers.out);
        }
        self.single_layer.clear();
        for (interface, out) in self.interfaces.iter().zip(&self.layers.out) {
            let heights = interface.position.iter().map(|z| z.im + interface.centre.im);
            let imposed = heights.map(|y| self.surroundings.imposed(y, self.viscosity) * self.viscosity);
            self.single_layer.extend(out.x.iter().zip(imposed).map(|(u, imposed)| u / FOUR_PI + imposed));
            self.single_layer.extend(out.y.iter().map(|v| v / FOUR_PI));
        }
        Ok(())
    }

    /// Writes the velocities at the nodes to the markers.
    fn store(&mut self, markers: &mut Markers) -> Result<(), FlowError> {
        let nodes = self.settings.nodes;
        for (index, values) in self.velocities.chunks_exact(2 * nodes).enumerate() {
            let (x, y) = values.split_at(nodes);
            for ((value, x), y) in self.buffer.iter_mut().zip(x).zip(y) {
                *value = Complex64::new(*x, *y);
            }
            self.transforms.nodes.forward(&mut self.buffer);
            let range = markers.groups()[index].range.clone();
            let (plan, wide) = self.transforms.markers(range.len());
            copy_band(&self.buffer, wide, largest_wave(nodes));
            plan.inverse(wide);
            for (marker, (velocity, value)) in markers.velocities[range].iter_mut().zip(wide).enumerate() {
                if !value.is_finite() {
                    let (what, x, y) = ("the velocity", value.re, value.im);
                    return Err(FlowError::NonFinite { what, body: index, marker, x, y });
                }
                *velocity = Vec2::new(value.re, value.im);
            }
        }
        Ok(())
    }
}

impl<D: FluidDomain> Hydrodynamics for BoundaryIntegral<D> {
    /// A wave number q on an interface relaxes at the rate `gamma q/(2 (eta_in + eta_out))`, so the stiffness is
    /// `q eta_out/(2 (eta_in + eta_out))` with the largest wave number that the nodes carry, the largest over the
    /// interfaces of the last evaluation; before the first one `q/4` with the reference perimeter of the settings.
    fn medium(&self) -> Medium {
        Medium {
            domain: self.domain.region(),
            viscosity: self.viscosity,
            spacing: None,
            shape_modes: Some(self.settings.nodes),
            interface_stiffness: self.stiffness,
            mobility_deficit: None,
        }
    }

    fn velocities(&mut self, markers: &mut Markers) -> Result<FlowReport, FlowError> {
        self.load(markers)?;
        self.work.evaluations += 1;
        if self.interfaces.is_empty() {
            return Ok(FlowReport::default());
        }
        let nodes = self.settings.nodes;
        let rate = |interface: &Interface| {
            stiffness(nodes, interface.perimeter()) * 2.0 * self.viscosity / (self.viscosity + interface.viscosity)
        };
        self.stiffness = self.interfaces.iter().map(rate).fold(0.0, f64::max);
        let contrast = self.contrast.load(&self.interfaces, self.viscosity);
        self.add_single_layer(contrast)?;
        let mut outcome = Outcome { iterations: 0, residual: 0.0 };
        let cold = !self.settings.warm_start || self.velocities.len() != self.single_layer.len();
        if cold || !contrast {
            self.velocities.clear();
            for (values, interface) in self.single_layer.chunks_exact(2 * nodes).zip(&self.interfaces) {
                let scale = 2.0 / (self.viscosity + interface.viscosity);
                self.velocities.extend(values.iter().map(|value| value * scale));
            }
        }
        if contrast {
            if cold {
                self.contrast.forget();
            }
            let parts = Parts {
                interfaces: &self.interfaces,
                layers: &mut self.layers,
                far: &mut self.far,
                near: &self.near,
                surroundings: self.surroundings.as_mut(),
                transforms: &mut self.transforms,
                accuracy: self.settings.tolerance,
            };
            let Settings { tolerance, most_iterations, .. } = self.settings;
            let solved = self.contrast.solve(
                parts,
                &self.single_layer,
                &mut self.velocities,
                self.viscosity,
                tolerance,
                most_iterations,
            );
            outcome = solved.inspect_err(|_| self.velocities.clear())?;
            self.work.iterations += outcome.iterations;
            self.work.most_iterations = self.work.most_iterations.max(outcome.iterations);
        }
        self.store(markers)?;
        let velocities = NodeVelocities { values: &self.velocities, contrasts: &self.contrast.contrasts };
        let gradient = self.surroundings.pressure_gradient(&self.interfaces, velocities, self.viscosity);
        Ok(FlowReport {
            iterations: outcome.iterations,
            residual: outcome.residual,
            mean_pressure_gradient: [gradient, 0.0],
        })
    }

    fn sample(&mut self, markers: &Markers, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), FlowError> {
        if points.len() != out.len() {
            return Err(FlowError::WrongLength { name: "out", expected: points.len(), found: out.len() });
        }
        self.load(markers)?;
        self.contrast.load(&self.interfaces, self.viscosity);
        self.surroundings.prepare(&mut self.interfaces, &mut self.transforms)?;
        let scene = Scene {
            interfaces: &mut self.interfaces,
            contrasts: &self.contrast.contrasts,
            surroundings: self.surroundings.as_mut(),
            transforms: &mut self.transforms,
            viscosity: self.viscosity,
        };
        self.sampler.sample(scene, markers, points, out)
    }

    fn work(&self) -> FlowWork {
        self.work
    }

    fn save(&self) -> SavedState {
        let (len, kept) = self.contrast.save();
        let mut reals = vec![self.stiffness];
        reals.extend_from_slice(&self.velocities);
        reals.extend_from_slice(&kept);
        SavedState { reals, counts: vec![self.velocities.len() as u64, len as u64] }
    }

    fn load(&mut self, saved: &SavedState) {
        let ([stiffness, rest @ ..], &[count, len]) = (saved.reals.as_slice(), saved.counts.as_slice()) else {
            return;
        };
        let count = usize::try_from(count).unwrap_or(usize::MAX);
        let (Some(velocities), Some(kept)) = (rest.get(..count), rest.get(count..)) else { return };
        self.stiffness = *stiffness;
        self.velocities = velocities.to_vec();
        // Vectors of another length than those of the velocities are of something else.
        let len = usize::try_from(len).unwrap_or(usize::MAX);
        if kept.is_empty() {
            self.contrast.forget();
        } else if len == count {
            self.contrast.restore(len, kept);
        }
    }
}

/// Divides the Green's function between all interfaces into sums over nodes and series.
pub(crate) fn divide(
    surroundings: &dyn Surroundings,
    interfaces: &[Interface],
    layers: &mut Layers,
    far: &mut Far,
    division: &mut Division,
) {
    layers.directs.clear();
    far.clear(interfaces);
    for target in 0..interfaces.len() {
        for source in target..interfaces.len() {
            surroundings.divide(&interfaces[target], &interfaces[source], target == source, division);
            layers.directs.extend(division.pairs.iter().map(|&(pair, own)| Direct { target, source, own, pair }));
            far.link(interfaces, [target, source], division);
        }
    }
}

/// A quarter of the largest wave number of a curve.
fn stiffness(nodes: usize, perimeter: f64) -> f64 {
    0.25 * (nodes / 2) as f64 * std::f64::consts::TAU / perimeter
}

/// Refuses what cannot be computed, before any work.
fn check(markers: &Markers, nodes: usize) -> Result<(), FlowError> {
    for (body, group) in markers.groups().iter().enumerate() {
        match group.kind {
            MarkerKind::Interface { viscosity_inside } | MarkerKind::UnevenInterface { viscosity_inside } => {
                if let Some(value) = viscosity_inside
                    && !(value.is_finite() && value > 0.0)
                {
                    let remedy = "give a positive finite viscosity inside";
                    return Err(FlowError::Parameter { name: "the viscosity inside an interface", value, remedy });
                }
            }
            MarkerKind::Points => {
                return Err(FlowError::Unsupported {
                    what: "a body of points without a closed interface",
                    remedy: "use the immersed boundary method for scenes with solids",
                });
            }
        }
        if group.range.len() < nodes {
            return Err(FlowError::Parameter {
                name: "the number of markers of an interface",
                value: group.range.len() as f64,
                remedy: "give at least as many markers as the settings have nodes, or fewer nodes",
            });
        }
        for (what, values) in [("the position", &markers.positions), ("the force", &markers.forces)] {
            for (marker, value) in values[group.range.clone()].iter().enumerate() {
                if !(value.x.is_finite() && value.y.is_finite()) {
                    return Err(FlowError::NonFinite { what, body, marker, x: value.x, y: value.y });
                }
            }
        }
    }
    Ok(())
}
