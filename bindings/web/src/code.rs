//! One run by the command line, from Python and in Rust.

use std::fmt::Write as _;

use motile::setup::Setup;

use crate::{Refusal, concise::concise};

/// Ways to run a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// Command line, in a copy of the repository, with the text of the scene file.
    Command,
    /// Python program.
    Python,
    /// Rust program.
    Rust,
}

impl Way {
    /// All of them with their names.
    pub const NAMES: [(&str, Self); 3] = [("command", Self::Command), ("python", Self::Python), ("rust", Self::Rust)];

    /// Way of a name.
    ///
    /// # Errors
    /// A name that none has.
    pub fn named(name: &str) -> Result<Self, Refusal> {
        let found = Self::NAMES.iter().find(|(known, _)| *known == name);
        Ok(found.ok_or_else(|| Refusal::plain(format!("there is no way {name} to run a scene")))?.1)
    }

    /// Text that runs a scene up to a time (time).
    ///
    /// # Errors
    /// A description that has no text.
    pub fn text(self, setup: &Setup, until: f64) -> Result<String, Refusal> {
        let scene = concise(setup)?;
        let mut text = String::new();
        let written = match self {
            Self::Command => write!(
                text,
                "cat > scene.toml <<'END'\n{scene}END\ncargo run --release --bin motile -- run scene.toml \
                 --time {until}\n"
            ),
            Self::Python => write!(
                text,
                "import motile\n\nsetup = motile.Setup.from_toml(\"\"\"\n{scene}\"\"\")\nscene = setup.build()\n\
                 track = scene.run({until})\nprint(track[\"speed\"][-1])\nscene.picture(\"final.png\")\n"
            ),
            Self::Rust => write!(
                text,
                "use motile::prelude::*;\n\nfn main() -> Result<(), Box<dyn std::error::Error>> {{\n    let setup = \
                 Setup::from_toml(\n        r#\"\n{scene}\"#,\n    )?;\n    let Built {{ mut scene, droplets, .. }} = \
                 setup.build()?;\n    scene.run({until:?}).go()?;\n    for droplet in droplets {{\n        \
                 println!(\"{{}}\", scene.observe(droplet)?.speed());\n    }}\n    Ok(())\n}}\n"
            ),
        };
        written.map_err(Refusal::plain)?;
        Ok(text)
    }
}
