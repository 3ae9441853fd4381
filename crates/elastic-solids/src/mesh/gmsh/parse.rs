//! Parser of the text of a .msh file.

use std::collections::{BTreeMap, HashMap};
use std::str::{FromStr, SplitWhitespace};

use motile_base::Vec2;

use super::PhysicalGroup;
use crate::SolidError;

/// Distance of nodes from their plane up to which they lie in it, over the extent of the mesh (no dimension):
/// round-off.
const FLAT: f64 = 1e-9;

/// Contents of a file, as far as they belong to the mesh.
pub(super) struct Contents {
    pub(super) points: Vec<Vec2>,
    pub(super) triangles: Vec<[usize; 3]>,
    pub(super) groups: Vec<PhysicalGroup>,
}

/// The lines of a file with their numbers.
struct Lines<'a> {
    lines: std::str::Lines<'a>,
    number: usize,
}

/// The words of one line.
struct Words<'a> {
    words: SplitWhitespace<'a>,
    line: usize,
}

impl<'a> Lines<'a> {
    /// Returns the next line that is not empty.
    fn next(&mut self) -> Option<&'a str> {
        loop {
            self.number += 1;
            let line = self.lines.next()?.trim();
            if !line.is_empty() {
                return Some(line);
            }
        }
    }

    /// Returns the words of the next line of a section, which must be there.
    fn words(&mut self, section: &'static str) -> Result<Words<'a>, SolidError> {
        match self.next() {
            Some(line) if !line.starts_with('$') => Ok(Words { words: line.split_whitespace(), line: self.number }),
            _ => Err(self.error(format!("section {section} ends too early"))),
        }
    }

    /// The line that ends a section.
    fn end(&mut self, section: &'static str) -> Result<(), SolidError> {
        let found = self.next().unwrap_or("the end of the file");
        if found.strip_prefix("$End") == Some(section) {
            return Ok(());
        }
        Err(self.error(format!("expected $End{section}, found {}", shortened(found))))
    }

    fn error(&self, what: String) -> SolidError {
        SolidError::gmsh(self.number, what)
    }
}

impl Words<'_> {
    fn next<T: FromStr>(&mut self, what: &'static str) -> Result<T, SolidError> {
        let line = self.line;
        let word = self.words.next().ok_or_else(|| SolidError::gmsh(line, format!("{what} is missing")))?;
        word.parse().map_err(|_| SolidError::gmsh(line, format!("{what} cannot be {}", shortened(word))))
    }

    fn error<T>(&self, what: String) -> Result<T, SolidError> {
        Err(SolidError::gmsh(self.line, what))
    }
}

/// Returns the beginning of a text that is quoted in a message.
fn shortened(text: &str) -> String {
    text.chars().take(40).collect()
}

/// Sections that have been read.
#[derive(Default)]
struct File {
    names: BTreeMap<i32, String>,
    /// Groups of each surface, by its number.
    surfaces: HashMap<i64, Vec<i32>>,
    positions: Vec<Vec2>,
    /// Indices into `positions` by the numbers of the nodes in the file.
    nodes: HashMap<u64, usize>,
    /// Coordinate z of the plane.
    height: Option<f64>,
    /// Number, surface, nodes and line of each triangle.
    triangles: Vec<(u64, i64, [u64; 3], usize)>,
}

pub(super) fn parse(text: &str) -> Result<Contents, SolidError> {
    // Some editors put a byte-order mark first.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut lines = Lines { lines: text.lines(), number: 0 };
    let mut file = File::default();
    let mut format = false;
    while let Some(line) = lines.next() {
        let Some(section) = line.strip_prefix('$') else {
            return Err(lines.error(format!("expected a section, found {}", shortened(line))));
        };
        match section {
            "MeshFormat" => {
                check_format(&mut lines)?;
                format = true;
            }
            _ if !format => return Err(lines.error("the file does not start with $MeshFormat".to_owned())),
            "PhysicalNames" => file.read_names(&mut lines)?,
            "Entities" => file.read_entities(&mut lines)?,
            "Nodes" => file.read_nodes(&mut lines)?,
            "Elements" => file.read_elements(&mut lines)?,
            other => skip(&mut lines, other)?,
        }
    }
    if !format {
        return Err(lines.error("the file has no $MeshFormat".to_owned()));
    }
    file.finish()
}

fn check_format(lines: &mut Lines<'_>) -> Result<(), SolidError> {
    let mut words = lines.words("MeshFormat")?;
    let version: String = words.next("the version")?;
    if version != "4.1" {
        return words.error(format!("its version is {}", shortened(&version)));
    }
    let binary: u8 = words.next("the file type")?;
    if binary != 0 {
        return words.error("the file is binary".to_owned());
    }
    lines.end("MeshFormat")
}

fn skip(lines: &mut Lines<'_>, section: &str) -> Result<(), SolidError> {
    while let Some(line) = lines.next() {
        if line.strip_prefix("$End") == Some(section) {
            return Ok(());
        }
    }
    Err(lines.error(format!("section {} does not end", shortened(section))))
}

impl File {
    fn read_names(&mut self, lines: &mut Lines<'_>) -> Result<(), SolidError> {
        let count: usize = lines.words("PhysicalNames")?.next("the number of names")?;
        for _ in 0..count {
            let Some(line) = lines.next().filter(|line| !line.starts_with('$')) else {
                return Err(lines.error("section PhysicalNames ends too early".to_owned()));
            };
            let mut words = Words { words: line.split_whitespace(), line: lines.number };
            let dimension: u8 = words.next("the dimension of a group")?;
            let tag: i32 = words.next("the number of a group")?;
            let name = line.split_once('"').and_then(|(_, rest)| rest.rsplit_once('"'));
            let Some((name, _)) = name else {
                return words.error("the name of a group is not in quotation marks".to_owned());
            };
            if dimension == 2 {
                self.names.insert(tag, name.to_owned());
            }
        }
        lines.end("PhysicalNames")
    }

    fn read_entities(&mut self, lines: &mut Lines<'_>) -> Result<(), SolidError> {
        let mut counts = lines.words("Entities")?;
        let [points, curves, surfaces, volumes]: [usize; 4] = [
            counts.next("the number of points")?,
            counts.next("the number of curves")?,
            counts.next("the number of surfaces")?,
            counts.next("the number of volumes")?,
        ];
        for count in [points, curves] {
            for _ in 0..count {
                lines.words("Entities")?;
            }
        }
        for _ in 0..surfaces {
            let mut words = lines.words("Entities")?;
            let tag: i64 = words.next("the number of a surface")?;
            for _ in 0..6 {
                words.next::<f64>("a bound of a surface")?;
            }
            let count: usize = words.next("the number of groups of a surface")?;
            let mut groups = Vec::new();
            for _ in 0..count {
                // Negative for a surface that is turned round, which makes no difference here.
                groups.push(words.next::<i32>("a group of a surface")?.saturating_abs());
            }
            self.surfaces.insert(tag, groups);
        }
        for _ in 0..volumes {
            lines.words("Entities")?;
        }
        lines.end("Entities")
    }

    fn read_nodes(&mut self, lines: &mut Lines<'_>) -> Result<(), SolidError> {
        let blocks: usize = lines.words("Nodes")?.next("the number of blocks")?;
        // The node furthest from the height of the first: its distance (length), number, z, and line.
        let mut furthest = (0.0, 0, 0.0, 0);
        for _ in 0..blocks {
            let mut words = lines.words("Nodes")?;
            words.next::<u8>("a dimension")?;
            words.next::<i64>("the number of an entity")?;
            words.next::<u8>("whether there are parameters")?;
            let count: usize = words.next("the number of nodes")?;
            let first = self.positions.len();
            let mut tags = Vec::new();
            for _ in 0..count {
                tags.push(lines.words("Nodes")?.next("the number of a node")?);
            }
            for (place, tag) in (first..).zip(tags) {
                let mut words = lines.words("Nodes")?;
                let x: f64 = words.next("x")?;
                let y: f64 = words.next("y")?;
                let z: f64 = words.next("z")?;
                if !(x.is_finite() && y.is_finite() && z.is_finite()) {
                    return words.error(format!("node {tag} is not finite"));
                }
                let height = *self.height.get_or_insert(z);
                if (z - height).abs() > furthest.0 {
                    furthest = ((z - height).abs(), tag, z, words.line);
                }
                self.positions.push(Vec2::new(x, y));
                if self.nodes.insert(tag, place).is_some() {
                    return words.error(format!("there are two nodes {tag}"));
                }
            }
        }
        let far = Vec2::splat(f64::INFINITY);
        let [low, high] = self.positions.iter().fold([far, -far], |[low, high], p| [low.min(*p), high.max(*p)]);
        let (apart, tag, z, line) = furthest;
        let height = self.height.unwrap_or_default();
        if apart > FLAT * ((high - low).length() + height.abs()) {
            return Err(SolidError::gmsh(line, format!("node {tag} has z = {z} where others have {height}")));
        }
        lines.end("Nodes")
    }

    fn read_elements(&mut self, lines: &mut Lines<'_>) -> Result<(), SolidError> {
        let blocks: usize = lines.words("Elements")?.next("the number of blocks")?;
        for _ in 0..blocks {
            let mut words = lines.words("Elements")?;
            let dimension: u8 = words.next("a dimension")?;
            let surface: i64 = words.next("the number of an entity")?;
            let kind: u32 = words.next("the type of elements")?;
            let count: usize = words.next("the number of elements")?;
            if dimension >= 2 && kind != TRIANGLE {
                return words
                    .error(format!("elements of type {kind} are not triangles of three points, type {TRIANGLE}"));
            }
            for _ in 0..count {
                let mut words = lines.words("Elements")?;
                if dimension < 2 {
                    continue;
                }
                let number = words.next("the number of an element")?;
                let mut node = || words.next("a node of a triangle");
                self.triangles.push((number, surface, [node()?, node()?, node()?], lines.number));
            }
        }
        lines.end("Elements")
    }

    fn finish(mut self) -> Result<Contents, SolidError> {
        // Triangles in the order of their numbers, wherever their blocks stand in the file.
        self.triangles.sort_by_key(|&(number, ..)| number);
        let mut used = vec![false; self.positions.len()];
        let mut triangles = Vec::with_capacity(self.triangles.len());
        let mut groups: BTreeMap<i32, PhysicalGroup> = BTreeMap::new();
        for &(number, surface, tags, line) in &self.triangles {
            let mut triangle = [0; 3];
            for (point, tag) in triangle.iter_mut().zip(tags) {
                *point = *self.nodes.get(&tag).ok_or_else(|| {
                    SolidError::gmsh(line, format!("triangle {number} names node {tag}, which does not exist"))
                })?;
                used[*point] = true;
            }
            for &tag in self.surfaces.get(&surface).map_or(&[][..], Vec::as_slice) {
                let name = || self.names.get(&tag).cloned();
                let group =
                    groups.entry(tag).or_insert_with(|| PhysicalGroup { tag, name: name(), triangles: Vec::new() });
                group.triangles.push(triangles.len());
            }
            triangles.push(triangle);
        }
        let mut points = Vec::new();
        let numbers: Vec<usize> = (0..used.len())
            .map(|place| {
                if used[place] {
                    points.push(self.positions[place]);
                }
                points.len().saturating_sub(1)
            })
            .collect();
        for point in triangles.iter_mut().flatten() {
            *point = numbers[*point];
        }
        Ok(Contents { points, triangles, groups: groups.into_values().collect() })
    }
}

/// Gmsh's number of the triangle with three points.
const TRIANGLE: u32 = 2;
