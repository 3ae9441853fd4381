//! Vector drawings as SVG files.
//!
//! Written by hand: lines, areas and text are three elements, and their coordinates keep fractions of a pixel, which
//! drawing libraries with integer coordinates round away.

use crate::{
    Rgb,
    drawing::{Pen, Pixel, Rect, Surface},
};

/// A drawing that is written as SVG. Its text is drawn, so that it looks the same everywhere; what it says is in the
/// `aria-label` attributes, for search and screen readers.
#[derive(Debug, Clone)]
pub(crate) struct Svg {
    size: [f64; 2],
    body: String,
    clips: usize,
    clipped: bool,
}

impl Svg {
    /// A white drawing of the given width and height (pixels).
    pub(crate) fn new(size: [f64; 2]) -> Self {
        Self { size, body: String::new(), clips: 0, clipped: false }
    }

    /// The drawing as the text of an SVG file.
    pub(crate) fn document(&self) -> String {
        let [width, height] = self.size.map(short);
        let close = if self.clipped { "</g>\n" } else { "" };
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n{}{close}</svg>\n",
            self.body
        )
    }

    fn push(&mut self, element: &str) {
        self.body.push_str(element);
        self.body.push('\n');
    }
}

/// A coordinate with at most two decimals.
fn short(value: f64) -> String {
    let text = format!("{value:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}

/// Corners as the data of a path element, `None` with one that is not finite.
fn path_data(path: &[Pixel]) -> Option<String> {
    let finite = !path.is_empty() && path.iter().flatten().all(|v| v.is_finite());
    let corners = || path.iter().map(|p| format!("{} {}", short(p[0]), short(p[1]))).collect::<Vec<_>>().join("L");
    finite.then(|| format!("M{}", corners()))
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

impl Surface for Svg {
    fn strokes(&mut self, paths: &[Vec<Pixel>], label: &str, pen: &Pen) {
        let Some(data) = paths.iter().map(|path| path_data(path)).collect::<Option<String>>() else { return };
        if data.is_empty() {
            return;
        }
        let (colour, width) = (pen.colour.hex(), short(pen.width));
        let label = if label.is_empty() { String::new() } else { format!(" aria-label=\"{}\"", escape(label)) };
        let opacity =
            if pen.opacity < 1.0 { format!(" stroke-opacity=\"{}\"", short(pen.opacity)) } else { String::new() };
        self.push(&format!(
            "<path{label} d=\"{data}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\"{opacity} \
             stroke-linejoin=\"round\" stroke-linecap=\"round\"/>"
        ));
    }

    fn fill(&mut self, rings: &[Vec<Pixel>], colour: Rgb, opacity: f64) {
        let Some(data) = rings.iter().map(|r| path_data(r)).collect::<Option<Vec<_>>>() else { return };
        let opacity = if opacity < 1.0 { format!(" fill-opacity=\"{}\"", short(opacity)) } else { String::new() };
        let data = data.join("Z");
        self.push(&format!("<path d=\"{data}Z\" fill-rule=\"evenodd\" fill=\"{}\"{opacity}/>", colour.hex()));
    }

    fn clip(&mut self, to: Option<Rect>) {
        if self.clipped {
            self.push("</g>");
        }
        self.clipped = to.is_some();
        if let Some(rect) = to {
            self.clips += 1;
            let id = self.clips;
            let [l, t, w, h] = [rect.left, rect.top, rect.width, rect.height].map(short);
            self.push(&format!(
                "<clipPath id=\"c{id}\"><rect x=\"{l}\" y=\"{t}\" width=\"{w}\" height=\"{h}\"/></clipPath>\n\
                 <g clip-path=\"url(#c{id})\">"
            ));
        }
    }
}

#[cfg(test)]
mod tests;
