//! Painting of plots.

use crate::colour::SERIES_COLOURS;
use crate::drawing::axes::{Axis, AxisScale, Frame};
use crate::drawing::{Anchor, Drawing, Pen, Pixel, Rect, TextStyle, font::text_width};
use crate::plot::contents::Plot;
use crate::plot::series::{Marker, Series};
use crate::{OutputError, Rgb};

/// Size of the type (pixels of the SVG).
const EM: f64 = 13.0;
/// Space around data on an axis, relative to its length.
const MARGIN: f64 = 0.05;
/// Smallest length of a linear axis relative to its values, so that round-off does not fill a plot.
const LEAST_SPAN: f64 = 1e-3;

/// Plot with its layout.
struct Panel<'a> {
    plot: &'a Plot,
    frame: Frame,
}

/// Returns the drawing of plots in rows of `columns`, each of a width and height (pixels).
pub(crate) fn draw(plots: &[Plot], columns: usize, [width, height]: [f64; 2]) -> Result<Drawing, OutputError> {
    if plots.is_empty() {
        return Err(OutputError::Empty("a figure without plots"));
    }
    OutputError::check_size("a panel with a width (pixels)", width, 200.0, 4000.0)?;
    OutputError::check_size("a panel with a height (pixels)", height, 150.0, 4000.0)?;
    let columns = columns.min(plots.len());
    let rows = plots.len().div_ceil(columns);
    let panel = |(k, plot)| {
        let (left, top) = ((k % columns) as f64 * width, (k / columns) as f64 * height);
        Panel { plot, frame: frame(plot, Rect { left, top, width, height }, EM) }
    };
    let mut drawing = Drawing::new([columns as f64 * width, rows as f64 * height]);
    plots.iter().enumerate().map(panel).for_each(|panel| panel.paint(&mut drawing));
    Ok(drawing)
}

/// Returns the axes of a plot within its panel.
fn frame(plot: &Plot, outer: Rect, em: f64) -> Frame {
    let axis = |k: usize, range: [f64; 2], length: f64| {
        Axis::new(&plot.labels[k], range, plot.scales[k], ((length / (4.0 * em)) as usize).clamp(3, 9))
    };
    let y = axis(1, data_range(plot, 1), outer.height);
    let left = Frame::left_margin(&y, em) + 0.4 * em;
    let top = if plot.title.is_empty() { 1.4 } else { 2.9 } * em;
    let range = plot.x_range.unwrap_or_else(|| data_range(plot, 0));
    let x = axis(0, range, outer.width - left);
    let area = Rect {
        left: outer.left + left,
        top: outer.top + top,
        width: outer.width - left - 1.6 * em,
        height: outer.height - top - Frame::bottom_margin(&x, em),
    };
    let area = area.rounded();
    if !plot.equal_units {
        return Frame { area, x, y, em };
    }
    // The axis with more room to spare is made longer about its middle.
    let (units, lengths) = ([range, data_range(plot, 1)], [area.width, area.height]);
    let of_pixel = (0..2).map(|k| (units[k][1] - units[k][0]) / lengths[k]).fold(0.0, f64::max);
    let [x, y] = [0, 1].map(|k| {
        let (middle, half) = (0.5 * (units[k][0] + units[k][1]), 0.5 * of_pixel * lengths[k]);
        axis(k, [middle - half, middle + half], lengths[k])
    });
    Frame { area, x, y, em }
}

/// Returns the range of the data along an axis, with some space around it.
fn data_range(plot: &Plot, axis: usize) -> [f64; 2] {
    let scale = plot.scales[axis];
    let points = plot.series.iter().flat_map(|s| &s.points).map(|p| if axis == 0 { p.0 } else { p.1 });
    let lines = plot.references.iter().filter(|_| axis == 1).map(|(value, _)| *value);
    let values = points.chain(lines).map(|v| scale.straight(v)).filter(|v| v.is_finite());
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
    let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
    let least = match scale {
        AxisScale::Linear if low == 0.0 && high == 0.0 => 1.0,
        AxisScale::Linear => LEAST_SPAN * low.abs().max(high.abs()),
        AxisScale::Logarithmic => 0.3,
    };
    let (middle, span) = (0.5 * (low + high), (high - low).max(least));
    let half = (0.5 + MARGIN) * span;
    let ends = [middle - half, middle + half];
    match scale {
        AxisScale::Linear => ends,
        AxisScale::Logarithmic => ends.map(|v| 10f64.powf(v)),
    }
}

impl Panel<'_> {
    fn paint(&self, drawing: &mut Drawing) {
        let (frame, em) = (&self.frame, self.frame.em);
        frame.draw_grid(drawing);
        drawing.clip(Some(frame.area));
        self.references(drawing);
        for (series, colour) in self.coloured() {
            self.series(drawing, series, colour);
        }
        self.legend(drawing);
        drawing.clip(None);
        frame.draw_axes(drawing);
        let shift = if frame.y.ticks.exponent == 0 { 0.0 } else { 3.4 * em };
        let at = [frame.area.left + shift, frame.area.top - 1.15 * em];
        drawing.text(at, &self.plot.title, &TextStyle::new(1.1 * em, Anchor::Start));
    }

    /// Returns the series with their colours.
    fn coloured(&self) -> Vec<(&Series, Rgb)> {
        let mut next = SERIES_COLOURS.iter().cycle();
        let colour = |s: &Series| s.colour.or_else(|| next.next().copied()).unwrap_or(Rgb::INK);
        self.plot.series.iter().zip(self.plot.series.iter().map(colour)).collect()
    }

    fn pixels(&self, series: &Series) -> Vec<Pixel> {
        series.points.iter().map(|p| self.frame.place(p.0, p.1)).collect()
    }

    fn references(&self, drawing: &mut Drawing) {
        let (area, em) = (self.frame.area, self.frame.em);
        let pen = Pen::new(Rgb::GREY, 0.09 * em);
        let style = TextStyle { colour: Rgb::GREY, ..TextStyle::new(0.85 * em, Anchor::End) };
        for (value, label) in &self.plot.references {
            let y = self.frame.place(self.frame.x.low, *value)[1];
            drawing.dashed(&[[area.left, y], [area.right(), y]], &pen, [0.45 * em, 0.3 * em]);
            let side = if y - area.top < 1.6 * em { 0.75 } else { -0.75 };
            drawing.text([area.right() - 0.5 * em, y + side * em], label, &style);
        }
    }

    fn series(&self, drawing: &mut Drawing, series: &Series, colour: Rgb) {
        let em = self.frame.em;
        let pixels = self.pixels(series);
        if series.line {
            for piece in pixels.split(|p| !(p[0].is_finite() && p[1].is_finite())).filter(|p| p.len() > 1) {
                line(drawing, piece, series, colour, em);
            }
        }
        if let Some(marker) = series.marker {
            let shown: Vec<Pixel> = pixels.into_iter().filter(|p| p[0].is_finite() && p[1].is_finite()).collect();
            draw_markers(drawing, marker, &shown, 0.3 * em, colour);
        }
    }

    /// Draws the legend in the corner, or between two of them, where it hides the fewest points.
    fn legend(&self, drawing: &mut Drawing) {
        let em = self.frame.em;
        let size = 0.9 * em;
        let entries: Vec<(&Series, Rgb)> = self.coloured().into_iter().filter(|(s, _)| !s.label.is_empty()).collect();
        if entries.is_empty() {
            return;
        }
        let widest = entries.iter().map(|(s, _)| text_width(&s.label, size)).fold(0.0, f64::max);
        let (width, height) = (widest + 3.6 * em, (1.4 * entries.len() as f64 + 0.5) * em);
        let area = self.frame.area;
        let gap = 0.6 * em;
        let (lefts, tops) =
            ([area.right() - gap - width, area.left + gap], [area.top + gap, area.bottom() - gap - height]);
        let [middle, centre] = [0.5 * (tops[0] + tops[1]), 0.5 * (lefts[0] + lefts[1])];
        // Corners first, then between them.
        let corners = lefts.into_iter().flat_map(|left| tops.map(|top| [left, top]));
        let sides = lefts.map(|left| [left, middle]).into_iter().chain(tops.map(|top| [centre, top]));
        let places = corners.chain(sides).map(|[left, top]| Rect { left, top, width, height });
        // Amount that the legend would hide: the share of each series, and lines with a label.
        let hidden = |panel: &Rect| {
            let inside =
                |p: &Pixel| (panel.left..panel.right()).contains(&p[0]) && (panel.top..panel.bottom()).contains(&p[1]);
            let share = |series: &Series| {
                // The line between points hides as much as points do.
                let pixels = self.pixels(series);
                let between = pixels.windows(2).flat_map(|w| {
                    (0..8).map(|k| f64::from(k) / 8.0).map(|t| [0, 1].map(|n| w[0][n] + t * (w[1][n] - w[0][n])))
                });
                let count = between.chain(pixels.iter().copied()).filter(inside).count();
                1000 * count / (9 * pixels.len().max(1))
            };
            let lines = self.plot.references.iter().filter(|(_, label)| !label.is_empty());
            let ends = lines.map(|(value, _)| [area.right() - gap, self.frame.place(self.frame.x.low, *value)[1]]);
            self.plot.series.iter().map(share).sum::<usize>() + 50 * ends.filter(inside).count()
        };
        let Some(panel) = places.min_by_key(hidden) else { return };
        drawing.fill(&[panel.outline()], Rgb::WHITE, 0.85);
        for (k, (series, colour)) in entries.into_iter().enumerate() {
            let y = panel.top + (1.4 * k as f64 + 0.95) * em;
            let (from, to) = (panel.left + 0.5 * em, panel.left + 2.5 * em);
            if series.line {
                line(drawing, &[[from, y], [to, y]], series, colour, em);
            }
            if let Some(marker) = series.marker {
                draw_markers(drawing, marker, &[[0.5 * (from + to), y]], 0.3 * em, colour);
            }
            drawing.text([panel.left + 3.0 * em, y], &series.label, &TextStyle::new(size, Anchor::Start));
        }
    }
}

/// Draws the line of a series.
fn line(drawing: &mut Drawing, path: &[Pixel], series: &Series, colour: Rgb, em: f64) {
    let pen = Pen::new(colour, 0.14 * em);
    if series.dashed {
        drawing.dashed(path, &pen, [0.55 * em, 0.35 * em]);
    } else {
        drawing.stroke(path, &pen);
    }
}

/// Draws markers at points.
fn draw_markers(drawing: &mut Drawing, marker: Marker, at: &[Pixel], radius: f64, colour: Rgb) {
    let (corners, size, turn) = match marker {
        Marker::Disc | Marker::Circle => {
            // The round ends of lines of next to no length; without any some viewers show nothing.
            let dots: Vec<Vec<Pixel>> = at.iter().map(|[x, y]| vec![[*x, *y], [x + 0.1, *y]]).collect();
            if marker == Marker::Disc {
                drawing.strokes(&dots, &Pen::new(colour, 2.0 * radius));
            } else {
                for dot in &dots {
                    drawing.stroke(dot, &Pen::new(colour, 2.45 * radius));
                    drawing.stroke(dot, &Pen::new(Rgb::WHITE, 1.55 * radius));
                }
            }
            return;
        }
        Marker::Square => (4, 1.25 * radius, std::f64::consts::FRAC_PI_4),
        Marker::Triangle => (3, 1.3 * radius, 0.0),
        Marker::Diamond => (4, 1.3 * radius, 0.0),
    };
    let angle = |k: usize| turn + std::f64::consts::TAU * k as f64 / corners as f64;
    for [x, y] in at {
        let outline = (0..=corners).map(|k| [x + size * angle(k).sin(), y - size * angle(k).cos()]).collect();
        drawing.fill(&[outline], colour, 1.0);
    }
}

#[cfg(test)]
mod tests;
