//! Making of an interface, and what can be read of it.

use std::sync::Arc;

use motile_base::{
    InputError, Membrane, Vec2, finite,
    internal::{all_finite, all_points_finite},
    not_negative,
    polygon::CrossingFinder,
    positive, same_length,
};

use super::{
    Account, ActiveInterface, Bending, BodyForce, Derived, Law, Motion, Resistance, Scheme, Shape, ShortWaveFilter,
    SpectralCurve, State,
};
use crate::{
    Cortex, Flux, InterfaceError, Tension,
    concentration::{Repair, Transport},
    curve::check_period,
    field::{Felt, Fields},
    noise::{Fluctuations, Noise},
};

impl Account {
    /// Default bounds. An area that is off by 5 % puts speeds off by a few percent. Transport keeps the number of
    /// particles to round-off, about 1e-16 per step.
    const BOUNDS: [f64; 2] = [0.05, 1e-8];
}

impl ActiveInterface {
    /// Creates an interface that is periodic along x, from the markers of one period (equally spaced), the advance
    /// along x to the next image of the first marker (length; plus or minus the period of the region), the particle
    /// numbers of the segments that follow the markers, the tension law and the particles' diffusion constant along the
    /// interface (length squared per time). Its inside is to the left: above it where the advance is positive.
    ///
    /// ```
    /// use active_interface::{ActiveInterface, ContractileTension, wave};
    ///
    /// // one wave of height 0.1 in a period of 6, with 100 particles a length
    /// let markers = wave(0.0, 6.0, &[0.1], &[], 128)?;
    /// let law = ContractileTension::new(10.0, -1.0, active_interface::ExcludedVolume::None, 1.0)?;
    /// let interface = ActiveInterface::periodic(&markers, 6.0, vec![100.0 * 6.0 / 128.0; 128], law, 0.1)?;
    /// let length: f64 = interface.element_lengths().iter().sum();
    /// println!("{length:.4}"); // longer than the period by (k a)^2/4 of it, k a = 0.1047
    /// assert!((length / 6.0 - 1.0 - 0.00274).abs() < 1e-5);
    /// # Ok::<(), active_interface::InterfaceError>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error for:
    /// * an advance that is zero or not finite,
    /// * fewer than eight markers, lists of different length, positions that are not finite, coincide, are spaced by
    ///   more than a factor of four unevenly, do not close across the period, or whose curve crosses itself or its
    ///   image,
    /// * negative or non-finite numbers, a negative diffusion constant.
    pub fn periodic(
        markers: &[Vec2],
        advance: f64,
        numbers: Vec<f64>,
        tension: impl Tension + 'static,
        diffusion: f64,
    ) -> Result<Self, InterfaceError> {
        check_period(markers, advance)?;
        Self::build(markers.to_vec(), advance, numbers, Arc::new(tension), Some(diffusion))
    }

    /// Creates an interface that is periodic along x ([`ActiveInterface::periodic`]) without particles, of constant
    /// tension (force).
    ///
    /// # Errors
    /// Returns the errors of [`ActiveInterface::periodic`], and a tension that is negative or not finite.
    pub fn periodic_passive(markers: &[Vec2], advance: f64, tension: f64) -> Result<Self, InterfaceError> {
        check_period(markers, advance)?;
        let tension = Arc::new(crate::ConstantTension::new(tension)?);
        Self::build(markers.to_vec(), advance, Vec::new(), tension, None)
    }

    /// Creates the interface through checked markers, closed where it does not advance; without particles if there is
    /// no diffusion constant of theirs.
    ///
    /// # Errors
    /// Returns an error for lists of different length, negative or non-finite numbers, a negative diffusion constant.
    pub(crate) fn build(
        markers: Vec<Vec2>,
        advance: f64,
        numbers: Vec<f64>,
        tension: Arc<dyn Tension>,
        diffusion: Option<f64>,
    ) -> Result<Self, InterfaceError> {
        let count = markers.len();
        if let Some(diffusion) = diffusion {
            same_length("particle numbers", count, numbers.len())?;
            all_finite("the particle numbers", &numbers)?;
            for &number in &numbers {
                not_negative("a particle number", number)?;
            }
            not_negative("the diffusion constant", diffusion)?;
        }
        let scheme = Scheme {
            transport: diffusion.map(|_| Transport::new(count, Flux::Weno5)),
            stabiliser: Vec::new(),
            diffusivities: Vec::new(),
            other: Shape { advance, ..Shape::default() },
            filter: ShortWaveFilter::default(),
            band: None,
            spectral: None,
            resistance: None,
        };
        let law = Law {
            tension,
            diffusion: diffusion.unwrap_or(0.0),
            motion: Motion::default(),
            stabilised: true,
            viscosity_inside: None,
            keeps_area: false,
            elasticity: None,
            bending: None,
            cortex: Cortex::default(),
            friction: 0.0,
            wall_film: 0.0,
            body_force: None,
        };
        let account = Account {
            spacing: 0.0,
            markers: count,
            area: 0.0,
            number: numbers.iter().sum(),
            length: 0.0,
            bounds: Account::BOUNDS,
            kept: Default::default(),
            last: Default::default(),
        };
        let mut interface = Self {
            name: if advance == 0.0 { "droplet" } else { "interface" }.to_owned(),
            law,
            state: State { shape: Shape { markers, advance, ..Shape::default() }, numbers },
            derived: Derived { slip: vec![0.0; count], ..Derived::default() },
            account,
            scheme,
            crossing: CrossingFinder::default(),
            felt: None,
            noise: None,
        };
        interface.update();
        interface.account.spacing = interface.geometry().mean_length();
        interface.account.area = interface.area();
        interface.account.length = interface.geometry().total_weight();
        Ok(interface)
    }

    /// Gives the interface a name for messages.
    #[must_use]
    pub fn with_name(mut self, name: impl Into<String>) -> Self {
        self.name = name.into();
        self
    }

    /// Gives the interface another tension law from now on, in place of the one that it was made with.
    pub fn set_tension(&mut self, law: impl Tension + 'static) {
        self.law.tension = Arc::new(law);
        self.update_tensions();
    }

    /// Moves the markers in another way than [`Motion::default`].
    #[must_use]
    pub fn with_motion(mut self, motion: Motion) -> Self {
        self.law.motion = motion;
        self
    }

    /// Carries the particles by another flux than [`Flux::Weno5`].
    #[must_use]
    pub fn with_flux(mut self, flux: Flux) -> Self {
        self.scheme.transport = self.scheme.transport.take().map(|transport| Transport::new(transport.len(), flux));
        self
    }

    /// Restores the initial area after each step, by an equal normal displacement of all markers (off by default: the
    /// motion keeps the area up to the error of the time step).
    #[must_use]
    pub fn with_area_constraint(mut self, on: bool) -> Self {
        self.law.keeps_area = on;
        self
    }

    /// Turns an interface that is periodic along x into an elastic membrane, at rest in its present shape, with the
    /// moduli of stretching E_s (force) and bending B (force times length squared). Its energy is `INT E_s/2 (lambda -
    /// 1)^2 + B/2 (kappa - kappa0)^2 dS` over its reference length, lambda the stretch and kappa the curvature, and its
    /// forces, in addition to the tension, are minus the gradient of this energy by the markers. Its points are the
    /// markers, which move with the fluid ([`Motion::WithFluid`]), and carry the particles along.
    ///
    /// On a flat membrane between two fluids, a wave of the displacement along it decays at the rate `E_s k/(2 (eta_1 +
    /// eta_2))`, one of the height at `(gamma k + B k^3)/(2 (eta_1 + eta_2))`.
    ///
    /// # Errors
    /// Returns an error for a closed interface, moduli that are negative or not finite.
    pub fn with_elasticity(mut self, stretching: f64, bending: f64) -> Result<Self, InterfaceError> {
        if self.advance() == 0.0 {
            return Err(InterfaceError::closed_membrane());
        }
        self.law.motion = Motion::WithFluid;
        let advance = Vec2::new(self.advance(), 0.0);
        self.law.elasticity = Some(Membrane::new([stretching, bending], self.markers(), advance)?);
        Ok(self)
    }

    /// Returns the elastic energy of the shape whose forces were last written (force times length); zero without
    /// elasticity.
    #[must_use]
    pub fn elastic_energy(&self) -> f64 {
        self.law.elasticity.as_ref().map_or(0.0, Membrane::energy)
    }

    /// Bounds the relative changes of the area and of the number of particles since the start, beyond which a step is
    /// an error (5e-2 and 1e-8 by default; infinity for none).
    ///
    /// # Errors
    /// Returns an error for a bound that is negative or not a number.
    pub fn with_bounds(mut self, area: f64, particles: f64) -> Result<Self, InterfaceError> {
        for (name, value) in [("the bound on the area", area), ("the bound on the particles", particles)] {
            if value.is_nan() || value < 0.0 {
                return Err(InputError::Negative { name, value }.into());
            }
        }
        self.account.bounds = [area, particles];
        Ok(self)
    }

    /// Makes the interface one of a body of revolution about the x axis in three dimensions, of which the markers,
    /// whose first one is on the axis, are the meridian with its mirror image. Concentrations stay and become numbers
    /// per area, and tensions are per length. The area becomes the volume, which is restored after each step: the
    /// truncation of the motion to the modes of the flow does not keep it.
    ///
    /// # Errors
    /// Returns an error for an odd number of markers, markers that are not the mirror image of one another, particle
    /// numbers that differ from the mirror image, markers that move with the fluid.
    pub fn axisymmetric(mut self) -> Result<Self, InterfaceError> {
        let (markers, count) = (self.markers(), self.markers().len());
        let differs = |k: &usize| {
            let image = markers[(count - k) % count];
            markers[*k].distance(Vec2::new(image.x, -image.y)) > 1e-9 * self.geometry().perimeter
        };
        let wrong = (0..count).find(|k| differs(k) || (!count.is_multiple_of(2) && 2 * k + 1 == count));
        if let Some(marker) = wrong.map(|k| markers[k]) {
            return Err(InterfaceError::not_axisymmetric(marker));
        }
        if self.law.motion == Motion::WithFluid {
            return Err(InterfaceError::moving_meridian());
        }
        let numbers = &self.state.numbers;
        let most = numbers.iter().copied().fold(0.0, f64::max);
        for (segment, (&number, &image)) in numbers.iter().zip(numbers.iter().rev()).enumerate() {
            if (number - image).abs() > 1e-9 * most {
                return Err(InterfaceError::particles_not_axisymmetric(segment, number, image));
            }
        }
        // The meridian runs from the largest x, also of a droplet that swims backwards.
        if markers[0].x < markers[count / 2].x {
            self.state.shape.markers.rotate_left(count / 2);
            let carried = self.state.numbers.len();
            self.state.numbers.rotate_left(carried / 2);
        }
        // Those over the polygon, which the numbers are given for.
        self.update();
        let concentrations = self.derived.concentrations.clone();
        self.scheme.spectral = Some(SpectralCurve::new(count)?);
        (self.state.shape.axisymmetric, self.scheme.other.axisymmetric) = (true, true);
        self.scheme.resistance = Resistance::of(&self.law, self.has_friction(), self.markers().len(), true)?;
        self.law.keeps_area = true;
        self.update();
        let areas = &self.state.shape.geometry.rings.areas;
        for ((number, area), concentration) in self.state.numbers.iter_mut().zip(areas).zip(concentrations) {
            *number = concentration * area;
        }
        self.update();
        (self.account.area, self.account.number) = (self.area(), self.number());
        Ok(self)
    }

    /// Returns true for a body of revolution in three dimensions.
    #[must_use]
    pub fn is_axisymmetric(&self) -> bool {
        self.state.shape.axisymmetric
    }

    /// Returns the sizes of the elements; a particle number over its size is a concentration. They are lengths
    /// (length), or half of the areas of rings (length squared) if the interface is axisymmetric.
    #[must_use]
    pub fn element_sizes(&self) -> &[f64] {
        self.state.shape.geometry.cells().sizes
    }

    /// Switches the stabiliser (on by default), which makes the fast relaxation of crowded particles implicit: a
    /// diffusivity `h c max(-d gamma/dc, 0) / (4 eta)` is added implicitly and subtracted explicitly.
    #[must_use]
    pub fn with_stabiliser(mut self, on: bool) -> Self {
        self.law.stabilised = on;
        self
    }

    /// Gives the fluid inside another viscosity (stress times time) than the fluid outside.
    ///
    /// # Errors
    /// Returns an error for a viscosity that is not positive and finite.
    pub fn with_viscosity_inside(mut self, viscosity: f64) -> Result<Self, InterfaceError> {
        self.law.viscosity_inside = Some(positive("the viscosity inside", viscosity)?);
        Ok(self)
    }

    /// Makes the interface feel fields that are fixed in the laboratory, in place of those that it felt. Those of the
    /// tension and of the activity are added at the middles of the elements. Those of binding and unbinding need a
    /// droplet with a well-mixed inside ([`crate::ActiveDroplet::with_fields`]). Call this after
    /// [`ActiveInterface::axisymmetric`] and [`ActiveInterface::with_motion`].
    ///
    /// # Errors
    /// Returns an error for:
    /// * a field of the activity without particles, fields of binding or unbinding,
    /// * a field that is not periodic along an interface that is,
    /// * a field that is not symmetric about the axis of a body of revolution.
    pub fn with_fields(self, fields: Fields) -> Result<Self, InterfaceError> {
        if let Some((name, _)) = fields.named().find(|(name, _)| ["binding", "unbinding"].contains(name)) {
            return Err(InterfaceError::no_exchange(name));
        }
        self.with_all_fields(fields)
    }

    pub(crate) fn with_all_fields(mut self, fields: Fields) -> Result<Self, InterfaceError> {
        if fields.activity.is_some() && !self.carries() {
            return Err(InterfaceError::no_particles_to_feel());
        }
        let size = self.geometry().perimeter / std::f64::consts::TAU;
        for (name, field) in fields.named() {
            if self.advance() != 0.0 {
                field.check_along(self.markers(), self.advance())?;
            }
            if self.is_axisymmetric() && !field.is_symmetric(size) {
                return Err(InterfaceError::field_not_axisymmetric(name));
            }
        }
        if fields.friction.is_some() && self.is_axisymmetric() {
            return Err(InterfaceError::resisting_revolution());
        }
        self.felt = (!fields.is_none()).then(|| Box::new(Felt::new(fields)));
        self.make_resistance()?;
        Ok(self)
    }

    /// Adds noise to the particles. Call this after [`ActiveInterface::axisymmetric`].
    ///
    /// # Errors
    /// Returns an error for an interface without particles, or whose particles do not diffuse.
    pub fn with_noise(mut self, noise: Noise) -> Result<Self, InterfaceError> {
        if !self.carries() {
            return Err(InterfaceError::nothing_to_shake());
        }
        let size = self.geometry().perimeter / std::f64::consts::TAU;
        self.noise = Some(Box::new(Fluctuations::new(noise, size, self.law.diffusion)?));
        Ok(self)
    }

    /// Returns the fields that the interface feels, if there are any.
    #[must_use]
    pub fn fields(&self) -> Option<&Fields> {
        self.felt.as_ref().map(|felt| &felt.fields)
    }

    /// Returns the noise on the particles, if there is any.
    #[must_use]
    pub fn noise(&self) -> Option<Noise> {
        self.noise.as_ref().map(|noise| noise.noise)
    }

    /// Makes the interface resist bending, with the energy `B/2 INT (kappa - kappa0)^2 ds` over its present length
    /// (Helfrich, "Elastic properties of lipid bilayers: theory and possible experiments"), kappa its curvature
    /// (1/length; positive for a circle). The forces are minus the gradient of this energy by the markers, with the
    /// derivatives of the Fourier series through them. On a circle of radius R, a mode k then relaxes as if the tension
    /// were larger by `B (k^2 - 3/2)/R^2 + B kappa0^2/2`.
    ///
    /// # Errors
    /// Returns an error for a modulus B (force times length squared) that is negative or not finite, a reference
    /// curvature kappa0 (1/length) that is not finite.
    pub fn with_bending(mut self, modulus: f64, reference_curvature: f64) -> Result<Self, InterfaceError> {
        not_negative("the bending modulus", modulus)?;
        finite("the reference curvature", reference_curvature)?;
        self.law.bending = match modulus {
            0.0 => None,
            _ => Some(Bending::new(modulus, reference_curvature, self.markers().len())?),
        };
        Ok(self)
    }

    /// Gives the interface a cortex of this viscosity eta_s (force times time), which resists stretching along it:
    /// [`Cortex`]. Speeds of swimmers fall, and steps stay as long as they are. An interface whose viscosity depends on
    /// its particles takes [`ActiveInterface::with_cortex`].
    ///
    /// # Errors
    /// Returns an error for a viscosity that is negative or not finite.
    pub fn with_cortex_viscosity(self, viscosity: f64) -> Result<Self, InterfaceError> {
        self.with_cortex(Cortex::new(viscosity))
    }

    /// Gives the interface a cortex. Call this after [`ActiveInterface::axisymmetric`].
    ///
    /// # Errors
    /// Returns an error for a viscosity that is negative or not finite; a shear viscosity of a line.
    pub fn with_cortex(mut self, cortex: Cortex) -> Result<Self, InterfaceError> {
        cortex.check()?;
        if cortex.shear_viscosity > 0.0 && !self.state.shape.axisymmetric {
            return Err(InterfaceError::sheared_line());
        }
        if cortex.inextensible && self.state.shape.axisymmetric {
            return Err(InterfaceError::unresolved_membrane());
        }
        if cortex.inextensible && self.advance() == 0.0 && self.geometry().is_round() {
            return Err(InterfaceError::round_membrane());
        }
        self.law.cortex = cortex;
        self.make_resistance()?;
        Ok(self)
    }

    /// Gives the interface friction with a substrate: a force `-xi v` per length on the fluid at the interface, v its
    /// velocity.
    ///
    /// In the unbounded plane nothing takes up the force of a substrate, because the flow of a force does not decay
    /// there. The substrate then floats: v is relative to its uniform velocity, at which all friction of the scene adds
    /// up to zero. Around a circle this velocity is zero.
    ///
    /// # Errors
    /// Returns an error for a coefficient xi (force times time per length squared) that is negative or not finite; a
    /// body of revolution.
    pub fn with_friction(mut self, coefficient: f64) -> Result<Self, InterfaceError> {
        if self.state.shape.axisymmetric && coefficient > 0.0 {
            return Err(InterfaceError::resisting_revolution());
        }
        self.law.friction = not_negative("the friction with the substrate", coefficient)?;
        self.make_resistance()?;
        Ok(self)
    }

    /// Gives the interface friction with the straight walls of a channel, through a film of this viscosity (stress
    /// times time) whose thickness is the distance d to each wall. The force is `-viscosity v/d` per length, for the
    /// part of the velocity v along the interface. The part across is not resisted, because the flow in the gap does
    /// that.
    ///
    /// Use it for what lies in the gap and is thinner than the flow resolves, such as adhesion molecules. The walls
    /// have to be at rest.
    ///
    /// # Errors
    /// Returns an error for a viscosity that is negative or not finite; a body of revolution.
    pub fn with_wall_friction(mut self, viscosity: f64) -> Result<Self, InterfaceError> {
        if self.state.shape.axisymmetric && viscosity > 0.0 {
            return Err(InterfaceError::resisting_revolution());
        }
        self.law.wall_film = not_negative("the viscosity of the film at walls", viscosity)?;
        self.make_resistance()?;
        Ok(self)
    }

    /// Makes the stresses that cortex and friction have.
    fn make_resistance(&mut self) -> Result<(), InterfaceError> {
        let friction = self.has_friction();
        self.scheme.resistance =
            Resistance::of(&self.law, friction, self.markers().len(), self.state.shape.axisymmetric)?;
        self.update_tensions();
        Ok(())
    }

    /// Returns true with friction of any kind.
    pub(super) fn has_friction(&self) -> bool {
        let graded = self.felt.as_ref().is_some_and(|felt| felt.fields.friction.is_some());
        self.law.friction > 0.0 || self.law.wall_film > 0.0 || graded
    }

    /// Makes a force act on the fluid inside, uniform over its area: its weight less the weight of as much fluid around
    /// it, `(rho_in - rho_ext) g` (force per area, in three dimensions per volume). For an interface inside another
    /// one, this is the difference to the fluid between them. It adds to [`ActiveInterface::with_force`].
    ///
    /// In the plane without boundaries, nothing holds a fluid that is pushed: no speed exists there unless the forces
    /// on all bodies add up to zero.
    ///
    /// # Errors
    /// Returns an error for a force that is not finite, an interface that is periodic along x, and a force across the
    /// axis of a body of revolution.
    pub fn with_body_force(mut self, force: Vec2) -> Result<Self, InterfaceError> {
        self.check_body_force("the body force", force)?;
        let total = self.law.body_force.unwrap_or_default().total;
        self.law.body_force = Some(BodyForce { density: force, total }).filter(|force| *force != BodyForce::default());
        Ok(self)
    }

    /// Makes a force of this sum (force) act on the fluid inside, uniform over its present area, in three dimensions
    /// over its volume. It adds to [`ActiveInterface::with_body_force`].
    ///
    /// # Errors
    /// Returns the errors of [`ActiveInterface::with_body_force`].
    pub fn with_force(mut self, force: Vec2) -> Result<Self, InterfaceError> {
        self.check_body_force("the force on the inside", force)?;
        let density = self.law.body_force.unwrap_or_default().density;
        self.law.body_force = Some(BodyForce { density, total: force }).filter(|force| *force != BodyForce::default());
        Ok(self)
    }

    /// Returns the force on the fluid inside per area (force per area, in three dimensions per volume) and the force
    /// that is spread over the inside (force), both zero by default.
    #[must_use]
    pub fn body_force(&self) -> [Vec2; 2] {
        let BodyForce { density, total } = self.law.body_force.unwrap_or_default();
        [density, total]
    }

    /// Refuses a force on the inside that this interface cannot have.
    fn check_body_force(&self, what: &'static str, force: Vec2) -> Result<(), InterfaceError> {
        all_points_finite(what, &[force])?;
        if force != Vec2::ZERO && self.advance() != 0.0 {
            return Err(InterfaceError::open_body_force());
        }
        if force.y != 0.0 && self.is_axisymmetric() {
            return Err(InterfaceError::force_across_axis(force.y));
        }
        Ok(())
    }

    /// Returns the energy of bending (force times length), 0 without.
    ///
    /// # Errors
    /// Returns an error for markers that were inserted or removed since the start ([`Motion::WithFluid`]), which
    /// interfaces with bending do not allow.
    pub fn bending_energy(&self) -> Result<f64, InterfaceError> {
        Ok(self.law.bending.as_ref().map_or(Ok(0.0), |bending| bending.energy(self.markers(), self.advance()))?)
    }

    /// Switches off the check that the particles on the interface are conserved. Use this if they are exchanged with
    /// another body that keeps the sum, such as one that fills the droplet.
    #[must_use]
    pub fn with_open_number(mut self) -> Self {
        self.account.bounds[1] = f64::INFINITY;
        self
    }

    /// Returns the marker positions (length), counter-clockwise, not wrapped into a periodic box.
    #[must_use]
    pub fn markers(&self) -> &[Vec2] {
        &self.state.shape.markers
    }

    /// Returns the velocities of the markers (length per time) as of the last [`motile_scene::Body::rate`]: along the
    /// normal the velocities of the fluid.
    #[must_use]
    pub fn marker_motion(&self) -> &[Vec2] {
        &self.derived.motions
    }

    /// Returns the particle numbers of the segments; segment k runs from marker k to the next. Empty for a passive
    /// interface.
    #[must_use]
    pub fn particle_numbers(&self) -> &[f64] {
        &self.state.numbers
    }

    /// Returns the concentrations on the segments (particles per length).
    #[must_use]
    pub fn concentrations(&self) -> &[f64] {
        &self.derived.concentrations
    }

    /// Returns the tensions of the segments (force) by the tension law at the present state. An interface with a cortex
    /// adds its viscous tensions of the last evaluation.
    #[must_use]
    pub fn tensions(&self) -> &[f64] {
        self.scheme.resistance.as_ref().map_or(&self.derived.tensions, |resistance| &resistance.tensions)
    }

    /// Returns the lengths of the segments (length).
    #[must_use]
    pub fn element_lengths(&self) -> &[f64] {
        &self.state.shape.geometry.lengths
    }

    /// Returns the advance along x from the first marker to its next image (length), zero for a closed interface.
    #[must_use]
    pub fn advance(&self) -> f64 {
        self.state.shape.advance
    }

    /// Returns the area of the polygon at the start (length squared), of a body of revolution its volume (length
    /// cubed); of an interface that is periodic along x the area between it and y = 0 in one period, positive where its
    /// inside is between them.
    #[must_use]
    pub fn initial_area(&self) -> f64 {
        self.account.area
    }

    /// Returns the diffusion constant of the particles (length squared per time).
    #[must_use]
    pub fn diffusion(&self) -> f64 {
        self.law.diffusion
    }

    /// Returns the cortex; one without viscosity by default.
    #[must_use]
    pub fn cortex(&self) -> Cortex {
        self.law.cortex
    }

    /// Returns the viscosity eta_s of the cortex without particles (force times time).
    #[must_use]
    pub fn cortex_viscosity(&self) -> f64 {
        self.law.cortex.viscosity
    }

    /// Returns the viscosity of the film at walls (stress times time), 0 without friction with them.
    #[must_use]
    pub fn wall_friction(&self) -> f64 {
        self.law.wall_film
    }

    /// Returns the coefficient xi of the friction with a substrate (force times time per length squared).
    #[must_use]
    pub fn friction(&self) -> f64 {
        self.law.friction
    }

    /// Returns the viscosity of the fluid inside (stress times time), `None` if it is the viscosity of the exterior
    /// fluid.
    #[must_use]
    pub fn viscosity_inside(&self) -> Option<f64> {
        self.law.viscosity_inside
    }

    /// Returns how often negative particle numbers were repaired since the start.
    #[must_use]
    pub fn repair(&self) -> Repair {
        self.account.kept.repair
    }

    /// Returns the numbers of markers inserted and removed since the start ([`Motion::WithFluid`]).
    #[must_use]
    pub fn redistributed(&self) -> (usize, usize) {
        let kept = self.account.kept;
        (kept.inserted, kept.removed)
    }
}
