use motile::base::Region;
use motile::setup::{ExchangeSetup, ExcludedVolume, IntegralMethod, Method, Setup};
use stokes_boundary_integrals::{Interface, Settings};

use super::*;
use crate::SteadyState;
use crate::modes::Part;
use crate::system::System;

/// Field of an ellipse, off the origin, in the flow `velocity` on and in it.
fn field(velocity: impl Fn(Vec2) -> Vec2, concentration: impl Fn(Vec2, Vec2) -> f64) -> (Field, Vec<Vec2>) {
    let nodes = 64;
    let curve = |k: usize| {
        let (sin, cos) = (TAU * k as f64 / nodes as f64).sin_cos();
        (Vec2::new(0.3 + 1.2 * cos, 0.8 * sin - 0.1), Vec2::new(-1.2 * sin, 0.8 * cos))
    };
    let (positions, tangents): (Vec<Vec2>, Vec<Vec2>) = (0..nodes).map(curve).unzip();
    let normal = |t: &Vec2| -t.perp().normalize();
    let places = positions.iter().zip(&tangents);
    let concentrations: Vec<f64> = places.map(|(x, t)| concentration(*x, normal(t))).collect();
    let mut flow = Flow::new(Region::Plane, 1.0, Settings { nodes, ..Settings::default() }).unwrap();
    let forces = vec![Vec2::ZERO; nodes];
    flow.solve(std::iter::once(Interface::closed(&positions, &forces, [1.0; 2]))).unwrap();
    let mut field = Field::new(0.3, Exchange::new(0.7, 0.2).unwrap(), nodes);
    let wall = Wall { positions: &positions, tangents: &tangents, concentrations: &concentrations };
    // Nothing flows but the frame.
    field.solve(wall, &mut flow, |x| -velocity(x)).unwrap();
    (field, positions)
}

/// A frame that moves at a uniform velocity through fluid at rest: exact solutions are exponentials along it.
#[test]
fn exponentials_along_a_stream_are_exact() {
    let [speed, diffusion, binding, unbinding] = [0.6, 0.3, 0.7, 0.2];
    let rate = speed / diffusion;
    let exact = |x: Vec2| 2.0 + (rate * x.x).exp();
    // The flux of b w - D grad b leaves through the interface: that of 2 w alone, as the exponential carries none.
    let concentration = |x: Vec2, n: Vec2| (binding * exact(x) - 2.0 * speed * n.x) / unbinding;
    let (field, positions) = field(|_| Vec2::new(speed, 0.0), concentration);
    for (x, found) in positions.iter().zip(&field.wall) {
        assert!((found / exact(*x) - 1.0).abs() < 1e-9, "{found} {}", exact(*x));
    }
    let lengths = field.weights.iter().sum::<f64>();
    assert!((lengths / (0.96 * PI) - 1.0).abs() < 1e-12);
    let number: f64 = field.points.iter().zip(field.weights.iter()).map(|(x, weight)| exact(*x) * weight).sum();
    assert!((field.number / number - 1.0).abs() < 1e-10);
}

#[test]
fn as_many_bind_as_unbind_in_any_flow() {
    let (field, positions) = field(|x| Vec2::new(x.y, -0.4 * x.x), |x, _| 2.0 + x.x);
    let step = TAU / positions.len() as f64;
    let lengths = (0..positions.len()).map(|k| {
        let (sin, cos) = (step * k as f64).sin_cos();
        (1.2 * sin).hypot(0.8 * cos) * step
    });
    let gains = positions.iter().zip(&field.wall).map(|(x, b)| 0.7 * b - 0.2 * (2.0 + x.x));
    assert!(gains.zip(lengths).map(|(gain, length)| gain * length).sum::<f64>().abs() < 1e-11);
}

/// At the activity at which mode 1 of a circle starts to grow, -(2 Sigma R/c0) (D/R^2 + k_off/(1 + k_on R/D_b)), the
/// equations of a steady state are singular.
#[test]
fn equations_are_singular_at_the_threshold() {
    let condition = |activity: f64| {
        let mut setup = Setup { region: Region::Plane, ..Setup::default() };
        setup.method = Method::Integral(IntegralMethod { nodes: 32, elements: 128 });
        let particles = setup.droplets[0].particles.as_mut().unwrap();
        let (inside, rates) = (Some(0.5), ExchangeSetup::new(0.4, 0.3));
        particles.exchange = Some(ExchangeSetup { diffusion_inside: inside, ..rates });
        (particles.activity, particles.excluded_volume) = (activity, ExcludedVolume::None);
        let state = SteadyState::uniform(&setup).unwrap();
        let mut system = System::new(&setup).unwrap();
        system.residual(state.point()).unwrap();
        system.equations(state.point(), Part::Even, None).unwrap().condition()
    };
    let threshold = -4.0 * (0.1 + 0.3 / (1.0 + 0.4 / 0.5));
    let [at, beside] = [1.0, 1.02].map(|part| condition(part * threshold));
    assert!(at > 1e5 * beside, "{at:.1e} {beside:.1e}");
}
