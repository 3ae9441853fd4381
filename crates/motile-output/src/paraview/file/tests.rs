use super::*;

const CORNERS: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

#[test]
fn arrays_hold_their_size_and_values() {
    // Eight bytes of length (4) and the single-precision 1.0: 00 00 80 3f.
    assert!(array("Float32", "a", 1, &1f32.to_le_bytes()).contains(">BAAAAAAAAAAAAIA/<"));
}

#[test]
fn closed_lines_return_to_their_start() {
    let square = CORNERS.map(Vec2::from).to_vec();
    let lines = [square[..3].to_vec(), Vec::new(), square];
    let document = VtkFile::closed_lines(&lines).cell_scalars("area", [0.5, 0.0, 1.0]).document().unwrap();
    let ends = connectivity(&[0, 1, 2, 0, 3, 4, 5, 6, 3], &[4, 4, 9]);
    assert!(document.contains(&ends) && document.contains("Name=\"area\""), "{document}");
}

#[test]
fn wrong_lengths_names_and_corners_are_refused() {
    let points = CORNERS.map(Vec2::from);
    let raster = Raster::new([0.0; 2], [1.0, 1.0], [2, 3], [true; 2]).unwrap();
    assert!(VtkFile::image(raster).cell_scalars("pressure", [0.0; 6]).document().is_ok());
    assert!(VtkFile::image(raster).cell_scalars("pressure", [0.0; 7]).document().is_err());
    assert!(VtkFile::image(raster).point_scalars("pressure", [0.0; 12]).document().is_ok());
    assert!(VtkFile::closed_lines(&[points.to_vec()]).point_scalars("a\"b", [0.0; 4]).document().is_err());
    assert!(VtkFile::triangles(&points, &[[0, 1, 4]]).document().is_err());
}

#[test]
fn open_lines_do_not_return_to_their_start() {
    let square = [CORNERS.map(Vec2::from).to_vec()];
    let open = [square[0][..3].to_vec(), square[0].clone()];
    let document = VtkFile::lines(&square, &open).document().unwrap();
    let corners = connectivity(&[0, 1, 2, 3, 0, 4, 5, 6, 7, 8, 9, 10], &[5, 8, 12]);
    assert!(document.contains(&corners), "{document}");
}
