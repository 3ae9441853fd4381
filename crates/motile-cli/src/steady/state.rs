//! One steady state and its stability.

use std::path::Path;
use std::time::Instant;

use anyhow::Result;
use motile::setup::Setup;
use motile_output::CsvTable;
use motile_output::plot::{AxisScale, Figure, Plot, Series};
use motile_steady_states::{Eigenmode, Measured, Spectrum, SteadyState, Symmetry};

use crate::run::{ORIGIN_KEY, Summary, command, make_directory, say};

/// Gap to a wall over the distance of nodes below which there is a warning.
const THIN: f64 = 0.3;
/// Growth rates in the summary.
const LEADING: usize = 5;

/// Parts of a steady state to compute.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Wanted {
    /// The droplet at rest with particles everywhere alike instead of the state that a run settles to.
    pub uniform: bool,
    /// Pictures of the state.
    pub pictures: bool,
    /// Derivatives by the parameters of the scene.
    pub sensitivities: bool,
}

/// Finds the steady state that a run of a scene settles to, by Newton's method, and prints what was measured. Writes to
/// `out`: `summary.json`, the results; `spectrum.csv`, the eigenvalues; and if wanted, `sensitivities.csv`, the
/// derivatives of the results and of the leading growth rate, and `steady_state.svg` (also as PNG), shape,
/// concentration and the leading mode.
///
/// # Errors
/// Returns an error for a scene without such a state; files that cannot be written.
pub fn solve(setup: &Setup, wanted: Wanted, out: &Path) -> Result<()> {
    let Wanted { uniform, pictures, sensitivities } = wanted;
    // The state, and whether it is stable.
    let started = Instant::now();
    let state = if uniform { SteadyState::uniform(setup)? } else { SteadyState::find(setup)? };
    let spectrum = state.spectrum()?;
    let seconds = started.elapsed().as_secs_f64();

    // The results.
    let Measured { speed, stresslet, aspect_ratio, concentration, centroid, .. } = state.measured()?;
    let leading = spectrum.leading();
    let mut summary = Summary::default();
    summary.put("speed", speed, "of the centroid (length/time)");
    summary.put("velocity", state.velocity().to_array().to_vec(), "of the centroid (length/time)");
    summary.put("turning_rate", state.turning_rate(), "of the droplet, counter-clockwise (radians/time)");
    let core_offset = state.profile().nuclei.first().map(|place| (*place - centroid).to_array().to_vec());
    summary.put("core_offset", core_offset, "of the nucleus from the centroid (length)");
    summary.put("stresslet", stresslet, "along the motion");
    summary.put("aspect_ratio", aspect_ratio, "along over across the motion, from area moments; at rest x over y");
    summary.put("c_max", concentration[0], "largest concentration (c0)");
    summary.put("c_min", concentration[1], "smallest concentration (c0)");
    summary.put("stability", spectrum.stability().name(), "by the error of growth rates");
    summary.put("stable", spectrum.stability().decided(), "no disturbance grows; not defined if that is undecided");
    summary.put("leading_growth_rate", leading.map(|mode| mode.value.re), "of the leading mode (1/time)");
    summary.put("leading_frequency", leading.map(|mode| mode.value.im), "of the leading mode (radians/time)");
    summary.put("leading_symmetry", leading.map(|mode| mode.symmetry.name()), "at the x axis");
    let rates: Vec<f64> = spectrum.modes.iter().take(LEADING).map(|mode| mode.value.re).collect();
    summary.put("growth_rates", rates, "of the leading modes (1/time); all are in spectrum.csv");
    summary.put("unstable_modes", spectrum.unstable(), "growing disturbances");
    if let Ok(guidance) = state.guidance() {
        let about = "turning rate over the slope of the activity across the way";
        summary.put("turning_by_gradient", guidance.turning, about);
        summary.put("speed_by_gradient", guidance.speed, "change of the speed over the slope along the way");
        let about = "of the heading by the noise of the particles at strength 1 (1/time)";
        summary.put("rotational_diffusion", guidance.rotational_diffusion, about);
    }
    let gap = state.wall_gap();
    summary.put("wall_gap", gap, "smallest distance of the nodes from the walls (length)");
    summary.put("residual", state.residual(), "largest rate of change left (1/time)");
    let origin = format!("{}; command: {}", setup.origin(), command());
    summary.put(ORIGIN_KEY, origin.as_str(), "of the results");
    summary.put("iterations", state.iterations(), "of Newton's method");
    summary.put("condition", state.condition(), "number of the linear equations");
    summary.put(
        "growth_rate_error",
        spectrum.error,
        "of growth rates (1/time); if stability is undecided, use more nodes",
    );
    summary.put("neutral_rate", spectrum.neutral, "of rigid motions, which should have none (1/time)");
    summary.put("tail", state.tail(), "of Fourier modes: if above 1e-3, use more nodes");
    summary.put("seconds", seconds, "on one core");
    make_directory(out)?;
    let columns = ["growth_rate", "frequency", "antisymmetric"];
    let mut table = CsvTable::with_origin(out.join("spectrum.csv"), &columns, &origin)?;
    for Eigenmode { value, symmetry, .. } in &spectrum.modes {
        table.push(&[value.re, value.im, f64::from(u8::from(*symmetry == Symmetry::Antisymmetric))])?;
    }
    table.flush()?;
    summary.write(&out.join("summary.json"))?;
    say(summary.table().trim_end());
    let spacing = state.measured()?.perimeter / state.profile().nodes() as f64;
    if let Some(gap) = gap.filter(|gap| *gap < THIN * spacing) {
        let advice = "Compare with twice the nodes, because the film may not be resolved";
        say(format_args!("warning: the gap to the wall, {gap:.1e}, is below {THIN} node distances. {advice}"));
    }
    if sensitivities {
        let modes: Vec<Eigenmode> = leading.cloned().into_iter().collect();
        let table = state.sensitivities_with(&modes)?;
        std::fs::write(out.join("sensitivities.csv"), table.csv())?;
        say(format_args!("\n{table}\n"));
    }
    if pictures {
        figure(&state, &spectrum)?.of_origin(origin).write(out, "steady_state")?;
    }
    let rate = leading.map_or(f64::NAN, |mode| mode.value.re);
    let verdict = spectrum.stability().name();
    say(format_args!(
        "{verdict}: the leading growth rate is {rate:.3e} with an error of {:.0e} (1/time)",
        spectrum.error
    ));
    say(format_args!("results in {}", out.display()));
    Ok(())
}

/// Returns the shape, concentration over the arc length, leading mode.
fn figure(state: &SteadyState, spectrum: &Spectrum) -> Result<Figure> {
    let profile = state.profile();
    let (lengths, concentrations) = profile.concentrations()?;
    let mut shape: Vec<(f64, f64)> = profile.positions.iter().map(|x| (x.x, x.y)).collect();
    shape.extend(shape.first().copied());
    let over = |values: Vec<f64>| lengths.iter().copied().zip(values).collect::<Vec<_>>();
    let plot =
        |title: &str, x: &str, y: &str| Plot::new(title).x_axis(x, AxisScale::Linear).y_axis(y, AxisScale::Linear);
    let mut figure = Figure::new(2)
        .panel(plot("Shape", "x (R_{0})", "y (R_{0})").series(Series::line("", shape)))
        .panel(plot("Concentration", "arc length (R_{0})", "c").series(Series::line("", over(concentrations))));
    if let Some(mode) = spectrum.leading() {
        let growing = state.mode_shape(mode)?;
        let title = format!("Leading mode: {:.4} + {:.4} i, {}", mode.value.re, mode.value.im, mode.symmetry.name());
        let parts = |values: &[motile_steady_states::Complex64]| {
            let (re, im) = (values.iter().map(|z| z.re).collect(), values.iter().map(|z| z.im).collect());
            [Series::line("real part", over(re)), Series::line("imaginary part", over(im)).dashed()]
        };
        for (name, values) in [("offset of the shape", &growing.offsets), ("change of c", &growing.concentrations)] {
            let [re, im] = parts(values);
            figure = figure.panel(plot(&title, "arc length (R_{0})", name).series(re).series(im));
        }
    }
    Ok(figure)
}
