//! Unstructured grids of VTK in XML:
//! <https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html>.

use roxmltree::{Document, Node};

use super::bytes::Cursor;
use super::encoded::Encoding;
use super::raw::{MOST, RawMesh};
use super::vtk::{Grid, cells_of, is_group};
use crate::SolidError;

const REMEDY: &str = "Save it as an unstructured grid (.vtu) of triangles, as ASCII or with zlib compression";

fn refused(problem: impl Into<String>) -> SolidError {
    SolidError::mesh_file("the mesh file", problem, REMEDY)
}

/// Arrays of a file.
struct Arrays<'a> {
    encoding: Encoding,
    appended: Option<(&'a [u8], bool)>,
}

pub(super) fn read(bytes: &[u8]) -> Result<RawMesh, SolidError> {
    // Appended data need not be text.
    let find = |text: &[u8]| bytes.windows(text.len()).position(|window| window == text);
    let start = find(b"<AppendedData");
    let appended = start.and_then(|start| {
        let open = start + bytes[start..].iter().position(|byte| *byte == b'>')?;
        let base64 = bytes[start..open].windows(6).any(|window| window == b"base64");
        let mark = open + bytes[open..].iter().position(|byte| *byte == b'_')?;
        Some((&bytes[mark + 1..], base64))
    });
    let without = start.map(|start| [&bytes[..start], b"</VTKFile>"].concat());
    let text = std::str::from_utf8(without.as_deref().unwrap_or(bytes)).map_err(|_| refused("it is not text"))?;
    let document = Document::parse(text).map_err(|error| refused(format!("line {}: {error}", error.pos().row)))?;
    let root = document.root_element();
    if root.tag_name().name() != "VTKFile" || root.attribute("type") != Some("UnstructuredGrid") {
        return Err(refused("it is not an unstructured grid of VTK"));
    }
    let compressor = root.attribute("compressor").unwrap_or_default();
    if !(compressor.is_empty() || compressor == "vtkZLibDataCompressor") {
        return Err(refused(format!("its compression by {compressor} is not read")));
    }
    let encoding = Encoding {
        long: root.attribute("header_type") == Some("UInt64"),
        big_endian: root.attribute("byte_order") == Some("BigEndian"),
        zlib: !compressor.is_empty(),
    };
    let arrays = Arrays { encoding, appended };
    let mut pieces = root.descendants().filter(|node| node.has_tag_name("Piece"));
    let piece = pieces.next().ok_or_else(|| refused("it has no piece"))?;
    if pieces.next().is_some() {
        return Err(refused("it has several pieces. Save it as one"));
    }
    let size = |key: &str| {
        let found =
            piece.attribute(key).and_then(|text| text.trim().parse().ok()).filter(|count: &usize| *count <= MOST);
        found.ok_or_else(|| refused(format!("{key} is missing or too large")))
    };
    let (points, cells) = (size("NumberOfPoints")?, size("NumberOfCells")?);
    let child = |name: &'static str| piece.children().find(|node| node.has_tag_name(name));
    let within = |name: &'static str| child(name).ok_or_else(|| refused(format!("{name} are missing")));
    let named = |parent: Node<'_, '_>, name: &str| {
        let array = parent.children().find(|node| node.attribute("Name") == Some(name));
        array.map(|node| node.id()).ok_or_else(|| refused(format!("the array {name} is missing")))
    };
    let array = |id| document.get_node(id).ok_or_else(|| refused("an array is missing"));
    let place = within("Points")?.children().find(|node| node.has_tag_name("DataArray"));
    let places = arrays.values(place.ok_or_else(|| refused("the array of points is missing"))?, 3 * points)?;
    let list = within("Cells")?;
    let ends = arrays.values(array(named(list, "offsets")?)?, cells)?;
    let last = ends.last().map_or(0, |last| *last as usize);
    let connectivity = arrays.values(array(named(list, "connectivity")?)?, last)?;
    let types = arrays.values(array(named(list, "types")?)?, cells)?;
    let groups =
        child("CellData").and_then(|data| data.children().find(|node| node.attribute("Name").is_some_and(is_group)));
    let groups = groups.map(|node| arrays.values(node, cells)).transpose()?.unwrap_or_default();
    let grid = Grid {
        points: places.chunks_exact(3).map(|point| [point[0], point[1], point[2]]).collect(),
        cells: cells_of(&connectivity, &ends).map_err(refused)?,
        types,
        groups,
    };
    grid.mesh()
}

impl Arrays<'_> {
    /// Returns the numbers of an array.
    fn values(&self, node: Node<'_, '_>, count: usize) -> Result<Vec<f64>, SolidError> {
        let kind = node.attribute("type").unwrap_or_default();
        let name = node.attribute("Name").unwrap_or("of points");
        let text = node.text().unwrap_or_default().as_bytes();
        let damaged = || refused(format!("the array {name} is damaged or ends too early"));
        let bytes = match node.attribute("format").unwrap_or("ascii") {
            "ascii" => return Cursor::new(text, REMEDY).all(kind, count).map_err(|_| damaged()),
            "binary" => self.encoding.decode(text.trim_ascii(), true),
            "appended" => {
                let offset: usize = node.attribute("offset").and_then(|text| text.trim().parse().ok()).unwrap_or(0);
                self.appended.and_then(|(data, base64)| {
                    let rest = data.get(offset..)?;
                    // The array ends where its text in base64 does.
                    let length = if base64 {
                        rest.iter().position(|byte| *byte == b'<').unwrap_or(rest.len())
                    } else {
                        rest.len()
                    };
                    self.encoding.decode(rest[..length].trim_ascii(), base64)
                })
            }
            other => return Err(refused(format!("the format {other:?} of an array is not read"))),
        };
        let bytes = bytes.ok_or_else(damaged)?;
        let mut at = Cursor::new(&bytes, REMEDY);
        (at.binary, at.big_endian) = (true, self.encoding.big_endian);
        at.all(kind, count).map_err(|_| damaged())
    }
}
