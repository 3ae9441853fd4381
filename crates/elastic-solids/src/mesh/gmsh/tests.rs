//! A file from hand, round trips, and files gone wrong.

use crate::error::{numbers, refused as is_refused};
use motile_base::{InputError, Refusal};
use proptest::prelude::*;

use super::*;
use crate::mesh::equilateral_strip;
use crate::{Interior, Outline};

/// A square of two triangles as Gmsh writes it: with curves, parameters, two surfaces, and a section that is none of
/// ours.
const SQUARE: &str = "$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
1 7 \"outer rim\"
2 3 \"soft \"part\"\"
$EndPhysicalNames
$Entities
1 1 2 0
1 0 0 0 0
5 0 0 0 1 1 0 1 7 2 1 -1
1 0 0 0 1 1 0 2 3 4 1 5
2 0 0 0 1 1 0 0 0
$EndEntities
$Nodes
3 5 10 90
0 1 0 1
10
0 0 0
1 5 1 2
20
30
1 0 0 0.5
1 1 0 0.75
2 1 0 2
40
90
0 1 0
9 9 0
$EndNodes
$Elements
3 4 1 9
1 5 1 2
1 10 20
2 20 30
2 2 2 1
8 10 30 40
2 1 2 1
4 10 20 30
$EndElements
$Periodic
0
$EndPeriodic
";

#[test]
fn a_file_as_gmsh_writes_it() {
    let file = GmshMesh::from_text(SQUARE).unwrap();
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(Vec2::from);
    assert_eq!(file.mesh.points(), corners);
    // Ordered by the numbers 4 and 8; the unused point 90 is left out.
    assert_eq!(file.mesh.triangles(), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(
        file.groups,
        [
            PhysicalGroup { tag: 3, name: Some("soft \"part\"".to_owned()), triangles: vec![0] },
            PhysicalGroup { tag: 4, name: None, triangles: vec![0] },
        ]
    );
}

fn with_groups(mesh: TriangleMesh) -> GmshMesh {
    let count = mesh.triangles().len();
    let groups = vec![
        PhysicalGroup { tag: 2, name: Some("lower half".to_owned()), triangles: (0..count / 2).collect() },
        PhysicalGroup { tag: 5, name: None, triangles: (count / 3..count - 1).collect() },
    ];
    GmshMesh { mesh, groups }
}

#[test]
fn a_byte_order_mark_is_passed_over() {
    assert_eq!(GmshMesh::from_text(&format!("\u{feff}{SQUARE}")), GmshMesh::from_text(SQUARE));
    assert!(GmshMesh::from_text(&format!("\n\u{feff}{SQUARE}")).is_err());
}

/// Two triangles that look like a square and do not hang together.
#[test]
fn nodes_that_were_not_merged_are_refused() {
    let text = |x: f64| {
        let nodes = format!("1\n2\n3\n4\n5\n6\n0 0 0\n1 0 0\n1 1 0\n{x} 0 0\n1 1 0\n0 1 0\n");
        let triangles = "1 2 1 2\n2 1 2 2\n1 1 2 3\n2 4 5 6\n";
        format!(
            "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 6 1 6\n2 1 0 6\n{nodes}$EndNodes\n$Elements\n\
             {triangles}$EndElements\n"
        )
    };
    let error = |x| GmshMesh::from_text(&text(x)).unwrap_err();
    assert!(is_refused(&error(0.0), "points 0 and 3 coincide at (0.0000, 0.0000)"));
    assert!(is_refused(&error(5e-4), "points 0 and 3 coincide at (5e-4, 0.0000)"));
    assert!(is_refused(&error(2e-3), "points 2 and 4 coincide at (1.0000, 1.0000)"));
    assert!(error(0.0).to_string().ends_with("duplicate nodes)"));
}

#[test]
fn what_is_written_is_read_again() {
    let file = with_groups(Outline::circle(Vec2::new(0.1, 1e-7), 1.0).unwrap().mesh(0.2).unwrap());
    let back = GmshMesh::from_text(&file.to_text().unwrap()).unwrap();
    assert_eq!(back, file);
}

#[test]
fn periodic_meshes_are_joined_again() {
    let flat = Outline::flat(-1.0, 2.0, -1.0).unwrap();
    let wave = Outline::profile(-1.0, 2.0, |x| 0.1 * (std::f64::consts::PI * x).sin()).unwrap();
    let meshed = Interior::new([flat, wave]).unwrap().mesh(0.1).unwrap();
    for mesh in [equilateral_strip(Vec2::new(0.3, 0.0), 9, 4, 0.2).unwrap(), meshed] {
        let period = mesh.period().unwrap();
        let file = with_groups(mesh);
        let text = file.to_text().unwrap();
        let open = GmshMesh::from_text(&text).unwrap();
        assert!(open.mesh.points().len() > file.mesh.points().len());
        assert!((open.mesh.area() - file.mesh.area()).abs() < 1e-12);
        let back = GmshMesh::from_periodic_text(&text, period).unwrap();
        assert_eq!(back.mesh.boundary_loops().len(), 2);
        assert_eq!(back.mesh.edges().len(), file.mesh.edges().len());
        assert_eq!(back, file);
    }
}

#[test]
fn errors_name_the_line() {
    let changed = |from: &str, to: &str| GmshMesh::from_text(&SQUARE.replacen(from, to, 1)).unwrap_err();
    let at = |from: &str, to: &str| {
        let error = changed(from, to);
        assert!(is_refused(&error, "of the mesh file cannot be used: "), "{error}");
        let line = numbers(&error)[0] as usize;
        let SolidError::Refused(Refusal { value, .. }) = error else { panic!("{error}") };
        (line, value)
    };
    assert_eq!(at("4.1 0 8", "2.2 0 8").0, 2);
    assert!(at("4.1 0 8", "4.1 1 8").1.contains("binary"));
    assert_eq!(at("1 1 0 0.75", "1 1").0, 25);
    assert_eq!(at("1 1 0 0.75", "1 1 0.5 0.75").0, 25);
    assert_eq!(at("1 1 0 0.75", "1 NaN 0 0.75").0, 25);
    assert!(at("1 1 0 0.75", "1 1e 0 0.75").1.contains("1e"));
    assert_eq!(at("8 10 30 40", "8 10 30 41"), (38, "triangle 8 names node 41, which does not exist".to_owned()));
    assert!(at("2 2 2 1", "2 2 3 1").1.contains("type 3"));
    assert!(at("\n40\n90\n", "\n40\n40\n").1.contains("two nodes 40"));
    assert!(at("$EndElements", "$EndNodes").1.contains("$EndElements"));
    assert!(at("$EndPeriodic", "").1.contains("does not end"));
    assert!(at("$Nodes\n3 5 10 90", "$Nodes\n9999999999999 5 10 90").1.contains("too early"));
    assert!(at("\"soft \"part\"\"", "soft").1.contains("quotation"));
    assert!(is_refused(&GmshMesh::from_text("").unwrap_err(), "of the mesh file cannot be used"));
    assert!(is_refused(&changed("0 1 0\n9 9", "0.5 0.5 0\n9 9"), "triangle 1 near ("));
    let none = SQUARE
        .replace("8 10 30 40", "")
        .replace("4 10 20 30", "")
        .replace("2 2 2 1", "2 2 2 0")
        .replace("2 1 2 1", "2 1 2 0");
    assert!(matches!(GmshMesh::from_text(&none), Err(SolidError::Input(InputError::TooFew { .. }))));
    assert!(matches!(
        GmshMesh::from_periodic_text(SQUARE, -1.0),
        Err(SolidError::Input(InputError::NotPositive { .. }))
    ));
}

#[test]
fn bad_groups_are_not_written() {
    let refused = |tag: i32, name: &str, triangles: Vec<usize>| {
        let mesh = crate::mesh::equilateral_block(Vec2::ZERO, 2, 2, 1.0).unwrap();
        let good = PhysicalGroup { tag: 1, name: None, triangles: vec![0] };
        let bad = PhysicalGroup { tag, name: Some(name.to_owned()), triangles };
        GmshMesh { mesh, groups: vec![good, bad] }.to_text().unwrap_err()
    };
    for error in
        [refused(0, "a", vec![]), refused(1, "a", vec![]), refused(2, "a\"b", vec![]), refused(2, "a", vec![99])]
    {
        assert!(is_refused(&error, "of triangles cannot be written"), "{error}");
    }
}

/// A small change to a file.
#[derive(Debug, Clone)]
enum Mutation {
    DropLine(usize),
    RepeatLine(usize),
    ChangeWord(usize, String),
    Truncate(usize),
    ChangeByte(usize, u8),
}

fn mutations() -> impl Strategy<Value = Vec<Mutation>> {
    let words = prop_oneof![
        Just("-1".to_owned()),
        Just("0".to_owned()),
        Just("18446744073709551616".to_owned()),
        Just("1e308".to_owned()),
        Just("-inf".to_owned()),
        Just("$Nodes".to_owned()),
        Just("\u{00e4}\"".to_owned()),
        any::<f64>().prop_map(|x| x.to_string()),
        (0..100_u64).prop_map(|n| n.to_string()),
    ];
    let place = any::<usize>();
    let mutation = prop_oneof![
        place.prop_map(Mutation::DropLine),
        place.prop_map(Mutation::RepeatLine),
        (place, words).prop_map(|(k, word)| Mutation::ChangeWord(k, word)),
        place.prop_map(Mutation::Truncate),
        (place, 32..127_u8).prop_map(|(k, byte)| Mutation::ChangeByte(k, byte)),
    ];
    prop::collection::vec(mutation, 1..4)
}

fn mutate(text: &str, mutation: &Mutation) -> String {
    let lines: Vec<&str> = text.lines().collect();
    if lines.is_empty() {
        return String::new();
    }
    let join = |lines: Vec<&str>| lines.join("\n");
    match mutation {
        Mutation::DropLine(k) => {
            let mut lines = lines;
            lines.remove(k % lines.len());
            join(lines)
        }
        Mutation::RepeatLine(k) => {
            let mut lines = lines;
            lines.insert(k % lines.len(), lines[k % lines.len()]);
            join(lines)
        }
        Mutation::ChangeWord(k, word) => {
            let words: Vec<&str> = text.split(' ').collect();
            let k = k % words.len();
            let mut words = words;
            words[k] = word;
            words.join(" ")
        }
        Mutation::Truncate(k) => text.chars().take(k % text.chars().count().max(1)).collect(),
        Mutation::ChangeByte(k, byte) => {
            let k = k % text.chars().count().max(1);
            text.chars().enumerate().map(|(i, c)| if i == k { *byte as char } else { c }).collect()
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn no_input_makes_it_panic(changes in mutations(), periodic in any::<bool>()) {
        let text = changes.iter().fold(SQUARE.to_owned(), |text, change| mutate(&text, change));
        let read = if periodic { GmshMesh::from_periodic_text(&text, 4.0) } else { GmshMesh::from_text(&text) };
        // What is accepted is a mesh that can be written and read again.
        if let Ok(file) = read {
            prop_assert!(file.mesh.area() > 0.0);
            prop_assert!(file.to_text().is_ok() || file.groups.iter().any(|g| g.tag == 0 || g.name.is_some()));
        }
    }

    #[test]
    fn nor_does_any_text(text in "(\\$[A-Z][a-z]{3,8}|[0-9]{1,3}| |\n|-|\"|\\.|e){0,200}") {
        let _ = GmshMesh::from_text(&format!("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n{text}"));
        let _ = GmshMesh::from_text(&text);
    }
}

/// A plane mesh may be at any height.
#[test]
fn meshes_below_the_plane_are_read() {
    let places = [
        ("\n10\n0 0 0\n", "\n10\n0 0 -7.25\n"),
        ("\n1 0 0 0.5\n1 1 0 0.75\n", "\n1 0 -7.25 0.5\n1 1 -7.25 0.75\n"),
        ("\n0 1 0\n9 9 0\n", "\n0 1 -7.25\n9 9 -7.25\n"),
    ];
    let text = places.iter().fold(SQUARE.to_owned(), |text, (from, to)| text.replacen(from, to, 1));
    assert_eq!(text.matches("-7.25").count(), 5, "{text}");
    assert_eq!(GmshMesh::from_text(&text), GmshMesh::from_text(SQUARE));
}

/// A square of a nanometre in metres is as flat as one of a metre, and no flatter.
#[test]
fn meshes_of_any_size_are_flat() {
    let scaled = |size: f64, z: f64| {
        let text = SQUARE.replacen("\n10\n0 0 0\n", &format!("\n10\n0 0 {z:e}\n"), 1);
        let text =
            text.replacen("\n1 0 0 0.5\n1 1 0 0.75\n", &format!("\n{size:e} 0 0 0.5\n{size:e} {size:e} 0 0.75\n"), 1);
        GmshMesh::from_text(&text.replacen("\n0 1 0\n9 9 0\n", &format!("\n0 {size:e} 0\n0 0 0\n"), 1))
    };
    for size in [1.0, 1e-9, 1e6] {
        assert!(scaled(size, 1e-12 * size).is_ok(), "{size}: {:?}", scaled(size, 1e-12 * size).err());
        let error = scaled(size, 1e-3 * size).unwrap_err().to_string();
        assert!(error.contains("has z = "), "{error}");
    }
}
