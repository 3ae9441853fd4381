//! Errors of descriptions, from which no scene can be built.

use active_interface::InterfaceError;
use elastic_solids::SolidError;
use motile_base::Refusal;
use motile_base::internal::{Refuse, place, told, told_apart};
use motile_boundary_integrals::LayerError;
use motile_interior::InteriorError;
use motile_scene::FlowError;
use outline_files::OutlineError;
use stokes_grid::StokesError;

use crate::setup::Squeezed;

/// A scene that could not be set up.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum SetupError {
    /// Error of the grid or the Stokes solver.
    #[error(transparent)]
    Stokes(#[from] StokesError),
    /// Error of a droplet's curve or particles.
    #[error(transparent)]
    Interface(#[from] InterfaceError),
    /// Error of the coupling of markers and fluid.
    #[error(transparent)]
    Flow(#[from] FlowError),
    /// Error of the scene as a whole.
    #[error(transparent)]
    Scene(#[from] motile_scene::SceneError),
    /// Error of the boundary integrals.
    #[error(transparent)]
    BoundaryIntegral(#[from] LayerError),
    /// Error of an elastic solid, its outline or its mesh.
    #[error(transparent)]
    Solid(#[from] SolidError),
    /// Error of an outline from a file or from points.
    #[error(transparent)]
    Outline(#[from] OutlineError),
    /// Error of a gel or of particles that fill a droplet.
    #[error(transparent)]
    Interior(#[from] InteriorError),
    /// Error of a droplet in three dimensions without symmetry.
    #[error(transparent)]
    Space(#[from] space_droplets::SpaceError),
    /// Value out of its range, or one that does not fit the rest of the description.
    #[error("{key} = {value}: {remedy}")]
    Value {
        /// Key of the value, with the keys of the entries that it is in: `droplets[0].tension`.
        key: String,
        /// The value.
        value: String,
        /// Remedy: the value to give instead, and the reason.
        remedy: String,
    },
    /// Error in an entry of one of the description's lists.
    #[error("{key}: {source}")]
    Entry {
        /// Key of the entry in the description, with its name if it has one.
        key: String,
        /// Error of the entry.
        source: Box<Self>,
    },
    /// Body too large for the region and its periodic images.
    #[error(
        "the body does not fit into the region of {length} x {width}. Move it to the middle, make it smaller, or \
         enlarge the region{hint}"
    )]
    NoRoom {
        /// Length of the region in x (length).
        length: f64,
        /// Length of the region in y, or distance of its walls (length).
        width: f64,
        /// Quantities that do not seem to be in the same units, if there are any.
        hint: String,
    },
    /// Body that starts inside another one, or where another one is.
    #[error(
        "{key} overlaps {other} by {} at {}, more than {}. Move them apart or make one of them smaller",
        told_apart([*depth, *allowed])[0], place(*x, *y), told_apart([*depth, *allowed])[1]
    )]
    Overlap {
        /// Key of the entry in the description, with its name if it has one.
        key: String,
        /// Key of the other body, with its name if it has one.
        other: String,
        /// Place of the contact in x (length).
        x: f64,
        /// Place of the contact in y (length).
        y: f64,
        /// Depth of the overlap (length).
        depth: f64,
        /// Depth that is allowed (length).
        allowed: f64,
    },
    /// Body that starts around a rigid wall.
    #[error("{key} contains {other}. Move one of them")]
    Contains {
        /// Key of the entry in the description, with its name if it has one.
        key: String,
        /// Key of the wall.
        other: String,
    },
    /// Droplet that starts in touch with another one, or with its own image.
    #[error("{key} touches {other} at {}. Leave a gap between them", place(*x, *y))]
    Touch {
        /// Key of the entry in the description, with its name if it has one.
        key: String,
        /// Key of the other droplet, with its name if it has one.
        other: String,
        /// Place of the contact in x (length).
        x: f64,
        /// Place of the contact in y (length).
        y: f64,
    },
    /// Target error that no settings were measured for.
    #[error("no settings are known for an error of {target:e}. Use a target from {smallest:e} to {largest}")]
    TargetError {
        /// Relative error asked for (no dimension).
        target: f64,
        /// Smallest error that was measured.
        smallest: f64,
        /// Largest error that settings are given for.
        largest: f64,
    },
    /// Scene file that cannot be read, or bodies that contradict each other.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

motile_base::debug_as_explanation!(SetupError);

impl SetupError {
    /// Returns the error for scene file that is not TOML or has unknown keys: the line and the problem there.
    #[cfg(feature = "toml")]
    pub(crate) fn file(problem: impl std::fmt::Display) -> Self {
        let what = "the scene file is not valid".to_owned();
        let told = WORDS.iter().fold(problem.to_string(), |text, (name, words)| text.replace(name, words));
        // A long line would hide the problem, which stands above and below its copy.
        let is_copy = |line: &str| line.len() > LONGEST_LINE && line.contains(" | ");
        let is_mark = |line: &str| line.trim_start().starts_with('|');
        let copied = told.lines().any(is_copy);
        let lines = told.trim_end().lines().filter(|line| !(copied && (is_copy(line) || is_mark(line))));
        let value = lines.map(shortened).collect::<Vec<_>>().join("\n");
        Self::refused(what, value, "Correct this entry")
    }

    /// Returns the error for round droplet of a radius that is larger than what walls leave around its centre, and what
    /// it would be squeezed to (length).
    pub(crate) fn wider_than_walls(radius: f64, room: f64, half_height: f64, to: Squeezed) -> Self {
        let [radius, room] = told_apart([radius, room]);
        let what = format!("a round droplet of radius {radius} does not fit between the walls and obstacles");
        let value = format!("they leave {room} around its centre");
        let to = if to == Squeezed::Ellipse { "an ellipse" } else { "a stadium" };
        let remedy = format!(
            "Move the droplet or the obstacle, use a smaller radius or wider walls, or add `squeezed = true` to the \
             droplet, so that it starts as {to} of its area of the half height {}",
            told(half_height)
        );
        Self::refused(what, value, remedy)
    }

    /// Returns the error for neighbouring interfaces that are periodic along x and give the fluid between them two
    /// viscosities: the keys of the lower and the upper one, and the viscosities (stress times time).
    pub(crate) fn two_viscosities([key, other]: [&str; 2], [lower, upper]: [f64; 2]) -> Self {
        let what = format!(
            "the fluid between {key} and {other}, or the image of one, would have the viscosities {lower} and {upper}"
        );
        let remedy = "Give both the same viscosity inside, or turn one of them over by its key `inside`".to_owned();
        Self::refused(what, "", remedy)
    }

    /// Returns the error for error with the key of the entry that it is about, unless it names it itself.
    pub(crate) fn of(self, key: &str) -> Self {
        match self {
            Self::Value { .. } | Self::Entry { .. } | Self::Overlap { .. } | Self::Contains { .. } => self,
            other => Self::Entry { key: key.to_owned(), source: Box::new(other) },
        }
    }
}

/// Phrases of the reader of TOML, and what they mean to the writer of a scene file.
#[cfg(feature = "toml")]
const WORDS: [(&str, &str); 9] = [
    ("unknown field", "unknown key"),
    ("missing field", "missing required key"),
    ("unknown variant", "unknown choice"),
    ("expected f64", "expected a number"),
    ("expected usize", "expected a whole number that is not negative"),
    ("expected u64", "expected a whole number that is not negative"),
    ("expected a sequence", "expected a list"),
    ("invalid type: ", ""),
    ("invalid value: ", ""),
];
/// Most characters of a line of an error about a scene file.
#[cfg(feature = "toml")]
const LONGEST_LINE: usize = 300;

/// Returns a line without its middle if it is long.
#[cfg(feature = "toml")]
fn shortened(line: &str) -> String {
    let count = line.chars().count();
    if count <= LONGEST_LINE {
        return line.to_owned();
    }
    let half = LONGEST_LINE / 2;
    let (head, tail) = (line.chars().take(half), line.chars().skip(count - half));
    head.chain(" ... ".chars()).chain(tail).collect()
}
