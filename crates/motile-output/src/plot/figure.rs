//! Figures of several plots, as files.

use std::{fs, path::Path};

use crate::OutputError;
use crate::drawing::Drawing;
use crate::plot::{contents::Plot, paint::draw};

/// Figure of one or more plots, in rows and columns.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Figure {
    columns: usize,
    panels: Vec<Plot>,
    panel_size: [f64; 2],
    origin: String,
}

impl Figure {
    /// Creates a figure without plots so far, in rows of `columns` plots.
    #[must_use]
    pub fn new(columns: usize) -> Self {
        Self { columns: columns.max(1), panels: Vec::new(), panel_size: [540.0, 340.0], origin: String::new() }
    }

    /// Adds a plot.
    #[must_use]
    pub fn panel(mut self, plot: Plot) -> Self {
        self.panels.push(plot);
        self
    }

    /// Sets width and height of each panel (pixels of the SVG), 540 x 340 by default.
    #[must_use]
    pub fn panel_size(mut self, width: f64, height: f64) -> Self {
        self.panel_size = [width, height];
        self
    }

    /// Sets the origin of the results that the figure shows ([`motile::scene::System::origin`]): its files carry this
    /// text.
    #[must_use]
    pub fn of_origin(self, origin: impl Into<String>) -> Self {
        Self { origin: origin.into(), ..self }
    }

    fn draw(&self) -> Result<Drawing, OutputError> {
        Ok(Drawing { origin: self.origin.clone(), ..draw(&self.panels, self.columns, self.panel_size)? })
    }

    /// Returns the text of an SVG file of the figure.
    ///
    /// # Errors
    /// Returns [`OutputError::Empty`] without panels, [`OutputError::Size`] with panels too small or too large.
    pub fn svg(&self) -> Result<String, OutputError> {
        Ok(self.draw()?.svg())
    }

    /// Writes the figure as `<name>.svg` and, at twice the resolution, `<name>.png` into `directory`, which is created
    /// if needed.
    ///
    /// # Errors
    /// Returns the errors of [`Figure::svg`], and [`OutputError::Write`].
    pub fn write(&self, directory: impl AsRef<Path>, name: &str) -> Result<(), OutputError> {
        let directory = directory.as_ref();
        fs::create_dir_all(directory).map_err(OutputError::writing(directory))?;
        let drawing = self.draw()?;
        ["svg", "png"].iter().try_for_each(|kind| drawing.write(&directory.join(format!("{name}.{kind}")), 2.0))
    }
}
