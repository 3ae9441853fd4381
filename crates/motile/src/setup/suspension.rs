//! Descriptions of suspensions: many droplets at random places or on a lattice.

mod cells;
mod distribution;
mod lattice;
mod placement;

use std::f64::consts::{PI, TAU};

use active_interface::internal::SplitMix64;
use motile_base::Region;
use serde::{Deserialize, Serialize};

pub use distribution::Distribution;

use super::{DropletSetup, DropletShape, Setup, Start, body::BodySetup, checked::Checked};
use crate::SetupError;
use lattice::sites;
use placement::{Circle, Room};

/// Most droplets of a suspension.
const MOST: usize = 100_000;
/// Part of the area that the densest packing of equal circles fills.
const DENSEST: f64 = 0.9069;

/// Many round droplets in a box or a channel, which [`Setup::build`] puts at places of its own choice.
///
/// ```
/// use motile::prelude::*;
/// use motile::setup::{Distribution, SuspensionSetup};
///
/// let suspension = SuspensionSetup {
///     area_fraction: Some(0.4),
///     radius: Some(Distribution::Between([0.8, 1.2])),
///     ..SuspensionSetup::default()
/// };
/// let region = Region::Box { lengths: [12.0, 12.0] };
/// let setup = Setup { region, droplets: Vec::new(), suspension: vec![suspension], ..Setup::default() };
/// assert_eq!(setup.build()?.droplets.len(), 18);
/// # Ok::<(), motile::SetupError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct SuspensionSetup {
    /// Number of droplets; this or the part of the area is given.
    pub count: Option<usize>,
    /// Part of the region's area that the droplets fill, by the mean of their areas (no dimension).
    pub area_fraction: Option<f64>,
    /// Radii (length); `None` for that of the droplet.
    pub radius: Option<Distribution>,
    /// Activities (force times length); `None` for that of the droplet.
    pub activity: Option<Distribution>,
    /// Viscosities inside (stress times time); `None` for that of the droplet.
    pub viscosity: Option<Distribution>,
    /// Directions of swimming at the start.
    pub headings: Headings,
    /// Places at the start.
    pub arrangement: Arrangement,
    /// Least gap between droplets and from walls at the start (length).
    pub gap: f64,
    /// Seed of all that is random; equal seeds give equal suspensions.
    pub seed: u64,
    /// All else about the droplets, which are round; they are named after it, with numbers.
    pub droplet: DropletSetup,
}

impl Default for SuspensionSetup {
    /// Droplets like the default one at random places and in random directions, 0.05 apart, as many as are given.
    fn default() -> Self {
        Self {
            count: None,
            area_fraction: None,
            radius: None,
            activity: None,
            viscosity: None,
            headings: Headings::Random,
            arrangement: Arrangement::Random,
            gap: 0.05,
            seed: 1,
            droplet: DropletSetup::default(),
        }
    }
}

/// Directions of swimming of the droplets of a suspension at the start.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Headings {
    /// Any, equally likely.
    Random,
    /// This one (radians from the x axis).
    Aligned(f64),
}

/// Places of the droplets of a suspension at the start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Arrangement {
    /// Random sequential placement: each droplet at a random place that is free; those that find none within a hundred
    /// tries lie across others, and then all are moved apart until there are the gaps that were asked for. Some 0.7 of
    /// the area can be filled so.
    Random,
    /// A hexagonal or rectangular lattice, that with the largest distances, some sites of which may stay empty.
    Lattice,
}

/// Droplets of a suspension that have not been placed yet, with the generator of their places.
struct Drawn {
    droplets: Vec<DropletSetup>,
    random: SplitMix64,
    gap: f64,
    arrangement: Arrangement,
}

impl Setup {
    /// The description with the droplets of its suspensions in its list of droplets, behind those that it has. Places
    /// keep the suspensions' gaps from one another and from the round droplets of the list; solids, obstacles and
    /// droplets of other shapes are not seen, and [`Setup::build`] refuses what overlaps them.
    ///
    /// ```
    /// use motile::setup::{Setup, SuspensionSetup};
    ///
    /// let suspension = vec![SuspensionSetup { count: Some(5), ..SuspensionSetup::default() }];
    /// let placed = Setup { droplets: Vec::new(), suspension, ..Setup::default() }.placed()?;
    /// assert_eq!((placed.droplets.len(), placed.suspension.len()), (5, 0));
    /// # Ok::<(), motile::SetupError>(())
    /// ```
    ///
    /// # Errors
    /// [`SetupError::Value`]: values out of their range, a region that has no area, droplets for which no places were
    /// found.
    pub fn placed(&self) -> Result<Self, SetupError> {
        if self.suspension.is_empty() {
            return Ok(self.clone());
        }
        self.check_suspensions()?;
        let mut all = self.suspension.iter().map(|suspension| suspension.draw(&self.region)).collect::<Vec<_>>();
        let mut circles: Vec<Circle> = self.droplets.iter().filter_map(|droplet| circle(droplet, None)).collect();
        let first = circles.len();
        for Drawn { droplets, gap, .. } in &all {
            circles.extend(droplets.iter().filter_map(|droplet| circle(droplet, Some(*gap))));
        }
        self.check_room(&circles)?;
        let mut room = Room::new(&self.region, &circles);
        let mut start = first;
        for Drawn { droplets, random, arrangement, .. } in &mut all {
            let own = start..start + droplets.len();
            match arrangement {
                Arrangement::Random => room.place_at_random(&mut circles, own.clone(), random),
                Arrangement::Lattice => {
                    let margin = circles[own.clone()].iter().map(|circle| circle.radius + circle.gap);
                    let sites = sites(&self.region, own.len(), margin.fold(0.0, f64::max), random);
                    circles[own.clone()].iter_mut().zip(sites).for_each(|(circle, site)| circle.place = site);
                }
            }
            start = own.end;
        }
        if !room.move_apart(&mut circles) {
            return self.crowded();
        }
        let mut placed = Self { suspension: Vec::new(), ..self.clone() };
        let droplets = all.into_iter().flat_map(|drawn| drawn.droplets);
        placed.droplets.extend(
            droplets
                .zip(&circles[first..])
                .map(|(droplet, circle)| DropletSetup { centre: circle.place.into(), ..droplet }),
        );
        Ok(placed)
    }

    /// Refuses suspensions of values out of their range, and where there is no area to fill.
    pub(super) fn check_suspensions(&self) -> Result<(), SetupError> {
        for (number, suspension) in self.suspension.iter().enumerate() {
            if !matches!(self.region, Region::Box { .. } | Region::Channel { .. }) {
                let remedy = "suspensions fill a box or a channel: give one of these";
                let region = if self.region == Region::Plane { "plane" } else { "three-dimensional" };
                return Checked { place: "" }.refuse("region", &region, remedy);
            }
            suspension.check(&Checked { place: &format!("suspension[{number}]") }, self)?;
        }
        Ok(())
    }

    /// Refuses circles that the region cannot hold, before places are looked for.
    fn check_room(&self, circles: &[Circle]) -> Result<(), SetupError> {
        let [length, width] = self.region.lengths();
        let walls = if self.region.periods()[1].is_some() { 1.0 } else { 2.0 };
        for (number, suspension) in self.suspension.iter().enumerate() {
            let ([_, radius], gap) = (suspension.radii().bounds(), suspension.gap);
            if 2.0 * radius + gap > length || 2.0 * radius + walls * gap > width {
                let remedy = format!(
                    "a region of {length} x {width} has no room for it and a gap of {gap}: give less, or a larger \
                     region"
                );
                return Checked { place: &format!("suspension[{number}]") }.refuse("radius", &radius, remedy);
            }
        }
        let filled: f64 = circles.iter().map(|circle| PI * circle.extent() * circle.extent()).sum();
        if filled > DENSEST * length * width { self.crowded() } else { Ok(()) }
    }

    /// Error of suspensions for which there are no places.
    fn crowded<T>(&self) -> Result<T, SetupError> {
        let [length, width] = self.region.lengths();
        let suspension = &self.suspension[0];
        let remedy = format!(
            "no places were found in a region of {length} x {width} with gaps of {}: give less, a larger region or \
             smaller gaps",
            suspension.gap
        );
        let checked = Checked { place: "suspension[0]" };
        match (suspension.count, suspension.area_fraction) {
            (None, Some(fraction)) => checked.refuse("area-fraction", &fraction, remedy),
            (count, _) => checked.refuse("count", &count.unwrap_or_default(), remedy),
        }
    }
}

impl SuspensionSetup {
    /// The radii (length): its own, or that of its droplet.
    fn radii(&self) -> Distribution {
        match (self.radius, &self.droplet.shape) {
            (Some(radius), _) => radius,
            (None, &DropletShape::Round { radius }) => Distribution::Value(radius),
            (None, _) => Distribution::Value(0.0),
        }
    }

    /// Mean area of its droplets (length squared).
    ///
    /// ```
    /// use motile::setup::{Distribution, SuspensionSetup};
    ///
    /// let suspension = SuspensionSetup { radius: Some(Distribution::Value(2.0)), ..SuspensionSetup::default() };
    /// assert_eq!(suspension.mean_area(), 4.0 * std::f64::consts::PI);
    /// ```
    #[must_use]
    pub fn mean_area(&self) -> f64 {
        PI * self.radii().mean_square()
    }

    /// Number of droplets in a region.
    fn number(&self, region: &Region) -> f64 {
        let [length, width] = region.lengths();
        let of_area = |fraction: f64| (fraction * length * width / self.mean_area()).round();
        self.count.map_or_else(|| of_area(self.area_fraction.unwrap_or_default()), |count| count as f64)
    }

    fn check(&self, checked: &Checked<'_>, setup: &Setup) -> Result<(), SetupError> {
        let DropletSetup { shape, centre, angle, particles, .. } = &self.droplet;
        for (key, value) in [("centre[0]", centre[0]), ("centre[1]", centre[1]), ("angle", *angle)] {
            let remedy = "places and directions are those of the suspension: leave it out";
            checked.require(value == 0.0, &format!("droplet.{key}"), value, remedy)?;
        }
        if !matches!(shape, DropletShape::Round { .. }) {
            return checked.refuse("droplet.shape", &"not round", "suspensions are of circles: give shape.round");
        }
        setup.able(&self.droplet)?;
        self.droplet.check(&Checked { place: &format!("{}.droplet", checked.place) }, setup)?;
        for (key, values) in [("radius", self.radius), ("viscosity", self.viscosity)] {
            values.map_or(Ok(()), |values| values.check(checked, key, true))?;
        }
        if let Some(activity) = self.activity {
            activity.check(checked, "activity", false)?;
            if particles.is_none() {
                let remedy = "droplets without particles have none: leave it out, or give droplet.particles";
                return checked.refuse("activity", &activity, remedy);
            }
        }
        checked.not_negative("gap", self.gap)?;
        if let Headings::Aligned(angle) = self.headings {
            checked.finite("headings.aligned", angle)?;
        }
        match (self.count, self.area_fraction) {
            (Some(count), None) => {
                if !(1..=MOST).contains(&count) {
                    return checked.refuse("count", &count, format!("give a number from 1 to {MOST}"));
                }
            }
            (None, Some(fraction)) => {
                if !(fraction > 0.0 && fraction < DENSEST) {
                    let remedy = format!("give a number above 0 and below {DENSEST}, that of the densest packing");
                    return checked.refuse("area-fraction", &fraction, remedy);
                }
                let count = self.number(&setup.region);
                if !(1.0..=MOST as f64).contains(&count) {
                    let remedy = format!("it makes {count} droplets: give what makes 1 to {MOST}");
                    return checked.refuse("area-fraction", &fraction, remedy);
                }
            }
            (Some(count), Some(_)) => {
                let remedy = "area-fraction says how many there are as well: give one of the two";
                return checked.refuse("count", &count, remedy);
            }
            (None, None) => {
                return checked.refuse("count", &"none", "give how many droplets there are, or area-fraction");
            }
        }
        Ok(())
    }

    /// The droplets at no places yet, with values from their distributions.
    fn draw(&self, region: &Region) -> Drawn {
        let mut random = SplitMix64::new(self.seed);
        let radii = self.radii();
        let droplets = (0..self.number(region) as usize).map(|number| {
            let angle = match self.headings {
                Headings::Random => TAU * random.uniform() - PI,
                Headings::Aligned(angle) => angle,
            };
            let mut droplet = self.droplet.clone().with_radius(radii.draw(&mut random));
            droplet.angle = angle;
            droplet.name = format!("{} {}", self.droplet.name, number + 1);
            droplet.viscosity = self.viscosity.map(|values| values.draw(&mut random)).or(droplet.viscosity);
            if let Some(particles) = &mut droplet.particles {
                particles.activity = self.activity.map_or(particles.activity, |values| values.draw(&mut random));
                if let Start::Perturbed { seed, .. } = &mut particles.start {
                    // Perturbations of their own.
                    *seed = seed.wrapping_add(number as u64);
                }
            }
            droplet
        });
        let droplets = droplets.collect();
        Drawn { droplets, random, gap: self.gap, arrangement: self.arrangement }
    }
}

/// A round droplet as a circle that keeps a gap (length), or that stays where it is.
fn circle(droplet: &DropletSetup, gap: Option<f64>) -> Option<Circle> {
    let DropletShape::Round { radius } = droplet.shape else { return None };
    Some(Circle { place: droplet.centre.into(), radius, gap: gap.unwrap_or_default(), fixed: gap.is_none() })
}

#[cfg(test)]
mod tests;
