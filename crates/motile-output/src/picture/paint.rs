//! The picture of a flow: how it is drawn.

use crate::{
    Error, Format, Picture, Rgb, Vec2,
    drawing::{
        Anchor, Pen, Pixel, Rect, Surface, TextStyle,
        axes::{Axis, AxisScale, Frame, TICK_SIZE},
        canvas::Canvas,
        font::text_width,
        image::Image,
        ticks::{nice_step_below, number},
    },
    picture::colour_bar::Legend,
    streamlines,
};

/// Colours of solids and walls.
const SOLID: Rgb = Rgb([196, 190, 180]);
const SOLID_EDGE: Rgb = Rgb([92, 84, 74]);
/// Colour of tracks.
const TRACK: Rgb = Rgb([20, 60, 150]);
/// Thickness of the band that shows a rigid wall, relative to the distance of the walls.
const WALL: f64 = 0.07;
/// Pictures wider than this, relative to their height, have their colour bars below.
const WIDE: f64 = 1.7;

pub(crate) fn paint(picture: &Picture, format: &Format) -> Result<Image, Error> {
    Error::check_size("a picture with a width (pixels)", format.width as f64, 160.0, 8000.0)?;
    Error::check_size("a picture with a width (sizes of its type)", format.type_sizes, 20.0, 1000.0)?;
    let layout = Layout::new(picture, format);
    let canvas = Canvas::new(format.width, layout.height)?;
    let mut painter = Painter { picture, levels: format.levels.max(2), canvas, layout };
    painter.canvas.clip(Some(painter.layout.frame.area));
    painter.field();
    painter.streamlines(format.streamline_spacing)?;
    painter.solids();
    painter.walls();
    painter.tracks();
    painter.interfaces();
    painter.scale_bar();
    painter.canvas.clip(None);
    painter.layout.frame.draw_axes(&mut painter.canvas);
    painter.legends();
    let (area, em) = (painter.layout.frame.area, painter.layout.em);
    let style = TextStyle::new(1.05 * em, Anchor::Start);
    painter.canvas.text([area.left, area.top - 1.15 * em], &picture.title, &style);
    Ok(painter.canvas.into_image())
}

/// Where the parts of a picture are.
struct Layout {
    frame: Frame,
    height: usize,
    /// Size of the type (pixels).
    em: f64,
    /// The unit of widths of lines in the picture (pixels): the size of the type, less where the picture is low.
    unit: f64,
    wide: bool,
}

impl Layout {
    fn new(picture: &Picture, format: &Format) -> Self {
        let [mut low, mut high] = picture.view;
        if let Some([below, above]) = picture.walls {
            let band = WALL * (above - below).abs();
            low[1] = low[1].min(below - band);
            high[1] = high[1].max(above + band);
        }
        let shape = (high[0] - low[0]) / (high[1] - low[1]);
        let wide = shape > WIDE;
        let width = format.width as f64;
        let em = (width / format.type_sizes).max(9.0);
        let axis = |k: usize, name: &str, ticks: usize| {
            let label = format!("{name} ({})", picture.length_unit);
            Axis::new(&label, [low[k], high[k]], AxisScale::Linear, ticks)
        };
        let across = if wide { 10 } else { 7 };
        let rough_height = (width - 8.0 * em) / shape;
        let (x, y) = (axis(0, "x", across), axis(1, "y", ((rough_height / (2.2 * em)) as usize).clamp(2, 8)));
        let left = Frame::left_margin(&y, em).round();
        let right = if wide { 1.4 } else { 2.2 + Legend::UPRIGHT_MARGIN } * em;
        let top = if picture.title.is_empty() { 1.0 } else { 2.4 } * em;
        let bars = if wide { 1.1 + Legend::LYING_MARGIN } else { 0.0 } * em;
        let inner = (width - left - right).round().max(1.0);
        let area = Rect { left, top: top.round(), width: inner, height: (inner / shape).round().max(1.0) };
        let height = area.bottom() + Frame::bottom_margin(&x, em) + bars;
        Self {
            height: height.round() as usize,
            frame: Frame { area, x, y, em },
            em,
            unit: em.min(area.height / 13.0),
            wide,
        }
    }

    fn place(&self, p: Vec2) -> Pixel {
        self.frame.place(p.x, p.y)
    }

    /// Pixels a unit of length.
    fn scale(&self) -> f64 {
        self.frame.area.width / (self.frame.x.high - self.frame.x.low)
    }
}

struct Painter<'a> {
    picture: &'a Picture,
    levels: usize,
    canvas: Canvas,
    layout: Layout,
}

impl Painter<'_> {
    /// The shifts that bring periodic images of points within a box around them into view.
    fn images<'p>(&self, points: &(impl Iterator<Item = &'p Vec2> + Clone)) -> Vec<Vec2> {
        let raster = self.picture.field.raster();
        let frame = &self.layout.frame;
        // Half a type size more, for the width of lines.
        let margin = 0.5 * self.layout.em / self.layout.scale();
        let axis = |k: usize, low: f64, high: f64| {
            if !raster.periodic()[k] {
                return vec![0.0];
            }
            let values = points.clone().map(|p| p[k]).filter(|v| v.is_finite());
            let (first, last) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
            let period = raster.size()[k];
            let from = ((low - margin - last) / period).ceil() as i64;
            let to = ((high + margin - first) / period).floor() as i64;
            (from..=to).take(100).map(|m| m as f64 * period).collect()
        };
        let (xs, ys) = (axis(0, frame.x.low, frame.x.high), axis(1, frame.y.low, frame.y.high));
        ys.into_iter().flat_map(|y| xs.iter().map(move |&x| Vec2::new(x, y))).collect()
    }

    fn path(&self, points: &[Vec2], shift: Vec2) -> Vec<Pixel> {
        points.iter().map(|&p| self.layout.place(p + shift)).collect()
    }

    fn field(&mut self) {
        let (field, scale) = (&self.picture.field, &self.picture.field_legend.scale);
        let levels = self.levels;
        let (table, [low, high]) = (scale.table(levels), scale.ends());
        let area = self.layout.frame.area;
        let (x0, y1) = (self.layout.frame.x.low, self.layout.frame.y.high);
        let length = 1.0 / self.layout.scale();
        self.canvas.shade(area, |x, y| {
            let point = Vec2::new(x0 + (x - area.left) * length, y1 - (y - area.top) * length);
            let value = field.raster().covers(point).then(|| field.at(point))?;
            let level = (value - low) / (high - low) * levels as f64;
            level.is_finite().then(|| table[(level.max(0.0) as usize).min(levels - 1)])
        });
    }

    fn streamlines(&mut self, factor: f64) -> Result<(), Error> {
        let Some(flow) = &self.picture.flow else { return Ok(()) };
        // Lines closer than half a size of the type would be a grey area.
        let least = 0.55 * self.layout.em / self.layout.scale();
        let spacing = (flow.spacing * factor).max(least);
        let unit = self.layout.unit;
        let pen = Pen::new(Rgb::INK, (0.07 * unit).max(0.9)).opacity(0.72);
        for line in streamlines(&flow.velocity, spacing, flow.anchor)? {
            for shift in self.images(&line.iter()) {
                let path = self.path(&line, shift);
                self.canvas.stroke(&path, &pen);
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

    /// An arrow head about `at`, pointing on to `next`.
    fn head(&mut self, at: Pixel, next: Pixel, size: f64) {
        let (dx, dy) = (next[0] - at[0], next[1] - at[1]);
        let scale = size / dx.hypot(dy).max(1e-300);
        let (c, s) = (dx * scale, dy * scale);
        let corner = |along: f64, across: f64| [at[0] + along * c - across * s, at[1] + along * s + across * c];
        let ring = vec![corner(0.6, 0.0), corner(-0.4, 0.36), corner(-0.22, 0.0), corner(-0.4, -0.36)];
        self.canvas.fill(&[ring], Rgb::INK, 0.85);
    }

    fn solids(&mut self) {
        let picture = self.picture;
        let pen = Pen::new(SOLID_EDGE, (0.1 * self.layout.unit).max(1.0));
        for solid in &picture.solids {
            for shift in self.images(&solid.area.iter().flatten()) {
                let rings: Vec<Vec<Pixel>> = solid.area.iter().map(|ring| self.path(ring, shift)).collect();
                self.canvas.fill(&rings, SOLID, 1.0);
                for line in &solid.edges {
                    let line = self.path(line, shift);
                    self.canvas.stroke(&line, &pen);
                }
            }
        }
    }

    fn walls(&mut self) {
        let Some([below, above]) = self.picture.walls else { return };
        let (area, unit) = (self.layout.frame.area, self.layout.unit);
        let y = |height: f64| self.layout.frame.place(0.0, height)[1];
        let (lower, upper) = (y(below), y(above));
        let bands = [(area.top, upper, upper), (lower, area.bottom(), lower)];
        for (top, bottom, face) in bands {
            let band = Rect { left: area.left, top, width: area.width, height: bottom - top };
            if band.height <= 0.0 {
                continue;
            }
            self.canvas.fill(&[band.outline()], SOLID, 1.0);
            self.canvas.clip(Some(band));
            let pen = Pen::new(SOLID_EDGE, (0.05 * unit).max(0.8)).opacity(0.6);
            let mut x = band.left - band.height;
            while x < band.right() {
                self.canvas.stroke(&[[x, band.bottom()], [x + band.height, band.top]], &pen);
                x += 0.55 * unit;
            }
            self.canvas.clip(Some(area));
            let edge = Pen::new(SOLID_EDGE, (0.13 * unit).max(1.2));
            self.canvas.stroke(&[[area.left, face], [area.right(), face]], &edge);
        }
    }

    fn tracks(&mut self) {
        let picture = self.picture;
        let unit = self.layout.unit;
        for track in &picture.tracks {
            for shift in self.images(&track.iter()) {
                let path = self.path(track, shift);
                self.canvas.stroke(&path, &Pen::new(Rgb::WHITE, 0.3 * unit).opacity(0.75));
                self.canvas.stroke(&path, &Pen::new(TRACK, 0.13 * unit));
                if let Some(&start) = path.first() {
                    self.canvas.stroke(&[start, start], &Pen::new(Rgb::WHITE, 0.56 * unit));
                    self.canvas.stroke(&[start, start], &Pen::new(TRACK, 0.4 * unit));
                }
            }
        }
    }

    fn interfaces(&mut self) {
        let picture = self.picture;
        let unit = self.layout.unit;
        for curve in &picture.interfaces {
            let colour = |v: &f64| picture.interface_legend.as_ref().map_or(Rgb::INK, |l| l.scale.colour(*v));
            let mut colours: Vec<Rgb> = curve.values.iter().map(colour).collect();
            colours.push(colours[0]);
            for shift in self.images(&curve.points.iter()) {
                let mut path = self.path(&curve.points, shift);
                path.push(path[0]);
                self.canvas.stroke(&path, &Pen::new(Rgb::WHITE, 0.8 * unit).opacity(0.7));
                self.canvas.stroke(&path, &Pen::new(Rgb::INK, 0.56 * unit));
                self.canvas.stroke_coloured(&path, &colours, 0.42 * unit);
            }
        }
    }

    fn scale_bar(&mut self) {
        let (frame, em) = (&self.layout.frame, self.layout.em);
        let area = frame.area;
        if area.height < 8.0 * em {
            return;
        }
        let longest = (0.17 * (frame.x.high - frame.x.low)).min(0.45 * (frame.y.high - frame.y.low));
        let length = nice_step_below(longest);
        let width = length * self.layout.scale();
        let label = format!("{} {}", number(length), self.picture.length_unit);
        let lift = self.picture.walls.map_or(area.bottom(), |[below, _]| frame.place(0.0, below)[1]);
        let panel = Rect {
            left: area.left + 0.7 * em,
            top: lift.min(area.bottom()) - 2.9 * em,
            width: width.max(text_width(&label, TICK_SIZE * em)) + 1.4 * em,
            height: 2.2 * em,
        };
        self.canvas.fill(&[panel.outline()], Rgb::WHITE, 0.82);
        let (middle, y) = (panel.left + 0.5 * panel.width, panel.bottom() - 0.6 * em);
        let bar = [[middle - 0.5 * width, y], [middle + 0.5 * width, y]];
        self.canvas.stroke(&bar, &Pen::new(Rgb::INK, 0.2 * em));
        self.canvas.text([middle, panel.top + 0.7 * em], &label, &TextStyle::new(TICK_SIZE * em, Anchor::Middle));
    }

    fn legends(&mut self) {
        let (area, em, wide) = (self.layout.frame.area, self.layout.em, self.layout.wide);
        let field = Some((&self.picture.field_legend, self.levels));
        let legends: Vec<(&Legend, usize)> =
            field.into_iter().chain(self.picture.interface_legend.iter().map(|legend| (legend, 256))).collect();
        let count = legends.len() as f64;
        let gap = if wide { 3.0 * em } else { 1.6 * em };
        let whole = if wide { area.width } else { area.height };
        let length = (whole - (count - 1.0) * gap) / count;
        for (k, (legend, levels)) in legends.into_iter().enumerate() {
            let offset = k as f64 * (length + gap);
            let bar = if wide {
                let top = area.bottom() + Frame::bottom_margin(&self.layout.frame.x, em);
                Rect { left: area.left + offset, top, width: length, height: 0.9 * em }
            } else {
                Rect { left: area.right() + 0.9 * em, top: area.top + offset, width: 0.9 * em, height: length }
            };
            legend.draw(&mut self.canvas, bar.rounded(), em, !wide, levels);
        }
    }
}
