use super::*;
use crate::setup::Setup;

/// Texts with and without mistakes, at depths of all kinds.
const TEXTS: [&str; 24] = [
    include_str!("../../../scene.toml"),
    "",
    "viscosity = 1_000",
    "viscosity = 0x10",
    "viscosity = +inf",
    "viscosity = 1e400",
    "viscosity = 99999999999999999999999",
    "viscosity = true",
    "viscosity = 1979-05-27",
    "viscosty = 3.0",
    "a\u{fc}\u{df}en = 3.0",
    "[[droplets]]\nparticles.activty = -1.0",
    "[[droplets]]\nparticles = \"nothing\"",
    "[[droplets]]\nparticles = \"none\"\ncentre = [1, 2.5]\n",
    "[[droplets]]\ncentre = [1.0]",
    "[[droplets]]\ncentre = [1.0, 2.0, 3.0]",
    "[[droplets]]\ncentre = \"here\"",
    "[method.grid]\nspacing = \"fine\"",
    "method = \"grid\"\nmethod.grid.spacing = 0.1",
    "[region.pipe]\nlength = 3.0",
    "[region.channel]\nlength = 3.0",
    "[region]\nbox = [[",
    "[[suspension]]\nseed = 18446744073709551615\ncount = -1\n",
    "[[suspension]]\ncount = 3\nactivity = { normal = { mean = -2, deviation = 0.1 } }\nviscosity = [1, 2]\n",
];

#[test]
fn texts_are_read_as_by_the_reader_of_the_language() {
    for text in TEXTS {
        let expected = toml::from_str::<Setup>(text).map_err(|error| error.to_string());
        match (read::<Setup>(text), expected) {
            (Ok(read), Ok(expected)) => assert_eq!(read, expected, "{text}"),
            (Err(read), Err(expected)) => {
                // Numbers that are too large and dates have words of their own.
                let place = |error: &str| error.lines().take(4).collect::<Vec<_>>().join("\n");
                let own = ["1e400", "99999999999", "1979"].iter().any(|part| text.contains(part));
                let [read, expected] = if own { [place(&read), place(&expected)] } else { [read, expected] };
                assert_eq!(read, expected, "{text}");
            }
            (read, expected) => panic!("{text}: {read:?}, not {expected:?}"),
        }
    }
}

#[test]
fn variants_name_what_they_take() {
    for (text, part) in [
        ("[region]\nbox.lengths = [8.0, 6.0]\nchannel = {}", "one entry is to be chosen here, there are 2"),
        // Letters are marked, not bytes.
        ("\"\u{fc}\u{fc}\" = 1.0\r\n", "1 | \"\u{fc}\u{fc}\" = 1.0\n  | ^^^^\n"),
        ("region = {}", "one entry is to be chosen here, there are 0"),
        ("region = 3", "invalid type: integer `3`"),
        ("region = \"box\"", "invalid type: unit variant"),
        ("[[droplets]]\nshape.ellipse.half_axes = [1.0, 1.0]", "unknown field `half_axes`, expected `half-axes`"),
    ] {
        let error = read::<Setup>(text).expect_err(text);
        assert!(error.starts_with("TOML parse error at line") && error.contains(part), "{text}: {error}");
    }
}
