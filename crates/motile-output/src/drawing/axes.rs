//! Axes around a rectangle: scales from data to pixels, ticks and labels.

use crate::{
    Rgb,
    drawing::canvas::Drawing,
    drawing::shapes::{Anchor, Pen, Pixel, Rect, TextStyle},
    drawing::{font::text_width, ticks::Ticks},
};

/// Scale of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum AxisScale {
    /// Linear scale: equal distances for equal differences.
    #[default]
    Linear,
    /// Logarithmic scale: equal distances for equal ratios; values that are not positive are not drawn.
    Logarithmic,
}

impl AxisScale {
    /// Returns the coordinate in which the scale is linear: the value or its decimal logarithm.
    pub(crate) fn straight(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Logarithmic => value.log10(),
        }
    }
}

/// Axis with its label, ends, scale and ticks.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Axis {
    pub(crate) label: String,
    pub(crate) low: f64,
    pub(crate) high: f64,
    pub(crate) scale: AxisScale,
    pub(crate) ticks: Ticks,
}

impl Axis {
    pub(crate) fn new(label: &str, [low, high]: [f64; 2], scale: AxisScale, ticks: usize) -> Self {
        let ticks = match scale {
            AxisScale::Linear => Ticks::linear(low, high, ticks),
            AxisScale::Logarithmic => Ticks::logarithmic(low, high),
        };
        Self { label: label.to_string(), low, high, scale, ticks }
    }

    /// Axis without label and ticks.
    pub(crate) fn bare() -> Self {
        Self { ticks: Ticks::default(), ..Self::new("", [0.0, 1.0], AxisScale::Linear, 2) }
    }

    /// Returns the position along the axis, 0 to 1 within its ends.
    fn fraction(&self, value: f64) -> f64 {
        let [low, high, value] = [self.low, self.high, value].map(|v| self.scale.straight(v));
        (value - low) / (high - low)
    }

    /// Returns the width of the widest tick label (pixels).
    fn label_width(&self, size: f64) -> f64 {
        let labels = self.ticks.ticks.iter().filter_map(|t| t.label.as_deref());
        labels.map(|l| text_width(l, size)).fold(0.0, f64::max)
    }

    /// Returns the power of ten that multiplies the tick labels, as text; empty for 1.
    fn factor(&self) -> String {
        match self.ticks.exponent {
            0 => String::new(),
            n => format!("×10^{{{n}}}").replace('-', "−"),
        }
    }
}

/// Rectangle on a drawing with its two axes. All distances scale with the size of the type, `em` (pixels).
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Frame {
    pub(crate) area: Rect,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    pub(crate) em: f64,
}

/// Size of tick labels relative to axis labels.
const TICK_SIZE: f64 = 0.88;

impl Frame {
    /// Returns the position of a point of the data (pixels).
    pub(crate) fn place(&self, x: f64, y: f64) -> Pixel {
        [
            self.area.left + self.x.fraction(x) * self.area.width,
            self.area.bottom() - self.y.fraction(y) * self.area.height,
        ]
    }

    /// Returns the space that the vertical axis needs to the left of the rectangle (pixels).
    pub(crate) fn left_margin(y: &Axis, em: f64) -> f64 {
        let label = if y.label.is_empty() { 0.3 } else { 1.8 };
        y.label_width(TICK_SIZE * em) + (1.0 + label) * em
    }

    /// Returns the space that the horizontal axis needs below the rectangle (pixels).
    pub(crate) fn bottom_margin(x: &Axis, em: f64) -> f64 {
        if x.label.is_empty() { 2.0 * em } else { 3.7 * em }
    }

    /// Draws pale lines at the labelled ticks.
    pub(crate) fn draw_grid(&self, drawing: &mut Drawing) {
        let (pen, area) = (Pen::new(Rgb::PALE, (0.055 * self.em).max(0.8)), self.area);
        let labelled = |axis: &Axis| axis.ticks.ticks.clone().into_iter().filter(|tick| tick.label.is_some());
        for tick in labelled(&self.x) {
            let x = self.place(tick.value, self.y.low)[0];
            drawing.stroke(&[[x, area.top], [x, area.bottom()]], &pen);
        }
        for tick in labelled(&self.y) {
            let y = self.place(self.x.low, tick.value)[1];
            drawing.stroke(&[[area.left, y], [area.right(), y]], &pen);
        }
    }

    /// Draws the border, ticks outside of it and all labels.
    pub(crate) fn draw_axes(&self, drawing: &mut Drawing) {
        let (em, area) = (self.em, self.area);
        let pen = Pen::new(Rgb::INK, (0.07 * em).max(1.0));
        drawing.stroke(&area.outline(), &pen);
        let middle = TextStyle::new(TICK_SIZE * em, Anchor::Middle);
        let [left, right] = [Anchor::Start, Anchor::End].map(|anchor| TextStyle { anchor, ..middle });
        for (axis, downwards) in [(&self.x, true), (&self.y, false)] {
            for tick in &axis.ticks.ticks {
                let length = if tick.label.is_some() { 0.4 } else { 0.22 } * em;
                let label = tick.label.as_deref().unwrap_or_default();
                if downwards {
                    let [x, y] = [self.place(tick.value, self.y.low)[0], area.bottom()];
                    drawing.stroke(&[[x, y], [x, y + length]], &pen);
                    drawing.text([x, y + 1.15 * em], label, &middle);
                } else {
                    let [x, y] = [area.left, self.place(self.x.low, tick.value)[1]];
                    drawing.stroke(&[[x, y], [x - length, y]], &pen);
                    drawing.text([x - 0.7 * em, y], label, &right);
                }
            }
        }
        drawing.text([area.right(), area.bottom() + 2.5 * em], &self.x.factor(), &right);
        drawing.text([area.left, area.top - 0.8 * em], &self.y.factor(), &left);
        let style = TextStyle::new(em, Anchor::Middle);
        drawing.text([area.left + 0.5 * area.width, area.bottom() + 2.65 * em], &self.x.label, &style);
        let beside = self.y.label_width(TICK_SIZE * em) + 1.75 * em;
        drawing.text([area.left - beside, area.top + 0.5 * area.height], &self.y.label, &style.upwards());
    }
}

#[cfg(test)]
mod tests;
