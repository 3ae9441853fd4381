use clap::Parser;

use super::*;

#[derive(Debug, Parser)]
struct Flags {
    #[command(flatten)]
    scene: SceneFlags<ElasticFlags>,
}

fn channel(line: &str) -> Result<Setup> {
    let flags = Flags::try_parse_from(std::iter::once("test").chain(line.split_whitespace()))?;
    flags.scene.setup(&ChannelShape::Straight { width: flags.scene.region.width }, 0.0)
}

#[test]
fn walls_that_do_not_hold_their_mesh_are_refused_with_the_flag_to_change() {
    for (line, remedy) in [
        ("--mesh-spacing 5", "give --mesh-spacing 2 or less"),
        ("--mesh-spacing 0.001", "give --mesh-spacing 0.0039 or more"),
        ("--wall-thickness 0.1 --mesh-spacing 0.15", "give 0.15 or more, or a smaller --mesh-spacing"),
        ("--wall-thickness 0.01", "give 0.1 or more, or a smaller --spacing"),
        ("--wall-thickness 0.01 --method grid", "give 0.05 or more, or a smaller --spacing"),
        ("--method grid --nodes 100", "leave it out"),
        ("--width 0.1", "give a larger --width"),
        ("--bulk-modulus 3", "leave --bulk-modulus out"),
    ] {
        let refused = channel(line).unwrap_err().to_string();
        assert!(refused.contains(remedy), "{line}: {refused}");
    }
    for line in ["", "--mesh-spacing 2 --wall-thickness 3", "--wall-thickness 0.1 --length 3", "--mesh-spacing 0.01"] {
        assert!(channel(line).is_ok(), "{line}");
    }
}

#[test]
fn flags_that_say_the_same_are_named() {
    let line = ["test", "--stiffness", "1e3", "--shear-modulus", "10"];
    let error = Flags::try_parse_from(line).unwrap_err();
    let said = motile_cli::command_line::sentence(&error, &<Flags as clap::CommandFactory>::command());
    assert_eq!(said, "--stiffness and --shear-modulus say the same in two ways: give one of them");
}
