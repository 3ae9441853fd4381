//! Meshes from files of mesh generators.

mod bytes;
mod encoded;
mod gmsh;
mod raw;
mod vtk;
mod vtu;

use std::collections::BTreeMap;

use motile_base::{Vec2, positive};

use super::gmsh::join::first_of_same;
use crate::SolidError;
use crate::mesh::{PhysicalGroup, TriangleMesh};

use raw::RawMesh;

/// Distance of points from their plane up to which they lie in it, over the extent of the mesh (no dimension).
const FLAT: f64 = 1e-6;

/// Group of points on lines that belong together, such as one side of the boundary: a physical group of curves in Gmsh.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BoundaryGroup {
    /// Number of the group.
    pub tag: i32,
    /// Name of the group; `None` for a group without one.
    pub name: Option<String>,
    /// Indices of its points in the mesh, in increasing order.
    pub points: Vec<usize>,
}

/// A mesh of triangles from a file, with the groups of its triangles and lines.
///
/// The formats are Gmsh (`.msh`) 2.2 and 4.1, ASCII and binary, and unstructured grids of VTK. These are legacy files
/// (`.vtk`, ASCII and binary) or XML (`.vtu`: ASCII, base64 and appended, plain and compressed by zlib). The format is
/// found from the contents.
///
/// Triangles of second order become four triangles each, by way of the points in the middle of their sides, so that a
/// curved boundary stays as it is. Points that no triangle uses are left out. Groups are physical groups of Gmsh; in
/// VTK they are the values of integer data of cells that is called `gmsh:physical`, `group`, `material`, `region` or
/// `medit:ref`.
///
/// ```
/// use elastic_solids::{SolidError, mesh::MeshFile};
///
/// let text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n\
///             $PhysicalNames\n2\n1 1 \"base\"\n2 2 \"soft\"\n$EndPhysicalNames\n\
///             $Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n\
///             $Elements\n3\n1 1 2 1 1 1 2\n2 2 2 2 1 1 2 3\n3 2 2 2 1 1 3 4\n$EndElements\n";
/// let file = MeshFile::from_bytes(text.as_bytes())?;
/// let base = &file.boundaries[0].points;
/// println!("area {}, base of {} points", file.mesh.area(), base.len()); // area 1, base of 2 points
/// assert_eq!((file.mesh.area(), base.len()), (1.0, 2));
/// # Ok::<(), SolidError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct MeshFile {
    /// The mesh (unit of the file).
    pub mesh: TriangleMesh,
    /// Groups of its triangles; a triangle may belong to none or several.
    pub groups: Vec<PhysicalGroup>,
    /// Groups of its points on lines.
    pub boundaries: Vec<BoundaryGroup>,
}

impl MeshFile {
    /// Reads the contents of a file. All its points lie in one plane z = constant.
    ///
    /// # Errors
    /// Returns [`SolidError::Refused`], with the place in the file and the remedy, for contents in no known format and
    /// for other versions. The same error is for cells other than triangles, and for points that coincide or do not lie
    /// in one plane. Returns the errors of [`TriangleMesh::new`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, SolidError> {
        let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
        let raw = if text.starts_with(b"$") {
            gmsh::read(text)?
        } else if text.starts_with(b"# vtk") {
            vtk::read(text)?
        } else if text.starts_with(b"<") {
            vtu::read(text)?
        } else {
            let remedy = "Use Gmsh (.msh) 2.2 or 4.1, or an unstructured grid of VTK (.vtk, .vtu)";
            return Err(SolidError::mesh_file("the mesh file", "its format is not known", remedy));
        };
        Self::of(&raw)
    }

    /// Returns the mesh with all lengths multiplied by a positive factor: the length of the unit of the file.
    ///
    /// # Errors
    /// Returns an error for a factor that is not positive, or with which lengths overflow.
    pub fn scaled(self, factor: f64) -> Result<Self, SolidError> {
        positive("the length of the unit of the mesh", factor)?;
        let points = self.mesh.points().iter().map(|point| *point * factor).collect();
        Ok(Self { mesh: TriangleMesh::new(points, self.mesh.triangles().to_vec())?, ..self })
    }

    /// Makes the mesh of the cells of a file.
    fn of(raw: &RawMesh) -> Result<Self, SolidError> {
        let refuse = |problem: String, remedy| Err(SolidError::mesh_file("the mesh file", problem, remedy));
        let whole = "Save the mesh again, with all its points";
        if raw.triangles.is_empty() {
            return refuse(
                "it has no triangles".to_owned(),
                "Mesh the surface in two dimensions, and save all elements",
            );
        }
        // Points that triangles use, in the order of the file.
        let mut used = vec![false; raw.points.len()];
        for &point in raw.triangles.keys().flatten() {
            match used.get_mut(point) {
                Some(used) => *used = true,
                None => return refuse(format!("a triangle names a point {point} that does not exist"), whole),
            }
        }
        let mut numbers = vec![None; raw.points.len()];
        let mut points = Vec::new();
        let mut low = [f64::INFINITY; 3];
        let mut high = [-f64::INFINITY; 3];
        for (number, place) in raw.points.iter().enumerate().filter(|(number, _)| used[*number]) {
            if !place.iter().all(|x| x.is_finite()) {
                return refuse(format!("point {number} is not finite"), whole);
            }
            for axis in 0..3 {
                (low[axis], high[axis]) = (low[axis].min(place[axis]), high[axis].max(place[axis]));
            }
            numbers[number] = Some(points.len());
            points.push(Vec2::new(place[0], place[1]));
        }
        let extent = (high[0] - low[0]).max(high[1] - low[1]);
        if high[2] - low[2] > FLAT * extent {
            let problem = format!("its points do not lie in one plane: z runs from {:.3e} to {:.3e}", low[2], high[2]);
            return refuse(problem, "Use a mesh in the plane of x and y");
        }
        let number = |point: usize| numbers.get(point).copied().flatten();
        // In the order of the file.
        let mut cells: Vec<(usize, [usize; 3], &[i32])> = Vec::with_capacity(raw.triangles.len());
        for (corners, triangle) in &raw.triangles {
            let [Some(a), Some(b), Some(c)] = corners.map(number) else { continue };
            let [a, b, c] = if triangle.turned { [a, c, b] } else { [a, b, c] };
            cells.push((triangle.place, [a, b, c], &triangle.groups));
        }
        cells.sort_unstable();
        let triangles: Vec<[usize; 3]> = cells.iter().map(|(_, corners, _)| *corners).collect();
        let same = first_of_same(&points, &triangles, None);
        if let Some((second, &first)) = same.iter().enumerate().find(|(number, first)| *number != **first) {
            return Err(SolidError::coincident_points(first, second, points[second]));
        }
        let mut groups: BTreeMap<i32, Vec<usize>> = BTreeMap::new();
        for (triangle, (_, _, tags)) in cells.iter().enumerate() {
            tags.iter().for_each(|tag| groups.entry(*tag).or_default().push(triangle));
        }
        let mut boundaries: BTreeMap<i32, Vec<usize>> = BTreeMap::new();
        for (ends, tag) in &raw.lines {
            boundaries.entry(*tag).or_default().extend(ends.iter().filter_map(|end| number(*end)));
        }
        let name = |dimension: u8, tag: i32| raw.names.get(&(dimension, tag)).cloned();
        let groups = groups.into_iter().map(|(tag, triangles)| PhysicalGroup { tag, name: name(2, tag), triangles });
        let boundaries = boundaries.into_iter().map(|(tag, mut points)| {
            points.sort_unstable();
            points.dedup();
            BoundaryGroup { tag, name: name(1, tag), points }
        });
        let (groups, boundaries) = (groups.collect(), boundaries.collect());
        Ok(Self { mesh: TriangleMesh::new(points, triangles)?, groups, boundaries })
    }
}

#[cfg(test)]
mod tests;
