use super::*;
use motile::setup::{DropletSetup, IntegralMethod, Method};

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
    for file in ["final.png", "droplets.csv", "summary.json"] {
        assert!(directory.join(file).metadata().is_ok_and(|data| data.len() > 100), "{file}");
    }
    std::fs::remove_dir_all(&directory).unwrap();
}
