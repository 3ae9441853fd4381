//! Droplets of another viscosity than the exterior fluid, by layers and smeared over the grid.

use motile::active_interface::Flux;
use motile::base::Region;
use motile::setup::{DropletSetup, GridMethod, LayersMethod, Method, Particles, Setup};
use motile_tests::validation::contrast::{
    CostScene, Droplet, Errors, Exact, cold_iterations, iterations_in_a_run, layer_errors,
};
use motile_tests::validation::growth::{Mode, polarisation_rate};
use motile_tests::validation::scene::{open_channel, without_grid};
use motile_tests::validation::swimmers::{long_run, speeds};
use motile_tests::validation::{StudyError, Table, order};

use crate::validation::{Tables, per_cent, spacings};

fn square(side: f64) -> Region {
    Region::Box { lengths: [side; 2] }
}

/// Scene with a droplet of an activity and a viscosity in fluid of viscosity 10.
fn viscous(base: Setup, activity: f64, viscosity: f64) -> Setup {
    let droplet = DropletSetup { viscosity: Some(viscosity), ..DropletSetup::active(activity) };
    Setup { viscosity: 10.0, droplets: vec![droplet], ..base }
}

/// Nodes of layers, from coarse to fine.
const NODES: [usize; 3] = [16, 32, 64];

/// The default scene by layers.
fn by_layers(nodes: usize) -> Setup {
    let layers = LayersMethod { nodes, elements: 4 * nodes, ..LayersMethod::default() };
    Setup { method: Method::Layers(layers), ..Setup::default() }
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
        "Fixed shapes of another viscosity in a 6 x 6 box, errors in % of layers with 16, 32, 64 nodes and of a \
         smeared viscosity at h = R/10, R/20, R/40: velocity of the centroid, root mean square and largest over the \
         markers",
        &["shape, tension", "ratio", "way", "centroid", "rms", "largest"],
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
            let layers =
                NODES.iter().map(|&nodes| Ok(exact.errors(nodes)?[0])).collect::<Result<Vec<_>, StudyError>>()?;
            let smeared = spacings.iter().map(|&h| Ok(exact.smeared_errors(h)?[0]));
            let smeared = smeared.collect::<Result<Vec<_>, StudyError>>()?;
            for (way, errors) in [("layers", layers), ("arithmetic", smeared)] {
                let of = |value: fn(&Errors) -> f64| list(errors.iter().map(value));
                table.push([
                    name.to_owned(),
                    ratio.to_string(),
                    way.to_owned(),
                    if exact.moves(0) { of(|e| e.speed) } else { "at rest".to_owned() },
                    of(|e| e.rms),
                    of(|e| e.maximum),
                ]);
            }
        }
    }
    Ok(vec![table])
}

pub(crate) fn close(_: bool) -> Tables {
    const NODES: [usize; 3] = [32, 64, 128];
    let mut table = Table::new(
        "Close to each other and to walls, gaps of 0.075: errors in % of layers with 32, 64, 128 nodes",
        &["scene", "droplet", "centroid", "rms", "largest"],
    );
    for (name, region, droplets) in Droplet::close_scenes() {
        let exact = Exact::new(region, &droplets, 256)?;
        let found = NODES.iter().map(|&nodes| exact.errors(nodes)).collect::<Result<Vec<_>, StudyError>>()?;
        for (index, droplet) in droplets.iter().enumerate() {
            let of = |value: fn(&Errors) -> f64| list(found.iter().map(|errors| value(&errors[index])));
            let ratio = format!("ratio {}", droplet.ratio);
            table.push([name.to_owned(), ratio, of(|e| e.speed), of(|e| e.rms), of(|e| e.maximum)]);
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
        &["box", "way", "nodes or h", "rate", "error in %"],
    );
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
            let error = if way == "exact" { "-".to_owned() } else { per_cent((rate - exact) / exact.abs()) };
            table.push([side.to_string(), way.to_owned(), h, format!("{rate:.5}"), error]);
        };
        let theory = Mode::Concentration(1).theory(&viscous(Setup::default(), -1.0, 1000.0))?;
        push("linear theory, no box", "-".to_owned(), theory);
        push("exact", "64".to_owned(), exact);
        for nodes in NODES {
            push("layers", nodes.to_string(), rate(viscous(by_layers(nodes), -1.0, 1000.0))?);
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
        &["way", "nodes or h", "t = 20", "t = 40", "t = 60"],
    );
    let fine = if quick { 0.1 } else { 0.05 };
    let smooth =
        |h: f64| viscous(Setup { method: Method::Grid(GridMethod::uncorrected(h)), ..Setup::default() }, -1.0, 1000.0);
    for (way, resolution, setup) in [
        ("without a grid", "72".to_owned(), viscous(Setup::default(), -1.0, 1000.0)),
        ("layers", "32".to_owned(), viscous(by_layers(32), -1.0, 1000.0)),
        ("arithmetic", "0.1".to_owned(), smooth(0.1)),
        ("arithmetic", fine.to_string(), smooth(fine)),
    ] {
        let speeds = speeds(&setup, &[20.0, 40.0, 60.0])?;
        polarised.push([way.to_owned(), resolution].into_iter().chain(speeds.iter().map(|v| format!("{v:.2e}"))));
    }
    Ok(vec![table, polarised])
}

pub(crate) fn runs(quick: bool) -> Tables {
    let mut table = Table::new(
        "Ratio 100 (viscosities 1000 and 10), activity -7, A = 10, 6 x 6 box: a long run",
        &["until", "nodes", "speed", "spread of speed in the second half", "largest area change"],
    );
    let time = if quick { 10.0 } else { 50.0 };
    for nodes in [48, 72] {
        let run = long_run(&viscous(by_layers(nodes), -7.0, 1000.0), time)?;
        table.push([
            time.to_string(),
            nodes.to_string(),
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
        &["scene", "way", "nodes or h", "ratio", "ms", "transform pairs", "solves", "iterations"],
    );
    let mut push = |scene: CostScene| {
        let cost = scene.cost()?;
        let way = if scene.smeared { "arithmetic, 1e-4" } else { "layers" };
        table.push([
            if scene.solid_points > 0 { "channel 12 x 6, 17 000 solid points" } else { "box 6 x 6" }.to_owned(),
            way.to_owned(),
            if scene.smeared { scene.h.to_string() } else { scene.nodes.to_string() },
            scene.ratio.to_string(),
            format!("{:.2}", 1e3 * cost.seconds),
            format!("{:.1}", cost.pairs),
            format!("{:.1}", cost.solves),
            format!("{:.1}", cost.iterations),
        ]);
        Ok::<(), StudyError>(())
    };
    let usual = CostScene { h: 0.05, nodes: 72, ratio: 1.0, smeared: false, solid_points: 0 };
    for solid_points in [0, 17_000] {
        for nodes in if quick { &[32][..] } else { &[16, 32, 72][..] } {
            for ratio in [1.0, 10.0, 100.0, 1000.0] {
                push(CostScene { nodes: *nodes, ratio, solid_points, ..usual })?;
            }
        }
    }
    for &h in if quick { &[0.05][..] } else { &[0.1, 0.05, 0.025][..] } {
        for ratio in [10.0, 100.0] {
            push(CostScene { h, ratio, smeared: true, ..usual })?;
        }
    }
    Ok(vec![table])
}
