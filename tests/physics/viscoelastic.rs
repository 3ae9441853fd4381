//! Viscoelastic layers on the walls of a channel against exact solutions.

use motile_tests::validation::viscoelastic::{Layers, Motion};

const LAYERS: Layers = Layers { springs: false, layered: false, moduli: [20.0, 60.0], time: 0.5, thickness: 0.6 };

const MOTIONS: [Motion; 7] = [
    Motion::Relaxation,
    Motion::Sum,
    Motion::Difference,
    Motion::StartUp,
    Motion::Creep,
    Motion::Oscillation(2.0),
    Motion::Oscillation(20.0),
];

/// First order in the spacing h of the grid, as of elastic layers: errors below half of h over the thickness.
#[test]
fn motions_of_layers_are_the_exact_ones() {
    for motion in MOTIONS {
        let [coarse, fine] = [0.2, 0.1].map(|h| LAYERS.compare(motion, h, 100).unwrap());
        let order = (coarse / fine).log2();
        assert!(
            fine < 0.5 * 0.1 / LAYERS.thickness && (0.85..1.25).contains(&order),
            "{motion:?}: {coarse:e} {fine:e}, order {order}"
        );
    }
}

/// Springs, and surfaces that carry layers, with which triangles err by the time step alone.
#[test]
fn springs_and_layered_surfaces_relax_at_the_exact_rates() {
    let smeared = 0.5 * 0.1 / LAYERS.thickness;
    for (springs, layered, bound) in [(true, false, smeared), (false, true, 5e-4), (true, true, 0.02)] {
        for motion in [Motion::Relaxation, Motion::StartUp] {
            for time in [0.05, 5.0] {
                let layers = Layers { springs, layered, time, ..LAYERS };
                let error = layers.compare(motion, 0.1, 100).unwrap();
                assert!(error < bound, "{springs} {layered} {motion:?} {time}: {error}");
            }
        }
    }
}
