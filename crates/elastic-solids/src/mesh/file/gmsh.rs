//! Files of Gmsh, versions 2.2 and 4.1, ASCII and binary:
//! <https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format>.

use std::collections::HashMap;

use super::bytes::Cursor;
use super::raw::{Cell, RawMesh};
use crate::SolidError;

const REMEDY: &str = "In Gmsh, save triangles of first or second order in the plane of x and y, as version 2.2 or 4.1 \
                      (Mesh.MshFileVersion)";

/// Groups of the entities of version 4.1, by dimension and number.
type Entities = HashMap<(i64, i64), Vec<i32>>;

/// State of a file that is read.
struct File<'a> {
    at: Cursor<'a>,
    binary: bool,
    mesh: RawMesh,
    /// Indices of points by their numbers in the file.
    numbers: HashMap<i64, usize>,
    entities: Entities,
}

pub(super) fn read(bytes: &[u8]) -> Result<RawMesh, SolidError> {
    let at = Cursor::new(bytes, REMEDY);
    let mut file =
        File { at, binary: false, mesh: RawMesh::default(), numbers: HashMap::new(), entities: Entities::new() };
    let mut version = None;
    while !file.at.at_end() {
        let section = file.at.word()?;
        let Some(name) = section.strip_prefix('$') else {
            return Err(file.at.error(format!("a section such as $Nodes is expected, not {:?}", short(section))));
        };
        match (name, version) {
            ("MeshFormat", _) => version = Some(file.format()?),
            (_, None) => return Err(file.at.error("the file does not start with $MeshFormat")),
            ("PhysicalNames", _) => file.names()?,
            ("Entities", Some(4)) => file.in_bytes(File::entities)?,
            ("Nodes", Some(4)) => file.in_bytes(File::nodes)?,
            ("Elements", Some(4)) => file.in_bytes(File::elements)?,
            ("Nodes", _) => file.old_nodes()?,
            ("Elements", _) => file.old_elements()?,
            ("PartitionedEntities", _) => return Err(file.at.error("meshes in partitions are not read")),
            _ => {
                file.at.skip_past(&format!("$End{name}"))?;
                continue;
            }
        }
        let end = file.at.word()?;
        if end.strip_prefix("$End") != Some(name) {
            let problem = format!("the section ${name} goes on after the number of entries that it states");
            return Err(file.at.error(problem));
        }
    }
    Ok(file.mesh)
}

/// Returns the beginning of a text.
fn short(text: &str) -> String {
    text.chars().take(40).collect()
}

impl File<'_> {
    /// Reads the version: 2 or 4.
    fn format(&mut self) -> Result<u8, SolidError> {
        let version = self.at.word()?;
        let number = match version {
            "2.2" | "2.1" | "2" | "2.0" => 2,
            "4.1" => 4,
            other => return Err(self.at.error(format!("its version is {}", short(other)))),
        };
        self.binary = self.at.parsed::<u8>()? == 1;
        let size: u8 = self.at.parsed()?;
        if size != 8 {
            return Err(self.at.error(format!("its numbers have {size} bytes, not 8")));
        }
        if self.binary {
            self.at.end_line();
            self.at.binary = true;
            let one = self.at.int()?;
            self.at.binary = false;
            self.at.big_endian = match one {
                1 => false,
                0x0100_0000 => true,
                _ => return Err(self.at.error("the bytes of the number 1 are in no known order")),
            };
        }
        Ok(number)
    }

    /// Reads a section whose numbers are bytes in a binary file.
    fn in_bytes(&mut self, read: impl FnOnce(&mut Self) -> Result<(), SolidError>) -> Result<(), SolidError> {
        if self.binary {
            self.at.end_line();
        }
        self.at.binary = self.binary;
        let done = read(self);
        self.at.binary = false;
        done
    }

    fn names(&mut self) -> Result<(), SolidError> {
        let count: i64 = self.at.parsed()?;
        for _ in 0..self.at.count(count)? {
            let [dimension, tag] = [self.at.parsed::<i32>()?, self.at.parsed::<i32>()?];
            let line = self.at.line()?;
            let name = line.split_once('"').and_then(|(_, rest)| rest.rsplit_once('"'));
            let Some((name, _)) = name else {
                return Err(self.at.error("the name of a group is not in quotation marks"));
            };
            if let Ok(dimension) = u8::try_from(dimension) {
                self.mesh.names.insert((dimension, tag), name.to_owned());
            }
        }
        Ok(())
    }

    fn long_count(&mut self) -> Result<usize, SolidError> {
        let found = self.at.long()?;
        self.at.count(found)
    }

    fn entities(&mut self) -> Result<(), SolidError> {
        let counts = [self.long_count()?, self.long_count()?, self.long_count()?, self.long_count()?];
        for (dimension, count) in (0i64..).zip(counts) {
            for _ in 0..count {
                let tag = self.at.int()?;
                for _ in 0..if dimension == 0 { 3 } else { 6 } {
                    self.at.double()?;
                }
                let mut groups = Vec::new();
                for _ in 0..self.long_count()? {
                    // Negative for an entity that is turned round, which makes no difference here.
                    groups.push(i32::try_from(self.at.int()?).unwrap_or(0).saturating_abs());
                }
                if dimension > 0 {
                    for _ in 0..self.long_count()? {
                        self.at.int()?;
                    }
                }
                self.entities.insert((dimension, tag), groups);
            }
        }
        Ok(())
    }

    fn point(&mut self, tag: i64) -> Result<(), SolidError> {
        let place = [self.at.double()?, self.at.double()?, self.at.double()?];
        self.named(tag, place)
    }

    fn named(&mut self, tag: i64, place: [f64; 3]) -> Result<(), SolidError> {
        if self.numbers.insert(tag, self.mesh.points.len()).is_some() {
            return Err(self.at.error(format!("there are two nodes {tag}")));
        }
        self.mesh.points.push(place);
        Ok(())
    }

    fn nodes(&mut self) -> Result<(), SolidError> {
        let blocks = self.long_count()?;
        for _ in 0..3 {
            self.at.long()?;
        }
        for _ in 0..blocks {
            let [dimension, _, parametric] = [self.at.int()?, self.at.int()?, self.at.int()?];
            let count = self.long_count()?;
            let mut tags = Vec::new();
            for _ in 0..count {
                tags.push(self.at.long()?);
            }
            let parameters = if parametric == 0 { 0 } else { dimension.clamp(0, 3) };
            for tag in tags {
                self.point(tag)?;
                for _ in 0..parameters {
                    self.at.double()?;
                }
            }
        }
        Ok(())
    }

    fn elements(&mut self) -> Result<(), SolidError> {
        let blocks = self.long_count()?;
        for _ in 0..3 {
            self.at.long()?;
        }
        for _ in 0..blocks {
            let [dimension, tag, kind] = [self.at.int()?, self.at.int()?, self.at.int()?];
            let count = self.long_count()?;
            let (cell, size) = self.kind(kind)?;
            let groups = self.entities.get(&(dimension, tag)).cloned().unwrap_or_default();
            for _ in 0..count {
                self.at.long()?;
                let mut points = [0; 6];
                for point in &mut points[..size] {
                    let tag = self.at.long()?;
                    *point = self.index(tag)?;
                }
                self.mesh.add(cell, &points[..size], &groups)?;
            }
        }
        Ok(())
    }

    fn index(&self, tag: i64) -> Result<usize, SolidError> {
        let found = self.numbers.get(&tag).copied();
        found.ok_or_else(|| self.at.error(format!("an element names node {tag}, which does not exist")))
    }

    /// Returns the kind and the number of points of a type of elements.
    fn kind(&self, kind: i64) -> Result<(Cell, usize), SolidError> {
        let what = match kind {
            15 => return Ok((Cell::Ignored, 1)),
            1 => return Ok((Cell::Line(1), 2)),
            8 => return Ok((Cell::Line(2), 3)),
            2 => return Ok((Cell::Triangle(1), 3)),
            9 => return Ok((Cell::Triangle(2), 6)),
            3 | 10 | 16 => "quadrilaterals, which motile does not compute (do not recombine the mesh)".to_owned(),
            4..=7 | 11..=14 | 17..=19 => "three-dimensional, but motile computes solids in the plane".to_owned(),
            20 | 21 | 26 => "of an order above 2 (Mesh.ElementOrder)".to_owned(),
            _ => format!("of the type {kind}, which is not read"),
        };
        Err(self.at.error(format!("there are elements that are {what}")))
    }

    fn old_nodes(&mut self) -> Result<(), SolidError> {
        let count: i64 = self.at.parsed()?;
        let count = self.at.count(count)?;
        self.in_bytes(|file| {
            for _ in 0..count {
                let tag = file.at.int()?;
                file.point(tag)?;
            }
            Ok(())
        })
    }

    fn old_elements(&mut self) -> Result<(), SolidError> {
        let count: i64 = self.at.parsed()?;
        let count = self.at.count(count)?;
        self.in_bytes(|file| {
            let mut read = 0;
            while read < count {
                // In binary files, a block has one head.
                let [first, second, third] = [file.at.int()?, file.at.int()?, file.at.int()?];
                let (kind, many, tags) = if file.binary { (first, second, third) } else { (second, 1, third) };
                let (cell, size) = file.kind(kind)?;
                let (many, tags) = (file.at.count(many)?, file.at.count(tags)?);
                if many == 0 {
                    return Err(file.at.error("a block of elements is empty"));
                }
                for _ in 0..many {
                    if file.binary {
                        file.at.int()?;
                    }
                    let mut group = 0;
                    for k in 0..tags {
                        let tag = file.at.int()?;
                        if k == 0 {
                            group = i32::try_from(tag).unwrap_or(0).saturating_abs();
                        }
                    }
                    let mut points = [0; 6];
                    for point in &mut points[..size] {
                        let tag = file.at.int()?;
                        *point = file.index(tag)?;
                    }
                    let groups: &[i32] = if group == 0 { &[] } else { &[group] };
                    file.mesh.add(cell, &points[..size], groups)?;
                    read += 1;
                }
            }
            Ok(())
        })
    }
}
