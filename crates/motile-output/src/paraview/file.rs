//! Files in the XML formats of VTK, which ParaView reads.
//!
//! Written here and not by a crate: the stable release of `vtkio` is years old, and the part of the format in use is
//! small. It consists of three kinds of geometry, arrays in base64, and a list of files with their times.

use std::{
    fmt::Write as _,
    fs,
    path::{Path, PathBuf},
};

use crate::{OutputError, Raster, drawing::svg::base64};
use motile::base::Vec2;

/// Named array of values, one for each point or each cell, as they are stored.
#[derive(Debug, Clone, PartialEq)]
struct Array {
    name: String,
    vectors: bool,
    values: Vec<f32>,
}

impl Array {
    fn scalars(name: &str, values: impl IntoIterator<Item = f64>) -> Self {
        Self { name: name.to_string(), vectors: false, values: values.into_iter().map(|v| v as f32).collect() }
    }

    fn vectors(name: &str, values: impl IntoIterator<Item = Vec2>) -> Self {
        Self { vectors: true, ..Self::scalars(name, values.into_iter().flat_map(|v| [v.x, v.y, 0.0])) }
    }
}

/// Content of a VTK file: a geometry with named arrays of values at its points and in its cells. Vectors of the plane
/// get a zero third component; values are stored in single, positions in double precision.
///
/// ```
/// use motile::base::Vec2;
/// use motile_output::VtkFile;
///
/// let line = vec![Vec2::new(0.0, 0.0), Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0)];
/// let file = VtkFile::closed_lines(&[line.clone()]).point_scalars("concentration", [1.0, 2.0, 0.5]);
/// assert!(file.document()?.contains("NumberOfPoints=\"3\""));
/// assert!(VtkFile::closed_lines(&[line]).point_scalars("tension", [1.0]).document().is_err());
/// # Ok::<(), motile_output::OutputError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[doc(alias("VTK", "ParaView"))]
pub struct VtkFile {
    kind: &'static str,
    extension: &'static str,
    attributes: String,
    /// Attributes of the only piece.
    piece: String,
    /// Points and cells.
    geometry: String,
    /// Numbers of points and cells, and least number of points for the corners of the cells.
    points: usize,
    cells: usize,
    needed: usize,
    point_data: Vec<Array>,
    cell_data: Vec<Array>,
    origin: String,
}

impl VtkFile {
    fn new(kind: &'static str, extension: &'static str, points: usize, cells: usize) -> Self {
        let (attributes, piece, geometry) = Default::default();
        let (point_data, cell_data, origin) = Default::default();
        let needed = points;
        Self { kind, extension, attributes, piece, geometry, points, cells, needed, point_data, cell_data, origin }
    }

    /// Creates cells of a raster (ImageData, `.vti`): samples at the points of the raster are cell data.
    #[must_use]
    pub fn image(raster: Raster) -> Self {
        let ([nx, ny], [x, y], [width, height]) = (raster.cells, raster.origin, raster.size);
        let (dx, dy, extent) = (width / nx as f64, height / ny as f64, format!("0 {nx} 0 {ny} 0 0"));
        let attributes = format!(" WholeExtent=\"{extent}\" Origin=\"{x} {y} 0\" Spacing=\"{dx} {dy} 1\"");
        let piece = format!("Extent=\"{extent}\"");
        Self { attributes, piece, ..Self::new("ImageData", "vti", (nx + 1) * (ny + 1), nx * ny) }
    }

    /// Creates closed lines through points (PolyData, `.vtp`; length), each one cell; values at points are given line
    /// after line.
    #[must_use]
    pub fn closed_lines(lines: &[Vec<Vec2>]) -> Self {
        Self::lines(lines, &[])
    }

    /// Creates closed lines as in [`VtkFile::closed_lines`], then open ones.
    #[must_use]
    pub fn lines(closed: &[Vec<Vec2>], open: &[Vec<Vec2>]) -> Self {
        let (mut corners, mut ends, mut first): (Vec<i64>, Vec<i64>, i64) = Default::default();
        let lines = || closed.iter().chain(open);
        for (number, line) in lines().enumerate() {
            let next = first + line.len() as i64;
            corners.extend((first..next).chain((first < next && number < closed.len()).then_some(first)));
            ends.push(corners.len() as i64);
            first = next;
        }
        let (points, cells) = (first as usize, closed.len() + open.len());
        let piece = format!(
            "NumberOfPoints=\"{points}\" NumberOfVerts=\"0\" NumberOfLines=\"{cells}\" NumberOfStrips=\"0\" \
             NumberOfPolys=\"0\""
        );
        let cell_text = connectivity(&corners, &ends);
        let geometry = format!("{}<Lines>\n{cell_text}</Lines>\n", positions(lines().flatten()));
        Self { piece, geometry, ..Self::new("PolyData", "vtp", points, cells) }
    }

    /// Creates points (PolyData, `.vtp`; length), each one cell.
    #[must_use]
    pub fn points(points: &[Vec2]) -> Self {
        let count = points.len();
        let piece = format!(
            "NumberOfPoints=\"{count}\" NumberOfVerts=\"{count}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" \
             NumberOfPolys=\"0\""
        );
        let numbers: Vec<i64> = (0..count as i64).collect();
        let ends: Vec<i64> = numbers.iter().map(|number| number + 1).collect();
        let geometry = format!("{}<Verts>\n{}</Verts>\n", positions(points), connectivity(&numbers, &ends));
        Self { piece, geometry, ..Self::new("PolyData", "vtp", count, count) }
    }

    /// Creates surfaces of revolution about the x axis (PolyData, `.vtp`; length) in three dimensions, in so many
    /// sectors: of triangles at both ends of each meridian, which are on the axis, and of quadrilaterals between.
    /// Values at points are given once at an end and for every sector between.
    #[must_use]
    pub fn surfaces(meridians: &[Vec<Vec2>], sectors: usize) -> Self {
        let (mut points, mut corners, mut ends): (Vec<[f64; 3]>, Vec<i64>, Vec<i64>) = Default::default();
        for meridian in meridians {
            let first = points.len();
            let ring = |k: usize, sector: usize| match k {
                0 => first,
                _ if k + 1 == meridian.len() => first + 1 + (k - 1) * sectors,
                _ => first + 1 + (k - 1) * sectors + sector % sectors,
            };
            for (k, at) in meridian.iter().enumerate() {
                let pole = k == 0 || k + 1 == meridian.len();
                for sector in 0..if pole { 1 } else { sectors } {
                    let (sin, cos) = (std::f64::consts::TAU * sector as f64 / sectors as f64).sin_cos();
                    points.push([at.x, at.y * cos, at.y * sin]);
                }
            }
            for k in 1..meridian.len() {
                for sector in 0..sectors {
                    let quad = [ring(k - 1, sector), ring(k, sector), ring(k, sector + 1), ring(k - 1, sector + 1)];
                    let start = corners.len();
                    for corner in quad.map(|corner| corner as i64) {
                        if !corners[start..].contains(&corner) {
                            corners.push(corner);
                        }
                    }
                    ends.push(corners.len() as i64);
                }
            }
        }
        let (count, cells) = (points.len(), ends.len());
        let piece = format!(
            "NumberOfPoints=\"{count}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" \
             NumberOfPolys=\"{cells}\""
        );
        let cell_text = connectivity(&corners, &ends);
        let geometry = format!("{}<Polys>\n{cell_text}</Polys>\n", positions_in_space(points));
        Self { piece, geometry, ..Self::new("PolyData", "vtp", count, cells) }
    }

    /// Creates triangles (UnstructuredGrid, `.vtu`) of points (length), by the numbers of their corners.
    #[must_use]
    pub fn triangles(points: &[Vec2], triangles: &[[usize; 3]]) -> Self {
        Self::of_triangles(points.len(), &positions(points), triangles)
    }

    /// Creates triangles (UnstructuredGrid, `.vtu`) of points in three dimensions (length), by the numbers of their
    /// corners.
    #[must_use]
    pub fn triangles_in_space(points: &[[f64; 3]], triangles: &[[usize; 3]]) -> Self {
        Self::of_triangles(points.len(), &positions_in_space(points.iter().copied()), triangles)
    }

    fn of_triangles(points: usize, positions: &str, triangles: &[[usize; 3]]) -> Self {
        let cells = triangles.len();
        let corners: Vec<i64> = triangles.iter().flatten().map(|&k| k as i64).collect();
        let ends: Vec<i64> = (1..=cells).map(|k| 3 * k as i64).collect();
        let cell_text = connectivity(&corners, &ends) + &array("UInt8", "types", 1, &vec![5; cells]);
        Self {
            piece: format!("NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\""),
            geometry: format!("{positions}<Cells>\n{cell_text}</Cells>\n"),
            needed: triangles.iter().flatten().max().map_or(0, |last| last + 1),
            ..Self::new("UnstructuredGrid", "vtu", points, cells)
        }
    }

    /// Adds a scalar at each point.
    #[must_use]
    pub fn point_scalars(mut self, name: &str, values: impl IntoIterator<Item = f64>) -> Self {
        self.point_data.push(Array::scalars(name, values));
        self
    }

    /// Adds a vector at each point.
    #[must_use]
    pub fn point_vectors(mut self, name: &str, values: impl IntoIterator<Item = Vec2>) -> Self {
        self.point_data.push(Array::vectors(name, values));
        self
    }

    /// Adds a vector with three components at each point.
    #[must_use]
    pub fn point_vectors_in_space(mut self, name: &str, values: impl IntoIterator<Item = [f64; 3]>) -> Self {
        self.point_data.push(Array { vectors: true, ..Array::scalars(name, values.into_iter().flatten()) });
        self
    }

    /// Adds a scalar in each cell.
    #[must_use]
    pub fn cell_scalars(mut self, name: &str, values: impl IntoIterator<Item = f64>) -> Self {
        self.cell_data.push(Array::scalars(name, values));
        self
    }

    /// Adds a vector in each cell.
    #[must_use]
    pub fn cell_vectors(mut self, name: &str, values: impl IntoIterator<Item = Vec2>) -> Self {
        self.cell_data.push(Array::vectors(name, values));
        self
    }

    /// Sets the origin of the results ([`motile::scene::System::origin`]), which the file holds as a comment.
    #[must_use]
    pub fn of_origin(mut self, origin: &str) -> Self {
        // Two hyphens end a comment of XML.
        self.origin = origin.replace("--", "- -");
        self
    }

    /// Returns the text of the file.
    ///
    /// # Errors
    /// Returns [`OutputError::Count`] for arrays of the wrong length, corners of triangles that are not points.
    /// [`OutputError::Name`] for names with other characters than letters, digits, `_`, `-` and space.
    pub fn document(&self) -> Result<String, OutputError> {
        let Self { kind, attributes, piece, geometry, points, cells, origin, .. } = self;
        if self.needed > *points {
            OutputError::check_count("points of triangles", *points, self.needed)?;
        }
        let point_data = data("PointData", &self.point_data, *points)?;
        let cell_data = data("CellData", &self.cell_data, *cells)?;
        let origin = if origin.is_empty() { String::new() } else { format!("<!-- {origin} -->\n") };
        Ok(format!(
            "<?xml version=\"1.0\"?>\n{origin}<VTKFile type=\"{kind}\" version=\"1.0\" byte_order=\"LittleEndian\" \
             header_type=\"UInt64\">\n<{kind}{attributes}>\n\
             <Piece {piece}>\n{point_data}{cell_data}{geometry}</Piece>\n\
             </{kind}>\n</VTKFile>\n"
        ))
    }

    /// Writes the file.
    ///
    /// # Errors
    /// Returns the errors of [`VtkFile::document`], and [`OutputError::Write`].
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), OutputError> {
        fs::write(path.as_ref(), self.document()?).map_err(OutputError::writing(path.as_ref()))
    }
}

/// Returns the element of a data array, with its bytes in base64 after their number.
fn array(kind: &str, name: &str, components: usize, bytes: &[u8]) -> String {
    let block = [&(bytes.len() as u64).to_le_bytes(), bytes].concat();
    format!(
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"binary\">{}\
         </DataArray>\n",
        base64(&block)
    )
}

fn data(tag: &str, arrays: &[Array], count: usize) -> Result<String, OutputError> {
    let mut text = format!("<{tag}>\n");
    for Array { name, vectors, values } in arrays {
        if name.is_empty() || !name.chars().all(|c| c.is_alphanumeric() || "_- ".contains(c)) {
            return Err(OutputError::Name { name: name.clone(), what: "an array" });
        }
        let components = if *vectors { 3 } else { 1 };
        OutputError::check_count(&format!("values of array {name}"), values.len() / components, count)?;
        let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        text += &array("Float32", name, components, &bytes);
    }
    Ok(text + &format!("</{tag}>\n"))
}

/// Returns the values at the points of [`VtkFile::surfaces`] of values on a meridian.
pub(crate) fn revolved(values: &[f64], sectors: usize) -> impl Iterator<Item = f64> {
    let pole = |k: usize| k == 0 || k + 1 == values.len();
    values.iter().enumerate().flat_map(move |(k, value)| std::iter::repeat_n(*value, if pole(k) { 1 } else { sectors }))
}

fn positions<'a>(points: impl IntoIterator<Item = &'a Vec2>) -> String {
    positions_in_space(points.into_iter().map(|p| [p.x, p.y, 0.0]))
}

fn positions_in_space(points: impl IntoIterator<Item = [f64; 3]>) -> String {
    let bytes: Vec<u8> = points.into_iter().flatten().flat_map(f64::to_le_bytes).collect();
    format!("<Points>\n{}</Points>\n", array("Float64", "Points", 3, &bytes))
}

fn connectivity(corners: &[i64], ends: &[i64]) -> String {
    let bytes = |values: &[i64]| values.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<u8>>();
    array("Int64", "connectivity", 1, &bytes(corners)) + &array("Int64", "offsets", 1, &bytes(ends))
}

/// Series of VTK files with their times: `<name>_0000.vtp`, ... and `<name>.pvd`, the file to open in ParaView.
#[derive(Debug, Clone)]
pub struct VtkSeries {
    directory: PathBuf,
    name: String,
    times: Vec<f64>,
}

impl VtkSeries {
    /// Creates empty series in `directory`, which is created if needed.
    ///
    /// # Errors
    /// Returns [`OutputError::Write`] for a directory that cannot be created.
    pub fn create(directory: impl AsRef<Path>, name: &str) -> Result<Self, OutputError> {
        let directory = directory.as_ref().to_path_buf();
        fs::create_dir_all(&directory).map_err(OutputError::writing(&directory))?;
        Ok(Self { directory, name: name.to_string(), times: Vec::new() })
    }

    /// Continues the numbers after files that were written at these times; those that still exist are listed.
    pub(crate) fn after(&mut self, times: &[f64]) {
        self.times = times.to_vec();
    }

    /// Writes the next file, at a time, and rewrites the list: the series can be opened during a run and after it broke
    /// off. A file of the last time again replaces that file, so that runs one after the other list each time once.
    ///
    /// # Errors
    /// Returns the errors of [`VtkFile::write`].
    pub fn push(&mut self, time: f64, file: &VtkFile) -> Result<(), OutputError> {
        let name = |number: usize| format!("{}_{number:04}.{}", self.name, file.extension);
        if self.times.last() == Some(&time) {
            self.times.pop();
        }
        file.write(self.directory.join(name(self.times.len())))?;
        self.times.push(time);
        let mut entries = String::new();
        for (number, time) in self.times.iter().enumerate() {
            if !self.directory.join(name(number)).exists() {
                continue;
            }
            // Writing to a string cannot fail.
            let _ = writeln!(entries, "<DataSet timestep=\"{time}\" part=\"0\" file=\"{}\"/>", name(number));
        }
        let list = format!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n\
             <Collection>\n{entries}</Collection>\n</VTKFile>\n"
        );
        let path = self.directory.join(format!("{}.pvd", self.name));
        fs::write(&path, list).map_err(OutputError::writing(&path))
    }
}

#[cfg(test)]
mod tests;
