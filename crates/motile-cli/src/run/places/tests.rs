use std::fs;

use super::*;
use crate::run::{CheckpointFlags, OutputFlags};

/// A directory of its own, removed in the end.
struct Directory(PathBuf);

impl Directory {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("motile-places-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }
}

impl Drop for Directory {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Message of the refusal of flags with these paths in `directory`; `None` if they are accepted.
fn refusal(
    directory: &Path,
    scene: Option<&str>,
    [out, checkpoint, resume, write]: [Option<&str>; 4],
) -> Option<String> {
    let place = |name: Option<&str>| name.map(|name| directory.join(name));
    let checkpoints =
        CheckpointFlags { checkpoint: place(checkpoint), resume: place(resume), ..CheckpointFlags::default() };
    let output =
        OutputFlags { out: place(out), write_scene: place(write), checkpoints, quiet: true, ..OutputFlags::default() };
    output.check("example", place(scene).as_deref()).err().map(|error| error.to_string())
}

#[test]
fn files_that_are_one_are_refused_by_both_names() {
    let directory = Directory::new("one");
    let there = |name: &str| directory.0.join(name);
    fs::create_dir(there("a")).unwrap();
    fs::write(there("scene.toml"), "").unwrap();
    fs::write(there("a/state"), "").unwrap();
    fs::hard_link(there("a/state"), there("hard")).unwrap();
    let none = [None; 4];
    let mut cases = vec![
        (None, [Some("new"), Some("new"), None, None], "--checkpoint", "--out"),
        (None, [Some("new"), Some("new/trajectory.csv"), None, None], "--checkpoint", "trajectory.csv"),
        (None, [Some("new"), Some("new/x/../summary.json"), None, None], "--checkpoint", "summary.json"),
        (None, [Some("new"), Some("new/vtk/state"), None, None], "--checkpoint", "files for ParaView"),
        (None, [Some("state/new"), Some("state"), None, None], "--checkpoint", "lie one in the other"),
        (None, [Some("new"), None, None, Some("new/summary.json")], "--write-scene", "summary.json"),
        (None, [Some("new"), Some("same"), None, Some("./same")], "--checkpoint", "--write-scene"),
        (None, [Some("new"), None, Some("new/final.png"), None], "--resume", "final.png"),
        (Some("scene.toml"), [Some("new"), Some("a/../scene.toml"), None, None], "--scene", "--checkpoint"),
        (Some("scene.toml"), [Some("new"), None, None, Some("scene.toml")], "--scene", "--write-scene"),
        (Some("scene.toml"), [Some("scene.toml"), None, None, None], "--scene", "--out"),
        (Some("a/state"), [None, Some("hard"), None, None], "--scene", "--checkpoint"),
        (None, [Some("a"), Some("hard"), None, Some("a/state")], "--checkpoint", "--write-scene"),
    ];
    #[cfg(unix)]
    {
        use std::os::unix::fs::symlink;
        symlink("a", there("link")).unwrap();
        // To what is not there yet.
        symlink("link/trajectory.csv", there("dangling")).unwrap();
        symlink("circle", there("circle")).unwrap();
        cases.push((None, [Some("link"), Some("a/trajectory.csv"), None, None], "--checkpoint", "trajectory.csv"));
        cases.push((None, [Some("a"), Some("dangling"), None, None], "--checkpoint", "trajectory.csv"));
        cases.push((None, [Some("a"), Some("circle"), None, Some("circle")], "--checkpoint", "--write-scene"));
    }
    for (scene, flags, first, second) in cases {
        let told = refusal(&directory.0, scene, flags);
        let named = told.as_ref().is_some_and(|told| told.contains(first) && told.contains(second));
        assert!(named && told.as_ref().is_some_and(|told| told.contains("different names")), "{flags:?}: {told:?}");
    }
    assert_eq!(refusal(&directory.0, None, none), None);
    assert!(!there("new").exists(), "nothing is made before all is known");
}

#[test]
fn usual_places_are_taken() {
    let directory = Directory::new("usual");
    for flags in [
        [Some("out"), Some("out/checkpoint"), Some("out/checkpoint"), Some("out/scene.toml")],
        [Some("out"), Some("state"), Some("state.last"), Some("scene.toml")],
        [Some("."), Some("state"), None, None],
    ] {
        assert_eq!(refusal(&directory.0, Some("start.toml"), flags), None, "{flags:?}");
    }
}

#[test]
fn a_trial_of_a_checkpoint_leaves_other_files_alone() {
    let directory = Directory::new("trial");
    let other = directory.0.join("state.trial");
    fs::write(&other, "mine").unwrap();
    let flags = CheckpointFlags { checkpoint: Some(directory.0.join("state")), ..CheckpointFlags::default() };
    flags.resume(&mut motile::setup::Setup::default().build().unwrap().scene, "", 1.0).unwrap();
    assert_eq!(fs::read_to_string(&other).unwrap(), "mine");
    assert_eq!(fs::read_dir(&directory.0).unwrap().count(), 1);
}

/// One file under two names, whether or not it is linked.
#[test]
fn one_file_may_have_several_names() {
    let directory = Directory::new("names");
    let there = |name: &str| directory.0.join(name);
    fs::create_dir(there("a")).unwrap();
    fs::write(there("a/state"), "").unwrap();
    fs::write(there("other"), "").unwrap();
    fs::hard_link(there("a/state"), there("hard")).unwrap();
    let is_state = |name: &str| are_one(&there(name), &there("a/state"));
    assert!(
        is_state("a/state") && is_state("a/../a/./state") && !is_state("other") && !is_state("a") && !is_state("new")
    );
    #[cfg(unix)]
    assert!(is_state("hard"));
    assert!(are_one(&there("new"), &there("a/../new")));
}
