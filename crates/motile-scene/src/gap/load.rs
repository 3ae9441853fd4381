//! Load of a repulsion.

use super::{Films, Repulsion, Surfaces, films::Contact};
use motile_base::Vec2;

/// Load of a repulsion in a state: its share of the stress, and the films that it holds.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct RepulsionLoad {
    /// Sum over pairs of bodies of `r F` (force times length): r from the mean place of the other body's corners to the
    /// mean place of the one that the force F acts on. Over the area of a box it is minus the stress that forces
    /// between bodies transmit (Batchelor 1977), half of its trace the pressure.
    pub virial: [[f64; 2]; 2],
    /// Largest pressure on a surface (force per length).
    pub largest_pressure: f64,
    /// Mean thickness of the films within its range (length), weighted with the force; `None` if there is none.
    pub mean_film: Option<f64>,
    /// Length of all surfaces within its range (length).
    pub length: f64,
}

impl Films {
    /// Returns the load of a repulsion on the films that were found last, within its range at least.
    pub(crate) fn load(&self, repulsion: &Repulsion, surfaces: &Surfaces) -> RepulsionLoad {
        let middles: Vec<Vec2> = surfaces
            .boundaries
            .iter()
            .map(|boundary| {
                let [sum, count] =
                    boundary.corners().fold([Vec2::ZERO; 2], |[sum, count], at| [sum + at, count + Vec2::X]);
                sum / count.x.max(1.0)
            })
            .collect();
        let mut load = RepulsionLoad { virial: [[0.0; 2]; 2], largest_pressure: 0.0, mean_film: None, length: 0.0 };
        let [mut films, mut forces] = [0.0; 2];
        for contact in self.contacts().filter(|contact| contact.gap < repulsion.range()) {
            let Contact { corner, ends, part, normal, gap } = *contact;
            let (length, pressure) = (self.weights[corner], repulsion.pressure(gap));
            let force = contact.share() * length * pressure;
            load.largest_pressure = load.largest_pressure.max(pressure);
            load.length += length;
            (films, forces) = (films + force * gap, forces + force);
            let Some([start, end]) = ends else { continue };
            let [(body, at), (other, from), (_, to)] = [corner, start, end].map(|corner| surfaces.place(corner));
            // Each place from the middle of its own body: images need not be told apart.
            let branch = (middles[body] - at) + gap * normal + (from.lerp(to, part) - middles[other]);
            for (row, r) in load.virial.iter_mut().zip(branch.to_array()) {
                row.iter_mut().zip((force * normal).to_array()).for_each(|(sum, f)| *sum += r * f);
            }
        }
        load.mean_film = (forces > 0.0).then(|| films / forces);
        load
    }
}

impl Surfaces {
    /// Returns the body of a corner, and where it is (length).
    fn place(&self, corner: usize) -> (usize, Vec2) {
        let body = self.firsts.partition_point(|&first| first <= corner).saturating_sub(1);
        (body, self.boundaries[body].sides()[corner - self.firsts[body]][0])
    }
}
