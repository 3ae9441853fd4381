//! Steady states, their spectra and branches.

use pyo3::prelude::*;
use pyo3::types::PyDict;

use motile_steady_states::{Continuation, Parameter, Spectrum, SteadyError};
use numpy::{PyArray1, PyArray2, PyArrayMethods as _};

use crate::error::{failed, of_setup, refused};
use crate::setup::Setup;
use crate::work::unless_interrupted;

fn of_steady(error: &SteadyError) -> PyErr {
    if let SteadyError::Setup(error) = error { of_setup(error) } else { failed(error) }
}

/// Parameter of a name with underscores.
fn parameter_of(parameter: &str) -> PyResult<Parameter> {
    let name = parameter.replace('_', "-");
    let known = Parameter::NAMES.iter().find(|(known, _)| *known == name).map(|(_, parameter)| *parameter);
    known.ok_or_else(|| {
        let names: Vec<String> = Parameter::NAMES.iter().map(|(name, _)| name.replace('-', "_")).collect();
        let remedy = format!("Use one of {}", names.join(", "));
        let message = format!("there is no parameter {parameter}. {remedy}");
        refused(&message, Some("parameter".into()), Some(parameter.to_owned()), Some(remedy))
    })
}

/// Steady state of a droplet, found by Newton's method.
#[pyclass(module = "motile", frozen)]
#[derive(Debug)]
pub(crate) struct SteadyState {
    state: motile_steady_states::SteadyState,
}

#[pymethods]
impl SteadyState {
    /// Setup of the state.
    #[getter]
    fn setup(&self) -> Setup {
        Setup { description: self.state.setup().clone() }
    }

    /// Velocity of the centroid (length per time).
    #[getter]
    fn velocity(&self) -> (f64, f64) {
        self.state.velocity().into()
    }

    /// Largest rate of change that is left (1/time).
    #[getter]
    fn residual(&self) -> f64 {
        self.state.residual()
    }

    /// Speed, stresslet, aspect ratio and the like.
    #[getter]
    fn measured<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let seen = py.detach(|| self.state.measured()).map_err(|error| of_steady(&error))?;
        let dict = PyDict::new(py);
        for (name, value) in [
            ("speed", seen.speed),
            ("stresslet", seen.stresslet),
            ("aspect_ratio", seen.aspect_ratio),
            ("concentration_max", seen.concentration[0]),
            ("concentration_min", seen.concentration[1]),
            ("perimeter", seen.perimeter),
            ("x", seen.centroid.x),
            ("y", seen.centroid.y),
            ("least_curvature", seen.least_curvature),
        ] {
            dict.set_item(name, value)?;
        }
        Ok(dict)
    }

    /// Speed (length per time).
    #[getter]
    fn speed(&self) -> PyResult<f64> {
        Ok(self.state.measured().map_err(|error| of_steady(&error))?.speed)
    }

    /// Positions of the nodes (length), an array of shape (n, 2).
    #[getter]
    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let points = &self.state.profile().positions;
        PyArray1::from_vec(py, points.iter().flat_map(|point| point.to_array()).collect()).reshape([points.len(), 2])
    }

    /// Concentrations at the nodes (particles per length, in three dimensions per length squared).
    #[getter]
    fn concentration<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let (_, values) = self.state.profile().concentrations().map_err(|error| of_steady(&error))?;
        Ok(PyArray1::from_vec(py, values))
    }

    /// Derivatives of positions and concentrations at the nodes by some parameters, named as in `sensitivities`: a
    /// dictionary by parameter of arrays of shape (n, 3), with the columns x, y and concentration.
    fn profile_sensitivities<'py>(&self, py: Python<'py>, parameters: Vec<String>) -> PyResult<Bound<'py, PyDict>> {
        let known = parameters.iter().map(|name| parameter_of(name)).collect::<PyResult<Vec<_>>>()?;
        let state = self.state.clone();
        let found = unless_interrupted(py, None, move |_| state.profile_sensitivities(&known))?;
        let all = PyDict::new(py);
        for (name, change) in parameters.into_iter().zip(found.map_err(|error| of_steady(&error))?) {
            let rows = change.positions.iter().zip(&change.concentrations).flat_map(|(at, c)| [at.x, at.y, *c]);
            all.set_item(name, PyArray1::from_vec(py, rows.collect()).reshape([change.concentrations.len(), 3])?)?;
        }
        Ok(all)
    }

    /// Eigenvalues (1/time) of small disturbances, largest growth rate first, one of each conjugate pair, and their
    /// symmetries.
    fn spectrum<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyArray1<numpy::Complex64>>, Vec<&'static str>)> {
        let spectrum = self.of_disturbances(py)?;
        let values = spectrum.modes.iter().map(|mode| mode.value).collect();
        Ok((PyArray1::from_vec(py, values), spectrum.modes.iter().map(|mode| mode.symmetry.name()).collect()))
    }

    /// True if no small disturbance grows, False if one does, None if that is undecided because the largest growth rate
    /// is zero within its error.
    fn is_stable(&self, py: Python<'_>) -> PyResult<Option<bool>> {
        Ok(self.of_disturbances(py)?.stability().decided())
    }

    /// Error estimate of the growth rates of small disturbances (1/time).
    fn growth_rate_error(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.of_disturbances(py)?.error)
    }

    /// Refused, with what to send instead.
    fn __reduce__(&self) -> PyResult<()> {
        let remedy = "Send its setup (`state.setup`), and call `motile.steady` or `motile.branch` there";
        Err(refused(&format!("a steady state cannot be pickled. {remedy}"), None, None, Some(remedy.to_owned())))
    }

    /// Derivatives of speed, stresslet and so on by every number of the setup: a dictionary by observable of
    /// dictionaries by parameter, of which pandas makes a table. With `logarithmic`, relative changes per relative
    /// change; with `growth`, also the growth rate of the leading mode and, if it oscillates, its frequency. With a
    /// list of `parameters`, by these alone, in less time.
    #[pyo3(signature = (*, parameters=None, logarithmic=false, growth=false))]
    fn sensitivities<'py>(
        &self,
        py: Python<'py>,
        parameters: Option<Vec<String>>,
        logarithmic: bool,
        growth: bool,
    ) -> PyResult<Bound<'py, PyDict>> {
        let state = self.state.clone();
        let wanted = match parameters {
            Some(names) => names.into_iter().map(|name| parameter_of(&name)).collect::<PyResult<Vec<_>>>()?,
            None => Parameter::independent(self.state.setup()),
        };
        let found = unless_interrupted(py, None, move |_| {
            let mode = if growth { state.spectrum()?.leading().cloned() } else { None };
            state.sensitivities_by(&wanted, &mode.into_iter().collect::<Vec<_>>())
        })?;
        let found = found.map_err(|error| of_steady(&error))?;
        if let Some(warning) = &found.warning {
            py.import("warnings")?.call_method1("warn", (warning,))?;
        }
        let all = PyDict::new(py);
        for (name, _) in &found.observables {
            let column = PyDict::new(py);
            for entry in &found.parameters {
                let parameter = entry.parameter;
                let derivative = found.derivative(name, parameter);
                let value = if logarithmic { found.logarithmic(name, parameter) } else { derivative };
                column.set_item(parameter.name().replace('-', "_"), value.unwrap_or(f64::NAN))?;
            }
            let known = match *name {
                "c_max" => "concentration_max",
                "c_min" => "concentration_min",
                other => other,
            };
            all.set_item(known, column)?;
        }
        Ok(all)
    }

    /// Picture and what is measured, for notebooks.
    fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("motile._html")?.call_method1("of_steady", (slf,))
    }

    fn __repr__(&self) -> PyResult<String> {
        Ok(format!("<steady state: speed {:.6}, residual {:.0e}>", self.speed()?, self.residual()))
    }
}

impl SteadyState {
    fn of_disturbances(&self, py: Python<'_>) -> PyResult<Spectrum> {
        let state = self.state.clone();
        unless_interrupted(py, None, move |_| state.spectrum())?.map_err(|error| of_steady(&error))
    }
}

/// Steady state of a setup with one droplet. With `near`, the state of a similar setup, the search starts from that
/// state, which takes less time and stays on its branch.
#[pyfunction]
#[pyo3(signature = (setup, *, near=None))]
pub(crate) fn steady(
    py: Python<'_>,
    setup: &Bound<'_, Setup>,
    near: Option<&Bound<'_, SteadyState>>,
) -> PyResult<SteadyState> {
    let description = setup.get().description.clone();
    let near = near.map(|near| near.get().state.clone());
    let found = unless_interrupted(py, None, move |_| match near {
        Some(near) => near.follow(&description),
        None => motile_steady_states::SteadyState::find(&description),
    })?;
    Ok(SteadyState { state: found.map_err(|error| of_steady(&error))? })
}

/// Branch of steady states along a parameter: values, speeds, largest growth rates, numbers of growing disturbances,
/// special points (kind, value), the reason why it ends, and the states.
#[pyfunction]
#[pyo3(signature = (start, parameter, stop, largest_step=0.05, most_points=400, tick=None))]
pub(crate) fn branch<'py>(
    py: Python<'py>,
    start: &Bound<'py, SteadyState>,
    parameter: &str,
    stop: f64,
    largest_step: f64,
    most_points: usize,
    tick: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let known = parameter_of(parameter)?;
    let start = start.get().state.clone();
    let from = known.get(start.setup()).unwrap_or(f64::NAN);
    let settings = Continuation { largest_step, most_points, ..Continuation::new(known, from, stop) };
    let found = unless_interrupted(py, tick, move |go_on| settings.follow(&start, |point, _| go_on(point.value)))?;
    let found = found.map_err(|error| of_steady(&error))?;
    let dict = PyDict::new(py);
    let speeds = found.points.iter().map(|point| Ok(point.state.measured()?.speed)).collect::<Result<Vec<_>, _>>();
    let growth =
        |point: &motile_steady_states::BranchPoint| point.spectrum.leading().map_or(f64::NAN, |mode| mode.value.re);
    let unstable = found.points.iter().map(|point| point.spectrum.unstable() as i64).collect();
    let errors = found.points.iter().map(|point| point.spectrum.error).collect();
    let special: Vec<(&str, f64)> = found.special.iter().map(|point| (point.kind.name(), point.value)).collect();
    dict.set_item("values", PyArray1::from_vec(py, found.points.iter().map(|point| point.value).collect()))?;
    dict.set_item("speeds", PyArray1::from_vec(py, speeds.map_err(|error: SteadyError| of_steady(&error))?))?;
    dict.set_item("growth_rates", PyArray1::from_vec(py, found.points.iter().map(growth).collect()))?;
    dict.set_item("growth_rate_errors", PyArray1::from_vec(py, errors))?;
    dict.set_item("unstable", PyArray1::<i64>::from_vec(py, unstable))?;
    dict.set_item("special", special)?;
    dict.set_item("end", found.end.to_string())?;
    let states = found.points.into_iter().map(|point| Py::new(py, SteadyState { state: point.state }));
    dict.set_item("states", states.collect::<PyResult<Vec<_>>>()?)?;
    Ok(dict)
}
