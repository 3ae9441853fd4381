//! Scenes for tests.

use std::f64::consts::TAU;

use motile_base::Vec2;
use motile_boundary_integrals::{PeriodicCalculus, TensionPlacement};
use motile_scene::{MarkerKind, Markers};

/// An ellipse with semi-axes a and b, turned by an angle, with its tension as a function of the parameter.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ellipse {
    pub(crate) centre: [f64; 2],
    pub(crate) axes: [f64; 2],
    pub(crate) angle: f64,
    pub(crate) viscosity: Option<f64>,
    pub(crate) tension: fn(f64) -> f64,
}

impl Ellipse {
    pub(crate) fn circle(x: f64, y: f64, tension: fn(f64) -> f64) -> Self {
        Self { centre: [x, y], axes: [1.0, 1.0], angle: 0.0, viscosity: None, tension }
    }

    pub(crate) fn point(&self, t: f64) -> Vec2 {
        let (x, y) = (self.axes[0] * t.cos(), self.axes[1] * t.sin());
        let (sin, cos) = self.angle.sin_cos();
        Vec2::new(self.centre[0] + cos * x - sin * y, self.centre[1] + sin * x + cos * y)
    }
}

/// Markers of ellipses with spectrally accurate forces.
pub(crate) fn markers(ellipses: &[Ellipse], count: usize) -> Markers {
    let mut markers = Markers::new();
    let mut calculus = PeriodicCalculus::new(count).expect("a valid scene");
    for (index, ellipse) in ellipses.iter().enumerate() {
        markers.push_group(count, MarkerKind::UnevenInterface { viscosity_inside: ellipse.viscosity });
        let range = index * count..(index + 1) * count;
        let angle = |k: usize| TAU * k as f64 / count as f64;
        for (k, position) in markers.positions_mut()[range.clone()].iter_mut().enumerate() {
            *position = ellipse.point(angle(k));
        }
        let tension: Vec<f64> = (0..count).map(|k| (ellipse.tension)(angle(k))).collect();
        let [positions, forces, _] = markers.lists_mut();
        let (positions, forces) = (&positions[range.clone()], &mut forces[range]);
        calculus.tension_forces(positions, &tension, TensionPlacement::Points, forces).expect("a valid scene");
    }
    markers
}
