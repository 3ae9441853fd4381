//! Colours, colour maps and the scales that turn numbers into colours.

/// A colour: red, green, blue, each 0 to 255.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Rgb(pub [u8; 3]);

impl Rgb {
    /// Paper.
    pub const WHITE: Self = Self([255, 255, 255]);
    /// Text, axes and frames.
    pub const INK: Self = Self([34, 38, 46]);
    /// Secondary lines: grids, reference lines.
    pub const GREY: Self = Self([128, 134, 144]);
    /// Grid lines of plots.
    pub(crate) const PALE: Self = Self([226, 229, 234]);

    /// Mixes linearly: `self` at `t = 0`, `other` at `t = 1`.
    pub(crate) fn mix(self, other: Self, t: f64) -> Self {
        let t = t.clamp(0.0, 1.0);
        let channel = |k: usize| {
            let (a, b) = (f64::from(self.0[k]), f64::from(other.0[k]));
            (a + (b - a) * t).round() as u8
        };
        Self([channel(0), channel(1), channel(2)])
    }

    /// The colour as SVG writes it, for instance `#22262e`.
    pub(crate) fn hex(self) -> String {
        let [r, g, b] = self.0;
        format!("#{r:02x}{g:02x}{b:02x}")
    }
}

/// Colours of the series of a plot, in the order of their use: told apart by most colour-blind readers and in print.
pub const SERIES_COLOURS: [Rgb; 8] = [
    Rgb([31, 98, 166]),
    Rgb([206, 74, 38]),
    Rgb([38, 138, 98]),
    Rgb([142, 82, 162]),
    Rgb([214, 150, 20]),
    Rgb([64, 168, 206]),
    Rgb([166, 58, 84]),
    Rgb([92, 96, 104]),
];

/// A map from 0..1 to colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColourMap {
    /// Blue, green, pale yellow, orange, red: diverging and close to a rainbow, for the pressure.
    Rainbow,
    /// Blue, white, red: diverging, for signed quantities such as the vorticity.
    BlueWhiteRed,
    /// Dark blue, green, yellow: sequential, for instance for the speed.
    Viridis,
    /// Black, purple, pink, pale yellow: sequential, for the concentration on an interface.
    Magma,
}

impl ColourMap {
    /// The colour at `t`, which is clamped to 0..1; not a number gives grey.
    #[must_use]
    pub fn at(self, t: f64) -> Rgb {
        if t.is_nan() {
            return Rgb::GREY;
        }
        let t = t.clamp(0.0, 1.0);
        let (gradient, t) = match self {
            Self::Rainbow => (colorous::SPECTRAL, 1.0 - t),
            Self::BlueWhiteRed => (colorous::RED_BLUE, 1.0 - t),
            Self::Viridis => (colorous::VIRIDIS, t),
            Self::Magma => (colorous::MAGMA, t),
        };
        Rgb(gradient.eval_continuous(t).as_array())
    }
}

/// How the ends of a colour scale are chosen from the data.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Limits {
    /// Zero to the largest value.
    FromZero,
    /// Symmetric about zero, so that the middle of a diverging map means zero. The end is the magnitude that all but
    /// two values in a thousand stay below: a few cells next to an interface would otherwise set the scale of all
    /// others.
    Symmetric,
    /// The range of all but the smallest and the largest one in two hundred: shows the differences among most values
    /// where a few stand out on either side.
    Most,
    /// Given ends, for series of pictures to be compared.
    Fixed(f64, f64),
}

/// A colour map with the values of its two ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColourScale {
    map: ColourMap,
    low: f64,
    high: f64,
}

impl ColourScale {
    /// The scale of `map` over `values`, of which those that are not finite are left out. Ends that coincide are moved
    /// apart, so that a constant gets the colour of the middle (or of the end, for [`Limits::FromZero`]).
    #[must_use]
    pub fn new(map: ColourMap, limits: Limits, values: &[f64]) -> Self {
        let sorted = |value: fn(f64) -> f64| {
            let mut all: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).map(value).collect();
            all.sort_unstable_by(f64::total_cmp);
            all
        };
        // The value that a share of the others lies above; zero if there are none.
        let end = |sorted: &[f64], k: usize| sorted.get(k).copied().unwrap_or(0.0);
        let (low, high) = match limits {
            Limits::Fixed(low, high) => (low, high),
            Limits::FromZero => (0.0, sorted(|v| v).last().map_or(0.0, |v| v.max(0.0))),
            Limits::Most => {
                let all = sorted(|v| v);
                let rank = all.len() / 200;
                (end(&all, rank), end(&all, all.len().saturating_sub(1 + rank)))
            }
            Limits::Symmetric => {
                let all = sorted(f64::abs);
                let high = end(&all, all.len().saturating_sub(1) * 998 / 1000);
                (-high, high)
            }
        };
        let (low, high) = if low <= high { (low, high) } else { (0.0, 0.0) };
        let slack = 1e-12 * low.abs().max(high.abs()).max(1e-300);
        if high - low > slack {
            return Self { map, low, high };
        }
        let half = if low == 0.0 { 1.0 } else { 0.5 * low.abs() };
        match limits {
            Limits::FromZero => Self { map, low: 0.0, high: 1.0 },
            _ => Self { map, low: low - half, high: high + half },
        }
    }

    /// Values at the two ends.
    #[must_use]
    pub fn ends(&self) -> [f64; 2] {
        [self.low, self.high]
    }

    /// The colour of `value`; values beyond an end get the end's colour.
    #[must_use]
    pub fn colour(&self, value: f64) -> Rgb {
        self.map.at((value - self.low) / (self.high - self.low))
    }

    /// The colours of `levels` equal bands from the low to the high end: a table for fast lookup, and, with few
    /// levels, bands whose edges are contour lines.
    pub(crate) fn table(&self, levels: usize) -> Vec<Rgb> {
        (0..levels).map(|k| self.map.at(k as f64 / (levels - 1) as f64)).collect()
    }
}

#[cfg(test)]
mod tests;
