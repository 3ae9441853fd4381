//! Studies of channels.

use motile::base::Region;
use motile::ib_core::AnyKernel;
use motile::scene::StepSize;
use motile::setup::{DropletSetup, GridMethod, Method, Particles, Setup};
use motile_tests::validation::scene::{on_grid, open_channel};
use motile_tests::validation::swimmers::{speeds, steady};
use motile_tests::validation::{Case, StudyError, Table, channel, lateral, order};

use crate::validation::{Tables, per_cent, spacings};

/// A droplet of an activity in a channel, by default and by the method of Cowley with steps of 0.1 h, each with its
/// name.
fn presets(region: Region, viscosity: f64, activity: f64, h: f64) -> [(&'static str, Setup); 2] {
    let default = Setup { region, viscosity, droplets: vec![DropletSetup::active(activity)], ..on_grid(h) };
    let mut droplet = DropletSetup::thesis();
    droplet.particles = droplet.particles.map(|particles| Particles { activity, ..particles });
    let method = Method::Grid(GridMethod { spacing: h, ..GridMethod::thesis() });
    let step = StepSize::Fixed(0.1 * h);
    let thesis = Setup { region, viscosity, method, step, droplets: vec![droplet], ..Setup::thesis() };
    [("default", default), ("thesis", thesis)]
}

pub(crate) fn channel_shapes(quick: bool) -> Tables {
    let (kernel, spacings) = (AnyKernel::BSpline4, spacings(quick));
    let mut points = Table::new(
        "Point forces in a channel: largest error of 4 pi eta times the velocity",
        &["drive", "errors at h = 0.1, 0.05, 0.025", "order"],
    );
    let mut shapes = Table::new(
        "Fixed shapes in a channel: errors in % at h = 0.1, 0.05, 0.025",
        &[
            "drive",
            "shape",
            "height",
            "markers, largest",
            "order",
            "field, largest",
            "order",
            "flux or gradient",
            "wall shear",
        ],
    );
    for (name, drive) in channel::drives() {
        let errors =
            spacings.iter().map(|&h| channel::point_forces(&kernel, h, drive)).collect::<Result<Vec<_>, _>>()?;
        let list: Vec<String> = errors.iter().map(|e| format!("{e:.2e}")).collect();
        points.push([name.to_owned(), list.join(" / "), format!("{:.2}", order(spacings, &errors))]);
        for (case, height) in
            [(Case::Circle, 0.0), (Case::Circle, 0.3), (Case::EllipseUniform, 0.0), (Case::EllipseGradient, 0.0)]
        {
            let rows = spacings
                .iter()
                .map(|&h| channel::fixed_shape(&kernel, true, h, drive, case, height))
                .collect::<Result<Vec<_>, _>>()?;
            let list = |value: fn(&channel::ShapeErrors) -> f64| {
                let errors: Vec<f64> = rows.iter().map(value).collect();
                (errors.iter().map(|&e| per_cent(e)).collect::<Vec<_>>().join(" / "), order(spacings, &errors))
            };
            let (markers, first) = list(|row| row.markers.maximum);
            let (field, second) = list(|row| row.field);
            let (first, second) = (format!("{first:.2}"), format!("{second:.2}"));
            let [driven, shear] = [list(|row| row.drive).0, list(|row| row.wall_shear).0];
            let (name, case, height) = (name.to_owned(), case.name().to_owned(), height.to_string());
            shapes.push([name, case, height, markers, first, field, second, driven, shear]);
        }
    }
    Ok(vec![points, shapes])
}

pub(crate) fn channel_swimmers(quick: bool) -> Tables {
    let mut table = Table::new(
        "Steady swimmers in channels (period 12, A = 10): errors in % of speed, aspect ratio, stresslet, beta, flux, \
         gap",
        &["width", "activity", "preset", "h", "errors", "area change", "particle change"],
    );
    for (width, activity, time) in
        [(2.0, -2.0, 160.0), (2.0, -4.0, 160.0), (3.0, -2.0, 80.0), (5.0, -2.0, 80.0), (5.0, -4.0, 60.0)]
    {
        for &h in spacings(quick) {
            for (name, setup) in presets(open_channel(12.0, width), 100.0, activity, h) {
                let start = [width.to_string(), activity.to_string(), name.to_owned(), h.to_string()];
                match steady(&setup, time) {
                    Ok(e) => {
                        let [flux, gap] = [e.flux, e.gap].map(|error| error.unwrap_or(f64::NAN));
                        let list = [e.speed, e.aspect_ratio, e.stresslet, e.beta, flux, gap].map(per_cent);
                        let rest =
                            [list.join(" / "), format!("{:.1e}", e.area_change), format!("{:.0e}", e.particle_change)];
                        table.push(start.into_iter().chain(rest));
                    }
                    Err(StudyError::Scene(error)) => {
                        table.push(start.into_iter().chain([format!("ends: {error}"), String::new(), String::new()]));
                    }
                    Err(error) => return Err(error),
                }
            }
        }
    }
    Ok(vec![table])
}

pub(crate) fn channel_length(quick: bool) -> Tables {
    let h = if quick { 0.1 } else { 0.05 };
    let title = format!("Speed in a channel of width 2 R0 against its length, h = {h}, A = 10");
    let mut table =
        Table::new(&title, &["activity", "viscosity", "length", "default", "thesis preset", "fit of Cowley"]);
    // |v| = a exp(-l/10) + b, Cowley figures 3.1 and 3.2.
    let fits = [
        (-2.0, 100.0, 0.20, 0.016),
        (-4.0, 100.0, 0.34, 0.051),
        (-5.0, 100.0, 0.42, 0.061),
        (-4.0, 50.0, 0.54, 0.094),
        (-4.0, 200.0, 0.22, 0.012),
    ];
    for (activity, viscosity, a, b) in fits {
        for length in [8.0_f64, 12.0, 24.0, 36.0] {
            let mut row = vec![activity.to_string(), viscosity.to_string(), length.to_string()];
            for (_, setup) in presets(open_channel(length, 2.0), viscosity, activity, h) {
                row.push(match speeds(&setup, &[if quick { 60.0 } else { 120.0 }]) {
                    Ok(speeds) => format!("{:.4}", speeds[0]),
                    Err(StudyError::Scene(error)) => format!("ends: {error}"),
                    Err(error) => return Err(error),
                });
            }
            row.push(format!("{:.4}", a * (-length / 10.0).exp() + b));
            table.push(row);
        }
    }
    Ok(vec![table])
}

/// The methods of the lateral studies: name and spacing.
fn methods(quick: bool) -> Vec<(&'static str, String, Setup)> {
    let grid = |h: f64| ("immersed boundary", h.to_string(), on_grid(h));
    let mut all = vec![("boundary integral", String::new(), Setup::default()), grid(0.1)];
    if !quick {
        all.push(grid(0.05));
    }
    all
}

/// Scene with a droplet in a channel of width 5 and period 12, off the centre line.
fn off_centre(base: Setup, activity: f64, offset: f64) -> Setup {
    let droplet = DropletSetup { centre: [0.0, offset], ..DropletSetup::active(activity) };
    Setup { region: open_channel(12.0, 5.0), droplets: vec![droplet], ..base }
}

pub(crate) fn sideways(quick: bool) -> Tables {
    let mut modes = Table::new(
        "Lateral offset in a channel (width 5, period 12, A = 10): growth rate and angular frequency",
        &["activity", "method", "h", "offset", "growth rate", "reference", "frequency", "reference"],
    );
    for (activity, time) in [(-2.0, 300.0), (-4.0, 140.0)] {
        let (growth, frequency) = lateral::reference(activity)?;
        for (method, h, base) in methods(quick) {
            // On a grid an offset below the spacing is held by the grid; one of some spacings is no longer linear.
            let offset = if h.is_empty() { 0.01 } else { 0.2 };
            let mode = lateral::mode(&off_centre(base, activity, offset), 60.0, time)?;
            modes.push([
                activity.to_string(),
                method.to_owned(),
                h,
                offset.to_string(),
                format!("{:.5}", mode.growth_rate.value),
                format!("{growth:.5}"),
                mode.frequency.map_or_else(|| "none".to_owned(), |w| format!("{:.5}", w.value)),
                format!("{frequency:.5}"),
            ]);
        }
    }
    let mut cycle = Table::new(
        "Limit cycle: width 5, period 12, activity -5, A = 10 (reference: amplitude 1.257, period 49.9, about 1 %)",
        &["method", "h", "amplitude", "error in %", "period", "error in %"],
    );
    for (method, h, base) in methods(quick) {
        let (amplitude, period) = lateral::limit_cycle(&off_centre(base, -5.0, 1.0), 300.0)?;
        cycle.push([
            method.to_owned(),
            h,
            format!("{amplitude:.4}"),
            per_cent(amplitude / 1.257 - 1.0),
            format!("{period:.2}"),
            per_cent(period / 49.9 - 1.0),
        ]);
    }
    Ok(vec![modes, cycle])
}

pub(crate) fn regimes(_quick: bool) -> Tables {
    let mut table = Table::new(
        "Regimes with A = 13.5, from growth rates by boundary integrals, beside what Cowley reports",
        &["width", "length", "activity", "growth rate", "frequency", "Cowley"],
    );
    for (width, length, activity, said) in [
        (5.0, 12.0, -3.0, "returns to the centre line"),
        (5.0, 12.0, -4.0, "oscillates"),
        (3.0, 12.0, -3.0, "oscillates"),
        (3.0, 12.0, -4.0, "stays on the centre line"),
        (3.0, 18.0, -4.0, "stays on the centre line"),
        (3.0, 24.0, -4.0, "oscillates"),
    ] {
        let droplet = DropletSetup { centre: [0.0, 0.01], ..DropletSetup::contractile(activity, 13.5) };
        let setup = Setup { region: open_channel(length, width), droplets: vec![droplet], ..Setup::default() };
        let mode = lateral::mode(&setup, 60.0, 200.0)?;
        table.push([
            width.to_string(),
            length.to_string(),
            activity.to_string(),
            format!("{:.5}", mode.growth_rate.value),
            mode.frequency.map_or_else(|| "none".to_owned(), |w| format!("{:.4}", w.value)),
            said.to_owned(),
        ]);
    }
    Ok(vec![table])
}
