//! A pair of rigid bodies that a constant force presses together, against lubrication theory.

use std::f64::consts::{PI, SQRT_2, TAU};

use crate::{Interface, InterfaceFlow, LayerError, Settings};
use motile_base::{Drive, Region, Vec2};

/// Speed at which two unit circles come closer that a force presses together, `F/(3 sqrt(2) pi eta (R/(2 h))^(3/2))`
/// with the film h between them (Jeffrey and Onishi, Q. J. Mech. Appl. Math. 34, 129, 1981, for a cylinder beside a
/// wall, whose film is that of two cylinders of twice the radius).
fn lubrication(film: f64) -> f64 {
    (2.0 * film).powf(1.5) / (3.0 * SQRT_2 * PI)
}

/// Speed of approach by the layers.
fn approach(film: f64, nodes: usize) -> f64 {
    let circle = |x: f64| -> Vec<Vec2> {
        (0..nodes).map(|k| Vec2::new(x, 0.0) + Vec2::from_angle(TAU * k as f64 / nodes as f64)).collect()
    };
    let sides = [-1.0, 1.0];
    let outlines = sides.map(|side| circle(side * (1.0 + 0.5 * film)));
    let forces = sides.map(|side| vec![Vec2::new(-side / nodes as f64, 0.0); nodes]);
    let settings = Settings { nodes, tolerance: 1e-10, ..Settings::default() };
    let mut flow = InterfaceFlow::new(Region::Plane, 1.0, settings).unwrap();
    let pair = outlines.iter().zip(&forces).map(|(outline, forces)| Interface::rigid(outline, forces, 1.0));
    flow.load(pair).unwrap();
    flow.solve().unwrap();
    let speeds = [0, 1].map(|number| {
        let mut velocities = vec![Vec2::ZERO; nodes];
        flow.velocities(number, &mut velocities).unwrap();
        velocities.iter().sum::<Vec2>().x / nodes as f64
    });
    speeds[0] - speeds[1]
}

#[test]
fn a_pair_pressed_together_drains_by_lubrication() {
    let errors = [0.04, 0.02, 0.01].map(|film| approach(film, 256) / lubrication(film) - 1.0);
    println!("{errors:?}");
    // The theory is the first term in the film over the radius; the next one goes by extrapolation.
    assert!(errors.windows(2).all(|e| (1.8..2.2).contains(&(e[0] / e[1]))), "{errors:?}");
    assert!((2.0 * errors[2] - errors[1]).abs() < 2e-3, "{errors:?}");
}

/// The time from one film to a thinner one under a constant force: in `s = h^(-1/2)` the film thins at a constant rate,
/// so that three states tell it.
#[test]
fn a_film_thins_in_the_time_of_lubrication() {
    let [thick, thin] = [0.02_f64, 0.005].map(|film| film.powf(-0.5));
    let slope = |s: f64, speed: &dyn Fn(f64) -> f64| 2.0 * s.powi(-3) / speed(s.powi(-2));
    let time = |speed: &dyn Fn(f64) -> f64| {
        let [a, b, c] = [thick, 0.5 * (thick + thin), thin].map(|s| slope(s, speed));
        (thin - thick) * (a + 4.0 * b + c) / 6.0
    };
    let (found, expected) = (time(&|film| approach(film, 384)), time(&lubrication));
    println!("{found} {expected}");
    // The error of the theory is some 1.7 times the film.
    assert!((found / expected - 1.0).abs() < 0.02, "{found} {expected}");
}

/// Speeds by a unit force towards a wall and along it, of a unit circle at that gap from it alone (Jeffrey and Onishi,
/// Q. J. Mech. Appl. Math. 34, 129, 1981, closed forms).
fn beside_a_wall(gap: f64) -> [f64; 2] {
    let distance = 1.0 + gap;
    let root = (distance * distance - 1.0).sqrt();
    let log = (distance + root).ln();
    [log - root / distance, log].map(|resistance| resistance / (4.0 * PI))
}

/// A unit circle above the lower wall of a channel.
fn disc_in_a_channel(gap: f64, nodes: usize, size: f64, direction: Vec2) -> Result<InterfaceFlow, LayerError> {
    let centre = Vec2::new(0.3, 1.0 + gap - 0.5 * size);
    let outline: Vec<Vec2> = (0..nodes).map(|k| centre + Vec2::from_angle(TAU * k as f64 / nodes as f64)).collect();
    let region = Region::Channel { length: size, width: size, drive: Drive::ZeroGradient };
    let settings = Settings { nodes, tolerance: 1e-8, ..Settings::default() };
    let mut flow = InterfaceFlow::new(region, 1.0, settings)?;
    let forces = vec![direction / nodes as f64; nodes];
    flow.load(std::iter::once(Interface::rigid(&outline, &forces, 1.0)))?;
    Ok(flow)
}

/// Speeds by the layers, towards the lower wall and along it.
fn in_a_channel(gap: f64, nodes: usize, size: f64) -> [f64; 2] {
    [-1.0 * Vec2::Y, Vec2::X].map(|direction| {
        let mut flow = disc_in_a_channel(gap, nodes, size, direction).unwrap();
        flow.solve().unwrap();
        flow.rigid_motion(0).unwrap().velocity.dot(direction)
    })
}

#[test]
fn a_disc_next_to_a_wall_moves_as_in_closed_form() {
    for gap in [0.1, 0.03, 0.02, 0.015, 0.01] {
        // What the other wall and the images along the channel add falls like the square of the size.
        let ([small, large], exact) = ([20.0, 40.0].map(|size| in_a_channel(gap, 96, size)), beside_a_wall(gap));
        let errors = [0, 1].map(|i| ((4.0 * large[i] - small[i]) / (3.0 * exact[i]) - 1.0).abs());
        println!("{gap}: {errors:?}");
        assert!(errors[0] < 0.004 && errors[1] < 2e-4, "{gap}: {errors:?}");
    }
    // At the narrowest gap that so many nodes may have.
    for nodes in [48, 64, 96, 128, 192] {
        let gap = 2.3001 * (TAU / nodes as f64).powi(2);
        let error = in_a_channel(gap, nodes, 20.0)[0] / beside_a_wall(gap)[0] - 1.0;
        println!("{nodes} nodes: {gap:.4} {error:e}");
        assert!(error.abs() < 0.01, "{nodes} {error:e}");
    }
    // Errors fall faster than any power of the number of nodes.
    let error = |nodes: usize| (in_a_channel(0.02, nodes, 20.0)[0] / beside_a_wall(0.02)[0] - 1.0).abs();
    let errors = [68, 84, 100].map(error);
    println!("{errors:?}");
    assert!(errors[0] > 8.0 * errors[1] && errors[1] > 8.0 * errors[2], "{errors:?}");
}

#[test]
fn a_film_that_nodes_do_not_resolve_is_refused() {
    let load = |gap: f64, nodes: usize| disc_in_a_channel(gap, nodes, 6.0, Vec2::X).map(drop);
    assert!(load(0.01, 96).is_ok() && load(0.03, 64).is_ok());
    let error = load(0.008, 96).unwrap_err();
    let LayerError::NarrowGap { curve: 0, nodes: 96, needed, gap, least } = error else { panic!("{error}") };
    println!("{error}");
    assert!((gap - 0.008).abs() < 1e-5 && (least - 0.00985).abs() < 1e-5 && needed == 107, "{error}");
    assert!(load(0.008, needed).is_ok() && load(0.004, needed).is_err());
}
