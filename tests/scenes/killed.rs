//! A program that is killed while it runs leaves a complete checkpoint, at whatever moment.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant, SystemTime};

use motile::scene::{Scene, checkpoint::Checkpoint};
use motile::setup::{AnyFlow, GridMethod, Method, Setup};

/// Where the program that is killed finds the path of its checkpoint.
const PATH: &str = "MOTILE_KILLED_RUN";

fn scene() -> Scene<AnyFlow> {
    let setup = Setup { method: Method::Grid(GridMethod::of_spacing(0.1)), ..Setup::default() };
    setup.build().expect("a scene").scene
}

/// The program that is killed: goes on from the checkpoint, if there is one, and saves one after each step.
#[test]
#[ignore = "runs until it is killed, as part of the test below"]
fn runs_until_killed() {
    let path = PathBuf::from(std::env::var_os(PATH).expect("a path"));
    let mut scene = scene();
    if path.exists() {
        scene.resume(&Checkpoint::read(&path).expect("a complete checkpoint")).expect("the same scene");
    }
    scene.run(1e6).save(1, &path, "to be killed").go().expect("a long run");
}

/// When a file was last written.
fn written(path: &Path) -> Option<SystemTime> {
    path.metadata().and_then(|file| file.modified()).ok()
}

#[test]
fn checkpoints_of_a_killed_program_are_complete() {
    let directory = std::env::temp_dir().join(format!("motile-killed-{}", std::process::id()));
    std::fs::create_dir_all(&directory).expect("a directory");
    let path = directory.join("state");
    let program = std::env::current_exe().expect("this program");
    let (mut steps, mut moment) = (0, 12_345_u64);
    for _ in 0..20 {
        let (before, start) = (written(&path), Instant::now());
        let mut child = Command::new(&program)
            .args(["--ignored", "--exact", "killed::runs_until_killed"])
            .env(PATH, &path)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("the program");
        // A loaded machine may take long to start it.
        while written(&path) == before && start.elapsed() < Duration::from_secs(60) {
            std::thread::sleep(Duration::from_millis(1));
        }
        moment = moment.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        std::thread::sleep(Duration::from_micros(moment >> 46));
        assert!(child.try_wait().expect("its state").is_none(), "the program ended by itself");
        child.kill().expect("a program that can be killed");
        child.wait().expect("its end");

        let checkpoint = Checkpoint::read(&path).expect("a complete checkpoint");
        assert!(checkpoint.steps() > steps);
        steps = checkpoint.steps();
        let mut scene = scene();
        scene.resume(&checkpoint).expect("the same scene");
        scene.step(1e-3).expect("a step");
    }
    std::fs::remove_dir_all(&directory).expect("a directory that can be removed");
}
