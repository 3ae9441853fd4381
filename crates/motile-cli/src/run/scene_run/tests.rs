use super::*;
use motile::setup::{DropletSetup, FlowSetup, IntegralMethod, Method, RigidBodySetup, ShellSetup};

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
    let mut run = SceneRun::new(setup.build().unwrap(), &setup, 0.05, &output, "drop", 0.75).unwrap();
    run.go().unwrap();
    let summary = run.summary().unwrap();
    let [steps, evaluations, time] = ["steps", "evaluations", "time"].map(|name| summary.number(name));
    let steps_taken = run.scene.steps() as f64;
    assert!(steps == steps_taken && steps >= 1.0 && evaluations >= 2.0 * steps, "{steps} {evaluations}");
    assert!((time - 0.05).abs() < 1e-12);
    run.finish(&summary, &Look::default()).unwrap();
    let text = std::fs::read_to_string(directory.join("vtk/fields_0000.vti")).unwrap();
    assert!(text.contains("WholeExtent=\"0 8 0 8 0 0\"") && text.contains("Spacing=\"1.5 1.5 1\""));
    assert!(std::fs::read_to_string(directory.join("flow.csv")).unwrap().starts_with("time,pressure_gradient_x,"));
    for file in ["final.png", "droplets.csv", "summary.json"] {
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
    let mut run = SceneRun::new(setup.build().unwrap(), &setup, 0.2, &output, "bodies", 0.5).unwrap();
    run.go().unwrap();
    let summary = run.summary().unwrap();
    run.finish(&summary, &Look::default()).unwrap();
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
        let found = area(&mut scene, region, droplet).unwrap();
        assert!((found / (size * std::f64::consts::PI) - 1.0).abs() < 1e-3, "{found}");
    }
}
