//! Droplets of another viscosity than the exterior fluid, on the grid.

use motile::active_interface::Flux;
use motile::{Contrast, DropletSetup, GridMethod, Method, Particles, Region, Setup};
use motile_tests::validation::contrast::{
    CostScene, Droplet, Errors, Exact, cold_iterations, field_errors, iterations_in_a_run, layer_errors, ratio_ten,
};
use motile_tests::validation::growth::{Mode, polarisation_rate};
use motile_tests::validation::scene::{on_grid, open_channel, reference, without_grid};
use motile_tests::validation::swimmers::{long_run, speeds, steady};
use motile_tests::validation::{Case, StudyError, Table, order, relaxation};

use crate::validation::{Tables, per_cent, spacings};

fn square(side: f64) -> Region {
    Region::Box { lengths: [side; 2] }
}

/// The same scene with a droplet of an activity and a viscosity in fluid of viscosity 10.
fn viscous(base: Setup, activity: f64, viscosity: f64) -> Setup {
    let droplet = DropletSetup { viscosity: Some(viscosity), ..DropletSetup::active(activity) };
    Setup { viscosity: 10.0, droplets: vec![droplet], ..base }
}

const RATIOS: [f64; 5] = [0.01, 1.0, 10.0, 100.0, 1000.0];

fn list(errors: impl Iterator<Item = f64>) -> String {
    errors.map(per_cent).collect::<Vec<_>>().join(" / ")
}

/// A droplet of a ratio of viscosities.
type Shape = fn(f64) -> Droplet;

pub(crate) fn shapes(quick: bool) -> Tables {
    let spacings = spacings(quick);
    let mut table = Table::new(
        "Fixed shapes of another viscosity in a 6 x 6 box, errors in % at h = R/10, R/20, R/40: velocity of the \
         centroid, root mean square and largest over the markers",
        &["shape, tension", "ratio", "way", "centroid", "rms", "largest", "orders"],
    );
    let shapes: [(&str, Shape); 4] = [
        ("circle, 1 + 0.5 cos", |ratio| Droplet::circle(1, ratio)),
        ("circle, 1 + 0.5 cos 2", |ratio| Droplet::circle(2, ratio)),
        ("circle, 1 + 0.5 cos 3", |ratio| Droplet::circle(3, ratio)),
        ("ellipse, 1 + 0.5 cos", Droplet::ellipse),
    ];
    for (name, shape) in shapes {
        for ratio in RATIOS {
            let exact = Exact::new(square(6.0), &[shape(ratio)], 256)?;
            for smeared in [false, true] {
                let errors = spacings
                    .iter()
                    .map(|&h| Ok(if smeared { exact.smeared_errors(h)? } else { exact.errors(h)? }[0]))
                    .collect::<Result<Vec<Errors>, StudyError>>()?;
                let moves = exact.moves(0);
                let speeds: Vec<f64> = errors.iter().map(|e| e.speed).collect();
                let rms: Vec<f64> = errors.iter().map(|e| e.rms).collect();
                let largest: Vec<f64> = errors.iter().map(|e| e.maximum).collect();
                let speed_order = if moves { format!("{:.2}", order(spacings, &speeds)) } else { "-".to_owned() };
                table.push([
                    name.to_owned(),
                    ratio.to_string(),
                    if smeared { "arithmetic" } else { "sharp" }.to_owned(),
                    if moves { list(speeds.into_iter()) } else { "at rest".to_owned() },
                    list(rms.iter().copied()),
                    list(largest.iter().copied()),
                    format!("{speed_order} / {:.2} / {:.2}", order(spacings, &rms), order(spacings, &largest)),
                ]);
            }
        }
    }
    Ok(vec![table])
}

pub(crate) fn tables(quick: bool) -> Tables {
    let mut shapes = Table::new(
        "Ratio 10, 6 x 6 box, largest errors in %: markers, field points inside and outside (as close as 0.05), second \
         and third moments",
        &["shape, tension", "h", "markers", "inside", "outside", "second moments", "third moments"],
    );
    for case in Case::ALL {
        for &h in spacings(quick) {
            let row = ratio_ten(case, h)?;
            let third = if row.third.is_nan() { "-".to_owned() } else { per_cent(row.third) };
            let [markers, inside, outside, second] = [row.markers, row.inside, row.outside, row.second].map(per_cent);
            shapes.push([case.name().to_owned(), h.to_string(), markers, inside, outside, second, third]);
        }
    }
    let mut relaxing = Table::new(
        "Relaxation of an ellipse ten times as viscous as the exterior fluid to t = 2",
        &["h", "dt", "error of the aspect ratio", "relative change of the area"],
    );
    for &h in spacings(quick) {
        for dt in [0.04, 0.01] {
            let run = relaxation::run_with_ratio(h, dt, 10)?;
            let (error, area) = (format!("{:.2e}", run.aspect_ratio_error), format!("{:.1e}", run.area_change));
            relaxing.push([h.to_string(), dt.to_string(), error, area]);
        }
    }
    let mut swimming = Table::new(
        "A steady swimmer, viscosities 100 and 10, activity -1, 6 x 6 box: errors in % of speed, aspect ratio, \
         stresslet, beta, active fraction, maximum concentration",
        &["h", "errors", "area change", "steps"],
    );
    for &h in spacings(quick) {
        let errors = steady(&reference(viscous(on_grid(h), -1.0, 100.0), -1.0), 60.0)?;
        let area = format!("{:.1e}", errors.area_change);
        swimming.push([h.to_string(), list(errors.list().into_iter()), area, errors.steps.to_string()]);
    }
    Ok(vec![shapes, relaxing, swimming])
}

pub(crate) fn close(quick: bool) -> Tables {
    let spacings = spacings(quick);
    let mut table = Table::new(
        "Close to each other and to walls, gaps of 1.5 times 0.05: errors in % at h = 0.1, 0.05, 0.025 against \
         boundary integrals",
        &["scene", "droplet", "centroid", "rms", "largest", "orders"],
    );
    for (name, region, droplets) in Droplet::close_scenes() {
        let exact = Exact::new(region, &droplets, 256)?;
        let found = spacings.iter().map(|&h| exact.errors(h)).collect::<Result<Vec<_>, StudyError>>()?;
        for (index, droplet) in droplets.iter().enumerate() {
            let of = |value: fn(&Errors) -> f64| found.iter().map(|errors| value(&errors[index])).collect::<Vec<f64>>();
            let (speeds, rms, largest) = (of(|e| e.speed), of(|e| e.rms), of(|e| e.maximum));
            let orders = [&speeds, &rms, &largest].map(|errors| format!("{:.2}", order(spacings, errors)));
            table.push([
                name.to_owned(),
                format!("ratio {}", droplet.ratio),
                list(speeds.into_iter()),
                list(rms.into_iter()),
                list(largest.into_iter()),
                orders.join(" / "),
            ]);
        }
    }
    Ok(vec![table])
}

pub(crate) fn field(quick: bool) -> Tables {
    let mut table = Table::new(
        "Flow away from the markers, largest errors in %: velocity (of the fastest marker), gradient (of that over R), \
         pressure (of its range)",
        &["region", "ratio", "h", "inside, nearer than 3h", "outside, nearer than 3h", "inside", "outside"],
    );
    for (name, region) in [("box 6", square(6.0)), ("channel 6 x 4", open_channel(6.0, 4.0))] {
        for ratio in [0.01, 10.0, 100.0, 1000.0] {
            let droplet = Droplet::ellipse(ratio).at(0.02, 0.03);
            for &h in spacings(quick) {
                let errors = field_errors(region, &droplet, h)?;
                let row = errors.map(|e| list([e.velocity, e.gradient, e.pressure].into_iter()));
                table.push([name.to_owned(), ratio.to_string(), h.to_string()].into_iter().chain(row));
            }
        }
    }
    Ok(vec![table])
}

pub(crate) fn iterations(quick: bool) -> Tables {
    let mut cold = Table::new(
        "Conjugate gradients for a smeared droplet (radius 1, tension 10 + 3 cos + 2 cos 2 + cos 3), cold: iterations \
         to 1e-4 / 1e-6 / 1e-8, and the true residual at the last",
        &["region", "ratio", "64", "128", "256"],
    );
    for (name, region) in [("box 4 x 4", square(4.0)), ("channel 4 x 4", open_channel(4.0, 4.0))] {
        for ratio in [10.0, 100.0, 1000.0] {
            let mut row = vec![name.to_owned(), ratio.to_string()];
            for cells in [64.0, 128.0, 256.0] {
                let mut counts = Vec::new();
                let mut residual = 0.0;
                for tolerance in [1e-4, 1e-6, 1e-8] {
                    let found = cold_iterations(region, 4.0 / cells, ratio, tolerance)?;
                    counts.push(found.most.to_string());
                    residual = found.residual;
                }
                row.push(format!("{} ({residual:.1e})", counts.join(" / ")));
            }
            cold.push(row);
        }
    }
    let mut warm = Table::new(
        "The same for a swimmer, activity -4, 6 x 6 box: 100 steps after t = 1, each solve from the linear \
         extrapolation of the two before: mean iterations a solve, most, largest true residual",
        &["ratio", "h", "dt", "to 1e-4", "to 1e-6"],
    );
    for ratio in [10.0, 100.0, 1000.0] {
        for &h in if quick { &[0.1][..] } else { &[0.1, 0.05][..] } {
            for dt in [0.01, 0.002] {
                let mut row = vec![ratio.to_string(), h.to_string(), dt.to_string()];
                for tolerance in [1e-4, 1e-6] {
                    let found = iterations_in_a_run(h, ratio, tolerance, dt, 100)?;
                    row.push(format!("{:.1}, {}, {:.1e}", found.mean, found.most, found.residual));
                }
                warm.push(row);
            }
        }
    }
    let mut layer = Table::new(
        "A smooth layer, a flow that is known: largest errors of velocity and pressure in % on 32, 64, 128, 256 \
         squared, orders, iterations to 1e-10",
        &["region", "ratio", "velocity", "pressure", "orders", "iterations"],
    );
    let cells = [32_usize, 64, 128, 256];
    for walls in [false, true] {
        for ratio in [10.0, 100.0, 1000.0] {
            let found = cells.iter().map(|&n| layer_errors(ratio, walls, n)).collect::<Result<Vec<_>, StudyError>>()?;
            let spacings = cells.map(|n| 1.0 / n as f64);
            let velocity: Vec<f64> = found.iter().map(|e| e.velocity).collect();
            let pressure: Vec<f64> = found.iter().map(|e| e.pressure).collect();
            let orders = [&velocity, &pressure].map(|errors| format!("{:.2}", order(&spacings[1..], &errors[1..])));
            let counts: Vec<String> = found.iter().map(|e| e.iterations.to_string()).collect();
            layer.push([
                if walls { "channel" } else { "box" }.to_owned(),
                ratio.to_string(),
                list(velocity.into_iter()),
                list(pressure.into_iter()),
                orders.join(" / "),
                counts.join(" / "),
            ]);
        }
    }
    Ok(vec![cold, warm, layer])
}

pub(crate) fn decay(quick: bool) -> Tables {
    let mut table = Table::new(
        "Activity -1, viscosities 1000 inside and 10 outside: growth rate of a small polarisation",
        &["box", "way", "h", "rate", "error in %"],
    );
    let grid = |h: f64| viscous(on_grid(h), -1.0, 1000.0);
    // Cowley's motion of markers and area constraint, with the default flux.
    let mut thesis = DropletSetup { viscosity: Some(1000.0), ..DropletSetup::thesis() };
    thesis.particles = Some(Particles { activity: -1.0, flux: Flux::default(), ..Particles::default() });
    let arithmetic = |h: f64| {
        let method = Method::Grid(GridMethod { spacing: h, ..GridMethod::thesis() });
        Setup { viscosity: 10.0, method, droplets: vec![thesis.clone()], ..Setup::default() }
    };
    for side in [6.0, 3.0] {
        let rate = |setup: Setup| polarisation_rate(&Setup { region: square(side), ..setup });
        let exact = rate(viscous(without_grid(64, 252), -1.0, 1000.0))?;
        let mut push = |way: &str, h: String, rate: f64| {
            let error = if way == "without a grid" { "-".to_owned() } else { per_cent((rate - exact) / exact.abs()) };
            table.push([side.to_string(), way.to_owned(), h, format!("{rate:.5}"), error]);
        };
        push("linear theory, no box", "-".to_owned(), Mode::Concentration(1).theory(&grid(0.05))?);
        push("without a grid", "-".to_owned(), exact);
        for &h in spacings(quick) {
            push("sharp", h.to_string(), rate(grid(h))?);
        }
        let fine = if quick {
            &[0.05][..]
        } else if side == 6.0 {
            &[0.05, 0.025][..]
        } else {
            &[0.05, 0.025, 0.0125]
        };
        for &h in fine {
            push("arithmetic", h.to_string(), rate(arithmetic(h))?);
        }
    }
    let mut polarised = Table::new(
        "The same from the polarised start, 6 x 6 box: speed at three times",
        &["way", "h", "t = 20", "t = 40", "t = 60"],
    );
    let fine = if quick { 0.1 } else { 0.05 };
    let smooth = |h: f64| {
        let smooth = GridMethod { corrected: false, contrast: Contrast::Arithmetic, ..GridMethod::of_spacing(h) };
        Setup { method: Method::Grid(smooth), ..grid(h) }
    };
    for (way, spacing, setup) in [
        ("without a grid", "-".to_owned(), viscous(Setup::default(), -1.0, 1000.0)),
        ("sharp", "0.1".to_owned(), grid(0.1)),
        ("sharp", fine.to_string(), grid(fine)),
        ("arithmetic", "0.1".to_owned(), smooth(0.1)),
        ("arithmetic", fine.to_string(), smooth(fine)),
    ] {
        let speeds = speeds(&setup, &[20.0, 40.0, 60.0])?;
        polarised.push([way.to_owned(), spacing].into_iter().chain(speeds.iter().map(|v| format!("{v:.2e}"))));
    }
    Ok(vec![table, polarised])
}

pub(crate) fn runs(quick: bool) -> Tables {
    let mut table = Table::new(
        "Ratio 100 (viscosities 1000 and 10), activity -7, A = 10, 6 x 6 box: a long run",
        &["until", "h", "speed", "spread of speed in the second half", "largest area change"],
    );
    let time = if quick { 10.0 } else { 50.0 };
    for h in [0.1, 0.05] {
        let run = long_run(&viscous(on_grid(h), -7.0, 1000.0), time)?;
        table.push([
            time.to_string(),
            h.to_string(),
            format!("{:.6}", run.speed),
            format!("{:.1e}", run.speed_spread),
            format!("{:.1e}", run.area_change),
        ]);
    }
    Ok(vec![table])
}

pub(crate) fn cost(quick: bool) -> Tables {
    let mut table = Table::new(
        "Cost of an evaluation of a droplet that moves by 0.002 between evaluations: time, in units of a forward and \
         an inverse real transform of the grid, solves on the grid, iterations",
        &["scene", "h", "ratio", "way", "ms", "transform pairs", "solves", "iterations"],
    );
    for &h in if quick { &[0.05][..] } else { &[0.1, 0.05, 0.025][..] } {
        for solid_points in [0, 17_000] {
            for (ratio, smeared) in
                [(1.0, false), (10.0, false), (100.0, false), (1000.0, false), (10.0, true), (100.0, true)]
            {
                if solid_points > 0 && (smeared || h != 0.05) {
                    continue;
                }
                let cost = CostScene { h, ratio, smeared, solid_points }.cost()?;
                table.push([
                    if solid_points > 0 { "channel 12 x 6, 17 000 solid points" } else { "box 6 x 6" }.to_owned(),
                    h.to_string(),
                    ratio.to_string(),
                    if smeared { "arithmetic, 1e-4" } else { "sharp" }.to_owned(),
                    format!("{:.2}", 1e3 * cost.seconds),
                    format!("{:.1}", cost.pairs),
                    format!("{:.1}", cost.solves),
                    format!("{:.1}", cost.iterations),
                ]);
            }
        }
    }
    Ok(vec![table])
}
