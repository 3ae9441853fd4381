use std::path::{Path, PathBuf};

use super::*;
use motile::base::Drive;
use motile::scene::StepSize;
use motile::setup::{
    DropletSetup, ExcludedVolume, FlowSetup, GridMethod, IntegralMethod, Method, RigidBodySetup, ShellSetup,
};

fn directory(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("motile-{name}-{}", std::process::id()))
}

fn output(directory: &Path, no_pictures: bool) -> OutputFlags {
    OutputFlags { no_pictures, quiet: true, out: Some(directory.to_path_buf()), ..OutputFlags::default() }
}

fn run_of(setup: &Setup, end: f64, output: &OutputFlags) -> Result<SceneRun> {
    SceneRun::new(setup.build().unwrap(), setup, end, output, "", &View::of(setup))
}

#[test]
fn a_run_in_a_channel_leaves_all_its_files() {
    let directory = directory("channel-run");
    let region = Region::Channel { length: 6.0, width: 3.0, drive: Drive::ZeroGradient };
    let setup = Setup { region, ..Setup::default() };
    let mut output = output(&directory, false);
    std::fs::create_dir_all(&directory).unwrap();
    output.write_scene = Some(directory.join("scene.toml"));
    let mut run = run_of(&setup, 1.0, &output).unwrap();
    run.go(None).unwrap();
    let summary = run.summary().unwrap();
    run.finish(&summary).unwrap();

    let files = ["final.png", "swim.gif", "time_series.svg", "concentration_profile.png", "trajectory.csv"];
    let files = files.into_iter().chain(["vtk/fields.pvd", "summary.json"]);
    for file in files {
        assert!(directory.join(file).metadata().is_ok_and(|data| data.len() > 200), "{file}");
    }
    let written = std::fs::read_to_string(directory.join("scene.toml")).unwrap();
    assert_eq!(Setup::from_toml(&written).unwrap(), setup);
    let header = std::fs::read_to_string(directory.join("trajectory.csv")).unwrap();
    assert!(header.starts_with("time,x,y,") && header.lines().next().unwrap().contains(",gap,"));
    assert_eq!(summary.number("time"), 1.0);
    // |zeta_dmu| c0 R0/((eta_in + eta_ext) D), and the cost.
    assert_eq!(summary.number("peclet"), setup.numbers(&setup.droplets[0]).unwrap().unwrap().peclet);
    let [steps, evaluations, longest] = ["steps", "evaluations", "dt_longest"].map(|name| summary.number(name));
    assert!(steps >= 1.0 && evaluations >= 2.0 * steps && longest >= 1.0 / steps);
    assert!(summary.number("speed") > 0.05 && summary.number("area_relative_change").abs() < 1e-4);
    std::fs::remove_dir_all(&directory).unwrap();
}

/// Captions tell the range of what differs between droplets.
#[test]
fn captions_are_of_all_droplets() {
    let droplet = |activity, viscosity| DropletSetup { viscosity, ..DropletSetup::active(activity) };
    let of = |droplets| caption(&Setup { droplets, ..Setup::default() }, "w = 3");
    assert_eq!(of(vec![droplet(-2.0, None)]), "ζΔμ = −2,  A = 10,  η = 100,  w = 3");
    let different = vec![droplet(-2.0, None), droplet(-5.0, Some(300.0)), DropletSetup::passive(3.0)];
    assert_eq!(of(different), "ζΔμ = −5 to −2,  A = 10,  η = 100 to 300 in 100,  w = 3");
}

/// Pictures of unbounded fluid show a square of 12 around the droplet in cells of the spacing, files for ParaView in
/// cells of twice that, since every sample without a grid costs as much.
#[test]
fn pictures_of_the_plane_have_the_cells_of_their_spacing() {
    let directory = directory("plane-run");
    let droplet = DropletSetup { centre: [0.4, -0.2], ..DropletSetup::default() };
    let setup = Setup {
        region: Region::Plane,
        method: Method::Integral(IntegralMethod::default()),
        droplets: vec![droplet],
        ..Setup::default()
    };
    let view = View { spacing: 0.75, region: String::new() };
    let run = SceneRun::new(setup.build().unwrap(), &setup, 0.01, &output(&directory, false), "", &view).unwrap();
    let raster = run.raster;
    assert_eq!((raster.cells(), raster.size(), raster.periodic()), ([16; 2], [12.0; 2], [false; 2]));
    let near = |found: Vec2, expected: [f64; 2]| found.distance(expected.into()) < 1e-12;
    let points = raster.points();
    assert!(near(points[0], [-5.6 + 0.375, -6.2 + 0.375]) && near(points[255], [6.4 - 0.375, 5.8 - 0.375]));
    let mut run = run;
    run.go(None).unwrap();
    let summary = run.summary().unwrap();
    run.finish(&summary).unwrap();
    let text = std::fs::read_to_string(directory.join("vtk/fields_0000.vti")).unwrap();
    assert!(text.contains("WholeExtent=\"0 8 0 8 0 0\"") && text.contains("Spacing=\"1.5 1.5 1\""));
    std::fs::remove_dir_all(&directory).unwrap();
}

#[test]
fn rows_are_as_few_as_asked_for() {
    let directory = directory("rows-of-a-run");
    let setup = Setup::default();
    let output = OutputFlags { rows: Some(4), ..output(&directory, true) };
    let mut run = run_of(&setup, 1.0, &output).unwrap();
    run.go(None).unwrap();
    let summary = run.summary().unwrap();
    run.finish(&summary).unwrap();
    let mut table = csv::Reader::from_path(directory.join("trajectory.csv")).unwrap();
    let times: Vec<f64> = table.records().map(|row| row.unwrap()[0].parse().unwrap()).collect();
    // The start, the first steps beyond each quarter, the end.
    assert!(times.len() == 5 && times[0] == 0.0 && times[4] == 1.0, "{times:?}");
    assert!((1..4).all(|k| (0.0..0.1).contains(&(times[k] - 0.25 * k as f64))), "{times:?}");
    std::fs::remove_dir_all(&directory).unwrap();
}

#[test]
fn a_run_that_breaks_off_keeps_what_it_has() {
    // A step that is stable at the start, but not when the particles have gathered.
    let directory = directory("broken-run");
    let setup = Setup {
        region: Region::Box { lengths: [4.0, 4.0] },
        method: Method::Grid(GridMethod::of_spacing(0.1)),
        step: StepSize::Fixed(0.13),
        ..Setup::default()
    };
    let mut run = run_of(&setup, 100.0, &output(&directory, true)).unwrap();
    run.go(None).unwrap();
    let summary = run.summary().unwrap();
    let time = summary.number("time");
    assert!(time > 0.0 && time < 100.0);
    assert_eq!(run.table().unwrap().rows().last().map(|row| row[0]), Some(time));
    let files = std::fs::read_dir(&directory).unwrap().count();
    assert_eq!(files, 1, "without pictures there is the trajectory alone");
    let error = run.finish(&summary).unwrap_err();
    assert_eq!(summary.values()["failure"], error.to_string());
    assert_eq!(summary.values()["finished"], false);
    assert!(directory.join("summary.json").exists());
    std::fs::remove_dir_all(&directory).unwrap();
}

#[test]
fn an_unstable_step_is_refused_before_anything_is_written() {
    let directory = directory("refused-run");
    let setup = Setup { step: StepSize::Fixed(5.0), ..Setup::default() };
    let refused = run_of(&setup, 10.0, &output(&directory, true));
    assert!(refused.unwrap_err().to_string().contains("time step 5"));
    assert!(!directory.exists());
}

/// In unbounded fluid the picture is of a square about the start, with as many cells as the spacing gives.
#[test]
fn a_run_in_the_plane_is_drawn() {
    let directory = directory("plane-again");
    let setup = Setup { region: Region::Plane, ..Setup::default() };
    let mut run = run_of(&setup, 0.1, &output(&directory, false)).unwrap();
    run.go(None).unwrap();
    let summary = run.summary().unwrap();
    run.finish(&summary).unwrap();
    assert!(directory.join("final.png").metadata().is_ok_and(|data| data.len() > 2000));
    std::fs::remove_dir_all(&directory).unwrap();
}

/// Dimensionless numbers and concentrations under their names, and the mean of the iterations of all evaluations.
#[test]
fn results_are_under_their_names() {
    let directory = directory("named-run");
    let mut droplet = DropletSetup { viscosity: Some(300.0), tension: 1500.0, ..DropletSetup::active(-2.0) };
    let particles = droplet.particles.as_mut().unwrap();
    particles.excluded_volume = ExcludedVolume::Step(3.0);
    let method = Method::Integral(IntegralMethod { nodes: 32, elements: 64 });
    let setup = Setup { region: Region::Plane, method, droplets: vec![droplet], ..Setup::default() };
    let mut run = run_of(&setup, 0.05, &output(&directory, true)).unwrap();
    run.go(None).unwrap();
    let summary = run.summary().unwrap();
    std::fs::remove_dir_all(&directory).unwrap();
    let c0 = setup.droplets[0].particles.unwrap().concentration;
    for (name, expected) in [
        ("excluded_volume_ratio", 1.5),
        ("bare_tension_ratio", 1500.0 / (2.0 * c0)),
        ("viscosity_ratio", 3.0),
        ("peclet", setup.numbers(&setup.droplets[0]).unwrap().unwrap().peclet),
    ] {
        assert!((summary.number(name) / expected - 1.0).abs() < 1e-12, "{name}: {}", summary.number(name));
    }
    let [most, least] = ["concentration_max", "concentration_min"].map(|name| summary.number(name));
    assert!((1.5..2.5).contains(&most) && (0.0..0.5).contains(&least), "{most} {least}");
    let [mean, largest] = ["solver_iterations_mean", "solver_iterations_max"].map(|name| summary.number(name));
    assert!(mean > 0.0 && mean <= largest, "{mean} {largest}");
    let work = run.scene.system().hydrodynamics().work();
    assert!((mean * work.evaluations as f64 - work.iterations as f64).abs() < 1e-9, "{mean} {work:?}");
}

/// Concentrations are shown in units of c0 where all droplets have the same one.
#[test]
fn droplets_of_several_concentrations_have_no_common_unit() {
    let unit = |second: f64| {
        let directory = directory(&format!("unit-run-{second}"));
        let mut droplets =
            [-1.5, 1.5].map(|x| DropletSetup { centre: [x, 0.0], ..DropletSetup::active(-1.0) }).to_vec();
        let particles = droplets[1].particles.as_mut().unwrap();
        particles.concentration *= second;
        let run = run_of(&Setup { droplets, ..Setup::default() }, 0.01, &output(&directory, false)).unwrap();
        std::fs::remove_dir_all(&directory).unwrap();
        run.pictures.unwrap().0.concentration
    };
    assert_eq!(unit(1.0), Some(Particles::default().concentration));
    assert_eq!(unit(2.0), None);
}

/// Results tell the cost of the run, pictures show a square of 12 around the droplet in cells of the spacing, and files
/// for ParaView cells of twice that.
#[test]
fn a_passive_drop_leaves_its_results() {
    let directory = std::env::temp_dir().join(format!("motile-scene-run-{}", std::process::id()));
    let droplet = DropletSetup { particles: None, centre: [0.4, -0.2], ..DropletSetup::default() };
    let setup = Setup {
        region: Region::Plane,
        method: Method::Integral(IntegralMethod { nodes: 32, elements: 64 }),
        droplets: vec![droplet],
        ..Setup::default()
    };
    let output = OutputFlags { quiet: true, out: Some(directory.clone()), ..OutputFlags::default() };
    let mut run = {
        let view = View { spacing: 0.75, region: String::new() };
        SceneRun::new(setup.build().unwrap(), &setup, 0.05, &output, "drop", &view).unwrap()
    };
    run.go(None).unwrap();
    let summary = run.summary().unwrap();
    let [steps, evaluations, time] = ["steps", "evaluations", "time"].map(|name| summary.number(name));
    let steps_taken = run.scene.steps() as f64;
    assert!(steps == steps_taken && steps >= 1.0 && evaluations >= 2.0 * steps, "{steps} {evaluations}");
    assert!((time - 0.05).abs() < 1e-12);
    run.finish(&summary).unwrap();
    let text = std::fs::read_to_string(directory.join("vtk/fields_0000.vti")).unwrap();
    assert!(text.contains("WholeExtent=\"0 8 0 8 0 0\"") && text.contains("Spacing=\"1.5 1.5 1\""));
    assert!(std::fs::read_to_string(directory.join("flow.csv")).unwrap().starts_with("time,pressure_gradient_x,"));
    for file in ["final.png", "swim.gif", "droplets.csv", "summary.json"] {
        assert!(directory.join(file).metadata().is_ok_and(|data| data.len() > 100), "{file}");
    }
    std::fs::remove_dir_all(&directory).unwrap();
}

/// A scene without droplets: where its bodies are, how they move, and what the flow does.
#[test]
fn bodies_without_droplets_leave_tables() {
    let directory = std::env::temp_dir().join(format!("motile-scene-run-bodies-{}", std::process::id()));
    let setup = Setup {
        region: Region::Box { lengths: [6.0, 6.0] },
        method: Method::Integral(IntegralMethod { nodes: 32, elements: 64 }),
        flow: FlowSetup { shear: 1.0, ..FlowSetup::default() },
        droplets: Vec::new(),
        rigid_bodies: vec![RigidBodySetup { centre: [-1.5, 0.5], ..RigidBodySetup::disc(0.5) }],
        shells: vec![ShellSetup { centre: [1.5, -0.5], ..ShellSetup::default() }],
        ..Setup::default()
    };
    let output = OutputFlags { quiet: true, no_pictures: true, out: Some(directory.clone()), ..OutputFlags::default() };
    let mut run = run_of(&setup, 0.2, &output).unwrap();
    run.go(None).unwrap();
    let summary = run.summary().unwrap();
    run.finish(&summary).unwrap();
    let rows = |file: &str| -> Vec<Vec<String>> {
        let text = std::fs::read_to_string(directory.join(file)).unwrap();
        text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
    };
    let (bodies, flow) = (rows("bodies.csv"), rows("flow.csv"));
    let column = |table: &[Vec<String>], name: &str| table[0].iter().position(|known| known == name).expect(name);
    let value = |table: &[Vec<String>], row: usize, name: &str| table[row][column(table, name)].parse::<f64>().ok();
    // A disc in a shear turns at about half its rate and moves with the flow at its height; the shell has no spin.
    let (disc, shell) = (bodies.len() - 2, bodies.len() - 1);
    assert!((value(&bodies, disc, "spin").unwrap() + 0.5).abs() < 0.05, "{bodies:?}");
    assert!((value(&bodies, disc, "velocity_x").unwrap() - 0.5).abs() < 0.1, "{bodies:?}");
    assert!((value(&bodies, disc, "angle_degrees").unwrap() + 0.1_f64.to_degrees()).abs() < 0.5, "{bodies:?}");
    assert_eq!(value(&bodies, shell, "spin"), None);
    assert!(value(&bodies, shell, "deformation").unwrap() > 0.01, "{bodies:?}");
    assert!(value(&bodies, shell, "stretch_max").unwrap() > 1.0);
    // The summary has the last rows, by the names of the bodies.
    assert_eq!(Some(summary.number("rigid_body_spin")), value(&bodies, disc, "spin"));
    assert_eq!(Some(summary.number("shell_stretch_max")), value(&bodies, shell, "stretch_max"));
    assert!(!summary.values().contains_key("shell_spin") && !summary.values().contains_key("peclet"));
    // Bodies raise the viscosity.
    assert!(value(&flow, flow.len() - 1, "effective_viscosity").unwrap() > 100.0, "{flow:?}");
    assert_eq!(value(&flow, flow.len() - 1, "time"), value(&bodies, disc, "time"));
    std::fs::remove_dir_all(&directory).unwrap();
}

/// A droplet keeps its area in the plane and its volume in three dimensions.
#[test]
fn droplets_of_revolution_have_a_volume() {
    let method = Method::Integral(IntegralMethod { nodes: 48, elements: 96 });
    for (region, size) in [(Region::Plane, 1.0), (Region::Space, 4.0 / 3.0)] {
        let droplets = vec![DropletSetup::active(-1.0)];
        let built = Setup { region, method, droplets, ..Setup::default() }.build().unwrap();
        let (mut scene, droplet) = (built.scene, built.droplets[0]);
        let found = results::area(&mut scene, region, droplet).unwrap();
        assert!((found / (size * std::f64::consts::PI) - 1.0).abs() < 1e-3, "{found}");
    }
}

/// A post next to a drop that sinks: forces on both, on the walls and along them are in the tables and in the summary,
/// and balance. A channel without such bodies has the forces on its walls in the summary alone.
#[test]
fn a_post_leaves_its_forces() {
    let directory = directory("a-post");
    let drop = DropletSetup {
        particles: None,
        centre: [-1.5, 0.2],
        body_force: [1.0, -2.0],
        name: "heavy drop".to_owned(),
        ..DropletSetup::default()
    };
    let post = RigidBodySetup { held: true, centre: [1.4, -0.3], ..RigidBodySetup::disc(0.5) };
    let setup = Setup {
        region: Region::Channel { length: 6.0, width: 4.0, drive: Drive::Flux(0.5) },
        method: Method::Integral(IntegralMethod { nodes: 48, elements: 96 }),
        droplets: vec![drop],
        rigid_bodies: vec![RigidBodySetup { name: "post".to_owned(), ..post }],
        ..Setup::default()
    };
    let mut run = run_of(&setup, 0.02, &output(&directory, true)).unwrap();
    run.go(None).unwrap();
    let summary = run.summary().unwrap();
    run.finish(&summary).unwrap();
    let area = std::f64::consts::PI;
    let [x, y] = ["heavy_drop_force_x", "heavy_drop_force_y"].map(|name| summary.number(name));
    assert!((x + area).abs() < 1e-6 && (y - 2.0 * area).abs() < 1e-6, "{x} {y}");
    let drag = summary.number("post_force_x");
    assert!((summary.number("force_bodies_x") - x - drag).abs() < 1e-9 * drag && drag > 100.0, "{drag}");
    let walls = summary.number("force_lower") + summary.number("force_upper");
    let drop = summary.number("pressure_drop");
    assert!((4.0 * drop - walls - drag - x).abs() < 1e-9 * drag, "{drop} {walls}");
    assert!(summary.number("force_balance").abs() < 1e-7);
    let read = |file: &str| std::fs::read_to_string(directory.join(file)).unwrap();
    let (forces, shear, bodies) = (read("forces.csv"), read("wall_shear.csv"), read("bodies.csv"));
    assert!(forces.starts_with("time,force_bodies_x,force_bodies_y,pressure_drop,extra_pressure_drop,force_lower,"));
    assert!(bodies.lines().next().is_some_and(|names| names.ends_with("force_x,force_y,torque,origin")), "{bodies}");
    assert!(shear.starts_with("time,x,lower,upper,origin\n") && shear.lines().count() > 2 * WALL_PLACES);
    std::fs::remove_dir_all(&directory).unwrap();

    let setup = Setup { rigid_bodies: Vec::new(), ..setup };
    let mut run = run_of(&setup, 0.02, &output(&directory, true)).unwrap();
    run.go(None).unwrap();
    assert!(run.summary().unwrap().number("force_balance").abs() < 1e-7);
    assert!(!directory.join("forces.csv").exists() && !directory.join("wall_shear.csv").exists());
    std::fs::remove_dir_all(&directory).unwrap();
}
