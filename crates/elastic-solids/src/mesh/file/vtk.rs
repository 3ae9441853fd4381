//! Legacy files of VTK with an unstructured grid, ASCII and binary:
//! <https://docs.vtk.org/en/latest/vtk_file_formats/vtk_legacy_file_format.html>.

use super::bytes::Cursor;
use super::raw::{Cell, RawMesh};
use crate::SolidError;

const REMEDY: &str = "Save the mesh as an unstructured grid of triangles in the plane of x and y";

/// Names of data of cells that are groups.
const GROUPS: [&str; 6] = ["gmsh:physical", "cell_tags", "group", "material", "region", "medit:ref"];

/// Returns true for the name of data that are numbers of groups.
pub(super) fn is_group(name: &str) -> bool {
    GROUPS.contains(&name.to_ascii_lowercase().as_str())
}

/// Cells of a grid of VTK.
#[derive(Debug, Default)]
pub(super) struct Grid {
    pub(super) points: Vec<[f64; 3]>,
    /// Points of each cell.
    pub(super) cells: Vec<Vec<usize>>,
    pub(super) types: Vec<f64>,
    pub(super) groups: Vec<f64>,
}

impl Grid {
    /// Returns the mesh of the cells.
    pub(super) fn mesh(self) -> Result<RawMesh, SolidError> {
        let refuse = |problem: String| Err(SolidError::mesh_file("the mesh file", problem, REMEDY));
        if self.cells.len() != self.types.len() {
            return refuse(format!("it has {} cells and {} types of cells", self.cells.len(), self.types.len()));
        }
        let mut mesh = RawMesh { points: self.points, ..RawMesh::default() };
        for (number, (points, kind)) in self.cells.iter().zip(&self.types).enumerate() {
            let (cell, size) = match *kind as i64 {
                1 | 2 => (Cell::Ignored, points.len()),
                3 => (Cell::Line(1), 2),
                21 => (Cell::Line(2), 3),
                5 => (Cell::Triangle(1), 3),
                22 => (Cell::Triangle(2), 6),
                8 | 9 | 23 | 28 => return refuse("it has quadrilaterals, which motile does not compute".to_owned()),
                7 | 4 | 6 => return refuse("it has polygons or strips. Triangulate it".to_owned()),
                other => return refuse(format!("it has cells of the type {other}, which are no triangles")),
            };
            if points.len() != size {
                return refuse(format!("cell {number} has {} points instead of {size}", points.len()));
            }
            let group = self.groups.get(number).map(|group| *group as i32);
            mesh.add(cell, points, group.as_slice())?;
        }
        Ok(mesh)
    }
}

pub(super) fn read(bytes: &[u8]) -> Result<RawMesh, SolidError> {
    let mut at = Cursor::new(bytes, REMEDY);
    at.line()?;
    // The title may be in any encoding.
    at.skip_past("\n")?;
    let binary = match at.word()?.to_ascii_uppercase().as_str() {
        "ASCII" => false,
        "BINARY" => true,
        _ => return Err(at.error("the third line is neither ASCII nor BINARY")),
    };
    at.big_endian = true;
    let mut grid = Grid::default();
    let mut cell_data = false;
    let mut tuples = 0;
    while !at.at_end() {
        let values = |at: &mut Cursor<'_>, kind: &str, count: usize| {
            if binary {
                at.end_line();
            }
            at.binary = binary;
            let found = at.all(kind, count);
            at.binary = false;
            found
        };
        match at.word()?.to_ascii_uppercase().as_str() {
            "DATASET" => {
                let kind = at.word()?.to_ascii_uppercase();
                if kind != "UNSTRUCTURED_GRID" {
                    return Err(at.error(format!("it is a {}, not an unstructured grid", kind.to_ascii_lowercase())));
                }
            }
            "POINTS" => {
                let count = counted(&mut at)?;
                let kind = at.word()?;
                let found = values(&mut at, kind, 3 * count)?;
                grid.points = found.chunks_exact(3).map(|point| [point[0], point[1], point[2]]).collect();
            }
            "CELLS" => {
                let [cells, size] = [counted(&mut at)?, counted(&mut at)?];
                if at.peek().eq_ignore_ascii_case("offsets") {
                    // Version 5.1: the beginnings of the cells and the end.
                    let part = |at: &mut Cursor<'_>, count| {
                        at.word()?;
                        let kind = at.word()?;
                        values(at, kind, count)
                    };
                    let offsets = part(&mut at, cells)?;
                    let connectivity = part(&mut at, size)?;
                    let ends = offsets.get(1..).unwrap_or_default();
                    grid.cells = cells_of(&connectivity, ends).map_err(|problem| at.error(problem))?;
                } else {
                    let all = values(&mut at, "int", size)?;
                    let mut rest = all.as_slice();
                    for _ in 0..cells {
                        let count = rest.first().map_or(Ok(0), |count| index(*count));
                        let count = count.map_err(|problem| at.error(problem))?;
                        let points = rest.get(1..count.saturating_add(1));
                        let points = points.ok_or_else(|| at.error("a cell has more points than the list"))?;
                        let points = points.iter().map(|point| index(*point)).collect::<Result<_, _>>();
                        grid.cells.push(points.map_err(|problem| at.error(problem))?);
                        rest = &rest[count + 1..];
                    }
                }
            }
            "CELL_TYPES" => {
                let count = counted(&mut at)?;
                grid.types = values(&mut at, "int", count)?;
            }
            section @ ("CELL_DATA" | "POINT_DATA") => {
                cell_data = section == "CELL_DATA";
                tuples = counted(&mut at)?;
            }
            "SCALARS" => {
                let [name, kind] = [at.word()?, at.word()?];
                let line = at.line()?;
                let components = if line.is_empty() { 1 } else { at.count(line.parse().unwrap_or(1))? };
                if at.peek().eq_ignore_ascii_case("lookup_table") {
                    at.word()?;
                    at.word()?;
                }
                let found = values(&mut at, kind, tuples.saturating_mul(components))?;
                if cell_data && components == 1 && is_group(name) {
                    grid.groups = found;
                }
            }
            "VECTORS" | "NORMALS" => {
                at.word()?;
                let kind = at.word()?;
                values(&mut at, kind, tuples.saturating_mul(3))?;
            }
            "FIELD" => {
                at.word()?;
                for _ in 0..counted(&mut at)? {
                    if at.peek() == "METADATA" {
                        at.word()?;
                        at.skip_paragraph()?;
                    }
                    let name = at.word()?;
                    let [components, count] = [counted(&mut at)?, counted(&mut at)?];
                    let kind = at.word()?;
                    let found = values(&mut at, kind, components.saturating_mul(count))?;
                    if cell_data && components == 1 && is_group(name) {
                        grid.groups = found;
                    }
                }
            }
            "METADATA" => at.skip_paragraph()?,
            // What follows the mesh is not needed.
            _ if !grid.types.is_empty() => break,
            other => {
                let other: String = other.chars().take(40).collect();
                return Err(at.error(format!("the section {other:?} is not read")));
            }
        }
    }
    grid.mesh()
}

fn counted(at: &mut Cursor<'_>) -> Result<usize, SolidError> {
    let found: i64 = at.parsed()?;
    at.count(found)
}

/// Returns the number of a point or of entries.
fn index(value: f64) -> Result<usize, String> {
    let whole = value >= 0.0 && value.fract() == 0.0 && value < 9e15;
    if whole { Ok(value as usize) } else { Err(format!("{value} is not the number of a point")) }
}

/// Returns the points of cells from the list of all and the ends of the cells in it.
pub(super) fn cells_of(connectivity: &[f64], ends: &[f64]) -> Result<Vec<Vec<usize>>, String> {
    let mut start = 0;
    let cell = |end: &f64| {
        let end = index(*end)?;
        let points =
            connectivity.get(start..end).ok_or_else(|| "the ends of the cells do not fit their points".to_owned())?;
        start = end;
        points.iter().map(|point| index(*point)).collect()
    };
    ends.iter().map(cell).collect()
}
