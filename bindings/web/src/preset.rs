//! Scenes to begin with.

/// Scene with its name, what it shows, and its text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub struct Preset {
    /// Name in links and of its picture.
    pub name: &'static str,
    /// Title.
    pub title: &'static str,
    /// Sentence about what it shows.
    pub about: &'static str,
    /// Text of its scene file.
    pub scene: &'static str,
}

/// All of them.
pub const PRESETS: [Preset; 7] = [
    Preset {
        name: "swimmer",
        title: "One swimmer",
        about: "One droplet in an unbounded fluid: its particles gather at the rear and it swims.",
        scene: include_str!("../presets/swimmer.toml"),
    },
    Preset {
        name: "meeting",
        title: "Two meet",
        about: "Two swimmers meet; the upper one is five times as viscous. A repulsion holds the film between them.",
        scene: include_str!("../presets/meeting.toml"),
    },
    Preset {
        name: "channel",
        title: "Zigzag in a channel",
        about: "A strong swimmer between rigid walls oscillates from wall to wall.",
        scene: include_str!("../presets/channel.toml"),
    },
    Preset {
        name: "nucleus",
        title: "Circles with a nucleus",
        about: "A rigid nucleus that starts off the axis makes the droplet swim in circles.",
        scene: include_str!("../presets/nucleus.toml"),
    },
    Preset {
        name: "sixteen",
        title: "Sixteen together",
        about: "Sixteen swimmers start at random places. They push and follow each other.",
        scene: include_str!("../presets/sixteen.toml"),
    },
    Preset {
        name: "constriction",
        title: "Through a constriction",
        about: "A swimmer squeezes through a throat that is narrower than it.",
        scene: include_str!("../presets/constriction.toml"),
    },
    Preset {
        name: "tube",
        title: "Along a tube (3D)",
        about: "Three dimensions: an axisymmetric droplet swims along a rigid tube.",
        scene: include_str!("../presets/tube.toml"),
    },
];
