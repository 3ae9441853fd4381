//! Channels along x between two walls.

mod shapes;
mod width;

use motile_base::{Vec2, finite, within};

use crate::mesh::TriangleMesh;
use crate::mesher::segments::Segments;
use crate::{Interior, Mesher, Outline, SolidError};

pub use shapes::ChannelShape;
pub use width::{Width, width_between};

/// A periodic channel along x: the lines that bound it below and above, and islands between them.
///
/// ```
/// use elastic_solids::{Channel, Mesher, SolidError};
///
/// // A wavy channel, written as two functions of x.
/// let wave = |x: f64| 0.2 * (std::f64::consts::PI * x / 3.0).cos();
/// let channel = Channel::between(-6.0, 12.0, move |x| -1.0 - wave(x), move |x| 1.0 + wave(x))?;
///
/// // Its walls, out to y = -2.5 and 2.5.
/// let walls = channel.walls(-2.5, 2.5, &Mesher::new(0.1)?)?;
/// println!("{}", walls.lower.quality());
/// assert!((walls.lower.area() - 12.0 * 1.5).abs() < 0.01);
/// # Ok::<(), SolidError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Channel {
    lower: Outline,
    upper: Outline,
    islands: Vec<Outline>,
    period: f64,
}

/// Meshes of the walls of a channel.
#[derive(Debug, Clone, PartialEq)]
pub struct Walls {
    /// Mesh of the wall below.
    pub lower: TriangleMesh,
    /// Mesh of the wall above.
    pub upper: TriangleMesh,
    /// Meshes of the islands, in the order of their addition.
    pub islands: Vec<TriangleMesh>,
}

/// Points a period at which lines are sampled to find crossings.
const SAMPLES: f64 = 2000.0;
/// Largest length of all sides and islands together, in periods: a bound on the samples.
const LONGEST: f64 = 200.0;

impl Channel {
    /// Creates a channel between two periodic outlines, which may have corners and overhang.
    ///
    /// # Errors
    /// Returns an error for outlines without or with different periods, that cross or touch, or the wrong way round.
    pub fn new(lower: Outline, upper: Outline) -> Result<Self, SolidError> {
        Self::with_islands(lower, upper, Vec::new())
    }

    /// Creates a channel between two periodic outlines, with closed outlines as islands between them.
    ///
    /// # Errors
    /// Returns the errors of [`Channel::new`]; an island that is not closed, or not between the lines; lines more than
    /// 200 periods long together.
    pub fn with_islands(lower: Outline, upper: Outline, islands: Vec<Outline>) -> Result<Self, SolidError> {
        let Some(period) = lower.period() else {
            return Err(SolidError::unsupported(
                "a closed outline as the side of a channel",
                "Use a profile, a polyline or a flat line",
            ));
        };
        if upper.period() != Some(period) {
            let second = upper.period().unwrap_or(0.0);
            return Err(SolidError::different_periods(period, second));
        }
        if islands.iter().any(|island| island.period().is_some()) {
            return Err(SolidError::unsupported("a periodic line as an island", "Use a closed outline"));
        }
        let spacing = period / SAMPLES;
        let length = [&lower, &upper].into_iter().chain(&islands).map(Outline::length).sum::<f64>();
        within("the length of all sides and islands over the period", length / period, 0.0, LONGEST)?;
        let lines = [&lower, &upper]
            .into_iter()
            .chain(&islands)
            .map(|outline| outline.resampled(spacing))
            .collect::<Result<Vec<_>, _>>()?;
        let start = lines[0][0].x;
        let segments = Segments::uncrossed(&lines, Some((start, period)), 2.0 * spacing)?;
        // A point between the lines has one of them above it; islands are crossed twice or not at all.
        for (number, line) in lines.iter().enumerate().filter(|&(number, _)| number != 1) {
            let mut place = line[0];
            place.x -= period * ((place.x - start) / period).floor();
            if segments.crossings_above(place, Some(number)) % 2 != 1 {
                return Err(SolidError::not_between(place));
            }
        }
        Ok(Self { lower, upper, islands, period })
    }

    /// Returns the channel from y = `lower(x)` to `upper(x)` (length) for x from `start` to `start + period` (length),
    /// smooth everywhere.
    ///
    /// # Errors
    /// Returns the errors of [`Outline::profile`] and [`Channel::new`].
    pub fn between(
        start: f64,
        period: f64,
        lower: impl Fn(f64) -> f64 + Send + Sync + 'static,
        upper: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Result<Self, SolidError> {
        Self::new(Outline::profile(start, period, lower)?, Outline::profile(start, period, upper)?)
    }

    /// Creates a channel with this lower side and its mirror image about y = 0 above.
    ///
    /// # Errors
    /// Returns the errors of [`Channel::new`].
    pub fn symmetric(lower: Outline) -> Result<Self, SolidError> {
        let upper = lower.mirrored(0.0)?;
        Self::new(lower, upper)
    }

    /// Returns the line that bounds the channel below.
    #[must_use]
    pub fn lower(&self) -> &Outline {
        &self.lower
    }

    /// Returns the line that bounds the channel above.
    #[must_use]
    pub fn upper(&self) -> &Outline {
        &self.upper
    }

    /// Returns the outlines of the islands.
    #[must_use]
    pub fn islands(&self) -> &[Outline] {
        &self.islands
    }

    /// Returns the period in x (length).
    #[must_use]
    pub fn period(&self) -> f64 {
        self.period
    }

    /// Returns the channel wider by `by` (length). It is the lower line moved down and the upper one up by half of it.
    ///
    /// # Errors
    /// Returns an error for a number that is not finite, or so negative that the lines touch.
    pub fn widened(&self, by: f64) -> Result<Self, SolidError> {
        finite("the widening", by)?;
        let step = Vec2::new(0.0, 0.5 * by);
        Self::with_islands(self.lower.translated(-step)?, self.upper.translated(step)?, self.islands.clone())
    }

    /// Meshes of the wall from y = `bottom` (length) up to the lower line, of the wall from the upper line up to `top`
    /// (length), and of the islands.
    ///
    /// # Errors
    /// Returns the errors of [`Mesher::mesh`].
    pub fn walls(&self, bottom: f64, top: f64, mesher: &Mesher) -> Result<Walls, SolidError> {
        Ok(Walls {
            lower: self.lower_wall(bottom, mesher)?,
            upper: self.upper_wall(top, mesher)?,
            islands: self
                .islands
                .iter()
                .map(|island| mesher.mesh(&Interior::new([island.clone()])?))
                .collect::<Result<_, _>>()?,
        })
    }

    /// Returns the mesh of the wall from y = `bottom` (length) up to the lower line.
    ///
    /// # Errors
    /// Returns the errors of [`Mesher::mesh`].
    pub fn lower_wall(&self, bottom: f64, mesher: &Mesher) -> Result<TriangleMesh, SolidError> {
        mesher.mesh(&self.below(bottom)?)
    }

    /// Returns the mesh of the wall from the upper line up to y = `top` (length). If the channel is its own mirror
    /// image about y = 0, the mesh of the lower wall down to y = `-top` with y reversed.
    ///
    /// # Errors
    /// Returns the errors of [`Mesher::mesh`].
    pub fn upper_wall(&self, top: f64, mesher: &Mesher) -> Result<TriangleMesh, SolidError> {
        Ok(mesher.mesh(&self.above(top)?.mirrored()?)?.mirrored())
    }

    /// Returns the outline of the island `number`, counted from 0.
    ///
    /// # Errors
    /// Returns [`SolidError::Refused`] if there is no island of that number.
    pub fn island(&self, number: usize) -> Result<&Outline, SolidError> {
        self.islands.get(number).ok_or_else(|| SolidError::no_such_island(number, self.islands.len()))
    }

    /// Returns the wall from y = `bottom` (length) up to the lower line.
    ///
    /// # Errors
    /// Returns an error for a height that is not finite.
    pub fn below(&self, bottom: f64) -> Result<Interior, SolidError> {
        Interior::new([self.level(&self.lower, bottom)?, self.lower.clone()])
    }

    /// Returns the wall from the upper line up to y = `top` (length).
    ///
    /// # Errors
    /// Returns an error for a height that is not finite.
    pub fn above(&self, top: f64) -> Result<Interior, SolidError> {
        Interior::new([self.upper.clone(), self.level(&self.upper, top)?])
    }

    /// Returns the flat outer surface of the wall at a side of the channel.
    fn level(&self, side: &Outline, height: f64) -> Result<Outline, SolidError> {
        Outline::flat(side.start().x, self.period, height)
    }
}
