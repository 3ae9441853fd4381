//! Rigid walls of any shape.

use motile_tests::validation::{Table, curved_walls};

use super::Tables;

/// Droplets between curved walls against exact values and in films, and flow along wavy walls against its limits.
pub(super) fn curved_walls() -> Tables {
    let mut exact = Table::new(
        "Droplets of fixed shape in a wavy channel: largest error of velocity on the interface and off it, flux, force \
         of a wall",
        "nodes of the droplet | nodes of a wall | on the interface | off it | flux | force",
    );
    for (droplet, wall) in [(24, 32), (32, 48), (48, 64), (72, 96), (96, 128)] {
        let errors = curved_walls::fixed(droplet, wall)?;
        let values = [errors.markers, errors.field, errors.flux, errors.force];
        exact
            .push([droplet, wall].map(|count| count.to_string()).into_iter().chain(values.map(|e| format!("{e:.1e}"))));
    }
    let mut films = Table::new(
        "Films beside a curved wall: largest error of velocity on the interface, relative",
        "film | viscosity inside | 32 and 64 nodes | 64 and 96 | 96 and 160 | 128 and 240",
    );
    let nodes = [[32, 64], [64, 96], [96, 160], [128, 240]];
    for film in [0.1, 0.03, 0.01] {
        for inside in [1.0, 10.0] {
            let errors = curved_walls::film(film, inside, &nodes)?;
            let errors = errors.into_iter().map(|error| format!("{error:.1e}"));
            films.push([film.to_string(), inside.to_string()].into_iter().chain(errors));
        }
    }
    Ok(vec![exact, films])
}
