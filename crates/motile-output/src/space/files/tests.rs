use motile::prelude::*;

use super::*;

/// The file of two droplets, read by another reader of XML: points, triangles and fields.
#[test]
fn surfaces_are_read_back() {
    let droplet = |x: f64| DropletSetup { position: Some([x, 0.5, 0.25]), ..DropletSetup::contractile(-1.0, 2.0) };
    let method = Method::Harmonics(HarmonicsMethod { degree: 5 });
    let setup =
        Setup { region: Region::Space, method, droplets: vec![droplet(-2.0), droplet(2.0)], ..Setup::default() };
    let Built { mut scene, space: Some(body), .. } = setup.build().unwrap() else { panic!("no droplets in space") };
    let folder = std::env::temp_dir().join(format!("motile-space-files-{}", std::process::id()));
    let mut files = SpaceParaView::create(&folder, body).unwrap();
    scene.run(0.1).observe(Every::Time(0.1), &mut files).go().unwrap();
    let list = std::fs::read_to_string(folder.join("surface.pvd")).unwrap();
    assert!(list.contains("timestep=\"0.1\" part=\"0\" file=\"surface_0001.vtu\""), "{list}");
    let text = std::fs::read_to_string(folder.join("surface_0001.vtu")).unwrap();
    let document = roxmltree::Document::parse(&text).unwrap();
    let of = |tag: &str| document.descendants().find(|node| node.has_tag_name(tag)).unwrap();
    let piece = of("Piece");
    let number = |name: &str| piece.attribute(name).unwrap().parse::<usize>().unwrap();
    let (points, triangles) = (2 * (11 * 22 + 2), 2 * 2 * 11 * 22);
    assert_eq!((number("NumberOfPoints"), number("NumberOfCells")), (points, triangles));
    // Arrays in base64: eight bytes with their length, then the values.
    let bytes = |parent: &str, name: &str| {
        let array = of(parent).children().find(|node| node.attribute("Name") == Some(name)).unwrap();
        decoded(array.text().unwrap().trim())[8..].to_vec()
    };
    let reals = |bytes: Vec<u8>| -> Vec<f64> {
        bytes.chunks_exact(8).map(|chunk| f64::from_le_bytes(chunk.try_into().unwrap())).collect()
    };
    let places = reals(bytes("Points", "Points"));
    assert_eq!(places.len(), 3 * points);
    let middle: f64 = places.chunks_exact(3).map(|place| place[1]).sum::<f64>() / points as f64;
    assert!((middle - 0.5).abs() < 0.01, "{middle}");
    assert_eq!(bytes("PointData", "concentration").len(), 4 * points);
    assert_eq!(bytes("PointData", "velocity").len(), 3 * 4 * points);
    assert_eq!(bytes("CellData", "droplet").len(), 4 * triangles);
    let corners = bytes("Cells", "connectivity");
    let last = corners.chunks_exact(8).map(|chunk| i64::from_le_bytes(chunk.try_into().unwrap())).max();
    assert_eq!((corners.len(), last), (8 * 3 * triangles, Some(points as i64 - 1)));
    std::fs::remove_dir_all(&folder).unwrap();
}

/// Bytes of a text in base64 (RFC 4648).
fn decoded(text: &str) -> Vec<u8> {
    const DIGITS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let digits = text.bytes().filter(|byte| *byte != b'=').map(|byte| DIGITS.iter().position(|d| *d == byte).unwrap());
    let (mut bits, mut count, mut bytes) = (0_u32, 0, Vec::new());
    for digit in digits {
        (bits, count) = ((bits << 6) | digit as u32, count + 6);
        if count >= 8 {
            count -= 8;
            bytes.push((bits >> count) as u8);
        }
    }
    bytes
}
