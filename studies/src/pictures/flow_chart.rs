//! Which method a scene takes, and what it does.

use motile::base::Vec2;
use motile::setup::{Method, MethodKind};

use super::svg::{BLUE, Drawing, GREEN, INK, RED};

fn boxed(drawing: &mut Drawing, at: Vec2, size: Vec2, lines: &[&str], colour: &str) {
    let half = 0.5 * size;
    let corner = |x: f64, y: f64| at + half * Vec2::new(x, y);
    let outline = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0), corner(-1.0, -1.0)];
    drawing.area(&outline, "#f7f7f7");
    drawing.line(&outline, colour, 1.6, false);
    for (k, line) in lines.iter().enumerate() {
        let shift = 0.5 * (lines.len() as f64 - 1.0) - k as f64;
        let (ink, height) = if k == 0 { (colour, 15.0) } else { (INK, 12.0) };
        drawing.text(at + Vec2::new(0.0, 0.24 * shift), line, ink, height);
    }
}

/// The questions that lead to a method.
pub(super) fn picture() -> String {
    let mut drawing = Drawing::new(Vec2::new(0.0, 0.0), Vec2::new(12.0, 5.4), 72.0);
    let default = match Method::default().kind() {
        MethodKind::Integral => "Integral (default)",
        _ => "Integral",
    };
    let (wide, narrow) = (Vec2::new(3.4, 1.5), Vec2::new(3.2, 0.9));
    boxed(&mut drawing, Vec2::new(2.0, 4.7), narrow, &["a scene (Setup)", "region, bodies, method"], INK);
    boxed(&mut drawing, Vec2::new(6.0, 4.7), narrow, &["elastic solids, a gel?"], INK);
    boxed(&mut drawing, Vec2::new(10.0, 4.7), narrow, &["thin films, or another", "viscosity inside?"], INK);
    boxed(&mut drawing, Vec2::new(6.0, 3.3), narrow, &["more than ten droplets?"], INK);
    for (k, (title, lines, colour)) in [
        (
            default,
            [
                "interfaces, rigid bodies, shells",
                "spectral; cost: nodes squared",
                "any viscosity ratio, any rigid wall",
            ],
            BLUE,
        ),
        (
            "Grid",
            ["anything but rigid bodies", "second order; cost: grid cells", "smears other viscosities and solids"],
            GREEN,
        ),
        (
            "Layers",
            ["interfaces and surfaces by integrals,", "inner points of solids on a grid", "films, any viscosity ratio"],
            RED,
        ),
    ]
    .into_iter()
    .enumerate()
    {
        let at = Vec2::new(2.0 + 4.0 * k as f64, 1.1);
        boxed(&mut drawing, at, wide, &[title, lines[0], lines[1], lines[2]], colour);
    }
    let mut arrow = |from: [f64; 2], to: [f64; 2], word: &str| {
        let (from, to) = (Vec2::from(from), Vec2::from(to));
        drawing.arrow(from, to - from, INK, 1.4);
        drawing.text((from + to) * 0.5 + Vec2::new(0.2, 0.2), word, INK, 13.0);
    };
    arrow([3.6, 4.7], [4.4, 4.7], "");
    arrow([7.6, 4.7], [8.4, 4.7], "yes");
    arrow([6.0, 4.25], [6.0, 3.75], "no");
    arrow([10.0, 4.25], [10.0, 1.85], "yes");
    arrow([9.2, 4.25], [7.2, 1.85], "no");
    arrow([6.0, 2.85], [6.0, 1.85], "yes");
    arrow([4.6, 2.85], [2.4, 1.85], "no");
    drawing.finish()
}
