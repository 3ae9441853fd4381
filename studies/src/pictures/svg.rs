//! A drawing in SVG whose y axis points upwards.

use std::fmt::Write as _;

use motile::base::Vec2;

pub(super) const INK: &str = "#222222";
pub(super) const GREY: &str = "#9a9a9a";
pub(super) const BLUE: &str = "#2b6cb0";
pub(super) const RED: &str = "#c0392b";
pub(super) const GREEN: &str = "#2f855a";

/// A picture of `size` (length) whose lower left corner is `corner` (length).
#[derive(Debug)]
pub(super) struct Drawing {
    corner: Vec2,
    size: Vec2,
    scale: f64,
    body: String,
}

impl Drawing {
    /// A drawing of a part of the plane, `scale` pixels a length.
    pub(super) fn new(corner: Vec2, size: Vec2, scale: f64) -> Self {
        Self { corner, size, scale, body: String::new() }
    }

    fn place(&self, x: Vec2) -> [f64; 2] {
        let x = (x - self.corner) * self.scale;
        [x.x, self.size.y * self.scale - x.y]
    }

    /// A line through points, of a width in pixels and perhaps dashed.
    pub(super) fn line(&mut self, points: &[Vec2], colour: &str, width: f64, dashed: bool) {
        let path: Vec<String> = points.iter().map(|x| self.place(*x)).map(|[x, y]| format!("{x:.1} {y:.1}")).collect();
        let dash = if dashed { " stroke-dasharray=\"5 4\"" } else { "" };
        let _ = writeln!(
            self.body,
            "<path d=\"M{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\"{dash}/>",
            path.join("L")
        );
    }

    /// A filled polygon.
    pub(super) fn area(&mut self, points: &[Vec2], colour: &str) {
        let path: Vec<String> = points.iter().map(|x| self.place(*x)).map(|[x, y]| format!("{x:.1} {y:.1}")).collect();
        let _ = writeln!(self.body, "<path d=\"M{}Z\" fill=\"{colour}\"/>", path.join("L"));
    }

    /// A disc whose radius is in pixels.
    pub(super) fn disc(&mut self, at: Vec2, radius: f64, colour: &str) {
        let [x, y] = self.place(at);
        let _ = writeln!(self.body, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"{colour}\"/>");
    }

    /// An arrow from a point by a vector.
    pub(super) fn arrow(&mut self, from: Vec2, by: Vec2, colour: &str, width: f64) {
        let Some(along) = by.try_normalize() else { return };
        let (head, tip) = (3.5 * width.max(1.2) / self.scale, from + by);
        let back = tip - along * head * 1.6;
        self.line(&[from, back], colour, width, false);
        self.area(&[tip, back + along.perp() * 0.6 * head, back - along.perp() * 0.6 * head], colour);
    }

    /// Text around a point, of a size in pixels; a part after `_` is lower.
    pub(super) fn text(&mut self, at: Vec2, text: &str, colour: &str, size: f64) {
        let [x, y] = self.place(at);
        let mut words = String::new();
        for (k, part) in text.split('_').enumerate() {
            if k == 0 {
                words += &escaped(part);
                continue;
            }
            let (low, rest) =
                part.split_once(' ').map_or((part, String::new()), |(low, rest)| (low, format!(" {rest}")));
            let _ = write!(
                words,
                "<tspan baseline-shift=\"sub\" font-size=\"75%\">{}</tspan>{}",
                escaped(low),
                escaped(&rest)
            );
        }
        let _ = writeln!(
            self.body,
            "<text x=\"{x:.1}\" y=\"{:.1}\" fill=\"{colour}\" font-size=\"{size}\" text-anchor=\"middle\">\
             {words}</text>",
            y + 0.35 * size
        );
    }

    /// The file.
    pub(super) fn finish(self) -> String {
        let [width, height] = [self.size.x * self.scale, self.size.y * self.scale];
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" width=\"{width:.0}\" \
             height=\"{height:.0}\" font-family=\"sans-serif\">\n<rect width=\"100%\" height=\"100%\" \
             fill=\"white\"/>\n{}</svg>\n",
            self.body
        )
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
