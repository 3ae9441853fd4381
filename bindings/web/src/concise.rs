//! Descriptions without what is as by default, for links and for reading.

use motile::setup::Setup;
use toml::{Table, Value};

use crate::Refusal;

/// Entry of a table or a list.
#[derive(Debug, Clone)]
enum Step {
    Key(String),
    Number(usize),
}

/// Shortest text of a scene file from which the description comes again: every entry that can be left out is.
///
/// Entries are taken away one by one, whole tables first, and stay away where what is read without them is the same
/// description, so that no default is known here.
///
/// # Errors
/// A description that has no text, with a seed above 9223372036854775807.
pub fn concise(setup: &Setup) -> Result<String, Refusal> {
    // By way of the text, because the serializer would be compiled once more.
    let table = setup.to_toml()?.parse().map_err(Refusal::plain)?;
    let mut whole = Value::Table(table);
    shorten(&mut whole, &mut Vec::new(), setup);
    let Value::Table(table) = whole else { return Ok(String::new()) };
    Ok(written(&table))
}

/// Takes away what can be left out of the entry at a place.
fn shorten(whole: &mut Value, place: &mut Vec<Step>, setup: &Setup) {
    let steps: Vec<Step> = match entry(whole, place) {
        Some(Value::Table(table)) => table.keys().cloned().map(Step::Key).collect(),
        Some(Value::Array(list)) if list.iter().any(Value::is_table) => (0..list.len()).map(Step::Number).collect(),
        _ => return,
    };
    for step in steps {
        if let Step::Key(key) = &step {
            let Some(Value::Table(table)) = entry(whole, place) else { return };
            let kept = table.remove(key);
            if is_still(whole, setup) {
                continue;
            }
            if let (Some(kept), Some(Value::Table(table))) = (kept, entry(whole, place)) {
                table.insert(key.clone(), kept);
            }
        }
        place.push(step);
        shorten(whole, place, setup);
        place.pop();
    }
}

fn is_still(whole: &Value, setup: &Setup) -> bool {
    let Value::Table(table) = whole else { return false };
    Setup::from_toml(&table.to_string()).is_ok_and(|read| read == *setup)
}

fn entry<'v>(whole: &'v mut Value, place: &[Step]) -> Option<&'v mut Value> {
    place.iter().try_fold(whole, |value, step| match (value, step) {
        (Value::Table(table), Step::Key(key)) => table.get_mut(key),
        (Value::Array(list), Step::Number(number)) => list.get_mut(*number),
        _ => None,
    })
}

/// Text of a table as people write scene files: what is short on a line of its own, with keys joined by dots where a
/// table has one entry, bodies in sections.
fn written(table: &Table) -> String {
    let is_section = |value: &Value| value.as_array().is_some_and(|list| list.iter().any(Value::is_table));
    let (sections, lines): (Vec<_>, Vec<_>) = table.iter().partition(|(_, value)| is_section(value));
    let mut text: String = lines.iter().map(|(key, value)| line(key, value)).collect();
    for (key, value) in sections {
        for entry in value.as_array().into_iter().flatten().filter_map(Value::as_table) {
            if !text.is_empty() {
                text.push('\n');
            }
            text += &format!("[[{key}]]\n");
            text.extend(entry.iter().map(|(key, value)| line(key, value)));
        }
    }
    text
}

/// Lines of an entry.
fn line(key: &str, value: &Value) -> String {
    match value {
        Value::Table(table) if table.len() == 1 => {
            table.iter().map(|(inner, value)| line(&format!("{key}.{inner}"), value)).collect()
        }
        Value::Table(table) if !table.is_empty() && table.values().any(Value::is_table) => {
            table.iter().map(|(inner, value)| line(&format!("{key}.{inner}"), value)).collect()
        }
        value => format!("{key} = {value}\n"),
    }
}
