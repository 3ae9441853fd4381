//! The program `motile`: what each command writes, and how wrong input is refused.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use motile_cli::run::Summary;

/// Directory of a test, removed in the end.
struct Directory(PathBuf);

impl Directory {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("motile-program-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).expect("a directory");
        Self(path)
    }

    fn file(&self, name: &str, text: &str) -> String {
        let path = self.0.join(name);
        fs::write(&path, text).expect("a file");
        path.to_str().expect("a path").to_owned()
    }

    fn path(&self, name: &str) -> String {
        self.0.join(name).to_str().expect("a path").to_owned()
    }
}

impl Drop for Directory {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn motile(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_motile")).args(arguments).output().expect("an end")
}

/// Output of a command that succeeds.
fn succeeds(arguments: &[&str]) -> String {
    let output = motile(arguments);
    let told = String::from_utf8(output.stderr).expect("text");
    assert!(output.status.success(), "{arguments:?}: {told}");
    String::from_utf8(output.stdout).expect("text")
}

/// Sentence of a command that is refused with an exit status.
fn refused(status: i32, arguments: &[&str]) -> String {
    let output = motile(arguments);
    let told = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(status), "{arguments:?}: {told}");
    assert!(told.starts_with("error: ") && told.trim_end().lines().count() == 1, "{told}");
    told
}

/// Columns and rows of a table.
fn table(path: impl AsRef<Path>) -> (Vec<String>, Vec<Vec<Option<f64>>>) {
    let text = fs::read_to_string(path).expect("a table");
    let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let names = lines.next().expect("names");
    (names, lines.map(|line| line.iter().map(|field| field.parse().ok()).collect()).collect())
}

/// Value in a column of the last row of a body, or of the last row.
fn last(path: impl AsRef<Path>, body: Option<f64>, column: &str) -> f64 {
    let (names, rows) = table(path);
    let index =
        |name: &str| names.iter().position(|known| known == name).unwrap_or_else(|| panic!("{name}: {names:?}"));
    let mut rows = rows.iter().rev();
    let row = rows.find(|row| body.is_none_or(|body| row[index("body")] == Some(body))).expect("a row");
    row[index(column)].unwrap_or_else(|| panic!("{column} of {body:?} is empty"))
}

/// True if two numbers are the same but for reading them from files.
fn is_same(one: f64, other: f64) -> bool {
    (one - other).abs() <= 1e-15 * one.abs()
}

fn summary(out: &str) -> Summary {
    Summary::read(&Path::new(out).join("summary.json")).expect("a summary").expect("results")
}

#[test]
fn all_bodies_have_tables() {
    let directory = Directory::new("bodies");
    let scene = directory.file(
        "bodies.toml",
        r#"
            region.box.lengths = [8.0, 8.0]
            method.layers = { nodes = 32, elements = 64, spacing = 0.2 }
            viscosity = 10.0
            [[rigid-bodies]]
            name = "stone"
            centre = [-2.0, 0.0]
            shape.round.radius = 0.5
            torque = 3.0
            [[shells]]
            name = "capsule"
            centre = [2.0, 2.0]
            shape.round.radius = 0.6
            [[solids]]
            name = "jelly"
            outline.disc = { centre = [2.0, -2.0], radius = 0.8 }
            material.neo-hookean = { shear = 100.0, bulk = 200.0 }
            hold = "free"
        "#,
    );
    let out = directory.path("out");
    succeeds(&["run", &scene, "--time", "0.2", "--quiet", "--no-pictures", "--out", &out]);
    let bodies = Path::new(&out).join("bodies.csv");
    let (names, rows) = table(&bodies);
    let wanted = ["time", "body", "x", "y", "velocity_x", "velocity_y", "angle_degrees", "spin"];
    assert_eq!(names[..8], wanted);
    for name in ["deformation", "area", "stretch_max", "tension_min", "drift_x", "largest_displacement", "energy"] {
        assert!(names.iter().any(|known| known == name), "{name}: {names:?}");
    }
    assert!(rows.len() % 3 == 0 && rows.len() > 6, "{}", rows.len());
    // The bodies are in the order solids, rigid bodies, shells.
    let spin = last(&bodies, Some(1.0), "spin");
    let angle = last(&bodies, Some(1.0), "angle_degrees").to_radians();
    assert!((angle / (0.2 * spin) - 1.0).abs() < 1e-3, "{angle} {spin}");
    // Markers of shells lie on their circle.
    let area = last(&bodies, Some(2.0), "area");
    assert!((area / (std::f64::consts::PI * 0.36) - 1.0).abs() < 1e-6, "{area}");
    let found = summary(&out);
    for (name, body, column) in
        [("stone_spin", 1.0, "spin"), ("capsule_area", 2.0, "area"), ("jelly_energy", 0.0, "energy")]
    {
        assert!(is_same(found.number(name), last(&bodies, Some(body), column)), "{name}");
    }
    // The capsule and the jelly are nearest to each other, 4 apart; polygons through points are somewhat smaller.
    let gap = found.number("minimum_gap");
    assert!((gap - (4.0 - 0.6 - 0.8)).abs() < 5e-3, "{gap}");
    // Alone a disc turns at the rate T/(4 pi eta R^2) in unbounded fluid, and in a periodic box, which as a whole
    // cannot turn, at 1 - pi R^2/L^2 of it.
    let alone = ["--set", "solids=[]", "--set", "shells=[]", "--set", "method.integral.nodes=64"];
    let flags = ["--time", "0.1", "--quiet", "--no-pictures", "--out", &out];
    succeeds(&[&["run", &scene][..], &alone, &flags].concat());
    let pi = std::f64::consts::PI;
    let exact = 3.0 / (4.0 * pi * 10.0 * 0.25) * (1.0 - pi * 0.25 / 64.0);
    let spin = last(&bodies, Some(0.0), "spin");
    assert!((spin / exact - 1.0).abs() < 1e-4, "{spin} {exact}");
    assert!(Path::new(&out).join("flow.csv").exists() && !Path::new(&out).join("droplets.csv").exists());
}

/// Of a droplet at rest beside a wall the smallest gap is the one at the start.
#[test]
fn the_smallest_gap_is_to_the_wall() {
    let directory = Directory::new("wall");
    let scene = directory.file(
        "wall.toml",
        "region.channel = { length = 8.0, width = 4.0 }\nmethod.integral = { nodes = 48, elements = 96 }\n\
         [[droplets]]\ncentre = [0.0, 0.75]\nparticles = \"none\"\n",
    );
    for (set, gap) in [("droplets.0.centre.1=0.75", 0.25), ("droplets.0.centre.1=-0.9", 0.1)] {
        let out = directory.path("out");
        succeeds(&["run", &scene, "--time", "0.1", "--quiet", "--no-pictures", "--set", set, "--out", &out]);
        // The area of the polygon through the markers is that of the circle, which is 0.07 % larger.
        let found = summary(&out).number("minimum_gap");
        assert!((found - gap).abs() < 1e-3, "{found} {gap}");
        assert!(is_same(last(Path::new(&out).join("flow.csv"), None, "smallest_gap"), found));
    }
}

/// A first droplet with particles has its trajectory, others and interfaces their tables, and everything that moves an
/// animation.
#[test]
fn droplets_and_interfaces_are_drawn_and_recorded() {
    let directory = Directory::new("drawn");
    let scene = directory.file(
        "drawn.toml",
        "region.box.lengths = [6.0, 8.0]\nmethod.integral = { nodes = 24, elements = 48 }\n\
         [[droplets]]\ncentre = [0.0, -1.5]\n[[droplets]]\nname = \"oil\"\ncentre = [0.0, 1.0]\nparticles = \"none\"\n\
         [[interfaces]]\nheight = 3.0\n",
    );
    let out = directory.path("out");
    let flags = ["--time", "0.3", "--quiet", "--rows", "5", "--out", &out, "--picture-spacing", "0.5"];
    let told = succeeds(&[&["run", &scene][..], &flags].concat());
    assert!(told.contains("peclet") && told.contains("results in"), "{told}");
    for file in ["trajectory.csv", "droplets.csv", "interfaces.csv", "swim.gif", "final.png"] {
        assert!(Path::new(&out).join(file).exists(), "{file}");
    }
    assert!(Path::new(&out).join("vtk/interface.pvd").exists() && Path::new(&out).join("time_series.svg").exists());
    let found = summary(&out);
    // The columns are those of the tables: the same droplet in both.
    let [alone, both] = ["trajectory.csv", "droplets.csv"].map(|file| table(Path::new(&out).join(file)));
    assert_eq!((alone.1.len(), both.1.len()), (6, 12));
    assert!(is_same(found.number("droplet_x"), last(Path::new(&out).join("trajectory.csv"), None, "x")));
    assert!(is_same(found.number("oil_x"), last(Path::new(&out).join("droplets.csv"), None, "x")));
    assert!(found.number("interface_length") >= 6.0 && found.number("peclet") == 10.0);
}

/// A run that is killed and goes on from its checkpoint has the tables and the results of a whole one, bit by bit.
#[test]
fn checkpoints_of_another_scene_are_refused() {
    let directory = Directory::new("resumed");
    let scene = directory.file(
        "resumed.toml",
        "region.channel = { length = 8.0, width = 4.0 }\nmethod.integral = { nodes = 24, elements = 48 }\n\
         [[droplets]]\n[[rigid-bodies]]\ncentre = [2.5, 0.3]\nshape.round.radius = 0.3\n",
    );
    let [out, state] = ["out", "state"].map(|name| directory.path(name));
    let flags = ["run", &scene, "--quiet", "--no-pictures", "--out", &out];
    succeeds(&[&flags[..], &["--set=droplets.0.particles.activity=-3", "--time=0.1", "--checkpoint", &state]].concat());
    let told = refused(1, &[&flags[..], &["--time=1", "--resume", &state]].concat());
    assert!(told.contains("droplets[0].particles.activity is -3.0 in it and -2.0 here"), "{told}");
}

/// Particles with a positive activity are legal, but the droplet does not swim.
#[test]
fn a_positive_activity_is_noted() {
    let directory = Directory::new("positive");
    let scene = directory.file("scene.toml", "[[droplets]]\nparticles.activity = 2.0\n");
    let note = "note: droplets[0].particles.activity = 2: particles with a positive activity push each other apart, so";
    let checked = succeeds(&["check", &scene]);
    assert!(checked.contains(note), "{checked}");
    let contractile = succeeds(&["check", &scene, "--set", "droplets.0.particles.activity=-2"]);
    assert!(!contractile.contains("note:"), "{contractile}");
}

#[test]
fn wrong_input_is_refused_in_one_sentence() {
    let directory = Directory::new("wrong");
    let scene = directory.file("scene.toml", "[[droplets]]\n");
    let out = directory.path("out");
    for (status, arguments, words) in [
        (1, vec!["--set", "droplets.0.activity=-4"], "The nearest keys are droplets.0.particles.activity"),
        (1, vec!["--set", "viscosity=high"], "viscosity = \"high\": the text \"high\" cannot be used. Use a number"),
        (1, vec!["--set", "droplets.0.tension=-4"], "tension"),
        (1, vec!["--set", "droplets.0.particles.activity=-12"], "activity = -12: the excluded volume is only 10"),
        (1, vec!["--set", "viscosity=1e300"], "viscosity = 1e300: use a number from 1e-50 to 1e50"),
        (1, vec!["--set", "region.channel.width=3"], "missing required key `length`"),
        (1, vec!["--set", "droplets=[]"], "nothing moves in this scene"),
        (2, vec!["--set", "viscosity"], "must be KEY=VALUE"),
        (2, vec!["--time", "-1"], "--time -1: must be a number above 0"),
        (2, vec!["--tim", "1"], "there is no flag --tim (did you mean --time?"),
        (2, vec!["--rows", "1"], "--rows 1"),
    ] {
        let told = refused(status, &[&["run", &scene, "--quiet", "--out", &out][..], &arguments].concat());
        assert!(told.contains(words), "{told}");
        assert!(!Path::new(&out).exists(), "{arguments:?}: nothing is made");
    }
    let wrong = directory.file("wrong.toml", "viscosty = 3.0\n[[droplets]]\n");
    let binary = directory.path("binary.toml");
    fs::write(&binary, [0x7f, 0x45, 0xff, 0xfe]).unwrap();
    for command in ["run", "check", "steady"] {
        let told = refused(1, &[command, &wrong]);
        assert!(told.contains("unknown key `viscosty`"), "{told}");
        let missing = refused(1, &[command, "no-such-file.toml"]);
        assert!(missing.contains("no-such-file.toml: there is no such file"), "{missing}");
        let told = refused(1, &[command, &binary]);
        assert!(told.contains("binary.toml: the file is not text"), "{told}");
    }
    assert!(
        refused(2, &["runn", &scene])
            .contains("there is no command \"runn\". Use one of run, sweep, steady, check, new")
    );
    assert!(refused(1, &["run", &scene, "--checkpoint", &scene, "--out", &out]).contains("are one file"));
}

/// Every file that a run leaves is known before it: no flag may name it, so that nothing is replaced by mistake.
#[test]
fn results_of_a_run_are_no_place_for_other_files() {
    let directory = Directory::new("places");
    let scene = directory.file(
        "scene.toml",
        "region = \"plane\"\nmethod.integral = { nodes = 24, elements = 48 }\nflow.shear = 0.1\n\
         [[droplets]]\n[[droplets]]\ncentre = [0.0, 4.0]\n\
         [[rigid-bodies]]\ncentre = [3.0, 0.0]\nshape.round.radius = 0.3\n",
    );
    let out = directory.path("out");
    succeeds(&["run", &scene, "--time", "0.1", "--quiet", "--picture-spacing", "1", "--out", &out]);
    let files: Vec<String> = fs::read_dir(&out)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.is_file())
        .map(|path| path.to_str().unwrap().to_owned())
        .collect();
    for name in ["summary.json", "trajectory.csv", "droplets.csv", "bodies.csv", "flow.csv", "final.png", "swim.gif"] {
        assert!(files.iter().any(|file| file.ends_with(name)), "{name}: {files:?}");
    }
    for file in &files {
        let text = fs::read(file).unwrap();
        for flag in ["--checkpoint", "--write-scene", "--resume"] {
            let told = refused(1, &["run", &scene, "--quiet", "--out", &out, flag, file]);
            assert!(told.contains("are one file"), "{flag} {file}: {told}");
        }
        let told = refused(1, &["run", file, "--quiet", "--out", &out]);
        assert!(told.contains("are one file"), "{file}: {told}");
        assert_eq!(fs::read(file).unwrap(), text, "{file}");
    }
}

#[test]
fn a_check_tells_what_would_run_and_writes_nothing() {
    let directory = Directory::new("check");
    let scene = directory.file(
        "scene.toml",
        "region.box.lengths = [20.0, 10.0]\nmethod.integral = { nodes = 24, elements = 48 }\n\
         [[suspension]]\ncount = 8\ndroplet.particles.activity = -3.0\n",
    );
    let before = fs::read_dir(&directory.0).unwrap().count();
    let told = succeeds(&["check", &scene, "--time", "5"]);
    let area = 8.0 * std::f64::consts::PI / 200.0;
    for words in ["nodes = 24", "of all 8 bodies", "Péclet number 15.0000", "to t = 5", &format!("{area:.6}")] {
        assert!(told.contains(words), "{words}: {told}");
    }
    let narrow = "method.grid = { spacing = 0.5 }";
    let told = refused(1, &["check", &scene, "--set", "droplets.0.shape.round.radius=30", "--set", narrow]);
    assert!(told.len() > 20);
    // A film that is not resolved is told at the start.
    let film = ["--set", "suspension=[]", "--set", "droplets.0.centre=[0, 0]", "--set", "droplets.1.centre=[2.01, 0]"];
    let told = succeeds(&[&["check", &scene][..], &film].concat());
    assert!(told.contains("warning: ") && told.contains("thin film"), "{told}");
    assert_eq!(fs::read_dir(&directory.0).unwrap().count(), before);
    // Doubts that need the flow of a step are told as well, and each once, as a run tells them.
    let coarse = directory.file(
        "coarse.toml",
        "region.box.lengths = [6.0, 6.0]\nmethod.integral = { nodes = 24, elements = 64 }\n\
         [[droplets]]\nparticles.activity = -4.0\n",
    );
    let told = succeeds(&["check", &coarse]);
    let ran = motile(&["run", &coarse, "--time", "0.01", "--quiet", "--no-pictures", "--out", &directory.path("out")]);
    let ran = String::from_utf8(ran.stderr).expect("text");
    for cause in ["edge of the concentration not resolved", "stresslet not resolved"] {
        assert!(ran.contains(cause), "{cause}: {ran}");
        assert_eq!(told.matches(cause).count(), 1, "{cause}: {told}");
    }
}

#[test]
fn new_scenes_run_and_replace_no_file() {
    let directory = Directory::new("new");
    let [short, all, tube] = ["short.toml", "all.toml", "tube.toml"].map(|name| directory.path(name));
    succeeds(&["new", &short]);
    succeeds(&["new", &all, "--all"]);
    succeeds(&["new", &tube, "--example", "tube"]);
    let text = fs::read_to_string(&short).unwrap();
    assert!(text.lines().filter(|line| line.starts_with('#')).count() > 10);
    assert_eq!(fs::read_to_string(&all).unwrap(), motile::setup::Setup::ANNOTATED);
    for file in [&short, &tube] {
        succeeds(&["check", file, "--time", "1"]);
    }
    let out = directory.path("out");
    succeeds(&["run", &short, "--time", "0.1", "--quiet", "--no-pictures", "--out", &out]);
    assert!(summary(&out).number("speed") > 0.0);
    assert!(refused(1, &["new", &short]).contains("exists already"));
    assert_eq!(fs::read_to_string(&short).unwrap(), text);
    let told = refused(1, &["new", &directory.path("x.toml"), "--example", "tub"]);
    assert!(told.contains("is not one of active_walls, "), "{told}");
    // The list has all scenes of the repository.
    let listed = succeeds(&["new", "--list"]);
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path().file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    names.sort();
    assert_eq!(listed.lines().map(|line| line.split(' ').next().unwrap()).collect::<Vec<_>>(), names);
}

/// Sensitivities agree with differences of states at other values of diffusion and tension.
#[test]
fn sensitivities_are_the_slopes_of_states_at_other_values() {
    let directory = Directory::new("sensitivities");
    let scene = directory.file(
        "scene.toml",
        "region.box.lengths = [5.0, 7.0]\nmethod.integral = { nodes = 40, elements = 160 }\n\
         [[droplets]]\nparticles.activity = -0.8\n",
    );
    let out = directory.path("out");
    let told = succeeds(&["steady", &scene, "--out", &out, "--no-pictures", "--sensitivities"]);
    assert!(told.contains("derivative by") && told.contains("percent per percent of"), "{told}");
    let text = fs::read_to_string(Path::new(&out).join("sensitivities.csv")).unwrap();
    let names: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    assert_eq!(names[..5], ["parameter", "key", "value", "d_speed", "log_speed"]);
    assert!(names.contains(&"d_growth_rate"), "{names:?}");
    for (key, value) in [("droplets.0.particles.diffusion", 0.1), ("droplets.0.tension", 10.0)] {
        let row = text.lines().find(|line| line.split(',').nth(1) == Some(key)).unwrap();
        let fields: Vec<&str> = row.split(',').collect();
        let at = |value: f64| {
            let set = format!("{key}={value:?}");
            succeeds(&["steady", &scene, "--out", &out, "--no-pictures", "--set", &set]);
            summary(&out).number("aspect_ratio")
        };
        let step = 0.02 * value;
        let slope = (at(value + step) - at(value - step)) / (2.0 * step);
        let column = names.iter().position(|name| *name == "d_aspect_ratio").unwrap();
        let derivative: f64 = fields[column].parse().unwrap();
        assert!((derivative / slope - 1.0).abs() < 3e-3, "{key}: {derivative} {slope}");
    }
    assert!(
        refused(2, &["steady", &scene, "--sensitivities", "--along", "viscosity", "--to", "1"]).contains("--along")
    );
}

/// A steady swimmer has the speed of the first page of `motile-steady-states`, and the droplet at rest its known
/// threshold. "Undecided" is an answer too.
#[test]
fn steady_states_have_a_verdict() {
    let directory = Directory::new("steady");
    let scene = directory.file(
        "scene.toml",
        "region.channel = { length = 12.0, width = 5.0 }\nmethod.integral = { nodes = 72, elements = 288 }\n\
         [[droplets]]\n",
    );
    let out = directory.path("out");
    let told = succeeds(&["steady", &scene, "--out", &out, "--no-pictures"]);
    let found = summary(&out);
    assert!((found.number("speed") - 0.137_444_855).abs() < 3e-6, "{}", found.number("speed"));
    assert!(told.contains("undecided: the leading growth rate is -9."), "{told}");
    assert!(found.number("leading_growth_rate").abs() < found.number("growth_rate_error"));
    let told = succeeds(&["steady", &scene, "--set", "method.integral.nodes=112", "--out", &out, "--no-pictures"]);
    let found = summary(&out);
    assert!(told.contains("stable: the leading growth rate is -9.4"), "{told}");
    assert!(found.number("leading_growth_rate") < -found.number("growth_rate_error"));
    assert!(Path::new(&out).join("spectrum.csv").exists());
    // In unbounded fluid a round droplet swims above |zeta_dmu| = (eta_in + eta_ext) D 2/(c0 R) = 0.4.
    let along = directory.path("along");
    let key = ["--along", "droplets.0.particles.activity", "--to", "-0.5", "--steps", "10", "--uniform", "--quiet"];
    let particles = "droplets.0.particles={ activity = -0.3, excluded-volume = \"none\" }";
    let set = ["--set", "region=plane", "--set", particles];
    succeeds(&[&["steady", &scene, "--out", &along, "--set", "method.integral.nodes=32"][..], &key, &set].concat());
    let (names, rows) = table(Path::new(&along).join("special.csv"));
    assert_eq!(names[..2], ["kind", "value"]);
    let threshold = rows.iter().find(|row| row[0] == Some(1.0)).and_then(|row| row[1]).unwrap();
    assert!((threshold + 0.4).abs() < 1e-6, "{threshold}");
    let told = refused(1, &["steady", &scene, "--along", "droplets.0.angle", "--to", "1", "--out", &along]);
    assert!(told.contains("cannot be followed along droplets.0.angle"), "{told}");
    assert!(refused(2, &["steady", &scene, "--along", "viscosity"]).contains("--to"));
}

#[test]
fn sweeps_make_and_collect_their_runs() {
    let directory = Directory::new("sweep");
    let plan = directory.file(
        "plan.toml",
        "time = 0.1\n[grid]\n\"droplets.0.particles.activity\" = [-2.0, -3.0]\n[scene.method.integral]\nnodes = 24\n\
         elements = 48\n[[scene.droplets]]\n",
    );
    let out = directory.path("out");
    succeeds(&["sweep", &plan, "--shard", "1/2", "--quiet", "--out", &out]);
    let told = succeeds(&["sweep", &plan, "status", "--out", &out]);
    assert!(told.contains("1 finished, 0 failed, 0 begun, 1 not begun, of 2"), "{told}");
    succeeds(&["sweep", &plan, "--quiet", "--threads", "1", "--out", &out]);
    succeeds(&["sweep", &plan, "collect", "--out", &out]);
    let text = fs::read_to_string(Path::new(&out).join("results.csv")).unwrap();
    assert!(text.lines().count() == 3 && text.starts_with("label,droplets.0.particles.activity,"), "{text}");
    let wrong = directory.file("wrong.toml", "time = 1.0\n[grid]\nviscosty = [1.0]\n[[scene.droplets]]\n");
    assert!(refused(1, &["sweep", &wrong]).contains("The nearest keys are viscosity"));
}

/// A page of the reference.
fn page(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/reference");
    fs::read_to_string(folder.join(name)).expect("a page")
}

/// The page of observables has each column of the tables of runs; of numbered columns it has the first and the last.
#[test]
fn the_page_of_observables_has_each_column() {
    let (text, directory, mut count) = (page("observables.md"), Directory::new("columns"), 0);
    let stem = |name: &str| name.trim_end_matches(|c: char| c.is_ascii_digit() || "xyz_".contains(c)).to_owned();
    let names: Vec<&str> = text.split('`').skip(1).step_by(2).collect();
    let stems: Vec<String> = names.iter().map(|name| stem(name)).collect();
    for example in ["swimmer", "elastic_walls", "circles", "gel", "exchange", "active_walls", "shear", "drop"] {
        let (scene, out) = (directory.path(&format!("{example}.toml")), directory.path(example));
        succeeds(&["new", &scene, "--example", example]);
        succeeds(&["run", &scene, "--time", "0.02", "--no-pictures", "--quiet", "--out", &out]);
        for entry in fs::read_dir(&out).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_none_or(|extension| extension != "csv") {
                continue;
            }
            for column in table(&path).0 {
                let numbered = stem(&column) != column && stems.contains(&stem(&column));
                assert!(names.contains(&column.as_str()) || numbered, "{column} of {}", path.display());
                count += 1;
            }
        }
    }
    assert!(count > 300, "{count}");
}

/// The page on the program has every flag of each command, and no others.
#[test]
fn the_page_has_the_flags_of_each_command() {
    let (text, mut count) = (page("program.md"), 0);
    for command in ["run", "check", "new", "sweep", "steady"] {
        let (_, section) = text.split_once(&format!("\n## motile {command}\n")).unwrap();
        let section = section.split("\n## ").next().unwrap();
        let flags = |text: &str| -> Vec<String> {
            let names = text.split("--").skip(1).map(|rest| {
                rest.split(|c: char| !c.is_ascii_alphanumeric() && c != '-').next().unwrap_or_default().to_owned()
            });
            names.filter(|name| name.starts_with(char::is_alphabetic) && name != "help").collect()
        };
        // Each flag stands at the beginning of a line of the help.
        let help = succeeds(&[command, "--help"]);
        let lines = help.lines().filter(|line| line.trim_start().starts_with('-'));
        let known: Vec<String> = lines.flat_map(|line| flags(line).into_iter().take(1)).collect();
        let shown = flags(section);
        for flag in &known {
            assert!(shown.contains(flag), "motile {command} has --{flag}, the page has not");
        }
        for flag in &shown {
            assert!(known.contains(flag), "motile {command} has no --{flag}, the page has");
        }
        count += known.len();
    }
    assert!(count > 30, "{count}");
}

/// Each key that the page on the program names is one.
#[test]
fn the_page_names_keys_that_exist() {
    let text = page("program.md");
    let known: Vec<String> = motile_cli::keys::all();
    let rows = text.lines().skip_while(|line| !line.starts_with("| flag | key")).skip(2);
    let mut named = 0;
    for row in rows.take_while(|line| line.starts_with('|')) {
        let cells: Vec<&str> = row.split('|').collect();
        let keys = cells[2].split('`').skip(1).step_by(2).filter(|code| code.contains('.') && !code.contains(' '));
        for key in keys.filter(|code| code.parse::<f64>().is_err()) {
            let key = key.replace("K", "0").replace("solids.1.", "solids.0.").replace(".centre.1", ".centre");
            assert!(known.contains(&key), "{key}: {row}");
            named += 1;
        }
    }
    assert!(named > 60, "{named}");
}
