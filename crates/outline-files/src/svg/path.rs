//! Path data of vector graphics as curves.

use kurbo::{Affine, Arc, BezPath, Point, SvgArc, Vec2};
use svgtypes::{PathParser, PathSegment};

use super::FLATNESS;

/// State of a path that is drawn.
#[derive(Default)]
struct Pen {
    path: BezPath,
    start: Point,
    at: Point,
    /// Last control point of a curve of the third and of the second order, which smooth curves reflect.
    cubic: Option<Point>,
    quadratic: Option<Point>,
    open: bool,
}

/// Returns the curves of path data.
pub(super) fn parse(text: &str) -> Result<BezPath, String> {
    let mut pen = Pen::default();
    for segment in PathParser::from(text) {
        pen.draw(segment.map_err(|error| format!("its path data cannot be read ({error})"))?);
    }
    Ok(pen.path)
}

impl Pen {
    /// Draws a segment.
    fn draw(&mut self, segment: PathSegment) {
        let from = |abs: bool| if abs { Vec2::ZERO } else { self.at.to_vec2() };
        let point = |abs: bool, x: f64, y: f64| Point::new(x, y) + from(abs);
        let reflected = |control: Option<Point>| control.map_or(self.at, |control| self.at + (self.at - control));
        match segment {
            PathSegment::MoveTo { abs, x, y } => {
                let to = point(abs, x, y);
                self.path.move_to(to);
                (self.start, self.open) = (to, true);
                self.arrive(to, None, None);
            }
            PathSegment::LineTo { abs, x, y } => self.line(point(abs, x, y)),
            PathSegment::HorizontalLineTo { abs, x } => {
                let x = if abs { x } else { self.at.x + x };
                self.line(Point::new(x, self.at.y));
            }
            PathSegment::VerticalLineTo { abs, y } => {
                let y = if abs { y } else { self.at.y + y };
                self.line(Point::new(self.at.x, y));
            }
            PathSegment::CurveTo { abs, x1, y1, x2, y2, x, y } => {
                self.cubic(point(abs, x1, y1), point(abs, x2, y2), point(abs, x, y));
            }
            PathSegment::SmoothCurveTo { abs, x2, y2, x, y } => {
                self.cubic(reflected(self.cubic), point(abs, x2, y2), point(abs, x, y));
            }
            PathSegment::Quadratic { abs, x1, y1, x, y } => self.quadratic(point(abs, x1, y1), point(abs, x, y)),
            PathSegment::SmoothQuadratic { abs, x, y } => {
                self.quadratic(reflected(self.quadratic), point(abs, x, y));
            }
            PathSegment::EllipticalArc { abs, rx, ry, x_axis_rotation, large_arc, sweep, x, y } => {
                let to = point(abs, x, y);
                let radii = Vec2::new(rx.abs(), ry.abs());
                let x_rotation = x_axis_rotation.to_radians();
                // In units of the larger radius: the arithmetic of arcs has absolute bounds.
                let size = radii.x.max(radii.y);
                let [from, end] = [self.at, to].map(|point| ((point - self.at) / size).to_point());
                let arc = SvgArc { from, to: end, radii: radii / size, x_rotation, large_arc, sweep };
                let found = if size > 0.0 { Arc::from_svg_arc(&arc) } else { None };
                match found.filter(|arc| arc.radii.is_finite() && arc.center.is_finite()) {
                    Some(arc) => {
                        self.begin();
                        let back = Affine::translate(self.at.to_vec2()) * Affine::scale(size);
                        arc.append_iter(0.1 * FLATNESS).for_each(|element| self.path.push(back * element));
                        self.arrive(to, None, None);
                    }
                    None => self.line(to),
                }
            }
            PathSegment::ClosePath { .. } => {
                if self.open {
                    self.path.close_path();
                }
                self.open = false;
                self.arrive(self.start, None, None);
            }
        }
    }

    /// Begins a part if the last one has ended.
    fn begin(&mut self) {
        if !self.open {
            self.path.move_to(self.at);
            (self.start, self.open) = (self.at, true);
        }
    }

    fn arrive(&mut self, at: Point, cubic: Option<Point>, quadratic: Option<Point>) {
        (self.at, self.cubic, self.quadratic) = (at, cubic, quadratic);
    }

    fn line(&mut self, to: Point) {
        self.begin();
        self.path.line_to(to);
        self.arrive(to, None, None);
    }

    fn cubic(&mut self, first: Point, second: Point, to: Point) {
        self.begin();
        self.path.curve_to(first, second, to);
        self.arrive(to, Some(second), None);
    }

    fn quadratic(&mut self, control: Point, to: Point) {
        self.begin();
        self.path.quad_to(control, to);
        self.arrive(to, None, Some(control));
    }
}
