//! Fields as tables of values on a regular grid.

use motile_base::{
    Vec2, finite,
    internal::{all_finite, at_least},
    positive,
};

use crate::InterfaceError;

/// A table of values on a regular grid, interpolated by cubics whose slopes are continuous (Catmull and Rom).
///
/// The error is of third order in the spacing. Outside of the grid, the values at its edge continue. Along a periodic
/// direction, the table repeats: it then holds the values of one period, without those at its end.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    origin: Vec2,
    spacing: Vec2,
    counts: [usize; 2],
    values: Vec<f64>,
}

/// Relative difference of the length of a table and a period.
const SAME: f64 = 1e-9;

impl Table {
    /// Creates a table from the place of its first value (length), the distances between values along x and y (length),
    /// and the rows of values along x, from the lowest y on. With a single row, the field is the same for all y.
    ///
    /// # Errors
    /// Returns an error for rows of different lengths, no values, numbers that are not finite, spacings that are not
    /// positive.
    pub fn new(origin: Vec2, spacing: Vec2, rows: &[Vec<f64>]) -> Result<Self, InterfaceError> {
        at_least("rows of a table", rows.len(), 1)?;
        let count = rows[0].len();
        at_least("values in a row of a table", count, 1)?;
        for row in rows {
            if row.len() != count {
                return Err(InterfaceError::ragged_table(count, row.len()));
            }
            all_finite("the values of a table", row)?;
        }
        for value in [origin.x, origin.y] {
            finite("the origin of a table", value)?;
        }
        for value in [spacing.x, spacing.y] {
            positive("the spacing of a table", value)?;
        }
        Ok(Self { origin, spacing, counts: [count, rows.len()], values: rows.concat() })
    }

    /// Refuses a period that is not the one of the table along an axis.
    pub(super) fn check_period(&self, axis: usize, period: f64) -> Result<(), InterfaceError> {
        let length = self.counts[axis] as f64 * self.spacing[axis];
        if self.counts[axis] == 1 || (length - period).abs() <= SAME * period {
            return Ok(());
        }
        Err(InterfaceError::table_does_not_fit(self.counts[axis], length, period))
    }

    pub(super) fn is_symmetric(&self) -> bool {
        let [count, rows] = self.counts;
        let middle = self.origin.y + 0.5 * (rows - 1) as f64 * self.spacing.y;
        let row = |k: usize| &self.values[k * count..(k + 1) * count];
        rows == 1 || (middle.abs() <= SAME * self.spacing.y && (0..rows).all(|k| row(k) == row(rows - 1 - k)))
    }

    /// Returns the four values around a place along an axis, as their numbers, and their weights.
    fn along(&self, axis: usize, place: f64, periodic: bool) -> ([usize; 4], [f64; 4]) {
        let count = self.counts[axis];
        if count == 1 {
            return ([0; 4], [0.0, 1.0, 0.0, 0.0]);
        }
        let last = (count - 1) as f64;
        let mut at = (place - self.origin[axis]) / self.spacing[axis];
        at = if periodic { at.rem_euclid(count as f64) } else { at.clamp(0.0, last) };
        let first = at.floor().min(if periodic { last } else { last - 1.0 });
        let (u, first) = (at - first, first as usize);
        let number = |offset: usize| {
            // The offset is by one too large, so that it is not negative.
            if periodic { (first + count + offset - 1) % count } else { (first + offset).clamp(1, count) - 1 }
        };
        let (u2, u3) = (u * u, u * u * u);
        let mut weights =
            [0.5 * (2.0 * u2 - u - u3), 1.0 - 2.5 * u2 + 1.5 * u3, 0.5 * u + 2.0 * u2 - 1.5 * u3, 0.5 * (u3 - u2)];
        if !periodic {
            // Beyond an edge, the line through the last two values continues.
            let [a, b, c, d] = weights;
            if first == 0 {
                weights = [0.0, b + 2.0 * a, c - a, d];
            }
            if first + 2 == count {
                let [a, b, c, d] = weights;
                weights = [a, b - d, c + 2.0 * d, 0.0];
            }
        }
        ([0, 1, 2, 3].map(number), weights)
    }

    /// Returns the value at a place (length).
    pub(super) fn value(&self, place: Vec2, periods: [Option<f64>; 2]) -> f64 {
        if !(place.x.is_finite() && place.y.is_finite()) {
            return f64::NAN;
        }
        let (columns, across) = self.along(0, place.x, periods[0].is_some());
        let (rows, up) = self.along(1, place.y, periods[1].is_some());
        let row = |k: usize| -> f64 {
            columns
                .iter()
                .zip(across)
                .map(|(column, weight)| weight * self.values[rows[k] * self.counts[0] + column])
                .sum()
        };
        (0..4).map(|k| up[k] * row(k)).sum()
    }
}
