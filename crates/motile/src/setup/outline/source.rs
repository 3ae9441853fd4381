//! Points of outlines from their files.

use std::path::Path;

use outline_files::{Choice, FileFormat, OutlineError, OutlineFile};

use super::{OutlineSetup, Source};
use crate::SetupError;
use crate::setup::{DropletShape, FibreShape, InterfaceShape, Setup, SolidOutline};

impl OutlineSetup {
    /// Returns the points that are given or in the file, whose path is relative to the directory of the
    /// program.
    pub(super) fn source(&self) -> Result<Source, OutlineError> {
        match &self.file {
            Some(file) => self.read(Path::new(file)),
            None => Ok(Source { points: self.points.clone(), closed: None, y_runs_down: false }),
        }
    }

    fn read(&self, path: &Path) -> Result<Source, OutlineError> {
        let file = OutlineFile::read(path)?;
        let choice = match (&self.name, self.index) {
            (Some(name), _) => Choice::Name(name.clone()),
            (None, Some(index)) => Choice::Index(index),
            (None, None) => Choice::Only,
        };
        let contour = file.choose(&choice)?;
        let points = contour.points.iter().map(|point| [point.x, point.y]).collect();
        // A table does not say whether its points are closed.
        let closed = (file.format != FileFormat::Csv).then_some(contour.closed);
        Ok(Source { points, closed, y_runs_down: file.y_runs_down() })
    }

    /// Replaces the file, whose path is relative to that directory, by its points.
    fn embed(&mut self, directory: &Path, line: bool) -> Result<(), OutlineError> {
        let Some(file) = &self.file else { return Ok(()) };
        let source = self.read(&directory.join(file))?;
        source.check(line)?;
        if source.y_runs_down {
            self.flip.get_or_insert(true);
        }
        (self.file, self.name, self.index, self.points) = (None, None, None, source.points);
        Ok(())
    }
}

/// Outline of a shape, if it is given by one.
fn of_shape(shape: &mut DropletShape) -> Option<&mut OutlineSetup> {
    if let DropletShape::Outline(outline) = shape { Some(outline) } else { None }
}

/// Outline of a solid or wall, if it is given by one, and true for a line.
fn of_solid(outline: &mut SolidOutline) -> Option<(&'static str, &mut OutlineSetup, bool)> {
    match outline {
        SolidOutline::Closed(outline) => Some(("outline.closed", outline, false)),
        SolidOutline::WallBelowLine(outline) => Some(("outline.wall-below-line", outline, true)),
        SolidOutline::WallAboveLine(outline) => Some(("outline.wall-above-line", outline, true)),
        _ => None,
    }
}

impl Setup {
    /// Returns the description with the contents of its files in their place, so that it no longer depends on them.
    /// Paths are relative to a directory, for a scene file the one that it is in. Scene files that are read by
    /// [`Setup::from_toml`] have this done for the directory of the program.
    ///
    /// # Errors
    /// Returns [`SetupError::Outline`] or [`SetupError::Solid`], with the key, for a file that cannot be read, or whose
    /// contents cannot be used.
    pub fn with_files(mut self, directory: &Path) -> Result<Self, SetupError> {
        let keyed = |key: String| move |error: OutlineError| SetupError::from(error).of(&key);
        let shapes =
            self.droplets.iter_mut().enumerate().map(|(k, body)| (format!("droplets[{k}].shape"), &mut body.shape));
        let many = self.suspension.iter_mut().enumerate();
        let shapes =
            shapes.chain(many.map(|(k, many)| (format!("suspension[{k}].droplet.shape"), &mut many.droplet.shape)));
        let rigid = self.rigid_bodies.iter_mut().enumerate();
        let shapes = shapes.chain(rigid.map(|(k, body)| (format!("rigid-bodies[{k}].shape"), &mut body.shape)));
        let shells = self.shells.iter_mut().enumerate().flat_map(|(k, shell)| {
            let rest = shell.rest.iter_mut().map(move |rest| (format!("shells[{k}].rest"), rest));
            std::iter::once((format!("shells[{k}].shape"), &mut shell.shape)).chain(rest)
        });
        for (key, shape) in shapes.chain(shells) {
            if let Some(outline) = of_shape(shape) {
                outline.embed(directory, false).map_err(keyed(format!("{key}.outline")))?;
            }
        }
        let solids = self.solids.iter_mut().enumerate().map(|(k, solid)| (format!("solids[{k}]"), &mut solid.outline));
        let walls = self.walls.iter_mut().enumerate().map(|(k, wall)| (format!("walls[{k}]"), &mut wall.outline));
        for (at, outline) in solids.chain(walls) {
            if let SolidOutline::Mesh(mesh) = outline {
                mesh.embed(directory).map_err(|error| error.of(&format!("{at}.outline.mesh")))?;
            }
            if let Some((key, outline, line)) = of_solid(outline) {
                outline.embed(directory, line).map_err(keyed(format!("{at}.{key}")))?;
            }
        }
        for (k, interface) in self.interfaces.iter_mut().enumerate() {
            if let InterfaceShape::Line(outline) = &mut interface.shape {
                outline.embed(directory, true).map_err(keyed(format!("interfaces[{k}].shape.line")))?;
            }
        }
        for fibre in &mut self.fibres {
            if let FibreShape::Files(name) = &mut fibre.shape {
                *name = directory.join(&*name).to_string_lossy().into_owned();
            }
        }
        Ok(self)
    }
}
