//! Painting of pictures of scenes.

use std::collections::HashSet;

use super::contents::{Legends, Picture};
use super::sides::sides;
use super::smooth::{between, smooth};
use crate::time_label::time_label;
use crate::{
    ColourScale, OutputError, Rgb, Samples,
    drawing::{
        Anchor, Drawing, Pen, Pixel, Rect, TextStyle,
        axes::{Axis, AxisScale, Frame},
        font::text_width,
        ticks::{nice_step_below, number},
    },
    streamlines,
};
use motile::base::Vec2;

/// Colours of solids and walls.
const SOLID: Rgb = Rgb([196, 190, 180]);
const SOLID_EDGE: Rgb = Rgb([92, 84, 74]);
/// Active springs that are on.
const BOND: Rgb = Rgb([255, 120, 60]);
/// Colours of directors and of defects of either sign.
const DIRECTOR: Rgb = Rgb([30, 30, 30]);
const DEFECTS: [Rgb; 2] = [Rgb([190, 20, 60]), Rgb([20, 60, 190])];
/// Colour of tracks.
const TRACK: Rgb = Rgb([20, 60, 150]);
/// Thickness of the band that shows a rigid wall, relative to the distance of the walls.
const WALL: f64 = 0.07;
/// Height of the colour bars with their labels, in sizes of the type.
const BARS: f64 = 4.5;
/// Number of times that triangles of a mesh inside are split in four, to show a smooth field.
const SPLITS: usize = 2;
/// Smallest diameter of a droplet on a picture for lines as wide as the size of the type asks for (sizes of the type).
const SLENDER: f64 = 17.0;

/// Returns the drawing of a picture.
pub(crate) fn paint(picture: &Picture<'_>) -> Result<Drawing, OutputError> {
    let layout = Layout::new(picture);
    let mut drawing = Drawing::new([picture.format.width, layout.height]);
    drawing.per_cm = picture.format.per_cm;
    drawing.origin.clone_from(&picture.seen.origin);
    let mut painter = Painter { picture, drawing, layout };
    painter.drawing.clip(Some(painter.layout.frame.area));
    painter.pressure()?;
    painter.inside();
    if picture.look.streamlines {
        painter.streamlines()?;
    }
    painter.gels();
    painter.solids();
    painter.walls();
    painter.tracks();
    painter.interfaces();
    if picture.look.scale_bar {
        painter.scale_bar();
    }
    painter.drawing.clip(None);
    painter.layout.frame.draw_axes(&mut painter.drawing);
    if picture.look.colour_bars {
        painter.legends();
    }
    let (area, em) = (painter.layout.frame.area, painter.layout.em);
    let title = format!("t = {}   {}", time_label(picture.seen.time), picture.look.caption);
    // A long title is set smaller.
    let size = 1.05 * em * (area.width / text_width(&title, 1.05 * em)).min(1.0);
    let y = area.top - 1.15 * em;
    painter.drawing.text([area.left, y], &title, &TextStyle::new(size, Anchor::Start));
    painter.drawing.text([0.4 * em, y], &picture.look.panel, &TextStyle::new(1.3 * em, Anchor::Start));
    Ok(painter.drawing)
}

/// Splits a triangle into four, a number of times over, and shows each part with the mean of the linear function
/// through the values at the corners.
fn split(corners: [Pixel; 3], values: [f64; 3], times: usize, show: &mut impl FnMut([Pixel; 3], f64)) {
    if times == 0 {
        return show(corners, values.iter().sum::<f64>() / 3.0);
    }
    let [a, b, c] = corners;
    let [u, v, w] = values;
    let middle = |p: Pixel, q: Pixel| [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])];
    let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
    let [uv, vw, wu] = [0.5 * (u + v), 0.5 * (v + w), 0.5 * (w + u)];
    let parts = [([a, ab, ca], [u, uv, wu]), ([ab, b, bc], [uv, v, vw]), ([ca, bc, c], [wu, vw, w])];
    for (corners, values) in parts.into_iter().chain([([ab, bc, ca], [uv, vw, wu])]) {
        split(corners, values, times - 1, show);
    }
}

/// Layout of a picture.
struct Layout {
    frame: Frame,
    height: f64,
    /// Size of the type (pixels).
    em: f64,
    /// Unit of the widths of lines in the picture (pixels): the size of the type, less where the picture is low or a
    /// droplet small.
    unit: f64,
    /// Unit of length in labels, with the space before it.
    length_unit: String,
}

impl Layout {
    fn new(picture: &Picture<'_>) -> Self {
        let [mut low, mut high] = picture.view;
        if let Some([below, above]) = picture.seen.walls {
            let band = WALL * (above - below).abs();
            low.y = low.y.min(below - band);
            high.y = high.y.max(above + band);
        }
        let shape = (high.x - low.x) / (high.y - low.y);
        let (width, em, look) = (picture.format.width, picture.format.em, picture.look);
        let in_unit = |format: fn(&str) -> String| {
            if look.length_unit.is_empty() { String::new() } else { format(&look.length_unit) }
        };
        let of_axes = in_unit(|unit| format!(" ({unit})"));
        let axis = |k: usize, name: &str, ticks: usize| {
            Axis::new(&format!("{name}{of_axes}"), [low[k], high[k]], AxisScale::Linear, ticks)
        };
        let rough_height = (width - 8.0 * em) / shape;
        let x = axis(0, "x", 10);
        let y = axis(1, "y", ((rough_height / (2.2 * em)) as usize).clamp(2, 8));
        let left = Frame::left_margin(&y, em).round();
        let inner = (width - left - 1.4 * em).round().max(1.0);
        let area = Rect { left, top: (2.4 * em).round(), width: inner, height: (inner / shape).round().max(1.0) };
        let bars = if look.colour_bars { BARS } else { 0.0 };
        let height = (area.bottom() + Frame::bottom_margin(&x, em) + bars * em).round();
        let mut layout = Self {
            height,
            frame: Frame { area, x, y, em },
            em,
            unit: em.min(area.height / 13.0),
            length_unit: in_unit(|unit| format!(" {unit}")),
        };
        let units = picture.seen.droplets.iter().map(|droplet| layout.unit_of(&droplet.markers));
        layout.unit = units.fold(layout.unit, f64::min);
        layout
    }

    fn path(&self, points: &[Vec2], shift: Vec2) -> Vec<Pixel> {
        points.iter().map(|p| p + shift).map(|p| self.frame.place(p.x, p.y)).collect()
    }

    /// Returns the unit of the widths of lines for a droplet (pixels), in proportion to its diameter where that is
    /// small.
    fn unit_of(&self, markers: &[Vec2]) -> f64 {
        let next = markers.iter().cycle().skip(1);
        let area = 0.5 * markers.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>().abs();
        let diameter = 2.0 * (area / std::f64::consts::PI).sqrt() * self.scale();
        // Markers that are not finite are not drawn.
        self.em.min(self.frame.area.height / 13.0).min(diameter / SLENDER)
    }

    /// Pixels per unit of length.
    fn scale(&self) -> f64 {
        self.frame.area.width / (self.frame.x.high - self.frame.x.low)
    }
}

/// Picture with its layout, and the drawing so far.
struct Painter<'a> {
    picture: &'a Picture<'a>,
    drawing: Drawing,
    layout: Layout,
}

impl Painter<'_> {
    /// Shifts that bring periodic images of the bounding box of some points into view.
    fn images<'p>(&self, points: &(impl Iterator<Item = &'p Vec2> + Clone)) -> Vec<Vec2> {
        let raster = &self.picture.seen.raster;
        let frame = &self.layout.frame;
        // Half a type size more, for the width of lines.
        let margin = 0.5 * self.layout.em / self.layout.scale();
        let axis = |k: usize, low: f64, high: f64| {
            if !raster.periodic[k] && (k == 0 || raster.tilt.is_none()) {
                return vec![0.0];
            }
            let values = points.clone().map(|p| p[k]).filter(|v| v.is_finite());
            let (first, last) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
            let period = raster.size[k];
            let from = ((low - margin - last) / period).ceil() as i64;
            let to = ((high + margin - first) / period).floor() as i64;
            (from..=to).take(100).map(|m| m as f64 * period).collect()
        };
        let row = |y: f64| {
            let tilt = raster.tilt.map_or(0.0, |tilt| tilt * (y / raster.size[1]).round());
            let xs = axis(0, frame.x.low - tilt, frame.x.high - tilt);
            xs.into_iter().map(move |x| Vec2::new(x + tilt, y))
        };
        axis(1, frame.y.low, frame.y.high).into_iter().flat_map(row).collect()
    }

    /// Draws the pressure, with a sharp edge along interfaces of fluid, at which it jumps.
    fn pressure(&mut self) -> Result<(), OutputError> {
        let seen = self.picture.seen;
        let membranes = seen.solids.iter().filter(|solid| solid.holds_fluid).flat_map(|solid| solid.edges.clone());
        let droplets = seen.droplets.iter().map(|droplet| smooth(&droplet.markers, Vec2::ZERO));
        let lines: Vec<Vec<Vec2>> = droplets.chain(membranes).collect();
        let curves: Vec<&[Vec2]> = lines.iter().map(Vec::as_slice).collect();
        let fields = sides(&seen.raster, seen.pressure(), &curves, seen.smear)?;
        self.shade(&fields.outside);
        let rings = curves.iter().flat_map(|curve| {
            let shifts = self.images(&curve.iter());
            shifts.into_iter().map(|shift| self.layout.path(curve, shift))
        });
        let rings: Vec<Vec<Pixel>> = rings.collect();
        if !rings.is_empty() {
            self.drawing.clip_inside(&rings);
            self.shade(&fields.inside);
            self.drawing.clip(Some(self.layout.frame.area));
        }
        Ok(())
    }

    /// Colours the picture by a field of pressures where it is known.
    fn shade(&mut self, field: &Samples<f64>) {
        let (scale, levels) = (&self.picture.legends.pressure, self.picture.format.levels);
        let table = scale.table(levels);
        let (area, low, high) = (self.layout.frame.area, self.layout.frame.x.low, self.layout.frame.y.high);
        let length = 1.0 / self.layout.scale();
        self.drawing.shade(area, |x, y| {
            let point = Vec2::new(low + (x - area.left) * length, high - (y - area.top) * length);
            let value = field.raster.covers(point).then(|| field.at(point))?;
            let level = (value - scale.low) / (scale.high - scale.low) * levels as f64;
            level.is_finite().then(|| table[(level.max(0.0) as usize).min(levels - 1)])
        });
    }

    /// Draws the densities of particles inside, linear within the triangles of their mesh.
    fn inside(&mut self) {
        let Some(scale) = &self.picture.legends.inside else { return };
        let frame = &self.layout.frame;
        let mut shades: Vec<([Pixel; 3], Rgb)> = Vec::new();
        for field in &self.picture.seen.inside {
            for shift in self.images(&field.triangles.iter().flatten()) {
                let place = |p: Vec2| frame.place(p.x + shift.x, p.y + shift.y);
                for (corners, values) in field.triangles.iter().zip(&field.densities) {
                    split(corners.map(place), *values, SPLITS, &mut |at, value| shades.push((at, scale.colour(value))));
                }
            }
        }
        if !shades.is_empty() {
            self.drawing.triangles(frame.area, shades.into_iter());
        }
    }

    fn streamlines(&mut self) -> Result<(), OutputError> {
        // Streamlines are not of a droplet: they keep half the width that the size of the type asks for.
        let (seen, unit) = (self.picture.seen, self.layout.unit.max(0.5 * self.layout.em));
        let velocity = Samples::new(seen.raster, seen.velocity())?;
        // An anchor that moves with the droplet keeps the lines from flickering in animations.
        let anchor = seen.droplets.first().map_or(seen.raster.origin.into(), |droplet| droplet.centroid);
        // Lines closer than half a size of the type would be a grey area.
        let least = 0.55 * self.layout.em / self.layout.scale();
        let pen = Pen::new(Rgb::INK, (0.07 * unit).max(0.9)).opacity(0.72);
        for line in streamlines(&velocity, self.picture.streamline_spacing.max(least), anchor)? {
            for shift in self.images(&line.iter()) {
                let path = self.layout.path(&line, shift);
                self.drawing.stroke(&path, &pen);
                // Arrow heads along the line, at least one.
                let count = (line.len() / 90).max(1);
                for k in 0..count {
                    let at = (path.len() * (2 * k + 1)) / (2 * count);
                    if at + 1 < path.len() {
                        self.head(path[at], path[at + 1], 0.62 * unit);
                    }
                }
            }
        }
        Ok(())
    }

    /// Draws a line on a wider white one of some opacity, so that it stands out from the field; widths in pixels.
    fn outlined(&mut self, path: &[Pixel], colour: Rgb, [width, around]: [f64; 2], opacity: f64) {
        self.drawing.stroke(path, &Pen::new(Rgb::WHITE, around).opacity(opacity));
        self.drawing.stroke(path, &Pen::new(colour, width));
    }

    /// Draws an arrow head at `at` that points to `next`.
    fn head(&mut self, at: Pixel, next: Pixel, size: f64) {
        let (dx, dy) = (next[0] - at[0], next[1] - at[1]);
        let scale = size / dx.hypot(dy).max(1e-300);
        let (c, s) = (dx * scale, dy * scale);
        let corner = |along: f64, across: f64| [at[0] + along * c - across * s, at[1] + along * s + across * c];
        let ring = vec![corner(0.6, 0.0), corner(-0.4, 0.36), corner(-0.22, 0.0), corner(-0.4, -0.36)];
        self.drawing.fill(&[ring], Rgb::INK, 0.85);
    }

    /// Draws directors as short arrows, no closer than they are long, and defects as dots.
    fn gels(&mut self) {
        let (seen, unit) = (self.picture.seen, self.layout.unit);
        let length = 0.9 * unit / self.layout.scale();
        for gel in &seen.gels {
            let mut taken = HashSet::new();
            let corner = gel.nodes.first().copied().unwrap_or_default();
            let place = |node: Vec2| ((node - corner) / (1.3 * length)).to_array().map(|cell| cell.floor() as i64);
            let shown = gel.nodes.iter().zip(&gel.directors).filter(|(node, _)| taken.insert(place(**node)));
            let shown: Vec<[Vec2; 2]> = shown.map(|(at, p)| [at - 0.5 * length * p, at + 0.5 * length * p]).collect();
            for shift in self.images(&gel.nodes.iter()) {
                for line in &shown {
                    let path = self.layout.path(line, shift);
                    self.outlined(&path, DIRECTOR, [0.12 * unit, 0.26 * unit], 0.6);
                    let [from, to] = [path[0], path[1]];
                    self.head(to, [2.0 * to[0] - from[0], 2.0 * to[1] - from[1]], 0.35 * unit);
                }
                for defect in &gel.defects {
                    let dot = self.layout.path(&[defect.position.into(); 2], shift);
                    self.outlined(&dot, DEFECTS[usize::from(defect.charge < 0)], [0.6 * unit, 0.8 * unit], 1.0);
                }
            }
        }
    }

    fn solids(&mut self) {
        let picture = self.picture;
        let pen = Pen::new(SOLID_EDGE, (0.1 * self.layout.unit).max(1.0));
        for solid in &picture.seen.solids {
            let shifts = self.images(&solid.area.iter().chain(&solid.edges).flatten());
            let all = |lines: &[Vec<Vec2>]| -> Vec<Vec<Pixel>> {
                let layout = &self.layout;
                shifts.iter().flat_map(|&shift| lines.iter().map(move |line| layout.path(line, shift))).collect()
            };
            let (rings, edges) = (all(&solid.area), all(&solid.edges));
            let frame = &self.layout.frame;
            let mut triangles: Vec<([Pixel; 3], Rgb)> = Vec::new();
            if let Some(scale) = &picture.legends.solids {
                for shift in self.images(&solid.triangles.iter().flatten()) {
                    let place = |p: Vec2| frame.place(p.x + shift.x, p.y + shift.y);
                    let values = solid.triangles.iter().zip(solid.values(picture.look.solids));
                    triangles.extend(values.map(|(at, value)| (at.map(place), scale.colour(*value))));
                }
            }
            // One area for all periodic images: two that meet would show a seam.
            self.drawing.fill(&rings, SOLID, 1.0);
            if !triangles.is_empty() {
                self.drawing.triangles(self.layout.frame.area, triangles.into_iter());
            }
            if !solid.bonds.is_empty() {
                let bonds = all(&solid.bonds);
                self.drawing.strokes(&bonds, &Pen::new(BOND, (0.09 * self.layout.unit).max(0.8)));
            }
            self.drawing.strokes(&edges, &pen);
        }
    }

    fn walls(&mut self) {
        let Some([below, above]) = self.picture.seen.walls else { return };
        let (area, unit) = (self.layout.frame.area, self.layout.unit);
        let y = |height: f64| self.layout.frame.place(0.0, height)[1];
        let (lower, upper) = (y(below), y(above));
        for (top, bottom, face) in [(area.top, upper, upper), (lower, area.bottom(), lower)] {
            let band = Rect { left: area.left, top, width: area.width, height: bottom - top };
            self.drawing.fill(&[band.outline()], SOLID, 1.0);
            self.drawing.clip(Some(band));
            let pen = Pen::new(SOLID_EDGE, (0.05 * unit).max(0.8)).opacity(0.6);
            let mut x = band.left - band.height;
            while x < band.right() {
                self.drawing.stroke(&[[x, band.bottom()], [x + band.height, band.top]], &pen);
                x += 0.55 * unit;
            }
            self.drawing.clip(Some(area));
            let edge = Pen::new(SOLID_EDGE, (0.13 * unit).max(1.2));
            self.drawing.stroke(&[[area.left, face], [area.right(), face]], &edge);
        }
    }

    /// Draws a scale bar of length 1, 2 or 5 times a power of ten, at most a fifth of the picture's width.
    fn scale_bar(&mut self) {
        let (area, em, scale) = (self.layout.frame.area, self.layout.em, self.layout.scale());
        let longest = 0.2 * area.width / scale;
        let length = nice_step_below(longest);
        let (right, y) = (area.right() - 1.2 * em, area.bottom() - 1.0 * em);
        let bar = [[right - length * scale, y], [right, y]];
        self.outlined(&bar, Rgb::INK, [0.2 * em, 0.5 * em], 0.8);
        let label = number(length) + &self.layout.length_unit;
        let at = [right - 0.5 * length * scale, y - 0.95 * em];
        let [width, height] = [text_width(&label, 0.88 * em) + 0.5 * em, 1.1 * em];
        let paper = Rect { left: at[0] - 0.5 * width, top: at[1] - 0.5 * height, width, height };
        self.drawing.fill(&[paper.outline()], Rgb::WHITE, 0.7);
        self.drawing.text(at, &label, &TextStyle::new(0.88 * em, Anchor::Middle));
    }

    fn tracks(&mut self) {
        let picture = self.picture;
        let unit = self.layout.unit;
        for track in &picture.tracks {
            for shift in self.images(&track.iter()) {
                let path = self.layout.path(track, shift);
                self.outlined(&path, TRACK, [0.13 * unit, 0.3 * unit], 0.75);
                if let Some(&start) = path.first() {
                    self.outlined(&[start, start], TRACK, [0.4 * unit, 0.56 * unit], 1.0);
                }
            }
        }
    }

    fn interfaces(&mut self) {
        let (seen, legends) = (self.picture.seen, self.picture.legends);
        let droplets = seen.droplets.iter().map(|droplet| {
            (
                smooth(&droplet.markers, Vec2::ZERO),
                between(&droplet.concentration),
                self.layout.unit_of(&droplet.markers),
            )
        });
        let unit = self.layout.unit;
        let others = seen.interfaces.iter().filter_map(|line| {
            let (last, markers) = line.markers.split_last()?;
            let (_, concentration) = line.concentration.split_last()?;
            Some((smooth(markers, last - markers.first()?), between(concentration), unit))
        });
        let lines: Vec<(Vec<Vec2>, Vec<f64>, f64)> = droplets.chain(others).collect();
        for (markers, concentration, unit) in lines {
            let colours: Option<Vec<Rgb>> = legends
                .concentration
                .as_ref()
                .map(|scale| concentration.into_iter().map(|c| scale.colour(c / legends.unit)).collect());
            for shift in self.images(&markers.iter()) {
                let path = self.layout.path(&markers, shift);
                self.outlined(&path, Rgb::INK, [0.56 * unit, 0.8 * unit], 0.7);
                if let Some(colours) = &colours {
                    self.drawing.stroke_coloured(&path, colours, 0.42 * unit);
                }
            }
        }
    }

    /// Draws triangles at the ends of a colour bar that values exceed.
    fn exceeded(&mut self, scale: &ColourScale, bar: Rect) {
        let pen = Pen::new(Rgb::INK, (0.07 * self.layout.em).max(1.0));
        let ends = [(bar.left, -0.8, scale.low), (bar.right(), 0.8, scale.high)];
        for ((x, out, value), exceeded) in ends.into_iter().zip(scale.exceeded) {
            if exceeded {
                let tip = [x + out * bar.height, bar.top + 0.5 * bar.height];
                let ring = vec![[x, bar.top], tip, [x, bar.bottom()]];
                self.drawing.fill(std::slice::from_ref(&ring), scale.colour(value), 1.0);
                self.drawing.stroke(&ring, &pen);
            }
        }
    }

    fn legends(&mut self) {
        let (area, em) = (self.layout.frame.area, self.layout.em);
        let Legends { pressure, concentration, inside, solids, .. } = self.picture.legends;
        let mut legends = vec![(pressure, self.picture.format.levels)];
        legends.extend([concentration, inside, solids].into_iter().flatten().map(|scale| (scale, 256)));
        let (gap, count) = (3.0 * em, legends.len() as f64);
        let width = (area.width - (count - 1.0) * gap) / count;
        let top = area.bottom() + Frame::bottom_margin(&self.layout.frame.x, em);
        for (k, (scale, levels)) in legends.into_iter().enumerate() {
            let bar = Rect { left: area.left + k as f64 * (width + gap), top, width, height: 0.9 * em }.rounded();
            let table = scale.table(levels);
            let colour = |x: f64| table[(((x - bar.left) / bar.width * levels as f64) as usize).min(levels - 1)];
            self.drawing.shade(bar, |x, _| Some(colour(x)));
            self.exceeded(scale, bar);
            let ticks = ((bar.width / (3.2 * em)) as usize).clamp(2, 6);
            let x = Axis::new(scale.label, [scale.low, scale.high], AxisScale::Linear, ticks);
            Frame { area: bar, x, y: Axis::bare(), em }.draw_axes(&mut self.drawing);
        }
    }
}

#[cfg(test)]
mod tests;
