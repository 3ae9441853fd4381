//! Nothing depends on the units: scenes in other units of length, time and force take the same steps to the same
//! places. What each key of a scene file changes by with the units is what its reference says in parentheses.
use crate::dimensions;

use std::path::Path;

use motile::prelude::*;
use motile::scene::SceneError;
use toml::Value;

use dimensions::{Dimension, Dimensions};

/// Units of length, time and force in those of a file, as powers of two.
const UNITS: [Dimension; 2] = [[-17, 6, -10], [17, -9, 8]];
/// Least number of runs to the same bits.
const LEAST_EQUAL: usize = 20;
/// Steps of a run.
const STEPS: usize = 3;

/// Scenes for the keys that neither the annotated scene nor the examples have, or have as zero.
const SCENES: &[&str] = &[
    r#"
region.channel = { length = 8.0, width = 5.0 }
method.integral = { nodes = 24, elements = 48 }
[[droplets]]
centre = [-2.0, -0.3]
friction = 0.5
wall-friction = 2.0
fields.friction = [{ uniform = 0.25 }]
particles = { activity = -3.0 }
[[shells]]
centre = [2.0, -0.5]
reference-curvature = 3.0
cortex-viscosity = 3.0
[[interfaces]]
height = 1.7
wall-friction = 1.5
particles = { activity = -0.5, start.perturbed = { amplitude = 0.1, seed = 1 } }
"#,
    r#"
region.channel = { length = 6.0, width = 3.0, drive = { gradient = -0.5 }, slip = [0.1, 0.3] }
friction = 30.0
method.grid = { spacing = 0.1 }
[[droplets]]
particles = { activity = -3.0 }
"#,
    r#"
region.channel = { length = 8.0, width = 4.0 }
method.integral = { nodes = 24, elements = 96 }
walls = [
    { outline.wall-below-line = { points = [[0, 0.5], [3, 0.6], [9, 0.4], [13, 0.7]], scale = 0.5, place = [-4.0, -2.0], smooth = 0.05 }, spacing = 0.2 },
    { outline.closed = { points = [[0, 0], [2, 0], [2, 1], [0, 1]], scale = 0.5, place = [2.5, 0.3], rounding = 0.25 }, spacing = 0.1 },
]
[[droplets]]
shape.outline = { points = [[0, 0], [20, 0], [24, 20], [0, 16]], scale = 0.06, place = [0.1, -0.2], rounding = 0.4 }
[[rigid-bodies]]
centre = [-2.5, 0.6]
shape.outline = { points = [[0, 0], [20, 0], [24, 20], [0, 16]], scale = 0.03, origin.point = [11, 9], smooth = 0.06 }
"#,
    r#"
region.channel = { length = 8.0, width = 5.0 }
method.grid = { spacing = 0.25, corrected = false }
[[droplets]]
centre = [-2.2, 0.0]
shape.round.radius = 0.7
[[solids]]
hold = "free"
outline.closed = { points = [[0, 0], [20, 0], [24, 20], [0, 16]], scale = 0.05, place = [0.1, -0.5], smooth = 0.1 }
mesh-spacing = 0.25
material.springs.shear = 400.0
[[solids]]
outline.mesh.points = [[0, 0], [1, 0], [1, 1], [0, 1]]
outline.mesh.triangles = [[0, 1, 2], [0, 2, 3]]
outline.mesh.scale = 0.75
outline.mesh.place = [2.2, 0.1]
outline.mesh.groups = [{ name = "a", members = [1] }]
outline.mesh.factors = [{ group = "a", factor = 2.5 }]
hold = "free"
material.neo-hookean = { shear = 500.0, bulk = 900.0 }
[[solids]]
outline.wall-above-line = { points = [[0, -8], [30, -7]], scale = 0.1, place = [-4.0, 2.5], smooth = 0.05 }
material.springs.shear = 400.0
[[solids]]
outline.wall-below-line = { points = [[0, 8], [30, 7], [60, 9]], scale = 0.1, place = [-4.0, -2.5], rounding = 0.2 }
material.springs.shear = 400.0
"#,
    r#"
region.channel = { length = 8.0, width = 5.0 }
method.integral = { nodes = 32, elements = 64 }
[[interfaces]]
height = 0.3
shape.line = { points = [[0, 0], [20, 3], [50, -2]], scale = 0.1, place = [-4.0, 0.1], smooth = 0.05 }
"#,
    r#"
region = "plane"
viscosity = 1.0
least-gap = 0.001
method.integral = { nodes = 24, elements = 48 }
flow = { shear = 1.0, extension = 0.5, rotation = 0.1, poiseuille = { speed = 1.0, half-width = 5.0 } }
repulsion = { strength = 500.0, range = 0.1 }
[[droplets]]
tension = 5.0
bending = 0.1
reference-curvature = 0.5
viscosity = 3.0
cortex.viscosity = 2.0
friction = 0.5
area-constraint = true
shape.modes = { radius = 0.9, cosines = [0.0, 0.1], sines = [0.0, 0.0, 0.05] }
particles = "none"
[[rigid-bodies]]
centre = [3.0, 0.3]
shape.ellipse.half-axes = [0.6, 0.3]
torque = 0.3
[[shells]]
centre = [-3.0, 0.5]
shape.ellipse.half-axes = [0.8, 0.6]
rest.round.radius = 0.7
stretching = 3.0
bending = 0.1
reference-curvature = 1.3
viscosity = 2.0
"#,
    r#"
region.channel = { length = 8.0, width = 4.0, drive = { flux = 0.25 } }
viscosity = 50.0
method.integral = { nodes = 24, elements = 96 }
flow.wall-velocity = [-0.3, 0.2]
[[droplets]]
centre = [0.2, 0.3]
tension = 8.0
cortex = { viscosity = 3.0, per-concentration = 0.25 }
particles = { activity = -3.0, excluded-volume.step-at = { strength = 9.0, threshold = 220.0, steepness = 15.0 } }
[[rigid-bodies]]
centre = [3.5, 0.8]
shape.points = [[0.3, 0], [0.25, 0.2], [0, 0.3], [-0.2, 0.2], [-0.3, 0], [-0.2, -0.2], [0, -0.3], [0.25, -0.2]]
force = [0.5, -0.2]
torque = 0.2
"#,
    r#"
region.channel = { length = 8.0, width = 4.0, drive = { flux = 0.25 }, slip = 0.1 }
viscosity = 50.0
method.integral = { nodes = 24, elements = 96 }
[[droplets]]
centre = [0.2, 0.3]
[[rigid-bodies]]
centre = [3.5, 0.8]
shape.ellipse.half-axes = [0.4, 0.3]
velocity = [0.2, -0.1]
angular-velocity = 0.3
[[rigid-bodies]]
held = true
centre = [-2.8, -0.8]
"#,
    r#"
region.channel = { length = 8.0, width = 4.0, drive = { gradient = -2.0 } }
method.integral = { nodes = 24, elements = 96 }
step.fixed = 0.002
walls = [{ outline.wall-below.sinusoidal = { width = 3.4, amplitude = 0.2, waves = 2 }, spacing = 0.2, grading = 2.0, rounding = 0.1 }]
[[droplets]]
centre = [0.2, 0.3]
shape.squeezed = { radius = 1.0, half-height = 0.8, to = "ellipse" }
particles.exchange = { binding = 0.1, unbinding = 0.2, number-inside = 300.0, diffusion-inside = 0.3, spacing-inside = 0.2 }
particles.excluded-volume.quadratic = 0.02
"#,
    r#"
region.tube = { radius = 1.5, shape.constriction = { throat = 0.9, throat-length = 1.5, ramp = 1.5 }, length = 14.0, drive = { flux = 0.25 } }
method.integral = { nodes = 32, elements = 64 }
[[droplets]]
centre = [-3.5, 0.0]
particles = { activity = -1.5, concentration = 80.0, excluded-volume.step = 3.0 }
"#,
    r#"
region.tube = { radius = 1.5, shape.sinusoidal = { amplitude = 0.2, period = 6.0 }, length = 12.0 }
method.integral = { nodes = 32, elements = 64 }
[[droplets]]
viscosity = 60.0
particles = { activity = -1.0, excluded-volume.quadratic = 0.01 }
"#,
    r#"
region.tube = { radius = 1.3, drive = { gradient = -20.0 }, length = 12.0 }
method.integral = { nodes = 32, elements = 64 }
repulsion = { strength = 5000.0, range = 0.1 }
[[droplets]]
particles = { activity = -1.0, excluded-volume.step-at = { strength = 3.0, threshold = 200.0, steepness = 20.0 } }
"#,
    r#"
region = "space"
method.integral = { nodes = 32, elements = 64 }
[[droplets]]
centre = [0.3, 0.0]
shape.ellipse.half-axes = [1.2, 0.9]
particles = { activity = -1.0, diffusion = 0.15 }
"#,
    r#"
region.slit = { lower = -1.5, upper = 1.8 }
method.harmonics.degree = 4
[[droplets]]
position = [0.3, -0.2, 0.1]
heading = [1.0, 0.5, 0.3]
viscosity = 60.0
particles = { activity = -1.0, excluded-volume.step = 2.0 }
"#,
    r#"
region.box.lengths = [6.0, 3.0, 3.5]
method.harmonics.degree = 4
repulsion = { strength = 200.0, range = 0.2 }
[[droplets]]
position = [0.3, -0.2, 0.1]
heading = [1.0, 0.5, 0.3]
[[droplets]]
position = [3.3, -0.2, 0.1]
shape.ellipse.half-axes = [1.1, 0.9]
"#,
    r#"
region.tube = { radius = 1.7, drive = { flux = 0.25 } }
method.harmonics.degree = 4
[[droplets]]
centre = [0.3, 0.2]
angle = 0.4
particles = { activity = -1.0, diffusion = 0.15 }
"#,
    r#"
region.box.lengths = [6.0, 6.0]
method.grid = { spacing = 0.25, marker-spacing = 0.15, solver = "projection" }
[[droplets]]
centre = [0.1, 0.2]
shape.points = [[1.1, 0], [0.7, 0.7], [0, 1], [-0.7, 0.7], [-1, 0], [-0.7, -0.7], [0, -1], [0.7, -0.7]]
"#,
    r#"
region.box.lengths = [6.0, 6.0]
method.grid.spacing = 0.25
droplets = []
gels = [{ spacing = 0.25, start.random.seed = 1, material = { frank = 2.0, bend = 3.0, rotational-viscosity = 90.0, activity = -300.0 } }]
"#,
    r#"
region.box.lengths = [6.0, 8.0]
method.integral = { nodes = 32, elements = 96 }
droplets = []
[[interfaces]]
height = 1.5
viscosity = 120.0
tension = 7.0
shape.points = [[-3, 0], [-2.2, 0.1], [-1.5, 0], [-0.7, -0.1], [0, 0.05], [0.7, 0], [1.5, 0.1], [2.2, 0]]
[[interfaces]]
height = -1.5
inside = "below"
viscosity = 120.0
motion = "with-fluid"
shape.waves = { cosines = [0.1], sines = [0.0, 0.05] }
elasticity = { stretching = 10.0, bending = 0.1 }
particles = "none"
"#,
    r#"
region.box.lengths = [8.0, 6.0]
method.integral = { nodes = 24, elements = 96 }
[[droplets]]
centre = [-1.5, 0.2]
force = [3.0, -2.0]
"#,
    r#"
region.box.lengths = [8.0, 6.0]
method.integral = { nodes = 24, elements = 96 }
[[droplets]]
centre = [-1.5, 0.2]
[[droplets.fields.activity]]
uniform = 0.1
modulation = { mean = 0.5, amplitude = 0.4, frequency = 3.0, phase = 0.2 }
"#,
    r#"
region.box.lengths = [8.0, 6.0]
method.integral = { nodes = 24, elements = 96 }
[[droplets]]
centre = [-1.5, 0.2]
[[droplets.fields.activity]]
spot = { amplitude = -0.2, centre = [-1.0, 0.5], radius = 1.2 }
"#,
    r#"
region.box.lengths = [8.0, 6.0]
method.integral = { nodes = 24, elements = 96 }
[[droplets]]
centre = [-1.5, 0.2]
[[droplets.fields.tension]]
uniform = 1.5
[[droplets.fields.tension]]
wave = { amplitude = 0.7, wave-vector = [0.7853981633974483, 0.0], frequency = 2.0, phase = 0.3 }
"#,
    r#"
region.box.lengths = [8.0, 6.0]
method.integral = { nodes = 24, elements = 96 }
[[droplets]]
centre = [-1.5, 0.2]
[[droplets.fields.tension]]
gradient = { slope = [0.5, 0.2], origin = [0.3, 0.1] }
"#,
    r#"
region = "plane"
method.integral = { nodes = 24, elements = 96 }
[[droplets]]
[[droplets.fields.tension]]
table = { origin = [-2.0, -2.5], spacing = [2.0, 2.5], values = [[1.0, 2.0, 1.5], [0.5, 1.0, 2.0], [1.0, 0.5, 1.0]] }
"#,
    r#"
region = "space"
method.integral = { nodes = 24, elements = 96 }
[[droplets]]
cortex = { viscosity = 20.0, shear-viscosity = 10.0 }
"#,
    r#"
region.channel = { length = 6.0, width = 4.0 }
method.integral = { nodes = 24, elements = 96 }
[[interfaces]]
height = 0.3
[[interfaces.fields.tension]]
gradient = { slope = [0.0, 0.4] }
"#,
    r#"
region.box.lengths = [12.0, 12.0]
method.integral = { nodes = 16, elements = 32 }
suspension = [{ count = 4, radius = [0.8, 1.0], gap = 0.2, activity.normal = { mean = -2.5, deviation = 0.2 }, viscosity = [80.0, 120.0], droplet.tension = 8.0 }]
"#,
    r#"
region.channel = { length = 8.0, width = 5.0 }
method.layers = { nodes = 24, elements = 96, spacing = 0.125 }
[[droplets]]
centre = [-2.0, 0.1]
shape.round.radius = 0.7
[[solids]]
outline.wall-below.constriction = { width = 3.6, throat = 2.4, throat-length = 2.0, ramp = 1.0, centre = 0.5 }
material.saint-venant-kirchhoff = { shear = 1000.0, bulk = 1500.0 }
grading.along = { axis = "x", factors = [[-4.0, 1.0], [0.0, 3.0], [4.0, 1.0]] }
hold.tethered.stiffness = 500.0
surface-elasticity = { stretching = 3.0, bending = 0.5 }
[[solids]]
outline.wall-above.sinusoidal = { width = 3.6, amplitude = 0.2, waves = 2, phase = 0.3 }
material.mooney-rivlin = { shear = 900.0, bulk = 1500.0, fraction = 0.4 }
grading.stripes = { axis = "x", width = 2.0, from = -3.0, factors = [1.0, 2.0] }
[[solids]]
hold = "free"
force = [2.0, 1.0]
outline.disc = { centre = [2.2, 0.0], radius = 0.6 }
mesh-spacing = 0.25
material = "fluid-like"
relaxation = [{ modulus = 90.0, time = 5.0 }]
viscosity = 160.0
"#,
    r#"
region.channel = { length = 8.0, width = 5.0 }
method.grid = { spacing = 0.25, corrected = false }
[[droplets]]
centre = [-2.2, 0.0]
shape.round.radius = 0.7
[[solids]]
outline.wall-below.valve = { width = 3.6, gap = 1.8, base = 1.5, rounding = 0.3, centre = 1.0 }
material.springs.shear = 400.0
grading.product = [{ step = { axis = "x", at = 0.5, factors = [1.0, 2.0] } }, "uniform"]
active-springs = { tension = 5.0, on = 20.0, off = 30.0, seed = 1, on-sensitivity = 0.5, off-sensitivity = 0.2 }
tension-grading.step = { axis = "x", at = 0.3, factors = [1.0, 4.0] }
[[solids]]
outline.wall-above-points = [[-4, 1.9], [-2, 1.7], [2, 1.9]]
material.neo-hookean = { shear = 500.0, bulk = 900.0 }
relaxation = [{ modulus = 90.0, time = 5.0 }]
relaxation-time-grading.step = { axis = "x", at = 0.2, factors = [1.0, 4.0] }
"#,
    r#"
region.channel = { length = 12.0, width = 7.0 }
method.layers = { nodes = 24, elements = 96, spacing = 0.125 }
[[droplets]]
centre = [-4.7, 0.2]
shape.round.radius = 0.7
[[solids]]
hold = "free"
outline.island = { number = 0, of.branching = { width = 5.0, branches = [1.8, 1.8], island-length = 4.0, island-thickness = 1.4, ramp = 2.0 } }
material.neo-hookean = { shear = 500.0, bulk = 900.0 }
[[solids]]
outline.wall-below.ratchet = { width = 5.4, throat = 4.4, teeth = 2, rise = 0.8 }
material.neo-hookean = { shear = 500.0, bulk = 900.0 }
[[solids]]
hold = "free"
outline.polygon = { corners = [[4.0, -0.6], [5.2, -0.6], [4.6, 0.8]], rounding = 0.2 }
mesh-spacing = 0.3
material.neo-hookean = { shear = 500.0, bulk = 900.0 }
"#,
    r#"
region.channel = { length = 8.0, width = 5.0 }
method.layers = { nodes = 24, elements = 96, spacing = 0.125 }
[[droplets]]
shape.round.radius = 0.7
[[solids]]
hold = "free"
outline.ellipse = { centre = [2.5, 0.1], half-axes = [0.7, 0.5] }
mesh-spacing = 0.25
material.neo-hookean = { shear = 500.0, bulk = 900.0 }
[[solids]]
outline.wall-below-points = [[-4, -1.9], [-2, -1.7], [2, -1.9]]
material.springs.shear = 400.0
"#,
    r#"
region.channel = { length = 8.0, width = 5.0 }
method.layers = { nodes = 24, elements = 96, spacing = 0.125 }
[[droplets]]
shape.round.radius = 0.7
gel.material = { frank = 2.0, bend = 3.0, spontaneous-splay = -4.0, activity = -30.0 }
[[solids]]
outline.wall-below.constriction = { width = 4.0, throat = 3.4, throat-length = 1.5, ramp = 1.0, exit-ramp = 2.0 }
material.springs.shear = 400.0
"#,
    r#"
region.channel = { length = 4.0, width = 2.0, drive = { gradient = -0.5 } }
viscosity = 1.0
method.grid.spacing = 0.125
[[fibres]]
shape.line = { from = [0.0, -1.0], to = [0.1, -0.25] }
spacing = 0.1
stretching = 20.0
bending = 0.05
rest-length = 0.8
reference-curvature = 0.5
ends = ["clamped", "free"]
wave = { amplitude = 1.0, wave-number = 3.0, frequency = 4.0, phase = 0.3 }
targets = [{ nodes = [2, 4], stiffness = 3.0, offset = [0.1, 0.05], velocity = [0.1, -0.1], wave = { displacement = [0.1, 0.05], wave-number = 2.0, frequency = 5.0, phase = 0.1 } }]
loads = [{ force = [0.2, -0.1] }]
[[fibres]]
shape.arc = { from = [1.0, 0.1], angle = 0.4, length = 0.7, curvature = 1.5 }
stretching = 20.0
bending = 0.05
ends = ["pinned", "free"]
[[fibres]]
shape.points = [[-1.0, 0.2], [-0.9, 0.21], [-0.8, 0.23]]
stretching = 20.0
bending = 0.05
[[fibres]]
shape.closed-points = [[-1.0, -0.2], [-0.9, -0.21], [-0.9, -0.3], [-1.0, -0.33]]
stretching = 20.0
bending = 0.05
[[fibres]]
shape.across.height = 0.6
stretching = 20.0
bending = 0.05
"#,
    r#"
region = "plane"
viscosity = 2.0
method.integral = { nodes = 24, elements = 48 }
flow.shear = 0.7
[[fibres]]
shape.arc = { from = [1.0, 0.1], angle = 0.4, length = 0.7, curvature = 1.5 }
stretching = 20.0
bending = 0.05
reference-curvature = 0.0
"#,
    r#"
region.channel = { length = 8.0, width = 5.0 }
method.layers = { nodes = 32, elements = 64, spacing = 0.125 }
[[interfaces]]
height = 1.2
gel = { spacing = 0.2, anchoring = "planar", material.activity = -50.0 }
"#,
    r#"
region = "space"
method.harmonics.degree = 4
flow = { shear = 0.02, extension = 0.01, rotation = 0.03 }
repulsion = { strength = 500.0, range = 0.5 }
[[droplets]]
position = [-1.2, 0.1, 0.3]
heading = [1.0, 0.2, -0.3]
particles = { activity = -1.0, excluded-volume.step = 2.0 }
[[droplets]]
position = [1.2, 0.0, -0.2]
viscosity = 50.0
particles = { activity = -0.5, excluded-volume.step = 2.0, start.perturbed = { amplitude = 0.2, seed = 3 } }
"#,
];

/// Where all markers are after some steps (length), the time, and the steps.
struct Seen {
    markers: Vec<[f64; 2]>,
    time: f64,
    steps: usize,
}

fn seen(text: &str) -> Result<Seen, String> {
    let setup = Setup::from_toml(text).map_err(|error| error.to_string())?;
    let Built { mut scene, space, .. } = setup.build().map_err(|error| error.to_string())?;
    let end = 1e3 * setup.placed().map_err(|error| error.to_string())?.time_scale();
    match scene.run(end).most_steps(STEPS).go() {
        Ok(()) | Err(SceneError::TooManySteps { .. }) => {}
        Err(error) => return Err(error.to_string()),
    }
    let mut markers: Vec<_> = scene.system().markers().positions().iter().map(|place| place.to_array()).collect();
    if let Some(droplets) = space {
        let body = scene.body(droplets).map_err(|error| error.to_string())?;
        for droplet in body.droplets().droplets() {
            let mesh = droplet.mesh().map_err(|error| error.to_string())?;
            markers.extend(mesh.points.iter().flat_map(|[x, y, z]| [[*x, *y], [*z, 0.0]]));
        }
    }
    Ok(Seen { markers, time: scene.time(), steps: scene.steps() })
}

/// Text of a description.
fn text_of(description: &Value) -> String {
    description.as_table().expect("a table").to_string()
}

/// A complete description, with all defaults written out.
fn complete(text: &str) -> Value {
    let setup = Setup::from_toml(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    setup.to_toml().expect("a description").parse::<toml::Table>().expect("TOML").into()
}

fn examples() -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/scenes");
    let mut files: Vec<_> =
        std::fs::read_dir(folder).expect("scenes").map(|file| file.expect("a file").path()).collect();
    files.sort();
    let read =
        |file: &std::path::PathBuf| (file.display().to_string(), std::fs::read_to_string(file).expect("a scene"));
    files.iter().map(read).collect()
}

/// The annotated scene, the examples, and those above, by their names.
fn all() -> Vec<(String, String)> {
    let reference = ("scene.toml".to_owned(), include_str!("../../scene.toml").to_owned());
    let others = SCENES.iter().enumerate().map(|(number, text)| (format!("scene {number}"), (*text).to_owned()));
    [reference].into_iter().chain(examples()).chain(others).collect()
}

/// Largest difference in other units, relative to the extent of the scene.
fn difference(dimensions: &Dimensions, plain: &Value, expected: &Seen, units: Dimension) -> Result<f64, String> {
    let mut scaled = plain.clone();
    dimensions.scale(&mut scaled, units);
    let found = seen(&text_of(&scaled))?;
    if (found.steps, found.markers.len()) != (expected.steps, expected.markers.len()) {
        return Err(format!("{} steps in place of {}", found.steps, expected.steps));
    }
    let [length, time] = [0, 1].map(|k| 2.0_f64.powi(units[k]));
    let extent = expected.markers.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
    let pairs = found.markers.iter().flatten().zip(expected.markers.iter().flatten());
    let places = pairs.map(|(a, b)| (a / length - b).abs() / extent);
    Ok(places.chain([(found.time / time / expected.time - 1.0).abs()]).fold(0.0, f64::max))
}

#[test]
fn scenes_in_other_units_take_the_same_steps_to_the_same_places() {
    let dimensions = Dimensions::of(include_str!("../../scene.toml"));
    let (mut wrong, mut equal) = (Vec::new(), 0);
    for (name, text) in all() {
        let plain = complete(&text);
        let expected = match seen(&text_of(&plain)) {
            Ok(expected) => expected,
            Err(error) => {
                wrong.push((name, [0; 3], Err(error)));
                continue;
            }
        };
        for units in UNITS {
            match difference(&dimensions, &plain, &expected, units) {
                Ok(0.0) => equal += 1,
                Ok(difference) if difference < 1e-9 => {}
                other => wrong.push((name.clone(), units, other)),
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    // Logarithms of distances leave round-off in the others.
    assert!(equal >= LEAST_EQUAL, "{equal} runs to the same bits");
}

/// Every key of the reference that has a dimension is in one of the scenes above with a value that is not zero, or one
/// with the same names at its end.
#[test]
fn every_key_with_a_dimension_is_tried() {
    let dimensions = Dimensions::of(include_str!("../../scene.toml"));
    let mut tried = std::collections::HashSet::new();
    for (_, text) in all() {
        dimensions::visit(&mut complete(&text), &mut Vec::new(), &mut |path, numbers| {
            if numbers.iter().any(|number| **number != 0.0) {
                let key = dimensions::canonical(path);
                tried.insert(key.rsplit('.').take(2).collect::<Vec<_>>().join("."));
                tried.insert(key);
            }
        });
    }
    let of = |key: &str| key.rsplit('.').take(2).collect::<Vec<_>>().join(".");
    let missing: Vec<&String> =
        dimensions.keys().filter(|key| !tried.contains(*key) && !tried.contains(&of(key))).collect();
    assert!(missing.is_empty(), "{missing:#?}");
}
