//! Bars that explain the colours of a picture.

use crate::{
    ColourScale, Rgb,
    drawing::{Anchor, Pen, Rect, Surface, TextStyle, axes::TICK_SIZE, canvas::Canvas, ticks::Ticks},
};

/// A colour scale with what it measures.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Legend {
    pub(crate) scale: ColourScale,
    pub(crate) label: String,
}

impl Legend {
    /// Draws the bar in `area`, upright or lying, with ticks and the label at its right or lower side.
    pub(crate) fn draw(&self, canvas: &mut Canvas, area: Rect, em: f64, upright: bool, levels: usize) {
        let [low, high] = self.scale.ends();
        let table = self.scale.table(levels);
        let colour = |t: f64| table[((t * levels as f64).max(0.0) as usize).min(levels - 1)];
        let along = |x, y| if upright { (area.bottom() - y) / area.height } else { (x - area.left) / area.width };
        canvas.shade(area, |x, y| Some(colour(along(x, y))));
        let pen = Pen::new(Rgb::INK, (0.06 * em).max(1.0));
        canvas.stroke(&area.outline(), &pen);
        let length = if upright { area.height } else { area.width };
        let ticks = Ticks::linear(low, high, ((length / (3.2 * em)) as usize).clamp(2, 6));
        let style = TextStyle::new(TICK_SIZE * em, if upright { Anchor::Start } else { Anchor::Middle });
        for tick in &ticks.ticks {
            let t = (tick.value - low) / (high - low);
            let label = tick.label.as_deref().unwrap_or_default();
            if upright {
                let y = area.bottom() - t * area.height;
                canvas.stroke(&[[area.right(), y], [area.right() + 0.3 * em, y]], &pen);
                canvas.text([area.right() + 0.6 * em, y], label, &style);
            } else {
                let x = area.left + t * area.width;
                canvas.stroke(&[[x, area.bottom()], [x, area.bottom() + 0.3 * em]], &pen);
                canvas.text([x, area.bottom() + 1.05 * em], label, &style);
            }
        }
        let factor = if ticks.exponent == 0 { String::new() } else { format!(" (10^{{{}}})", ticks.exponent) };
        let label = format!("{}{}", self.label, factor.replace('-', "−"));
        let style = TextStyle::new(em, Anchor::Middle);
        if upright {
            let x = area.right() + Self::UPRIGHT_MARGIN * em - 0.6 * em;
            canvas.text([x, area.top + 0.5 * area.height], &label, &style.upwards());
        } else {
            canvas.text([area.left + 0.5 * area.width, area.bottom() + 2.35 * em], &label, &style);
        }
    }

    /// Space needed beside an upright bar and below a lying one, in sizes of the type.
    pub(crate) const UPRIGHT_MARGIN: f64 = 4.1;
    pub(crate) const LYING_MARGIN: f64 = 3.1;
}
