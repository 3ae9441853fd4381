//! Meshes in the file format of Gmsh.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use motile_base::{Vec2, positive};

use crate::SolidError;
use crate::mesh::TriangleMesh;

pub(super) mod join;
mod parse;

use join::{first_of_same, join_ends};
use parse::{Contents, parse};

/// Group of triangles that belong together, such as all triangles of one material: a physical group of Gmsh.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PhysicalGroup {
    /// Number of the group.
    pub tag: i32,
    /// Name of the group; `None` for a group without one.
    pub name: Option<String>,
    /// Indices of its triangles in the mesh, in increasing order.
    pub triangles: Vec<usize>,
}

/// A mesh with the groups of its triangles, as text in the format .msh 4.1 (ASCII): the plane part of
/// <https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format>.
///
/// ```
/// use elastic_solids::SolidError;
/// use elastic_solids::mesh::{GmshMesh, PhysicalGroup, equilateral_block};
/// use elastic_solids::Vec2;
///
/// let mesh = equilateral_block(Vec2::ZERO, 4, 3, 0.5)?;
/// let stiff = PhysicalGroup { tag: 1, name: Some("stiff".into()), triangles: (0..7).collect() };
/// let text = GmshMesh { mesh, groups: vec![stiff] }.to_text()?;
///
/// // Write it with std::fs::write, read it with std::fs::read_to_string.
/// let back = GmshMesh::from_text(&text)?;
/// println!("{} triangles, {} stiff", back.mesh.triangles().len(), back.groups[0].triangles.len()); // 21, 7
/// assert_eq!((back.mesh.triangles().len(), back.groups[0].triangles.len()), (21, 7));
/// # Ok::<(), SolidError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct GmshMesh {
    /// The mesh.
    pub mesh: TriangleMesh,
    /// Groups of its triangles; a triangle may belong to none or several.
    pub groups: Vec<PhysicalGroup>,
}

impl GmshMesh {
    /// Creates a mesh from the text of a file with triangles of three points. Elements that are points or lines are
    /// ignored, as are sections that do not belong to the mesh; z must be the same everywhere. Points keep their order;
    /// those that no triangle uses are left out.
    ///
    /// # Errors
    /// Returns [`SolidError::Refused`] with the line for text that is not in the format, other versions, binary files,
    /// elements that are not triangles of three points; points that coincide, to 1e-3 of the shortest edge
    /// ([`SolidError::Refused`]). The errors of [`TriangleMesh::new`].
    pub fn from_text(text: &str) -> Result<Self, SolidError> {
        let Contents { points, triangles, groups } = parse(text)?;
        let first = first_of_same(&points, &triangles, None);
        if let Some((second, &first)) = first.iter().enumerate().find(|(number, first)| *number != **first) {
            return Err(SolidError::coincident_points(first, second, points[second]));
        }
        Ok(Self { mesh: TriangleMesh::new(points, triangles)?, groups })
    }

    /// Creates a mesh that repeats itself in x with `period` (length), from the text of a file: points that coincide
    /// when moved by a period, to 1e-3 of the shortest edge, become one.
    ///
    /// # Errors
    /// Returns the errors of [`GmshMesh::from_text`] and of [`TriangleMesh::periodic`].
    pub fn from_periodic_text(text: &str, period: f64) -> Result<Self, SolidError> {
        positive("the period", period)?;
        let Contents { points, triangles, groups } = parse(text)?;
        let (points, triangles) = join_ends(&points, &triangles, period);
        Ok(Self { mesh: TriangleMesh::periodic(points, triangles, period)?, groups })
    }

    /// Returns the text of the file. Points of a periodic mesh are written on both sides of the periodic edge.
    ///
    /// # Errors
    /// Returns an error for a group of a triangle that does not exist, two groups of one number, a number that is not
    /// positive, a name with a quotation mark or line break.
    pub fn to_text(&self) -> Result<String, SolidError> {
        self.check_groups()?;
        let (points, triangles) = self.unrolled();
        let parts = self.parts();
        let mut text = String::from("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
        // Writing to a string cannot fail.
        let _ = self.write_groups(&mut text);
        let _ = write_entities(&mut text, &points, &parts, &self.groups);
        let _ = write_points(&mut text, &points);
        let _ = write_triangles(&mut text, &triangles, &parts);
        Ok(text)
    }

    fn check_groups(&self) -> Result<(), SolidError> {
        for (number, group) in self.groups.iter().enumerate() {
            let tag = group.tag;
            let bad = |what: &'static str| Err(SolidError::bad_group(tag, what));
            if tag <= 0 {
                return bad("its number is not positive");
            }
            if self.groups[..number].iter().any(|other| other.tag == tag) {
                return bad("another group has the same number");
            }
            if group.name.as_ref().is_some_and(|name| name.contains(['"', '\n', '\r'])) {
                return bad("its name has a quotation mark or line break");
            }
            if group.triangles.iter().any(|&triangle| triangle >= self.mesh.triangles().len()) {
                return bad("it names a triangle that does not exist");
            }
        }
        Ok(())
    }

    /// Returns the points and triangles of the mesh without its periodicity: with images of the points of triangles
    /// across the periodic edge.
    fn unrolled(&self) -> (Vec<Vec2>, Vec<[usize; 3]>) {
        let mut points = self.mesh.points().to_vec();
        let mut images = BTreeMap::new();
        let triangles = (0..self.mesh.triangles().len())
            .map(|number| {
                let mut triangle = self.mesh.triangles()[number];
                let corners = self.mesh.raw_corners(number, self.mesh.points());
                for (point, corner) in triangle.iter_mut().zip(corners) {
                    let home = self.mesh.points()[*point];
                    if corner.x != home.x {
                        *point = *images.entry((*point, corner.x > home.x)).or_insert_with(|| {
                            points.push(corner);
                            points.len() - 1
                        });
                    }
                }
                triangle
            })
            .collect();
        (points, triangles)
    }

    /// Returns the partition of the triangles into those that belong to the same groups: indices of the groups, and of
    /// the triangles.
    fn parts(&self) -> Vec<(Vec<usize>, Vec<usize>)> {
        let mut groups_of = vec![Vec::new(); self.mesh.triangles().len()];
        for (number, group) in self.groups.iter().enumerate() {
            for &triangle in &group.triangles {
                if groups_of[triangle].last() != Some(&number) {
                    groups_of[triangle].push(number);
                }
            }
        }
        let mut parts: BTreeMap<Vec<usize>, Vec<usize>> = BTreeMap::new();
        for (triangle, groups) in groups_of.into_iter().enumerate() {
            parts.entry(groups).or_default().push(triangle);
        }
        parts.into_iter().collect()
    }

    fn write_groups(&self, text: &mut String) -> std::fmt::Result {
        let named = || self.groups.iter().filter_map(|group| Some((group.tag, group.name.as_ref()?)));
        if named().next().is_none() {
            return Ok(());
        }
        writeln!(text, "$PhysicalNames\n{}", named().count())?;
        for (tag, name) in named() {
            writeln!(text, "2 {tag} \"{name}\"")?;
        }
        writeln!(text, "$EndPhysicalNames")
    }
}

fn write_entities(
    text: &mut String,
    points: &[Vec2],
    parts: &[(Vec<usize>, Vec<usize>)],
    groups: &[PhysicalGroup],
) -> std::fmt::Result {
    let (low, high) = points.iter().fold((points[0], points[0]), |(a, b), p| (a.min(*p), b.max(*p)));
    writeln!(text, "$Entities\n0 0 {} 0", parts.len())?;
    for (number, (members, _)) in parts.iter().enumerate() {
        write!(text, "{} {} {} 0 {} {} 0 {}", number + 1, low.x, low.y, high.x, high.y, members.len())?;
        for &group in members {
            write!(text, " {}", groups[group].tag)?;
        }
        writeln!(text, " 0")?;
    }
    writeln!(text, "$EndEntities")
}

fn write_points(text: &mut String, points: &[Vec2]) -> std::fmt::Result {
    let count = points.len();
    writeln!(text, "$Nodes\n1 {count} 1 {count}\n2 1 0 {count}")?;
    for number in 1..=count {
        writeln!(text, "{number}")?;
    }
    for point in points {
        writeln!(text, "{} {} 0", point.x, point.y)?;
    }
    writeln!(text, "$EndNodes")
}

fn write_triangles(
    text: &mut String,
    triangles: &[[usize; 3]],
    parts: &[(Vec<usize>, Vec<usize>)],
) -> std::fmt::Result {
    let count = triangles.len();
    writeln!(text, "$Elements\n{} {count} 1 {count}", parts.len())?;
    for (number, (_, members)) in parts.iter().enumerate() {
        writeln!(text, "2 {} 2 {}", number + 1, members.len())?;
        for &triangle in members {
            let [a, b, c] = triangles[triangle].map(|point| point + 1);
            // The numbers bring the triangles back into their order.
            writeln!(text, "{} {a} {b} {c}", triangle + 1)?;
        }
    }
    writeln!(text, "$EndElements")
}

#[cfg(test)]
mod tests;
