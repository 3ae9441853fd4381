//! The stresslet of the scheme of the thesis, from the errors in other tables and the references.

use anyhow::Context;
use motile_tests::validation::{Reference, StudyError, Table};

use super::Tables;
use crate::tables::{self, Measure};

/// Spacings h over the radius.
const SPACINGS: [&str; 3] = ["0.1", "0.05", "0.025"];
/// Place of the stresslet among the errors of a row.
const STRESSLET: usize = 2;

/// The relative errors of the scheme of the thesis at an activity, by spacing, from a table of errors in %.
fn errors(table: &str, width: Option<&str>, activity: &str) -> Result<Vec<f64>, StudyError> {
    let path = tables::file(table, 0);
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_path(&path)?;
    let header = reader.headers()?.clone();
    let rows = reader.records().collect::<Result<Vec<_>, _>>()?;
    let column = |name: &str| header.iter().position(|found| found == name);
    let reads = |row: &csv::StringRecord, name: &str, value: &str| {
        column(name).and_then(|k| row.get(k)).is_some_and(|found| found == value)
    };
    let error = |h: &str| -> Result<f64, StudyError> {
        let row = rows.iter().find(|row| {
            reads(row, "preset", "thesis")
                && reads(row, "activity", activity)
                && reads(row, "h", h)
                && width.is_none_or(|width| reads(row, "width", width))
        });
        let all = row.zip(column("errors")).and_then(|(row, k)| row.get(k));
        let one = all.and_then(|all| all.split(" / ").nth(STRESSLET)).and_then(|error| error.parse::<f64>().ok());
        Ok(0.01 * one.with_context(|| format!("{}: no errors at {activity} and h = {h}", path.display()))?)
    };
    SPACINGS.into_iter().map(error).collect()
}

pub(super) fn stresslet() -> Tables {
    let mut table = Table::new(
        "Stresslet S_xx of steady swimmers: reference, and by Cowley's scheme at h = R/10, R/20 (the spacing of the \
         thesis) and R/40; positive for a pusher",
        "region | activity | reference | h = 0.1 | h = 0.05 | h = 0.025 | change at h = 0.05 | sign at h = 0.05",
    );
    let boxes = Reference::read("steady_swimmer_box6")?;
    let channels = Reference::read("channel_steady_swimmer")?.select("conv", "p0");
    for (width, activity) in [
        (None, "-2"),
        (None, "-4"),
        (Some("2"), "-2"),
        (Some("2"), "-4"),
        (Some("3"), "-2"),
        (Some("5"), "-2"),
        (Some("5"), "-4"),
    ] {
        let name = width.map_or("box 6 x 6".to_owned(), |width| format!("channel of width {width}"));
        table.measure(format_args!("{name} | {activity}"), || {
            let (reference, column, errors) = match width {
                None => (boxes.clone(), "Sxx_f", errors("steady", None, activity)?),
                Some(_) => {
                    let reference = channels.clone().select("w", width.unwrap_or_default());
                    (reference, "Sxx", errors("channel-swimmers", width, activity)?)
                }
            };
            let exact = reference.select("zeta_dmu", &format!("{activity}.0")).value(column)?;
            let found: Vec<f64> = errors.iter().map(|error| exact + error * exact.abs()).collect();
            let change = found[1] - exact;
            let sign = if found[1] * exact > 0.0 { "right" } else { "wrong" };
            let [a, b, c] = [found[0], found[1], found[2]].map(|value| format!("{value:.1}"));
            Ok(format!("{exact:.1} | {a} | {b} | {c} | {change:.1} | {sign}"))
        })?;
    }
    Ok(vec![table])
}
