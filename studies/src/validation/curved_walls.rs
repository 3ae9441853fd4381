//! Rigid walls of any shape.

use motile_tests::validation::{Table, curved_walls, order};

use super::{Tables, per_cent};

/// Time at which the speeds of swimmers are compared.
const LATE: f64 = 10.0;

/// Droplets between curved walls against exact values and in films, and flow along wavy walls against its limits.
pub(super) fn curved_walls(quick: bool) -> Tables {
    let mut exact = Table::new(
        "Droplets of fixed shape in a wavy channel: largest error of velocity on the interface and off it, flux, force \
         of a wall",
        &["nodes of the droplet", "nodes of a wall", "on the interface", "off it", "flux", "force"],
    );
    for (droplet, wall) in [(24, 32), (32, 48), (48, 64), (72, 96), (96, 128)] {
        let errors = curved_walls::fixed(droplet, wall)?;
        let values = [errors.markers, errors.field, errors.flux, errors.force];
        exact
            .push([droplet, wall].map(|count| count.to_string()).into_iter().chain(values.map(|e| format!("{e:.1e}"))));
    }
    let mut films = Table::new(
        "Films beside a curved wall: largest error of velocity on the interface, relative",
        &["film", "viscosity inside", "32 and 64 nodes", "64 and 96", "96 and 160", "128 and 240"],
    );
    let nodes = [[32, 64], [64, 96], [96, 160], [128, 240]];
    for film in [0.1, 0.03, 0.01] {
        for inside in [1.0, 10.0] {
            let errors = curved_walls::film(film, inside, if quick { &nodes[..2] } else { &nodes })?;
            let errors = errors.into_iter().map(|error| format!("{error:.1e}"));
            films.push([film.to_string(), inside.to_string()].into_iter().chain(errors));
        }
    }
    let mut limits = Table::new(
        "Flow along wavy walls y = 1 + a cos(2 pi x/l): relative difference of the pressure gradient of a flux from \
         its limits",
        &["limit", "a", "l", "difference", "order"],
    );
    let mut series = |name: &str, cases: [(f64, f64); 3], steps: [f64; 3], limit: &dyn Fn(f64, f64) -> f64| {
        let mut errors = Vec::new();
        for (k, (amplitude, length)) in cases.into_iter().enumerate() {
            let found = curved_walls::gradient(length, amplitude, 96.max((8.0 * length) as usize))?;
            errors.push((limit(length, amplitude) / found - 1.0).abs());
            let order =
                if k == 0 { String::new() } else { format!("{:.2}", order(&steps[k - 1..=k], &errors[k - 1..=k])) };
            limits.push([
                name.to_owned(),
                amplitude.to_string(),
                length.to_string(),
                format!("{:.2e}", errors[k]),
                order,
            ]);
        }
        Ok::<(), motile_tests::validation::StudyError>(())
    };
    let small = [0.2, 0.1, 0.05];
    series("second power of a", small.map(|a| (a, 6.0)), small, &curved_walls::small_amplitude)?;
    let long = [12.0, 24.0, 48.0];
    series("lubrication", long.map(|l| (0.3, l)), long.map(|l| 1.0 / l), &|_, a| curved_walls::lubrication(a))?;
    let nodes = [48, 72, 96, 128];
    let mut swimmers = Table::new(
        &format!("Swimmers in a wavy channel: speed at t = {LATE}, difference from that of 128 nodes in %"),
        &["activity", "speed", "48 nodes", "72 nodes", "96 nodes"],
    );
    for activity in if quick { &[-3.0][..] } else { &[-3.0, -4.0, -5.0] } {
        let speeds = nodes.map(|nodes| curved_walls::speed(*activity, nodes, LATE));
        let speeds = speeds.into_iter().collect::<Result<Vec<_>, _>>()?;
        let finest = speeds[nodes.len() - 1];
        let off = speeds[..nodes.len() - 1].iter().map(|speed| per_cent(speed / finest - 1.0));
        swimmers.push([activity.to_string(), format!("{finest:.5}")].into_iter().chain(off));
    }
    Ok(vec![exact, films, limits, swimmers])
}
