//! An ellipse that relaxes to a circle, against a reference and against what must be conserved.

use crate::scenes;

use motile_base::{Region, Vec2};
use motile_boundary_integrals::{BoundaryIntegral, PeriodicCalculus, Settings, TensionPlacement};
use motile_scene::{Hydrodynamics, Markers};
use scenes::{Ellipse, markers};

const COUNT: usize = 96;

struct Relaxing {
    solver: BoundaryIntegral,
    calculus: PeriodicCalculus,
    markers: Markers,
}

impl Relaxing {
    fn rate(&mut self, positions: &[Vec2]) -> Vec<Vec2> {
        let [own, forces, _] = self.markers.lists_mut();
        own.copy_from_slice(positions);
        self.calculus.tension_forces(own, &[1.0; COUNT], TensionPlacement::Points, forces).expect("lengths that agree");
        self.solver.velocities(&mut self.markers).expect("a smooth shape");
        self.markers.velocities().to_vec()
    }

    /// One step of the classical Runge-Kutta rule with the markers moving like fluid.
    fn step(&mut self, dt: f64) {
        let start = self.markers.positions().to_vec();
        let along = |rate: &[Vec2], dt: f64| -> Vec<Vec2> { start.iter().zip(rate).map(|(x, v)| x + v * dt).collect() };
        let a = self.rate(&start);
        let b = self.rate(&along(&a, 0.5 * dt));
        let c = self.rate(&along(&b, 0.5 * dt));
        let d = self.rate(&along(&c, dt));
        for (k, x) in self.markers.positions_mut().iter_mut().enumerate() {
            *x = start[k] + (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]) * (dt / 6.0);
        }
    }

    fn area(&self) -> f64 {
        // Exact for a curve of so many modes.
        let mut tangents = vec![Vec2::ZERO; COUNT];
        let mut calculus = PeriodicCalculus::new(COUNT).expect("enough samples");
        calculus.derivative(self.markers.positions(), &mut tangents).expect("lengths that agree");
        let sum: f64 = self.markers.positions().iter().zip(&tangents).map(|(x, t)| x.x * t.y - x.y * t.x).sum();
        std::f64::consts::PI / COUNT as f64 * sum
    }
}

#[test]
fn ellipse_in_a_box() {
    // ellipse_relaxation_box6.csv: viscosity inside, (x_tip, y_tip) at t = 0.5 and 1.
    let table = [
        (1.0, [[1.24217826156, 0.80415200076], [1.19530051236, 0.83558905767]]),
        (10.0, [[1.28645011476, 0.77694838656], [1.27354001814, 0.78451819597]]),
    ];
    for (viscosity, expected) in table {
        let ellipse =
            Ellipse { axes: [1.3, 1.0 / 1.3], viscosity: Some(viscosity), ..Ellipse::circle(0.0, 0.0, |_| 1.0) };
        let settings = Settings { nodes: COUNT, tolerance: 1e-11, ..Settings::default() };
        let region = Region::Box { lengths: [6.0, 6.0] };
        let mut relaxing = Relaxing {
            solver: BoundaryIntegral::new(region, 1.0, settings).expect("settings"),
            calculus: PeriodicCalculus::new(COUNT).expect("enough samples"),
            markers: markers(&[ellipse], COUNT),
        };
        for [x_tip, y_tip] in expected {
            for _ in 0..10 {
                relaxing.step(0.05);
            }
            let positions = relaxing.markers.positions();
            let errors = [(positions[0].x - x_tip).abs(), (positions[COUNT / 4].y - y_tip).abs()];
            println!("viscosity {viscosity}: {errors:?}");
            assert!(errors[0] < 5e-9 && errors[1] < 5e-9, "{errors:?}");
        }
        assert!((relaxing.area() - std::f64::consts::PI).abs() < 1e-8, "{:e}", relaxing.area() - std::f64::consts::PI);
    }
}
