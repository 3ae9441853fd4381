//! Descriptions of elastic fibres.

use std::path::Path;

use elastic_solids::{Fibre, FibreEnd, FibreFiles, FibreWave, Target};
use motile_base::{Region, Vec2};
use serde::{Deserialize, Serialize};

use super::{
    Method, MethodKind, Setup,
    body::{BodySetup, Planned},
    check::BALANCED,
    checked::Checked,
    method::MARKERS,
};
use crate::SetupError;

/// Default moduli of stretching (force) and bending (force times length squared).
const MODULI: [f64; 2] = [100.0, 0.1];
/// Most segments of a fibre.
const MOST_SEGMENTS: f64 = 1e5;
/// Segments of a fibre without a grid, unless it has a spacing.
const SEGMENTS: f64 = 40.0;

/// An elastic fibre: a beam, a hair, a flagellum.
///
/// ```
/// use motile::prelude::*;
/// use motile::setup::{FibreHold, FibreSetup, FibreShape};
///
/// // A hair on the lower wall of a channel bends in the flow.
/// let setup = Setup {
///     region: Region::Channel { length: 4.0, width: 2.0, drive: Drive::Gradient(-1.0) },
///     viscosity: 1.0,
///     method: Method::Grid(GridMethod::of_spacing(0.125)),
///     droplets: Vec::new(),
///     fibres: vec![FibreSetup {
///         shape: FibreShape::Line { from: [0.0, -1.0], to: [0.0, -0.25] },
///         ends: [FibreHold::Clamped, FibreHold::Free],
///         ..FibreSetup::default()
///     }],
///     ..Setup::default()
/// };
/// let Built { mut scene, fibres, .. } = setup.build()?;
/// scene.run(0.1).go()?;
/// let seen = scene.observe(fibres[0])?;
/// println!("the fluid pulls at its clamp with {:.3}", seen.end_forces[0].x);
/// assert!(seen.end_forces[0].x > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
#[doc(alias("fiber", "filament", "beam", "flagellum", "cilium"))]
pub struct FibreSetup {
    /// Name for messages.
    pub name: String,
    /// Shape at the start.
    pub shape: FibreShape,
    /// Distance of its nodes (length); `None` for the spacing of the markers on a grid, if that is given, or the
    /// spacing of the grid. With the method integral, which has fibres in the plane only, a fortieth of a line or arc;
    /// all fibres are then as thick as the smallest distance of nodes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spacing: Option<f64>,
    /// Modulus of stretching (force); `None` for 100, or what its files say.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stretching: Option<f64>,
    /// Modulus of bending (force times length squared); `None` for 0.1, or what its files say.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bending: Option<f64>,
    /// Length at rest (length); `None` for the length at the start, or what its files say.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rest_length: Option<f64>,
    /// Curvature at which bending is at rest everywhere (1/length), positive where the fibre turns left; `None` for the
    /// curvature of the shape at the start, or what its files say.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reference_curvature: Option<f64>,
    /// A wave that is added to the curvature at rest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wave: Option<CurvatureWaveSetup>,
    /// How the first and the last node are held.
    pub ends: [FibreHold; 2],
    /// Springs from nodes to places.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub targets: Vec<TargetSetup>,
    /// Forces on nodes.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub loads: Vec<LoadSetup>,
}

/// Shape of a fibre at the start, at its place in the region.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", rename_all_fields = "kebab-case")]
#[non_exhaustive]
pub enum FibreShape {
    /// A straight line.
    Line {
        /// Place of its first node (length).
        from: [f64; 2],
        /// Place of its last node (length).
        to: [f64; 2],
    },
    /// An arc.
    Arc {
        /// Place of its first node (length).
        from: [f64; 2],
        /// Direction in which it starts (radians).
        angle: f64,
        /// Length along it (length).
        length: f64,
        /// Its curvature (1/length), positive where it turns left.
        curvature: f64,
    },
    /// Nodes at these places (length), in their order.
    Points(Vec<[f64; 2]>),
    /// Nodes at these places (length), the last one next to the first one.
    ClosedPoints(Vec<[f64; 2]>),
    /// A straight line over one period along x, without ends.
    Across {
        /// Its height (length).
        height: f64,
    },
    /// Files of other programs, with paths relative to the scene file: `name.vertex`, and `name.spring`, `name.beam`
    /// and `name.target` if they exist ([`FibreFiles`]). When the scene is read, their contents take their place
    /// ([`Setup::with_files`]).
    Files(String),
    /// The contents of such files.
    Contents {
        /// Of the file of nodes.
        vertex: String,
        /// Of the file of springs.
        spring: String,
        /// Of the file of beams; empty without one.
        #[serde(default, skip_serializing_if = "String::is_empty")]
        beam: String,
        /// Of the file of targets; empty without one.
        #[serde(default, skip_serializing_if = "String::is_empty")]
        target: String,
    },
}

impl FibreShape {
    /// Replaces files, whose paths are relative to that directory, by their contents.
    pub(super) fn embed(&mut self, directory: &Path) -> Result<(), SetupError> {
        if let Self::Files(name) = self {
            let [vertex, spring, beam, target] = FibreFiles::texts(&directory.join(&*name))?;
            *self = Self::Contents { vertex, spring, beam, target };
        }
        Ok(())
    }
}

/// How an end of a fibre is held ([`FibreEnd`]).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum FibreHold {
    /// Nothing holds it.
    #[default]
    Free,
    /// Its position is held.
    Pinned,
    /// Its position and its tangent are held.
    Clamped,
}

impl From<FibreHold> for FibreEnd {
    fn from(hold: FibreHold) -> Self {
        match hold {
            FibreHold::Free => Self::Free,
            FibreHold::Pinned => Self::Pinned,
            FibreHold::Clamped => Self::Clamped,
        }
    }
}

/// A wave of curvature `amplitude sin(wave-number s - frequency t + phase)`, s the length at rest from the first node.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct CurvatureWaveSetup {
    /// Amplitude (1/length).
    pub amplitude: f64,
    /// Wave number (radians per length).
    pub wave_number: f64,
    /// Angular frequency (radians per time).
    #[serde(default)]
    pub frequency: f64,
    /// Phase (radians).
    #[serde(default)]
    pub phase: f64,
}

/// Springs from nodes of a fibre to places ([`Target`]).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct TargetSetup {
    /// Numbers of the first and of the last node that have one, from 0; `None` for all nodes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub nodes: Option<[usize; 2]>,
    /// Spring constant of each node (force per length).
    pub stiffness: f64,
    /// Displacement of the targets from the places of the nodes at the start (length).
    #[serde(default)]
    pub offset: [f64; 2],
    /// Velocity of the targets (length per time).
    #[serde(default)]
    pub velocity: [f64; 2],
    /// A wave that displaces the targets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wave: Option<TargetWaveSetup>,
}

/// A wave of displacement `displacement sin(wave-number s - frequency t + phase)`, s the length at rest from the first
/// node.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct TargetWaveSetup {
    /// Largest displacement (length).
    pub displacement: [f64; 2],
    /// Wave number (radians per length); zero if all targets move together.
    #[serde(default)]
    pub wave_number: f64,
    /// Angular frequency (radians per time).
    #[serde(default)]
    pub frequency: f64,
    /// Phase (radians).
    #[serde(default)]
    pub phase: f64,
}

/// A constant force on a node of a fibre.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct LoadSetup {
    /// Number of the node, from 0; `None` for the last one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub node: Option<usize>,
    /// The force (force).
    pub force: [f64; 2],
}

impl Default for FibreSetup {
    /// Creates a straight, free fibre of length 1 about the origin.
    fn default() -> Self {
        Self {
            name: "fibre".to_owned(),
            shape: FibreShape::Line { from: [-0.5, 0.0], to: [0.5, 0.0] },
            spacing: None,
            stretching: None,
            bending: None,
            rest_length: None,
            reference_curvature: None,
            wave: None,
            ends: [FibreHold::Free; 2],
            targets: Vec::new(),
            loads: Vec::new(),
        }
    }
}

impl FibreSetup {
    /// Returns the distance of the nodes that is asked for (length).
    fn node_spacing(&self, setup: &Setup) -> f64 {
        let of_grid = match &setup.method {
            Method::Grid(grid) => grid.marker_spacing.unwrap_or(grid.spacing),
            method => method.spacing().unwrap_or_else(|| self.usual_length(setup) / SEGMENTS),
        };
        self.spacing.unwrap_or(of_grid)
    }

    /// Returns the number of segments of a piece of that length (length).
    fn segments(&self, length: f64, setup: &Setup) -> usize {
        (length / self.node_spacing(setup)).round().clamp(3.0, MOST_SEGMENTS) as usize
    }

    /// Returns the length of its line or arc, or the length scale of the scene (length).
    fn usual_length(&self, setup: &Setup) -> f64 {
        match &self.shape {
            FibreShape::Line { from, to } => Vec2::from(*from).distance(Vec2::from(*to)),
            FibreShape::Arc { length, .. } => *length,
            _ => setup.length_scale(),
        }
    }

    /// Returns ten periods of its wave (time), or the time `viscosity L^3/bending` in which it straightens.
    pub(super) fn time(&self, setup: &Setup) -> f64 {
        match self.wave {
            Some(wave) if wave.frequency != 0.0 => 10.0 * std::f64::consts::TAU / wave.frequency.abs(),
            _ => setup.viscosity * self.usual_length(setup).powi(3) / self.bending.unwrap_or(MODULI[1]),
        }
    }

    /// Returns the fibre at the start, as if nothing held it.
    fn fibre(&self, setup: &Setup) -> Result<Fibre, SetupError> {
        let [stretching, bending] = [self.stretching.unwrap_or(MODULI[0]), self.bending.unwrap_or(MODULI[1])];
        let points = |list: &[[f64; 2]]| list.iter().copied().map(Vec2::from).collect::<Vec<_>>();
        Ok(match &self.shape {
            FibreShape::Line { from, to } => {
                let [from, to] = [Vec2::from(*from), Vec2::from(*to)];
                let count = self.segments(from.distance(to), setup);
                let at = |k: usize| from + k as f64 / count as f64 * (to - from);
                Fibre::new(&(0..=count).map(at).collect::<Vec<_>>(), stretching, bending)?
            }
            &FibreShape::Arc { from, angle, length, curvature } => {
                let count = self.segments(length, setup);
                let at = |k: usize| {
                    // The chord of an arc of length s and its direction.
                    let s = length * k as f64 / count as f64;
                    let half = 0.5 * curvature * s;
                    let chord = if half == 0.0 { s } else { s * half.sin() / half };
                    Vec2::from(from) + chord * Vec2::from_angle(angle + half)
                };
                Fibre::new(&(0..=count).map(at).collect::<Vec<_>>(), stretching, bending)?
            }
            FibreShape::Points(list) => Fibre::new(&points(list), stretching, bending)?,
            FibreShape::ClosedPoints(list) => Fibre::closed(&points(list), stretching, bending)?,
            &FibreShape::Across { height } => {
                let [length, _] = setup.region.lengths();
                let count = self.segments(length, setup);
                let at = |k: usize| Vec2::new(length * (k as f64 / count as f64 - 0.5), height);
                let nodes: Vec<Vec2> = (0..count).map(at).collect();
                Fibre::periodic(&nodes, Vec2::new(length, 0.0), stretching, bending)?
            }
            FibreShape::Files(name) => FibreFiles::read(Path::new(name))?.fibre()?,
            FibreShape::Contents { vertex, spring, beam, target } => {
                FibreFiles::parse([vertex, spring, beam, target])?.fibre()?
            }
        })
    }

    /// Returns the fibre with what holds it.
    fn held(&self, setup: &Setup) -> Result<Fibre, SetupError> {
        let mut fibre = self.fibre(setup)?.named(&self.name);
        fibre = fibre.with_ends(self.ends.map(FibreEnd::from))?;
        if let Some(length) = self.rest_length {
            fibre = fibre.with_rest_length(length)?;
        }
        if let Some(curvature) = self.reference_curvature {
            fibre = fibre.with_reference_curvature(curvature)?;
        }
        if let Some(CurvatureWaveSetup { amplitude, wave_number, frequency, phase }) = self.wave {
            fibre = fibre.with_curvature_wave(FibreWave { amplitude, wave_number, frequency, phase })?;
        }
        let count = fibre.nodes().len();
        for target in &self.targets {
            let [first, last] = target.nodes.unwrap_or([0, count - 1]);
            let wave = target.wave.map(|wave| {
                let TargetWaveSetup { displacement, wave_number, frequency, phase } = wave;
                FibreWave { amplitude: displacement.into(), wave_number, frequency, phase }
            });
            let (velocity, offset) = (target.velocity.into(), Vec2::from(target.offset));
            // A number beyond the last node is refused with the first of them.
            let nodes: Vec<Target> = (first..=last.min(first.max(count)))
                .map(|node| {
                    let place = fibre.nodes().get(node).copied().unwrap_or_default() + offset;
                    Target { velocity, wave, ..Target::fixed(node, place, target.stiffness) }
                })
                .collect();
            fibre = fibre.with_targets(nodes)?;
        }
        for load in &self.loads {
            fibre = fibre.with_load(load.node.unwrap_or(count - 1), load.force.into())?;
        }
        Ok(fibre)
    }

    /// Refuses what the method integral does not compute: other regions than the plane, fluid of two viscosities, and a
    /// fibre that pushes the fluid in the plane.
    fn check_integral(&self, checked: &Checked<'_>, setup: &Setup) -> Result<(), SetupError> {
        let top = Checked { place: "" };
        let remedy = "it supports elastic fibres, whose nodes are points and no closed curve, in the plane only. Use \
                      layers or grid, or the plane";
        top.refuse_if(setup.region != Region::Plane, "method", "integral", remedy)?;
        let mixed = setup.has_contrast() || !setup.rigid_bodies.is_empty();
        let remedy = "it supports elastic fibres in fluid of one viscosity and without rigid bodies only. Use layers \
                      in a box, or remove the fibres";
        top.refuse_if(mixed, "method", "integral", remedy)?;
        let paradox = "in the plane nothing holds a fluid that is pushed, so that no speed exists (Stokes' paradox)";
        let free = self.ends == [FibreHold::Free; 2];
        let remedy = format!("{paradox}. Leave the ends free, or use a box or a channel with grid or layers");
        checked.refuse_if(!free, "ends", format!("{:?}", self.ends), remedy)?;
        let remedy = format!("{paradox}. Remove the targets, or use a box or a channel with grid or layers");
        checked.refuse_if(!self.targets.is_empty(), "targets", "given", remedy)?;
        for axis in 0..2 {
            let sum = self.loads.iter().map(|load| load.force[axis]).sum::<f64>();
            let most = self.loads.iter().map(|load| load.force[axis].abs()).sum::<f64>();
            let remedy = format!("{paradox}. Let the loads of the fibre add up to zero, or use a box or a channel");
            checked.require(sum.abs() <= BALANCED * most, "loads", sum, &remedy)?;
        }
        Ok(())
    }

    /// Returns the shortest distance of two of its nodes at the start (length).
    pub(super) fn shortest_segment(&self, setup: &Setup) -> Result<f64, SetupError> {
        let fibre = self.fibre(setup)?;
        Ok(fibre.nodes().windows(2).map(|pair| pair[0].distance(pair[1])).fold(f64::INFINITY, f64::min))
    }

    /// Refuses values of the shape that are out of their range.
    fn check_shape(&self, checked: &Checked<'_>, setup: &Setup) -> Result<(), SetupError> {
        let spacing = self.node_spacing(setup);
        let short_enough = |key: &str, length: f64| {
            let remedy =
                format!("with nodes {spacing} apart it would have too many of them. Use a larger spacing, or less");
            checked.require(length / spacing <= MOST_SEGMENTS, key, length, &remedy)
        };
        match &self.shape {
            FibreShape::Line { from, to } => {
                checked.all_finite("shape.line.from", from)?;
                checked.all_finite("shape.line.to", to)?;
                let length = Vec2::from(*from).distance(Vec2::from(*to));
                let remedy = "this is the place where it starts, so that it has no length. Move it";
                checked.refuse_if(length == 0.0, "shape.line.to", format!("{to:?}"), remedy)?;
                short_enough("shape.line.to", length)
            }
            FibreShape::Arc { from, angle, length, curvature } => {
                checked.all_finite("shape.arc.from", from)?;
                checked.finite("shape.arc.angle", *angle)?;
                checked.positive("shape.arc.length", *length)?;
                checked.finite("shape.arc.curvature", *curvature)?;
                let turn = (length * curvature).abs();
                let remedy = "it would run over itself. Use less than a full turn over its length";
                checked.require(turn < std::f64::consts::TAU, "shape.arc.curvature", *curvature, remedy)?;
                short_enough("shape.arc.length", *length)
            }
            FibreShape::Points(list) | FibreShape::ClosedPoints(list) => {
                let closed = matches!(self.shape, FibreShape::ClosedPoints(_));
                let key = if closed { "shape.closed-points" } else { "shape.points" };
                checked.all_points_finite(key, list)?;
                let [least, most] = [3.0, MARKERS[1]];
                let text = format!("{} points", list.len());
                let remedy = format!("use from {least} to {most} points");
                checked.refuse_if(!(least..=most).contains(&(list.len() as f64)), key, text, remedy)?;
                let pairs = list.len() - usize::from(!closed);
                let same = (0..pairs).find(|&k| list[k] == list[(k + 1) % list.len()]);
                same.map_or(Ok(()), |k| {
                    let remedy = "the next point is at the same place. Leave one of them out";
                    checked.refuse(&format!("{key}[{k}]"), &format!("{:?}", list[k]), remedy)
                })
            }
            FibreShape::Across { height } => {
                checked.finite("shape.across.height", *height)?;
                short_enough("shape.across.height", setup.region.lengths()[0])
            }
            FibreShape::Files(name) => {
                let remedy = "give the common part of the names of its files, such as \"folder/beam\"";
                checked.refuse_if(name.is_empty(), "shape.files", "\"\"", remedy)?;
                self.check_of_files(checked)
            }
            FibreShape::Contents { .. } => self.check_of_files(checked),
        }
    }

    /// Refuses moduli that the files give.
    fn check_of_files(&self, checked: &Checked<'_>) -> Result<(), SetupError> {
        let from_files = [("stretching", self.stretching), ("bending", self.bending)];
        let remedy = "the files say it. Remove this key, or change the files";
        let given = from_files.into_iter().find_map(|(key, value)| Some((key, value?)));
        given.map_or(Ok(()), |(key, value)| checked.refuse(key, &value, remedy))
    }
}

impl BodySetup for FibreSetup {
    fn kind(&self) -> [&'static str; 2] {
        ["fibres", "fibre"]
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn plan<'a>(&'a self, setup: &'a Setup) -> Result<Planned<'a>, SetupError> {
        let fibre = self.held(setup)?;
        let corners = if matches!(self.shape, FibreShape::Across { .. }) { Vec::new() } else { fibre.nodes().to_vec() };
        Ok(Planned { corners, ..Planned::of(fibre) })
    }

    fn check(&self, checked: &Checked<'_>, setup: &Setup) -> Result<(), SetupError> {
        checked.positive("spacing", self.spacing)?;
        checked.not_negative("stretching", self.stretching)?;
        checked.not_negative("bending", self.bending)?;
        checked.positive("rest-length", self.rest_length)?;
        checked.finite("reference-curvature", self.reference_curvature)?;
        self.check_shape(checked, setup)?;
        if let Some(wave) = self.wave {
            let CurvatureWaveSetup { amplitude, wave_number, frequency, phase } = wave;
            for (name, value) in
                [("amplitude", amplitude), ("wave-number", wave_number), ("frequency", frequency), ("phase", phase)]
            {
                checked.finite(&format!("wave.{name}"), value)?;
            }
        }
        let ends = matches!(self.shape, FibreShape::ClosedPoints(_) | FibreShape::Across { .. });
        let remedy = "this shape has no ends that can be held. Use [\"free\", \"free\"]";
        let held = self.ends != [FibreHold::Free; 2];
        checked.refuse_if(held && ends, "ends", format!("{:?}", self.ends), remedy)?;
        for (k, target) in self.targets.iter().enumerate() {
            let key = |entry: &str| format!("targets[{k}].{entry}");
            checked.not_negative(&key("stiffness"), target.stiffness)?;
            checked.all_finite(&key("offset"), &target.offset)?;
            checked.all_finite(&key("velocity"), &target.velocity)?;
            if let Some([first, last]) = target.nodes {
                let remedy = "give the first node before the last one";
                checked.refuse_if(first > last, &key("nodes"), format!("[{first}, {last}]"), remedy)?;
            }
            if let Some(TargetWaveSetup { displacement, wave_number, frequency, phase }) = target.wave {
                for (name, value) in [("wave-number", wave_number), ("frequency", frequency), ("phase", phase)] {
                    checked.finite(&key(&format!("wave.{name}")), value)?;
                }
                checked.all_finite(&key("wave.displacement"), &displacement)?;
            }
        }
        for (k, load) in self.loads.iter().enumerate() {
            checked.all_finite(&format!("loads[{k}].force"), &load.force)?;
        }
        let wave = self.wave.is_some();
        if setup.method.kind() == MethodKind::Integral {
            self.check_integral(checked, setup)?;
        }
        let remedy = "a wave of curvature has no mirror image. Remove this key, or mirror-symmetric";
        checked.refuse_if(wave && setup.mirror_symmetric, "wave", "given", remedy)?;
        Ok(())
    }
}
