//! Tables of points.

mod columns;
mod fields;
mod groups;

use std::fmt::Write as _;

use motile_base::Vec2;

use crate::error::quoted;
use crate::file::MOST_POINTS;
use crate::{Contour, OutlineError};

use columns::Columns;
use fields::{Field, Separator, fields};

const REMEDY: &str = "Give x and y in each line, separated by a comma, semicolon, tab or space, with a point as the \
                      decimal mark. Begin lines of other text with #";

/// Signs with which comments begin.
const COMMENTS: [&str; 3] = ["#", "%", "//"];

/// One line of numbers.
struct Row<'a> {
    /// Number of the line, from 1.
    line: usize,
    text: &'a str,
    fields: Vec<Field<'a>>,
}

/// Returns the outlines of a table, and true if y runs downwards in it. Blank lines separate outlines, and so do the
/// values of a column that numbers cells, contours or frames.
pub(crate) fn read(text: &str) -> Result<(Vec<Contour>, bool), OutlineError> {
    let lines = lines_of(text);
    let mut rest = lines.as_slice();
    while let [(_, line), after @ ..] = rest
        && (line.is_empty() || line.starts_with("sep="))
    {
        rest = after;
    }
    // The name of the columns may stand in the last comment before the numbers.
    let mut remark = None;
    while let [(_, line), after @ ..] = rest
        && let Some(text) = COMMENTS.iter().find_map(|sign| line.strip_prefix(sign))
    {
        (rest, remark) = (after, Some(text));
    }
    while let [(_, ""), after @ ..] = rest {
        rest = after;
    }
    let Some(&(first, line)) = rest.first() else {
        return Err(OutlineError::format("the file", "it has no points", REMEDY));
    };
    let mut count = None;
    let mut header = None;
    if let Ok(number) = line.parse::<usize>() {
        // The number of the points, as in vertex files.
        count = Some((number, first));
        rest = &rest[1..];
    } else {
        let names = fields(line, Separator::of(line));
        if !names.iter().any(Field::looks_like_a_number) {
            header = Some(names);
            rest = &rest[1..];
        }
    }
    let blocks = blocks_of(rest, count.is_some())?;
    let rows: Vec<&Row<'_>> = blocks.iter().flatten().collect();
    if let Some((count, line)) = count.filter(|(count, _)| *count != rows.len()) {
        let problem = format!("it says that there are {count} points, but {} follow", rows.len());
        let remedy = "Correct this number, or remove the line";
        return Err(OutlineError::format(format!("line {line}"), problem, remedy));
    }
    let Some(start) = rows.first() else { return Ok((Vec::new(), false)) };
    if header.is_none() {
        header = remark.and_then(|remark| columns::in_remark(remark, start.fields.len()));
    }
    let columns = Columns::of(header.as_deref(), &rows)?;
    let mut contours = Vec::with_capacity(blocks.len());
    for block in &blocks {
        let points = block.iter().map(|row| row.point(&columns)).collect::<Result<Vec<_>, _>>()?;
        contours.extend(groups::split(&points, block, header.as_deref(), &columns)?);
    }
    if columns.unnamed && rows.len() > 3 && counts_points(&contours) {
        let remedy = "Remove this column, or add a header line that names the columns x and y";
        return Err(OutlineError::format("the table", "its first column counts the points", remedy));
    }
    Ok((contours, columns.downwards))
}

/// Returns the lines with their numbers, without comments at their ends. Files of old programs end lines by a carriage
/// return.
fn lines_of(text: &str) -> Vec<(usize, &str)> {
    let end = if text.contains('\n') { '\n' } else { '\r' };
    let mut lines: Vec<(usize, &str)> = text
        .split(end)
        .enumerate()
        .map(|(number, line)| {
            let line = line.trim_end().trim_start_matches([' ', '\u{feff}']);
            // A comment after numbers.
            let comment = line.find([' ', '\t']).and_then(|_| line.find('#')).filter(|at| *at > 0);
            (number + 1, comment.map_or(line, |at| line[..at].trim_end()))
        })
        .collect();
    // Tabs that only indent.
    if lines.iter().all(|(_, line)| line.is_empty() || line.starts_with('\t')) {
        lines.iter_mut().for_each(|(_, line)| *line = line.trim_start());
    }
    lines
}

/// Returns the lines of numbers between blank lines.
fn blocks_of<'a>(lines: &[(usize, &'a str)], counted: bool) -> Result<Vec<Vec<Row<'a>>>, OutlineError> {
    let mut blocks: Vec<Vec<Row<'a>>> = vec![Vec::new()];
    let (mut separator, mut found) = (None, 0);
    for &(line, text) in lines.iter().filter(|(_, text)| !COMMENTS.iter().any(|sign| text.starts_with(sign))) {
        let separator = *separator.get_or_insert_with(|| Separator::of(text));
        let fields = fields(text, separator);
        // Programs that write tables end them with lines of separators alone.
        if fields.iter().all(|field| field.text.is_empty()) {
            blocks.push(Vec::new());
            continue;
        }
        found += 1;
        if found > MOST_POINTS {
            let problem = format!("it has more than {MOST_POINTS} points");
            return Err(OutlineError::format("the file", problem, "Use fewer points"));
        }
        if let Some(block) = blocks.last_mut() {
            block.push(Row { line, text, fields });
        }
    }
    blocks.retain(|block| !block.is_empty());
    // A blank line after each point separates nothing.
    if counted || blocks.iter().all(|block| block.len() == 1) {
        blocks = vec![blocks.into_iter().flatten().collect()];
    }
    Ok(blocks)
}

impl Row<'_> {
    fn place(&self) -> String {
        format!("line {}", self.line)
    }

    /// Returns the number in a column.
    fn number(&self, column: usize) -> Result<f64, OutlineError> {
        let field = self.fields.get(column).ok_or_else(|| {
            let problem = format!("{:?} has no column {}", quoted(self.text), column + 1);
            OutlineError::format(self.place(), problem, REMEDY)
        })?;
        field.number().ok_or_else(|| {
            let mut problem = format!("{:?} is not a number", quoted(field.text));
            if field.text.contains(',') {
                let _ = write!(problem, " (its comma may be a decimal mark or separate thousands)");
            }
            OutlineError::format(self.place(), problem, REMEDY)
        })
    }

    fn point(&self, columns: &Columns) -> Result<Vec2, OutlineError> {
        Ok(Vec2::new(self.number(columns.x)?, self.number(columns.y)?))
    }
}

/// Returns true if the first coordinates are 0, 1, 2 ... or 1, 2, 3 ... in every outline.
fn counts_points(contours: &[Contour]) -> bool {
    contours.iter().all(|contour| {
        let counted = |from: f64| contour.points.iter().enumerate().all(|(k, point)| point.x == k as f64 + from);
        counted(0.0) || counted(1.0)
    })
}

#[cfg(test)]
mod tests;
