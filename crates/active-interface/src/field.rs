//! Fields that interfaces feel: numbers that depend on place and time, fixed in the laboratory.

mod felt;
mod table;

use std::{
    f64::consts::TAU,
    fmt,
    ops::{Add, AddAssign},
    sync::Arc,
};

use motile_base::{Vec2, finite, positive};

use crate::InterfaceError;
pub use felt::Fields;
pub(crate) use felt::{Felt, middles_of};
pub use table::Table;

/// A field: a number as a function of place and time, fixed in the laboratory.
///
/// Interfaces feel it where they are, by their unwrapped positions. A gradient therefore continues to rise where a
/// droplet crosses the side of a periodic box. Spots and tables repeat along periodic directions ([`Field::periodic`]).
///
/// ```
/// use active_interface::{Field, Vec2};
/// use active_interface::field::Modulation;
///
/// let gradient = Field::gradient(Vec2::new(0.5, 0.0), Vec2::ZERO)?;
/// let beat = Field::uniform(1.0)?.modulated(Modulation { frequency: 2.0, ..Modulation::default() })?;
/// let sum = gradient + beat;
/// assert_eq!(sum.value(Vec2::new(3.0, 1.0), 0.0), 2.5);
/// # Ok::<(), active_interface::InterfaceError>(())
/// ```
#[derive(Debug, Clone, Default)]
#[doc(alias("gradient", "light", "temperature", "chemotaxis", "thermocapillary"))]
pub struct Field {
    terms: Vec<Term>,
    periods: [Option<f64>; 2],
}

/// A factor `mean + amplitude cos(frequency t + phase)` of a field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Modulation {
    /// Mean of the factor (no dimension).
    pub mean: f64,
    /// Amplitude of the factor (no dimension).
    pub amplitude: f64,
    /// Angular frequency (radians per time).
    pub frequency: f64,
    /// Phase at time 0 (radians).
    pub phase: f64,
}

impl Default for Modulation {
    /// Creates the factor 1, of a frequency of zero.
    fn default() -> Self {
        Self { mean: 0.0, amplitude: 1.0, frequency: 0.0, phase: 0.0 }
    }
}

impl Modulation {
    fn at(&self, time: f64) -> f64 {
        self.mean + self.amplitude * (self.frequency * time + self.phase).cos()
    }
}

#[derive(Debug, Clone)]
struct Term {
    shape: Shape,
    modulations: Vec<Modulation>,
}

#[derive(Clone)]
enum Shape {
    Uniform(f64),
    Gradient { slope: Vec2, origin: Vec2 },
    Spot { centre: Vec2, radius: f64, amplitude: f64 },
    Wave { amplitude: f64, wave_vector: Vec2, frequency: f64, phase: f64 },
    Table(Arc<Table>),
    Function { value: Arc<dyn Fn(Vec2, f64) -> f64 + Send + Sync>, moves: bool },
}

impl fmt::Debug for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Uniform(value) => write!(f, "uniform {value}"),
            Self::Gradient { slope, origin } => write!(f, "gradient {slope} from {origin}"),
            Self::Spot { centre, radius, amplitude } => write!(f, "spot {amplitude} at {centre}, radius {radius}"),
            Self::Wave { amplitude, wave_vector, frequency, phase } => {
                write!(f, "wave {amplitude} along {wave_vector}, frequency {frequency}, phase {phase}")
            }
            Self::Table(_) => f.write_str("a table"),
            Self::Function { .. } => f.write_str("a function"),
        }
    }
}

/// Standard deviations of a spot within which its images count: beyond, it is below 1e-17 of its amplitude.
const REACH: f64 = 9.0;
/// Largest radius of a spot in periods.
const WIDEST_SPOT: f64 = 1.0;
/// Relative difference of a field over a period that is passed over as round-off.
const SAME: f64 = 1e-8;

fn finite_vector(name: &'static str, vector: Vec2) -> Result<Vec2, InterfaceError> {
    finite(name, vector.x)?;
    finite(name, vector.y)?;
    Ok(vector)
}

/// Returns `exp(-d^2/2)` for the distance d, summed over the images where there is a period (all over the radius).
fn gaussian(distance: f64, period: Option<f64>) -> f64 {
    let one = |d: f64| (-0.5 * d * d).exp();
    let Some(period) = period else { return one(distance) };
    let nearest = distance - period * (distance / period).round();
    let images = (REACH / period).ceil();
    let mut sum = one(nearest);
    let mut image = 1.0;
    while image <= images {
        sum += one(nearest + image * period) + one(nearest - image * period);
        image += 1.0;
    }
    sum
}

impl Field {
    fn of_shape(shape: Shape) -> Self {
        Self { terms: vec![Term { shape, modulations: Vec::new() }], periods: [None; 2] }
    }

    /// Creates the field of one value everywhere, in the unit of what feels it.
    ///
    /// # Errors
    /// Returns an error for a value that is not finite.
    pub fn uniform(value: f64) -> Result<Self, InterfaceError> {
        Ok(Self::of_shape(Shape::Uniform(finite("the value of a field", value)?)))
    }

    /// Creates the field `slope . (x - origin)` of a constant slope (unit of the field per length) that is zero at the
    /// origin (length).
    ///
    /// # Errors
    /// Returns an error for numbers that are not finite.
    pub fn gradient(slope: Vec2, origin: Vec2) -> Result<Self, InterfaceError> {
        let slope = finite_vector("the slope of a field", slope)?;
        Ok(Self::of_shape(Shape::Gradient { slope, origin: finite_vector("the origin of a field", origin)? }))
    }

    /// Creates the Gaussian spot `amplitude exp(-|x - centre|^2/(2 radius^2))` (unit of the field; centre and radius:
    /// length).
    ///
    /// # Errors
    /// Returns an error for numbers that are not finite, a radius that is not positive.
    pub fn spot(centre: Vec2, radius: f64, amplitude: f64) -> Result<Self, InterfaceError> {
        let centre = finite_vector("the centre of a spot", centre)?;
        let radius = positive("the radius of a spot", radius)?;
        Ok(Self::of_shape(Shape::Spot { centre, radius, amplitude: finite("the amplitude of a spot", amplitude)? }))
    }

    /// Creates the travelling wave `amplitude sin(k . x - frequency t + phase)` of the wave vector k (radians per
    /// length) and the angular frequency (radians per time). A frequency of zero makes it stand.
    ///
    /// # Errors
    /// Returns an error for numbers that are not finite.
    pub fn wave(amplitude: f64, wave_vector: Vec2, frequency: f64, phase: f64) -> Result<Self, InterfaceError> {
        let amplitude = finite("the amplitude of a wave", amplitude)?;
        let wave_vector = finite_vector("the wave vector", wave_vector)?;
        let frequency = finite("the frequency of a wave", frequency)?;
        Ok(Self::of_shape(Shape::Wave { amplitude, wave_vector, frequency, phase: finite("the phase", phase)? }))
    }

    /// Creates the field of a table of values, interpolated smoothly.
    #[must_use]
    pub fn table(table: Table) -> Self {
        Self::of_shape(Shape::Table(Arc::new(table)))
    }

    /// Creates the field of a function of the place (length), which is steady.
    pub fn of(value: impl Fn(Vec2) -> f64 + Send + Sync + 'static) -> Self {
        Self::of_shape(Shape::Function { value: Arc::new(move |place, _| value(place)), moves: false })
    }

    /// Creates the field of a function of place (length) and time (time). Time steps do not know how fast it changes:
    /// choose a step that resolves it.
    pub fn of_time(value: impl Fn(Vec2, f64) -> f64 + Send + Sync + 'static) -> Self {
        Self::of_shape(Shape::Function { value: Arc::new(value), moves: true })
    }

    /// Multiplies the field by a factor that depends on time.
    ///
    /// # Errors
    /// Returns an error for numbers that are not finite.
    pub fn modulated(mut self, modulation: Modulation) -> Result<Self, InterfaceError> {
        let Modulation { mean, amplitude, frequency, phase } = modulation;
        for value in [mean, amplitude, frequency, phase] {
            finite("a number of the modulation of a field", value)?;
        }
        self.terms.iter_mut().for_each(|term| term.modulations.push(modulation));
        Ok(self)
    }

    /// Repeats spots and tables with these periods (length) along x and y; `None` for a direction without one.
    ///
    /// # Errors
    /// Returns an error for a wave that does not fit a period, a spot that is wider than a period, a table that does
    /// not cover one period.
    pub fn periodic(mut self, periods: [Option<f64>; 2]) -> Result<Self, InterfaceError> {
        for (axis, period) in periods.into_iter().enumerate() {
            let Some(period) = period else { continue };
            positive("the period of a field", period)?;
            for term in &self.terms {
                match &term.shape {
                    Shape::Wave { wave_vector, .. } => {
                        let turns = wave_vector[axis] * period / TAU;
                        if (turns - turns.round()).abs() > SAME * turns.abs().max(1.0) {
                            let nearest = TAU / period * turns.round();
                            return Err(InterfaceError::wave_does_not_fit(wave_vector[axis], period, nearest));
                        }
                    }
                    Shape::Spot { radius, .. } if *radius > WIDEST_SPOT * period => {
                        return Err(InterfaceError::spot_too_wide(*radius, period));
                    }
                    Shape::Table(table) => table.check_period(axis, period)?,
                    _ => {}
                }
            }
        }
        self.periods = periods;
        Ok(self)
    }

    /// Returns the field (in its own unit) at a place (length) and a time (time).
    #[must_use]
    pub fn value(&self, place: Vec2, time: f64) -> f64 {
        let periods = self.periods;
        let values = self.terms.iter().map(|term| {
            let value = match &term.shape {
                Shape::Uniform(value) => *value,
                Shape::Gradient { slope, origin } => slope.dot(place - *origin),
                Shape::Spot { centre, radius, amplitude } => {
                    let [dx, dy] = [(place.x - centre.x) / radius, (place.y - centre.y) / radius];
                    let along = |period: Option<f64>| period.map(|period| period / radius);
                    amplitude * gaussian(dx, along(periods[0])) * gaussian(dy, along(periods[1]))
                }
                Shape::Wave { amplitude, wave_vector, frequency, phase } => {
                    amplitude * (wave_vector.dot(place) - frequency * time + phase).sin()
                }
                Shape::Table(table) => table.value(place, periods),
                Shape::Function { value, .. } => value(place, time),
            };
            term.modulations.iter().fold(value, |value, modulation| value * modulation.at(time))
        });
        values.sum()
    }

    /// Returns true for a field that changes in time.
    #[must_use]
    pub fn depends_on_time(&self) -> bool {
        self.terms.iter().any(|term| {
            let moves = match &term.shape {
                Shape::Wave { frequency, .. } => *frequency != 0.0,
                Shape::Function { moves, .. } => *moves,
                _ => false,
            };
            moves || term.modulations.iter().any(|modulation| modulation.frequency != 0.0)
        })
    }

    /// Returns the highest angular frequency of the waves and modulations (radians per time), zero without any. That of
    /// functions is not known.
    #[must_use]
    pub fn highest_frequency(&self) -> f64 {
        let frequencies = self.terms.iter().map(|term| {
            let own = if let Shape::Wave { frequency, .. } = term.shape { frequency.abs() } else { 0.0 };
            own + term.modulations.iter().map(|modulation| modulation.frequency.abs()).sum::<f64>()
        });
        frequencies.fold(0.0, f64::max)
    }

    /// Returns true for a field that is its own mirror image in the x axis, so that bodies of revolution can feel it.
    /// Functions are compared at a few places around `size` (length).
    #[must_use]
    pub fn is_symmetric(&self, size: f64) -> bool {
        self.terms.iter().all(|term| match &term.shape {
            Shape::Uniform(_) => true,
            Shape::Gradient { slope, .. } => slope.y == 0.0,
            Shape::Spot { centre, .. } => centre.y == 0.0,
            Shape::Wave { wave_vector, .. } => wave_vector.y == 0.0,
            Shape::Table(table) => table.is_symmetric(),
            Shape::Function { value, .. } => SAMPLES.iter().all(|&[x, y, t]| {
                let [above, below] = [y, -y].map(|y| value(size * Vec2::new(x, y), t));
                (above - below).abs() <= SAME * (above.abs() + below.abs())
            }),
        })
    }

    /// Refuses a field that differs between places (length) and their images `advance` further along x (length).
    pub(crate) fn check_along(&self, places: &[Vec2], advance: f64) -> Result<(), InterfaceError> {
        let period = Vec2::new(advance, 0.0);
        let values = |offset: Vec2| places.iter().map(move |&place| self.value(place + offset, 0.0));
        let (least, most) = values(Vec2::ZERO)
            .fold((f64::INFINITY, 0.0_f64), |(least, most), value| (least.min(value), most.max(value.abs())));
        let slack = SAME * (most + least.abs());
        match values(Vec2::ZERO).zip(values(period)).find(|(here, there)| (here - there).abs() > slack) {
            Some((here, there)) => Err(InterfaceError::field_not_periodic(here, there, advance.abs())),
            None => Ok(()),
        }
    }

    /// Returns values that distinguish this field from others, at some places around `size` (length) and times in units
    /// of `unit` (time).
    pub(crate) fn samples(&self, size: f64, unit: f64) -> impl Iterator<Item = f64> {
        SAMPLES.iter().map(move |&[x, y, t]| self.value(size * Vec2::new(x, y), unit * t))
    }
}

/// Places and times at which fields are compared.
const SAMPLES: [[f64; 3]; 5] =
    [[0.0, 0.0, 0.0], [0.9, 0.4, 0.0], [-0.7, 1.1, 0.3], [2.3, -0.6, 1.7], [-3.1, -1.9, 0.9]];

impl Add for Field {
    type Output = Self;

    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl AddAssign for Field {
    /// Adds another field, whose spots and tables take over the periods of the first.
    fn add_assign(&mut self, other: Self) {
        self.terms.extend(other.terms);
        if self.periods == [None; 2] {
            self.periods = other.periods;
        }
    }
}

#[cfg(test)]
mod tests;
