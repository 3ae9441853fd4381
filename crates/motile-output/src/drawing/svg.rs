//! Drawings as SVG files.

use tiny_skia::{Path, PathSegment};

use super::{Drawing, Shape, raster};
use crate::base64;

impl Drawing {
    /// The drawing as the text of an SVG file. Its text is drawn, so that it looks the same everywhere; what it says is
    /// in the `aria-label` attributes, for search and screen readers.
    pub(crate) fn svg(&self) -> String {
        let (mut body, mut clips, mut clipped) = (String::new(), 0, false);
        for shape in &self.shapes {
            let element = match shape {
                Shape::Area { path, colour, opacity, label } => {
                    let label =
                        if label.is_empty() { label.clone() } else { format!(" aria-label=\"{}\"", escape(label)) };
                    let opacity = faint("fill", *opacity);
                    let (data, colour) = (data(path), colour.hex());
                    format!("<path{label} d=\"{data}\" fill=\"{colour}\"{opacity}/>")
                }
                Shape::Line { path, pen } => format!(
                    "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{}/>",
                    data(path),
                    pen.colour.hex(),
                    short(pen.width),
                    faint("stroke", pen.opacity)
                ),
                Shape::Image { corner, image } => format!(
                    "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" style=\"image-rendering:pixelated\" \
                     href=\"data:image/png;base64,{}\"/>",
                    short(corner[0]),
                    short(corner[1]),
                    image.width(),
                    image.height(),
                    base64::encode(&raster::png(image))
                ),
                Shape::Clip(to) => {
                    let close = if std::mem::replace(&mut clipped, to.is_some()) { "</g>" } else { "" };
                    let open = to.map(|rect| {
                        clips += 1;
                        let [x, y, w, h] = [rect.left, rect.top, rect.width, rect.height].map(short);
                        let rect = format!("<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"/>");
                        format!("<clipPath id=\"c{clips}\">{rect}</clipPath><g clip-path=\"url(#c{clips})\">")
                    });
                    format!("{close}{}", open.unwrap_or_default())
                }
            };
            body.push_str(&element);
            body.push('\n');
        }
        let [width, height] = self.size.map(short);
        let close = if clipped { "</g>\n" } else { "" };
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" fill-rule=\"evenodd\" stroke-linejoin=\"round\" \
             stroke-linecap=\"round\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n{body}{close}</svg>\n"
        )
    }
}

/// A coordinate with at most two decimals.
fn short(value: f64) -> String {
    let text = format!("{value:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}

/// The attribute of an opacity below one.
fn faint(what: &str, opacity: f64) -> String {
    if opacity < 1.0 { format!(" {what}-opacity=\"{}\"", short(opacity)) } else { String::new() }
}

/// A path as the data of an element: from point to point in tenths of a pixel, each rounded for itself, so that errors
/// do not add up.
fn data(path: &Path) -> String {
    let tenths = |p: tiny_skia::Point| [p.x, p.y].map(|v| (10.0 * v).round() as i64);
    let (mut data, mut last, mut at, mut start) = (String::new(), ' ', [0; 2], [0; 2]);
    for segment in path.segments() {
        let (letter, points) = match segment {
            PathSegment::MoveTo(p) => ('M', vec![p]),
            PathSegment::LineTo(p) => ('l', vec![p]),
            PathSegment::QuadTo(c, p) => ('q', vec![c, p]),
            PathSegment::CubicTo(c, d, p) => ('c', vec![c, d, p]),
            PathSegment::Close => ('z', Vec::new()),
        };
        if letter == 'M' {
            at = [0; 2];
        }
        // Points that follow the first of an `M` would be lines.
        let mut separate = letter == last && letter != 'M';
        if !separate {
            data.push(letter);
        }
        for point in &points {
            for (value, origin) in tenths(*point).into_iter().zip(at) {
                let number = value - origin;
                if separate && number >= 0 {
                    data.push(' ');
                }
                separate = true;
                data.push_str(&decimal(number));
            }
        }
        at = points.last().map_or(start, |point| tenths(*point));
        if letter == 'M' {
            start = at;
        }
        last = letter;
    }
    data
}

/// Tenths as a number, without zeros that say nothing.
fn decimal(tenths: i64) -> String {
    let sign = if tenths < 0 { "-" } else { "" };
    match (tenths.abs() / 10, tenths.abs() % 10) {
        (whole, 0) => format!("{sign}{whole}"),
        (0, rest) => format!("{sign}.{rest}"),
        (whole, rest) => format!("{sign}{whole}.{rest}"),
    }
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests;
