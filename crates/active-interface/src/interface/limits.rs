//! Stable time steps and warnings of an interface.

use std::f64::consts::{PI, TAU};

use motile_base::{
    Vec2,
    internal::{told, told_apart},
};
use motile_scene::{FluidView, StepCause, StepLimit};

use super::{ActiveInterface, Motion};
use crate::Tension;
use crate::concentration::{Flux, element_peclet};

/// Element Peclet number `ds max|V_t - W| / D` (no dimension) above which the edge of the concentration is not
/// resolved, on however fine a grid: speeds may be off by 1 % (measured by the study `warnings`).
pub(crate) const PECLET_LIMIT: f64 = 0.35;

/// Modes of a swimmer's shape, in the plane the number of nodes, below which its speed is off by more than 1 %. At
/// activities of -2, -3 and -4, with 600 elements, the speed is off by -1.8, -1.6 and -0.5 % with 16 nodes, and by -0.1,
/// 0 and -0.6 with 24. In three dimensions at -2, in a tube of 1.4 radii, it is off by 2.4 % with 16 modes and by 0.6 %
/// with 22.
const LEAST_MODES: usize = 24;
/// Error of the speed of swimmers with the upwind flux, in %: 2.9 to 6.6 with 192 elements at activities of -2 to -4.
const UPWIND_ERROR: f64 = 3.5;

/// Returns the grid spacing h (length) that the motion of an interface sees. It is `None` if the flow resolves the
/// interface by modes, as boundary integrals and layers do, whether or not there is a grid for other bodies.
pub(crate) fn grid_spacing(view: &FluidView) -> Option<f64> {
    view.spacing.filter(|_| view.shape_modes.is_none())
}

/// Returns the length below which the flow no longer responds to forces along an interface. It is the grid spacing, or
/// 2/q for the largest resolved wave number q. The stiffness of the interface is q/4, the rate of a flat interface of
/// unit tension and viscosity, which makes that length a half over the stiffness.
pub(super) fn finest_response(view: &FluidView) -> f64 {
    grid_spacing(view).unwrap_or(0.5 / view.interface_stiffness)
}

/// Fewest steps in a period of a field: fewer would see another field.
const LEAST_STEPS: f64 = 4.0;
/// Steps in a period of a field that adaptive steps take at least.
const ACCURATE_STEPS: f64 = 24.0;
const FIELD_CHANGES: &str = "the changes of a field in time";

/// Number of the wave along an interface that bends up to which steps follow the decay. It is implicit, and stable in
/// longer steps too.
const FOLLOWED_WAVE: f64 = 4.0;

/// Multiple of the mean concentration beyond which a tension law is not looked at: the concentration of all particles
/// on one of a thousand segments.
const MOST_CONCENTRATED: f64 = 1024.0;

/// Multiples of the mean concentration at which the slope of a tension law is compared with its values.
const SLOPE_SAMPLES: [f64; 6] = [0.5, 0.8, 1.0, 1.3, 1.8, 2.5];
/// Distance of the values that are compared, over the mean concentration.
const SLOPE_STEP: f64 = 1e-4;
/// Relative error of the slope that is passed over: it changes time steps and growth rates by as much.
const SLOPE_ERROR: f64 = 0.05;

/// Returns true for a tension that grows in proportion to the concentration, or faster, up to the largest one looked
/// at. Then the flow that the particles drive grows as fast as the diffusion that spreads them, however densely they
/// lie. Its mean slopes between concentrations at ratios of two are compared.
fn grows_without_bound(tension: &dyn Tension, mean: f64) -> bool {
    let slope = |c: f64| (tension.value(c) - tension.value(0.5 * c)) / (0.5 * c);
    let last = slope(MOST_CONCENTRATED * mean);
    let steepest = (0..10).map(|k| slope(mean * f64::from(1 << k))).fold(0.0, f64::max);
    last > 0.0 && last >= 0.5 * steepest
}

/// A law with another activity, as where a field adds to it.
#[derive(Debug)]
struct Shifted<'a> {
    law: &'a dyn Tension,
    activity: f64,
}

impl Tension for Shifted<'_> {
    fn value(&self, c: f64) -> f64 {
        self.law.value(c) - self.activity * c
    }

    fn slope(&self, c: f64) -> f64 {
        self.law.slope(c) - self.activity
    }
}

impl ActiveInterface {
    /// Returns the element Peclet number `ds max|V_t - W| / D` of the last evaluation (no dimension): V_t - W the
    /// velocity of the fluid along the interface relative to the markers, ds the length of the segments. 0 without
    /// particles, infinite for particles that do not diffuse. Above 0.35, the edge of the concentration is not
    /// resolved.
    #[must_use]
    pub fn element_peclet(&self) -> f64 {
        if self.carries() {
            element_peclet(&self.derived.slip, &self.geometry().lengths, self.law.diffusion)
        } else {
            0.0
        }
    }

    fn largest_tension(&self) -> f64 {
        self.tensions().iter().fold(0.0_f64, |a, &b| a.max(b))
    }

    /// Returns the largest wave number of the shape (1/length). It is the largest one of the flow, or on a grid of the
    /// markers.
    fn shortest_wave(&self, view: &FluidView) -> f64 {
        match view.shape_modes {
            Some(_) => 4.0 * view.interface_stiffness,
            None => PI / self.geometry().mean_length(),
        }
    }

    /// Returns the unit of the rate at which unequal spacing relaxes (1/time), see [`Motion::Equidistributed`].
    pub(super) fn spacing_rate(&self, viscosity: f64) -> f64 {
        let radius = self.geometry().perimeter / TAU;
        if self.carries() {
            return self.law.diffusion / (radius * radius);
        }
        0.2 * self.largest_tension() / (viscosity * radius)
    }

    /// Returns the largest stable steps of the explicit midpoint rule, which is stable for decay at the rate a up to
    /// 2/a.
    pub(super) fn add_step_limits(&self, view: &FluidView, viscosity: f64, limits: &mut dyn FnMut(StepLimit)) {
        let tension = self.largest_tension();
        let decay = |tension: f64| 2.0 * viscosity / (view.interface_stiffness * tension);
        match &self.law.bending {
            None => limits(StepLimit::decay(decay(tension), "the surface tension")),
            Some(bending) => {
                let bare = decay(tension + bending.tension(self.shortest_wave(view)));
                limits(if self.law.stabilised {
                    // The tension stays explicit, and so does what the first waves are followed with.
                    let wave = (FOLLOWED_WAVE * TAU / self.geometry().perimeter).min(self.shortest_wave(view));
                    let response = (0.25 * wave).min(view.interface_stiffness);
                    let followed = 2.0 * viscosity / (response * bending.tension(wave));
                    let dt = decay(tension).min(followed);
                    StepLimit { dt, reason: "the bending", cause: StepCause::Stabilised { bare } }
                } else {
                    StepLimit::decay(bare, "the bending")
                });
            }
        }
        if let Some(force) = &self.law.body_force {
            limits(StepLimit::decay(2.0 / force.rate(&self.state.shape, viscosity), "the body force"));
        }
        if let Some(elasticity) = &self.law.elasticity {
            let lengths = &self.geometry().lengths;
            let (count, shortest) = (lengths.len() as f64, lengths.iter().copied().fold(f64::INFINITY, f64::min));
            let modes = view.shape_modes.map_or(count, |modes| (modes as f64).min(count));
            let wave = PI * modes / (count * shortest);
            // It decays at the rate wave stiffness/(2 (eta_in + eta_ext)).
            let dt = 8.0 * viscosity / (wave * elasticity.stiffness(wave));
            limits(StepLimit::decay(dt, "the elasticity of the interface"));
        }
        if let Motion::Equidistributed { relaxation, .. } = self.law.motion {
            // The rate of the next step, and that of the last one where the flow itself sets it.
            let rate = self.derived.relaxation.max(relaxation * self.spacing_rate(viscosity));
            limits(StepLimit::decay(2.0 / rate, "the relaxation of the marker spacing"));
        }
        if self.carries() {
            // Crowded particles relax at the rate c |gamma'| q / (4 eta). Explicitly, the shortest waves q = pi/h set
            // the limit 8 h eta / (pi c |gamma'|). The stabiliser adds q h times that rate to the implicit part and
            // takes it off the explicit one; with a = dt c |gamma'| q / (4 eta) a step multiplies a wave by
            // `1 - a (1 + a (q h - 1/2)) / (1 + a q h/2)^2`, which exceeds 1 where a (1/2 - q h) > 1 and never falls
            // below -1: waves of q = 1/(4 h) grow first, above 64 h eta / (c |gamma'|). A second interface much closer
            // than h doubles the mobility, which leaves a quarter of that: a scene whose flow resolves modes measures
            // how close it is. On a grid, where droplets come so close, half of this quarter is kept to
            // (docs/explanation/time-stepping.md).
            let slope = |c: f64| c * self.law.tension.slope(c).abs();
            let concentrations = &self.derived.concentrations;
            let coupling = match self.felt_activities() {
                [] => concentrations.iter().map(|&c| slope(c)).fold(0.0_f64, f64::max),
                activities => {
                    let felt = |(&c, activity): (&f64, &f64)| c * (self.law.tension.slope(c) - activity).abs();
                    concentrations.iter().zip(activities).map(felt).fold(0.0_f64, f64::max)
                }
            };
            let unit = finest_response(view) * viscosity / coupling;
            let (factor, cause) = if self.law.stabilised {
                let factor = if grid_spacing(view).is_some() { 8.0 } else { 64.0 };
                (factor, StepCause::Stabilised { bare: 2.5 * unit })
            } else {
                (2.5, StepCause::Decay)
            };
            let reason = "the coupling of concentration and tension";
            limits(StepLimit { dt: factor * unit, reason, cause });
            let slip = self.derived.slip.iter().fold(0.0_f64, |a, &b| a.max(b.abs()));
            // Measured: WENO5 under the midpoint rule, with the implicit diffusion of these problems, is stable up to
            // about two segments a step.
            let dt = 1.8 * self.geometry().mean_length() / slip;
            limits(StepLimit { dt, reason: "the particles' transport", cause: StepCause::Transport });
        }
        if let Some(felt) = &self.felt {
            let frequency = felt.fields.highest_frequency();
            if frequency > 0.0 {
                let period = TAU / frequency;
                let [bound, accurate] = [period / LEAST_STEPS, period / ACCURATE_STEPS];
                limits(StepLimit { dt: bound, reason: FIELD_CHANGES, cause: StepCause::Transport });
                limits(StepLimit { dt: accurate, reason: FIELD_CHANGES, cause: StepCause::Accuracy });
            }
        }
    }

    /// Returns the mean concentration at the start (particles per length, or area in three dimensions), on a circle or
    /// sphere of the size at the start, or on a straight line.
    pub(super) fn mean_concentration(&self) -> f64 {
        let length = match self.advance().abs() {
            0.0 => {
                let radius = self.radius_at_start();
                if self.state.shape.axisymmetric { 2.0 * TAU * radius * radius } else { TAU * radius }
            }
            period => period,
        };
        self.account.number / length
    }

    /// Returns the warning of a tension law that lets the particles collapse towards a point: its own, or one of its
    /// values.
    pub(super) fn collapse(&self) -> Option<String> {
        let strongest = self.felt_activities().iter().copied().fold(f64::INFINITY, f64::min);
        let shifted = Shifted { law: self.law.tension.as_ref(), activity: strongest };
        let felt = strongest.is_finite() && strongest != 0.0;
        let tension: &dyn Tension = if felt { &shifted } else { self.law.tension.as_ref() };
        tension.warning().or_else(|| {
            let mean = self.mean_concentration();
            (self.carries() && grows_without_bound(tension, mean)).then(|| {
                let most = MOST_CONCENTRATED * mean;
                format!(
                    "the tension still grows in proportion to the concentration at {most:.2e}, {MOST_CONCENTRATED} \
                     times the mean one, so that the particles collapse towards a point. Use a law that levels off \
                     (an excluded volume does)"
                )
            })
        })
    }

    /// Returns the doubt about a slope of the tension law that is not the slope of its values.
    fn wrong_slope(&self) -> Option<(&'static str, f64, String)> {
        if !self.carries() {
            return None;
        }
        let (tension, mean) = (self.law.tension.as_ref(), self.mean_concentration());
        SLOPE_SAMPLES.iter().find_map(|part| {
            let (c, by) = (part * mean, SLOPE_STEP * mean);
            let [before, here, after] = [c - by, c, c + by].map(|c| tension.value(c));
            let [left, right] = [(here - before) / by, (after - here) / by];
            let slope = tension.slope(c);
            // A law may have a kink, and its values have round-off.
            let largest = left.abs().max(right.abs()).max(slope.abs());
            let slack = SLOPE_ERROR * largest + 64.0 * f64::EPSILON * here.abs().max(after.abs()) / by;
            let off = (left.min(right) - slope).max(slope - left.max(right));
            (!slope.is_finite() || off > slack).then(|| {
                let message = format!(
                    "`slope` of the tension law returns {} at c = {}, but the values change by {} per concentration \
                     there: time steps and growth rates follow the slope, so they are wrong; correct `slope`",
                    told(slope),
                    told(c),
                    told(0.5 * (left + right))
                );
                ("slope of the tension wrong", if slope.is_finite() { off / slack } else { f64::INFINITY }, message)
            })
        })
    }

    /// Returns the doubt about a negative tension: waves of an interface under compression grow faster the shorter they
    /// are, unless its bending holds the shortest of them.
    fn negative_tension(&self, view: &FluidView) -> Option<(&'static str, f64, String)> {
        let mut totals = self.tensions().to_vec();
        let count = totals.len();
        if let Some(elasticity) = &self.law.elasticity {
            let stretched: Vec<f64> = elasticity.tensions().collect();
            let middles = stretched.iter().zip(stretched.iter().cycle().skip(1)).map(|(a, b)| 0.5 * (a + b));
            totals.iter_mut().zip(middles).for_each(|(total, stretched)| *total += stretched);
        }
        let place = (0..count).min_by(|&a, &b| totals[a].total_cmp(&totals[b]))?;
        let lowest = totals[place];
        let wave = self.shortest_wave(view);
        let modulus = self.law.bending.as_ref().map(|bending| bending.modulus);
        let modulus = modulus.or_else(|| self.law.elasticity.as_ref().map(|elasticity| elasticity.moduli()[1]));
        let held = modulus.unwrap_or(0.0) * wave * wave;
        if lowest + held >= 0.0 {
            return None;
        }
        let markers = self.markers();
        // The last segment of an open interface ends at the image of the first marker.
        let next = if place + 1 == count { markers[0] + Vec2::new(self.advance(), 0.0) } else { markers[place + 1] };
        let at = 0.5 * (markers[place] + next);
        let bare = self.law.tension.value(0.0).abs();
        let mut crowd = String::new();
        let mut advice = "use an activity nearer to zero or a higher tension without particles";
        if self.carries() {
            let [c, mean] = [self.derived.concentrations[place], self.mean_concentration()];
            crowd = format!(", where the concentration is {c:.3e}, {:.3} times its mean", c / mean);
            if c > mean {
                advice = "the crowd of particles there pushes the interface apart: use a weaker excluded volume, a \
                          higher tension without particles, or an activity that raises the tension more; after a \
                          change of the activity, wait until the particles have spread";
            }
        }
        let bends =
            if held > 0.0 { ", and its bending does not hold the shortest of them that is resolved" } else { "" };
        let finer = if held > 0.0 { "; more bending or nodes help as well" } else { "" };
        let message = format!(
            "its tension is {lowest:.3e} (force) near ({:.3}, {:.3}){crowd}: a line under compression has waves that \
             grow faster the shorter they are{bends}, so that there is no solution to converge to; {advice}{finer}",
            at.x, at.y
        );
        let excess = 1.0 - (lowest + held) / bare;
        Some(("tension negative", if excess.is_nan() { f64::INFINITY } else { excess }, message))
    }

    /// Returns the doubts about the present state, as cause, excess and message.
    pub(super) fn doubts(&self, view: &FluidView) -> impl Iterator<Item = (&'static str, f64, String)> {
        let law = self.collapse().map(|message| ("tension without a plateau", f64::INFINITY, message));
        let (negative, slope) = (self.negative_tension(view), self.wrong_slope());
        let peclet = self.element_peclet();
        let edge = (peclet > PECLET_LIMIT).then(|| {
            let spacing = self.geometry().mean_length() * PECLET_LIMIT / peclet;
            let remedy = if spacing > 0.0 {
                let cells = (self.geometry().perimeter / spacing).ceil();
                format!("use {cells} elements instead of {}, each {spacing:.2e} long", self.geometry().lengths.len())
            } else {
                "use a positive diffusion constant".to_owned()
            };
            let [text, limit] = told_apart([peclet, PECLET_LIMIT]);
            let message = format!(
                "the Péclet number of an interface element, the flow along it over diffusion across it, is {text}, \
                 above {limit}: the \
                 speed may be off by a per cent and more; {remedy}"
            );
            ("edge of the concentration not resolved", peclet / PECLET_LIMIT, message)
        });
        let few = view.shape_modes.filter(|modes| *modes < LEAST_MODES && self.carries()).map(|modes| {
            let nodes = view.nodes.unwrap_or(modes);
            // In three dimensions, nodes carry two thirds as many modes.
            let least = (LEAST_MODES * nodes).div_ceil(modes.max(1));
            let message = format!(
                "{nodes} nodes carry too few waves of the shape: the speed is off by up to two per cent, the \
                 stresslet by more, with however many elements; use {least} nodes or more"
            );
            ("shape not resolved", LEAST_MODES as f64 / modes as f64, message)
        });
        let upwind = self.scheme.transport.as_ref().is_some_and(|transport| transport.flux() == Flux::Upwind);
        let smeared = upwind.then(|| {
            let message = "the upwind flux is of first order, with 200 elements the speed is 3 to 7 per cent too high: \
                           use the flux weno5";
            ("edge of the concentration smeared", UPWIND_ERROR, message.to_owned())
        });
        law.into_iter().chain(negative).chain(slope).chain(edge).chain(few).chain(smeared)
    }
}

#[cfg(test)]
mod tests;
