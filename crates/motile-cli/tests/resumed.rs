//! Runs of all kinds of scenes that are killed late and resumed from their checkpoints, against runs that are not.
//! Their results are the same bytes, except for the seconds that they took.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use motile::scene::checkpoint::Checkpoint;
use motile_cli::run::Summary;

/// Part of a run after which it is killed.
const LATE: f64 = 0.8;

/// Few nodes, for short runs.
const FEW: &str = "method.integral={ nodes = 24, elements = 96 }";
const LAYERS: &str = "method.layers={ nodes = 24, elements = 96, spacing = 0.2 }";

fn start(flags: &[&str], out: &Path) -> Child {
    Command::new(env!("CARGO_BIN_EXE_motile"))
        .args(flags)
        .args(["--quiet", "--out"])
        .arg(out)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program")
}

/// Starts that a busy machine may let end before they are killed.
const MOST_TRIES: usize = 20;

/// Time of a checkpoint, 0 if there is none.
fn saved_time(checkpoint: &Path) -> f64 {
    Checkpoint::read(checkpoint).map_or(0.0, |saved| saved.time())
}

/// Kills a run to `end` when there is a checkpoint of a late time. Returns false if the run ended before, or if its
/// last checkpoint leaves nothing to compute.
fn kill_late(end: f64, checkpoint: &Path, mut child: Child) -> bool {
    while saved_time(checkpoint) < LATE * end {
        if child.try_wait().expect("its state").is_some() {
            return false;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().expect("a run that can be killed");
    child.wait().expect("its end").code().is_none() && saved_time(checkpoint) < end
}

/// Texts of the results of a run: `summary.json` without the wall clock time, and all tables.
fn results(out: &Path) -> Vec<String> {
    let summary = Summary::read(&out.join("summary.json")).expect("a summary").expect("results");
    let mut values = summary.values().clone();
    assert!(values.shift_remove("seconds").is_some_and(|seconds| seconds.as_f64() > Some(0.0)));
    let tables = ["trajectory.csv", "droplets.csv", "bodies.csv", "flow.csv"].map(|name| out.join(name));
    let mut texts: Vec<String> = tables.iter().filter_map(|path| fs::read_to_string(path).ok()).collect();
    assert!(!texts.is_empty() && texts.iter().all(|text| text.lines().count() > 5));
    texts.push(format!("{:#}", serde_json::Value::Object(values)));
    texts.iter().map(|text| without_command(text)).collect()
}

/// Text of a result without the command in its origin, which names the folder.
fn without_command(text: &str) -> String {
    let Some((before, rest)) = text.split_once("; command: ") else { panic!("no command in the origin") };
    let end = rest.find(['"', '\n']).expect("the end of the origin");
    format!("{before}{}", &rest[end..])
}

/// A scene of the repository.
fn scene(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name).with_extension("toml")
}

/// Compares a run to `time`, which is killed late and resumed with its results elsewhere, with one that is not.
fn compare(scene: &Path, time: &str, keys: &[&str], draws: bool) {
    let name = scene.file_stem().and_then(|name| name.to_str()).expect("a name");
    let directory = std::env::temp_dir().join(format!("motile-resumed-{name}-{}-{time}", std::process::id()));
    fs::create_dir_all(&directory).expect("a directory");
    let [whole, first, rest] = ["whole", "first", "rest"].map(|name| directory.join(name));
    let mut flags = vec!["run", scene.to_str().expect("a path"), "--time", time];
    keys.iter().for_each(|key| flags.extend(["--set", key]));
    flags.extend(if draws { ["--picture-spacing", "0.2"].as_slice() } else { &["--no-pictures"] });
    let ended = start(&flags, &whole).wait().expect("its end");
    let state = directory.join("state");
    let state_flag = state.to_str().expect("a path");
    let saved = [flags.as_slice(), &["--checkpoint", state_flag, "--checkpoint-every", "7"]].concat();
    let reached = Summary::read(&whole.join("summary.json")).expect("a summary").expect("results").number("time");
    let killed = (0..MOST_TRIES).any(|_| {
        // What a run that ended has left would be taken for a run to go on with.
        let _ = fs::remove_file(&state);
        kill_late(reached, &state, start(&saved, &first))
    });
    assert!(killed, "{name}: no run was killed before its end");
    let resumed = [saved.as_slice(), &["--resume", state_flag]].concat();
    assert_eq!(start(&resumed, &rest).wait().expect("its end"), ended, "{name}");
    let [whole_results, rest_results] = [&whole, &rest].map(|out| results(out));
    assert_eq!(rest_results, whole_results, "{name}: the resumed run and the whole one");
    if draws {
        let list = |out: &Path| fs::read_to_string(out.join("vtk/interface.pvd")).expect("a list of files");
        assert!(list(&whole).matches("DataSet").count() > 15);
        // The files from before are in the other directory.
        assert!(list(&rest).matches("DataSet").count() > 2);
        assert!(list(&rest).lines().skip(3).all(|line| list(&whole).contains(line)));
    }
    fs::remove_dir_all(&directory).expect("a directory that can be removed");
}

/// The droplet swings from wall to wall.
#[test]
fn a_swing_across_a_channel() {
    compare(&scene("rigid_channel"), "60", &[FEW, "droplets.0.centre=[0, 0.4]"], false);
}

#[test]
fn a_box() {
    compare(&scene("swimmer"), "20", &[FEW], true);
    compare(&scene("swimmer"), "4", &["method.grid.spacing=0.1", "step.adaptive.tolerance=0.000001"], false);
}

/// The solver's iterations are those of the whole run, and so are the warnings, which stop with the edge of the
/// concentration.
#[test]
fn viscosities_and_warnings() {
    let keys = ["droplets.0.viscosity=500", "viscosity=5", "droplets.0.particles.activity=-8"];
    let few = ["method.integral={ nodes = 24, elements = 48 }", "step.adaptive.tolerance=0.00001"];
    compare(&scene("swimmer"), "6", &[&keys[..], &few, &["droplets.0.particles.start=polarised"]].concat(), false);
}

#[test]
fn a_rigid_body() {
    let file = std::env::temp_dir().join(format!("motile-body-{}.toml", std::process::id()));
    let body = "[[droplets]]\n[[rigid-bodies]]\ncentre = [2.5, 0.3]\nshape.round.radius = 0.3\n";
    fs::write(&file, format!("region.channel = {{ length = 8.0, width = 4.0 }}\n{body}")).expect("a file");
    compare(&file, "8", &[FEW, "droplets.0.particles.activity=-3"], false);
    fs::remove_file(&file).expect("a file that can be removed");
}

#[test]
fn curved_walls() {
    compare(&scene("rigid_walls"), "8", &[FEW], false);
}

#[test]
fn elastic_walls() {
    let relaxing = "solids.0.relaxation.0={ modulus = 400, time = 2 }";
    let twitching = "solids.1.active-springs={ tension = 5, on = 0.5, off = 1, seed = 1 }";
    compare(&scene("elastic_walls"), "6", &[LAYERS], false);
    compare(&scene("elastic_walls"), "3", &[LAYERS, relaxing, twitching], false);
}

#[test]
fn insides() {
    compare(&scene("circles"), "4", &["method.integral={ nodes = 32, elements = 128 }"], false);
    compare(&scene("exchange"), "1.2", &[FEW], false);
    compare(
        &scene("exchange"),
        "10",
        &[FEW, "droplets.0.particles.exchange={ binding = 0.2, unbinding = 0.5 }"],
        false,
    );
    compare(&scene("gel"), "20", &["method.grid.spacing=0.2"], false);
}

/// A run that ends with an error, because the droplets touch, and one that a repulsion saves from that.
#[test]
fn two_that_meet() {
    let file = std::env::temp_dir().join(format!("motile-meet-{}.toml", std::process::id()));
    let droplets = "[[droplets]]\ncentre = [-1.5, 0.0]\n[[droplets]]\ncentre = [1.5, 0.0]\nangle = 3.141592653589793\n";
    fs::write(&file, format!("least-gap = 0.0\nregion.box.lengths = [12.0, 8.0]\n{droplets}")).expect("a file");
    compare(&file, "13", &[FEW], false);
    compare(&file, "13.5", &[FEW, "repulsion={ strength = 10, range = 0.1 }"], false);
    fs::remove_file(&file).expect("a file that can be removed");
}

/// Droplets in three dimensions, whose velocities are iterated for two viscosities.
#[test]
fn droplets_without_symmetry() {
    let keys = ["method.harmonics.degree=4", "droplets.0.viscosity=50", "step.adaptive.tolerance=0.000001"];
    compare(&scene("encounter"), "6", &keys, false);
    // Many steps, so that the run can be killed between its last checkpoints.
    let keys = [keys[0], "step.adaptive.tolerance=0.00002"];
    compare(&scene("slit"), "3", &[&keys[..], &["region.slit.upper=1.6"]].concat(), false);
    let tube = "region={ tube = { radius = 1.6, drive = { flux = 0.1 } } }";
    compare(&scene("slit"), "2.5", &[&keys[..], &[tube]].concat(), false);
    let lattice = "region={ box = { lengths = [8, 4, 4] } }";
    compare(&scene("encounter"), "2", &[&keys[..], &[lattice]].concat(), false);
}
