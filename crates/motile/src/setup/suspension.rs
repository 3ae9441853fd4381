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

/// Halvings of an interval of factors, down to round-off.
const BISECTIONS: u32 = 60;
/// Most droplets of a suspension.
const MOST: usize = 100_000;
/// Largest relative difference between the area fraction that is given and the one that is reached.
const OFF: f64 = 0.02;
/// Fraction of the area that the densest packing of equal circles fills.
const DENSEST: f64 = 0.9069;

/// Many round droplets in a box or a channel, for which [`Setup::build`] chooses the places.
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
#[doc(alias("crowd", "collective motion", "many droplets"))]
pub struct SuspensionSetup {
    /// Number of droplets. Give either this or the area fraction.
    pub count: Option<usize>,
    /// Fraction of the region's area that the droplets fill (no dimension). Radii that differ are scaled together,
    /// within their bounds, to reach it. Equal circles reach the nearest fraction that a whole number of them fills,
    /// which is refused if it is off by more than 2 %. [`Setup::filled`] returns it.
    pub area_fraction: Option<f64>,
    /// Radii (length); `None` for the radius of the droplet.
    pub radius: Option<Distribution>,
    /// Activities (force times length); `None` for the activity of the droplet.
    pub activity: Option<Distribution>,
    /// Viscosities inside (stress times time); `None` for the viscosity of the droplet.
    pub viscosity: Option<Distribution>,
    /// Directions of swimming at the start.
    pub headings: Headings,
    /// Places at the start.
    pub arrangement: Arrangement,
    /// Minimum gap between droplets and from walls at the start (length).
    pub gap: f64,
    /// Seed of all that is random; equal seeds give equal suspensions.
    pub seed: u64,
    /// Everything else about the droplets, which are round. They are named after it, with numbers.
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
#[non_exhaustive]
pub enum Headings {
    /// Any, equally likely.
    Random,
    /// This one (radians from the x axis).
    Aligned(f64),
}

/// Places of the droplets of a suspension at the start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Arrangement {
    /// Random sequential placement: each droplet is put at a random place that is free. Droplets that find none within
    /// a hundred tries overlap others, and then all are moved apart until the gaps are as wide as required. This can
    /// fill about 0.7 of the area.
    Random,
    /// A hexagonal or rectangular lattice, whichever has the largest distances. Some sites may stay empty.
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
    /// Returns the description with the droplets of its suspensions in its list of droplets, behind those that it has.
    /// Places keep the suspensions' gaps from one another and from the round droplets of the list. They ignore solids,
    /// obstacles and droplets of other shapes, and [`Setup::build`] refuses what overlaps them.
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
    /// Returns [`SetupError::Value`] for values out of their range, a region that has no area, droplets for which no
    /// places were found.
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

    /// Returns the fraction of the region's area that the round droplets fill, including suspensions (no dimension);
    /// `None` without suspensions.
    ///
    /// ```
    /// use motile::prelude::*;
    /// use motile::setup::{Distribution, SuspensionSetup};
    ///
    /// let radius = Some(Distribution::Between([0.8, 1.2]));
    /// let suspension = SuspensionSetup { area_fraction: Some(0.3), radius, ..SuspensionSetup::default() };
    /// let setup = Setup { droplets: Vec::new(), suspension: vec![suspension], ..Setup::default() };
    /// assert!((setup.filled()?.unwrap() - 0.3).abs() < 1e-9);
    /// # Ok::<(), motile::SetupError>(())
    /// ```
    ///
    /// # Errors
    /// Returns the errors of [`Setup::placed`].
    pub fn filled(&self) -> Result<Option<f64>, SetupError> {
        if self.suspension.is_empty() {
            return Ok(None);
        }
        let ([length, width], placed) = (self.region.lengths(), self.placed()?);
        let squares: f64 = placed.droplets.iter().map(|droplet| radius(droplet).powi(2)).sum();
        Ok(Some(PI * squares / (length * width)))
    }

    /// Refuses suspensions of values out of their range, and if there is no area to fill.
    pub(super) fn check_suspensions(&self) -> Result<(), SetupError> {
        for (number, suspension) in self.suspension.iter().enumerate() {
            if !matches!(self.region, Region::Box { .. } | Region::Channel { .. } | Region::SlipChannel { .. }) {
                let remedy = "a suspension needs a box or a channel to fill. Use one of these";
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
                    "a region of {length} x {width} has no room for such a droplet and a gap of {gap}. Use a smaller \
                     radius or a larger region"
                );
                return Checked { place: &format!("suspension[{number}]") }.refuse("radius", &radius, remedy);
            }
        }
        let filled: f64 = circles.iter().map(|circle| PI * circle.extent() * circle.extent()).sum();
        if filled > DENSEST * length * width { self.crowded() } else { Ok(()) }
    }

    /// Returns the error of suspensions for which there are no places.
    fn crowded<T>(&self) -> Result<T, SetupError> {
        let [length, width] = self.region.lengths();
        let suspension = &self.suspension[0];
        let remedy = format!(
            "no places were found in a region of {length} x {width} with gaps of {}. Use fewer droplets, \
             a larger region or smaller gaps",
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
    /// Returns the radii (length): its own, or the radius of its droplet.
    fn radii(&self) -> Distribution {
        match (self.radius, &self.droplet.shape) {
            (Some(radius), _) => radius,
            (None, &DropletShape::Round { radius }) => Distribution::Value(radius),
            (None, _) => Distribution::Value(0.0),
        }
    }

    /// Returns the mean area of its droplets (length squared).
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

    /// Returns the area of its droplets, whose number is given, by the radii that its seed draws (length squared).
    #[must_use]
    pub fn area(&self) -> f64 {
        // Which region it is has no influence on the radii.
        let droplets = self.draw(&Region::Plane).droplets;
        PI * droplets.iter().map(|droplet| radius(droplet).powi(2)).sum::<f64>()
    }

    /// Returns the number of droplets in a region.
    fn number(&self, region: &Region) -> f64 {
        let [length, width] = region.lengths();
        let of_area = |fraction: f64| (fraction * length * width / self.mean_area()).round();
        self.count.map_or_else(|| of_area(self.area_fraction.unwrap_or_default()), |count| count as f64)
    }

    /// Returns the area that a fraction of a region is, over the area of a circle of radius one.
    fn squares(fraction: f64, region: &Region) -> f64 {
        let [length, width] = region.lengths();
        fraction * length * width / PI
    }

    /// Refuses a fraction from which the nearest one that its radii reach is too far.
    fn check_reached(&self, checked: &Checked<'_>, region: &Region, fraction: f64) -> Result<(), SetupError> {
        let ([least, most], wanted) = (self.radii().bounds(), Self::squares(fraction, region));
        let of = |count: f64| wanted.clamp(count * least * least, count * most * most) / wanted * fraction;
        let count = self.number(region);
        let reached = of(count);
        if (reached / fraction - 1.0).abs() <= OFF {
            return Ok(());
        }
        let other = if reached < fraction { count + 1.0 } else { count - 1.0 };
        let alternative =
            if other > 0.0 { format!("and {other} fill {:.3}", of(other)) } else { "and fewer fill none".to_owned() };
        let remedy = format!(
            "{count} droplets fill {reached:.3} of the area, {alternative}, which is off by more than {} %. Use one \
             of these, another region, or other radii",
            100.0 * OFF
        );
        checked.refuse("area-fraction", &fraction, remedy)
    }

    fn check(&self, checked: &Checked<'_>, setup: &Setup) -> Result<(), SetupError> {
        let DropletSetup { shape, centre, angle, particles, .. } = &self.droplet;
        for (key, value) in [("centre[0]", centre[0]), ("centre[1]", centre[1]), ("angle", *angle)] {
            let remedy = "the suspension sets places and directions. Remove this key";
            checked.require(value == 0.0, &format!("droplet.{key}"), value, remedy)?;
        }
        let round = matches!(shape, DropletShape::Round { .. });
        checked.refuse_if(!round, "droplet.shape", "not round", "a suspension consists of circles. Use shape.round")?;
        setup.able(&self.droplet)?;
        self.droplet.check(&Checked { place: &format!("{}.droplet", checked.place) }, setup)?;
        for (key, values) in [("radius", self.radius), ("viscosity", self.viscosity)] {
            values.map_or(Ok(()), |values| values.check(checked, key, true))?;
        }
        if let Some(activity) = self.activity {
            activity.check(checked, "activity", false)?;
            let remedy = "droplets without particles have no activity. Remove the key, or add droplet.particles";
            checked.refuse_if(particles.is_none(), "activity", activity, remedy)?;
        }
        checked.not_negative("gap", self.gap)?;
        if let Headings::Aligned(angle) = self.headings {
            checked.finite("headings.aligned", angle)?;
        }
        match (self.count, self.area_fraction) {
            (Some(count), None) => {
                let remedy = format!("use a number from 1 to {MOST}");
                checked.refuse_if(!(1..=MOST).contains(&count), "count", count, remedy)
            }
            (None, Some(fraction)) => {
                let remedy =
                    format!("use a number above 0 and below {DENSEST}, the area fraction of the densest packing");
                checked.refuse_if(!(fraction > 0.0 && fraction < DENSEST), "area-fraction", fraction, remedy)?;
                let count = self.number(&setup.region);
                let remedy = format!("this makes {count} droplets. Use a fraction that makes 1 to {MOST}");
                checked.refuse_if(!(1.0..=MOST as f64).contains(&count), "area-fraction", fraction, remedy)?;
                self.check_reached(checked, &setup.region, fraction)
            }
            (Some(count), Some(_)) => {
                let remedy = "area-fraction sets the number of droplets as well. Use only one of the two keys";
                checked.refuse("count", &count, remedy)
            }
            (None, None) => {
                checked.refuse("count", &"none", "the number of droplets is missing. Add count or area-fraction")
            }
        }
    }

    /// Returns the droplets at no places yet, with values from their distributions.
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
        let mut droplets: Vec<DropletSetup> = droplets.collect();
        if let (Some(fraction), Distribution::Between(_) | Distribution::Normal { .. }) = (self.area_fraction, radii) {
            fill(&mut droplets, radii.bounds(), Self::squares(fraction, region));
        }
        Drawn { droplets, random, gap: self.gap, arrangement: self.arrangement }
    }
}

/// Returns the radius of a round droplet (length).
fn radius(droplet: &DropletSetup) -> f64 {
    if let DropletShape::Round { radius } = droplet.shape { radius } else { 0.0 }
}

/// Scales the radii of droplets, within bounds (length), so that their squares add up to `wanted` (length squared), or
/// come as near to it as the bounds let them.
fn fill(droplets: &mut [DropletSetup], [least, most]: [f64; 2], wanted: f64) {
    let scaled = |droplet: &DropletSetup, factor: f64| (factor * radius(droplet)).clamp(least, most);
    let sum = |factor: f64| droplets.iter().map(|droplet| scaled(droplet, factor).powi(2)).sum::<f64>();
    let (mut low, mut high) = (least / most, most / least);
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if sum(middle) < wanted { low = middle } else { high = middle }
    }
    for droplet in droplets {
        *droplet = droplet.clone().with_radius(scaled(droplet, high));
    }
}

/// Returns a round droplet as a circle that keeps a gap (length), or that stays where it is.
fn circle(droplet: &DropletSetup, gap: Option<f64>) -> Option<Circle> {
    let DropletShape::Round { radius } = droplet.shape else { return None };
    Some(Circle { place: droplet.centre.into(), radius, gap: gap.unwrap_or_default(), fixed: gap.is_none() })
}

#[cfg(test)]
mod tests;
