use std::fs;

use super::*;
use crate::run::make_directory;

/// A sweep in a directory of its own, removed in the end.
struct Sweep(PathBuf);

impl Sweep {
    /// Does something about a plan over these activities.
    fn act(&self, action: Action, time: f64, nodes: usize, activities: &str) -> Result<()> {
        let plan = self.0.join("plan.toml");
        let text = format!(
            "time = {time}\n[grid]\n\"droplets.0.particles.activity\" = [{activities}]\n[scene.method.integral]\n\
             nodes = {nodes}\nelements = 480\n[[scene.droplets]]\n"
        );
        fs::write(&plan, text)?;
        let (shard, out) = (Shard { number: 0, of: 1 }, Some(self.0.join("out")));
        sweep(&SweepFlags { plan, action, shard, threads: Some(1), retry: false, quiet: true, out })
    }

    /// A column of the collected table.
    fn column(&self, name: &str) -> Vec<f64> {
        let text = fs::read_to_string(self.0.join("out/results.csv")).unwrap();
        // Commas within quotation marks are text.
        let fields = |line: &str| -> Vec<String> {
            let parts = line.split('"').enumerate();
            let split = parts.map(|(k, part)| if k % 2 == 0 { part.replace(',', "\n") } else { part.to_owned() });
            split.collect::<String>().split('\n').map(str::to_owned).collect()
        };
        let mut lines = text.lines().map(fields);
        let index = lines.next().unwrap().iter().position(|column| column == name).unwrap();
        lines.map(|line| line[index].parse().expect(&text)).collect()
    }
}

impl Drop for Sweep {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[test]
fn results_of_another_plan_are_none() {
    let all = Sweep(std::env::temp_dir().join(format!("motile-sweep-{}", std::process::id())));
    make_directory(&all.0).unwrap();
    all.act(Action::Run, 0.05, 24, "-2.0, -3.0").unwrap();
    all.act(Action::Collect, 0.05, 24, "-2.0, -3.0").unwrap();
    assert_eq!(all.column("time"), [0.05, 0.05]);
    let speeds = all.column("speed");

    // To another time nothing is finished, and all is made again.
    let error = all.act(Action::Collect, 0.1, 24, "-2.0, -3.0").unwrap_err();
    assert!(error.to_string().contains("none of the 2 runs is finished"), "{error}");
    all.act(Action::Run, 0.1, 24, "-2.0, -3.0").unwrap();
    all.act(Action::Collect, 0.1, 24, "-2.0, -3.0").unwrap();
    assert_eq!(all.column("time"), [0.1, 0.1]);
    assert!(all.column("speed").iter().zip(&speeds).all(|(new, old)| new != old));

    // An activity more: what is finished stays.
    let first = all.0.join("out/runs");
    let written = || {
        let folders = fs::read_dir(&first).unwrap().map(|entry| entry.unwrap().path().join("summary.json"));
        folders.map(|path| path.metadata().unwrap().modified().unwrap()).min()
    };
    let before = written();
    all.act(Action::Run, 0.1, 24, "-2.0, -3.0, -4.0").unwrap();
    all.act(Action::Collect, 0.1, 24, "-2.0, -3.0, -4.0").unwrap();
    assert!(written() == before && all.column("time") == [0.1; 3]);

    // Results of another version of the program are none, and made again.
    let mut rewritten = 0;
    for folder in fs::read_dir(&first).unwrap() {
        let path = folder.unwrap().path().join("summary.json");
        let text = fs::read_to_string(&path).unwrap();
        assert!(text.contains(&format!("\"motile_version\": \"{}\"", motile::VERSION)), "{text}");
        fs::write(&path, text.replace(motile::VERSION, "0.0.9+1")).unwrap();
        rewritten += 1;
    }
    assert_eq!(rewritten, 3);
    let error = all.act(Action::Collect, 0.1, 24, "-2.0, -3.0, -4.0").unwrap_err();
    assert!(error.to_string().contains("none of the 3 runs is finished"), "{error}");
    all.act(Action::Run, 0.1, 24, "-2.0, -3.0, -4.0").unwrap();
    all.act(Action::Collect, 0.1, 24, "-2.0, -3.0, -4.0").unwrap();
    assert_eq!(all.column("time"), [0.1; 3]);
    let before = written();

    // Another scene is refused, whatever is asked for.
    for action in [Action::Run, Action::Collect, Action::Status] {
        for activities in ["-2.0, -3.0", "-4.0, -5.0"] {
            let error = all.act(action, 0.1, 32, activities).unwrap_err();
            assert!(error.to_string().contains("belongs to another plan. Use another --out"), "{error}");
        }
    }
    assert!(written() == before);
}

/// Shares count from one, and together they are all runs.
#[test]
fn shares_take_every_run_once() {
    for of in [1, 2, 4] {
        let mut taken: Vec<usize> = Vec::new();
        for number in 1..=of {
            let Shard { number, of } = shard(&format!("{number}/{of}")).unwrap();
            taken.extend((0..10).skip(number).step_by(of));
        }
        taken.sort_unstable();
        assert_eq!(taken, (0..10).collect::<Vec<_>>(), "{of}");
    }
    assert!(["0/4", "5/4", "1", "1/0", "-1/2", "a/b"].into_iter().all(|text| shard(text).is_err()));
}

/// A failure counts if it is of this scene, these settings and this time.
#[test]
fn failures_of_other_scenes_are_not_believed() {
    let folder = std::env::temp_dir().join(format!("motile-failures-{}", std::process::id()));
    let trial = |time: f64| {
        let (label, setup) = ("run".to_owned(), motile::setup::Setup::default());
        Trial { label, values: Vec::new(), setup, time, folder: folder.clone() }
    };
    make_directory(&folder).unwrap();
    let outcome = trial(1.0).keep(|_| bail!("the droplet burst"));
    assert!(outcome.is_err());
    let State::Failed(failure) = trial(1.0).state() else { panic!("{:?}", trial(1.0).state()) };
    assert!(failure.contains("the droplet burst"), "{failure}");
    let other = trial(2.0).state();
    fs::remove_dir_all(&folder).unwrap();
    assert!(matches!(other, State::Left), "{other:?}");
}
