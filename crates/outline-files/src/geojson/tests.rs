//! Geometries, features and what is refused.

use super::*;

const RING: &str = "[[0,0],[2,0],[2,1],[0,1],[0,0]]";

#[test]
fn polygons_of_features_and_collections() {
    let polygon = format!("{{\"type\":\"Polygon\",\"coordinates\":[{RING}]}}");
    let feature =
        |properties: &str| format!("{{\"type\":\"Feature\",\"properties\":{properties},\"geometry\":{polygon}}}");
    let two = format!("[{},{}]", feature("{\"name\":\"cell\"}"), feature("null"));
    for (text, names) in [
        (polygon.clone(), vec![None]),
        (feature("{\"name\":\"cell\"}"), vec![Some("cell")]),
        (two.clone(), vec![Some("cell"), None]),
        (format!("{{\"type\":\"FeatureCollection\",\"features\":{two}}}"), vec![Some("cell"), None]),
        (format!("{{\"type\":\"MultiPolygon\",\"coordinates\":[[{RING}],[{RING}]]}}"), vec![None, None]),
        (format!("{{\"type\":\"GeometryCollection\",\"geometries\":[{polygon}]}}"), vec![None]),
    ] {
        let (found, down) = read(&text).unwrap();
        assert!(!down, "{text}");
        assert_eq!(found.iter().map(|one| one.name.as_deref()).collect::<Vec<_>>(), names, "{text}");
        assert!(found.iter().all(|one| one.closed && one.points.len() == 5 && one.points[2] == Vec2::new(2.0, 1.0)));
    }
    let (line, _) = read(&format!("{{\"type\":\"LineString\",\"coordinates\":{RING}}}")).unwrap();
    assert!(!line[0].closed);
    let (lines, _) = read(&format!("{{\"type\":\"MultiLineString\",\"coordinates\":[{RING},{RING}]}}")).unwrap();
    assert!(lines.len() == 2 && lines.iter().all(|line| !line.closed && line.points.len() == 5));
    let (list, _) = read(RING).unwrap();
    assert!(list.len() == 1 && list[0].points[2] == Vec2::new(2.0, 1.0));
    let nowhere = format!("[{},{{\"type\":\"Feature\",\"geometry\":null,\"properties\":null}}]", feature("null"));
    assert_eq!(read(&nowhere).unwrap().0.len(), 1);
}

/// QuPath writes regions of pictures, in the coordinates of the picture.
#[test]
fn y_runs_downwards_in_features_of_qupath() {
    let of = |feature: &str| {
        let geometry = format!("\"geometry\":{{\"type\":\"Polygon\",\"coordinates\":[{RING}]}}");
        let one = format!("{{\"type\":\"Feature\",{feature},{geometry}}}");
        let all = format!("{{\"type\":\"FeatureCollection\",\"features\":[{one}]}}");
        [one, all].map(|text| read(&text).unwrap().1)
    };
    assert_eq!(of("\"id\":\"7b\",\"properties\":{\"objectType\":\"annotation\",\"name\":\"cell\"}"), [true; 2]);
    assert_eq!(of("\"id\":\"PathDetectionObject\",\"properties\":{\"isLocked\":false}"), [true; 2]);
    assert_eq!(of("\"id\":\"PathOfMine\",\"properties\":{\"name\":\"cell\"}"), [false; 2]);
}

#[test]
fn what_is_no_outline_is_refused() {
    let nested = format!("{}{}", "[".repeat(40), "]".repeat(40));
    for (text, said) in [
        ("{\"type\":\"Point\",\"coordinates\":[1,2]}", "the type \"Point\" is not an outline"),
        ("{\"type\":\"Polygon\",\"coordinates\":[[[0,0],[1,0],[0,1]],[[0,0],[1,0],[0,1]]]}", "a polygon has 1 holes"),
        ("{\"version\":\"5\",\"shapes\":[]}", "are not GeoJSON. Use GeoJSON with geometries"),
        ("[[0,0],[1,0],[0]]", "position 2 of a geometry cannot be read: it is not [x, y]"),
        ("{\"type\":\"Polygon\"}", "no list of coordinates"),
        ("{\"type\":\"Polygon\",\"coordinates\":[[[0,\"a\"]]]}", "position 0 of a geometry cannot be read"),
        ("{\"type\":", "line 1 cannot be read: "),
        (&nested, "nested too deeply"),
    ] {
        let error = read(text).unwrap_err().to_string();
        assert!(error.contains(said), "{text}: {error}");
    }
}
