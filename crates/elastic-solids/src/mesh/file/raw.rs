//! Cells of a file before they are a mesh.

use std::collections::{BTreeMap, HashMap};

use crate::SolidError;

/// Most points or cells of a file.
pub(super) const MOST: usize = 4_000_000;

/// Points, triangles and lines of a file.
#[derive(Debug, Default)]
pub(super) struct RawMesh {
    /// Coordinates of the points (unit of the file).
    pub(super) points: Vec<[f64; 3]>,
    /// Triangles by their three points in increasing order. A triangle of several groups is several times in files of
    /// Gmsh 2.2.
    pub(super) triangles: HashMap<[usize; 3], Found>,
    /// Lines by their ends, with the number of a group.
    pub(super) lines: Vec<([usize; 2], i32)>,
    /// Names of groups by dimension and number.
    pub(super) names: BTreeMap<(u8, i32), String>,
    /// Order of the triangles, once there is one.
    pub(super) order: Option<u8>,
}

/// A triangle of a file.
#[derive(Debug)]
pub(super) struct Found {
    /// Place in the file.
    pub(super) place: usize,
    /// True if the order of its points is turned around.
    pub(super) turned: bool,
    /// Numbers of its groups.
    pub(super) groups: Vec<i32>,
}

/// Kinds of cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Cell {
    /// A point or a cell that is left out.
    Ignored,
    /// Two ends and, for the second order, the middle.
    Line(u8),
    /// Three corners and, for the second order, the middles of the first, second and third side.
    Triangle(u8),
}

impl RawMesh {
    /// Adds a cell of that kind by its points, in the groups of these numbers.
    pub(super) fn add(&mut self, cell: Cell, points: &[usize], groups: &[i32]) -> Result<(), SolidError> {
        match (cell, points) {
            (Cell::Ignored, _) => {}
            (Cell::Line(_), [first, second]) => self.line([*first, *second], groups),
            (Cell::Line(_), [first, second, middle]) => {
                self.line([*first, *middle], groups);
                self.line([*middle, *second], groups);
            }
            (Cell::Triangle(order), points) => {
                if *self.order.get_or_insert(order) != order {
                    let problem = "it has triangles of first and of second order, which do not fit together";
                    return Err(SolidError::mesh_file("the mesh file", problem, "Save all elements with one order"));
                }
                match points {
                    [a, b, c] => self.triangle([*a, *b, *c], groups),
                    [a, b, c, ab, bc, ca] => {
                        for corners in [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]] {
                            self.triangle(corners.map(|point| *point), groups);
                        }
                    }
                    _ => {
                        return Err(SolidError::mesh_file(
                            "the mesh file",
                            "a triangle has too few points",
                            "Save it again",
                        ));
                    }
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn line(&mut self, ends: [usize; 2], groups: &[i32]) {
        self.lines.extend(groups.iter().map(|group| (ends, *group)));
    }

    fn triangle(&mut self, corners: [usize; 3], groups: &[i32]) {
        let mut sorted = corners;
        sorted.sort_unstable();
        // Corners that are in increasing order once they are turned by one or two places keep their direction.
        let turned = (0..3).all(|k| [corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]] != sorted);
        let place = self.triangles.len();
        let entry = self.triangles.entry(sorted).or_insert_with(|| Found { place, turned, groups: Vec::new() });
        for group in groups {
            if !entry.groups.contains(group) {
                entry.groups.push(*group);
            }
        }
    }
}
