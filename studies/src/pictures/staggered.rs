//! The staggered grid with markers of an interface, and a layer beside a solid.

use anyhow::Result;
use motile::active_interface::Curve;
use motile::base::Vec2;

use super::svg::{BLUE, Drawing, GREEN, GREY, INK, RED};

/// Cells in both directions, and the radius of the interface in cells.
const CELLS: [u32; 2] = [8, 6];
const RADIUS: f64 = 7.0;
/// Supports of the default kernel along and across a component (cells).
const SUPPORT: [f64; 2] = [4.0, 3.0];

/// A step on the grid: where u, v, p and psi are, markers and segments, and where the kernel takes u from.
pub(super) fn grid() -> Result<String> {
    let [nx, ny] = CELLS.map(f64::from);
    let mut drawing = Drawing::new(Vec2::new(-0.4, -1.4), Vec2::new(nx + 0.8, ny + 1.8), 62.0);
    let marker = Vec2::new(4.3, 3.4);
    let half = 0.5 * Vec2::new(SUPPORT[0], SUPPORT[1]);
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    drawing.area(&corners.map(|[x, y]| marker + half * Vec2::new(x, y)), "#dbe8f5");
    for i in 0..=CELLS[0] {
        drawing.line(&[Vec2::new(f64::from(i), 0.0), Vec2::new(f64::from(i), ny)], "#cccccc", 1.0, false);
    }
    for j in 0..=CELLS[1] {
        drawing.line(&[Vec2::new(0.0, f64::from(j)), Vec2::new(nx, f64::from(j))], "#cccccc", 1.0, false);
    }
    let arm = 0.16;
    for i in 0..=CELLS[0] {
        for j in 0..=CELLS[1] {
            let at = Vec2::new(f64::from(i), f64::from(j));
            drawing.area(
                &[[-1.0, 0.0], [0.0, -1.0], [1.0, 0.0], [0.0, 1.0]].map(|[x, y]| at + 0.07 * Vec2::new(x, y)),
                GREY,
            );
            if j < CELLS[1] {
                let u = at + Vec2::new(0.0, 0.5);
                let near = (u - marker).abs();
                let colour = if near.x < half.x && near.y < half.y { RED } else { BLUE };
                drawing.arrow(u - Vec2::new(arm, 0.0), Vec2::new(2.0 * arm, 0.0), colour, 1.4);
            }
            if i < CELLS[0] {
                drawing.arrow(at + Vec2::new(0.5, -arm), Vec2::new(0.0, 2.0 * arm), GREEN, 1.4);
            }
            if i < CELLS[0] && j < CELLS[1] {
                drawing.disc(at + Vec2::splat(0.5), 2.4, INK);
            }
        }
    }
    // Markers half a cell apart on a circle through the marker.
    let count = (std::f64::consts::TAU * RADIUS / 0.5).round() as usize;
    let centre = marker - RADIUS * Vec2::from_angle(0.62);
    let turned = |x: &Vec2| centre + Vec2::from_angle(0.62).rotate(*x);
    let markers: Vec<Vec2> = Curve::circle(RADIUS)?.markers(count)?.iter().map(turned).collect();
    let seen = |x: &Vec2| x.x > 0.0 && x.x < nx && x.y > 0.0 && x.y < ny;
    for (k, x) in markers.iter().enumerate() {
        let next = markers[(k + 1) % count];
        if seen(x) && seen(&next) {
            drawing.line(&[*x, next], INK, 1.8, false);
        }
    }
    markers.iter().filter(|x| seen(x)).for_each(|x| drawing.disc(*x, 4.0, INK));
    drawing.disc(marker, 5.5, RED);
    drawing.text(marker + Vec2::new(0.42, 0.2), "X_k", RED, 15.0);
    for (x, text, colour) in [
        (0.6, "→ u, f_x", BLUE),
        (2.1, "↑ v, f_y", GREEN),
        (3.4, "• p", INK),
        (4.6, "◆ ψ, ω", GREY),
        (6.6, "● marker, — segment", INK),
    ] {
        drawing.text(Vec2::new(x, -0.5), text, colour, 15.0);
    }
    let caption = "shaded: support of the kernel for u (4 along, 3 across); red u: where X_k takes its velocity from";
    drawing.text(Vec2::new(0.5 * nx, -1.0), caption, RED, 12.0);
    Ok(drawing.finish())
}

/// A droplet's interface and the surface of a solid as layers; the solid's inner points on the grid.
pub(super) fn layers() -> Result<String> {
    let [nx, ny] = CELLS.map(f64::from);
    let mut drawing = Drawing::new(Vec2::new(-0.4, -1.4), Vec2::new(nx + 0.8, ny + 1.8), 62.0);
    let surface = |x: f64| 2.3 + 0.25 * (0.8 * x).cos();
    let line: Vec<Vec2> = (0..=40).map(|k| 0.2 * f64::from(k)).map(|x| Vec2::new(x, surface(x))).collect();
    let wall: Vec<Vec2> = line.iter().copied().chain([Vec2::new(nx, 0.0), Vec2::ZERO]).collect();
    drawing.area(&wall, "#e8e2d5");
    for i in 0..=CELLS[0] {
        drawing.line(&[Vec2::new(f64::from(i), 0.0), Vec2::new(f64::from(i), ny)], "#dddddd", 1.0, false);
    }
    for j in 0..=CELLS[1] {
        drawing.line(&[Vec2::new(0.0, f64::from(j)), Vec2::new(nx, f64::from(j))], "#dddddd", 1.0, false);
    }
    drawing.line(&line, RED, 3.0, false);
    line.iter().step_by(5).for_each(|x| drawing.disc(*x, 3.5, RED));
    let droplet: Vec<Vec2> = Curve::circle(1.6)?.markers(60)?.iter().map(|x| *x + Vec2::new(4.0, 4.3)).collect();
    let closed: Vec<Vec2> = droplet.iter().copied().chain([droplet[0]]).collect();
    drawing.line(&closed, BLUE, 3.0, false);
    droplet.iter().step_by(4).for_each(|x| drawing.disc(*x, 3.5, BLUE));
    // Inner points of an equilateral mesh, two cells apart from the surface or more.
    for row in 0..2_u32 {
        for k in 0..5_u32 {
            let x = Vec2::new(0.5 + 2.0 * f64::from(k) - f64::from(row % 2), 0.25 + 1.0 * f64::from(row));
            if x.x > 0.0 && x.x < nx {
                drawing.disc(x, 4.5, GREEN);
                drawing.line(&[x, Vec2::new(x.x, surface(x.x))], GREEN, 0.7, true);
            }
        }
    }
    for (place, text, colour, size) in [
        (Vec2::new(6.3, 2.75), "film: both layers exact", INK, 14.0),
        (Vec2::new(4.0, 4.3), "droplet", BLUE, 15.0),
        (Vec2::new(6.6, 1.6), "solid", INK, 15.0),
        (Vec2::new(1.6, -0.5), "— L: single layer, no grid", RED, 14.0),
        (Vec2::new(5.8, -0.5), "● P, N, J: by the grid, 2h apart or more", GREEN, 14.0),
        (Vec2::new(0.5 * nx, -1.0), "between both: through the grid, each other's transpose", INK, 14.0),
    ] {
        drawing.text(place, text, colour, size);
    }
    Ok(drawing.finish())
}
