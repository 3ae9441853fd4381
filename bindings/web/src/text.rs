//! Texts of scenes that a reader has typed, with another value of a parameter.

use std::ops::Range;

use motile::setup::{DropletSetup, Setup};
use toml::de::{DeTable, DeValue};
use toml::{Spanned, Table, Value};

use crate::{Refusal, concise::concise, knob::Knob};

/// Text of a scene file with another value of a parameter: its numbers change and lines that are missing are added, so
/// that comments and order stay. If the parameter cannot be written there, it is a text of
/// [`concise`](crate::concise::concise()).
///
/// # Errors
/// Texts that are no scene, and those of [`Knob::turned`].
pub fn turned(text: &str, knob: Knob, value: f64) -> Result<String, Refusal> {
    let wanted = knob.turned(&Setup::from_toml(text)?, value)?;
    let is_wanted = |text: &str| {
        let read = Setup::from_toml(text).ok().filter(|read| knob.value(read) == Some(value));
        read.and_then(|read| knob.turned(&read, value).ok()).is_some_and(|read| read == wanted)
    };
    let root = DeTable::parse(text).map_err(Refusal::plain)?.into_inner();
    let table: Table = wanted.to_toml()?.parse().map_err(Refusal::plain)?;
    let mut edits = missing(text, &root, knob, &wanted);
    let exterior = Value::Float(wanted.viscosity);
    changed(text, &DeValue::Table(root), 0..0, &Value::Table(table), &exterior, &mut edits);
    let mut edited = text.to_owned();
    // The last one first, so that places before it stay.
    while let Some(last) = (0..edits.len()).max_by_key(|k| edits[*k].0.start) {
        let (place, new) = edits.swap_remove(last);
        edited.replace_range(place, &new);
    }
    if is_wanted(&edited) { Ok(edited) } else { concise(&wanted) }
}

/// Place of a number in a text, and the new one.
type Edit = (Range<usize>, String);

/// Adds the places of numbers that differ, with the new ones. An interior without a viscosity has the exterior's.
fn changed(text: &str, old: &DeValue<'_>, place: Range<usize>, new: &Value, exterior: &Value, edits: &mut Vec<Edit>) {
    match (old, new) {
        (DeValue::Table(old), Value::Table(new)) => {
            for (key, entry) in old {
                let default = Some(exterior).filter(|_| key.get_ref() == "viscosity");
                if let Some(new) = new.get(key.get_ref().as_ref()).or(default) {
                    changed(text, entry.get_ref(), entry.span(), new, exterior, edits);
                }
            }
        }
        (DeValue::Array(old), Value::Array(new)) => {
            for (entry, new) in old.iter().zip(new) {
                changed(text, entry.get_ref(), entry.span(), new, exterior, edits);
            }
        }
        (DeValue::Integer(_) | DeValue::Float(_), new) => {
            let number = new.as_float().or(new.as_integer().map(|number| number as f64));
            if text[place.clone()].replace('_', "").parse().ok() != number {
                edits.push((place, new.to_string()));
            }
        }
        _ => {}
    }
}

/// Lines for droplets that have none with the parameter, and their places after the heads of the droplets.
fn missing(text: &str, root: &DeTable<'_>, knob: Knob, wanted: &Setup) -> Vec<Edit> {
    let line = |droplet: &DropletSetup| match knob {
        Knob::Activity => Some(("particles.activity", droplet.activity())),
        Knob::Diffusion => Some(("particles.diffusion", droplet.particles.as_ref()?.diffusion)),
        Knob::ViscosityRatio => Some(("viscosity", droplet.viscosity?)),
        Knob::Size => None,
    };
    let listed = root.get("droplets").and_then(|list| list.get_ref().as_array());
    let heads = text.match_indices("[[droplets]]").map(|(at, _)| at + text[at..].find('\n').unwrap_or(text.len() - at));
    let add = |((at, entry), droplet): ((usize, &Spanned<DeValue<'_>>), &DropletSetup)| {
        let (key, value) = line(droplet)?;
        let found = key.split('.').try_fold(entry, |entry, key| entry.get_ref().as_table()?.get(key));
        found.is_none().then(|| (at..at, format!("\n{key} = {value:?}")))
    };
    heads.zip(listed.into_iter().flat_map(|list| list.iter())).zip(&wanted.droplets).filter_map(add).collect()
}
