//! Files in the XML formats of VTK, which ParaView reads.
//!
//! Written by hand: of the crates for it, the stable release of `vtkio` is years old and its new one a release
//! candidate, and what is needed of the format is small: three kinds of geometry, arrays in base64, and a list of files
//! with their times.

use std::{
    fmt::Write as _,
    fs,
    path::{Path, PathBuf},
};

use anyhow::{Context, Result, ensure};

use super::base64::encode;
use crate::{Raster, Vec2};

/// The points and cells of a file.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Geometry<'a> {
    Image(Raster),
    ClosedLine(&'a [Vec2]),
    Triangles(&'a [Vec2], &'a [[usize; 3]]),
}

/// The values of a named array, one a point or one a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Values<'a> {
    Scalars(&'a [f64]),
    Vectors(&'a [Vec2]),
}

impl Values<'_> {
    fn len(&self) -> usize {
        match self {
            Self::Scalars(values) => values.len(),
            Self::Vectors(values) => values.len(),
        }
    }
}

/// The content of a VTK file: a geometry with named arrays of values at its points and in its cells. Vectors get a
/// zero third component; values are stored in single, positions in double precision.
///
/// ```
/// use motile_output::{Vec2, VtkFile};
///
/// let points = [Vec2::new(0.0, 0.0), Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0)];
/// let file = VtkFile::closed_line(&points).point_scalars("concentration", &[1.0, 2.0, 0.5]);
/// assert!(file.document().unwrap().contains("NumberOfPoints=\"3\""));
/// assert!(VtkFile::closed_line(&points).point_scalars("tension", &[1.0]).document().is_err());
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct VtkFile<'a> {
    geometry: Geometry<'a>,
    point_data: Vec<(String, Values<'a>)>,
    cell_data: Vec<(String, Values<'a>)>,
}

impl<'a> VtkFile<'a> {
    fn new(geometry: Geometry<'a>) -> Self {
        Self { geometry, point_data: Vec::new(), cell_data: Vec::new() }
    }

    /// The cells of a raster (ImageData, `.vti`): samples at its points are cell data.
    #[must_use]
    pub fn image(raster: Raster) -> Self {
        Self::new(Geometry::Image(raster))
    }

    /// A closed polyline (PolyData, `.vtp`), one cell.
    #[must_use]
    pub fn closed_line(points: &'a [Vec2]) -> Self {
        Self::new(Geometry::ClosedLine(points))
    }

    /// Triangles of points (UnstructuredGrid, `.vtu`).
    #[must_use]
    pub fn triangles(points: &'a [Vec2], triangles: &'a [[usize; 3]]) -> Self {
        Self::new(Geometry::Triangles(points, triangles))
    }

    /// Adds a scalar at each point.
    #[must_use]
    pub fn point_scalars(mut self, name: &str, values: &'a [f64]) -> Self {
        self.point_data.push((name.to_string(), Values::Scalars(values)));
        self
    }

    /// Adds a vector at each point.
    #[must_use]
    pub fn point_vectors(mut self, name: &str, values: &'a [Vec2]) -> Self {
        self.point_data.push((name.to_string(), Values::Vectors(values)));
        self
    }

    /// Adds a scalar in each cell.
    #[must_use]
    pub fn cell_scalars(mut self, name: &str, values: &'a [f64]) -> Self {
        self.cell_data.push((name.to_string(), Values::Scalars(values)));
        self
    }

    /// Adds a vector in each cell.
    #[must_use]
    pub fn cell_vectors(mut self, name: &str, values: &'a [Vec2]) -> Self {
        self.cell_data.push((name.to_string(), Values::Vectors(values)));
        self
    }

    /// The ending of names of such files.
    #[must_use]
    pub fn extension(&self) -> &'static str {
        match self.geometry {
            Geometry::Image(_) => "vti",
            Geometry::ClosedLine(_) => "vtp",
            Geometry::Triangles(..) => "vtu",
        }
    }

    /// Numbers of points and of cells.
    fn counts(&self) -> [usize; 2] {
        match self.geometry {
            Geometry::Image(raster) => [(raster.cells()[0] + 1) * (raster.cells()[1] + 1), raster.len()],
            Geometry::ClosedLine(points) => [points.len(), 1],
            Geometry::Triangles(points, triangles) => [points.len(), triangles.len()],
        }
    }

    /// The text of the file.
    ///
    /// # Errors
    /// Arrays of the wrong length, names with other characters than letters, digits, `_`, `-` and space, corners of
    /// triangles that are not points.
    pub fn document(&self) -> Result<String> {
        let [points, cells] = self.counts();
        for (data, count, what) in [(&self.point_data, points, "points"), (&self.cell_data, cells, "cells")] {
            for (name, values) in data {
                let plain = name.chars().all(|c| c.is_alphanumeric() || "_- ".contains(c)) && !name.is_empty();
                ensure!(plain, "an array named {name:?} cannot be written");
                ensure!(values.len() == count, "array {name} has {} values for {count} {what}", values.len());
            }
        }
        let data = attributes("PointData", &self.point_data) + &attributes("CellData", &self.cell_data);
        Ok(match self.geometry {
            Geometry::Image(raster) => {
                let [nx, ny] = raster.cells();
                let [x, y] = raster.origin();
                let (dx, dy) = (raster.size()[0] / nx as f64, raster.size()[1] / ny as f64);
                let extent = format!("0 {nx} 0 {ny} 0 0");
                let attributes = format!("WholeExtent=\"{extent}\" Origin=\"{x} {y} 0\" Spacing=\"{dx} {dy} 1\"");
                wrap("ImageData", &attributes, &format!("Extent=\"{extent}\""), &data)
            }
            Geometry::ClosedLine(line) => {
                let corners: Vec<i64> = (0..points).chain([0]).take(points + points.min(1)).map(|k| k as i64).collect();
                let lines = format!("<Lines>\n{}</Lines>\n", connectivity(&corners, &[corners.len() as i64]));
                let counts = format!(
                    "NumberOfPoints=\"{points}\" NumberOfVerts=\"0\" NumberOfLines=\"1\" NumberOfStrips=\"0\" \
                     NumberOfPolys=\"0\""
                );
                wrap("PolyData", "", &counts, &(data + &positions(line) + &lines))
            }
            Geometry::Triangles(vertices, triangles) => {
                let beyond = triangles.iter().flatten().find(|&&k| k >= points);
                ensure!(beyond.is_none(), "a triangle has corner {beyond:?} of {points} points");
                let corners: Vec<i64> = triangles.iter().flatten().map(|&k| k as i64).collect();
                let ends: Vec<i64> = (1..=cells).map(|k| 3 * k as i64).collect();
                let types = array("UInt8", "types", "", &vec![5; cells]);
                let cell_text = format!("<Cells>\n{}{types}</Cells>\n", connectivity(&corners, &ends));
                let counts = format!("NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\"");
                wrap("UnstructuredGrid", "", &counts, &(data + &positions(vertices) + &cell_text))
            }
        })
    }

    /// Writes the file.
    ///
    /// # Errors
    /// As [`VtkFile::document`], and a file that cannot be written.
    pub fn write(&self, path: &Path) -> Result<()> {
        let document = self.document()?;
        fs::write(path, document).with_context(|| format!("writing {}", path.display()))
    }
}

fn wrap(kind: &str, attributes: &str, piece: &str, content: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"{kind}\" version=\"1.0\" byte_order=\"LittleEndian\" \
         header_type=\"UInt64\">\n<{kind} {attributes}>\n<Piece {piece}>\n{content}</Piece>\n</{kind}>\n</VTKFile>\n"
    )
}

/// A data array with its bytes in base64, preceded by their number.
fn array(kind: &str, name: &str, attributes: &str, bytes: &[u8]) -> String {
    let mut block = (bytes.len() as u64).to_le_bytes().to_vec();
    block.extend_from_slice(bytes);
    format!(
        "<DataArray type=\"{kind}\" Name=\"{name}\" {attributes} format=\"binary\">{}</DataArray>\n",
        encode(&block)
    )
}

fn attributes(tag: &str, data: &[(String, Values<'_>)]) -> String {
    let mut text = format!("<{tag}>\n");
    for (name, values) in data {
        let single = |v: f64| (v as f32).to_le_bytes();
        text += &match values {
            Values::Scalars(values) => {
                let bytes: Vec<u8> = values.iter().flat_map(|&v| single(v)).collect();
                array("Float32", name, "", &bytes)
            }
            Values::Vectors(values) => {
                let bytes: Vec<u8> = values.iter().flat_map(|v| [v.x, v.y, 0.0]).flat_map(single).collect();
                array("Float32", name, "NumberOfComponents=\"3\"", &bytes)
            }
        };
    }
    text + &format!("</{tag}>\n")
}

fn positions(points: &[Vec2]) -> String {
    let bytes: Vec<u8> = points.iter().flat_map(|p| [p.x, p.y, 0.0]).flat_map(f64::to_le_bytes).collect();
    format!("<Points>\n{}</Points>\n", array("Float64", "Points", "NumberOfComponents=\"3\"", &bytes))
}

fn connectivity(corners: &[i64], ends: &[i64]) -> String {
    let integers = |name: &str, values: &[i64]| {
        let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        array("Int64", name, "", &bytes)
    };
    integers("connectivity", corners) + &integers("offsets", ends)
}

/// A series of VTK files with their times: `<name>_0000.vtp`, ... and `<name>.pvd`, the file to open in ParaView.
#[derive(Debug, Clone)]
pub struct VtkSeries {
    directory: PathBuf,
    name: String,
    entries: String,
    count: usize,
}

impl VtkSeries {
    /// An empty series in `directory`, which is made if it is not there.
    ///
    /// # Errors
    /// A directory that cannot be made.
    pub fn new(directory: &Path, name: &str) -> Result<Self> {
        fs::create_dir_all(directory).with_context(|| format!("making {}", directory.display()))?;
        Ok(Self { directory: directory.to_path_buf(), name: name.to_string(), entries: String::new(), count: 0 })
    }

    /// Writes a file and the list with it, so that the series can be opened while a run goes on, or after it broke off.
    ///
    /// # Errors
    /// As [`VtkFile::write`].
    pub fn push(&mut self, time: f64, file: &VtkFile<'_>) -> Result<()> {
        let name = format!("{}_{:04}.{}", self.name, self.count, file.extension());
        file.write(&self.directory.join(&name))?;
        self.count += 1;
        // Writing to a string cannot fail.
        let _ = writeln!(self.entries, "<DataSet timestep=\"{time}\" part=\"0\" file=\"{name}\"/>");
        let list = format!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n\
             <Collection>\n{}</Collection>\n</VTKFile>\n",
            self.entries
        );
        let path = self.directory.join(format!("{}.pvd", self.name));
        fs::write(&path, list).with_context(|| format!("writing {}", path.display()))
    }
}

#[cfg(test)]
mod tests;
