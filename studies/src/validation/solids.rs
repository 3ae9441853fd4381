//! Elastic solids against exact results.

use motile_tests::validation::solids::{Layer, Material, Surface};
use motile_tests::validation::{StudyError, Table, order};

use crate::tables::Measure;
use crate::validation::{Tables, per_cent};

pub(crate) fn solids() -> Tables {
    Ok(vec![layers()?])
}

fn layers() -> Result<Table, StudyError> {
    let spacings = [0.2, 0.1, 0.05, 0.025];
    let mut table = Table::new(
        &format!("A sheared layer relaxing below a fluid (Kelvin-Voigt): error of the rate at h = {spacings:?}, %"),
        "material | mesh | surface | errors | order",
    );
    for (surface, called) in [(Surface::Plain, "plain"), (Surface::Layer, "layer")] {
        for (material, unstructured) in [
            (Material::Springs, false),
            (Material::Springs, true),
            (Material::NeoHookean, false),
            (Material::NeoHookean, true),
        ] {
            let mesh = if unstructured { "unstructured" } else { "lattice" };
            table.measure(format_args!("{} | {mesh} | {called}", name(material)), || {
                let layer = Layer { material, unstructured, surface };
                let errors = spacings.iter().map(|&h| layer.error(h)).collect::<Result<Vec<_>, _>>()?;
                let list: Vec<String> = errors.iter().map(|&error| per_cent(error)).collect();
                Ok(format!("{} | {:.2}", list.join(", "), order(&spacings, &errors)))
            })?;
        }
    }
    Ok(table)
}

fn name(material: Material) -> &'static str {
    match material {
        Material::Springs => "springs",
        Material::NeoHookean => "neo-Hookean",
    }
}
