//! Columns of x and y.

use super::fields::{Field, Separator, fields};
use super::{REMEDY, Row};
use crate::OutlineError;
use crate::error::quoted;

/// Other names of the columns of x and y.
const OTHERS: [[&str; 2]; 4] = [["col", "row"], ["column", "row"], ["axis-1", "axis-0"], ["lon", "lat"]];
/// Names of polar coordinates, which a table of x and y does not have.
const POLAR: [&str; 8] = ["theta", "phi", "angle", "azimuth", "r", "rho", "radius", "distance"];
/// Most names that a message lists.
const LISTED: usize = 8;

/// Places of x and y in the lines of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Columns {
    pub(super) x: usize,
    pub(super) y: usize,
    /// Number of columns in front of the first one that has a name.
    pub(super) shift: usize,
    /// True for a table of more than two columns without names.
    pub(super) unnamed: bool,
    /// True for rows and columns of a picture, in which rows run downwards.
    pub(super) downwards: bool,
}

/// Returns the names of so many columns in a comment, if two of them are x and y.
pub(super) fn in_remark(remark: &str, count: usize) -> Option<Vec<Field<'_>>> {
    let names = fields(remark.trim(), Separator::of(remark.trim()));
    let lower = lower_case(&names);
    (names.len() == count && ["x", "y"].iter().all(|axis| named(&lower, axis).len() == 1)).then_some(names)
}

fn lower_case(names: &[Field<'_>]) -> Vec<String> {
    names.iter().map(|name| name.text.to_lowercase()).collect()
}

/// Returns the places of the names that stand for an axis: `x`, or else such as `x (um)` or `pos_x`.
fn named(names: &[String], axis: &str) -> Vec<usize> {
    let places = |fits: &dyn Fn(&String) -> bool| -> Vec<usize> {
        names.iter().enumerate().filter(|(_, name)| fits(name)).map(|(place, _)| place).collect()
    };
    let exact = places(&|name| name == axis);
    if !exact.is_empty() {
        return exact;
    }
    places(&|name| {
        let before = name.strip_prefix(axis).is_some_and(|rest| rest.starts_with([' ', '_', '(', '[', '-', '/', '.']));
        before || name.strip_suffix(axis).is_some_and(|rest| rest.ends_with([' ', '_', '-', '.']))
    })
}

/// Returns true for the word alone, or with a unit or number behind it.
fn starts_with_word(name: &str, word: &str) -> bool {
    name.strip_prefix(word).is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphabetic()))
}

impl Columns {
    /// Returns the columns of a table with names, or of one without.
    pub(super) fn of(header: Option<&[Field<'_>]>, rows: &[&Row<'_>]) -> Result<Self, OutlineError> {
        let Some(header) = header else { return Self::without_names(rows) };
        let names = lower_case(header);
        let refused = |problem: String| {
            let remedy = "Name the two columns of the outline x and y, or begin the line with # if it is a title";
            Err(OutlineError::format("the header", problem, remedy))
        };
        let list = || {
            let mut list: Vec<String> = header.iter().take(LISTED).map(|name| quoted(name.text)).collect();
            list.extend((header.len() > LISTED).then(|| "...".to_owned()));
            list.join(", ")
        };
        let other = || {
            OTHERS.iter().find_map(|axes| {
                let place = |axis: &str| names.iter().position(|name| name == axis);
                Some([place(axes[0])?, place(axes[1])?])
            })
        };
        let mut downwards = false;
        let [x, y] = match [named(&names, "x").as_slice(), named(&names, "y").as_slice()] {
            [[x], [y]] => [*x, *y],
            [[], []] => match other() {
                Some(found) => {
                    downwards = !names.iter().any(|name| name == "lat");
                    found
                }
                None if names.iter().any(|name| POLAR.iter().any(|polar| starts_with_word(name, polar))) => {
                    let remedy = "Give x = r cos(theta) and y = r sin(theta) instead, in columns x and y";
                    let problem = format!("the columns {} are polar coordinates", list());
                    return Err(OutlineError::format("the header", problem, remedy));
                }
                None if names.len() <= 2 => [0, 1],
                None => return refused(format!("none of the columns {} is x or y", list())),
            },
            _ => return refused(format!("more or less than one of the columns {} is x, or y", list())),
        };
        let shift = shift_of(names.len(), rows)?;
        Ok(Self { x: x + shift, y: y + shift, shift, unnamed: false, downwards })
    }

    /// Returns the first two columns.
    fn without_names(rows: &[&Row<'_>]) -> Result<Self, OutlineError> {
        let width = rows.first().map_or(0, |row| row.fields.len());
        if let Some(row) = rows.iter().find(|row| row.fields.len() != width) {
            row.number(1)?;
            let found = row.fields.len();
            let problem = format!("there are {found} entries, but {width} in the line of the first point");
            return Err(OutlineError::format(row.place(), problem, REMEDY));
        }
        let first = rows.first().map_or("", |row| row.text);
        if width == 4
            && Separator::of(first) == Separator::Comma
            && rows.iter().all(|row| [1, 3].iter().all(|place| row.fields[*place].is_whole()))
        {
            let problem = format!("the commas in {:?} may be decimal marks or separate columns", quoted(first));
            let remedy = "Separate the columns by semicolons, or name them in a first line";
            return Err(OutlineError::format("the table", problem, remedy));
        }
        Ok(Self { x: 0, y: 1, shift: 0, unnamed: width > 2, downwards: false })
    }
}

/// Returns the number of columns in front of the columns with names: 1 in tables of R, which do not name the column of
/// the names of rows.
fn shift_of(names: usize, rows: &[&Row<'_>]) -> Result<usize, OutlineError> {
    let Some(wide) = rows.iter().find(|row| names > 1 && row.fields.len() > names) else { return Ok(0) };
    let is_named = |(k, row): (usize, &&Row<'_>)| {
        let name = row
            .fields
            .first()
            .is_some_and(|name| name.quoted || name.text.parse() == Ok(k) || name.text.parse() == Ok(k + 1));
        name && row.fields.len() == names + 1
    };
    if Separator::of(wide.text) != Separator::Comma && rows.iter().enumerate().all(is_named) {
        return Ok(1);
    }
    let problem = format!("{:?} has {} entries, but {names} columns have names", quoted(wide.text), wide.fields.len());
    let remedy = "Name every column. If commas are decimal marks, separate the columns by semicolons";
    Err(OutlineError::format(wide.place(), problem, remedy))
}
