//! Tables of points.

use motile_base::Vec2;

use crate::error::quoted;
use crate::{Contour, OutlineError};

const REMEDY: &str = "Give x and y in each line, separated by a comma, semicolon, tab or space, with a point as the \
                      decimal mark";

/// Signs with which comments begin.
const COMMENTS: [&str; 3] = ["#", "%", "//"];

/// Returns the outlines of a table. Blank lines separate them.
pub(crate) fn read(text: &str) -> Result<Vec<Contour>, OutlineError> {
    let lines = text.lines().enumerate().map(|(number, line)| (number + 1, line.trim()));
    let mut lines = lines.filter(|(_, line)| !COMMENTS.iter().any(|sign| line.starts_with(sign))).peekable();
    while lines.next_if(|(_, line)| line.is_empty()).is_some() {}
    let Some(&(first, line)) = lines.peek() else {
        return Err(OutlineError::format("the file", "it has no points", REMEDY));
    };
    let mut count = None;
    let mut header = None;
    if let Ok(number) = line.parse::<usize>() {
        // The number of the points, as in vertex files.
        count = Some((number, first));
        lines.next();
    } else if fields(line).iter().all(|field| number_of(line, field).is_none()) {
        header = Some(fields(line).iter().map(|field| field.to_lowercase()).collect::<Vec<_>>());
        lines.next();
    }
    let columns = columns_of(header.as_deref());
    let mut blocks: Vec<Vec<Vec2>> = vec![Vec::new()];
    let mut counters = true;
    let mut widest = 0;
    for (number, line) in lines {
        if line.is_empty() {
            blocks.push(Vec::new());
            continue;
        }
        let entries = fields(line);
        widest = widest.max(entries.len());
        let at = |column: usize| {
            let place = || format!("line {number}");
            let field = entries.get(column).ok_or_else(|| {
                OutlineError::format(place(), format!("{:?} has no column {}", quoted(line), column + 1), REMEDY)
            })?;
            number_of(line, field)
                .ok_or_else(|| OutlineError::format(place(), format!("{:?} is not a number", quoted(field)), REMEDY))
        };
        let [x, y] = [at(columns[0])?, at(columns[1])?];
        let block = blocks.last_mut().map_or(0, |block| {
            block.push(Vec2::new(x, y));
            block.len()
        });
        counters &= x == block as f64 || x + 1.0 == block as f64;
    }
    blocks.retain(|block| !block.is_empty());
    let found: usize = blocks.iter().map(Vec::len).sum();
    if let Some((count, line)) = count.filter(|(count, _)| *count != found) {
        let problem = format!("it says that there are {count} points, but {found} follow");
        let remedy = "Correct this number, or remove the line";
        return Err(OutlineError::format(format!("line {line}"), problem, remedy));
    }
    if header.is_none() && widest > 2 && counters && found > 3 {
        let remedy = "Remove this column, or add a header line that names the columns x and y";
        return Err(OutlineError::format("the table", "its first column counts the points", remedy));
    }
    Ok(blocks.into_iter().map(|points| Contour { name: None, points, closed: true }).collect())
}

/// Returns the separator of a line.
fn separator(line: &str) -> Option<char> {
    [';', '\t', ','].into_iter().find(|sign| line.contains(*sign))
}

/// Returns the entries of a line, without quotation marks.
fn fields(line: &str) -> Vec<&str> {
    match separator(line) {
        Some(sign) => line.split(sign).map(|field| field.trim().trim_matches('"').trim()).collect(),
        None => line.split_whitespace().map(|field| field.trim_matches('"')).collect(),
    }
}

/// Returns the number in an entry of a line. If semicolons or tabs separate entries, a comma is a decimal mark.
fn number_of(line: &str, field: &str) -> Option<f64> {
    let comma = separator(line).is_some_and(|sign| sign != ',') && field.contains(',') && !field.contains('.');
    if comma { field.replace(',', ".").parse().ok() } else { field.parse().ok() }
}

/// Returns the columns of x and y: those that the header names, or the first two.
fn columns_of(header: Option<&[String]>) -> [usize; 2] {
    let Some(header) = header else { return [0, 1] };
    let named = |axis: &str| {
        let exact = header.iter().position(|name| name == axis);
        let starts = |name: &String| {
            name.strip_prefix(axis).is_some_and(|rest| rest.starts_with([' ', '_', '(', '[', '-', '/', '.']))
        };
        exact.or_else(|| header.iter().position(starts))
    };
    match [named("x"), named("y")] {
        [Some(x), Some(y)] => [x, y],
        _ => [0, 1],
    }
}

#[cfg(test)]
mod tests;
