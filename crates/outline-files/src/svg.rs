//! Outlines in vector graphics.

mod path;

use kurbo::{Affine, BezPath, Circle, Ellipse, PathEl, Point, Rect, Shape as _};
use motile_base::Vec2;
use roxmltree::{Document, Node, ParsingOptions};

use crate::error::quoted;
use crate::file::MOST_POINTS;
use crate::{Contour, OutlineError};

/// Distance of the points of a curve from it, over the extent of the path (no dimension).
const FLATNESS: f64 = 2e-5;
/// Elements whose contents are not drawn themselves.
const NOT_DRAWN: [&str; 9] =
    ["defs", "clipPath", "mask", "pattern", "marker", "symbol", "metadata", "linearGradient", "radialGradient"];

/// Returns the outlines of a picture, with the transforms of its groups, in the coordinates of the outermost viewBox.
pub(crate) fn read(text: &str) -> Result<Vec<Contour>, OutlineError> {
    let options = ParsingOptions { allow_dtd: true, nodes_limit: 4_000_000, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|error| {
        OutlineError::format(format!("line {}", error.pos().row), error.to_string(), "Save it as SVG")
    })?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        let problem = format!("its first element is {:?}, not \"svg\"", quoted(root.tag_name().name()));
        return Err(OutlineError::format("the file", problem, "Use CSV, SVG, GeoJSON or an ImageJ region of interest"));
    }
    let mut contours = Vec::new();
    // A stack instead of recursion: elements may be nested deeply.
    let mut stack = vec![(root, Affine::IDENTITY)];
    while let Some((node, outer)) = stack.pop() {
        let name = node.tag_name().name();
        if NOT_DRAWN.contains(&name) {
            continue;
        }
        let place = || format!("line {}", document.text_pos_at(node.range().start).row);
        let refuse = |problem: String, remedy| Err(OutlineError::format(place(), problem, remedy));
        if name == "use" || (name == "svg" && node != root) {
            let remedy = "In Inkscape, unlink clones and ungroup (Edit > Clone > Unlink clone), then save again";
            return refuse(format!("a {name:?} element within the picture is not followed"), remedy);
        }
        if node.attribute("style").is_some_and(|style| style.contains("transform")) {
            return refuse("a transform in a style is not followed".to_owned(), "Use the attribute transform");
        }
        let transform = outer
            * transform_of(node)
                .map_err(|problem| OutlineError::format(place(), problem, "Correct the attribute transform"))?;
        let path = path_of(node).map_err(|problem| OutlineError::format(place(), problem, "Correct this element"))?;
        if let Some(path) = path {
            let name =
                node.attribute("id").or_else(|| node.attributes().find(|a| a.name() == "label").map(|a| a.value()));
            add(&(transform * path), name, &mut contours)
                .map_err(|problem| OutlineError::format(place(), problem, "Correct this element"))?;
        }
        // In the order of the file.
        let children: Vec<Node<'_, '_>> = node.children().filter(Node::is_element).collect();
        stack.extend(children.into_iter().rev().map(|child| (child, transform)));
    }
    if contours.is_empty() {
        let remedy = "Convert text and objects to paths (in Inkscape, Path > Object to path), then save again";
        return Err(OutlineError::format("the picture", "it has no path, polygon, rectangle or ellipse", remedy));
    }
    Ok(contours)
}

/// Returns the transform of an element.
fn transform_of(node: Node<'_, '_>) -> Result<Affine, String> {
    let Some(text) = node.attribute("transform") else { return Ok(Affine::IDENTITY) };
    let t: svgtypes::Transform = text.parse().map_err(|error: svgtypes::Error| error.to_string())?;
    Ok(Affine::new([t.a, t.b, t.c, t.d, t.e, t.f]))
}

/// Returns the path of an element; `None` for one that has none.
fn path_of(node: Node<'_, '_>) -> Result<Option<BezPath>, String> {
    let number = |key: &str| -> Result<Option<f64>, String> {
        let Some(text) = node.attribute(key) else { return Ok(None) };
        let plain = text.trim().trim_end_matches("px").trim();
        let number = plain.parse().map_err(|_| format!("{key} = {:?} is not a number of pixels", quoted(text)))?;
        Ok(Some(number))
    };
    let or_zero = |key: &str| Ok::<f64, String>(number(key)?.unwrap_or(0.0));
    Ok(Some(match node.tag_name().name() {
        "path" => {
            let text = node.attribute("d").unwrap_or_default();
            path::parse(text)?
        }
        "polygon" | "polyline" => {
            let text = node.attribute("points").unwrap_or_default();
            let mut path = BezPath::new();
            for (k, (x, y)) in svgtypes::PointsParser::from(text).enumerate() {
                if k == 0 { path.move_to((x, y)) } else { path.line_to((x, y)) }
            }
            if node.tag_name().name() == "polygon" && !path.is_empty() {
                path.close_path();
            }
            path
        }
        "circle" => Circle::new((or_zero("cx")?, or_zero("cy")?), or_zero("r")?)
            .to_path(FLATNESS * or_zero("r")?.abs().max(1e-300)),
        "ellipse" => {
            let radii = (or_zero("rx")?, or_zero("ry")?);
            let size = f64::max(radii.0.abs(), radii.1.abs()).max(1e-300);
            Ellipse::new((or_zero("cx")?, or_zero("cy")?), radii, 0.0).to_path(FLATNESS * size)
        }
        "rect" => {
            let [x, y, width, height] = [or_zero("x")?, or_zero("y")?, or_zero("width")?, or_zero("height")?];
            let [rx, ry] = [number("rx")?, number("ry")?];
            let [rx, ry] = [rx.or(ry).unwrap_or(0.0), ry.or(rx).unwrap_or(0.0)];
            if rx != ry {
                return Err("a rectangle with elliptic corners is not read".to_owned());
            }
            let size = width.abs().max(height.abs()).max(1e-300);
            let rect = Rect::new(x, y, x + width, y + height);
            if rx > 0.0 { rect.to_rounded_rect(rx).to_path(FLATNESS * size) } else { rect.to_path(FLATNESS * size) }
        }
        _ => return Ok(None),
    }))
}

/// Adds the parts of a path, each flattened to points.
fn add(path: &BezPath, name: Option<&str>, to: &mut Vec<Contour>) -> Result<(), String> {
    let finite = |element: &PathEl| match element {
        PathEl::MoveTo(a) | PathEl::LineTo(a) => a.is_finite(),
        PathEl::QuadTo(a, b) => a.is_finite() && b.is_finite(),
        PathEl::CurveTo(a, b, c) => a.is_finite() && b.is_finite() && c.is_finite(),
        PathEl::ClosePath => true,
    };
    if !path.elements().iter().all(finite) {
        return Err("its coordinates are not finite".to_owned());
    }
    let bounds = path.control_box();
    let extent = bounds.width().max(bounds.height());
    if !(extent.is_finite() && extent > 0.0) {
        return Err("its points coincide".to_owned());
    }
    let (first, mut parts) = (to.len(), 0);
    let mut too_many = false;
    let mut count = 0;
    let label = |part: usize| match (name, part) {
        (Some(name), 1) => Some(name.to_owned()),
        (Some(name), part) => Some(format!("{name} ({part})")),
        _ => None,
    };
    // In units of the extent about a corner: the arithmetic of curves has absolute bounds.
    let corner = bounds.origin().to_vec2();
    let unit = Affine::scale(1.0 / extent) * Affine::translate(-corner);
    kurbo::flatten(unit * path, FLATNESS, |element| {
        count += 1;
        too_many |= count > MOST_POINTS;
        if too_many {
            return;
        }
        let at = |point: Point| Vec2::new(point.x * extent + corner.x, point.y * extent + corner.y);
        match element {
            PathEl::MoveTo(point) => {
                parts += 1;
                to.push(Contour { name: label(parts), points: vec![at(point)], closed: false });
            }
            PathEl::LineTo(point) => {
                if let Some(last) = to.last_mut() {
                    last.points.push(at(point));
                }
            }
            PathEl::ClosePath => {
                if let Some(last) = to.last_mut() {
                    last.closed = true;
                }
            }
            // Flattened paths have no curves.
            PathEl::QuadTo(..) | PathEl::CurveTo(..) => {}
        }
    });
    if too_many {
        return Err(format!("its curves have more than {MOST_POINTS} points"));
    }
    // A part that ends where it began is closed too; a move alone is no outline.
    for part in &mut to[first..] {
        part.closed |= part.points.len() > 2 && part.points.first() == part.points.last();
    }
    let mut k = 0;
    to.retain(|part| {
        k += 1;
        k <= first || part.points.len() > 1
    });
    Ok(())
}

#[cfg(test)]
mod tests;
