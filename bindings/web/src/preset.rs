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
        title: "Swimmer",
        about: "One droplet in a periodic box: its particles gather at the rear and it swims.",
        scene: include_str!("../presets/swimmer.toml"),
    },
    Preset {
        name: "meeting",
        title: "Two that collide",
        about: "Two swimmers meet; the upper one is five times as viscous. A repulsion holds the film between them.",
        scene: include_str!("../presets/meeting.toml"),
    },
    Preset {
        name: "channel",
        title: "Channel",
        about: "A strong swimmer between rigid walls swings from wall to wall.",
        scene: include_str!("../presets/channel.toml"),
    },
    Preset {
        name: "nucleus",
        title: "Nucleus",
        about: "A rigid nucleus that starts off the axis makes the droplet swim in circles.",
        scene: include_str!("../presets/nucleus.toml"),
    },
    Preset {
        name: "sixteen",
        title: "Sixteen",
        about: "Sixteen swimmers at random places push and follow each other.",
        scene: include_str!("../presets/sixteen.toml"),
    },
    Preset {
        name: "constriction",
        title: "Constriction",
        about: "A swimmer squeezes between rigid walls and goes round a post.",
        scene: include_str!("../presets/constriction.toml"),
    },
    Preset {
        name: "tube",
        title: "Tube",
        about: "Three dimensions: a droplet of revolution swims along a rigid tube.",
        scene: include_str!("../presets/tube.toml"),
    },
];
