//! Colours, and scales from numbers to colours.

/// Colour: red, green, blue, each 0 to 255.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Rgb(pub [u8; 3]);

impl Rgb {
    /// Paper.
    pub const WHITE: Self = Self([255, 255, 255]);
    /// Text, axes and frames.
    pub const INK: Self = Self([34, 38, 46]);
    /// Secondary lines, such as reference lines.
    pub const GREY: Self = Self([128, 134, 144]);
    /// Grid lines of plots.
    pub(crate) const PALE: Self = Self([226, 229, 234]);

    /// Returns the linear mixture: `self` at `t = 0`, `other` at `t = 1`.
    pub(crate) fn mix(self, other: Self, t: f64) -> Self {
        let channel = |k: usize| {
            let (a, b) = (f64::from(self.0[k]), f64::from(other.0[k]));
            (a + (b - a) * t.clamp(0.0, 1.0)).round() as u8
        };
        Self([channel(0), channel(1), channel(2)])
    }

    /// Returns the colour as SVG writes it, for instance `#22262e`.
    pub(crate) fn hex(self) -> String {
        let [r, g, b] = self.0;
        format!("#{r:02x}{g:02x}{b:02x}")
    }
}

/// Colours of the series of a plot, in the order of their use: distinct for most colour-blind readers and in print.
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

/// Colours of the pressure, in even steps to the eye and distinct for colour-blind readers.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum PressureColours {
    /// Blue below zero, white at zero, red above, with equal steps of colour for equal differences on both sides.
    #[default]
    BlueRed,
    /// Violet over green to yellow from the lowest to the highest pressure, wherever zero is.
    Viridis,
}

/// Colour map with the values of its two ends; values beyond an end get the end's colour.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ColourScale {
    map: fn(f64) -> Rgb,
    /// Name of the quantity.
    pub(crate) label: &'static str,
    /// Lowest and highest value that is shown.
    pub(crate) low: f64,
    pub(crate) high: f64,
    /// Values at the ends of the map.
    ends: [f64; 2],
    /// True for the ends that values exceed.
    pub(crate) exceeded: [bool; 2],
}

/// Ends of [`blue_red`] in CIELAB (D65): lightness, green to red, blue to yellow. Both are equally far from white.
const BLUE: [f64; 3] = [37.0, 8.0, -44.0];
const RED: [f64; 3] = [37.0, 38.0, 23.55];

/// Returns the blue, white, red: straight lines in CIELAB, so that equal steps look equal.
fn blue_red(t: f64) -> Rgb {
    let (end, part) = if t < 0.5 { (BLUE, 1.0 - 2.0 * t) } else { (RED, 2.0 * t - 1.0) };
    lab([97.0 + part * (end[0] - 97.0), part * end[1], part * end[2]])
}

/// Returns the colour of CIELAB coordinates (CIE 1976, white D65) in sRGB (IEC 61966-2-1).
fn lab([lightness, a, b]: [f64; 3]) -> Rgb {
    let middle = (lightness + 16.0) / 116.0;
    let linear = |f: f64| if f > 6.0 / 29.0 { f.powi(3) } else { 108.0 / 841.0 * (f - 4.0 / 29.0) };
    let [x, y, z] = [0.950_47 * linear(middle + a / 500.0), linear(middle), 1.088_83 * linear(middle - b / 200.0)];
    let channel = |[p, q, r]: [f64; 3]| {
        let v = (p * x + q * y + r * z).clamp(0.0, 1.0);
        let v = if v <= 0.003_130_8 { 12.92 * v } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 };
        (255.0 * v).round() as u8
    };
    let rows = [[3.240_45, -1.537_14, -0.498_53], [-0.969_27, 1.876_01, 0.041_56], [0.055_64, -0.204_03, 1.057_23]];
    Rgb(rows.map(channel))
}

/// Returns the black, purple, pink, pale yellow.
fn magma(t: f64) -> Rgb {
    Rgb(colorous::MAGMA.eval_continuous(t).as_array())
}

/// Returns the violet, green, yellow.
fn viridis(t: f64) -> Rgb {
    Rgb(colorous::VIRIDIS.eval_continuous(t).as_array())
}

impl ColourScale {
    /// Returns the scale over a range, or over all values but the smallest and largest half percent, so that a few
    /// outliers, such as pressures next to an interface, do not hide the differences among the others.
    pub(crate) fn of_most(values: impl Iterator<Item = f64>, range: Option<[f64; 2]>, label: &'static str) -> Self {
        let mut sorted: Vec<f64> = values.filter(|v| v.is_finite()).collect();
        sorted.sort_unstable_by(f64::total_cmp);
        let rank = sorted.len() / 200;
        let end = |k: usize| sorted.get(k).copied().unwrap_or(0.0);
        let all = [end(0), end(sorted.len().saturating_sub(1))];
        let [low, high] = range.unwrap_or([end(rank), end(sorted.len().saturating_sub(1 + rank))]);
        // A constant gets the colour of the middle.
        let half = if low == 0.0 { 1.0 } else { 0.5 * low.abs() };
        let flat = high - low <= 1e-12 * low.abs().max(high.abs());
        let (low, high) = if flat { (low - half, high + half) } else { (low, high) };
        let exceeded = [all[0] < low, all[1] > high];
        Self { map: viridis, label, low, high, ends: [low, high], exceeded }
    }

    /// Returns the scale in the colours of a map of the pressure.
    pub(crate) fn coloured(self, colours: PressureColours) -> Self {
        let largest = self.low.abs().max(self.high.abs());
        match colours {
            PressureColours::BlueRed => Self { map: blue_red, ends: [-largest, largest], ..self },
            PressureColours::Viridis => self,
        }
    }

    /// Creates a scale from zero (black) to the largest of the values (pale yellow); `None` if none is above zero.
    pub(crate) fn from_zero(values: impl Iterator<Item = f64>, label: &'static str) -> Option<Self> {
        let high = values.filter(|v| v.is_finite()).fold(0.0, f64::max);
        (high > 0.0).then_some(Self { map: magma, label, low: 0.0, high, ends: [0.0, high], exceeded: [false; 2] })
    }

    /// Returns the scale in colours from violet over green to yellow.
    pub(crate) fn green(self) -> Self {
        Self { map: viridis, ..self }
    }

    /// Returns the colour of a value; grey for not a number.
    pub(crate) fn colour(&self, value: f64) -> Rgb {
        let t = (value.clamp(self.low, self.high) - self.ends[0]) / (self.ends[1] - self.ends[0]);
        if t.is_nan() { Rgb::GREY } else { (self.map)(t.clamp(0.0, 1.0)) }
    }

    /// Colours of `levels` equal bands from the low to the high end, for fast lookup; with few levels the edges of the
    /// bands are contour lines.
    pub(crate) fn table(&self, levels: usize) -> Vec<Rgb> {
        let part = |k: usize| k as f64 / (levels - 1) as f64;
        (0..levels).map(|k| self.colour(self.low + part(k) * (self.high - self.low))).collect()
    }
}

#[cfg(test)]
mod tests;
