//! Forces of the fluid on the walls of a channel and on the bodies in it.

use std::f64::consts::TAU;

use motile_base::{Drive, FlowSample, InputError, PeriodicSeries, Vec2, within};

use crate::{FluidView, Handle, Hydrodynamics, Markers, ObstacleLoad, SceneError, System, body::Body};

/// Points on a wall at first, and at most, when its shear stress is integrated.
pub(super) const POINTS: [usize; 2] = [64, 4096];
/// Fraction by which twice as many points may change the forces on the walls.
pub(super) const SETTLED: f64 = 1e-10;

/// Forces along a channel, over one period and per unit of depth. They obey
///
/// ```text
/// pressure_drop width = on_walls[0] + on_walls[1] + on_bodies.x + on_obstacles.x + on_plates
/// ```
///
/// The forces on the walls follow from the reciprocal theorem with the flow that one sliding wall alone drives, whose
/// velocity along x is `s(y) = (y + H_1)/(H_1 + H_2)`. The slip lengths b_1, b_2 and the half width h give H_1 = h +
/// b_1 and H_2 = h + b_2, so that
///
/// ```text
/// F_upper = pressure_drop INT s dy + INT s f_x dA - eta period s' (U_upper - U_lower)
/// ```
///
/// with all forces f on the fluid. In a fluid with the friction alpha, q^2 = alpha/eta, s solves s'' = q^2 s instead:
///
/// ```text
/// s(y) = (sinh q y + q b_1 cosh q y)/((1 + q^2 b_1 b_2) sinh q w + q (b_1 + b_2) cosh q w),  y from the lower wall
/// ```
///
/// The forces that keep a rigid body rigid, and the stress of another viscosity inside
/// an interface, count by their dipoles.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
#[doc(alias("drag", "wall force", "momentum balance"))]
pub struct ChannelForces {
    /// Period of the channel along x (length).
    pub period: f64,
    /// Distance between the walls (length).
    pub width: f64,
    /// Pressure at the left end of a period less that at its right end (stress).
    pub pressure_drop: f64,
    /// Part of the pressure drop that the bodies cause at the flux that drives the channel (stress). It is `None` if
    /// the channel is not driven by a flux.
    pub extra_pressure_drop: Option<f64>,
    /// Force of the fluid along x on the lower and on the upper wall (force).
    pub on_walls: [f64; 2],
    /// Force of the fluid on all bodies together (force).
    pub on_bodies: Vec2,
    /// Force of the fluid on all obstacles, the closed rigid walls, together (force).
    pub on_obstacles: Vec2,
    /// Force of the fluid along x on the plates that it rubs against (force); zero without friction of the fluid.
    pub on_plates: f64,
}

impl ChannelForces {
    /// Returns what the pressure drop times the width exceeds the forces by, if the walls bear these forces along x
    /// (force): an error, if they come from somewhere else, such as [`System::wall_traction`].
    #[must_use]
    pub fn imbalance(&self, [lower, upper]: [f64; 2]) -> f64 {
        self.pressure_drop * self.width - (lower + upper + self.on_bodies.x) - (self.on_obstacles.x + self.on_plates)
    }

    /// Returns the largest of the forces along x, with which an imbalance is compared (force).
    #[must_use]
    pub fn scale(&self) -> f64 {
        let all = [self.pressure_drop * self.width, self.on_walls[0], self.on_walls[1], self.on_bodies.x];
        all.into_iter().chain([self.on_obstacles.x, self.on_plates]).map(f64::abs).fold(0.0, f64::max)
    }
}

/// Straight walls of a channel: heights (length), slip lengths (length), and the period (length).
#[derive(Debug, Clone, Copy)]
struct Walls {
    heights: [f64; 2],
    slip: [f64; 2],
    period: f64,
}

impl Walls {
    /// Returns the walls of a flow whose forces on them are known.
    fn of(flow: &impl Hydrodynamics, view: &FluidView) -> Option<Self> {
        let (heights, slip, period) = (view.domain.walls?, flow.wall_slip()?, view.domain.periods[0]?);
        (!flow.axisymmetric()).then_some(Self { heights, slip, period })
    }

    fn width(&self) -> f64 {
        self.heights[1] - self.heights[0]
    }

    /// Returns one over the flux of a unit pressure gradient in fluid of unit viscosity (1/length cubed).
    fn per_flux(&self) -> f64 {
        let (w, [below, above]) = (self.width(), self.slip);
        let slope = (0.5 * w * w + above * w) / (w + below + above);
        1.0 / (slope * (0.5 * w * w + below * w) - w * w * w / 6.0)
    }
}

/// The flow `s(y)` along x that a wall drives which slides at 1, next to another one at rest, in a fluid with friction.
struct RubbingFlow {
    /// Square root of the friction over the viscosity (1/length).
    wave: f64,
    width: f64,
    /// Slip lengths of the wall at rest and of the other one (length).
    slip: [f64; 2],
}

impl RubbingFlow {
    /// Returns the two hyperbolic functions of q y and 1, times exp(-q w), and the value of both at the sliding wall.
    fn parts(&self, y: f64) -> ([f64; 3], f64) {
        let Self { wave: q, width, slip: [b, c] } = *self;
        let of = |y: f64| {
            let [up, down] = [(q * (y - width)).exp(), (-q * (y + width)).exp()];
            [0.5 * (up - down), 0.5 * (up + down)]
        };
        let ([sinh, cosh], [far_sinh, far_cosh]) = (of(y), of(width));
        let over = (1.0 + q * q * b * c) * far_sinh + q * (b + c) * far_cosh;
        ([sinh, cosh, (-q * width).exp()], over)
    }

    /// Returns s at a distance from the wall at rest (length).
    fn value(&self, y: f64) -> f64 {
        let ([sinh, cosh, _], over) = self.parts(y);
        (sinh + self.wave * self.slip[0] * cosh) / over
    }

    /// Returns the integral of s from wall to wall (length).
    fn integral(&self) -> f64 {
        let ([sinh, cosh, one], over) = self.parts(self.width);
        ((cosh - one) / self.wave + self.slip[0] * sinh) / over
    }
}

/// Returns the first moment of the forces along x on the fluid about the height `from` (force times length).
fn moment(markers: &Markers, from: f64, exterior: f64) -> Result<f64, InputError> {
    let mut sum = 0.0;
    for (number, group) in markers.groups().iter().enumerate() {
        let lists = [markers.positions(), markers.forces(), markers.velocities()];
        let [positions, forces, velocities] = lists.map(|list| &list[group.range.clone()]);
        sum += positions.iter().zip(forces).map(|(place, force)| (place.y - from) * force.x).sum::<f64>();
        sum += markers.rigid_dipole(number)[0][1];
        let [inside, outside] = group.viscosities(exterior);
        if inside != outside {
            let count = positions.len() as f64;
            let mut series = PeriodicSeries::new(positions.len())?;
            // What an open interface advances by is no periodic function.
            let advance = group.kind.advance().unwrap_or(0.0);
            let periodic: Vec<Vec2> = (positions.iter().enumerate())
                .map(|(k, place)| *place - Vec2::new(advance * k as f64 / count, 0.0))
                .collect();
            series.analyse_vectors(&periodic)?;
            series.differentiate();
            let factor = (inside - outside) * TAU / count;
            for (tangent, v) in series.values().iter().zip(velocities) {
                let normal = factor * Vec2::new(tangent.im, -(tangent.re + advance / TAU));
                sum -= v.x * normal.y + v.y * normal.x;
            }
        }
    }
    Ok(sum)
}

impl<H: Hydrodynamics> System<H> {
    /// Returns the force of the fluid on a body in the present state (force): minus the sum of the forces at its
    /// markers. For a droplet with a weight it is minus the weight, for a held body drag and lift.
    ///
    /// # Errors
    /// Returns [`SceneError::Refused`] for a handle of another scene; the errors of [`System::evaluate`].
    pub fn force_on(&mut self, handle: impl Into<Handle<dyn Body>>) -> Result<Vec2, SceneError> {
        self.evaluate()?;
        Ok(-self.flow_at(handle)?.forces.iter().sum::<Vec2>())
    }

    /// Returns the force of the fluid on all bodies together in the present state (force).
    ///
    /// # Errors
    /// Returns the errors of [`System::evaluate`].
    pub fn force_on_bodies(&mut self) -> Result<Vec2, SceneError> {
        Ok(-self.evaluate()?.forces().iter().sum::<Vec2>())
    }

    /// Returns the forces along a channel in the present state. It is `None` if there are no straight walls on which
    /// they are known: outside of channels, and behind curved rigid walls. It is also `None` in a fluid with friction
    /// if viscosities differ, and if an interface that is periodic along x separates a sliding or slipping wall from
    /// fluid of another viscosity.
    ///
    /// # Errors
    /// Returns the errors of [`System::evaluate`].
    pub fn channel_forces(&mut self) -> Result<Option<ChannelForces>, SceneError> {
        let view = self.hydrodynamics().fluid_view();
        let Some(walls) = Walls::of(self.hydrodynamics(), &view) else { return Ok(None) };
        self.evaluate()?;
        let (imposed, markers, eta) = (self.imposed(), self.markers(), view.viscosity);
        let open = |group: &crate::MarkerGroup| {
            group.kind.advance().is_some() && group.viscosities(eta).iter().any(|viscosity| *viscosity != eta)
        };
        let layered = markers.groups().iter().any(open);
        if layered && (walls.slip != [0.0; 2] || !imposed.is_none()) {
            return Ok(None);
        }
        let (friction, loads) = (self.hydrodynamics().friction(), self.hydrodynamics().obstacle_loads());
        if friction > 0.0 {
            return Ok(self.forces_with_friction(walls, friction, eta));
        }
        let Walls { heights: [below, _], slip, period } = walls;
        let (width, reach) = (walls.width(), walls.width() + slip[0] + slip[1]);
        // Zero without a sign for no gradient.
        let pressure_drop = 0.0 - self.report().mean_pressure_gradient[0] * period;
        let shear = eta * imposed.shear_rate() * period;
        let on_bodies = -markers.forces().iter().sum::<Vec2>();
        let mut upper = pressure_drop * (0.5 * width + slip[0]) * width / reach - shear
            + moment(markers, below - slip[0], eta)? / reach;
        let mut on_obstacles = Vec2::ZERO;
        for load in loads.iter().flatten() {
            on_obstacles += load.force;
            upper -= ((load.centroid.y - below + slip[0]) * load.force.x + load.shear) / reach;
        }
        let lower = pressure_drop * width - on_bodies.x - on_obstacles.x - upper;
        let extra = |drive: Drive| {
            let flux = drive.flux().filter(|_| !layered)? - width * imposed.velocity[0];
            Some(pressure_drop - eta * period * flux * walls.per_flux())
        };
        Ok(Some(ChannelForces {
            period,
            width,
            pressure_drop,
            extra_pressure_drop: self.hydrodynamics().drive().and_then(extra),
            on_walls: [lower, upper],
            on_bodies,
            on_obstacles,
            on_plates: 0.0,
        }))
    }

    /// Returns the forces of the last evaluation in a fluid with that friction and viscosity; `None` if viscosities
    /// differ.
    fn forces_with_friction(&self, walls: Walls, friction: f64, eta: f64) -> Option<ChannelForces> {
        let (markers, width, period) = (self.markers(), walls.width(), walls.period);
        let differs = |group: &crate::MarkerGroup| group.viscosities(eta).iter().any(|viscosity| *viscosity != eta);
        if markers.groups().iter().any(differs) || !self.imposed().is_none() {
            return None;
        }
        let pressure_drop = 0.0 - self.report().mean_pressure_gradient[0] * period;
        let [below, above] = walls.slip;
        let wave = (friction / eta).sqrt();
        let flows = [[above, below], [below, above]].map(|slip| RubbingFlow { wave, width, slip });
        let on_walls = [0, 1].map(|wall| {
            // From the wall at rest, which is the other one.
            let distance = |y: f64| if wall == 0 { walls.heights[1] - y } else { y - walls.heights[0] };
            let pushed = markers.positions().iter().zip(markers.forces());
            pressure_drop * flows[wall].integral()
                + pushed.map(|(place, force)| flows[wall].value(distance(place.y)) * force.x).sum::<f64>()
        });
        let on_bodies = -markers.forces().iter().sum::<Vec2>();
        let open = width - flows[0].integral() - flows[1].integral();
        let flux = self.hydrodynamics().drive().and_then(Drive::flux);
        Some(ChannelForces {
            period,
            width,
            pressure_drop,
            extra_pressure_drop: flux.map(|flux| pressure_drop - friction * period * flux / open),
            on_walls,
            on_bodies,
            on_obstacles: Vec2::ZERO,
            on_plates: pressure_drop * width - on_bodies.x - on_walls[0] - on_walls[1],
        })
    }

    /// Returns what the fluid does to each rigid wall besides the straight walls of the domain, in the present state.
    /// It is `None` for a wall that is not closed, behind which there is fluid too.
    ///
    /// # Errors
    /// Returns the errors of [`System::evaluate`].
    pub fn obstacle_loads(&mut self) -> Result<Vec<Option<ObstacleLoad>>, SceneError> {
        self.evaluate()?;
        Ok(self.hydrodynamics().obstacle_loads())
    }

    /// Returns the shear stress of the fluid on the lower and on the upper wall of a channel (stress), positive along
    /// x, at so many places `x = -period/2 + period k/count` of each, k = 0, 1, ... It is `None` where
    /// [`System::channel_forces`] is.
    ///
    /// # Errors
    /// Returns the errors of [`System::sample`]; an error for a count of 0 or above 1000000.
    pub fn wall_shear(&mut self, count: usize) -> Result<Option<[Vec<f64>; 2]>, SceneError> {
        within("the number of places on a wall", count as f64, 1.0, 1e6)?;
        self.wall_shear_at(count, 0.0)
    }

    /// Returns the shear stress as [`System::wall_shear`] does, at places that are displaced by a fraction of their
    /// distance.
    fn wall_shear_at(&mut self, count: usize, shift: f64) -> Result<Option<[Vec<f64>; 2]>, SceneError> {
        let view = self.hydrodynamics().fluid_view();
        let Some(Walls { heights, period, .. }) = Walls::of(self.hydrodynamics(), &view) else { return Ok(None) };
        self.evaluate()?;
        let viscosities = self.viscosities_at_walls(view.viscosity);
        let x = |k: usize| view.domain.origin[0] + period * (k as f64 + shift) / count as f64;
        let points: Vec<Vec2> = heights.iter().flat_map(|y| (0..count).map(move |k| Vec2::new(x(k), *y))).collect();
        let mut samples = vec![FlowSample::default(); points.len()];
        self.sample(&points, &mut samples)?;
        let (lower, upper) = samples.split_at(count);
        let stress = |samples: &[FlowSample], factor: f64| samples.iter().map(|s| factor * s.gradient[0][1]).collect();
        Ok(Some([stress(lower, viscosities[0]), stress(upper, -viscosities[1])]))
    }

    /// Returns the forces along x on the lower and the upper wall (force) as the integrals of their shear stress: an
    /// independent check of [`ChannelForces::on_walls`], as precise as samples of the flow at the walls. It is `None`
    /// where [`System::channel_forces`] is.
    ///
    /// # Errors
    /// Returns the errors of [`System::sample`].
    pub fn wall_traction(&mut self) -> Result<Option<[f64; 2]>, SceneError> {
        let Some(ChannelForces { period, .. }) = self.channel_forces()? else { return Ok(None) };
        let [mut count, most] = POINTS;
        let Some(shear) = self.wall_shear_at(count, 0.0)? else { return Ok(None) };
        let mean = |shear: [Vec<f64>; 2]| shear.map(|list| period * list.iter().sum::<f64>() / list.len() as f64);
        let mut found = mean(shear);
        while count < most {
            let Some(between) = self.wall_shear_at(count, 0.5)? else { return Ok(None) };
            let between = mean(between);
            let next = [0, 1].map(|wall| 0.5 * (found[wall] + between[wall]));
            let (change, size) = ([0, 1].map(|wall| (next[wall] - found[wall]).abs()), next.map(f64::abs));
            (found, count) = (next, 2 * count);
            if change[0].max(change[1]) <= SETTLED * size[0].max(size[1]) {
                break;
            }
        }
        Ok(Some(found))
    }

    /// Returns the viscosities of the fluid at the lower and the upper wall (stress times time).
    pub(super) fn viscosities_at_walls(&self, exterior: f64) -> [f64; 2] {
        let mut found = [(f64::INFINITY, exterior), (f64::NEG_INFINITY, exterior)];
        for group in self.markers().groups() {
            let Some(advance) = group.kind.advance() else { continue };
            let heights = self.markers().positions()[group.range.clone()].iter().map(|place| place.y);
            let [inside, outside] = group.viscosities(exterior);
            let [below, above] = if advance > 0.0 { [outside, inside] } else { [inside, outside] };
            let (lowest, highest) =
                heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)));
            if lowest < found[0].0 {
                found[0] = (lowest, below);
            }
            if highest > found[1].0 {
                found[1] = (highest, above);
            }
        }
        found.map(|(_, viscosity)| viscosity)
    }
}
