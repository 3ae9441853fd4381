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
        SolidOutline::Closed(outline) => Some(("closed", outline, false)),
        SolidOutline::WallBelowLine(outline) => Some(("wall-below-line", outline, true)),
        SolidOutline::WallAboveLine(outline) => Some(("wall-above-line", outline, true)),
        _ => None,
    }
}

impl Setup {
    /// Returns the description with the paths of its files as seen from the directory of the program, where they were
    /// relative to `directory`. Absolute paths stay. In contrast to [`Setup::with_files`], the files are not read, so
    /// that you can still change which outline of a file is used.
    #[must_use]
    pub fn with_paths_from(mut self, directory: &Path) -> Self {
        let seen = |file: &mut String| *file = directory.join(&*file).to_string_lossy().into_owned();
        self.shapes_mut().filter_map(|(_, shape)| of_shape(shape)?.file.as_mut()).for_each(seen);
        for (_, outline) in self.outlines_of_solids_mut() {
            let file = match outline {
                SolidOutline::Mesh(mesh) => mesh.file.as_mut(),
                outline => of_solid(outline).and_then(|(_, outline, _)| outline.file.as_mut()),
            };
            file.map(seen);
        }
        for (_, shape) in self.lines_mut() {
            if let InterfaceShape::Line(outline) = shape {
                outline.file.as_mut().map(seen);
            }
        }
        for fibre in &mut self.fibres {
            if let FibreShape::Files(name) = &mut fibre.shape {
                seen(name);
            }
        }
        self
    }

    /// Returns the description with the contents of its files in their place, so that it no longer depends on them.
    /// Paths are relative to a directory, for a scene file the one that it is in. Scene files that are read by
    /// `Setup::from_toml` have this done for the directory of the program.
    ///
    /// # Errors
    /// Returns [`SetupError::Outline`] or [`SetupError::Solid`], with the key, for a file that cannot be read, or whose
    /// contents cannot be used.
    pub fn with_files(mut self, directory: &Path) -> Result<Self, SetupError> {
        let keyed = |key: String| move |error: OutlineError| SetupError::from(error).of(&key);
        for (key, shape) in self.shapes_mut() {
            if let Some(outline) = of_shape(shape) {
                outline.embed(directory, false).map_err(keyed(format!("{key}.outline")))?;
            }
        }
        for (at, outline) in self.outlines_of_solids_mut() {
            if let SolidOutline::Mesh(mesh) = outline {
                mesh.embed(directory).map_err(|error| error.of(&format!("{at}.mesh")))?;
            }
            if let Some((key, outline, line)) = of_solid(outline) {
                outline.embed(directory, line).map_err(keyed(format!("{at}.{key}")))?;
            }
        }
        for (key, shape) in self.lines_mut() {
            if let InterfaceShape::Line(outline) = shape {
                outline.embed(directory, true).map_err(keyed(format!("{key}.line")))?;
            }
        }
        for (k, fibre) in self.fibres.iter_mut().enumerate() {
            fibre.shape.embed(directory).map_err(|error| error.of(&format!("fibres[{k}].shape.files")))?;
        }
        Ok(self)
    }
}
