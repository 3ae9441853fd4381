//! Scalars and vectors on a staggered grid.

use motile_base::{Vec2, same_length};

use crate::{Grid, StokesError};

macro_rules! scalar_field {
    ($(#[$doc:meta])* $name:ident, $rows:ident, $what:literal) => {
        $(#[$doc])*
        #[derive(Debug, Clone, PartialEq)]
        pub struct $name {
            grid: Grid,
            values: Vec<f64>,
        }

        impl $name {
            /// Creates a field of zeros.
            #[must_use]
            pub fn zeros(grid: Grid) -> Self {
                Self { grid, values: vec![0.0; grid.nx() * grid.$rows()] }
            }

            /// Creates a field of these values, row after row.
            ///
            /// # Errors
            /// Returns an error for the wrong number of values.
            pub fn from_values(grid: Grid, values: Vec<f64>) -> Result<Self, StokesError> {
                same_length($what, grid.nx() * grid.$rows(), values.len())?;
                Ok(Self { grid, values })
            }

            /// Returns the grid of the field.
            #[must_use]
            pub fn grid(&self) -> &Grid {
                &self.grid
            }

            /// Returns the values, row after row (x contiguous).
            #[must_use]
            pub fn values(&self) -> &[f64] {
                &self.values
            }

            /// Returns the values for writing, row after row.
            pub fn values_mut(&mut self) -> &mut [f64] {
                &mut self.values
            }
        }
    };
}

scalar_field!(
    /// A scalar at the cell centres ((i + 1/2) h, (j + 1/2) h): pressure, normal strain rates.
    CentreField,
    centre_rows,
    "a centre field"
);
scalar_field!(
    /// A scalar at the nodes (i h, j h): streamfunction, vorticity, shear strain rate.
    NodeField,
    node_rows,
    "a node field"
);

/// A vector field with its components on the cell faces they are normal to: x at (i h, (j + 1/2) h), y at
/// ((i + 1/2) h, j h). Velocities and force densities.
#[derive(Debug, Clone, PartialEq)]
pub struct StaggeredField {
    grid: Grid,
    x: Vec<f64>,
    y: Vec<f64>,
}

impl StaggeredField {
    /// Creates a field of zeros.
    #[must_use]
    pub fn zeros(grid: Grid) -> Self {
        let (x, y) = (vec![0.0; grid.nx() * grid.centre_rows()], vec![0.0; grid.nx() * grid.node_rows()]);
        Self { grid, x, y }
    }

    /// Returns a field with the components of a vector function of the place (length), each where it belongs on the
    /// grid. Places are in the coordinates of the grid, whose lower left corner is at [`Grid::origin`].
    #[must_use]
    pub fn from_fn(grid: Grid, function: impl Fn(Vec2) -> Vec2) -> Self {
        let (mut field, [x0, y0], h) = (Self::zeros(grid), grid.origin(), grid.spacing());
        let place = |index: usize, shift: [f64; 2]| {
            let (i, j) = ((index % grid.nx()) as f64, (index / grid.nx()) as f64);
            Vec2::new(x0 + (i + shift[0]) * h, y0 + (j + shift[1]) * h)
        };
        field.x.iter_mut().enumerate().for_each(|(k, value)| *value = function(place(k, [0.0, 0.5])).x);
        field.y.iter_mut().enumerate().for_each(|(k, value)| *value = function(place(k, [0.5, 0.0])).y);
        field
    }

    /// Creates a field of these components, each row after row.
    ///
    /// # Errors
    /// Returns an error for the wrong number of values in a component.
    pub fn from_components(grid: Grid, x: Vec<f64>, y: Vec<f64>) -> Result<Self, StokesError> {
        let (nx, ny) = (grid.nx() * grid.centre_rows(), grid.nx() * grid.node_rows());
        same_length("an x component", nx, x.len())?;
        same_length("a y component", ny, y.len())?;
        Ok(Self { grid, x, y })
    }

    /// Returns the grid of the field.
    #[must_use]
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Returns the x components, row after row.
    #[must_use]
    pub fn x(&self) -> &[f64] {
        &self.x
    }

    /// Returns the y components, row after row.
    #[must_use]
    pub fn y(&self) -> &[f64] {
        &self.y
    }

    /// Returns both components for writing, each row after row.
    pub fn components_mut(&mut self) -> (&mut [f64], &mut [f64]) {
        (&mut self.x, &mut self.y)
    }

    /// Sets every value.
    pub fn fill(&mut self, value: f64) {
        self.x.fill(value);
        self.y.fill(value);
    }

    /// Becomes a copy of `source`; allocates only if that has more values.
    pub fn copy_from(&mut self, source: &Self) {
        self.grid = source.grid;
        self.x.clone_from(&source.x);
        self.y.clone_from(&source.y);
    }

    /// Sets `self = keep * self + factor * term` for a field of the same grid.
    pub fn combine(&mut self, keep: f64, factor: f64, term: &Self) {
        for (values, terms) in [(&mut self.x, &term.x), (&mut self.y, &term.y)] {
            values.iter_mut().zip(terms).for_each(|(value, term)| *value = keep * *value + factor * term);
        }
    }
}
