use motile_base::{FlowSample, Region, Vec2};
use num_complex::Complex64;

use crate::{Interface, InterfaceFlow, Settings};

/// A bent outline about `centre`, shrunk by a factor towards it.
fn outline(angle: f64, centre: Complex64, shrunk: f64) -> Vec2 {
    let shape = Complex64::cis(angle) + 0.2 * Complex64::cis(-angle) + 0.12 * Complex64::cis(2.0 * angle + 0.5);
    let z = centre + shrunk * shape;
    Vec2::new(z.re, z.im)
}

fn angles(count: usize) -> impl Iterator<Item = f64> {
    (0..count).map(move |k| std::f64::consts::TAU * k as f64 / count as f64)
}

/// Points inside down to a millionth of a radius from the outline.
fn points(centre: Complex64) -> Vec<Vec2> {
    let shells = [0.0, 0.4, 0.8, 0.95, 0.999, 1.0 - 1e-6];
    shells.into_iter().flat_map(|shrunk| angles(29).map(move |angle| outline(angle + 0.01, centre, shrunk))).collect()
}

/// Flows of polynomials phi and psi are exact solutions of Stokes' equations.
#[test]
fn velocities_on_a_curve_give_those_inside() {
    let centre = Complex64::new(5.2, -0.3);
    let exact = |at: Vec2| {
        let z = Complex64::new(at.x - 5.0, at.y);
        let phi = Complex64::new(0.3, 0.2) * z * z * z + Complex64::new(-0.1, 0.4) * z;
        let slope = 3.0 * Complex64::new(0.3, 0.2) * z * z + Complex64::new(-0.1, 0.4);
        let psi = Complex64::new(0.5, -0.6) * z * z + Complex64::new(0.2, 0.1);
        let velocity = phi - z * slope.conj() + psi.conj();
        Vec2::new(velocity.re, velocity.im)
    };
    let errors = [24, 48, 96].map(|nodes| {
        let settings = Settings { nodes, tolerance: 1e-13, ..Settings::default() };
        let mut flow = InterfaceFlow::new(Region::Box { lengths: [6.0, 6.0] }, 1.0, settings).unwrap();
        let positions: Vec<Vec2> = angles(nodes + 1).map(|angle| outline(angle, centre, 1.0)).collect();
        let forces = vec![Vec2::ZERO; nodes + 1];
        flow.load([Interface::closed(&positions, &forces, [3.0, 1.0])].into_iter()).unwrap();
        flow.set_velocities(0, &positions.iter().map(|at| exact(*at)).collect::<Vec<_>>()).unwrap();
        // A node is a point like others, and so is the image of a point in a box.
        let mut points = points(centre);
        points.push(positions[0]);
        let mut found = vec![Vec2::ZERO; points.len()];
        flow.velocities_inside(0, &points, &mut found).unwrap();
        let mut image = [Vec2::ZERO];
        flow.velocities_inside(0, &[points[40] - Vec2::new(6.0, 12.0)], &mut image).unwrap();
        assert!(image[0].distance(found[40]) < 1e-12);
        points.iter().zip(&found).map(|(at, found)| found.distance(exact(*at))).fold(0.0, f64::max)
    });
    assert!(errors[0] < 2e-11 && errors[1] < 1e-2 * errors[0] && errors[2] < 1e-10, "{errors:?}");
}

/// The flow of forces, other viscosities and neighbours inside is that which quadrature close to the curves gives.
#[test]
fn velocities_inside_are_those_of_the_layers() {
    let centres = [Complex64::new(0.4, 0.1), Complex64::new(3.1, 0.3)];
    let channel = Region::Channel { length: 7.0, width: 3.6, drive: motile_base::Drive::ZeroFlux };
    for region in [Region::Plane, Region::Box { lengths: [6.5, 5.0] }, channel] {
        for viscosity in [1.0, 20.0, 0.1] {
            let settings = Settings { nodes: 96, tolerance: 1e-11, ..Settings::default() };
            let mut flow = InterfaceFlow::new(region, 1.0, settings).unwrap();
            let curves = centres.map(|centre| angles(96).map(|angle| outline(angle, centre, 1.0)).collect::<Vec<_>>());
            let force = |angle: f64| Vec2::new((2.0 * angle).cos(), (angle + 0.4).sin()) / 96.0;
            let forces: Vec<Vec2> = angles(96).map(force).collect();
            let interfaces = curves.iter().map(|curve| Interface::closed(curve, &forces, [viscosity, 1.0]));
            flow.load(interfaces).unwrap();
            flow.solve().unwrap();
            for (interface, centre) in centres.into_iter().enumerate() {
                let points = points(centre);
                let (mut found, mut seen) = (vec![Vec2::ZERO; points.len()], vec![FlowSample::default(); points.len()]);
                flow.velocities_inside(interface, &points, &mut found).unwrap();
                flow.sample(&points, &mut seen).unwrap();
                let apart = found.iter().zip(&seen).map(|(found, seen)| found.distance(seen.velocity));
                let (apart, fastest) = (apart.fold(0.0, f64::max), seen.iter().map(|seen| seen.velocity.length()));
                let fastest = fastest.fold(0.0, f64::max);
                assert!(apart < 1e-7 * fastest, "{region:?}, viscosity {viscosity}: {apart} of {fastest}");
            }
        }
    }
}
