//! Runs of the examples that are killed late and go on from their checkpoints, against runs that are not: their results
//! are the same bytes, but for the seconds that they took.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::Duration;

use motile::scene::checkpoint::Checkpoint;
use motile_cli::run::Summary;

/// Part of a run after which it is killed.
const LATE: f64 = 0.8;

/// The program of an example, which `cargo test` builds beside this one's directory.
fn program(example: &str) -> PathBuf {
    let here = std::env::current_exe().expect("this program");
    let path = here.parent().and_then(Path::parent).expect("a directory").join("examples").join(example);
    assert!(path.exists(), "{} is not built: cargo build --release -p motile-examples --examples", path.display());
    path
}

fn start(example: &str, flags: &[&str], out: &Path) -> Child {
    Command::new(program(example))
        .args(flags)
        .args(["--quiet", "--out"])
        .arg(out)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the example")
}

fn finish(mut child: Child) -> ExitStatus {
    child.wait().expect("its end")
}

/// Kills a run when a checkpoint of a time after `time` is there; a run ends of itself, which is then a failure.
fn kill_after(time: f64, checkpoint: &Path, mut child: Child) {
    while Checkpoint::read(checkpoint).map_or(0.0, |saved| saved.time()) < time {
        let ended = child.try_wait().expect("its state");
        assert!(ended.is_none(), "it ended before it was killed: {ended:?}");
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().expect("a run that can be killed");
    child.wait().expect("its end");
}

/// Texts of the results of a run: `summary.json` without the wall clock time, and `trajectory.csv`.
fn results(out: &Path) -> [String; 2] {
    let summary = Summary::read(&out.join("summary.json")).expect("a summary").expect("results");
    let mut values = summary.values().clone();
    assert!(values.shift_remove("seconds").is_some_and(|seconds| seconds.as_f64() > Some(0.0)));
    let table = fs::read_to_string(out.join("trajectory.csv")).expect("a table");
    [format!("{:#}", serde_json::Value::Object(values)), table]
}

/// Compares a run to `time` that is killed late, and goes on with its results elsewhere, with one that is not.
fn compare(example: &str, time: &str, flags: &str) {
    let directory = std::env::temp_dir().join(format!("motile-resumed-{example}-{}", std::process::id()));
    fs::create_dir_all(&directory).expect("a directory");
    let [whole, first, rest] = ["whole", "first", "rest"].map(|name| directory.join(name));
    let flags: Vec<&str> = flags.split(' ').chain(["--time", time]).collect();
    let ended = finish(start(example, &flags, &whole));
    let state = directory.join("state");
    let state_flag = state.to_str().expect("a path");
    let saved = [flags.as_slice(), &["--checkpoint", state_flag, "--checkpoint-every", "7"]].concat();
    kill_after(LATE * time.parse::<f64>().expect("a time"), &state, start(example, &saved, &first));
    let resumed = [saved.as_slice(), &["--resume", state_flag]].concat();
    assert_eq!(finish(start(example, &resumed, &rest)), ended, "{example}");
    let [whole_results, rest_results] = [&whole, &rest].map(|out| results(out));
    assert_eq!(rest_results, whole_results, "{example}: the resumed run and the whole one");
    if !flags.contains(&"--no-pictures") {
        let list = |out: &Path| fs::read_to_string(out.join("vtk/interface.pvd")).expect("a list of files");
        assert!(list(&whole).matches("DataSet").count() > 15);
        // The files from before are in the other directory.
        assert!(
            list(&rest).matches("DataSet").count() > 2
                && list(&rest).lines().skip(3).all(|line| list(&whole).contains(line))
        );
    }
    fs::remove_dir_all(&directory).expect("a directory that can be removed");
}

/// The droplet swings from wall to wall: amplitude, regime and period come from the whole record.
#[test]
fn a_swing_across_a_channel() {
    let flags = "--width 5 --length 8 --lateral-offset 0.4 --activity -4 --nodes 24 --no-pictures";
    compare("rigid_channel", "60", flags);
}

#[test]
fn a_box() {
    compare("swimming_droplet", "20", "--nodes 24 --spacing 0.2 --method integral");
    compare("swimming_droplet", "4", "--method grid --spacing 0.1 --dt adaptive --no-pictures");
}

/// The solver's iterations are those of the whole run, and so are the warnings, which stop with the edge of the
/// concentration.
#[test]
fn viscosities_and_warnings() {
    compare(
        "swimming_droplet",
        "6",
        "--nodes 24 --elements 48 --viscosity-in 500 --viscosity-out 5 --activity -8 --no-pictures",
    );
}

#[test]
fn curved_walls() {
    compare("rigid_geometry", "16", "--nodes 24 --wall-spacing 0.2 --length 4 --no-pictures");
}

#[test]
fn elastic_walls() {
    compare("elastic_channel", "6", "--spacing 0.2 --nodes 24 --no-pictures");
    compare("custom_geometry", "2", "--spacing 0.2 --nodes 24 --width 3 --no-pictures");
    compare("viscoelastic_channel", "3", "--spacing 0.2 --nodes 24 --no-pictures");
    compare("twitching_walls", "3", "--spacing 0.2 --nodes 24 --no-pictures");
    compare("constriction", "6", "--spacing 0.2 --nodes 24 --length 8 --throat 1.6 --width 2.4 --no-pictures");
}

#[test]
fn what_is_inside() {
    compare("nucleus", "4", "--nodes 24 --no-pictures");
    compare("exchange", "10", "--nodes 24 --no-pictures");
    compare("exchange", "1.2", "--nodes 24 --bulk-diffusion 0.5 --no-pictures");
    compare("active_gel", "40", "--spacing 0.2 --no-pictures");
}

/// A run that breaks off, and one that does not.
#[test]
fn two_that_meet() {
    compare("two_droplets", "13", "--nodes 24 --distance 3 --lateral-offset 0 --no-pictures");
    compare("two_droplets", "13", "--nodes 24 --distance 3 --lateral-offset 0 --repulsion 10,0.1 --no-pictures");
}

/// How long the default run takes stands in the help, in what does not depend on the machine.
#[test]
fn help_tells_how_long_the_default_takes() {
    for example in [
        "active_gel",
        "active_walls",
        "constriction",
        "custom_geometry",
        "elastic_channel",
        "exchange",
        "nucleus",
        "rigid_channel",
        "rigid_geometry",
        "suspension",
        "swimming_droplet",
        "twitching_walls",
        "two_droplets",
        "viscoelastic_channel",
    ] {
        let told = Command::new(program(example)).arg("--help").output().expect("help");
        let told = String::from_utf8(told.stdout).expect("text");
        let line = told.lines().find(|line| line.starts_with("The default run takes ")).expect(example);
        let numbers: Vec<usize> = line.split(' ').filter_map(|word| word.replace(',', "").parse().ok()).collect();
        assert!(numbers.len() == 2 && numbers[1] > numbers[0], "{example}: {line}");
    }
}

/// A scene file without anything that moves is refused, and not run in one step.
#[test]
fn empty_scenes_are_refused() {
    let file = std::env::temp_dir().join(format!("motile-empty-{}.toml", std::process::id()));
    fs::write(&file, "viscosity = 2.0\n").expect("a file");
    refused("swimming_droplet", &format!("--scene {}", file.display()), &["nothing in it moves", "[[droplets]]"]);
    fs::remove_file(&file).expect("a file that can go");
}

/// A command line that the example refuses in words with these.
fn refused(example: &str, flags: &str, words: &[&str]) {
    let out = std::env::temp_dir().join(format!("motile-refused-{example}-{}", std::process::id()));
    let told = Command::new(program(example)).args(flags.split(' ')).arg("--out").arg(&out).output().expect("an end");
    let text = String::from_utf8(told.stderr).expect("text");
    assert!(!told.status.success() && words.iter().all(|word| text.contains(word)), "{example} {flags}: {text}");
    assert!(!out.exists(), "{example} {flags}: nothing is made");
}

#[test]
fn flags_of_other_cases_are_refused() {
    refused("rigid_geometry", "--case posts --amplitude 0.1", &["--amplitude belongs to --case sinusoidal:"]);
    refused("rigid_geometry", "--case ratchet --ramp 0.5", &["--ramp belongs to --case constriction:"]);
    refused("rigid_geometry", "--rounding 0.1", &["--rounding belongs to --case constriction and --case ratchet:"]);
}

#[test]
fn cores_that_are_none_are_refused() {
    refused("nucleus", "--core-radius 1e-6", &["--core-radius 0.000001", "from 0.02"]);
    refused("nucleus", "--core-radius 1", &["--core-radius 1", "less than 1"]);
    refused("nucleus", "--core-offset 3,0", &["--core-offset 3,0", "shorter than 0.5000"]);
    refused("nucleus", "--core shell --core-offset 0.4,-0.4", &["out of the droplet", "shorter than 0.5000"]);
}

/// Scenes of drops and interfaces without a swimmer are written to files that run.
#[test]
fn scenes_without_swimmers_run_from_their_files() {
    let directory = std::env::temp_dir().join(format!("motile-scenes-{}", std::process::id()));
    fs::create_dir_all(&directory).expect("a directory");
    let file = directory.join("walls.toml");
    let name = file.to_str().expect("a path");
    for flags in ["--nodes 32 --droplet none", "--nodes 32 --gap 2.5 --droplet passive"] {
        let flags: Vec<&str> = flags.split(' ').chain(["--time", "0.2", "--no-pictures"]).collect();
        let out = ["written", "read"].map(|name| directory.join(name));
        let written = start("active_walls", &[flags.as_slice(), &["--write-scene", name]].concat(), &out[0]);
        assert!(finish(written).success());
        let read = start("swimming_droplet", &["--scene", name, "--time", "0.2", "--no-pictures"], &out[1]);
        assert!(finish(read).success());
        let [one, other] = out.map(|out| fs::read_to_string(out.join("interfaces.csv")).expect("a table"));
        assert!(one.lines().count() > 4 && one == other);
    }
    fs::remove_dir_all(&directory).expect("a directory that can go");
}
