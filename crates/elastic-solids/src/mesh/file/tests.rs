//! One mesh in every format, and damaged files.

use std::collections::BTreeMap;

use std::sync::LazyLock;

use proptest::prelude::*;

use super::encoded::base64;
use super::*;

/// A quadrilateral of two triangles with a loose point, all in the plane z = 2, the first triangle in the group 7, the
/// lower side in the group 3.
const POINTS: [[f64; 3]; 5] = [[0.0, 0.0, 2.0], [9.0, 9.0, 2.0], [3.0, 0.0, 2.0], [3.0, 1.0, 2.0], [0.0, 2.0, 2.0]];
const TRIANGLES: [[usize; 3]; 2] = [[0, 2, 3], [0, 3, 4]];
/// Points in the middles of the sides 0-2, 2-3, 3-0, 3-4 and 4-0.
const MIDDLES: [[f64; 3]; 5] = [[1.5, -0.5, 2.0], [3.0, 0.5, 2.0], [1.5, 0.5, 2.0], [1.5, 1.5, 2.0], [0.0, 1.0, 2.0]];
const SECOND: [[usize; 6]; 2] = [[0, 2, 3, 5, 6, 7], [0, 3, 4, 7, 8, 9]];

/// A file of either order in text or bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Kind {
    second: bool,
    binary: bool,
    big_endian: bool,
}

const KINDS: [Kind; 5] = [
    Kind { second: false, binary: false, big_endian: false },
    Kind { second: true, binary: false, big_endian: false },
    Kind { second: false, binary: true, big_endian: false },
    Kind { second: true, binary: true, big_endian: false },
    Kind { second: true, binary: true, big_endian: true },
];

/// Writer of numbers as words or bytes.
struct Writer(Kind, Vec<u8>);

impl Writer {
    fn text(&mut self, text: &str) {
        self.1.extend(text.as_bytes());
    }

    fn put<const N: usize>(&mut self, mut bytes: [u8; N], word: &str) {
        if self.0.big_endian {
            bytes.reverse();
        }
        if self.0.binary { self.1.extend(bytes) } else { self.text(&format!("{word} ")) }
    }

    fn ints(&mut self, list: &[usize]) {
        list.iter().for_each(|value| self.put((*value as i32).to_le_bytes(), &value.to_string()));
    }

    fn longs(&mut self, list: &[usize]) {
        list.iter().for_each(|value| self.put((*value as i64).to_le_bytes(), &value.to_string()));
    }

    fn doubles(&mut self, list: &[f64]) {
        list.iter().for_each(|value| self.put(value.to_le_bytes(), &value.to_string()));
    }
}

fn points(kind: Kind) -> Vec<[f64; 3]> {
    if kind.second { [&POINTS[..], &MIDDLES[..]].concat() } else { POINTS.to_vec() }
}

fn cells(kind: Kind) -> Vec<Vec<usize>> {
    if kind.second { SECOND.map(|cell| cell.to_vec()).to_vec() } else { TRIANGLES.map(|cell| cell.to_vec()).to_vec() }
}

fn base(kind: Kind) -> Vec<usize> {
    if kind.second { vec![0, 2, 5] } else { vec![0, 2] }
}

fn head(kind: Kind, version: &str) -> Writer {
    let mut file = Writer(kind, Vec::new());
    file.text(&format!("$MeshFormat\n{version} {} 8\n", u8::from(kind.binary)));
    if kind.binary {
        file.ints(&[1]);
        file.text("\n");
    }
    file.text("$EndMeshFormat\n$Comments\nfrom hand\n$EndComments\n");
    file.text("$PhysicalNames\n2\n1 3 \"base of it\"\n2 7 \"soft\"\n$EndPhysicalNames\n");
    file
}

/// Version 2.2, nodes numbered from 11.
fn gmsh_2(kind: Kind) -> Vec<u8> {
    let mut file = head(kind, "2.2");
    let all = points(kind);
    file.text(&format!("$Nodes\n{}\n", all.len()));
    for (number, place) in all.iter().enumerate() {
        file.ints(&[number + 11]);
        file.doubles(place);
    }
    file.text("\n$EndNodes\n$Elements\n4\n");
    let of_base: Vec<usize> = base(kind).iter().map(|point| point + 11).collect();
    let [line, triangle] = if kind.second { [8, 9] } else { [1, 2] };
    // A point, the base in the group 3, and the two triangles, of which the second one has no group.
    let elements = [(15, 0, vec![11]), (line, 3, of_base)];
    let triangles = cells(kind).into_iter().zip([7, 0]);
    let triangles = triangles.map(|(cell, group)| (triangle, group, cell.iter().map(|point| point + 11).collect()));
    for (number, (element, group, nodes)) in elements.into_iter().chain(triangles).enumerate() {
        match kind.binary {
            true => file.ints(&[element, 1, 2, number + 1, group, 1]),
            false => file.ints(&[number + 1, element, 2, group, 1]),
        }
        file.ints(&nodes);
    }
    file.text("\n$EndElements\n");
    file.1
}

/// Version 4.1, with two surfaces, of which the first one is in the group 7.
fn gmsh_4(kind: Kind) -> Vec<u8> {
    let mut file = head(kind, "4.1");
    let all = points(kind);
    file.text("$Entities\n");
    file.longs(&[1, 1, 2, 0]);
    file.ints(&[1]);
    file.doubles(&[0.0; 3]);
    file.longs(&[0]);
    file.ints(&[5]);
    file.doubles(&[0.0; 6]);
    file.longs(&[1]);
    file.ints(&[3]);
    file.longs(&[2]);
    file.ints(&[1, 2]);
    for (surface, groups) in [(1, &[7][..]), (2, &[])] {
        file.ints(&[surface]);
        file.doubles(&[0.0; 6]);
        file.longs(&[groups.len()]);
        file.ints(groups);
        file.longs(&[0]);
    }
    file.text("\n$EndEntities\n$Nodes\n");
    // The first node on a curve with a parameter, the others on a surface.
    file.longs(&[2, all.len(), 11, 40]);
    file.ints(&[1, 5, 1]);
    file.longs(&[1, 11]);
    file.doubles(&all[0]);
    file.doubles(&[0.25]);
    file.ints(&[2, 1, 0]);
    file.longs(&[all.len() - 1]);
    (1..all.len()).for_each(|number| file.longs(&[number + 11]));
    all[1..].iter().for_each(|place| file.doubles(place));
    file.text("\n$EndNodes\n$Elements\n");
    file.longs(&[3, 3, 1, 3]);
    let [line, triangle] = if kind.second { [8, 9] } else { [1, 2] };
    let nodes = |cell: &[usize]| cell.iter().map(|point| point + 11).collect::<Vec<_>>();
    for (element, (dimension, entity, of, cell)) in
        [(1, 5, line, base(kind)), (2, 1, triangle, cells(kind)[0].clone()), (2, 2, triangle, cells(kind)[1].clone())]
            .into_iter()
            .enumerate()
    {
        file.ints(&[dimension, entity, of]);
        file.longs(&[1, element + 1]);
        file.longs(&nodes(&cell));
    }
    file.text("\n$EndElements\n");
    file.1
}

/// A legacy file of VTK of version 3 or 5.1, whose bytes are big-endian.
fn vtk(kind: Kind, new: bool) -> Vec<u8> {
    let mut file = Writer(Kind { big_endian: true, ..kind }, Vec::new());
    let version = if new { "5.1" } else { "3.0" };
    let mode = if kind.binary { "BINARY" } else { "ASCII" };
    file.text(&format!("# vtk DataFile Version {version}\nby hand\n{mode}\nDATASET UNSTRUCTURED_GRID\n"));
    let all = points(kind);
    file.text(&format!("POINTS {} double\n", all.len()));
    all.iter().for_each(|place| file.doubles(place));
    let (list, total) = (cells(kind), cells(kind).iter().map(Vec::len).sum::<usize>());
    if new {
        file.text(&format!("\nMETADATA\nINFORMATION 0\n\nCELLS 3 {total}\nOFFSETS vtktypeint64\n"));
        file.longs(&[0, list[0].len(), total]);
        file.text("\nCONNECTIVITY vtktypeint64\n");
        list.iter().for_each(|cell| file.longs(cell));
    } else {
        file.text(&format!("\nCELLS 2 {}\n", total + 2));
        for cell in &list {
            file.ints(&[cell.len()]);
            file.ints(cell);
        }
    }
    file.text("\nCELL_TYPES 2\n");
    file.ints(&[if kind.second { 22 } else { 5 }; 2]);
    file.text("\nCELL_DATA 2\n");
    if new {
        file.text("FIELD FieldData 2\nquality 1 2 double\n");
        file.doubles(&[0.5, 0.75]);
        file.text("\ngmsh:physical 1 2 int\n");
    } else {
        file.text("SCALARS material int 1\nLOOKUP_TABLE default\n");
    }
    file.ints(&[7, 8]);
    file.text("\n");
    file.1
}

/// Text of bytes in base64.
fn to_base64(bytes: &[u8]) -> String {
    const SIGNS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for part in bytes.chunks(3) {
        let bits = (0..3).fold(0u32, |bits, k| (bits << 8) | u32::from(*part.get(k).unwrap_or(&0)));
        for k in 0..4 {
            let sign = SIGNS[(bits >> (18 - 6 * k)) as usize & 63] as char;
            text.push(if k <= part.len() { sign } else { '=' });
        }
    }
    text
}

/// An XML file: arrays as text, in base64, appended in base64 or raw, with zlib or without.
fn vtu(kind: Kind, format: &str, zlib: bool) -> Vec<u8> {
    let appended = format.strip_prefix("appended ");
    let mut data: Vec<u8> = Vec::new();
    let all = points(kind);
    let list = cells(kind);
    let ends = [list[0].len(), list[0].len() + list[1].len()];
    let mut array = |name: &str, of: &str, write: &dyn Fn(&mut Writer)| {
        let binary = format != "ascii";
        let mut inner = Writer(Kind { binary, ..kind }, Vec::new());
        write(&mut inner);
        let open = format!("<DataArray type=\"{of}\" Name=\"{name}\" NumberOfComponents=\"3\"");
        if !binary {
            return format!("{open} format=\"ascii\">\n{}\n</DataArray>", String::from_utf8(inner.1).unwrap());
        }
        let length = |value: usize| {
            let mut bytes = (value as u32).to_le_bytes();
            if kind.big_endian {
                bytes.reverse();
            }
            bytes
        };
        let parts = if zlib {
            // Two blocks, the last one shorter.
            let size = inner.1.len() * 2 / 3 + 1;
            let blocks: Vec<Vec<u8>> =
                inner.1.chunks(size).map(|block| miniz_oxide::deflate::compress_to_vec_zlib(block, 6)).collect();
            let lengths = [blocks.len(), size, inner.1.len() % size];
            let lengths = lengths.into_iter().chain(blocks.iter().map(Vec::len)).flat_map(length).collect();
            vec![lengths, blocks.concat()]
        } else {
            vec![[&length(inner.1.len())[..], &inner.1].concat()]
        };
        let offset = data.len();
        let text: String = parts.iter().map(|part| to_base64(part)).collect();
        match appended {
            None => return format!("{open} format=\"binary\">\n  {text}\n</DataArray>"),
            Some("base64") => data.extend(text.as_bytes()),
            _ => parts.iter().for_each(|part| data.extend(part)),
        }
        format!("{open} format=\"appended\" offset=\"{offset}\"/>")
    };
    let body = [
        "<Points>".to_owned(),
        array("Points", "Float64", &|file| all.iter().for_each(|place| file.doubles(place))),
        "</Points><Cells>".to_owned(),
        array("connectivity", "Int64", &|file| list.iter().for_each(|cell| file.longs(cell))),
        array("offsets", "Int64", &|file| file.longs(&ends)),
        array("types", "Int32", &|file| file.ints(&[if kind.second { 22 } else { 5 }; 2])),
        "</Cells><CellData>".to_owned(),
        array("gmsh:physical", "Int32", &|file| file.ints(&[7, 8])),
        "</CellData>".to_owned(),
    ];
    let order = if kind.big_endian { "BigEndian" } else { "LittleEndian" };
    let compressor = if zlib { " compressor=\"vtkZLibDataCompressor\"" } else { "" };
    let mut file = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" \
         byte_order=\"{order}\"{compressor}>\n\
         <UnstructuredGrid><Piece NumberOfPoints=\"{}\" NumberOfCells=\"2\">{}</Piece></UnstructuredGrid>\n",
        all.len(),
        body.concat()
    )
    .into_bytes();
    if let Some(encoding) = appended {
        file.extend(format!("<AppendedData encoding=\"{encoding}\">\n_").as_bytes());
        file.extend(data);
        file.extend(b"\n</AppendedData>");
    }
    file.extend(b"</VTKFile>\n");
    file
}

/// All files that hold the mesh: name, true for the second order, bytes.
type Files = Vec<(String, bool, Vec<u8>)>;

static FILES: LazyLock<Files> = LazyLock::new(files);

fn files() -> Files {
    let mut all = Vec::new();
    for kind in KINDS {
        all.push((format!("Gmsh 2.2 {kind:?}"), kind.second, gmsh_2(kind)));
        all.push((format!("Gmsh 4.1 {kind:?}"), kind.second, gmsh_4(kind)));
        all.push((format!("VTK 3 {kind:?}"), kind.second, vtk(kind, false)));
        all.push((format!("VTK 5.1 {kind:?}"), kind.second, vtk(kind, true)));
        for format in ["ascii", "binary", "appended base64", "appended raw"] {
            for zlib in [false, true] {
                all.push((format!("VTU {format} {zlib} {kind:?}"), kind.second, vtu(kind, format, zlib)));
            }
        }
    }
    all
}

/// The mesh of first order has four points and two triangles; of second order, nine and eight, along the bulge of its
/// lower side. Areas are those of the polygons through the points.
#[test]
fn every_format_holds_the_mesh() {
    for (name, second, bytes) in FILES.iter() {
        let file = MeshFile::from_bytes(bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
        let (points, triangles, area) = if *second { (9, 8, 5.25) } else { (4, 2, 4.5) };
        assert_eq!((file.mesh.points().len(), file.mesh.triangles().len()), (points, triangles), "{name}");
        assert!((file.mesh.area() - area).abs() < 1e-14, "{name}: {}", file.mesh.area());
        assert_eq!(file.mesh.points()[0], Vec2::ZERO, "{name}");
        assert_eq!(file.mesh.points()[1], Vec2::new(3.0, 0.0), "{name}");
        let group = &file.groups[0];
        assert_eq!((group.tag, &group.triangles), (7, &(0..triangles / 2).collect()), "{name}");
        let gmsh = name.starts_with("Gmsh");
        assert_eq!(group.name.as_deref(), gmsh.then_some("soft"), "{name}");
        let base = file.boundaries.iter().map(|base| (base.tag, base.name.as_deref(), base.points.clone()));
        let base: Vec<_> = base.collect();
        let members = if *second { vec![0, 1, 4] } else { vec![0, 1] };
        assert_eq!(base, if gmsh { vec![(3, Some("base of it"), members)] } else { vec![] }, "{name}");
        let scaled = file.scaled(1e-6).unwrap();
        assert!((scaled.mesh.area() / (area * 1e-12) - 1.0).abs() < 1e-12, "{name}");
    }
}

/// A triangle of two groups is twice in a file of version 2.2.
#[test]
fn triangles_that_are_twice_in_a_file_are_one() {
    let text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n\
                $Elements\n3\n1 2 2 4 1 1 2 3\n2 2 2 5 1 1 2 3\n3 2 2 4 1 2 3 1\n$EndElements\n";
    let file = MeshFile::from_bytes(text.as_bytes()).unwrap();
    assert_eq!(file.mesh.triangles(), [[0, 1, 2]]);
    let groups: BTreeMap<i32, &[usize]> = file.groups.iter().map(|group| (group.tag, &group.triangles[..])).collect();
    assert_eq!(groups, BTreeMap::from([(4, &[0][..]), (5, &[0][..])]));
}

#[test]
fn what_is_wrong_is_told_with_a_remedy() {
    let nodes = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n\
                 $EndNodes\n$Elements\n1\n";
    let grid = "# vtk DataFile Version 3.0\nt\nASCII\n";
    let close = "$EndElements\n";
    for (text, said) in [
        ("nothing".to_owned(), "its format is not known. Use Gmsh (.msh)"),
        ("$MeshFormat\n3.0 0 8\n$EndMeshFormat\n".to_owned(), "its version is 3.0. In Gmsh, save triangles"),
        ("$Nodes\n0\n$EndNodes\n".to_owned(), "does not start with $MeshFormat"),
        (
            format!("{nodes}1 2 2 0 1 1 2 3\n2 2 2 0 1 1 3 4\n{close}"),
            "the section $Elements goes on after the number of entries that it states",
        ),
        (format!("{nodes}1 3 2 0 1 1 2 3 4\n{close}"), "quadrilaterals, which motile does not compute"),
        (format!("{nodes}1 4 2 0 1 1 2 3 4\n{close}"), "three-dimensional, but motile computes solids in the plane"),
        (format!("{nodes}1 21 2 0 1 1 2 3 4\n{close}"), "of an order above 2"),
        (format!("{nodes}1 2 2 0 1 1 2 9\n{close}"), "names node 9, which does not exist"),
        (format!("{nodes}1 2 2 0 1 1 2\n"), "line 14 of the mesh file cannot be used: the file ends too early"),
        (format!("{nodes}1 2 2 0 1 1 b 3\n"), "\"b\" is not a number that can stand here"),
        (format!("{nodes}1 1 2 0 1 1 2\n{close}"), "it has no triangles. Mesh the surface"),
        (format!("{nodes}1 2 2 0 1 1 1 2\n{close}"), "triangle"),
        (format!("{}1 2 2 0 1 1 2 3\n{close}", nodes.replace("3 1 1 0", "3 1 1 5")), "do not lie in one plane"),
        (
            format!(
                "{grid}DATASET UNSTRUCTURED_GRID\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\nCELLS 1 4\n3 0 1 -1\n\
                 CELL_TYPES 1\n5\n"
            ),
            "-1 is not the number of a point",
        ),
        (format!("{grid}DATASET POLYDATA\n"), "it is a polydata, not an unstructured grid"),
        (format!("{grid}DATASET UNSTRUCTURED_GRID\nPOINTS 99 float\n0 0\n"), "297 numbers are announced"),
        ("<VTKFile type=\"PolyData\"/>".to_owned(), "it is not an unstructured grid"),
        ("<VTKFile type=\"UnstructuredGrid\" compressor=\"vtkLZ4DataCompressor\"/>".to_owned(), "vtkLZ4DataCompressor"),
        ("<VTKFile".to_owned(), "line 1"),
    ] {
        let error = MeshFile::from_bytes(text.as_bytes()).unwrap_err().to_string();
        assert!(error.contains(said), "{text}: {error}");
    }
    // Every file that ends too early is refused, and none panics.
    for (name, _, bytes) in FILES.iter().step_by(5) {
        for length in (0..bytes.len() - 40).step_by(23) {
            let whole = MeshFile::from_bytes(&bytes[..length]).map(|file| file.mesh.triangles().len());
            assert!(whole.is_err() || name.starts_with("VTK"), "{name} {length}");
        }
    }
}

#[test]
fn base64_is_read_as_it_is_written() {
    for length in 0..20 {
        let bytes: Vec<u8> = (0..length).map(|k| k * 37 + 5).collect();
        let text = to_base64(&bytes);
        assert_eq!(base64(text.as_bytes()), Some((bytes, text.len())));
    }
    assert_eq!(base64(b"AA=A"), None);
    assert_eq!(base64(b"AAA"), None);
    assert_eq!(base64(b"A*AA"), None);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Files with bytes that are changed: an error or a mesh, never a panic.
    #[test]
    fn damaged_files(number in 0usize..60, changes in proptest::collection::vec((any::<u16>(), any::<u8>()), 1..6)) {
        let mut bytes = FILES[number % FILES.len()].2.clone();
        for (place, value) in changes {
            let count = bytes.len();
            bytes[usize::from(place) % count] = value;
        }
        let _ = MeshFile::from_bytes(&bytes);
    }

    #[test]
    fn any_bytes(bytes in proptest::collection::vec(any::<u8>(), 0..100)) {
        let _ = MeshFile::from_bytes(&bytes);
        let gmsh = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n";
        for start in [gmsh, "# vtk DataFile Version 5.1\n\nBINARY\nCELLS 3 "] {
            let _ = MeshFile::from_bytes(&[start.as_bytes(), &bytes].concat());
        }
    }
}
