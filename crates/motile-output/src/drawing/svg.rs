//! Drawings as text of SVG files.

use tiny_skia::{Path, PathSegment};

use super::{canvas::Drawing, raster, shapes::Shape};

impl Drawing {
    /// Returns the text of an SVG file of the drawing. Lettering is drawn as outlines, so that it looks the same
    /// everywhere; its wording is in `aria-label` attributes, for search and screen readers.
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
                    base64(&raster::png(image))
                ),
                Shape::ClipInside(path) => {
                    let close = if std::mem::replace(&mut clipped, true) { "</g>" } else { "" };
                    clips += 1;
                    let path = format!("<path d=\"{}\"/>", data(path));
                    format!("{close}<clipPath id=\"c{clips}\">{path}</clipPath><g clip-path=\"url(#c{clips})\">")
                }
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
        let shown = self.size.map(|side| self.per_cm.map_or(short(side), |per_cm| short(side / per_cm) + "cm"));
        let origin = match self.origin.as_str() {
            "" => String::new(),
            text => format!("<metadata>{}</metadata>\n", escape(text)),
        };
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" \
             viewBox=\"0 0 {width} {height}\" fill-rule=\"evenodd\" stroke-linejoin=\"round\" \
             stroke-linecap=\"round\">\n{origin}\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n{body}{close}</svg>\n",
            shown[0], shown[1]
        )
    }
}

/// Returns the coordinate with at most two decimals.
fn short(value: f64) -> String {
    let text = format!("{value:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}

/// Returns the attribute of an opacity below one; empty for one.
fn faint(what: &str, opacity: f64) -> String {
    if opacity < 1.0 { format!(" {what}-opacity=\"{}\"", short(opacity)) } else { String::new() }
}

/// Returns the path data of an element: steps from point to point in tenths of a pixel, between rounded points, so that
/// errors do not add up.
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
        // Without a letter of its own, an `M` after an `M` would be a line.
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

/// Tenths as a decimal number, without superfluous zeros.
fn decimal(tenths: i64) -> String {
    let sign = if tenths < 0 { "-" } else { "" };
    match (tenths.abs() / 10, tenths.abs() % 10) {
        (whole, 0) => format!("{sign}{whole}"),
        (0, rest) => format!("{sign}.{rest}"),
        (whole, rest) => format!("{sign}{whole}.{rest}"),
    }
}

/// Base64 of bytes, padded (RFC 4648).
pub(crate) fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let byte = |k: usize| u32::from(chunk.get(k).copied().unwrap_or(0));
        let group = (byte(0) << 16) | (byte(1) << 8) | byte(2);
        for k in 0..4 {
            let digit = DIGITS[((group >> (18 - 6 * k)) & 63) as usize];
            text.push(if k > chunk.len() { '=' } else { char::from(digit) });
        }
    }
    text
}

/// Returns the text with the characters escaped that XML reserves.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests;
