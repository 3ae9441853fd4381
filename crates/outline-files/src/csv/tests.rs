//! Tables as programs write them, and tables gone wrong.

use super::*;

const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [2.5, 0.0], [2.5, 1.0], [0.0, 1.0]];

fn points(text: &str) -> Vec<[f64; 2]> {
    let contours = read(text).unwrap();
    assert_eq!(contours.len(), 1, "{text}");
    contours[0].points.iter().map(|point| [point.x, point.y]).collect()
}

#[test]
fn separators_headers_and_comments() {
    for text in [
        "0,0\n2.5,0\n2.5,1\n0,1\n",
        "x,y\r\n0,0\r\n2.5,0\r\n2.5,1\r\n0,1",
        "\"X\";\"Y\"\n0;0\n2,5;0\n2,5;1,0\n0;1\n",
        "# traced by hand\n0\t0\n2.5\t0\n2.5\t1\n0\t1\n\n",
        "  0 0\n 2.5   0\n2.5 1\n 0 1\n",
        // With the number of the points, as in vertex files of IBAMR.
        "4\n0.0 0.0\n2.5e0 0\n2.50 1.0\n0 1\n",
        // The results table of ImageJ: numbers, and columns in another order.
        " ,Y,Area,X\n1,0,7,0\n2,0,7,2.5\n3,1,7,2.5\n4,1,7,0\n",
        "id,y_um,x_um\n1,0,0\n2,0,2.5\n3,1,2.5\n4,1,0\n",
        "% comment\n// comment\n0,0,9\n2.5,0,9\n2.5,1,9\n0,1,9\n",
    ] {
        assert_eq!(points(text), SQUARE, "{text}");
    }
}

#[test]
fn blank_lines_separate_outlines() {
    let found = read("x y\n0 0\n1 0\n0 1\n\n\n5 5\n6 5\n5 6\n").unwrap();
    assert_eq!(found.len(), 2);
    assert_eq!(found[1].points[0], Vec2::new(5.0, 5.0));
}

#[test]
fn what_is_wrong_is_told_with_its_line() {
    for (text, said) in [
        ("0,0\n1,0\n1,b\n", "line 3 cannot be read: \"b\" is not a number"),
        ("0 0\n1\n", "line 2 cannot be read: \"1\" has no column 2"),
        ("5\n0 0\n1 0\n0 1\n", "line 1 cannot be read: it says that there are 5 points, but 3 follow"),
        ("0,0,0\n1,3,0\n2,3,3\n3,0,3\n", "its first column counts the points"),
        ("# nothing\n", "it has no points"),
    ] {
        let error = read(text).unwrap_err().to_string();
        assert!(error.contains(said), "{text}: {error}");
    }
}
