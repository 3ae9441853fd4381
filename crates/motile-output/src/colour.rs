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

    /// Linear mixture: `self` at `t = 0`, `other` at `t = 1`.
    pub(crate) fn mix(self, other: Self, t: f64) -> Self {
        let channel = |k: usize| {
            let (a, b) = (f64::from(self.0[k]), f64::from(other.0[k]));
            (a + (b - a) * t.clamp(0.0, 1.0)).round() as u8
        };
        Self([channel(0), channel(1), channel(2)])
    }

    /// Colour as SVG writes it, for instance `#22262e`.
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

/// Colour map with the values of its two ends; values beyond an end get the end's colour.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ColourScale {
    map: fn(f64) -> Rgb,
    /// Name of the quantity.
    pub(crate) label: &'static str,
    pub(crate) low: f64,
    pub(crate) high: f64,
}

/// Blue, green, pale yellow, orange, red.
fn rainbow(t: f64) -> Rgb {
    Rgb(colorous::SPECTRAL.eval_continuous(1.0 - t).as_array())
}

/// Black, purple, pink, pale yellow.
fn magma(t: f64) -> Rgb {
    Rgb(colorous::MAGMA.eval_continuous(t).as_array())
}

/// Violet, green, yellow.
fn viridis(t: f64) -> Rgb {
    Rgb(colorous::VIRIDIS.eval_continuous(t).as_array())
}

impl ColourScale {
    /// Scale from blue to red over all values but the smallest and largest half percent, so that a few outliers, such
    /// as pressures next to an interface, do not hide the differences among the others.
    pub(crate) fn of_most(values: impl Iterator<Item = f64>, label: &'static str) -> Self {
        let mut sorted: Vec<f64> = values.filter(|v| v.is_finite()).collect();
        sorted.sort_unstable_by(f64::total_cmp);
        let rank = sorted.len() / 200;
        let end = |k: usize| sorted.get(k).copied().unwrap_or(0.0);
        let (low, high) = (end(rank), end(sorted.len().saturating_sub(1 + rank)));
        // A constant gets the colour of the middle.
        let half = if low == 0.0 { 1.0 } else { 0.5 * low.abs() };
        let flat = high - low <= 1e-12 * low.abs().max(high.abs());
        let (low, high) = if flat { (low - half, high + half) } else { (low, high) };
        Self { map: rainbow, label, low, high }
    }

    /// Scale from zero (black) to the largest of the values (pale yellow); `None` if none is above zero.
    pub(crate) fn from_zero(values: impl Iterator<Item = f64>, label: &'static str) -> Option<Self> {
        let high = values.filter(|v| v.is_finite()).fold(0.0, f64::max);
        (high > 0.0).then_some(Self { map: magma, label, low: 0.0, high })
    }

    /// Scale in colours from violet over green to yellow.
    pub(crate) fn green(self) -> Self {
        Self { map: viridis, ..self }
    }

    /// Colour of a value; grey for not a number.
    pub(crate) fn colour(&self, value: f64) -> Rgb {
        let t = (value - self.low) / (self.high - self.low);
        if t.is_nan() { Rgb::GREY } else { (self.map)(t.clamp(0.0, 1.0)) }
    }

    /// Colours of `levels` equal bands from the low to the high end, for fast lookup; with few levels the edges of the
    /// bands are contour lines.
    pub(crate) fn table(&self, levels: usize) -> Vec<Rgb> {
        (0..levels).map(|k| (self.map)(k as f64 / (levels - 1) as f64)).collect()
    }
}

#[cfg(test)]
mod tests;
