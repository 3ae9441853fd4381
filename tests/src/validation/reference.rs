//! Reference values, embedded from `reference/`.

use crate::validation::StudyError;

/// A file of reference values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReferenceFile {
    /// Velocities on fixed shapes, equal viscosities.
    FixedShapes,
    /// Velocities on fixed shapes, viscosity inside ten times that outside.
    FixedShapesRatio10,
    /// Force moments of fixed shapes, viscosity inside ten times that outside.
    MomentsRatio10,
    /// Relaxation of an ellipse.
    EllipseRelaxation,
    /// Steady swimmers in a box.
    SteadySwimmers,
    /// A steady swimmer in a box, viscosity inside ten times that outside.
    SteadySwimmerContrast,
    /// A swimmer's transient in a box.
    Transient,
    /// Point forces in a channel.
    ChannelPointForces,
    /// Velocities on fixed shapes in a channel.
    ChannelFixedShapes,
    /// Flux, pressure gradient and wall shear of fixed shapes in a channel.
    ChannelGlobal,
    /// Steady swimmers in channels.
    ChannelSwimmers,
    /// Growth of a small lateral offset of swimmers in channels.
    ChannelStability,
    /// Velocities on fixed shapes between curved walls.
    CurvedWalls,
    /// Flux and forces on curved walls of fixed shapes between them.
    CurvedWallsGlobal,
    /// Drops, capsules and rigid ellipses in imposed flows.
    ImposedFlows,
}

impl ReferenceFile {
    fn text(self) -> &'static str {
        match self {
            Self::FixedShapes => include_str!("../../reference/fixed_shape_velocities_equal_viscosity.csv"),
            Self::FixedShapesRatio10 => include_str!("../../reference/fixed_shape_velocities_ratio_10.csv"),
            Self::MomentsRatio10 => include_str!("../../reference/fixed_shape_moments_ratio_10.csv"),
            Self::SteadySwimmerContrast => include_str!("../../reference/steady_swimmer_contrast_box6.csv"),
            Self::EllipseRelaxation => include_str!("../../reference/ellipse_relaxation_box6.csv"),
            Self::SteadySwimmers => include_str!("../../reference/steady_swimmer_box6.csv"),
            Self::Transient => include_str!("../../reference/swimmer_transient_box6_activity_1.csv"),
            Self::ChannelPointForces => include_str!("../../reference/channel_greens_function.csv"),
            Self::ChannelFixedShapes => include_str!("../../reference/channel_fixed_shape_velocities.csv"),
            Self::ChannelGlobal => include_str!("../../reference/channel_fixed_shape_global.csv"),
            Self::ChannelSwimmers => include_str!("../../reference/channel_steady_swimmer.csv"),
            Self::ChannelStability => include_str!("../../reference/channel_lateral_stability.csv"),
            Self::CurvedWalls => include_str!("../../reference/curved_walls_velocities.csv"),
            Self::ImposedFlows => include_str!("../../reference/imposed_flows.csv"),
            Self::CurvedWallsGlobal => include_str!("../../reference/curved_walls_global.csv"),
        }
    }
}

/// The rows of a reference file.
#[derive(Debug, Clone)]
pub struct Reference {
    header: csv::StringRecord,
    rows: Vec<csv::StringRecord>,
}

impl Reference {
    /// Reads a file.
    ///
    /// # Errors
    /// A file that is not CSV.
    pub fn read(file: ReferenceFile) -> Result<Self, StudyError> {
        let mut reader = csv::Reader::from_reader(file.text().as_bytes());
        let bad = |error: csv::Error| StudyError::Reference(error.to_string());
        let header = reader.headers().map_err(bad)?.clone();
        let rows = reader.records().collect::<Result<_, _>>().map_err(bad)?;
        Ok(Self { header, rows })
    }

    /// Keeps the rows whose column `name` reads `value`.
    #[must_use]
    pub fn select(mut self, name: &str, value: &str) -> Self {
        let column = self.header.iter().position(|h| h == name);
        self.rows.retain(|row| column.and_then(|c| row.get(c)) == Some(value));
        self
    }

    /// The numbers of a column.
    ///
    /// # Errors
    /// No such column, or one that does not hold numbers.
    pub fn column(&self, name: &str) -> Result<Vec<f64>, StudyError> {
        let missing = || StudyError::Reference(format!("no numbers in column {name}"));
        let index = self.header.iter().position(|h| h == name).ok_or_else(missing)?;
        self.rows.iter().map(|row| row.get(index).and_then(|v| v.trim().parse().ok()).ok_or_else(missing)).collect()
    }

    /// The number of a column in the first row.
    ///
    /// # Errors
    /// As [`Reference::column`], and no rows.
    pub fn value(&self, name: &str) -> Result<f64, StudyError> {
        let first = self.column(name)?.first().copied();
        first.ok_or_else(|| StudyError::Reference(format!("no rows with {name}")))
    }
}
