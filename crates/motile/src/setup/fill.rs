//! Droplets at random places.

use std::f64::consts::{PI, TAU};

use active_interface::SplitMix64;
use motile_base::{Region, Vec2};

use super::checked::Checked;
use super::droplet::{DropletSetup, DropletShape};
use crate::SetupError;

/// Least distance between droplets, and from walls, over the radius.
const FILM: f64 = 0.05;
/// Rounds in which droplets that overlap are moved apart.
const ROUNDS: usize = 4000;
/// Most droplets.
const MOST: f64 = 1000.0;

impl DropletSetup {
    /// Copies of this round droplet that fill a part of the area of a box or a channel (no dimension), at random places
    /// and in random directions that the seed determines, films of a twentieth of the radius and more between them.
    ///
    /// Droplets start anywhere and are moved apart until none is too close to another one, its images or a straight
    /// wall; up to some 0.7 of the area can be filled so. Solids and rigid walls of other shapes are not seen:
    /// [`Setup::build`](crate::setup::Setup::build) refuses what overlaps them.
    ///
    /// ```
    /// use motile::prelude::*;
    ///
    /// let region = Region::Box { lengths: [12.0, 12.0] };
    /// let droplets = DropletSetup::active(-2.0).filling(&region, 0.4, 1)?;
    /// let setup = Setup { region, droplets, ..Setup::default() };
    /// assert_eq!(setup.build()?.droplets.len(), 18);
    /// assert!(DropletSetup::active(-2.0).filling(&region, 0.95, 1).is_err());
    /// # Ok::<(), motile::SetupError>(())
    /// ```
    ///
    /// # Errors
    /// [`SetupError::Value`]: a droplet that is not round, the plane, a fraction that is none, that leaves no whole
    /// droplet or that no place was found for.
    pub fn filling(&self, region: &Region, fraction: f64, seed: u64) -> Result<Vec<Self>, SetupError> {
        let checked = Checked { place: "" };
        let DropletShape::Round { radius } = self.shape else {
            return checked.refuse("shape", &"not round", "only circles are put at random places: give shape.round");
        };
        checked.positive("shape.round.radius", radius)?;
        let lengths = region.lengths();
        if *region == Region::Plane {
            return checked.refuse("region", &"plane", "an unbounded region cannot be filled: give a box or a channel");
        }
        let count = (fraction * lengths[0] * lengths[1] / (PI * radius * radius)).round();
        if !(1.0..=MOST).contains(&count) {
            let remedy = format!("it makes {count} droplets of radius {radius}: give what makes 1 to {MOST}");
            return checked.refuse("area fraction", &fraction, remedy);
        }
        let mut random = SplitMix64::new(seed);
        let mut anywhere = |length: f64| (random.uniform() - 0.5) * length;
        let starts: Vec<[f64; 3]> =
            (0..count as usize).map(|_| [lengths[0], lengths[1], TAU].map(&mut anywhere)).collect();
        let mut places: Vec<Vec2> = starts.iter().map(|&[x, y, _]| Vec2::new(x, y)).collect();
        if !moved_apart(&mut places, region, radius) {
            let remedy = format!("no places were found for {count} droplets of radius {radius}: give less");
            return checked.refuse("area fraction", &fraction, remedy);
        }
        let placed = places.iter().zip(&starts).enumerate().map(|(number, (place, &[_, _, angle]))| {
            let name = format!("{} {}", self.name, number + 1);
            Self { name, centre: [place.x, place.y], angle, ..self.clone() }
        });
        Ok(placed.collect())
    }
}

/// Moves circles apart until there is a film between any two of them and at walls; false where that fails.
fn moved_apart(places: &mut [Vec2], region: &Region, radius: f64) -> bool {
    let [length, width] = region.lengths();
    let periods = region.periods();
    let least = (2.0 + FILM) * radius;
    let inner = 0.5 * width - (1.0 + FILM) * radius;
    let walls = periods[1].is_none();
    if length.min(if walls { f64::INFINITY } else { width }) < least || (walls && inner < 0.0) {
        return false;
    }
    for _ in 0..ROUNDS {
        let mut apart = true;
        for i in 0..places.len() {
            for j in 0..i {
                let mut between = places[i] - places[j];
                between.x -= length * (between.x / length).round();
                if !walls {
                    between.y -= width * (between.y / width).round();
                }
                let distance = between.length();
                if distance < least {
                    apart = false;
                    // A little more than needed, so that a finite number of rounds is enough.
                    let direction = if distance > 0.0 { between * (1.0 / distance) } else { Vec2::new(1.0, 0.0) };
                    let step = direction * (0.5 * (1.01 * least - distance));
                    places[i] += step;
                    places[j] -= step;
                }
            }
        }
        for place in places.iter_mut() {
            place.x -= length * (place.x / length).round();
            if walls {
                apart &= place.y.abs() <= inner * (1.0 + 1e-12);
                place.y = place.y.clamp(-inner, inner);
            } else {
                place.y -= width * (place.y / width).round();
            }
        }
        if apart {
            return true;
        }
    }
    false
}
