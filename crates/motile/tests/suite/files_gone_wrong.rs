//! Files of outlines and meshes that are damaged, ambiguous or of another kind: each is read right, or refused with a
//! remedy.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;

use motile::prelude::*;

/// Reads a scene whose first line of a body names a file of these bytes, and returns the area of its outline, if any.
fn read(name: &str, bytes: &[u8], scene: &str) -> Result<Option<f64>, String> {
    let directory = std::env::temp_dir().join(format!("motile-wrong-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&directory).expect("a directory");
    std::fs::write(directory.join("body.dat"), bytes).expect("a file");
    let path = directory.join("scene.toml");
    std::fs::write(&path, scene).expect("a scene");
    let setup = Setup::from_file(&path).map_err(|error| error.to_string());
    std::fs::remove_dir_all(directory).expect("removed");
    let reports = setup?.outlines().map_err(|error| error.to_string())?;
    Ok(reports.first().map(|report| report.area))
}

fn outline(name: &str, text: &str, more: &str) -> Result<f64, String> {
    let scene = format!(
        "region = \"plane\"\n[[droplets]]\nparticles = \"none\"\nshape.outline = {{ file = \"body.dat\"{more} }}\n"
    );
    read(name, text.as_bytes(), &scene).map(|area| area.expect("an outline"))
}

fn table(points: impl IntoIterator<Item = [f64; 2]>) -> String {
    points.into_iter().fold(String::new(), |mut text, [x, y]| {
        let _ = writeln!(text, "{x},{y}");
        text
    })
}

fn circle(count: usize) -> Vec<[f64; 2]> {
    (0..count).map(|k| TAU * k as f64 / count as f64).map(|t| [t.cos(), t.sin()]).collect()
}

#[test]
fn outlines() {
    // Far from the origin, in nanometres, and with a point that was clicked twice.
    let far = circle(60).into_iter().map(|[x, y]| [x + 5e5, y + 5.6e6]);
    let small = circle(60).into_iter().map(|[x, y]| [1e-9 * x, 1e-9 * y]);
    let mut twice = circle(60);
    twice.insert(11, [twice[10][0] + 1e-5, twice[10][1] - 1e-5]);
    for (text, more, error) in [
        (table(far), "", 1e-5),
        (table(small), ", scale = 1e9", 1e-5),
        (table(twice), "", 2e-4),
        // So many points that a curve through them takes a second.
        (table(circle(30_000)), "", 1e-8),
    ] {
        let area = outline("read", &text, more).unwrap();
        assert!((area / PI - 1.0).abs() < error, "{more}: {area}");
    }
    let scattered = circle(60).into_iter().enumerate().map(|(k, _)| circle(60)[(k * 23) % 60]);
    let eight = circle(60).into_iter().map(|[x, y]| [x, x * y]);
    for (text, said) in [
        (table(scattered), "the outline crosses or touches itself near"),
        (table(eight), "the outline encloses no area"),
        (table([[f64::NAN; 2]; 4]), "is not a finite number"),
        ("0,0\n10,0\n10,1e-7\n0,1e-7\n".to_owned(), "the curve encloses no area"),
        ("12,5,3,1\n19,2,4,4\n24,9,9,7\n".to_owned(), "may be decimal marks or separate columns"),
        ("24,1;17,3\n18,0\n".to_owned(), "\"18,0\" has no column 2"),
        ("[".repeat(100_000), "recursion limit exceeded"),
        ("1,2\n".repeat(1_000_001), "it has more than 1000000 points. Use fewer points"),
        (format!("<svg>{}{}</svg>", "<g>".repeat(20_000), "</g>".repeat(20_000)), "it has no path, polygon"),
    ] {
        let error = outline("refused", &text, "").unwrap_err();
        assert!(error.contains(said) && error.contains(". "), "{error}");
    }
    let nested = read("folder", b"", "[[droplets]]\nshape.outline = { file = \".\" }\n").unwrap_err();
    assert!(nested.contains("this is not a file"), "{nested}");
}

#[test]
fn meshes() {
    let mesh = |bytes: &[u8]| {
        let scene = "region.box.lengths = [6.0, 6.0]\nmethod.grid = { spacing = 0.1, corrected = false }\n[[solids]]\n\
                     material.neo-hookean = { shear = 50.0, bulk = 100.0 }\noutline.mesh = { file = \"body.dat\" }\n\
                     hold = \"free\"\n";
        read("mesh", bytes, scene)
    };
    let head = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n";
    let points = "POINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0\n";
    // Cells of lines between triangles, and line ends of another system.
    let mixed = format!("{head}{points}CELLS 3 11\n2 0 1 3 0 1 2 3 0 2 3\nCELL_TYPES 3\n3 5 5\n");
    for text in [mixed.clone(), mixed.replace('\n', "\r\n")] {
        assert_eq!(mesh(text.as_bytes()), Ok(None));
    }
    let binary = b"$MeshFormat\n4.1 1 8\n\x01\0\0\0\n$EndMeshFormat\n$Nodes\n\xff\xff\xff\xff\xff\xff\xff\xff";
    let quads = format!("{head}{points}CELLS 2 9\n3 0 1 2 4 0 1 2 3\nCELL_TYPES 2\n5 9\n");
    for (bytes, said) in [
        (mixed.replace("3 0 2 3", "3 0 2 -1").as_bytes(), "-1 is not the number of a point"),
        (mixed.replace("1 1 0", "nan 1 0").as_bytes(), "point 2 is not finite"),
        (quads.as_bytes(), "it has quadrilaterals, which motile does not compute"),
        (&mixed.as_bytes()[..mixed.len() - 40], "11 numbers are announced, but the file ends before"),
        (binary, "there cannot be -1 of these"),
        (b"$MeshFormat\n4 0 8\n$EndMeshFormat\n", "its version is 4"),
        (b"solid cell\nfacet normal 0 0 1\n", "its format is not known. Use Gmsh"),
        (&[0; 10_000], "its format is not known"),
        (b"", "its format is not known"),
    ] {
        let error = mesh(bytes).unwrap_err();
        assert!(error.contains(said), "{error}");
    }
}
