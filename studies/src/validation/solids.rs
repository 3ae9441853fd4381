//! Elastic solids against exact results.

use motile_tests::validation::solids::{
    Layer, Material, Sample, Surface, balance, energies, largest_stress_error, laws, meshes, moduli, patch,
};
use motile_tests::validation::{StudyError, Table, order};

use crate::validation::{Tables, per_cent};

pub(crate) fn solids() -> Tables {
    Ok(vec![stresses()?, forces()?, measured()?, layers()?])
}

fn stresses() -> Result<Table, StudyError> {
    let mut table = Table::new(
        "Stress against central differences of the energy, principal stretches 0.5 to 2: largest difference over the \
         stress",
        "energy | error",
    );
    for (name, energy) in energies()? {
        table.row(format_args!("{name} | {:.1e}", largest_stress_error(energy.as_ref())?));
    }
    Ok(table)
}

fn forces() -> Result<Table, StudyError> {
    let mut table = Table::new(
        "Forces under a large rough deformation: sum and torque over the sum of their sizes; under a uniform one: \
         largest force inside over the largest on the boundary",
        "law | mesh | sum | torque | patch test",
    );
    for (mesh, name) in meshes()?.iter().zip(["unstructured ring", "lattice"]) {
        for (law, forces) in laws(mesh)? {
            let balance = balance(mesh, forces.as_ref())?;
            let patch = patch(mesh, forces.as_ref())?;
            let figures = [balance.sum, balance.torque, patch].map(|figure| format!("{figure:.1e}"));
            table.push([law.to_owned(), name.to_owned()].into_iter().chain(figures));
        }
    }
    Ok(table)
}

fn measured() -> Result<Table, StudyError> {
    let mut table = Table::new(
        "Moduli of meshes of spacing 0.05 under a strain of 0.001, inner points in equilibrium, over those of the \
         material",
        "material | mesh | shear modulus | bulk modulus",
    );
    let samples = [
        (Sample::Lattice, "lattice, wall"),
        (Sample::Wall, "unstructured, wall"),
        (Sample::Disc, "unstructured, disc"),
    ];
    for material in [Material::Springs, Material::NeoHookean] {
        for (sample, mesh) in samples {
            let found = moduli(sample, material)?;
            let moduli = [found.shear, found.bulk].map(|modulus| format!("{modulus:.5}"));
            table.push([name(material).to_owned(), mesh.to_owned()].into_iter().chain(moduli));
        }
    }
    Ok(table)
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
            let layer = Layer { material, unstructured, surface };
            let errors = spacings.iter().map(|&h| layer.error(h)).collect::<Result<Vec<_>, _>>()?;
            let list: Vec<String> = errors.iter().map(|&error| per_cent(error)).collect();
            table.row(format_args!(
                "{} | {} | {called} | {} | {:.2}",
                name(material),
                if unstructured { "unstructured" } else { "lattice" },
                list.join(", "),
                order(&spacings, &errors)
            ));
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
