//! Twelve files as other programs write them, made by small generators. Each is read, run and compared with the area
//! and perimeter of its shape, or refused in a sentence that helps.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::path::PathBuf;

use motile::prelude::*;
use motile::scene::SceneError;
use motile::setup::OutlineReport;

/// A directory with the files of one test.
struct Directory(PathBuf);

impl Directory {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("motile-files-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).expect("a directory");
        Self(path)
    }

    /// Writes a file and a scene that names it, and reads the scene.
    fn scene(&self, file: &str, bytes: &[u8], scene: &str) -> Result<Setup, String> {
        std::fs::write(self.0.join(file), bytes).expect("a file");
        let path = self.0.join("scene.toml");
        std::fs::write(&path, scene).expect("a scene");
        Setup::from_file(&path).map_err(|error| error.to_string())
    }

    /// A passive droplet of the outline of a file, with its report. It takes two steps.
    fn droplet(&self, file: &str, bytes: &[u8], more: &str) -> Result<OutlineReport, String> {
        let scene = format!(
            "region = \"plane\"\nmethod.integral = {{ nodes = 32, elements = 64 }}\n[[droplets]]\n\
             particles = \"none\"\nshape.outline = {{ file = \"{file}\"{more} }}\n"
        );
        let setup = self.scene(file, bytes, &scene)?;
        let mut built = setup.build().map_err(|error| error.to_string())?;
        let area = built.scene.observe(built.droplets[0]).expect("a droplet").area;
        few_steps(&mut built.scene);
        let after = built.scene.observe(built.droplets[0]).expect("a droplet").area;
        let report = setup.outlines().map_err(|error| error.to_string())?.remove(0);
        // The polygon of 64 markers has the area of the outline.
        assert!((area / report.area - 1.0).abs() < 3e-3, "{file}: {area} {}", report.area);
        assert!((after / area - 1.0).abs() < 1e-4, "{file}");
        Ok(report)
    }

    /// A soft disc on the mesh of a file next to a droplet: its area and its numbers of points and pinned points, after
    /// two steps.
    fn solid(&self, file: &str, bytes: &[u8], more: &str) -> Result<(f64, usize, usize), String> {
        let scene = format!(
            "region.box.lengths = [6.0, 6.0]\nmethod.grid = {{ spacing = 0.1, corrected = false }}\n\
             [[droplets]]\ncentre = [-1.4, 0.0]\n[[solids]]\nmaterial.neo-hookean = {{ shear = 50.0, bulk = 100.0 }}\n\
             outline.mesh = {{ file = \"{file}\", scale = 1e-6, place = [1.4, 0.0]{more}\n"
        );
        let setup = self.scene(file, bytes, &scene)?;
        let mut built = setup.build().map_err(|error| error.to_string())?;
        few_steps(&mut built.scene);
        let solid = built.scene.body(built.solids[0]).expect("a solid");
        let points = solid.mesh().points().len();
        Ok((solid.mesh().area(), points, points - solid.free_points().len()))
    }
}

impl Drop for Directory {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn few_steps(scene: &mut Scene<AnyFlow>) {
    match scene.run(1e3).most_steps(2).go() {
        Ok(()) | Err(SceneError::TooManySteps { .. }) => {}
        Err(error) => panic!("{error}"),
    }
}

fn ellipse(count: usize, [x, y]: [f64; 2], [a, b]: [f64; 2]) -> Vec<[f64; 2]> {
    let angles = (0..count).map(|k| TAU * k as f64 / count as f64);
    angles.map(|t| [x + a * t.cos(), y + b * t.sin()]).collect()
}

/// The sides of the pixels around a disc of so many pixels: a point at each step.
fn traced(radius: i32) -> Vec<[f64; 2]> {
    let half = |y: i32| (f64::from(radius * radius) - (f64::from(y) + 0.5).powi(2)).sqrt().round() as i32;
    let rows: Vec<[i32; 2]> = (-radius..radius).flat_map(|y| [[half(y), y], [half(y), y + 1]]).collect();
    let right = rows.windows(2).flat_map(|pair| {
        let ([[x, y], [to, _]], step) = ([pair[0], pair[1]], (pair[1][0] - pair[0][0]).signum());
        (0..(to - x).abs().max(1)).map(move |k| [x + step * k, y])
    });
    let mut points: Vec<[f64; 2]> = right.map(|[x, y]| [f64::from(x), f64::from(y)]).collect();
    points.push([f64::from(half(radius - 1)), f64::from(radius)]);
    let left: Vec<[f64; 2]> = points.iter().rev().map(|[x, y]| [-x, *y]).collect();
    points.extend(left);
    points.into_iter().map(|[x, y]| [x + 900.0, y + 800.0]).collect()
}

fn table(points: &[[f64; 2]], separator: &str) -> String {
    points.iter().fold(String::new(), |mut text, [x, y]| {
        let _ = writeln!(text, "{x}{separator}{y}");
        text
    })
}

#[test]
fn a_vertex_file() {
    let directory = Directory::new("vertex");
    let text = format!("200\n{}", table(&ellipse(200, [0.5, 0.5], [0.2, 0.1]), "\t"));
    let report = directory.droplet("cell2d_64.vertex", text.as_bytes(), ", scale = 6.0").unwrap();
    assert!((report.area / (PI * 0.72) - 1.0).abs() < 1e-7 && report.points == 200);
    assert!(report.distance < 1e-3 && report.centroid[0].hypot(report.centroid[1]) < 1e-12);
}

#[test]
fn a_traced_contour_of_thousands_of_points() {
    let directory = Directory::new("traced");
    let mut points = traced(600);
    points.push(points[0]);
    points.reverse();
    let text = format!("X,Y\n{}", table(&points, ","));
    let report = directory.droplet("contour.csv", text.as_bytes(), ", scale = 0.002, smooth = 0.002").unwrap();
    assert!(report.points > 4000 && report.was_clockwise && report.repeated >= 1, "{report:?}");
    assert!((report.area / (PI * 1.44) - 1.0).abs() < 1e-4, "{}", report.area / (PI * 1.44));
    assert!((report.perimeter / (TAU * 1.2) - 1.0).abs() < 1e-3 && report.polygon_perimeter > 1.2 * report.perimeter);
    assert!(report.distance <= 0.002 * 1.02, "{}", report.distance);
}

#[test]
fn a_polygon_of_eight_that_was_clicked() {
    let directory = Directory::new("clicked");
    let text = "\"x\";\"y\"\n12,5;3,1\n19,2;4,4\n24,9;9,7\n24,1;17,3\n18,0;21,8\n11,3;20,6\n6,7;14,2\n7,4;7,0\n";
    let smooth = directory.droplet("clicks.csv", text.as_bytes(), ", scale = 0.1").unwrap();
    // The shoelace formula by hand.
    assert!((smooth.polygon_area - 2.5365).abs() < 1e-9, "{}", smooth.polygon_area);
    let grown = smooth.area / smooth.polygon_area - 1.0;
    assert!((0.02..0.15).contains(&grown) && smooth.distance < 0.1 && smooth.distance > 0.03, "{smooth:?}");
    let straight = directory.droplet("clicks.csv", text.as_bytes(), ", scale = 0.1, rounding = 0.1").unwrap();
    let lost = 1.0 - straight.area / straight.polygon_area;
    assert!((0.0..0.002).contains(&lost) && straight.distance < 0.013, "{straight:?}");
}

#[test]
fn a_drawing_with_groups() {
    let directory = Directory::new("drawing");
    let text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg width=\"210mm\" viewBox=\"0 0 210 297\" \
                xmlns=\"http://www.w3.org/2000/svg\" xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\">\
                <g transform=\"translate(10,20)\">\
                <path id=\"cell\" d=\"m 50,0 a 50,30 0 1 1 -100,0 50,30 0 1 1 100,0 z\"/>\
                <path id=\"nucleus\" d=\"M 0,0 C 0,10 10,10 10,0 Z\"/></g></svg>";
    let report = directory.droplet("cell.svg", text.as_bytes(), ", name = \"cell\", scale = 0.02").unwrap();
    assert!((report.area / (PI * 0.6) - 1.0).abs() < 1e-4, "{}", report.area / (PI * 0.6));
    let error = directory.droplet("cell.svg", text.as_bytes(), "").unwrap_err();
    let said = "droplets[0].shape.outline: the file has 2 outlines (\"cell\", \"nucleus\"). Choose one by `name`, or \
                by `index`, counted from 0";
    assert_eq!(error, said);
}

#[test]
fn annotations_in_geojson() {
    let directory = Directory::new("geojson");
    let ring = |x: f64| {
        let mut points = ellipse(60, [x, 70.0], [14.0, 10.0]);
        points.push(points[0]);
        points.iter().map(|[x, y]| format!("[{x},{y}]")).collect::<Vec<_>>().join(",")
    };
    let feature = |name: &str, x: f64| {
        format!(
            "{{\"type\":\"Feature\",\"id\":\"{name}-id\",\"geometry\":{{\"type\":\"Polygon\",\"coordinates\":[[{}]]}},\
             \"properties\":{{\"objectType\":\"annotation\",\"name\":\"{name}\"}}}}",
            ring(x)
        )
    };
    let text =
        format!("{{\"type\":\"FeatureCollection\",\"features\":[{},{}]}}", feature("a", 20.0), feature("b", 90.0));
    let report = directory.droplet("cells.geojson", text.as_bytes(), ", index = 1, scale = 0.1, flip = true").unwrap();
    assert!((report.area / (PI * 1.4) - 1.0).abs() < 1e-5 && (report.points, report.repeated) == (60, 1));
}

#[test]
fn a_region_of_imagej() {
    let directory = Directory::new("roi");
    let points = ellipse(90, [120.5, 80.25], [40.0, 25.0]);
    let mut bytes = b"Iout\0\xe4\x07\0".to_vec();
    bytes.resize(64, 0);
    bytes[16..18].copy_from_slice(&90u16.to_be_bytes());
    bytes[50..52].copy_from_slice(&128u16.to_be_bytes());
    bytes.resize(64 + 4 * 90, 0);
    for axis in 0..2 {
        points.iter().for_each(|point| bytes.extend((point[axis] as f32).to_be_bytes()));
    }
    let report = directory.droplet("0080-0120.roi", &bytes, ", scale = 0.03").unwrap();
    assert!((report.area / (PI * 0.9) - 1.0).abs() < 1e-5, "{}", report.area / (PI * 0.9));
    // y runs downwards, so that a list that looks counter-clockwise is clockwise.
    assert!(report.was_clockwise);
}

#[test]
fn files_that_are_no_outline() {
    let directory = Directory::new("refused");
    let said = |file: &str, bytes: &[u8]| directory.droplet(file, bytes, "").unwrap_err();
    let eight = [[0.0, 0.0], [1.0, 1.0], [2.0, 1.0], [2.0, 0.0], [1.0, 0.9], [0.0, 1.0]];
    let crossed = said("eight.txt", table(&eight, " ").as_bytes());
    assert!(crossed.starts_with("droplets[0]: the outline crosses or touches itself near ("), "{crossed}");
    assert!(crossed.ends_with("For an outline that was traced from a picture, set `smooth` to one or two pixels"));
    let picture = said("cell.png", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR");
    let expected = "droplets[0].shape.outline: the file cannot be read: it is not text. If this is a picture, trace \
                    the shape first and save the outline as CSV, SVG or GeoJSON. Otherwise save the file as UTF-8 text";
    assert_eq!(picture, expected);
}

/// A disc of rings of triangles with radius 1e6 units: points, triangles, and the points of the rim.
fn disc(rings: usize) -> (Vec<[f64; 2]>, Vec<[usize; 3]>, Vec<usize>) {
    let (around, radius) = (24, 1e6);
    let mut points = vec![[0.0; 2]];
    for ring in 1..=rings {
        points.extend(ellipse(around, [0.0; 2], [radius * ring as f64 / rings as f64; 2]));
    }
    let at = |ring: usize, k: usize| if ring == 0 { 0 } else { 1 + (ring - 1) * around + k % around };
    let mut triangles: Vec<[usize; 3]> = (0..around).map(|k| [0, at(1, k), at(1, k + 1)]).collect();
    for ring in 1..rings {
        for k in 0..around {
            triangles.push([at(ring, k), at(ring + 1, k), at(ring + 1, k + 1)]);
            triangles.push([at(ring, k), at(ring + 1, k + 1), at(ring, k + 1)]);
        }
    }
    (points, triangles, (0..=around).map(|k| at(rings, k)).collect())
}

/// The area of a regular polygon in a circle of radius 1.
fn polygon_area(count: f64) -> f64 {
    0.5 * count * (TAU / count).sin()
}

#[test]
fn gmsh_2_of_second_order_with_groups() {
    let directory = Directory::new("gmsh2");
    let (mut points, triangles, rim) = disc(3);
    // Middles of sides, on the circle where both ends are.
    let mut middles = std::collections::HashMap::new();
    let mut middle = |a: usize, b: usize| {
        *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
            let [p, q] = [points[a], points[b]];
            let mut m = [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])];
            let is_rim = |k: usize| rim.contains(&k);
            if is_rim(a) && is_rim(b) {
                let out = 1e6 / m[0].hypot(m[1]);
                m = m.map(|x| x * out);
            }
            points.push(m);
            points.len() - 1
        })
    };
    let cells: Vec<[usize; 6]> =
        triangles.iter().map(|&[a, b, c]| [a, b, c, middle(a, b), middle(b, c), middle(c, a)]).collect();
    let lines: Vec<[usize; 3]> =
        rim.windows(2).take(6).map(|pair| [pair[0], pair[1], middle(pair[0], pair[1])]).collect();
    let mut text =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 1 \"base\"\n2 2 \"core\"\n$EndPhysicalNames\n"
            .to_owned();
    let _ = writeln!(text, "$Nodes\n{}", points.len());
    points.iter().enumerate().for_each(|(k, [x, y])| {
        let _ = writeln!(text, "{} {x} {y} 0", k + 1);
    });
    let _ = writeln!(text, "$EndNodes\n$Elements\n{}", cells.len() + lines.len());
    let list = |nodes: &[usize]| nodes.iter().map(|node| (node + 1).to_string()).collect::<Vec<_>>().join(" ");
    lines.iter().enumerate().for_each(|(k, line)| {
        let _ = writeln!(text, "{} 8 2 1 1 {}", k + 1, list(line));
    });
    for (k, cell) in cells.iter().enumerate() {
        let group = if k < 24 { 2 } else { 3 };
        let _ = writeln!(text, "{} 9 2 {group} 1 {}", k + 7, list(cell));
    }
    text += "$EndElements\n";
    let more = ", factors = [{ group = \"core\", factor = 3.0 }], pinned = [\"base\"] }\nhold = \"pinned\"";
    let (area, points, pinned) = directory.solid("disc.msh", text.as_bytes(), more).unwrap();
    // Its rim has 48 points, 13 of them on the base; each of 120 triangles has become four.
    assert!((area / polygon_area(48.0) - 1.0).abs() < 1e-12 && pinned == 13, "{area} {pinned}");
    // By Euler's formula, 73 corners and 120 triangles have 192 sides.
    assert_eq!(points, 73 + 192);
    let wrong = more.replace("core", "shell");
    let error = directory.solid("disc.msh", text.as_bytes(), &wrong).unwrap_err();
    let said = "solids[0]: the mesh has no group \"shell\": the groups of triangles are: \"core\", \"3\". Use \
                one of these names";
    assert_eq!(error, said);
}

#[test]
fn gmsh_4_in_bytes() {
    let directory = Directory::new("gmsh4");
    let (points, triangles, _) = disc(4);
    let mut bytes = b"$MeshFormat\n4.1 1 8\n\x01\0\0\0\n$EndMeshFormat\n$Nodes\n".to_vec();
    let ints = |bytes: &mut Vec<u8>, list: &[i32]| list.iter().for_each(|k| bytes.extend(k.to_le_bytes()));
    let longs = |bytes: &mut Vec<u8>, list: &[usize]| list.iter().for_each(|k| bytes.extend((*k as u64).to_le_bytes()));
    longs(&mut bytes, &[1, points.len(), 1, points.len()]);
    ints(&mut bytes, &[2, 1, 0]);
    longs(&mut bytes, &[points.len()]);
    (1..=points.len()).for_each(|k| longs(&mut bytes, &[k]));
    points.iter().for_each(|[x, y]| [*x, *y, 0.0].iter().for_each(|x| bytes.extend(x.to_le_bytes())));
    bytes.extend(b"\n$EndNodes\n$Elements\n");
    longs(&mut bytes, &[1, triangles.len(), 1, triangles.len()]);
    ints(&mut bytes, &[2, 1, 2]);
    longs(&mut bytes, &[triangles.len()]);
    for (k, [a, b, c]) in triangles.iter().enumerate() {
        longs(&mut bytes, &[k + 1, a + 1, b + 1, c + 1]);
    }
    bytes.extend(b"\n$EndElements\n");
    let (area, count, pinned) = directory.solid("disc.msh", &bytes, " }\nhold = \"free\"").unwrap();
    assert!((area / polygon_area(24.0) - 1.0).abs() < 1e-12 && (count, pinned) == (97, 0), "{area}");
}

#[test]
fn an_unstructured_grid_of_vtk() {
    let directory = Directory::new("vtu");
    let (points, triangles, _) = disc(4);
    let places = points.iter().map(|[x, y]| format!("{x} {y} 0")).collect::<Vec<_>>().join(" ");
    let corners = triangles.iter().flatten().map(ToString::to_string).collect::<Vec<_>>().join(" ");
    let count = triangles.len();
    let ends = (1..=count).map(|k| (3 * k).to_string()).collect::<Vec<_>>().join(" ");
    let array = |name: &str, kind: &str, values: &str| {
        format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"3\" format=\"ascii\">{values}</DataArray>"
        )
    };
    let text = format!(
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\"><UnstructuredGrid><Piece NumberOfPoints=\"{}\" \
         NumberOfCells=\"{count}\"><Points>{}</Points><Cells>{}{}{}</Cells></Piece></UnstructuredGrid></VTKFile>",
        points.len(),
        array("Points", "Float64", &places),
        array("connectivity", "Int64", &corners),
        array("offsets", "Int64", &ends),
        array("types", "UInt8", &"5 ".repeat(count))
    );
    let (area, count, _) = directory.solid("disc.vtu", text.as_bytes(), " }\nhold = \"free\"").unwrap();
    assert!((area / polygon_area(24.0) - 1.0).abs() < 1e-12 && count == 97, "{area}");
}

#[test]
fn a_mesh_of_quadrilaterals() {
    let directory = Directory::new("quads");
    let text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n\
                $Elements\n1\n1 3 2 0 1 1 2 3 4\n$EndElements\n";
    let error = directory.solid("quads.msh", text.as_bytes(), " }\nhold = \"free\"").unwrap_err();
    let said = "solids[0].outline.mesh: line 13 of the mesh file cannot be used: there are elements that are \
                quadrilaterals, which motile does not compute (do not recombine the mesh). In Gmsh, save triangles of \
                first or second order in the plane of x and y, as version 2.2 or 4.1 (Mesh.MshFileVersion)";
    assert_eq!(error, said);
}
