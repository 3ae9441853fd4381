//! Sensitivities: derivatives of what is measured of a steady state by the parameters of its scene.

use std::fmt;

use nalgebra::DVector;

use crate::growth::Disturbance;
use crate::modes::Part;
use crate::response::{Linearised, singular};
use crate::{Critical, Eigenmode, Parameter, SteadyError, SteadyState};

/// Slowest rate of a state's own disturbances, in units of D/R^2, below which it is near a fold or a branch point.
const NEAR: f64 = 0.05;
/// Slowest rate, in units of D/R^2, below which the equations are bordered by their null vectors: at a branch point
/// of droplets at rest, for example, derivatives along the branch are finite.
pub(crate) const SINGULAR: f64 = 1e-5;
/// Part of the size of derivatives by the parameter below which a critical point is not a fold.
pub(crate) const NO_FOLD: f64 = 1e-5;

/// Largest defect of the law of the unit of length, relative to the observable, without a remark.
const MOST_DEFECT: f64 = 0.01;

/// Derivatives of the observables of a steady state by each parameter of its scene.
///
/// ```
/// use motile::prelude::*;
/// use motile_steady_states::{Parameter, SteadyState};
///
/// let method = Method::Integral(IntegralMethod { nodes: 96, elements: 384 });
/// let swimmer = SteadyState::find(&Setup { method, region: Region::Plane, ..Setup::default() })?;
/// let sensitivities = swimmer.sensitivities()?;
/// println!("{sensitivities}");
/// let by_activity = sensitivities.derivative("speed", Parameter::Activity).ok_or("no activity")?;
/// assert!((by_activity + 0.0498511).abs() < 1e-5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[doc(alias("derivative", "gradient", "sensitivity analysis", "adjoint"))]
#[non_exhaustive]
pub struct Sensitivities {
    /// Observables: name and value.
    pub observables: Vec<(&'static str, f64)>,
    /// One entry per parameter.
    pub parameters: Vec<Sensitivity>,
    /// Slowest growth or decay of disturbances with the symmetry of the state (1/time). If it is zero, the state is at
    /// a fold or a branch point, and derivatives do not exist.
    pub slowest: f64,
    /// The slowest rate in units of D/R^2. Below 0.05, the state is near a fold or a branch point.
    pub slowest_relative: f64,
    /// Remark, if the state is near a fold or a branch point, or derivatives break the law of the unit of length by
    /// more than 1 %. Nodes stay where they are if a length changes, so the law holds up to the errors of nodes.
    pub warning: Option<String>,
}

/// Derivatives of all observables by one parameter.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Sensitivity {
    /// Parameter.
    pub parameter: Parameter,
    /// Key in scene files, such as `droplets.0.particles.activity`.
    pub key: &'static str,
    /// Value of the parameter.
    pub value: f64,
    /// Derivative of each observable (unit of the observable over the unit of the parameter).
    pub derivatives: Vec<f64>,
    /// Distance of the parameter to the fold or branch point that the slowest disturbance hints at, if it is near
    /// (unit of the parameter).
    pub distance: Option<f64>,
}

impl Sensitivities {
    /// Returns the derivative of an observable by a parameter (unit of the observable over the unit of the parameter);
    /// `None` if there is no such observable or parameter.
    #[must_use]
    pub fn derivative(&self, observable: &str, parameter: Parameter) -> Option<f64> {
        let place = self.observables.iter().position(|(name, _)| *name == observable)?;
        self.parameters.iter().find(|entry| entry.parameter == parameter)?.derivatives.get(place).copied()
    }

    /// Returns the relative change of an observable per relative change of a parameter (no dimension); `None` if there
    /// is no such observable or parameter, or the observable is zero.
    #[must_use]
    pub fn logarithmic(&self, observable: &str, parameter: Parameter) -> Option<f64> {
        let (_, value) = self.observables.iter().find(|(name, _)| *name == observable)?;
        let entry = self.parameters.iter().find(|entry| entry.parameter == parameter)?;
        let derivative = self.derivative(observable, parameter)?;
        (*value != 0.0).then(|| derivative * entry.value / value)
    }
}

impl Sensitivities {
    /// Returns the table as CSV: a line per parameter with its name, its key in scene files and its value. For each
    /// observable, the derivative (`d_speed` for example) and the relative change per relative change (`log_speed`)
    /// follow. The latter is empty if the observable is zero.
    #[must_use]
    pub fn csv(&self) -> String {
        let names = self.observables.iter().map(|(name, _)| format!(",d_{name},log_{name}"));
        let mut text = format!("parameter,key,value{}\n", names.collect::<String>());
        for entry in &self.parameters {
            text += &format!("{},{},{}", entry.parameter.name(), entry.key, entry.value);
            for ((name, _), derivative) in self.observables.iter().zip(&entry.derivatives) {
                let relative = self.logarithmic(name, entry.parameter).map(|relative| relative.to_string());
                text += &format!(",{derivative},{}", relative.unwrap_or_default());
            }
            text.push('\n');
        }
        text
    }
}

impl fmt::Display for Sensitivities {
    /// Writes two tables: the derivatives, and the relative changes in percent per percent of the parameter.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let header = |f: &mut fmt::Formatter<'_>, title: &str| {
            write!(f, "{title:<26} {:>10}", "value")?;
            self.observables.iter().try_for_each(|(name, _)| write!(f, " {name:>13}"))
        };
        header(f, "derivative by")?;
        for Sensitivity { parameter, value, derivatives, .. } in &self.parameters {
            write!(f, "\n{:<26} {:>10}", parameter.name(), number(*value))?;
            derivatives.iter().try_for_each(|derivative| write!(f, " {derivative:>13.5e}"))?;
        }
        f.write_str("\n\n")?;
        header(f, "percent per percent of")?;
        for Sensitivity { parameter, value, distance, .. } in &self.parameters {
            write!(f, "\n{:<26} {:>10}", parameter.name(), number(*value))?;
            for (name, _) in &self.observables {
                match self.logarithmic(name, *parameter) {
                    Some(relative) => write!(f, " {relative:>13.5}")?,
                    None => write!(f, " {:>13}", "-")?,
                }
            }
            if let Some(distance) = distance {
                write!(f, "  singular near {}", number(value + distance))?;
            }
        }
        write!(f, "\n\n{:<26} {:>10}", "observable", "")?;
        self.observables.iter().try_for_each(|(_, value)| write!(f, " {value:>13.5e}"))?;
        self.warning.as_ref().map_or(Ok(()), |warning| write!(f, "\n{warning}"))
    }
}

/// Returns the text of a number with four decimals, or with an exponent if these would not show it.
fn number(value: f64) -> String {
    let shown = value == 0.0 || (1e-2..1e6).contains(&value.abs());
    if shown { format!("{value:.4}") } else { format!("{value:.3e}") }
}

/// Names of the observables of every state.
const OBSERVABLES: [&str; 6] = ["speed", "stresslet", "aspect_ratio", "c_max", "c_min", "perimeter"];

impl SteadyState {
    /// Returns the derivatives of what is measured by every numeric parameter of the scene, by one solve each with the
    /// factors of Newton's method. Measured are speed, stresslet, aspect ratio, largest and smallest concentration over
    /// c0 (`c_max` and `c_min`) and perimeter. For states that are not mirror-symmetric, the turning rate is another
    /// one.
    ///
    /// The viscosities inside and outside are parameters each, whether or not the droplet has its own viscosity in the
    /// scene.
    ///
    /// # Errors
    /// Returns an error for a state whose equations are singular; a flow that cannot be solved for.
    pub fn sensitivities(&self) -> Result<Sensitivities, SteadyError> {
        self.sensitivities_with(&[])
    }

    /// Returns the derivatives of [`SteadyState::sensitivities`], and the derivatives of the growth rates and
    /// frequencies of some modes of [`SteadyState::spectrum`] (1/time). They are named `growth_rate` and, if the mode
    /// oscillates,
    /// `frequency` for the first mode, `growth_rate_2` for the second mode, and so on.
    ///
    /// # Errors
    /// Returns the errors of [`SteadyState::sensitivities`] and [`SteadyState::spectrum`]; an error for more than four
    /// modes.
    pub fn sensitivities_with(&self, modes: &[Eigenmode]) -> Result<Sensitivities, SteadyError> {
        self.sensitivities_by(&Parameter::independent(self.setup()), modes)
    }

    /// Returns the derivatives of [`SteadyState::sensitivities_with`] by some parameters alone, in less time.
    ///
    /// # Errors
    /// Returns an error for a parameter that the scene does not have; the errors of
    /// [`SteadyState::sensitivities_with`].
    pub fn sensitivities_by(&self, wanted: &[Parameter], modes: &[Eigenmode]) -> Result<Sensitivities, SteadyError> {
        for parameter in wanted.iter().filter(|parameter| parameter.get(self.setup()).is_none()) {
            parameter.with(self.setup(), 0.0)?;
        }
        if modes.len() > GROWTH.len() {
            return Err(SteadyError::unsupported("there are more than four modes", "Ask for them one after the other"));
        }
        let mut linearised = Linearised::new(self)?;
        let unit = linearised.system.model.rate_unit();
        let slowest = linearised.slowest();
        if slowest.abs() < SINGULAR * unit {
            linearised.border()?;
        }
        let mut disturbances = Vec::new();
        for mode in modes {
            let (system, point) = (&mut linearised.system, &linearised.point);
            disturbances.push(Disturbance::new(system, point, mode)?);
        }
        linearised.system.load(&linearised.point)?;
        let measured = self.measured_in(&linearised.system)?;
        let velocity = self.relative_velocity(&linearised.system)?;
        let heading = velocity.try_normalize().unwrap_or(motile_base::Vec2::X);
        let turns = self.part() == Part::Full;
        let mut observables: Vec<(&'static str, f64)> = OBSERVABLES.into_iter().zip(measured.list()).collect();
        if measured.speed < AT_REST * unit * linearised.system.model.radius {
            observables[0].1 = 0.0;
        }
        if measured.stresslet.abs() < AT_REST * self.natural_stresslet() {
            observables[1].1 = 0.0;
        }
        if turns {
            observables.push(("turning_rate", self.turning_rate()));
        }
        for (disturbance, names) in disturbances.iter().zip(GROWTH) {
            let parts = names.into_iter().zip([disturbance.value.re, disturbance.value.im]);
            observables.extend(parts.take(disturbance.parts()));
        }
        let near = slowest.abs() < NEAR * unit;
        let own = near.then(|| Eigenmode { value: slowest.into(), symmetry: self.own_symmetry() });
        let own = own.and_then(|mode| Disturbance::new(&mut linearised.system, &linearised.point, &mode).ok());
        linearised.system.load(&linearised.point)?;
        let mut parameters = Vec::new();
        for &parameter in wanted {
            let response = linearised.response(parameter)?;
            if (response.multiplier * parameter.scale(self.setup())).abs() > NO_FOLD {
                return Err(singular());
            }
            let mut derivatives = linearised.total(&response, |_, system, point| {
                system.load(point)?;
                let state = Self::of(system, point.clone(), self.outcome(), self.part())?;
                let mut values = state.measured_in(system)?.list().to_vec();
                values[0] = state.relative_velocity(system)?.dot(heading);
                values.extend(turns.then(|| state.turning_rate()));
                Ok(DVector::from_vec(values))
            })?;
            for disturbance in &disturbances {
                let change = disturbance.derivative(&mut linearised, &response)?;
                for part in [change.re, change.im].into_iter().take(disturbance.parts()) {
                    derivatives = derivatives.push(part);
                }
            }
            // At a fold the square of the rate is linear in the parameter.
            let distance = own.as_ref().and_then(|own| {
                let change = own.derivative(&mut linearised, &response).ok()?;
                let distance = -0.5 * own.value.re / change.re;
                (distance.abs() < parameter.scale(self.setup())).then_some(distance)
            });
            let value = parameter.get(self.setup()).unwrap_or(f64::NAN);
            parameters.push(Sensitivity {
                parameter,
                key: parameter.key(self.setup()),
                value,
                derivatives: derivatives.as_slice().to_vec(),
                distance,
            });
        }
        let near = near.then(|| {
            format!(
                "Near a fold or a branch point: a disturbance of the state's own symmetry changes at a rate of only \
                 {:.1e} (1/time). Derivatives grow without bound there, so use these for small changes alone.",
                slowest.abs()
            )
        });
        let coarse = self.remark_on_lengths(wanted, &observables, &parameters);
        let remarks: Vec<String> = near.into_iter().chain(coarse).collect();
        let warning = (!remarks.is_empty()).then(|| remarks.join(" "));
        Ok(Sensitivities { observables, parameters, slowest, slowest_relative: slowest / unit, warning })
    }

    /// Returns a remark if a change of the unit of length changes an observable by another power than its own. The sum
    /// of power times relative derivative over all parameters is this power.
    fn remark_on_lengths(
        &self,
        wanted: &[Parameter],
        observables: &[(&'static str, f64)],
        parameters: &[Sensitivity],
    ) -> Option<String> {
        let setup = self.setup();
        // Lengths that are no parameters.
        let others = setup.rigid_bodies.len() > 1;
        if others || Parameter::independent(setup).iter().any(|parameter| !wanted.contains(parameter)) {
            return None;
        }
        let dimensions = if setup.region.is_axisymmetric() { 2 } else { 1 };
        let defect = |(place, (name, value)): (usize, &(&'static str, f64))| {
            let power = match *name {
                "speed" | "stresslet" => 1,
                "perimeter" => dimensions,
                "aspect_ratio" | "c_max" | "c_min" => 0,
                _ => return None,
            };
            let terms = parameters.iter().map(|entry| {
                f64::from(entry.parameter.power_of_length(dimensions)) * entry.value * entry.derivatives[place] / value
            });
            Some((*name, (terms.sum::<f64>() - f64::from(power)).abs())).filter(|_| *value != 0.0)
        };
        let off = observables.iter().enumerate().filter_map(defect).filter(|(_, defect)| *defect > MOST_DEFECT);
        let listed: Vec<String> = off.map(|(name, defect)| format!("{name} {:.1} %", 100.0 * defect)).collect();
        (!listed.is_empty()).then(|| {
            format!(
                "The nodes do not resolve the derivatives by lengths, such as the radius. Together, these are off by so \
                 much of the observable: {}. Use more nodes.",
                listed.join(", ")
            )
        })
    }

    /// Returns the size of the stresslet that natural tensions cause (tension times area in space, times length in the
    /// plane).
    fn natural_stresslet(&self) -> f64 {
        let power = if self.setup().region.is_axisymmetric() { 2 } else { 1 };
        Parameter::Tension.natural(self.setup()) * Parameter::Radius.natural(self.setup()).powi(power)
    }

    fn own_symmetry(&self) -> crate::Symmetry {
        if self.part() == Part::Even { crate::Symmetry::Symmetric } else { crate::Symmetry::None }
    }
}

/// Speed over D/R below which a droplet is at rest, and stresslet over its natural size below which it vanishes: their
/// relative changes have no meaning.
const AT_REST: f64 = 1e-9;

/// Names of growth rates and frequencies.
const GROWTH: [[&str; 2]; 4] = [
    ["growth_rate", "frequency"],
    ["growth_rate_2", "frequency_2"],
    ["growth_rate_3", "frequency_3"],
    ["growth_rate_4", "frequency_4"],
];

impl Critical {
    /// Returns the derivatives of a critical value, such as the critical activity, by every other parameter of the
    /// scene: how far the threshold moves if a parameter changes. At a Hopf point, the frequency is an observable too.
    ///
    /// A fold needs more nodes than its place does, above all for derivatives by lengths. For the fold of a drop in
    /// extension, the derivative by the radius is off by half at a [`SteadyState::tail`] of 4e-4, and by 3e-5 at 2e-5.
    ///
    /// # Errors
    /// Returns an error for a description without the parameter; a growth rate that the parameter does not change.
    pub fn sensitivities(&self, parameter: Parameter) -> Result<Sensitivities, SteadyError> {
        let Self { state, mode } = self;
        let value = parameter.get(state.setup());
        let value = value.map_or_else(|| parameter.with(state.setup(), 0.0).map(|_| f64::NAN), Ok)?;
        let mut linearised = Linearised::new(state)?;
        let (unit, slowest) = (linearised.system.model.rate_unit(), linearised.slowest());
        let own = slowest.abs() < SINGULAR * unit;
        if own {
            linearised.border()?;
        }
        let disturbance = Disturbance::new(&mut linearised.system, &linearised.point, mode)?;
        linearised.system.load(&linearised.point)?;
        let along = linearised.response(parameter)?;
        let scale = parameter.scale(state.setup());
        let fold = own && (along.multiplier * scale).abs() > NO_FOLD;
        let by_it = if fold { along.multiplier.into() } else { disturbance.derivative(&mut linearised, &along)? };
        if (by_it.re * scale).abs() < NO_FOLD * unit {
            return Err(SteadyError::unsupported(
                format!("the growth rate does not change with {}", parameter.name()),
                "Ask for the sensitivities of another parameter's critical value",
            ));
        }
        let oscillates = mode.value.im > NEAR * unit;
        let mut observables = vec![(parameter.name(), value)];
        observables.extend(oscillates.then_some(("frequency", disturbance.value.im)));
        let mut parameters = Vec::new();
        for other in Parameter::independent(state.setup()).into_iter().filter(|other| *other != parameter) {
            let response = linearised.response(other)?;
            let change =
                if fold { response.multiplier.into() } else { disturbance.derivative(&mut linearised, &response)? };
            let moved = -change.re / by_it.re;
            let mut derivatives = vec![moved];
            derivatives.extend(oscillates.then_some(change.im + by_it.im * moved));
            let value = other.get(state.setup()).unwrap_or(f64::NAN);
            parameters.push(Sensitivity {
                parameter: other,
                key: other.key(state.setup()),
                value,
                derivatives,
                distance: None,
            });
        }
        Ok(Sensitivities { observables, parameters, slowest, slowest_relative: slowest / unit, warning: None })
    }
}
