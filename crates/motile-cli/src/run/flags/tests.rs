use super::*;
use motile::scene::StepSize;
use motile::setup::{GridMethod, Method, Setup};

#[test]
fn a_run_in_two_parts_is_a_whole_one() {
    let directory = std::env::temp_dir().join(format!("motile-flags-{}", std::process::id()));
    make_directory(&directory).unwrap();
    let path = directory.join("state");
    let setup = Setup { method: Method::Grid(GridMethod::of_spacing(0.25)), ..Setup::default() };
    let flags = CheckpointFlags { checkpoint: Some(path.clone()), ..CheckpointFlags::default() };
    let make = || setup.build().unwrap().scene;
    let mut first = make();
    let run = first.run(0.25).step_size(StepSize::Fixed(0.025));
    let outcome = flags.watch(run, "a droplet").unwrap().go();
    assert!(!path.exists(), "there were fewer than 500 steps");
    flags.save(&first, "a droplet", &outcome).unwrap();

    let again = CheckpointFlags { resume: Some(path.clone()), ..CheckpointFlags::default() };
    let mut second = make();
    again.resume(&mut second, "a droplet", 0.5).unwrap();
    second.run(0.5).step_size(StepSize::Fixed(0.025)).go().unwrap();
    first.run(0.5).step_size(StepSize::Fixed(0.025)).go().unwrap();
    assert_eq!(first.checkpoint(""), second.checkpoint(""));
    let error = again.resume(&mut make(), "a droplet", 0.2).unwrap_err();
    assert!(format!("{error:#}").contains("Use a --time above"), "{error:#}");
    std::fs::write(&path, "nothing").unwrap();
    let error = flags.resume(&mut make(), "a droplet", 0.5).unwrap_err();
    assert!(format!("{error:#}").contains("a file with this name exists and is not a checkpoint"), "{error:#}");
    assert!(first.checkpoint("").write(&path).is_err() && std::fs::read(&path).unwrap() == b"nothing");
    let error = again.resume(&mut make(), "a droplet", 0.5).unwrap_err();
    assert!(format!("{error:#}").contains("not a checkpoint"), "{error:#}");
    std::fs::remove_dir_all(&directory).unwrap();
}

#[test]
fn a_file_that_cannot_be_written_is_refused_before_the_first_step() {
    let directory = std::env::temp_dir();
    for path in [directory.clone(), directory.join("motile-no-such-directory").join("state")] {
        let flags = CheckpointFlags { checkpoint: Some(path), ..CheckpointFlags::default() };
        let mut scene = Setup::default().build().unwrap().scene;
        let error = flags.resume(&mut scene, "a droplet", 1.0).unwrap_err();
        assert!(format!("{error:#}").contains("--checkpoint"), "{error:#}");
        assert_eq!(scene.steps(), 0);
    }
}

#[test]
fn scene_files_of_others_are_kept() {
    let path = std::env::temp_dir().join(format!("motile-scene-file-{}.toml", std::process::id()));
    let flags = OutputFlags { write_scene: Some(path.clone()), ..OutputFlags::default() };
    for viscosity in [100.0, 50.0] {
        let setup = Setup { viscosity, ..Setup::default() };
        flags.write_scene(&setup).unwrap();
        assert_eq!(Setup::from_toml(&std::fs::read_to_string(&path).unwrap()).unwrap(), setup);
    }
    std::fs::write(&path, "# My scene.\n").unwrap();
    let error = flags.write_scene(&Setup::default()).unwrap_err().to_string();
    assert!(error.contains("a file with this name exists, and no run has written it"), "{error}");
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "# My scene.\n");
    std::fs::remove_file(&path).unwrap();
}
