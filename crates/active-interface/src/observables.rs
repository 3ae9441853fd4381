//! Measurements on a droplet at one time; every function works on plain slices of markers.

mod active_region;
mod channel_flow;
mod curvature;
mod ellipse_fit;
mod fourier;
mod frame;
mod least_squares;
mod membrane;
mod moments;
mod periodic;
mod polar;
mod profile;
mod revolution;
mod squirmer;

use std::f64::consts::PI;

use motile_base::{
    ImposedFlow, Vec2,
    internal::{all_finite, all_points_finite, at_least},
    same_length,
};
use motile_scene::{BodyFlow, Enclosed, FluidView, Handle, Hydrodynamics, MomentEllipse, SceneError, System};

use crate::curve::polygon::{edges, raw_perimeter};
use crate::{ActiveDroplet, InterfaceError, curve::polygon_moments};
use ellipse_fit::raw_ellipse;
use fourier::{raw_concentration_modes, raw_shape_modes};
use frame::{aspect_ratio_of, raw_centroid_velocity};
use polar::PolarMarkers;
use squirmer::raw_squirmer;

pub use active_region::{ActiveRegion, active_curvature, active_region};
pub use channel_flow::{BranchFlow, GapFlow, branch_flows, gap_flow, net_flux, pressure_drop};
pub use curvature::stress_curvature;
pub use ellipse_fit::{EllipseFit, fit_ellipse};
pub use fourier::{FourierModes, concentration_modes, shape_modes};
pub use frame::{Frame, centroid_velocity};
pub use membrane::MembraneMeasures;
pub use moments::{Convention, ForceMoments, force_moments};
pub use periodic::PeriodicObservables;
pub use profile::{ConcentrationProfile, concentration_profile};
pub use squirmer::{SquirmerFit, VelocityFrame, squirmer_coefficients};

/// State of an interface from which its observables are computed: lists of M values, one per marker or one per segment.
#[derive(Debug, Clone)]
pub struct InterfaceState<'a> {
    /// Markers in counter-clockwise order (length).
    pub markers: &'a [Vec2],
    /// Forces on the fluid at the markers (force).
    pub forces: &'a [Vec2],
    /// Velocities of the fluid at the markers (length per time), in the frame of the fluid far away or of the walls.
    pub velocities: &'a [Vec2],
    /// The imposed flow, which is part of the velocities.
    pub imposed: ImposedFlow,
    /// Particle numbers of the segments, segment k from marker k to the next; empty for an interface without particles.
    pub numbers: &'a [f64],
    /// Number of particles inside, and rate of binding less unbinding (1/time); `None` without exchange.
    pub inside: Option<(f64, f64)>,
    /// Measures of a membrane; `None` for other interfaces.
    pub membrane: Option<MembraneMeasures>,
    /// Viscosities inside and outside (stress times time).
    pub viscosities: [f64; 2],
    /// Bodies inside the droplet ([`BodyFlow::enclosed`]), whose forces are among its force moments.
    pub enclosed: Vec<Enclosed>,
    /// True for a body of revolution in three dimensions, of which the markers are the meridian with its mirror image,
    /// and forces and numbers belong to halves of rings.
    pub axisymmetric: bool,
    /// True for a flow that is computed on a grid.
    pub on_grid: bool,
}

impl<'a> InterfaceState<'a> {
    /// Creates a state of a droplet with the flow at its markers.
    pub(crate) fn new(droplet: &'a ActiveDroplet, view: &FluidView, flow: &BodyFlow<'a>) -> Self {
        let outside = view.viscosity;
        Self {
            markers: droplet.markers(),
            forces: flow.forces,
            velocities: flow.velocities,
            imposed: flow.imposed,
            numbers: droplet.particle_numbers(),
            inside: droplet.number_inside().zip(droplet.exchange_flux()),
            membrane: MembraneMeasures::of(&droplet.interface),
            enclosed: flow.enclosed(),
            viscosities: [droplet.viscosity_inside().unwrap_or(outside), outside],
            axisymmetric: droplet.is_axisymmetric(),
            on_grid: view.spacing.is_some(),
        }
    }

    /// Creates the present state of a droplet of a scene, for [`observe`].
    ///
    /// # Errors
    /// Returns an error for a handle of another scene; [`SceneError::Refused`] if the flow of the present state is not
    /// known.
    pub fn of<H: Hydrodynamics>(system: &'a System<H>, droplet: Handle<ActiveDroplet>) -> Result<Self, SceneError> {
        let view = system.fluid_around(droplet)?;
        Ok(Self::new(system.body(droplet)?, &view, &system.flow_at(droplet)?))
    }
}

/// Number of recorded modes of shape and concentration.
const MODES: usize = 6;
/// Speed of a droplet at rest over the largest speed on its interface: what the default tolerance of iterations leaves.
const REST: f64 = 1e-6;
/// As [`REST`] on a grid: a droplet that lies between grid points is not symmetric to them.
const REST_ON_GRID: f64 = 1e-4;
/// Speed of a droplet at rest over the speed of an interface with its forces: round-off.
const ROUND_OFF: f64 = 1e-11;
/// As [`ROUND_OFF`] on a grid, to whose points a round interface of constant tension moves. Measured at spacings of 0.1
/// and 0.2 radii at most 2.4e-8 and 5.7e-7 of that speed, without and with correction, by both solvers.
const NOISE_OF_GRID: f64 = 1e-6;
/// Deformation below which a grid makes it: the deformation of a round interface of constant tension grows to 5e-7 by
/// t = 1.3.
const ROUND_ON_GRID: f64 = 2e-6;

impl InterfaceState<'_> {
    /// Returns the speed up to which the droplet is at rest relative to the imposed flow (length per time), so that the
    /// direction of its motion is round-off.
    ///
    /// This is a millionth of the largest speed on its interface, relative to the imposed flow at its centroid, on a
    /// grid 1e-4 of it, or 1e-11 of the speed that its forces can cause, on a grid 1e-6 of that, whichever is larger.
    ///
    /// # Errors
    /// Returns an error if the markers enclose no area or are not finite.
    pub fn rest_speed(&self) -> Result<f64, InterfaceError> {
        let area = polygon_moments(self.markers)?;
        let drift = self.imposed.velocity_at(area.centroid);
        let fastest = self.velocities.iter().map(|velocity| (velocity - drift).length()).fold(0.0, f64::max);
        let forces: f64 = self.forces.iter().map(|force| force.length()).sum();
        // Forces are those per length in the plane.
        let size = if self.axisymmetric { (area.area.abs() / PI).sqrt() } else { 1.0 };
        let [rest, noise] = if self.on_grid { [REST_ON_GRID, NOISE_OF_GRID] } else { [REST, ROUND_OFF] };
        Ok((rest * fastest).max(noise * forces / (size * (self.viscosities[0] + self.viscosities[1]))))
    }

    /// Returns the force moments about the origin of `frame`, which must be the centroid, in the axes of `frame`, of
    /// the droplet with the bodies inside it. Velocities are relative to the imposed flow at the centroid.
    ///
    /// # Errors
    /// Returns an error if lists differ in length or a value is not finite.
    pub fn moments(&self, convention: Convention, frame: &Frame) -> Result<ForceMoments, InterfaceError> {
        let drift = self.imposed.velocity_at(frame.centre());
        let velocities = self.relative_to(drift);
        let Self { markers, forces, viscosities, .. } = *self;
        let mut moments = force_moments(markers, forces, &velocities, viscosities, convention, frame)?;
        for body in &self.enclosed {
            moments.add_body(body, drift, convention, frame)?;
        }
        Ok(moments)
    }

    /// Returns the velocities relative to a velocity (length per time).
    fn relative_to(&self, drift: Vec2) -> Vec<Vec2> {
        self.velocities.iter().map(|velocity| velocity - drift).collect()
    }
}

/// All observables of a droplet at one time.
///
/// Its motion is measured relative to the imposed flow at its centroid. Shapes and stresslets in laboratory axes do not
/// depend on the motion. Directions refer to the axes along the motion, or to x and y for a droplet at rest
/// ([`InterfaceState::rest_speed`]).
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
#[doc(alias("swimming speed", "deformation", "stresslet"))]
pub struct Observables {
    /// Centroid of the area (length), not wrapped into the periods of the region: a droplet that swims through a box of
    /// length L has moved by L, and differences of centroids are displacements.
    pub centroid: Vec2,
    /// Velocity of the centroid (length per time), from the flux of area.
    pub velocity: Vec2,
    /// Velocity of the centroid relative to the imposed flow there (length per time).
    pub relative_velocity: Vec2,
    /// True if the droplet moves relative to the imposed flow, and not by round-off alone.
    pub moves: bool,
    /// Area (length squared), in three dimensions the volume (length cubed).
    pub area: f64,
    /// Perimeter (length).
    pub perimeter: f64,
    /// Number of particles on the interface.
    pub particle_number: f64,
    /// Number of particles inside, and rate of binding less unbinding (1/time); `None` without exchange.
    pub inside: Option<(f64, f64)>,
    /// Reduced area and mean tension of a membrane; `None` for other droplets.
    pub membrane: Option<MembraneMeasures>,
    /// Largest and smallest concentration (particles per length); `None` without particles.
    pub concentration_range: Option<[f64; 2]>,
    /// The ellipse with the moments of the area: deformation and inclination of the droplet, in laboratory axes. On a
    /// grid it has no angle if the deformation is below 2e-6, which the grid makes of a circle.
    pub shape: MomentEllipse,
    /// Aspect ratio from area moments, along the motion over across it; along x over along y at rest.
    pub aspect_ratio_moments: f64,
    /// The fitted ellipse; `None` for shapes that are too far from one.
    pub ellipse: Option<EllipseFit>,
    /// The active region; `None` for a uniform concentration.
    pub active_region: Option<ActiveRegion>,
    /// Signed curvature of the active region (1/length); `None` without a region, or for one too short to have any.
    pub active_curvature: Option<f64>,
    /// Force moments in axes along the motion.
    pub moments: ForceMoments,
    /// The stresslet of the moments in the axes x and y (force times length).
    pub stresslet_in_laboratory: [[f64; 2]; 2],
    /// Convention of the force moments.
    pub convention: Convention,
    /// Squirmer coefficients in the frame of the droplet.
    pub squirmer: SquirmerFit,
    /// Squirmer coefficients in the laboratory frame, or in the frame of the imposed flow at the centroid.
    pub squirmer_laboratory: SquirmerFit,
    /// Modes of r(theta) (length) about the centroid, theta from the direction of motion.
    pub shape_modes: FourierModes,
    /// Modes of the concentration (particles per length); zero without particles.
    pub concentration_modes: FourierModes,
}

/// Returns all observables of a droplet, in axes along its velocity relative to the imposed flow. A droplet at rest
/// ([`InterfaceState::rest_speed`]) has no direction, so its axes are x and y.
///
/// # Errors
/// Returns an error for lists of different length, fewer than eight markers, values that are not finite, markers that
/// coincide or enclose no area.
pub fn observe(state: &InterfaceState<'_>, convention: Convention) -> Result<Observables, InterfaceError> {
    let InterfaceState { markers, numbers, inside, axisymmetric, .. } = *state;
    at_least("markers", markers.len(), 8)?;
    same_length("velocities", markers.len(), state.velocities.len())?;
    all_points_finite("the velocities", state.velocities)?;
    let area = polygon_moments(markers)?;
    let (drift, rest) = (state.imposed.velocity_at(area.centroid), state.rest_speed()?);
    let velocities = &state.relative_to(drift)[..];
    let velocity = raw_centroid_velocity(markers, velocities, &area);
    let frame = Frame::of_motion(area.centroid, velocity, rest)?;

    let polar = PolarMarkers::new(markers, &frame);
    let mut shape = MomentEllipse::of(markers)?;
    if state.on_grid && shape.deformation() < ROUND_ON_GRID {
        shape.angle = None;
    }
    let moments = state.moments(convention, &frame)?;
    let surface = axisymmetric.then(|| revolution::surface(markers)).transpose()?;
    // In three dimensions the numbers that segments would have in the plane at the same concentrations.
    let in_plane: Option<Vec<f64>> = surface.as_ref().map(|surface| {
        let sizes = edges(markers).map(|(a, b)| (b - a).length()).zip(&surface.rings.areas);
        numbers.iter().zip(sizes).map(|(number, (length, area))| number * length / area).collect()
    });
    let numbers = in_plane.as_deref().unwrap_or(numbers);
    let mut record = Observables {
        centroid: area.centroid,
        velocity: velocity + drift,
        relative_velocity: velocity,
        moves: velocity.length() > rest,
        area: area.area,
        perimeter: raw_perimeter(markers),
        particle_number: 0.0,
        inside,
        membrane: state.membrane,
        concentration_range: None,
        shape,
        aspect_ratio_moments: aspect_ratio_of(&area, &frame)?,
        ellipse: raw_ellipse(markers, &area, &frame).ok(),
        active_region: None,
        active_curvature: None,
        stresslet_in_laboratory: moments.stresslet_in_laboratory(&frame),
        moments,
        convention,
        squirmer: raw_squirmer(&polar, velocities, velocity, &frame).beyond(rest),
        squirmer_laboratory: raw_squirmer(&polar, velocities, Vec2::ZERO, &frame).beyond(rest),
        shape_modes: raw_shape_modes(&polar, MODES),
        concentration_modes: FourierModes { mean: 0.0, cosines: vec![0.0; MODES], sines: vec![0.0; MODES] },
    };
    if !numbers.is_empty() {
        same_length("numbers", markers.len(), numbers.len())?;
        all_finite("the particle numbers", numbers)?;
        let lengths: Vec<f64> = edges(markers).map(|(a, b)| (b - a).length()).collect();
        if let Some(index) = lengths.iter().position(|length| *length == 0.0) {
            return Err(InterfaceError::coincident_points(index));
        }
        record.concentration_modes = raw_concentration_modes(&polar, numbers, &lengths, MODES);
        record.particle_number = numbers.iter().sum();
        let range = [f64::NEG_INFINITY, f64::INFINITY];
        record.concentration_range = Some(
            numbers.iter().zip(&lengths).map(|(n, l)| n / l).fold(range, |[max, min], c| [c.max(max), c.min(min)]),
        );
        record.active_region = active_region(&lengths, numbers)?;
        record.active_curvature = record.active_region.and_then(|region| active_curvature(markers, &region).ok());
    }
    if let Some(surface) = &surface {
        revolution::observe_in_space(state, surface, rest, &mut record)?;
    }
    Ok(record)
}

impl Observables {
    /// Returns the speed of the centroid relative to the imposed flow there (length per time).
    #[must_use]
    pub fn speed(&self) -> f64 {
        self.relative_velocity.length()
    }

    /// Returns the direction of motion relative to the imposed flow (radians from x, from -pi to pi); `None` at rest.
    #[must_use]
    pub fn heading(&self) -> Option<f64> {
        self.moves.then(|| self.relative_velocity.to_angle())
    }

    /// Returns the axes about the centroid, the first one along the motion; x and y at rest.
    #[must_use]
    pub fn frame(&self) -> Frame {
        Frame::along(self.centroid, self.moves.then_some(self.relative_velocity))
    }

    /// Returns the names and values of all entries, in the order of the columns of a table. Values that do not exist,
    /// such as the active fraction of a uniform concentration, are `None`.
    ///
    /// The state sets the units of length, time and force. `velocity_x` and `velocity_y` belong to the whole motion;
    /// `speed` and `heading_degrees` are relative to the imposed flow at the centroid. `deformation` is D = (L -
    /// B)/(L + B) of the ellipse with the moments of the area and `inclination_degrees` the angle of its long axis from
    /// x. `stresslet_xx` and `stresslet_xy` are in axes along the motion, and with `_laboratory` along x and y. `s_ijk`
    /// and `n_ijk` are the symmetric and the mixed part of the quadrupole `f_ijk`, `b1`, `b2`, `beta` the squirmer
    /// coefficients in the droplet's frame, `shape_mode_k` and `concentration_mode_k` the amplitudes of mode k over the
    /// mean. Membranes alone have `reduced_area` and `mean_tension`.
    #[must_use]
    pub fn entries(&self) -> Vec<(&'static str, Option<f64>)> {
        let stresslet = self.moments.stresslet();
        let [maximum, minimum] = [0, 1].map(|i| self.concentration_range.map(|range| range[i]));
        let region = self.active_region;
        let known = Some;
        let beta = |fit: &SquirmerFit| self.moves.then(|| fit.beta()).flatten();
        let mut entries = vec![
            ("x", known(self.centroid.x)),
            ("y", known(self.centroid.y)),
            ("velocity_x", known(self.velocity.x)),
            ("velocity_y", known(self.velocity.y)),
            ("speed", known(self.speed())),
            ("heading_degrees", self.heading().map(f64::to_degrees)),
            ("area", known(self.area)),
            ("perimeter", known(self.perimeter)),
            ("particle_number", known(self.particle_number)),
            ("concentration_max", maximum),
            ("concentration_min", minimum),
            ("deformation", known(self.shape.deformation())),
            ("inclination_degrees", self.shape.angle.map(f64::to_degrees)),
            ("aspect_ratio_moments", known(self.aspect_ratio_moments)),
            ("aspect_ratio_ellipse", self.ellipse.map(|ellipse| ellipse.aspect_ratio())),
            ("active_length", region.map(|region| region.length)),
            ("active_fraction", region.map(|region| region.fraction)),
            ("active_curvature", self.active_curvature),
            ("b1", known(self.squirmer.b1)),
            ("b2", known(self.squirmer.b2)),
            ("beta", beta(&self.squirmer)),
            ("b1_laboratory", known(self.squirmer_laboratory.b1)),
            ("b2_laboratory", known(self.squirmer_laboratory.b2)),
            ("beta_laboratory", beta(&self.squirmer_laboratory)),
        ];
        let moments = &self.moments;
        let mut list = |names: &[&'static str], values: &[f64]| {
            entries.extend(names.iter().copied().zip(values.iter().copied().map(Some)));
        };
        list(&["force_x", "force_y"], &moments.force);
        list(&["f_xx", "f_xy", "f_yx", "f_yy"], moments.dipole.as_flattened());
        list(&["stresslet_xx", "stresslet_xy"], &stresslet[0]);
        list(&["stresslet_xx_laboratory", "stresslet_xy_laboratory"], &self.stresslet_in_laboratory[0]);
        let [all, symmetric, mixed] = [moments.quadrupole, moments.symmetric_quadrupole(), moments.mixed_quadrupole()];
        for (quadrupole, name, [i, j, k]) in [
            (all, "f_xxx", [0, 0, 0]),
            (all, "f_xyy", [0, 1, 1]),
            (all, "f_yxy", [1, 0, 1]),
            (all, "f_yyx", [1, 1, 0]),
            (symmetric, "s_xxx", [0, 0, 0]),
            (symmetric, "s_xxy", [0, 0, 1]),
            (symmetric, "s_xyy", [0, 1, 1]),
            (symmetric, "s_yyy", [1, 1, 1]),
            (mixed, "n_xyy", [0, 1, 1]),
            (mixed, "n_yxy", [1, 0, 1]),
            (mixed, "n_yyx", [1, 1, 0]),
        ] {
            entries.push((name, quadrupole.map(|entries| entries[i][j][k])));
        }
        let relative = |modes: &FourierModes, k: usize| (modes.mean != 0.0).then(|| modes.amplitude(k) / modes.mean);
        if let Some((number, flux)) = self.inside {
            entries.extend([("number_inside", known(number)), ("exchange_flux", known(flux))]);
        }
        if let Some(membrane) = self.membrane {
            let MembraneMeasures { reduced_area, mean_tension } = membrane;
            entries.extend([("reduced_area", known(reduced_area)), ("mean_tension", known(mean_tension))]);
        }
        entries.extend((2..).zip(SHAPE_MODES).map(|(k, name)| (name, relative(&self.shape_modes, k))));
        entries.extend((1..).zip(CONCENTRATION_MODES).map(|(k, name)| (name, relative(&self.concentration_modes, k))));
        entries
    }

    /// Returns the value of the entry `name`; `None` for unknown names and values that do not exist.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<f64> {
        self.entries().into_iter().find(|entry| entry.0 == name).and_then(|entry| entry.1)
    }
}

/// Names of the modes that are entries; of the shape from k = 2 on, of the concentration from k = 1 on.
const SHAPE_MODES: [&str; 5] = ["shape_mode_2", "shape_mode_3", "shape_mode_4", "shape_mode_5", "shape_mode_6"];
const CONCENTRATION_MODES: [&str; 6] = [
    "concentration_mode_1",
    "concentration_mode_2",
    "concentration_mode_3",
    "concentration_mode_4",
    "concentration_mode_5",
    "concentration_mode_6",
];

#[cfg(test)]
mod tests;
