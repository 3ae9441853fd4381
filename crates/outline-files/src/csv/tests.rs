//! Tables as programs write them, and tables gone wrong.

use super::*;

const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [2.5, 0.0], [2.5, 1.0], [0.0, 1.0]];

/// Tables as other programs export them.
#[test]
fn tables_of_other_programs() {
    for text in [
        // Excel, with a line for its own use, and lines of separators at the end.
        "sep=;\r\nx;y\r\n0;0\r\n2,5;0\r\n2,5;1\r\n0;1\r\n;\r\n;\r\n",
        "x,y,\n0,0,\n2.5,0,\n2.5,1,\n0,1,\n,,\n",
        // Decimal commas in quotation marks between semicolons or tabs.
        "\"x\";\"y\"\n\"0\";\"0\"\n\"2,5\";\"0\"\n\"2,5\";\"1,0\"\n\"0\";\"1\"\n",
        // pandas with tabs: the column of the index has no name.
        "\tx\ty\n0\t0\t0\n1\t2.5\t0\n2\t2.5\t1\n3\t0\t1\n",
        // R: the names of rows have no name.
        "\"x\" \"y\"\n\"1\" 0 0\n\"2\" 2.5 0\n\"3\" 2.5 1\n\"4\" 0 1\n",
        // Old line ends, and twice as many as needed.
        "x,y\r0,0\r2.5,0\r2.5,1\r0,1\r",
        "0,0\n\n2.5,0\n\n2.5,1\n\n0,1\n\n",
        "0,0\r\r\n2.5,0\r\r\n2.5,1\r\r\n0,1\r\r\n",
        // Vertices with comments behind them.
        "4  # number of vertices\n0 0 # position of vertex 0\n2.5 0\n2.5 1  # corner\n0 1\n",
        // Names in a comment, as numpy.savetxt writes them, and names with the axis behind.
        "# frame,y,x\n7,0,0\n7,0,2.5\n7,1,2.5\n7,1,0\n",
        "label,POSITION_X,POSITION_Y\nID1,0,0\nID2,2.5,0\nID3,2.5,1\nID4,0,1\n",
        "row,col\n0,0\n0,2.5\n1,2.5\n1,0\n",
        "index,shape-type,vertex-index,axis-0,axis-1\n0,polygon,0,0,0\n0,polygon,1,0,2.5\n0,polygon,2,1,2.5\n\
         0,polygon,3,1,0\n",
        "\t0\t0\n\t2.5\t0\n\t2.5\t1\n\t0\t1\n",
        "x,y,z\n0,0,3\n2.5,0,3\n2.5,1,3\n0,1,3\n",
    ] {
        assert_eq!(points(text), SQUARE, "{text}");
    }
}

/// Rows of a picture run downwards, latitudes upwards.
#[test]
fn rows_run_downwards() {
    for (names, expected) in [("row,col", true), ("axis-0,axis-1", true), ("lat,lon", false), ("y,x", false)] {
        let (_, downwards) = read(&format!("{names}\n0,0\n0,2.5\n1,2.5\n1,0\n")).unwrap();
        assert_eq!(downwards, expected, "{names}");
    }
}

/// A table of all cells of a picture: one outline for each, also if their lines alternate.
#[test]
fn columns_tell_outlines_apart() {
    let one = "cell,x,y\n3,0,0\n3,2.5,0\n3,2.5,1\n3,0,1\n5,7,7\n5,8,7\n5,8,8\n";
    let mixed = "frame\tx\ty\n3\t0\t0\n5\t7\t7\n3\t2.5\t0\n5\t8\t7\n3\t2.5\t1\n5\t8\t8\n3\t0\t1\n";
    let both = "frame,label,x,y\n1,3,0,0\n1,3,2.5,0\n1,3,2.5,1\n1,3,0,1\n1,5,7,7\n1,5,8,7\n1,5,8,8\n";
    for text in [one, mixed, both] {
        let (found, _) = read(text).unwrap();
        let names: Vec<_> = found.iter().map(|one| one.name.as_deref()).collect();
        assert_eq!(names, [Some("3"), Some("5")], "{text}");
        assert_eq!(found[0].points, SQUARE.map(|[x, y]| Vec2::new(x, y)), "{text}");
        assert_eq!(found[1].points[2], Vec2::new(8.0, 8.0), "{text}");
    }
}

/// Tables that can be read in two ways would be distorted without a word.
#[test]
fn tables_that_may_mean_something_else_are_refused() {
    for (text, said) in [
        // Decimal commas between commas.
        ("12,5,3,1\n19,2,4,4\n24,9,9,7\n", "the commas in \"12,5,3,1\" may be decimal marks or separate columns"),
        ("x,y\n12,5,3,1\n19,2,4,4\n24,9,9,7\n", "\"12,5,3,1\" has 4 entries, but 2 columns have names"),
        ("x,y\n12,5,3\n19,2,4\n24,9,9\n", "\"12,5,3\" has 3 entries, but 2 columns have names"),
        ("\"12,5\",\"3,1\"\n\"19,2\",\"4,4\"\n", "\"12,5\" is not a number (its comma may be a decimal mark or"),
        ("x,y\n\"1,234\",5\n", "\"1,234\" is not a number (its comma"),
        ("12,5 3,1\n19,2 4,4\n", "\"5 3\" is not a number"),
        ("1.234,5;2\n", "\"1.234,5\" is not a number"),
        // A line that ends too early.
        ("24,1;17,3\n18,0\n", "line 2 cannot be read: \"18,0\" has no column 2"),
        ("1,2\n3,4,5\n", "line 2 cannot be read: there are 3 entries, but 2 in the line"),
        // Columns of something else.
        ("frame,area,cx\n1,2,3\n", "none of the columns frame, area, cx is x or y. Name the two columns"),
        ("x1,y1,x2,y2\n1,2,3,4\n", "none of the columns x1, y1, x2, y2 is x or y"),
        ("x,y,x,y\n1,2,3,4\n", "more or less than one of the columns x, y, x, y is x, or y"),
        ("x,z\n1,2\n", "more or less than one of the columns x, z is x, or y"),
        ("outline of my first cell\n1,2\n", "none of the columns outline, of, my, first, cell is x or y"),
        ("x,y,z\n0,0,0\n1,0,0.5\n0,1,1\n", "line 3 cannot be read: z is 0.5 in \"1,0,0.5\" and 0 at first"),
    ] {
        let error = read(text).map(|found| format!("{found:?}")).unwrap_err().to_string();
        assert!(error.contains(said), "{text}: {error}");
    }
}

fn points(text: &str) -> Vec<[f64; 2]> {
    let (contours, _) = read(text).unwrap();
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
    let (found, _) = read("x y\n0 0\n1 0\n0 1\n\n\n5 5\n6 5\n5 6\n").unwrap();
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
        ("theta,r\n0,1\n1,1.2\n2,1.1\n", "the columns theta, r are polar coordinates. Give x = r cos(theta)"),
        ("angle_deg;radius (um)\n0;1\n90;1.2\n180;1.1\n", "the columns angle_deg, radius (um) are polar coordinates"),
    ] {
        let error = read(text).unwrap_err().to_string();
        assert!(error.contains(said), "{text}: {error}");
    }
}
