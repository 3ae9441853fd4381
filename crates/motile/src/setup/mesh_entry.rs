//! Meshes of solids from files and arrays.

use std::collections::{HashMap, HashSet};
use std::path::Path;

use elastic_solids::mesh::{BoundaryGroup, MeshFile, PhysicalGroup, TriangleMesh};
use elastic_solids::{Interior, Outline};
use motile_base::{Vec2, internal::Refuse as _};
use outline_files::bytes_of;
use serde::{Deserialize, Serialize};

use super::checked::Checked;
use crate::SetupError;

/// Most points and triangles of a mesh.
const MOST: usize = 1_000_000;

/// The mesh of a solid from a file or from arrays, instead of an outline that motile meshes.
///
/// Use a file of Gmsh (`.msh`, versions 2.2 and 4.1, ASCII or binary) or an unstructured grid of VTK (`.vtk`,
/// `.vtu`); see [`MeshFile`]. Triangles of second order become four each. Groups of triangles may have stiffer or
/// softer material than the others, and groups of lines may be pinned.
///
/// ```
/// use motile::prelude::*;
/// use motile::setup::{GroupFactor, Hold, Material, MeshGroup, MeshSetup, SolidOutline, SolidSetup};
///
/// // A square of two triangles, the upper one four times as stiff, pinned along its lower side.
/// let mesh = MeshSetup {
///     points: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
///     triangles: vec![[0, 1, 2], [0, 2, 3]],
///     groups: vec![MeshGroup { name: "upper".into(), members: vec![1] }],
///     boundaries: vec![MeshGroup { name: "base".into(), members: vec![0, 1] }],
///     factors: vec![GroupFactor { group: "upper".into(), factor: 4.0 }],
///     pinned: vec!["base".into()],
///     ..MeshSetup::default()
/// };
/// let solid = SolidSetup::new(SolidOutline::Mesh(mesh), Material::NeoHookean { shear: 10.0, bulk: 20.0 });
/// assert_eq!(solid.hold, Hold::Pinned);
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
#[doc(alias("gmsh", "msh", "vtk", "vtu", "finite elements"))]
pub struct MeshSetup {
    /// Path of the file, in a scene file relative to it. When the scene is read, the contents of the file take its
    /// place ([`Setup::with_files`](super::Setup::with_files)).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// The points instead of a file, in any unit.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub points: Vec<[f64; 2]>,
    /// The triangles, each by the numbers of its three points, from 0.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub triangles: Vec<[usize; 3]>,
    /// Groups of triangles by their numbers, from 0.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub groups: Vec<MeshGroup>,
    /// Groups of points by their numbers, such as parts of the boundary.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub boundaries: Vec<MeshGroup>,
    /// Length of the unit of the points (length).
    pub scale: f64,
    /// Place of the origin of the file (length).
    pub place: [f64; 2],
    /// Factors on the moduli of groups of triangles; 1 for all others. A triangle of several groups has the product of
    /// their factors.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub factors: Vec<GroupFactor>,
    /// Names of groups of lines whose points are pinned.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub pinned: Vec<String>,
}

/// A named group of triangles or points of a mesh.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct MeshGroup {
    /// Its name; the number of the group where a file gives none.
    pub name: String,
    /// Numbers of its triangles or points, from 0.
    pub members: Vec<usize>,
}

/// A factor on the moduli of a group of triangles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct GroupFactor {
    /// Name of the group.
    pub group: String,
    /// Factor on the moduli (no dimension).
    pub factor: f64,
}

impl Default for MeshSetup {
    /// Creates a mesh of no triangles.
    fn default() -> Self {
        Self {
            file: None,
            points: Vec::new(),
            triangles: Vec::new(),
            groups: Vec::new(),
            boundaries: Vec::new(),
            scale: 1.0,
            place: [0.0; 2],
            factors: Vec::new(),
            pinned: Vec::new(),
        }
    }
}

impl MeshSetup {
    /// Creates the mesh of a file, whose unit is the unit of the scene.
    #[must_use]
    pub fn of_file(file: impl Into<String>) -> Self {
        Self { file: Some(file.into()), ..Self::default() }
    }

    /// Replaces the file, whose path is relative to that directory, by its contents.
    pub(super) fn embed(&mut self, directory: &Path) -> Result<(), SetupError> {
        let Some(file) = self.file.take() else { return Ok(()) };
        let MeshFile { mesh, groups, boundaries } = MeshFile::from_bytes(&bytes_of(&directory.join(file))?)?;
        let named = |name: Option<String>, tag: i32| name.unwrap_or_else(|| tag.to_string());
        let of_triangles =
            |PhysicalGroup { tag, name, triangles }| MeshGroup { name: named(name, tag), members: triangles };
        let of_points = |BoundaryGroup { tag, name, points }| MeshGroup { name: named(name, tag), members: points };
        self.points = mesh.points().iter().map(|point| [point.x, point.y]).collect();
        self.triangles = mesh.triangles().to_vec();
        self.groups = groups.into_iter().map(of_triangles).collect();
        self.boundaries = boundaries.into_iter().map(of_points).collect();
        Ok(())
    }

    /// Returns the description with the contents of the file.
    fn read(&self) -> Result<Self, SetupError> {
        let mut read = self.clone();
        read.embed(Path::new(""))?;
        Ok(read)
    }

    /// Returns the place of a point of the file.
    fn at(&self, point: [f64; 2]) -> Vec2 {
        Vec2::from(point) * self.scale + Vec2::from(self.place)
    }

    /// Returns the mesh in its place.
    pub(super) fn mesh(&self) -> Result<TriangleMesh, SetupError> {
        let read = self.read()?;
        let points = read.points.iter().map(|point| read.at(*point)).collect();
        Ok(TriangleMesh::new(points, read.triangles)?)
    }

    /// Returns the outline of the mesh in its place.
    pub(super) fn enclosed(&self) -> Result<Interior, SetupError> {
        let mesh = self.mesh()?;
        let polygon = |surface| mesh.boundary_polygon(surface, mesh.points()).unwrap_or_default();
        let outlines = mesh.boundary_loops().iter().map(|surface| Outline::polygon(&polygon(surface)));
        Ok(Interior::new(outlines.collect::<Result<Vec<_>, _>>()?)?)
    }

    /// Returns the groups of the mesh by place.
    pub(super) fn parts(&self) -> Result<MeshParts, SetupError> {
        let read = self.read()?;
        let unknown = |what: &str, name: &str, groups: &[MeshGroup]| {
            let names: Vec<String> = groups.iter().take(8).map(|group| format!("{:?}", group.name)).collect();
            let listed = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
            let value = format!("the groups of {what} are: {listed}");
            SetupError::refused(format!("the mesh has no group {name:?}"), value, "Use one of these names")
        };
        let mut factors = vec![1.0; read.triangles.len()];
        for GroupFactor { group, factor } in &read.factors {
            let chosen = members(group, &read.groups, factors.len())?;
            let chosen = chosen.ok_or_else(|| unknown("triangles", group, &read.groups))?;
            factors.iter_mut().zip(chosen).filter(|(_, chosen)| *chosen).for_each(|(one, _)| *one *= factor);
        }
        let mut pinned = HashSet::new();
        for name in &read.pinned {
            let chosen = members(name, &read.boundaries, read.points.len())?;
            let chosen = chosen.ok_or_else(|| unknown("lines", name, &read.boundaries))?;
            let places = read.points.iter().zip(chosen).filter(|(_, chosen)| *chosen);
            pinned.extend(places.map(|(place, _)| bits(read.at(*place))));
        }
        let graded = !read.factors.is_empty();
        let corner = |point: usize| read.points.get(point).map(|point| read.at(*point)).unwrap_or_default();
        let triangles =
            if graded { read.triangles.iter().map(|corners| corners.map(corner)).collect() } else { Vec::new() };
        Ok(MeshParts::new(triangles, factors, pinned))
    }

    /// Refuses numbers out of their range, and keys that exclude one another.
    pub(super) fn check(&self, checked: &Checked<'_>) -> Result<(), SetupError> {
        let key = |name: &str| format!("outline.mesh.{name}");
        let arrays = !self.points.is_empty() || !self.triangles.is_empty();
        let remedy = "a mesh has either a file, or points and triangles. Give one of them";
        checked.refuse_if(self.file.is_some() && arrays, &key("file"), "given with points", remedy)?;
        checked.refuse_if(self.file.is_none() && !arrays, &key("file"), "not given", remedy)?;
        let many = self.points.len().max(self.triangles.len());
        let remedy = format!("a solid may have at most {MOST} of either. Use a coarser mesh");
        checked.refuse_if(many > MOST, &key("points"), format!("{many} points or triangles"), remedy)?;
        checked.positive(&key("scale"), self.scale)?;
        checked.all_finite(&key("place"), &self.place)?;
        checked.all_points_finite(&key("points"), &self.points)?;
        let factors = self.factors.iter().enumerate();
        factors.into_iter().try_for_each(|(k, one)| checked.positive(&key(&format!("factors[{k}].factor")), one.factor))
    }
}

fn no_member(group: &str, member: usize) -> SetupError {
    let what = format!("the group {group:?} of the mesh has a member {member} that does not exist");
    SetupError::refused(what, "", "Number triangles and points from 0")
}

/// Exact coordinates.
fn bits(place: Vec2) -> [u64; 2] {
    [place.x.to_bits(), place.y.to_bits()]
}

/// Returns which of so many are members of the groups of a name; `None` if there is no such group.
fn members(name: &str, groups: &[MeshGroup], count: usize) -> Result<Option<Vec<bool>>, SetupError> {
    let mut chosen = vec![false; count];
    let mut found = false;
    for group in groups.iter().filter(|group| group.name == name) {
        found = true;
        for &member in &group.members {
            *chosen.get_mut(member).ok_or_else(|| no_member(name, member))? = true;
        }
    }
    Ok(found.then_some(chosen))
}

/// Groups of a mesh by place: factors on moduli, and points that are pinned.
pub(super) struct MeshParts {
    triangles: Vec<[Vec2; 3]>,
    factors: Vec<f64>,
    pinned: HashSet<[u64; 2]>,
    /// Triangles by the cells of a grid that they reach into.
    cells: HashMap<[i64; 2], Vec<usize>>,
    size: f64,
}

impl MeshParts {
    fn new(triangles: Vec<[Vec2; 3]>, factors: Vec<f64>, pinned: HashSet<[u64; 2]>) -> Self {
        let boxes = triangles.iter().map(|[a, b, c]| [a.min(*b).min(*c), a.max(*b).max(*c)]);
        let boxes: Vec<[Vec2; 2]> = boxes.collect();
        let size = boxes.iter().map(|[low, high]| (*high - *low).max_element()).fold(0.0, f64::max);
        let mut parts = Self { triangles, factors, pinned, cells: HashMap::new(), size };
        for (number, [low, high]) in boxes.into_iter().enumerate() {
            let [[left, bottom], [right, top]] = [parts.cell(low), parts.cell(high)];
            for x in left..=right {
                for y in bottom..=top {
                    parts.cells.entry([x, y]).or_default().push(number);
                }
            }
        }
        parts
    }

    fn cell(&self, place: Vec2) -> [i64; 2] {
        // No triangle reaches over more than two cells in each direction.
        [place.x, place.y].map(|x| if self.size > 0.0 { (x / self.size).floor() as i64 } else { 0 })
    }

    /// Returns the factor on the moduli in a place: of the triangle around it, or next to it.
    pub(super) fn factor(&self, place: Vec2) -> f64 {
        let outside = |&number: &usize| {
            let [a, b, c] = self.triangles[number];
            // Least of the coordinates in the triangle, which add up to one.
            let whole = (b - a).perp_dot(c - a);
            let part = |a: Vec2, b: Vec2| (a - place).perp_dot(b - place) / whole;
            -part(a, b).min(part(b, c)).min(part(c, a))
        };
        let near = self.cells.get(&self.cell(place)).into_iter().flatten();
        near.min_by(|a, b| outside(a).total_cmp(&outside(b))).map_or(1.0, |number| self.factors[*number])
    }

    /// Returns true for a point of the mesh that is pinned.
    pub(super) fn is_pinned(&self, place: Vec2) -> bool {
        self.pinned.contains(&bits(place))
    }
}

#[cfg(test)]
mod tests;
